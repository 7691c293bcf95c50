/* Measurements in this program's own HDF5 files, weartrack-hdf5(5), as `weartrack convert` writes
 * them. The tables are those of the text stream, so they are read by its description.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_STORED_H
#define WT_READ_STORED_H

#include "read/text/text.h"

/* `stream` is the description of the text stream, borrowed. */
detector_match stored_detect(const file_peek *peek);
wt_status stored_open_force(const text_description *stream, wt_input *input,
                            const wt_read_options *options, wt_parselog *log,
                            wt_force_source **source, wt_error *err);
wt_status stored_read_sweep(const text_description *stream, wt_input *input,
                            const wt_read_options *options, wt_parselog *log, wt_sweep *sweep,
                            wt_error *err);
wt_status stored_read_spectrum(const text_description *stream, wt_input *input,
                               const wt_read_options *options, wt_parselog *log,
                               wt_power_spectrum *spectrum, wt_error *err);
wt_status stored_describe(const text_description *stream, wt_input *input,
                          const wt_read_options *options, wt_parselog *log, wt_table *facts,
                          wt_error *err);

#endif
