/* Constants, and pairs of them, shared by the cases of a compound, of a condition, or by all cases.
 * Each constant has a weighted fit. It differs by a chi-squared test with Holm's correction; one
 * value suffices if all deviations are within the margin. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "layer/numerics/correlated_pair.h"
#include "study/collect.h"
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
    arena memory;
} shared_rows;

/* ---- selection ------------------------------------------------------------------------------- */

/* Adds the row of all values that share the name of this one. Adds none unless this value is the
 * first of several. */
static void add_shared_row(shared_rows *list, const case_value_list *values, size_t first,
                           sharing_level common)
{
    const case_value *v = &values->of[first];
    const char *name = collected_shared_name(v->of, common);
    shared_row row = {.constant = v->constant, .common = common, .of = name};
    if (name == NULL)
        return;
    row.members = arena_alloc(&list->memory, values->n, sizeof *row.members);
    row.deviation = arena_alloc(&list->memory, values->n, sizeof *row.deviation);
    for (size_t i = 0; i < values->n; i++) {
        const char *other = values->of[i].constant == v->constant
                                ? collected_shared_name(values->of[i].of, common)
                                : NULL;
        if (other != NULL && strcmp(other, name) == 0)
            row.members[row.n++] = &values->of[i];
    }
    const shared_row *last = list->n > 0 ? &list->rows[list->n - 1] : NULL;
    const bool again = common == OF_ALL && last != NULL && last->constant == v->constant &&
                       last->n == row.n; /* all cases belong to one sample or condition */
    if (row.n > 1 && row.members[0] == v && !again) {
        list->rows = array_grow(list->rows, list->n, sizeof *list->rows);
        list->rows[list->n++] = row;
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

static wt_status fit_shared_row(shared_row *row, arena *memory, wt_error *err)
{
    const size_t n = row->n;
    wt_log_ratio *of = arena_alloc(memory, n, sizeof *of);
    double *common = arena_numbers(memory, n * n);
    for (size_t i = 0; i < n; i++) {
        of[i] = row->members[i]->log;
        for (size_t k = 0; k < n; k++)
            common[i * n + k] = shared_covariance(row->members[i], row->members[k]);
    }
    return shared_value_fit(of, common, n, &row->found, row->deviation, err);
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
    double *p = arena_numbers(&list->memory, 2 * list->n);
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
        clocale_append(
            text, size, "%sthe error of the %s of %s is incomplete until that of %s is known",
            text[0] != '\0' ? "; " : "", shared_constant_names[v->constant], name, v->lacks);
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
    clocale_append(left_out, sizeof left_out, "%s", values->left_out);
    if (values->unnamed > 0)
        clocale_append(left_out, sizeof left_out, "; and %zu more", values->unnamed);
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
        status = fit_shared_row(&list.rows[i], &list.memory, err);
    if (status == WT_OK)
        assess_shared_rows(&list);
    if (status == WT_OK && (list.n > 0 || (n > 1 && values.left_out[0] != '\0')))
        status = list_constants(&list, &values, &tables->shared_constants, err);
    if (status == WT_OK && list.n > 0)
        status = list_members(&list, &tables->shared_members, err);
    arena_free(&list.memory);
    free(list.rows);
    free(values.of);
    return status;
}

/* ---- pairs of constants: critical energy and specific wear rate -------------------------------
 *
 * Their errors are correlated, so that each number may agree where the pair does not. Only values
 * by the same method are compared. */

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

/* A number without scatter has no correlation. */
static pair_covariance covariance_from_correlation(double energy, double wear, double correlation)
{
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
    const wt_status status = collected_bind(c, &identification_schema, "", &v, err);
    for (size_t row = 0; status == WT_OK && row < v.n_rows; row++) {
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
    return status;
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

static bool is_same_group(const reported_pair *a, const reported_pair *b, sharing_level common)
{
    const char *of_a = collected_shared_name(a->of, common),
               *of_b = collected_shared_name(b->of, common);
    return b->fixed && strcmp(a->by, b->by) == 0 && of_a != NULL && of_b != NULL &&
           strcmp(of_a, of_b) == 0;
}

/* Adds the row of which this pair is the first. Adds none if it is the only pair, or if all cases
 * share one name. */
static void add_pair_row(const reported_pairs *reported, size_t first, sharing_level common,
                         pair_rows *rows, arena *memory)
{
    const reported_pair *t = &reported->of[first];
    pair_row row = {.by = t->by, .common = common, .of = collected_shared_name(t->of, common)};
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
        of[i] = which == OF_ENERGY ? (wt_log_ratio){p->energy, sqrt(p->whole.energy), (double)NAN}
                                   : (wt_log_ratio){p->wear, sqrt(p->whole.wear), (double)NAN};
        for (size_t k = 0; k < n; k++) {
            const pair_covariance *a = &p->inputs, *b = &row->members[k]->pair.inputs;
            if (common[i * n + k])
                covariance[i * n + k] =
                    sqrt(which == OF_ENERGY ? a->energy * b->energy : a->wear * b->wear);
        }
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
            clocale_print(text, size,
                          "the error of %s, %s is incomplete until that of %s is "
                          "known",
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
            if (reported.of[i].fixed && collected_shared_name(reported.of[i].of, c) != NULL)
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
