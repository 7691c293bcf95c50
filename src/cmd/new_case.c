/* weartrack new-case: writes a commented case file for given files. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cmd/new_case.h"

/* Returns the path relative to the folder of the case, or absolute; NULL: no memory. */
static char *path_in_case(const new_case *c, const char *path)
{
    const char *const output = c->s->common.output;
    char *whole = NULL;
    if (output != NULL && strchr(output, '/') != NULL && path[0] != '/')
        whole = realpath(path, NULL);
    return whole != NULL ? whole : wt_strdup(path);
}

/* ---- kinds of the files -----------------------------------------------------------------------
 */

/* Returns the first word that the name contains, ignoring case; NULL: none. */
static const char *find_name_token(const char *name, size_t length, const char *const *words)
{
    for (size_t i = 0; words[i] != NULL; i++)
        for (size_t k = 0, n = strlen(words[i]); k + n <= length; k++)
            if (strncasecmp(name + k, words[i], n) == 0)
                return words[i];
    return NULL;
}

enum { MAX_SEARCH_WORDS = 7 };
typedef const char *const word_list[MAX_SEARCH_WORDS];

/* Finds the group by the name of the file, else of its folder, else of the folders above that
 * differ between the files, those after the first `common` characters. */
static bool find_group_by_name_tokens(case_entry *e, size_t common, word_list words[])
{
    const char *const path = e->path, *end = path + strlen(path);
    for (int above = 0; end > path && (above < 2 || end > path + common); above++) {
        const char *slash = memrchr(path, '/', (size_t)(end - path));
        const char *name = slash != NULL ? slash + 1 : path;
        for (case_section where = BULK; where <= TRACK && e->word == NULL; where++) {
            e->word = find_name_token(name, (size_t)(end - name), words[where]);
            e->case_section = e->word != NULL ? where : BULK;
        }
        e->from_folder = above > 0;
        if (e->word != NULL)
            return true;
        end = slash != NULL ? slash : path;
    }
    return false;
}

/* Finds the group of a file. "reference" is ambiguous and counts only if no other word is found. */
static void find_entry_group(case_entry *e, size_t common)
{
    static word_list words[] = {
        [BULK] = {"bulk", "unworn", "virgin", "outside", "beside", NULL},
        [TRACK] = {"track", "worn", "wear", "scar", "groove", "inside", NULL}};
    static word_list weak[] = {[BULK] = {"reference", NULL}, [TRACK] = {NULL}};
    if (!find_group_by_name_tokens(e, common, words))
        (void)find_group_by_name_tokens(e, common, weak);
}

/* Assigns force curves to groups by their names; a warning states how many are guesses. */
static void guess_groups(new_case *c)
{
    const case_entry *first = NULL;
    size_t common = 0, n = 0, n_guessed = 0;
    for (size_t i = 0; i < c->n; i++) {
        const case_entry *e = &c->entries[i];
        if (e->case_section != BULK)
            continue;
        size_t same = 0;
        while (first != NULL && e->path[same] != '\0' && e->path[same] == first->path[same])
            same++;
        common = first == NULL ? strlen(e->path) : same < common ? same : common;
        first = first != NULL ? first : e;
    }
    for (size_t i = 0; i < c->n; i++)
        if (c->entries[i].case_section == BULK) {
            find_entry_group(&c->entries[i], common);
            n_guessed += c->entries[i].word == NULL;
            n++;
        }
    if (n_guessed > 0)
        wt_log_add(c->s->log, WT_WARNING, NULL, NULL,
                   "%zu of %zu files of force curves stand in <bulk> by a guess: no name of "
                   "theirs says bulk or track",
                   n_guessed, n);
}

/* Returns the section of a kind; force curves are bulk until their names are evaluated. */
static case_section section_from_kind(const file_kind *found)
{
    return found->kind == WT_KIND_SWEEP      ? DMA
           : found->kind == WT_KIND_SPECTRUM ? ROUGHNESS
           : found->kind == WT_KIND_FORCE    ? BULK
           : found->kind == WT_KIND_IMAGE    ? MAPS
           : found->kind == WT_KIND_RECORD   ? RECORD
                                             : UNUSED;
}

static bool is_profile(const file_kind *found)
{
    return found->one_row || (found->has_x && !found->has_y);
}

/* Assigns height maps: they belong to the counter surface, unless a name indicates a spot or there
 * is a spectrum of it. A profile with a track in its name belongs to the record. */
static void guess_maps(new_case *c)
{
    static const char *const surface[] = {"road",     "counter",   "asphalt", "concrete",
                                          "pavement", "substrate", "disc",    NULL};
    const bool spectrum = new_case_count(c, ROUGHNESS) > 0, records = new_case_count(c, RECORD) > 0;
    size_t n_guessed = 0;
    for (size_t i = 0; i < c->n; i++) {
        case_entry *e = &c->entries[i], of_spot = {.path = e->path};
        if (e->case_section != MAPS)
            continue;
        const char *slash = strrchr(e->path, '/'), *name = slash != NULL ? slash + 1 : e->path;
        const bool said = find_name_token(name, strlen(name), surface) != NULL;
        find_entry_group(&of_spot, strlen(e->path));
        if (!said && records && is_profile(&e->found) && of_spot.case_section == TRACK)
            e->case_section = PROFILE;
        else if (spectrum || (!said && of_spot.word != NULL))
            e->case_section = UNUSED;
        else
            n_guessed += said ? 0 : 1;
    }
    if (n_guessed > 0)
        wt_log_add(c->s->log, WT_WARNING, NULL, NULL,
                   "%zu height map%s in <roughness> by a guess: take out what is no map of "
                   "the counter surface, as images of spots",
                   n_guessed, n_guessed == 1 ? " stands" : "s stand");
}

/* Checks that the name can be stored in a case and read back unchanged. */
static wt_status check_case_name(new_case *c, case_entry *e)
{
    wt_error *const err = &c->s->err;
    e->in_case = path_in_case(c, e->path);
    const char *const unfit = new_case_name_problem(e->in_case);
    if (unfit == NULL)
        return WT_OK;
    (void)wt_fail(err, WT_E_ARG, "the name cannot stand in a case file: it has %s", unfit);
    wt_error_file(err, e->path);
    wt_error_advice(err, "give the file, or its folder, another name");
    return WT_E_ARG;
}

/* True for files of a folder that are no measurements, such as notes and pictures. */
static bool is_foreign_file(const wt_error *failure, bool in_folder)
{
    return in_folder && (failure->status == WT_E_FORMAT || failure->status == WT_E_EMPTY);
}

static void classify_entry(new_case *c, case_entry *e, bool in_folder)
{
    const wt_read_options options = wt_read_defaults();
    wt_table *metadata = NULL;
    if (check_case_name(c, e) == WT_OK &&
        file_kind_detect(c->s, e->path, &options, NULL, &metadata, &e->found) == WT_OK) {
        e->case_section = section_from_kind(&e->found);
    } else {
        e->case_section = UNUSED;
        e->left_out = is_foreign_file(&c->s->err, in_folder);
        snprintf(e->found.description, sizeof e->found.description, "%s", c->s->err.message);
        if (!e->left_out)
            cmd_report_failure(c->s);
    }
    wt_table_free(metadata);
}

/* Adds the files that match a pattern. */
static wt_status add_files(new_case *c, const char *pattern, bool in_folder)
{
    char **paths = NULL;
    size_t n = 0;
    const wt_status status = wt_glob(NULL, pattern, &paths, &n, &c->s->err);
    if (status != WT_OK)
        return status;
    case_entry *grown = wt_realloc(c->entries, c->n + n, sizeof *grown);
    c->entries = grown;
    for (size_t i = 0; i < n; i++) {
        grown[c->n] = (case_entry){.path = paths[i]};
        classify_entry(c, &grown[c->n++], in_folder);
    }
    free(paths);
    return WT_OK;
}

/* Filter of scandir: entries that are not hidden. */
static int is_visible(const struct dirent *item)
{
    return item->d_name[0] != '.';
}

/* Reports a failure and continues with the other files. */
static wt_status report_and_continue(new_case *c, wt_status status)
{
    if (status == WT_OK || status == WT_E_MEMORY)
        return status;
    cmd_report_failure(c->s);
    return WT_OK;
}

/* Adds the files of a folder and its subfolders. Links to folders are not followed, as they may
 * form a loop. */
static wt_status add_case_folder(new_case *c, const char *folder)
{
    struct dirent **items = NULL;
    struct stat info;
    if (wt_report_is_at(folder)) /* it has no measurements */
        return WT_OK;
    wt_status status = add_files(c, folder, true);
    status = status == WT_E_NOT_FOUND ? WT_OK : status; /* only subfolders */
    const int n = status == WT_OK ? scandir(folder, &items, is_visible, alphasort) : 0;
    if (n < 0) {
        status = wt_fail(&c->s->err, WT_E_IO, "cannot read the folder: %s", strerror(errno));
        wt_error_file(&c->s->err, folder);
    }
    for (int i = 0; i < n; i++) {
        char *inner = status == WT_OK ? wt_path_join(folder, items[i]->d_name) : NULL;
        if (status == WT_OK && lstat(inner, &info) == 0 && S_ISDIR(info.st_mode))
            status = report_and_continue(c, add_case_folder(c, inner));
        free(inner);
        free(items[i]);
    }
    free(items);
    return status;
}

/* Adds the files of one argument; if there are none, the failure is reported and the call
 * continues. */
static wt_status add_argument(new_case *c, const char *pattern)
{
    struct stat info;
    const size_t before = c->n;
    wt_status status = stat(pattern, &info) == 0 && S_ISDIR(info.st_mode)
                           ? add_case_folder(c, pattern)
                           : add_files(c, pattern, false);
    if (status == WT_OK && c->n == before) {
        status = wt_fail(&c->s->err, WT_E_NOT_FOUND, "no file found in the folder");
        wt_error_file(&c->s->err, pattern);
    }
    return report_and_continue(c, status);
}

/* Warns of skipped files; an error if no other file remains. */
static wt_status report_foreign_files(new_case *c)
{
    const case_entry *first = NULL;
    size_t n = 0;
    for (size_t i = 0; i < c->n; i++)
        if (c->entries[i].left_out) {
            first = first != NULL ? first : &c->entries[i];
            n++;
        }
    if (n == 0)
        return WT_OK;
    if (n == c->n) {
        wt_fail(&c->s->err, WT_E_EMPTY, "nothing measured in the folder: no case is written");
        wt_error_found(&c->s->err, "files: %zu, as %s", n, first->path);
        wt_error_advice(&c->s->err, "`weartrack info FILE` shows what a file holds");
        return WT_E_EMPTY;
    }
    wt_log_add(c->s->log, WT_WARNING, NULL, NULL,
               "%zu file%s of the folders hold%s nothing that is read, as %s; comments at the "
               "end of the case name %s",
               n, n == 1 ? "" : "s", n == 1 ? "s" : "", first->path, n == 1 ? "it" : "them");
    return WT_OK;
}

static wt_status write_new_case(new_case *c)
{
    wt_error *err = &c->s->err;
    cmd_sink sink;
    wt_status status = cmd_sink_open(c->s->common.output, &sink, err);
    if (status == WT_OK) {
        cmd_show_first_lines(c->s, &sink);
        new_case_write(sink.stream, c);
        if (ferror(sink.stream))
            status = wt_fail(err, WT_E_IO, "cannot write: %s", strerror(errno));
    }
    return cmd_sink_close(&sink, status, err);
}

/* ---- the call -------------------------------------------------------------------------------- */

static const wt_param rows[] = {
    {PARAM_TEXT_OF("tip", new_case, tip), .value = "TIP", .unset = "",
     .help = "tip of the cantilever, as that of weartrack indent"},
};
CMD_OPTIONS(new_case_params, new_case, rows)

int cmd_new_case(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "new-case",
        .arguments = "[OPTION]... FILE...",
        .description =
            "Writes a commented case file (weartrack-case(5)) for the files (folders, with the "
            "folders in them, and patterns): force curves as bulk or track, by the names of their "
            "folders; DMA sweeps; a power spectrum or height maps of the counter surface; a record "
            "of friction and profiles across the track. What no file says stands there as " FILL_IN
            ".",
        .common = "output formats files-from",
        .notes =
            "Exit status 3 if a file was not understood, 1 if none was; the case names it in a "
            "comment.",
        .n_files = CMD_ONE_OR_MORE};
    cmd_session s = cmd_session_defaults();
    new_case c = {.s = &s};
    cmd_option_group part = {new_case_params(), &c, NULL, 0};
    if (!cmd_parse(&s, &usage, &part, 1, argc, argv) || !cmd_require_text_output(&s, false) ||
        !cmd_begin_reading(&s, NULL))
        return cmd_session_free(&s);
    wt_status status = WT_OK;
    for (size_t i = 0; i < s.n_files && status == WT_OK; i++)
        status = add_argument(&c, s.files[i]);
    if (status == WT_OK && c.n == 0)
        status = wt_fail(&s.err, WT_E_EMPTY, "no file: no case is written");
    if (status == WT_OK)
        status = report_foreign_files(&c);
    if (status == WT_OK) {
        guess_groups(&c);
        guess_maps(&c);
        if (s.status == CMD_PARTIAL && new_case_count(&c, UNUSED) == c.n)
            s.status = CMD_FAILED;
        status = write_new_case(&c);
        cmd_print_log(&s, s.log, false);
    }
    if (status != WT_OK)
        cmd_fail(&s);
    else if (s.common.output != NULL && !s.common.quiet && s.status != CMD_FAILED)
        cmd_message("next: fill in what is missing, then weartrack run %s\n", s.common.output);
    for (size_t i = 0; i < c.n; i++) {
        free(c.entries[i].path);
        free(c.entries[i].in_case);
    }
    free(c.entries);
    return cmd_session_free(&s);
}
