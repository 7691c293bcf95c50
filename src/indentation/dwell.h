/* Moduli from the held segments of a curve, and their means over several curves. Internal to
 * indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_DWELL_H
#define WT_INDENTATION_DWELL_H

#include "weartrack/indentation.h"

/* Mean at one frequency over curves, or over files if there are three or more. The interval
 * includes the scatter and the systematic error. The interval of a single curve includes its
 * standard error. It is NaN if no curve is described. */
typedef struct dwell_mean {
    double angular_frequency;
    size_t n, n_units;
    wt_interval storage, loss;
} dwell_mean;

/* Computes means of a table dwell_moduli by rising frequency. The caller frees *means. */
wt_status dwell_means(const wt_table *moduli, dwell_mean **means, size_t *n,
                      wt_error *err) WT_NODISCARD;

/* Modulation of a held segment, or of a segment before the approach or after the retract. */
typedef struct dwell_modulation {
    const wt_segment *segment;
    wt_modulation sine;
    wt_dwell_moduli moduli;
    bool found;
    double indentation, above, amplitude; /* mean indentation [m], force above the baseline [N],
                                             amplitude of the indentation [m] */
    const char *note;                     /* static string */
} dwell_modulation;

/* Largest number of modulations of one curve. The user of a JPK instrument sets the number of
 * segments. */
enum { DWELL_MAX_MODULATIONS = 32 };

typedef struct dwell_curve {
    wt_dwell dwell; /* all held segments combined, without the sines */
    dwell_modulation modulations[DWELL_MAX_MODULATIONS], air[DWELL_MAX_MODULATIONS];
    size_t n, n_air;
} dwell_curve;

#endif
