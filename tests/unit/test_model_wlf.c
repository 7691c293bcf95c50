/* Shift laws against the table tests/numeric/wlf.txt, and their invariants.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "near.h"
#include "weartrack/model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double celsius = 273.15;

/* Reads up to eight numbers ("nan" allowed) after the word; returns how many. */
static size_t numbers_of(char *line, double value[8])
{
    size_t n = 0;
    char *save = NULL;
    strtok_r(line, " \t\n", &save);
    for (char *word; n < 8 && (word = strtok_r(NULL, " \t\n", &save)) != NULL;) {
        char *end = NULL;
        value[n++] = strtod(word, &end);
        assert_true(*end == '\0');
    }
    return n;
}

static void wlf_table(void **state)
{
    (void)state;
    FILE *file = fopen(WT_SOURCE_DIR "/tests/numeric/wlf.txt", "r");
    assert_non_null(file);
    char line[256];
    size_t n_cases = 0;
    while (fgets(line, sizeof line, file) != NULL) {
        if (line[0] == '#' || line[0] == '\n')
            continue;
        char kind[256];
        memcpy(kind, line, sizeof kind);
        kind[strcspn(kind, " \t\n")] = '\0';
        double v[8];
        const size_t n = numbers_of(line, v);
        const wt_wlf law = {v[0] + celsius, v[1], v[2]};
        if (strcmp(kind, "move") == 0) {
            assert_int_equal(n, 7);
            wt_wlf moved;
            wt_error err = WT_ERROR_INIT;
            assert_int_equal(wt_wlf_rereference(&law, v[3] + celsius, &moved, &err), WT_OK);
            assert_near(moved.c1, v[4], v[6]);
            assert_near(moved.c2, v[5], v[6]);
            assert_near(moved.c1 * moved.c2, law.c1 * law.c2, 1e-14);
            assert_near(moved.reference_temperature, v[3] + celsius, 0.0);
        } else if (strcmp(kind, "shift") == 0) {
            assert_int_equal(n, 6);
            assert_near_abs(wt_wlf_log_shift(&law, v[3] + celsius), v[4], v[5]);
        } else {
            assert_string_equal(kind, "arrhenius");
            assert_int_equal(n, 5);
            assert_near_abs(wt_arrhenius_log_shift(v[0], v[1] + celsius, v[2] + celsius), v[3],
                            v[4]);
        }
        n_cases++;
    }
    fclose(file);
    assert_true(n_cases >= 14);
}

/* log aT' = log aT(T) - log aT(T'): the master curve moves as a whole. */
static void wlf_rereference_moves_all_shifts_alike(void **state)
{
    (void)state;
    const wt_wlf law = {243.15, 8.1893, 84.454};
    wt_wlf moved;
    assert_int_equal(wt_wlf_rereference(&law, 287.65, &moved, NULL), WT_OK);
    const double at_new = wt_wlf_log_shift(&law, 287.65);
    for (double t = 228.15; t < 300.0; t += 7.3)
        assert_near_abs(wt_wlf_log_shift(&moved, t), wt_wlf_log_shift(&law, t) - at_new, 1e-13);
}

static void wlf_rereference_below_the_pole_is_refused(void **state)
{
    (void)state;
    const wt_wlf law = {373.15, 17.44, 51.6};
    wt_wlf moved = {1.0, 2.0, 3.0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_wlf_rereference(&law, 321.0, &moved, &err), WT_E_RANGE);
    assert_near(moved.c1, 2.0, 0.0); /* unchanged on failure */
    assert_non_null(strstr(err.expected, "48.40 °C"));
    assert_non_null(strstr(err.found, "47.85 °C"));
    const wt_wlf no_law = {293.15, 8.0, -50.0};
    assert_int_equal(wt_wlf_rereference(&no_law, 400.0, &moved, &err), WT_E_RANGE);
}

static void arrhenius_neighbouring_temperatures_keep_their_digits(void **state)
{
    (void)state;
    /* d log a / dT = -Ea / (R ln10 T^2) */
    const double step = 1e-7, t = 298.15, ea = 83000.0;
    const double expected = -ea / (8.31446261815324 * 2.302585092994045684) * step / (t * t);
    assert_near(wt_arrhenius_log_shift(ea, t, t + step), expected, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wlf_table),
        cmocka_unit_test(wlf_rereference_moves_all_shifts_alike),
        cmocka_unit_test(wlf_rereference_below_the_pole_is_refused),
        cmocka_unit_test(arrhenius_neighbouring_temperatures_keep_their_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
