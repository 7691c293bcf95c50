/* Results for the tests of the report: the output of the bundled case, changed where a test needs
 * it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_REPORT_FIXTURE_H
#define WT_TESTS_REPORT_FIXTURE_H

#include "core/table/registry.h"
#include "weartrack/case.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A path with special characters of HTML, the shell and gnuplot. */
#define FIXTURE_EVIL "<b>'`touch fixture_was_run`\"&;$(rm -r x)\\"

/* A fixture that cannot be created is an error of the test. */
static inline void fixture_check(wt_status status)
{
    if (status != WT_OK)
        abort();
}

static wt_result *fixture_case; /* output of the case */

static inline void fixture_free(void)
{
    wt_result_free(fixture_case);
}

/* ---- changes --------------------------------------------------------------------------------- */

/* Changes of the table with that name. */
typedef struct fixture_change {
    const char *table;
    bool leave_out;
    bool (*keep)(const wt_table *table, size_t row); /* NULL: all rows */
    void (*begin)(wt_table *copy);                   /* adds columns, or NULL */
    void (*edit)(wt_table *copy, size_t row);        /* edits the last row of a copy, or NULL */
    void (*finish)(wt_table *copy);                  /* adds rows and keys, or NULL */
    const char *without;                             /* column or key to remove */
    const char *swapped; /* column with text in place of numbers or the reverse */
} fixture_change;

/* Cells of the last row. */
static inline void fixture_put(wt_table *table, const char *column, double value)
{
    wt_table_set_number(table, (size_t)wt_table_find(table, column), value);
}

static inline void fixture_text(wt_table *table, const char *column, const char *text)
{
    wt_table_set_text(table, (size_t)wt_table_find(table, column), text);
}

static inline void fixture_key(wt_table *table, const char *key, double value, double standard,
                               const char *unit)
{
    fixture_check(wt_table_set_estimate(table, key, (wt_estimate){value, standard, 0, unit}, NULL));
}

static inline void fixture_words(wt_table *table, const char *key, const char *words)
{
    fixture_check(wt_table_set_key(table, key, words, NULL));
}

static inline void fixture_add(wt_result *result, wt_table *table)
{
    fixture_check(wt_result_add(result, table, NULL));
}

static inline bool fixture_is(const char *name, const char *other)
{
    return other != NULL && strcmp(name, other) == 0;
}

static inline void fixture_columns(wt_table *copy, const wt_table *table,
                                   const fixture_change *change)
{
    for (size_t c = 0; c < wt_table_n_columns(table); c++) {
        const char *name = wt_table_column_name(table, c),
                   *words = wt_table_column_long_name(table, c);
        bool text =
            (wt_table_column_kind(table, c) == WT_COLUMN_TEXT) != fixture_is(name, change->swapped);
        if (fixture_is(name, change->without))
            continue;
        if (text)
            fixture_check(wt_table_add_text_column(copy, name, words, NULL));
        else
            fixture_check(wt_table_add_column(
                copy, name,
                fixture_is(name, change->swapped) ? "1" : wt_table_column_unit(table, c), words,
                NULL));
    }
}

static inline void fixture_rows(wt_table *copy, const wt_table *table, const fixture_change *change)
{
    size_t block = 0;
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        if (change->keep != NULL && !change->keep(table, row))
            continue;
        if (wt_table_block(table, row) != block)
            wt_table_new_block(copy);
        block = wt_table_block(table, row);
        fixture_check(wt_table_add_row(copy, NULL));
        for (size_t c = 0; c < wt_table_n_columns(table); c++) {
            const char *name = wt_table_column_name(table, c);
            if (fixture_is(name, change->without) || fixture_is(name, change->swapped))
                continue;
            if (wt_table_column_kind(table, c) == WT_COLUMN_TEXT)
                fixture_text(copy, name, wt_table_text(table, row, c));
            else
                fixture_put(copy, name, wt_table_number(table, row, c));
        }
        if (change->edit != NULL)
            change->edit(copy, wt_table_n_rows(copy) - 1);
    }
}

static inline wt_table *fixture_copy(const wt_table *table, const fixture_change *change)
{
    wt_table *copy = wt_table_new(wt_table_name(table), wt_table_title(table));
    if (copy == NULL)
        abort();
    fixture_columns(copy, table, change);
    if (change->begin != NULL)
        change->begin(copy);
    fixture_rows(copy, table, change);
    for (size_t i = 0; i < wt_table_n_keys(table); i++) {
        const char *key = wt_table_key_name(table, i);
        if (!fixture_is(key, change->without))
            fixture_words(copy, key, wt_table_key(table, key));
    }
    if (change->finish != NULL)
        change->finish(copy);
    return copy;
}

/* A temperature sweep. */
static inline void fixture_ramp(void)
{
    static const char *const file[] = {WT_SOURCE_DIR "/fixtures/formats/table-units/ramp.csv"};
    static const double at[] = {298.15};
    const wt_file_set set = {.patterns = file, .n_patterns = 1, .read = wt_read_defaults()};
    wt_ramp_job job = wt_ramp_job_defaults();
    wt_job work = wt_job_defaults();
    wt_formats *formats = NULL;
    wt_ramp_tables tables = {0};
    fixture_check(wt_formats_new(NULL, &formats, NULL, NULL));
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.temperature = at;
    job.n_temperatures = 1;
    fixture_check(wt_ramp_compute(&job, &work, &tables, NULL));
    fixture_check(wt_result_add(fixture_case, tables.ramp, NULL));
    fixture_check(wt_result_add(fixture_case, tables.glass_transition, NULL));
    fixture_check(wt_result_add(fixture_case, tables.moduli_at, NULL));
    wt_formats_free(formats);
}

/* The material of a result. */
static inline wt_status fixture_rubber(const wt_result *result, wt_rubber *rubber, wt_error *err)
{
    const wt_rubber_tables tables = {.prony = wt_result_find(result, "prony"),
                                     .shift_factors = wt_result_find(result, "shift_factors"),
                                     .material_draws = wt_result_find(result, "material_draws"),
                                     .series_draws = wt_result_find(result, "series_draws")};
    return wt_rubber_from_tables(&tables, 0.5, rubber, err);
}

/* Friction at three velocities with and without flash temperature. */
static inline void fixture_flash(void)
{
    static const double velocity[] = {1e-3, 1e-1, 10}, with[] = {0.1, 0.3, 0.4},
                        without[] = {0.1, 0.35, 0.7}, temperature[] = {293.2, 297, 322};
    wt_table *table = NULL;
    table_writer t = table_begin(&flash_schema, NULL);
    for (size_t i = 0; i < 3; i++) {
        table_row(&t);
        flash_put(&t, FLASH_VELOCITY, velocity[i]);
        flash_put(&t, FLASH_TEMPERATURE, temperature[i]);
        flash_put(&t, FLASH_TEMPERATURE_NUMERICAL_ERROR, 1e-9);
        flash_put(&t, FLASH_HYSTERESIS, with[i]);
        flash_put(&t, FLASH_HYSTERESIS_NUMERICAL_ERROR, 1e-12);
        flash_put(&t, FLASH_HYSTERESIS_WITHOUT, without[i]);
        flash_put(&t, FLASH_HYSTERESIS_WITHOUT_NUMERICAL_ERROR, 1e-12);
        flash_put(&t, FLASH_AREA_RATIO, 0.1);
        flash_put(&t, FLASH_AREA_RATIO_NUMERICAL_ERROR, 1e-12);
        flash_put(&t, FLASH_AREA_RATIO_WITHOUT, 0.09);
        flash_put(&t, FLASH_AREA_RATIO_WITHOUT_NUMERICAL_ERROR, 1e-12);
    }
    flash_set_value(&t, FLASH_KEY_SURROUNDINGS, 293.15, (double)NAN, (double)NAN);
    flash_set_value(&t, FLASH_KEY_CONTACT_SIZE, 1e-3, 0, 0);
    flash_set_value(&t, FLASH_KEY_HEAT_CAPACITY, 2.2e6, 0, 0);
    flash_set_value(&t, FLASH_KEY_DIFFUSIVITY, 1e-7, 0, 0);
    flash_set_value(&t, FLASH_KEY_MACROSCOPIC, 0.3, 0, 0);
    flash_set_text(&t, FLASH_KEY_EFFECT, "28.9 K warmer");
    fixture_check(table_end(&t, &table));
    fixture_check(wt_result_add(fixture_case, table, NULL));
}

/* Friction at three velocities with and without softening. */
static inline void fixture_softening(void)
{
    static const double velocity[] = {0.01, 0.1, 1}, with[] = {0.3, 0.5, 0.6},
                        without[] = {0.2, 0.4, 0.5};
    wt_table *table = NULL;
    table_writer t = table_begin(&softening_schema, NULL);
    for (size_t i = 0; i < 3; i++) {
        table_row(&t);
        softening_put(&t, SOFTENING_VELOCITY, velocity[i]);
        softening_put(&t, SOFTENING_HYSTERESIS, with[i]);
        softening_put(&t, SOFTENING_HYSTERESIS_NUMERICAL_ERROR, 1e-12);
        softening_put(&t, SOFTENING_HYSTERESIS_WITHOUT, without[i]);
        softening_put(&t, SOFTENING_HYSTERESIS_WITHOUT_NUMERICAL_ERROR, 1e-12);
        softening_put(&t, SOFTENING_AREA_RATIO, 0.1);
        softening_put(&t, SOFTENING_AREA_RATIO_NUMERICAL_ERROR, 1e-12);
        softening_put(&t, SOFTENING_AREA_RATIO_WITHOUT, 0.05);
        softening_put(&t, SOFTENING_AREA_RATIO_WITHOUT_NUMERICAL_ERROR, 1e-12);
        softening_put(&t, SOFTENING_SHARE_BELOW, 0.1);
        softening_put(&t, SOFTENING_SHARE_ABOVE, 0.2);
    }
    softening_set_text(&t, SOFTENING_KEY_SOURCE, "given table");
    softening_set_print(&t, SOFTENING_KEY_STRAIN_FACTOR, "1");
    softening_set_value(&t, SOFTENING_KEY_STRAIN, 0.4, (double)NAN, (double)NAN);
    softening_set_value(&t, SOFTENING_KEY_SHARE_ABOVE, 0.2, (double)NAN, (double)NAN);
    softening_set_text(&t, SOFTENING_KEY_EFFECT, "more friction");
    fixture_check(table_end(&t, &table));
    fixture_check(wt_result_add(fixture_case, table, NULL));
}

/* Two positions of a surface, and extrapolated data. */
static inline void fixture_surface(void)
{
    static const char *const files[] = {WT_SOURCE_DIR "/fixtures/surface/place-*.gsf"};
    const wt_file_set set = {.patterns = files, .n_patterns = 1, .read = wt_read_defaults()};
    wt_topography_job job = wt_topography_job_defaults();
    wt_job work = wt_job_defaults();
    wt_formats *formats = NULL;
    wt_topography_tables tables = {0};
    fixture_check(wt_formats_new(NULL, &formats, NULL, NULL));
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.end = 1e7;
    job.heights = true;
    fixture_check(wt_topography_compute(&job, &work, &tables, NULL));
    fixture_check(wt_result_add(fixture_case, tables.power_spectrum, NULL));
    fixture_check(wt_result_add(fixture_case, tables.angular_spectrum, NULL));
    fixture_check(wt_result_add(fixture_case, tables.surfaces, NULL));
    fixture_check(wt_result_add(fixture_case, tables.height_map, NULL));
    fixture_check(wt_result_add(fixture_case, tables.height_profile, NULL));
    wt_formats_free(formats);
}

/* Strain sweeps at two frequencies. */
static inline void fixture_payne(void)
{
    static const char *const file[] = {WT_SOURCE_DIR "/fixtures/formats/tidy/strain-sweeps.csv"};
    const wt_file_set set = {.patterns = file, .n_patterns = 1, .read = wt_read_defaults()};
    wt_payne_job job = wt_payne_job_defaults();
    wt_job work = wt_job_defaults();
    wt_formats *formats = NULL;
    wt_payne_tables tables = {0};
    fixture_check(wt_formats_new(NULL, &formats, NULL, NULL));
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    fixture_check(wt_payne_compute(&job, &work, &tables, NULL));
    fixture_check(wt_result_add(fixture_case, tables.payne, NULL));
    fixture_check(wt_result_add(fixture_case, tables.payne_sweep, NULL));
    wt_formats_free(formats);
}

/* A disc at four velocities and temperatures, with the worn mass. */
static inline void fixture_record(void)
{
    static const char *const file[] = {WT_SOURCE_DIR "/fixtures/record/steps.csv"};
    const wt_file_set set = {.patterns = file, .n_patterns = 1, .read = wt_read_defaults()};
    wt_record_job job = wt_record_job_defaults();
    wt_job work = wt_job_defaults();
    wt_formats *formats = NULL;
    wt_record_tables tables = {0};
    fixture_check(wt_formats_new(NULL, &formats, NULL, NULL));
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.track_radius.value = 12e-3;
    job.track_area = (wt_estimate){3e-11, 6e-12, 0, "m^2"};
    fixture_check(wt_record_compute(&job, &work, &tables, NULL));
    fixture_check(wt_result_add(fixture_case, tables.record, NULL));
    fixture_check(wt_result_add(fixture_case, tables.record_cycles, NULL));
    fixture_check(wt_result_add(fixture_case, tables.wear, NULL));
    wt_formats_free(formats);
}

/* All curves of the first bulk file of the case, for viewing. */
static inline void fixture_curves(void)
{
    static const char *const file[] = {"bulk-1.jpk-force-map"}, *const all[] = {"all"};
    const wt_file_set set = {.patterns = file,
                             .n_patterns = 1,
                             .folder = WT_SOURCE_DIR "/fixtures/case",
                             .read = wt_read_defaults()};
    wt_indent_job job = wt_indent_job_defaults();
    wt_job work = wt_job_defaults();
    wt_formats *formats = NULL;
    wt_indent_tables tables = {0};
    fixture_check(wt_formats_new(NULL, &formats, NULL, NULL));
    work.formats = formats;
    job.sets = &set;
    job.n_sets = 1;
    job.curves = all;
    job.n_curves = 1;
    fixture_check(wt_tip_parse("pyramid:half-angle=20deg,radius=20nm", &job.tip, NULL));
    fixture_check(wt_indent_group(&job, &work, &tables, NULL));
    fixture_check(wt_result_add(fixture_case, tables.curves, NULL));
    tables.curves = NULL;
    wt_indent_tables_clear(&tables);
    wt_formats_free(formats);
}

/* A case against a record: the tables with these names, separated by blanks. */
static inline void fixture_held(wt_case *read, const char *record, const char *names)
{
    const fixture_change no_change = {.table = NULL};
    const wt_validation_job job = wt_validation_job_defaults();
    char list[256], *rest = NULL;
    wt_run_options few = wt_run_defaults();
    wt_result *result = NULL;
    size_t failed = 0;
    few.replicates = 20;
    fixture_check(wt_case_request_tables(read, names, NULL));
    fixture_check(wt_case_set_validation(read, &record, 1, &job, 0, NULL));
    fixture_check(wt_run_case(read, &few, NULL, &result, &failed, NULL));
    snprintf(list, sizeof list, "%s", names);
    for (const char *name = strtok_r(list, " ", &rest); name != NULL;
         name = strtok_r(NULL, " ", &rest))
        fixture_check(wt_result_add(fixture_case,
                                    fixture_copy(wt_result_find(result, name), &no_change), NULL));
    wt_result_free(result);
}

/* The bundled case against the same disc, and a growing layer against a running-in. */
static inline void fixture_validation(wt_case *read)
{
    wt_case *growing = NULL;
    fixture_held(read, WT_SOURCE_DIR "/fixtures/record/steps.csv", "validation validation_sources");
    fixture_check(wt_case_read(WT_SOURCE_DIR "/fixtures/growth/case.xml", &growing, NULL));
    fixture_held(growing, WT_SOURCE_DIR "/fixtures/growth/record.csv",
                 "validation_running_in validation_course");
    wt_case_free(growing);
}

/* Adds a table of another case. */
static inline void fixture_of_case(const char *name, const char *asked)
{
    char path[256];
    const fixture_change no_change = {.table = NULL};
    wt_run_options few = wt_run_defaults();
    few.replicates = 3;
    wt_case *other = NULL;
    wt_result *result = NULL;
    size_t failed = 0;
    snprintf(path, sizeof path, WT_SOURCE_DIR "/fixtures/%s/case.xml", name);
    fixture_check(wt_case_read(path, &other, NULL));
    fixture_check(wt_case_request_tables(other, asked, NULL));
    fixture_check(wt_run_case(other, &few, NULL, &result, &failed, NULL));
    fixture_check(
        wt_result_add(fixture_case, fixture_copy(wt_result_find(result, asked), &no_change), NULL));
    wt_result_free(result);
    wt_case_free(other);
}

/* Tables that a case has only on request. */
static inline void fixture_accuracy(wt_case *read)
{
    size_t failed = 0;
    wt_result *asked = NULL;
    wt_run_options few = wt_run_defaults();
    const fixture_change no_change = {.table = "error_budget"};
    static const char *const names[] = {"error_budget", "work_precision", "relaxation_spectrum",
                                        "prony_reduced", "influences"};
    few.replicates = 3;
    few.precision.repeats = 1;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        fixture_check(wt_case_request_tables(read, names[i], NULL));
        fixture_check(wt_run_case(read, &few, NULL, &asked, &failed, NULL));
        fixture_check(wt_result_add(
            fixture_case, fixture_copy(wt_result_find(asked, names[i]), &no_change), NULL));
        wt_result_free(asked);
    }
    fixture_of_case("transverse", "transverse_isotropy");
    fixture_of_case("decades", "friction_decades");
    fixture_of_case("layer", "identification");
}

/* The same without replicates. */
static inline void fixture_no_pair(wt_table *copy, size_t row)
{
    (void)row;
    fixture_put(copy, "correlation", (double)NAN);
}

/* Output of the case, as that of a sample and a condition. */
static inline wt_result *fixture_labelled(const char *sample, const char *condition, double ratio,
                                          double error)
{
    static const char *const names[] = {
        "answer", "comparison",        "modulus_rate",     "modulus_budget",    "friction",
        "layer",  "force_indentation", "indentation/bulk", "indentation/track", "identification",
        "ramp"};
    const fixture_change no_change = {.table = "answer"},
                         no_pair = {.table = "identification", .edit = fixture_no_pair};
    wt_result *labelled = wt_result_new();
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const wt_table *table = wt_result_find(fixture_case, names[i]);
        const bool vague = error > 0.1 && strcmp(names[i], "identification") == 0;
        wt_table *copy = table != NULL ? fixture_copy(table, vague ? &no_pair : &no_change) : NULL;
        if (copy == NULL)
            continue; /* some cases state no error of the cantilever */
        if (i == 0) {
            fixture_check(wt_table_set_key(copy, "case_sample", sample, NULL));
            fixture_check(wt_table_set_key(copy, "case_condition", condition, NULL));
        }
        if (i == 1)
            fixture_key(copy, "modulus_ratio", ratio, error * ratio, "1");
        fixture_check(wt_result_add(labelled, copy, NULL));
    }
    wt_table *wear = NULL;
    table_writer w = table_begin(&wear_schema, NULL);
    wear_set_value(&w, WEAR_KEY_RATE, 1e-12, error < 0.1 ? 1e-13 : 0, 0);
    fixture_check(table_end(&w, &wear));
    fixture_check(wt_result_add(labelled, wear, NULL));
    return labelled;
}

/* Two samples at two conditions, side by side: one pair differs, one does not, one is inconclusive.
 * One wear rate has no error. */
static inline void fixture_collect(wt_collection_tables *tables)
{
    static const struct {
        const char *sample, *condition;
        double ratio, error;
    } of[] = {{"HC", "mild", 0.9, 0.02},
              {"HC", "severe", 0.6, 0.02},
              {FIXTURE_EVIL, "mild", 0.8, 0.15},
              {FIXTURE_EVIL, "severe", 0.6, 0.02}};
    enum { CASES = sizeof of / sizeof of[0] };
    const wt_collect_job job = wt_collect_job_defaults();
    wt_collected_result cases[CASES];
    wt_result *results[CASES];
    for (size_t i = 0; i < CASES; i++) {
        results[i] = fixture_labelled(of[i].sample, of[i].condition, of[i].ratio, of[i].error);
        cases[i] = (wt_collected_result){results[i], "case.h5"};
    }
    fixture_check(wt_collection_compute(cases, CASES, &job, tables, NULL));
    for (size_t i = 0; i < CASES; i++)
        wt_result_free(results[i]);
}

static inline void fixture_collection(void)
{
    wt_collection_tables tables = {0};
    fixture_collect(&tables);
    fixture_check(wt_result_add(fixture_case, tables.collection, NULL));
    fixture_check(wt_result_add(fixture_case, tables.collected_modulus, NULL));
    fixture_check(wt_result_add(fixture_case, tables.collected_friction, NULL));
    fixture_check(wt_result_add(fixture_case, tables.collected_ramp, NULL));
    fixture_check(wt_result_add(fixture_case, tables.collected_force, NULL));
    fixture_check(wt_result_add(fixture_case, tables.ratio_pairs, NULL));
}

/* The case is run once in each program. */
static inline const wt_result *fixture_produced(void)
{
    if (fixture_case == NULL) {
        wt_case *read = NULL;
        size_t failed = 0;
        fixture_check(wt_case_read(WT_SOURCE_DIR "/fixtures/case/stated-road.xml", &read, NULL));
        fixture_check(wt_run_case(read, NULL, NULL, &fixture_case, &failed, NULL));
        fixture_check(failed == 0 ? WT_OK : WT_E_INTERNAL);
        fixture_accuracy(read);
        fixture_curves();
        fixture_ramp();
        fixture_collection();
        fixture_payne();
        fixture_record();
        fixture_validation(read);
        fixture_softening();
        fixture_flash();
        fixture_surface();
        wt_case_free(read);
        (void)atexit(fixture_free);
    }
    return fixture_case;
}

/* Copies a result with changes; free it with wt_result_free. */
static inline wt_result *fixture_changed(const wt_result *result, const fixture_change *changes,
                                         size_t n_changes)
{
    wt_result *copy = wt_result_new();
    size_t length = 0;
    const char *xml = wt_result_case(result, &length);
    if (copy == NULL)
        abort();
    for (size_t i = 0; i < wt_result_n_tables(result); i++) {
        const wt_table *table = wt_result_table(result, i);
        fixture_change change = {.table = NULL};
        for (size_t k = 0; k < n_changes; k++)
            if (strcmp(changes[k].table, wt_table_name(table)) == 0)
                change = changes[k];
        if (!change.leave_out)
            fixture_add(copy, fixture_copy(table, &change));
    }
    if (xml != NULL)
        wt_result_set_case(copy, xml, length);
    return copy;
}

/* The result with one change. */
static inline wt_result *fixture_with(const fixture_change *change)
{
    return fixture_changed(fixture_produced(), change, 1);
}

/* Some of the tables, all with the same change. */
static inline wt_result *fixture_only(const char *const *names, size_t n,
                                      const fixture_change *change)
{
    wt_result *result = wt_result_new();
    if (result == NULL)
        abort();
    for (size_t i = 0; i < n; i++)
        fixture_add(result, fixture_copy(wt_result_find(fixture_produced(), names[i]), change));
    return result;
}

/* ---- all tables ------------------------------------------------------------------------------ */

/* One file of each group, so that its curves are a map. */
static inline bool fixture_first_file(const wt_table *table, size_t row)
{
    const size_t file = (size_t)wt_table_find(table, "file");
    return strcmp(wt_table_text(table, row, file), wt_table_text(table, 0, file)) == 0;
}

static inline void fixture_spoil_curve(wt_table *table, size_t row)
{
    if (strcmp(wt_table_name(table), "indentation/track") == 0)
        fixture_text(table, "file", FIXTURE_EVIL);
    if (row % 9 != 4)
        return;
    fixture_text(table, "verdict", "poor_fit");
    fixture_text(table, "reason", "R^2 0.71 below 0.90 <i>");
    fixture_put(table, "modulus", (double)NAN);
}

static inline void fixture_name_curve(wt_table *table)
{
    fixture_words(table, "curve_track", FIXTURE_EVIL " curve 7");
}

/* The errors of friction are set: 0.002 % of the hysteresis, 4 % extrapolated. */
static inline void fixture_know_errors(wt_table *table, size_t row)
{
    const size_t hysteresis = (size_t)wt_table_find(table, "hysteresis");
    fixture_put(table, "hysteresis_numerical_error",
                2e-5 * wt_table_number(table, row, hysteresis));
    fixture_put(table, "extrapolated_share", row == 3 ? 0.04 : 0.01);
}

/* As if the isotherms were of steps: 1 + 0.01 i of the storage modulus, and its inverse. */
static const char *const fixture_relaxation[] = {"relaxation_modulus", "own_relaxation",
                                                 "fitted_relaxation", "fitted_relaxation_low",
                                                 "fitted_relaxation_high"};
static const char *const fixture_creep[] = {"creep_compliance", "own_creep", "fitted_creep",
                                            "fitted_creep_low", "fitted_creep_high"};
enum { FIXTURE_STEP_COLUMNS = sizeof fixture_creep / sizeof *fixture_creep };

static inline void fixture_begin_steps(wt_table *table)
{
    fixture_check(wt_table_add_column(table, "time", "s", "reduced time", NULL));
    fixture_check(wt_table_add_column(table, "own_time", "s", "time", NULL));
    for (int i = 0; i < FIXTURE_STEP_COLUMNS; i++) {
        fixture_check(wt_table_add_column(table, fixture_relaxation[i], "Pa", "modulus", NULL));
        fixture_check(wt_table_add_column(table, fixture_creep[i], "1/Pa", "compliance", NULL));
    }
}

static inline double fixture_cell(const wt_table *table, size_t row, const char *column)
{
    return wt_table_number(table, row, (size_t)wt_table_find(table, column));
}

static inline void fixture_add_steps(wt_table *table, size_t row)
{
    const double storage = fixture_cell(table, row, "storage_modulus");
    fixture_put(table, "time", 1 / fixture_cell(table, row, "angular_frequency"));
    fixture_put(table, "own_time", 1 / fixture_cell(table, row, "own_frequency"));
    for (int i = 0; i < FIXTURE_STEP_COLUMNS; i++) {
        fixture_put(table, fixture_relaxation[i], storage * (1 + 0.01 * i));
        fixture_put(table, fixture_creep[i], (1 + 0.01 * i) / storage);
    }
}

static inline void fixture_leave_undetermined(wt_table *table, size_t row)
{
    if (row == 0)
        fixture_put(table, "determined", 0);
}

static inline void fixture_extrapolate(wt_table *table, size_t row)
{
    fixture_put(table, "extrapolated", row == 0);
}

static inline void fixture_spoil_answer(wt_table *table, size_t row)
{
    if (row == 0)
        fixture_text(table, "answer", "File " FIXTURE_EVIL " has no positions.");
}

static inline void fixture_name_case(wt_table *table)
{
    fixture_words(table, "case_title", "EPDM, severe <case>");
}

static inline void fixture_spoil_input(wt_table *table, size_t row)
{
    if (row == 1)
        fixture_text(table, "path", FIXTURE_EVIL);
}

static inline void fixture_fail(wt_table *table)
{
    fixture_check(wt_table_add_row(table, NULL));
    fixture_text(table, "file", "track/broken.jpk-force");
    fixture_text(table, "message",
                 "file is damaged: \"segments/0\" ends after 12 of 2048 bytes "
                 "\x01\xff & <script>alert(1)</script>");
}

static inline void fixture_note(wt_table *table)
{
    fixture_check(wt_table_add_row(table, NULL));
    fixture_text(table, "severity", "warning");
    fixture_text(table, "file", FIXTURE_EVIL);
    fixture_text(table, "place", "segments/1");
    fixture_text(table, "text", "no spring constant; the user's value is used");
    fixture_put(table, "count", 36);
}

static inline void fixture_leave_out_stage(wt_table *table, size_t row)
{
    if (row != 0)
        return;
    fixture_put(table, "runs", 0);
    fixture_text(table, "reason", "left out: nothing asked for it");
}

/* Every table, with data for every figure and every part of the page. */
static inline wt_result *fixture_result(void)
{
    static const fixture_change changes[] = {
        {"indentation/bulk", .keep = fixture_first_file, .edit = fixture_spoil_curve},
        {"indentation/track", .keep = fixture_first_file, .edit = fixture_spoil_curve},
        {"force_displacement", .finish = fixture_name_curve},
        {"friction", .edit = fixture_know_errors},
        {"shift_factors", .edit = fixture_leave_undetermined},
        {"master_curve", .begin = fixture_begin_steps, .edit = fixture_add_steps},
        {"dma_comparison", .edit = fixture_extrapolate},
        {"answer", .edit = fixture_spoil_answer, .finish = fixture_name_case},
        {"inputs", .edit = fixture_spoil_input},
        {"failures", .finish = fixture_fail},
        {"notes", .finish = fixture_note},
        {"cost", .edit = fixture_leave_out_stage},
    };
    static const char xml[] = "<?xml version=\"1.0\"?>\n<case title=\"HC &amp; severe\">\n"
                              "  <sliding pressure=\"0.4 MPa\"/>\n</case>\n";
    wt_result *result =
        fixture_changed(fixture_produced(), changes, sizeof changes / sizeof *changes);
    wt_result_set_case(result, xml, sizeof xml - 1);
    char program[] = "weartrack", run[] = "run", path[] = "<case>.xml";
    char *const command[] = {program, run, path, NULL};
    wt_provenance_set_command(wt_result_provenance(result), 3, command);
    return result;
}

#endif
