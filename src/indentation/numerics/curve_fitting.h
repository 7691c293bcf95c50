/* State of the fit of one curve, from samples to the verdict.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_CURVE_FITTING_H
#define WT_INDENTATION_NUMERICS_CURVE_FITTING_H

#include "indentation/law/tip.h"
#include "indentation/numerics/curve.h"

/* Smallest significant pull over the noise of the baseline. White noise reaches it once in 1e9
 * samples; maps have 1e8. */
#define CURVE_PULL_NOISE 6.0

/* Smallest ratio to the deepest pull elsewhere. Two oscillations of one drift differ by less. */
#define CURVE_PULL_RATIO 1.5

enum { CURVE_BASELINE_SAMPLES = 10, CURVE_CONTACT_SAMPLES = 8 }; /* smallest numbers */

typedef struct curve_snap {
    size_t start, deepest, end; /* first sample below the baseline, deepest sample, first sample
                                   above the baseline again */
    double pull;                /* pull [N]; 0 if there is none */
} curve_snap;

/* Retract reversed in time, with forces above its baseline. n is 0 if it cannot be fitted. */
typedef struct curve_unloading {
    curve_samples samples;
    size_t jump; /* first sample in contact after the pull-off; 0 without a pull-off */
} curve_unloading;

typedef struct curve_fitting {
    const wt_contact_table *table;
    const wt_indent_options *options;
    const curve_branch *approach;
    wt_indent_workspace *workspace;
    double contact; /* tip position of contact in a first fit; NaN: there was none */
    curve_input input;
    curve_kind kind;
    curve_solution solution;
    curve_minimum minima[CURVE_MAX_MINIMA];
    size_t n_minima;
    curve_snap snap;
    double largest_cost; /* of a law of adhesion that can win */
    double snap_in_pull; /* pull before contact [N]; 0 if none is significant */
    double pull_off;   /* pull of the retract [N]; 0 if none is significant, NaN without a suitable
                          retract */
    double loss;       /* hysteresis loss over the work of the approach; NaN without a retract */
    double loss_power; /* exponent of a relaxation with the same loss; 0: no loss; NaN: not known */
    double loss_bias;  /* relative excess of the modulus of a fit without loss */
    double loss_shift,
        loss_error; /* mean relative excess of the modulus with other spectra, and its error */
    curve_unloading unloading;
    size_t n_snap; /* samples excluded because of a snap-in */
    bool range_converged;
    bool range_empty;       /* too few samples in the range; the fit uses all samples */
    bool spectrum_mismatch; /* the spectrum of the options does not describe the curve */
    bool below_saturation;  /* the fit only covers forces up to the limit of the options */
    bool misfit_is_named;   /* the reason of the verdict names the misfit, */
    bool bend_is_named;     /* and the bent baseline as its cause */
    bool without_adhesion;  /* no law of adhesion is tried */
    bool unknown_loss;      /* the curve loses work, and the law of the fit does not describe it */
    double law_error, contact_error; /* of the modulus, relative, by another law of adhesion and by
                                        a second contact point */
    double unit; /* viscoelastic fit: |E*| of the spectrum for a modulus of 1 in the solution */
} curve_fitting;

/* Relative error by another fit with this difference of the modulus: the root of its mean square.
 * chi2 is 2 ln of the ratio of likelihoods. */
static inline double curve_alternative_error(double chi2, double difference)
{
    return fabs(difference) / sqrt(1.0 + exp(-0.5 * chi2));
}

/* Fitted baseline at a position. */
static inline double curve_baseline(const curve_solution *s, double position)
{
    return s->p[CURVE_F0] + s->p[CURVE_T] * (position - s->p[CURVE_C]);
}

/* Scans and refines the current samples, with a viscoelastic fit if a spectrum is given. Returns
 * false if only a baseline is found. */
bool curve_scan_and_refine(curve_fitting *f);
/* Prepares the relaxation of a series for the samples. Its times are in loading times or in
 * seconds. Returns false if the times of the samples are not known. */
bool curve_prepare_relaxation(curve_fitting *f, const wt_prony *series, bool in_loading_times);
/* True if the base below the sample changes the force: adhesion has no law there. */
static inline bool curve_is_thin(const curve_fitting *f)
{
    return thin_sample_radius_ratio(contact_table_tip(f->table), f->solution.max_indentation) >
           THICK_SAMPLE_MAX_RATIO;
}
/* True if noise alone explains the residual, or if the baseline is too short for the test. */
bool curve_passes_misfit_test(const curve_fitting *f);
/* Adds the error by the misfit of the law to the errors of the parameters. */
void curve_add_misfit(curve_fitting *f);

/* ---- interference: interference.c ------------------------------------------------------------ */

/* Adds a wave to a fit of all samples if the baseline shows one. Returns false if only a baseline
 * is found. */
bool curve_fit_interference(curve_fitting *f);
/* Subtracts the wave, as a function of the height, from the forces for a scan or the start of a
 * fit. */
void curve_subtract_wave(curve_fitting *f, const curve_wave *wave);

/* ---- range of the fit: fit_range.c ----------------------------------------------------------- */

/* Fits the range of the options after a fit of all samples. Returns false if only a baseline is
 * found. */
bool curve_fit_range(curve_fitting *f);
/* Number of samples in contact that are compared with the law. */
size_t curve_count_in_range(const curve_fitting *f);

/* ---- retract: retract.c ---- */

/* Computes pull_off and loss if the retract leaves the sample. height, force: as measured. */
void curve_read_retract(curve_fitting *f, const double *height, const double *force, size_t n);

/* ---- fit of the retract: retract.c ---- */

/* Fits a contact law of this kind, with separate parameters, to the retract. Returns false if there
 * is none. The workspace is that of this fit afterwards. */
bool curve_fit_unloading(const curve_fitting *f, const curve_kind *kind, const curve_solution *in,
                         curve_solution *out);
/* Reports the fit of the retract alone. If no work is lost and its modulus differs, the reason of a
 * usable curve mentions it. The function destroys the fit. */
void curve_report_unloading(curve_fitting *f, wt_indent_fit *fit);

/* ---- snap-in: retract.c ---- */

/* Finds a significant pull just before the force rises. The baseline of the solution becomes a line
 * through the samples before it. */
bool curve_find_snap_in(curve_fitting *f, curve_snap *found);
/* Excludes the samples from start to before end. */
void curve_exclude_samples(curve_fitting *f, size_t start, size_t end);

/* ---- adhesion: adhesion_fit.c ---- */

/* Fits adhesive contact after a fit without adhesion if the snap-in or the retract shows adhesion.
 * If that does not describe the curve, the samples of the pull are excluded. Returns false if only
 * a baseline is found. */
bool curve_fit_adhesion(curve_fitting *f);

/* ---- loss without a spectrum: hysteresis_loss.c ---------------------------------------------- */

/* Fits a relaxation if the retract shows loss, and determines the bias of the modulus. */
void curve_fit_loss(curve_fitting *f);
/* True for loss under a punch without a spectrum. There spectra of equal loss scatter more than the
 * error that is stated for the other tips. */
bool curve_has_unknown_loss(const curve_fitting *f);

/* ---- verdict: curve_verdict.c ---------------------------------------------------------------- */

/* Verdict of a curve in which only a baseline was found. */
wt_curve_verdict curve_no_contact_verdict(curve_fitting *f, char reason[160]);
/* True if the reversed curve resembles a contact more. The function destroys the samples in this
 * case. */
bool curve_is_retract(curve_fitting *f, char reason[160]);
/* Appends text to a reason if it fits completely. */
bool curve_append_note(char reason[160], const char *text); /* false: it has no room */
/* Returns the verdict on a fit and sets its reason. */
wt_curve_verdict curve_assess(curve_fitting *f, wt_indent_fit *fit);
/* Largest force to which a saturated curve may be fitted [N]. */
double curve_linear_limit(const curve_fitting *f);
/* Appends the verdict on the forces below the limit to the reason of a rejection. */
void curve_append_limit_verdict(double limit, wt_curve_verdict below, char reason[160]);

#endif
