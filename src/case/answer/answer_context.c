/* Binds the tables of an answer. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "case/answer/answer.h"

#include "core/base/array.h"

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
        {&softening_schema, "", &context->softening},
        {&flash_schema, "", &context->flash},
        {&roughness_schema, "", &context->roughness},
        {&wear_schema, "", &context->wear},
    };
    wt_status status = result_values_bind(result, &context->values, err);
    for (size_t i = 0; status == WT_OK && i < COUNT_OF(tables); i++)
        status = table_bind_result(result, tables[i].schema, tables[i].suffix, tables[i].view, err);
    return status;
}
