/* Critical energy and wear rate from a thickness: inverse of the forward model, and independent
 * values with eleven digits.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "weartrack/layer.h"

#include <math.h>
#include <string.h>

typedef struct known {
    double energy, wear;                           /* U_c [J/m^3], k [mm^3/(N m)] */
    double energy_by_thickness, wear_by_thickness; /* d ln / d ln thickness */
} known;

/* By a wear rate, by the rate balance, by damage transport. */
enum { BY_WEAR, BY_RATES, BY_TRANSPORT, WAYS };
typedef struct example {
    double mu, pressure, velocity, damage;
    size_t n;
    double q[3], share[3];
    wt_depth_profile profile;
    double local_friction, thickness, time, of_thickness, ratio;
    known ways[WAYS];
} example;

static const example examples[] = {
    {0.2,
     4e5,
     0.005,
     1,
     1,
     {1e6},
     {1},
     WT_PROFILE_PERSSON,
     0,
     1.6e-6,
     900,
     0.95,
     24.53253019710935,
     {{9591106818.43911, 0.00085, -3.2, 0},
      {15695388228.919174, 0.0005194163200533104, -2.7795759289668602, -0.42042407103313967},
      {15353678358.564318, 0.0005309763957068824, -2.717590805290603, -0.4824091947093968}}},
    {0.25,
     1.2e6,
     0.3,
     0.8,
     3,
     {1e5, 8e5, 6e6},
     {0.35, 0.45, 0.2},
     WT_PROFILE_PERSSON,
     0,
     5e-6,
     40,
     0.9,
     7.757424552748813,
     {{58008943166.65243, 0.0006944444444444445, -1.0081973269825948, 0},
      {67457814422.20402, 0.0005971730429635096, -1.0649510686823405, 0.056753741699745515},
      {49609997505.680786, 0.0008120135121063536, -0.6396410834857477, -0.3685562434968472}}},
    {0.22,
     5e5,
     0.02,
     1,
     2,
     {5e5, 4e6},
     {0.6, 0.4},
     WT_PROFILE_INCOMPRESSIBLE,
     0.5,
     3e-6,
     500,
     0.95,
     4.585738927214387,
     {{59968525109.00552, 0.0008, -1.5205483766057766, 0},
      {45078247966.135666, 0.0010642565372825658, -0.5756584857789925, -0.9448898908267842},
      {58590874841.09053, 0.0008188104413412695, -0.7648942381197799, -0.7556541384859968}}},
};
enum { EXAMPLES = sizeof examples / sizeof *examples };

static wt_identified_constants found(const example *e, int way, double thickness)
{
    double q[3], power[3];
    const double surface = e->mu * e->pressure * e->velocity;
    wt_energy_source source = {.profile = e->profile,
                               .local_friction = e->local_friction,
                               .n = e->n,
                               .wavenumber = q,
                               .power = power};
    wt_layer_parameters p = wt_layer_defaults();
    wt_identified_constants out = {0};
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < e->n; i++) {
        q[i] = e->q[i];
        power[i] = surface * e->share[i];
    }
    p.damage = e->damage;
    p.pressure = e->pressure;
    p.velocity = e->velocity;
    p.incubation = way == BY_TRANSPORT;
    const wt_status status =
        way == BY_WEAR
            ? wt_layer_identify_wear(&source, &p, thickness, 1e-9 * e->ways[BY_WEAR].wear, &out,
                                     &err)
            : wt_layer_identify_time(&source, &p, thickness, e->time, e->of_thickness, &out, &err);
    if (status != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    return out;
}

static void check(double is, double expected, double relative)
{
    if (!(fabs(is / expected - 1) <= relative))
        fail_msg("%.15g, expected %.15g", is, expected);
}

static void test_known(void **state)
{
    (void)state;
    for (int i = 0; i < EXAMPLES; i++)
        for (int way = 0; way < WAYS; way++) {
            const example *const e = &examples[i];
            const wt_identified_constants is = found(e, way, e->thickness);
            check(is.critical_energy, e->ways[way].energy, 2e-10);
            check(1e9 * is.specific_wear_rate, e->ways[way].wear, 2e-10);
            check(is.ratio, e->ratio, 1e-11);
        }
}

static void test_sensitivity(void **state)
{
    (void)state;
    const double step = 1e-4;
    for (int i = 0; i < EXAMPLES; i++)
        for (int way = 0; way < WAYS; way++) {
            const example *const e = &examples[i];
            const wt_identified_constants up = found(e, way, e->thickness * exp(step)),
                                          down = found(e, way, e->thickness * exp(-step));
            const double energy = log(up.critical_energy / down.critical_energy) / (2 * step),
                         wear = log(up.specific_wear_rate / down.specific_wear_rate) / (2 * step);
            assert_true(fabs(energy - e->ways[way].energy_by_thickness) < 1e-5);
            assert_true(fabs(wear - e->ways[way].wear_by_thickness) < 1e-5);
        }
}

/* The identified layer takes the stated time. */
static void test_forward(void **state)
{
    (void)state;
    const example *const e = &examples[1];
    for (int way = BY_RATES; way < WAYS; way++) {
        double q[3], power[3];
        const wt_identified_constants is = found(e, way, e->thickness);
        wt_energy_source source = {.n = e->n, .wavenumber = q, .power = power};
        wt_layer_parameters p = wt_layer_defaults();
        wt_layer_steady_state balance;
        wt_estimate time;
        for (size_t i = 0; i < e->n; i++) {
            q[i] = e->q[i];
            power[i] = e->mu * e->pressure * e->velocity * e->share[i];
        }
        p.damage = e->damage;
        p.pressure = e->pressure;
        p.velocity = e->velocity;
        p.incubation = way == BY_TRANSPORT;
        p.critical_energy = is.critical_energy;
        p.specific_wear_rate = is.specific_wear_rate;
        assert_int_equal(wt_layer_steady_state_compute(&source, &p, &balance, NULL), WT_OK);
        check(balance.thickness.value, e->thickness, 1e-10);
        const wt_estimate most = {e->of_thickness * e->thickness, 0, 0, "m"};
        assert_int_equal(wt_layer_growth_time(&source, &p, most, &time, NULL), WT_OK);
        check(time.value, e->time, 1e-8);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    double q[] = {1e6}, power[] = {400};
    wt_energy_source source = {.n = 1, .wavenumber = q, .power = power};
    wt_layer_parameters p = wt_layer_defaults();
    wt_identified_constants out;
    wt_error err = WT_ERROR_INIT;
    p.pressure = 4e5;
    p.velocity = 5e-3;
    assert_int_equal(wt_layer_identify_wear(&source, &p, -1, 1e-12, &out, &err), WT_E_RANGE);
    assert_int_equal(wt_layer_identify_wear(&source, &p, 1e-6, 0, &out, &err), WT_E_RANGE);
    assert_int_equal(wt_layer_identify_time(&source, &p, 1e-6, 0, 0.95, &out, &err), WT_E_RANGE);
    assert_int_equal(wt_layer_identify_time(&source, &p, 1e-6, 10, 1, &out, &err), WT_E_RANGE);
    assert_int_equal(wt_layer_identify_wear(&source, NULL, 1e-6, 1e-12, &out, &err), WT_E_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known), cmocka_unit_test(test_sensitivity),
        cmocka_unit_test(test_forward), cmocka_unit_test(test_refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
