/* Results of a run on groups with known moduli: softer, stiffer, inconclusive, one position.
 * Thickness and friction follow from them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth_fixture.h"

#include "weartrack/case.h"

#include <sys/stat.h>

enum { SPOTS = 3, RATES = 2 };

#define BULK 3e6
#define T_4 2.776445105197793 /* 97.5 % point of Student's t */
#define BY_RATE 1.05          /* factor of the ratio at the second rate */

static const double rate[RATES] = {1e-6, 2e-5};    /* rate of the piezo [m/s] */
static const double with_rate[RATES] = {1.0, 1.2}; /* stiffer at the faster rate */

static int track_from; /* first of the rates at which the track is indented */

static char folder[] = "/tmp/weartrack-answer-XXXXXX";
static wt_result *result;

/* ---- cases ----------------------------------------------------------------------------------- */

#define FILES(g)                                                                                   \
    "<files spot=\"1\">" g "0.tsv</files><files spot=\"2\">" g "1.tsv</files>"                     \
    "<files spot=\"3\">" g "2.tsv</files>"
#define ONE_FILE(g) "<files spot=\"1\">" g "1.tsv</files>"
#define INDENTATION(bulk, track)                                                                   \
    "<indentation><tip>" HERTZ_TIP "</tip><temperature>20degC</temperature>"                       \
    "<bulk spring-constant=\"10N/m +- 4%\">" bulk "</bulk>"                                        \
    "<track spring-constant=\"10N/m +- 4%\">" track "</track></indentation>"
#define COMPARE "<compare><track-to-bulk/><by-rate/></compare>"
#define SLIDING                                                                                    \
    "<dma><reference-temperature>20degC</reference-temperature>"                                   \
    "<prony deformation=\"tension\" frequency-min=\"1e-2rad/s\" frequency-max=\"1e8rad/s\">"       \
    "<equilibrium>2MPa</equilibrium><term time=\"1e-6s\" modulus=\"300MPa\"/>"                     \
    "<term time=\"1e-1s\" modulus=\"3MPa\"/></prony></dma>"                                        \
    "<roughness><self-affine><q0>2e3rad/m</q0><qr>4e3rad/m</qr><q1>1e6rad/m</q1>"                  \
    "<hurst>0.8</hurst><c0>2e-17m^4</c0></self-affine></roughness>"                                \
    "<sliding><pressure>0.4MPa</pressure><velocity>1e-3:1m/s:log:4</velocity>"                     \
    "<reference-velocity>0.1m/s</reference-velocity>"                                              \
    "<shear-stress>5MPa +- 10%</shear-stress></sliding>"
#define LAYER(wear, energy)                                                                        \
    "<layer><specific-wear-rate>" wear "</specific-wear-rate>"                                     \
    "<critical-energy>" energy "</critical-energy></layer>"                                        \
    "<compare><track-to-bulk/><by-rate/><indentation-to-dma/></compare>"

/* Writes a file for each position and group, with a curve at each rate. */
static void write_curves(double ratio, double scatter)
{
    char path[256];
    for (int g = 0; g < 2; g++)
        for (int s = 0; s < SPOTS; s++) {
            snprintf(path, sizeof path, "%s/%c%d.tsv", folder, "bt"[g], s);
            FILE *out = fopen(path, "w");
            assert_non_null(out);
            for (int r = g == 1 ? track_from : 0; r < RATES; r++) {
                hertz h = hertz_standard();
                h.modulus = BULK * with_rate[r] * exp((s - 1) * scatter);
                if (g == 1)
                    h.modulus *= ratio * (r == 0 ? 1 / sqrt(BY_RATE) : sqrt(BY_RATE));
                h.velocity = rate[r];
                h.seed = (uint64_t)(100 * g + 10 * s + r + 1);
                hertz_write(out, &h, r);
            }
            fclose(out);
        }
}

static void run(double ratio, double scatter, const char *body)
{
    char path[256];
    wt_case *c = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_run_options options = wt_run_defaults();
    size_t n_failed = 99;
    options.threads = 1;
    options.replicates = 8;
    write_curves(ratio, scatter);
    snprintf(path, sizeof path, "%s/case.xml", folder);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fprintf(out, "<case version=\"1\">%s</case>", body);
    fclose(out);
    wt_result_free(result);
    result = NULL;
    if (wt_case_read(path, &c, &err) != WT_OK ||
        wt_run_case(c, &options, NULL, &result, &n_failed, &err) != WT_OK)
        fail_msg("%s: %s %s", err.place, err.message, err.found);
    wt_case_free(c);
    assert_int_equal(n_failed, 0);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) == NULL ? -1 : 0;
}

static int clean(void **state)
{
    char path[256];
    (void)state;
    wt_result_free(result);
    for (int i = 0; i < 2 * SPOTS; i++) {
        snprintf(path, sizeof path, "%s/%c%d.tsv", folder, "bt"[i / SPOTS], i % SPOTS);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/case.xml", folder);
    unlink(path);
    return rmdir(folder);
}

/* ---- reading the answer ---------------------------------------------------------------------- */

enum { DIFFERS, THICKNESS, FRICTION }; /* rows of the answer */

static const char *answer(size_t row, const char *column)
{
    return cell_text(wt_result_find(result, "answer"), row, column);
}

static double answered(size_t row, const char *column)
{
    return cell(wt_result_find(result, "answer"), row, column);
}

/* Returns the limitation that contains the words, or NULL. */
static const char *limit(const char *words)
{
    const wt_table *limits = wt_result_find(result, "limits");
    assert_non_null(limits);
    for (size_t i = 0; i < wt_table_n_rows(limits); i++)
        if (strstr(cell_text(limits, i, "limit"), words) != NULL)
            return cell_text(limits, i, "limit");
    return NULL;
}

/* ---- tests ----------------------------------------------------------------------------------- */

static void check_verdict(double ratio, double scatter, const char *verdict, const char *sentence)
{
    run(ratio, scatter, INDENTATION(FILES("b"), FILES("t")) COMPARE);
    const double reach = T_4 * scatter * sqrt(2.0 / SPOTS), by_rate = sqrt(BY_RATE);
    assert_string_equal(answer(DIFFERS, "verdict"), verdict);
    assert_string_equal(answer(DIFFERS, "basis"), "measured");
    assert_non_null(strstr(answer(DIFFERS, "answer"), sentence));
    assert_near(answered(DIFFERS, "value"), ratio, 0.01);
    assert_near(answered(DIFFERS, "low"), ratio * exp(-reach), 0.02);
    assert_near(answered(DIFFERS, "high"), ratio * exp(reach), 0.02);
    /* an inconclusive result states how to decide it */
    assert_int_equal(answer(DIFFERS, "remedy")[0] != '\0', strcmp(verdict, "inconclusive") == 0);
    const wt_table *c = wt_result_find(result, "comparison"),
                   *groups = wt_result_find(result, "modulus_groups");
    assert_near(cell(c, 0, "effect_size"), 0.8 * log(ratio) / scatter, 0.15);
    /* 2 of the 20 rankings of 3 among 6 */
    assert_near(cell(c, 0, "mann_whitney_smallest_p"), 0.1, 1e-12);
    for (size_t g = 0; g < 2; g++) {
        assert_near(cell(groups, g, "geometric_mean"), (g == 0 ? 1 : ratio) * BULK * sqrt(1.2),
                    0.01);
        assert_near(cell(groups, g, "n"), 6, 0); /* SPOTS times RATES */
        assert_near(cell(groups, g, "n_spots"), SPOTS, 0);
    }
    assert_near(cell(c, 1, "ratio"), ratio / by_rate, 0.01);
    assert_near(cell(c, 2, "ratio"), ratio * by_rate, 0.01);
}

static void test_verdicts(void **state)
{
    (void)state;
    check_verdict(0.80, 0.03, "yes", "softer than the bulk");
    check_verdict(1.25, 0.03, "yes", "stiffer than the bulk");
    check_verdict(0.96, 0.1, "inconclusive", "The ratio depends on the rate");
    check_verdict(1.05, 0.1, "inconclusive", "The ratio depends on the rate");
}

/* One position permits no interval; more positions are the remedy. */
static void test_one_spot(void **state)
{
    (void)state;
    run(0.5, 0.03, INDENTATION(ONE_FILE("b"), ONE_FILE("t")) COMPARE);
    assert_string_equal(answer(DIFFERS, "verdict"), "not enough data");
    assert_true(isnan(answered(DIFFERS, "low")) && isnan(answered(DIFFERS, "high")));
    assert_non_null(strstr(answer(DIFFERS, "remedy"), "3 spots in each group"));
    const wt_table *groups = wt_result_find(result, "modulus_groups");
    assert_true(isnan(cell(groups, 0, "low")) && isnan(cell(groups, 1, "high")));
}

/* The ratio of one position has no error, so the interval of the prediction excludes it. */
static void test_one_spot_slides(void **state)
{
    (void)state;
    run(0.5, 0.03,
        INDENTATION(ONE_FILE("b"), ONE_FILE("t")) SLIDING LAYER("1e-3mm^3/(N m)", "1e10J/m^3"));
    assert_true(!isnan(answered(FRICTION, "low")));
    assert_non_null(strstr(limit("interval of the friction excludes errors of"), "modulus ratio"));
}

static double key(const char *table, const char *name)
{
    return key_estimate(wt_result_find(result, table), name).value;
}

/* Compares the tables of thickness and friction with one another. */
static void test_sliding(void **state)
{
    (void)state;
    run(0.6, 0.03,
        INDENTATION(FILES("b"), FILES("t")) SLIDING LAYER("1e-3mm^3/(N m)", "1e10J/m^3"));
    /* the bulk over |E*| of the series at 1/(time in contact) */
    const wt_table *dma = wt_result_find(result, "dma_comparison");
    for (int r = 0; r < RATES; r++) {
        hertz h = hertz_standard();
        h.modulus = BULK * with_rate[r];
        double omega = rate[r] / hertz_travel(&h), z = omega * 0.1, fast = omega * 1e-6;
        double storage = 2e6 + 3e6 * z * z / (1 + z * z);
        double loss = 3e6 * z / (1 + z * z) + 300e6 * fast;
        assert_near(cell(dma, (size_t)r, "ratio"), h.modulus / hypot(storage, loss), 0.01);
    }
    const double total = key("friction", "friction_at_reference"),
                 hysteresis = key("friction", "hysteresis_at_reference"),
                 area = key("friction", "area_ratio_at_reference"),
                 with = key("friction", "friction_with_layer_at_reference");
    assert_near(total, hysteresis + 5e6 * area / 0.4e6, 1e-9);
    assert_near(key("friction", "layer_thickness"), key("layer", "balance_thickness"), 1e-9);
    assert_near(key("friction", "layer_modulus_ratio"), 0.6, 0.01);
    assert_near(answered(FRICTION, "value"), with / total - 1, 1e-9);
    assert_string_equal(answer(THICKNESS, "verdict"), "predicted");
    assert_null(limit("The theory predicts no layer, but"));
    assert_null(limit("The indentation does not show this layer"));
    /* the sliding temperature is not stated */
    assert_non_null(limit("No sliding temperature is stated"));
}

/* Inconsistencies are reported: a layer without a difference, a difference without a layer. */
static void test_inconsistencies(void **state)
{
    (void)state;
    run(0.96, 0.1,
        INDENTATION(FILES("b"), FILES("t")) SLIDING LAYER("1e-3mm^3/(N m)", "1e10J/m^3"));
    assert_non_null(limit("The indentation does not show this layer"));
    assert_null(limit("The theory predicts no layer, but"));
    static const double ratios[] = {0.6, 1.5};
    for (int i = 0; i < 2; i++) {
        run(ratios[i], 0.03,
            INDENTATION(FILES("b"), FILES("t")) SLIDING LAYER("10mm^3/(N m)", "1e10J/m^3"));
        assert_near(answered(THICKNESS, "value"), 0, 0);
        assert_non_null(strstr(answer(THICKNESS, "answer"), "There is no layer"));
        assert_non_null(limit("The theory predicts no layer, but"));
        assert_null(limit("The indentation does not show this layer"));
        assert_true(key("layer", "critical_specific_wear_rate") < 1e-8);
        assert_near_abs(answered(FRICTION, "value"), 0, 1e-12);
    }
}

/* ---- same numbers everywhere ----------------------------------------------------------------- */

/* A number, its interval and its range over the model choices. */
typedef struct told {
    double value, low, high, model_low, model_high;
} told;

typedef double row_number(const wt_table *what_if, size_t row);

static double thickness_in(const wt_table *what_if, size_t row)
{
    return cell(what_if, row, "thickness");
}

static double total_in(const wt_table *what_if, size_t row)
{
    return cell(what_if, row, "friction");
}

static double hysteresis_in(const wt_table *what_if, size_t row)
{
    return cell(what_if, row, "hysteresis");
}

static double area_in(const wt_table *what_if, size_t row)
{
    return cell(what_if, row, "area_ratio");
}

static double with_layer_in(const wt_table *what_if, size_t row)
{
    return cell(what_if, row, "friction_with_layer");
}

static double change_in(const wt_table *what_if, size_t row)
{
    return with_layer_in(what_if, row) / total_in(what_if, row) - 1;
}

/* From the tables. */
static told table_memory(const char *table, const char *name, row_number *in)
{
    const wt_table *what_if = wt_result_find(result, "what_if");
    const wt_estimate e = key_estimate(wt_result_find(result, table), name);
    const double half = e.standard_error > 0 ? 1.959964 * e.standard_error : (double)NAN;
    told t = {e.value, e.value - half, e.value + half, in(what_if, 0), in(what_if, 0)};
    for (size_t i = 1; i < wt_table_n_rows(what_if); i++) {
        t.model_low = fmin(t.model_low, in(what_if, i));
        t.model_high = fmax(t.model_high, in(what_if, i));
    }
    return t;
}

static told of_ratio(void)
{
    const wt_table *c = wt_result_find(result, "comparison");
    return (told){cell(c, 0, "ratio"), cell(c, 0, "ratio_low"), cell(c, 0, "ratio_high"),
                  (double)NAN, (double)NAN};
}

/* A result row has the unrounded number. */
static void check_answer(size_t row, told t)
{
    assert_near(answered(row, "value"), t.value, 1e-12);
    assert_int_equal(isnan(answered(row, "low")), isnan(t.low));
    if (!isnan(t.low)) {
        assert_near(answered(row, "low"), fmax(t.low, t.value > 0 ? 0 : t.low), 1e-6);
        assert_near(answered(row, "high"), t.high, 1e-6);
    }
    if (isnan(t.model_low))
        return;
    assert_near(answered(row, "range_low"), t.model_low, 1e-12);
    assert_near(answered(row, "range_high"), t.model_high, 1e-12);
}

static double headline(const wt_table *headlines, const char *name, const char *suffix)
{
    char full[128];
    snprintf(full, sizeof full, "%s%s", name, suffix);
    for (size_t i = 0; i < wt_table_n_rows(headlines); i++)
        if (strcmp(cell_text(headlines, i, "key"), full) == 0)
            return cell(headlines, i, "value");
    fail_msg("no headline %s", full);
    return (double)NAN;
}

/* The row of `summary` has the same unrounded numbers. */
static void check_row(const wt_table *headlines, const char *name, told t)
{
    assert_near(headline(headlines, name, ""), t.value, 1e-12);
    if (!isnan(t.low)) {
        assert_near(headline(headlines, name, "_low"), t.low, 1e-6);
        assert_near(headline(headlines, name, "_high"), t.high, 1e-6);
    }
    if (isnan(t.model_low))
        return;
    assert_near(headline(headlines, name, "_model_low"), t.model_low, 1e-12);
    assert_near(headline(headlines, name, "_model_high"), t.model_high, 1e-12);
}

/* The row on the terminal has the unrounded numbers. The interval of the ratio may come from the
 * row only where it is known. */
static void check_printed(const char *name, told t)
{
    wt_result_rows *rows = wt_result_rows_new(result, false);
    size_t found = 0;
    for (size_t i = 0; i < wt_result_rows_count(rows); i++) {
        const wt_result_row row = wt_result_rows_get(rows, i);
        if (strcmp(row.name, name) != 0)
            continue;
        found++;
        assert_near(row.value, t.value, 1e-12);
        assert_int_equal(isnan(row.low), isnan(t.low));
        if (!isnan(t.low)) {
            assert_near(row.high, t.high, 1e-6);
            assert_near(row.low, fmax(t.low, t.value > 0 ? 0 : t.low), 1e-6);
            assert_true(*row.interval != '\0');
        }
        if (isnan(t.model_low))
            continue;
        assert_near(row.range_low, t.model_low, 1e-12);
        assert_near(row.range_high, t.model_high, 1e-12);
        assert_true(*row.range != '\0');
    }
    if (found != 1)
        fail_msg("%zu rows %s", found, name);
    wt_result_rows_free(rows);
}

/* Returns the note of a row of the result. */
static bool printed_note_has(const char *name, const char *words)
{
    wt_result_rows *rows = wt_result_rows_new(result, false);
    bool has = false;
    for (size_t i = 0; i < wt_result_rows_count(rows); i++) {
        const wt_result_row row = wt_result_rows_get(rows, i);
        has = has || (strcmp(row.name, name) == 0 && strstr(row.note, words) != NULL);
    }
    wt_result_rows_free(rows);
    return has;
}

/* The modulus of bulk or track has the same interval in all tables. */
static told of_group(const char *group)
{
    const wt_table *groups = wt_result_find(result, "modulus_groups"),
                   *budget = wt_result_find(result, "modulus_budget");
    char low[64], high[64];
    snprintf(low, sizeof low, "low_%s", group);
    snprintf(high, sizeof high, "high_%s", group);
    for (size_t i = 0; i < wt_table_n_rows(groups); i++)
        if (strcmp(cell_text(groups, i, "group"), group) == 0) {
            if (budget != NULL && !isnan(cell(groups, i, "low"))) {
                assert_near(cell(groups, i, "low"), key_estimate(budget, low).value, 1e-12);
                assert_near(cell(groups, i, "high"), key_estimate(budget, high).value, 1e-12);
            }
            return (told){cell(groups, i, "geometric_mean"), cell(groups, i, "low"),
                          cell(groups, i, "high"), (double)NAN, (double)NAN};
        }
    fail_msg("no group %s", group);
    return (told){0};
}

/* The verdict follows from the numbers: softer, stiffer, less, more or inconclusive. */
static void check_signs(void)
{
    const told ratio = of_ratio();
    const char *layer = answer(DIFFERS, "answer"), *friction = answer(FRICTION, "answer");
    assert_int_equal(strstr(layer, "softer") != NULL, ratio.high < 1);
    assert_int_equal(strstr(layer, "stiffer") != NULL, ratio.low > 1);
    assert_int_equal(printed_note_has("track / bulk", "softer"), ratio.high < 1);
    assert_int_equal(printed_note_has("track / bulk", "stiffer"), ratio.low > 1);
    const told t = table_memory("friction", "relative_change_at_reference", change_in);
    const bool less = t.high < 0 && t.model_high<0, more = t.low> 0 && t.model_low > 0;
    assert_string_equal(answer(FRICTION, "verdict"), less || more ? "yes" : "inconclusive");
    assert_int_equal(strstr(friction, "lowers") != NULL, less);
    assert_int_equal(strstr(friction, "raises") != NULL, more);
}

/* Results, terminal rows and main values have the numbers of the tables. */
static void check_told_alike(void)
{
    static const char change[] = "relative_change_at_reference";
    wt_table *headlines = NULL;
    assert_int_equal(wt_result_main_values(result, &headlines, NULL), WT_OK);
    const told ratio = of_ratio(),
               thickness = table_memory("layer", "balance_thickness", thickness_in),
               total = table_memory("friction", "friction_at_reference", total_in),
               hysteresis = table_memory("friction", "hysteresis_at_reference", hysteresis_in),
               with = table_memory("friction", "friction_with_layer_at_reference", with_layer_in),
               relative = table_memory("friction", change, change_in),
               area = table_memory("friction", "area_ratio_at_reference", area_in);
    check_printed("track / bulk", ratio);
    check_answer(DIFFERS, ratio);
    check_row(headlines, "modulus_ratio", ratio);
    check_printed("layer thickness", thickness);
    check_answer(THICKNESS, thickness);
    check_row(headlines, "balance_thickness", thickness);
    check_printed("friction coefficient", total);
    check_row(headlines, "friction_at_reference", total);
    check_printed("hysteresis", hysteresis);
    check_printed("friction with layer", with);
    check_row(headlines, "friction_with_layer_at_reference", with);
    check_printed("real contact area", area);
    check_printed("bulk", of_group("bulk"));
    check_printed("track", of_group("track"));
    check_printed("change", relative);
    check_answer(FRICTION, relative);
    check_row(headlines, change, relative);
    check_signs();
    wt_table_free(headlines);
}

static void run_bundled(void)
{
    wt_case *c = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_run_options options = wt_run_defaults();
    options.replicates = 16;
    wt_result_free(result);
    result = NULL;
    if (wt_case_read(WT_SOURCE_DIR "/fixtures/case/case.xml", &c, &err) != WT_OK ||
        wt_run_case(c, &options, NULL, &result, NULL, &err) != WT_OK)
        fail_msg("%s: %s %s", err.place, err.message, err.found);
    wt_case_free(c);
}

static void test_same_numbers_everywhere(void **state)
{
    (void)state;
    run_bundled();
    check_told_alike();
    /* a model choice reverses the sign, which the verdict states */
    assert_string_equal(answer(FRICTION, "verdict"), "inconclusive");
    static const double ratios[] = {0.6, 1.5};
    for (int i = 0; i < 2; i++) {
        run(ratios[i], 0.03,
            INDENTATION(FILES("b"), FILES("t")) SLIDING LAYER("1e-3mm^3/(N m)", "1e10J/m^3"));
        check_told_alike();
    }
}

/* Warnings come before notes, no limitation occurs twice, and a stage that was not requested states
 * the reason. */
static void test_limits(void **state)
{
    (void)state;
    run(0.96, 0.1, INDENTATION(FILES("b"), FILES("t")) SLIDING COMPARE);
    const wt_table *limits = wt_result_find(result, "limits");
    bool notes = false;
    assert_true(wt_table_n_rows(limits) > 2);
    for (size_t i = 0; i < wt_table_n_rows(limits); i++) {
        const bool note = strcmp(cell_text(limits, i, "severity"), "note") == 0;
        assert_true(note || !notes);
        notes = note;
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(cell_text(limits, i, "limit"), cell_text(limits, k, "limit"));
    }
    for (size_t row = THICKNESS; row <= FRICTION; row++) {
        assert_string_equal(answer(row, "verdict"), "not computed");
        assert_non_null(strstr(answer(row, "answer"), "The case does not request it: the case has "
                                                      "no layer"));
    }
}

/* Bulk at both rates, track at the fast one: the ratio is that of the fast rate. */
static void test_common_rates(void **state)
{
    (void)state;
    track_from = 1;
    run(0.8, 0.01, INDENTATION(FILES("b"), FILES("t")) COMPARE);
    track_from = 0;
    assert_near(answered(DIFFERS, "value"), 0.8 * sqrt(BY_RATE), 0.01);
    const wt_table *groups = wt_result_find(result, "modulus_groups");
    assert_near(cell(groups, 1, "geometric_mean") / cell(groups, 0, "geometric_mean"),
                0.8 * sqrt(BY_RATE) * sqrt(1.2), 0.01);
}

/* Elastic curves with a viscoelastic DMA at their rates: the limitations and the log state how many
 * do not fit its spectrum. */
static void test_other_spectrum(void **state)
{
    (void)state;
    static const char *const group[] = {"bulk", "track"};
    char table[32], words[96];
    run(0.6, 0.03, INDENTATION(FILES("b"), FILES("t")) SLIDING COMPARE);
    for (int g = 0; g < 2; g++) {
        snprintf(table, sizeof table, "indentation/%s", group[g]);
        const wt_table *t = wt_result_find(result, table);
        size_t others = 0;
        for (size_t i = 0; i < SPOTS * RATES; i++)
            others += strstr(cell_text(t, i, "reason"), "not of the spectrum of the DMA") != NULL;
        assert_true(others > 0);
        snprintf(words, sizeof words, "%zu of %d curves of the %s do not fit the spectrum of the ",
                 others, SPOTS * RATES, group[g]);
        assert_non_null(strstr(limit(words), "another rubber"));
        const wt_table *notes = wt_result_find(result, "notes");
        size_t noted = 0;
        for (size_t i = 0; i < wt_table_n_rows(notes); i++)
            noted += strstr(cell_text(notes, i, "text"), words) != NULL;
        assert_int_equal(noted, 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_verdicts),        cmocka_unit_test(test_one_spot),
        cmocka_unit_test(test_one_spot_slides), cmocka_unit_test(test_sliding),
        cmocka_unit_test(test_inconsistencies), cmocka_unit_test(test_same_numbers_everywhere),
        cmocka_unit_test(test_limits),          cmocka_unit_test(test_common_rates),
        cmocka_unit_test(test_other_spectrum),
    };
    return cmocka_run_group_tests_name("answers of known truth", tests, make_folder, clean);
}
