/* Error budget: standard errors with one drawn source at a time, the numerical error, the error due
 * to the number of replicates, and the range over the model choices.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/rubber.h"
#include "job/cost.h"
#include "study/case_override.h"
#include "weartrack/study.h"

#include "core/base/array.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- measured or stated sources -------------------------------------------------------------- */

typedef struct source {
    const char *words, *remedy;
    bool (*applies)(const case_variant *s);
    bool (*stated)(const case_variant *s);
    void (*hold)(case_variant *s); /* removes the error of the source */
    size_t member; /* offset of the estimate whose error it is, where both functions are NULL */
} source;

static wt_estimate *source_estimate(const source *of, case_variant *s)
{
    return (wt_estimate *)(void *)((char *)s + of->member);
}

static bool is_stated(const source *of, case_variant *s)
{
    return of->stated != NULL ? of->stated(s) : source_estimate(of, s)->standard_error > 0;
}

static void hold_source(const source *of, case_variant *s)
{
    if (of->hold != NULL)
        of->hold(s);
    else
        source_estimate(of, s)->standard_error = 0;
}

static bool is_always_applicable(const case_variant *s)
{
    (void)s;
    return true;
}

static bool is_stated_rubber(const case_variant *s)
{
    return s->rubber.n_draws > 0 || s->rubber.c1_error > 0 || s->rubber.c2_error > 0;
}

static void fix_rubber(case_variant *s)
{
    s->given = NULL;
    s->rubber.n_draws = 0;
    s->rubber.c1_error = s->rubber.c2_error = 0;
}

/* Stated error of the density, or scatter of a measured surface over sites, modes and law. */
static bool is_stated_roughness(const case_variant *s)
{
    return s->surface.c0.standard_error > 0 || s->surface.modes_error != NULL;
}

static void fix_roughness(case_variant *s)
{
    s->surface.c0.standard_error = 0;
    s->surface.modes_error = s->surface.law_error = s->surface.position_errors = NULL;
    s->surface.n_sizes = 0;
}

/* Scatter of the spots and calibration are components of one variance. */
static bool is_stated_ratio(const case_variant *s)
{
    return s->layer_observation.modulus_ratio.standard_error > 0 &&
           s->layer_observation.calibration_share < 1;
}

static void fix_ratio(case_variant *s)
{
    s->layer_observation.modulus_ratio.standard_error *=
        sqrt(s->layer_observation.calibration_share);
    s->layer_observation.calibration_share = 1;
}

static bool is_stated_calibration(const case_variant *s)
{
    return s->layer_observation.modulus_ratio.standard_error > 0;
}

static void fix_calibration(case_variant *s)
{
    s->layer_observation.modulus_ratio.standard_error *=
        sqrt(1 - s->layer_observation.calibration_share);
    s->layer_observation.calibration_share = 0;
}

static bool has_softness(const case_variant *s)
{
    return s->has_softness;
}

static bool is_stated_softness(const case_variant *s)
{
    return s->has_softness && strain_softening_has_errors(&s->strain_softening);
}

static void fix_strain_softening(case_variant *s)
{
    s->strain_softening.storage_error = s->strain_softening.loss_error = NULL;
}

static bool has_shear_stress(const case_variant *s)
{
    return !isnan(s->sliding.shear_stress.value);
}

static bool has_layer(const case_variant *s)
{
    return s->has_layer;
}

static bool has_critical_energy(const case_variant *s)
{
    return s->has_layer && !isnan(s->layer.critical_energy.value);
}

static bool has_observed(const case_variant *s)
{
    return s->has_layer && !isnan(s->layer.observed_thickness.value);
}

static bool has_thickness(const case_variant *s)
{
    return s->has_known && !s->has_layer;
}

static bool has_ratio(const case_variant *s)
{
    return s->has_known;
}

/* False if the ratio does not depend on the frequency. */
static bool has_ratio_slope(const case_variant *s)
{
    const wt_estimate slope = s->layer_observation.ratio_slope;
    return has_ratio(s) && (slope.value != 0 || slope.standard_error > 0);
}

/* False if there is no calibration error or if it cancels. */
static bool has_calibration(const case_variant *s)
{
    return has_ratio(s) && s->layer_observation.calibration_share > 0;
}

static const char calibration_remedy[] = "one cantilever for both groups, or spring constants, "
                                         "sensitivities, tips and temperatures known "
                                         "better";

#define ERROR_OF(estimate) NULL, NULL, offsetof(case_variant, estimate)
static const source sources[] = {
    {"material", "a second DMA run; temperatures known better", is_always_applicable,
     is_stated_rubber, fix_rubber, 0},
    {"pressure", "the load and the nominal area known better", is_always_applicable,
     ERROR_OF(sliding.pressure)},
    {"temperature", "the temperature in sliding measured", is_always_applicable,
     ERROR_OF(sliding.temperature)},
    {"roughness", "more scans of the counter surface", is_always_applicable, is_stated_roughness,
     fix_roughness, 0},
    {"softening with strain", "more strain sweeps at the temperature of the contact", has_softness,
     is_stated_softness, fix_strain_softening, 0},
    {"shear stress", "more friction runs that give it", has_shear_stress,
     ERROR_OF(sliding.shear_stress)},
    {"specific wear rate", "more or longer wear runs", has_layer,
     ERROR_OF(layer.specific_wear_rate)},
    {"critical energy", "more layers of known thickness", has_critical_energy,
     ERROR_OF(layer.critical_energy)},
    {"observed thickness", "the layer measured at more places", has_observed,
     ERROR_OF(layer.observed_thickness)},
    {"layer thickness", "the layer measured at more places", has_thickness,
     ERROR_OF(layer_observation.thickness)},
    {"modulus ratio", "more spots: four times as many halve it", has_ratio, is_stated_ratio,
     fix_ratio, 0},
    {"slope of the modulus ratio", "more spots indented at rates further apart", has_ratio_slope,
     ERROR_OF(layer_observation.ratio_slope)},
    {"calibration", calibration_remedy, has_calibration, is_stated_calibration, fix_calibration, 0},
};
#undef ERROR_OF
enum { SOURCES = COUNT_OF(sources) };

/* ---- computation ----------------------------------------------------------------------------- */

typedef struct outcome {
    wt_estimate number[CASE_QUANTITIES];
    double seconds;
    bool computed;
} outcome;

typedef struct error_budget_run {
    case_variant case_variant;
    wt_job work; /* options of one case variant */
    outcome values, all, of[SOURCES];
    char lacks[256];
} error_budget_run;

/* Computes one outcome. `s` receives the results of the computation. */
static wt_status compute_budget_outcome(const error_budget_run *b, case_variant *s,
                                        size_t replicates, outcome *o, wt_error *err)
{
    wt_job work = b->work;
    work.replicates = replicates;
    for (size_t k = 0; k < CASE_QUANTITIES; k++)
        o->number[k] = (wt_estimate){(double)NAN, (double)NAN, (double)NAN, NULL};
    const double start = cost_clock(work.cost);
    const wt_status status = case_variant_compute(s, &work, o->number, err);
    o->seconds = cost_clock(work.cost) - start;
    o->computed = status == WT_OK;
    return status;
}

static wt_status compute_budget(error_budget_run *b, wt_error *err)
{
    case_variant whole = b->case_variant;
    wt_status status = compute_budget_outcome(b, &whole, 0, &b->values, err);
    whole = b->case_variant;
    if (status == WT_OK)
        status = compute_budget_outcome(b, &whole, b->work.replicates, &b->all, err);
    for (size_t i = 0; i < SOURCES && status == WT_OK; i++) {
        case_variant alone = b->case_variant;
        if (!sources[i].applies(&b->case_variant))
            continue;
        if (!is_stated(&sources[i], &b->case_variant)) {
            clocale_append(b->lacks, sizeof b->lacks, "%s%s", b->lacks[0] != '\0' ? ", " : "",
                           sources[i].words);
            continue;
        }
        for (size_t k = 0; k < SOURCES; k++)
            if (k != i)
                hold_source(&sources[k], &alone);
        status = compute_budget_outcome(b, &alone, b->work.replicates, &b->of[i], err);
    }
    return status;
}

/* ---- model choices --------------------------------------------------------------------------- */

static const struct {
    what_if_column column;
    error_budget_key key;
} numbers[CASE_QUANTITIES] = {
    [CASE_QUANTITY_HYSTERESIS] = {WHAT_IF_HYSTERESIS, ERROR_BUDGET_KEY_HYSTERESIS},
    [CASE_QUANTITY_AREA_RATIO] = {WHAT_IF_AREA_RATIO, ERROR_BUDGET_KEY_AREA_RATIO},
    [CASE_QUANTITY_FRICTION] = {WHAT_IF_FRICTION, ERROR_BUDGET_KEY_FRICTION},
    [CASE_QUANTITY_THICKNESS] = {WHAT_IF_THICKNESS, ERROR_BUDGET_KEY_THICKNESS},
    [CASE_QUANTITY_WITH_LAYER] = {WHAT_IF_WITH_LAYER, ERROR_BUDGET_KEY_WITH_LAYER}};

typedef struct choice_range {
    const char *words;
    double low, high, half; /* limits of the number, and half its range */
} choice_range;

/* Finds the range of one choice, whose rows are adjacent. The first row of the table is the case as
 * used. Returns the first row of the next choice. */
static size_t find_choice_range(const table_view *t, size_t row, what_if_column column,
                                choice_range *range)
{
    double low = what_if_get(t, 0, column), high = low;
    range->words = what_if_text(t, row, WHAT_IF_CHOICE);
    const int choice = what_if_enum(t, row, WHAT_IF_CHOICE);
    for (; row < t->n_rows && what_if_enum(t, row, WHAT_IF_CHOICE) == choice; row++) {
        low = fmin(low, what_if_get(t, row, column)); /* fmin and fmax skip NaN */
        high = fmax(high, what_if_get(t, row, column));
    }
    *range = (choice_range){range->words, low, high, (high - low) / 2};
    return row;
}

/* ---- table ----------------------------------------------------------------------------------- */

typedef struct row {
    const char *source;
    error_kind kind;
    const char *remedy;
    double error; /* absolute error of the number */
    double share, seconds;
} row;

TABLE_ROW(error_budget, ERROR_BUDGET, const char *number; row of;)

static void add_budget_row(const char *number, double value, row r, table_writer *t)
{
    r.error /= fabs(value); /* NaN for 0 over 0 */
    TABLE_ADD(error_budget, t, number, r);
}

/* Dominant contributions to a number. */
typedef struct number_summary {
    const source *largest; /* NULL if none is known */
    double share, together, numerical;
    choice_range widest;
} number_summary;

/* Relative scatter of replicates that are equal but for their arithmetic. */
static const double rounding = 1e-12;

static void add_measured_rows(const error_budget_run *b, case_quantity k, number_summary *v,
                              table_writer *t)
{
    const double value = b->values.number[k].value;
    double sum = 0;
    for (size_t i = 0; i < SOURCES; i++) {
        const double error = b->of[i].number[k].standard_error;
        if (b->of[i].computed && isfinite(error))
            sum = hypot(sum, error);
    }
    for (size_t i = 0; i < SOURCES; i++) {
        const double error = b->of[i].number[k].standard_error;
        if (!b->of[i].computed || !(error > rounding * fabs(value)))
            continue;
        const double part = error / sum, share = part * part;
        add_budget_row(case_quantity_names[k], value,
                       (row){sources[i].words, ERROR_MEASURED, sources[i].remedy, error, share,
                             b->of[i].seconds},
                       t);
        if (v->largest == NULL || share > v->share) {
            v->largest = &sources[i];
            v->share = share;
        }
    }
}

static void add_model_rows(const error_budget_run *b, case_quantity k, const table_view *what_if,
                           number_summary *v, table_writer *t)
{
    const double value = b->values.number[k].value;
    for (size_t r = 1; r < what_if->n_rows;) {
        choice_range range;
        const double seconds = cost_part_seconds(b->work.cost, r);
        r = find_choice_range(what_if, r, numbers[k].column, &range);
        if (!(range.half > 0))
            continue;
        add_budget_row(case_quantity_names[k], value,
                       (row){range.words, ERROR_MODEL, "a measurement that settles the choice",
                             range.half, (double)NAN, seconds},
                       t);
        if (range.half > v->widest.half)
            v->widest = range;
    }
}

static void set_advice(const error_budget_run *b, case_quantity k, const number_summary *v,
                       table_writer *t)
{
    char text[640] = "";
    const double value = fabs(b->values.number[k].value);
    const int decimals = v->widest.half < 0.1 * value ? 1 : 0;
    if (v->largest == NULL)
        clocale_append(text, sizeof text,
                       b->work.replicates < 2
                           ? "Without replicates no error is drawn."
                           : "No error of what it is made from is measured or stated.");
    else
        clocale_append(text, sizeof text, "%.0f %% of its variance is the %s: %s.", 100 * v->share,
                       v->largest->words, v->largest->remedy);
    if (v->widest.half > 0 && !(v->widest.half <= v->together)) /* the total may be unknown */
        clocale_append(
            text, sizeof text,
            " The choice of the %s moves it by %+.*f %% to %+.*f %%, %s: more of the same "
            "measurements do not settle that.",
            v->widest.words, decimals, 100 * (v->widest.low / value - 1), decimals,
            100 * (v->widest.high / value - 1),
            v->together > 0 ? "more than all measured errors" : "and no error is known beside it");
    const double floor = fmax(v->together, v->widest.half);
    if (isnan(v->numerical))
        clocale_append(text, sizeof text, " What the arithmetic leaves open is not known.");
    else if (v->numerical < 1e-2 * floor)
        clocale_append(text, sizeof text,
                       " The numerical error is %.1g: a tighter tolerance does not help.",
                       v->numerical / value);
    else if (floor > 0)
        clocale_append(text, sizeof text,
                       " The numerical error is %.1g: a tighter tolerance helps.",
                       v->numerical / value);
    error_budget_set_text(t, numbers[k].key, text);
}

static void add_number_rows(const error_budget_run *b, case_quantity k, const table_view *what_if,
                            table_writer *t)
{
    const double value = b->values.number[k].value;
    number_summary v = {.together = b->all.number[k].standard_error,
                        .numerical = b->values.number[k].numerical_error};
    const double n = (double)b->work.replicates;
    add_measured_rows(b, k, &v, t);
    if (isfinite(v.together)) {
        add_budget_row(
            case_quantity_names[k], value,
            (row){"all together", ERROR_TOGETHER, "", v.together, (double)NAN, b->all.seconds}, t);
        add_budget_row(case_quantity_names[k], value,
                       (row){"number of replicates", ERROR_DRAWS,
                             "four times the replicates halve it", v.together / sqrt(2 * (n - 1)),
                             (double)NAN, b->all.seconds},
                       t);
    }
    add_budget_row(case_quantity_names[k], value,
                   (row){"arithmetic", ERROR_NUMERICAL, "a tighter tolerance", v.numerical,
                         (double)NAN, b->values.seconds},
                   t);
    add_model_rows(b, k, what_if, &v, t);
    set_advice(b, k, &v, t);
}

/* Adds the modulus ratio itself. Its components are known without draws. The time is that of the
 * curves. */
static void add_modulus_ratio_row(const error_budget_run *b, table_writer *t)
{
    static const char number[] = "modulus ratio";
    const wt_layer_observation *observation = &b->case_variant.layer_observation;
    const wt_estimate ratio = observation->modulus_ratio;
    const bool measured = observation->modulus_ratio_df > 0;
    const stage_cost_sum curves = cost_sum_stages(b->work.cost, COST_INDENTATION);
    const double spots = 1 - observation->calibration_share, error = ratio.standard_error;
    const char *own = measured ? "scatter of the spots" : "stated error";
    const char *remedy = measured ? "more spots: four times as many halve it" : "a measurement";
    char text[400];
    if (!(error > 0))
        return;
    add_budget_row(number, ratio.value,
                   (row){own, ERROR_MEASURED, remedy, sqrt(spots) * error, spots, curves.seconds},
                   t);
    if (observation->calibration_share > 0)
        add_budget_row(number, ratio.value,
                       (row){"calibration", ERROR_MEASURED, calibration_remedy,
                             sqrt(observation->calibration_share) * error,
                             observation->calibration_share, curves.seconds},
                       t);
    add_budget_row(number, ratio.value,
                   (row){"all together", ERROR_TOGETHER, "", error, (double)NAN, curves.seconds},
                   t);
    size_t n =
        (size_t)snprintf(text, sizeof text, "%.0f %% of its variance is the %s: %s.",
                         100 * fmax(spots, observation->calibration_share),
                         spots >= observation->calibration_share ? own : "calibration",
                         spots >= observation->calibration_share ? remedy : calibration_remedy);
    if (curves.error >= 0) {
        add_budget_row(number, ratio.value,
                       (row){"arithmetic", ERROR_NUMERICAL, "",
                             M_SQRT2 * curves.error * ratio.value, (double)NAN, curves.seconds},
                       t);
        clocale_print(text + n, sizeof text - n,
                      " The numerical error of the fits is %.1g: a tighter tolerance does not "
                      "help.",
                      M_SQRT2 * curves.error);
    }
    error_budget_set_text(t, ERROR_BUDGET_KEY_RATIO, text);
}

wt_status wt_error_budget_compute(const wt_sliding *sliding, const wt_layer_job *layer,
                                  const wt_layer_observation *observation, const wt_table *what_if,
                                  const wt_job *work, wt_table **table, wt_error *err)
{
    if (work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no error budget to make");
    error_budget_run b = {.work = *work};
    table_view moved = {0};
    b.work.left_out = WT_EXTRA_ALL;
    b.work.drawn = NULL; /* the stored draws are for another material */
    b.work.log = NULL;   /* warnings about these numbers exist already */
    b.work.progress = (wt_progress){0};
    wt_status status = case_variant_create(sliding, layer, observation, work, &b.case_variant, err);
    if (status == WT_OK && what_if != NULL)
        status = table_bind(what_if, &what_if_schema, "", &moved, err);
    if (status == WT_OK)
        status = compute_budget(&b, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&error_budget_schema, err);
    for (size_t k = 0; k < CASE_QUANTITIES; k++)
        if (isfinite(b.values.number[k].value))
            add_number_rows(&b, (case_quantity)k, &moved, &t);
    if (b.case_variant.has_known)
        add_modulus_ratio_row(&b, &t);
    if (b.lacks[0] != '\0')
        error_budget_set_text(&t, ERROR_BUDGET_KEY_LACKS, b.lacks);
    status = table_end(&t, table);
    if (status == WT_OK)
        cost_report(work, (cost_summary){.items = (double)wt_table_n_rows(*table)});
    return status;
}
