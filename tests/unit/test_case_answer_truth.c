/* What the answer of a run says, in words and numbers, of groups whose moduli are known: softer,
 * stiffer, no difference shown, one spot; and of the thickness and friction that follow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth.h"

#include "weartrack/case.h"

#include <ctype.h>
#include <sys/stat.h>

enum { SPOTS = 3, RATES = 2 };

#define BULK 3e6
#define T_4 2.776445105197793 /* 97.5 % point of Student's t */
#define BY_RATE 1.05          /* the ratio at the second rate over that at the first */

static const double rate[RATES] = {1e-6, 2e-5};    /* of the piezo [m/s] */
static const double with_rate[RATES] = {1.0, 1.2}; /* stiffer where it is faster */

static int track_from; /* the first of the rates at which the track is indented */

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

/* One file for each spot and group: a curve for each rate. */
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

/* ---- reading the sentences ------------------------------------------------------------------- */

/* Row of the answer of a kind. Limits have a table of their own. */
static const wt_table *table_of_kind(const char *kind)
{
    return wt_result_find(result, strcmp(kind, "limit") == 0 ? "limits" : "answer");
}

static bool is_kind(const wt_table *answer, size_t row, const char *kind)
{
    return strcmp(kind, "limit") == 0 || strcmp(cell_text(answer, row, "kind"), kind) == 0;
}

static const char *sentence(const wt_table *answer, size_t row)
{
    return cell_text(answer, row,
                     strcmp(wt_table_name(answer), "limits") == 0 ? "limit" : "answer");
}

/* What follows the words in the sentences of a kind; fails if no sentence has them. */
static const char *after(const char *kind, const char *words)
{
    const wt_table *answer = table_of_kind(kind);
    assert_non_null(answer);
    for (size_t i = 0; i < wt_table_n_rows(answer); i++) {
        const char *at = strstr(sentence(answer, i), words);
        if (at != NULL && is_kind(answer, i, kind))
            return at + strlen(words);
    }
    for (size_t i = 0; i < wt_table_n_rows(answer); i++)
        print_error("%s\n", sentence(answer, i));
    fail_msg("no sentence of kind %s has \"%s\"", kind, words);
    return "";
}

static bool says(const char *kind, const char *words)
{
    const wt_table *answer = table_of_kind(kind);
    assert_non_null(answer);
    for (size_t i = 0; i < wt_table_n_rows(answer); i++)
        if (is_kind(answer, i, kind) && strstr(sentence(answer, i), words) != NULL)
            return true;
    return false;
}

/* "3.15 ± 0.78 µm" and "-2.76 MPa" in SI units: the number, its error passed over, its prefix. */
static double number(const char *text)
{
    char *end;
    double value = strtod(text, &end);
    assert_true(end != text);
    static const char plus_minus[] = " \xc2\xb1 ";
    if (strncmp(end, plus_minus, 4) == 0)
        (void)strtod(end + 4, &end);
    if (*end != ' ')
        return value;
    static const char *const prefixes[] = {"p", "n", "\xc2\xb5", "m", "k", "M", "G"};
    static const double factors[] = {1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9};
    for (size_t i = 0; i < 7; i++) {
        size_t n = strlen(prefixes[i]);
        if (strncmp(end + 1, prefixes[i], n) == 0 && isalpha((unsigned char)end[1 + n]))
            return value * factors[i];
    }
    return value;
}

/* The number behind the words, to the three digits it is given with. */
static void check(const char *kind, const char *words, double expected, double tolerance)
{
    double value = number(after(kind, words));
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%s%g: expected %g", words, value, expected);
}

/* ---- tests ----------------------------------------------------------------------------------- */

static void check_verdict(double ratio, double scatter, const char *verdict)
{
    run(ratio, scatter, INDENTATION(FILES("b"), FILES("t")) COMPARE);
    double reach = T_4 * scatter * sqrt(2.0 / SPOTS);
    (void)after("layer", verdict);
    check("layer", "E_track/E_bulk = ", ratio, 0.01);
    check("layer", "95 % interval ", ratio * exp(-reach), 0.02);
    const char *high = strstr(after("layer", "95 % interval "), " to ");
    assert_non_null(high);
    assert_near(number(high + 4), ratio * exp(reach), 0.02);
    check("layer", "by Welch, ", says("layer", "Yes") ? 0.1 : 0.7, 0.1);
    /* 2 of the 20 rankings of 3 among 6 */
    (void)after("layer", "by Mann and Whitney, which cannot be below 0.1 with so few");
    (void)after("layer", "(3 spots in the bulk and 3 in the track; p ");
    assert_true(says("layer", "What would settle it") == says("layer", "Cannot say"));

    check("difference", "the wear track is ", ratio, 0.01);
    double percent = number(after("difference", "times that of the bulk ("));
    assert_near_abs(percent, 100 * (ratio - 1), 1.1);
    double by_rate = sqrt(BY_RATE);
    check("difference", "(Hedges' g of ln E) ", 0.8 * log(ratio) / scatter, 0.15);
    check("difference", "Bulk: E = ", BULK * sqrt(1.2), 0.01);
    check("difference", "Wear track: E = ", ratio * BULK * sqrt(1.2), 0.01);
    (void)after("difference", "from 6 curves on 3 spots, 0 rejected");
    check("difference", "(2 indentation rates) the ratio is ", ratio / by_rate, 0.01);
    const char *to = strstr(after("difference", "indentation rates) the ratio is "), " to ");
    assert_non_null(to);
    assert_near(number(to + 4), ratio * by_rate, 0.01);
    const wt_table *c = wt_result_find(result, "comparison");
    double p = fmax(cell(c, 1, "holm_p"), cell(c, 2, "holm_p"));
    if (p < 0.001)
        (void)after("difference", "largest p after Holm's correction is below 0.001");
    else
        check("difference", "largest p after Holm's correction is ", p, 0.05);
}

static void test_verdicts(void **state)
{
    (void)state;
    check_verdict(0.80, 0.03,
                  "Yes: the wear track is softer than the bulk, by a ratio that depends on "
                  "the rate (p ");
    check_verdict(1.25, 0.03,
                  "Yes: the wear track is stiffer than the bulk, by a ratio that depends on "
                  "the rate (p ");
    static const char unknown[] = "Cannot say: the ratio depends on the rate (p ";
    check_verdict(0.96, 0.1, unknown);
    check_verdict(1.05, 0.1, unknown);
}

/* One spot speaks for itself only, and its curves are the units. */
static void test_one_spot(void **state)
{
    (void)state;
    run(0.5, 0.03, INDENTATION(ONE_FILE("b"), ONE_FILE("t")) COMPARE);
    (void)after("layer", "Cannot say: bulk and track were each measured on one spot only, so "
                         "it is not known");
    (void)after("layer", "What would settle it: 3 spots in each group");
    assert_false(says("layer", "E_track/E_bulk"));
    (void)after("difference", "an interval cannot be told");
    (void)after("difference", "no interval from fewer than two spots");
    (void)after("difference", "from 2 curves on 1 spot, 0 rejected");
}

static const char *short_line(const char *begins);

/* The ratio of one spot has no error: what is predicted with it says so beside its interval. */
static void test_one_spot_slides(void **state)
{
    (void)state;
    run(0.5, 0.03,
        INDENTATION(ONE_FILE("b"), ONE_FILE("t")) SLIDING LAYER("1e-3mm^3/(N m)", "1e10J/m^3"));
    const char *line = short_line("Friction (predicted): ");
    assert_non_null(strstr(line, "95 % interval"));
    assert_non_null(strstr(line, "without the error of the modulus ratio"));
}

static double key(const char *table, const char *name)
{
    return key_estimate(wt_result_find(result, table), name).value;
}

/* Thickness and friction: the sentences against what is in the tables, and the tables against one
 * another. */
static void test_sliding(void **state)
{
    (void)state;
    run(0.6, 0.03,
        INDENTATION(FILES("b"), FILES("t")) SLIDING LAYER("1e-3mm^3/(N m)", "1e10J/m^3"));
    /* the bulk over |E*| of the series at 1/(time in contact) */
    double ratio[RATES];
    for (int r = 0; r < RATES; r++) {
        hertz h = hertz_standard();
        h.modulus = BULK * with_rate[r];
        double omega = rate[r] / hertz_travel(&h), z = omega * 0.1, fast = omega * 1e-6;
        double storage = 2e6 + 3e6 * z * z / (1 + z * z);
        double loss = 3e6 * z / (1 + z * z) + 300e6 * fast;
        ratio[r] = h.modulus / hypot(storage, loss);
    }
    const char *of_dma = after("difference", "indentation modulus of the bulk is ");
    assert_near(number(of_dma), fmin(ratio[0], ratio[1]), 0.01);
    assert_non_null(strstr(of_dma, " to "));
    assert_near(number(strstr(of_dma, " to ") + 4), fmax(ratio[0], ratio[1]), 0.01);
    check("difference", "of which the spring constant leaves ", 4, 0.001);

    double thickness = key("layer", "balance_thickness");
    check("thickness", "", thickness, 0.01);
    check("thickness", "where formation balances wear, at ", 0.1, 0.001);
    check("thickness", "at 100 mm/s and ", 0.4e6, 0.001);
    check("thickness", "wear R = ", key("layer", "formation_wear_ratio"), 0.01);
    check("thickness", "more wear it is ", -key("layer", "wear_sensitivity"), 0.05);
    check("thickness", "begins to form after ", key("layer", "incubation_time"), 0.01);
    check("thickness", "of the balance after ", key("layer", "time_to_90_percent"), 0.01);

    double total = key("friction", "friction_at_reference");
    double hysteresis = key("friction", "hysteresis_at_reference");
    double area = key("friction", "area_ratio_at_reference");
    double with = key("friction", "friction_with_layer_at_reference");
    assert_near(total, hysteresis + 5e6 * area / 0.4e6, 1e-9);
    check("friction", "Without a layer, at ", 0.1, 0.001);
    check("friction", "Without a layer, at 100 mm/s, mu = ", total, 0.01);
    check("friction", ": hysteresis ", hysteresis, 0.01);
    check("friction", "shearing of the real contact ", total - hysteresis, 0.01);
    check("friction", "contact area of the nominal one ", area, 0.01);
    check("friction", "With the layer (", thickness, 0.01);
    check("friction", "modulus ratio ", 0.6, 0.01);
    assert_near_abs(number(after("friction", "the layer lowers or raises friction: ")),
                    100 * (with / total - 1), 0.51);
    const wt_table *friction = wt_result_find(result, "friction");
    double low = 99, high = -99;
    for (size_t i = 0; i < wt_table_n_rows(friction); i++) {
        double change = cell(friction, i, "friction_with_layer") / cell(friction, i, "friction");
        low = fmin(low, change - 1);
        high = fmax(high, change - 1);
    }
    check("friction", "From ", 1e-3, 0.001);
    const char *range = after("friction", "From 1.00 mm/s to ");
    assert_near(number(range), 1, 0.001);
    range = strstr(range, "the change is ");
    assert_non_null(range);
    assert_near_abs(number(range + 14), 100 * low, 0.51);
    range = strstr(range, " to ");
    assert_non_null(range);
    assert_near_abs(number(range + 4), 100 * high, 0.51);
    assert_false(says("limit", "The theory predicts no layer, but"));
    assert_false(says("limit", "The indentation does not show this layer"));
    /* the temperature of sliding is not stated */
    assert_true(says("limit", "No sliding temperature is stated"));
}

/* What does not fit together is said: a layer without a difference, a difference without a layer.
 */
static void test_disagreement(void **state)
{
    (void)state;
    run(0.96, 0.1,
        INDENTATION(FILES("b"), FILES("t")) SLIDING LAYER("1e-3mm^3/(N m)", "1e10J/m^3"));
    assert_true(says("limit", "The indentation does not show this layer"));
    assert_false(says("limit", "The theory predicts no layer, but"));
    static const double ratios[] = {0.6, 1.5};
    for (int i = 0; i < 2; i++) {
        run(ratios[i], 0.03,
            INDENTATION(FILES("b"), FILES("t")) SLIDING LAYER("10mm^3/(N m)", "1e10J/m^3"));
        assert_true(says("thickness", "There is none at 100 mm/s and 400 kPa"));
        assert_true(says("limit", "The theory predicts no layer, but"));
        assert_false(says("limit", "The indentation does not show this layer"));
        /* mm^3/(N m): 1e-9 m^2/N */
        assert_near(strtod(after("thickness", "would have to be below "), NULL),
                    1e9 * key("layer", "critical_specific_wear_rate"), 0.01);
        assert_true(key("layer", "critical_specific_wear_rate") < 1e-8);
        assert_true(says("friction", "Where wear leaves no layer"));
    }
}

/* ---- told alike ------------------------------------------------------------------------------ */

/* A number, its interval and its range over the choices of the model. */
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

/* From the tables, `scale` times. */
static told table_memory(const char *table, const char *name, row_number *in, double scale)
{
    const wt_table *what_if = wt_result_find(result, "what_if");
    const wt_estimate e = key_estimate(wt_result_find(result, table), name);
    const double half = e.standard_error > 0 ? 1.959964 * e.standard_error : (double)NAN;
    told t = {scale * e.value, scale * (e.value - half), scale * (e.value + half),
              scale * in(what_if, 0), scale * in(what_if, 0)};
    for (size_t i = 1; i < wt_table_n_rows(what_if); i++) {
        t.model_low = fmin(t.model_low, scale * in(what_if, i));
        t.model_high = fmax(t.model_high, scale * in(what_if, i));
    }
    return t;
}

static told of_ratio(void)
{
    const wt_table *c = wt_result_find(result, "comparison");
    return (told){cell(c, 0, "ratio"), cell(c, 0, "ratio_low"), cell(c, 0, "ratio_high"),
                  (double)NAN, (double)NAN};
}

/* To three digits, of a percentage to one per cent. */
static void near_told(const char *text, double found, double expected, bool percent)
{
    if (!(fabs(found - expected) <= (percent ? 0.51 : 0.0051 * fabs(expected))))
        fail_msg("%g, expected %g, in %s", found, expected, text);
}

/* Value, interval and range where a text tells them behind the words. */
static void check_told(const char *text, const char *words, told t, bool percent)
{
    static const char interval[] = "95 % interval ", choices[] = "over all choices of the model";
    const char *at = text != NULL ? strstr(text, words) : NULL;
    if (at == NULL)
        fail_msg("\"%s\" is not in: %s", words, text != NULL ? text : "nothing");
    near_told(text, number(at + strlen(words)), t.value, percent);
    if (isnan(t.low)) {
        assert_non_null(strstr(at, "(error not known"));
    } else {
        at = strstr(at, interval);
        if (at == NULL)
            fail_msg("no interval behind \"%s\": %s", words, text);
        near_told(text, number(at + strlen(interval)), t.low, percent);
        near_told(text, number(strstr(at, " to ") + 4), t.high, percent);
    }
    const char *range = strstr(at, choices);
    if (isnan(t.model_low))
        return;
    assert_non_null(range);
    if (range[strlen(choices)] == ' ' && range[strlen(choices) + 1] != 'w') { /* it follows */
        near_told(text, number(range + strlen(choices) + 1), t.model_low, percent);
        near_told(text, number(strstr(range, ") to ") + 5), t.model_high, percent);
        return;
    }
    while (range[-1] != ';')
        range--;
    near_told(text, number(range + 1), t.model_low, percent);
    near_told(text, number(strstr(range, " to ") + 4), t.model_high, percent);
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

/* The row of `summary` has the same numbers without rounding. */
static void check_row(const wt_table *headlines, const char *name, told t, double scale)
{
    assert_near(scale * headline(headlines, name, ""), t.value, 1e-12);
    if (!isnan(t.low)) {
        assert_near(scale * headline(headlines, name, "_low"), t.low, 1e-6);
        assert_near(scale * headline(headlines, name, "_high"), t.high, 1e-6);
    }
    if (isnan(t.model_low))
        return;
    assert_near(scale * headline(headlines, name, "_model_low"), t.model_low, 1e-12);
    assert_near(scale * headline(headlines, name, "_model_high"), t.model_high, 1e-12);
}

/* The row of the table on the terminal has them without rounding. The interval of the ratio may be
 * that of the row only where it is known. */
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

/* Returns the note of a row. The rows are those of the result. */
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

static const char *short_line(const char *begins)
{
    const wt_table *answer = wt_result_find(result, "answer");
    for (size_t i = 0; i < 3; i++)
        if (strncmp(cell_text(answer, i, "answer"), begins, strlen(begins)) == 0 &&
            strcmp(cell_text(answer, i, "kind"), "short") == 0)
            return cell_text(answer, i, "answer");
    fail_msg("the answer does not begin with %s", begins);
    return NULL;
}

/* Modulus of bulk or track, with one interval in all tables. */
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

static void check_groups(void)
{
    static const char *const group[] = {"bulk", "track"}, *const title[] = {"Bulk: E = ",
                                                                            "Wear track: E = "};
    for (int g = 0; g < 2; g++) {
        const told modulus = of_group(group[g]);
        check_printed(group[g], modulus);
        (void)after("difference", title[g]);
        const wt_table *answer = wt_result_find(result, "answer");
        for (size_t i = 0; i < wt_table_n_rows(answer); i++)
            if (strncmp(cell_text(answer, i, "answer"), title[g], strlen(title[g])) == 0)
                check_told(cell_text(answer, i, "answer"), "E = ", modulus, false);
    }
}

/* Softer, stiffer; less, more, or open: as the numbers have it. */
static void check_signs(void)
{
    const told ratio = of_ratio();
    const char *layer = short_line("Layer (measured): ");
    assert_true((strstr(layer, "softer") != NULL) == (ratio.high < 1));
    assert_true((strstr(layer, "stiffer") != NULL) == (ratio.low > 1));
    assert_true(printed_note_has("track / bulk", "softer") == (ratio.high < 1));
    assert_true(printed_note_has("track / bulk", "stiffer") == (ratio.low > 1));
    const told t = table_memory("friction", "relative_change_at_reference", change_in, 1);
    const bool less = t.high < 0 && t.model_high<0, more = t.low> 0 && t.model_low > 0;
    const char *words = less   ? "less friction with the layer"
                        : more ? "more friction with the layer"
                               : "open whether the layer lowers or raises friction";
    static const char friction[] = "Friction (predicted): ";
    const char *line = short_line(friction) + strlen(friction);
    assert_int_equal(strncmp(line, words, strlen(words)), 0); /* the line begins with it */
    assert_true(says("friction", words + 1));                 /* with a capital */
}

static void check_told_alike(void)
{
    static const char change[] = "relative_change_at_reference",
                      open[] = "friction: ", known[] = "friction with the layer: ";
    wt_table *headlines = NULL;
    assert_int_equal(wt_result_main_values(result, &headlines, NULL), WT_OK);
    const told ratio = of_ratio(),
               thickness = table_memory("layer", "balance_thickness", thickness_in, 1),
               total = table_memory("friction", "friction_at_reference", total_in, 1),
               hysteresis = table_memory("friction", "hysteresis_at_reference", hysteresis_in, 1),
               with =
                   table_memory("friction", "friction_with_layer_at_reference", with_layer_in, 1),
               percent = table_memory("friction", change, change_in, 100);
    check_printed("track / bulk", ratio);
    check_told(short_line("Layer (measured): "), "E_track/E_bulk = ", ratio, false);
    check_told(after("layer", ""), "E_track/E_bulk = ", ratio, false);
    check_row(headlines, "modulus_ratio", ratio, 1);
    check_printed("layer thickness", thickness);
    check_told(short_line("Thickness (predicted): "), "layer of ", thickness, false);
    check_told(after("thickness", ""), "", thickness, false);
    check_row(headlines, "balance_thickness", thickness, 1);
    check_printed("friction coefficient", total);
    check_told(after("friction", "Without a layer, "), "mu = ", total, false);
    check_row(headlines, "friction_at_reference", total, 1);
    check_printed("hysteresis", hysteresis);
    check_told(after("friction", "Without a layer, "), "hysteresis ", hysteresis, false);
    check_printed("friction with layer", with);
    check_told(after("friction", "With the layer "), "mu = ", with, false);
    check_row(headlines, "friction_with_layer_at_reference", with, 1);
    const told area = table_memory("friction", "area_ratio_at_reference", area_in, 1);
    check_printed("real contact area", area);
    check_told(after("friction", "Without a layer, "), "contact area of the nominal one ", area,
               false);
    const char *line = short_line("Friction (predicted): ");
    near_told(line, number(strstr(line, "mu = ") + strlen("mu = ")), total.value, false);
    near_told(line, number(strstr(line, "without it and ") + strlen("without it and ")), with.value,
              false);
    check_groups();
    const char *words = percent.model_low < 0 && percent.model_high > 0 ? open : known;
    const char *in_full = says("friction", open) ? open : known;
    check_told(after("friction", in_full) - strlen(in_full), in_full, percent, true);
    check_printed("change", table_memory("friction", change, change_in, 1));
    check_told(short_line("Friction (predicted): "), words, percent, true);
    check_row(headlines, change, percent, 100);
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

static void test_told_alike(void **state)
{
    (void)state;
    run_bundled();
    check_told_alike();
    /* a choice of the model turns the sign round, which no sentence hides */
    assert_non_null(strstr(short_line("Friction (predicted): "), "Friction (predicted): open"));
    static const double ratios[] = {0.6, 1.5};
    for (int i = 0; i < 2; i++) {
        run(ratios[i], 0.03,
            INDENTATION(FILES("b"), FILES("t")) SLIDING LAYER("1e-3mm^3/(N m)", "1e10J/m^3"));
        check_told_alike();
    }
}

/* Warnings come before notes, no limit is told twice, and what was not asked comes last. */
static void test_limits(void **state)
{
    (void)state;
    run(0.96, 0.1, INDENTATION(FILES("b"), FILES("t")) SLIDING COMPARE);
    const wt_table *answer = wt_result_find(result, "answer"),
                   *limits = wt_result_find(result, "limits");
    bool notes = false;
    assert_true(wt_table_n_rows(limits) > 2);
    for (size_t i = 0; i < wt_table_n_rows(limits); i++) {
        const bool note = strcmp(cell_text(limits, i, "severity"), "note") == 0;
        assert_true(note || !notes);
        notes = note;
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(cell_text(limits, i, "limit"), cell_text(limits, k, "limit"));
    }
    assert_string_equal(cell_text(answer, wt_table_n_rows(answer) - 1, "question"),
                        "What was not asked?");
    (void)after("thickness", "How thick is it? Not asked: the case has no layer parameters");
    (void)after("friction", "What the layer does to friction. Not asked: the case has no layer");
}

/* The bulk at both rates, the track at the fast one: the ratio is that of the fast one, and the
 * sentence that tells it says that the moduli beside it have another. */
static void test_common_rates(void **state)
{
    (void)state;
    static const char words[] = ", for the rates are those that both groups have; the moduli of "
                                "all rates have the ratio ";
    track_from = 1;
    run(0.8, 0.01, INDENTATION(FILES("b"), FILES("t")) COMPARE);
    track_from = 0;
    const double common = 0.8 * sqrt(BY_RATE);
    check("short", "E_track/E_bulk = ", common, 0.01);
    check("short", words, common * sqrt(1.2), 0.01);
    check("difference", words, common * sqrt(1.2), 0.01);
    assert_true(says("difference", "The modulus of the wear track is "));
    run(0.8, 0.01, INDENTATION(FILES("b"), FILES("t")) COMPARE);
    assert_false(says("short", words));
}

/* Elastic curves beside a DMA with loss at their rates: how many are not of its spectrum is said in
 * the answer and in the log, and what that changes. */
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
        assert_non_null(strstr(after("limit", words), "another rubber"));
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
        cmocka_unit_test(test_disagreement),    cmocka_unit_test(test_told_alike),
        cmocka_unit_test(test_limits),          cmocka_unit_test(test_common_rates),
        cmocka_unit_test(test_other_spectrum),
    };
    return cmocka_run_group_tests_name("answers of known truth", tests, make_folder, clean);
}
