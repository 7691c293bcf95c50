/* The columns and keys of the tables of dwells. Included by tables.h alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_TABLES_DWELL_H
#define WT_DATA_TABLES_DWELL_H

#include "data/tables/ramp.h" /* NUMBER_AND_INTERVAL */

/* A dwell of a curve in each row. */
#define DWELL_COLUMNS(X)                                                                           \
    X(DWELL_FILE, "file", "file of the curve", TEXT, LABEL("File"))                                \
    X(DWELL_CURVE, "curve", "number of the curve in its file", NUMBER, LABEL("Curve"))             \
    X(DWELL_SEGMENT, "segment", "number of the segment in the curve", NUMBER)                      \
    X(DWELL_KIND, "kind", "relaxation (height held) or creep (force held)", TEXT, LABEL("Kind"))   \
    X(DWELL_EXPONENT, "exponent", "exponent n of E(t) = E1 (t/1s)^-n", NUMBER, LABEL("Exponent"),  \
      SPARSE)                                                                                      \
    X(DWELL_MODULUS, "modulus_1s", "relaxation modulus E1 at 1 s by that law", SI(MODULUS),        \
      LABEL("Modulus at 1 s"), SPARSE)                                                             \
    X(DWELL_LOSS_FACTOR, "loss_factor", "loss factor of that law, tan(pi n/2)", SI(LOSS_FACTOR),   \
      LABEL("tan delta"), SPARSE)                                                                  \
    X(DWELL_MISFIT, "misfit", "root mean square of what the points are off, of the modulus",       \
      NUMBER, LABEL("Misfit"), DIGITS(2), SPARSE)                                                  \
    X(DWELL_LOAD_TIME, "load_time", "time from contact to the dwell", SI(TIME), SPARSE)            \
    X(DWELL_DURATION, "duration", "duration of the dwell", SI(TIME), SPARSE)                       \
    X(DWELL_FORCE_START, "force_start", "force at its beginning", SI(FORCE), SPARSE)               \
    X(DWELL_FORCE_END, "force_end", "force at its end", SI(FORCE), SPARSE)                         \
    X(DWELL_INDENTATION_START, "indentation_start", "indentation at its beginning",                \
      SI(INDENTATION), SPARSE)                                                                     \
    X(DWELL_INDENTATION_END, "indentation_end", "indentation at its end", SI(INDENTATION), SPARSE) \
    X(DWELL_NOTE, "note", "why there is no law", TEXT, LABEL("Note"))
#define DWELL_KEYS(X)                                                                              \
    X(DWELL_KEY_EXPONENT, "exponent", UNIT("1"), HEADLINE("Exponent of the dwells"), OPTIONAL)     \
    X(DWELL_KEY_MODULUS, "modulus_1s", SI(MODULUS), HEADLINE("Modulus at 1 s of the dwells"),      \
      OPTIONAL)                                                                                    \
    X(DWELL_KEY_UNITS, "n_units", PLAIN, OPTIONAL)

/* Means over times that grow by one factor; a dwell is a block. */
#define DWELL_POINTS_COLUMNS(X)                                                                    \
    X(DWELL_POINTS_TIME, "time", "time from contact", SI(TIME))                                    \
    X(DWELL_POINTS_FORCE, "force", "force above the baseline", SI(FORCE))                          \
    X(DWELL_POINTS_INDENTATION, "indentation", "indentation depth", SI(INDENTATION))               \
    X(DWELL_POINTS_MODULUS, "modulus", "of an elastic rubber with this force at this indentation", \
      SI(MODULUS))                                                                                 \
    X(DWELL_POINTS_FITTED, "fitted_modulus", "the same of the power law", SI(MODULUS), SPARSE)     \
    X(DWELL_POINTS_ANGULAR_FREQUENCY, "angular_frequency", "angular frequency 1/time",             \
      SI(ANGULAR_FREQUENCY))                                                                       \
    X(DWELL_POINTS_STORAGE, "storage_modulus", "storage modulus of the power law there",           \
      SI(STORAGE_MODULUS), SPARSE)                                                                 \
    X(DWELL_POINTS_LOSS, "loss_modulus", "loss modulus of the power law there", SI(LOSS_MODULUS),  \
      SPARSE)                                                                                      \
    X(DWELL_POINTS_FILE, "file", "file of the curve", TEXT)                                        \
    X(DWELL_POINTS_CURVE, "curve", "number of the curve in its file", NUMBER)
#define DWELL_POINTS_KEYS(X)

#endif
