/* Internal to the library: moduli of a Prony series. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_LAW_PRONY_LAW_H
#define WT_DMA_LAW_PRONY_LAW_H

#include "weartrack/data.h"

/* Beyond it 1 + z^2 is z^2 for z = omega tau, which is not made, for it would overflow: any number
 * between 1/DBL_EPSILON and the root of the largest double. */
static const double prony_square_limit = 1e150;

/* What a term adds: E z^2/(1 + z^2) to E' and E z/(1 + z^2) to E''. omega, tau > 0 as the public
 * header says, or 0. */
static inline void prony_add(double modulus, double relaxation_time, double omega, double *storage,
                             double *loss)
{
    const double z = omega * relaxation_time;
    const bool square = z < prony_square_limit;
    const double b = modulus * (square ? z / (1 + z * z) : 1 / omega / relaxation_time);
    *storage += square ? b * z : modulus;
    *loss += b;
}

/* E' and E'' of a series at an angular frequency [rad/s]. */
void prony_moduli(const wt_prony *series, double omega, double *storage, double *loss);

#endif
