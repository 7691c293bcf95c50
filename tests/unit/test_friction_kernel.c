/* Friction against numeric cases, its stated errors, and required relations. */
#include "assert_near.h"

#include "friction/numerics/persson_contact.h"
#include "numeric/friction_scene.h"
#include "weartrack/friction.h"

#include <float.h>

typedef struct rig {
    numeric_case *c;
    wt_material *material;
    wt_roughness *roughness;
    double pressure, velocity, gamma;
} rig;

static void rig_free(rig *r)
{
    wt_material_free(r->material);
    wt_roughness_free(r->roughness);
    free(r->c);
}

static void rig_set(rig *r)
{
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(friction_case_material(r->c, &r->material, &err), WT_OK);
    assert_int_equal(friction_case_roughness(r->c, &r->roughness, &err), WT_OK);
    r->pressure = case_number(r->c, false, "pressure", 0);
    r->velocity = case_number(r->c, false, "velocity", 0);
    r->gamma = case_number(r->c, false, "gamma", 1);
}

static FILE *open_cases(void)
{
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction.txt", "r");
    assert_non_null(in);
    return in;
}

/* Material and roughness of a named case. */
static rig rig_named(const char *name)
{
    rig r = {.c = malloc(sizeof *r.c)};
    assert_non_null(r.c);
    FILE *in = open_cases();
    bool found = false;
    while (!found && case_read(in, r.c))
        found = strcmp(r.c->name, name) == 0;
    fclose(in);
    assert_true(found);
    rig_set(&r);
    return r;
}

static wt_friction_workspace *prepare(const rig *r, double tolerance, unsigned threads)
{
    wt_friction_options options = wt_friction_defaults();
    options.tolerance = tolerance;
    options.gamma = r->gamma;
    options.threads = threads;
    wt_friction_workspace *ws = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_friction_workspace_new(r->material, r->roughness, &options, &ws, &err),
                     WT_OK);
    return ws;
}

static wt_friction_point solve(const rig *r, double tolerance)
{
    wt_friction_workspace *ws = prepare(r, tolerance, 1);
    wt_friction_point point;
    assert_int_equal(wt_friction_compute(ws, r->pressure, &r->velocity, 1, &point, NULL), WT_OK);
    wt_friction_workspace_free(ws);
    return point;
}

/* ---- numeric cases --------------------------------------------------------------------------- */

static void check_bound(const char *name, const char *what, wt_estimate actual, double expected)
{
    if (!(fabs(actual.value - expected) <= actual.numerical_error))
        fail_msg("%s: %s %.17g is %.3g from %.17g, but %.3g is stated", name, what, actual.value,
                 fabs(actual.value - expected), expected, actual.numerical_error);
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = open_cases();
    size_t n = 0;
    rig r = {.c = malloc(sizeof *r.c)};
    assert_non_null(r.c);
    while (case_read(in, r.c)) {
        rig_set(&r);
        const wt_friction_point p = solve(&r, wt_friction_defaults().tolerance);
        const double variance = case_number(r.c, true, "stress_variance", 0);
        const double area = case_number(r.c, true, "area_ratio", 0);
        const double gap = case_number(r.c, true, "one_minus_area", 0);
        const double hysteresis = case_number(r.c, true, "hysteresis", 0);
        assert_near(p.stress_variance.value, variance, 1e-10);
        assert_near(p.area_ratio.value, area, 1e-10);
        assert_near(p.one_minus_area.value, gap, 1e-10);
        assert_near(p.hysteresis.value, hysteresis, 1e-10);
        assert_true(p.meets_tolerance);

        const wt_friction_point tight = solve(&r, 1e-13);
        assert_near(tight.stress_variance.value, variance, 1e-12);
        assert_near(tight.area_ratio.value, area, 1e-12);
        assert_near(tight.one_minus_area.value, gap, 1e-12);
        assert_near(tight.hysteresis.value, hysteresis, 1e-12);

        for (double tolerance = 1e-4; tolerance > 1e-13; tolerance *= 0.1) {
            const wt_friction_point q = solve(&r, tolerance);
            check_bound(r.c->name, "G", q.stress_variance, variance);
            check_bound(r.c->name, "P", q.area_ratio, area);
            check_bound(r.c->name, "1-P", q.one_minus_area, gap);
            check_bound(r.c->name, "mu", q.hysteresis, hysteresis);
            if (q.meets_tolerance) {
                assert_true(q.hysteresis.numerical_error <= tolerance * q.hysteresis.value);
                assert_true(q.area_ratio.numerical_error <= tolerance * q.area_ratio.value);
                assert_true(q.stress_variance.numerical_error <=
                            tolerance * q.stress_variance.value);
            }
        }
        wt_material_free(r.material);
        wt_roughness_free(r.roughness);
        n++;
    }
    assert_int_equal(n, 19);
    free(r.c);
    fclose(in);
}

/* The contact area as a function of magnification, up to the full range of wavenumbers. */
static void numeric_profiles(void **state)
{
    (void)state;
    FILE *in = open_cases();
    rig r = {.c = malloc(sizeof *r.c)};
    assert_non_null(r.c);
    size_t n = 0;
    while (case_read(in, r.c)) {
        rig_set(&r);
        double q[16];
        const case_line *lines[16];
        size_t points = 0;
        for (size_t i = 0; i < r.c->n; i++)
            if (r.c->lines[i].expected && strcmp(r.c->lines[i].key, "at") == 0) {
                lines[points] = &r.c->lines[i];
                q[points++] = r.c->lines[i].value[0];
            }
        wt_friction_workspace *ws = prepare(&r, 1e-10, 1);
        wt_friction_node nodes[16];
        assert_int_equal(wt_friction_profile(ws, r.pressure, r.velocity, q, points, nodes, NULL),
                         WT_OK);
        for (size_t i = 0; i < points; i++, n++) {
            assert_near(nodes[i].stress_variance, lines[i]->value[1], 1e-10);
            assert_near(nodes[i].area_ratio, lines[i]->value[2], 1e-10);
            assert_near(nodes[i].hysteresis, lines[i]->value[3], 1e-10);
            assert_true(fabs(nodes[i].area_ratio - lines[i]->value[2]) <= nodes[i].numerical_error);
        }
        wt_friction_workspace_free(ws);
        wt_material_free(r.material);
        wt_roughness_free(r.roughness);
    }
    assert_int_equal(n, 10);
    free(r.c);
    fclose(in);
}

/* Limits of the profile: zero at q0, the total at q1. */
static void profile_ends(void **state)
{
    (void)state;
    rig r = rig_named("normal_table_hold");
    wt_friction_workspace *ws = prepare(&r, 1e-10, 1);
    const wt_friction_point all = solve(&r, 1e-10);
    const double q[] = {500, 500, 1000, 5e5, 1e6};
    wt_friction_node nodes[5];
    assert_int_equal(wt_friction_profile(ws, r.pressure, -r.velocity, q, 5, nodes, NULL), WT_OK);
    assert_near(nodes[0].area_ratio, 1, 0);
    assert_near(nodes[1].stress_variance, 0, 0);
    assert_near(nodes[4].stress_variance, all.stress_variance.value, 1e-10);
    assert_near(nodes[4].hysteresis, -all.hysteresis.value, 1e-10);
    wt_error err = WT_ERROR_INIT;
    const double falling[] = {1000, 600};
    assert_int_equal(wt_friction_profile(ws, r.pressure, r.velocity, falling, 2, nodes, &err),
                     WT_E_RANGE);
    assert_non_null(strstr(err.message, "wavenumber 2 of 2"));
    wt_friction_workspace_free(ws);
    rig_free(&r);
}

/* ---- closed forms ---------------------------------------------------------------------------- */

static void area_functions(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction-functions.txt", "r");
    assert_non_null(in);
    char line[512];
    size_t n = 0;
    while (fgets(line, sizeof line, in)) {
        double variance, area, gap, integral;
        if (sscanf(line, "area %lf %lf %lf %lf", &variance, &area, &gap, &integral) != 4)
            continue;
        assert_near(contact_area(variance), area, 4 * DBL_EPSILON);
        assert_near_abs(contact_gap(variance), gap, fmax(1e-14 * gap, DBL_MIN));
        assert_near(contact_integral(variance, 1), integral, 4 * DBL_EPSILON);
        n++;
    }
    fclose(in);
    assert_int_equal(n, 9);
}

/* Many areas at once, from full contact to almost none, including where the methods change. */
static void many_areas_at_once(void **state)
{
    (void)state;
    enum { MANY = 700 };
    double variance[MANY + CONTACT_PADDING], area[MANY + CONTACT_PADDING];
    for (size_t n = MANY; n > 0; n = 2 * n / 3) {
        for (size_t i = 0; i < n; i++)
            variance[i] = i == 0 ? 0 : pow(10, -3 + 15 * (double)i / (double)n);
        for (size_t i = n; i < n + CONTACT_PADDING; i++)
            variance[i] = (double)NAN;
        contact_areas(variance, n, area);
        for (size_t i = 0; i < n; i++)
            assert_near(area[i], (double)erfl(0.5L / sqrtl((long double)variance[i])),
                        3 * DBL_EPSILON);
    }
}

/* The effect of an error of G on P and on 1 - P is within the stated error, and close to it. */
static void errors_of_the_area(void **state)
{
    (void)state;
    for (double variance = 4e-4; variance < 1e9; variance *= 1.7)
        for (double e = 1e-13; e < 0.5; e *= 3) {
            const long double y = 0.5L / sqrtl((long double)variance);
            const long double far = y / sqrtl(1 - (long double)e),
                              near = y / sqrtl(1 + (long double)e);
            /* the one of both that keeps its digits */
            const long double low = y < 0.5L ? erfl(far) - erfl(y) : erfcl(y) - erfcl(far);
            const long double high = y < 0.5L ? erfl(y) - erfl(near) : erfcl(near) - erfcl(y);
            const double most = (double)fmaxl(low, high);
            const double of_area = contact_area_error(variance, e * variance);
            const double of_gap = contact_gap_error(variance, e * variance);
            assert_true(of_area >= most && of_gap >= most);
            assert_true(of_area <= 1.3 * most + 17 * DBL_EPSILON * contact_area(variance));
            assert_true(of_gap <= 1.3 * most + 2e-13 * contact_gap(variance) + DBL_MIN);
        }
}

/* int S P dG against its own derivative by a fine sum. */
static void area_integral_with_correction(void **state)
{
    (void)state;
    const double gamma = 0.45;
    const double from = 0.0385, to = 7.91;
    const int n = 4000;
    double sum = 0;
    for (int i = 0; i < n; i++) { /* midpoint rule in ln G */
        const double variance = from * pow(to / from, (i + 0.5) / n);
        const double area = contact_area(variance);
        sum += variance * area * (gamma + (1 - gamma) * area * area);
    }
    sum *= log(to / from) / n;
    assert_near(contact_integral(to, gamma) - contact_integral(from, gamma), sum, 1e-6);
}

/* ---- laws ------------------------------------------------------------------------------------ */

static void odd_in_velocity(void **state)
{
    (void)state;
    rig r = rig_named("normal_prony_v1e-2");
    wt_friction_workspace *ws = prepare(&r, 1e-10, 1);
    const double velocity[] = {0.0385, -0.0385, 0};
    wt_friction_point p[3];
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(wt_friction_compute(ws, r.pressure, &velocity[i], 1, &p[i], NULL), WT_OK);
    assert_near(p[1].hysteresis.value, -p[0].hysteresis.value, 0);
    assert_near(p[1].stress_variance.value, p[0].stress_variance.value, 0);
    assert_near(p[2].hysteresis.value, 0, 0);
    assert_true(p[2].stress_variance.value > 0 && p[2].meets_tolerance);

    /* computed together: each begins where the previous one ends, and the last digits differ */
    const double alone = p[0].hysteresis.value;
    assert_int_equal(wt_friction_compute(ws, r.pressure, velocity, 3, p, NULL), WT_OK);
    assert_true(fabs(p[0].hysteresis.value - alone) <= p[0].hysteresis.numerical_error);
    assert_true(fabs(p[1].hysteresis.value + alone) <= p[1].hysteresis.numerical_error);
    wt_friction_workspace_free(ws);
    rig_free(&r);
}

/* (E, sigma0) -> (s E, s sigma0) and (q, C, v) -> (s q, C / s^4, v / s) change nothing. */
static void scalings(void **state)
{
    (void)state;
    const double s = 7.3;
    double e[] = {3e6, 4e7, 5e8}, tau[] = {1e-3, 1e-5, 1e-7};
    wt_prony prony = {.equilibrium_modulus = 2.385e6, .n = 3, .relaxation_time = tau, .modulus = e};
    prony.frequency_min = prony.frequency_max = (double)NAN;
    rig r = {.pressure = 2.9e5, .velocity = 0.31, .gamma = 0.5};
    assert_int_equal(wt_material_prony(&prony, 0.47, &r.material, NULL), WT_OK);
    assert_int_equal(wt_roughness_self_affine(740, 1900, 3e6, 0.83, 3e-16, &r.roughness, NULL),
                     WT_OK);
    const wt_friction_point plain = solve(&r, 1e-12);
    wt_roughness_free(r.roughness);
    assert_int_equal(wt_roughness_self_affine(s * 740, s * 1900, s * 3e6, 0.83,
                                              3e-16 / (s * s * s * s), &r.roughness, NULL),
                     WT_OK);
    r.velocity /= s;
    const wt_friction_point finer = solve(&r, 1e-12);
    assert_near(finer.hysteresis.value, plain.hysteresis.value, 1e-12);
    assert_near(finer.area_ratio.value, plain.area_ratio.value, 1e-12);
    wt_material_free(r.material);
    prony.equilibrium_modulus *= s;
    for (size_t i = 0; i < 3; i++)
        e[i] *= s;
    assert_int_equal(wt_material_prony(&prony, 0.47, &r.material, NULL), WT_OK);
    r.pressure *= s;
    const wt_friction_point stiffer = solve(&r, 1e-12);
    assert_near(stiffer.hysteresis.value, plain.hysteresis.value, 1e-12);
    assert_near(stiffer.stress_variance.value, plain.stress_variance.value, 1e-12);
    rig_free(&r);
}

/* Where P is 1, mu and G are proportional to C; and always mu <= 4 sigma0 max(J1 / J2) int P dG.
 * One Maxwell element has J1 = 2 pi E s and J2 = 2 pi E^2 a s with a = omega tau. */
static void linear_and_bounded(void **state)
{
    (void)state;
    double e = 1e9, tau = 1e-6;
    const wt_prony prony = {.n = 1, .relaxation_time = &tau, .modulus = &e};
    rig r = {.pressure = 3e5, .velocity = 0.01, .gamma = 1};
    assert_int_equal(wt_material_prony(&prony, 0, &r.material, NULL), WT_OK);
    wt_friction_point p[3];
    const double c0[] = {1e-30, 2e-30, 1e-13};
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(wt_roughness_self_affine(500, 2e3, 1e6, 0.8, c0[i], &r.roughness, NULL),
                         WT_OK);
        p[i] = solve(&r, 1e-12);
        wt_roughness_free(r.roughness);
    }
    assert_near(p[0].area_ratio.value, 1, 0);
    assert_near(p[1].hysteresis.value, 2 * p[0].hysteresis.value, 4 * DBL_EPSILON);
    assert_near(p[1].stress_variance.value, 2 * p[0].stress_variance.value, 4 * DBL_EPSILON);
    const double most = 1 / (e * 500 * r.velocity * tau); /* at q0 */
    const double bound = 4 * r.pressure * most * contact_integral(p[2].stress_variance.value, 1);
    assert_true(p[2].area_ratio.value < 0.5);
    assert_true(p[2].hysteresis.value < bound && p[2].hysteresis.value > 1e-4 * bound);
    wt_material_free(r.material);
}

/* The 12 terms of the cases, multiplied by factors. */
static wt_material *transverse(double axial_storage, double axial_loss, double plane_storage,
                               double plane_loss, double nu_p, double nu_zp)
{
    rig r = rig_named("normal_prony_v1e-2");
    wt_transverse t = wt_transverse_defaults();
    t.axial_storage = axial_storage;
    t.axial_loss = axial_loss;
    t.plane_storage = plane_storage;
    t.plane_loss = plane_loss;
    t.plane_poisson = nu_p;
    t.axial_poisson = nu_zp;
    wt_material *made = NULL;
    assert_int_equal(wt_material_transverse(r.material, NULL, NULL, &t, 0.3, &made, NULL), WT_OK);
    r.material = NULL;
    rig_free(&r);
    return made;
}

/* Scaled moduli and pressure change nothing. Without loss there is no friction. The sign is that of
 * the velocity. The isotropic solid of the stated moduli has no effect. */
static void transverse_laws(void **state)
{
    (void)state;
    rig r = rig_named("ti_R1_storage");
    const wt_friction_point plain = solve(&r, 1e-12);
    wt_material_free(r.material);
    const double s = 7.3;
    r.material = transverse(2.5, 1, 1, 1, 0.49, 0.49); /* as for nu = 0.3 */
    const wt_friction_point other = solve(&r, 1e-12);
    assert_near(other.hysteresis.value, plain.hysteresis.value, 3e-14);
    r.velocity = -r.velocity;
    const wt_friction_point back = solve(&r, 1e-12);
    assert_near(back.hysteresis.value, -other.hysteresis.value, 0);
    r.velocity = -r.velocity;
    wt_material_free(r.material);
    wt_transverse t = wt_transverse_defaults();
    t.axial_storage = 2.5 * s;
    t.axial_loss = t.plane_storage = t.plane_loss = t.shear_storage = t.shear_loss = s;
    t.plane_poisson = t.axial_poisson = 0.49;
    rig base = rig_named("normal_prony_v1e-2");
    assert_int_equal(wt_material_transverse(base.material, NULL, NULL, &t, 0.5, &r.material, NULL),
                     WT_OK);
    base.material = NULL;
    rig_free(&base);
    r.pressure *= s;
    const wt_friction_point stiffer = solve(&r, 1e-12);
    assert_near(stiffer.hysteresis.value, plain.hysteresis.value, 1e-12);
    assert_near(stiffer.stress_variance.value, plain.stress_variance.value, 1e-12);
    rig_free(&r);
    r = rig_named("elastic");
    wt_material *law = r.material;
    t = wt_transverse_defaults();
    t.axial_storage = 3;
    assert_int_equal(wt_material_transverse(law, NULL, NULL, &t, 0.4, &r.material, NULL), WT_OK);
    const wt_friction_point elastic = solve(&r, 1e-12);
    assert_near(elastic.hysteresis.value, 0, 0);
    assert_true(elastic.stress_variance.value > 0 && elastic.meets_tolerance);
    rig_free(&r);
}

/* With all factors 1 and equal Poisson ratios the result is that of the isotropic solid, bit by
 * bit. */
static void isotropic_limit(void **state)
{
    (void)state;
    const double nu[] = {0, 0.3, 0.49, 0.5};
    for (size_t i = 0; i < 4; i++) {
        rig r = rig_named("ti_isotropic_limit");
        wt_material_free(r.material);
        r.material = transverse(1, 1, 1, 1, nu[i], nu[i]);
        const wt_friction_point p = solve(&r, 1e-12);
        wt_material_free(r.material);
        rig base = rig_named("normal_prony_v1e-2");
        r.material = base.material;
        r.material->poisson_ratio = nu[i];
        base.material = NULL;
        rig_free(&base);
        const wt_friction_point q = solve(&r, 1e-12);
        assert_memory_equal(&p, &q, offsetof(wt_friction_point, extrapolated_share));
        /* stiffer along its axis by one in ten thousand: a small change in that direction */
        wt_material_free(r.material);
        r.material = transverse(1.0001, 1.0001, 1, 1, nu[i], nu[i]);
        const wt_friction_point near = solve(&r, 1e-12);
        assert_near(near.hysteresis.value, q.hysteresis.value, 1e-4);
        assert_near(near.stress_variance.value, q.stress_variance.value, 1e-3);
        assert_true(near.stress_variance.value > q.stress_variance.value);
        rig_free(&r);
    }
}

/* Figures 3.3 and 3.4 of the thesis: more loss raises friction, more storage lowers friction and
 * most of the contact area. */
static void trends_of_reinforcement(void **state)
{
    (void)state;
    rig r = rig_named("ti_isotropic_limit");
    for (double velocity = 1e-4; velocity < 2; velocity *= 100) {
        wt_friction_point p[3];
        const double factor[3][2] = {{1, 1}, {2.5, 1}, {1, 2.5}};
        r.velocity = velocity;
        for (size_t i = 0; i < 3; i++) {
            wt_material_free(r.material);
            r.material = transverse(factor[i][0], factor[i][1], 1, 1, 0.49, 0.49);
            p[i] = solve(&r, 1e-10);
        }
        assert_true(p[2].hysteresis.value > 1.1 * p[0].hysteresis.value);
        assert_true(p[1].hysteresis.value < p[0].hysteresis.value);
        assert_true(p[1].area_ratio.value < 0.9 * p[0].area_ratio.value);
        assert_true(p[1].area_ratio.value < p[2].area_ratio.value);
        assert_true(p[2].area_ratio.value < p[0].area_ratio.value);
    }
    rig_free(&r);
}

/* An impossible solid is refused once frequencies are known. */
static void transverse_refused(void **state)
{
    (void)state;
    rig r = rig_named("ti_isotropic_limit");
    wt_material_free(r.material);
    r.material = transverse(2.5, 2.5, 1, 1, 0.49, 1.225); /* nu_pz exchanged with nu_zp */
    wt_friction_workspace *ws = prepare(&r, 1e-10, 1);
    wt_friction_point point;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_friction_compute(ws, r.pressure, &r.velocity, 1, &point, &err), WT_E_RANGE);
    assert_non_null(strstr(err.message, "unstable"));
    assert_non_null(strstr(err.found, "nu_zp = 1.225"));
    wt_friction_workspace_free(ws);
    rig_free(&r);
}

/* Elastic: P = erf(sqrt(2) sigma0 / (E* h')). */
static void elastic_area(void **state)
{
    (void)state;
    rig r = rig_named("elastic");
    const wt_friction_point p = solve(&r, 1e-12);
    const double slope = wt_roughness_rms_slope(r.roughness);
    assert_near(p.area_ratio.value, erf(M_SQRT2 * r.pressure / (5e6 / 0.75 * slope)), 1e-12);
    assert_near(p.hysteresis.value, 0, 0);
    assert_near(p.hysteresis.numerical_error, 0, 0);
    rig_free(&r);
}

static void same_bits_for_any_threads(void **state)
{
    (void)state;
    rig r = rig_named("normal_table_loglog");
    double velocity[37];
    for (size_t i = 0; i < 37; i++)
        velocity[i] = 1e-6 * pow(10, 0.21 * (double)i);
    wt_friction_point one[37], many[37];
    memset(one, 0, sizeof one);
    memset(many, 0, sizeof many);
    wt_friction_workspace *ws = prepare(&r, 1e-9, 1);
    /* another range first: the result must not depend on earlier calls */
    assert_int_equal(wt_friction_compute(ws, r.pressure, &velocity[20], 1, one, NULL), WT_OK);
    assert_int_equal(wt_friction_compute(ws, r.pressure, velocity, 37, one, NULL), WT_OK);
    wt_friction_workspace_free(ws);
    ws = prepare(&r, 1e-9, 5);
    assert_int_equal(wt_friction_compute(ws, r.pressure, velocity, 37, many, NULL), WT_OK);
    wt_friction_workspace_free(ws);
    for (size_t i = 0; i < 37; i++) {
        assert_near(many[i].hysteresis.value, one[i].hysteresis.value, 0);
        assert_near(many[i].hysteresis.numerical_error, one[i].hysteresis.numerical_error, 0);
        assert_near(many[i].stress_variance.value, one[i].stress_variance.value, 0);
        assert_near(many[i].extrapolated_share, one[i].extrapolated_share, 0);
        assert_true(many[i].extrapolated_share >= 0 && many[i].extrapolated_share <= 1);
        assert_true(many[i].meets_tolerance);
    }
    rig_free(&r);
}

/* Share of mu from unmeasured frequencies, against mu of a material without loss there: where P is
 * 1 everywhere, mu is linear in the loss. */
static void extrapolated_share(void **state)
{
    (void)state;
    const double omega[] = {1e-2, 1e2, 1e2 * (1 + 1e-9), 1e6, 1e6 * (1 + 1e-9), 1e12};
    const double storage[] = {1e7, 1e7, 1e7, 1e7, 1e7, 1e7};
    const double all[] = {1e6, 1e6, 1e6, 1e6, 1e6, 1e6};
    const double inside[] = {1e-9, 1e-9, 1e6, 1e6, 1e-9, 1e-9};
    rig r = {.pressure = 1e12, .velocity = 0.0385, .gamma = 1};
    assert_int_equal(wt_roughness_self_affine(1e3, 1e4, 1e9, 0.8, 1e-16, &r.roughness, NULL),
                     WT_OK);
    double mu[2], share = 0;
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(wt_material_table(omega, storage, i ? inside : all, 6, 0.5,
                                           WT_EXTRAPOLATE_HOLD, &r.material, NULL),
                         WT_OK);
        r.material->frequency_min = 1e2;
        r.material->frequency_max = 1e6;
        const wt_friction_point p = solve(&r, 1e-6);
        mu[i] = p.hysteresis.value;
        if (i == 0)
            share = p.extrapolated_share;
        wt_material_free(r.material);
    }
    assert_true(share > 0.1 && share < 0.9);
    assert_near(share, 1 - mu[1] / mu[0], 2e-6);
    wt_roughness_free(r.roughness);
}

/* G = (E* h' / sigma0)^2 / 8 and P = 1 / sqrt(pi G), until G overflows. */
static void variance_overflow(void **state)
{
    (void)state;
    rig r = rig_named("normal_prony_v1e-2");
    const double height = 1e-16;
    wt_roughness_free(r.roughness);
    for (double c0 = 1e100; c0 < 1e280; c0 *= 1e30) {
        double mu[2], variance[2];
        for (int k = 0; k < 2; k++) { /* four times as rough, half the contact area */
            assert_int_equal(wt_roughness_self_affine(1e3, 5e3, 1e7, 0.8, (k ? 4 : 1) * c0 * height,
                                                      &r.roughness, NULL),
                             WT_OK);
            const wt_friction_point p = solve(&r, 1e-10);
            assert_true(p.meets_tolerance);
            assert_near(p.area_ratio.value, 1 / sqrt(M_PI * p.stress_variance.value), 1e-14);
            mu[k] = p.hysteresis.value;
            variance[k] = p.stress_variance.value;
            wt_roughness_free(r.roughness);
        }
        assert_near(variance[1], 4 * variance[0], 1e-13);
        assert_near(mu[1], 2 * mu[0], 1e-9);
    }
    r.roughness = NULL;
    rig_free(&r);
}

/* The numbers of the text file are those of the shared reference data, if they exist. */
static void same_as_shared_reference(void **state)
{
    (void)state;
    FILE *shared = fopen(WT_SHARED_DIR "/reference/friction.json", "r");
    if (!shared)
        skip();
    enum { ROOM = 1 << 20 };
    char *all = calloc(ROOM, 1);
    assert_non_null(all);
    assert_true(fread(all, 1, ROOM - 1, shared) > 1000);
    fclose(shared);
    FILE *in = open_cases();
    char line[4096], number[64];
    size_t n = 0;
    while (fgets(line, sizeof line, in))
        if (sscanf(line, "expect %*[a-z_] %63s", number) == 1 &&
            strncmp(line, "expect at", 9) != 0) {
            assert_non_null(strstr(all, number));
            n++;
        }
    assert_int_equal(n, 6 * 19);
    fclose(in);
    free(all);
}

static void bad_input(void **state)
{
    (void)state;
    rig r = rig_named("normal_table_hold");
    wt_error err = WT_ERROR_INIT;
    wt_friction_options options = wt_friction_defaults();
    wt_friction_workspace *ws = NULL;
    options.tolerance = 0;
    assert_int_equal(wt_friction_workspace_new(r.material, r.roughness, &options, &ws, &err),
                     WT_E_RANGE);
    assert_non_null(strstr(err.place, "tolerance"));
    options = wt_friction_defaults();
    options.gamma = 1.5;
    assert_int_equal(wt_friction_workspace_new(r.material, r.roughness, &options, &ws, &err),
                     WT_E_RANGE);
    assert_non_null(strstr(err.place, "gamma"));
    options = wt_friction_defaults();
    options.layer.modulus_ratio = 0;
    assert_int_equal(wt_friction_workspace_new(r.material, r.roughness, &options, &ws, &err),
                     WT_E_RANGE);
    assert_non_null(strstr(err.place, "modulus-ratio"));
    assert_null(ws);

    ws = prepare(&r, 1e-10, 1);
    wt_friction_point point;
    const double velocities[] = {(double)NAN, (double)INFINITY, 0};
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(wt_friction_compute(ws, r.pressure, &velocities[i], 1, &point, &err),
                         WT_E_RANGE);
        assert_non_null(strstr(err.message, "velocity"));
    }
    const double pressures[] = {0, -1, (double)NAN, (double)INFINITY, 1e-300};
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(wt_friction_compute(ws, pressures[i], &r.velocity, 1, &point, &err),
                         WT_E_RANGE);
        assert_non_null(strstr(err.message, "pressure"));
    }
    wt_friction_workspace_free(ws);
    rig_free(&r);
}

/* ---- a layer on the bulk --------------------------------------------------------------------- */

static wt_friction_point with_layer(const rig *r, double thickness, double ratio)
{
    wt_friction_options options = wt_friction_defaults();
    options.layer = (wt_layer_state){.thickness = thickness, .modulus_ratio = ratio};
    wt_friction_workspace *ws = NULL;
    wt_friction_point point;
    assert_int_equal(wt_friction_workspace_new(r->material, r->roughness, &options, &ws, NULL),
                     WT_OK);
    assert_int_equal(wt_friction_compute(ws, r->pressure, &r->velocity, 1, &point, NULL), WT_OK);
    assert_true(point.meets_tolerance);
    wt_friction_workspace_free(ws);
    return point;
}

static void layer_limits(void **state)
{
    (void)state;
    rig r = rig_named("normal_prony_v1e-2");
    const wt_friction_point bulk = solve(&r, 1e-10);
    const double same[][2] = {{0, 0.3}, {1e-6, 1}, {1e-20, 0.3}};
    for (size_t i = 0; i < 3; i++) {
        const wt_friction_point p = with_layer(&r, same[i][0], same[i][1]);
        assert_near(p.hysteresis.value, bulk.hysteresis.value, 1e-10);
        assert_near(p.stress_variance.value, bulk.stress_variance.value, 1e-10);
    }
    /* layer only: the bulk with another modulus, or the same at another pressure */
    const wt_friction_point thick = with_layer(&r, 1e6, 0.3);
    r.pressure /= 0.3;
    const wt_friction_point soft = solve(&r, 1e-10);
    assert_near(thick.hysteresis.value, soft.hysteresis.value, 1e-10);
    assert_near(thick.area_ratio.value, soft.area_ratio.value, 1e-10);
    /* a finite layer lies between */
    r.pressure *= 0.3;
    const wt_friction_point some = with_layer(&r, 1e-6, 0.3);
    assert_true(some.area_ratio.value > bulk.area_ratio.value);
    assert_true(some.area_ratio.value < thick.area_ratio.value);
    rig_free(&r);
}

static void total_friction(void **state)
{
    (void)state;
    const wt_estimate hysteresis = {.value = 0.2, .standard_error = 0.03, .numerical_error = 1e-9};
    const wt_estimate area = {.value = 0.05, .standard_error = 0.004, .numerical_error = 1e-8};
    const wt_estimate shear = {.value = 3004626.504404032, .standard_error = 1e5};
    const wt_estimate mu = wt_friction_total(hysteresis, area, shear, 4e5);
    assert_near(mu.value, 0.575578313050504, 1e-14);
    const double from_area = 3004626.504404032 / 4e5 * 0.004;
    const double from_shear = 0.05 / 4e5 * 1e5;
    assert_near(mu.standard_error,
                sqrt(0.03 * 0.03 + from_area * from_area + from_shear * from_shear), 1e-14);
    assert_near(mu.numerical_error, 1e-9 + 3004626.504404032 / 4e5 * 1e-8, 1e-14);
}

/* A spectrum that underflows to 0 far below q1, and one that falls by twelve decades within 1e-4 of
 * the wavenumber: evaluating the density at every node gives the same as its power laws. */
static void densities_and_powers(void **state)
{
    (void)state;
    static const double modulus[] = {1e7, 1e8}, time[] = {1e-3, 1e-6};
    static const double knot[] = {500, 2000, 2000.2, 1e6}, density[] = {1e-15, 1e-17, 1e-29, 1e-35};
    const scene s = {.law = PRONY, .n = 2, .e0 = 1e6, .e = modulus, .tau = time, .nu = 0.5};
    wt_roughness *roads[2] = {NULL, NULL};
    wt_material *rubber = NULL;
    assert_int_equal(wt_roughness_self_affine(500, 2000, 1e60, 3, 6e-16, &roads[0], NULL), WT_OK);
    assert_int_equal(wt_roughness_table(knot, density, 4, &roads[1], NULL), WT_OK);
    assert_int_equal(scene_material(&s, &rubber, NULL), WT_OK);
    for (size_t i = 0; i < 2; i++) {
        wt_roughness_law law = *roads[i]->law;
        wt_roughness own = *roads[i];
        const wt_roughness *const both[] = {roads[i], &own};
        wt_friction_point p[2];
        const double velocity = 0.1;
        assert_true(law.powers);
        law.powers = false;
        own.law = &law;
        for (size_t k = 0; k < 2; k++) {
            wt_friction_workspace *ws = NULL;
            assert_int_equal(wt_friction_workspace_new(rubber, both[k], NULL, &ws, NULL), WT_OK);
            assert_int_equal(wt_friction_compute(ws, 3e5, &velocity, 1, &p[k], NULL), WT_OK);
            wt_friction_workspace_free(ws);
        }
        assert_true(p[0].hysteresis.value > 0 && p[0].meets_tolerance);
        assert_near(p[0].hysteresis.value, p[1].hysteresis.value, 1e-11);
        assert_near(p[0].stress_variance.value, p[1].stress_variance.value, 1e-11);
        wt_roughness_free(roads[i]);
    }
    wt_material_free(rubber);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numeric_cases),
        cmocka_unit_test(densities_and_powers),
        cmocka_unit_test(numeric_profiles),
        cmocka_unit_test(profile_ends),
        cmocka_unit_test(area_functions),
        cmocka_unit_test(many_areas_at_once),
        cmocka_unit_test(errors_of_the_area),
        cmocka_unit_test(area_integral_with_correction),
        cmocka_unit_test(odd_in_velocity),
        cmocka_unit_test(scalings),
        cmocka_unit_test(linear_and_bounded),
        cmocka_unit_test(transverse_laws),
        cmocka_unit_test(isotropic_limit),
        cmocka_unit_test(trends_of_reinforcement),
        cmocka_unit_test(transverse_refused),
        cmocka_unit_test(elastic_area),
        cmocka_unit_test(same_bits_for_any_threads),
        cmocka_unit_test(extrapolated_share),
        cmocka_unit_test(variance_overflow),
        cmocka_unit_test(same_as_shared_reference),
        cmocka_unit_test(bad_input),
        cmocka_unit_test(layer_limits),
        cmocka_unit_test(total_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
