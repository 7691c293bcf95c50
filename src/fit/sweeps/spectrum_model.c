/* The model of all isotherms by one relaxation spectrum: rows of residuals and derivatives, normal
 * equations, priors. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/spectrum.h"

#include "base/wide.h"
#include "fit/pool_gsl.h"

#include <math.h>

/* Standard deviation of the prior of ln E_inf about a third of the lowest storage modulus: a factor
 * 20 either way, so that it holds what the data leave open, and is nothing beside what they say. */
static const double equilibrium_spread = 3.0;
/* How far the relaxation times go beyond the measured range [decade]. E'' of a term that is slower
 * by d decades is 10^-d of its modulus at the lowest frequency, and what its E' lacks 10^-2d: at
 * 2.5 it is no different from an equilibrium modulus, to 0.3 % and 1e-5. One that is faster by 1.5
 * has 3 % of its modulus in E'' and 0.1 % in E', and those beyond are all alike to E''. */
static const double fast_margin = 1.5, slow_margin = 2.5;
/* Weight of the second differences of terms slower than the measured range: beyond it a spectrum
 * rather goes on as it did, but does not have to. Chosen, for no data are there: 1 is the belief
 * within the range, and leaves the equilibrium modulus wider than it need be; at 4 it is narrower
 * than what a slower process, which may begin there, does to it. */
static const double slow_stiffness = 2.0;
/* Isotherms that span more once shifted have frequencies or shifts of another unit [decade]: from
 * vibrations of molecules, 1e13 Hz, to a century, 1e-10 Hz, are 23, and WLF of universal constants
 * gives 17 above the glass transition. It bounds the terms, too. */
static const double most_decades = 100.0;
/* Slope of the terms to start from beyond the slowest measured point: that of Rouse's spectrum. */
static const double start_fall = 0.5;
/* Slopes of ln E' to start from. A spectrum makes 0 to 2, and both ends have no start: of slope 0
 * there is no loss, and with 2 all relaxes beyond the range. */
static const double flattest = 0.01, steepest = 1.5;
/* Rows that go into the normal equations together: as many as dense_add takes at a time. */
enum { ROWS = 4 };

/* ---- making ---------------------------------------------------------------------------------- */

static wt_status allocate_spectrum(spectrum *s, wt_error *err)
{
    pool *m = &s->memory;
    const size_t most = s->n_linear + 2 * s->n_curves;
    s->first = pool_alloc(m, s->n_curves + 1, sizeof *s->first);
    s->column_a = pool_alloc(m, s->n_curves, sizeof *s->column_a);
    s->column_b = pool_alloc(m, s->n_curves, sizeof *s->column_b);
    s->given = pool_alloc(m, s->n_curves, sizeof *s->given);
    s->given_a = pool_numbers(m, s->n_curves);
    s->given_b = pool_numbers(m, s->n_curves);
    s->x = pool_numbers(m, s->n);
    s->copy = pool_numbers(m, s->n);
    for (int q = 0; q < MODULI; q++) {
        s->y[q] = pool_numbers(m, s->n);
        s->weight[q] = pool_numbers(m, s->n);
        s->was[q] = pool_numbers(m, s->n);
        s->spread[q] = pool_numbers(m, s->n);
        s->residual[q] = pool_numbers(m, s->n);
        s->row[q] = pool_numbers(m, (s->n + ROWS - 1) * (s->n_linear + 2));
        s->normal[q] = pool_matrix(m, most, most);
    }
    s->kappa = pool_numbers(m, s->n_curves);
    s->bend = pool_numbers(m, s->n_terms);
    s->term = pool_numbers(m, s->n_linear);
    s->value = pool_numbers(m, most);
    s->trial = pool_numbers(m, most);
    s->precision = pool_matrix(m, most, most);
    s->covariance = pool_matrix(m, most, most);
    s->factor = pool_matrix(m, most, most);
    s->scratch = pool_matrix(m, most, most);
    s->gradient = pool_vector(m, most);
    s->direction = pool_vector(m, most);
    return m->failed
               ? wt_fail(err, WT_E_MEMORY, "no memory for a spectrum of %zu terms", s->n_terms)
               : WT_OK;
}

void spectrum_free(spectrum *s)
{
    pool_free(&s->memory);
    *s = (spectrum){0};
}

/* ln of what is nearest to E'' at a point: E'' itself, what the slope of E' makes of it
 * (Kramers-Kronig in its local form), or tan delta. */
static double near_loss(const spectrum *s, size_t curve, size_t k)
{
    if (s->used[LOSS])
        return s->y[LOSS][k];
    const size_t from = k > s->first[curve] ? k - 1 : k,
                 to = k + 1 < s->first[curve + 1] ? k + 1 : k;
    const double rise = s->y[STORAGE][to] - s->y[STORAGE][from], width = s->x[to] - s->x[from];
    const double slope = width > 0.0 ? fmax(flattest, fmin(steepest, rise / width)) : flattest;
    return s->y[STORAGE][k] + log(slope * M_PI / 2.0);
}

/* The same at ln w = `at`, of the nearest points once shifted. */
static double loss_at(const spectrum *s, double at, const double *a, const double *b)
{
    double sum = 0.0, weights = 0.0;
    for (size_t i = 0; i < s->n_curves; i++)
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
            const double away = (s->x[k] + a[i] - at) / s->step;
            const double w = 1.0 / (1e-2 + away * away * away * away);
            sum += w * (near_loss(s, i, k) + b[i]);
            weights += w;
        }
    return sum / weights;
}

/* Terms to start from: E'' at the frequency of a term. By tan delta alone E' begins at 1 and rises
 * by 2/pi delta. */
static void start_terms(spectrum *s, const double *a, const double *b)
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
        /* beyond the measured range falling: what is slow is left to the equilibrium modulus */
        s->value[j] = near + level + log(s->step * 2.0 / M_PI) - start_fall * fmax(slowest - at, 0);
        s->level += s->value[j] / (double)s->n_terms;
    }
    s->equilibrium_mean = lowest - 1.0;
    s->equilibrium_spread = equilibrium_spread;
    if (!s->liquid)
        s->value[s->n_terms] = lowest - 0.5;
}

wt_status spectrum_new(const shift_set *set, const bool *use, size_t anchor, const double *a,
                       const double *b, double terms_per_decade, bool liquid, spectrum *s,
                       wt_error *err)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    *s = (spectrum){.liquid = liquid,
                    .used = {set->used[STORAGE], set->used[LOSS]},
                    .ratio = set->by == WT_BY_LOSS_FACTOR,
                    .step = M_LN10 / terms_per_decade};
    for (size_t i = 0; i < set->n; i++) {
        const shift_curve *c = &set->curves[i];
        if (!use[i])
            continue;
        if (i == anchor)
            s->anchor = s->n_curves;
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
    s->n_terms = 1 + (size_t)ceil((high - low + fast_margin + slow_margin) * terms_per_decade);
    s->n_linear = s->n_terms + (liquid ? 0 : 1);
    s->log_tau = -(high + fast_margin) * M_LN10;
    s->n_fast = (size_t)ceil(fast_margin * terms_per_decade);
    s->n_measured = (size_t)ceil((high + fast_margin - low) * terms_per_decade);
    wt_status status = allocate_spectrum(s, err);
    if (status != WT_OK) {
        spectrum_free(s);
        return status;
    }
    double *start = s->trial; /* a, then b */
    size_t curve = 0, k = 0;
    for (size_t i = 0; i < set->n; i++) {
        const shift_curve *c = &set->curves[i];
        if (!use[i])
            continue;
        s->first[curve] = k;
        for (size_t p = 0; p < c->n; p++, k++) {
            s->x[k] = c->x[p] * M_LN10;
            for (int q = 0; q < MODULI; q++) {
                s->y[q][k] = c->y[q][p] * M_LN10;
                s->weight[q][k] = s->used[q] ? 1.0 : 0.0;
                s->spread[q][k] = 1.0;
            }
        }
        start[curve] = a[i] * M_LN10;
        s->given[curve] = c->given || i == anchor;
        s->given_a[curve] = (a[i] - a[anchor]) * M_LN10;
        s->given_b[curve] = c->held ? b[i] * M_LN10 : (double)NAN;
        start[s->n_curves + curve] = b[i] * M_LN10;
        s->kappa[curve++] = 1.0;
    }
    s->first[curve] = k;
    start_terms(s, start, start + s->n_curves);
    s->smooth = 0.3;
    for (size_t j = 0; j < s->n_terms; j++)
        s->bend[j] = 1.0;
    for (int q = 0; q < MODULI; q++)
        s->noise[q] = 0.05;
    /* until a prior is set: shifts lie behind the terms, the anchor's among them */
    s->n_unknowns = s->n_linear;
    for (size_t i = 0; i < s->n_curves; i++) {
        s->column_a[i] = (long)s->n_unknowns;
        s->value[s->n_unknowns++] = start[i] - start[s->anchor];
        s->column_b[i] = (long)s->n_unknowns;
        s->value[s->n_unknowns++] = start[s->n_curves + i];
    }
    return WT_OK;
}

double spectrum_a(const spectrum *s, size_t curve)
{
    return s->column_a[curve] < 0 ? s->given_a[curve] : s->value[s->column_a[curve]];
}

static double b_of(const spectrum *s, const double *value, size_t curve)
{
    if (s->column_b[curve] >= 0)
        return value[s->column_b[curve]];
    return isnan(s->given_b[curve]) ? s->prior->mean[curve] : s->given_b[curve];
}

double spectrum_b(const spectrum *s, size_t curve)
{
    return b_of(s, s->value, curve);
}

void spectrum_terms(const spectrum *s, const double *value, double *term)
{
    for (size_t j = 0; j < s->n_linear; j++)
        term[j] = exp(value[j]);
}

void spectrum_set_prior(spectrum *s, const spectrum_prior *prior)
{
    double *shift = s->trial; /* a, b of all curves */
    for (size_t i = 0; i < s->n_curves; i++) {
        shift[2 * i] = spectrum_a(s, i);
        shift[2 * i + 1] = spectrum_b(s, i);
    }
    s->prior = prior;
    s->n_unknowns = s->n_linear;
    for (size_t i = 0; i < s->n_curves; i++) {
        s->column_a[i] = s->column_b[i] = -1;
        if (!s->given[i]) {
            s->column_a[i] = (long)s->n_unknowns;
            s->value[s->n_unknowns++] = shift[2 * i];
        }
    }
    for (size_t i = 0; i < s->n_curves; i++)
        if (!prior->held && isnan(s->given_b[i]) && (prior->precision != NULL || i != s->anchor)) {
            s->column_b[i] = (long)s->n_unknowns;
            s->value[s->n_unknowns++] = shift[2 * i + 1];
        }
}

/* ---- the moduli ------------------------------------------------------------------------------ */

void spectrum_at(const spectrum *s, const double *term, double x, double log_modulus[MODULI],
                 double slope[MODULI], double *const gradient[MODULI])
{
    const double ratio = exp(s->step);
    double modulus[MODULI] = {s->liquid ? 0.0 : term[s->n_terms], 0.0};
    double rise[MODULI] = {0.0, 0.0};
    double z = exp(x + s->log_tau);
    double *by[MODULI] = {gradient != NULL ? gradient[STORAGE] : NULL,
                          gradient != NULL ? gradient[LOSS] : NULL};
    const double equilibrium = modulus[STORAGE];
    for (size_t j = 0; j < s->n_terms; j++, z *= ratio) {
        const double share = z / (1.0 + z * z);
        const double loss = term[j] * share, storage = loss * z;
        modulus[STORAGE] += storage;
        modulus[LOSS] += loss;
        rise[STORAGE] += 2.0 * loss * share;
        rise[LOSS] += loss * (1.0 - 2.0 * z * share);
        if (gradient != NULL) {
            by[STORAGE][j] = storage;
            by[LOSS][j] = loss;
        }
    }
    for (int q = 0; q < MODULI; q++) {
        log_modulus[q] = log(modulus[q]);
        slope[q] = rise[q] / modulus[q];
        for (size_t j = 0; gradient != NULL && j < s->n_terms; j++)
            by[q][j] /= modulus[q];
    }
    if (gradient != NULL && !s->liquid) {
        by[STORAGE][s->n_terms] = equilibrium / modulus[STORAGE];
        by[LOSS][s->n_terms] = 0.0;
    }
}

/* ---- rows ------------------------------------------------------------------------------------ */

double spectrum_weight(const spectrum *s, size_t k, int q)
{
    return sqrt(s->weight[q][k]) / s->spread[q][k];
}

/* The point that counts before point k of a curve; false if there is none. */
static bool point_before(const spectrum *s, size_t curve, int q, size_t k, size_t *before)
{
    while (k > s->first[curve] && s->weight[q][k - 1] == 0.0)
        k--;
    *before = k > 0 ? k - 1 : 0;
    return k > s->first[curve];
}

void spectrum_whiten(const spectrum *s, size_t curve, int q, double *v, size_t width)
{
    size_t at, before;
    if (s->rho == 0.0 || !point_before(s, curve, q, s->first[curve + 1], &at))
        return;
    for (; point_before(s, curve, q, at, &before); at = before) {
        const double rho = pow(s->rho, (double)(at - before));
        const double scale = 1.0 / sqrt(1.0 - rho * rho);
        for (size_t j = 0; j < width; j++)
            v[at * width + j] = (v[at * width + j] - rho * v[before * width + j]) * scale;
    }
}

double spectrum_log_det_correlation(const spectrum *s)
{
    double sum = 0.0;
    for (size_t i = 0; i < s->n_curves && s->rho != 0.0; i++)
        for (int q = 0; q < MODULI; q++) {
            size_t at, before;
            if (!point_before(s, i, q, s->first[i + 1], &at))
                continue;
            for (; point_before(s, i, q, at, &before); at = before)
                sum += log(1.0 - pow(s->rho, 2.0 * (double)(at - before)));
        }
    return sum;
}

/* tan delta in the place of E''. */
static void to_factor(const spectrum *s, double modulus[MODULI], double slope[MODULI],
                      double *const row[MODULI])
{
    modulus[LOSS] -= modulus[STORAGE];
    slope[LOSS] -= slope[STORAGE];
    for (size_t j = 0; row != NULL && j < s->n_linear; j++)
        row[LOSS][j] -= row[STORAGE][j];
}

void spectrum_evaluate(spectrum *s, const double *value, bool with_rows)
{
    const size_t width = s->n_linear + 2;
    s->evaluations++;
    spectrum_terms(s, value, s->term);
    for (size_t i = 0; i < s->n_curves; i++) {
        const double a = s->column_a[i] < 0 ? s->given_a[i] : value[s->column_a[i]];
        const double b = b_of(s, value, i);
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
            double *const row[MODULI] = {s->row[STORAGE] + k * width, s->row[LOSS] + k * width};
            double modulus[MODULI], slope[MODULI];
            spectrum_at(s, s->term, s->x[k] + a, modulus, slope, with_rows ? row : NULL);
            if (s->ratio)
                to_factor(s, modulus, slope, with_rows ? row : NULL);
            for (int q = 0; q < MODULI; q++) {
                const double w = spectrum_weight(s, k, q);
                s->residual[q][k] = w * (s->y[q][k] - modulus[q] + (s->ratio ? 0.0 : b));
                for (size_t j = 0; with_rows && j < s->n_linear; j++)
                    row[q][j] *= w;
                row[q][s->n_linear] = w * slope[q];
                row[q][s->n_linear + 1] = s->ratio ? 0.0 : -w;
            }
        }
        for (int q = 0; q < MODULI; q++) {
            spectrum_whiten(s, i, q, s->residual[q], 1);
            if (with_rows)
                spectrum_whiten(s, i, q, s->row[q], width);
        }
    }
}

/* ---- normal equations ------------------------------------------------------------------------ */

/* Adds the products of ROWS rows to the block of the terms, upper triangle: so many at a time keep
 * it out of the way to memory, which is what this costs. */
WIDE_REGISTERS
static void add_rows(gsl_matrix *normal, size_t m, const double *row, size_t width)
{
    const double *r0 = row, *r1 = r0 + width, *r2 = r1 + width, *r3 = r2 + width;
    for (size_t i = 0; i < m; i++) {
        double *restrict into = gsl_matrix_ptr(normal, i, 0);
        const double c0 = r0[i], c1 = r1[i], c2 = r2[i], c3 = r3[i];
        for (size_t j = i; j < m; j++)
            into[j] += (c0 * r0[j] + c1 * r1[j]) + (c2 * r2[j] + c3 * r3[j]);
    }
}

/* Adds what the shifts of a curve have with the terms and each other. */
static void add_shifts(spectrum *s, size_t curve, int q)
{
    const size_t m = s->n_linear, width = m + 2;
    const long column[2] = {s->column_a[curve], s->column_b[curve]};
    for (int c = 0; c < 2; c++) {
        if (column[c] < 0)
            continue;
        double *restrict into = gsl_matrix_ptr(s->normal[q], (size_t)column[c], 0);
        for (size_t k = s->first[curve]; k < s->first[curve + 1]; k++) {
            const double *row = s->row[q] + k * width;
            const double r = row[m + (size_t)c];
            for (size_t j = 0; j < m; j++)
                into[j] += r * row[j];
            for (int d = 0; d <= c; d++)
                if (column[d] >= 0)
                    into[column[d]] += r * row[m + (size_t)d];
        }
    }
}

void spectrum_normal(spectrum *s)
{
    const size_t m = s->n_linear, width = m + 2;
    for (int q = 0; q < MODULI; q++) {
        gsl_matrix *normal = s->normal[q];
        gsl_matrix_set_zero(normal);
        for (size_t k = 0; k < s->n; k += ROWS) /* the last block ends in rows of zeros */
            add_rows(normal, m, s->row[q] + k * width, width);
        for (size_t i = 0; i < s->n_curves; i++)
            add_shifts(s, i, q);
        for (size_t i = 0; i < s->n_unknowns; i++) /* the other triangle */
            for (size_t j = 0; j < i; j++)
                if (i < m)
                    gsl_matrix_set(normal, i, j, gsl_matrix_get(normal, j, i));
                else
                    gsl_matrix_set(normal, j, i, gsl_matrix_get(normal, i, j));
    }
}

/* ---- priors ---------------------------------------------------------------------------------- */

/* Weight of a second difference, of terms j to j + 2. */
static double bend_stiffness(const spectrum *s, size_t j)
{
    return s->bend[j] * (j + 1 < s->n_measured ? 1.0 : slow_stiffness);
}

static double b_departure(const spectrum *s, const double *value, size_t curve)
{
    return b_of(s, value, curve) - s->prior->mean[curve];
}

/* By tan delta alone the level is held, loosely: it is no part of what is told. */
static double off_level(const spectrum *s, const double *value)
{
    double sum = -s->level;
    for (size_t j = 0; j < s->n_terms; j++)
        sum += value[j] / (double)s->n_terms;
    return sum;
}

double spectrum_objective(const spectrum *s, const double *value)
{
    double sum = spectrum_roughness(s, value) / (s->smooth * s->smooth);
    for (int q = 0; q < MODULI; q++)
        sum += spectrum_squares(s, q) / (s->noise[q] * s->noise[q]);
    if (!s->liquid) {
        const double off = (value[s->n_terms] - s->equilibrium_mean) / s->equilibrium_spread;
        sum += off * off;
    }
    if (s->ratio)
        sum += pow(off_level(s, value), 2);
    for (size_t i = 0; s->prior->precision != NULL && i < s->n_curves; i++)
        for (size_t k = 0; k < s->n_curves; k++)
            sum += gsl_matrix_get(s->prior->precision, i, k) * b_departure(s, value, i) *
                   b_departure(s, value, k);
    return sum;
}

double spectrum_squares(const spectrum *s, int q)
{
    double sum = 0.0;
    for (size_t k = 0; k < s->n; k++)
        sum += s->residual[q][k] * s->residual[q][k];
    return sum;
}

double spectrum_roughness(const spectrum *s, const double *value)
{
    double sum = 0.0;
    for (size_t j = 1; j + 1 < s->n_terms; j++) {
        const double bend = value[j - 1] - 2.0 * value[j] + value[j + 1];
        sum += bend_stiffness(s, j - 1) * bend * bend;
    }
    return sum;
}

double spectrum_roughness_trace(const spectrum *s)
{
    static const double weight[3] = {1.0, -2.0, 1.0}; /* second difference */
    double sum = 0.0;
    for (size_t j = 0; j + 2 < s->n_terms; j++)
        for (size_t i = 0; i < 3; i++)
            for (size_t k = 0; k < 3; k++)
                sum += bend_stiffness(s, j) * weight[i] * weight[k] *
                       gsl_matrix_get(s->covariance, j + i, j + k);
    return sum;
}

static void add_priors(spectrum *s)
{
    static const double weight[3] = {1.0, -2.0, 1.0}; /* second difference */
    for (size_t j = 0; j + 2 < s->n_terms; j++) {
        const double rough = bend_stiffness(s, j) / (s->smooth * s->smooth);
        const double bend = s->value[j] - 2.0 * s->value[j + 1] + s->value[j + 2];
        for (size_t i = 0; i < 3; i++) {
            *gsl_vector_ptr(s->gradient, j + i) -= rough * weight[i] * bend;
            for (size_t k = 0; k < 3; k++)
                *gsl_matrix_ptr(s->precision, j + i, j + k) += rough * weight[i] * weight[k];
        }
    }
    if (!s->liquid) {
        const double w = 1.0 / (s->equilibrium_spread * s->equilibrium_spread);
        *gsl_matrix_ptr(s->precision, s->n_terms, s->n_terms) += w;
        *gsl_vector_ptr(s->gradient, s->n_terms) -=
            w * (s->value[s->n_terms] - s->equilibrium_mean);
    }
    const double share = 1.0 / (double)s->n_terms, off = s->ratio ? off_level(s, s->value) : 0.0;
    for (size_t j = 0; s->ratio && j < s->n_terms; j++) {
        *gsl_vector_ptr(s->gradient, j) -= share * off;
        for (size_t i = 0; i < s->n_terms; i++)
            *gsl_matrix_ptr(s->precision, j, i) += share * share;
    }
    for (size_t i = 0; s->prior->precision != NULL && i < s->n_curves; i++)
        for (size_t k = 0; k < s->n_curves; k++) {
            const double w = gsl_matrix_get(s->prior->precision, i, k);
            if (s->column_b[i] < 0)
                continue;
            *gsl_vector_ptr(s->gradient, (size_t)s->column_b[i]) -= w * b_departure(s, s->value, k);
            if (s->column_b[k] >= 0)
                *gsl_matrix_ptr(s->precision, (size_t)s->column_b[i], (size_t)s->column_b[k]) += w;
        }
}

/* Adds J'r of a modulus times `scale`. */
static void add_gradient(spectrum *s, int q, double scale)
{
    const size_t m = s->n_linear, width = m + 2;
    double *gradient = gsl_vector_ptr(s->gradient, 0);
    for (size_t i = 0; i < s->n_curves; i++)
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
            const double *row = s->row[q] + k * width, r = scale * s->residual[q][k];
            for (size_t j = 0; j < m; j++)
                gradient[j] += r * row[j];
            if (s->column_a[i] >= 0)
                gradient[s->column_a[i]] += r * row[m];
            if (s->column_b[i] >= 0)
                gradient[s->column_b[i]] += r * row[m + 1];
        }
}

void spectrum_assemble(spectrum *s)
{
    gsl_vector_set_zero(s->gradient);
    gsl_matrix_set_zero(s->precision);
    for (int q = 0; q < MODULI; q++) {
        const double scale = 1.0 / (s->noise[q] * s->noise[q]);
        for (size_t i = 0; i < s->n_unknowns; i++)
            for (size_t k = 0; k < s->n_unknowns; k++)
                *gsl_matrix_ptr(s->precision, i, k) += scale * gsl_matrix_get(s->normal[q], i, k);
        add_gradient(s, q, scale);
    }
    add_priors(s);
}

double spectrum_prior_log_det(const spectrum *s)
{
    return 2.0 * (double)(s->n_terms - 2) * log(s->smooth) + s->prior->log_det;
}
