/* Files that are part of the library: plot styles and the style sheet of the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_FILES_H
#define WT_REPORT_FILES_H

#include <stddef.h>

/* Text of "page.css", "paper.gp", ...; NULL if there is none of that name. Static. */
const char *report_file(const char *name);

#endif
