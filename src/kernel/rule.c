/* Gauss-Legendre rules and their running integrals.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/rule.h"

#include "base/gsl_quiet.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

/* P_0(x) ... P_n(x). */
static void legendre(size_t n, double x, double *p)
{
    p[0] = 1;
    p[1] = x;
    for (size_t k = 1; k < n; k++) {
        const double degree = (double)k;
        p[k + 1] = ((2 * degree + 1) * x * p[k] - degree * p[k - 1]) / (degree + 1);
    }
}

/* l_i(x) = w_i sum_k (k + 1/2) P_k(x_i) P_k(x), and int P_k = (P_{k+1} - P_{k-1}) / (2k + 1). */
static void fill_running(gauss_rule *rule)
{
    double at_i[RULE_MOST + 1], at_j[RULE_MOST + 1];
    const size_t n = rule->n;
    for (size_t i = 0; i < n; i++) {
        legendre(n, rule->node[i], at_i);
        for (size_t j = 0; j < n; j++) {
            legendre(n, rule->node[j], at_j);
            double sum = (rule->node[j] + 1) / 2;
            for (size_t k = 1; k < n; k++)
                sum += at_i[k] * (at_j[k + 1] - at_j[k - 1]) / 2;
            rule->running[i * n + j] = rule->weight[i] * sum;
        }
    }
}

wt_status rule_new(size_t n, pool *memory, gauss_rule **rule, wt_error *err)
{
    gsl_quiet();
    wt_status status = WT_OK;
    gauss_rule *made = pool_alloc(memory, 1, sizeof *made + n * (n + 2) * sizeof *made->numbers);
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(n);
    if (made == NULL || table == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory for a quadrature rule");
        goto done;
    }
    made->n = n;
    made->node = made->numbers;
    made->weight = made->node + n;
    made->running = made->weight + n;
    for (size_t i = 0; i < n; i++)
        if (gsl_integration_glfixed_point(-1, 1, i, &made->node[i], &made->weight[i], table) !=
            GSL_SUCCESS) {
            status = wt_fail(err, WT_E_INTERNAL, "no quadrature rule of %zu nodes", n);
            goto done;
        }
    fill_running(made);
    *rule = made;
done:
    gsl_integration_glfixed_table_free(table);
    return status;
}
