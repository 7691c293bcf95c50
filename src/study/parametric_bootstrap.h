/* A case drawn anew from its own fit: what would have been measured and stated another time, if the
 * model and all its numbers were the truth. Internal to study.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_PARAMETRIC_BOOTSTRAP_H
#define WT_STUDY_PARAMETRIC_BOOTSTRAP_H

#include "study/case_override.h"

/* Isotherms from the fitted spectrum, with the noise, its correlation and the scatter of the
 * temperatures that the fit found. shift: [n_shifts of the fit] log10 a_T that they were made with,
 * relative to the reference isotherm; NaN where not determined. sweep: cleared by the caller. */
wt_status bootstrap_sweep(const wt_sweep *measured, const wt_master *fit, uint64_t seed,
                          wt_sweep *sweep, double *shift, wt_error *err) WT_NODISCARD;

/* The logarithm of the moduli of a group as spots that scatter, with curves that scatter on them.
 */
typedef struct scattered_group {
    size_t n, n_spots;
    const long *spot;             /* [n] */
    double mean, between, within; /* of ln E, and its standard deviations */
} scattered_group;

/* False if fewer than two spots tell the scatter. error: mean square of what the fit leaves open of
 * ln E, which the scatter of the curves then is without. */
bool bootstrap_scatter(const double *modulus, const long *spot, size_t n, double error,
                       scattered_group *group);
/* modulus: [n]. Two groups of one trial have two numbers. */
void bootstrap_group(const scattered_group *group, uint64_t seed, unsigned number, double *modulus);

/* Every input with a stated error as another measurement of it would state it, with the same
 * relative error. */
void bootstrap_inputs(setting *s, uint64_t seed);
/* All of them held as they are, and what softens the rubber. */
void bootstrap_fix_inputs(setting *s);
/* Which those are, in words. */
void bootstrap_describe(const setting *s, char *text, size_t size);

#endif
