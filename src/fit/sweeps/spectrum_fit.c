/* The fit of one spectrum to all isotherms: Levenberg-Marquardt over terms and shifts, noise and
 * smoothness after each step by Fellner-Schall (Wood and Fasiolo, Biometrics 73 (2017) 1071), which
 * is restricted maximum likelihood. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/spectrum.h"

#include "base/gsl_quiet.h"
#include "fit/dense.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

/* Bounds of time for what does not settle. Twelve dampings by ten leave a trillionth of a step. */
enum { MAX_STEPS = 80, MAX_DAMPINGS = 12 };
/* Done when a step gains less than this of -2 ln likelihood (a standard error is 1), and noise and
 * smoothness change by less than this share. */
static const double least_gain = SPECTRUM_LEAST_GAIN, least_change = 2e-3;
/* The same where that is good enough: a third of a standard error, and noise to 2 %, while points
 * that are five standard deviations off are looked for; and where only the objective is wanted, by
 * differences of which weights are made, exp(-0.01). */
static const double rough_gain = 0.1, rough_change = 0.02, held_gain = 0.02;
/* Where a trial only asks whether much less is left, 30 % of the noise: share of the objective. */
static const double trial_gain = 0.005;

static gsl_matrix_view leading_block(gsl_matrix *m, size_t n)
{
    return gsl_matrix_submatrix(m, 0, 0, n, n);
}

/* Factor of precision + damping * its diagonal. */
static bool factor_damped(spectrum *s, double damping)
{
    const size_t n = s->n_unknowns;
    gsl_matrix_view factor = leading_block(s->factor, n),
                    precision = leading_block(s->precision, n);
    gsl_matrix_memcpy(&factor.matrix, &precision.matrix);
    for (size_t i = 0; i < n; i++)
        *gsl_matrix_ptr(s->factor, i, i) *= 1.0 + damping;
    return dense_factor(&factor.matrix);
}

static wt_status invert_precision(spectrum *s, wt_error *err)
{
    const size_t n = s->n_unknowns;
    gsl_matrix_view factor = leading_block(s->factor, n),
                    covariance = leading_block(s->covariance, n);
    if (!factor_damped(s, 0.0))
        return wt_fail(err, WT_E_CONVERGENCE, "the isotherms do not determine a spectrum");
    s->log_det = 0.0;
    for (size_t i = 0; i < n; i++)
        s->log_det += 2.0 * log(gsl_matrix_get(s->factor, i, i));
    gsl_matrix_view scratch = leading_block(s->scratch, n);
    dense_inverse(&factor.matrix, &scratch.matrix, &covariance.matrix);
    return WT_OK;
}

/* A step that does not raise the objective; what it gained. */
static wt_status take_step(spectrum *s, double *damping, double *gain, wt_error *err)
{
    const size_t n = s->n_unknowns;
    *gain = 0.0;
    for (int i = 0; i < MAX_DAMPINGS; i++) {
        gsl_matrix_view factor = leading_block(s->factor, n);
        gsl_vector_view move = gsl_vector_subvector(s->direction, 0, n);
        gsl_vector_view gradient = gsl_vector_subvector(s->gradient, 0, n);
        if (!factor_damped(s, *damping)) {
            *damping = fmax(10.0 * *damping, 1e-6);
            continue;
        }
        gsl_linalg_cholesky_solve(&factor.matrix, &gradient.vector, &move.vector);
        for (size_t u = 0; u < n; u++)
            s->trial[u] = s->value[u] + gsl_vector_get(s->direction, u);
        spectrum_evaluate(s, s->trial, false);
        const double next = spectrum_objective(s, s->trial);
        if (next <= s->objective) { /* also false for NaN */
            memcpy(s->value, s->trial, n * sizeof *s->value);
            *gain = s->objective - next;
            *damping = *damping > 1e-6 ? *damping / 10.0 : 0.0;
            return WT_OK;
        }
        *damping = fmax(10.0 * *damping, 1e-3);
    }
    return isfinite(s->objective)
               ? WT_OK
               : wt_fail(err, WT_E_CONVERGENCE, "no spectrum describes the isotherms");
}

/* Noise and smoothness have changed. */
static void assemble_objective(spectrum *s)
{
    spectrum_assemble(s);
    s->objective = spectrum_objective(s, s->value);
}

static void prepare_equations(spectrum *s)
{
    spectrum_evaluate(s, s->value, true);
    spectrum_normal(s);
    assemble_objective(s);
}

wt_status spectrum_fit(spectrum *s, spectrum_mode mode, wt_error *err)
{
    const bool rough = mode == SPECTRUM_ROBUST || mode == SPECTRUM_ROUGH;
    const bool held = mode == SPECTRUM_HELD || mode == SPECTRUM_TRIAL;
    const double enough_gain = rough ? rough_gain : held ? held_gain : least_gain;
    wt_status status = WT_OK;
    double damping = 0.0, gain = HUGE_VAL, change = 0.0;
    bool done = false;
    gsl_quiet();
    s->smooth_move = 0.0;
    prepare_equations(s);
    for (int i = 0; status == WT_OK && !done && i < MAX_STEPS; i++) {
        status = take_step(s, &damping, &gain, err);
        if (status != WT_OK)
            break;
        prepare_equations(s);
        if (!held) {
            status = invert_precision(s, err);
            if (status != WT_OK)
                break;
            change = spectrum_noise_update(s);
        }
        if (mode == SPECTRUM_ROBUST) {
            spectrum_student_weights(s);
            prepare_equations(s);
        } else {
            assemble_objective(s);
        }
        done = gain < enough_gain && change < (rough ? rough_change : least_change);
        done = done || (mode == SPECTRUM_TRIAL && gain < trial_gain * s->objective);
    }
    if (status == WT_OK)
        status = invert_precision(s, err);
    if (status == WT_OK)
        spectrum_criterion(s);
    return status;
}
