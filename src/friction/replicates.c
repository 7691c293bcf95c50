/* Standard errors from Monte Carlo replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "friction/replicates.h"
#include "core/base/memory.h"
#include "dma/rubber.h"
#include "friction/numerics/angular.h"
#include "friction/sliding_contact.h"

#include "core/math/cholesky.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Appends an item to a list of text; the text is truncated at the size. */
static void append_list_item(char *list, size_t size, const char *words)
{
    const size_t used = strlen(list);
    snprintf(list + used, size - used, "%s%s", used > 0 ? ", " : "", words);
}

static void add_error_source(replicates *r, const char *words)
{
    if (r->work->replicates < 2) {
        append_list_item(r->lacks, sizeof r->lacks, words);
        return;
    }
    r->varies = true;
    r->n = r->work->replicates;
    append_list_item(r->includes, sizeof r->includes, words);
}

/* Adds a draw with a linear effect. Beyond the capacity, its effect is part of the nonlinear rest,
 * as that of the material. */
static void add_linear_draw(replicates *r, flow_draw draw)
{
    if (r->n_draws < REPLICATES_MAX_DRAWS)
        r->draw[r->n_draws++] = draw;
}

void replicates_add(replicates *r, double standard_error, flow_draw draw, const char *words)
{
    if (standard_error > 0) {
        add_error_source(r, words);
        add_linear_draw(r, draw);
    } else {
        append_list_item(r->lacks, sizeof r->lacks, words);
    }
}

replicates replicates_create(const wt_sliding *sliding, const wt_job *work, const char *what)
{
    const wt_rubber *rubber = sliding->rubber;
    replicates r = {.sliding = sliding, .work = work, .quantity = what};
    if (rubber->n_draws > 0) {
        add_error_source(&r, rubber->law.kind == WT_LAW_NONE ? "material"
                                                             : "material with its shift law");
    } else {
        append_list_item(r.lacks, sizeof r.lacks, "material");
        if (rubber->c1_error > 0 || rubber->c2_error > 0)
            replicates_add(&r, 1, FLOW_DRAW_SHIFT_LAW, "shift law");
    }
    replicates_add(&r, sliding->pressure.standard_error, FLOW_DRAW_PRESSURE, "pressure");
    replicates_add(&r, sliding->temperature.standard_error, FLOW_DRAW_TEMPERATURE, "temperature");
    const bool measured = sliding->surface->modes_error != NULL;
    const double places = sliding->surface->c0.standard_error;
    if (places > 0 || !sliding->surface->has_position_scatter) /* otherwise the positions differ by
                                                          no more than the scatter of the modes */
        replicates_add(&r, places, FLOW_DRAW_DENSITY,
                       measured ? "places of the surface" : "roughness");
    if (measured)
        add_error_source(&r, "scatter of the spectrum");
    if (sliding->strain_softening != NULL) {
        const bool drawn = strain_softening_has_errors(sliding->strain_softening);
        replicates_add(&r, drawn, FLOW_DRAW_SOFT_STORAGE, "softening with strain");
        if (drawn)
            add_linear_draw(&r, FLOW_DRAW_SOFT_LOSS);
    }
    return r;
}

void replicates_add_layer(replicates *r, const wt_layer_observation *observation, const char *ratio)
{
    replicates_add(r, observation->modulus_ratio.standard_error, FLOW_DRAW_RATIO, ratio);
    if (observation->ratio_slope.value != 0 || observation->ratio_slope.standard_error > 0)
        replicates_add(r, observation->ratio_slope.standard_error, FLOW_DRAW_RATIO_SLOPE,
                       "its slope with the frequency");
}

const char *replicates_included_errors(const replicates *r)
{
    return r->varies                 ? r->includes
           : r->work->replicates < 2 ? "nothing, for no replicates were asked for"
                                     : "nothing, for no error was measured or stated";
}

/* ---- drawing --------------------------------------------------------------------------------- */

typedef struct replicate_run {
    replicates *r;
    replicate_fn one;
    const void *user;
} replicate_run;

static wt_status draw_replicate(void *user, size_t i, unsigned worker)
{
    (void)worker;
    const replicate_run *d = user;
    double *out = d->r->value + i * d->r->stride;
    wt_error ignored = WT_ERROR_INIT;
    wt_status status = d->one(d->user, i, out, &ignored);
    for (size_t k = 0; status != WT_OK && k < d->r->stride; k++)
        out[k] = (double)NAN;
    return status == WT_E_MEMORY ? status : WT_OK;
}

/* Prepares the materials for the velocities of this job. A shared cache covers all velocities of
 * the contact, so that the result does not depend on the order of the jobs. */
static wt_status prepare_materials(replicates *r, wt_error *err)
{
    const wt_sliding *s = r->sliding;
    const double *v = s->velocity, reference = flow_reference_velocity(s);
    const bool shared = r->work->drawn != NULL, alone = r->velocity > 0;
    const double single_velocity = alone ? r->velocity : reference;
    double slowest = single_velocity, fastest = single_velocity;
    if (shared || !alone) {
        slowest = fmin(slowest, fmin(v[0], reference));
        fastest = fmax(fastest, fmax(v[s->n_velocity - 1], reference));
    }
    r->drawn = shared ? r->work->drawn : material_cache_new();
    return material_cache_prepare(r->drawn, s, r->work, slowest, fastest, err);
}

static void release_materials(replicates *r)
{
    if (r->drawn != r->work->drawn)
        material_cache_free(r->drawn);
    r->drawn = NULL;
}

/* ---- standard deviations --------------------------------------------------------------------- */

/* Number of coefficients of the linear fit: a constant
      and the slopes. */
enum { MAX_COEFFICIENTS = REPLICATES_MAX_DRAWS + 1 };

/* Accumulates the normal equations of the linear fit to the finite values of quantity k; returns
 * their number. */
static size_t collect_normal_equations(const replicates *r, const double *z, size_t k, double *a,
                                       double *b)
{
    const size_t p = r->n_draws + 1;
    size_t n = 0;
    for (size_t i = 0; i < r->n; i++) {
        const double *row = z + i * p, value = r->value[i * r->stride + k];
        if (!isfinite(value))
            continue;
        n++;
        for (size_t u = 0; u < p; u++) {
            b[u] += row[u] * value;
            for (size_t v = 0; v <= u; v++)
                a[u * p + v] += row[u] * row[v];
        }
    }
    return n;
}

/* Fits quantity k as a linear function of the draws; b receives the constant and the slopes. False
 * if there are too few replicates. */
static bool fit_line(const replicates *r, const double *z, size_t k, double *b, size_t *n)
{
    /* Required replicates for each coefficient, so that the scatter of a slope is small against the
     * rest. */
    enum { REPLICATES_PER_COEFFICIENT = 5 };
    double a[MAX_COEFFICIENTS * MAX_COEFFICIENTS] = {0};
    const size_t p = r->n_draws + 1;
    memset(b, 0, MAX_COEFFICIENTS * sizeof *b);
    *n = collect_normal_equations(r, z, k, a, b);
    return *n >= REPLICATES_PER_COEFFICIENT * p && cholesky_solve(a, p, p, 0, b);
}

/* Standard deviation of quantity k with linear effects of the draws z [n * p]: the squares of the
 * slopes plus the residual variance. The residuals scatter the slopes, which makes each square too
 * large by the residual variance over n; this bias is subtracted. */
static double line_standard_deviation(const replicates *r, const double *z, size_t k)
{
    double b[MAX_COEFFICIENTS], rest = 0, lines = 0;
    const size_t p = r->n_draws + 1;
    size_t n;
    if (!fit_line(r, z, k, b, &n))
        return flow_standard_deviation(r->value + k, r->n, r->stride);
    for (size_t i = 0; i < r->n; i++) {
        double left = r->value[i * r->stride + k];
        for (size_t u = 0; u < p; u++)
            left -= b[u] * z[i * p + u];
        rest += isfinite(left) ? left * left : 0;
    }
    rest /= (double)(n - p);
    for (size_t u = 1; u < p; u++)
        lines += b[u] * b[u];
    return sqrt(lines + rest * (1 - (double)(p - 1) / (double)n));
}

/* Returns [n * p]: 1 and the draws of each replicate. The caller frees
 * it. */
static double *create_draw_matrix(const replicates *r)
{
    const size_t p = r->n_draws + 1;
    double *const z = wt_alloc((r->n + 1) * p, sizeof *z);
    for (size_t i = 0; i < r->n; i++) {
        z[i * p] = 1;
        for (size_t u = 1; u < p; u++)
            z[i * p + u] = flow_draw_normal(r->work->seed, i, r->draw[u - 1]);
    }
    return z;
}

static void compute_standard_errors(replicates *r)
{
    double *const z = create_draw_matrix(r);
    for (size_t k = 0; k < r->stride; k++)
        r->error[k] = line_standard_deviation(r, z, k);
    free(z);
}

wt_status replicates_draw(replicates *r, size_t stride, replicate_fn one, const void *user,
                          wt_error *err)
{
    r->stride = stride;
    r->error = wt_alloc(stride, sizeof *r->error);
    r->value = try_alloc(r->n + 1, stride * sizeof *r->value); /* the number is an option */
    if (r->value == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    replicate_run d = {r, one, user};
    char words[64];
    snprintf(words, sizeof words, "%s replicates", r->quantity);
    wt_status status = r->n > 0 ? prepare_materials(r, err) : WT_OK;
    if (status != WT_OK) {
        release_materials(r);
        return status;
    }
    status = wt_parallel_for(r->n, r->work->threads, draw_replicate, &d, &r->work->progress, words);
    release_materials(r);
    if (status != WT_OK)
        return wt_fail(err, status, "the replicates of the %s failed", r->quantity);
    size_t n_unsolved = 0;
    for (size_t i = 0; i < r->n; i++)
        n_unsolved += isnan(r->value[i * stride]) != 0;
    if (n_unsolved > 0)
        wt_log_add(r->work->log, WT_WARNING, NULL, NULL,
                   "%zu of %zu replicates of the %s have no solution and are left out of the "
                   "standard errors",
                   n_unsolved, r->n, r->quantity);
    compute_standard_errors(r);
    return WT_OK;
}

void replicates_clear(replicates *r)
{
    free(r->error);
    free(r->value);
    r->error = r->value = NULL;
}
