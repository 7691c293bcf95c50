/* Fills the table of metadata that a reader returns for `info`. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "read/metadata.h"
#include "core/base/clocale.h"
#include "core/base/memory.h"
#include "core/table/registry.h"

#include <math.h>
#include <string.h>

/* Returns FACT_ITEM_UNKNOWN for an item on which no code acts. */
static fact_item find_kind(const char *item)
{
    const int kind = closed_list_find(&fact_item_list, item);
    const bool is_longer = strcmp(item, fact_item_text((fact_item)kind)) != 0;
    return kind < FACT_TABLE && is_longer ? FACT_ITEM_UNKNOWN : (fact_item)kind;
}

void metadata_add(table_writer *metadata, const char *item, const char *unit, const char *source,
                  const char *format, ...)
{
    char *value = NULL;
    va_list arguments;
    va_start(arguments, format);
    const locale_t previous = clocale_enter();
    if (vasprintf(&value, format, arguments) < 0)
        out_of_memory(strlen(format));
    clocale_leave(previous);
    va_end(arguments);
    table_row(metadata);
    facts_put_text(metadata, FACTS_ITEM, item);
    facts_put_text(metadata, FACTS_VALUE, value);
    facts_put_text(metadata, FACTS_UNIT, unit);
    facts_put_text(metadata, FACTS_SOURCE, source);
    facts_put(metadata, FACTS_KIND, (double)find_kind(item));
    free(value);
}

void metadata_add_text(table_writer *metadata, const char *item, const char *key, const char *text)
{
    if (text != NULL && *text != '\0')
        metadata_add(metadata, item, "", key, "%s", text);
}

void metadata_add_number(table_writer *metadata, const char *item, double value, const char *unit,
                         const char *source)
{
    char text[32];
    wt_number_format(value, text);
    metadata_add(metadata, item, unit, source, "%s", isnan(value) ? "unknown" : text);
}
