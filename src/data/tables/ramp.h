/* The columns and keys of the tables of DMA temperature sweeps. Included by tables.h alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_TABLES_RAMP_H
#define WT_DATA_TABLES_RAMP_H

#define RAMP_COLUMNS(X)                                                                            \
    X(RAMP_TEMPERATURE, "temperature", "temperature", SI(TEMPERATURE))                             \
    X(RAMP_ANGULAR_FREQUENCY, "angular_frequency", "angular frequency", SI(ANGULAR_FREQUENCY))     \
    X(RAMP_STORAGE_MODULUS, "storage_modulus", "storage modulus", SI(STORAGE_MODULUS), SPARSE)     \
    X(RAMP_LOSS_MODULUS, "loss_modulus", "loss modulus", SI(LOSS_MODULUS), SPARSE)                 \
    X(RAMP_LOSS_FACTOR, "loss_factor", "loss factor tan delta", SI(LOSS_FACTOR), SPARSE)           \
    X(RAMP_SOURCE, "source", "file and step", TEXT)                                                \
    X(RAMP_STRAIN, "strain", "strain amplitude", SI(STRAIN), SPARSE)
#define RAMP_KEYS(X) X(RAMP_KEY_DEFORMATION, "deformation", TEXT)

/* A number with its error and interval; empty where it is not known. */
#define NUMBER_AND_INTERVAL(X, ID, name, words, unit, heading)                                     \
    X(ID, name, words, unit, LABEL(heading), STANDARD_ERROR(ID), INTERVAL(ID##_LOW, ID##_HIGH),    \
      SPARSE)                                                                                      \
    X(ID##_STANDARD_ERROR, name "_standard_error", "its standard error", unit, LABEL("± stat."),   \
      SPARSE)                                                                                      \
    INTERVAL_COLUMNS(X, ID, name "_", unit, SPARSE)

#define PEAK_COLUMNS(X, ID, name, words, unit, heading)                                            \
    NUMBER_AND_INTERVAL(X, ID##_PEAK, name "_peak_temperature",                                    \
                        "temperature of the peak of " words, SI(TEMPERATURE), "Peak of " heading)  \
    X(ID##_HEIGHT, name "_peak", "its height", unit, LABEL("its height"), SPARSE)                  \
    X(ID##_POINTS, name "_points", "points that it is placed by", NUMBER, LABEL("Points"), SPARSE) \
    X(ID##_MISFIT, name "_misfit",                                                                 \
      "root mean square of what they are off its curve, of the height", NUMBER, LABEL("Misfit"),   \
      DIGITS(2), SPARSE)                                                                           \
    X(ID##_NOTE, name "_note", "why there is no peak or no interval", TEXT, LABEL("Note"))

#define GLASS_TRANSITION_COLUMNS(X)                                                                \
    X(GLASS_TRANSITION_ANGULAR_FREQUENCY, "angular_frequency", "angular frequency",                \
      SI(ANGULAR_FREQUENCY), LABEL("Angular frequency"))                                           \
    PEAK_COLUMNS(X, GLASS_TRANSITION_FACTOR, "loss_factor", "tan delta", SI(LOSS_FACTOR), "tan δ") \
    PEAK_COLUMNS(X, GLASS_TRANSITION_LOSS, "loss_modulus", "the loss modulus", SI(LOSS_MODULUS),   \
                 "the loss modulus")                                                               \
    X(GLASS_TRANSITION_TEMPERATURE_MIN, "temperature_min", "coldest point", SI(TEMPERATURE))       \
    X(GLASS_TRANSITION_TEMPERATURE_MAX, "temperature_max", "warmest point", SI(TEMPERATURE))       \
    X(GLASS_TRANSITION_SOURCE, "source", "file and step", TEXT)
/* Of the frequency nearest to 1 Hz at which there is a peak. */
#define GLASS_TRANSITION_KEYS(X)                                                                   \
    X(GLASS_TRANSITION_KEY_FACTOR_PEAK, "loss_factor_peak_temperature", SI(TEMPERATURE),           \
      HEADLINE("Glass transition (peak of tan δ)"), OPTIONAL)                                      \
    X(GLASS_TRANSITION_KEY_LOSS_PEAK, "loss_modulus_peak_temperature", SI(TEMPERATURE),            \
      HEADLINE("Glass transition (peak of the loss modulus)"), OPTIONAL)                           \
    X(GLASS_TRANSITION_KEY_ANGULAR_FREQUENCY, "angular_frequency", SI(ANGULAR_FREQUENCY),          \
      LABEL("at the angular frequency"), OPTIONAL)                                                 \
    X(GLASS_TRANSITION_KEY_DEFORMATION, "deformation", TEXT)

#define MODULI_AT_COLUMNS(X)                                                                       \
    X(MODULI_AT_TEMPERATURE, "temperature", "temperature", SI(TEMPERATURE), LABEL("Temperature"))  \
    X(MODULI_AT_ANGULAR_FREQUENCY, "angular_frequency", "angular frequency",                       \
      SI(ANGULAR_FREQUENCY), LABEL("Angular frequency"))                                           \
    NUMBER_AND_INTERVAL(X, MODULI_AT_STORAGE, "storage_modulus", "storage modulus",                \
                        SI(STORAGE_MODULUS), "Storage modulus")                                    \
    NUMBER_AND_INTERVAL(X, MODULI_AT_LOSS, "loss_modulus", "loss modulus", SI(LOSS_MODULUS),       \
                        "Loss modulus")                                                            \
    NUMBER_AND_INTERVAL(X, MODULI_AT_FACTOR, "loss_factor", "loss factor tan delta",               \
                        SI(LOSS_FACTOR), "tan δ")                                                  \
    X(MODULI_AT_NOTE, "note", "why there is no value", TEXT, LABEL("Note"))                        \
    X(MODULI_AT_SOURCE, "source", "file and step", TEXT)
#define MODULI_AT_KEYS(X) X(MODULI_AT_KEY_DEFORMATION, "deformation", TEXT)

#endif
