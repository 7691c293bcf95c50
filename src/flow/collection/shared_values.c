/* What each case tells of the constants that cases may have in common: the specific wear rate as
 * measured, the shear stress that its record asks for, and the factor of its moduli over a decade
 * of the indentation rate. SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/collection/collect.h"

#include "base/array.h"
#include "base/normal.h"
#include "data/tables/tables.h"
#include "fit/students_t.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static wt_status bind(const collected_case *c, const table_schema *schema, const char *suffix,
                      table_view *view, wt_error *err)
{
    const wt_status status = table_bind_of(c->result, schema, suffix, view, err);
    if (status != WT_OK)
        wt_error_file(err, c->file);
    return status;
}

const char *const shared_words[SHARED_N] = {[SHARED_WEAR] = "specific wear rate",
                                            [SHARED_SHEAR] = "shear stress",
                                            [SHARED_RATE] = "modulus over a decade of rate"};

void shared_name(const case_value *v, char *text, size_t size)
{
    snprintf(text, size, "%s%s%s%s%s", v->of->sample, v->of->condition[0] != '\0' ? ", " : "",
             v->of->condition, v->group != NULL ? ", " : "", v->group != NULL ? v->group : "");
}

static void leave_out(case_values *from, const case_value *v)
{
    char name[256];
    const size_t used = strlen(from->left_out);
    shared_name(v, name, sizeof name);
    const int length = snprintf(NULL, 0, "; %s of %s", shared_words[v->constant], name);
    if (from->unnamed > 0 || used + (size_t)length >= sizeof from->left_out)
        from->unnamed++;
    else
        snprintf(from->left_out + used, sizeof from->left_out - used, "%s%s of %s",
                 used > 0 ? "; " : "", shared_words[v->constant], name);
}

/* One without an error tells nothing of what is common, nor does one whose interval reaches 0. */
static wt_status add_value(case_values *to, case_value value, wt_error *err)
{
    if (!isfinite(value.log.value))
        return WT_OK;
    if (!(value.log.standard_error > 0) || !isfinite(value.log.standard_error)) {
        leave_out(to, &value);
        return WT_OK;
    }
    case_value *grown = array_grow(to->of, to->n, sizeof *grown);
    if (grown == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    to->of = grown;
    grown[to->n++] = value;
    return WT_OK;
}

static wt_status add_wear(const collected_case *c, case_values *to, wt_error *err)
{
    table_view wear;
    const wt_status status = bind(c, &wear_schema, "", &wear, err);
    if (status != WT_OK)
        return status;
    const wt_estimate k = wear_value(&wear, WEAR_KEY_RATE);
    return add_value(to,
                     (case_value){.constant = SHARED_WEAR,
                                  .of = c,
                                  .log = {log(k.value), k.standard_error / k.value, (double)NAN}},
                     err);
}

/* Of the variance of the shear stress the share that the DMA and the scans have. */
static wt_status material_share(const collected_case *c, double *share, wt_error *err)
{
    table_view sources;
    const wt_status status = bind(c, &validation_sources_schema, "", &sources, err);
    *share = 0;
    for (size_t row = 0; status == WT_OK && row < sources.n_rows; row++) {
        const double of = validation_sources_get(&sources, row, VALIDATION_SOURCES_NEEDED_SHARE);
        if (of > 0 && strncmp(validation_sources_text(&sources, row, VALIDATION_SOURCES_SOURCE),
                              VALIDATION_OF_MATERIAL, strlen(VALIDATION_OF_MATERIAL)) == 0)
            *share += of;
    }
    return status;
}

/* An interval that reaches 0 has no logarithm. */
static wt_status add_shear(const collected_case *c, case_values *to, wt_error *err)
{
    table_view record;
    double share = 0;
    wt_status status = bind(c, &validation_schema, "", &record, err);
    if (status == WT_OK)
        status = material_share(c, &share, err);
    if (status != WT_OK)
        return status;
    const double value = validation_value(&record, VALIDATION_KEY_NEEDED).value,
                 low = validation_value(&record, VALIDATION_KEY_NEEDED_LOW).value,
                 high = validation_value(&record, VALIDATION_KEY_NEEDED_HIGH).value,
                 error = low > 0 ? log(high / low) / (2 * NORMAL_95) : (double)NAN;
    return add_value(to,
                     (case_value){.constant = SHARED_SHEAR,
                                  .of = c,
                                  .log = {log(value), error, (double)NAN},
                                  .material = error * error * share},
                     err);
}

/* ---- moduli against rate --------------------------------------------------------------------- */

/* Sums over the curves of a spot, of x = lg rate and y = ln E. */
typedef struct spot_line {
    const char *spot;
    double n, x, y, xx, xy;
} spot_line;

static const char *spot_of(const table_view *curves, size_t row)
{
    const char *spot = indentation_text(curves, row, INDENTATION_SPOT);
    return spot != NULL && spot[0] != '\0' ? spot : indentation_text(curves, row, INDENTATION_FILE);
}

static wt_status add_curve(const table_view *curves, size_t row, spot_line **lines, size_t *n,
                           wt_error *err)
{
    const char *spot = spot_of(curves, row),
               *verdict = indentation_text(curves, row, INDENTATION_VERDICT);
    const double x = log10(indentation_get(curves, row, INDENTATION_RATE)),
                 y = log(indentation_get(curves, row, INDENTATION_MODULUS));
    if (spot == NULL || !isfinite(x) || !isfinite(y) ||
        (strcmp(verdict, "accepted") != 0 && strcmp(verdict, "doubtful") != 0))
        return WT_OK;
    size_t i = 0;
    while (i < *n && strcmp((*lines)[i].spot, spot) != 0)
        i++;
    if (i == *n) {
        spot_line *grown = array_grow(*lines, *n, sizeof *grown);
        if (grown == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        *lines = grown;
        grown[(*n)++] = (spot_line){.spot = spot};
    }
    spot_line *l = &(*lines)[i];
    l->n += 1;
    l->x += x;
    l->y += y;
    l->xx += x * x;
    l->xy += x * y;
    return WT_OK;
}

/* The spots are the units: the line of each by least squares, and how these scatter. Rates that
 * differ by less than this (decades, standard deviation) make no line. */
static wt_log_ratio slope_of(const spot_line *lines, size_t n)
{
    const double least = 0.05;
    double *slope = malloc((n + 1) * sizeof *slope);
    size_t known = 0;
    wt_log_ratio of = {(double)NAN, (double)NAN, (double)NAN};
    for (size_t i = 0; slope != NULL && i < n; i++) {
        const spot_line *l = &lines[i];
        const double square = l->xx / l->n - l->x / l->n * (l->x / l->n);
        if (square > least * least)
            slope[known++] = (l->xy / l->n - l->x / l->n * (l->y / l->n)) / square;
    }
    if (known > 1) {
        const moments m = moments_of(slope, known);
        of = (wt_log_ratio){m.mean, sqrt(m.variance / m.n), m.n - 1};
    }
    free(slope);
    return of;
}

static wt_status add_rates(const collected_case *c, const char *group, case_values *to,
                           wt_error *err)
{
    table_view curves;
    spot_line *lines = NULL;
    size_t n = 0;
    wt_status status = bind(c, &indentation_schema, group, &curves, err);
    for (size_t row = 0; status == WT_OK && row < curves.n_rows; row++)
        status = add_curve(&curves, row, &lines, &n, err);
    if (status == WT_OK)
        status = add_value(
            to,
            (case_value){
                .constant = SHARED_RATE, .of = c, .group = group, .log = slope_of(lines, n)},
            err);
    free(lines);
    return status;
}

/* ---- files in common ------------------------------------------------------------------------- */

static bool has_input(const table_view *inputs, const char *role, const char *sha256)
{
    for (size_t row = 0; row < inputs->n_rows; row++)
        if (strcmp(inputs_text(inputs, row, INPUTS_ROLE), role) == 0 &&
            strcmp(inputs_text(inputs, row, INPUTS_SHA256), sha256) == 0)
            return true;
    return false;
}

/* Files of some roles: all, those that the other case has, too, and those without a digest, of
 * which that is not known. */
typedef struct input_count {
    size_t all, common, unknown;
} input_count;

static void count_inputs(const table_view *a, const table_view *b, const char *role,
                         input_count *to)
{
    for (size_t row = 0; row < a->n_rows; row++) {
        const char *sha256 = inputs_text(a, row, INPUTS_SHA256);
        if (strcmp(inputs_text(a, row, INPUTS_ROLE), role) != 0)
            continue;
        to->all++;
        to->unknown += sha256[0] == '\0';
        to->common += sha256[0] != '\0' && has_input(b, role, sha256);
    }
}

static bool inputs_of(const collected_case *c, table_view *inputs)
{
    return table_bind_of(c->result, &inputs_schema, "", inputs, NULL) == WT_OK;
}

static input_count in_common(const collected_case *a, const collected_case *b,
                             const char *const *roles, size_t n_roles)
{
    table_view of_a, of_b;
    input_count count = {0, 0, 0};
    if (!inputs_of(a, &of_a) || !inputs_of(b, &of_b))
        return count;
    for (size_t i = 0; i < n_roles; i++) {
        count_inputs(&of_a, &of_b, roles[i], &count);
        count_inputs(&of_b, &of_a, roles[i], &count);
    }
    return count;
}

double shared_covariance(const case_value *a, const case_value *b, bool sure)
{
    static const char *const roles[] = {"dma", "material", "topography", "roughness"};
    const double most = sqrt(a->material * b->material);
    if (!(most > 0))
        return 0;
    const input_count files = in_common(a->of, b->of, roles, COUNT_OF(roles));
    const bool common =
        sure ? files.all > 0 && files.common == files.all : files.common > 0 || files.unknown > 0;
    return common ? most : 0;
}

/* Curves that an earlier case has, too, count once. */
static bool counts_already(const collected_case *cases, size_t i, const char *group)
{
    for (size_t k = 0; k < i; k++)
        if (in_common(&cases[k], &cases[i], &group, 1).common > 0)
            return true;
    return false;
}

wt_status shared_values_of(const collected_case *cases, size_t n, case_values *to, wt_error *err)
{
    static const char *const groups[] = {"bulk", "track"};
    wt_status status = WT_OK;
    *to = (case_values){.n = 0};
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = add_wear(&cases[i], to, err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        status = add_shear(&cases[i], to, err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        for (size_t g = 0; status == WT_OK && g < COUNT_OF(groups); g++)
            if (!counts_already(cases, i, groups[g]))
                status = add_rates(&cases[i], groups[g], to, err);
    return status;
}
