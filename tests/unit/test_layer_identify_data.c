/* Critical energy and wear rate from data with their covariance, and a ball on a viscoelastic
 * rubber, against independent values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "numeric/friction_scene.h"
#include "weartrack/record.h"

#include <stdlib.h>

/* "Eleven digits", thirteen of a load for a pressure. */
#define DIGITS 1e-11
#define DIGITS_OF_LOADS 1e-13
/* By differences of nine points over 1e-2, which lose two digits. */
#define DIGITS_OF_SLOPES 1e-11
/* "Map slope 7 digits". */
#define DIGITS_OF_MAP 1e-7
/* Friction in double precision, at two resolutions. */
#define DIGITS_OF_FRICTION 1e-11

static double number(const numeric_case *c, const char *key)
{
    return case_number(c, false, key, (double)NAN);
}

/* Numbers that may be 0. */
static void near_all(const char *what, const double *is, const double *expected, size_t n,
                     double digits)
{
    for (size_t i = 0; i < n; i++)
        if (!(fabs(is[i] - expected[i]) <= digits * (1 + fabs(expected[i]))))
            fail_msg("%s %zu: %.15g, expected %.15g", what, i, is[i], expected[i]);
}

/* ---- from data ------------------------------------------------------------------------------- */

enum { THICKNESS, TIME_OR_WEAR, MU, PRESSURE, VELOCITY, INPUTS };
typedef enum kind { BALANCE, TRANSPORT, WEAR, KINDS } kind;
static const char *const kind_words[KINDS] = {"balance", "transport", "wear"};

/* ln U_c and ln k for the inputs times exp(step). */
static wt_identified_constants identified(const numeric_case *c, kind by, const double step[INPUTS])
{
    double power[8];
    const case_line *q = case_find(c, false, "wavenumber"), *share = case_find(c, false, "share");
    const double mu = number(c, "mu") * exp(step[MU]);
    wt_layer_parameters p = wt_layer_defaults();
    wt_identified_constants out = {0};
    wt_error err = WT_ERROR_INIT;
    assert_true(q->n <= 8 && q->n == share->n);
    p.pressure = number(c, "pressure") * exp(step[PRESSURE]);
    p.velocity = number(c, "velocity") * exp(step[VELOCITY]);
    p.damage = number(c, "damage");
    p.incubation = by == TRANSPORT;
    for (size_t i = 0; i < q->n; i++)
        power[i] = share->value[i] * mu * p.pressure * p.velocity;
    const wt_energy_source source = {
        .n = q->n,
        .wavenumber = (double *)q->value,
        .power = power,
        .profile = strcmp(case_word(c, false, "profile"), "incompressible") == 0
                       ? WT_PROFILE_INCOMPRESSIBLE
                       : WT_PROFILE_PERSSON,
        .local_friction = number(c, "local_friction")};
    const double thickness = number(c, "thickness") * exp(step[THICKNESS]),
                 time = number(c, "time") * exp(step[TIME_OR_WEAR]),
                 worn = number(c, "worn") * exp(step[TIME_OR_WEAR]);
    const wt_status status =
        by == WEAR ? wt_layer_identify_wear(&source, &p, thickness,
                                            worn / (p.pressure * p.velocity), &out, &err)
                   : wt_layer_identify_time(&source, &p, thickness, time, number(c, "reached"),
                                            &out, &err);
    if (status != WT_OK)
        fail_msg("%s: %s %s", c->name, err.message, err.found);
    return out;
}

/* d ln U_c / d ln of an input, and d ln k. */
static void slopes_of(const numeric_case *c, kind by, size_t input, double *energy, double *wear)
{
    const double h = 1e-2, weight[] = {-1.0 / 280, 4.0 / 105, -1.0 / 5, 4.0 / 5};
    *energy = *wear = 0;
    for (size_t i = 0; i < 4; i++) {
        double step[INPUTS] = {0};
        step[input] = (4.0 - (double)i) * h;
        const wt_identified_constants up = identified(c, by, step);
        step[input] = -step[input];
        const wt_identified_constants down = identified(c, by, step);
        *energy += weight[i] / h * log(up.critical_energy / down.critical_energy);
        *wear += weight[i] / h * log(up.specific_wear_rate / down.specific_wear_rate);
    }
}

static const case_line *line_of(const numeric_case *c, kind by, const char *suffix)
{
    char key[CASE_NAME];
    snprintf(key, sizeof key, "%s%s", kind_words[by], suffix);
    const case_line *line = case_find(c, true, key);
    if (line == NULL)
        fail_msg("%s: no %s", c->name, key);
    return line;
}

static void check_data(const numeric_case *c)
{
    const double none[INPUTS] = {0};
    const double *const error = case_find(c, false, "errors")->value;
    for (kind by = 0; by < KINDS; by++) {
        const wt_identified_constants is = identified(c, by, none);
        const double *const expected = line_of(c, by, "")->value;
        assert_near(is.critical_energy, expected[0], DIGITS);
        assert_near(1e9 * is.specific_wear_rate, expected[1], DIGITS);
        assert_near(is.ratio, expected[2], DIGITS);
        double slope[2 * INPUTS], energy = 0, both = 0, wear = 0;
        for (size_t i = 0; i < INPUTS; i++) {
            slopes_of(c, by, i, &slope[i], &slope[INPUTS + i]);
            const double square = error[i] * error[i];
            energy += slope[i] * slope[i] * square;
            both += slope[i] * slope[INPUTS + i] * square;
            wear += slope[INPUTS + i] * slope[INPUTS + i] * square;
        }
        near_all("slope", slope, line_of(c, by, "_slopes")->value, 2 * INPUTS, DIGITS_OF_SLOPES);
        const double covariance[] = {energy,       both,      wear, both / sqrt(energy * wear),
                                     sqrt(energy), sqrt(wear)};
        near_all("covariance", covariance, line_of(c, by, "_covariance")->value, 6,
                 DIGITS_OF_SLOPES);
    }
}

/* ---- a ball ---------------------------------------------------------------------------------- */

typedef struct rig {
    const numeric_case *c;
    case_scene scene;
    wt_material *material;
    wt_friction_workspace *workspace;
    double radius, velocity;
} rig;

/* |E|, E' and E'' at a frequency. */
static void moduli_at(const rig *r, double omega, double *absolute, double *storage, double *loss)
{
    r->material->law->modulus(r->material, &omega, 1, storage, loss);
    *absolute = hypot(*storage, *loss);
}

/* Contact radius whose frequency gives the modulus for this radius: the map of ln a has a slope
 * below 1/3. */
static wt_ball_contact settle(const rig *r, double load, double factor, bool by_storage)
{
    wt_ball_contact ball = {.contact_radius = 1e-3};
    for (int i = 0; i < 60; i++) {
        double absolute, storage, loss;
        moduli_at(r, factor * r->velocity / ball.contact_radius, &absolute, &storage, &loss);
        ball = wt_ball_contact_compute(load, r->radius, by_storage ? storage : absolute,
                                       r->scene.s.nu);
    }
    return ball;
}

static void check_ball(const rig *r, const double *v)
{
    double absolute, storage, loss, up, down, ignored;
    const double h = 1e-4;
    const bool by_storage = v[2] > 0;
    const wt_ball_contact ball = settle(r, v[0], v[1], by_storage);
    const double a = ball.contact_radius, omega = v[1] * r->velocity / a;
    moduli_at(r, omega, &absolute, &storage, &loss);
    const double nu = r->scene.s.nu, used = by_storage ? storage : absolute;
    const double is[] = {a,
                         omega,
                         absolute,
                         storage,
                         loss / storage,
                         used / (1 - nu * nu),
                         a * a / r->radius,
                         ball.pressure,
                         1.5 * ball.pressure,
                         a / (4 * number(r->c, "track_radius"))};
    for (size_t i = 0; i < sizeof is / sizeof *is; i++)
        assert_near(is[i], v[3 + i], DIGITS);
    /* a^3 is proportional to 1/E, and E depends on the frequency, which is proportional to 1/a */
    moduli_at(r, omega * exp(h), by_storage ? &ignored : &up, by_storage ? &up : &ignored, &loss);
    moduli_at(r, omega * exp(-h), by_storage ? &ignored : &down, by_storage ? &down : &ignored,
              &loss);
    assert_near(log(up / down) / (6 * h), v[13], DIGITS_OF_MAP);
}

static wt_friction_point friction_at(const rig *r, double pressure)
{
    wt_friction_point p;
    wt_error err = WT_ERROR_INIT;
    if (wt_friction_compute(r->workspace, pressure, &r->velocity, 1, &p, &err) != WT_OK)
        fail_msg("%s", err.message);
    return p;
}

/* 3 int_0^1 mu(p_max u) u^2 du, by three-point Gauss rules on subintervals that double away from
 * 0. */
static double weighted(const rig *r, double most)
{
    static const double node[] = {-0.774596669241483377, 0, 0.774596669241483377},
                        weight[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    enum { DOUBLINGS = 14, PARTS = 12 };
    double sum = 0;
    for (int k = 0; k < DOUBLINGS; k++) {
        const double from = k == 0 ? 0 : ldexp(1, k - DOUBLINGS), to = ldexp(1, k + 1 - DOUBLINGS);
        for (int part = 0; part < PARTS; part++)
            for (int i = 0; i < 3; i++) {
                const double half = (to - from) / (2 * PARTS),
                             u = from + half * (2 * part + 1 + node[i]);
                sum += 3 * half * weight[i] * friction_at(r, most * u).hysteresis.value * u * u;
            }
    }
    return sum;
}

static void check_under(const rig *r, const double *ball, const double *v)
{
    const double mean = ball[10], most = ball[11];
    const wt_friction_point p = friction_at(r, mean);
    assert_near(p.hysteresis.value, v[0], DIGITS_OF_FRICTION);
    assert_near(p.area_ratio.value, v[1], DIGITS_OF_FRICTION);
    assert_near(p.stress_variance.value, v[2], DIGITS_OF_FRICTION);
    assert_near(weighted(r, most), v[3], DIGITS_OF_FRICTION);
    assert_near(friction_at(r, most).hysteresis.value, v[4], DIGITS_OF_FRICTION);
}

/* Load for a mean pressure at which the contact has that modulus. */
static void check_load(rig *r, const double *v)
{
    double storage, loss, absolute = v[4], force = 0;
    r->velocity = v[1];
    for (int i = 0; i < 60; i++) {
        force = wt_ball_load(v[0], r->radius, absolute, r->scene.s.nu);
        const double a =
            wt_ball_contact_compute(force, r->radius, absolute, r->scene.s.nu).contact_radius;
        moduli_at(r, r->velocity / a, &absolute, &storage, &loss);
    }
    const wt_ball_contact ball = wt_ball_contact_compute(force, r->radius, absolute, r->scene.s.nu);
    assert_near(ball.contact_radius, v[2], DIGITS_OF_LOADS);
    assert_near(force, v[3], DIGITS_OF_LOADS);
    assert_near(absolute, v[4], DIGITS_OF_LOADS);
    assert_near(ball.contact_radius / r->radius, v[5], DIGITS_OF_LOADS);
    assert_near(ball.pressure, v[0], DIGITS_OF_LOADS);
}

static void check_balls(const numeric_case *c)
{
    rig *r = calloc(1, sizeof *r);
    wt_roughness *road = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_non_null(r);
    r->c = c;
    r->radius = number(c, "ball_radius");
    r->velocity = number(c, "velocity");
    case_to_scene(c, &r->scene);
    assert_int_equal(scene_material(&r->scene.s, &r->material, &err), WT_OK);
    if (!isnan(number(c, "q0"))) {
        wt_friction_options options = wt_friction_defaults();
        options.tolerance = 1e-11;
        assert_int_equal(scene_roughness(&r->scene.s, &road, &err), WT_OK);
        assert_int_equal(
            wt_friction_workspace_new(r->material, road, &options, &r->workspace, &err), WT_OK);
    }
    const double *ball = NULL;
    for (size_t i = 0; i < c->n; i++) {
        const case_line *line = &c->lines[i];
        if (!line->expected)
            continue;
        if (strcmp(line->key, "ball") == 0)
            check_ball(r, ball = line->value);
        else if (strcmp(line->key, "under") == 0)
            check_under(r, ball, line->value);
        else if (strcmp(line->key, "load") == 0)
            check_load(r, line->value);
        else
            fail_msg("%s: what is %s?", c->name, line->key);
    }
    wt_friction_workspace_free(r->workspace);
    wt_roughness_free(road);
    wt_material_free(r->material);
    free(r);
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/layer-data.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    size_t data = 0, balls = 0;
    assert_non_null(in);
    assert_non_null(c);
    while (case_read(in, c)) {
        const bool of_ball = !isnan(number(c, "ball_radius"));
        (of_ball ? check_balls : check_data)(c);
        balls += of_ball ? 1 : 0;
        data += of_ball ? 0 : 1;
    }
    assert_int_equal(data, 3);
    assert_int_equal(balls, 4);
    fclose(in);
    free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(numeric_cases)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
