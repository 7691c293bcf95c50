/* Shift factors and master curve of a sweep: neighbour by neighbour from the reference outwards,
 * then all isotherms together, then the move to the reference temperature asked for.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/shift.h"

#include "base/param.h"
#include "fit/shift_master.h"
#include "fit/wlf_fit.h"

#include <math.h>
#include <string.h>

/* An isotherm this close to the reference temperature is the reference [K]: what thermometers and
 * chambers agree to. */
static const double same_temperature = 0.1;
/* A shift with a larger error is not determined; nor is one tied to the vertical shift (a larger
 * correlation) on so small a slope that a vertical error moves it by more than that. */
static const double largest_sigma = 0.2; /* decade */
static const double largest_correlation = 0.95;

/* Share of noise in the squared slopes of a curve above which it has none to be shifted by. */
static const double most_slope_noise = 0.3;
/* What a vertical shift is off by through sample geometry and clamping [decade], 5 %. */
static const double vertical_error = 0.02;

enum { NEIGHBOURS = 3 };

wt_shift_options wt_shift_defaults(void)
{
    return (wt_shift_options){.reference_temperature = (double)NAN,
                              .vertical = WT_VERTICAL_FREE,
                              .expansion = 0.0,
                              .floor = 0.02};
}

static const wt_param rows[] = {
    {PARAM("reference-temperature", wt_shift_options, reference_temperature, WT_Q_TEMPERATURE,
           ABOVE(0)),
     .value = "T", .unset = "the isotherm in the middle",
     .help = "reference temperature, such as 20degC; it need not be one of the isotherms"},
    {PARAM_CHOICE_OF("vertical-shift", wt_shift_options, vertical, "none|physical|free"),
     .help = "vertical shift: none, as rubber elasticity says (Tref/T, with the thermal expansion "
             "of the density), or fitted"},
    {PARAM("expansion", wt_shift_options, expansion, WT_Q_NONE, FROM_TO(0, 0.01)), .value = "X",
     .help = "volumetric thermal expansion in 1/K for the vertical shift physical; that of rubber "
             "is about 7e-4"},
    {PARAM("floor", wt_shift_options, floor, WT_Q_NONE, ABOVE(0)), .flags = PARAM_ONLY_C,
     .help = "model error of a shift for the WLF fit in decades"},
};
PARAM_TABLE(wt_shift_params, wt_shift_options, rows, wt_shift_defaults, NO_PARTS)

/* log10 of rho0 T0 / (rho T), density from a constant expansion coefficient. */
static double physical_shift(const shift_work *work, double temperature)
{
    const double t0 = work->reference_temperature;
    return log10(t0 / temperature) + work->options.expansion * (temperature - t0) / M_LN10;
}

/* The isotherm to start from: nearest to the reference temperature, or the one in the middle. */
static wt_status choose_anchor(shift_work *work, wt_error *err)
{
    const shift_set *set = &work->set;
    size_t best = set->n;
    double nearest = HUGE_VAL;
    for (size_t i = 0; i < set->n; i++) {
        const double away =
            isnan(work->options.reference_temperature)
                ? fabs((double)i - 0.5 * (double)(set->n - 1))
                : fabs(set->curves[i].temperature - work->options.reference_temperature);
        if (set->curves[i].n >= SHIFT_MIN_POINTS && away < nearest) {
            nearest = away;
            best = i;
        }
    }
    if (best == set->n) {
        wt_status status = wt_fail(err, WT_E_MISSING, "no isotherm has enough points");
        wt_error_expected(err, "at least %d points each", SHIFT_MIN_POINTS);
        return status;
    }
    const double at = set->curves[best].temperature;
    work->anchor = best;
    work->reference_temperature =
        isnan(work->options.reference_temperature) ? at : work->options.reference_temperature;
    work->measured_reference = fabs(at - work->reference_temperature) <= same_temperature;
    return WT_OK;
}

/* Places curve i on one of the placed curves towards the anchor: the next one, or one behind it if
 * that is not to be had. */
static wt_status place(shift_work *work, size_t i, long inwards, wt_error *err)
{
    const bool free_b = work->options.vertical == WT_VERTICAL_FREE;
    int tried = 0;
    for (long p = (long)i + inwards; tried < NEIGHBOURS; p += inwards) {
        if (work->placed[p]) {
            shift_pair pair;
            wt_status status = shift_pair_fit(&work->set.curves[p], &work->set.curves[i], free_b,
                                              work->b[i] - work->b[p], &pair, err);
            if (status != WT_OK)
                return status;
            if (tried++ == 0)
                for (int q = 0; q < MODULI; q++)
                    work->overlap[q][i] = pair.overlap[q];
            if (pair.found) {
                work->a[i] = work->a[p] + pair.a;
                if (free_b)
                    work->b[i] = work->b[p] + pair.b;
                work->placed[i] = true;
                return WT_OK;
            }
        }
        if ((size_t)p == work->anchor)
            break;
    }
    return WT_OK;
}

static wt_status place_all(shift_work *work, wt_error *err)
{
    wt_status status = WT_OK;
    size_t n_placed = 0, n_flat = 0;
    for (size_t i = 0; i < work->set.n; i++) {
        work->placed[i] = false;
        work->a[i] = 0.0;
        work->b[i] = work->options.vertical == WT_VERTICAL_PHYSICAL
                         ? physical_shift(work, work->set.curves[i].temperature)
                         : 0.0;
    }
    work->placed[work->anchor] = true;
    for (size_t i = work->anchor + 1; i < work->set.n && status == WT_OK; i++)
        status = work->flat[i] ? WT_OK : place(work, i, -1, err);
    for (size_t i = work->anchor; i-- > 0 && status == WT_OK;)
        status = work->flat[i] ? WT_OK : place(work, i, 1, err);
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < work->set.n; i++) {
        n_placed += work->placed[i] ? 1 : 0;
        n_flat += work->flat[i] ? 1 : 0;
    }
    if (n_placed > 1)
        return WT_OK;
    if (n_flat > 0) {
        status = wt_fail(err, WT_E_NO_OVERLAP, "the isotherms are flat: no slope to shift them by");
        wt_error_expected(err, "a storage or loss modulus that changes with frequency by more "
                               "than its noise");
        wt_error_advice(err, "measure colder, into the transition");
    } else {
        status = wt_fail(err, WT_E_NO_OVERLAP, "no isotherm overlaps the one of %.2f °C",
                         work->set.curves[work->anchor].temperature - WT_ZERO_CELSIUS);
        wt_error_expected(err, "neighbouring isotherms that share a range of storage modulus");
        wt_error_advice(err, "measure at smaller steps of temperature or over more frequencies");
    }
    return status;
}

/* Takes out the curves whose slopes are mostly noise: a fit can slide noise over noise and find a
 * best place for it. Returns whether there were any. */
static bool take_out_flat(shift_work *work)
{
    bool found = false;
    for (size_t i = 0; i < work->set.n; i++)
        if (work->placed[i] && i != work->anchor && !(work->slope_noise[i] <= most_slope_noise)) {
            work->flat[i] = true;
            found = true;
        }
    return found;
}

/* All isotherms that can be placed, in one fit; a flat one is no bridge for those behind it, so
 * without it they are placed anew. */
static wt_status fit_together(shift_work *work, wt_error *err)
{
    shift_joint joint = {.set = &work->set,
                         .placed = work->placed,
                         .anchor = work->anchor,
                         .use = {true, true},
                         .free_b = work->options.vertical == WT_VERTICAL_FREE,
                         .a = work->a,
                         .b = work->b,
                         .covariance_ab = work->covariance_ab,
                         .sigma_b = work->sigma_b,
                         .correlation = work->correlation,
                         .slope_noise = work->slope_noise,
                         .n_outliers = work->n_outliers};
    wt_status status;
    do {
        status = place_all(work, err);
        if (status == WT_OK)
            status = shift_joint_fit(&joint, err);
    } while (status == WT_OK && take_out_flat(work));
    if (status == WT_OK)
        status = shift_superposition(&joint, work->options.floor, &work->superposition, err);
    for (size_t i = 0; i < work->set.n; i++)
        memcpy(work->covariance + i * work->set.n, work->covariance_ab + i * 2 * work->set.n,
               work->set.n * sizeof *work->covariance);
    for (int q = 0; q < MODULI; q++)
        work->rms[q] = joint.rms[q];
    work->last_step = joint.last_step;
    return status;
}

/* Which shifts are good for anything; the anchor is one by definition. */
static void judge(shift_work *work)
{
    const size_t n = work->set.n;
    for (size_t i = 0; i < n; i++) {
        const double sigma = sqrt(work->covariance[i * n + i]);
        work->verdict[i] = SHIFT_GOOD;
        if (work->set.curves[i].n < SHIFT_MIN_POINTS)
            work->verdict[i] = SHIFT_TOO_SHORT;
        else if (work->flat[i])
            work->verdict[i] = SHIFT_FLAT;
        else if (!work->placed[i])
            work->verdict[i] = SHIFT_NO_OVERLAP;
        else if (i == work->anchor)
            continue;
        else if (!(sigma <= largest_sigma))
            work->verdict[i] = SHIFT_NO_SLOPE;
        else if (fabs(work->correlation[i]) > largest_correlation) {
            /* Along the valley of equally good fits a changes by this much per decade of b. */
            const double tie = fabs(work->correlation[i]) * sigma / work->sigma_b[i];
            work->tied[i] = vertical_error * tie;
            if (!(work->tied[i] <= largest_sigma))
                work->verdict[i] = SHIFT_COLLINEAR;
        }
    }
}

/* Good isotherms on either side of the reference temperature; set->n if there is none. */
static void bracket(const shift_work *work, size_t *below, size_t *above)
{
    *below = *above = work->set.n;
    for (size_t i = 0; i < work->set.n; i++) {
        if (work->verdict[i] != SHIFT_GOOD)
            continue;
        if (work->set.curves[i].temperature <= work->reference_temperature)
            *below = i;
        else if (*above == work->set.n)
            *above = i;
    }
}

static wt_status out_of_range(const shift_work *work, wt_error *err)
{
    wt_status status =
        wt_fail(err, WT_E_RANGE, "no shift can be given for the reference temperature %.2f °C",
                work->reference_temperature - WT_ZERO_CELSIUS);
    wt_error_expected(err, "a temperature between the isotherms that could be shifted");
    wt_error_advice(err, "choose one of the measured temperatures");
    return status;
}

/* Variance of log aT that the law gives for a temperature, from the errors of its constants. */
static double variance_of_law(const wt_wlf_fit *fit, double temperature)
{
    const double rise = temperature - fit->wlf.reference_temperature;
    const double by_c1 = -rise / (fit->wlf.c2 + rise);
    const double by_c2 = -by_c1 * fit->wlf.c1 / (fit->wlf.c2 + rise);
    if (fit->straight)
        return rise * rise * fit->slope_error * fit->slope_error;
    const double s1 = by_c1 * fit->c1_error, s2 = by_c2 * fit->c2_error;
    return s1 * s1 + s2 * s2 + 2.0 * fit->correlation * s1 * s2;
}

/* Value of the law at the reference temperature, relative to the anchor, with the weight of each
 * isotherm in it: WLF for the shape, the two neighbours' residuals from it for the place. */
static wt_status offset_of_reference(shift_work *work, double *offset, double *weight,
                                     double *law_variance, wt_error *err)
{
    const size_t n = work->set.n;
    double *temperature = work->scratch, *log_a = temperature + n, *covariance = log_a + n;
    size_t below, above, m = 0;
    wt_wlf_fit fit;

    bracket(work, &below, &above);
    const bool inside = below < n && above < n;
    for (size_t i = 0; i < n; i++) {
        if (work->verdict[i] != SHIFT_GOOD)
            continue;
        size_t column = 0;
        for (size_t k = 0; k < n; k++)
            if (work->verdict[k] == SHIFT_GOOD)
                covariance[m * work->n_good + column++] = work->covariance[i * n + k];
        temperature[m] = work->set.curves[i].temperature;
        log_a[m++] = work->a[i];
    }
    const bool law = wlf_fit_arrays(temperature, log_a, covariance, m, work->reference_temperature,
                                    work->options.floor, &fit, NULL) == WT_OK;
    if (!inside && !law)
        return out_of_range(work, err);
    *law_variance = 0.0;
    if (!inside) {
        const size_t end = below < n ? below : above;
        weight[end] = 1.0;
        work->extrapolated = true;
        *law_variance = variance_of_law(&fit, work->set.curves[end].temperature);
        if (!(sqrt(*law_variance) <= largest_sigma))
            return out_of_range(work, err);
    } else {
        const double t0 = work->set.curves[below].temperature;
        const double t1 = work->set.curves[above].temperature;
        weight[above] = (work->reference_temperature - t0) / (t1 - t0);
        weight[below] = 1.0 - weight[above];
    }
    *offset = 0.0;
    for (size_t i = 0; i < n; i++)
        if (weight[i] > 0.0)
            *offset += weight[i] *
                       (work->a[i] -
                        (law ? wt_wlf_log_shift(&fit.wlf, work->set.curves[i].temperature) : 0.0));
    return isfinite(*offset) ? WT_OK : out_of_range(work, err);
}

/* The same for the covariance of all shifts: each block loses its own weighted mean, `a` gains the
 * variance of the law. `mean` is scratch of 2n. */
static void move_covariance(shift_work *work, const double *weight, double law_variance,
                            double *mean)
{
    const size_t n = work->set.n;
    const bool moved[2] = {true, work->options.vertical == WT_VERTICAL_FREE};
    for (size_t row = 0; row < 2; row++)
        for (size_t column = 0; column < 2; column++) {
            double *block = work->covariance_ab + row * n * 2 * n + column * n;
            double *by_row = mean, *by_column = mean + n, both = 0.0;
            for (size_t i = 0; i < n; i++) {
                by_row[i] = by_column[i] = 0.0;
                for (size_t k = 0; k < n; k++) {
                    by_row[i] += moved[column] ? weight[k] * block[i * 2 * n + k] : 0.0;
                    by_column[i] += moved[row] ? weight[k] * block[k * 2 * n + i] : 0.0;
                }
            }
            for (size_t i = 0; i < n; i++)
                both += moved[row] ? weight[i] * by_row[i] : 0.0;
            for (size_t i = 0; i < n; i++)
                for (size_t k = 0; k < n; k++)
                    block[i * 2 * n + k] += both - by_row[i] - by_column[k] +
                                            (row == 0 && column == 0 ? law_variance : 0.0);
        }
}

/* Makes the shifts relative to a reference temperature that was not measured: a, b, covariance. */
static wt_status move_reference(shift_work *work, wt_error *err)
{
    const size_t n = work->set.n;
    double offset = (double)NAN, law_variance = 0.0, offset_b = 0.0, variance = 0.0;
    double *weight = pool_numbers(&work->memory, 4 * n);
    if (weight == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the reference temperature");
    double *shared = weight + n; /* covariance of a curve with the offset */
    wt_status status = offset_of_reference(work, &offset, weight, &law_variance, err);
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < n; k++)
            shared[i] += weight[k] * work->covariance[i * n + k];
    for (size_t i = 0; i < n; i++)
        variance += weight[i] * shared[i];
    variance += law_variance;
    move_covariance(work, weight, law_variance, weight + 2 * n);
    for (size_t i = 0; i < n; i++) {
        const double *of_a = work->covariance_ab + i * 2 * n;
        const double *of_b = work->covariance_ab + (n + i) * 2 * n;
        work->sigma_b[i] = sqrt(fmax(of_b[n + i], 0.0));
        work->correlation[i] = of_a[i] > 0.0 && work->sigma_b[i] > 0.0
                                   ? of_a[n + i] / (sqrt(of_a[i]) * work->sigma_b[i])
                                   : 0.0;
        work->a[i] -= offset;
        for (size_t k = 0; k < n; k++)
            work->covariance[i * n + k] += variance - shared[i] - shared[k];
        /* Between isotherms b follows its neighbours, beyond them rho T. */
        if (work->options.vertical == WT_VERTICAL_FREE && weight[i] > 0.0)
            offset_b += weight[i] *
                        (work->b[i] - (work->extrapolated
                                           ? physical_shift(work, work->set.curves[i].temperature)
                                           : 0.0));
    }
    for (size_t i = 0; i < n; i++)
        work->b[i] -= offset_b;
    return WT_OK;
}

static wt_status work_alloc(shift_work *work, wt_error *err)
{
    const size_t n = work->set.n;
    pool *memory = &work->memory;
    double **const by_isotherm[] = {&work->a,
                                    &work->b,
                                    &work->sigma_b,
                                    &work->correlation,
                                    &work->physical,
                                    &work->tied,
                                    &work->slope_noise,
                                    &work->overlap[STORAGE],
                                    &work->overlap[LOSS]};
    for (size_t i = 0; i < sizeof by_isotherm / sizeof *by_isotherm; i++)
        *by_isotherm[i] = pool_numbers(memory, n);
    work->covariance = pool_numbers(memory, n * n);
    work->scratch = pool_numbers(memory, n * n + 2 * n);
    work->covariance_ab = pool_numbers(memory, 4 * n * n);
    work->placed = pool_alloc(memory, n, sizeof *work->placed);
    work->verdict = pool_alloc(memory, n, sizeof *work->verdict);
    work->n_outliers = pool_alloc(memory, n, sizeof *work->n_outliers);
    work->flat = pool_alloc(memory, n, sizeof *work->flat);
    return memory->failed ? wt_fail(err, WT_E_MEMORY, "no memory for %zu isotherms", n) : WT_OK;
}

wt_status wt_shift_fit(const wt_sweep *sweep, const wt_shift_options *options, wt_parselog *log,
                       wt_master_curve *master, wt_error *err)
{
    shift_work work = {.options = options != NULL ? *options : wt_shift_defaults()};
    wt_status status = param_check(wt_shift_params(), &work.options, err);

    if (status == WT_OK)
        status = shift_set_new(sweep, log, &work.memory, &work.set, err);
    if (status == WT_OK)
        status = work_alloc(&work, err);
    if (status == WT_OK)
        status = choose_anchor(&work, err);
    if (status == WT_OK)
        status = fit_together(&work, err);
    if (status != WT_OK)
        goto done;
    judge(&work);
    for (size_t i = 0; i < work.set.n; i++) {
        work.n_good += work.verdict[i] == SHIFT_GOOD ? 1 : 0;
        work.physical[i] = physical_shift(&work, work.set.curves[i].temperature);
    }
    if (!work.measured_reference)
        status = move_reference(&work, err);
    if (status == WT_OK)
        status = shift_master_new(sweep, &work, log, master, err);
done:
    pool_free(&work.memory);
    return status;
}
