/* Strain sweeps: coverage of the intervals of the law of Kraus, limits that are not reached, the
 * numbers of the reference table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "draw_count.h"
#include "weartrack/dma.h"

#include "dma_data.h"

#include <math.h>
#include <unistd.h>

#define SCANS WT_SHARED_DIR "/data/dma-scans/"

enum { DRAWS = DRAW_COUNT(200), MOST = 64 };

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
    assert_int_equal(wt_payne_fit(strain, storage, loss, n, &payne, NULL), WT_OK);
    wt_payne alone; /* E' gives the same result without E'' */
    assert_int_equal(wt_payne_fit(strain, storage, NULL, n, &alone, NULL), WT_OK);
    assert_memory_equal(&alone.storage_0, &payne.storage_0, sizeof alone.storage_0);
    assert_memory_equal(&alone.exponent, &payne.exponent, sizeof alone.exponent);
    assert_true(isnan(alone.loss_max) && isnan(alone.loss_m.value));
    return payne;
}

/* A limit that the points do not bound is open. */
static bool holds(const wt_interval *i, double truth)
{
    return !(truth < i->low) && !(truth > i->high);
}

static void test_intervals_hold_the_truth(void **state)
{
    static const char *const names[] = {"storage_0", "storage_inf", "strain_c",
                                        "exponent",  "loss_m",      "loss_inf"};
    size_t held[6] = {0}, closed[6] = {0}, fitted = 0, noted = 0;
    uint64_t seed = 20261122;
    (void)state;
    for (size_t draw = 0; draw < DRAWS; draw++) {
        static const double noises[] = {0.002, 0.005, 0.01};
        const filled *r = &rubbers[draw % 4];
        const size_t n = 12 + draw / 4 % 3 * 8;
        const wt_payne p =
            measured(r, n, -2 + 0.1 * (double)(draw % 5), 1.2, noises[draw % 3], &seed);
        const double truth[] = {
            1e6 * (r->soft + r->fall), 1e6 * r->soft, r->half / 100, r->exponent,
            1e6 * r->dissipated,       1e6 * r->rest};
        const wt_interval of[] = {p.storage_0, p.storage_inf, p.strain_c,
                                  p.exponent,  p.loss_m,      p.loss_inf};
        fitted += p.fitted ? 1 : 0;
        noted += p.note[0] != '\0' ? 1 : 0;
        for (size_t k = 0; k < 6; k++) {
            held[k] += holds(&of[k], truth[k]) ? 1 : 0;
            closed[k] += !isnan(of[k].low) && !isnan(of[k].high) && of[k].standard_error > 0;
        }
    }
    for (size_t k = 0; k < 6; k++)
        print_message("%s: %zu of %d hold the truth, %zu closed\n", names[k], held[k], DRAWS,
                      closed[k]);
    print_message("fitted %zu, with a note %zu\n", fitted, noted);
    if (!TEST_RATES)
        return;
    for (size_t k = 0; k < 6; k++) {
        assert_in_range(held[k], DRAWS * 92 / 100, DRAWS * 98 / 100);
        assert_true(closed[k] > DRAWS * 8 / 10);
    }
}

static void test_unreached_limits_are_open(void **state)
{
    uint64_t seed = 7;
    (void)state;
    /* ends a decade before half of the fall */
    wt_payne p = measured(&rubbers[0], 20, -3, -0.7, 0.001, &seed);
    assert_true(p.fitted);
    assert_true(isnan(p.strain_c.value) && isnan(p.storage_inf.value) && isnan(p.strain_half));
    assert_non_null(strstr(p.note, "half of the fall is not reached"));
    assert_non_null(strstr(p.loss_note, "largest at the largest"));
    assert_true(isnan(p.strain_loss_max));
    assert_true(p.storage_0.low < 5.5e6 && p.storage_0.high > 5.5e6);
    /* nothing falls */
    p = measured(&(filled){5, 0, 1, 0.6, 0.5, 0.5}, 20, -2, 1, 0.01, &seed);
    assert_false(p.fitted);
    assert_non_null(strstr(p.note, "does not fall"));
    assert_true(isnan(p.storage_0.value) && isnan(p.strain_tenth));
    /* few points */
    p = measured(&rubbers[0], 6, -2, 1, 0.01, &seed);
    assert_non_null(strstr(p.note, "too few points"));
    assert_true(p.strain_tenth > 0);
}

static void test_law_values(void **state)
{
    uint64_t seed = 5;
    (void)state;
    const wt_payne p = measured(&rubbers[1], 60, -3, 2, 1e-6, &seed);
    const wt_kraus *law = &p.law;
    assert_near(law->storage_0, 7.5e6, 1e-4);
    assert_near(law->storage_inf, 1.5e6, 1e-4);
    assert_near(law->strain_c, 0.02, 1e-4);
    assert_near(law->exponent, 0.5, 1e-4);
    assert_near(law->loss_m, 1.4e6, 1e-4);
    assert_near(law->loss_inf, 0.15e6, 1e-4);
    assert_near(wt_kraus_storage(law, 0.02), 4.5e6, 1e-4);
    assert_near(wt_kraus_loss(law, 0.02), 1.4e6, 1e-4);
    assert_near(p.strain_loss_max, 0.02, 0.1);
    assert_string_equal(p.note, "");
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
    assert_int_equal(wt_payne_fit(s->strain, s->storage_modulus, s->loss_modulus, s->n, &p, NULL),
                     WT_OK);
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
    print_message("%s: G0 %.4g (%.4g to %.4g), Ginf %.4g (%.4g to %.4g), strain_c %.4g (%.4g to "
                  "%.4g), exponent %.3g (%.3g to %.3g), misfit %.3g, loss %.3g; %s; %s\n",
                  name, p.storage_0.value, p.storage_0.low, p.storage_0.high, p.storage_inf.value,
                  p.storage_inf.low, p.storage_inf.high, p.strain_c.value, p.strain_c.low,
                  p.strain_c.high, p.exponent.value, p.exponent.low, p.exponent.high,
                  p.storage_misfit, p.loss_misfit, p.note, p.loss_note);
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
        cmocka_unit_test(test_intervals_hold_the_truth),
        cmocka_unit_test(test_unreached_limits_are_open),
        cmocka_unit_test(test_law_values),
        cmocka_unit_test(test_reference_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
