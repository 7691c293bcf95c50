/* Constants shared by the cases of a compound, of a condition, or by all cases. Each constant has a
 * weighted fit. It differs by a chi-squared test with Holm's correction; one value suffices if all
 * deviations are within the margin.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/collect.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/table/table_rows.h"
#include "study/numerics/shared_value.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Significance level of the tests and of the intervals. */
static const double level = 0.05;

TABLE_ROW(shared_constants, SHARED_CONSTANTS, const char *constant, *over, *of; wt_interval value;
          const char *unit; double n, chi_squared, df, p, holm_p; sharing_verdict suffices;)
TABLE_KEYS(shared_constants, SHARED_CONSTANTS, double tested, different, undecided;
           const char *includes, *left_out, *settled_by; double margin;)
TABLE_ROW(shared_members, SHARED_MEMBERS, const char *constant, *over, *of, *member;
          double number, value; const char *unit; wt_interval ratio;)

/* Unit of each constant, and the level at which the theory shares it. All constants are also tested
 * over all cases. */
static const struct {
    const char *unit;
    sharing_level of;
} constants[N_SHARED_CONSTANTS] = {[SHARED_WEAR] = {"m^2/N", OF_CONDITION},
                                   [SHARED_SHEAR] = {"Pa", OF_ALL},
                                   [SHARED_RATE] = {"1", OF_SAMPLE}};

/* Values that are tested for equality. */
typedef struct shared_row {
    shared_constant constant;
    sharing_level common;
    const char *of;
    const case_value **members; /* [n] */
    shared_deviation *deviation;
    size_t n;
    shared_value found;
    double holm_p;
    sharing_verdict suffices;
} shared_row;

typedef struct shared_rows {
    shared_row *rows;
    size_t n;
    double margin;
} shared_rows;

/* ---- selection ------------------------------------------------------------------------------- */

/* Returns the name that the case of a value shares with others; NULL if it is not stated. */
static const char *shared_by_name(const case_value *v, sharing_level common)
{
    const char *name = common == OF_SAMPLE      ? v->of->sample
                       : common == OF_CONDITION ? v->of->condition
                                                : "";
    return common != OF_ALL && name[0] == '\0' ? NULL : name;
}

static void free_rows(shared_rows *list)
{
    for (size_t i = 0; i < list->n; i++) {
        free(list->rows[i].members);
        free(list->rows[i].deviation);
    }
    free(list->rows);
}

/* Adds the row of all values that share the name of this one. Adds none unless this value is the
 * first of several. */
static void add_shared_row(shared_rows *list, const case_value_list *values, size_t first,
                           sharing_level common)
{
    const case_value *v = &values->of[first];
    const char *name = shared_by_name(v, common);
    shared_row row = {.constant = v->constant, .common = common, .of = name};
    if (name == NULL)
        return;
    row.members = wt_alloc(values->n, sizeof *row.members);
    row.deviation = wt_alloc(values->n, sizeof *row.deviation);
    for (size_t i = 0; i < values->n; i++) {
        const char *other =
            values->of[i].constant == v->constant ? shared_by_name(&values->of[i], common) : NULL;
        if (other != NULL && strcmp(other, name) == 0)
            row.members[row.n++] = &values->of[i];
    }
    const shared_row *last = list->n > 0 ? &list->rows[list->n - 1] : NULL;
    const bool again = common == OF_ALL && last != NULL && last->constant == v->constant &&
                       last->n == row.n; /* all cases belong to one sample or condition */
    if (row.n > 1 && row.members[0] == v && !again) {
        list->rows = array_grow(list->rows, list->n, sizeof *list->rows);
        list->rows[list->n++] = row;
    } else {
        free(row.members);
        free(row.deviation);
    }
}

/* Lists the rows of each constant at its own level, then over all cases. */
static void find_shared_rows(shared_rows *list, const case_value_list *values)
{
    for (shared_constant c = 0; c < N_SHARED_CONSTANTS; c++)
        for (int all = constants[c].of == OF_ALL; all < 2; all++)
            for (size_t i = 0; i < values->n; i++)
                if (values->of[i].constant == c)
                    add_shared_row(list, values, i, all ? OF_ALL : constants[c].of);
}

/* ---- fit and verdict ------------------------------------------------------------------------- */

static wt_status fit_shared_row(shared_row *row, wt_error *err)
{
    const size_t n = row->n;
    wt_log_ratio *of = wt_alloc(n, sizeof *of);
    double *common = wt_alloc(n * n, sizeof *common);
    for (size_t i = 0; i < n; i++) {
        of[i] = row->members[i]->log;
        for (size_t k = 0; k < n; k++)
            common[i * n + k] = shared_covariance(row->members[i], row->members[k]);
    }
    const wt_status status = shared_value_fit(of, common, n, &row->found, row->deviation, err);
    free(of);
    free(common);
    return status;
}

/* Returns the first value with an incomplete error, which prevents a verdict, or NULL. */
static const case_value *find_incomplete_value(const shared_row *row)
{
    for (size_t i = 0; i < row->n; i++)
        if (row->members[i]->lacks != NULL && row->members[i]->lacks[0] != '\0')
            return row->members[i];
    return NULL;
}

/* True if all values are within the margin. */
static bool is_within_margin(const shared_row *row, double margin)
{
    const double least = log1p(margin);
    bool within = true;
    for (size_t i = 0; i < row->n; i++)
        within = within && row->deviation[i].low > -least && row->deviation[i].high < least;
    return within;
}

static void assess_shared_rows(shared_rows *list)
{
    double *p = wt_alloc(2 * list->n, sizeof *p);
    for (size_t i = 0; i < list->n; i++)
        p[i] = list->rows[i].found.p;
    wt_holm_adjust(p, list->n, p + list->n);
    for (size_t i = 0; i < list->n; i++) {
        shared_row *row = &list->rows[i];
        row->holm_p = p[list->n + i];
        row->suffices = find_incomplete_value(row) != NULL    ? SHARING_INCONCLUSIVE
                        : row->holm_p < level                 ? SHARING_DIFFERS
                        : is_within_margin(row, list->margin) ? SHARING_ONE
                                                              : SHARING_INCONCLUSIVE;
    }
    free(p);
}

/* ---- tables ---------------------------------------------------------------------------------- */

/* Factor by which the errors of a row must shrink, with the same values, for a verdict: all within
 * the margin, or one that excludes 0. */
static double required_narrowing(const shared_row *row, double margin)
{
    double within = 0, beside = (double)INFINITY;
    for (size_t i = 0; i < row->n; i++) {
        const shared_deviation *d = &row->deviation[i];
        const double half = (d->high - d->low) / 2, room = log1p(margin) - fabs(d->value);
        within = fmax(within, room > 0 ? half / room : (double)INFINITY);
        beside = fmin(beside, half / fabs(d->value));
    }
    return fmin(within, beside);
}

static void advise_errors(const shared_rows *list, char *text, size_t size)
{
    for (size_t i = 0; i < list->n; i++) {
        const case_value *v = find_incomplete_value(&list->rows[i]);
        char name[256];
        if (v == NULL)
            continue;
        shared_value_name(v, name, sizeof name);
        clocale_append(text, size,
                       "%sthe error of the %s of %s is not whole before that of %s is "
                       "known",
                       text[0] != '\0' ? "; " : "", shared_constant_names[v->constant], name,
                       v->lacks);
        return;
    }
}

static void advise_shared_row(const shared_rows *list, char *text, size_t size)
{
    const shared_row *nearest = NULL;
    double least = (double)INFINITY;
    for (size_t i = 0; i < list->n; i++) {
        const shared_row *row = &list->rows[i];
        const double needed = required_narrowing(row, list->margin);
        if (row->suffices == SHARING_INCONCLUSIVE && find_incomplete_value(row) == NULL &&
            needed < least) {
            least = needed;
            nearest = row;
        }
    }
    if (nearest != NULL)
        clocale_print(
            text, size,
            "errors smaller by a factor of about %.2g, of each case, would decide the nearest of "
            "them, the %s of %s%s%s",
            fmax(1.1, least), shared_constant_names[nearest->constant],
            sharing_level_text(nearest->common), nearest->of[0] != '\0' ? " " : "", nearest->of);
    advise_errors(list, text, size);
}

static void format_excluded_values(const case_value_list *values, char *text, size_t size)
{
    clocale_print(text, size, "%s", values->left_out);
    if (values->unnamed > 0)
        clocale_append(text, size, "; and %zu more", values->unnamed);
}

static wt_status list_constants(const shared_rows *list, const case_value_list *values,
                                wt_table **table, wt_error *err)
{
    char left_out[sizeof values->left_out + 32] = ""; /* plus the number of further values */
    char settled_by[900] = "";
    double different = 0, undecided = 0;
    table_writer w = table_begin(&shared_constants_schema, err);
    for (size_t i = 0; i < list->n; i++) {
        const shared_row *row = &list->rows[i];
        const shared_value *f = &row->found;
        const double value = exp(f->value);
        different += row->suffices == SHARING_DIFFERS;
        undecided += row->suffices == SHARING_INCONCLUSIVE;
        TABLE_ADD(shared_constants, &w, shared_constant_names[row->constant],
                  sharing_level_text(row->common), row->of,
                  (wt_interval){value, value * f->error, exp(f->low), exp(f->high)},
                  constants[row->constant].unit, (double)row->n, f->chi_squared, f->df, f->p,
                  row->holm_p, row->suffices);
    }
    advise_shared_row(list, settled_by, sizeof settled_by);
    format_excluded_values(values, left_out, sizeof left_out);
    TABLE_SET(shared_constants, &w, (double)list->n, different, undecided,
              "what those of the cases include, and that an error by a DMA with its shift law, by "
              "strain sweeps or by scans of a surface that cases share may be one; not what else "
              "they share, such as a load cell",
              left_out, settled_by, list->margin);
    return table_end(&w, table);
}

static wt_status list_members(const shared_rows *list, wt_table **table, wt_error *err)
{
    table_writer w = table_begin(&shared_members_schema, err);
    for (size_t i = 0; i < list->n; i++) {
        const shared_row *row = &list->rows[i];
        table_block(&w);
        for (size_t k = 0; k < row->n; k++) {
            char name[256];
            const shared_deviation *d = &row->deviation[k];
            shared_value_name(row->members[k], name, sizeof name);
            TABLE_ADD(shared_members, &w, shared_constant_names[row->constant],
                      sharing_level_text(row->common), row->of, name, (double)(k + 1),
                      exp(row->members[k]->log.value), constants[row->constant].unit,
                      (wt_interval){exp(d->value), (double)NAN, exp(d->low), exp(d->high)});
        }
    }
    return table_end(&w, table);
}

wt_status collect_constants(const collected_case *cases, size_t n, double margin,
                            wt_collection_tables *tables, wt_error *err)
{
    case_value_list values;
    shared_rows list = {.margin = margin};
    wt_status status = shared_values_read(cases, n, &values, err);
    if (status == WT_OK)
        find_shared_rows(&list, &values);
    for (size_t i = 0; status == WT_OK && i < list.n; i++)
        status = fit_shared_row(&list.rows[i], err);
    if (status == WT_OK)
        assess_shared_rows(&list);
    if (status == WT_OK && (list.n > 0 || (n > 1 && values.left_out[0] != '\0')))
        status = list_constants(&list, &values, &tables->shared_constants, err);
    if (status == WT_OK && list.n > 0)
        status = list_members(&list, &tables->shared_members, err);
    free_rows(&list);
    free(values.of);
    return status;
}
