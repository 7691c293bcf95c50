/* Gauss-Legendre rules and their running integrals. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/math/gauss_legendre.h"
#include "core/base/memory.h"
#include "core/math/simd.h"
#include "core/math/special.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* Computes P_0(x) ... P_n(x). */
static void legendre_values(size_t n, double x, double *p)
{
    p[0] = 1;
    p[1] = x;
    for (size_t k = 1; k < n; k++) {
        const double degree = (double)k;
        p[k + 1] = ((2 * degree + 1) * x * p[k] - degree * p[k - 1]) / (degree + 1);
    }
}

/* Adds the columns of a matrix, each times a number. The number of rows is rounded up to whole
 * registers. */
WIDE_REGISTERS
static void add_scaled_columns(const double *restrict matrix, size_t rows, size_t n,
                               const double *restrict times, double *restrict sum)
{
    for (size_t from = 0; from < rows; from += WIDE) {
        wide part, column;
        memcpy(&part, sum + from, sizeof part);
        for (size_t i = 0; i < n; i++) {
            memcpy(&column, matrix + i * rows + from, sizeof column);
            part += column * times[i];
        }
        memcpy(sum + from, &part, sizeof part);
    }
}

/* l_i(x) = w_i sum_k (k + 1/2) P_k(x_i) P_k(x), and int P_k = (P_{k+1} - P_{k-1}) / (2k + 1). */
static void fill_running_weights(gauss_rule *rule)
{
    double p[GAUSS_NODES_MAX][GAUSS_NODES_MAX + 1]; /* at each node */
    double change[GAUSS_NODES_MAX * GAUSS_NODES_MAX] = {
        0}; /* a column of length `row_stride` for each degree */
    const size_t n = rule->n;
    for (size_t i = 0; i < n; i++) {
        legendre_values(n, rule->node[i], p[i]);
        for (size_t k = 1; k < n; k++)
            change[k * rule->row_stride + i] = (p[i][k + 1] - p[i][k - 1]) / 2;
    }
    for (size_t i = 0; i < n; i++) {
        double *row = rule->running + i * rule->row_stride;
        for (size_t j = 0; j < n; j++)
            row[j] = (rule->node[j] + 1) / 2;
        add_scaled_columns(change + rule->row_stride, rule->row_stride, n - 1, p[i] + 1, row);
        for (size_t j = 0; j < n; j++)
            row[j] *= rule->weight[i];
        for (size_t k = 0; k < LEGENDRE_TOP; k++) {
            const size_t degree = n + k - LEGENDRE_TOP; /* degrees below 0 are omitted */
            rule->top[i * LEGENDRE_TOP_STRIDE + k] =
                n + k < LEGENDRE_TOP ? 0 : rule->weight[i] * ((double)degree + 0.5) * p[i][degree];
        }
    }
}

static double larger_number(double a, double b)
{
    return a > b ? a : b;
}

double gauss_rule_integrate(const gauss_rule *rule, const double *f, double *running)
{
    double sum = 0;
    add_scaled_columns(rule->running, rule->row_stride, rule->n, f, running);
    for (size_t i = 0; i < rule->n; i++)
        sum += rule->weight[i] * f[i];
    return sum;
}

/* Sums both integrands in registers. */
WIDE_REGISTERS
void gauss_rule_top_coefficients(const gauss_rule *rule, const double *restrict f,
                                 const double *restrict g, legendre_top *restrict of_f,
                                 legendre_top *restrict of_g)
{
    wide f_low = {0}, f_high = {0}, g_low = {0}, g_high = {0}, low, high;
    for (size_t i = 0; i < rule->n; i++) {
        memcpy(&low, rule->top + i * LEGENDRE_TOP_STRIDE, sizeof low);
        memcpy(&high, rule->top + i * LEGENDRE_TOP_STRIDE + WIDE, sizeof high);
        f_low += low * f[i];
        f_high += high * f[i];
        g_low += low * g[i];
        g_high += high * g[i];
    }
    memcpy(of_f->coefficient, &f_low, sizeof f_low);
    memcpy(of_f->coefficient + WIDE, &f_high, sizeof f_high);
    memcpy(of_g->coefficient, &g_low, sizeof g_low);
    memcpy(of_g->coefficient + WIDE, &g_high, sizeof g_high);
}

/* The coefficients are used in pairs, because one or both may be small by accident. The slowest
 * decay between the pairs is extrapolated. It is applied to half of the degrees up to twice the
 * last one, because a component with a slower decay may be hidden. With a factor of 0.65 instead of
 * one half, two of 11,200 numbers had a larger error than stated. */
double gauss_rule_error(const gauss_rule *rule, const legendre_top *top)
{
    const double *c = top->coefficient;
    double pair[LEGENDRE_TOP / 2] = {0};
    for (size_t k = 0; k < LEGENDRE_TOP; k++)
        pair[k / 2] = larger_number(pair[k / 2], fabs(c[k]));
    const bool three = rule->n > 4;
    if (!(pair[2] < pair[1]) || (three && !(pair[1] < pair[0])))
        return 2 * larger_number(pair[1], pair[2]);
    const double square = larger_number(pair[2] / pair[1], three ? pair[1] / pair[0] : 0);
    const double rate = sqrt(square);
    const double last =
        larger_number(larger_number(fabs(c[LEGENDRE_TOP - 1]), rate * fabs(c[LEGENDRE_TOP - 2])),
                      square * pair[1]);
    double fall = 2 * last, power = rate;
    for (size_t left = (rule->n + 1) / 2; left > 0; left /= 2, power *= power)
        fall *= left % 2 ? power : 1;
    return fall;
}

static gauss_rule *create_gauss_rule(size_t n)
{
    const size_t row_stride = (n + WIDE - 1) / WIDE * WIDE;
    gauss_rule *made = wt_alloc(1, sizeof *made + n * (row_stride + 2 + LEGENDRE_TOP_STRIDE) *
                                                      sizeof *made->numbers);
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(n);
    if (table == NULL)
        out_of_memory(sizeof *table);
    made->n = n;
    made->row_stride = row_stride;
    made->node = made->numbers;
    made->weight = made->node + n;
    made->running = made->weight + n;
    made->top = made->running + n * row_stride;
    for (size_t i = 0; i < n; i++)
        gsl_integration_glfixed_point(-1, 1, i, &made->node[i], &made->weight[i], table);
    fill_running_weights(made);
    gsl_integration_glfixed_table_free(table);
    return made;
}

const gauss_rule *gauss_rule_get(size_t n)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static gauss_rule *made[GAUSS_NODES_MAX + 1];
    gsl_quiet();
    pthread_mutex_lock(&lock);
    if (made[n] == NULL)
        made[n] = create_gauss_rule(n);
    pthread_mutex_unlock(&lock);
    return made[n];
}
