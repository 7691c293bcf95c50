/* Formatted numbers and reasons for limits and methods. Internal to case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_FORMAT_NUMBER_H
#define WT_CASE_ANSWER_FORMAT_NUMBER_H

#include "core/table/result_value.h"

/* Largest ratio of the moduli of indentation and DMA for one rubber. A larger ratio is not
 * explained by strain and equivalent frequency. */
#define ANSWER_DMA_FACTOR 3.0
/* Smallest share of the friction that is worth a remark. */
#define ANSWER_SHARE_MIN 0.01

/* Text in a buffer of fixed size; longer text is truncated. */
typedef struct text_builder {
    char *text;
    size_t size, used;
} text_builder;
void text_append(text_builder *t, const char *format, ...) WT_PRINTF(2, 3);

/* Text of a number, such as "1.15 um", returned by value for use in a format. */
typedef struct number_text {
    char text[96];
} number_text;

/* Formats a value with its unit. A specific wear rate [m^2/N] is printed in mm^3/(N m). */
number_text format_with_unit(double value, const char *unit);
/* "2 %", or "2 % to 5 %" if both differ as they are shown. */
number_text format_range_with_unit(double low, double high, const char *unit);
number_text format_value(wt_estimate estimate);    /* without its errors */
number_text format_estimate(wt_estimate estimate); /* with ± the standard error, if it is known */
number_text format_celsius(double kelvin);
/* Example: " at 0.784 rad/s to 87.9 rad/s"; "" if the frequency is unknown. */
number_text format_frequency(const result_value *f);
bool is_thickness_put_in(const result_value_tables *tables);

/* ---- values of several sentences ------------------------------------------------------------- */

/* Largest share of the hysteresis friction from frequencies outside the measured range. */
double largest_extrapolated_share(const table_view *friction);
/* Finds the smallest and largest ratio of the moduli of indentation and DMA of the bulk. False
 * without a ratio. The track is not compared: its layer may differ. */
bool find_dma_ratio(const table_view *dma, double *low, double *high);
bool is_different_rubber(double low, double high);
size_t count_extrapolated(const table_view *dma);
/* Example: "3 of 48 curves of the bulk do not fit the spectrum of the DMA ...". False without
 * output if all tested curves agree, or none was tested. */
bool append_spectrum_mismatch(text_builder *t, const table_view *indentation, const char *group);
/* Writes the reasons of the rejected curves, such as "3 poor fit, 1 saturated", and returns the
 * number of these curves. */
size_t format_rejected_curves(const table_view *indentation, char *text, size_t size);

#endif
