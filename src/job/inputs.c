/* Input files of a job. The functions list and open them, and record failures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/inputs.h"
#include "job/cost.h"
#include "job/file_copies.h"

#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/shared_params.h"
#include "core/system/temporary.h"
#include "core/table/table_rows.h"

#include <search.h>
#include <stdlib.h>
#include <string.h>

wt_job wt_job_defaults(void)
{
    /* The same number as the draws of a master curve. The relative uncertainty of their standard
     * deviation is 5 %, which is better than most stated errors. */
    enum { DRAWS = 200 };
    return (wt_job){.tolerance = DEFAULT_TOLERANCE, .seed = 1, .replicates = DRAWS};
}

static const wt_param job_rows[] = {JOB_ROWS(wt_job)};
PARAM_TABLE(wt_job_params, wt_job, job_rows, wt_job_defaults, NO_PARTS)

static wt_file_set file_set_defaults(void)
{
    return (wt_file_set){.read = wt_read_defaults()};
}

static const wt_param set_rows[] = {
    {PARAM_TEXT_OF("spot", wt_file_set, spot), .value = "NAME", .unset = "each file is a spot",
     .help = "place on the sample that all these curves come from"},
};
PARAM_TABLE(wt_file_set_params, wt_file_set, set_rows, file_set_defaults,
            PARAM_PART(wt_read_params, wt_file_set, read))

wt_table *wt_failures_new(void)
{
    wt_table *table = NULL;
    table_writer t = table_begin(&failures_schema, NULL);
    return table_end(&t, &table) == WT_OK ? table : NULL;
}

/* Returns `path` without the prefix `folder`. */
static const char *relative_path(const char *folder, const char *path)
{
    size_t length = folder == NULL ? 0 : strlen(folder);
    if (length == 0 || strncmp(path, folder, length) != 0 || path[length] != '/')
        return path;
    return path + length + strspn(path + length, "/");
}

TABLE_ROW(notes, NOTES, const char *severity, *file; wt_log_entry entry;)

wt_status wt_notes_table(const wt_log *log, const char *folder, wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&notes_schema, err);
    for (size_t i = 0; i < wt_log_count(log); i++) {
        wt_log_entry entry = wt_log_get(log, i);
        TABLE_ADD(notes, &t, wt_severity_name(entry.severity), relative_path(folder, entry.file),
                  entry);
    }
    return table_end(&t, table);
}

TABLE_ROW(data_quality, DATA_QUALITY, const char *file, *action; double n_values;
          wt_log_entry entry;)

wt_status wt_data_quality_table(const wt_log *log, const char *folder, wt_table **table,
                                wt_error *err)
{
    *table = NULL;
    table_writer t = table_begin(&data_quality_schema, err);
    size_t n = 0;
    for (size_t i = 0; i < wt_log_count(log); i++) {
        const wt_log_entry entry = wt_log_get(log, i);
        if (entry.action == WT_ACTION_NONE)
            continue;
        n++;
        TABLE_ADD(data_quality, &t, relative_path(folder, entry.file), action_text(entry.action),
                  entry.n_values > 0 ? (double)entry.n_values : (double)NAN, entry);
    }
    const wt_status status = table_end(&t, table);
    if (n == 0) {
        wt_table_free(*table);
        *table = NULL;
    }
    return status;
}

bool flow_may_continue(const wt_job *work, wt_status status)
{
    return work->failures != NULL && status != WT_E_MEMORY && status != WT_E_CANCELLED &&
           status != WT_E_INTERNAL;
}

TABLE_ROW(failures, FAILURES, const char *file, *message;)

wt_status flow_add_failure(const wt_job *work, const char *what, const wt_error *failure,
                           wt_error *err)
{
    char message[2048];
    wt_error message_parts = *failure;
    if (work->case_advice != NULL)
        work->case_advice(&message_parts);
    wt_error_format(&message_parts, message, sizeof message);
    table_writer t = table_continue(work->failures, &failures_schema, "", err);
    TABLE_ADD(failures, &t, what, message);
    return table_end(&t, NULL);
}

wt_status wt_failures_set_status(wt_table *failures, wt_result_status answered, wt_error *err)
{
    table_writer t = table_continue(failures, &failures_schema, "", err);
    failures_set_print(&t, FAILURES_KEY_STATUS, "%d", (int)answered);
    return table_end(&t, NULL);
}

wt_status wt_job_add_failure(const wt_job *work, const char *file, wt_status status,
                             wt_error *failure, wt_error *err)
{
    if (flow_may_continue(work, status)) {
        failure->file[0] = '\0'; /* the table of failures has a column for it */
        return flow_add_failure(work, file, failure, err);
    }
    wt_error_file(failure, file);
    if (err != NULL)
        *err = *failure;
    return status;
}

/* ---- lists of files -------------------------------------------------------------------------- */

/* Returns the number of components of a path. */
static size_t path_depth(const char *path)
{
    size_t n = 0;
    for (path += strspn(path, "/"); *path != '\0'; n++) {
        path += strcspn(path, "/");
        path += strspn(path, "/");
    }
    return n;
}

/* Takes ownership of `path`. */
static void files_add(flow_files *files, char *path, const char *pattern, const wt_file_set *set)
{
    files->file = array_grow(files->file, files->n, sizeof *files->file);
    const char *name = relative_path(set->folder, path);
    files->file[files->n++] = (flow_file){.path = path,
                                          .name = name,
                                          .set = set,
                                          .from_folder = path_depth(name) > path_depth(pattern)};
}

static int compare_path_texts(const void *a, const void *b)
{
    return strcmp(a, b);
}

static void free_no_path(void *path)
{
    (void)path; /* the list owns the paths */
}

static wt_status list_pattern(const wt_file_set *set, const char *pattern, const wt_job *work,
                              flow_files *files, wt_error *err)
{
    char **paths = NULL;
    size_t n = 0;
    wt_status status = WT_OK;
    wt_error failure = WT_ERROR_INIT;
    if (strcmp(pattern, "-") == 0) {
        files_add(files, wt_strdup("-"), pattern, set);
        return WT_OK;
    }
    status = wt_glob(set->folder, pattern, &paths, &n, &failure);
    if (status != WT_OK)
        return wt_job_add_failure(work, pattern, status, &failure, err);
    for (size_t i = 0; i < n; i++) {
        char *const *const found = tsearch(paths[i], &files->paths, compare_path_texts);
        if (found == NULL)
            out_of_memory(sizeof *found);
        if (*found != paths[i]) {
            wt_log_action(work->log, WT_WARNING, WT_COPIED, 1, NULL, paths[i], NULL,
                          "named more than once; it is taken once");
            continue;
        }
        files_add(files, paths[i], pattern, set);
        paths[i] = NULL;
    }
    wt_strings_free(paths, n);
    return WT_OK;
}

static int compare_file_paths(const void *a, const void *b)
{
    const flow_file *const p = a, *const q = b;
    return strcmp(p->path, q->path);
}

wt_status flow_files_list(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                          flow_files *files, wt_error *err)
{
    wt_status status = WT_OK;
    *files = (flow_files){NULL, 0, NULL};
    for (size_t i = 0; status == WT_OK && i < n_sets; i++)
        for (size_t j = 0; status == WT_OK && j < sets[i].n_patterns; j++)
            status = list_pattern(&sets[i], sets[i].patterns[j], work, files, err);
    if (files->n > 1)
        qsort(files->file, files->n, sizeof *files->file, compare_file_paths);
    if (status == WT_OK && files->n > 1)
        file_copies_remove(files, work);
    else if (status != WT_OK)
        flow_files_clear(files);
    return status;
}

void flow_files_clear(flow_files *files)
{
    for (size_t i = 0; i < files->n; i++)
        free((void *)files->file[i].path);
    free(files->file);
    tdestroy(files->paths, free_no_path);
    *files = (flow_files){NULL, 0, NULL};
}

static bool is_path_suffix(const char *end, size_t n_end, const char *path, size_t n)
{
    return n_end > 0 && n > n_end && path[n - n_end - 1] == '/' &&
           memcmp(path + n - n_end, end, n_end) == 0;
}

flow_name_match flow_file_match(const flow_file *file, const char *named, size_t length)
{
    const size_t n = strlen(file->path);
    if ((strlen(file->name) == length && memcmp(file->name, named, length) == 0) ||
        (n == length && memcmp(file->path, named, length) == 0))
        return FLOW_NAME_EQUAL;
    const bool same_end = is_path_suffix(named, length, file->path, n) ||
                          is_path_suffix(file->path, n, named, length);
    return same_end ? FLOW_NAME_SAME_SUFFIX : FLOW_NAME_DIFFERENT;
}

/* ---- opening files --------------------------------------------------------------------------- */

static wt_status read_input_bytes(void *user, size_t from, void *to, size_t n, wt_error *err)
{
    return wt_input_copy(user, from, to, n, err);
}

wt_status wt_job_add_input(const wt_job *work, wt_provenance_input input, wt_input *file,
                           wt_error *err)
{
    size_t length = 0;
    wt_status status = wt_input_size(file, &length, err);
    if (status == WT_OK)
        cost_add_file(work->cost, length);
    if (status != WT_OK || work->provenance == NULL)
        return status;
    input.bytes = length;
    status = digest_stream(read_input_bytes, file, length,
                           (work->left_out & WT_EXTRA_DIGESTS) == 0 ? input.sha256 : NULL,
                           &input.fingerprint, err);
    if (status != WT_OK)
        return status;
    wt_provenance_add_input(work->provenance, &input);
    return WT_OK;
}

wt_status flow_record_input(const wt_job *work, wt_input *input, const flow_file *file,
                            const char *role, wt_error *err)
{
    const wt_format_info *info = file->format;
    char format[128];
    snprintf(format, sizeof format, "%s %s", info->id, info->version != NULL ? info->version : "");
    const wt_status status = wt_job_add_input(
        work, (wt_provenance_input){.path = file->name, .role = role, .format = format}, input,
        err);
    if (status != WT_OK)
        wt_error_file(err, file->name);
    return status;
}

wt_status flow_open(const wt_job *work, flow_file *file, const char *role, unsigned kinds,
                    wt_input **result, wt_error *err)
{
    return flow_open_paired(work, file, role, kinds, result, NULL, err);
}

wt_status flow_open_paired(const wt_job *work, flow_file *file, const char *role, unsigned kinds,
                           wt_input **result, wt_input **paired, wt_error *err)
{
    if (work->formats == NULL)
        return wt_fail(err, WT_E_ARG, "no formats given to a job that reads files");
    wt_input *input = NULL;
    wt_status status = wt_input_open(file->path, &input, err);
    const wt_read_options *const read = &file->set->read;
    if (status == WT_OK && read->format != NULL) {
        file->format = wt_formats_find(work->formats, read->format);
        if (file->format == NULL) {
            status = wt_fail(err, WT_E_NOT_FOUND, "no format is called \"%s\"", read->format);
            wt_error_advice(err, "`weartrack formats list` shows the formats");
        }
    } else if (status == WT_OK) {
        status = wt_format_detect(work->formats, input, read, kinds, &file->format, err);
    }
    if (paired != NULL)
        *paired = NULL;
    if (status == WT_OK && work->provenance != NULL && paired != NULL)
        status = wt_input_sibling(input, paired, err);
    if (status == WT_OK && (work->provenance != NULL || work->cost != NULL) &&
        (paired == NULL || *paired == NULL))
        status = flow_record_input(work, input, file, role, err);
    if (status != WT_OK) {
        wt_error_file(err, file->name);
        wt_input_close(input);
        return status;
    }
    *result = input;
    return WT_OK;
}

wt_read_options flow_read_options(const flow_file *file)
{
    wt_read_options options = file->set->read;
    if (file->format != NULL)
        options.format = file->format->id;
    return options;
}

bool flow_skip_file(const wt_job *work, const flow_file *file, const wt_error *failure)
{
    const bool unknown = failure->status == WT_E_FORMAT && file->format == NULL;
    if (!file->from_folder || !(unknown || failure->status == WT_E_EMPTY))
        return false;
    wt_log_action(work->log, WT_WARNING, WT_LEFT_OUT, 1, NULL, file->name, NULL,
                  "left out of its folder: %s%s%s", failure->message,
                  failure->found[0] != '\0' ? "; found " : "", failure->found);
    return true;
}

wt_status flow_files_process(const flow_files *files, const wt_job *work, flow_process *process,
                             void *user, size_t *n_failed, wt_error *err)
{
    wt_status status = WT_OK;
    *n_failed = 0;
    for (size_t i = 0; status == WT_OK && i < files->n; i++) {
        wt_error failure = WT_ERROR_INIT;
        status = process(user, &files->file[i], i, &failure);
        if (status == WT_OK || flow_skip_file(work, &files->file[i], &failure)) {
            status = WT_OK;
            continue;
        }
        ++*n_failed;
        status = wt_job_add_failure(work, files->file[i].name, status, &failure, err);
    }
    return status;
}

void flow_error_add_files(const flow_files *files, size_t n_failed, wt_error *err)
{
    bool from_folder = false;
    for (size_t i = 0; i < files->n; i++)
        from_folder = from_folder || files->file[i].from_folder;
    if (n_failed > 0)
        wt_error_found(err, "files: %zu, failed: %zu", files->n, n_failed);
    else
        wt_error_found(err, "files: %zu", files->n);
    wt_error_advice(err, "`weartrack info FILE` shows what a file holds%s",
                    from_folder ? "; 'FOLDER/*' takes the files of the folders in a folder" : "");
}
