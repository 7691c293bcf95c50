/* Values of the constants that cases may share: measured specific wear rate, required shear stress
 * of the record, and change of the modulus over a decade of the indentation rate. Input files that
 * cases share: their errors are shared, and a shared measurement counts once.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/math/students_t.h"
#include "core/table/registry.h"
#include "study/collect.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

wt_status collected_bind(const collected_case *c, const table_schema *schema, const char *suffix,
                         table_view *view, wt_error *err)
{
    const wt_status status = table_bind_result(c->result, schema, suffix, view, err);
    if (status != WT_OK)
        wt_error_file(err, c->file);
    return status;
}

const char *collected_shared_name(const collected_case *c, sharing_level common)
{
    const char *name = common == OF_SAMPLE ? c->sample : common == OF_CONDITION ? c->condition : "";
    return common != OF_ALL && name[0] == '\0' ? NULL : name;
}

static file_match compare_input_rows(const table_view *a, size_t i, const table_view *b, size_t k)
{
    const char *inputs_a = inputs_text(a, i, INPUTS_SHA256),
               *inputs_b = inputs_text(b, k, INPUTS_SHA256);
    if (inputs_a[0] != '\0' && inputs_b[0] != '\0')
        return strcmp(inputs_a, inputs_b) == 0 ? FILES_IDENTICAL : FILES_DIFFERENT;
    if (inputs_get(a, i, INPUTS_BYTES) != inputs_get(b, k, INPUTS_BYTES))
        return FILES_DIFFERENT;
    return strcmp(inputs_text(a, i, INPUTS_PATH), inputs_text(b, k, INPUTS_PATH)) == 0
               ? FILES_SAME_NAME
               : FILES_SAME_SIZE;
}

/* True if the file of a row has one of n roles. */
static bool has_role(const table_view *inputs, size_t row, const char *const *roles, size_t n)
{
    bool any = false;
    for (size_t i = 0; i < n && roles[i] != NULL; i++)
        any = any || strcmp(inputs_text(inputs, row, INPUTS_ROLE), roles[i]) == 0;
    return any;
}

static bool bind_inputs(const collected_case *c, table_view *inputs)
{
    return table_bind_result(c->result, &inputs_schema, "", inputs, NULL) == WT_OK &&
           inputs->table != NULL;
}

/* Compares the files of equal roles. A result without a list of files may share any. */
static file_match compare_input_files(const collected_case *a, const collected_case *b,
                                      const char *const *roles, size_t n)
{
    table_view of_a, of_b;
    file_match closest = FILES_DIFFERENT;
    if (!bind_inputs(a, &of_a) || !bind_inputs(b, &of_b))
        return FILES_SAME_SIZE;
    for (size_t i = 0; i < of_a.n_rows; i++)
        for (size_t k = 0; k < of_b.n_rows && has_role(&of_a, i, roles, n); k++) {
            const char *const role = inputs_text(&of_a, i, INPUTS_ROLE);
            const file_match found = has_role(&of_b, k, &role, 1)
                                         ? compare_input_rows(&of_a, i, &of_b, k)
                                         : FILES_DIFFERENT;
            closest = found > closest ? found : closest;
        }
    return closest;
}

/* Roles of the files of each category. */
static const char *const category_roles[INPUT_CATEGORIES][5] = {
    [SHARED_MATERIAL] = {"dma", "material", "topography", "roughness"},
    [SHARED_LAW] = {"dma", "material"},
    [SHARED_ROUGHNESS] = {"topography", "roughness"},
    [SHARED_SOFTENING] = {"softening", "dma"},
    [SHARED_SPECTRUM] = {"dma", "material"}};

/* Returns the category of an error source of a record; INPUT_CATEGORIES if there is none. */
static input_category input_category_of_source(validation_source source)
{
    switch (source) {
    case VALIDATION_SOURCE_MATERIAL:
    case VALIDATION_SOURCE_MATERIAL_AND_SURFACE:
    case VALIDATION_SOURCE_ALL_DRAWN:
        return SHARED_MATERIAL;
    case VALIDATION_SOURCE_SHIFT_LAW:
        return SHARED_LAW;
    case VALIDATION_SOURCE_ROUGHNESS:
        return SHARED_ROUGHNESS;
    case VALIDATION_SOURCE_SOFTENING:
        return SHARED_SOFTENING;
    default:
        return INPUT_CATEGORIES;
    }
}

double shared_covariance(const case_value *a, const case_value *b)
{
    double sum = 0;
    for (input_category i = 0; i < INPUT_CATEGORIES; i++) {
        const double closest = sqrt(a->by_files[i] * b->by_files[i]);
        if (closest > 0 && compare_input_files(a->of, b->of, category_roles[i],
                                               COUNT_OF(category_roles[i])) != FILES_DIFFERENT)
            sum += closest;
    }
    return sum;
}

static bool has_input_role(const collected_case *c, const char *const *roles, size_t n)
{
    table_view inputs;
    bool any = false;
    if (!bind_inputs(c, &inputs))
        return false;
    for (size_t row = 0; row < inputs.n_rows; row++)
        any = any || has_role(&inputs, row, roles, n);
    return any;
}

bool inputs_may_be_shared(const collected_case *a, const collected_case *b)
{
    static const char *const roles[] = {"dma", "material", "topography", "roughness", "softening"};
    const size_t n = COUNT_OF(roles);
    return !has_input_role(a, roles, n) || !has_input_role(b, roles, n) ||
           compare_input_files(a, b, roles, n) != FILES_DIFFERENT;
}

const char *const shared_constant_names[] = {[SHARED_WEAR] = "specific wear rate",
                                             [SHARED_SHEAR] = "shear stress",
                                             [SHARED_RATE] = "modulus over a decade of rate"};

/* ---- values of the cases --------------------------------------------------------------------- */

void shared_value_name(const case_value *v, char *text, size_t size)
{
    snprintf(text, size, "%s%s%s%s%s", v->of->sample, v->of->condition[0] != '\0' ? ", " : "",
             v->of->condition, v->group != NULL ? ", " : "", v->group != NULL ? v->group : "");
}

static void exclude_value(case_value_list *from, const case_value *v, const char *why)
{
    char name[256];
    const size_t used = strlen(from->left_out), room = sizeof from->left_out - used;
    shared_value_name(v, name, sizeof name);
    const int length = snprintf(from->left_out + used, room, "%s%s of %s: %s", used > 0 ? "; " : "",
                                shared_constant_names[v->constant], name, why);
    if (from->unnamed > 0 || (size_t)length >= room) {
        from->left_out[used] = '\0';
        from->unnamed++;
    }
}

/* True if the value uses the measurement of an earlier value. It is then excluded. */
static bool is_duplicate(case_value_list *to, const case_value *value)
{
    const char *const roles[N_SHARED_CONSTANTS] = {
        [SHARED_WEAR] = "record", [SHARED_SHEAR] = "record", [SHARED_RATE] = value->group};
    for (size_t i = 0; i < to->n; i++) {
        const case_value *v = &to->of[i];
        const bool alike =
            v->constant == value->constant &&
            (value->group == NULL || (v->group != NULL && strcmp(v->group, value->group) == 0));
        const file_match files =
            alike ? compare_input_files(v->of, value->of, &roles[value->constant], 1)
                  : FILES_DIFFERENT;
        char name[256], why[400];
        if (files < FILES_SAME_NAME)
            continue;
        shared_value_name(v, name, sizeof name);
        snprintf(why, sizeof why,
                 files == FILES_IDENTICAL ? "its files are those of %s, which count once"
                                          : "its files have names and sizes of those of %s and "
                                            "no digest distinguishes them (--no-provenance)",
                 name);
        exclude_value(to, value, why);
        return true;
    }
    return false;
}

/* Adds a value by its logarithm. A value that is not above 0, or whose interval includes 0, is
 * excluded. */
static void add_case_value(case_value_list *to, case_value value)
{
    const char *why = NULL;
    if (isnan(value.log.value) || is_duplicate(to, &value))
        return;
    if (isinf(value.log.value))
        why = "it is not above zero";
    else if (isinf(value.log.standard_error))
        why = "its interval reaches zero";
    else if (!(value.log.standard_error > 0))
        why = "no error is stated";
    if (why != NULL) {
        exclude_value(to, &value, why);
        return;
    }
    to->of = array_grow(to->of, to->n, sizeof *to->of);
    to->of[to->n++] = value;
}

/* Infinite if the value is not positive. */
static double positive_log(double value)
{
    return isnan(value) || value > 0 ? log(value) : (double)INFINITY;
}

static wt_status add_case_wear(const collected_case *c, case_value_list *to, wt_error *err)
{
    table_view wear;
    const wt_status status = collected_bind(c, &wear_schema, "", &wear, err);
    if (status != WT_OK)
        return status;
    const wt_estimate k = wear_value(&wear, WEAR_KEY_RATE);
    const double df = wear_value(&wear, WEAR_KEY_RATE_DF).value,
                 reach = k.standard_error * (isnan(df) ? NORMAL_95 : students_t_quantile(df)),
                 error = reach >= k.value ? (double)INFINITY : k.standard_error / k.value;
    add_case_value(
        to,
        (case_value){.constant = SHARED_WEAR, .of = c, .log = {positive_log(k.value), error, df}});
    return WT_OK;
}

/* Components of the variance of the shear stress by category of input files. */
static wt_status find_shear_components(const collected_case *c, double variance,
                                       double parts[INPUT_CATEGORIES], wt_error *err)
{
    table_view table;
    const wt_status status = collected_bind(c, &validation_sources_schema, "", &table, err);
    for (size_t row = 0; status == WT_OK && row < table.n_rows; row++) {
        const double of = validation_sources_get(&table, row, VALIDATION_SOURCES_NEEDED_SHARE);
        const input_category k = input_category_of_source(
            (validation_source)validation_sources_enum(&table, row, VALIDATION_SOURCES_SOURCE));
        if (of > 0 && k < INPUT_CATEGORIES)
            parts[k] += of * variance;
    }
    return status;
}

/* Names the missing errors of the required shear stress. The stated shear stress does not
 * contribute. */
static const char *missing_errors(const collected_case *c)
{
    const char *lacks = friction_key_text(&c->tables.friction, FRICTION_KEY_ERROR_LACKS);
    return friction_key_items(&c->tables.friction, FRICTION_KEY_ERROR_LACKS) ==
                   SCHEMA_BIT(SOURCE_SHEAR_STRESS)
               ? NULL
               : lacks;
}

static wt_status add_shear(const collected_case *c, case_value_list *to, wt_error *err)
{
    table_view record;
    wt_status status = collected_bind(c, &validation_schema, "", &record, err);
    if (status != WT_OK)
        return status;
    const double value = validation_value(&record, VALIDATION_KEY_NEEDED).value,
                 low = validation_value(&record, VALIDATION_KEY_NEEDED_LOW).value,
                 high = validation_value(&record, VALIDATION_KEY_NEEDED_HIGH).value,
                 error = low <= 0 ? (double)INFINITY : log(high / low) / (2 * NORMAL_95);
    case_value v = {.constant = SHARED_SHEAR,
                    .of = c,
                    .log = {positive_log(value), error, (double)NAN},
                    .lacks = missing_errors(c)};
    status = find_shear_components(c, error * error, v.by_files, err);
    if (status == WT_OK)
        add_case_value(to, v);
    return status;
}

/* ---- modulus against rate -------------------------------------------------------------------- */

/* Sums over the curves of a spot, with x = lg rate and y = ln E. */
typedef struct spot_line {
    const char *spot;
    double n, x, y, xx, xy;
} spot_line;

/* Range of the used curves: lg rate, and angular frequency of equal loading. */
typedef struct rate_range {
    double low, high, slow, fast;
} rate_range;

/* Effect of an error of the exponent n of |E*| ~ omega^n on ln E of a fit with the DMA spectrum.
 * The fit takes the modulus at 1/(loading time) over the response to the whole loading. With force
 * ~ depth^m this factor is Gamma(m + 1 - n). The error of n enters ln E by the digamma function.
 * Its largest value is at m = 2 and n = 0 (cones, pyramids). */
static const double per_exponent = 0.9228;

/* Error of n at a frequency, from that of tan delta = tan(pi n / 2) at the nearest point. NaN if no
 * point has one. */
static double exponent_error(const table_view *master, double frequency)
{
    double nearest = (double)INFINITY, error = (double)NAN;
    for (size_t row = 0; row < master->n_rows; row++) {
        const double off = fabs(log(master_curve_get(master, row, MASTER_CURVE_ANGULAR_FREQUENCY) /
                                    frequency)),
                     tan_delta = master_curve_get(master, row, MASTER_CURVE_FITTED_LOSS_FACTOR),
                     wide = master_curve_get(master, row, MASTER_CURVE_FITTED_LOSS_FACTOR_HIGH) -
                            master_curve_get(master, row, MASTER_CURVE_FITTED_LOSS_FACTOR_LOW);
        if (off < nearest && isfinite(wide)) {
            nearest = off;
            error = wide / (2 * NORMAL_95) * M_2_PI / (1 + tan_delta * tan_delta);
        }
    }
    return error;
}

/* Variance of the slope due to the spectrum that all curves share, which the scatter of the spots
 * does not show. 0 without a spectrum or if the result lacks its source; NaN if the spectrum has no
 * errors. At another temperature the frequencies are reduced, with an unknown shift. The largest
 * error is used then. */
static wt_status find_spectrum_variance(const collected_case *c, const table_view *curves,
                                        const rate_range *ends, double *variance, wt_error *err)
{
    table_view master;
    const double temperature =
        indentation_value(curves, INDENTATION_KEY_SPECTRUM_TEMPERATURE).value;
    const wt_status status = collected_bind(c, &master_curve_schema, "", &master, err);
    *variance = 0;
    if (status != WT_OK || isnan(temperature) || master.n_rows == 0 || !(ends->high > ends->low))
        return status;
    const double close = 0.01, /* [K] tolerance of temperatures that were converted between
                                  scales */
        reference = master_curve_value(&master, MASTER_CURVE_KEY_REFERENCE_TEMPERATURE).value;
    double slow = exponent_error(&master, ends->slow), fast = exponent_error(&master, ends->fast);
    if (!(fabs(temperature - reference) < close))
        for (size_t row = 0; row < master.n_rows; row++) {
            const double of = exponent_error(
                &master, master_curve_get(&master, row, MASTER_CURVE_ANGULAR_FREQUENCY));
            slow = fmax(slow, of);
            fast = fmax(fast, of);
        }
    const double error = per_exponent * hypot(slow, fast) / (ends->high - ends->low);
    *variance = error * error;
    return WT_OK;
}

static void extend_rates(rate_range *ends, double rate, double frequency)
{
    if (!(rate > ends->low)) {
        ends->low = rate;
        ends->slow = frequency;
    }
    if (!(rate < ends->high)) {
        ends->high = rate;
        ends->fast = frequency;
    }
}

static void add_curve_to_spot(const table_view *curves, size_t row, spot_line **lines, size_t *n,
                              rate_range *ends)
{
    const char *named = indentation_text(curves, row, INDENTATION_SPOT),
               *spot = named != NULL && named[0] != '\0'
                           ? named
                           : indentation_text(curves, row, INDENTATION_FILE);
    const double x = log10(indentation_get(curves, row, INDENTATION_RATE)),
                 y = log(indentation_get(curves, row, INDENTATION_MODULUS));
    if (spot == NULL || !isfinite(x) || !isfinite(y) ||
        !wt_curve_verdict_is_usable(
            (wt_curve_verdict)indentation_enum(curves, row, INDENTATION_VERDICT)))
        return;
    size_t i = 0;
    while (i < *n && strcmp((*lines)[i].spot, spot) != 0)
        i++;
    if (i == *n) {
        *lines = array_grow(*lines, *n, sizeof **lines);
        (*lines)[(*n)++] = (spot_line){.spot = spot};
    }
    spot_line *l = &(*lines)[i];
    extend_rates(ends, x, 1 / indentation_get(curves, row, INDENTATION_LOAD_TIME));
    l->n += 1;
    l->x += x;
    l->y += y;
    l->xx += x * x;
    l->xy += x * y;
}

/* Mean slope over the spots, which are the units. Each slope is fitted by least squares. A spread
 * of rates below this standard deviation [decade] determines no slope. */
static wt_log_ratio mean_spot_slope(const spot_line *lines, size_t n)
{
    const double least = 0.05;
    double *slope = wt_alloc(n, sizeof *slope);
    size_t known = 0;
    wt_log_ratio of = {(double)NAN, (double)NAN, (double)NAN};
    for (size_t i = 0; i < n; i++) {
        const spot_line *l = &lines[i];
        const double square = l->xx / l->n - l->x / l->n * (l->x / l->n);
        if (square > least * least)
            slope[known++] = (l->xy / l->n - l->x / l->n * (l->y / l->n)) / square;
    }
    if (known > 1) {
        const moments m = sample_moments(slope, known);
        of = (wt_log_ratio){m.mean, sqrt(m.variance / m.n), m.n - 1};
    }
    free(slope);
    return of;
}

static wt_status add_rates(const collected_case *c, const char *group, case_value_list *to,
                           wt_error *err)
{
    table_view curves;
    spot_line *lines = NULL;
    rate_range ends = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    size_t n = 0;
    double variance = 0;
    wt_status status = collected_bind(c, &indentation_schema, group, &curves, err);
    for (size_t row = 0; row < curves.n_rows; row++)
        add_curve_to_spot(&curves, row, &lines, &n, &ends);
    status = find_spectrum_variance(c, &curves, &ends, &variance, err);
    if (status == WT_OK) {
        case_value v = {
            .constant = SHARED_RATE, .of = c, .group = group, .log = mean_spot_slope(lines, n)};
        v.by_files[SHARED_SPECTRUM] = isnan(variance) ? 0 : variance;
        if (isnan(variance))
            v.log.standard_error = (double)NAN;
        else if (variance > 0) {
            const t_error all =
                t_error_add_normal((t_error){v.log.standard_error, v.log.df}, variance);
            v.log.standard_error = all.error;
            v.log.df = all.df;
        }
        add_case_value(to, v);
    }
    free(lines);
    return status;
}

wt_status shared_values_read(const collected_case *cases, size_t n, case_value_list *to,
                             wt_error *err)
{
    static const char *const groups[] = {"bulk", "track"};
    wt_status status = WT_OK;
    *to = (case_value_list){.n = 0};
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = add_case_wear(&cases[i], to, err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = add_shear(&cases[i], to, err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        for (size_t g = 0; status == WT_OK && g < COUNT_OF(groups); g++)
            status = add_rates(&cases[i], groups[g], to, err);
    return status;
}
