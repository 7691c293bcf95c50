/* Parametric bootstrap of a case: measurements and stated values are simulated with the fitted
 * model as the truth. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_PARAMETRIC_BOOTSTRAP_H
#define WT_STUDY_PARAMETRIC_BOOTSTRAP_H

#include "study/case_override.h"

/* Simulates isotherms from the fitted spectrum with its noise, autocorrelation and temperature
 * scatter. shift: [n_shifts of the fit] true log10 a_T relative to the reference isotherm; NaN if
 * not determined. sweep: the caller clears it. */
wt_status bootstrap_sweep(const wt_sweep *measured, const wt_master *fit, uint64_t seed,
                          wt_sweep *sweep, double *shift, wt_error *err) WT_NODISCARD;

/* Model of ln E of a group: scatter between spots, and of curves within a spot. */
typedef struct scattered_group {
    size_t n, n_spots;
    const long *spot;             /* [n] */
    double mean, between, within; /* of ln E: mean and standard deviations */
} scattered_group;

/* Estimates the scatter. False if there are fewer than two spots. error: mean squared standard
 * error of ln E by the fits, which is subtracted from the scatter of the curves. */
bool bootstrap_scatter(const double *modulus, const long *spot, size_t n, double error,
                       scattered_group *group);
/* Simulates a group. modulus: [n]. The groups of one trial need different numbers. */
void bootstrap_group(const scattered_group *group, uint64_t seed, unsigned number, double *modulus);

/* Simulates another measurement of every input with a stated error; the relative error is
 * preserved. */
void bootstrap_inputs(case_variant *s, uint64_t seed);
/* Fixes all inputs and the strain softening. */
void bootstrap_fix_inputs(case_variant *s);
/* Lists these inputs in a text. */
void bootstrap_describe(const case_variant *s, char *text, size_t size);

#endif
