/* weartrack compare: wear track against bulk, or materials. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "cmd/table_output.h"

#include <string.h>

/* A file: its tables, or the error that it has none. */
typedef struct compare_input {
    const char *path;
    wt_result *tables;
    wt_error failure;
    /* for a material: */
    wt_rubber rubber;
    wt_table *shift_factors; /* of isotherms that this call fits */
} compare_input;

/* One call, for comparisons of groups and of materials. */
typedef struct compare_call {
    cmd_session s;
    wt_compare_job groups;
    wt_materials_job materials;
    wt_master_job master;
    wt_file_set set;      /* how isotherms are read */
    compare_input *input; /* [s.n_files] */
} compare_call;

/* ---- materials ------------------------------------------------------------------------------- */

/* True for a foreign text, a spreadsheet, a folder or a pattern. Standard input can be read only
 * once. */
static bool may_be_isotherms(const compare_input *input)
{
    const bool other = input->tables == NULL && input->failure.status != WT_E_MEMORY;
    return strcmp(input->path, "-") != 0 && (other || cmd_tables_contain(input->tables, "sweep"));
}

/* True if the files are materials: at least one is or may be one, and none has indentation tables.
 */
static bool compare_has_materials(const compare_call *call)
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

/* True if one of them has measured isotherms, which this call fits. */
static bool compare_has_isotherms(const compare_call *call)
{
    bool any = false;
    for (size_t i = 0; i < call->s.n_files; i++)
        any = any || is_isotherm_input(&call->input[i]);
    return any;
}

static bool names_sample(const wt_table *shift_factors)
{
    const char *const name = shift_factors != NULL ? wt_table_key(shift_factors, "sample") : NULL;
    return name != NULL && name[0] != '\0';
}

/* Fits the isotherms of one file. A file that has no sweep of the sample of --sample is fitted
 * whole if it names no sample at all: such a file is one material. */
static wt_status fit_isotherms(const wt_master_job *job, wt_file_set *set, wt_job work,
                               wt_master_tables *tables, compare_input *input, wt_error *failure)
{
    wt_log *const log = work.log;
    wt_log *first = wt_log_new(), *second = wt_log_new();
    work.log = first;
    wt_status status = wt_master_compute(job, &work, tables, &input->rubber, failure);
    if (status == WT_E_NOT_FOUND && set->read.sample != NULL) {
        wt_error unused = WT_ERROR_INIT;
        set->read.sample = NULL;
        work.log = second;
        work.provenance = NULL; /* the first reading recorded the file */
        const wt_status whole = wt_master_compute(job, &work, tables, &input->rubber, &unused);
        if (whole == WT_OK && !names_sample(tables->shift_factors)) {
            wt_log_add(second, WT_NOTE, input->path, NULL,
                       "the file names no sample and is one material: --sample is for the others");
            status = WT_OK;
        } else if (whole == WT_OK) {
            wt_master_tables_clear(tables);
            wt_rubber_clear(&input->rubber);
        }
        if (status != WT_OK)
            work.log = first;
    }
    wt_log_append(log, work.log, NULL);
    wt_log_free(first);
    wt_log_free(second);
    return status;
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
    const wt_status status = fit_isotherms(&job, &set, work, &tables, input, &failure);
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

/* Returns the sample of --sample, or NULL for a result of one material without a name. */
static const char *sample_of_input(const compare_call *call, const compare_input *input)
{
    const bool one = wt_result_find(input->tables, "prony") != NULL;
    return one && !names_sample(wt_result_find(input->tables, "shift_factors"))
               ? NULL
               : call->set.read.sample;
}

static wt_status read_compared_material(compare_call *call, compare_input *input, wt_error *err)
{
    if (is_isotherm_input(input))
        return fit_compared_material(call, input, err);
    if (input->tables != NULL)
        return cmd_rubber_from_tables(input->tables, input->path, sample_of_input(call, input),
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

/* Compares the materials and writes the tables. */
static void compare_materials(compare_call *call)
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
            shifts = cmd_sample_table(input->tables, "shift_factors", sample_of_input(call, input));
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

/* ---- groups of curves ------------------------------------------------------------------------ */

typedef struct compare_dma_options {
    const char *master;
} compare_dma_options;

static const wt_param rows[] = {
    {PARAM_TEXT_OF("master", compare_dma_options, master), .value = "FILE", .unset = "",
     .help = "output of weartrack master, to compare with DMA at the frequency of the indentation"},
};
CMD_OPTIONS(compare_dma_params, compare_dma_options, rows)

static const char *const names[2] = {"indentation/bulk", "indentation/track"};

static bool has_table_name(const wt_table *table, const char *name)
{
    return strcmp(wt_table_name(table), name) == 0;
}

/* Finds the table of the group, or else the first indentation table; a table of the track is no
 * bulk. */
static wt_status find_group_table(const compare_call *call, int g, const wt_table **table,
                                  wt_error *err)
{
    const compare_input *input = &call->input[g];
    if (input->tables == NULL) {
        *err = input->failure;
        return err->status;
    }
    const wt_status status =
        cmd_table_find(input->tables, input->path, "indentation/", "indent", table, err);
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < wt_result_n_tables(input->tables); i++)
        if (has_table_name(wt_result_table(input->tables, i), names[g]))
            *table = wt_result_table(input->tables, i);
    const bool same = strcmp(call->input[0].path, call->input[1].path) == 0;
    if (!same && (g > 0 || !has_table_name(*table, names[1])))
        return WT_OK;
    wt_fail(err, WT_E_ARG, same ? "BULK and TRACK are one file" : "the first file is the track");
    wt_error_file(err, input->path);
    if (!same) {
        wt_error_expected(err, "the table of the bulk");
        wt_error_found(err, "'%s'", wt_table_name(*table));
    }
    wt_error_advice(err, "give the bulk first, then the track: compare BULK TRACK");
    return WT_E_ARG;
}

static void run_group_comparison(compare_call *call, const char *master)
{
    cmd_session *s = &call->s;
    wt_compare_job *job = &call->groups;
    wt_result *dma = NULL;
    wt_rubber rubber = {0};
    wt_compare_tables tables = {0};
    wt_status status = find_group_table(call, 0, &job->bulk, &s->err);
    if (status == WT_OK)
        status = find_group_table(call, 1, &job->track, &s->err);
    if (status == WT_OK && s->n_files > 2)
        status =
            wt_fail(&s->err, WT_E_ARG, "BULK and TRACK are two files, %zu are given", s->n_files);
    if (status == WT_OK && has_table_name(job->track, names[0]))
        wt_log_add(s->log, WT_WARNING, s->files[1], NULL,
                   "its curves are called bulk and are treated as those of the track; "
                   "`weartrack indent --group track` names them");
    if (status == WT_OK && master != NULL) {
        status = cmd_rubber_read(master, call->set.read.sample, call->master.poisson_ratio,
                                 &s->work, &dma, &rubber, &s->err);
        job->rubber = &rubber;
    }
    if (status == WT_OK)
        status = wt_compare_groups(job, &s->work, &tables, &s->err);
    wt_table *layer = NULL;
    if (status == WT_OK)
        status = wt_track_layer_compute(job, NULL, &s->work, &layer, &s->err);
    wt_table **const made_tables[] = {&tables.comparison,     &tables.modulus_groups,
                                      &tables.modulus_budget, &tables.modulus_rate,
                                      &tables.dma_comparison, &layer};
    cmd_finish(s, status, made_tables, COUNT_OF(made_tables));
    wt_rubber_clear(&rubber);
    wt_result_free(dma);
}

/* Finds the table of dwell moduli of an input. */
static wt_status find_dwell_table(const compare_input *input, const wt_table **table, wt_error *err)
{
    if (input->tables == NULL) {
        *err = input->failure;
        return err->status;
    }
    return cmd_table_find(input->tables, input->path, "dwell_moduli", "dwell", table, err);
}

static void run_dwell_comparison(compare_call *call, const char *master)
{
    cmd_session *s = &call->s;
    wt_compare_job *job = &call->groups;
    wt_result *dma = NULL;
    wt_rubber rubber = {0};
    wt_table *made_table = NULL;
    wt_status status = find_dwell_table(&call->input[0], &job->bulk, &s->err);
    if (status == WT_OK && s->n_files > 1)
        status = find_dwell_table(&call->input[1], &job->track, &s->err);
    if (status == WT_OK && s->n_files > 2)
        status =
            wt_fail(&s->err, WT_E_ARG, "BULK and TRACK are two files, %zu are given", s->n_files);
    if (status == WT_OK)
        status = cmd_rubber_read(master, NULL, call->master.poisson_ratio, &s->work, &dma, &rubber,
                                 &s->err);
    job->rubber = &rubber;
    if (status == WT_OK)
        status = wt_compare_dwells(job, &s->work, &made_table, &s->err);
    wt_table **const made_tables[] = {&made_table};
    cmd_finish(s, status, made_tables, COUNT_OF(made_tables));
    wt_rubber_clear(&rubber);
    wt_result_free(dma);
}

enum { PART_DMA, PART_GROUPS, PART_MATERIALS, PART_RUBBER, PART_READING, N_PARTS };

/* Rejects options that have no effect on this comparison. */
static bool check_compare_options(compare_call *call, bool materials, bool master)
{
    const cmd_option_group *parts = call->s.parts;
    if (!materials && parts[PART_MATERIALS].given != 0)
        return cmd_usage_error(&call->s, "--at-temperature, --at-frequency and --sample-error are "
                                         "for materials, not for BULK and TRACK");
    if (!materials && !master && parts[PART_RUBBER].given != 0)
        return cmd_usage_error(&call->s, "--poisson-ratio is of materials, or of --master");
    const uint64_t reading = parts[PART_READING].given;
    const bool sample_alone =
        cmd_option_is_set(&parts[PART_READING], "sample") && (reading & (reading - 1)) == 0;
    if (reading != 0 &&
        !((sample_alone && (materials || master)) || (materials && compare_has_isotherms(call))))
        return cmd_usage_error(&call->s,
                               "--temperature, --units, --format, --sheet, --deformation, "
                               "--strain, --sample-by and --conditioning are for measured "
                               "isotherms, --sample for materials and --master; %s",
                               materials ? "all that is given are results" : "there are none");
    return true;
}

static bool fail_two_files(cmd_session *s)
{
    return cmd_usage_error(s,
                           "two files are needed, BULK and TRACK or two materials (with --master "
                           "one output of weartrack dwell will do); %zu given",
                           s->n_files);
}

/* Reads the inputs. The content of a file decides its kind. */
static bool read_compare_inputs(compare_call *call, size_t least)
{
    cmd_session *s = &call->s;
    if (s->n_files < least)
        return fail_two_files(s);
    call->input = wt_alloc(s->n_files, sizeof *call->input);
    if (!cmd_begin(s))
        return false;
    for (size_t i = 0; i < s->n_files; i++) {
        compare_input *input = &call->input[i];
        input->path = s->files[i];
        const wt_tables_role role = {i == 0 ? "bulk" : "track", "material", NULL};
        if (wt_tables_read(input->path, input->path, &s->work, role, &input->tables,
                           &input->failure) != WT_OK)
            input->tables = NULL;
    }
    return true;
}

int cmd_compare(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "compare",
        .arguments =
            "[OPTION]... BULK TRACK | --master FILE DWELLS [DWELLS] | MATERIAL MATERIAL...",
        .description =
            "Compares the moduli of the wear track with those of the bulk: does it differ (yes, no "
            "or inconclusive), the ratio with its 95 % interval, Welch's and the Mann-Whitney "
            "test, "
            "effect size, and the same rate by rate. BULK and TRACK are outputs of weartrack "
            "indent; - is standard input. DWELLS are outputs of weartrack dwell: E' and E'' at "
            "their frequencies over those of the DMA. Or materials: the ratios of "
            "E', E'' and tan delta to "
            "those of the first, with their intervals, over frequency and temperature. MATERIAL is "
            "the output of weartrack master or what was measured (file, folder, pattern).",
        .common = "output formats columns provenance",
        .first = "master indentation-temperature track-temperature cantilevers "
                 "spring-constant-error tip-error at-temperature at-frequency output",
        .master = "temperature temperature-in-name units format sheet deformation strain sample "
                  "sample-by conditioning",
        .n_files = CMD_ONE_OR_MORE};
    compare_dma_options own = {0};
    compare_call call = {.s = cmd_session_defaults(),
                         .groups = wt_compare_job_defaults(),
                         .materials = wt_materials_job_defaults(),
                         .master = wt_master_job_defaults(),
                         .set = {.read = wt_read_defaults()}};
    cmd_option_group parts[N_PARTS] = {
        [PART_DMA] = {compare_dma_params(), &own, NULL, 0},
        [PART_GROUPS] = {wt_compare_job_params(), &call.groups, NULL, 0},
        [PART_MATERIALS] = {wt_materials_job_params(), &call.materials,
                            "at-temperature at-frequency sample-error", 0},
        [PART_RUBBER] = {wt_master_job_params(), &call.master, "poisson-ratio", 0},
        [PART_READING] = {wt_read_params(), &call.set.read,
                          "temperature temperature-in-name units format sheet deformation strain "
                          "sample sample-by conditioning",
                          0}};
    if (cmd_parse(&call.s, &usage, parts, N_PARTS, argc, argv) &&
        read_compare_inputs(&call, own.master != NULL ? 1 : 2)) {
        const bool dwells =
            own.master != NULL && cmd_tables_contain(call.input[0].tables, "dwell_moduli");
        const bool materials = own.master == NULL && compare_has_materials(&call);
        if (call.s.n_files < 2 && call.input[0].tables == NULL) {
            call.s.err = call.input[0].failure; /* the file may be the intended result */
            cmd_end(&call.s, call.s.err.status);
        } else if (call.s.n_files < 2 && !dwells) {
            (void)fail_two_files(&call.s);
        } else if (check_compare_options(&call, materials, own.master != NULL)) {
            if (dwells)
                run_dwell_comparison(&call, own.master);
            else if (materials)
                compare_materials(&call);
            else
                run_group_comparison(&call, own.master);
        }
    }
    for (size_t i = 0; call.input != NULL && i < call.s.n_files; i++) {
        wt_result_free(call.input[i].tables);
        wt_rubber_clear(&call.input[i].rubber);
        wt_table_free(call.input[i].shift_factors);
    }
    free(call.input);
    return cmd_session_free(&call.s);
}
