/* Binds the tables of an answer, and adds its sentences. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "case/answer/answer_context.h"

#include "core/base/array.h"
#include "core/base/clocale.h"

#include <string.h>

/* Length of a sentence in bytes; longer sentences are truncated. */
enum { LONGEST = 1200 };

static void add_answer_row(const answer_context *context, const char *question, answer_kind kind,
                           const char *text)
{
    table_row(context->answer);
    answer_put_text(context->answer, ANSWER_QUESTION, question);
    answer_put_text(context->answer, ANSWER_ANSWER, text);
    answer_put_text(context->answer, ANSWER_KIND, answer_kind_text(kind));
}

void answer_add_sentence(const answer_context *context, const char *question, answer_kind kind,
                         const char *format, ...)
{
    char text[LONGEST];
    va_list list;
    va_start(list, format);
    clocale_vprint(text, sizeof text, format, list);
    va_end(list);
    add_answer_row(context, question, kind, text);
}

wt_status answer_context_bind(answer_context *context, const wt_result *result, wt_error *err)
{
    const struct {
        const table_schema *schema;
        const char *suffix;
        table_view *view;
    } tables[] = {
        {&indentation_schema, "bulk", &context->indentation[0]},
        {&indentation_schema, "track", &context->indentation[1]},
        {&modulus_depth_schema, "", &context->modulus_depth},
        {&dma_comparison_schema, "", &context->dma_comparison},
        {&shift_factors_schema, "", &context->shift_factors},
        {&prony_schema, "", &context->prony},
        {&softening_schema, "", &context->softening},
        {&flash_schema, "", &context->flash},
        {&roughness_schema, "", &context->roughness},
        {&power_spectrum_schema, "", &context->power_spectrum},
        {&surfaces_schema, "", &context->surfaces},
        {&record_schema, "", &context->record},
        {&wear_schema, "", &context->wear},
        {&validation_schema, "", &context->validation},
        {&validation_sources_schema, "", &context->validation_sources},
        {&validation_running_in_schema, "", &context->validation_running_in},
        {&track_layer_schema, "", &context->track_layer},
        {&identification_schema, "", &context->identification},
    };
    wt_status status = result_values_bind(result, &context->values, err);
    for (size_t i = 0; status == WT_OK && i < COUNT_OF(tables); i++)
        status = table_bind_result(result, tables[i].schema, tables[i].suffix, tables[i].view, err);
    return status;
}
