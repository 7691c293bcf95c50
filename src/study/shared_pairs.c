/* Critical energy and specific wear rate that cases share as a pair. Their errors are correlated,
 * so that each number may agree where the pair does not. Only values by the same method are
 * compared.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/collect.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "layer/numerics/correlated_pair.h"
#include "study/numerics/shared_value.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Significance level of the tests and of the intervals. */
static const double level = 0.05;

TABLE_ROW(collected_constants, COLLECTED_CONSTANTS, const char *sample, *condition, *by;
          wt_interval energy, wear; constant_axes axes;)
TABLE_ROW(shared_pairs, SHARED_PAIRS, const char *by; sharing_level over; const char *of; double n;
          sharing_verdict one_energy, one_wear, one_pair; wt_interval energy, wear;
          constant_axes axes; double chi_squared, df, holm_p;)
TABLE_KEYS(shared_pairs, SHARED_PAIRS, sharing_verdict one_of_all; double tests;
           const char *left_out, *settled_by; double margin;)

/* Pair of a case by one method: a row of its table "identification". */
typedef struct reported_pair {
    const collected_case *of;
    const char *by, *lacks; /* lacks: missing errors, or "" */
    constant_pair pair;
    wt_interval energy, wear;
    constant_axes axes;
    bool fixed; /* the covariance is known */
} reported_pair;

typedef struct reported_pairs {
    reported_pair *of;
    size_t n;
    char left_out[1000];
} reported_pairs;

/* Tests of a row. */
enum { OF_ENERGY, OF_WEAR, OF_BOTH, TESTS };

typedef struct pair_row {
    const char *by, *of;
    sharing_level common;
    const reported_pair **members; /* [n] */
    size_t n;
    shared_pair found;
    double p[TESTS], holm_p[TESTS];
    double off[OF_BOTH]; /* largest deviation from the shared value, as a limit of its interval */
    sharing_verdict says[TESTS];
} pair_row;

typedef struct pair_rows {
    pair_row *of;
    size_t n;
} pair_rows;

/* ---- pairs of the cases ---------------------------------------------------------------------- */

static pair_covariance covariance_from_correlation(double energy, double wear, double correlation)
{
    /* a number without scatter has no correlation */
    return (pair_covariance){energy * energy, wear * wear,
                             isnan(correlation) ? 0 : correlation * energy * wear};
}

static wt_interval interval_at(const table_view *v, size_t row, unsigned first)
{
    return (wt_interval){identification_get(v, row, first), identification_get(v, row, first + 1),
                         identification_get(v, row, first + 2),
                         identification_get(v, row, first + 3)};
}

static reported_pair read_reported_pair(const collected_case *c, const table_view *v, size_t row)
{
    const char *lacks = identification_key_text(v, IDENTIFICATION_KEY_LACKS);
    reported_pair t = {.of = c,
                       .by = identification_text(v, row, IDENTIFICATION_BY),
                       .lacks = lacks != NULL ? lacks : "",
                       .energy = interval_at(v, row, IDENTIFICATION_ENERGY),
                       .wear = interval_at(v, row, IDENTIFICATION_WEAR)};
    const double of_energy = t.energy.standard_error / t.energy.value,
                 of_wear = t.wear.standard_error / t.wear.value,
                 correlation = identification_get(v, row, IDENTIFICATION_CORRELATION);
    t.axes.correlation = correlation;
    t.axes.loose_error = identification_get(v, row, IDENTIFICATION_LOOSE_ERROR);
    t.axes.tight_error = identification_get(v, row, IDENTIFICATION_TIGHT_ERROR);
    snprintf(t.axes.loose, sizeof t.axes.loose, "%s",
             identification_text(v, row, IDENTIFICATION_LOOSE));
    t.pair = (constant_pair){
        log(t.energy.value), log(t.wear.value),
        covariance_from_correlation(of_energy, of_wear, correlation),
        covariance_from_correlation(identification_get(v, row, IDENTIFICATION_ENERGY_INPUTS),
                                    identification_get(v, row, IDENTIFICATION_WEAR_INPUTS),
                                    identification_get(v, row, IDENTIFICATION_CORRELATION_INPUTS))};
    /* a correlation of 1 determines no pair, and results without these columns have no shared
     * component */
    t.fixed = of_energy > 0 && of_wear > 0 && fabs(correlation) < 1 - 1e-6 &&
              !isnan(t.pair.inputs.energy + t.pair.inputs.wear);
    return t;
}

static wt_status add_case_pairs(const collected_case *c, reported_pairs *to, wt_error *err)
{
    table_view v;
    const wt_status status = table_bind_result(c->result, &identification_schema, "", &v, err);
    if (status != WT_OK) {
        wt_error_file(err, c->file);
        return status;
    }
    for (size_t row = 0; row < v.n_rows; row++) {
        const reported_pair t = read_reported_pair(c, &v, row);
        to->of = array_grow(to->of, to->n, sizeof *to->of);
        to->of[to->n++] = t;
        if (!t.fixed && !isnan(t.energy.value)) {
            const char *why = identification_text(&v, row, IDENTIFICATION_NOTE);
            clocale_append(to->left_out, sizeof to->left_out, "%s%s, %s: %s",
                           to->left_out[0] != '\0' ? "; " : "", c->sample, c->condition,
                           why[0] != '\0' ? why : "the errors of both are one");
        }
    }
    return WT_OK;
}

static wt_status list_reported_pairs(const reported_pairs *reported, wt_table **table,
                                     wt_error *err)
{
    table_writer w = table_begin(&collected_constants_schema, err);
    for (size_t i = 0; i < reported->n; i++) {
        const reported_pair *t = &reported->of[i];
        TABLE_ADD(collected_constants, &w, t->of->sample, t->of->condition, t->by, t->energy,
                  t->wear, t->axes);
    }
    return table_end(&w, table);
}

/* ---- selection ------------------------------------------------------------------------------- */

static const char *pair_shared_by_name(const reported_pair *t, sharing_level common)
{
    const char *name = common == OF_SAMPLE      ? t->of->sample
                       : common == OF_CONDITION ? t->of->condition
                                                : "";
    return common != OF_ALL && name[0] == '\0' ? NULL : name;
}

static bool is_same_group(const reported_pair *a, const reported_pair *b, sharing_level common)
{
    const char *of_a = pair_shared_by_name(a, common), *of_b = pair_shared_by_name(b, common);
    return b->fixed && strcmp(a->by, b->by) == 0 && of_a != NULL && of_b != NULL &&
           strcmp(of_a, of_b) == 0;
}

/* Adds the row of which this pair is the first. Adds none if it is the only pair, or if all cases
 * share one name. */
static void add_pair_row(const reported_pairs *reported, size_t first, sharing_level common,
                         pair_rows *rows, arena *memory)
{
    const reported_pair *t = &reported->of[first];
    pair_row row = {.by = t->by, .common = common, .of = pair_shared_by_name(t, common)};
    size_t others = 0;
    row.members = arena_alloc(memory, reported->n, sizeof *row.members);
    for (size_t i = 0; i < reported->n; i++) {
        if (is_same_group(t, &reported->of[i], common))
            row.members[row.n++] = &reported->of[i];
        others += is_same_group(t, &reported->of[i], OF_ALL);
    }
    if (row.n > 1 && row.members[0] == t && (common == OF_ALL || row.n < others)) {
        rows->of = array_grow(rows->of, rows->n, sizeof *rows->of);
        rows->of[rows->n++] = row;
    }
}

/* ---- fit and verdicts ------------------------------------------------------------------------ */

static double constant_variance(pair_covariance c, int which)
{
    return which == OF_ENERGY ? c.energy : c.wear;
}

/* Fits one of the two constants. */
static wt_status fit_one_constant(pair_row *row, const bool *common, int which, arena *memory,
                                  wt_error *err)
{
    const size_t n = row->n;
    wt_log_ratio *of = arena_alloc(memory, n, sizeof *of);
    double *covariance = arena_numbers(memory, n * n);
    shared_deviation *deviation = arena_alloc(memory, n, sizeof *deviation);
    shared_value found;
    for (size_t i = 0; i < n; i++) {
        const constant_pair *p = &row->members[i]->pair;
        of[i] = (wt_log_ratio){which == OF_ENERGY ? p->energy : p->wear,
                               sqrt(constant_variance(p->whole, which)), (double)NAN};
        for (size_t k = 0; k < n; k++)
            if (common[i * n + k])
                covariance[i * n + k] =
                    sqrt(constant_variance(p->inputs, which) *
                         constant_variance(row->members[k]->pair.inputs, which));
    }
    const wt_status status = shared_value_fit(of, covariance, n, &found, deviation, err);
    row->p[which] = found.p;
    for (size_t i = 0; status == WT_OK && i < n; i++)
        row->off[which] = fmax(row->off[which], fmax(-deviation[i].low, deviation[i].high));
    return status;
}

static wt_status fit_pair_row(pair_row *row, arena *memory, wt_error *err)
{
    const size_t n = row->n;
    constant_pair *pairs = arena_alloc(memory, n, sizeof *pairs);
    bool *common = arena_alloc(memory, n * n, sizeof *common);
    for (size_t i = 0; i < n; i++) {
        pairs[i] = row->members[i]->pair;
        for (size_t k = 0; k < n; k++)
            common[i * n + k] =
                i != k && inputs_may_be_shared(row->members[i]->of, row->members[k]->of);
    }
    wt_status status = shared_pair_fit(pairs, common, n, &row->found, err);
    row->p[OF_BOTH] = row->found.p;
    for (int which = 0; status == WT_OK && which < OF_BOTH; which++)
        status = fit_one_constant(row, common, which, memory, err);
    return status;
}

/* Returns the first pair with an incomplete error, which prevents a verdict, or NULL. */
static const reported_pair *find_incomplete_pair(const pair_row *row)
{
    for (size_t i = 0; i < row->n; i++)
        if (row->members[i]->lacks[0] != '\0')
            return row->members[i];
    return NULL;
}

static void assess_pair_rows(pair_rows *rows, double margin, arena *memory)
{
    double *p = arena_numbers(memory, 2 * TESTS * rows->n), *corrected = p + TESTS * rows->n;
    for (size_t i = 0; i < TESTS * rows->n; i++)
        p[i] = rows->of[i / TESTS].p[i % TESTS];
    wt_holm_adjust(p, TESTS * rows->n, corrected);
    for (size_t i = 0; i < rows->n; i++) {
        pair_row *row = &rows->of[i];
        bool within = true;
        for (int k = 0; k < TESTS; k++) {
            within = within && (k == OF_BOTH || row->off[k] < log1p(margin));
            const bool near = k == OF_BOTH ? within : row->off[k] < log1p(margin);
            row->holm_p[k] = corrected[TESTS * i + (size_t)k];
            row->says[k] = find_incomplete_pair(row) != NULL ? SHARING_INCONCLUSIVE
                           : row->holm_p[k] < level          ? SHARING_DIFFERS
                           : near                            ? SHARING_ONE
                                                             : SHARING_INCONCLUSIVE;
        }
    }
}

/* ---- tables ---------------------------------------------------------------------------------- */

static wt_interval shared_interval(double value, double variance)
{
    const double error = sqrt(variance);
    return (wt_interval){exp(value), exp(value) * error, exp(value - NORMAL_95 * error),
                         exp(value + NORMAL_95 * error)};
}

/* The pair is known well across its least-known combination. Only data that change this combination
 * determine both constants. */
static void write_pair_advice(const pair_rows *rows, char *text, size_t size)
{
    for (size_t i = 0; i < rows->n; i++) {
        const pair_row *row = &rows->of[i];
        const reported_pair *lacks = find_incomplete_pair(row);
        const constant_axes axes = constant_axes_compute(row->found.covariance);
        if (lacks != NULL) {
            clocale_print(text, size, "the error of %s, %s is not whole before that of %s is known",
                          lacks->of->sample, lacks->of->condition, lacks->lacks);
            return;
        }
        if (row->says[OF_BOTH] == SHARING_INCONCLUSIVE && text[0] == '\0')
            clocale_print(
                text, size,
                "what narrows %s, which is known least (to a factor of %.3g): a wear rate "
                "or a running-in time with a smaller error, of each case",
                axes.loose, exp(NORMAL_95 * axes.loose_error));
    }
}

/* Overall verdict over all cases and all methods: "differs" if any method differs. */
static sharing_verdict overall_verdict(const pair_rows *rows)
{
    sharing_verdict said = SHARING_UNKNOWN;
    for (size_t i = 0; i < rows->n; i++) {
        const sharing_verdict here = rows->of[i].says[OF_BOTH];
        if (rows->of[i].common == OF_ALL &&
            (said == SHARING_UNKNOWN || here == SHARING_DIFFERS || said == SHARING_ONE))
            said = here;
    }
    return said;
}

static wt_status list_rows(const pair_rows *rows, const reported_pairs *reported, double margin,
                           wt_table **table, wt_error *err)
{
    char settled_by[400] = "";
    table_writer w = table_begin(&shared_pairs_schema, err);
    for (size_t i = 0; i < rows->n; i++) {
        const pair_row *r = &rows->of[i];
        const shared_pair *f = &r->found;
        TABLE_ADD(
            shared_pairs, &w, r->by, r->common, r->of, (double)r->n, r->says[OF_ENERGY],
            r->says[OF_WEAR], r->says[OF_BOTH], shared_interval(f->energy, f->covariance.energy),
            shared_interval(f->wear, f->covariance.wear), constant_axes_compute(f->covariance),
            f->chi_squared, 2 * ((double)r->n - 1), r->holm_p[OF_BOTH]);
    }
    write_pair_advice(rows, settled_by, sizeof settled_by);
    TABLE_SET(shared_pairs, &w, overall_verdict(rows), (double)(TESTS * rows->n),
              reported->left_out, settled_by, margin);
    return table_end(&w, table);
}

wt_status collect_layer_constants(const collected_case *cases, size_t n, double margin,
                                  wt_collection_tables *tables, wt_error *err)
{
    reported_pairs reported = {.n = 0};
    pair_rows rows = {NULL, 0};
    arena memory = {0};
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = add_case_pairs(&cases[i], &reported, err);
    for (sharing_level c = 0; status == WT_OK && c < SHARED_BY_UNKNOWN; c++)
        for (size_t i = 0; status == WT_OK && i < reported.n; i++)
            if (reported.of[i].fixed && pair_shared_by_name(&reported.of[i], c) != NULL)
                add_pair_row(&reported, i, c, &rows, &memory);
    for (size_t i = 0; status == WT_OK && i < rows.n; i++)
        status = fit_pair_row(&rows.of[i], &memory, err);
    if (status == WT_OK)
        assess_pair_rows(&rows, margin, &memory);
    if (status == WT_OK && reported.n > 0)
        status = list_reported_pairs(&reported, &tables->collected_constants, err);
    if (status == WT_OK && rows.n > 0)
        status = list_rows(&rows, &reported, margin, &tables->shared_pairs, err);
    arena_free(&memory);
    free(rows.of);
    free(reported.of);
    return status;
}
