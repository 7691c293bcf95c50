/* Declares inputs of computed bytes, and an input that contains another one.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_INPUT_H
#define WT_READ_INPUT_H

#include "weartrack/read.h"

/* Creates an input from malloc'ed bytes and takes ownership of them, also on failure. */
wt_status input_from_bytes(char *bytes, size_t length, const char *name, wt_input **input,
                           wt_error *err) WT_NODISCARD;

/* Creates an input from an open file of `size` bytes and takes ownership of the descriptor, also on
 * failure. No other program writes to the file. */
wt_status input_from_file(int file, size_t size, const char *name, wt_input **input,
                          wt_error *err) WT_NODISCARD;

/* Returns the bytes for HDF5 (core/store/hdf5_bytes.h). They belong to the input, which must
 * outlive them, or to its file if the input is not yet complete in memory. */
struct hdf5_bytes;
wt_status input_hdf5_bytes(wt_input *input, struct hdf5_bytes *bytes, wt_error *err) WT_NODISCARD;

/* Attaches the unpacked content to the input, which then owns it. */
void input_attach_content(wt_input *input, wt_input *content);
/* Returns the innermost attached content; the input itself if it has none. */
wt_input *input_content(wt_input *input);

#endif
