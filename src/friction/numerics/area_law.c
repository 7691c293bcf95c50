/* Contact area in partial contact: Yang and Persson, J. Phys.: Condens. Matter 20 (2008) 215214
 * (yp08); Wang and Mueser, Tribol. Lett. 65 (2017) 103 (wm17); Xu et al. 2024 (xu24).
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/area_law.h"

#include "core/base/array.h"
#include "core/math/special.h"
#include "friction/numerics/persson_contact.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>

/* r = ln(G / G0) as Chebyshev series on segments of x = ln G0. The nearest singularities of P are i
 * pi/2 away from a real x, which is 4 half widths, so that the error of the series is 7.8^-16 =
 * 5e-15. Beyond the segments, at G0 > 1e12, an asymptotic law in G0 and ln G0 applies; it neglects
 * terms of relative size 1/G0^2. */
enum { DEGREE = 16, SEGMENTS = 42 };
static const double segment_width = 0.8;

struct area_law {
    wt_area_law kind;
    double offset; /* offset of the line beyond the segments */
    double coefficient[SEGMENTS][DEGREE + 1];
};

/* S = constant + linear P + square P^2 + fourth P^4. */
static const struct {
    double constant, linear, square, fourth;
} factors[] = {[WT_AREA_PERSSON] = {1, 0, 0, 0},
               [WT_AREA_YP08] = {0.42, 0, 0.58, 0},
               [WT_AREA_WM17] = {5.0 / 9, 0, -2.0 / 9, 2.0 / 3},
               [WT_AREA_XU24] = {0.42, 0.58, 0, 0}};

static double correction_factor(wt_area_law kind, double area)
{
    const double square = area * area;
    return factors[kind].constant + factors[kind].linear * area + factors[kind].square * square +
           factors[kind].fourth * square * square;
}

static double first_log_variance(void)
{
    return log(CONTACT_FULL_VARIANCE);
}

/* ---- construction ---------------------------------------------------------------------------- */

/* Returns the rise of G0 between two values of G: the integral of dG / S. */
static double full_contact_increment(wt_area_law kind, double from, double to)
{
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0;
    for (size_t i = 0; i < 4; i++) {
        const double low = middle - half * gauss_8_node[i], high = middle + half * gauss_8_node[i];
        sum += gauss_8_weight[i] * (1 / correction_factor(kind, contact_area(low)) +
                                    1 / correction_factor(kind, contact_area(high)));
    }
    return half * sum;
}

/* Newton steps double the number of digits: four suffice from an estimate with 10 % error, two are
 * spare. */
enum { NEWTON_STEPS = 6 };

/* Returns G at G0 = `to` from the pair (G0, G) at a nearby G0. */
static double next_corrected_variance(wt_area_law kind, double from, double variance, double to)
{
    double g = variance + (to - from) * correction_factor(kind, contact_area(variance));
    for (size_t i = 0; i < NEWTON_STEPS; i++)
        g -= (from + full_contact_increment(kind, variance, g) - to) *
             correction_factor(kind, contact_area(g));
    return g;
}

/* Returns the root of G = S(P(G)) G0. It is unique because the right side falls with G. */
static double solve_implicit(wt_area_law kind, double variance)
{
    double g = correction_factor(kind, contact_area(variance)) * variance;
    for (size_t i = 0; i < 2 * NEWTON_STEPS; i++) {
        const double area = contact_area(g), y = 0.5 / sqrt(g);
        const double slope = -M_2_SQRTPI * exp(-y * y) * y / (2 * g); /* dP/dG */
        const double off = g - correction_factor(kind, area) * variance;
        g -= off / (1 - factors[kind].linear * slope * variance);
    }
    return g;
}

static void fit_segment(const double *value, double *coefficient)
{
    for (size_t j = 0; j <= DEGREE; j++) {
        double sum = 0;
        for (size_t k = 0; k <= DEGREE; k++)
            sum +=
                (k == 0 || k == DEGREE ? 0.5 : 1) * value[k] * cos(M_PI * (double)(j * k) / DEGREE);
        coefficient[j] = (j == 0 || j == DEGREE ? 1 : 2) * sum / DEGREE;
    }
}

static double node_log_variance(size_t segment, size_t k)
{
    const double middle = first_log_variance() + segment_width * ((double)segment + 0.5);
    return middle + 0.5 * segment_width * cos(M_PI * (double)k / DEGREE);
}

static area_law *compute_area_law(wt_area_law kind)
{
    area_law *computed = malloc(sizeof *computed);
    if (computed == NULL)
        return NULL;
    computed->kind = kind;
    double from = CONTACT_FULL_VARIANCE, g = CONTACT_FULL_VARIANCE;
    for (size_t p = 0; p < SEGMENTS; p++) {
        double value[DEGREE + 1];
        for (size_t k = DEGREE + 1; k-- > 0;) { /* in rising order */
            const double to = exp(node_log_variance(p, k));
            g = kind == WT_AREA_XU24 ? solve_implicit(kind, to)
                                     : next_corrected_variance(kind, from, g, to);
            from = to;
            value[k] = log(g / to);
        }
        fit_segment(value, computed->coefficient[p]);
    }
    const double slope = factors[kind].constant,
                 log_coefficient = factors[kind].square / (M_PI * slope);
    computed->offset = g - slope * from - log_coefficient * log(from);
    return computed;
}

wt_status area_law_get(wt_area_law kind, const area_law **law, wt_error *err)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static area_law *computed[COUNT_OF(factors)];
    *law = NULL;
    if (kind == WT_AREA_PERSSON)
        return WT_OK;
    pthread_mutex_lock(&lock);
    if (computed[kind] == NULL)
        computed[kind] = compute_area_law(kind);
    *law = computed[kind];
    pthread_mutex_unlock(&lock);
    return *law != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory for a contact area");
}

/* ---- use ------------------------------------------------------------------------------------- */

/* Asymptotic G beyond the segments. */
static double asymptotic_variance(const area_law *law, double variance)
{
    const wt_area_law kind = law->kind;
    const double slope = factors[kind].constant;
    return kind == WT_AREA_XU24
               ? solve_implicit(kind, variance)
               : slope * variance + factors[kind].square / (M_PI * slope) * log(variance) +
                     law->offset;
}

double area_law_variance(const area_law *law, double variance)
{
    if (law == NULL || !(variance > CONTACT_FULL_VARIANCE))
        return variance;
    const double position = (log(variance) - first_log_variance()) / segment_width;
    if (!(position < SEGMENTS))
        return asymptotic_variance(law, variance);
    const size_t segment = (size_t)position;
    const double *c = law->coefficient[segment], z = 2 * (position - (double)segment) - 1;
    double next = 0, here = 0;
    for (size_t j = DEGREE; j > 0; j--) { /* Clenshaw recurrence */
        const double before = 2 * z * here - next + c[j];
        next = here;
        here = before;
    }
    return variance * exp(z * here - next + c[0]);
}

double area_law_integral(const area_law *law, double variance, double gamma)
{
    if (law == NULL || !(variance > CONTACT_FULL_VARIANCE))
        return contact_integral(variance, gamma);
    const double length = log(variance) - first_log_variance();
    const size_t n = 1 + (size_t)(length / segment_width);
    const double half = 0.5 * length / (double)n;
    double sum = 0;
    for (size_t p = 0; p < n; p++)
        for (size_t i = 0; i < 8; i++) {
            const double node = i < 4 ? -gauss_8_node[i] : gauss_8_node[i - 4];
            const double g0 = exp(first_log_variance() + half * ((double)(2 * p + 1) + node));
            const double area = contact_area(area_law_variance(law, g0));
            sum += half * gauss_8_weight[i % 4] * g0 * area * (gamma + (1 - gamma) * area * area);
        }
    return CONTACT_FULL_VARIANCE + sum;
}
