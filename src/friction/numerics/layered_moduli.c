/* Angular integrals with a layer. Over a quarter turn omega = q v sin(theta). The turn is divided
 * where the layer's moduli are not smooth. Each part uses a trapezoidal rule in a variable that
 * removes the end singularities (Takahasi and Mori, Publ. RIMS 9 (1974) 721). Every second node
 * forms a coarser rule, which gives the error.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "friction/numerics/layered_moduli.h"
#include "core/base/array.h"
#include "core/math/root.h"
#include "friction/numerics/friction_kernel.h"
#include "friction/numerics/persson_contact.h"

#include <complex.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* the macro I is of type float and would widen every product */
static const double complex unit = (double complex)I;

/* Steps of the rule in t and its start, for tolerances down to the one in the row. The poles of
 * Maxwell elements and of p have the distance 1 or more from a real t, which gives the error e^(-2
 * pi/step). Below the first node the integrand is constant. */
static const struct {
    double tolerance, step, begin;
} rules[] = {{1e-6, 0.3, -12}, {0, 0.2, -24}};
static const double rule_end = 3.6; /* the rest is e^(-e^3.6), below rounding */

/* ---- ratio of the moduli ------------------------------------------------------------------------
 */

/* The logarithm of a minimum-phase ratio is analytic, so that its phase follows from its modulus
 * (Bode, Bell Syst. Tech. J. 19 (1940) 421), with u = ln omega:
 *   phase(u) = 1/pi int (d ln|ratio| / du') ln coth(|u - u'| / 2) du'
 * The result is exponent / pi [L(u - u_low) - L(u - u_high)], L(y) = int_0^y ln coth(|t| / 2) dt.
 */

/* Coefficient of the series of chi. */
#define TERM(k) (1.0 / ((k) * (k)))

/* Legendre's chi function, the sum of z^k / k^2 over odd k, for 0 <= z <= sqrt(2) - 1. */
static double legendre_chi_2(double z)
{
    /* The series starts at the k whose term is 1e-16 of the first. */
    static const double term[] = {TERM(35), TERM(33), TERM(31), TERM(29), TERM(27), TERM(25),
                                  TERM(23), TERM(21), TERM(19), TERM(17), TERM(15), TERM(13),
                                  TERM(11), TERM(9),  TERM(7),  TERM(5),  TERM(3),  TERM(1)};
    const double square = z * z;
    double sum = 0;
    for (size_t i = 0; i < sizeof term / sizeof term[0]; i++)
        sum = sum * square + term[i];
    return z * sum;
}

/* L as a function of z = e^-|y|, by the closed form of legendre_chi_2(z) + legendre_chi_2((1 - z) /
 * (1 + z)). */
static double phase_integral(double z)
{
    const double other = (1 - z) / (1 + z);
    if (z >= 1)
        return 0;
    return other > z ? M_PI * M_PI / 4 - 2 * legendre_chi_2(z)
                     : log(z) * log(other) + 2 * legendre_chi_2(other);
}

static double step_phase(double omega, double edge)
{
    return omega > edge ? phase_integral(edge / omega) : -phase_integral(omega / edge);
}

void ratio_slope_eval(const wt_ratio_slope *slope, double omega, double *log_ratio, double *phase)
{
    const double clamped = fmin(fmax(omega, slope->low), slope->high);
    *log_ratio = *phase = 0;
    if (slope->exponent == 0)
        return;
    *log_ratio = slope->exponent * log(clamped / slope->reference);
    *phase =
        slope->exponent / M_PI * (step_phase(omega, slope->low) - step_phase(omega, slope->high));
}

bool layer_has_moduli(const wt_layer_state *layer)
{
    return layer->thickness > 0 && layer->slope.exponent != 0;
}

wt_status layer_slope_shift(const wt_shift_law *law, double to, wt_ratio_slope *slope,
                            wt_error *err)
{
    const double same_temperature = 1; /* largest temperature difference without a shift law [K] */
    const double from = slope->temperature;
    if (isnan(from) || slope->exponent == 0 || from == to)
        return WT_OK;
    if (isnan(to)) {
        wt_fail(err, WT_E_MISSING,
                "the modulus ratio holds at one temperature, and the temperature of the rubber "
                "is not known");
        wt_error_advice(err, "give --reference-temperature");
        wt_error_options(err, "reference-temperature");
        return WT_E_MISSING;
    }
    const double log_a = wt_shift_law_log_a(law, from) - wt_shift_law_log_a(law, to);
    if (isnan(log_a) && fabs(from - to) <= same_temperature)
        return WT_OK;
    if (isnan(log_a)) {
        wt_fail(err, WT_E_MISSING,
                "the modulus ratio holds at another temperature than that "
                "of the rubber");
        wt_error_found(err, "%.4g K and %.4g K", from, to);
        wt_error_advice(err, "give a material whose shift law reaches from one to the other");
        return WT_E_MISSING;
    }
    const double a = exp(M_LN10 * log_a);
    slope->reference *= a;
    slope->low *= a;
    slope->high *= a;
    return WT_OK;
}

/* theta is a fraction 1 / (1 + e^-p) of a part, p = t + e^t - 1. It rises as e^t from the start,
 * which covers many decades of frequency, and converges to the end double-exponentially. */
static void create_angle_rule(layer_moduli *m, double tolerance)
{
    size_t k = 0;
    while (tolerance < rules[k].tolerance)
        k++;
    const double step = rules[k].step, begin = rules[k].begin;
    for (double t = begin; t < rule_end; t = begin + step * (double)m->n) {
        const double p = t + exp(t) - 1, fraction = 1 / (1 + exp(-p));
        m->fraction[m->n] = fraction;
        m->share[m->n++] = step * (1 + exp(t)) * fraction / (1 + exp(p));
    }
    for (size_t level = 0; level < ANGLE_LEVELS; level++) {
        const double wide = ldexp(step, (int)level);
        m->below[level] = m->fraction[0] * wide / expm1(wide);
    }
}

/* Loss angle of the layer's modulus, before a negative loss modulus is set to 0. */
static double loss_angle(double log_omega, void *user)
{
    const layer_moduli *m = user;
    const double omega = exp(log_omega);
    double storage, loss, log_ratio, phase;
    m->bulk->law->modulus(m->bulk, &omega, 1, &storage, &loss);
    ratio_slope_eval(&m->layer.slope, omega, &log_ratio, &phase);
    return atan2(loss, storage) + phase;
}

/* Adds the edges of the ranges with zero loss modulus. Beyond the measured range the phase of a
 * ratio falls with the frequency, and the loss angle of a rubber hardly changes. Six decades
 * further, the loss angle is always the larger. */
static void add_zero_loss_edges(layer_moduli *m)
{
    const double beyond = 6 * M_LN10,
                 step = M_LN10 / 8; /* the loss angle of a rubber changes over decades */
    const double low = log(m->layer.slope.low) - beyond, high = log(m->layer.slope.high) + beyond;
    double before = loss_angle(low, m), root;
    for (double from = low; from < high && m->n_edges < LAYER_MAX_EDGES; from += step) {
        const double now = loss_angle(from + step, m);
        if ((before > 0) != (now > 0) &&
            root_find(loss_angle, m, from, from + step, 0, &root, NULL) == WT_OK)
            m->edges[m->n_edges++] = exp(root);
        before = now;
    }
    numbers_sort(m->edges, m->n_edges);
}

layer_moduli layer_moduli_create(const wt_material *bulk, wt_layer_state layer, double tolerance)
{
    layer_moduli m = {.bulk = bulk, .layer = layer};
    size_t n_breaks = 0;
    m.edges[m.n_edges++] = layer.slope.low;
    m.edges[m.n_edges++] = layer.slope.high;
    if (layer.slope.exponent < 0)
        add_zero_loss_edges(&m);
    if (bulk->law->breaks != NULL)
        (void)bulk->law->breaks(bulk, &n_breaks);
    m.knots = n_breaks > 0;
    create_angle_rule(&m, tolerance);
    return m;
}

/* ---- moduli ---------------------------------------------------------------------------------- */

/* Complex moduli of bulk and layer. A negative loss modulus is set to 0, because a rubber cannot
 * return more energy than it received. */
static void evaluate_moduli(const layer_moduli *m, const double *omega, size_t n,
                            double complex *bulk, double complex *layer)
{
    double storage[ANGLE_NODES], loss[ANGLE_NODES];
    m->bulk->law->modulus(m->bulk, omega, n, storage, loss);
    for (size_t i = 0; i < n; i++)
        bulk[i] = storage[i] + unit * loss[i];
    for (size_t i = 0; i < n; i++) {
        double log_ratio, phase;
        ratio_slope_eval(&m->layer.slope, omega[i], &log_ratio, &phase);
        const double ratio = m->layer.modulus_ratio * exp(log_ratio);
        const double complex turned = bulk[i] * (ratio * cos(phase) + unit * (ratio * sin(phase)));
        layer[i] = creal(turned) + unit * fmax(cimag(turned), 0);
    }
}

double layer_moduli_ratio(const layer_moduli *m, double omega)
{
    double complex bulk, layer;
    evaluate_moduli(m, &omega, 1, &bulk, &layer);
    return cabs(layer) / cabs(bulk);
}

bool layer_moduli_zero_loss_range(const layer_moduli *m, double low, double high, double range[2])
{
    enum { STEPS = 200 }; /* about ten in a decade */
    bool any = false;
    for (size_t i = 0; i <= STEPS; i++) {
        const double omega = low * pow(high / low, (double)i / STEPS);
        double complex bulk, layer;
        evaluate_moduli(m, &omega, 1, &bulk, &layer);
        if (cimag(layer) > 0 || !(cimag(bulk) > 0))
            continue;
        if (!any)
            range[0] = omega;
        range[1] = omega;
        any = true;
    }
    return any;
}

/* ---- wave ------------------------------------------------------------------------------------ */

/* Functions of x = q thickness in the stiffness of layered_scale (persson_contact.c), for the
 * moduli at all angles. That function uses sums of positive terms for real ratios; the same sums
 * hold for complex ratios. */
typedef struct layered_wave {
    double x, e, root_e;     /* e^-2x, e^-x */
    double excess, excess_2; /* of x and of 2 x */
    double expm1_2, expm1_4;
} layered_wave;

static layered_wave layered_wave_create(double x)
{
    return (layered_wave){.x = x,
                          .e = exp(-2 * x),
                          .root_e = exp(-x),
                          .excess = sinh_excess(x),
                          .excess_2 = sinh_excess(2 * x),
                          .expm1_2 = expm1(-2 * x),
                          .expm1_4 = expm1(-4 * x)};
}

/* E_eff / E_layer for ratio = E_layer / E_bulk. */
static double complex layered_stiffness(const layered_wave *w, double complex ratio)
{
    const double x = w->x, e = w->e;
    const double complex sum = 1 / (1 + ratio);
    if (creal(ratio * conj(ratio)) < 1) {
        const double complex c = (1 - ratio) * sum, rest = 2 * ratio * sum;
        return ((1 + c * e) * (1 + c * e) + 4 * c * x * x * e) /
               (rest * (1 + c * e * e) + 2 * c * w->excess_2);
    }
    const double complex c = (ratio - 1) * sum, rest = 2 * sum, m = csqrt(c);
    const double complex low = rest / (1 + m) * (1 + m * e) + 2 * m * w->excess;
    const double complex high = rest - c * w->expm1_2 + 2 * x * m * w->root_e;
    return low * high / ((1 + c) * rest - c * c * w->expm1_4 + 4 * c * x * e);
}

/* ---- angle ----------------------------------------------------------------------------------- */

/* J1, J2 and the integral of the squared loss modulus, by all nodes and by every second one. */
typedef struct angle_sums {
    double j1[ANGLE_LEVELS], j2[ANGLE_LEVELS], loss[ANGLE_LEVELS];
} angle_sums;

static void add_angle_part(const layer_moduli *m, const layered_wave *wave, double omega,
                           double from, double to, angle_sums *sums)
{
    double sine[ANGLE_NODES], at[ANGLE_NODES] = {0};
    double complex bulk[ANGLE_NODES], layer[ANGLE_NODES];
    for (size_t i = 0; i < m->n; i++) {
        sine[i] = sin(from + (to - from) * m->fraction[i]);
        at[i] = omega * sine[i];
    }
    evaluate_moduli(m, at, m->n, bulk, layer);
    for (size_t i = 0; i < m->n; i++) {
        const double complex e = layer[i] * layered_stiffness(wave, layer[i] / bulk[i]);
        const double width = 4 * (to - from);
        const double loss = cimag(e), storage = creal(e);
        for (size_t k = 0, every = 1; k < ANGLE_LEVELS && i % every == 0; k++, every *= 2) {
            const double by = width * (m->share[i] * (double)every + (i == 0 ? m->below[k] : 0));
            sums->j1[k] += by * sine[i] * loss;
            sums->j2[k] += by * (storage * storage + loss * loss);
            sums->loss[k] += by * loss * loss;
        }
    }
}

/* Half as many nodes leave the square root of the error of all nodes; if a material has knots, a
 * fraction of it. */
static double angle_error(const layer_moduli *m, const double sum[ANGLE_LEVELS])
{
    const double room = 10;
    const double fewer = fabs(sum[0] - sum[1]) / sum[0];
    if (!(sum[0] > 0))
        return 0;
    return (m->knots ? fewer : fmin(fewer, room * fewer * fewer)) + 8 * DBL_EPSILON;
}

static angle_sums integrate_quarter_turn(const layer_moduli *m, double q, double omega)
{
    const layered_wave wave = layered_wave_create(q * m->layer.thickness);
    angle_sums sums = {{0}, {0}, {0}};
    double from = 0;
    for (size_t k = 0; k < m->n_edges; k++)
        if (m->edges[k] < omega) {
            const double to = asin(m->edges[k] / omega);
            add_angle_part(m, &wave, omega, from, to, &sums);
            from = to;
        }
    add_angle_part(m, &wave, omega, from, M_PI_2, &sums);
    return sums;
}

void layer_moduli_eval(const layer_moduli *m, const double *q, const double *omega, size_t n,
                       double *j1, double *j2, double *loss_j2, double *error)
{
    for (size_t i = 0; i < n; i++) {
        const angle_sums sums = integrate_quarter_turn(m, q[i], omega[i]);
        j1[i] = sums.j1[0];
        j2[i] = sums.j2[0];
        *error = fmax(*error, fmax(angle_error(m, sums.j1), angle_error(m, sums.j2)));
        if (loss_j2 != NULL)
            loss_j2[i] = sums.loss[0];
    }
}

/* ---- moduli of a workspace ------------------------------------------------------------------- */

void friction_moduli(const wt_friction_workspace *ws, const double *q, const double *omega,
                     const double *x, size_t n, double *j1, double *j2, double *loss_j1,
                     double *loss_j2, double *error)
{
    if (ws->layer != NULL) {
        layer_moduli_eval(ws->layer, q, omega, n, j1, j2, ws->loss != NULL ? loss_j2 : NULL, error);
        return;
    }
    angular_eval(ws->angular, omega, x, n, j1, j2);
    if (ws->loss != NULL)
        angular_eval(ws->loss, omega, x, n, loss_j1, loss_j2);
}

/* |d ln J| over n nodes. */
static double steepness(const double *j, size_t n)
{
    const double ratio = j[0] > 0 && j[n - 1] > 0 ? j[n - 1] / j[0] : 1;
    const double few = 8; /* below this ratio |sinh ln| is at most twice |ln| */
    return ratio < few && ratio > 1 / few ? 0.5 * fabs(ratio - 1 / ratio) : fabs(log(ratio));
}

static double series_error(const wt_friction_workspace *ws, double own_error, double low,
                           double high, friction_pass *pass)
{
    if (ws->layer != NULL)
        return own_error * (ws->softening != NULL ? 2 * ws->softening->cancellation : 1);
    if (ws->flash != NULL) /* frequencies need not rise from one subinterval to the next */
        pass->piece = pass->loss_piece = 0;
    const double error = angular_error(ws->angular, fmin(low, high), fmax(low, high), &pass->piece);
    return ws->softening == NULL ? error
                                 : ws->softening->cancellation *
                                       (error + angular_error(ws->loss, fmin(low, high),
                                                              fmax(low, high), &pass->loss_piece));
}

void friction_add_input_errors(const wt_friction_workspace *ws, double own_error,
                               const grid_subinterval *subinterval, const double *x,
                               const double *j1, const double *j2, size_t n, double log_lowest,
                               double variance, double hysteresis, double variance_so_far,
                               friction_pass *pass)
{
    const bool closed = ws->layer == NULL &&
                        angular_uses_closed_form(ws->angular, x[0], x[n - 1]) &&
                        (ws->loss == NULL || angular_uses_closed_form(ws->loss, x[0], x[n - 1]));
    /* ln omega is a sum of two terms */
    const double far = fmax(fabs(x[0]), fabs(x[n - 1])) + fabs(log_lowest);
    const double moved = closed ? 0 : 4 * DBL_EPSILON * (1 + far);
    const double series = closed ? 0 : series_error(ws, own_error, x[0], x[n - 1], pass);
    const double steepest_closed = 2; /* largest slope of a term of a Prony series */
    const double nodes =
        DBL_EPSILON * (1 + subinterval->t_high) * (fabs(subinterval->power) + steepest_closed + 1);
    pass->variance_input_error +=
        variance * (nodes + series + (closed ? 0 : moved * steepness(j2, n)));
    pass->hysteresis_input_error +=
        hysteresis * (nodes + series + (closed ? 0 : moved * steepness(j1, n)));
    if (variance_so_far > 0)
        pass->hysteresis_input_error +=
            hysteresis * FRICTION_AREA_POWER * (pass->variance_input_error / variance_so_far);
}

void node_contributions_add(node_contributions *list, const double *q, const double *mu, size_t n)
{
    if (list->n + n > list->capacity) {
        list->capacity = 2 * list->capacity + 8 * GAUSS_NODES_MAX;
        list->q = wt_realloc(list->q, list->capacity, sizeof *list->q);
        list->mu = wt_realloc(list->mu, list->capacity, sizeof *list->mu);
    }
    memcpy(list->q + list->n, q, n * sizeof *q);
    memcpy(list->mu + list->n, mu, n * sizeof *mu);
    list->n += n;
}
