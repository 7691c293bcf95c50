/* Nanosurf Studio files (.nhf, HDF5) of version 1.1 and 2: what the parts of the reader share, all
 * of it behind the door. Known from the readers of other programs; no genuine file was at hand.
 *
 * A group of the file is a measurement, its groups are the segments (in version 1 "name" says
 * which, in version 2 "segment_name"), whose data sets are the channels. All curves of a map stand
 * one behind the other in one data set; another one says how many samples each has.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_NHF_H
#define WT_READ_NHF_H

#include "read/force_assembler.h"
#include "read/hierarchy/curves_hdf5.h"

typedef struct nhf_file {
    hid_t file;
    size_t size;
    bool old;          /* version 1 */
    hid_t calibration; /* group of the nodes; -1 if there is none */
} nhf_file;

/* A channel of all curves, of which one is at hand. */
typedef struct nhf_channel {
    wt_quantity quantity;
    hid_t data;
    size_t n;             /* numbers of all curves */
    double missing;       /* the number that stands for none, or NaN */
    force_linear scaling; /* from what is stored */
    double factor;        /* from its unit to that of the quantity; negative if it is turned */
    double *values;       /* [room] of the curve */
    size_t room;
} nhf_channel;

/* The channel of a segment whose name is known and whose numbers and unit are understood, to be
 * closed; false if it is none of them. What it is instead is said in *problem if it hinders. */
bool nhf_channel_open(const nhf_file *f, hid_t segment, const char *name, nhf_channel *channel,
                      const char **problem);
/* Has numbers [from, from + n), which are there, at hand; false if they cannot be read. */
wt_status nhf_channel_take(nhf_channel *channel, size_t from, size_t n, wt_error *err);
void nhf_channel_close(nhf_channel *channel);
/* Lateral positions in metres, new; NULL if what the numbers mean is not understood. */
double *nhf_places_read(const nhf_file *f, hid_t data, size_t *n);

#endif
