/* Angular integrals: the closed form of the law, or Chebyshev series in ln w through values from
 * subintervals.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/angular.h"

#include "core/base/array.h"
#include "core/math/simd.h"
#include "core/math/special.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Degrees of the series. Each is twice the previous one, so that its nodes are a subset of the
 * next. A closed form starts at the second degree, because degree 4 leaves 6e-4 on its segments. */
enum { SHORT_DEGREE = 4, CLOSED_DEGREE = 8, DEGREES = 3 };
/* Limits of the refinement: 1/4096 of the width, or three successive halvings that each reduce the
 * error by less than a factor of ten. Rounding then dominates. */
enum { MAX_HALVINGS = 12, MAX_FUTILE_HALVINGS = 3 };

/* Segments end at the integer multiples of this width in ln w and at the knots of the law. A closed
 * form is smooth: its poles have the distance pi/2 from the real axis. */
static const double law_width = 0.7, closed_width = 1;
/* Two limits in ln w closer than this are equal up to rounding. */
static const double same_bound = 1e-12;
/* Relative error goal of a series: a share of the tolerance, which leaves the rest to subintervals
 * and rules. It is at least some dozens of roundings. It is at most 1e-6, because a larger goal
 * saves no coefficient. */
static const double goal_share = 0.01, min_goal = 2e-14, max_goal = 1e-6;
/* Relative error of J1 and J2 from a sum of positive terms with a few roundings each. */
static const double closed_error = 16 * DBL_EPSILON;
/* Number of terms at which a series costs as much as the closed form. 100 velocities and setup at
 * 1e-10 take 0.29 ms either way with 7 terms; with 10 terms 0.31 and 0.28 ms. */
enum { MANY_TERMS = 8 };
/* Range in which squares and powers of omega tau neither overflow nor underflow. */
static const double min_frequency = 1e-250, max_frequency = 1e250;

/* J1 and J2 on a segment. To the right of a knot w_k both integrals have a (ln w - ln w_k)^(3/2)
 * singularity: the series there runs in u = sqrt(ln w - ln w_k). */
typedef struct series {
    double low, high;    /* ln w */
    double anchor;       /* ln w_k; NaN if the series runs in ln w */
    double middle, half; /* of u */
    size_t degree;
    double error, value_error; /* relative error of the series, and of the values at its nodes */
    double j1[CHEBYSHEV_DEGREE_MAX + 1], j2[CHEBYSHEV_DEGREE_MAX + 1]; /* coefficients of the powers
                                                        of z = (u - middle) / half */
} series;

typedef struct series_list {
    size_t n;
    series *items;
} series_list;

struct angular_law {
    const wt_material *material;
    bool closed; /* the law has a closed form */
    double tolerance, segment_width;
    const gauss_rule *rule;
    double goal;
    angular_subintervals subintervals;
    double subintervals_low, subintervals_high;
    series_list segments;                  /* rising, without gaps */
    double node[CHEBYSHEV_DEGREE_MAX + 1]; /* cos(pi k / CHEBYSHEV_DEGREE_MAX) */
    double fit[DEGREES][(CHEBYSHEV_DEGREE_MAX + 1) * CHEBYSHEV_FIT_STRIDE]; /* matrix of each
                                                          degree, one column for each node */
};

/* ---- series ---------------------------------------------------------------------------------- */

/* The coefficients of an interpolation at cos(pi k / degree) are weighted sums of its values. */
static void compute_fit_matrices(angular_law *a)
{
    double cosine[2 * CHEBYSHEV_DEGREE_MAX];
    for (size_t k = 0; k < 2 * CHEBYSHEV_DEGREE_MAX; k++)
        cosine[k] = cos(M_PI * (double)k / CHEBYSHEV_DEGREE_MAX);
    memcpy(a->node, cosine, sizeof a->node);
    for (size_t i = 0, degree = SHORT_DEGREE; i < DEGREES; i++, degree *= 2)
        for (size_t k = 0; k <= degree; k++)
            for (size_t j = 0; j <= degree; j++) {
                const double node = k == 0 || k == degree ? 0.5 : 1;
                const double term = j == 0 || j == degree ? 1 : 2;
                a->fit[i][k * CHEBYSHEV_FIT_STRIDE + j] =
                    node * term / (double)degree *
                    cosine[j * k * (CHEBYSHEV_DEGREE_MAX / degree) % (2 * CHEBYSHEV_DEGREE_MAX)];
            }
}

static double smallest_value(const double *value, size_t step)
{
    double least = value[0];
    for (size_t k = 0; k <= CHEBYSHEV_DEGREE_MAX; k += step)
        least = fmin(least, value[k]);
    return least;
}

/* Converts both series to powers of z, with the larger of the two degrees. */
static void series_to_powers(series *s, const double *j1, const double *j2, double goal)
{
    const size_t step = CHEBYSHEV_DEGREE_MAX / s->degree;
    const double least[2] = {smallest_value(j1, step), smallest_value(j2, step)};
    double *const coefficient[2] = {s->j1, s->j2};
    size_t degree[2] = {s->degree, s->degree};
    double more = 0;
    for (size_t i = 0; i < 2; i++) {
        const double left = chebyshev_to_monomials(coefficient[i], &degree[i],
                                                   0.3 * fmax(goal, s->error) * least[i]);
        more = fmax(more, least[i] > 0 ? left / least[i] : 0);
    }
    s->degree = degree[0] > degree[1] ? degree[0] : degree[1];
    s->error += more;
}

/* Evaluates J1 and J2 at every `step`th node of a segment, beginning with `first`. */
static void series_node_values(const angular_law *a, const series *s, size_t first, size_t step,
                               double *j1, double *j2)
{
    double x[CHEBYSHEV_DEGREE_MAX + 1], w[CHEBYSHEV_DEGREE_MAX + 1], new1[CHEBYSHEV_DEGREE_MAX + 1],
        new2[CHEBYSHEV_DEGREE_MAX + 1];
    size_t n = 0, k = first;
    do {
        const double u = s->middle + s->half * a->node[k];
        x[n++] = isnan(s->anchor) ? u : s->anchor + u * u;
    } while ((k += step) <= CHEBYSHEV_DEGREE_MAX);
    vector_exp(x, n, w);
    if (a->closed)
        a->material->law->angular(a->material, w, n, new1, new2);
    else
        for (size_t i = 0; i < n; i++)
            angular_subintervals_integrate(&a->subintervals, w[i], &new1[i], &new2[i]);
    for (size_t i = 0; i < n; i++) {
        j1[first + i * step] = new1[i];
        j2[first + i * step] = new2[i];
    }
}

/* Relative error of the values that a series interpolates. */
static double series_value_error(const angular_law *a, const series *s, const double *j1,
                                 const double *j2)
{
    const size_t last = CHEBYSHEV_DEGREE_MAX; /* node at the lower limit */
    return a->closed
               ? closed_error
               : fmax(
                     angular_subintervals_error(&a->subintervals, exp(s->high), j1[0], j2[0]),
                     angular_subintervals_error(&a->subintervals, exp(s->low), j1[last], j2[last]));
}

static series series_fit(const angular_law *a, double low, double high, double anchor)
{
    const bool in_root = !isnan(anchor);
    const double from = in_root ? sqrt(fmax(0, low - anchor)) : low;
    const double to = in_root ? sqrt(high - anchor) : high;
    series s = {.low = low,
                .high = high,
                .anchor = anchor,
                .middle = 0.5 * (from + to),
                .half = 0.5 * (to - from)};
    double j1[CHEBYSHEV_DEGREE_MAX + 1], j2[CHEBYSHEV_DEGREE_MAX + 1], goal = a->goal;
    const size_t begin = a->closed ? CLOSED_DEGREE : SHORT_DEGREE;
    for (size_t degree = begin; degree <= CHEBYSHEV_DEGREE_MAX; degree *= 2) {
        const size_t step = CHEBYSHEV_DEGREE_MAX / degree;
        if (degree == begin) {
            series_node_values(a, &s, 0, step, j1, j2);
            s.value_error = series_value_error(a, &s, j1, j2);
            goal = fmax(goal, s.value_error);
        } else {
            series_node_values(a, &s, step, 2 * step, j1, j2);
        }
        const double *fit = a->fit[degree == SHORT_DEGREE           ? 0
                                   : degree == CHEBYSHEV_DEGREE_MAX ? 2
                                                                    : 1];
        chebyshev_fit(j1, degree, fit, s.j1);
        chebyshev_fit(j2, degree, fit, s.j2);
        s.degree = degree;
        s.error = fmax(chebyshev_tail(s.j1, j1, degree), chebyshev_tail(s.j2, j2, degree));
        if (s.error <= goal)
            break;
    }
    series_to_powers(&s, j1, j2, goal);
    return s;
}

static void series_push(series_list *list, const series *s)
{
    list->items = array_grow(list->items, list->n, sizeof *list->items);
    list->items[list->n++] = *s;
}

/* Adds a fitted segment, or its halves if its error is too large, as with close knots or steep
 * tables. A narrow segment may have a larger error, because it has less weight. `futile` counts the
 * halvings with little gain. */
static void series_add(const angular_law *a, series_list *list, const series *s, int halvings,
                       int futile)
{
    const double middle = isnan(s->anchor) ? s->middle : s->anchor + s->middle * s->middle;
    const double allowed =
        2 * fmax(a->goal, s->value_error) * fmax(1, law_width / (s->high - s->low));
    if (s->error <= allowed || halvings == MAX_HALVINGS || futile == MAX_FUTILE_HALVINGS ||
        !(middle > s->low && middle < s->high)) {
        series_push(list, s);
        return;
    }
    const series left = series_fit(a, s->low, middle, s->anchor),
                 right = series_fit(a, middle, s->high, s->anchor);
    futile += fmin(left.error, right.error) > 0.1 * s->error;
    series_add(a, list, &left, halvings + 1, futile);
    series_add(a, list, &right, halvings + 1, futile);
}

static const double *material_knots(const angular_law *a, size_t *n)
{
    *n = 0;
    return a->material->law->breaks != NULL ? a->material->law->breaks(a->material, n) : NULL;
}

/* Returns the nearest knot at or below x if it affects a segment there, else NaN. */
static double preceding_knot(const double *knots, size_t n, double x)
{
    size_t low = 0, high = n; /* knots with an index below `low` are at or below x */
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (log(knots[middle]) <= x + same_bound)
            low = middle + 1;
        else
            high = middle;
    }
    const double knot = low > 0 ? log(knots[low - 1]) : -(double)INFINITY;
    return knot > x - 3 * law_width ? fmin(knot, x) : (double)NAN;
}

/* Adds the segments between two multiples of the segment width. */
static void add_segments(const angular_law *a, long first, long last, double *bounds,
                         series_list *list)
{
    size_t n = 0, n_knots;
    const double *knots = material_knots(a, &n_knots);
    for (long m = first; m <= last; m++)
        bounds[n++] = (double)m * a->segment_width;
    for (size_t k = 0; k < n_knots; k++) {
        const double x = log(knots[k]);
        if (x > bounds[0] && x < (double)last * a->segment_width)
            bounds[n++] = x;
    }
    numbers_sort(bounds, n);
    for (size_t i = 1, from = 0; i < n; i++) {
        if (bounds[i] - bounds[from] < same_bound)
            continue;
        const double anchor = preceding_knot(knots, n_knots, bounds[from]);
        const series s = series_fit(a, bounds[from], bounds[i], anchor);
        series_add(a, list, &s, 0, 0);
        from = i;
    }
}

/* Extends the subintervals to the union of this range and the present one. */
static void extend_subintervals(angular_law *a, double low, double high)
{
    if (a->subintervals.n > 0) {
        low = fmin(low, a->subintervals_low);
        high = fmax(high, a->subintervals_high);
        angular_subintervals_clear(&a->subintervals);
    }
    a->subintervals_low = low;
    a->subintervals_high = high;
    /* Beyond the end, because rounding may place a frequency there, where the integrand has a pole.
     */
    angular_subintervals_new(a->material, a->rule, low, 1.01 * high, a->goal, &a->subintervals);
}

/* Range in integer multiples of the segment width: the union of the present and the requested
 * range, and the present one. */
typedef struct series_range {
    long first, last, have_first, have_last;
} series_range;

static series_range extended_range(const angular_law *a, double w_min, double w_max)
{
    const series_list *have = &a->segments;
    series_range r = {(long)floor(log(w_min) / a->segment_width),
                      (long)ceil(log(w_max) / a->segment_width), 0, 0};
    if (r.last <= r.first)
        r.last = r.first + 1;
    r.have_first = r.have_last = r.last; /* no segment yet */
    if (have->n > 0) {
        r.have_first = lround(have->items[0].low / a->segment_width);
        r.have_last = lround(have->items[have->n - 1].high / a->segment_width);
        r.first = r.first < r.have_first ? r.first : r.have_first;
        r.last = r.last > r.have_last ? r.last : r.have_last;
    }
    return r;
}

bool angular_covers_range(const angular_law *angular, double w_min, double w_max)
{
    const wt_material_law *law = angular->material->law;
    if (angular->closed && (law->terms == NULL || law->terms(angular->material) < MANY_TERMS ||
                            !(w_min >= min_frequency && w_max <= max_frequency)))
        return true;
    const series_range r = extended_range(angular, w_min, w_max);
    return r.first == r.have_first && r.last == r.have_last;
}

void angular_extend(angular_law *angular, double w_min, double w_max)
{
    if (angular_covers_range(angular, w_min, w_max))
        return;
    const double segment_width = angular->segment_width;
    const series_list *have = &angular->segments;
    const series_range range = extended_range(angular, w_min, w_max);
    const long first = range.first, last = range.last, have_first = range.have_first,
               have_last = range.have_last;
    if (!angular->closed)
        extend_subintervals(angular, exp((double)first * segment_width),
                            exp((double)last * segment_width));
    size_t n_knots;
    (void)material_knots(angular, &n_knots);
    series_list made = {0};
    double *bounds = wt_alloc((size_t)(last - first) + 1 + n_knots, sizeof *bounds);
    add_segments(angular, first, have_first, bounds, &made);
    for (size_t i = 0; i < have->n; i++)
        series_push(&made, &have->items[i]);
    add_segments(angular, have_last, last, bounds, &made);
    free(bounds);
    free(angular->segments.items);
    angular->segments = made;
}

/* Returns the index of the first segment that reaches x, or of the last one. */
static size_t segment_index(const series_list *list, double x)
{
    size_t low = 0, high = list->n > 0 ? list->n - 1 : 0;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (list->items[middle].high < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

bool angular_uses_closed_form(const angular_law *angular, double x_min, double x_max)
{
    const series_list *segments = &angular->segments;
    return angular->closed &&
           (segments->n == 0 ||
            !(x_min >= segments->items[0].low && x_max <= segments->items[segments->n - 1].high));
}

/* Nodes in one segment, with padding for whole registers. */
enum { BATCH = 32, NODES_PER_STEP = 2 * WIDE };

/* Evaluates both series at n <= BATCH positions. Even and odd powers alternate, so that their
 * operations are independent. Each `value` has the capacity BATCH. */
WIDE_REGISTERS
static void series_eval(const series *restrict s, size_t n, const double *restrict z,
                        double *restrict value1, double *restrict value2)
{
    const size_t top = s->degree / 2 * 2; /* even */
    const double *const j1 = s->j1, *const j2 = s->j2;
    const double above1 = s->degree > top ? j1[top + 1] : 0,
                 above2 = s->degree > top ? j2[top + 1] : 0;
    for (size_t from = 0; from < n; from += NODES_PER_STEP) {
        wide a, b;
        memcpy(&a, z + from, sizeof a);
        memcpy(&b, z + from + WIDE, sizeof b);
        const wide aa = a * a, bb = b * b, zero = {0};
        wide even_a1 = zero + j1[top], odd_a1 = zero + above1, even_a2 = zero + j2[top],
             odd_a2 = zero + above2;
        wide even_b1 = even_a1, odd_b1 = odd_a1, even_b2 = even_a2, odd_b2 = odd_a2;
        for (size_t m = top; m >= 2; m -= 2) {
            even_a1 = even_a1 * aa + j1[m - 2];
            odd_a1 = odd_a1 * aa + j1[m - 1];
            even_a2 = even_a2 * aa + j2[m - 2];
            odd_a2 = odd_a2 * aa + j2[m - 1];
            even_b1 = even_b1 * bb + j1[m - 2];
            odd_b1 = odd_b1 * bb + j1[m - 1];
            even_b2 = even_b2 * bb + j2[m - 2];
            odd_b2 = odd_b2 * bb + j2[m - 1];
        }
        const wide a1 = even_a1 + a * odd_a1, a2 = even_a2 + a * odd_a2;
        const wide b1 = even_b1 + b * odd_b1, b2 = even_b2 + b * odd_b2;
        memcpy(value1 + from, &a1, sizeof a1);
        memcpy(value1 + from + WIDE, &b1, sizeof b1);
        memcpy(value2 + from, &a2, sizeof a2);
        memcpy(value2 + from + WIDE, &b2, sizeof b2);
    }
}

/* Maps x to z of a segment. A value that rounding puts outside is moved to the limit. */
WIDE_REGISTERS
static void map_to_segment(const series *restrict s, const double *restrict x, size_t n,
                           double *restrict z)
{
    const double scale = 1 / s->half, middle = s->middle, anchor = s->anchor;
    if (isnan(anchor))
        for (size_t i = 0; i < n; i++)
            z[i] = (x[i] - middle) * scale;
    else
        for (size_t i = 0; i < n; i++)
            z[i] = (sqrt(x[i] > anchor ? x[i] - anchor : 0) - middle) * scale;
    for (size_t i = 0; i < n; i++) {
        const double below = z[i] < 1 ? z[i] : 1;
        z[i] = below > -1 ? below : -1;
    }
}

void angular_eval(const angular_law *angular, const double *w, const double *x, size_t n,
                  double *j1, double *j2)
{
    if (n == 0)
        return;
    if (angular_uses_closed_form(angular, x[0], x[n - 1])) {
        angular->material->law->angular(angular->material, w, n, j1, j2);
        return;
    }
    const series_list *segments = &angular->segments;
    size_t k = segment_index(segments, x[0]);
    for (size_t from = 0, count; from < n; from += count) {
        double z[BATCH];
        while (k + 1 < segments->n && x[from] > segments->items[k].high)
            k++;
        while (k > 0 && x[from] < segments->items[k].low)
            k--;
        const series *s = &segments->items[k];
        for (count = 1; count < BATCH && from + count < n && !(x[from + count] > s->high) &&
                        !(x[from + count] < s->low);
             count++)
            ;
        map_to_segment(s, x + from, count, z);
        const size_t whole = (count + NODES_PER_STEP - 1) / NODES_PER_STEP * NODES_PER_STEP;
        for (size_t i = count; i < whole; i++)
            z[i] = 0;
        if (from + whole <= n) { /* the next segment overwrites the padding */
            series_eval(s, whole, z, j1 + from, j2 + from);
        } else {
            double value1[BATCH], value2[BATCH];
            series_eval(s, whole, z, value1, value2);
            memcpy(j1 + from, value1, count * sizeof *j1);
            memcpy(j2 + from, value2, count * sizeof *j2);
        }
    }
}

double angular_error(const angular_law *angular, double x_min, double x_max, size_t *segment)
{
    const series_list *segments = &angular->segments;
    double error = 0;
    while (*segment + 1 < segments->n && segments->items[*segment].high < x_min)
        ++*segment;
    for (size_t i = *segment; i < segments->n && segments->items[i].low <= x_max; i++)
        error = fmax(error, segments->items[i].error + segments->items[i].value_error);
    return error;
}

/* ---- construction ---------------------------------------------------------------------------- */

angular_law *angular_new(const wt_material *material, double tolerance, arena *memory)
{
    angular_law *made = arena_alloc(memory, 1, sizeof *made);
    made->material = material;
    compute_fit_matrices(made);
    made->tolerance = tolerance;
    made->goal = fmin(fmax(goal_share * tolerance, min_goal), max_goal);
    made->closed = material->law->angular != NULL;
    made->segment_width = made->closed ? closed_width : law_width;
    made->rule = gauss_rule_get(SUBINTERVAL_NODES);
    return made;
}

void angular_clear(angular_law *angular)
{
    if (angular == NULL)
        return;
    free(angular->segments.items);
    angular_subintervals_clear(&angular->subintervals);
}
