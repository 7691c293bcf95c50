/* Summary lines of a case about the rubber. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer_context.h"
#include "case/answer/format_number.h"

#include <math.h>
#include <string.h>

struct law_text {
    char text[256];
};

/* Returns the shift law and its constants as text. */
static struct law_text shift_law_summary(const table_view *shift)
{
    struct law_text summary;
    const wt_estimate c1 = shift_factors_value(shift, SHIFT_FACTORS_KEY_WLF_C1),
                      energy = shift_factors_value(shift, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY);
    if (isnan(c1.value) && isnan(energy.value))
        snprintf(summary.text, sizeof summary.text, "no law of the shift factors");
    else if (isnan(c1.value))
        snprintf(summary.text, sizeof summary.text, "Arrhenius with %s",
                 format_known_estimate(energy).text);
    else
        snprintf(summary.text, sizeof summary.text, "WLF C1 = %s, C2 = %s%s",
                 format_known_estimate(c1).text,
                 format_known_estimate(shift_factors_value(shift, SHIFT_FACTORS_KEY_WLF_C2)).text,
                 isnan(energy.value) ? "" : ", Arrhenius in the cold");
    return summary;
}

void answer_rubber(const answer_context *context)
{
    const table_view *shift = &context->shift_factors, *prony = &context->prony;
    if (shift->table == NULL || prony->table == NULL || context->values.comparison.table != NULL ||
        context->values.friction.table != NULL)
        return;
    const double reference =
        shift_factors_value(shift, SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE).value;
    const wt_estimate equilibrium = prony_value(prony, PRONY_KEY_EQUILIBRIUM_MODULUS),
                      limit = prony_value(prony, PRONY_KEY_EQUILIBRIUM_LIMIT);
    const char *verdict = shift_factors_key_text(shift, SHIFT_FACTORS_KEY_SUPERPOSITION);
    const bool holds = shift_factors_key_enum(shift, SHIFT_FACTORS_KEY_SUPERPOSITION) ==
                       WT_SUPERPOSITION_HOLDS; /* otherwise a remark states the verdict */
    answer_add_sentence(context, "What is the rubber like?", ANSWER_KIND_MATERIAL,
                        "At %s, from %zu isotherms: %s; equilibrium modulus %s%s (%s).%s%s%s",
                        format_celsius(reference).text, shift->n_rows,
                        shift_law_summary(shift).text, isnan(limit.value) ? "" : "at most ",
                        format_known_estimate(isnan(limit.value) ? equilibrium : limit).text,
                        prony_key_text(prony, PRONY_KEY_DEFORMATION),
                        holds ? " Time-temperature superposition " : "", holds ? verdict : "",
                        holds ? "." : "");
}
