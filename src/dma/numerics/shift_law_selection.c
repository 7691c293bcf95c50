/* Selects the shift law by an information criterion: kind, joint and outlier isotherm.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/shift_law.h"

#include "core/math/arena_gsl.h"
#include "core/math/special.h"

#include <math.h>
#include <string.h>

/* An isotherm is an outlier if a separate shift improves -2 ln likelihood by more than this.
 * chi^2 with one degree of freedom exceeds 20 with probability 8e-6. */
static const double outlier_gain = 20.0;
/* Minimum number of isotherms for an outlier: offset, two constants, scatter, its shift, and one
 * degree of freedom. */
enum { LEAST_OUTLIER = 6 };
/* From seven isotherms on the small-sample term of Akaike is 40 or less. For six it is 40 for
 * WLF and 12 for Arrhenius, a difference that no curvature of a rubber justifies. Fewer
 * isotherms use the mean likelihood over the temperature errors. */
enum { LEAST_CORRECTED = 7 };
/* Minimum number of isotherms of the joined law, with six constants and one more. */
enum { LEAST_JOINED = 8 };
/* Number of joints in the coarse search, which is then refined by halves about the best one. It
 * only limits the time. */
enum { JOINTS = 24 };
/* Of more than MANY isotherms only those off the law by this number of standard deviations are
 * tested as outliers. One of few isotherms can pull the law to itself. It only limits the time. */
static const double outlier_deviations = 2.0;
enum { MANY = 50 };

struct search {
    law_data *data;
    arena memory;
    gsl_matrix *root[LAW_SPREADS]; /* factor of the covariance for each temperature error */
    bool is_factored[LAW_SPREADS]; /* for the present slopes */
    size_t spread;                 /* temperature error of the last largest likelihood */
    double best;                   /* score */
    double largest;                /* its likelihood */
    law_shape chosen;
};

/* Factors the covariance for a temperature error and the present slopes, once. */
static wt_status factor_spread(struct search *search, size_t i, wt_error *err)
{
    const size_t n = search->data->n;
    if (search->is_factored[i])
        return WT_OK;
    if (search->root[i] == NULL)
        search->root[i] = arena_matrix(&search->memory, n, n);
    search->is_factored[i] = true;
    return law_gls_covariance(search->data, law_spread(i), search->root[i], err);
}

/* Computes -2 ln likelihood with one temperature error. */
static wt_status spread_likelihood(struct search *search, const law_shape *shape, size_t i,
                                   double *value, wt_error *err)
{
    law_fit fit;
    wt_status status = factor_spread(search, i, err);
    if (status == WT_OK)
        status = law_fit_gls(search->data, shape, search->root[i], &fit, err);
    *value = status == WT_OK ? fit.chi_square + fit.log_det : HUGE_VAL;
    return status;
}

/* Computes -2 ln of the largest likelihood over the temperature errors, uphill from the last best
 * one. */
static wt_status largest_likelihood(struct search *search, const law_shape *shape, double *largest,
                                    wt_error *err)
{
    wt_status status = spread_likelihood(search, shape, search->spread, largest, err);
    const size_t start = search->spread;
    for (int up = 1; up >= 0 && search->spread <= start; up--)
        for (size_t i = start; status == WT_OK && (up ? i + 1 < LAW_SPREADS : i > 0);) {
            double value;
            i = up ? i + 1 : i - 1;
            status = spread_likelihood(search, shape, i, &value, err);
            if (status == WT_OK && !(value < *largest) && *largest < HUGE_VAL)
                break;
            if (value < *largest) {
                *largest = value;
                search->spread = i;
            }
        }
    return status;
}

/* Computes -2 ln of the largest and of the mean likelihood over the temperature errors. Only few
 * isotherms use the mean. */
static wt_status law_likelihoods(struct search *search, const law_shape *shape, double *largest,
                                 double *mean, wt_error *err)
{
    const law_data *data = search->data;
    double value[LAW_SPREADS], sum = 0.0, weights = 0.0;
    wt_status status = WT_OK;
    *largest = HUGE_VAL;
    if (data->n >= LEAST_CORRECTED)
        status = largest_likelihood(search, shape, largest, err);
    for (size_t i = 0; status == WT_OK && data->n < LEAST_CORRECTED && i < LAW_SPREADS; i++) {
        status = spread_likelihood(search, shape, i, &value[i], err);
        *largest = fmin(*largest, value[i]);
    }
    if (status == WT_OK && !(*largest < HUGE_VAL))
        return wt_fail(err, WT_E_RANGE, "the pole of the law is not determined");
    for (size_t i = 0; status == WT_OK && data->n < LEAST_CORRECTED && i < LAW_SPREADS; i++) {
        sum += law_spread_prior(data, law_spread(i)) * exp(-0.5 * (value[i] - *largest));
        weights += law_spread_prior(data, law_spread(i));
    }
    *mean = data->n < LEAST_CORRECTED ? *largest - 2.0 * log(sum / weights) : (double)NAN;
    return status;
}

static double law_criterion(const law_data *data, const law_shape *shape, double largest,
                            double mean)
{
    /* offset, constants and spread; the outlier counts equally for all laws */
    const double n = (double)data->n, k = (double)law_unknowns(shape) + 1.0 +
                                          (shape->kind == WT_LAW_WLF_ARRHENIUS ? 1.0 : 0.0);
    if (data->n < LEAST_CORRECTED)
        return mean + 2.0 * k;
    return n > k + 1.0 ? largest + 2.0 * k + 2.0 * k * (k + 1.0) / (n - k - 1.0) : HUGE_VAL;
}

/* Tests one law. *better: true if it is the best so far. */
static wt_status try_law(struct search *search, law_shape shape, bool *is_best, wt_error *err)
{
    double largest, mean;
    wt_error failure = WT_ERROR_INIT;
    const wt_status status = law_likelihoods(search, &shape, &largest, &mean, &failure);
    *is_best = false;
    if (status == WT_E_INTERNAL) {
        if (err != NULL)
            *err = failure;
        return status;
    }
    const double s =
        status == WT_OK ? law_criterion(search->data, &shape, largest, mean) : HUGE_VAL;
    if (s < search->best) {
        *is_best = true;
        search->best = s;
        search->largest = largest;
        search->chosen = shape;
    }
    return WT_OK;
}

/* Tests the joint at an isotherm. *best: it, if it improves on all before. */
static wt_status try_joint(struct search *search, law_shape shape, size_t i, size_t *best,
                           wt_error *err)
{
    const law_data *data = search->data;
    bool is_best = false;
    shape.kind = WT_LAW_WLF_ARRHENIUS;
    shape.joint = data->temperature[i];
    shape.coldest = fmin(shape.joint, shape.reference);
    if (i < 2 || i + 3 >= data->n || !(data->temperature[i] > data->temperature[0]))
        return WT_OK;
    const wt_status status = try_law(search, shape, &is_best, err);
    *best = is_best ? i : *best;
    return status;
}

static wt_status try_all_laws(struct search *search, const law_shape *start, wt_error *err)
{
    const size_t n = search->data->n;
    bool is_best;
    size_t joint = 0;
    law_shape shape = *start;
    shape.kind = WT_LAW_ARRHENIUS;
    wt_status status = try_law(search, shape, &is_best, err);
    shape.kind = WT_LAW_WLF;
    if (status == WT_OK && n >= LAW_MIN_ISOTHERMS)
        status = try_law(search, shape, &is_best, err);
    size_t step = 1 + n / JOINTS;
    for (size_t i = 2; status == WT_OK && n >= LEAST_JOINED && i < n; i += step)
        status = try_joint(search, shape, i, &joint, err);
    while (status == WT_OK && joint > 0 && step > 1) {
        const size_t middle = joint;
        step = (step + 1) / 2;
        status = try_joint(search, shape, middle > step ? middle - step : 0, &joint, err);
        if (status == WT_OK)
            status = try_joint(search, shape, middle + step, &joint, err);
    }
    return status;
}

/* Returns true if an isotherm is off the law by little for its error. */
static bool is_near_law(const struct search *search, const law_shape *shape, const law_fit *fit,
                        size_t i)
{
    const law_data *data = search->data;
    const double gap = data->log_a[i] - law_isotherm_value(data, shape, fit->unknown, i);
    return fabs(gap) < outlier_deviations * hypot(sqrt(gsl_matrix_get(data->covariance, i, i)),
                                                  law_spread(search->spread) * data->slope[i]);
}

/* Searches the isotherm that does not belong to the law. */
static wt_status find_outlier_isotherm(struct search *search, wt_error *err)
{
    const struct search plain = *search;
    const size_t n = search->data->n;
    law_fit fit;
    wt_status status = factor_spread(search, plain.spread, err);
    if (status == WT_OK)
        status = law_fit_gls(search->data, &plain.chosen, search->root[plain.spread], &fit, err);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        double largest, mean;
        law_shape shape = plain.chosen;
        if (n > MANY && is_near_law(&plain, &shape, &fit, i))
            continue;
        shape.outlier = (long)i;
        status = law_likelihoods(search, &shape, &largest, &mean, err);
        if (status == WT_E_RANGE)
            status = WT_OK; /* no such law exists without this isotherm */
        else if (status == WT_OK && largest < search->largest &&
                 largest < plain.largest - outlier_gain) {
            search->largest = largest;
            search->chosen = shape;
        }
    }
    return status == WT_E_RANGE ? WT_OK : status; /* a law that rises defines no outlier */
}

/* Sets the slopes of the law at the isotherms, which convert a temperature error to a shift
 * error. */
static void set_slopes(law_data *data, const law_shape *shape, const double *unknown)
{
    const double step = 0.01; /* K */
    for (size_t i = 0; i < data->n; i++)
        data->slope[i] = (law_value(shape, unknown, data->temperature[i] + step, NULL) -
                          law_value(shape, unknown, data->temperature[i] - step, NULL)) /
                         (2.0 * step);
}

/* Selects the law, first with the slopes of a WLF law, then with those of the selected one. */
static wt_status iterate_law_selection(struct search *search, const law_shape *start,
                                       gsl_matrix *root, wt_error *err)
{
    law_data *data = search->data;
    wt_status status = WT_OK;
    for (int round = 0; status == WT_OK && round < 3; round++) {
        law_fit fit;
        if (round == 2 && !(search->best < HUGE_VAL))
            break; /* with the temperature error no law falls */
        const law_shape *shape = round == 2 ? &search->chosen : start;
        status = law_gls_covariance(data, law_temperature_tolerance, root, err);
        if (status == WT_OK)
            status = law_fit_gls(data, shape, root, &fit, err);
        if (status != WT_OK)
            break;
        set_slopes(data, shape, fit.unknown);
        memset(search->is_factored, 0, sizeof search->is_factored);
        if (round == 1)
            status = try_all_laws(search, start, err);
    }
    if (status == WT_OK && !(search->best < HUGE_VAL))
        status = wt_fail(err, WT_E_RANGE, "no law describes the shift factors");
    return status;
}

wt_status law_select(law_data *data, double reference, gsl_matrix *root, law_shape *chosen,
                     wt_error *err)
{
    struct search search = {.data = data, .best = HUGE_VAL, .largest = HUGE_VAL};
    const law_shape start = {.kind = data->n >= LAW_MIN_ISOTHERMS ? WT_LAW_WLF : WT_LAW_ARRHENIUS,
                             .reference = reference,
                             .outlier = -1,
                             .coldest = fmin(data->temperature[0], reference)};
    gsl_quiet();
    for (size_t i = 0; i < data->n; i++)
        data->slope[i] = 0.1;
    wt_status status = iterate_law_selection(&search, &start, root, err);
    if (status == WT_OK && data->n >= LEAST_OUTLIER)
        status = find_outlier_isotherm(&search, err);
    arena_free(&search.memory);
    *chosen = search.chosen;
    return status;
}
