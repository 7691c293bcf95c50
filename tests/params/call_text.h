/* Calls as text. An option may be given once, so the old one is removed before another value is
 * added.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TEST_CALL_TEXT_H
#define WT_TEST_CALL_TEXT_H

#include <stdio.h>
#include <string.h>

/* Removes " --name 'value'", " --name value" or " --name" from a call. */
static inline void drop_option(char *call, const char *name)
{
    char option[96];
    const int n = snprintf(option, sizeof option, " --%s", name);
    for (char *at = call; (at = strstr(at, option)) != NULL;) {
        char *end = at + n;
        if (*end != ' ' && *end != '\0') {
            at = end; /* a longer name */
            continue;
        }
        if (end[0] == ' ' && end[1] == '\'')
            end += 2 + strcspn(end + 2, "'") + 1;
        else if (end[0] == ' ' && strncmp(end, " --", 3) != 0)
            end += 1 + strcspn(end + 1, " ");
        memmove(at, end, strlen(end) + 1);
    }
}

#endif
