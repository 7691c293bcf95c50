/* Formats numbers and result values for the sentences of an answer. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "case/answer/format_number.h"

#include "core/base/clocale.h"
#include "core/base/number.h"
#include "core/math/students_t.h"
#include "weartrack/indentation.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

void text_append(text_builder *t, const char *format, ...)
{
    const bool room = t->used < t->size;
    va_list arguments;
    va_start(arguments, format);
    const int n = clocale_vprint(room ? t->text + t->used : NULL, room ? t->size - t->used : 0,
                                 format, arguments);
    va_end(arguments);
    t->used += n > 0 ? (size_t)n : 0;
}

/* Specific wear rate [mm^3/(N m)] of 1 m^2/N. */
#define MM3_PER_N_M 1e9

static void format_digits(double value, int digits, number_text *words)
{
    clocale_print(words->text, sizeof words->text, "%#.*g", digits, value);
    const size_t length = strlen(words->text);
    if (words->text[length - 1] == '.') /* all digits stand before the decimal point */
        words->text[length - 1] = '\0';
}

static number_text format_with_digits(double value, const char *unit, int digits)
{
    number_text result = {""};
    if (isnan(value))
        snprintf(result.text, sizeof result.text, "not known");
    else if (isinf(value))
        snprintf(result.text, sizeof result.text, "without limit");
    else if (strcmp(unit, "1") == 0)
        format_digits(value, digits, &result);
    else if (strcmp(unit, "m^2/N") == 0 && value != 0) {
        format_digits(MM3_PER_N_M * value, digits, &result);
        clocale_append(result.text, sizeof result.text, " mm^3/(N m)");
    } else if (value == 0) /* An exact zero has no significant digits. */
        snprintf(result.text, sizeof result.text, "0 %s", unit);
    else
        wt_format_si(value, unit, digits, result.text, sizeof result.text);
    return result;
}

number_text format_with_unit(double value, const char *unit)
{
    return format_with_digits(value, unit, 3);
}

number_text format_pair(double low, double high, int digits)
{
    number_text result = {""};
    digits = range_digits(low, high, digits);
    const double larger = fmax(fabs(low), fabs(high));
    const int decimals = larger > 0 ? digits - 1 - (int)floor(log10(larger)) : 0;
    const bool plain = decimals >= 0 && decimals < 9; /* otherwise with a power of ten */
    clocale_print(result.text, sizeof result.text,
                  plain ? "from %.*f to %.*f" : "from %.*g to %.*g", plain ? decimals : digits, low,
                  plain ? decimals : digits, high);
    return result;
}

number_text format_value(wt_estimate e)
{
    return format_with_unit(e.value, e.unit);
}

/* Value and error have one scale and the same decimals, with two digits of the error: "3.16 ± 0.96
 * um", "0.1050 ± 0.0029", "1230 ± 230 s"; "3.16 um (error not known)". Like on the page, the value
 * has at most six digits. */
number_text format_estimate(wt_estimate e)
{
    number_text value = format_with_unit(e.value, e.unit), words = value;
    if (isfinite(e.value) && isnan(e.standard_error))
        snprintf(words.text, sizeof words.text, "%.60s (error not known)", value.text);
    if (!isfinite(e.value) || !(e.standard_error > 0) || !isfinite(e.standard_error))
        return words;
    const char *suffix = strchr(value.text, ' ');
    size_t length = suffix == NULL ? strlen(value.text) : (size_t)(suffix - value.text);
    double shown = (double)NAN;
    if (!wt_number_parse(value.text, length, '.', &shown) || !(fabs(shown) > 0))
        return words;
    const double scale = pow(10.0, round(log10(fabs(shown / e.value))));
    const double error = e.standard_error * scale;
    const int most = 5 - (int)floor(log10(fabs(shown))),
              needed = 1 - (int)floor(log10(error) + 1e-9);
    if (most < 0 || most > 9 ||
        error >= 1e6) /* with a power of ten, or the error exceeds the plain notation */
        clocale_print(words.text, sizeof words.text, "%.*s \xc2\xb1 %.2g%.40s", (int)length,
                      value.text, error, suffix == NULL ? "" : suffix);
    else {
        const int decimals = needed < 0 ? 0 : needed < most ? needed : most;
        clocale_print(words.text, sizeof words.text,
                      needed <= most ? "%.*f \xc2\xb1 %.*f%.40s" : "%.*f \xc2\xb1 %.*g%.40s",
                      decimals, round_to_power_of_ten(e.value * scale, needed),
                      needed <= most ? decimals : 2, round_to_power_of_ten(error, needed),
                      suffix == NULL ? "" : suffix);
    }
    return words;
}

number_text format_estimate_interval(wt_estimate e, double low, double high)
{
    const int digits = result_value_digits(e.value, low, high);
    number_text result = format_with_digits(e.value, e.unit, digits);
    text_builder t = {result.text, sizeof result.text, strlen(result.text)};
    if (isfinite(e.value) && isnan(high))
        text_append(&t, " (error not known)");
    else if (isfinite(e.value) && high > e.value)
        text_append(&t, " (95 %%: %s to %s)", format_with_digits(low, e.unit, digits).text,
                    format_with_digits(high, e.unit, digits).text);
    return result;
}

number_text format_known_estimate(wt_estimate e)
{
    const double half = NORMAL_95 * e.standard_error;
    return format_estimate_interval(e, e.value - half, e.value + half);
}

number_text format_positive_estimate(wt_estimate e)
{
    const double factor = exp(NORMAL_95 * e.standard_error / e.value);
    return format_estimate_interval(e, e.value / factor, e.value * factor);
}

number_text format_celsius(double kelvin)
{
    number_text result;
    clocale_print(result.text, sizeof result.text,
                  "%.1f \xc2\xb0"
                  "C",
                  kelvin - WT_ZERO_CELSIUS);
    return result;
}

/* ---- result values --------------------------------------------------------------------------- */

/* A relative change is printed in percent. */
static bool is_relative_change(const result_value *f)
{
    return f->neutral == 0;
}

static number_text format_result_number(const result_value *f, double value, int digits)
{
    if (!is_relative_change(f) || !isfinite(value))
        return format_with_digits(value, f->number.unit, digits);
    const double half = 100 * (f->high - f->low) /
                        2; /* enough decimals to distinguish the limits of a narrow interval */
    const int decimals = half > 0 && half < 1 ? (int)fmin(3, ceil(-log10(half))) : 0;
    number_text result;
    clocale_print(result.text, sizeof result.text, "%+.*f %%", decimals, 100 * value);
    return result;
}

number_text format_plain_number(const result_value *f)
{
    return format_result_number(f, f->number.value,
                                result_value_digits(f->number.value, f->low, f->high));
}

result_value_text format_interval(const result_value *f)
{
    const int digits = result_value_digits(f->number.value, f->low, f->high);
    result_value_text result;
    if (isnan(f->low) || isnan(f->high))
        snprintf(result.text, sizeof result.text, "error not known");
    else
        clocale_print(result.text, sizeof result.text, "95 %% interval %s to %s",
                      format_result_number(f, f->low, digits).text,
                      format_result_number(f, f->high, digits).text);
    return result;
}

result_value_text format_model_range(const result_value *f)
{
    result_value_text result = {""};
    if (!isnan(f->range.low))
        clocale_print(result.text, sizeof result.text, "%s to %s over all choices of the model",
                      format_result_number(f, f->range.low, 3).text,
                      format_result_number(f, f->range.high, 3).text);
    return result;
}

result_value_text format_choices(const result_value *f)
{
    result_value_text result = {""};
    text_builder t = {result.text, sizeof result.text, 0};
    const result_value_range *r = &f->range;
    const struct {
        double value;
        const char *choice, *tried;
    } limits[2] = {{r->low, r->low_choice, r->low_tried}, {r->high, r->high_choice, r->high_tried}};
    for (int i = 0; i < 2 && !isnan(r->low); i++) {
        text_append(&t, "%s%s", i > 0 ? " to " : "over all choices of the model ",
                    format_result_number(f, limits[i].value, 3).text);
        if (limits[i].choice[0] != '\0')
            text_append(&t, " (%s: %s)", limits[i].choice, limits[i].tried);
        else
            text_append(&t, " (as used)");
    }
    return result;
}

result_value_text format_result_value(const result_value *f)
{
    const result_value_text range = format_model_range(f);
    result_value_text result;
    clocale_print(result.text, sizeof result.text, "%s (%s%s%s)", format_plain_number(f).text,
                  format_interval(f).text, range.text[0] != '\0' ? "; " : "", range.text);
    return result;
}

number_text format_frequency(const result_value *f)
{
    number_text result = {""};
    const number_text low = format_with_unit(f->frequency[0], "rad/s"),
                      high = format_with_unit(f->frequency[1], "rad/s");
    const bool one = strcmp(low.text, high.text) == 0;
    if (!isnan(f->frequency[0]))
        clocale_print(result.text, sizeof result.text, " at %.40s%s%.40s", low.text,
                      one ? "" : " to ", one ? "" : high.text);
    return result;
}

bool is_thickness_put_in(const result_value_tables *tables)
{
    return layer_key_enum(&tables->layer, LAYER_KEY_CRITICAL_ENERGY_FROM) == ENERGY_CALIBRATED;
}

const char *format_thickness_origin(const result_value_tables *tables)
{
    return is_thickness_put_in(tables) ? "put in, not predicted: U_c is calibrated to it"
                                       : "predicted from a given U_c";
}

/* The correction concerns the rates of both groups, if the moduli of all rates have a different
 * ratio. */
void append_rate_correction(text_builder *t, const result_value_tables *tables)
{
    const char *rates = comparison_key_text(&tables->comparison, COMPARISON_KEY_RATES);
    const double of_all = result_value_ratio_all_rates(tables);
    if (!isnan(of_all) && rates != NULL)
        text_append(t, ", for the rates are %s; the moduli of all rates have the ratio %s", rates,
                    format_with_unit(of_all, "1").text);
}

void append_modulus_ratio(text_builder *t, const result_value_tables *tables)
{
    const result_value ratio = result_value_ratio(tables);
    text_append(t, "%s", ratio.verdict != NULL ? ratio.verdict : "");
    if (isnan(ratio.low))
        return;
    text_append(t, "; E_track/E_bulk = %s%s", format_result_value(&ratio).text,
                format_frequency(&ratio).text);
    append_rate_correction(t, tables);
}

/* The ratio of one spot has no error. The text states that the interval lacks this contribution. */
static const char *missing_ratio_text(const result_value *f)
{
    return f->lacks_modulus_ratio && !isnan(f->low)
               ? ", without the error of the modulus ratio, which is not known"
               : "";
}

void append_thickness(text_builder *t, const result_value_tables *tables)
{
    const result_value thickness = result_value_thickness(tables);
    const result_value_text range = format_model_range(&thickness);
    const char *open = range.text[0] != '\0' ? " (" : "", *close = *open != '\0' ? ")" : "";
    if (isinf(thickness.number.value))
        text_append(t, "without wear the layer grows without end");
    else if (!(thickness.number.value > 0))
        text_append(t, "no layer where formation balances wear%s%s%s, %s", open, range.text, close,
                    format_thickness_origin(tables));
    else
        text_append(t, "layer of %s where formation balances wear, %s%s",
                    format_result_value(&thickness).text, format_thickness_origin(tables),
                    missing_ratio_text(&thickness));
}

void append_friction_change(text_builder *t, const result_value_tables *tables, bool with_choices)
{
    const result_value change = result_value_friction(tables, FRICTION_KEY_RELATIVE_CHANGE);
    const sign_verdict sign = result_value_sign(&change);
    const result_value_text range =
        with_choices ? format_choices(&change) : format_model_range(&change);
    const char *and = range.text[0] != '\0' ? "; " : "";
    if (!(friction_value(&tables->friction, FRICTION_KEY_LAYER_THICKNESS).value > 0)) {
        text_append(t, "no change, for wear leaves no layer%s%s", and, range.text);
        return;
    }
    text_append(t, "%s: %s (%s%s)%s%s",
                sign == SIGN_UNDECIDED ? "open whether the layer lowers or raises friction"
                : sign == SIGN_BELOW   ? "less friction with the layer"
                                       : "more friction with the layer",
                format_plain_number(&change).text, format_interval(&change).text,
                missing_ratio_text(&change), and, range.text);
}

/* ---- values of several sentences ------------------------------------------------------------- */

double largest_extrapolated_share(const table_view *friction)
{
    double share = 0;
    for (size_t i = 0; i < friction->n_rows; i++)
        share = fmax(share, friction_get(friction, i, FRICTION_EXTRAPOLATED_SHARE));
    return share;
}

number_text format_share(double share)
{
    number_text result;
    clocale_print(result.text, sizeof result.text, share >= 0.1 ? "%.0f %%" : "%.2g %%",
                  100 * share);
    return result;
}

bool find_dma_ratio(const table_view *dma, double *low, double *high)
{
    *low = *high = (double)NAN;
    for (size_t i = 0; i < dma->n_rows; i++) {
        if (strcmp(dma_comparison_text(dma, i, DMA_COMPARISON_GROUP), "bulk") != 0)
            continue;
        const double ratio = dma_comparison_get(dma, i, DMA_COMPARISON_RATIO);
        *low = fmin(*low, ratio);
        *high = fmax(*high, ratio);
    }
    return !isnan(*low);
}

bool is_different_rubber(double low, double high)
{
    return low < 1 / ANSWER_DMA_FACTOR || high > ANSWER_DMA_FACTOR;
}

size_t count_extrapolated(const table_view *dma)
{
    size_t n = 0;
    for (size_t i = 0; i < dma->n_rows; i++)
        n += dma_comparison_get(dma, i, DMA_COMPARISON_EXTRAPOLATED) > 0;
    return n;
}

bool append_spectrum_mismatch(text_builder *t, const table_view *indentation, const char *group)
{
    size_t tried = 0, others = 0;
    if (isnan(indentation_value(indentation, INDENTATION_KEY_SPECTRUM_TEMPERATURE).value))
        return false;
    for (size_t i = 0; i < indentation->n_rows; i++) {
        /* A curve without times cannot be tested against the relaxation spectrum. */
        if (isnan(indentation_get(indentation, i, INDENTATION_MODULUS)) ||
            isnan(indentation_get(indentation, i, INDENTATION_LOAD_TIME)))
            continue;
        tried++;
        others += isnan(indentation_get(indentation, i, INDENTATION_SPECTRUM_FACTOR)) ? 1 : 0;
    }
    if (others == 0)
        return false;
    text_append(
        t,
        "%zu of %zu curves of the %s do not fit the spectrum of the DMA and are fitted without it: "
        "another temperature than the stated one, another rubber, or a layer of another spectrum",
        others, tried, group);
    return true;
}

size_t format_rejected_curves(const table_view *indentation, char *text, size_t size)
{
    size_t counts[WT_CURVE_UNREADABLE + 1] = {0}, total = 0, used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < indentation->n_rows; i++) {
        const int verdict = indentation_enum(indentation, i, INDENTATION_VERDICT);
        if (verdict <= WT_CURVE_UNREADABLE)
            counts[verdict]++;
    }
    for (int v = WT_CURVE_DOUBTFUL + 1; v <= WT_CURVE_UNREADABLE; v++) {
        total += counts[v];
        if (counts[v] > 0 && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%zu %s", used > 0 ? ", " : "",
                                     counts[v], wt_curve_verdict_text((wt_curve_verdict)v));
    }
    return total;
}
