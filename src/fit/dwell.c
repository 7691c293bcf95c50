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

/* What int_0^1 (tau - u)^power p u^(p-1) du needs. In each cell the kernel, which has a pole at the
 * end of the loading, and the loading are integrated exactly and multiplied; cells are equal in the
 * root of 1 - u. */
typedef struct loading {
    double gap[NODES + 1]; /* 1 - u at the edges of the cells, rising */
    double rate[NODES];    /* what is loaded in a cell, over its width */
} loading;

static void make_loading(double p, loading *l)
{
    for (int i = 0; i <= NODES; i++)
        l->gap[i] = (double)i / NODES * i / NODES;
    for (int i = 0; i < NODES; i++)
        l->rate[i] =
            (pow(1 - l->gap[i], p) - pow(1 - l->gap[i + 1], p)) / (l->gap[i + 1] - l->gap[i]);
}

/* tau >= 1 */
static double over_loading(const loading *l, double tau, double power)
{
    double sum = 0, before = pow(tau - 1, power + 1);
    for (int i = 0; i < NODES; i++) {
        const double next = pow(tau - 1 + l->gap[i + 1], power + 1);
        sum += l->rate[i] * (next - before);
        before = next;
    }
    return sum / (power + 1);
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

/* What no law can be fitted to, or "". */
static const char *lacks(const double *time, const double *modulus, size_t n, double load_time,
                         double force_exponent)
{
    if (n < LEAST_POINTS)
        return "too few points";
    if (n > MOST_POINTS)
        return "too many points";
    if (!(load_time > 0) || !(force_exponent > 0 && isfinite(force_exponent)))
        return "no loading that force and time tell";
    for (size_t i = 0; i < n; i++) {
        if (!(time[i] >= load_time && isfinite(time[i])))
            return "a point from before the end of the loading, or from no time";
        if (!(modulus[i] > 0 && isfinite(modulus[i])))
            return "a modulus that is no positive number";
    }
    return "";
}

wt_status wt_dwell_fit(const double *time, const double *modulus, size_t n, double load_time,
                       double force_exponent, bool creep, wt_dwell *dwell, wt_error *err)
{
    const double nan_ = (double)NAN;
    if (time == NULL || modulus == NULL || dwell == NULL)
        return wt_fail(err, WT_E_ARG, "no dwell");
    *dwell = (wt_dwell){.why_not = "", .modulus = nan_, .exponent = nan_, .misfit = nan_};
    dwell->why_not = lacks(time, modulus, n, load_time, force_exponent);
    if (dwell->why_not[0] != '\0')
        return WT_OK;
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
    if (!(high < largest_exponent)) {
        dwell->why_not = "falls faster than any power law of rubber";
        return WT_OK;
    }
    dwell->exponent = 0.5 * (low + high);
    dwell->misfit = sqrt(squares(&p, dwell->exponent, &mean) / (double)n);
    dwell->modulus = exp(mean);
    dwell->found = true;
    return WT_OK;
}
