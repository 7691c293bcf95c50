/* Reads parameters and text from the nodes of a case file. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "case/case_node.h"

#include "core/base/memory.h"
#include "core/base/param.h"

#include <string.h>

static bool is_element_named(const xmlNode *node, const char *name)
{
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

xmlNode *case_child(const xmlNode *parent, const char *name)
{
    for (xmlNode *node = parent->children; node != NULL; node = node->next)
        if (is_element_named(node, name))
            return node;
    return NULL;
}

xmlNode *case_next(const xmlNode *node, const char *name)
{
    for (xmlNode *next = node->next; next != NULL; next = next->next)
        if (is_element_named(next, name))
            return next;
    return NULL;
}

wt_status case_add_location(const xmlNode *node, wt_status status, wt_error *err)
{
    wt_error_place(err, "line %ld, <%s>", xmlGetLineNo(node), (const char *)node->name);
    return status;
}

const char *case_param_name(const char *section, const char *param)
{
    const size_t n = strlen(section);
    return strncmp(param, section, n) == 0 && param[n] == '-' ? param + n + 1 : param;
}

wt_status case_add_param_location(const xmlNode *section, wt_status status, wt_error *err)
{
    if (status == WT_OK)
        return WT_OK;
    const char *param = err != NULL ? err->place : "";
    const xmlNode *node = case_child(section, case_param_name((const char *)section->name, param));
    return case_add_location(node != NULL ? node : section, status, err);
}

/* Copies `raw` without surrounding blanks into the memory of the case. Frees `raw`. */
static const char *store_text(wt_case *c, xmlChar *raw)
{
    static const char blanks[] = " \t\r\n";
    if (raw == NULL) /* libxml2 had no memory; it does not tell the size */
        out_of_memory(0);
    const char *begin = (const char *)raw + strspn((const char *)raw, blanks);
    size_t length = strlen(begin);
    while (length > 0 && strchr(blanks, begin[length - 1]) != NULL)
        length--;
    const char *const copy = arena_text(&c->memory, begin, length);
    xmlFree(raw);
    return copy;
}

const char *case_node_text(wt_case *c, const xmlNode *node)
{
    return store_text(c, xmlNodeGetContent(node));
}

static wt_status read_attribute(wt_case *c, const xmlNode *section, const char *param,
                                const char *name, case_setting *setting, wt_error *err)
{
    const char *const text = store_text(c, xmlGetProp(section, (const xmlChar *)name));
    const wt_status status =
        wt_params_set(setting->params, param, setting->structure, text, &setting->given, err);
    if (status != WT_OK)
        wt_error_place(err, "line %ld, attribute %s of <%s>", xmlGetLineNo(section), name,
                       (const char *)section->name);
    return status;
}

/* Reads every element with the name; the schema allows a repetition only for lists. */
static wt_status read_param(wt_case *c, const xmlNode *section, const char *param,
                            case_setting *setting, wt_error *err)
{
    const char *const name = case_param_name((const char *)section->name, param);
    const xmlNode *node = case_child(section, name);
    if (node == NULL && xmlHasProp(section, (const xmlChar *)name) != NULL)
        return read_attribute(c, section, param, name, setting, err);
    for (; node != NULL; node = case_next(node, name)) {
        const wt_status status = wt_params_set(setting->params, param, setting->structure,
                                               case_node_text(c, node), &setting->given, err);
        if (status != WT_OK)
            return case_add_location(node, status, err);
    }
    return WT_OK;
}

wt_status case_read_params(wt_case *c, const xmlNode *section, const wt_params *params,
                           void *structure, wt_error *err)
{
    case_setting *setting = arena_alloc(&c->memory, 1, sizeof *setting);
    *setting = (case_setting){params, structure, 0, c->settings};
    c->settings = setting;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < wt_params_count(params); i++) {
        const wt_param *param = wt_params_get(params, i);
        if ((param->flags & PARAM_NO_CASE) == 0)
            status = read_param(c, section, param->name, setting, err);
    }
    return status;
}
