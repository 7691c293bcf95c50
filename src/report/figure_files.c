/* Reads and writes the files of a figure.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/figure_files.h"

#include "core/base/memory.h"

#include "report/gnuplot.h"
#include "report/report_files.h"
#include "report/svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* Unit of a picture, 8/15 point [m], as in output.gnuplot. */
static const double unit_length = 8.0 / 15 * 0.0254 / 72;
/* Resolution of a bitmap [1/m], 600 dpi. */
static const double dots_per_metre = 600 / 0.0254;
const double figure_text_width = 0.170;

/* ---- options --------------------------------------------------------------------------------- */

const char *figure_format_name(size_t i)
{
    static const char *const endings[] = {"svg", "pdf", "png"};
    return i < sizeof endings / sizeof *endings ? endings[i] : NULL;
}

wt_status figure_formats_read(const char *text, void *member, wt_error *err)
{
    unsigned formats = 0;
    for (const char *word = text;; word++) {
        const size_t length = strcspn(word, ",");
        size_t i = 0;
        while (figure_format_name(i) != NULL && (strlen(figure_format_name(i)) != length ||
                                                 strncmp(word, figure_format_name(i), length) != 0))
            i++;
        if (figure_format_name(i) == NULL)
            return wt_fail(err, WT_E_ARG, "'%.*s' is none of svg, pdf, png", (int)length, word);
        formats |= 1U << i;
        word += length;
        if (*word == '\0')
            break;
    }
    *(unsigned *)member = formats;
    return WT_OK;
}

wt_status figure_font_check(const void *member, wt_error *err)
{
    const char *const name = *(const char *const *)member;
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789 -";
    const size_t length = name != NULL ? strlen(name) : 0;
    if (name == NULL || (length > 0 && length <= FONT_NAME_LIMIT && strspn(name, plain) == length))
        return WT_OK;
    wt_status status = wt_fail(err, WT_E_ARG, "no name of a font");
    wt_error_expected(err,
                      "at most %d letters, digits, blanks and hyphens, such as Arial or Liberation "
                      "Sans",
                      FONT_NAME_LIMIT);
    if (length <= FONT_NAME_LIMIT)
        wt_error_found(err, "\"%s\"", name);
    else
        wt_error_found(err, "%zu", length);
    return status;
}

/* ---- before drawing ---------------------------------------------------------------------------
 */

wt_status figure_append_data(const figure_drawing *d, text_buffer *to, wt_error *err)
{
    wt_status status = WT_OK;
    char *bytes = NULL;
    size_t length = 0;
    FILE *stream = text_stream_open(&bytes, &length);
    for (size_t i = 0; i < d->n_sections && status == WT_OK; i++) {
        if (i > 0) // gnuplot's `index` counts sections that two blank lines separate
            (void)fputs("\n\n", stream);
        status = wt_stream_write(stream, d->sections[i], NULL, err);
    }
    text_stream_close(stream);
    if (status == WT_OK)
        text_bytes(to, bytes, length);
    free(bytes);
    return status;
}

static wt_status write_data(const report_folder *folder, drawn_figure *figure, wt_error *err)
{
    char name[128];
    const wt_status status = figure_append_data(&figure->drawing, &figure->data, err);
    (void)snprintf(name, sizeof name, "plots/%s.tsv", figure->drawing.figure->name);
    return status != WT_OK
               ? status
               : folder_write(folder, name, text_string(&figure->data), figure->data.length, err);
}

/* Writes the sizes and the font for the style. */
static void add_sizes(text_buffer *script, const figure_drawing *d,
                      const wt_report_options *options)
{
    text_format(script, "figure_name = '%s'; figure_width = %s; figure_height = %s\n",
                d->figure->name, LITERAL(d->width), LITERAL(d->height));
    if (!isnan(options->width))
        text_format(script, "panel_width = %s # so that all are %s mm wide\n",
                    LITERAL(options->width / unit_length / d->width),
                    LITERAL(1e3 * options->width));
    if (options->font != NULL)
        text_format(script, "figure_font = '%s'\n", options->font);
}

static wt_status write_figure_script(const report_folder *folder, const wt_report_options *options,
                                     drawn_figure *drawn, wt_error *err)
{
    const figure_drawing *const d = &drawn->drawing;
    const char *const figure = d->figure->name;
    text_buffer *const script = &drawn->script;
    char name[128];
    text_format(script, "# %s. To draw it again: gnuplot %s.gp\n", d->figure->title, figure);
    text_format(script,
                "# Data: %s.tsv, in SI units; x_unit and so on turn them into those of "
                "the axes.\n",
                figure);
    text_comment(script, text_string(&d->caption));
    text_add(script, "reset\n");
    add_sizes(script, d, options);
    text_add(script, "load 'style.gp'\nload 'output.gp'\nset datafile separator \"\\t\"\n");
    text_add(script, text_string(&d->script));
    text_add(script, "set output\n");
    (void)snprintf(name, sizeof name, "plots/%s.gp", figure);
    return folder_write(folder, name, text_string(script), script->length, err);
}

wt_status figure_write(const report_folder *folder, const wt_report_options *options,
                       drawn_figure *figure, wt_error *err)
{
    const wt_status status = write_data(folder, figure, err);
    return status == WT_OK ? write_figure_script(folder, options, figure, err) : status;
}

/* ---- after drawing ----------------------------------------------------------------------------
 */

/* Appends the file "plots/NAME.ENDING" and stores this name in `name`. */
static wt_status read_figure_picture(const report_folder *folder, const drawn_figure *figure,
                                     const char *ending, char name[128], text_buffer *picture,
                                     wt_error *err)
{
    (void)snprintf(name, 128, "plots/%s.%s", figure->drawing.figure->name, ending);
    char *path = wt_path_join(folder_plots_path(folder), wt_path_base(name));
    const wt_status status = read_whole_file(path, GNUPLOT_PICTURE_LIMIT, picture, err);
    free(path);
    return status;
}

static void write_big_endian(unsigned char *at, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(word >> (24 - 8 * i));
}

/* Adds the resolution to a bitmap (PNG 1.2, chunk pHYs). Without it a page uses the resolution of a
 * screen. */
static wt_status set_bitmap_resolution(const report_folder *folder, const drawn_figure *figure,
                                       wt_error *err)
{
    enum { HEAD = 8 + 25, WORDS = 8 + 9, CHUNK = WORDS + 4 }; // signature and IHDR; type and data
    unsigned char chunk[CHUNK] = "\0\0\0\x09pHYs";
    text_buffer picture = {0}, sized = {0};
    char name[128];
    write_big_endian(chunk + 8, (uint32_t)lrint(dots_per_metre));
    write_big_endian(chunk + 12, (uint32_t)lrint(dots_per_metre));
    chunk[16] = 1; // the unit is the metre
    write_big_endian(chunk + WORDS, (uint32_t)crc32(crc32(0, NULL, 0), chunk + 4, WORDS - 4));
    wt_status status = read_figure_picture(folder, figure, "png", name, &picture, err);
    if (status == WT_OK && picture.length < HEAD)
        status = wt_fail(err, WT_E_TOOL, "the picture of figure %s is not PNG",
                         figure->drawing.figure->name);
    if (status == WT_OK) {
        text_bytes(&sized, picture.bytes, HEAD);
        text_bytes(&sized, (const char *)chunk, CHUNK);
        text_bytes(&sized, picture.bytes + HEAD, picture.length - HEAD);
        status = folder_write(folder, name, sized.bytes, sized.length, err);
    }
    text_free(&picture);
    text_free(&sized);
    return status;
}

wt_status figure_collect(const report_folder *folder, const wt_report_options *options,
                         drawn_figure *figure, wt_error *err)
{
    char name[128];
    wt_status status = read_figure_picture(folder, figure, "svg", name, &figure->svg, err);
    if (status == WT_OK && (options->figures & WT_FIGURE_SVG) != 0) {
        text_buffer sized = {0};
        svg_append_sized(&sized, text_string(&figure->svg), figure->svg.length, 1e3 * unit_length);
        status = folder_write(folder, name, text_string(&sized), sized.length, err);
        text_free(&sized);
    }
    if (status == WT_OK && (options->figures & WT_FIGURE_PNG) != 0)
        status = set_bitmap_resolution(folder, figure, err);
    return status;
}
