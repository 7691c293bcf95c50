/* Pauses of a friction record: rests within the record, which are not sliding time. Internal to
 * record.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_PAUSES_H
#define WT_RECORD_NUMERICS_PAUSES_H

#include "weartrack/core.h"

typedef struct record_pause {
    size_t before; /* sample that follows the pause, counted without removed samples */
    double at;     /* [s] sliding time of the pause */
    double time;   /* [s] duration */
} record_pause;

typedef struct record_pauses {
    record_pause *of; /* [n] ascending; released with free() */
    size_t n;
    size_t alike; /* number of equal time gaps that belong to the recorder and stay */
} record_pauses;

/* Removes the samples of pauses; time, distance and laps continue without them. Rests before
 * sliding begins, after it ends or over a whole instrument step stay. */
record_pauses record_remove_pauses(wt_record *record);

#endif
