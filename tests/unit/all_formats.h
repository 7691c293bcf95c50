/* One set of formats for all tests of a program, because its creation reads every description.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_ALL_FORMATS_H
#define WT_TESTS_ALL_FORMATS_H

#include "weartrack/read.h"

static wt_formats *formats;

static inline int open_formats(void **state)
{
    (void)state;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK ? 0 : -1;
}

static inline int free_formats(void **state)
{
    (void)state;
    wt_formats_free(formats);
    return 0;
}

#endif
