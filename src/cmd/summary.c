/* weartrack summary: one row for each result. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/table_output.h"

/* Result of reading one file: headlines or failure. */
typedef struct file_result {
    wt_table *headlines; /* NULL after a failure */
    char *first_numbers; /* main numbers for a terminal, or NULL */
    wt_error *failure;   /* NULL without a failure */
    size_t n_remarks;
} file_result;

typedef struct summary_reading {
    const char *const *files;
    file_result *results;
    bool brief;
} summary_reading;

/* Results that a terminal shows, in three lines each. */
enum { SHOWN = 6, INDENT = 4, ROOM = 3 * CMD_SCREEN_WIDTH - 4 * INDENT };

/* Returns the first main numbers that fit behind the name of the result. */
static char *first_numbers(const wt_result *result, const char *file)
{
    char text[ROOM + 1] = "";
    wt_result_rows *rows = wt_result_rows_new(result, wt_result_find(result, "answer") != NULL);
    const size_t name = cmd_text_width(file, strlen(file));
    for (size_t k = 0, used = 0; k < wt_result_rows_count(rows); k++) {
        const wt_result_row row = wt_result_rows_get(rows, k);
        const bool closed = row.interval[0] != '\0';
        if (row.text[0] == '\0') /* only a note */
            continue;
        const int length =
            snprintf(text + used, sizeof text - used, "%s %s %s%s%s%s", k == 0 ? ":" : ";",
                     row.name, row.text, closed ? " (" : "", row.interval, closed ? ")" : "");
        if (name + used + (size_t)length > ROOM) {
            text[used] = '\0';
            break;
        }
        used += (size_t)length;
    }
    wt_result_rows_free(rows);
    return wt_strdup(text);
}

/* Reads one file. It never fails; a failure is stored. */
static wt_status read_result(void *user, size_t i, unsigned worker)
{
    const summary_reading *const r = user;
    file_result *const one = &r->results[i];
    wt_error err = WT_ERROR_INIT;
    wt_result *result = NULL;
    (void)worker;
    const bool shown = r->brief && i < SHOWN, whole = shown || !cmd_is_hdf5_path(r->files[i]);
    wt_status read = whole ? cmd_tables_read(r->files[i], &result, &err)
                           : wt_tables_read_main_values(r->files[i], &result, &err);
    if (read == WT_OK)
        read = wt_result_main_values(result, &one->headlines, &err);
    if (read == WT_OK) {
        one->n_remarks = cmd_count_remarks(result);
        one->first_numbers = shown ? first_numbers(result, r->files[i]) : NULL;
    } else {
        one->failure = wt_alloc(1, sizeof err);
        wt_error_file(&err, r->files[i]);
        *one->failure = err;
    }
    wt_result_free(result);
    return WT_OK;
}

static void print_first_numbers(const char *path, const file_result *one)
{
    if (one->first_numbers == NULL)
        return;
    cmd_print_safely(stdout, path, strlen(path));
    cmd_wrap(stdout, cmd_text_width(path, strlen(path)), INDENT, one->first_numbers);
    free(one->first_numbers);
}

/* Reports failures in the order of the files, prints first numbers, and moves the files that were
 * read to the front, with their headlines. Returns their number. */
static size_t collect_read_results(cmd_session *s, file_result *results, wt_table **headlines)
{
    size_t n_read = 0;
    for (size_t i = 0; i < s->n_files; i++) {
        const char *const path = s->files[i];
        file_result *const one = &results[i];
        if (one->headlines != NULL) {
            s->files[n_read] = path;
            headlines[n_read++] = one->headlines;
            cmd_apply_strict(s, path, one->n_remarks);
            print_first_numbers(path, one);
            continue;
        }
        s->err = *one->failure;
        cmd_report_failure(s);
        free(one->failure);
    }
    if (n_read == 0)
        s->status = CMD_FAILED;
    return n_read;
}

/* Reads the headlines of all files; those that were read are moved to the front. They are read one
 * by one, as a process that reads HDF5 is not forked beside other threads, which may hold locks. */
static wt_status read_all_results(cmd_session *s, bool brief, wt_table **headlines, size_t *n_read)
{
    file_result *const results = wt_alloc(s->n_files, sizeof *results);
    summary_reading all = {s->files, results, brief};
    const size_t n_files = s->n_files;
    const wt_progress progress = cmd_progress_start(s);
    const wt_status status = wt_parallel_for(s->n_files, 1, read_result, &all, &progress, "result");
    cmd_progress_end(s);
    *n_read = collect_read_results(s, results, headlines);
    if (brief && n_files > SHOWN)
        printf("and %zu more files\n", n_files - SHOWN);
    free(results);
    return status == WT_OK ? WT_OK : wt_fail(&s->err, status, "%s", wt_status_text(status));
}

/* Prints how much of the result failed; without it the list of its numbers would look complete. */
static void print_counts(const cmd_session *s)
{
    const wt_table *failures = wt_result_find(s->result, "failures");
    const size_t n_failed = failures != NULL ? wt_table_n_rows(failures) : 0;
    const size_t n_remarks = cmd_count_remarks(s->result);
    if (n_failed > 0)
        printf("failed   %zu, see the table failures\n", n_failed);
    if (n_remarks > 0)
        printf("remarks  %zu, see the table notes\n", n_remarks);
}

/* True if main numbers are listed on a terminal. --quiet prints no list. */
static bool shows_list(const cmd_session *s, const cmd_option_group *form)
{
    return !cmd_option_is_set(form, "format") && !s->common.quiet && cmd_shows_first_lines(s);
}

/* Prints the main numbers of one result below each other, where a row of 60 columns would be cut.
 * Returns false if the result has none, or if the table is requested. */
static bool print_one_result(cmd_session *s, const cmd_option_group *form)
{
    if (s->n_files != 1 || !shows_list(s, form))
        return false;
    wt_error err = WT_ERROR_INIT; /* the table reports the failure */
    if (cmd_tables_read(s->files[0], &s->result, &err) != WT_OK || !cmd_shows_short_table(s))
        return false;
    cmd_print_short_table(s, wt_result_find(s->result, "answer") != NULL);
    print_counts(s);
    cmd_apply_strict(s, s->files[0], cmd_count_remarks(s->result));
    puts("one row of all main numbers: -o FILE, or -o - to print it");
    return true;
}

int cmd_summary(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "summary",
        .arguments = "[OPTION]... RESULT...",
        .description =
            "One row for each result (HDF5 or text stream) with its main numbers, their errors "
            "or intervals, and verdicts. A column is there if one of the results has it.",
        .common = "output files-from",
        .exports = true,
        .notes =
            "Exit status 3 if a file could not be read, which then has no row; 1 if none could.",
        .n_files = CMD_ONE_OR_MORE,
        .files = "no result given"};
    export_options form = {.form = WT_EXPORT_TSV};
    cmd_session s = cmd_session_defaults();
    cmd_option_group parts[] = {{export_params(), &form, NULL, 0}};
    wt_table *summary = NULL;
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) ||
        !cmd_require_text_output(&s, true))
        return cmd_session_free(&s);
    if (print_one_result(&s, &parts[0]))
        return cmd_session_free(&s);
    const bool brief = shows_list(&s, &parts[0]);
    size_t n_read = 0;
    wt_table **headlines = wt_alloc(s.n_files, sizeof *headlines);
    wt_status status = read_all_results(&s, brief, headlines, &n_read);
    if (status == WT_OK && brief)
        puts("a row of all main numbers for each: -o FILE, or -o - to print them");
    if (n_read > 0 && status == WT_OK && !brief)
        status =
            wt_summary_table(s.files, (const wt_table *const *)headlines, n_read, &summary, &s.err);
    if (n_read > 0 && status == WT_OK && !brief)
        status = export_table(&s, &parts[0], summary);
    if (status != WT_OK)
        cmd_fail(&s);
    for (size_t i = 0; i < n_read; i++)
        wt_table_free(headlines[i]);
    free(headlines);
    wt_table_free(summary);
    return cmd_session_free(&s);
}
