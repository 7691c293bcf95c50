/* What several running-ins say together, of runs that are made by hand.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth.h"

#include "base/normal.h"
#include "flow/validation/running_in.h"

#include <math.h>
#include <string.h>

#include "cells.h"

enum { TIMES = 8, DRAWS = 40, MOST = 3, STRIDE = GROWTH_NUMBERS + TIMES };
static double grown[(1 + DRAWS) * STRIDE], courses[(1 + DRAWS) * TIMES];
static growth layer[MOST];
static recorded record = {.at = {.velocity = 0.3}, .note = ""};
static double values[MOST][(1 + DRAWS) * RUN_NUMBERS];
static course_run run[MOST];
static run_set all;

/* A prediction whose change is 0.1 in each draw. */
static void begin(void)
{
    for (size_t i = 0; i < (1 + DRAWS) * TIMES; i++)
        courses[i] = i % TIMES == 0 ? 0.1 : 0;
    for (size_t i = 0; i < MOST; i++)
        layer[i] = (growth){.n = TIMES,
                            .n_draws = DRAWS,
                            .stride = STRIDE,
                            .log_step = 1,
                            .value = grown,
                            .course = courses};
    all = (run_set){.runs = run, .margin = 1, .seed = 1, .has_shear = true};
}

/* One more run: a time that is exp(at) times the predicted one, within 10 %; its ends; the draws
 * scatter by 2 %. The change is as predicted. */
static course_run *add(double at, bool low, bool high)
{
    course_run *const r = &run[all.n];
    double *const value = values[all.n];
    uint64_t seed = 3 + all.n;
    *r = (course_run){.rec = &record, .growth = &layer[all.n], .value = value};
    r->fit = (course_fit){.seen = true,
                          .log_factor = at,
                          .error = 0.05,
                          .low = low ? at - 0.1 : (double)NAN,
                          .high = high ? at + 0.1 : (double)NAN,
                          .ratio = 1,
                          .ratio_error = 0.05};
    for (size_t k = 0; k <= DRAWS; k++) {
        const double off = k > 0 ? 0.02 * truth_normal(&seed) : 0;
        for (size_t m = 0; m < RUN_NUMBERS; m++)
            value[k * RUN_NUMBERS + m] = at + off;
        value[k * RUN_NUMBERS + RUN_RATIO] = 1 + off;
        value[k * RUN_NUMBERS + RUN_MORE] = 0.1 * (0.5 + off);
        value[k * RUN_NUMBERS + RUN_LESS] = 0.1 * (1 - off);
    }
    all.n++;
    return r;
}

static run_verdict judged(void)
{
    for (size_t k = 0; k < RUN_NUMBERS; k++)
        assert_int_equal(run_level_make(run, all.n, (run_number)k, &all.level[k], NULL), WT_OK);
    const run_verdict said = run_set_judge(&all);
    for (size_t k = 0; k < RUN_NUMBERS; k++)
        run_level_clear(&all.level[k]);
    return said;
}

static void check(const char *text, const char *words)
{
    if (strstr(text, words) == NULL)
        fail_msg("\"%s\" is not in \"%s\"", words, text);
}

static void check_not(const char *text, const char *words)
{
    if (strstr(text, words) != NULL)
        fail_msg("\"%s\" is in \"%s\"", words, text);
}

static void test_closed(void **state)
{
    (void)state;
    begin();
    (void)add(0, true, true);
    check(judged().verdict, "explains: friction is steady after 1 times");
    (void)add(2, true, true);
    check(judged().verdict, "cannot say");
}

/* A run that agrees does not make one that contradicts agree, whichever is first. */
static void test_open_contradicts(void **state)
{
    (void)state;
    for (int order = 0; order < 2; order++)
        for (int late = 0; late < 2; late++) {
            begin();
            if (order == 0)
                (void)add(0, true, true);
            (void)add(late ? 2 : -2, late, !late);
            if (order == 1)
                (void)add(0, true, true);
            const run_verdict said = judged();
            check(said.verdict, "does not: ");
            check(said.verdict, late ? "6.69 times the time predicted at least"
                                     : "0.15 times the time predicted at most");
        }
}

/* The run that is told is the one that decides. */
static void test_open_second(void **state)
{
    (void)state;
    begin();
    (void)add(0, true, false);
    (void)add(2, true, false);
    check(judged().verdict,
          "does not: the record ends before friction is steady, after 6.69 times");
}

/* One that tells no time leaves it open, and what would close it is told of that run. */
static void test_open_agrees(void **state)
{
    (void)state;
    begin();
    (void)add(0, true, true);
    (void)add(0, true, false);
    run_verdict said = judged();
    check(said.verdict, "cannot say: friction is steady after 1 times the time predicted");
    check(said.verdict, "which not every record tells");
    check(said.settled_by, "goes on until friction is steady");
    begin();
    (void)add(0, false, true);
    said = judged();
    check(said.verdict, "cannot say: friction is steady within the first cycles");
    check(said.settled_by, "shorter cycles at the start");
    begin();
    (void)add(0, false, false);
    said = judged();
    check(said.verdict, "tells neither the least nor the most time");
    check_not(said.verdict, "stands out");
}

/* Draws without a layer count of any run that is compared. */
static void test_bare(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        begin();
        (void)add(0, true, true);
        (void)add(0, true, true);
        layer[i].n_bare = 2;
        check(judged().verdict, "cannot say: within the stated errors there may be no layer");
        layer[i].n_bare = 1;
        check(judged().verdict, "explains: ");
    }
}

/* The first run tells no time: what would settle it is by one that does. */
static void test_share_of_variance(void **state)
{
    (void)state;
    begin();
    course_run *const wide = add(0, true, true);
    layer[0].line[0] = FLOW_DRAW_WEAR;
    layer[0].n_lines = 1;
    for (size_t k = 1; k <= DRAWS; k++)
        wide->value[k * RUN_NUMBERS + RUN_TIME_RATIO] =
            0.8 * flow_draw_normal(all.seed, k - 1, FLOW_DRAW_WEAR);
    const run_verdict said = judged();
    check(said.verdict, "cannot say: friction is steady after 1 times");
    check(said.settled_by, "known better");
    check(said.settled_by, " % of the variance");
    check_not(said.settled_by, "nan");
    course_run *const untold = add(0, true, true);
    *untold = *wide;
    untold->value = values[1];
    *wide = (course_run){.rec = &record, .growth = &layer[1], .value = values[2]};
    for (size_t k = 0; k < (1 + DRAWS) * RUN_NUMBERS; k++) {
        values[1][k] = values[0][k];
        values[2][k] = (double)NAN;
    }
    const run_verdict other = judged();
    check(other.verdict, "cannot say: ");
    check_not(other.verdict, "nan");
    check_not(other.settled_by, "nan");
}

static void test_change_untold(void **state)
{
    (void)state;
    begin();
    course_run *const r = add(2, true, false);
    r->value[RUN_RATIO] = r->value[RUN_MORE] = r->value[RUN_LESS] = (double)NAN;
    const run_verdict said = judged();
    check(said.verdict, "does not: ");
    check(said.verdict, "how much it changes is not told");
    check_not(said.verdict, "nan");
}

/* A change within the first, long ones of 3000 cycles: the look at the first 20 of its times would
 * be at fewer cycles than a course can be told by, and what was fitted stands. */
static void test_short_change(void **state)
{
    enum { CYCLES = 3000, LONG = 12 };
    (void)state;
    static double end[CYCLES], friction[CYCLES];
    uint64_t seed = 5;
    begin();
    layer[0].n_draws = 0;
    layer[0].log_first = log(1.0);
    layer[0].log_step = log(10.0) / 3;
    for (size_t i = 0; i < TIMES; i++)
        courses[i] = 0.1 * exp(-exp(layer[0].log_step * (double)i) / 30);
    for (size_t i = 0; i < CYCLES; i++) {
        end[i] = (i > 0 ? end[i - 1] : 0) + (i < LONG ? 50 : 0.5);
        friction[i] = 0.5 + (i == 0 ? 0.02 : 0) + 1e-4 * truth_normal(&seed);
    }
    const recorded fast = {
        .at = {.velocity = 0.3}, .n = CYCLES, .end = end, .friction = friction, .note = ""};
    course_run r = {.rec = &fast, .growth = &layer[0]};
    assert_int_equal(course_run_fit(&r, 1, NULL), WT_OK);
    assert_string_equal(r.note, "it is over within the first cycles");
    assert_non_null(r.value);
    assert_true(r.fit.seen && r.fit.high < 0);
    course_run_clear(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed),        cmocka_unit_test(test_open_contradicts),
        cmocka_unit_test(test_open_second),   cmocka_unit_test(test_open_agrees),
        cmocka_unit_test(test_bare),          cmocka_unit_test(test_share_of_variance),
        cmocka_unit_test(test_change_untold), cmocka_unit_test(test_short_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
