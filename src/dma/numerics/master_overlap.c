/* Shifts by the overlap of neighbours, for the storage modulus alone, and the errors of the shifts
 * if one spectrum does not describe the isotherms. A step starts from the closed form and ends with
 * robust least squares of the gaps. Its error includes the scatter along the overlap. The result
 * also contains the changes by the loss modulus alone and by another vertical shift.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/math/arena_gsl.h"
#include "dma/numerics/isotherm.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>

/* ---- closed form of ISO 18437-6 -------------------------------------------------------------- */

/* Minimum shared height [decade], or this share of the height of the flatter curve, because a
 * glass has no more. The height is twelve times 1 % of noise (0.004 decade). The
 * overlap chain, which starts from these shifts, has separate errors. */
static const double least_height = 0.05, least_share = 0.25;

/* Minimum number of points of each curve in the shared range. Two isotherms towards the anchor
 * are tried, so that one bad isotherm leaves a gap only. */
enum { LEAST_POINTS = 2, REACH = 2 };

/* Integrates x over the ordinates from low to high along the running maximum of a curve. *n:
 * number of points in that range. */
static double area_along_ordinates(const shift_curve *c, double low, double high, size_t *n)
{
    double sum = 0.0, before = c->y[STORAGE][0];
    *n = before >= low && before <= high;
    for (size_t k = 1; k < c->n; k++) {
        const double y = c->y[STORAGE][k], from = fmax(before, low), to = fmin(y, high);
        *n += y >= low && y <= high;
        if (!(y > before))
            continue;
        if (to > from) {
            const double slope = (c->x[k] - c->x[k - 1]) / (y - before);
            sum += (to - from) * (c->x[k - 1] + slope * (0.5 * (from + to) - before));
        }
        before = y;
    }
    return sum;
}

/* Returns the shift of curve `from` onto curve `onto`, with its storage modulus times 10^b
 * [decade]. It is NaN if they share too little height. */
static double closed_form_step(const shift_set *set, size_t onto, size_t from, double b)
{
    const shift_curve *p = &set->curves[onto], *s = &set->curves[from];
    if (!set->used[STORAGE] || p->n < LEAST_POINTS || s->n < LEAST_POINTS)
        return (double)NAN;
    const double first[2] = {p->y[STORAGE][0], s->y[STORAGE][0] + b},
                 last[2] = {gsl_stats_max(p->y[STORAGE], 1, p->n),
                            gsl_stats_max(s->y[STORAGE], 1, s->n) + b};
    const double low = fmax(first[0], first[1]), high = fmin(last[0], last[1]);
    const double flatter = fmin(last[0] - first[0], last[1] - first[1]);
    size_t points[2];
    const double between = area_along_ordinates(p, low, high, &points[0]) -
                           area_along_ordinates(s, low - b, high - b, &points[1]);
    const bool enough = high > low && high - low >= fmin(least_height, least_share * flatter) &&
                        points[0] >= LEAST_POINTS && points[1] >= LEAST_POINTS;
    return enough ? between / (high - low) : (double)NAN;
}

void closed_form_shifts(const shift_set *set, size_t anchor, double *log_a)
{
    for (size_t i = 0; i < set->n; i++)
        log_a[i] = (double)NAN;
    if (!set->used[STORAGE])
        return;
    log_a[anchor] = 0.0;
    for (size_t i = anchor + 1; i < set->n; i++)
        for (size_t k = 1; isnan(log_a[i]) && k <= REACH && anchor + k <= i; k++)
            log_a[i] = log_a[i - k] + closed_form_step(set, i - k, i, 0.0);
    for (size_t i = anchor; i-- > 0;)
        for (size_t k = 1; isnan(log_a[i]) && k <= REACH && i + k <= anchor; k++)
            log_a[i] = log_a[i + k] + closed_form_step(set, i + k, i, 0.0);
}

/* ---- overlaps -------------------------------------------------------------------------------- */

/* A step with a larger error is rejected [decade], as for the shifts of the fit. */
static const double largest_sigma = 0.2;
/* Half width of the line fit that gives a slope [decade]. */
static const double slope_reach = 0.3;
/* Gaps beyond this number of standard deviations get little weight. Cauchy weights cost 5 % of
 * the efficiency for normal noise. */
static const double weight_scale = 2.385;
static const double convergence_step = 1e-5; /* [decade] */
/* A noise correlation differs from 0 if it exceeds this number of standard errors. */
static const double correlation_significance = 2.0;
enum { NEIGHBOURS = 2, MOST_STEPS = 50, LEAST_GAPS = 4 };

/* A gap between two curves, and its change with the shift. */
struct gap {
    double off, slope, weight;
};

struct overlap {
    const shift_curve *p, *s;
    const double *slope_p, *slope_s; /* slopes at their points */
    int q;                           /* index of the modulus */
    double b;
    struct gap *gap;
    double *scratch; /* scratch of the same size */
    size_t n, n_first;
};

/* Computes the slope of a modulus at each point. */
static void find_curve_slopes(const shift_curve *c, int q, double *slope)
{
    size_t from = 0, to = 0;
    for (size_t k = 0; k < c->n; k++) {
        double sum[4] = {0.0, 0.0, 0.0, 0.0}; /* sums of x, y, xx, xy relative to the point */
        while (from + 1 < k && c->x[from] < c->x[k] - slope_reach)
            from++;
        while (to < c->n && (to < k + 2 || c->x[to] <= c->x[k] + slope_reach))
            to++;
        for (size_t i = from; i < to; i++) {
            const double x = c->x[i] - c->x[k], y = c->y[q][i] - c->y[q][k];
            sum[0] += x;
            sum[1] += y;
            sum[2] += x * x;
            sum[3] += x * y;
        }
        const double n = (double)(to - from), spread = sum[2] - sum[0] * sum[0] / n;
        slope[k] = spread > 0.0 ? (sum[3] - sum[0] * sum[1] / n) / spread : 0.0;
    }
}

/* Adds the gaps of the points of `from`, moved by a, to the curve `onto`; sign: 1 if `from` is
 * the shifted curve. */
static void add_curve_gaps(struct overlap *o, const shift_curve *onto, const shift_curve *from,
                           const double *slope, double a, double sign)
{
    size_t k = 0;
    for (size_t i = 0; i < from->n; i++) {
        const double x = from->x[i] + a;
        if (x < onto->x[0] || x > onto->x[onto->n - 1])
            continue;
        while (k + 2 < onto->n && onto->x[k + 1] < x)
            k++;
        const double width = onto->x[k + 1] - onto->x[k];
        const double share = width > 0.0 ? (x - onto->x[k]) / width : 0.5;
        const double y = onto->y[o->q][k] + share * (onto->y[o->q][k + 1] - onto->y[o->q][k]);
        o->gap[o->n++] = (struct gap){sign * (y - from->y[o->q][i]) - o->b,
                                      slope[k] + share * (slope[k + 1] - slope[k]), 1.0};
    }
}

static void find_gaps(struct overlap *o, double a)
{
    o->n = 0;
    add_curve_gaps(o, o->p, o->s, o->slope_p, a, 1.0);
    o->n_first = o->n;
    add_curve_gaps(o, o->s, o->p, o->slope_s, -a, -1.0);
    for (size_t i = 0; i < o->n; i++)
        o->scratch[i] = fabs(o->gap[i].off);
    const double spread = o->n > 0 ? weight_scale * 1.4826 * numbers_median(o->scratch, o->n) : 0.0;
    for (size_t i = 0; spread > 0.0 && i < o->n; i++) {
        const double scaled_gap = o->gap[i].off / spread;
        o->gap[i].weight = 1.0 / (1.0 + scaled_gap * scaled_gap);
    }
}

/* Returns the correction of the shift from the gaps, and the sums of squares of gaps and slopes. */
static double shift_correction(const struct overlap *o, double *gaps, double *slope_squares)
{
    double cross = 0.0;
    *gaps = *slope_squares = 0.0;
    for (size_t i = 0; i < o->n; i++) {
        const struct gap *g = &o->gap[i];
        cross += g->weight * g->off * g->slope;
        *gaps += g->weight * g->off * g->off;
        *slope_squares += g->weight * g->slope * g->slope;
    }
    return *slope_squares > 0.0 ? -cross / *slope_squares : (double)NAN;
}

/* Returns the correlation of neighbouring gaps, which is positive if the curves differ in form. */
static double gap_correlation(const struct overlap *o)
{
    double product = 0.0, square = 0.0;
    for (size_t i = 0; i < o->n; i++) {
        const double r = o->gap[i].off * sqrt(o->gap[i].weight);
        square += r * r;
        if (i > 0 && i != o->n_first)
            product += r * o->gap[i - 1].off * sqrt(o->gap[i - 1].weight);
    }
    return square > 0.0 ? fmax(product / square, 0.0) : 0.0;
}

/* Fits a step by least squares from the closed form. The error includes the difference between
 * both. */
static bool fit_step(struct overlap *o, double start, double *a, double *error, double *spread)
{
    double gaps = 0.0, slope_squares = 0.0;
    *a = start;
    for (int i = 0; i < MOST_STEPS; i++) {
        find_gaps(o, *a);
        const double move =
            o->n >= LEAST_GAPS ? shift_correction(o, &gaps, &slope_squares) : (double)NAN;
        if (!isfinite(move))
            return false;
        *a += fmax(-largest_sigma, fmin(largest_sigma, move));
        if (fabs(move) < convergence_step)
            break;
    }
    find_gaps(o, *a);
    if (o->n < LEAST_GAPS || !isfinite(shift_correction(o, &gaps, &slope_squares)))
        return false;
    /* effective number of points; both directions use the same points */
    const double rho = gap_correlation(o), all = sqrt(gaps / slope_squares);
    const double independent = fmax(0.5 * (double)o->n * (1.0 - rho) / (1.0 + rho), 1.0);
    *error = hypot(all / sqrt(independent), 0.5 * (*a - start));
    /* correlation beyond that of noise */
    *spread = fmax(rho - correlation_significance / sqrt((double)o->n), 0.0) * all;
    return *error <= largest_sigma;
}

struct chain_work {
    const shift_set *set;
    const double *b, *alternative_b;
    double *slope[MODULI]; /* [points of the set] */
    size_t *first;         /* [n] first point of each curve */
    struct overlap overlap;
};

static void set_overlap(struct chain_work *c, size_t onto, size_t from, int q, const double *b)
{
    struct overlap *o = &c->overlap;
    o->p = &c->set->curves[onto];
    o->s = &c->set->curves[from];
    o->q = q;
    o->slope_p = c->slope[q] + c->first[onto];
    o->slope_s = c->slope[q] + c->first[from];
    o->b = b[from] - b[onto];
}

/* Returns the change of a step by an alternative, or 0 if the alternative determines none. */
static double alternative_step_change(struct chain_work *c, double start, double a)
{
    double other, error, spread;
    return fit_step(&c->overlap, start, &other, &error, &spread) ? other - a : 0.0;
}

static bool add_overlap_edge(struct chain_work *c, overlap_edge *edge, size_t onto, size_t from)
{
    double a, error, spread;
    if (!edge[onto].placed)
        return false;
    set_overlap(c, onto, from, STORAGE, c->b);
    const double start = closed_form_step(c->set, onto, from, c->overlap.b);
    if (isnan(start) || !fit_step(&c->overlap, start, &a, &error, &spread))
        return false;
    edge[from] = (overlap_edge){.placed = true,
                                .onto = onto,
                                .a = edge[onto].a + a,
                                .step = error,
                                .error = edge[onto].error + error,
                                .spread = edge[onto].spread + spread,
                                .by_loss = edge[onto].by_loss,
                                .by_vertical = edge[onto].by_vertical};
    if (c->set->used[LOSS]) {
        set_overlap(c, onto, from, LOSS, c->b);
        edge[from].by_loss += alternative_step_change(c, a, a);
    }
    if (c->alternative_b != NULL) {
        set_overlap(c, onto, from, STORAGE, c->alternative_b);
        edge[from].by_vertical += alternative_step_change(c, a, a);
    }
    return true;
}

/* Fills the edges [set->n]. b: [set->n] vertical shifts of the moduli; alternative_b: [set->n]
 * alternative vertical shifts, or NULL. Without a storage modulus only the anchor is placed. */
static void overlap_chain(const shift_set *set, size_t anchor, const double *b,
                          const double *alternative_b, overlap_edge *edge)
{
    const size_t n = set->n;
    size_t longest = 0;
    for (size_t i = 0; i < n; i++) {
        edge[i] = (overlap_edge){.onto = anchor, .a = (double)NAN};
        longest = set->curves[i].n > longest ? set->curves[i].n : longest;
    }
    edge[anchor] = (overlap_edge){.placed = true, .onto = anchor};
    if (!set->used[STORAGE])
        return;
    arena memory = {0};
    struct chain_work c = {.set = set, .b = b, .alternative_b = alternative_b};
    for (int q = 0; q < MODULI; q++)
        c.slope[q] = arena_numbers(&memory, set->n_points);
    c.first = arena_alloc(&memory, n, sizeof *c.first);
    c.overlap.gap = arena_alloc(&memory, 2 * longest, sizeof *c.overlap.gap);
    c.overlap.scratch = arena_numbers(&memory, 2 * longest);
    for (size_t i = 0, k = 0; i < n; k += set->curves[i++].n) {
        c.first[i] = k;
        for (int q = 0; q < MODULI; q++)
            if (set->used[q])
                find_curve_slopes(&set->curves[i], q, c.slope[q] + k);
    }
    for (size_t i = anchor + 1; i < n; i++)
        for (size_t k = 1; k <= NEIGHBOURS && anchor + k <= i && !edge[i].placed; k++)
            (void)add_overlap_edge(&c, edge, i - k, i);
    for (size_t i = anchor; i-- > 0;)
        for (size_t k = 1; k <= NEIGHBOURS && i + k <= anchor && !edge[i].placed; k++)
            (void)add_overlap_edge(&c, edge, i + k, i);
    arena_free(&memory);
}

/* Fills the edges [set.n] from the overlaps, with the vertical shift of rubber elasticity or with
 * none. */
static void find_overlap_edges(const master_work *work, bool physical, overlap_edge *edge)
{
    const size_t n = work->set.n;
    arena memory = {0};
    double *none = arena_numbers(&memory, n), *rubber = arena_numbers(&memory, n);
    for (size_t i = 0; i < n; i++)
        rubber[i] = work->physical[i] - work->physical[work->anchor];
    overlap_chain(&work->set, work->anchor, physical ? rubber : none, physical ? none : rubber,
                  edge);
    arena_free(&memory);
}

/* Uses the vertical shift of rubber elasticity if requested, otherwise none. E' alone does not
 * separate it from the horizontal shift, and a glass has none. */
void master_find_overlaps(master_work *work)
{
    find_overlap_edges(work, work->options.vertical == WT_VERTICAL_PHYSICAL, work->edge);
}

/* ---- agreement and errors of the shifts ------------------------------------------------------ */

/* Shifts of the spectrum and of the overlaps disagree if they differ by more standard errors
 * than this. */
static const double agreement_limit = 2.0;

/* Returns true if all shifts of the spectrum agree with the overlaps. */
static bool shifts_match_edges(const master_work *work, const overlap_edge *edge)
{
    const spectrum *s = work->s;
    for (size_t i = 0; i < work->set.n; i++) {
        const long column = work->placed[i] ? s->column_a[work->curve[i]] : -1;
        if (column < 0)
            continue;
        const double variance = spectrum_variance(s, work->curve[i]);
        const double error = sqrt(variance) / M_LN10;
        const double off = spectrum_a(s, work->curve[i]) / M_LN10 - edge[i].a;
        if (!(error <= master_max_shift_error &&
              fabs(off) <= agreement_limit * hypot(edge[i].error, error)))
            return false;
    }
    return true;
}

bool master_shifts_agree(const master_work *work)
{
    arena memory = {0};
    overlap_edge *edge = arena_alloc(&memory, work->set.n, sizeof *edge);
    bool agree = false;
    for (int physical = 0; physical < 2 && !agree; physical++) {
        find_overlap_edges(work, physical == 1, edge);
        agree = shifts_match_edges(work, edge);
    }
    arena_free(&memory);
    return agree;
}

bool master_can_use_overlaps(master_work *work)
{
    size_t placed = 0;
    bool given = !work->set.used[STORAGE];
    for (size_t i = 0; i < work->set.n; i++)
        given = given || work->set.curves[i].is_shift_fixed;
    if (given)
        return false;
    master_find_overlaps(work);
    for (size_t i = 0; i < work->set.n; i++)
        placed += work->edge[i].placed;
    return placed > 1;
}

/* Returns the sum of squared errors of the steps between two isotherms. */
static double path_variance(const master_work *work, size_t left, size_t right)
{
    double sum = 0.0;
    while (left != right) {
        const size_t away[] = {left > work->anchor ? left - work->anchor : work->anchor - left,
                               right > work->anchor ? right - work->anchor : work->anchor - right};
        size_t *const next = away[0] > away[1] ? &left : &right;
        sum += work->edge[*next].step * work->edge[*next].step;
        *next = work->edge[*next].onto;
    }
    return sum;
}

/* Returns the sum of squared errors of the steps that the ways of two isotherms to the root
 * share. */
static double shared_step_variance(const master_work *work, size_t left, size_t right)
{
    const size_t root = work->root;
    if (left == right)
        return path_variance(work, left, root);
    return 0.5 * (path_variance(work, left, root) + path_variance(work, right, root) -
                  path_variance(work, left, right));
}

/* Returns an error of a shift against the root from the errors of both against the anchor, which
 * grow from neighbour to neighbour. */
static double error_to_root(const master_work *work, size_t i, double own, double of_root)
{
    const bool same_side = (i < work->anchor) == (work->root < work->anchor);
    return same_side ? fabs(own - of_root) : own + of_root;
}

/* Converts a misfit of E' to a shift [decade], from the slope of the isotherms. It may
 * accumulate from one isotherm to the next if the material changes with temperature. */
static double misfit_to_shift(const master_work *work, double missed, size_t from, size_t i)
{
    double sum = 0.0;
    for (; i != from; i = i < from ? i + 1 : i - 1) {
        const shift_curve *c = &work->set.curves[i];
        if (c->n < SHIFT_MIN_POINTS)
            continue;
        sum += missed / M_LN10 * (c->x[c->n - 1] - c->x[0]) / curve_modulus_change(&work->set, i);
    }
    return sum;
}

/* Returns the shift error due to the misfit of the spectrum [decade]. If one spectrum fails,
 * slow and fast times shift differently, in an unknown direction. */
static double spectrum_misfit_shift(const master_work *work, size_t i)
{
    bool given = false;
    for (size_t k = 0; k < work->set.n; k++)
        given = given || work->set.curves[k].is_shift_fixed;
    if (given || master_misfit_is_loss_factor(&work->lack))
        return 0.0; /* stated shifts may cause the misfit; a factor on all E'' does not affect
                       shifts */
    const double missed = sqrt(work->lack.beyond) * work->missed[STORAGE];
    return hypot(work->lack.parted * (work->original_a[i] - work->original_a[work->root]),
                 misfit_to_shift(work, missed, work->root, i));
}

/* Returns the squared change of a shift by alternatives as good as E' alone, between two
 * isotherms. If one spectrum fails, no alternative is known to be right. */
static double alternative_variance(const overlap_edge *from, const overlap_edge *to)
{
    const double by_loss = to->by_loss - from->by_loss,
                 by_vertical = to->by_vertical - from->by_vertical;
    return by_loss * by_loss + by_vertical * by_vertical;
}

/* Returns the variance of one shift due to the overlaps [decade^2]. Weak overlaps add no error
 * to a spectrum. */
static double overlap_variance(const master_work *work, size_t i)
{
    const overlap_edge *edge = &work->edge[i];
    if (!edge->placed)
        return 0.0;
    const overlap_edge *root = &work->edge[work->root];
    const double error = error_to_root(work, i, edge->error, root->error),
                 spread = error_to_root(work, i, edge->spread, root->spread);
    const double square = shared_step_variance(work, i, i) + error * error;
    const double alike = spread * spread;
    if (work->route == WT_SHIFTS_FROM_OVERLAP)
        return square + alike + alternative_variance(root, edge);
    const double difference =
        edge->a - root->a - (work->original_a[i] - work->original_a[work->root]);
    const double off = isnan(difference) ? 0.0 : fabs(difference);
    return alike + pow(fmax(off - agreement_limit * sqrt(square), 0.0), 2);
}

/* Returns true if the user stated the shift. Shifts of overlaps are also fixed, but do not count
 * here. */
static bool is_user_stated(const master_work *work, size_t i)
{
    return work->route != WT_SHIFTS_FROM_OVERLAP && work->set.curves[i].is_shift_fixed;
}

/* Sets the errors of the shifts if superposition fails or may fail. They combine the scatter
 * within the overlaps, the difference of spectrum and overlaps, and the misfit. The law treats
 * them as independent step errors of the same total size, because a common error leaves its form
 * unchanged. An error that is only possible is ignored by the law. Stated shifts have no error. */
void master_set_shift_errors(master_work *work)
{
    const size_t n = work->set.n;
    wt_posterior *p = work->posterior;
    const bool may =
        work->route != WT_SHIFTS_FROM_OVERLAP && !master_misfit_is_significant(&work->lack);
    const bool fails = !may && !master_loss_is_inconsistent(&work->lack);
    double all = 0.0, steps = 0.0;
    p->extra_error = arena_numbers(&p->memory, work->s->n_curves);
    p->extra_covariance = arena_matrix(&p->memory, work->s->n_curves, work->s->n_curves);
    for (size_t i = 0; i < n; i++) {
        if (!work->placed[i] || is_user_stated(work, i))
            continue;
        const double own =
            work->route == WT_SHIFTS_FROM_OVERLAP ? 0.0 : spectrum_misfit_shift(work, i);
        const double square = overlap_variance(work, i);
        const double sure = fails ? square + own * own : square;
        p->extra_error[work->curve[i]] = hypot(sqrt(square), own);
        all += work->edge[i].placed ? sure : 0.0;
        steps += work->edge[i].placed ? shared_step_variance(work, i, i) : 0.0;
        for (size_t k = 0; k < n && !may; k++)
            if (work->placed[k] && !is_user_stated(work, k) && work->edge[i].placed &&
                work->edge[k].placed && (i < work->root) == (k < work->root))
                gsl_matrix_set(p->extra_covariance, work->curve[i], work->curve[k],
                               shared_step_variance(work, i, k));
    }
    gsl_matrix_scale(p->extra_covariance, steps > 0.0 ? all / steps : 1.0);
    for (size_t i = 0; i < n; i++) /* without an overlap the error is independent */
        if (work->placed[i] && !is_user_stated(work, i) && !work->edge[i].placed)
            gsl_matrix_set(p->extra_covariance, work->curve[i], work->curve[i],
                           fails ? pow(p->extra_error[work->curve[i]], 2) : 0.0);
}

/* Refers the additional errors to an isotherm. Returns false if no overlap places it. */
static bool refer_errors_to(master_work *work, size_t root)
{
    if (!work->edge[root].placed)
        return false;
    if (root != work->root) {
        work->root = root;
        master_set_shift_errors(work);
    }
    return true;
}

void master_refer_errors(master_work *work)
{
    wt_posterior *p = work->posterior;
    if (work->route != WT_SHIFTS_FROM_OVERLAP && master_reference_is_fitted(work))
        (void)spectrum_select_connected(&work->set, work->at, work->a, work->placed, work->overlap);
    if (p->extra_error == NULL)
        return;
    work->base_error = p->extra_error;
    size_t cold, warm;
    if (master_reference_is_fitted(work))
        (void)refer_errors_to(work, work->at);
    else if (master_reference_neighbours(work, &cold, &warm) && refer_errors_to(work, cold)) {
        const double *const to_cold = p->extra_error;
        const double t = work->set.curves[cold].temperature,
                     share = (work->reference - t) / (work->set.curves[warm].temperature - t);
        (void)refer_errors_to(work, warm);
        for (size_t i = 0; i < work->s->n_curves; i++)
            p->extra_error[i] = sqrt((1.0 - share) * to_cold[i] * to_cold[i] +
                                     share * p->extra_error[i] * p->extra_error[i]);
    }
}

void master_store_original_shifts(master_work *work)
{
    for (size_t i = 0; i < work->set.n; i++)
        work->original_a[i] = work->placed[i] && work->no_spectrum[0] == '\0'
                                  ? spectrum_a(work->s, work->curve[i]) / M_LN10
                                  : (double)NAN;
}

void master_uncertainty(master_work *work)
{
    double *b = arena_numbers(&work->memory, work->set.n);
    const double b0 = spectrum_b(work->s, work->curve[work->anchor]);
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i])
            b[i] = (spectrum_b(work->s, work->curve[i]) - b0) / M_LN10;
    master_store_original_shifts(work);
    overlap_chain(&work->set, work->anchor, b, NULL, work->edge);
    master_set_shift_errors(work);
}

bool master_all_uncertain(const master_work *work)
{
    const double *extra_error = work->posterior->extra_error;
    bool all = extra_error != NULL;
    for (size_t i = 0; all && i < work->set.n; i++)
        all = i == work->anchor || !work->placed[i] ||
              extra_error[work->curve[i]] > master_max_shift_error;
    return all;
}

/* ---- isotherms outside the described part ---------------------------------------------------- */

bool master_shift_outside_part(const master_work *work, size_t i, double *a, double *error)
{
    const size_t end = i < work->first ? work->first : work->last;
    const overlap_edge *edge = work->edge;
    if (!work->part || (i >= work->first && i <= work->last) || !edge[i].placed ||
        !edge[end].placed || !work->placed[end])
        return false;
    const posterior_place anchor = posterior_at_curve(work->curve[work->anchor]);
    const wt_interval at = posterior_a(work->posterior, work->curve[end], &anchor);
    const double alike = hypot(edge[i].spread - edge[end].spread, edge[i].error - edge[end].error);
    *a = at.value + edge[i].a - edge[end].a;
    *error = sqrt(at.standard_error * at.standard_error + alike * alike +
                  alternative_variance(&edge[end], &edge[i]) + path_variance(work, i, end));
    return true;
}
