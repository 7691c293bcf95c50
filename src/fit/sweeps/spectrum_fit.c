/* The fit of one spectrum to all isotherms: Levenberg-Marquardt over terms and shifts, noise and
 * smoothness after each step by Fellner-Schall (Wood and Fasiolo, Biometrics 73 (2017) 1071), which
 * is restricted maximum likelihood. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/spectrum.h"

#include "base/gsl_quiet.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* Bounds of time for what does not settle. Twelve dampings by ten leave a trillionth of a step. */
enum { MAX_DAMPINGS = 12 };
/* What has not settled by then is said to be unsettled; a start need not. */
static const int most_steps[] = {[SPECTRUM_NOISE] = 300,
                                 [SPECTRUM_ROUGH] = 80,
                                 [SPECTRUM_ROBUST] = 40,
                                 [SPECTRUM_HELD] = 80,
                                 [SPECTRUM_TRIAL] = 80};
/* Done when a step gains less than this of -2 ln likelihood (a standard error is 1), and noise and
 * smoothness change by less than this share. */
static const double least_gain = SPECTRUM_LEAST_GAIN, least_change = 2e-3;
/* The same where that is good enough: a third of a standard error, and noise to 2 %, while points
 * that are five standard deviations off are looked for; and where only the objective is wanted, by
 * differences of which weights are made, exp(-0.01). */
static const double rough_gain = 0.1, rough_change = 0.02, held_gain = 0.02;
/* Where a trial only asks whether much less is left, 30 % of the noise: share of the objective. */
static const double trial_gain = 0.005;

/* Of a diagonal: more is no rounding. */
static const double most_rounding = 1e-8;

/* Factor of precision + damping * its diagonal. What is smooth in the vertical shifts is no
 * unknown: it is not damped, and the diagonal of a vertical shift is that which it leaves. */
static bool factor_damped(spectrum *s, double damping)
{
    bordered_copy(&s->factor, &s->precision);
    for (size_t i = 0; i < s->n_linear; i++)
        *gsl_matrix_ptr(s->factor.border, i, i) *= 1.0 + damping;
    for (size_t i = 0; i < s->n_curves; i++) {
        double *own = s->factor.own + BLOCK_OWN * i;
        double smooth = 0.0;
        for (size_t j = 0; j < s->prior->n_smooth; j++)
            smooth +=
                pow(gsl_matrix_get(s->precision.side, BLOCK_SIDE * i + 1, s->n_linear + j), 2);
        own[0] += s->column_a[i] < 0 ? 0.0 : damping * own[0];
        own[2] += s->column_b[i] < 0 ? 0.0 : damping * (own[2] - smooth);
    }
    return bordered_factor(&s->factor);
}

void spectrum_solve(const spectrum *s, const double *y, double *x)
{
    double *border = s->border, *side = s->side;
    memset(border, 0, s->factor.m * sizeof *border);
    memcpy(border, y, s->n_linear * sizeof *border);
    for (size_t i = 0; i < s->n_curves; i++) {
        side[BLOCK_SIDE * i] = s->column_a[i] < 0 ? 0.0 : y[s->column_a[i]];
        side[BLOCK_SIDE * i + 1] = s->column_b[i] < 0 ? 0.0 : y[s->column_b[i]];
    }
    bordered_solve(&s->factor, border, side);
    memcpy(x, border, s->n_linear * sizeof *border);
    for (size_t i = 0; i < s->n_curves; i++) {
        if (s->column_a[i] >= 0)
            x[s->column_a[i]] = side[BLOCK_SIDE * i];
        if (s->column_b[i] >= 0)
            x[s->column_b[i]] = side[BLOCK_SIDE * i + 1];
    }
}

double spectrum_variance(const spectrum *s, size_t curve)
{
    return s->covariance.own[BLOCK_OWN * curve];
}

static wt_status invert_precision(spectrum *s, wt_error *err)
{
    /* little noise beside a loose prior: rounding may leave no more than a part in 1/(n epsilon) of
     * a diagonal, which is given back */
    double rounding = 0.0;
    while (!factor_damped(s, rounding) && rounding < most_rounding)
        rounding = fmax(10.0 * rounding, (double)s->n_unknowns * DBL_EPSILON);
    if (!(rounding < most_rounding))
        return wt_fail(err, WT_E_CONVERGENCE, "the isotherms do not determine a spectrum");
    s->rounding = rounding;
    s->log_det = bordered_log_det(&s->factor);
    bordered_inverse(&s->factor, s->scratch, &s->covariance);
    return WT_OK;
}

/* A step that does not raise the objective; what it gained. */
static wt_status take_step(spectrum *s, double *damping, double *gain, wt_error *err)
{
    const size_t n = s->n_unknowns;
    *gain = 0.0;
    for (int i = 0; i < MAX_DAMPINGS; i++) {
        if (!factor_damped(s, *damping)) {
            *damping = fmax(10.0 * *damping, 1e-6);
            continue;
        }
        spectrum_solve(s, s->gradient->data, s->direction->data);
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
    for (int i = 0; status == WT_OK && !done && i < most_steps[mode]; i++) {
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
    s->settled = done;
    if (status == WT_OK)
        status = invert_precision(s, err);
    if (status == WT_OK)
        spectrum_criterion(s);
    return status;
}
