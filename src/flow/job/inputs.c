/* The files of a job: listing, opening with provenance, recording what failed.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/inputs.h"
#include "flow/job/tables.h"

#include <stdlib.h>
#include <string.h>

wt_job wt_job_defaults(void)
{
    return (wt_job){.tolerance = wt_friction_defaults().tolerance, .seed = 1, .replicates = 64};
}

static const wt_param job_rows[] = {JOB_ROWS(wt_job)};
PARAM_TABLE(wt_job_params, wt_job, job_rows, wt_job_defaults, NO_PARTS)

static wt_file_set no_files(void)
{
    return (wt_file_set){.read = wt_read_defaults()};
}

static const wt_param set_rows[] = {
    {PARAM_TEXT_OF("spot", wt_file_set, spot), .value = "NAME", .unset = "each file is a spot",
     .help = "place on the sample that all these curves come from"},
};
PARAM_TABLE(wt_file_set_params, wt_file_set, set_rows, no_files,
            PARAM_PART(wt_read_params, wt_file_set, read))

wt_table *wt_failures_new(void)
{
    static const flow_column columns[] = {
        {"file", NULL, "file or stage that failed"},
        {"message", NULL, "what went wrong, where, and what to do"},
    };
    wt_table *table = NULL;
    return flow_table_new("failures", "What could not be used", columns, FLOW_COUNT(columns),
                          &table, NULL) == WT_OK
               ? table
               : NULL;
}

/* `path` without `folder` in front of it. */
static const char *below(const char *folder, const char *path)
{
    size_t length = folder == NULL ? 0 : strlen(folder);
    if (length == 0 || strncmp(path, folder, length) != 0 || path[length] != '/')
        return path;
    return path + length + strspn(path + length, "/");
}

wt_status flow_notes_table(const wt_parselog *log, const char *folder, wt_table **result,
                           wt_error *err)
{
    enum { SEVERITY, FILE_NAME, PLACE, TEXT, COUNT };
    static const flow_column columns[] = {
        {"severity", NULL, "note or warning"},
        {"file", NULL, "file it is about"},
        {"place", NULL, "first place in the file"},
        {"text", NULL, "what was noticed"},
        {"count", "1", "how often"},
    };
    wt_table *table = NULL;
    wt_status status =
        flow_table_new("notes", "Notes and warnings", columns, FLOW_COUNT(columns), &table, err);
    for (size_t i = 0; status == WT_OK && i < wt_parselog_count(log); i++) {
        wt_log_entry entry = wt_parselog_get(log, i);
        status = wt_table_add_row(table, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, SEVERITY,
                                       entry.severity == WT_WARNING ? "warning" : "note", err);
        if (status == WT_OK)
            status = wt_table_put_text(table, FILE_NAME, below(folder, entry.file), err);
        if (status == WT_OK)
            status = wt_table_put_text(table, PLACE, entry.place, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, TEXT, entry.text, err);
        if (status == WT_OK)
            wt_table_put(table, COUNT, (double)entry.count);
    }
    if (status != WT_OK) {
        wt_table_free(table);
        return status;
    }
    *result = table;
    return WT_OK;
}

bool flow_goes_on(const wt_job *common, wt_status status)
{
    return common->failures != NULL && status != WT_E_MEMORY && status != WT_E_CANCELLED &&
           status != WT_E_INTERNAL;
}

wt_status flow_failed(const wt_job *common, const char *file, const wt_error *failure,
                      wt_error *err)
{
    enum { FILE_NAME, MESSAGE };
    wt_error shown = *failure;
    shown.file[0] = '\0'; /* it has its own column */
    char message[2048];
    wt_error_format(&shown, message, sizeof message);
    wt_status status = wt_table_add_row(common->failures, err);
    if (status == WT_OK)
        status = wt_table_put_text(common->failures, FILE_NAME, file, err);
    if (status == WT_OK)
        status = wt_table_put_text(common->failures, MESSAGE, message, err);
    return status;
}

/* ---- listing ----------------------------------------------------------------------------------
 */

static wt_status files_add(flow_files *files, size_t *capacity, char *path, const wt_file_set *set,
                           wt_error *err)
{
    if (files->n == *capacity) {
        size_t grown = *capacity == 0 ? 16 : *capacity * 2;
        flow_file *array = realloc(files->file, grown * sizeof *array);
        if (array == NULL) {
            free(path);
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        }
        files->file = array;
        *capacity = grown;
    }
    files->file[files->n++] =
        (flow_file){.path = path, .name = below(set->folder, path), .set = set};
    return WT_OK;
}

static bool is_listed(const flow_files *files, const char *path)
{
    for (size_t i = 0; i < files->n; i++)
        if (strcmp(files->file[i].path, path) == 0)
            return true;
    return false;
}

static wt_status list_pattern(const wt_file_set *set, const char *pattern, const wt_job *common,
                              flow_files *files, size_t *capacity, wt_error *err)
{
    char **paths = NULL;
    size_t n = 0;
    wt_status status = WT_OK;
    wt_error failure = WT_ERROR_INIT;
    if (strcmp(pattern, "-") == 0) {
        char *path = strdup("-");
        return path == NULL ? wt_fail(err, WT_E_MEMORY, "out of memory")
                            : files_add(files, capacity, path, set, err);
    }
    status = wt_glob(set->folder, pattern, &paths, &n, &failure);
    if (status != WT_OK) {
        if (err != NULL && !flow_goes_on(common, status))
            *err = failure;
        return flow_goes_on(common, status) ? flow_failed(common, pattern, &failure, err) : status;
    }
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        if (is_listed(files, paths[i])) {
            wt_parselog_add(common->log, WT_WARNING, paths[i], NULL,
                            "named more than once; its curves are taken once");
            continue;
        }
        status = files_add(files, capacity, paths[i], set, err);
        paths[i] = NULL;
    }
    wt_strings_free(paths, n);
    return status;
}

wt_status flow_files_list(const wt_file_set *sets, size_t n_sets, const wt_job *common,
                          flow_files *files, wt_error *err)
{
    wt_status status = WT_OK;
    size_t capacity = 0;
    *files = (flow_files){NULL, 0};
    for (size_t i = 0; status == WT_OK && i < n_sets; i++)
        for (size_t j = 0; status == WT_OK && j < sets[i].n_patterns; j++)
            status = list_pattern(&sets[i], sets[i].patterns[j], common, files, &capacity, err);
    if (status != WT_OK)
        flow_files_clear(files);
    return status;
}

void flow_files_clear(flow_files *files)
{
    for (size_t i = 0; i < files->n; i++)
        free((void *)files->file[i].path);
    free(files->file);
    *files = (flow_files){NULL, 0};
}

/* ---- opening ----------------------------------------------------------------------------------
 */

static wt_status add_provenance(const wt_job *common, wt_input *input, const flow_file *file,
                                const char *role, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    const wt_format_info *info = file->format;
    char format[128];
    snprintf(format, sizeof format, "%s %s", info->id, info->version != NULL ? info->version : "");
    wt_provenance_input record = {
        .path = file->name, .role = role, .format = format, .bytes = length};
    wt_digest(bytes, length, record.sha256);
    status = wt_provenance_add_input(common->provenance, &record);
    return status == WT_OK ? WT_OK : wt_fail(err, status, "cannot keep the list of inputs");
}

wt_status flow_open(const wt_job *common, flow_file *file, const char *role, unsigned kinds,
                    wt_input **result, wt_error *err)
{
    if (common->formats == NULL)
        return wt_fail(err, WT_E_ARG, "no formats given to a job that reads files");
    wt_input *input = NULL;
    wt_status status = wt_input_open(file->path, &input, err);
    file->read = file->set->read;
    if (status == WT_OK && file->read.format != NULL) {
        file->format = wt_formats_find(common->formats, file->read.format);
        if (file->format == NULL) {
            status = wt_fail(err, WT_E_NOT_FOUND, "no format is called \"%s\"", file->read.format);
            wt_error_advice(err, "`weartrack formats list` shows the formats");
        }
    } else if (status == WT_OK) {
        status = wt_detect(common->formats, input, kinds, &file->format, err);
    }
    if (status == WT_OK && common->provenance != NULL)
        status = add_provenance(common, input, file, role, err);
    if (status != WT_OK) {
        wt_error_file(err, file->name);
        wt_input_close(input);
        return status;
    }
    file->read.format = file->format->id;
    *result = input;
    return WT_OK;
}
