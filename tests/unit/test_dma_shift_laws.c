/* Shift laws against the table tests/numeric/wlf.txt, and their invariants.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/dma.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double celsius = 273.15;

/* Reads up to eight numbers ("nan" allowed) after the word; returns their number. */
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
        if (strcmp(kind, "shift") == 0) {
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
    assert_true(n_cases >= 10);
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
        cmocka_unit_test(arrhenius_neighbouring_temperatures_keep_their_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
