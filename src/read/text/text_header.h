/* Lines before, between and behind tables. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_HEADER_H
#define WT_READ_TEXT_HEADER_H

#include "read/text/text_scanner.h"

/* Header values on the line. */
void scan_fields(text_scanner *s);
/* Is the line a marker of a step, an end or a segment? */
bool scan_marks(text_scanner *s);
/* A step that never showed a names row is remembered by its title. */
void scan_finish_step(text_scanner *s);

/* Warns of rows that are missing of those that the header said; done with it. */
void scan_check_rows(text_scanner *s);

#endif
