/* Building tables from a list of columns.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/tables.h"

#include "base/clocale.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

wt_status flow_table_new(const char *name, const char *title, const flow_column *columns, size_t n,
                         wt_table **table, wt_error *err)
{
    *table = NULL;
    wt_table *t = wt_table_new(name, title);
    if (t == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t i = 0; i < n; i++) {
        wt_status status =
            columns[i].unit == NULL
                ? wt_table_add_text_column(t, columns[i].name, columns[i].title, err)
                : wt_table_add_column(t, columns[i].name, columns[i].unit, columns[i].title, err);
        if (status != WT_OK) {
            wt_table_free(t);
            return status;
        }
    }
    *table = t;
    return WT_OK;
}

wt_status flow_table_key(wt_table *table, wt_error *err, const char *key, const char *format, ...)
{
    char text[1024];
    va_list list;
    va_start(list, format);
    clocale_vprint(text, sizeof text, format, list);
    va_end(list);
    return wt_table_set_key(table, key, text, err);
}

wt_status flow_table_value(wt_table *table, const char *key, double value, double standard_error,
                           double numerical_error, const char *unit, wt_error *err)
{
    wt_estimate estimate = {value, standard_error, numerical_error, unit};
    return wt_table_set_estimate(table, key, estimate, err);
}

void flow_add_words(char *words, size_t size, const char *what)
{
    size_t used = strlen(words);
    snprintf(words + used, size - used, "%s%s", used > 0 ? ", " : "", what);
}

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

void flow_sort(double *x, size_t n)
{
    qsort(x, n, sizeof *x, compare_numbers);
}

double flow_table_get(const wt_table *table, size_t row, const char *column)
{
    long i = wt_table_find(table, column);
    return i < 0 ? (double)NAN : wt_table_number(table, row, (size_t)i);
}

const char *flow_table_get_text(const wt_table *table, size_t row, const char *column)
{
    long i = wt_table_find(table, column);
    const char *text = i < 0 ? NULL : wt_table_text(table, row, (size_t)i);
    return text == NULL ? "" : text;
}
