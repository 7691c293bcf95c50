/* One shift law for several samples: generalised least squares over all shifts, averaged over
 * the temperature error. A separate law for each sample is fitted for comparison.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/shared_shift_law_fit.h"
#include "dma/numerics/posterior.h"

#include "core/base/quantity.h"
#include "core/math/arena_gsl.h"
#include "core/math/special.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Maximum number of Newton steps, which double the digits, and minimum number of samples. */
enum { MOST_STEPS = 100, MIN_SAMPLES = 2 };
/* Step that ends the iteration [standard errors]: seven digits. */
static const double convergence_step = 1e-6;
/* Start distance of the pole below the coldest isotherm [K]. Williams, Landel and Ferry (J. Am.
 * Chem. Soc. 77 (1955) 3701) have it 51.6 K below the glass transition. */
static const double typical_pole_distance = 50.0;

/* ---- the shifts of a sample ------------------------------------------------------------------ */

/* Reads the mean shifts over the cells of the posterior and their covariance within and between
 * cells. */
static void read_posterior_shifts(const wt_posterior *p, long left_out, law_member *m)
{
    size_t row = 0;
    for (size_t i = 0; i < p->frame.n_curves; i++) {
        size_t at, with, column = 0;
        if ((long)i == left_out)
            continue;
        m->temperature[row] = p->temperature[i];
        m->slope[row] = p->slope[i];
        for (size_t c = 0; c < p->n_cells; c++)
            m->log_a[row] +=
                p->cells[c].weight / M_LN10 *
                (posterior_column(p, i, &at) ? p->cells[c].value[at] : p->frame.given_a[i]);
        for (size_t k = 0; k < p->frame.n_curves; k++) {
            if ((long)k == left_out)
                continue;
            double mean = 0.0, mean_i = 0.0, mean_k = 0.0;
            const bool free = posterior_column(p, i, &at) && posterior_column(p, k, &with);
            for (size_t c = 0; free && c < p->n_cells; c++) {
                const posterior_cell *cell = &p->cells[c];
                if (!(cell->weight > 0.0))
                    continue;
                mean += cell->weight * (gsl_matrix_get(cell->covariance, at, with) +
                                        cell->value[at] * cell->value[with]);
                mean_i += cell->weight * cell->value[at];
                mean_k += cell->weight * cell->value[with];
            }
            gsl_matrix_set(m->covariance, row, column++,
                           (mean - mean_i * mean_k) / (M_LN10 * M_LN10));
        }
        row++;
    }
}

static wt_status add_sample(law_samples *c, const wt_master *master, size_t sample, wt_error *err)
{
    const wt_posterior *p = master->posterior;
    const law_shape *shape = &p->shape;
    law_member *m = &c->members[c->n_members++];
    double constants[LAW_MAX_UNKNOWNS];
    *m = (law_member){.sample = sample,
                      .n = p->frame.n_curves - (shape->outlier >= 0),
                      .first = c->n,
                      .reference = shape->reference,
                      .coldest = shape->coldest};
    m->temperature = arena_numbers(&c->memory, m->n);
    m->log_a = arena_numbers(&c->memory, m->n);
    m->slope = arena_numbers(&c->memory, m->n);
    m->covariance = arena_matrix(&c->memory, m->n, m->n);
    for (size_t i = 0; i < LAW_SPREADS; i++)
        m->root[i] = arena_matrix(&c->memory, m->n, m->n);
    read_posterior_shifts(p, shape->outlier, m);
    posterior_mean_law(p, constants);
    m->main_constant = constants[1];
    if (shape->kind == WT_LAW_WLF) {
        m->distance = constants[law_pole_index(shape)];
    } else if (c->kind == WT_LAW_WLF) { /* same slope, with a typical pole of rubber */
        m->distance = log(typical_pole_distance);
        m->main_constant *= (m->reference - m->coldest + typical_pole_distance) /
                            (GAS_CONSTANT * M_LN10 * m->reference * m->reference);
    }
    c->n += m->n;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < LAW_SPREADS; i++) {
        const law_data data = {.n = m->n, .covariance = m->covariance, .slope = m->slope};
        status = law_gls_covariance(&data, law_spread(i), m->root[i], err);
    }
    return status;
}

/* ---- the fit --------------------------------------------------------------------------------- */

/* Returns the sum of squares in units of the errors. If `cross` is not NULL it also fills the
 * normal equations. */
static double weighted_squares(const law_samples *c, const law_model *model, size_t spread,
                               const double *unknown, gsl_vector *off, gsl_matrix *columns,
                               gsl_matrix *cross, gsl_vector *right)
{
    double sum = 0.0;
    if (cross != NULL) {
        gsl_matrix_set_zero(cross);
        gsl_vector_set_zero(right);
    }
    for (size_t k = 0; k < c->n_members; k++) {
        const law_member *m = &c->members[k];
        size_t at[LOCAL];
        gsl_vector_view y = gsl_vector_subvector(off, 0, m->n);
        shared_law_indices(c, model, k, at);
        for (size_t i = 0; i < m->n; i++) {
            double by[LOCAL];
            const double law = shared_law_value(c, model, k, unknown, m->temperature[i], by);
            if (!isfinite(law))
                return HUGE_VAL;
            gsl_vector_set(off, i, m->log_a[i] - unknown[at[OFFSET]] - law);
            for (size_t u = 0; u < LOCAL; u++)
                gsl_matrix_set(columns, u, i, by[u]);
        }
        gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, m->root[spread], &y.vector);
        for (size_t i = 0; i < m->n; i++)
            sum += gsl_vector_get(off, i) * gsl_vector_get(off, i);
        for (size_t u = 0; cross != NULL && u < LOCAL; u++) {
            gsl_vector_view x = gsl_matrix_subrow(columns, u, 0, m->n);
            double with = 0.0;
            if (at[u] == NO_INDEX)
                continue;
            gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, m->root[spread], &x.vector);
            gsl_blas_ddot(&x.vector, &y.vector, &with);
            *gsl_vector_ptr(right, at[u]) += with;
            for (size_t w = 0; w <= u; w++) {
                gsl_vector_const_view other = gsl_matrix_const_subrow(columns, w, 0, m->n);
                if (at[w] == NO_INDEX)
                    continue;
                gsl_blas_ddot(&x.vector, &other.vector, &with);
                *gsl_matrix_ptr(cross, at[u], at[w]) += with;
                if (u != w)
                    *gsl_matrix_ptr(cross, at[w], at[u]) += with;
            }
        }
    }
    return sum;
}

static void set_start_values(const law_samples *c, const law_model *model, double *unknown)
{
    for (size_t k = c->n_members; k-- > 0;) { /* the law of the first sample is the start for all */
        const law_member *m = &c->members[k];
        size_t at[LOCAL];
        shared_law_indices(c, model, k, at);
        unknown[at[OFFSET]] = 0.0;
        unknown[at[MAIN]] = m->main_constant;
        if (at[POLE] != NO_INDEX)
            unknown[at[POLE]] = m->distance;
        if (at[MOVED] != NO_INDEX) /* places the poles on one another */
            unknown[at[MOVED]] = (m->coldest - exp(m->distance)) -
                                 (c->members[0].coldest - exp(c->members[0].distance));
        if (!model->separate && k == 0 && shared_law_has_pole(c)) {
            /* converts its law to the common reference, with the pole below all isotherms */
            const double pole = m->coldest - exp(m->distance);
            const double product = m->main_constant * (m->reference - pole);
            const double apart = fmax(c->coldest - pole, POLE_NEAREST);
            unknown[at[POLE]] = log(apart);
            unknown[at[MAIN]] = product / (c->reference - c->coldest + apart);
        }
    }
    for (size_t k = 0; k < c->n_members; k++) {
        const law_member *m = &c->members[k];
        double by[LOCAL], sum = 0.0;
        for (size_t i = 0; i < m->n; i++) {
            const double law = shared_law_value(c, model, k, unknown, m->temperature[i], by);
            sum += m->log_a[i] - (isfinite(law) ? law : 0.0);
        }
        unknown[k] = sum / (double)m->n;
    }
}

/* Returns true if the law falls with temperature and its pole is determined. */
static bool is_valid_law(const law_samples *c, const law_model *model, const solution *s)
{
    bool good = true;
    for (size_t k = 0; k < c->n_members; k++) {
        size_t at[LOCAL];
        shared_law_indices(c, model, k, at);
        good = good && s->unknown[at[MAIN]] > 0.0;
        if (at[POLE] != NO_INDEX)
            good = good && s->unknown[at[POLE]] > log(POLE_NEAREST) &&
                   s->unknown[at[POLE]] < log(POLE_FARTHEST) &&
                   gsl_matrix_get(s->covariance, at[POLE], at[POLE]) < POLE_ERROR * POLE_ERROR;
    }
    return good;
}

/* Levenberg-Marquardt steps for one temperature error until convergence. */
static void fit_with_spread(law_samples *c, const law_model *model, size_t spread, solution *s)
{
    const size_t n = model->n_unknowns;
    arena *memory = &c->memory;
    gsl_vector *off = arena_vector(memory, c->n), *right = arena_vector(memory, n),
               *step = arena_vector(memory, n);
    gsl_matrix *columns = arena_matrix(memory, LOCAL, c->n), *cross = arena_matrix(memory, n, n),
               *damped = arena_matrix(memory, n, n);
    double *next = arena_numbers(memory, n), damping = 1e-3;
    s->unknown = arena_numbers(memory, n);
    s->covariance = arena_matrix(memory, n, n);
    s->good = false;
    set_start_values(c, model, s->unknown);
    bool done = false;
    s->chi_square = weighted_squares(c, model, spread, s->unknown, off, columns, cross, right);
    for (int i = 0; i < MOST_STEPS && !done && s->chi_square < HUGE_VAL; i++) {
        gsl_matrix_memcpy(damped, cross);
        for (size_t u = 0; u < n; u++)
            *gsl_matrix_ptr(damped, u, u) *= 1.0 + damping;
        gsl_vector_memcpy(step, right);
        if (gsl_linalg_cholesky_decomp1(damped) != GSL_SUCCESS)
            return;
        gsl_linalg_cholesky_svx(damped, step);
        double size = 0.0;
        for (size_t u = 0; u < n; u++) {
            next[u] = s->unknown[u] + gsl_vector_get(step, u);
            size = fmax(size, fabs(gsl_vector_get(step, u)) * sqrt(gsl_matrix_get(cross, u, u)));
        }
        const double now = weighted_squares(c, model, spread, next, off, columns, NULL, NULL);
        done = size < convergence_step;
        if (!(now <= s->chi_square)) {
            damping *= 10.0;
            continue;
        }
        damping *= 0.1;
        memcpy(s->unknown, next, n * sizeof *next);
        s->chi_square = weighted_squares(c, model, spread, s->unknown, off, columns, cross, right);
    }
    gsl_matrix_memcpy(s->covariance, cross);
    if (!done || gsl_linalg_cholesky_decomp1(s->covariance) != GSL_SUCCESS)
        return;
    s->reml = s->chi_square;
    for (size_t u = 0; u < n; u++)
        s->reml += 2.0 * log(gsl_matrix_get(s->covariance, u, u));
    for (size_t k = 0; k < c->n_members; k++)
        for (size_t i = 0; i < c->members[k].n; i++)
            s->reml += 2.0 * log(gsl_matrix_get(c->members[k].root[spread], i, i));
    gsl_linalg_cholesky_invert(s->covariance);
    s->good = is_valid_law(c, model, s);
}

/* Computes the weights of the temperature errors; false if none is left. The comparison of
 * samples must not depend on the prior of ovens, so that it uses equal weights. */
static bool weigh_spreads(const law_samples *c, bool believed, solution s[LAW_SPREADS])
{
    const law_data all = {.n = c->n};
    double least = HUGE_VAL, sum = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (s[i].good)
            least = fmin(least, s[i].reml);
    for (size_t i = 0; i < LAW_SPREADS; i++) {
        const double prior = believed ? law_spread_prior(&all, law_spread(i)) : law_spread(i);
        s[i].weight = s[i].good ? prior * exp(-0.5 * (s[i].reml - least)) : 0.0;
        sum += s[i].weight;
    }
    for (size_t i = 0; i < LAW_SPREADS; i++)
        s[i].weight = sum > 0.0 ? s[i].weight / sum : 0.0;
    return sum > 0.0;
}

/* ---- interface ------------------------------------------------------------------------------- */

/* Returns the reason why a sample cannot be used, or NULL. Joined laws have constants that
 * others lack. */
static const char *why_not(const wt_master *m)
{
    if (m == NULL || m->posterior == NULL)
        return "it could not be fitted";
    if (m->law.kind == WT_LAW_NONE)
        return "it has no law of its own";
    if (m->law.kind == WT_LAW_WLF_ARRHENIUS)
        return "its own law is Arrhenius joined to WLF";
    return isnan(m->slope.standard_error) ? "its shifts are given" : NULL;
}

/* Returns Arrhenius if no sample shows curvature, otherwise WLF. */
static wt_law_kind shared_law_kind(const wt_master *const *masters, size_t n)
{
    bool bends = false;
    for (size_t i = 0; i < n; i++)
        bends = bends || (why_not(masters[i]) == NULL && masters[i]->law.kind == WT_LAW_WLF);
    return bends ? WT_LAW_WLF : WT_LAW_ARRHENIUS;
}

static wt_status gather_samples(law_samples *c, const wt_master *const *masters, size_t n,
                                wt_shared_shift_law *common, wt_error *err)
{
    wt_status status = WT_OK;
    c->members = arena_alloc(&c->memory, n, sizeof *c->members);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        const char *const reason = why_not(masters[i]);
        if (reason == NULL)
            status = add_sample(c, masters[i], i, err);
        else
            snprintf(common->members[i].reason, sizeof common->members[i].reason, "%s", reason);
    }
    if (status == WT_OK && c->n_members < MIN_SAMPLES) {
        size_t without = 0;
        while (common->members[without].reason[0] == '\0')
            without++;
        wt_fail(err, WT_E_RANGE, "a shared shift law needs two samples or more with a law");
        wt_error_found(err, "%zu of %zu; of sample %zu %s", c->n_members, n, without + 1,
                       common->members[without].reason);
        return WT_E_RANGE;
    }
    if (status == WT_OK && c->sharing == WT_SHARED_LAW_SHIFTED && !shared_law_has_pole(c)) {
        wt_fail(err, WT_E_RANGE, "an Arrhenius law cannot be moved along the temperature");
        wt_error_advice(err, "ask for the same law of all samples");
        return WT_E_RANGE;
    }
    if (status != WT_OK)
        return status;
    const law_member *first = &c->members[0];
    c->reference = isnan(c->reference) ? first->reference : c->reference;
    c->coldest = fmin(c->reference, first->temperature[0]);
    for (size_t k = 1; c->sharing == WT_SHARED_LAW_SAME && k < c->n_members; k++)
        c->coldest = fmin(c->coldest, c->members[k].temperature[0]);
    return WT_OK;
}

static wt_status compute_shared_law(law_samples *c, wt_shared_shift_law *common, wt_error *err)
{
    const law_model of_all = shared_law_model(c, false), of_each = shared_law_model(c, true);
    solution shared[LAW_SPREADS], separate[LAW_SPREADS];
    for (size_t i = 0; i < LAW_SPREADS; i++) {
        fit_with_spread(c, &of_all, i, &shared[i]);
        fit_with_spread(c, &of_each, i, &separate[i]);
    }
    common->points = wt_alloc(c->n, sizeof *common->points);
    if (!weigh_spreads(c, true, shared)) {
        wt_fail(err, WT_E_RANGE, "no one law describes the shifts of all samples");
        wt_error_advice(err, "%s",
                        c->sharing == WT_SHARED_LAW_SAME ? "let it be moved along the temperature"
                                                         : "let each have its own");
        return WT_E_RANGE;
    }
    const bool compared = weigh_spreads(c, false, separate);
    shared_law_fill(c, shared, common);
    common->p = compared ? shared_law_p_value(c, shared, separate) : (double)NAN;
    for (size_t k = 0; k < c->n_members; k++)
        for (size_t i = 0; i < c->members[k].n; i++)
            shared_law_fill_point(c, k, i, shared, separate, compared,
                                  &common->points[common->n++]);
    return WT_OK;
}

wt_status wt_shared_shift_law_fit(const wt_master *const *masters, size_t n,
                                  wt_shared_law_mode sharing, double reference,
                                  wt_shared_shift_law *common_law, wt_error *err)
{
    if (masters == NULL || common_law == NULL || n < MIN_SAMPLES || sharing == WT_SHARED_LAW_NONE)
        return wt_fail(err, WT_E_ARG, "a shared shift law needs two samples or more");
    law_samples c = {
        .sharing = sharing, .reference = reference, .kind = shared_law_kind(masters, n)};
    wt_shared_shift_law made = {.n_members = n, .members = wt_alloc(n, sizeof *made.members)};
    gsl_quiet();
    wt_status status = gather_samples(&c, masters, n, &made, err);
    if (status == WT_OK)
        status = compute_shared_law(&c, &made, err);
    arena_free(&c.memory);
    if (status == WT_OK)
        *common_law = made;
    else
        wt_shared_shift_law_clear(&made);
    return status;
}

void wt_shared_shift_law_clear(wt_shared_shift_law *common)
{
    if (common == NULL)
        return;
    free(common->members);
    free(common->points);
    *common = (wt_shared_shift_law){0};
}
