/* weartrack info, convert and formats: what an instrument file has, and in which format.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/file_kind.h"

#include "core/base/array.h"
#include "core/table/registry.h"

#include <string.h>

/* ---- info ------------------------------------------------------------------------------------ */

/* What a terminal shows: rows of the only file, or files, one line each. */
enum { ROWS_SHOWN = 12, FILES_SHOWN = 14 };

/* Prints the name of one of several files with its format. */
static void print_format(const char *name, const wt_table *metadata)
{
    const char *format = "";
    for (size_t row = 0; row < wt_table_n_rows(metadata) && *format == '\0'; row++)
        if ((fact_item)wt_table_number(metadata, row, FACTS_KIND) == FACT_FORMAT)
            format = wt_table_text(metadata, row, FACTS_VALUE);
    printf("%s  %s\n", name, format);
}

/* Prints the first `limit` rows. If there are more, each takes one line. */
static void print_metadata(const char *name, const wt_table *metadata, size_t limit)
{
    enum { MAX_LABEL = 42, DOTS = 3 };
    size_t n_shown = 0;
    const bool brief = limit < wt_table_n_rows(metadata);
    size_t width = 0;
    for (size_t row = 0; row < wt_table_n_rows(metadata); row++) {
        const char *label = wt_table_text(metadata, row, FACTS_ITEM);
        const size_t w = cmd_text_width(label, strlen(label));
        width = w > width && w <= MAX_LABEL ? w : width;
    }
    printf("%s\n", name);
    for (size_t row = 0; row < wt_table_n_rows(metadata); row++) {
        const char *label = wt_table_text(metadata, row, FACTS_ITEM);
        const char *s = wt_table_text(metadata, row, FACTS_SOURCE);
        const char *v = wt_table_text(metadata, row, FACTS_VALUE);
        if (row == 0 && strcmp(v, name) == 0)
            continue; /* the heading has it */
        if (n_shown++ >= limit)
            continue;
        char shown[1024], line[2048];
        format_metadata_value(v, wt_table_text(metadata, row, FACTS_UNIT), shown, sizeof shown);
        snprintf(line, sizeof line, *s != '\0' ? "%s  (%s)" : "%s%s", shown, s);
        const size_t w = cmd_text_width(label, strlen(label));
        printf("  %s%*s  ", label, w < width ? (int)(width - w) : 0, "");
        const size_t column = 4 + (w > width ? w : width);
        const size_t length = strlen(line);
        if (brief && column + cmd_text_width(line, length) > CMD_SCREEN_WIDTH) {
            const size_t room =
                column + DOTS < CMD_SCREEN_WIDTH ? CMD_SCREEN_WIDTH - DOTS - column : 0;
            const size_t n = cmd_text_fit(line, length, room);
            snprintf(line + n, sizeof line - n, "...");
        }
        cmd_wrap(stdout, column, width + 4, line);
    }
    if (n_shown > limit)
        printf("  and %zu more rows: --verbose\n", n_shown - limit);
}

static void print_file(const cmd_session *s, size_t i, const wt_table *metadata)
{
    const char *const path = s->files[i];
    if (!cmd_shows_first_lines(s))
        print_metadata(path, metadata, SIZE_MAX);
    else if (s->n_files == 1)
        print_metadata(path, metadata, ROWS_SHOWN);
    else if (i < FILES_SHOWN)
        print_format(path, metadata);
}

/* Prints one file; true if its format is known. */
static bool print_file_info(cmd_session *s, size_t i, const wt_read_options *options,
                            file_kind *found)
{
    wt_table *metadata = NULL;
    wt_log *log = wt_log_new();
    const wt_status status = file_kind_detect(s, s->files[i], options, log, &metadata, found);
    if (status == WT_OK)
        print_file(s, i, metadata);
    /* Notes are shown, too, as the user wants all remarks on the file. */
    cmd_print_log(s, log, true);
    if (status != WT_OK)
        cmd_report_failure(s);
    wt_table_free(metadata);
    wt_log_free(log);
    return status == WT_OK;
}

/* Prints the options that the user must supply. Missing units of columns are not guessed. */
static void print_missing_options(const file_kind *found)
{
    const char *name = found->unitless;
    for (size_t k = 0; k < FILE_KIND_N_MISSING; k++)
        if (file_kind_is_missing(found, k))
            printf(" --%s %s", file_kind_missing_rows[k].name, file_kind_missing_rows[k].example);
    if (found->has_torque)
        fputs(" --track-radius 10mm", stdout);
    for (size_t n = 0; *name != '\0'; name += n + 1) {
        char given[sizeof found->unitless + sizeof "=UNIT"];
        n = strcspn(name, "\n");
        snprintf(given, sizeof given, "%.*s=UNIT", (int)n, name);
        fputs(" --units", stdout);
        cmd_print_argument(stdout, given);
    }
}

/* True if `word` is an option of reading that the suggested subcommand takes as well. */
static bool is_taken_by(const char *subcommand, const char *word)
{
#define OF_SWEEPS                                                                                  \
    " columns conditioning deformation format formats frequency sample sample-by sheet units "
    static const struct {
        const char *subcommand, *options; /* names between blanks */
    } taken[] = {
        {"convert", OF_SWEEPS " height-unit pixel-size sensitivity spectrum-convention "
                              "spring-constant strain temperature temperature-in-name "},
        {"indent --tip",
         " columns conditioning format formats sensitivity sheet spring-constant units "},
        {"master", OF_SWEEPS " strain temperature temperature-in-name "},
        {"new-case", " formats "},
        {"psd", " columns conditioning format formats height-unit pixel-size sheet units "},
        {"payne", OF_SWEEPS " temperature temperature-in-name "},
        {"ramp", OF_SWEEPS " strain temperature-in-name "},
        {"record", " columns conditioning format formats sheet units "},
    };
#undef OF_SWEEPS
    char name[64];
    snprintf(name, sizeof name, " %.*s ", (int)strcspn(word, "="), word);
    for (size_t i = 0; i < COUNT_OF(taken); i++)
        if (strcmp(subcommand, taken[i].subcommand) == 0)
            return strstr(taken[i].options, name) != NULL;
    return false;
}

/* Prints the options without which the suggested subcommand would not read what this call reads. */
static void print_given_options(int argc, char **argv, const char *subcommand)
{
    for (int i = 1; i < argc; i++) {
        if (strncmp(argv[i], "--", 2) != 0 || !is_taken_by(subcommand, argv[i] + 2))
            continue;
        cmd_print_argument(stdout, argv[i]);
        if (strchr(argv[i], '=') == NULL && i + 1 < argc)
            cmd_print_argument(stdout, argv[++i]);
    }
}

/* Prints a suggestion for the next command, for the only file or for all. */
static void print_next_command(const cmd_session *s, int argc, char **argv, const file_kind *found)
{
    const char *const *files = s->files;
    if (found->nothing)
        return;
    if (s->n_files > 1) {
        fputs("\nnext: weartrack new-case", stdout);
        print_given_options(argc, argv, "new-case");
        for (size_t i = 0; i < s->n_files; i++)
            cmd_print_argument(stdout, files[i]);
        fputs(" -o case.xml\n", stdout);
        return;
    }
    const bool is_map = found->kind == WT_KIND_IMAGE && !found->one_row &&
                        (found->has_y || !found->has_x); /* a profile may be across a track */
    const char *const next = found->is_result               ? "table --list"
                             : found->kind == WT_KIND_FORCE ? "indent --tip"
                             : found->next != NULL          ? found->next
                             : found->kind == WT_KIND_SWEEP ? "master"
                             : is_map                       ? "psd"
                                                            : "convert";
    printf("\nnext: weartrack %s", next);
    if (!found->is_result && found->kind == WT_KIND_FORCE)
        cmd_print_argument(stdout, *found->tip != '\0' ? found->tip
                                                       : "pyramid:half-angle=35deg,radius=20nm");
    print_given_options(argc, argv, next);
    print_missing_options(found);
    cmd_print_argument(stdout, files[0]);
    char *output = found->is_result
                       ? NULL
                       : cmd_default_name(files[0], cmd_is_hdf5_path(files[0])
                                                        ? "-result.h5" /* not the input itself */
                                                        : ".h5");
    if (output != NULL) {
        fputs(" -o", stdout);
        cmd_print_argument(stdout, output);
    }
    free(output);
    putchar('\n');
    if (*found->unitless != '\0')
        puts("      with, for each UNIT, the one that the instrument exports, such as mm");
}

int cmd_info(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "info",
        .arguments = "[OPTION]... FILE...",
        .description = "Reports for each file its format, segments, channels and calibration, and "
                       "what is missing or unexpected. - is standard input.",
        .common = "formats columns files-from",
        .n_files = CMD_ONE_OR_MORE};
    wt_read_options read = wt_read_defaults();
    cmd_option_group part = {wt_read_params(), &read, NULL, 0};
    cmd_session s = cmd_session_defaults();
    size_t n_known = 0, n_found = 0;
    file_kind found;
    if (!cmd_parse(&s, &usage, &part, 1, argc, argv) || !cmd_begin_reading(&s, read.format))
        return cmd_session_free(&s);
    for (size_t i = 0; i < s.n_files; i++) {
        if (i > 0 && !cmd_shows_first_lines(&s))
            putchar('\n');
        n_known += print_file_info(&s, i, &read, &found);
        n_found += found.description[0] != '\0';
    }
    if (s.n_files > FILES_SHOWN && cmd_shows_first_lines(&s))
        printf("and %zu more files: --verbose\n", s.n_files - FILES_SHOWN);
    if (n_known == 0)
        s.status = CMD_FAILED;
    if (n_found == s.n_files)
        print_next_command(&s, argc, argv, &found);
    return cmd_session_free(&s);
}

/* ---- convert --------------------------------------------------------------------------------- */

/* Destination of the tables. A text stream receives them as they come, so that memory hardly grows
 * with a map; for the HDF5 store they are collected. */
typedef struct destination {
    cmd_session *session;
    cmd_sink sink; /* its stream is NULL before the first table */
} destination;

static wt_status write_converted_table(void *user, wt_table *table, wt_error *err)
{
    destination *d = user;
    const cmd_common_options *common = &d->session->common;
    if (cmd_is_hdf5_path(common->output))
        return wt_result_add(d->session->result, table, err);
    const wt_provenance *provenance = wt_result_provenance_const(d->session->result);
    const bool is_first = d->sink.stream == NULL;
    wt_status status = is_first ? cmd_sink_open(common->output, &d->sink, err) : WT_OK;
    if (is_first && status == WT_OK)
        cmd_show_first_lines(d->session, &d->sink);
    if (status == WT_OK)
        status = wt_stream_write(d->sink.stream, table,
                                 is_first && common->provenance ? provenance : NULL, err);
    wt_error_file(status != WT_OK ? err : NULL, d->sink.name);
    wt_table_free(table);
    return status;
}

int cmd_convert(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "convert",
        .arguments = "[OPTION]... FILE",
        .description =
            "Writes an instrument file as a text stream (weartrack-stream(5)), or as HDF5 if "
            "the name after -o ends in .h5 or .hdf5, in SI units. - is standard input.",
        .common = "output formats columns provenance",
        .one_by_one = true,
        .n_files = 1,
        .files = "one file is needed"};
    wt_convert_job job = wt_convert_job_defaults();
    cmd_option_group group = {wt_convert_job_params(), &job, NULL, 0};
    cmd_session s = cmd_session_defaults();
    destination d = {.session = &s};
    if (cmd_parse(&s, &usage, &group, 1, argc, argv) && cmd_begin_reading(&s, job.read.format)) {
        cmd_record_command(wt_result_provenance(s.result));
        wt_status status =
            wt_convert_file(&job, s.files[0], &s.work, write_converted_table, &d, &s.err);
        if (status == WT_OK)
            status = cmd_write_record(&s, write_converted_table, &d);
        if (d.sink.stream != NULL)
            status = cmd_sink_close(&d.sink, status, &s.err);
        else if (status == WT_OK)
            status = cmd_write_result(&s);
        cmd_end(&s, status);
    }
    return cmd_session_free(&s);
}

/* ---- formats --------------------------------------------------------------------------------- */

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
