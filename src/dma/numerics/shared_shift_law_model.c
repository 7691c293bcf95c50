/* Model and results of one shift law for several samples: constants, isotherms, differences.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/shared_shift_law_fit.h"

#include "core/base/quantity.h"
#include "dma/numerics/posterior.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* ---- the model ------------------------------------------------------------------------------- */

bool shared_law_has_pole(const law_samples *c)
{
    return c->kind == WT_LAW_WLF;
}

law_model shared_law_model(const law_samples *c, bool separate)
{
    const size_t laws = separate ? c->n_members : 1, each = shared_law_has_pole(c) ? 2 : 1;
    const size_t moved = !separate && c->sharing == WT_SHARED_LAW_SHIFTED ? c->n_members - 1 : 0;
    return (law_model){separate, c->n_members + laws * each + moved};
}

void shared_law_indices(const law_samples *c, const law_model *m, size_t k, size_t place[LOCAL])
{
    const size_t first = c->n_members, each = shared_law_has_pole(c) ? 2 : 1;
    const size_t law = first + (m->separate ? k * each : 0);
    place[OFFSET] = k;
    place[MAIN] = law;
    place[POLE] = shared_law_has_pole(c) ? law + 1 : NO_INDEX;
    place[MOVED] = !m->separate && c->sharing == WT_SHARED_LAW_SHIFTED && k > 0
                       ? first + each + k - 1
                       : NO_INDEX;
}

double shared_law_value(const law_samples *c, const law_model *model, size_t k,
                        const double *unknown, double temperature, double by[LOCAL])
{
    const law_member *m = &c->members[k];
    const double reference = model->separate ? m->reference : c->reference,
                 coldest = model->separate ? m->coldest : c->coldest;
    size_t at[LOCAL];
    shared_law_indices(c, model, k, at);
    const double constant = unknown[at[MAIN]];
    by[OFFSET] = 1.0;
    by[POLE] = by[MOVED] = 0.0;
    if (!shared_law_has_pole(c)) {
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

/* ---- results --------------------------------------------------------------------------------- */

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
static double law_difference(const law_samples *c, const law_model *model, size_t k,
                             const solution *s, double temperature, double from, double *variance)
{
    double by[LOCAL], less[LOCAL];
    size_t at[LOCAL];
    shared_law_indices(c, model, k, at);
    const double value = shared_law_value(c, model, k, s->unknown, temperature, by) -
                         shared_law_value(c, model, k, s->unknown, from, less);
    for (size_t u = 0; u < LOCAL; u++)
        by[u] -= less[u];
    *variance = linear_variance(s, at, by);
    return value;
}

static double mean_temperature(const law_member *m)
{
    double sum = 0.0;
    for (size_t i = 0; i < m->n; i++)
        sum += m->temperature[i];
    return sum / (double)m->n;
}

/* What a sample's own law has more than the common one, from the middle of its isotherms on, with
 * the error of its own law: what the common one takes away from it (Hausman 1978) is not known well
 * enough of so few isotherms (tests/unit/test_dma_shared_shift_law_fit.c). */
static wt_interval law_deviation(const law_samples *c, size_t k, const solution shared[LAW_SPREADS],
                                 const solution separate[LAW_SPREADS], double temperature)
{
    const law_model of_all = shared_law_model(c, false), of_each = shared_law_model(c, true);
    mixture_component part[LAW_SPREADS];
    size_t n = 0;
    for (size_t i = 0; i < LAW_SPREADS; i++) {
        double v_own, ignored;
        if (!(separate[i].weight > 0.0) || !shared[i].good)
            continue;
        const double from = mean_temperature(&c->members[k]);
        const double d = law_difference(c, &of_each, k, &separate[i], temperature, from, &v_own) -
                         law_difference(c, &of_all, k, &shared[i], temperature, from, &ignored);
        part[n++] = (mixture_component){separate[i].weight, d, sqrt(v_own)};
    }
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += part[i].weight;
    for (size_t i = 0; i < n; i++)
        part[i].weight /= sum;
    return n > 0 ? mixture_interval(part, n)
                 : (wt_interval){(double)NAN, (double)NAN, (double)NAN, (double)NAN};
}

void shared_law_fill_point(const law_samples *c, size_t k, size_t i,
                           const solution shared[LAW_SPREADS], const solution separate[LAW_SPREADS],
                           bool compared, wt_shared_law_point *point)
{
    const law_member *m = &c->members[k];
    const law_model of_all = shared_law_model(c, false);
    mixture_component law[LAW_SPREADS];
    size_t n = 0, at[LOCAL];
    double offset = 0.0;
    shared_law_indices(c, &of_all, k, at);
    for (size_t w = 0; w < LAW_SPREADS; w++) {
        double by[LOCAL];
        if (!(shared[w].weight > 0.0))
            continue;
        const double value =
            shared_law_value(c, &of_all, k, shared[w].unknown, m->temperature[i], by);
        by[OFFSET] = 0.0;
        law[n++] =
            (mixture_component){shared[w].weight, value, sqrt(linear_variance(&shared[w], at, by))};
        offset += shared[w].weight * shared[w].unknown[at[OFFSET]];
    }
    *point = (wt_shared_law_point){.sample = m->sample,
                                   .temperature = m->temperature[i],
                                   .log_a = m->log_a[i] - offset,
                                   .log_a_error = sqrt(gsl_matrix_get(m->covariance, i, i)),
                                   .law = mixture_interval(law, n)};
    const double unknown = (double)NAN;
    point->difference = compared ? law_deviation(c, k, shared, separate, m->temperature[i])
                                 : (wt_interval){unknown, unknown, unknown, unknown};
}

/* Returns the correlation of two unknowns (C1 and ln pole distance) over the temperature errors. */
static double constant_correlation(const solution s[LAW_SPREADS], size_t a, size_t b)
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

void shared_law_fill(const law_samples *c, const solution shared[LAW_SPREADS],
                     wt_shared_shift_law *common)
{
    const law_model m = shared_law_model(c, false);
    const wt_interval unknown = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    size_t at[LOCAL];
    shared_law_indices(c, &m, 0, at);
    const wt_interval constant = unknown_interval(shared, at[MAIN]);
    common->reference = c->reference;
    common->kind = c->kind;
    common->c1 = shared_law_has_pole(c) ? constant : unknown;
    common->activation_energy = shared_law_has_pole(c) ? unknown : constant;
    common->c2 = shared_law_has_pole(c)
                     ? interval_offset(interval_map(unknown_interval(shared, at[POLE]), exp),
                                       c->reference - c->coldest)
                     : unknown;
    common->c_correlation =
        shared_law_has_pole(c) ? constant_correlation(shared, at[MAIN], at[POLE]) : (double)NAN;
    common->spread = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        common->spread += shared[i].weight * law_spread(i);
    for (size_t k = 0; k < c->n_members; k++) {
        shared_law_indices(c, &m, k, at);
        wt_shared_law_member *member = &common->members[c->members[k].sample];
        member->used = true;
        member->reference_offset =
            at[MOVED] != NO_INDEX ? unknown_interval(shared, at[MOVED]) : (wt_interval){0};
    }
}

double shared_law_p_value(const law_samples *c, const solution shared[LAW_SPREADS],
                          const solution separate[LAW_SPREADS])
{
    const double freedom =
        (double)(shared_law_model(c, true).n_unknowns - shared_law_model(c, false).n_unknowns);
    double p = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (separate[i].weight > 0.0 && shared[i].good)
            p += separate[i].weight *
                 gsl_cdf_chisq_Q(fmax(shared[i].chi_square - separate[i].chi_square, 0.0), freedom);
    return p;
}
