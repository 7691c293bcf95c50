/* Error budget of the modulus of a group: scatter of its spots and systematic errors that all
 * curves share.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/calibration_errors.h"

#include "core/base/clocale.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <string.h>

/* Order: systematic errors from the calibration, systematic errors from the curves, scatter. */
enum { LOSS = WT_SYSTEMATIC_SOURCES, BEND, MISFIT, SCATTER, PARTS };

typedef struct part {
    const char *words;
    double source_error, error; /* relative errors of source and modulus; NaN if not known */
    wt_estimate gain;
    bool applies;
} part;

TABLE_ROW(modulus_budget, MODULUS_BUDGET, const char *group; error_kind kind; double share;
          part part;)

TABLE_KEYS(modulus_budget, MODULUS_BUDGET, wt_estimate modulus; double df, low, high;
           const char *says;)

typedef struct budget {
    part part[PARTS];
    wt_group_summary group;
    t_error scatter, all; /* errors of ln E; NaN with one spot */
    double curves, spots; /* standard deviations of ln E */
} budget;

static double log_standard_deviation(const wt_group *group)
{
    double mean = 0, squares = 0;
    for (size_t i = 0; i < group->n; i++) {
        const double y = log(group->modulus[i]), step = y - mean;
        mean += step / (double)(i + 1);
        squares += step * (y - mean);
    }
    return group->n > 1 ? sqrt(squares / (double)(group->n - 1)) : (double)NAN;
}

static wt_status compute_budget(const wt_group_data *d, budget *b, wt_error *err)
{
    *b = (budget){.curves = log_standard_deviation(&d->group)};
    const wt_status status = wt_group_summarise(&d->group, &b->group, err);
    if (status != WT_OK)
        return status;
    double variance = 0;
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
        b->part[i] = (part){.words = calibration_source_text((wt_systematic_source)i),
                            .source_error = d->common_error[i],
                            .error = fabs(d->common_gain[i].value) * d->common_error[i],
                            .gain = d->common_gain[i],
                            .applies = d->common_error[i] > 0 || !isnan(d->common_gain[i].value)};
    b->part[LOSS] = (part){"loss of unknown spectrum",
                           d->loss_error,
                           d->loss_error,
                           {1, 0, 0, "1"},
                           d->loss_error != 0};
    const double bend = fabs(d->bend_error);
    b->part[BEND] = (part){"bend of the baselines", bend, bend, {1, 0, 0, "1"}, bend != 0};
    b->part[MISFIT] = (part){"misfit of the contact law",
                             d->misfit_error,
                             d->misfit_error,
                             {1, 0, 0, "1"},
                             d->misfit_error > 0};
    for (int i = 0; i < SCATTER; i++) /* an error of unknown effect makes the total unknown */
        if (b->part[i].applies && (b->part[i].source_error > 0 || i >= WT_SYSTEMATIC_SOURCES))
            variance += b->part[i].error * b->part[i].error;
    b->scatter = (t_error){b->group.log_standard_error, b->group.df};
    b->all = (t_error){(double)NAN, (double)NAN};
    if (!isnan(b->scatter.error)) {
        if (!isnan(variance))
            b->all = t_error_add_normal(b->scatter, variance);
        b->spots = b->scatter.error * sqrt((double)b->group.n_spots);
    } else {
        b->spots = (double)NAN;
    }
    b->part[SCATTER] = (part){"scatter of the spots",
                              (double)NAN,
                              b->scatter.error,
                              {(double)NAN, (double)NAN, 0, "1"},
                              true};
    return WT_OK;
}

static double variance_share(const budget *b, double error)
{
    return error / b->all.error * (error / b->all.error);
}

static void add_budget_rows(table_writer *t, const char *group, const budget *b)
{
    const wt_estimate none = {(double)NAN, (double)NAN, 0, NULL};
    const part all = {"all that is stated", (double)NAN, b->all.error, none, true},
               spot = {"one spot", (double)NAN, b->spots, none, true},
               curve = {"one curve", (double)NAN, b->curves, none, true};
    for (int i = 0; i < PARTS; i++)
        if (b->part[i].applies)
            TABLE_ADD(modulus_budget, t, group, i == SCATTER ? ERROR_SCATTER : ERROR_SHARED,
                      variance_share(b, b->part[i].error), b->part[i]);
    TABLE_ADD(modulus_budget, t, group, ERROR_TOGETHER, variance_share(b, b->all.error), all);
    TABLE_ADD(modulus_budget, t, group, ERROR_BESIDE, (double)NAN, spot);
    TABLE_ADD(modulus_budget, t, group, ERROR_BESIDE, (double)NAN, curve);
}

/* ---- text ------------------------------------------------------------------------------------ */

static void append_contributions(const budget *b, char *text, size_t size)
{
    bool is_listed[PARTS] = {false};
    const char *before = ", of its square ";
    for (int n = 0; n < PARTS; n++) { /* in descending order */
        int largest = -1;
        for (int i = 0; i < PARTS; i++)
            if (!is_listed[i] && b->part[i].applies && b->part[i].error > 0 &&
                (largest < 0 || b->part[i].error > b->part[largest].error))
                largest = i;
        if (largest < 0)
            break;
        is_listed[largest] = true;
        clocale_append(text, size, "%s%.2g %% by the %s", before,
                       100 * variance_share(b, b->part[largest].error), b->part[largest].words);
        before = ", ";
    }
}

static void describe_budget(const char *group, const budget *b, char *text, size_t size)
{
    char value[32], low[32], high[32];
    const double half_width = students_t_quantile(b->all.df) * b->all.error;
    wt_format_si(b->group.geometric_mean, "Pa", 4, value, sizeof value);
    wt_format_si(b->group.geometric_mean * exp(-half_width), "Pa", 4, low, sizeof low);
    wt_format_si(b->group.geometric_mean * exp(half_width), "Pa", 4, high, sizeof high);
    text[0] = '\0';
    if (isnan(b->all.error)) {
        clocale_append(text, size, "modulus of the %s %s; its standard error is not known, for %s",
                       group, value,
                       isnan(b->scatter.error) ? "one spot tells nothing of how the sample scatters"
                       : isnan(b->part[LOSS].error)
                           ? "nothing says what the loss of its curves does"
                           : "no curve could be fitted anew with what is stated");
        const char *before = "; what its curves share makes ";
        for (int i = 0; i < SCATTER; i++)
            if (b->part[i].applies && b->part[i].error > 0) {
                clocale_append(text, size, "%s%.2g %% (%s)", before, 100 * b->part[i].error,
                               b->part[i].words);
                before = ", ";
            }
    } else {
        clocale_append(text, size,
                       "modulus of the %s %s, 95 %% interval %s to %s, standard error %.2g %%",
                       group, value, low, high, 100 * b->all.error);
        append_contributions(b, text, size);
    }
    const char *before = "; no error is stated of: ";
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
        if (b->part[i].applies && !(b->part[i].source_error > 0)) {
            clocale_append(text, size, "%s%s", before, b->part[i].words);
            before = ", ";
        }
}

static void add_budget_group(table_writer *t, const char *name, const wt_group_data *d)
{
    budget b;
    char text[640];
    if (t->status == WT_OK)
        t->status = compute_budget(d, &b, t->err);
    if (t->status != WT_OK)
        return;
    table_block(t);
    add_budget_rows(t, name, &b);
    const double e = b.group.geometric_mean,
                 half_width = students_t_quantile(b.all.df) * b.all.error;
    const bool bounded = !isnan(b.all.error) && isfinite(b.all.df);
    describe_budget(name, &b, text, sizeof text);
    TABLE_SET(modulus_budget, t, {e, e * b.all.error, 0, NULL}, bounded ? b.all.df : (double)NAN,
              e * exp(-half_width), e * exp(half_width), text);
}

static bool has_stated_error(const wt_group_data *d)
{
    bool any = false;
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
        any = any || d->common_error[i] > 0;
    return any && d->group.n > 0;
}

wt_status modulus_budget_create(const wt_group_data *groups, const char *const *names, size_t n,
                                wt_table **table, wt_error *err)
{
    *table = NULL;
    wt_table *result = NULL;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        table_writer t = {0};
        if (!has_stated_error(&groups[i]))
            continue;
        if (result == NULL) {
            t = table_begin(&modulus_budget_schema, err);
            status = table_end(&t, &result);
            if (status != WT_OK)
                break;
        }
        t = table_continue(result, &modulus_budget_schema, names[i], err);
        add_budget_group(&t, names[i], &groups[i]);
        status = table_end(&t, NULL);
    }
    if (status == WT_OK)
        *table = result;
    else
        wt_table_free(result);
    return status;
}
