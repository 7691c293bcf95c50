/* Input files of a job. The functions list and open them, and record failures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/inputs.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/math/special.h"
#include "core/system/temporary.h"
#include "core/table/table_rows.h"
#include "job/cost.h"
#include "weartrack/read.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- copies ---------------------------------------------------------------------------------- */

enum { BLOCK = 4096 }; /* one page of most file systems: the least that is read from a disk */

typedef struct file_identity {
    size_t index;  /* in the list */
    uint64_t size; /* 0 for a file that is not compared */
    uint64_t ends; /* hash of the first and the last block; only where sizes agree */
} file_identity;

static uint64_t size_of_file(const char *path)
{
    struct stat about;
    return strcmp(path, "-") != 0 && stat(path, &about) == 0 && S_ISREG(about.st_mode) &&
                   about.st_size > 0
               ? (uint64_t)about.st_size
               : 0;
}

/* Reads up to BLOCK bytes at `from`. 0 if they cannot be read. */
static size_t read_block(int descriptor, uint64_t from, unsigned char *block)
{
    const ssize_t n = pread(descriptor, block, BLOCK, (off_t)from);
    return n > 0 ? (size_t)n : 0;
}

static uint64_t hash_ends(const char *path, uint64_t size)
{
    unsigned char block[BLOCK];
    uint64_t hash = splitmix64(size);
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return hash;
    for (int end = 0; end < 2; end++) {
        const size_t n = read_block(descriptor, end == 0 || size < BLOCK ? 0 : size - BLOCK, block);
        for (size_t i = 0; i < n; i++)
            hash = splitmix64(hash ^ block[i]);
    }
    (void)close(descriptor);
    return hash;
}

static bool bytes_are_equal(const char *path, const char *other, uint64_t size)
{
    unsigned char block[2][BLOCK];
    const int descriptor[2] = {open(path, O_RDONLY | O_CLOEXEC), open(other, O_RDONLY | O_CLOEXEC)};
    bool equal = descriptor[0] >= 0 && descriptor[1] >= 0;
    for (uint64_t from = 0; equal && from < size; from += BLOCK) {
        const size_t n = read_block(descriptor[0], from, block[0]);
        equal = n > 0 && n == read_block(descriptor[1], from, block[1]) &&
                memcmp(block[0], block[1], n) == 0;
    }
    for (int i = 0; i < 2; i++)
        if (descriptor[i] >= 0)
            (void)close(descriptor[i]);
    return equal;
}

static int compare_numbers(uint64_t a, uint64_t b)
{
    return a < b ? -1 : a > b;
}

static int compare_identities(const void *a, const void *b)
{
    const file_identity *const p = a, *const q = b;
    const int by_size = compare_numbers(p->size, q->size);
    const int by_ends = compare_numbers(p->ends, q->ends);
    return by_size != 0 ? by_size : by_ends != 0 ? by_ends : compare_numbers(p->index, q->index);
}

/* Marks in `copy_of` the files i of the run that have the bytes of an earlier one of the run. */
static void mark_copies(const flow_files *files, const file_identity *run, size_t n,
                        size_t *copy_of)
{
    for (size_t i = 1; i < n; i++) {
        const flow_file *const file = &files->file[run[i].index];
        for (size_t j = 0; j < i; j++) {
            const size_t earlier = run[j].index;
            if (copy_of[earlier] == earlier &&
                bytes_are_equal(files->file[earlier].path, file->path, run[i].size)) {
                copy_of[run[i].index] = earlier;
                break;
            }
        }
    }
}

/* Returns the end of the run of equal sizes, or of equal sizes and ends. */
static size_t run_end(const file_identity *file, size_t from, size_t n, bool ends)
{
    size_t to = from + 1;
    while (to < n && file[to].size == file[from].size &&
           (!ends || file[to].ends == file[from].ends))
        to++;
    return to;
}

static void remove_marked(flow_files *files, const size_t *copy_of, const wt_job *work)
{
    size_t n = 0;
    for (size_t i = 0; i < files->n; i++)
        if (copy_of[i] != i)
            wt_log_action(work->log, WT_WARNING, WT_COPIED, 1, WT_KEEP_OPTION, files->file[i].name,
                          NULL,
                          "the same bytes as %s: a copy, left out; both count as one measurement",
                          files->file[copy_of[i]].name);
    for (size_t i = 0; i < files->n; i++) {
        if (copy_of[i] == i)
            files->file[n++] = files->file[i];
        else
            free((void *)files->file[i].path);
    }
    files->n = n;
}

/* Removes each file with the same bytes as an earlier one of the list, with a warning that names
 * both. A copy is no second measurement. A file that cannot be read stays; opening it reports the
 * error. Only files of equal size are read, and of these the whole only if their ends agree. */
static void file_copies_remove(flow_files *files, const wt_job *work)
{
    const size_t n = files->n;
    file_identity *const file = wt_alloc(n, sizeof *file);
    size_t *const copy_of = wt_alloc(n, sizeof *copy_of);
    for (size_t i = 0; i < n; i++) { /* files of size 0 are not compared */
        copy_of[i] = i;
        const bool kept = files->file[i].set->read.conditioning == WT_CONDITIONING_KEEP;
        file[i] = (file_identity){i, kept ? 0 : size_of_file(files->file[i].path), 0};
    }
    qsort(file, n, sizeof *file, compare_identities);
    for (size_t i = 0, to; i < n; i = to) {
        to = run_end(file, i, n, false);
        for (size_t k = i; to > i + 1 && file[i].size > 0 && k < to; k++)
            file[k].ends = hash_ends(files->file[file[k].index].path, file[k].size);
    }
    qsort(file, n, sizeof *file, compare_identities);
    for (size_t i = 0, to; i < n; i = to) {
        to = run_end(file, i, n, true);
        if (file[i].size > 0)
            mark_copies(files, file + i, to - i, copy_of);
    }
    remove_marked(files, copy_of, work);
    free(file);
    free(copy_of);
}

/* ---- jobs ------------------------------------------------------------------------------------ */

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

/* Returns the instrument that an opened file states and the title of its format; NULL for a job
 * without provenance. The caller frees the text. */
static char *flow_instrument(const wt_job *work, wt_input *input, const wt_format_info *format,
                             const wt_read_options *read)
{
    wt_read_options options = *read;
    options.format = format->id;
    if (work->provenance == NULL)
        return NULL;
    const char *const title = format->title;
    const char *instrument = "";
    wt_table *metadata = NULL;
    table_view t = {0};
    /* A description of heights decodes all of them, and such files state no instrument. */
    const bool may_state = (format->kinds & ~(WT_KIND_IMAGE | WT_KIND_SPECTRUM)) != 0;
    if (may_state &&
        wt_input_describe(work->formats, input, &options, NULL, &metadata, NULL) == WT_OK &&
        table_bind(metadata, &facts_schema, "", &t, NULL) == WT_OK)
        for (size_t i = 0; i < t.n_rows && instrument[0] == '\0'; i++)
            if (facts_get(&t, i, FACTS_KIND) == FACT_INSTRUMENT)
                instrument = facts_text(&t, i, FACTS_VALUE);
    char *text = NULL;
    size_t length = 0;
    FILE *const out = text_stream_open(&text, &length);
    if (instrument[0] != '\0')
        (void)fprintf(out, "%s, file format \"%s\"", instrument, title);
    else
        (void)fprintf(out, "a file of the format \"%s\"", title);
    text_stream_close(out);
    wt_table_free(metadata);
    return text;
}

const char *flow_relative_path(const char *folder, const char *path)
{
    size_t length = folder == NULL ? 0 : strlen(folder);
    if (length == 0 || strncmp(path, folder, length) != 0 || path[length] != '/')
        return path;
    return path + length + strspn(path + length, "/");
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
    const char *name = flow_relative_path(set->folder, path);
    files->file[files->n] = (flow_file){.path = path,
                                        .number = files->n,
                                        .name = name,
                                        .set = set,
                                        .seen = files->seen,
                                        .from_folder = path_depth(name) > path_depth(pattern)};
    files->n++;
}

static wt_status list_pattern(const wt_file_set *set, const char *pattern, const wt_job *work,
                              flow_files *files, wt_error *err)
{
    char **paths = NULL;
    size_t n = 0;
    wt_error failure = WT_ERROR_INIT;
    if (strcmp(pattern, "-") == 0) {
        files_add(files, wt_strdup("-"), pattern, set);
        return WT_OK;
    }
    const wt_status status = wt_glob(set->folder, pattern, &paths, &n, &failure);
    if (status != WT_OK)
        return wt_job_add_failure(work, pattern, status, &failure, err);
    for (size_t i = 0; i < n; i++) {
        files_add(files, paths[i], pattern, set);
        paths[i] = NULL;
    }
    wt_strings_free(paths, n);
    return WT_OK;
}

static int compare_file_paths(const void *a, const void *b)
{
    const flow_file *const p = a, *const q = b;
    const int order = strcmp(p->path, q->path);
    return order != 0 ? order : (p->number > q->number) - (p->number < q->number);
}

/* Of a path that several patterns name, the first entry stays. */
static void repeated_paths_remove(flow_files *files, const wt_job *work)
{
    size_t n = 0;
    for (size_t i = 0; i < files->n; i++) {
        flow_file *const file = &files->file[i];
        if (n == 0 || strcmp(files->file[n - 1].path, file->path) != 0 ||
            file->set->read.conditioning == WT_CONDITIONING_KEEP) {
            files->file[n++] = *file;
            continue;
        }
        wt_log_action(work->log, WT_WARNING, WT_COPIED, 1, WT_KEEP_OPTION, file->path, NULL,
                      "named more than once; it is taken once");
        free((void *)file->path);
    }
    files->n = n;
}

/* One action for the sets, so that a result of data that were not looked at says so. */
static void note_kept(const flow_files *files, const wt_job *work)
{
    size_t n = 0, last = 0;
    for (size_t i = 0; i < files->n; i++)
        if (files->file[i].set->read.conditioning == WT_CONDITIONING_KEEP) {
            last = i;
            n++;
        }
    if (n > 0)
        wt_log_action(work->log, WT_NOTE, WT_KEPT, n, "--conditioning mend",
                      n == 1 ? files->file[last].name : NULL, NULL,
                      "conditioning keep: all data count as they stand in the file%s",
                      n == 1 ? "" : "s");
}

wt_status flow_files_list(const wt_file_set *sets, size_t n_sets, const wt_job *work,
                          flow_files *files, wt_error *err)
{
    wt_status status = WT_OK;
    *files = (flow_files){.seen = wt_alloc(1, sizeof(sample_set))};
    for (size_t i = 0; status == WT_OK && i < n_sets; i++)
        for (size_t j = 0; status == WT_OK && j < sets[i].n_patterns; j++)
            status = list_pattern(&sets[i], sets[i].patterns[j], work, files, err);
    if (files->n > 1)
        qsort(files->file, files->n, sizeof *files->file, compare_file_paths);
    repeated_paths_remove(files, work);
    if (files->n == 1)
        files->file[0].seen = NULL;
    else if (status == WT_OK)
        file_copies_remove(files, work);
    if (status == WT_OK)
        note_kept(files, work);
    else
        flow_files_clear(files);
    return status;
}

void flow_files_clear(flow_files *files)
{
    for (size_t i = 0; i < files->n; i++)
        free((void *)files->file[i].path);
    free(files->file);
    if (files->seen != NULL)
        sample_set_clear(files->seen);
    free(files->seen);
    *files = (flow_files){0};
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
                            wt_input_role role, wt_error *err)
{
    const wt_format_info *info = file->format;
    char format[128];
    snprintf(format, sizeof format, "%s %s", info->id, info->version != NULL ? info->version : "");
    char *const instrument = flow_instrument(work, input, info, &file->set->read);
    wt_provenance_input row = {.path = file->name, .role = role, .group = file->group};
    row.format = format;
    row.instrument = instrument;
    row.given_columns = info->given_columns;
    const wt_status status = wt_job_add_input(work, row, input, err);
    free(instrument);
    if (status != WT_OK)
        wt_error_file(err, file->name);
    return status;
}

wt_status flow_open(const wt_job *work, flow_file *file, wt_input_role role, unsigned kinds,
                    wt_input **result, wt_error *err)
{
    return flow_open_paired(work, file, role, kinds, result, NULL, err);
}

wt_status flow_open_paired(const wt_job *work, flow_file *file, wt_input_role role, unsigned kinds,
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
    if (file->is_copy)
        return true;
    const bool unknown = failure->status == WT_E_FORMAT && file->format == NULL;
    if (!file->from_folder || !(unknown || failure->status == WT_E_EMPTY))
        return false;
    wt_log_action(work->log, WT_WARNING, WT_LEFT_OUT, 1, "--format", file->name, NULL,
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

/* ---- height images --------------------------------------------------------------------------- */

/* True for a signal of the cantilever, which may also be in metres. */
static bool is_cantilever_signal(const wt_image *image)
{
    return strncmp(image->name, "Deflection", strlen("Deflection")) == 0 ||
           strncmp(image->name, "Amplitude", strlen("Amplitude")) == 0;
}

static bool has_heights(const wt_image *image, const char *name, bool profiles)
{
    const bool area = image->n_rows > 1 && image->height > 0;
    const bool profile = profiles && image->n_rows == 1 && strcmp(image->x_unit, "m") == 0;
    return strcmp(image->unit, "m") == 0 && image->n_columns > 1 && image->width > 0 &&
           (area || profile) &&
           (name == NULL ? !is_cantilever_signal(image) : strstr(image->name, name) != NULL);
}

wt_status flow_heights_read(flow_file *file, const char *name, bool profiles, wt_input_role role,
                            const wt_job *work, wt_image *image, wt_error *err)
{
    const wt_read_options *read = &file->set->read;
    wt_input *input = NULL;
    wt_image *images = NULL;
    size_t n = 0, chosen = SIZE_MAX;
    wt_status status = flow_open(work, file, role, WT_KIND_IMAGE, &input, err);
    if (status == WT_OK)
        status = wt_images_read(work->formats, input, read, work->log, &images, &n, err);
    for (size_t i = 0; i < n; i++) {
        if (chosen == SIZE_MAX && has_heights(&images[i], name, profiles)) {
            chosen = i;
            *image = images[i];
        } else {
            wt_image_clear(&images[i]);
        }
    }
    free(images);
    wt_input_close(input);
    if (status == WT_OK && chosen == SIZE_MAX) {
        status = wt_fail(err, WT_E_NOT_FOUND, "no image of heights%s%s in the file",
                         name != NULL ? " called " : "", name != NULL ? name : "");
        wt_error_file(err, file->name);
        wt_error_expected(err, "%slines of heights in metres, over an area in metres",
                          profiles ? "one or more " : "two or more ");
        wt_error_found(err, "images: %zu; `weartrack info FILE` shows them", n);
    }
    return status;
}
