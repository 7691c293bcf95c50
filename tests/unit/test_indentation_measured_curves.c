/* Moduli of measured curves of the shared reference data, if they exist, with tilt, adhesion and
 * lack of fit. They are compared with those of another program without these effects. The tips are
 * those of its settings, not those of the probes: the numbers compare programs.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "weartrack/indentation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define REFERENCE WT_SHARED_DIR "/reference/"
#define DATA WT_SHARED_DIR "/data/afm/"

enum { MOST = 200 };

typedef struct reference {
    const char *name, *model, *tip; /* model NULL: a file of one */
    size_t least;                   /* curves with a modulus in both programs */
    double median, within;          /* of our moduli over theirs, by its logarithm */
} reference;

static wt_formats *formats;
static wt_indent_workspace *workspace;

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Curve n of a file; NaN without a modulus. */
static double modulus_of(const wt_contact_table *table, const char *file, size_t number)
{
    char path[512];
    double modulus = (double)NAN;
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    const wt_read_options options = wt_read_defaults();
    wt_error err = WT_ERROR_INIT;
    snprintf(path, sizeof path, "%s%s", DATA, file);
    assert_int_equal(wt_input_open(path, &input, &err), WT_OK);
    if (wt_force_open(formats, input, &options, NULL, &source, &err) != WT_OK)
        fail_msg("%s: %s", file, err.message);
    while (wt_force_next(source, &curve, &err) == WT_OK) {
        wt_indent_fit fit;
        if (curve.index != number)
            continue;
        assert_int_equal(wt_indent_fit_force_curve(table, NULL, &curve, workspace, &fit, &err),
                         WT_OK);
        if (wt_curve_verdict_is_usable(fit.verdict))
            modulus = fit.modulus.value;
    }
    wt_force_close(source);
    wt_input_close(input);
    wt_force_curve_clear(&curve);
    return modulus;
}

static bool read_row(const reference *r, const char *line, char file[256], size_t *number,
                     double *modulus)
{
    char model[64] = "", success[16] = "";
    double weight = 1.0;
    const int n = r->model != NULL
                      ? sscanf(line, "%255[^,],%zu,%63[^,],%lf,%lf,%*[^,],%*[^,],%*[^,],%15[^,]",
                               file, number, model, &weight, modulus, success)
                      : sscanf(line, "%255[^,],%zu,%lf,%lf,%*[^,],%*[^,],%*[^,],%15[^,]", file,
                               number, &weight, modulus, success);
    /* no stated spring constant */
    return n == (r->model != NULL ? 6 : 5) && strncmp(file, "jpk/", 4) == 0 &&
           strstr(file, "cl_calibration") == NULL && !(weight > 0.0) &&
           strcmp(success, "True") == 0 && (r->model == NULL || strcmp(model, r->model) == 0);
}

static void compare(const reference *r)
{
    char path[512], line[1024], file[256];
    double ratio[MOST], modulus;
    size_t n = 0, n_rows = 0, number;
    wt_tip tip = {0};
    wt_contact_table *table = NULL;
    snprintf(path, sizeof path, "%s%s", REFERENCE, r->name);
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    assert_int_equal(wt_tip_parse(r->tip, &tip, NULL), WT_OK);
    assert_int_equal(wt_contact_table_new(&tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    while (fgets(line, sizeof line, in) != NULL) {
        if (!read_row(r, line, file, &number, &modulus))
            continue;
        assert_true(n_rows++ < MOST);
        ratio[n] = log(modulus_of(table, file, number) / modulus);
        if (!isnan(ratio[n]))
            n++;
    }
    fclose(in);
    wt_contact_table_free(table);
    assert_true(n >= r->least);
    qsort(ratio, n, sizeof ratio[0], ascending);
    print_message("%s: %zu of %zu curves, quartiles of the ratio %.3f %.3f %.3f\n", r->tip, n,
                  n_rows, exp(ratio[n / 4]), exp(ratio[n / 2]), exp(ratio[3 * n / 4]));
    assert_true(fabs(ratio[n / 2] - log(r->median)) < r->within);
}

static void medians(void **state)
{
    (void)state;
    /* Earlier results, with a tolerance for one curve and for the rounding of another processor. */
    static const reference all[] = {
        {.name = "nanite-fits.csv",
         .model = "hertz_para",
         .tip = "paraboloid:radius=10um",
         .least = 32,
         .median = 1.019,
         .within = 0.02},
        {.name = "nanite-fits.csv",
         .model = "hertz_cone",
         .tip = "cone:half-angle=25deg",
         .least = 30,
         .median = 1.026,
         .within = 0.02},
        {.name = "blunted-pyramid-fits.csv",
         .tip = "pyramid:half-angle=20deg,radius=20nm",
         .least = 29,
         .median = 1.023,
         .within = 0.02},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s%s", REFERENCE, all[i].name);
        if (access(path, R_OK) != 0 || access(DATA, R_OK) != 0)
            skip();
        compare(&all[i]);
    }
}

static int set_up(void **state)
{
    (void)state;
    workspace = wt_indent_workspace_new();
    return workspace == NULL || wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK;
}

static int tear_down(void **state)
{
    (void)state;
    wt_formats_free(formats);
    wt_indent_workspace_free(workspace);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(medians)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
