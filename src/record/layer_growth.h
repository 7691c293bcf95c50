/* Friction while a layer grows at the conditions of a record, by the values themselves and by their
 * draws (internal to record). SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_LAYER_GROWTH_H
#define WT_RECORD_LAYER_GROWTH_H

#include "friction/replicates.h"
#include "record/measured_friction.h"
#include "record/numerics/running_in_curve.h"

/* Numbers of one draw before its friction in time. */
typedef enum growth_number {
    GROWTH_END,    /* friction at the balance of formation and wear; first, as never NaN */
    GROWTH_BARE,   /* without a layer */
    GROWTH_WEAR,   /* k [m^2/N] */
    GROWTH_ENERGY, /* U_c [J/m^3]; NaN: the closure has none */
    GROWTH_NUMBERS
} growth_number;

typedef struct growth {
    size_t n, n_draws, stride;
    double log_first, log_step; /* of the n times [s] */
    double *value;  /* [(1 + n_draws) * stride] the numbers, then friction at the times; those of
                       the values themselves first; NaN: a draw that has no solution */
    double *course; /* [(1 + n_draws) * n] that friction less the one in the end */
    flow_draw line[REPLICATES_MOST];
    size_t n_lines, n_bare; /* draws in which there is no layer */
    char includes[256];     /* what is drawn, in words */
    bool without_errors;    /* what acts back is followed by the values themselves alone */
} growth;

/* WT_E_RANGE where there is no layer, or one that grows without end. */
wt_status growth_make(const wt_sliding *sliding, const wt_layer_job *layer,
                      const wt_layer_observation *known, const measured_step *at,
                      const wt_job *work, growth *g, wt_error *err) WT_NODISCARD;
void growth_clear(growth *g);

/* Of the values themselves (k = 0) or of draw k - 1. */
double growth_number_of(const growth *g, size_t k, growth_number number);
course growth_course(const growth *g, size_t k);
/* Friction at a time. */
double growth_friction(const growth *g, size_t k, double time);
/* Standard deviation of what `of` gives of the draws that tell it; NaN of fewer than two. */
typedef double growth_value(const growth *g, size_t k, double time);
double growth_scatter(const growth *g, growth_value *of, double time);

#endif
