/* Temperatures and frequencies outside columns, rows in any order, and moduli that follow from
 * other quantities. The texts are written here from one law, so that the truth is known.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "all_formats.h"

#include "read/text/text_condition.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N_T = 3, N_F = 4 };
static const double degrees[N_T] = {-10, 0, 20}, hertz[N_F] = {0.5, 2, 8, 32};

/* An asymmetric law [MPa]: exchanged rows or columns give other numbers. */
static double storage(double celsius, double f)
{
    return 30 - celsius + 3 * sqrt(f);
}

static double loss(double celsius, double f)
{
    return 4 + 0.1 * celsius + 0.2 * sqrt(f);
}

/* A growing text. */
typedef struct made_text {
    char text[8192];
    size_t n;
} made_text;

static void add(made_text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(made_text *t, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int n = vsnprintf(t->text + t->n, sizeof t->text - t->n, format, list);
    va_end(list);
    assert_true(n >= 0 && t->n + (size_t)n < sizeof t->text);
    t->n += (size_t)n;
}

static wt_status read_sweep(const char *text, const wt_read_options *options, wt_sweep *sweep,
                            wt_log *log, wt_error *err)
{
    wt_input *input = NULL;
    const wt_format_info *info = NULL;
    wt_read_options chosen = *options;
    *sweep = (wt_sweep){.n_isotherms = 0};
    *err = (wt_error)WT_ERROR_INIT;
    assert_int_equal(wt_input_open_memory(text, strlen(text), "made-up.csv", &input, err), WT_OK);
    wt_status status = wt_format_detect(formats, input, &chosen, WT_KIND_SWEEP, &info, err);
    if (status == WT_OK) {
        chosen.format = info->id;
        status = wt_sweep_read(formats, input, &chosen, log, sweep, err);
    }
    wt_input_close(input);
    return status;
}

/* Tests that the isotherms of a text are those of the law, without a warning. */
static void reads_isotherms(const char *text)
{
    const wt_read_options options = wt_read_defaults();
    wt_sweep sweep;
    wt_error err;
    wt_log *log = wt_log_new();
    if (read_sweep(text, &options, &sweep, log, &err) != WT_OK)
        fail_msg("%s\n%s: %s (%s, %s)", text, err.place, err.message, err.found, err.advice);
    for (size_t i = 0; i < wt_log_count(log); i++)
        if (wt_log_get(log, i).severity == WT_WARNING)
            fail_msg("%s\nwarning: %s", text, wt_log_get(log, i).text);
    if (sweep.n_isotherms != N_T)
        fail_msg("%s\n%zu isotherms", text, sweep.n_isotherms);
    for (size_t t = 0; t < N_T; t++) {
        const wt_isotherm *const s = &sweep.isotherms[t];
        assert_near(s->temperature, degrees[t] + WT_ZERO_CELSIUS, 1e-9);
        assert_int_equal(s->n, N_F);
        for (size_t i = 0; i < N_F; i++) {
            assert_near(s->angular_frequency[i], 2 * M_PI * hertz[i], 1e-9);
            assert_near(s->storage_modulus[i], 1e6 * storage(degrees[t], hertz[i]), 1e-7);
            assert_near(s->loss_modulus[i], 1e6 * loss(degrees[t], hertz[i]), 1e-7);
        }
    }
    wt_log_free(log);
    wt_sweep_clear(&sweep);
}

static void add_rows(made_text *t, double celsius)
{
    for (size_t i = 0; i < N_F; i++)
        add(t, "%g,%.10g,%.10g\n", hertz[i], storage(celsius, hertz[i]), loss(celsius, hertz[i]));
}

/* ---- lines above tables ---------------------------------------------------------------------- */

/* A line above each table; column names above all tables (`names` NULL: only above the first). */
static void reads_lines(const char *line, const char *gap, bool names_once)
{
    made_text t = {.n = 0};
    if (names_once)
        add(&t, "f (Hz),E' (MPa),E'' (MPa)\n");
    for (size_t k = 0; k < N_T; k++) {
        char number[16];
        snprintf(number, sizeof number, "%g", degrees[k]);
        for (const char *c = line; *c != '\0'; c++)
            if (*c == '#')
                add(&t, "%s", number);
            else
                add(&t, "%c", *c);
        add(&t, "\n%s", names_once ? "" : "f (Hz),E' (MPa),E'' (MPa)\n");
        add_rows(&t, degrees[k]);
        add(&t, "%s", gap);
    }
    reads_isotherms(t.text);
}

static void lines_above(void **state)
{
    (void)state;
    static const char *const lines[] = {
        "Temperature: # \u00b0C",   "T = #\u00b0C", "Temperature,#,\u00b0C",
        "Temperature (\u00b0C): #", "# degC",       "Isotherm at # \u00baC",
        "Temperature: # \u00b0C,,"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        reads_lines(lines[i], "\n", false);
        reads_lines(lines[i], "", false);
        reads_lines(lines[i], "", true);
    }
    /* a title directly above the names */
    reads_lines("rubber, # \u00b0C", "\n", false);
    reads_lines("rubber, # \u00b0C", "", false);
}

/* Reads a text that fails or warns; the message contains the words. */
static void says(const char *text, const wt_read_options *options, wt_status expected,
                 const char *words)
{
    wt_sweep sweep;
    wt_error err;
    char message[1024] = "";
    wt_log *log = wt_log_new();
    const wt_status status = read_sweep(text, options, &sweep, log, &err);
    if (status != expected)
        fail_msg("%s\n%s (%s)", text, err.message, err.found);
    bool found = false;
    wt_error_format(&err, message, sizeof message);
    found = strstr(message, words) != NULL;
    for (size_t i = 0; i < wt_log_count(log); i++)
        found = found || (wt_log_get(log, i).severity == WT_WARNING &&
                          strstr(wt_log_get(log, i).text, words) != NULL);
    if (!found)
        fail_msg("%s\n%s", text, message);
    wt_log_free(log);
    wt_sweep_clear(&sweep);
}

static void other_temperatures(void **state)
{
    (void)state;
    wt_read_options options = wt_read_defaults();
    static const char table[] = "f (Hz),E' (MPa),E'' (MPa)\n1,3.5,0.5\n10,4.5,0.5\n";
    char text[512];
    /* a temperature other than that of the data */
    static const char *const others[] = {"Reference temperature: 20 degC", "Tg = -50 degC",
                                         "cooled at 10 K/min", "range 10-20 degC",
                                         "0 degC to 20 degC"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        snprintf(text, sizeof text, "%s\n%s", others[i], table);
        says(text, &options, WT_E_MISSING, "no temperature");
    }
    /* one stated temperature for tables that state theirs */
    options.temperature = WT_ZERO_CELSIUS + 16;
    snprintf(text, sizeof text, "T = 0 degC\n%s\nT = 20 degC\n%s", table, table);
    says(text, &options, WT_E_ARG, "2 tables that state their own");
    snprintf(text, sizeof text, "T = 0 degC\n%s", table);
    says(text, &options, WT_OK, "states a temperature of 0.00 degC");
    snprintf(text, sizeof text, "%s\nf (Hz),E' (MPa),E'' (MPa)\n1,350.5,50.5\n10,450.5,50.5\n",
             table);
    says(text, &options, WT_OK, "one temperature, 16.00 degC, is given for 2 isotherms");
    options.temperature = (double)NAN;
    snprintf(text, sizeof text, "T = 0 degC\n%s\nT = 20 degC\n%s\nmore\n%s", table, table, table);
    says(text, &options, WT_OK, "no temperature above this table");
}

/* ---- columns for each condition -------------------------------------------------------------- */

/* Of two columns of temperature that of the sample is read, in any order. */
static void sample_temperature_before_oven(void **state)
{
    static const char *const names[] = {"Temperature (\u00b0C),Sample temperature (\u00b0C)",
                                        "Sample temperature (\u00b0C),Temperature (\u00b0C)"};
    const wt_read_options options = wt_read_defaults();
    (void)state;
    for (int first = 0; first < 2; first++) {
        made_text t = {.n = 0};
        wt_sweep sweep;
        wt_error err;
        wt_log *log = wt_log_new();
        add(&t, "Frequency (Hz),%s,Storage modulus (MPa),Loss modulus (MPa)\n", names[first]);
        for (size_t f = 0; f < N_F; f++)
            add(&t, "%g,%d,%d,%.9g,%.9g\n", hertz[f], first ? 22 : 20, first ? 20 : 22,
                storage(20, hertz[f]), loss(20, hertz[f]));
        assert_int_equal(read_sweep(t.text, &options, &sweep, log, &err), WT_OK);
        assert_near(sweep.isotherms[0].temperature, 22 + WT_ZERO_CELSIUS, 1e-12);
        wt_sweep_clear(&sweep);
        wt_log_free(log);
    }
}

/* A table with two columns for each temperature. '#' in a name is the temperature. */
static void reads_wide_as(const char *above, const char *first, const char *storage_name,
                          const char *loss_name, const char *below)
{
    made_text t = {.n = 0};
    add(&t, "%s%s", above, first);
    for (size_t k = 0; k < 2 * N_T; k++) {
        add(&t, ",");
        for (const char *c = k % 2 == 0 ? storage_name : loss_name; *c != '\0'; c++)
            if (*c == '#')
                add(&t, "%g", degrees[k / 2]);
            else
                add(&t, "%c", *c);
    }
    add(&t, "\n%s", below);
    for (size_t i = 0; i < N_F; i++) {
        add(&t, "%g", hertz[i]);
        for (size_t k = 0; k < N_T; k++)
            add(&t, ",%.10g,%.10g", storage(degrees[k], hertz[i]), loss(degrees[k], hertz[i]));
        add(&t, "\n");
    }
    reads_isotherms(t.text);
}

static void reads_wide(const char *above, const char *storage_name, const char *loss_name,
                       const char *below)
{
    reads_wide_as(above, "f (Hz)", storage_name, loss_name, below);
}

static void wide_tables(void **state)
{
    (void)state;
    reads_wide("", "E' # degC (MPa)", "E'' # degC (MPa)", "");
    reads_wide("", "E' (MPa) #C", "E'' (MPa) #C", "");
    reads_wide("", "E' [MPa] (T = # degC)", "E'' [MPa] (T = # degC)", "");
    reads_wide("", "# degC: E' (MPa)", "# degC: E'' (MPa)", "");
}

static void wide_by_rows(void **state)
{
    (void)state;
    static const char s[] = "E' (MPa)", l[] = "E'' (MPa)";
    reads_wide(",-10 degC,,0 degC,,20 degC,\n", s, l, "");
    reads_wide("Temperature,-10 degC,-10 degC,0 degC,0 degC,20 degC,20 degC\n", s, l, "");
    reads_wide("T (degC),-10,,0,,20,\n", s, l, "");
    reads_wide("", s, l, ",-10 degC,-10 degC,0 degC,0 degC,20 degC,20 degC\n");
    reads_wide_as(",T = -10 degC,,T = 0 degC,,T = 20 degC,\n", "f", "E'", "E''",
                  "Hz,MPa,MPa,MPa,MPa,MPa,MPa\n");
}

/* A row of temperatures below the names states no units, not even for a column without one. In both
 * places the first temperature may be above the frequencies, too. */
static void temperatures_below_names(void **state)
{
    (void)state;
    for (int way = 0; way < 3; way++) {
        made_text t = {.n = 0};
        const bool is_above = way == 2;
        for (int row = 0; row < 2; row++) {
            const bool is_names = row == (is_above ? 1 : 0);
            if (is_names)
                add(&t, "f (Hz)");
            else if (way > 0)
                add(&t, "%g degC", degrees[0]);
            for (size_t k = 0; k < N_T; k++)
                if (is_names)
                    add(&t, ",E' (MPa),tan delta");
                else
                    add(&t, ",%g degC,%g degC", degrees[k], degrees[k]);
            add(&t, "\n");
        }
        for (size_t i = 0; i < N_F; i++) {
            add(&t, "%g", hertz[i]);
            for (size_t k = 0; k < N_T; k++)
                add(&t, ",%.10g,%.12g", storage(degrees[k], hertz[i]),
                    loss(degrees[k], hertz[i]) / storage(degrees[k], hertz[i]));
            add(&t, "\n");
        }
        reads_isotherms(t.text);
    }
}

static void frequencies_in_names(void **state)
{
    (void)state;
    const wt_read_options options = wt_read_defaults();
    made_text t = {.n = 0};
    wt_sweep sweep;
    wt_error err;
    add(&t, "T (degC),E'(0.5 Hz)/MPa,E''(0.5 Hz)/MPa,E'(32.0 Hz)/MPa,E''(32.0 Hz)/MPa\n");
    for (int celsius = -40; celsius <= 40; celsius += 4)
        add(&t, "%d,%.10g,%.10g,%.10g,%.10g\n", celsius, storage(celsius, 0.5), loss(celsius, 0.5),
            storage(celsius, 32), loss(celsius, 32));
    assert_int_equal(read_sweep(t.text, &options, &sweep, NULL, &err), WT_OK);
    assert_int_equal(sweep.n_ramps, 2);
    for (size_t i = 0; i < 2; i++) {
        const wt_ramp *const r = &sweep.ramps[i];
        const double f = r->angular_frequency / (2 * M_PI);
        assert_true(fabs(f - 0.5) < 1e-9 || fabs(f - 32) < 1e-9);
        assert_int_equal(r->n, 21);
        assert_near(r->storage_modulus[3], 1e6 * storage(r->temperature[3] - WT_ZERO_CELSIUS, f),
                    1e-7);
    }
    assert_true(fabs(sweep.ramps[0].angular_frequency - sweep.ramps[1].angular_frequency) > 1);
    wt_sweep_clear(&sweep);
}

/* ---- rows ------------------------------------------------------------------------------------ */

static void any_order(void **state)
{
    (void)state;
    /* visits all rows with a step that has no common factor with their number */
    static const size_t steps[] = {5, 7};
    enum { N = N_T * N_F };
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        made_text t = {.n = 0};
        add(&t, "f (Hz),E' (MPa),E'' (MPa),T (degC)\n");
        for (size_t i = 0; i < N; i++) {
            const double f = hertz[steps[k] * i % N % N_F],
                         celsius = degrees[steps[k] * i % N / N_F];
            add(&t, "%g,%.10g,%.10g,%g\n", f, storage(celsius, f), loss(celsius, f), celsius);
        }
        reads_isotherms(t.text);
    }
    /* by temperature, with the frequencies in any order */
    static const size_t order[N_F] = {2, 0, 3, 1};
    made_text t = {.n = 0};
    add(&t, "f (Hz),E' (MPa),E'' (MPa),T (degC)\n");
    for (size_t i = 0; i < N; i++) {
        const double f = hertz[order[(i + i / N_F) % N_F]], celsius = degrees[i / N_F];
        add(&t, "%g,%.10g,%.10g,%g\n", f, storage(celsius, f), loss(celsius, f), celsius);
    }
    reads_isotherms(t.text);
}

/* All temperatures of one frequency after another. With few frequencies these are temperature
 * sweeps. */
static void by_frequency(void **state)
{
    (void)state;
    const wt_read_options options = wt_read_defaults();
    for (int n_f = 2; n_f <= 6; n_f += 4) {
        made_text t = {.n = 0};
        wt_sweep sweep;
        wt_error err;
        add(&t, "f (Hz),E' (MPa),E'' (MPa),T (degC)\n");
        for (int i = 0; i < n_f; i++)
            for (int celsius = -20; celsius <= 20; celsius += 8)
                add(&t, "%d,%.10g,%.10g,%d\n", 1 << i, storage(celsius, 1 << i),
                    loss(celsius, 1 << i), celsius);
        assert_int_equal(read_sweep(t.text, &options, &sweep, NULL, &err), WT_OK);
        assert_int_equal(sweep.n_isotherms, n_f == 6 ? 6 : 0);
        assert_int_equal(sweep.n_ramps, n_f == 6 ? 0 : 2);
        wt_sweep_clear(&sweep);
    }
}

/* ---- moduli ---------------------------------------------------------------------------------- */

/* A table of two quantities that determine the moduli. */
static void reads_pair(const char *first, const char *second, bool is_magnitude, int kind)
{
    made_text t = {.n = 0};
    add(&t, "f (Hz),%s,%s,T (degC)\n", first, second);
    for (size_t k = 0; k < N_T; k++)
        for (size_t i = 0; i < N_F; i++) {
            const double a = storage(degrees[k], hertz[i]), b = loss(degrees[k], hertz[i]);
            const double seconds[] = {atan2(b, a) * 180 / M_PI, atan2(b, a), b / a, a, b};
            add(&t, "%g,%.12g,%.12g,%g\n", hertz[i], is_magnitude ? hypot(a, b) : a, seconds[kind],
                degrees[k]);
        }
    reads_isotherms(t.text);
}

static void moduli_that_follow(void **state)
{
    (void)state;
    reads_pair("E' (MPa)", "delta (deg)", false, 0);
    reads_pair("E' (MPa)", "phase angle (\u00b0)", false, 0);
    reads_pair("E' (MPa)", "\u03b4 (rad)", false, 1);
    reads_pair("E' (MPa)", "tan delta", false, 2);
    reads_pair("|E*| (MPa)", "delta (deg)", true, 0);
    reads_pair("|E*| (MPa)", "tan delta", true, 2);
    reads_pair("|E*| (MPa)", "E' (MPa)", true, 3);
    reads_pair("|E*| (MPa)", "E'' (MPa)", true, 4);
    /* a phase angle without a unit is used */
    const wt_read_options options = wt_read_defaults();
    says("f (Hz),E' (MPa),delta,T (degC)\n1,3.5,4,20\n10,4.5,4,20\n", &options, WT_E_UNIT,
         "\"delta\"");
}

/* ---- cells ----------------------------------------------------------------------------------- */

static void signs_and_marks(void **state)
{
    (void)state;
    made_text t = {.n = 0};
    /* minus sign, look-alike of the degree sign, no-break space */
    add(&t, "f (Hz),E' (MPa),E'' (MPa),T (\u00baC)\n");
    for (size_t k = 0; k < N_T; k++)
        for (size_t i = 0; i < N_F; i++)
            add(&t, "%g,%.10g,%.10g\u00a0,%s%g\n", hertz[i], storage(degrees[k], hertz[i]),
                loss(degrees[k], hertz[i]), degrees[k] < 0 ? "\u2212" : "", fabs(degrees[k]));
    reads_isotherms(t.text);
    const wt_read_options options = wt_read_defaults();
    says("f (Hz);E' (kPa);E'' (kPa);T (degC)\n1;30.412;6.855;0\n10;53.038;8.808;0\n"
         "100;90.243;67.620;0\n",
         &options, WT_OK, "separates thousands");
}

static void qualifiers(void **state)
{
    (void)state;
    made_text t = {.n = 0};
    add(&t, "f,T,Strain,Strain,E',E''\n,,Waveform,,,\nHz,degC,%%,%%,MPa,MPa\n");
    for (size_t k = 0; k < N_T; k++)
        for (size_t i = 0; i < N_F; i++)
            add(&t, "%g,%g,0.5,0.1,%.10g,%.10g\n,,0.7,,,\n,,0.9\n", hertz[i], degrees[k],
                storage(degrees[k], hertz[i]), loss(degrees[k], hertz[i]));
    reads_isotherms(t.text);
    const wt_read_options options = wt_read_defaults();
    wt_sweep sweep;
    wt_error err;
    assert_int_equal(read_sweep(t.text, &options, &sweep, NULL, &err), WT_OK);
    assert_near(sweep.isotherms[0].strain[0], 0.001, 1e-12);
    wt_sweep_clear(&sweep);
}

/* ---- texts ----------------------------------------------------------------------------------- */

static void extracts(const char *text, const char *rest, double celsius, double f)
{
    char found[COLUMN_NAME_SIZE];
    text_condition c;
    if (!condition_extract((text_span){text, strlen(text)}, found, &c))
        fail_msg("\"%s\" has no condition", text);
    assert_string_equal(found, rest);
    if (isnan(celsius))
        assert_true(isnan(c.temperature));
    else
        assert_near(c.temperature, celsius + WT_ZERO_CELSIUS, 1e-12);
    if (isnan(f))
        assert_true(isnan(c.angular_frequency));
    else
        assert_near(c.angular_frequency, 2 * M_PI * f, 1e-12);
}

static void names_with_conditions(void **state)
{
    (void)state;
    const double none = (double)NAN;
    text_condition c;
    char rest[COLUMN_NAME_SIZE];
    static const char *const plain[] = {"E' (MPa)", "T (degC)",    "rate 10 K/min", "E' 10-20 degC",
                                        "f / Hz",   "E' 0 C, 1 C", "E20C"};
    extracts("E' -20.5 degC (MPa)", "E' (MPa)", -20.5, none);
    extracts("E'(1.000 Hz)/MPa", "E'/MPa", none, 1);
    extracts("E' (MPa, 20 degC)", "E' (MPa)", 20, none);
    extracts("E_storage_20C_Pa", "E_storage_Pa", 20, none);
    extracts("E_stor_-20C (MPa)", "E_stor (MPa)", -20, none);
    extracts("T = 20 degC: E'", "E'", 20, none);
    extracts("E' at T = 20 degC, f = 2,5 Hz", "E'", 20, 2.5);
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        if (condition_extract((text_span){plain[i], strlen(plain[i])}, rest, &c))
            fail_msg("\"%s\": a condition of %g K", plain[i], c.temperature);
    assert_true(condition_extract((text_span){"E'-20C", 6}, rest, &c));
    assert_true(c.is_sign_unclear);
    assert_true(condition_match_name("*_#C", "sbr_-20C", &c));
    assert_near(c.temperature, 253.15, 1e-12);
}

/* ---- columns that state one quantity -----------------------------------------------------------
 */

/* Inconsistent columns are named with the factor; consistent ones are not. */
static void columns_that_contradict_are_named(void **state)
{
    (void)state;
    static const struct {
        double of_omega, of_factor; /* factor of the true value */
        const char *warning;        /* NULL: none */
    } cases[] = {{1, 1, NULL},
                 {1, 1.05, NULL}, /* rounded to one digit */
                 {1 / (2 * M_PI), 1, "0.159 times 2 pi f"},
                 {1, 2, "2 times E''/E'"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        made_text t = {.n = 0};
        const wt_read_options options = wt_read_defaults();
        wt_log *log = wt_log_new();
        wt_sweep sweep;
        wt_error err;
        size_t n = 0;
        add(&t, "f (Hz),omega (rad/s),E' (MPa),E'' (MPa),tan delta,T (degC)\n");
        for (size_t i = 0; i < N_T; i++)
            for (size_t f = 0; f < N_F; f++) {
                const double e1 = storage(degrees[i], hertz[f]), e2 = loss(degrees[i], hertz[f]);
                add(&t, "%g,%.6g,%.6g,%.6g,%.6g,%g\n", hertz[f],
                    2 * M_PI * hertz[f] * cases[k].of_omega, e1, e2, e2 / e1 * cases[k].of_factor,
                    degrees[i]);
            }
        assert_int_equal(read_sweep(t.text, &options, &sweep, log, &err), WT_OK);
        for (size_t i = 0; i < wt_log_count(log); i++) {
            const wt_log_entry e = wt_log_get(log, i);
            n += e.action == WT_CONTRADICTED;
            if (e.action == WT_CONTRADICTED && strstr(e.text, cases[k].warning) == NULL)
                fail_msg("%s", e.text);
        }
        assert_int_equal(n, cases[k].warning != NULL);
        wt_sweep_clear(&sweep);
        wt_log_free(log);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(columns_that_contradict_are_named),
                                       cmocka_unit_test(lines_above),
                                       cmocka_unit_test(other_temperatures),
                                       cmocka_unit_test(sample_temperature_before_oven),
                                       cmocka_unit_test(wide_tables),
                                       cmocka_unit_test(wide_by_rows),
                                       cmocka_unit_test(temperatures_below_names),
                                       cmocka_unit_test(frequencies_in_names),
                                       cmocka_unit_test(any_order),
                                       cmocka_unit_test(by_frequency),
                                       cmocka_unit_test(moduli_that_follow),
                                       cmocka_unit_test(signs_and_marks),
                                       cmocka_unit_test(qualifiers),
                                       cmocka_unit_test(names_with_conditions)};
    return cmocka_run_group_tests(tests, open_formats, free_formats);
}
