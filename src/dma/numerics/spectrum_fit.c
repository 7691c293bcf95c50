/* Fits one spectrum to all isotherms: Levenberg-Marquardt over terms and shifts. After each step
 * noise and smoothness are updated by Fellner-Schall (Wood and Fasiolo, Biometrics 73 (2017)
 * 1071), which is restricted maximum likelihood.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include "core/math/special.h"
#include <float.h>
#include <gsl/gsl_cblas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Limits of a step. Twelve dampings by ten leave 1e-12 of it. With a large misfit the objective
 * has curved valleys, where a half or an eighth of a step gains more than a damped one. */
enum { MAX_DAMPINGS = 12, MAX_TRIALS = 4 };
/* A step is shortened to the minimum of the parabola if that is nearer than this share of it, and
 * less than `far` standard errors remain (squared). Farther away the objective is no parabola. */
static const double shortest = 0.7, far = 4.0;
/* Maximum number of steps. A fit that reaches it is reported as not converged, except a start. */
static const int max_steps[] = {
    [SPECTRUM_NOISE] = 300, [SPECTRUM_ROUGH] = 80, [SPECTRUM_ROBUST] = 40, [SPECTRUM_TRIAL] = 80};
/* Steps and noise depend on each other, so the iteration may cycle if the misfit is large. After
 * this number of steps, three times that of a valid sweep, the updates shrink (Robbins and
 * Monro, Ann. Math. Stat. 22 (1951) 400). */
static const double whole_steps = 30.0;
/* The fit ends if a step gains less than this of -2 ln likelihood (1 is a standard error), and
 * noise and smoothness change by less than this share. */
static const double least_gain = SPECTRUM_MIN_GAIN, min_change = 2e-3;
/* Limits of rough fits: a third of a standard error and 0.5 % of the noise suffice to find points
 * with five standard deviations. With fixed noise only the objective matters, whose differences
 * become weights, exp(-0.01). */
static const double rough_gain = 0.1, rough_change = 0.005, held_gain = 0.02;
/* Limits of a trial, which must only detect 30 % less noise, half of the objective. They are
 * shares of the objective gained by a step and left for the next. */
static const double trial_gain = 0.005, trial_left = 0.1;

/* Maximum relative addition to a diagonal that rounding explains. */
static const double max_rounding = 1e-8;

/* Factors precision + damping * diagonal. The smooth part of the vertical shifts is no unknown
 * and is not damped. The diagonal of a vertical shift is the one without it. */
static bool factor_damped(spectrum *s, double damping)
{
    if (s->inverted && damping == s->rounding)
        return true; /* of the same precision */
    s->inverted = false;
    bordered_copy(&s->factor, &s->precision);
    for (size_t i = 0; i < s->n_shared; i++)
        *gsl_matrix_ptr(s->factor.border, i, i) *= 1.0 + damping;
    for (size_t i = 0; i < s->n_curves; i++) {
        double *diagonal = s->factor.diagonal + BLOCK_DIAGONAL * i;
        double smooth_sum = 0.0;
        for (size_t j = 0; j < s->prior->n_smooth; j++)
            smooth_sum +=
                pow(gsl_matrix_get(s->precision.side, BLOCK_SIDE * i + 1, s->n_shared + j), 2);
        diagonal[0] += s->column_a[i] < 0 ? 0.0 : damping * diagonal[0];
        diagonal[2] += s->column_b[i] < 0 ? 0.0 : damping * (diagonal[2] - smooth_sum);
    }
    return bordered_factor(&s->factor);
}

void spectrum_split(const spectrum *s, const double *y, double *border, double *side)
{
    memcpy(border, y, s->n_shared * sizeof *border);
    for (size_t i = 0; i < s->n_curves; i++) {
        side[BLOCK_SIDE * i] = s->column_a[i] < 0 ? 0.0 : y[s->column_a[i]];
        side[BLOCK_SIDE * i + 1] = s->column_b[i] < 0 ? 0.0 : y[s->column_b[i]];
    }
}

void spectrum_join(const spectrum *s, const double *border, const double *side, double *x)
{
    memcpy(x, border, s->n_shared * sizeof *border);
    for (size_t i = 0; i < s->n_curves; i++) {
        if (s->column_a[i] >= 0)
            x[s->column_a[i]] = side[BLOCK_SIDE * i];
        if (s->column_b[i] >= 0)
            x[s->column_b[i]] = side[BLOCK_SIDE * i + 1];
    }
}

/* Solves x = covariance times y for unknowns; x and y may be the same. */
static void spectrum_solve(const spectrum *s, const double *y, double *x)
{
    memset(s->border, 0, s->factor.m * sizeof *s->border);
    spectrum_split(s, y, s->border, s->side);
    bordered_solve_lower(&s->factor, s->border, s->side);
    bordered_solve_upper(&s->factor, s->border, s->side);
    spectrum_join(s, s->border, s->side, x);
}

double spectrum_variance(const spectrum *s, size_t curve)
{
    return s->covariance.diagonal[BLOCK_DIAGONAL * curve];
}

static wt_status invert_precision(spectrum *s, wt_error *err)
{
    /* With little noise and a loose prior, rounding may remove a diagonal element; the loop adds
     * it back. */
    double rounding = 0.0;
    if (s->inverted)
        return WT_OK;
    while (!factor_damped(s, rounding) && rounding < max_rounding)
        rounding = fmax(10.0 * rounding, (double)s->n_unknowns * DBL_EPSILON);
    if (!(rounding < max_rounding))
        return wt_fail(err, WT_E_CONVERGENCE, "the isotherms do not determine a spectrum");
    s->rounding = rounding;
    s->log_det = bordered_log_det(&s->factor);
    bordered_inverse(&s->factor, s->scratch, &s->covariance);
    s->inverted = true;
    return WT_OK;
}

/* Computes the products of the derivatives of the residuals by the frame compliance with those by
 * the terms, weighed by the noise; product: [n_terms]. */
static void compute_compliance_products(const spectrum *s, double *product)
{
    const size_t width = s->n_shared + 2;
    double *const by_compliance = wt_alloc(s->n, sizeof *by_compliance);
    memset(product, 0, s->n_terms * sizeof *product);
    for (int q = 0; q < MODULI; q++) {
        for (size_t k = 0; k < s->n; k++) {
            double corrected[MODULI], by[MODULI][INSTRUMENT_ERRORS];
            instrument_correct(s, s->value + s->n_linear, k, corrected, by);
            by_compliance[k] = -spectrum_weight(s, k, q) * by[q][FRAME_COMPLIANCE];
        }
        for (size_t i = 0; i < s->n_curves; i++)
            spectrum_whiten(s, i, q, by_compliance + s->first[i], 1);
        cblas_dgemv(CblasRowMajor, CblasTrans, (int)s->n, (int)s->n_terms,
                    1.0 / (s->noise[q] * s->noise[q]), s->row[q], (int)width, by_compliance, 1, 1.0,
                    product, 1);
    }
    free(by_compliance);
}

/* Sets the elements of the frame compliance, the last of the shared unknowns, by its products with
 * the terms, and by the negative change of the terms with it; n = 0: it has its prior alone. */
static void set_compliance_elements(spectrum *s, size_t n, const double *product,
                                    const double *response)
{
    const size_t c = s->n_linear + FRAME_COMPLIANCE;
    gsl_matrix *const border = s->precision.border, *const side = s->precision.side;
    for (size_t j = 0; j < c; j++) {
        const double x =
            j < n ? product[j]
                  : cblas_ddot((int)n, gsl_matrix_ptr(border, 0, j), (int)border->tda, response, 1);
        gsl_matrix_set(border, c, j, x);
        gsl_matrix_set(border, j, c, x);
    }
    gsl_matrix_set(border, c, c, 1.0 + cblas_ddot((int)n, product, 1, response, 1));
    for (size_t k = 0; k < BLOCK_SIDE * s->n_curves; k++)
        gsl_matrix_set(side, k, c, cblas_ddot((int)n, gsl_matrix_ptr(side, k, 0), 1, response, 1));
    s->inverted = false;
}

wt_status spectrum_consider_compliance(spectrum *s, wt_error *err)
{
    const size_t n = s->n_terms;
    const double log_det = s->log_det;
    if (instrument_count(s) == 0)
        return WT_OK;
    gsl_matrix *const terms = gsl_matrix_alloc(n, n);
    gsl_vector *const product = gsl_vector_alloc(n), *const response = gsl_vector_alloc(n);
    const gsl_matrix_const_view all = gsl_matrix_const_submatrix(s->precision.border, 0, 0, n, n);
    gsl_matrix_transpose_memcpy(terms, &all.matrix); /* the upper triangle is complete */
    gsl_vector_view diagonal = gsl_matrix_diagonal(terms);
    gsl_vector_scale(&diagonal.vector, 1.0 + s->rounding); /* as in the factor */
    compute_compliance_products(s, product->data);
    wt_status status = WT_OK;
    if (gsl_linalg_cholesky_decomp1(terms) == GSL_SUCCESS &&
        gsl_linalg_cholesky_solve(terms, product, response) == GSL_SUCCESS) {
        set_compliance_elements(s, n, product->data, response->data);
        status = invert_precision(s, err);
        set_compliance_elements(s, 0, NULL, NULL);
        s->log_det = log_det;
    } else {
        status = wt_fail(err, WT_E_CONVERGENCE, "the isotherms do not determine a spectrum");
    }
    gsl_matrix_free(terms);
    gsl_vector_free(product);
    gsl_vector_free(response);
    return status;
}

double spectrum_step_left(const spectrum *s)
{
    double sum = 0.0;
    spectrum_solve(s, s->gradient->data, s->direction->data);
    for (size_t u = 0; u < s->n_unknowns; u++)
        sum += s->gradient->data[u] * s->direction->data[u];
    return sqrt(fmax(sum, 0.0));
}

/* Returns true if a Newton step gains little. Noise and smoothness may require further steps,
 * and a damped step gains little. */
static bool has_converged(spectrum *s, double enough_gain)
{
    return !factor_damped(s, 0.0) || spectrum_step_left(s) < sqrt(enough_gain);
}

/* Tries a step and shortens it to the minimum of a parabola through its start and end if it goes
 * far beyond that. The terms are exponential, so some steps are twice too long, without which the
 * iteration swings about the minimum. Returns the gain, or a negative number. */
static double line_search(spectrum *s)
{
    double gain = -1.0, share = 1.0, slope = 0.0;
    for (size_t u = 0; u < s->n_unknowns; u++)
        slope += s->gradient->data[u] * s->direction->data[u];
    for (int i = 0; i < MAX_TRIALS; i++) {
        for (size_t u = 0; u < s->n_unknowns; u++)
            s->candidate[u] = s->value[u] + share * gsl_vector_get(s->direction, u);
        spectrum_evaluate(s, s->candidate, true); /* most trials are accepted */
        gain = s->objective - spectrum_objective(s, s->candidate);
        const double best = share * slope / (2.0 * share * slope - gain); /* in steps */
        if (gain >= 0.0 && (slope > far || best > shortest))
            break;
        share *= slope > far ? 0.5 : fmax(best, 0.5); /* also handles NaN */
    }
    return gain >= 0.0 ? gain : -1.0;
}

/* Performs a damped step that does not raise the objective, and leaves the rows of the values that
 * it reached. *gain: its gain. */
static wt_status damped_step(spectrum *s, double *damping, double *gain, wt_error *err)
{
    *gain = 0.0;
    for (int i = 0; i < MAX_DAMPINGS; i++) {
        if (!factor_damped(s, *damping)) {
            *damping = fmax(10.0 * *damping, 1e-6);
            continue;
        }
        spectrum_solve(s, s->gradient->data, s->direction->data);
        const double gained = line_search(s);
        if (gained >= 0.0) {
            memcpy(s->value, s->candidate, s->n_unknowns * sizeof *s->value);
            *gain = gained;
            *damping = *damping > 1e-6 ? *damping / 10.0 : 0.0;
            return WT_OK;
        }
        *damping = fmax(10.0 * *damping, 1e-3);
    }
    spectrum_evaluate(s, s->value, true);
    return isfinite(s->objective)
               ? WT_OK
               : wt_fail(err, WT_E_CONVERGENCE, "no spectrum describes the isotherms");
}

/* Assembles the equations after a change of noise or smoothness. */
static void assemble_objective(spectrum *s)
{
    spectrum_assemble(s);
    s->objective = spectrum_objective(s, s->value);
}

/* Makes the equations of the rows of the present values. */
static void make_equations(spectrum *s)
{
    spectrum_normal(s);
    assemble_objective(s);
}

static void prepare_equations(spectrum *s)
{
    spectrum_evaluate(s, s->value, true);
    make_equations(s);
}

wt_status spectrum_refresh(spectrum *s, wt_error *err)
{
    s->may_reuse = false;
    prepare_equations(s);
    return invert_precision(s, err);
}

void spectrum_step_residuals(spectrum *s)
{
    const int m = (int)s->n_shared;
    const double *const step = s->direction->data;
    (void)spectrum_step_left(s);
    for (size_t i = 0; i < s->n_curves; i++)
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++)
            for (int q = 0; q < MODULI; q++) {
                const double *const row = s->row[q] + k * (s->n_shared + 2);
                s->residual[q][k] -= cblas_ddot(m, row, 1, step, 1);
                s->residual[q][k] -= s->column_a[i] < 0 ? 0.0 : row[m] * step[s->column_a[i]];
                s->residual[q][k] -= s->column_b[i] < 0 ? 0.0 : row[m + 1] * step[s->column_b[i]];
            }
}

void spectrum_start_from(spectrum *s, const spectrum *fitted)
{
    const double last = (double)fitted->n_terms - 1.0;
    const double end = s->log_tau + ((double)s->n_terms - 0.5) * s->step;
    double slower = fitted->liquid ? 0.0 : exp(fitted->value[fitted->n_terms]);
    for (size_t j = 0; j < s->n_terms; j++) {
        const double at =
            fmin(fmax((s->log_tau - fitted->log_tau + (double)j * s->step) / fitted->step, 0.0),
                 last - 1.0);
        const double *y = fitted->value + (size_t)at;
        s->value[j] = log(s->step / fitted->step) + y[0] + (at - floor(at)) * (y[1] - y[0]);
    }
    for (size_t j = 0; j < fitted->n_terms; j++)
        slower += fitted->log_tau + (double)j * fitted->step > end ? exp(fitted->value[j]) : 0.0;
    if (!s->liquid && slower > 0.0)
        s->value[s->n_terms] = log(slower);
    for (size_t i = 0; i < instrument_count(s); i++)
        s->value[s->n_linear + i] = fitted->value[fitted->n_linear + i];
}

double spectrum_expected_objective(spectrum *s)
{
    prepare_equations(s);
    return factor_damped(s, 0.0) ? s->objective - pow(spectrum_step_left(s), 2) : -HUGE_VAL;
}

void spectrum_keep(spectrum *s)
{
    memcpy(s->kept_value, s->value, s->n_unknowns * sizeof *s->value);
    memcpy(s->kept_noise, s->noise, sizeof s->noise);
    s->kept_smooth = s->smoothness;
    s->kept_rho = s->rho;
}

void spectrum_return(spectrum *s)
{
    memcpy(s->value, s->kept_value, s->n_unknowns * sizeof *s->value);
    memcpy(s->noise, s->kept_noise, sizeof s->noise);
    s->smoothness = s->kept_smooth;
    s->rho = s->kept_rho;
}

wt_status spectrum_fit(spectrum *s, spectrum_mode mode, wt_error *err)
{
    const bool rough = mode == SPECTRUM_ROBUST || mode == SPECTRUM_ROUGH;
    const bool held = mode == SPECTRUM_TRIAL;
    const double settled = rough ? rough_change : min_change;
    const double least = rough ? rough_gain : held ? held_gain : least_gain;
    const bool final = mode == SPECTRUM_NOISE;
    wt_status status = WT_OK;
    double damping = 0.0, gain = HUGE_VAL, change = 0.0;
    bool done = false;
    gsl_quiet();
    s->may_reuse = final; /* the weights of the others change */
    prepare_equations(s);
    for (int i = 0; status == WT_OK && !done && i < max_steps[mode]; i++) {
        status = damped_step(s, &damping, &gain, err);
        if (status != WT_OK)
            break;
        if (mode == SPECTRUM_ROBUST)
            spectrum_student_weights(s);
        make_equations(s);
        if (!held) {
            status = invert_precision(s, err);
            if (status != WT_OK)
                break;
            change = spectrum_noise_update(s, fmin(1.0, whole_steps / (double)(i + 1)), settled);
            if (change >= settled)
                assemble_objective(s);
        }
        const bool is_trial = mode == SPECTRUM_TRIAL;
        const double enough = is_trial ? fmax(least, trial_gain * s->objective) : least;
        done = (gain < enough || final) && change < settled &&
               has_converged(s, is_trial ? fmax(least, trial_left * s->objective) : least);
    }
    s->settled = done;
    if (status == WT_OK)
        status = invert_precision(s, err);
    if (status == WT_OK)
        spectrum_criterion(s);
    return status;
}

/* ---- correlation along the isotherms --------------------------------------------------------- */

/* Correlations of neighbouring points from which the criterion selects. The steps are about one
 * standard error for 30 points. */
static const double rhos[] = {0.0, 0.2, 0.4, 0.6, 0.75, 0.88};
enum { RHOS = sizeof rhos / sizeof *rhos };

wt_status spectrum_choose_rho(spectrum *s, wt_error *err)
{
    double best = s->criterion;
    wt_status status = WT_OK;
    spectrum_keep(s);
    for (size_t i = 1; status == WT_OK && i < RHOS; i++) {
        s->rho = rhos[i];
        status = spectrum_fit(s, SPECTRUM_ROUGH, err);
        if (status != WT_OK || s->criterion >= best)
            break; /* the criterion has one minimum */
        best = s->criterion;
        spectrum_keep(s);
    }
    spectrum_return(s);
    return status;
}
