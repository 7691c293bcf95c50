/* Force of a fit along a curve for tables and figures, with viscoelasticity or adhesion where
 * fitted.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/fitted_force.h"

#include "core/data/force_curve.h"
#include "indentation/law/adhesion.h"
#include "indentation/law/hereditary.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <stdlib.h>

/* Replaces elastic forces over modulus by viscoelastic forces. */
static void apply_relaxation(const wt_prony *spectrum, const double *time, size_t n, double *force)
{
    hereditary law = {0};
    double before = 0, shortest = (double)INFINITY;
    hereditary_reserve(&law, spectrum->n);
    for (size_t i = 1; i < n; i++)
        shortest = fmin(shortest, time[i] - time[i - 1]);
    if (n > 1 && shortest > 0) {
        hereditary_begin(&law, spectrum, 1, shortest, time[n - 1] - time[0]);
        for (size_t i = 0; i < n; i++) {
            const double f = force[i];
            hereditary_set_step(&law, i > 0 ? time[i] - time[i - 1] : shortest);
            force[i] = hereditary_force(&law, hereditary_decay(&law, law.memory[0]), before, f);
            hereditary_add_change(&law, law.memory[0], f - before);
            before = f;
        }
    }
    hereditary_clear(&law);
}

/* Computes forces with adhesion at the measured indentation. Infinite stiffness keeps the depth
 * fixed. */
static void apply_adhesion(const wt_indent_fit *fit, double reduced,
                           const wt_contact_table *contact, const double *delta, size_t n,
                           double *force)
{
    const double at_fixed_depth = (double)INFINITY;
    const adhesion law = {contact, reduced, fit->work_of_adhesion.value};
    double *bare = wt_alloc(n, sizeof *bare);
    adhesion_balance(&law, at_fixed_depth, adhesion_release(&law, at_fixed_depth), delta, n, bare);
    for (size_t i = 0; i < n; i += ADHESION_BLOCK) {
        const size_t m = n - i < ADHESION_BLOCK ? n - i : ADHESION_BLOCK;
        adhesive_contacts at;
        adhesion_contacts(&law, bare + i, m, &at);
        for (size_t j = 0; j < m; j++)
            force[i + j] = at.force[j];
    }
    free(bare);
}

void fitted_forces(const wt_indent_fit *fit, const wt_indent_options *options,
                   const wt_contact_table *contact, const wt_segment *approach, const double *delta,
                   size_t n, double *time, double *model)
{
    const double *height = segment_height(approach), *all = segment_time(approach, time);
    const double reduced = 1 - options->poisson_ratio * options->poisson_ratio;
    const bool has_spectrum = options->spectrum != NULL && isnan(fit->work_of_adhesion.value) &&
                              !isnan(fit->spectrum_factor.value);
    curve_power power;
    double modulus = fit->modulus.value;
    if (fit->work_of_adhesion.value > 0 && modulus > 0) {
        apply_adhesion(fit, modulus / reduced, contact, delta, n, model);
        return;
    }
    wt_contact_table_eval(contact, delta, n, model, NULL);
    if (all != NULL && (has_spectrum || fit->loss_power > 0)) {
        size_t m = 0; /* the samples that wt_indent_plot_points returns */
        for (size_t i = 0; i < approach->n_points && m < n; i++)
            if (fit->direction * height[i] >= fit->contact_point.value)
                time[m++] = all[i];
        if (has_spectrum) {
            modulus = fit->spectrum_factor.value;
        } else {
            curve_power_create(&power, fit->loss_power, fit->load_time);
            modulus /=
                (1 + fit->loss_shift) * hereditary_modulus(&power.series, 1 / fit->load_time);
        }
        apply_relaxation(has_spectrum ? options->spectrum : &power.series, time, m, model);
    }
    for (size_t i = 0; i < n; i++)
        model[i] = model[i] * (modulus / reduced) -
                   (fit->contact_pull.value > 0 ? fit->contact_pull.value : 0);
}
