/* Search for the contact point: the cost as a function of the contact point alone.
 *
 * For a given contact point the modulus, the offset and the tilt are linear parameters and are
 * eliminated. The cost has several minima on real curves. A scan therefore covers contact points
 * whose depths below the deepest point form octaves, because the relevant length scales with the
 * indentation of the curve. The lowest minima are then refined (Brent).
 *
 * Each octave has a uniform grid of tip positions from its depth to the deepest point. Each sample
 * is distributed to its two neighbouring nodes. A sum over nodes is then the sum over all samples
 * with a contact function that is linear between nodes. The contact points are nodes too, so one
 * table of the contact function serves them all.
 *
 * The scan does not remove the tilt from the deflection, which would make the tip position depend
 * on it. The refinement does.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/data/force_curve.h"
#include "core/math/simd.h"
#include "indentation/numerics/curve_model.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

/* Smallest depth of a contact point over the whole depth, 2^-SCAN_OCTAVES. */
static const double least_depth = 1e-5;
/* Smallest rise of the cost between two minima. It is 1.6 standard deviations for 2,500 samples. */
static const double min_rise = 1.001;
/* Tolerance of a minimum over the distance of the scan points, for starts of the least squares. */
static const double tolerance = 1e-3;
/* Largest 1 + S/k without weights. Weights from 0.7 to 1 hardly move a minimum, and the least
 * squares correct it. */
static const double min_weight_ratio = 1.2;
enum {
    NODES = SCAN_NODES,
    HALF = NODES / 2,
    REACH = SCAN_EXTENT, /* range of contact points before the start, in whole depths */
    PER_OCTAVE = 16,     /* contact points per octave; a power of 2, as for the nodes */
    COARSE = 4,          /* distance of contact points in a scan for weights alone */
    MAX_DEPTHS = (SCAN_OCTAVES + REACH) * PER_OCTAVE,
    MAX_ITERATIONS = 40, /* of Brent; golden sections alone reach 4e-9 */
    SKIPPED_SAMPLES = 4, /* per 1024 samples; the deepest ones, for spikes and end effects */
    STRIDE = NODES + 2,  /* offset between octaves */
};

/* Samples with the sums that do not depend on the contact point. */
typedef struct projection {
    const wt_contact_table *table;
    const curve_samples *samples;
    wt_indent_workspace *workspace;
    bool tilt;
    double s_w, inverse_w, inverse_zz;
    double origin_position, origin_force; /* means */
    double s_zz, s_zf, s_ff;              /* centred sums */
    double deepest, top; /* deepest tip position, and distance to the farthest sample */
    size_t n_octaves;
    size_t octave; /* octave for Brent */
} projection;

/* Weighted sums of the contact function. */
typedef struct contact_sums {
    double g, gg, gf, gz;
} contact_sums;

typedef struct projected_fit {
    double modulus, offset, tilt; /* offset at the origin of the position */
    double cost;
} projected_fit;

WIDE_REGISTERS static void find_tip_positions(projection *p)
{
    const curve_samples *s = p->samples;
    const double k = s->spring_constant;
    double *tip = p->workspace->tip;
    for (size_t i = 0; i < s->n; i++)
        tip[i] = tip_position(s->position[i], s->force[i], k);
    const curve_span all = curve_find_span(tip, s->n);
    p->deepest = all.high;
    p->top = all.high - all.low;
}

/* Computes the weighted sums of all samples. Without `weighted` the weights are 1. */
WIDE_REGISTERS static void sum_weighted_samples(projection *p, bool weighted)
{
    const curve_samples *s = p->samples;
    double *const weight = p->workspace->weight;
    wide w = {0.0}, z = w, f = w, zz = w, zf = w, ff = w;
    for (size_t i = 0; i < s->n && !weighted; i++)
        weight[i] = 1.0;
    for (size_t i = 0; i < s->n; i += WIDE) {
        wide weights = {0.0}, position = {0.0}, force = {0.0};
        if (i + WIDE <= s->n) {
            simd_load(&weights, weight + i);
            simd_load(&position, s->position + i);
            simd_load(&force, s->force + i);
        }
        for (size_t j = i; j < s->n && i + WIDE > s->n; j++) {
            weights[j - i] = weight[j];
            position[j - i] = s->position[j];
            force[j - i] = s->force[j];
        }
        const wide wz = weights * position, wf = weights * force;
        w += weights;
        z += wz;
        f += wf;
        zz += wz * position;
        zf += wz * force;
        ff += wf * force;
    }
    p->s_w = simd_sum(&w);
    p->inverse_w = 1.0 / p->s_w;
    p->origin_position = simd_sum(&z) / p->s_w;
    p->origin_force = simd_sum(&f) / p->s_w;
    p->s_zz = simd_sum(&zz) - simd_sum(&z) * p->origin_position;
    p->s_zf = simd_sum(&zf) - simd_sum(&z) * p->origin_force;
    p->s_ff = simd_sum(&ff) - simd_sum(&f) * p->origin_force;
    p->inverse_zz = 1.0 / p->s_zz;
}

static projection begin_projection(const wt_contact_table *table, const curve_samples *samples,
                                   bool tilt, wt_indent_workspace *w)
{
    projection p = {.table = table, .samples = samples, .workspace = w, .tilt = tilt};
    find_tip_positions(&p);
    sum_weighted_samples(&p, false);
    return p;
}

static double cost_without_contact(const projection *p)
{
    return p->tilt && p->s_zz > 0.0 ? p->s_ff - p->s_zf * p->s_zf * p->inverse_zz : p->s_ff;
}

static projected_fit solve_projection(const projection *p, contact_sums s)
{
    const double along = p->tilt ? s.gz * p->inverse_zz : 0.0;
    const double free_gg = s.gg - s.g * s.g * p->inverse_w - s.gz * along,
                 free_gf = s.gf - p->s_zf * along;
    projected_fit result = {0.0, p->origin_force, p->tilt ? p->s_zf * p->inverse_zz : 0.0,
                            cost_without_contact(p)};
    /* No modulus is determined if the contact part is a straight line. */
    if (free_gf > 0.0 && free_gg > 1e-12 * s.gg) {
        result.modulus = free_gf / free_gg;
        const double cost = result.cost - free_gf * result.modulus;
        result.cost = cost > 0.0 ? cost : 0.0;
        result.offset -= result.modulus * s.g * p->inverse_w;
        result.tilt -= result.modulus * along;
    }
    return result;
}

/* Converts a contact at a tip position, with all samples, to the position of contact with the
 * undeflected cantilever. */
WIDE_REGISTERS static curve_minimum convert_minimum(const projection *p, double contact)
{
    wt_indent_workspace *w = p->workspace;
    const double *position = p->samples->position, *force = p->samples->force;
    const double k = p->samples->spring_constant;
    size_t first = 0;
    while (first < p->samples->n && !(w->tip[first] > contact))
        first++;
    for (size_t i = first; i < p->samples->n; i++)
        w->delta[i] = w->tip[i] - contact;
    wt_contact_table_eval(p->table, w->delta + first, p->samples->n - first, w->g + first, NULL);
    wide g = {0.0}, gg = g, gf = g, gz = g;
    for (size_t i = first; i < p->samples->n; i += WIDE) {
        wide weight = {0.0}, value = {0.0}, f = {0.0}, z = {0.0};
        if (i + WIDE <= p->samples->n) {
            simd_load(&weight, w->weight + i);
            simd_load(&value, w->g + i);
            simd_load(&f, force + i);
            simd_load(&z, position + i);
        }
        for (size_t j = i; j < p->samples->n && i + WIDE > p->samples->n; j++) {
            weight[j - i] = w->weight[j];
            value[j - i] = w->g[j];
            f[j - i] = force[j];
            z[j - i] = position[j];
        }
        const wide weighted = weight * value;
        g += weighted;
        gg += weighted * value;
        gf += weighted * (f - p->origin_force);
        gz += weighted * (z - p->origin_position);
    }
    const projected_fit at = solve_projection(
        p, (contact_sums){simd_sum(&g), simd_sum(&gg), simd_sum(&gf), simd_sum(&gz)});
    const double offset0 = at.offset - at.tilt * p->origin_position; /* at position 0 */
    const double c = (contact + offset0 / k) / (1.0 - at.tilt / k);
    return (curve_minimum){c, at.modulus, offset0 + at.tilt * c, at.tilt, at.cost};
}

/* ---- octaves --------------------------------------------------------------------------------- */

/* Computes the grid positions of the samples: octave l and node as l * STRIDE + node, plus the
 * fraction to the next node. x is the depth fraction times 2^-l, with a fraction from 1/2 to 1; in
 * the last octave it may be smaller. */
WIDE_REGISTERS static void find_node_positions(const projection *p)
{
    const double scale = (1.0 - 0x1p-50) / p->top, last = ldexp(1.0, -(int)p->n_octaves);
    const size_t n = p->samples->n;
    const double *tip = p->workspace->tip;
    double *position_index = p->workspace->scratch;
    for (size_t i = 0; i < n; i += WIDE) {
        wide part, normal = last - (wide){0.0};
        for (size_t j = 0; j < WIDE; j++)
            part[j] = tip[i + j < n ? i + j : n - 1];
        part = (p->deepest - part) * scale;
        wide_maximum(&normal, &part);
        const wide_bits exponent = (wide_bits)normal >> 52; /* 1022 - l */
        const wide power = (wide)((2045 - exponent) << 52);
        const wide_bits whole = (1022 - exponent) | (wide_bits)(0x1p52 - (wide){0.0});
        part = ((wide)whole - 0x1p52) * STRIDE + NODES * (1.0 - part * power);
        for (size_t j = 0; j < WIDE && i + j < n; j++)
            position_index[i + j] = part[j];
    }
}

/* Distributes the samples to the nodes of their octaves. Each octave is then added to the nodes of
 * the previous octave, whose step is twice as large. */
WIDE_REGISTERS static void distribute_samples(const projection *p)
{
    scan_octave *octaves = p->workspace->octave;
    const curve_samples *s = p->samples;
    const wide origin = {0.0, p->origin_force, p->origin_position, 0.0};
    const double *position_index = p->workspace->scratch, *weight = p->workspace->weight;
    static const wide nothing = {0.0};
    wide node[SCAN_OCTAVES * STRIDE]; /* sums of weight, force and position */
    const size_t last = p->n_octaves - 1;
    for (size_t l = 0; l <= last; l++) /* the samples of an octave are in its first half */
        for (size_t i = 0; i < (l < last ? HALF + 1 : STRIDE); i++)
            node[l * STRIDE + i] = nothing;
    for (size_t i = 0; i < s->n;) { /* consecutive samples between the same nodes */
        const int at = (int)position_index[i];
        wide to_left = node[at], to_right = node[at + 1];
        for (; i < s->n && (int)position_index[i] == at; i++) {
            const double right = weight[i] * (position_index[i] - at), left = weight[i] - right;
            const wide sample = (wide){1.0, s->force[i], s->position[i], 0.0} - origin;
            to_left += left * sample;
            to_right += right * sample;
        }
        node[at] = to_left;
        node[at + 1] = to_right;
    }
    for (size_t l = 0; l <= last; l++)
        for (size_t i = 0; i < (l < last ? HALF + 1 : STRIDE); i++) {
            octaves[l].weight[i] = node[l * STRIDE + i][0];
            octaves[l].force[i] = node[l * STRIDE + i][1];
            octaves[l].position[i] = node[l * STRIDE + i][2];
        }
    for (size_t l = last; l > 0; l--) {
        const double *from[] = {octaves[l].weight, octaves[l].force, octaves[l].position};
        double *to[] = {octaves[l - 1].weight, octaves[l - 1].force, octaves[l - 1].position};
        for (size_t c = 0; c < 3; c++) {
            double *upper = to[c] + HALF;
            upper[0] += from[c][0] + 0.5 * from[c][1];
            for (size_t i = 1; i <= HALF; i++)
                upper[i] = from[c][2 * i] + 0.5 * (from[c][2 * i - 1] + from[c][2 * i + 1]);
            to[c][STRIDE - 1] = 0.0;
        }
    }
}

/* Tabulates the contact function at multiples of the step. The first octave includes the range
 * before the start. */
static void tabulate_contact_function(const projection *p)
{
    wt_indent_workspace *w = p->workspace;
    double depth[REACH * NODES + 1], *extended = w->before_start[0];
    for (size_t l = p->n_octaves; l-- > 0;) {
        scan_octave *o = &w->octave[l];
        const size_t n_shared = l + 1 < p->n_octaves ? HALF : 0, n = l > 0 ? NODES : REACH * NODES;
        const double step = ldexp(p->top, -(int)l) / NODES;
        double *g = l > 0 ? o->g : extended;
        for (size_t i = 0; i < n_shared; i++)
            g[i] = w->octave[l + 1].g[2 * i];
        for (size_t i = n_shared; i <= n; i++)
            depth[i] = (double)i * step;
        wt_contact_table_eval(p->table, depth + n_shared, n + 1 - n_shared, g + n_shared, NULL);
        for (size_t i = 0; i <= NODES; i++) {
            o->g[i] = g[i];
            o->gg[i] = g[i] * g[i];
        }
    }
    for (size_t i = 0; i <= REACH * NODES; i++)
        w->before_start[1][i] = extended[i] * extended[i];
}

/* Sums over the nodes from `first` on with values of the contact function and of its square. */
WIDE_REGISTERS static contact_sums contact_function_sums(const scan_octave *o, size_t first,
                                                         const double *g, const double *gg)
{
    const size_t n = NODES + 1 - first;
    wide s = {0.0}, ss = s, sf = s, sz = s;
    size_t i = 0;
    for (; i + WIDE <= n; i += WIDE) {
        wide weight, force, position, value, square;
        simd_load(&weight, o->weight + first + i);
        simd_load(&force, o->force + first + i);
        simd_load(&position, o->position + first + i);
        simd_load(&value, g + i);
        simd_load(&square, gg + i);
        s += weight * value;
        ss += weight * square;
        sf += force * value;
        sz += position * value;
    }
    for (; i < n; i++) {
        s[0] += o->weight[first + i] * g[i];
        ss[0] += o->weight[first + i] * gg[i];
        sf[0] += o->force[first + i] * g[i];
        sz[0] += o->position[first + i] * g[i];
    }
    return (contact_sums){simd_sum(&s), simd_sum(&ss), simd_sum(&sf), simd_sum(&sz)};
}

static double projected_cost(const projection *p, const scan_octave *o, size_t first,
                             const double *g, const double *gg)
{
    return solve_projection(p, contact_function_sums(o, first, g, gg)).cost;
}

/* Cost of any contact point on the grid of one octave. */
WIDE_REGISTERS static double interpolated_cost(double depth, void *projection_)
{
    const projection *p = projection_;
    const scan_octave *o = &p->workspace->octave[p->octave];
    const double step = ldexp(p->top, -(int)p->octave) / NODES;
    const double before = NODES - depth / step; /* in nodes; not an integer */
    const size_t first = before > 0.0 ? (size_t)fmin(before, NODES) : 0;
    double delta[NODES + 1] = {0.0}, g[NODES + 1], gg[NODES + 1];
    for (size_t i = first; i <= NODES; i++)
        delta[i] = depth - (double)(NODES - i) * step;
    wt_contact_table_eval(p->table, delta + first, NODES + 1 - first, g + first, NULL);
    for (size_t i = first; i <= NODES; i++)
        gg[i] = g[i] * g[i];
    return projected_cost(p, o, first, g + first, gg + first);
}

/* Brent's minimisation. */
static double minimise_brent(projection *p, double lo, double middle, double hi)
{
    gsl_min_fminimizer *minimizer = p->workspace->minimizer;
    gsl_function function = {interpolated_cost, p};
    if (gsl_min_fminimizer_set(minimizer, &function, middle, lo, hi) != GSL_SUCCESS)
        return middle; /* constant within rounding */
    for (int i = 0; i < MAX_ITERATIONS; i++) {
        if (gsl_min_fminimizer_iterate(minimizer) != GSL_SUCCESS)
            break;
        double a = gsl_min_fminimizer_x_lower(minimizer), b = gsl_min_fminimizer_x_upper(minimizer);
        if (b - a < tolerance * (hi - lo))
            break;
    }
    return gsl_min_fminimizer_x_minimum(minimizer);
}

/* Finds the minima of the scan, lowest first, at most CURVE_MAX_MINIMA. A minimum without a rise
 * before a lower one is a ripple. A minimum at the far end counts: contact before the start. */
static size_t find_scan_minima(const double *cost, size_t n, double nothing, size_t *minimum_index)
{
    size_t m = 0;
    double highest_since = 0.0;
    for (size_t i = 0; i < n; i++) {
        highest_since = fmax(highest_since, cost[i]);
        bool falls = i == 0 || cost[i] < cost[i - 1];
        bool rises = i + 1 == n || cost[i] <= cost[i + 1];
        if (!falls || !rises || !(cost[i] < nothing))
            continue;
        if (m > 0 && highest_since <= min_rise * fmax(cost[minimum_index[m - 1]], cost[i])) {
            if (cost[i] >= cost[minimum_index[m - 1]])
                continue;
            m--;
        }
        minimum_index[m++] = i;
        highest_since = cost[i];
    }
    for (size_t i = 1; i < m; i++) { /* insertion sort of a few values */
        size_t index = minimum_index[i], j = i;
        for (; j > 0 && cost[minimum_index[j - 1]] > cost[index]; j--)
            minimum_index[j] = minimum_index[j - 1];
        minimum_index[j] = index;
    }
    return m < CURVE_MAX_MINIMA ? m : CURVE_MAX_MINIMA;
}

static void insert_minimum(curve_minimum *minima, size_t *n, curve_minimum candidate)
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

/* Costs of contact points from far before the start to the deepest. */
typedef struct cost_profile {
    double depth[MAX_DEPTHS], cost[MAX_DEPTHS];
    size_t octave[MAX_DEPTHS], n;
} cost_profile;

static void add_profile_point(cost_profile *to, double depth, double cost, size_t octave)
{
    to->depth[to->n] = depth;
    to->cost[to->n] = cost;
    to->octave[to->n++] = octave;
}

/* Costs of one contact point in `stride`, a power of 2. */
static void scan_costs(const projection *p, double shallowest, size_t stride, cost_profile *to)
{
    const wt_indent_workspace *w = p->workspace;
    const double *g = w->before_start[0], *gg = w->before_start[1];
    to->n = 0;
    for (size_t octave = REACH * NODES; octave > NODES; octave /= 2)
        for (size_t i = octave; i > octave / 2; i -= octave / 2 / PER_OCTAVE * stride)
            add_profile_point(to, p->top * (double)i / NODES,
                              projected_cost(p, &w->octave[0], 0, g + i - NODES, gg + i - NODES),
                              0);
    for (size_t l = 0; l < p->n_octaves; l++) {
        const scan_octave *o = &w->octave[l];
        for (size_t node = 0; node < HALF; node += HALF / PER_OCTAVE * stride) {
            const double depth = ldexp(p->top, -(int)l) * (1.0 - (double)node / NODES);
            if (depth >= shallowest)
                add_profile_point(to, depth, projected_cost(p, o, node + 1, o->g + 1, o->gg + 1),
                                  l);
        }
    }
}

/* Refines the lowest minima of the scan. */
static size_t refine_minima(projection *p, const cost_profile *points,
                            curve_minimum minima[CURVE_MAX_MINIMA])
{
    size_t minimum_index[MAX_DEPTHS], n = 0;
    const size_t n_scan_minima =
        find_scan_minima(points->cost, points->n, cost_without_contact(p), minimum_index);
    for (size_t i = 0; i < n_scan_minima; i++) {
        const size_t j = minimum_index[i];
        double at = points->depth[j];
        if (j > 0 && j + 1 < points->n) {
            p->octave = points->octave[j - 1];
            at = minimise_brent(p, points->depth[j + 1], at, points->depth[j - 1]);
        }
        const curve_minimum minimum = convert_minimum(p, p->deepest - at);
        if (minimum.reduced_modulus > 0.0)
            insert_minimum(minima, &n, minimum);
    }
    return n;
}

/* Computes the weights 1/h^2, h = 1 + S/k, of all samples for a scan from those of a minimum.
 * Returns the largest h. */
static double compute_weights(const wt_contact_table *table, const curve_samples *samples,
                              const curve_minimum *minimum, wt_indent_workspace *workspace)
{
    enum { MOST = 64 }; /* nodes with linear interpolation; weights need no precision */
    const size_t n = samples->n < MOST ? samples->n : MOST;
    const double c = minimum->contact_point;
    const double last = fmax(c, curve_find_span(samples->position, samples->n).high);
    double position[MOST], force[MOST] = {0.0}, weight[MOST + 1], largest = 1.0;
    const double step = (last - c) / (double)(n - 1);
    for (size_t i = 0; i < n; i++)
        position[i] = c + (double)i * step;
    const curve_samples nodes = {
        .n = n, .position = position, .force = force, .spring_constant = samples->spring_constant};
    curve_law m = {.table = table, .samples = &nodes, .workspace = workspace};
    const double p[CURVE_N_PARAMETERS] = {minimum->reduced_modulus, c, 0.0, 0.0, 0.0};
    curve_model_start(&m, p);
    curve_model_cost(&m, p);
    for (size_t i = 0; i < n; i++) {
        const double h = curve_model_factor(&m, p, i);
        weight[i] = 1.0 / (h * h);
        largest = h > largest ? h : largest;
    }
    weight[n] = weight[n - 1];
    const double scale = step > 0.0 ? 1.0 / step : 0.0;
    for (size_t i = 0; i < samples->n; i++) {
        const double at = (samples->position[i] - c) * scale;
        workspace->weight[i] = 1.0;
        if (!(at > 0.0))
            continue;
        const size_t node = at < (double)(n - 1) ? (size_t)at : n - 1;
        workspace->weight[i] =
            weight[node] + (at - (double)node) * (weight[node + 1] - weight[node]);
    }
    return largest;
}

WIDE_REGISTERS curve_samples curve_average_samples(const curve_samples *s, size_t from,
                                                   size_t length, wt_indent_workspace *w)
{
    curve_samples to = {.position = w->start_position,
                        .force = w->start_force,
                        .spring_constant = s->spring_constant};
    if (length <= 1)
        return *s;
    for (size_t i = from % length; i + length <= s->n; i += length) {
        to.position[to.n] = curve_sum(s->position + i, length) / (double)length;
        to.force[to.n++] = curve_sum(s->force + i, length) / (double)length;
    }
    return to;
}

size_t curve_scan(const wt_contact_table *table, const curve_samples *all, bool tilt, bool weighted,
                  wt_indent_workspace *w, curve_minimum minima[CURVE_MAX_MINIMA])
{
    const size_t length = curve_average_length(all);
    const curve_samples means = curve_average_samples(all, all->n, length, w), *samples = &means;
    projection p = begin_projection(table, samples, tilt, w);
    const size_t n_skipped = SKIPPED_SAMPLES * ((samples->n + 1023) / 1024);
    const double upper_tip = curve_find_span(w->tip, samples->n - n_skipped + 1).high;
    cost_profile points;
    /* invalid data may overflow or be too small for a division */
    if (!isnormal(p.top) || p.top < 0.0)
        return 0;
    const double shallowest = fmax(p.deepest - upper_tip, least_depth * p.top);
    p.n_octaves = 1;
    while (p.n_octaves < SCAN_OCTAVES && ldexp(p.top, -(int)p.n_octaves) > shallowest)
        p.n_octaves++;
    find_node_positions(&p);
    distribute_samples(&p);
    tabulate_contact_function(&p);
    if (weighted) { /* weights change slowly, so the lowest point of a coarse scan is sufficient */
        scan_costs(&p, shallowest, COARSE, &points);
        size_t lowest = 0;
        for (size_t i = 1; i < points.n; i++)
            lowest = points.cost[i] < points.cost[lowest] ? i : lowest;
        const curve_minimum first = convert_minimum(&p, p.deepest - points.depth[lowest]);
        if (!(first.reduced_modulus > 0.0))
            return 0;
        const bool has_weights = compute_weights(table, samples, &first, w) > min_weight_ratio;
        sum_weighted_samples(&p, has_weights);
        if (has_weights)
            distribute_samples(&p);
    }
    scan_costs(&p, shallowest, 1, &points);
    const size_t n = refine_minima(&p, &points, minima);
    for (size_t i = 0; i < n; i++)
        minima[i].cost *= (double)length;
    return n;
}

bool curve_scan_point(const wt_contact_table *table, const curve_samples *samples, bool tilt,
                      double contact_point, wt_indent_workspace *w, curve_minimum *minimum)
{
    const projection p = begin_projection(table, samples, tilt, w);
    /* The tip position at contact depends on the baseline, which is part of the solution. */
    double tip = tip_position(contact_point, p.origin_force, samples->spring_constant);
    for (int i = 0; i < MAX_ITERATIONS; i++) {
        *minimum = convert_minimum(&p, tip);
        double step = contact_point - minimum->contact_point;
        tip += step;
        if (fabs(step) <= 1e-12 * fabs(p.top))
            break;
    }
    minimum->contact_point = contact_point;
    return minimum->reduced_modulus > 0.0;
}
