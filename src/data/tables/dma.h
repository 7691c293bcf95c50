/* The columns and keys of the tables of the material from DMA. Included by tables.h alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_TABLES_DMA_H
#define WT_DATA_TABLES_DMA_H

#define SHIFT_FACTORS_COLUMNS(X)                                                                   \
    X(SHIFT_FACTORS_TEMPERATURE, "temperature", "temperature of the isotherm", SI(TEMPERATURE),    \
      LABEL("Temperature"), DECIMALS(1))                                                           \
    X(SHIFT_FACTORS_LOG_A, "log_a", "log10 of the horizontal shift factor", NUMBER,                \
      LABEL("log₁₀ a"), STANDARD_ERROR(SHIFT_FACTORS_LOG_A), DECIMALS(3))                          \
    X(SHIFT_FACTORS_LOG_A_STANDARD_ERROR, "log_a_standard_error", "its standard error [decade]",   \
      NUMBER, LABEL("Standard error"), DECIMALS(3))                                                \
    X(SHIFT_FACTORS_LOG_B, "log_b", "log10 of the vertical shift factor", NUMBER,                  \
      LABEL("log₁₀ b"), STANDARD_ERROR(SHIFT_FACTORS_LOG_B), DECIMALS(3))                          \
    X(SHIFT_FACTORS_LOG_B_STANDARD_ERROR, "log_b_standard_error", "its standard error [decade]",   \
      NUMBER, LABEL("Standard error"), DECIMALS(3))                                                \
    X(SHIFT_FACTORS_LOG_B_PHYSICAL, "log_b_physical",                                              \
      "log10 b that density and temperature would give", NUMBER,                                   \
      LABEL("log₁₀ b, rubber elasticity"), DECIMALS(3))                                            \
    X(SHIFT_FACTORS_CORRELATION, "correlation", "correlation of log a and log b", NUMBER)          \
    X(SHIFT_FACTORS_OVERLAP, "overlap",                                                            \
      "smaller of the ordinate overlaps with the neighbour [decade]", NUMBER,                      \
      LABEL("Overlap (decades)"))                                                                  \
    X(SHIFT_FACTORS_DETERMINED, "determined", "1: the data decide the shift", YES_NO,              \
      LABEL("Determined by overlap"))                                                              \
    X(SHIFT_FACTORS_NOTE, "note", "what is odd", TEXT, LABEL("Note"))                              \
    X(SHIFT_FACTORS_WLF_LOG_A, "wlf_log_a", "log10 a of the fitted WLF law", NUMBER,               \
      LABEL("WLF log₁₀ a"), DECIMALS(3), SPARSE)

/* Those of the WLF law only where one fits. */
#define SHIFT_FACTORS_KEYS(X)                                                                      \
    X(SHIFT_FACTORS_KEY_WLF_C1, "wlf_c1", NUMBER, LABEL("WLF constant C₁"),                        \
      HEADLINE("WLF constant C₁"), OPTIONAL)                                                       \
    X(SHIFT_FACTORS_KEY_WLF_C2, "wlf_c2", SI(TEMPERATURE_DIFFERENCE), LABEL("WLF constant C₂"),    \
      HEADLINE("WLF constant C₂"), OPTIONAL)                                                       \
    X(SHIFT_FACTORS_KEY_WLF_SLOPE, "wlf_slope", UNIT("1/K"), OPTIONAL)                             \
    X(SHIFT_FACTORS_KEY_WLF_CORRELATION, "wlf_correlation", PLAIN,                                 \
      LABEL("Correlation of C₁ and C₂"), OPTIONAL)                                                 \
    X(SHIFT_FACTORS_KEY_POLE, "pole", UNIT("K"), LABEL("Pole of the WLF law"), OPTIONAL)           \
    X(SHIFT_FACTORS_KEY_WLF_FLOOR, "wlf_floor", NUMBER,                                            \
      LABEL("Systematic error of each shift that the errors of C1 and C2 include [decade]"),       \
      OPTIONAL)                                                                                    \
    X(SHIFT_FACTORS_KEY_WLF_RMS, "wlf_rms", NUMBER,                                                \
      LABEL("Residual of the WLF law, rms (decades)"), OPTIONAL)                                   \
    X(SHIFT_FACTORS_KEY_WLF_STRAIGHT, "wlf_straight", TEXT,                                        \
      LABEL("Shift factors on a straight line"), OPTIONAL)                                         \
    X(SHIFT_FACTORS_KEY_ACTIVATION_ENERGY, "activation_energy", UNIT("J/mol"), OPTIONAL)           \
    X(SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE),           \
      HEADLINE("Reference temperature"))                                                           \
    X(SHIFT_FACTORS_KEY_VERTICAL, "vertical", TEXT, LABEL("Vertical shift"))                       \
    X(SHIFT_FACTORS_KEY_DEFORMATION, "deformation", TEXT)                                          \
    X(SHIFT_FACTORS_KEY_SUPERPOSITION, "superposition", TEXT,                                      \
      HEADLINE("Time-temperature superposition"))

#define MASTER_CURVE_COLUMNS(X)                                                                    \
    X(MASTER_CURVE_ANGULAR_FREQUENCY, "angular_frequency", "reduced angular frequency",            \
      SI(ANGULAR_FREQUENCY))                                                                       \
    X(MASTER_CURVE_STORAGE_MODULUS, "storage_modulus", "storage modulus, shifted",                 \
      SI(STORAGE_MODULUS))                                                                         \
    X(MASTER_CURVE_LOSS_MODULUS, "loss_modulus", "loss modulus, shifted", SI(LOSS_MODULUS))        \
    X(MASTER_CURVE_TEMPERATURE, "temperature", "temperature it was measured at", SI(TEMPERATURE))  \
    X(MASTER_CURVE_FITTED_STORAGE, "fitted_storage", "storage modulus of the Prony series",        \
      SI(STORAGE_MODULUS))                                                                         \
    X(MASTER_CURVE_FITTED_LOSS, "fitted_loss", "loss modulus of the Prony series", SI(LOSS_MODULUS))

#define MASTER_CURVE_KEYS(X)                                                                       \
    X(MASTER_CURVE_KEY_RMS_STORAGE, "rms_storage", PLAIN,                                          \
      LABEL("Residual of the storage modulus, rms"))                                               \
    X(MASTER_CURVE_KEY_RMS_LOSS, "rms_loss", PLAIN, LABEL("Residual of the loss modulus, rms"))    \
    X(MASTER_CURVE_KEY_OVERLAP_RMS_STORAGE, "overlap_rms_storage", PLAIN)                          \
    X(MASTER_CURVE_KEY_OVERLAP_RMS_LOSS, "overlap_rms_loss", PLAIN)                                \
    X(MASTER_CURVE_KEY_KRAMERS_KRONIG, "kramers_kronig", PLAIN)                                    \
    X(MASTER_CURVE_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE))            \
    X(MASTER_CURVE_KEY_DEFORMATION, "deformation", TEXT)

#define PRONY_COLUMNS(X)                                                                           \
    X(PRONY_RELAXATION_TIME, "relaxation_time", "relaxation time", SI(TIME),                       \
      LABEL("Relaxation time"))                                                                    \
    X(PRONY_MODULUS, "modulus", "modulus of the term", SI(MODULUS), LABEL("Modulus"))

#define PRONY_KEYS(X)                                                                              \
    X(PRONY_KEY_EQUILIBRIUM_MODULUS, "equilibrium_modulus", SI(MODULUS))                           \
    X(PRONY_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE), OPTIONAL)         \
    X(PRONY_KEY_FREQUENCY_MIN, "frequency_min", SI(ANGULAR_FREQUENCY),                             \
      LABEL("Lowest angular frequency measured"), OPTIONAL)                                        \
    X(PRONY_KEY_FREQUENCY_MAX, "frequency_max", SI(ANGULAR_FREQUENCY),                             \
      LABEL("Highest angular frequency measured"), OPTIONAL)                                       \
    X(PRONY_KEY_DEFORMATION, "deformation", TEXT)                                                  \
    X(PRONY_KEY_RMS_STORAGE, "rms_storage", PLAIN, LABEL("Residual of the storage modulus, rms"),  \
      OPTIONAL)                                                                                    \
    X(PRONY_KEY_RMS_LOSS, "rms_loss", PLAIN, LABEL("Residual of the loss modulus, rms"), OPTIONAL)

#endif
