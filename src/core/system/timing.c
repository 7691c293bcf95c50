/* Wall time and processor time. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/core.h"

#include <time.h>

static double clock_seconds(clockid_t clock)
{
    struct timespec t = {0, 0};
    (void)clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double wt_time_wall(void)
{
    return clock_seconds(CLOCK_MONOTONIC);
}

double wt_time_cpu(void)
{
    return clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
}
