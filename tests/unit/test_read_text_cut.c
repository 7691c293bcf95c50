/* Truncated text files: excluded data, kept data, and messages.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "weartrack/read.h"

#include <string.h>

static wt_formats *formats;

typedef struct cut_case {
    const char *text;
    size_t points;     /* number of rows that are read */
    const char *words; /* text of a warning; NULL: none */
} cut_case;

#define HEAD "f [Hz],T [degC],E' [MPa],E'' [MPa]\n"
#define FIXED HEAD "1,20,5.000,1.250\n2,20,6.000,1.500\n"
#define FREE HEAD "1,20,5,1.25\n2,20,6,1.5\n"
#define WHOLE HEAD "1,20,5,12\n2,20,6,13\n"
#define LENGTHS HEAD "1,20,5,9\n2,20,6,13\n"
#define POWERS HEAD "1,20,5,1.25e+06\n2,20,6,1.5e+06\n"
#define STREAM                                                                                     \
    "## table: sweep\n# frequency[Hz]\ttemperature[K]\tstorage_modulus[Pa]\tloss_modulus[Pa]\n"
#define LEFT_OUT "no line end and is no whole row"
#define KEPT "no line end: if the file was cut off"
#define HALF "half a line end"
#define FEWER "fewer cells than all others"
#define TWICE "2 rows from here on are there twice"
#define FACTORS                                                                                    \
    "f [Hz],T [degC],E' [MPa],E'' [MPa],tan delta\n1,20,5,1.25,0.25\n2,20,6,1.5,0.25\n"            \
    "3,20,7,2.1,0.30\n"
#define NOT_THE_RATIO "the loss factor of 1 row from here on is not the ratio of the moduli"
#define OPEN "the line that ends a table is not there"

static const cut_case cases[] = {
    {FIXED "3,20,7.000,1.750\n", 3, NULL},
    {FIXED "3,20,7.000,1.750\n\x1a", 3, NULL},
    /* The end of the last number is complete as far as its neighbours show. */
    {FIXED "3,20,7.000,1.750", 3, KEPT},
    {FIXED "3,20,7.000,1.75", 2, LEFT_OUT},
    {FIXED "3,20,7.000,1.", 2, LEFT_OUT},
    {FIXED "3,20,7.000,", 2, LEFT_OUT},
    {FIXED "3,20,7.000", 2, LEFT_OUT},
    {FIXED "3,20,7.000,-", 2, LEFT_OUT},
    {FREE "3,20,7,1.7", 3, KEPT},
    {FREE "3,20,7,1", 2, LEFT_OUT},
    {FREE "3,20,7,175", 2, LEFT_OUT},
    {WHOLE "3,20,7,14", 3, KEPT},
    {WHOLE "3,20,7,1", 2, LEFT_OUT},
    /* 14 may have been 140. */
    {LENGTHS "3,20,7,14", 2, LEFT_OUT},
    {POWERS "3,20,7,1.75e+06", 3, KEPT},
    {POWERS "3,20,7,1.75e+0", 2, LEFT_OUT},
    {POWERS "3,20,7,1.75e", 2, LEFT_OUT},
    {POWERS "3,20,7,1.750000", 2, LEFT_OUT},
    /* A line end that was added after the truncation. */
    {FIXED "3,20\n", 2, FEWER},
    {FIXED "3,20\n\n", 2, FEWER},
    {HEAD "1,20,5\n2,20,6,1\n3,20,7,2\n4,20,8\n", 2, NULL},
    {FIXED "3,20,7.000,1.750\n4", 3, LEFT_OUT},
    {"f [Hz],T [degC],E' [MPa],E'' [MPa]\r\n1,20,5.0,1.2\r\n2,20,6.0,1.5\r", 2, HALF},
    {"f [Hz],T [degC],E' [MPa],E'' [MPa]\r1,20,5.0,1.2\r2,20,6.0,1.5\r", 2, NULL},
    {FIXED "3,20,7.000,1.750\n2,20,6.000,1.500\n3,20,7.000,1.750\n", 5, TWICE},
    /* A modulus that was 8; a factor with two digits; factors of another kind. */
    {FACTORS "4,20,9,2,0.25\n", 4, NOT_THE_RATIO},
    {FACTORS "4,20,8,2.19,0.27\n", 4, NULL},
    {FACTORS "4,20,8,2,\n", 4, NULL},
    {"f [Hz],T [degC],E' [MPa],E'' [MPa],tan "
     "delta\n1,20,5,1.25,0.3\n2,20,6,1.5,0.2\n3,20,7,2.1,0.4\n"
     "4,20,8,2,0.1\n",
     4, NULL},
    {STREAM "1\t293\t5e6\t1e6\n2\t293\t6e6\t2e6\n##\n", 2, NULL},
    {STREAM "1\t293\t5e6\t1e6\n2\t293\t6e6\t2e6\n##", 2, KEPT},
    {STREAM "1\t293\t5e6\t1e6\n2\t293\t6e6\t2e6\n", 2, OPEN},
    {STREAM "1\t293\t5e6\t1e6\n2\t293\t6e6\t2e6\n" STREAM
            "3\t293\t7e6\t1e6\n4\t293\t8e6\t1e6\n##\n",
     4, OPEN},
    {STREAM "1\t293\t5e6\t1e6\n2\t293\t6e6\t2e6\n##\n## table: curve\n", 2, OPEN},
};

static bool warned(const wt_log *log, const char *words)
{
    static const char *const all[] = {LEFT_OUT, KEPT, HALF, FEWER, OPEN, TWICE, NOT_THE_RATIO};
    bool found = words == NULL;
    for (size_t i = 0; i < wt_log_count(log); i++) {
        const wt_log_entry e = wt_log_get(log, i);
        for (size_t w = 0; w < sizeof all / sizeof *all; w++)
            if (strstr(e.text, all[w]) != NULL && words == NULL)
                return false;
        found = found || (e.severity == WT_WARNING && strstr(e.text, words) != NULL);
    }
    return found;
}

static void truncated_texts(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const wt_read_options options = wt_read_defaults();
        wt_log *const log = wt_log_new();
        wt_sweep sweep = {.n_isotherms = 0};
        wt_input *input = NULL;
        wt_error err = WT_ERROR_INIT;
        size_t n = 0;
        assert_int_equal(
            wt_input_open_memory(cases[i].text, strlen(cases[i].text), "cut.txt", &input, NULL),
            WT_OK);
        if (wt_sweep_read(formats, input, &options, log, &sweep, &err) != WT_OK)
            fail_msg("case %zu: %s", i, err.message);
        for (size_t k = 0; k < sweep.n_isotherms; k++)
            n += sweep.isotherms[k].n;
        if (n != cases[i].points || !warned(log, cases[i].words))
            fail_msg("case %zu: %zu points read, not %zu, or without \"%s\"", i, n, cases[i].points,
                     cases[i].words != NULL ? cases[i].words : "no warning");
        wt_sweep_clear(&sweep);
        wt_input_close(input);
        wt_log_free(log);
    }
}

static int setup(void **state)
{
    (void)state;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK ? 0 : -1;
}

static int teardown(void **state)
{
    (void)state;
    wt_formats_free(formats);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(truncated_texts)};
    return cmocka_run_group_tests(tests, setup, teardown);
}
