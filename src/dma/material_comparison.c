/* The job that compares materials: common ranges, moduli and ratios.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/material_comparison.h"
#include "core/base/shared_params.h"
#include "job/inputs.h"

#include "core/base/clocale.h"
#include "core/base/number.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { Q = MATERIALS_QUANTITIES };
/* Points of the comparison: six per width of a relaxation time (1.14 decades), up to 50 decades,
 * and 25 temperatures. A finer grid does not find further differences. */
enum { PER_DECADE = 6, MAX_POINTS = 300, TEMPERATURES = 25 };

/* A material without a shift law is used within 1 K of its reference. A chamber is no more
 * stable. */
static const double same_temperature = 1;
static const double ten_hertz =
    20 * M_PI; /* default frequency of the comparison over temperature [rad/s] */

wt_materials_job wt_materials_job_defaults(void)
{
    return (wt_materials_job){.temperature = (double)NAN, .frequency = (double)NAN, .margin = 0.2};
}

static const wt_param rows[] = {
    {PARAM("at-temperature", wt_materials_job, temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .value = "T", .unset = "the reference temperature of the first, if all were measured there",
     .help = "of materials: where they are compared over frequency"},
    {PARAM("at-frequency", wt_materials_job, frequency, WT_Q_ANGULAR_FREQUENCY, ABOVE(0)),
     .value = "F", .unset = "10 Hz, if all were measured there",
     .help = "of materials: where they are compared over temperature, such as 10Hz or 63rad/s"},
    {PARAM("sample-error", wt_materials_job, sample_error, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X",
     .help = "relative standard error of a modulus by the dimensions of its sample, such as 0.05; "
             "it enters the ratios of moduli, not that of tan delta"},
    EQUIVALENCE_MARGIN(wt_materials_job),
};
PARAM_TABLE(wt_materials_job_params, wt_materials_job, rows, wt_materials_job_defaults, NO_PARTS)

void wt_materials_tables_clear(wt_materials_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->materials);
    wt_table_free(tables->material_ratio);
    *tables = (wt_materials_tables){0};
}

/* ---- common ranges --------------------------------------------------------------------------- */

typedef struct range {
    double low, high;
} range;

static range range_intersection(range a, range b)
{
    return (range){fmax(a.low, b.low), fmin(a.high, b.high)};
}

static bool range_contains(range r, double x)
{
    return x >= r.low && x <= r.high;
}

/* Returns the measured temperature range [K]. A law without isotherms has no limits. */
static range measured_temperatures(const wt_rubber *rubber)
{
    const double reference = rubber->prony.reference_temperature;
    if (rubber->law.kind == WT_LAW_NONE)
        return (range){reference - same_temperature, reference + same_temperature};
    if (isnan(rubber->temperature_min))
        return (range){0, (double)INFINITY};
    return (range){rubber->temperature_min, rubber->temperature_max};
}

/* Returns the measured frequency range at a temperature [rad/s]. An unknown limit is 0 or
 * infinity. */
static wt_status measured_frequencies(const wt_rubber *rubber, double temperature, range *r,
                                      wt_error *err)
{
    wt_material *material = NULL;
    const wt_status status =
        wt_rubber_material(rubber, temperature, 1, WT_NO_REPLICATE, &material, NULL, err);
    if (status != WT_OK)
        return status;
    *r = (range){isnan(material->frequency_min) ? 0 : material->frequency_min,
                 isnan(material->frequency_max) ? (double)INFINITY : material->frequency_max};
    wt_material_free(material);
    return WT_OK;
}

static wt_status fail_no_common_temperature(const wt_materials_job *job, wt_error *err)
{
    char found[256] = "";
    for (size_t i = 0; i < job->n_materials; i++) {
        const range r = measured_temperatures(job->materials[i].rubber);
        clocale_append(found, sizeof found, "%s%s: %.1f to %.1f °C", i > 0 ? "; " : "",
                       job->materials[i].name, r.low - WT_ZERO_CELSIUS, r.high - WT_ZERO_CELSIUS);
    }
    wt_fail(err, WT_E_RANGE, "the materials have no temperature in common");
    wt_error_found(err, "%s", found);
    wt_error_advice(err, "measure both at one temperature; isotherms at several give a shift law, "
                         "which takes a material to the temperature of the other");
    return WT_E_RANGE;
}

typedef struct comparison_conditions {
    range temperature;
    double at_temperature, at_frequency; /* [K], [rad/s]; frequency NaN: not yet chosen */
} comparison_conditions;

static wt_status find_comparison_temperature(const wt_materials_job *job, comparison_conditions *s,
                                             wt_error *err)
{
    const double reference = job->materials[0].rubber->prony.reference_temperature;
    s->temperature = (range){0, (double)INFINITY};
    for (size_t i = 0; i < job->n_materials; i++) {
        const wt_compared_material *m = &job->materials[i];
        if (isnan(m->rubber->prony.reference_temperature)) {
            wt_fail(err, WT_E_MISSING, "the temperature of the material is not known");
            wt_error_file(err, m->name);
            wt_error_advice(err, "--temperature says it");
            wt_error_options(err, "temperature");
            return WT_E_MISSING;
        }
        s->temperature = range_intersection(s->temperature, measured_temperatures(m->rubber));
    }
    const range r = s->temperature;
    if (!(r.low <= r.high))
        return fail_no_common_temperature(job, err);
    s->at_temperature = !isnan(job->temperature)       ? job->temperature
                        : range_contains(r, reference) ? reference
                                                       : (r.low + r.high) / 2;
    if (range_contains(r, s->at_temperature))
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "not all materials were measured at the at-temperature");
    wt_error_expected(err, "%.1f to %.1f °C", r.low - WT_ZERO_CELSIUS, r.high - WT_ZERO_CELSIUS);
    wt_error_found(err, "%.1f °C", s->at_temperature - WT_ZERO_CELSIUS);
    return WT_E_RANGE;
}

/* Chooses the frequency of the comparison over temperature: 10 Hz, if all materials were measured
 * there at the temperature of the comparison, else the middle of their common range. It stays NaN
 * without one. */
static wt_status find_comparison_frequency(const wt_materials_job *job, comparison_conditions *s,
                                           wt_error *err)
{
    range shared = {0, (double)INFINITY};
    wt_status status = WT_OK;
    s->at_frequency = job->frequency;
    for (size_t i = 0; status == WT_OK && isnan(job->frequency) && i < job->n_materials; i++) {
        range own = {0, 0};
        status = measured_frequencies(job->materials[i].rubber, s->at_temperature, &own, err);
        shared = range_intersection(shared, own);
    }
    if (status == WT_OK && isnan(job->frequency) && shared.low > 0 && shared.low <= shared.high &&
        isfinite(shared.high))
        s->at_frequency =
            range_contains(shared, ten_hertz) ? ten_hertz : sqrt(shared.low * shared.high);
    return status;
}

static wt_status fail_no_common_frequency(const wt_compared_material pair[2], const range own[2],
                                          double temperature, wt_error *err)
{
    wt_fail(err, WT_E_RANGE, "the materials have no frequency in common at %.1f °C",
            temperature - WT_ZERO_CELSIUS);
    wt_error_found(err, "%s: %s rad/s; %s: %s rad/s", pair[0].name,
                   format_range(own[0].low, own[0].high, 3).text, pair[1].name,
                   format_range(own[1].low, own[1].high, 3).text);
    wt_error_advice(err, "compare them at another temperature (at-temperature), or measure at more "
                         "temperatures");
    return WT_E_RANGE;
}

/* Fails because no temperature has the requested frequency in both materials. */
static wt_status fail_frequency_not_measured(const wt_compared_material pair[2], const range own[2],
                                             const comparison_conditions *s, wt_error *err)
{
    const range t = s->temperature;
    const bool one = !(t.high - t.low > 2 * same_temperature);
    wt_fail(err, WT_E_RANGE,
            one ? "materials are compared over temperature where both were measured at several"
                : "the materials were not both measured at the at-frequency");
    wt_error_place(err, "at-frequency");
    wt_error_found(err, "%.3g rad/s; at %.1f °C %s: %s rad/s; %s: %s rad/s", s->at_frequency,
                   s->at_temperature - WT_ZERO_CELSIUS, pair[0].name,
                   format_range(own[0].low, own[0].high, 3).text, pair[1].name,
                   format_range(own[1].low, own[1].high, 3).text);
    wt_error_advice(err, one ? "leave it out" : "choose one that both have at some temperature");
    return WT_E_RANGE;
}

/* ---- points of comparison -------------------------------------------------------------------- */

/* Fills PER_DECADE points per decade of a range, including its limits. Returns their number. */
static size_t list_frequency_points(range r, double temperature, comparison_point point[MAX_POINTS])
{
    const double decades = log10(r.high / r.low);
    const double wanted = ceil(decades * PER_DECADE) + 1;
    const size_t n = wanted < 2 ? 2 : wanted > MAX_POINTS ? MAX_POINTS : (size_t)wanted;
    for (size_t i = 0; i < n; i++)
        point[i] =
            (comparison_point){temperature, r.low * pow(10, decades * (double)i / (double)(n - 1))};
    return n;
}

/* Fills the temperatures of the common range at which both materials have the frequency. */
static wt_status list_temperature_points(const wt_compared_material pair[2],
                                         const comparison_conditions *s, double frequency,
                                         comparison_point point[TEMPERATURES], size_t *n,
                                         wt_error *err)
{
    const range r = s->temperature;
    *n = 0;
    if (!isfinite(r.low + r.high) || !(r.high - r.low > 2 * same_temperature))
        return WT_OK;
    for (size_t i = 0; i < TEMPERATURES; i++) {
        const double t = r.low + (r.high - r.low) * (double)i / (TEMPERATURES - 1);
        range own[2] = {{0, 0}, {0, 0}};
        for (int k = 0; k < 2; k++) {
            const wt_status status = measured_frequencies(pair[k].rubber, t, &own[k], err);
            if (status != WT_OK)
                return status;
        }
        if (range_contains(range_intersection(own[0], own[1]), frequency))
            point[(*n)++] = (comparison_point){t, frequency};
    }
    return WT_OK;
}

/* ---- systematic errors ----------------------------------------------------------------------- */

/* Finds the errors that the draws do not contain. If superposition fails, the spectrum deviates
 * from the isotherms by its misfit. E'' also deviates by the Kramers-Kronig inconsistency. */
static wt_status find_systematic_errors(const wt_compared_material *m, double sample_error,
                                        material_systematic_errors *b, wt_error *err)
{
    table_view view;
    *b = (material_systematic_errors){.sample = {sample_error, sample_error, 0}};
    if (m->shift_factors == NULL)
        return WT_OK;
    const wt_status status = table_bind(m->shift_factors, &shift_factors_schema, "", &view, err);
    if (status != WT_OK)
        return status;
    const wt_superposition state =
        (wt_superposition)shift_factors_key_enum(&view, SHIFT_FACTORS_KEY_SUPERPOSITION);
    const char *high = shift_factors_key_text(&view, SHIFT_FACTORS_KEY_MISFIT_HIGH);
    double misfit = 0;
    if (state == WT_SUPERPOSITION_HOLDS || high == NULL ||
        !wt_number_parse(high, strlen(high), '.', &misfit) || !isfinite(misfit))
        return WT_OK;
    const double factor = shift_factors_value(&view, SHIFT_FACTORS_KEY_LOSS_FACTOR).value;
    const double loss = hypot(misfit, factor > 0 ? log(factor) : 0);
    b->misfit[MATERIALS_E1] = misfit;
    b->misfit[MATERIALS_E2] = b->misfit[MATERIALS_TAN] = loss;
    return WT_OK;
}

/* ---- tables ---------------------------------------------------------------------------------- */

TABLE_ROW(materials, MATERIALS, const char *material; double angular_frequency;
          wt_interval storage, loss, factor;)

TABLE_ROW(material_ratio, MATERIAL_RATIO, const char *material, *over;
          double temperature, angular_frequency; wt_interval storage, loss, factor;)

TABLE_KEYS(material_ratio, MATERIAL_RATIO, const char *differs, *settled_by, *first_material,
           *outside;
           double temperature, angular_frequency, margin; char includes[160], lacks[160];)

static wt_interval exp_interval(double ln, double error)
{
    return (wt_interval){exp(ln), (double)NAN, exp(ln - NORMAL_95 * error),
                         exp(ln + NORMAL_95 * error)};
}

static wt_status add_material_rows(const wt_compared_material *m,
                                   const material_systematic_errors *systematic, double temperature,
                                   const wt_job *work, table_writer *t, wt_error *err)
{
    comparison_point point[MAX_POINTS];
    material_values v = {0};
    range own;
    wt_status status = measured_frequencies(m->rubber, temperature, &own, err);
    if (status != WT_OK || !(own.low > 0) || !isfinite(own.high))
        return status; /* a material without a known range is an error in the comparison only */
    const size_t n = list_frequency_points(own, temperature, point);
    status = material_values_compute(m->rubber, systematic, point, n, work, &v, err);
    table_block(t);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        const double *x = v.value + i * Q, *e = v.error + i * Q;
        TABLE_ADD(materials, t, m->name, point[i].frequency,
                  exp_interval(x[MATERIALS_E1], e[MATERIALS_E1]),
                  exp_interval(x[MATERIALS_E2], e[MATERIALS_E2]),
                  exp_interval(x[MATERIALS_TAN], e[MATERIALS_TAN]));
    }
    material_values_clear(&v);
    return status;
}

static void add_material_ratio_rows(table_writer *t, const char *name, const char *over,
                                    const comparison_point *point, const material_ratio *r,
                                    size_t first, size_t last)
{
    if (first < last)
        table_block(t);
    for (size_t i = first; i < last; i++) {
        const double *x = r->value + i * Q, *e = r->error + i * Q;
        TABLE_ADD(material_ratio, t, name, over, point[i].temperature, point[i].frequency,
                  exp_interval(x[MATERIALS_E1], e[MATERIALS_E1]),
                  exp_interval(x[MATERIALS_E2], e[MATERIALS_E2]),
                  exp_interval(x[MATERIALS_TAN], e[MATERIALS_TAN]));
    }
}

/* ---- texts ----------------------------------------------------------------------------------- */

/* Verdict texts of all pairs. */
typedef struct verdict_texts {
    char differs[1024], settled_by[640], outside[640];
    bool errors_known, misfit; /* true if some interval is known; true if one contains a misfit */
} verdict_texts;

/* Appends a formatted text, after "; " unless it is the first. */
static void append_item(char *text, size_t size, const char *format, ...) WT_PRINTF(3, 4);
static void append_item(char *text, size_t size, const char *format, ...)
{
    va_list arguments;
    clocale_append(text, size, "%s", text[0] != '\0' ? "; " : "");
    const size_t used = strlen(text);
    va_start(arguments, format);
    clocale_vprint(text + used, size - used, format, arguments);
    va_end(arguments);
}

/* States why a pair has no rows over temperature, if the common temperatures are a range. */
static void append_missing_temperatures(const wt_compared_material *m,
                                        const comparison_conditions *set, verdict_texts *s)
{
    const range r = set->temperature;
    if (!isfinite(r.low + r.high) || !(r.high - r.low > 2 * same_temperature))
        return;
    if (isnan(set->at_frequency))
        append_item(s->outside, sizeof s->outside,
                    "%s over temperature: the materials have no frequency in common", m->name);
    else
        append_item(s->outside, sizeof s->outside,
                    "%s over temperature: not measured at %.3g rad/s", m->name, set->at_frequency);
}

/* Lists the frequencies that only one material has, if they are a fifth of a decade or more. */
static void append_unshared_frequencies(const wt_compared_material *m, range own, range shared,
                                        double temperature, verdict_texts *s)
{
    const double at = temperature - WT_ZERO_CELSIUS;
    if (own.low < shared.low / 1.6 && own.low > 0)
        append_item(s->outside, sizeof s->outside, "%s below %.2g rad/s at %.1f °C", m->name,
                    shared.low, at);
    if (own.high > shared.high * 1.6 && isfinite(own.high))
        append_item(s->outside, sizeof s->outside, "%s above %.2g rad/s at %.1f °C", m->name,
                    shared.high, at);
}

static void append_unshared_temperatures(const wt_materials_job *job,
                                         const comparison_conditions *set, verdict_texts *s)
{
    const range r = set->temperature;
    for (size_t i = 0; i < job->n_materials; i++) {
        const wt_compared_material *m = &job->materials[i];
        const range own = measured_temperatures(m->rubber);
        const bool law = m->rubber->law.kind != WT_LAW_NONE;
        if (!law)
            append_item(s->outside, sizeof s->outside,
                        "%s has no shift law: all are compared at its temperature only", m->name);
        if (law && isfinite(own.high) && own.low < r.low - same_temperature)
            append_item(s->outside, sizeof s->outside, "%s below %.1f °C", m->name,
                        r.low - WT_ZERO_CELSIUS);
        if (law && isfinite(own.high) && own.high > r.high + same_temperature)
            append_item(s->outside, sizeof s->outside, "%s above %.1f °C", m->name,
                        r.high - WT_ZERO_CELSIUS);
    }
}

/* ---- the job --------------------------------------------------------------------------------- */

/* Compares a material with the first one. */
static wt_status compare_pair(const wt_materials_job *job, const wt_compared_material pair[2],
                              const material_systematic_errors systematic[2], const wt_job *work,
                              const comparison_conditions *s, table_writer *t, verdict_texts *texts,
                              wt_error *err)
{
    comparison_point point[MAX_POINTS + TEMPERATURES];
    material_values values[2] = {{0}, {0}};
    range own[2] = {{0, 0}, {0, 0}};
    size_t n_temperatures = 0;
    wt_status status = WT_OK;
    for (int k = 0; status == WT_OK && k < 2; k++)
        status = measured_frequencies(pair[k].rubber, s->at_temperature, &own[k], err);
    if (status != WT_OK)
        return status;
    const range shared = range_intersection(own[0], own[1]);
    if (!(shared.low > 0 && shared.low < shared.high && isfinite(shared.high)))
        return fail_no_common_frequency(pair, own, s->at_temperature, err);
    const size_t n = list_frequency_points(shared, s->at_temperature, point);
    status = list_temperature_points(pair, s, s->at_frequency, point + n, &n_temperatures, err);
    if (status == WT_OK && n_temperatures == 0 && !isnan(job->frequency))
        status = fail_frequency_not_measured(pair, own, s, err);
    for (int k = 0; status == WT_OK && k < 2; k++)
        status = material_values_compute(pair[k].rubber, &systematic[k], point, n + n_temperatures,
                                         work, &values[k], err);
    if (status == WT_OK) {
        material_ratio ratio = material_ratio_compute(&values[0], &values[1]);
        add_material_ratio_rows(t, pair[1].name, "frequency", point, &ratio, 0, n);
        add_material_ratio_rows(t, pair[1].name, "temperature", point, &ratio, n,
                                n + n_temperatures);
        const material_verdict v = material_assess(pair, values, systematic, &ratio, job->margin);
        append_item(texts->differs, sizeof texts->differs, "%s", v.differs);
        if (v.settled_by[0] != '\0')
            append_item(texts->settled_by, sizeof texts->settled_by, "%s", v.settled_by);
        texts->errors_known = texts->errors_known || ratio.errors_known;
        if (n_temperatures == 0)
            append_missing_temperatures(&pair[1], s, texts);
        append_unshared_frequencies(&pair[0], own[0], shared, s->at_temperature, texts);
        append_unshared_frequencies(&pair[1], own[1], shared, s->at_temperature, texts);
        material_ratio_clear(&ratio);
    }
    material_values_clear(&values[0]);
    material_values_clear(&values[1]);
    return status;
}

static void set_ratio_keys(const wt_materials_job *job, const comparison_conditions *s,
                           const verdict_texts *texts, table_writer *t)
{
    material_ratio_keys keys = {texts->differs,
                                texts->settled_by,
                                job->materials[0].name,
                                texts->outside,
                                s->at_temperature,
                                s->at_frequency,
                                job->margin,
                                "",
                                ""};
    const bool sizes = job->sample_error > 0;
    if (texts->errors_known) {
        clocale_print(keys.includes, sizeof keys.includes,
                      "noise of the isotherms, shifts and their law%s%s",
                      texts->misfit ? ", misfit of superposition" : "",
                      sizes ? ", dimensions of the samples" : "");
        clocale_print(keys.lacks, sizeof keys.lacks, "other samples of the same materials%s",
                      sizes ? ""
                            : "; dimensions of these (sample-error), which do not act on "
                              "tan delta");
    }
    material_ratio_set_keys(t, &keys);
}

static void warn_deformation(const wt_materials_job *job, const wt_job *work)
{
    const wt_compared_material *first = &job->materials[0];
    for (size_t i = 1; i < job->n_materials; i++) {
        const wt_compared_material *m = &job->materials[i];
        if (m->rubber->prony.deformation != first->rubber->prony.deformation)
            wt_log_add(work->log, WT_WARNING, m->name, NULL,
                       "one of %s and %s was measured in shear and the other in tension: E = "
                       "2 (1 + %g) G, and what that is off by the ratio of moduli is off by",
                       first->name, m->name, m->rubber->poisson_ratio);
    }
}

static wt_status build_comparison_tables(const wt_materials_job *job, const wt_job *work,
                                         wt_materials_tables *tables, wt_error *err)
{
    comparison_conditions s = {0};
    verdict_texts texts = {.errors_known = false};
    material_systematic_errors first;
    wt_status status = find_comparison_temperature(job, &s, err);
    if (status == WT_OK)
        status = find_comparison_frequency(job, &s, err);
    if (status == WT_OK)
        status = find_systematic_errors(&job->materials[0], job->sample_error, &first, err);
    if (status != WT_OK)
        return status;
    append_unshared_temperatures(job, &s, &texts);
    table_writer curves = table_begin(&materials_schema, err),
                 ratios = table_begin(&material_ratio_schema, err);
    for (size_t i = 0; status == WT_OK && i < job->n_materials; i++) {
        const wt_compared_material pair[2] = {job->materials[0], job->materials[i]};
        material_systematic_errors systematic[2] = {first, first};
        status = find_systematic_errors(&pair[1], job->sample_error, &systematic[1], err);
        texts.misfit = texts.misfit || systematic[1].misfit[MATERIALS_E1] > 0;
        if (status == WT_OK)
            status =
                add_material_rows(&pair[1], &systematic[1], s.at_temperature, work, &curves, err);
        if (status == WT_OK && i > 0)
            status = compare_pair(job, pair, systematic, work, &s, &ratios, &texts, err);
    }
    materials_set_value(&curves, MATERIALS_KEY_TEMPERATURE, s.at_temperature, 0, 0);
    set_ratio_keys(job, &s, &texts, &ratios);
    const wt_status one = table_end(&curves, &tables->materials),
                    other = table_end(&ratios, &tables->material_ratio);
    return status != WT_OK ? status : one != WT_OK ? one : other;
}

wt_status wt_compare_materials(const wt_materials_job *job, const wt_job *work,
                               wt_materials_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL || job->materials == NULL ||
        job->n_materials < 2)
        return wt_fail(err, WT_E_ARG, "two materials or more are needed");
    wt_materials_tables t = {0};
    wt_status status = param_check(wt_materials_job_params(), job, err);
    if (status == WT_OK)
        status = build_comparison_tables(job, work, &t, err);
    if (status == WT_OK) {
        warn_deformation(job, work);
        *tables = t;
        return WT_OK;
    }
    wt_materials_tables_clear(&t);
    return status;
}
