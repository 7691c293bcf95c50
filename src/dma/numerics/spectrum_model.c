/* Model of all isotherms by one relaxation spectrum: residuals, derivatives and normal
 * equations.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include "core/math/arena_gsl.h"
#include "core/math/blocked_product.h"
#include "core/math/cholesky.h"

#include <math.h>
#include <string.h>

/* Standard deviation of the prior of ln E_inf about a third of the lowest E': a factor 20 either
 * way. It covers what the data leave open and is weak compared to them. */
static const double equilibrium_spread = 3.0;
/* Maximum span of the shifted isotherms [decade]; a larger one indicates a wrong unit. Molecular
 * vibrations, 1e13 Hz, to a century, 1e-10 Hz, span 23, and WLF with universal constants gives
 * 17. It also limits the number of terms. */
static const double most_decades = 100.0;
/* Start slope of the terms beyond the slowest measured point: that of the Rouse spectrum. */
static const double start_fall = 0.5;
/* Limits of the start slope of ln E'. A spectrum allows 0 to 2: slope 0 has no loss, and 2
 * relaxes outside the range. */
static const double flattest = 0.01, steepest = 1.5;

/* Products of the rows are formed again when the moduli have changed by more than this since, the
 * sum of squares in standard deviations of the noise: 0.3 standard errors. The gradient is always
 * that of the present rows, so that the minimum does not depend on it. */
static const double most_change = 0.1;

/* ---- beyond the measured range --------------------------------------------------------------- */

/* Extension of the relaxation times beyond the measured range [decade]. E'' of a term 4.5
 * decades faster is 3e-5 of its modulus at the highest frequency, so faster terms act as a glass
 * modulus. Six slow decades convert a second to two weeks and an hour to a century. */
static const double fast_margin = 4.5, slow_margin = 6.0;

/* Distance beyond the ends with the measured prior [decade]. E'' of such a term is a tenth of
 * its modulus at the end, so it is measured. */
static const double measured_margin = 1.0;

/* Beyond that distance the slope d ln H/d ln tau tends to a mean known for rubber, with this
 * scatter and correlation length in decades. At short times the mean is 0. It lies between -1/2
 * of Rouse chains, the slope of a transition (Ferry, Viscoelastic Properties of Polymers, 1980,
 * chapter 10), and the opposite slope beyond its peak. */
static const double fast_slope = 0.0, fast_scatter = 0.5, fast_reach = 2.0;

/* At long times networks relax by a power of time (Chasset and Thirion, Proc. Conf. Phys.
 * Non-Cryst. Solids, 1965; Curro and Pincus, Macromolecules 16 (1983) 559). Measured exponents
 * are 0.1 to 0.4 and persist for decades. */
static const double slow_slope = -0.25, slow_scatter = 0.15, slow_reach = 4.0;

size_t spectrum_end_term(const spectrum *s, size_t place)
{
    return s->n_measured + (s->n_terms - s->n_measured) * (place + 1) / SPECTRUM_ENDS;
}

static void set_extrapolation(spectrum *s)
{
    const size_t margin = (size_t)ceil(measured_margin * M_LN10 / s->step);
    s->bend_first = s->n_fast - margin;
    s->bend_end = s->n_measured + margin;
    const double decay[2] = {exp(-s->step / (fast_reach * M_LN10)),
                             exp(-s->step / (slow_reach * M_LN10))};
    const double scatter[2] = {fast_scatter * s->step, slow_scatter * s->step};
    const double slope[2] = {-fast_slope * s->step, slow_slope * s->step};
    for (int end = 0; end < 2; end++) { /* in the outward direction */
        const double k = decay[end];
        s->beyond[end] = (spectrum_extrapolation){
            .weight = {end == 0 ? 1.0 : k, -1.0 - k, end == 0 ? k : 1.0},
            .mean = (1.0 - k) * slope[end],
            .precision = 1.0 / (scatter[end] * scatter[end] * (1.0 - k * k))};
    }
}

/* ---- construction ---------------------------------------------------------------------------- */

static void allocate_spectrum(spectrum *s)
{
    arena *m = &s->memory;
    const size_t most = s->n_shared + 2 * s->n_curves;
    const size_t n_smooth = s->n_curves < SPECTRUM_MAX_SMOOTH ? s->n_curves : SPECTRUM_MAX_SMOOTH;
    const size_t border = s->n_shared + n_smooth;
    s->first = arena_alloc(m, s->n_curves + 1, sizeof *s->first);
    s->column_a = arena_alloc(m, s->n_curves, sizeof *s->column_a);
    s->column_b = arena_alloc(m, s->n_curves, sizeof *s->column_b);
    s->given = arena_alloc(m, s->n_curves, sizeof *s->given);
    s->lossless = arena_alloc(m, s->n_curves, sizeof *s->lossless);
    s->given_a = arena_numbers(m, s->n_curves);
    s->given_b = arena_numbers(m, s->n_curves);
    s->x = arena_numbers(m, s->n);
    s->copy = arena_numbers(m, s->n);
    for (int q = 0; q < MODULI; q++) {
        s->y[q] = arena_numbers(m, s->n);
        s->weight[q] = arena_numbers(m, s->n);
        s->previous_weight[q] = arena_numbers(m, s->n);
        s->spread[q] = arena_numbers(m, s->n);
        s->residual[q] = arena_numbers(m, s->n);
        s->row[q] = arena_numbers(m, (s->n + TILE_ROWS - 1) * (s->n_shared + 2));
        s->normal[q] = bordered_new(m, s->n_shared, s->n_curves);
        s->normal_residual[q] = arena_numbers(m, s->n);
        s->right[q] = arena_numbers(m, most);
    }
    s->kappa = arena_numbers(m, s->n_curves);
    s->bend = arena_numbers(m, s->n_terms);
    s->term = arena_numbers(m, s->n_linear);
    s->time = arena_numbers(m, s->n_terms);
    s->value = arena_numbers(m, most);
    s->candidate = arena_numbers(m, most);
    s->kept_value = arena_numbers(m, most);
    s->precision = bordered_new(m, border, s->n_curves);
    s->covariance = bordered_new(m, border, s->n_curves);
    s->factor = bordered_new(m, border, s->n_curves);
    s->scratch = arena_matrix(m, border, border);
    s->border = arena_numbers(m, border);
    s->side = arena_numbers(m, BLOCK_SIDE * s->n_curves);
    s->gradient = arena_vector(m, most);
    s->direction = arena_vector(m, most);
    if (s->loading == WT_CREEP)
        spectrum_modes_new(s);
}

void spectrum_free(spectrum *s)
{
    arena_free(&s->memory);
    *s = (spectrum){0};
}

/* Returns ln E'' of a point, an estimate from the slope of E' (local Kramers-Kronig), or ln tan
 * delta. */
static double estimated_loss(const spectrum *s, size_t curve, size_t k)
{
    if (s->used[LOSS])
        return s->y[LOSS][k];
    const size_t from = k > s->first[curve] ? k - 1 : k,
                 to = k + 1 < s->first[curve + 1] ? k + 1 : k;
    const double rise = s->y[STORAGE][to] - s->y[STORAGE][from], width = s->x[to] - s->x[from];
    const double slope = width > 0.0 ? fmax(flattest, fmin(steepest, rise / width)) : flattest;
    return s->y[STORAGE][k] + log(slope * M_PI / 2.0);
}

/* Interpolates that value at ln w = `at` from the nearest shifted points. */
static double loss_at(const spectrum *s, double at, const double *a, const double *b)
{
    double sum = 0.0, weights = 0.0;
    for (size_t i = 0; i < s->n_curves; i++)
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
            const double away = (s->x[k] + a[i] - at) / s->step;
            const double w = 1.0 / (1e-2 + away * away * away * away);
            sum += w * (estimated_loss(s, i, k) + b[i]);
            weights += w;
        }
    return sum / weights;
}

/* Sets the start terms from E'' at the frequency of each term. For tan delta alone E' starts at
 * 1 and rises by 2/pi delta. */
static void set_start_terms(spectrum *s, const double *a, const double *b)
{
    double lowest = HUGE_VAL, slowest = HUGE_VAL, fastest = -HUGE_VAL, level = 0.0;
    const int q = s->used[STORAGE] ? STORAGE : LOSS;
    for (size_t i = 0; i < s->n_curves; i++) {
        slowest = fmin(slowest, s->x[s->first[i]] + a[i]);
        fastest = fmax(fastest, s->x[s->first[i + 1] - 1] + a[i]);
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++)
            lowest = fmin(lowest, s->y[q][k] + b[i]);
    }
    if (s->ratio)
        lowest = 0.0;
    s->level = 0.0;
    for (size_t j = s->n_terms; j-- > 0;) { /* from slow to fast */
        const double at = -(s->log_tau + (double)j * s->step), near = loss_at(s, at, a, b);
        if (s->ratio && at > slowest && at < fastest)
            level += 2.0 / M_PI * atan(exp(near)) * s->step;
        /* the start falls beyond the measured range; slow terms belong to the equilibrium
         * modulus */
        s->value[j] = near + level + log(s->step * 2.0 / M_PI) - start_fall * fmax(slowest - at, 0);
        s->level += s->value[j] / (double)s->n_terms;
    }
    s->equilibrium_mean = lowest - 1.0;
    s->equilibrium_spread = equilibrium_spread;
    if (!s->liquid)
        s->value[s->n_terms] = lowest - 0.5;
}

wt_status spectrum_new(const shift_set *set, const bool *use, size_t anchor, const double *a,
                       const double *b, double terms_per_decade, double margin, bool liquid,
                       spectrum *s, wt_error *err)
{
    const double fast = fmin(fast_margin, margin), slow = fmin(slow_margin, margin);
    double low = HUGE_VAL, high = -HUGE_VAL;
    *s = (spectrum){.liquid = liquid,
                    .loading = set->loading,
                    .used = {set->used[STORAGE], set->used[LOSS]},
                    .ratio = set->quantity == WT_SHIFT_LOSS_FACTOR,
                    .step = M_LN10 / terms_per_decade};
    for (size_t i = 0; i < set->n; i++) {
        const shift_curve *c = &set->curves[i];
        if (!use[i])
            continue;
        if (i == anchor)
            s->anchor = s->level_curve = s->n_curves;
        s->n_curves++;
        s->n += c->n;
        low = fmin(low, c->x[0] + a[i]);
        high = fmax(high, c->x[c->n - 1] + a[i]);
    }
    if (!(high - low <= most_decades)) {
        wt_fail(err, WT_E_RANGE, "the shifted isotherms span %.3g decades of frequency",
                high - low);
        wt_error_expected(err, "at most %g", most_decades);
        wt_error_advice(err, "check the unit of the frequencies, and the shifts if they are given");
        return WT_E_RANGE;
    }
    s->n_fast = (size_t)ceil(fast * terms_per_decade);
    s->n_measured = (size_t)ceil((high + fast - low) * terms_per_decade);
    s->n_terms = 1 + s->n_measured + (size_t)ceil(slow * terms_per_decade);
    s->n_linear = s->n_terms + (liquid ? 0 : 1);
    s->n_shared = s->n_linear + instrument_unknowns(set);
    s->log_tau = -(high + fast) * M_LN10;
    allocate_spectrum(s);
    double *start = s->candidate; /* a, then b */
    size_t curve = 0, k = 0;
    for (size_t i = 0; i < set->n; i++) {
        const shift_curve *c = &set->curves[i];
        if (!use[i])
            continue;
        s->first[curve] = k;
        s->lossless[curve] = c->is_loss_excluded;
        for (size_t p = 0; p < c->n; p++, k++) {
            s->x[k] = c->x[p] * M_LN10;
            for (int q = 0; q < MODULI; q++) {
                s->y[q][k] = c->y[q][p] * M_LN10;
                s->weight[q][k] = spectrum_is_fitted(s, curve, q) ? 1.0 : 0.0;
                s->spread[q][k] = 1.0;
            }
        }
        start[curve] = a[i] * M_LN10;
        s->given[curve] = c->is_shift_fixed || i == anchor;
        s->given_a[curve] = (a[i] - a[anchor]) * M_LN10;
        s->given_b[curve] = c->is_vertical_fixed ? b[i] * M_LN10 : (double)NAN;
        start[s->n_curves + curve] = b[i] * M_LN10;
        s->kappa[curve++] = 1.0;
    }
    s->first[curve] = k;
    instrument_set_priors(s);
    set_start_terms(s, start, start + s->n_curves);
    s->smoothness = 0.3;
    for (size_t j = 0; j < s->n_terms; j++) {
        s->bend[j] = 1.0;
        s->time[j] = exp((double)j * s->step);
    }
    set_extrapolation(s);
    for (int q = 0; q < MODULI; q++)
        s->noise[q] = 0.05;
    /* until a prior is set: the shifts follow the terms, including the anchor */
    s->n_unknowns = s->n_shared;
    for (size_t i = 0; i < s->n_curves; i++) {
        s->column_a[i] = (long)s->n_unknowns;
        s->value[s->n_unknowns++] = start[i] - start[s->anchor];
        s->column_b[i] = (long)s->n_unknowns;
        s->value[s->n_unknowns++] = start[s->n_curves + i];
    }
    return WT_OK;
}

bool spectrum_is_fitted(const spectrum *s, size_t curve, int q)
{
    return s->used[q] && !(q == LOSS && s->lossless[curve]);
}

double spectrum_a(const spectrum *s, size_t curve)
{
    return s->column_a[curve] < 0 ? s->given_a[curve] : s->value[s->column_a[curve]];
}

double spectrum_trial_b(const spectrum *s, const double *value, size_t curve)
{
    if (s->column_b[curve] >= 0)
        return value[s->column_b[curve]];
    return isnan(s->given_b[curve]) ? s->prior->mean[curve] : s->given_b[curve];
}

double spectrum_b(const spectrum *s, size_t curve)
{
    return spectrum_trial_b(s, s->value, curve);
}

void spectrum_terms(const spectrum *s, const double *value, double *term)
{
    for (size_t j = 0; j < s->n_linear; j++)
        term[j] = exp(value[j]);
}

void spectrum_set_prior(spectrum *s, const spectrum_prior *prior)
{
    double *shift = s->candidate; /* a, b of all curves */
    for (size_t i = 0; i < s->n_curves; i++) {
        shift[2 * i] = spectrum_a(s, i);
        shift[2 * i + 1] = spectrum_b(s, i);
    }
    s->prior = prior;
    s->n_unknowns = s->n_shared;
    for (size_t i = 0; i < s->n_curves; i++) {
        s->column_a[i] = s->column_b[i] = -1;
        if (!s->given[i]) {
            s->column_a[i] = (long)s->n_unknowns;
            s->value[s->n_unknowns++] = shift[2 * i];
        }
    }
    for (size_t i = 0; i < s->n_curves; i++)
        if (!prior->held && isnan(s->given_b[i]) &&
            (prior->precision != NULL || i != s->level_curve)) {
            s->column_b[i] = (long)s->n_unknowns;
            s->value[s->n_unknowns++] = shift[2 * i + 1];
        }
}

/* ---- moduli ---------------------------------------------------------------------------------- */

/* Sums over the terms at a frequency: E', E'' and their slopes. */
enum { SUMS = 2 * MODULI };

/* Adds one SIMD vector of terms; storage_at, loss_at: E' and E'' of each term, or NULL. */
WIDE_INLINE void add_term_lanes(const double *term, const double *time, double first,
                                wide sum[SUMS], double *storage_at, double *loss_at)
{
    wide e, z;
    simd_load(&e, term);
    simd_load(&z, time);
    z *= first;
    const wide share = z / (1.0 + z * z), loss = e * share, storage = loss * z;
    sum[STORAGE] += storage;
    sum[LOSS] += loss;
    sum[MODULI + STORAGE] += 2.0 * loss * share;
    sum[MODULI + LOSS] += loss * (1.0 - 2.0 * z * share);
    if (storage_at != NULL) {
        simd_store(storage_at, &storage);
        simd_store(loss_at, &loss);
    }
}

/* Sums the moduli and their slopes at a frequency over all terms with times first * s->time. */
WIDE_REGISTERS
static void sum_moduli(const spectrum *s, const double *term, double first, double total[SUMS],
                       double *const by[MODULI])
{
    wide sum[SUMS] = {{0.0}};
    const size_t whole = s->n_terms / WIDE * WIDE, rest = s->n_terms - whole;
    for (size_t j = 0; j < whole; j += WIDE)
        add_term_lanes(term + j, s->time + j, first, sum, by != NULL ? by[STORAGE] + j : NULL,
                       by != NULL ? by[LOSS] + j : NULL);
    if (rest > 0) {
        double last[WIDE] = {0.0}, time[WIDE] = {0.0}, storage[WIDE], loss[WIDE];
        memcpy(last, term + whole, rest * sizeof *last);
        memcpy(time, s->time + whole, rest * sizeof *time);
        add_term_lanes(last, time, first, sum, storage, loss);
        if (by != NULL) {
            memcpy(by[STORAGE] + whole, storage, rest * sizeof *storage);
            memcpy(by[LOSS] + whole, loss, rest * sizeof *loss);
        }
    }
    for (int i = 0; i < SUMS; i++)
        total[i] = simd_sum(&sum[i]);
}

WIDE_REGISTERS
static void scale_row(double *row, size_t n, double by)
{
    for (size_t j = 0; j < n; j++)
        row[j] *= by;
}

void spectrum_moduli(const spectrum *s, const double *term, double x, double log_modulus[MODULI],
                     double slope[MODULI], double *const gradient[MODULI])
{
    const double equilibrium = s->liquid ? 0.0 : term[s->n_terms];
    double total[SUMS];
    sum_moduli(s, term, exp(x + s->log_tau), total, gradient);
    total[STORAGE] += equilibrium;
    for (int q = 0; q < MODULI; q++) {
        log_modulus[q] = log(total[q]);
        slope[q] = total[MODULI + q] / total[q];
        if (gradient != NULL)
            scale_row(gradient[q], s->n_terms, 1.0 / total[q]);
    }
    if (gradient != NULL && !s->liquid) {
        gradient[STORAGE][s->n_terms] = equilibrium / total[STORAGE];
        gradient[LOSS][s->n_terms] = 0.0;
    }
}

void spectrum_measured_moduli(const spectrum *s, const double *term, double x,
                              double log_modulus[MODULI], double slope[MODULI],
                              double *const gradient[MODULI])
{
    if (s->loading == WT_OSCILLATION) {
        spectrum_moduli(s, term, x, log_modulus, slope, gradient);
        return;
    }
    log_modulus[LOSS] = slope[LOSS] = 0.0;
    if (gradient != NULL)
        memset(gradient[LOSS], 0, s->n_linear * sizeof *gradient[LOSS]);
    spectrum_step_response(s, term, x, &log_modulus[STORAGE], &slope[STORAGE],
                           gradient != NULL ? gradient[STORAGE] : NULL);
}

/* ---- rows ------------------------------------------------------------------------------------ */

double spectrum_weight(const spectrum *s, size_t k, int q)
{
    return sqrt(s->weight[q][k]) / s->spread[q][k];
}

/* Finds the included point before point k of a curve. Returns false if there is none. */
static bool previous_point(const spectrum *s, size_t curve, int q, size_t k, size_t *before)
{
    while (k > s->first[curve] && s->weight[q][k - 1] == 0.0)
        k--;
    *before = k > 0 ? k - 1 : 0;
    return k > s->first[curve];
}

void spectrum_whiten(const spectrum *s, size_t curve, int q, double *v, size_t width)
{
    const size_t from = s->first[curve];
    size_t at, before;
    if (s->rho == 0.0 || !previous_point(s, curve, q, s->first[curve + 1], &at))
        return;
    for (; previous_point(s, curve, q, at, &before); at = before) {
        const double rho = at - before == 1 ? s->rho : pow(s->rho, (double)(at - before));
        const double scale = 1.0 / sqrt(1.0 - rho * rho);
        for (size_t j = 0; j < width; j++)
            v[(at - from) * width + j] =
                (v[(at - from) * width + j] - rho * v[(before - from) * width + j]) * scale;
    }
}

double spectrum_log_det_correlation(const spectrum *s)
{
    const double of_neighbours = log(1.0 - s->rho * s->rho);
    double sum = 0.0;
    for (size_t i = 0; i < s->n_curves && s->rho != 0.0; i++)
        for (int q = 0; q < MODULI; q++) {
            size_t at, before;
            if (!previous_point(s, i, q, s->first[i + 1], &at))
                continue;
            for (; previous_point(s, i, q, at, &before); at = before)
                sum += at - before == 1 ? of_neighbours
                                        : log(1.0 - pow(s->rho, 2.0 * (double)(at - before)));
        }
    return sum;
}

/* Converts ln E'' and its derivatives to those of ln tan delta. */
static void convert_to_loss_factor(const spectrum *s, double modulus[MODULI], double slope[MODULI],
                                   double *const row[MODULI])
{
    modulus[LOSS] -= modulus[STORAGE];
    slope[LOSS] -= slope[STORAGE];
    for (size_t j = 0; row != NULL && j < s->n_linear; j++)
        row[LOSS][j] -= row[STORAGE][j];
}

void spectrum_evaluate(spectrum *s, const double *value, bool with_rows)
{
    const size_t m = s->n_shared, width = m + 2;
    s->evaluations++;
    spectrum_terms(s, value, s->term);
    for (size_t i = 0; i < s->n_curves; i++) {
        const double a = s->column_a[i] < 0 ? s->given_a[i] : value[s->column_a[i]];
        const double b = spectrum_trial_b(s, value, i);
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
            double *const row[MODULI] = {s->row[STORAGE] + k * width, s->row[LOSS] + k * width};
            double modulus[MODULI], slope[MODULI], by[MODULI][INSTRUMENT_ERRORS];
            double measured[MODULI] = {s->y[STORAGE][k], s->y[LOSS][k]};
            spectrum_measured_moduli(s, s->term, s->x[k] + a, modulus, slope,
                                     with_rows ? row : NULL);
            if (s->ratio)
                convert_to_loss_factor(s, modulus, slope, with_rows ? row : NULL);
            if (m > s->n_linear)
                instrument_correct(s, value + s->n_linear, k, measured, by);
            for (int q = 0; q < MODULI; q++) {
                const double w = spectrum_weight(s, k, q);
                s->residual[q][k] = w * (measured[q] - modulus[q] + (s->ratio ? 0.0 : b));
                if (with_rows)
                    scale_row(row[q], s->n_linear, w);
                for (size_t u = s->n_linear; u < m; u++)
                    row[q][u] =
                        u - s->n_linear < FRAME_COMPLIANCE ? -w * by[q][u - s->n_linear] : 0.0;
                row[q][m] = w * slope[q];
                row[q][m + 1] = s->ratio ? 0.0 : -w;
            }
        }
        for (int q = 0; q < MODULI; q++) {
            spectrum_whiten(s, i, q, s->residual[q] + s->first[i], 1);
            if (with_rows)
                spectrum_whiten(s, i, q, s->row[q] + s->first[i] * width, width);
        }
    }
}

/* ---- normal equations ------------------------------------------------------------------------ */

/* Adds the products of all rows to the block of the terms. The upper triangle is complete. */
WIDE_REGISTERS
static void add_row_products(gsl_matrix *normal, size_t m, const double *row, size_t width,
                             size_t rows)
{
    rows = (rows + TILE_ROWS - 1) / TILE_ROWS * TILE_ROWS; /* the rows after the last are zeros */
    for (size_t i = 0; i < m; i += TILE)
        for (size_t j = i; j < m; j += TILE)
            tile_add_product(gsl_matrix_ptr(normal, i, j), m - i, m - j, normal->tda,
                             (tile_rows){row + i, row + j, width, width, rows}, false);
}

/* Adds the products of the shifts of a curve with the terms and with each other. */
static void add_shift_products(spectrum *s, size_t curve, int q)
{
    const size_t m = s->n_shared, width = m + 2, n = s->first[curve + 1] - s->first[curve];
    const long column[BLOCK_SIDE] = {s->column_a[curve], s->column_b[curve]};
    const double *first = s->row[q] + s->first[curve] * width;
    double *diagonal = s->normal[q].diagonal + BLOCK_DIAGONAL * curve;
    for (size_t c = 0; c < BLOCK_SIDE; c++) {
        if (column[c] < 0)
            continue;
        dense_add_rows(gsl_matrix_ptr(s->normal[q].side, BLOCK_SIDE * curve + c, 0), m,
                       first + m + c, width, first, width, n);
        for (size_t k = 0; k < n; k++) {
            const double *shift = first + k * width + m;
            for (size_t d = 0; d <= c; d++)
                diagonal[c + d] += column[d] >= 0 ? shift[c] * shift[d] : 0.0;
        }
    }
}

/* Forms the products of the rows of a modulus with each other. */
static void form_products(spectrum *s, int q)
{
    const size_t m = s->n_shared, width = m + 2;
    gsl_matrix *normal = s->normal[q].border;
    bordered_zero(&s->normal[q]);
    for (size_t k = 0; k < s->n; k += TILE_CACHED_ROWS) /* the last rows are zeros */
        add_row_products(normal, m, s->row[q] + k * width, width,
                         k + TILE_CACHED_ROWS < s->n ? TILE_CACHED_ROWS : s->n - k);
    for (size_t i = 0; i < s->n_curves; i++)
        add_shift_products(s, i, q);
    for (size_t i = 0; i < m; i++) /* lower triangle */
        for (size_t j = 0; j < i; j++)
            gsl_matrix_set(normal, i, j, gsl_matrix_get(normal, j, i));
    memcpy(s->normal_residual[q], s->residual[q], s->n * sizeof *s->residual[q]);
    s->normal_unknowns = s->n_unknowns;
}

/* Returns true if the products of earlier rows serve: the unknowns are the same, and the residuals
 * have changed by little, which they do not if the weights change. */
static bool products_serve(const spectrum *s)
{
    double sum = 0.0;
    for (int q = 0; q < MODULI; q++)
        for (size_t k = 0; s->used[q] && k < s->n; k++)
            sum += pow((s->residual[q][k] - s->normal_residual[q][k]) / s->noise[q], 2);
    return s->may_reuse && s->normal_unknowns == s->n_unknowns && sum < most_change;
}

void spectrum_normal(spectrum *s)
{
    const size_t m = s->n_shared, width = m + 2;
    const bool serve = products_serve(s);
    for (int q = 0; q < MODULI; q++) {
        if (!s->used[q])
            continue; /* its rows are zeros */
        if (!serve)
            form_products(s, q);
        memset(s->right[q], 0, s->n_unknowns * sizeof *s->right[q]);
        dense_add_rows(s->right[q], m, s->residual[q], 1, s->row[q], width, s->n);
        for (size_t i = 0; i < s->n_curves; i++)
            for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
                const double *shift = s->row[q] + k * width + m;
                if (s->column_a[i] >= 0)
                    s->right[q][s->column_a[i]] += shift[0] * s->residual[q][k];
                if (s->column_b[i] >= 0)
                    s->right[q][s->column_b[i]] += shift[1] * s->residual[q][k];
            }
    }
}

double spectrum_squares(const spectrum *s, int q)
{
    double sum = 0.0;
    for (size_t k = 0; k < s->n; k++)
        sum += s->residual[q][k] * s->residual[q][k];
    return sum;
}
