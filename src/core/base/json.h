/* Texts of JSON. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_JSON_H
#define WT_CORE_BASE_JSON_H

#include <stdio.h>

/* In quotes, what JSON cannot have escaped; bytes that are not UTF-8 become U+FFFD. */
void json_put_text(FILE *out, const char *text);

#endif
