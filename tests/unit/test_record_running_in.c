/* Combined result of several running-ins: synthetic runs, and the bundled one with changes of its
 * case and its record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "core/math/students_t.h"
#include "record/running_in_validation.h"
#include "weartrack/case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "table_cells.h"

enum { TIMES = 8, DRAWS = 40, MOST = 3, STRIDE = GROWTH_QUANTITIES + TIMES };
static double grown[(1 + DRAWS) * STRIDE], courses[(1 + DRAWS) * TIMES];
static growth layer[MOST];
static recorded_run record = {.at = {.velocity = 0.3}, .running_in = (double)NAN, .note = ""};
static double values[MOST][(1 + DRAWS) * RUN_QUANTITIES];
static run_fit run[MOST];
static run_set all;

/* A prediction with a change of 0.1 in each draw. */
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
                            .running_in_curve = courses};
    all = (run_set){.runs = run, .margin = 1, .seed = 1, .has_shear = true};
}

/* Adds a run: a time that is exp(at) times the predicted one, within 10 %; its limits; the draws
 * scatter by 2 %. The change is as predicted. */
static run_fit *add(double at, bool low, bool high)
{
    run_fit *const r = &run[all.n];
    double *const value = values[all.n];
    uint64_t seed = 3 + all.n;
    *r = (run_fit){.rec = &record, .growth = &layer[all.n], .value = value};
    r->fit = (running_in_curve_fit){.seen = true,
                                    .log_factor = at,
                                    .error = 0.05,
                                    .low = low ? at - 0.1 : (double)NAN,
                                    .high = high ? at + 0.1 : (double)NAN,
                                    .ratio = 1,
                                    .ratio_error = 0.05};
    for (size_t k = 0; k <= DRAWS; k++) {
        const double off = k > 0 ? 0.02 * truth_normal(&seed) : 0;
        for (size_t m = 0; m < RUN_QUANTITIES; m++)
            value[k * RUN_QUANTITIES + m] = at + off;
        value[k * RUN_QUANTITIES + RUN_RATIO] = 1 + off;
        value[k * RUN_QUANTITIES + RUN_ABOVE_LOWER] = 0.1 * (0.5 + off);
        value[k * RUN_QUANTITIES + RUN_BELOW_UPPER] = 0.1 * (1 - off);
    }
    all.n++;
    return r;
}

static run_verdict judged(void)
{
    for (size_t k = 0; k < RUN_QUANTITIES; k++)
        assert_int_equal(run_level_compute(run, all.n, (run_quantity)k, &all.level[k], NULL),
                         WT_OK);
    const run_verdict said = run_set_assess(&all);
    for (size_t k = 0; k < RUN_QUANTITIES; k++)
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
    check(judged().verdict, "yes: a change like that by the layer is complete after 1 "
                            "times");
    (void)add(2, true, true);
    check(judged().verdict, "inconclusive");
}

/* A run that agrees does not outweigh one that contradicts, in either order. */
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
            check(said.verdict, "no: ");
            /* 6.69 from the record alone; the draws of the prediction depend on the order. */
            check(said.verdict, late ? "after 6.6" : "after 0.15");
            check_not(said.verdict, "6.69 times");
            check(said.verdict, late ? "predicted at least" : "predicted at most");
        }
}

/* The described run is the one that decides. */
static void test_open_second(void **state)
{
    (void)state;
    begin();
    (void)add(0, true, false);
    (void)add(2, true, false);
    check(judged().verdict,
          "no: a change like that by the layer is not complete at the end of the record, "
          "after 6.65 times");
}

/* A run without a time leaves the verdict inconclusive, and the advice is for that run. */
static void test_open_agrees(void **state)
{
    (void)state;
    begin();
    (void)add(0, true, true);
    (void)add(0, true, false);
    run_verdict said = judged();
    check(said.verdict,
          "inconclusive: a change like that by the layer is complete after 1 times the time "
          "predicted");
    check(said.verdict, "which not every record determines");
    check(said.settled_by, "continues until the change of friction is complete");
    begin();
    (void)add(0, false, true);
    said = judged();
    check(said.verdict,
          "inconclusive: a change like that by the layer is complete within the first cycles");
    check(said.settled_by, "shorter cycles at the start");
    begin();
    (void)add(0, false, false);
    said = judged();
    check(said.verdict, "gives neither a lower nor an upper limit of the time");
    check_not(said.verdict, "exceeds");
}

/* A record that is steady by itself is described as another question, without contradiction. */
static void test_steady_by_itself(void **state)
{
    (void)state;
    begin();
    (void)add(0, true, false);
    check_not(judged().verdict, "friction is steady");
    for (int early = 0; early < 2; early++) {
        const recorded_run steady = {.n = 2, .running_in = early ? 0 : 295, .note = ""};
        begin();
        add(0, early, !early)->rec = &steady;
        const run_verdict said = judged();
        check(said.verdict,
              early ? "not complete at the end of the record" : "within the first cycles");
        check(said.verdict, early ? "(by its scatter alone friction is steady from the first cycle)"
                                  : "(by its scatter alone friction is steady after 295 cycles)");
    }
}

/* Draws without a layer count for any compared run. */
static void test_bare(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        begin();
        (void)add(0, true, true);
        (void)add(0, true, true);
        layer[i].n_bare = 2;
        check(judged().verdict, "inconclusive: within the stated errors there may be no layer");
        layer[i].n_bare = 1;
        check(judged().verdict, "yes: ");
    }
}

/* The first run has no time: the advice uses one that has. */
static void test_share_of_variance(void **state)
{
    (void)state;
    begin();
    run_fit *const wide = add(0, true, true);
    layer[0].line[0] = FLOW_DRAW_WEAR;
    layer[0].n_lines = 1;
    for (size_t k = 1; k <= DRAWS; k++)
        wide->value[k * RUN_QUANTITIES + RUN_TIME_RATIO] =
            0.8 * flow_draw_normal(all.seed, k - 1, FLOW_DRAW_WEAR);
    const run_verdict said = judged();
    check(said.verdict, "inconclusive: a change like that by the layer is complete after 1 "
                        "times");
    check(said.settled_by, "known better");
    check(said.settled_by, " % of the variance");
    check_not(said.settled_by, "nan");
    run_fit *const untold = add(0, true, true);
    *untold = *wide;
    untold->value = values[1];
    *wide = (run_fit){.rec = &record, .growth = &layer[1], .value = values[2]};
    for (size_t k = 0; k < (1 + DRAWS) * RUN_QUANTITIES; k++) {
        values[1][k] = values[0][k];
        values[2][k] = (double)NAN;
    }
    const run_verdict other = judged();
    check(other.verdict, "inconclusive: ");
    check_not(other.verdict, "nan");
    check_not(other.settled_by, "nan");
}

static void test_change_without_a_time(void **state)
{
    (void)state;
    begin();
    run_fit *const r = add(2, true, false);
    r->value[RUN_RATIO] = r->value[RUN_ABOVE_LOWER] = r->value[RUN_BELOW_UPPER] = (double)NAN;
    const run_verdict said = judged();
    check(said.verdict, "no: ");
    check(said.verdict, "the change of friction is not determined");
    check_not(said.verdict, "nan");
}

/* A change within the first of long cycles of 3000: a test of the first 20 of its times would need
 * fewer cycles than a fit does, and the fit is kept. */
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
    const recorded_run fast = {
        .at = {.velocity = 0.3}, .n = CYCLES, .end = end, .friction = friction, .note = ""};
    run_fit r = {.rec = &fast, .growth = &layer[0]};
    run_fit_compute(&r, 1);
    assert_string_equal(r.note, "a change like that by the layer is complete within the first "
                                "cycles");
    assert_non_null(r.value);
    assert_true(r.fit.seen && r.fit.high < 0);
    run_fit_clear(&r);
}

/* ---- combined records ------------------------------------------------------------------------ */

enum { LAPS = 120 };
static double lap_end[LAPS], lapped[MOST][LAPS];
static recorded_run scattered[MOST];

/* Records of the predicted curve, with `factor` [MOST] times its time; the scatter is as large as
 * the change and partly slow. */
static void add_records(const double *factor, double scatter, uint64_t seed)
{
    begin();
    for (size_t i = 0; i < (1 + DRAWS) * TIMES; i++)
        courses[i] = 0.1 * exp(-exp(log(10.0) / 2 * (double)(i % TIMES)) / 30);
    for (size_t r = 0; r < MOST; r++) {
        layer[r].log_first = 0;
        layer[r].log_step = log(10.0) / 2;
        const running_in_curve c = growth_curve(&layer[r], 0);
        double slow = truth_normal(&seed);
        for (size_t i = 0; i < LAPS; i++) {
            slow = 0.9 * slow + sqrt(1 - 0.81) * truth_normal(&seed);
            lap_end[i] = 4 * (double)(i + 1);
            lapped[r][i] = 0.5 + running_in_curve_at(&c, log((lap_end[i] - 2) / factor[r])) +
                           scatter * (0.5 * slow + truth_normal(&seed));
        }
        scattered[r] = (recorded_run){.at = {.velocity = 0.3},
                                      .n = LAPS,
                                      .end = lap_end,
                                      .friction = lapped[r],
                                      .running_in = (double)NAN,
                                      .note = ""};
        run[r] = (run_fit){.rec = &scattered[r], .growth = &layer[r]};
        run_fit_compute(&run[r], 1);
    }
    all.n = MOST;
}

static void records_end(void)
{
    for (size_t r = 0; r < MOST; r++)
        run_fit_clear(&run[r]);
    run_set_clear(&all);
}

/* One of three determines a time, a quarter of the true one, because its scatter was large at the
 * start: the combination covers the truth. */
static void test_combined_only(void **state)
{
    (void)state;
    add_records((double[]){1, 1, 1}, 0.06, 190);
    assert_true(run_fit_is_closed(&run[0]) && run[0].fit.high < 0);
    assert_true(!run_fit_is_closed(&run[1]) && !run_fit_is_closed(&run[2]));
    assert_int_equal(run_set_compute_levels(&all, NULL), WT_OK);
    const wt_interval time = run_level_interval(&all.level[RUN_TIME_RATIO]);
    assert_true(time.low < 0 && time.high > 0);
    assert_true(time.high - time.low < run[0].fit.high - run[0].fit.low);
    records_end();
}

/* One determines a time, and with the others there is none. */
static void test_single_only(void **state)
{
    (void)state;
    add_records((double[]){1, 1, 1}, 0.1, 20);
    assert_true(run_fit_is_closed(&run[0]));
    assert_int_equal(run_set_compute_levels(&all, NULL), WT_OK);
    assert_true(isnan(run_level_interval(&all.level[RUN_TIME_RATIO]).value));
    assert_true(isnan(run_level_interval(&all.level[RUN_ENERGY]).value));
    check(run_set_assess(&all).verdict,
          "inconclusive: one record determines a time of running-in, all together do not");
    records_end();
}

/* None determines a time, and all three together do. */
static void test_combined_time(void **state)
{
    (void)state;
    add_records((double[]){1, 1, 1}, 0.1, 6);
    for (size_t r = 0; r < MOST; r++)
        assert_false(run[r].fit.seen);
    assert_int_equal(run_set_compute_levels(&all, NULL), WT_OK);
    const wt_interval time = run_level_interval(&all.level[RUN_TIME_RATIO]);
    assert_true(time.low < 0 && time.high > 0);
    check(run_set_assess(&all).verdict, "which not every record determines");
    records_end();
}

/* Records of different times have none in common. */
static void test_differ(void **state)
{
    (void)state;
    add_records((double[]){1, 1, 30}, 0.002, 3);
    assert_true(run_fit_is_closed(&run[0]) && run_fit_is_closed(&run[1]));
    assert_true(isnan(run[2].fit.high));
    assert_int_equal(run_set_compute_levels(&all, NULL), WT_OK);
    assert_true(isnan(run_level_interval(&all.level[RUN_TIME_RATIO]).value));
    run_set_clear(&all);
    all.n = 2;
    assert_int_equal(run_set_compute_levels(&all, NULL), WT_OK);
    assert_true(fabs(run_level_interval(&all.level[RUN_TIME_RATIO]).value) < 0.1);
    all.n = MOST;
    records_end();
}

/* ---- the bundled case ------------------------------------------------------------------------ */

static const char case_path[] = "test_flow_running_in.xml",
                  csv_path[] = "test_record_running_in.csv";
static wt_result *result;
static const wt_table *runs;

static char *text_of(const char *path)
{
    FILE *const in = fopen(path, "rb");
    assert_non_null(in);
    char *const text = calloc(1, 1 << 16);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 16) - 1, in) > 0);
    fclose(in);
    return text;
}

static void change_case(const char *from, const char *to)
{
    char *const text = text_of(WT_SOURCE_DIR "/fixtures/growth/case.xml");
    const char *const pairs[][2] = {{from, to}, {"record.csv", csv_path}};
    FILE *const out = fopen(case_path, "wb");
    assert_non_null(out);
    const char *rest = text;
    for (size_t i = 0; i < 2; i++) {
        const char *const place = strstr(rest, pairs[i][0]);
        assert_non_null(place);
        fprintf(out, "%.*s%s", (int)(place - rest), rest, pairs[i][1]);
        rest = place + strlen(pairs[i][0]);
    }
    fputs(rest, out);
    fclose(out);
    free(text);
}

/* The record after `rest` rows at rest, with `still` of its own rows at rest, without friction in
 * `blank`. */
static void change_record(size_t rest, size_t still, size_t blank)
{
    static const double each = 10.4712688; /* [s] */
    char *const text = text_of(WT_SOURCE_DIR "/fixtures/growth/record.csv");
    FILE *const out = fopen(csv_path, "wb");
    assert_non_null(out);
    char *line = strtok(text, "\n");
    fprintf(out, "%s\n", line);
    for (size_t i = 0; i < rest; i++)
        fprintf(out, "%.9g,0,0,0.001\n", each * (double)i);
    for (size_t i = 0; (line = strtok(NULL, "\n")) != NULL; i++) {
        double time, laps, velocity, friction;
        assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf", &time, &laps, &velocity, &friction), 4);
        time += each * (double)rest;
        if (i < still)
            fprintf(out, "%.9g,0,0,0.001\n", time);
        else if (i < still + blank)
            fprintf(out, "%.9g,%g,%g,\n", time, laps, velocity);
        else
            fprintf(out, "%.9g,%g,%g,%.9g\n", time, laps, velocity, friction);
    }
    fclose(out);
    free(text);
}

/* Its first rows (0: all), with friction above 0.3 scaled by a factor. */
static void rewrite_record(size_t rows, double scale)
{
    char *const text = text_of(csv_path);
    FILE *const out = fopen(csv_path, "wb");
    assert_non_null(out);
    char *line = strtok(text, "\n");
    fprintf(out, "%s\n", line);
    for (size_t i = 0; (rows == 0 || i < rows) && (line = strtok(NULL, "\n")) != NULL; i++) {
        char *const friction = strrchr(line, ',') + 1;
        fprintf(out, "%.*s%.9g\n", (int)(friction - line), line,
                0.3 + scale * (strtod(friction, NULL) - 0.3));
    }
    fclose(out);
    free(text);
}

static void run_case(size_t draws)
{
    wt_case *read = NULL;
    wt_run_options few = wt_run_defaults();
    size_t failed = 0;
    wt_error err = WT_ERROR_INIT;
    few.replicates = draws;
    if (wt_case_read(case_path, &read, &err) != WT_OK ||
        wt_case_request_tables(read, "validation_running_in wear", &err) != WT_OK ||
        wt_run_case(read, &few, NULL, &result, &failed, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_case_free(read);
    runs = wt_result_find(result, "validation_running_in");
    assert_non_null(runs);
}

static void case_end(void)
{
    wt_result_free(result);
    (void)remove(case_path);
    (void)remove(csv_path);
}

static const char energy[] = "<critical-energy>2e+10J/m^3 +- 5%</critical-energy>";

/* ---- text against the table ------------------------------------------------------------------ */

/* The text and the number agree to the digits of the text. */
static void check_number(const char *text, double value)
{
    char *end = NULL;
    const double said = strtod(text, &end);
    if (end == text || !(fabs(said - value) <= 5e-3 * fabs(value)))
        fail_msg("the table has %.9g where \"%.40s\" is said", value, text);
}

/* The three numbers of "... 1.09 times X (95 %: 0.82 to 1.46)". */
static void check_interval(const char *text, double value, double low, double high)
{
    check_number(text, value);
    const char *const ends = strstr(text, "(95 %: "), *const to = strstr(text, " to ");
    assert_true(ends != NULL && to != NULL && ends < to);
    check_number(ends + strlen("(95 %: "), low);
    check_number(to + strlen(" to "), high);
}

/* Every number of the sentence is in the row of the run, and for "no" the first stated one is
 * outside the required range. */
static void check_sentence(double margin)
{
    static const char after[] = " after ", is[] = "the change of friction is ";
    const char *const said = wt_table_key(runs, "verdict"), *const time = strstr(said, after),
                      *const change = strstr(said, is);
    assert_int_equal(wt_table_n_rows(runs), 1);
    assert_true(time != NULL && change != NULL);
    const double low = number_cell(runs, 0, "time_ratio_low"),
                 high = number_cell(runs, 0, "time_ratio_high"),
                 change_low = number_cell(runs, 0, "change_ratio_low"),
                 change_high = number_cell(runs, 0, "change_ratio_high");
    if (strstr(said, "predicted at least") != NULL)
        check_number(time + strlen(after), low);
    else if (strstr(said, "predicted at most") != NULL)
        check_number(time + strlen(after), high);
    else
        check_interval(time + strlen(after), number_cell(runs, 0, "time_ratio"), low, high);
    assert_int_equal(isnan(low), strstr(said, "predicted at most") != NULL);
    assert_int_equal(isnan(high), strstr(said, "predicted at least") != NULL);
    check_interval(change + strlen(is), number_cell(runs, 0, "change_ratio"), change_low,
                   change_high);
    if (strncmp(said, "no:", strlen("no:")) != 0)
        return;
    const double most = 1 + margin;
    const bool by_time =
        low > most || high<1 / most, by_change = change_low> most || change_high < 1 / most;
    assert_true(by_time || by_change);
    assert_true(time < change ? by_time : by_change);
}

/* The original record, one that ends before its change is complete, and foreign friction. */
static void test_sentence_and_table(void **state)
{
    static const struct {
        size_t rows;  /* of the record; 0: all */
        double scale; /* of its friction above 0.3 */
        const char *begins, *holds;
    } tried[] = {{0, 1, "yes: ", "is complete after"},
                 {60, 1, "inconclusive: ", "is not complete at the end of the record, after"},
                 {0, -8, "no: the change of friction is -", "is complete after"}};
    (void)state;
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        change_case(energy, energy);
        change_record(0, 0, 0);
        rewrite_record(tried[i].rows, tried[i].scale);
        run_case(40);
        check(wt_table_key(runs, "verdict"), tried[i].begins);
        check(wt_table_key(runs, "verdict"), tried[i].holds);
        check_sentence(1);
        case_end();
    }
}

/* Without draws no interval and no agreement is stated, and no error is 0. */
static void test_without_draws(void **state)
{
    static const char *const unknown[] = {"settled_measured_standard_error",
                                          "settled_measured_low",
                                          "settled_measured_high",
                                          "time_ratio_standard_error",
                                          "time_ratio_low",
                                          "time_ratio_high",
                                          "change_predicted_standard_error",
                                          "change_ratio_standard_error",
                                          "change_ratio_low",
                                          "change_ratio_high"};
    (void)state;
    change_case(energy, energy);
    change_record(0, 0, 0);
    run_case(0);
    check(wt_table_key(runs, "verdict"), "inconclusive: the prediction has no errors");
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++)
        assert_true(isnan(number_cell(runs, 0, unknown[i])));
    assert_true(number_cell(runs, 0, "time_ratio") > 0);
    assert_null(wt_table_key(runs, "wear_agrees"));
    assert_null(wt_table_key(runs, "time_ratio_low"));
    assert_null(wt_table_key(runs, "specific_wear_rate_needed_high"));
    assert_non_null(wt_table_key(runs, "specific_wear_rate_needed"));
    case_end();
}

/* Values of the case replace missing ones of the record; agreement with the wear rate. */
static void test_values_of_the_case(void **state)
{
    (void)state;
    change_case(energy, energy);
    change_record(0, 0, 0);
    run_case(20);
    const char *const remarks = wt_table_key(runs, "remarks");
    check(remarks, "the temperature of every step: that of the case");
    check(remarks, "the nominal pressure of every step: that of the case");
    check_not(remarks, "the velocity of every step");
    check(wt_table_key(runs, "wear_agrees"), "agrees within the errors");
    case_end();
}

/* Samples at rest before sliding are not friction, whether laps continue during them or not. For
 * cycles without friction the lap count shows sliding. */
static void test_before_the_first_friction(void **state)
{
    static const size_t changed[][3] = {{5, 0, 0}, {40, 0, 0}, {0, 5, 0}, {0, 0, 20}};
    (void)state;
    for (size_t i = 0; i < sizeof changed / sizeof *changed; i++) {
        change_case(energy, energy);
        change_record(changed[i][0], changed[i][1], changed[i][2]);
        run_case(40);
        if (changed[i][2] == 0)
            check(wt_table_key(runs, "verdict"), "yes: ");
        else /* the limits of fewer cycles are wider */
            check_not(wt_table_key(runs, "verdict"), "no: ");
        const double ratio = number_cell(runs, 0, "time_ratio");
        assert_true(ratio > 0.8 && ratio < 1.2);
        case_end();
    }
    change_case(energy, energy);
    change_record(0, 0, 60);
    run_case(40);
    check(wt_table_key(runs, "verdict"), "inconclusive: ");
    case_end();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_open_contradicts),
        cmocka_unit_test(test_open_second),
        cmocka_unit_test(test_open_agrees),
        cmocka_unit_test(test_bare),
        cmocka_unit_test(test_share_of_variance),
        cmocka_unit_test(test_change_without_a_time),
        cmocka_unit_test(test_short_change),
        cmocka_unit_test(test_without_draws),
        cmocka_unit_test(test_values_of_the_case),
        cmocka_unit_test(test_before_the_first_friction),
        cmocka_unit_test(test_steady_by_itself),
        cmocka_unit_test(test_sentence_and_table),
        cmocka_unit_test(test_combined_only),
        cmocka_unit_test(test_single_only),
        cmocka_unit_test(test_combined_time),
        cmocka_unit_test(test_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
