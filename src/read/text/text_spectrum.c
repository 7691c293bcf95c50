/* Converts the tables of a text export to a power spectrum of a surface, or a table to the noise
 * spectrum of a cantilever.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include "core/base/array.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct spectrum_point {
    double place, density; /* wavenumber or frequency, and the density there */
} spectrum_point;

/* Sorts the points into two arrays; each place must be there once. */
static wt_status sort_points(spectrum_point *points, size_t n, const char *name, const char *unit,
                             double **place, double **density, wt_error *err)
{
    qsort(points, n, sizeof *points, numbers_compare);
    *place = wt_alloc(n, sizeof **place);
    *density = wt_alloc(n, sizeof **density);
    for (size_t i = 0; i < n; i++) {
        if (i > 0 && !(points[i].place > points[i - 1].place)) {
            const wt_status status = wt_fail(err, WT_E_CORRUPT, "a %s stands twice", name);
            wt_error_expected(err, "one density for each %s", name);
            wt_error_found(err, "two for %g %s", points[i].place, unit);
            return status;
        }
        (*place)[i] = points[i].place;
        (*density)[i] = points[i].density;
    }
    return WT_OK;
}

/* ---- roughness ------------------------------------------------------------------------------- */

/* The classes of a row. Wavenumber 0 of an averaged spectrum is the mean height and is skipped. Any
 * other invalid row would leave an invisible gap, so it is an error. */
typedef enum row_class { ROW_POINT, ROW_EMPTY, ROW_MEAN, ROW_BAD } row_class;

static row_class classify_row(spectrum_point p)
{
    if (isnan(p.place) && isnan(p.density))
        return ROW_EMPTY;
    if (p.place == 0)
        return ROW_MEAN;
    return p.place > 0 && !isnan(p.density) ? ROW_POINT : ROW_BAD;
}

static wt_status fail_row(const text_table *t, size_t row, spectrum_point p, wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "a row of the spectrum is no point of it");
    wt_error_place(err, "line %zu", t->row_lines[row]);
    wt_error_expected(err, "a wavenumber above 0 (of 0: the mean, left out) and a density");
    wt_error_found(err, "wavenumber %g rad/m, density %g (nan: no value)", p.place, p.density);
    wt_error_advice(err, "take the row out if the spectrum is to be interpolated there");
    return WT_E_CORRUPT;
}

static wt_status collect_spectrum_points(const text_file *file, spectrum_point *points, size_t *n,
                                         wt_spectrum_kind *kind, wt_log *log, wt_error *err)
{
    for (size_t i = 0; i < file->n_tables; i++) {
        const text_table *t = &file->tables[i];
        wt_status status = text_table_require(t, WT_KIND_SPECTRUM, err);
        if (status != WT_OK)
            return status;
        const text_column *q = text_table_column(t, WT_Q_WAVENUMBER, -1);
        const text_column *c = text_table_column(t, WT_Q_POWER_SPECTRUM_2D, -1);
        const wt_spectrum_kind this_kind = c != NULL ? WT_SPECTRUM_2D : WT_SPECTRUM_1D;
        if (c == NULL)
            c = text_table_column(t, WT_Q_POWER_SPECTRUM_1D, -1);
        if (i > 0 && this_kind != *kind) {
            wt_fail(err, WT_E_UNIT, "one- and two-dimensional spectra in one file");
            wt_error_place(err, "line %zu", t->names_line);
            wt_error_expected(err, "densities of one unit, m^4 or m^3");
            return WT_E_UNIT;
        }
        *kind = this_kind;
        for (size_t r = 0; r < t->n_rows; r++) {
            spectrum_point p = {text_table_value(t, r, q), text_table_value(t, r, c)};
            switch (classify_row(p)) {
            case ROW_POINT:
                points[(*n)++] = p;
                break;
            case ROW_EMPTY:
                break;
            case ROW_MEAN:
                wt_log_add(log, WT_WARNING, file->name, format_line_position(t->row_lines[r]).text,
                           "wavenumber 0 is the mean of the surface, no wave; its density is "
                           "left out");
                break;
            case ROW_BAD:
                return fail_row(t, r, p, err);
            }
        }
    }
    return WT_OK;
}

wt_status text_read_spectrum(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log,
                             wt_power_spectrum *spectrum, wt_error *err)
{
    text_file file;
    wt_power_spectrum result = {.n = 0};
    size_t rows = 0;
    wt_status status = text_scan(self, input, WT_KIND_SPECTRUM, options, log, &file, err);
    if (status != WT_OK)
        return status;
    text_log_columns(&file, log);
    for (size_t i = 0; i < file.n_tables; i++)
        rows += file.tables[i].n_rows;
    spectrum_point *points = wt_alloc(rows, sizeof *points);
    status = collect_spectrum_points(&file, points, &result.n, &result.kind, log, err);
    if (status == WT_OK && result.n < 2)
        status = text_fail_empty(&file, "power spectrum", err);
    if (status == WT_OK)
        status = sort_points(points, result.n, "wavenumber", "rad/m", &result.wavenumber,
                             &result.density, err);
    if (status == WT_OK)
        *spectrum = result;
    else
        wt_power_spectrum_clear(&result);
    free(points);
    text_file_free(&file);
    return status;
}
