/* Error against run time, and the error budget of a sliding contact.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cells.h"
#include "sliding.h"
#include "truth.h"
#include "weartrack/study.h"

#include "job/random_draws.h"
#include "study/coverage_share.h"
#include "study/parametric_bootstrap.h"

/* ---- numerical parts ------------------------------------------------------------------------- */

static wt_table *sweep(const char *part)
{
    wt_accuracy_job job = wt_accuracy_job_defaults();
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    work = wt_job_defaults();
    job.part = part;
    job.repeats = 1;
    if (wt_accuracy_compute(&job, &work, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    return table;
}

/* What a method states is no less than its error, as far as the reference tells. */
static void test_stated_errors(void **state)
{
    (void)state;
    static const char *const parts[] = {"contact-force",  "angular-integrals",   "friction-prony",
                                        "friction-zener", "friction-transverse", "friction-table",
                                        "layer-balance",  "layer-history"};
    for (size_t p = 0; p < sizeof parts / sizeof *parts; p++) {
        wt_table *table = sweep(parts[p]);
        double textbook = 1, ours = 1;
        for (size_t i = 0; i < wt_table_n_rows(table); i++) {
            const double error = number_cell(table, i, "true_error"),
                         stated = number_cell(table, i, "stated_error"),
                         reference = number_cell(table, i, "reference_error");
            const bool is_textbook = strcmp(text_cell(table, i, "method"), "textbook") == 0;
            assert_true(number_cell(table, i, "seconds") > 0);
            assert_true(reference < 1e-11);
            if (!is_textbook && error > stated + reference)
                fail_msg("%s, %s %g: error %g, stated %g", parts[p], text_cell(table, i, "setting"),
                         number_cell(table, i, "value"), error, stated);
            double *least = is_textbook ? &textbook : &ours;
            *least = fmin(*least, error);
        }
        /* the problems are the same: the textbook comes near to it */
        assert_true(textbook < 1e-4);
        assert_true(ours < 1e-11);
        wt_table_free(table);
    }
}

/* Simpson's rule at 32 places from 1e2 to 1e11 rad/s, the exact integrals by adaptive quadrature
 * with 20 digits, in Python with mpmath. */
static void test_angles_of_the_textbook(void **state)
{
    (void)state;
    static const struct {
        double intervals, error;
    } known[] = {{10, 0.030060886826}, {30, 0.0091835510741}, {100, 0.0023417165064}};
    wt_table *table = sweep("angular-integrals");
    size_t found = 0;
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        if (strcmp(text_cell(table, i, "method"), "textbook") != 0)
            continue;
        for (size_t k = 0; k < sizeof known / sizeof *known; k++)
            if (number_cell(table, i, "value") == known[k].intervals) {
                assert_near(number_cell(table, i, "true_error"), known[k].error, 1e-8);
                found++;
            }
    }
    assert_int_equal(found, sizeof known / sizeof *known);
    wt_table_free(table);
}

static void test_what_is_estimated(void **state)
{
    (void)state;
    wt_table *table = sweep("draws");
    const size_t last = wt_table_n_rows(table) - 2; /* then the law of propagation */
    assert_near(number_cell(table, last, "stated_error"), 1 / sqrt(2 * 4095), 1e-12);
    assert_true(number_cell(table, last, "true_error") < 0.04);
    /* sinh(s)/s - 1 is s^2/6, and the truth s (1 + 3/4 s^2) */
    assert_near(number_cell(table, last + 1, "true_error"), 0.01 * (0.75 - 1 / 6.), 0.02);
    wt_table_free(table);
}

/* The spectrum: off by what it says, within the noise of 0.5 %; so many terms at fixed times as the
 * noise bears are less close. */
static void test_spectrum(void **state)
{
    (void)state;
    wt_table *table = sweep("spectrum");
    double textbook = 1;
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        const double error = number_cell(table, i, "true_error"),
                     stated = number_cell(table, i, "stated_error");
        if (strcmp(text_cell(table, i, "method"), "textbook") == 0) {
            textbook = fmin(textbook, error);
            continue;
        }
        assert_true(error < 0.005);
        assert_true(error < 2 * stated && error > stated / 4);
    }
    assert_true(textbook > 0.005 && textbook < 0.2);
    wt_table_free(table);
}

static void test_no_such_part(void **state)
{
    (void)state;
    wt_accuracy_job job = wt_accuracy_job_defaults();
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    work = wt_job_defaults();
    job.part = "luck";
    assert_int_equal(wt_accuracy_compute(&job, &work, &table, &err), WT_E_NOT_FOUND);
    assert_non_null(strstr(err.expected, "friction-prony"));
    assert_null(table);
}

/* ---- budget ---------------------------------------------------------------------------------- */

static double relative(const wt_table *table, const char *number, const char *source)
{
    for (size_t i = 0; i < wt_table_n_rows(table); i++)
        if (strcmp(text_cell(table, i, "number"), number) == 0 &&
            strcmp(text_cell(table, i, "source"), source) == 0)
            return number_cell(table, i, "relative_error");
    fail_msg("no row %s, %s", number, source);
    return 0;
}

/* The standard error that a run with this source alone states. */
static double alone(const wt_sliding *of)
{
    wt_friction_tables tables = {0};
    assert_int_equal(wt_sliding_friction_compute(of, NULL, &work, &tables, NULL), WT_OK);
    const wt_estimate e = key_estimate(tables.friction, "friction_at_reference");
    wt_friction_tables_clear(&tables);
    return e.standard_error / e.value;
}

/* "The choice of the X moves it by -76 % to +345 %": as the table of the choices has it. */
static void check_reach(const char *advice, const wt_table *what_if, const char *change)
{
    static const char of[] = "The choice of the ", by[] = " moves it by ", to[] = " % to ";
    const char *choice = strstr(advice, of), *number = strstr(advice, by);
    assert_true(choice != NULL && number != NULL);
    choice += strlen(of);
    double low = 0, high = 0;
    for (size_t i = 1; i < wt_table_n_rows(what_if); i++) {
        const char *name = text_cell(what_if, i, "choice");
        if (strlen(name) != (size_t)(number - choice) ||
            strncmp(name, choice, (size_t)(number - choice)) != 0)
            continue;
        low = fmin(low, number_cell(what_if, i, change));
        high = fmax(high, number_cell(what_if, i, change));
    }
    assert_true(high > low);
    char *end;
    assert_near_abs(strtod(number + strlen(by), &end), 100 * low, 0.51);
    assert_int_equal(strncmp(end, to, strlen(to)), 0);
    assert_near_abs(strtod(end + strlen(to), NULL), 100 * high, 0.51);
}

/* What a stated error does is a line of the draws: another seed moves it by 2 % (rms), for what is
 * not straight; the scatter of the draws alone would move it by 5 %, and eight by 14 % from the
 * least to the largest. */
static void test_seeds(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    double low = (double)INFINITY, high = 0;
    const uint64_t before = work.seed;
    sliding.pressure.standard_error = 0;
    for (work.seed = 1; work.seed <= 8; work.seed++) {
        const double one = alone(&sliding);
        low = fmin(low, one);
        high = fmax(high, one);
    }
    work.seed = before;
    assert_true(low > 0);
    assert_near_abs(high / low, 1, 0.08);
}

static void test_one_source_at_a_time(void **state)
{
    (void)state;
    static const char number[] = "friction coefficient";
    sliding_set_up_uncertain();
    wt_table *what_if = NULL, *table = NULL;
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &what_if, NULL),
                     WT_OK);
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, what_if, &work, &table, NULL),
                     WT_OK);
    wt_sliding pressure = sliding, shear = sliding;
    pressure.shear_stress.standard_error = 0;
    shear.pressure.standard_error = 0;
    assert_near(relative(table, number, "pressure"), alone(&pressure), 1e-12);
    assert_near(relative(table, number, "shear stress"), alone(&shear), 1e-12);
    assert_near(relative(table, number, "all together"), alone(&sliding), 1e-12);
    /* mu_adhesion is 5e6 A/A0 / p, and its share of mu has the 10 % of the shear stress */
    assert_true(relative(table, number, "shear stress") < 0.12);
    assert_near(relative(table, number, "number of replicates"),
                alone(&sliding) / sqrt(2 * ((double)work.replicates - 1)), 1e-12);
    /* half the range of the what-if table */
    double low = number_cell(what_if, 0, "friction"), used = low, high = low;
    for (size_t i = 1; i < wt_table_n_rows(what_if); i++)
        if (strcmp(text_cell(what_if, i, "choice"), "largest wavenumber q1") == 0) {
            low = fmin(low, number_cell(what_if, i, "friction"));
            high = fmax(high, number_cell(what_if, i, "friction"));
        }
    assert_near(relative(table, number, "largest wavenumber q1"), (high - low) / 2 / used, 1e-12);
    /* shares are those of the variance; without timing two tables are the same */
    double sum = 0;
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        assert_true(isnan(number_cell(table, i, "seconds")));
        if (strcmp(text_cell(table, i, "number"), number) == 0 &&
            strcmp(text_cell(table, i, "kind"), "measured") == 0)
            sum += number_cell(table, i, "share");
    }
    assert_near(sum, 1, 1e-12);
    assert_string_equal(wt_table_key(table, "excluded_errors"), "material, temperature, roughness");
    assert_non_null(strstr(wt_table_key(table, "friction_advice"), "shear stress"));
    check_reach(wt_table_key(table, "hysteresis_advice"), what_if, "hysteresis_change");
    wt_table_free(what_if);
    wt_table_free(table);
}

/* Of a measured surface its scatter and its law are one source, and in no other. What one per cent
 * of each does is there if it is asked for. */
static void test_measured_surface(void **state)
{
    (void)state;
    static const char number[] = "friction coefficient";
    double q[] = {1e3, 4e3, 1e6, 4e6}, c[] = {1e-16, 5e-17, 1e-24, 1e-26},
           modes[] = {0.5, 0.3, 0.1, 0}, law[] = {0, 0, 0, 0.3};
    wt_table *table = NULL;
    sliding_set_up_uncertain();
    surface = (wt_surface){.q0 = 1e3, .q1 = 4e6, .c0 = {1, 0, 0, "1"}};
    surface.spectrum = (wt_power_spectrum){.n = 4, .wavenumber = q, .density = c};
    surface.modes_error = modes;
    surface.law_error = law;
    sliding.shear_stress.standard_error = 0;
    wt_surface without = surface;
    without.modes_error = without.law_error = NULL;
    wt_sliding pressure = sliding, roughness = sliding;
    pressure.surface = &without;
    roughness.pressure.standard_error = 0;
    sliding.sensitivities = true;
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, NULL, &work, &table, NULL),
                     WT_OK);
    assert_near(relative(table, number, "pressure"), alone(&pressure), 1e-12);
    assert_near(relative(table, number, "roughness"), alone(&roughness), 1e-12);
    assert_null(strstr(wt_table_key(table, "excluded_errors"), "roughness"));
    wt_friction_tables f = {0};
    assert_int_equal(wt_sliding_friction_compute(&sliding, NULL, &work, &f, NULL), WT_OK);
    size_t n = 0;
    for (size_t i = 0; i < wt_table_n_rows(table); i++)
        if (strcmp(text_cell(table, i, "kind"), "one per cent") == 0) {
            n++;
            if (strcmp(text_cell(table, i, "source"), "1 % of the largest wavenumber q1") == 0)
                assert_near(number_cell(table, i, "relative_error"),
                            0.01 * fabs(key_estimate(f.friction, "sensitivity_to_cutoff").value),
                            1e-9);
        }
    assert_int_equal(n, 4);
    wt_friction_tables_clear(&f);
    wt_table_free(table);
}

/* With times every row of the budget has its own, those of the choices of the model too, and all
 * else is the same. */
static void test_seconds(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    wt_table *what_if = NULL, *plain = NULL, *timed = NULL;
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &what_if, NULL),
                     WT_OK);
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, what_if, &work, &plain, NULL),
                     WT_OK);
    wt_table_free(what_if);
    work.cost = wt_cost_new(true, 1);
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &what_if, NULL),
                     WT_OK);
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, what_if, &work, &timed, NULL),
                     WT_OK);
    assert_int_equal(wt_table_n_rows(timed), wt_table_n_rows(plain));
    size_t model = 0;
    for (size_t i = 0; i < wt_table_n_rows(timed); i++) {
        model += strcmp(text_cell(timed, i, "kind"), "model") == 0;
        assert_true(number_cell(timed, i, "seconds") > 0);
        assert_true(isnan(number_cell(plain, i, "seconds")));
        assert_near(number_cell(timed, i, "relative_error"),
                    number_cell(plain, i, "relative_error"), 0);
    }
    assert_true(model > 0);
    wt_cost_free(work.cost);
    wt_table_free(what_if);
    wt_table_free(plain);
    wt_table_free(timed);
}

/* What does not move a number has no row of it. */
static void test_nothing_stated(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    wt_table *table = NULL;
    sliding.pressure.standard_error = sliding.shear_stress.standard_error = 0;
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, NULL, &work, &table, NULL),
                     WT_OK);
    for (size_t i = 0; i < wt_table_n_rows(table); i++)
        assert_string_equal(text_cell(table, i, "kind"), "numerical");
    assert_non_null(strstr(wt_table_key(table, "friction_advice"), "No error"));
    wt_table_free(table);
    /* the choices of the model are said all the same */
    wt_table *what_if = NULL;
    assert_int_equal(wt_model_sensitivity_compute(&sliding, NULL, NULL, &work, &what_if, NULL),
                     WT_OK);
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, NULL, what_if, &work, &table, NULL),
                     WT_OK);
    assert_non_null(strstr(wt_table_key(table, "friction_advice"), "no error is known beside it"));
    wt_table_free(what_if);
    wt_table_free(table);
}

/* A ratio without an error is no source of one. */
static void test_exact_ratio(void **state)
{
    (void)state;
    const wt_layer_observation known = {.thickness = {5e-6, 0, 0, "m"},
                                        .modulus_ratio = {0.6, 0, 0, "1"}};
    sliding_set_up_uncertain();
    wt_table *table = NULL;
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, &known, NULL, &work, &table, NULL),
                     WT_OK);
    assert_true(relative(table, "friction coefficient with layer", "pressure") > 0);
    assert_non_null(strstr(wt_table_key(table, "excluded_errors"), "modulus ratio"));
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        assert_string_not_equal(text_cell(table, i, "source"), "modulus ratio");
        assert_string_not_equal(text_cell(table, i, "source"), "stated error");
        assert_string_not_equal(text_cell(table, i, "source"), "calibration");
    }
    wt_table_free(table);
}

/* The scatter of the spots and what is known of their calibration are parts of one variance. */
static void test_calibration(void **state)
{
    (void)state;
    static const char number[] = "friction coefficient with layer";
    const wt_layer_observation known = {.thickness = {5e-6, 0, 0, "m"},
                                        .modulus_ratio = {0.6, 0.06, 0, "1"},
                                        .calibration_share = 0.36};
    sliding_set_up_uncertain();
    wt_table *table = NULL;
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, &known, NULL, &work, &table, NULL),
                     WT_OK);
    const double spots = relative(table, number, "modulus ratio"),
                 calibration = relative(table, number, "calibration");
    assert_near(calibration / spots, 0.6 / 0.8, 0.02);
    /* of the ratio itself the parts are known: 0.1 in all, its arithmetic without curves is not */
    assert_near(relative(table, "modulus ratio", "stated error"), 0.08, 1e-12);
    assert_near(relative(table, "modulus ratio", "calibration"), 0.06, 1e-12);
    assert_near(relative(table, "modulus ratio", "all together"), 0.1, 1e-12);
    assert_non_null(strstr(wt_table_key(table, "modulus_ratio_advice"), "64 %"));
    assert_null(strstr(wt_table_key(table, "modulus_ratio_advice"), "arithmetic"));
    assert_null(strstr(wt_table_key(table, "excluded_errors"), "calibration"));
    wt_table_free(table);
}

static wt_layer_observation with_slope(double slope, double error)
{
    return (wt_layer_observation){.thickness = {5e-6, 0, 0, "m"},
                                  .modulus_ratio = {0.6, 0, 0, "1"},
                                  .ratio_slope = {slope, error, 0, "1"},
                                  .ratio_frequency = 1e3,
                                  .ratio_lowest = 10,
                                  .ratio_highest = 1e5,
                                  .ratio_temperature = (double)NAN};
}

/* A slope is a source by itself, and no other row has its error. */
static void test_slope(void **state)
{
    (void)state;
    static const char number[] = "friction coefficient with layer",
                      slope[] = "slope of the modulus ratio";
    wt_layer_observation known = with_slope(0.1, 0);
    wt_table *exact = NULL, *table = NULL;
    sliding_set_up_uncertain();
    work.replicates = 16;
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, &known, NULL, &work, &exact, NULL),
                     WT_OK);
    assert_non_null(strstr(wt_table_key(exact, "excluded_errors"), slope));
    known.ratio_slope.standard_error = 0.05;
    assert_int_equal(wt_error_budget_compute(&sliding, NULL, &known, NULL, &work, &table, NULL),
                     WT_OK);
    assert_true(relative(table, number, slope) > 0.001);
    assert_near(relative(table, number, "pressure"), relative(exact, number, "pressure"), 1e-12);
    wt_table_free(exact);
    wt_table_free(table);
}

/* ---- coverage -------------------------------------------------------------------------------- */

static const wt_layer_observation *covered; /* of the layer, or NULL */

static wt_table *cover(size_t trials, unsigned threads)
{
    const wt_coverage_job job = {.sliding = &sliding, .known = covered, .trials = trials};
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    work.threads = threads;
    if (wt_coverage_compute(&job, &work, &table, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    return table;
}

/* The slope of a trial is another one: nothing else of this layer is uncertain. */
static void test_cover_slope(void **state)
{
    (void)state;
    const wt_layer_observation known = with_slope(0.1, 0.05);
    sliding_set_up_uncertain();
    sliding.pressure.standard_error = sliding.shear_stress.standard_error = 0;
    work.replicates = 8;
    covered = &known;
    wt_table *table = cover(8, 2);
    covered = NULL;
    assert_string_equal(wt_table_key(table, "regenerated"),
                        "material as given, slope of the modulus ratio");
    const size_t row = row_where(table, "number", "friction coefficient with layer");
    const double scatter = number_cell(table, row, "scatter"); /* nan or 0 if it were held */
    assert_true(scatter > 0.3 && scatter < 3);
    wt_table_free(table);
}

/* The friction scatters over the trials as it says, and the share is what is stated. */
static void test_coverage(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    wt_table *table = cover(400, 1), *again = cover(400, 3);
    const size_t row = row_where(table, "number", "friction coefficient");
    assert_int_equal(wt_table_n_rows(table), 3); /* no layer, no isotherms, no groups */
    assert_near(number_cell(table, row, "trials"), 400, 1e-12);
    assert_true(fabs(number_cell(table, row, "scatter") - 1) < 0.15);
    assert_true(fabs(number_cell(table, row, "within_one") - 0.683) < 0.09);
    assert_true(number_cell(table, row, "low") < 0.95 && number_cell(table, row, "high") > 0.92);
    assert_string_equal(text_cell(table, row, "verdict"), "holds");
    assert_non_null(strstr(wt_table_key(table, "limitations"), "cannot reveal a wrong model"));
    assert_string_equal(wt_table_key(table, "regenerated"),
                        "material as given, pressure, shear stress");
    for (size_t i = 0; i < 3; i++)
        assert_near(number_cell(again, i, "scatter"), number_cell(table, i, "scatter"), 1e-12);
    wt_table_free(table);
    wt_table_free(again);
}

/* Verdicts against chances reckoned with a table of the binomial distribution: of 1 trial a miss is
 * nothing, of 10 three are one in 90, five one in 15,700. */
static void test_verdicts_of_shares(void **state)
{
    (void)state;
    static const struct {
        double misses;
        size_t n;
        const char *verdict;
    } cases[] = {{1, 1, "cannot say"},
                 {0, 1, "cannot say"},
                 {3, 10, "cannot say"},
                 {5, 10, "too narrow"},
                 {0, 20, "cannot say"},
                 {0, 100, "holds"},
                 {0, 116, "holds"},
                 {0, 117, "too wide"},
                 {20, 400, "holds"},
                 {37, 400, "too narrow"},
                 {2.5, 10, "cannot say"},
                 {3, 100, "holds"},
                 /* within 92 to 98 %, however well that is known */
                 {300, 10000, "holds"},
                 {199, 10000, "too wide"},
                 {201, 10000, "holds"},
                 {799, 10000, "holds"},
                 {801, 10000, "too narrow"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double n = (double)cases[i].n;
        const coverage_share s = coverage_assess(1 - cases[i].misses / n, cases[i].n);
        if (strcmp(s.verdict, cases[i].verdict) != 0)
            fail_msg("%g of %g: %s", cases[i].misses, n, s.verdict);
        assert_int_equal(isnan(s.trials), strcmp(s.verdict, "cannot say") != 0);
        if (!isnan(s.trials)) /* they do tell */
            assert_string_not_equal(
                coverage_assess(1 - cases[i].misses / n, (size_t)s.trials).verdict, "cannot say");
    }
}

/* What states no error has no interval to be judged. */
static void test_nothing_to_cover(void **state)
{
    (void)state;
    sliding_set_up_uncertain();
    sliding.pressure.standard_error = sliding.shear_stress.standard_error = 0;
    wt_table *table = cover(3, 1);
    assert_int_equal(wt_table_n_rows(table), 0);
    assert_non_null(strstr(wt_table_key(table, "answer"), "none was stated"));
    wt_table_free(table);
}

/* Shifts that are given are given in every trial, and a modulus that was not measured is not. */
static void test_isotherms_again(void **state)
{
    (void)state;
    enum { ISOTHERMS = 5, POINTS = 16 };
    wt_sweep sweep = {0}, again = {0};
    wt_master fit = {0};
    wt_master_options options = wt_master_options_defaults();
    wt_error err = WT_ERROR_INIT;
    double shift[ISOTHERMS];
    for (int i = 0; i < ISOTHERMS; i++) {
        wt_isotherm *iso = wt_sweep_add(&sweep, POINTS, 0);
        assert_non_null(iso);
        iso->temperature = 283.15 + 5 * i;
        iso->shift_is_stated = true;
        iso->stated_log_a = 1 - 0.5 * i;
        for (int j = 0; j < POINTS; j++) {
            const double omega = pow(10, -1 + 3.0 * j / (POINTS - 1)),
                         reduced = omega * pow(10, iso->stated_log_a),
                         noise = 0.002 * flow_draw_normal(3, (size_t)(i * POINTS + j), 0);
            iso->angular_frequency[j] = omega;
            iso->storage_modulus[j] = 1e6 * (1 + pow(reduced, 0.3)) * exp(noise);
            iso->loss_modulus[j] = (double)NAN;
        }
    }
    wt_sweep_sort(&sweep);
    options.vertical = WT_VERTICAL_NONE;
    options.shift_by = WT_SHIFT_STORAGE;
    if (wt_master_fit(&sweep, &options, NULL, &fit, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    assert_int_equal(fit.n_shifts, ISOTHERMS);
    assert_int_equal(bootstrap_sweep(&sweep, &fit, 4, &again, shift, NULL), WT_OK);
    assert_int_equal(again.n_isotherms, ISOTHERMS);
    for (int i = 0; i < ISOTHERMS; i++) {
        const wt_isotherm *was = &sweep.isotherms[i], *is = &again.isotherms[i];
        double square = 0;
        assert_true(is->shift_is_stated);
        assert_near(is->stated_log_a, was->stated_log_a, 0);
        assert_near(shift[i] - shift[0], was->stated_log_a - sweep.isotherms[0].stated_log_a,
                    1e-12);
        for (int j = 0; j < POINTS; j++) {
            assert_true(isnan(is->loss_modulus[j]));
            square += pow(log(is->storage_modulus[j] / was->storage_modulus[j]), 2);
        }
        assert_true(square > 0 && sqrt(square / POINTS) < 0.01);
    }
    /* the same draw with vertical shifts: a modulus is what the spectrum says over b */
    wt_sweep moved = {0};
    for (int i = 0; i < ISOTHERMS; i++)
        fit.shifts[i].log_b.value = 0.1 * i - 0.15;
    assert_int_equal(bootstrap_sweep(&sweep, &fit, 4, &moved, shift, NULL), WT_OK);
    for (int i = 0; i < ISOTHERMS; i++)
        for (int j = 0; j < POINTS; j++)
            assert_near(moved.isotherms[i].storage_modulus[j] * pow(10, 0.1 * i - 0.15),
                        again.isotherms[i].storage_modulus[j], 1e-12);
    wt_sweep_clear(&moved);
    wt_sweep_clear(&sweep);
    wt_sweep_clear(&again);
    wt_master_clear(&fit);
}

/* Spots and the curves on them scatter as they were found to. */
static void test_scatter_of_a_group(void **state)
{
    (void)state;
    enum { SPOTS = 40, CURVES = 10, N = SPOTS * CURVES };
    const long same[3] = {0, 0, 0};
    double modulus[N];
    long spot[N];
    scattered_group found, group = {.n = N, .spot = spot, .mean = log(3e6), .between = 0.2};
    group.within = 0.05;
    for (int i = 0; i < N; i++)
        spot[i] = i / CURVES;
    bootstrap_group(&group, 7, 0, modulus);
    assert_true(bootstrap_scatter(modulus, spot, N, 0, &found));
    assert_int_equal(found.n_spots, SPOTS);
    assert_true(fabs(found.mean - group.mean) < 0.1);
    assert_true(fabs(found.between - 0.2) < 0.07);
    assert_true(fabs(found.within - 0.05) < 0.007);
    assert_false(bootstrap_scatter(modulus, same, 3, 0, &found));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stated_errors),
        cmocka_unit_test(test_angles_of_the_textbook),
        cmocka_unit_test(test_what_is_estimated),
        cmocka_unit_test(test_spectrum),
        cmocka_unit_test(test_no_such_part),
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_one_source_at_a_time),
        cmocka_unit_test(test_measured_surface),
        cmocka_unit_test(test_seconds),
        cmocka_unit_test(test_nothing_stated),
        cmocka_unit_test(test_exact_ratio),
        cmocka_unit_test(test_calibration),
        cmocka_unit_test(test_slope),
        cmocka_unit_test(test_cover_slope),
        cmocka_unit_test(test_coverage),
        cmocka_unit_test(test_verdicts_of_shares),
        cmocka_unit_test(test_nothing_to_cover),
        cmocka_unit_test(test_isotherms_again),
        cmocka_unit_test(test_scatter_of_a_group),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
