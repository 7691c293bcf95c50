/* Search for the contact point: the cost as a function of the contact point alone.
 *
 * For a given contact point the modulus, the offset and the tilt are linear and are projected out.
 * The cost has several minima on real curves, so it is scanned first: on averaged samples, over
 * contact points whose depths below the deepest point form a geometric series, because a length
 * that does not scale with the indentation of the curve itself has no meaning. The lowest minima
 * are then refined on all samples (Brent).
 *
 * In the scan the tilt is not yet taken out of the deflection (that makes the tip position depend
 * on it); the refinement does that.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "data/force_curve.h"
#include "fit/curve.h"

#include <gsl/gsl_errno.h>
#include <math.h>

/* Depths per e-fold and how far before the first sample a contact point is looked for. */
static const double depth_ratio = 1.04;
static const double reach_before_start = 4.0;
static const double least_rise = 1.001; /* of the cost between two minima */
enum { MAX_DEPTHS = 400, MAX_ITERATIONS = 40 };

typedef struct projection {
    const wt_contact_table *table;
    size_t n;
    const double *position, *force, *tip, *running_max;
    const double *weight; /* NULL: 1 */
    double *delta, *g;
    double s_w;
    double origin_position, origin_force; /* means */
    double s_zz, s_zf, s_ff;              /* centred sums */
    bool tilt;
} projection;

typedef struct projected {
    double modulus, offset, tilt; /* offset at the origin of the position */
    double cost;
} projected;

static double weight_of(const projection *p, size_t i)
{
    return p->weight != NULL ? p->weight[i] : 1.0;
}

static void projection_sums(projection *p)
{
    double z = 0.0, f = 0.0;
    p->s_w = 0.0;
    for (size_t i = 0; i < p->n; i++) {
        double w = weight_of(p, i);
        p->s_w += w;
        z += w * p->position[i];
        f += w * p->force[i];
    }
    p->origin_position = z / p->s_w;
    p->origin_force = f / p->s_w;
    p->s_zz = p->s_zf = p->s_ff = 0.0;
    for (size_t i = 0; i < p->n; i++) {
        double w = weight_of(p, i);
        z = p->position[i] - p->origin_position;
        f = p->force[i] - p->origin_force;
        p->s_zz += w * z * z;
        p->s_zf += w * z * f;
        p->s_ff += w * f * f;
    }
}

static void tip_positions(size_t n, const double *position, const double *force, double k,
                          double *tip, double *running_max)
{
    double max = -(double)INFINITY;
    for (size_t i = 0; i < n; i++) {
        tip[i] = tip_position(position[i], force[i], k);
        if (tip[i] > max)
            max = tip[i];
        running_max[i] = max;
    }
}

/* First sample whose tip may be beyond `contact`. */
static size_t first_beyond(const double *running_max, size_t n, double contact)
{
    size_t lo = 0, hi = n;
    while (lo < hi) {
        size_t middle = lo + (hi - lo) / 2;
        if (running_max[middle] > contact)
            hi = middle;
        else
            lo = middle + 1;
    }
    return lo;
}

static double cost_without_contact(const projection *p)
{
    return p->tilt && p->s_zz > 0.0 ? p->s_ff - p->s_zf * p->s_zf / p->s_zz : p->s_ff;
}

static projected project(const projection *p, double contact)
{
    size_t first = first_beyond(p->running_max, p->n, contact);
    size_t m = p->n - first;
    double *delta = p->delta + first, *g = p->g + first;
    for (size_t i = 0; i < m; i++)
        delta[i] = p->tip[first + i] - contact;
    wt_contact_table_eval(p->table, delta, m, g, NULL);
    double sg = 0.0, sgg = 0.0, sgf = 0.0, sgz = 0.0;
    for (size_t i = 0; i < m; i++) {
        double wg = weight_of(p, first + i) * g[i];
        sg += wg;
        sgg += wg * g[i];
        sgf += wg * (p->force[first + i] - p->origin_force);
        sgz += wg * (p->position[first + i] - p->origin_position);
    }
    double free_gg = sgg - sg * sg / p->s_w, free_gf = sgf;
    if (p->tilt) {
        free_gg -= sgz * sgz / p->s_zz;
        free_gf -= sgz * p->s_zf / p->s_zz;
    }
    projected result = {0.0, p->origin_force, p->tilt ? p->s_zf / p->s_zz : 0.0,
                        cost_without_contact(p)};
    /* Where the contact part looks like a straight line nothing is left to decide. */
    if (free_gf > 0.0 && free_gg > 1e-12 * sgg) {
        result.modulus = free_gf / free_gg;
        result.cost = fmax(0.0, result.cost - free_gf * result.modulus);
        result.offset -= result.modulus * sg / p->s_w;
        if (p->tilt)
            result.tilt -= result.modulus * sgz / p->s_zz;
    }
    return result;
}

static double project_cost(double contact, void *projection_)
{
    return project(projection_, contact).cost;
}

/* From the tip position at contact to the position at which the lever is straight there. */
static curve_minimum to_minimum(const projection *p, double contact, double k)
{
    projected at = project(p, contact);
    double offset0 = at.offset - at.tilt * p->origin_position; /* at position 0 */
    double position = (contact + offset0 / k) / (1.0 - at.tilt / k);
    return (curve_minimum){position, at.modulus, offset0 + at.tilt * position, at.tilt, at.cost};
}

/* Averages neighbours so that no more than CURVE_MAX_BINS are left; a rest at the start, far
 * from contact, is left out. */
static projection make_bins(const projection *full, double k, wt_indent_workspace *w)
{
    size_t width = (full->n + CURVE_MAX_BINS - 1) / CURVE_MAX_BINS;
    size_t n = full->n / width, skip = full->n - n * width;
    for (size_t bin = 0; bin < n; bin++) {
        double z = 0.0, f = 0.0, weight = 0.0;
        for (size_t i = skip + bin * width; i < skip + (bin + 1) * width; i++) {
            z += full->position[i];
            f += full->force[i];
            weight += weight_of(full, i);
        }
        w->bin_weight[bin] = weight;
        w->bin_position[bin] = z / (double)width;
        w->bin_force[bin] = f / (double)width;
    }
    projection bins = *full;
    bins.n = n;
    bins.position = w->bin_position;
    bins.force = w->bin_force;
    bins.weight = w->bin_weight;
    bins.tip = w->bin_tip;
    bins.running_max = w->bin_running_max;
    bins.delta = w->bin_delta;
    bins.g = w->bin_g;
    tip_positions(n, w->bin_position, w->bin_force, k, w->bin_tip, w->bin_running_max);
    projection_sums(&bins);
    return bins;
}

static projection make_full(const wt_contact_table *table, const curve_samples *samples, bool tilt,
                            bool weighted, wt_indent_workspace *w)
{
    projection full = {.table = table,
                       .n = samples->n,
                       .position = samples->position,
                       .force = samples->force,
                       .weight = weighted ? w->weight : NULL,
                       .tip = w->tip,
                       .running_max = w->running_max,
                       .delta = w->delta,
                       .g = w->g,
                       .tilt = tilt};
    tip_positions(samples->n, samples->position, samples->force, samples->spring_constant, w->tip,
                  w->running_max);
    projection_sums(&full);
    return full;
}

static double brent(projection *bins, double lo, double middle, double hi,
                    gsl_min_fminimizer *minimizer)
{
    gsl_function function = {project_cost, bins};
    if (gsl_min_fminimizer_set(minimizer, &function, middle, lo, hi) != GSL_SUCCESS)
        return middle; /* flat to rounding */
    for (int i = 0; i < MAX_ITERATIONS; i++) {
        if (gsl_min_fminimizer_iterate(minimizer) != GSL_SUCCESS)
            break;
        double a = gsl_min_fminimizer_x_lower(minimizer), b = gsl_min_fminimizer_x_upper(minimizer);
        if (b - a < 1e-4 * (hi - lo))
            break;
    }
    return gsl_min_fminimizer_x_minimum(minimizer);
}

/* Indices of the minima of the scan, lowest first, no more than CURVE_MAX_MINIMA. One that no
 * rise parts from a lower one is only a ripple. A minimum at the far end counts: contact before the
 * start.
 */
static size_t find_bottoms(const double *cost, size_t n, double nothing, size_t *bottom)
{
    size_t m = 0;
    double highest_since = 0.0;
    for (size_t i = 0; i < n; i++) {
        highest_since = fmax(highest_since, cost[i]);
        bool falls = i == 0 || cost[i] < cost[i - 1];
        bool rises = i + 1 == n || cost[i] <= cost[i + 1];
        if (!falls || !rises || !(cost[i] < nothing))
            continue;
        if (m > 0 && highest_since <= least_rise * fmax(cost[bottom[m - 1]], cost[i])) {
            if (cost[i] >= cost[bottom[m - 1]])
                continue;
            m--;
        }
        bottom[m++] = i;
        highest_since = cost[i];
    }
    for (size_t i = 1; i < m; i++) { /* by insertion: they are few */
        size_t index = bottom[i], j = i;
        for (; j > 0 && cost[bottom[j - 1]] > cost[index]; j--)
            bottom[j] = bottom[j - 1];
        bottom[j] = index;
    }
    return m < CURVE_MAX_MINIMA ? m : CURVE_MAX_MINIMA;
}

static void keep_best(curve_minimum *minima, size_t *n, curve_minimum candidate)
{
    size_t at = *n;
    while (at > 0 && minima[at - 1].cost > candidate.cost)
        at--;
    if (at == CURVE_MAX_MINIMA)
        return;
    if (*n < CURVE_MAX_MINIMA)
        ++*n;
    for (size_t i = *n - 1; i > at; i--)
        minima[i] = minima[i - 1];
    minima[at] = candidate;
}

size_t curve_scan(const wt_contact_table *table, const curve_samples *samples, bool tilt,
                  bool weighted, wt_indent_workspace *w, curve_minimum minima[CURVE_MAX_MINIMA])
{
    const double k = samples->spring_constant;
    projection full = make_full(table, samples, tilt, weighted, w);
    projection bins = make_bins(&full, k, w);

    const double deepest = bins.running_max[bins.n - 1];
    const double reach = deepest - bins.tip[0];
    if (!(reach > 0.0))
        return 0;
    double shallowest = deepest - bins.running_max[bins.n - 4];
    shallowest = fmax(shallowest, 1e-5 * reach);

    double contact[MAX_DEPTHS], cost[MAX_DEPTHS];
    size_t n_depths = 0;
    for (double depth = reach * reach_before_start; depth >= shallowest && n_depths < MAX_DEPTHS;
         depth /= depth_ratio) {
        contact[n_depths] = deepest - depth;
        cost[n_depths] = project_cost(contact[n_depths], &bins);
        n_depths++;
    }

    size_t bottom[MAX_DEPTHS];
    size_t n_bottoms = find_bottoms(cost, n_depths, cost_without_contact(&bins), bottom);
    size_t n = 0;
    for (size_t i = 0; i < n_bottoms; i++) {
        size_t j = bottom[i];
        double at = contact[j];
        if (j > 0 && j + 1 < n_depths)
            at = brent(&bins, contact[j - 1], at, contact[j + 1], w->minimizer);
        curve_minimum minimum = to_minimum(&full, at, k);
        if (minimum.reduced_modulus > 0.0)
            keep_best(minima, &n, minimum);
    }
    return n;
}

bool curve_scan_at(const wt_contact_table *table, const curve_samples *samples, bool tilt,
                   double contact_point, wt_indent_workspace *w, curve_minimum *minimum)
{
    const double k = samples->spring_constant;
    projection full = make_full(table, samples, tilt, false, w);
    /* The tip position of the contact depends on the baseline, which is part of the answer. */
    double tip = tip_position(contact_point, full.origin_force, k);
    for (int i = 0; i < MAX_ITERATIONS; i++) {
        *minimum = to_minimum(&full, tip, k);
        double step = contact_point - minimum->contact_point;
        tip += step;
        if (fabs(step) <= 1e-12 * fabs(full.running_max[full.n - 1] - full.tip[0]))
            break;
    }
    minimum->contact_point = contact_point;
    return minimum->reduced_modulus > 0.0;
}
