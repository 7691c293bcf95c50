/* Names and units of schema fields. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/schema.h"

#include <string.h>

const char *schema_unit(const schema_field *field)
{
    if (field->kind == SCHEMA_TEXT)
        return "";
    return field->unit != NULL ? field->unit : wt_quantity_unit(field->quantity);
}

void schema_name(const char *name, const char *suffix, char full[SCHEMA_NAME_SIZE])
{
    const size_t length = strlen(name);
    const bool open = length > 0 && strchr("/_", name[length - 1]) != NULL;
    (void)snprintf(full, SCHEMA_NAME_SIZE, "%s%s", name, open ? suffix : "");
}
