/* The list of facts that a reader fills for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/facts.h"

#include "base/clocale.h"

#include <math.h>
#include <stdlib.h>

wt_status facts_new(fact_list *facts, wt_error *err)
{
    static const struct {
        const char *name, *long_name;
    } columns[] = {{"item", "what is known"},
                   {"value", "its value"},
                   {"unit", "unit of the value"},
                   {"source", "where in the file it stands, or how it is known"}};
    *facts = (fact_list){.table = wt_table_new("facts", "What the file is"), .err = err};
    if (facts->table == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory to describe the file");
    for (size_t i = 0; i < sizeof columns / sizeof *columns && facts->status == WT_OK; i++)
        facts->status =
            wt_table_add_text_column(facts->table, columns[i].name, columns[i].long_name, err);
    if (facts->status != WT_OK)
        wt_table_free(facts->table);
    return facts->status;
}

static char *print(const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    const int n = clocale_vprint(NULL, 0, format, arguments);
    char *text = n < 0 ? NULL : malloc((size_t)n + 1);
    if (text != NULL)
        (void)clocale_vprint(text, (size_t)n + 1, format, again);
    va_end(again);
    return text;
}

void facts_add(fact_list *facts, const char *item, const char *unit, const char *source,
               const char *format, ...)
{
    if (facts->status != WT_OK)
        return;
    va_list arguments;
    va_start(arguments, format);
    char *value = print(format, arguments);
    va_end(arguments);
    const char *const cells[] = {item, value, unit, source};
    facts->status = value != NULL
                        ? wt_table_add_row(facts->table, facts->err)
                        : wt_fail(facts->err, WT_E_MEMORY, "no memory to describe the file");
    for (size_t i = 0; i < sizeof cells / sizeof *cells && facts->status == WT_OK; i++)
        facts->status = wt_table_put_text(facts->table, i, cells[i], facts->err);
    free(value);
}

void facts_number(fact_list *facts, const char *item, double value, const char *unit,
                  const char *source)
{
    char text[32];
    wt_number_format(value, text);
    facts_add(facts, item, unit, source, "%s", isnan(value) ? "unknown" : text);
}

void facts_count(fact_list *facts, const char *item, size_t value, const char *source)
{
    facts_add(facts, item, "", source, "%zu", value);
}
