/* The XML of a description while it is read.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_DESCRIPTION_XML_H
#define WT_READ_DESCRIPTION_XML_H

#include "read/description/description.h"

#include <libxml/tree.h>

/* One reading: the first failure stays. */
typedef struct wt_parse {
    wt_description *d;
    const char *name;
    wt_status status;
    wt_error *err;
} wt_parse;

void wt_parse_no_memory(wt_parse *p);
/* "FILE: line 12, element column: MESSAGE; expected ...; found ..." */
void wt_parse_complain(wt_parse *p, const xmlNode *node, const char *message, const char *expected,
                       const char *found);
/* New strings; NULL if the attribute is absent. */
char *wt_parse_attribute(wt_parse *p, const xmlNode *node, const char *name);
char *wt_parse_content(wt_parse *p, const xmlNode *node);
/* The text as a normalised name; frees the text. */
char *wt_parse_normalised(wt_parse *p, char *text);
bool wt_parse_true(wt_parse *p, const xmlNode *node, const char *name);
/* Index of an attribute in n words; `absent` if it is not there. */
size_t wt_parse_one_of(wt_parse *p, const xmlNode *node, const char *name,
                       const char *const words[], size_t n, size_t absent);
size_t wt_parse_count(wt_parse *p, const xmlNode *node, const char *name, size_t absent);
bool wt_parse_is(const xmlNode *node, const char *name);
const xmlNode *wt_parse_child(const xmlNode *node, const char *name);
/* Zeroed room for as many items as `node` has children of that name (NULL: of any name). */
void *wt_parse_room(wt_parse *p, const xmlNode *node, const char *name, size_t size);
/* Compiles an attribute that is a regular expression with at least so many groups. */
void wt_parse_pattern(wt_parse *p, const xmlNode *node, const char *name, wt_pattern *pattern,
                      size_t groups);

/* description_parts.c: all of a document that follows the schema. */
void wt_parse_format(wt_parse *p, const xmlNode *root);

#endif
