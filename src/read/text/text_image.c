/* Converts the tables of a text export to images: a matrix, points of a grid, or a profile.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "read/images.h"
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- axes of equal steps --------------------------------------------------------------------- */

/* Tolerance relative to a step; it changes no slope or spectrum noticeably. */
static const double step_tolerance = 1e-3;
/* Maximum number of grid positions for each point. */
enum { POSITIONS_PER_POINT = 4 };

/* Maximum number of decimals of a position in its unit. With more decimals, rounding does not
 * matter. */
enum { DECIMALS_MAX = 9 };
/* Tolerance of a decimal after a conversion of units. */
static const double decimal_tolerance = 1e-4;
/* Maximum rounding relative to a step. Above it, rounded positions give no evidence of equal
 * steps. */
static const double rounding_max = 0.65;

/* Returns the value of the last written decimal; 0 if there are too many. */
static double find_rounding_quantum(const double *positions, size_t n, double factor)
{
    double scale = 1;
    for (int k = 0; k <= DECIMALS_MAX; k++, scale *= 10) {
        size_t i = 0;
        while (i < n) {
            const double x = scale * positions[i] / factor;
            if (!(fabs(x - round(x)) <= decimal_tolerance))
                break;
            i++;
        }
        if (i == n)
            return factor / scale;
    }
    return 0;
}

/* Returns the largest distance of the positions from those of the axis. */
static double largest_deviation(const text_axis *axis, const double *positions, size_t n,
                                size_t *worst)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        const double at = (positions[i] - axis->first) / axis->step;
        const double to = axis->n == n ? (double)i : round(at);
        const double deviation = fabs(at - to) * axis->step;
        if (deviation > most) {
            most = deviation;
            *worst = i;
        }
    }
    return most;
}

/* Finds an axis with gaps, whose step is close to the smallest difference. */
static bool find_axis_with_gaps(const double *positions, size_t n, text_axis *axis)
{
    const double length = positions[n - 1] - positions[0];
    double least = length;
    size_t worst = 0;
    for (size_t i = 1; i < n; i++)
        least = fmin(least, positions[i] - positions[i - 1]);
    const double steps = round(length / least);
    if (!(steps < (double)(POSITIONS_PER_POINT * n)))
        return false;
    *axis = (text_axis){positions[0], length / steps, (size_t)steps + 1, 0};
    return axis->n > n &&
           largest_deviation(axis, positions, n, &worst) <= step_tolerance * axis->step;
}

bool axis_find(const double *positions, size_t n, double factor, bool allows_gaps, text_axis *axis,
               size_t *worst)
{
    *worst = 0;
    if (n < 2)
        return false;
    const text_axis equal = {positions[0], (positions[n - 1] - positions[0]) / (double)(n - 1), n,
                             0};
    const double deviation = largest_deviation(&equal, positions, n, worst);
    *axis = equal;
    if (deviation <= step_tolerance * equal.step)
        return true;
    if (allows_gaps && find_axis_with_gaps(positions, n, axis))
        return true;
    const double quantum = find_rounding_quantum(positions, n, fabs(factor));
    *axis = equal;
    axis->rounded = quantum;
    /* each end and the position itself are rounded by half of the quantum */
    return quantum > 0 && quantum <= rounding_max * equal.step &&
           deviation <= (1 + step_tolerance) * quantum;
}

size_t axis_index(const text_axis *axis, double position)
{
    return (size_t)fmax(0, round((position - axis->first) / axis->step));
}

typedef struct image_builder {
    const text_file *file;
    const text_table *table;
    wt_log *log;
    image_list *list;
    wt_error *err;
    double pixel_size; /* of the user; NaN: none */
} image_builder;

static void name_image(const image_builder *m, wt_image *head, const char *otherwise)
{
    images_set_name(head, m->table->title[0] != '\0' ? m->table->title : otherwise);
    snprintf(head->unit, sizeof head->unit, "m");
    snprintf(head->x_unit, sizeof head->x_unit, "m");
}

/* ---- matrix ---------------------------------------------------------------------------------- */

/* Warns of pixels that are higher than wide: rows may be missing, from which a wrong size of a
 * pixel follows. The width and height of the header are those of the complete image. */
static void check_pixel_shape(const image_builder *m)
{
    static const double ratio_least = 1.2;
    const text_table *const t = m->table;
    const double ratio = t->header.value[HEADER_HEIGHT] / (double)t->n_rows /
                         (t->header.value[HEADER_WIDTH] / (double)t->n_columns);
    if (ratio > ratio_least && t->n_rows > 1 && isnan(m->pixel_size))
        wt_log_action(m->log, WT_WARNING, WT_CONTRADICTED, 0, "pixel-size", m->file->name,
                      format_line_position(t->names_line).text,
                      "the pixels are not square: %.3g times as high as wide, by %zu rows and the "
                      "height in the header; if rows were cut off, all slopes are wrong: give the "
                      "true size with --pixel-size",
                      ratio, t->n_rows);
}

/* Adds a matrix; its first line is the upper edge. */
static wt_status add_matrix_image(const image_builder *m)
{
    const text_table *const t = m->table;
    const double *const stated = t->header.value;
    const double factor = isnan(stated[HEADER_VALUE_FACTOR]) ? 1 : stated[HEADER_VALUE_FACTOR];
    const double pixel = stated[HEADER_PIXEL_SIZE];
    wt_image head = {.n_columns = t->n_columns, .n_rows = t->n_rows};
    double *values = NULL;
    wt_status status = text_table_problem(t, WT_Q_BIT(WT_Q_SURFACE_HEIGHT), m->err);
    if (status != WT_OK)
        return status;
    name_image(m, &head, "matrix");
    check_pixel_shape(m);
    if (isnan(pixel))
        images_set_size(&head, stated[HEADER_WIDTH], stated[HEADER_HEIGHT]);
    else
        images_set_size(&head, pixel * (double)t->n_columns, pixel * (double)t->n_rows);
    status = images_add(m->list, &head, &values, m->err);
    for (size_t row = 0; status == WT_OK && row < t->n_rows; row++)
        for (size_t i = 0; i < t->n_columns; i++)
            values[(t->n_rows - 1 - row) * t->n_columns + i] =
                factor * t->values[row * t->n_columns + i];
    return status;
}

/* ---- columns --------------------------------------------------------------------------------- */

static wt_status fail_unequal_steps(const image_builder *m, const char *of, size_t row,
                                    wt_status status)
{
    wt_fail(m->err, status, "the places in column \"%s\" are no equal steps", of);
    wt_error_place(m->err, "line %zu", m->table->row_lines[row]);
    wt_error_expected(m->err, "places that are equally far from one another");
    wt_error_advice(m->err, "export the surface on a regular grid, or resample it there");
    return status;
}

static wt_status fail_no_position(const image_builder *m, const text_column *column, size_t row)
{
    wt_fail(m->err, WT_E_CORRUPT, "a row without its place");
    wt_error_place(m->err, "line %zu, column \"%s\"", m->table->row_lines[row], column->name);
    wt_error_expected(m->err, "a number");
    return WT_E_CORRUPT;
}

static void report_rounding(const image_builder *m, const text_column *column,
                            const text_axis *axis)
{
    char rounded[32], step[32];
    if (!(axis->rounded > 0))
        return;
    wt_format_si(axis->rounded, "m", 3, rounded, sizeof rounded);
    wt_format_si(axis->step, "m", 6, step, sizeof step);
    wt_log_add(m->log, WT_NOTE, m->file->name, NULL,
               "column \"%s\" is rounded to %s: its steps are taken as equal, %s by its ends",
               column->name, rounded, step);
}

/* Adds a profile; one with decreasing positions is reversed. */
static wt_status add_profile_image(const image_builder *m, const text_column *x,
                                   const text_column *z)
{
    const text_table *const t = m->table;
    const size_t n = t->n_rows;
    text_axis axis;
    size_t worst = 0;
    wt_status status = WT_OK;
    double *const positions = wt_alloc(n, sizeof *positions), *values = NULL;
    const bool falls = text_table_value(t, 0, x) > text_table_value(t, n - 1, x);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        const size_t row = falls ? n - 1 - i : i;
        positions[i] = text_table_value(t, row, x);
        if (!isfinite(positions[i]))
            status = fail_no_position(m, x, row);
        else if (i > 0 && !(positions[i] > positions[i - 1]))
            status = fail_unequal_steps(m, x->name, row, WT_E_RANGE);
    }
    if (status == WT_OK && !axis_find(positions, n, x->factor, false, &axis, &worst))
        status = fail_unequal_steps(m, x->name, falls ? n - 1 - worst : worst, WT_E_RANGE);
    free(positions);
    if (status != WT_OK)
        return status;
    wt_image head = {
        .n_columns = n, .n_rows = 1, .width = axis.step * (double)(n - 1), .x_min = axis.first};
    name_image(m, &head, "profile");
    status = images_add(m->list, &head, &values, m->err);
    for (size_t i = 0; status == WT_OK && i < n; i++)
        values[i] = text_table_value(t, falls ? n - 1 - i : i, z);
    if (status == WT_OK)
        report_rounding(m, x, &axis);
    return status;
}

/* Finds the axis of the distinct positions of a column. */
static wt_status find_column_axis(const image_builder *m, const text_column *column,
                                  text_axis *axis)
{
    const text_table *const t = m->table;
    double *const positions = wt_alloc(t->n_rows, sizeof *positions);
    size_t n = 0, worst = 0;
    wt_status status = WT_OK;
    for (size_t row = 0; status == WT_OK && row < t->n_rows; row++) {
        positions[row] = text_table_value(t, row, column);
        if (!isfinite(positions[row]))
            status = fail_no_position(m, column, row);
    }
    numbers_sort(positions, t->n_rows);
    for (size_t i = 0; i < t->n_rows; i++)
        if (n == 0 || positions[i] > positions[n - 1])
            positions[n++] = positions[i];
    if (status == WT_OK && n == 1)
        *axis = (text_axis){positions[0], 1, 1, 0};
    else if (status == WT_OK && !axis_find(positions, n, column->factor, true, axis, &worst))
        status = fail_unequal_steps(m, column->name, 0, WT_E_RANGE);
    free(positions);
    if (status == WT_OK)
        report_rounding(m, column, axis);
    return status;
}

static wt_status fill_grid(const image_builder *m, const text_column *const of[3],
                           const text_axis *x, const text_axis *y, double *values)
{
    const text_table *const t = m->table;
    const size_t n = x->n * y->n;
    unsigned char *const filled = wt_alloc(n, 1);
    wt_status status = WT_OK;
    for (size_t i = 0; i < n; i++)
        values[i] = (double)NAN;
    for (size_t row = 0; status == WT_OK && row < t->n_rows; row++) {
        const size_t at = axis_index(y, text_table_value(t, row, of[1])) * x->n +
                          axis_index(x, text_table_value(t, row, of[0]));
        if (filled[at] != 0) {
            status = wt_fail(m->err, WT_E_CORRUPT, "a point of the grid stands twice");
            wt_error_place(m->err, "line %zu", t->row_lines[row]);
            wt_error_expected(m->err, "one height for each place");
        }
        filled[at] = 1;
        values[at] = text_table_value(t, row, of[2]);
    }
    free(filled);
    return status;
}

static wt_status add_grid_image(const image_builder *m, const text_column *const of[3])
{
    text_axis x, y;
    double *values = NULL;
    wt_status status = find_column_axis(m, of[0], &x);
    if (status == WT_OK)
        status = find_column_axis(m, of[1], &y);
    if (status == WT_OK && x.n * y.n == 1) /* one point is no surface */
        status = text_fail_empty(m->file, "height map or profile", m->err);
    if (status != WT_OK)
        return status;
    /* scattered points would give a grid line and column for each point */
    if (x.n > SIZE_MAX / y.n || x.n * y.n / 4 > m->table->n_rows) {
        status = wt_fail(m->err, WT_E_RANGE, "the points are no grid");
        wt_error_expected(m->err, "a height at most places of a grid");
        wt_error_found(m->err, "%zu points, %zu places along \"%s\" and %zu along \"%s\"",
                       m->table->n_rows, x.n, of[0]->name, y.n, of[1]->name);
        wt_error_advice(m->err, "export the surface on a regular grid");
        return status;
    }
    wt_image head = {.n_columns = x.n,
                     .n_rows = y.n,
                     .width = x.step * (double)(x.n - 1),
                     .height = y.step * (double)(y.n - 1),
                     .x_min = x.first,
                     .y_min = y.first};
    name_image(m, &head, "grid");
    status = images_add(m->list, &head, &values, m->err);
    return status == WT_OK ? fill_grid(m, of, &x, &y, values) : status;
}

static wt_status add_table_image(const image_builder *m)
{
    const text_table *const t = m->table;
    if (m->file->description->matrix)
        return add_matrix_image(m);
    const wt_quantity_set image_quantities =
        WT_Q_BIT(WT_Q_POSITION_X) | WT_Q_BIT(WT_Q_POSITION_Y) | WT_Q_BIT(WT_Q_SURFACE_HEIGHT);
    wt_status status = text_table_problem(t, image_quantities, m->err);
    if (status == WT_OK)
        status = text_table_require(t, WT_KIND_IMAGE, m->err);
    if (status != WT_OK)
        return status;
    const text_column *const of[3] = {text_table_column(t, WT_Q_POSITION_X, -1),
                                      text_table_column(t, WT_Q_POSITION_Y, -1),
                                      text_table_column(t, WT_Q_SURFACE_HEIGHT, -1)};
    return of[1] != NULL ? add_grid_image(m, of) : add_profile_image(m, of[0], of[2]);
}

/* True for an image of another quantity in a file of several images; it is skipped with a note. */
static bool is_skipped(const image_builder *m, wt_status status)
{
    if (status != WT_E_UNIT || m->file->n_tables < 2)
        return false;
    wt_log_add(m->log, WT_NOTE, m->file->name, format_line_position(m->table->names_line).text,
               "an image of no heights is left out");
    return true;
}

wt_status text_read_images(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_log *log, wt_image **images, size_t *n_images, wt_error *err)
{
    text_file file;
    image_list list = {NULL, 0};
    wt_status status = text_scan(self, input, WT_KIND_IMAGE, options, log, &file, err);
    if (status != WT_OK)
        return status;
    text_log_columns(&file, log);
    for (size_t i = 0; status == WT_OK && i < file.n_tables; i++) {
        const image_builder m = {&file, &file.tables[i], log, &list, err, options->pixel_size};
        status = add_table_image(&m);
        if (is_skipped(&m, status))
            status = WT_OK;
    }
    if (status == WT_OK && file.n_tables == 0)
        status = text_fail_empty(&file, "height map or profile", err);
    status = images_finish(&list, status, wt_input_name(input), log, images, n_images, err);
    text_file_free(&file);
    return status;
}
