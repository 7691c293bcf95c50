/* Data of the page for browsing curves.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_BROWSE_H
#define WT_REPORT_BROWSE_H

#include "report/report_tables.h"
#include "report/report_text.h"

/* Appends the curves of all groups, their samples and the earlier manual choices as JSON that is
 * safe inside a script element. */
void append_browse_data(const figure_tables *tables, text_buffer *to);

#endif
