/* Comparison of two groups with known moduli, positions and rates: every column of its tables
 * against formulas written here.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "core/table/registry.h"
#include "study/compare.h"
#include "weartrack/case.h"

enum { SPOTS = 3, RATES = 2 };

#define BULK 5e6
#define RATIO 0.8
/* standard deviation of ln E between positions: one lower, one higher */
#define SCATTER 0.03
#define T_2 4.302652729749464 /* 97.5 % points of Student's t */
#define T_4 2.776445105197793

static const double rate[RATES] = {1e-6, 2e-5};     /* [m/s] */
static const double frequency[RATES] = {300, 9000}; /* [rad/s] */
static const double with_rate[RATES] = {0.9, 1.0 / 0.9};
static const double spread[RATES] = {1, 1.5}; /* factor of the scatter at a rate */

/* Value of curve i at a rate: the geometric means over the three are the nominal ones. */
static const double shift[SPOTS] = {1.1, 1 / 1.1, 1};

static double modulus(double mean, int r, int spot)
{
    return mean * with_rate[r] * exp((spot - 1) * SCATTER * spread[r]);
}

static wt_curve_verdict verdict_of_all = WT_CURVE_ACCEPTED; /* except the rejected one */
static int n_names = SPOTS; /* names of positions; the others have the same names */

/* Force, depth and pull of the curves; unknown without a force. */
typedef struct pressed_curves {
    double force, depth, pull_bulk, pull_track;
} pressed_curves;
static pressed_curves pressed;

/* An indentation table with all columns; one curve for each position and rate, one rejected. */
static wt_table *indentation(const char *group, double mean)
{
    static const struct {
        const char *name, *unit;
    } columns[] = {{"file", NULL},
                   {"curve", "1"},
                   {"spot", NULL},
                   {"x", "m"},
                   {"y", "m"},
                   {"verdict", NULL},
                   {"reason", NULL},
                   {"modulus", "Pa"},
                   {"modulus_standard_error", "Pa"},
                   {"contact_point", "m"},
                   {"contact_point_standard_error", "m"},
                   {"baseline_offset", "N"},
                   {"baseline_tilt", "N/m"},
                   {"noise", "N"},
                   {"max_force", "N"},
                   {"max_indentation", "m"},
                   {"adhesion_force", "N"},
                   {"piezo_rate", "m/s"},
                   {"indentation_rate", "m/s"},
                   {"load_time", "s"},
                   {"second_minimum_ratio", "1"},
                   {"sensitivity_gain", "1"},
                   {"equivalent_frequency", "rad/s"}};
    enum { SPOT = 2, VERDICT = 5, MODULUS = 7, MAX_FORCE = 14, RATE = 18, FREQUENCY = 22 };
    char name[64], spot[8];
    snprintf(name, sizeof name, "indentation/%s", group);
    wt_table *t = wt_table_new(name, group);
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        assert_int_equal(columns[c].unit == NULL
                             ? wt_table_add_text_column(t, columns[c].name, "", NULL)
                             : wt_table_add_column(t, columns[c].name, columns[c].unit, "", NULL),
                         WT_OK);
    for (int i = 0; i <= SPOTS * RATES; i++) {
        int r = i / SPOTS, s = i % SPOTS;
        bool good = i < SPOTS * RATES;
        snprintf(spot, sizeof spot, "s%d", s % n_names);
        assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
        wt_table_set_text(t, SPOT, spot);
        const char *said = good ? wt_curve_verdict_id(verdict_of_all) : "saturated";
        wt_table_set_text(t, VERDICT, said);
        if (!good)
            break;
        wt_table_set_number(t, MODULUS, modulus(mean, r, s));
        if (pressed.force > 0) {
            const double pull = group[0] == 't' ? pressed.pull_track : pressed.pull_bulk;
            wt_table_set_number(t, MAX_FORCE, pressed.force);
            wt_table_set_number(t, MAX_FORCE + 1, pressed.depth);
            wt_table_set_number(t, MAX_FORCE + 2, pull * (1 + 0.01 * s));
        }
        wt_table_set_number(t, RATE, rate[r] * shift[s]);
        wt_table_set_number(t, FREQUENCY, frequency[r] * shift[(s + 1) % SPOTS]);
    }
    assert_int_equal(wt_table_set_key(t, "spots", "named", NULL), WT_OK);
    return t;
}

/* ---- statistics, from the textbook ----------------------------------------------------------- */

typedef struct sample {
    double mean, variance;
} sample;

static sample sample_of(const double *x, int n)
{
    sample s = {0, 0};
    for (int i = 0; i < n; i++)
        s.mean += x[i] / n;
    for (int i = 0; i < n; i++)
        s.variance += (x[i] - s.mean) * (x[i] - s.mean) / (n - 1);
    return s;
}

/* Two-sided p of Student's t by Simpson's rule between -t and t. */
static double p_of_t(double t, double df)
{
    enum { N = 20000 };
    double scale = exp(lgamma((df + 1) / 2) - lgamma(df / 2)) / sqrt(df * 3.14159265358979324);
    double sum = 0, h = 2 * fabs(t) / N;
    for (int i = 0; i <= N; i++) {
        double x = -fabs(t) + h * i, f = scale * pow(1 + x * x / df, -(df + 1) / 2);
        sum += f * (i == 0 || i == N ? 1 : i % 2 == 1 ? 4 : 2);
    }
    return 1 - sum * h / 3;
}

typedef struct expected {
    double t, df, p;
} expected;

/* Welch's test of ln E of the units of two groups; r < 0: units are positions over all rates. */
static expected welch(double bulk, double track, int r)
{
    double x[2][SPOTS], mean[2] = {bulk, track};
    for (int g = 0; g < 2; g++)
        for (int s = 0; s < SPOTS; s++)
            x[g][s] = r >= 0 ? log(modulus(mean[g], r, s))
                             : (log(modulus(mean[g], 0, s)) + log(modulus(mean[g], 1, s))) / RATES;
    sample a = sample_of(x[0], SPOTS), b = sample_of(x[1], SPOTS);
    double va = a.variance / SPOTS, vb = b.variance / SPOTS;
    expected e = {(b.mean - a.mean) / sqrt(va + vb), 0, 0};
    e.df = (va + vb) * (va + vb) / ((va * va + vb * vb) / (SPOTS - 1));
    e.p = p_of_t(e.t, e.df);
    return e;
}

/* ---- tests ----------------------------------------------------------------------------------- */

static wt_table *bulk_table, *track_table;
static wt_compare_tables tables;

static wt_rubber rubber_of(double *tau, double *term)
{
    return (wt_rubber){.prony = {.deformation = WT_TENSION,
                                 .reference_temperature = 293.15,
                                 .equilibrium_modulus = 2e6,
                                 .n = 1,
                                 .relaxation_time = tau,
                                 .modulus = term,
                                 .frequency_min = 10,
                                 .frequency_max = 5000},
                       .poisson_ratio = 0.5,
                       .law = {.kind = WT_LAW_WLF, .wlf = {293.15, 6.5, 110}},
                       .temperature_min = 273.15,
                       .temperature_max = 333.15};
}

/* The temperature is stated, because otherwise it may be the cause of a difference. */
static wt_compare_job at_one_temperature(void)
{
    wt_compare_job job = wt_compare_job_defaults();
    job.temperature.value = WT_ZERO_CELSIUS + 23;
    return job;
}

static void compare(double ratio, double temperature)
{
    static double tau = 1e-3, term = 6e6;
    wt_rubber rubber = rubber_of(&tau, &term);
    wt_job common = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    wt_table_free(bulk_table);
    wt_table_free(track_table);
    wt_tables_clear(&tables, sizeof tables);
    bulk_table = indentation("bulk", BULK);
    track_table = indentation("track", ratio * BULK);
    wt_compare_job job = wt_compare_job_defaults();
    job.bulk = bulk_table;
    job.track = track_table;
    job.rubber = &rubber;
    job.temperature.value = temperature;
    if (wt_compare_groups(&job, &common, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
}

static int clean(void **state)
{
    (void)state;
    wt_table_free(bulk_table);
    wt_table_free(track_table);
    wt_tables_clear(&tables, sizeof tables);
    return 0;
}

static void check_row(size_t row, int r, double ratio)
{
    const wt_table *c = tables.comparison;
    double scatter = SCATTER * (r < 0 ? (spread[0] + spread[1]) / 2 : spread[r]);
    double reach = T_4 * scatter * sqrt(2.0 / SPOTS);
    expected e = welch(BULK, ratio * BULK, r);
    assert_near(cell(c, row, "ratio"), ratio, 1e-12);
    assert_near(cell(c, row, "ratio_low"), ratio * exp(-reach), 1e-9);
    assert_near(cell(c, row, "ratio_high"), ratio * exp(reach), 1e-9);
    assert_near(cell(c, row, "welch_t"), e.t, 1e-9);
    assert_near(cell(c, row, "welch_df"), e.df, 1e-9);
    assert_near(cell(c, row, "welch_p"), e.p, 1e-6);
    /* all of one group below all of the other: 2 of the 20 rankings are as extreme */
    assert_near(cell(c, row, "mann_whitney_p"), 0.1, 1e-12);
    assert_near(cell(c, row, "mann_whitney_smallest_p"), 0.1, 1e-12);
    assert_near(cell(c, row, "spots_bulk"), SPOTS, 0);
    assert_near(cell(c, row, "spots_track"), SPOTS, 0);
    /* Hedges' g = J d, J(4) = gamma(2) / (sqrt(2) gamma(3/2)); its usual approximation is 0.8 */
    assert_near(cell(c, row, "effect_size"), 0.79788 * log(ratio) / scatter, 0.005);
}

static void test_comparison(void **state)
{
    (void)state;
    static const double ratios[] = {RATIO, 1 / RATIO};
    for (int k = 0; k < 2; k++) {
        compare(ratios[k], 293.15);
        const wt_table *c = tables.comparison;
        assert_int_equal(wt_table_n_rows(c), 1 + RATES);
        assert_true(isnan(cell(c, 0, "rate_low")) && isnan(cell(c, 0, "rate_high")));
        assert_near(cell(c, 0, "n_bulk"), SPOTS * RATES, 0);
        assert_near(cell(c, 0, "n_track"), SPOTS * RATES, 0);
        check_row(0, -1, ratios[k]);
        assert_true(isnan(cell(c, 0, "holm_p")));
        for (int r = 0; r < RATES; r++) {
            size_t row = (size_t)r + 1;
            check_row(row, r, ratios[k]);
            assert_near(cell(c, row, "rate_low"), rate[r] / 1.1, 1e-12);
            assert_near(cell(c, row, "rate_high"), rate[r] * 1.1, 1e-12);
            assert_near(cell(c, row, "n_bulk"), SPOTS, 0);
            assert_near(cell(c, row, "n_track"), SPOTS, 0);
        }
        /* the scatter is smaller at the first rate, and so is its p */
        double p[2] = {cell(c, 1, "welch_p"), cell(c, 2, "welch_p")};
        assert_true(p[0] < p[1]);
        assert_near(cell(c, 1, "holm_p"), 2 * p[0], 1e-12);
        assert_near(cell(c, 2, "holm_p"), fmax(2 * p[0], p[1]), 1e-12);
        assert_string_equal(wt_table_key(c, "unit_of_analysis"), "spot");
        wt_estimate e = key_estimate(c, "modulus_ratio");
        double scatter = SCATTER * (spread[0] + spread[1]) / 2;
        assert_near(e.value, ratios[k], 1e-12);
        assert_near(e.standard_error, ratios[k] * scatter * sqrt(2.0 / SPOTS), 1e-9);
    }
}

static const char *verdict_of(wt_compare_job job, double ratio)
{
    wt_job common = wt_job_defaults();
    wt_table_free(bulk_table);
    wt_table_free(track_table);
    wt_tables_clear(&tables, sizeof tables);
    bulk_table = indentation("bulk", BULK);
    track_table = indentation("track", ratio * BULK);
    job.bulk = bulk_table;
    job.track = track_table;
    assert_int_equal(wt_compare_groups(&job, &common, &tables, NULL), WT_OK);
    return wt_table_key(tables.comparison, "differs");
}

static const char *verdict(double ratio, double margin)
{
    wt_compare_job job = at_one_temperature();
    job.margin = margin;
    return verdict_of(job, ratio);
}

/* Half of the interval is 0.085 in ln. */
static void test_verdict(void **state)
{
    (void)state;
    assert_string_equal(verdict(0.85, 0.2), "yes: the wear track is softer than the bulk");
    assert_string_equal(verdict(1.15, 0.2), "yes: the wear track is stiffer than the bulk");
    assert_string_equal(verdict(0.91, 0.25),
                        "yes: the wear track is softer than the bulk, by less than the margin");
    assert_string_equal(verdict(1.02, 0.2), "no: the wear track differs from the bulk by less than "
                                            "20 %, the margin set");
    assert_null(wt_table_key(tables.comparison, "settled_by"));
    assert_string_equal(verdict(1.02, 0.05),
                        "inconclusive: the interval of the ratio contains both no difference "
                        "and one above 5 %");
    assert_non_null(strstr(wt_table_key(tables.comparison, "settled_by"),
                           "spots in each group would show a difference of 5 %"));
}

/* No temperature is stated, and there is no DMA: by the slope against the rate and the WLF law 70 K
 * above the glass transition, 0.14 per kelvin, 20 K in either direction. */
static void test_unstated_temperature(void **state)
{
    (void)state;
    const double ratio = 0.85;
    assert_non_null(strstr(verdict(ratio, 0.2), "yes"));
    const wt_table *c = tables.comparison;
    const double low = cell(c, 0, "ratio_low"), high = cell(c, 0, "ratio_high"),
                 error = key_estimate(c, "modulus_ratio").standard_error / ratio;
    const double slope = 0.14 * key_estimate(c, "rate_slope").value;
    char warmer[64];
    snprintf(warmer, sizeof warmer, "a track %.2g K warmer", -log(ratio) / slope);
    const char *said = verdict_of(wt_compare_job_defaults(), ratio);
    assert_non_null(strstr(said, "inconclusive: the wear track seems softer"));
    assert_non_null(strstr(said, warmer));
    c = tables.comparison;
    assert_non_null(strstr(wt_table_key(c, "settled_by"), "indentation-temperature"));
    assert_near(cell(c, 0, "ratio"), ratio, 1e-12);
    assert_near(cell(c, 0, "ratio_low"), low * exp(-20 * slope), 1e-9);
    assert_near(cell(c, 0, "ratio_high"), high * exp(20 * slope), 1e-9);
    assert_near(key_estimate(c, "modulus_ratio").standard_error / ratio,
                hypot(error, 20 * slope * sqrt(2.0 / 3)), 1e-9);
    assert_non_null(strstr(wt_table_key(c, "interval_includes"), "what else may well make"));
    /* effects that 20 K cannot cause, and the difference that they could hide */
    assert_non_null(strstr(verdict_of(wt_compare_job_defaults(), 0.6), "yes"));
    assert_non_null(strstr(wt_table_key(tables.comparison, "would_explain"), "K warmer"));
    assert_non_null(strstr(verdict_of(wt_compare_job_defaults(), 1.02), "no:"));
}

/* The note on two positions is also written if the other group has more. */
static void test_two_spots(void **state)
{
    (void)state;
    static const int names[][2] = {{3, 2}, {2, 3}, {2, 2}, {3, 3}};
    static const char *const words[] = {"the two spots of the track do not determine",
                                        "the two spots of the bulk do not determine", NULL, NULL};
    for (size_t i = 0; i < 4; i++) {
        wt_job common = wt_job_defaults();
        wt_compare_job job = wt_compare_job_defaults();
        wt_compare_tables made = {0};
        common.log = wt_log_new();
        n_names = names[i][0];
        wt_table *bulk = indentation("bulk", BULK);
        n_names = names[i][1];
        wt_table *track = indentation("track", RATIO * BULK);
        n_names = SPOTS;
        job.bulk = bulk;
        job.track = track;
        assert_int_equal(wt_compare_groups(&job, &common, &made, NULL), WT_OK);
        bool said = false;
        for (size_t j = 0; j < wt_log_count(common.log); j++) {
            const char *text = wt_log_get(common.log, j).text;
            said = said || strstr(text, words[i] != NULL ? words[i] : "the two spots") != NULL;
        }
        assert_int_equal(said, words[i] != NULL);
        wt_tables_clear(&made, sizeof made);
        wt_table_free(bulk);
        wt_table_free(track);
        wt_log_free(common.log);
    }
}

static void test_groups(void **state)
{
    (void)state;
    compare(RATIO, (double)NAN);
    const wt_table *t = tables.modulus_groups;
    assert_int_equal(wt_table_n_rows(t), 2);
    for (size_t g = 0; g < 2; g++) {
        double mean = g == 0 ? BULK : RATIO * BULK, x[SPOTS * RATES], scatter;
        scatter = SCATTER * (spread[0] + spread[1]) / 2;
        for (int i = 0; i < SPOTS * RATES; i++)
            x[i] = modulus(mean, i / SPOTS, i % SPOTS);
        sample s = sample_of(x, SPOTS * RATES);
        double reach = T_2 * scatter / sqrt(SPOTS);
        assert_string_equal(cell_text(t, g, "group"), g == 0 ? "bulk" : "track");
        assert_near(cell(t, g, "n"), SPOTS * RATES, 0);
        assert_near(cell(t, g, "n_rejected"), 1, 0);
        assert_near(cell(t, g, "n_spots"), SPOTS, 0);
        assert_near(cell(t, g, "mean"), s.mean, 1e-12);
        assert_near(cell(t, g, "standard_deviation"), sqrt(s.variance), 1e-9);
        /* between the stiffest of the slow ones and the softest of the fast ones */
        assert_near(cell(t, g, "median"), (modulus(mean, 0, 2) + modulus(mean, 1, 0)) / 2, 1e-12);
        assert_near(cell(t, g, "geometric_mean"), mean, 1e-12);
        assert_near(cell(t, g, "low"), mean * exp(-reach), 1e-9);
        assert_near(cell(t, g, "high"), mean * exp(reach), 1e-9);
    }
}

static void test_rates(void **state)
{
    (void)state;
    compare(RATIO, (double)NAN);
    const wt_table *t = tables.modulus_rate;
    assert_int_equal(wt_table_n_rows(t), 2 * RATES);
    for (size_t i = 0; i < 2 * RATES; i++) {
        size_t r = i % RATES;
        double mean = (i < RATES ? BULK : RATIO * BULK) * with_rate[r];
        double reach = T_2 * SCATTER * spread[r] / sqrt(SPOTS);
        assert_string_equal(cell_text(t, i, "group"), i < RATES ? "bulk" : "track");
        assert_near(cell(t, i, "indentation_rate"), rate[r], 1e-12);
        assert_near(cell(t, i, "equivalent_frequency"), frequency[r], 1e-12);
        assert_near(cell(t, i, "n"), SPOTS, 0);
        assert_near(cell(t, i, "geometric_mean"), mean, 1e-12);
        assert_near(cell(t, i, "low"), mean * exp(-reach), 1e-9);
        assert_near(cell(t, i, "high"), mean * exp(reach), 1e-9);
        assert_int_equal(wt_table_block(t, i), i / RATES);
    }
}

/* Against a rubber with much loss, so that |E*| differs from E'; also at another temperature. */
static void test_dma(void **state)
{
    (void)state;
    static const double temperatures[] = {(double)NAN, 303.15, 288.15};
    for (size_t k = 0; k < 3; k++) {
        double step = k == 0 ? 0 : temperatures[k] - 293.15;
        double a = pow(10, -6.5 * step / (110 + step));
        compare(RATIO, temperatures[k]);
        const wt_table *t = tables.dma_comparison;
        assert_int_equal(wt_table_n_rows(t), 2 * RATES);
        for (size_t i = 0; i < 2 * RATES; i++) {
            size_t r = i % RATES;
            double mean = (i < RATES ? BULK : RATIO * BULK) * with_rate[r];
            double z = frequency[r] * 1e-3 * a, storage = 2e6 + 6e6 * z * z / (1 + z * z);
            double loss = 6e6 * z / (1 + z * z), complex = sqrt(storage * storage + loss * loss);
            double reach = T_2 * SCATTER * spread[r] / sqrt(SPOTS);
            assert_string_equal(cell_text(t, i, "group"), i < RATES ? "bulk" : "track");
            assert_near(cell(t, i, "equivalent_frequency"), frequency[r], 1e-12);
            assert_near(cell(t, i, "indentation_modulus"), mean, 1e-12);
            assert_near(cell(t, i, "low"), mean * exp(-reach), 1e-9);
            assert_near(cell(t, i, "high"), mean * exp(reach), 1e-9);
            assert_near(cell(t, i, "dma_storage_modulus"), storage, 1e-9);
            assert_near(cell(t, i, "dma_complex_modulus"), complex, 1e-9);
            assert_true(isnan(cell(t, i, "dma_complex_modulus_standard_error")));
            assert_near(cell(t, i, "ratio"), mean / complex, 1e-9);
            assert_near(cell(t, i, "extrapolated"),
                        frequency[r] * a < 10 || frequency[r] * a > 5000 ? 1 : 0, 0);
        }
        assert_string_equal(wt_table_key(t, "standard_error_excludes"), "material");
        assert_near(key_estimate(t, "temperature").value, 293.15 + step, 1e-12);
        assert_int_equal(wt_table_block(t, RATES), 0);
    }
}

static double complex_modulus(double step)
{
    const double z = sqrt(frequency[0] * frequency[1]) * 1e-3 * pow(10, -6.5 * step / (110 + step));
    return hypot(2e6 + 6e6 * z * z / (1 + z * z), 6e6 * z / (1 + z * z));
}

/* The track as soft as 10 K make it, times `ratio`. */
static const char *warmer(double ratio, bool temperature_known, const wt_rubber *rubber,
                          double step_error)
{
    const double change = complex_modulus(10) / complex_modulus(0);
    wt_job common = wt_job_defaults();
    wt_table_free(bulk_table);
    wt_table_free(track_table);
    wt_tables_clear(&tables, sizeof tables);
    bulk_table = indentation("bulk", BULK);
    track_table = indentation("track", ratio * change * BULK);
    wt_compare_job job = wt_compare_job_defaults();
    job.bulk = bulk_table;
    job.track = track_table;
    job.rubber = rubber;
    job.temperature = (wt_estimate){293.15, 0, 0, "K"};
    if (temperature_known)
        job.track_temperature = (wt_estimate){303.15, step_error, 0, "K"};
    assert_int_equal(wt_compare_groups(&job, &common, &tables, NULL), WT_OK);
    return wt_table_key(tables.comparison, "differs");
}

/* Returns the verdict on a track that is 1.25 times as stiff, with a DMA of `dma` times the bulk.
 */
static const char *beside_dma(double dma, wt_cantilever_sharing cantilevers)
{
    static double tau = 1e-3, none = 0;
    wt_rubber rubber = rubber_of(&tau, &none);
    rubber.prony.equilibrium_modulus = dma * BULK;
    wt_rubber_draw draw = {.prony = rubber.prony, .law = rubber.law};
    draw.prony.equilibrium_modulus *= 1.01;
    rubber.n_draws = 1;
    rubber.draws = &draw;
    wt_compare_job job = at_one_temperature();
    job.rubber = &rubber;
    job.cantilevers = cantilevers;
    return verdict_of(job, 1.25);
}

/* The calibration of the bulk may cause the ratio if the track agrees with the DMA and the bulk
 * does not. One stated cantilever, or an equal error of both groups, excludes it. */
static void test_calibration_of_the_bulk(void **state)
{
    (void)state;
    const char *const yes = "yes: the wear track is stiffer than the bulk";
    const char *said = beside_dma(1.25, WT_CANTILEVERS_AUTO);
    assert_non_null(strstr(said, "inconclusive"));
    assert_non_null(strstr(said, "0.8 times the modulus of its DMA where the track has 1 times"));
    assert_true(cell(tables.comparison, 0, "ratio_low") < 1);
    assert_string_equal(beside_dma(1.25, WT_CANTILEVERS_SHARED), yes);
    assert_string_equal(beside_dma(1, WT_CANTILEVERS_AUTO), yes);
    assert_string_equal(beside_dma(0.8, WT_CANTILEVERS_AUTO), yes);
    assert_string_equal(beside_dma(2, WT_CANTILEVERS_AUTO), yes);
}

/* On a rubber with much loss 10 K look like a layer, unless the material corrects for them. */
static void test_warmer(void **state)
{
    (void)state;
    static double tau = 1e-3, term = 6e6;
    const wt_rubber rubber = rubber_of(&tau, &term);
    const double scatter = SCATTER * (spread[0] + spread[1]) / 2 * sqrt(2.0 / SPOTS);
    assert_string_equal(warmer(1, false, &rubber, 0),
                        "yes: the wear track is softer than the bulk");
    assert_near(key_estimate(tables.comparison, "modulus_ratio").value,
                complex_modulus(10) / complex_modulus(0), 1e-9);
    assert_non_null(strstr(warmer(1, true, NULL, 0),
                           "inconclusive: bulk and track were indented at "
                           "different temperatures"));
    assert_null(wt_table_key(tables.comparison, "modulus_ratio"));
    /* the material states no error, so that its shift may be wrong by more than the margin */
    assert_non_null(strstr(warmer(1, true, &rubber, 0), "is not known: material"));
    assert_non_null(strstr(wt_table_key(tables.comparison, "differs"), "inconclusive"));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").value, 1, 1e-9);
    assert_string_equal(warmer(RATIO, true, &rubber, 0),
                        "yes: the wear track is softer than the bulk");
    assert_near(key_estimate(tables.comparison, "modulus_ratio").value, RATIO, 1e-9);
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error, RATIO * scatter,
                1e-9);
    /* one line of the DMA for each temperature */
    assert_int_equal(wt_table_block(tables.dma_comparison, RATES - 1), 0);
    assert_int_equal(wt_table_block(tables.dma_comparison, RATES), 1);
    /* and the error of the shift, by the slope of ln |E*| there */
    warmer(RATIO, true, &rubber, 0.5);
    const double slope = log(complex_modulus(11) / complex_modulus(9)) / 2;
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(scatter, 0.5 * slope), 1e-9);
    /* a material without a stated error is not exact */
    const char *includes = wt_table_key(tables.comparison, "interval_includes");
    assert_non_null(strstr(includes, "but not, for it is not known: material"));
    assert_non_null(strstr(includes, "temperatures"));
}

/* A temperature below the pole of the law, or without a law, makes the result inconclusive. */
static void test_temperature_out_of_range(void **state)
{
    (void)state;
    static double tau = 1e-3, term = 6e6;
    wt_rubber rubber = rubber_of(&tau, &term);
    rubber.law.wlf = (wt_wlf){403.15, 6.5, 105}; /* the pole is between bulk and track */
    assert_non_null(strstr(warmer(1, true, &rubber, 0), "inconclusive: the DMA does not reach"));
    assert_null(wt_table_key(tables.comparison, "modulus_ratio"));
    assert_non_null(strstr(wt_table_key(tables.comparison, "settled_by"), "temperature-slope"));
    assert_non_null(strstr(wt_table_key(tables.dma_comparison, "material_statement"), "none at "));
    for (size_t i = 0; i < 2 * RATES; i++)
        assert_int_equal(isnan(cell(tables.dma_comparison, i, "ratio")) != 0, i < RATES);
    rubber.law.kind = WT_LAW_NONE;
    assert_non_null(strstr(warmer(1, true, &rubber, 0), "no shift law"));
    /* at one temperature the question does not arise */
    assert_string_equal(warmer(RATIO, false, &rubber, 0),
                        "yes: the wear track is softer than the bulk");
}

static const char *includes_of(wt_compare_job job)
{
    wt_job common = wt_job_defaults();
    wt_tables_clear(&tables, sizeof tables);
    job.bulk = bulk_table;
    job.track = track_table;
    assert_int_equal(wt_compare_groups(&job, &common, &tables, NULL), WT_OK);
    return wt_table_key(tables.comparison, "interval_includes");
}

/* An unknown error is named; a known one is not replaced with a default. */
static void test_not_known(void **state)
{
    (void)state;
    static double tau = 1e-3, term = 6e6;
    const wt_rubber rubber = rubber_of(&tau, &term);
    const double scatter = SCATTER * (spread[0] + spread[1]) / 2 * sqrt(2.0 / SPOTS);
    compare(RATIO, (double)NAN);
    wt_compare_job job = wt_compare_job_defaults();
    assert_null(strstr(includes_of(job), "sensitivity"));
    job.sensitivity_error = 0.05; /* no curve states its effect on the modulus */
    assert_non_null(strstr(includes_of(job), "but not, for it is not known: deflection "
                                             "sensitivity"));
    job = wt_compare_job_defaults();
    job.rubber = &rubber; /* the bulk is at its reference temperature by default */
    job.track_temperature = (wt_estimate){303.15, 0.5, 0, "K"};
    job.temperature_slope = (wt_estimate){-0.02, 0.004, 0, "1/K"};
    assert_non_null(strstr(includes_of(job), "temperatures"));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").value, RATIO * exp(0.2), 1e-9);
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * exp(0.2) * hypot(scatter, hypot(0.02 * 0.5, 0.004 * 10)), 1e-9);
}

static void set_radius(wt_table *table, double error, double gain)
{
    const wt_estimate values[] = {{error, 0, 0, "1"}, {gain, 0, 0, "1"}};
    assert_int_equal(wt_table_set_estimate(table, "radius_error", values[0], NULL), WT_OK);
    assert_int_equal(wt_table_set_estimate(table, "radius_gain", values[1], NULL), WT_OK);
}

/* A tip that both groups share leaves the difference of their gains; two tips add both errors. Each
 * group has the whole error. */
static void test_shared_tip(void **state)
{
    (void)state;
    const double scatter = SCATTER * (spread[0] + spread[1]) / 2 * sqrt(2.0 / SPOTS);
    compare(RATIO, (double)NAN);
    set_radius(bulk_table, 0.2, -0.3);
    set_radius(track_table, 0.2, -0.5);
    wt_compare_job job = at_one_temperature();
    assert_non_null(strstr(includes_of(job), "radius of the tip"));
    assert_string_equal(wt_table_key(tables.comparison, "cancels"), "radius of the tip");
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(scatter, 0.2 * 0.2), 1e-9);
    job.cantilevers = WT_CANTILEVERS_SEPARATE;
    job.lever_error = 0.04;
    assert_non_null(includes_of(job));
    assert_null(wt_table_key(tables.comparison, "cancels"));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(hypot(scatter, 0.04 * M_SQRT2), hypot(0.06, 0.1)), 1e-9);
    const wt_table *budget = tables.modulus_budget;
    assert_int_equal(wt_table_n_rows(budget), 10);
    for (size_t g = 0; g < 2; g++) {
        const double of_tip = 0.2 * (g == 0 ? 0.3 : 0.5),
                     all = cell(budget, 5 * g + 2, "relative_error"),
                     spots = cell(budget, 5 * g + 1, "relative_error");
        assert_string_equal(cell_text(budget, 5 * g, "group"), g == 0 ? "bulk" : "track");
        assert_near(cell(budget, 5 * g, "relative_error"), of_tip, 1e-9);
        assert_near(all, hypot(of_tip, spots), 1e-9);
        assert_near(cell(budget, 5 * g, "share") + cell(budget, 5 * g + 1, "share"), 1, 1e-9);
    }
    assert_near(key_estimate(budget, "modulus_track").standard_error,
                RATIO * BULK * cell(budget, 7, "relative_error"), 1e-6);
}

static void set_assumed(wt_table *table, double cantilever, double radius, double gain)
{
    const wt_estimate values[] = {
        {cantilever, 0, 0, "1"}, {1, 0, 0, "1"}, {radius, 0, 0, "1"}, {gain, 0, 0, "1"}};
    static const char *const keys[] = {"spring_constant_error_assumed", "spring_constant_gain",
                                       "radius_error_assumed", "radius_gain"};
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(wt_table_set_estimate(table, keys[i], values[i], NULL), WT_OK);
}

/* Assumed errors cancel like stated ones, count for two cantilevers, and are replaced with stated
 * ones. Two cantilevers still need a stated error for a verdict. */
static void test_assumed(void **state)
{
    (void)state;
    const double scatter = SCATTER * (spread[0] + spread[1]) / 2 * sqrt(2.0 / SPOTS);
    compare(RATIO, (double)NAN);
    set_assumed(bulk_table, 0.1, 0.2, -0.3);
    set_assumed(track_table, 0.1, 0.2, -0.5);
    wt_compare_job job = at_one_temperature();
    assert_non_null(strstr(includes_of(job), "radius of the tip"));
    assert_string_equal(wt_table_key(tables.comparison, "cancels"),
                        "spring constants, radius of the tip");
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(scatter, 0.2 * 0.2), 1e-9);
    const wt_table *groups = tables.modulus_groups;
    for (size_t g = 0; g < 2; g++)
        assert_true(log(cell(groups, g, "high") / cell(groups, g, "low")) >
                    2 * 1.96 * hypot(0.1, g == 0 ? 0.06 : 0.1));
    job.cantilevers = WT_CANTILEVERS_SEPARATE;
    (void)includes_of(job);
    assert_non_null(strstr(wt_table_key(tables.comparison, "differs"),
                           "the error of a spring constant is not stated"));
    job.lever_error = 0.04;
    assert_non_null(includes_of(job));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(hypot(scatter, 0.04 * M_SQRT2), hypot(0.06, 0.1)), 1e-9);
    assert_near(cell(tables.modulus_budget, 0, "relative_error"), 0.04, 1e-9);
    job.tip_error = 0.01;
    assert_non_null(includes_of(job));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(hypot(scatter, 0.04 * M_SQRT2), 0.01 * M_SQRT2), 1e-9);
    assert_string_equal(cell_text(tables.modulus_budget, 2, "source"), "shape of the tip");
    assert_near(cell(tables.modulus_budget, 2, "relative_error"), 0.01, 1e-9);
}

/* So does a half-angle; the option for tips without stated errors is then not used. */
static void test_half_angle(void **state)
{
    (void)state;
    const double scatter = SCATTER * (spread[0] + spread[1]) / 2 * sqrt(2.0 / SPOTS);
    compare(RATIO, (double)NAN);
    for (size_t g = 0; g < 2; g++) {
        wt_table *const table = g == 0 ? bulk_table : track_table;
        const wt_estimate error = {0.1, 0, 0, "1"}, gain = {g == 0 ? -1.5 : -1.9, 0, 0, "1"};
        assert_int_equal(wt_table_set_estimate(table, "half_angle_error", error, NULL), WT_OK);
        assert_int_equal(wt_table_set_estimate(table, "half_angle_gain", gain, NULL), WT_OK);
    }
    wt_compare_job job = at_one_temperature();
    job.tip_error = 0.7;
    assert_non_null(strstr(includes_of(job), "half-angle of the tip"));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(scatter, 0.4 * 0.1), 1e-9);
}

static void set_lever(wt_table *table, double value, double error)
{
    const wt_estimate cantilever = {value, error, 0, "N/m"};
    assert_int_equal(wt_table_set_estimate(table, "spring_constant", cantilever, NULL), WT_OK);
}

/* Two cantilevers of 0.5 +- 0.05 and 2 +- 0.06 N/m: 10 % and 3 %, for any option for those without
 * an error. Unless both are stated, the option applies to both. */
static void test_stated_cantilevers(void **state)
{
    (void)state;
    const double scatter = SCATTER * (spread[0] + spread[1]) / 2 * sqrt(2.0 / SPOTS);
    compare(RATIO, (double)NAN);
    set_lever(bulk_table, 0.5, 0.05);
    set_lever(track_table, 2, 0.06);
    wt_compare_job job = at_one_temperature();
    job.cantilevers = WT_CANTILEVERS_SEPARATE;
    job.lever_error = 0.3;
    assert_non_null(strstr(includes_of(job), "spring constants"));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(scatter, hypot(0.1, 0.03)), 1e-9);
    set_lever(track_table, 2, 0);
    assert_non_null(includes_of(job));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(scatter, hypot(0.1, 0.3)), 1e-9);
}

/* A value that is not stated has no error, and its numerical error does not apply. */
static void test_not_given(void **state)
{
    (void)state;
    const wt_compare_job job = wt_compare_job_defaults();
    const wt_estimate unset[] = {job.temperature, job.track_temperature, job.temperature_slope};
    for (size_t i = 0; i < sizeof unset / sizeof *unset; i++) {
        assert_true(isnan(unset[i].value) && isnan(unset[i].standard_error));
        assert_true(unset[i].numerical_error == 0);
    }
}

static void set_shown(wt_table *table, double loss, double bend)
{
    const wt_estimate values[] = {{loss, 0, 0, "1"}, {bend, 0, 0, "1"}};
    assert_int_equal(wt_table_set_estimate(table, "loss_error", values[0], NULL), WT_OK);
    assert_int_equal(wt_table_set_estimate(table, "bend_error", values[1], NULL), WT_OK);
}

/* Hysteresis loss and curvature: one piezo distorts both groups equally, each group has its own
 * spectrum. If that dominates the interval, no more positions are advised. */
static void test_shown_loss_and_curvature(void **state)
{
    (void)state;
    const double scatter = SCATTER * (spread[0] + spread[1]) / 2 * sqrt(2.0 / SPOTS);
    compare(RATIO, (double)NAN);
    set_shown(bulk_table, 0.03, 0.05);
    set_shown(track_table, 0.04, -0.02);
    wt_compare_job job = at_one_temperature();
    const char *includes = includes_of(job);
    assert_non_null(includes);
    assert_non_null(strstr(includes, "loss of unknown spectrum, bend of the baselines"));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(scatter, hypot(0.05, 0.07)), 1e-9);
    job.cantilevers = WT_CANTILEVERS_SEPARATE;
    job.lever_error = 0.01;
    assert_non_null(includes_of(job));
    assert_near(key_estimate(tables.comparison, "modulus_ratio").standard_error,
                RATIO * hypot(hypot(scatter, 0.01 * M_SQRT2), hypot(0.05, hypot(0.05, 0.02))),
                1e-9);
    set_shown(track_table, 0.4, -0.02);
    assert_non_null(includes_of(job));
    assert_non_null(strstr(wt_table_key(tables.comparison, "settled_by"), "a DMA of the rubber"));
}

static void set_shift(const char *key, double bulk, double track, double noise)
{
    const wt_estimate values[] = {{bulk, noise, 0, "1"}, {track, noise, 0, "1"}};
    assert_int_equal(wt_table_set_estimate(bulk_table, key, values[0], NULL), WT_OK);
    assert_int_equal(wt_table_set_estimate(track_table, key, values[1], NULL), WT_OK);
}

/* A choice of the fit moves both groups; the range of the ratio includes their difference beyond
 * the noise. A tip with a stated error is not a choice. */
static void test_model_choices(void **state)
{
    (void)state;
    wt_compare_job job = at_one_temperature();
    compare(RATIO, (double)NAN);
    assert_non_null(includes_of(job));
    assert_null(wt_table_key(tables.comparison, "model_choices_low"));
    assert_null(wt_table_key(tables.comparison, "widest_choice"));
    set_shift("range_shift_deep", 0.02, -0.1, 0);
    set_shift("range_shift_middle", 0, 0.03, 0.05); /* noise */
    set_shift("pull_shift", 0.1, 0.2, 0);
    set_radius(bulk_table, 0.02, -0.3);
    set_radius(track_table, 0.02, -0.9);
    assert_non_null(includes_of(job));
    assert_near(key_estimate(tables.comparison, "model_choices_low").value, RATIO * 0.9 / 1.02,
                1e-9);
    assert_near(key_estimate(tables.comparison, "model_choices_high").value, RATIO * 1.2 / 1.1,
                1e-9);
    assert_string_equal(wt_table_key(tables.comparison, "widest_choice"), "range of the fit");
    set_radius(bulk_table, (double)NAN, -0.3);
    set_radius(track_table, (double)NAN, -0.9);
    assert_non_null(includes_of(job));
    assert_near(key_estimate(tables.comparison, "model_choices_low").value, RATIO * pow(1.5, -0.6),
                1e-9);
    assert_near(key_estimate(tables.comparison, "model_choices_high").value, RATIO * pow(1.5, 0.6),
                1e-9);
    assert_string_equal(wt_table_key(tables.comparison, "widest_choice"), "shape of the tip");
    set_assumed(bulk_table, 0.1, 0.2, -0.3);
    set_assumed(track_table, 0.1, 0.2, -0.9);
    assert_non_null(includes_of(job));
    assert_string_equal(wt_table_key(tables.comparison, "widest_choice"), "shape of the tip");
    job.tip_error = 0.05;
    assert_non_null(includes_of(job));
    assert_string_equal(wt_table_key(tables.comparison, "widest_choice"), "range of the fit");
    /* a choice without a difference withdraws the verdict */
    assert_int_equal(strncmp(wt_table_key(tables.comparison, "differs"), "yes", 3), 0);
    set_shift("loss_shift", 0, 1 / RATIO, 0);
    assert_non_null(includes_of(job));
    assert_int_equal(strncmp(wt_table_key(tables.comparison, "differs"), "inconclusive", 12), 0);
    assert_string_equal(wt_table_key(tables.comparison, "settled_by"),
                        "Measure a DMA of the rubber.");
}

static void set_tip(wt_table *t)
{
    static const struct {
        const char *key;
        wt_estimate value;
    } tip[] = {{"tip_sides", {4, 0, 0, "1"}},
               {"tip_half_angle", {20 * M_PI / 180, 0, 0, "rad"}},
               {"tip_radius", {20e-9, 0, 0, "m"}},
               {"tip_transition_radius", {19e-9, 0, 0, "m"}}};
    assert_int_equal(wt_table_set_key(t, "tip_shape", "pyramid or cone with a cap", NULL), WT_OK);
    for (size_t i = 0; i < sizeof tip / sizeof *tip; i++)
        assert_int_equal(wt_table_set_estimate(t, tip[i].key, tip[i].value, NULL), WT_OK);
}

static double contact_force_at(double depth)
{
    const wt_tip tip = {.shape = WT_TIP_BLUNTED_PYRAMID,
                        .sides = 4,
                        .half_angle = 20 * M_PI / 180,
                        .radius = 20e-9,
                        .transition_radius = 19e-9};
    double force, slope;
    wt_contact_function(&tip, depth, &force, &slope);
    return force;
}

/* The pull that a group would need: the contact begins deeper by what it compensates, and the rest
 * of the curve is as steep as that of a stiffer sample. */
static void test_pull(void **state)
{
    (void)state;
    const double force = 50e-9, depth = 70e-9, stiffer = 1.15;
    wt_compare_job job = at_one_temperature();
    pressed = (pressed_curves){force, depth, 0.1e-9, 5e-9};
    compare(stiffer, (double)NAN);
    pressed = (pressed_curves){0};
    set_tip(bulk_table);
    set_tip(track_table);
    assert_non_null(includes_of(job));
    const char *const causes = wt_table_key(tables.comparison, "would_explain");
    assert_non_null(causes);
    const char *const cause = strstr(causes, "a pull of ");
    assert_non_null(cause);
    assert_non_null(strstr(cause, "more in the track"));
    char *unit;
    const double number = strtod(cause + strlen("a pull of "), &unit),
                 pull = number * (strncmp(unit, " nN", 3) == 0 ? 1e-9 : 1e-12);
    double low = depth, high = 100 * depth; /* the whole depth */
    for (int i = 0; i < 60; i++) {
        const double all = 0.5 * (low + high);
        if (contact_force_at(all - depth) / contact_force_at(all) < pull / (force + pull))
            low = all;
        else
            high = all;
    }
    assert_near((contact_force_at(low) - contact_force_at(low - depth)) / contact_force_at(depth),
                stiffer, 0.01);
}

/* An unknown effect of the loss on the moduli is not zero, and excludes the verdict "no". */
static void test_loss_not_known(void **state)
{
    (void)state;
    const wt_compare_job job = wt_compare_job_defaults();
    compare(1, (double)NAN); /* a colder track would hide a difference */
    assert_non_null(strstr(wt_table_key(tables.comparison, "differs"), "K colder than the bulk"));
    assert_non_null(strstr(wt_table_key(tables.comparison, "settled_by"), "track-temperature"));
    compare(1, 293.15);
    assert_non_null(strstr(wt_table_key(tables.comparison, "differs"), "no: the wear track"));
    set_shown(bulk_table, (double)NAN, 0);
    set_shown(track_table, 0.01, 0);
    assert_non_null(strstr(includes_of(job), "but not, for it is not known: loss of unknown"));
    assert_non_null(strstr(wt_table_key(tables.comparison, "differs"), "inconclusive"));
    assert_non_null(strstr(wt_table_key(tables.comparison, "settled_by"), "a DMA of the rubber"));
    set_shown(bulk_table, 0.01, 0);
    assert_non_null(includes_of(job));
    assert_non_null(strstr(wt_table_key(tables.comparison, "differs"), "no: the wear track"));
    /* nor is it in the error of a modulus */
    set_radius(bulk_table, 0.02, -0.3);
    set_shown(bulk_table, (double)NAN, 0);
    assert_non_null(includes_of(job));
    const wt_table *budget = tables.modulus_budget;
    assert_string_equal(cell_text(budget, 1, "source"), "loss of unknown spectrum");
    assert_true(isnan(cell(budget, 1, "relative_error")));
    assert_string_equal(cell_text(budget, 3, "source"), "all together");
    assert_true(isnan(cell(budget, 3, "relative_error")));
    assert_non_null(strstr(wt_table_key(budget, "says_bulk"), "nothing says what the loss"));
}

/* The error of the temperature is part of that of the DMA, and unknown where no law applies. */
static void test_temperature_error(void **state)
{
    (void)state;
    static double tau = 1e-3, term = 6e6;
    wt_rubber rubber = rubber_of(&tau, &term);
    const wt_job work = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    for (int i = 0; i < 3; i++) {
        const double error = i == 0 ? 0 : i == 1 ? 2 : 150; /* the last is beyond the pole */
        const material_state at = {303.15, sqrt(frequency[0] * frequency[1])};
        double relative = 1;
        assert_int_equal(compare_temperature_error(&rubber, at, error, &work, &relative, &err),
                         WT_OK);
        if (i == 2)
            assert_true(isnan(relative));
        else
            assert_near(relative, i * fabs(log(complex_modulus(12) / complex_modulus(8))) / 2,
                        1e-9);
    }
    compare(RATIO, 303.15);
    wt_compare_job job = wt_compare_job_defaults();
    job.rubber = &rubber;
    job.temperature = (wt_estimate){303.15, 2, 0, "K"};
    assert_non_null(includes_of(job));
    assert_near(key_estimate(tables.dma_comparison, "temperature").standard_error, 2, 1e-12);
}

/* Without an accepted curve in a group the other one has a result, with the most frequent reason of
 * rejection. */
static void test_none_accepted(void **state)
{
    (void)state;
    static const struct {
        wt_curve_verdict verdict;
        const char *settled_by;
    } cases[] = {{WT_CURVE_POOR_FIT, "whether it wore"},
                 {WT_CURVE_DRIFT, "begin farther from the sample"},
                 {WT_CURVE_NO_CONTACT, "pressed further"},
                 {WT_CURVE_SATURATED, "or a stiffer cantilever"},
                 {WT_CURVE_NEGATIVE, "the sign of the deflection"},
                 {WT_CURVE_UNREADABLE, "whose approach is there"}};
    const wt_job common = wt_job_defaults();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const int empty = (int)(i % 2);
        static const char *const names[2] = {"bulk", "track"};
        wt_table *groups[2];
        wt_compare_job job = wt_compare_job_defaults();
        wt_compare_tables made = {0};
        char words[256];
        for (int g = 0; g < 2; g++) {
            verdict_of_all = g == empty ? cases[i].verdict : WT_CURVE_ACCEPTED;
            groups[g] = indentation(names[g], BULK);
        }
        verdict_of_all = WT_CURVE_ACCEPTED;
        job.bulk = groups[0];
        job.track = groups[1];
        assert_int_equal(wt_compare_groups(&job, &common, &made, NULL), WT_OK);
        const wt_table *c = made.comparison;
        const size_t rejected = cases[i].verdict == WT_CURVE_SATURATED ? 7 : 6;
        snprintf(words, sizeof words,
                 "inconclusive: none of the 7 curves of the %s has a modulus (%zu: %s)",
                 empty ? "track" : "bulk", rejected, wt_curve_verdict_text(cases[i].verdict));
        assert_string_equal(wt_table_key(c, "differs"), words);
        assert_non_null(strstr(wt_table_key(c, "settled_by"), cases[i].settled_by));
        assert_int_equal(wt_table_n_rows(c), 1);
        assert_near(cell(c, 0, empty ? "n_bulk" : "n_track"), SPOTS * RATES, 0);
        assert_near(cell(c, 0, empty ? "spots_bulk" : "spots_track"), SPOTS, 0);
        assert_near(cell(c, 0, empty ? "n_track" : "n_bulk"), 0, 0);
        assert_true(isnan(cell(c, 0, "ratio")) && isnan(cell(c, 0, "ratio_low")));
        assert_null(wt_table_key(c, "modulus_ratio"));
        assert_int_equal(wt_table_n_rows(made.modulus_groups), 2);
        assert_near(cell(made.modulus_groups, (size_t)!empty, "geometric_mean"), BULK, 1e-9);
        assert_true(isnan(cell(made.modulus_groups, (size_t)empty, "geometric_mean")));
        wt_tables_clear(&made, sizeof made);
        wt_table_free(groups[0]);
        wt_table_free(groups[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_comparison),
        cmocka_unit_test(test_verdict),
        cmocka_unit_test(test_unstated_temperature),
        cmocka_unit_test(test_two_spots),
        cmocka_unit_test(test_none_accepted),
        cmocka_unit_test(test_groups),
        cmocka_unit_test(test_rates),
        cmocka_unit_test(test_dma),
        cmocka_unit_test(test_calibration_of_the_bulk),
        cmocka_unit_test(test_warmer),
        cmocka_unit_test(test_not_known),
        cmocka_unit_test(test_temperature_out_of_range),
        cmocka_unit_test(test_shared_tip),
        cmocka_unit_test(test_assumed),
        cmocka_unit_test(test_half_angle),
        cmocka_unit_test(test_stated_cantilevers),
        cmocka_unit_test(test_not_given),
        cmocka_unit_test(test_shown_loss_and_curvature),
        cmocka_unit_test(test_model_choices),
        cmocka_unit_test(test_pull),
        cmocka_unit_test(test_loss_not_known),
        cmocka_unit_test(test_temperature_error),
    };
    return cmocka_run_group_tests_name("comparison of known truth", tests, NULL, clean);
}
