/* Model of the force in the equilibrium of cantilever and sample, with residuals and derivatives
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
    bool constant_pull; /* adhesion is a constant force [N], in the place of the root of the work */
    bool is_approximate; /* as in curve_kind */
    double cost_limit;   /* as in curve_kind */
    bool balanced; /* the indentations of the workspace are in equilibrium, with the force and its
                      slope */
    bool wave; /* the force includes a wave; the derivatives then exclude their projection on the
                  wave */
    double wave_projection[WAVE_PARAMETERS][CURVE_N_PARAMETERS];
    size_t jump; /* adhesive contact: first sample; 0: at the contact point */
    /* The first samples are far from contact in any step of the fit and enter by sums alone. */
    size_t n_baseline;
    double baseline_end; /* largest position among them */
    double z0, f0;       /* origin of the sums */
    double z, zz, f, zf, ff;
} curve_law;

/* curve_law_create creates the law of a kind of fit. curve_law_evaluate evaluates all samples at
 * the fitted parameters p. */
curve_law curve_law_create(const wt_contact_table *table, const curve_samples *samples,
                           const curve_kind *kind, wt_indent_workspace *workspace);
void curve_law_evaluate(curve_law *model, const double p[CURVE_N_PARAMETERS],
                        const curve_wave *wave);

typedef struct normal_equations {
    double jj[CURVE_N_PARAMETERS][CURVE_N_PARAMETERS], jr[CURVE_N_PARAMETERS];
} normal_equations;

/* curve_model_start starts at the parameters p. curve_model_resume starts with the indentations of
 * a previous fit of the same samples. */
void curve_model_start(curve_law *model, const double p[CURVE_N_PARAMETERS]);
void curve_model_resume(curve_law *model, const double p[CURVE_N_PARAMETERS]);
/* Evaluates at p and returns the sum of squares. */
double curve_model_cost(curve_law *model, const double p[CURVE_N_PARAMETERS]);
/* Computes the normal equations at the parameters of the latest evaluation. */
void curve_model_normal(const curve_law *model, const double p[CURVE_N_PARAMETERS],
                        normal_equations *equations);
/* Adds the equations of the samples from `from` to before `to`, none of which the sums represent,
 * to the upper triangle. */
void curve_model_add_rows(const curve_law *model, const double p[CURVE_N_PARAMETERS], size_t from,
                          size_t to, normal_equations *equations);
/* Computes the samples that the sums represent, at the parameters of the latest evaluation. */
void curve_model_complete(const curve_law *model, const double p[CURVE_N_PARAMETERS]);
/* Tests the lack of fit at the parameters of the latest evaluation. `e` has the residuals of the
 * noise. */
curve_misfit_test curve_lack_of_fit(const curve_law *model, const double p[CURVE_N_PARAMETERS],
                                    const double *e);
/* Orthonormalises the columns one by one and subtracts their projections from r. Returns the sum of
 * squares of the projections from column `count` on, and their number. Columns and r are destroyed.
 */
double curve_orthogonalise(double *r, double *const *columns, size_t n_columns, size_t count,
                           size_t n, size_t *n_counted);
/* Effect of the noise on the sums J'e at the parameters of the latest evaluation. */
typedef struct curve_noise {
    double variance;           /* variance of a sample of the baseline */
    double correlation_length; /* [samples], for waves as long as the contact */
    double scatter[CURVE_N_PARAMETERS][CURVE_N_PARAMETERS]; /* covariance of J'e */
    double bend[CURVE_N_PARAMETERS]; /* J' times the slope change of the baseline, which `scatter`
                                        includes */
    double curvature; /* coefficient of the square of the position in the baseline [N/m^2] */
} curve_noise;
/* Estimates the noise from the residuals e, of which the first `first` are the baseline. `bent`
 * states that the baseline is not straight, and its continuation in contact is unknown. */
curve_noise curve_estimate_noise(const curve_law *model, const double p[CURVE_N_PARAMETERS],
                                 const double *e, size_t first, bool bent);
/* Variance of a unit wave of means over `length` samples by frequency. A frequency of 1 is half a
 * cycle per mean. */
enum { NOISE_BANDS = 52 };
typedef struct curve_spectrum {
    double density[NOISE_BANDS], length;
} curve_spectrum;
/* Computes the mean spectrum of at most 512 residuals x, each the mean of to->length samples.
 * Returns false if the residuals are 0. */
bool curve_noise_spectrum(const double *x, size_t n, curve_spectrum *to);
/* Variance of unit wave k, with k half cycles, over n blocks of `length` samples. */
double curve_noise_variance(const curve_spectrum *s, double k, size_t n, size_t length);
/* Factor h = 1 + S/k of sample i. */
static inline double curve_model_factor(const curve_law *m, const double p[CURVE_N_PARAMETERS],
                                        size_t i)
{
    return 1.0 + p[CURVE_E] * m->workspace->slope[i] / m->samples->spring_constant;
}

/* Computes the derivatives of the modelled force of sample i. They are 0 for fixed parameters and
 * for samples that are not compared. Returns the factor of the noise in the residual. */
static inline double curve_model_row(const curve_law *m, const double p[CURVE_N_PARAMETERS],
                                     size_t i, double row[CURVE_N_PARAMETERS])
{
    const wt_indent_workspace *w = m->workspace;
    double h = curve_model_factor(m, p, i), stiffness = p[CURVE_E] * w->slope[i];
    double plain = m->plain ? h : 1.0, balanced = m->plain ? 1.0 : 1.0 / h;
    const double by_contact = m->memory ? w->by_contact[i] : -stiffness;
    if (m->wave)
        balanced *= w->wave_response[i];
    row[CURVE_E] = (m->adhesive || m->memory ? w->by_modulus[i] : w->g[i]) * balanced;
    row[CURVE_C] = m->free[CURVE_C] ? -p[CURVE_T] * plain + by_contact * balanced : 0.0;
    row[CURVE_F0] = plain;
    row[CURVE_T] = m->free[CURVE_T] ? (m->samples->position[i] - p[CURVE_C]) * plain : 0.0;
    row[CURVE_W] = m->adhesive ? w->by_work[i] * balanced : 0.0;
    for (size_t j = 0; j < WAVE_PARAMETERS && m->wave; j++)
        for (size_t a = 0; a < CURVE_N_PARAMETERS; a++)
            row[a] -= m->wave_projection[j][a] * w->wave_column[j][i];
    for (size_t a = 0; a < CURVE_N_PARAMETERS && curve_is_in_gap(m->samples, i); a++)
        row[a] = 0.0;
    return plain;
}

#endif
