/* One shift law for several samples: generalised least squares over all shifts, averaged over
 * the temperature error. A separate law for each sample is fitted for comparison.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/posterior.h"

#include "core/base/quantity.h"
#include "core/math/arena_gsl.h"
#include "core/math/special.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
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

/* Unknowns that a shift of one sample depends on: its offset, the main constant, ln of the pole
 * distance, and the displacement of its law. */
enum { OFFSET, MAIN, POLE, MOVED, LOCAL };
#define NO_INDEX SIZE_MAX

/* Shifts of one sample, without the outlier of its law. */
typedef struct law_member {
    size_t sample, n, first; /* first: row among all shifts */
    double *temperature, *log_a, *slope;
    gsl_matrix *covariance;
    gsl_matrix *root[LAW_SPREADS];
    double reference, coldest; /* of the law of this sample */
    double main_constant, distance;
} law_member;

typedef struct law_samples {
    arena memory;
    wt_shared_law_mode sharing;
    wt_law_kind kind;
    double reference, coldest; /* of the shared law */
    law_member *members;       /* [n_members] */
    size_t n_members, n;       /* n: number of all shifts */
} law_samples;

typedef struct solution {
    double *unknown;        /* [n_unknowns] */
    gsl_matrix *covariance; /* [n_unknowns^2] */
    double chi_square, reml, weight;
    bool good;
} solution;

/* ---- the model ------------------------------------------------------------------------------- */

/* Counts the unknowns of one law for all samples, or of a separate law for each. */
static size_t count_unknowns(const law_samples *c, bool separate)
{
    const size_t laws = separate ? c->n_members : 1, each = c->kind == WT_LAW_WLF ? 2 : 1;
    const size_t moved = !separate && c->sharing == WT_SHARED_LAW_SHIFTED ? c->n_members - 1 : 0;
    return c->n_members + laws * each + moved;
}

/* Fills the indices of the unknowns of a sample; NO_INDEX if absent. */
static void find_indices(const law_samples *c, bool separate, size_t k, size_t place[LOCAL])
{
    const size_t first = c->n_members, each = c->kind == WT_LAW_WLF ? 2 : 1;
    const size_t law = first + (separate ? k * each : 0);
    place[OFFSET] = k;
    place[MAIN] = law;
    place[POLE] = c->kind == WT_LAW_WLF ? law + 1 : NO_INDEX;
    place[MOVED] =
        !separate && c->sharing == WT_SHARED_LAW_SHIFTED && k > 0 ? first + each + k - 1 : NO_INDEX;
}

/* Returns the law of a sample at a temperature [K] without its offset, and the derivatives by
 * its unknowns. NaN at and below the pole. */
static double law_at(const law_samples *c, bool separate, size_t k, const double *unknown,
                     double temperature, double by[LOCAL])
{
    const law_member *m = &c->members[k];
    const double reference = separate ? m->reference : c->reference,
                 coldest = separate ? m->coldest : c->coldest;
    size_t at[LOCAL];
    find_indices(c, separate, k, at);
    const double constant = unknown[at[MAIN]];
    by[OFFSET] = 1.0;
    by[POLE] = by[MOVED] = 0.0;
    if (c->kind != WT_LAW_WLF) {
        by[MAIN] = (reference - temperature) / (reference * temperature) / (GAS_CONSTANT * M_LN10);
        return constant * by[MAIN];
    }
    const double distance = exp(unknown[at[POLE]]);
    const double x = temperature - (at[MOVED] != NO_INDEX ? unknown[at[MOVED]] : 0.0);
    const double rise = x - reference, sum = distance + x - coldest;
    if (!(sum > 0.0))
        return (double)NAN;
    by[MAIN] = -rise / sum;
    by[POLE] = constant * rise / sum * (distance / sum);
    by[MOVED] = constant * (sum - rise) / (sum * sum);
    return constant * by[MAIN];
}

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
                const double a = cell->value[at], b = cell->value[with], w = cell->weight;
                mean += w > 0.0 ? w * (gsl_matrix_get(cell->covariance, at, with) + a * b) : 0.0;
                mean_i += w * a;
                mean_k += w * b;
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
 * normal equations, of which the lower triangle is used. columns: [shifts * unknowns]. */
static double weighted_squares(const law_samples *c, bool separate, size_t spread,
                               const double *unknown, gsl_vector *off, gsl_matrix *columns,
                               gsl_matrix *cross, gsl_vector *right)
{
    double sum = 0.0;
    gsl_matrix_set_zero(columns);
    for (size_t k = 0; k < c->n_members; k++) {
        const law_member *m = &c->members[k];
        size_t at[LOCAL];
        gsl_vector_view y = gsl_vector_subvector(off, m->first, m->n);
        gsl_matrix_view x = gsl_matrix_submatrix(columns, m->first, 0, m->n, columns->size2);
        find_indices(c, separate, k, at);
        for (size_t i = 0; i < m->n; i++) {
            double by[LOCAL];
            const double law = law_at(c, separate, k, unknown, m->temperature[i], by);
            if (!isfinite(law))
                return HUGE_VAL;
            gsl_vector_set(&y.vector, i, m->log_a[i] - unknown[at[OFFSET]] - law);
            for (size_t u = 0; u < LOCAL; u++)
                if (at[u] != NO_INDEX)
                    gsl_matrix_set(&x.matrix, i, at[u], by[u]);
        }
        gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, m->root[spread], &y.vector);
        gsl_blas_dtrsm(CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, 1.0, m->root[spread],
                       &x.matrix);
    }
    gsl_blas_ddot(off, off, &sum);
    if (cross != NULL) {
        gsl_blas_dgemv(CblasTrans, 1.0, columns, off, 0.0, right);
        gsl_blas_dsyrk(CblasLower, CblasTrans, 1.0, columns, 0.0, cross);
    }
    return sum;
}

static void set_start_values(const law_samples *c, bool separate, double *unknown)
{
    for (size_t k = c->n_members; k-- > 0;) { /* the law of the first sample is the start for all */
        const law_member *m = &c->members[k];
        size_t at[LOCAL];
        find_indices(c, separate, k, at);
        unknown[at[OFFSET]] = 0.0;
        unknown[at[MAIN]] = m->main_constant;
        if (at[POLE] != NO_INDEX)
            unknown[at[POLE]] = m->distance;
        if (at[MOVED] != NO_INDEX) /* places the poles on one another */
            unknown[at[MOVED]] = (m->coldest - exp(m->distance)) -
                                 (c->members[0].coldest - exp(c->members[0].distance));
        if (!separate && k == 0 && c->kind == WT_LAW_WLF) {
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
            const double law = law_at(c, separate, k, unknown, m->temperature[i], by);
            sum += m->log_a[i] - (isfinite(law) ? law : 0.0);
        }
        unknown[k] = sum / (double)m->n;
    }
}

/* Returns true if the law falls with temperature and its pole is determined. */
static bool is_valid_law(const law_samples *c, bool separate, const solution *s)
{
    bool good = true;
    for (size_t k = 0; k < c->n_members; k++) {
        size_t at[LOCAL];
        find_indices(c, separate, k, at);
        good = good && s->unknown[at[MAIN]] > 0.0;
        if (at[POLE] != NO_INDEX)
            good = good && s->unknown[at[POLE]] > log(POLE_NEAREST) &&
                   s->unknown[at[POLE]] < log(POLE_FARTHEST) &&
                   gsl_matrix_get(s->covariance, at[POLE], at[POLE]) < POLE_ERROR * POLE_ERROR;
    }
    return good;
}

/* Levenberg-Marquardt steps for one temperature error until convergence. */
static void fit_with_spread(law_samples *c, bool separate, size_t spread, solution *s)
{
    const size_t n = count_unknowns(c, separate);
    arena *memory = &c->memory;
    gsl_vector *off = arena_vector(memory, c->n), *right = arena_vector(memory, n),
               *step = arena_vector(memory, n);
    gsl_matrix *columns = arena_matrix(memory, c->n, n), *cross = arena_matrix(memory, n, n),
               *damped = arena_matrix(memory, n, n);
    double *next = arena_numbers(memory, n), damping = 1e-3;
    bool done = false;
    s->unknown = arena_numbers(memory, n);
    s->covariance = arena_matrix(memory, n, n);
    s->good = false;
    set_start_values(c, separate, s->unknown);
    s->chi_square = weighted_squares(c, separate, spread, s->unknown, off, columns, cross, right);
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
        const double now = weighted_squares(c, separate, spread, next, off, columns, NULL, NULL);
        done = size < convergence_step;
        damping *= now <= s->chi_square ? 0.1 : 10.0;
        if (!(now <= s->chi_square))
            continue;
        memcpy(s->unknown, next, n * sizeof *next);
        s->chi_square =
            weighted_squares(c, separate, spread, s->unknown, off, columns, cross, right);
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
    s->good = is_valid_law(c, separate, s);
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

/* ---- results --------------------------------------------------------------------------------- */

static const wt_interval unknown = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};

static double linear_variance(const solution *s, const size_t at[LOCAL], const double by[LOCAL])
{
    double sum = 0.0;
    for (size_t u = 0; u < LOCAL; u++)
        for (size_t w = 0; w < LOCAL; w++)
            if (at[u] != NO_INDEX && at[w] != NO_INDEX)
                sum += by[u] * by[w] * gsl_matrix_get(s->covariance, at[u], at[w]);
    return fmax(sum, 0.0);
}

/* Returns the interval of an unknown over the temperature errors. */
static wt_interval unknown_interval(const solution s[LAW_SPREADS], size_t u)
{
    mixture_component part[LAW_SPREADS];
    size_t n = 0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (s[i].weight > 0.0)
            part[n++] = (mixture_component){s[i].weight, s[i].unknown[u],
                                            sqrt(gsl_matrix_get(s[i].covariance, u, u))};
    return mixture_interval(part, n);
}

/* Returns the difference of a law between two temperatures for one temperature error, and its
 * variance. */
static double law_difference(const law_samples *c, bool separate, size_t k, const solution *s,
                             double temperature, double from, double *variance)
{
    double by[LOCAL], less[LOCAL];
    size_t at[LOCAL];
    find_indices(c, separate, k, at);
    const double value = law_at(c, separate, k, s->unknown, temperature, by) -
                         law_at(c, separate, k, s->unknown, from, less);
    for (size_t u = 0; u < LOCAL; u++)
        by[u] -= less[u];
    *variance = linear_variance(s, at, by);
    return value;
}

/* What a sample's own law has more than the common one, from the middle of its isotherms on, with
 * the error of its own law: what the common one takes away from it (Hausman 1978) is not known well
 * enough of so few isotherms (tests/unit/test_dma_shared_shift_law_fit.c). */
static wt_interval law_deviation(const law_samples *c, size_t k, const solution shared[LAW_SPREADS],
                                 const solution separate[LAW_SPREADS], double temperature)
{
    mixture_component part[LAW_SPREADS];
    size_t n = 0;
    double sum = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++) {
        double v_own, ignored;
        if (!(separate[i].weight > 0.0) || !shared[i].good)
            continue;
        const double from = numbers_mean(c->members[k].temperature, c->members[k].n);
        const double d = law_difference(c, true, k, &separate[i], temperature, from, &v_own) -
                         law_difference(c, false, k, &shared[i], temperature, from, &ignored);
        part[n++] = (mixture_component){separate[i].weight, d, sqrt(v_own)};
        sum += separate[i].weight;
    }
    for (size_t i = 0; i < n; i++)
        part[i].weight /= sum;
    return n > 0 ? mixture_interval(part, n) : unknown;
}

/* Fills the result for isotherm i of sample k. */
static void fill_point(const law_samples *c, size_t k, size_t i, const solution shared[LAW_SPREADS],
                       const solution separate[LAW_SPREADS], bool compared,
                       wt_shared_law_point *point)
{
    const law_member *m = &c->members[k];
    mixture_component law[LAW_SPREADS];
    size_t n = 0, at[LOCAL];
    double offset = 0.0;
    find_indices(c, false, k, at);
    for (size_t w = 0; w < LAW_SPREADS; w++) {
        double by[LOCAL];
        if (!(shared[w].weight > 0.0))
            continue;
        const double value = law_at(c, false, k, shared[w].unknown, m->temperature[i], by);
        by[OFFSET] = 0.0;
        law[n++] =
            (mixture_component){shared[w].weight, value, sqrt(linear_variance(&shared[w], at, by))};
        offset += shared[w].weight * shared[w].unknown[at[OFFSET]];
    }
    *point = (wt_shared_law_point){
        .sample = m->sample,
        .temperature = m->temperature[i],
        .log_a = m->log_a[i] - offset,
        .log_a_error = sqrt(gsl_matrix_get(m->covariance, i, i)),
        .law = mixture_interval(law, n),
        .difference =
            compared ? law_deviation(c, k, shared, separate, m->temperature[i]) : unknown};
}

/* Returns the correlation of two unknowns (C1 and ln pole distance) over the temperature errors. */
static double constant_correlation(const solution s[LAW_SPREADS], size_t a, size_t b)
{
    double mean[2] = {0.0, 0.0}, square[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (s[i].weight > 0.0) {
            const double w = s[i].weight, x = s[i].unknown[a], y = s[i].unknown[b];
            mean[0] += w * x;
            mean[1] += w * y;
            square[0] += w * (gsl_matrix_get(s[i].covariance, a, a) + x * x);
            square[1] += w * (gsl_matrix_get(s[i].covariance, a, b) + x * y);
            square[2] += w * (gsl_matrix_get(s[i].covariance, b, b) + y * y);
        }
    return (square[1] - mean[0] * mean[1]) /
           sqrt((square[0] - mean[0] * mean[0]) * (square[2] - mean[1] * mean[1]));
}

/* Fills the constants and the displacements of the samples. */
static void fill_constants(const law_samples *c, const solution shared[LAW_SPREADS],
                           wt_shared_shift_law *common)
{
    size_t at[LOCAL];
    find_indices(c, false, 0, at);
    const wt_interval constant = unknown_interval(shared, at[MAIN]);
    common->reference = c->reference;
    common->kind = c->kind;
    common->c1 = common->c2 = common->activation_energy = unknown;
    common->c_correlation = (double)NAN;
    *(c->kind == WT_LAW_WLF ? &common->c1 : &common->activation_energy) = constant;
    if (c->kind == WT_LAW_WLF) {
        const wt_interval distance = interval_map(unknown_interval(shared, at[POLE]), exp);
        common->c2 = interval_offset(distance, c->reference - c->coldest);
        common->c_correlation = constant_correlation(shared, at[MAIN], at[POLE]);
    }
    common->spread = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        common->spread += shared[i].weight * law_spread(i);
    for (size_t k = 0; k < c->n_members; k++) {
        find_indices(c, false, k, at);
        wt_shared_law_member *member = &common->members[c->members[k].sample];
        member->used = true;
        member->reference_offset =
            at[MOVED] != NO_INDEX ? unknown_interval(shared, at[MOVED]) : (wt_interval){0};
    }
}

/* Returns the p value of the hypothesis of one law, averaged over the temperature errors of the
 * separate laws. */
static double one_law_p_value(const law_samples *c, const solution shared[LAW_SPREADS],
                              const solution separate[LAW_SPREADS])
{
    const double freedom = (double)(count_unknowns(c, true) - count_unknowns(c, false));
    double p = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (separate[i].weight > 0.0 && shared[i].good)
            p += separate[i].weight *
                 gsl_cdf_chisq_Q(fmax(shared[i].chi_square - separate[i].chi_square, 0.0), freedom);
    return p;
}

/* ---- interface ------------------------------------------------------------------------------- */

/* Returns the reason why a sample cannot be used, or NULL. Joined laws have constants that
 * others lack. */
static const char *why_not(const wt_master *m)
{
    return m == NULL || m->posterior == NULL     ? "it could not be fitted"
           : m->law.kind == WT_LAW_NONE          ? "it has no law of its own"
           : m->law.kind == WT_LAW_WLF_ARRHENIUS ? "its own law is Arrhenius joined to WLF"
           : isnan(m->slope.standard_error)      ? "its shifts are given"
                                                 : NULL;
}

/* Returns Arrhenius if no sample shows curvature, otherwise WLF. */
static wt_law_kind shared_law_kind(const wt_master *const *masters, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (why_not(masters[i]) == NULL && masters[i]->law.kind == WT_LAW_WLF)
            return WT_LAW_WLF;
    return WT_LAW_ARRHENIUS;
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
    if (status == WT_OK && c->sharing == WT_SHARED_LAW_SHIFTED && c->kind != WT_LAW_WLF) {
        wt_fail(err, WT_E_RANGE, "an Arrhenius law cannot be moved along the temperature");
        wt_error_advice(err, "ask for the same law of all samples");
        return WT_E_RANGE;
    }
    if (status != WT_OK)
        return status;
    c->coldest = c->reference = isnan(c->reference) ? c->members[0].reference : c->reference;
    for (size_t k = 0; k < (c->sharing == WT_SHARED_LAW_SAME ? c->n_members : 1); k++)
        c->coldest = fmin(c->coldest, c->members[k].temperature[0]);
    return WT_OK;
}

static wt_status compute_shared_law(law_samples *c, wt_shared_shift_law *common, wt_error *err)
{
    solution shared[LAW_SPREADS], separate[LAW_SPREADS];
    for (size_t i = 0; i < LAW_SPREADS; i++) {
        fit_with_spread(c, false, i, &shared[i]);
        fit_with_spread(c, true, i, &separate[i]);
    }
    common->points = wt_alloc(c->n, sizeof *common->points);
    if (!weigh_spreads(c, true, shared)) {
        wt_fail(err, WT_E_RANGE, "no one law describes the shifts of all samples");
        wt_error_advice(err, "%s",
                        c->sharing == WT_SHARED_LAW_SAME ? "let it be moved along the temperature"
                                                         : "let each have its own");
        return WT_E_RANGE;
    }
    fill_constants(c, shared, common);
    const bool compared = weigh_spreads(c, false, separate);
    common->p = compared ? one_law_p_value(c, shared, separate) : (double)NAN;
    for (size_t k = 0; k < c->n_members; k++)
        for (size_t i = 0; i < c->members[k].n; i++)
            fill_point(c, k, i, shared, separate, compared, &common->points[common->n++]);
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
