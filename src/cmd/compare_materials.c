/* weartrack compare of materials: outputs of weartrack master, or measured isotherms.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/compare.h"

#include <string.h>

/* True for a foreign text, a spreadsheet, a folder or a pattern. Standard input can be read only
 * once. */
static bool may_be_isotherms(const compare_input *input)
{
    const bool other = input->tables == NULL && input->failure.status != WT_E_MEMORY;
    return strcmp(input->path, "-") != 0 && (other || cmd_tables_contain(input->tables, "sweep"));
}

bool compare_has_materials(const compare_call *call)
{
    bool any = false;
    for (size_t i = 0; i < call->s.n_files; i++) {
        const compare_input *input = &call->input[i];
        if (cmd_tables_contain(input->tables, "indentation/"))
            return false;
        any = any || cmd_tables_contain(input->tables, "prony") || may_be_isotherms(input);
    }
    return any;
}

static bool is_isotherm_input(const compare_input *input)
{
    return !cmd_tables_contain(input->tables, "prony") && may_be_isotherms(input);
}

bool compare_has_isotherms(const compare_call *call)
{
    bool any = false;
    for (size_t i = 0; i < call->s.n_files; i++)
        any = any || is_isotherm_input(&call->input[i]);
    return any;
}

static wt_status fit_compared_material(compare_call *call, compare_input *input, wt_error *err)
{
    wt_master_tables tables = {0};
    wt_error failure = WT_ERROR_INIT;
    wt_master_job job = call->master;
    wt_file_set set = call->set;
    if (call->s.formats == NULL && !cmd_read_formats(&call->s))
        return WT_E_CANCELLED;
    wt_job work = call->s.work;
    work.formats = call->s.formats;
    work.left_out |= WT_EXTRA_REDUCED_SERIES | WT_EXTRA_SPECTRUM;
    if (input->tables != NULL) /* the file is already in the provenance */
        work.provenance = NULL;
    set.patterns = &input->path;
    set.n_patterns = 1;
    job.sets = &set;
    job.n_sets = 1;
    wt_status status = wt_master_compute(&job, &work, &tables, &input->rubber, &failure);
    input->shift_factors = tables.shift_factors;
    tables.shift_factors = NULL;
    wt_master_tables_clear(&tables);
    if (status == WT_E_AMBIGUOUS || status == WT_E_NOT_FOUND) /* the error is about its samples */
        wt_error_file(&failure, input->path);
    /* for an unknown format show the error of reading it as a result */
    if (status != WT_OK)
        *err = status == WT_E_FORMAT && input->tables == NULL ? input->failure : failure;
    return status;
}

static wt_status read_compared_material(compare_call *call, compare_input *input, wt_error *err)
{
    if (is_isotherm_input(input))
        return fit_compared_material(call, input, err);
    if (input->tables != NULL)
        return cmd_rubber_from_tables(input->tables, input->path, call->set.read.sample,
                                      call->master.poisson_ratio, &input->rubber, err);
    *err = input->failure;
    return err->status;
}

/* Returns the name of the file, with its folders if another file has the same name. */
static const char *material_name(const compare_call *call, size_t i)
{
    const char *slash = strrchr(call->s.files[i], '/');
    const char *name = slash != NULL && slash[1] != '\0' ? slash + 1 : call->s.files[i];
    for (size_t k = 0; k < call->s.n_files; k++) {
        const char *other = strrchr(call->s.files[k], '/');
        if (k != i && strcmp(other != NULL ? other + 1 : call->s.files[k], name) == 0)
            return call->s.files[i];
    }
    return name;
}

static wt_status check_distinct_materials(const compare_call *call, wt_error *err)
{
    for (size_t i = 1; i < call->s.n_files; i++)
        for (size_t k = 0; k < i; k++)
            if (strcmp(call->s.files[i], call->s.files[k]) == 0) {
                wt_fail(err, WT_E_ARG, "a material is given twice");
                wt_error_file(err, call->s.files[i]);
                return WT_E_ARG;
            }
    return WT_OK;
}

void compare_materials(compare_call *call)
{
    cmd_session *s = &call->s;
    wt_materials_tables tables = {0};
    wt_compared_material *compared = wt_alloc(s->n_files, sizeof *compared);
    wt_status status = check_distinct_materials(call, &s->err);
    /* the comparison needs every material */
    wt_table_free(s->work.failures);
    s->work.failures = NULL;
    for (size_t i = 0; status == WT_OK && i < s->n_files; i++) {
        compare_input *input = &call->input[i];
        status = read_compared_material(call, input, &s->err);
        const wt_table *shifts = input->shift_factors;
        if (status == WT_OK && input->tables != NULL && shifts == NULL)
            shifts = cmd_sample_table(input->tables, "shift_factors", call->set.read.sample);
        if (status == WT_E_EMPTY && input->tables == NULL)
            wt_error_advice(&s->err,
                            "force curves go to `weartrack indent` first, bulk and track each: "
                            "compare takes what it writes");
        compared[i] = (wt_compared_material){
            .name = material_name(call, i), .rubber = &input->rubber, .shift_factors = shifts};
    }
    call->materials.materials = compared;
    call->materials.n_materials = s->n_files;
    call->materials.margin = call->groups.margin;
    if (status == WT_OK)
        status = wt_compare_materials(&call->materials, &s->work, &tables, &s->err);
    wt_table **const made_tables[] = {&tables.material_ratio, &tables.materials};
    cmd_finish(s, status, made_tables, COUNT_OF(made_tables));
    free(compared);
}
