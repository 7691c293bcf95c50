/* Reads and writes files of a report: embedded ones by name, others by path.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report_files.h"
#include "core/base/array.h"
#include "core/system/temporary.h"
#include "report/report_embedded.h"
#include "weartrack/report.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

const char *embedded_file_text(const char *name)
{
    for (const embedded_text *file = report_embedded; file->name != NULL; file++)
        if (strcmp(file->name, name) == 0)
            return file->text;
    return NULL;
}

wt_status read_whole_file(const char *path, size_t limit, text_buffer *text, wt_error *err)
{
    wt_status status = WT_OK;
    char chunk[8192];
    FILE *file = fopen(path, "rb");
    for (size_t got;
         file != NULL && text->length <= limit && (got = fread(chunk, 1, sizeof chunk, file)) > 0;)
        text_bytes(text, chunk, got);
    const int reason = errno;
    if (file == NULL)
        status = wt_fail(err, reason == ENOENT ? WT_E_NOT_FOUND : WT_E_IO, "cannot be opened: %s",
                         strerror(reason));
    else if (ferror(file))
        status = wt_fail(err, WT_E_IO, "cannot be read: %s", strerror(reason));
    else if (text->length > limit)
        status = wt_fail(err, WT_E_RANGE, "larger than %zu bytes", limit);
    if (status != WT_OK)
        wt_error_file(err, path);
    if (file != NULL)
        fclose(file);
    return status;
}

/* Writes a file in a temporary folder. */
static wt_status write_temporary_file(const char *path, const char *bytes, size_t length,
                                      wt_error *err)
{
    FILE *file = fopen(path, "wb");
    bool good = file != NULL && fwrite(bytes, 1, length, file) == length;
    int code = errno;
    if (file != NULL && fclose(file) != 0 && good) {
        code = errno;
        good = false;
    }
    if (good)
        return WT_OK;
    const wt_status status = wt_fail(err, WT_E_IO, "cannot be written: %s", strerror(code));
    wt_error_file(err, path);
    return status;
}

/* Adds the names of the built-in styles: "paper, screen". */
static void add_style_names(text_buffer *names)
{
    for (const embedded_text *file = report_embedded; file->name != NULL; file++) {
        const char *end = strstr(file->name, ".gp");
        if (end != NULL)
            text_format(names, "%s%.*s", names->length == 0 ? "" : ", ", (int)(end - file->name),
                        file->name);
    }
}

wt_status find_built_in_style(const char *name, const char **text, wt_error *err)
{
    text_buffer file = {0}, names = {0};
    text_format(&file, "%s.gp", name);
    *text = embedded_file_text(text_string(&file));
    text_free(&file);
    if (*text != NULL)
        return WT_OK;
    add_style_names(&names);
    wt_status status = wt_fail(err, WT_E_NOT_FOUND, "no plot style of that name");
    wt_error_expected(err, "%s", text_string(&names));
    wt_error_found(err, "\"%s\"", name);
    wt_error_advice(err, "a style of your own is a file that ends in .gp, given with --style");
    text_free(&names);
    return status;
}

wt_status read_style(const char *style, text_buffer *text, wt_error *err)
{
    enum { STYLE_LIMIT = 1 << 20 };
    const char *name = style != NULL ? style : "paper", *built_in = NULL;
    size_t length = strlen(name);
    if (strchr(name, '/') != NULL || (length > 3 && strcmp(name + length - 3, ".gp") == 0)) {
        wt_protect_input(name);
        return read_whole_file(name, STYLE_LIMIT, text, err);
    }
    wt_status status = find_built_in_style(name, &built_in, err);
    if (status != WT_OK)
        return status;
    text_add(text, built_in);
    return WT_OK;
}

/* ---- folder ---------------------------------------------------------------------------------- */

enum { REPORT_NAME = 128 };

struct report_folder {
    char *target;    /* final path */
    bool is_page;    /* only the page is written */
    char *temporary; /* temporary folder */
    int lock_file;   /* descriptor that protects the temporary folder from removal; -1 before it
                      * exists
                      */
    char *plots;
};

static wt_status io_error(wt_error *err, const char *what, const char *path)
{
    int code = errno;
    wt_status status = wt_fail(err, WT_E_IO, "%s: %s", what, strerror(code));
    wt_error_file(err, path);
    return status;
}

/* ---- conditions for replacement -------------------------------------------------------------- */

/* Returns the name of the i-th possible file of a report, with the folder "plots"; NULL past the
 * last one. */
static const char *report_file_name(size_t i, char name[REPORT_NAME])
{
    static const char *const common[] = {"index.html", "plots/style.gp", "plots/output.gp"},
                             *const endings[] = {"tsv", "gp", "svg", "pdf", "png"};
    enum { COMMON = COUNT_OF(common), ENDINGS = COUNT_OF(endings) };
    if (i < COMMON)
        return common[i];
    const size_t figure = (i - COMMON) / ENDINGS;
    if (figure >= wt_figure_count())
        return NULL;
    (void)snprintf(name, REPORT_NAME, "plots/%s.%s", wt_figure_get(figure).name,
                   endings[(i - COMMON) % ENDINGS]);
    return name;
}

bool path_is_page(const char *target)
{
    static const char ending[] = ".html";
    struct stat info;
    const size_t length = strlen(target);
    return length >= sizeof ending && strcmp(target + length - (sizeof ending - 1), ending) == 0 &&
           (stat(target, &info) != 0 || !S_ISDIR(info.st_mode));
}

char *wt_report_page_path(const char *target)
{
    return path_is_page(target) ? wt_strdup(target) : wt_path_join(target, "index.html");
}

bool wt_report_is_at(const char *target)
{
    enum { HEAD = 4096 };
    char head[HEAD + 1];
    char *path = wt_report_page_path(target);
    FILE *file = fopen(path, "rb");
    free(path);
    if (file == NULL)
        return false;
    size_t n = fread(head, 1, HEAD, file);
    fclose(file);
    head[n] = '\0';
    return strstr(head, REPORT_MARK) != NULL;
}

static wt_status fail_not_replaceable(wt_error *err, const char *path, const char *found)
{
    wt_status status = wt_fail(err, WT_E_IO, "will not be replaced: it is not a weartrack report");
    wt_error_file(err, path);
    wt_error_expected(err, path_is_page(path) ? "a new name or an older report"
                                              : "a new name, an empty folder or an older report");
    wt_error_found(err, "%s", found);
    wt_error_advice(err, "give another name, or move away what is there");
    return status;
}

/* True for files of a file manager, and for temporary folders of a killed run. */
static bool is_ignored_file(const char *name)
{
    return name[0] == '.' || strcmp(name, "Thumbs.db") == 0 || strcmp(name, "desktop.ini") == 0;
}

/* Rejects a folder that is no report and has other files. */
static wt_status check_folder_is_empty(const char *path, wt_error *err)
{
    wt_status status = WT_OK;
    char found[300];
    DIR *folder = opendir(path);
    if (folder == NULL)
        return io_error(err, "cannot be read", path);
    for (const struct dirent *entry; status == WT_OK && (entry = readdir(folder)) != NULL;) {
        (void)snprintf(found, sizeof found, "other files in it: %s", entry->d_name);
        if (!is_ignored_file(entry->d_name))
            status = fail_not_replaceable(err, path, found);
    }
    closedir(folder);
    return status;
}

/* True for binary pictures of gnuplot, which are no text and are never read. They may be replaced
 * in a folder that is marked as a report. */
static bool is_bitmap_or_pdf(const char *name)
{
    const char *const ending = strrchr(name, '.');
    return ending != NULL && (strcmp(ending, ".pdf") == 0 || strcmp(ending, ".png") == 0);
}

/* Checks that a folder is empty or an older report. Files of the report may be replaced unless they
 * were read; other files are not touched. */
static wt_status check_replaceable(const char *path, wt_error *err)
{
    struct stat info;
    if (lstat(path, &info) != 0)
        return errno == ENOENT ? WT_OK : io_error(err, "cannot be looked at", path);
    if (path_is_page(path))
        return !S_ISREG(info.st_mode) || !wt_report_is_at(path)
                   ? fail_not_replaceable(err, path, "another file of that name")
                   : wt_check_overwrite(path, err);
    if (!S_ISDIR(info.st_mode))
        return fail_not_replaceable(err, path, "a file of that name");
    if (!wt_report_is_at(path))
        return check_folder_is_empty(path, err);
    wt_status status = WT_OK;
    char name[REPORT_NAME];
    char *plots = wt_path_join(path, "plots");
    if (lstat(plots, &info) == 0 && !S_ISDIR(info.st_mode))
        status = fail_not_replaceable(err, path, "plots, which is no folder");
    free(plots);
    const char *own;
    for (size_t i = 0; status == WT_OK && (own = report_file_name(i, name)) != NULL; i++) {
        char *file = wt_path_join(path, own);
        if (!is_bitmap_or_pdf(own))
            status = wt_check_overwrite(file, err);
        free(file);
    }
    return status;
}

/* ---- creation -------------------------------------------------------------------------------- */

static void folder_free(report_folder *folder)
{
    if (folder->lock_file >= 0)
        close(folder->lock_file);
    free(folder->target);
    free(folder->temporary);
    free(folder->plots);
    free(folder);
}

/* Resolves the path: removes slashes at the end and follows symbolic links. */
static wt_status resolve_report_path(const char *path, char **target, wt_error *err)
{
    char *plain = wt_strdup(path), *real = NULL;
    wt_status status = WT_OK;
    for (size_t n = strlen(plain); n > 1 && plain[n - 1] == '/'; n--)
        plain[n - 1] = '\0';
    const char *base = wt_path_base(plain);
    if (base[0] == '\0' || strcmp(base, ".") == 0 || strcmp(base, "..") == 0) {
        status = wt_fail(err, WT_E_ARG, "a report needs a folder of its own");
        wt_error_file(err, path);
        wt_error_advice(err, "name a new folder, for example \"report\"");
        free(plain);
        return status;
    }
    real = realpath(plain, NULL);
    if (real != NULL) {
        *target = real;
        free(plain);
    } else
        *target = plain;
    return WT_OK;
}

/* Creates the temporary folder inside of an existing target, else next to it: on the same file
 * system, so that files can be renamed. */
static wt_status create_temporary_folder(report_folder *folder, wt_error *err)
{
    struct stat info;
    char *parent = !folder->is_page && stat(folder->target, &info) == 0
                       ? wt_strdup(folder->target)
                       : wt_path_folder(folder->target);
    temporary_remove_abandoned(parent);
    folder->temporary = temporary_folder_create(parent, &folder->lock_file);
    free(parent);
    if (folder->temporary != NULL)
        return WT_OK;
    wt_status status = io_error(err, "cannot be made", folder->target);
    wt_error_advice(err, "the folder it goes into must exist and be writable");
    return status;
}

wt_status folder_open(const char *path, report_folder **out, wt_error *err)
{
    report_folder *folder = wt_alloc(1, sizeof *folder);
    folder->lock_file = -1;
    wt_status status = resolve_report_path(path, &folder->target, err);
    folder->is_page = status == WT_OK && path_is_page(folder->target);
    if (status == WT_OK)
        status = check_replaceable(folder->target, err);
    if (status == WT_OK)
        status = create_temporary_folder(folder, err);
    if (status == WT_OK) {
        folder->plots = wt_path_join(folder->temporary, "plots");
        if (mkdir(folder->plots, 0777) != 0)
            status = io_error(err, "cannot be made", folder->plots);
    }
    if (status == WT_OK)
        *out = folder;
    else
        folder_discard(folder);
    return status;
}

const char *folder_plots_path(const report_folder *folder)
{
    return folder->plots;
}

wt_status folder_write(const report_folder *folder, const char *name, const char *bytes,
                       size_t length, wt_error *err)
{
    char *path = wt_path_join(folder->temporary, name);
    const wt_status status = write_temporary_file(path, bytes, length, err);
    free(path);
    return status;
}

/* Moves one file of the report; it keeps the mode of the file that it replaces. Removes a target
 * file that this report does not have. */
static wt_status move_file(const report_folder *folder, const char *name, wt_error *err)
{
    wt_status status = WT_OK;
    struct stat info;
    char *from = wt_path_join(folder->temporary, name), *to = wt_path_join(folder->target, name);
    if (lstat(from, &info) != 0)
        (void)unlink(to);
    else if ((lstat(to, &info) == 0 && S_ISREG(info.st_mode) &&
              chmod(from, info.st_mode & 0777) != 0) ||
             rename(from, to) != 0)
        status = io_error(err, "cannot be replaced", to);
    free(from);
    free(to);
    return status;
}

/* Moves the page over an older one and keeps its mode. */
static wt_status move_page(const report_folder *folder, wt_error *err)
{
    struct stat info;
    wt_status status = check_replaceable(folder->target, err); // again, as it may have changed
    if (status != WT_OK)
        return status;
    char *page = wt_path_join(folder->temporary, "index.html");
    if ((lstat(folder->target, &info) == 0 && chmod(page, info.st_mode & 0777) != 0) ||
        rename(page, folder->target) != 0)
        status = io_error(err, "cannot be written", folder->target);
    free(page);
    return status;
}

/* Moves file by file into an existing folder. The page is first, as it is self-contained and marks
 * the folder as a report. A lock admits one run at a time. */
static wt_status move_files(const report_folder *folder, wt_error *err)
{
    char name[REPORT_NAME];
    const int lock = open(folder->target, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock >= 0)
        (void)flock(lock, LOCK_EX);
    wt_status status = check_replaceable(folder->target, err); // again, as it may have changed
    char *plots = wt_path_join(folder->target, "plots");
    if (status == WT_OK)
        status = move_file(folder, report_file_name(0, name), err);
    if (status == WT_OK && mkdir(plots, 0777) != 0 && errno != EEXIST)
        status = io_error(err, "cannot be made", plots);
    for (size_t i = 1; status == WT_OK && report_file_name(i, name) != NULL; i++)
        status = move_file(folder, report_file_name(i, name), err);
    if (lock >= 0)
        close(lock);
    free(plots);
    return status;
}

wt_status folder_commit(report_folder *folder, wt_error *err)
{
    struct stat info;
    wt_status status = WT_OK;
    if (folder->is_page)
        status = move_page(folder, err);
    else if (lstat(folder->target, &info) != 0 && rename(folder->temporary, folder->target) == 0) {
        free(folder->temporary);
        folder->temporary = NULL;
    } else
        status = move_files(folder, err);
    folder_discard(folder);
    return status;
}

void folder_discard(report_folder *folder)
{
    if (folder == NULL)
        return;
    if (folder->temporary != NULL)
        temporary_remove(folder->temporary);
    folder_free(folder);
}
