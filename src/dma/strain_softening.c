/* The job of strain sweeps, and the strain softening of the rubber from them or from a table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/rubber.h"

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "dma/sweep_input.h"
#include "job/cost.h"
#include "job/random_draws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_strain_softening_choice wt_strain_softening_choice_defaults(void)
{
    return (wt_strain_softening_choice){.temperature = (double)NAN};
}

void wt_strain_softening_clear(wt_strain_softening *softening)
{
    if (softening == NULL)
        return;
    free(softening->table.strain); /* the other arrays are in the same block */
    *softening = (wt_strain_softening){0};
}

/* Allocates n points, with or without errors. */
static wt_strain_softening softening_alloc(size_t n, bool errors)
{
    double *numbers = wt_alloc(5 * n, sizeof *numbers);
    return (wt_strain_softening){
        .table = {.n = n, .strain = numbers, .storage = numbers + n, .loss = numbers + 2 * n},
        .storage_error = errors ? numbers + 3 * n : NULL,
        .loss_error = errors ? numbers + 4 * n : NULL,
        .temperature = (double)NAN};
}

static bool is_positive(double x)
{
    return isfinite(x) && x > 0;
}

/* ---- strain sweeps --------------------------------------------------------------------------- */

/* One strain sweep: its rows that have moduli. */
typedef struct softening_sweep {
    size_t n;
    double *log_strain, *f, *g;
} softening_sweep;

/* Amplitudes closer than this [ln] are merged: 5 %, over which the law of Kraus (1984)
 * falls by at most 1.5 % of its height. */
static const double same_strain = 0.05;

/* Sweeps within 1.5 K have one temperature, as two runs of a chamber. A warning appears if the
 * nearest temperature is more than 10 K from the requested one. By the universal WLF constants
 * 10 K are 0.8 decade of time 50 K above the glass transition, most of a relaxation time. */
static const double same_temperature = 1.5, other_temperature = 10;

/* Returns true if a row has moduli and matches the selected temperature and sample (NaN, NULL:
 * any). */
static bool row_matches(const table_view *v, size_t row, wt_strain_softening_choice choice)
{
    const double temperature = payne_sweep_get(v, row, PAYNE_SWEEP_TEMPERATURE);
    return is_positive(payne_sweep_get(v, row, PAYNE_SWEEP_STRAIN)) &&
           is_positive(payne_sweep_get(v, row, PAYNE_SWEEP_STORAGE_RATIO)) &&
           is_positive(payne_sweep_get(v, row, PAYNE_SWEEP_LOSS_RATIO)) &&
           (isnan(choice.temperature) ||
            fabs(temperature - choice.temperature) <= same_temperature) &&
           (choice.sample == NULL ||
            strcmp(payne_sweep_text(v, row, PAYNE_SWEEP_SAMPLE), choice.sample) == 0);
}

static wt_status fail_ambiguous(const char *what, const char *one, const char *other,
                                const char *advice, wt_error *err)
{
    wt_fail(err, WT_E_AMBIGUOUS, "strain sweeps of several %s are no repeats", what);
    wt_error_expected(err, "those of one");
    wt_error_found(err, "%s, %s", one[0] != '\0' ? one : "one without a name",
                   other[0] != '\0' ? other : "one without a name");
    wt_error_advice(err, "%s", advice);
    return WT_E_AMBIGUOUS;
}

/* Selects a named sample if the table has names. A table without names is one sample. */
static wt_status select_sample(const table_view *v, wt_strain_softening_choice *choice,
                               wt_error *err)
{
    const wt_strain_softening_choice any = wt_strain_softening_choice_defaults();
    const char *first = NULL;
    bool named = false, is_found = false;
    for (size_t row = 0; row < v->n_rows; row++) {
        const char *const here = payne_sweep_text(v, row, PAYNE_SWEEP_SAMPLE);
        if (!row_matches(v, row, any))
            continue;
        named = named || here[0] != '\0';
        is_found = is_found || (choice->sample != NULL && strcmp(here, choice->sample) == 0);
        first = first == NULL ? here : first;
        if (choice->sample == NULL && strcmp(here, first) != 0)
            return fail_ambiguous("samples", first, here,
                                  "choose one with --sample NAME, here "
                                  "if the moduli are of that sample, else of weartrack payne",
                                  err);
    }
    if (!named || (choice->sample != NULL && strcmp(choice->sample, "all") == 0)) {
        choice->sample = NULL;
    } else if (choice->sample != NULL && !is_found) {
        wt_fail(err, WT_E_NOT_FOUND, "no strain sweep is of the sample \"%s\"", choice->sample);
        wt_error_found(err, "%s", first);
        wt_error_advice(err, "--sample is of moduli and strain sweeps alike");
        wt_error_options(err, "sample");
        return WT_E_NOT_FOUND;
    }
    return WT_OK;
}

static wt_status fail_no_temperature(const char *what, wt_error *err)
{
    wt_fail(err, WT_E_MISSING, "%s", what);
    wt_error_advice(err, "leave --softening-temperature out");
    return WT_E_MISSING;
}

/* Selects the sweep temperature that is nearest to the requested one. */
static wt_status select_temperature(const table_view *v, wt_strain_softening_choice *choice,
                                    wt_error *err)
{
    const wt_strain_softening_choice any_temperature = {.temperature = (double)NAN,
                                                        .sample = choice->sample};
    double low = (double)NAN, high = (double)NAN, nearest = (double)NAN;
    for (size_t row = 0; row < v->n_rows; row++) {
        const double here = payne_sweep_get(v, row, PAYNE_SWEEP_TEMPERATURE);
        if (!row_matches(v, row, any_temperature) || isnan(here))
            continue;
        low = fmin(low, here);
        high = fmax(high, here);
        if (isnan(nearest) ||
            fabs(here - choice->temperature) < fabs(nearest - choice->temperature))
            nearest = here;
    }
    if (isnan(choice->temperature) && high - low > same_temperature) {
        char one[32], other[32];
        clocale_print(one, sizeof one, "%.1f", low - WT_ZERO_CELSIUS);
        clocale_print(other, sizeof other, "%.1f degC", high - WT_ZERO_CELSIUS);
        return fail_ambiguous(
            "temperatures", one, other,
            "choose one with --softening-temperature T, such as that of the contact; in a "
            "case give sweeps of one temperature",
            err);
    }
    if (!isnan(choice->temperature) && isnan(nearest))
        return fail_no_temperature("the strain sweeps do not say their temperature", err);
    choice->temperature = isnan(choice->temperature) ? choice->temperature : nearest;
    return WT_OK;
}

static double mean_temperature(const table_view *v, wt_strain_softening_choice choice)
{
    double sum = 0, n = 0;
    for (size_t row = 0; row < v->n_rows; row++)
        if (row_matches(v, row, choice)) {
            sum += payne_sweep_get(v, row, PAYNE_SWEEP_TEMPERATURE);
            n++;
        }
    return n > 0 ? sum / n : (double)NAN;
}

static bool is_sweep_start(const table_view *v, size_t row)
{
    return row == 0 || wt_table_block(v->table, row) != wt_table_block(v->table, row - 1) ||
           payne_sweep_get(v, row, PAYNE_SWEEP_STRAIN) <=
               payne_sweep_get(v, row - 1, PAYNE_SWEEP_STRAIN) ||
           payne_sweep_get(v, row, PAYNE_SWEEP_ANGULAR_FREQUENCY) !=
               payne_sweep_get(v, row - 1, PAYNE_SWEEP_ANGULAR_FREQUENCY);
}

/* Stores the sweeps one after another in the given arrays and returns their number. */
static size_t collect_sweeps(const table_view *v, wt_strain_softening_choice choice,
                             softening_sweep arrays, softening_sweep *sweeps)
{
    size_t n = 0, at = 0;
    bool begins = false;
    for (size_t row = 0; row < v->n_rows; row++) {
        const double strain = payne_sweep_get(v, row, PAYNE_SWEEP_STRAIN),
                     f = payne_sweep_get(v, row, PAYNE_SWEEP_STORAGE_RATIO),
                     g = payne_sweep_get(v, row, PAYNE_SWEEP_LOSS_RATIO);
        begins = begins || is_sweep_start(v, row);
        if (!row_matches(v, row, choice))
            continue;
        if (begins)
            sweeps[n++] = (softening_sweep){
                .log_strain = arrays.log_strain + at, .f = arrays.f + at, .g = arrays.g + at};
        begins = false;
        arrays.log_strain[at] = log(strain);
        arrays.f[at] = f;
        arrays.g[at++] = g;
        sweeps[n - 1].n++;
    }
    return n;
}

/* Interpolates linearly in ln strain within the sweep. */
static double interpolate_sweep(const softening_sweep *s, const double *value, double log_strain)
{
    size_t k = 0;
    while (k + 2 < s->n && s->log_strain[k + 1] < log_strain)
        k++;
    if (s->n < 2)
        return value[0];
    const double part = (log_strain - s->log_strain[k]) / (s->log_strain[k + 1] - s->log_strain[k]);
    return value[k] + fmin(fmax(part, 0), 1) * (value[k + 1] - value[k]);
}

/* Collects the strains within the common range of all sweeps and returns their number. */
static size_t common_strains(const softening_sweep *sweeps, size_t n, double *x, wt_error *err)
{
    double low = -(double)INFINITY, high = (double)INFINITY;
    size_t count = 0, kept = 0;
    for (size_t i = 0; i < n; i++) {
        low = fmax(low, sweeps[i].log_strain[0]);
        high = fmin(high, sweeps[i].log_strain[sweeps[i].n - 1]);
    }
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < sweeps[i].n; k++)
            if (sweeps[i].log_strain[k] >= low && sweeps[i].log_strain[k] <= high)
                x[count++] = sweeps[i].log_strain[k];
    if (count == 0) {
        wt_fail(err, WT_E_RANGE, "the strain sweeps have no strain in common");
        wt_error_found(err, "%zu sweeps, one that begins at %.3g and one that ends at %.3g", n,
                       exp(low), exp(high));
        wt_error_advice(err, "give strain sweeps over the same amplitudes, or one of them");
        return 0;
    }
    numbers_sort(x, count);
    for (size_t k = 0; k < count; k++)
        if (kept == 0 || x[k] - x[kept - 1] > same_strain)
            x[kept++] = x[k];
    return kept;
}

/* Computes the mean of the sweeps and the standard deviation of a further sweep. Student's
 * factor widens it, so that 1.96 deviations contain 95 %. */
static void compute_mean(const softening_sweep *sweeps, size_t n, const double *x, bool loss,
                         double *mean, double *error, size_t points)
{
    const double wider = n > 1 ? wt_student_quantile((double)(n - 1)) / NORMAL_95 : 1;
    for (size_t k = 0; k < points; k++) {
        double sum = 0, squares = 0;
        for (size_t i = 0; i < n; i++)
            sum += interpolate_sweep(&sweeps[i], loss ? sweeps[i].g : sweeps[i].f, x[k]);
        mean[k] = sum / (double)n;
        for (size_t i = 0; error != NULL && i < n; i++) {
            const double off =
                interpolate_sweep(&sweeps[i], loss ? sweeps[i].g : sweeps[i].f, x[k]) - mean[k];
            squares += off * off;
        }
        if (error != NULL)
            error[k] = wider * sqrt(squares / (double)(n - 1) * (1 + 1 / (double)n));
    }
}

static wt_status average_sweeps(const softening_sweep *sweeps, size_t n, double *x,
                                wt_strain_softening *s, wt_error *err)
{
    const size_t points = common_strains(sweeps, n, x, err);
    if (points == 0)
        return WT_E_RANGE;
    *s = softening_alloc(points, n > 1);
    compute_mean(sweeps, n, x, false, s->table.storage, s->storage_error, points);
    compute_mean(sweeps, n, x, true, s->table.loss, s->loss_error, points);
    for (size_t k = 0; k < points; k++)
        s->table.strain[k] = exp(x[k]);
    s->n_sweeps = n;
    return WT_OK;
}

static wt_status read_strain_sweeps(const wt_table *table, wt_strain_softening_choice choice,
                                    wt_strain_softening *softening, wt_error *err)
{
    table_view v;
    wt_status status = table_bind(table, &payne_sweep_schema, "", &v, err);
    if (status == WT_OK)
        status = select_sample(&v, &choice, err);
    if (status == WT_OK)
        status = select_temperature(&v, &choice, err);
    if (status != WT_OK)
        return status;
    double *numbers = wt_alloc(4 * v.n_rows, sizeof *numbers);
    softening_sweep *sweeps = wt_alloc(v.n_rows, sizeof *sweeps);
    const size_t n = collect_sweeps(
        &v, choice, (softening_sweep){0, numbers, numbers + v.n_rows, numbers + 2 * v.n_rows},
        sweeps);
    if (n == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no strain sweep has both moduli");
        wt_error_expected(err, "storage_ratio and loss_ratio above 0 in the table payne_sweep");
    }
    if (status == WT_OK)
        status = average_sweeps(sweeps, n, numbers + 3 * v.n_rows, softening, err);
    if (status == WT_OK)
        softening->temperature = mean_temperature(&v, choice);
    free(numbers);
    free(sweeps);
    return status;
}

/* ---- table of ratios ------------------------------------------------------------------------- */

enum { STRAIN, F, G, F_ERROR, G_ERROR, N_COLUMNS };
static const char *const names[N_COLUMNS] = {"strain", "f", "g", "f_error", "g_error"};

static wt_status fail_not_softening(wt_error *err)
{
    wt_fail(err, WT_E_MISSING, "the table is not one of a softening with strain");
    wt_error_expected(err, "columns strain, f and g, and f_error and g_error if they are known; "
                           "or the table payne_sweep, as weartrack payne writes it");
    return WT_E_MISSING;
}

static wt_status read_softening_table(const wt_table *table, wt_strain_softening *s, wt_error *err)
{
    const size_t n = wt_table_n_rows(table);
    long column[N_COLUMNS];
    double factor[N_COLUMNS], zero;
    wt_status status = WT_OK;
    for (size_t i = 0; i < N_COLUMNS; i++) {
        column[i] = wt_table_find(table, names[i]);
        factor[i] = 1;
        if (column[i] < 0 ? i <= G
                          : wt_table_column_kind(table, (size_t)column[i]) == WT_COLUMN_TEXT)
            return fail_not_softening(err);
        if (column[i] >= 0 && status == WT_OK)
            status = wt_unit_to_si(wt_table_column_unit(table, (size_t)column[i]), WT_Q_STRAIN,
                                   &factor[i], &zero, err);
    }
    if (status != WT_OK || n == 0)
        return status != WT_OK ? status : fail_not_softening(err);
    if ((column[F_ERROR] >= 0) != (column[G_ERROR] >= 0)) {
        wt_fail(err, WT_E_MISSING, "a softening with strain has the error of one ratio alone");
        wt_error_expected(err, "f_error and g_error, 0 where there is none");
        wt_error_found(err, "%s", names[column[F_ERROR] >= 0 ? F_ERROR : G_ERROR]);
        return WT_E_MISSING;
    }
    *s = softening_alloc(n, column[F_ERROR] >= 0);
    double *const to[N_COLUMNS] = {s->table.strain, s->table.storage, s->table.loss,
                                   s->storage_error, s->loss_error};
    for (size_t i = 0; i < N_COLUMNS; i++)
        for (size_t k = 0; to[i] != NULL && k < n; k++)
            to[i][k] = factor[i] * wt_table_number(table, k, (size_t)column[i]);
    return WT_OK;
}

/* ---- both ------------------------------------------------------------------------------------ */

static wt_status check_softening_errors(const wt_strain_softening *s, wt_error *err)
{
    for (size_t k = 0; s->storage_error != NULL && k < s->table.n; k++)
        if (!(s->storage_error[k] >= 0 && isfinite(s->storage_error[k])) ||
            !(s->loss_error[k] >= 0 && isfinite(s->loss_error[k]))) {
            wt_fail(err, WT_E_RANGE, "an error of a softening with strain is no error");
            wt_error_place(err, "point %zu of %zu", k + 1, s->table.n);
            wt_error_expected(err, "f_error and g_error finite and >= 0");
            return WT_E_RANGE;
        }
    return WT_OK;
}

wt_status wt_strain_softening_from_table(const wt_table *table, wt_strain_softening_choice choice,
                                         wt_strain_softening *softening, wt_error *err)
{
    if (table == NULL || softening == NULL)
        return wt_fail(err, WT_E_ARG, "no table of a softening with strain");
    wt_strain_softening s = {0};
    wt_status status = WT_OK;
    if (wt_table_find(table, "storage_ratio") >= 0)
        status = read_strain_sweeps(table, choice, &s, err);
    else if (!isnan(choice.temperature))
        status = fail_no_temperature("a table of strain, f and g has no temperature", err);
    else
        status = read_softening_table(table, &s, err);
    if (status == WT_OK)
        status = wt_softening_check(&s.table, err);
    if (status == WT_OK)
        status = check_softening_errors(&s, err);
    if (status == WT_OK)
        *softening = s;
    else
        wt_strain_softening_clear(&s);
    return status;
}

wt_status wt_strain_softening_read(const char *path, const char *name,
                                   wt_strain_softening_choice choice, const wt_job *work,
                                   wt_strain_softening *softening, wt_error *err)
{
    static const wt_tables_role role = {
        NULL, WT_ROLE_SOFTENING,
        "what weartrack payne wrote, or a text table that begins with a line such as "
        "\"# strain[1]<TAB>f[1]<TAB>g[1]\""};
    wt_result *tables = NULL;
    wt_status status = wt_tables_read(path, name, work, role, &tables, err);
    if (status == WT_OK) {
        const wt_table *swept = wt_result_find(tables, "payne_sweep");
        status = wt_strain_softening_from_table(swept != NULL ? swept : wt_result_table(tables, 0),
                                                choice, softening, err);
    }
    if (status != WT_OK)
        wt_error_file(err, name);
    else if (fabs(softening->temperature - choice.temperature) > other_temperature)
        wt_log_add(work->log, WT_WARNING, name, NULL,
                   "strain sweeps at %.1f °C are asked for; the nearest were measured at "
                   "%.1f °C",
                   choice.temperature - WT_ZERO_CELSIUS, softening->temperature - WT_ZERO_CELSIUS);
    wt_result_free(tables);
    return status;
}

bool strain_softening_has_errors(const wt_strain_softening *softening)
{
    bool any = false;
    for (size_t k = 0; softening->storage_error != NULL && k < softening->table.n; k++)
        any = any || softening->storage_error[k] > 0 || softening->loss_error[k] > 0;
    return any;
}

void strain_softening_describe(const wt_strain_softening *s, char *text, size_t size)
{
    const double *strain = s->table.strain;
    char from[64], at[32] = "";
    if (s->n_sweeps == 0)
        snprintf(from, sizeof from, "given table");
    else
        snprintf(from, sizeof from, "%s%zu strain sweep%s", s->n_sweeps > 1 ? "mean of " : "",
                 s->n_sweeps, s->n_sweeps > 1 ? "s" : "");
    if (!isnan(s->temperature))
        clocale_print(at, sizeof at, " at %.1f °C", s->temperature - WT_ZERO_CELSIUS);
    clocale_print(text, size, "%s%s, strain %s; %s", from, at,
                  format_range(strain[0], strain[s->table.n - 1], 3).text,
                  strain_softening_has_errors(s)
                      ? s->n_sweeps > 1 ? "the scatter between the sweeps is drawn"
                                        : "errors are drawn"
                      : "its error is not known and not in the standard errors");
}

/* Moves all points by the same normal number, because sweeps differ as whole curves. */
static void scale_curve(double *value, const double *error, size_t n, double normal)
{
    for (size_t k = 0; error != NULL && k < n; k++)
        value[k] *= exp(normal * error[k] / value[k]);
}

wt_strain_softening strain_softening_draw(const wt_strain_softening *softening, uint64_t seed,
                                          size_t replicate)
{
    const wt_softening *t = &softening->table;
    wt_strain_softening drawn = softening_alloc(t->n, false);
    memcpy(drawn.table.strain, t->strain, t->n * sizeof *t->strain);
    memcpy(drawn.table.storage, t->storage, t->n * sizeof *t->storage);
    memcpy(drawn.table.loss, t->loss, t->n * sizeof *t->loss);
    if (replicate != WT_NO_REPLICATE) {
        scale_curve(drawn.table.storage, softening->storage_error, t->n,
                    flow_draw_normal(seed, replicate, FLOW_DRAW_SOFT_STORAGE));
        scale_curve(drawn.table.loss, softening->loss_error, t->n,
                    flow_draw_normal(seed, replicate, FLOW_DRAW_SOFT_LOSS));
    }
    return drawn;
}

/* ---- the job of strain sweeps ---------------------------------------------------------------- */

wt_payne_job wt_payne_job_defaults(void)
{
    return (wt_payne_job){.n_sets = 0};
}

/* Points with positive moduli. */
typedef struct usable_points {
    size_t n;
    double *strain, *storage, *loss;
    bool loss_measured;
} usable_points;

static usable_points select_usable_points(const wt_strain_sweep *sweep, arena *memory, wt_log *log)
{
    usable_points u = {.strain = arena_numbers(memory, sweep->n),
                       .storage = arena_numbers(memory, sweep->n),
                       .loss = arena_numbers(memory, sweep->n)};
    bool storage_only = true;
    for (size_t i = 0; i < sweep->n && storage_only; i++)
        storage_only = isnan(sweep->loss_modulus[i]);
    u.loss_measured = !storage_only;
    for (size_t i = 0; i < sweep->n; i++) {
        const double storage = sweep->storage_modulus[i], loss = sweep->loss_modulus[i];
        if (!(storage > 0 && isfinite(storage) && (storage_only || (loss > 0 && isfinite(loss)))))
            continue;
        u.strain[u.n] = sweep->strain[i];
        u.storage[u.n] = storage;
        u.loss[u.n++] = loss;
    }
    if (u.n < sweep->n)
        wt_log_action(log, WT_WARNING, WT_LEFT_OUT, sweep->n - u.n, "--columns", sweep->source,
                      NULL,
                      "strain sweep at %.4g rad/s: %zu of %zu points left out, no positive "
                      "modulus",
                      sweep->angular_frequency, sweep->n - u.n, sweep->n);
    return u;
}

TABLE_ROW(payne_sweep, PAYNE_SWEEP, double strain, angular_frequency, temperature, storage, loss,
          loss_factor;
          double storage_ratio, loss_ratio; const char *source, *sample;)

static void add_sweep_point_rows(table_writer *t, const wt_strain_sweep *s, const wt_payne *p)
{
    const double unknown = (double)NAN;
    table_block(t);
    for (size_t i = 0; i < s->n; i++) {
        const double strain = s->strain[i], storage = s->storage_modulus[i],
                     loss = s->loss_modulus[i];
        TABLE_ADD(payne_sweep, t, strain, s->angular_frequency, s->temperature, storage, loss,
                  storage > 0 ? loss / storage : unknown, storage / p->storage_start,
                  loss / p->loss_start, s->source, s->sample);
    }
}

TABLE_ROW(payne, PAYNE, wt_strain_sweep sweep; wt_payne payne; size_t points;
          double strain_min, strain_max;)

static wt_status build_payne_tables(const wt_job *work, const wt_sweep *sweep, wt_payne_tables *t,
                                    wt_error *err)
{
    const char *deformation = flow_deformation_name(sweep->deformation);
    table_writer points = table_begin(&payne_sweep_schema, err),
                 numbers = table_begin(&payne_schema, err);
    wt_status status = WT_OK;
    size_t n_measured = 0;
    payne_sweep_set_text(&points, PAYNE_SWEEP_KEY_DEFORMATION, deformation);
    payne_set_text(&numbers, PAYNE_KEY_DEFORMATION, deformation);
    for (size_t i = 0; i < sweep->n_strain_sweeps && status == WT_OK; i++) {
        const wt_strain_sweep *s = &sweep->strain_sweeps[i];
        arena memory = {0};
        const usable_points u = select_usable_points(s, &memory, work->log);
        wt_payne payne;
        if (u.n > 0) {
            status = wt_payne_measure(u.strain, u.storage, u.loss_measured ? u.loss : NULL, u.n,
                                      &payne, err);
            if (status == WT_OK) {
                add_sweep_point_rows(&points, s, &payne);
                TABLE_ADD(payne, &numbers, *s, payne, u.n, u.strain[0], u.strain[u.n - 1]);
                n_measured++;
            }
        }
        arena_free(&memory);
    }
    if (status == WT_OK && n_measured == 0) {
        status = wt_fail(err, WT_E_RANGE, "no strain sweep has a positive modulus");
        wt_error_place(err, "%s", sweep->strain_sweeps[0].source);
    }
    const wt_status first = table_end(&points, &t->payne_sweep),
                    second = table_end(&numbers, &t->payne);
    return status != WT_OK ? status : first != WT_OK ? first : second;
}

wt_status wt_payne_compute(const wt_payne_job *job, const wt_job *work, wt_payne_tables *tables,
                           wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no job of strain sweeps");
    wt_sweep sweep = {0};
    wt_payne_tables t = {0};
    wt_status status = flow_sweeps_read(job->sets, job->n_sets, work, &sweep, err);
    if (status == WT_OK && sweep.n_strain_sweeps == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no strain sweep could be read");
        wt_error_expected(err, "moduli at one frequency and temperature at rising strain "
                               "amplitudes, and a column of the amplitude");
        wt_error_found(err, "isotherms: %zu, temperature sweeps: %zu", sweep.n_isotherms,
                       sweep.n_ramps);
    }
    if (status == WT_OK)
        status = build_payne_tables(work, &sweep, &t, err);
    if (status == WT_OK) {
        cost_report(work, (cost_summary){.items = (double)sweep.n_strain_sweeps});
        *tables = t;
        t = (wt_payne_tables){0};
    }
    wt_tables_clear(&t, sizeof t);
    wt_sweep_clear(&sweep);
    return status;
}
