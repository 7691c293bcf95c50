/* Rules for the names of tables, columns and keys. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/table.h"

#include <string.h>

bool table_name_is_valid(const char *name)
{
    size_t part = 0;
    for (; *name != '\0'; name++) {
        if (*name == '/') {
            if (part == 0)
                return false;
            part = 0;
        } else if (strchr("abcdefghijklmnopqrstuvwxyz0123456789_", *name) != NULL) {
            part++;
        } else {
            return false;
        }
    }
    return part > 0;
}

bool table_name_part_is_valid(const char *word)
{
    return word[0] != '\0' && word[strspn(word, "abcdefghijklmnopqrstuvwxyz"
                                                "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_")] == '\0';
}
