/* The mixture over widths of the vertical shift and over temperature errors, with the feedback
 * of the law on spectrum and shifts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/posterior.h"

#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"

#include <gsl/gsl_blas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Components below this share are dropped. One that lies entirely outside an interval changes a
 * tail of 2.5 % to 2.6 %. */
static const double least_share = 1e-3;

/* ---- construction ---------------------------------------------------------------------------- */

void posterior_free(wt_posterior *p)
{
    if (p == NULL)
        return;
    spectrum_free(&p->frame);
    arena_free(&p->memory);
    free(p);
}

void posterior_store(wt_posterior *p, const vertical *v, double log_weight)
{
    const spectrum *s = &p->frame;
    const size_t n = s->n_unknowns;
    posterior_cell *c = &p->cells[p->n_cells++];
    *c = (posterior_cell){.value = arena_numbers(&p->memory, n),
                          .noise = {s->noise[STORAGE], s->noise[LOSS]},
                          .smoothness = s->smooth,
                          .geometry = v->geometry,
                          .departure = v->departure,
                          .log_weight = log_weight,
                          .has_converged = s->settled};
    p->step_left = fmax(p->step_left, spectrum_step_left(s));
    memcpy(c->value, s->value, n * sizeof *c->value);
}

wt_status posterior_fill(wt_posterior *p, wt_vertical_shift kind, posterior_cell *c, wt_error *err)
{
    spectrum *s = &p->frame;
    const size_t n = s->n_unknowns;
    arena memory = {0};
    posterior_restore(p, c);
    const wt_status status = spectrum_refresh(s, err);
    if (status != WT_OK)
        return status;
    c->covariance = arena_matrix(&p->memory, n, n);
    c->root = arena_matrix(&p->memory, n, n);
    if (kind == WT_VERTICAL_TIED) { /* zero without a departure of the material */
        c->smooth = arena_numbers(&p->memory, s->n_curves * s->n_curves);
        vertical_smooth_part(s->prior, s->n_curves, c->smooth);
    }
    spectrum_precision(s, c->root);
    for (size_t u = 0; u < n; u++)
        *gsl_matrix_ptr(c->root, u, u) *= 1.0 + s->rounding;
    const bool good = dense_factor(c->root);
    if (good)
        dense_inverse(c->root, arena_matrix(&memory, n, n), c->covariance);
    arena_free(&memory);
    return good ? WT_OK
                : wt_fail(err, WT_E_CONVERGENCE, "the isotherms do not determine a spectrum");
}

bool posterior_counts(const wt_posterior *p, const posterior_cell *cell)
{
    /* the law cannot raise a smaller weight enough */
    return cell->log_weight > posterior_best(p)->log_weight + 2.0 * log(least_share);
}

const posterior_cell *posterior_best(const wt_posterior *p)
{
    const posterior_cell *best = &p->cells[0];
    for (size_t c = 1; c < p->n_cells; c++)
        if (p->cells[c].log_weight > best->log_weight)
            best = &p->cells[c];
    return best;
}

void posterior_restore(wt_posterior *p, const posterior_cell *cell)
{
    spectrum *s = &p->frame;
    memcpy(s->value, cell->value, s->n_unknowns * sizeof *cell->value);
    for (int q = 0; q < MODULI; q++)
        s->noise[q] = cell->noise[q];
    s->smooth = cell->smoothness;
}

static void weigh_cells(wt_posterior *p)
{
    const double most = posterior_best(p)->log_weight;
    double sum = 0.0;
    for (size_t i = 0; i < p->n_cells; i++) {
        p->cells[i].weight =
            posterior_counts(p, &p->cells[i]) ? exp(p->cells[i].log_weight - most) : 0.0;
        sum += p->cells[i].weight;
    }
    for (size_t i = 0; i < p->n_cells; i++)
        p->cells[i].weight /= sum;
}

/* ---- shift law ------------------------------------------------------------------------------- */

bool posterior_column(const wt_posterior *p, size_t curve, size_t *column)
{
    const long c = p->frame.column_a[curve];
    *column = c < 0 ? 0 : (size_t)c;
    return c >= 0;
}

/* Sets the shifts of a cell and their covariance, in decades. */
static void set_cell_shifts(const wt_posterior *p, const posterior_cell *cell)
{
    gsl_matrix *covariance = p->data.covariance;
    gsl_matrix_set_zero(covariance);
    for (size_t i = 0; i < p->frame.n_curves; i++) {
        size_t at, with;
        p->data.log_a[i] =
            (posterior_column(p, i, &at) ? cell->value[at] : p->frame.given_a[i]) / M_LN10;
        for (size_t k = 0; k < p->frame.n_curves; k++)
            if (posterior_column(p, i, &at) && posterior_column(p, k, &with))
                gsl_matrix_set(covariance, i, k,
                               gsl_matrix_get(cell->covariance, at, with) / (M_LN10 * M_LN10));
    }
    if (p->extra_covariance != NULL)
        gsl_matrix_add(covariance, p->extra_covariance);
}

static void component_alloc(wt_posterior *p, posterior_component *component)
{
    const size_t n = p->frame.n_curves;
    component->pull = arena_vector(&p->memory, n);
    component->inner = arena_matrix(&p->memory, n, n);
    component->outer = arena_matrix(&p->memory, n, LAW_MAX_UNKNOWNS);
    component->inverse = arena_matrix(&p->memory, n, n);
}

/* Computes the feedback of the law on spectrum and shifts; root: scratch. */
static wt_status component_fill(wt_posterior *p, posterior_component *component, gsl_matrix *root,
                                wt_error *err)
{
    const law_data *data = &p->data;
    const size_t n = data->n, k = component->law.n_unknowns;
    gsl_matrix *x = arena_matrix(&p->memory, n, k), *mx = arena_matrix(&p->memory, n, k);
    gsl_vector *gap = arena_vector(&p->memory, n);
    component_alloc(p, component);
    const wt_status status = law_gls_covariance(data, component->spread, root, err);
    if (status != WT_OK)
        return status;
    dense_inverse(root, component->inner, component->inverse);
    law_design(data, &p->shape, component->law.unknown, x);
    for (size_t i = 0; i < n; i++)
        gsl_vector_set(gap, i,
                       law_isotherm_value(data, &p->shape, component->law.unknown, i) -
                           data->log_a[i]);
    gsl_matrix_view outer = gsl_matrix_submatrix(component->outer, 0, 0, n, k);
    gsl_matrix_view of_law =
        gsl_matrix_view_array_with_tda(&component->law.covariance[0][0], k, k, LAW_MAX_UNKNOWNS);
    gsl_blas_dgemv(CblasNoTrans, 1.0, component->inverse, gap, 0.0, component->pull);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1.0, component->inverse, x, 0.0, mx);
    gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1.0, mx, &of_law.matrix, 0.0, &outer.matrix);
    gsl_matrix_memcpy(component->inner, component->inverse);
    gsl_blas_dgemm(CblasNoTrans, CblasTrans, -1.0, &outer.matrix, mx, 1.0, component->inner);
    return WT_OK;
}

/* Fits all cells and temperature errors and computes their weights. */
static wt_status fit_components(wt_posterior *p, posterior_component *component, size_t *n,
                                gsl_matrix *root, wt_error *err)
{
    double most = -HUGE_VAL, sum = 0.0;
    for (size_t c = 0; c < p->n_cells; c++) {
        if (!(p->cells[c].weight > 0.0))
            continue;
        set_cell_shifts(p, &p->cells[c]);
        for (size_t i = 0; i < LAW_SPREADS; i++, (*n)++) {
            posterior_component *one = &component[*n];
            *one = (posterior_component){.cell = &p->cells[c], .spread = law_spread(i)};
            wt_status status = law_gls_covariance(&p->data, one->spread, root, err);
            if (status == WT_OK)
                status = law_fit_gls(&p->data, &p->shape, root, &one->law, err);
            if (status != WT_OK)
                return status;
            one->weight = p->cells[c].log_weight - 0.5 * law_reml(&one->law) +
                          log(law_spread_prior(&p->data, one->spread));
            most = fmax(most, one->weight);
        }
    }
    if (!(most > -HUGE_VAL))
        return wt_fail(err, WT_E_RANGE, "the pole of the law is not determined");
    for (size_t i = 0; i < *n; i++)
        sum += component[i].weight = exp(component[i].weight - most);
    for (size_t i = 0; i < *n; i++)
        component[i].weight /= sum;
    return WT_OK;
}

/* Stores the components with a relevant weight. */
static wt_status weigh_components(wt_posterior *p, gsl_matrix *root, wt_error *err)
{
    size_t n = 0;
    double sum = 0.0;
    p->components = arena_alloc(&p->memory, p->n_cells * LAW_SPREADS, sizeof *p->components);
    wt_status status = fit_components(p, p->components, &n, root, err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        if (p->components[i].weight >= least_share) {
            posterior_component *kept = &p->components[p->n_components++];
            *kept = p->components[i];
            sum += kept->weight;
            set_cell_shifts(p, kept->cell);
            status = component_fill(p, kept, root, err);
        }
    for (size_t i = 0; i < p->n_components; i++)
        p->components[i].weight /= sum;
    return status;
}

/* Uses the cells as components if there is no law. */
static void components_without_law(wt_posterior *p)
{
    p->components = arena_alloc(&p->memory, p->n_cells, sizeof *p->components);
    for (size_t i = 0; i < p->n_cells; i++) {
        posterior_component *component = &p->components[p->n_components];
        *component = (posterior_component){.cell = &p->cells[i], .weight = p->cells[i].weight};
        if (!(component->weight > 0.0))
            continue;
        component->law.unknown[0] = p->reference_a; /* without an error */
        component_alloc(p, component);
        p->n_components++;
    }
    p->shape = (law_shape){.kind = WT_LAW_NONE, .outlier = -1};
}

/* Factors the covariance of the additional errors. Rows without such an error, as the reference,
 * are 0. */
static void factor_extra_covariance(wt_posterior *p)
{
    const size_t n = p->frame.n_curves;
    if (p->extra_covariance == NULL)
        return;
    gsl_matrix *root = p->extra_covariance_root = arena_matrix(&p->memory, n, n);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k <= i; k++) {
            double sum = gsl_matrix_get(p->extra_covariance, i, k);
            for (size_t j = 0; j < k; j++)
                sum -= gsl_matrix_get(root, i, j) * gsl_matrix_get(root, k, j);
            const double pivot = gsl_matrix_get(root, k, k);
            gsl_matrix_set(root, i, k,
                           i == k        ? sqrt(fmax(sum, 0.0))
                           : pivot > 0.0 ? sum / pivot
                                         : 0.0);
        }
}

wt_status posterior_finish(wt_posterior *p, double reference, wt_error *err)
{
    const size_t n = p->frame.n_curves;
    gsl_matrix *root = arena_matrix(&p->memory, n, n);
    wt_error failure = WT_ERROR_INIT;
    p->data = (law_data){.n = n,
                         .temperature = p->temperature,
                         .log_a = arena_numbers(&p->memory, n),
                         .covariance = arena_matrix(&p->memory, n, n),
                         .slope = p->slope,
                         .scratch = arena_numbers(&p->memory, n * LAW_SCRATCH)};
    factor_extra_covariance(p);
    weigh_cells(p);
    set_cell_shifts(p, posterior_best(p));
    wt_status status = n < 2 ? wt_fail(&failure, WT_E_RANGE, "one isotherm has no shift")
                             : law_select(&p->data, reference, root, &p->shape, &failure);
    if (status == WT_OK)
        status = weigh_components(p, root, &failure);
    if (status == WT_E_RANGE || status == WT_E_CONVERGENCE) {
        snprintf(p->no_law_reason, sizeof p->no_law_reason, "%s", failure.message);
        components_without_law(p);
        return WT_OK;
    }
    if (status != WT_OK && err != NULL)
        *err = failure;
    return status;
}
