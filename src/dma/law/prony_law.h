/* Internal interface: moduli of a Prony series. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_LAW_PRONY_LAW_H
#define WT_DMA_LAW_PRONY_LAW_H

#include "weartrack/core.h"

/* Above this value of z = omega tau the code uses z^2 for 1 + z^2 and does not compute z^2,
 * which could overflow. Any number between 1/DBL_EPSILON and the root of the largest double is
 * suitable. */
static const double prony_square_limit = 1e150;

/* Adds the contribution of one term: E z^2/(1 + z^2) to E' and E z/(1 + z^2) to E''. omega and
 * tau are positive or 0. */
static inline void prony_add_term(double modulus, double relaxation_time, double omega,
                                  double *storage, double *loss)
{
    const double z = omega * relaxation_time;
    const bool square = z < prony_square_limit;
    const double b = modulus * (square ? z / (1 + z * z) : 1 / omega / relaxation_time);
    *storage += square ? b * z : modulus;
    *loss += b;
}

/* Computes E' and E'' of a series at an angular frequency [rad/s], in the deformation of the
 * series. */
void prony_moduli(const wt_prony *series, double omega, double *storage, double *loss);

#endif
