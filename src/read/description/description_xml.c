/* Reads attributes, elements and regular expressions of a description.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/description/description_xml.h"

#include <stdlib.h>
#include <string.h>

void parse_no_memory(description_parser *p)
{
    if (p->status == WT_OK)
        p->status = wt_fail(p->err, WT_E_MEMORY, "no memory for a format description");
}

void parse_fail(description_parser *p, const xmlNode *node, const char *message,
                const char *expected, const char *found)
{
    if (p->status != WT_OK)
        return;
    p->status = wt_fail(p->err, WT_E_SCHEMA, "%s", message);
    wt_error_file(p->err, p->name);
    wt_error_place(p->err, "line %ld, element %s", xmlGetLineNo(node), (const char *)node->name);
    if (expected != NULL)
        wt_error_expected(p->err, "%s", expected);
    if (found != NULL)
        wt_error_found(p->err, "%s", found);
    wt_error_advice(p->err, "see weartrack-format(5)");
}

/* Copies a text of libxml2 that exists; NULL means lack of memory. */
static char *copy_xml(description_parser *p, xmlChar *text)
{
    if (text == NULL) {
        parse_no_memory(p);
        return NULL;
    }
    char *copy = arena_text(&p->d->memory, (const char *)text, strlen((const char *)text));
    xmlFree(text);
    return copy;
}

char *parse_attribute(description_parser *p, const xmlNode *node, const char *name)
{
    const xmlChar *attribute = (const xmlChar *)name;
    return xmlHasNsProp(node, attribute, NULL) != NULL
               ? copy_xml(p, xmlGetNoNsProp(node, attribute))
               : NULL;
}

char *parse_content(description_parser *p, const xmlNode *node)
{
    return copy_xml(p, xmlNodeGetContent(node));
}

char *parse_normalised(description_parser *p, const char *text)
{
    char name[COLUMN_NAME_SIZE];
    if (text == NULL)
        return NULL;
    name_normalise((text_span){text, strlen(text)}, name);
    return arena_text(&p->d->memory, name, strlen(name));
}

bool parse_bool(description_parser *p, const xmlNode *node, const char *name)
{
    const char *text = parse_attribute(p, node, name);
    return text != NULL && (strcmp(text, "true") == 0 || strcmp(text, "1") == 0);
}

/* The schema has checked the text, so the list is complete. */
size_t parse_choice(description_parser *p, const xmlNode *node, const char *name,
                    const char *const choices[], size_t n, size_t absent)
{
    const char *text = parse_attribute(p, node, name);
    size_t i = 0;
    if (text == NULL)
        return absent;
    while (i + 1 < n && strcmp(text, choices[i]) != 0)
        i++;
    return i;
}

size_t parse_count(description_parser *p, const xmlNode *node, const char *name, size_t absent)
{
    const char *text = parse_attribute(p, node, name);
    return text != NULL ? (size_t)strtoul(text, NULL, 10) : absent;
}

bool parse_is_element(const xmlNode *node, const char *name)
{
    return node->type == XML_ELEMENT_NODE &&
           (name == NULL || strcmp((const char *)node->name, name) == 0);
}

const xmlNode *parse_next_child(const description_parser *p, const xmlNode *node,
                                const xmlNode *after, const char *name)
{
    const xmlNode *c = after != NULL ? after->next : node->children;
    while (c != NULL && !parse_is_element(c, name))
        c = c->next;
    return p->status == WT_OK ? c : NULL;
}

size_t parse_count_children(const description_parser *p, const xmlNode *node, const char *name)
{
    size_t n = 0;
    for (const xmlNode *c = NULL; (c = parse_next_child(p, node, c, name)) != NULL;)
        n++;
    return n;
}

void *parse_alloc_children(description_parser *p, const xmlNode *node, const char *name,
                           size_t size)
{
    return arena_alloc(&p->d->memory, parse_count_children(p, node, name), size);
}

/* ---- regular expressions ------------------------------------------------------------------ */

/* Each + doubles the expression before it when it is compiled, and nested ones multiply. */
enum { MAX_PLUSES = 16 };

/* Returns a construct that is not allowed, or NULL. Repeat counts, back references and nested
 * repeats make compilation or matching explode; no description needs them. */
static const char *find_forbidden_construct(const char *source)
{
    bool set = false;
    int pluses = 0;
    for (const char *c = source; *c != '\0'; c++) {
        if (*c == '\\' && c[1] != '\0') {
            c++;
            if (*c >= '1' && *c <= '9')
                return "a back reference";
        } else if (set) {
            set = *c != ']';
        } else if (*c == '[') {
            set = true;
            c += c[1] == '^';
            c += c[1] == ']';
        } else if (*c == '{') {
            return "a repeat count {...}; write \\{ for the character";
        } else if (strchr("*+?", *c) != NULL) {
            if (c[1] != '\0' && strchr("*+?", c[1]) != NULL)
                return "a repeat of a repeat, such as ++";
            pluses += *c == '+';
            if (pluses > MAX_PLUSES)
                return "more than 16 times +; write * where it may be absent";
        }
    }
    return NULL;
}

/* Replaces \t by a tab, which an XML attribute cannot contain directly. */
static void expand_tab_escapes(char *source)
{
    char *to = source;
    for (const char *from = source; *from != '\0'; from++) {
        if (from[0] == '\\' && from[1] == 't') {
            *to++ = '\t';
            from++;
        } else if (from[0] == '\\' && from[1] != '\0') {
            *to++ = *from++;
            *to++ = *from;
        } else {
            *to++ = *from;
        }
    }
    *to = '\0';
}

static char first_byte(const char *source)
{
    char c = source[0] == '^' ? source[1] : '\0';
    char after = c != '\0' ? source[2] : '\0';
    if (c == '\\') {
        c = source[2];
        after = c != '\0' ? source[3] : '\0';
        if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'))
            return '\0';
    } else if (c != '\0' && strchr(".[]()*+?{}|^$", c) != NULL) {
        return '\0';
    }
    if ((after != '\0' && strchr("*?{|", after) != NULL) || strchr(source, '|') != NULL)
        return '\0';
    return c;
}

void parse_pattern(description_parser *p, const xmlNode *node, const char *name,
                   line_pattern *pattern, size_t groups)
{
    char *source = parse_attribute(p, node, name);
    char message[128];
    if (source == NULL)
        return;
    const char *what = find_forbidden_construct(source);
    if (what != NULL) {
        parse_fail(p, node, "regular expression not accepted", "an extended POSIX expression",
                   what);
        return;
    }
    expand_tab_escapes(source);
    int code = regcomp(&pattern->regex, source, REG_EXTENDED | (groups == 0 ? REG_NOSUB : 0));
    if (code == REG_ESPACE) {
        parse_no_memory(p);
        return;
    }
    if (code != 0) {
        regerror(code, &pattern->regex, message, sizeof message);
        parse_fail(p, node, message, "an extended POSIX regular expression", source);
        return;
    }
    pattern->compiled = true;
    pattern->first = first_byte(source);
    pattern->next = p->d->patterns;
    p->d->patterns = pattern;
    if (pattern->regex.re_nsub < groups)
        parse_fail(p, node, "regular expression without a group",
                   "parentheses around the part that is the value", source);
}
