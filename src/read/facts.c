/* The table of facts that a reader fills for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/facts.h"

#include <math.h>

wt_status facts_new(wt_table **facts, wt_error *err)
{
    static const struct {
        const char *name, *long_name;
    } columns[] = {{"item", "what is known"},
                   {"value", "its value"},
                   {"unit", "unit of the value"},
                   {"source", "where in the file it stands, or how it is known"}};
    wt_table *table = wt_table_new("facts", "What the file is");
    if (table == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory to describe the file");
    wt_status status = WT_OK;
    for (size_t i = 0; i < sizeof columns / sizeof *columns && status == WT_OK; i++)
        status = wt_table_add_text_column(table, columns[i].name, columns[i].long_name, err);
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *facts = table;
    return WT_OK;
}

wt_status facts_add(wt_table *facts, const char *item, const char *value, const char *unit,
                    const char *source, wt_error *err)
{
    const char *cells[] = {item, value, unit, source};
    wt_status status = wt_table_add_row(facts, err);
    for (size_t i = 0; i < 4 && status == WT_OK; i++)
        status = wt_table_put_text(facts, i, cells[i], err);
    return status;
}

wt_status facts_number(wt_table *facts, const char *item, double value, const char *unit,
                       const char *source, wt_error *err)
{
    char text[32];
    wt_number_format(value, text);
    return facts_add(facts, item, isnan(value) ? "unknown" : text, unit, source, err);
}

wt_status facts_count(wt_table *facts, const char *item, size_t value, const char *source,
                      wt_error *err)
{
    char text[32];
    snprintf(text, sizeof text, "%zu", value);
    return facts_add(facts, item, text, "", source, err);
}
