/* Formats a range of numbers. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/range_text.h"

#include "core/base/clocale.h"

#include <string.h>

/* Limits that agree to this number of digits are printed as equal. */
enum { DIGITS_MAX = 9 };

int range_digits(double low, double high, int least)
{
    for (int digits = least; digits <= DIGITS_MAX; digits++) {
        char first[32], second[32];
        clocale_print(first, sizeof first, "%.*g", digits, low);
        clocale_print(second, sizeof second, "%.*g", digits, high);
        if (strcmp(first, second) != 0)
            return digits;
    }
    return least;
}

range_text format_range(double low, double high, int least)
{
    const int digits = range_digits(low, high, least);
    range_text ends;
    clocale_print(ends.text, sizeof ends.text, "%.*g to %.*g", digits, low, digits, high);
    return ends;
}
