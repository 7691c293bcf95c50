/* Reads and writes the files of a figure, and prepares its SVG for a page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/figure_files.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/number.h"
#include "report/gnuplot.h"
#include "report/report_files.h"

#include <ctype.h>
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
            return wt_fail(err, WT_E_ARG, "'%.*s' is not one of svg, pdf, png", (int)length, word);
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

/* ---- before drawing -------------------------------------------------------------------------- */

static wt_status figure_append_data(const figure_drawing *d, text_buffer *to, wt_error *err)
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

/* ---- after drawing --------------------------------------------------------------------------- */

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

/* Returns the length of `word` if s (n bytes) begins with it, else 0. */
static size_t prefix_length(const char *s, size_t n, const char *word)
{
    size_t length = strlen(word);
    return n >= length && memcmp(s, word, length) == 0 ? length : 0;
}

/* Returns the length up to and including the next `end`, or n. */
static size_t length_through(const char *s, size_t n, const char *end)
{
    const char *found = memmem(s, n, end, strlen(end));
    return found != NULL ? (size_t)(found - s) + strlen(end) : n;
}

bool svg_canvas_size(const char *svg, size_t length, double size[2])
{
    static const char box[] = "viewBox=\"0 0 ";
    const char *s = memmem(svg, length, box, sizeof box - 1);
    const char *const end = svg + length;
    if (s == NULL)
        return false;
    s += sizeof box - 1;
    for (int i = 0; i < 2; i++) {
        const char *number = s;
        while (s < end && *s != ' ' && *s != '"')
            s++;
        if (!parse_stored_number(number, (size_t)(s - number), &size[i]) ||
            !(size[i] > 0 && size[i] < 1e5))
            return false;
        s += s < end;
    }
    return true;
}

/* Appends the picture with width and height; `unit` is the size of its unit [mm]. */
static void svg_append_sized(text_buffer *out, const char *svg, size_t length, double unit)
{
    double size[2];
    const char *begin = memmem(svg, length, "<svg", 4);
    if (begin == NULL || !svg_canvas_size(svg, length, size)) {
        text_bytes(out, svg, length);
        return;
    }
    begin += 4;
    text_bytes(out, svg, (size_t)(begin - svg));
    text_format(out, " width=\"%.2fmm\" height=\"%.2fmm\"", unit * size[0], unit * size[1]);
    text_bytes(out, begin, (size_t)(svg + length - begin));
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

/* Scale of a picture: the type of the built-in style, 15 units, has 14/16 of the text size of a
 * page. All pictures then have equal type, and two of the usual width fit side by side. */
static const double rem_per_unit = 14.0 / 15 / 16;

/* Groups that gnuplot opens for each part of a plot and leaves empty. Returns the length of one at
 * the start of s, else 0. */
static size_t empty_group_length(const char *s, size_t n)
{
    if (prefix_length(s, n, "<g fill=\"none\" ") == 0)
        return 0;
    const size_t open = length_through(s, n, ">");
    size_t blank = open;
    while (blank < n && strchr(" \t\n", s[blank]) != NULL)
        blank++;
    const size_t close = prefix_length(s + blank, n - blank, "</g>");
    return close > 0 ? blank + close : 0;
}

/* Reads "rgb( 51, 102,   3)" at the start of s. Returns its length, else 0. */
static size_t read_rgb(const char *s, size_t n, unsigned colour[3])
{
    size_t used = prefix_length(s, n, "rgb(");
    for (int i = 0; used > 0 && i < 3; i++) {
        colour[i] = 0;
        while (used < n && s[used] == ' ')
            used++;
        for (; used < n && s[used] >= '0' && s[used] <= '9' && colour[i] < 256; used++)
            colour[i] = 10 * colour[i] + (unsigned)(s[used] - '0');
        if (used == n || colour[i] > 255 || s[used] != (i < 2 ? ',' : ')'))
            return 0;
        used++;
    }
    return used;
}

/* Rounds a coordinate such as "137.33" to a tenth of a unit. Numbers below 10, such as widths of
 * lines and opacities, stay. Returns its length, 0 if there is none at s. */
static size_t append_rounded(text_buffer *page, const char *s, size_t n)
{
    static const char digits[] = "0123456789";
    const size_t whole = strspn(s, digits);
    if (whole < 2 || whole > 6 || n < whole + 4 || s[whole] != '.' ||
        strspn(s + whole + 1, digits) != 2)
        return 0;
    const unsigned long hundredths = 100 * strtoul(s, NULL, 10) + strtoul(s + whole + 1, NULL, 10),
                        tenths = (hundredths + 5) / 10;
    text_format(page, tenths % 10 == 0 ? "%lu" : "%lu.%lu", tenths / 10, tenths % 10);
    return whole + 3;
}

/* A symbol of a plot, and its colour. */
typedef struct svg_use {
    size_t length; /* of the tag with the space after it; 0: no symbol with a colour */
    const char *colour;
    size_t n_colour;
} svg_use;

static svg_use read_use(const char *s, size_t n)
{
    static const char attribute[] = " color='";
    svg_use use = {0};
    const size_t tag = prefix_length(s, n, "<use ") > 0 ? length_through(s, n, ">") : 0;
    const char *const colour = memmem(s, tag, attribute, sizeof attribute - 1);
    if (colour == NULL)
        return use;
    use.colour = colour;
    use.n_colour = sizeof attribute + strcspn(colour + sizeof attribute - 1, "'");
    for (use.length = tag; use.length < n && strchr(" \t\n", s[use.length]) != NULL;)
        use.length++;
    return use;
}

static bool has_same_colour(const svg_use *a, const svg_use *b)
{
    return a->length > 0 && a->n_colour == b->n_colour &&
           memcmp(a->colour, b->colour, a->n_colour) == 0;
}

/* Puts symbols of one colour that follow one another into a group that states it once. `*run` is
 * the colour of the open group. Returns the length of a colour that is thus left out. */
static size_t group_symbols(text_buffer *page, const char *s, size_t n, svg_use *run)
{
    if (run->length > 0 && s >= run->colour && prefix_length(s, n, " color='") > 0)
        return run->n_colour;
    if (*s != '<')
        return 0;
    const svg_use use = read_use(s, n);
    if (run->length > 0 && !has_same_colour(run, &use)) {
        text_add(page, "</g>");
        *run = (svg_use){0};
    }
    if (run->length > 0 || use.length == 0)
        return 0;
    const svg_use next = read_use(s + use.length, n - use.length);
    if (!has_same_colour(&next, &use))
        return 0;
    *run = use;
    unsigned colour[3];
    if (read_rgb(use.colour + strlen(" color='"), use.n_colour, colour) > 0)
        text_format(page, "<g color='#%02x%02x%02x'>", colour[0], colour[1], colour[2]);
    else
        text_format(page, "<g%.*s>", (int)use.n_colour, use.colour);
    return 0;
}

/* Writes in a shorter form what gnuplot repeats in some thousand elements. Returns the length of
 * what it replaces at the start of s, 0 if nothing. */
static size_t append_shortened(text_buffer *page, const char *s, size_t n, bool in_tag)
{
    static const char default_attributes[] = " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"",
                      group[] = " fill=\"none\" color=\"black\" stroke=\"currentColor\"";
    unsigned colour[3];
    if (strchr("<\t xr", *s) == NULL) /* none of what follows begins otherwise */
        return 0;
    const size_t empty = empty_group_length(s, n), title = prefix_length(s, n, "<title>"),
                 description = prefix_length(s, n, "<desc>");
    if (empty > 0)
        return empty;
    if (title > 0 || description > 0)
        return length_through(s, n, title > 0 ? "</title>" : "</desc>");
    if (*s == '\t')
        return 1;
    if (!in_tag)
        return 0;
    if (prefix_length(s, n, "xlink:href=") > 0)
        return strlen("xlink:");
    if (prefix_length(s, n, group) > 0) {
        text_add(page, " class=\"g\""); /* the style sheet of the page states it */
        return sizeof group - 1;
    }
    const size_t rgb = read_rgb(s, n, colour),
                 font = prefix_length(s, n, " font-family=\"Helvetica\"");
    if (font > 0)
        return font; /* the style sheet, too */
    if (rgb > 0) {
        text_format(page, "#%02x%02x%02x", colour[0], colour[1], colour[2]);
        return rgb;
    }
    return prefix_length(s, n, default_attributes);
}

/* Finds the definitions of the symbols, which begin with the first of them. */
static const char *find_symbols(const char *svg, size_t length, size_t *symbols_length)
{
    static const char open[] = "<defs>", close[] = "</defs>";
    const char *const begin = memmem(svg, length, open, sizeof open - 1);
    if (begin != NULL)
        *symbols_length = length_through(begin, length - (size_t)(begin - svg), close);
    return begin;
}

bool svg_append_inline(text_buffer *page, const char *svg, size_t length, const char *name,
                       const char *id, const char *label, svg_symbols *symbols)
{
    static const char *const references[] = {" id='", " id=\"", "href='#", "href=\"#",
                                             "url(#", "url('#", "url(\"#"};
    const char *begin = memmem(svg, length, "<svg", 4);
    if (begin == NULL)
        return false;
    const char *const end = svg + length;
    double size[2];
    text_html(page, "<svg id=\"picture-%s\" role=\"img\" aria-label=\"%s\"", name, label);
    if (svg_canvas_size(begin, (size_t)(end - begin), size))
        text_format(page, " style=\"max-width:%.1frem\"", rem_per_unit * size[0]);
    bool in_tag = true;
    size_t symbols_length = 0;
    const char *const own = find_symbols(begin, (size_t)(end - begin), &symbols_length);
    const bool is_first = symbols->text == NULL;
    const bool is_shared = own != NULL && !is_first && symbols->length == symbols_length &&
                           memcmp(symbols->text, own, symbols_length) == 0;
    if (own != NULL && is_first)
        *symbols = (svg_symbols){own, symbols_length};
    svg_use run = {0};
    for (const char *s = begin + 4; s < end;) {
        const size_t left = (size_t)(end - s);
        size_t shortened =
            is_shared && s == own ? symbols_length : group_symbols(page, s, left, &run);
        if (shortened == 0)
            shortened = append_shortened(page, s, left, in_tag);
        if (shortened == 0 && in_tag && !isdigit((unsigned char)s[-1]) && s[-1] != '.')
            shortened = append_rounded(page, s, left);
        if (shortened > 0) {
            s += shortened;
            continue;
        }
        size_t word = 0;
        in_tag = *s == '<' || (in_tag && *s != '>'); // text between tags is not changed
        for (size_t i = 0;
             in_tag && strchr(" hu", *s) != NULL && i < COUNT_OF(references) && word == 0; i++)
            word = prefix_length(s, left, references[i]);
        text_bytes(page, s, word > 0 ? word : 1);
        const bool is_symbol = prefix_length(s + word, left - word, "gp") > 0;
        if (word > 0 && !(is_symbol && (is_first || is_shared)))
            text_format(page, "%s-", id);
        s += word > 0 ? word : 1;
    }
    return true;
}
