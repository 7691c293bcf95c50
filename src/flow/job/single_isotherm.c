/* One isotherm as a master curve: nothing to shift, but a material at its temperature.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/single_isotherm.h"

#include <math.h>
#include <stdlib.h>

/* A reference temperature this close is that of the isotherm: an oven holds no better [K]. */
#define SAME_TEMPERATURE 1.0

static wt_status allocate(size_t n, wt_master_curve *master, wt_error *err)
{
    master->shifts = calloc(1, sizeof *master->shifts);
    master->covariance = calloc(1, sizeof *master->covariance);
    master->covariance_ab = calloc(4, sizeof *master->covariance_ab);
    master->log_frequency = calloc(n, sizeof *master->log_frequency);
    master->log_storage = calloc(n, sizeof *master->log_storage);
    master->log_loss = calloc(n, sizeof *master->log_loss);
    master->isotherm = calloc(n, sizeof *master->isotherm);
    if (master->shifts == NULL || master->covariance == NULL || master->covariance_ab == NULL ||
        master->log_frequency == NULL || master->log_storage == NULL || master->log_loss == NULL ||
        master->isotherm == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    return WT_OK;
}

static void take_points(const wt_isotherm *isotherm, wt_master_curve *master, wt_parselog *log)
{
    for (size_t i = 0; i < isotherm->n; i++) {
        if (!(isotherm->storage_modulus[i] > 0) || !(isotherm->loss_modulus[i] > 0) ||
            !(isotherm->angular_frequency[i] > 0)) {
            wt_parselog_add(log, WT_WARNING, isotherm->source, NULL,
                            "points without positive frequency and moduli left out");
            continue;
        }
        master->log_frequency[master->n] = log10(isotherm->angular_frequency[i]);
        master->log_storage[master->n] = log10(isotherm->storage_modulus[i]);
        master->log_loss[master->n++] = log10(isotherm->loss_modulus[i]);
    }
}

wt_status flow_single_isotherm(const wt_sweep *sweep, const wt_shift_options *options,
                               wt_parselog *log, wt_master_curve *master, wt_error *err)
{
    const wt_isotherm *isotherm = &sweep->isotherms[0];
    const wt_estimate zero = {0, 0, 0, "1"};
    wt_master_curve m = {.deformation = sweep->deformation,
                         .reference_temperature = isotherm->temperature,
                         .vertical = WT_VERTICAL_NONE,
                         .n_shifts = 1,
                         .rms_storage = (double)NAN,
                         .rms_loss = (double)NAN,
                         .kramers_kronig = (double)NAN,
                         .note = "one isotherm"};
    if (fabs(options->reference_temperature - isotherm->temperature) > SAME_TEMPERATURE) {
        wt_fail(err, WT_E_MISSING, "one isotherm cannot be taken to another temperature");
        wt_error_expected(err, "a reference temperature of %.2f degC",
                          isotherm->temperature - WT_ZERO_CELSIUS);
        wt_error_found(err, "%.2f degC", options->reference_temperature - WT_ZERO_CELSIUS);
        wt_error_advice(err, "measure at several temperatures, or leave the reference out");
        return WT_E_MISSING;
    }
    wt_status status = allocate(isotherm->n, &m, err);
    if (status == WT_OK)
        take_points(isotherm, &m, log);
    if (status == WT_OK && m.n == 0)
        status = wt_fail(err, WT_E_EMPTY, "the isotherm has no point with positive moduli");
    if (status != WT_OK) {
        wt_master_curve_clear(&m);
        return status;
    }
    m.shifts[0] = (wt_shift){.temperature = isotherm->temperature,
                             .log_a = zero,
                             .log_b = zero,
                             .determined = true,
                             .note = "the only isotherm"};
    *master = m;
    return WT_OK;
}
