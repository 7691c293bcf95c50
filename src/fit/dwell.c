/* Dwell on a rubber: a power law of relaxation or creep behind a loading of finite length.
 *
 * E(t) = E1 (t/1s)^-n and its creep compliance J(t) = (t/1s)^n / (E1 Gamma(1+n) Gamma(1-n)). What
 * is held, the indentation or the force, came up as the loading law u^p of its time u: then the
 * ratio of force to contact function is a hereditary integral over the loading alone.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/fit.h"

#include <gsl/gsl_sf_gamma.h>
#include <math.h>

enum { NODES = 200, SEARCH = 40, LEAST_POINTS = 6, MOST_POINTS = 1000 };
static const double largest_exponent = 0.9, golden = 0.6180339887498949;

/* What int_0^1 (tau - u)^power p u^(p-1) du needs at u = 1 - y^2, which takes the edge off. */
typedef struct loading {
    double square[NODES], weight[NODES]; /* y^2, p u^(p-1) 2y dy */
} loading;

static void make_loading(double p, loading *l)
{
    for (int i = 0; i < NODES; i++) {
        const double y = (i + 0.5) / NODES;
        l->square[i] = y * y;
        l->weight[i] = p * pow(1 - y * y, p - 1) * 2 * y / NODES;
    }
}

/* tau >= 1 */
static double over_loading(const loading *l, double tau, double power)
{
    double sum = 0;
    for (int i = 0; i < NODES; i++)
        sum += l->weight[i] * pow(tau - 1 + l->square[i], power);
    return sum;
}

/* Of modulus 1 at 1 s. */
static double apparent(const loading *l, double exponent, double time, double load_time, bool creep)
{
    const double tau = time / load_time, scale = pow(load_time, -exponent);
    if (!creep)
        return scale * over_loading(l, tau, -exponent);
    return scale * gsl_sf_gamma(1 + exponent) * gsl_sf_gamma(1 - exponent) /
           over_loading(l, tau, exponent);
}

double wt_dwell_modulus(double modulus, double exponent, double time, double load_time,
                        double force_exponent, bool creep)
{
    loading l;
    make_loading(force_exponent, &l);
    return modulus * apparent(&l, exponent, time, load_time, creep);
}

typedef struct points {
    const double *time, *modulus; /* [n] */
    size_t n;
    double load_time;
    bool creep;
    loading loading;
} points;

/* Sum of squares about the law with the best modulus at 1 s, in the logarithm. */
static double squares(const points *p, double exponent, double *log_modulus)
{
    double off[MOST_POINTS], mean = 0, sum = 0;
    for (size_t i = 0; i < p->n; i++) {
        off[i] = log(p->modulus[i] /
                     apparent(&p->loading, exponent, p->time[i], p->load_time, p->creep));
        mean += off[i] / (double)p->n;
    }
    for (size_t i = 0; i < p->n; i++)
        sum += (off[i] - mean) * (off[i] - mean);
    *log_modulus = mean;
    return sum;
}

wt_status wt_dwell_fit(const double *time, const double *modulus, size_t n, double load_time,
                       double force_exponent, bool creep, wt_dwell *dwell, wt_error *err)
{
    const double nan_ = (double)NAN;
    if (time == NULL || modulus == NULL || dwell == NULL)
        return wt_fail(err, WT_E_ARG, "no dwell");
    *dwell = (wt_dwell){.why_not = "", .modulus = nan_, .exponent = nan_, .misfit = nan_};
    bool good = n >= LEAST_POINTS && n <= MOST_POINTS && load_time > 0 && force_exponent >= 1;
    for (size_t i = 0; i < n && good; i++)
        good = time[i] >= load_time && modulus[i] > 0;
    if (!good) {
        dwell->why_not = "too few or too many points, or a modulus that is not positive";
        return WT_OK;
    }
    points p = {.time = time, .modulus = modulus, .n = n, .load_time = load_time, .creep = creep};
    make_loading(force_exponent, &p.loading);
    double low = 0, high = largest_exponent, mean = 0;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = squares(&p, a, &mean), at_b = squares(&p, b, &mean);
    for (int i = 0; i < SEARCH; i++) {
        if (at_a < at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - golden * (high - low);
            at_a = squares(&p, a, &mean);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + golden * (high - low);
            at_b = squares(&p, b, &mean);
        }
    }
    dwell->exponent = 0.5 * (low + high);
    dwell->misfit = sqrt(squares(&p, dwell->exponent, &mean) / (double)n);
    dwell->modulus = exp(mean);
    dwell->found = true;
    return WT_OK;
}
