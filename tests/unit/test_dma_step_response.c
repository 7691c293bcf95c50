/* Relaxation and creep of a series of Maxwell elements, against closed forms and the convolution of
 * both. Isotherms of both are drawn from laws without a series and compared with the truth. Start
 * of freed vertical shifts. SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "dma/numerics/spectrum.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- of a given series ----------------------------------------------------------------------- */

static spectrum make_spectrum(wt_loading loading, size_t n_terms, double fastest, double step)
{
    spectrum s = {.loading = loading,
                  .n_terms = n_terms,
                  .n_linear = n_terms + 1,
                  .log_tau = log(fastest),
                  .step = step};
    if (loading == WT_CREEP)
        spectrum_modes_new(&s);
    return s;
}

static double value_at(const spectrum *s, const double *term, double t)
{
    double value, slope;
    spectrum_step_response(s, term, -log(t), &value, &slope, NULL);
    return s->loading == WT_CREEP ? exp(-value) : exp(value);
}

/* Zener solid: one time for each function. */
static void one_element_is_the_standard_solid(void **state)
{
    (void)state;
    const double term[] = {7e6, 2e6}, tau = 0.03;
    spectrum relaxes = make_spectrum(WT_RELAXATION, 1, tau, 1.0);
    spectrum creeps = make_spectrum(WT_CREEP, 1, tau, 1.0);
    for (double t = 1e-5; t < 1e3; t *= 3.7) {
        const double retardation = tau * (term[0] + term[1]) / term[1];
        assert_near(value_at(&relaxes, term, t), term[1] + term[0] * exp(-t / tau), 1e-14);
        assert_near(value_at(&creeps, term, t),
                    1 / term[1] - (1 / term[1] - 1 / (term[0] + term[1])) * exp(-t / retardation),
                    1e-13);
    }
    spectrum_free(&relaxes);
    spectrum_free(&creeps);
}

enum { TERMS = 40 };

/* Increasing and decreasing, over nine decades, some of them zero. */
static void fill_terms(double term[TERMS + 1])
{
    for (int j = 0; j < TERMS; j++)
        term[j] = 3e8 * exp(-0.5 * j) * (1.0 + 0.9 * sin(2.3 * j)) + 1e4;
    term[7] = 1e-9;
    term[20] = 1e-200;
    term[21] = 3e2;
    term[TERMS] = 1.1e6;
}

/* The integral of E(t - s) J(s) from 0 to t is t. For sums of exponentials it has a closed form;
 * here it is a Gauss rule in subintervals that follow both functions. */
static void compliance_and_modulus_are_a_pair(void **state)
{
    (void)state;
    static const double x[] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                               0.9061798459386640};
    static const double w[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                               0.4786286704993665, 0.2369268850561891};
    double term[TERMS + 1];
    fill_terms(term);
    spectrum relaxes = make_spectrum(WT_RELAXATION, TERMS, 1e-7, 0.7);
    spectrum creeps = make_spectrum(WT_CREEP, TERMS, 1e-7, 0.7);
    for (double t = 1e-6; t < 1e4; t *= 47.0) {
        double sum = 0.0;
        /* from both limits, because J is fast at 0 and E(t - s) at t */
        for (int end = 0; end < 2; end++)
            for (double high = 0.5 * t; high > 1e-13 * t; high *= 0.8)
                for (int i = 0; i < 5; i++) {
                    const double s = high * (0.9 + 0.1 * x[i]);
                    const double of_j = end == 0 ? s : t - s;
                    sum += 0.1 * high * w[i] * value_at(&creeps, term, of_j) *
                           value_at(&relaxes, term, t - of_j);
                }
        assert_near(sum, t, 1e-9);
    }
    spectrum_free(&relaxes);
    spectrum_free(&creeps);
}

static void derivatives_are_those_of_the_values(void **state)
{
    (void)state;
    double term[TERMS + 1], moved[TERMS + 1], gradient[TERMS + 1];
    fill_terms(term);
    for (wt_loading loading = WT_RELAXATION; loading <= WT_CREEP; loading++) {
        spectrum s = make_spectrum(loading, TERMS, 1e-7, 0.7);
        for (double x = -9.0; x < 18.0; x += 1.7) {
            double value, slope, above, below, unused, sum = 0.0;
            spectrum_step_response(&s, term, x + 1e-5, &above, &unused, NULL);
            spectrum_step_response(&s, term, x - 1e-5, &below, &unused, NULL);
            spectrum_step_response(&s, term, x, &value, &slope, gradient);
            assert_near_abs(slope, (above - below) / 2e-5, 1e-8);
            for (size_t j = 0; j <= TERMS; j++) {
                const double h = 1e-5;
                sum += gradient[j];
                memcpy(moved, term, sizeof moved);
                moved[j] = term[j] * exp(h);
                spectrum_step_response(&s, moved, x, &above, &unused, NULL);
                moved[j] = term[j] * exp(-h);
                spectrum_step_response(&s, moved, x, &below, &unused, NULL);
                assert_near_abs(gradient[j], (above - below) / (2.0 * h), 1e-8);
            }
            assert_near(sum, 1.0, 1e-9); /* twice the moduli is half the compliance */
        }
        spectrum_free(&s);
    }
}

/* ---- isotherms ------------------------------------------------------------------------------- */

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*state >> 11) + 0.5) * 0x1p-53;
}

static double normal(uint64_t *state)
{
    const double radius = sqrt(-2.0 * log(uniform(state)));
    return radius * cos(2.0 * M_PI * uniform(state));
}

enum { ISOTHERMS = 9, POINTS = 19 };
static const double c1 = 6.0, c2 = 110.0, t0 = 293.15;
static const double end = 2e6, glass = 4e8, place = 3e-6, power = 0.45;

/* Power laws of time, whose spectrum is a gamma distribution and no series. */
static double true_relaxation(double t)
{
    return end + (glass - end) * pow(1.0 + t / place, -power);
}

static double true_creep(double t)
{
    return 1.0 / glass + (1.0 / end - 1.0 / glass) * (1.0 - pow(1.0 + t / 1e-3, -power));
}

static double true_log_a(double temperature)
{
    return -c1 * (temperature - t0) / (c2 + temperature - t0);
}

static void draw_sweep(wt_loading loading, uint64_t seed, wt_sweep *sweep)
{
    uint64_t state = seed * 0x9e3779b97f4a7c15u + 1;
    for (int i = 0; i < 8; i++)
        (void)uniform(&state);
    *sweep = (wt_sweep){.deformation = WT_TENSION, .loading = loading};
    for (int i = 0; i < ISOTHERMS; i++) {
        wt_isotherm *t = wt_sweep_add(sweep, POINTS, 0);
        assert_non_null(t);
        t->temperature = 253.15 + 7.0 * i;
        const double at = t->temperature + 0.1 * normal(&state);
        const double b = t->temperature / t0 * exp(0.006 * normal(&state));
        for (int k = 0; k < POINTS; k++) {
            const double time = pow(10.0, k / 6.0), reduced = time / pow(10.0, true_log_a(at));
            const double noise = exp(0.005 * normal(&state));
            const double value =
                loading == WT_CREEP ? 1.0 / true_creep(reduced) : true_relaxation(reduced);
            t->angular_frequency[k] = 1.0 / time;
            t->storage_modulus[k] = value * b * noise;
            t->loss_modulus[k] = (double)NAN;
        }
    }
    wt_sweep_sort(sweep);
}

static bool holds(wt_interval x, double truth)
{
    return x.low <= truth && truth <= x.high;
}

typedef struct held {
    size_t shifts, of_shifts, law, fitted, of_fitted, n;
} held;

static void take_one(wt_loading loading, uint64_t seed, held *h)
{
    wt_sweep sweep;
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    wt_master_options options = wt_master_options_defaults();
    options.reference_temperature = t0 - 5.0; /* 288.15, which is measured */
    draw_sweep(loading, seed, &sweep);
    if (wt_master_fit(&sweep, &options, NULL, &m, &err) != WT_OK)
        fail_msg("%s", err.message);
    assert_int_equal(m.loading, loading);
    for (size_t i = 0; i < m.n_shifts; i++) {
        const wt_master_shift *s = &m.shifts[i];
        if (!s->determined || !(s->log_a.standard_error > 0))
            continue;
        h->of_shifts++;
        h->shifts += holds(s->law, true_log_a(s->temperature) - true_log_a(288.15));
    }
    h->n++;
    h->law += holds(m.c1, c1 * c2 / (c2 - 5.0));
    for (size_t i = 0; i < m.n; i += 13) {
        const double time = pow(10.0, -m.log_frequency[i] - true_log_a(288.15));
        const double truth =
            loading == WT_CREEP ? -log10(true_creep(time)) : log10(true_relaxation(time));
        assert_true(isnan(m.log_storage[i]));
        h->of_fitted++;
        h->fitted += holds(m.fitted_step[i], truth + log10(288.15 / t0));
    }
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
}

static void intervals_hold_the_truth(void **state)
{
    (void)state;
    for (wt_loading loading = WT_RELAXATION; loading <= WT_CREEP; loading++) {
        const char *draws = getenv("STEP_DRAWS");
        held h = {0};
        for (uint64_t seed = 1; seed <= (draws != NULL ? strtoul(draws, NULL, 10) : 10); seed++)
            take_one(loading, seed, &h);
        if (draws != NULL)
            print_message("%d: law %zu of %zu, C1 %zu of %zu, moduli %zu of %zu\n", (int)loading,
                          h.shifts, h.of_shifts, h.law, h.n, h.fitted, h.of_fitted);
        assert_true((double)h.shifts > 0.85 * (double)h.of_shifts);
        assert_true((double)h.fitted > 0.85 * (double)h.of_fitted);
        assert_true((double)h.law >= 0.85 * (double)h.n);
        assert_true(h.of_shifts >= 4 * h.n);
    }
}

/* ---- impossible input ------------------------------------------------------------------------ */

static void steps_have_their_limits(void **state)
{
    (void)state;
    wt_sweep sweep;
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    wt_master_options options = wt_master_options_defaults();
    draw_sweep(WT_CREEP, 1, &sweep);
    options.liquid = true;
    wt_log *log = wt_log_new(); /* a liquid is fitted as a solid, with a warning */
    bool said = false;
    assert_int_equal(wt_master_fit(&sweep, &options, log, &m, &err), WT_OK);
    for (size_t i = 0; i < wt_log_count(log); i++)
        said = said || strstr(wt_log_get(log, i).text, "creep of a liquid") != NULL;
    assert_true(said && m.equilibrium.value > 0);
    wt_master_clear(&m);
    wt_log_free(log);
    options.liquid = false;
    options.shift_by = WT_SHIFT_LOSS;
    assert_int_equal(wt_master_fit(&sweep, &options, NULL, &m, &err), WT_E_MISSING);
    wt_sweep_clear(&sweep);
}

/* The test of superposition frees vertical shifts that were none: they start where they were. */
static void freed_vertical_shifts_start_where_they_were(void **state)
{
    enum { CURVES = 3 };
    double mean[CURVES] = {0};
    const double temperature[CURVES] = {273.15, 293.15, 313.15};
    const spectrum s = {.n_curves = CURVES, .level_curve = 1};
    arena memory = {0};
    vertical v = {.reference_temperature = 293.15, .geometry = 0.01, .mean = mean};
    spectrum_prior prior;
    (void)state;
    vertical_alloc(&memory, CURVES, &v);
    for (int i = 0; i < 2; i++) {
        const wt_vertical_shift kind = i == 0 ? WT_VERTICAL_NONE : WT_VERTICAL_FREE;
        assert_int_equal(vertical_prior(&v, kind, temperature, &s, &prior, NULL), WT_OK);
        for (int k = 0; k < CURVES; k++)
            assert_true(prior.mean[k] == 0.0);
    }
    assert_int_equal(vertical_prior(&v, WT_VERTICAL_TIED, temperature, &s, &prior, NULL), WT_OK);
    assert_true(prior.mean[2] < 0.0);
    arena_free(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_element_is_the_standard_solid),
        cmocka_unit_test(compliance_and_modulus_are_a_pair),
        cmocka_unit_test(derivatives_are_those_of_the_values),
        cmocka_unit_test(intervals_hold_the_truth),
        cmocka_unit_test(steps_have_their_limits),
        cmocka_unit_test(freed_vertical_shifts_start_where_they_were),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
