/* Tips and contact laws: reference values, limits, continuity, the table against the function.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "weartrack/indentation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double degree = M_PI / 180.0;

static wt_tip pyramid(unsigned sides, double degrees, double radius, double transition)
{
    return (wt_tip){.shape = WT_TIP_BLUNTED_PYRAMID,
                    .sides = sides,
                    .half_angle = degrees * degree,
                    .radius = radius,
                    .transition_radius = transition < 0.0
                                             ? wt_tip_tangent_transition(radius, degrees * degree)
                                             : transition};
}

/* The smooth cap: b = R m cot(theta). */
static wt_tip rounded(unsigned sides, double degrees, double radius)
{
    double m = sides == 0 ? 1.0 : sides / M_PI * sin(M_PI / sides);
    return pyramid(sides, degrees, radius, radius * m / tan(degrees * degree));
}

static wt_contact_table *table_of(const wt_tip *tip, double lo, double hi)
{
    wt_contact_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_contact_table_new(tip, lo, hi, &table, &err) != WT_OK)
        fail_msg("%s; %s; %s", err.message, err.expected, err.found);
    return table;
}

static void check_point(const wt_tip *tip, double delta, double g, double slope)
{
    double got_g = 0.0, got_slope = 0.0;
    wt_contact_function(tip, delta, &got_g, &got_slope);
    assert_near(got_g, g, 1e-13);
    assert_near(got_slope, slope, 1e-13);
    wt_contact_table *table = table_of(tip, 0.5 * delta, 2.0 * delta);
    wt_contact_table_eval(table, &delta, 1, &got_g, &got_slope);
    assert_near(got_g, g, 1e-11);
    assert_near(got_slope, slope, 1e-11);
    wt_contact_table_free(table);
}

static void numeric_cases(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/blunted_pyramid.txt", "r");
    assert_non_null(in);
    char line[512];
    int n = 0;
    while (fgets(line, sizeof line, in) != NULL) {
        if (line[0] == '#')
            continue;
        unsigned sides = 0;
        double degrees, radius, b, delta, g, slope;
        assert_int_equal(sscanf(line, "%u %lf %lf %lf %lf %lf %lf", &sides, &degrees, &radius, &b,
                                &delta, &g, &slope),
                         7);
        wt_tip tip = pyramid(sides, degrees, radius, b);
        const clock_t start = clock();
        check_point(&tip, delta, g, slope);
        assert_true(clock() - start < CLOCKS_PER_SEC);
        n++;
    }
    fclose(in);
    assert_true(n >= 40);
}

/* All rows of the shared reference data, if they exist: E = 1e6 Pa, nu = 0.5. */
static void shared_reference(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SHARED_DIR "/reference/blunted-pyramid.csv", "r");
    if (in == NULL)
        skip();
    char line[512];
    int n = 0;
    while (fgets(line, sizeof line, in) != NULL) {
        unsigned sides = 0;
        double degrees, radius, b, delta, a, force, stiffness;
        char rule[32], ratio[32];
        if (sscanf(line, "%u,%lf,%lf,%31[^,],%lf,%31[^,],%lf,%lf,%lf,%lf", &sides, &degrees,
                   &radius, rule, &b, ratio, &delta, &a, &force, &stiffness) != 10)
            continue;
        wt_tip tip = pyramid(sides, degrees, radius, b);
        const double reduced = 1e6 / 0.75;
        check_point(&tip, delta, force / reduced, stiffness / reduced);
        n++;
    }
    fclose(in);
    assert_int_equal(n, 924);
}

static void sharp_limits(void **state)
{
    (void)state;
    /* G = 2/(pi m) tan(theta) delta^2, Sneddon for the cone. */
    const struct {
        unsigned sides;
        double factor;
    } cases[] = {{4, 0.70710678118654752}, {3, 0.76980035891950105}, {6, 2.0 / 3.0}, {0, M_2_PI}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double g = 0.0, slope = 0.0, expected = cases[i].factor * tan(35 * degree) * 1e-14;
        wt_tip sharp = pyramid(cases[i].sides, 35, 20e-9, 0.0);
        wt_contact_function(&sharp, 1e-7, &g, &slope);
        assert_near(g, expected, 1e-14);
        assert_near(slope, 2.0 * expected / 1e-7, 1e-14);
        /* b -> 0: the remaining effect of the cap is of the order b/delta. */
        wt_tip nearly = pyramid(cases[i].sides, 35, 20e-9, 1e-16);
        wt_contact_function(&nearly, 1e-7, &g, &slope);
        assert_near(g, expected, 1e-8);
        assert_near(slope, 2.0 * expected / 1e-7, 1e-8);
        double ten_times_deeper = 0.0;
        wt_contact_function(&nearly, 1e-6, &ten_times_deeper, &slope);
        assert_near(ten_times_deeper, 100.0 * expected, 1e-9);
    }
    wt_tip cone = {.shape = WT_TIP_CONE, .half_angle = 20 * degree};
    double g = 0.0, slope = 0.0;
    wt_contact_function(&cone, 3e-8, &g, &slope);
    assert_near(g, M_2_PI * tan(20 * degree) * 9e-16, 1e-14);
    assert_near(slope, 2.0 * M_2_PI * tan(20 * degree) * 3e-8, 1e-14);
}

/* From a millionth of the radius to a million radii: the sphere of Hertz for small depths, the flat
 * punch for large ones. */
static void sphere_of_sneddon(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/sphere.txt", "r");
    assert_non_null(in);
    char line[256];
    int n = 0;
    while (fgets(line, sizeof line, in) != NULL) {
        double radius, delta, g, slope;
        if (line[0] == '#')
            continue;
        assert_int_equal(sscanf(line, "%lf %lf %lf %lf", &radius, &delta, &g, &slope), 4);
        check_point(&(wt_tip){.shape = WT_TIP_SPHERE, .radius = radius}, delta, g, slope);
        n++;
    }
    fclose(in);
    assert_int_equal(n, 15);
}

/* A thin sample against the integral equation: 0.4 %, but 2.5 % at a wide cap and for a sphere with
 * a depth above a ninth. With a distant base it is a half-space. */
static void thin_sample(void **state)
{
    (void)state;
    FILE *in = fopen(WT_SOURCE_DIR "/tests/numeric/thin_sample.txt", "r");
    assert_non_null(in);
    char line[256];
    int n = 0;
    while (fgets(line, sizeof line, in) != NULL) {
        char base, name[16];
        unsigned sides;
        double radius, delta, expected, g, slope, thick;
        if (line[0] == '#')
            continue;
        assert_int_equal(
            sscanf(line, "%c %15s %u %lf %lf %lf", &base, name, &sides, &radius, &delta, &expected),
            6);
        wt_tip tip = pyramid(sides, 35, radius, -1.0);
        if (strcmp(name, "pyramid") != 0)
            tip.shape = strcmp(name, "sphere") == 0       ? WT_TIP_SPHERE
                        : strcmp(name, "paraboloid") == 0 ? WT_TIP_PARABOLOID
                        : strcmp(name, "cone") == 0       ? WT_TIP_CONE
                                                          : WT_TIP_PUNCH;
        wt_contact_function(&tip, delta, &thick, &slope);
        tip.sample_thickness.value = 1.0;
        tip.unbonded = base == 'u';
        wt_contact_function(&tip, delta, &g, &slope);
        const bool hard =
            (tip.shape == WT_TIP_SPHERE && delta > radius / 9) || (name[1] == 'y' && radius > 0.4);
        assert_near(g, expected, hard ? 0.025 : 0.004);
        assert_true(g > 1.03 * thick);
        double more, less, unused;
        wt_contact_function(&tip, delta * (1 + 1e-6), &more, &unused);
        wt_contact_function(&tip, delta * (1 - 1e-6), &less, &unused);
        assert_near(slope, (more - less) / (2e-6 * delta), 1e-6);
        wt_contact_table *table = table_of(&tip, 1e-3 * delta, 10 * delta);
        wt_contact_table_eval(table, &delta, 1, &more, &unused);
        wt_contact_table_free(table);
        assert_near(more, g, 1e-11);
        assert_near(unused, slope, 1e-6);
        tip.sample_thickness.value = 1e6;
        wt_contact_function(&tip, delta, &g, &slope);
        assert_near(g, thick, 2e-6);
        n++;
    }
    fclose(in);
    assert_int_equal(n, 96);
}

static void flat_punch(void **state)
{
    (void)state;
    const wt_tip tip = {.shape = WT_TIP_PUNCH, .radius = 2e-6};
    for (double delta = 2e-12; delta < 3.0; delta *= 10.0)
        check_point(&tip, delta, 2.0 * 2e-6 * delta, 4e-6);
}

static void sphere_below_the_switch(void **state)
{
    (void)state;
    wt_tip tip = pyramid(4, 35, 20e-9, -1.0);
    wt_tip sphere = {.shape = WT_TIP_PARABOLOID, .radius = 20e-9};
    double at = tip.transition_radius * tip.transition_radius / tip.radius;
    for (double delta = 1e-15; delta < at; delta *= 3.0) {
        double g, slope, g2, slope2;
        wt_contact_function(&tip, delta, &g, &slope);
        wt_contact_function(&sphere, delta, &g2, &slope2);
        assert_true(g == g2 && slope == slope2);
        assert_near(g, 4.0 / 3.0 * sqrt(20e-9) * pow(delta, 1.5), 1e-14);
        assert_near(slope, 2.0 * sqrt(20e-9 * delta), 1e-14);
    }
}

static void continuous_at_the_switch(void **state)
{
    (void)state;
    const wt_tip tips[] = {pyramid(4, 20, 20e-9, -1.0), pyramid(3, 35, 7e-9, 3e-9),
                           rounded(4, 35, 20e-9), rounded(0, 60, 20e-9)};
    for (size_t i = 0; i < sizeof tips / sizeof tips[0]; i++) {
        double b = tips[i].transition_radius, at = b * b / tips[i].radius;
        double below, below_slope, above, above_slope;
        wt_contact_function(&tips[i], at * (1 - 1e-14), &below, &below_slope);
        wt_contact_function(&tips[i], at * (1 + 1e-14), &above, &above_slope);
        assert_near(above, below, 1e-13);
        /* The slope 2a is continuous at 2b; its derivative jumps (not for the smooth cap). */
        assert_near(above_slope, 2.0 * b, 1e-12);
        assert_near(below_slope, 2.0 * b, 1e-12);
    }
}

static void slope_is_the_derivative(void **state)
{
    (void)state;
    const wt_tip tips[] = {pyramid(4, 20, 20e-9, -1.0), pyramid(0, 50, 7e-9, 3e-9),
                           rounded(4, 35, 20e-9)};
    for (size_t i = 0; i < sizeof tips / sizeof tips[0]; i++) {
        for (double delta = 1e-10; delta < 1e-5; delta *= 2.385) {
            double h = 1e-4 * delta, g[4], slope, unused;
            const double at[4] = {delta - 2 * h, delta - h, delta + h, delta + 2 * h};
            for (size_t k = 0; k < 4; k++)
                wt_contact_function(&tips[i], at[k], &g[k], &unused);
            wt_contact_function(&tips[i], delta, &unused, &slope);
            assert_near((g[0] - 8 * g[1] + 8 * g[2] - g[3]) / (12 * h), slope, 1e-9);
        }
    }
}

static void no_contact_and_not_a_number(void **state)
{
    (void)state;
    wt_tip tip = pyramid(4, 35, 20e-9, -1.0);
    wt_contact_table *table = table_of(&tip, 1e-10, 1e-6);
    const double delta[4] = {0.0, -1e-9, -(double)INFINITY, (double)NAN};
    double g[4], slope[4];
    wt_contact_table_eval(table, delta, 4, g, slope);
    for (size_t i = 0; i < 4; i++) {
        double g1 = 1.0, slope1 = 1.0;
        wt_contact_function(&tip, delta[i], &g1, &slope1);
        assert_near(g1, i < 3 ? 0.0 : (double)NAN, 0.0);
        assert_near(slope1, i < 3 ? 0.0 : (double)NAN, 0.0);
        assert_near(g[i], g1, 0.0);
        assert_near(slope[i], slope1, 0.0);
    }
    wt_contact_table_free(table);
}

/* Dense points across the switch and the limits of the table. */
static void table_agrees_with_function(void **state)
{
    (void)state;
    const wt_tip tips[] = {pyramid(4, 20, 20e-9, -1.0),
                           pyramid(4, 35, 20e-9, -1.0),
                           pyramid(3, 50, 150e-9, -1.0),
                           pyramid(4, 35, 10e-9, 1e-13),
                           pyramid(0, 17.5, 5e-9, 2e-9),
                           rounded(4, 35, 20e-9),
                           rounded(3, 30, 1e-6),
                           {.shape = WT_TIP_PARABOLOID, .radius = 5e-6},
                           {.shape = WT_TIP_SPHERE, .radius = 5e-6},
                           {.shape = WT_TIP_SPHERE, .radius = 20e-9},
                           {.shape = WT_TIP_PUNCH, .radius = 20e-9},
                           {.shape = WT_TIP_CONE, .half_angle = 20 * degree}};
    for (size_t i = 0; i < sizeof tips / sizeof tips[0]; i++) {
        wt_contact_table *table = table_of(&tips[i], 1e-12, 1e-5);
        double worst = 0.0, worst_slope = 0.0;
        for (double delta = 1e-13; delta < 1e-4; delta *= 1.000713) {
            double g, slope, g2, slope2;
            wt_contact_function(&tips[i], delta, &g, &slope);
            wt_contact_table_eval(table, &delta, 1, &g2, &slope2);
            worst = fmax(worst, fabs(g2 / g - 1.0));
            worst_slope = fmax(worst_slope, fabs(slope2 / slope - 1.0));
        }
        assert_near_abs(worst, 0.0, 1e-12);
        assert_near_abs(worst_slope, 0.0, 1e-11);
        wt_contact_table_free(table);
    }
}

static void impossible_tips_are_refused(void **state)
{
    (void)state;
    const struct {
        wt_tip tip;
        const char *words;
    } cases[] = {
        {pyramid(4, 64.3, 20e-9, -1.0), "concave"}, /* b = R cos(theta): limit 64.20 degrees */
        {pyramid(3, 55.9, 20e-9, -1.0), "concave"}, /* 55.79 */
        {pyramid(6, 72.8, 20e-9, -1.0), "concave"}, /* 72.73 */
        {pyramid(4, 35, 20e-9, 26e-9), "concave"},
        {pyramid(2, 35, 20e-9, -1.0), "2 sides"},
        {pyramid(4, 0, 20e-9, 1e-9), "half-angle"},
        {pyramid(4, 90, 20e-9, 1e-9), "half-angle"},
        {pyramid(4, (double)NAN, 20e-9, 1e-9), "half-angle"},
        {pyramid(4, 35, 0, 1e-9), "radius"},
        {pyramid(4, 35, -1e-9, 1e-9), "radius"},
        {pyramid(4, 35, (double)INFINITY, 1e-9), "radius"},
        {pyramid(4, 35, 20e-9, (double)NAN), "transition"},
        {{.shape = WT_TIP_PARABOLOID, .radius = (double)NAN}, "radius"},
        {{.shape = WT_TIP_CONE, .half_angle = -0.1}, "half-angle"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_error err = WT_ERROR_INIT;
        wt_contact_table *table = NULL;
        assert_int_equal(wt_tip_check(&cases[i].tip, &err), WT_E_RANGE);
        assert_non_null(strstr(err.message, cases[i].words));
        assert_int_equal(wt_contact_table_new(&cases[i].tip, 1e-9, 1e-6, &table, NULL), WT_E_RANGE);
        assert_null(table);
    }
    /* Just inside the limits, and the smooth cap itself. */
    const wt_tip good[] = {pyramid(4, 64.1, 20e-9, -1.0), pyramid(3, 55.7, 20e-9, -1.0),
                           pyramid(6, 72.6, 20e-9, -1.0), rounded(4, 35, 20e-9),
                           rounded(3, 41, 13e-9)};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++)
        assert_int_equal(wt_tip_check(&good[i], NULL), WT_OK);
    wt_contact_table *table = NULL;
    assert_int_equal(wt_contact_table_new(&good[0], 1e-6, 1e-9, &table, NULL), WT_E_RANGE);
    assert_int_equal(wt_contact_table_new(&good[0], 0.0, 1e-9, &table, NULL), WT_E_RANGE);
    wt_contact_table_free(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numeric_cases),
        cmocka_unit_test(shared_reference),
        cmocka_unit_test(sharp_limits),
        cmocka_unit_test(sphere_of_sneddon),
        cmocka_unit_test(thin_sample),
        cmocka_unit_test(flat_punch),
        cmocka_unit_test(sphere_below_the_switch),
        cmocka_unit_test(continuous_at_the_switch),
        cmocka_unit_test(slope_is_the_derivative),
        cmocka_unit_test(no_contact_and_not_a_number),
        cmocka_unit_test(table_agrees_with_function),
        cmocka_unit_test(impossible_tips_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
