/* Switches the locale of the calling thread to the C locale, so that printf and strtod use a
 * decimal point in any program. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_CLOCALE_H
#define WT_CORE_BASE_CLOCALE_H

#include "weartrack/core.h"

#include <locale.h>
#include <stdarg.h>

/* Returns the argument for clocale_leave. Calls nest and affect only the calling thread. */
locale_t clocale_enter(void);
void clocale_leave(locale_t previous);

/* snprintf and vsnprintf in the C locale, for every text with a decimal fraction. */
int clocale_print(char *buffer, size_t size, const char *format, ...) WT_PRINTF(3, 4);
int clocale_vprint(char *buffer, size_t size, const char *format, va_list arguments)
    WT_PRINTF(3, 0);
/* Appends to a text; what does not fit is truncated. */
void clocale_append(char *text, size_t size, const char *format, ...) WT_PRINTF(3, 4);

#endif
