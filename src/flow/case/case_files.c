/* The files of a case and how they are read.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/case/case_sections.h"

#include "read/params.h"

#include <math.h>

static case_files no_files(void)
{
    return (case_files){.spring_constant = {(double)NAN, 0, 0, "N/m"}};
}

static const wt_param rows[] = {SPRING_CONSTANT(case_files, PARAM_NO_OPTION)};
PARAM_TABLE(case_group_params, case_files, rows, no_files, NO_PARTS)

/* What the attributes of a node say on top of what is there. */
static wt_status read_attributes(wt_case *c, const xmlNode *node, wt_file_set *set,
                                 wt_estimate *spring_constant, wt_error *err)
{
    case_files *stated = pool_alloc(&c->memory, 1, sizeof *stated);
    if (stated == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    stated->spring_constant = *spring_constant;
    wt_status status = case_read_params(c, node, case_group_params(), stated, err);
    if (status == WT_OK)
        status = case_read_params(c, node, wt_file_set_params(), set, err);
    *spring_constant = stated->spring_constant;
    set->read.spring_constant = spring_constant->value;
    return status;
}

static bool same(double a, double b)
{
    return !(a < b) && !(a > b) && !isnan(a) && !isnan(b);
}

wt_status case_read_files(wt_case *c, const xmlNode *parent, const char *name, case_files *files,
                          wt_error *err)
{
    size_t n = 0;
    for (const xmlNode *node = case_child(parent, name); node != NULL; node = case_next(node, name))
        n++;
    wt_file_set *common = pool_alloc(&c->memory, 1, sizeof *common);
    const char **patterns = pool_alloc(&c->memory, n, sizeof *patterns);
    files->sets = pool_alloc(&c->memory, n, sizeof *files->sets);
    if (common == NULL || patterns == NULL || files->sets == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    *common = (wt_file_set){.folder = c->folder, .read = wt_read_defaults()};
    wt_estimate group_constant = no_files().spring_constant;
    wt_status status = read_attributes(c, parent, common, &group_constant, err);
    files->n = n;
    const xmlNode *node = case_child(parent, name);
    for (size_t i = 0; status == WT_OK && i < n; i++, node = case_next(node, name)) {
        wt_file_set *set = &files->sets[i];
        wt_estimate k = group_constant;
        *set = *common;
        status = read_attributes(c, node, set, &k, err);
        if (status == WT_OK)
            status = case_node_text(c, node, &patterns[i], err);
        set->patterns = &patterns[i];
        set->n_patterns = 1;
        /* one value for the group, or none if its files differ */
        if (i == 0)
            files->spring_constant = k;
        else if (!same(files->spring_constant.value, k.value))
            files->spring_constant.value = (double)NAN;
    }
    return status;
}
