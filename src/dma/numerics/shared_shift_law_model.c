/* Model and results of one shift law for several samples: constants, isotherms, differences.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/shared_shift_law_fit.h"

#include "core/base/quantity.h"
#include "core/math/normal_quantile.h"
#include "dma/numerics/mixture.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

/* ---- the model ------------------------------------------------------------------------------- */

bool common_has_pole(const law_samples *c)
{
    return c->kind == WT_LAW_WLF;
}

law_model common_model(const law_samples *c, bool own)
{
    const size_t laws = own ? c->n_members : 1, each = common_has_pole(c) ? 2 : 1;
    const size_t moved = !own && c->how == WT_COMMON_MOVED ? c->n_members - 1 : 0;
    return (law_model){own, c->n_members + laws * each + moved};
}

void common_places(const law_samples *c, const law_model *m, size_t k, size_t place[LOCAL])
{
    const size_t first = c->n_members, each = common_has_pole(c) ? 2 : 1;
    const size_t law = first + (m->own ? k * each : 0);
    place[OFFSET] = k;
    place[MAIN] = law;
    place[POLE] = common_has_pole(c) ? law + 1 : NO_PLACE;
    place[MOVED] = !m->own && c->how == WT_COMMON_MOVED && k > 0 ? first + each + k - 1 : NO_PLACE;
}

double common_value(const law_samples *c, const law_model *model, size_t k, const double *unknown,
                    double temperature, double by[LOCAL])
{
    const law_member *m = &c->members[k];
    const double reference = model->own ? m->reference : c->reference,
                 coldest = model->own ? m->coldest : c->coldest;
    size_t at[LOCAL];
    common_places(c, model, k, at);
    const double constant = unknown[at[MAIN]];
    by[OFFSET] = 1.0;
    by[POLE] = by[MOVED] = 0.0;
    if (!common_has_pole(c)) {
        by[MAIN] = (reference - temperature) / (reference * temperature) / (GAS_CONSTANT * M_LN10);
        return constant * by[MAIN];
    }
    const double distance = exp(unknown[at[POLE]]);
    const double x = temperature - (at[MOVED] != NO_PLACE ? unknown[at[MOVED]] : 0.0);
    const double rise = x - reference, sum = distance + x - coldest;
    if (!(sum > 0.0))
        return (double)NAN;
    by[MAIN] = -rise / sum;
    by[POLE] = constant * rise / sum * (distance / sum);
    by[MOVED] = constant * (sum - rise) / (sum * sum);
    return constant * by[MAIN];
}

/* ---- results --------------------------------------------------------------------------------- */

static double variance_of(const solution *s, const size_t at[LOCAL], const double by[LOCAL])
{
    double sum = 0.0;
    for (size_t u = 0; u < LOCAL; u++)
        for (size_t w = 0; w < LOCAL; w++)
            if (at[u] != NO_PLACE && at[w] != NO_PLACE)
                sum += by[u] * by[w] * gsl_matrix_get(s->covariance, at[u], at[w]);
    return fmax(sum, 0.0);
}

/* Returns the interval of an unknown over the temperature errors. */
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

/* Returns the difference of a law between two temperatures for one temperature error, and its
 * variance. */
static double law_difference(const law_samples *c, const law_model *model, size_t k,
                             const solution *s, double temperature, double from, double *variance)
{
    double by[LOCAL], less[LOCAL];
    size_t at[LOCAL];
    common_places(c, model, k, at);
    const double value = common_value(c, model, k, s->unknown, temperature, by) -
                         common_value(c, model, k, s->unknown, from, less);
    for (size_t u = 0; u < LOCAL; u++)
        by[u] -= less[u];
    *variance = variance_of(s, at, by);
    return value;
}

static double middle_temperature(const law_member *m)
{
    double sum = 0.0;
    for (size_t i = 0; i < m->n; i++)
        sum += m->temperature[i];
    return sum / (double)m->n;
}

/* What a sample's own law has more than the common one, from the middle of its isotherms on, with
 * the error of its own law: what the common one takes away from it (Hausman 1978) is not known well
 * enough of so few isotherms (tests/unit/test_dma_shared_shift_law_fit.c). */
static wt_interval own_less_common(const law_samples *c, size_t k, const solution one[LAW_SPREADS],
                                   const solution own[LAW_SPREADS], double temperature)
{
    const law_model of_all = common_model(c, false), of_each = common_model(c, true);
    mixture_part part[LAW_SPREADS];
    size_t n = 0;
    for (size_t i = 0; i < LAW_SPREADS; i++) {
        double v_own, ignored;
        if (!(own[i].weight > 0.0) || !one[i].good)
            continue;
        const double from = middle_temperature(&c->members[k]);
        const double d = law_difference(c, &of_each, k, &own[i], temperature, from, &v_own) -
                         law_difference(c, &of_all, k, &one[i], temperature, from, &ignored);
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

void common_fill_point(const law_samples *c, size_t k, size_t i, const solution one[LAW_SPREADS],
                       const solution own[LAW_SPREADS], bool compared, wt_shared_law_point *point)
{
    const law_member *m = &c->members[k];
    const law_model of_all = common_model(c, false);
    mixture_part law[LAW_SPREADS];
    size_t n = 0, at[LOCAL];
    double offset = 0.0;
    common_places(c, &of_all, k, at);
    for (size_t w = 0; w < LAW_SPREADS; w++) {
        double by[LOCAL];
        if (!(one[w].weight > 0.0))
            continue;
        const double value = common_value(c, &of_all, k, one[w].unknown, m->temperature[i], by);
        by[OFFSET] = 0.0;
        law[n++] = (mixture_part){one[w].weight, value, sqrt(variance_of(&one[w], at, by))};
        offset += one[w].weight * one[w].unknown[at[OFFSET]];
    }
    *point = (wt_shared_law_point){.sample = m->sample,
                                   .temperature = m->temperature[i],
                                   .log_a = m->log_a[i] - offset,
                                   .log_a_error = sqrt(gsl_matrix_get(m->covariance, i, i)),
                                   .law = mixture_interval(law, n)};
    const double unknown = (double)NAN;
    point->difference = compared ? own_less_common(c, k, one, own, m->temperature[i])
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

/* Converts ln of the pole distance to the constant C2. */
static wt_interval to_c2(wt_interval x, double lead)
{
    wt_interval y = {lead + exp(x.value), 0.0, lead + exp(x.low), lead + exp(x.high)};
    y.standard_error = 0.5 * (y.high - y.low) / NORMAL_95;
    return y;
}

void common_fill_law(const law_samples *c, const solution one[LAW_SPREADS],
                     wt_shared_shift_law *common)
{
    const law_model m = common_model(c, false);
    const wt_interval unknown = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    size_t at[LOCAL];
    common_places(c, &m, 0, at);
    const wt_interval constant = of_unknown(one, at[MAIN]);
    common->reference = c->reference;
    common->kind = c->kind;
    common->c1 = common_has_pole(c) ? constant : unknown;
    common->activation_energy = common_has_pole(c) ? unknown : constant;
    common->c2 =
        common_has_pole(c) ? to_c2(of_unknown(one, at[POLE]), c->reference - c->coldest) : unknown;
    common->c_correlation =
        common_has_pole(c) ? constant_correlation(one, at[MAIN], at[POLE]) : (double)NAN;
    common->spread = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        common->spread += one[i].weight * law_spread(i);
    for (size_t k = 0; k < c->n_members; k++) {
        common_places(c, &m, k, at);
        wt_shared_law_member *member = &common->members[c->members[k].sample];
        member->used = true;
        member->moved = at[MOVED] != NO_PLACE ? of_unknown(one, at[MOVED]) : (wt_interval){0};
    }
}

double common_chance(const law_samples *c, const solution one[LAW_SPREADS],
                     const solution own[LAW_SPREADS])
{
    const double freedom =
        (double)(common_model(c, true).n_unknowns - common_model(c, false).n_unknowns);
    double p = 0.0;
    for (size_t i = 0; i < LAW_SPREADS; i++)
        if (own[i].weight > 0.0 && one[i].good)
            p += own[i].weight *
                 gsl_cdf_chisq_Q(fmax(one[i].chi_square - own[i].chi_square, 0.0), freedom);
    return p;
}
