/* Lack of fit of one spectrum. It tests what a separate line and parabola of each isotherm
 * explains, and what a different shift of slow times explains. A common factor on E'' tests the
 * Kramers-Kronig relation separately.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include "core/base/memory.h"
#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"
#include "core/math/root.h"
#include "core/math/students_t.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_eigen.h>
#include <math.h>
#include <string.h>

/* First power of the frequency in the columns of an isotherm, in each modulus. A factor on both
 * moduli is the vertical shift. */
static const int first_power[MODULI] = {1, 0};
/* Minimum number of points for a parabola. Six points are twelve values; five columns and two
 * shifts leave five. */
enum { LEAST_PARABOLA = 6, POWERS = 3 };
/* Positions in the spectrum at which slow and fast times may separate. They are few, to detect
 * an effect that grows with the shift and is small in each isotherm. */
enum { PARTINGS = 3, FACTOR = PARTINGS, WITH_FACTOR };
/* Number of tests; the smallest p is multiplied by it. */
static const double tests = 2.0;
/* A column is dropped if the model leaves less than this share of its square: 1e-3 of its
 * length, above rounding and below any information. */
static const double least_left = 1e-6;
/* Minimum share of the squares that the columns leave. Far from the minimum, as with exchanged
 * moduli, they seem to explain more than there is. p is then negligible, and the misfit does not
 * depend on this share. */
static const double least_squares = 0.01;

/* Minimum degrees of freedom of the noise estimate, because a large misfit may cause apparent
 * noise within the isotherms. They are those of one isotherm with ten frequencies: 20 values less
 * 8 coefficients (spectrum_noise.c). The noise is then known to a factor 1.5. */
static const double min_noise_freedom = 12.0;

/* Relative accuracy of the limits of the misfit; two digits are reported. */
static const double misfit_close = 1e-4;
enum { MOST_HALVINGS = 100 }; /* halvings of [0, high] */

/* Columns that share data: those of one isotherm, or those of all. */
enum { MOST_COLUMNS = MODULI * POWERS - 1 };
struct columns {
    size_t n;
    double product[MOST_COLUMNS *
                   MOST_COLUMNS]; /* products of the columns; later what the model leaves */
    double right[MOST_COLUMNS];   /* products with the residuals */
    double length[MOST_COLUMNS];  /* length of a column before it is scaled to 1 */
    double *border[MOST_COLUMNS]; /* [n_shared] products with the terms, without the shifts */
};

/* Squares of the residuals that the columns explain, which share only the terms. */
typedef struct explanation {
    double explained;
    size_t rank;
} explanation;

struct test_work {
    const spectrum *s;
    arena memory;
    size_t n;       /* number of filled columns */
    double *column; /* [MOST_COLUMNS * 2 longest] whitened columns of one isotherm, E' then E'' */
    size_t longest; /* largest number of points of an isotherm */
    gsl_matrix *common_products; /* [n_shared^2] products of the columns through the terms */
    double *common_residuals;    /* [n_shared] the same with the residuals */
    double *share;               /* [PARTINGS * n_terms] dependence of a term on a separation */
    explanation total;
    double squares, points, freedom;
    double uncertainty; /* variance of ln of the noise variance of the columns */
};

static double *column_values(const struct test_work *x, size_t column, int q)
{
    return x->column + (column * MODULI + (size_t)q) * x->longest;
}

/* Adds a power of the frequency as a column, whitened and divided by the noise. */
static void add_test_column(struct test_work *x, size_t curve, int q, int power)
{
    const spectrum *s = x->s;
    double *v = column_values(x, x->n++, q);
    const size_t from = s->first[curve], to = s->first[curve + 1];
    const double middle = 0.5 * (s->x[from] + s->x[to - 1]);
    const double half = fmax(0.5 * (s->x[to - 1] - s->x[from]), 1e-300);
    for (size_t k = from; k < to; k++)
        v[k - from] =
            spectrum_weight(s, k, q) / s->noise[q] * pow((s->x[k] - middle) / half, power);
    spectrum_whiten(s, curve, q, v, 1);
}

static void clear_columns(struct test_work *x)
{
    x->n = 0;
    memset(x->column, 0, MOST_COLUMNS * MODULI * x->longest * sizeof *x->column);
}

static void fill_isotherm_columns(struct test_work *x, size_t curve)
{
    const size_t points = x->s->first[curve + 1] - x->s->first[curve];
    clear_columns(x);
    for (int q = 0; q < MODULI; q++)
        for (int p = first_power[q]; p < (points < LEAST_PARABOLA ? 2 : POWERS); p++)
            add_test_column(x, curve, q, p);
}

/* Computes the dependence of the terms on each separation: rising from -1 to 1 across it
 * [PARTINGS * n_terms]. */
static void set_parting_shares(const spectrum *s, double *share)
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

/* Adds the change of the moduli of a point if each term moves by its share of the shift of the
 * isotherm. */
static void add_parting_columns(struct test_work *x, size_t curve, size_t k, const double *share,
                                double *const part[MODULI])
{
    const spectrum *s = x->s;
    const double a = spectrum_a(s, curve);
    double modulus[MODULI], slope[MODULI];
    spectrum_moduli(s, s->term, s->x[k] + a, modulus, slope, part);
    for (size_t j = 0; j < s->n_terms; j++) {
        const double z = exp(s->x[k] + a + s->log_tau + (double)j * s->step);
        const double rise[MODULI] = {2.0 / (1.0 + z * z), 2.0 / (1.0 + z * z) - 1.0};
        for (int q = 0; q < MODULI; q++)
            for (size_t p = 0; p < PARTINGS; p++)
                column_values(x, p, q)[k - s->first[curve]] +=
                    a * spectrum_weight(s, k, q) / s->noise[q] * share[p * s->n_terms + j] *
                    part[q][j] * rise[q];
    }
}

/* ---- products -------------------------------------------------------------------------------- */

/* Computes the products of the columns of a curve with its rows, divided by the noise, and with
 * the residuals. The shifts are projected out. */
static void add_products(const struct test_work *x, size_t curve, struct columns *to)
{
    const spectrum *s = x->s;
    const size_t m = s->n_shared, width = m + 2, from = s->first[curve], end = s->first[curve + 1];
    const double *diagonal = s->factor.diagonal + BLOCK_DIAGONAL * curve;
    const double *side[BLOCK_SIDE] = {
        gsl_matrix_const_ptr(s->factor.side, BLOCK_SIDE * curve, 0),
        gsl_matrix_const_ptr(s->factor.side, BLOCK_SIDE * curve + 1, 0)};
    double shift[MOST_COLUMNS][BLOCK_SIDE] = {{0.0}};
    for (size_t c = 0; c < to->n; c++) {
        for (int q = 0; q < MODULI; q++)
            for (size_t k = from; k < end; k++) {
                const double w = column_values(x, c, q)[k - from] / s->noise[q];
                const double *row = s->row[q] + k * width;
                if (w == 0.0)
                    continue;
                dense_add_rows(to->border[c], m, &w, 1, row, width, 1);
                to->right[c] += w * s->residual[q][k];
                shift[c][0] += s->column_a[curve] >= 0 ? w * row[m] : 0.0;
                shift[c][1] += s->column_b[curve] >= 0 ? w * row[m + 1] : 0.0;
            }
        shift[c][0] /= diagonal[0];
        shift[c][1] = (shift[c][1] - diagonal[1] * shift[c][0]) / diagonal[2];
        for (size_t j = 0; j < m; j++)
            to->border[c][j] -= shift[c][0] * side[0][j] + shift[c][1] * side[1][j];
        for (size_t d = 0; d <= c; d++) {
            double sum = 0.0;
            for (int q = 0; q < MODULI; q++)
                for (size_t k = 0; k < end - from; k++)
                    sum += column_values(x, c, q)[k] * column_values(x, d, q)[k];
            if (c == d)
                to->length[c] += sum;
            to->product[c * MOST_COLUMNS + d] +=
                sum - shift[c][0] * shift[d][0] - shift[c][1] * shift[d][1];
        }
    }
}

static void clear_products(const struct test_work *x, size_t n, struct columns *c)
{
    c->n = n;
    for (size_t i = 0; i < n; i++) {
        memset(c->border[i], 0, x->s->n_shared * sizeof *c->border[i]);
        memset(c->product + i * MOST_COLUMNS, 0, MOST_COLUMNS * sizeof *c->product);
        c->right[i] = c->length[i] = 0.0;
    }
}

/* Scales all products to columns of length 1. */
static void scale_products(const struct test_work *x, struct columns *c)
{
    for (size_t i = 0; i < c->n; i++)
        c->length[i] = sqrt(c->length[i]);
    for (size_t i = 0; i < c->n; i++) {
        const double by = c->length[i] > 0.0 ? 1.0 / c->length[i] : 1.0;
        c->right[i] *= by;
        for (size_t j = 0; j < x->s->n_shared; j++)
            c->border[i][j] *= by;
        for (size_t j = 0; j < c->n; j++)
            c->product[(j > i ? j : i) * MOST_COLUMNS + (j > i ? i : j)] *= i == j ? by * by : by;
    }
}

/* Multiplies by the inverse of the factor of the border. */
static void apply_border_inverse(const spectrum *s, double *v)
{
    const size_t m = s->n_shared; /* with free shifts the border has only terms */
    gsl_matrix_const_view root = gsl_matrix_const_submatrix(s->factor.border, 0, 0, m, m);
    dense_forward(&root.matrix, v);
}

/* Projects out the terms. */
static void project_out_terms(const struct test_work *x, struct columns *c)
{
    for (size_t i = 0; i < c->n; i++) {
        apply_border_inverse(x->s, c->border[i]);
        for (size_t j = 0; j <= i; j++)
            for (size_t k = 0; k < x->s->n_shared; k++)
                c->product[i * MOST_COLUMNS + j] -= c->border[i][k] * c->border[j][k];
    }
}

/* Returns the separation of the times of the measured range as a share of the shifts. It is half
 * the range of the fitted separations, with the factor. */
static double parted_share(const struct test_work *x, const struct columns *c)
{
    const spectrum *s = x->s;
    double matrix[WITH_FACTOR * WITH_FACTOR] = {0.0}, by[WITH_FACTOR], low = HUGE_VAL,
                                high = -HUGE_VAL;
    for (size_t p = 0; p < WITH_FACTOR; p++) {
        by[p] = c->right[p];
        for (size_t k = 0; k <= p; k++)
            matrix[p * WITH_FACTOR + k] = c->product[p * MOST_COLUMNS + k];
    }
    if (!cholesky_solve(matrix, WITH_FACTOR, WITH_FACTOR, 0.0, by))
        return 1.0; /* undetermined: it may be the whole shift */
    for (size_t j = s->n_fast; j < s->n_measured; j++) {
        double sum = 0.0;
        for (size_t p = 0; p < PARTINGS; p++)
            sum += by[p] / c->length[p] * x->share[p * s->n_terms + j];
        low = fmin(low, sum);
        high = fmax(high, sum);
    }
    return high > low ? 0.5 * (high - low) : 0.0;
}

/* Orthogonalises the remaining columns, largest remainder first, and adds the squares that they
 * explain. */
static void orthogonalise(struct test_work *x, struct columns *c)
{
    double *a = c->product;
    gsl_matrix_view product = gsl_matrix_view_array(a, MOST_COLUMNS, MOST_COLUMNS);
    gsl_vector_view right = gsl_vector_view_array(c->right, MOST_COLUMNS);
    for (size_t i = 0; i < c->n; i++)
        for (size_t j = 0; j < i; j++)
            a[j * MOST_COLUMNS + i] = a[i * MOST_COLUMNS + j];
    for (size_t rank = 0; rank < c->n; rank++) {
        size_t pivot = rank;
        for (size_t i = rank; i < c->n; i++)
            pivot = a[i * MOST_COLUMNS + i] > a[pivot * MOST_COLUMNS + pivot] ? i : pivot;
        gsl_matrix_swap_rows(&product.matrix, rank, pivot);
        gsl_matrix_swap_columns(&product.matrix, rank, pivot);
        gsl_vector_swap_elements(&right.vector, rank, pivot);
        double *const border = c->border[rank];
        c->border[rank] = c->border[pivot];
        c->border[pivot] = border;
        const double d = a[rank * MOST_COLUMNS + rank];
        if (!(d > least_left)) {
            c->n = rank;
            break;
        }
        const double root = 1.0 / sqrt(d);
        c->right[rank] *= root;
        for (size_t j = 0; j < x->s->n_shared; j++)
            c->border[rank][j] *= root;
        for (size_t i = rank + 1; i < c->n; i++) {
            const double f = a[i * MOST_COLUMNS + rank] * root, less = -f;
            c->right[i] -= f * c->right[rank];
            dense_add_rows(c->border[i], x->s->n_shared, &less, 1, c->border[rank], 1, 1);
            for (size_t j = rank + 1; j < c->n; j++)
                a[i * MOST_COLUMNS + j] -= f * a[rank * MOST_COLUMNS + j] * root;
        }
    }
    for (size_t i = 0; i < c->n; i++)
        x->total.explained += c->right[i] * c->right[i];
    x->total.rank += c->n;
}

/* Adds the products of the orthogonal columns of an isotherm through the terms. */
static void accumulate_common(struct test_work *x, const struct columns *c)
{
    const size_t m = x->s->n_shared;
    for (size_t i = 0; i < c->n; i++) {
        dense_add_rows(x->common_residuals, m, &c->right[i], 1, c->border[i], m, 1);
        for (size_t j = 0; j < m; j++)
            dense_add_rows(gsl_matrix_ptr(x->common_products, j, 0), m, &c->border[i][j], 1,
                           c->border[i], m, 1);
    }
}

/* Projects the terms out of the columns of all isotherms together. For each eigenvector of the
 * common products the model leaves 1 minus the eigenvalue. */
static void project_out_common(struct test_work *x)
{
    const size_t m = x->s->n_shared;
    gsl_vector *value = arena_vector(&x->memory, m);
    gsl_matrix *vector = arena_matrix(&x->memory, m, m);
    gsl_eigen_symmv_workspace *work = gsl_eigen_symmv_alloc(m);
    if (work == NULL)
        out_of_memory(m * sizeof(double));
    for (size_t i = 0; i < m; i++)
        apply_border_inverse(x->s, gsl_matrix_ptr(x->common_products, i, 0));
    gsl_matrix_transpose(x->common_products);
    for (size_t i = 0; i < m; i++)
        apply_border_inverse(x->s, gsl_matrix_ptr(x->common_products, i, 0));
    apply_border_inverse(x->s, x->common_residuals);
    gsl_eigen_symmv(x->common_products, value, vector, work);
    gsl_eigen_symmv_free(work);
    for (size_t k = 0; k < m; k++) {
        const double taken = gsl_vector_get(value, k), left = 1.0 - taken;
        double sum = 0.0;
        for (size_t i = 0; i < m; i++)
            sum += gsl_matrix_get(vector, i, k) * x->common_residuals[i];
        x->total.explained += left > least_left ? sum * sum / left : -sum * sum / taken;
        x->total.rank -= left > least_left ? 0 : 1;
    }
}

/* Computes the squares explained by a line and a parabola of each isotherm. */
static void explain_isotherms(struct test_work *x, struct columns *c)
{
    x->total = (explanation){0.0, 0};
    for (size_t i = 0; i < x->s->n_curves; i++) {
        fill_isotherm_columns(x, i);
        clear_products(x, x->n, c);
        add_products(x, i, c);
        scale_products(x, c);
        orthogonalise(x, c);
        accumulate_common(x, c);
    }
    project_out_common(x);
}

/* Fills the columns of all isotherms: a second process shifts slow and fast times differently in
 * proportion to the shift. The last column is the factor on E''. */
static void fill_shared_columns(struct test_work *x, struct columns *c)
{
    const spectrum *s = x->s;
    double *share = x->share = arena_numbers(&x->memory, PARTINGS * s->n_terms);
    double *const part[MODULI] = {arena_numbers(&x->memory, s->n_shared),
                                  arena_numbers(&x->memory, s->n_shared)};
    set_parting_shares(s, share);
    clear_products(x, WITH_FACTOR, c);
    for (size_t i = 0; i < s->n_curves; i++) {
        clear_columns(x);
        for (size_t k = s->first[i]; k < s->first[i + 1]; k++)
            add_parting_columns(x, i, k, share, part);
        for (size_t p = 0; p < PARTINGS; p++)
            for (int q = 0; q < MODULI; q++)
                spectrum_whiten(s, i, q, column_values(x, p, q), 1);
        x->n = FACTOR;
        add_test_column(x, i, LOSS, 0);
        add_products(x, i, c);
    }
    scale_products(x, c);
    project_out_terms(x, c);
}

/* Computes the squares explained by the separations. */
static void explain_partings(struct test_work *x, struct columns *c)
{
    c->n = PARTINGS;
    x->total = (explanation){0.0, 0};
    orthogonalise(x, c);
}

typedef struct noncentral {
    double x, freedom, deviations;
} noncentral;

/* Returns true if x is more than some standard deviations above the middle of a noncentral
 * chi-square distribution. A power of it is nearly normal (M. Sankaran, Biometrika 50 (1963)
 * 199). */
static bool is_far_above(double lambda, void *user)
{
    const noncentral *c = user;
    const double mean = c->freedom + lambda, both = mean + lambda;
    const double h = 1.0 - 2.0 / 3.0 * mean * (mean + 2.0 * lambda) / (both * both);
    const double p = both / (mean * mean), m = (h - 1.0) * (1.0 - 3.0 * h);
    const double middle = 1.0 + h * p * (h - 1.0 - 0.5 * (2.0 - h) * m * p);
    return pow(c->x / mean, h) - middle > c->deviations * h * sqrt(2.0 * p) * (1.0 + 0.5 * m * p);
}

/* Returns lambda for which x is these standard deviations above the middle, or 0. */
static double noncentrality(double x, double freedom, double deviations)
{
    noncentral c = {x, freedom, deviations};
    double low = 0.0, high = 4.0 * x + 100.0;
    if (!is_far_above(low, &c))
        return 0.0;
    root_bisect(is_far_above, &c, &low, &high, misfit_close, MOST_HALVINGS);
    return 0.5 * (low + high);
}

/* Returns the degrees of freedom of the noise estimate for the columns. */
static double noise_freedom(const struct test_work *x, double left)
{
    return fmax(2.0 / (2.0 / left + x->uncertainty), fmin(min_noise_freedom, left));
}

/* Returns the degrees of freedom that k columns leave. */
static double remaining_freedom(const struct test_work *x, double k)
{
    return fmax(x->points - x->freedom - k, 1.0);
}

static double remaining_variance(const struct test_work *x, double q, double k)
{
    return fmax(x->squares - q, least_squares * x->squares) / remaining_freedom(x, k);
}

/* Updates the probability and misfit in `result` if the columns are less likely. The misfit is
 * the larger one. */
static void assess_columns(const struct test_work *x, lack_of_fit *result)
{
    const spectrum *s = x->s;
    const double q = x->total.explained, k = (double)x->total.rank, left = remaining_freedom(x, k);
    const double variance = remaining_variance(x, q, k);
    if (x->total.rank == 0)
        return;
    const double known = noise_freedom(x, left);
    const double to_misfit = s->noise[STORAGE] * s->noise[LOSS] * variance / x->points;
    const double above = q / variance;
    result->p = fmin(result->p, tests * gsl_cdf_fdist_Q(above / k, k, left));
    result->p_sure = fmin(result->p_sure, tests * gsl_cdf_fdist_Q(above / k, k, known));
    result->misfit_low =
        fmax(result->misfit_low, sqrt(noncentrality(above, k, NORMAL_95) * to_misfit));
    result->misfit_high =
        fmax(result->misfit_high, sqrt(noncentrality(above, k, -NORMAL_95) * to_misfit));
}

/* Tests the factor on E''. `lines` is the result of the isotherm columns; what they explain
 * beyond the factor is another misfit. */
static void test_loss_factor(const struct test_work *x, const struct columns *c, explanation lines,
                             lack_of_fit *result)
{
    const double d = c->product[FACTOR * MOST_COLUMNS + FACTOR], r = c->right[FACTOR];
    const double left = remaining_freedom(x, 1.0), q = fmax(lines.explained - r * r / d, 0.0);
    const double spread = fmax((x->squares - r * r / d) / left, 1e-300);
    const double known = noise_freedom(x, left), k = (double)lines.rank;
    if (lines.rank > 1)
        result->p_beyond =
            gsl_cdf_fdist_Q(q / remaining_variance(x, lines.explained, k) / (k - 1.0), k - 1.0,
                            noise_freedom(x, remaining_freedom(x, k)));
    result->beyond = lines.explained > 0.0 ? q / lines.explained : 1.0;
    result->factor = r / d / c->length[FACTOR];
    result->factor_error = sqrt(spread / d) / c->length[FACTOR];
    result->kk = 2.0 * gsl_cdf_tdist_Q(fabs(r) / sqrt(spread * d), known);
}

static void allocate_test(struct test_work *x, struct columns *c)
{
    const spectrum *s = x->s;
    for (size_t i = 0; i < s->n_curves; i++) {
        const size_t points = s->first[i + 1] - s->first[i];
        x->longest = points > x->longest ? points : x->longest;
    }
    x->column = arena_numbers(&x->memory, MOST_COLUMNS * MODULI * x->longest);
    x->common_products = arena_matrix(&x->memory, s->n_shared, s->n_shared);
    x->common_residuals = arena_numbers(&x->memory, s->n_shared);
    for (size_t i = 0; i < MOST_COLUMNS; i++)
        c->border[i] = arena_numbers(&x->memory, s->n_shared);
}

lack_of_fit superposition_test(const spectrum *s, double uncertainty)
{
    struct test_work x = {.s = s, .uncertainty = uncertainty};
    struct columns c = {0};
    lack_of_fit result = {.p = 1.0, .p_sure = 1.0, .p_beyond = 1.0};
    allocate_test(&x, &c);
    for (int q = 0; q < MODULI; q++) {
        x.squares += spectrum_squares(s, q) / (s->noise[q] * s->noise[q]);
        x.freedom += s->freedom[q];
        for (size_t k = 0; k < s->n; k++)
            x.points += s->weight[q][k] > 0.0;
    }
    explain_isotherms(&x, &c);
    const explanation lines = x.total;
    assess_columns(&x, &result);
    fill_shared_columns(&x, &c);
    test_loss_factor(&x, &c, lines, &result);
    result.parted = parted_share(&x, &c);
    explain_partings(&x, &c);
    assess_columns(&x, &result);
    arena_free(&x.memory);
    return result;
}
