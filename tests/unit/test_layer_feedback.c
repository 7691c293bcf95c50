/* A layer that acts back on the energy that makes it, and friction in running-in, against numeric
 * cases. */
#include "near.h"

#include "numeric/cases.h"
#include "weartrack/layer.h"

typedef struct rig {
    wt_material *material, *own; /* of the layer; NULL: a ratio */
    wt_roughness *roughness;
    double ratio;
    wt_depth_profile profile;
    wt_layer_parameters parameters;
    double digits; /* that the reference trusts */
    size_t calls;
} rig;

/* The rubber of all cases, or another of `scale` its moduli and `slower` its times. */
static wt_material *rubber(double scale, double slower)
{
    double time[] = {0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
    double modulus[] = {1e6, 2e6, 4e6, 1.2e7, 5e7, 2e8, 4e8, 3e8};
    const wt_prony prony = {.deformation = WT_TENSION,
                            .equilibrium_modulus = 6e6 * scale,
                            .n = 8,
                            .relaxation_time = time,
                            .modulus = modulus,
                            .frequency_min = (double)NAN,
                            .frequency_max = (double)NAN};
    wt_material *made = NULL;
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < prony.n; i++) {
        time[i] *= slower;
        modulus[i] *= scale;
    }
    assert_int_equal(wt_material_prony(&prony, 0.5, &made, &err), WT_OK);
    return made;
}

static rig rig_of(const numeric_case *c)
{
    const double scale = case_number(c, false, "own_scale", (double)NAN);
    rig r = {.material = rubber(1, 1),
             .own = isnan(scale) ? NULL : rubber(scale, case_number(c, false, "own_time", 1)),
             .ratio = case_number(c, false, "ratio", 1),
             .profile = strcmp(case_word(c, false, "profile"), "persson") == 0
                            ? WT_PROFILE_PERSSON
                            : WT_PROFILE_INCOMPRESSIBLE,
             .parameters = wt_layer_defaults(),
             .digits = pow(10, -case_number(c, false, "digits", 11))};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_roughness_self_affine(2e3, 1e4, 5e6, 0.85, 8e-19, &r.roughness, &err),
                     WT_OK);
    r.parameters.critical_energy = case_number(c, false, "critical_energy", 0);
    r.parameters.specific_wear_rate = case_number(c, false, "specific_wear_rate", 0);
    r.parameters.pressure = case_number(c, false, "pressure", 0);
    r.parameters.velocity = case_number(c, false, "velocity", 0);
    return r;
}

static void rig_free(rig *r)
{
    wt_material_free(r->material);
    wt_material_free(r->own);
    wt_roughness_free(r->roughness);
}

static wt_friction_workspace *workspace_of(const rig *r, double thickness, wt_error *err)
{
    wt_friction_options options = wt_friction_defaults();
    wt_friction_workspace *w = NULL;
    options.tolerance = 1e-12;
    options.layer =
        (wt_layer_state){.thickness = thickness, .modulus_ratio = r->ratio, .material = r->own};
    options.skip_extrapolated_share = true;
    if (wt_friction_workspace_new(r->material, r->roughness, &options, &w, err) != WT_OK)
        return NULL;
    return w;
}

static wt_status energy(double thickness, void *user, wt_energy_source *source,
                        wt_layer_parameters *parameters, wt_error *err)
{
    rig *r = user;
    r->calls++;
    wt_friction_workspace *w = workspace_of(r, thickness, err);
    if (w == NULL)
        return err->status;
    const wt_status status = wt_energy_source_from_friction(w, r->parameters.pressure,
                                                            r->parameters.velocity, source, err);
    wt_friction_workspace_free(w);
    source->profile = r->profile;
    *parameters = r->parameters;
    return status;
}

static wt_friction_point friction_at(const rig *r, double thickness)
{
    wt_friction_point p;
    wt_error err = WT_ERROR_INIT;
    wt_friction_workspace *w = workspace_of(r, thickness, &err);
    assert_non_null(w);
    assert_int_equal(
        wt_friction_compute(w, r->parameters.pressure, &r->parameters.velocity, 1, &p, &err),
        WT_OK);
    wt_friction_workspace_free(w);
    return p;
}

static wt_energy_source source_at(rig *r, double thickness)
{
    wt_energy_source source;
    wt_layer_parameters p;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(energy(thickness, r, &source, &p, &err), WT_OK);
    return source;
}

/* Of map slopes, eigenvalues and the wear rate of a fold. */
#define DIGITS_OF_SLOPES 1e-7
#define DIGITS_OF_FOLDS 1e-10

static void check_root(rig *r, const wt_layer_root *root, const double *v)
{
    /* the thinnest root of three has R = 1.03, which makes 41 times of an error of the friction:
     * that of the reference is 2.4e-12, that of the library below 1e-14, by truth.c */
    assert_near(root->thickness, v[0], 2 * r->digits);
    assert_int_equal(root->stable, v[1]);
    assert_near(root->map_slope, v[2], DIGITS_OF_SLOPES);
    assert_near(root->eigenvalue, v[3], DIGITS_OF_SLOPES);
    const wt_friction_point p = friction_at(r, v[0]);
    assert_near(p.hysteresis.value, v[4], r->digits);
    assert_near(p.area_ratio.value, v[5], r->digits);
    assert_near(p.stress_variance.value, v[6], r->digits);
    wt_energy_source source = source_at(r, v[0]);
    assert_near(wt_energy_tail(&source, 0), v[7], r->digits);
    wt_energy_source_clear(&source);
}

static void check_one_way(rig *r, double time, double thickness)
{
    wt_energy_source source = source_at(r, 0);
    wt_layer_point point;
    wt_layer_steady_state balance;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_layer_history(&source, &r->parameters, &time, 1, &point, &err), WT_OK);
    assert_int_equal(wt_layer_steady_state_compute(&source, &r->parameters, &balance, &err), WT_OK);
    assert_near(isfinite(time) && time > 0 ? point.thickness.value : balance.thickness.value,
                thickness, r->digits);
    wt_energy_source_clear(&source);
}

/* The balance under the power of a layer of a thickness. */
static double mapped(rig *r, double thickness)
{
    wt_energy_source source = source_at(r, thickness);
    wt_layer_steady_state balance;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_layer_steady_state_compute(&source, &r->parameters, &balance, &err), WT_OK);
    wt_energy_source_clear(&source);
    return balance.thickness.value;
}

static void check_map(rig *r, const case_line *line)
{
    for (size_t i = 1; i < line->n; i++)
        assert_near(mapped(r, line->value[i - 1]), line->value[i], r->digits);
}

/* Where the map ends, and after about how many steps: both as the reference asks for. */
static void check_map_end(rig *r, const double *v)
{
    double now = 0, last;
    int steps = 0;
    do {
        last = now;
        now = mapped(r, last);
    } while (++steps < 100 && fabs(now - last) > 1e-12 * now);
    assert_near(now, v[0], 1e-9);
    assert_true(steps > v[1] / 3 && steps < 3 * v[1]);
}

static void check_friction(const rig *r, const double *v)
{
    wt_layer_shear shear = wt_layer_shear_defaults();
    shear.exponent = 0.5;
    const wt_layer_state layer = {.thickness = v[0], .modulus_ratio = r->ratio};
    const wt_friction_point p = friction_at(r, v[0]);
    /* the reference counts the opening of cracks, 2 G / (spacing sqrt(pi A/A0)), G = 0.5 J/m^2 */
    const double cracks = 2 * 0.5 / (1e-5 * sqrt(M_PI * p.area_ratio.value)),
                 tau = wt_layer_shear_stress(&shear, 4e6, layer) + cracks;
    assert_near(p.hysteresis.value, v[1], r->digits);
    assert_near(p.area_ratio.value, v[2], r->digits);
    assert_near(tau, v[3], r->digits);
    assert_near(p.hysteresis.value + tau * p.area_ratio.value / r->parameters.pressure, v[4],
                r->digits);
}

static void check_case(const numeric_case *c)
{
    rig r = rig_of(c);
    wt_layer_feedback loop;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_layer_feedback_solve(energy, &r, 1e-9, 2e-3,
                                             (size_t)case_number(c, false, "grid", 160), &loop,
                                             &err),
                     WT_OK);
    size_t roots = loop.n_roots > 0 && loop.root[0].thickness == 0, folds = 0;
    assert_int_equal(roots, loop.ratio <= 1);
    for (size_t i = 0; i < c->n; i++) {
        const case_line *line = &c->lines[i];
        const double *v = line->value;
        if (!line->expected)
            continue;
        if (strcmp(line->key, "bare") == 0) {
            assert_near(loop.ratio, v[0], r.digits);
            assert_near(friction_at(&r, 0).hysteresis.value, v[1], r.digits);
            assert_near(friction_at(&r, 0).area_ratio.value, v[2], r.digits);
        } else if (strcmp(line->key, "one_way") == 0) {
            check_one_way(&r, 0, v[0]);
        } else if (strcmp(line->key, "map") == 0) {
            check_map(&r, line);
        } else if (strcmp(line->key, "map_end") == 0) {
            check_map_end(&r, v);
        } else if (strcmp(line->key, "root") == 0) {
            assert_true(roots < loop.n_roots);
            check_root(&r, &loop.root[roots++], v);
        } else if (strcmp(line->key, "fold") == 0) {
            assert_true(folds < loop.n_folds);
            assert_near(loop.fold[folds].thickness, v[0], 5e-6); /* flat to 1e-11 */
            assert_near(loop.fold[folds].specific_wear_rate, v[1], DIGITS_OF_FOLDS);
            assert_int_equal(loop.fold[folds++].maximum, v[2]);
        } else if (strcmp(line->key, "acts_back") == 0) {
            wt_layer_point point;
            assert_int_equal(wt_layer_feedback_history(energy, &r, &loop, v, 1, &point, &err),
                             WT_OK);
            assert_near(point.thickness.value, v[1], r.digits);
            check_one_way(&r, v[0], v[2]);
        } else if (strcmp(line->key, "friction") == 0) {
            check_friction(&r, v);
        } else
            fail_msg("%s: what is %s?", c->name, line->key);
    }
    assert_int_equal(roots, loop.n_roots);
    assert_int_equal(folds, loop.n_folds);
    rig_free(&r);
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/layer-loop.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    size_t cases = 0;
    assert_non_null(in);
    assert_non_null(c);
    for (; case_read(in, c); cases++)
        check_case(c);
    assert_int_equal(cases, 5);
    fclose(in);
    free(c);
}

/* What acts back by nothing is the layer of one way. */
static void soft_as_the_bulk(void **state)
{
    (void)state;
    numeric_case none = {.n = 0};
    rig r = rig_of(&none);
    r.parameters.critical_energy = 2e11;
    r.parameters.specific_wear_rate = 1e-12;
    r.parameters.pressure = 4e5;
    r.parameters.velocity = 0.05;
    r.profile = WT_PROFILE_PERSSON;
    wt_layer_feedback loop;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(wt_layer_feedback_solve(energy, &r, 1e-8, 1e-4, 20, &loop, &err), WT_OK);
    assert_int_equal(loop.n_roots, 1);
    assert_int_equal(loop.n_folds, 0);
    assert_near_abs(loop.root[0].map_slope, 0, 1e-6);
    check_one_way(&r, 0, loop.root[0].thickness);
    wt_layer_point point;
    const double time = 30;
    assert_int_equal(wt_layer_feedback_history(energy, &r, &loop, &time, 1, &point, &err), WT_OK);
    check_one_way(&r, time, point.thickness.value);
    rig_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(numeric_cases),
                                       cmocka_unit_test(soft_as_the_bulk)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
