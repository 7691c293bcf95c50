/* Names, units and closed lists of schema fields. SPDX-License-Identifier: GPL-3.0-or-later */
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

size_t length_without_reason(const char *cell)
{
    size_t n = 0;
    while (cell[n] != '\0' && (cell[n] != ':' || cell[n + 1] != ' '))
        n++;
    return n;
}

/* True if a text of a list may end before this character. */
static bool is_end_of_text(char next)
{
    return next == '\0' || strchr(" :;,(", next) != NULL;
}

int closed_list_find(const closed_list *list, const char *cell)
{
    size_t longest = 0;
    int found = list->n;
    for (int i = 0; cell != NULL && i < list->n; i++) {
        const size_t length = strlen(list->texts[i]);
        if (length > longest && strncmp(cell, list->texts[i], length) == 0 &&
            is_end_of_text(cell[length])) {
            longest = length;
            found = i;
        }
    }
    return found;
}

uint64_t closed_list_find_items(const closed_list *list, const char *cell)
{
    uint64_t items = 0;
    for (const char *item = cell; item != NULL; item = strchr(item, ',')) {
        item += strspn(item, ", ");
        items |= SCHEMA_BIT(closed_list_find(list, item));
    }
    return items;
}

const char *closed_list_get(const closed_list *list, int value)
{
    return value >= 0 && value < list->n ? list->texts[value] : "";
}
