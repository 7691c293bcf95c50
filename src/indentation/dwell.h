/* What the held segments of a curve tell, and means over several curves. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_DWELL_H
#define WT_INDENTATION_DWELL_H

#include "weartrack/flow.h"

/* At one frequency: of curves, or of files where there are three or more. The interval holds the
 * scatter and what all of them have in common, that of one curve its own error; NaN where no curve
 * is described. */
typedef struct dwell_mean {
    double angular_frequency;
    size_t n, n_units;
    wt_interval storage, loss;
} dwell_mean;

/* Of a table dwell_moduli, with rising frequency; *means to be freed. */
wt_status dwell_means(const wt_table *moduli, dwell_mean **means, size_t *n,
                      wt_error *err) WT_NODISCARD;

/* A modulation: of a held segment, or of one before the approach or behind the retract. */
typedef struct dwell_modulated {
    const wt_segment *segment;
    wt_modulation sine;
    wt_dwell_moduli moduli;
    bool found;
    double indentation, above, amplitude; /* mean, force above the baseline, of the indentation */
    const char *note;                     /* static */
} dwell_modulated;

/* Modulations of one curve that there is room for; JPK has as many segments as a person sets. */
enum { DWELL_MOST_MODULATED = 32 };
typedef struct dwell_curve {
    wt_dwell dwell; /* of all held segments together, sines taken out */
    dwell_modulated modulated[DWELL_MOST_MODULATED], air[DWELL_MOST_MODULATED];
    size_t n, n_air;
} dwell_curve;

/* The segments from `first` on up to the retract behind an approach that was fitted. */
wt_status dwell_curve_fit(const wt_contact_table *contact, double poisson,
                          const wt_force_curve *curve, const wt_segment *approach,
                          const wt_segment *first, const wt_indent_fit *fit, dwell_curve *to,
                          wt_error *err) WT_NODISCARD;
/* E' is positive, and E'' positive or around 0 by its error: no rubber has others, and what gives
 * them is another thing than was fitted. An E'' around 0 is left in, for the means of many curves
 * would be too large without it. */
bool dwell_is_modulus(const wt_dwell_moduli *moduli);
/* A dwell or a modulation with samples. */
bool dwell_is_held(const wt_segment *segment);

#endif
