/* The normal distribution. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_MATH_NORMAL_QUANTILE_H
#define WT_CORE_MATH_NORMAL_QUANTILE_H

/* 95 % lie within so many standard deviations of the mean. */
#define NORMAL_95 1.959963984540054

#endif
