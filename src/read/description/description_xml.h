/* Declares the parser of the XML of a description. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_DESCRIPTION_XML_H
#define WT_READ_DESCRIPTION_XML_H

#include "read/description/description.h"

#include <libxml/tree.h>

/* State of one parse. It stores the first failure, and later functions then do nothing. */
typedef struct description_parser {
    text_description *d;
    const char *name;
    wt_status status;
    wt_error *err;
} description_parser;

void parse_no_memory(description_parser *p);
/* Fails with "FILE: line 12, element column: MESSAGE; expected ...; found ...". */
void parse_fail(description_parser *p, const xmlNode *node, const char *message,
                const char *expected, const char *found);
/* Returns NULL if the attribute is absent. */
char *parse_attribute(description_parser *p, const xmlNode *node, const char *name);
char *parse_content(description_parser *p, const xmlNode *node);
/* Returns the text as a normalised name; NULL for NULL. */
char *parse_normalised(description_parser *p, const char *text);
bool parse_bool(description_parser *p, const xmlNode *node, const char *name);
/* Returns the index of an attribute value in n words; `absent` if there is no attribute. */
size_t parse_choice(description_parser *p, const xmlNode *node, const char *name,
                    const char *const choices[], size_t n, size_t absent);
size_t parse_count(description_parser *p, const xmlNode *node, const char *name, size_t absent);
bool parse_is_element(const xmlNode *node, const char *name);
/* Returns the next child element with this name (NULL: any) after `after` (NULL: the first). NULL
 * at the end and after a failure. */
const xmlNode *parse_next_child(const description_parser *p, const xmlNode *node,
                                const xmlNode *after, const char *name);
size_t parse_count_children(const description_parser *p, const xmlNode *node, const char *name);
/* Allocates as many items as `node` has children with this name. */
void *parse_alloc_children(description_parser *p, const xmlNode *node, const char *name,
                           size_t size);
/* Compiles an attribute as a regular expression with at least `groups` groups. */
void parse_pattern(description_parser *p, const xmlNode *node, const char *name,
                   line_pattern *pattern, size_t groups);

#endif
