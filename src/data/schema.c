/* What a table consists of. SPDX-License-Identifier: GPL-3.0-or-later */
#include "data/schema.h"

#include <string.h>

const char *schema_column_unit(const schema_column *column)
{
    if (column->kind == SCHEMA_TEXT)
        return "";
    return column->unit != NULL ? column->unit : wt_quantity_unit(column->quantity);
}

const char *schema_key_unit(const schema_key *key)
{
    if (key->kind == SCHEMA_TEXT)
        return "";
    return key->unit != NULL ? key->unit : wt_quantity_unit(key->quantity);
}

void schema_name(const char *name, const char *suffix, char full[SCHEMA_NAME_SIZE])
{
    const size_t length = strlen(name);
    const bool open = length > 0 && strchr("/_", name[length - 1]) != NULL;
    (void)snprintf(full, SCHEMA_NAME_SIZE, "%s%s", name, open ? suffix : "");
}
