/* Layer thickness that the curves allow: the bundled case, whose track is one rubber down to the
 * depth of its curves; the same with the residual of a layer; and inconclusive cases.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_fixture.h"

#include "assert_near.h"
#include "table_cells.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Mean residual of curves on a soft layer of 100 nm by the integral equation, a fifth of it, scaled
 * to another thickness. */
static const double wave[] = {1.513e-4, 6.242e-4, -5.172e-4, -1.915e-4, -3.442e-4, -8.22e-5};

static void add_waves(wt_table *copy, size_t row)
{
    for (size_t i = 0; i < sizeof wave / sizeof wave[0]; i++) {
        char name[32];
        snprintf(name, sizeof name, "misfit_wave_%zu", i + 1);
        fixture_put(copy, name, number_cell(copy, row, name) + wave[i]);
    }
}

static bool is_early(const wt_table *table, size_t row)
{
    (void)table;
    return row < 11;
}

static wt_table *track_layer(const fixture_change *of_track, double other, double error)
{
    wt_compare_job job = wt_compare_job_defaults();
    const wt_job work = wt_job_defaults();
    wt_table *made = NULL;
    wt_error err = WT_ERROR_INIT;
    const wt_table *const given = wt_result_find(fixture_case, "indentation/track");
    wt_table *const track = fixture_copy(given, of_track);
    job.bulk = wt_result_find(fixture_case, "indentation/bulk");
    job.track = track;
    job.expected_thickness = (wt_estimate){other, error, 0, "m"};
    if (wt_track_layer_compute(&job, NULL, &work, &made, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_table_free(track);
    return made;
}

static double key_of(const wt_table *t, const char *name)
{
    wt_estimate e = {(double)NAN, 0, 0, NULL};
    return wt_table_key(t, name) != NULL && wt_table_estimate(t, name, &e) ? e.value : (double)NAN;
}

static void begins(const wt_table *t, const char *key, const char *words)
{
    const char *said = wt_table_key(t, key);
    if (said == NULL || strncmp(said, words, strlen(words)) != 0)
        fail_msg("%s: %s", key, said != NULL ? said : "not said");
}

/* Below 0.3 of the bulk modulus, where no law of a layer is valid. */
static void soften(wt_table *copy, size_t row)
{
    static const char *const columns[] = {"modulus", "spectrum_factor"};
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        if (wt_table_find(copy, columns[i]) >= 0)
            fixture_put(copy, columns[i], 0.15 * number_cell(copy, row, columns[i]));
}

static const fixture_change as_it_is = {.table = "indentation/track"},
                            layered = {.table = "indentation/track", .edit = add_waves},
                            soft = {.table = "indentation/track", .edit = soften},
                            few = {.table = "indentation/track", .keep = is_early},
                            old = {.table = "indentation/track", .without = "misfit_wave_1"};

/* The truth is 3.16 um. */
static void test_one_limit(void **state)
{
    (void)state;
    wt_table *t = track_layer(&as_it_is, 3e-6, 0.3e-6);
    begins(t, "allowed", "at least ");
    begins(t, "agree", "inconclusive: the curves allow");
    begins(t, "settled_by", "contacts with a radius of ");
    const double low = key_of(t, "thickness_low");
    assert_true(low > 1e-7 && low < 3e-6);
    assert_true(isnan(key_of(t, "thickness_high")) && isnan(key_of(t, "thickness")));
    assert_true(key_of(t, "both_low") > 2e-6 && key_of(t, "both_high") < 4e-6);
    assert_true(isnan(key_of(t, "over_high")));
    assert_string_equal(text_cell(t, wt_table_n_rows(t) - 1, "curve"), "layer as given");
    wt_table_free(t);
    t = track_layer(&as_it_is, low / 3, 0.1 * low / 3);
    begins(t, "agree", "no: ");
    assert_null(wt_table_key(t, "settled_by"));
    assert_null(wt_table_key(t, "both_low"));
    wt_table_free(t);
}

static void test_both_limits(void **state)
{
    (void)state;
    wt_table *t = track_layer(&layered, 250e-9, 20e-9);
    const double at = key_of(t, "thickness"), low = key_of(t, "thickness_low"),
                 high = key_of(t, "thickness_high");
    assert_true(low > 100e-9 && low < at && at < high && high < 3e-6);
    begins(t, "agree", "inconclusive: the curves allow");
    assert_true(key_of(t, "both_low") > 190e-9 && key_of(t, "both_high") < 310e-9);
    /* transition to the bulk, from the modulus of the layer */
    assert_true(key_of(t, "layer_to_bulk") < 0.7 && key_of(t, "layer_to_bulk") > 0.5);
    wt_table_free(t);
    t = track_layer(&layered, 50e-9, 5e-9);
    begins(t, "agree", "no: ");
    wt_table_free(t);
    t = track_layer(&layered, 250e-9, (double)NAN);
    begins(t, "agree", "inconclusive: the error of");
    begins(t, "settled_by", "a standard error of the thickness by what is given");
    wt_table_free(t);
}

static void test_no_result(void **state)
{
    (void)state;
    wt_table *t = track_layer(&few, 3e-6, 0.3e-6);
    begins(t, "allowed", "inconclusive: 48 curves of the bulk and 11 of the track");
    begins(t, "agree", "inconclusive");
    wt_table_free(t);
    t = track_layer(&old, 3e-6, 0.3e-6);
    begins(t, "allowed", "inconclusive: the tables of bulk and track say nothing of depth");
    begins(t, "settled_by", "the same curves once more");
    wt_table_free(t);
    /* two tables without a result give none unless a thickness is stated */
    wt_compare_job job = wt_compare_job_defaults();
    const wt_job work = wt_job_defaults();
    wt_table *bulk = fixture_copy(wt_result_find(fixture_case, "indentation/bulk"), &old);
    wt_table *track = fixture_copy(wt_result_find(fixture_case, "indentation/track"), &old);
    wt_table *none = NULL;
    job.bulk = bulk;
    job.track = track;
    assert_int_equal(wt_track_layer_compute(&job, NULL, &work, &none, NULL), WT_OK);
    assert_null(none);
    wt_table_free(bulk);
    wt_table_free(track);
}

/* The layer of the fixture has 0.64 of the bulk modulus; the law does not extend to 0.15 of it. */
static void test_beyond_the_law(void **state)
{
    (void)state;
    wt_table *t = track_layer(&soft, 3e-6, 0.3e-6);
    begins(t, "allowed", "inconclusive: the law of a layer is known for moduli of 0.3 to 3 times");
    begins(t, "agree", "inconclusive: the curves do not determine");
    begins(t, "settled_by", "a section across the track");
    assert_true(isnan(key_of(t, "thickness_low")) && isnan(key_of(t, "thickness_high")));
    assert_null(wt_table_key(t, "both_low"));
    wt_table_free(t);
}

/* Where the law ends and the layer may be thinner, no thinner one is excluded; where it changes too
 * much, all are. */
static void test_below_the_law(void **state)
{
    (void)state;
    const double end = 100e-9, error = 0.1;
    wt_layer_profile p = {.bound_kind = WT_LAYER_BOUND_UPPER,
                          .n_steps = WT_LAYER_STEPS,
                          .thinner_allowed = true,
                          .smallest_thickness = end};
    for (size_t i = 0; i < p.n_steps; i++) {
        p.log_thickness[i] = log(end) + 4 - 4 * (double)i / (double)(p.n_steps - 1);
        p.deviate[i] = 3 + (p.log_thickness[i] - log(end)) / error;
    }
    const wt_interval thinner = {end / 2, 0, 0.4 * end, 0.6 * end};
    wt_layer_agreement a = wt_layer_compare(&p, thinner);
    assert_true(!a.differ && !a.agree);
    assert_near(a.high, 0.6 * end, 0.05);
    assert_true(a.ratio_low == 0);
    p.thinner_allowed = false;
    assert_true(wt_layer_compare(&p, thinner).differ);
    /* without a lower limit from the other source, and with undetermined curves, there is none */
    for (size_t i = 0; i < p.n_steps; i++)
        p.deviate[i] = 0;
    a = wt_layer_compare(&p, (wt_interval){end, 0, -end, 3 * end});
    assert_true(a.low == 0 && isfinite(a.high) && a.high > end);
}

/* A profile that is linear in ln of the thickness corresponds to a normal error of 10 %. */
static void test_agreement(void **state)
{
    (void)state;
    const double error = 0.1, at = log(1e-6);
    wt_layer_profile p = {.bound_kind = WT_LAYER_BOUND_BOTH, .n_steps = WT_LAYER_STEPS};
    for (size_t i = 0; i < p.n_steps; i++) {
        p.log_thickness[i] = at + 2 - 4 * (double)i / (double)(p.n_steps - 1);
        p.deviate[i] = (p.log_thickness[i] - at) / error;
    }
    const double other = 1.2e-6, reach = exp(1.959964 * error);
    const wt_layer_agreement a =
        wt_layer_compare(&p, (wt_interval){other, 0, other / reach, other * reach});
    assert_true(a.agree && !a.differ);
    const double half = 1.959964 * hypot(error, error);
    assert_near(log(a.ratio_low), -log(1.2) - half, 0.3); /* steps of 0.07 */
    assert_near(log(a.ratio_high), -log(1.2) + half, 0.6);
    assert_near(a.low, sqrt(1e-6 * other) * exp(-1.959964 * error / sqrt(2)), 0.02);
    assert_near(a.high, sqrt(1e-6 * other) * exp(1.959964 * error / sqrt(2)), 0.02);
    /* 0.364 of ln over 0.141 is beyond 99 %; less is not */
    const double far = 1e-6 * exp(0.38), near_by = 1e-6 * exp(0.34);
    assert_true(wt_layer_compare(&p, (wt_interval){far, 0, far / reach, far * reach}).differ);
    assert_false(
        wt_layer_compare(&p, (wt_interval){near_by, 0, near_by / reach, near_by * reach}).differ);
    /* without a lower limit no thinner layer is excluded */
    const wt_layer_agreement open = wt_layer_compare(&p, (wt_interval){far, 0, -far, far * reach});
    assert_false(open.differ);
}

static int tear_down(void **state)
{
    (void)state;
    fixture_free();
    return 0;
}

static int set_up(void **state)
{
    (void)state;
    wt_case *read = NULL;
    fixture_check(wt_case_read(WT_SOURCE_DIR "/fixtures/case/case.xml", &read, NULL));
    fixture_check(
        wt_case_request_tables(read, "track_layer indentation/bulk indentation/track", NULL));
    fixture_check(wt_run_case(read, NULL, NULL, &fixture_case, NULL, NULL));
    wt_case_free(read);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_limit),      cmocka_unit_test(test_both_limits),
        cmocka_unit_test(test_no_result),      cmocka_unit_test(test_agreement),
        cmocka_unit_test(test_beyond_the_law), cmocka_unit_test(test_below_the_law)};
    return cmocka_run_group_tests_name("track layer", tests, set_up, tear_down);
}
