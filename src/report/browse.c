/* Writes one self-contained page for browsing the curves of a result, with their data.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/curve_finder.h"
#include "report/report_files.h"
#include "weartrack/report.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A part of the page and its placeholder in browse.html. */
typedef struct page_part {
    const char *mark, *text;
} page_part;

static wt_status find_dygraphs(const char **script, const char **style, const char **licence,
                               wt_error *err)
{
    *script = embedded_file_text("dygraph.min.js");
    *style = embedded_file_text("dygraph.min.css");
    *licence = embedded_file_text("copyright");
    if (*script != NULL && *style != NULL && *licence != NULL)
        return WT_OK;
    const wt_status status =
        wt_fail(err, WT_E_TOOL, "this build has no dygraphs, which draws on the page");
    wt_error_advice(err, "install the Debian package libjs-dygraphs and build weartrack again");
    return status;
}

static void append_page_template(const page_part *parts, size_t n, text_buffer *page)
{
    const char *p = embedded_file_text("browse.html");
    for (const char *mark; (mark = strstr(p, "@@")) != NULL;) {
        text_bytes(page, p, (size_t)(mark - p));
        size_t k = 0;
        while (k < n && strncmp(mark + 2, parts[k].mark, strlen(parts[k].mark)) != 0)
            k++;
        p = mark + 2;
        if (k == n)
            continue;
        text_add(page, parts[k].text);
        p += strlen(parts[k].mark) + 2;
    }
    text_add(page, p);
}

static void append_provenance(const wt_result *result, bool with_provenance, text_buffer *to)
{
    text_html(to, "weartrack %s", wt_version());
    const char *command = wt_provenance_command(wt_result_provenance_const(result));
    if (with_provenance && command[0] != '\0')
        text_html(to, "<details><summary>Command</summary><code>%s</code></details>", command);
}

wt_status wt_curve_browser_write(const wt_result *result, const char *path, bool with_provenance,
                                 wt_error *err)
{
    figure_tables tables = {0};
    text_buffer data = {0}, licence = {0}, source = {0}, page = {0};
    const char *script = NULL, *style = NULL, *copyright = NULL;
    wt_status status = find_dygraphs(&script, &style, &copyright, err);
    if (status == WT_OK)
        status = figure_tables_bind(result, &tables, err);
    if (status == WT_OK)
        status = check_curve_samples(&tables, err);
    if (status == WT_OK) {
        append_browse_data(&tables, &data);
        text_html(&licence, "%s", copyright);
        append_provenance(result, with_provenance, &source);
        const page_part parts[] = {{"dygraph.css", style},
                                   {"browse.css", embedded_file_text("browse.css")},
                                   {"data", text_string(&data)},
                                   {"dygraph.js", script},
                                   {"shared.js", embedded_file_text("shared.js")},
                                   {"browse.js", embedded_file_text("browse.js")},
                                   {"licence", text_string(&licence)},
                                   {"source", text_string(&source)}};
        append_page_template(parts, sizeof parts / sizeof parts[0], &page);
        status = write_user_file(path, &page, err);
    }
    text_free(&data);
    text_free(&licence);
    text_free(&source);
    text_free(&page);
    figure_tables_clear(&tables);
    return status;
}

/* Largest value of a packed number, and the code for a missing value. */
enum { PACKED_MAX = 65534, PACKED_NONE = 65535 };

/* ---- strings and numbers --------------------------------------------------------------------- */

static void add_json_number(text_buffer *to, double value)
{
    if (isfinite(value))
        text_format(to, "%.6g", value);
    else
        text_add(to, "null");
}

/* Appends a number with all digits. Contact points are differences of large numbers, and the page
 * exports them. */
static void add_exact_number(text_buffer *to, double value)
{
    char number[64];
    if (!isfinite(value)) {
        text_add(to, "null");
        return;
    }
    wt_number_format(value, number);
    text_add(to, number);
}

static void add_base64(text_buffer *to, const uint8_t *bytes, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    text_add(to, "\"");
    for (size_t i = 0; i < n; i += 3) {
        const unsigned a = bytes[i], b = i + 1 < n ? bytes[i + 1] : 0,
                       c = i + 2 < n ? bytes[i + 2] : 0;
        const char four[4] = {digits[a >> 2], digits[(a << 4 | b >> 4) & 63],
                              i + 1 < n ? digits[(b << 2 | c >> 6) & 63] : '=',
                              i + 2 < n ? digits[c & 63] : '='};
        text_bytes(to, four, sizeof four);
    }
    text_add(to, "\"");
}

/* ---- samples --------------------------------------------------------------------------------- */

typedef struct number_range {
    double low, high;
} number_range;

static number_range column_range(const table_view *view, curve_block b, curves_column column,
                                 number_range r)
{
    for (size_t i = b.from; i < b.to; i++) {
        const double value = curves_get(view, i, column);
        if (!isfinite(value))
            continue;
        r.low = fmin(r.low, value);
        r.high = fmax(r.high, value);
    }
    return r;
}

static unsigned pack_value(double value, number_range r)
{
    if (!isfinite(value) || !(r.high > r.low))
        return isfinite(value) ? 0 : PACKED_NONE;
    return (unsigned)lrint((value - r.low) / (r.high - r.low) * PACKED_MAX);
}

static uint8_t *write_packed(uint8_t *to, unsigned value)
{
    enum { BYTE = 8, LOW = 255 };
    to[0] = (uint8_t)(value & LOW);
    to[1] = (uint8_t)(value >> BYTE);
    return to + 2;
}

/* Returns the compliance of the cantilever: displacement minus indentation over force, at the
 * largest force. */
static double cantilever_compliance(const table_view *view, curve_block b)
{
    double largest = 0, per_force = (double)NAN;
    for (size_t i = b.from; i < b.to; i++) {
        const double force = curves_get(view, i, CURVES_FORCE);
        const double bent =
            curves_get(view, i, CURVES_DISPLACEMENT) - curves_get(view, i, CURVES_INDENTATION);
        if (!(fabs(force) > largest) || !isfinite(bent))
            continue;
        largest = fabs(force);
        per_force = bent / force;
    }
    return per_force;
}

/* Appends [number of samples, of approach samples, index of the first fitted sample in contact,
 * lowest and highest displacement, lowest and highest force, compliance of the cantilever, base64
 * of displacements, forces and fitted forces in contact]. */
static void add_samples_json(const table_view *view, curve_block b, text_buffer *to)
{
    const size_t n = b.to - b.from;
    size_t approach = 0, contact = 0;
    while (approach < n &&
           curves_enum(view, b.from + approach, CURVES_SEGMENT) == WT_SEGMENT_APPROACH)
        approach++;
    while (contact < approach &&
           !(curves_get(view, b.from + contact, CURVES_DISPLACEMENT) >= 0 &&
             isfinite(curves_get(view, b.from + contact, CURVES_FITTED_FORCE))))
        contact++;
    const number_range none = {(double)INFINITY, -(double)INFINITY};
    const number_range z = column_range(view, b, CURVES_DISPLACEMENT, none);
    const number_range f =
        column_range(view, b, CURVES_FITTED_FORCE, column_range(view, b, CURVES_FORCE, none));
    const size_t length = 2 * (2 * n + approach - contact);
    uint8_t *bytes = wt_alloc(length, 1), *end = bytes;
    for (size_t i = b.from; i < b.to; i++)
        end = write_packed(end, pack_value(curves_get(view, i, CURVES_DISPLACEMENT), z));
    for (size_t i = b.from; i < b.to; i++)
        end = write_packed(end, pack_value(curves_get(view, i, CURVES_FORCE), f));
    for (size_t i = b.from + contact; i < b.from + approach; i++)
        end = write_packed(end, pack_value(curves_get(view, i, CURVES_FITTED_FORCE), f));
    text_format(to, "[%zu,%zu,%zu", n, approach, contact);
    const double numbers[] = {z.low, z.high, f.low, f.high, cantilever_compliance(view, b)};
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        text_add(to, ",");
        add_json_number(to, numbers[k]);
    }
    text_add(to, ",");
    add_base64(to, bytes, length);
    text_add(to, "]");
    free(bytes);
}

/* ---- curves ---------------------------------------------------------------------------------- */

/* Appends [file, curve, verdict, reason, modulus, its error, contact point, x, y, samples or null];
 * `file` is an index into the list of files. */
static void add_curve_json(const table_view *rows, size_t row, size_t file, curve_finder *f,
                           text_buffer *to)
{
    static const indentation_column numbers[] = {INDENTATION_MODULUS,
                                                 INDENTATION_MODULUS_STANDARD_ERROR};
    text_format(to, "%s[%zu,%.0f,", row > 0 ? ",\n" : "", file,
                indentation_get(rows, row, INDENTATION_CURVE));
    text_json(to, indentation_text(rows, row, INDENTATION_VERDICT));
    text_add(to, ",");
    text_json(to, indentation_text(rows, row, INDENTATION_REASON));
    for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
        text_add(to, ",");
        add_json_number(to, indentation_get(rows, row, numbers[k]));
    }
    text_add(to, ",");
    add_exact_number(to, indentation_get(rows, row, INDENTATION_CONTACT_POINT));
    text_add(to, ",");
    add_json_number(to, indentation_get(rows, row, INDENTATION_X));
    text_add(to, ",");
    add_json_number(to, indentation_get(rows, row, INDENTATION_Y));
    text_add(to, ",");
    const curve_block *b = curve_finder_next(f, rows, row);
    if (b != NULL)
        add_samples_json(f->view, *b, to);
    else
        text_add(to, "null");
    text_add(to, "]");
}

static void add_group_json(const table_view *rows, curve_finder *f, text_buffer *to)
{
    text_buffer files = {0};
    const char *last = NULL;
    size_t n_files = 0;
    text_add(to, "{\"name\":");
    text_json(to, rows->suffix);
    text_add(to, ",\"curves\":[");
    for (size_t row = 0; row < rows->n_rows; row++) {
        const char *file = indentation_text(rows, row, INDENTATION_FILE);
        if (last == NULL || strcmp(file, last) != 0) {
            text_add(&files, n_files++ > 0 ? "," : "");
            text_json(&files, file);
            last = file;
        }
        add_curve_json(rows, row, n_files - 1, f, to);
    }
    text_add(to, "],\"files\":[");
    text_add(to, text_string(&files));
    text_add(to, "]}");
    text_free(&files);
}

/* Appends the earlier choices, which the page exports together with its own. */
static void add_choice_rows(const table_view *choices, text_buffer *to)
{
    static const overrides_column texts[] = {OVERRIDES_GROUP, OVERRIDES_FILE, OVERRIDES_CHOICE,
                                             OVERRIDES_VALUE, OVERRIDES_NOTE};
    for (size_t row = 0; row < choices->n_rows; row++) {
        text_add(to, row > 0 ? ",[" : "[");
        for (size_t k = 0; k < sizeof texts / sizeof texts[0]; k++) {
            text_json(to, overrides_text(choices, row, texts[k]));
            text_add(to, ",");
        }
        add_exact_number(to, overrides_get(choices, row, OVERRIDES_CURVE));
        text_add(to, "]");
    }
}

void append_browse_data(const figure_tables *tables, text_buffer *to)
{
    curve_finder f = {.view = &tables->curves};
    curve_finder_init(&f);
    text_add(to, "{\"groups\":[");
    for (size_t i = 0; i < tables->n_indentation; i++) {
        text_add(to, i > 0 ? "," : "");
        add_group_json(&tables->indentation[i], &f, to);
    }
    text_add(to, "],\"choices\":[");
    add_choice_rows(&tables->overrides, to);
    text_add(to, "],\"verdicts\":");
    append_verdict_text(to);
    text_add(to, "}");
    curve_finder_clear(&f);
}
