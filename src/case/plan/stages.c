/* Table of the stages. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/plan/stages.h"

#include <stdio.h>

#define B(resource) FLOW_BIT(FLOW_##resource)

static const flow_optional_input optional_inputs[FLOW_N_OPTIONAL_INPUTS][FLOW_OPTIONAL_INPUTS_MAX] =
    {
        [FLOW_OPTIONAL_SPECTRUM] = {{B(RUBBER), ", by the spectrum of the material",
                                     "the spectrum of the material"}},
        [FLOW_OPTIONAL_RATE_CORRECTION] = {{B(RUBBER),
                                            ", at one rate and temperature by the material",
                                            "the material"}},
        [FLOW_OPTIONAL_TRACK] = {{B(INDENTATION_TRACK), " and wear track", "the wear track"}},
        [FLOW_OPTIONAL_LAYER] = {{B(LAYER) | B(MODULUS_RATIO), ", with and without the layer",
                                  "the layer"}},
        [FLOW_OPTIONAL_STEADY_STATE] = {{B(LAYER), ", beside that of the theory",
                                         "the thickness of the theory"}},
        [FLOW_OPTIONAL_WEAR] = {{B(WEAR), ", with the wear as measured", "the measured wear"}},
        [FLOW_OPTIONAL_THICKNESS] = {{B(LAYER_PARAMETERS), ", thickness of the layer", "the layer"},
                                     {B(MODULUS_RATIO), ", friction with it",
                                      "the modulus ratio of the layer"}},
};

#define STAGE_ROW(id, name, title, needs, any, additions, outputs, step)                           \
    [FLOW_STAGE_##id] = {#name, title, needs, any, optional_inputs[additions], outputs},
const flow_stage flow_stages[FLOW_N_STAGES] = {STAGES(STAGE_ROW)};

unsigned flow_stage_levels(size_t stage)
{
    unsigned n = 0;
    while (n < FLOW_OPTIONAL_INPUTS_MAX && flow_stages[stage].optional_inputs[n].resources != 0)
        n++;
    return n;
}

flow_resource_set flow_stage_needs(size_t stage, unsigned level)
{
    flow_resource_set needs = flow_stages[stage].needs;
    for (unsigned i = 0; i < level; i++)
        needs |= flow_stages[stage].optional_inputs[i].resources;
    return needs;
}

void flow_stage_title(size_t stage, unsigned level, char *text, size_t size)
{
    const flow_stage *s = &flow_stages[stage];
    size_t used = (size_t)snprintf(text, size, "%s", s->title);
    for (unsigned i = 0; i < level && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s", s->optional_inputs[i].title);
}
