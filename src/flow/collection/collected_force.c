/* Force against indentation of all cases, and of groups beside them: bulk, wear tracks and what was
 * indented for comparison, such as a particle of the filler, in one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/collection/collect.h"

#include "data/tables/rows.h"

#include <string.h>

TABLE_ROW(collected_force, COLLECTED_FORCE, const char *sample, *condition, *place;
          double indentation, force;)

const char *collected_place(const collected_case *c, const char *group)
{
    return strcmp(group, "bulk") == 0 ? group : c->condition[0] != '\0' ? c->condition : "track";
}

static wt_status bind_force(const wt_result *result, const char *file, table_view *force,
                            wt_error *err)
{
    const wt_status status = table_bind_of(result, &force_indentation_schema, "", force, err);
    if (status != WT_OK)
        wt_error_file(err, file);
    return status;
}

/* The curve of each group; of no case under the sample that it stands beside. */
static void add_curves(table_writer *w, const collected_case *c, const table_view *force,
                       const char *sample)
{
    const char *before = NULL;
    for (size_t row = 0; row < force->n_rows; row++) {
        const char *group = force_indentation_text(force, row, FORCE_INDENTATION_GROUP);
        if (before == NULL || strcmp(group, before) != 0)
            table_block(w);
        before = group;
        TABLE_ADD(collected_force, w, sample, c != NULL ? c->condition : "",
                  c != NULL ? collected_place(c, group) : group,
                  force_indentation_get(force, row, FORCE_INDENTATION_INDENTATION),
                  force_indentation_get(force, row, FORCE_INDENTATION_FORCE));
    }
}

static wt_status add_beside(table_writer *w, const wt_collected *beside, size_t n,
                            const char *sample, wt_error *err)
{
    for (size_t i = 0; i < n; i++) {
        table_view force;
        const wt_status status = bind_force(beside[i].result, beside[i].file, &force, err);
        if (status != WT_OK)
            return status;
        add_curves(w, NULL, &force, sample);
    }
    return WT_OK;
}

wt_status collect_force(const collected_case *cases, size_t n, const wt_collected *beside,
                        size_t n_beside, wt_table **table, wt_error *err)
{
    table_writer w = table_begin(&collected_force_schema, err);
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        table_view force;
        status = bind_force(cases[i].result, cases[i].file, &force, err);
        if (status == WT_OK)
            add_curves(&w, &cases[i], &force, cases[i].sample);
        if (status == WT_OK && (i + 1 == n || strcmp(cases[i].sample, cases[i + 1].sample) != 0))
            status = add_beside(&w, beside, n_beside, cases[i].sample, err);
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
