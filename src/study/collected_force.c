/* Force against indentation of all cases and of paired groups: bulk, wear tracks and comparison
 * measurements such as a filler particle.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/collect.h"

#include "core/table/table_rows.h"

#include <stdio.h>
#include <string.h>

TABLE_ROW(collected_force, COLLECTED_FORCE, const char *sample, *condition, *place;
          double indentation, force;)

const char *collected_group_name(const collected_case *c, const char *group)
{
    return strcmp(group, "bulk") == 0 ? group : c->condition[0] != '\0' ? c->condition : "track";
}

static wt_status bind_force(const wt_result *result, const char *file, table_view *force,
                            wt_error *err)
{
    const wt_status status = table_bind_result(result, &force_indentation_schema, "", force, err);
    if (status != WT_OK)
        wt_error_file(err, file);
    return status;
}

/* Groups that belong to no case, with the index of the group that is added. */
typedef struct paired_force {
    const collected_case *cases;
    const wt_collected_result *of;
    size_t n_cases, n, at;
} paired_force;

static bool has_group(const wt_collected_result *of, const char *group)
{
    table_view force;
    const bool bound =
        table_bind_result(of->result, &force_indentation_schema, "", &force, NULL) == WT_OK;
    for (size_t row = 0; bound && row < force.n_rows; row++)
        if (strcmp(force_indentation_text(&force, row, FORCE_INDENTATION_GROUP), group) == 0)
            return true;
    return false;
}

/* True if the name is used by another group. Without --group every indented sample is "bulk". */
static bool is_name_used(const paired_force *b, const char *group)
{
    bool taken = strcmp(group, "bulk") == 0 || strcmp(group, "track") == 0;
    for (size_t i = 0; i < b->n_cases && !taken; i++)
        taken = strcmp(group, b->cases[i].condition) == 0;
    for (size_t i = 0; i < b->n && !taken; i++)
        taken = i != b->at && has_group(&b->of[i], group);
    return taken;
}

static void format_group_name(const paired_force *paired, const collected_case *c,
                              const char *group, char *place, size_t size)
{
    if (paired == NULL)
        (void)snprintf(place, size, "%s", collected_group_name(c, group));
    else if (is_name_used(paired, group))
        (void)snprintf(place, size, "%s of %s", group, paired->of[paired->at].file);
    else
        (void)snprintf(place, size, "%s", group);
}

/* Adds the curve of each group. A paired group is listed under each sample. */
static void add_force_curves(table_writer *w, const collected_case *c, const table_view *force,
                             const paired_force *paired)
{
    const char *before = NULL;
    char place[400] = "";
    for (size_t row = 0; row < force->n_rows; row++) {
        const char *group = force_indentation_text(force, row, FORCE_INDENTATION_GROUP);
        if (before == NULL || strcmp(group, before) != 0) {
            table_block(w);
            format_group_name(paired, c, group, place, sizeof place);
        }
        before = group;
        TABLE_ADD(collected_force, w, c->sample, paired == NULL ? c->condition : "", place,
                  force_indentation_get(force, row, FORCE_INDENTATION_INDENTATION),
                  force_indentation_get(force, row, FORCE_INDENTATION_FORCE));
    }
}

static wt_status add_paired_groups(table_writer *w, paired_force paired, const collected_case *c,
                                   wt_error *err)
{
    for (paired.at = 0; paired.at < paired.n; paired.at++) {
        const wt_collected_result *of = &paired.of[paired.at];
        table_view force;
        const wt_status status = bind_force(of->result, of->file, &force, err);
        if (status != WT_OK)
            return status;
        add_force_curves(w, c, &force, &paired);
    }
    return WT_OK;
}

wt_status collect_force(const collected_case *cases, size_t n, const wt_collected_result *paired,
                        size_t n_beside, wt_table **table, wt_error *err)
{
    const paired_force all = {cases, paired, n, n_beside, 0};
    table_writer w = table_begin(&collected_force_schema, err);
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        table_view force;
        status = bind_force(cases[i].result, cases[i].file, &force, err);
        if (status == WT_OK)
            add_force_curves(&w, &cases[i], &force, NULL);
        if (status == WT_OK && (i + 1 == n || strcmp(cases[i].sample, cases[i + 1].sample) != 0))
            status = add_paired_groups(&w, all, &cases[i], err);
    }
    const wt_status ended = table_end(&w, table);
    if (status == WT_OK)
        status = ended;
    if (status == WT_OK && wt_table_n_rows(*table) > 0)
        return WT_OK;
    wt_table_free(*table);
    *table = NULL;
    return status;
}
