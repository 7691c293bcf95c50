/* The mixture over widths of the vertical shift and over temperature errors, with the feedback
 * of the law on spectrum and shifts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/posterior.h"

#include "core/math/arena_gsl.h"
#include "core/math/cholesky.h"

#include <gsl/gsl_linalg.h>
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

const posterior_cell *posterior_best(const wt_posterior *p)
{
    const posterior_cell *best = &p->cells[0];
    for (size_t c = 1; c < p->n_cells; c++)
        if (p->cells[c].log_weight > best->log_weight)
            best = &p->cells[c];
    return best;
}

/* Returns true if a cell has a relevant weight among those stored. */
static bool posterior_counts(const wt_posterior *p, const posterior_cell *cell)
{
    /* the law cannot raise a smaller weight enough */
    return cell->log_weight > posterior_best(p)->log_weight + 2.0 * log(least_share);
}

/* Computes the shares of the shifts in the factor of the border. */
static void fill_through(const spectrum *s, posterior_cell *c)
{
    const size_t m = c->factor.m;
    double *const border = s->border, *const side = s->side;
    gsl_matrix_const_view root = gsl_matrix_const_submatrix(c->factor.border, 0, 0, m, m);
    for (size_t i = 0; i < s->n_curves; i++) {
        double *const own = side + BLOCK_SIDE * i;
        const double *first = gsl_matrix_const_ptr(c->factor.side, BLOCK_SIDE * i, 0),
                     *second = gsl_matrix_const_ptr(c->factor.side, BLOCK_SIDE * i + 1, 0);
        posterior_unit_shift(c, i, own);
        for (size_t j = 0; j < m; j++)
            border[j] = -own[0] * first[j] - own[1] * second[j];
        dense_forward(&root.matrix, border);
        for (size_t j = 0; j < m; j++)
            gsl_matrix_set(c->through, j, i, s->column_a[i] < 0 ? 0.0 : border[j]);
    }
}

wt_status posterior_store(wt_posterior *p, wt_vertical_shift kind, const vertical *v,
                          double log_weight, wt_error *err)
{
    const spectrum *s = &p->frame;
    const size_t n = s->n_curves, m = s->factor.m;
    arena *const memory = &p->memory;
    posterior_cell *c = &p->cells[p->n_cells++];
    *c = (posterior_cell){.value = arena_numbers(memory, s->n_unknowns),
                          .noise = {s->noise[STORAGE], s->noise[LOSS]},
                          .smoothness = s->smoothness,
                          .geometry = v->geometry,
                          .departure = v->departure,
                          .log_weight = log_weight,
                          .has_converged = s->settled};
    p->step_left = fmax(p->step_left, spectrum_step_left(s));
    memcpy(c->value, s->value, s->n_unknowns * sizeof *c->value);
    if (!posterior_counts(p, c))
        return WT_OK;
    const wt_status status = spectrum_consider_compliance(&p->frame, err);
    if (status != WT_OK)
        return status;
    c->factor = bordered_new(memory, m, n);
    bordered_copy(&c->factor, &s->factor);
    c->through = arena_matrix(memory, m, n);
    fill_through(s, c);
    c->block = arena_numbers(memory, BLOCK_DIAGONAL * n);
    memcpy(c->block, s->covariance.diagonal, BLOCK_DIAGONAL * n * sizeof *c->block);
    if (kind == WT_VERTICAL_TIED) { /* no components without a departure of the material */
        c->n_smooth = s->prior->n_smooth;
        c->smooth_part = arena_matrix(memory, n, s->prior->smooth_part->size2);
        gsl_matrix_memcpy(c->smooth_part, s->prior->smooth_part);
    }
    return WT_OK;
}

void posterior_restore(wt_posterior *p, const posterior_cell *cell)
{
    spectrum *s = &p->frame;
    memcpy(s->value, cell->value, s->n_unknowns * sizeof *cell->value);
    for (int q = 0; q < MODULI; q++)
        s->noise[q] = cell->noise[q];
    s->smoothness = cell->smoothness;
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

void posterior_unit_shift(const posterior_cell *cell, size_t curve, double x[BLOCK_SIDE])
{
    const double *diagonal = cell->factor.diagonal + BLOCK_DIAGONAL * curve;
    x[0] = 1.0 / diagonal[0];
    x[1] = -diagonal[1] * x[0] / diagonal[2];
}

/* ---- shift law ------------------------------------------------------------------------------- */

double posterior_shift(const wt_posterior *p, const double *value, size_t curve)
{
    const long column = p->frame.column_a[curve];
    return column < 0 ? p->frame.given_a[curve] : value[column];
}

double posterior_vertical_shift(const wt_posterior *p, const double *value, size_t curve)
{
    const long column = p->frame.column_b[curve];
    const double given = p->frame.given_b[curve];
    return column >= 0 ? value[column] : isnan(given) ? p->mean_b[curve] : given;
}

void posterior_smooth_b(const wt_posterior *p, const posterior_cell *cell, const double *value,
                        double *log_b)
{
    const size_t n = p->frame.n_curves;
    const double precision = 1.0 / pow(cell->geometry * M_LN10, 2);
    double at[SPECTRUM_MAX_SMOOTH] = {0.0};
    for (size_t k = 0; k < n; k++)
        for (size_t j = 0; j < cell->n_smooth; j++)
            at[j] += gsl_matrix_get(cell->smooth_part, k, j) * precision *
                     (posterior_vertical_shift(p, value, k) - p->mean_b[k]);
    for (size_t i = 0; i < n; i++) {
        double sum =
            cell->smooth_part != NULL ? p->mean_b[i] : posterior_vertical_shift(p, value, i);
        for (size_t j = 0; j < cell->n_smooth; j++)
            sum += gsl_matrix_get(cell->smooth_part, i, j) * at[j];
        log_b[i] = (isnan(p->frame.given_b[i]) ? sum : p->frame.given_b[i]) / M_LN10;
    }
}

/* Sets the shifts of a cell and their covariance, in decades. */
static void set_cell_shifts(const wt_posterior *p, const posterior_cell *cell)
{
    gsl_matrix *const covariance = p->data.covariance, *const by = cell->through;
    const size_t n = p->frame.n_curves;
    gsl_matrix_set_zero(covariance);
    for (size_t i = 0; i < n; i++) {
        p->data.log_a[i] = posterior_shift(p, cell->value, i) / M_LN10;
        dense_add_rows(gsl_matrix_ptr(covariance, i, 0), n, gsl_matrix_const_ptr(by, 0, i), by->tda,
                       by->data, by->tda, by->size1);
        gsl_matrix_set(covariance, i, i,
                       p->frame.column_a[i] < 0 ? 0.0 : cell->block[BLOCK_DIAGONAL * i]);
    }
    gsl_matrix_scale(covariance, 1.0 / (M_LN10 * M_LN10));
    if (p->extra_covariance != NULL)
        gsl_matrix_add(covariance, p->extra_covariance);
}

/* Computes the feedback of the law on spectrum and shifts. */
static wt_status component_fill(wt_posterior *p, posterior_component *component, wt_error *err)
{
    const law_data *data = &p->data;
    const size_t n = data->n, k = component->law.n_unknowns;
    component->pull = arena_vector(&p->memory, n);
    component->root = arena_matrix(&p->memory, n, n);
    component->design = arena_matrix(&p->memory, n, k);
    const wt_status status = law_gls_covariance(data, component->spread, component->root, err);
    if (status != WT_OK)
        return status;
    law_design(data, &p->shape, component->law.unknown, component->design);
    for (size_t u = 0; u < k; u++) {
        gsl_vector_view column = gsl_matrix_column(component->design, u);
        gsl_linalg_cholesky_svx(component->root, &column.vector);
    }
    for (size_t i = 0; i < n; i++)
        gsl_vector_set(component->pull, i,
                       law_isotherm_value(data, &p->shape, component->law.unknown, i) -
                           data->log_a[i]);
    gsl_linalg_cholesky_svx(component->root, component->pull);
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
        double top = -HUGE_VAL;
        bool relevant = true; /* not above a temperature error with negligible weight */
        for (size_t i = 0; relevant && i < LAW_SPREADS; i++, (*n)++) {
            posterior_component *one = &component[*n];
            *one = (posterior_component){.cell = &p->cells[c], .spread = law_spread(i)};
            wt_status status = law_gls_covariance(&p->data, one->spread, root, err);
            if (status == WT_OK)
                status = law_fit_gls(&p->data, &p->shape, root, &one->law, err);
            if (status != WT_OK)
                return status;
            one->weight = p->cells[c].log_weight - 0.5 * law_reml(&one->law) +
                          log(law_spread_prior(&p->data, one->spread));
            relevant = !(one->weight < top + 2.0 * log(least_share));
            top = fmax(top, one->weight);
        }
        most = fmax(most, top);
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
            status = component_fill(p, kept, err);
        }
    for (size_t i = 0; i < p->n_components; i++)
        p->components[i].weight /= sum;
    return status;
}

/* Uses the cells as components if there is no law. */
static void components_without_law(wt_posterior *p)
{
    p->components = arena_alloc(&p->memory, p->n_cells, sizeof *p->components);
    for (size_t i = 0; i < p->n_cells; i++)
        if (p->cells[i].weight > 0.0) /* the reference has no error */
            p->components[p->n_components++] =
                (posterior_component){.cell = &p->cells[i],
                                      .weight = p->cells[i].weight,
                                      .law = {.unknown = {p->reference_a}}};
    p->shape = (law_shape){.kind = WT_LAW_NONE, .outlier = -1};
}

void posterior_root(const gsl_matrix *covariance, gsl_matrix *root)
{
    for (size_t i = 0; i < covariance->size1; i++)
        for (size_t k = 0; k <= i; k++) {
            double sum = gsl_matrix_get(covariance, i, k);
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
    if (p->extra_covariance != NULL) {
        p->extra_covariance_root = arena_matrix(&p->memory, n, n);
        posterior_root(p->extra_covariance, p->extra_covariance_root);
    }
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
