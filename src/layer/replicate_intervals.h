/* The ends of an interval by replicates of a logarithm. Internal to layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_REPLICATE_INTERVALS_H
#define WT_LAYER_REPLICATE_INTERVALS_H

#include "friction/replicates.h"

/* So many that two lie beyond either end of 95 %. */
enum { REPLICATES_FOR_ENDS = 80 };

/* Low and high of the number whose logarithm the replicates have as number k: such a part of them
 * lies beyond either end, those without a number above the last that has one. Ends of some hundred
 * replicates scatter by a tenth of the interval and, as the draws of a seed are always the same, to
 * the same side in all that a user computes. What is drawn is standard normal, though: each
 * replicate is moved along the line, bent as the replicates are, from where it was drawn to where
 * one of its rank is to be expected. Nothing is changed without memory. */
wt_status replicate_interval(const replicates *r, size_t k, double beyond,
                             wt_interval *interval) WT_NODISCARD;

#endif
