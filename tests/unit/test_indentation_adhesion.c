/* Adhesive contact: values with 12 digits, limits, derivatives.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reference_contact.h"

#include "indentation/law/adhesion.h"

static wt_contact_table *table_of(const wt_tip *tip)
{
    wt_contact_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    if (wt_contact_table_new(tip, 1e-11, 1e-4, &table, &err) != WT_OK)
        fail_msg("%s", err.message);
    return table;
}

static double work_of(const wt_tip *tip, double reduced, double k, double pull_off)
{
    wt_contact_table *table = table_of(tip);
    const double work = adhesion_work(table, reduced, k, pull_off);
    wt_contact_table_free(table);
    return work;
}

static adhesive_contact balance(const adhesion *law, double k, double position)
{
    double bare;
    adhesion_balance(law, k, adhesion_release(law, k), &position, 1, &bare);
    return adhesion_contact_value(law, bare);
}

static void check_release(const adhesion *law, double k, const char *at, const char *end)
{
    if (at == NULL || (end != NULL && at > end))
        return;
    const adhesive_contact c = adhesion_contact_value(law, adhesion_release(law, k));
    assert_near(c.force, number_in(at, "F_N", end), 1e-10);
    if (isinf(k) || k == 0.0)
        return;
    assert_near(adhesion_work(law->table, law->reduced, k, -c.force), law->work, 1e-9);
}

static int check_case(const char *at, const char *next)
{
    const wt_tip tip = read_tip(at, strstr(at, "Estar_Pa"));
    wt_contact_table *table = table_of(&tip);
    const adhesion law = {table, number_in(at, "Estar_Pa", next),
                          number_in(at, "w_J_per_m2", next)};
    const double k = number_in(at, "lever_N_per_m", next);
    if (law.work > 0) {
        check_release(&law, 0.0, strstr(at, "\"pull_off_load_control\""), next);
        check_release(&law, (double)INFINITY, strstr(at, "\"pull_off_fixed_grip\""), next);
        check_release(&law, k, strstr(at, "\"pull_off_lever\""), next);
        const char *jump = strstr(at, "\"jump_in_lever_base_at_zero\"");
        assert_near(balance(&law, k, 0.0).radius, number_in(jump, "a_m", next), 1e-10);
    }
    const char *p = strstr(at, "\"points\"");
    for (double depth; !isnan(depth = number(&p, "delta_m", next));) {
        const adhesive_contact c = balance(&law, (double)INFINITY, depth);
        assert_near(c.radius, number_in(p, "a_m", next), 1e-10);
        assert_near(c.force, number_in(p, "F_N", next), 1e-10);
        assert_near(c.stiffness, number_in(p, "dF_ddelta_N_per_m", next), 1e-9);
    }
    wt_contact_table_free(table);
    return 1;
}

static void reference_cases(void **state)
{
    (void)state;
    assert_int_equal(check_reference(WT_SHARED_DIR "/reference/indentation/jkr.json", check_case),
                     6);
}

static double force_at(adhesion law, double depth)
{
    return balance(&law, (double)INFINITY, depth).force;
}

static void derivatives(void **state)
{
    (void)state;
    const wt_tip tip = {.sides = 4, .half_angle = 0.6, .radius = 20e-9, .transition_radius = 16e-9};
    wt_contact_table *table = table_of(&tip);
    const adhesion law = {table, 6e6, 0.02};
    for (double bare = 8e-9; bare < 200e-9; bare *= 1.3) {
        const adhesive_contact c = adhesion_contact_value(&law, bare);
        const double e = 1e-4;
        adhesion more = law, less = law;
        more.reduced *= 1 + e;
        less.reduced *= 1 - e;
        assert_near(c.by_modulus,
                    (force_at(more, c.depth) - force_at(less, c.depth)) / (2 * e * law.reduced),
                    1e-5);
        more = less = law;
        more.work *= 1 + e;
        less.work *= 1 - e;
        assert_near(c.by_work,
                    (force_at(more, c.depth) - force_at(less, c.depth)) / (2 * e * law.work), 1e-5);
    }
    wt_contact_table_free(table);
}

/* A soft cantilever and a sphere: 3/2 pi w R of the textbook for any modulus; Tabor's number. */
static void textbook(void **state)
{
    (void)state;
    const wt_tip tip = {.shape = WT_TIP_PARABOLOID, .radius = 20e-9};
    wt_contact_table *table = table_of(&tip);
    const adhesion law = {table, 20e6 / 0.75, 0.05};
    assert_near(adhesion_work(table, 1e7, 0.0, 1.5 * M_PI * 0.01 * 20e-9), 0.01, 1e-9);
    assert_near(adhesion_tabor(&law),
                cbrt(20e-9 * 0.05 * 0.05 / (law.reduced * law.reduced * 2.7e-29)), 1e-12);
    const wt_tip cone = {.shape = WT_TIP_CONE, .half_angle = 0.4};
    wt_contact_table *of_cone = table_of(&cone);
    const adhesion sharp = {of_cone, 1e7, 0.01};
    assert_true(isnan(adhesion_tabor(&sharp)));
    const double c = 1 / tan(0.4);
    assert_near(-adhesion_contact_value(&sharp, adhesion_release(&sharp, 0.0)).force,
                54 * 0.01 * 0.01 / (M_PI * 1e7 * c * c * c), 1e-9);
    wt_contact_table_free(of_cone);
    wt_contact_table_free(table);
}

/* At a small depth a sphere is its paraboloid. At a large one depth, force and their derivative
 * follow from the law without adhesion, and the pull-off is the minimum of the branch. */
static void sphere(void **state)
{
    (void)state;
    const wt_tip round = {.shape = WT_TIP_SPHERE, .radius = 5e-6};
    const wt_tip hertz = {.shape = WT_TIP_PARABOLOID, .radius = 5e-6};
    wt_contact_table *table = table_of(&round), *of_hertz = table_of(&hertz);
    const adhesion weak = {table, 1e7, 1e-6}, same = {of_hertz, 1e7, 1e-6};
    assert_near(adhesion_contact_value(&weak, adhesion_release(&weak, 0.1)).force,
                adhesion_contact_value(&same, adhesion_release(&same, 0.1)).force, 1e-4);
    const adhesion law = {table, 1e4, 0.005};
    for (double bare = 2e-7; bare < 1e-5; bare *= 1.1) {
        const adhesive_contact c = adhesion_contact_value(&law, bare);
        const double a = c.radius;
        double g, slope;
        wt_contact_function(&round, c.depth + sqrt(2 * M_PI * law.work * a / law.reduced), &g,
                            &slope);
        assert_near(slope, 2 * a, 1e-11);
        assert_near(c.force, law.reduced * g - sqrt(8 * M_PI * law.reduced * law.work * a * a * a),
                    1e-11);
        const adhesive_contact more = adhesion_contact_value(&law, bare * (1 + 1e-5));
        const adhesive_contact less = adhesion_contact_value(&law, bare * (1 - 1e-5));
        assert_near(c.stiffness, (more.force - less.force) / (more.depth - less.depth), 1e-6);
    }
    const adhesive_contact end = adhesion_contact_value(&law, adhesion_release(&law, 0.0));
    assert_true(end.radius > 2.5e-6 && end.radius < 5e-6);
    for (double other = 2e-7; other < 1e-5; other *= 1.01)
        assert_true(adhesion_contact_value(&law, other).force >= end.force);
    assert_near(adhesion_work(table, law.reduced, 0.0, -end.force), law.work, 1e-9);
    assert_near(balance(&law, (double)INFINITY, 4e-6).depth, 4e-6, 1e-12);
    wt_contact_table_free(of_hertz);
    wt_contact_table_free(table);
}

/* Positions of a whole curve with noise are in equilibrium to rounding, also beyond the end of the
 * branch and the edge of the tip. Each equals its single computation. */
static void curve_in_balance(void **state)
{
    (void)state;
    enum { N = 500 };
    const wt_tip tips[] = {
        {.sides = 4, .half_angle = 0.6, .radius = 20e-9, .transition_radius = 16e-9},
        {.sides = 4, .half_angle = 0.35, .radius = 20e-9, .transition_radius = 8e-9},
        {.shape = WT_TIP_PARABOLOID, .radius = 1e-6},
        {.shape = WT_TIP_SPHERE, .radius = 5e-6},
        {.shape = WT_TIP_CONE, .half_angle = 0.5}};
    const double work[] = {0.0, 1e-5, 1e-3, 0.05, 0.5}, cantilever[] = {0.05, 1.0, 40.0};
    static double position[N], bare[N];
    for (size_t t = 0; t < sizeof tips / sizeof tips[0]; t++) {
        wt_contact_table *table = table_of(&tips[t]);
        for (size_t c = 0; c < 15; c++) {
            const double k = cantilever[c % 3];
            const adhesion law = {table, 5e6, work[c / 3]};
            const double release = adhesion_release(&law, k);
            const adhesive_contact end = adhesion_contact_value(&law, release);
            const double held = release > 0 ? end.depth + end.force / k : 0.0;
            const double reach = 1e-6 + fabs(held);
            for (size_t i = 0; i < N; i++)
                position[i] =
                    held - 0.1 * reach + 1.2 * reach * ((double)i + 3.0 * sin(7.0 * (double)i)) / N;
            adhesion_balance(&law, k, release, position, N, bare);
            for (size_t i = 0; i < N; i++) {
                const adhesive_contact at = adhesion_contact_value(&law, bare[i]);
                if (position[i] <= held)
                    assert_true(!(bare[i] > release) && !(bare[i] < release));
                else
                    assert_near_abs(at.depth + at.force / k, position[i], 1e-12 * reach);
                double alone;
                adhesion_balance(&law, k, release, &position[i], 1, &alone);
                /* at pull-off the base position hardly determines the contact radius */
                if (bare[i] > 1.001 * release)
                    assert_near(alone, bare[i], 1e-9);
            }
        }
        wt_contact_table_free(table);
    }
}

/* The edge of a punch detaches at once: Kendall. */
static void punch(void **state)
{
    (void)state;
    const wt_tip tip = {.shape = WT_TIP_PUNCH, .radius = 2e-6};
    assert_false(adhesion_applies(&tip));
    assert_near(work_of(&tip, 1e7, 0.5, sqrt(8 * M_PI * 1e7 * 0.02 * 8e-18)), 0.02, 1e-12);
    wt_contact_table *table = table_of(&tip);
    assert_true(isnan(adhesion_tabor(&(adhesion){table, 1e7, 0.02})));
    wt_contact_table_free(table);
    /* beyond the plausible range the result is not a number, rather than the limit */
    const wt_tip round = {.shape = WT_TIP_PARABOLOID, .radius = 2e-6};
    assert_near(work_of(&round, 1e7, 0.0, 1.5 * M_PI * 900 * 2e-6), 900, 1e-9);
    assert_true(isnan(work_of(&round, 1e7, 0.0, 1.5 * M_PI * 1100 * 2e-6)));
    assert_near(work_of(&round, 1e7, 0.0, 1.5 * M_PI * 1.1e-9 * 2e-6), 1.1e-9, 1e-9);
    assert_true(isnan(work_of(&round, 1e7, 0.0, 1.5 * M_PI * 0.9e-9 * 2e-6)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_cases),  cmocka_unit_test(derivatives),
        cmocka_unit_test(textbook),         cmocka_unit_test(sphere),
        cmocka_unit_test(curve_in_balance), cmocka_unit_test(punch)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
