/* Prony series of a master curve by non-negative least squares with relative weights, and the
 * Kramers-Kronig check that follows from it. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/prony.h"

#include "base/gsl_quiet.h"
#include "base/param.h"
#include "fit/nnls.h"
#include "fit/pool_gsl.h"

#include <gsl/gsl_blas.h>
#include <math.h>

/* How far the relaxation times reach beyond the measured range, on either side [decade]. */
static const double margin = 0.5;
/* On a plateau 1 % of E' is more than all of E'': E' predicts it only where tan delta > 0.1. */
static const double least_log_loss_factor = -1.0;
/* The longest sensible series. */
enum { MAX_TERMS = 1000 };

wt_prony_options wt_prony_defaults(void)
{
    return (wt_prony_options){.terms_per_decade = 2.0, .smoothing = 0.0, .liquid = false};
}

static const wt_param rows[] = {
    {PARAM("terms-per-decade", wt_prony_options, terms_per_decade, WT_Q_NONE, ABOVE_TO(0, 10)),
     .value = "X", .help = "of the Prony series; with 1 its ripple alone is 4 to 16 %"},
    {PARAM("smoothing", wt_prony_options, smoothing, WT_Q_NONE, AT_LEAST(0)), .value = "X",
     .help = "Tikhonov parameter of the Prony series; 0 is none"},
    {PARAM_FLAG_OF("liquid", wt_prony_options, liquid), .help = "no equilibrium modulus"},
};
PARAM_TABLE(wt_prony_params, wt_prony_options, rows, wt_prony_defaults, NO_PARTS)

/* z^2/(1+z^2) and z/(1+z^2), z = 10^log_z, without overflow. */
static void maxwell(double log_z, double *storage, double *loss)
{
    const double z = pow(10.0, log_z), inverse = pow(10.0, -log_z);
    *storage = 1.0 / (1.0 + inverse * inverse);
    *loss = 1.0 / (z + inverse);
}

void prony_log_moduli(const wt_prony *prony, double log_frequency, double *log_storage,
                      double *log_loss)
{
    double storage = prony->equilibrium_modulus, loss = 0.0;
    for (size_t k = 0; k < prony->n; k++) {
        double s, l;
        maxwell(log_frequency + log10(prony->relaxation_time[k]), &s, &l);
        storage += prony->modulus[k] * s;
        loss += prony->modulus[k] * l;
    }
    *log_storage = log10(storage);
    *log_loss = log10(loss);
}

prony_points prony_points_of(const wt_master_curve *master)
{
    return (prony_points){
        master->n,        master->log_frequency,    master->log_storage,
        master->log_loss, master->log_frequency[0], master->log_frequency[master->n - 1]};
}

/* The terms, spread evenly over the range and its margins. */
static wt_status number_of_terms(const prony_points *points, const wt_prony_options *options,
                                 size_t *n, wt_error *err)
{
    const double range = points->log_max - points->log_min + 2.0 * margin;
    const double terms = floor(options->terms_per_decade * range + 0.5) + 1.0;
    if (!(terms >= 1.0) || terms > MAX_TERMS) {
        wt_status status = wt_fail(err, WT_E_RANGE, "a Prony series of %g terms", terms);
        wt_error_expected(err, "1 to %d", MAX_TERMS);
        wt_error_advice(err, "choose fewer terms per decade");
        return status;
    }
    *n = terms < 2.0 ? 2 : (size_t)terms;
    return WT_OK;
}

/* Rows of relative residuals: E'(fit)/E' - 1 and E''(fit)/E'' - 1. */
static void fill_data_rows(const prony_points *points, const double *log_tau, size_t n_terms,
                           gsl_matrix *a, gsl_vector *b)
{
    for (size_t i = 0; i < points->n; i++) {
        const double weight = pow(10.0, -points->log_storage[i]);
        for (size_t k = 0; k < n_terms; k++) {
            double storage, loss;
            maxwell(points->log_frequency[i] + log_tau[k], &storage, &loss);
            gsl_matrix_set(a, i, k, storage * weight);
            if (points->log_loss != NULL)
                gsl_matrix_set(a, points->n + i, k, loss * pow(10.0, -points->log_loss[i]));
        }
        if (a->size2 > n_terms)
            gsl_matrix_set(a, i, n_terms, weight);
        gsl_vector_set(b, i, 1.0);
        if (points->log_loss != NULL)
            gsl_vector_set(b, points->n + i, 1.0);
    }
}

/* Tikhonov: second differences of the terms, each measured by what it gives to the data. */
static void fill_smoothing_rows(double smoothing, size_t n_data, size_t n_terms, gsl_matrix *a)
{
    static const double difference[3] = {1.0, -2.0, 1.0};
    const double weight = sqrt(smoothing);
    for (size_t j = 0; j < n_terms; j++) {
        gsl_vector_view data = gsl_matrix_subcolumn(a, j, 0, n_data);
        const double norm = gsl_blas_dnrm2(&data.vector);
        for (size_t d = 0; d < 3; d++)
            if (j >= d && j - d + 2 < n_terms)
                gsl_matrix_set(a, n_data + j - d, j, weight * difference[d] * norm);
    }
}

wt_status prony_fit_points(const prony_points *points, const wt_prony_options *options,
                           wt_prony *prony, wt_error *err)
{
    const size_t n_data = points->n * (points->log_loss != NULL ? 2 : 1);
    size_t n_terms = 0;
    pool memory = {0};
    wt_prony made = {0};
    wt_status status = number_of_terms(points, options, &n_terms, err);

    gsl_quiet();
    if (status != WT_OK)
        return status;
    const size_t n_columns = n_terms + (options->liquid ? 0 : 1);
    const size_t n_smooth = options->smoothing > 0.0 && n_terms > 2 ? n_terms - 2 : 0;
    if (n_data + n_smooth < n_columns) {
        status = wt_fail(err, WT_E_MISSING, "too few points for the Prony series");
        wt_error_expected(err, "at least %zu values for %zu terms", n_columns, n_terms);
        wt_error_found(err, "%zu", n_data);
        wt_error_advice(err, "choose fewer terms per decade");
        return status;
    }
    gsl_matrix *a = pool_matrix(&memory, n_data + n_smooth, n_columns);
    gsl_vector *b = pool_vector(&memory, n_data + n_smooth);
    double *x = pool_numbers(&memory, n_columns), *log_tau = pool_numbers(&memory, n_terms);
    status = memory.failed ? wt_fail(err, WT_E_MEMORY, "no memory for %zu Prony terms", n_terms)
                           : wt_prony_alloc(&made, n_terms, err);
    if (status != WT_OK)
        goto done;
    const double longest = margin - points->log_min, shortest = -margin - points->log_max;
    for (size_t k = 0; k < n_terms; k++) {
        const double share = (double)k / (double)(n_terms - 1);
        log_tau[k] = longest + share * (shortest - longest);
        made.relaxation_time[k] = pow(10.0, log_tau[k]);
    }
    fill_data_rows(points, log_tau, n_terms, a, b);
    if (n_smooth > 0)
        fill_smoothing_rows(options->smoothing, n_data, n_terms, a);
    status = nnls(a, b, x, err);
    if (status != WT_OK)
        goto done;
    for (size_t k = 0; k < n_terms; k++)
        made.modulus[k] = x[k];
    made.equilibrium_modulus = options->liquid ? 0.0 : x[n_terms];
    made.reference_temperature = (double)NAN;
    made.frequency_min = pow(10.0, points->log_min);
    made.frequency_max = pow(10.0, points->log_max);
    *prony = made;
    made = (wt_prony){0};
done:
    wt_prony_clear(&made);
    pool_free(&memory);
    return status;
}

static wt_status check(const wt_master_curve *master, const wt_prony_options *options,
                       wt_error *err)
{
    wt_status status = param_check(wt_prony_params(), options, err);
    if (status == WT_OK && master->n < 2)
        status = wt_fail(err, WT_E_MISSING, "the master curve has no points");
    return status;
}

wt_status wt_prony_fit_master(const wt_master_curve *master, const wt_prony_options *options,
                              wt_prony_fit *fit, wt_error *err)
{
    const wt_prony_options defaults = wt_prony_defaults();
    wt_prony_fit made = {.prony = {.n = 0}};
    double storage_square = 0.0, loss_square = 0.0;

    if (options == NULL)
        options = &defaults;
    wt_status status = check(master, options, err);
    if (status != WT_OK)
        return status;
    const prony_points points = prony_points_of(master);
    status = prony_fit_points(&points, options, &made.prony, err);
    if (status != WT_OK)
        return status;
    made.prony.deformation = master->deformation;
    made.prony.reference_temperature = master->reference_temperature;
    for (size_t i = 0; i < master->n; i++) {
        double storage, loss;
        prony_log_moduli(&made.prony, master->log_frequency[i], &storage, &loss);
        const double ds = pow(10.0, storage - master->log_storage[i]) - 1.0;
        const double dl = pow(10.0, loss - master->log_loss[i]) - 1.0;
        storage_square += ds * ds;
        loss_square += dl * dl;
    }
    made.rms_storage = sqrt(storage_square / (double)master->n);
    made.rms_loss = sqrt(loss_square / (double)master->n);
    *fit = made;
    return WT_OK;
}

wt_status prony_kramers_kronig(const prony_points *points, double *misfit, wt_error *err)
{
    /* Two terms per decade: the ripple of one would be most of the misfit; a little smoothing,
     * because the storage modulus alone leaves neighbouring terms undecided. */
    const wt_prony_options options = {.terms_per_decade = 2.0, .smoothing = 0.01};
    prony_points storage = *points;
    wt_prony series = {0};
    double square = 0.0;
    size_t n = 0;

    *misfit = (double)NAN;
    storage.log_loss = NULL;
    wt_status status = prony_fit_points(&storage, &options, &series, err);
    if (status == WT_E_MISSING)
        return WT_OK;
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < points->n; i++) {
        if (points->log_frequency[i] < points->log_min + margin ||
            points->log_frequency[i] > points->log_max - margin ||
            points->log_loss[i] - points->log_storage[i] < least_log_loss_factor)
            continue;
        double predicted_storage, predicted_loss;
        prony_log_moduli(&series, points->log_frequency[i], &predicted_storage, &predicted_loss);
        const double difference = pow(10.0, predicted_loss - points->log_loss[i]) - 1.0;
        square += difference * difference;
        n++;
    }
    if (n > 0)
        *misfit = sqrt(square / (double)n);
    wt_prony_clear(&series);
    return WT_OK;
}
