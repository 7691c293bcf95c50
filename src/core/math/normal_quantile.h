/* Quantile of the normal distribution. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_NORMAL_QUANTILE_H
#define WT_CORE_MATH_NORMAL_QUANTILE_H

/* Half width of the central 95 % interval, in standard deviations. */
#define NORMAL_95 1.959963984540054

#endif
