/* Accuracy of the contact force and of the contact fit.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/bench.h"
#include "bench/precision.h"

#include <float.h>
#include <math.h>

static const char tip_words[] = "pyramid:half-angle=20deg,radius=20nm";

/* ---- force of a blunted pyramid -------------------------------------------------------------- */

enum { DEPTHS = 1000 }; /* of the problem */

typedef struct force_problem {
    wt_tip tip;
    wt_contact_table *table;
    double depth[DEPTHS], truth[DEPTHS], force[DEPTHS];
    double stated; /* as stated in the header */
} force_problem;

static long double cot_facets(const wt_tip *tip)
{
    const long double n = tip->sides, pi = acosl(-1);
    const long double m = tip->sides == 0 ? 1 : n / pi * sinl(pi / n);
    return m / tanl((long double)tip->half_angle);
}

/* Contact depth as published (Rico 2005). With int_0^a delta da in closed form, G = 2 (a delta -
 * integral). */
static long double contact_depth(const wt_tip *tip, long double a)
{
    const long double b = (long double)tip->transition_radius, r = (long double)tip->radius;
    return a <= b ? a * a / r
                  : a * (a - sqrtl(a * a - b * b)) / r + cot_facets(tip) * a * acosl(b / a);
}

static long double force_at_radius(const wt_tip *tip, long double a)
{
    const long double b = (long double)tip->transition_radius, r = (long double)tip->radius;
    if (a <= b)
        return 4 * a * a * a / (3 * r);
    const long double s = sqrtl(a * a - b * b);
    return 2 * (a * contact_depth(tip, a) - (a * a * a - s * s * s) / (3 * r) -
                cot_facets(tip) * (a * a * acosl(b / a) - b * s) / 2);
}

typedef struct depth_search {
    const wt_tip *tip;
    long double depth;
} depth_search;

static bool is_shallower(const void *user, long double a)
{
    const depth_search *s = user;
    return contact_depth(s->tip, a) < s->depth;
}

static long double bisect_radius(const wt_tip *tip, double depth, int steps)
{
    const depth_search s = {tip, (long double)depth};
    long double high = 1e-9L;
    while (is_shallower(&s, high))
        high *= 2;
    return precision_bisect(is_shallower, &s, 0, high, steps);
}

static wt_status begin_force(void *problem, double *reference_error, wt_error *err)
{
    enum { STEPS = 80 }; /* to the last bit of a long double */
    force_problem *p = problem;
    wt_status status = wt_tip_parse(tip_words, &p->tip, err);
    if (status == WT_OK)
        status = wt_contact_table_new(&p->tip, 1e-10, 1e-6, &p->table, err);
    *reference_error = 0;
    for (int i = 0; i < DEPTHS && status == WT_OK; i++) {
        p->depth[i] = 1e-10 * pow(1e4, i / (DEPTHS - 1.0));
        const long double a = bisect_radius(&p->tip, p->depth[i], STEPS);
        const long double g = force_at_radius(&p->tip, a);
        p->truth[i] = (double)g;
        /* dG = 2 a ddelta: errors of the root and of the cancelling terms */
        const long double left =
            fabsl(2 * a * (contact_depth(&p->tip, a) - (long double)p->depth[i])) +
            LDBL_EPSILON * 4 * a * (long double)p->depth[i];
        *reference_error = fmax(*reference_error, (double)(left / g));
    }
    return status;
}

static void finish_force(void *problem)
{
    force_problem *p = problem;
    wt_contact_table_free(p->table);
}

static wt_status solve_table(void *problem, double value, wt_error *err)
{
    force_problem *p = problem;
    (void)value;
    (void)err;
    wt_contact_table_eval(p->table, p->depth, DEPTHS, p->force, NULL);
    p->stated = 1e-11;
    return WT_OK;
}

static wt_status solve_formula(void *problem, double value, wt_error *err)
{
    force_problem *p = problem;
    double slope;
    (void)value;
    (void)err;
    for (int i = 0; i < DEPTHS; i++)
        wt_contact_function(&p->tip, p->depth[i], &p->force[i], &slope);
    p->stated = 1e-12;
    return WT_OK;
}

static wt_status solve_force_bisection(void *problem, double value, wt_error *err)
{
    force_problem *p = problem;
    (void)err;
    for (int i = 0; i < DEPTHS; i++)
        p->force[i] =
            (double)force_at_radius(&p->tip, bisect_radius(&p->tip, p->depth[i], (int)value));
    p->stated = (double)NAN;
    return WT_OK;
}

static precision_errors force_errors(const void *problem)
{
    const force_problem *p = problem;
    precision_errors e = {0, p->stated};
    for (int i = 0; i < DEPTHS; i++)
        e.true_error = fmax(e.true_error, precision_relative(p->force[i], p->truth[i]));
    return e;
}

/* ---- fit of a curve -------------------------------------------------------------------------- */

enum { CURVES = 4, MOST_SAMPLES = 4000 }; /* of the problem */

/* Quantities of the problem [Pa, m, N/m]. */
#define MODULUS 4e6
#define CONTACT_POSITION 1.2e-6
#define SPRING_CONSTANT 0.5
#define RESIDUAL 3e-11 /* noise of the force [N] */

typedef struct fit_problem {
    wt_tip tip;
    wt_contact_table *table;
    wt_indent_workspace *workspace;
    double position[MOST_SAMPLES], height[MOST_SAMPLES], force[MOST_SAMPLES], g[MOST_SAMPLES];
    double modulus[CURVES], stated;
} fit_problem;

static wt_status begin_fit(void *problem, double *reference_error, wt_error *err)
{
    fit_problem *p = problem;
    *reference_error = 0;
    wt_status status = wt_tip_parse(tip_words, &p->tip, err);
    if (status == WT_OK)
        status = wt_contact_table_new(&p->tip, 1e-12, 1e-5, &p->table, err);
    p->workspace = wt_indent_workspace_new();
    return status == WT_OK && p->workspace == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory")
                                                   : status;
}

static void finish_fit(void *problem)
{
    fit_problem *p = problem;
    wt_indent_workspace_free(p->workspace);
    wt_contact_table_free(p->table);
}

static void simulate_curve(fit_problem *p, int n, int curve)
{
    bench_random random = {(uint64_t)curve};
    double slope;
    for (int i = 0; i < n; i++) {
        p->position[i] = 1.5e-6 * i / (n - 1);
        wt_contact_function(&p->tip, p->position[i] - CONTACT_POSITION, &p->g[i], &slope);
        p->force[i] = MODULUS / 0.75 * p->g[i] + RESIDUAL * bench_normal(&random);
        p->height[i] = p->position[i] + p->force[i] / SPRING_CONSTANT;
    }
}

static wt_status solve_fit(void *problem, double value, wt_error *err)
{
    fit_problem *p = problem;
    wt_status status = WT_OK;
    double sum = 0;
    for (int c = 0; c < CURVES && status == WT_OK; c++) {
        wt_indent_fit fit;
        simulate_curve(p, (int)value, c);
        status = wt_indent_fit_curve(p->table, NULL, p->height, p->force, NULL, (size_t)value,
                                     SPRING_CONSTANT, p->workspace, &fit, err);
        p->modulus[c] = fit.modulus.value;
        sum += pow(fit.modulus.standard_error, 2);
    }
    p->stated = sqrt(sum / CURVES) / MODULUS;
    return status;
}

/* Tries every sample as contact point and finds the modulus by least squares after it. */
static wt_status solve_scan(void *problem, double value, wt_error *err)
{
    fit_problem *p = problem;
    const int n = (int)value;
    (void)err;
    for (int c = 0; c < CURVES; c++) {
        double best = (double)INFINITY;
        simulate_curve(p, n, c);
        for (int k = n / 2; k < n - 4; k++) {
            const double contact = p->height[k] - p->force[k] / SPRING_CONSTANT;
            double gg = 0, gf = 0, ff = 0;
            for (int i = 0; i < n; i++) {
                double g = 0, slope = 0;
                if (i > k)
                    wt_contact_function(&p->tip,
                                        p->height[i] - p->force[i] / SPRING_CONSTANT - contact, &g,
                                        &slope);
                gg += g * g;
                gf += g * p->force[i];
                ff += p->force[i] * p->force[i];
            }
            if (ff - gf * gf / gg < best) {
                best = ff - gf * gf / gg;
                p->modulus[c] = 0.75 * gf / gg;
            }
        }
    }
    p->stated = (double)NAN;
    return WT_OK;
}

static precision_errors fit_errors(const void *problem)
{
    const fit_problem *p = problem;
    double sum = 0;
    for (int c = 0; c < CURVES; c++)
        sum += pow(p->modulus[c] / MODULUS - 1, 2);
    return (precision_errors){sqrt(sum / CURVES), p->stated};
}

const precision_part precision_contact[] = {
    {.name = "contact-force",
     "Force of a blunted pyramid at 1000 depths from 0.1 nm to 1 um; reference: the published pair "
     "depth and force against contact radius, solved in long double",
     sizeof(force_problem),
     begin_force,
     force_errors,
     finish_force,
     {{"weartrack", "table of quintics", {1}, solve_table},
      {"formula", "Newton's method", {1}, solve_formula},
      {"textbook",
       "bisections of the contact radius",
       {5, 10, 20, 30, 40, 50},
       solve_force_bisection}},
     .is_bound = true},
    {.name = "contact-fit",
     "Modulus of four simulated curves with noise, against the one they were made with; the true "
     "error is that of these four, its floor the noise",
     sizeof(fit_problem),
     begin_fit,
     fit_errors,
     finish_fit,
     {{"weartrack", "samples of a curve", {250, 500, 1000, 2000, 4000}, solve_fit},
      {"textbook",
       "samples of a curve, each tried as contact",
       {125, 250, 500, 1000},
       solve_scan}}},
    {.name = NULL},
};
