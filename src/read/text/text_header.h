/* Declares the processing of lines before, between and after tables.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_TEXT_HEADER_H
#define WT_READ_TEXT_HEADER_H

#include "read/text/text_scanner.h"

/* Reads the header values of the line. */
void scan_header_fields(text_scanner *s);
/* True if the line is a marker of a step, an end or a segment. */
bool scan_match_markers(text_scanner *s);
/* Stores the title of a step without a names row. */
void scan_finish_step(text_scanner *s);

/* Warns if fewer rows exist than the header states, and resets the counts. */
void scan_check_row_count(text_scanner *s);

#endif
