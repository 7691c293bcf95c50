/* Rows and tables of force curves: results of each curve, the whole representative curve, and its
 * contact part with the force of the fit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/curve_tables.h"
#include "core/data/force_curve.h"
#include "core/table/table_rows.h"
#include "indentation/law/adhesion.h"
#include "indentation/law/hereditary.h"
#include "indentation/numerics/curve.h"
#include "weartrack/indentation.h"

#include <math.h>
#include <stdlib.h>

/* ---- force of a fit along a curve ------------------------------------------------------------ */

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

/* ---- rows and tables ------------------------------------------------------------------------- */

TABLE_ROW(force_displacement, FORCE_DISPLACEMENT, const char *group, *segment;
          double displacement, force;)

TABLE_ROW(force_indentation, FORCE_INDENTATION, const char *group;
          double indentation, force, fitted_force;)

/* Starts a new block and creates the table with its first block. A failure stays in the writer. */
static table_writer next_block(wt_table **table, const table_schema *schema, const char *group,
                               wt_error *err)
{
    table_writer t = {0};
    if (*table == NULL) {
        t = table_begin(schema, err);
        if (table_end(&t, table) != WT_OK)
            return t;
    }
    t = table_continue(*table, schema, group, err);
    table_block(&t);
    return t;
}

static void set_force_displacement_keys(table_writer *t, const char *file,
                                        const wt_force_curve *curve, const wt_indent_fit *fit)
{
    force_displacement_set_print(t, FORCE_DISPLACEMENT_KEY_CURVE, "%s curve %zu", file,
                                 curve->index);
    force_displacement_set_value(t, FORCE_DISPLACEMENT_KEY_CONTACT_POINT, 0,
                                 fit->contact_point.standard_error, 0);
    force_displacement_set_value(t, FORCE_DISPLACEMENT_KEY_CONTACT_FORCE, 0,
                                 fit->baseline_offset.standard_error, 0);
}

static void add_displacement_segment(table_writer *t, const wt_segment *segment,
                                     const wt_indent_fit *fit, const double *force)
{
    const double *height = segment_height(segment);
    for (size_t i = 0; height != NULL && i < segment->n_points; i++) {
        if (!isfinite(height[i]) || !isfinite(force[i]))
            continue;
        TABLE_ADD(force_displacement, t, t->suffix, wt_segment_kind_name(segment->kind),
                  fit->direction * height[i] - fit->contact_point.value,
                  force[i] - fit->baseline_offset.value);
    }
}

wt_status flow_curve_tables_add(wt_indent_tables *tables, const char *group, const char *file,
                                const wt_force_curve *curve, const wt_indent_fit *fit,
                                const wt_contact_table *contact, const wt_indent_options *options,
                                wt_error *err)
{
    const wt_segment *approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    const wt_segment *retract = wt_force_curve_segment(curve, WT_SEGMENT_RETRACT);
    const double *height = approach == NULL ? NULL : segment_height(approach);
    if (height == NULL || approach->n_points < 2)
        return WT_OK;
    double k = curve->cantilever.spring_constant;
    size_t longest = approach->n_points;
    if (retract != NULL && retract->n_points > longest)
        longest = retract->n_points;
    double *scratch = wt_alloc(5 * longest, sizeof *scratch);
    double *delta = scratch + longest, *shown = scratch + 2 * longest,
           *model = scratch + 3 * longest, *time = scratch + 4 * longest;
    const double *force = segment_force(approach, &curve->cantilever, scratch);
    if (force == NULL) {
        free(scratch);
        return WT_OK;
    }
    table_writer whole =
        next_block(&tables->force_displacement, &force_displacement_schema, group, err);
    set_force_displacement_keys(&whole, file, curve, fit);
    add_displacement_segment(&whole, approach, fit, force);

    size_t n = wt_indent_plot_points(fit, height, force, approach->n_points, k, delta, shown);
    fitted_forces(fit, options, contact, approach, delta, n, time, model);
    table_writer branch =
        next_block(&tables->force_indentation, &force_indentation_schema, group, err);
    for (size_t i = 0; i < n; i++)
        TABLE_ADD(force_indentation, &branch, group, delta[i], shown[i], model[i]);
    force = retract == NULL ? NULL : segment_force(retract, &curve->cantilever, scratch);
    if (force != NULL)
        add_displacement_segment(&whole, retract, fit, force);
    wt_status status = table_end(&whole, NULL);
    if (status == WT_OK)
        status = table_end(&branch, NULL);
    free(scratch);
    return status;
}

/* ---- rows of indentation -------------------------------------------------------------------- */

/* Angular frequency of the modulus. An elastic fit of rubber with loss returns |E*| at 1/(loading
 * time) if the contact point is fitted too. If the contact point is fixed, the local exponent p of
 * F ~ delta^p at the deepest point determines the frequency. */
static double equivalent_frequency(const wt_indent_job *job, const wt_indent_fit *fit)
{
    const wt_tip *tip = &job->tip;
    double g = (double)NAN, slope = (double)NAN;
    if (!(fit->load_time > 0) || !(fit->max_indentation > 0))
        return (double)NAN;
    if (isnan(job->options.fixed_contact_point) || !isnan(fit->spectrum_factor.value) ||
        fit->loss_power > 0)
        return 1.0 / fit->load_time;
    wt_contact_function(tip, fit->max_indentation, &g, &slope);
    return wt_equivalent_frequency(fit->load_time, fit->max_indentation * slope / g);
}

TABLE_ROW(indentation, INDENTATION, const char *file, *spot; wt_curve_verdict verdict; size_t curve;
          double x, y, equivalent_frequency; wt_indent_fit fit; wt_curve_residuals deep;)

void flow_indentation_row_add(table_writer *t, const wt_indent_job *job, const char *file,
                              const char *spot, const wt_force_curve *curve,
                              const wt_indent_fit *fit, const wt_curve_residuals *deep)
{
    indentation_row row = {.file = file,
                           .spot = spot,
                           .verdict = fit->verdict,
                           .curve = curve->index,
                           .x = curve->x,
                           .y = curve->y,
                           .equivalent_frequency = equivalent_frequency(job, fit),
                           .fit = *fit,
                           .deep = *deep};
    if (!job->rates)
        row.equivalent_frequency = row.fit.piezo_rate = row.fit.indentation_rate =
            row.fit.load_time = (double)NAN;
    indentation_add_row(t, &row);
}
