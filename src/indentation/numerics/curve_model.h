/* Inside the fit room: the force that lever and sample give together, its residuals and derivatives
 * for all samples of a curve.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_NUMERICS_CURVE_MODEL_H
#define WT_INDENTATION_NUMERICS_CURVE_MODEL_H

#include "indentation/numerics/curve.h"

typedef struct curve_law {
    const wt_contact_table *table;
    const curve_samples *samples;
    wt_indent_workspace *workspace; /* delta, g, slope, residual: of the latest evaluation */
    bool free[CURVE_N_PARAMETERS];
    bool plain, adhesive, memory;
    bool constant_pull; /* adhesive by a force of its own, the parameter of the work [N] */
    bool rough;         /* as in the kind */
    double below;       /* as in the kind */
    bool balanced;      /* the indentations of the workspace, with the force and its slope there */
    bool wave; /* in the force; the derivatives then are those less what the wave can imitate */
    double imitated[WAVE_PARAMETERS][CURVE_N_PARAMETERS];
    size_t jump; /* of adhesive contact: its first sample; 0: where the tip touches */
    /* The first samples, far from contact for any step of the fit, enter by their sums alone. */
    size_t n_baseline;
    double baseline_end; /* largest position among them */
    double z0, f0;       /* origin of the sums */
    double z, zz, f, zf, ff;
} curve_law;

/* The law of a kind of fit, to be evaluated; and all of its samples at p, where they were fitted.
 */
curve_law curve_law_of(const wt_contact_table *table, const curve_samples *samples,
                       const curve_kind *kind, wt_indent_workspace *workspace);
void curve_law_evaluate(curve_law *model, const double p[CURVE_N_PARAMETERS],
                        const curve_wave *wave);

typedef struct normal_equations {
    double jj[CURVE_N_PARAMETERS][CURVE_N_PARAMETERS], jr[CURVE_N_PARAMETERS];
} normal_equations;

/* Begins at parameters p; with indentations that a fit of the same samples has left. */
void curve_model_start(curve_law *model, const double p[CURVE_N_PARAMETERS]);
void curve_model_resume(curve_law *model, const double p[CURVE_N_PARAMETERS]);
/* Evaluates at p and returns the sum of squares. */
double curve_model_cost(curve_law *model, const double p[CURVE_N_PARAMETERS]);
/* At the parameters of the latest evaluation. */
void curve_model_normal(const curve_law *model, const double p[CURVE_N_PARAMETERS],
                        normal_equations *equations);
/* At the parameters of the latest evaluation, fills in the samples that the sums stand for. */
void curve_model_complete(const curve_law *model, const double p[CURVE_N_PARAMETERS]);
/* Of the residuals e, those of the noise, at the parameters of the latest evaluation. */
curve_lack curve_lack_of_fit(const curve_law *model, const double p[CURVE_N_PARAMETERS],
                             const double *e);
/* What the noise does to the sums J'e, at the parameters of the latest evaluation. */
typedef struct curve_noise {
    double variance;           /* of a sample of the baseline */
    double correlation_length; /* [samples], of waves as long as the contact */
    double scatter[CURVE_N_PARAMETERS][CURVE_N_PARAMETERS]; /* covariance of J'e */
    double bend[CURVE_N_PARAMETERS]; /* J' of the bend of the baseline, which is in it */
    double curvature; /* of the baseline, bent or not: the square of the position in it [N/m^2] */
} curve_noise;
/* Of the residuals e, those of the noise, of which the first `first` are the baseline; bent: it is
 * not straight, and nobody knows how that goes on in contact. */
curve_noise curve_noise_of(const curve_law *model, const double p[CURVE_N_PARAMETERS],
                           const double *e, size_t first, bool bent);
/* Variance of a unit wave of means over `length` samples, by its frequency: 1 is half a cycle for
 * each of them. */
enum { NOISE_BANDS = 52 };
typedef struct curve_spectrum {
    double density[NOISE_BANDS], length;
} curve_spectrum;
/* The mean spectrum of at most 512 residuals x, each the mean of to->length samples. False if there
 * is nothing. */
bool curve_noise_spectrum(const double *x, size_t n, curve_spectrum *to);
/* Of unit wave k, half a cycle each, of n blocks of `length` samples. */
double curve_noise_variance(const curve_spectrum *s, double k, size_t n, size_t length);
/* h = 1 + S/k of sample i. */
static inline double curve_model_factor(const curve_law *m, const double p[CURVE_N_PARAMETERS],
                                        size_t i)
{
    return 1.0 + p[CURVE_E] * m->workspace->slope[i] / m->samples->spring_constant;
}

/* Derivatives of the modelled force of sample i; 0 where a parameter is not free, or it is not
 * compared. Returns what the
 * residual makes of a noise of 1. */
static inline double curve_model_row(const curve_law *m, const double p[CURVE_N_PARAMETERS],
                                     size_t i, double row[CURVE_N_PARAMETERS])
{
    const wt_indent_workspace *w = m->workspace;
    double h = curve_model_factor(m, p, i), stiffness = p[CURVE_E] * w->slope[i];
    double plain = m->plain ? h : 1.0, balanced = m->plain ? 1.0 : 1.0 / h;
    const double by_contact = m->memory ? w->by_contact[i] : -stiffness;
    if (m->wave)
        balanced *= w->wave_give[i];
    row[CURVE_E] = (m->adhesive || m->memory ? w->by_modulus[i] : w->g[i]) * balanced;
    row[CURVE_C] = m->free[CURVE_C] ? -p[CURVE_T] * plain + by_contact * balanced : 0.0;
    row[CURVE_F0] = plain;
    row[CURVE_T] = m->free[CURVE_T] ? (m->samples->position[i] - p[CURVE_C]) * plain : 0.0;
    row[CURVE_W] = m->adhesive ? w->by_work[i] * balanced : 0.0;
    for (size_t j = 0; j < WAVE_PARAMETERS && m->wave; j++)
        for (size_t a = 0; a < CURVE_N_PARAMETERS; a++)
            row[a] -= m->imitated[j][a] * w->wave_column[j][i];
    for (size_t a = 0; a < CURVE_N_PARAMETERS && curve_in_gap(m->samples, i); a++)
        row[a] = 0.0;
    return plain;
}

/* ---- with a wave in the force: curve_wave.c ---------------------------------------------------
 */

/* At the latest evaluation, which was at p: takes the wave out of the forces of the samples and
 * returns the sum of squares then. */
double curve_wave_cost(const curve_law *model, const double p[CURVE_N_PARAMETERS],
                       const curve_wave *wave);
/* What the wave can imitate of the derivatives goes into the model. */
typedef struct wave_step {
    double step[WAVE_PARAMETERS]; /* to the least sum of squares, were the other parameters held */
    double gain;                  /* which then falls by so much */
} wave_step;
/* At the latest evaluation and wave; false if the wave is not determined. */
bool curve_wave_imitate(curve_law *model, const double p[CURVE_N_PARAMETERS], wave_step *to);

/* Lever and rubber with memory in balance: curve_memory.c. Of samples from `first` on, those before
 * it are out of contact: depth, force over modulus, and its slope of the moment; the derivatives by
 * modulus and contact point, times h. */
void curve_balance_memory(const curve_law *model, const double p[CURVE_N_PARAMETERS], size_t first);
/* The depth x at which k (z - x) = E (past + now G(x)), if k z > E past; G and its slope there.
 * start: a guess, 0: none. The left side less the right falls and is concave. */
double curve_balanced_depth(const wt_contact_table *table, double k, double z, double e,
                            double past, double now, double start, double *g, double *slope);

#endif
