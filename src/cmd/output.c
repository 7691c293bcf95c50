/* Output: destination and form of a result, and its short table on a terminal.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/cmd.h"

#include <math.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static bool ends_with(const char *text, const char *end)
{
    const size_t n = strlen(text), m = strlen(end);
    return n >= m && strcmp(text + n - m, end) == 0;
}

bool cmd_is_hdf5_path(const char *path)
{
    return path != NULL && (ends_with(path, ".h5") || ends_with(path, ".hdf5"));
}

bool cmd_is_standard_stream(const char *path)
{
    return path == NULL || strcmp(path, "-") == 0;
}

bool cmd_require_text_output(cmd_session *s, bool has_table)
{
    const char *const output = s->common.output;
    if (cmd_is_hdf5_path(output))
        return cmd_usage_error(s, "-o %s: weartrack %s writes text and no HDF5; give another name",
                               output, s->name);
    return has_table || export_form_of_suffix(output, WT_EXPORT_STREAM) == WT_EXPORT_STREAM ||
           cmd_usage_error(s, "-o %s: this is no table; give another name", output);
}

wt_status cmd_check_output(const char *path, wt_error *err)
{
    struct stat info;
    if (cmd_is_standard_stream(path) ||
        (stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode)))
        return WT_OK; /* a pipe can be opened only once */
    wt_atomic_file *file = NULL;
    const wt_status status = wt_outfile_open(path, &file, err);
    wt_outfile_discard(file);
    wt_error_file(status != WT_OK ? err : NULL, path);
    return status;
}

char *cmd_default_name(const char *path, const char *ending)
{
    const char *base = wt_path_base(path);
    const char *dot = strrchr(base, '.');
    const int stem = (int)(dot != NULL && dot != base ? (size_t)(dot - base) : strlen(base));
    char *name = NULL;
    if (asprintf(&name, "%.*s%s", stem, base, ending) < 0)
        cmd_exit_without_memory(strlen(path));
    return name;
}

static wt_status write_stream(FILE *out, const wt_result *result, bool with_provenance,
                              wt_error *err)
{
    const wt_provenance *provenance = with_provenance ? wt_result_provenance_const(result) : NULL;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < wt_result_n_tables(result); i++)
        status = wt_stream_write(out, wt_result_table(result, i), i == 0 ? provenance : NULL, err);
    return status;
}

wt_status cmd_sink_open(const char *output, cmd_sink *sink, wt_error *err)
{
    const bool to_file = !cmd_is_standard_stream(output);
    *sink = (cmd_sink){NULL, stdout, to_file ? output : "standard output", NULL};
    wt_status status = to_file ? wt_outfile_open(output, &sink->file, err) : WT_OK;
    if (sink->file != NULL)
        sink->stream = wt_outfile_stream(sink->file);
    return status;
}

wt_status cmd_sink_close(cmd_sink *sink, wt_status written, wt_error *err)
{
    wt_atomic_file *file = sink->file;
    sink->file = NULL;
    if (sink->screen != NULL)
        (void)fclose(sink->screen);
    sink->screen = NULL;
    if (written != WT_OK)
        wt_outfile_discard(file);
    else if (file != NULL)
        written = wt_outfile_commit(file, err);
    wt_error_file(written != WT_OK ? err : NULL, sink->name);
    return written;
}

/* The command line as the user typed it. */
static int full_argc;
static char **full_argv;

void cmd_set_command_line(int argc, char **argv)
{
    full_argc = argc;
    full_argv = argv;
}

void cmd_record_command(wt_provenance *provenance)
{
    wt_provenance_set_command(provenance, full_argc, full_argv);
}

/* Adds the table "methods" to a stored result. A stream does not need it. */
static wt_status add_methods(wt_result *result, wt_error *err)
{
    wt_table *methods = NULL;
    if (wt_result_find(result, "methods") != NULL)
        return WT_OK;
    const wt_status status = wt_methods_table(result, &methods, err);
    if (status != WT_OK || wt_table_n_rows(methods) == 0) {
        wt_table_free(methods);
        return status;
    }
    return wt_result_add(result, methods, err);
}

/* Writes all tables as one array of JSON. */
static wt_status write_json_tables(FILE *out, const wt_result *result, wt_error *err)
{
    wt_status status = WT_OK;
    const size_t n = wt_result_n_tables(result);
    fputs("[", out);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        fputs(i > 0 ? ",\n" : "", out);
        status = wt_table_export(out, wt_result_table(result, i), WT_EXPORT_JSON, false, err);
    }
    fputs("]\n", out);
    return status;
}

/* A CSV file has one table. A message says that there are others. */
static wt_status write_first_table(cmd_session *s, FILE *out)
{
    const size_t n = wt_result_n_tables(s->result);
    if (n == 0)
        return wt_fail(&s->err, WT_E_EMPTY, "the result has no table");
    const wt_table *first = s->main_table != NULL ? wt_result_find(s->result, s->main_table) : NULL;
    if (first == NULL)
        first = wt_result_table(s->result, 0);
    if (n > 1 && !s->common.quiet)
        cmd_message("weartrack %s: note: %s has the table %s only, of %zu; -o NAME.h5 or NAME.json "
                    "has all of them\n",
                    s->name, s->common.output, wt_table_name(first), n);
    return wt_table_export(out, first, WT_EXPORT_CSV, false, &s->err);
}

wt_export_form export_form_of_suffix(const char *output, wt_export_form otherwise)
{
    static const struct {
        const char *ending;
        wt_export_form form;
    } known[] = {{".csv", WT_EXPORT_CSV}, {".tsv", WT_EXPORT_TSV}, {".json", WT_EXPORT_JSON}};
    const char *dot = output != NULL ? strrchr(output, '.') : NULL;
    for (size_t i = 0; dot != NULL && i < COUNT_OF(known); i++)
        if (strcasecmp(dot, known[i].ending) == 0)
            return known[i].form;
    return otherwise;
}

wt_status cmd_write_result(cmd_session *s)
{
    const char *output = s->common.output;
    cmd_record_command(wt_result_provenance(s->result));
    if (cmd_is_hdf5_path(output)) {
        const wt_status added = add_methods(s->result, &s->err);
        return added == WT_OK ? wt_store_write(output, s->result, s->common.provenance, &s->err)
                              : added;
    }
    cmd_sink sink;
    wt_status status = cmd_sink_open(output, &sink, &s->err);
    const wt_export_form form = export_form_of_suffix(output, WT_EXPORT_STREAM);
    if (status == WT_OK)
        cmd_show_first_lines(s, &sink);
    if (status == WT_OK && form == WT_EXPORT_JSON)
        status = write_json_tables(sink.stream, s->result, &s->err);
    else if (status == WT_OK && form == WT_EXPORT_CSV)
        status = write_first_table(s, sink.stream);
    else if (status == WT_OK)
        status = write_stream(sink.stream, s->result, s->common.provenance, &s->err);
    return cmd_sink_close(&sink, status, &s->err);
}

/* ---- short table ----------------------------------------------------------------------------- */

enum { INDENT = 2, NOTE_INDENT = 6, GAP = 3, NAME_MAX_WIDTH = 34, ROWS_SHOWN = 13 };

typedef enum table_column {
    COLUMN_NAME,
    COLUMN_VALUE,
    COLUMN_INTERVAL,
    COLUMN_RANGE,
    COLUMN_NOTE,
    N_COLUMNS
} table_column;

typedef struct short_table {
    const wt_result_rows *rows;
    size_t n_shown;
    size_t width[N_COLUMNS]; /* 0: the column is empty */
    size_t n_notes;          /* number of lines for notes below their rows */
    bool notes_below;        /* notes that are too long for their column stand below their rows */
    bool brief;              /* reasons are not printed: a missing answer has its reason as note */
    FILE *out;
} short_table;

static wt_result_row get_row(const short_table *t, size_t i)
{
    wt_result_row row = wt_result_rows_get(t->rows, i);
    if (t->brief && row.missing && row.reasons[0].text != NULL)
        row.note = row.reasons[0].text;
    return row;
}

static bool has_rows(const cmd_session *s)
{
    if (s->result == NULL)
        return false;
    wt_result_rows *rows = wt_result_rows_new(s->result, false);
    const bool some = wt_result_rows_count(rows) > 0;
    wt_result_rows_free(rows);
    return some;
}

bool cmd_shows_short_table(const cmd_session *s)
{
    return s->common.output == NULL && isatty(STDOUT_FILENO) && has_rows(s);
}

static const char *cell_text(const wt_result_row *row, table_column column)
{
    switch (column) {
    case COLUMN_NAME:
        return row->name;
    case COLUMN_VALUE:
        return row->text;
    case COLUMN_INTERVAL:
        return row->interval;
    case COLUMN_RANGE:
        return row->range;
    default:
        return row->note;
    }
}

/* A row with a name only, such as an option to copy, takes the whole line. */
static bool is_whole_line(const wt_result_row *row)
{
    return *row->text == '\0' && *row->interval == '\0' && *row->note == '\0';
}

static size_t cell_width(const wt_result_row *row, table_column column)
{
    const char *text = cell_text(row, column);
    const size_t level = column == COLUMN_NAME ? 2 * (size_t)row->level : 0;
    return cmd_text_width(text, strlen(text)) + (*text != '\0' ? level : 0);
}

static bool has_long_note(const short_table *t, const wt_result_row *row)
{
    return !is_whole_line(row) && cell_width(row, COLUMN_NOTE) > t->width[COLUMN_NOTE];
}

static void measure_columns(short_table *t, bool cut)
{
    static const size_t least[N_COLUMNS] = {8, 5, 4, 13, 4}; /* of the headings */
    for (size_t i = 0; i < t->n_shown; i++) {
        const wt_result_row row = get_row(t, i);
        for (int c = 0; c < N_COLUMNS && !is_whole_line(&row); c++) {
            const size_t width = cell_width(&row, (table_column)c);
            const size_t limited =
                c == COLUMN_NAME && width > NAME_MAX_WIDTH ? NAME_MAX_WIDTH : width;
            if (limited > t->width[c])
                t->width[c] = limited < least[c] ? least[c] : limited;
        }
    }
    size_t used = INDENT;
    for (int c = 0; c < COLUMN_NOTE; c++)
        used += t->width[c] > 0 ? t->width[c] + GAP : 0;
    if (!cut || used + t->width[COLUMN_NOTE] <= CMD_SCREEN_WIDTH)
        return;
    t->width[COLUMN_NOTE] =
        used + least[COLUMN_NOTE] < CMD_SCREEN_WIDTH ? CMD_SCREEN_WIDTH - used : 0;
    bool all_long = true;
    for (size_t i = 0; i < t->n_shown; i++) {
        const wt_result_row row = get_row(t, i);
        if (has_long_note(t, &row))
            t->n_notes += 1 + cell_width(&row, COLUMN_NOTE) / (CMD_SCREEN_WIDTH - NOTE_INDENT);
        else
            all_long = all_long && *row.note == '\0';
    }
    t->notes_below = t->n_shown + t->n_notes <= ROWS_SHOWN;
    if (!t->notes_below)
        t->n_notes = 0;
    else if (all_long)
        t->width[COLUMN_NOTE] = 0;
}

/* Prints a cell, cut to its width; returns the number of characters. */
static size_t print_cell(FILE *out, const char *text, size_t width)
{
    const size_t length = strlen(text);
    const bool cut = width > 3 && cmd_text_width(text, length) > width;
    const size_t n = cut ? cmd_text_fit(text, length, width - 3) : length;
    size_t used = cmd_text_width(text, n);
    cmd_print_safely(out, text, n);
    if (n < length)
        used += (size_t)fprintf(out, "...");
    return used;
}

static void print_cells(const short_table *t, int level, const char *const cells[N_COLUMNS])
{
    size_t pending = INDENT + 2 * (size_t)level; /* blanks before the next text */
    for (int c = 0; c < N_COLUMNS; c++) {
        if (t->width[c] == 0)
            continue;
        const size_t indented = c == COLUMN_NAME ? 2 * (size_t)level : 0;
        size_t used = 0;
        if (cells[c][0] != '\0') {
            fprintf(t->out, "%*s", (int)pending, "");
            used = print_cell(t->out, cells[c], t->width[c] - indented);
            pending = 0;
        }
        pending += t->width[c] - indented > used ? t->width[c] - indented - used : 0;
        pending += GAP;
    }
    fputc('\n', t->out);
}

static void print_rows(const short_table *t)
{
    static const char *const headings[N_COLUMNS] = {"quantity", "value", "95 %", "model choices",
                                                    "note"};
    print_cells(t, 0, headings);
    for (size_t i = 0; i < t->n_shown; i++) {
        const wt_result_row row = get_row(t, i);
        const char *cells[N_COLUMNS];
        for (int c = 0; c < N_COLUMNS; c++)
            cells[c] = cell_text(&row, (table_column)c);
        if (is_whole_line(&row)) {
            fprintf(t->out, "%*s", INDENT, "");
            cmd_print_safely(t->out, row.name, strlen(row.name));
            fputc('\n', t->out);
        } else if (t->notes_below && has_long_note(t, &row)) {
            cells[COLUMN_NOTE] = "";
            print_cells(t, row.level, cells);
            fprintf(t->out, "%*s", NOTE_INDENT, "");
            cmd_wrap(t->out, NOTE_INDENT, NOTE_INDENT, row.note);
        } else {
            print_cells(t, row.level, cells);
        }
    }
}

/* Prints the reasons, one paragraph each; equal ones once. */
static void print_reasons(const short_table *t)
{
    for (size_t i = 0; i < t->n_shown; i++) {
        const wt_result_row row = wt_result_rows_get(t->rows, i);
        for (size_t k = 0; k < WT_RESULT_ROW_REASONS && row.reasons[k].text != NULL; k++) {
            bool repeated = false;
            for (size_t j = 0; j < i && !repeated; j++) {
                const wt_result_row before = wt_result_rows_get(t->rows, j);
                for (size_t m = 0; m < WT_RESULT_ROW_REASONS; m++)
                    repeated =
                        repeated || wt_text_repeats(row.reasons[k].text, before.reasons[m].text);
            }
            if (repeated)
                continue;
            fprintf(t->out, "\n  %s, %s: ", row.name, row.reasons[k].heading);
            cmd_wrap(t->out, strlen(row.name) + strlen(row.reasons[k].heading) + INDENT + 4, 4,
                     row.reasons[k].text);
        }
    }
}

static void print_heading(const cmd_session *s, FILE *out, const wt_result_rows *rows)
{
    const char *heading = wt_result_rows_heading(rows);
    const wt_provenance *provenance = wt_result_provenance_const(s->result);
    const size_t n = wt_provenance_n_inputs(provenance);
    fprintf(out, "%s: ", s->name);
    if (*heading != '\0')
        print_cell(out, heading, CMD_SCREEN_WIDTH - strlen(s->name) - 2);
    else if (n > 0 || s->n_files == 0)
        fprintf(out, "%zu file%s", n, n == 1 ? "" : "s");
    else /* a text stream does not list its inputs */
        print_cell(out, wt_path_base(s->files[0]), CMD_SCREEN_WIDTH - strlen(s->name) - 2);
    fputs("\n\n", out);
}

void cmd_print_place_of_rest(const cmd_session *s)
{
    const char *output = s->common.output;
    if (s->common.quiet || cmd_log_is_json() || !has_rows(s))
        return;
    if (cmd_shows_short_table(s))
        printf("tables   -o FILE, or -o - to print them; --verbose has the reasons\n");
    else if (cmd_is_hdf5_path(output))
        cmd_message("result   %s (weartrack report draws it)\n", output);
    else if (!cmd_is_standard_stream(output))
        cmd_message("tables   %s\n", output);
}

static void log_rows(const wt_result_rows *rows)
{
    for (size_t i = 0; i < wt_result_rows_count(rows); i++) {
        const wt_result_row row = wt_result_rows_get(rows, i);
        cmd_log_row(&row);
    }
}

void cmd_print_short_table(cmd_session *s, bool findings)
{
    if ((s->common.quiet && !findings) || s->result == NULL)
        return;
    wt_result_rows *rows = wt_result_rows_new(s->result, findings);
    const size_t n = wt_result_rows_count(rows);
    const bool on_screen = findings || cmd_shows_short_table(s);
    short_table t = {.rows = rows, .n_shown = n, .brief = !s->common.verbose};
    if (cmd_log_is_json())
        log_rows(rows);
    if (n > 0 && (on_screen || !cmd_log_is_json())) {
        if (!s->common.verbose && n > ROWS_SHOWN + 1)
            t.n_shown = ROWS_SHOWN;
        t.out = on_screen ? stdout : stderr;
        cmd_erase_progress();
        measure_columns(&t, !s->common.verbose && isatty(fileno(t.out)));
        print_heading(s, t.out, rows);
        print_rows(&t);
        if (s->common.verbose)
            print_reasons(&t);
        if (n > t.n_shown)
            fprintf(t.out, "  and %zu more rows: --verbose\n", n - t.n_shown);
        fputc('\n', t.out);
        enum { AROUND = 4 }; /* heading, headings of the columns, empty lines */
        const size_t used = AROUND + t.n_shown + t.n_notes + (n > t.n_shown);
        s->lines_left -= used < s->lines_left ? used : s->lines_left;
        fflush(t.out);
    }
    wt_result_rows_free(rows);
}
