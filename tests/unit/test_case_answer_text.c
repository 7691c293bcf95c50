/* The sentences of whole cases, word for word, with the numbers of the tables put in here: each
 * number at its place, with its sign and its unit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "truth.h"

#include "case/answer/format_number.h"
#include "case/case.h"
#include "weartrack/case.h"

static wt_case *bundled;
static wt_result *result;

static void run_case(const char *path, void (*change)(wt_case *c))
{
    wt_error err = WT_ERROR_INIT;
    size_t failed = 0;
    wt_run_options options = wt_run_defaults();
    options.replicates = 20;
    wt_result_free(result);
    wt_case_free(bundled);
    result = NULL;
    bundled = NULL;
    if (wt_case_read(path, &bundled, &err) != WT_OK)
        fail_msg("%s", err.message);
    if (change != NULL)
        change(bundled);
    if (wt_run_case(bundled, &options, NULL, &result, &failed, &err) != WT_OK)
        fail_msg("%s", err.message);
}

static int clean(void **state)
{
    (void)state;
    wt_result_free(result);
    wt_case_free(bundled);
    return 0;
}

static const wt_table *table(const char *name)
{
    const wt_table *t = wt_result_find(result, name);
    if (t == NULL)
        fail_msg("no table %s", name);
    return t;
}

static wt_estimate key(const char *name, const char *of)
{
    return key_estimate(table(name), of);
}

static double at(const char *name, size_t row, const char *column)
{
    return cell(table(name), row, column);
}

__attribute__((format(printf, 2, 3))) static void says(const char *kind, const char *format, ...)
{
    const bool limit = strcmp(kind, "limit") == 0; /* limits have a table of their own */
    const wt_table *answer = table(limit ? "limits" : "answer");
    const char *column = limit ? "limit" : "answer";
    char sentence[1200];
    va_list list;
    va_start(list, format);
    vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    for (size_t i = 0; i < wt_table_n_rows(answer); i++)
        if ((limit || strcmp(cell_text(answer, i, "kind"), kind) == 0) &&
            strstr(cell_text(answer, i, column), sentence) != NULL)
            return;
    for (size_t i = 0; i < wt_table_n_rows(answer); i++)
        print_message("%s\n", cell_text(answer, i, column));
    fail_msg("no answer (%s): %s", kind, sentence);
}

#define WORDS(value, unit) format_with_unit(value, unit).text

static const char *chance(double p)
{
    static char words[2][32];
    static size_t which;
    which = 1 - which;
    snprintf(words[which], sizeof words[0], p < 1e-3 ? "below 0.001" : "%.2g", p);
    return words[which];
}

/* As many decimals as two digits of half the interval have, three digits at least. */
static int digits_of(double value, double low, double high)
{
    char half[16], whole[16];
    snprintf(half, sizeof half, "%.5e", (high - low) / 2);
    snprintf(whole, sizeof whole, "%.5e", value);
    const int digits = 2 + atoi(strchr(whole, 'e') + 1) - atoi(strchr(half, 'e') + 1);
    return digits > 3 ? digits : 3;
}

static void check_layer(void)
{
    const double low = at("comparison", 0, "ratio_low"), high = at("comparison", 0, "ratio_high");
    const int digits = digits_of(at("comparison", 0, "ratio"), low, high);
    const char *differs = wt_table_key(table("comparison"), "differs"),
               *settled = wt_table_key(table("comparison"), "settled_by");
    says("layer",
         "%c%s. E_track/E_bulk = %#.*g, 95 %% interval %#.*g to %#.*g (%.0f spots in the bulk and "
         "%.0f in the track; p %s by Welch, %s by Mann and Whitney).%s%s%s",
         differs[0] - 'a' + 'A', differs + 1, digits, at("comparison", 0, "ratio"), digits, low,
         digits, high, at("comparison", 0, "spots_bulk"), at("comparison", 0, "spots_track"),
         chance(at("comparison", 0, "welch_p")), chance(at("comparison", 0, "mann_whitney_p")),
         settled != NULL ? " What would settle it: " : "", settled != NULL ? settled : "",
         settled != NULL ? "." : "");
}

static void check_difference(void)
{
    static const char *const names[] = {"Bulk", "Wear track"};
    const double ratio = at("comparison", 0, "ratio");
    says("difference",
         "The modulus of the wear track is %#.*g times that of the bulk (%+.0f %%) at ",
         digits_of(ratio, at("comparison", 0, "ratio_low"), at("comparison", 0, "ratio_high")),
         ratio, 100 * (ratio - 1));
    says("difference", "; effect size (Hedges' g of ln E) %.2g.",
         at("comparison", 0, "effect_size"));
    for (size_t g = 0; g < 2; g++) {
        says("difference", "%s: E = %s at ", names[g],
             WORDS(at("modulus_groups", g, "geometric_mean"), "Pa"));
        says("difference", " from %.0f curves on %.0f spots, %.0f rejected.",
             at("modulus_groups", g, "n"), at("modulus_groups", g, "n_spots"),
             at("modulus_groups", g, "n_rejected"));
    }
    double low = (double)INFINITY, high = 0, p = 0;
    const size_t n = wt_table_n_rows(table("comparison"));
    for (size_t i = 1; i < n; i++) {
        low = fmin(low, at("comparison", i, "ratio"));
        high = fmax(high, at("comparison", i, "ratio"));
        p = fmax(p, at("comparison", i, "holm_p"));
    }
    says("difference",
         "Rate by rate (%zu indentation rates) the ratio is %.3g to %.3g; the largest p after "
         "Holm's correction is %s.",
         n - 1, low, high, chance(p));
    low = (double)INFINITY;
    high = 0;
    for (size_t i = 0; i < wt_table_n_rows(table("dma_comparison")); i++)
        if (strcmp(cell_text(table("dma_comparison"), i, "group"), "bulk") == 0) {
            const double of = at("dma_comparison", i, "indentation_modulus") /
                              at("dma_comparison", i, "dma_complex_modulus");
            low = fmin(low, of);
            high = fmax(high, of);
        }
    const wt_estimate k = key("indentation/bulk", "spring_constant");
    says("difference",
         "At equal frequency the indentation modulus of the bulk is %#.3g to %#.3g times |E*| "
         "of the DMA, of which the spring constant leaves %.2g %% uncertain.",
         low, high, 100 * k.standard_error / k.value);
}

/* An end of the interval of 95 %. */
static double end(const wt_estimate e, int way)
{
    return e.value + way * 1.959963985 * e.standard_error;
}

static void check_friction(void)
{
    const size_t last = wt_table_n_rows(table("friction")) - 1;
    const double total = key("friction", "friction_at_reference").value,
                 hysteresis = key("friction", "hysteresis_at_reference").value,
                 with = key("friction", "friction_with_layer_at_reference").value;
    const char *velocity = WORDS(key("friction", "reference_velocity").value, "m/s");
    char at_velocity[128];
    snprintf(at_velocity, sizeof at_velocity, "%s", velocity);
    const wt_estimate without = key("friction", "friction_at_reference"),
                      change_of = key("friction", "relative_change_at_reference"),
                      layered = key("friction", "friction_with_layer_at_reference");
    says("friction", "Without a layer, at %s, mu = %#.3g (95 %% interval %#.3g to %#.3g; ",
         at_velocity, total, end(without, -1), end(without, 1));
    says("friction", "): hysteresis %#.4g (95 %% interval ", hysteresis);
    says("friction", "shearing of the real contact %.3g; ", total - hysteresis);
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i <= last; i++) {
        const double change =
            at("friction", i, "friction_with_layer") / at("friction", i, "friction") - 1;
        low = fmin(low, change);
        high = fmax(high, change);
    }
    says("friction",
         "With the layer (%s thick, modulus ratio %#.3g), at %s, mu = %#.3g (95 %% interval %#.3g "
         "to %#.3g; ",
         WORDS(key("friction", "layer_thickness").value, "m"),
         key("friction", "layer_modulus_ratio").value, at_velocity, with, end(layered, -1),
         end(layered, 1));
    assert_near(change_of.value, with / total - 1, 1e-9);
    says("friction",
         "the layer lowers or raises friction: %+.0f %% (95 %% interval %+.0f %% to "
         "%+.0f %%); over all choices of the model ",
         100 * change_of.value, 100 * end(change_of, -1), 100 * end(change_of, 1));
    says("friction", ". From %s to %s the change is %+.0f %% to %+.0f %%.",
         WORDS(at("friction", 0, "velocity"), "m/s"),
         WORDS(at("friction", last, "velocity"), "m/s"), 100 * low, 100 * high);
}

static void check_thickness(void)
{
    const wt_estimate d = key("layer", "balance_thickness"),
                      r = key("layer", "formation_wear_ratio"),
                      first = key("layer", "incubation_time"),
                      most = key("layer", "time_to_90_percent"),
                      u = key("layer", "critical_energy");
    says("thickness", "%s (95 %% interval %s to %s); over all choices of the model ",
         WORDS(d.value, "m"), WORDS(end(d, -1), "m"), WORDS(end(d, 1), "m"));
    says("thickness",
         " That is where formation balances wear, at %s and %s; predicted from a given U_c. "
         "Formation over wear R = %#.3g (95 %%: %#.3g to %#.3g). With 1 %% more wear it is %.2g %% "
         "thinner.",
         WORDS(key("layer", "velocity").value, "m/s"), WORDS(key("layer", "pressure").value, "Pa"),
         r.value, end(r, -1), end(r, 1), -key("layer", "wear_sensitivity").value);
    says("thickness", "It begins to form after %s (95 %%: %s to %s) and reaches 90 %% of the ",
         WORDS(first.value, "s"), WORDS(end(first, -1), "s"), WORDS(end(first, 1), "s"));
    says("thickness", "balance after %s (95 %%: %s to %s), time under load.",
         WORDS(most.value, "s"), WORDS(end(most, -1), "s"), WORDS(end(most, 1), "s"));
    says("limit", "The critical energy, %s, is stated, not measured.", WORDS(u.value, "J/m^3"));
}

/* By how much an error of the sensitivity moves the moduli, and their ratio. */
static void check_lever(void)
{
    double gain[2] = {0};
    static const char *const groups[] = {"indentation/bulk", "indentation/track"};
    for (size_t g = 0; g < 2; g++) {
        const wt_table *t = table(groups[g]);
        const size_t n = wt_table_n_rows(t);
        for (size_t i = 0; i < n; i++) { /* the median: of 48 the mean of the 24th and the 25th */
            size_t below = 0;
            for (size_t k = 0; k < n; k++)
                below += cell(t, k, "sensitivity_gain") < cell(t, i, "sensitivity_gain");
            if (below == n / 2 - 1 || below == n / 2)
                gain[g] += cell(t, i, "sensitivity_gain") / 2;
        }
    }
    says("limit",
         "1 %% of the deflection sensitivity is %.3g %% of the modulus of the bulk and %.3g %% of "
         "that of the track; with one cantilever, %.2g %% of the ratio.",
         gain[0], gain[1], fabs(gain[0] - gain[1]));
}

static void test_bundled(void **state)
{
    (void)state;
    run_case(WT_SOURCE_DIR "/fixtures/case/case.xml", NULL);
    check_layer();
    check_difference();
    check_thickness();
    check_friction();
    check_lever();
}

/* The groups exchanged: every sign turns. */
static void exchange(wt_case *c)
{
    const case_files bulk = c->bulk;
    c->bulk = c->track;
    c->track = bulk;
}

static void test_exchanged(void **state)
{
    (void)state;
    run_case(WT_SOURCE_DIR "/fixtures/case/case.xml", exchange);
    assert_true(at("comparison", 0, "ratio") > 1);
    assert_non_null(
        strstr(wt_table_key(table("comparison"), "differs"), "yes: the wear track is "));
    check_layer();
    assert_true(key("friction", "layer_modulus_ratio").value > 1);
    check_thickness();
    check_friction();
}

/* Wear that leaves nothing. */
static void wear_more(wt_case *c)
{
    c->layer.specific_wear_rate.value *= 100;
}

static void test_no_layer(void **state)
{
    (void)state;
    run_case(WT_SOURCE_DIR "/fixtures/case/case.xml", wear_more);
    const wt_estimate r = key("layer", "formation_wear_ratio");
    says("thickness", "wear removes the rubber faster than it is modified");
    says("thickness", "%#.3g", r.value);
    says("thickness", "The specific wear rate would have to be below %.3g mm^3/(N m).",
         1e9 * key("layer", "critical_specific_wear_rate").value);
    says("friction", "Where wear leaves no layer, that is the friction: nothing changes.");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bundled),
                                       cmocka_unit_test(test_exchanged),
                                       cmocka_unit_test(test_no_layer)};
    return cmocka_run_group_tests_name("sentences", tests, NULL, clean);
}
