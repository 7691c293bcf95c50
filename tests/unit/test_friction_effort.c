/* Cost of friction: nodes for a tolerance, and evaluations of a closed form for its terms. */
#include "assert_near.h"

#include "weartrack/friction.h"

#include <stdlib.h>

enum { VELOCITIES = 100, KNOTS = 107, MOST = 100 };

static wt_material *prony(size_t terms)
{
    double modulus[MOST], time[MOST];
    wt_prony series = {.deformation = WT_TENSION,
                       .reference_temperature = (double)NAN,
                       .equilibrium_modulus = 5e6,
                       .n = terms,
                       .relaxation_time = time,
                       .modulus = modulus,
                       .frequency_min = (double)NAN,
                       .frequency_max = (double)NAN};
    wt_material *material = NULL;
    for (size_t k = 0; k < terms; k++) {
        const double part = (double)k / (double)(terms - 1);
        time[k] = pow(10, -11 * part);
        modulus[k] = pow(10, 7 + 3 * part) / (double)terms;
    }
    assert_int_equal(wt_material_prony(&series, 0.5, &material, NULL), WT_OK);
    return material;
}

static wt_material *table(void)
{
    double omega[KNOTS], storage[KNOTS], loss[KNOTS];
    wt_material *of = prony(12), *material = NULL;
    for (size_t i = 0; i < KNOTS; i++)
        omega[i] = 1e-2 * pow(10, 14 * (double)i / (KNOTS - 1));
    of->law->modulus(of, omega, KNOTS, storage, loss);
    assert_int_equal(
        wt_material_table(omega, storage, loss, KNOTS, 0.5, WT_EXTRAPOLATE_HOLD, &material, NULL),
        WT_OK);
    wt_material_free(of);
    return material;
}

/* The first n of the velocities from 0.1 mm/s to 10 m/s. */
static void compute(const wt_material *material, double tolerance, size_t n,
                    wt_friction_point *points)
{
    wt_roughness *road = NULL;
    wt_friction_workspace *ws = NULL;
    wt_friction_options options = wt_friction_defaults();
    double velocity[VELOCITIES];
    for (size_t i = 0; i < n; i++)
        velocity[i] = 1e-4 * pow(10, 5 * (double)i / (VELOCITIES - 1));
    options.tolerance = tolerance;
    assert_int_equal(wt_roughness_self_affine(500, 2000, 1e6, 0.8, 6e-16, &road, NULL), WT_OK);
    assert_int_equal(wt_friction_workspace_new(material, road, &options, &ws, NULL), WT_OK);
    assert_int_equal(wt_friction_compute(ws, 3e5, velocity, n, points, NULL), WT_OK);
    wt_friction_workspace_free(ws);
    wt_roughness_free(road);
}

/* Mean number of nodes per velocity; the result is within the stated error of the tight
 * tolerance. */
static double nodes_at(const wt_material *material, double tolerance,
                       const wt_friction_point *tight)
{
    wt_friction_point points[VELOCITIES];
    size_t nodes = 0;
    compute(material, tolerance, VELOCITIES, points);
    for (size_t i = 0; i < VELOCITIES; i++) {
        const wt_estimate mu = points[i].hysteresis;
        assert_true(points[i].meets_tolerance);
        assert_true(fabs(mu.value - tight[i].hysteresis.value) <= mu.numerical_error);
        nodes += points[i].nodes;
    }
    return (double)nodes / VELOCITIES;
}

static void nodes_follow_the_tolerance(void **state)
{
    (void)state;
    wt_material *const materials[] = {prony(12), table()};
    /* nodes of the accepted rules: smaller rules have fewer, and more subintervals are repeated */
    const double most[][3] = {{62, 122, 157}, {225, 350, 370}};
    for (size_t m = 0; m < 2; m++) {
        wt_friction_point tight[VELOCITIES];
        const double tolerances[] = {1e-2, 1e-6, 1e-10};
        compute(materials[m], 1e-13, VELOCITIES, tight);
        for (size_t i = 0; i < 3; i++) {
            const double nodes = nodes_at(materials[m], tolerances[i], tight);
            if (!(nodes <= most[m][i]))
                fail_msg("material %zu, tolerance %g: %g nodes", m, tolerances[i], nodes);
        }
        wt_material_free(materials[m]);
    }
}

/* ---- knots ----------------------------------------------------------------------------------- */

enum { DENSE = 20000 };

/* A power law over eight decades, with the end values extrapolated. */
static void power_law(size_t knots, wt_friction_point *point)
{
    double *omega = calloc(knots, sizeof *omega), *storage = calloc(knots, sizeof *storage),
           *loss = calloc(knots, sizeof *loss);
    wt_material *material = NULL;
    assert_true(omega != NULL && storage != NULL && loss != NULL);
    for (size_t i = 0; i < knots; i++) {
        const double part = (double)i / (double)(knots - 1);
        omega[i] = pow(10, -1 + 8 * part);
        storage[i] = 1e6 * pow(10, 2 * part);
        loss[i] = 2e5 * pow(10, 2.5 * part);
    }
    assert_int_equal(
        wt_material_table(omega, storage, loss, knots, 0.5, WT_EXTRAPOLATE_HOLD, &material, NULL),
        WT_OK);
    compute(material, 1e-10, 1, point);
    assert_true(point->meets_tolerance);
    wt_material_free(material);
    free(omega);
    free(storage);
    free(loss);
}

static void assert_same(wt_estimate a, wt_estimate b)
{
    /* knots are rounded, each moduli by an ulp */
    const double rounding = 1e-14 * fabs(a.value);
    assert_true(fabs(a.value - b.value) <= a.numerical_error + b.numerical_error + rounding);
}

/* Knots on a straight line change nothing. As many as here must not make the time grow
 * quadratically; it was half a minute. */
static void collinear_knots_change_nothing(void **state)
{
    (void)state;
    wt_friction_point few, many;
    power_law(2, &few);
    power_law(DENSE, &many);
    assert_same(few.stress_variance, many.stress_variance);
    assert_same(few.hysteresis, many.hysteresis);
    assert_same(few.area_ratio, many.area_ratio);
}

/* ---- independence of velocities -------------------------------------------------------------- */

/* The digits of a velocity are independent of the other velocities and their number; 0 is among
 * them. */
static void velocities_are_independent(void **state)
{
    (void)state;
    wt_material *const materials[] = {prony(5), prony(12), prony(40), table()};
    for (size_t m = 0; m < 4; m++) {
        wt_friction_point alone, many[VELOCITIES];
        compute(materials[m], 1e-10, VELOCITIES, many);
        for (size_t n = 1; n < 12; n += 5) {
            wt_friction_point some[VELOCITIES];
            compute(materials[m], 1e-10, n, some);
            alone = some[n - 1];
            assert_true(alone.hysteresis.value == many[n - 1].hysteresis.value);
            assert_true(alone.stress_variance.value == many[n - 1].stress_variance.value);
            assert_true(alone.hysteresis.numerical_error == many[n - 1].hysteresis.numerical_error);
        }
        wt_material_free(materials[m]);
    }
}

/* ---- a closed form of many terms ------------------------------------------------------------- */

static const wt_material_law *counted;
static size_t evaluations;

static void count(const wt_material *material, const double *omega, size_t n, double *j1,
                  double *j2)
{
    evaluations += n;
    counted->angular(material, omega, n, j1, j2);
}

static void many_terms(void **state)
{
    (void)state;
    wt_material *material = prony(MOST);
    wt_friction_point alone, many[VELOCITIES];
    counted = material->law;
    wt_material_law law = *counted;
    law.angular = count;
    material->law = &law;
    for (double tolerance = 1e-2; tolerance > 1e-13; tolerance /= 100) {
        evaluations = 0;
        compute(material, tolerance, VELOCITIES, many);
        assert_true(evaluations > 0 && evaluations < 10 * VELOCITIES);
        compute(material, tolerance, 1, &alone);
        assert_true(alone.meets_tolerance && many[0].meets_tolerance);
        assert_true(fabs(alone.hysteresis.value - many[0].hysteresis.value) <=
                    many[0].hysteresis.numerical_error);
        assert_true(fabs(alone.area_ratio.value - many[0].area_ratio.value) <=
                    many[0].area_ratio.numerical_error);
    }
    material->law = counted;
    wt_material_free(material);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nodes_follow_the_tolerance),
                                       cmocka_unit_test(collinear_knots_change_nothing),
                                       cmocka_unit_test(velocities_are_independent),
                                       cmocka_unit_test(many_terms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
