/* Reads parameters, text and file sets from the nodes of a case file.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/case_node.h"
#include "core/base/memory.h"
#include "core/base/param.h"
#include "core/base/shared_params.h"
#include "indentation/indent.h"

#include <math.h>
#include <string.h>

/* ---- file sets ------------------------------------------------------------------------------- */

static case_files case_files_defaults(void)
{
    return (case_files){.spring_constant = {(double)NAN, 0, 0, "N/m"},
                        .sensitivity = {(double)NAN, 0, 0, "m/V"}};
}

static const wt_param rows[] = {SPRING_CONSTANT(case_files, PARAM_NO_OPTION, indent_error_check),
                                SENSITIVITY(case_files, PARAM_NO_OPTION, indent_error_check)};

PARAM_TABLE(case_group_params, case_files, rows, case_files_defaults, NO_PARTS)

/* The attributes of a node override the values that `set` and `cantilever` have already. */
static wt_status read_attributes(wt_case *c, const xmlNode *node, wt_file_set *set,
                                 case_files *cantilever, wt_error *err)
{
    case_files *stated = arena_alloc(&c->memory, 1, sizeof *stated);
    *stated = *cantilever;
    wt_status status = case_read_params(c, node, case_group_params(), stated, err);
    if (status == WT_OK)
        status = case_read_params(c, node, wt_file_set_params(), set, err);
    *cantilever = *stated;
    set->read.spring_constant = cantilever->spring_constant.value;
    set->read.sensitivity = cantilever->sensitivity.value;
    return status;
}

static bool is_same_value(double a, double b)
{
    return !(a < b) && !(a > b) && !isnan(a) && !isnan(b);
}

/* Combines the values of all files of a group. The value is NaN if the files differ; the relative
 * error is the largest one, NaN if a file states none. */
static void merge_file_estimate(wt_estimate *group, double *error, wt_estimate of_file, bool first)
{
    const double relative = of_file.standard_error / of_file.value;
    if (first) {
        *group = of_file;
        *error = relative > 0 ? relative : (double)NAN;
        return;
    }
    *error = relative > 0 && !isnan(*error) ? fmax(*error, relative) : (double)NAN;
    if (is_same_value(group->value, of_file.value))
        group->standard_error = fmax(group->standard_error, of_file.standard_error);
    else
        group->value = (double)NAN;
}

wt_status case_read_files(wt_case *c, const xmlNode *parent, const char *name, case_files *files,
                          wt_error *err)
{
    size_t n = 0;
    for (const xmlNode *node = case_child(parent, name); node != NULL; node = case_next(node, name))
        n++;
    wt_file_set *common = arena_alloc(&c->memory, 1, sizeof *common);
    const char **patterns = arena_alloc(&c->memory, n, sizeof *patterns);
    files->sets = arena_alloc(&c->memory, n, sizeof *files->sets);
    *common = (wt_file_set){.folder = c->folder, .read = wt_read_defaults()};
    case_files group = case_files_defaults();
    wt_status status = read_attributes(c, parent, common, &group, err);
    files->n = n;
    files->next = c->roles;
    c->roles = files;
    const xmlNode *node = case_child(parent, name);
    for (size_t i = 0; status == WT_OK && i < n; i++, node = case_next(node, name)) {
        wt_file_set *set = &files->sets[i];
        case_files cantilever = group;
        *set = *common;
        status = read_attributes(c, node, set, &cantilever, err);
        patterns[i] = case_node_text(c, node);
        set->patterns = &patterns[i];
        set->n_patterns = 1;
        merge_file_estimate(&files->spring_constant, &files->lever_error,
                            cantilever.spring_constant, i == 0);
        merge_file_estimate(&files->sensitivity, &files->sensitivity_error, cantilever.sensitivity,
                            i == 0);
    }
    return status;
}

/* ---- nodes ----------------------------------------------------------------------------------- */

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
