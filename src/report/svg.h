/* A picture of gnuplot's made fit to stand inside a page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_REPORT_SVG_H
#define WT_REPORT_SVG_H

#include "report/report_text.h"

/* Appends the <svg> element of `svg` to a page: without XML declaration, its ids and references
 * prefixed by `name` so that they are unique on the page, without gnuplot's own titles (they would
 * pop up as tool tips), and with `label` as its accessible name; no larger than that its type is
 * that of the page. false if it holds no <svg>. */
bool svg_inline(text_buffer *page, const char *svg, size_t length, const char *name,
                const char *label);

/* Appends the picture with its width and height, `unit` millimetres for each unit of its own. */
void svg_sized(text_buffer *out, const char *svg, size_t length, double unit);

#endif
