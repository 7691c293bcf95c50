/* Contact cases with 12 digits, from a file of reference values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_REFERENCE_CONTACT_H
#define WT_TESTS_REFERENCE_CONTACT_H

#include "assert_near.h"

#include "weartrack/indentation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char text[1 << 16];

/* Number after the next "key": before `end`; NaN if there is none. */
static inline double number(const char **at, const char *key, const char *end)
{
    char quoted[64];
    snprintf(quoted, sizeof quoted, "\"%s\":", key);
    const char *found = strstr(*at, quoted);
    if (found == NULL || (end != NULL && found > end))
        return (double)NAN;
    *at = found + strlen(quoted);
    return strtod(*at + strspn(*at, " \n["), NULL);
}

static inline double number_in(const char *at, const char *key, const char *end)
{
    return number(&at, key, end);
}

static inline wt_tip read_tip(const char *at, const char *end)
{
    const double degrees = number_in(at, "deg", end);
    wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = number_in(at, "R", end)};
    if (isnan(degrees))
        return tip;
    tip.half_angle = degrees * M_PI / 180.0;
    tip.shape = WT_TIP_CONE;
    if (isnan(tip.radius))
        return tip;
    tip.shape = WT_TIP_BLUNTED_PYRAMID;
    tip.sides = (unsigned)number_in(at, "n", end);
    tip.transition_radius = number_in(at, "b", end);
    return tip;
}

/* Checks each case, up to the start of the next one; returns the number of checks. Skips the test
 * without the file. */
static inline int check_reference(const char *path, int (*check)(const char *at, const char *next))
{
    int n = 0;
    FILE *file = fopen(path, "r");
    if (file == NULL)
        skip();
    assert_true(fread(text, 1, sizeof text - 1, file) > 1000);
    fclose(file);
    for (const char *at = text; (at = strstr(at, "\"id\":")) != NULL; at += 5)
        n += check(at, strstr(at + 5, "\"id\":"));
    return n;
}

#endif
