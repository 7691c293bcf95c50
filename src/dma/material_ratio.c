/* Moduli of materials with their errors, the ratio of two materials, and the verdict on their
 * difference: yes, no within a margin, or inconclusive with a remedy.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/material_comparison.h"

#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/math/students_t.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- moduli and ratios ----------------------------------------------------------------------- */

enum { Q = MATERIALS_QUANTITIES };

void material_values_clear(material_values *v)
{
    free(v->value);
    free(v->draw);
    *v = (material_values){0};
}

/* Computes the log moduli of one draw. Consecutive points of one temperature share one material. */
static wt_status compute_log_moduli(const wt_rubber *rubber, const comparison_point *point,
                                    size_t n, uint64_t seed, size_t replicate, double *value,
                                    wt_error *err)
{
    double *omega = wt_alloc(3 * n, sizeof *omega);
    double *storage = omega + n, *loss = storage + n;
    wt_status status = WT_OK;
    for (size_t first = 0, last; status == WT_OK && first < n; first = last) {
        wt_material *material = NULL;
        for (last = first; last < n && point[last].temperature == point[first].temperature; last++)
            omega[last - first] = point[last].frequency;
        status = wt_rubber_material(rubber, point[first].temperature, seed, replicate, &material,
                                    NULL, err);
        if (status != WT_OK)
            break;
        material->law->modulus(material, omega, last - first, storage, loss);
        wt_material_free(material);
        for (size_t i = first; i < last; i++) {
            value[i * Q + MATERIALS_E1] = log(storage[i - first]);
            value[i * Q + MATERIALS_E2] = log(loss[i - first]);
            value[i * Q + MATERIALS_TAN] = log(loss[i - first] / storage[i - first]);
        }
    }
    free(omega);
    return status;
}

/* Subtracts the mean from the draws and computes their standard deviation. */
static void centre_draws(material_values *v)
{
    const size_t m = v->n * Q;
    for (size_t k = 0; k < m; k++) {
        double mean = 0, square = 0;
        for (size_t d = 0; d < v->n_draws; d++)
            mean += v->draw[d * m + k] / (double)v->n_draws;
        for (size_t d = 0; d < v->n_draws; d++) {
            v->draw[d * m + k] -= mean;
            square += v->draw[d * m + k] * v->draw[d * m + k];
        }
        v->error[k] = sqrt(square / (double)(v->n_draws - 1));
    }
}

wt_status material_values_compute(const wt_rubber *rubber,
                                  const material_systematic_errors *systematic,
                                  const comparison_point *point, size_t n, const wt_job *work,
                                  material_values *v, wt_error *err)
{
    const size_t m = n * Q;
    *v = (material_values){.n = n, .n_draws = rubber->n_draws > 1 ? rubber->n_draws : 0};
    v->value = wt_alloc(2 * m, sizeof *v->value);
    v->draw = wt_alloc(v->n_draws * m, sizeof *v->draw);
    v->error = v->value + m;
    wt_status status =
        compute_log_moduli(rubber, point, n, work->seed, WT_NO_REPLICATE, v->value, err);
    for (size_t d = 0; status == WT_OK && d < v->n_draws; d++)
        status = compute_log_moduli(rubber, point, n, work->seed, d, v->draw + d * m, err);
    if (status != WT_OK)
        return status;
    if (v->n_draws > 0)
        centre_draws(v);
    for (size_t k = 0; k < m; k++)
        v->error[k] =
            v->n_draws == 0
                ? (double)NAN
                : hypot(v->error[k], hypot(systematic->misfit[k % Q], systematic->sample[k % Q]));
    return WT_OK;
}

void material_ratio_clear(material_ratio *r)
{
    free(r->value);
    *r = (material_ratio){0};
}

/* Finds the 95 % quantile of the largest deviation over pairs of draws, in standard errors.
 * Draws of equal number share random numbers, so only different numbers are paired. */
static void find_critical_deviation(const material_values *a, const material_values *b,
                                    material_ratio *r)
{
    enum { PAIRINGS = 4 }; /* pairs for each draw; a draw is expensive, a pair is not */
    const size_t m = r->n * Q, n = PAIRINGS * a->n_draws;
    double *most = wt_alloc(n, sizeof *most);
    for (size_t i = 0; i < n; i++) {
        const size_t d = i % a->n_draws, pairing = i / a->n_draws + 1;
        const size_t e = (d + pairing * b->n_draws / (PAIRINGS + 1)) % b->n_draws;
        for (size_t k = 0; k < m; k++)
            most[i] = fmax(most[i], fabs(b->draw[e * m + k] - a->draw[d * m + k]) / r->error[k]);
    }
    numbers_sort(most, n);
    r->critical = fmax(most[(size_t)(0.95 * (double)n)], NORMAL_95);
    free(most);
}

material_ratio material_ratio_compute(const material_values *first, const material_values *second)
{
    const size_t m = first->n * Q;
    material_ratio r = {.n = first->n, .errors_known = first->n_draws > 0 && second->n_draws > 0};
    r.value = wt_alloc(2 * m, sizeof *r.value);
    r.error = r.value + m;
    for (size_t k = 0; k < m; k++) {
        r.value[k] = second->value[k] - first->value[k];
        r.error[k] = hypot(first->error[k], second->error[k]);
    }
    if (r.errors_known)
        find_critical_deviation(first, second, &r);
    return r;
}

/* ---- verdict --------------------------------------------------------------------------------- */

static const char *const quantity_names[Q] = {"E'", "E''", "tan delta"};

/* Result for one quantity over all compared points. */
typedef struct quantity_difference {
    double low, high;      /* extremes of the ratio */
    bool differs, within;  /* significant at some point; within the margin at all points */
    size_t widest;         /* index of the point whose interval is farthest from 1 */
    double farthest_limit; /* limit of that interval, |ln ratio| */
} quantity_difference;

static quantity_difference assess_quantity(const material_ratio *r, int q, double margin)
{
    quantity_difference f = {(double)INFINITY, 0, false, true, 0, 0};
    for (size_t i = 0; i < r->n; i++) {
        const double x = r->value[i * Q + (size_t)q], e = r->error[i * Q + (size_t)q];
        const double farthest_limit = fabs(x) + NORMAL_95 * e;
        f.low = fmin(f.low, exp(x));
        f.high = fmax(f.high, exp(x));
        f.differs = f.differs || fabs(x) > r->critical * e;
        f.within = f.within && farthest_limit < margin;
        if (farthest_limit > f.farthest_limit) {
            f.farthest_limit = farthest_limit;
            f.widest = i;
        }
    }
    return f;
}

static void append_quantity_list(char *text, size_t size, const quantity_difference *f,
                                 bool (*matches)(const quantity_difference *))
{
    size_t n = 0, left = 0;
    for (int q = 0; q < Q; q++)
        left += matches(&f[q]);
    for (int q = 0; q < Q; q++) {
        if (!matches(&f[q]))
            continue;
        left--;
        clocale_append(text, size, "%s%s",
                       n++ == 0    ? ""
                       : left == 0 ? " and "
                                   : ", ",
                       quantity_names[q]);
    }
}

static bool is_equivalent(const quantity_difference *f)
{
    return f->within && !f->differs;
}

static bool is_difference_inconclusive(const quantity_difference *f)
{
    return !f->within && !f->differs;
}

static void append_differences(const quantity_difference *f, const wt_compared_material pair[2],
                               material_verdict *v)
{
    int n = 0, left = 0;
    for (int q = 0; q < Q; q++)
        left += f[q].differs;
    clocale_append(v->differs, sizeof v->differs, "yes: %s has ", pair[1].name);
    for (int q = 0; q < Q; q++) {
        if (!f[q].differs)
            continue;
        left--;
        clocale_append(v->differs, sizeof v->differs, "%s%.3g",
                       n++ == 0    ? ""
                       : left == 0 ? " and "
                                   : ", ",
                       f[q].low);
        if (f[q].high > 1.01 * f[q].low)
            clocale_append(v->differs, sizeof v->differs, " to %.3g", f[q].high);
        clocale_append(v->differs, sizeof v->differs, " times the %s%s", quantity_names[q],
                       f[q].within ? " (within the margin)" : "");
    }
    clocale_append(v->differs, sizeof v->differs, " of %s", pair[0].name);
    char list[48] = "";
    append_quantity_list(list, sizeof list, f, is_equivalent);
    if (list[0] != '\0')
        clocale_append(v->differs, sizeof v->differs, "; within the margin: %s", list);
    list[0] = '\0';
    append_quantity_list(list, sizeof list, f, is_difference_inconclusive);
    if (list[0] != '\0')
        clocale_append(v->differs, sizeof v->differs, "; not shown to differ: %s", list);
}

/* Names the largest contribution to the widest inconclusive interval as the remedy. */
static void append_remedy(const quantity_difference *f, const wt_compared_material pair[2],
                          const material_values values[2],
                          const material_systematic_errors systematic[2], material_verdict *v)
{
    int worst = -1;
    for (int q = 0; q < Q; q++)
        if (is_difference_inconclusive(&f[q]) &&
            (worst < 0 || f[q].farthest_limit > f[worst].farthest_limit))
            worst = q;
    if (worst < 0)
        return;
    double part[2], sample = 0, misfit[2];
    for (int k = 0; k < 2; k++) {
        part[k] = pow(values[k].error[f[worst].widest * Q + (size_t)worst], 2);
        misfit[k] = pow(systematic[k].misfit[worst], 2);
        sample += pow(systematic[k].sample[worst], 2);
    }
    const int larger = part[1] > part[0];
    const double sum = part[0] + part[1];
    if (sample > sum / 2)
        clocale_append(v->settled_by, sizeof v->settled_by,
                       "dimensions of the samples known better than sample-error, or several "
                       "samples of each");
    else if (misfit[larger] > sum / 2)
        clocale_append(
            v->settled_by, sizeof v->settled_by,
            "a master curve of %s in which superposition holds: most of the interval is its misfit",
            pair[larger].name);
    else
        clocale_append(
            v->settled_by, sizeof v->settled_by,
            "more isotherms of %s, or less noise in them: it has %.0f %% of the variance where the "
            "interval is widest",
            pair[larger].name, 100 * part[larger] / sum);
}

static void append_missing_errors(const wt_compared_material pair[2],
                                  const material_values values[2], material_verdict *v)
{
    const bool both = values[0].n_draws == 0 && values[1].n_draws == 0;
    const char *name = pair[values[0].n_draws == 0 ? 0 : 1].name;
    clocale_append(v->differs, sizeof v->differs, "inconclusive: the error of %s%s%s is not known",
                   name, both ? " and of " : "", both ? pair[1].name : "");
    clocale_append(
        v->settled_by, sizeof v->settled_by,
        "the isotherms of %s%s%s, or what `weartrack master` makes of them with its tables of "
        "draws",
        name, both ? " and of " : "", both ? pair[1].name : "");
}

material_verdict material_assess(const wt_compared_material pair[2],
                                 const material_values values[2],
                                 const material_systematic_errors systematic[2],
                                 const material_ratio *ratio, double margin)
{
    material_verdict v = {0};
    quantity_difference f[Q];
    bool differs = false, within = true;
    if (!ratio->errors_known) {
        append_missing_errors(pair, values, &v);
        return v;
    }
    for (int q = 0; q < Q; q++) {
        f[q] = assess_quantity(ratio, q, log1p(margin));
        differs = differs || f[q].differs;
        within = within && f[q].within;
    }
    if (differs) {
        append_differences(f, pair, &v);
    } else if (within) {
        clocale_append(v.differs, sizeof v.differs,
                       "no: E', E'' and tan delta of %s are those of %s within %.3g %%, the margin "
                       "set",
                       pair[1].name, pair[0].name, 100 * margin);
    } else {
        char list[48] = "";
        append_quantity_list(list, sizeof list, f, is_difference_inconclusive);
        clocale_append(v.differs, sizeof v.differs,
                       "inconclusive: the intervals of the ratio of %s have room for no difference "
                       "and for one "
                       "above %.3g %%",
                       list, 100 * margin);
    }
    append_remedy(f, pair, values, systematic, &v);
    return v;
}
