/* Pauses of a friction record: rest in mid-record, which is no time of sliding. Internal.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_NUMERICS_PAUSES_H
#define WT_RECORD_NUMERICS_PAUSES_H

#include "weartrack/data.h"

typedef struct record_pause {
    size_t before; /* the sample, of those that are left, that it was before */
    double at;     /* [s] of sliding, where it was */
    double time;   /* [s] that it lasted */
} record_pause;

typedef struct record_pauses {
    record_pause *of; /* [n], rising; freed with free() */
    size_t n;
    size_t alike; /* gaps in the time that are many and alike: of the recorder, and left in */
} record_pauses;

/* Takes them out: samples at rest go, and time, distance and laps run on without them. What stands
 * still before sliding begins, after it ends or for a whole step of the instrument stays. */
wt_status record_leave_out_pauses(wt_record *record, record_pauses *pauses,
                                  wt_error *err) WT_NODISCARD;

#endif
