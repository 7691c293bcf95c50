/* A curve of rubber that loses work, and no spectrum of it is known. The work that the way out does
 * not give back says which power of time the relaxation is near to; with this memory the fit is
 * made once more. It tells what the loss does to the modulus of the fit without memory, and whether
 * loss is all that this fit lacks.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fit/curve_fitting.h"

#include "model/tip.h"

#include <math.h>

/* Of the work: less than that is piezo and noise. */
static const double least_loss = 0.03;
/* With adhesion: beyond it the shape of loss stands for what the work of adhesion should. */
static const double most_loss = 0.5;
static const double most_power = 0.8, power_close = 1e-3;
/* Lever over contact: with a softer one the bias hangs on more of the spectrum than the loss tells.
 */
static const double least_lever = 0.5;
enum {
    STEPS = 24, /* of a way in, for its loss */
    HALF_DECADES = CURVE_POWER_TERMS,
    FASTEST = -8, /* in half decades of the loading time */
    MAX_ROUNDS = 20,
};

/* E(t) = t^-power from 1e-4 to 1e3 times the loading time, and a rest for what is slower. */
typedef struct power_law {
    double modulus[HALF_DECADES], time[HALF_DECADES];
    wt_prony series;
} power_law;

static void make_power(power_law *to, double power, double load_time)
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

/* Work that a power law loses in a loop as deep as that of the curve, in and out at one speed, as
 * curve_read_retract counts it. NaN if there is no memory. */
static double loss_of(const curve_fitting *f, double power)
{
    const double k = f->input.samples.spring_constant, modulus = f->solution.p[CURVE_E];
    double time[2 * STEPS + 1], base[2 * STEPS + 1], force[2 * STEPS + 1], g, slope;
    const wt_tip *tip = contact_table_tip(f->table);
    hereditary *law = &f->workspace->memory;
    power_law rubber;
    wt_contact_function(tip, f->solution.max_indentation, &g, &slope);
    const double top = f->solution.max_indentation + modulus * g / k;
    for (int i = 0; i <= 2 * STEPS; i++) {
        time[i] = (double)i / STEPS;
        base[i] = top * (i <= STEPS ? time[i] : 2.0 - time[i]);
    }
    make_power(&rubber, power, 1.0);
    hereditary_begin(law, &rubber.series, modulus / hereditary_modulus(&rubber.series, 1.0),
                     1.0 / STEPS, 2.0);
    if (hereditary_loop(law, tip, 1.0 / k, time, base, 2 * STEPS + 1, force, NULL) != WT_OK)
        return (double)NAN;
    double in = 0.0, back = 0.0;
    for (int i = 1; i <= STEPS; i++) {
        in += 0.5 * (fmax(force[i], 0.0) + fmax(force[i - 1], 0.0)) * top / STEPS;
        back += 0.5 * (fmax(force[STEPS + i], 0.0) + fmax(force[STEPS + i - 1], 0.0)) * top / STEPS;
    }
    return (in - back) / (in - 0.5 * force[STEPS] * force[STEPS] / k);
}

/* The power that loses what the curve does; NaN if none does. */
static double find_power(const curve_fitting *f)
{
    double low = 0.0, high = most_power, below = -f->loss, above = loss_of(f, high) - f->loss;
    if (!(above > 0.0))
        return (double)NAN;
    for (int i = 0; i < MAX_ROUNDS && high - low > power_close; i++) { /* Illinois */
        const double power = low + (high - low) * below / (below - above);
        const double found = loss_of(f, power) - f->loss;
        if (isnan(found))
            return found;
        if (fabs(found) < power_close)
            return power;
        if (found < 0.0) {
            low = power;
            below = found;
            above *= 0.5;
        } else {
            high = power;
            above = found;
            below *= 0.5;
        }
    }
    return 0.5 * (low + high);
}

static void refine(curve_fitting *f, const curve_solution *from)
{
    curve_refine(f->table, &f->input.samples, f->kind, from->p, f->workspace, &f->solution);
}

/* The fit with the memory of a power law; not converged where times or a power are not known. */
static curve_solution with_memory(curve_fitting *f)
{
    const curve_solution elastic = f->solution;
    curve_solution found = {.converged = false};
    power_law rubber;
    const double power = find_power(f);
    if (!(power > 0.0))
        return found;
    make_power(&rubber, power, 1.0);
    if (!curve_remember(f, &rubber.series, true))
        return found;
    f->kind.memory = f->kind.lossy = true;
    refine(f, &elastic);
    found = f->solution;
    f->kind.memory = f->kind.lossy = false;
    f->solution = elastic;
    return found;
}

static bool is_soft(const curve_fitting *f)
{
    double g, slope;
    wt_contact_function(contact_table_tip(f->table), f->solution.max_indentation, &g, &slope);
    return f->input.samples.spring_constant < least_lever * f->solution.p[CURVE_E] * slope;
}

void curve_allow_loss(curve_fitting *f)
{
    const bool pull = f->snap_on > 0.0 || f->pull_off > 0.0 || f->kind.adhesive;
    if (!(f->loss > least_loss) || (pull && f->loss > most_loss))
        return;
    curve_solution lossy = {.converged = false};
    if (!pull && !f->kind.memory && !f->kind.plain)
        lossy = with_memory(f);
    const bool explains = lossy.converged && !(lossy.lack.chance < f->options->least_chance);
    if (lossy.converged && !is_soft(f))
        f->loss_bias = f->solution.p[CURVE_E] / lossy.p[CURVE_E] - 1.0;
    if (!curve_fits(f)) {
        const curve_solution elastic = f->solution;
        f->kind.lossy = true;
        refine(f, &elastic);
    }
    if (explains)
        f->solution.lack = lossy.lack;
}
