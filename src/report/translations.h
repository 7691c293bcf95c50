/* The languages that there are: a catalogue each, languages/NAME.po in the library.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_TRANSLATIONS_H
#define WT_REPORT_TRANSLATIONS_H

#include "report/language.h"

/* NULL for English, which needs none. To be closed; of an unknown name the error says which there
 * are. */
wt_status language_open(const char *name, language **l, wt_error *err) WT_NODISCARD;
void language_close(language *l);

/* Of an option: whether the language of that name is one of them. */
wt_status language_check(const void *member, wt_error *err) WT_NODISCARD;

#endif
