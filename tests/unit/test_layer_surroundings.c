/* Computations around the modified layer against numeric cases: a blunted pyramid, the frequency of
 * a ramp, two groups, a ball on a disc.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "core/math/students_t.h"
#include "numeric/cases.h"
#include "weartrack/record.h"
#include "weartrack/study.h"

#define DIGITS 1e-12

static double number(const numeric_case *c, const char *key)
{
    return case_number(c, false, key, (double)NAN);
}

static bool is(const case_line *line, const char *key)
{
    return strcmp(line->key, key) == 0;
}

/* ---- a pyramid ------------------------------------------------------------------------------- */

static void check_tip(const numeric_case *c, const case_line *line)
{
    const double *v = line->value, nu = number(c, "poisson_ratio"),
                 modulus = number(c, "modulus") / (1 - nu * nu), cantilever = 0.1;
    wt_tip tip = {.shape = WT_TIP_BLUNTED_PYRAMID,
                  .sides = (unsigned)number(c, "sides"),
                  .half_angle = number(c, "half_angle_degrees") * M_PI / 180,
                  .radius = number(c, "radius")};
    double g, slope;
    tip.transition_radius = is(line, "slope") ? tip.radius / tan(tip.half_angle)
                            : is(line, "sharp")
                                ? 0
                                : wt_tip_tangent_transition(tip.radius, tip.half_angle);
    if (is(line, "sphere"))
        tip.shape = WT_TIP_PARABOLOID;
    if (is(line, "sharp") || is(line, "sphere")) {
        wt_contact_function(&tip, v[0], &g, &slope);
        assert_near(modulus * g, v[1], DIGITS);
    } else if (is(line, "meets")) {
        const double b = tip.transition_radius;
        wt_contact_function(&tip, b * b / tip.radius, &g, &slope);
        assert_near(modulus * g, v[0], DIGITS);
        assert_near(slope, 2 * b, DIGITS);
    } else if (is(line, "tangent") || is(line, "slope")) {
        wt_contact_function(&tip, v[1], &g, &slope);
        assert_near(modulus * g, v[2], DIGITS);
        assert_near(slope, 2 * v[0], DIGITS);
        if (line->n > 3) {
            assert_near(modulus * slope, v[3], DIGITS);
            assert_near(modulus * g / cantilever, v[4], DIGITS);
        }
    } else
        fail_msg("%s: what is %s?", c->name, line->key);
}

/* ---- a ramp ---------------------------------------------------------------------------------- */

static void check_ramp(const numeric_case *c, const case_line *line)
{
    const double *v = line->value;
    if (is(line, "power"))
        assert_near(wt_equivalent_frequency(1, v[0]), v[1], DIGITS);
    else if (is(line, "loading")) {
        assert_near(wt_equivalent_frequency(v[0], 2), v[1], DIGITS);
        assert_near(wt_equivalent_frequency(v[0], 2) / (2 * M_PI), v[2], DIGITS);
    } else
        fail_msg("%s: what is %s?", c->name, line->key);
}

/* ---- two groups ------------------------------------------------------------------------------ */

static wt_log_ratio mean_of(const case_line *group)
{
    const moments m = sample_moments(group->value, group->n);
    return (wt_log_ratio){m.mean, sqrt(m.variance / m.n), m.n - 1};
}

/* The comparison of two means does not depend on their quantity. */
static void check_groups(const numeric_case *c, const case_line *line)
{
    const wt_log_ratio bulk = mean_of(case_find(c, false, "bulk")),
                       track = mean_of(case_find(c, false, "track"));
    const wt_log_ratio_difference apart = wt_log_ratio_compare(&bulk, &track);
    const double error = (apart.high - apart.low) / 2 / students_t_quantile(apart.df);
    assert_string_equal(line->key, "welch");
    assert_near(apart.value / error, line->value[0], DIGITS);
    assert_near(apart.df, line->value[1], DIGITS);
    assert_near(apart.p, line->value[2], DIGITS);
}

/* ---- a ball ---------------------------------------------------------------------------------- */

/* Over the track by Simpson's rule, which is exact for a parabola. */
static double mean_duty(double contact_radius, double track_radius)
{
    double duty[3];
    for (int i = 0; i < 3; i++)
        duty[i] = wt_ball_duty(contact_radius, track_radius, (i - 1) * contact_radius);
    return (duty[0] + 4 * duty[1] + duty[2]) / 6;
}

static void check_ball(const numeric_case *c, const case_line *line, wt_ball_contact *ball)
{
    const double *v = line->value, modulus = number(c, "modulus"), nu = number(c, "poisson_ratio"),
                 radius = number(c, "ball_radius"), track = number(c, "track_radius"),
                 rate = number(c, "specific_wear_rate"), velocity = number(c, "velocity");
    if (is(line, "ball")) {
        const double load = wt_ball_load(v[0], radius, modulus, nu);
        assert_near(load, v[3], DIGITS);
        *ball = wt_ball_contact_compute(load, radius, modulus, nu);
        assert_near(ball->contact_radius, v[2], DIGITS);
        assert_near(ball->pressure, v[0], DIGITS);
        assert_near(1.5 * ball->pressure, v[1], DIGITS);
    } else if (is(line, "contact")) {
        *ball = wt_ball_contact_compute(number(c, "load"), radius, modulus, nu);
        assert_near(ball->contact_radius, v[0], DIGITS);
        assert_near(ball->pressure, v[1], DIGITS);
        assert_near(1.5 * ball->pressure, v[2], DIGITS);
    } else if (is(line, "duty")) {
        const double duty = wt_ball_duty(ball->contact_radius, track, v[0] * ball->contact_radius);
        assert_near(duty, v[1], DIGITS);
        assert_near(rate * ball->pressure * velocity * duty, v[2], DIGITS);
    } else if (is(line, "mean_duty"))
        assert_near(mean_duty(ball->contact_radius, track), v[0], DIGITS);
    else if (is(line, "volume_rate")) /* depth by width by length of the track, in a metre */
        assert_near(rate * ball->pressure * mean_duty(ball->contact_radius, track) * 2 *
                        ball->contact_radius * 2 * M_PI * track,
                    v[0], DIGITS);
    else
        fail_msg("%s: what is %s?", c->name, line->key);
}

/* Unknown is not 0, and outside the track there is no contact. */
static void duty_without_contact(void **state)
{
    (void)state;
    assert_true(wt_ball_duty(1e-3, 1e-2, 1.1e-3) == 0);
    assert_true(isnan(wt_ball_duty(1e-3, 1e-2, (double)NAN)));
    assert_true(isnan(wt_ball_duty((double)NAN, 1e-2, 0)));
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/layer-around.txt", "r");
    numeric_case *c = malloc(sizeof *c);
    size_t lines = 0;
    assert_non_null(in);
    assert_non_null(c);
    while (case_read(in, c)) {
        wt_ball_contact ball = {(double)NAN, (double)NAN};
        for (size_t i = 0; i < c->n; i++) {
            const case_line *line = &c->lines[i];
            if (!line->expected)
                continue;
            lines++;
            if (!isnan(number(c, "half_angle_degrees")))
                check_tip(c, line);
            else if (case_find(c, false, "bulk") != NULL)
                check_groups(c, line);
            else if (!isnan(number(c, "ball_radius")))
                check_ball(c, line, &ball);
            else
                check_ramp(c, line);
        }
    }
    assert_int_equal(lines, 24);
    fclose(in);
    free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(numeric_cases),
                                       cmocka_unit_test(duty_without_contact)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
