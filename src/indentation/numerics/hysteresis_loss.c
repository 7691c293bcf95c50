/* Fit of a curve that loses work without a known spectrum. The hysteresis loss determines the
 * exponent of a power-law relaxation, and the fit is repeated with it. Other spectra of equal loss
 * have a modulus at 1/(loading time) that is a few per cent larger. The result uses their mean, and
 * the error includes their scatter.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/math/root.h"
#include "indentation/numerics/curve_fitting.h"
#include "indentation/numerics/curve_model.h"

#include <math.h>
#include <string.h>

static const double min_loss = CURVE_MIN_LOSS;
/* Largest loss with adhesion; beyond it the loss replaces the effect of the work of adhesion. */
static const double max_loss = 0.5;
static const double min_power = 1e-3, max_power = 0.8, power_tolerance = 1e-3;
static const double better_chi2 = 9.0; /* smallest 2 ln(likelihood ratio) against a relaxation */
/* Mean excess of the modulus of other spectra over that of a power law, per loss, and its standard
 * deviation. The spectra are Cole-Cole and power laws of several widths, below and above their
 * peaks. They were tested for pyramid, sphere and cone with cantilevers of 0.1 to 10 contact
 * stiffnesses. */
static const double law_shift = 0.04, law_error = 0.045;
enum {
    STEPS = 24, /* steps of the approach for its loss */
    HALF_DECADES = CURVE_POWER_TERMS,
    FASTEST = -8, /* in half decades of the loading time */
};

void curve_power_create(curve_power *to, double power, double load_time)
{
    const double ratio = pow(10.0, -0.5 * power);
    for (int i = 0; i < HALF_DECADES; i++) {
        to->time[i] = load_time * pow(10.0, 0.5 * (FASTEST + i));
        to->modulus[i] = pow(ratio, i);
    }
    to->series =
        (wt_prony){.equilibrium_modulus = to->modulus[HALF_DECADES - 1] * ratio / (1.0 - ratio),
                   .n = HALF_DECADES,
                   .modulus = to->modulus,
                   .relaxation_time = to->time};
}

/* Loss of a power law in a loop to the depth of the curve with equal speeds, with the definition of
 * curve_read_retract. The result is NaN if memory is short. */
static double power_law_loss(const curve_fitting *f, double power)
{
    const curve_samples *s = &f->input.samples;
    const double k = s->spring_constant, modulus = f->solution.p[CURVE_E];
    double time[2 * STEPS + 1], base[2 * STEPS + 1], force[2 * STEPS + 1];
    hereditary *law = &f->workspace->memory;
    curve_power rubber;
    const double top = s->position[f->input.n_all - f->n_snap - 1] - f->solution.p[CURVE_C];
    for (int i = 0; i <= 2 * STEPS; i++) {
        time[i] = (double)i / STEPS;
        base[i] = top * (i <= STEPS ? time[i] : 2.0 - time[i]);
    }
    curve_power_create(&rubber, power, 1.0);
    hereditary_begin(law, &rubber.series, modulus / hereditary_modulus(&rubber.series, 1.0),
                     1.0 / STEPS, 2.0);
    if (hereditary_loop(law, f->table, 1.0 / k, time, base, 2 * STEPS + 1, force, NULL) != WT_OK)
        return (double)NAN;
    double in = 0.0, back = 0.0;
    for (int i = 1; i <= STEPS; i++) {
        in += 0.5 * (fmax(force[i], 0.0) + fmax(force[i - 1], 0.0)) * top / STEPS;
        back += 0.5 * (fmax(force[STEPS + i], 0.0) + fmax(force[STEPS + i - 1], 0.0)) * top / STEPS;
    }
    return (in - back) / (in - 0.5 * force[STEPS] * force[STEPS] / k);
}

static double excess_loss(double power, void *user)
{
    const curve_fitting *f = user;
    return power_law_loss(f, power) - f->loss;
}

/* Finds the power with the loss of the curve; NaN if there is none. */
static double find_loss_power(curve_fitting *f)
{
    double power = (double)NAN;
    if (root_find(excess_loss, f, min_power, max_power, power_tolerance, &power, NULL) != WT_OK)
        power = (double)NAN;
    return power;
}

static void refine_solution(curve_fitting *f, const curve_solution *from)
{
    curve_refine(f->table, &f->input.samples, f->kind, from->p, f->workspace, &f->solution);
}

/* Refits the curve with a power law. Returns false and restores the fit if the times or the power
 * are not known, or the approach contradicts the relaxation. */
static bool fit_power_law(curve_fitting *f)
{
    const curve_solution elastic = f->solution;
    const bool was_described = curve_passes_misfit_test(f);
    const double power = find_loss_power(f);
    curve_power rubber;
    if (!(power > 0.0))
        return false;
    curve_power_create(&rubber, power, 1.0);
    if (!curve_prepare_relaxation(f, &rubber.series, true))
        return false;
    f->kind.memory = true;
    refine_solution(f, &elastic);
    const curve_solution *s = &f->solution;
    const bool is_worse = elastic.effective_n * log(s->cost / elastic.cost) > better_chi2;
    if (s->converged && !is_worse) {
        f->loss_power = power;
        f->loss_shift = f->loss * law_shift;
        f->loss_error = f->loss * law_error;
        f->loss_bias = elastic.p[CURVE_E] / s->p[CURVE_E] / (1.0 + f->loss_shift) - 1.0;
        return true;
    }
    if (s->converged &&
        (is_worse || was_described)) /* the loss is that of the piezo, not of the rubber */
        f->loss_power = f->loss_bias = 0.0;
    f->kind.memory = false;
    f->solution = elastic;
    return false;
}

void curve_fit_loss(curve_fitting *f)
{
    const bool has_pull = f->snap_in_pull > 0.0 || f->pull_off > 0.0 || f->kind.adhesive;
    if (!(f->loss > min_loss) || (has_pull && f->loss > max_loss) || curve_has_unknown_loss(f))
        return;
    if (!has_pull && !f->input.saturated && !f->kind.memory && !f->kind.plain && fit_power_law(f))
        return;
    f->unknown_loss = !curve_passes_misfit_test(f);
}
