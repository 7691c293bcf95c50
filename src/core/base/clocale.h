/* Run a few lines of this thread under the C locale, so that printf and strtod use a decimal point
 * whatever the program has set. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_CLOCALE_H
#define WT_CORE_BASE_CLOCALE_H

#include "weartrack/base.h"

#include <locale.h>
#include <stdarg.h>

/* Returns what clocale_leave needs. Calls nest; only the calling thread is affected. */
locale_t clocale_enter(void);
void clocale_leave(locale_t previous);

/* snprintf and vsnprintf under the C locale: for every text with a number that is not whole. */
int clocale_print(char *buffer, size_t size, const char *format, ...) WT_PRINTF(3, 4);
int clocale_vprint(char *buffer, size_t size, const char *format, va_list arguments)
    WT_PRINTF(3, 0);
/* Behind what stands in the text; what does not fit is cut. */
void clocale_append(char *text, size_t size, const char *format, ...) WT_PRINTF(3, 4);

#endif
