/* Lack of fit of one spectrum: what a line and a parabola of every isotherm of its own would still
 * explain, and what slow times would that shift more than fast ones. A spectrum ties E' and E''
 * (Kramers-Kronig); a common factor on E'' tests that alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/superposition.h"

#include "fit/dense.h"
#include "fit/pool_gsl.h"
#include "model/cholesky.h"
#include "model/root.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <math.h>

/* Columns of an isotherm: powers of its frequency from the first one on, in each modulus. A factor
 * on both moduli is the vertical shift. */
static const int first_power[MODULI] = {1, 0};
/* From so many points on a parabola too: six are twelve values, of which five columns and two
 * shifts leave five. */
enum { LEAST_PARABOLA = 6, POWERS = 3 };
/* Places in the spectrum where slow times may part from fast ones: few, so that they see what grows
 * with the shift and is small in each isotherm. */
enum { PARTINGS = 3 };
/* The smaller p of so many counts, times their number. */
static const double tests = 2.0;
/* What is left of a column, of its square, below which the model has it: 1e-3 of its
 * length, far above rounding, and too little to tell anything beside noise. */
static const double least_left = 1e-6;
/* Of the squares the columns leave at least so much: where the fit is far from its minimum, as with
 * exchanged moduli, they seem to explain more than there is. Then p is nothing either way, and the
 * misfit is what the columns explain, whatever this share is. */
static const double least_squares = 0.01;

/* A misfit that is large makes noise within the isotherms that hardly is one: not less is believed
 * to be known of it than so many degrees of freedom would tell. The variance of ln of a variance is
 * 2 over them: 12 are a factor 1.5 in it. Chosen: of 20 columns the F that 1 % exceed is 3.9, and
 * would be 7.4 with half and 2.7 with twice as many. */
static const double least_known = 12.0;

/* To this part the end of a stated interval is made; of 2 digits that are told. */
static const double misfit_close = 1e-4;
enum { MOST_HALVINGS = 100 }; /* of [0, high] down to that part of what may be 1e-25 of it */

struct extra {
    const spectrum *s;
    pool memory;
    size_t n;           /* columns */
    gsl_matrix *column; /* [n * 2N]: whitened, E' then E'' */
    gsl_matrix *matrix; /* [n * n] what the model leaves of them */
    gsl_vector *right;  /* [n] with the residuals */
    size_t *from, *to;  /* [n] where a column is not zero */
    double *length;     /* [n] of a column before it is 1 */
    double *share;      /* [PARTINGS * n_terms] how much a term follows a parting */
    double squares, points, freedom;
    double uncertainty; /* variance of ln of the variance of what columns explain */
};

/* Whitened and divided by the noise. */
static void add_column(struct extra *x, size_t curve, int q, int power)
{
    const spectrum *s = x->s;
    double *v = gsl_matrix_ptr(x->column, x->n++, 0) + (q == LOSS ? s->n : 0);
    const size_t from = s->first[curve], to = s->first[curve + 1];
    const double middle = 0.5 * (s->x[from] + s->x[to - 1]);
    const double half = fmax(0.5 * (s->x[to - 1] - s->x[from]), 1e-300);
    for (size_t k = from; k < to; k++)
        v[k] += spectrum_weight(s, k, q) / s->noise[q] * pow((s->x[k] - middle) / half, power);
    spectrum_whiten(s, curve, q, v, 1);
}

static void add_columns(struct extra *x)
{
    for (size_t i = 0; i < x->s->n_curves; i++) {
        const size_t points = x->s->first[i + 1] - x->s->first[i];
        for (int q = 0; q < MODULI; q++)
            for (int p = first_power[q]; p < (points < LEAST_PARABOLA ? 2 : POWERS); p++)
                add_column(x, i, q, p);
    }
}

/* How much the terms follow each parting: rising from -1 to 1 across it [PARTINGS * n_terms]. */
static void follow_partings(const spectrum *s, double *share)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < s->n_curves; i++) {
        low = fmin(low, s->x[s->first[i]] + spectrum_a(s, i));
        high = fmax(high, s->x[s->first[i + 1] - 1] + spectrum_a(s, i));
    }
    for (size_t p = 0; p < PARTINGS; p++)
        for (size_t j = 0; j < s->n_terms; j++) {
            const double at = -(s->log_tau + (double)j * s->step);
            const double u = (PARTINGS + 1.0) * (at - low) / (high - low);
            share[p * s->n_terms + j] = tanh(2.0 * (u - (double)(p + 1)));
        }
}

/* What the moduli of a point change by when each term moves by its share of the isotherm's shift.
 */
static void add_parted(struct extra *x, size_t curve, size_t k, const double *share,
                       double *const part[MODULI])
{
    const spectrum *s = x->s;
    const double a = spectrum_a(s, curve);
    double modulus[MODULI], slope[MODULI];
    spectrum_at(s, s->term, s->x[k] + a, modulus, slope, part);
    for (size_t j = 0; j < s->n_terms; j++) {
        const double z = exp(s->x[k] + a + s->log_tau + (double)j * s->step);
        const double rise[MODULI] = {2.0 / (1.0 + z * z), 2.0 / (1.0 + z * z) - 1.0};
        for (int q = 0; q < MODULI; q++)
            for (size_t p = 0; p < PARTINGS; p++)
                *gsl_matrix_ptr(x->column, p, (q == LOSS ? s->n : 0) + k) +=
                    a * spectrum_weight(s, k, q) / s->noise[q] * share[p * s->n_terms + j] *
                    part[q][j] * rise[q];
    }
}

/* A second process has a law of its own: slow and fast times part in proportion to the shift. */
static wt_status part_columns(struct extra *x, wt_error *err)
{
    const spectrum *s = x->s;
    double *share = x->share = pool_numbers(&x->memory, PARTINGS * s->n_terms);
    double *const part[MODULI] = {pool_numbers(&x->memory, s->n_linear),
                                  pool_numbers(&x->memory, s->n_linear)};
    if (x->memory.failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for the test of superposition");
    gsl_matrix_set_zero(x->column);
    x->n = PARTINGS;
    follow_partings(s, share);
    for (size_t i = 0; i < s->n_curves; i++) {
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++)
            add_parted(x, i, k, share, part);
        for (size_t p = 0; p < PARTINGS; p++)
            for (int q = 0; q < MODULI; q++)
                spectrum_whiten(s, i, q, gsl_matrix_ptr(x->column, p, q == LOSS ? s->n : 0), 1);
    }
    return WT_OK;
}

/* Adds J'z of one column, J the rows divided by the noise. */
static void add_product(const spectrum *s, const double *z, double *product)
{
    const size_t m = s->n_linear, width = m + 2;
    for (int q = 0; q < MODULI; q++)
        for (size_t i = 0; i < s->n_curves; i++)
            for (size_t k = s->first[i]; k < s->first[i + 1]; k++) {
                const double w = z[(q == LOSS ? s->n : 0) + k] / s->noise[q];
                const double *row = s->row[q] + k * width;
                if (w == 0.0)
                    continue;
                for (size_t j = 0; j < m; j++)
                    product[j] += w * row[j];
                if (s->column_a[i] >= 0)
                    product[s->column_a[i]] += w * row[m];
                if (s->column_b[i] >= 0)
                    product[s->column_b[i]] += w * row[m + 1];
            }
}

/* Products of the columns with each other, where both are not zero: most are of one isotherm. */
static void multiply_columns(struct extra *x, const gsl_matrix *columns)
{
    const size_t n = columns->size1;
    size_t *from = x->from, *to = x->to;
    for (size_t c = 0; c < n; c++) {
        const double *v = gsl_matrix_const_ptr(columns, c, 0);
        to[c] = columns->size2;
        for (from[c] = 0; from[c] < to[c] && v[from[c]] == 0.0;)
            from[c]++;
        while (to[c] > from[c] && v[to[c] - 1] == 0.0)
            to[c]--;
        for (size_t d = 0; d <= c; d++) {
            const double *w = gsl_matrix_const_ptr(columns, d, 0);
            const size_t end = to[c] < to[d] ? to[c] : to[d];
            double sum = 0.0;
            for (size_t k = from[c] > from[d] ? from[c] : from[d]; k < end; k++)
                sum += v[k] * w[k];
            gsl_matrix_set(x->matrix, c, d, sum);
            gsl_matrix_set(x->matrix, d, c, sum);
        }
    }
}

/* Takes by' V by from the products, V the covariance; by: [n * unknowns]. */
static wt_status take_out_model(struct extra *x, gsl_matrix *by, wt_error *err)
{
    const size_t n = by->size1, m = by->size2;
    const gsl_matrix *v = x->s->covariance;
    gsl_matrix *solved = pool_matrix(&x->memory, m, n), *across = pool_matrix(&x->memory, m, n);
    if (x->memory.failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for the test of superposition");
    gsl_matrix_transpose_memcpy(across, by);
    for (size_t u = 0; u < m; u++)
        dense_add(gsl_matrix_ptr(solved, u, 0), n, gsl_matrix_const_ptr(v, u, 0), 1, across->data,
                  across->tda, m);
    gsl_matrix_scale(by, -1.0);
    for (size_t c = 0; c < n; c++)
        dense_add(gsl_matrix_ptr(x->matrix, c, 0), n, gsl_matrix_const_ptr(by, c, 0), 1,
                  solved->data, solved->tda, m);
    return WT_OK;
}

/* Columns and residuals with the model taken out, each column of length 1 before. */
static wt_status take_out_spectrum(struct extra *x, wt_error *err)
{
    const spectrum *s = x->s;
    const size_t n = x->n, m = s->n_unknowns;
    gsl_matrix *by = pool_matrix(&x->memory, n, m);
    if (x->memory.failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for the test of superposition");
    gsl_matrix_view columns = gsl_matrix_submatrix(x->column, 0, 0, n, 2 * s->n);
    for (size_t c = 0; c < n; c++) {
        gsl_vector_view column = gsl_matrix_row(&columns.matrix, c);
        const double length = x->length[c] = gsl_blas_dnrm2(&column.vector);
        if (length > 0.0)
            gsl_vector_scale(&column.vector, 1.0 / length);
        add_product(s, column.vector.data, gsl_matrix_ptr(by, c, 0));
        double sum = 0.0;
        for (int q = 0; q < MODULI; q++)
            for (size_t k = 0; k < s->n; k++)
                sum += gsl_vector_get(&column.vector, (q == LOSS ? s->n : 0) + k) *
                       s->residual[q][k] / s->noise[q];
        gsl_vector_set(x->right, c, sum);
    }
    multiply_columns(x, &columns.matrix);
    return take_out_model(x, by, err);
}

/* right' matrix^- right and the rank, by Cholesky with the largest pivot left. */
static double explained_squares(struct extra *x, size_t *rank)
{
    double sum = 0.0;
    for (*rank = 0; *rank < x->n; (*rank)++) {
        size_t pivot = *rank;
        for (size_t i = *rank; i < x->n; i++)
            if (gsl_matrix_get(x->matrix, i, i) > gsl_matrix_get(x->matrix, pivot, pivot))
                pivot = i;
        gsl_matrix_view part = gsl_matrix_submatrix(x->matrix, 0, 0, x->n, x->n);
        gsl_matrix_swap_rows(&part.matrix, *rank, pivot);
        gsl_matrix_swap_columns(&part.matrix, *rank, pivot);
        gsl_vector_swap_elements(x->right, *rank, pivot);
        const double d = gsl_matrix_get(x->matrix, *rank, *rank);
        if (!(d > least_left))
            break;
        const double r = gsl_vector_get(x->right, *rank);
        sum += r * r / d;
        for (size_t i = *rank + 1; i < x->n; i++) {
            const double f = gsl_matrix_get(x->matrix, i, *rank) / d;
            const double less = -f;
            *gsl_vector_ptr(x->right, i) -= f * r;
            dense_add(gsl_matrix_ptr(x->matrix, i, *rank + 1), x->n - *rank - 1, &less, 1,
                      gsl_matrix_const_ptr(x->matrix, *rank, *rank + 1), x->matrix->tda, 1);
        }
    }
    return sum;
}

/* How far the times of the measured range part from the shifts, as a share of those: half of the
 * range of what the partings, fitted together, make of the terms. */
static double parted_share(const struct extra *x)
{
    const spectrum *s = x->s;
    double matrix[PARTINGS * PARTINGS], by[PARTINGS], low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t p = 0; p < PARTINGS; p++) {
        by[p] = gsl_vector_get(x->right, p);
        for (size_t k = 0; k < PARTINGS; k++)
            matrix[p * PARTINGS + k] = gsl_matrix_get(x->matrix, p, k);
    }
    if (!cholesky_solve(matrix, PARTINGS, PARTINGS, 0.0, by))
        return 1.0; /* too little is left of them to tell: it may be all of a shift */
    for (size_t j = s->n_fast; j < s->n_measured; j++) {
        double sum = 0.0;
        for (size_t p = 0; p < PARTINGS; p++)
            sum += by[p] / x->length[p] * x->share[p * s->n_terms + j];
        low = fmin(low, sum);
        high = fmax(high, sum);
    }
    return high > low ? 0.5 * (high - low) : 0.0;
}

/* Distribution of noncentral chi-square: a Poisson mixture of central ones. */
static double noncentral_below(double x, double freedom, double lambda)
{
    const double mean = 0.5 * lambda, width = 10.0 * sqrt(mean) + 20.0;
    double sum = 0.0;
    for (double j = floor(fmax(mean - width, 0.0)); j < mean + width; j += 1.0) {
        const double log_weight = (mean > 0.0 ? j * log(mean)
                                   : j > 0.0  ? -HUGE_VAL
                                              : 0.0) -
                                  mean - lgamma(j + 1.0);
        sum += exp(log_weight) * gsl_cdf_chisq_P(x, freedom + 2.0 * j);
    }
    return sum;
}

/* Beyond it the square root of noncentral chi-square is normal to four digits, and the sum above
 * has too many terms. */
static const double many = 1e4;

typedef struct noncentral {
    double x, freedom, probability;
} noncentral;

static bool more_probable(double lambda, void *user)
{
    const noncentral *c = user;
    return noncentral_below(c->x, c->freedom, lambda) > c->probability;
}

/* Lambda with which x has this probability to be exceeded from below. */
static double noncentrality(double x, double freedom, double probability)
{
    const double half = 0.5 * (freedom - 1.0);
    if (x > many + freedom)
        return pow(sqrt(x - half) - gsl_cdf_ugaussian_Pinv(probability), 2) - half;
    noncentral c = {x, freedom, probability};
    double low = 0.0, high = 4.0 * x + 100.0;
    if (!more_probable(low, &c))
        return 0.0;
    root_halve(more_probable, &c, &low, &high, misfit_close, MOST_HALVINGS);
    return 0.5 * (low + high);
}

/* Degrees of freedom by which the noise is known that slow columns have. */
static double known_freedom(const struct extra *x, double left)
{
    return fmax(2.0 / (2.0 / left + x->uncertainty), fmin(least_known, left));
}

/* Probability and misfit of what the columns explain, if that is less likely than what is in
 * `result`; the misfit is the larger one. */
static wt_status test_columns(struct extra *x, lack_of_fit *result, wt_error *err)
{
    const spectrum *s = x->s;
    size_t rank;
    wt_status status = take_out_spectrum(x, err);
    if (status != WT_OK)
        return status;
    if (x->share != NULL)
        result->parted = parted_share(x);
    const double q = explained_squares(x, &rank), k = (double)rank;
    if (rank == 0)
        return WT_OK;
    const double left = fmax(x->points - x->freedom - k, 1.0);
    const double variance = fmax(x->squares - q, least_squares * x->squares) / left;
    const double known = known_freedom(x, left);
    const double to_misfit = s->noise[STORAGE] * s->noise[LOSS] * variance / x->points;
    const double above = q / variance;
    result->p = fmin(result->p, tests * gsl_cdf_fdist_Q(above / k, k, left));
    result->p_sure = fmin(result->p_sure, tests * gsl_cdf_fdist_Q(above / k, k, known));
    result->misfit_low = fmax(result->misfit_low, sqrt(noncentrality(above, k, 0.975) * to_misfit));
    result->misfit_high =
        fmax(result->misfit_high, sqrt(noncentrality(above, k, 0.025) * to_misfit));
    return WT_OK;
}

static wt_status test_factor(struct extra *x, lack_of_fit *result, wt_error *err)
{
    const spectrum *s = x->s;
    gsl_matrix_set_zero(x->column);
    for (size_t i = 0; i < s->n_curves; i++) { /* one column of all */
        x->n = 0;
        add_column(x, i, LOSS, 0);
    }
    gsl_vector_view column = gsl_matrix_row(x->column, 0);
    const double scale = gsl_blas_dnrm2(&column.vector);
    wt_status status = take_out_spectrum(x, err);
    if (status != WT_OK)
        return status;
    const double d = gsl_matrix_get(x->matrix, 0, 0), r = gsl_vector_get(x->right, 0);
    const double left = fmax(x->points - x->freedom - 1.0, 1.0);
    const double spread = fmax((x->squares - r * r / d) / left, 1e-300);
    const double known = known_freedom(x, left);
    result->factor = r / d / scale;
    result->factor_error = sqrt(spread / d) / scale;
    result->kk = 2.0 * gsl_cdf_tdist_Q(fabs(r) / sqrt(spread * d), known);
    return WT_OK;
}

wt_status superposition_test(const spectrum *s, double uncertainty, lack_of_fit *result,
                             wt_error *err)
{
    const size_t most = s->n_curves * (MODULI * POWERS - 1) + PARTINGS;
    struct extra x = {.s = s, .uncertainty = uncertainty};
    x.column = pool_matrix(&x.memory, most, 2 * s->n);
    x.matrix = pool_matrix(&x.memory, most, most);
    x.right = pool_vector(&x.memory, most);
    x.from = pool_alloc(&x.memory, most, sizeof *x.from);
    x.to = pool_alloc(&x.memory, most, sizeof *x.to);
    x.length = pool_numbers(&x.memory, most);
    wt_status status = x.memory.failed
                           ? wt_fail(err, WT_E_MEMORY, "no memory for the test of superposition")
                           : WT_OK;
    for (int q = 0; q < MODULI; q++) {
        x.squares += spectrum_squares(s, q) / (s->noise[q] * s->noise[q]);
        x.freedom += s->freedom[q];
        for (size_t k = 0; k < s->n; k++)
            x.points += s->weight[q][k] > 0.0;
    }
    *result = (lack_of_fit){.p = 1.0, .p_sure = 1.0};
    if (status == WT_OK) {
        add_columns(&x);
        status = test_columns(&x, result, err);
    }
    if (status == WT_OK)
        status = part_columns(&x, err);
    if (status == WT_OK)
        status = test_columns(&x, result, err);
    if (status == WT_OK)
        status = test_factor(&x, result, err);
    pool_free(&x.memory);
    return status;
}
