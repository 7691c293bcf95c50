/* Columns and keys of the tables of the material from DMA. Only core/table/registry.h includes
 * this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_TABLES_H
#define WT_DMA_TABLES_H

#define SHIFT_FACTORS_COLUMNS(X)                                                                   \
    X(SHIFT_FACTORS_TEMPERATURE, IN(shift, temperature), "temperature of the isotherm",            \
      SI(TEMPERATURE), LABEL("Temperature"), DECIMALS(1))                                          \
    X(SHIFT_FACTORS_LOG_A, IN(shift, log_a), "log10 of the horizontal shift factor, as measured",  \
      NUMBER, LABEL("log₁₀ a"), STANDARD_ERROR(SHIFT_FACTORS_LOG_A), DECIMALS(3))                  \
    X(SHIFT_FACTORS_LOG_A_STANDARD_ERROR, "log_a_standard_error", "its standard error [decade]",   \
      NUMBER, LABEL("Standard error"), DECIMALS(3))                                                \
    X(SHIFT_FACTORS_LOG_A_LOW, "log_a_low", "lower end of its 95 % interval", NUMBER,              \
      SHOWS(shift.log_a.low), DECIMALS(3))                                                         \
    X(SHIFT_FACTORS_LOG_A_HIGH, "log_a_high", "upper end of its 95 % interval", NUMBER,            \
      SHOWS(shift.log_a.high), DECIMALS(3))                                                        \
    X(SHIFT_FACTORS_LOG_B, IN(shift, log_b), "log10 of the vertical shift factor, as measured",    \
      NUMBER, LABEL("log₁₀ b"), STANDARD_ERROR(SHIFT_FACTORS_LOG_B), DECIMALS(3))                  \
    X(SHIFT_FACTORS_LOG_B_STANDARD_ERROR, "log_b_standard_error", "its standard error [decade]",   \
      NUMBER, LABEL("Standard error"), DECIMALS(3))                                                \
    X(SHIFT_FACTORS_LOG_B_PHYSICAL, IN(shift, log_b_physical),                                     \
      "log10 b that density and temperature would give", NUMBER,                                   \
      LABEL("log₁₀ b, rubber elasticity"), DECIMALS(3))                                            \
    X(SHIFT_FACTORS_LOG_B_MATERIAL, IN(shift, log_b_material),                                     \
      "log10 b of the material: what is smooth with temperature in log_b", NUMBER, DECIMALS(3))    \
    X(SHIFT_FACTORS_OVERLAP, IN(shift, overlap),                                                   \
      "least range of frequencies shared on the way to the reference [decade]", NUMBER,            \
      LABEL("Overlap (decades)"))                                                                  \
    X(SHIFT_FACTORS_NOISE_FACTOR, IN(shift, noise_factor),                                         \
      "noise of the isotherm against that of all", NUMBER, LABEL("Noise factor"))                  \
    X(SHIFT_FACTORS_OUTLIERS, "outliers", "values far off that were left out", NUMBER,             \
      SHOWS(shift.n_outliers))                                                                     \
    X(SHIFT_FACTORS_DETERMINED, IN(shift, determined), "1: the data decide the shift", YES_NO,     \
      LABEL("Determined by overlap"))                                                              \
    X(SHIFT_FACTORS_NOTE, IN(shift, note), "what is odd", TEXT, LABEL("Note"))                     \
    X(SHIFT_FACTORS_LAW_LOG_A, "law_log_a", "log10 a of the law, without the offset", NUMBER,      \
      SHOWS(shift.law), LABEL("log₁₀ a of the law"),                                               \
      INTERVAL(SHIFT_FACTORS_LAW_LOG_A_LOW, SHIFT_FACTORS_LAW_LOG_A_HIGH), DECIMALS(3), SPARSE)    \
    X(SHIFT_FACTORS_LAW_LOG_A_LOW, "law_log_a_low", "lower end of its 95 % interval", NUMBER,      \
      DECIMALS(3), SPARSE)                                                                         \
    X(SHIFT_FACTORS_LAW_LOG_A_HIGH, "law_log_a_high", "upper end of its 95 % interval", NUMBER,    \
      DECIMALS(3), SPARSE)                                                                         \
    X(SHIFT_FACTORS_CLOSED_FORM, "log_a_closed_form",                                              \
      "log10 a by the closed form of ISO 18437-6, of the storage modulus alone, for comparison",   \
      NUMBER, SHOWS(closed_form), DECIMALS(3), SPARSE)

/* The keys of the law exist only if there is a law. */
#define SHIFT_FACTORS_KEYS(X)                                                                      \
    X(SHIFT_FACTORS_KEY_SAMPLE, "sample", TEXT, LABEL("Sample"), OPTIONAL)                         \
    X(SHIFT_FACTORS_KEY_LAW, "law", ENUM(shift_law_kind), LABEL("Law of the shift factors"))       \
    X(SHIFT_FACTORS_KEY_WLF_C1, "wlf_c1", NUMBER, LABEL("WLF constant C₁"),                        \
      HEADLINE("WLF constant C₁"), OPTIONAL)                                                       \
    X(SHIFT_FACTORS_KEY_WLF_C2, "wlf_c2", SI(TEMPERATURE_DIFFERENCE), LABEL("WLF constant C₂"),    \
      HEADLINE("WLF constant C₂"), OPTIONAL)                                                       \
    X(SHIFT_FACTORS_KEY_WLF_CORRELATION, "wlf_correlation", PLAIN,                                 \
      LABEL("Correlation of C₁ and C₂"), OPTIONAL)                                                 \
    X(SHIFT_FACTORS_KEY_ACTIVATION_ENERGY, "activation_energy", UNIT("J/mol"),                     \
      LABEL("Activation energy"), HEADLINE("Activation energy"), OPTIONAL)                         \
    X(SHIFT_FACTORS_KEY_JOINT, "joint", SI(TEMPERATURE), LABEL("Arrhenius below, WLF above"),      \
      OPTIONAL)                                                                                    \
    X(SHIFT_FACTORS_KEY_LAW_SLOPE, "law_slope", UNIT("1/K"),                                       \
      LABEL("Slope of the law (decades per kelvin)"), OPTIONAL)                                    \
    X(SHIFT_FACTORS_KEY_POLE, "pole", UNIT("K"), LABEL("Pole of the WLF law"), OPTIONAL)           \
    X(SHIFT_FACTORS_KEY_OFFSET, "offset", NUMBER,                                                  \
      LABEL("Reference isotherm off the law (decades)"), OPTIONAL)                                 \
    X(SHIFT_FACTORS_KEY_LAW_RMS, "law_rms", NUMBER, LABEL("Residual of the law, rms (decades)"),   \
      OPTIONAL)                                                                                    \
    X(SHIFT_FACTORS_KEY_TEMPERATURE_SPREAD, "temperature_spread", SI(TEMPERATURE_DIFFERENCE),      \
      LABEL("Error of the temperature of an isotherm"), OPTIONAL)                                  \
    X(SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE),           \
      HEADLINE("Reference temperature"))                                                           \
    X(SHIFT_FACTORS_KEY_VERTICAL, "vertical", ENUM(vertical_shift), LABEL("Vertical shift"))       \
    X(SHIFT_FACTORS_KEY_SHIFTED_BY, "shifted_by", TEXT, LABEL("Shifted by"), OPTIONAL)             \
    X(SHIFT_FACTORS_KEY_ROUTE, "route", TEXT, LABEL("Shifts by"), OPTIONAL)                        \
    X(SHIFT_FACTORS_KEY_HOLDS_FROM, "valid_from", SI(TEMPERATURE),                                 \
      LABEL("Superposition holds from"), OPTIONAL)                                                 \
    X(SHIFT_FACTORS_KEY_HOLDS_TO, "valid_to", SI(TEMPERATURE), LABEL("Superposition holds to"),    \
      OPTIONAL)                                                                                    \
    X(SHIFT_FACTORS_KEY_STEP_LEFT, "step_left", PLAIN,                                             \
      LABEL("Not settled: a further step moves a number by up to (standard errors)"), OPTIONAL)    \
    X(SHIFT_FACTORS_KEY_DEFORMATION, "deformation", ENUM(deformation), LABEL("Deformation"))       \
    X(SHIFT_FACTORS_KEY_SUPERPOSITION, "superposition", ENUM(superposition),                       \
      HEADLINE("Time-temperature superposition"))                                                  \
    X(SHIFT_FACTORS_KEY_LACK_OF_FIT_P, "lack_of_fit_p", PLAIN, LABEL("Lack of fit, p"), OPTIONAL)  \
    X(SHIFT_FACTORS_KEY_MISFIT_LOW, "misfit_low", PLAIN,                                           \
      LABEL("Relative misfit of one spectrum, lower end of its 95 % interval"), OPTIONAL)          \
    X(SHIFT_FACTORS_KEY_MISFIT_HIGH, "misfit_high", PLAIN,                                         \
      LABEL("Relative misfit of one spectrum, upper end"), OPTIONAL)                               \
    X(SHIFT_FACTORS_KEY_LOSS_FACTOR, "loss_factor", NUMBER,                                        \
      LABEL("E″ against what E′ demands (Kramers-Kronig)"), OPTIONAL)                              \
    X(SHIFT_FACTORS_KEY_KRAMERS_KRONIG_P, "kramers_kronig_p", PLAIN, LABEL("Kramers-Kronig, p"),   \
      OPTIONAL)

/* A row for each isotherm of the samples that are used, and one for each that is not. */
#define SHARED_SHIFT_LAW_COLUMNS(X)                                                                \
    X(SHARED_SHIFT_LAW_SAMPLE, AS(sample), "name of the sample", TEXT, LABEL("Sample"))            \
    X(SHARED_SHIFT_LAW_TEMPERATURE, IN(point, temperature), "temperature of the isotherm",         \
      SI(TEMPERATURE), LABEL("Temperature"), DECIMALS(1), SPARSE)                                  \
    X(SHARED_SHIFT_LAW_LOG_A, IN(point, log_a),                                                    \
      "log10 of the horizontal shift factor from the reference of the common law", NUMBER,         \
      LABEL("log₁₀ a"), STANDARD_ERROR(SHARED_SHIFT_LAW_LOG_A), DECIMALS(3), SPARSE)               \
    X(SHARED_SHIFT_LAW_LOG_A_STANDARD_ERROR, "log_a_standard_error",                               \
      "its standard error, without that of the temperature [decade]", NUMBER,                      \
      SHOWS(point.log_a_error), LABEL("Standard error"), DECIMALS(3), SPARSE)                      \
    X(SHARED_SHIFT_LAW_LAW_LOG_A, "law_log_a", "log10 a of the common law", NUMBER,                \
      SHOWS(point.law), LABEL("log₁₀ a of the law"),                                               \
      INTERVAL(SHARED_SHIFT_LAW_LAW_LOG_A_LOW, SHARED_SHIFT_LAW_LAW_LOG_A_HIGH), DECIMALS(3),      \
      SPARSE)                                                                                      \
    X(SHARED_SHIFT_LAW_LAW_LOG_A_LOW, "law_log_a_low", "lower end of its 95 % interval", NUMBER,   \
      DECIMALS(3), SPARSE)                                                                         \
    X(SHARED_SHIFT_LAW_LAW_LOG_A_HIGH, "law_log_a_high", "upper end of its 95 % interval", NUMBER, \
      DECIMALS(3), SPARSE)                                                                         \
    X(SHARED_SHIFT_LAW_DIFFERENCE, IN(point, difference),                                          \
      "what the sample's own law has more, from the middle of its isotherms on [decade]", NUMBER,  \
      LABEL("Own law against it (decades)"),                                                       \
      INTERVAL(SHARED_SHIFT_LAW_DIFFERENCE_LOW, SHARED_SHIFT_LAW_DIFFERENCE_HIGH), DECIMALS(3),    \
      SPARSE)                                                                                      \
    X(SHARED_SHIFT_LAW_DIFFERENCE_LOW, "difference_low",                                           \
      "lower limit of it, on the safe side: both limits held it in 97 to 99 % of draws", NUMBER,   \
      DECIMALS(3), SPARSE)                                                                         \
    X(SHARED_SHIFT_LAW_DIFFERENCE_HIGH, "difference_high", "upper limit", NUMBER, DECIMALS(3),     \
      SPARSE)                                                                                      \
    X(SHARED_SHIFT_LAW_MOVED, AS(moved),                                                           \
      "reference temperature of the law of the sample above that of the first [K]", NUMBER,        \
      LABEL("Moved by (K)"), STANDARD_ERROR(SHARED_SHIFT_LAW_MOVED), SPARSE)                       \
    X(SHARED_SHIFT_LAW_MOVED_STANDARD_ERROR, "moved_standard_error", "its standard error", NUMBER, \
      SPARSE)                                                                                      \
    X(SHARED_SHIFT_LAW_NOTE, AS(note), "why a sample is left out", TEXT, LABEL("Note"), SPARSE)

#define SHARED_SHIFT_LAW_KEYS(X)                                                                   \
    X(SHARED_SHIFT_LAW_KEY_AGREE, "agree", TEXT, LABEL("Have the samples one law"),                \
      HEADLINE("Have the samples one law"))                                                        \
    X(SHARED_SHIFT_LAW_KEY_SETTLED_BY, "settled_by", TEXT, LABEL("What would settle it"),          \
      OPTIONAL)                                                                                    \
    X(SHARED_SHIFT_LAW_KEY_LEFT_OUT, "left_out", TEXT, LABEL("Samples left out of it, and why"),   \
      OPTIONAL)                                                                                    \
    X(SHARED_SHIFT_LAW_KEY_P, "p", PLAIN, LABEL("One law, p"), OPTIONAL)                           \
    X(SHARED_SHIFT_LAW_KEY_FURTHEST, "largest_deviation", NUMBER,                                  \
      LABEL("Own laws against it, furthest limit (decades)"), OPTIONAL)                            \
    X(SHARED_SHIFT_LAW_KEY_MARGIN, "margin", PLAIN, LABEL("Margin within which they are alike"))   \
    X(SHARED_SHIFT_LAW_KEY_LAW, "law", TEXT, LABEL("Law of the shift factors"))                    \
    X(SHARED_SHIFT_LAW_KEY_MOVED, "sample_shifts", TEXT,                                           \
      LABEL("Reference temperature of each sample"))                                               \
    X(SHARED_SHIFT_LAW_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE),        \
      LABEL("Reference temperature"))                                                              \
    X(SHARED_SHIFT_LAW_KEY_WLF_C1, "wlf_c1", NUMBER, LABEL("WLF constant C₁"), OPTIONAL)           \
    X(SHARED_SHIFT_LAW_KEY_WLF_C2, "wlf_c2", SI(TEMPERATURE_DIFFERENCE), LABEL("WLF constant C₂"), \
      OPTIONAL)                                                                                    \
    X(SHARED_SHIFT_LAW_KEY_WLF_CORRELATION, "wlf_correlation", PLAIN,                              \
      LABEL("Correlation of C₁ and C₂"), OPTIONAL)                                                 \
    X(SHARED_SHIFT_LAW_KEY_ACTIVATION_ENERGY, "activation_energy", UNIT("J/mol"),                  \
      LABEL("Activation energy"), OPTIONAL)                                                        \
    X(SHARED_SHIFT_LAW_KEY_TEMPERATURE_SPREAD, "temperature_spread", SI(TEMPERATURE_DIFFERENCE),   \
      LABEL("Error of the temperature of an isotherm"))                                            \
    X(SHARED_SHIFT_LAW_KEY_SHIFT_LAW, "shift_law", TEXT, LABEL("To be given to --shift-law"))

#define MASTER_CURVE_COLUMNS(X)                                                                    \
    X(MASTER_CURVE_ANGULAR_FREQUENCY, AS(angular_frequency), "reduced angular frequency",          \
      SI(ANGULAR_FREQUENCY))                                                                       \
    X(MASTER_CURVE_STORAGE_MODULUS, AS(storage_modulus), "storage modulus, shifted",               \
      SI(STORAGE_MODULUS))                                                                         \
    X(MASTER_CURVE_LOSS_MODULUS, AS(loss_modulus), "loss modulus, shifted", SI(LOSS_MODULUS))      \
    X(MASTER_CURVE_TEMPERATURE, AS(temperature), "temperature it was measured at",                 \
      SI(TEMPERATURE))                                                                             \
    X(MASTER_CURVE_FITTED_STORAGE, AS(fitted_storage), "storage modulus of the spectrum",          \
      SI(STORAGE_MODULUS),                                                                         \
      INTERVAL(MASTER_CURVE_FITTED_STORAGE_LOW, MASTER_CURVE_FITTED_STORAGE_HIGH))                 \
    X(MASTER_CURVE_FITTED_STORAGE_LOW, "fitted_storage_low", "lower end of its 95 % interval",     \
      SI(STORAGE_MODULUS))                                                                         \
    X(MASTER_CURVE_FITTED_STORAGE_HIGH, "fitted_storage_high", "upper end of its 95 % interval",   \
      SI(STORAGE_MODULUS))                                                                         \
    X(MASTER_CURVE_FITTED_LOSS, AS(fitted_loss), "loss modulus of the spectrum", SI(LOSS_MODULUS), \
      INTERVAL(MASTER_CURVE_FITTED_LOSS_LOW, MASTER_CURVE_FITTED_LOSS_HIGH))                       \
    X(MASTER_CURVE_FITTED_LOSS_LOW, "fitted_loss_low", "lower end of its 95 % interval",           \
      SI(LOSS_MODULUS))                                                                            \
    X(MASTER_CURVE_FITTED_LOSS_HIGH, "fitted_loss_high", "upper end of its 95 % interval",         \
      SI(LOSS_MODULUS))                                                                            \
    X(MASTER_CURVE_LEFT_OUT, AS(left_out), "1: one of the moduli is far off and was left out",     \
      YES_NO)                                                                                      \
    X(MASTER_CURVE_FITTED_LOSS_FACTOR, AS(fitted_loss_factor), "tan delta of the spectrum",        \
      NUMBER, INTERVAL(MASTER_CURVE_FITTED_LOSS_FACTOR_LOW, MASTER_CURVE_FITTED_LOSS_FACTOR_HIGH)) \
    X(MASTER_CURVE_FITTED_LOSS_FACTOR_LOW, "fitted_loss_factor_low",                               \
      "lower end of its 95 % interval", NUMBER)                                                    \
    X(MASTER_CURVE_FITTED_LOSS_FACTOR_HIGH, "fitted_loss_factor_high",                             \
      "upper end of its 95 % interval", NUMBER)                                                    \
    X(MASTER_CURVE_OWN_FREQUENCY, AS(own_frequency),                                               \
      "angular frequency at the temperature it was measured at", SI(ANGULAR_FREQUENCY))            \
    X(MASTER_CURVE_OWN_STORAGE, AS(own_storage), "storage modulus at this temperature",            \
      SI(STORAGE_MODULUS))                                                                         \
    X(MASTER_CURVE_OWN_LOSS, AS(own_loss), "loss modulus at this temperature", SI(LOSS_MODULUS))   \
    X(MASTER_CURVE_LOSS_FACTOR, AS(loss_factor), "tan delta as measured", NUMBER, SPARSE)          \
    X(MASTER_CURVE_TIME, AS(time), "reduced time after a step, one over the frequency", SI(TIME),  \
      OPTIONAL, SPARSE)                                                                            \
    X(MASTER_CURVE_RELAXATION_MODULUS, AS(relaxation_modulus), "relaxation modulus, shifted",      \
      SI(RELAXATION_MODULUS), OPTIONAL, SPARSE)                                                    \
    X(MASTER_CURVE_FITTED_RELAXATION, AS(fitted_relaxation), "relaxation modulus of the spectrum", \
      SI(RELAXATION_MODULUS),                                                                      \
      INTERVAL(MASTER_CURVE_FITTED_RELAXATION_LOW, MASTER_CURVE_FITTED_RELAXATION_HIGH), OPTIONAL, \
      SPARSE)                                                                                      \
    X(MASTER_CURVE_FITTED_RELAXATION_LOW, "fitted_relaxation_low",                                 \
      "lower end of its 95 % interval", SI(RELAXATION_MODULUS), OPTIONAL, SPARSE)                  \
    X(MASTER_CURVE_FITTED_RELAXATION_HIGH, "fitted_relaxation_high",                               \
      "upper end of its 95 % interval", SI(RELAXATION_MODULUS), OPTIONAL, SPARSE)                  \
    X(MASTER_CURVE_OWN_RELAXATION, AS(own_relaxation),                                             \
      "relaxation modulus at the temperature it was measured at", SI(RELAXATION_MODULUS),          \
      OPTIONAL, SPARSE)                                                                            \
    X(MASTER_CURVE_CREEP_COMPLIANCE, AS(creep_compliance), "creep compliance, shifted",            \
      SI(CREEP_COMPLIANCE), OPTIONAL, SPARSE)                                                      \
    X(MASTER_CURVE_FITTED_CREEP, AS(fitted_creep), "creep compliance of the spectrum",             \
      SI(CREEP_COMPLIANCE),                                                                        \
      INTERVAL(MASTER_CURVE_FITTED_CREEP_LOW, MASTER_CURVE_FITTED_CREEP_HIGH), OPTIONAL, SPARSE)   \
    X(MASTER_CURVE_FITTED_CREEP_LOW, "fitted_creep_low", "lower end of its 95 % interval",         \
      SI(CREEP_COMPLIANCE), OPTIONAL, SPARSE)                                                      \
    X(MASTER_CURVE_FITTED_CREEP_HIGH, "fitted_creep_high", "upper end of its 95 % interval",       \
      SI(CREEP_COMPLIANCE), OPTIONAL, SPARSE)                                                      \
    X(MASTER_CURVE_OWN_CREEP, AS(own_creep),                                                       \
      "creep compliance at the temperature it was measured at", SI(CREEP_COMPLIANCE), OPTIONAL,    \
      SPARSE)                                                                                      \
    X(MASTER_CURVE_OWN_TIME, AS(own_time),                                                         \
      "time after a step at the temperature of the "                                               \
      "measurement",                                                                               \
      SI(TIME), OPTIONAL, SPARSE)

#define MASTER_CURVE_KEYS(X)                                                                       \
    X(MASTER_CURVE_KEY_NOISE_STORAGE, AS(noise_storage), PLAIN,                                    \
      LABEL("Noise of the storage modulus, relative"))                                             \
    X(MASTER_CURVE_KEY_NOISE_LOSS, AS(noise_loss), PLAIN,                                          \
      LABEL("Noise of the loss modulus, relative"))                                                \
    X(MASTER_CURVE_KEY_NOISE_CORRELATION, "noise_correlation", PLAIN, SHOWS(correlation),          \
      LABEL("Correlation of the noise of neighbouring points"))                                    \
    X(MASTER_CURVE_KEY_REFERENCE_TEMPERATURE, AS(reference_temperature), SI(TEMPERATURE))          \
    X(MASTER_CURVE_KEY_DEFORMATION, "deformation", ENUM(deformation))

#define PRONY_COLUMNS(X)                                                                           \
    X(PRONY_RELAXATION_TIME, AS(relaxation_time), "relaxation time", SI(TIME),                     \
      LABEL("Relaxation time"))                                                                    \
    X(PRONY_MODULUS, AS(modulus), "modulus of the term", SI(MODULUS), LABEL("Modulus"))

#define PRONY_KEYS(X)                                                                              \
    X(PRONY_KEY_EQUILIBRIUM_MODULUS, AS(equilibrium_modulus), SI(MODULUS),                         \
      LABEL("Equilibrium modulus"))                                                                \
    X(PRONY_KEY_EQUILIBRIUM_LIMIT, "equilibrium_modulus_limit", SI(MODULUS), SHOWS(limit),         \
      LABEL("Equilibrium modulus at most (95 %)"), OPTIONAL)                                       \
    X(PRONY_KEY_REFERENCE_TEMPERATURE, IN(series, reference_temperature), SI(TEMPERATURE),         \
      OPTIONAL, LABEL("Reference temperature"))                                                    \
    X(PRONY_KEY_FREQUENCY_MIN, IN(series, frequency_min), SI(ANGULAR_FREQUENCY),                   \
      LABEL("Lowest angular frequency measured"), OPTIONAL)                                        \
    X(PRONY_KEY_FREQUENCY_MAX, IN(series, frequency_max), SI(ANGULAR_FREQUENCY),                   \
      LABEL("Highest angular frequency measured"), OPTIONAL)                                       \
    X(PRONY_KEY_DEFORMATION, AS(deformation), ENUM(deformation), LABEL("Deformation"))             \
    X(PRONY_KEY_RMS_STORAGE, "rms_storage", PLAIN, SHOWS(noise_storage),                           \
      LABEL("Noise of the storage modulus, relative"), OPTIONAL)                                   \
    X(PRONY_KEY_RMS_LOSS, "rms_loss", PLAIN, SHOWS(noise_loss),                                    \
      LABEL("Noise of the loss modulus, relative"), OPTIONAL)

#define RELAXATION_SPECTRUM_COLUMNS(X)                                                             \
    X(RELAXATION_SPECTRUM_RELAXATION_TIME, AS(relaxation_time), "relaxation time", SI(TIME))       \
    X(RELAXATION_SPECTRUM_DENSITY, AS(density), "modulus for each unit of ln tau", SI(MODULUS),    \
      INTERVAL(RELAXATION_SPECTRUM_LOW, RELAXATION_SPECTRUM_HIGH))                                 \
    X(RELAXATION_SPECTRUM_LOW, "density_low", "lower limit, on the safe side of 95 %",             \
      SI(MODULUS))                                                                                 \
    X(RELAXATION_SPECTRUM_HIGH, "density_high", "upper limit", SI(MODULUS))
#define RELAXATION_SPECTRUM_KEYS(X)                                                                \
    X(RELAXATION_SPECTRUM_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE))     \
    X(RELAXATION_SPECTRUM_KEY_DEFORMATION, "deformation", ENUM(deformation))

/* The reduced series for finite element programs. */
#define PRONY_REDUCED_COLUMNS(X)                                                                   \
    X(PRONY_REDUCED_RELAXATION_TIME, AS(relaxation_time), "relaxation time", SI(TIME),             \
      LABEL("Relaxation time"))                                                                    \
    X(PRONY_REDUCED_MODULUS, AS(modulus), "modulus of the term", SI(MODULUS), LABEL("Modulus"))    \
    X(PRONY_REDUCED_SHARE, AS(share), "modulus of the term over the instantaneous one", NUMBER,    \
      LABEL("Share"))

#define PRONY_REDUCED_KEYS(X)                                                                      \
    X(PRONY_REDUCED_KEY_EQUILIBRIUM_MODULUS, "equilibrium_modulus", SI(MODULUS),                   \
      LABEL("Long-term modulus"))                                                                  \
    X(PRONY_REDUCED_KEY_INSTANTANEOUS_MODULUS, "instantaneous_modulus", SI(MODULUS),               \
      LABEL("Instantaneous modulus"))                                                              \
    X(PRONY_REDUCED_KEY_DEVIATION_STORAGE, "deviation_storage", PLAIN,                             \
      LABEL("Storage modulus off the spectrum by at most, relative"))                              \
    X(PRONY_REDUCED_KEY_DEVIATION_LOSS, "deviation_loss", PLAIN,                                   \
      LABEL("Loss modulus off the spectrum by at most, relative"))                                 \
    X(PRONY_REDUCED_KEY_INTERVAL_STORAGE, "interval_storage", PLAIN,                               \
      LABEL("Half of the 95 % interval of the storage modulus where it is widest, relative"))      \
    X(PRONY_REDUCED_KEY_INTERVAL_LOSS, "interval_loss", PLAIN,                                     \
      LABEL("Half of the 95 % interval of the loss modulus where it is widest, relative"))         \
    X(PRONY_REDUCED_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE),           \
      LABEL("Reference temperature"))                                                              \
    X(PRONY_REDUCED_KEY_FREQUENCY_MIN, "frequency_min", SI(ANGULAR_FREQUENCY),                     \
      LABEL("Lowest angular frequency it holds for"))                                              \
    X(PRONY_REDUCED_KEY_FREQUENCY_MAX, "frequency_max", SI(ANGULAR_FREQUENCY),                     \
      LABEL("Highest angular frequency it holds for"))                                             \
    X(PRONY_REDUCED_KEY_DEFORMATION, "deformation", ENUM(deformation), LABEL("Deformation"))       \
    X(PRONY_REDUCED_KEY_ZENER, "fractional_zener", TEXT,                                           \
      LABEL("Fractional Zener law through the same points"), OPTIONAL)                             \
    X(PRONY_REDUCED_KEY_BETTER, "preferred_model", TEXT,                                           \
      LABEL("Model that describes the points better"), OPTIONAL)

#define MATERIAL_DRAWS_COLUMNS(X)                                                                  \
    X(MATERIAL_DRAWS_DRAW, AS(draw), "number of the draw, from 1", NUMBER)                         \
    X(MATERIAL_DRAWS_TEMPERATURE, AS(temperature), "temperature of an isotherm", SI(TEMPERATURE),  \
      SPARSE)                                                                                      \
    X(MATERIAL_DRAWS_LOG_B, "log_b_material", "log10 b of the material at this temperature",       \
      NUMBER, SHOWS(log_b), SPARSE)                                                                \
    X(MATERIAL_DRAWS_EQUILIBRIUM_MODULUS, AS(equilibrium_modulus), "equilibrium modulus",          \
      SI(MODULUS), SPARSE)                                                                         \
    X(MATERIAL_DRAWS_WLF_C1, AS(wlf_c1), "constant C1 of the WLF law", NUMBER, SPARSE)             \
    X(MATERIAL_DRAWS_WLF_C2, AS(wlf_c2), "constant C2 of the WLF law", SI(TEMPERATURE_DIFFERENCE), \
      SPARSE)                                                                                      \
    X(MATERIAL_DRAWS_ACTIVATION_ENERGY, AS(activation_energy), "activation energy", UNIT("J/mol"), \
      SPARSE)
#define MATERIAL_DRAWS_KEYS(X)                                                                     \
    X(MATERIAL_DRAWS_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE))

#define SERIES_DRAWS_COLUMNS(X)                                                                    \
    X(SERIES_DRAWS_DRAW, AS(draw), "number of the draw, from 1", NUMBER)                           \
    X(SERIES_DRAWS_RELAXATION_TIME, AS(relaxation_time), "relaxation time", SI(TIME))              \
    X(SERIES_DRAWS_MODULUS, AS(modulus), "modulus of the term", SI(MODULUS))
#define SERIES_DRAWS_KEYS(X)

#endif
