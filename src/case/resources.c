/* Names of the resources of a plan, and the resources of tables and figures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/resources.h"

#include "core/base/array.h"
#include "core/table/registry.h"
#include "weartrack/report.h"

#include <limits.h>
#include <string.h>

#define SOURCE_ROW(id, text, lack, there) [FLOW_##id] = {.label = text, .missing = lack},
#define TABLE_ROW(id, text, of, group) [FLOW_##id] = {.label = text, .schema = of, .suffix = group},
#define INNER_ROW(id, text) [FLOW_##id] = {.label = text},
const flow_resource_row flow_resource_rows[FLOW_N_RESOURCES] = {
    SOURCES(SOURCE_ROW) TABLE_RESOURCES(TABLE_ROW) INNER_RESOURCES(INNER_ROW)};
_Static_assert(FLOW_N_RESOURCES <= CHAR_BIT * sizeof(flow_resource_set),
               "a set of things has a bit of each");

int flow_resources_count(flow_resource_set resources)
{
    const unsigned low = 64;
    return __builtin_popcountll((uint64_t)resources) +
           __builtin_popcountll((uint64_t)(resources >> low));
}

void flow_resources_list(flow_resource_set resources, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (unsigned i = 0; i < FLOW_N_RESOURCES && used < size; i++)
        if (resources & FLOW_BIT(i))
            used += (size_t)snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "",
                                     flow_resource_rows[i].label);
}

bool flow_table_resources(const char *table, flow_resource_set *resources)
{
    static const table_schema *const always[] = {
        &answer_schema, &limits_schema,   &inputs_schema, &methods_schema,
        &notes_schema,  &failures_schema, &cost_schema,   &data_quality_schema};
    *resources = 0;
    for (size_t i = 0; i < COUNT_OF(always); i++)
        if (strcmp(table, always[i]->name) == 0)
            return true;
    if (strcmp(table, force_displacement_schema.name) == 0 ||
        strcmp(table, force_indentation_schema.name) == 0)
        *resources = FLOW_BIT(FLOW_CURVE_BULK) | FLOW_BIT(FLOW_CURVE_TRACK);
    if (strcmp(table, curves_schema.name) == 0 || strcmp(table, overrides_schema.name) == 0)
        *resources = FLOW_BIT(FLOW_INDENTATION_BULK) | FLOW_BIT(FLOW_INDENTATION_TRACK);
    if (strcmp(table, modulus_depth_schema.name) == 0)
        *resources = FLOW_BIT(FLOW_DEPTH_BULK) | FLOW_BIT(FLOW_DEPTH_TRACK);
    for (unsigned i = FLOW_FIRST_TABLE; i < FLOW_FIRST_INNER; i++)
        if (flow_resource_rows[i].schema != NULL && strcmp(table, flow_resource_rows[i].label) == 0)
            *resources = FLOW_BIT(i);
    return *resources != 0;
}

bool flow_figure_resources(const char *figure, flow_resource_set *resources)
{
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const wt_figure_info info = wt_figure_get(i);
        if (strcmp(info.name, figure) != 0)
            continue;
        char names[128], *rest = NULL;
        const bool known = flow_table_resources(info.table, resources);
        snprintf(names, sizeof names, "%s", info.other_tables);
        for (const char *name = strtok_r(names, " ", &rest); name != NULL;
             name = strtok_r(NULL, " ", &rest)) {
            flow_resource_set more = 0;
            if (flow_table_resources(name, &more))
                *resources |= more;
        }
        return known;
    }
    return false;
}
