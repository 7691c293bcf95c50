/* Run a few lines of this thread under the C locale, so that printf and strtod use a decimal point
 * whatever the program has set. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_BASE_CLOCALE_H
#define WT_BASE_CLOCALE_H

#include <locale.h>

/* Returns what wt_clocale_leave needs. Calls nest; only the calling thread is affected. */
locale_t wt_clocale_enter(void);
void wt_clocale_leave(locale_t previous);

#endif
