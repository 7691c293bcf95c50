/* Combined results of the curves of a group: modulus against depth, shared shifts and mean
 * residual.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "indentation/curve_tables.h"
#include "indentation/indent.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* True if the curve loses work and the effect on its modulus is not known. */
static bool indent_has_unknown_loss(const wt_indent_fit *fit)
{
    const bool has_pull =
        fit->adhesion_force > 0 || fit->pull_off_force > 0; /* a pull loses work too */
    return fit->loss > CURVE_MIN_LOSS && isnan(fit->loss_bias) &&
           isnan(fit->spectrum_factor.value) && !has_pull;
}

/* ---- curves for the modulus against depth ---------------------------------------------------- */

/* True if the curve has data on the modulus against depth. A fit that begins at a depth lacks the
 * misfit at small depths. */
static bool has_depth_information(const wt_indent_fit *fit)
{
    const bool has_pull = fit->adhesion_force > 0 || fit->pull_off_force > 0;
    return !(fit->fitted_from > 0) &&
           (wt_curve_verdict_is_usable(fit->verdict) || fit->verdict == WT_CURVE_POOR_FIT) &&
           !((fit->verdict == WT_CURVE_WIDE || fit->verdict == WT_CURVE_DOUBTFUL) && has_pull) &&
           isnan(fit->work_of_adhesion.value) && isnan(fit->contact_pull.value) &&
           fit->modulus.value > 0 && !isnan(fit->misfit[0]);
}

bool indent_depth_curve(const wt_indent_fit *fit, const wt_force_curve *curve, bool is_requested,
                        wt_curve_residuals *to)
{
    const double none = (double)NAN;
    *to = (wt_curve_residuals){
        .baseline = none, .window = none, .curvature = none, .loss_error = none};
    for (size_t i = 0; i < WT_MISFIT_TERMS; i++)
        to->misfit[i] = none;
    if (!is_requested || !has_depth_information(fit))
        return false;
    *to = (wt_curve_residuals){.modulus = fit->modulus.value,
                               .depth = fit->max_indentation,
                               .spring_constant = curve->cantilever.spring_constant,
                               .baseline = fit->baseline_length,
                               .window = fit->misfit_length,
                               .curvature = fit->baseline_curvature,
                               .loss_error = indent_has_unknown_loss(fit) ? none : fit->loss_error};
    memcpy(to->misfit, fit->misfit, sizeof to->misfit);
    return true;
}

void indent_depths_add(indent_depths *to, const wt_curve_residuals *curve, const char *spot)
{
    to->curve = array_grow(to->curve, to->n, sizeof *to->curve);
    wt_curve_residuals *added = &to->curve[to->n++];
    if (to->last_spot == NULL || strcmp(spot, to->last_spot) != 0)
        to->n_spots++;
    to->last_spot = spot;
    *added = *curve;
    added->spot = to->n_spots;
}

wt_status indent_depths_table(const indent_depths *depths, const wt_indent_job *job,
                              const wt_contact_table *contact, wt_indent_tables *tables,
                              wt_error *err)
{
    wt_modulus_profile depth;
    if (job->options.plain_least_squares || depths->n == 0)
        return WT_OK;
    const wt_status status = wt_modulus_profile_fit(contact, job->options.poisson_ratio,
                                                    depths->curve, depths->n, &depth, err);
    return status == WT_OK ? flow_depth_table_add(tables, job->group, &depth, err) : status;
}

void indent_depths_clear(indent_depths *depths)
{
    free(depths->curve);
}

/* ---- table of the modulus against depth ------------------------------------------------------ */

TABLE_ROW(modulus_depth, MODULUS_DEPTH, const char *group; double depth; wt_interval modulus;
          size_t n, n_units;)

TABLE_KEYS(modulus_depth, MODULUS_DEPTH, const char *changes, *reading; wt_interval ratio;
           double chance, misfit_p;)

/* Returns advice on how to decide. The flag states that the residual is not a change with depth. */
static const char *depth_advice(const wt_modulus_profile *d, bool other_misfit)
{
    if (d->loss_share > 0.5 || (other_misfit && d->loss_share > 0))
        return "the DMA of the rubber would decide";
    if (d->curvature_share > 0.5 || (other_misfit && d->curvature_share > 0))
        return "the baselines are bent: curves of a straight piezo, or one that has settled, "
               "would decide";
    return other_misfit ? "another tip or rate would decide" : "more curves would decide";
}

static void describe_depth_change(const wt_modulus_profile *d, char text[320])
{
    const si_text shallow = curve_format_si(d->depth[0], "m"),
                  deep = curve_format_si(d->depth[WT_DEPTHS - 1], "m");
    const double margin = 100 * WT_DEPTH_MARGIN;
    const bool is_small = fabs(log(d->change.low)) < log1p(WT_DEPTH_MARGIN) &&
                          fabs(log(d->change.high)) < log1p(WT_DEPTH_MARGIN);
    char range[96];
    clocale_print(range, sizeof range, "%.3f, 95 %% interval %.3f to %.3f", d->change.value,
                  d->change.low, d->change.high);
    if (d->n_excluded_by_loss > 0 && d->n_excluded_by_loss >= d->n)
        clocale_print(
            text, 320,
            "inconclusive: %zu of %zu curves lose work between approach and retract, and the "
            "effect on their moduli is not known; the DMA of the rubber would determine it",
            d->n_excluded_by_loss, d->n + d->n_excluded_by_loss);
    else if (isnan(d->change.value))
        clocale_print(text, 320,
                      "inconclusive: %zu curves without adhesion are too few; 12 are needed "
                      "that differ by noise alone",
                      d->n);
    else if (d->two_spots)
        clocale_print(text, 320,
                      "inconclusive: two spots do not allow an interval of the change of the "
                      "modulus between %s and %s (factor %.3f); a third spot would",
                      shallow.buffer, deep.buffer, d->change.value);
    else if (d->verdict == WT_DEPTH_OTHER_RESIDUAL)
        clocale_print(
            text, 320,
            "inconclusive: the curves have a residual in common that a change of the modulus "
            "with depth does not explain (chance %s); %s",
            format_probability(d->misfit_p).text, depth_advice(d, true));
    else if (d->verdict == WT_DEPTH_CHANGES && d->change.low < 1 && d->change.high > 1)
        clocale_print(text, 320,
                      "yes: between %s and %s the modulus changes; the curves do not determine "
                      "the size and sign of the change (factor %s)",
                      shallow.buffer, deep.buffer, range);
    else if (d->verdict == WT_DEPTH_CHANGES)
        clocale_print(text, 320,
                      "yes%s: the modulus at %s differs from that at %s by a factor of %s",
                      is_small ? ", but hardly" : "", deep.buffer, shallow.buffer, range);
    else if (d->verdict == WT_DEPTH_SAME)
        clocale_print(text, 320,
                      "no: between %s and %s the modulus changes by less than %g %% (factor %s)",
                      shallow.buffer, deep.buffer, margin, range);
    else
        clocale_print(
            text, 320,
            "inconclusive: between %s and %s the modulus may be the same or change by more "
            "than %g %% (factor %s); %s",
            shallow.buffer, deep.buffer, margin, range, depth_advice(d, false));
}

/* Describes the layer that would cause such a change, and other possible causes. */
static void describe_layer_reading(const wt_modulus_profile *d, char text[640])
{
    char numbers[256] = "";
    if (!isnan(d->thickness.value))
        clocale_print(numbers, sizeof numbers,
                      "; a layer of %s (%s to %s) with %s on %s would have this effect",
                      curve_format_si(d->thickness.value, "m").buffer,
                      curve_format_si(d->thickness.low, "m").buffer,
                      curve_format_si(d->thickness.high, "m").buffer,
                      curve_format_si(d->layer_modulus.value, "Pa").buffer,
                      curve_format_si(d->substrate_modulus.value, "Pa").buffer);
    clocale_print(text, 640,
                  "if a layer thinner than the indentation causes it, the layer is %s than the "
                  "material below; then shallow indentations measure the layer, deep ones the "
                  "material below, and the modulus of a whole curve is that of neither%s; "
                  "another tip radius, loss, adhesion and an uneven piezo have the same "
                  "effect; a second rate, a second tip or the untouched bulk separates them",
                  d->change.low > 1    ? "softer"
                  : d->change.high < 1 ? "stiffer"
                                       : "softer or stiffer",
                  numbers);
}

wt_status flow_depth_table_add(wt_indent_tables *tables, const char *group,
                               const wt_modulus_profile *d, wt_error *err)
{
    table_writer t = {0};
    char text[320], reading[640];
    if (tables->modulus_depth == NULL) {
        t = table_begin(&modulus_depth_schema, err);
        if (table_end(&t, &tables->modulus_depth) != WT_OK)
            return t.status;
    }
    t = table_continue(tables->modulus_depth, &modulus_depth_schema, group, err);
    table_block(&t);
    describe_depth_change(d, text);
    modulus_depth_keys keys = {text, NULL, d->change, (double)NAN, (double)NAN};
    if (d->verdict == WT_DEPTH_CHANGES) {
        describe_layer_reading(d, reading);
        keys.reading = reading;
    }
    if (!isnan(d->change.value)) {
        keys.chance = d->change_p;
        keys.misfit_p = d->misfit_p;
    }
    modulus_depth_set_keys(&t, &keys);
    for (size_t i = 0; i < WT_DEPTHS && !isnan(d->change.value); i++)
        TABLE_ADD(modulus_depth, &t, group, d->depth[i], d->modulus[i], d->n, d->n_units);
    return table_end(&t, NULL);
}

/* ---- the group ------------------------------------------------------------------------------- */

static void add_shift(indent_shift_sum *all, double shift)
{
    if (!(fabs(shift) > 0))
        return;
    all->sum += shift;
    all->n++;
}

void indent_summary_add(indent_summary *to, const wt_indent_fit *fit,
                        const wt_indent_options *options)
{
    to->max_depth = fmax(to->max_depth, fit->max_indentation);
    add_shift(&to->bend, fit->curvature_shift / fit->modulus.value);
    to->variance += pow(fit->modulus.standard_error / fit->modulus.value, 2);
    add_shift(&to->loss, fit->loss_bias);
    add_shift(&to->loss_error, fit->loss_error);
    const bool has_ranges = !options->plain_least_squares && options->misfit_p_threshold > 0;
    add_shift(&to->left_out, has_ranges ? curve_left_out_error(fit) : 0);
    for (int i = 0; i < WT_FIT_RANGES && has_ranges; i++) {
        const double weight = pow(fit->range_error[i], -2);
        if (!isfinite(weight * fit->range_shift[i]))
            continue;
        to->range_sum[i] += weight * fit->range_shift[i];
        to->range_weight[i] += weight;
    }
    to->n_unknown_loss += indent_has_unknown_loss(fit);
    to->n++;
    if (isnan(fit->misfit[0]))
        return;
    to->misfits = array_grow(to->misfits, to->n_misfits, sizeof *to->misfits);
    memcpy(to->misfits[to->n_misfits++], fit->misfit, sizeof *to->misfits);
}

void indent_summary_clear(indent_summary *summary)
{
    free(summary->misfits);
}

/* Mean of the shifts if most moduli of the group have one; else 0. */
static double mean_shift(const indent_summary *summary, const indent_shift_sum *all)
{
    return 2 * all->n > summary->n ? all->sum / (double)all->n : 0;
}

/* Mean error due to loss. It is NaN if most curves lose work and the effect is known for too few of
 * them. */
static double loss_error(const indent_summary *summary)
{
    const size_t n_known = summary->loss_error.n, unknown = summary->n_unknown_loss;
    const bool is_missing = unknown > 0 && 2 * (n_known + unknown) >= summary->n;
    return is_missing && 2 * n_known <= summary->n ? (double)NAN
                                                   : mean_shift(summary, &summary->loss_error);
}

/* Share of the mean variance of a modulus from which a bend is a warning. A smaller one widens the
 * interval of a curve by less than 5 %. */
static const double min_bend_share = 0.1;

/* Reports the shifts that all moduli share and that their scatter does not show: slope changes of
 * most baselines due to the piezo, and loss of unknown spectrum. */
static void report_common_shifts(const indent_summary *summary, const wt_indent_job *job,
                                 const wt_job *work, table_writer *rows)
{
    const double bend = mean_shift(summary, &summary->bend);
    indentation_set_value(rows, INDENTATION_KEY_BEND_ERROR, bend, 0, 0);
    /* also if a variance is unknown */
    if (fabs(bend) > 0 && !(bend * bend * (double)summary->n <= min_bend_share * summary->variance))
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "%s: the baseline of %zu of %zu accepted curves is bent; if the piezo "
                   "continues so in contact, these moduli change by %+.2g %% on average, which "
                   "their scatter does not show",
                   job->group, summary->bend.n, summary->n, 100 * bend);
    const double error = loss_error(summary);
    const double loss = mean_shift(summary, &summary->loss);
    indentation_set_value(rows, INDENTATION_KEY_LOSS_ERROR, error, 0, 0);
    if (error > 0)
        wt_log_add(
            work->log, WT_NOTE, NULL, NULL,
            "%s: %zu of %zu accepted curves lose work between approach and retract; their "
            "moduli are |E*| at 1/(loading time) of a rubber that loses as much, %.1g %% %s "
            "than those of a fit without loss; its unknown spectrum causes a standard error of "
            "%.1g %%, which all curves share and which the DMA of the rubber removes",
            job->group, summary->loss.n, summary->n, 100 * fabs(loss), loss > 0 ? "less" : "more",
            100 * error);
    if (isnan(error))
        wt_log_add(work->log, WT_NOTE, NULL, NULL,
                   "%s: %zu of %zu accepted curves lose work between approach and retract, and the "
                   "effect on their moduli is not known; times of the samples or the DMA of the "
                   "rubber would determine it",
                   job->group, summary->n_unknown_loss, summary->n);
}

double indent_summary_range_error(const indent_summary *summary)
{
    double largest = (double)NAN, least = largest; /* squares; fmax and fmin ignore NaN */
    for (int i = 0; i < WT_FIT_RANGES; i++) {
        const wt_estimate shift = indent_summary_range_shift(summary, i);
        const double noise = shift.standard_error * shift.standard_error;
        if (isnan(shift.value))
            continue;
        largest = fmax(largest, shift.value * shift.value - noise);
        least = fmin(least, noise);
    }
    return hypot(sqrt(fmax(largest, least)), mean_shift(summary, &summary->left_out));
}

wt_estimate indent_summary_range_shift(const indent_summary *summary, int range)
{
    const double weight = summary->range_weight[range];
    return (wt_estimate){summary->range_sum[range] / weight, 1 / sqrt(weight), 0, "1"};
}

/* Writes the changes of the moduli with other choices of the fit, as far as they are known. A pull
 * that the fit left out adds to the force, so that the modulus rises by its share; the summary has
 * that share as the 95 % limit of an error. */
static void report_choices(const indent_summary *summary, table_writer *rows)
{
    const double loss =
        isnan(loss_error(summary)) ? (double)NAN : mean_shift(summary, &summary->loss);
    for (int i = 0; i < WT_FIT_RANGES; i++) {
        const wt_estimate shift = indent_summary_range_shift(summary, i);
        if (summary->range_weight[i] > 0)
            indentation_set_value(rows, (indentation_key)(INDENTATION_KEY_RANGE_SHIFT + i),
                                  shift.value, shift.standard_error, 0);
    }
    indentation_set_value(rows, INDENTATION_KEY_LOSS_SHIFT, loss, 0, 0);
    indentation_set_value(rows, INDENTATION_KEY_PULL_SHIFT,
                          NORMAL_95 * mean_shift(summary, &summary->left_out), 0, 0);
}

/* Tests the mean residual of the accepted curves. */
static void test_mean_residual(const indent_summary *summary, table_writer *rows)
{
    const wt_pooled_misfit pooled = wt_pooled_misfit_compute(
        (const double(*)[WT_MISFIT_TERMS])summary->misfits, summary->n_misfits);
    if (isnan(pooled.p_value))
        return;
    indentation_set_print(rows, INDENTATION_KEY_POOLED_MISFIT, "%.3g", pooled.misfit);
    indentation_set_print(rows, INDENTATION_KEY_POOLED_MISFIT_CHANCE, "%.3g", pooled.p_value);
}

/* Smallest plausible indentation over the radius of a sphere. Below it only asperities touch and an
 * AFM cannot apply the force, so the unit of the radius is probably wrong. */
static const double least_depth_of_radius = 1.0 / 5000;

static void warn_implausible_radius(const indent_summary *summary, const wt_indent_job *job,
                                    const wt_job *work)
{
    char radius[32];
    const bool is_round = job->tip.shape == WT_TIP_SPHERE || job->tip.shape == WT_TIP_PARABOLOID;
    if (!is_round || summary->n == 0 ||
        summary->max_depth >= least_depth_of_radius * job->tip.radius)
        return;
    wt_format_si(job->tip.radius, "m", 3, radius, sizeof radius);
    wt_log_add(work->log, WT_WARNING, NULL, NULL,
               "%s: the radius of the tip, %s, is %.0f times the deepest indentation: check "
               "its unit",
               job->group, radius, job->tip.radius / summary->max_depth);
}

void indent_summary_report(const indent_summary *summary, const wt_indent_job *job,
                           const wt_job *work, table_writer *rows)
{
    warn_implausible_radius(summary, job, work);
    const double range_error = indent_summary_range_error(summary);
    if (isnan(range_error) && summary->n > 0)
        indentation_set_text(rows, INDENTATION_KEY_NOT_SHOWN,
                             "a wrong contact law (no curve was fitted in a second range)");
    report_common_shifts(summary, job, work, rows);
    indentation_set_value(rows, INDENTATION_KEY_RANGE_ERROR, range_error, 0, 0);
    report_choices(summary, rows);
    test_mean_residual(summary, rows);
}
