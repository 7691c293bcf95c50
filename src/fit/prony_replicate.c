/* Replicates of a Prony series for carrying the error of the material on: shifts drawn from their
 * covariance, residuals of whole isotherms resampled. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/gsl_quiet.h"
#include "base/mix.h"
#include "base/pool.h"
#include "fit/prony.h"

#include <float.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <string.h>

/* Replaces a symmetric, positive semi-definite n x n matrix by its lower Cholesky factor; a pivot
 * at rounding level (the reference isotherm has none) gives a column of zeros. */
static void cholesky_semidefinite(double *matrix, size_t n)
{
    double largest = 0.0;
    for (size_t k = 0; k < n; k++)
        largest = fmax(largest, matrix[k * n + k]);
    for (size_t k = 0; k < n; k++) {
        double pivot = matrix[k * n + k];
        for (size_t l = 0; l < k; l++)
            pivot -= matrix[k * n + l] * matrix[k * n + l];
        const bool empty = !(pivot > (double)n * DBL_EPSILON * largest);
        const double root = empty ? 0.0 : sqrt(pivot);
        for (size_t i = k; i < n; i++) {
            double sum = matrix[i * n + k];
            for (size_t l = 0; l < k; l++)
                sum -= matrix[i * n + l] * matrix[k * n + l];
            matrix[i * n + k] = empty ? 0.0 : (i == k ? root : sum / root);
        }
    }
}

struct replicate {
    pool memory;
    double *covariance;                 /* [(2 n_shifts)^2], becomes its Cholesky factor */
    double *normal;                     /* [2 n_shifts] */
    double *da, *db;                    /* [n_shifts] each, one after the other */
    double *frequency, *storage, *loss; /* [n] the replicate's points */
    double *storage_fit, *loss_fit;     /* [n] of the base series */
    size_t *first, *count;              /* [n_shifts] points of an isotherm in `order` */
    size_t *order;                      /* [n] point numbers, isotherm by isotherm */
    size_t *used;                       /* [n_shifts] isotherms that have points */
    size_t n_used;
};

static wt_status replicate_alloc(struct replicate *r, const wt_master_curve *master, wt_error *err)
{
    const size_t m = master->n_shifts, n = master->n;
    double *numbers = pool_numbers(&r->memory, 4 * m * m + 4 * m + 5 * n);
    size_t *indices = pool_alloc(&r->memory, 3 * m + n, sizeof *indices);
    if (r->memory.failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for a replicate of %zu points", n);
    r->covariance = numbers;
    r->normal = r->covariance + 4 * m * m;
    r->da = r->normal + 2 * m;
    r->db = r->da + m;
    r->frequency = r->db + m;
    r->storage = r->frequency + n;
    r->loss = r->storage + n;
    r->storage_fit = r->loss + n;
    r->loss_fit = r->storage_fit + n;
    r->first = indices;
    r->count = r->first + m;
    r->used = r->count + m;
    r->order = r->used + m;
    return WT_OK;
}

static void sort_points(struct replicate *r, const wt_master_curve *master)
{
    for (size_t i = 0; i < master->n; i++)
        r->count[master->isotherm[i]]++;
    size_t next = 0;
    for (size_t k = 0; k < master->n_shifts; k++) {
        r->first[k] = next;
        next += r->count[k];
        if (r->count[k] > 0)
            r->used[r->n_used++] = k;
        r->count[k] = 0;
    }
    for (size_t i = 0; i < master->n; i++) {
        const size_t k = master->isotherm[i];
        r->order[r->first[k] + r->count[k]++] = i;
    }
}

/* Changes of the shifts, all together from their covariance: the errors of neighbours, horizontal
 * and vertical, go together. */
static void draw_shifts(struct replicate *r, const wt_master_curve *master, gsl_rng *rng)
{
    const size_t m = 2 * master->n_shifts;
    memcpy(r->covariance, master->covariance_ab, m * m * sizeof *r->covariance);
    cholesky_semidefinite(r->covariance, m);
    for (size_t i = 0; i < m; i++)
        r->normal[i] = gsl_ran_gaussian_ziggurat(rng, 1.0);
    for (size_t i = 0; i < m; i++) {
        r->da[i] = 0.0; /* db follows da */
        for (size_t j = 0; j <= i; j++)
            r->da[i] += r->covariance[i * m + j] * r->normal[j];
    }
}

/* Each isotherm takes the residuals of one drawn at random, with a random sign, spread over its own
 * length; both moduli alike, so their errors stay related. */
static void draw_residuals(struct replicate *r, const wt_master_curve *master, gsl_rng *rng)
{
    for (size_t u = 0; u < r->n_used; u++) {
        const size_t k = r->used[u];
        const size_t donor = r->used[gsl_rng_uniform_int(rng, (unsigned long)r->n_used)];
        const double sign = gsl_rng_uniform_int(rng, 2) == 0 ? -1.0 : 1.0;
        for (size_t p = 0; p < r->count[k]; p++) {
            const size_t i = r->order[r->first[k] + p];
            const size_t rank = (2 * p + 1) * r->count[donor] / (2 * r->count[k]);
            const size_t from = r->order[r->first[donor] + rank];
            r->frequency[i] = master->log_frequency[i] + r->da[k];
            r->storage[i] = r->storage_fit[i] + r->db[k] +
                            sign * (master->log_storage[from] - r->storage_fit[from]);
            r->loss[i] =
                r->loss_fit[i] + r->db[k] + sign * (master->log_loss[from] - r->loss_fit[from]);
        }
    }
}

wt_status wt_prony_replicate(const wt_master_curve *master, const wt_prony_options *options,
                             uint64_t seed, size_t index, wt_prony *prony, double *change_b,
                             wt_error *err)
{
    const wt_prony_options defaults = wt_prony_defaults();
    struct replicate r = {0};
    wt_prony_fit base = {.prony = {.n = 0}};
    wt_prony made = {0};
    gsl_rng *rng = NULL;

    gsl_quiet();
    if (options == NULL)
        options = &defaults;
    wt_status status = wt_prony_fit_master(master, options, &base, err);
    if (status != WT_OK)
        return status;
    status = replicate_alloc(&r, master, err);
    if (status != WT_OK)
        goto done;
    rng = gsl_rng_alloc(gsl_rng_mt19937);
    if (rng == NULL) {
        status = wt_fail(err, WT_E_MEMORY, "no memory for random numbers");
        goto done;
    }
    gsl_rng_set(rng, (unsigned long)(mix64(mix64(seed) + index) & 0xffffffffU));
    sort_points(&r, master);
    for (size_t i = 0; i < master->n; i++)
        prony_log_moduli(&base.prony, master->log_frequency[i], &r.storage_fit[i], &r.loss_fit[i]);
    draw_shifts(&r, master, rng);
    draw_residuals(&r, master, rng);
    /* The relaxation times stay those of the base series: replicates can be averaged term by
     * term. */
    prony_points points = prony_points_of(master);
    points.log_frequency = r.frequency;
    points.log_storage = r.storage;
    points.log_loss = r.loss;
    status = prony_fit_points(&points, options, &made, err);
    if (status != WT_OK)
        goto done;
    made.deformation = master->deformation;
    made.reference_temperature = master->reference_temperature;
    if (change_b != NULL)
        memcpy(change_b, r.db, master->n_shifts * sizeof *change_b);
    *prony = made;
done:
    gsl_rng_free(rng);
    pool_free(&r.memory);
    wt_prony_clear(&base.prony);
    return status;
}
