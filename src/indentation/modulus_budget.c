/* Error budget of a group: the scatter of its spots and the errors that all its curves share.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "indentation/calibration_errors.h"
#include "indentation/indent.h"

#include <math.h>
#include <stdlib.h>

/* Order: systematic errors from the calibration, systematic errors from the curves, scatter. */
enum { TIP = WT_SYSTEMATIC_SOURCES, LOSS, BEND, RANGE, SCATTER, PARTS };

typedef struct part {
    const char *words;
    double source_error, error; /* relative errors of source and modulus; NaN if not known */
    wt_estimate gain;
    bool applies, is_assumed;
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

/* Part of a source of calibration with its stated error, or else the assumed one. An assumed error
 * of unknown effect does not apply. */
static part source_part(const wt_group_data *d, wt_systematic_source source)
{
    const wt_estimate gain = d->common_gain[source];
    const bool is_assumed =
        !(d->common_error[source] > 0) && d->assumed_error[source] > 0 && !isnan(gain.value);
    const double error = is_assumed ? d->assumed_error[source] : d->common_error[source];
    return (part){.words = calibration_source_text(source),
                  .source_error = error,
                  .error = fabs(gain.value) * error,
                  .gain = gain,
                  .applies = error > 0 || !isnan(gain.value),
                  .is_assumed = is_assumed};
}

/* Part that is a relative error of the modulus itself. An error of 0 does not apply; NaN is
 * unknown. */
static part shown_part(const char *words, double error)
{
    return (part){words, error, error, {1, 0, 0, "1"}, error != 0, false};
}

static wt_status compute_budget(const wt_group_data *d, budget *b, wt_error *err)
{
    *b = (budget){.curves = log_standard_deviation(&d->group)};
    const wt_status status = wt_group_summarise(&d->group, &b->group, err);
    if (status != WT_OK)
        return status;
    double variance = 0;
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
        b->part[i] = source_part(d, (wt_systematic_source)i);
    b->part[TIP] = shown_part("shape of the tip", isnan(d->tip_error) ? 0 : d->tip_error);
    b->part[LOSS] = shown_part("loss of unknown spectrum", d->loss_error);
    b->part[BEND] = shown_part("bend of the baselines", fabs(d->bend_error));
    b->part[RANGE] = shown_part("range of the fit", d->range_error);
    /* an error of unknown effect makes the total unknown, but not a misfit that is not tested */
    for (int i = 0; i < SCATTER; i++)
        if (b->part[i].applies &&
            (b->part[i].source_error > 0 || (i >= WT_SYSTEMATIC_SOURCES && i != RANGE)))
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
                              true,
                              false};
    return WT_OK;
}

static double variance_share(const budget *b, double error)
{
    return error / b->all.error * (error / b->all.error);
}

static void add_budget_rows(table_writer *t, const char *group, const budget *b)
{
    const wt_estimate none = {(double)NAN, (double)NAN, 0, NULL};
    const part all = {"all together", (double)NAN, b->all.error, none, true, false},
               spot = {"one spot", (double)NAN, b->spots, none, true, false},
               curve = {"one curve", (double)NAN, b->curves, none, true, false};
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
        clocale_append(text, size, "%s%s by the %s%s", before,
                       format_percent(variance_share(b, b->part[largest].error)).text,
                       b->part[largest].words, b->part[largest].is_assumed ? " (assumed)" : "");
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
                       isnan(b->scatter.error) ? "one spot does not determine the scatter of "
                                                 "the sample"
                       : isnan(b->part[LOSS].error)
                           ? "nothing says what the loss of its curves does"
                           : "no curve could be fitted anew with what is stated");
        const char *before = "; what its curves share makes ";
        for (int i = 0; i < SCATTER; i++)
            if (b->part[i].applies && b->part[i].error > 0) {
                clocale_append(text, size, "%s%s (%s)", before,
                               format_percent(b->part[i].error).text, b->part[i].words);
                before = ", ";
            }
    } else {
        clocale_append(text, size,
                       "modulus of the %s %s, 95 %% interval %s to %s, standard error %s", group,
                       value, low, high, format_percent(b->all.error).text);
        append_contributions(b, text, size);
    }
    const char *before = "; no error is stated of: ";
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
        if (b->part[i].applies && !(b->part[i].source_error > 0)) {
            clocale_append(text, size, "%s%s", before, b->part[i].words);
            before = ", ";
        }
    if (isnan(b->part[RANGE].error))
        clocale_append(text, size, "; not included, because no curve tests it: range of the fit");
}

static void add_budget_group(table_writer *t, const char *name, const wt_group_data *d)
{
    budget b;
    char text[1024];
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

/* True if the curves share an error. Without one the table would repeat the scatter. */
static bool has_shared_error(const wt_group_data *d)
{
    bool any = d->tip_error > 0 || d->loss_error != 0 || d->bend_error != 0 || d->range_error != 0;
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
        any = any || d->common_error[i] > 0 || d->assumed_error[i] > 0;
    return any && d->group.n > 0;
}

wt_status modulus_budget_interval(const wt_group_data *d, wt_group_summary *summary, wt_error *err)
{
    budget b;
    const wt_status status = compute_budget(d, &b, err);
    if (status != WT_OK)
        return status;
    const double half_width = students_t_quantile(b.all.df) * b.all.error;
    *summary = b.group;
    summary->low = b.group.geometric_mean * exp(-half_width);
    summary->high = b.group.geometric_mean * exp(half_width);
    return WT_OK;
}

wt_status modulus_budget_create(const wt_group_data *groups, const char *const *names, size_t n,
                                wt_table **table, wt_error *err)
{
    *table = NULL;
    wt_table *result = NULL;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        table_writer t = {0};
        if (!has_shared_error(&groups[i]))
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
