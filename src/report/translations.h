/* Available languages: languages/NAME.po in the library.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_TRANSLATIONS_H
#define WT_REPORT_TRANSLATIONS_H

#include "report/language.h"

/* Opens a language; NULL for English, which needs none. The caller closes it. For an unknown name
 * the error lists the languages. */
wt_status language_open(const char *name, language **l, wt_error *err) WT_NODISCARD;
void language_close(language *l);

/* Checks the language name of an option. */
wt_status language_check(const void *member, wt_error *err) WT_NODISCARD;

#endif
