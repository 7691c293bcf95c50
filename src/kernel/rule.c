/* Gauss-Legendre rules and their running integrals.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "kernel/rule.h"

#include "base/gsl_quiet.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <stdlib.h>

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
static void fill_running(gauss_rule *rule, double *at_i, double *at_j)
{
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

wt_status rule_new(size_t n, gauss_rule **rule, wt_error *err)
{
    gsl_quiet();
    wt_status status = WT_OK;
    gauss_rule *made = calloc(1, sizeof *made);
    double *scratch = calloc(2 * (n + 1), sizeof *scratch);
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(n);
    if (made) {
        made->n = n;
        made->node = calloc(n, sizeof *made->node);
        made->weight = calloc(n, sizeof *made->weight);
        made->running = calloc(n * n, sizeof *made->running);
    }
    if (made == NULL || scratch == NULL || table == NULL || made->node == NULL ||
        made->weight == NULL || made->running == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "out of memory for a quadrature rule");
        goto done;
    }
    for (size_t i = 0; i < n; i++)
        if (gsl_integration_glfixed_point(-1, 1, i, &made->node[i], &made->weight[i], table) !=
            GSL_SUCCESS) {
            status = wt_fail(err, WT_E_INTERNAL, "no quadrature rule of %zu nodes", n);
            goto done;
        }
    fill_running(made, scratch, scratch + n + 1);
    *rule = made;
    made = NULL;
done:
    rule_free(made);
    free(scratch);
    gsl_integration_glfixed_table_free(table);
    return status;
}

void rule_free(gauss_rule *rule)
{
    if (rule == NULL)
        return;
    free(rule->node);
    free(rule->weight);
    free(rule->running);
    free(rule);
}
