/* Writes JSON strings. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_JSON_H
#define WT_CORE_BASE_JSON_H

#include <stdio.h>

/* Writes a text in quotes with the JSON escapes. A byte that is not UTF-8 becomes U+FFFD. */
void json_write_text(FILE *out, const char *text);

#endif
