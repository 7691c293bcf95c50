/* Reduction of a spectrum to few terms: the requested accuracy holds for moduli computed here. The
 * spectrum is that of two Cole-Cole processes in closed form. */
#include "assert_near.h"

#include "weartrack/dma.h"

#include <stdlib.h>

enum { MOST = 80 };

typedef struct spectrum {
    double tau[MOST], modulus[MOST];
    wt_prony prony;
} spectrum;

/* Over so many decades about 1 rad/s. */
static void make(spectrum *s, double decades)
{
    const double strength[] = {1.5e9, 4e6}, centre[] = {-3, 1}, alpha[] = {0.6, 0.4};
    const size_t n = (size_t)(3 * (decades + 3));
    for (size_t i = 0; i < n; i++) {
        const double log_tau = -decades / 2 - 1.5 + (double)i / 3;
        s->tau[i] = pow(10, log_tau);
        s->modulus[i] = 0;
        for (int k = 0; k < 2; k++)
            s->modulus[i] +=
                log(10) / 3 * strength[k] * sin(alpha[k] * M_PI) / (2 * M_PI) /
                (cosh((log_tau - centre[k]) * log(10) * alpha[k]) + cos(alpha[k] * M_PI));
    }
    s->prony = (wt_prony){.deformation = WT_SHEAR,
                          .reference_temperature = 300,
                          .equilibrium_modulus = 2e6,
                          .n = n,
                          .relaxation_time = s->tau,
                          .modulus = s->modulus,
                          .frequency_min = pow(10, -decades / 2),
                          .frequency_max = pow(10, decades / 2)};
}

static void moduli(const wt_prony *p, double w, double *storage, double *loss)
{
    *storage = p->equilibrium_modulus;
    *loss = 0;
    for (size_t i = 0; i < p->n; i++) {
        const double z = w * p->relaxation_time[i];
        *storage += p->modulus[i] * (1 - 1 / (1 + z * z));
        *loss += p->modulus[i] * z / (1 + z * z);
    }
}

static double furthest(const wt_prony *from, const wt_prony *to, double off[2])
{
    off[0] = off[1] = 0;
    const double low = log10(from->frequency_min), high = log10(from->frequency_max);
    for (int i = 0; i <= 2000; i++) {
        double storage, loss, is_storage, is_loss;
        const double w = pow(10, low + (high - low) * i / 2000);
        moduli(from, w, &storage, &loss);
        moduli(to, w, &is_storage, &is_loss);
        off[0] = fmax(off[0], fabs(is_storage / storage - 1));
        off[1] = fmax(off[1], fabs(is_loss / loss - 1));
    }
    return fmax(off[0], off[1]);
}

static wt_prony reduce(const wt_prony *from, unsigned terms, double error, double long_term)
{
    wt_prony to = {0};
    const wt_reduction how = {terms, error, long_term};
    assert_int_equal(wt_prony_reduce(from, &how, &to, NULL), WT_OK);
    assert_true(to.n > 0);
    for (size_t i = 0; i < to.n; i++) {
        assert_true(to.modulus[i] > 0 && isfinite(to.modulus[i]));
        assert_true(to.relaxation_time[i] > (i > 0 ? to.relaxation_time[i - 1] : 0));
    }
    assert_int_equal(to.deformation, from->deformation);
    assert_near(to.reference_temperature, from->reference_temperature, 0);
    assert_near(to.frequency_max, from->frequency_max, 0);
    return to;
}

/* As accurate as requested, and with no term to spare. */
static void requested_accuracy_is_met(void **state)
{
    (void)state;
    const double errors[] = {0.1, 0.02, 0.005, 0.0005};
    size_t before = 0;
    for (double decades = 4; decades < 15; decades += 5)
        for (int i = 0; i < 4; i++) {
            spectrum s;
            double off[2], said[2];
            make(&s, decades);
            wt_prony few = reduce(&s.prony, 0, errors[i], (double)NAN);
            assert_true(furthest(&s.prony, &few, off) <= errors[i]);
            wt_prony_deviation(&s.prony, &few, said);
            assert_near(said[0], off[0], 0.02);
            assert_near(said[1], off[1], 0.02);
            assert_true(i == 0 || few.n > before);
            assert_true((double)few.n < 2.6 * decades + 3);
            before = few.n;
            wt_prony fewer = reduce(&s.prony, (unsigned)few.n - 1, errors[i], (double)NAN);
            assert_int_equal(fewer.n, few.n - 1);
            assert_true(furthest(&s.prony, &fewer, off) > 0.97 * errors[i]);
            wt_prony_clear(&fewer);
            wt_prony_clear(&few);
        }
}

/* Spectral lines are recovered, and no others. */
static void spectral_lines_are_recovered(void **state)
{
    (void)state;
    double tau[] = {1e-4, 1e-2, 1, 1e2, 1e4}, modulus[] = {1e6, 5e6, 2e6, 4e6, 3e6};
    const wt_prony p = {.equilibrium_modulus = 1e6,
                        .reference_temperature = 300,
                        .n = 5,
                        .relaxation_time = tau,
                        .modulus = modulus,
                        .frequency_min = 1e-5,
                        .frequency_max = 1e5};
    wt_prony few = reduce(&p, 0, 1e-3, (double)NAN);
    assert_int_equal(few.n, 5);
    for (int i = 0; i < 5; i++) {
        assert_near(few.relaxation_time[i], tau[i], 2e-3);
        assert_near(few.modulus[i], modulus[i], 2e-3);
    }
    assert_near(few.equilibrium_modulus, 1e6, 2e-3);
    wt_prony_clear(&few);
}

/* A stated long-term modulus is kept; without one a slow term replaces it. */
static void long_term(void **state)
{
    (void)state;
    spectrum s;
    double off[2];
    make(&s, 14);
    wt_prony p = reduce(&s.prony, 0, 0.02, 0);
    assert_near(p.equilibrium_modulus, 0, 0);
    assert_true(furthest(&s.prony, &p, off) <= 0.02);
    wt_prony_clear(&p);
    p = reduce(&s.prony, 0, 0.02, 1.9e6);
    assert_near(p.equilibrium_modulus, 1.9e6, 0);
    assert_true(furthest(&s.prony, &p, off) <= 0.02);
    wt_prony_clear(&p);
    /* above the modulus itself: the stated deviation shows it */
    p = reduce(&s.prony, 5, 0.02, 1e7);
    assert_near(p.equilibrium_modulus, 1e7, 0);
    assert_true(furthest(&s.prony, &p, off) > 2);
    wt_prony_clear(&p);
    s.prony.equilibrium_modulus = 0;
    p = reduce(&s.prony, 0, 0.02, (double)NAN);
    assert_near(p.equilibrium_modulus, 0, 0);
    assert_true(furthest(&s.prony, &p, off) <= 0.02);
    wt_prony_clear(&p);
}

static void refused(void **state)
{
    (void)state;
    spectrum s;
    wt_prony p = {0};
    wt_reduction how = wt_reduction_defaults();
    make(&s, 4);
    assert_int_equal(wt_prony_reduce(NULL, &how, &p, NULL), WT_E_ARG);
    how.error = 0;
    assert_int_equal(wt_prony_reduce(&s.prony, &how, &p, NULL), WT_E_RANGE);
    s.prony.frequency_min = (double)NAN;
    assert_int_equal(wt_prony_reduce(&s.prony, NULL, &p, NULL), WT_E_MISSING);
    make(&s, 4);
    for (size_t i = 0; i < s.prony.n; i++)
        s.modulus[i] = 0;
    assert_int_equal(wt_prony_reduce(&s.prony, NULL, &p, NULL), WT_E_RANGE);
    assert_null(p.modulus);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(requested_accuracy_is_met),
        cmocka_unit_test(spectral_lines_are_recovered),
        cmocka_unit_test(long_term),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
