/* Friction on anisotropic roughness: numeric cases, and required relations. */
#include "assert_near.h"

#include "friction/numerics/angular.h"
#include "numeric/friction_scene.h"
#include "weartrack/friction.h"

#include <float.h>

enum { TERMS = 12, KNOTS = 5 };
static const double terms[TERMS] = {1e6, 1.2e6, 1.6e6, 2.4e6, 4e6, 8e6,
                                    2e7, 6e7,   2e8,   5e8,   7e8, 4e8};
static const double times[TERMS] = {1,    0.1,  1e-2, 1e-3, 1e-4,  1e-5,
                                    1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11};
static const double knots[KNOTS] = {1e-2, 1, 1e3, 1e5, 1e9},
                    storage[KNOTS] = {5e6, 6e6, 2e7, 3e8, 2e9},
                    loss[KNOTS] = {3e5, 1e6, 9e6, 2e8, 3e8};
static const double strains[3] = {1e-4, 1e-2, 1}, f[3] = {1, 0.8, 0.3}, g[3] = {1, 0.9, 0.4};

static scene road(law_kind law)
{
    return (scene){.law = law,
                   .n = law == PRONY ? TERMS : KNOTS,
                   .e0 = 5e6,
                   .e = law == PRONY ? terms : storage,
                   .tau = law == PRONY ? times : knots,
                   .loss = loss,
                   .nu = 0.5,
                   .pressure = 3e5,
                   .velocity = 0.01,
                   .gamma = 1,
                   .q0 = 500,
                   .qr = 2000,
                   .q1 = 1e6,
                   .hurst = 0.8,
                   .c0 = 6e-16,
                   .strain = strains,
                   .f = f,
                   .g = g,
                   .strain_factor = 1};
}

static wt_anisotropy texture(double second, double fourth, double degrees)
{
    const double angle = degrees * M_PI / 180;
    return (wt_anisotropy){.amplitude = {second, fourth}, .angle = {angle, angle}};
}

static wt_friction_point solve(const scene *s, wt_anisotropy anisotropy, double tolerance)
{
    wt_friction_options options = wt_friction_defaults();
    const wt_softening softening = scene_softening(s);
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *ws = NULL;
    wt_friction_point point;
    wt_error err = WT_ERROR_INIT;
    options.tolerance = tolerance;
    options.gamma = s->gamma;
    options.anisotropy = anisotropy;
    options.layer.thickness = s->thickness;
    options.layer.modulus_ratio = s->thickness > 0 ? s->ratio : 1;
    if (softening.n > 0)
        options.softening = &softening;
    assert_int_equal(scene_material(s, &material, &err), WT_OK);
    assert_int_equal(scene_roughness(s, &roughness, &err), WT_OK);
    if (wt_friction_workspace_new(material, roughness, &options, &ws, &err) != WT_OK)
        fail_msg("%s", err.message);
    if (wt_friction_compute(ws, s->pressure, &s->velocity, 1, &point, &err) != WT_OK)
        fail_msg("%s", err.message);
    wt_friction_workspace_free(ws);
    wt_roughness_free(roughness);
    wt_material_free(material);
    return point;
}

/* ---- numeric cases --------------------------------------------------------------------------- */

/* The reference has 13 digits. */
static const double of_reference = 1e-13;

static void check_bound(const char *name, double tolerance, const char *what, wt_estimate actual,
                        double expected)
{
    const double off = fabs(actual.value - expected);
    if (!(off <= actual.numerical_error + of_reference * fabs(expected)))
        fail_msg("%s at %g: %s %.17g is %.3g from %.17g, but %.3g is stated", name, tolerance, what,
                 actual.value, off, expected, actual.numerical_error);
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction-anisotropy.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    case_scene *made = malloc(sizeof *made);
    assert_true(in != NULL && c != NULL && made != NULL);
    size_t n = 0;
    for (; case_read(in, c); n++) {
        case_to_scene(c, made);
        const wt_anisotropy a =
            texture(case_number(c, false, "amplitude_2", 0),
                    case_number(c, false, "amplitude_4", 0), case_number(c, false, "angle_deg", 0));
        const double variance = case_number(c, true, "stress_variance", (double)NAN);
        const double area = case_number(c, true, "area_ratio", (double)NAN);
        const double hysteresis = case_number(c, true, "hysteresis", (double)NAN);
        const double side = case_number(c, true, "side", (double)NAN);
        const wt_friction_point p = solve(&made->s, a, 1e-13);
        assert_near(p.stress_variance.value, variance, 1e-12);
        assert_near(p.area_ratio.value, area, 1e-12);
        assert_near(p.hysteresis.value, hysteresis, 1e-12);
        assert_near(p.lateral.value, side, 1e-12);
        for (double tolerance = 1e-2; tolerance > 1e-13; tolerance *= 0.1) {
            const wt_friction_point q = solve(&made->s, a, tolerance);
            check_bound(c->name, tolerance, "G", q.stress_variance, variance);
            check_bound(c->name, tolerance, "P", q.area_ratio, area);
            check_bound(c->name, tolerance, "mu", q.hysteresis, hysteresis);
            check_bound(c->name, tolerance, "side", q.lateral, side);
            if (tolerance > 1e-11) {
                assert_true(q.meets_tolerance);
                assert_true(q.lateral.numerical_error <= 4 * tolerance * hysteresis);
            }
        }
    }
    assert_int_equal(n, 18);
    free(made);
    free(c);
    fclose(in);
}

/* ---- laws ------------------------------------------------------------------------------------ */

static void none_is_isotropic_to_the_bit(void **state)
{
    (void)state;
    for (law_kind law = PRONY; law <= TABLE; law++) {
        const scene s = road(law);
        const wt_friction_point plain = solve(&s, (wt_anisotropy){{0}, {0}}, 1e-10);
        const wt_friction_point turned = solve(&s, texture(0, 0, 30), 1e-10);
        assert_memory_equal(&plain.hysteresis.value, &turned.hysteresis.value, sizeof(double));
        assert_memory_equal(&plain.hysteresis.numerical_error, &turned.hysteresis.numerical_error,
                            sizeof(double));
        assert_memory_equal(&plain.stress_variance.value, &turned.stress_variance.value,
                            sizeof(double));
        assert_int_equal(plain.nodes, turned.nodes);
        assert_true(turned.lateral.value == 0 && turned.lateral.numerical_error == 0);
    }
}

/* Half a turn changes nothing. In the opposite direction the lateral force changes its sign, and so
 * it does backwards. */
static void directions(void **state)
{
    (void)state;
    scene s = road(PRONY);
    const wt_friction_point p = solve(&s, texture(0.6, 0.2, 20), 1e-10);
    const wt_friction_point half = solve(&s, texture(0.6, 0.2, 200), 1e-10);
    const wt_friction_point mirrored = solve(&s, texture(0.6, 0.2, -20), 1e-10);
    assert_near(half.hysteresis.value, p.hysteresis.value, 1e-12);
    assert_near(half.lateral.value, p.lateral.value, 1e-12);
    assert_near(mirrored.hysteresis.value, p.hysteresis.value, 1e-12);
    assert_near(mirrored.lateral.value, -p.lateral.value, 1e-12);
    assert_true(p.lateral.value > 0.01);
    /* a negative amplitude a quarter turn away is equivalent */
    const wt_friction_point less = solve(&s, texture(-0.6, 0, 90), 1e-10),
                            more = solve(&s, texture(0.6, 0, 0), 1e-10);
    assert_near(less.hysteresis.value, more.hysteresis.value, 1e-12);
    assert_true(less.lateral.value == 0 && more.lateral.value == 0);
    s.velocity = -s.velocity;
    const wt_friction_point back = solve(&s, texture(0.6, 0.2, 20), 1e-10);
    assert_near(back.hysteresis.value, -p.hysteresis.value, 1e-14);
    assert_near(back.lateral.value, -p.lateral.value, 1e-14);
}

/* In full contact friction is linear in the spectrum: the changes in two directions a quarter turn
 * apart cancel. With sin(phi) sin(2 phi) = cos(phi) (1 - cos(2 phi)), the lateral force at 45 deg
 * and the friction at 0 add up to the whole. */
static void full_contact_is_linear(void **state)
{
    (void)state;
    const struct {
        law_kind law;
        double thickness;
        size_t n_strain;
    } kinds[] = {{PRONY, 0, 0}, {TABLE, 0, 0}, {PRONY, 1e-5, 0}, {PRONY, 0, 3}, {TABLE, 0, 3}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        scene s = road(kinds[i].law);
        s.thickness = kinds[i].thickness;
        s.ratio = 3;
        s.n_strain = kinds[i].n_strain;
        s.pressure = 1e12;
        const double a = 0.7;
        const double all = solve(&s, texture(0, 0, 0), 1e-11).hysteresis.value;
        const wt_friction_point across = solve(&s, texture(a, 0, 0), 1e-11),
                                along = solve(&s, texture(a, 0, 90), 1e-11),
                                skew = solve(&s, texture(a, 0, 45), 1e-11);
        assert_near(across.hysteresis.value + along.hysteresis.value, 2 * all, 1e-10);
        assert_near(skew.hysteresis.value, all, 1e-10);
        assert_near(skew.lateral.value + across.hysteresis.value, (1 + a) * all, 1e-10);
        assert_true(across.hysteresis.value > 1.1 * all);
    }
}

/* The highest orders against sums over many angles: J1 and K of a spectrum with all four. */
static double modulus_loss(double omega)
{
    double sum = 0;
    for (size_t k = 0; k < TERMS; k++)
        sum += terms[k] * omega * times[k] / (1 + omega * times[k] * omega * times[k]);
    return sum;
}

static void all_orders(void **state)
{
    (void)state;
    const wt_anisotropy a = {.amplitude = {0.5, 0.25, -0.15, 0.1}, .angle = {0.3, -0.2, 0.5, 0.1}};
    /* midpoints: the loss at w cos(phi) is steep only where it is small */
    enum { ANGLES = 20000, WAVES = 60 };
    scene s = road(PRONY);
    s.pressure = 1e12; /* full contact: q^3 C J1 alone */
    s.qr = s.q0;
    s.q1 = 1.2 * s.q0;
    for (s.velocity = 1e-6; s.velocity < 1; s.velocity *= 100) {
        const wt_friction_point p = solve(&s, a, 1e-11);
        double along = 0, aside = 0;
        for (size_t i = 0; i < WAVES; i++) {
            const double width = log(s.q1 / s.q0) / WAVES;
            const double q = s.q0 * exp(width * ((double)i + 0.5));
            const double c = s.c0 * pow(q / s.qr, -2 * (1 + s.hurst));
            for (size_t k = 0; k < ANGLES; k++) {
                const double phi = 2 * M_PI * ((double)k + 0.25) / ANGLES;
                const double weight = width * 2 * M_PI / ANGLES * pow(q, 4) * c *
                                      modulus_loss(q * s.velocity * cos(phi)) *
                                      wt_anisotropy_density(&a, phi);
                along += weight * cos(phi);
                aside += weight * sin(phi);
            }
        }
        const double scale = 1 / (2 * s.pressure * (1 - s.nu * s.nu));
        assert_near(p.hysteresis.value, scale * along, 1e-6);
        assert_near(p.lateral.value, scale * aside, 1e-6);
        assert_true(fabs(p.lateral.value) > 0.05 * p.hysteresis.value);
    }
}

/* ---- grooves --------------------------------------------------------------------------------- */

static void groove_modulus(const wt_material *m, const double *omega, size_t n, double *e1,
                           double *e2)
{
    (void)m;
    for (size_t i = 0; i < n; i++) {
        e1[i] = 5e6;
        e2[i] = modulus_loss(omega[i]);
        for (size_t k = 0; k < TERMS; k++) {
            const double z = omega[i] * times[k];
            e1[i] += terms[k] * z * z / (1 + z * z);
        }
    }
}

/* All waves run along the velocity: C(q, phi) = C(q) pi [delta(phi) + delta(phi - pi)]. */
static void groove_angular(const wt_material *m, const double *omega, size_t n, double *j1,
                           double *j2)
{
    for (size_t i = 0; i < n; i++) {
        double e1, e2;
        groove_modulus(m, &omega[i], 1, &e1, &e2);
        j1[i] = 2 * M_PI * e2;
        j2[i] = 2 * M_PI * (e1 * e1 + e2 * e2);
    }
}

/* Perfect grooves across the velocity, whose profile has the spectrum C1: C = C1 / (pi q). This is
 * the limit of anisotropy of all orders, which four do not reach. */
static void grooves_across(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction-grooves.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    assert_true(in != NULL && c != NULL && case_read(in, c));
    fclose(in);
    static const wt_material_law law = {
        .name = "grooves", .modulus = groove_modulus, .angular = groove_angular};
    const wt_material material = {.law = &law,
                                  .poisson_ratio = 0.5,
                                  .frequency_min = (double)NAN,
                                  .frequency_max = (double)NAN};
    const double q[3] = {500, 2000, 1e6}, velocity = case_number(c, false, "velocity", 0);
    double density[3];
    for (size_t i = 0; i < 3; i++)
        density[i] = 1e-12 * (i < 2 ? 1 : pow(q[i] / 2000, -2.6)) / (M_PI * q[i]);
    wt_friction_options options = wt_friction_defaults();
    options.tolerance = 1e-13;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *ws = NULL;
    wt_friction_point p;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_roughness_table(q, density, 3, &roughness, &err), WT_OK);
    assert_int_equal(wt_friction_workspace_new(&material, roughness, &options, &ws, &err), WT_OK);
    assert_int_equal(
        wt_friction_compute(ws, case_number(c, false, "pressure", 0), &velocity, 1, &p, &err),
        WT_OK);
    assert_near(p.stress_variance.value, case_number(c, true, "stress_variance", 0), 1e-12);
    assert_near(p.area_ratio.value, case_number(c, true, "area_ratio", 0), 1e-12);
    assert_near(p.hysteresis.value, case_number(c, true, "hysteresis", 0), 1e-12);
    wt_friction_workspace_free(ws);
    wt_roughness_free(roughness);
    free(c);
}

static void impossible_input(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    wt_anisotropy a = texture(1, 0, 30);
    assert_int_equal(wt_anisotropy_check(&a, &err), WT_OK);
    a = texture(0.9, -0.9, 0);
    assert_int_equal(wt_anisotropy_check(&a, &err), WT_E_RANGE);
    a = texture(1.2, 0, 0);
    assert_int_equal(wt_anisotropy_check(&a, &err), WT_E_RANGE);
    a = texture(1.2, 0.3, 0);
    assert_int_equal(wt_anisotropy_check(&a, &err), WT_OK);
    a.amplitude[3] = (double)NAN;
    assert_int_equal(wt_anisotropy_check(&a, &err), WT_E_RANGE);
}

/* No closed form is left, so there is no static limit. */
static void no_static_limit(void **state)
{
    (void)state;
    const scene s = road(PRONY);
    wt_friction_options options = wt_friction_defaults();
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *ws = NULL;
    wt_friction_point point;
    wt_error err = WT_ERROR_INIT;
    const double still = 0;
    options.anisotropy = texture(0.5, 0, 0);
    assert_int_equal(scene_material(&s, &material, &err), WT_OK);
    assert_int_equal(scene_roughness(&s, &roughness, &err), WT_OK);
    assert_int_equal(wt_friction_workspace_new(material, roughness, &options, &ws, &err), WT_OK);
    assert_int_equal(wt_friction_compute(ws, s.pressure, &still, 1, &point, &err), WT_E_RANGE);
    assert_non_null(strstr(err.advice, "anisotropic"));
    wt_friction_workspace_free(ws);
    wt_roughness_free(roughness);
    wt_material_free(material);
}

/* Maximum over phi of the terms of the weight over their sum, by quadrature. */
static double worst_terms(const double power[WEIGHT_POWERS])
{
    enum { STEPS = 20000 };
    double worst = 1;
    for (int p = 0; p <= 2; p++) {
        double sum = 0, all = 0;
        for (int j = 0; j < WEIGHT_POWERS; j++) {
            double moment = 0;
            for (int i = 0; i < STEPS; i++)
                moment += pow(cos((i + 0.5) * M_PI / 2 / STEPS), p + 2 * j) / STEPS;
            sum += power[j] * moment;
            all += fabs(power[j]) * moment;
        }
        worst = fmax(worst, all / sum);
    }
    return worst;
}

/* Factor of the errors: where terms cancel they are larger than without a weight. */
static void error_factor_of_weights(void **state)
{
    (void)state;
    const wt_anisotropy across = {.amplitude = {0.8}, .angle = {M_PI / 2}},
                        along = {.amplitude = {0.8}, .angle = {0}},
                        askew = {.amplitude = {0.5, 0.3}, .angle = {0.7, 0.2}};
    double shift = 0;
    /* (1 + a + 2 a r) / (1 + a - 2 a r), r = 3/4 for E'' proportional to the frequency squared */
    assert_near(weight_longitudinal(&across).cancellation, (1 + 2.5 * 0.8) / (1 - 0.5 * 0.8),
                1e-12);
    assert_near(weight_longitudinal(&along).cancellation, 1, 1e-12);
    const angular_weight to_the_side = weight_lateral(&askew, &shift),
                         ahead = weight_longitudinal(&askew);
    assert_near(ahead.cancellation, worst_terms(ahead.power[0]), 1e-6);
    assert_near(to_the_side.cancellation, worst_terms(to_the_side.power[0]), 1e-6);
    assert_true(ahead.cancellation > 1.1 && to_the_side.cancellation > 1.1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numeric_cases),
        cmocka_unit_test(none_is_isotropic_to_the_bit),
        cmocka_unit_test(directions),
        cmocka_unit_test(full_contact_is_linear),
        cmocka_unit_test(all_orders),
        cmocka_unit_test(grooves_across),
        cmocka_unit_test(error_factor_of_weights),
        cmocka_unit_test(impossible_input),
        cmocka_unit_test(no_static_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
