/* Sweeps for the tests of the shift fit: from a tidy table of measured isotherms, or from a known
 * Prony series and WLF law with reproducible noise.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_DMA_DATA_H
#define WT_TESTS_DMA_DATA_H

#include "weartrack/dma.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The same law at another reference: c1' = c1 c2 / c2', c2' = c2 + (T' - Tref). */
static inline wt_wlf dma_moved(wt_wlf law, double temperature)
{
    const double c2 = law.c2 + (temperature - law.reference_temperature);
    return (wt_wlf){temperature, law.c1 * law.c2 / c2, c2};
}

/* T_C,f_Hz,omega_rad_s,M_storage_Pa,M_loss_Pa; rows of one temperature follow one another. */
static inline bool dma_read_tidy(const char *path, wt_sweep *sweep)
{
    FILE *file = fopen(path, "r");
    if (file == NULL)
        return false;
    char line[256];
    double(*rows)[4] = NULL;
    size_t n = 0;
    bool good = fgets(line, sizeof line, file) != NULL;
    while (good && fgets(line, sizeof line, file) != NULL) {
        double(*more)[4] = realloc(rows, (n + 1) * sizeof *rows);
        good = more != NULL;
        if (!good)
            break;
        rows = more;
        double f;
        good = sscanf(line, "%lf,%lf,%lf,%lf,%lf", &rows[n][0], &f, &rows[n][1], &rows[n][2],
                      &rows[n][3]) == 5;
        n++;
    }
    fclose(file);
    for (size_t first = 0, last; good && first < n; first = last) {
        for (last = first; last < n && rows[last][0] == rows[first][0];)
            last++;
        wt_isotherm *isotherm = wt_sweep_add(sweep, last - first, 0);
        good = isotherm != NULL;
        if (!good)
            break;
        isotherm->temperature = rows[first][0] + 273.15;
        snprintf(isotherm->source, sizeof isotherm->source, "%.3f degC", rows[first][0]);
        for (size_t k = first; k < last; k++) {
            isotherm->angular_frequency[k - first] = rows[k][1];
            isotherm->storage_modulus[k - first] = rows[k][2];
            isotherm->loss_modulus[k - first] = rows[k][3];
        }
    }
    free(rows);
    wt_sweep_sort(sweep);
    return good;
}

/* ---- synthetic rubber: a broad spectrum, a network, a known WLF law -------------------------- */

typedef struct dma_truth {
    wt_wlf wlf;
    double equilibrium; /* [Pa] */
} dma_truth;

/* H(tau) = 1e8 Pa times a Gaussian in log10 tau about 1e-4 s, 1.5 decades wide, at the reference
 * temperature; with ten Maxwell terms per decade the ripple is negligible. Unrelaxed: 0.87 GPa
 * more. */
static inline void dma_moduli(const dma_truth *truth, double omega, double *storage, double *loss)
{
    *storage = truth->equilibrium;
    *loss = 0.0;
    for (int k = -120; k <= 40; k++) {
        const double log_tau = 0.1 * k;
        const double away = (log_tau + 4.0) / 1.5;
        const double modulus = 0.1 * 2.302585092994046 * 1e8 * exp(-0.5 * away * away);
        const double z = omega * pow(10.0, log_tau);
        *storage += modulus * z * z / (1.0 + z * z);
        *loss += modulus * z / (1.0 + z * z);
    }
}

/* Normal deviates from a counter, so that a case is the same on every machine. */
static inline double dma_normal(uint64_t *state)
{
    double u[2];
    for (int i = 0; i < 2; i++) {
        *state += UINT64_C(0x9e3779b97f4a7c15);
        uint64_t z = *state;
        z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
        z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
        u[i] = ((double)((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
    }
    return sqrt(-2.0 * log(u[0])) * cos(6.283185307179586 * u[1]);
}

static const dma_truth dma_rubber = {{293.15, 8.0, 110.0}, 1e6};

/* Adds an isotherm of n points over [w_min, w_max]; moduli follow rho T with reference T0 if
 * vertical. noise: relative standard deviation, independent for each modulus. */
static inline wt_isotherm *dma_add(wt_sweep *sweep, const dma_truth *truth, double temperature,
                                   double w_min, double w_max, size_t n, bool vertical,
                                   double noise, uint64_t *state)
{
    wt_isotherm *isotherm = wt_sweep_add(sweep, n, 0);
    if (isotherm == NULL)
        return NULL;
    isotherm->temperature = temperature;
    snprintf(isotherm->source, sizeof isotherm->source, "synthetic %.2f K", temperature);
    const double log_a = wt_wlf_log_shift(&truth->wlf, temperature);
    const double scale = vertical ? temperature / truth->wlf.reference_temperature : 1.0;
    for (size_t k = 0; k < n; k++) {
        const double share = n > 1 ? (double)k / (double)(n - 1) : 0.0;
        const double w = w_min * pow(w_max / w_min, share);
        double storage, loss;
        dma_moduli(truth, w * pow(10.0, log_a), &storage, &loss);
        isotherm->angular_frequency[k] = w;
        isotherm->storage_modulus[k] = scale * storage * exp(noise * dma_normal(state));
        isotherm->loss_modulus[k] = scale * loss * exp(noise * dma_normal(state));
    }
    return isotherm;
}

/* Usual sweep of the tests: -20..80 degC every 10 K, 0.1..100 rad/s in 16 points. */
static inline void dma_usual(wt_sweep *sweep, bool vertical, double noise, uint64_t seed)
{
    uint64_t state = seed;
    for (int i = 0; i <= 10; i++)
        (void)dma_add(sweep, &dma_rubber, 253.15 + 10.0 * i, 0.1, 100.0, 16, vertical, noise,
                      &state);
    wt_sweep_sort(sweep);
}

#endif
