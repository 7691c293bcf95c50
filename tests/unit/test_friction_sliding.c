/* Friction and layer: every number of their tables against a plain double sum of Persson's
 * integrals, a contact scaled by hand, or other numbers of the tables.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_fixture.h"
#include "truth_fixture.h"
#include "weartrack/layer.h"

enum { VELOCITIES = 5 };
static const double velocity[VELOCITIES] = {0.01, 0.03, 0.1, 0.3, 1};

/* ---- Persson's integrals, summed ------------------------------------------------------------- */

/* C(q) of the road: constant up to the roll-off, then q^(-2(1 + H)). */
static double spectrum(double q)
{
    const double past = q > surface.qr ? q / surface.qr : 1;
    return surface.c0.value * pow(past, -2 * (1 + surface.hurst));
}

static void moduli(double omega, double *storage, double *loss)
{
    *storage = rubber.prony.equilibrium_modulus;
    *loss = 0;
    for (size_t k = 0; k < rubber.prony.n; k++) {
        const double z = omega * rubber.prony.relaxation_time[k];
        *storage += rubber.prony.modulus[k] * z * z / (1 + z * z);
        *loss += rubber.prony.modulus[k] * z / (1 + z * z);
    }
}

typedef struct summed {
    double hysteresis, area_ratio;
} summed;

/* Midpoints of ln q and of the angle. */
static summed sum_contact(double v)
{
    enum { SHELLS = 2000, ANGLES = 90 };
    const double factor = 1 / ((1 - rubber.poisson_ratio * rubber.poisson_ratio) *
                               sliding.pressure.value),
                 step = log(surface.q1 / surface.q0) / SHELLS;
    summed s = {0, 1};
    double variance = 0;
    for (int i = 0; i < SHELLS; i++) {
        const double q = surface.q0 * exp(step * (i + 0.5)),
                     weight = step * pow(q, 4) * spectrum(q);
        double squares = 0, losses = 0;
        for (int k = 0; k < ANGLES; k++) {
            const double across = cos(M_PI / 2 * (k + 0.5) / ANGLES);
            double storage, loss;
            moduli(q * v * across, &storage, &loss);
            storage *= factor;
            loss *= factor;
            squares += 2 * M_PI / ANGLES * (storage * storage + loss * loss);
            losses += 2 * M_PI / ANGLES * across * loss;
        }
        variance += weight * squares / 16; /* half of the previous shell, and half of the next */
        s.area_ratio = erf(1 / (2 * sqrt(variance)));
        variance += weight * squares / 16;
        const double part = sliding.gamma + (1 - sliding.gamma) * s.area_ratio * s.area_ratio;
        s.hysteresis += 0.5 * weight * part * s.area_ratio * losses;
    }
    s.area_ratio = erf(1 / (2 * sqrt(variance)));
    return s;
}

static wt_table *friction(const wt_layer_observation *layer)
{
    wt_friction_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    if (wt_sliding_friction_compute(&sliding, layer, &work, &t, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_table *table = t.friction;
    t.friction = NULL;
    wt_table_free(t.friction);
    return table;
}

static void test_friction(void **state)
{
    (void)state;
    static const double gammas[] = {1, 0.5};
    for (size_t g = 0; g < 2; g++) {
        sliding_set_up(velocity, VELOCITIES);
        sliding.gamma = gammas[g];
        sliding.reference_velocity = 0.1;
        wt_table *t = friction(NULL);
        assert_int_equal(wt_table_n_rows(t), VELOCITIES);
        for (size_t i = 0; i < VELOCITIES; i++) {
            const summed s = sum_contact(velocity[i]);
            const double shearing = 5e6 * s.area_ratio / 0.4e6;
            assert_near(cell(t, i, "velocity"), velocity[i], 0);
            assert_near(cell(t, i, "hysteresis"), s.hysteresis, 2e-3);
            assert_near(cell(t, i, "area_ratio"), s.area_ratio, 2e-3);
            assert_near(cell(t, i, "adhesion"), shearing, 2e-3);
            assert_near(cell(t, i, "friction"), s.hysteresis + shearing, 2e-3);
            assert_near(cell(t, i, "friction"), cell(t, i, "hysteresis") + cell(t, i, "adhesion"),
                        1e-12);
            assert_near(cell(t, i, "adhesion"), cell(t, i, "area_ratio") * 5e6 / 0.4e6, 1e-12);
            assert_near(cell(t, i, "friction_numerical_error"),
                        cell(t, i, "hysteresis_numerical_error") +
                            5e6 / 0.4e6 * cell(t, i, "area_ratio_numerical_error"),
                        1e-9);
            assert_true(cell(t, i, "hysteresis_numerical_error") <= 1e-6 * s.hysteresis);
            assert_true(isnan(cell(t, i, "friction_with_layer")));
        }
        static const char *const numbers[] = {"friction", "hysteresis", "area_ratio"};
        for (size_t k = 0; k < 3; k++) {
            char key[48], error[48];
            snprintf(key, sizeof key, "%s_at_reference", numbers[k]);
            snprintf(error, sizeof error, "%s_numerical_error", numbers[k]);
            assert_near(key_estimate(t, key).value, cell(t, 2, numbers[k]), 1e-9);
            /* of an independent contact, and of the same order */
            assert_true(key_estimate(t, key).numerical_error > 0.1 * cell(t, 2, error));
            assert_true(key_estimate(t, key).numerical_error < 10 * cell(t, 2, error));
        }
        const wt_estimate shearing = key_estimate(t, "shearing_at_reference"),
                          area = key_estimate(t, "area_ratio_at_reference");
        assert_near(shearing.value, 5e6 / 0.4e6 * area.value, 1e-12);
        assert_near(shearing.numerical_error, 5e6 / 0.4e6 * area.numerical_error, 1e-12);
        assert_near(key_estimate(t, "pressure").value, 0.4e6, 0);
        assert_near(key_estimate(t, "temperature").value, 293.15, 0);
        assert_near(key_estimate(t, "shear_stress").value, 5e6, 0);
        assert_near(key_estimate(t, "reference_velocity").value, 0.1, 0);
        assert_near(strtod(wt_table_key(t, "gamma"), NULL), gammas[g], 0);
        assert_string_equal(wt_table_key(t, "replicates"), "0");
        wt_table_free(t);
    }
}

/* Share from unmeasured frequencies: the loss without the frequencies above the range. */
static void test_extrapolated(void **state)
{
    (void)state;
    sliding_set_up(velocity, VELOCITIES);
    wt_table *t = friction(NULL);
    for (size_t i = 0; i < VELOCITIES; i++)
        assert_true(cell(t, i, "extrapolated_share") >= 0 &&
                    cell(t, i, "extrapolated_share") < 0.05);
    wt_table_free(t);
    rubber.prony.frequency_min = 1e9; /* all frequencies are below */
    rubber.prony.frequency_max = 1e10;
    t = friction(NULL);
    for (size_t i = 0; i < VELOCITIES; i++)
        assert_near(cell(t, i, "extrapolated_share"), 1, 1e-6);
    wt_table_free(t);
    rubber.prony.frequency_min = (double)NAN;
    t = friction(NULL);
    assert_true(isnan(cell(t, 0, "extrapolated_share")));
    wt_table_free(t);
}

/* ---- layer on the surface -------------------------------------------------------------------- */

/* All moduli times a ratio: the same contact at the pressure divided by it. */
static void scale_rubber(double ratio)
{
    static double term[3];
    rubber.prony.equilibrium_modulus *= ratio;
    for (size_t k = 0; k < 3; k++)
        term[k] = ratio * rubber.prony.modulus[k];
    rubber.prony.modulus = term;
}

/* A layer thicker than every wave has the friction of its rubber; a very thin one, or one without a
 * ratio, has no effect. */
static void test_layered(void **state)
{
    (void)state;
    static const double ratio = 0.6;
    for (int bulk_shear = 0; bulk_shear < 2; bulk_shear++) {
        wt_layer_observation layer = {.thickness = {1, 0, 0, "m"},
                                      .modulus_ratio = {ratio, 0, 0, "1"},
                                      .bulk_shear = bulk_shear == 1};
        sliding_set_up(velocity, VELOCITIES);
        sliding.reference_velocity = 0.3;
        wt_table *thick = friction(&layer);
        layer.thickness.value = 1e-12;
        wt_table *thin = friction(&layer);
        scale_rubber(ratio);
        wt_table *soft = friction(NULL);
        double low = (double)INFINITY, high = -(double)INFINITY;
        for (size_t i = 0; i < VELOCITIES; i++) {
            const double with = cell(thick, i, "friction_with_layer"),
                         without = cell(thick, i, "friction");
            assert_near(with,
                        cell(soft, i, "hysteresis") +
                            (bulk_shear ? 1 : ratio) * cell(soft, i, "adhesion"),
                        1e-6);
            assert_near(cell(thin, i, "friction"), without, 1e-12);
            /* the shear stress is that of the top, for any thickness */
            assert_near(cell(thin, i, "friction_with_layer"),
                        cell(thin, i, "hysteresis") +
                            (bulk_shear ? 1 : ratio) * cell(thin, i, "adhesion"),
                        1e-6);
            low = fmin(low, with / without - 1);
            high = fmax(high, with / without - 1);
        }
        const double with = cell(thick, 3, "friction_with_layer"),
                     without = cell(thick, 3, "friction");
        assert_near(key_estimate(thick, "friction_with_layer_at_reference").value, with, 1e-9);
        assert_near(key_estimate(thick, "friction_change_at_reference").value, with - without,
                    1e-9);
        assert_near(key_estimate(thick, "relative_change_at_reference").value, with / without - 1,
                    1e-9);
        assert_near(key_estimate(thick, "relative_change_low").value, low, 1e-9);
        assert_near(key_estimate(thick, "relative_change_high").value, high, 1e-9);
        assert_near(key_estimate(thick, "layer_thickness").value, 1, 0);
        assert_near(key_estimate(thick, "layer_modulus_ratio").value, ratio, 0);
        const double change_error =
            key_estimate(thick, "friction_change_at_reference").numerical_error;
        assert_near(change_error,
                    key_estimate(thick, "friction_at_reference").numerical_error +
                        key_estimate(thick, "friction_with_layer_at_reference").numerical_error,
                    1e-6);
        assert_near(key_estimate(thick, "relative_change_at_reference").numerical_error,
                    change_error / without, 1e-6);
        wt_table_free(thick);
        wt_table_free(thin);
        wt_table_free(soft);
    }
    /* a layer like the bulk, of any thickness */
    sliding_set_up(velocity, VELOCITIES);
    const wt_layer_observation same = {.thickness = {1e-6, 0, 0, "m"},
                                       .modulus_ratio = {1, 0, 0, "1"}};
    wt_table *t = friction(&same);
    for (size_t i = 0; i < VELOCITIES; i++)
        assert_near(cell(t, i, "friction_with_layer"), cell(t, i, "friction"), 1e-9);
    wt_table_free(t);
}

/* ---- errors ---------------------------------------------------------------------------------- */

/* One error source at a time: the standard error follows from the derivative, taken by two runs. */
static void test_errors(void **state)
{
    (void)state;
    static const double relative = 0.02;
    static const char *const numbers[] = {"friction", "hysteresis", "area_ratio"},
                             *const words[] = {"pressure", "shear stress"};
    for (size_t source = 0; source < 2; source++) {
        wt_table *moved[2], *t;
        sliding_set_up(velocity, VELOCITIES);
        work.replicates = 400;
        wt_estimate *const of = source == 0 ? &sliding.pressure : &sliding.shear_stress;
        const double value = of->value;
        of->standard_error = relative * value;
        t = friction(NULL);
        assert_non_null(strstr(wt_table_key(t, "standard_error_includes"), words[source]));
        assert_string_equal(wt_table_key(t, "replicates"), "400");
        of->standard_error = (double)NAN;
        work.replicates = 0;
        for (size_t k = 0; k < 2; k++) {
            of->value = value * (k == 0 ? 1 - relative : 1 + relative);
            moved[k] = friction(NULL);
        }
        for (size_t i = 0; i < VELOCITIES; i++)
            for (size_t k = 0; k < 3; k++) {
                char error[48];
                const double change =
                    (cell(moved[1], i, numbers[k]) - cell(moved[0], i, numbers[k])) / 2;
                snprintf(error, sizeof error, "%s_standard_error", numbers[k]);
                if (source == 1 && k > 0) /* not an input of it */
                    assert_true(!(cell(t, i, error) > 1e-12));
                else
                    assert_near_abs(cell(t, i, error), fabs(change),
                                    0.12 * fabs(change) + 1e-4 * cell(t, i, numbers[k]));
            }
        wt_table_free(t);
        wt_table_free(moved[0]);
        wt_table_free(moved[1]);
    }
}

/* ---- layer against time ---------------------------------------------------------------------- */

static wt_table *layer_of(const wt_layer_job *job)
{
    wt_layer_tables t = {0};
    wt_error err = WT_ERROR_INIT;
    if (wt_layer_thickness_compute(&sliding, job, &work, &t, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    wt_table *table = t.layer;
    t.layer = NULL;
    wt_table_free(t.layer);
    return table;
}

/* Time when the thickness reaches a value, by hand. */
static double time_of(const wt_table *t, double thickness)
{
    size_t i = 1;
    while (i + 1 < wt_table_n_rows(t) && cell(t, i, "thickness") < thickness)
        i++;
    const double share = (thickness - cell(t, i - 1, "thickness")) /
                         (cell(t, i, "thickness") - cell(t, i - 1, "thickness"));
    return cell(t, i - 1, "time") + share * (cell(t, i, "time") - cell(t, i - 1, "time"));
}

static void test_layer(void **state)
{
    (void)state;
    enum { TIMES = 400 };
    static const double wear = 1e-12, duties[] = {1, 0.25};
    static double times[TIMES];
    for (size_t d = 0; d < 2; d++) {
        sliding_set_up(velocity, VELOCITIES);
        sliding.reference_velocity = 0.3;
        wt_layer_job job = wt_layer_job_defaults();
        job.critical_energy.value = 2e10;
        job.specific_wear_rate.value = wear;
        job.duty = duties[d];
        wt_table *chosen = layer_of(&job);
        const double balance = key_estimate(chosen, "balance_thickness").value,
                     start = key_estimate(chosen, "incubation_time").value,
                     relaxation = key_estimate(chosen, "relaxation_time").value,
                     rate = wear * 0.4e6 * 0.3 * duties[d];
        assert_true(balance > 0 && start > 0 && relaxation > 0);
        /* chosen times: from half the first time scale to the last span */
        assert_int_equal(wt_table_n_rows(chosen), 61);
        assert_near(cell(chosen, 0, "time"), fmin(start, relaxation) / 2, 1e-6);
        assert_near(cell(chosen, 60, "time"), 100 * fmax(start, relaxation), 1e-6);
        for (size_t i = 1; i + 1 < 61; i++)
            assert_near(cell(chosen, i, "time") / cell(chosen, i - 1, "time"),
                        cell(chosen, i + 1, "time") / cell(chosen, i, "time"), 1e-6);
        for (size_t i = 0; i < TIMES; i++)
            times[i] = start * 0.5 + 6 * relaxation * (double)i / TIMES;
        job.time = times;
        job.n_time = TIMES;
        wt_table *t = layer_of(&job);
        for (size_t i = 0; i < TIMES; i++) {
            const double h = cell(t, i, "thickness");
            assert_near(cell(t, i, "time"), times[i], 0);
            assert_near(cell(t, i, "wear_rate"), rate, 1e-9);
            if (times[i] < 0.999 * start)
                assert_near(h, 0, 0);
        }
        assert_near(cell(chosen, 60, "thickness"), balance, 1e-6);
        assert_near(cell(chosen, 60, "formation_rate"), rate, 1e-6);
        assert_near(key_estimate(t, "time_to_90_percent").value, time_of(t, 0.9 * balance), 2e-3);
        /* first formation against wear, and the wear that leaves no layer */
        const double ratio = key_estimate(t, "formation_wear_ratio").value;
        assert_near(key_estimate(t, "critical_specific_wear_rate").value, ratio * wear, 1e-9);
        assert_near(cell(t, 0, "formation_rate") / rate, ratio, 1e-6);
        /* hysteresis power of the nominal area */
        wt_table *f = friction(NULL);
        assert_near(key_estimate(t, "surface_power").value, cell(f, 3, "hysteresis") * 0.4e6 * 0.3,
                    1e-3);
        wt_table_free(f);
        assert_near(key_estimate(t, "velocity").value, 0.3, 0);
        assert_near(key_estimate(t, "pressure").value, 0.4e6, 0);
        assert_near(key_estimate(t, "specific_wear_rate").value, wear, 0);
        assert_near(key_estimate(t, "critical_energy").value, 2e10, 0);
        assert_near(strtod(wt_table_key(t, "duty"), NULL), duties[d], 0);
        assert_string_equal(wt_table_key(t, "critical_energy_from"), "given");
        assert_null(wt_table_key(t, "removal_time"));
        wt_table_free(t);
        wt_table_free(chosen);
    }
}

/* Without incubation the layer grows by formation minus wear, from the start. */
static void test_growth(void **state)
{
    (void)state;
    enum { TIMES = 600 };
    static double times[TIMES];
    sliding_set_up(velocity, VELOCITIES);
    sliding.reference_velocity = 0.3;
    wt_layer_job job = wt_layer_job_defaults();
    job.critical_energy.value = 2e10;
    job.specific_wear_rate.value = 1e-12;
    job.incubation = false;
    wt_table *t = layer_of(&job);
    const double last = 5 * key_estimate(t, "relaxation_time").value;
    wt_table_free(t);
    for (size_t i = 0; i < TIMES; i++)
        times[i] = last * (double)i / TIMES;
    job.time = times;
    job.n_time = TIMES;
    t = layer_of(&job);
    assert_near(cell(t, 0, "thickness"), 0, 0);
    for (size_t i = 5; i + 1 < TIMES; i++) {
        const double grows = (cell(t, i + 1, "thickness") - cell(t, i - 1, "thickness")) /
                             (times[i + 1] - times[i - 1]);
        assert_near_abs(grows, cell(t, i, "formation_rate") - cell(t, i, "wear_rate"),
                        0.01 * cell(t, i, "formation_rate"));
    }
    /* near the steady state the difference falls by e in each relaxation time */
    const wt_estimate balance = key_estimate(t, "balance_thickness");
    const double rest[] = {balance.value - cell(t, TIMES / 2, "thickness"),
                           balance.value - cell(t, TIMES - 1, "thickness")};
    assert_near((times[TIMES - 1] - times[TIMES / 2]) / log(rest[0] / rest[1]),
                key_estimate(t, "relaxation_time").value, 0.03);
    wt_table_free(t);
}

/* Errors by wear and critical energy through the steady state, by finite differences. */
static void test_layer_errors(void **state)
{
    (void)state;
    static const double relative = 0.02;
    for (size_t source = 0; source < 2; source++) {
        sliding_set_up(velocity, VELOCITIES);
        sliding.reference_velocity = 0.3;
        wt_layer_job job = wt_layer_job_defaults();
        job.critical_energy.value = 2e10;
        job.specific_wear_rate.value = 1e-12;
        wt_estimate *const of = source == 0 ? &job.specific_wear_rate : &job.critical_energy;
        const double value = of->value;
        of->standard_error = relative * value;
        work.replicates = 400;
        wt_table *t = layer_of(&job), *moved[2];
        of->standard_error = 0;
        work.replicates = 0;
        for (size_t k = 0; k < 2; k++) {
            of->value = value * exp(k == 0 ? -relative : relative);
            moved[k] = layer_of(&job);
        }
        static const char *const keys[] = {"balance_thickness", "formation_wear_ratio",
                                           "relaxation_time", "incubation_time"};
        for (size_t k = 0; k < 4; k++) {
            const wt_estimate e = key_estimate(t, keys[k]);
            const double change =
                (key_estimate(moved[1], keys[k]).value - key_estimate(moved[0], keys[k]).value) / 2;
            assert_near_abs(e.standard_error, fabs(change), 0.12 * fabs(change) + 1e-6 * e.value);
        }
        assert_non_null(strstr(wt_table_key(t, "standard_error_includes"),
                               source == 0 ? "specific wear rate" : "critical energy"));
        wt_table_free(t);
        wt_table_free(moved[0]);
        wt_table_free(moved[1]);
    }
}

/* With many velocities the replicates are computed at some of them. The errors are those with few
 * velocities, and values do not change. The last velocity, the reference, is exact. */
static void test_many_velocities(void **state)
{
    enum { MANY = 2400, EVERY = 6, FEW = MANY / EVERY };
    static const char *const numbers[] = {"friction", "hysteresis", "area_ratio",
                                          "friction_with_layer"};
    static double many[MANY], few[FEW];
    const wt_layer_observation layer = {.thickness = {2e-6, 4e-7, 0, "m"},
                                        .modulus_ratio = {0.7, 0.05, 0, "1"}};
    (void)state;
    for (size_t i = 0; i < MANY; i++) {
        many[i] = 1e-6 * pow(10, 7.0 * (double)i / (MANY - 1));
        if (i % EVERY == 0)
            few[i / EVERY] = many[i];
    }
    wt_table *tables[2];
    for (size_t k = 0; k < 2; k++) {
        sliding_set_up(k == 0 ? many : few, k == 0 ? MANY : FEW);
        sliding.reference_velocity = 0.1;
        sliding.pressure.standard_error = 0.02e6;
        sliding.shear_stress.standard_error = 0.3e6;
        surface.c0.standard_error = 2e-18;
        work.replicates = 20;
        tables[k] = friction(&layer);
    }
    for (size_t n = 0; n < sizeof numbers / sizeof *numbers; n++) {
        char error[48], key[48];
        snprintf(error, sizeof error, "%s_standard_error", numbers[n]);
        for (size_t i = 0; i < FEW; i++) {
            assert_near(cell(tables[0], EVERY * i, numbers[n]), cell(tables[1], i, numbers[n]), 0);
            assert_near(cell(tables[0], EVERY * i, error), cell(tables[1], i, error), 1e-4);
        }
        if (n == 3)
            continue;
        snprintf(key, sizeof key, "%s_at_reference", numbers[n]);
        assert_near(key_estimate(tables[0], key).standard_error,
                    key_estimate(tables[1], key).standard_error, 0);
    }
    wt_table_free(tables[0]);
    wt_table_free(tables[1]);
}

/* The statement of a missed tolerance has the worst error of all velocities, in any order. */
static void test_missed_tolerance(void **state)
{
    (void)state;
    static const double rising[] = {1e-3, 0.1, 10}, falling[] = {10, 0.1, 1e-3};
    const double *const orders[] = {rising, falling};
    char statement[2][128];
    for (size_t k = 0; k < 2; k++) {
        sliding_set_up(orders[k], 3);
        work.tolerance = 1e-17;
        wt_table *table = friction(NULL);
        snprintf(statement[k], sizeof *statement, "%s", wt_table_key(table, "numerical_statement"));
        double worst = 0;
        for (size_t i = 0; i < 3; i++)
            worst = fmax(worst, cell(table, i, "hysteresis_numerical_error") /
                                    cell(table, i, "hysteresis"));
        const char *const stated = strstr(statement[k], "up to ");
        assert_non_null(stated);
        assert_true(strtod(stated + strlen("up to "), NULL) >= 0.95 * worst);
        wt_table_free(table);
    }
    assert_string_equal(statement[0], statement[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_friction),
        cmocka_unit_test(test_extrapolated),
        cmocka_unit_test(test_layered),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_layer),
        cmocka_unit_test(test_growth),
        cmocka_unit_test(test_layer_errors),
        cmocka_unit_test(test_many_velocities),
        cmocka_unit_test(test_missed_tolerance),
    };
    return cmocka_run_group_tests_name("friction and layer", tests, NULL, NULL);
}
