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
      "log10 b of the material: the part of log_b that is smooth in temperature", NUMBER,          \
      DECIMALS(3))                                                                                 \
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
      NUMBER, SHOWS(closed_form), DECIMALS(3), SPARSE)                                             \
    X(SHIFT_FACTORS_ORIGIN, IN(shift, origin),                                                     \
      "fitted, reference, given (law or table) or by hand", ENUM(shift_origin), LABEL("Origin"),   \
      OPTIONAL)

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
    X(SHIFT_FACTORS_KEY_STRAIN_LOW, "strain_low", SI(STRAIN),                                      \
      LABEL("Least strain amplitude of an isotherm"), OPTIONAL)                                    \
    X(SHIFT_FACTORS_KEY_STRAIN_HIGH, "strain_high", SI(STRAIN),                                    \
      LABEL("Largest strain amplitude of an isotherm"), OPTIONAL)                                  \
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
      LABEL("Noise of the storage modulus, relative"), OPTIONAL)                                   \
    X(MASTER_CURVE_KEY_NOISE_LOSS, AS(noise_loss), PLAIN,                                          \
      LABEL("Noise of the loss modulus, relative"), OPTIONAL)                                      \
    X(MASTER_CURVE_KEY_NOISE_CORRELATION, "noise_correlation", PLAIN, SHOWS(correlation),          \
      LABEL("Correlation of the noise of neighbouring points"))                                    \
    X(MASTER_CURVE_KEY_PHASE_LAG, AS(phase_lag), SI(ANGLE), OPTIONAL,                              \
      LABEL("Phase lag of the instrument at the highest frequency"))                               \
    X(MASTER_CURVE_KEY_INERTIA, AS(inertia), NUMBER, OPTIONAL,                                     \
      LABEL("Largest share of inertia in the storage modulus"))                                    \
    X(MASTER_CURVE_KEY_SAMPLE_TEMPERATURE_ERROR, AS(sample_temperature_error),                     \
      SI(TEMPERATURE_DIFFERENCE), OPTIONAL, LABEL("Error of the temperature of the sample"))       \
    X(MASTER_CURVE_KEY_FRAME_COMPLIANCE, AS(frame_compliance), SI(CREEP_COMPLIANCE), OPTIONAL,     \
      LABEL("Compliance of frame and clamps"))                                                     \
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
#define INFLUENCES_COLUMNS(X)                                                                      \
    X(INFLUENCES_TEMPERATURE, IN(one, temperature), "temperature of the isotherm left out",        \
      SI(TEMPERATURE), LABEL("Isotherm left out"), DECIMALS(1))                                    \
    X(INFLUENCES_CHANGE, "log_a_change",                                                           \
      "largest change of log10 a of another one, first of those outside", NUMBER,                  \
      SHOWS(one.change), LABEL("Change of log₁₀ a"), DECIMALS(3), SPARSE)                          \
    X(INFLUENCES_CHANGE_AT, "log_a_change_at", "temperature of that isotherm", SI(TEMPERATURE),    \
      SHOWS(one.change_at), LABEL("at"), DECIMALS(1), SPARSE)                                      \
    X(INFLUENCES_INTERVAL, "log_a_half_width", "half width of the 95 % interval of its log10 a",   \
      NUMBER, SHOWS(one.interval), LABEL("95 % interval, ±"), DECIMALS(3), SPARSE)                 \
    X(INFLUENCES_OUTSIDE, IN(one, outside), "number of shifts that leave their 95 % interval",     \
      NUMBER, LABEL("Shifts outside of their interval"))                                           \
    X(INFLUENCES_LOST, IN(one, lost), "number of shifts that the others do not determine", NUMBER, \
      LABEL("Shifts lost"))                                                                        \
    X(INFLUENCES_C1, "wlf_c1_change", "change of the WLF constant C1", NUMBER, SHOWS(one.c1),      \
      LABEL("Change of C₁"), DECIMALS(2), SPARSE)                                                  \
    X(INFLUENCES_C2, "wlf_c2_change", "change of the WLF constant C2", SI(TEMPERATURE_DIFFERENCE), \
      SHOWS(one.c2), LABEL("Change of C₂"), DECIMALS(1), SPARSE)                                   \
    X(INFLUENCES_STORAGE, "storage_change",                                                        \
      "relative change of the storage modulus at the reference temperature", NUMBER,               \
      SHOWS(one.storage), LABEL("Relative change of E′"), DECIMALS(3), SPARSE)                     \
    X(INFLUENCES_LOSS, "loss_change",                                                              \
      "relative change of the loss modulus at the reference temperature", NUMBER, SHOWS(one.loss), \
      LABEL("Relative change of E″"), DECIMALS(3), SPARSE)                                         \
    X(INFLUENCES_NOTE, IN(one, note), "what else changes without the isotherm", TEXT, LABEL("Note"))
#define INFLUENCES_KEYS(X)                                                                         \
    X(INFLUENCES_KEY_REFERENCE_TEMPERATURE, "reference_temperature", SI(TEMPERATURE))              \
    X(INFLUENCES_KEY_ANGULAR_FREQUENCY, "angular_frequency", SI(ANGULAR_FREQUENCY),                \
      LABEL("Angular frequency of the moduli"))

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
    X(PRONY_REDUCED_KEY_DEFORMATION, "deformation", ENUM(deformation), LABEL("Deformation"))

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

/* A number with its limits, which are missing if its error is unknown. */
#define VALUE_AND_INTERVAL(X, ID, name, words, unit, ...)                                          \
    X(ID, name, words, unit, INTERVAL(ID##_LOW, ID##_HIGH), __VA_ARGS__)                           \
    X(ID##_LOW, name "_low", "lower end of its 95 % interval", unit, SPARSE)                       \
    X(ID##_HIGH, name "_high", "upper end of its 95 % interval", unit, SPARSE)

#define RAMP_COLUMNS(X)                                                                            \
    X(RAMP_TEMPERATURE, AS(temperature), "temperature", SI(TEMPERATURE))                           \
    X(RAMP_ANGULAR_FREQUENCY, AS(angular_frequency), "angular frequency", SI(ANGULAR_FREQUENCY))   \
    X(RAMP_STORAGE_MODULUS, AS(storage_modulus), "storage modulus", SI(STORAGE_MODULUS), SPARSE)   \
    X(RAMP_LOSS_MODULUS, AS(loss_modulus), "loss modulus", SI(LOSS_MODULUS), SPARSE)               \
    X(RAMP_LOSS_FACTOR, AS(loss_factor), "loss factor tan delta", SI(LOSS_FACTOR), SPARSE)         \
    X(RAMP_SOURCE, AS(source), "file and step", TEXT)                                              \
    X(RAMP_STRAIN, AS(strain), "strain amplitude", SI(STRAIN), SPARSE)
#define RAMP_KEYS(X) X(RAMP_KEY_DEFORMATION, "deformation", ENUM(deformation))

#define PEAK_COLUMNS(X, ID, name, words, unit, heading, peak)                                      \
    NUMBER_AND_INTERVAL(X, ID##_PEAK, name "_peak_temperature",                                    \
                        "temperature of the peak of " words, SI(TEMPERATURE), "Peak of " heading,  \
                        SHOWS(peak.at))                                                            \
    X(ID##_HEIGHT, name "_peak", "its height", unit, SHOWS(peak.height), LABEL("its height"),      \
      SPARSE)                                                                                      \
    X(ID##_POINTS, name "_points", "points that it is placed by", NUMBER, SHOWS(peak.points),      \
      LABEL("Points"), SPARSE)                                                                     \
    X(ID##_MISFIT, name "_misfit",                                                                 \
      "root mean square deviation of the points from its curve, relative to the height", NUMBER,   \
      SHOWS(peak.misfit), LABEL("Misfit"), DIGITS(2), SPARSE)                                      \
    X(ID##_NOTE, name "_note", "why there is no peak or no interval", TEXT, SHOWS(peak.why_not),   \
      LABEL("Note"))

#define GLASS_TRANSITION_COLUMNS(X)                                                                \
    X(GLASS_TRANSITION_ANGULAR_FREQUENCY, AS(angular_frequency), "angular frequency",              \
      SI(ANGULAR_FREQUENCY), LABEL("Angular frequency"))                                           \
    PEAK_COLUMNS(X, GLASS_TRANSITION_FACTOR, "loss_factor", "tan delta", SI(LOSS_FACTOR), "tan δ", \
                 factor)                                                                           \
    PEAK_COLUMNS(X, GLASS_TRANSITION_LOSS, "loss_modulus", "the loss modulus", SI(LOSS_MODULUS),   \
                 "the loss modulus", loss)                                                         \
    NUMBER_AND_INTERVAL(X, GLASS_TRANSITION_ONSET, "storage_modulus_onset_temperature",            \
                        "temperature at which the storage modulus begins to fall, by tangents",    \
                        SI(TEMPERATURE), "Onset of the storage modulus", SHOWS(onset))             \
    X(GLASS_TRANSITION_ONSET_NOTE, AS(onset_note), "why there is no onset", TEXT, LABEL("Note"))   \
    X(GLASS_TRANSITION_TEMPERATURE_MIN, AS(temperature_min), "coldest point", SI(TEMPERATURE))     \
    X(GLASS_TRANSITION_TEMPERATURE_MAX, AS(temperature_max), "warmest point", SI(TEMPERATURE))     \
    X(GLASS_TRANSITION_OTHER, AS(other),                                                           \
      "1: a lower peak beside the largest one, in a row of its own", YES_NO, LABEL("Lower peak"))  \
    X(GLASS_TRANSITION_SOURCE, AS(source), "file and step", TEXT)
/* The keys describe the frequency nearest to 1 Hz that has a peak. The energies use all
 * frequencies. */
#define GLASS_TRANSITION_KEYS(X)                                                                   \
    X(GLASS_TRANSITION_KEY_FACTOR_PEAK, "loss_factor_peak_temperature", SI(TEMPERATURE),           \
      SHOWS(factor_peak), HEADLINE("Glass transition (peak of tan δ)"), OPTIONAL)                  \
    X(GLASS_TRANSITION_KEY_LOSS_PEAK, "loss_modulus_peak_temperature", SI(TEMPERATURE),            \
      SHOWS(loss_peak), HEADLINE("Glass transition (peak of the loss modulus)"), OPTIONAL)         \
    X(GLASS_TRANSITION_KEY_ONSET, "storage_modulus_onset_temperature", SI(TEMPERATURE),            \
      SHOWS(onset), LABEL("Onset of the fall of the storage modulus"), OPTIONAL)                   \
    X(GLASS_TRANSITION_KEY_FACTOR_ENERGY, "loss_factor_activation_energy", UNIT("J/mol"),          \
      SHOWS(factor_energy), LABEL("Activation energy of the peak of tan δ"), OPTIONAL)             \
    X(GLASS_TRANSITION_KEY_LOSS_ENERGY, "loss_modulus_activation_energy", UNIT("J/mol"),           \
      SHOWS(loss_energy), LABEL("Activation energy of the peak of the loss modulus"), OPTIONAL)    \
    X(GLASS_TRANSITION_KEY_ANGULAR_FREQUENCY, AS(angular_frequency), SI(ANGULAR_FREQUENCY),        \
      LABEL("at the angular frequency"), OPTIONAL)                                                 \
    X(GLASS_TRANSITION_KEY_DEFORMATION, AS(deformation), ENUM(deformation), LABEL("Deformation"))

#define MODULI_AT_COLUMNS(X)                                                                       \
    X(MODULI_AT_TEMPERATURE, AS(temperature), "temperature", SI(TEMPERATURE),                      \
      LABEL("Temperature"))                                                                        \
    X(MODULI_AT_ANGULAR_FREQUENCY, AS(angular_frequency), "angular frequency",                     \
      SI(ANGULAR_FREQUENCY), LABEL("Angular frequency"))                                           \
    NUMBER_AND_INTERVAL(X, MODULI_AT_STORAGE, "storage_modulus", "storage modulus",                \
                        SI(STORAGE_MODULUS), "Storage modulus", SHOWS(modulus[STORAGE]))           \
    NUMBER_AND_INTERVAL(X, MODULI_AT_LOSS, "loss_modulus", "loss modulus", SI(LOSS_MODULUS),       \
                        "Loss modulus", SHOWS(modulus[LOSS]))                                      \
    NUMBER_AND_INTERVAL(X, MODULI_AT_FACTOR, "loss_factor", "loss factor tan delta",               \
                        SI(LOSS_FACTOR), "tan δ", SHOWS(modulus[FACTOR]))                          \
    X(MODULI_AT_NOTE, AS(note), "why there is no value", TEXT, LABEL("Note"))                      \
    X(MODULI_AT_SOURCE, AS(source), "file and step", TEXT)
#define MODULI_AT_KEYS(X) X(MODULI_AT_KEY_DEFORMATION, "deformation", ENUM(deformation))

/* The ratios are f and g of the friction job: moduli divided by those at the smallest
 * amplitudes. */
#define PAYNE_SWEEP_COLUMNS(X)                                                                     \
    X(PAYNE_SWEEP_STRAIN, AS(strain), "strain amplitude", SI(STRAIN))                              \
    X(PAYNE_SWEEP_ANGULAR_FREQUENCY, AS(angular_frequency), "angular frequency",                   \
      SI(ANGULAR_FREQUENCY))                                                                       \
    X(PAYNE_SWEEP_TEMPERATURE, AS(temperature), "temperature", SI(TEMPERATURE), SPARSE)            \
    X(PAYNE_SWEEP_STORAGE_MODULUS, "storage_modulus", "storage modulus", SI(STORAGE_MODULUS),      \
      SHOWS(storage))                                                                              \
    X(PAYNE_SWEEP_LOSS_MODULUS, "loss_modulus", "loss modulus", SI(LOSS_MODULUS), SHOWS(loss))     \
    X(PAYNE_SWEEP_LOSS_FACTOR, AS(loss_factor), "loss factor tan delta", SI(LOSS_FACTOR))          \
    X(PAYNE_SWEEP_STORAGE_RATIO, AS(storage_ratio),                                                \
      "storage modulus over that of the smallest amplitudes, f(strain)", NUMBER)                   \
    X(PAYNE_SWEEP_LOSS_RATIO, AS(loss_ratio),                                                      \
      "loss modulus over that of the smallest amplitudes, g(strain)", NUMBER)                      \
    X(PAYNE_SWEEP_SAMPLE, AS(sample), "name of the sample", TEXT, OPTIONAL, SPARSE)                \
    X(PAYNE_SWEEP_SOURCE, AS(source), "file and step", TEXT)
#define PAYNE_SWEEP_KEYS(X) X(PAYNE_SWEEP_KEY_DEFORMATION, "deformation", ENUM(deformation))

#define PAYNE_COLUMNS(X)                                                                           \
    X(PAYNE_ANGULAR_FREQUENCY, IN(sweep, angular_frequency), "angular frequency",                  \
      SI(ANGULAR_FREQUENCY), LABEL("Angular frequency"))                                           \
    X(PAYNE_TEMPERATURE, IN(sweep, temperature), "temperature", SI(TEMPERATURE),                   \
      LABEL("Temperature"), SPARSE)                                                                \
    X(PAYNE_STORAGE_START, IN(payne, storage_start), "storage modulus of the smallest amplitudes", \
      SI(STORAGE_MODULUS), LABEL("Storage modulus, smallest strain"))                              \
    X(PAYNE_STORAGE_END, IN(payne, storage_end), "storage modulus of the largest amplitudes",      \
      SI(STORAGE_MODULUS), LABEL("Storage modulus, largest strain"))                               \
    X(PAYNE_STRAIN_TENTH, IN(payne, strain_tenth),                                                 \
      "strain at which the storage modulus has first lost a tenth of its initial value",           \
      SI(STRAIN), LABEL("Strain, a tenth lost"), SPARSE)                                           \
    X(PAYNE_STRAIN_HALF, IN(payne, strain_half),                                                   \
      "strain at which the storage modulus has first lost half of its initial value", SI(STRAIN),  \
      LABEL("Strain, half lost"), SPARSE)                                                          \
    X(PAYNE_LOSS_MAX, IN(payne, loss_max), "largest loss modulus", SI(LOSS_MODULUS),               \
      LABEL("Largest loss modulus"))                                                               \
    X(PAYNE_STRAIN_LOSS_MAX, IN(payne, strain_loss_max),                                           \
      "strain of the maximum of the loss modulus", SI(STRAIN), LABEL("Strain of its maximum"),     \
      SPARSE)                                                                                      \
    X(PAYNE_LOSS_NOTE, IN(payne, loss_note), "what the loss modulus lacks", TEXT, LABEL("Note"))   \
    X(PAYNE_POINTS, AS(points), "points", NUMBER, LABEL("Points"))                                 \
    X(PAYNE_STRAIN_MIN, AS(strain_min), "smallest amplitude", SI(STRAIN))                          \
    X(PAYNE_STRAIN_MAX, AS(strain_max), "largest amplitude", SI(STRAIN))                           \
    X(PAYNE_SAMPLE, IN(sweep, sample), "name of the sample", TEXT, OPTIONAL, SPARSE)               \
    X(PAYNE_SOURCE, IN(sweep, source), "file and step", TEXT)
#define PAYNE_KEYS(X) X(PAYNE_KEY_DEFORMATION, "deformation", ENUM(deformation))

#endif
