/* Declares the reader of Nanosurf Studio files (.nhf, HDF5) of versions 1.1 and 2. It runs in the
 * sandbox. The format is known from the readers of other programs; no genuine file was available.
 *
 * A group of the file is a measurement. Its groups are the segments, named by "name" in version 1
 * and "segment_name" in version 2. Their data sets are the channels. One data set contains all
 * curves of a map; another one states the number of samples of each. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_READ_NHF_H
#define WT_READ_NHF_H

#include "read/force_assembler.h"
#include "read/hierarchy/curves_hdf5.h"

typedef struct nhf_file {
    hid_t file;
    size_t size;
    bool old;          /* version 1 */
    hid_t calibration; /* group of the calibration nodes; -1 if there is none */
} nhf_file;

/* A channel of all curves, with the values of one of them. */
typedef struct nhf_channel {
    wt_quantity quantity;
    hid_t data;
    size_t n;             /* number of samples of all curves */
    double missing;       /* stored number that means missing, or NaN */
    force_linear scaling; /* from the stored numbers to the unit of the file */
    double factor;        /* to the unit of the quantity; negative if the sign is reversed */
    double *values;       /* values of the current curve */
    size_t capacity;
} nhf_channel;

#endif
