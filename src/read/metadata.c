/* Fills the table of metadata that a reader returns for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/metadata.h"

#include "core/base/clocale.h"
#include "core/table/registry.h"

#include <math.h>
#include <stdlib.h>

void facts_add(table_writer *facts, const char *item, const char *unit, const char *source,
               const char *format, ...)
{
    if (facts->status != WT_OK)
        return;
    char *value = NULL;
    va_list arguments;
    va_start(arguments, format);
    const locale_t previous = clocale_enter();
    if (vasprintf(&value, format, arguments) < 0) {
        value = NULL;
        facts->status = wt_fail(facts->err, WT_E_MEMORY, "no memory to describe the file");
    }
    clocale_leave(previous);
    va_end(arguments);
    table_row(facts);
    facts_put_text(facts, FACTS_ITEM, item);
    facts_put_text(facts, FACTS_VALUE, value);
    facts_put_text(facts, FACTS_UNIT, unit);
    facts_put_text(facts, FACTS_SOURCE, source);
    free(value);
}

void facts_number(table_writer *facts, const char *item, double value, const char *unit,
                  const char *source)
{
    char text[32];
    wt_number_format(value, text);
    facts_add(facts, item, unit, source, "%s", isnan(value) ? "unknown" : text);
}
