/* Accuracy of shift factors, relaxation spectrum and standard errors by draws.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/bench.h"
#include "bench/precision.h"

#include "core/math/cholesky.h"
#include "dma/law/prony_law.h"
#include "job/random_draws.h"

#include <math.h>
#include <string.h>

/* ---- shift factors --------------------------------------------------------------------------- */

enum { ISOTHERMS = 12, POINTS = 16, TERMS = 64, REFERENCE = 6 }; /* of the problem */

#define NOISE 0.005 /* relative noise of the moduli, as of a good rheometer */

typedef struct shift_problem {
    wt_sweep sweep;
    double truth[ISOTHERMS], log_a[ISOTHERMS], stated;
    double error; /* of the moduli by the spectrum */
} shift_problem;

/* The relaxation times extend beyond all isotherms on both sides. */
static void simulated_moduli(double omega, double *storage, double *loss)
{
    *storage = 1e6;
    *loss = 0;
    for (int k = 0; k < TERMS; k++) {
        const double decade = 0.25 * k;
        prony_add_term(9e4 * pow(10, 0.22 * decade), pow(10, 4 - decade), omega, storage, loss);
    }
}

static wt_status begin_shift(void *problem, double *reference_error, wt_error *err)
{
    shift_problem *p = problem;
    const wt_wlf wlf = {293.15, 8.5, 130};
    bench_random random = {1};
    *reference_error = 0;
    for (int i = 0; i < ISOTHERMS; i++) {
        wt_isotherm *iso = wt_sweep_add(&p->sweep, POINTS, 0);
        if (iso == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        iso->temperature = wlf.reference_temperature + 5 * (i - REFERENCE);
        p->truth[i] = wt_wlf_log_shift(&wlf, iso->temperature);
        for (int j = 0; j < POINTS; j++) {
            const double omega = 0.1 * pow(10, 3.0 * j / (POINTS - 1));
            double storage = 0, loss = 0;
            simulated_moduli(omega * pow(10, p->truth[i]), &storage, &loss);
            iso->angular_frequency[j] = omega;
            iso->storage_modulus[j] = storage * (1 + NOISE * bench_normal(&random));
            iso->loss_modulus[j] = loss * (1 + NOISE * bench_normal(&random));
        }
    }
    wt_sweep_sort(&p->sweep);
    return WT_OK;
}

static void finish_shift(void *problem)
{
    shift_problem *p = problem;
    wt_sweep_clear(&p->sweep);
}

static wt_status fit_master_curve(const shift_problem *p, double terms, wt_master *master,
                                  wt_error *err)
{
    wt_master_options options = wt_master_options_defaults();
    options.reference_temperature = p->sweep.isotherms[REFERENCE].temperature;
    options.vertical = WT_VERTICAL_NONE;
    options.terms_per_decade = terms;
    return wt_master_fit(&p->sweep, &options, NULL, master, err);
}

static wt_status solve_shift(void *problem, double value, wt_error *err)
{
    shift_problem *p = problem;
    wt_master master = {0};
    const wt_status status = fit_master_curve(p, value, &master, err);
    double sum = 0;
    for (size_t i = 0; i < master.n_shifts && i < ISOTHERMS; i++) {
        p->log_a[i] = master.shifts[i].log_a.value;
        sum += pow(master.shifts[i].log_a.standard_error, 2);
    }
    p->stated = M_LN10 * sqrt(sum / ISOTHERMS);
    wt_master_clear(&master);
    return status;
}

/* Interpolates log10 E' linearly at log10 omega = x. NaN outside the isotherm. */
static double interpolate_storage(const wt_isotherm *iso, double x)
{
    for (size_t j = 0; j + 1 < iso->n; j++) {
        const double x0 = log10(iso->angular_frequency[j]);
        const double x1 = log10(iso->angular_frequency[j + 1]);
        const double y0 = log10(iso->storage_modulus[j]), y1 = log10(iso->storage_modulus[j + 1]);
        if (x >= x0 && x <= x1)
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
    }
    return (double)NAN;
}

/* Returns the best of a number of shifts by the mean square of log E' in the overlap. */
static double neighbour_shift(const wt_isotherm *from, const wt_isotherm *to, int trials)
{
    double best = 0, least = (double)INFINITY;
    for (int t = 0; t < trials; t++) {
        const double shift = -2.8 + 5.6 * t / (trials - 1);
        double sum = 0;
        int n = 0;
        for (size_t j = 0; j < from->n; j++) {
            const double y = interpolate_storage(to, log10(from->angular_frequency[j]) + shift);
            if (isnan(y))
                continue;
            sum += pow(log10(from->storage_modulus[j]) - y, 2);
            n++;
        }
        if (n >= 4 && sum / n < least) {
            least = sum / n;
            best = shift;
        }
    }
    return best;
}

static wt_status solve_pairs(void *problem, double value, wt_error *err)
{
    shift_problem *p = problem;
    const wt_isotherm *iso = p->sweep.isotherms;
    (void)err;
    p->log_a[REFERENCE] = 0;
    for (int i = REFERENCE - 1; i >= 0; i--)
        p->log_a[i] = p->log_a[i + 1] + neighbour_shift(&iso[i], &iso[i + 1], (int)value);
    for (int i = REFERENCE + 1; i < ISOTHERMS; i++)
        p->log_a[i] = p->log_a[i - 1] + neighbour_shift(&iso[i], &iso[i - 1], (int)value);
    p->stated = (double)NAN;
    return WT_OK;
}

static precision_errors shift_errors(const void *problem)
{
    const shift_problem *p = problem;
    double sum = 0;
    for (int i = 0; i < ISOTHERMS; i++)
        sum += pow(p->log_a[i] - p->truth[i], 2);
    return (precision_errors){M_LN10 * sqrt(sum / ISOTHERMS), p->stated};
}

/* ---- relaxation spectrum --------------------------------------------------------------------- */

/* Test frequencies between the points, within the range of all isotherms. */
enum { JUDGED = 200 };

static double test_frequency(const shift_problem *p, int i)
{
    const double low = p->truth[ISOTHERMS - 1] - 1, high = p->truth[0] + 2;
    return pow(10, low + (high - low) * (i + 0.5) / JUDGED);
}

static double squared_log_errors(double log_storage, double log_loss, double omega)
{
    double storage = 0, loss = 0;
    simulated_moduli(omega, &storage, &loss);
    return pow(log_storage - log(storage), 2) + pow(log_loss - log(loss), 2);
}

static wt_status solve_spectrum(void *problem, double value, wt_error *err)
{
    shift_problem *p = problem;
    wt_master master = {0};
    double sum = 0, stated = 0;
    const wt_status status = fit_master_curve(p, value, &master, err);
    for (int i = 0; i < JUDGED && status == WT_OK; i++) {
        wt_interval storage, loss;
        const double omega = test_frequency(p, i);
        wt_master_moduli(&master, omega, &storage, &loss);
        sum += squared_log_errors(M_LN10 * storage.value, M_LN10 * loss.value, omega);
        stated += pow(storage.standard_error, 2) + pow(loss.standard_error, 2);
    }
    p->error = sqrt(sum / (2 * JUDGED));
    p->stated = M_LN10 * sqrt(stated / (2 * JUDGED));
    wt_master_clear(&master);
    return status;
}

enum { MOST_TERMS = 64 }; /* more than the problem needs */

/* Contribution of a term with a modulus of 1 to E' and E''. The first term does not relax. */
static void prony_term(double omega, size_t j, double first, double density, double part[2])
{
    part[0] = j == 0 ? 1 : 0;
    part[1] = 0;
    if (j > 0)
        prony_add_term(1, pow(10, first + ((double)j - 1) / density), omega, &part[0], &part[1]);
}

/* Terms at fixed times with a given density per decade, by linear least squares of the relative
 * residuals. The shifts are the true ones. */
static wt_status solve_collocation(void *problem, double value, wt_error *err)
{
    shift_problem *p = problem;
    static double a[MOST_TERMS][MOST_TERMS]; /* static because it is too large for the stack of a
                                                thread */
    double x[MOST_TERMS] = {0}, part[2];
    const double first = -(p->truth[0] + 2), decades = p->truth[0] - p->truth[ISOTHERMS - 1] + 3;
    const size_t n = 2 + (size_t)(decades * value);
    if (n > MOST_TERMS)
        return wt_fail(err, WT_E_RANGE, "too many terms");
    memset(a, 0, sizeof a);
    for (int i = 0; i < ISOTHERMS; i++)
        for (size_t k = 0; k < POINTS; k++) {
            const wt_isotherm *iso = &p->sweep.isotherms[i];
            const double measured[2] = {iso->storage_modulus[k], iso->loss_modulus[k]};
            double row[2][MOST_TERMS];
            for (size_t j = 0; j < n; j++) {
                prony_term(iso->angular_frequency[k] * pow(10, p->truth[i]), j, first, value, part);
                row[0][j] = part[0] / measured[0];
                row[1][j] = part[1] / measured[1];
            }
            for (int q = 0; q < 2; q++)
                for (size_t j = 0; j < n; j++) {
                    x[j] += row[q][j];
                    for (size_t l = 0; l <= j; l++)
                        a[j][l] += row[q][j] * row[q][l];
                }
        }
    const bool solved = cholesky_solve(&a[0][0], MOST_TERMS, n, 0, x);
    double sum = 0;
    for (int i = 0; i < JUDGED; i++) {
        const double omega = test_frequency(p, i);
        double storage = 0, loss = 0;
        for (size_t j = 0; j < n; j++) {
            prony_term(omega, j, first, value, part);
            storage += x[j] * part[0];
            loss += x[j] * part[1];
        }
        /* a modulus below zero counts with its full error */
        sum += squared_log_errors(log(fmax(storage, 1)), log(fmax(loss, 1)), omega);
    }
    p->error = solved ? sqrt(sum / (2 * JUDGED)) : (double)NAN;
    p->stated = (double)NAN;
    return WT_OK;
}

static precision_errors spectrum_errors(const void *problem)
{
    const shift_problem *p = problem;
    return (precision_errors){p->error, p->stated};
}

/* ---- draws ----------------------------------------------------------------------------------- */

#define SCATTER 0.1 /* standard deviation of the logarithm */

typedef struct draw_problem {
    double value[4096], truth, error, stated;
} draw_problem;

static wt_status begin_draws(void *problem, double *reference_error, wt_error *err)
{
    draw_problem *p = problem;
    const double square = SCATTER * SCATTER;
    (void)err;
    p->truth = exp(square / 2) * sqrt(expm1(square));
    *reference_error = 0;
    return WT_OK;
}

static void finish_draws(void *problem)
{
    (void)problem;
}

static wt_status solve_draws(void *problem, double value, wt_error *err)
{
    draw_problem *p = problem;
    const size_t n = (size_t)value;
    (void)err;
    for (size_t i = 0; i < n; i++)
        p->value[i] = flow_draw_positive((wt_estimate){1, SCATTER, 0, "1"}, 1, i, FLOW_DRAW_WEAR);
    p->error = flow_standard_deviation(p->value, n, 1);
    p->stated = 1 / sqrt(2 * (value - 1));
    return WT_OK;
}

/* Law of error propagation: half the difference between one standard error to each side. */
static wt_status solve_propagation(void *problem, double value, wt_error *err)
{
    draw_problem *p = problem;
    (void)err;
    p->error = (exp(value * SCATTER) - exp(-value * SCATTER)) / (2 * value);
    p->stated = (double)NAN;
    return WT_OK;
}

static precision_errors draws_errors(const void *problem)
{
    const draw_problem *p = problem;
    return (precision_errors){precision_relative(p->error, p->truth), p->stated};
}

const precision_part precision_spectrum[] = {
    {.name = "shifting",
     "Shift factors of 12 simulated isotherms of 16 points with 0.5 % noise, against the law they "
     "were made with; the true error is the rms of this set, its floor the noise",
     sizeof(shift_problem),
     begin_shift,
     shift_errors,
     finish_shift,
     {{"weartrack", "terms per decade of the spectrum", {2, 3, 4, 6, 10}, solve_shift},
      {"textbook", "trial shifts of each neighbour", {30, 100, 300, 1000}, solve_pairs}}},
    {.name = "spectrum",
     "E' and E'' of the spectrum of the same isotherms between their points, against the series "
     "they "
     "were made with, rms; the textbook knows the shifts",
     sizeof(shift_problem),
     begin_shift,
     spectrum_errors,
     finish_shift,
     {{"weartrack", "terms per decade", {2, 3, 4, 6, 10}, solve_spectrum},
      {"textbook",
       "terms per decade, linear least squares",
       {0.5, 1, 1.5, 2, 3},
       solve_collocation}}},
    {.name = "draws",
     "Standard error of a logarithmic normal number by replicates, against its formula",
     sizeof(draw_problem),
     begin_draws,
     draws_errors,
     finish_draws,
     {{"weartrack", "replicates", {16, 64, 256, 1024, 4096}, solve_draws},
      {"textbook", "standard errors to each side", {1}, solve_propagation}}},
    {.name = NULL},
};
