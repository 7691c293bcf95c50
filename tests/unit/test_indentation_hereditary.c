/* Viscoelastic contact, approach and retraction: values with 12 digits; omitted terms of a series
 * do not matter.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reference_contact.h"

#include "indentation/law/hereditary.h"

enum { TERMS = 16, STEPS = 20000 };

static size_t list(const char *at, const char *key, double to[TERMS])
{
    size_t n = 0;
    number(&at, key, NULL);
    at += strspn(at, " \n[");
    for (char *end; n < TERMS; at = end + strspn(end, ", \n")) {
        to[n] = strtod(at, &end);
        if (end == at)
            break;
        n++;
    }
    return n;
}

/* Line segments between the times of a motion, or a squared sine. */
static double depth_at(const char *at, const char *end, double t)
{
    double times[TERMS], depths[TERMS];
    const double most = number_in(at, "delta_max_m", end);
    if (!isnan(most)) {
        const double s = sin(M_PI * t / (2 * number_in(at, "t_max_s", end)));
        return most * s * s;
    }
    list(at, "t_s", times);
    list(at, "delta_m", depths);
    const size_t i = t > times[1];
    return depths[i] + (depths[i + 1] - depths[i]) * (t - times[i]) / (times[i + 1] - times[i]);
}

/* Steps that grow from the contact, where the curvature of the force is largest; a linear
 * retraction in one step. */
static double force_at(const wt_tip *tip, const wt_prony *series, const char *motion,
                       const char *end, double top, double t, int steps)
{
    static double time[2 * STEPS + 1], depth[2 * STEPS + 1], force[2 * STEPS + 1];
    const double in = fmin(t, top);
    hereditary law = {0};
    wt_contact_table *table = NULL;
    const int steps_out = isnan(number_in(motion, "delta_max_m", end)) ? 1 : steps;
    size_t n = (size_t)steps + 1;
    for (int i = 0; i <= steps; i++)
        time[i] = in * (double)i / steps * (double)i / steps;
    for (int i = 1; t > top && i <= steps_out; i++)
        time[n++] = top + (t - top) * (double)i / steps_out;
    for (size_t i = 0; i < n; i++)
        depth[i] = depth_at(motion, end, time[i]);
    hereditary_reserve(&law, series->n);
    hereditary_begin(&law, series, 1, t / steps / steps, t);
    assert_int_equal(law.n, series->n);
    assert_int_equal(wt_contact_table_new(tip, 1e-11, 1e-4, &table, NULL), WT_OK);
    assert_int_equal(hereditary_loop(&law, table, 0, time, depth, n, force, NULL), WT_OK);
    wt_contact_table_free(table);
    hereditary_clear(&law);
    return force[n - 1];
}

static int check_case(const char *at, const char *next)
{
    double modulus[TERMS], time[TERMS], times[TERMS];
    const wt_tip tip = read_tip(at, strstr(at, "\"prony\""));
    const double nu = number_in(at, "nu", next);
    wt_prony series = {.equilibrium_modulus = number_in(at, "Einf_Pa", next),
                       .modulus = modulus,
                       .relaxation_time = time};
    const char *motion = strstr(at, "\"motion\""), *p = strstr(at, "\"points\"");
    double top = number_in(motion, "t_max_s", p);
    int n = 0;
    series.n = list(at, "E_Pa", modulus);
    list(at, "tau_s", time);
    if (isnan(top)) {
        list(motion, "t_s", times);
        top = times[1];
    }
    for (double t; !isnan(t = number(&p, "t_s", next)); n++) {
        const double expected = number_in(p, "F_N", next);
        const double coarse = force_at(&tip, &series, motion, p, top, t, STEPS / 2),
                     fine = force_at(&tip, &series, motion, p, top, t, STEPS);
        /* the error is proportional to the square of the step */
        assert_near((4 * fine - coarse) / 3 / (1 - nu * nu), expected, 1e-10);
    }
    return n;
}

static void reference_cases(void **state)
{
    (void)state;
    assert_int_equal(
        check_reference(WT_SHARED_DIR "/reference/indentation/viscoelastic.json", check_case), 24);
}

/* Terms far outside the range of the motion become a spring and a dashpot, with little effect on
 * the force. */
static void spring_and_dashpot(void **state)
{
    (void)state;
    double modulus[] = {1e9, 3e6, 2e6, 4e5}, time[] = {1e-9, 1e-2, 1, 1e7}, force[2];
    const wt_prony series = {
        .equilibrium_modulus = 1e6, .n = 4, .modulus = modulus, .relaxation_time = time};
    for (int all = 0; all < 2; all++) {
        hereditary law = {0};
        double f = 0;
        hereditary_reserve(&law, 4);
        hereditary_begin(&law, &series, 1, all ? 1e-12 : 1e-3, all ? 1e9 : 1);
        assert_int_equal(law.n, all ? 4 : 2);
        for (int i = 1; i <= 1000; i++) {
            const double next = 1e-6 * i * i;
            hereditary_set_step(&law, 1e-3);
            force[all] = hereditary_force(&law, hereditary_decay(&law, law.memory[0]), f, next);
            hereditary_add_change(&law, law.memory[0], next - f);
            f = next;
        }
        hereditary_clear(&law);
    }
    assert_near(force[0], force[1], 1e-6);
    assert_near(hereditary_modulus(&series, 1), hypot(1.4e6 + 1e6 + 3e2, 1e6 + 3e4), 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_cases),
        cmocka_unit_test(spring_and_dashpot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
