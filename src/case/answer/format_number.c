/* Formats numbers and result values for the sentences of an answer. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "case/answer/format_number.h"

#include "core/base/number.h"
#include "core/base/text.h"
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

/* Digits of a value without an error, as in the rows of a result. */
enum { UNIT_DIGITS = 3 };

number_text format_with_unit(double value, const char *unit)
{
    return format_with_digits(value, unit, UNIT_DIGITS);
}

number_text format_range_with_unit(double low, double high, const char *unit)
{
    number_text words = format_with_unit(low, unit);
    if (!(round_to_digits(high, UNIT_DIGITS) <= round_to_digits(low, UNIT_DIGITS)))
        clocale_append(words.text, sizeof words.text, " to %.40s",
                       format_with_unit(high, unit).text);
    return words;
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

number_text format_frequency(const result_value *f)
{
    number_text result = {""};
    if (!isnan(f->frequency[0]))
        clocale_print(result.text, sizeof result.text, " at %.100s",
                      format_range_with_unit(f->frequency[0], f->frequency[1], "rad/s").text);
    return result;
}

bool is_thickness_put_in(const result_value_tables *tables)
{
    return layer_key_enum(&tables->layer, LAYER_KEY_CRITICAL_ENERGY_FROM) == ENERGY_CALIBRATED;
}

/* ---- values of several sentences ------------------------------------------------------------- */

double largest_extrapolated_share(const table_view *friction)
{
    double share = 0;
    for (size_t i = 0; i < friction->n_rows; i++)
        share = fmax(share, friction_get(friction, i, FRICTION_EXTRAPOLATED_SHARE));
    return share;
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
