/* Sinusoidal modulation of a held contact: amplitude and phase of height and force by least
 * squares with slow columns for drift and relaxation, and the complex modulus.
 *
 * The weights are those of Hann. Without them the relaxation, which the slow columns do not
 * follow, biases the sine (E'' by 7 % in a dwell of 48 periods without noise). The power of the
 * height at neighbouring frequencies determines if a modulation is significant.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/memory.h"
#include "core/math/arena_gsl.h"
#include "core/math/root.h"
#include "core/math/special.h"
#include "weartrack/indentation.h"

#include <complex.h>
#include <gsl/gsl_fft_real.h>
#include <gsl/gsl_linalg.h>
#include <math.h>

static const double complex unit = (double complex)I;

/* Slow columns: a cubic and the logarithm of the time since the start. */
enum { SLOW = 5, COLUMNS = SLOW + 2 };
/* Golden sections of two bins, down to 1e-12 of them. */
enum { SECTIONS = 60 };
/* Smallest number of periods and of samples. A cubic and a logarithm have four slope changes and
 * imitate a sine of fewer periods. 64 samples are nine for each column. */
enum { LEAST_PERIODS = 5, LEAST_SAMPLES = 64 };
/* Frequencies of the noise, in cycles per segment. They lie outside the bandwidth of the weights at
 * the drive, and their distance makes their noise independent: Hann weights extend over two cycles
 * to each side. Sixteen of them determine the noise power to 25 %. */
enum { FIRST_OFFSET = 3, OFFSET_STEP = 2, NEIGHBOURS = 8 /* on each side */ };
/* Smallest significant power of the height over the noise power. Noise exceeds it with a
 * probability of exp(-100). The drive must exceed its noise tenfold, because E'' is otherwise not
 * accurate to 10 %. */
static const double min_power_ratio = 100;
static const double pi = 3.14159265358979323846; /* double precision */

typedef struct modulation_samples {
    const double *time, *of[2]; /* height and force */
    size_t n;
    double start, duration, step;
} modulation_samples;

static void fill_row(const modulation_samples *s, size_t i, double omega, double row[COLUMNS])
{
    const double t = s->time[i] - s->start, u = 2 * t / s->duration - 1;
    row[0] = 1;
    row[1] = u;
    row[2] = u * u;
    row[3] = u * u * u;
    row[4] = log((t + s->step) / s->duration);
    row[5] = cos(omega * t);
    row[6] = sin(omega * t);
}

static double hann_weight(const modulation_samples *s, size_t i)
{
    const double x = sin(pi * ((double)i + 0.5) / (double)s->n);
    return x * x;
}

/* Fits the coefficients of height and force at a frequency. Returns false if the columns are not
 * independent. */
static bool fit_columns(const modulation_samples *s, double omega, double to[2][COLUMNS])
{
    double normal[COLUMNS][COLUMNS] = {{0}}, row[COLUMNS];
    for (size_t k = 0; k < 2; k++)
        for (size_t a = 0; a < COLUMNS; a++)
            to[k][a] = 0;
    for (size_t i = 0; i < s->n; i++) {
        fill_row(s, i, omega, row);
        const double w = hann_weight(s, i);
        for (size_t a = 0; a < COLUMNS; a++) {
            for (size_t b = 0; b < COLUMNS; b++)
                normal[a][b] += w * row[a] * row[b];
            for (size_t k = 0; k < 2; k++)
                to[k][a] += w * row[a] * (s->of[k][i] - s->of[k][0]);
        }
    }
    gsl_matrix_view matrix = gsl_matrix_view_array(&normal[0][0], COLUMNS, COLUMNS);
    if (gsl_linalg_cholesky_decomp1(&matrix.matrix) != GSL_SUCCESS)
        return false;
    for (size_t k = 0; k < 2; k++) {
        gsl_vector_view x = gsl_vector_view_array(to[k], COLUMNS);
        if (gsl_linalg_cholesky_svx(&matrix.matrix, &x.vector) != GSL_SUCCESS)
            return false;
    }
    return true;
}

static double drive_power(double omega, void *user)
{
    const modulation_samples *s = user;
    double c[2][COLUMNS];
    return fit_columns(s, omega, c) ? c[0][SLOW] * c[0][SLOW] + c[0][SLOW + 1] * c[0][SLOW + 1] : 0;
}

/* Returns the largest length up to n without prime factors above 7, for the transform. */
static size_t transform_length(size_t n)
{
    for (;; n--) {
        size_t rest = n;
        for (size_t factor = 2; factor <= 7; factor++)
            while (rest % factor == 0)
                rest /= factor;
        if (rest == 1)
            return n;
    }
}

/* Returns the strongest frequency of the height [rad/s]. */
static double strongest_frequency(modulation_samples *s, arena *memory)
{
    const size_t n = transform_length(s->n);
    double c[2][COLUMNS], row[COLUMNS], *work = arena_numbers(memory, s->n);
    gsl_fft_real_wavetable *table = gsl_fft_real_wavetable_alloc(n);
    gsl_fft_real_workspace *space = gsl_fft_real_workspace_alloc(n);
    size_t best = 0;
    double most = 0;
    if (table == NULL || space == NULL)
        out_of_memory(n * sizeof *work);
    if (fit_columns(s, 2 * pi / (2 * s->step), c)) {
        for (size_t i = 0; i < s->n; i++) {
            fill_row(s, i, 0, row);
            work[i] = s->of[0][i] - s->of[0][0];
            for (size_t a = 0; a < SLOW; a++)
                work[i] -= c[0][a] * row[a];
            work[i] *= hann_weight(s, i);
        }
        gsl_fft_real_transform(work, 1, n, table, space);
        for (size_t j = LEAST_PERIODS; 2 * j < n; j++) {
            const double power = work[2 * j - 1] * work[2 * j - 1] + work[2 * j] * work[2 * j];
            best = power > most ? j : best;
            most = fmax(power, most);
        }
    }
    gsl_fft_real_wavetable_free(table);
    gsl_fft_real_workspace_free(space);
    const double bin = 2 * pi / ((double)n * s->step);
    const double low = ((double)best - 1) * bin, high = ((double)best + 1) * bin;
    return best > 0 ? root_maximum(drive_power, s, low, high, SECTIONS) : 0;
}

/* Mean power of the height residual at frequencies next to the drive, whole cycles apart. The
 * result is NaN if there are none. */
static double neighbour_noise(const modulation_samples *s, const double coefficients[COLUMNS],
                              double drive)
{
    const double bin = 2 * pi / s->duration;
    double power = 0, row[COLUMNS];
    size_t n = 0;
    for (int k = -NEIGHBOURS; k <= NEIGHBOURS; k++) {
        const double off = OFFSET_STEP * k +
                           (k > 0 ? FIRST_OFFSET - OFFSET_STEP : OFFSET_STEP - FIRST_OFFSET),
                     omega = drive + off * bin;
        double complex sum = 0;
        if (k == 0 || omega < FIRST_OFFSET * bin || omega > pi / s->step)
            continue;
        for (size_t i = 0; i < s->n; i++) {
            double rest = s->of[0][i] - s->of[0][0];
            fill_row(s, i, drive, row);
            for (size_t a = 0; a < COLUMNS; a++)
                rest -= coefficients[a] * row[a];
            /* The mean weight is 1/2, so the factor is 4. */
            sum += 4 * hann_weight(s, i) * rest * cexp(-unit * omega * (s->time[i] - s->start)) /
                   (double)s->n;
        }
        power += creal(sum * conj(sum));
        n++;
    }
    return n > 0 ? power / (double)n : (double)NAN;
}

static const char *modulation_defect(const double *time, const double *position,
                                     const double *force, size_t n)
{
    if (n < LEAST_SAMPLES)
        return "too few samples for a modulation";
    for (size_t i = 0; i < n; i++)
        if (!isfinite(time[i]) || !isfinite(position[i]) || !isfinite(force[i]) ||
            (i > 0 && !(time[i] > time[i - 1])))
            return "samples without a number, or times that do not rise";
    return "";
}

wt_status wt_modulation_fit(const double *time, const double *position, const double *force,
                            size_t n, double angular_frequency, wt_modulation *modulation,
                            wt_error *err)
{
    if (time == NULL || position == NULL || force == NULL || modulation == NULL)
        return wt_fail(err, WT_E_ARG, "no modulation");
    double c[2][COLUMNS];
    arena memory = {0};
    gsl_quiet();
    *modulation = (wt_modulation){.reason = modulation_defect(time, position, force, n)};
    if (modulation->reason[0] != '\0')
        return WT_OK;
    modulation_samples s = {.time = time, .of = {position, force}, .n = n, .start = time[0]};
    s.step = (time[n - 1] - time[0]) / (double)(n - 1);
    s.duration = s.step * (double)n;
    const double omega =
        angular_frequency > 0 ? angular_frequency : strongest_frequency(&s, &memory);
    arena_free(&memory);
    modulation->angular_frequency = omega;
    if (!(omega * s.duration >= 2 * pi * LEAST_PERIODS) || !(omega * s.step < pi)) {
        modulation->reason = "no modulation with five periods and two samples in each";
        return WT_OK;
    }
    if (!fit_columns(&s, omega, c)) {
        modulation->reason = "no sine goes through it";
        return WT_OK;
    }
    for (size_t k = 0; k < 2; k++) {
        modulation->amplitude[2 * k] = c[k][SLOW];
        modulation->amplitude[2 * k + 1] = -c[k][SLOW + 1];
    }
    for (size_t i = 0; i < n; i++) {
        const double share = 2 * hann_weight(&s, i) / (double)n;
        modulation->mean_time += share * time[i];
        modulation->mean[0] += share * position[i];
        modulation->mean[1] += share * force[i];
    }
    const double noise = neighbour_noise(&s, c[0], omega);
    modulation->start = s.start;
    modulation->found =
        c[0][SLOW] * c[0][SLOW] + c[0][SLOW + 1] * c[0][SLOW + 1] > min_power_ratio * noise;
    if (!modulation->found)
        modulation->reason = "no modulation of the height that is more than noise";
    return WT_OK;
}

void wt_modulation_remove(const wt_modulation *m, const double *time, size_t n, double *position,
                          double *force)
{
    for (size_t i = 0; i < n; i++) {
        const double phase = m->angular_frequency * (time[i] - m->start);
        position[i] -= m->amplitude[0] * cos(phase) - m->amplitude[1] * sin(phase);
        force[i] -= m->amplitude[2] * cos(phase) - m->amplitude[3] * sin(phase);
    }
}

wt_status wt_modulation_moduli(const wt_modulation *m, const wt_modulation *air,
                               double spring_constant, double slope, wt_dwell_moduli *moduli,
                               wt_error *err)
{
    if (m == NULL || moduli == NULL || !m->found || !(spring_constant > 0) || !(slope > 0))
        return wt_fail(err, WT_E_ARG, "no modulation, cantilever or contact");
    const double complex z = m->amplitude[0] + unit * m->amplitude[1],
                         f = m->amplitude[2] + unit * m->amplitude[3];
    double complex drag = 0;
    if (air != NULL && air->found)
        drag = (air->amplitude[2] + unit * air->amplitude[3]) /
               (air->amplitude[0] + unit * air->amplitude[1]);
    const double complex stiffness = (f - drag * z) / (z - f / spring_constant);
    *moduli = (wt_dwell_moduli){
        .angular_frequency = m->angular_frequency,
        .storage = {creal(stiffness) / slope, (double)NAN, 0, "Pa"},
        .loss = {cimag(stiffness) / slope, (double)NAN, 0, "Pa"},
    };
    return WT_OK;
}
