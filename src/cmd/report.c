/* weartrack report: plots and one page from a result file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>

#include "cmd/table_output.h"
#include "core/base/spell_suggest.h"

static const wt_param rows[] = {
    {PARAM_TEXT_OF("output", cmd_common_options, output), .value = "PLACE", .letter = 'o',
     .unset = "standard output with --methods; else it is required",
     .help = "the page to write, if it ends in .html, or a folder with the page and the figures"},
};
PARAM_LOCAL_TABLE(report_path_params, cmd_common_options, rows, cmd_common_defaults, NO_PARTS)

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
