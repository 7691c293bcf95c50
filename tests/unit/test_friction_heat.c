/* Flash temperature, area in partial contact, shear stress: against numeric cases and required
 * relations. */
#include "assert_near.h"

#include "friction/numerics/persson_contact.h"
#include "numeric/friction_scene.h"
#include "weartrack/layer.h"

typedef struct rig {
    numeric_case c;
    wt_material *material;
    wt_roughness *roughness;
    double pressure, velocity, within;
    wt_friction_options options;
} rig;

static void rig_free(rig *r)
{
    wt_material_free(r->material);
    wt_roughness_free(r->roughness);
    free(r);
}

static double given(const rig *r, const char *key, double missing)
{
    return case_number(&r->c, false, key, missing);
}

static double expected(const rig *r, const char *key)
{
    return case_number(&r->c, true, key, (double)NAN);
}

static wt_shift_law reference_law(void)
{
    return (wt_shift_law){.kind = WT_LAW_WLF,
                          .wlf = {.c1 = 7.4, .c2 = 121.6, .reference_temperature = 293.15}};
}

/* The moduli at the ambient temperature. */
static wt_material *material_at(const rig *r, double temperature)
{
    case_scene made;
    wt_material *material = NULL;
    case_to_scene(&r->c, &made);
    const wt_shift_law law = reference_law();
    const double a = pow(10, wt_shift_law_log_a(&law, temperature));
    for (size_t k = 0; k < made.s.n; k++)
        made.tau[k] *= a;
    assert_int_equal(scene_material(&made.s, &material, NULL), WT_OK);
    return material;
}

static void rig_set(rig *r)
{
    const bool flash = case_find(&r->c, false, "contact_size") != NULL;
    const double temperature = given(r, "temperature", 293.15);
    r->material = material_at(r, flash ? temperature : 293.15);
    assert_int_equal(friction_case_roughness(&r->c, &r->roughness, NULL), WT_OK);
    r->pressure = given(r, "pressure", 0);
    r->velocity = given(r, "velocity", 0);
    r->within = given(r, "within", 0);
    r->options = wt_friction_defaults();
    r->options.gamma = given(r, "gamma", 1);
    if (!flash)
        return;
    r->options.temperature = temperature;
    r->options.shift = reference_law();
    r->options.flash = (wt_flash){.on = true,
                                  .contact_size = given(r, "contact_size", 0),
                                  .heat_capacity = given(r, "heat_capacity", 0),
                                  .diffusivity = given(r, "diffusivity", 0),
                                  .macroscopic = given(r, "macroscopic_area", 0)};
}

static wt_friction_workspace *prepare(const rig *r, double tolerance)
{
    wt_friction_options options = r->options;
    wt_friction_workspace *ws = NULL;
    wt_error err = WT_ERROR_INIT;
    options.tolerance = tolerance;
    const wt_status status =
        wt_friction_workspace_new(r->material, r->roughness, &options, &ws, &err);
    if (status != WT_OK)
        print_error("%s\n", err.message);
    assert_int_equal(status, WT_OK);
    return ws;
}

static wt_friction_point solve(const rig *r, double tolerance)
{
    wt_friction_workspace *ws = prepare(r, tolerance);
    wt_friction_point point;
    assert_int_equal(wt_friction_compute(ws, r->pressure, &r->velocity, 1, &point, NULL), WT_OK);
    wt_friction_workspace_free(ws);
    return point;
}

/* Runs every case with this prefix. */
static size_t for_cases(const char *begin, void (*check)(rig *r))
{
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction-beyond.txt", "r");
    size_t n = 0;
    assert_non_null(in);
    for (;;) {
        rig *r = calloc(1, sizeof *r);
        assert_non_null(r);
        const bool more = case_read(in, &r->c);
        if (more && strncmp(r->c.name, begin, strlen(begin)) == 0) {
            check(r);
            n++;
        }
        rig_free(r);
        if (!more)
            break;
    }
    fclose(in);
    return n;
}

static void check_near(const rig *r, const char *what, double actual, double wanted, double within)
{
    if (!(fabs(actual - wanted) <= within * fabs(wanted)))
        fail_msg("%s: %s is %.17g, expected %.17g: %.2g off", r->c.name, what, actual, wanted,
                 fabs(actual / wanted - 1));
}

/* ---- contact area ---------------------------------------------------------------------------- */

static void check_area(rig *r)
{
    const double g = given(r, "variance", 0);
    check_near(r, "P", contact_area(g), expected(r, "area_ratio"), 5e-13);
}

static void check_partial(rig *r)
{
    rig_set(r);
    const wt_friction_point p = solve(r, 1e-12);
    check_near(r, "G", p.stress_variance.value, expected(r, "stress_variance"), r->within);
    check_near(r, "P", p.area_ratio.value, expected(r, "area_ratio"), r->within);
    check_near(r, "mu", p.hysteresis.value, expected(r, "hysteresis"), r->within);
    const wt_friction_point rough = solve(r, 1e-4);
    assert_true(fabs(rough.hysteresis.value - p.hysteresis.value) <=
                rough.hysteresis.numerical_error);
    assert_true(fabs(rough.area_ratio.value - p.area_ratio.value) <=
                rough.area_ratio.numerical_error);
}

static void test_area_cases(void **state)
{
    (void)state;
    assert_int_equal(for_cases("area_", check_area), 7);
    assert_true(for_cases("S_", check_partial) >= 9);
}

/* ---- flash temperature ------------------------------------------------------------------------
 */

static void check_temperatures(const rig *r, double within)
{
    enum { PLACES = 5 };
    const case_line *line = case_find(&r->c, true, "temperatures");
    const double q0 = r->roughness->q0, q1 = r->roughness->q1;
    double q[PLACES] = {q0, 2000, 1e4, 1e5, q1};
    wt_friction_node node[PLACES];
    wt_friction_workspace *ws = prepare(r, 1e-12);
    assert_int_equal(wt_friction_profile(ws, r->pressure, r->velocity, q, PLACES, node, NULL),
                     WT_OK);
    wt_friction_workspace_free(ws);
    for (size_t i = 0; i < PLACES; i++)
        check_near(r, "T", node[i].temperature, line->value[i], within);
}

static void check_flash(rig *r)
{
    rig_set(r);
    const double tolerance = 1e-12, within = fmax(r->within, 4e-12);
    const wt_friction_point p = solve(r, tolerance);
    assert_false(p.has_no_solution);
    check_near(r, "mu", p.hysteresis.value, expected(r, "hysteresis"), within);
    check_near(r, "G", p.stress_variance.value, expected(r, "stress_variance"), within);
    check_near(r, "P", p.area_ratio.value, expected(r, "area_ratio"), within);
    check_temperatures(r, within);
    r->options.flash.on = false;
    check_near(r, "isothermal mu", solve(r, tolerance).hysteresis.value, expected(r, "isothermal"),
               fmax(r->within, 1e-12));
}

static void test_flash_cases(void **state)
{
    (void)state;
    assert_int_equal(for_cases("flash_", check_flash), 13);
}

/* Returns the parameters of a case by its full name. */
static rig *rig_named(const char *name)
{
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/friction-beyond.txt", "r");
    rig *r = calloc(1, sizeof *r);
    bool found = false;
    assert_non_null(in);
    assert_non_null(r);
    while (!found && case_read(in, &r->c))
        found = strcmp(r->c.name, name) == 0;
    fclose(in);
    assert_true(found);
    rig_set(r);
    return r;
}

/* Without flash temperature there is none, to the last bit, for any constants. */
static void test_flash_off(void **state)
{
    (void)state;
    rig *r = rig_named("flash_A_v10");
    r->options.flash.on = false;
    const wt_friction_point off = solve(r, 1e-10);
    r->options = wt_friction_defaults();
    const wt_friction_point none = solve(r, 1e-10);
    assert_true(off.hysteresis.value == none.hysteresis.value);
    assert_true(off.hysteresis.numerical_error == none.hysteresis.numerical_error);
    assert_true(off.stress_variance.value == none.stress_variance.value);
    assert_true(off.nodes == none.nodes);
    assert_true(isnan(off.temperature.value));
    rig_free(r);
}

/* The result of a velocity depends neither on other velocities nor on the threads. */
static void test_flash_is_independent_of_other_velocities(void **state)
{
    (void)state;
    enum { N = 9 };
    rig *r = rig_named("flash_B253K_v1");
    double velocity[N];
    wt_friction_point all[N], one;
    for (size_t i = 0; i < N; i++)
        velocity[i] = pow(10, (double)i - 7);
    r->options.threads = 3;
    wt_friction_workspace *ws = prepare(r, 1e-9);
    assert_int_equal(wt_friction_compute(ws, r->pressure, velocity, N, all, NULL), WT_OK);
    wt_friction_workspace_free(ws);
    r->options.threads = 1;
    for (size_t i = 0; i < N; i++) {
        r->velocity = -velocity[i];
        one = solve(r, 1e-9);
        assert_true(one.hysteresis.value == -all[i].hysteresis.value);
        assert_true(one.temperature.value == all[i].temperature.value);
    }
    rig_free(r);
}

/* The error with a loose tolerance is below the stated one. */
static void test_flash_error(void **state)
{
    (void)state;
    static const double temperature[] = {243.15, 253.15, 273.15, 293.15, 333.15};
    rig *r = rig_named("flash_A_v10");
    for (size_t k = 0; k < sizeof temperature / sizeof *temperature; k++) {
        wt_material_free(r->material);
        r->material = material_at(r, temperature[k]);
        r->options.temperature = temperature[k];
        for (r->velocity = 1e-6; r->velocity < 20; r->velocity *= 7) {
            const wt_friction_point best = solve(r, 1e-12);
            assert_false(best.has_no_solution);
            for (double tolerance = 1e-9; tolerance < 0.1; tolerance *= 10) {
                const wt_friction_point p = solve(r, tolerance);
                const double off = fabs(p.hysteresis.value - best.hysteresis.value);
                if (!(off <= p.hysteresis.numerical_error + best.hysteresis.numerical_error))
                    fail_msg("%g K, %g m/s, tolerance %g: mu is %.2g off, %.2g stated",
                             temperature[k], r->velocity, tolerance, off,
                             p.hysteresis.numerical_error);
                assert_true(fabs(p.area_ratio.value - best.area_ratio.value) <=
                            p.area_ratio.numerical_error + best.area_ratio.numerical_error);
                const double warmer = fabs(p.temperature.value - best.temperature.value);
                if (!(warmer <=
                      p.temperature.numerical_error + best.temperature.numerical_error + 1e-12))
                    fail_msg("%g K, %g m/s, tolerance %g: T is %.2g off, %.2g stated",
                             temperature[k], r->velocity, tolerance, warmer,
                             p.temperature.numerical_error);
            }
        }
    }
    rig_free(r);
}

/* Limits: heat that is removed at once, and heat that stays at its source. */
static void test_flash_limits(void **state)
{
    (void)state;
    rig *r = rig_named("flash_A_v10");
    r->velocity = 1;
    r->options.flash.diffusivity = 1e-12;
    assert_near_abs(solve(r, 1e-9).hysteresis.value, 0.32426, 5e-6);
    r->options.flash.diffusivity = 0.1;
    assert_near_abs(solve(r, 1e-9).hysteresis.value, 0.52345, 5e-5);
    r->options.flash.diffusivity = 1;
    const double little = solve(r, 1e-9).temperature.value - 293.15;
    r->options.flash.diffusivity = 0.01;
    assert_near((solve(r, 1e-9).temperature.value - 293.15) / little, 10, 0.05);
    rig_free(r);
}

/* Rubber above the limit of temperature has no friction, and nothing is returned. */
static void test_flash_without_convergence(void **state)
{
    (void)state;
    wt_error err = WT_ERROR_INIT;
    rig *r = rig_named("flash_A_v10");
    wt_friction_node node;
    wt_energy_source source = {0};
    r->options.flash.macroscopic = 0.01;
    r->options.flash.contact_size = 1;
    r->pressure = 3e7;
    r->velocity = 100;
    const wt_friction_point p = solve(r, 1e-9);
    assert_true(p.has_no_solution && isnan(p.hysteresis.value) && isnan(p.temperature.value));
    wt_friction_workspace *ws = prepare(r, 1e-9);
    const double q1 = r->roughness->q1;
    assert_int_equal(wt_friction_profile(ws, r->pressure, r->velocity, &q1, 1, &node, &err),
                     WT_E_CONVERGENCE);
    assert_non_null(strstr(err.message, "flash temperature"));
    assert_int_equal(wt_energy_source_from_friction(ws, r->pressure, r->velocity, &source, &err),
                     WT_E_CONVERGENCE);
    wt_friction_workspace_free(ws);
    r->options.shift.kind = WT_LAW_NONE;
    assert_int_equal(wt_friction_workspace_new(r->material, r->roughness, &r->options, &ws, &err),
                     WT_E_MISSING);
    r->options.shift = reference_law();
    r->options.temperature = 600;
    assert_int_equal(wt_friction_workspace_new(r->material, r->roughness, &r->options, &ws, &err),
                     WT_E_RANGE);
    rig_free(r);
}

/* The power of all waves equals that of friction. */
static void test_flash_energy(void **state)
{
    (void)state;
    rig *r = rig_named("flash_A_v0.1");
    wt_energy_source source = {0};
    wt_friction_workspace *ws = prepare(r, 1e-9);
    assert_int_equal(wt_energy_source_from_friction(ws, r->pressure, r->velocity, &source, NULL),
                     WT_OK);
    double power = 0;
    for (size_t i = 0; i < source.n; i++)
        power += source.power[i];
    assert_near(power, expected(r, "hysteresis") * r->pressure * r->velocity, 1e-8);
    wt_energy_source_clear(&source);
    wt_friction_workspace_free(ws);
    rig_free(r);
}

/* A table of the same moduli, whose knots move with the temperature. */
static void test_flash_table(void **state)
{
    (void)state;
    enum { KNOTS = 400 };
    rig *r = rig_named("flash_A_v10");
    const double wanted = expected(r, "hysteresis");
    double omega[KNOTS], storage[KNOTS], loss[KNOTS];
    for (size_t k = 0; k < KNOTS; k++)
        omega[k] = pow(10, -3 + 17.0 * (double)k / (KNOTS - 1));
    r->material->law->modulus(r->material, omega, KNOTS, storage, loss);
    wt_material_free(r->material);
    r->material = NULL;
    assert_int_equal(wt_material_table(omega, storage, loss, KNOTS, 0.5, WT_EXTRAPOLATE_HOLD,
                                       &r->material, NULL),
                     WT_OK);
    const wt_friction_point p = solve(r, 1e-8);
    assert_near(p.hysteresis.value, wanted, 1e-3);
    assert_true(p.hysteresis.numerical_error < 1e-4);
    const wt_friction_point better = solve(r, 1e-11);
    assert_true(fabs(p.hysteresis.value - better.hysteresis.value) <= p.hysteresis.numerical_error);
    rig_free(r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_area_cases),
        cmocka_unit_test(test_flash_cases),
        cmocka_unit_test(test_flash_off),
        cmocka_unit_test(test_flash_is_independent_of_other_velocities),
        cmocka_unit_test(test_flash_error),
        cmocka_unit_test(test_flash_limits),
        cmocka_unit_test(test_flash_without_convergence),
        cmocka_unit_test(test_flash_energy),
        cmocka_unit_test(test_flash_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
