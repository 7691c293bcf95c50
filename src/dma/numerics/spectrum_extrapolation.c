/* How a spectrum goes on beyond what was measured.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum.h"

#include <math.h>

/* How far the relaxation times go beyond the measured range [decade]. E'' of a term that is faster
 * by 4.5 decades is 3e-5 of its modulus at the highest frequency: what is faster is no different
 * from a glass modulus to whatever was measured. Slow ones end after six decades: a second becomes
 * two weeks, and an hour a century. */
const double spectrum_fast_margin = 4.5, spectrum_slow_margin = 6.0;
/* So far beyond the ends the bends are those of the measured range, for E'' of such a term is a
 * tenth of its modulus at the end, so that it is measured, too [decade]. */
static const double near = 1.0;
/* Beyond, the slope d ln H/d ln tau goes from what it is at the end to a mean that is known of
 * rubber, and scatters about it, forgetting what it was over so many decades. Towards short times
 * it is 0, between the -1/2 of Rouse's chains, by which a transition rises (Ferry, Viscoelastic
 * Properties of Polymers, 1980, chapter 10), and as much beyond its peak: both lie within one
 * standard deviation. */
static const double fast_slope = 0.0, fast_scatter = 0.5, fast_reach = 2.0;
/* Towards long times networks relax by a power of time (Chasset and Thirion, Proc. Conf. Phys.
 * Non-Cryst. Solids, 1965; Curro and Pincus, Macromolecules 16 (1983) 559), of which exponents from
 * 0.1 to 0.4 are measured, and keep to it for decades. */
static const double slow_slope = -0.25, slow_scatter = 0.15, slow_reach = 4.0;

size_t spectrum_end(const spectrum *s, size_t place)
{
    return s->n_measured + (s->n_terms - s->n_measured) * (place + 1) / SPECTRUM_ENDS;
}

void spectrum_set_bends(spectrum *s)
{
    const size_t margin = (size_t)ceil(near * M_LN10 / s->step);
    s->bend_first = s->n_fast - margin;
    s->bend_end = s->n_measured + margin;
    const double keep[2] = {exp(-s->step / (fast_reach * M_LN10)),
                            exp(-s->step / (slow_reach * M_LN10))};
    const double scatter[2] = {fast_scatter * s->step, slow_scatter * s->step};
    const double slope[2] = {-fast_slope * s->step, slow_slope * s->step};
    for (int end = 0; end < 2; end++) { /* outwards */
        const double k = keep[end];
        s->beyond[end] =
            (spectrum_beyond){.weight = {end == 0 ? 1.0 : k, -1.0 - k, end == 0 ? k : 1.0},
                              .mean = (1.0 - k) * slope[end],
                              .precision = 1.0 / (scatter[end] * scatter[end] * (1.0 - k * k))};
    }
}
