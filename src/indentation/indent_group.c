/* Combined results of the curves of a group: shared shifts, mean residual and contact points of
 * other estimators.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "indentation/indent.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add_shift(indent_shift_sum *all, double shift)
{
    if (!(fabs(shift) > 0))
        return;
    all->sum += shift;
    all->n++;
}

static void add_range_shifts(indent_summary *to, const wt_indent_fit *fit)
{
    add_shift(&to->left_out, curve_left_out_error(fit));
    for (int i = 0; i < WT_FIT_RANGES; i++)
        if (isfinite(fit->range_shift[i]) && isfinite(fit->range_error[i])) {
            to->range[i].sum += fit->range_shift[i];
            to->range[i].n++;
            to->range_variance[i] += fit->range_error[i] * fit->range_error[i];
        }
}

void indent_summary_add(indent_summary *to, const wt_indent_fit *fit,
                        const wt_indent_options *options)
{
    to->max_depth = fmax(to->max_depth, fit->max_indentation);
    add_shift(&to->bend, fit->curvature_shift / fit->modulus.value);
    add_shift(&to->loss, fit->loss_bias);
    add_shift(&to->loss_error, fit->loss_error);
    if (!options->plain_least_squares && options->misfit_p_threshold > 0)
        add_range_shifts(to, fit);
    to->n_unknown_loss += indent_has_unknown_loss(fit);
    if (options->contact_estimators) {
        to->contacts = array_grow(to->contacts, to->n, sizeof *to->contacts);
        memcpy(to->contacts[to->n], fit->contact_by, sizeof *to->contacts);
    }
    to->n++;
    if (isnan(fit->misfit[0]))
        return;
    to->misfits = array_grow(to->misfits, to->n_misfits, sizeof *to->misfits);
    memcpy(to->misfits[to->n_misfits++], fit->misfit, sizeof *to->misfits);
}

void indent_summary_clear(indent_summary *summary)
{
    free(summary->misfits);
    free(summary->contacts);
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

/* Reports the shifts that all moduli share and that their scatter does not show: slope changes of
 * most baselines due to the piezo, and loss of unknown spectrum. */
static void report_common_shifts(const indent_summary *summary, const wt_indent_job *job,
                                 const wt_job *work, table_writer *rows)
{
    const double bend = mean_shift(summary, &summary->bend);
    indentation_set_value(rows, INDENTATION_KEY_BEND_ERROR, bend, 0, 0);
    if (fabs(bend) > 0)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "%s: the baseline of %zu of %zu accepted curves is bent; a piezo that goes on "
                   "so in contact changes these moduli by %+.2g %% in the mean, which their "
                   "scatter does not show",
                   job->group, summary->bend.n, summary->n, 100 * bend);
    const double error = loss_error(summary);
    const double loss = mean_shift(summary, &summary->loss);
    indentation_set_value(rows, INDENTATION_KEY_LOSS_ERROR, error, 0, 0);
    if (error > 0)
        wt_log_add(
            work->log, WT_NOTE, NULL, NULL,
            "%s: %zu of %zu accepted curves lose work on the way out; their moduli are |E*| at "
            "1/(loading time) of a rubber that loses as much, %.1g %% %s than those of a fit "
            "without loss; that its spectrum is not known leaves a standard error of %.1g %%, "
            "which all of them share and the DMA of the rubber takes away",
            job->group, summary->loss.n, summary->n, 100 * fabs(loss), loss > 0 ? "less" : "more",
            100 * error);
    if (isnan(error))
        wt_log_add(
            work->log, WT_NOTE, NULL, NULL,
            "%s: %zu of %zu accepted curves lose work on the way out, and nothing says what that "
            "does to their moduli; times of the samples or the DMA of the rubber would tell",
            job->group, summary->n_unknown_loss, summary->n);
}

double indent_summary_range_spread(const indent_summary *summary)
{
    double low = 0, high = 0, noise = 0;
    for (int i = 0; i < WT_FIT_RANGES; i++) {
        const double n = (double)summary->range[i].n;
        if (!(n > 0))
            continue;
        low = fmin(low, summary->range[i].sum / n);
        high = fmax(high, summary->range[i].sum / n);
        noise = fmax(noise, summary->range_variance[i] / (n * n));
    }
    return hypot(sqrt(fmax(pow((high - low) / 2, 2) - noise, 0)),
                 mean_shift(summary, &summary->left_out));
}

/* Tests the mean residual of the accepted curves. */
static void test_mean_residual(const indent_summary *summary, const wt_indent_job *job,
                               const wt_job *work, table_writer *rows)
{
    const size_t n = summary->n_misfits;
    const wt_pooled_misfit pool =
        wt_pooled_misfit_compute((const double(*)[WT_MISFIT_TERMS])summary->misfits, n);
    const bool is_significant = pool.p_value < job->options.misfit_p_threshold;
    if (isnan(pool.p_value))
        return;
    indentation_set_print(rows, INDENTATION_KEY_POOLED_MISFIT, "%.3g", pool.misfit);
    indentation_set_print(rows, INDENTATION_KEY_POOLED_MISFIT_CHANCE, "%.3g", pool.p_value);
    if (is_significant)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "%s: the mean residual of %zu accepted curves is %.2g %% of the largest "
                   "force, which scatter does not explain (chance %s): another tip, a "
                   "layer, loss, adhesion or an uneven piezo; the moduli may be further off",
                   job->group, n, 100 * pool.misfit, format_probability(pool.p_value).text);
}

/* Median of the contact points of one estimator where it found one; NaN if nowhere. scratch: [n].
 */
static double median_contact_distance(const indent_summary *summary, int estimator, double *scratch)
{
    size_t found = 0;
    for (size_t i = 0; i < summary->n; i++)
        if (!isnan(summary->contacts[i][estimator]))
            scratch[found++] = summary->contacts[i][estimator];
    if (found == 0)
        return (double)NAN;
    return numbers_median(scratch, found);
}

static void report_contact_estimates(const indent_summary *summary, const wt_indent_job *job,
                                     const wt_job *work)
{
    char text[512] = "";
    size_t length = 0;
    if (summary->contacts == NULL)
        return;
    double *scratch = wt_alloc(summary->n, sizeof *scratch);
    for (int i = 0; i < WT_CONTACT_ESTIMATORS; i++) {
        const double distance_median = median_contact_distance(summary, i, scratch);
        char distance[32] = "not found";
        if (!isnan(distance_median))
            wt_format_si(distance_median, "m", 3, distance, sizeof distance);
        length +=
            (size_t)snprintf(text + length, sizeof text - length, "%s%s (%s)", i > 0 ? ", " : "",
                             distance, wt_contact_estimator_text((wt_contact_estimator)i));
    }
    free(scratch);
    wt_log_add(work->log, WT_NOTE, NULL, NULL,
               "%s: contact by other estimators less that of the fit, medians of %zu "
               "accepted curves: %s",
               job->group, summary->n, text);
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
               "%s: the radius of the tip, %s, is %.0f times the deepest indentation: is its "
               "unit right?",
               job->group, radius, job->tip.radius / summary->max_depth);
}

void indent_summary_report(const indent_summary *summary, const wt_indent_job *job,
                           const wt_job *work, table_writer *rows)
{
    char hidden_errors[512];
    warn_implausible_radius(summary, job, work);
    indent_systematic_errors(job, summary->max_depth, hidden_errors, sizeof hidden_errors);
    if (*hidden_errors != '\0')
        indentation_set_text(rows, INDENTATION_KEY_NOT_SHOWN, hidden_errors);
    report_common_shifts(summary, job, work, rows);
    indentation_set_value(rows, INDENTATION_KEY_RANGE_ERROR, indent_summary_range_spread(summary),
                          0, 0);
    test_mean_residual(summary, job, work, rows);
    report_contact_estimates(summary, job, work);
}
