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
#include "friction/numerics/friction_kernel.h"

#include "friction/numerics/persson_contact.h"

#include <math.h>

/* ---- nodes ----------------------------------------------------------------------------------- */

/* Nodes of one subinterval, of a core, or of several adjacent subintervals. */
typedef struct node_view {
    const gauss_rule *rule;
    const double *t, *q, *factor1, *factor2;
    const double *f, *g; /* NULL without softening */
    double half;
    double *omega, *log_omega, *j1, *j2;
    double *rise, *full; /* rise of G, and hysteresis at full contact, both without weights */
} node_view;

static node_view create_view(friction_scratch *scratch, const scale_grid *grid, size_t from)
{
    return (node_view){.rule = grid->rule,
                       .omega = scratch->omega + from,
                       .log_omega = scratch->log_omega + from,
                       .j1 = scratch->j1 + from,
                       .j2 = scratch->j2 + from,
                       .rise = scratch->rise + from,
                       .full = scratch->full + from};
}

static node_view subinterval_view(friction_scratch *scratch, const scale_grid *grid, size_t p,
                                  size_t from)
{
    const size_t at = p * grid->rule->n;
    node_view view = create_view(scratch, grid, from);
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

/* Converts J1 and J2 to those of the softened moduli. */
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

static void fill_frequencies(size_t n, const double *restrict q, const double *restrict t,
                             friction_load at, double *restrict omega, double *restrict log_omega)
{
    for (size_t i = 0; i < n; i++) {
        omega[i] = q[i] * at.speed;
        log_omega[i] = t[i] + at.log_lowest;
    }
}

static void fill_view_frequencies(const node_view *view, friction_load at)
{
    fill_frequencies(view->rule->n, view->q, view->t, at, view->omega, view->log_omega);
    if (at.heat != NULL)
        friction_shift_nodes(at.heat, view->q, view->rule->n, view->omega, view->log_omega);
}

/* Evaluates J1 and J2 at n nodes whose frequencies are set. */
static void evaluate_nodes(const wt_friction_workspace *ws, friction_scratch *scratch,
                           const double *q, const double *omega, size_t n)
{
    const size_t from = (size_t)(omega - scratch->omega);
    double *loss_j1 = ws->loss != NULL ? scratch->loss_j1 + from : NULL;
    double *loss_j2 = ws->loss != NULL ? scratch->loss_j2 + from : NULL;
    scratch->nodes += n;
    friction_moduli(ws, q, omega, scratch->log_omega + from, n, scratch->j1 + from,
                    scratch->j2 + from, loss_j1, loss_j2, &scratch->own_error);
}

/* Factors of G from J2, and of the hysteresis at full contact from J1. */
typedef struct pass_scale {
    double g, mu;
} pass_scale;

static pass_scale compute_pass_scale(const wt_friction_workspace *ws, friction_load at)
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

/* Computes both contributions at the nodes. */
static void fill_parts(const node_view *view, pass_scale scale)
{
    scale_parts(view->rule->n, view->half * scale.g, view->factor2, view->j2, view->rise);
    scale_parts(view->rule->n, view->half * scale.mu, view->factor1, view->j1, view->full);
}

/* Largest share of the remaining error budget for one part. */
static const double part_share = 0.25;

/* State shared by the parts of one pass. */
typedef struct pass_state {
    const wt_friction_workspace *ws;
    friction_scratch *scratch;
    const subinterval_plan *plan;
    friction_effort effort;
    friction_load at;
    pass_scale scale;
    bool with_outside;
    node_contributions *record; /* NULL if none */
    friction_pass *pass;
    double variance_left, hysteresis_left;   /* remaining error budget of the rules */
    double variance_least, hysteresis_least; /* lower limit of the budget of a part */
} pass_state;

/* Evaluates the contributions to G and to the hysteresis at the nodes of a subinterval or core. */
static void evaluate_view(const pass_state *w, const node_view *view)
{
    fill_view_frequencies(view, w->at);
    evaluate_nodes(w->ws, w->scratch, view->q, view->omega, view->rule->n);
    soften_moduli(w->scratch, view);
    fill_parts(view, w->scale);
}

static node_view core_view(const pass_state *w, size_t rule, size_t level)
{
    friction_scratch *scratch = w->scratch;
    scale_grid *grid = &scratch->grids[rule];
    const size_t from = (scratch->capacity + 1) * GAUSS_NODES_MAX;
    grid_fill_core(grid, w->plan, level, w->ws->roughness, &w->ws->options.layer);
    node_view view = create_view(scratch, grid, from);
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
    evaluate_view(w, &view);
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
    double variance_error, hysteresis_error; /* errors of the rule */
    double closed_error;                     /* error of the hysteresis from the closed form in a
                                                core */
    double share[GAUSS_NODES_MAX];           /* hysteresis of each node */
} pass_part;

/* ---- estimates ------------------------------------------------------------------------------- */

/* Estimated hysteresis of a subinterval on top of the variance so far. */
static double estimate_subinterval_hysteresis(const wt_friction_workspace *ws,
                                              const friction_scratch *scratch, size_t p,
                                              double variance)
{
    const double gamma = ws->options.gamma;
    const double square =
        1 / (1 + M_PI * (variance + 0.5 * scratch->estimated_g[p])); /* approximates P^2 */
    return scratch->estimated_mu[p] * sqrt(square) * (gamma + (1 - gamma) * square);
}

/* Estimated hysteresis of the subintervals outside the cells. */
static double estimate_hysteresis(const wt_friction_workspace *ws, const friction_scratch *scratch,
                                  const subinterval_plan *plan, double variance)
{
    double hysteresis = 0;
    for (size_t p = plan->levels; p < plan->n_subintervals; p++) {
        hysteresis += estimate_subinterval_hysteresis(ws, scratch, p, variance);
        variance += scratch->estimated_g[p];
    }
    return hysteresis;
}

/* ---- core ------------------------------------------------------------------------------------ */

/* Integrates the core. P is 1 in it, or it is so short that dmu/dG is nearly constant: mu =
 * (dmu/dG) int S P dG in closed form. */
static void integrate_core(const wt_friction_workspace *ws, const node_view *core, pass_part *part)
{
    const gauss_rule *rule = core->rule;
    const double *g = core->rise, *mu = core->full;
    double least = (double)INFINITY, most = 0, contact = 1;
    legendre_top top_g, top_mu;
    gauss_rule_top_coefficients(rule, g, mu, &top_g, &top_mu);
    part->variance = weighted_sum(rule, g);
    part->variance_error = gauss_rule_error(rule, &top_g);
    part->closed_error = 0;
    if (part->variance > CONTACT_FULL_VARIANCE) {
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
    part->hysteresis_error = contact * gauss_rule_error(rule, &top_mu);
    for (size_t i = 0; i < rule->n; i++)
        part->share[i] = contact * rule->weight[i] * mu[i];
}

/* Number of levels by which a core is too short. A cell is 1/4 of the next, and G in the core
 * scales alike. The error of the closed form, which is the change of dmu/dG times the integral,
 * scales as 1/16. */
static double missing_levels(const pass_part *part, double allowed)
{
    const double target = 0.5 * CONTACT_FULL_VARIANCE;
    const double full = part->variance > 0 ? 0.5 * log2(target / part->variance) : 0;
    return part->closed_error > 0 && allowed > 0
               ? fmax(full, 0.25 * log2(allowed / part->closed_error))
               : full;
}

/* Finds the largest core at `*level` or deeper in which P is 1 or the closed form has an error of
 * at most `allowed` of the hysteresis; else the deepest core. */
static node_view choose_core(const pass_state *w, double allowed, size_t *level, pass_part *part)
{
    const subinterval_plan *plan = w->plan;
    if (*level > plan->levels)
        *level = plan->levels;
    for (;;) {
        const node_view core = core_view(w, RULE_FIRST, *level);
        integrate_core(w->ws, &core, part);
        const double cells =
            ldexp(part->variance, 2 * (int)*level); /* G up to the first subinterval outside
                                                       the cells */
        const double least =
            allowed > 0 ? allowed * estimate_hysteresis(w->ws, w->scratch, plan, cells) : 0;
        const double shorter = missing_levels(part, least);
        if (*level >= plan->levels || !(shorter < 0))
            return core;
        const double deeper = ceil(-shorter);
        const size_t left = plan->levels - *level;
        *level += deeper < (double)left ? (size_t)fmax(1, deeper) : left;
    }
}

/* ---- subintervals ---------------------------------------------------------------------------- */

/* From this G on, the hysteresis resolves P: 1 - P is a fifth there and no longer small. */
static const double small_gap_variance = 0.3;

/* Error of one subinterval, from the values at full contact and with S P, where G rises from
 * `before` to `after`. Where P begins to fall below 1, the last coefficients do not resolve the
 * difference, which is therefore tested separately. */
static double hysteresis_error(const gauss_rule *rule, const legendre_top *full,
                               const legendre_top *part, double before, double after)
{
    legendre_top gap;
    if (!(before < small_gap_variance))
        return gauss_rule_error(rule, part);
    const double own = gauss_rule_error(rule, full);
    if (!(after > CONTACT_FULL_VARIANCE))
        return own;
    for (size_t k = 0; k < LEGENDRE_TOP; k++)
        gap.coefficient[k] = full->coefficient[k] - part->coefficient[k];
    return own + gauss_rule_error(rule, &gap);
}

/* Integrates a subinterval on top of the variance so far. */
static void integrate_subinterval(const wt_friction_workspace *ws, const node_view *view,
                                  double variance, pass_part *part)
{
    const gauss_rule *rule = view->rule;
    const double gamma = ws->options.gamma, *g = view->rise, *full = view->full;
    double running[GAUSS_NODES_MAX + CONTACT_PADDING], area[GAUSS_NODES_MAX + CONTACT_PADDING],
        mu[GAUSS_NODES_MAX];
    legendre_top top_g, top_full, top_mu;
    for (size_t j = 0; j < rule->n + CONTACT_PADDING; j++)
        running[j] = variance;
    part->variance = gauss_rule_integrate(rule, g, running);
    part->closed_error = 0;
    part->hysteresis = 0;
    bool falls = running[0] < variance;
    for (size_t j = 1; j < rule->n; j++)
        falls |= running[j] < running[j - 1];
    /* G never falls. Where it rises too steeply for a polynomial, the sum of the previous nodes is
     * used. */
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
    gauss_rule_top_coefficients(rule, g, mu, &top_g, &top_mu);
    part->variance_error = gauss_rule_error(rule, &top_g);
    if (variance < small_gap_variance)
        gauss_rule_top_coefficients(rule, full, mu, &top_full, &top_mu);
    part->hysteresis_error =
        hysteresis_error(rule, &top_full, &top_mu, variance, variance + part->variance);
}

/* ---- one pass -------------------------------------------------------------------------------- */

/* Share of J1(w) from frequencies w cos(phi) outside of the measured range, of a loss modulus that
 * is constant over a turn. */
static double outside_share(const wt_material *material, double w)
{
    const double c_low = material->frequency_min / w, c_high = material->frequency_max / w;
    double share = 0;
    if (c_low > 0 && isfinite(c_low))
        share = c_low < 1 ? c_low * c_low / (1 + sqrt((1 - c_low) * (1 + c_low))) : 1;
    if (c_high > 0 && c_high < 1)
        share += sqrt((1 - c_high) * (1 + c_high));
    return fmin(share, 1);
}

/* Part of the hysteresis from extrapolated frequencies. */
static double extrapolated_part(const wt_friction_workspace *ws, const node_view *view,
                                const pass_part *part)
{
    double sum = 0;
    for (size_t j = 0; j < view->rule->n; j++)
        sum += part->share[j] * (ws->layer == NULL ? outside_share(ws->material, view->omega[j])
                                 : view->omega[j] < ws->layer->layer.slope.low ||
                                         view->omega[j] > ws->layer->layer.slope.high
                                     ? 1
                                     : 0);
    return sum;
}

/* Adds a part to the pass: the core (index 0) or a subinterval. */
static void add_pass_part(pass_state *w, const grid_subinterval *subinterval, const node_view *view,
                          const pass_part *part, size_t part_index)
{
    const wt_friction_workspace *ws = w->ws;
    friction_scratch *scratch = w->scratch;
    friction_pass *pass = w->pass;
    const size_t n = view->rule->n;
    const double variance = pass->variance + part->variance;
    if (w->record != NULL)
        node_contributions_add(w->record, view->q, part->share, n);
    if (w->with_outside)
        pass->outside += extrapolated_part(ws, view, part);
    pass->variance_error += part->variance_error;
    friction_add_input_errors(ws, scratch->own_error, subinterval, view->log_omega, view->j1,
                              view->j2, n, w->at.log_lowest, part->variance, part->hysteresis,
                              variance, pass);
    double error = part->hysteresis_error + part->closed_error;
    if (part_index > 0 && variance > 0) /* G may be almost 0, where its quotients are undefined */
        error += FRICTION_AREA_POWER * part->hysteresis * (pass->variance_error / variance);
    scratch->error_g[part_index] += part->variance_error;
    scratch->error_mu[part_index] += error;
    scratch->subinterval_g[part_index] += part->variance;
    scratch->subinterval_mu[part_index] += part->hysteresis;
    pass->variance = variance;
    pass->hysteresis += part->hysteresis;
    pass->hysteresis_error += error;
    pass->nodes += n;
    w->variance_left -= part->variance_error;
    w->hysteresis_left -= part->hysteresis_error + part->closed_error;
}

/* Evaluates the subintervals from `first` up to, but not including, `last` by the first rule. */
static void evaluate_subintervals(const pass_state *w, size_t first, size_t last)
{
    friction_scratch *scratch = w->scratch;
    scale_grid *grid = &scratch->grids[RULE_FIRST];
    const size_t n = grid->rule->n;
    grid_fill_subintervals(grid, w->plan, first, last, w->ws->roughness, &w->ws->options.layer);
    for (size_t p = first; p < last; p++) {
        const node_view view = subinterval_view(scratch, grid, p, p * n);
        fill_view_frequencies(&view, w->at);
    }
    evaluate_nodes(w->ws, scratch, grid->q + first * n, scratch->omega + first * n,
                   (last - first) * n);
    for (size_t p = first; p < last; p++) {
        const node_view view = subinterval_view(scratch, grid, p, p * n);
        soften_moduli(scratch, &view);
        fill_parts(&view, w->scale);
        scratch->estimated_g[p] = weighted_sum(view.rule, view.rise);
        scratch->estimated_mu[p] = weighted_sum(view.rule, view.full);
    }
}

/* Evaluates part of a subinterval by a rule. */
static node_view part_view(const pass_state *w, const grid_subinterval *subinterval, size_t rule)
{
    friction_scratch *scratch = w->scratch;
    scale_grid *grid = &scratch->grids[rule];
    grid_fill_partial_subinterval(grid, w->plan, subinterval, w->ws->roughness,
                                  &w->ws->options.layer);
    const node_view view =
        subinterval_view(scratch, grid, w->plan->capacity, scratch->capacity * GAUSS_NODES_MAX);
    evaluate_view(w, &view);
    return view;
}

/* Largest number of halvings: a function that is not smooth on a thousandth of a subinterval is a
 * jump. */
enum { MAX_HALVINGS = 10 };

/* Starts a pass on top of a core. It estimates the totals by the first rule, and the effect of an
 * error of G from each subinterval on the hysteresis of all later ones. */
static void init_pass(pass_state *w, size_t level, const pass_part *core)
{
    friction_scratch *scratch = w->scratch;
    const size_t first = w->plan->levels - level, last = w->plan->n_subintervals;
    double variance = core->variance, hysteresis = core->hysteresis, sum = 0;
    for (size_t p = first; p < last; p++) {
        const double part = estimate_subinterval_hysteresis(w->ws, scratch, p, variance);
        variance += scratch->estimated_g[p];
        hysteresis += part;
        scratch->variance_effect[p] = variance > 0 ? FRICTION_AREA_POWER * part / variance : 0;
    }
    for (size_t p = last; p > first; p--)
        scratch->variance_effect[p - 1] = sum += scratch->variance_effect[p - 1];
    const double share = FRICTION_RULE_SHARE * w->ws->options.tolerance;
    w->variance_left = share * variance;
    w->hysteresis_left = share * hysteresis;
    w->variance_least = part_share * part_share * w->variance_left;
    w->hysteresis_least = part_share * part_share * w->hysteresis_left;
    *w->pass = (friction_pass){.level = level, .parts = last - first + 1};
    for (size_t part_index = 0; part_index < w->pass->parts; part_index++)
        scratch->error_g[part_index] = scratch->error_mu[part_index] =
            scratch->subinterval_g[part_index] = scratch->subinterval_mu[part_index] = 0;
}

static double core_variance_effect(const pass_state *w)
{
    const size_t first = w->plan->levels - w->pass->level;
    return first < w->plan->n_subintervals ? w->scratch->variance_effect[first] : 0;
}

/* True if a rule is accurate enough for part of a subinterval that was halved `depth` times. */
static bool is_accurate(const pass_state *w, const pass_part *part, double variance_effect,
                        size_t depth)
{
    const double share = ldexp(1, -(int)depth), so_far = w->pass->variance + part->variance;
    const double variance = share * fmax(part_share * w->variance_left, w->variance_least);
    const double hysteresis = share * fmax(part_share * w->hysteresis_left, w->hysteresis_least);
    return part->variance_error <= (w->effort.accurate_everywhere
                                        ? part_share * w->ws->options.tolerance * so_far
                                        : variance) &&
           part->variance_error * variance_effect + part->hysteresis_error <= hysteresis;
}

/* Largest rise of ln G over a subinterval for which the coefficients are a reliable error estimate.
 * P = erf(1/(2 sqrt G)) has its nearest singular points at the distance pi/2 from a real ln G, as a
 * Maxwell element in ln q, and 1 - P is steep near 0. */
static const double max_log_rise[FRICTION_RULES] = {2.5, 3.5};

static bool is_steep(const pass_state *w, const pass_part *part, size_t rule)
{
    const double before = fmax(w->pass->variance, CONTACT_FULL_VARIANCE);
    return log((w->pass->variance + part->variance) / before) > max_log_rise[rule];
}

/* Evaluates a whole subinterval by the rule of the check. */
static node_view check_rule_view(const pass_state *w, size_t p)
{
    friction_scratch *scratch = w->scratch;
    scale_grid *grid = &scratch->grids[RULE_CHECK];
    grid_fill_subintervals(grid, w->plan, p, p + 1, w->ws->roughness, &w->ws->options.layer);
    const node_view view = subinterval_view(scratch, grid, p, scratch->capacity * GAUSS_NODES_MAX);
    evaluate_view(w, &view);
    return view;
}

/* Adds a subinterval or part of one, from its nodes by the first rule, with refinement. */
static void add_refined_subinterval(pass_state *w, const grid_subinterval *subinterval,
                                    node_view view, size_t p, size_t first, size_t depth)
{
    const double variance_effect = w->scratch->variance_effect[p];
    bool halve = depth < w->effort.halves;
    pass_part part;
    if (!halve) {
        integrate_subinterval(w->ws, &view, w->pass->variance, &part);
        if (is_steep(w, &part, RULE_FIRST) || !is_accurate(w, &part, variance_effect, depth)) {
            view = depth == 0 ? check_rule_view(w, p) : part_view(w, subinterval, RULE_CHECK);
            integrate_subinterval(w->ws, &view, w->pass->variance, &part);
            halve = depth < MAX_HALVINGS && (is_steep(w, &part, RULE_CHECK) ||
                                             !is_accurate(w, &part, variance_effect, depth));
        }
    }
    if (!halve) {
        add_pass_part(w, subinterval, &view, &part, p - first + 1);
        return;
    }
    for (int upper = 0; upper < 2; upper++) {
        const grid_subinterval half = grid_half(subinterval, upper);
        add_refined_subinterval(w, &half, part_view(w, &half, RULE_FIRST), p, first, depth + 1);
    }
}

void friction_evaluate(const wt_friction_workspace *ws, friction_scratch *scratch,
                       const subinterval_plan *plan, friction_effort effort, friction_load at,
                       bool with_outside, node_contributions *record, friction_pass *pass)
{
    pass_state w = {.ws = ws,
                    .scratch = scratch,
                    .plan = plan,
                    .effort = effort,
                    .at = at,
                    .scale = compute_pass_scale(ws, at),
                    .with_outside = with_outside,
                    .record = record,
                    .pass = pass};
    const double share = FRICTION_RULE_SHARE * ws->options.tolerance;
    const bool closed = !effort.accurate_everywhere && ws->options.gamma == 1;
    const size_t last = plan->n_subintervals, n = ws->rules[RULE_FIRST]->n;
    size_t level = effort.level;
    pass_part part;
    scratch->own_error = 0;
    evaluate_subintervals(&w, plan->levels, last);
    node_view view = choose_core(&w, closed ? part_share * share : 0, &level, &part);
    evaluate_subintervals(&w, plan->levels - level, plan->levels);
    init_pass(&w, level, &part);
    while (!is_accurate(&w, &part, core_variance_effect(&w), 0)) {
        view = core_view(&w, RULE_CHECK, level);
        integrate_core(ws, &view, &part);
        if (is_accurate(&w, &part, core_variance_effect(&w), 0) || level == plan->levels)
            break;
        level++; /* one more cell corresponds to a halving of a subinterval */
        view = core_view(&w, RULE_FIRST, level);
        integrate_core(ws, &view, &part);
        evaluate_subintervals(&w, plan->levels - level, plan->levels - level + 1);
        init_pass(&w, level, &part);
    }
    const size_t first = plan->levels - level;
    add_pass_part(&w, &plan->core[level], &view, &part, 0);
    for (size_t p = first; p < last; p++)
        add_refined_subinterval(&w, &plan->subintervals[p],
                                subinterval_view(scratch, &scratch->grids[RULE_FIRST], p, p * n), p,
                                first, 0);
}
