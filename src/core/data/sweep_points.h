/* Common arrays of isotherms, temperature sweeps and strain sweeps. Internal to the library.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_DATA_SWEEP_POINTS_H
#define WT_CORE_DATA_SWEEP_POINTS_H

#include "weartrack/core.h"

/* Index of an array: the swept variable is first. A missing array is NULL. */
enum {
    SWEEP_VARIABLE,
    SWEEP_STORAGE,
    SWEEP_LOSS,
    SWEEP_STRAIN, /* also NULL in a strain sweep */
    SWEEP_LOSS_FACTOR,
    SWEEP_TEMPERATURE, /* of an isotherm that drifts */
    SWEEP_ARRAYS
};
typedef struct sweep_points {
    double *array[SWEEP_ARRAYS]; /* [n] each, sorted together */
    size_t n;
    char *sample; /* NULL without a name */
} sweep_points;

sweep_points isotherm_points(const wt_isotherm *t);
sweep_points ramp_points(const wt_ramp *t);
sweep_points strain_sweep_points(const wt_strain_sweep *t);

#endif
