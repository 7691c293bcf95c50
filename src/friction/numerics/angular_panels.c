/* Angular integrals in linear time. The law is evaluated once at the nodes of subintervals in ln
 * omega, which end at its knots. The integrals up to each edge are summed from below.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/angular.h"

#include "core/math/simd.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Width of a subinterval in ln omega. The poles of a Maxwell element have the distance pi/2 from
 * the axis, and ten nodes leave (0.35/2/pi)^20, or 1e-25. Only the kernel K is steeper, near w. */
static const double max_width = 0.35;
/* Largest change of ln F over one subinterval: ten nodes integrate exp(1.2 x) to rounding. */
static const double max_log_change = 1.2;
/* Distance in ln omega from the start of the integrals to the range. Below the start, a power law
 * is assumed. The first value makes the contribution of a constant modulus, which is weighted with
 * c, smaller than the goal. The second suffices where the law is a power law. */
static const double power_law_margin = 8, knot_margin = 2.5;
/* The integrals begin at an integer multiple of this, so that similar ranges have the same
 * subintervals. */
static const double stride = 16;
static const int power_of[2] = {2, 1};

/* ---- edges ----------------------------------------------------------------------------------- */

static void log_moduli(const wt_material *material, double x, double e[2])
{
    const double omega = exp(x);
    material->law->modulus(material, &omega, 1, &e[0], &e[1]);
    e[0] = log(e[0]);
    e[1] = log(e[1]);
}

static double largest_log_change(const double *a, const double *b)
{
    const double storage = fabs(b[0] - a[0]), loss = fabs(b[1] - a[1]);
    return 2 * fmax(isfinite(storage) ? storage : 0, isfinite(loss) ? loss : 0);
}

typedef struct edge_list {
    size_t n;
    double *edge, *largest; /* NULL to count the edges only */
} edge_list;

/* Limit of the last Legendre coefficients of a resolved subinterval, relative to its mean. The
 * error of the rule is of the order of their square, because the rule is exact to twice their
 * degree. */
static const double tail_limit = 1e-7;
/* Limit of the subdivision, as a multiple of the number that the steepness requires. A function
 * that is not smooth on a 64th of the width is a jump. It bounds time and memory. */
static const size_t max_subdivisions = 64;

static bool has_small_tail(const gauss_rule *rule, const double *f, const legendre_top *top)
{
    double sum = 0;
    for (size_t i = 0; i < rule->n; i++)
        sum += rule->weight[i] * f[i];
    return fmax(fabs(top->coefficient[LEGENDRE_TOP - 1]),
                fabs(top->coefficient[LEGENDRE_TOP - 2])) <= 0.5 * tail_limit * sum;
}

/* The moduli of several laws can nearly cancel between two edges whose values do not show it. */
static bool is_resolved(const wt_material *material, const gauss_rule *rule, double from, double to)
{
    double omega[SUBINTERVAL_NODES], storage[SUBINTERVAL_NODES], loss[SUBINTERVAL_NODES],
        square[SUBINTERVAL_NODES];
    legendre_top of_loss, of_square;
    for (size_t i = 0; i < SUBINTERVAL_NODES; i++)
        omega[i] = exp(from + 0.5 * (to - from) * (1 + rule->node[i]));
    material->law->modulus(material, omega, SUBINTERVAL_NODES, storage, loss);
    for (size_t i = 0; i < SUBINTERVAL_NODES; i++)
        square[i] = storage[i] * storage[i] + loss[i] * loss[i];
    gauss_rule_top_coefficients(rule, loss, square, &of_loss, &of_square);
    return has_small_tail(rule, loss, &of_loss) && has_small_tail(rule, square, &of_square);
}

/* Returns the number of parts of a subinterval: that required by its logarithmic change `by`, or
 * more. */
static size_t count_subdivisions(const wt_material *material, const gauss_rule *rule, double from,
                                 double to, double by)
{
    const double steep = ceil(fmax((to - from) / max_width, by / max_log_change));
    const size_t least = steep > 1 ? (size_t)fmin(steep, 1e6) : 1;
    size_t n = least;
    if (material->law->power_below || material->law->angular != NULL)
        return n; /* power law between knots, or closed form as smooth as a Maxwell element */
    for (size_t i = 0; i < n && n < max_subdivisions * least; i++)
        if (!is_resolved(material, rule, from + (to - from) * (double)i / (double)n,
                         from + (to - from) * (double)(i + 1) / (double)n)) {
            n *= 2;
            i = (size_t)-1; /* restart from the first part */
        }
    return n;
}

/* Adds the n parts of a subinterval. `largest` is the largest logarithm up to its upper edge. */
static void add_edges(edge_list *list, double from, double to, size_t n, double largest)
{
    for (size_t i = 1; i <= n; i++, list->n++)
        if (list->edge != NULL) {
            list->edge[list->n] = i < n ? from + (to - from) * (double)i / (double)n : to;
            list->largest[list->n] = largest;
        }
}

static double max_abs_log(double largest, const double e[2])
{
    for (size_t i = 0; i < 2; i++)
        if (isfinite(e[i]))
            largest = fmax(largest, fabs(e[i]));
    return largest;
}

/* Places edges from `first` to `last`, at the integer multiples of the width and at the knots. */
static void set_subinterval_edges(const wt_material *material, const gauss_rule *rule, double first,
                                  double last, edge_list *list)
{
    size_t n_breaks = 0, k = 0;
    const double *breaks =
        material->law->breaks != NULL ? material->law->breaks(material, &n_breaks) : NULL;
    double x = first, e[2], next_e[2];
    log_moduli(material, x, e);
    double largest = max_abs_log(0, e);
    if (list->edge != NULL) {
        list->edge[0] = first;
        list->largest[0] = largest;
    }
    list->n = 1;
    while (x < last) {
        double next = fmin((floor(x / max_width + 1e-9) + 1) * max_width, last);
        while (k < n_breaks && log(breaks[k]) <= x)
            k++;
        if (k < n_breaks)
            next = fmin(next, log(breaks[k]));
        log_moduli(material, next, next_e);
        largest = max_abs_log(largest, next_e);
        const size_t n = count_subdivisions(material, rule, x, next, largest_log_change(e, next_e));
        add_edges(list, x, next, n, largest);
        x = next;
        e[0] = next_e[0];
        e[1] = next_e[1];
    }
}

/* ---- sums ------------------------------------------------------------------------------------ */

/* Evaluates F at the nodes of subinterval p. */
static void evaluate_subinterval(angular_subintervals *a, size_t p)
{
    const double half = 0.5 * (a->edge[p + 1] - a->edge[p]);
    double *omega = a->omega + p * SUBINTERVAL_NODES;
    double storage[SUBINTERVAL_NODES], loss[SUBINTERVAL_NODES];
    for (size_t i = 0; i < SUBINTERVAL_NODES; i++)
        omega[i] = exp(a->edge[p] + half * (1 + a->rule->node[i]));
    a->material->law->modulus(a->material, omega, SUBINTERVAL_NODES, storage, loss);
    for (size_t i = 0; i < SUBINTERVAL_NODES; i++) {
        const double weight = half * a->rule->weight[i];
        a->value[0][p * SUBINTERVAL_NODES + i] = weight * loss[i];
        a->value[1][p * SUBINTERVAL_NODES + i] =
            weight * (storage[i] * storage[i] + loss[i] * loss[i]);
    }
}

/* Starts the sums. Below the first edge, E' and E'' continue as the power laws that they are there.
 */
static void init_sums(angular_subintervals *a)
{
    const double x = a->edge[0], step = 1;
    double e[3][2];
    for (size_t i = 0; i < 3; i++)
        log_moduli(a->material, x + step * (double)i, e[i]);
    for (size_t f = 0; f < 2; f++) {
        double *sum = a->below[f];
        for (size_t part = f == 0 ? 1 : 0; part < 2; part++) {
            const double times = f == 0 ? 1 : 2;
            /* the slope of a component that is pure rounding is arbitrary */
            const double slope = fmax(times * (e[1][part] - e[0][part]) / step, -0.5);
            const double other = times * (e[2][part] - e[1][part]) / step;
            const double height = exp(times * e[0][part]);
            if (!(height > 0) || !isfinite(slope))
                continue;
            for (size_t m = 0; m < a->terms; m++)
                sum[m] += height / ((double)(2 * m) + power_of[f] + slope);
            a->start_error[f] += sum[0] * fmin(fabs(other - slope), 1);
        }
    }
}

/* Error of one subinterval with the integral `sum` from the rounding of ln omega at nodes, edges
 * and knots. */
static double rounding_part(const angular_subintervals *a, size_t f, size_t p, double sum)
{
    const double *value = a->value[f] + p * SUBINTERVAL_NODES, *weight = a->rule->weight;
    const double first = value[0] / weight[0], last = value[SUBINTERVAL_NODES - 1] / weight[0];
    const double width = a->edge[p + 1] - a->edge[p];
    const double far = fmax(fabs(a->edge[p]), fabs(a->edge[p + 1]));
    const double change = first > 0 && last > 0 ? fabs(log(last / first)) : 0;
    return 2 * DBL_EPSILON * (1 + far) * sum * change / width;
}

static void sum_subintervals(angular_subintervals *a)
{
    for (size_t p = 0; p <= a->n; p++)
        a->edge_omega[p] = exp(a->edge[p]);
    for (size_t p = 0; p < a->n; p++) {
        const double b = a->edge_omega[p + 1], shrink = exp(a->edge[p] - a->edge[p + 1]);
        for (size_t f = 0; f < 2; f++) {
            const double *from = a->below[f] + p * a->terms;
            double *to = a->below[f] + (p + 1) * a->terms;
            double factor = f == 0 ? shrink * shrink : shrink;
            const double passed = from[0] * factor;
            a->rounding[f][p + 1] = a->rounding[f][p] * factor;
            for (size_t m = 0; m < a->terms; m++) {
                to[m] = from[m] * factor;
                factor *= shrink * shrink;
            }
            for (size_t i = 0; i < SUBINTERVAL_NODES; i++) {
                const double c = a->omega[p * SUBINTERVAL_NODES + i] / b, square = c * c;
                double term = a->value[f][p * SUBINTERVAL_NODES + i] * (f == 0 ? square : c);
                for (size_t m = 0; m < a->terms; m++) {
                    to[m] += term;
                    term *= square;
                }
            }
            a->rounding[f][p + 1] += rounding_part(a, f, p, to[0] - passed);
        }
    }
}

void angular_subintervals_new(const wt_material *material, const gauss_rule *rule, double low,
                              double high, double goal, angular_subintervals *subintervals)
{
    size_t n_breaks = 0;
    const double *breaks =
        material->law->breaks != NULL ? material->law->breaks(material, &n_breaks) : NULL;
    const bool is_power = n_breaks > 0 && material->law->power_below;
    double begin = log(low);
    if (n_breaks > 0)
        begin = fmin(begin, log(breaks[0]));
    const double first = fmax(floor(begin / stride) * stride -
                                  (is_power ? knot_margin : power_law_margin - log(goal)),
                              log(DBL_MIN) + 1);
    angular_subintervals a = {.material = material, .rule = rule};
    /* c^(2m) is 4^-m */
    a.terms = 2 + (size_t)ceil(-log(fmin(fmax(goal, 1e-16), 0.1)) / (2 * M_LN2));
    edge_list list = {0};
    set_subinterval_edges(material, rule, first, log(high), &list);
    a.n = list.n - 1;
    const size_t nodes = a.n * SUBINTERVAL_NODES, sums = (a.n + 1) * a.terms;
    a.numbers = wt_alloc(5 * (a.n + 1) + 3 * nodes + 2 * sums, sizeof *a.numbers);
    a.edge = list.edge = a.numbers;
    a.edge_omega = a.edge + a.n + 1;
    a.omega = a.edge_omega + a.n + 1;
    a.value[0] = a.omega + nodes;
    a.value[1] = a.value[0] + nodes;
    a.below[0] = a.value[1] + nodes;
    a.below[1] = a.below[0] + sums;
    a.rounding[0] = a.below[1] + sums;
    a.rounding[1] = a.rounding[0] + a.n + 1;
    a.largest = list.largest = a.rounding[1] + a.n + 1;
    set_subinterval_edges(material, rule, first, log(high), &list);
    init_sums(&a);
    for (size_t p = 0; p < a.n; p++)
        evaluate_subinterval(&a, p);
    sum_subintervals(&a);
    *subintervals = a;
}

void angular_subintervals_clear(angular_subintervals *subintervals)
{
    free(subintervals->numbers);
    *subintervals = (angular_subintervals){0};
}

/* ---- one frequency --------------------------------------------------------------------------- */

/* Returns the last edge at or below x. */
static size_t preceding_edge(const angular_subintervals *a, double x)
{
    size_t low = a->edge[a->n] <= x ? a->n : 0, high = a->n;
    while (low < high) {
        const size_t middle = (low + high + 1) / 2;
        if (a->edge[middle] <= x)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

/* Adds the integral below an edge at c <= 1/2: sum_m b_m S_m c^(2m + s). */
static void add_far_series(const angular_subintervals *a, size_t edge, double w, double *j1,
                           double *j2)
{
    const double c = a->edge_omega[edge] / w, square = c * c;
    const double *s1 = a->below[0] + edge * a->terms, *s2 = a->below[1] + edge * a->terms;
    double sum1 = 0, sum2 = 0, b = 1, power = 1;
    for (size_t m = 0; m < a->terms && power > DBL_EPSILON / 64; m++) {
        sum1 += b * power * s1[m];
        sum2 += b * power * s2[m];
        b *= (double)(2 * m + 1) / (double)(2 * m + 2);
        power *= square;
    }
    *j1 += sum1 * square;
    *j2 += sum2 * c;
}

enum { NODE_BATCH = 8 * SUBINTERVAL_NODES }; /* nodes of one batch, which fits on the stack */

/* Adds n <= NODE_BATCH nodes of subintervals whose distance below w is at least their width. */
WIDE_REGISTERS
static void add_node_sum(size_t n, const double *restrict omega, const double *restrict f1,
                         const double *restrict f2, double w, double *restrict j1,
                         double *restrict j2)
{
    double kernel[NODE_BATCH], cosine[NODE_BATCH];
    for (size_t i = 0; i < n; i++) {
        cosine[i] = omega[i] / w;
        kernel[i] = cosine[i] / sqrt((1 - cosine[i]) * (1 + cosine[i]));
    }
    wide sum1 = {0}, sum2 = {0};
    size_t from = 0;
    for (; from + WIDE <= n; from += WIDE) {
        wide c, k, v1, v2;
        memcpy(&c, cosine + from, sizeof c);
        memcpy(&k, kernel + from, sizeof k);
        memcpy(&v1, f1 + from, sizeof v1);
        memcpy(&v2, f2 + from, sizeof v2);
        sum1 += k * c * v1;
        sum2 += k * v2;
    }
    for (size_t i = 0; from < n; i++, from++) {
        sum1[i] += kernel[from] * cosine[from] * f1[from];
        sum2[i] += kernel[from] * f2[from];
    }
    for (size_t i = 0; i < WIDE; i++) {
        *j1 += sum1[i];
        *j2 += sum2[i];
    }
}

/* Integrates from ln omega = `from` to `to` close below x = ln w, with ln omega = x - t^2. */
static void add_near_integral(const angular_subintervals *a, double x, double from, double to,
                              double w, double *j1, double *j2)
{
    double omega[SUBINTERVAL_NODES], storage[SUBINTERVAL_NODES], loss[SUBINTERVAL_NODES],
        weight[SUBINTERVAL_NODES], cosine[SUBINTERVAL_NODES], t[SUBINTERVAL_NODES],
        power[SUBINTERVAL_NODES], gap[SUBINTERVAL_NODES];
    const double t_first = sqrt(fmax(0, x - to)), far = sqrt(x - from),
                 half = 0.5 * (far - t_first);
    for (size_t i = 0; i < SUBINTERVAL_NODES; i++) {
        t[i] = t_first + half * (1 + a->rule->node[i]);
        power[i] = -2 * t[i] * t[i];
    }
    vector_expm1(power, SUBINTERVAL_NODES, gap); /* c^2 - 1 */
    for (size_t i = 0; i < SUBINTERVAL_NODES; i++) {
        cosine[i] = sqrt(1 + gap[i]);
        omega[i] = w * cosine[i];
        weight[i] = half * a->rule->weight[i] * 2 * t[i] * cosine[i] / sqrt(-gap[i]);
    }
    a->material->law->modulus(a->material, omega, SUBINTERVAL_NODES, storage, loss);
    for (size_t i = 0; i < SUBINTERVAL_NODES; i++) {
        *j1 += weight[i] * cosine[i] * loss[i];
        *j2 += weight[i] * (storage[i] * storage[i] + loss[i] * loss[i]);
    }
}

void angular_subintervals_integrate(const angular_subintervals *subintervals, double w, double *j1,
                                    double *j2)
{
    const angular_subintervals *a = subintervals;
    *j1 = *j2 = 0;
    if (w >= 2 * a->edge_omega[a->n]) {
        add_far_series(a, a->n, w, j1, j2);
    } else {
        const double x = log(w);
        size_t p = preceding_edge(a, x - M_LN2);
        add_far_series(a, p, w, j1, j2);
        while (p < a->n && a->edge[p] < x) {
            size_t from = p * SUBINTERVAL_NODES;
            while (p < a->n && 2 * a->edge[p + 1] <= x + a->edge[p])
                p++;
            for (const size_t end = p * SUBINTERVAL_NODES; from < end; from += NODE_BATCH)
                add_node_sum(end - from < NODE_BATCH ? end - from : NODE_BATCH, a->omega + from,
                             a->value[0] + from, a->value[1] + from, w, j1, j2);
            /* narrow subintervals may follow */
            for (; p < a->n && a->edge[p] < x && 2 * a->edge[p + 1] > x + a->edge[p]; p++)
                add_near_integral(a, x, a->edge[p], fmin(a->edge[p + 1], x), w, j1, j2);
        }
    }
    *j1 *= 4;
    *j2 *= 4;
}

double angular_subintervals_error(const angular_subintervals *subintervals, double w, double j1,
                                  double j2)
{
    const angular_subintervals *a = subintervals;
    const double x = log(w);
    const size_t edge = preceding_edge(a, x - max_width);
    double e[2];
    log_moduli(a->material, x, e);
    const double largest = max_abs_log(a->largest[preceding_edge(a, x)], e);
    const double start = a->edge_omega[0] / w, c = a->edge_omega[edge] / w;
    const double kernel = 4 * c / sqrt((1 - c) * (1 + c)); /* value at the edge; smaller below it */
    const double error1 = 4 * a->start_error[0] * start * start + kernel * c * a->rounding[0][edge];
    const double error2 = 4 * a->start_error[1] * start + kernel * a->rounding[1][edge];
    return fmax(j1 > 0 ? error1 / j1 : 0, j2 > 0 ? error2 / j2 : 0) + pow(4, -(double)a->terms) +
           8 * DBL_EPSILON + 2 * DBL_EPSILON * (4 + largest);
}
