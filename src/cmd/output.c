/* Writes tables to files and standard output. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "cmd/cmd.h"

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
