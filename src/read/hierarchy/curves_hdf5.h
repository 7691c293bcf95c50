/* Declares access to HDF5 files of force curves in the sandbox (core/store/hdf5_sandbox.h), where
 * the files may be damaged or malicious. The curves leave the sandbox as text.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_CURVES_HDF5_H
#define WT_READ_CURVES_HDF5_H

#include "core/store/hdf5_sandbox.h"
#include "read/reader.h"

enum { HDF5_TEXT = 128, HDF5_NAME = 64 };

/* Returns number i of an attribute; NaN if there is none. */
double hdf5_number_attribute(hid_t object, const char *attribute, size_t i);
/* Reads a text attribute, cut to fit; false and "" if there is none. */
bool hdf5_text_attribute(hid_t object, const char *attribute, char text[HDF5_TEXT]);
/* Returns the number of links that a group has or states. */
size_t hdf5_link_count(hid_t group);
/* Reads the name of link i of a group, "" if it is too long; false if there is none. */
bool hdf5_link_name(hid_t group, size_t i, char name[HDF5_NAME]);
/* Opens a group or a data set by name; the name is checked. Returns -1 if there is none. */
hid_t hdf5_open_group(hid_t parent, const char *name);
hid_t hdf5_open_data(hid_t parent, const char *name);
/* Variant of hdf5_open_data for numbers that are read by rows. */
hid_t hdf5_open_rows(hid_t parent, const char *name);
/* Returns the length of a one-dimensional data set of numbers. It is 0 for another data set, or for
 * more numbers than a file of `size` bytes can contain. */
size_t hdf5_value_count(hid_t data, size_t size);
/* Reads the numbers [from, from + n), which exist. */
bool hdf5_read_rows(hid_t data, size_t from, size_t n, double *values);
/* Reads all numbers of a one-dimensional data set; the caller frees them. NULL under the conditions
 * of hdf5_value_count. */
double *hdf5_read_values(hid_t data, size_t size, size_t *n);

/* ---- outside of the sandbox ------------------------------------------------------------------ */

/* Properties of a reader of HDF5 curves. */
typedef struct hdf5_curves {
    const char *keywords;      /* text that occurs in its files and in no others */
    hdf5_read_function *print; /* prints the curves as text (curve_text.h) */
    const char *note;          /* note for the log, or NULL */
} hdf5_curves;

recognition hdf5_detect(const file_reader *self, file_peek *peek);
wt_status hdf5_as_text(const file_reader *self, wt_input *input, wt_log *log, wt_input **text,
                       wt_error *err) WT_NODISCARD;
/* All members of such a reader except for `info`. It needs text/text.h. */
#define HDF5_CURVES_READER(curves)                                                                 \
    CURVE_TEXT_READER(hdf5_as_text), .hdf5 = &(curves), .detect = hdf5_detect,                     \
                                     .describe = text_describe_converted

#endif
