/* Writes force curves as text. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/curve_text.h"

#include <math.h>

static void write_number(FILE *out, double value)
{
    char text[32];
    wt_number_format(value, text);
    fputs(isfinite(value) ? text : "nan", out);
}

static void write_key(FILE *out, const char *key, double value, wt_quantity quantity)
{
    if (!isfinite(value))
        return;
    fprintf(out, "## %s: ", key);
    write_number(out, value);
    fprintf(out, " unit=%s\n", wt_quantity_unit(quantity));
}

void curve_text_names(FILE *out, const curve_text *curve)
{
    fprintf(out, "# segment[text]");
    for (size_t i = 0; i < curve->n_columns; i++)
        fprintf(out, "\t%s[%s]", wt_quantity_id(curve->columns[i].quantity),
                wt_quantity_unit(curve->columns[i].quantity));
    fputc('\n', out);
}

void curve_text_begin(FILE *out, const curve_text *curve)
{
    fprintf(out, "## table: force_curve/%zu\n", curve->number);
    write_key(out, "position_x", curve->x, WT_Q_POSITION_X);
    write_key(out, "position_y", curve->y, WT_Q_POSITION_Y);
    write_key(out, "spring_constant", curve->cantilever.spring_constant, WT_Q_SPRING_CONSTANT);
    write_key(out, "sensitivity", curve->cantilever.sensitivity, WT_Q_SENSITIVITY);
    curve_text_names(out, curve);
}

void curve_text_rows(FILE *out, const curve_text *curve, wt_segment_kind kind, size_t from,
                     size_t n, bool backwards)
{
    for (size_t i = 0; i < n; i++) {
        const size_t row = from + (backwards ? n - 1 - i : i);
        fputs(wt_segment_kind_name(kind), out);
        for (size_t c = 0; c < curve->n_columns; c++) {
            fputc('\t', out);
            write_number(out, curve->columns[c].values[row]);
        }
        fputc('\n', out);
    }
}

void curve_text_end(FILE *out)
{
    fputs("##\n", out);
}
