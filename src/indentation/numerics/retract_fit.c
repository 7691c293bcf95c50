/* Fit of a contact law to the retract of one force curve.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"

#include "core/math/students_t.h"
#include "indentation/law/adhesion.h"
#include "indentation/law/tip.h"

#include <math.h>

/* Parameter of a law for the pull-off force; NaN if the law does not apply. */
static double pull_off_parameter(const curve_fitting *f, const curve_kind *kind, double reduced)
{
    if (kind->constant_pull)
        return f->pull_off;
    return sqrt(
        adhesion_work(f->table, reduced, f->unloading.samples.spring_constant, f->pull_off));
}

bool curve_fit_unloading(const curve_fitting *f, const curve_kind *kind, const curve_solution *in,
                         curve_solution *out)
{
    const curve_samples *s = &f->unloading.samples;
    const size_t jump = f->unloading.jump;
    const bool adhesive = jump > 0;
    const curve_kind fitted = {.tilt = kind->tilt,
                               .adhesive = adhesive,
                               .constant_pull = adhesive && kind->constant_pull,
                               .jump = jump};
    double p[CURVE_N_PARAMETERS] = {[CURVE_E] = in->p[CURVE_E], [CURVE_C] = in->p[CURVE_C]};
    if (s->n < CURVE_MIN_SAMPLES ||
        (adhesive && (jump < CURVE_BASELINE_SAMPLES || s->n - jump < CURVE_CONTACT_SAMPLES)))
        return false;
    if (fitted.adhesive && !fitted.constant_pull && !adhesion_applies(contact_table_tip(f->table)))
        return false;
    if (adhesive)
        p[CURVE_W] = pull_off_parameter(f, kind, p[CURVE_E]);
    if (isnan(p[CURVE_W]))
        return false;
    curve_refine(f->table, s, fitted, p, f->workspace, out);
    return out->effective_n > 0.0;
}

/* Fits the laws and returns the best. Returns false if none fits. */
static bool fit_best_law(const curve_fitting *f, curve_solution *best, curve_kind *kind)
{
    const bool adhesive = f->unloading.jump > 0;
    bool found = false;
    for (int pull = 0; pull <= adhesive; pull++) {
        const curve_kind law = {.tilt = f->kind.tilt,
                                .adhesive = adhesive,
                                .constant_pull = pull,
                                .jump = f->unloading.jump};
        curve_solution out;
        if (!curve_fit_unloading(f, &law, &f->solution, &out) || !out.converged ||
            (found && !(out.cost < best->cost)))
            continue;
        found = true;
        *best = out;
        *kind = law;
    }
    return found;
}

static void append_retract_modulus(const curve_fitting *f, wt_indent_fit *fit)
{
    const double error = hypot(fit->modulus.standard_error, fit->retract_modulus.standard_error);
    char text[160];
    if (!wt_curve_verdict_is_usable(fit->verdict) || !(fabs(f->loss) < CURVE_MIN_LOSS) ||
        !(fabs(fit->retract_modulus.value - fit->modulus.value) > NORMAL_95 * error))
        return;
    curve_set_reason(text, "; the retract gives %s +- %s",
                     curve_format_si(fit->retract_modulus.value, "Pa").buffer,
                     curve_format_si(fit->retract_modulus.standard_error, "Pa").buffer);
    curve_append_note(fit->reason, text);
}

void curve_report_unloading(curve_fitting *f, wt_indent_fit *fit)
{
    const double reduced = 1.0 - f->options->poisson_ratio * f->options->poisson_ratio;
    curve_fitting out = *f;
    if (!fit_best_law(f, &out.solution, &out.kind))
        return;
    out.input.samples = f->unloading.samples;
    out.snap_in_pull = 0.0;
    curve_add_misfit(&out);
    const curve_solution *s = &out.solution;
    fit->retract_modulus.value = reduced * s->p[CURVE_E];
    fit->retract_modulus.standard_error = reduced * s->standard_error[CURVE_E];
    const double root = s->p[CURVE_W], error = s->standard_error[CURVE_W];
    if (out.kind.constant_pull) {
        fit->retract_pull.value = root;
        fit->retract_pull.standard_error = error;
    } else if (out.kind.adhesive) {
        fit->retract_work.value = root * root;
        fit->retract_work.standard_error = 2.0 * root * error;
    }
    append_retract_modulus(f, fit);
}
