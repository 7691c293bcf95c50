/* Strain sweeps: values at a known law, limits that are not reached, the numbers of the reference
 * table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/dma.h"

#include "dma_data.h"

#include <math.h>
#include <unistd.h>

#define SCANS WT_SHARED_DIR "/data/dma-scans/"

enum { MOST = 64 };

/* True law, independent of the library: decades of strain about the half of the fall. */
typedef struct filled {
    double soft, fall, half, exponent, dissipated, rest; /* MPa; half in percent */
} filled;

static const filled rubbers[] = {{2.5, 3, 0.5, 0.6, 0.9, 0.2},
                                 {1.5, 6, 2, 0.5, 1.4, 0.15},
                                 {4, 2, 0.3, 0.75, 0.6, 0.4},
                                 {1, 1.5, 5, 0.65, 0.35, 0.1}};

static double storage_of(const filled *r, double percent)
{
    return r->soft + r->fall / (1 + exp(2 * r->exponent * log(percent / r->half)));
}

static double loss_of(const filled *r, double percent)
{
    const double z = exp(r->exponent * log(percent / r->half));
    return r->rest + (r->dissipated - r->rest) * (2 * z / (1 + z * z));
}

/* `decades` of strain about the half of the fall. */
static wt_payne measured(const filled *r, size_t n, double low, double high, double noise,
                         uint64_t *state)
{
    double strain[MOST], storage[MOST], loss[MOST];
    wt_payne payne;
    for (size_t i = 0; i < n; i++) {
        const double decade = low + (high - low) * (double)i / (double)(n - 1);
        const double percent = r->half * pow(10, decade);
        strain[i] = percent / 100;
        storage[i] =
            1e6 * (storage_of(r, percent) + noise * (r->soft + r->fall) * dma_normal(state));
        loss[i] = 1e6 * (loss_of(r, percent) + noise * r->dissipated * dma_normal(state));
    }
    assert_int_equal(wt_payne_measure(strain, storage, loss, n, &payne, NULL), WT_OK);
    wt_payne alone; /* E' gives the same result without E'' */
    assert_int_equal(wt_payne_measure(strain, storage, NULL, n, &alone, NULL), WT_OK);
    assert_true(alone.storage_start == payne.storage_start &&
                alone.storage_end == payne.storage_end);
    assert_true(isnan(alone.loss_start) && isnan(alone.loss_max));
    assert_non_null(strstr(alone.loss_note, "no loss modulus"));
    return payne;
}

static void test_unreached_limits(void **state)
{
    uint64_t seed = 7;
    (void)state;
    /* ends a decade before half of the fall */
    wt_payne p = measured(&rubbers[0], 20, -3, -0.7, 0.001, &seed);
    assert_true(isnan(p.strain_half));
    assert_non_null(strstr(p.loss_note, "largest at the largest"));
    assert_true(isnan(p.strain_loss_max));
    /* nothing falls */
    p = measured(&(filled){5, 0, 1, 0.6, 0.5, 0.5}, 20, -2, 1, 0.01, &seed);
    assert_true(isnan(p.strain_tenth));
}

static void test_known_law(void **state)
{
    uint64_t seed = 5;
    (void)state;
    const wt_payne p = measured(&rubbers[1], 60, -3, 2, 1e-6, &seed);
    assert_near(p.storage_start, 7.5e6, 1e-2);
    assert_near(p.storage_end, 1.5e6, 0.1);
    assert_near(p.loss_max, 1.4e6, 1e-3);
    assert_near(p.strain_loss_max, 0.02, 0.1);
    assert_string_equal(p.loss_note, "");
    /* half of 7.5: 1.5 + 6 / (1 + z^2) = 3.75 */
    assert_near(p.strain_half, 0.02 * (6 / 2.25 - 1), 1e-2);
}

/* ---- measured -------------------------------------------------------------------------------- */

static wt_sweep read_sweep(const char *path)
{
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    wt_sweep sweep = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    if (wt_input_open(path, &input, &err) != WT_OK ||
        wt_sweep_read(formats, input, NULL, NULL, &sweep, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_input_close(input);
    wt_formats_free(formats);
    return sweep;
}

/* Numbers of data/dma-scans/payne.csv; the sweeps end in the fall. */
static void check_epdm(const char *name)
{
    char path[256], line[512], file[64];
    double f, t, low, high, start, end, fall, tenth, loss, loss_at, factor;
    int n;
    bool found = false;
    FILE *table = fopen(SCANS "payne.csv", "r");
    assert_non_null(table);
    while (!found && fgets(line, sizeof line, table) != NULL)
        found =
            sscanf(line, "%63[^,],%d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", file, &n, &f, &t,
                   &low, &high, &start, &end, &fall, &tenth, &loss, &loss_at, &factor) == 13 &&
            strcmp(file, name) == 0;
    (void)fclose(table);
    assert_true(found);
    (void)snprintf(path, sizeof path, SCANS "%s.csv", name);
    wt_sweep sweep = read_sweep(path);
    assert_int_equal(sweep.n_strain_sweeps, 1);
    const wt_strain_sweep *s = &sweep.strain_sweeps[0];
    wt_payne p;
    assert_int_equal(s->n, n);
    assert_near(s->angular_frequency, 2 * M_PI * f, 1e-12);
    assert_near(s->temperature - 273.15, t, 1e-5);
    assert_near(100 * s->strain[0], low, 1e-5);
    assert_near(100 * s->strain[n - 1], high, 1e-5);
    assert_int_equal(
        wt_payne_measure(s->strain, s->storage_modulus, s->loss_modulus, s->n, &p, NULL), WT_OK);
    assert_near(p.storage_start, start, 1e-8);
    assert_near(p.storage_end, end, 1e-8);
    assert_near(p.storage_start - p.storage_end, fall, 1e-8);
    assert_near(100 * p.strain_tenth, tenth, 1e-8);
    assert_near(p.loss_max, loss, 1e-8);
    double largest = 0;
    for (size_t i = 0; i < s->n; i++) {
        largest = fmax(largest, s->loss_modulus[i] / s->storage_modulus[i]);
        if (s->loss_modulus[i] == p.loss_max)
            assert_near(100 * s->strain[i], loss_at, 1e-5);
    }
    assert_near(largest, factor, 1e-8);
    assert_true(isnan(p.strain_half));
    assert_true(isnan(p.strain_loss_max)); /* one of the outer two points */
    assert_non_null(strstr(p.loss_note, "no maximum in range"));
    wt_sweep_clear(&sweep);
}

static void test_reference_values(void **state)
{
    (void)state;
    if (access(SCANS "payne.csv", R_OK) != 0)
        skip();
    check_epdm("epdm_70_sd_10hz");
    check_epdm("epdm_70_sd_100hz");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unreached_limits),
        cmocka_unit_test(test_known_law),
        cmocka_unit_test(test_reference_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
