/* The table of stages. SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/plan/stages.h"

#define B(thing) FLOW_BIT(FLOW_##thing)
#define STAGE_ROW(id, name, title, needs, gives, step)                                             \
    [FLOW_STAGE_##id] = {#name, title, needs, gives},
const flow_stage flow_stages[FLOW_N_STAGES] = {STAGES(STAGE_ROW)};
