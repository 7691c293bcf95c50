/* Columns and keys of the tables of DMA temperature sweeps. Only core/table/registry.h includes
 * this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_TABLES_RAMP_H
#define WT_DMA_TABLES_RAMP_H

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
      "root mean square of what they are off its curve, of the height", NUMBER,                    \
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

#endif
