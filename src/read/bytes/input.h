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

/* Where HDF5 finds the bytes (core/store/hdf5_bytes.h): in the input, which must outlive them, or
 * in its file if that is not yet read as a whole. */
struct hdf5_bytes;
wt_status input_hdf5(wt_input *input, struct hdf5_bytes *bytes, wt_error *err) WT_NODISCARD;

/* What was unpacked from it; closed with it. */
void input_keep(wt_input *input, wt_input *content);
/* What was kept last, of that what it keeps itself, and so on; the input itself if it keeps
 * nothing. */
wt_input *input_content(wt_input *input);

#endif
