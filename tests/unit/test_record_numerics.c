/* Friction records: cycles, running-in, steady-state mean, wear track, ball.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "draw_count.h"
#include "record/numerics/autocorrelation.h"
#include "record/numerics/pauses.h"
#include "record/numerics/steady_state.h"
#include "weartrack/record.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FRICTION WT_SHARED_DIR "/data/friction/"
#define TOPOGRAPHY WT_SHARED_DIR "/data/topography/"

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*state >> 11) + 0.5) / 9007199254740992.0;
}

static double normal(uint64_t *state)
{
    return sqrt(-2 * log(uniform(state))) * cos(2 * M_PI * uniform(state));
}

/* ---- measured records ------------------------------------------------------------------------ */

static wt_record read_record(const char *path)
{
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    wt_record record = {.n = 0};
    wt_error err = WT_ERROR_INIT;
    if (wt_formats_new(NULL, &formats, NULL, &err) != WT_OK ||
        wt_input_open(path, &input, &err) != WT_OK ||
        wt_record_read(formats, input, NULL, NULL, &record, &err) != WT_OK)
        fail_msg("%s: %s %s", path, err.message, err.found);
    wt_input_close(input);
    wt_formats_free(formats);
    return record;
}

/* Row of friction-steady.csv with these values of its second and third columns. */
typedef struct expected {
    double n, k, x, kept, mean, deviation, tau, window, se_tau, se_bartlett, se_batch, min, max;
} expected;

static expected reference_row(const char *file, const char *quantity, const char *method)
{
    char line[4096], start[256];
    expected e = {0};
    const int length = snprintf(start, sizeof start, "%s,%s,%s,", file, quantity, method);
    FILE *table = fopen(FRICTION "friction-steady.csv", "r");
    bool found = false;
    assert_non_null(table);
    while (!found && fgets(line, sizeof line, table) != NULL)
        found = strncmp(line, start, (size_t)length) == 0 &&
                sscanf(line + length, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &e.n,
                       &e.k, &e.x, &e.kept, &e.mean, &e.deviation, &e.tau, &e.window, &e.se_tau,
                       &e.se_bartlett, &e.se_batch, &e.min, &e.max) == 13;
    (void)fclose(table);
    assert_true(found);
    return e;
}

static void check_kept(const double *y, size_t n, const expected *e, bool periodic)
{
    const size_t first = (size_t)e->k;
    wt_steady s;
    assert_int_equal(n, (size_t)e->n);
    assert_int_equal(wt_steady_mean(y + first, n - first, &s, NULL), WT_OK);
    assert_near(s.mean.value, e->mean, 1e-11);
    assert_near(s.deviation, e->deviation, 1e-8);
    assert_near(s.min, e->min, 1e-12);
    assert_near(s.max, e->max, 1e-12);
    if (periodic) /* the wave of the lap is not scatter */
        return;
    /* the estimates of the reference do not agree better among themselves, and ignore scatter that
     * is longer than their windows */
    assert_true(s.mean.standard_error > 0.5 * fmin(e->se_bartlett, e->se_batch));
    assert_true(s.mean.standard_error < 3 * fmax(e->se_tau, e->se_batch));
}

static void check_reference(const char *file, const char *quantity, wt_cycle_kind kind)
{
    char path[512];
    wt_cycles cycles;
    const bool raw = kind == WT_CYCLE_SAMPLE && strncmp(file, "trib", 4) == 0;
    (void)snprintf(path, sizeof path, FRICTION "%s", file);
    wt_record record = read_record(path);
    assert_int_equal(wt_cycles_compute(&record, kind, (double)NAN, (double)NAN, &cycles, NULL),
                     WT_OK);
    double *y = malloc(cycles.n * sizeof *y);
    assert_non_null(y);
    for (size_t i = 0; i < cycles.n; i++)
        y[i] = cycles.cycle[i].coefficient;
    const expected all = reference_row(file, quantity, "all"),
                   step = reference_row(file, quantity, "LS1"),
                   mser = reference_row(file, quantity, "MSER-5");
    check_kept(y, cycles.n, &all, true);
    check_kept(y, cycles.n, &step, raw);
    check_kept(y, cycles.n, &mser, raw);
    free(y);
    wt_cycles_clear(&cycles);
    wt_record_clear(&record);
}

static void test_reference_values(void **state)
{
    (void)state;
    if (access(FRICTION "friction-steady.csv", R_OK) != 0)
        skip();
    check_reference("trib-c1.csv", "mu", WT_CYCLE_SAMPLE);
    check_reference("trib-c1.csv", "mu mean per complete lap floor(Laps) (x = lap)", WT_CYCLE_LAP);
    check_reference("velstep4_BRAVA_expb819_basalt.txt", "mu", WT_CYCLE_SAMPLE);
}

/* 3 N in every row, 7.6 samples per lap, and a running-in that ends by the rules, too. */
static void test_measured_disc(void **state)
{
    (void)state;
    if (access(FRICTION "trib-c1.csv", R_OK) != 0)
        skip();
    wt_cycles cycles;
    wt_running_in end;
    wt_record record = read_record(FRICTION "trib-c1.csv");
    assert_int_equal(
        wt_cycles_compute(&record, WT_CYCLE_AUTO, (double)NAN, (double)NAN, &cycles, NULL), WT_OK);
    assert_int_equal(cycles.kind, WT_CYCLE_LAP);
    assert_near(cycles.cycle[1000].normal_force, 3, 1e-4);
    assert_true(cycles.samples >= 7 && cycles.samples <= 8);
    assert_true(cycles.difference < 2e-5 || isnan(cycles.difference));
    double *y = malloc(cycles.n * sizeof *y);
    assert_non_null(y);
    for (size_t i = 0; i < cycles.n; i++)
        y[i] = cycles.cycle[i].coefficient;
    end = wt_running_in_find(y, cycles.n);
    assert_true(end.is_detected && end.end.low >= 270 && end.end.high <= 310);
    free(y);
    wt_cycles_clear(&cycles);
    wt_record_clear(&record);
}

/* ---- scatter --------------------------------------------------------------------------------- */

/* The filter against the full covariance, inverted by elimination. */
static void test_likelihood(void **state)
{
    (void)state;
    enum { N = 9 };
    const scatter_law law = {0.7, 0.6};
    const double y[N] = {1, 3, 2, 5, 4, 4, 6, 5, 8};
    double v[N][N + 3];
    for (int i = 0; i < N; i++) {
        for (int k = 0; k < N; k++)
            v[i][k] = law.share * pow(law.memory, abs(i - k)) + (i == k ? 1 - law.share : 0);
        v[i][N] = 1;
        v[i][N + 1] = i;
        v[i][N + 2] = y[i];
    }
    double log_det = 0, expected_product[6] = {0};
    for (int p = 0; p < N; p++) {
        log_det += log(v[p][p]);
        for (int i = 0; i < N; i++)
            for (int k = N + 2; i != p && k >= p; k--)
                v[i][k] -= v[i][p] / v[p][p] * v[p][k];
    }
    for (int i = 0; i < N; i++) {
        const double left[3] = {1, i, y[i]};
        static const int pair[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}};
        for (int c = 0; c < 6; c++)
            expected_product[c] += left[pair[c][0]] * v[i][N + pair[c][1]] / v[i][i];
    }
    scatter_sums s = scatter_begin(law);
    for (int i = 0; i < N; i++)
        scatter_add(&s, y[i]);
    assert_near(s.log_det, log_det, 1e-12);
    for (int c = 0; c < 6; c++)
        assert_near(s.product[c], expected_product[c], 1e-12);
}

static void test_mean_of_a_law(void **state)
{
    (void)state;
    enum { N = 37 };
    for (size_t i = 0; i < SCATTER_LAWS; i += 7) {
        const scatter_law law = scatter_law_at(SCATTER_FOR_MEAN, i, N);
        double sum = 0;
        for (int a = 0; a < N; a++)
            for (int b = 0; b < N; b++)
                sum += law.share * pow(law.memory, abs(a - b)) + (a == b ? 1 - law.share : 0);
        assert_near(scatter_mean_variance(law, N), sum / N / N, 1e-10);
    }
}

/* White scatter: an interval hardly wider than Student's. Slow scatter: wider as the law
 * predicts. */
static void test_error_of_a_mean(void **state)
{
    (void)state;
    enum { N = 600, DRAWS = 40 };
    static double y[N];
    uint64_t seed = 5;
    double white = 0, slow = 0;
    for (int d = 0; d < DRAWS; d++) {
        wt_steady s;
        double x = normal(&seed);
        for (int i = 0; i < N; i++)
            y[i] = 0.5 + 0.01 * normal(&seed);
        assert_int_equal(wt_steady_mean(y, N, &s, NULL), WT_OK);
        white += s.mean.standard_error / (0.01 / sqrt(N)) / DRAWS;
        for (int i = 0; i < N; i++) {
            y[i] = 0.5 + 0.01 * x;
            x = 0.9 * x + sqrt(1 - 0.81) * normal(&seed);
        }
        assert_int_equal(wt_steady_mean(y, N, &s, NULL), WT_OK);
        slow += s.mean.standard_error / (0.01 * sqrt(19.0 / N)) / DRAWS;
        assert_true(s.correlation > 5 && s.correlation < 80);
    }
    print_message("error over that of white scatter %.3f, of slow scatter %.3f\n", white, slow);
    assert_true(white > 0.95 && white < 1.2); /* price of a possible slow scatter */
    assert_true(slow > 0.85 && slow < 1.25);
}

/* Slow scatter with a correlation time of a third of the record, i.e. three independent parts. Laws
 * up to a quarter of it, with equal shares, cover 45 of these. */
static void test_scatter_as_long_as_the_record(void **state)
{
    (void)state;
    enum { N = 60, DRAWS = 60 };
    const double memory = exp(-1 / 20.0);
    double y[N];
    uint64_t seed = 17;
    int held = 0, noted = 0;
    for (int d = 0; d < DRAWS; d++) {
        wt_steady s;
        double x = normal(&seed);
        for (int i = 0; i < N; i++) {
            y[i] = x;
            x = memory * x + sqrt(1 - memory * memory) * normal(&seed);
        }
        assert_int_equal(wt_steady_mean(y, N, &s, NULL), WT_OK);
        held += s.mean.low <= 0 && s.mean.high >= 0;
        noted += s.note[0] != '\0';
    }
    print_message("of %d means %d are held, %d noted\n", DRAWS, held, noted);
    assert_true(held >= 54 && noted >= 54);
}

/* White scatter with a drift of three standard deviations over the record, which is not slow
 * scatter; treated as such, the error is six times as large. */
static void test_error_with_a_drift(void **state)
{
    (void)state;
    enum { N = 150, DRAWS = 20 };
    double y[N], wide = 0;
    uint64_t seed = 23;
    for (int d = 0; d < DRAWS; d++) {
        wt_steady s;
        for (int i = 0; i < N; i++)
            y[i] = normal(&seed) + 3.0 * i / N;
        assert_int_equal(wt_steady_mean(y, N, &s, NULL), WT_OK);
        wide += s.mean.standard_error / (1 / sqrt(N)) / DRAWS;
    }
    print_message("error over that of white scatter, beside a drift %.2f\n", wide);
    assert_true(wide > 0.95 && wide < 3);
}

static void test_few_points(void **state)
{
    (void)state;
    const double y[3] = {1, 2, 3}, same[50] = {0};
    wt_steady s;
    wt_running_in r;
    assert_int_equal(wt_steady_mean(y, 3, &s, NULL), WT_OK);
    assert_near(s.mean.value, 2, 1e-15);
    assert_true(isnan(s.mean.standard_error) && s.note[0] != '\0');
    assert_int_equal(wt_steady_mean(y, 0, &s, NULL), WT_E_ARG);
    assert_int_equal(wt_steady_mean(same, 50, &s, NULL), WT_OK);
    assert_true(isnan(s.mean.standard_error));
    r = wt_running_in_find(y, 3);
    assert_true(!r.is_detected && isnan(r.end.value) && r.steady_start == 0);
    r = wt_running_in_find(same, 50);
    assert_false(r.is_detected);
}

/* A running-in without an end, none, and a jump without scatter. */
static void test_end_of_a_running_in(void **state)
{
    (void)state;
    enum { N = 300 };
    static double y[N];
    uint64_t seed = 11;
    wt_running_in r;
    for (int i = 0; i < N; i++)
        y[i] = 1 - 0.002 * i + 0.002 * normal(&seed);
    r = wt_running_in_find(y, N);
    assert_false(r.is_detected);
    assert_non_null(strstr(r.reason, "does not become steady"));
    for (int i = 0; i < N; i++)
        y[i] = 1 + 0.002 * normal(&seed);
    r = wt_running_in_find(y, N);
    assert_true(!r.is_detected && r.steady_start == 0);
    for (int i = 0; i < N; i++)
        y[i] = i < 100 ? 1.5 : 1;
    r = wt_running_in_find(y, N);
    assert_true(r.is_detected);
    assert_near(r.end.value, 100, 1e-12);
    assert_near(r.end.low, 100, 1e-12);
    assert_near(r.end.high, 100, 1e-12);
}

/* ---- decay at the end ------------------------------------------------------------------------ */

/* From 0.42 + `change` to 0.42 in `time` of the length, with scatter of 0.01. `kind`: 0
 * exponential, 1 exponential of the square root of time, 2 a step half-way. */
static void decay_series(double *y, size_t n, double change, double time, int kind, uint64_t *seed)
{
    for (size_t i = 0; i < n; i++) {
        const double t = (double)i / (double)n;
        y[i] = 0.42 + 0.01 * normal(seed) +
               change * (kind == 0   ? exp(-t / time)
                         : kind == 1 ? exp(-sqrt(t / time))
                                     : t < 0.5);
    }
}

/* Intervals cover plateaus beyond the end of the series; a constant and a step are not a decay. */
static void test_decay(void **state)
{
    (void)state;
    enum { N_POINTS = 750, DRAWS = DRAW_COUNT(10) };
    static const struct {
        double change, time;
        int kind;
        bool decays;
    } tried[] = {{0.25, 0.53, 0, true}, {0.25, 0.25, 0, true}, {-0.2, 0.53, 0, true},
                 {0.3, 0.1, 1, true},   {0, 1, 0, false},      {0.1, 1, 2, false}};
    static double y[N_POINTS];
    uint64_t seed = 31;
    for (size_t k = 0; k < sizeof tried / sizeof *tried; k++) {
        int found = 0, held = 0;
        for (int i = 0; i < DRAWS; i++) {
            decay_series(y, N_POINTS, tried[k].change, tried[k].time, tried[k].kind, &seed);
            const steady_decay d = steady_decay_find(y, N_POINTS);
            found += d.is_detected;
            held += d.plateau.low < 0.42 && d.plateau.high > 0.42;
        }
        print_message("decay %zu of seed 31: %d found, %d held of %d\n", k, found, held,
                      (int)DRAWS);
        if (!TEST_RATES)
            continue;
        assert_in_range(found, tried[k].decays ? DRAWS - 1 : 0, tried[k].decays ? DRAWS : 1);
        if (tried[k].decays)
            assert_in_range(held, DRAWS - 2, DRAWS);
    }
    assert_false(steady_decay_find(y, 10).is_detected);
}

/* ---- cycles ---------------------------------------------------------------------------------- */

enum { SAMPLES = 4000 };
static double channel[WT_RECORD_CHANNELS][SAMPLES];
static size_t steps[SAMPLES];

static wt_record empty_record(void)
{
    memset(steps, 0, sizeof steps);
    return (wt_record){.n = SAMPLES, .step = steps, .radius = (double)NAN};
}

static double *with(wt_record *record, wt_record_channel c)
{
    return record->channel[c] = channel[c];
}

/* A zero of 0.7 N does not affect the coefficient, and neither does a reversal. */
static void test_strokes(void **state)
{
    (void)state;
    for (int by_position = 0; by_position < 2; by_position++) {
        wt_record record = empty_record();
        double *position = by_position ? with(&record, WT_RECORD_POSITION) : NULL,
               *time = with(&record, WT_RECORD_TIME),
               *force = with(&record, WT_RECORD_FRICTION_FORCE),
               *load = with(&record, WT_RECORD_NORMAL_FORCE);
        for (int i = 0; i < SAMPLES; i++) {
            const double phase = 2 * M_PI * (i + 0.5) / 100, side = sin(phase);
            time[i] = 0.01 * i;
            load[i] = 10;
            /* at the ends friction is changing its sign */
            force[i] = 0.7 + 4 * (fabs(side) < 0.1 ? 10 * side : side > 0 ? 1 : -1);
            if (position != NULL)
                position[i] = -5e-3 * cos(phase);
        }
        wt_cycles c;
        assert_int_equal(
            wt_cycles_compute(&record, WT_CYCLE_AUTO, (double)NAN, (double)NAN, &c, NULL), WT_OK);
        assert_int_equal(c.kind, WT_CYCLE_STROKE);
        assert_true(c.n >= 37 && c.n <= 40 && c.has_zero);
        for (size_t i = 0; i < c.n; i++) {
            assert_near(c.cycle[i].coefficient, 0.4, by_position ? 1e-9 : 0.01);
            assert_near(c.cycle[i].zero, 0.07, by_position ? 1e-9 : 0.02);
        }
        wt_cycles_clear(&c);
    }
}

/* Strokes with one sign: friction of 4 N with a larger zero of either sign, and the magnitude of
 * friction without one, which falls to 0 at the reversal. The coefficient is 0.4. */
static void test_strokes_with_one_sign(void **state)
{
    static const double zeros[] = {6.3, -6.3, 4.5, 40, 0};
    (void)state;
    uint64_t seed = 8;
    for (size_t k = 0; k < sizeof zeros / sizeof *zeros; k++) {
        wt_record record = empty_record();
        double *position = with(&record, WT_RECORD_POSITION), *time = with(&record, WT_RECORD_TIME),
               *force = with(&record, WT_RECORD_FRICTION_FORCE),
               *load = with(&record, WT_RECORD_NORMAL_FORCE);
        for (int i = 0; i < SAMPLES; i++) {
            const double phase = 2 * M_PI * (i + 0.5) / 100, side = sin(phase),
                         signed_force =
                             zeros[k] + 4 * fmax(-1, fmin(1, 8 * side)) + 0.05 * normal(&seed);
            time[i] = 0.01 * i;
            load[i] = 10;
            position[i] = -5e-3 * cos(phase);
            force[i] = zeros[k] == 0 ? fabs(signed_force) : signed_force;
        }
        wt_cycles c;
        assert_int_equal(
            wt_cycles_compute(&record, WT_CYCLE_AUTO, (double)NAN, (double)NAN, &c, NULL), WT_OK);
        assert_int_equal(c.kind, WT_CYCLE_STROKE);
        assert_int_equal(c.has_zero, zeros[k] != 0);
        for (size_t i = 0; i < c.n; i++) {
            assert_near_abs(c.cycle[i].coefficient, 0.4, 0.01);
            if (zeros[k] != 0)
                assert_near_abs(c.cycle[i].zero, zeros[k] / 10, 0.01);
        }
        wt_cycles_clear(&c);
    }
}

/* Laps by a column, and by distance and radius; complete ones only. */
static void test_laps(void **state)
{
    (void)state;
    for (int by_distance = 0; by_distance < 2; by_distance++) {
        wt_record record = empty_record();
        double *laps = with(&record, by_distance ? WT_RECORD_DISTANCE : WT_RECORD_LAPS),
               *mu = with(&record, WT_RECORD_COEFFICIENT);
        for (int i = 0; i < SAMPLES; i++) {
            const double lap = 0.4 + i / 37.3;
            laps[i] = by_distance ? 2 * M_PI * 0.02 * lap : lap;
            mu[i] = 0.5 + 0.2 * sin(2 * M_PI * lap);
        }
        wt_cycles c;
        assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_AUTO, 0.02, (double)NAN, &c, NULL),
                         WT_OK);
        assert_int_equal(c.kind, WT_CYCLE_LAP);
        assert_int_equal(c.n, (size_t)floor(0.4 + (SAMPLES - 1) / 37.3) - 1);
        for (size_t i = 0; i < c.n; i++)
            assert_near(c.cycle[i].coefficient, 0.5, 0.01);
        wt_cycles_clear(&c);
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_STROKE, 0.02, (double)NAN, &c, &err),
                         WT_E_MISSING);
        if (by_distance)
            assert_int_equal(
                wt_cycles_compute(&record, WT_CYCLE_LAP, (double)NAN, (double)NAN, &c, &err),
                WT_E_MISSING);
    }
}

/* A span is as long as nearly all steps, also in a record of milliseconds. */
static void test_short_spans(void **state)
{
    (void)state;
    enum { DENSE = 10, ALL = 100 };
    wt_record record = empty_record();
    double *time = with(&record, WT_RECORD_TIME), *mu = with(&record, WT_RECORD_COEFFICIENT), t = 0;
    record.n = ALL;
    for (int i = 0; i < ALL; i++) {
        time[i] = t;
        mu[i] = 1;
        t += i < DENSE ? 1e-3 : 2e-3;
    }
    wt_cycles c;
    assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_TIME, (double)NAN, (double)NAN, &c, NULL),
                     WT_OK);
    assert_int_equal(c.cycle[0].n, 2);
    assert_int_equal(c.cycle[c.n - 1].n, 1);
    assert_int_equal(c.n, ALL - DENSE / 2);
    wt_cycles_clear(&c);
}

/* A sampling rate that is a hundred times higher in the second half gives it no more weight, and a
 * step is not a cycle of two. */
static void test_spans_of_time(void **state)
{
    (void)state;
    wt_record record = empty_record();
    double *time = with(&record, WT_RECORD_TIME), *mu = with(&record, WT_RECORD_COEFFICIENT), t = 0;
    size_t slow = 0;
    for (int i = 0; i < SAMPLES; i++) {
        time[i] = t;
        mu[i] = t < 39.95 ? 1 : 2;
        slow += t < 39.95;
        t += t < 39.95 ? 1 : 0.01;
        steps[i] = t > 60;
    }
    wt_cycles c;
    assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_AUTO, (double)NAN, (double)NAN, &c, NULL),
                     WT_OK);
    assert_int_equal(c.kind, WT_CYCLE_TIME);
    assert_int_equal(slow, 40);
    size_t n = 0;
    for (size_t i = 0; i < c.n; i++) {
        n += c.cycle[i].coefficient < 1.5;
        assert_true(c.cycle[i].n <= 101);
        assert_int_equal(steps[c.cycle[i].first + c.cycle[i].n - 1], c.cycle[i].step);
    }
    assert_int_equal(n, 40);
    assert_true(c.n >= 79 && c.n <= 82);
    wt_cycles_clear(&c);
}

/* ---- pauses ---------------------------------------------------------------------------------- */

/* Recording of a pause of 60 s, at sample 1500 with a time step of 0.1 s. */
typedef struct pause_case {
    wt_record_channel by; /* WT_RECORD_CHANNELS: a gap in the time alone */
    double display;       /* value of the last digit */
    double noise;         /* of it, at rest and in motion */
    bool recorded;        /* samples are recorded in it */
    bool backward;        /* the instrument counts this direction as negative */
} pause_case;

static double shown(const pause_case *c, double value, uint64_t *seed)
{
    value += c->noise * normal(seed);
    return c->display > 0 ? c->display * floor(value / c->display + 0.5) : value;
}

/* The pause ends where the speed exceeds the fourth of three decades; a slider stops in
 * mid-stroke. */
static void test_pause(void **state)
{
    (void)state;
    enum { ALL = 3600, AT = 1500, LAST = AT + 600, STROKE = 300 };
    static const pause_case cases[] = {
        {WT_RECORD_DISTANCE, 0, 0, true, false},    {WT_RECORD_DISTANCE, 0, 0, false, false},
        {WT_RECORD_DISTANCE, 1e-3, 0, true, false}, {WT_RECORD_DISTANCE, 0, 1e-5, true, false},
        {WT_RECORD_LAPS, 0, 0, true, false},        {WT_RECORD_LAPS, 1, 0, true, false},
        {WT_RECORD_VELOCITY, 0, 0, true, false},    {WT_RECORD_VELOCITY, 0, 1e-5, true, true},
        {WT_RECORD_ROTATION, 0, 0, true, true},     {WT_RECORD_VELOCITY, 0, 1e-5, true, false},
        {WT_RECORD_ROTATION, 0, 0, true, false},    {WT_RECORD_POSITION, 0, 1e-6, true, false},
        {WT_RECORD_CHANNELS, 0, 0, false, false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const pause_case *c = &cases[k];
        wt_record record = empty_record();
        double *time = with(&record, WT_RECORD_TIME), *mu = with(&record, WT_RECORD_COEFFICIENT),
               *moved = c->by < WT_RECORD_CHANNELS ? with(&record, c->by) : NULL;
        uint64_t seed = k + 1;
        size_t n = 0, slid = 0;
        for (size_t i = 0; i < ALL; i++) {
            const bool rests = i >= AT && i < LAST;
            slid += !rests;
            if (rests && !c->recorded)
                continue;
            const double way = 0.005 * (double)slid;
            time[n] = 0.1 * (double)i;
            mu[n] = rests ? 0 : 0.5;
            if (moved != NULL)
                moved[n] = shown(c,
                                 c->by == WT_RECORD_DISTANCE   ? way
                                 : c->by == WT_RECORD_LAPS     ? way / 0.05
                                 : c->by == WT_RECORD_POSITION ? 0.01 * sin((double)slid / STROKE)
                                 : rests                       ? 0
                                 : c->backward                 ? -0.05
                                                               : 0.05,
                                 &seed);
            n++;
        }
        record.n = n;
        record_pauses pauses = record_remove_pauses(&record);
        assert_int_equal(pauses.n, 1);
        /* complete laps do not determine the position within one */
        const bool coarse = c->by == WT_RECORD_LAPS && c->display > 0;
        assert_true(fabs(pauses.of[0].time - 60) < 0.25);
        assert_true(fabs(pauses.of[0].at - 150) < (coarse ? 1.05 : 0.25));
        assert_true(fabs(time[record.n - 1] - 300) < 0.4);
        if (moved != NULL && c->by == WT_RECORD_DISTANCE)
            assert_true(fabs(moved[record.n - 1] - 15) < 0.011);
        double at_rest = 0;
        for (size_t i = 0; i < record.n; i++)
            at_rest += mu[i] < 0.25;
        assert_true(at_rest <= 1);
        free(pauses.of);
    }
}

/* Not pauses: speeds over four decades with few displayed digits, strokes that turn, a recorder
 * that is repeatedly off for a minute, and rest before and after the sliding. */
static void test_no_pause(void **state)
{
    (void)state;
    static const double speed[] = {0.1, 1e-5, 1e-3, 0.1};
    uint64_t seed = 5;
    for (int k = 0; k < 7; k++) {
        wt_record record = empty_record();
        double *time = with(&record, WT_RECORD_TIME), *mu = with(&record, WT_RECORD_COEFFICIENT),
               *moved = k == 4             ? NULL
                        : k == 3 || k == 6 ? with(&record, WT_RECORD_POSITION)
                        : k == 2           ? with(&record, WT_RECORD_VELOCITY)
                                           : with(&record, WT_RECORD_DISTANCE),
               way = 0;
        for (int i = 0; i < SAMPLES; i++) {
            const double v = speed[4 * i / SAMPLES], edge = (double)SAMPLES / 4;
            way += 0.1 * v;
            time[i] = 0.1 * i + (k == 4 ? 60 * (i / 100) : 0);
            mu[i] = 0.5;
            if (moved != NULL)
                moved[i] = k == 5   ? fmin(fmax(0.1 * i, edge / 10), 0.3 * edge)
                           : k == 3 ? sin(2 * M_PI * i / SAMPLES * 3)
                           : k == 6 ? sin(2 * M_PI * i / SAMPLES * 2) + 0.008 * normal(&seed)
                           : k == 2 ? v
                           : k == 1 ? 1e-4 * floor(1e4 * way)
                                    : way;
        }
        record_pauses pauses = record_remove_pauses(&record);
        assert_int_equal(pauses.n, 0);
        assert_int_equal(record.n, SAMPLES);
        assert_int_equal(pauses.alike > 0, k == 4);
        free(pauses.of);
    }
}

static void test_force_without_a_load(void **state)
{
    (void)state;
    wt_record record = empty_record();
    wt_cycles c;
    wt_error err = WT_ERROR_INIT;
    for (int i = 0; i < SAMPLES; i++) {
        with(&record, WT_RECORD_TIME)[i] = i;
        with(&record, WT_RECORD_FRICTION_FORCE)[i] = -3;
    }
    assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_AUTO, (double)NAN, (double)NAN, &c, &err),
                     WT_E_MISSING);
    assert_non_null(strstr(err.advice, "--load"));
    assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_AUTO, (double)NAN, 6, &c, &err), WT_OK);
    assert_near(c.cycle[0].coefficient, 0.5, 1e-15); /* on the positive side */
    wt_cycles_clear(&c);
    /* both stated: they are compared */
    for (int i = 0; i < SAMPLES; i++)
        with(&record, WT_RECORD_COEFFICIENT)[i] = i == 7 ? 0.53 : 0.5;
    assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_SAMPLE, (double)NAN, 6, &c, &err), WT_OK);
    assert_near(c.difference, 0.03, 1e-12);
    wt_cycles_clear(&c);
    record.n = 1; /* a cycle */
    assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_SAMPLE, (double)NAN, 6, &c, &err), WT_OK);
    assert_int_equal(c.n, 1);
    wt_cycles_clear(&c);
    record.n = 0;
    assert_int_equal(wt_cycles_compute(&record, WT_CYCLE_SAMPLE, (double)NAN, 6, &c, &err),
                     WT_E_ARG);
}

/* ---- wear ------------------------------------------------------------------------------------ */

static void test_synthetic_track(void **state)
{
    (void)state;
    enum { N = 1000 };
    static double x[N], z[N];
    uint64_t seed = 9;
    wt_track t;
    double hits = 0;
    for (int draw = 0; draw < 40; draw++) {
        for (int i = 0; i < N; i++) { /* a parabola of 200 um, 4 um deep: area 2/3 of the box */
            const double at = (i - 500) * 1e-6, part = at / 100e-6;
            x[i] = i * 1e-6;
            z[i] = 3e-6 + 0.002 * x[i] - (fabs(part) < 1 ? 4e-6 * (1 - part * part) : 0) +
                   2e-8 * normal(&seed);
        }
        assert_int_equal(wt_track_find(x, z, N, &t, NULL), WT_OK);
        assert_true(t.found);
        assert_near(t.slope, 0.002, 0.01);
        assert_near(t.depth, 4e-6, 0.02);
        assert_near(t.area.value, 2.0 / 3 * 200e-6 * 4e-6, 0.01);
        hits += fabs(t.area.value - 2.0 / 3 * 200e-6 * 4e-6) < 3 * t.area.standard_error;
    }
    assert_true(hits >= 36);
    for (int i = 0; i < N; i++)
        z[i] = 3e-6 + 2e-8 * sin(i * 0.7);
    assert_int_equal(wt_track_find(x, z, N, &t, NULL), WT_OK);
    assert_true(!t.found && isnan(t.area.value));
    assert_int_equal(wt_track_find(x, z, 39, &t, NULL), WT_E_RANGE);
}

/* The stated error of the area is its scatter, and at most half as much again: for samples of a
 * narrow track, for the line below a wide one, and for correlated neighbours. */
static void test_error_of_a_track(void **state)
{
    (void)state;
    enum { N = 400, DRAWS = DRAW_COUNT(250) };
    static double x[N], z[N];
    const struct {
        double half_width, memory;
    } cases[] = {{12, 0}, {80, 0}, {30, 0.6}};
    uint64_t seed = 77;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double half = cases[k].half_width, memory = cases[k].memory;
        double sum = 0, square = 0, stated = 0, noise = 0;
        for (int draw = 0; draw < DRAWS; draw++) {
            wt_track t;
            for (int i = 0; i < N; i++) {
                const double part = (i - 200) / half;
                noise = memory * noise + sqrt(1 - memory * memory) * normal(&seed);
                x[i] = 2e-6 * i;
                z[i] = 1e-8 * noise - fmax(0, 4e-6 * (1 - part * part));
            }
            assert_int_equal(wt_track_find(x, z, N, &t, NULL), WT_OK);
            assert_true(t.found);
            sum += t.area.value / DRAWS;
            square += t.area.value * t.area.value / DRAWS;
            stated += t.area.standard_error * t.area.standard_error / DRAWS;
        }
        if (!TEST_RATES)
            continue;
        const double wider = sqrt(stated / (square - sum * sum));
        assert_true(wider > 0.95 && wider < 1.5);
    }
}

/* The profile by its two columns, in mm and um; the reference uses the same rule. */
static void test_measured_track(void **state)
{
    (void)state;
    enum { MOST = 10000 };
    static double x[MOST], z[MOST];
    char line[1024];
    double n, e[12];
    size_t rows = 0;
    FILE *profile = fopen(TOPOGRAPHY "wear-track-C1.csv", "r"),
         *table = fopen(TOPOGRAPHY "wear-track.csv", "r");
    bool found = false;
    if (profile == NULL || table == NULL)
        skip();
    while (fgets(line, sizeof line, profile) != NULL) {
        for (char *c = line; *c != '\0'; c++) /* decimal commas, and quotes around the numbers */
            *c = *c == '"' || (*c == ',' && c[1] == '"') ? ' ' : *c == ',' ? '.' : *c;
        double a, b;
        if (sscanf(line, "%lf %lf", &a, &b) == 2 && rows < MOST) {
            x[rows] = 1e-3 * a;
            z[rows++] = 1e-6 * b;
        }
    }
    while (!found && fgets(line, sizeof line, table) != NULL)
        found = sscanf(line, "wear-track-C1.csv,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf",
                       &n, &e[0], &e[1], &e[2], &e[3], &e[4], &e[5], &e[6], &e[7], &e[8], &e[9],
                       &e[10]) == 12;
    (void)fclose(profile);
    (void)fclose(table);
    assert_true(found);
    assert_int_equal(rows, (size_t)n);
    wt_track t;
    assert_int_equal(wt_track_find(x, z, rows, &t, NULL), WT_OK);
    assert_near(t.slope, e[0], 1e-7);
    assert_near(t.scatter, e[2], 1e-8);
    assert_near(t.depth, e[3], 1e-8);
    assert_near(t.at, e[4], 1e-9);
    assert_near(t.from, e[5], 1e-9);
    assert_near(t.to, e[6], 1e-9);
    assert_near(t.area.value, e[9], 1e-8);
    assert_near(t.ridges, e[10], 1e-8);
    print_message("area %.3g +- %.2g um^2\n", 1e12 * t.area.value, 1e12 * t.area.standard_error);
}

/* Hertz: the load of a sphere at the depth a^2 / R, and from the pressure back to the load. */
static void test_ball(void **state)
{
    (void)state;
    const double radius = 3e-3, modulus = 20e6, nu = 0.49, load = 2;
    const wt_ball_contact c = wt_ball_contact_compute(load, radius, modulus, nu);
    const double depth = c.contact_radius * c.contact_radius / radius;
    assert_near(4.0 / 3 * modulus / (1 - nu * nu) * sqrt(radius) * pow(depth, 1.5), load, 1e-12);
    assert_near(c.pressure, load / (M_PI * c.contact_radius * c.contact_radius), 1e-12);
    assert_near(wt_ball_load(c.pressure, radius, modulus, nu), load, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference_values),
        cmocka_unit_test(test_measured_disc),
        cmocka_unit_test(test_likelihood),
        cmocka_unit_test(test_mean_of_a_law),
        cmocka_unit_test(test_error_of_a_mean),
        cmocka_unit_test(test_scatter_as_long_as_the_record),
        cmocka_unit_test(test_error_with_a_drift),
        cmocka_unit_test(test_few_points),
        cmocka_unit_test(test_end_of_a_running_in),
        cmocka_unit_test(test_decay),
        cmocka_unit_test(test_strokes),
        cmocka_unit_test(test_strokes_with_one_sign),
        cmocka_unit_test(test_laps),
        cmocka_unit_test(test_short_spans),
        cmocka_unit_test(test_spans_of_time),
        cmocka_unit_test(test_pause),
        cmocka_unit_test(test_no_pause),
        cmocka_unit_test(test_force_without_a_load),
        cmocka_unit_test(test_synthetic_track),
        cmocka_unit_test(test_error_of_a_track),
        cmocka_unit_test(test_measured_track),
        cmocka_unit_test(test_ball),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
