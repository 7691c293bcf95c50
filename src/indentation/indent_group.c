/* Combined results of the curves of a group: shared shifts, mean residual and contact points of
 * other estimators.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/number.h"
#include "indentation/indent.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add_shift(indent_shifts *all, double shift)
{
    if (!(fabs(shift) > 0))
        return;
    all->sum += shift;
    all->n++;
}

wt_status indent_summary_add(indent_summary *to, const wt_indent_fit *fit,
                             const wt_indent_options *options, wt_error *err)
{
    to->deepest = fmax(to->deepest, fit->max_indentation);
    add_shift(&to->bend, fit->bend_shift / fit->modulus.value);
    add_shift(&to->loss, fit->loss_bias);
    add_shift(&to->loss_error, fit->loss_error);
    add_shift(&to->misfit, fit->misfit_error / fit->modulus.value);
    to->n_misfit += fit->lack_of_fit_p < options->least_chance;
    to->n_unknown += indent_loss_is_unknown(fit);
    if (options->contact_estimators) {
        double(*more)[WT_CONTACT_ESTIMATORS] = array_grow(to->contacts, to->n, sizeof *more);
        if (more == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        to->contacts = more;
        memcpy(more[to->n], fit->contact_by, sizeof *more);
    }
    to->n++;
    if (isnan(fit->misfit[0]))
        return WT_OK;
    double(*misfits)[WT_CURVE_WAVES] = array_grow(to->misfits, to->n_misfits, sizeof *misfits);
    if (misfits == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    to->misfits = misfits;
    memcpy(misfits[to->n_misfits++], fit->misfit, sizeof *misfits);
    return WT_OK;
}

void indent_summary_clear(indent_summary *together)
{
    free(together->misfits);
    free(together->contacts);
}

/* Mean of the shifts if most moduli of the group have one; else 0. */
static double mean_shift(const indent_summary *together, const indent_shifts *all)
{
    return 2 * all->n > together->n ? all->sum / (double)all->n : 0;
}

/* Mean error due to loss. It is NaN if most curves lose work and the effect is known for too few of
 * them. */
static double loss_error(const indent_summary *together)
{
    const size_t known = together->loss_error.n, unknown = together->n_unknown;
    const bool lacks = unknown > 0 && 2 * (known + unknown) >= together->n;
    return lacks && 2 * known <= together->n ? (double)NAN
                                             : mean_shift(together, &together->loss_error);
}

/* Reports the shifts that all moduli share and that their scatter does not show: slope changes of
 * most baselines due to the piezo, and loss of unknown spectrum. */
static void say_shifts(const indent_summary *together, const wt_indent_job *job, const wt_job *work,
                       table_writer *rows)
{
    const double bend = mean_shift(together, &together->bend);
    indentation_set_value(rows, INDENTATION_KEY_BEND_ERROR, bend, 0, 0);
    if (fabs(bend) > 0)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "%s: the baseline of %zu of %zu accepted curves is bent; a piezo that goes on "
                   "so in contact changes these moduli by %+.2g %% in the mean, which their "
                   "scatter does not show",
                   job->group, together->bend.n, together->n, 100 * bend);
    const double error = loss_error(together);
    const double loss = mean_shift(together, &together->loss);
    indentation_set_value(rows, INDENTATION_KEY_LOSS_ERROR, error, 0, 0);
    if (error > 0)
        wt_log_add(
            work->log, WT_NOTE, NULL, NULL,
            "%s: %zu of %zu accepted curves lose work on the way out; their moduli are |E*| at "
            "1/(loading time) of a rubber that loses as much, %.1g %% %s than those of a fit "
            "without loss; that its spectrum is not known leaves a standard error of %.1g %%, "
            "which all of them share and the DMA of the rubber takes away",
            job->group, together->loss.n, together->n, 100 * fabs(loss), loss > 0 ? "less" : "more",
            100 * error);
    if (isnan(error))
        wt_log_add(
            work->log, WT_NOTE, NULL, NULL,
            "%s: %zu of %zu accepted curves lose work on the way out, and nothing says what that "
            "does to their moduli; times of the samples or the DMA of the rubber would tell",
            job->group, together->n_unknown, together->n);
}

/* Tests the mean residual of the accepted curves. */
static void pool_curves(const indent_summary *together, const wt_indent_job *job,
                        const wt_job *work, table_writer *rows)
{
    const size_t n = together->n_misfits;
    const wt_curve_pool pool =
        wt_curve_pool_make((const double(*)[WT_CURVE_WAVES])together->misfits, n);
    const bool seen = pool.chance < job->options.least_chance;
    /* A misfit that all curves share does not average out. The misfit of each curve may be shared.
     * It is unknown if no curve determines it. */
    const bool untold = job->options.least_chance > 0 && together->misfit.n == 0 &&
                        together->n > 0 && !job->options.plain_least_squares;
    const bool alike = seen || untold || 2 * together->n_misfit > together->n;
    indentation_set_value(rows, INDENTATION_KEY_MISFIT_ERROR,
                          alike ? together->misfit.sum / (double)together->misfit.n : 0, 0, 0);
    if (isnan(pool.chance))
        return;
    indentation_set_print(rows, INDENTATION_KEY_POOLED_MISFIT, "%.3g", pool.misfit);
    indentation_set_print(rows, INDENTATION_KEY_POOLED_MISFIT_CHANCE, "%.3g", pool.chance);
    if (seen)
        wt_log_add(work->log, WT_WARNING, NULL, NULL,
                   "%s: the mean residual of %zu accepted curves is %.2g %% of the largest "
                   "force, which scatter does not explain (chance %s): another tip, a "
                   "layer, loss, adhesion or an uneven piezo; the moduli may be further off",
                   job->group, n, 100 * pool.misfit, number_chance(pool.chance).text);
}

/* Median of the contact points of one estimator where it found one; NaN if nowhere. scratch: [n].
 */
static double median_of(const indent_summary *together, int estimator, double *scratch)
{
    size_t found = 0;
    for (size_t i = 0; i < together->n; i++)
        if (!isnan(together->contacts[i][estimator]))
            scratch[found++] = together->contacts[i][estimator];
    if (found == 0)
        return (double)NAN;
    return numbers_median(scratch, found);
}

static wt_status say_contacts(const indent_summary *together, const wt_indent_job *job,
                              const wt_job *work, wt_error *err)
{
    char text[512] = "";
    size_t length = 0;
    if (together->contacts == NULL)
        return WT_OK;
    double *scratch = malloc(together->n * sizeof *scratch);
    if (scratch == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (int i = 0; i < WT_CONTACT_ESTIMATORS; i++) {
        const double away = median_of(together, i, scratch);
        char distance[32] = "not found";
        if (!isnan(away))
            wt_format_si(away, "m", 3, distance, sizeof distance);
        length +=
            (size_t)snprintf(text + length, sizeof text - length, "%s%s (%s)", i > 0 ? ", " : "",
                             distance, wt_contact_estimator_text((wt_contact_estimator)i));
    }
    free(scratch);
    wt_log_add(work->log, WT_NOTE, NULL, NULL,
               "%s: contact by other estimators less that of the fit, medians of %zu "
               "accepted curves: %s",
               job->group, together->n, text);
    return WT_OK;
}

/* Smallest plausible indentation over the radius of a sphere. Below it only asperities touch and an
 * AFM cannot apply the force, so the unit of the radius is probably wrong. */
static const double least_depth_of_radius = 1.0 / 5000;

static void say_radius(const indent_summary *together, const wt_indent_job *job, const wt_job *work)
{
    char radius[32];
    const bool round = job->tip.shape == WT_TIP_SPHERE || job->tip.shape == WT_TIP_PARABOLOID;
    if (!round || together->n == 0 || together->deepest >= least_depth_of_radius * job->tip.radius)
        return;
    wt_format_si(job->tip.radius, "m", 3, radius, sizeof radius);
    wt_log_add(work->log, WT_WARNING, NULL, NULL,
               "%s: the radius of the tip, %s, is %.0f times the deepest indentation: is its "
               "unit right?",
               job->group, radius, job->tip.radius / together->deepest);
}

wt_status indent_summary_report(const indent_summary *together, const wt_indent_job *job,
                                const wt_job *work, table_writer *rows, wt_error *err)
{
    char not_shown[512];
    say_radius(together, job, work);
    indent_systematic_errors(job, together->deepest, not_shown, sizeof not_shown);
    if (*not_shown != '\0')
        indentation_set_text(rows, INDENTATION_KEY_NOT_SHOWN, not_shown);
    say_shifts(together, job, work, rows);
    pool_curves(together, job, work, rows);
    return say_contacts(together, job, work, err);
}
