/* Internal interface of the comparison of materials: moduli with errors, ratios and verdict.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_MATERIAL_COMPARISON_H
#define WT_DMA_MATERIAL_COMPARISON_H

#include "weartrack/dma.h"

enum { MATERIALS_E1, MATERIALS_E2, MATERIALS_TAN, MATERIALS_QUANTITIES };

/* Point at which moduli are compared: temperature [K] and angular frequency [rad/s]. */
typedef struct comparison_point {
    double temperature, frequency;
} comparison_point;

/* ln E', ln E'' and ln tan delta of a material at the points. */
typedef struct material_values {
    size_t n, n_draws; /* n_draws 0: the error is unknown */
    double *value;     /* [n * MATERIALS_QUANTITIES] */
    double
        *error; /* [n * MATERIALS_QUANTITIES] standard errors of the draws and systematic errors */
    double *draw; /* [n_draws * n * MATERIALS_QUANTITIES] deviations of the draws from their mean */
} material_values;

/* Relative systematic errors by quantity, which the draws do not contain. */
typedef struct material_systematic_errors {
    double misfit[MATERIALS_QUANTITIES], sample[MATERIALS_QUANTITIES];
} material_systematic_errors;

/* Computes the moduli at n points. The caller clears v, also on failure. */
wt_status material_values_compute(const wt_rubber *rubber,
                                  const material_systematic_errors *systematic,
                                  const comparison_point *point, size_t n, const wt_job *work,
                                  material_values *v, wt_error *err) WT_NODISCARD;
void material_values_clear(material_values *v);

/* Ratio of the second material to the first: ln ratio and standard error, both [n *
 * MATERIALS_QUANTITIES]. The caller clears it. */
typedef struct material_ratio {
    size_t n;
    double *value, *error;
    double critical;   /* in standard errors; no point deviates more by chance in 95 of 100 cases */
    bool errors_known; /* true if both errors are known */
} material_ratio;
material_ratio material_ratio_compute(const material_values *first, const material_values *second);
void material_ratio_clear(material_ratio *r);

typedef struct material_verdict {
    char differs[512], settled_by[320]; /* settled_by is "" if the verdict is conclusive */
} material_verdict;

/* Assesses the difference of the second material from the first. */
material_verdict material_assess(const wt_compared_material pair[2],
                                 const material_values values[2],
                                 const material_systematic_errors systematic[2],
                                 const material_ratio *ratio, double margin);

#endif
