/* The master curve: all measured points at the reference temperature, and what is odd about it in
 * words. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/shift_master.h"

#include "base/clocale.h"
#include "fit/prony.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* A vertical shift this far from rho0 T0/(rho T) is not rubber elasticity [decade]. */
static const double odd_vertical = 0.1;
/* Strain amplitudes that differ by more than this factor are different points of the Payne curve.
 */
static const double odd_strain = 2.0;
/* Kramers-Kronig misfit that deserves a word. */
static const double odd_kramers_kronig = 0.25;

struct point {
    double x, storage, loss;
    size_t isotherm;
};

static int by_x(const void *left, const void *right)
{
    const struct point *a = left, *b = right;
    if (a->x != b->x)
        return a->x > b->x ? 1 : -1;
    return (a->isotherm > b->isotherm) - (a->isotherm < b->isotherm);
}

static void append(char *text, size_t size, const char *format, ...) WT_PRINTF(3, 4);

/* Adds a remark to a note, parted by "; "; one that is cut ends in "...". */
static void append(char *text, size_t size, const char *format, ...)
{
    size_t length = strlen(text);
    if (length > 0 && length + 3 < size) {
        memcpy(text + length, "; ", 3);
        length += 2;
    }
    va_list arguments;
    va_start(arguments, format);
    const int needed = clocale_vprint(text + length, size - length, format, arguments);
    va_end(arguments);
    if (needed >= 0 && (size_t)needed >= size - length)
        memcpy(text + size - 4, "...", 4);
}

static void note_verdict(const shift_work *work, size_t i, wt_shift *shift)
{
    const double sigma = sqrt(work->covariance[i * work->set.n + i]);
    char *note = shift->note;
    switch (work->verdict[i]) {
    case SHIFT_GOOD:
        break;
    case SHIFT_TOO_SHORT:
        append(note, sizeof shift->note, "only %zu points", work->set.curves[i].n);
        break;
    case SHIFT_NO_OVERLAP:
        append(note, sizeof shift->note, "no overlap with its neighbours");
        break;
    case SHIFT_FLAT:
        append(note, sizeof shift->note,
               "no slope decides: both moduli are flat within their scatter");
        break;
    case SHIFT_NO_SLOPE:
        append(note, sizeof shift->note, "no slope decides: error of log aT %.2g decade", sigma);
        break;
    case SHIFT_COLLINEAR:
        append(note, sizeof shift->note,
               "horizontal and vertical shift not separable: correlation %.3f",
               work->correlation[i]);
        break;
    }
}

static void note_oddities(const shift_work *work, size_t i, wt_shift *shift)
{
    const shift_curve *curve = &work->set.curves[i];
    char *note = shift->note;
    if (shift->determined && work->tied[i] > 0.0)
        append(note, sizeof shift->note,
               "tied to log bT (correlation %.3f): 0.02 of it is %.2f of log aT",
               work->correlation[i], work->tied[i]);
    if (shift->determined && fabs(work->b[i] - work->physical[i]) > odd_vertical &&
        work->options.vertical == WT_VERTICAL_FREE)
        append(note, sizeof shift->note, "log bT %+.3f where rho T gives %+.3f", work->b[i],
               work->physical[i]);
    if (curve->n_left_out > 0)
        append(note, sizeof shift->note, "%zu points without positive modulus left out",
               curve->n_left_out);
    if (work->n_outliers[i] > 0)
        append(note, sizeof shift->note, "%zu points off the curve, given less weight",
               work->n_outliers[i]);
}

/* Two runs at one temperature should get one shift. */
static void note_duplicates(const shift_work *work, wt_master_curve *master)
{
    const size_t n = work->set.n;
    for (size_t i = 1; i < n; i++) {
        wt_shift *shift = &master->shifts[i];
        const wt_shift *before = &master->shifts[i - 1];
        if (!shift->determined || !before->determined ||
            shift->temperature - before->temperature > 0.5)
            continue;
        const double difference = shift->log_a.value - before->log_a.value;
        const double variance = work->covariance[i * n + i] +
                                work->covariance[(i - 1) * n + i - 1] -
                                2.0 * work->covariance[i * n + i - 1];
        const double allowed =
            sqrt(fmax(variance, 0.0) + 2.0 * work->options.floor * work->options.floor);
        if (fabs(difference) > 3.0 * allowed)
            append(shift->note, sizeof shift->note,
                   "log aT differs by %+.3f from the other run at this temperature", difference);
    }
}

/* Largest and smallest median strain amplitude of the isotherms. */
static void note_strain(const wt_sweep *sweep, wt_master_curve *master, wt_parselog *log)
{
    double low = HUGE_VAL, high = 0.0;
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *isotherm = &sweep->isotherms[i];
        double sum = 0.0;
        size_t n = 0;
        for (size_t k = 0; isotherm->strain != NULL && k < isotherm->n; k++)
            if (isotherm->strain[k] > 0.0) {
                sum += log10(isotherm->strain[k]);
                n++;
            }
        if (n > 0) {
            low = fmin(low, pow(10.0, sum / (double)n));
            high = fmax(high, pow(10.0, sum / (double)n));
        }
    }
    if (!(high > odd_strain * low))
        return;
    append(master->note, sizeof master->note, "strain amplitudes from %.2g to %.2g", low, high);
    wt_parselog_add(log, WT_WARNING, NULL, NULL,
                    "isotherms were measured at strain amplitudes from %.2g to %.2g: a filled "
                    "rubber softens with strain, so their shifts mix temperature and strain",
                    low, high);
}

static wt_status fill_shifts(const shift_work *work, wt_master_curve *master, wt_error *err)
{
    const size_t n = work->set.n;
    master->shifts = calloc(n, sizeof *master->shifts);
    master->covariance = calloc(n * n, sizeof *master->covariance);
    master->covariance_ab = calloc(4 * n * n, sizeof *master->covariance_ab);
    if (master->shifts == NULL || master->covariance == NULL || master->covariance_ab == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for %zu shift factors", n);
    master->n_shifts = n;
    for (size_t i = 0; i < n; i++) {
        wt_shift *shift = &master->shifts[i];
        const bool good = work->verdict[i] == SHIFT_GOOD;
        const bool reference = work->measured_reference && i == work->anchor;
        shift->temperature = work->set.curves[i].temperature;
        shift->determined = good;
        shift->log_a = (wt_estimate){(double)NAN, (double)NAN, (double)NAN, "1"};
        shift->log_b = (wt_estimate){(double)NAN, (double)NAN, (double)NAN, "1"};
        shift->correlation = good ? work->correlation[i] : (double)NAN;
        if (good) {
            shift->log_a.value = work->a[i];
            shift->log_a.standard_error = sqrt(fmax(work->covariance[i * n + i], 0.0));
            shift->log_a.numerical_error = reference ? 0.0 : work->last_step;
            shift->log_b.value = work->b[i];
            shift->log_b.standard_error = work->sigma_b[i];
            shift->log_b.numerical_error = 0.0;
        }
        for (size_t k = 0; k < n; k++)
            master->covariance[i * n + k] =
                good && work->verdict[k] == SHIFT_GOOD ? work->covariance[i * n + k] : (double)NAN;
        shift->overlap_storage = work->overlap[STORAGE][i];
        shift->overlap_loss = work->overlap[LOSS][i];
        shift->log_b_physical = work->physical[i];
        note_verdict(work, i, shift);
        note_oddities(work, i, shift);
    }
    for (size_t i = 0; i < 2 * n; i++)
        for (size_t k = 0; k < 2 * n; k++)
            if (work->verdict[i % n] == SHIFT_GOOD && work->verdict[k % n] == SHIFT_GOOD)
                master->covariance_ab[i * 2 * n + k] = work->covariance_ab[i * 2 * n + k];
    note_duplicates(work, master);
    return WT_OK;
}

static wt_status fill_points(const shift_work *work, wt_master_curve *master, wt_error *err)
{
    size_t n = 0;
    for (size_t i = 0; i < work->set.n; i++)
        n += work->verdict[i] == SHIFT_GOOD ? work->set.curves[i].n : 0;
    struct point *points = calloc(n, sizeof *points);
    master->log_frequency = calloc(n, sizeof *master->log_frequency);
    master->log_storage = calloc(n, sizeof *master->log_storage);
    master->log_loss = calloc(n, sizeof *master->log_loss);
    master->isotherm = calloc(n, sizeof *master->isotherm);
    if (points == NULL || master->log_frequency == NULL || master->log_storage == NULL ||
        master->log_loss == NULL || master->isotherm == NULL) {
        free(points);
        return wt_fail(err, WT_E_MEMORY, "no memory for a master curve of %zu points", n);
    }
    for (size_t i = 0; i < work->set.n; i++) {
        const shift_curve *curve = &work->set.curves[i];
        for (size_t k = 0; work->verdict[i] == SHIFT_GOOD && k < curve->n; k++)
            points[master->n++] =
                (struct point){curve->x[k] + work->a[i], curve->y[STORAGE][k] + work->b[i],
                               curve->y[LOSS][k] + work->b[i], i};
    }
    qsort(points, master->n, sizeof *points, by_x);
    for (size_t k = 0; k < master->n; k++) {
        master->log_frequency[k] = points[k].x;
        master->log_storage[k] = points[k].storage;
        master->log_loss[k] = points[k].loss;
        master->isotherm[k] = points[k].isotherm;
    }
    free(points);
    return WT_OK;
}

/* Says what hangs on no single isotherm, in the note and in the log. */
static void note_whole(const shift_work *work, wt_master_curve *master, wt_parselog *log)
{
    const superposition_check *superposition = &work->superposition;
    if (master->superposition_failed) {
        append(master->note, sizeof master->note,
               "superposition fails: E' and E'' ask for shifts up to %.2g decades apart%s",
               superposition->largest,
               work->options.vertical == WT_VERTICAL_FREE ? "" : " (try a free vertical shift)");
        wt_parselog_add(log, WT_WARNING, NULL, NULL,
                        "time-temperature superposition fails: the shifts of storage and loss "
                        "modulus differ by up to %.2g decades, %.2g times their errors",
                        superposition->largest, superposition->normalised);
    }
    if (work->n_good < work->set.n) {
        append(master->note, sizeof master->note, "%zu of %zu shifts not determined",
               work->set.n - work->n_good, work->set.n);
        wt_parselog_add(log, WT_WARNING, NULL, NULL,
                        "%zu of %zu isotherms have no determined shift and are left out",
                        work->set.n - work->n_good, work->set.n);
    }
    if (work->extrapolated) {
        append(master->note, sizeof master->note,
               "reference temperature outside the isotherms: extrapolated by WLF");
        wt_parselog_add(log, WT_WARNING, NULL, NULL,
                        "the reference temperature is outside the isotherms: extrapolated by WLF");
    }
    if (master->kramers_kronig > odd_kramers_kronig)
        append(master->note, sizeof master->note,
               "E'' is %.0f %% off what E' implies (Kramers-Kronig)",
               100.0 * master->kramers_kronig);
}

wt_status shift_master_new(const wt_sweep *sweep, const shift_work *work, wt_parselog *log,
                           wt_master_curve *master, wt_error *err)
{
    wt_master_curve made = {.deformation = sweep->deformation,
                            .reference_temperature = work->reference_temperature,
                            .vertical = work->options.vertical,
                            .rms_storage = work->rms[STORAGE],
                            .rms_loss = work->rms[LOSS],
                            .kramers_kronig = (double)NAN,
                            .superposition_failed = work->superposition.failed};
    wt_status status = fill_shifts(work, &made, err);
    if (status == WT_OK)
        status = fill_points(work, &made, err);
    if (status == WT_OK) {
        const prony_points points = prony_points_of(&made);
        status = prony_kramers_kronig(&points, &made.kramers_kronig, err);
    }
    if (status == WT_OK) {
        note_whole(work, &made, log);
        note_strain(sweep, &made, log);
        *master = made;
        made = (wt_master_curve){0};
    }
    wt_master_curve_clear(&made);
    return status;
}

void wt_master_curve_clear(wt_master_curve *master)
{
    if (master == NULL)
        return;
    free(master->shifts);
    free(master->covariance);
    free(master->covariance_ab);
    free(master->log_frequency);
    free(master->log_storage);
    free(master->log_loss);
    free(master->isotherm);
    *master = (wt_master_curve){0};
}
