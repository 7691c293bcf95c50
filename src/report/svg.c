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

bool svg_append_inline(text_buffer *page, const char *svg, size_t length, const char *name,
                       const char *label)
{
    static const char *const references[] = {" id='", " id=\"", "href='#", "href=\"#",
                                             "url(#", "url('#", "url(\"#"};
    /* Default attributes that gnuplot repeats in some thousand elements. */
    static const char default_attributes[] = " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"";
    const char *begin = memmem(svg, length, "<svg", 4);
    if (begin == NULL)
        return false;
    const char *const end = svg + length;
    double size[2];
    text_html(page, "<svg role=\"img\" aria-label=\"%s\"", label);
    if (canvas_size(begin, (size_t)(end - begin), size))
        text_format(page, " style=\"max-width:%.1frem\"", rem_per_unit * size[0]);
    bool in_tag = true;
    for (const char *s = begin + 4; s < end;) {
        const size_t left = (size_t)(end - s);
        if (prefix_length(s, left, "<title>")) {
            s += length_through(s, left, "</title>");
        } else if (prefix_length(s, left, "<desc>")) {
            s += length_through(s, left, "</desc>");
        } else if (in_tag && prefix_length(s, left, default_attributes)) {
            s += sizeof default_attributes - 1;
        } else {
            size_t word = 0;
            in_tag = *s == '<' || (in_tag && *s != '>'); // text between tags is not changed
            for (size_t i = 0; in_tag && i < COUNT_OF(references) && word == 0; i++)
                word = prefix_length(s, left, references[i]);
            text_bytes(page, s, word > 0 ? word : 1);
            if (word > 0)
                text_format(page, "%s-", name);
            s += word > 0 ? word : 1;
        }
    }
    return true;
}
