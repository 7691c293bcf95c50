/* Inside the comparison of materials: their moduli with errors where they are compared, and the
 * verdict. Internal to dma. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_MATERIAL_COMPARISON_H
#define WT_DMA_MATERIAL_COMPARISON_H

#include "weartrack/flow.h"

enum { MATERIALS_E1, MATERIALS_E2, MATERIALS_TAN, MATERIALS_QUANTITIES };

/* Where moduli are asked for. */
typedef struct material_place {
    double temperature, frequency;
} material_place;

/* ln E', ln E'' and ln tan delta of a material at places. */
typedef struct material_values {
    size_t n, n_draws; /* without draws the error is not known */
    double *value;     /* [n * MATERIALS_QUANTITIES] */
    double *error;     /* the same, standard errors by the draws and what is beside them */
    double *draw;      /* [n_draws * n * MATERIALS_QUANTITIES] minus their mean */
} material_values;

/* Relative errors that the draws do not hold, by quantity. */
typedef struct compared_material {
    double misfit[MATERIALS_QUANTITIES], sample[MATERIALS_QUANTITIES];
} compared_material;

/* v: cleared by the caller, also on failure. */
wt_status material_values_make(const wt_rubber *rubber, const compared_material *beside,
                               const material_place *place, size_t n, const wt_job *work,
                               material_values *v, wt_error *err) WT_NODISCARD;
void material_values_clear(material_values *v);

/* The second over the first: ln ratio and its standard error, both [n * MATERIALS_QUANTITIES]. */
typedef struct material_ratio {
    size_t n;
    double *value, *error;
    double critical; /* errors that no point of a curve is off by chance, in 95 of 100 trials */
    bool known;      /* the errors are */
} material_ratio;
wt_status material_ratio_make(const material_values *first, const material_values *second,
                              material_ratio *r, wt_error *err) WT_NODISCARD;
void material_ratio_clear(material_ratio *r);

typedef struct material_verdict {
    char differs[512], settled_by[320]; /* the latter "" where nothing is left open */
} material_verdict;

/* Of the second against the first. */
material_verdict material_judge(const wt_compared pair[2], const material_values values[2],
                                const compared_material beside[2], const material_ratio *ratio,
                                double margin);

#endif
