/* Subintervals of the wavenumber and their nodes.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/wavenumber_grid.h"

#include "core/base/array.h"
#include "core/math/simd.h"
#include "friction/numerics/persson_contact.h"

#include <math.h>
#include <string.h>

/* Ratio of the cells towards q0: over a factor of 4, the powers in the integrand are smooth for
 * every rule. */
static const double cell_ratio = 4;
/* Largest length of a subinterval right of a knot, relative to its distance from the knot before.
 * In the square root of the distance, the singularity is then 1/8 of the length away. */
static const double grading = 8;
/* Knots closer than this share of a subinterval are merged. The weight of the gap is its length to
 * the power 3/2. */
static const double same_knot = 1e-11;
/* Largest rise of ln(q^4 C |E|^2), the integrand of G, over one subinterval. P falls from 1 where G
 * just begins to rise, and a polynomial that ends 10^12 times higher has no accuracy there. */
static const double max_log_rise = 2.9;
/* Assumed slope of |E|^2 of a closed form with the frequency. The largest slope is 2; the
 * subinterval is halved there. */
static const double closed_slope = 1;
/* Largest slope outside a table: a steeper modulus would overflow within three decades. */
static const double max_outside_slope = 200;

static const double *roughness_breaks(const wt_roughness *roughness, size_t *n)
{
    *n = 0;
    return roughness->law->breaks != NULL ? roughness->law->breaks(roughness, n) : NULL;
}

static double log_wavenumber_ratio(double q, double q0)
{
    return log1p((q - q0) / q0);
}

void material_slopes(const wt_material *material, const double *knots, size_t n_knots,
                     double *slopes)
{
    /* A table is a power law between its knots; a combination of several tables is not. */
    const size_t parts = material->law->power_below ? 1 : 8;
    for (size_t k = 0; k <= n_knots; k++) {
        const double low = k > 0 ? knots[k - 1] : knots[0] / M_E;
        const double high = k < n_knots ? knots[k] : knots[n_knots - 1] * M_E;
        const double step = log(high / low) / (double)parts;
        double before[2] = {0}, steepest = 0;
        for (size_t i = 0; i <= parts; i++) {
            double e[2];
            const double omega = i < parts ? low * exp(step * (double)i) : high;
            material->law->modulus(material, &omega, 1, &e[0], &e[1]);
            for (size_t m = 0; m < 2; m++) {
                if (i > 0 && before[m] > 0 && e[m] > before[m])
                    steepest = fmax(steepest, 2 * log(e[m] / before[m]) / step);
                before[m] = e[m];
            }
        }
        slopes[k] = step * (double)parts > same_knot * SUBINTERVAL_WIDTH ? steepest : 0;
        if (k == 0 || k == n_knots)
            slopes[k] = fmin(slopes[k], max_outside_slope);
    }
}

/* Slopes of ln(q^4 C) between the breaks of the spectrum. Returns the total rise. */
static double spectrum_slopes(const wt_roughness *roughness, double *powers)
{
    size_t n = 0;
    const double *breaks = roughness_breaks(roughness, &n);
    double from = roughness->q0, before, sum = 0;
    roughness->law->density(roughness, &from, 1, &before);
    for (size_t k = 0; k <= n; k++) {
        const double to = k < n ? breaks[k] : roughness->q1,
                     length = log_wavenumber_ratio(to, from);
        double density;
        roughness->law->density(roughness, &to, 1, &density);
        const double rise = 4 * length + log(density / before);
        const bool counts = length > same_knot * SUBINTERVAL_WIDTH && isfinite(rise);
        if (powers != NULL)
            powers[k] = counts ? rise / length : 0;
        sum += counts ? fmax(0, rise) : 0;
        from = to;
        before = density;
    }
    return sum;
}

/* Number of additional subintervals due to the slopes. */
static size_t max_steep_subintervals(const double *knots, const double *slopes, size_t n,
                                     double length)
{
    double most = n > 0 ? length * fmax(slopes[0], slopes[n]) / max_log_rise : 0;
    for (size_t k = 1; k < n; k++)
        most += log(knots[k] / knots[k - 1]) * slopes[k] / max_log_rise;
    return (size_t)most;
}

/* Number of additional subintervals due to the knots, graded away from the previous knot. */
static size_t max_graded_subintervals(const double *knots, size_t n)
{
    size_t most = 0;
    for (size_t k = 1; k < n; k++) {
        const double gap = fmax(log(knots[k] / knots[k - 1]), same_knot * SUBINTERVAL_WIDTH);
        const double next = k + 1 < n ? log(knots[k + 1] / knots[k]) : SUBINTERVAL_WIDTH;
        const double steps = log(fmin(next, SUBINTERVAL_WIDTH) / gap) / log(grading);
        most += steps > 0 ? 1 + (size_t)steps : 0;
    }
    return most;
}

void subinterval_plan_init(subinterval_plan *plan, const wt_roughness *roughness, double width,
                           size_t levels, const double *knots, const double *slopes, size_t n_knots,
                           size_t n_cuts, const strain_law *softening, arena *memory)
{
    size_t n_roughness = 0;
    (void)roughness_breaks(roughness, &n_roughness);
    const double length = log_wavenumber_ratio(roughness->q1, roughness->q0);
    *plan = (subinterval_plan){.q0 = roughness->q0,
                               .q1 = roughness->q1,
                               .softening = softening,
                               .width = width,
                               .slopes = slopes,
                               .levels = levels};
    /* from the smallest t to the width of a subinterval there are 27 steps of the cell ratio */
    plan->capacity =
        levels + n_roughness + n_knots + max_graded_subintervals(knots, n_knots) +
        max_steep_subintervals(knots, slopes, n_knots, length) + n_cuts + 32 +
        (size_t)((spectrum_slopes(roughness, NULL) + closed_slope * length) / max_log_rise) +
        (softening != NULL ? softening->n_cuts : 0) + (size_t)(length / SUBINTERVAL_WIDTH);
    plan->core = arena_alloc(memory, levels + 1, sizeof *plan->core);
    plan->subintervals = arena_alloc(memory, plan->capacity, sizeof *plan->subintervals);
    plan->powers = arena_numbers(memory, n_roughness + 1);
    (void)spectrum_slopes(roughness, plan->powers);
}

/* Returns the number of knots at or below t. */
static size_t count_knots_below(const double *knots, size_t n, double t)
{
    const double slack = 1e-12;
    size_t low = 0, high = n;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (knots[middle] <= t + slack)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Creates a subinterval from t_low to t_high, or shorter where the square root of one knot does not
 * smooth the knot before. It uses a square-root map right of a close knot, and a logarithmic map
 * near t = 0, where G is 0. */
static grid_subinterval create_subinterval(double t_low, double t_high, const double *knots,
                                           size_t n_knots)
{
    grid_subinterval subinterval = {.t_low = t_low, .t_high = t_high, .map = MAP_LINEAR};
    if (t_low > 0 && t_high > 2 * t_low)
        subinterval.map = MAP_LOGARITHM;
    size_t before = count_knots_below(knots, n_knots, t_low);
    if (before > 0 && knots[before - 1] > t_low - SUBINTERVAL_WIDTH) {
        subinterval.map = MAP_SQUARE_ROOT;
        subinterval.anchor = fmin(knots[before - 1], t_low);
        do
            before--;
        while (before > 0 && t_low - knots[before - 1] < same_knot * SUBINTERVAL_WIDTH);
        if (before > 0)
            subinterval.t_high = fmin(t_high, t_low + grading * (t_low - knots[before - 1]));
    }
    return subinterval;
}

void subinterval_plan_fill(subinterval_plan *plan, const wt_roughness *roughness,
                           const double *cuts, size_t n_cuts, const double *knots, size_t n_knots,
                           double *bounds)
{
    const double length = log_wavenumber_ratio(plan->q1, plan->q0);
    const double least = 1e-13 * fmax(1, length); /* cuts closer than rounding are merged */
    size_t n_roughness = 0;
    const double *breaks = roughness_breaks(roughness, &n_roughness);
    size_t n = 0;
    bounds[n++] = 0;
    for (size_t i = 0; i < n_roughness; i++)
        bounds[n++] = log_wavenumber_ratio(breaks[i], plan->q0);
    for (size_t i = 0; i < n_cuts; i++)
        if (cuts[i] > 0 && cuts[i] < length)
            bounds[n++] = cuts[i];
    for (size_t i = 0; plan->softening != NULL && i < plan->softening->n_cuts; i++)
        if (plan->softening->cuts[i] > least && plan->softening->cuts[i] < length - least)
            bounds[n++] = plan->softening->cuts[i];
    for (size_t i = 0; i < n_knots; i++)
        if (knots[i] > least && knots[i] < length - least)
            bounds[n++] = knots[i];
    bounds[n++] = length;
    numbers_sort(bounds, n);

    plan->n_subintervals = plan->levels;
    double from = 0;
    for (size_t i = 1, k = 0; i < n; i++) {
        const double width = bounds[i] - from;
        /* A knot equal to a break up to rounding is skipped; the last limit is always used. */
        if (!(width > 0) || (i + 1 < n && n_knots && width < least))
            continue;
        double low = from;
        const double inside = 0.5 * (from + bounds[i]);
        while (k < n_roughness && log_wavenumber_ratio(breaks[k], plan->q0) <= inside)
            k++;
        while (low < bounds[i]) {
            double high = bounds[i];
            if (low > 0 && high > cell_ratio * low)
                high = cell_ratio * low;
            const double usual = low > 0 ? plan->width : SUBINTERVAL_WIDTH;
            const double middle = 0.5 * (low + bounds[i]);
            const double slope =
                fmax(0, plan->powers[k]) +
                (n_knots > 0 ? plan->slopes[count_knots_below(knots, n_knots, middle)]
                             : closed_slope);
            const double widest = slope * usual > max_log_rise ? max_log_rise / slope : usual;
            const double pieces = 1 + floor((bounds[i] - low) / widest);
            if (pieces > 1)
                high = fmin(high, low + (bounds[i] - low) / pieces);
            plan->subintervals[plan->n_subintervals] =
                create_subinterval(low, high, knots, n_knots);
            plan->subintervals[plan->n_subintervals].power = plan->powers[k];
            low = plan->subintervals[plan->n_subintervals++].t_high;
        }
        from = bounds[i];
    }

    /* The first subinterval becomes cells and cores. */
    const grid_subinterval first = plan->subintervals[plan->levels];
    plan->n_subintervals--;
    memmove(plan->subintervals + plan->levels, plan->subintervals + plan->levels + 1,
            (plan->n_subintervals - plan->levels) * sizeof *plan->subintervals);
    double high = first.t_high;
    for (size_t level = 0; level <= plan->levels; level++) {
        plan->core[level] = first;
        plan->core[level].t_high = high;
        if (level < plan->levels)
            plan->subintervals[plan->levels - 1 - level] =
                (grid_subinterval){.t_low = high / cell_ratio,
                                   .t_high = high,
                                   .power = first.power,
                                   .map = MAP_LOGARITHM};
        high /= cell_ratio;
    }
}

grid_subinterval grid_half(const grid_subinterval *subinterval, bool upper)
{
    grid_subinterval half = *subinterval;
    double middle = 0.5 * (subinterval->t_low + subinterval->t_high);
    if (subinterval->map == MAP_LOGARITHM) {
        middle = sqrt(subinterval->t_low * subinterval->t_high);
    } else if (subinterval->map == MAP_SQUARE_ROOT) {
        const double low = sqrt(subinterval->t_low - subinterval->anchor);
        const double step = 0.5 * (subinterval->t_high - subinterval->t_low) /
                            (low + sqrt(subinterval->t_high - subinterval->anchor));
        middle = subinterval->t_low + step * (2 * low + step);
    }
    *(upper ? &half.t_low : &half.t_high) = middle;
    return half;
}

/* ---- nodes ----------------------------------------------------------------------------------- */

void grid_init(scale_grid *grid, const subinterval_plan *plan, const gauss_rule *rule,
               arena *memory)
{
    const size_t nodes = (plan->capacity + 1) * rule->n;
    const size_t core_nodes = (plan->levels + 1) * rule->n;
    *grid = (scale_grid){
        .rule = rule,
        .t = arena_alloc(memory, nodes, sizeof *grid->t),
        .q = arena_alloc(memory, nodes, sizeof *grid->q),
        .factor1 = arena_alloc(memory, nodes, sizeof *grid->factor1),
        .factor2 = arena_alloc(memory, nodes, sizeof *grid->factor2),
        .half_width = arena_alloc(memory, plan->capacity + 1, sizeof *grid->half_width),
        .core_t = arena_alloc(memory, core_nodes, sizeof *grid->core_t),
        .core_q = arena_alloc(memory, core_nodes, sizeof *grid->core_q),
        .core_factor1 = arena_alloc(memory, core_nodes, sizeof *grid->core_factor1),
        .core_factor2 = arena_alloc(memory, core_nodes, sizeof *grid->core_factor2),
        .core_half_width = arena_alloc(memory, plan->levels + 1, sizeof *grid->core_half_width)};
    if (plan->softening == NULL)
        return;
    grid->f = arena_alloc(memory, nodes, sizeof *grid->f);
    grid->g = arena_alloc(memory, nodes, sizeof *grid->g);
    grid->core_f = arena_alloc(memory, core_nodes, sizeof *grid->core_f);
    grid->core_g = arena_alloc(memory, core_nodes, sizeof *grid->core_g);
}

/* Computes t, q and dt/ds (into factor1) on one subinterval; returns the half width in s. */
static double fill_grid_nodes(const subinterval_plan *plan, const grid_subinterval *subinterval,
                              const gauss_rule *rule, double *t, double *q, double *slope)
{
    const double width = subinterval->t_high - subinterval->t_low;
    double s_low = 0, half = 0.5 * width;
    if (subinterval->map == MAP_LOGARITHM) {
        s_low = log(subinterval->t_low);
        half = 0.5 * (log(subinterval->t_high) - s_low);
    } else if (subinterval->map == MAP_SQUARE_ROOT) {
        s_low = sqrt(subinterval->t_low - subinterval->anchor);
        half = 0.5 * width / (s_low + sqrt(subinterval->t_high - subinterval->anchor));
    }
    double less_one[GAUSS_NODES_MAX];
    for (size_t i = 0; i < rule->n; i++) {
        /* from the lower limit: a range may be far shorter than its distance from the anchor */
        const double step = half * (1 + rule->node[i]);
        t[i] = subinterval->t_low + step;
        slope[i] = 1;
        if (subinterval->map == MAP_LOGARITHM) {
            t[i] = exp(s_low + step);
            slope[i] = t[i];
        } else if (subinterval->map == MAP_SQUARE_ROOT) {
            t[i] = subinterval->t_low + step * (2 * s_low + step);
            slope[i] = 2 * (s_low + step);
        }
    }
    vector_expm1(t, rule->n, less_one);
    for (size_t i = 0; i < rule->n; i++) {
        /* preserves the digits of a range as short as q1/q0 - 1 = 1e-4 */
        const double there = plan->q0 + plan->q0 * less_one[i];
        const double clamped = there < plan->q1 ? there : plan->q1;
        q[i] = clamped > plan->q0 ? clamped : plan->q0;
    }
    return half;
}

static double quartic(double q)
{
    return q * q * (q * q);
}

/* q^4 C at the nodes as a power law from the first to the last node: exponentials of a vector take
 * a fifth of the time of powers. False if the power is not finite, because a density may be 0. */
static bool weigh_power(const wt_roughness *roughness, size_t n, const double *t, const double *q,
                        double *weighed)
{
    const double ends[2] = {q[0], q[n - 1]};
    double density[2], rise[GAUSS_NODES_MAX];
    roughness->law->density(roughness, ends, 2, density);
    const double first = density[0] * quartic(ends[0]), last = density[1] * quartic(ends[1]);
    const double power = log(last / first) / (t[n - 1] - t[0]);
    if (!isfinite(power))
        return false;
    for (size_t i = 0; i < n; i++)
        rise[i] = power * (t[i] - t[0]);
    vector_exp(rise, n, weighed);
    for (size_t i = 0; i < n; i++)
        weighed[i] *= first;
    return true;
}

static void weigh_density(const wt_roughness *roughness, size_t n, const double *t, const double *q,
                          double *weighed)
{
    if (roughness->law->powers && weigh_power(roughness, n, t, q, weighed))
        return;
    roughness->law->density(roughness, q, n, weighed);
    for (size_t i = 0; i < n; i++)
        weighed[i] *= quartic(q[i]);
}

static void weigh_nodes(const wt_roughness *roughness, const wt_layer_state *layer, size_t n,
                        const double *t, const double *q, double *factor1, double *factor2)
{
    weigh_density(roughness, n, t, q, factor2);
    for (size_t i = 0; i < n; i++) {
        const double base = factor2[i] * factor1[i];
        const double scale = layered_scale(q[i] * layer->thickness, layer->modulus_ratio);
        factor1[i] = base * scale;
        factor2[i] = base * scale * scale;
    }
}

void grid_reset(scale_grid *grid, const subinterval_plan *plan)
{
    memset(grid->half_width, 0, plan->n_subintervals * sizeof *grid->half_width);
    memset(grid->core_half_width, 0, (plan->levels + 1) * sizeof *grid->core_half_width);
}

static void fill_subinterval_nodes(scale_grid *grid, const subinterval_plan *plan,
                                   const grid_subinterval *subinterval, size_t p,
                                   const wt_roughness *roughness, const wt_layer_state *layer)
{
    const size_t n = grid->rule->n, at = p * n;
    grid->half_width[p] = fill_grid_nodes(plan, subinterval, grid->rule, grid->t + at, grid->q + at,
                                          grid->factor1 + at);
    weigh_nodes(roughness, layer, n, grid->t + at, grid->q + at, grid->factor1 + at,
                grid->factor2 + at);
    if (plan->softening != NULL)
        softening_factors(plan->softening, grid->q + at, grid->t + at, n, grid->f + at,
                          grid->g + at);
}

void grid_fill_subintervals(scale_grid *grid, const subinterval_plan *plan, size_t first,
                            size_t last, const wt_roughness *roughness, const wt_layer_state *layer)
{
    for (size_t p = first; p < last; p++)
        if (!(grid->half_width[p] > 0))
            fill_subinterval_nodes(grid, plan, &plan->subintervals[p], p, roughness, layer);
}

void grid_fill_partial_subinterval(scale_grid *grid, const subinterval_plan *plan,
                                   const grid_subinterval *part, const wt_roughness *roughness,
                                   const wt_layer_state *layer)
{
    fill_subinterval_nodes(grid, plan, part, plan->capacity, roughness, layer);
}

void grid_fill_core(scale_grid *grid, const subinterval_plan *plan, size_t level,
                    const wt_roughness *roughness, const wt_layer_state *layer)
{
    const size_t n = grid->rule->n, at = level * n;
    if (grid->core_half_width[level] > 0)
        return;
    grid->core_half_width[level] =
        fill_grid_nodes(plan, &plan->core[level], grid->rule, grid->core_t + at, grid->core_q + at,
                        grid->core_factor1 + at);
    weigh_nodes(roughness, layer, n, grid->core_t + at, grid->core_q + at, grid->core_factor1 + at,
                grid->core_factor2 + at);
    if (plan->softening != NULL)
        softening_factors(plan->softening, grid->core_q + at, grid->core_t + at, n,
                          grid->core_f + at, grid->core_g + at);
}
