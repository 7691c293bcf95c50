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

/* S P falls no faster than G to the power of minus this: P = erf(1/(2 sqrt G)) as G^(-1/2), and
 * S = gamma + (1 - gamma) P^2 as 1/G at most. */
static const double area_power = 1.5;

static double series_error(const wt_friction_workspace *ws, double low, double high,
                           friction_pass *pass)
{
    const double error = angular_error(ws->angular, low, high, &pass->piece);
    return ws->softening == NULL
               ? error
               : ws->softening->caution *
                     (error + angular_error(ws->loss, low, high, &pass->loss_piece));
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
    const double series = series_error(ws, x[0], x[n - 1], pass);
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
    double *rise, *full; /* of G, and of the hysteresis at full contact: without weights */
} node_view;

static node_view place_view(friction_scratch *scratch, const scale_grid *grid, size_t from)
{
    return (node_view){.rule = grid->rule,
                       .omega = scratch->omega + from,
                       .log_omega = scratch->log_omega + from,
                       .j1 = scratch->j1 + from,
                       .j2 = scratch->j2 + from,
                       .rise = scratch->rise + from,
                       .full = scratch->full + from};
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
static void soften_moduli(const friction_scratch *scratch, const node_view *view)
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

static void place_nodes(size_t n, const double *restrict q, const double *restrict t,
                        friction_load at, double *restrict omega, double *restrict log_omega)
{
    for (size_t i = 0; i < n; i++) {
        omega[i] = q[i] * at.speed;
        log_omega[i] = t[i] + at.log_lowest;
    }
}

static void place_omega(const node_view *view, friction_load at)
{
    place_nodes(view->rule->n, view->q, view->t, at, view->omega, view->log_omega);
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

/* Of G at a node from J2, and of the hysteresis at full contact from J1. */
typedef struct pass_scale {
    double g, mu;
} pass_scale;

static pass_scale scale_of(const wt_friction_workspace *ws, friction_load at)
{
    const double ratio = ws->stiffness / at.pressure;
    return (pass_scale){.g = ratio * ratio / 8, .mu = ratio / 2};
}

static void scale_parts(size_t n, double scale, const double *restrict factor,
                        const double *restrict j, double *restrict part)
{
    for (size_t i = 0; i < n; i++)
        part[i] = scale * factor[i] * j[i];
}

/* Both at the nodes. */
static void fill_parts(const node_view *view, pass_scale scale)
{
    scale_parts(view->rule->n, view->half * scale.g, view->factor2, view->j2, view->rise);
    scale_parts(view->rule->n, view->half * scale.mu, view->factor1, view->j1, view->full);
}

static node_view core_view(const wt_friction_workspace *ws, friction_scratch *scratch,
                           const panel_plan *plan, size_t step, size_t level, friction_load at,
                           pass_scale scale)
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
    soften_moduli(scratch, &view);
    fill_parts(&view, scale);
    return view;
}

static double weighted_sum(const gauss_rule *rule, const double *f)
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

/* What a rule leaves of an integrand that is as smooth as the moduli are. */
static double error_of(const wt_friction_workspace *ws, const gauss_rule *rule, const rule_top *top)
{
    return rule_error(rule, top, ws->fall, ws->fastest);
}

/* ---- about what there will be -----------------------------------------------------------------
 */

/* Of a panel on top of a variance so far. */
static double rough_part(const wt_friction_workspace *ws, const friction_scratch *scratch, size_t p,
                         double variance)
{
    const double gamma = ws->options.gamma;
    const double square = 1 / (1 + M_PI * (variance + 0.5 * scratch->rough_g[p])); /* about P^2 */
    return scratch->rough_mu[p] * sqrt(square) * (gamma + (1 - gamma) * square);
}

/* The hysteresis of the panels outside the cells. */
static double rough_hysteresis(const wt_friction_workspace *ws, const friction_scratch *scratch,
                               const panel_plan *plan, double variance)
{
    double hysteresis = 0;
    for (size_t p = plan->levels; p < plan->n_panels; p++) {
        hysteresis += rough_part(ws, scratch, p, variance);
        variance += scratch->rough_g[p];
    }
    return hysteresis;
}

/* What the rules may leave in one panel. */
typedef struct pass_allowed {
    double variance, hysteresis;
} pass_allowed;

/* On top of a core; `of_variance` then tells what an error of G from a panel on makes of the
 * hysteresis: that of its P there and in all panels above it. */
static pass_allowed allow_errors(const wt_friction_workspace *ws, friction_scratch *scratch,
                                 size_t first, size_t last, double share, const friction_pass *core)
{
    double variance = core->variance, hysteresis = core->hysteresis, sum = 0;
    for (size_t p = first; p < last; p++) {
        const double part = rough_part(ws, scratch, p, variance);
        variance += scratch->rough_g[p];
        hysteresis += part;
        scratch->of_variance[p] = variance > 0 ? area_power * part / variance : 0;
    }
    for (size_t p = last; p > first; p--)
        scratch->of_variance[p - 1] = sum += scratch->of_variance[p - 1];
    return (pass_allowed){share * variance, share * hysteresis};
}

/* ---- core ------------------------------------------------------------------------------------ */

/* P is 1 in the core, or the core is so short that dmu/dG hardly changes in it:
 * mu = (dmu/dG) int S P dG in closed form. */
static void core_pass(const wt_friction_workspace *ws, const node_view *core, pass_part *part)
{
    const gauss_rule *rule = core->rule;
    const double *g = core->rise, *mu = core->full;
    double least = (double)INFINITY, most = 0, contact = 1;
    rule_top top_g, top_mu;
    rule_tops(rule, g, mu, &top_g, &top_mu);
    part->variance = weighted_sum(rule, g);
    part->variance_error = error_of(ws, rule, &top_g);
    part->closed_error = 0;
    if (part->variance > CONTACT_FULL) {
        for (size_t i = 0; i < rule->n; i++)
            if (g[i] > 0) {
                least = fmin(least, mu[i] / g[i]);
                most = fmax(most, mu[i] / g[i]);
            }
        const double integral = contact_integral(part->variance, ws->options.gamma);
        contact = integral / part->variance;
        part->closed_error = (most - least) * integral;
    }
    part->hysteresis = contact * weighted_sum(rule, mu);
    part->hysteresis_error = contact * error_of(ws, rule, &top_mu);
    for (size_t i = 0; i < rule->n; i++)
        part->share[i] = contact * rule->weight[i] * mu[i];
}

/* By how many levels a core is too short: a cell is 1/4 of the next, and so is G in the core; what
 * the closed form neglects, the change of dmu/dG times the integral, is 1/16. */
static double levels_short(const pass_part *part, double allowed)
{
    const double target = 0.5 * CONTACT_FULL;
    const double full = part->variance > 0 ? 0.5 * log2(target / part->variance) : 0;
    return part->closed_error > 0 && allowed > 0
               ? fmax(full, 0.25 * log2(allowed / part->closed_error))
               : full;
}

/* The largest core, at no less than `*level`, in which P is 1 or the error of the closed form is no
 * more than `allowed` of the hysteresis; or one as deep as they go. That of the velocity before is
 * tried first. */
static node_view find_core(const wt_friction_workspace *ws, friction_scratch *scratch,
                           const panel_plan *plan, size_t step, friction_load at, pass_scale scale,
                           double allowed, size_t *level, pass_part *part)
{
    friction_trail *trail = &scratch->trail;
    /* panels that move with knots have other cores each time */
    if (plan == &ws->plan && trail->n > 0 && *level < trail->level)
        *level = trail->level;
    if (*level > plan->levels)
        *level = plan->levels;
    for (;;) {
        const node_view core = core_view(ws, scratch, plan, step, *level, at, scale);
        core_pass(ws, &core, part);
        const double cells = ldexp(part->variance, 2 * (int)*level); /* G up to the panels */
        const double least = allowed > 0 ? allowed * rough_hysteresis(ws, scratch, plan, cells) : 0;
        const double shorter = levels_short(part, least);
        if (*level >= plan->levels || !(shorter < 0)) {
            const double larger = floor(shorter) - 1;
            trail->level = larger > 0 ? *level - (size_t)fmin(larger, (double)*level) : *level;
            return core;
        }
        const double deeper = ceil(-shorter);
        const size_t left = plan->levels - *level;
        *level += deeper < (double)left ? (size_t)fmax(1, deeper) : left;
    }
}

/* ---- panels ---------------------------------------------------------------------------------- */

/* A panel over which G rises by no more is as smooth to the rule as any. */
static const double steep_rise = 2;
/* From this G on all of P shows in the hysteresis: 1 - P is a fifth there, and no small difference
 * any more. */
static const double area_begun = 0.3;

/* Of one panel, from the values with full contact and with S P, G rising from `before` to `after`.
 * Where P leaves 1 the difference is too small to show in the last coefficients and too steep for
 * the rule, so it is looked at alone. */
static double hysteresis_error(const wt_friction_workspace *ws, const gauss_rule *rule,
                               const rule_top *full, const rule_top *part, double before,
                               double after)
{
    const bool steep = after > CONTACT_FULL && after > steep_rise * before;
    const rule_fall fall = steep ? FALL_STEEP : ws->fall;
    rule_top gap;
    if (!(before < area_begun))
        return rule_error(rule, part, fall, ws->fastest);
    const double own = error_of(ws, rule, full);
    if (!(after > CONTACT_FULL))
        return own;
    for (size_t k = 0; k < RULE_TOP; k++)
        gap.coefficient[k] = full->coefficient[k] - part->coefficient[k];
    return own + rule_error(rule, &gap, fall, ws->fastest);
}

/* On top of a variance so far. */
static void panel_pass(const wt_friction_workspace *ws, const node_view *view, double variance,
                       pass_part *part)
{
    const gauss_rule *rule = view->rule;
    const double gamma = ws->options.gamma, *g = view->rise, *full = view->full;
    double running[FRICTION_MAX_NODES + CONTACT_ROOM], area[FRICTION_MAX_NODES + CONTACT_ROOM],
        mu[FRICTION_MAX_NODES];
    rule_top top_g, top_full, top_mu;
    for (size_t j = 0; j < rule->n + CONTACT_ROOM; j++)
        running[j] = variance;
    part->variance = rule_running(rule, g, running);
    part->closed_error = 0;
    part->hysteresis = 0;
    bool falls = running[0] < variance;
    for (size_t j = 1; j < rule->n; j++)
        falls |= running[j] < running[j - 1];
    /* G never falls: where it rises too steeply for a polynomial, the nodes so far */
    double below = variance, highest = variance;
    for (size_t j = 0; falls && j < rule->n; j++) {
        const double here = running[j] < variance ? below : running[j];
        below += rule->weight[j] * g[j];
        running[j] = highest = here > highest ? here : highest;
    }
    contact_areas(running, rule->n, area);
    for (size_t j = 0; j < rule->n; j++)
        mu[j] = full[j] * area[j] * (gamma + (1 - gamma) * area[j] * area[j]);
    for (size_t j = 0; j < rule->n; j++) {
        part->share[j] = rule->weight[j] * mu[j];
        part->hysteresis += part->share[j];
    }
    rule_tops(rule, g, mu, &top_g, &top_mu);
    part->variance_error = error_of(ws, rule, &top_g);
    if (variance < area_begun)
        rule_tops(rule, full, mu, &top_full, &top_mu);
    part->hysteresis_error =
        hysteresis_error(ws, rule, &top_full, &top_mu, variance, variance + part->variance);
}

/* Adds a part, from the nodes in view, to a pass. */
static void add_part(const wt_friction_workspace *ws, friction_scratch *scratch,
                     const node_view *view, const pass_part *part, double log_lowest,
                     bool with_outside, friction_record *record, friction_pass *pass)
{
    const size_t n = view->rule->n, place = pass->parts++;
    const double variance = pass->variance + part->variance;
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
    scratch->error_mu[place] = part->hysteresis_error + part->closed_error;
    if (place > 0 && variance > 0) /* G may be next to nothing, and its quotients no numbers */
        scratch->error_mu[place] +=
            area_power * part->hysteresis * (pass->variance_error / variance);
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

/* The panels from the `first` up to the `last`, left out, with the rules to begin with: their nodes
 * go where there is room from `nodes` on. Returns where it ends. */
static size_t begin_panels(const wt_friction_workspace *ws, friction_scratch *scratch,
                           const panel_plan *plan, size_t first, size_t last, size_t step,
                           size_t nodes, friction_load at, pass_scale scale)
{
    const size_t begin = nodes;
    for (size_t p = first, k = scratch->trail.first; p < last; p++) {
        friction_start *end = &scratch->trail.spare[p];
        *end = start_of(ws, &scratch->trail, &plan->panels[p], step, &k);
        scratch->from[p] = nodes;
        scale_grid *grid = &scratch->grids[end->step];
        grid_fill_panels(grid, plan, p, p + 1, ws->roughness, &ws->options.layer);
        const node_view view = panel_view(scratch, grid, p, nodes);
        place_omega(&view, at);
        nodes += grid->rule->n;
    }
    evaluate_nodes(ws, scratch, scratch->omega + begin, nodes - begin);
    for (size_t p = first; p < last; p++) {
        const scale_grid *grid = &scratch->grids[scratch->trail.spare[p].step];
        const node_view view = panel_view(scratch, grid, p, scratch->from[p]);
        soften_moduli(scratch, &view);
        fill_parts(&view, scale);
        scratch->rough_g[p] = weighted_sum(view.rule, view.rise);
        scratch->rough_mu[p] = weighted_sum(view.rule, view.full);
    }
    return nodes;
}

/* A panel with the next rule. */
static node_view finer_view(const wt_friction_workspace *ws, friction_scratch *scratch,
                            const panel_plan *plan, size_t p, size_t step, friction_load at,
                            pass_scale scale)
{
    scale_grid *grid = &scratch->grids[step];
    grid_fill_panels(grid, plan, p, p + 1, ws->roughness, &ws->options.layer);
    const node_view view = panel_view(scratch, grid, p, scratch->room * FRICTION_MAX_NODES);
    place_omega(&view, at);
    evaluate_nodes(ws, scratch, view.omega, grid->rule->n);
    soften_moduli(scratch, &view);
    fill_parts(&view, scale);
    return view;
}

/* Whether what the rule leaves is so small a part of what is allowed. */
static bool is_fine(const pass_part *part, double of_variance, pass_allowed allowed, double worth)
{
    return part->variance_error <= worth * allowed.variance &&
           part->variance_error * of_variance <= worth * allowed.hysteresis &&
           part->hysteresis_error <= worth * allowed.hysteresis;
}

void friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                       const panel_plan *plan, friction_effort effort, friction_load at,
                       bool with_outside, friction_record *record, friction_pass *pass)
{
    const pass_scale scale = scale_of(ws, at);
    const double share = effort.share * ws->options.tolerance;
    const bool closed = !effort.all_along && ws->options.gamma == 1;
    friction_trail *trail = &scratch->trail;
    pass_part part;
    size_t level = effort.level, step = effort.step;
    const size_t last = plan->n_panels;
    const size_t nodes =
        begin_panels(ws, scratch, plan, plan->levels, last, effort.step, 0, at, scale);
    node_view view =
        find_core(ws, scratch, plan, step, at, scale, closed ? share : 0, &level, &part);
    const size_t first = plan->levels - level;
    (void)begin_panels(ws, scratch, plan, first, plan->levels, effort.step, nodes, at, scale);
    *pass = (friction_pass){.variance = part.variance, .hysteresis = part.hysteresis};
    const pass_allowed total = allow_errors(ws, scratch, first, last, share, pass);
    pass_allowed allowed = total;
    if (effort.all_along)
        allowed = (pass_allowed){share * part.variance, share * part.hysteresis};
    while (!is_fine(&part, scratch->of_variance[first], allowed, 1) && ++step < FRICTION_STEPS) {
        view = core_view(ws, scratch, plan, step, level, at, scale);
        core_pass(ws, &view, &part);
    }
    *pass = (friction_pass){.level = level};
    add_part(ws, scratch, &view, &part, at.log_lowest, with_outside, record, pass);
    allowed = total;
    for (size_t p = first; p < last; p++) {
        friction_start *end = &trail->spare[p];
        const double of_variance = scratch->of_variance[p];
        for (view = panel_view(scratch, &scratch->grids[end->step], p, scratch->from[p]);;
             view = finer_view(ws, scratch, plan, p, end->step, at, scale)) {
            panel_pass(ws, &view, pass->variance, &part);
            if (effort.all_along)
                allowed.variance = share * (pass->variance + part.variance);
            if (end->step + 1 == FRICTION_STEPS || is_fine(&part, of_variance, allowed, 1))
                break;
            end->least = ++end->step;
        }
        if (end->step > end->least) {
            /* a node is worth two degrees, and each no more than the poles let it */
            const size_t fewer = view.rule->n - ws->rules[end->step - 1]->n;
            double worth = 1;
            for (size_t i = 0; i < fewer; i++)
                worth *= ws->fastest * ws->fastest;
            if (is_fine(&part, of_variance, allowed, worth))
                end->step--;
        }
        add_part(ws, scratch, &view, &part, at.log_lowest, with_outside, record, pass);
    }
    friction_start *before = trail->starts;
    trail->starts = trail->spare;
    trail->spare = before;
    trail->first = first;
    trail->n = last;
}
