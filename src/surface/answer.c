/* Summary lines of a case about the measured counter surface.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer_context.h"
#include "case/answer/format_number.h"

#include <math.h>

/* Appends the contribution of unresolved waves if the spectrum was extrapolated to them. */
static void append_extrapolation(text_builder *t, const answer_context *context)
{
    const table_view *const what_if = &context->values.what_if;
    const double end = power_spectrum_value(&context->power_spectrum, POWER_SPECTRUM_KEY_TO).value;
    const double share = what_if->table != NULL
                             ? what_if_value(what_if, WHAT_IF_KEY_SHARE_BEYOND).value
                             : (double)NAN;
    if (isfinite(share))
        text_append(
            t,
            " %s of the hysteresis is of waves shorter than %s, which were not resolved and follow "
            "the self-affine law of the others: errors hold the scatter of its constants, but not "
            "that the surface may leave it.",
            format_share(share).text, format_with_unit(2 * M_PI / end, "m").text);
}

void answer_surface(const answer_context *context)
{
    const table_view *const spectrum = &context->power_spectrum;
    if (spectrum->table == NULL)
        return;
    const double first = power_spectrum_get(spectrum, 0, POWER_SPECTRUM_WAVENUMBER),
                 last =
                     power_spectrum_get(spectrum, spectrum->n_rows - 1, POWER_SPECTRUM_WAVENUMBER);
    const double places = power_spectrum_value(spectrum, POWER_SPECTRUM_KEY_PLACES_ERROR).value;
    const size_t n = context->surfaces.n_rows;
    char text[900];
    text_builder t = {text, sizeof text, 0};
    text_append(
        &t,
        "Measured, %zu scan%s: rms height %s, rms slope %s over waves from %s to %s; longer and "
        "shorter ones are not counted.",
        n, n == 1 ? "" : "s",
        format_known_estimate(power_spectrum_value(spectrum, POWER_SPECTRUM_KEY_RMS_HEIGHT)).text,
        format_known_estimate(power_spectrum_value(spectrum, POWER_SPECTRUM_KEY_RMS_SLOPE)).text,
        format_with_unit(2 * M_PI / first, "m").text, format_with_unit(2 * M_PI / last, "m").text);
    append_extrapolation(&t, context);
    text_append(&t, " The errors of friction and contact area hold the scatter of its spectrum%s.",
                places > 0    ? " and from place to place"
                : places == 0 ? "; its places differ by no more than that"
                              : ", but not what another place of the surface would give");
    answer_add_sentence(context, "What is the counter surface like?", ANSWER_KIND_SURFACE, "%s",
                        text);
}
