/* Numbers in the sentences of an answer. SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/answer/words.h"

#include "base/clocale.h"
#include "base/number.h"
#include "weartrack/fit.h"

#include <math.h>
#include <string.h>

number_words words_of(double value, const char *unit)
{
    number_words words = {""};
    if (isnan(value))
        snprintf(words.text, sizeof words.text, "not known");
    else if (isinf(value))
        snprintf(words.text, sizeof words.text, "without limit");
    else if (strcmp(unit, "1") == 0)
        clocale_print(words.text, sizeof words.text, "%.3g", value);
    else
        wt_format_si(value, unit, 3, words.text, sizeof words.text);
    return words;
}

number_words words_of_value(wt_estimate e)
{
    return words_of(e.value, e.unit);
}

/* Value and error in one scale and with the same decimals, two digits of the error: "3.16 ± 0.96
 * um", "0.1050 ± 0.0029", "1230 ± 230 s"; "3.16 um (error not known)". As on the page, six digits
 * at most. */
number_words words_of_estimate(wt_estimate e)
{
    number_words value = words_of(e.value, e.unit), words = value;
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
    if (most < 0 || most > 9 || error >= 1e6) /* with a power of ten, or no number any more */
        clocale_print(words.text, sizeof words.text, "%.*s \xc2\xb1 %.2g%.40s", (int)length,
                      value.text, error, suffix == NULL ? "" : suffix);
    else {
        const int decimals = needed < 0 ? 0 : needed < most ? needed : most;
        clocale_print(words.text, sizeof words.text,
                      needed <= most ? "%.*f \xc2\xb1 %.*f%.40s" : "%.*f \xc2\xb1 %.*g%.40s",
                      decimals, number_to_tens(e.value * scale, needed),
                      needed <= most ? decimals : 2, number_to_tens(error, needed),
                      suffix == NULL ? "" : suffix);
    }
    return words;
}

number_words words_of_celsius(double kelvin)
{
    number_words words;
    clocale_print(words.text, sizeof words.text,
                  "%.1f \xc2\xb0"
                  "C",
                  kelvin - WT_ZERO_CELSIUS);
    return words;
}

size_t words_of_rejected(const table_view *indentation, char *text, size_t size)
{
    size_t counts[WT_CURVE_UNREADABLE + 1] = {0}, total = 0, used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < indentation->n_rows; i++) {
        const char *verdict = indentation_text(indentation, i, INDENTATION_VERDICT);
        for (int v = WT_CURVE_ACCEPTED + 1; v <= WT_CURVE_UNREADABLE; v++)
            if (strcmp(verdict, wt_curve_verdict_id((wt_curve_verdict)v)) == 0)
                counts[v]++;
    }
    for (int v = WT_CURVE_ACCEPTED + 1; v <= WT_CURVE_UNREADABLE; v++) {
        total += counts[v];
        if (counts[v] > 0 && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%zu %s", used > 0 ? ", " : "",
                                     counts[v], wt_curve_verdict_text((wt_curve_verdict)v));
    }
    return total;
}
