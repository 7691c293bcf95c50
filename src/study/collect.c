/* Collection of the results of cases by sample and condition, and their force against indentation.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/shared_params.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "study/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Binds a table of a case. The error names its file. */
static wt_status collected_bind(const collected_case *c, const table_schema *schema,
                                const char *suffix, table_view *view, wt_error *err)
{
    const wt_status status = table_bind_result(c->result, schema, suffix, view, err);
    if (status != WT_OK)
        wt_error_file(err, c->file);
    return status;
}

TABLE_ROW(collected_ramp, COLLECTED_RAMP, const char *sample;
          double temperature, angular_frequency, storage_modulus, loss_modulus;)
TABLE_KEYS(collected_ramp, COLLECTED_RAMP, wt_deformation deformation; const char *left_out;)
TABLE_ROW(collected_force, COLLECTED_FORCE, const char *sample, *condition, *place;
          double indentation, force;)

/* ---- force against indentation --------------------------------------------------------------- */

/* Returns the display name of a group: "bulk", or the condition of the track. */
static const char *collected_group_name(const collected_case *c, const char *group)
{
    return strcmp(group, "bulk") == 0 ? group : c->condition[0] != '\0' ? c->condition : "track";
}

/* Groups that belong to no case, with the index of the group that is added. */
typedef struct paired_force {
    const collected_case *cases;
    const wt_collected_result *of;
    size_t n_cases, n, at;
} paired_force;

static bool has_group(const wt_collected_result *of, const char *group)
{
    table_view force;
    const bool bound =
        table_bind_result(of->result, &force_indentation_schema, "", &force, NULL) == WT_OK;
    for (size_t row = 0; bound && row < force.n_rows; row++)
        if (strcmp(force_indentation_text(&force, row, FORCE_INDENTATION_GROUP), group) == 0)
            return true;
    return false;
}

/* True if the name is used by another group. Without --group every indented sample is "bulk". */
static bool is_name_used(const paired_force *b, const char *group)
{
    bool taken = strcmp(group, "bulk") == 0 || strcmp(group, "track") == 0;
    for (size_t i = 0; i < b->n_cases && !taken; i++)
        taken = strcmp(group, b->cases[i].condition) == 0;
    for (size_t i = 0; i < b->n && !taken; i++)
        taken = i != b->at && has_group(&b->of[i], group);
    return taken;
}

static void format_group_name(const paired_force *paired, const collected_case *c,
                              const char *group, char *place, size_t size)
{
    if (paired == NULL)
        (void)snprintf(place, size, "%s", collected_group_name(c, group));
    else if (is_name_used(paired, group))
        (void)snprintf(place, size, "%s of %s", group, paired->of[paired->at].file);
    else
        (void)snprintf(place, size, "%s", group);
}

/* Adds the curve of each group. A paired group is listed under each sample. */
static void add_force_curves(table_writer *w, const collected_case *c, const table_view *force,
                             const paired_force *paired)
{
    const char *before = NULL;
    char place[400] = "";
    for (size_t row = 0; row < force->n_rows; row++) {
        const char *group = force_indentation_text(force, row, FORCE_INDENTATION_GROUP);
        if (before == NULL || strcmp(group, before) != 0) {
            table_block(w);
            format_group_name(paired, c, group, place, sizeof place);
        }
        before = group;
        TABLE_ADD(collected_force, w, c->sample, paired == NULL ? c->condition : "", place,
                  force_indentation_get(force, row, FORCE_INDENTATION_INDENTATION),
                  force_indentation_get(force, row, FORCE_INDENTATION_FORCE));
    }
}

static wt_status add_paired_groups(table_writer *w, paired_force paired, const collected_case *c,
                                   wt_error *err)
{
    for (paired.at = 0; paired.at < paired.n; paired.at++) {
        const collected_case of = {.result = paired.of[paired.at].result,
                                   .file = paired.of[paired.at].file};
        table_view force;
        const wt_status status = collected_bind(&of, &force_indentation_schema, "", &force, err);
        if (status != WT_OK)
            return status;
        add_force_curves(w, c, &force, &paired);
    }
    return WT_OK;
}

/* Ends a table; NULL without rows. */
static wt_status end_or_drop(table_writer *w, wt_table **table)
{
    const wt_status status = table_end(w, table);
    if (status == WT_OK && wt_table_n_rows(*table) == 0) {
        wt_table_free(*table);
        *table = NULL;
    }
    return status;
}

/* Creates the table "collected_force"; NULL if no case has a curve. The second array holds results
 * with groups that belong to no case. */
static wt_status collect_force(const collected_case *cases, size_t n,
                               const wt_collected_result *paired, size_t n_beside, wt_table **table,
                               wt_error *err)
{
    const paired_force all = {cases, paired, n, n_beside, 0};
    table_writer w = table_begin(&collected_force_schema, err);
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        table_view force;
        status = collected_bind(&cases[i], &force_indentation_schema, "", &force, err);
        if (status == WT_OK)
            add_force_curves(&w, &cases[i], &force, NULL);
        if (status == WT_OK && (i + 1 == n || strcmp(cases[i].sample, cases[i + 1].sample) != 0))
            status = add_paired_groups(&w, all, &cases[i], err);
    }
    w.status = status != WT_OK ? status : w.status;
    return end_or_drop(&w, table);
}

/* ---- moduli against temperature -------------------------------------------------------------- */

/* Temperature sweeps of a case, or of an output of weartrack ramp, which has the name of its file.
 */
typedef struct sample_ramps {
    char sample[256];
    table_view ramp;
} sample_ramps;

static bool has_ramp_moduli(const table_view *ramp, size_t row)
{
    return ramp_get(ramp, row, RAMP_STORAGE_MODULUS) > 0 &&
           ramp_get(ramp, row, RAMP_LOSS_MODULUS) > 0;
}

/* The cases of one sample may state its sweeps again: the first has them. */
static wt_status list_ramps(const collected_case *cases, size_t n,
                            const wt_collected_result *paired, size_t n_paired, sample_ramps *ramps,
                            size_t *n_ramps, wt_error *err)
{
    *n_ramps = 0;
    for (size_t i = 0; i < n + n_paired; i++) {
        const bool is_case = i < n;
        const char *const file = is_case ? cases[i].file : paired[i - n].file;
        const collected_case of = {.result = is_case ? cases[i].result : paired[i - n].result,
                                   .file = file};
        sample_ramps *const r = &ramps[*n_ramps];
        const wt_status status = collected_bind(&of, &ramp_schema, "", &r->ramp, err);
        if (status != WT_OK)
            return status;
        (void)snprintf(r->sample, sizeof r->sample, "%s",
                       is_case ? cases[i].sample : wt_path_base(file));
        char *const dot = is_case ? NULL : strrchr(r->sample, '.');
        if (dot != NULL && dot > r->sample)
            *dot = '\0';
        const bool again = is_case && *n_ramps > 0 && strcmp(r[-1].sample, r->sample) == 0;
        *n_ramps += r->ramp.n_rows > 0 && !again;
    }
    return WT_OK;
}

/* Geometric mean of the frequencies of all rows that have both moduli; NaN without one. */
static double mean_ramp_frequency(const sample_ramps *ramps, size_t n)
{
    double sum = 0, rows = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t row = 0; row < ramps[i].ramp.n_rows; row++)
            if (has_ramp_moduli(&ramps[i].ramp, row)) {
                sum += log(ramp_get(&ramps[i].ramp, row, RAMP_ANGULAR_FREQUENCY));
                rows++;
            }
    return exp(sum / rows);
}

/* Adds the sweeps of a sample at the one of its frequencies that is nearest to the given one. */
static void add_ramps(table_writer *w, const sample_ramps *of, double frequency)
{
    const table_view *const ramp = &of->ramp;
    double nearest = (double)INFINITY;
    size_t before = SIZE_MAX;
    for (size_t row = 0; row < ramp->n_rows; row++) {
        const double own = ramp_get(ramp, row, RAMP_ANGULAR_FREQUENCY);
        if (has_ramp_moduli(ramp, row) &&
            !(fabs(log(own / frequency)) >= fabs(log(nearest / frequency))))
            nearest = own;
    }
    for (size_t row = 0; row < ramp->n_rows; row++) {
        if (!has_ramp_moduli(ramp, row) || ramp_get(ramp, row, RAMP_ANGULAR_FREQUENCY) != nearest)
            continue;
        if (wt_table_block(ramp->table, row) != before)
            table_block(w);
        before = wt_table_block(ramp->table, row);
        TABLE_ADD(collected_ramp, w, of->sample, ramp_get(ramp, row, RAMP_TEMPERATURE), nearest,
                  ramp_get(ramp, row, RAMP_STORAGE_MODULUS),
                  ramp_get(ramp, row, RAMP_LOSS_MODULUS));
    }
}

/* Creates the table "collected_ramp"; NULL if no result has both moduli of a temperature sweep.
 * Moduli of tension and of shear are not set beside each other: those that are not of the kind of
 * the first are left out. */
static wt_status collect_ramps(const collected_case *cases, size_t n,
                               const wt_collected_result *paired, size_t n_paired, wt_table **table,
                               wt_error *err)
{
    sample_ramps *const ramps = wt_alloc(n + n_paired, sizeof *ramps);
    size_t n_ramps = 0;
    wt_status status = list_ramps(cases, n, paired, n_paired, ramps, &n_ramps, err);
    if (status == WT_OK) {
        const double frequency = mean_ramp_frequency(ramps, n_ramps);
        table_writer w = table_begin(&collected_ramp_schema, err);
        char left_out[512] = "";
        int first = WT_TENSION;
        for (size_t i = 0; i < n_ramps; i++) {
            const int own = ramp_key_enum(&ramps[i].ramp, RAMP_KEY_DEFORMATION);
            const size_t used = strlen(left_out);
            first = i == 0 ? own : first;
            if (own == first)
                add_ramps(&w, &ramps[i], frequency);
            else
                (void)snprintf(left_out + used, sizeof left_out - used, "%s%s",
                               used > 0 ? ", " : "", ramps[i].sample);
        }
        TABLE_SET(collected_ramp, &w, first == WT_SHEAR ? WT_SHEAR : WT_TENSION, left_out);
        status = end_or_drop(&w, table);
    }
    free(ramps);
    return status;
}

/* ---- parameters ------------------------------------------------------------------------------ */

wt_collect_job wt_collect_job_defaults(void)
{
    return (wt_collect_job){.margin = 0.2};
}

static const wt_param rows[] = {EQUIVALENCE_MARGIN(wt_collect_job)};
PARAM_TABLE(wt_collect_job_params, wt_collect_job, rows, wt_collect_job_defaults, NO_PARTS)

TABLE_ROW(collection, COLLECTION, const char *sample, *condition; wt_interval ratio;
          stated_verdict differs; wt_interval thickness, change; const char *file;)
TABLE_KEYS(collection, COLLECTION, double cases, samples, conditions;)
TABLE_ROW(collected_modulus, COLLECTED_MODULUS, const char *sample, *condition, *place; double rate;
          wt_interval modulus;)
TABLE_ROW(collected_friction, COLLECTED_FRICTION, const char *sample, *condition;
          double velocity, friction, standard_error, with_layer, area_ratio;)
TABLE_KEYS(collected_friction, COLLECTED_FRICTION, friction_part part;)

/* ---- one case -------------------------------------------------------------------------------- */

static wt_status read_collected_case(const wt_collected_result *from, collected_case *c,
                                     wt_error *err)
{
    table_view answer;
    *c = (collected_case){.result = from->result, .file = from->file};
    wt_status status = collected_bind(c, &answer_schema, "", &answer, err);
    if (status == WT_OK)
        status = result_values_bind(from->result, &c->tables, err);
    if (status != WT_OK) {
        wt_error_file(err, from->file);
        return status;
    }
    const char *sample = answer_key_text(&answer, ANSWER_KEY_CASE_SAMPLE),
               *condition = answer_key_text(&answer, ANSWER_KEY_CASE_CONDITION);
    const wt_estimate ratio = comparison_value(&c->tables.comparison, COMPARISON_KEY_MODULUS_RATIO);
    c->sample = sample != NULL && sample[0] != '\0' ? sample : wt_path_base(from->file);
    c->condition = condition != NULL ? condition : "";
    c->ratio = (wt_log_ratio){
        log(ratio.value), ratio.standard_error / ratio.value,
        comparison_value(&c->tables.comparison, COMPARISON_KEY_MODULUS_RATIO_DF).value};
    return WT_OK;
}

static int compare_by_sample(const void *a, const void *b)
{
    const collected_case *p = a, *q = b;
    const int order = strcmp(p->sample, q->sample);
    return order != 0 ? order : strcmp(p->condition, q->condition);
}

static wt_status check_unique_names(const collected_case *cases, size_t n, wt_error *err)
{
    for (size_t i = 1; i < n; i++)
        if (compare_by_sample(&cases[i - 1], &cases[i]) == 0) {
            wt_fail(err, WT_E_AMBIGUOUS, "two cases of sample \"%s\" and condition \"%s\"",
                    cases[i].sample, cases[i].condition);
            wt_error_file(err, cases[i].file);
            wt_error_found(err, "%s too", cases[i - 1].file);
            wt_error_advice(err, "name what distinguishes them with <sample> and <condition> "
                                 "in the case files");
            return WT_E_AMBIGUOUS;
        }
    return WT_OK;
}

/* ---- tables ---------------------------------------------------------------------------------- */

static wt_interval result_interval(const result_value *f)
{
    return (wt_interval){f->number.value, f->number.standard_error, f->low, f->high};
}

static size_t count_different(const collected_case *cases, size_t n, bool condition)
{
    size_t found = 0;
    for (size_t i = 0; i < n; i++) {
        bool seen = false;
        for (size_t k = 0; k < i && !seen; k++)
            seen = strcmp(condition ? cases[k].condition : cases[k].sample,
                          condition ? cases[i].condition : cases[i].sample) == 0;
        found += !seen;
    }
    return found;
}

static wt_status list_cases(const collected_case *cases, size_t n, wt_table **table, wt_error *err)
{
    table_writer w = table_begin(&collection_schema, err);
    for (size_t i = 0; i < n; i++) {
        const collected_case *c = &cases[i];
        const result_value ratio = result_value_ratio(&c->tables),
                           thickness = result_value_thickness(&c->tables),
                           change = result_value_friction(&c->tables, FRICTION_KEY_RELATIVE_CHANGE);
        const int verdict = comparison_key_enum(&c->tables.comparison, COMPARISON_KEY_DIFFERS);
        TABLE_ADD(collection, &w, c->sample, c->condition, result_interval(&ratio),
                  verdict <= VERDICT_NO ? (stated_verdict)verdict : VERDICT_NOT_ASKED,
                  result_interval(&thickness), result_interval(&change), c->file);
    }
    TABLE_SET(collection, &w, (double)n, (double)count_different(cases, n, false),
              (double)count_different(cases, n, true));
    return table_end(&w, table);
}

/* Relative standard error that all curves of a group share (cantilever, tip), from the budget of
 * its modulus. 0 if nothing is stated; NaN if the effect of a stated error is unknown. It cancels
 * between groups of one case, but not between cases. */
static double shared_error(const result_value_tables *tables, const char *group)
{
    const table_view *budget = &tables->budget;
    double variance = 0;
    for (size_t row = 0; row < budget->n_rows; row++) {
        const error_kind kind = (error_kind)modulus_budget_enum(budget, row, MODULUS_BUDGET_KIND);
        const double error = modulus_budget_get(budget, row, MODULUS_BUDGET_RELATIVE_ERROR);
        if (strcmp(modulus_budget_text(budget, row, MODULUS_BUDGET_GROUP), group) != 0)
            continue;
        if (kind == ERROR_TOGETHER && isnan(error))
            return (double)NAN;
        if (kind == ERROR_SHARED && !isnan(error))
            variance += error * error;
    }
    return sqrt(variance);
}

/* Interval of a rate: the scatter of the spots, widened by the systematic errors. */
static wt_interval rate_modulus(const collected_case *c, const char *group, size_t row)
{
    const table_view *rates = &c->tables.rates;
    const double shared = NORMAL_95 * shared_error(&c->tables, group),
                 value = modulus_rate_get(rates, row, MODULUS_RATE_GEOMETRIC_MEAN),
                 down = log(value / modulus_rate_get(rates, row, MODULUS_RATE_LOW)),
                 up = log(modulus_rate_get(rates, row, MODULUS_RATE_HIGH) / value);
    return (wt_interval){value, (double)NAN, value * exp(-hypot(down, shared)),
                         value * exp(hypot(up, shared))};
}

/* Lists the rows of all rates. The table is NULL if no case has a rate. */
static wt_status list_moduli(const collected_case *cases, size_t n, wt_table **table, wt_error *err)
{
    table_writer w = table_begin(&collected_modulus_schema, err);
    for (size_t i = 0; i < n; i++) {
        const collected_case *c = &cases[i];
        const table_view *rates = &c->tables.rates;
        const char *before = "";
        for (size_t row = 0; row < rates->n_rows; row++) {
            const char *group = modulus_rate_text(rates, row, MODULUS_RATE_GROUP);
            if (strcmp(group, before) != 0)
                table_block(&w);
            before = group;
            TABLE_ADD(collected_modulus, &w, c->sample, c->condition,
                      collected_group_name(c, group),
                      modulus_rate_get(rates, row, MODULUS_RATE_RATE), rate_modulus(c, group, row));
        }
    }
    return end_or_drop(&w, table);
}

static wt_status list_friction(const collected_case *cases, size_t n, wt_table **table,
                               wt_error *err)
{
    bool total = true, any = false;
    for (size_t i = 0; i < n; i++) {
        const table_view *t = &cases[i].tables.friction;
        any = any || t->n_rows > 0;
        total = total && (t->n_rows == 0 || isfinite(friction_get(t, 0, FRICTION_TOTAL)));
    }
    if (!any)
        return WT_OK;
    table_writer w = table_begin(&collected_friction_schema, err);
    for (size_t i = 0; i < n; i++) {
        const collected_case *c = &cases[i];
        const table_view *t = &c->tables.friction;
        if (t->n_rows > 0)
            table_block(&w);
        for (size_t row = 0; row < t->n_rows; row++) {
            TABLE_ADD(collected_friction, &w, c->sample, c->condition,
                      friction_get(t, row, FRICTION_VELOCITY),
                      friction_get(t, row, total ? FRICTION_TOTAL : FRICTION_HYSTERESIS),
                      friction_get(t, row,
                                   total ? FRICTION_TOTAL_STANDARD_ERROR
                                         : FRICTION_HYSTERESIS_STANDARD_ERROR),
                      total ? friction_get(t, row, FRICTION_WITH_LAYER) : (double)NAN,
                      friction_get(t, row, FRICTION_AREA_RATIO));
        }
    }
    TABLE_SET(collected_friction, &w, total ? WHOLE_FRICTION : HYSTERESIS_ALONE);
    return table_end(&w, table);
}

static bool has_ramp(const wt_collected_result *paired, size_t n)
{
    bool found = false;
    for (size_t i = 0; i < n && !found; i++)
        found = wt_result_find(paired[i].result, ramp_schema.name) != NULL;
    return found;
}

/* Reads the cases, sorted by sample. Results that are not cases go to the second array. */
static wt_status read_cases(const wt_collected_result *from, size_t n, collected_case *cases,
                            size_t *n_cases, wt_collected_result *paired, wt_error *err)
{
    *n_cases = 0;
    for (size_t i = 0; i < n; i++) {
        if (wt_result_find(from[i].result, answer_schema.name) == NULL) {
            paired[i - *n_cases] = from[i];
            continue;
        }
        const wt_status status = read_collected_case(&from[i], &cases[*n_cases], err);
        if (status != WT_OK)
            return status;
        ++*n_cases;
    }
    if (*n_cases == 0 && has_ramp(paired, n))
        return WT_OK;
    if (*n_cases == 0) {
        const wt_status status = wt_fail(err, WT_E_EMPTY, "there is no case");
        wt_error_expected(err, "a result of weartrack run, beside which those of curves stand");
        return status;
    }
    qsort(cases, *n_cases, sizeof *cases, compare_by_sample);
    return check_unique_names(cases, *n_cases, err);
}

wt_status wt_collection_compute(const wt_collected_result *from, size_t n,
                                const wt_collect_job *job, wt_collection_tables *tables,
                                wt_error *err)
{
    *tables = (wt_collection_tables){0};
    if (n == 0)
        return wt_fail(err, WT_E_EMPTY, "there is no case");
    wt_status status = param_check(wt_collect_job_params(), job, err);
    collected_case *cases = wt_alloc(n, sizeof *cases);
    wt_collected_result *paired = wt_alloc(n, sizeof *paired);
    size_t n_cases = 0;
    if (status == WT_OK)
        status = read_cases(from, n, cases, &n_cases, paired, err);
    if (status == WT_OK)
        status = collect_ramps(cases, n_cases, paired, n - n_cases, &tables->collected_ramp, err);
    if (status == WT_OK && n_cases > 0)
        status = list_cases(cases, n_cases, &tables->collection, err);
    if (status == WT_OK)
        status = list_moduli(cases, n_cases, &tables->collected_modulus, err);
    if (status == WT_OK)
        status = list_friction(cases, n_cases, &tables->collected_friction, err);
    if (status == WT_OK)
        status = collect_force(cases, n_cases, paired, n - n_cases, &tables->collected_force, err);
    if (status == WT_OK)
        status = collect_pairs(cases, n_cases, job->margin, &tables->ratio_pairs, err);
    free(paired);
    free(cases);
    if (status != WT_OK)
        wt_tables_clear(tables, sizeof *tables);
    return status;
}
