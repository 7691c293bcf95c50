/* Isotherms that do not belong to the others: one that the spectrum of the others does not
 * describe, and one whose frequencies have another unit. They are left out and named.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/base/clocale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Minimum number of isotherms that remain. With three, any one of them may be the wrong one. */
enum { LEAST_LEFT = 4 };
/* The misfit without the isotherm must fall below this share of that without any other one. If two
 * isotherms are equally suspect, none is named. */
static const double clear_share = 0.5;
/* Number of isotherms that are left out in turn: those with the largest misfit. One wrong isotherm
 * moves its neighbours, so the largest misfit may be theirs. It only limits the time. */
enum { MOST_TRIALS = 6 };

/* ---- an isotherm that objects to the spectrum ------------------------------------------------ */

/* Largest shift from the expected position, and step of the search [decade]. */
static const double search_range = 1.5, search_step = 0.01;
/* A smaller mean deviation of E'' is not named as the cause [ln]. */
static const double named_deviation = 0.03;

/* Returns the rms deviation of a curve from the spectrum with the shift a, ln b [ln]. mean: of each
 * modulus. */
static double curve_deviation(const spectrum *s, const double *term, const shift_curve *c, double a,
                              double b, double mean[MODULI])
{
    double square = 0.0;
    mean[STORAGE] = mean[LOSS] = 0.0;
    for (size_t k = 0; k < c->n; k++) {
        double modulus[MODULI], slope[MODULI];
        spectrum_measured_moduli(s, term, (c->x[k] + a) * M_LN10, modulus, slope, NULL);
        for (int q = 0; q < MODULI; q++) {
            const double off = s->used[q] ? c->y[q][k] * M_LN10 + b - modulus[q] : 0.0;
            square += off * off / (double)c->n;
            mean[q] += off / (double)c->n;
        }
    }
    return sqrt(square);
}

/* Orders the placed isotherms by their misfit. Returns their number, at most MOST_TRIALS. */
static size_t find_suspects(const master_work *work, size_t suspect[MOST_TRIALS])
{
    const spectrum *s = work->s;
    double worst[MOST_TRIALS], mean[MODULI];
    size_t n = 0;
    double *term = wt_alloc(s->n_linear, sizeof *term);
    spectrum_terms(s, s->value, term);
    for (size_t i = 0; i < work->set.n; i++) {
        if (!work->placed[i])
            continue;
        const double off =
            curve_deviation(s, term, &work->set.curves[i], spectrum_a(s, work->curve[i]) / M_LN10,
                            spectrum_b(s, work->curve[i]), mean);
        size_t k = n < MOST_TRIALS ? n++ : MOST_TRIALS;
        for (; k > 0 && off > worst[k - 1]; k--)
            if (k < MOST_TRIALS) {
                worst[k] = worst[k - 1];
                suspect[k] = suspect[k - 1];
            }
        if (k < MOST_TRIALS) {
            worst[k] = off;
            suspect[k] = i;
        }
    }
    free(term);
    return n;
}

/* Error of the level of E' [decade]: half width of its prior (master_route.c). */
static const double level_error = 0.01;

/* Finds the shift of an isotherm at which its E' deviates least from the spectrum of the others,
 * and describes by how much it deviates there. */
static void describe_deviation(const master_work *others, size_t i, shift_curve *found)
{
    const spectrum *s = others->s;
    const shift_curve *curves = others->set.curves, *c = others->whole_curves + i;
    size_t low = i, high = i;
    double *term = wt_alloc(s->n_linear, sizeof *term);
    spectrum_terms(s, s->value, term);
    while (low > 0 && (low == i || !others->placed[low]))
        low--;
    while (high + 1 < others->set.n && (high == i || !others->placed[high]))
        high++;
    if (!others->placed[low])
        low = high;
    if (!others->placed[high])
        high = low;
    const double width = curves[high].temperature - curves[low].temperature;
    const double share = width > 0.0 ? (c->temperature - curves[low].temperature) / width : 0.0;
    const double cold = spectrum_a(s, others->curve[low]) / M_LN10,
                 warm = spectrum_a(s, others->curve[high]) / M_LN10;
    const double expected = cold + share * (warm - cold);
    double least = HUGE_VAL, at[MODULI] = {0.0}, all = 0.0;
    for (double a = -search_range; a <= search_range; a += search_step) {
        double mean[MODULI];
        const double rms =
            curve_deviation(s, term, c, expected + a, others->physical[i] * M_LN10, mean);
        if (fabs(mean[STORAGE]) < least) {
            least = fabs(mean[STORAGE]);
            memcpy(at, mean, sizeof at);
            all = rms;
            found->excluded_a = expected + a;
        }
    }
    free(term);
    found->has_excluded_shift = true;
    found->excluded_error =
        level_error * (c->x[c->n - 1] - c->x[0]) / fabs(c->y[STORAGE][c->n - 1] - c->y[STORAGE][0]);
    if (fabs(at[LOSS]) > named_deviation)
        clocale_print(found->exclusion, sizeof found->exclusion,
                      "left out: its E'' is %+.0f %% off what the others demand",
                      100.0 * expm1(at[LOSS]));
    else
        clocale_print(found->exclusion, sizeof found->exclusion,
                      "left out: it misses the spectrum of the others by %.1f %%", 100.0 * all);
}

bool master_objects(const master_work *work)
{
    return work->is_gross || master_misfit_is_significant(&work->lack) ||
           master_loss_is_inconsistent(&work->lack);
}

/* Fits the others without isotherm i. *misfit: the remaining misfit [ln], HUGE_VAL if one spectrum
 * does not describe them. */
static wt_status try_without(const master_work *whole, size_t i, double *misfit,
                             shift_curve *described, wt_error *err)
{
    master_work work = {
        .options = whole->options, .set = whole->set, .whole_curves = whole->set.curves};
    size_t placed = 0;
    work.options.reference_temperature = whole->reference;
    work.options.series_only = false; /* the test decides */
    work.set.curves = arena_alloc(&work.memory, whole->set.n, sizeof *work.set.curves);
    memcpy(work.set.curves, whole->set.curves, whole->set.n * sizeof *work.set.curves);
    work.set.curves[i].n = 0;
    work.set.n_points -= whole->set.curves[i].n;
    master_work_alloc(&work);
    wt_status status =
        master_choose_anchor(&work, whole->set.curves[whole->anchor].temperature, err);
    if (status == WT_OK)
        status = master_fit_free_shifts(&work, err);
    for (size_t k = 0; k < work.set.n; k++)
        placed += whole->placed[k];
    const bool good =
        status == WT_OK && work.tested && !master_objects(&work) && work.s->n_curves + 1 >= placed;
    *misfit = good ? fmax(work.lack.misfit_high, hypot(work.missed[STORAGE], work.missed[LOSS]))
                   : HUGE_VAL;
    if (good)
        describe_deviation(&work, i, described);
    posterior_free(work.posterior);
    arena_free(&work.memory);
    const bool none = status == WT_E_CONVERGENCE || status == WT_E_RANGE ||
                      status == WT_E_NO_OVERLAP || status == WT_E_MISSING;
    return none ? WT_OK : status;
}

void master_exclude(master_work *work, size_t i)
{
    work->set.n_points -= work->set.curves[i].n;
    work->set.curves[i].n = 0;
}

wt_status master_find_objecting(master_work *work, size_t *found, wt_error *err)
{
    size_t suspect[MOST_TRIALS], n_left = 0;
    double best = HUGE_VAL, second = HUGE_VAL;
    shift_curve chosen = {0};
    wt_status status = WT_OK;
    *found = work->set.n;
    for (size_t i = 0; i < work->set.n; i++)
        n_left += work->placed[i];
    if (n_left <= LEAST_LEFT || work->set.quantity != WT_SHIFT_MODULI)
        return WT_OK;
    const size_t n = find_suspects(work, suspect);
    for (size_t k = 0; status == WT_OK && k < n; k++) {
        double misfit;
        shift_curve described = work->set.curves[suspect[k]];
        status = try_without(work, suspect[k], &misfit, &described, err);
        if (status != WT_OK || !(misfit < second))
            continue;
        second = misfit < best ? best : misfit;
        if (misfit < best) {
            best = misfit;
            *found = suspect[k];
            chosen = described;
        }
    }
    if (*found == work->set.n || !(best < clear_share * second)) {
        *found = work->set.n;
        return status;
    }
    work->set.curves[*found] = chosen;
    return status;
}

/* ---- an isotherm with another unit of frequency ---------------------------------------------- */

/* Tolerance of a shift by 2 pi, and largest deviation of the other isotherms from their neighbours
 * [decade]. */
static const double unit_tolerance = 0.12, smooth_deviation = 0.15;

/* Returns the deviation of the shift of isotherm `list[k]` from the cubic through two isotherms on
 * either side, or the parabola through three at the ends of the list. NaN: no neighbour on one
 * side. */
static double deviation_from_neighbours(const master_work *work, const size_t *list, size_t n,
                                        size_t k)
{
    const size_t first = k >= 2 ? k - 2 : 0, last = k + 2 < n ? k + 2 : n - 1;
    const double t = work->set.curves[list[k]].temperature;
    double expected = 0.0;
    if (k == 0 || k + 1 >= n)
        return (double)NAN;
    for (size_t i = first; i <= last; i++) {
        double weight = 1.0;
        const double ti = work->set.curves[list[i]].temperature;
        for (size_t j = first; j <= last; j++)
            if (j != i && j != k) {
                const double tj = work->set.curves[list[j]].temperature;
                weight *= (t - tj) / (ti - tj);
            }
        if (i != k)
            expected += weight * spectrum_a(work->s, work->curve[list[i]]) / M_LN10;
    }
    return spectrum_a(work->s, work->curve[list[k]]) / M_LN10 - expected;
}

/* Returns the largest deviation of any isotherm but `without` from its neighbours. */
static double largest_deviation(const master_work *work, const size_t *list, size_t n,
                                size_t without, size_t *others)
{
    size_t m = 0;
    double most = 0.0;
    for (size_t k = 0; k < n; k++)
        if (k != without)
            others[m++] = list[k];
    for (size_t k = 1; k + 1 < m; k++) {
        const double off = fabs(deviation_from_neighbours(work, others, m, k));
        most = off <= most ? most : off; /* two isotherms of one temperature have no deviation */
    }
    return most;
}

bool master_find_unit_slip(master_work *work, size_t *found)
{
    const double two_pi = log10(2.0 * M_PI);
    size_t n = 0, *list = wt_alloc(2 * work->set.n, sizeof *list), *others = list + work->set.n;
    double least = smooth_deviation;
    *found = work->set.n;
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i] && !work->set.curves[i].is_shift_fixed)
            list[n++] = i;
    for (size_t k = 1; n > LEAST_LEFT + 1 && k + 1 < n; k++) {
        const double off = deviation_from_neighbours(work, list, n, k);
        if (!(fabs(fabs(off) - two_pi) <= unit_tolerance))
            continue;
        const double rest = largest_deviation(work, list, n, k, others);
        if (!(rest < least))
            continue;
        least = rest;
        *found = list[k];
        clocale_print(work->set.curves[*found].exclusion, sizeof work->set.curves[*found].exclusion,
                      "left out: its frequencies are %.2f decade off, as 2 pi: %s", fabs(off),
                      off < 0.0 ? "rad/s read as Hz" : "Hz read as rad/s");
    }
    free(list);
    return *found < work->set.n;
}
