/* Means of the dwell moduli of several curves by frequency.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/dwell.h"

#include "core/table/registry.h"

#include "core/math/students_t.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Frequencies with a smaller relative difference count as equal, because the user sets them. */
static const double same_frequency = 1e-3;

typedef struct moduli_row {
    double frequency;
    size_t row;
    long unit;
} moduli_row;

static int compare_frequencies(const void *a, const void *b)
{
    const moduli_row *x = a, *y = b;
    return x->frequency != y->frequency ? (x->frequency > y->frequency ? 1 : -1)
                                        : (x->row > y->row) - (x->row < y->row);
}

static int compare_rows(const void *a, const void *b)
{
    const moduli_row *x = a, *y = b;
    return (x->row > y->row) - (x->row < y->row);
}

/* Mean of n rows of one frequency. The rows are sorted by file. values: scratch. */
static wt_interval mean_modulus(const table_view *v, const moduli_row *at, size_t n, bool loss,
                                double *values, long *units, size_t *n_units)
{
    double common = 0, n_known = 0;
    for (size_t i = 0; i < n; i++) {
        const size_t row = at[i].row;
        values[i] = dwell_moduli_get(v, row, loss ? DWELL_MODULI_LOSS : DWELL_MODULI_STORAGE);
        units[i] = at[i].unit;
        const double common_error =
            dwell_moduli_get(v, row, loss ? DWELL_MODULI_LOSS_COMMON : DWELL_MODULI_STORAGE_COMMON);
        common += isfinite(common_error) ? common_error * common_error : 0;
        n_known += isfinite(common_error) ? 1 : 0;
    }
    /* the scatter does not include a systematic error that most curves share */
    common = n_known > 0 && 2 * n_known >= (double)n ? common / n_known : (double)NAN;
    wt_interval m = wt_student_mean(values, units, n, n_units);
    double half = hypot(m.high - m.value, NORMAL_95 * sqrt(common));
    m.standard_error = hypot(m.standard_error, sqrt(common));
    if (n == 1) {
        m.standard_error = dwell_moduli_get(v, at->row,
                                            loss ? DWELL_MODULI_LOSS_STANDARD_ERROR
                                                 : DWELL_MODULI_STORAGE_STANDARD_ERROR);
        half = NORMAL_95 * m.standard_error;
    }
    m.low = m.value - half;
    m.high = m.value + half;
    return m;
}

wt_status dwell_means(const wt_table *moduli, dwell_mean **means, size_t *n, wt_error *err)
{
    table_view v;
    wt_status status = table_bind(moduli, &dwell_moduli_schema, "", &v, err);
    *means = NULL;
    *n = 0;
    if (status != WT_OK)
        return status;
    moduli_row *at = wt_alloc(v.n_rows + 1, sizeof *at);
    double *values = wt_alloc(v.n_rows + 1, sizeof *values);
    long *units = wt_alloc(v.n_rows + 1, sizeof *units);
    dwell_mean *list = wt_alloc(v.n_rows + 1, sizeof *list);
    for (size_t row = 0; row < v.n_rows; row++) {
        const bool same = row > 0 && strcmp(dwell_moduli_text(&v, row, DWELL_MODULI_FILE),
                                            dwell_moduli_text(&v, row - 1, DWELL_MODULI_FILE)) == 0;
        at[row] = (moduli_row){dwell_moduli_get(&v, row, DWELL_MODULI_ANGULAR_FREQUENCY), row,
                               row == 0 ? 0 : at[row - 1].unit + (same ? 0 : 1)};
    }
    qsort(at, v.n_rows, sizeof *at, compare_frequencies);
    for (size_t from = 0, to; from < v.n_rows; from = to) {
        for (to = from + 1;
             to < v.n_rows && at[to].frequency < at[from].frequency * (1 + same_frequency);)
            to++;
        dwell_mean *m = &list[(*n)++];
        m->angular_frequency = at[from].frequency;
        /* Sorting by nearly equal frequencies interleaves the files, and each curve would become a
         * unit. Sort by row again. */
        qsort(at + from, to - from, sizeof *at, compare_rows);
        m->n = to - from;
        m->storage = mean_modulus(&v, at + from, m->n, false, values, units, &m->n_units);
        m->loss = mean_modulus(&v, at + from, m->n, true, values, units, &m->n_units);
    }
    free(at);
    free(values);
    free(units);
    *means = list;
    return status;
}
