/* weartrack report, table and summary: what a result file has.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"

#include "core/base/text.h"

#include <stdlib.h>
#include <string.h>

/* ---- report ---------------------------------------------------------------------------------- */

static const wt_param path_rows[] = {
    {PARAM_TEXT_OF("output", cmd_common_options, output), .value = "PLACE", .letter = 'o',
     .unset = "standard output with --methods; else it is required",
     .help = "the page to write, if it ends in .html, or a folder with the page and the figures"},
};
PARAM_LOCAL_TABLE(report_path_params, cmd_common_options, path_rows, cmd_common_defaults, NO_PARTS)

typedef struct report_flags {
    bool methods;
} report_flags;

static const wt_param flag_rows[] = {
    {PARAM_FLAG_OF("methods", report_flags, methods),
     .help = "write no page, but the text of a section on methods with the numbers of this result "
             "and its references; -o NAME.bib writes the references as BibTeX"},
};
CMD_OPTIONS(report_flag_params, report_flags, flag_rows)

/* ---- a section on methods -------------------------------------------------------------------- */

/* "" if the table has no such column. */
static const char *cell(const wt_table *methods, size_t row, const char *name)
{
    const long column = wt_table_find(methods, name);
    return column >= 0 ? wt_table_text(methods, row, (size_t)column) : "";
}

/* Returns the number of the reference of a row, from 1 in order of first occurrence; 0: none. */
static size_t reference_number(const wt_table *methods, size_t row)
{
    const char *const reference = cell(methods, row, "reference");
    size_t number = 0;
    if (reference[0] == '\0')
        return 0;
    for (size_t i = 0; i <= row; i++) {
        bool first = cell(methods, i, "reference")[0] != '\0';
        for (size_t k = 0; k < i && first; k++)
            first = strcmp(cell(methods, k, "reference"), cell(methods, i, "reference")) != 0;
        number += first;
        if (strcmp(cell(methods, i, "reference"), reference) == 0)
            return number;
    }
    return number;
}

/* Prints each reference once. The keys of BibTeX have the numbers of the text. */
static void print_references(FILE *out, const wt_table *methods, bool as_bibtex)
{
    size_t last = 0;
    for (size_t row = 0; row < wt_table_n_rows(methods); row++) {
        const size_t number = reference_number(methods, row);
        const char *const reference = cell(methods, row, "reference"), *const doi = cell(
                                                                           methods, row, "doi");
        if (number <= last)
            continue;
        last = number;
        if (!as_bibtex) {
            fprintf(out, "[%zu] %s%s%s\n", number, reference,
                    doi[0] != '\0' ? ". https://doi.org/" : "", doi);
            continue;
        }
        fprintf(out, "@misc{reference%zu,\n  note = {", number);
        for (const char *p = reference; *p != '\0'; p++)
            fprintf(out, "%s%c", strchr("&%#_${}", *p) != NULL ? "\\" : "", *p);
        fprintf(out, "}%s%s%s\n}\n", doi[0] != '\0' ? ",\n  doi = {" : "", doi,
                doi[0] != '\0' ? "}" : "");
    }
}

static void print_methods(FILE *out, const wt_table *methods)
{
    for (size_t row = 0; row < wt_table_n_rows(methods); row++) {
        const char *const text = cell(methods, row, "text");
        const size_t number = reference_number(methods, row), length = strlen(text);
        if (number > 0) /* before the full stop */
            fprintf(out, "%.*s [%zu].\n", (int)(length - 1), text, number);
        else
            fprintf(out, "%s\n", text);
    }
    fprintf(out, "All was computed with weartrack %s.\n\nReferences\n", wt_version());
    print_references(out, methods, false);
}

static bool is_bibliography(const char *output)
{
    const char *const dot = output != NULL ? strrchr(output, '.') : NULL;
    return dot != NULL && strcmp(dot, ".bib") == 0;
}

static wt_status write_methods(cmd_session *s)
{
    wt_table *methods = NULL;
    cmd_sink sink;
    wt_status status = wt_methods_table(s->result, &methods, &s->err);
    if (status == WT_OK && wt_table_n_rows(methods) == 0) {
        status = wt_fail(&s->err, WT_E_EMPTY, "no method is known that made these tables");
        wt_error_file(&s->err, s->files[0]);
    }
    if (status == WT_OK && (status = cmd_sink_open(s->common.output, &sink, &s->err)) == WT_OK) {
        if (is_bibliography(s->common.output))
            print_references(sink.stream, methods, true);
        else
            print_methods(sink.stream, methods);
        status = cmd_sink_close(&sink, WT_OK, &s->err);
    }
    wt_table_free(methods);
    return status;
}

/* ---- the page -------------------------------------------------------------------------------- */

/* Checks that a figure has this name, and lists all names if none has. */
static bool check_figure_name(cmd_session *s, const char *name)
{
    char *names = NULL;
    size_t size = 0;
    bool found = name == NULL;
    spell_suggestion near =
        spell_suggestion_begin(name != NULL ? name : "", found ? 0 : strlen(name));
    FILE *const list = open_memstream(&names, &size);
    if (list == NULL)
        cmd_exit_without_memory(size);
    for (size_t i = 0; !found && i < wt_figure_count(); i++) {
        found = strcmp(wt_figure_get(i).name, name) == 0;
        spell_suggestion_try(&near, wt_figure_get(i).name, strlen(wt_figure_get(i).name));
        fprintf(list, "%s%s", i > 0 ? ", " : "", wt_figure_get(i).name);
    }
    fclose(list);
    if (!found)
        (void)cmd_usage_error(s, "there is no figure '%s'%s%s%s; the figures are %s", name,
                              near.name != NULL ? "; did you mean " : "",
                              near.name != NULL ? near.name : "", near.name != NULL ? "?" : "",
                              names);
    free(names);
    return found;
}

/* Checks that the page goes to a file, which is no picture, and that a figure has a page. */
static bool check_page_name(cmd_session *s, bool methods, const char *figure)
{
    static const char *const pictures[] = {".svg", ".pdf", ".png"};
    const char *const output = methods ? NULL : s->common.output;
    const char *const dot = output != NULL ? strrchr(output, '.') : NULL;
    if (output == NULL && !methods)
        return cmd_usage_error(s, "-o is required: NAME.html or a folder");
    if (output != NULL && cmd_is_standard_stream(output))
        return cmd_usage_error(s, "-o -: this goes to a file; give it a name");
    for (size_t i = 0; dot != NULL && i < COUNT_OF(pictures); i++)
        if (strcasecmp(dot, pictures[i]) == 0)
            return cmd_usage_error(s,
                                   "-o %s: a page or a folder is written; -o FOLDER --figures %s "
                                   "puts the pictures there, --figure NAME one of them",
                                   output, pictures[i] + 1);
    if (!cmd_require_text_output(s, false))
        return false;
    if (figure != NULL && methods)
        return cmd_usage_error(s, "--figure is of the page: -o NAME.html or a folder");
    return true;
}

static wt_status write_page(cmd_session *s, const wt_report_options *options)
{
    cmd_check_font(s, options->font);
    const wt_progress progress = cmd_progress_start(s);
    cmd_catch_interruptions();
    const wt_status status =
        wt_report_write(s->result, s->common.output, options, &progress, &s->err);
    cmd_progress_end(s);
    return status;
}

int cmd_report(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "report",
        .arguments = "RESULT -o PLACE|--methods [OPTION]...",
        .description =
            "Writes one page that needs no other file and can be mailed, or a folder with that "
            "page, index.html, and for each figure its data, script and picture; the figures "
            "can be drawn again without weartrack. RESULT is HDF5 or a text stream, - is "
            "standard input.",
        .common = "provenance",
        .n_files = 1,
        .files = "one result file is needed"};
    cmd_session s = cmd_session_defaults();
    wt_report_options report_options = wt_report_defaults();
    report_flags own = {0};
    cmd_option_group parts[] = {{report_path_params(), &s.common, NULL, 0},
                                {report_flag_params(), &own, NULL, 0},
                                {wt_report_params(), &report_options, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) ||
        !check_page_name(&s, own.methods, report_options.figure) ||
        !check_figure_name(&s, report_options.figure))
        return cmd_session_free(&s);
    report_options.with_provenance = s.common.provenance;
    wt_status status = cmd_tables_read(s.files[0], &s.result, &s.err);
    if (status == WT_OK)
        status = own.methods ? write_methods(&s) : write_page(&s, &report_options);
    if ((status == WT_E_MISSING || status == WT_E_UNIT) && s.err.file[0] == '\0')
        wt_error_file(&s.err, s.files[0]); // a table of it is incomplete
    if (status != WT_OK)
        cmd_fail(&s);
    else
        cmd_apply_strict(&s, s.files[0], cmd_count_remarks(s.result));
    if (status == WT_OK && !s.common.quiet && !own.methods)
        cmd_print_page_location(s.common.output);
    return cmd_session_free(&s);
}

/* ---- table ----------------------------------------------------------------------------------- */

typedef struct table_options {
    bool list, keys;
} table_options;

static const wt_param table_rows[] = {
    {PARAM_FLAG_OF("list", table_options, list),
     .help = "the tables that there are, with their rows, columns and words"},
    {PARAM_FLAG_OF("keys", table_options, keys),
     .help = "the values that belong to the whole table, with their errors and units, in place of "
             "its rows"},
};
CMD_OPTIONS(table_option_params, table_options, table_rows)

/* Finds the table of that name; without a name the only table. */
static wt_status choose_table(const wt_result *result, const char *path, const char *name,
                              const wt_table **table, wt_error *err)
{
    const size_t n = wt_result_n_tables(result);
    *table = name != NULL ? wt_result_find(result, name)
             : n == 1     ? wt_result_table(result, 0)
                          : NULL;
    if (*table != NULL)
        return WT_OK;
    if (name != NULL)
        wt_fail(err, WT_E_NOT_FOUND, "there is no table '%s'", name);
    else
        wt_fail(err, WT_E_MISSING, "the name of the table is missing: the result has %zu tables",
                n);
    spell_suggestion near =
        spell_suggestion_begin(name != NULL ? name : "", name != NULL ? strlen(name) : 0);
    for (size_t i = 0; i < n; i++) {
        const char *const other = wt_table_name(wt_result_table(result, i));
        spell_suggestion_try(&near, other, strlen(other));
    }
    wt_error_file(err, path);
    if (near.name != NULL)
        wt_error_advice(err, "did you mean %s? `weartrack table --list %s` shows all", near.name,
                        path);
    else
        wt_error_advice(err, "`weartrack table --list %s` shows them", path);
    return err->status;
}

int cmd_table(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "table",
        .arguments = "[OPTION]... RESULT [NAME]",
        .description =
            "Writes the table NAME of a result (HDF5 or text stream; - is standard input) for "
            "other programs: rows of cells parted by tabs or commas under one header line, or "
            "JSON. In SI units, which stand in the header: modulus[Pa].",
        .common = "output",
        .exports = true,
        .notes = "NAME may be left out if there is one table only."};
    table_options own = {0};
    export_options form = {.form = WT_EXPORT_TSV};
    cmd_option_group parts[] = {{table_option_params(), &own, NULL, 0},
                                {export_params(), &form, NULL, 0}};
    cmd_session s = cmd_session_defaults();
    wt_table *made = NULL;
    const wt_table *table = NULL;
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) ||
        !cmd_require_text_output(&s, true))
        return cmd_session_free(&s);
    if (s.n_files < 1 || s.n_files > (own.list ? 1 : 2)) {
        cmd_usage_error(&s, "a result and the name of a table are needed");
        return cmd_session_free(&s);
    }
    wt_status read = cmd_tables_read(s.files[0], &s.result, &s.err);
    if (read == WT_OK && !own.list)
        read =
            choose_table(s.result, s.files[0], s.n_files > 1 ? s.files[1] : NULL, &table, &s.err);
    if (read == WT_OK && own.list)
        read = wt_result_contents(s.result, &made, &s.err);
    else if (read == WT_OK && own.keys)
        read = wt_table_keys(table, &made, &s.err);
    if (read == WT_OK)
        read = export_table(&s, &parts[1], made != NULL ? made : table);
    if (read == WT_OK)
        cmd_apply_strict(&s, s.files[0], cmd_count_remarks(s.result));
    else
        cmd_fail(&s);
    wt_table_free(made);
    return cmd_session_free(&s);
}

/* ---- summary --------------------------------------------------------------------------------- */

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
