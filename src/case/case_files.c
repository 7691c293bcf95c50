/* Reads the file sets of a case and their options. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/case_sections.h"

#include "indentation/indent.h"
#include "read/read_params.h"

#include <math.h>

static case_files case_files_defaults(void)
{
    return (case_files){.spring_constant = {(double)NAN, 0, 0, "N/m"},
                        .sensitivity = {(double)NAN, 0, 0, "m/V"}};
}

static const wt_param rows[] = {SPRING_CONSTANT(case_files, PARAM_NO_OPTION, indent_error_check),
                                SENSITIVITY(case_files, PARAM_NO_OPTION, indent_error_check)};
PARAM_TABLE(case_group_params, case_files, rows, case_files_defaults, NO_PARTS)

/* The attributes of a node override the values that `set` and `lever` have already. */
static wt_status read_attributes(wt_case *c, const xmlNode *node, wt_file_set *set,
                                 case_files *lever, wt_error *err)
{
    case_files *stated = arena_alloc(&c->memory, 1, sizeof *stated);
    *stated = *lever;
    wt_status status = case_read_params(c, node, case_group_params(), stated, err);
    if (status == WT_OK)
        status = case_read_params(c, node, wt_file_set_params(), set, err);
    *lever = *stated;
    set->read.spring_constant = lever->spring_constant.value;
    set->read.sensitivity = lever->sensitivity.value;
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
        case_files lever = group;
        *set = *common;
        status = read_attributes(c, node, set, &lever, err);
        patterns[i] = case_node_text(c, node);
        set->patterns = &patterns[i];
        set->n_patterns = 1;
        merge_file_estimate(&files->spring_constant, &files->lever_error, lever.spring_constant,
                            i == 0);
        merge_file_estimate(&files->sensitivity, &files->sensitivity_error, lever.sensitivity,
                            i == 0);
    }
    return status;
}
