/* Checks a table of a DMA sweep for repeated rows and for a loss factor that contradicts the
 * moduli.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_sweep.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_row_values(const void *a, const void *b, void *user)
{
    const text_table *const t = user;
    const size_t p = *(const size_t *)a, q = *(const size_t *)b;
    const int order = memcmp(t->values + p * t->n_columns, t->values + q * t->n_columns,
                             t->n_columns * sizeof *t->values);
    return order != 0 ? order : (p > q) - (p < q);
}

/* Warns of repeated rows: a measurement does not repeat all values to the last digit. */
static wt_status warn_duplicate_rows(const text_file *file, text_table *t, wt_log *log,
                                     wt_error *err)
{
    enum { COLUMNS_LEAST = 3 };
    size_t n = 0, line = SIZE_MAX;
    if (t->n_columns < COLUMNS_LEAST || t->n_rows < 2)
        return WT_OK;
    size_t *const rows = malloc(t->n_rows * sizeof *rows);
    if (rows == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for an isotherm");
    for (size_t i = 0; i < t->n_rows; i++)
        rows[i] = i;
    qsort_r(rows, t->n_rows, sizeof *rows, compare_row_values, t);
    for (size_t i = 1; i < t->n_rows; i++) {
        const size_t width = t->n_columns;
        const bool twice = memcmp(t->values + rows[i] * width, t->values + rows[i - 1] * width,
                                  width * sizeof *t->values) == 0 &&
                           t->samples[rows[i]] == t->samples[rows[i - 1]] &&
                           t->blocks[rows[i]] == t->blocks[rows[i - 1]];
        n += twice;
        line = twice && t->row_lines[rows[i]] < line ? t->row_lines[rows[i]] : line;
    }
    free(rows);
    if (n > 0)
        wt_log_add(log, WT_WARNING, file->name, format_line_position(line).text,
                   "%zu rows from here on are there twice with the same numbers: was a part "
                   "of the file copied into it?",
                   n);
    return WT_OK;
}

/* Returns E''/E' minus the loss factor of a row; NaN if one is missing. */
static double loss_factor_deviation(const text_table *t, const sweep_columns *c, size_t row)
{
    return text_table_value(t, row, c->loss) / text_table_value(t, row, c->storage) -
           text_table_value(t, row, c->factor);
}

/* Warns of a loss factor that is not the ratio of the moduli although it is in most rows. Two
 * digits allow 5 %. Fixed decimals, or an instrument that averages all three, give similar
 * deviations in most rows. */
static wt_status warn_loss_factors(const text_file *file, const text_table *t, wt_log *log,
                                   wt_error *err)
{
    static const double two_digits = 0.05, most_rows = 10;
    enum { ROWS_LEAST = 4 };
    const sweep_columns c = sweep_find_columns(t, WT_DEFORMATION_FROM_FILE);
    size_t n = 0, n_wrong = 0, line = SIZE_MAX;
    if (c.storage == NULL || c.loss == NULL || c.factor == NULL || t->n_rows < ROWS_LEAST)
        return WT_OK;
    double *const gaps = malloc(t->n_rows * sizeof *gaps);
    if (gaps == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for an isotherm");
    for (size_t i = 0; i < t->n_rows; i++) {
        const double gap = loss_factor_deviation(t, &c, i);
        if (isfinite(gap))
            gaps[n++] = fabs(gap);
    }
    const double usual = n > 0 ? numbers_median(gaps, n) : (double)NAN;
    free(gaps);
    for (size_t i = 0; i < t->n_rows && n >= ROWS_LEAST; i++) {
        const double gap = fabs(loss_factor_deviation(t, &c, i));
        const bool wrong = isfinite(gap) && gap > most_rows * usual &&
                           gap > two_digits * fabs(text_table_value(t, i, c.factor));
        n_wrong += wrong;
        line = wrong && t->row_lines[i] < line ? t->row_lines[i] : line;
    }
    if (n_wrong > 0)
        wt_log_add(log, WT_WARNING, file->name, format_line_position(line).text,
                   "the loss factor of %zu row%s from here on is not the ratio of the moduli "
                   "beside it, as it is in the others: was a number changed?",
                   n_wrong, n_wrong > 1 ? "s" : "");
    return WT_OK;
}

wt_status sweep_check_table(const text_file *file, text_table *t, wt_log *log, wt_error *err)
{
    const wt_status status = warn_duplicate_rows(file, t, log, err);
    return status == WT_OK ? warn_loss_factors(file, t, log, err) : status;
}
