/* Text exports of real instruments, compared value by value with tables of other programs. Shared
 * reference data, if they exist.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "weartrack/read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DMA WT_SHARED_DIR "/data/dma/"

static wt_formats *formats;

static void show(const wt_error *err)
{
    char text[1024];
    wt_error_format(err, text, sizeof text);
    print_message("%s\n", text);
}

/* Skips the test if the file does not exist. */
static wt_input *open_measured(const char *path)
{
    wt_input *input = NULL;
    wt_error err = WT_ERROR_INIT;
    FILE *there = fopen(path, "rb");
    if (there == NULL)
        skip();
    fclose(there);
    if (wt_input_open(path, &input, &err) != WT_OK)
        show(&err);
    assert_non_null(input);
    return input;
}

static void check_id(wt_input *input, unsigned kind, const char *id)
{
    const wt_format_info *info = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_format_detect(formats, input, NULL, kind, &info, &err) != WT_OK)
        show(&err);
    assert_non_null(info);
    assert_string_equal(info->id, id);
}

static void add_sweep(const char *path, const char *id, wt_sweep *sweep)
{
    wt_input *input = open_measured(path);
    wt_error err = WT_ERROR_INIT;
    check_id(input, 0, id);
    check_id(input, WT_KIND_SWEEP, id);
    wt_status status = wt_sweep_read(formats, input, NULL, NULL, sweep, &err);
    if (status != WT_OK)
        show(&err);
    assert_int_equal(status, WT_OK);
    wt_input_close(input);
}

/* ---- tidy tables: T_C, f_Hz, omega_rad_s, M_storage_Pa, M_loss_Pa ------------------------- */

typedef struct point {
    double celsius, hertz, omega, storage, loss;
} point;

static size_t read_tidy(const char *path, point *points, size_t most)
{
    char line[256];
    size_t n = 0;
    FILE *in = fopen(path, "r");
    if (in == NULL)
        skip();
    assert_non_null(fgets(line, sizeof line, in));
    while (n < most && fgets(line, sizeof line, in) != NULL) {
        point *p = &points[n];
        if (sscanf(line, "%lf,%lf,%lf,%lf,%lf", &p->celsius, &p->hertz, &p->omega, &p->storage,
                   &p->loss) == 5)
            n++;
    }
    fclose(in);
    return n;
}

#define POINTS_MAX 4000
static point points[POINTS_MAX];

/* Every point of the table is once in the sweep: the same frequency and modulus within the digits
 * of the table, at a temperature within `kelvin`. Returns the number of points of the sweep. */
static size_t compare(const wt_sweep *sweep, const char *tidy, double kelvin)
{
    size_t n = read_tidy(tidy, points, POINTS_MAX), total = 0;
    assert_true(n > 10);
    for (size_t i = 0; i < n; i++) {
        size_t hits = 0;
        for (size_t k = 0; k < sweep->n_isotherms; k++) {
            const wt_isotherm *s = &sweep->isotherms[k];
            if (fabs(s->temperature - 273.15 - points[i].celsius) > kelvin)
                continue;
            for (size_t j = 0; j < s->n; j++)
                hits += fabs(s->angular_frequency[j] / points[i].omega - 1) < 2e-7 &&
                        fabs(s->storage_modulus[j] / points[i].storage - 1) < 2e-7 &&
                        fabs(s->loss_modulus[j] / points[i].loss - 1) < 2e-7;
        }
        if (hits != 1)
            print_message("%s point %zu (%g degC, %g Hz): found %zu times\n", tidy, i + 1,
                          points[i].celsius, points[i].hertz, hits);
        assert_int_equal(hits, 1);
    }
    for (size_t k = 0; k < sweep->n_isotherms; k++)
        total += sweep->isotherms[k].n;
    return total;
}

static void trios_lims(void **state)
{
    wt_sweep sweep = {.n_isotherms = 0};
    (void)state;
    add_sweep(DMA "trios/frequency_sweep_tts.txt", "trios-lims", &sweep);
    assert_int_equal(sweep.deformation, WT_SHEAR);
    assert_int_equal(sweep.n_isotherms, 20);
    /* The table excludes one point with a negative loss modulus; a reader returns it. */
    size_t n = compare(&sweep, DMA "tidy/hermes_ares.csv", 0.02);
    assert_int_equal(n, 340);
    assert_int_equal(sweep.isotherms[0].n, 17);
    assert_true(sweep.isotherms[0].temperature_spread < 0.1);
    assert_non_null(sweep.isotherms[0].strain);
    assert_non_null(strstr(sweep.isotherms[0].source, "-40.0"));
    wt_sweep_clear(&sweep);
}

static void trios_text(void **state)
{
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    /* An amplitude sweep, a frequency sweep and a flow ramp. */
    add_sweep(DMA "trios/multi_technique.txt", "trios-text", &sweep);
    assert_int_equal(sweep.n_isotherms, 1);
    const wt_isotherm *s = &sweep.isotherms[0];
    assert_int_equal(s->n, 29);
    assert_near(s->angular_frequency[s->n - 1], 628.318542480469, 1e-15);
    assert_near(s->storage_modulus[s->n - 1], 0.017995853515625e6, 1e-15);
    assert_near(s->loss_modulus[s->n - 1], -0.00116959899902344e6, 1e-15);
    assert_near_abs(s->temperature, 298.15, 0.05);
    assert_non_null(strstr(s->source, "Frequency sweep - 2"));
    assert_int_equal(sweep.n_strain_sweeps, 1);
    assert_int_equal(sweep.strain_sweeps[0].n, 29);
    assert_near(sweep.strain_sweeps[0].angular_frequency, 2 * M_PI, 1e-5);
    assert_non_null(strstr(sweep.strain_sweeps[0].source, "Amplitude sweep - 1"));
    wt_sweep_clear(&sweep);

    wt_input *input = open_measured(DMA "trios/creep_experiment.txt");
    check_id(input, 0, "trios-text");
    assert_int_equal(wt_sweep_read(formats, input, NULL, NULL, &sweep, &err), WT_OK);
    wt_input_close(input);
    assert_int_equal(sweep.loading, WT_CREEP);
    assert_int_equal(sweep.deformation, WT_SHEAR);
    assert_int_equal(sweep.n_isotherms, 1);
    const wt_isotherm *creep = &sweep.isotherms[0];
    assert_int_equal(creep->n, 482);
    assert_near(creep->angular_frequency[481], 1 / (9.06666682567447e-06 * 60), 1e-12);
    assert_near_abs(creep->temperature, 273.15 + 45, 0.02);
    wt_sweep_clear(&sweep);
}

static void stare(void **state)
{
    wt_sweep sweep = {.n_isotherms = 0};
    char path[512];
    (void)state;
    for (int t = 0; t <= 105; t += 5) {
        snprintf(path, sizeof path, DMA "stare/T%d.txt", t);
        add_sweep(path, "stare", &sweep);
    }
    assert_int_equal(sweep.n_isotherms, 22);
    assert_int_equal(sweep.deformation, WT_TENSION);
    /* The table has the temperature of the file name, the sweep that of the sample. */
    size_t n = compare(&sweep, DMA "tidy/stare_E.csv", 6);
    assert_int_equal(n, 22 * 60);
    wt_sweep_clear(&sweep);
}

static void reptate(void **state)
{
    static const int celsius[] = {-45, -40, -30, -20, -10, 0, 10, 25};
    wt_sweep sweep = {.n_isotherms = 0};
    char path[512];
    (void)state;
    for (size_t i = 0; i < sizeof celsius / sizeof *celsius; i++) {
        snprintf(path, sizeof path, DMA "reptate/PI88K-09_FS_%dC_PP-10.osc", celsius[i]);
        add_sweep(path, "reptate-osc", &sweep);
    }
    assert_int_equal(sweep.n_isotherms, 8);
    assert_int_equal(sweep.deformation, WT_SHEAR);
    for (size_t i = 0; i < 8; i++)
        assert_near(sweep.isotherms[i].temperature, celsius[i] + 273.15, 1e-14);
    compare(&sweep, DMA "tidy/PI_94.9k.csv", 1e-9);
    wt_sweep_clear(&sweep);
}

static void rheocompass(void **state)
{
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    (void)state;
    add_sweep(DMA "rheocompass/cnf_0-3_mc1-2_zn1-2_10c.csv", "rheocompass", &sweep);
    add_sweep(DMA "rheocompass/cnf_0-3_mc1-2_zn1-2_20c.csv", "rheocompass", &sweep);
    add_sweep(DMA "rheocompass/cnf_0-3_mc1-2_zn1-2_30c.csv", "rheocompass", &sweep);
    assert_int_equal(sweep.n_isotherms, 3);
    assert_near(sweep.isotherms[0].temperature, 283.15, 1e-15);
    const wt_isotherm *s = &sweep.isotherms[0];
    assert_near(s->angular_frequency[s->n - 1], 100, 1e-15);
    assert_near(s->storage_modulus[s->n - 1], 311.76, 1e-15);
    assert_near(s->loss_modulus[s->n - 1], 257.94, 1e-15);
    wt_sweep_clear(&sweep);
    wt_input *input = open_measured(DMA "rheocompass/HC1_stressrelaxation_20C_2.csv");
    assert_int_equal(wt_sweep_read(formats, input, NULL, NULL, &sweep, &err), WT_OK);
    wt_input_close(input);
    assert_int_equal(sweep.loading, WT_RELAXATION);
    assert_int_equal(sweep.n_isotherms, 1);
    s = &sweep.isotherms[0];
    assert_near(s->angular_frequency[s->n - 1], 100, 1e-12); /* 0,010 s */
    assert_near(s->storage_modulus[s->n - 1], 41761, 1e-15);
    wt_sweep_clear(&sweep);
}

static void tables(void **state)
{
    wt_sweep sweep = {.n_isotherms = 0};
    (void)state;
    add_sweep(DMA "eplexor/freq_user_raw.csv", "table-units", &sweep);
    assert_int_equal(sweep.n_isotherms, 21);
    assert_int_equal(sweep.deformation, WT_TENSION);
    assert_int_equal(compare(&sweep, DMA "tidy/nrel_A.csv", 0.01), 210);
    wt_sweep_clear(&sweep);

    add_sweep(DMA "csv/material_a/tf_015p.csv", "tidy", &sweep);
    assert_int_equal(sweep.deformation, WT_SHEAR);
    assert_int_equal(compare(&sweep, DMA "tidy/material_a.csv", 0.5), 154);
    assert_non_null(sweep.isotherms[0].strain);
    assert_near(sweep.isotherms[0].strain[0], 0.15306971428575405e-2, 1e-12);
    wt_sweep_clear(&sweep);
}

static int setup(void **state)
{
    wt_error err = WT_ERROR_INIT;
    (void)state;
    if (wt_formats_new(NULL, &formats, NULL, &err) != WT_OK) {
        show(&err);
        return -1;
    }
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    wt_formats_free(formats);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trios_lims), cmocka_unit_test(trios_text),  cmocka_unit_test(stare),
        cmocka_unit_test(reptate),    cmocka_unit_test(rheocompass), cmocka_unit_test(tables),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
