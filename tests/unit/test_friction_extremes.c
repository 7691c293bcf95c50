/* Friction of randomly drawn extreme materials, surfaces, velocities and pressures: the true error
 * is within the stated one. The truth is that of friction_truth.h.
 *
 * Arguments draw other scenes: test_friction_extremes CASES [SEED [FIRST]]; scenes before FIRST are
 * skipped. */
#include "assert_near.h"

#include "numeric/drawn_numbers.h"
#include "numeric/friction_truth.h"
#include "weartrack/friction.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 120, FEW = 6, SPECTRUM = 6, SWEEP = 11 };

typedef struct drawn {
    scene s;
    double e[MOST], tau[MOST], loss[MOST], wavenumber[SPECTRUM], density[SPECTRUM];
    double strain[FEW], f[FEW], g[FEW];
    double tolerance;
    size_t n_velocities; /* the tested one is in the middle */
} drawn;

static const char *const law_names[] = {"prony", "table", "zener"};

/* Mostly stable. */
static void draw_directions(scene *s)
{
    wt_transverse *t = &s->factors;
    double *const factors[] = {&t->axial_storage, &t->axial_loss,    &t->plane_storage,
                               &t->plane_loss,    &t->shear_storage, &t->shear_loss};
    s->transverse = true;
    *t = wt_transverse_defaults();
    for (size_t i = 0; i < 6; i++)
        *factors[i] = decades(-0.4, 0.6);
    t->plane_poisson = uniform(-0.5, 0.6);
    t->axial_poisson = uniform(-0.3, 0.45);
}

static void draw_terms(drawn *d)
{
    scene *s = &d->s;
    s->e0 = uniform(0, 1) < 0.2 ? 0 : decades(3, 9);
    s->n = uniform(0, 1) < 0.95 ? 1 + (size_t)uniform(0, FEW) : 1 + (size_t)uniform(0, MOST);
    for (size_t k = 0; k < s->n; k++) {
        d->e[k] = decades(2, 11);
        d->tau[k] = decades(-14, 10);
    }
}

/* Jumps, nearly coincident knots, and many noisy ones. */
static void draw_table(drawn *d)
{
    scene *s = &d->s;
    const double kind = uniform(0, 1);
    const bool noisy = kind < 0.1 && !s->transverse, close = kind > 0.8;
    s->n = noisy ? 2 + (size_t)uniform(0, 5 * FEW) : 2 + (size_t)uniform(0, FEW - 2);
    double omega = decades(-8, 4), height = decades(4, 9);
    for (size_t k = 0; k < s->n; k++) {
        d->tau[k] = omega *= close && uniform(0, 1) < 0.5 ? 1 + decades(-10, -1)
                             : noisy                      ? decades(0.01, 0.2)
                                                          : decades(0.05, 3);
        d->e[k] = noisy ? (height *= decades(-0.1, 0.2)) : decades(2, 11);
        d->loss[k] = noisy ? height * uniform(0.05, 1) : decades(2, 11);
    }
}

static void draw_surface(drawn *d)
{
    scene *s = &d->s;
    s->q0 = decades(1, 5);
    s->q1 = s->q0 * (1 + decades(-4, uniform(0, 1) < 0.1 ? 10 : 6));
    s->qr = uniform(0, 1) < 0.3 ? s->q0 : s->q0 * pow(s->q1 / s->q0, uniform(0, 1));
    s->hurst = uniform(0, 1) < 0.5 ? uniform(0, 1) : uniform(-0.9, 2.5);
    s->c0 = decades(-30, -8) / pow(s->q0 / 1e3, 4);
    if (uniform(0, 1) < 0.8)
        return;
    s->n_density = 2 + (size_t)uniform(0, SPECTRUM - 1);
    const double step = log(s->q1 / s->q0) / (double)(s->n_density - 1);
    for (size_t i = 0; i < s->n_density; i++) {
        d->wavenumber[i] = i + 1 < s->n_density ? s->q0 * exp(step * (double)i) : s->q1;
        d->density[i] = s->c0 *= i > 0 ? exp(-step * uniform(-1, 7)) : 1;
    }
}

static void draw_scene(drawn *d, law_kind law, bool transverse)
{
    *d = (drawn){.s = {.law = law, .e = d->e, .tau = d->tau, .loss = d->loss}};
    scene *s = &d->s;
    s->wavenumber = d->wavenumber;
    s->density = d->density;
    if (transverse)
        draw_directions(s);
    if (law == PRONY)
        draw_terms(d);
    else if (law == TABLE)
        draw_table(d);
    if (law == ZENER) {
        s->n = 1;
        s->alpha = uniform(0.05, 1);
        d->e[0] = decades(2, 11);
        d->e[1] = d->e[0] + decades(2, 11);
        d->tau[0] = decades(-14, 10);
    }
    s->nu = uniform(0, 1) < 0.2 ? 0.5 : uniform(0, 0.5);
    s->pressure = uniform(0, 1) < 0.2 ? decades(-6, 15) : decades(0, 12);
    s->velocity = decades(-12, 6);
    draw_surface(d);
    if (uniform(0, 1) < 0.1) {
        s->thickness = decades(-3, 3) / s->q0;
        s->ratio = decades(-2, 2);
    }
    s->gamma = uniform(0, 1) < 0.5 ? 1 : uniform(0, 1);
    d->tolerance = decades(-12, -2);
    d->n_velocities = uniform(0, 1) < 0.7 ? 1 : SWEEP;
}

/* From small to extreme strains; some are reached next to q0, some never. */
static void draw_softening(drawn *d)
{
    scene *s = &d->s;
    const double reach = uniform(0, 1) < 0.5 ? 1 : 2;
    s->strain = d->strain;
    s->f = d->f;
    s->g = d->g;
    s->n_strain = 1 + (size_t)uniform(0, FEW);
    s->strain_factor = decades(-1, 1);
    /* of the order of what the surface has */
    double strain = (double)strain_at(s, logl((long double)s->q1 / s->q0)) * decades(-5, 1);
    for (size_t k = 0; k < s->n_strain; k++) {
        d->strain[k] = strain;
        d->f[k] = decades(-reach, 0.1 * reach);
        d->g[k] = decades(-reach, 0.3 * reach);
        strain *= decades(0.01, 1.5);
    }
}

/* ---- the comparison -------------------------------------------------------------------------- */

static size_t n_cases = 24, first_case, n_checks, reached, refused, broken;

/* Each test has its own count. */
static int begin(void **ignored)
{
    (void)ignored;
    n_checks = reached = refused = broken = 0;
    return 0;
}

/* `most`: largest permitted stated error, relative to the number. */
static void check(const drawn *d, size_t number, const char *what, wt_estimate actual, real exact,
                  double most)
{
    const scene *s = &d->s;
    const real error = fabsl(actual.value - exact);
    n_checks++;
    if (error <= actual.numerical_error + 1e-17L * fabsl(exact) + DBL_MIN &&
        actual.numerical_error <= most * fabs(actual.value) + DBL_MIN)
        return;
    broken++;
    print_error("case %zu (%s%s%s, %zu, tolerance %.2g, v %.2g, p %.2g): %s %.17g is %.3Lg from "
                "%.20Lg, but %.3g is stated\n",
                number, s->n_strain > 0 ? "softened " : "", s->transverse ? "transverse " : "",
                law_names[s->law], s->n, d->tolerance, s->velocity, s->pressure, what, actual.value,
                error, exact, actual.numerical_error);
}

/* At the tested velocity, together with others. */
static wt_status compute(const drawn *d, wt_friction_workspace *ws, wt_friction_point *p,
                         wt_error *err)
{
    double velocity[SWEEP];
    wt_friction_point points[SWEEP];
    const size_t middle = d->n_velocities / 2;
    for (size_t i = 0; i < d->n_velocities; i++)
        velocity[i] = d->s.velocity * pow(1.3, (double)i - (double)middle);
    velocity[middle] = d->s.velocity;
    const wt_status status =
        wt_friction_compute(ws, d->s.pressure, velocity, d->n_velocities, points, err);
    *p = points[middle];
    return status;
}

/* Returns false if it is refused for its anisotropy. */
static bool compute_scene(const drawn *d, wt_friction_point *p)
{
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *ws = NULL;
    wt_friction_options options = wt_friction_defaults();
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(scene_material(&d->s, &material, NULL), WT_OK);
    assert_int_equal(scene_roughness(&d->s, &roughness, NULL), WT_OK);
    options.tolerance = d->tolerance;
    options.gamma = d->s.gamma;
    const wt_softening softening = scene_softening(&d->s);
    if (softening.n > 0) {
        options.softening = &softening;
        options.strain_factor = d->s.strain_factor;
    }
    if (d->s.thickness > 0)
        options.layer = (wt_layer_state){.thickness = d->s.thickness, .modulus_ratio = d->s.ratio};
    assert_int_equal(wt_friction_workspace_new(material, roughness, &options, &ws, NULL), WT_OK);
    const bool good = compute(d, ws, p, &err) == WT_OK;
    if (!good && (!d->s.transverse || strstr(err.message, "transversely isotropic") == NULL))
        fail_msg("%s", err.message);
    wt_friction_workspace_free(ws);
    wt_roughness_free(roughness);
    wt_material_free(material);
    return good;
}

static void compare(drawn *d, size_t number)
{
    wt_friction_point p;
    if (!compute_scene(d, &p)) {
        refused++;
        return;
    }
    const truth exact = truth_of(&d->s);
    check(d, number, "G", p.stress_variance, exact.variance, 0.1);
    check(d, number, "P", p.area_ratio, area(exact.variance), 0.1);
    check(d, number, "1 - P", p.one_minus_area, erfcl(0.5L / sqrtl(exact.variance)), 10);
    check(d, number, "mu", p.hysteresis, exact.hysteresis, 10);
    reached += p.meets_tolerance;
}

/* Cases in quad precision, also with other angular integrals for the truth. */
static void softened_cases(void **ignored)
{
    (void)ignored;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction-softening.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    case_scene *made = malloc(sizeof *made);
    assert_true(in != NULL && c != NULL && made != NULL);
    size_t n = 0;
    for (; case_read(in, c); n++) {
        case_to_scene(c, made);
        const double tolerances[] = {1e-3, 1e-6, 1e-10};
        for (size_t i = 0; i < 3; i++)
            for (size_t many = 1; many <= SWEEP; many += SWEEP - 1) {
                drawn d = {.s = made->s, .tolerance = tolerances[i], .n_velocities = many};
                wt_friction_point p;
                compute_scene(&d, &p);
                check(&d, n, "G", p.stress_variance,
                      (real)case_number(c, true, "stress_variance", 0), tolerances[i]);
                check(&d, n, "P", p.area_ratio, (real)case_number(c, true, "area_ratio", 0),
                      tolerances[i]);
                check(&d, n, "mu", p.hysteresis, (real)case_number(c, true, "hysteresis", 0),
                      tolerances[i]);
                assert_true(p.meets_tolerance);
            }
    }
    assert_int_equal(n, 5);
    assert_int_equal(broken, 0);
    free(made);
    free(c);
    fclose(in);
}

/* The truth itself, against values of another program with 30 digits. */
static void truth_of_reference(void **ignored)
{
    (void)ignored;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    case_scene *made = malloc(sizeof *made);
    assert_true(in != NULL && c != NULL && made != NULL);
    size_t n = 0;
    while (case_read(in, c)) {
        case_to_scene(c, made);
        const truth exact = truth_of(&made->s);
        assert_near((double)exact.variance, case_number(c, true, "stress_variance", 0),
                    2 * DBL_EPSILON);
        assert_near((double)exact.hysteresis, case_number(c, true, "hysteresis", 0),
                    2 * DBL_EPSILON);
        n++;
    }
    assert_int_equal(n, 19);
    free(made);
    free(c);
    fclose(in);
}

/* ---- limits of validity ---------------------------------------------------------------------- */

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* `most`: largest permitted stated error, relative to the number. */
static void check_edge(const numeric_case *c, double tolerance, double most, const char *key,
                       wt_estimate actual)
{
    const double exact = case_number(c, true, key, (double)NAN);
    if (!(fabs(actual.value - exact) <= actual.numerical_error + DBL_EPSILON * fabs(exact) / 2))
        fail_msg("%s, tolerance %g: %s is %.17g +- %.3g, not %.17g", c->name, tolerance, key,
                 actual.value, actual.numerical_error, exact);
    /* below the smallest number there is no relative error */
    if (!(actual.numerical_error <= most * fabs(actual.value) + DBL_MIN))
        fail_msg("%s, tolerance %g: %s is %.17g +- %.3g", c->name, tolerance, key, actual.value,
                 actual.numerical_error);
}

static void check_refusal(const numeric_case *c, wt_status status, const wt_error *err)
{
    const char *word = case_word(c, true, "refused");
    assert_int_equal(status, WT_E_RANGE);
    if (strstr(err->message, word) == NULL || err->expected[0] == '\0' || err->found[0] == '\0')
        fail_msg("%s: '%s', expected '%s', found '%s'", c->name, err->message, err->expected,
                 err->found);
}

/* One row at one tolerance: correct within the stated error, or refused by the limit. */
static void try_edge(const numeric_case *c, const scene *s, double tolerance)
{
    wt_material *material = NULL;
    wt_roughness *roughness = NULL;
    wt_friction_workspace *ws = NULL;
    wt_friction_options options = wt_friction_defaults();
    wt_friction_point p;
    wt_error err = WT_ERROR_INIT;
    options.tolerance = tolerance;
    if (s->thickness > 0)
        options.layer = (wt_layer_state){.thickness = s->thickness, .modulus_ratio = s->ratio};
    const double start = seconds();
    wt_status status = scene_material(s, &material, &err);
    if (status == WT_OK)
        status = scene_roughness(s, &roughness, &err);
    if (status == WT_OK)
        status = wt_friction_workspace_new(material, roughness, &options, &ws, &err);
    if (status == WT_OK)
        status = wt_friction_compute(ws, s->pressure, &s->velocity, 1, &p, &err);
    assert_true(seconds() - start < 1);
    if (case_find(c, true, "refused") != NULL) {
        check_refusal(c, status, &err);
    } else {
        if (status != WT_OK)
            fail_msg("%s: %s, expected %s, found %s", c->name, err.message, err.expected,
                     err.found);
        const double most = fmax(tolerance, 1e-9);
        check_edge(c, tolerance, most, "stress_variance", p.stress_variance);
        check_edge(c, tolerance, most, "area_ratio", p.area_ratio);
        check_edge(c, tolerance, most, "hysteresis", p.hysteresis);
        /* not promised: ln(1 - P) is about -1 / (4 G) */
        check_edge(c, tolerance, most * (1 + 0.5 / p.stress_variance.value), "one_minus_area",
                   p.one_minus_area);
    }
    wt_friction_workspace_free(ws);
    wt_roughness_free(roughness);
    wt_material_free(material);
}

static void limits_of_validity(void **ignored)
{
    (void)ignored;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction-edges.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    case_scene *made = malloc(sizeof *made);
    assert_true(in != NULL && c != NULL && made != NULL);
    size_t n = 0;
    for (; case_read(in, c); n++) {
        case_to_scene(c, made);
        const double tolerances[] = {1e-2, 1e-4, 1e-10};
        for (size_t i = 0; i < 3; i++)
            try_edge(c, &made->s, tolerances[i]);
    }
    assert_int_equal(n, 67);
    free(made);
    free(c);
    fclose(in);
}

static void draw_case(drawn *d, size_t i)
{
    /* of sixteen: three tables, two Zener, two transversely isotropic */
    draw_scene(d, i % 8 == 7 || i % 16 == 11 ? TABLE : i % 8 == 5 ? ZENER : PRONY, i % 8 == 3);
}

/* Scenes whose error once exceeded the stated one: tables with nearly coincident knots; an
 * anisotropic one with nearly singular moduli between its knots; and a storage modulus that rises
 * by six decades between two knots while the loss modulus rises by two. The hysteresis then comes
 * from where G has hardly begun to rise. */
static void earlier_failures(void **ignored)
{
    (void)ignored;
    static const struct {
        uint64_t seed;
        size_t number;
    } cases[] = {{20261, 475},  {20261, 2767}, {20261, 3391}, {31337, 4063},
                 {900024, 103}, {950001, 251}, {771002, 59}};
    const uint64_t kept = drawn_state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        drawn d;
        drawn_state = cases[k].seed;
        for (size_t i = 0; i <= cases[k].number; i++)
            draw_case(&d, i);
        compare(&d, cases[k].number);
        const double tolerances[] = {1e-2, 1e-4, 1e-10};
        for (size_t i = 0; i < 3; i++) {
            d.tolerance = tolerances[i];
            compare(&d, cases[k].number);
        }
    }
    assert_int_equal(n_checks, 112);
    assert_int_equal(broken, 0);
    drawn_state = kept;
}

/* An anisotropic table whose modulus nearly vanishes between the edges of the subintervals of its
 * angular integrals, with a loss modulus that softens less than the storage modulus; and two that
 * soften so close to q0 that a rounded wavenumber loses the strain. */
static void earlier_failures_with_softening(void **ignored)
{
    (void)ignored;
    static const struct {
        uint64_t seed;
        size_t before, number;
    } cases[] = {{980001, 256, 107}, {880011, 400, 85}, {880011, 400, 172}};
    const uint64_t kept = drawn_state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        drawn d;
        drawn_state = cases[k].seed;
        for (size_t i = 0; i < cases[k].before; i++)
            draw_case(&d, i);
        for (size_t i = 0; i <= cases[k].number; i++) {
            draw_case(&d, i);
            draw_softening(&d);
        }
        const double tolerances[] = {1e-4, 1e-10, 1e-12};
        for (size_t i = 0; i < 3; i++) {
            d.tolerance = tolerances[i];
            compare(&d, cases[k].number);
        }
    }
    assert_int_equal(n_checks, 36);
    assert_int_equal(broken, 0);
    drawn_state = kept;
}

/* With anisotropy and decreasing end slopes, rounding of the moduli exceeds the tightest tolerance.
 * Bisection does not help; it took half a minute and more. */
static void steep_and_continued(void **ignored)
{
    (void)ignored;
    const double omega[] = {1, 14.6, 402, 3.1e4}, storage[] = {1.8e5, 3.8e11, 2.2e12, 1.2e12};
    const uint64_t kept = drawn_state;
    drawn_state = 11;
    for (size_t i = 0; i < 3; i++) {
        drawn d = {.s = {.law = TABLE, .slope = true, .n = 4, .e = d.e, .tau = d.tau},
                   .tolerance = 1.5e-12,
                   .n_velocities = 1};
        scene *s = &d.s;
        s->loss = d.loss;
        for (size_t k = 0; k < 4; k++) {
            d.tau[k] = omega[k];
            d.e[k] = storage[k];
            d.loss[k] = storage[k] * decades(-2, 0);
        }
        draw_directions(s);
        s->nu = 0.5;
        s->q0 = s->qr = 848;
        s->q1 = 8.3e7;
        s->hurst = 0.8;
        s->c0 = 1e-20;
        s->velocity = 2.2e-5;
        s->pressure = decades(6, 12);
        s->gamma = 1;
        const double start = seconds();
        wt_friction_point p;
        compute_scene(&d, &p);
        assert_true(seconds() - start < 1);
        compare(&d, i);
    }
    assert_int_equal(n_checks, 12);
    assert_int_equal(broken, 0);
    drawn_state = kept;
}

static void extreme_friction(void **ignored)
{
    (void)ignored;
    for (size_t i = 0; i < n_cases; i++) {
        drawn d;
        draw_case(&d, i);
        if (i >= first_case)
            compare(&d, i);
    }
    print_message("%zu checks, %zu of %zu scenes to their tolerance, %zu refused\n", n_checks,
                  reached, n_cases - first_case, refused);
    assert_int_equal(broken, 0);
    assert_true(10 * (reached + refused) >= 9 * (n_cases - first_case));
    assert_true(20 * refused <= n_cases);
}

/* Half the number of cases, with softening. */
static void softened_friction(void **ignored)
{
    (void)ignored;
    for (size_t i = 0; i < n_cases / 2; i++) {
        drawn d;
        draw_case(&d, i);
        draw_softening(&d);
        if (i >= first_case)
            compare(&d, i);
    }
    print_message("softened: %zu checks, %zu to their tolerance, %zu refused\n", n_checks, reached,
                  refused);
    assert_int_equal(broken, 0);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        n_cases = strtoul(argv[1], NULL, 10);
    drawn_state = argc > 2 ? strtoul(argv[2], NULL, 10) : 7;
    if (argc > 3)
        first_case = strtoul(argv[3], NULL, 10);
    make_rule();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(truth_of_reference, begin),
        cmocka_unit_test_setup(limits_of_validity, begin),
        cmocka_unit_test_setup(earlier_failures, begin),
        cmocka_unit_test_setup(earlier_failures_with_softening, begin),
        cmocka_unit_test_setup(steep_and_continued, begin),
        cmocka_unit_test_setup(extreme_friction, begin),
        cmocka_unit_test_setup(softened_cases, begin),
        cmocka_unit_test_setup(softened_friction, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
