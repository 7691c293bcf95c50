/* Sweeps for the tests of the shift fit: from a tidy table of measured isotherms, or made from a
 * known Prony series and WLF law with reproducible noise.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_DMA_DATA_H
#define WT_TESTS_DMA_DATA_H

#include "weartrack/model.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
        wt_isotherm *isotherm = wt_sweep_add(sweep, last - first, false);
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

/* ---- synthetic material: a broad, smooth spectrum, solid or liquid, with a known WLF law ------
 */

typedef struct dma_truth {
    wt_wlf wlf;
    double equilibrium;  /* [Pa] */
    double plateau_only; /* > 0: nothing but an equilibrium modulus and this share of loss */
} dma_truth;

/* H(tau) is a wedge of slope -1/2 from 1e-9 s to 1 s at the reference temperature, height 1e6 Pa at
 * 1 ms; ten Maxwell terms per decade make its ripple invisible. */
static inline void dma_moduli(const dma_truth *truth, double omega, double *storage, double *loss)
{
    *storage = truth->equilibrium;
    *loss = 0.0;
    if (truth->plateau_only > 0.0) {
        *loss = truth->equilibrium * truth->plateau_only;
        return;
    }
    for (int k = 0; k <= 90; k++) {
        const double log_tau = -9.0 + 0.1 * k;
        const double edge = (k == 0 || k == 90) ? 0.5 : 1.0;
        const double modulus = edge * 0.1 * 2.302585 * 1e6 * pow(10.0, -0.5 * (log_tau + 3.0));
        const double z = omega * pow(10.0, log_tau);
        *storage += modulus * z * z / (1.0 + z * z);
        *loss += modulus * z / (1.0 + z * z);
    }
}

/* Normal deviates from a counter, so a case is the same on every machine. */
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

/* Adds an isotherm of n points over [w_min, w_max]; moduli follow rho T with reference T0 if
 * vertical. noise: relative standard deviation, independent for each modulus. */
static inline wt_isotherm *dma_add(wt_sweep *sweep, const dma_truth *truth, double temperature,
                                   double w_min, double w_max, size_t n, bool vertical,
                                   double noise, uint64_t *state)
{
    wt_isotherm *isotherm = wt_sweep_add(sweep, n, false);
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

#endif
