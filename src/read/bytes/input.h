/* An input of bytes that were made, not read, and one within another. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_READ_INPUT_H
#define WT_READ_INPUT_H

#include "weartrack/read.h"

/* Takes the bytes, from malloc, also on failure. */
wt_status input_own(char *bytes, size_t length, const char *name, wt_input **input,
                    wt_error *err) WT_NODISCARD;

/* Takes an open file of so many bytes, which only this program has, also on failure. */
wt_status input_of_file(int file, size_t size, const char *name, wt_input **input,
                        wt_error *err) WT_NODISCARD;

/* The descriptor of a file that is not yet read as a whole, or -1; of the input. */
int input_file(const wt_input *input);

/* What was unpacked from it; closed with it. */
void input_keep(wt_input *input, wt_input *content);
/* What was kept last, of that what it keeps itself, and so on; the input itself if it keeps
 * nothing. */
wt_input *input_content(wt_input *input);

#endif
