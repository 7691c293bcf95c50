/* Prepares SVG pictures of gnuplot for embedding in a page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_SVG_H
#define WT_REPORT_SVG_H

#include "report/report_text.h"

/* Definitions of the symbols of the first picture of a page, which all others share. They point
 * into that picture. */
typedef struct svg_symbols {
    const char *text; /* NULL before the first picture */
    size_t length;
} svg_symbols;

/* Appends the <svg> element of `svg` to a page, without XML declaration. Its ids and references
 * have the prefix `name`, so that they are unique on the page. Titles of gnuplot, which would
 * appear as tool tips, are removed. `label` is the accessible name. Its size is limited so that its
 * type is not larger than that of the page. Returns false if there is no <svg>.
 * `symbols` is zero before the first picture of the page. */
bool svg_append_inline(text_buffer *page, const char *svg, size_t length, const char *id,
                       const char *label, svg_symbols *symbols);

/* Appends the picture with width and height; `unit` is the size of its unit [mm]. */
void svg_append_sized(text_buffer *out, const char *svg, size_t length, double unit);

#endif
