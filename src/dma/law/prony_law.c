/* Moduli of a Prony series. SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/law/prony_law.h"

void prony_moduli(const wt_prony *series, double omega, double *storage, double *loss)
{
    *storage = series->equilibrium_modulus;
    *loss = 0;
    for (size_t i = 0; i < series->n; i++)
        prony_add_term(series->modulus[i], series->relaxation_time[i], omega, storage, loss);
}
