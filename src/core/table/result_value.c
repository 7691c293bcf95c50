/* Computes the result values from the tables of a result. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/table/result_value.h"
#include "core/base/array.h"
#include "core/math/students_t.h"
#include "core/table/table.h"

#include <math.h>
#include <string.h>

/* Offset of the view of each table. */
static const struct {
    const table_schema *schema;
    size_t view;
} table_views[] = {{&modulus_groups_schema, offsetof(result_value_tables, groups)},
                   {&modulus_budget_schema, offsetof(result_value_tables, budget)},
                   {&modulus_rate_schema, offsetof(result_value_tables, rates)},
                   {&comparison_schema, offsetof(result_value_tables, comparison)},
                   {&friction_schema, offsetof(result_value_tables, friction)},
                   {&layer_schema, offsetof(result_value_tables, layer)},
                   {&what_if_schema, offsetof(result_value_tables, what_if)},
                   {&track_layer_schema, offsetof(result_value_tables, track_layer)},
                   {&answer_schema, offsetof(result_value_tables, answer)},
                   {&notes_schema, offsetof(result_value_tables, notes)},
                   {&failures_schema, offsetof(result_value_tables, failures)},
                   {&shift_factors_schema, offsetof(result_value_tables, shifts)}};

wt_status result_values_bind(const wt_result *result, result_value_tables *tables, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; i < COUNT_OF(table_views); i++) {
        table_view *view = (table_view *)((char *)tables + table_views[i].view);
        const wt_status one = table_bind_result(result, table_views[i].schema, "", view,
                                                status == WT_OK ? err : NULL);
        if (one != WT_OK)
            *view = (table_view){.schema = table_views[i].schema, .suffix = ""};
        status = status == WT_OK ? one : status;
    }
    return status;
}

bool result_values_use(const char *table)
{
    const char *const name = table_current_name(table);
    bool used = false;
    for (size_t i = 0; i < COUNT_OF(table_views); i++)
        used = used || strcmp(table_views[i].schema->name, name) == 0;
    for (size_t i = 0; i < table_n_schemas; i++)
        for (unsigned k = 0; k < table_schemas[i]->n_keys; k++)
            used = used || (table_schemas[i]->keys[k].headline != NULL &&
                            strcmp(table_schemas[i]->name, name) == 0);
    return used;
}

static result_value empty_result_value(const char *name, const char *words, wt_quantity quantity,
                                       const char *unit)
{
    const double unknown = (double)NAN;
    return (result_value){
        .name = name,
        .words = words,
        .quantity = quantity,
        .number = {unknown, unknown, unknown, unit},
        .low = unknown,
        .high = unknown,
        .neutral = unknown,
        .range = {.low = unknown, .high = unknown, .rest_low = unknown, .rest_high = unknown},
        .verdict = {VERDICT_UNKNOWN, "", ""},
        .frequency = {unknown, unknown},
        .velocity = unknown,
        .pressure = unknown};
}

/* ---- groups ---------------------------------------------------------------------------------- */

/* Finds the range of the equivalent frequencies for rates between two limits, for one group or for
 * all (NULL). */
static void find_frequencies(const result_value_tables *t, const char *group, double slowest,
                             double fastest, double frequency[2])
{
    for (size_t i = 0; i < t->rates.n_rows; i++) {
        const double rate = modulus_rate_get(&t->rates, i, MODULUS_RATE_RATE),
                     omega = modulus_rate_get(&t->rates, i, MODULUS_RATE_EQUIVALENT_FREQUENCY);
        if ((group != NULL &&
             strcmp(modulus_rate_text(&t->rates, i, MODULUS_RATE_GROUP), group) != 0) ||
            rate < slowest || rate > fastest)
            continue;
        frequency[0] = fmin(frequency[0], omega); /* fmin and fmax ignore NaN */
        frequency[1] = fmax(frequency[1], omega);
    }
}

result_value result_value_group(const result_value_tables *t, size_t row)
{
    const char *group = modulus_groups_text(&t->groups, row, MODULUS_GROUPS_GROUP);
    result_value f = empty_result_value("modulus", "Modulus", WT_Q_MODULUS, "Pa");
    f.number.value = modulus_groups_get(&t->groups, row, MODULUS_GROUPS_GEOMETRIC_MEAN);
    f.low = modulus_groups_get(&t->groups, row, MODULUS_GROUPS_LOW);
    f.high = modulus_groups_get(&t->groups, row, MODULUS_GROUPS_HIGH);
    const bool lone = modulus_groups_get(&t->groups, row, MODULUS_GROUPS_N_SPOTS) == 1;
    bool has_shared_error = false;
    for (size_t i = 0; i < t->budget.n_rows; i++)
        has_shared_error =
            has_shared_error ||
            (modulus_budget_enum(&t->budget, i, MODULUS_BUDGET_KIND) == ERROR_SHARED &&
             strcmp(modulus_budget_text(&t->budget, i, MODULUS_BUDGET_GROUP), group) == 0);
    if (has_shared_error)
        f.includes = lone ? "a given scatter of spots and the errors that all curves share"
                          : "scatter of the spots and the errors that all curves share";
    else
        f.includes = lone ? "a given scatter of spots" : "scatter of the spots";
    find_frequencies(t, group, 0, (double)INFINITY, f.frequency);
    return f;
}

/* ---- ratio of the groups --------------------------------------------------------------------- */

/* The first row of the table comparison holds the comparison over all rates. */
result_value result_value_ratio(const result_value_tables *t)
{
    const table_view *c = &t->comparison;
    result_value f =
        empty_result_value("modulus_ratio", "Modulus, track over bulk", WT_Q_NONE, "1");
    if (c->n_rows == 0)
        return f;
    double slowest = (double)NAN, fastest = (double)NAN;
    f.number.value = comparison_get(c, 0, COMPARISON_RATIO);
    f.low = comparison_get(c, 0, COMPARISON_RATIO_LOW);
    f.high = comparison_get(c, 0, COMPARISON_RATIO_HIGH);
    f.neutral = 1;
    f.verdict = comparison_key_listed(c, COMPARISON_KEY_DIFFERS);
    f.remedy = comparison_key_text(c, COMPARISON_KEY_SETTLED_BY);
    f.includes = comparison_key_text(c, COMPARISON_KEY_INCLUDES);
    f.range.low = comparison_value(c, COMPARISON_KEY_CHOICES_LOW).value;
    f.range.high = comparison_value(c, COMPARISON_KEY_CHOICES_HIGH).value;
    f.range.widest = comparison_key_text(c, COMPARISON_KEY_WIDEST_CHOICE);
    /* choices within the interval are not what to decide next */
    if (!(f.range.low > f.low && f.range.high < f.high))
        f.range.remedy = comparison_key_text(c, COMPARISON_KEY_CHOICE_REMEDY);
    for (size_t i = 1; i < c->n_rows; i++)
        if (!isnan(comparison_get(c, i, COMPARISON_RATIO))) {
            slowest = fmin(slowest, comparison_get(c, i, COMPARISON_RATE_LOW));
            fastest = fmax(fastest, comparison_get(c, i, COMPARISON_RATE_HIGH));
        }
    if (!isnan(slowest))
        find_frequencies(t, NULL, slowest, fastest, f.frequency);
    return f;
}

/* ---- sliding and layer ----------------------------------------------------------------------- */

/* Function that returns a number of one row of the table what_if. */
typedef double what_if_number(const table_view *what_if, size_t row);

#define WHAT_IF_ACCESSOR(name, column)                                                             \
    static double name(const table_view *what_if, size_t row)                                      \
    {                                                                                              \
        return what_if_get(what_if, row, column);                                                  \
    }
WHAT_IF_ACCESSOR(what_if_hysteresis, WHAT_IF_HYSTERESIS)
WHAT_IF_ACCESSOR(what_if_area, WHAT_IF_AREA_RATIO)
WHAT_IF_ACCESSOR(what_if_total, WHAT_IF_FRICTION)
WHAT_IF_ACCESSOR(what_if_thickness, WHAT_IF_THICKNESS)
WHAT_IF_ACCESSOR(what_if_with_layer, WHAT_IF_WITH_LAYER)

static double what_if_shearing(const table_view *what_if, size_t row)
{
    return what_if_total(what_if, row) - what_if_hysteresis(what_if, row);
}

static double what_if_change(const table_view *what_if, size_t row)
{
    return what_if_with_layer(what_if, row) - what_if_total(what_if, row);
}

static double what_if_relative_change(const table_view *what_if, size_t row)
{
    return what_if_with_layer(what_if, row) / what_if_total(what_if, row) - 1;
}

/* Smallest and largest number so far and of the rows from..to. */
static void extend_range(const table_view *what_if, what_if_number *number, size_t from, size_t to,
                         double *low, double *high)
{
    for (size_t i = from; i < to; i++) {
        *low = fmin(*low, number(what_if, i)); /* fmin and fmax ignore NaN */
        *high = fmax(*high, number(what_if, i));
    }
}

/* The rows of a choice are adjacent. Returns the row after those of the choice of row i. A choice
 * that this version does not know has one row. */
static size_t next_choice(const table_view *what_if, size_t i)
{
    const int choice = what_if_enum(what_if, i, WHAT_IF_CHOICE);
    do
        i++;
    while (choice != CHOICE_UNKNOWN && i < what_if->n_rows &&
           what_if_enum(what_if, i, WHAT_IF_CHOICE) == choice);
    return i;
}

/* Computes the range over model choices. The first row has the choices that were used. A range
 * within the numerical error is empty. */
static result_value_range model_choice_range(const table_view *what_if, what_if_number *number,
                                             double error)
{
    const double none = (double)NAN;
    result_value_range r = {.low = none, .high = none, .rest_low = none, .rest_high = none};
    size_t low = 0, high = 0;
    double widest = 0;
    if (what_if->n_rows < 2 || !isfinite(number(what_if, 0)))
        return r;
    for (size_t i = 1; i < what_if->n_rows; i++) {
        const double value = number(what_if, i);
        low = value < number(what_if, low) ? i : low;
        high = value > number(what_if, high) ? i : high;
    }
    if (low == high || number(what_if, high) - number(what_if, low) <= error)
        return r; /* for example an observed thickness */
    for (size_t i = 1, next; i < what_if->n_rows; i = next) {
        const char *remedy = what_if_text(what_if, i, WHAT_IF_REMEDY);
        const double used = number(what_if, 0);
        double least = used, most = used;
        next = next_choice(what_if, i);
        extend_range(what_if, number, i, next, &least, &most);
        if (most - least <= widest)
            continue;
        widest = most - least;
        r.widest = what_if_text(what_if, i, WHAT_IF_CHOICE);
        r.remedy = remedy != NULL && remedy[0] != '\0' ? remedy : NULL;
        r.rest_low = r.rest_high = used;
        extend_range(what_if, number, 1, i, &r.rest_low, &r.rest_high);
        extend_range(what_if, number, next, what_if->n_rows, &r.rest_low, &r.rest_high);
    }
    r.low = number(what_if, low);
    r.high = number(what_if, high);
    return r;
}

/* Computes the 95 % interval of a normal error. The lower limit of a positive number is at least
 * 0. */
static void set_normal_interval(result_value *f, bool positive)
{
    const double half = NORMAL_95 * f->number.standard_error;
    if (!(half > 0) || !isfinite(half) || !isfinite(f->number.value))
        return;
    f->low = f->number.value - half;
    f->high = f->number.value + half;
    if (positive)
        f->low = fmax(f->low, 0);
}

typedef struct predicted {
    friction_key key;
    what_if_number *number;
    bool positive;
} predicted;

static const predicted friction_numbers[] = {
    {FRICTION_KEY_FRICTION, what_if_total, true},
    {FRICTION_KEY_HYSTERESIS, what_if_hysteresis, true},
    {FRICTION_KEY_SHEARING, what_if_shearing, true},
    {FRICTION_KEY_AREA_RATIO, what_if_area, true},
    {FRICTION_KEY_WITH_LAYER, what_if_with_layer, true},
    {FRICTION_KEY_CHANGE, what_if_change, false},
    {FRICTION_KEY_RELATIVE_CHANGE, what_if_relative_change, false},
};

result_value result_value_friction(const result_value_tables *t, friction_key key)
{
    const schema_field *field = &friction_schema.keys[key];
    const char *words = field->headline != NULL ? field->headline : field->label;
    result_value f = empty_result_value(field->name, words, field->quantity, "1");
    for (size_t i = 0; i < COUNT_OF(friction_numbers); i++) {
        if (friction_numbers[i].key != key || t->friction.table == NULL)
            continue;
        f.predicted = true;
        f.number = friction_value(&t->friction, key);
        f.neutral = friction_numbers[i].positive ? (double)NAN : 0;
        f.includes = friction_key_text(&t->friction, FRICTION_KEY_ERROR_INCLUDES);
        f.lacks = friction_key_text(&t->friction, FRICTION_KEY_ERROR_LACKS);
        f.velocity = friction_value(&t->friction, FRICTION_KEY_REFERENCE_VELOCITY).value;
        f.pressure = friction_value(&t->friction, FRICTION_KEY_PRESSURE).value;
        f.range =
            model_choice_range(&t->what_if, friction_numbers[i].number, f.number.numerical_error);
        set_normal_interval(&f, friction_numbers[i].positive);
    }
    return f;
}

result_value result_value_thickness(const result_value_tables *t)
{
    const schema_field *field = &layer_schema.keys[LAYER_KEY_BALANCE_THICKNESS];
    result_value f = empty_result_value(field->name, field->headline, field->quantity, "m");
    if (t->layer.table == NULL)
        return f;
    f.predicted = true;
    f.number = layer_value(&t->layer, LAYER_KEY_BALANCE_THICKNESS);
    f.includes = layer_key_text(&t->layer, LAYER_KEY_ERROR_INCLUDES);
    f.lacks = layer_key_text(&t->layer, LAYER_KEY_ERROR_LACKS);
    f.velocity = layer_value(&t->layer, LAYER_KEY_VELOCITY).value;
    f.pressure = layer_value(&t->layer, LAYER_KEY_PRESSURE).value;
    f.range = model_choice_range(&t->what_if, what_if_thickness, f.number.numerical_error);
    set_normal_interval(&f, true);
    return f;
}

bool result_value_from_key(const result_value_tables *t, const schema_field *key, result_value *f)
{
    if (key == &layer_schema.keys[LAYER_KEY_BALANCE_THICKNESS]) {
        *f = result_value_thickness(t);
        return true;
    }
    for (size_t i = 0; i < COUNT_OF(friction_numbers); i++)
        if (key == &friction_schema.keys[friction_numbers[i].key]) {
            *f = result_value_friction(t, friction_numbers[i].key);
            return true;
        }
    return false;
}

int result_value_digits(double value, double low, double high)
{
    enum { LEAST = 3, MOST = 6, OF_ERROR = 2 };
    const double half = (high - low) / 2;
    if (!(half > 0) || !isfinite(half) || !(fabs(value) > 0) || !isfinite(value))
        return LEAST;
    const double digits = floor(log10(fabs(value))) - floor(log10(half)) + OF_ERROR;
    return (int)fmax(LEAST, fmin(MOST, digits));
}

/* ---- signs ----------------------------------------------------------------------------------- */

static sign_verdict sign_from_bounds(double low, double high, double neutral)
{
    return high < neutral ? SIGN_BELOW : low > neutral ? SIGN_ABOVE : SIGN_UNDECIDED;
}

/* Sign by the interval only, and by the interval and all model choices. */
static sign_verdict result_value_sign_measured(const result_value *f)
{
    const bool known = !isnan(f->low) && !isnan(f->high);
    return sign_from_bounds(known ? f->low : f->number.value, known ? f->high : f->number.value,
                            f->neutral);
}

sign_verdict result_value_sign(const result_value *f)
{
    const sign_verdict measured = result_value_sign_measured(f);
    if (isnan(f->range.low))
        return measured;
    return sign_from_bounds(f->range.low, f->range.high, f->neutral) == measured ? measured
                                                                                 : SIGN_UNDECIDED;
}
