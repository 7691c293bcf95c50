/* Fits a self-affine law with a roll-off to a spectrum. For a fixed roll-off the law is linear
 * in ln C.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface/numerics/surface_analysis.h"

#include "core/math/cholesky.h"
#include "core/math/root.h"
#include "core/math/special.h"
#include "core/math/students_t.h"
#include "weartrack/surface.h"

#include <float.h>
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

enum { LN_C0, LN_ROLL_OFF, HURST, CONSTANTS };

typedef struct affine_fit_work {
    double *x, *y, *weight; /* [n] ln q, ln C without its bias, 1 / variance */
    double *variance;       /* [n] by the scatter of the modes */
    size_t n;
    double *places;  /* [n * n_sizes] place weights of each point by scan size, or NULL */
    double c, power; /* ln C0 and -2 (1 + H) at the last tested roll-off */
    double c_variance, power_variance; /* variances at that roll-off */
} affine_fit_work;

static double residual(const affine_fit_work *f, size_t i, double r)
{
    return f->y[i] - f->c - f->power * fmax(0, f->x[i] - r);
}

/* Fits by least squares for a roll-off at x = r. Returns chi-squared. */
static double chi_squared(affine_fit_work *f, double r)
{
    double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, chi = 0;
    for (size_t i = 0; i < f->n; i++) {
        const double x = fmax(0, f->x[i] - r), w = f->weight[i];
        s += w;
        sx += w * x;
        sy += w * f->y[i];
        sxx += w * x * x;
        sxy += w * x * f->y[i];
    }
    const double d = s * sxx - sx * sx;
    f->power = (s * sxy - sx * sy) / d;
    f->c = (sy - f->power * sx) / s;
    f->c_variance = sxx / d;
    f->power_variance = s / d;
    for (size_t i = 0; i < f->n; i++)
        chi += f->weight[i] * residual(f, i, r) * residual(f, i, r);
    return chi;
}

static double negative_chi_squared(double r, void *user)
{
    return -chi_squared(user, r);
}

/* Finds the best roll-off. chi-squared has a kink at each point, so each interval is searched
 * separately. At least two points lie above the roll-off, to determine the slope. */
static double find_roll_off(affine_fit_work *f, double *best)
{
    enum { SECTIONS = 40 }; /* to 1e-8 of the distance of two points */
    double at = f->x[0];
    *best = chi_squared(f, at);
    for (size_t i = 0; i + 3 < f->n; i++) {
        const double r = root_maximum(negative_chi_squared, f, f->x[i], f->x[i + 1], SECTIONS);
        const double chi = chi_squared(f, r);
        if (chi < *best) {
            *best = chi;
            at = r;
        }
    }
    return at;
}

/* Sets weights with a variance of exp(ln_added) in addition to that of the modes. Returns the
 * excess of chi-squared over its degrees of freedom. */
static double misfit_excess(double ln_added, void *user)
{
    affine_fit_work *const f = user;
    double best;
    for (size_t i = 0; i < f->n; i++)
        f->weight[i] = 1 / (f->variance[i] + exp(ln_added));
    (void)find_roll_off(f, &best);
    return best - (double)(f->n - CONSTANTS);
}

/* A spectrum that is not self-affine deviates from the law as much where a bin has many modes. Its
 * deviation is then a variance of every bin; else the bins of short waves, which have most modes,
 * decide alone, and the law leaves the long waves. */
static void add_law_variance(affine_fit_work *f)
{
    /* From far less than the scatter of any bin to a factor of exp(10), in ln C. */
    const double least = -25, most = 5;
    double added;
    if (root_find(misfit_excess, f, least, most, 1e-3, &added, NULL) == WT_OK)
        (void)misfit_excess(added, f);
}

/* The law linearised at its best constants: J^T W J, in the order of `fitted`. */
typedef struct linear_law {
    const affine_fit_work *f;
    double r;
    size_t n; /* 3, or 2 without a roll-off */
    double normal[CONSTANTS][CONSTANTS];
} linear_law;
/* The roll-off is last, because it is not always fitted. */
static const size_t fitted[CONSTANTS] = {LN_C0, HURST, LN_ROLL_OFF};

/* Returns the derivative of a point by a constant. */
static double point_derivative(const linear_law *l, size_t i, size_t constant)
{
    const double x = l->f->x[i] - l->r;
    return constant == LN_C0 ? 1 : !(x > 0) ? 0 : constant == HURST ? -2 * x : -l->f->power;
}

static linear_law linearise_law(const affine_fit_work *f, double r, bool rolls_off)
{
    linear_law l = {.f = f, .r = r, .n = rolls_off ? 3 : 2};
    for (size_t i = 0; i < f->n; i++)
        for (size_t a = 0; a < l.n; a++)
            for (size_t b = 0; b < l.n; b++)
                l.normal[a][b] += f->weight[i] * point_derivative(&l, i, fitted[a]) *
                                  point_derivative(&l, i, fitted[b]);
    return l;
}

/* Replaces e by (J^T W J)^-1 e, in the order of `fitted`. */
static bool solve_normal(const linear_law *l, double e[CONSTANTS])
{
    double m[CONSTANTS][CONSTANTS];
    for (size_t a = 0; a < l->n; a++)
        for (size_t b = 0; b < l->n; b++)
            m[a][b] = l->normal[a][b];
    return cholesky_solve(&m[0][0], CONSTANTS, l->n, (double)(l->n * l->n) * DBL_EPSILON, e);
}

/* Returns the factor on the variances of the mode scatter so that 1.96 standard errors contain
 * 95 %. It is 1 unless the misfit, with its few degrees of freedom, is larger. The misfit of the
 * law is thus always included. A misfit of at least 1 together with Student's t contained 98.7 %
 * for a correct law. */
static double variance_factor(double misfit, double freedom)
{
    gsl_quiet();
    const double t = students_t_quantile(freedom) / NORMAL_95;
    return fmax(1, misfit * t * t);
}

/* Computes (J^T W J)^-1 times a factor. */
static bool find_law_covariance(const linear_law *l, double scale, double to[CONSTANTS][CONSTANTS])
{
    for (size_t c = 0; c < l->n; c++) {
        double e[CONSTANTS] = {0};
        e[c] = scale;
        if (!solve_normal(l, e))
            return false;
        for (size_t a = 0; a < l->n; a++)
            to[fitted[a]][fitted[c]] = e[a];
    }
    return true;
}

typedef struct constant_range {
    double low, high;
} constant_range;

typedef struct law_ranges {
    constant_range of[CONSTANTS];
} law_ranges;

static void extend_by_span(constant_range *span, double low, double high)
{
    span->low = fmin(span->low, low);
    span->high = fmax(span->high, high);
}

/* Finds the ranges of the constants of all laws within 1.96 standard errors of the best one. The
 * kink at the roll-off makes chi-squared not parabolic. Intervals from its curvature contained
 * c0 and the roll-off of stitched scans in 89 and 91 % only. */
static law_ranges find_law_ranges(affine_fit_work *f, double best, bool rolls_off, double wider)
{
    enum { ROLL_OFFS = 2000 }; /* a tenth of the smallest error of the roll-off */
    const double none = (double)INFINITY, first = f->x[0],
                 step = (f->x[f->n - 3] - first) / ROLL_OFFS,
                 most = chi_squared(f, best) + NORMAL_95 * NORMAL_95 * wider;
    law_ranges spans = {{{none, -none}, {none, -none}, {none, -none}}};
    for (int i = -1; i <= (rolls_off ? ROLL_OFFS : -1); i++) {
        const double r = i < 0 ? best : first + step * i, slack = most - chi_squared(f, r);
        if (slack < 0)
            continue;
        const double c = sqrt(slack * f->c_variance), h = sqrt(slack * f->power_variance) / 2,
                     hurst = -f->power / 2 - 1;
        extend_by_span(&spans.of[LN_C0], f->c - c, f->c + c);
        extend_by_span(&spans.of[LN_ROLL_OFF], r, r);
        extend_by_span(&spans.of[HURST], hurst - h, hurst + h);
    }
    (void)chi_squared(f, best);
    return spans;
}

static wt_interval range_interval(double value, constant_range span, bool logarithm)
{
    const double half = (span.high - span.low) / 2 / NORMAL_95;
    if (!logarithm)
        return (wt_interval){value, half, span.low, span.high};
    return (wt_interval){exp(value), exp(value) * half, exp(span.low), exp(span.high)};
}

/* Computes the covariance due to the place scatter. The scans of one size share one error in all
 * bins, so several sizes tilt the law and move its roll-off. */
static bool find_position_covariance(const linear_law *l, const wt_surface_spectrum *s,
                                     double to[CONSTANTS][CONSTANTS])
{
    const affine_fit_work *const f = l->f;
    if (f->places == NULL) {
        const double error = s->place_error > 0 ? s->place_error : 0;
        to[LN_C0][LN_C0] = error * error;
        return true;
    }
    for (size_t size = 0; s->place_reach > 0 && size < s->n_sizes; size++) {
        double e[CONSTANTS] = {0};
        for (size_t k = 0; k < f->n; k++)
            for (size_t a = 0; a < l->n; a++)
                e[a] += f->weight[k] * point_derivative(l, k, fitted[a]) * s->place_reach *
                        f->places[k * s->n_sizes + size];
        if (!solve_normal(l, e))
            return false;
        for (size_t a = 0; a < l->n; a++)
            for (size_t b = 0; b < l->n; b++)
                to[fitted[a]][fitted[b]] += e[a] * e[b];
    }
    return true;
}

static constant_range add_position_error(constant_range span, double value, double error)
{
    return (constant_range){value - hypot(value - span.low, error),
                            value + hypot(span.high - value, error)};
}

static void fill_self_affine(affine_fit_work *f, double r, double wider, wt_self_affine *to)
{
    law_ranges spans = find_law_ranges(f, r, to->rolls_off, wider);
    const double hurst = -f->power / 2 - 1;
    for (size_t a = 0; a < CONSTANTS; a++)
        for (size_t b = 0; b < CONSTANTS; b++)
            to->covariance[a][b] += to->place_covariance[a][b];
    const double best[CONSTANTS] = {[LN_C0] = f->c, [LN_ROLL_OFF] = r, [HURST] = hurst};
    for (size_t a = 0; a < CONSTANTS; a++)
        spans.of[a] =
            add_position_error(spans.of[a], best[a], NORMAL_95 * sqrt(to->place_covariance[a][a]));
    to->c0 = range_interval(f->c, spans.of[LN_C0], true);
    to->roll_off = range_interval(r, spans.of[LN_ROLL_OFF], true);
    to->hurst = range_interval(hurst, spans.of[HURST], false);
}

wt_self_affine wt_self_affine_fit(const wt_surface_spectrum *spectrum)
{
    wt_self_affine law = {.found = false};
    affine_fit_work f = {.x = wt_alloc((4 + spectrum->n_sizes) * spectrum->n, sizeof *f.x)};
    f.y = f.x + spectrum->n;
    f.weight = f.y + spectrum->n;
    f.variance = f.weight + spectrum->n;
    f.places = spectrum->n_sizes > 0 ? f.variance + spectrum->n : NULL;
    for (size_t k = 0; k < spectrum->n; k++) {
        const wt_spectrum_bin *b = &spectrum->bins[k];
        if (!b->reliable)
            continue;
        f.x[f.n] = log(b->wavenumber);
        f.y[f.n] = log(b->density) - surface_log_bias(b->freedom);
        for (size_t i = 0; i < spectrum->n_sizes; i++)
            f.places[f.n * spectrum->n_sizes + i] = spectrum->place_part[k * spectrum->n_sizes + i];
        f.variance[f.n] = surface_log_variance(b->shared_freedom);
        f.weight[f.n] = 1 / f.variance[f.n];
        f.n++;
    }
    if (f.n > CONSTANTS + 1) {
        double best;
        (void)find_roll_off(&f, &best);
        const double freedom = (double)(f.n - CONSTANTS);
        if (best > SELF_AFFINE_BAD * freedom)
            add_law_variance(&f);
        const double none = chi_squared(&f, f.x[0]), r = find_roll_off(&f, &best);
        const double misfit = fmax(1, best / freedom);
        /* A roll-off counts if it is significant at 95 % (chi-squared with one degree of
         * freedom). */
        law.rolls_off = r > f.x[0] && none - best > gsl_cdf_chisq_Pinv(0.95, 1) * misfit;
        const double at = law.rolls_off ? r : f.x[0], left = law.rolls_off ? freedom : freedom + 1;
        law.n = f.n;
        law.misfit = chi_squared(&f, at) / left;
        const double wider = variance_factor(law.misfit, left);
        const linear_law linear = linearise_law(&f, at, law.rolls_off);
        law.found = f.power < 0 && find_law_covariance(&linear, wider, law.covariance) &&
                    find_position_covariance(&linear, spectrum, law.place_covariance);
        if (law.found)
            fill_self_affine(&f, at, wider, &law);
        law.misfit = 0;
        for (size_t i = 0; i < f.n; i++)
            law.misfit += residual(&f, i, at) * residual(&f, i, at) / f.variance[i] / left;
    }
    free(f.x);
    return law;
}

/* ---- predictions of the law ------------------------------------------------------------------ */

double wt_self_affine_density(const wt_self_affine *law, double wavenumber)
{
    const double x = fmax(1, wavenumber / law->roll_off.value);
    return law->found ? law->c0.value * pow(x, -2 * (1 + law->hurst.value)) : (double)NAN;
}

double wt_self_affine_log_error(const wt_self_affine *law, double wavenumber, bool places)
{
    const double x = log(wavenumber / law->roll_off.value), power = 2 * (1 + law->hurst.value);
    const double slope[CONSTANTS] = {
        [LN_C0] = 1, [LN_ROLL_OFF] = x > 0 ? power : 0, [HURST] = x > 0 ? -2 * x : 0};
    double variance = 0;
    if (!law->found)
        return (double)NAN;
    for (size_t a = 0; a < CONSTANTS; a++)
        for (size_t b = 0; b < CONSTANTS; b++)
            variance += slope[a] * slope[b] *
                        (law->covariance[a][b] - (places ? 0 : law->place_covariance[a][b]));
    return sqrt(fmax(0, variance));
}

/* ---- cutoff at a slope ----------------------------------------------------------------------- */

typedef struct slope_search {
    const wt_roughness *roughness;
    double square;
} slope_search;

static double slope_excess(double ln_q, void *user)
{
    const slope_search *const s = user;
    return 2 * M_PI * wt_roughness_moment(s->roughness, 3, exp(ln_q)) - s->square;
}

double wt_roughness_slope_wavenumber(const wt_roughness *roughness, double slope)
{
    slope_search s = {roughness, slope * slope};
    double end = (double)NAN;
    const double low = log(roughness->q0), high = log(roughness->q1);
    if (!(slope > 0) || !(slope_excess(high, &s) >= 0) ||
        root_find(slope_excess, &s, low, high, 0, &end, NULL) != WT_OK)
        return (double)NAN;
    return exp(end);
}
