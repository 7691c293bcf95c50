/* HDF5 files of force curves, behind the door (core/store/hdf5_sandbox.h): attributes and data sets
 * of files that may be damaged or made to do harm, and the way of their curves to text.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_CURVES_HDF5_H
#define WT_READ_CURVES_HDF5_H

#include "core/store/hdf5_sandbox.h"
#include "read/reader.h"

enum { HDF5_TEXT = 128, HDF5_NAME = 64 };

/* A number, or number i of a list; NaN if there is none. */
double hdf5_number(hid_t object, const char *attribute, size_t i);
/* A text, cut to fit; false and "" if there is none. */
bool hdf5_text(hid_t object, const char *attribute, char text[HDF5_TEXT]);
/* How many links a group has, or says that it has. */
size_t hdf5_links(hid_t group);
/* The name of link number i of a group, "" if it is too long; false if there is none. */
bool hdf5_link(hid_t group, size_t i, char name[HDF5_NAME]);
/* Opens a group or a data set by a name that hdf5_link gave, or that must be checked like one; -1
 * if it is none. */
hid_t hdf5_open_group(hid_t parent, const char *name);
hid_t hdf5_open_data(hid_t parent, const char *name);
/* As hdf5_open_data, of numbers that are read row by row. */
hid_t hdf5_open_rows(hid_t parent, const char *name);
/* How many numbers a data set of one dimension has; 0 if it is none or has more than a file of
 * `size` bytes can hold. */
size_t hdf5_count(hid_t data, size_t size);
/* Numbers [from, from + n), which are there. */
bool hdf5_rows(hid_t data, size_t from, size_t n, double *values);
/* All numbers of a data set of one dimension, new; NULL if it is none or has more than a file of
 * `size` bytes can hold. */
double *hdf5_values(hid_t data, size_t size, size_t *n);

/* ---- in front of the door ---------------------------------------------------------------------
 */

/* What a reader of such files says of them. */
typedef struct hdf5_curves {
    const char *words;   /* that its files hold, and those of others do not */
    hdf5_reading *print; /* its curves as text (curve_text.h) */
    const char *note;    /* for the log, or NULL */
} hdf5_curves;

recognition hdf5_detect(const file_reader *self, file_peek *peek);
wt_status hdf5_as_text(const file_reader *self, wt_input *input, wt_log *log, wt_input **text,
                       wt_error *err) WT_NODISCARD;
/* All of such a reader but its words for people; with text/text.h. */
#define READER_OF_HDF5_CURVES(curves)                                                              \
    READER_OF_CURVE_TEXT(hdf5_as_text), .hdf5 = &(curves), .detect = hdf5_detect,                  \
                                        .describe = text_describe_made

#endif
