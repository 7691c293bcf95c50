/* Inside the fit room: the force that lever and sample give together, its residuals and derivatives
 * for all samples of a curve.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_FIT_CURVE_MODEL_H
#define WT_FIT_CURVE_MODEL_H

#include "fit/curve.h"

typedef struct wt_curve_model {
    const wt_contact_table *table;
    const wt_curve_samples *samples;
    wt_indent_workspace *workspace; /* delta, g, slope, residual: of the latest evaluation */
    bool free[WT_CURVE_N_PARAMETERS];
    bool plain;
    /* The first samples, far from contact for any step of the fit, enter by their sums alone. */
    size_t n_baseline;
    double baseline_end; /* largest position among them */
    double z0, f0;       /* origin of the sums */
    double z, zz, f, zf, ff;
} wt_curve_model;

typedef struct wt_normal_equations {
    double jj[WT_CURVE_N_PARAMETERS][WT_CURVE_N_PARAMETERS], jr[WT_CURVE_N_PARAMETERS];
} wt_normal_equations;

/* Begins at parameters p. */
void wt_curve_model_start(wt_curve_model *model, const double p[WT_CURVE_N_PARAMETERS]);
/* Evaluates at p and returns the sum of squares. */
double wt_curve_model_cost(wt_curve_model *model, const double p[WT_CURVE_N_PARAMETERS]);
/* At the parameters of the latest evaluation. */
void wt_curve_model_normal(const wt_curve_model *model, const double p[WT_CURVE_N_PARAMETERS],
                           wt_normal_equations *equations);
/* Evaluates all samples one by one, those of the baseline too. */
double wt_curve_model_complete(wt_curve_model *model, const double p[WT_CURVE_N_PARAMETERS]);
/* Derivatives of the modelled force of sample i; 0 where a parameter is not free. Returns what the
 * residual makes of a noise of 1. */
double wt_curve_model_row(const wt_curve_model *model, const double p[WT_CURVE_N_PARAMETERS],
                          size_t i, double row[WT_CURVE_N_PARAMETERS]);
/* h = 1 + S/k of sample i. */
double wt_curve_model_factor(const wt_curve_model *model, const double p[WT_CURVE_N_PARAMETERS],
                             size_t i);

#endif
