/* Prepares SVG pictures of gnuplot for embedding in a page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/svg.h"

#include "core/base/array.h"
#include "core/base/number.h"

#include <string.h>

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

/* Reads width and height of the picture in its own units; false if it does not state them. */
static bool canvas_size(const char *svg, size_t length, double size[2])
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

void svg_append_sized(text_buffer *out, const char *svg, size_t length, double unit)
{
    double size[2];
    const char *begin = memmem(svg, length, "<svg", 4);
    if (begin == NULL || !canvas_size(svg, length, size)) {
        text_bytes(out, svg, length);
        return;
    }
    begin += 4;
    text_bytes(out, svg, (size_t)(begin - svg));
    text_format(out, " width=\"%.2fmm\" height=\"%.2fmm\"", unit * size[0], unit * size[1]);
    text_bytes(out, begin, (size_t)(svg + length - begin));
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

/* Writes in a shorter form what gnuplot repeats in some thousand elements. Returns the length of
 * what it replaces at the start of s, 0 if nothing. */
static size_t append_shortened(text_buffer *page, const char *s, size_t n, bool in_tag)
{
    static const char default_attributes[] = " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"";
    unsigned colour[3];
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
    const size_t rgb = read_rgb(s, n, colour),
                 font = prefix_length(s, n, " font-family=\"Helvetica\"");
    if (font > 0)
        return font; /* the style sheet of the page states it */
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

bool svg_append_inline(text_buffer *page, const char *svg, size_t length, const char *id,
                       const char *label, svg_symbols *symbols)
{
    static const char *const references[] = {" id='", " id=\"", "href='#", "href=\"#",
                                             "url(#", "url('#", "url(\"#"};
    const char *begin = memmem(svg, length, "<svg", 4);
    if (begin == NULL)
        return false;
    const char *const end = svg + length;
    double size[2];
    text_html(page, "<svg role=\"img\" aria-label=\"%s\"", label);
    if (canvas_size(begin, (size_t)(end - begin), size))
        text_format(page, " style=\"max-width:%.1frem\"", rem_per_unit * size[0]);
    bool in_tag = true;
    size_t symbols_length = 0;
    const char *const own = find_symbols(begin, (size_t)(end - begin), &symbols_length);
    const bool is_first = symbols->text == NULL;
    const bool is_shared = own != NULL && !is_first && symbols->length == symbols_length &&
                           memcmp(symbols->text, own, symbols_length) == 0;
    if (own != NULL && is_first)
        *symbols = (svg_symbols){own, symbols_length};
    for (const char *s = begin + 4; s < end;) {
        const size_t left = (size_t)(end - s),
                     shortened = is_shared && s == own ? symbols_length
                                                       : append_shortened(page, s, left, in_tag);
        if (shortened > 0) {
            s += shortened;
            continue;
        }
        size_t word = 0;
        in_tag = *s == '<' || (in_tag && *s != '>'); // text between tags is not changed
        for (size_t i = 0; in_tag && i < COUNT_OF(references) && word == 0; i++)
            word = prefix_length(s, left, references[i]);
        text_bytes(page, s, word > 0 ? word : 1);
        const bool is_symbol = prefix_length(s + word, left - word, "gp") > 0;
        if (word > 0 && !(is_symbol && (is_first || is_shared)))
            text_format(page, "%s-", id);
        s += word > 0 ? word : 1;
    }
    return true;
}
