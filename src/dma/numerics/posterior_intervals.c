/* Intervals and draws of the posterior mixture. SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/posterior.h"

#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"
#include "core/math/special.h"
#include "core/math/students_t.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- intervals ------------------------------------------------------------------------------- */

enum { MAX_COMPONENTS = POSTERIOR_CELLS * LAW_SPREADS };
/* Squared distance of a curve from the middle of the line between its neighbours, against the
 * squared scatter of each about the law. */
static const double line_deviation = 1.5;

/* Returns the additional variance of a shift. */
static double extra_variance(const wt_posterior *p, size_t curve)
{
    return p->extra_error != NULL ? p->extra_error[curve] * p->extra_error[curve] : 0.0;
}

/* Returns the covariance of ln a of two curves. */
static double shift_covariance(const wt_posterior *p, const posterior_cell *cell, size_t curve,
                               size_t other)
{
    gsl_vector_view one = gsl_matrix_column(cell->through, curve),
                    with = gsl_matrix_column(cell->through, other);
    double sum = 0.0;
    if (curve == other)
        return p->frame.column_a[curve] < 0 ? 0.0 : cell->block[BLOCK_DIAGONAL * curve];
    gsl_blas_ddot(&one.vector, &with.vector, &sum);
    return sum;
}

/* A linear combination of shifts: those of `curve` with their weights. */
enum { MOST_SHIFTS = 3 };
typedef struct shift_combination {
    size_t n, curve[MOST_SHIFTS];
    double weight[MOST_SHIFTS];
} shift_combination;

/* Computes the value of a combination in a cell and its variance, in decades. */
static double combined_shift(const wt_posterior *p, const posterior_cell *cell,
                             const shift_combination *c, double *variance)
{
    double value = 0.0, sum = 0.0;
    for (size_t i = 0; i < c->n; i++) {
        value += c->weight[i] * posterior_shift(p, cell->value, c->curve[i]);
        for (size_t k = 0; k < c->n; k++)
            sum +=
                c->weight[i] * c->weight[k] * shift_covariance(p, cell, c->curve[i], c->curve[k]);
    }
    *variance = fmax(sum, 0.0) / (M_LN10 * M_LN10);
    return value / M_LN10;
}

/* Returns the interval of a combination with an additional variance. */
static wt_interval combination_interval(const wt_posterior *p, const shift_combination *c,
                                        double extra)
{
    mixture_component component[MAX_COMPONENTS];
    size_t n = 0;
    for (size_t i = 0; i < p->n_cells; i++) {
        double variance;
        if (!(p->cells[i].weight > 0.0))
            continue;
        const double a = combined_shift(p, &p->cells[i], c, &variance);
        component[n++] = (mixture_component){p->cells[i].weight, a, sqrt(variance + extra)};
    }
    if (n == 0) /* no cell has a weight */
        return (wt_interval){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    if (component[0].deviation > 0.0)
        return mixture_interval(component, n);
    const double a = component[0].mean; /* all shifts are stated */
    return (wt_interval){a, 0.0, a, a};
}

wt_interval posterior_a(const wt_posterior *p, size_t curve, const posterior_place *to)
{
    if (to->cold == curve && to->warm == curve)
        return (wt_interval){0};
    const shift_combination c = {
        3, {curve, to->cold, to->warm}, {1.0, to->share - 1.0, -to->share}};
    return interval_offset(combination_interval(p, &c, extra_variance(p, curve) + to->variance),
                           to->law);
}

posterior_place posterior_at_curve(size_t curve)
{
    return (posterior_place){.cold = curve, .warm = curve};
}

/* Returns the squared deviation of a curve from the law and the line between its neighbours
 * [decade^2], above that of its errors. */
static double deviation_between(const wt_posterior *p, const double *unknown, size_t curve)
{
    const double *t = p->temperature;
    const double share = (t[curve] - t[curve - 1]) / (t[curve + 1] - t[curve - 1]);
    const shift_combination c = {3, {curve, curve - 1, curve + 1}, {1.0, share - 1.0, -share}};
    double off = 0.0, variance;
    for (size_t k = 0; k < c.n; k++)
        off -= c.weight[k] * law_value(&p->shape, unknown, t[c.curve[k]], NULL);
    off += combined_shift(p, posterior_best(p), &c, &variance);
    return fmax(off * off - variance, 0.0);
}

/* The line between the neighbours carries (1 - 2 s (1 - s)) of the squared scatter of an isotherm
 * about the law, so the rest is that of the place. A curve is off the line between its neighbours
 * by 1.5 times that square. */
posterior_place posterior_between(const wt_posterior *p, size_t cold, double temperature)
{
    const double *t = p->temperature;
    posterior_place place = {
        .cold = cold, .warm = cold + 1, .share = (temperature - t[cold]) / (t[cold + 1] - t[cold])};
    double unknown[LAW_MAX_UNKNOWNS], square = 0.0;
    int n = 0;
    posterior_mean_law(p, unknown);
    place.law = (1.0 - place.share) * law_value(&p->shape, unknown, t[cold], NULL) +
                place.share * law_value(&p->shape, unknown, t[cold + 1], NULL);
    for (size_t k = 1; k + 1 < p->frame.n_curves; k++)
        if (t[k - 1] < t[k + 1]) {
            square += deviation_between(p, unknown, k);
            n++;
        }
    place.variance = 2.0 * place.share * (1.0 - place.share) * square / fmax(n, 1) / line_deviation;
    return place;
}

double posterior_fit_error(const wt_posterior *p, size_t curve)
{
    return combination_interval(p, &(shift_combination){1, {curve}, {1.0}}, 0.0).standard_error;
}

wt_interval posterior_b(const wt_posterior *p, size_t curve)
{
    mixture_component part[MAX_COMPONENTS];
    size_t n = 0;
    for (size_t i = 0; i < p->n_cells; i++)
        if (p->cells[i].weight > 0.0)
            part[n++] = (mixture_component){
                p->cells[i].weight, posterior_vertical_shift(p, p->cells[i].value, curve) / M_LN10,
                sqrt(p->cells[i].block[BLOCK_DIAGONAL * curve + 2]) / M_LN10};
    return p->frame.column_b[curve] < 0
               ? (wt_interval){part[0].mean, 0.0, part[0].mean, part[0].mean}
               : mixture_interval(part, n);
}

/* A quantity that depends linearly on the unknowns of spectrum and law. Value and variance are
 * those of a component before the feedback of the law. */
struct linear_quantity {
    double value;
    double by_law[LAW_MAX_UNKNOWNS];
    double variance;
    const double *with; /* [n_curves] covariance with log a, or NULL: it depends on the law alone */
};

/* Computes the covariance of a quantity with log a in a cell [n_curves] from its derivatives by the
 * unknowns [n_unknowns], and returns its variance. */
static double cell_variance(const wt_posterior *p, const posterior_cell *cell, const double *by,
                            double *with)
{
    const size_t n = p->frame.n_curves, m = cell->factor.m;
    double variance = 0.0, own[BLOCK_SIDE];
    memset(p->border, 0, m * sizeof *p->border);
    spectrum_split(&p->frame, by, p->border, p->side);
    bordered_solve_lower(&cell->factor, p->border, p->side);
    for (size_t i = 0; i < m; i++)
        variance += p->border[i] * p->border[i];
    for (size_t i = 0; i < BLOCK_SIDE * n; i++)
        variance += p->side[i] * p->side[i];
    memset(with, 0, n * sizeof *with);
    dense_add_rows(with, n, p->border, 1, cell->through->data, cell->through->tda, m);
    for (size_t k = 0; k < n; k++) {
        const double *side = p->side + BLOCK_SIDE * k;
        posterior_unit_shift(cell, k, own);
        with[k] = p->frame.column_a[k] < 0
                      ? 0.0
                      : (with[k] + own[0] * side[0] + own[1] * side[1]) / M_LN10;
    }
    return variance;
}

/* Returns the mean and variance of a quantity in a component. */
static mixture_component component_moments(const wt_posterior *p,
                                           const posterior_component *component,
                                           const struct linear_quantity *x)
{
    const size_t n = p->frame.n_curves, k = component->law.n_unknowns;
    double variance = x->variance, mean = x->value, by_law[LAW_MAX_UNKNOWNS];
    memcpy(by_law, x->by_law, sizeof by_law);
    if (x->with != NULL && component->pull != NULL) {
        double *const white = p->side; /* no longer needed */
        memcpy(white, x->with, n * sizeof *white);
        dense_forward(component->root, white);
        for (size_t i = 0; i < n; i++) {
            mean += x->with[i] * gsl_vector_get(component->pull, i);
            variance -= white[i] * white[i];
        }
        for (size_t i = 0; i < n; i++)
            for (size_t u = 0; u < k; u++)
                by_law[u] += x->with[i] * gsl_matrix_get(component->design, i, u);
    }
    for (size_t u = 0; u < k; u++)
        for (size_t w = 0; w < k; w++)
            variance += by_law[u] * by_law[w] * component->law.covariance[u][w];
    return (mixture_component){component->weight, mean, sqrt(fmax(variance, 0.0))};
}

wt_interval posterior_law(const wt_posterior *p, double temperature)
{
    mixture_component component[MAX_COMPONENTS];
    for (size_t i = 0; i < p->n_components; i++) {
        struct linear_quantity x = {0};
        x.value = law_value(&p->shape, p->components[i].law.unknown, temperature, x.by_law);
        component[i] = component_moments(p, &p->components[i], &x);
    }
    return mixture_interval(component, p->n_components);
}

wt_interval posterior_slope(const wt_posterior *p, double temperature)
{
    const double step = 0.01; /* K */
    mixture_component component[MAX_COMPONENTS];
    for (size_t i = 0; i < p->n_components; i++) {
        const double *unknown = p->components[i].law.unknown;
        struct linear_quantity x = {0}, before = {0};
        x.value = law_value(&p->shape, unknown, temperature + step, x.by_law);
        before.value = law_value(&p->shape, unknown, temperature - step, before.by_law);
        x.value = (x.value - before.value) / (2.0 * step);
        for (size_t u = 0; u < LAW_MAX_UNKNOWNS; u++)
            x.by_law[u] = (x.by_law[u] - before.by_law[u]) / (2.0 * step);
        component[i] = component_moments(p, &p->components[i], &x);
    }
    return mixture_interval(component, p->n_components);
}

wt_interval posterior_constant(const wt_posterior *p, size_t unknown)
{
    mixture_component component[MAX_COMPONENTS];
    for (size_t i = 0; i < p->n_components; i++) {
        struct linear_quantity x = {.value = p->components[i].law.unknown[unknown]};
        x.by_law[unknown] = 1.0;
        component[i] = component_moments(p, &p->components[i], &x);
    }
    return mixture_interval(component, p->n_components);
}

/* scratch: covariances with log a, terms, and derivatives of both moduli and the loss factor */
void posterior_moduli(const wt_posterior *p, double x, bool measured,
                      wt_interval modulus[WITH_LOSS_FACTOR])
{
    const size_t n = p->frame.n_unknowns;
    mixture_component component[WITH_LOSS_FACTOR][MAX_COMPONENTS];
    double *const with[WITH_LOSS_FACTOR] = {p->scratch, p->scratch + p->frame.n_curves,
                                            p->scratch + 2 * p->frame.n_curves};
    double *term = p->scratch + 3 * p->frame.n_curves, *const by_storage = term + p->frame.n_linear;
    double *const gradient[WITH_LOSS_FACTOR] = {by_storage, by_storage + n, by_storage + 2 * n};
    double value[WITH_LOSS_FACTOR], slope[WITH_LOSS_FACTOR], mean[LAW_MAX_UNKNOWNS];
    double variance[WITH_LOSS_FACTOR];
    const posterior_cell *last = NULL;
    posterior_mean_law(p, mean);
    memset(by_storage, 0, WITH_LOSS_FACTOR * n * sizeof *by_storage);
    for (size_t i = 0; i < p->n_components; i++) {
        if (p->components[i].cell != last) {
            last = p->components[i].cell;
            spectrum_terms(&p->frame, last->value, term);
            (measured ? spectrum_measured_moduli : spectrum_moduli)(
                &p->frame, term, x + mean[0] * M_LN10, value, slope, gradient);
            value[LOSS_FACTOR] = value[LOSS] - value[STORAGE];
            slope[LOSS_FACTOR] = slope[LOSS] - slope[STORAGE];
            for (size_t u = 0; u < n; u++)
                gradient[LOSS_FACTOR][u] = gradient[LOSS][u] - gradient[STORAGE][u];
            for (int q = 0; q < WITH_LOSS_FACTOR; q++)
                variance[q] = cell_variance(p, last, gradient[q], with[q]);
        }
        for (int q = 0; q < WITH_LOSS_FACTOR; q++) {
            const double off = p->components[i].law.unknown[0] - mean[0];
            const struct linear_quantity e = {
                value[q] + slope[q] * M_LN10 * off, {slope[q] * M_LN10}, variance[q], with[q]};
            component[q][i] = component_moments(p, &p->components[i], &e);
        }
    }
    for (int q = 0; q < WITH_LOSS_FACTOR; q++)
        modulus[q] = mixture_interval(component[q], p->n_components);
}

/* Interval of two unknowns of the spectrum times `scale`, plus `given` with a variance, minus the
 * offset of the law times `offset`. A negative column has no unknown. */
static wt_interval offset_unknown_interval(const wt_posterior *p, const long column[2],
                                           const double scale[2], double given, double variance,
                                           double offset)
{
    mixture_component component[MAX_COMPONENTS];
    double *by_unknown = p->scratch + p->frame.n_curves;
    memset(by_unknown, 0, p->frame.n_unknowns * sizeof *by_unknown);
    for (int k = 0; k < 2; k++)
        if (column[k] >= 0)
            by_unknown[column[k]] += scale[k];
    for (size_t i = 0; i < p->n_components; i++) {
        const posterior_cell *cell = p->components[i].cell;
        struct linear_quantity x = {given - offset * p->components[i].law.unknown[0],
                                    {-offset},
                                    cell_variance(p, cell, by_unknown, p->scratch),
                                    p->scratch};
        for (int k = 0; k < 2; k++)
            x.value += column[k] >= 0 ? scale[k] * cell->value[column[k]] : 0.0;
        component[i] = component_moments(p, &p->components[i], &x);
        component[i].deviation = sqrt(component[i].deviation * component[i].deviation + variance);
    }
    return mixture_interval(component, p->n_components);
}

wt_interval posterior_a_to_law(const wt_posterior *p, const posterior_place *place)
{
    const size_t curve[] = {place->cold, place->warm};
    const double share[] = {1.0 - place->share, place->share},
                 scale[] = {share[0] / M_LN10, share[1] / M_LN10};
    long column[2];
    double given = -place->law, variance = place->variance;
    for (int k = 0; k < 2; k++) {
        column[k] = p->frame.column_a[curve[k]];
        given += column[k] < 0 ? scale[k] * p->frame.given_a[curve[k]] : 0.0;
        variance += share[k] * share[k] * extra_variance(p, curve[k]);
    }
    return offset_unknown_interval(p, column, scale, given, variance, 1.0);
}

wt_interval posterior_instrument(const wt_posterior *p, instrument_error which)
{
    const spectrum *s = &p->frame;
    const double none = (double)NAN;
    if (instrument_count(s) == 0)
        return (wt_interval){none, none, none, none};
    return offset_unknown_interval(p, (long[]){(long)(s->n_linear + which), -1},
                                   (double[]){instrument_deviation[which], 0.0}, 0.0, 0.0, 0.0);
}

/* Returns the moments of a quantity with the value and these derivatives, without the law. */
static mixture_component spectrum_moments(const wt_posterior *p,
                                          const posterior_component *component, double value,
                                          const double *by_unknown)
{
    const struct linear_quantity x = {.value = value,
                                      .variance =
                                          cell_variance(p, component->cell, by_unknown, p->scratch),
                                      .with = p->scratch};
    return component_moments(p, component, &x);
}

/* Sums the terms [from, end) and computes the derivatives of ln of the sum times `sign`
 * [n_unknowns]. */
static double sum_term_moduli(const double *value, size_t from, size_t end, double sign,
                              double *by_unknown)
{
    double sum = 0.0;
    for (size_t j = from; j < end; j++)
        sum += exp(value[j]);
    for (size_t j = from; j < end; j++)
        by_unknown[j] = sign * exp(value[j]) / sum;
    return sum;
}

/* The modulus at the end of the measured times is measured, the share that relaxes later is not.
 * The logarithms of unmeasured terms are normal. The ratio of their sum to the rest is treated
 * as log-normal. */
wt_interval posterior_equilibrium(const wt_posterior *p)
{
    mixture_component share[SPECTRUM_ENDS * MAX_COMPONENTS], measured[MAX_COMPONENTS];
    const spectrum *s = &p->frame;
    double *by_unknown = p->scratch + s->n_curves;
    double left = 0.0;
    size_t n = 0;
    memset(by_unknown, 0, s->n_unknowns * sizeof *by_unknown);
    for (size_t i = 0; i < p->n_components; i++) {
        const double *value = p->components[i].cell->value;
        const double all = sum_term_moduli(value, s->n_measured, s->n_terms + 1, 1.0, by_unknown);
        measured[i] = spectrum_moments(p, &p->components[i], log(all), by_unknown);
        for (size_t place = 0; place < SPECTRUM_ENDS; place++) {
            const size_t end = spectrum_end_term(s, place);
            const double later = sum_term_moduli(value, s->n_measured, end, 1.0, by_unknown);
            const double rest = sum_term_moduli(value, end, s->n_terms + 1, -1.0, by_unknown);
            share[n] = spectrum_moments(p, &p->components[i], log(later / rest), by_unknown);
            share[n].weight /= SPECTRUM_ENDS;
            left -= share[n].weight * log1p(exp(share[n].mean));
            n++;
        }
    }
    const wt_interval of_share = mixture_interval(share, n),
                      at_end = mixture_interval(measured, p->n_components);
    wt_interval e = {.value = at_end.value + left};
    e.low = e.value - hypot(left + log1p(exp(of_share.high)), at_end.value - at_end.low);
    e.high = e.value + hypot(left + log1p(exp(of_share.low)), at_end.high - at_end.value);
    e.standard_error = (e.high - e.low) / (2.0 * NORMAL_95);
    return e;
}

wt_interval posterior_term(const wt_posterior *p, size_t term, double slope)
{
    double mean[LAW_MAX_UNKNOWNS];
    posterior_mean_law(p, mean);
    return interval_offset(offset_unknown_interval(p, (long[]){(long)term, -1},
                                                   (double[]){1.0, 0.0}, 0.0, 0.0, slope * M_LN10),
                           slope * M_LN10 * mean[0]);
}

/* ---- means and draws ------------------------------------------------------------------------- */

/* Adds the change of all unknowns due to a gap between law and shifts (times S^-1). */
static void add_law_pull(const wt_posterior *p, const posterior_component *component,
                         const gsl_vector *pull, double scale, double *value)
{
    const spectrum *s = &p->frame;
    const bordered_matrix *factor = &component->cell->factor;
    arena memory = {0};
    double *border = arena_numbers(&memory, factor->m),
           *side = arena_numbers(&memory, BLOCK_SIDE * factor->n),
           *change = arena_numbers(&memory, s->n_unknowns);
    for (size_t k = 0; pull != NULL && k < s->n_curves; k++)
        side[BLOCK_SIDE * k] = s->column_a[k] < 0 ? 0.0 : scale * gsl_vector_get(pull, k) / M_LN10;
    bordered_solve_lower(factor, border, side);
    bordered_solve_upper(factor, border, side);
    spectrum_join(s, border, side, change);
    for (size_t u = 0; u < s->n_unknowns; u++)
        value[u] += change[u];
    arena_free(&memory);
}

void posterior_mean(const wt_posterior *p, double *value)
{
    memset(value, 0, p->frame.n_unknowns * sizeof *value);
    for (size_t i = 0; i < p->n_components; i++) {
        for (size_t u = 0; u < p->frame.n_unknowns; u++)
            value[u] += p->components[i].weight * p->components[i].cell->value[u];
        add_law_pull(p, &p->components[i], p->components[i].pull, p->components[i].weight, value);
    }
}

void posterior_mean_law(const wt_posterior *p, double unknown[LAW_MAX_UNKNOWNS])
{
    memset(unknown, 0, LAW_MAX_UNKNOWNS * sizeof *unknown);
    for (size_t i = 0; i < p->n_components; i++)
        for (size_t u = 0; u < LAW_MAX_UNKNOWNS; u++)
            unknown[u] += p->components[i].weight * p->components[i].law.unknown[u];
}

struct random_stream {
    uint64_t state;
};

static double draw_uniform(struct random_stream *s)
{
    s->state = splitmix64(s->state);
    return ((double)(s->state >> 11) + 0.5) * 0x1p-53;
}

static double draw_normal(struct random_stream *s)
{
    const double radius = sqrt(-2.0 * log(draw_uniform(s)));
    return radius * cos(2.0 * M_PI * draw_uniform(s));
}

/* Selects the component of a draw. Consecutive draws cover the mixture evenly, in steps of the
 * golden ratio. */
static const posterior_component *draw_component(const wt_posterior *p, uint64_t seed, size_t index)
{
    struct random_stream start = {splitmix64(seed)};
    double at = fmod(draw_uniform(&start) + (double)index * 0.6180339887498949, 1.0);
    for (size_t i = 0; i + 1 < p->n_components; i++) {
        if (at < p->components[i].weight)
            return &p->components[i];
        at -= p->components[i].weight;
    }
    return &p->components[p->n_components - 1];
}

/* Selects the end of the spectrum of a draw evenly, so that the draws of one component have all
 * ends. */
size_t posterior_end_index(uint64_t seed, size_t index)
{
    struct random_stream start = {splitmix64(splitmix64(seed))};
    const double at =
        fmod(draw_uniform(&start) + (double)index * 0.7548776662466927, 1.0); /* plastic number */
    return (size_t)(at * SPECTRUM_ENDS);
}

double posterior_temperature_draw(uint64_t seed, size_t index)
{
    struct random_stream s = {splitmix64(splitmix64(splitmix64(seed)) ^ (uint64_t)index)};
    return draw_normal(&s);
}

/* Draws the unknowns of the law. */
static void draw_law(const posterior_component *component, struct random_stream *s,
                     double unknown[LAW_MAX_UNKNOWNS])
{
    const size_t n = component->law.n_unknowns;
    double factor[LAW_MAX_UNKNOWNS * LAW_MAX_UNKNOWNS], e[LAW_MAX_UNKNOWNS];
    gsl_matrix_view root = gsl_matrix_view_array(factor, n, n);
    gsl_matrix_const_view covariance = gsl_matrix_const_view_array_with_tda(
        &component->law.covariance[0][0], n, n, LAW_MAX_UNKNOWNS);
    posterior_root(&covariance.matrix, &root.matrix);
    for (size_t u = 0; u < n; u++) {
        e[u] = draw_normal(s);
        for (size_t v = 0; v <= u; v++)
            unknown[u] += factor[u * n + v] * e[v];
    }
}

/* Limits the rise of a term. The response of the moduli is normal and linear in ln g near the
 * best fit. An unmeasured term has a standard deviation of tens in ln g, which the isotherms
 * exclude. Above 1 the draw continues along the tangent. */
static void linearise_draw(const wt_posterior *p, const posterior_component *component,
                           double *value)
{
    for (size_t j = 0; j < p->frame.n_linear; j++) {
        const double rise = value[j] - component->cell->value[j];
        if (rise > 1.0)
            value[j] = component->cell->value[j] + 1.0 + log(rise);
    }
}

/* Subtracts the drawn additional errors of the shifts from the gap; e: [n_curves] scratch. */
static void draw_extra_errors(const wt_posterior *p, struct random_stream *s, double *e,
                              gsl_vector *gap)
{
    for (size_t k = 0; k < p->frame.n_curves; k++) {
        e[k] = draw_normal(s);
        for (size_t i = 0; i <= k; i++)
            *gsl_vector_ptr(gap, k) -= gsl_matrix_get(p->extra_covariance_root, k, i) * e[i];
    }
}

/* Draws spectrum and shifts without the law, then moves them towards the drawn law. */
void posterior_draw(const wt_posterior *p, uint64_t seed, size_t index, double *value,
                    double unknown[LAW_MAX_UNKNOWNS], double *log_b)
{
    const size_t n = p->frame.n_unknowns, n_curves = p->frame.n_curves;
    const posterior_component *component = draw_component(p, seed, index);
    const bordered_matrix *factor = &component->cell->factor;
    struct random_stream s = {splitmix64(splitmix64(seed) ^ (uint64_t)index)};
    arena memory = {0};
    gsl_vector *gap = arena_vector(&memory, n_curves);
    double *border = arena_numbers(&memory, factor->m),
           *side = arena_numbers(&memory, BLOCK_SIDE * n_curves);
    for (size_t u = 0; u < factor->m; u++)
        border[u] = draw_normal(&s);
    for (size_t u = 0; u < BLOCK_SIDE * n_curves; u++)
        side[u] = draw_normal(&s);
    bordered_solve_upper(factor, border, side);
    spectrum_join(&p->frame, border, side, value);
    for (size_t u = 0; u < n; u++)
        value[u] += component->cell->value[u];
    memcpy(unknown, component->law.unknown, LAW_MAX_UNKNOWNS * sizeof *unknown);
    if (component->law.n_unknowns > 0) {
        draw_law(component, &s, unknown);
        for (size_t k = 0; k < n_curves; k++) {
            const double law = law_isotherm_value(&p->data, &p->shape, unknown, k),
                         a = posterior_shift(p, value, k) / M_LN10;
            gsl_vector_set(gap, k, law - a - component->spread * p->slope[k] * draw_normal(&s));
        }
        if (p->extra_covariance_root != NULL)
            draw_extra_errors(p, &s, side, gap);
        gsl_linalg_cholesky_svx(component->root, gap);
        add_law_pull(p, component, gap, 1.0, value);
    }
    linearise_draw(p, component, value);
    posterior_smooth_b(p, component->cell, value, log_b);
    arena_free(&memory);
}
