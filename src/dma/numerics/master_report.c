/* Converts the fit to its public result: shifts with notes, curve, law, series and verdict. Also
 * contains the functions that query the result later.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/math/students_t.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* If the interval of the equilibrium modulus extends below this share of the lowest storage
 * modulus, only an upper limit is reported. Most of that modulus then relaxes later, and the
 * extrapolation of the spectrum decides it. */
static const double equilibrium_limit_share = 0.5;

void wt_master_clear(wt_master *master)
{
    if (master == NULL)
        return;
    free(master->shifts);
    free(master->log_frequency);
    free(master->isotherm);
    free(master->is_outlier);
    free(master->fitted_storage);
    wt_prony_clear(&master->prony);
    posterior_free(master->posterior);
    *master = (wt_master){0};
}

static const wt_interval unknown_interval = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};

static wt_interval scale_interval(wt_interval x, double factor)
{
    return (wt_interval){x.value * factor, x.standard_error * factor, x.low * factor,
                         x.high * factor};
}

static wt_interval interpolate_interval(wt_interval a, wt_interval b, double share)
{
    return (wt_interval){a.value + share * (b.value - a.value),
                         a.standard_error + share * (b.standard_error - a.standard_error),
                         a.low + share * (b.low - a.low), a.high + share * (b.high - a.high)};
}

/* Returns true if the data determine the level of the moduli. */
static bool has_modulus_level(wt_shift_quantity by)
{
    return by == WT_SHIFT_MODULI || by == WT_SHIFT_STORAGE;
}

/* ---- law ------------------------------------------------------------------------------------- */

/* Returns the correlation of C1 and C2 over the mixture, with C2 through its derivative. */
static double wlf_constant_correlation(const wt_posterior *p)
{
    const size_t pole = law_pole_index(&p->shape);
    double mean[LAW_MAX_UNKNOWNS], sum[3] = {0.0, 0.0, 0.0};
    posterior_mean_law(p, mean);
    for (size_t i = 0; i < p->n_components; i++) {
        const law_fit *f = &p->components[i].law;
        const double d1 = f->unknown[1] - mean[1], d2 = f->unknown[pole] - mean[pole];
        sum[0] += p->components[i].weight * (f->covariance[1][1] + d1 * d1);
        sum[1] += p->components[i].weight * (f->covariance[1][pole] + d1 * d2);
        sum[2] += p->components[i].weight * (f->covariance[pole][pole] + d2 * d2);
    }
    return sum[1] / sqrt(sum[0] * sum[2]);
}

/* Returns the law at a temperature. With few isotherms the law is reported only between them. */
static wt_interval reported_law(const wt_posterior *p, double temperature)
{
    const size_t n = p->frame.n_curves;
    const bool inside = temperature >= p->temperature[0] && temperature <= p->temperature[n - 1];
    return n >= LAW_MIN_ISOTHERMS || inside ? posterior_law(p, temperature) : unknown_interval;
}

static void fill_shift_law(const wt_posterior *p, wt_master *m)
{
    double mean[LAW_MAX_UNKNOWNS];
    m->offset = (wt_interval){0};
    m->c1 = m->c2 = m->activation_energy = m->slope = m->pole = unknown_interval;
    m->law = (wt_shift_law){.kind = WT_LAW_NONE,
                            .wlf = {m->reference_temperature, (double)NAN, (double)NAN}};
    m->law_rms = m->temperature_spread = m->c_correlation = (double)NAN;
    if (p->shape.kind == WT_LAW_NONE) {
        snprintf(m->no_law_reason, sizeof m->no_law_reason, "%s", p->no_law_reason);
        return;
    }
    posterior_mean_law(p, mean);
    m->law = law_constants(&p->shape, mean);
    m->offset = posterior_constant(p, 0);
    if (p->shape.kind != WT_LAW_ARRHENIUS) {
        m->c1 = posterior_constant(p, 1);
        const wt_interval beyond =
            interval_map(posterior_constant(p, law_pole_index(&p->shape)), exp);
        const double reference = p->shape.reference;
        const wt_interval c2 = m->c2 = interval_offset(beyond, reference - p->shape.coldest);
        m->pole = (wt_interval){reference - c2.value, c2.standard_error, reference - c2.high,
                                reference - c2.low};
        m->c_correlation = wlf_constant_correlation(p);
    }
    for (size_t i = 0; i < m->n_shifts; i++)
        if (!isnan(wt_shift_law_log_a(&m->law, m->shifts[i].temperature)))
            m->shifts[i].law = reported_law(p, m->shifts[i].temperature);
    if (p->shape.kind != WT_LAW_WLF)
        m->activation_energy = posterior_constant(p, p->shape.kind == WT_LAW_WLF_ARRHENIUS ? 2 : 1);
    m->slope = posterior_slope(p, m->reference_temperature);
    m->temperature_spread = 0.0;
    for (size_t i = 0; i < p->n_components; i++)
        m->temperature_spread += p->components[i].weight * p->components[i].spread;
}

/* Removes the errors of the law if all shifts are stated. */
static void clear_law_errors(const spectrum *s, wt_master *m)
{
    wt_interval *const of_law[] = {&m->c1, &m->c2, &m->pole, &m->activation_energy, &m->slope};
    const double unknown = (double)NAN;
    bool given = s->n_curves > 1;
    for (size_t i = 0; i < s->n_curves; i++)
        given = given && s->given[i];
    given = given && m->shift_route != WT_SHIFTS_FROM_OVERLAP; /* overlap shifts have errors */
    for (size_t i = 0; given && i < sizeof of_law / sizeof *of_law; i++)
        *of_law[i] = (wt_interval){of_law[i]->value, unknown, unknown, unknown};
    if (given)
        m->c_correlation = unknown;
    for (size_t i = 0; given && i < m->n_shifts; i++)
        m->shifts[i].law = (wt_interval){m->shifts[i].law.value, unknown, unknown, unknown};
}

static void set_law_rms(wt_master *m)
{
    double sum = 0.0;
    size_t n = 0;
    for (size_t i = 0; i < m->n_shifts; i++) {
        const double off = m->shifts[i].log_a.value - m->offset.value -
                           wt_shift_law_log_a(&m->law, m->shifts[i].temperature);
        if (!m->shifts[i].determined || !isfinite(off))
            continue;
        sum += off * off;
        n++;
    }
    m->law_rms = n > 0 ? sqrt(sum / (double)n) : (double)NAN;
}

/* ---- curve ----------------------------------------------------------------------------------- */

struct order {
    double x;
    size_t point, isotherm;
};

static int compare_reduced_frequency(const void *left, const void *right)
{
    const struct order *a = left, *b = right;
    const int by_x = (a->x > b->x) - (a->x < b->x);
    return by_x != 0 ? by_x : (a->point > b->point) - (a->point < b->point);
}

/* Evaluates the spectrum at the points (step_response: the measured step response). It is computed
 * on a grid of 0.1 decade and interpolated linearly. */
static void fill_fitted_moduli(const wt_posterior *p, bool step_response, wt_master *m)
{
    const double step = 0.1;
    wt_interval low[WITH_LOSS_FACTOR], high[WITH_LOSS_FACTOR];
    double at = -HUGE_VAL;
    for (size_t j = 0; j < m->n; j++) {
        const double x = m->log_frequency[j], from = step * floor(x / step);
        if (from > at) {
            if (from == at + step)
                memcpy(low, high, sizeof low);
            else
                posterior_moduli(p, from * M_LN10, step_response, low);
            posterior_moduli(p, (from + step) * M_LN10, step_response, high);
            at = from;
        }
        const double share = (x - from) / step;
        const bool has_value[] = {has_modulus_level(p->by),
                                  p->by != WT_SHIFT_LOSS_FACTOR && !step_response,
                                  p->by != WT_SHIFT_LOSS && !step_response};
        wt_interval *const fitted[] = {step_response ? m->fitted_step : m->fitted_storage,
                                       m->fitted_loss, m->fitted_loss_factor};
        for (int q = 0; q < WITH_LOSS_FACTOR; q++)
            if (has_value[q])
                fitted[q][j] =
                    scale_interval(interpolate_interval(low[q], high[q], share), 1.0 / M_LN10);
    }
}

/* Returns the measured tan delta at a point of the spectrum. */
static double measured_loss_factor(const spectrum *s, size_t k)
{
    if (s->ratio)
        return exp(s->y[LOSS][k]);
    return s->used[STORAGE] && s->used[LOSS] ? exp(s->y[LOSS][k] - s->y[STORAGE][k]) : (double)NAN;
}

/* Fills the points of the determined isotherms, sorted by reduced frequency. */
static void fill_master_curve(const master_work *work, wt_master *m)
{
    const spectrum *s = work->s;
    const bool step_response = s->loading != WT_OSCILLATION;
    wt_posterior *p = work->posterior;
    p->measured_factor = arena_numbers(&p->memory, s->n);
    struct order *order = wt_alloc(s->n, sizeof *order);
    m->log_frequency = wt_alloc(4 * s->n, sizeof *m->log_frequency);
    m->isotherm = wt_alloc(s->n, sizeof *m->isotherm);
    m->is_outlier = wt_alloc(s->n, sizeof *m->is_outlier);
    m->fitted_storage = wt_alloc(4 * s->n, sizeof *m->fitted_storage);
    m->log_storage = m->log_frequency + s->n;
    m->log_loss = m->log_storage + s->n;
    m->fitted_loss = m->fitted_storage + s->n;
    m->fitted_loss_factor = m->fitted_loss + s->n;
    m->fitted_step = m->fitted_loss_factor + s->n;
    m->log_step = m->log_loss + s->n;
    for (size_t i = 0; i < m->n_shifts; i++) {
        if (!m->shifts[i].determined)
            continue; /* the isotherm may not be in the spectrum */
        const double a = m->shifts[i].log_a.value - m->offset.value;
        for (size_t k = s->first[work->curve[i]]; k < s->first[work->curve[i] + 1]; k++)
            order[m->n++] = (struct order){s->x[k] / M_LN10 + a, k, i};
    }
    qsort(order, m->n, sizeof *order, compare_reduced_frequency);
    for (size_t j = 0; j < m->n; j++) {
        const size_t k = order[j].point, i = m->isotherm[j] = order[j].isotherm;
        m->log_frequency[j] = order[j].x;
        const double b = m->shifts[i].log_b.value, unknown = (double)NAN;
        const double storage = s->used[STORAGE] ? s->y[STORAGE][k] / M_LN10 + b : unknown;
        m->log_storage[j] = step_response ? unknown : storage;
        m->log_step[j] = step_response ? storage : unknown;
        m->log_loss[j] = s->used[LOSS] && !s->ratio ? s->y[LOSS][k] / M_LN10 + b : unknown;
        p->measured_factor[j] = measured_loss_factor(s, k);
        m->is_outlier[j] = (s->used[STORAGE] && s->weight[STORAGE][k] == 0.0) ||
                           (s->used[LOSS] && s->weight[LOSS][k] == 0.0);
    }
    for (size_t j = 0; j < m->n; j++)
        m->fitted_storage[j] = m->fitted_loss[j] = m->fitted_loss_factor[j] = m->fitted_step[j] =
            unknown_interval;
    const bool fitted = !work->options.series_only && !work->options.skip_fitted_moduli;
    if (fitted)
        fill_fitted_moduli(work->posterior, false, m);
    if (fitted && step_response)
        fill_fitted_moduli(work->posterior, true, m);
    free(order);
}

/* Returns the probability that a spectrum with its end at `place`, or at SPECTRUM_ENDS places
 * alike, extends to a term. */
static double term_is_reached(const spectrum *s, size_t term, size_t place)
{
    const bool all = place == SPECTRUM_ENDS;
    int reached = 0;
    for (size_t k = all ? 0 : place; k < (all ? place : place + 1); k++)
        reached += term < spectrum_end_term(s, k);
    return reached / (all ? (double)SPECTRUM_ENDS : 1.0);
}

/* Converts unknowns of the spectrum to a series at the reference temperature. The share of a term
 * that is not reached counts as equilibrium modulus. */
static void terms_to_prony(const wt_posterior *p, const double *value, double offset, size_t place,
                           wt_prony *prony)
{
    const spectrum *s = &p->frame;
    wt_prony_alloc(prony, s->n_terms);
    prony->equilibrium_modulus = s->liquid ? 0.0 : exp(value[s->n_terms]);
    for (size_t j = 0; j < s->n_terms; j++) {
        const double share = s->liquid ? 1.0 : term_is_reached(s, j, place);
        prony->relaxation_time[j] = exp(s->log_tau + (double)j * s->step + offset * M_LN10);
        prony->modulus[j] = share * exp(value[j]);
        prony->equilibrium_modulus += (1.0 - share) * exp(value[j]);
    }
}

static void fill_series(const wt_posterior *p, wt_master *m)
{
    double *value = wt_alloc(p->frame.n_unknowns, sizeof *value);
    double unknown[LAW_MAX_UNKNOWNS];
    posterior_mean(p, value);
    posterior_mean_law(p, unknown);
    if (has_modulus_level(p->by))
        terms_to_prony(p, value, unknown[0], SPECTRUM_ENDS, &m->prony);
    free(value);
    m->prony.deformation = m->deformation;
    m->prony.reference_temperature = m->reference_temperature;
    if (m->n > 0) {
        m->prony.frequency_min = pow(10.0, m->log_frequency[0]);
        m->prony.frequency_max = pow(10.0, m->log_frequency[m->n - 1]);
    }
    m->equilibrium = has_modulus_level(p->by) ? (wt_interval){0} : unknown_interval;
    if (p->frame.liquid || !has_modulus_level(p->by))
        return;
    const wt_interval e = posterior_equilibrium(p);
    m->equilibrium = interval_map(e, exp);
    double lowest = HUGE_VAL;
    for (size_t i = 0; i < m->n; i++)
        lowest = fmin(lowest, m->loading == WT_OSCILLATION ? m->log_storage[i] : m->log_step[i]);
    m->equilibrium_limit = !(e.low >= log(equilibrium_limit_share) + lowest * M_LN10);
    if (m->equilibrium_limit) {
        m->equilibrium.low = 0.0;
        m->equilibrium.standard_error = (double)NAN;
    }
}

/* Sets the offset of the law against the shifts. Outside the isotherms the law gives the shifts, so
 * there is none. */
static void set_offset(const master_work *work, wt_master *m)
{
    const wt_interval of_law = m->offset;
    m->offset = (wt_interval){0};
    if (m->law.kind == WT_LAW_NONE)
        return;
    if (work->at == work->anchor) {
        m->offset = of_law;
    } else if (work->is_reference_fitted) {
        const wt_interval a = posterior_a_to_law(work->posterior, &work->place);
        m->offset = (wt_interval){-a.value, a.standard_error, -a.high, -a.low};
    } else if (work->at < work->set.n) {
        m->offset = interval_offset(of_law, m->shifts[work->anchor].log_a.value);
    }
}

/* ---- report ---------------------------------------------------------------------------------- */

wt_status master_report(master_work *work, const wt_sweep *sweep, wt_log *log, wt_master *master,
                        wt_error *err)
{
    wt_master m = {.deformation = sweep->deformation,
                   .loading = sweep->loading,
                   .reference_temperature = work->reference,
                   .sample_temperature_error = (double)NAN,
                   .vertical = work->options.vertical,
                   .shift_route = work->route,
                   .terms_per_decade = work->terms_per_decade,
                   .noise_storage = work->s->used[STORAGE] ? work->s->noise[STORAGE] : (double)NAN,
                   .noise_loss = work->s->used[LOSS] ? work->s->noise[LOSS] : (double)NAN,
                   .correlation = work->s->rho,
                   .evaluations = work->s->evaluations,
                   .step_tolerance = sqrt(SPECTRUM_MIN_GAIN),
                   .step_bound = work->posterior->step_left};
    work->posterior->by = work->set.quantity;
    m.has_converged = true;
    for (size_t i = 0; i < work->posterior->n_components; i++)
        m.has_converged = m.has_converged && work->posterior->components[i].cell->has_converged;
    master_fill_shifts(work, &m);
    fill_shift_law(work->posterior, &m);
    if (m.law.kind != WT_LAW_NONE && work->options.sample_temperature_error > 0.0)
        m.sample_temperature_error = work->options.sample_temperature_error;
    m.phase_lag = posterior_instrument(work->posterior, PHASE_LAG);
    m.inertia = posterior_instrument(work->posterior, INERTIA);
    m.frame_compliance = posterior_instrument(work->posterior, FRAME_COMPLIANCE);
    clear_law_errors(work->s, &m);
    wt_status status = master_check_reference(work, &m, err);
    if (status == WT_OK)
        status = master_check_shifts(work, &m, err);
    if (status == WT_OK) {
        work->posterior->anchor_a = m.shifts[work->anchor].log_a.value;
        set_offset(work, &m);
        set_law_rms(&m);
        fill_master_curve(work, &m);
        fill_series(work->posterior, &m);
    }
    if (status != WT_OK) {
        wt_master_clear(&m);
        return status;
    }
    m.superposition = WT_SUPERPOSITION_INCONCLUSIVE;
    m.valid_from = m.valid_to = (double)NAN;
    m.lack_of_fit_p = (double)NAN;
    if (!work->options.series_only)
        master_assess(work, &m);
    master_add_notes(work, sweep, &m, log);
    work->s->prior = NULL; /* the prior belongs to the work */
    m.posterior = work->posterior;
    work->posterior = NULL;
    *master = m;
    return WT_OK;
}

/* ---- queries of the result ------------------------------------------------------------------- */

wt_interval wt_master_log_shift(const wt_master *master, double temperature)
{
    if (master->law.kind == WT_LAW_NONE || isnan(wt_shift_law_log_a(&master->law, temperature)))
        return unknown_interval;
    return reported_law(master->posterior, temperature);
}

double wt_master_closed_form(const wt_master *master, size_t isotherm)
{
    return master->posterior->closed_form[isotherm] + master->posterior->anchor_a;
}

void wt_master_moduli(const wt_master *master, double angular_frequency, wt_interval *log_storage,
                      wt_interval *log_loss)
{
    wt_interval modulus[WITH_LOSS_FACTOR];
    const wt_shift_quantity by = master->posterior->by;
    posterior_moduli(master->posterior, log(angular_frequency), false, modulus);
    *log_storage =
        has_modulus_level(by) ? scale_interval(modulus[STORAGE], 1.0 / M_LN10) : unknown_interval;
    *log_loss =
        by != WT_SHIFT_LOSS_FACTOR ? scale_interval(modulus[LOSS], 1.0 / M_LN10) : unknown_interval;
}

wt_shift_quantity wt_master_shift_quantity(const wt_master *master)
{
    return master->posterior->by;
}

double wt_master_loss_factor(const wt_master *master, size_t i)
{
    return master->posterior->measured_factor[i];
}

void wt_master_spectrum(const wt_master *master, size_t term, wt_interval *log_density)
{
    const wt_prony *p = &master->prony;
    const double step = master->posterior->frame.step;
    *log_density = unknown_interval;
    if (term >= p->n || !(p->relaxation_time[term] * p->frequency_max >= 1.0) ||
        !(p->relaxation_time[term] * p->frequency_min <= 1.0))
        return;
    const size_t before = term > 0 ? term - 1 : 0, after = term + 1 < p->n ? term + 1 : term;
    const double slope =
        log(p->modulus[after] / p->modulus[before]) / (step * (double)(after - before));
    *log_density = scale_interval(
        interval_offset(posterior_term(master->posterior, term, slope), -log(step)), 1.0 / M_LN10);
}

/* Moves a law to a sample that is warmer than stated. The law found is that of the stated
 * temperatures, so the one of true temperatures has its reference moved; its constants are then
 * referred to the former reference again, to which the returned log10 factor takes the times. */
static double move_to_warmer_sample(double kelvin, wt_shift_law *law)
{
    const double reference = law->wlf.reference_temperature,
                 factor = wt_shift_law_log_a(law, reference - kelvin);
    const double c2 = law->wlf.c2 - kelvin;
    if (isnan(factor) || (law->kind != WT_LAW_ARRHENIUS && !(c2 > 0.0)))
        return 0.0; /* there is no law so near to its pole */
    if (law->kind != WT_LAW_ARRHENIUS) {
        law->wlf.c1 *= law->wlf.c2 / c2;
        law->wlf.c2 = c2;
    }
    law->joint += kelvin;
    return factor;
}

wt_status wt_master_draw(const wt_master *master, uint64_t seed, size_t index, wt_prony *prony,
                         wt_shift_law *law, double *log_b, wt_error *err)
{
    const wt_posterior *p = master->posterior;
    const size_t n = p->frame.n_curves;
    double unknown[LAW_MAX_UNKNOWNS];
    double *value = wt_alloc(p->frame.n_unknowns + n, sizeof *value);
    double *b = value + p->frame.n_unknowns;
    posterior_draw(p, seed, index, value, unknown, b);
    (void)err;
    *law = master->law;
    double offset = unknown[0];
    if (master->law.kind != WT_LAW_NONE) {
        *law = law_constants(&p->shape, unknown);
        const double off = master->sample_temperature_error;
        if (off > 0.0)
            offset += move_to_warmer_sample(off * posterior_temperature_draw(seed, index), law);
    }
    terms_to_prony(p, value, offset, posterior_end_index(seed, index), prony);
    prony->deformation = master->deformation;
    prony->reference_temperature = master->reference_temperature;
    prony->frequency_min = master->prony.frequency_min;
    prony->frequency_max = master->prony.frequency_max;
    for (size_t i = 0; log_b != NULL && i < master->n_shifts; i++)
        log_b[i] = master->shifts[i].determined ? b[p->curve[i]] : (double)NAN;
    free(value);
    return WT_OK;
}
