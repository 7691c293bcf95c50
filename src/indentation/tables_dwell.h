/* Columns and keys of the tables of dwells. Only core/table/registry.h includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_TABLES_DWELL_H
#define WT_INDENTATION_TABLES_DWELL_H

/* A number with its standard error; both may be empty. */
#define NUMBER_AND_ERROR(X, ID, name, words, unit, heading, ...)                                   \
    X(ID, name, words, unit, LABEL(heading), STANDARD_ERROR(ID), SPARSE, __VA_ARGS__)              \
    X(ID##_STANDARD_ERROR, name "_standard_error", "its standard error", unit, LABEL("± stat."),   \
      SPARSE)

/* Each row is a dwell of a curve. */
#define DWELL_COLUMNS(X)                                                                           \
    X(DWELL_FILE, "file", "file of the curve", TEXT, LABEL("File"))                                \
    X(DWELL_CURVE, "curve", "number of the curve in its file", NUMBER, LABEL("Curve"))             \
    X(DWELL_SEGMENT, "segment", "number of the segment in the curve", NUMBER)                      \
    X(DWELL_KIND, "kind", "relaxation (height held), creep (force held) or modulation", TEXT,      \
      LABEL("Kind"))                                                                               \
    X(DWELL_ANGULAR_FREQUENCY, "angular_frequency",                                                \
      "angular frequency in the middle of those that the dwell determines", SI(ANGULAR_FREQUENCY), \
      LABEL("Angular frequency"), SPARSE)                                                          \
    NUMBER_AND_ERROR(X, DWELL_STORAGE, "storage_modulus", "storage modulus there",                 \
                     SI(STORAGE_MODULUS), "E′", .member = NULL)                                    \
    NUMBER_AND_ERROR(X, DWELL_LOSS, "loss_modulus", "loss modulus there", SI(LOSS_MODULUS), "E″",  \
                     .member = NULL)                                                               \
    X(DWELL_MISFIT, "misfit",                                                                      \
      "mean square residual over that of the noise of the baseline; above 1 the errors "           \
      "are wider by its root",                                                                     \
      NUMBER, LABEL("Misfit"), DIGITS(2), SPARSE)                                                  \
    X(DWELL_MISFIT_CHANCE, "misfit_p", "chance of more by noise alone", NUMBER, SPARSE)            \
    X(DWELL_LOAD_TIME, "load_time", "time from contact to the dwell", SI(TIME), SPARSE)            \
    X(DWELL_DURATION, "duration", "duration of the dwell", SI(TIME), SPARSE)                       \
    X(DWELL_FORCE_START, "force_start", "force at its beginning", SI(FORCE), SPARSE)               \
    X(DWELL_FORCE_END, "force_end", "force at its end", SI(FORCE), SPARSE)                         \
    X(DWELL_INDENTATION_START, "indentation_start", "indentation at its beginning",                \
      SI(INDENTATION), SPARSE)                                                                     \
    X(DWELL_INDENTATION_END, "indentation_end", "indentation at its end", SI(INDENTATION), SPARSE) \
    X(DWELL_AMPLITUDE, "amplitude", "amplitude of the indentation in a modulation",                \
      SI(INDENTATION), SPARSE)                                                                     \
    X(DWELL_NOTE, "note", "why there are no moduli, or what is odd", TEXT, LABEL("Note"))
#define DWELL_KEYS(X)                                                                              \
    X(DWELL_KEY_ANGULAR_FREQUENCY, "angular_frequency", SI(ANGULAR_FREQUENCY), OPTIONAL)           \
    X(DWELL_KEY_STORAGE, "storage_modulus", SI(STORAGE_MODULUS),                                   \
      HEADLINE("Storage modulus of the dwells"), OPTIONAL)                                         \
    X(DWELL_KEY_LOSS, "loss_modulus", SI(LOSS_MODULUS), HEADLINE("Loss modulus of the dwells"),    \
      OPTIONAL)                                                                                    \
    X(DWELL_KEY_UNITS, "n_units", PLAIN, OPTIONAL)

/* Means over logarithmic time intervals; each dwell is a block. */
#define DWELL_POINTS_COLUMNS(X)                                                                    \
    X(DWELL_POINTS_TIME, AS(time), "time from contact", SI(TIME))                                  \
    X(DWELL_POINTS_FORCE, AS(force), "force above the baseline", SI(FORCE))                        \
    X(DWELL_POINTS_INDENTATION, AS(indentation), "indentation depth", SI(INDENTATION))             \
    X(DWELL_POINTS_MODULUS, AS(modulus),                                                           \
      "of an elastic rubber with this force at this indentation; nan: it pulls, or is too deep",   \
      SI(MODULUS), SPARSE)                                                                         \
    X(DWELL_POINTS_FITTED, AS(fitted_modulus), "the same of what was fitted", SI(MODULUS), SPARSE) \
    X(DWELL_POINTS_FILE, AS(file), "file of the curve", TEXT)                                      \
    X(DWELL_POINTS_CURVE, AS(curve), "number of the curve in its file", NUMBER)
#define DWELL_POINTS_KEYS(X)

/* Each row is a frequency of a dwell; each dwell is a block. */
#define DWELL_MODULI_COLUMNS(X)                                                                    \
    X(DWELL_MODULI_FILE, AS(file), "file of the curve", TEXT)                                      \
    X(DWELL_MODULI_CURVE, AS(curve), "number of the curve in its file", NUMBER)                    \
    X(DWELL_MODULI_SEGMENT, AS(segment), "number of the segment in the curve", NUMBER)             \
    X(DWELL_MODULI_KIND, AS(kind), "relaxation, creep or modulation", TEXT)                        \
    X(DWELL_MODULI_ANGULAR_FREQUENCY, IN(moduli, angular_frequency), "angular frequency",          \
      SI(ANGULAR_FREQUENCY))                                                                       \
    COLUMN_AND_ERROR(X, DWELL_MODULI_STORAGE, "storage_modulus", "storage modulus",                \
                     SI(STORAGE_MODULUS), "E′", SHOWS(moduli.storage))                             \
    X(DWELL_MODULI_STORAGE_COMMON, "storage_modulus_common_error",                                 \
      "of its standard error, what curves of one kind share", SI(STORAGE_MODULUS),                 \
      SHOWS(moduli.storage_common_error))                                                          \
    COLUMN_AND_ERROR(X, DWELL_MODULI_LOSS, "loss_modulus", "loss modulus", SI(LOSS_MODULUS), "E″", \
                     SHOWS(moduli.loss))                                                           \
    X(DWELL_MODULI_LOSS_COMMON, "loss_modulus_common_error",                                       \
      "of its standard error, what curves of one kind share", SI(LOSS_MODULUS),                    \
      SHOWS(moduli.loss_common_error))
#define DWELL_MODULI_KEYS(X)

/* Means over several curves compared with the DMA; each group is a block. */
#define DWELL_DMA_COLUMNS(X)                                                                       \
    X(DWELL_DMA_GROUP, AS(group), "bulk or track", TEXT, LABEL("Group"))                           \
    X(DWELL_DMA_ANGULAR_FREQUENCY, IN(mean, angular_frequency), "angular frequency",               \
      SI(ANGULAR_FREQUENCY), LABEL("Angular frequency"))                                           \
    X(DWELL_DMA_N, IN(mean, n), "curves", NUMBER, LABEL("Curves"))                                 \
    X(DWELL_DMA_STORAGE, "storage_modulus", "mean storage modulus of the dwells",                  \
      SI(STORAGE_MODULUS), SHOWS(mean.storage), LABEL("E′"),                                       \
      INTERVAL(DWELL_DMA_STORAGE_LOW, DWELL_DMA_STORAGE_HIGH))                                     \
    INTERVAL_COLUMNS(X, DWELL_DMA_STORAGE, "storage_modulus_", SI(STORAGE_MODULUS),                \
                     LIKE(DWELL_DMA_STORAGE))                                                      \
    X(DWELL_DMA_LOSS, "loss_modulus", "mean loss modulus of the dwells", SI(LOSS_MODULUS),         \
      SHOWS(mean.loss), LABEL("E″"), INTERVAL(DWELL_DMA_LOSS_LOW, DWELL_DMA_LOSS_HIGH))            \
    INTERVAL_COLUMNS(X, DWELL_DMA_LOSS, "loss_modulus_", SI(LOSS_MODULUS), LIKE(DWELL_DMA_LOSS))   \
    NUMBER_AND_ERROR(X, DWELL_DMA_DMA_STORAGE, "dma_storage_modulus",                              \
                     "E' of the DMA at this frequency", SI(STORAGE_MODULUS), "DMA E′",             \
                     SHOWS(dma_storage))                                                           \
    NUMBER_AND_ERROR(X, DWELL_DMA_DMA_LOSS, "dma_loss_modulus",                                    \
                     "E'' of the DMA at this frequency", SI(LOSS_MODULUS), "DMA E″",               \
                     SHOWS(dma_loss))                                                              \
    X(DWELL_DMA_STORAGE_RATIO, AS(storage_ratio), "E' of the dwells over that of the DMA", NUMBER, \
      LABEL("E′ / DMA"), INTERVAL(DWELL_DMA_STORAGE_RATIO_LOW, DWELL_DMA_STORAGE_RATIO_HIGH),      \
      SPARSE)                                                                                      \
    INTERVAL_COLUMNS(X, DWELL_DMA_STORAGE_RATIO, "storage_ratio_", NUMBER, SPARSE)                 \
    X(DWELL_DMA_LOSS_RATIO, AS(loss_ratio), "E'' of the dwells over that of the DMA", NUMBER,      \
      LABEL("E″ / DMA"), INTERVAL(DWELL_DMA_LOSS_RATIO_LOW, DWELL_DMA_LOSS_RATIO_HIGH), SPARSE)    \
    INTERVAL_COLUMNS(X, DWELL_DMA_LOSS_RATIO, "loss_ratio_", NUMBER, SPARSE)                       \
    X(DWELL_DMA_EXTRAPOLATED, AS(extrapolated), "1: outside the frequencies measured by DMA",      \
      YES_NO, LABEL("Outside measured frequencies"), SPARSE)
#define DWELL_DMA_KEYS(X)                                                                          \
    X(DWELL_DMA_KEY_TEMPERATURE, AS(temperature), SI(TEMPERATURE))                                 \
    X(DWELL_DMA_KEY_TRACK_TEMPERATURE, AS(track_temperature), SI(TEMPERATURE), OPTIONAL)           \
    X(DWELL_DMA_KEY_ERROR_LACKS, "standard_error_excludes", ENUM(error_source), SHOWS(lacks),      \
      LABEL("No error known of"), OPTIONAL)                                                        \
    X(DWELL_DMA_KEY_MATERIAL_STATEMENT, AS(material_statement), TEXT, OPTIONAL)                    \
    X(DWELL_DMA_KEY_TRACK_STATEMENT, AS(track_statement), TEXT, OPTIONAL)

#endif
