/* Interval limits from replicates of a logarithm. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_REPLICATE_INTERVALS_H
#define WT_LAYER_REPLICATE_INTERVALS_H

#include "friction/replicates.h"

/* Number of replicates for quantiles: two of them lie beyond each limit of 95 %. */
enum { REPLICATES_FOR_QUANTILES = 80 };

/* Limits of the quantity whose logarithm is quantity k of the replicates, with this probability
 * beyond each limit. Replicates without a value count as above all others. Quantiles of some
 * hundred replicates scatter by a tenth of the interval, in the same direction for all results of a
 * seed. The draws are standard normal, however. Each replicate is therefore moved along the
 * parabola fit from its draw to the expected value of its rank. */
void replicate_interval(const replicates *r, size_t k, double tail_probability,
                        wt_interval *interval);

#endif
