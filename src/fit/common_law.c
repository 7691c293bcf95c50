/* One law of the shift factors for several samples: generalised least squares over all their shifts
 * at once, with the error of the temperatures averaged over, beside a law of its own for each.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/mixture.h"
#include "fit/posterior.h"

#include "base/gsl_quiet.h"
#include "base/normal.h"
#include "fit/dense.h"
#include "fit/pool_gsl.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a shift of one sample hangs on: its offset, the main constant, ln of the distance of the
 * pole, and how far its law is moved. */
enum { OFFSET, MAIN, POLE, MOVED, LOCAL };
enum { MOST_STEPS = 100, FEWEST = 2 };
static const size_t none = SIZE_MAX;
/* A step that is so small in standard errors is the last. */
static const double settled = 1e-6;
/* A pole to begin with, below the coldest isotherm [K]. */
static const double usual_distance = 50.0;
static const double gas_constant = 8.31446261815324; /* J/(mol K) */

/* Shifts of one sample, without the isotherm that does not belong to its law. */
typedef struct law_member {
    size_t sample, n, first; /* first: row among all */
    double *temperature, *log_a, *slope;
    gsl_matrix *covariance;
    gsl_matrix *root[LAW_SPREADS];
    double reference, coldest; /* of its own law */
    double main_constant, distance;
} law_member;

typedef struct law_samples {
    pool memory;
    wt_common how;
    wt_law_kind kind;
    double reference, coldest; /* of the common law */
    law_member *members;       /* [n_members] */
    size_t n_members, n;       /* n: shifts of all */
} law_samples;

/* A law for all, or one for each. */
typedef struct law_model {
    bool own;
    size_t n_unknowns;
} law_model;

typedef struct solution {
    double *unknown;        /* [n_unknowns] */
    gsl_matrix *covariance; /* [n_unknowns^2] */
    double chi_square, reml, weight;
    bool good;
} solution;

/* ---- the shifts of a sample ------------------------------------------------------------------ */

/* Means over the cells of the posterior, and the covariance within them and between. */
static void take_shifts(const wt_posterior *p, long left_out, law_member *m)
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

static wt_status add_member(law_samples *c, const wt_master *master, size_t sample, wt_error *err)
{
    const wt_posterior *p = master->posterior;
    const law_shape *shape = &p->shape;
    law_member *m = &c->members[c->n_members++];
    double constants[LAW_MOST];
    *m = (law_member){.sample = sample,
                      .n = p->frame.n_curves - (shape->odd >= 0),
                      .first = c->n,
                      .reference = shape->reference,
                      .coldest = shape->coldest};
    m->temperature = pool_numbers(&c->memory, m->n);
    m->log_a = pool_numbers(&c->memory, m->n);
    m->slope = pool_numbers(&c->memory, m->n);
    m->covariance = pool_matrix(&c->memory, m->n, m->n);
    for (size_t i = 0; i < LAW_SPREADS; i++)
        m->root[i] = pool_matrix(&c->memory, m->n, m->n);
    if (c->memory.failed)
        return wt_fail(err, WT_E_MEMORY, "no memory for a common law");
    memset(m->log_a, 0, m->n * sizeof *m->log_a);
    take_shifts(p, shape->odd, m);
    posterior_mean_law(p, constants);
    m->main_constant = constants[1];
    if (shape->kind == WT_LAW_WLF) {
        m->distance = constants[law_pole_index(shape)];
    } else if (c->kind == WT_LAW_WLF) { /* of the same slope, with a pole as rubbers have it */
        m->distance = log(usual_distance);
        m->main_constant *= (m->reference - m->coldest + usual_distance) /
                            (gas_constant * M_LN10 * m->reference * m->reference);
    }
    c->n += m->n;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < LAW_SPREADS; i++) {
        const law_data data = {.n = m->n, .covariance = m->covariance, .slope = m->slope};
        status = law_gls_covariance(&data, law_spread(i), m->root[i], err);
    }
    return status;
}

/* ---- the model ------------------------------------------------------------------------------- */

static bool has_pole(const law_samples *c)
{
    return c->kind == WT_LAW_WLF;
}

static law_model model_of(const law_samples *c, bool own)
{
    const size_t laws = own ? c->n_members : 1, each = has_pole(c) ? 2 : 1;
    const size_t moved = !own && c->how == WT_COMMON_MOVED ? c->n_members - 1 : 0;
    return (law_model){own, c->n_members + laws * each + moved};
}

/* Where the unknowns of a sample are; `none` that it does not have. */
static void places(const law_samples *c, const law_model *m, size_t k, size_t place[LOCAL])
{
    const size_t first = c->n_members, each = has_pole(c) ? 2 : 1;
    const size_t law = first + (m->own ? k * each : 0);
    place[OFFSET] = k;
    place[MAIN] = law;
    place[POLE] = has_pole(c) ? law + 1 : none;
    place[MOVED] = !m->own && c->how == WT_COMMON_MOVED && k > 0 ? first + each + k - 1 : none;
}

/* The law of a sample at a temperature, without its offset, with derivatives by its unknowns; NaN
 * at the pole and below. */
static double law_value(const law_samples *c, const law_model *model, size_t k,
                        const double *unknown, double temperature, double by[LOCAL])
{
    const law_member *m = &c->members[k];
    const double reference = model->own ? m->reference : c->reference,
                 coldest = model->own ? m->coldest : c->coldest;
    size_t at[LOCAL];
    places(c, model, k, at);
    const double constant = unknown[at[MAIN]];
    by[OFFSET] = 1.0;
    by[POLE] = by[MOVED] = 0.0;
    if (!has_pole(c)) {
        by[MAIN] = (reference - temperature) / (reference * temperature) / (gas_constant * M_LN10);
        return constant * by[MAIN];
    }
    const double distance = exp(unknown[at[POLE]]);
    const double x = temperature - (at[MOVED] != none ? unknown[at[MOVED]] : 0.0);
    const double rise = x - reference, sum = distance + x - coldest;
    if (!(sum > 0.0))
        return (double)NAN;
    by[MAIN] = -rise / sum;
    by[POLE] = constant * rise / sum * (distance / sum);
    by[MOVED] = constant * (sum - rise) / (sum * sum);
    return constant * by[MAIN];
}

/* Sum of squares, in units of the errors; with `cross` what the unknowns take from it. */
static double squares(const law_samples *c, const law_model *model, size_t spread,
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
        places(c, model, k, at);
        for (size_t i = 0; i < m->n; i++) {
            double by[LOCAL];
            const double law = law_value(c, model, k, unknown, m->temperature[i], by);
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
            if (at[u] == none)
                continue;
            gsl_blas_dtrsv(CblasLower, CblasNoTrans, CblasNonUnit, m->root[spread], &x.vector);
            gsl_blas_ddot(&x.vector, &y.vector, &with);
            *gsl_vector_ptr(right, at[u]) += with;
            for (size_t w = 0; w <= u; w++) {
                gsl_vector_const_view other = gsl_matrix_const_subrow(columns, w, 0, m->n);
                if (at[w] == none)
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

static void start(const law_samples *c, const law_model *model, double *unknown)
{
    for (size_t k = c->n_members; k-- > 0;) { /* the first one's law is that of all */
        const law_member *m = &c->members[k];
        size_t at[LOCAL];
        places(c, model, k, at);
        unknown[at[OFFSET]] = 0.0;
        unknown[at[MAIN]] = m->main_constant;
        if (at[POLE] != none)
            unknown[at[POLE]] = m->distance;
        if (at[MOVED] != none) /* the poles on one another */
            unknown[at[MOVED]] = (m->coldest - exp(m->distance)) -
                                 (c->members[0].coldest - exp(c->members[0].distance));
        if (!model->own && k == 0 && has_pole(c)) {
            /* its law for the reference of all, whose pole must lie below all isotherms */
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
            const double law = law_value(c, model, k, unknown, m->temperature[i], by);
            sum += m->log_a[i] - (isfinite(law) ? law : 0.0);
        }
        unknown[k] = sum / (double)m->n;
    }
}

/* Whether the constants are those of a law that falls and bends as far as is told. */
static bool is_law(const law_samples *c, const law_model *model, const solution *s)
{
    bool good = true;
    for (size_t k = 0; k < c->n_members; k++) {
        size_t at[LOCAL];
        places(c, model, k, at);
        good = good && s->unknown[at[MAIN]] > 0.0;
        if (at[POLE] != none)
            good = good && s->unknown[at[POLE]] > log(POLE_NEAREST) &&
                   s->unknown[at[POLE]] < log(POLE_FARTHEST) &&
                   gsl_matrix_get(s->covariance, at[POLE], at[POLE]) < POLE_ERROR * POLE_ERROR;
    }
    return good;
}

/* Damped steps of least squares until none is left. */
static void fit(law_samples *c, const law_model *model, size_t spread, solution *s)
{
    const size_t n = model->n_unknowns;
    pool *memory = &c->memory;
    gsl_vector *off = pool_vector(memory, c->n), *right = pool_vector(memory, n),
               *step = pool_vector(memory, n);
    gsl_matrix *columns = pool_matrix(memory, LOCAL, c->n), *cross = pool_matrix(memory, n, n),
               *damped = pool_matrix(memory, n, n);
    double *next = pool_numbers(memory, n), damping = 1e-3;
    s->unknown = pool_numbers(memory, n);
    s->covariance = pool_matrix(memory, n, n);
    s->good = false;
    if (memory->failed)
        return;
    start(c, model, s->unknown);
    bool done = false;
    s->chi_square = squares(c, model, spread, s->unknown, off, columns, cross, right);
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
        const double now = squares(c, model, spread, next, off, columns, NULL, NULL);
        done = size < settled;
        if (!(now <= s->chi_square)) {
            damping *= 10.0;
            continue;
        }
        damping *= 0.1;
        memcpy(s->unknown, next, n * sizeof *next);
        s->chi_square = squares(c, model, spread, s->unknown, off, columns, cross, right);
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
    s->good = is_law(c, model, s);
}

/* The weights of the spreads of temperatures; false if none is left. What tells samples apart must
 * not hang on what is believed of ovens: then all spreads are alike. */
static bool weigh(const law_samples *c, bool believed, solution s[LAW_SPREADS])
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

/* ---- what it says ---------------------------------------------------------------------------- */

static double variance_of(const solution *s, const size_t at[LOCAL], const double by[LOCAL])
{
    double sum = 0.0;
    for (size_t u = 0; u < LOCAL; u++)
        for (size_t w = 0; w < LOCAL; w++)
            if (at[u] != none && at[w] != none)
                sum += by[u] * by[w] * gsl_matrix_get(s->covariance, at[u], at[w]);
    return fmax(sum, 0.0);
}

/* One unknown of all, over the spreads. */
static wt_interval of_unknown(const solution s[LAW_SPREADS], size_t u)
{
    mixture_part part[LAW_SPREADS];
    size_t n = 0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (s[i].weight > 0.0)
            part[n++] = (mixture_part){s[i].weight, s[i].unknown[u],
                                       sqrt(gsl_matrix_get(s[i].covariance, u, u))};
    return mixture_interval(part, n);
}

/* A law of a sample between two temperatures at one spread, and its variance. */
static double contrast(const law_samples *c, const law_model *model, size_t k, const solution *s,
                       double temperature, double from, double *variance)
{
    double by[LOCAL], less[LOCAL];
    size_t at[LOCAL];
    places(c, model, k, at);
    const double value = law_value(c, model, k, s->unknown, temperature, by) -
                         law_value(c, model, k, s->unknown, from, less);
    for (size_t u = 0; u < LOCAL; u++)
        by[u] -= less[u];
    *variance = variance_of(s, at, by);
    return value;
}

static double middle(const law_member *m)
{
    double sum = 0.0;
    for (size_t i = 0; i < m->n; i++)
        sum += m->temperature[i];
    return sum / (double)m->n;
}

/* What a sample's own law has more than the common one, from the middle of its isotherms on, with
 * the error of its own law: what the common one takes away from it (Hausman 1978) is not known well
 * enough of so few isotherms (tests/unit/test_fit_common_law.c). */
static wt_interval difference(const law_samples *c, size_t k, const solution one[LAW_SPREADS],
                              const solution own[LAW_SPREADS], double temperature)
{
    const law_model of_all = model_of(c, false), of_each = model_of(c, true);
    mixture_part part[LAW_SPREADS];
    size_t n = 0;
    for (size_t i = 0; i < LAW_SPREADS; i++) {
        double v_own, ignored;
        if (!(own[i].weight > 0.0) || !one[i].good)
            continue;
        const double from = middle(&c->members[k]);
        const double d = contrast(c, &of_each, k, &own[i], temperature, from, &v_own) -
                         contrast(c, &of_all, k, &one[i], temperature, from, &ignored);
        part[n++] = (mixture_part){own[i].weight, d, sqrt(v_own)};
    }
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += part[i].weight;
    for (size_t i = 0; i < n; i++)
        part[i].weight /= sum;
    return n > 0 ? mixture_interval(part, n)
                 : (wt_interval){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
}

static void fill_point(const law_samples *c, size_t k, size_t i, const solution one[LAW_SPREADS],
                       const solution own[LAW_SPREADS], bool compared, wt_common_point *point)
{
    const law_member *m = &c->members[k];
    const law_model of_all = model_of(c, false);
    mixture_part law[LAW_SPREADS];
    size_t n = 0, at[LOCAL];
    double offset = 0.0;
    places(c, &of_all, k, at);
    for (size_t w = 0; w < LAW_SPREADS; w++) {
        double by[LOCAL];
        if (!(one[w].weight > 0.0))
            continue;
        const double value = law_value(c, &of_all, k, one[w].unknown, m->temperature[i], by);
        by[OFFSET] = 0.0;
        law[n++] = (mixture_part){one[w].weight, value, sqrt(variance_of(&one[w], at, by))};
        offset += one[w].weight * one[w].unknown[at[OFFSET]];
    }
    *point = (wt_common_point){.sample = m->sample,
                               .temperature = m->temperature[i],
                               .log_a = m->log_a[i] - offset,
                               .log_a_error = sqrt(gsl_matrix_get(m->covariance, i, i)),
                               .law = mixture_interval(law, n)};
    const double unknown = (double)NAN;
    point->difference = compared ? difference(c, k, one, own, m->temperature[i])
                                 : (wt_interval){unknown, unknown, unknown, unknown};
}

/* Of C1 and ln of the distance, over the spreads. */
static double correlation(const solution s[LAW_SPREADS], size_t a, size_t b)
{
    double mean[2] = {0.0, 0.0}, sum[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (s[i].weight > 0.0) {
            mean[0] += s[i].weight * s[i].unknown[a];
            mean[1] += s[i].weight * s[i].unknown[b];
        }
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (s[i].weight > 0.0) {
            const double x = s[i].unknown[a] - mean[0], y = s[i].unknown[b] - mean[1];
            sum[0] += s[i].weight * (gsl_matrix_get(s[i].covariance, a, a) + x * x);
            sum[1] += s[i].weight * (gsl_matrix_get(s[i].covariance, a, b) + x * y);
            sum[2] += s[i].weight * (gsl_matrix_get(s[i].covariance, b, b) + y * y);
        }
    return sum[1] / sqrt(sum[0] * sum[2]);
}

/* ln of a distance to the constant C2. */
static wt_interval to_c2(wt_interval x, double lead)
{
    wt_interval y = {lead + exp(x.value), 0.0, lead + exp(x.low), lead + exp(x.high)};
    y.standard_error = 0.5 * (y.high - y.low) / NORMAL_95;
    return y;
}

static void fill_law(const law_samples *c, const solution one[LAW_SPREADS], wt_common_law *common)
{
    const law_model m = model_of(c, false);
    const wt_interval unknown = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    size_t at[LOCAL];
    places(c, &m, 0, at);
    const wt_interval constant = of_unknown(one, at[MAIN]);
    common->reference = c->reference;
    common->kind = c->kind;
    common->c1 = has_pole(c) ? constant : unknown;
    common->activation_energy = has_pole(c) ? unknown : constant;
    common->c2 =
        has_pole(c) ? to_c2(of_unknown(one, at[POLE]), c->reference - c->coldest) : unknown;
    common->c_correlation = has_pole(c) ? correlation(one, at[MAIN], at[POLE]) : (double)NAN;
    common->spread = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        common->spread += one[i].weight * law_spread(i);
    for (size_t k = 0; k < c->n_members; k++) {
        places(c, &m, k, at);
        wt_common_member *member = &common->members[c->members[k].sample];
        member->used = true;
        member->moved = at[MOVED] != none ? of_unknown(one, at[MOVED]) : (wt_interval){0};
    }
}

/* Chance that samples of one law differ so much: by the spreads that their own laws leave. */
static double chance(const law_samples *c, const solution one[LAW_SPREADS],
                     const solution own[LAW_SPREADS])
{
    const double freedom = (double)(model_of(c, true).n_unknowns - model_of(c, false).n_unknowns);
    double p = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (own[i].weight > 0.0 && one[i].good)
            p += own[i].weight *
                 gsl_cdf_chisq_Q(fmax(one[i].chi_square - own[i].chi_square, 0.0), freedom);
    return p;
}

/* ---- the whole ------------------------------------------------------------------------------- */

/* Joined laws have constants that others do not share. */
static const char *why_not(const wt_master *m)
{
    if (m == NULL || m->posterior == NULL)
        return "it could not be fitted";
    if (m->law.kind == WT_LAW_NONE)
        return "it has no law of its own";
    if (m->law.kind == WT_LAW_JOINED)
        return "its own law is Arrhenius joined to WLF";
    return isnan(m->slope.standard_error) ? "its shifts are given" : NULL;
}

/* Arrhenius if no sample shows that it bends: those that do not would be missed elsewhere. */
static wt_law_kind kind_of_all(const wt_master *const *masters, size_t n)
{
    bool bends = false;
    for (size_t i = 0; i < n; i++)
        bends = bends || (why_not(masters[i]) == NULL && masters[i]->law.kind == WT_LAW_WLF);
    return bends ? WT_LAW_WLF : WT_LAW_ARRHENIUS;
}

static wt_status gather(law_samples *c, const wt_master *const *masters, size_t n,
                        wt_common_law *common, wt_error *err)
{
    wt_status status = WT_OK;
    c->members = pool_alloc(&c->memory, n, sizeof *c->members);
    if (c->members == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a common law");
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        const char *const why = why_not(masters[i]);
        if (why == NULL)
            status = add_member(c, masters[i], i, err);
        else
            snprintf(common->members[i].why_not, sizeof common->members[i].why_not, "%s", why);
    }
    if (status == WT_OK && c->n_members < FEWEST) {
        size_t without = 0;
        while (common->members[without].why_not[0] == '\0')
            without++;
        wt_fail(err, WT_E_RANGE, "a common law needs two samples or more with a law");
        wt_error_found(err, "%zu of %zu; of sample %zu %s", c->n_members, n, without + 1,
                       common->members[without].why_not);
        return WT_E_RANGE;
    }
    if (status == WT_OK && c->how == WT_COMMON_MOVED && !has_pole(c)) {
        wt_fail(err, WT_E_RANGE, "an Arrhenius law cannot be moved along the temperature");
        wt_error_advice(err, "ask for the same law of all samples");
        return WT_E_RANGE;
    }
    if (status != WT_OK)
        return status;
    const law_member *first = &c->members[0];
    c->reference = isnan(c->reference) ? first->reference : c->reference;
    c->coldest = fmin(c->reference, first->temperature[0]);
    for (size_t k = 1; c->how == WT_COMMON_SAME && k < c->n_members; k++)
        c->coldest = fmin(c->coldest, c->members[k].temperature[0]);
    return WT_OK;
}

static wt_status make(law_samples *c, wt_common_law *common, wt_error *err)
{
    const law_model of_all = model_of(c, false), of_each = model_of(c, true);
    solution one[LAW_SPREADS], own[LAW_SPREADS];
    for (size_t i = 0; i < LAW_SPREADS; i++) {
        fit(c, &of_all, i, &one[i]);
        fit(c, &of_each, i, &own[i]);
    }
    common->points = calloc(c->n, sizeof *common->points);
    if (c->memory.failed || common->points == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a common law");
    if (!weigh(c, true, one)) {
        wt_fail(err, WT_E_RANGE, "no one law describes the shifts of all samples");
        wt_error_advice(err, "%s",
                        c->how == WT_COMMON_SAME ? "let it be moved along the temperature"
                                                 : "let each have its own");
        return WT_E_RANGE;
    }
    const bool compared = weigh(c, false, own);
    fill_law(c, one, common);
    common->p = compared ? chance(c, one, own) : (double)NAN;
    for (size_t k = 0; k < c->n_members; k++)
        for (size_t i = 0; i < c->members[k].n; i++)
            fill_point(c, k, i, one, own, compared, &common->points[common->n++]);
    return WT_OK;
}

wt_status wt_common_law_fit(const wt_master *const *masters, size_t n, wt_common how,
                            double reference, wt_common_law *common_law, wt_error *err)
{
    if (masters == NULL || common_law == NULL || n < FEWEST || how == WT_COMMON_NONE)
        return wt_fail(err, WT_E_ARG, "a common law needs two samples or more");
    law_samples c = {.how = how, .reference = reference, .kind = kind_of_all(masters, n)};
    wt_common_law made = {.n_members = n, .members = calloc(n, sizeof *made.members)};
    gsl_quiet();
    wt_status status = made.members == NULL
                           ? wt_fail(err, WT_E_MEMORY, "no memory for a common law")
                           : gather(&c, masters, n, &made, err);
    if (status == WT_OK)
        status = make(&c, &made, err);
    pool_free(&c.memory);
    if (status == WT_OK)
        *common_law = made;
    else
        wt_common_law_clear(&made);
    return status;
}

void wt_common_law_clear(wt_common_law *common)
{
    if (common == NULL)
        return;
    free(common->members);
    free(common->points);
    *common = (wt_common_law){0};
}
