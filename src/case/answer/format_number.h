/* Numbers and reasons in the sentences of an answer. Internal to case. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CASE_ANSWER_FORMAT_NUMBER_H
#define WT_CASE_ANSWER_FORMAT_NUMBER_H

#include "core/table/result_value.h"

/* Indentation and DMA further apart than this factor do not describe one rubber: strain and the
 * equivalent frequency do not explain it. */
#define ANSWER_DMA_FACTOR 3.0
/* A share of the friction below this is not worth a remark. */
#define ANSWER_ODD_SHARE 0.01

/* A text that grows in a buffer, cut where that ends. */
typedef struct text_builder {
    char *text;
    size_t size, used;
} text_builder;
void text_append(text_builder *t, const char *format, ...) WT_PRINTF(2, 3);

/* "1.15 um" in a buffer of its own, for use in a format. */
typedef struct number_text {
    char text[96];
} number_text;

/* A specific wear rate, of m^2/N, is told in mm^3/(N m). */
number_text format_with_unit(double value, const char *unit);
number_text format_value(wt_estimate estimate);    /* without its errors */
number_text format_estimate(wt_estimate estimate); /* +- the standard error where it is known */
/* "1.20 s (95 %: 0.90 s to 1.50 s)", of a number that is no finding. */
number_text format_known_estimate(wt_estimate estimate);
/* The same, of a number above 0 whose error is a factor: the logarithm is normal. */
number_text format_positive(wt_estimate estimate);
/* The same, of ends that are known; NaN: they are not. */
number_text format_estimate_interval(wt_estimate estimate, double low, double high);
number_text format_celsius(double kelvin);
/* "from 0.6079 to 0.6080": plain numbers of equal decimals, so many digits of the larger or
 * more, where those do not tell them apart. */
number_text format_pair(double low, double high, int digits);

/* ---- findings -------------------------------------------------------------------------------- */

typedef struct result_value_text {
    char text[400];
} result_value_text;

/* "3.16 um", of a relative change "-18 %". */
number_text format_plain_number(const result_value *f);
/* "95 % interval 1.63 um to 4.69 um", or why there is none. */
result_value_text format_interval(const result_value *f);
/* "1.04 um to 10.8 um over all choices of the model", or "" */
result_value_text format_model_range(const result_value *f);
/* "over all choices of the model 1.04 um (...: 0.5) to 10.8 um (...)", or "" */
result_value_text format_choices(const result_value *f);
/* Number, and interval and range in brackets: "3.16 um (95 % interval 1.63 um to 4.69 um; 1.04 um
 * to 10.8 um over all choices of the model)". */
result_value_text format_result_value(const result_value *f);
/* " at 0.784 rad/s to 87.9 rad/s", or "" */
number_text format_frequency(const result_value *f);
/* The findings that answer the questions, as a sentence on standard error and on top of the answer.
 * "yes: the wear track is softer than the bulk; E_track/E_bulk = 0.666 (...) at ..." */
void append_ratio(text_builder *t, const result_value_tables *tables);
/* ", for the rates are ...; the moduli of all rates have the ratio 0.175", where it is another. */
void append_rates(text_builder *t, const result_value_tables *tables);
/* There is no balance because the rubber ages without load, not because nothing is worn. */
bool layer_ages(const result_value_tables *tables);
/* "layer of 3.16 um (...) where formation balances wear, predicted from a given U_c" */
void append_thickness(text_builder *t, const result_value_tables *tables);
/* Of a layer that acts back: what that makes of it. */
void append_balance(text_builder *t, const table_view *balances);
/* "open whether the layer lowers or raises friction: -18 % (...)" */
void append_change(text_builder *t, const result_value_tables *tables, bool with_choices);
/* Of tables with rows: "friction as measured 0.80 +- 0.01, after a running-in of 20 cycles" and
 * "specific wear rate ..." */
void append_record(text_builder *t, const table_view *record);
void append_wear(text_builder *t, const table_view *wear);
/* Critical energy and wear rate of a layer by each way to know them: "by thickness and wear rate
 * U_c = ... (95 %: ...), k = ... (...), correlation -0.98", and what they leave open. */
void append_identification(text_builder *t, const table_view *identification);
/* "one U_c and k in all 4 cases, by ...: one: U_c = ..." */
void append_shared_pairs(text_builder *t, const table_view *shared_pairs);
/* "the theory (friction with the layer) against the record: explains: ..." */
void append_verdict(text_builder *t, const table_view *validation);
/* "the running-in with the layer against the record: explains: ..." and what the time asks for */
void append_running_in_verdict(text_builder *t, const table_view *running_in);
void append_required_wear(text_builder *t, const table_view *running_in);
/* "the record asks for a shear stress of 5.01 MPa (...); plausible: yes: ...", where it is known */
void append_required_shear(text_builder *t, const table_view *validation);
/* "predicted from a given U_c" */
const char *format_origin(const result_value_tables *tables);

/* ---- what several sentences tell ------------------------------------------------------------- */

/* The largest share of the hysteresis from frequencies that were not measured; "less than 0.1 %" */
double largest_share(const table_view *friction);
number_text format_share(double share);
/* The ratio of indentation and DMA of the bulk, from its lowest to its highest; false: there is
 * none. The track may differ, for its layer. */
bool ratio_to_dma(const table_view *dma, double *low, double *high);
bool is_other_rubber(double low, double high);
size_t n_extrapolated(const table_view *dma);
/* "3 of 48 curves of the bulk are not of the spectrum of the DMA: ..."; false, and nothing told,
 * where all are, or none was tried. */
bool append_other_spectrum(text_builder *t, const table_view *indentation, const char *group);
/* "3 poor fit, 1 saturated" of the rejected curves; how many there are. */
size_t format_rejected_curves(const table_view *indentation, char *text, size_t size);

#endif
