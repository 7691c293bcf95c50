/* Reading quantities, flags and files from the nodes of a case file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/case/case_node.h"

#include <libxml/tree.h>
#include <stdlib.h>
#include <string.h>

static bool is_called(const xmlNode *node, const char *name)
{
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

xmlNode *case_child(const xmlNode *parent, const char *name)
{
    for (xmlNode *node = parent->children; node != NULL; node = node->next)
        if (is_called(node, name))
            return node;
    return NULL;
}

xmlNode *case_next(const xmlNode *node, const char *name)
{
    for (xmlNode *next = node->next; next != NULL; next = next->next)
        if (is_called(next, name))
            return next;
    return NULL;
}

wt_status case_at(const xmlNode *node, const char *attribute, wt_status status, wt_error *err)
{
    if (attribute != NULL)
        wt_error_place(err, "line %ld, attribute %s of <%s>", xmlGetLineNo(node), attribute,
                       (const char *)node->name);
    else
        wt_error_place(err, "line %ld, <%s>", xmlGetLineNo(node), (const char *)node->name);
    return status;
}

/* Text of a node owned by the case, blanks around it removed; takes `raw`. */
static wt_status keep(wt_case *c, xmlChar *raw, const char **text, wt_error *err)
{
    static const char blanks[] = " \t\r\n";
    char *copy = NULL;
    if (raw != NULL) {
        const char *begin = (const char *)raw + strspn((const char *)raw, blanks);
        size_t length = strlen(begin);
        while (length > 0 && strchr(blanks, begin[length - 1]) != NULL)
            length--;
        copy = case_text(c, begin, length);
    }
    xmlFree(raw);
    if (copy == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    *text = copy;
    return WT_OK;
}

wt_status case_node_text(wt_case *c, const xmlNode *node, const char **text, wt_error *err)
{
    return keep(c, xmlNodeGetContent(node), text, err);
}

wt_status case_get_text(wt_case *c, const xmlNode *parent, const char *name, const char **text,
                        wt_error *err)
{
    xmlNode *node = case_child(parent, name);
    return node == NULL ? WT_OK : case_node_text(c, node, text, err);
}

wt_status case_get_attribute(wt_case *c, const xmlNode *node, const char *name, const char **text,
                             wt_error *err)
{
    if (xmlHasProp(node, (const xmlChar *)name) == NULL)
        return WT_OK;
    return keep(c, xmlGetProp(node, (const xmlChar *)name), text, err);
}

wt_status case_get_estimate(wt_case *c, const xmlNode *parent, const char *name,
                            wt_quantity quantity, wt_estimate *estimate, wt_error *err)
{
    const char *text = NULL;
    wt_status status = case_get_text(c, parent, name, &text, err);
    if (status != WT_OK || text == NULL)
        return status;
    status = wt_estimate_parse(text, quantity, estimate, err);
    return status == WT_OK ? WT_OK : case_at(case_child(parent, name), NULL, status, err);
}

wt_status case_get_attribute_estimate(wt_case *c, const xmlNode *node, const char *name,
                                      wt_quantity quantity, wt_estimate *estimate, wt_error *err)
{
    const char *text = NULL;
    wt_status status = case_get_attribute(c, node, name, &text, err);
    if (status != WT_OK || text == NULL)
        return status;
    status = wt_estimate_parse(text, quantity, estimate, err);
    return status == WT_OK ? WT_OK : case_at(node, name, status, err);
}

/* An error that is stated but changes nothing would be a number that is wrong without saying so. */
static wt_status refuse_error(wt_error *err)
{
    wt_fail(err, WT_E_ARG, "an error stated here would not be used");
    wt_error_advice(err, "leave out what follows +-");
    return WT_E_ARG;
}

wt_status case_get_number(wt_case *c, const xmlNode *parent, const char *name, wt_quantity quantity,
                          double *value, wt_error *err)
{
    if (case_child(parent, name) == NULL)
        return WT_OK;
    wt_estimate e = {0};
    wt_status status = case_get_estimate(c, parent, name, quantity, &e, err);
    if (status != WT_OK)
        return status;
    if (e.standard_error > 0)
        return case_at(case_child(parent, name), NULL, refuse_error(err), err);
    *value = e.value;
    return WT_OK;
}

wt_status case_get_attribute_number(wt_case *c, const xmlNode *node, const char *name,
                                    wt_quantity quantity, double *value, wt_error *err)
{
    wt_estimate e = {*value, 0, 0, wt_quantity_unit(quantity)};
    wt_status status = case_get_attribute_estimate(c, node, name, quantity, &e, err);
    if (status != WT_OK)
        return status;
    if (e.standard_error > 0)
        return case_at(node, name, refuse_error(err), err);
    *value = e.value;
    return WT_OK;
}

wt_status case_get_flag(wt_case *c, const xmlNode *parent, const char *name, bool *flag,
                        wt_error *err)
{
    const char *text = NULL;
    wt_status status = case_get_text(c, parent, name, &text, err);
    if (status == WT_OK && text != NULL)
        *flag = strcmp(text, "yes") == 0;
    return status;
}

wt_status case_get_list(wt_case *c, const xmlNode *parent, const char *name, wt_quantity quantity,
                        const double **values, size_t *n, wt_error *err)
{
    const char *text = NULL;
    double *list = NULL;
    wt_status status = case_get_text(c, parent, name, &text, err);
    if (status != WT_OK || text == NULL)
        return status;
    status = wt_list_parse(text, quantity, &list, n, err);
    if (status != WT_OK)
        return case_at(case_child(parent, name), NULL, status, err);
    double *kept = case_alloc(c, *n * sizeof *kept);
    if (kept != NULL)
        memcpy(kept, list, *n * sizeof *kept);
    free(list);
    if (kept == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    *values = kept;
    return WT_OK;
}

wt_status case_require(bool good, const xmlNode *parent, const char *name, const char *expected,
                       double found, wt_error *err)
{
    if (good)
        return WT_OK;
    const xmlNode *node = case_child(parent, name);
    wt_fail(err, WT_E_RANGE, "the value of %s is outside its range", name);
    wt_error_expected(err, "%s", expected);
    wt_error_found(err, "%g", found);
    return case_at(node != NULL ? node : parent, NULL, WT_E_RANGE, err);
}
