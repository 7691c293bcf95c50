/* Accuracy of the angular integrals of a material without a closed form.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/precision.h"
#include "bench/reference_values.h"
#include "friction/numerics/angular.h"
#include "study/textbook_methods.h"

#include <math.h>

enum { FREQUENCIES = 32, MOST_ANGLES = 3000 }; /* of the problem */

typedef struct angular_problem {
    wt_material *material;
    double w[FREQUENCIES], truth[2][FREQUENCIES], found[2][FREQUENCIES], stated;
    double scratch[3 * (MOST_ANGLES + 1)];
} angular_problem;

static wt_status begin_angular_problem(void *problem, double *reference_error, wt_error *err)
{
    const double e0 = 5e6, glass = 1e9, tau = 1e-7, alpha = 0.5;
    const reference_material law = {
        .e0 = e0, .alpha = alpha, .n = 1, .e = {glass - e0}, .tau = {tau}};
    angular_problem *p = problem;
    for (int i = 0; i < FREQUENCIES; i++) {
        p->w[i] = 1e2 * pow(1e9, i / (FREQUENCIES - 1.0));
        reference_angle(&law, p->w[i], &p->truth[0][i], &p->truth[1][i]);
    }
    *reference_error = 1e-15; /* computed in long double, split where the integrand bends */
    return wt_material_fractional_zener(e0, glass, tau, alpha, 0.5, &p->material, err);
}

static void finish_angular(void *problem)
{
    angular_problem *p = problem;
    wt_material_free(p->material);
}

static wt_status solve_series(void *problem, double value, wt_error *err)
{
    angular_problem *p = problem;
    arena memory = {0};
    angular_law *law = angular_new(p->material, 1 / value, &memory);
    double x[FREQUENCIES];
    (void)err;
    angular_extend(law, p->w[0], p->w[FREQUENCIES - 1]);
    for (int i = 0; i < FREQUENCIES; i++)
        x[i] = log(p->w[i]);
    angular_eval(law, p->w, x, FREQUENCIES, p->found[0], p->found[1]);
    p->stated = angular_error(law, x[0], x[FREQUENCIES - 1], &(size_t){0});
    angular_clear(law);
    arena_free(&memory);
    return WT_OK;
}

static wt_status solve_simpson(void *problem, double value, wt_error *err)
{
    angular_problem *p = problem;
    (void)err;
    for (int i = 0; i < FREQUENCIES; i++)
        textbook_angular_integrals(p->material, p->w[i], (size_t)value, p->scratch, &p->found[0][i],
                                   &p->found[1][i]);
    p->stated = (double)NAN;
    return WT_OK;
}

static precision_errors angular_errors(const void *problem)
{
    const angular_problem *p = problem;
    precision_errors e = {0, p->stated};
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < FREQUENCIES; i++)
            e.true_error = fmax(e.true_error, precision_relative(p->found[k][i], p->truth[k][i]));
    return e;
}

const precision_part precision_angular[] = {
    {.name = "angular-integrals",
     "Both angular integrals of a fractional Zener law at 32 places over 9 decades, with set-up; "
     "reference: tanh-sinh rules in long double",
     sizeof(angular_problem),
     begin_angular_problem,
     angular_errors,
     finish_angular,
     {{"weartrack", "1 / tolerance", {1e2, 1e4, 1e6, 1e8, 1e10, 1e12}, solve_series},
      {"textbook", "intervals of the angle", {10, 30, 100, 300, 1000, 3000}, solve_simpson}},
     .is_bound = true,
     /* the exact integrals by adaptive quadrature with 20 digits, in Python with mpmath */
     .known = {{10, 0.030060886826}, {30, 0.0091835510741}, {100, 0.0023417165064}}},
    {.name = NULL},
};
