/* A fractional Zener law through points: recovered where it holds, and distinguished from a series
 * where it does not. */
#include "assert_near.h"

#include "dma_data.h"
#include "weartrack/dma.h"

#include <complex.h>
#include <stdlib.h>

enum { POINTS = 120 };

typedef struct points {
    double x[POINTS], storage[POINTS], loss[POINTS];
    bool left_out[POINTS];
    wt_master master;
} points;

static double complex law(double e0, double eg, double tau, double alpha, double w)
{
    const double complex z = cpow(w * tau * (double complex)I, alpha);
    return (e0 + eg * z) / (1 + z);
}

/* `second`: strength of another process. */
static void measure(points *p, double noise, double second)
{
    uint64_t state = 7;
    for (int i = 0; i < POINTS; i++) {
        p->x[i] = -4 + 12.0 * i / (POINTS - 1);
        const double w = pow(10, p->x[i]);
        const double complex e = law(3e6, 2e9, 1e-5, 0.55, w) + second * (law(0, 1, 1e2, 0.8, w));
        p->storage[i] = log10(creal(e)) + noise / log(10) * dma_normal(&state);
        p->loss[i] = log10(cimag(e)) + noise / log(10) * dma_normal(&state);
        p->left_out[i] = i == 50;
    }
    p->storage[50] += 3; /* an outlier */
    p->master = (wt_master){.n = POINTS,
                            .log_frequency = p->x,
                            .log_storage = p->storage,
                            .log_loss = p->loss,
                            .is_outlier = p->left_out};
}

/* Deviation of a series and its criterion, by the textbook. */
static double criterion(const points *p, const wt_prony *s, double rms[2])
{
    double sum[2] = {0, 0};
    for (int i = 0; i < POINTS; i++) {
        double complex e = s->equilibrium_modulus;
        if (p->left_out[i])
            continue;
        for (size_t k = 0; k < s->n; k++) {
            const double complex z = pow(10, p->x[i]) * s->relaxation_time[k] * (double complex)I;
            e += s->modulus[k] * z / (1 + z);
        }
        sum[0] += pow(log(creal(e)) - p->storage[i] * log(10), 2);
        sum[1] += pow(log(cimag(e)) - p->loss[i] * log(10), 2);
    }
    const double n = 2.0 * (POINTS - 1), k = 2 * (double)s->n + 2;
    for (int q = 0; q < 2; q++)
        rms[q] = sqrt(sum[q] / (n / 2));
    return n * log((sum[0] + sum[1]) / n) + 2 * k + 2 * k * (k + 1) / (n - k - 1);
}

static wt_prony series(double decades, double *tau, double *modulus, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        tau[i] = pow(10, -8 + decades * (double)i / (double)(n - 1));
        modulus[i] = 1e8 * pow(10, -0.3 * (double)i);
    }
    return (wt_prony){
        .equilibrium_modulus = 3e6, .n = n, .relaxation_time = tau, .modulus = modulus};
}

static void law_is_recovered(void **state)
{
    (void)state;
    points p;
    double tau[12], modulus[12], rms[2];
    const wt_prony s = series(12, tau, modulus, 12);
    wt_zener_fit z;
    measure(&p, 0, 0);
    assert_int_equal(wt_master_zener(&p.master, &s, &z, NULL), WT_OK);
    assert_near(z.e0, 3e6, 1e-6);
    assert_near(z.eg, 2e9, 1e-6);
    assert_near(z.tau, 1e-5, 1e-6);
    assert_near(z.alpha, 0.55, 1e-6);
    assert_true(z.determined);
    measure(&p, 0.01, 0);
    assert_int_equal(wt_master_zener(&p.master, &s, &z, NULL), WT_OK);
    assert_near(z.eg, 2e9, 0.02);
    assert_near(z.alpha, 0.55, 0.01);
    assert_near(z.rms_storage, 0.01, 0.2);
    assert_near(z.rms_loss, 0.01, 0.2);
    const double n = 2.0 * (POINTS - 1),
                 squares = n / 2 * (pow(z.rms_storage, 2) + pow(z.rms_loss, 2));
    assert_near(z.aicc, n * log(squares / n) + 10 + 60 / (n - 6), 1e-9);
    assert_near(z.series_aicc, criterion(&p, &s, rms), 1e-9);
    assert_near(z.series_rms_storage, rms[0], 1e-9);
    assert_near(z.series_rms_loss, rms[1], 1e-9);
    assert_true(z.aicc < z.series_aicc);
}

/* Two processes are not a Zener law; the deviation is not noise. */
static void two_processes(void **state)
{
    (void)state;
    points p;
    double tau[12], modulus[12];
    const wt_prony s = series(12, tau, modulus, 12);
    wt_zener_fit z;
    measure(&p, 0.01, 4e7);
    assert_int_equal(wt_master_zener(&p.master, &s, &z, NULL), WT_OK);
    assert_true(z.rms_storage > 0.1);
    measure(&p, 0.01, 0); /* the slow end alone */
    p.master.n = 30;
    assert_int_equal(wt_master_zener(&p.master, &s, &z, NULL), WT_OK);
    assert_false(z.determined);
    p.master.n = 3;
    assert_int_equal(wt_master_zener(&p.master, &s, &z, NULL), WT_E_EMPTY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(law_is_recovered),
        cmocka_unit_test(two_processes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
