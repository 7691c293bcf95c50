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
    const double ratio = j[0] > 0 && j[n - 1] > 0 ? j[n - 1] / j[0] : 1;
    const double few = 8; /* up to there |sinh ln| is at most twice |ln| */
    return ratio < few && ratio > 1 / few ? 0.5 * fabs(ratio - 1 / ratio) : fabs(log(ratio));
}

/* S P falls no faster than G to the power of minus this. */
static const double area_power = 1.5;

static double series_error(const wt_friction_workspace *ws, double low, double high)
{
    const double error = angular_error(ws->angular, low, high);
    return ws->softening == NULL
               ? error
               : ws->softening->caution * (error + angular_error(ws->loss, low, high));
}

/* What the errors of J1 and J2 make of the part of a pass whose n nodes are at ln omega = `x`; G so
 * far contains it. Errors of the series; and ln omega and the logarithms of the knots are rounded,
 * so what is steep there moves. */
static void add_moved(const wt_friction_workspace *ws, const double *x, const double *j1,
                      const double *j2, size_t n, double log_lowest, double variance,
                      double hysteresis, double variance_so_far, friction_pass *pass)
{
    if (angular_closed(ws->angular, x[0], x[n - 1]) &&
        (ws->loss == NULL || angular_closed(ws->loss, x[0], x[n - 1])))
        return;
    /* ln omega is a sum of two */
    const double far = fmax(fabs(x[0]), fabs(x[n - 1])) + fabs(log_lowest);
    const double moved = 4 * DBL_EPSILON * (1 + far);
    const double series = series_error(ws, x[0], x[n - 1]);
    pass->variance_moved += variance * (series + moved * steepness(j2, n));
    pass->hysteresis_moved += hysteresis * (series + moved * steepness(j1, n));
    if (variance_so_far > 0)
        pass->hysteresis_moved +=
            hysteresis * area_power * (pass->variance_moved / variance_so_far);
}

/* ---- nodes ----------------------------------------------------------------------------------- */

/* Those of one panel, of a core, or of many panels in a row. */
typedef struct node_view {
    const gauss_rule *rule;
    const double *t, *q, *factor1, *factor2;
    const double *f, *g; /* NULL without a softening */
    double half;
    double *omega, *log_omega, *j1, *j2;
} node_view;

static node_view place_view(friction_scratch *scratch, const scale_grid *grid, size_t from)
{
    return (node_view){.rule = grid->rule,
                       .omega = scratch->omega + from,
                       .log_omega = scratch->log_omega + from,
                       .j1 = scratch->j1 + from,
                       .j2 = scratch->j2 + from};
}

static node_view panel_view(friction_scratch *scratch, const scale_grid *grid, size_t p,
                            size_t from)
{
    const size_t at = p * grid->rule->n;
    node_view view = place_view(scratch, grid, from);
    view.t = grid->t + at;
    view.q = grid->q + at;
    view.factor1 = grid->factor1 + at;
    view.factor2 = grid->factor2 + at;
    view.half = grid->half_width[p];
    if (grid->f != NULL) {
        view.f = grid->f + at;
        view.g = grid->g + at;
    }
    return view;
}

/* J1 and J2 of the softened moduli, from those of the moduli. */
static void soften(const friction_scratch *scratch, const node_view *view)
{
    if (view->f == NULL)
        return;
    const double *loss = scratch->loss_j2 + (view->omega - scratch->omega);
    for (size_t i = 0; i < view->rule->n; i++) {
        const double f = view->f[i], g = view->g[i];
        view->j1[i] *= g;
        view->j2[i] = f * f * view->j2[i] + (g - f) * (g + f) * loss[i];
    }
}

static void place_omega(const node_view *view, friction_load at)
{
    for (size_t i = 0; i < view->rule->n; i++) {
        view->omega[i] = view->q[i] * at.speed;
        view->log_omega[i] = view->t[i] + at.log_lowest;
    }
}

/* J1 and J2 at n nodes whose omega has been placed. */
static void evaluate_nodes(const wt_friction_workspace *ws, friction_scratch *scratch,
                           const double *omega, size_t n)
{
    const size_t from = (size_t)(omega - scratch->omega);
    scratch->nodes += n;
    const double *x = scratch->log_omega + from;
    angular_eval(ws->angular, omega, x, n, scratch->j1 + from, scratch->j2 + from);
    if (ws->loss != NULL)
        angular_eval(ws->loss, omega, x, n, scratch->loss_j1 + from, scratch->loss_j2 + from);
}

static node_view core_view(const wt_friction_workspace *ws, friction_scratch *scratch,
                           const panel_plan *plan, size_t step, size_t level, friction_load at)
{
    scale_grid *grid = &scratch->grids[step];
    const size_t from = (scratch->room + 1) * FRICTION_MAX_NODES;
    grid_fill_core(grid, plan, level, ws->roughness, &ws->options.layer);
    node_view view = place_view(scratch, grid, from);
    const size_t first = level * grid->rule->n;
    view.t = grid->core_t + first;
    view.q = grid->core_q + first;
    view.factor1 = grid->core_factor1 + first;
    view.factor2 = grid->core_factor2 + first;
    view.half = grid->core_half_width[level];
    if (grid->f != NULL) {
        view.f = grid->core_f + first;
        view.g = grid->core_g + first;
    }
    place_omega(&view, at);
    evaluate_nodes(ws, scratch, view.omega, grid->rule->n);
    soften(scratch, &view);
    return view;
}

/* Of G at a node from J2, and of the hysteresis at full contact from J1. */
typedef struct pass_scale {
    double g, mu;
} pass_scale;

static pass_scale scale_of(const wt_friction_workspace *ws, friction_load at)
{
    const double ratio = ws->stiffness / at.pressure;
    return (pass_scale){.g = ratio * ratio / 8, .mu = ratio / 2};
}

/* Both over the nodes, without weights. */
static void fill_parts(const node_view *view, pass_scale scale, double *g, double *mu)
{
    for (size_t i = 0; i < view->rule->n; i++) {
        g[i] = view->half * scale.g * view->factor2[i] * view->j2[i];
        mu[i] = view->half * scale.mu * view->factor1[i] * view->j1[i];
    }
}

static double weighted(const gauss_rule *rule, const double *f)
{
    double sum = 0;
    for (size_t i = 0; i < rule->n; i++)
        sum += rule->weight[i] * f[i];
    return sum;
}

typedef struct pass_part {
    double variance, hysteresis;
    double variance_error, hysteresis_error; /* from the rule */
    double closed_error;                     /* of the hysteresis from the closed form in a core */
    double share[FRICTION_MAX_NODES];        /* of the hysteresis, by node */
} pass_part;

static rule_fall fall_of(const wt_friction_workspace *ws)
{
    return ws->material->law->angular != NULL && ws->softening == NULL ? FALL_SMOOTH : FALL_LAW;
}

/* ---- core ------------------------------------------------------------------------------------ */

/* One in which P is 1 or that is as deep as they go, at no less than `*level`: the largest, or the
 * one next to that of the velocity before. */
static node_view find_core(const wt_friction_workspace *ws, friction_scratch *scratch,
                           const panel_plan *plan, size_t step, friction_load at, size_t *level)
{
    const double target = 0.5 * CONTACT_FULL;
    friction_trail *trail = &scratch->trail;
    /* panels that move with knots have other cores each time */
    if (plan == &ws->plan && trail->n > 0 && *level < trail->level)
        *level = trail->level;
    if (*level > plan->levels)
        *level = plan->levels;
    for (;;) {
        const node_view core = core_view(ws, scratch, plan, step, *level, at);
        double g[FRICTION_MAX_NODES], mu[FRICTION_MAX_NODES];
        fill_parts(&core, scale_of(ws, at), g, mu);
        const double variance = weighted(core.rule, g);
        if (*level >= plan->levels || !(variance > target)) {
            const double larger = floor(0.5 * log2(target / variance)) - 1;
            trail->level = larger > 0 ? *level - (size_t)fmin(larger, (double)*level) : *level;
            return core;
        }
        const double deeper = ceil(0.5 * log2(variance / target)); /* a cell is 1/4 of the next */
        const size_t left = plan->levels - *level;
        *level += deeper < (double)left ? (size_t)fmax(1, deeper) : left;
    }
}

/* P is 1 in the core, or the core is so short that dmu/dG hardly changes in it:
 * mu = (dmu/dG) int S P dG in closed form. */
static void core_pass(const wt_friction_workspace *ws, const node_view *core, pass_scale scale,
                      pass_part *part)
{
    const gauss_rule *rule = core->rule;
    double g[FRICTION_MAX_NODES], mu[FRICTION_MAX_NODES];
    double least = (double)INFINITY, most = 0, contact = 1;
    fill_parts(core, scale, g, mu);
    rule_top top_g, top_mu;
    rule_tops(rule, g, mu, &top_g, &top_mu);
    part->variance = weighted(rule, g);
    part->variance_error = rule_error(rule, &top_g, fall_of(ws));
    for (size_t i = 0; i < rule->n; i++)
        if (g[i] > 0) {
            least = fmin(least, mu[i] / g[i]);
            most = fmax(most, mu[i] / g[i]);
        }
    part->closed_error = 0;
    if (part->variance > CONTACT_FULL) {
        const double integral = contact_integral(part->variance, ws->options.gamma);
        contact = integral / part->variance;
        part->closed_error = (most - least) * integral;
    }
    part->hysteresis = contact * weighted(rule, mu);
    part->hysteresis_error = contact * rule_error(rule, &top_mu, fall_of(ws));
    for (size_t i = 0; i < rule->n; i++)
        part->share[i] = contact * rule->weight[i] * mu[i];
}

/* ---- panels ---------------------------------------------------------------------------------- */

static const double steep_rise = 2;
/* From this G on all of P shows in the hysteresis. */
static const double area_begun = 0.3;

/* Of one panel, from the values with full contact and with S P, G rising from `before` to `after`.
 * Where P leaves 1 the difference is too small to show in the last coefficients and too steep for
 * the rule, so it is looked at alone. */
static double hysteresis_error(const gauss_rule *rule, const rule_top *full, const rule_top *part,
                               rule_fall fall, double before, double after)
{
    const bool steep = after > CONTACT_FULL && after > steep_rise * before;
    rule_top gap;
    if (!(before < area_begun))
        return rule_error(rule, part, steep ? FALL_STEEP : fall);
    const double own = rule_error(rule, full, fall);
    if (!(after > CONTACT_FULL))
        return own;
    for (size_t k = 0; k < RULE_TOP; k++)
        gap.coefficient[k] = full->coefficient[k] - part->coefficient[k];
    return own + rule_error(rule, &gap, steep ? FALL_STEEP : fall);
}

/* On top of a variance so far. */
static void panel_pass(const wt_friction_workspace *ws, const node_view *view, pass_scale scale,
                       double variance, pass_part *part)
{
    const gauss_rule *rule = view->rule;
    const double gamma = ws->options.gamma;
    double running[FRICTION_MAX_NODES], g[FRICTION_MAX_NODES], full[FRICTION_MAX_NODES],
        area[FRICTION_MAX_NODES], mu[FRICTION_MAX_NODES];
    rule_top top_g, top_full, top_mu;
    fill_parts(view, scale, g, full);
    for (size_t j = 0; j < rule->n; j++)
        running[j] = variance;
    part->variance = rule_running(rule, g, running);
    part->closed_error = 0;
    part->hysteresis = 0;
    double below = variance, highest = variance;
    for (size_t j = 0; j < rule->n; j++) {
        /* G never falls: where it rises too steeply for a polynomial, the nodes so far */
        const double here = running[j] < variance ? below : running[j];
        below += rule->weight[j] * g[j];
        running[j] = highest = here > highest ? here : highest;
    }
    contact_areas(running, rule->n, area);
    for (size_t j = 0; j < rule->n; j++) {
        mu[j] = full[j] * area[j] * (gamma + (1 - gamma) * area[j] * area[j]);
        part->share[j] = rule->weight[j] * mu[j];
        part->hysteresis += part->share[j];
    }
    rule_tops(rule, g, mu, &top_g, &top_mu);
    part->variance_error = rule_error(rule, &top_g, fall_of(ws));
    if (variance < area_begun)
        rule_tops(rule, full, mu, &top_full, &top_mu);
    part->hysteresis_error = hysteresis_error(rule, &top_full, &top_mu, fall_of(ws), variance,
                                              variance + part->variance);
}

/* About the hysteresis of a pass whose panels begin so far up. */
static double rough_hysteresis(const wt_friction_workspace *ws, friction_scratch *scratch,
                               size_t first, size_t last, pass_scale scale,
                               const friction_pass *core)
{
    double variance = core->variance, hysteresis = core->hysteresis;
    for (size_t p = first; p < last; p++) {
        const node_view view =
            panel_view(scratch, &scratch->grids[scratch->step[p]], p, scratch->from[p]);
        double rise = 0, full = 0;
        for (size_t i = 0; i < view.rule->n; i++) {
            rise += view.rule->weight[i] * view.factor2[i] * view.j2[i];
            full += view.rule->weight[i] * view.factor1[i] * view.j1[i];
        }
        rise *= view.half * scale.g;
        const double square = 1 / (1 + M_PI * (variance + 0.5 * rise)); /* about P^2 */
        hysteresis += view.half * scale.mu * full * sqrt(square) *
                      (ws->options.gamma + (1 - ws->options.gamma) * square);
        variance += rise;
    }
    return hysteresis;
}

/* Adds a part, from the nodes in view, to a pass. */
static void add_part(const wt_friction_workspace *ws, friction_scratch *scratch,
                     const node_view *view, const pass_part *part, double log_lowest,
                     bool with_outside, friction_record *record, friction_pass *pass)
{
    const size_t n = view->rule->n, place = pass->parts++;
    const double variance = pass->variance + part->variance;
    const double moved = place > 0 && variance > 0 ? area_power / variance : 0;
    for (size_t j = 0; record && j < n; j++) {
        record->q[record->n] = view->q[j];
        record->mu[record->n++] = part->share[j];
    }
    for (size_t j = 0; with_outside && j < n; j++)
        if (part->share[j] > 0) {
            const double j1 = view->g != NULL ? view->j1[j] / view->g[j] : view->j1[j];
            pass->outside +=
                part->share[j] * (angular_outside(ws->angular, view->omega[j], j1) / j1);
        }
    pass->variance_error += part->variance_error;
    add_moved(ws, view->log_omega, view->j1, view->j2, n, log_lowest, part->variance,
              part->hysteresis, variance, pass);
    scratch->error_g[place] = part->variance_error;
    scratch->error_mu[place] = part->hysteresis_error + part->closed_error +
                               moved * part->hysteresis * pass->variance_error;
    scratch->panel_g[place] = part->variance;
    scratch->panel_mu[place] = part->hysteresis;
    pass->variance = variance;
    pass->hysteresis += part->hysteresis;
    pass->hysteresis_error += scratch->error_mu[place];
    pass->nodes += n;
}

/* ---- from one velocity to the next ------------------------------------------------------------
 */

/* Of the panel of the velocity before that the middle of this one lies in; `k` is where to look
 * from. */
static friction_start start_of(const wt_friction_workspace *ws, const friction_trail *trail,
                               const grid_panel *panel, size_t step, size_t *k)
{
    const double middle = 0.5 * (panel->t_low + panel->t_high);
    while (*k < trail->n && trail->starts[*k].t_high < middle)
        ++*k;
    friction_start start = {.step = ws->first_step};
    if (*k < trail->n)
        start = trail->starts[*k];
    if (start.step < step)
        start.step = step;
    start.t_high = panel->t_high;
    return start;
}

/* The error of a rule of so many nodes less is larger by no more than this for each of them. */
static const double node_worth = 0.03;

/* Whether the rule suffices for so much of the variance so far and of the hysteresis. */
static bool is_fine(const pass_part *part, double variance, double hysteresis)
{
    return part->variance_error <= variance && part->hysteresis_error <= hysteresis;
}

void friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                       const panel_plan *plan, friction_effort effort, friction_load at,
                       bool with_outside, friction_record *record, friction_pass *pass)
{
    const pass_scale scale = scale_of(ws, at);
    const double share = effort.share * ws->options.tolerance;
    const wt_roughness *roughness = ws->roughness;
    const wt_layer_state *layer = &ws->options.layer;
    pass_part part;
    size_t level = effort.level, step = effort.step;
    node_view view = find_core(ws, scratch, plan, step, at, &level);
    for (core_pass(ws, &view, scale, &part);
         !is_fine(&part, share * part.variance, share * part.hysteresis) && ++step < FRICTION_STEPS;
         core_pass(ws, &view, scale, &part))
        view = core_view(ws, scratch, plan, step, level, at);
    *pass = (friction_pass){.level = level};
    add_part(ws, scratch, &view, &part, at.log_lowest, with_outside, record, pass);

    friction_trail *trail = &scratch->trail;
    friction_start *ends = trail->spare;
    const size_t first = plan->levels - level, last = plan->n_panels;
    size_t nodes = 0;
    for (size_t p = first, k = 0; p < last; p++) {
        ends[p - first] = start_of(ws, trail, &plan->panels[p], effort.step, &k);
        scratch->step[p] = ends[p - first].step;
        scratch->from[p] = nodes;
        scale_grid *grid = &scratch->grids[scratch->step[p]];
        grid_fill_panels(grid, plan, p, p + 1, roughness, layer);
        view = panel_view(scratch, grid, p, nodes);
        place_omega(&view, at);
        nodes += grid->rule->n;
    }
    evaluate_nodes(ws, scratch, scratch->omega, nodes);
    for (size_t p = first; p < last; p++) {
        view = panel_view(scratch, &scratch->grids[scratch->step[p]], p, scratch->from[p]);
        soften(scratch, &view);
    }
    const double hysteresis = share * rough_hysteresis(ws, scratch, first, last, scale, pass);
    for (size_t p = first; p < last; p++) {
        friction_start *end = &ends[p - first];
        view = panel_view(scratch, &scratch->grids[end->step], p, scratch->from[p]);
        panel_pass(ws, &view, scale, pass->variance, &part);
        double variance = share * (pass->variance + part.variance);
        while (end->step + 1 < FRICTION_STEPS && !is_fine(&part, variance, hysteresis)) {
            scale_grid *finer = &scratch->grids[++end->step];
            end->least = end->step;
            grid_fill_panels(finer, plan, p, p + 1, roughness, layer);
            view = panel_view(scratch, finer, p, scratch->room * FRICTION_MAX_NODES);
            place_omega(&view, at);
            evaluate_nodes(ws, scratch, view.omega, finer->rule->n);
            soften(scratch, &view);
            panel_pass(ws, &view, scale, pass->variance, &part);
            variance = share * (pass->variance + part.variance);
        }
        if (end->step > end->least) {
            const size_t fewer = view.rule->n - ws->rules[end->step - 1]->n;
            double worth = 1;
            for (size_t i = 0; i < fewer; i++)
                worth *= node_worth;
            if (is_fine(&part, worth * variance, worth * hysteresis))
                end->step--;
        }
        add_part(ws, scratch, &view, &part, at.log_lowest, with_outside, record, pass);
    }
    trail->spare = trail->starts;
    trail->starts = ends;
    trail->n = last - first;
}
