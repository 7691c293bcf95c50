/* Columns and keys of the tables of DMA strain sweeps. Only core/table/registry.h includes this
 * file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_TABLES_STRAIN_H
#define WT_DMA_TABLES_STRAIN_H

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
      "storage modulus by that of the smallest amplitudes, f(strain)", NUMBER)                     \
    X(PAYNE_SWEEP_LOSS_RATIO, AS(loss_ratio),                                                      \
      "loss modulus by that of the smallest amplitudes, g(strain)", NUMBER)                        \
    X(PAYNE_SWEEP_STORAGE_KRAUS, AS(storage_kraus), "storage modulus of the law of Kraus",         \
      SI(STORAGE_MODULUS), SPARSE)                                                                 \
    X(PAYNE_SWEEP_LOSS_KRAUS, AS(loss_kraus), "loss modulus of the law of Kraus",                  \
      SI(LOSS_MODULUS), SPARSE)                                                                    \
    X(PAYNE_SWEEP_SAMPLE, AS(sample), "name of the sample", TEXT, OPTIONAL, SPARSE)                \
    X(PAYNE_SWEEP_SOURCE, AS(source), "file and step", TEXT)
#define PAYNE_SWEEP_KEYS(X) X(PAYNE_SWEEP_KEY_DEFORMATION, "deformation", ENUM(deformation))

/* The measured values come first, then the law of Kraus. */
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
      "strain at which the storage modulus first lost a tenth of its start", SI(STRAIN),           \
      LABEL("Strain, a tenth lost"), SPARSE)                                                       \
    X(PAYNE_STRAIN_HALF, IN(payne, strain_half),                                                   \
      "strain at which the storage modulus first lost half of its start", SI(STRAIN),              \
      LABEL("Strain, half lost"), SPARSE)                                                          \
    X(PAYNE_LOSS_MAX, IN(payne, loss_max), "largest loss modulus", SI(LOSS_MODULUS),               \
      LABEL("Largest loss modulus"))                                                               \
    X(PAYNE_STRAIN_LOSS_MAX, IN(payne, strain_loss_max),                                           \
      "strain of the maximum of the loss modulus", SI(STRAIN), LABEL("Strain of its maximum"),     \
      SPARSE)                                                                                      \
    X(PAYNE_LOSS_NOTE, IN(payne, loss_note), "what the loss modulus lacks", TEXT, LABEL("Note"))   \
    NUMBER_AND_INTERVAL(X, PAYNE_STORAGE_0, "storage_0", "Kraus: storage modulus at no strain",    \
                        SI(STORAGE_MODULUS), "Kraus: storage modulus at no strain",                \
                        SHOWS(payne.storage_0))                                                    \
    NUMBER_AND_INTERVAL(X, PAYNE_STORAGE_INF, "storage_inf",                                       \
                        "Kraus: storage modulus at large strain", SI(STORAGE_MODULUS),             \
                        "Kraus: at large strain", SHOWS(payne.storage_inf))                        \
    NUMBER_AND_INTERVAL(X, PAYNE_STRAIN_C, "strain_c", "Kraus: strain at half of the fall",        \
                        SI(STRAIN), "Kraus: strain at half of the fall", SHOWS(payne.strain_c))    \
    NUMBER_AND_INTERVAL(X, PAYNE_EXPONENT, "exponent", "Kraus: exponent m", NUMBER,                \
                        "Kraus: exponent", SHOWS(payne.exponent))                                  \
    NUMBER_AND_INTERVAL(X, PAYNE_LOSS_M, "loss_m", "Kraus: loss modulus at half of the fall",      \
                        SI(LOSS_MODULUS), "Kraus: loss modulus at half of the fall",               \
                        SHOWS(payne.loss_m))                                                       \
    NUMBER_AND_INTERVAL(X, PAYNE_LOSS_INF, "loss_inf",                                             \
                        "Kraus: loss modulus far from half of the fall", SI(LOSS_MODULUS),         \
                        "Kraus: loss modulus far from it", SHOWS(payne.loss_inf))                  \
    X(PAYNE_STORAGE_MISFIT, IN(payne, storage_misfit),                                             \
      "root mean square of what the storage moduli are off the law, of storage_0", NUMBER,         \
      LABEL("Misfit"), DIGITS(2), SPARSE)                                                          \
    X(PAYNE_LOSS_MISFIT, IN(payne, loss_misfit),                                                   \
      "root mean square of what the loss moduli are off the law, of the largest", NUMBER,          \
      LABEL("Misfit of the loss modulus"), DIGITS(2), SPARSE)                                      \
    X(PAYNE_NOTE, IN(payne, note), "why there is no law of Kraus, or what it lacks", TEXT,         \
      LABEL("Note"))                                                                               \
    X(PAYNE_POINTS, AS(points), "points", NUMBER, LABEL("Points"))                                 \
    X(PAYNE_STRAIN_MIN, AS(strain_min), "smallest amplitude", SI(STRAIN))                          \
    X(PAYNE_STRAIN_MAX, AS(strain_max), "largest amplitude", SI(STRAIN))                           \
    X(PAYNE_SAMPLE, IN(sweep, sample), "name of the sample", TEXT, OPTIONAL, SPARSE)               \
    X(PAYNE_SOURCE, IN(sweep, source), "file and step", TEXT)
#define PAYNE_KEYS(X) X(PAYNE_KEY_DEFORMATION, "deformation", ENUM(deformation))

#endif
