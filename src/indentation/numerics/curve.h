/* Inside the fit room: the parts of the fit of one force curve.
 *
 * Coordinates. position = piezo height, turned so that it rises into the sample; force = as
 * measured, both less an origin (their means) so that sums keep their digits. With the baseline f0
 * + t (position - c) removed, the tip is at tip - c = delta = (position - c) (1 + t/k) - (force -
 * f0)/k where c is the contact point: the position at which the tip touches with the lever
 * straight.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_CURVE_H
#define WT_INDENTATION_NUMERICS_CURVE_H

#include "core/math/simd.h"
#include "indentation/law/hereditary.h"
#include "weartrack/fit.h"

#include <gsl/gsl_min.h>
#include <math.h>

enum {
    CURVE_MIN_SAMPLES = 32, /* the least of baseline and contact, 18, and what is left out */
    CURVE_MAX_MINIMA = 4,   /* the best two are told, and refinement may change their order */
    CURVE_TIP_MOVES = 2,    /* radius and half-angle: no tip has more sizes with errors */
    CURVE_POWER_TERMS = 15, /* of a power law as a series */
};
/* Of the work: less is piezo and noise. */
#define CURVE_LEAST_LOSS 0.03

/* E(t) = t^-power from 1e-4 to 1e3 times the loading time, and a rest for what is slower. */
typedef struct curve_power {
    double modulus[CURVE_POWER_TERMS], time[CURVE_POWER_TERMS];
    wt_prony series;
} curve_power;
void curve_power_make(curve_power *to, double power, double load_time);

/* Samples in the order of time. */
typedef struct curve_samples {
    size_t n;
    double *position, *force;
    double spring_constant;
    size_t gap_from, gap_to; /* shallower than the range of the fit: modelled but not compared */
} curve_samples;
static inline bool curve_in_gap(const curve_samples *s, size_t i)
{
    return i >= s->gap_from && i < s->gap_to;
}

/* A sine on the force: interference of the light that the lever reflects with that of the sample.
 * Its phase is that of the path between them, so it goes with the tip. Other things (the mains, a
 * step of the piezo) go with the height, in contact too. */
enum { WAVE_COSINE, WAVE_SINE, WAVE_NUMBER, WAVE_PARAMETERS };
typedef struct curve_wave {
    double p[WAVE_PARAMETERS]; /* two amplitudes [N], 2 pi / period [1/m]; 0: there is none */
    bool by_height;
} curve_wave;

/* Sums at depths below the deepest point, from that of an octave to 0, and the contact function at
 * as many distances: curve_scan.c. */
enum { SCAN_OCTAVES = 17, SCAN_NODES = 128, SCAN_REACH = 4 };
typedef struct scan_octave {
    double weight[SCAN_NODES + 2], force[SCAN_NODES + 2], position[SCAN_NODES + 2];
    double g[SCAN_NODES + 1], gg[SCAN_NODES + 1]; /* and its square */
} scan_octave;

/* Tips with one size larger and smaller by as much, borrowed, NULL: none; and the standard error of
 * the stated one in that. A misfit that they explain is not one of the law, and the standard errors
 * hold theirs. */
typedef struct tip_move {
    const wt_contact_table *down, *up;
    double deviation;
} tip_move;

struct wt_indent_workspace {
    tip_move tip_move[CURVE_TIP_MOVES];
    tip_move any_radius; /* of a radius without a stated error: deviation of its logarithm by 1 */
    size_t capacity;
    double *block; /* what the arrays below are parts of */
    double *position, *force, *tip, *delta, *g, *slope, *residual, *scratch, *weight;
    double *by_modulus, *by_work;                     /* of an adhesive contact, at one depth */
    double *by_contact, *time;                        /* with memory */
    double *given_force, *given_time, *given_retract; /* of wt_indent_force_curve */
    double *retract_position, *retract_force; /* of the way out, from curve_read_retract on */
    double *start_position, *start_force;     /* of fits that only start others */
    double *without_wave;                     /* forces less the wave; `force` has it */
    double *wave_column[WAVE_PARAMETERS], *wave_give; /* derivatives: curve_wave.c */
    scan_octave octave[SCAN_OCTAVES];
    double before_start[2][SCAN_REACH * SCAN_NODES + 1]; /* contact function, square */
    gsl_min_fminimizer *minimizer;
    hereditary memory;
    size_t evaluations; /* of the model so far */
    /* Of the accepted curves so far, relative: by how much a further step may change the modulus
     * where the fit ends, and would at most. */
    double step_allowed, step_left;
};

/* A way in or out, as measured; time NULL: not known. */
typedef struct curve_branch {
    const double *height, *force, *time;
    size_t n;
} curve_branch;

/* wt_indent_fit_curve with the way out, of which n may be 0. */
wt_status curve_fit_branches(const wt_contact_table *table, const wt_indent_options *options,
                             const curve_branch *approach, const curve_branch *retract,
                             double spring_constant, wt_indent_workspace *workspace,
                             wt_indent_fit *fit, wt_error *err);

/* A fit without numbers. */
void curve_fit_empty(wt_indent_fit *fit);

/* Are the limits of the range in order, and has the tip a radius where one is asked for? */
wt_status curve_range_check(const wt_indent_options *options, const wt_tip *tip, wt_error *err);

/* WT_E_MEMORY when n samples find no room. */
wt_status curve_reserve(wt_indent_workspace *workspace, size_t n, wt_error *err);

/* With several sums, for one would wait for itself at each term. */
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

/* The same of one. */
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

/* Of finite numbers; n > 0. */
typedef struct curve_span {
    double low, high;
} curve_span;
curve_span curve_span_of(const double *x, size_t n);
/* The k-th smallest of n numbers from 0 to the largest, which are lost. */
double curve_select(double *x, size_t n, size_t k, double largest);

/* The reason of a verdict. */
void curve_set_reason(char reason[160], const char *format, ...) WT_PRINTF(2, 3);
/* A value as short text with its unit. */
typedef struct si_text {
    char words[40];
} si_text;
si_text curve_si(double value, const char *unit);

/* ---- preparation: curve_prepare.c ------------------------------------------------------------ */

typedef struct curve_input {
    curve_samples samples; /* of the workspace; without missing and repeated ones, centred */
    size_t n_all;          /* samples.n may be less: a limit of the force */
    double position_origin, force_origin;
    double direction; /* +1 or -1: position = direction * height */
    size_t n_missing, n_repeated, n_spikes;
    double step_noise; /* noise from successive differences [N] */
    bool saturated;    /* above the limit of the force */
    double flat_level; /* at which it stands still, from its start [N]; 0: it does not */
} curve_input;

/* Cleans, turns and centres; finds what no fit can mend. A verdict other than accepted ends it. */
wt_curve_verdict curve_prepare(const double *height, const double *force, size_t n,
                               double spring_constant, const wt_indent_options *options,
                               wt_indent_workspace *workspace, curve_input *input,
                               char reason[160]);
/* Turns the samples into those of the motion in reverse: a retract becomes an approach. */
void curve_reverse(curve_samples *samples);

/* ---- scan of the contact point: curve_scan.c ------------------------------------------------- */

/* A local minimum of the cost with modulus, offset and tilt projected out. */
typedef struct curve_minimum {
    double contact_point;
    double reduced_modulus; /* E/(1-nu^2) */
    double offset, tilt;    /* baseline at the contact point, its slope */
    double cost;            /* sum of squares [N^2] */
} curve_minimum;

/* Fills `minima`, best first; returns how many (0: no contact point gives a positive modulus).
 * weighted: with weights 1/h^2, h = 1 + S/k, where h is far from 1. */
size_t curve_scan(const wt_contact_table *table, const curve_samples *samples, bool tilt,
                  bool weighted, wt_indent_workspace *workspace,
                  curve_minimum minima[CURVE_MAX_MINIMA]);
/* The same for one given contact point (a position of the samples). */
bool curve_scan_at(const wt_contact_table *table, const curve_samples *samples, bool tilt,
                   double contact_point, wt_indent_workspace *workspace, curve_minimum *minimum);

/* ---- refinement and errors: curve_refine.c --------------------------------------------------- */

/* The last one, the square root of the work of adhesion, has a value in adhesive contact only. */
enum { CURVE_E, CURVE_C, CURVE_F0, CURVE_T, CURVE_W, CURVE_N_PARAMETERS };

/* The residual against the noise of the same curve: curve_lack.c. NaN where the baseline is too
 * short to say. */
enum { CURVE_WAVES = WT_CURVE_WAVES };
typedef struct curve_lack {
    double statistic, chance; /* of the contact part, and of more than that by noise alone */
    double baseline_p;        /* that a straight baseline departs as much from a line */
    double wave[CURVE_WAVES]; /* cosines over the contact [N] */
    double window;            /* what they are over, to the end [m] */
    double flat_chance; /* that the force of a contact flattens as much at its top by noise alone */
    double flat_from;   /* force up to which little of that is to be seen [N] */
} curve_lack;

typedef struct curve_solution {
    double p[CURVE_N_PARAMETERS]; /* reduced modulus, contact point, offset, tilt, root of work */
    double standard_error[CURVE_N_PARAMETERS]; /* with the next */
    double misfit_error[CURVE_N_PARAMETERS];   /* of them that of what the law misses: misfit.c */
    double cost;
    double sensitivity_gain;
    double bend_shift;    /* of the reduced modulus, if a bent baseline goes on in contact */
    double curvature;     /* of the baseline [N/m^2] */
    size_t first_contact; /* samples before it are baseline */
    double max_indentation;
    double noise, correlation_length;
    double effective_n; /* samples over correlation length */
    curve_lack lack;
    bool bent; /* the baseline: the errors hold what that does if it goes on in contact */
    curve_wave wave;
    double step_allowed, step_left; /* as in the workspace, of this curve */
    bool converged;
} curve_solution;

typedef struct curve_kind {
    bool tilt, contact_fixed;
    bool plain; /* force against measured indentation */
    bool adhesive;
    bool
        constant_pull; /* of adhesive contact: a force in contact beside that of the law (Derjaguin,
                          Muller and Toporov; a capillary), in the place of the root of the work */
    bool memory;       /* the rubber has the spectrum of the options; not with adhesion */
    bool rough;        /* to a thousandth of a standard error, and without errors */
    bool no_errors;    /* that is all of it */
    double below;      /* a fit that cannot come below this cost need not end; 0: each does */
    size_t jump;       /* of adhesive contact: the first sample in it; 0: where the tip touches */
    curve_wave wave;   /* where to begin with it */
} curve_kind;
static inline bool curve_has_wave(const curve_wave *wave)
{
    return wave->p[WAVE_NUMBER] > 0.0;
}
static inline double curve_wave_amplitude(const curve_wave *wave)
{
    return hypot(wave->p[WAVE_COSINE], wave->p[WAVE_SINE]);
}

/* Least squares in all free parameters at once, starting from p; then the covariance with
 * correlated residuals. With a wave it is fitted, too, and the forces of the samples, which are
 * those of `without_wave`, are left without it; whether it goes with the tip or with the height in
 * contact, the cost decides, and the errors hold what the other would give. */
void curve_refine(const wt_contact_table *table, const curve_samples *samples, curve_kind kind,
                  const double p[CURVE_N_PARAMETERS], wt_indent_workspace *workspace,
                  curve_solution *solution);
/* What a share of a difference between laws would bring, all parameters fitted along: the score
 * test (Rao, Proc. Camb. Phil. Soc. 44 (1948) 50), which needs no fit. */
typedef struct curve_step {
    double share;   /* of the difference */
    double gain;    /* 2 ln of the ratio of likelihoods */
    double modulus; /* by how much that moves, relative */
} curve_step;
/* At a solution of this kind; difference: n of them, of the forces of another law, at each sample
 * [N]. Zeros where the samples cannot tell it from the parameters. Leaves the workspace as that of
 * the solution. */
void curve_score(const wt_contact_table *table, const curve_samples *samples,
                 const curve_kind *kind, const curve_solution *at, double *const *difference,
                 size_t n, wt_indent_workspace *workspace, curve_step *to);
/* Weights 1/h^2, h = 1 + S/k, of all samples for a scan, near those that a minimum of another has.
 * Returns the largest h. */
double curve_weights(const wt_contact_table *table, const curve_samples *samples,
                     const curve_minimum *minimum, wt_indent_workspace *workspace);

#endif
