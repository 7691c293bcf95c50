/* Angular integrals by Gauss-Legendre panels between the knots of the law: in phi where cos(phi) is
 * above 1/2, in s = -ln cos(phi) below, down to where the rest of the integral is rounding.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/angular_integral.h"

#include <float.h>
#include <math.h>

enum { SHORT_NODES = 10, LONG_NODES = 20 };
static const double short_width = 0.3; /* of a panel for the short rule */
/* The Maxwell pole is pi/2 away from the real axis; the deeper, the less a panel counts. */
static double panel_width(double s)
{
    return 1.5 + 0.15 * s;
}
static const double s_limit = 700; /* exp(-s) is 1e-304 */

typedef struct panel_sum {
    const angular_quadrature *quadrature;
    double w;
    unsigned refine;
    double j1, j2;           /* so far */
    double last_j1, last_j2; /* of the last panel */
} panel_sum;

/* One panel in phi (over_phi) or in s. */
static void add_panel(panel_sum *sum, double from, double to, bool over_phi)
{
    double omega[LONG_NODES], storage[LONG_NODES], loss[LONG_NODES], cosine[LONG_NODES],
        jacobian[LONG_NODES];
    const angular_quadrature *a = sum->quadrature;
    sum->last_j1 = 0;
    sum->last_j2 = 0;
    const unsigned parts = sum->refine;
    const double half = (to - from) / (2 * parts);
    const gauss_rule *rule = to - from < short_width ? a->short_rule : a->long_rule;
    for (unsigned p = 0; p < parts; p++) {
        const double middle = from + (2 * p + 1) * half;
        for (size_t i = 0; i < rule->n; i++) {
            const double x = middle + half * rule->node[i];
            cosine[i] = over_phi ? cos(x) : exp(-x);
            jacobian[i] = over_phi ? 1 : 1 / sqrt(expm1(2 * x));
            omega[i] = fmax(sum->w * cosine[i], DBL_MIN);
        }
        a->material->law->modulus(a->material, omega, rule->n, storage, loss);
        for (size_t i = 0; i < rule->n; i++) {
            const double weight = 4 * half * rule->weight[i] * jacobian[i];
            sum->last_j1 += weight * cosine[i] * loss[i];
            sum->last_j2 += weight * (storage[i] * storage[i] + loss[i] * loss[i]);
        }
    }
    sum->j1 += sum->last_j1;
    sum->j2 += sum->last_j2;
}

static void add_wide(panel_sum *sum, double from, double to, bool over_phi)
{
    double low = from;
    while (low < to) {
        const double pieces = 1 + floor((to - low) / panel_width(over_phi ? 0 : low));
        const double high = pieces > 1 ? low + (to - low) / pieces : to;
        add_panel(sum, low, high, over_phi);
        low = high;
    }
}

/* acos(c) for c = omega / w in (0, 1], accurate near 1. */
static double angle_of(double omega, double w)
{
    return 2 * asin(sqrt(fmax(0, (w - omega) / (2 * w))));
}

void angular_integrate(const angular_quadrature *quadrature, double w, double cosine_limit,
                       unsigned refine, double *j1, double *j2)
{
    panel_sum sum = {.quadrature = quadrature, .w = w, .refine = refine};
    size_t k = quadrature->n_breaks;
    while (k > 0 && quadrature->breaks[k - 1] >= w * cosine_limit)
        k--; /* breaks[k - 1] is the highest knot that is reached */

    const double corner = acos(0.5);
    if (cosine_limit > 0.5) {
        double from = angle_of(w * cosine_limit, w);
        for (; k > 0 && quadrature->breaks[k - 1] > 0.5 * w; k--) {
            const double to = fmin(angle_of(quadrature->breaks[k - 1], w), corner);
            add_wide(&sum, from, to, true);
            from = fmax(from, to);
        }
        add_wide(&sum, from, corner, true);
    }
    double from = -log(fmin(cosine_limit, 0.5));
    for (; k > 0; k--) {
        const double to = log(w / quadrature->breaks[k - 1]);
        add_wide(&sum, from, to, false);
        from = fmax(from, to);
    }
    do {
        const double to = from + panel_width(from);
        add_panel(&sum, from, to, false);
        from = to;
    } while (from < s_limit &&
             (sum.last_j1 > DBL_EPSILON / 64 * sum.j1 || sum.last_j2 > DBL_EPSILON / 64 * sum.j2));
    *j1 = sum.j1;
    *j2 = sum.j2;
}

wt_status angular_quadrature_init(const wt_material *material, pool *memory,
                                  angular_quadrature *quadrature, wt_error *err)
{
    *quadrature = (angular_quadrature){.material = material};
    if (material->law->breaks != NULL)
        quadrature->breaks = material->law->breaks(material, &quadrature->n_breaks);
    const wt_status status = rule_new(SHORT_NODES, memory, &quadrature->short_rule, err);
    return status == WT_OK ? rule_new(LONG_NODES, memory, &quadrature->long_rule, err) : status;
}
