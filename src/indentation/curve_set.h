/* Force curves that are drawn anew from their own fit. Internal to indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_CURVE_SET_H
#define WT_INDENTATION_CURVE_SET_H

#include "weartrack/flow.h"

/* Of one set, before the first curve; then every accepted curve with its fit. A curve too many, or
 * one whose law is not known to the generator, makes the set useless. */
void curve_set_begin(wt_curve_set *set, const wt_indent_job *job);
wt_status curve_set_add(wt_curve_set *set, const wt_force_curve *curve, const wt_indent_fit *fit,
                        wt_error *err) WT_NODISCARD;

/* A curve that the generator cannot make has come: the set is useless. WT_OK. */
wt_status curve_set_give_up(wt_curve_set *set) WT_NODISCARD;

/* Number of curves, 0 if they cannot be drawn anew. */
size_t curve_set_size(const wt_curve_set *set);
const wt_tip *curve_set_tip(const wt_curve_set *set);
/* Whether the curves have a factor on the spectrum of the material; the temperature of that. */
bool curve_set_has_spectrum(const wt_curve_set *set);
double curve_set_temperature(const wt_curve_set *set);
/* Mean square of the relative standard errors of their moduli. */
double curve_set_variance(const wt_curve_set *set);

/* What one thread needs. */
typedef struct curve_scratch curve_scratch;
curve_scratch *curve_scratch_new(const wt_curve_set *const sets[2]);
void curve_scratch_free(curve_scratch *scratch);

/* What one curve, drawn anew, is said to have, and whether it was accepted. */
typedef struct curve_again {
    bool accepted;
    double level;                         /* modulus, or factor on the spectrum */
    wt_estimate log_level, contact_point; /* natural logarithm; less the true contact point */
} curve_again;

/* Curve i with a true `level`: lever and rubber with memory in balance on the way in and out, on
 * the line of its baseline, with noise as strong and as correlated; fitted as the set was. made,
 * fitted: spectrum that it is made with and that the fit knows, NULL without. */
wt_status curve_set_try(const wt_curve_set *set, size_t i, double level, const wt_prony *made,
                        const wt_prony *fitted, const wt_contact_table *contact, uint64_t seed,
                        curve_scratch *scratch, curve_again *again, wt_error *err) WT_NODISCARD;

#endif
