/* What the answer says of a counter surface that was measured.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/answer/story.h"
#include "flow/answer/words.h"

#include <math.h>

void answer_surface(const answer_story *story)
{
    const table_view *const spectrum = &story->power_spectrum;
    if (spectrum->table == NULL)
        return;
    const double first = power_spectrum_get(spectrum, 0, POWER_SPECTRUM_WAVENUMBER),
                 last =
                     power_spectrum_get(spectrum, spectrum->n_rows - 1, POWER_SPECTRUM_WAVENUMBER);
    const wt_estimate places = power_spectrum_value(spectrum, POWER_SPECTRUM_KEY_PLACES_ERROR);
    const bool several = isfinite(places.value);
    const size_t n = story->surfaces.n_rows;
    answer_say(
        story, "What is the counter surface like?", "surface",
        "Measured, %zu scan%s: rms height %s, rms slope %s over waves from %s to %s. The "
        "errors of friction and contact area hold the scatter of its spectrum%s; shorter and "
        "longer waves are not counted.",
        n, n == 1 ? "" : "s",
        words_of_known(power_spectrum_value(spectrum, POWER_SPECTRUM_KEY_RMS_HEIGHT)).text,
        words_of_known(power_spectrum_value(spectrum, POWER_SPECTRUM_KEY_RMS_SLOPE)).text,
        words_of(2 * M_PI / first, "m").text, words_of(2 * M_PI / last, "m").text,
        several ? " and from place to place"
                : ", but not what another place of the surface would give");
}
