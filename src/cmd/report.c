/* weartrack report: plots and one page from a result file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cmd/table_output.h"
#include "core/base/spell_suggest.h"

static const wt_param rows[] = {
    {PARAM_TEXT_OF("output", cmd_common_options, output), .value = "PLACE", .letter = 'o',
     .unset = "standard output with --methods, none with --browse or --sheets; else it is required",
     .help = "the page to write, if it ends in .html, or a folder with the page and the figures"},
};
PARAM_LOCAL_TABLE(report_path_params, cmd_common_options, rows, cmd_common_defaults, NO_PARTS)

typedef struct report_outputs {
    bool methods;
    const char *browse, *sheets;
} report_outputs;

static const wt_param report_output_rows[] = {
    {PARAM_FLAG_OF("methods", report_outputs, methods),
     .help = "write no page, but the text of a section on methods with the numbers of this result "
             "and its references; -o NAME.bib writes the references as BibTeX"},
    {PARAM_TEXT_OF("browse", report_outputs, browse), .value = "FILE.html", .unset = "",
     .flags = PARAM_WRITTEN,
     .help = "write one page to go through the force curves of the result, of weartrack indent "
             "--curves all, with their fits; choices made on it are for indent --overrides"},
    {PARAM_TEXT_OF("sheets", report_outputs, sheets), .value = "FILE.pdf", .unset = "",
     .flags = PARAM_WRITTEN,
     .help = "write the force curves of the result, of weartrack indent --curves, as a PDF to be "
             "printed, twelve on a sheet of A4, with fit, verdict and reason, refused ones first"},
};
CMD_OPTIONS(report_output_params, report_outputs, report_output_rows)

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

/* ---- output paths ------------------------------------------------------------------------------
 */

/* True if two names are the same file, which need not exist. */
static bool is_same_path(const char *a, const char *b)
{
    struct stat of_a, of_b;
    if (a == NULL || b == NULL || strcmp(wt_path_base(a), wt_path_base(b)) != 0)
        return false;
    char *const in_a = wt_path_folder(a), *const in_b = wt_path_folder(b);
    const bool same = stat(in_a, &of_a) == 0 && stat(in_b, &of_b) == 0 &&
                      of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
    free(in_a);
    free(in_b);
    return same || strcmp(a, b) == 0;
}

/* Checks that no output goes to standard output and that all have different names. */
static bool check_output_names(cmd_session *s, const report_outputs *own)
{
    const struct {
        const char *option, *name;
    } places[] = {{"-o", own->methods ? NULL : s->common.output},
                  {"--browse", own->browse},
                  {"--sheets", own->sheets}};
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        if (places[i].name != NULL && cmd_is_standard_stream(places[i].name))
            return cmd_usage_error(s, "%s -: this goes to a file; give it a name",
                                   places[i].option);
        for (size_t k = 0; k < i; k++)
            if (is_same_path(places[k].name, places[i].name))
                return cmd_usage_error(s, "%s %s: %s has that name, too; give another one",
                                       places[i].option, places[i].name, places[k].option);
    }
    return true;
}

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

/* Rejects the name of a picture for the page, and a figure without a page. */
static bool check_page_name(cmd_session *s, const report_outputs *own, const char *figure)
{
    static const char *const pictures[] = {".svg", ".pdf", ".png"};
    const char *const output = s->common.output;
    const char *const dot = output != NULL && !own->methods ? strrchr(output, '.') : NULL;
    for (size_t i = 0; dot != NULL && i < COUNT_OF(pictures); i++)
        if (strcasecmp(dot, pictures[i]) == 0)
            return cmd_usage_error(s,
                                   "-o %s: a page or a folder is written; -o FOLDER --figures %s "
                                   "puts the pictures there, --figure NAME one of them",
                                   output, pictures[i] + 1);
    if (!cmd_require_text_output(s, false))
        return false;
    if (figure != NULL && (output == NULL || own->methods))
        return cmd_usage_error(s, "--figure is of the page: -o NAME.html or a folder");
    return true;
}

static bool is_inside_folder(const char *path, const char *folder)
{
    size_t n = folder != NULL ? strlen(folder) : 0;
    while (n > 1 && folder[n - 1] == '/')
        n--;
    return n > 0 && strncmp(path, folder, n) == 0 && path[n] == '/';
}

/* Checks that all outputs can be written, before the first one is. */
static wt_status check_output_paths(cmd_session *s, const wt_report_options *options,
                                    const report_outputs *own)
{
    const char *const output = s->common.output, *const curves[] = {own->browse, own->sheets};
    wt_status status = WT_OK;
    if (output != NULL && (own->browse != NULL || own->sheets != NULL))
        status = wt_report_check(output, options, &s->err);
    for (size_t i = 0; status == WT_OK && i < COUNT_OF(curves); i++)
        if (curves[i] != NULL &&
            !is_inside_folder(curves[i], output)) /* that folder is created first */
            status = cmd_check_output(curves[i], &s->err);
    if (status == WT_OK && (own->browse != NULL || own->sheets != NULL))
        status = wt_report_check_curves(s->result, &s->err);
    return status;
}

/* ---- the page -------------------------------------------------------------------------------- */

/* Writes the requested outputs: page or folder, curve browser, curve sheets. */
static wt_status write_pages(cmd_session *s, const wt_report_options *options,
                             const report_outputs *own)
{
    wt_status status = check_output_paths(s, options, own);
    if (status != WT_OK)
        return status;
    if (s->common.output != NULL || own->sheets != NULL)
        cmd_check_font(s, options->font);
    const wt_progress progress = cmd_progress_start(s);
    cmd_catch_interruptions();
    if (s->common.output != NULL)
        status = wt_report_write(s->result, s->common.output, options, &progress, &s->err);
    if (status == WT_OK && own->browse != NULL)
        status = wt_curve_browser_write(s->result, own->browse, s->common.provenance, &s->err);
    if (status == WT_OK && own->sheets != NULL)
        status = wt_curve_sheets_write(s->result, own->sheets, options, &progress, &s->err);
    cmd_progress_end(s);
    return status;
}

int cmd_report(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "report",
        .arguments = "RESULT -o PLACE|--browse FILE.html|--sheets FILE.pdf|--methods [OPTION]...",
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
    report_outputs own = {0};
    cmd_option_group parts[] = {{report_path_params(), &s.common, NULL, 0},
                                {report_output_params(), &own, NULL, 0},
                                {wt_report_params(), &report_options, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv))
        return cmd_session_free(&s);
    const bool curves = own.browse != NULL || own.sheets != NULL;
    if (s.common.output == NULL && !own.methods && !curves) {
        (void)cmd_usage_error(&s, "-o is required: NAME.html or a folder; or --browse FILE.html or "
                                  "--sheets FILE.pdf");
        return cmd_session_free(&s);
    }
    if (own.methods && curves) {
        (void)cmd_usage_error(&s, "--methods is a call of its own");
        return cmd_session_free(&s);
    }
    if (!check_output_names(&s, &own) || !check_page_name(&s, &own, report_options.figure) ||
        !check_figure_name(&s, report_options.figure))
        return cmd_session_free(&s);
    report_options.with_provenance = s.common.provenance;
    wt_status status = cmd_tables_read(s.files[0], &s.result, &s.err);
    if (status == WT_OK)
        status = own.methods ? write_methods(&s) : write_pages(&s, &report_options, &own);
    if ((status == WT_E_MISSING || status == WT_E_UNIT) && s.err.file[0] == '\0')
        wt_error_file(&s.err, s.files[0]); // a table of it is incomplete
    if (status != WT_OK)
        cmd_fail(&s);
    else
        cmd_apply_strict(&s, s.files[0], cmd_count_remarks(s.result));
    if (status == WT_OK && !s.common.quiet && !own.methods && s.common.output != NULL)
        cmd_print_page_location(s.common.output);
    if (status == WT_OK && !s.common.quiet && own.browse != NULL)
        cmd_message("page of curves: %s\n", own.browse);
    if (status == WT_OK && !s.common.quiet && own.sheets != NULL)
        cmd_message("sheets of curves: %s\n", own.sheets);
    return cmd_session_free(&s);
}
