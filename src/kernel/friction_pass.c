/* One pass of the friction integral: from the angular integrals at the nodes to G, P and mu.
 *
 *   G(q)  = 1/(8 sigma0^2) int k^3 C J2(k v) dk          P = erf(1 / (2 sqrt G))
 *   mu    = 1/(2 sigma0) int k^3 C S P J1(k v) dk        S = gamma + (1 - gamma) P^2
 *
 * Persson, J. Chem. Phys. 115 (2001) 3840; S: Scaraggi and Persson, J. Phys.: Condens. Matter 27
 * (2015) 105102.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/friction.h"

#include "kernel/contact.h"

#include <math.h>

double friction_area_error(double variance, double variance_error)
{
    const double area = contact_area(variance);
    const double above = area - contact_area(variance + variance_error);
    const double below = contact_area(fmax(0, variance - variance_error)) - area;
    return fmax(fabs(above), fabs(below)) + 4 * DBL_EPSILON * area;
}

double friction_gap_error(double variance, double variance_error)
{
    const double gap = contact_gap(variance);
    const double above = contact_gap(variance + variance_error) - gap;
    const double below = gap - contact_gap(fmax(0, variance - variance_error));
    /* where erfc underflows the true value is still below the smallest normal number */
    return fmax(fmax(above, below) + 4 * DBL_EPSILON * gap, variance > 0 ? DBL_MIN : 0);
}

friction_relative friction_relative_error(const wt_friction_workspace *ws,
                                          const friction_pass *pass)
{
    friction_relative e = {ws->rounding, ws->rounding};
    if (pass->variance > 0)
        e.variance += pass->variance_moved / pass->variance;
    if (pass->hysteresis > 0)
        e.hysteresis += pass->hysteresis_moved / pass->hysteresis;
    return e;
}

/* |d ln J| over n nodes. */
static double steepness(const double *j, size_t n)
{
    return j[0] > 0 && j[n - 1] > 0 ? fabs(log(j[n - 1] / j[0])) : 0;
}

/* S P falls no faster than G to the power of minus this. */
static const double area_power = 1.5;

/* What the errors of J1 and J2 make of the part of a pass whose n nodes are at `omega`; G so far
 * contains it. Errors of the series; and ln omega and the logarithms of the knots are rounded, so
 * what is steep there moves. */
static void add_moved(const wt_friction_workspace *ws, const double *omega, const double *j1,
                      const double *j2, size_t n, double variance, double hysteresis,
                      double variance_so_far, friction_pass *pass)
{
    if (ws->material->law->angular)
        return;
    const double far = fmax(fabs(log(omega[0])), fabs(log(omega[n - 1])));
    const double moved = 4 * DBL_EPSILON * (1 + far);
    const double series = angular_error(ws->angular, omega[0], omega[n - 1]);
    pass->variance_moved += variance * (series + moved * steepness(j2, n));
    pass->hysteresis_moved += hysteresis * (series + moved * steepness(j1, n));
    if (variance_so_far > 0)
        pass->hysteresis_moved +=
            hysteresis * area_power * (pass->variance_moved / variance_so_far);
}

static void angular_at(const wt_friction_workspace *ws, friction_scratch *scratch, const double *q,
                       size_t n, double speed)
{
    for (size_t i = 0; i < n; i++)
        scratch->omega[i] = q[i] * speed;
    scratch->nodes += n;
    angular_eval(ws->angular, scratch->omega, n, scratch->j1, scratch->j2);
}

double friction_core_variance(const wt_friction_workspace *ws, friction_scratch *scratch,
                              const scale_grid *grid, size_t level, friction_load at)
{
    const size_t n = grid->rule->n;
    const double ratio = ws->stiffness / at.pressure;
    const double *factor2 = grid->core_factor2 + level * n;
    angular_at(ws, scratch, grid->core_q + level * n, n, at.speed);
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += grid->rule->weight[i] * factor2[i] * scratch->j2[i];
    return sum * grid->core_half_width[level] * (ratio * ratio / 8);
}

/* P is 1 in the core, or the core is so short that dmu/dG hardly changes in it:
 * mu = (dmu/dG) int S P dG in closed form. */
static double core_pass(const wt_friction_workspace *ws, friction_scratch *scratch,
                        const scale_grid *grid, size_t level, friction_load at, double mu_scale,
                        friction_record *record, friction_pass *pass)
{
    const size_t n = grid->rule->n;
    const double ratio = ws->stiffness / at.pressure;
    const double g_scale = ratio * ratio / 8;
    const double *factor1 = grid->core_factor1 + level * n;
    const double *factor2 = grid->core_factor2 + level * n;
    const double half = grid->core_half_width[level];
    double f1[FRICTION_MAX_NODES], f2[FRICTION_MAX_NODES];
    pass->variance = friction_core_variance(ws, scratch, grid, level, at);
    double full = 0, least = (double)INFINITY, most = 0;
    for (size_t i = 0; i < n; i++) {
        f1[i] = half * mu_scale * factor1[i] * scratch->j1[i];
        f2[i] = half * g_scale * factor2[i] * scratch->j2[i];
        full += grid->rule->weight[i] * f1[i];
        if (f2[i] > 0) {
            least = fmin(least, f1[i] / f2[i]);
            most = fmax(most, f1[i] / f2[i]);
        }
    }
    double contact = 1;
    if (pass->variance > CONTACT_FULL) {
        const double integral = contact_integral(pass->variance, ws->options.gamma);
        contact = integral / pass->variance;
        pass->hysteresis_error = (most - least) * integral;
    }
    add_moved(ws, scratch->omega, scratch->j1, scratch->j2, n, pass->variance, contact * full,
              pass->variance, pass);
    scratch->error_g[0] = rule_error(grid->rule, f2);
    scratch->error_mu[0] = contact * rule_error(grid->rule, f1);
    if (record)
        for (size_t i = 0; i < n; i++) {
            record->q[record->n] = grid->core_q[level * n + i];
            record->mu[record->n++] =
                contact * half * grid->rule->weight[i] * mu_scale * factor1[i] * scratch->j1[i];
        }
    return contact * full;
}

/* Of one panel, from the values with full contact and with S P, on top of a pass so far. Where P
 * leaves 1 the difference is too small to show in the last coefficients and too steep for the rule,
 * so it is looked at alone. */
static double hysteresis_error(const gauss_rule *rule, const double *full, const double *part,
                               const friction_pass *pass, double sum_g, double sum_mu)
{
    const double begun = 0.3; /* from there on all of P is in `part` */
    double gap[FRICTION_MAX_NODES];
    for (size_t i = 0; i < rule->n; i++)
        gap[i] = full[i] - part[i];
    const double own = pass->variance < begun ? rule_error(rule, full) + rule_error(rule, gap)
                                              : rule_error(rule, part);
    const double variance = pass->variance + sum_g;
    return own + (variance > 0 ? area_power * sum_mu * (pass->variance_error / variance) : 0);
}

void friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                       const scale_grid *grid, size_t level, friction_load at, bool with_outside,
                       friction_record *record, friction_pass *pass)
{
    const gauss_rule *rule = grid->rule;
    const size_t n = rule->n;
    const double gamma = ws->options.gamma;
    const double ratio = ws->stiffness / at.pressure;
    const double g_scale = ratio * ratio / 8;
    const double mu_scale = ratio / 2;
    double *panel_mu = scratch->panel_mu, *panel_g = scratch->panel_g;
    *pass = (friction_pass){0};
    pass->hysteresis = core_pass(ws, scratch, grid, level, at, mu_scale, record, pass);
    panel_mu[0] = pass->hysteresis;
    panel_g[0] = pass->variance;
    pass->variance_error = scratch->error_g[0];
    if (with_outside && scratch->j1[0] > 0)
        pass->outside =
            pass->hysteresis *
            (angular_outside(ws->angular, scratch->omega[0], scratch->j1[0]) / scratch->j1[0]);

    const size_t first = grid->levels - level;
    const size_t panels = grid->n_panels - first;
    const double *q = grid->q + first * n;
    const double *factor1 = grid->factor1 + first * n;
    const double *factor2 = grid->factor2 + first * n;
    angular_at(ws, scratch, q, panels * n, at.speed);
    for (size_t p = 0; p < panels; p++) {
        const double half = grid->half_width[first + p];
        const double *j1 = scratch->j1 + p * n;
        const double *j2 = scratch->j2 + p * n;
        double running[FRICTION_MAX_NODES], f[FRICTION_MAX_NODES], full[FRICTION_MAX_NODES];
        double sum_mu = 0;
        for (size_t j = 0; j < n; j++) {
            running[j] = pass->variance;
            f[j] = half * g_scale * factor2[p * n + j] * j2[j];
        }
        const double sum_g = rule_running(rule, f, running);
        scratch->error_g[p + 1] = rule_error(rule, f);
        pass->variance_error += scratch->error_g[p + 1];
        double below = pass->variance;
        for (size_t j = 0; j < n; j++) {
            /* G never falls: where it rises too steeply for a polynomial, the nodes so far */
            const double area = contact_area(running[j] < pass->variance ? below : running[j]);
            below += rule->weight[j] * f[j];
            const double correction = gamma + (1 - gamma) * area * area;
            full[j] = half * mu_scale * factor1[p * n + j] * j1[j];
            f[j] = full[j] * area * correction;
            const double share = rule->weight[j] * f[j];
            sum_mu += share;
            if (record) {
                record->q[record->n] = q[p * n + j];
                record->mu[record->n++] = share;
            }
            if (with_outside && share > 0)
                pass->outside +=
                    share *
                    (angular_outside(ws->angular, scratch->omega[p * n + j], j1[j]) / j1[j]);
        }
        add_moved(ws, scratch->omega + p * n, j1, j2, n, sum_g, sum_mu, pass->variance + sum_g,
                  pass);
        scratch->error_mu[p + 1] = hysteresis_error(rule, full, f, pass, sum_g, sum_mu);
        pass->variance += sum_g;
        pass->hysteresis += sum_mu;
        panel_g[p + 1] = sum_g;
        panel_mu[p + 1] = sum_mu;
    }
    for (size_t p = 0; p <= panels; p++)
        pass->hysteresis_error += scratch->error_mu[p];
    pass->parts = panels + 1;
    pass->nodes = pass->parts * n;
}
