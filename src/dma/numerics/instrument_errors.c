/* Errors of the instrument that all isotherms share. The measured modulus is that of the sample in
 * series with frame and clamps, less the inertia of the moving parts, with a phase lag.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include <complex.h>
#include <math.h>

/* Assumed sizes of what the corrections of an instrument leave: half a degree of phase at the
 * highest frequency, 3 % of the storage modulus where inertia takes most, and 1 % of the strain of
 * a sample of 1 GPa. Isotherms do not show the compliance, because a spring in series with a
 * viscoelastic sample is a viscoelastic sample. Only the prior of the spectrum would determine it,
 * so it is not fitted: the errors alone contain it (spectrum_consider_compliance). */
const double instrument_deviation[INSTRUMENT_ERRORS] = {
    [PHASE_LAG] = 0.5 * M_PI / 180.0, [INERTIA] = 0.03, [FRAME_COMPLIANCE] = 0.01 / 1e9};
/* Least share of a measured modulus that is left of it: a step of the fit must not reach zero. */
static const double least_share = 0.1;

size_t instrument_unknowns(const shift_set *set)
{
    return set->loading == WT_OSCILLATION && set->quantity == WT_SHIFT_MODULI &&
                   !set->without_instrument
               ? INSTRUMENT_ERRORS
               : 0;
}

void instrument_set_priors(spectrum *s)
{
    double fastest = 0.0, softest = HUGE_VAL;
    for (size_t k = 0; k < s->n; k++) {
        fastest = fmax(fastest, exp(s->x[k]));
        softest = fmin(softest, exp(s->y[STORAGE][k] - 2.0 * s->x[k]));
    }
    s->instrument[PHASE_LAG] = instrument_deviation[PHASE_LAG] / fastest;
    s->instrument[INERTIA] = instrument_deviation[INERTIA] * softest;
    s->instrument[FRAME_COMPLIANCE] = instrument_deviation[FRAME_COMPLIANCE];
}

void instrument_correct(const spectrum *s, const double *unknown, size_t k,
                        double log_modulus[MODULI], double by[MODULI][INSTRUMENT_ERRORS])
{
    const double omega = exp(s->x[k]), *const unit = s->instrument;
    const double complex i = (double complex)I,
                         measured = exp(s->y[STORAGE][k]) + i * exp(s->y[LOSS][k]);
    const double complex in_phase =
        measured * cexp(-i * omega * unit[PHASE_LAG] * unknown[PHASE_LAG]);
    const double complex with_mass = in_phase + omega * omega * unit[INERTIA] * unknown[INERTIA];
    const double complex series =
        1.0 / (1.0 - unit[FRAME_COMPLIANCE] * unknown[FRAME_COMPLIANCE] * with_mass);
    const double complex change[INSTRUMENT_ERRORS] = {
        [PHASE_LAG] = -i * omega * unit[PHASE_LAG] * in_phase * series * series,
        [INERTIA] = omega * omega * unit[INERTIA] * series * series,
        [FRAME_COMPLIANCE] = unit[FRAME_COMPLIANCE] * with_mass * with_mass * series * series};
    const double modulus[MODULI] = {
        [STORAGE] = fmax(creal(with_mass * series), least_share * creal(measured)),
        [LOSS] = fmax(cimag(with_mass * series), least_share * cimag(measured))};
    for (int q = 0; q < MODULI; q++)
        log_modulus[q] = log(modulus[q]);
    for (int u = 0; u < INSTRUMENT_ERRORS; u++) {
        by[STORAGE][u] = creal(change[u]) / modulus[STORAGE];
        by[LOSS][u] = cimag(change[u]) / modulus[LOSS];
    }
}
