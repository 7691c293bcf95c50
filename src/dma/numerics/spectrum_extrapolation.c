/* Prior of a spectrum beyond the measured range. SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include <math.h>

/* Extension of the relaxation times beyond the measured range [decade]. E'' of a term 4.5
 * decades faster is 3e-5 of its modulus at the highest frequency, so faster terms act as a glass
 * modulus. Six slow decades convert a second to two weeks and an hour to a century. */
const double spectrum_fast_margin = 4.5, spectrum_slow_margin = 6.0;
/* Distance beyond the ends with the measured prior [decade]. E'' of such a term is a tenth of
 * its modulus at the end, so it is measured. */
static const double measured_margin = 1.0;
/* Beyond that distance the slope d ln H/d ln tau tends to a mean known for rubber, with this
 * scatter and correlation length in decades. At short times the mean is 0. It lies between -1/2
 * of Rouse chains, the slope of a transition (Ferry, Viscoelastic Properties of Polymers, 1980,
 * chapter 10), and the opposite slope beyond its peak. */
static const double fast_slope = 0.0, fast_scatter = 0.5, fast_reach = 2.0;
/* At long times networks relax by a power of time (Chasset and Thirion, Proc. Conf. Phys.
 * Non-Cryst. Solids, 1965; Curro and Pincus, Macromolecules 16 (1983) 559). Measured exponents
 * are 0.1 to 0.4 and persist for decades. */
static const double slow_slope = -0.25, slow_scatter = 0.15, slow_reach = 4.0;

size_t spectrum_end_term(const spectrum *s, size_t place)
{
    return s->n_measured + (s->n_terms - s->n_measured) * (place + 1) / SPECTRUM_ENDS;
}

void spectrum_set_extrapolation(spectrum *s)
{
    const size_t margin = (size_t)ceil(measured_margin * M_LN10 / s->step);
    s->bend_first = s->n_fast - margin;
    s->bend_end = s->n_measured + margin;
    const double decay[2] = {exp(-s->step / (fast_reach * M_LN10)),
                             exp(-s->step / (slow_reach * M_LN10))};
    const double scatter[2] = {fast_scatter * s->step, slow_scatter * s->step};
    const double slope[2] = {-fast_slope * s->step, slow_slope * s->step};
    for (int end = 0; end < 2; end++) { /* in the outward direction */
        const double k = decay[end];
        s->beyond[end] = (spectrum_extrapolation){
            .weight = {end == 0 ? 1.0 : k, -1.0 - k, end == 0 ? k : 1.0},
            .mean = (1.0 - k) * slope[end],
            .precision = 1.0 / (scatter[end] * scatter[end] * (1.0 - k * k))};
    }
}
