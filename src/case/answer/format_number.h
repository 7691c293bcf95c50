/* Formatted numbers and reasons for the sentences of an answer. Internal to case.
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
number_text format_value(wt_estimate estimate);    /* without its errors */
number_text format_estimate(wt_estimate estimate); /* with ± the standard error, if it is known */
/* Example: "1.20 s (95 %: 0.90 s to 1.50 s)". The interval follows from a normal error. */
number_text format_known_estimate(wt_estimate estimate);
/* Variant for a positive number with a log-normal error. */
number_text format_positive_estimate(wt_estimate estimate);
/* Variant for given limits; NaN means that they are unknown. */
number_text format_estimate_interval(wt_estimate estimate, double low, double high);
number_text format_celsius(double kelvin);
/* Example: "from 0.6079 to 0.6080". Both numbers have the same decimals: `digits` significant
 * digits of the larger one, or more until the two texts differ. */
number_text format_pair(double low, double high, int digits);

/* ---- result values --------------------------------------------------------------------------- */

typedef struct result_value_text {
    char text[400];
} result_value_text;

/* Example: "3.16 um"; a relative change is "-18 %". */
number_text format_plain_number(const result_value *f);
/* Example: "95 % interval 1.63 um to 4.69 um", or the reason why there is no interval. */
result_value_text format_interval(const result_value *f);
/* Example: "1.04 um to 10.8 um over all choices of the model"; "" without model choices. */
result_value_text format_model_range(const result_value *f);
/* Example: "over all choices of the model 1.04 um (...: 0.5) to 10.8 um (...)"; "" without
 * choices. */
result_value_text format_choices(const result_value *f);
/* Number with interval and range in brackets: "3.16 um (95 % interval 1.63 um to 4.69 um; 1.04 um
 * to 10.8 um over all choices of the model)". */
result_value_text format_result_value(const result_value *f);
/* Example: " at 0.784 rad/s to 87.9 rad/s"; "" if the frequency is unknown. */
number_text format_frequency(const result_value *f);
/* The functions append_* write the main results, for the line on standard error and the summary of
 * the answer.
 * Example: "yes: the wear track is softer than the bulk; E_track/E_bulk = 0.666 (...) at ...". */
void append_modulus_ratio(text_builder *t, const result_value_tables *tables);
/* Example: ", for the rates are ...; the moduli of all rates have the ratio 0.175", if the ratios
 * differ. */
void append_rate_correction(text_builder *t, const result_value_tables *tables);
/* Example: "layer of 3.16 um (...) where formation balances wear, predicted from a given U_c". */
void append_thickness(text_builder *t, const result_value_tables *tables);
/* Example: "open whether the layer lowers or raises friction: -18 % (...)". */
void append_friction_change(text_builder *t, const result_value_tables *tables, bool with_choices);
/* Examples: "friction as measured 0.80 +- 0.01, after a running-in of 20 cycles" and "specific wear
 * rate ...". The tables have at least one row. */
void append_record(text_builder *t, const table_view *record);
void append_wear(text_builder *t, const table_view *wear);
/* Appends critical energy and wear rate of a layer for each method of identification: "by thickness
 * and wear rate U_c = ... (95 %: ...), k = ... (...), correlation -0.98", and the remaining
 * ambiguity. */
void append_identification(text_builder *t, const table_view *identification);
/* Example: "one U_c and k in all 4 cases, by ...: one: U_c = ...". */
void append_shared_pairs(text_builder *t, const table_view *shared_pairs);
/* Example: "the theory (friction with the layer) against the record: explains: ...". */
void append_verdict(text_builder *t, const table_view *validation);
/* Example: "the running-in with the layer against the record: explains: ...". The second function
 * appends the wear rate that the measured time requires. */
void append_running_in_verdict(text_builder *t, const table_view *running_in);
void append_required_wear(text_builder *t, const table_view *running_in);
/* Example: "the record asks for a shear stress of 5.01 MPa (...); plausible: yes: ...". Nothing is
 * appended if the stress is unknown. */
void append_required_shear(text_builder *t, const table_view *validation);
/* Example: "predicted from a given U_c". */
bool is_thickness_put_in(const result_value_tables *tables);
const char *format_thickness_origin(const result_value_tables *tables);

/* ---- values of several sentences ------------------------------------------------------------- */

/* Largest share of the hysteresis friction from frequencies outside the measured range. */
double largest_extrapolated_share(const table_view *friction);
number_text format_share(double share);
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
