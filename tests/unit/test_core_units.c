/* Units, quantities on the command line, SI prefixes. SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "core/base/memory.h"
#include "core/base/number.h"
#include "core/base/quantity.h"
#include "weartrack/core.h"

#include <locale.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static void check_unit(const char *unit, wt_quantity quantity, double factor, double offset)
{
    double f = (double)NAN, o = (double)NAN;
    wt_error err = WT_ERROR_INIT;
    if (wt_unit_to_si(unit, quantity, &f, &o, &err) != WT_OK) {
        print_error("unit \"%s\" refused: %s\n", unit, err.message);
        fail();
    }
    assert_near(f, factor, 4e-16);
    assert_near(o, offset, 4e-16);
}

static void check_refused(const char *unit, wt_quantity quantity)
{
    double f = 7.5, o = 8.5;
    wt_error err = WT_ERROR_INIT;
    if (wt_unit_to_si(unit, quantity, &f, &o, &err) != WT_E_UNIT) {
        print_error("unit \"%s\" accepted\n", unit);
        fail();
    }
    assert_int_equal(err.status, WT_E_UNIT);
    assert_true(err.message[0] != '\0' && err.expected[0] != '\0');
    /* Unchanged on failure. */
    assert_near(f, 7.5, 0.0);
    assert_near(o, 8.5, 0.0);
}

static void units_of_instruments(void **state)
{
    (void)state;
    check_unit("MPa", WT_Q_STORAGE_MODULUS, 1e6, 0);
    check_unit("[MPa]", WT_Q_STORAGE_MODULUS, 1e6, 0);
    check_unit(" [ kPa ] ", WT_Q_LOSS_MODULUS, 1e3, 0);
    check_unit("dyn/cm^2", WT_Q_STRESS, 0.1, 0);
    check_unit("nm", WT_Q_HEIGHT, 1e-9, 0);
    check_unit("um", WT_Q_HEIGHT, 1e-6, 0);
    check_unit("\xC2\xB5m", WT_Q_HEIGHT, 1e-6, 0);
    check_unit("\xCE\xBCm", WT_Q_HEIGHT, 1e-6, 0);
    check_unit("nN", WT_Q_FORCE, 1e-9, 0);
    check_unit("pN/nm", WT_Q_SPRING_CONSTANT, 1e-3, 0);
    check_unit("nm/V", WT_Q_SENSITIVITY, 1e-9, 0);
    check_unit("mV", WT_Q_DEFLECTION_VOLTAGE, 1e-3, 0);
    check_unit("%", WT_Q_STRAIN, 1e-2, 0);
    check_unit("-", WT_Q_LOSS_FACTOR, 1, 0);
    check_unit("", WT_Q_LOSS_FACTOR, 1, 0);
    check_unit("1", WT_Q_NONE, 1, 0);
    check_unit("min", WT_Q_TIME, 60, 0);
    check_unit("deg", WT_Q_PHASE, 3.14159265358979323846 / 180, 0);
    check_unit("\xC2\xB0", WT_Q_ANGLE, 3.14159265358979323846 / 180, 0);
    check_unit("mm^3/(N m)", WT_Q_WEAR_RATE, 1e-9, 0);
    check_unit("1/m", WT_Q_WAVENUMBER, 1, 0);
    check_unit("rad/um", WT_Q_WAVENUMBER, 1e6, 0);
    check_unit("cycle/m", WT_Q_WAVENUMBER, 2 * 3.14159265358979323846, 0);
    check_unit("nm^4", WT_Q_POWER_SPECTRUM_2D, 1e-36, 0);
    check_unit("kbyte", WT_Q_DATA_SIZE, 1e3, 0);
}

static void temperatures(void **state)
{
    (void)state;
    check_unit("K", WT_Q_TEMPERATURE, 1, 0);
    check_unit("\xC2\xB0"
               "C",
               WT_Q_TEMPERATURE, 1, 273.15);
    check_unit("degC", WT_Q_TEMPERATURE, 1, 273.15);
    check_unit("degF", WT_Q_TEMPERATURE, 5.0 / 9.0, 459.67 * 5.0 / 9.0);
    check_unit("degC", WT_Q_TEMPERATURE_DIFFERENCE, 1, 0);
    check_unit("degF", WT_Q_TEMPERATURE_DIFFERENCE, 5.0 / 9.0, 0);
    check_refused("C", WT_Q_TEMPERATURE); /* coulomb */
}

static void frequency_differs_from_angular_frequency(void **state)
{
    (void)state;
    check_unit("kHz", WT_Q_FREQUENCY, 1e3, 0);
    check_unit("1/s", WT_Q_FREQUENCY, 1, 0);
    check_unit("rad/s", WT_Q_ANGULAR_FREQUENCY, 1, 0);
    check_unit("rad/sec", WT_Q_ANGULAR_FREQUENCY, 1, 0);
    check_refused("rad/s", WT_Q_FREQUENCY);
    check_refused("Hz", WT_Q_ANGULAR_FREQUENCY);
    check_refused("1/s", WT_Q_ANGULAR_FREQUENCY);
    wt_error err = WT_ERROR_INIT;
    double f, o;
    assert_int_equal(wt_unit_to_si("Hz", WT_Q_ANGULAR_FREQUENCY, &f, &o, &err), WT_E_UNIT);
    assert_non_null(strstr(err.advice, "2 pi"));
}

/* Spellings of instruments and users. */
static void spellings(void **state)
{
    (void)state;
    check_unit("Mpa", WT_Q_PRESSURE, 1e6, 0);
    check_unit("x10^6 Pa", WT_Q_PRESSURE, 1e6, 0);
    check_unit("\xc3\x97"
               "10\xe2\x81\xb6 Pa",
               WT_Q_PRESSURE, 1e6, 0);
    check_unit("kg/mm2", WT_Q_PRESSURE, 9.80665e6, 0);
    check_unit("kg/cm^2", WT_Q_PRESSURE, 9.80665e4, 0);
    check_unit("kg/cm3", WT_Q_MASS_DENSITY, 1e6, 0); /* not a force */
    check_unit("\xd0\x9c\xd0\x9f\xd0\xb0", WT_Q_PRESSURE, 1e6, 0);
    check_unit("deg. C", WT_Q_TEMPERATURE, 1, 273.15);
    check_unit("g", WT_Q_FORCE, 9.80665e-3, 0);
    check_unit("kg", WT_Q_FORCE, 9.80665, 0);
    check_refused("kg/s", WT_Q_FORCE);
}

static void wrong_units(void **state)
{
    (void)state;
    check_refused("Ohm", WT_Q_PRESSURE);
    check_refused("MPA", WT_Q_PRESSURE);
    check_refused("", WT_Q_PRESSURE);
    check_refused("furlongish", WT_Q_LENGTH);
    check_refused("s", WT_Q_FREQUENCY); /* UDUNITS would use the reciprocal */
    check_refused("Hz", WT_Q_TIME);
    check_refused("rad", WT_Q_LOSS_FACTOR);
    check_refused("deg", WT_Q_STRAIN);
    check_refused("m/m", WT_Q_ANGLE);
    check_refused("byte", WT_Q_NONE);
    check_refused("1", WT_Q_DATA_SIZE);
    check_refused("s since 1970-01-01", WT_Q_TIME);
    check_refused("lg(re 1 Pa)", WT_Q_PRESSURE);
    check_refused("m @ 5", WT_Q_LENGTH);
    check_refused("-1 m", WT_Q_LENGTH);
    check_refused("0 m", WT_Q_LENGTH);
    check_refused("m\xB5", WT_Q_LENGTH); /* not UTF-8 */
    char long_unit[400];
    memset(long_unit, 'm', sizeof long_unit);
    long_unit[sizeof long_unit - 1] = '\0';
    check_refused(long_unit, WT_Q_LENGTH);
    double f, o;
    assert_int_equal(wt_unit_to_si("Ohm", WT_Q_PRESSURE, &f, &o, NULL), WT_E_UNIT);
}

static void si_units_are_unchanged(void **state)
{
    (void)state;
    for (size_t i = 0; i < (size_t)WT_Q_COUNT; i++) {
        wt_quantity found = WT_Q_COUNT;
        const wt_quantity q = (wt_quantity)i;
        check_unit(wt_quantity_unit(q), q, 1, 0);
        assert_true(wt_quantity_find(wt_quantity_id(q), &found));
        assert_int_equal(found, q);
    }
    wt_quantity q = WT_Q_FORCE;
    assert_false(wt_quantity_find("colour", &q));
    assert_int_equal(q, WT_Q_FORCE);
}

/* The same result as UDUNITS. Nobody writes brackets around a unit, so that the brackets prevent
 * the table from recognizing it. */
static void check_known(const char *text, wt_quantity quantity)
{
    char asked[80];
    double known[2] = {7.5, 8.5}, udunits[2] = {7.5, 8.5};
    wt_error err = WT_ERROR_INIT, err_udunits = WT_ERROR_INIT;
    (void)snprintf(asked, sizeof asked, "(%s)", text);
    const wt_status status = wt_unit_to_si(text, quantity, &known[0], &known[1], &err);
    if (wt_unit_to_si(asked, quantity, &udunits[0], &udunits[1], &err_udunits) != status) {
        print_error("\"%s\" of %s: %d\n", text, wt_quantity_id(quantity), (int)status);
        fail();
    }
    assert_string_equal(err.message, err_udunits.message);
    assert_string_equal(err.advice, err_udunits.advice);
    for (int i = 0; i < 2; i++)
        assert_near(known[i], udunits[i], 0.0);
}

static void table_agrees_with_udunits(void **state)
{
    (void)state;
    /* the units of the table in unit.c */
    static const char *const known[] = {
        "mm",   "um",        "\xC2\xB5m",  "\xCE\xBCm", "nm",           "pm",    "mN",
        "uN",   "\xC2\xB5N", "nN",         "pN",        "mN/m",         "nN/nm", "mV",
        "nm/V", "um/V",      "ms",         "us",        "min",          "kHz",   "Hz",
        "1/s",  "kPa",       "MPa",        "GPa",       "Pa",           "J/m^3", "1/MPa",
        "1/Pa", "m^2/N",     "mm^3/(N m)", "degC",      "\xC2\xB0\x43", "%",     "percent",
        "deg",  "\xC2\xB0",  "mm/s",       "um/s",      "nm/s",         "1/m"};
    for (size_t q = 0; q < (size_t)WT_Q_COUNT; q++) {
        for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
            check_known(known[i], (wt_quantity)q);
        for (size_t i = 0; i < (size_t)WT_Q_COUNT; i++) {
            const char *const si = wt_quantity_unit((wt_quantity)i);
            if (strstr(si, "Hz^-0.5") == NULL) /* UDUNITS has no roots */
                check_known(si, (wt_quantity)q);
        }
    }
}

static void check_parse(const char *text, wt_quantity quantity, double expected)
{
    double value = (double)NAN;
    wt_error err = WT_ERROR_INIT;
    if (wt_quantity_parse(text, quantity, &value, &err) != WT_OK) {
        print_error("\"%s\" refused: %s\n", text, err.message);
        fail();
    }
    assert_near(value, expected, 4e-16);
}

static void quantities(void **state)
{
    (void)state;
    check_parse("0.4MPa", WT_Q_PRESSURE, 0.4e6);
    check_parse("20 degC", WT_Q_TEMPERATURE, 293.15);
    check_parse("-40\xC2\xB0"
                "C",
                WT_Q_TEMPERATURE, 233.15);
    check_parse("35deg", WT_Q_ANGLE, 35 * (3.14159265358979323846 / 180));
    check_parse("1e-4 mm^3/(N m)", WT_Q_WEAR_RATE, 1e-13);
    check_parse("0.45", WT_Q_NONE, 0.45);
    check_parse("45%", WT_Q_NONE, 0.45);
    check_parse("1e3s", WT_Q_TIME, 1000);
    check_parse(" 2.5 1/s ", WT_Q_RATE, 2.5);
    check_parse("10Hz", WT_Q_ANGULAR_FREQUENCY, 62.83185307179586);
    check_parse("2 kHz", WT_Q_ANGULAR_FREQUENCY, 12566.370614359173);
    check_parse("2 kilohertz", WT_Q_ANGULAR_FREQUENCY, 12566.370614359173);
    check_parse("63rad/s", WT_Q_ANGULAR_FREQUENCY, 63);
    check_parse("10rad/s", WT_Q_FREQUENCY, 1.5915494309189535);
}

/* Maximum of every unit: far above the values of instruments, low enough to detect a wrong unit. */
static void largest_of_each(void **state)
{
    (void)state;
    static const struct {
        const char *unit;
        double most;
    } rows[] = {
        {"1", 1e30},     {"s", 1e30},        {"m", 1e6},          {"V", 1e6},      {"N", 1e9},
        {"rad", 1e6},    {"Hz", 1e30},       {"rad/s", 1e30},     {"Pa", 1e15},    {"1/Pa", 1e6},
        {"rad/m", 1e15}, {"m^4", 1e12},      {"m^3", 1e12},       {"m/s", 1e9},    {"N/m", 1e9},
        {"m/V", 1e3},    {"m^2/N", 1e3},     {"J/m^3", 1e30},     {"W/m^3", 1e30}, {"1/s", 1e30},
        {"byte", 1e30},  {"K", 1e5},         {"m.Hz^-0.5", 1},    {"m^2/Hz", 1},   {"V^2/Hz", 1e6},
        {"kg/m^3", 1e6}, {"V.Hz^-0.5", 1e3}, {"1/K", 1e3},        {"m^2", 1e12},   {"kg", 1e9},
        {"m^2/s", 1e6},  {"N m", 1e9},       {"J/(m^3 K)", 1e12}, {"J/mol", 1e12}};
    for (int q = 1; q < (int)WT_Q_COUNT; q++) {
        const wt_quantity quantity = (wt_quantity)q;
        double most = (double)NAN;
        for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
            if (strcmp(rows[i].unit, wt_quantity_unit(quantity)) == 0)
                most = rows[i].most;
        most = quantity == WT_Q_TEMPERATURE ? 2000 : most;
        assert_true(quantity_is_plausible(quantity, most));
        assert_true(quantity_is_plausible(quantity, -most));
        assert_false(quantity_is_plausible(quantity, 1.01 * most));
        assert_false(quantity_is_plausible(quantity, -1.01 * most));
        assert_false(quantity_is_plausible(quantity, (double)NAN));
    }
}

static void quantities_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        wt_quantity quantity;
        wt_status status;
    } cases[] = {
        {"0.4", WT_Q_PRESSURE, WT_E_UNIT},          {"0,4MPa", WT_Q_PRESSURE, WT_E_ARG},
        {"MPa", WT_Q_PRESSURE, WT_E_ARG},           {"", WT_Q_PRESSURE, WT_E_ARG},
        {"1 200 Pa", WT_Q_PRESSURE, WT_E_ARG},      {"nanPa", WT_Q_PRESSURE, WT_E_ARG},
        {"0x10Pa", WT_Q_PRESSURE, WT_E_UNIT},       {"4 K", WT_Q_PRESSURE, WT_E_UNIT},
        {"1e308MPa", WT_Q_PRESSURE, WT_E_RANGE},    {"-300degC", WT_Q_TEMPERATURE, WT_E_RANGE},
        {"10s", WT_Q_ANGULAR_FREQUENCY, WT_E_UNIT}, {"10s^-1", WT_Q_ANGULAR_FREQUENCY, WT_E_UNIT}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 7.5;
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(wt_quantity_parse(cases[i].text, cases[i].quantity, &value, &err),
                         cases[i].status);
        assert_near(value, 7.5, 0);
        assert_non_null(strstr(err.expected, "such as "));
    }
    wt_error err = WT_ERROR_INIT;
    double value;
    assert_int_equal(wt_quantity_parse("0.4", WT_Q_PRESSURE, &value, &err), WT_E_UNIT);
    assert_string_equal(err.expected, "a pressure with its unit, such as 0.4MPa");
    assert_string_equal(err.found, "\"0.4\"");
    /* The suggested spelling is valid. */
    for (size_t i = 0; i < (size_t)WT_Q_COUNT; i++) {
        assert_int_equal(wt_quantity_parse("bad", (wt_quantity)i, &value, &err), WT_E_ARG);
        const char *const example = strstr(err.expected, "such as ") + 8;
        assert_int_equal(wt_quantity_parse(example, (wt_quantity)i, &value, &err), WT_OK);
    }
}

static void check_format(double value, const char *unit, int digits, const char *expected)
{
    char text[64];
    assert_int_equal(wt_format_si(value, unit, digits, text, sizeof text), strlen(expected));
    assert_string_equal(text, expected);
}

static void formatted(void **state)
{
    (void)state;
    check_format(412e3, "Pa", 3, "412 kPa");
    check_format(412e3, "Pa", 2, "410 kPa");
    check_format(1.15e-6, "m", 3, "1.15 \xC2\xB5m");
    check_format(293.15, "degC", 3,
                 "20.0 \xC2\xB0"
                 "C");
    check_format(293.16, "K", 4, "293.2 K");
    check_format(999.96e3, "Pa", 3, "1.00 MPa");
    check_format(-2.5e-9, "N", 2, "-2.5 nN");
    check_format(0.0, "m", 3, "0.00 m");
    check_format(2.385e-3, "m/s", 3, "2.38 mm/s"); /* the double is just below it */
    check_format(7200, "s", 2, "7200 s");
    check_format(25e3, "m", 2, "25 km");
    check_format(1.5e-13, "m^2/N", 2, "1.5e-13 m^2/N");
    check_format(2.5e7, "rad/m", 2, "2.5e7 rad/m");
    check_format(0.853, "1", 3, "0.853");
    check_format(0.853, "", 3, "0.853");
    check_format(1234567, "byte", 3, "1.23 MB");
    check_format((double)NAN, "Pa", 3, "nan Pa");
    check_format(-(double)INFINITY, "m", 3, "-inf m");
    char small[4];
    assert_int_equal(wt_format_si(412e3, "Pa", 3, small, sizeof small), 7);
    assert_string_equal(small, "412");
}

static void foreign_locale(void **state)
{
    (void)state;
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL)
        skip();
    check_unit("0.5 MPa", WT_Q_PRESSURE, 0.5e6, 0);
    check_parse("0.4MPa", WT_Q_PRESSURE, 0.4e6);
    check_format(1.15e-6, "m", 3, "1.15 \xC2\xB5m");
    (void)setlocale(LC_ALL, "C");
}

static void *convert_often(void *user)
{
    double *const sum = user;
    for (int i = 0; i < 200; i++) {
        double f = (double)NAN, o = (double)NAN;
        if (wt_unit_to_si(i % 2 == 0 ? "(kPa)" : "(mm)", i % 2 == 0 ? WT_Q_PRESSURE : WT_Q_LENGTH,
                          &f, &o, NULL) != WT_OK)
            f = (double)NAN;
        *sum += f;
    }
    return NULL;
}

static void several_threads(void **state)
{
    (void)state;
    pthread_t threads[4];
    double sums[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, convert_often, &sums[i]), 0);
    for (size_t i = 0; i < 4; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        assert_near(sums[i], 100 * 1000.001, 1e-12);
    }
}

static void probabilities_and_shares_as_text(void **state)
{
    (void)state;
    assert_string_equal(format_probability(0.0214).text, "0.021");
    assert_string_equal(format_probability(0.001).text, "0.001");
    assert_string_equal(format_probability(1.3e-5).text, "below 0.001");
    assert_string_equal(format_probability(0).text, "below 0.001");
    assert_string_equal(format_probability((double)NAN).text, "not known");
    assert_string_equal(format_percent(0.0075).text, "0.75 %");
    assert_string_equal(format_percent(0.0994).text, "9.9 %");
    assert_string_equal(format_percent(0.0999).text, "10 %");
    assert_string_equal(format_percent(1.0).text, "100 %");
    assert_string_equal(format_percent(-12.3).text, "-1230 %");
}

/* ---- without the database -------------------------------------------------------------------- */

/* Exit status of a process that cannot read its units; 0 if all required messages are there. */
static int ask_without(const char *database, rlim_t files, const char *message, const char *advice)
{
    int state = 1;
    const pid_t child = fork();
    if (child == 0) {
        double factor = 0, offset = 0;
        wt_error err = WT_ERROR_INIT, end = WT_ERROR_INIT;
        const struct rlimit few = {files, files};
        bool good = database == NULL || setenv("UDUNITS2_XML_PATH", database, 1) == 0;
        good = good && (files == 0 || setrlimit(RLIMIT_NOFILE, &few) == 0);
        resource_error_clear();
        good = good &&
               wt_unit_to_si("furlong", WT_Q_LENGTH, &factor, &offset, &err) == WT_E_INTERNAL &&
               strstr(err.message, message) != NULL && strstr(err.advice, advice) != NULL;
        /* A caller that treated it as an unknown unit gets an error at the end. */
        good = good && resource_error_finish(WT_E_FORMAT, &end) == WT_E_INTERNAL &&
               strcmp(end.message, err.message) == 0;
        _exit(good ? 0 : 1);
    }
    return child > 0 && waitpid(child, &state, 0) == child ? state : -1;
}

/* Before this process has read the database: units missing in a partial database are found in the
 * complete one. */
static void no_database(void **state)
{
    (void)state;
    assert_int_equal(ask_without("/nowhere.xml", 0, "cannot be read: No such file", "install it"),
                     0);
    for (rlim_t files = 3; files < 5; files++)
        assert_int_equal(ask_without(NULL, files, "Too many open files", "ulimit -n"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_database),
        cmocka_unit_test(units_of_instruments),
        cmocka_unit_test(temperatures),
        cmocka_unit_test(frequency_differs_from_angular_frequency),
        cmocka_unit_test(spellings),
        cmocka_unit_test(wrong_units),
        cmocka_unit_test(si_units_are_unchanged),
        cmocka_unit_test(quantities),
        cmocka_unit_test(largest_of_each),
        cmocka_unit_test(quantities_refused),
        cmocka_unit_test(formatted),
        cmocka_unit_test(foreign_locale),
        cmocka_unit_test(probabilities_and_shares_as_text),
        cmocka_unit_test(several_threads),
        cmocka_unit_test(table_agrees_with_udunits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
