/* One spectrum for all isotherms: coverage of the intervals, distant starting points, outliers,
 * choice of the law, verdicts, draws. The material, a sum of two Cole-Cole processes, is not that
 * of the fit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "dma/numerics/shift_law.h"
#include "draw_count.h"
#include "weartrack/dma.h"

#include "dma_data.h"

typedef struct process {
    double strength, log_tau, alpha;
} process;

typedef struct material {
    process processes[2];
    double equilibrium; /* [Pa] */
    wt_shift_law law[2];
} material;

/* A transition, and a broad slow process on the plateau. */
static material usual(void)
{
    const wt_shift_law law = {.kind = WT_LAW_WLF, .wlf = {293.15, 8.2, 110}};
    return (material){{{1.5e9, -5, 0.6}, {4e6, -1, 0.4}}, 2e6, {law, law}};
}

static void moduli(const material *m, double log_w, double temperature, double *storage,
                   double *loss)
{
    *storage = m->equilibrium;
    *loss = 0;
    for (int i = 0; i < 2; i++) {
        const process *p = &m->processes[i];
        const double log_a = wt_shift_law_log_a(&m->law[i], temperature);
        /* strength z/(1 + z), z = (i w tau)^alpha */
        const double r = pow(10, p->alpha * (log_w + log_a + p->log_tau));
        const double c = r * cos(p->alpha * M_PI / 2), s = r * sin(p->alpha * M_PI / 2);
        const double below = (1 + c) * (1 + c) + s * s;
        *storage += p->strength * (c + r * r) / below;
        *loss += p->strength * s / below;
    }
}

typedef struct scene {
    material material;
    double first, last, step; /* [K] */
    double noise, temperature_error;
    uint64_t seed;
    double clamping; /* error of the level of an isotherm */
    double ends;     /* noise ratio of the ends and the middle of an isotherm, minus 1 */
} scene;

/* 13 points over three decades; b follows rho T with reference 293.15 K. */
static void measure(const scene *s, wt_sweep *sweep)
{
    uint64_t state = s->seed;
    for (double t = s->first; t < s->last + 1; t += s->step) {
        wt_isotherm *isotherm = wt_sweep_add(sweep, 13, 0);
        const double real = t + s->temperature_error * dma_normal(&state);
        const double level = s->clamping > 0 ? exp(s->clamping * dma_normal(&state)) : 1;
        isotherm->temperature = t;
        snprintf(isotherm->source, sizeof isotherm->source, "%.2f K", t);
        for (size_t k = 0; k < isotherm->n; k++) {
            const double log_w = -0.2 + 0.25 * (double)k, u = (double)k / 6 - 1;
            const double noise = s->noise * (1 + s->ends * u * u);
            double storage, loss;
            moduli(&s->material, log_w, real, &storage, &loss);
            isotherm->angular_frequency[k] = pow(10, log_w);
            isotherm->storage_modulus[k] =
                level * storage * t / 293.15 * exp(noise * dma_normal(&state));
            isotherm->loss_modulus[k] = level * loss * t / 293.15 * exp(noise * dma_normal(&state));
        }
    }
    wt_sweep_sort(sweep);
}

static wt_vertical_shift vertical = WT_VERTICAL_TIED;

static wt_master fit(const wt_sweep *sweep)
{
    wt_master master = {0};
    wt_error err = WT_ERROR_INIT;
    wt_master_options options = wt_master_options_defaults();
    options.reference_temperature = 293.15;
    options.vertical = vertical;
    options.sample_temperature_error = 0; /* no error of these scenes */
    if (wt_master_fit(sweep, &options, NULL, &master, &err) != WT_OK)
        fail_msg("%s; %s", err.message, err.found);
    return master;
}

static wt_master fit_scene(const scene *s)
{
    wt_sweep sweep = {0};
    measure(s, &sweep);
    wt_master master = fit(&sweep);
    wt_sweep_clear(&sweep);
    return master;
}

/* ---- intervals ------------------------------------------------------------------------------- */

typedef struct tally {
    size_t inside, n;
} tally;

static void count(tally *t, wt_interval interval, double truth)
{
    assert_true(interval.low <= interval.value && interval.value <= interval.high);
    t->inside += truth >= interval.low && truth <= interval.high;
    t->n++;
}

/* Coverage of 95 %; the bounds allow for correlated numbers of few draws. */
static void check(const tally *t, const char *what)
{
    const double share = (double)t->inside / (double)t->n;
    print_message("%s: %.1f %% of %zu\n", what, 100 * share, t->n);
    assert_true(share > 0.88);
}

/* The slope of a WLF law at its reference is -C1/C2; its error is that of both together. */
static void check_slope(const wt_master *m)
{
    const double a = m->c1.standard_error / m->c1.value, b = m->c2.standard_error / m->c2.value;
    const double share = sqrt(a * a + b * b - 2 * m->c_correlation * a * b);
    assert_near(m->slope.value, -m->c1.value / m->c2.value, 0.01);
    assert_near(m->slope.standard_error, share * m->c1.value / m->c2.value, 0.1);
}

static void intervals_hold_the_truth(void **state)
{
    (void)state;
    tally shift = {0}, law = {0}, constants = {0}, curve = {0}, equilibrium = {0};
    double width = 0, widths = 0;
    for (uint64_t seed = 1; seed <= DRAW_COUNT(24); seed++) {
        const scene s = {usual(), 243.15, 333.15, 10, 0.01, 0.2, 100 * seed, 0, 0};
        wt_master m = fit_scene(&s);
        count(&constants, m.c1, 8.2);
        count(&constants, m.c2, 110);
        count(&equilibrium, m.equilibrium, 2e6);
        assert_false(m.equilibrium_limit);
        check_slope(&m);
        for (size_t i = 0; i < m.n_shifts; i++) {
            const double t = m.shifts[i].temperature;
            if (fabs(t - 293.15) > 1)
                count(&law, m.shifts[i].law, wt_shift_law_log_a(&s.material.law[0], t));
            width += m.shifts[i].log_a.standard_error;
            widths++;
        }
        for (double x = m.log_frequency[0]; x < m.log_frequency[m.n - 1]; x += 0.7) {
            wt_interval e[2];
            double truth[2];
            moduli(&s.material, x, 293.15, &truth[0], &truth[1]);
            wt_master_moduli(&m, pow(10, x), &e[0], &e[1]);
            for (int q = 0; q < 2; q++)
                count(&curve, e[q], log10(truth[q]));
        }
        wt_master_clear(&m);
    }
    for (uint64_t seed = 1; seed <= DRAW_COUNT(12); seed++) { /* with known temperatures */
        const scene s = {usual(), 243.15, 333.15, 10, 0.01, 0, seed, 0, 0};
        wt_master m = fit_scene(&s);
        for (size_t i = 0; i < m.n_shifts; i++)
            if (m.shifts[i].log_a.standard_error > 0)
                count(&shift, m.shifts[i].log_a,
                      wt_shift_law_log_a(&s.material.law[0], m.shifts[i].temperature));
        assert_true(m.temperature_spread < 0.1);
        wt_master_clear(&m);
    }
    if (!TEST_RATES)
        return;
    check(&shift, "shifts");
    check(&law, "law");
    check(&constants, "C1, C2");
    check(&curve, "E', E''");
    check(&equilibrium, "E_inf");
    assert_true(width / widths < 0.02);
}

/* With free vertical shifts the reference was clamped like the others: the results are of the
 * material. */
static void the_reference_is_clamped_too(void **state)
{
    (void)state;
    double width[2] = {0, 0};
    tally curve[2] = {{0}}, equilibrium[2] = {{0}};
    vertical = WT_VERTICAL_FREE;
    for (int clamped = 0; clamped < 2; clamped++)
        for (uint64_t seed = 1; seed <= DRAW_COUNT(12); seed++) {
            scene s = {usual(), 243.15, 333.15, 10, 0.01, 0, 50 * seed, 0, 0};
            s.clamping = clamped ? 0.02 : 0;
            wt_master m = fit_scene(&s);
            wt_interval e[2];
            double truth[2];
            moduli(&s.material, 3, 293.15, &truth[0], &truth[1]);
            wt_master_moduli(&m, 1e3, &e[0], &e[1]);
            for (int q = 0; q < 2; q++)
                count(&curve[clamped], e[q], log10(truth[q]));
            count(&equilibrium[clamped], m.equilibrium, 2e6);
            width[clamped] += e[0].standard_error * M_LN10 / 12;
            wt_master_clear(&m);
        }
    vertical = WT_VERTICAL_TIED;
    if (!TEST_RATES)
        return;
    for (int clamped = 0; clamped < 2; clamped++) {
        check(&curve[clamped], "E', E'' with free shifts");
        check(&equilibrium[clamped], "E_inf with free shifts");
    }
    print_message("%.2f and %.2f %%\n", 100 * width[0], 100 * width[1]);
    assert_true(width[0] < 0.01 && width[1] > 0.015 && width[1] < 0.04);
}

/* A melt: the continuation of its spectrum is not measured, so that there is only a limit. */
static void a_liquid_has_an_upper_limit(void **state)
{
    (void)state;
    scene s = {usual(), 243.15, 333.15, 10, 0.01, 0, 7, 0, 0};
    s.material.equilibrium = 0;
    s.material.processes[1] = (process){4e6, -1, 0.9};
    wt_master m = fit_scene(&s);
    assert_true(m.equilibrium_limit);
    assert_true(m.equilibrium.low == 0 && isnan(m.equilibrium.standard_error));
    assert_true(m.equilibrium.high > 0 && m.equilibrium.high < 1e5);
    wt_master_clear(&m);
}

/* ---- starts, outliers ------------------------------------------------------------------------ */

/* Shifts of more than 30 decades in total. */
static void large_shifts_are_found(void **state)
{
    (void)state;
    const wt_shift_law steep = {.kind = WT_LAW_WLF, .wlf = {293.15, 40, 150}};
    scene s = {usual(), 253.15, 353.15, 4, 0.01, 0, 11, 0, 0};
    s.material.processes[0] = (process){2e9, 0, 0.12};
    s.material.processes[1] = (process){5e8, 4, 0.2};
    s.material.law[0] = s.material.law[1] = steep;
    wt_master m = fit_scene(&s);
    double most = 0, least = 0;
    for (size_t i = 0; i < m.n_shifts; i++) {
        const double truth = wt_shift_law_log_a(&steep, m.shifts[i].temperature);
        assert_true(m.shifts[i].determined);
        assert_near_abs(m.shifts[i].log_a.value, truth, 0.6);
        most = fmax(most, truth);
        least = fmin(least, truth);
    }
    assert_true(most - least > 25);
    wt_master_clear(&m);
}

static void single_bad_values_are_left_out_and_counted(void **state)
{
    (void)state;
    const scene s = {usual(), 243.15, 333.15, 10, 0.01, 0, 13, 0, 0};
    wt_sweep sweep = {0};
    measure(&s, &sweep);
    wt_master clean = fit(&sweep);
    for (size_t i = 0; i < sweep.n_isotherms; i++) {
        sweep.isotherms[i].storage_modulus[(5 * i + 3) % 13] *= i % 2 ? 1.6 : 0.6;
        sweep.isotherms[i].loss_modulus[(3 * i + 1) % 13] *= i % 3 ? 0.5 : 2;
    }
    wt_master m = fit(&sweep);
    assert_int_equal(clean.n_outliers, 0);
    assert_int_equal(m.n_outliers, 2 * sweep.n_isotherms);
    for (size_t i = 0; i < m.n_shifts; i++) {
        assert_non_null(strstr(m.shifts[i].note, "2 values off the curve left out"));
        assert_near_abs(m.shifts[i].log_a.value, clean.shifts[i].log_a.value, 0.03);
    }
    assert_int_equal(m.superposition, WT_SUPERPOSITION_HOLDS);
    assert_near_abs(m.c2.value, 110, 3);
    wt_master_clear(&clean);
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
}

static void an_isotherm_of_another_temperature_is_named(void **state)
{
    (void)state;
    const scene s = {usual(), 243.15, 333.15, 10, 0.01, 0, 17, 0, 0};
    wt_sweep sweep = {0};
    measure(&s, &sweep);
    sweep.isotherms[7].temperature += 6; /* it was 6 K colder than stated */
    wt_master m = fit(&sweep);
    assert_non_null(strstr(m.shifts[7].note, "off the law"));
    assert_non_null(strstr(m.shifts[7].note, "as if -"));
    assert_near_abs(m.c1.value, 8.2, 3 * m.c1.standard_error);
    assert_true(m.c2.standard_error < 2);
    assert_true(m.temperature_spread < 1);
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);
}

/* The law from the other isotherms constrains it, too, so that its error is two to three times
 * theirs and not eight times. For one draw the ratio lies between 1.6 and 5. */
static void an_isotherm_with_more_noise_weighs_less(void **state)
{
    (void)state;
    enum { DRAWS = 6, LOUD = 3, CALM = 6 };
    double errors[2] = {0, 0}, factors = 0;
    size_t named = 0;
    tally inside = {0, 0};
    for (uint64_t draw = 0; draw < DRAWS; draw++) {
        const scene s = {usual(), 243.15, 333.15, 10, 0.005, 0, 19 + 1000 * draw, 0, 0};
        wt_sweep sweep = {0};
        uint64_t state_of_noise = 23 + 77 * draw;
        measure(&s, &sweep);
        for (size_t k = 0; k < 13; k++) {
            sweep.isotherms[LOUD].storage_modulus[k] *= exp(0.04 * dma_normal(&state_of_noise));
            sweep.isotherms[LOUD].loss_modulus[k] *= exp(0.04 * dma_normal(&state_of_noise));
        }
        wt_master m = fit(&sweep);
        const wt_master_shift *loud = &m.shifts[LOUD];
        factors += loud->noise_factor / DRAWS;
        named += strstr(loud->note, "times the noise of the others") != NULL;
        assert_true(m.noise_storage < 0.01);
        errors[0] += loud->log_a.standard_error;
        errors[1] += m.shifts[CALM].log_a.standard_error;
        count(&inside, loud->log_a, wt_shift_law_log_a(&s.material.law[0], loud->temperature));
        wt_master_clear(&m);
        wt_sweep_clear(&sweep);
    }
    assert_true(factors > 3);
    assert_true(named + 1 >= DRAWS);
    assert_true(errors[0] > 2 * errors[1]);
    assert_true(inside.inside + 1 >= DRAWS);
}

/* ---- laws ------------------------------------------------------------------------------------ */

static void the_law_is_that_of_the_shifts(void **state)
{
    (void)state;
    const wt_shift_law laws[] = {
        {.kind = WT_LAW_WLF, .wlf = {293.15, 8.2, 110}},
        {.kind = WT_LAW_ARRHENIUS, .wlf = {293.15, 0, 0}, .activation_energy = 1.5e5},
        {.kind = WT_LAW_WLF_ARRHENIUS,
         .wlf = {293.15, 8.2, 110},
         .activation_energy = 1.6e5,
         .joint = 263.15}};
    for (size_t l = 0; l < 3; l++) {
        scene s = {usual(), 223.15, 343.15, 10, 0.005, 0.05, 29, 0, 0};
        s.material.law[0] = s.material.law[1] = laws[l];
        wt_master m = fit_scene(&s);
        assert_int_equal(m.law.kind, laws[l].kind);
        for (double t = 228.15; t < 345; t += 10) {
            const wt_interval at = wt_master_log_shift(&m, t);
            assert_near_abs(at.value, wt_shift_law_log_a(&laws[l], t), 0.15);
            assert_near(at.value, wt_shift_law_log_a(&m.law, t), 1e-2);
        }
        assert_int_equal(isnan(m.activation_energy.value) != 0, laws[l].kind == WT_LAW_WLF);
        assert_int_equal(isnan(m.c1.value) != 0, laws[l].kind == WT_LAW_ARRHENIUS);
        wt_master_clear(&m);
    }
}

static void three_isotherms_give_no_extrapolation(void **state)
{
    (void)state;
    const scene s = {usual(), 283.15, 303.15, 10, 0.005, 0, 41, 0, 0};
    wt_master m = fit_scene(&s);
    assert_int_equal(m.n_shifts, 3);
    assert_true(isfinite(wt_master_log_shift(&m, 298.15).low) != 0);
    assert_true(isnan(wt_master_log_shift(&m, 333.15).low));
    assert_true(isnan(wt_master_log_shift(&m, 253.15).low));
    wt_master_clear(&m);
}

/* Fits the chosen law to shifts of N isotherms with their variances. */
enum { FEW = 8 };
static wt_status choose(size_t n, const double *temperature, const double *variance, double *log_a,
                        law_shape *chosen)
{
    double slope[FEW], scratch[FEW * LAW_SCRATCH], covariance[FEW * FEW] = {0}, root[FEW * FEW];
    gsl_matrix_view c = gsl_matrix_view_array(covariance, n, n);
    gsl_matrix_view r = gsl_matrix_view_array(root, n, n);
    law_data data = {n, temperature, log_a, &c.matrix, slope, scratch, 0};
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < n; i++)
        covariance[i * n + i] = variance[i];
    return law_select(&data, 293.15, &r.matrix, chosen, &err);
}

/* Two isotherms with so small errors that they alone decide, and they rise with temperature. A law
 * only falls with an error of the temperatures. It made the search continue without a law. */
static void shifts_that_rise_have_no_law(void **state)
{
    (void)state;
    const double temperature[] = {273.15, 293.15, 294.15, 313.15, 333.15};
    const double variance[] = {1, 1e-12, 1e-12, 1, 1};
    double log_a[] = {2, 0, 0.01, -2, -4};
    law_shape chosen;
    assert_int_equal(choose(5, temperature, variance, log_a, &chosen), WT_E_RANGE);
}

/* Shifts with the curvature opposite to WLF: the pole would be at infinity with a huge error, and
 * the draws without a limit. */
static void shifts_without_a_pole_are_not_wlf(void **state)
{
    (void)state;
    double temperature[FEW], variance[FEW], log_a[FEW];
    for (int i = 0; i < FEW; i++) {
        const double rise = 10 * (i - 2);
        temperature[i] = 293.15 + rise;
        variance[i] = 1e-4;
        log_a[i] = -0.06 * rise - 0.0004 * rise * rise;
    }
    law_shape chosen;
    assert_int_equal(choose(FEW, temperature, variance, log_a, &chosen), WT_OK);
    assert_int_equal(chosen.kind, WT_LAW_ARRHENIUS);
}

/* ---- spectrum -------------------------------------------------------------------------------- */

/* H of the processes in closed form, log10. */
static double true_density(const material *m, double log_tau)
{
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        const process *p = &m->processes[i];
        sum += p->strength * sin(p->alpha * M_PI) / (2 * M_PI) /
               (cosh(p->alpha * (log_tau - p->log_tau) * M_LN10) + cos(p->alpha * M_PI));
    }
    return log10(sum);
}

/* The stated band covers the truth within the measured frequencies, and is not much wider than
 * necessary. */
static void the_spectrum_and_its_band(void **state)
{
    (void)state;
    for (int sharp = 0; sharp < 2; sharp++) {
        size_t n = 0, inside = 0;
        double squares = 0;
        for (uint64_t seed = 100; seed < 100 + DRAW_COUNT(30); seed++) {
            scene s = {usual(), 233.15, 353.15, 10, sharp ? 0.05 : 0.01, 0, seed, 0, 0};
            if (sharp)
                s.material.processes[0].alpha = 0.8;
            wt_master m = fit_scene(&s);
            const double t = m.reference_temperature,
                         log_a = wt_shift_law_log_a(&s.material.law[0], t);
            for (size_t i = 0; i < m.prony.n; i++) {
                wt_interval h;
                const double tau = m.prony.relaxation_time[i];
                wt_master_spectrum(&m, i, &h);
                assert_int_equal(isnan(h.value) != 0, tau * m.prony.frequency_max < 1 ||
                                                          tau * m.prony.frequency_min > 1);
                if (isnan(h.value))
                    continue;
                const double truth =
                    true_density(&s.material, log10(tau) - log_a) + log10(t / 293.15);
                n++;
                inside += truth >= h.low && truth <= h.high;
                squares += pow((truth - h.value) / h.standard_error, 2);
            }
            wt_master_clear(&m);
        }
        if (!TEST_RATES)
            continue;
        const double wide = sqrt(squares / (double)n); /* 1: not a bit too wide */
        assert_true(inside >= n * 95 / 100);
        assert_true(wide > 0.5 && wide < 1.1);
    }
}

/* ---- verdicts -------------------------------------------------------------------------------- */

/* A bound in a sentence is not below the number, and at most the last digit above it. */
static void check_bound(const wt_master *m)
{
    static const char before[] = "misfit below ";
    const char *words = strstr(m->superposition_reason, before);
    assert_non_null(words);
    const double bound = strtod(words + strlen(before), NULL), number = 100 * m->misfit_high;
    assert_true(number > 0.15); /* what "at least 0.1 %" would not hide */
    assert_true(bound >= number && bound < number + 0.1 + 1e-9);
}

static void superposition_is_tested(void **state)
{
    (void)state;
    scene s = {usual(), 233.15, 353.15, 10, 0.01, 0, 31, 0, 0};
    wt_master m = fit_scene(&s);
    assert_int_equal(m.superposition, WT_SUPERPOSITION_HOLDS);
    assert_true(m.lack_of_fit_p > 1e-3 && m.misfit_high < 0.01);
    assert_near_abs(m.loss_factor, 0, 4 * m.loss_factor_error);
    check_bound(&m);
    wt_master_clear(&m);

    s.material.law[1].wlf.c1 = 2.5; /* a second process has another shift law */
    s.material.processes[1].strength = 2e7;
    m = fit_scene(&s);
    assert_int_equal(m.superposition, WT_SUPERPOSITION_FAILS);
    wt_master_clear(&m);

    s.material = usual();
    wt_sweep sweep = {0};
    measure(&s, &sweep);
    for (size_t i = 0; i < sweep.n_isotherms; i++)
        for (size_t k = 0; k < 13; k++) /* a loss factor read 10 % too high */
            sweep.isotherms[i].loss_modulus[k] *= 1.1;
    m = fit(&sweep);
    assert_int_equal(m.superposition, WT_SUPERPOSITION_FAILS);
    assert_non_null(strstr(m.superposition_reason, "Kramers-Kronig"));
    assert_non_null(
        strstr(m.superposition_reason, "E'' deviates by +")); /* too high, with a stated error */
    wt_master_clear(&m);
    wt_sweep_clear(&sweep);

    s.first = 233.15;
    s.step = 30; /* too far apart */
    m = fit_scene(&s);
    assert_int_equal(m.superposition, WT_SUPERPOSITION_INCONCLUSIVE);
    wt_master_clear(&m);
}

/* E' and E'' exchanged: no spectrum has such moduli. The fits converge, and the errors of the
 * shifts are those of the material, not of the noise of a draw; their intervals contain the
 * truth. */
static void errors_after_failed_superposition(void **state)
{
    (void)state;
    double error[3][13] = {{0}};
    for (uint64_t seed = 0; seed < 3; seed++) {
        const scene s = {usual(), 253.15, 333.15, 10, 0.01, 0, 71 + seed, 0, 0};
        wt_sweep sweep = {0};
        measure(&s, &sweep);
        for (size_t i = 0; i < sweep.n_isotherms; i++)
            for (size_t k = 0; k < sweep.isotherms[i].n; k++) {
                const double storage = sweep.isotherms[i].storage_modulus[k];
                sweep.isotherms[i].storage_modulus[k] = sweep.isotherms[i].loss_modulus[k];
                sweep.isotherms[i].loss_modulus[k] = storage;
            }
        wt_master m = fit(&sweep);
        assert_int_equal(m.superposition, WT_SUPERPOSITION_FAILS);
        assert_true(m.has_converged && m.step_bound <= m.step_tolerance);
        assert_true(m.n_shifts <= 13);
        for (size_t i = 0; i < m.n_shifts; i++) {
            const wt_interval a = m.shifts[i].log_a;
            error[seed][i] = m.shifts[i].determined ? a.standard_error : (double)NAN;
            if (m.shifts[i].determined && a.standard_error > 0)
                assert_near_abs(
                    a.value,
                    wt_wlf_log_shift(&s.material.law[0].wlf, m.shifts[i].temperature) -
                        wt_wlf_log_shift(&s.material.law[0].wlf, m.reference_temperature),
                    2.5 * a.standard_error);
        }
        wt_master_clear(&m);
        wt_sweep_clear(&sweep);
    }
    for (size_t i = 0; i < 13; i++)
        for (size_t one = 0; one < 3; one++) {
            const double ratio = error[one][i] / error[(one + 1) % 3][i];
            if (error[one][i] > 0.05)
                assert_true(!(ratio > 2.0));
        }
}

/* ---- draws ----------------------------------------------------------------------------------- */

static size_t verdicts(double second_c1, wt_superposition verdict)
{
    size_t n = 0;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        scene s = {usual(), 233.15, 353.15, 10, 0.01, 0, seed, 0, 0};
        s.material.law[1].wlf.c1 = second_c1;
        s.material.processes[1].strength = 2e7;
        wt_master m = fit_scene(&s);
        n += m.superposition == verdict;
        wt_master_clear(&m);
    }
    return n;
}

/* The slope change by a second process is not correlated noise. With nearly the same law it is
 * small in each isotherm, and visible where slow and fast times separate. */
static void second_process_is_detected(void **state)
{
    (void)state;
    assert_int_equal(verdicts(5, WT_SUPERPOSITION_FAILS), 5);
    assert_int_equal(verdicts(7.8, WT_SUPERPOSITION_HOLDS), 0);
    assert_true(verdicts(8.2, WT_SUPERPOSITION_HOLDS) >= 4);
}

/* Noise that increases towards the ends of all isotherms looks like a lack of fit there. */
static void noisier_ends_are_no_lack_of_fit(void **state)
{
    (void)state;
    size_t holds = 0;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        const scene s = {usual(), 233.15, 353.15, 10, 0.005, 0, 7 * seed, 0, 5};
        wt_master m = fit_scene(&s);
        assert_int_not_equal(m.superposition, WT_SUPERPOSITION_FAILS);
        holds += m.superposition == WT_SUPERPOSITION_HOLDS;
        wt_master_clear(&m);
    }
    assert_true(holds >= 7);
}

static void draws_scatter_as_the_intervals_say(void **state)
{
    (void)state;
    enum { DRAWS = 300, AGAIN = 64 };
    const scene s = {usual(), 243.15, 333.15, 10, 0.01, 0.2, 37, 0, 0};
    wt_master m = fit_scene(&s);
    wt_interval storage, loss;
    const double omega = 100, t = 313.15;
    wt_master_moduli(&m, omega, &storage, &loss);
    const wt_interval law = wt_master_log_shift(&m, t);
    double sum[2] = {0, 0}, square[2] = {0, 0}, first[AGAIN];
    for (size_t i = 0; i < DRAWS; i++) {
        wt_prony p = {0};
        wt_shift_law drawn;
        double log_b[64];
        assert_int_equal(wt_master_draw(&m, 5, i, &p, &drawn, log_b, NULL), WT_OK);
        double e = p.equilibrium_modulus;
        for (size_t k = 0; k < p.n; k++) {
            const double z = omega * p.relaxation_time[k];
            e += p.modulus[k] * z * z / (1 + z * z);
        }
        const double x[2] = {log10(e), wt_shift_law_log_a(&drawn, t)};
        for (int q = 0; q < 2; q++) {
            sum[q] += x[q] / DRAWS;
            square[q] += x[q] * x[q] / DRAWS;
        }
        assert_near_abs(log_b[9], m.shifts[9].log_b_material, 0.05);
        if (i < AGAIN)
            first[i] = e;
        wt_prony_clear(&p);
    }
    const double spread[2] = {sqrt(square[0] - sum[0] * sum[0]), sqrt(square[1] - sum[1] * sum[1])};
    assert_near_abs(sum[0], storage.value, 4 * storage.standard_error / sqrt(DRAWS));
    assert_near(spread[0], storage.standard_error, 0.2);
    assert_near_abs(sum[1], law.value, 4 * law.standard_error / sqrt(DRAWS));
    assert_near(spread[1], law.standard_error, 0.2);
    /* the same again, and others with another seed, also where the part of the mixture is the
     * same */
    for (size_t i = 0; i < 2 * AGAIN; i++) {
        wt_prony p = {0};
        wt_shift_law drawn;
        const uint64_t seed = 5 + i / AGAIN;
        assert_int_equal(wt_master_draw(&m, seed, i % AGAIN, &p, &drawn, NULL, NULL), WT_OK);
        double e = p.equilibrium_modulus;
        for (size_t k = 0; k < p.n; k++) {
            const double z = omega * p.relaxation_time[k];
            e += p.modulus[k] * z * z / (1 + z * z);
        }
        assert_int_equal(fabs(e - first[i % AGAIN]) > 0, seed != 5);
        wt_prony_clear(&p);
    }
    wt_master_clear(&m);
}

/* The middle isotherm is glassy, flat in both moduli, so that no shift onto it is known. Unless it
 * was requested, one of the transition replaces it. */
static void flat_isotherm_is_not_the_reference(void **state)
{
    (void)state;
    const scene s = {usual(), 243.15, 273.15, 5, 0.01, 0, 51, 0, 0};
    wt_sweep sweep = {0};
    wt_master m = {0};
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    wt_master_options options = wt_master_options_defaults();
    uint64_t seed = 5;
    size_t said = 0, left_out = 0;
    measure(&s, &sweep);
    for (int i = 0; i < 10; i++) {
        wt_isotherm *glass = wt_sweep_add(&sweep, 13, false);
        glass->temperature = 238.15 - 5 * i;
        for (size_t k = 0; k < glass->n; k++) {
            glass->angular_frequency[k] = pow(10, -0.2 + 0.25 * (double)k);
            glass->storage_modulus[k] = 1.6e9 * exp(s.noise * dma_normal(&seed));
            glass->loss_modulus[k] = 3e7 * exp(s.noise * dma_normal(&seed));
        }
    }
    wt_sweep_sort(&sweep);
    sweep.isotherms[0].loss_modulus[3] = -1; /* reported once, though there are two fits */
    assert_int_equal(wt_master_fit(&sweep, &options, log, &m, &err), WT_OK);
    assert_true(m.reference_temperature > 243);
    for (size_t i = 10; i < m.n_shifts; i++)
        assert_true(m.shifts[i].determined);
    for (size_t i = 0; i < wt_log_count(log); i++) {
        const wt_log_entry e = wt_log_get(log, i);
        said += strstr(e.text, "too flat to shift others onto it") != NULL;
        left_out += strstr(e.text, "1 of 13 points left out") != NULL ? e.count : 0;
    }
    assert_int_equal(said, 1);
    assert_int_equal(left_out, 1);
    wt_master_clear(&m);
    options.reference_temperature = 228.15;
    /* a stated reference may be flat, because it only moves the shifts */
    assert_int_equal(wt_master_fit(&sweep, &options, NULL, &m, &err), WT_OK);
    assert_near(m.reference_temperature, 228.15, 1e-9);
    wt_master_clear(&m);
    wt_log_free(log);
    wt_sweep_clear(&sweep);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_isotherm_is_not_the_reference),
        cmocka_unit_test(intervals_hold_the_truth),
        cmocka_unit_test(a_liquid_has_an_upper_limit),
        cmocka_unit_test(large_shifts_are_found),
        cmocka_unit_test(single_bad_values_are_left_out_and_counted),
        cmocka_unit_test(an_isotherm_of_another_temperature_is_named),
        cmocka_unit_test(an_isotherm_with_more_noise_weighs_less),
        cmocka_unit_test(the_law_is_that_of_the_shifts),
        cmocka_unit_test(three_isotherms_give_no_extrapolation),
        cmocka_unit_test(shifts_that_rise_have_no_law),
        cmocka_unit_test(shifts_without_a_pole_are_not_wlf),
        cmocka_unit_test(the_spectrum_and_its_band),
        cmocka_unit_test(superposition_is_tested),
        cmocka_unit_test(errors_after_failed_superposition),
        cmocka_unit_test(second_process_is_detected),
        cmocka_unit_test(noisier_ends_are_no_lack_of_fit),
        cmocka_unit_test(the_reference_is_clamped_too),
        cmocka_unit_test(draws_scatter_as_the_intervals_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
