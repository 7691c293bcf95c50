/* Declarations that the parts of the fit of one force curve share.
 *
 * Coordinates: position = piezo height, oriented so that it rises into the sample; force = as
 * measured. Both are relative to their means to preserve digits in sums. With the baseline f0 + t
 * (position - c) removed, the tip is at tip - c = delta = (position - c) (1 + t/k) - (force -
 * f0)/k. c is the contact point, the position of first contact with the undeflected cantilever.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_CURVE_H
#define WT_INDENTATION_NUMERICS_CURVE_H

#include "core/math/simd.h"
#include "indentation/law/hereditary.h"
#include "weartrack/indentation.h"

#include <gsl/gsl_min.h>
#include <math.h>

enum {
    CURVE_MIN_SAMPLES = 32, /* 18 for baseline and contact, and a reserve for excluded samples */
    CURVE_MAX_MINIMA = 4,   /* the result has the best two, and refinement may change their order */
    CURVE_POWER_TERMS = 15, /* terms of a power law as a series */
};
/* Smallest significant loss over the work; a smaller one is due to piezo and noise. */
#define CURVE_MIN_LOSS 0.03

/* E(t) = t^-power from 1e-4 to 1e3 loading times, and a constant for slower relaxation. */
typedef struct curve_power {
    double modulus[CURVE_POWER_TERMS], time[CURVE_POWER_TERMS];
    wt_prony series;
} curve_power;
void curve_power_create(curve_power *to, double power, double load_time);

/* Samples in the order of time. */
typedef struct curve_samples {
    size_t n;
    double *position, *force;
    double spring_constant;
    size_t gap_from, gap_to; /* samples above the range of the fit: modelled but not compared */
} curve_samples;
static inline bool curve_is_in_gap(const curve_samples *s, size_t i)
{
    return i >= s->gap_from && i < s->gap_to;
}

/* Sine in the force due to interference of light reflected by cantilever and sample. Its phase is
 * that of the optical path, so it depends on the tip position. Other disturbances (mains, steps of
 * the piezo) depend on the height in contact too. */
enum { WAVE_COSINE, WAVE_SINE, WAVE_NUMBER, WAVE_PARAMETERS };
typedef struct curve_wave {
    double p[WAVE_PARAMETERS]; /* two amplitudes [N], 2 pi / period [1/m]; 0 if there is no wave */
    bool by_height;
} curve_wave;

/* Sums at depths below the deepest point, from that of an octave to 0, and the contact function at
 * equal distances: contact_point_scan.c. */
enum { SCAN_OCTAVES = 17, SCAN_NODES = 128, SCAN_EXTENT = 4 };
typedef struct scan_octave {
    double weight[SCAN_NODES + 2], force[SCAN_NODES + 2], position[SCAN_NODES + 2];
    double g[SCAN_NODES + 1], gg[SCAN_NODES + 1]; /* square of the contact function */
} scan_octave;

struct wt_indent_workspace {
    size_t capacity;
    double *block; /* storage of the arrays below */
    double *position, *force, *tip, *delta, *g, *slope, *residual, *scratch, *weight;
    double *by_modulus, *by_work; /* of an adhesive contact, at constant depth */
    double *by_contact, *time;    /* of a viscoelastic contact */
    double *input_force, *input_time, *input_retract; /* inputs of wt_indent_fit_force_curve */
    double *retract_position, *retract_force;         /* retract, set by curve_read_retract */
    double *start_position, *start_force;             /* samples of starting fits */
    double *without_wave; /* forces minus the wave; `force` includes it */
    double *wave_column[WAVE_PARAMETERS], *wave_response; /* derivatives: least_squares.c */
    scan_octave octave[SCAN_OCTAVES];
    double before_start[2][SCAN_EXTENT * SCAN_NODES + 1]; /* contact function and its square */
    gsl_min_fminimizer *minimizer;
    hereditary memory;
    size_t evaluations; /* evaluations of the model so far */
    /* Over the accepted curves so far, relative to the modulus: tolerated and estimated change by a
     * further step of the fit. */
    double step_allowed, step_left;
};

/* Branch as measured; time is NULL if not known. */
typedef struct curve_branch {
    const double *height, *force, *time;
    size_t n;
} curve_branch;

/* Variant of wt_indent_fit_curve with the retract, whose n may be 0. Laws of adhesion are tried
 * unless `without_adhesion` is set. */
wt_status curve_fit_branches(const wt_contact_table *table, const wt_indent_options *options,
                             const curve_branch *approach, const curve_branch *retract,
                             bool without_adhesion, double spring_constant,
                             wt_indent_workspace *workspace, wt_indent_fit *fit, wt_error *err);

/* Sets all numbers of a fit to NaN. */
void curve_fit_empty(wt_indent_fit *fit);

/* Checks the order of the limits of the range, and that the tip has a radius if the limits refer to
 * one. */
wt_status curve_range_check(const wt_indent_options *options, const wt_tip *tip, wt_error *err);

/* Reserves space for n samples. */
void curve_reserve(wt_indent_workspace *workspace, size_t n);

/* Dot product with several partial sums, which avoids a dependency between the terms. */
static inline double curve_dot(const double *a, const double *b, size_t n)
{
    wide sum = {0.0}, x, y;
    size_t i = 0;
    for (; i + WIDE <= n; i += WIDE) {
        simd_load(&x, a + i);
        simd_load(&y, b + i);
        sum += x * y;
    }
    for (; i < n; i++)
        sum[0] += a[i] * b[i];
    return simd_sum(&sum);
}

/* Sum with several partial sums. */
static inline double curve_sum(const double *a, size_t n)
{
    wide sum = {0.0}, x;
    size_t i = 0;
    for (; i + WIDE <= n; i += WIDE) {
        simd_load(&x, a + i);
        sum += x;
    }
    for (; i < n; i++)
        sum[0] += a[i];
    return simd_sum(&sum);
}

/* Range of n > 0 finite numbers. */
typedef struct curve_span {
    double low, high;
} curve_span;
curve_span curve_find_span(const double *x, size_t n);
/* Returns the k-th smallest of n numbers from 0 to `largest`. The function destroys x. */
double curve_select(double *x, size_t n, size_t k, double largest);

/* Sets the reason of a verdict. */
void curve_set_reason(char reason[160], const char *format, ...) WT_PRINTF(2, 3);
/* Value with its unit as short text. */
typedef struct si_text {
    char buffer[48];
} si_text;
si_text curve_format_si(double value, const char *unit);

/* ---- preparation: preparation.c -------------------------------------------------------------- */

typedef struct curve_input {
    curve_samples samples; /* arrays of the workspace; without missing and repeated samples,
                              relative to the means */
    size_t n_all;          /* samples.n is smaller if the force is limited */
    double position_origin, force_origin;
    double direction; /* +1 or -1: position = direction * height */
    size_t n_missing, n_repeated, n_spikes;
    double step_noise; /* noise from successive differences [N] */
    bool saturated;    /* saturated above the limit of the force */
    double flat_level; /* force of the plateau above the start [N]; 0 if there is none */
} curve_input;

/* Cleans the samples, orients them and subtracts the means. Also finds defects that prevent a fit.
 * The fit continues only if the verdict is accepted. Samples between the end of the baseline of the
 * options and `contact` (a tip position, or NaN) are left out. */
wt_curve_verdict curve_prepare(const double *height, const double *force, size_t n,
                               double spring_constant, const wt_indent_options *options,
                               double contact, wt_indent_workspace *workspace, curve_input *input,
                               char reason[160]);
/* Reverses the direction of motion: a retract becomes an approach. */
void curve_reverse(curve_samples *samples);

/* ---- scan of the contact point: contact_point_scan.c ----------------------------------------- */

/* Means over `length` samples in the arrays of starting fits, or the samples themselves for a
 * length of 1. A mean begins at sample `from`. */
curve_samples curve_average_samples(const curve_samples *samples, size_t from, size_t length,
                                    wt_indent_workspace *workspace);
/* Length of means for a start or a test, which need few samples. */
enum { CURVE_LEAST_MEANS = 500 };
static inline size_t curve_average_length(const curve_samples *s)
{
    return s->n < 2 * CURVE_LEAST_MEANS ? 1 : s->n / CURVE_LEAST_MEANS;
}

/* Local minimum of the cost. Modulus, offset and tilt are eliminated. */
typedef struct curve_minimum {
    double contact_point;
    double reduced_modulus; /* E/(1-nu^2) */
    double offset, tilt;    /* baseline at the contact point, and its slope */
    double cost; /* sum of squares [N^2]; of a scan without the scatter within means of samples */
} curve_minimum;

/* Fills `minima`, best first, and returns their number. 0 means that no contact point has a
 * positive modulus. weighted: uses weights 1/h^2, h = 1 + S/k, if h differs much from 1. */
size_t curve_scan(const wt_contact_table *table, const curve_samples *samples, bool tilt,
                  bool weighted, wt_indent_workspace *workspace,
                  curve_minimum minima[CURVE_MAX_MINIMA]);
/* Variant of curve_scan for one given contact point (a position of the samples). */
bool curve_scan_point(const wt_contact_table *table, const curve_samples *samples, bool tilt,
                      double contact_point, wt_indent_workspace *workspace, curve_minimum *minimum);

/* ---- refinement and errors: least_squares.c -------------------------------------------------- */

/* CURVE_W is the square root of the work of adhesion or the constant pull. It applies to adhesive
 * contact only. */
enum { CURVE_E, CURVE_C, CURVE_F0, CURVE_T, CURVE_W, CURVE_N_PARAMETERS };

/* Lack of fit: the residual compared with the noise of the same curve (lack_of_fit.c). Values are
 * NaN if the baseline is too short. */
enum { CURVE_WAVES = WT_MISFIT_TERMS };
typedef struct curve_misfit_test {
    double statistic, chance; /* of the contact part, and of more than that by noise alone */
    double baseline_p;        /* that a straight baseline departs as much from a line */
    double wave[CURVE_WAVES]; /* cosines over the contact [N] */
    double window;            /* length of the window of the cosines, up to the end [m] */
    double flat_chance;       /* p value of the flattening of the force at its top */
    double flat_from;         /* force below which the flattening is small [N] */
} curve_misfit_test;

typedef struct curve_solution {
    double
        p[CURVE_N_PARAMETERS]; /* reduced modulus, contact point, offset, tilt, root of the work */
    double standard_error[CURVE_N_PARAMETERS]; /* includes misfit_error */
    /* Half of the spread over the ranges of the fit beyond the noise, which is the error by the
     * misfit of the law. NaN if no range has enough samples. */
    double misfit_error[CURVE_N_PARAMETERS];
    /* Relative change of the modulus with each range, and the part of it by noise. */
    double range_shift[WT_FIT_RANGES], range_error[WT_FIT_RANGES];
    double cost;
    double sensitivity_gain;
    double bend_shift; /* change of the reduced modulus if a bent baseline continues in contact */
    double curvature;  /* of the baseline [N/m^2] */
    size_t first_contact; /* first sample in contact; earlier ones are baseline */
    double max_indentation;
    double noise, correlation_length;
    double effective_n; /* samples over correlation length */
    curve_misfit_test lack;
    bool bent; /* significant slope change of the baseline; the errors include its continuation in
                  contact */
    curve_wave wave;
    double step_allowed, step_left; /* as in the workspace, for this curve */
    bool converged;
} curve_solution;

typedef struct curve_kind {
    bool tilt, contact_fixed;
    bool plain; /* residual of the force against the measured indentation */
    bool adhesive;
    bool constant_pull;  /* adhesive contact with a constant force in addition to the contact law
                            (Derjaguin, Muller and Toporov; a capillary) in the place of the root of
                            the work */
    bool memory;         /* the rubber has the spectrum of the options; not with adhesion */
    bool is_approximate; /* stop at a thousandth of a standard error and compute no errors */
    double cost_limit;   /* a fit that cannot reach this cost may stop; 0: no limit */
    size_t jump;         /* adhesive contact: first sample in contact; 0: at the contact point */
    curve_wave wave;     /* start values of the wave */
} curve_kind;
static inline bool curve_has_wave(const curve_wave *wave)
{
    return wave->p[WAVE_NUMBER] > 0.0;
}
static inline double curve_wave_amplitude(const curve_wave *wave)
{
    return hypot(wave->p[WAVE_COSINE], wave->p[WAVE_SINE]);
}

/* Least squares in all free parameters from the start p, then the covariance with correlated
 * residuals. A wave is fitted too, and the forces of the samples (those of `without_wave`) exclude
 * it. The lower cost decides between a wave that depends on the tip and one that depends on the
 * height. The errors include the difference between the two. */
void curve_refine(const wt_contact_table *table, const curve_samples *samples, curve_kind kind,
                  const double p[CURVE_N_PARAMETERS], wt_indent_workspace *workspace,
                  curve_solution *solution);
/* Result of the score test (Rao, Proc. Camb. Phil. Soc. 44 (1948) 50). It estimates the improvement
 * by a share of a difference between laws, with all parameters free, without a fit. */
typedef struct curve_score_result {
    double share;   /* share of the difference */
    double gain;    /* 2 ln of the ratio of likelihoods */
    double modulus; /* relative change of the modulus */
} curve_score_result;
/* Score test at a solution of this kind. `difference` has n arrays with the differences to the
 * forces of other laws at each sample [N]. The result is 0 if the parameters can compensate a
 * difference. The workspace is that of the solution afterwards. */
void curve_score(const wt_contact_table *table, const curve_samples *samples,
                 const curve_kind *kind, const curve_solution *at, double *const *difference,
                 size_t n, wt_indent_workspace *workspace, curve_score_result *to);

/* Returns the pull of a snap-in that the fit left out, because no law of adhesion describes it, or
 * the pull-off if that is larger [N]. 0 if there is none or if it is small. */
double curve_left_out_pull(const wt_indent_fit *fit);
/* Relative error of the modulus by that pull: it acts on in the contact, so that the force of the
 * law may be larger by it. That is the limit of the 95 % interval. */
double curve_left_out_error(const wt_indent_fit *fit);

#endif
