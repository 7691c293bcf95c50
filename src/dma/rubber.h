/* The rubber that later stages use: its laws and tables. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_RUBBER_H
#define WT_DMA_RUBBER_H

#include "job/inputs.h"
#include "weartrack/dma.h"

/* Computes the series of a rubber at a temperature [K] in Young's moduli [Pa]. The caller clears
 * `prony`, also on failure. */
wt_status flow_rubber_spectrum(const wt_rubber *rubber, double temperature, wt_prony *prony,
                               char statement[256], wt_error *err) WT_NODISCARD;

void flow_rubber_clear_draws(wt_rubber *rubber);
/* Returns the shift law of a replicate. Errors of stated constants are not drawn. */
wt_shift_law flow_rubber_shift_law(const wt_rubber *rubber, uint64_t seed, size_t replicate);
/* Returns true if the shift law reaches the temperature [K] (NaN: the reference). Otherwise the
 * error states the reason. */
bool flow_rubber_can_shift(const wt_rubber *rubber, double temperature, wt_error *reason);
/* Parameters of a fractional Zener material, and the material as a rubber after a check of its
 * law. */
wt_zener flow_zener_defaults(void);
const wt_params *flow_zener_params(void);
wt_status flow_rubber_zener(const wt_zener *zener, double poisson_ratio, wt_rubber *rubber,
                            wt_error *err) WT_NODISCARD;
/* Reads a table of moduli as a rubber and checks its points. */
wt_status flow_rubber_read(flow_file *file, double poisson_ratio, const wt_job *work,
                           wt_rubber *rubber, wt_error *err) WT_NODISCARD;

/* Returns true if at least one point has a standard error. */
bool strain_softening_has_errors(const wt_strain_softening *softening);
/* Describes the source and the error of the softening. */
void strain_softening_describe(const wt_strain_softening *softening, char *text, size_t size);
/* Creates a copy without errors for a replicate (WT_NO_REPLICATE: unchanged). The caller clears
 * it. */
wt_strain_softening strain_softening_draw(const wt_strain_softening *softening, uint64_t seed,
                                          size_t replicate);

#endif
