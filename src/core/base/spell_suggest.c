/* Suggests the name that a misspelled word probably means. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/spell_suggest.h"

#include <stdbool.h>
#include <stdint.h>

enum { LONGEST = 63 };

static size_t smaller_size(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Converts an ASCII capital to lower case. */
static char lower_case(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool equal_ignoring_case(char a, char b)
{
    return lower_case(a) == lower_case(b);
}

size_t spelling_distance(const char *a, size_t n_a, const char *b, size_t n_b)
{
    size_t rows[3][LONGEST + 1];
    if (n_a > LONGEST || n_b > LONGEST)
        return SIZE_MAX;
    size_t *before = rows[0], *last = rows[1], *row = rows[2];
    for (size_t k = 0; k <= n_b; k++)
        last[k] = k;
    for (size_t i = 1; i <= n_a; i++) {
        row[0] = i;
        for (size_t k = 1; k <= n_b; k++) {
            const size_t other = equal_ignoring_case(a[i - 1], b[k - 1]) ? 0 : 1;
            row[k] = smaller_size(smaller_size(last[k], row[k - 1]) + 1, last[k - 1] + other);
            if (i > 1 && k > 1 && equal_ignoring_case(a[i - 1], b[k - 2]) &&
                equal_ignoring_case(a[i - 2], b[k - 1]))
                row[k] = smaller_size(row[k], before[k - 2] + 1);
        }
        size_t *const next = before;
        before = last;
        last = row;
        row = next;
    }
    return last[n_b];
}

spell_suggestion spell_suggestion_begin(const char *word, size_t length)
{
    return (spell_suggestion){.word = word, .length = length, .distance = (length + 2) / 3 + 1};
}

void spell_suggestion_try(spell_suggestion *nearest, const char *name, size_t length)
{
    const size_t distance = spelling_distance(nearest->word, nearest->length, name, length);
    if (distance > nearest->distance || distance >= nearest->length)
        return;
    const bool tie = distance == nearest->distance;
    if (tie && nearest->name == NULL)
        return;
    nearest->name = tie ? NULL : name;
    nearest->name_length = length;
    nearest->distance = distance;
}
