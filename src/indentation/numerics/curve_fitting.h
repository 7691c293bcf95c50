/* Inside the fit room: one curve on its way from samples to a verdict.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_CURVE_FITTING_H
#define WT_INDENTATION_NUMERICS_CURVE_FITTING_H

#include "indentation/numerics/curve.h"

/* A pull, in noise of the baseline: white noise gets there once in 1e9 samples, and maps have 1e8.
 */
#define CURVE_PULL_NOISE 6.0
/* And against the deepest pull elsewhere: two waves of one drift differ by less. */
#define CURVE_PULL_REST 1.5
enum { CURVE_BASELINE_SAMPLES = 10, CURVE_CONTACT_SAMPLES = 8 }; /* least */

typedef struct curve_snap {
    size_t start, deepest, end; /* the first sample below the baseline, and the first above again */
    double pull;                /* 0: there is none */
} curve_snap;

/* The way out as if it went in, above its baseline; n 0: none that can be fitted. */
typedef struct curve_way_out {
    curve_samples samples;
    size_t jump; /* the first in contact behind a pull-off; 0: none is seen */
} curve_way_out;

/* Another fit: by how much its modulus is larger than that which is taken, over it, and how likely
 * it is the right one of both. */
typedef struct curve_other {
    double moved, chance;
} curve_other;

typedef struct curve_fitting {
    const wt_contact_table *table;
    const wt_indent_options *options;
    const curve_branch *approach;
    wt_indent_workspace *workspace;
    curve_input input;
    curve_kind kind;
    curve_solution solution;
    curve_minimum minima[CURVE_MAX_MINIMA];
    size_t n_minima;
    curve_snap snap;
    double snap_on;  /* pull before contact [N]; 0: none stands out */
    double pull_off; /* of the retract; 0: none stands out, NaN: no retract that tells */
    double loss;     /* work that is lost on the way out, of that on the way in; NaN: no retract */
    double loss_power; /* of time, of a memory that loses as much; 0: none; NaN: not known */
    double loss_bias;  /* what a fit without it has more, of the modulus */
    double loss_shift, loss_error; /* of the modulus: what other spectra have more, and its error */
    curve_way_out way_out;
    size_t n_snap; /* samples left out because of a snap-on */
    bool range_settled;
    bool range_empty;      /* too few samples in it: the fit is that of all */
    bool another_rubber;   /* than that of the spectrum */
    bool below_saturation; /* all that is fitted: up to the limit of the options */
    bool unknown_loss;     /* it loses work, and the law of the fit does not describe it */
    /* Of another law of adhesion, of a second contact point, and what that adds to the error of the
     * modulus, over it. */
    curve_other other_law, other_contact;
    double contact_error;
    double unit; /* with memory: |E*| of the spectrum that a modulus of the solution is in */
} curve_fitting;

/* The fitted baseline at a position. */
static inline double curve_baseline(const curve_solution *s, double position)
{
    return s->p[CURVE_F0] + s->p[CURVE_T] * (position - s->p[CURVE_C]);
}

/* Scan and refinement on the samples as they are now, with memory where a spectrum is given; false
 * if nothing but a baseline is found. */
bool curve_scan_and_refine(curve_fitting *f);
/* Makes the memory ready for the samples: that of a series, its times in loading times or in
 * seconds. False if the times of the samples are not known. */
bool curve_remember(curve_fitting *f, const wt_prony *series, bool in_loading_times);
/* Does noise alone explain the residual? True where there is too little baseline to say. */
bool curve_fits(const curve_fitting *f);

/* ---- interference: curve_interference.c --------------------------------------------------------
 */

/* From a fit of all samples: where the baseline shows a sine, fits it, too. False if nothing but a
 * baseline is found then. */
bool curve_fit_interference(curve_fitting *f);
/* Takes the wave out of the forces, with its phase that of the height, for a scan or a fit that
 * begins with it. */
void curve_begin_wave(curve_fitting *f, const curve_wave *wave);

/* ---- range of the fit: curve_range.c -----------------------------------------------------------
 */

/* Fits the range of the options, from a fit of all samples. False if nothing but a baseline is
 * found then. */
bool curve_fit_range(curve_fitting *f);
/* Samples in contact that are compared. */
size_t curve_in_range(const curve_fitting *f);

/* Contact points by other estimators less that of the fit, of all samples: curve_estimators.c. */
void curve_estimate_contact(curve_fitting *f, double contact[WT_CONTACT_ESTIMATORS]);

/* ---- the way out: retract.c ---- */

/* pull_off and loss of a retract that comes free of the sample. height, force: as measured. */
void curve_read_retract(curve_fitting *f, const double *height, const double *force, size_t n);

/* ---- the way out fitted: retract_fit.c ---- */

/* A contact law, of this kind but with its own parameters, fitted to the way out. False if there is
 * none. Leaves the workspace as that of this fit. */
bool curve_fit_way_out(const curve_fitting *f, const curve_kind *kind, const curve_solution *in,
                       curve_solution *out);

/* What the retract alone says, and in the reason of a usable curve, if no work is lost, where that
 * is another modulus. Destroys the fit. */
void curve_report_way_out(curve_fitting *f, wt_indent_fit *fit);

/* ---- snap-on: snap_on.c ---- */

/* A pull right before the force rises that stands out of everything before it: the baseline of the
 * solution becomes the line through what is before. */
bool curve_find_snap(curve_fitting *f, curve_snap *found);
/* Where a pull begins that goes on to sample `at` of forces above the baseline, of which the first
 * half is free of it; noise: of successive samples. */
size_t curve_tail_start(const double *above, size_t at, double noise);
/* Of the samples, those from start to before end. */
void curve_leave_out(curve_fitting *f, size_t start, size_t end);

/* ---- adhesion: adhesion.c ---- */

/* From a fit without adhesion: finds a snap-on, and where it or the retract says that there is
 * adhesion, fits adhesive contact; if that does not describe the curve, the pull is left out. False
 * if nothing but a baseline is found then. */
bool curve_fit_adhesion(curve_fitting *f);

/* ---- loss without a spectrum: curve_loss.c --------------------------------------------------- */

/* Where the retract shows loss, finds its bias. */
void curve_allow_loss(curve_fitting *f);
/* Loss under a punch, without a spectrum: other spectra that lose as much scatter more there than
 * the error that is stated for the other tips. */
bool curve_unknown_loss(const curve_fitting *f);

/* ---- verdict: curve_assess.c ------------------------------------------------------------------
 */

/* What the law misses goes into the parameters and their errors: misfit.c. */
void curve_add_misfit(curve_fitting *f);

/* A curve of which nothing but a baseline was found. */
wt_curve_verdict curve_no_contact(curve_fitting *f, char reason[160]);
/* Does the curve look more like a contact when it is run backwards? Destroys the samples then. */
bool curve_leaves_the_sample(curve_fitting *f, char reason[160]);
/* To a reason, whole or not at all. */
void curve_append_note(char reason[160], const char *text);
/* The verdict on a fit, with its reason. */
wt_curve_verdict curve_assess(curve_fitting *f, wt_indent_fit *fit);
/* Force up to which a saturated curve may be fitted [N]. */
double curve_linear_to(const curve_fitting *f);
/* To the reason of a refusal: what the verdict on the forces below is. */
void curve_judge_nothing_below(double limit, wt_curve_verdict below, char reason[160]);

#endif
