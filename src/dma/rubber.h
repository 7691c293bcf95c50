/* The rubber as the stages after the DMA know it: its laws and tables.
 * Internal to dma. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_RUBBER_H
#define WT_DMA_RUBBER_H

#include "job/inputs.h"

/* The series of a rubber at a temperature in Young's moduli; to be cleared, also on failure. */
wt_status flow_rubber_spectrum(const wt_rubber *rubber, double temperature, wt_prony *prony,
                               char statement[256], wt_error *err) WT_NODISCARD;

void flow_rubber_drop_draws(wt_rubber *rubber);
/* The shift law of a replicate; the errors of constants that were given are not drawn. */
wt_shift_law flow_rubber_law(const wt_rubber *rubber, uint64_t seed, size_t replicate);
/* Whether the shift law takes the material to a temperature (NaN: the reference); if not, why. */
bool flow_rubber_reaches(const wt_rubber *rubber, double temperature, wt_error *why);
/* Factors by which times and moduli at the reference temperature become those at another one (NaN:
 * the reference): E(w) is E_reference(w a_T) / b_T; and what must be said of them, "" if nothing.
 */
typedef struct rubber_shift {
    double a, b;
    char statement[256];
} rubber_shift;
wt_status flow_rubber_shift(const wt_rubber *rubber, double temperature, rubber_shift *shift,
                            wt_error *err) WT_NODISCARD;
/* The parameters of a fractional Zener material, and those as a rubber, whose law is checked. */
wt_zener flow_zener_defaults(void);
const wt_params *flow_zener_params(void);
wt_status flow_rubber_zener(const wt_zener *zener, double poisson_ratio, wt_rubber *rubber,
                            wt_error *err) WT_NODISCARD;
/* A table of moduli as a rubber; its points are checked. */
wt_status flow_rubber_read(flow_file *file, const wt_rubber_options *options, double poisson_ratio,
                           const wt_job *work, wt_rubber *rubber, wt_error *err) WT_NODISCARD;

#endif
