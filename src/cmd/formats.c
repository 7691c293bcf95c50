/* weartrack formats: list, show, check. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/cmd.h"

static const struct {
    unsigned bit;
    const char *word;
} kinds[] = {{WT_KIND_FORCE, "force curves"},
             {WT_KIND_SWEEP, "DMA sweeps"},
             {WT_KIND_IMAGE, "images"},
             {WT_KIND_SPECTRUM, "spectra"},
             {WT_KIND_RECORD, "records of friction"}};

/* Lists the names of the formats by what they hold. */
static void list_format_names(const wt_formats *formats, FILE *out)
{
    enum { NAMES_COLUMN = 21, GAP = 2 };
    for (size_t k = 0; k < COUNT_OF(kinds); k++) {
        int column = fprintf(out, "%-*s", NAMES_COLUMN, kinds[k].word);
        for (size_t i = 0; i < wt_formats_count(formats); i++) {
            const wt_format_info *f = wt_formats_get(formats, i);
            if (!(f->kinds & kinds[k].bit))
                continue;
            const bool first = column == NAMES_COLUMN;
            if (!first && column + GAP + (int)strlen(f->id) > CMD_SCREEN_WIDTH)
                column = fprintf(out, "\n%*s%s", NAMES_COLUMN, "", f->id) - 1;
            else
                column += fprintf(out, "%*s%s", first ? 0 : GAP, "", f->id);
        }
        fputc('\n', out);
    }
    fputs("\ndetails: --verbose, or weartrack formats show NAME\n", out);
}

enum { KINDS_SIZE = 120 };

/* Joins the names of what a format holds by commas. */
static void join_kinds(const wt_format_info *f, char holds[KINDS_SIZE])
{
    size_t used = 0;
    holds[0] = '\0';
    for (size_t k = 0; k < COUNT_OF(kinds); k++)
        if (f->kinds & kinds[k].bit)
            used += (size_t)snprintf(holds + used, KINDS_SIZE - used, "%s%s", used > 0 ? ", " : "",
                                     kinds[k].word);
}

/* Writes the list as a table in the form that the name after -o asks for. */
static wt_status export_formats(cmd_session *s, FILE *out, wt_export_form form)
{
    static const char *const columns[][2] = {{"format", "identifier of the format"},
                                             {"holds", "kinds of data"},
                                             {"verified", "yes: checked on a measured file"},
                                             {"title", "description of the format"},
                                             {"evidence", "source of the description"}};
    wt_table *const table = wt_table_new("formats", "Formats that are read");
    wt_status status = WT_OK;
    for (size_t i = 0; i < COUNT_OF(columns) && status == WT_OK; i++)
        status = wt_table_add_text_column(table, columns[i][0], columns[i][1], &s->err);
    for (size_t i = 0; i < wt_formats_count(s->formats) && status == WT_OK; i++) {
        const wt_format_info *f = wt_formats_get(s->formats, i);
        char holds[KINDS_SIZE];
        join_kinds(f, holds);
        const char *const cells[] = {f->id, holds, f->verified ? "yes" : "no", f->title,
                                     f->evidence != NULL ? f->evidence : ""};
        status = wt_table_add_row(table, &s->err);
        for (size_t k = 0; k < COUNT_OF(cells) && status == WT_OK; k++)
            wt_table_set_text(table, k, cells[k]);
    }
    if (status == WT_OK)
        status = wt_table_export(out, table, form, false, &s->err);
    wt_table_free(table);
    return status;
}

static void list_formats(const wt_formats *formats, FILE *out)
{
    for (size_t i = 0; i < wt_formats_count(formats); i++) {
        const wt_format_info *f = wt_formats_get(formats, i);
        char holds[KINDS_SIZE];
        join_kinds(f, holds);
        enum { INDENT = 6 };
        fprintf(out, "%s%-18s %-22s %s\n%*s", i > 0 ? "\n" : "", f->id, holds,
                f->verified ? "verified" : "not verified on a measured file", INDENT, "");
        cmd_wrap(out, INDENT, INDENT, f->title);
        if (f->evidence != NULL && *f->evidence != '\0') {
            fprintf(out, "%*s", INDENT, "");
            cmd_wrap(out, INDENT, INDENT, f->evidence);
        }
    }
}

static void show_format(const wt_formats *formats, const char *id, FILE *out)
{
    const wt_format_info *f = wt_formats_find(formats, id);
    const char *xml = strcmp(id, "schema") == 0 ? wt_formats_schema() : wt_formats_xml(formats, id);
    if (xml != NULL)
        fputs(xml, out);
    else
        fprintf(out, "%s: %s\nread by the program itself; there is no description to show\n", f->id,
                f->title);
}

/* Writes the description of a format, or the list of all formats for NULL. */
static void write_formats(cmd_session *s, const char *id)
{
    if (id != NULL && strcmp(id, "schema") != 0 && wt_formats_find(s->formats, id) == NULL) {
        cmd_message("weartrack formats: there is no format '%s'; see weartrack formats list\n", id);
        s->status = CMD_FAILED;
        return;
    }
    cmd_sink sink;
    wt_status status = cmd_sink_open(s->common.output, &sink, &s->err);
    const wt_export_form form = export_form_of_suffix(s->common.output, WT_EXPORT_STREAM);
    if (status == WT_OK)
        cmd_show_first_lines(s, &sink);
    if (status == WT_OK && id != NULL)
        show_format(s->formats, id, sink.stream);
    else if (status == WT_OK && form != WT_EXPORT_STREAM)
        status = export_formats(s, sink.stream, form);
    else if (status == WT_OK && cmd_shows_first_lines(s))
        list_format_names(s->formats, sink.stream);
    else if (status == WT_OK)
        list_formats(s->formats, sink.stream);
    if (cmd_sink_close(&sink, status, &s->err) != WT_OK)
        cmd_fail(s);
}

/* Checks a description and, if there is a second file, reads this sample with it. */
static void check_description(cmd_session *s, const wt_read_options *options)
{
    wt_input *input = NULL;
    wt_table *report = NULL;
    wt_status status = s->n_files > 2 ? wt_input_open(s->files[2], &input, &s->err) : WT_OK;
    if (status == WT_OK)
        status = wt_format_description_check(s->files[1], input, options, s->log, &report, &s->err);
    cmd_print_log(s, s->log, true);
    if (status == WT_OK)
        status = wt_result_add(s->result, report, &s->err);
    if (status == WT_OK)
        status = cmd_write_result(s);
    if (status != WT_OK)
        cmd_fail(s);
    wt_input_close(input);
}

int cmd_formats(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "formats",
        .arguments = "list | show ID | check DESCRIPTION.xml [SAMPLE]",
        .description = "list prints the formats that can be read, and whether each was checked on "
                       "a measured file; with -o NAME.csv, .tsv or .json it writes a table.\nshow "
                       "prints the description of one format; `show schema` "
                       "prints the schema of descriptions.\ncheck checks a description; with a "
                       "sample file it also shows which columns it reads.",
        .common = "output formats columns provenance"};
    wt_read_options read = wt_read_defaults();
    cmd_option_group part = {
        wt_read_params(), &read,
        "spring-constant sensitivity temperature frequency units sheet deformation", 0};
    cmd_session s = cmd_session_defaults();
    if (!cmd_parse(&s, &usage, &part, 1, argc, argv))
        return cmd_session_free(&s);
    const char *verb = s.n_files > 0 ? s.files[0] : "";
    const bool list = strcmp(verb, "list") == 0 && s.n_files == 1;
    const bool show = strcmp(verb, "show") == 0 && s.n_files == 2;
    const bool check = strcmp(verb, "check") == 0 && (s.n_files == 2 || s.n_files == 3);
    if (check && cmd_begin(&s))
        check_description(&s, &read);
    else if (!check && !list && !show)
        cmd_usage_error(&s, "expected list, show ID or check DESCRIPTION.xml [SAMPLE]");
    else if (!check && cmd_require_text_output(&s, list) && cmd_begin_reading(&s, NULL)) {
        cmd_print_log(&s, s.log, true);
        write_formats(&s, show ? s.files[1] : NULL);
    }
    return cmd_session_free(&s);
}
