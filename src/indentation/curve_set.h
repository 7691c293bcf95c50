/* Simulation of force curves from their own fits. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_CURVE_SET_H
#define WT_INDENTATION_CURVE_SET_H

#include "weartrack/indentation.h"

/* curve_set_begin must precede the first curve. curve_set_add then receives every accepted curve
 * with its fit. Too many samples, or a law that the simulation does not support, make the set
 * unusable. */
void curve_set_begin(wt_curve_set *set, const wt_indent_job *job);
wt_status curve_set_add(wt_curve_set *set, const wt_force_curve *curve, const wt_indent_fit *fit,
                        wt_error *err) WT_NODISCARD;

/* Marks the set as unusable because the simulation does not support one of its curves. Returns
 * WT_OK. */
wt_status curve_set_mark_unusable(wt_curve_set *set) WT_NODISCARD;

/* Returns the number of curves, or 0 if they cannot be simulated. */
size_t curve_set_size(const wt_curve_set *set);
const wt_tip *curve_set_tip(const wt_curve_set *set);
/* True if the curves have a factor on the spectrum of the material. The temperature is that of the
 * spectrum. */
bool curve_set_has_spectrum(const wt_curve_set *set);
double curve_set_temperature(const wt_curve_set *set);
/* Mean square of the relative standard errors of the moduli. */
double curve_set_variance(const wt_curve_set *set);

/* Buffers of one thread. */
typedef struct curve_scratch curve_scratch;
curve_scratch *curve_scratch_new(const wt_curve_set *const sets[2]);
void curve_scratch_free(curve_scratch *scratch);

/* Result of the fit of one simulated curve. */
typedef struct simulated_fit {
    bool accepted;
    double level; /* modulus [Pa], or factor on the spectrum */
    wt_estimate log_level,
        contact_point; /* natural logarithm; difference to the true contact point [m] */
} simulated_fit;

/* Simulates and fits curve i with a true `level`. Cantilever and viscoelastic rubber are in
 * equilibrium on approach and retract. The baseline, the noise level and its correlation are those
 * of the measured curve. The two spectra are those of the simulation and of the fit; NULL means no
 * spectrum. */
wt_status curve_set_simulate_fit(const wt_curve_set *set, size_t i, double level,
                                 const wt_prony *true_spectrum, const wt_prony *fitted_spectrum,
                                 const wt_contact_table *contact, uint64_t seed,
                                 curve_scratch *scratch, simulated_fit *result,
                                 wt_error *err) WT_NODISCARD;

#endif
