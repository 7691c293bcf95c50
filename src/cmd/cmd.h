/* The command: table of subcommands, options, output and messages. Only this folder prints, exits
 * and parses options. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_CMD_H
#define WT_CMD_CMD_H

#include <stdlib.h>

#include "core/base/array.h"
#include "core/base/param.h"
#include "weartrack/weartrack.h"

/* Exit status: complete, nothing usable or an error, usage error, partial. */
enum {
    CMD_OK = WT_RESULT_COMPLETE,
    CMD_FAILED = WT_RESULT_EMPTY,
    CMD_USAGE = 2,
    CMD_PARTIAL = WT_RESULT_PARTIAL
};

/* A subcommand; its argv[0] is its name. */
typedef struct cmd_command {
    const char *name;
    int (*run)(int argc, char **argv); /* NULL: `name` is the heading of a group */
    const char *help;                  /* one line */
} cmd_command;
extern const cmd_command cmd_commands[]; /* ends with a NULL name */

int cmd_accuracy(int argc, char **argv);
int cmd_info(int argc, char **argv);
int cmd_convert(int argc, char **argv);
int cmd_formats(int argc, char **argv);
int cmd_indent(int argc, char **argv);
int cmd_sensitivity(int argc, char **argv);
int cmd_spot(int argc, char **argv);
int cmd_compare(int argc, char **argv);
int cmd_master(int argc, char **argv);
int cmd_ramp(int argc, char **argv);
int cmd_record(int argc, char **argv);
int cmd_payne(int argc, char **argv);
int cmd_psd(int argc, char **argv);
int cmd_friction(int argc, char **argv);
int cmd_layer(int argc, char **argv);
int cmd_new_case(int argc, char **argv);
int cmd_collect(int argc, char **argv);
int cmd_run(int argc, char **argv);
int cmd_report(int argc, char **argv);
int cmd_identify(int argc, char **argv);
int cmd_view(int argc, char **argv);
int cmd_validate(int argc, char **argv);
int cmd_table(int argc, char **argv);
int cmd_summary(int argc, char **argv);

/* Makes this process exit when memory runs out (malloc_abort.c). */
void cmd_exit_on_allocation_failure(void);
/* Ends the process with a message: an allocation of `size` bytes failed. */
_Noreturn void cmd_exit_without_memory(size_t size);

/* ---- options ------------------------------------------------------------------------------ */

/* A structure whose parameters are options of a subcommand. */
typedef struct cmd_option_group {
    const wt_params *params;
    void *structure;
    const char *only; /* names of the parameters that are options, separated by blanks; NULL: all */
    uint64_t given;
} cmd_option_group;

/* Defines a table of options that are all unset by default. */
#define CMD_OPTIONS(name, type, rows)                                                              \
    static type name##_unset(void)                                                                 \
    {                                                                                              \
        return (type){0};                                                                          \
    }                                                                                              \
    PARAM_LOCAL_TABLE(name, type, rows, name##_unset, NO_PARTS)

/* Common options. A subcommand names those that it supports. */
typedef enum cmd_log { CMD_LOG_TEXT, CMD_LOG_JSON } cmd_log;
typedef struct cmd_common_options {
    const char *output;         /* -o, NULL = standard output */
    const char *formats;        /* folder of further descriptions */
    const char *const *columns; /* columns of plain tables */
    size_t n_columns;
    const char *files_from; /* file with file names, NULL = none */
    cmd_log log;
    bool provenance, cost;
    bool quiet, verbose, strict, help;
} cmd_common_options;
cmd_common_options cmd_common_defaults(void);

typedef struct cmd_usage {
    const char *name;        /* name of the subcommand */
    const char *arguments;   /* "[OPTION]... FILE..." */
    const char *description; /* description, a few lines */
    const char *common; /* names of common options, as `only`; quiet, verbose, strict, help and log
                           are always included */
    const char *first;  /* most important options, for --help without "all"; NULL: all */
    const char *master; /* options that weartrack master documents; NULL: none */
    const char *notes;  /* text after the options; NULL if none */
    const char *next;   /* call that follows, shown on a terminal; NULL: none. CMD_NEXT_RESULT in it
                           stands for " RESULT" */
    bool exports;       /* writes tables for other programs */
    bool one_by_one;    /* writes each table when it is read: no CSV and no JSON */
    int n_files;        /* required number of files; CMD_ONE_OR_MORE: one or more; 0: any */
    const char *files;  /* message for another number: "two files are needed" */
} cmd_usage;
enum { CMD_ONE_OR_MORE = -1 };

/* ---- a call --------------------------------------------------------------------------------- */

/* Progress on stderr, shown after one second if it is a terminal. */
typedef struct cmd_progress {
    double start, shown;
    double interval; /* time between updates [s] */
    bool active;
} cmd_progress;

#define CMD_NEXT_RESULT '@' /* occurs in no call */

/* One call of a subcommand: its options and common data. */
typedef struct cmd_session {
    const char *name;
    const char *next; /* of the usage */
    cmd_common_options common;
    cmd_option_group *parts; /* [n_parts] */
    size_t n_parts;
    const char **files;          /* [n_files] arguments that are no options, followed by */
    size_t n_arguments, n_files; /* the names of files_from */
    char *names;                 /* text of files_from */
    int status;                  /* exit status */
    size_t lines_left;           /* that a terminal has room for, of CMD_SCREEN_LINES */
    wt_error err;
    wt_formats *formats;
    wt_log *log;
    wt_result *result;
    wt_cost *cost; /* NULL: not requested */
    wt_job work;   /* for the job: lists failures, adds inputs to the provenance of the result */
    cmd_progress progress;
    const char *main_table;  /* that a CSV file has; NULL: the first one */
    wt_read_options *shared; /* options for files of several kinds: each of its units must match a
                                column in one of them; NULL: none */
} cmd_session;

/* Returns a session with defaults, which may be freed. */
cmd_session cmd_session_defaults(void);
/* Parses argv. False if the call is finished: help was printed, or there was a usage error. */
bool cmd_parse(cmd_session *s, const cmd_usage *usage, cmd_option_group *parts, size_t n_parts,
               int argc, char **argv);
/* Creates log, result and job data. False on failure. */
bool cmd_begin(cmd_session *s);
/* Reads the formats with those of --formats and --columns. False on failure, such as an unknown
 * quantity. */
bool cmd_read_formats(cmd_session *s);
/* Reads the formats and begins; --format (may be NULL) must name one of them. */
bool cmd_begin_reading(cmd_session *s, const char *format);
/* Variant that stores the files of the call in the set. */
bool cmd_begin_files(cmd_session *s, wt_file_set *set);
/* Parses options and begins a subcommand with one job over the files of the call, as a stage of its
 * name; false if the call is finished. */
bool cmd_begin_job(cmd_session *s, const cmd_usage *usage, cmd_option_group *parts, size_t n_parts,
                   wt_file_set *set, int argc, char **argv);
/* Prints failures and passes the tables "failures" and "notes" to the sink, unless they are empty.
 */
wt_status cmd_write_record(cmd_session *s, wt_table_sink sink, void *user);
/* Shares reading options between files of several kinds until the end: a unit is for a column of
 * any of them. */
void cmd_share_unit_options(cmd_session *s, wt_read_options *read);
/* Prints failures, remarks and, unless `status` is WT_OK, the error. */
void cmd_end(cmd_session *s, wt_status status);
/* Variant that first writes the tables, in this order, with failures and notes, if `status` is
 * WT_OK. NULL tables are skipped. It takes ownership of all tables. */
void cmd_finish(cmd_session *s, wt_status status, wt_table **const tables[], size_t n);
/* Runs a case with the common options. The result belongs to the session; *n_failed stages or files
 * are in its table "failures". */
wt_status cmd_run_case(cmd_session *s, const wt_case *c, wt_run_options *run, size_t *n_failed);

/* Tables for which a subcommand runs the stages of a case. */
typedef struct cmd_case_tables {
    const char *tables, *main;       /* names, and the table that must be among the results */
    const char *missing, *expected;  /* parts of the error without the main table */
    const cmd_option_group *records; /* job whose records are the further files; NULL: none */
} cmd_case_tables;
/* Runs the case of the first file for these tables alone and prints its failures. */
wt_status cmd_run_case_tables(cmd_session *s, const cmd_case_tables *requested,
                              wt_run_options *run);
/* Frees the session and returns the exit status. */
int cmd_session_free(cmd_session *s);

/* True if `names`, separated by blanks, contains the name. */
bool cmd_names_contain(const char *names, const char *name);
/* True if the option was given. */
bool cmd_option_is_set(const cmd_option_group *part, const char *name);
/* Prints a usage error with a reference to the help; returns false. */
bool cmd_usage_error(cmd_session *s, const char *format, ...) WT_PRINTF(2, 3);
/* Prints a usage error for an error of the library about a parameter, whose name is its place. */
bool cmd_param_error(cmd_session *s);

/* Returns the number of characters, not bytes, as labels have degree and micro signs. */
size_t cmd_text_width(const char *text, size_t n);
/* Returns the number of bytes of the whole characters that fit into `width`. */
size_t cmd_text_fit(const char *text, size_t length, size_t width);
/* Prints the text and a line feed; the line already has `column` characters. Long lines are wrapped
 * between words with an indent of `indent` blanks. */
void cmd_wrap(FILE *out, size_t column, size_t indent, const char *text);
/* Prints a blank and one word of a call, quoted for a shell. */
void cmd_print_argument(FILE *out, const char *word);

/* ---- messages ----------------------------------------------------------------------------- */

/* Switches messages to one JSON object per line with an event: message, note, warning, loss, error,
 * failed, progress or end (messages.c). */
void cmd_log_json(const char *name);
bool cmd_log_is_json(void);
/* A member of such an object: a text, or a number if the text is NULL. */
typedef struct cmd_json_member {
    const char *name, *text;
    size_t number;
} cmd_json_member;
/* Writes an event; no effect without --log json. Empty texts are omitted. */
void cmd_log_event(const char *event, const cmd_json_member *words, size_t n);

/* Writes a row of a result as the event "row"; no effect without --log json. */
void cmd_log_row(const wt_result_row *row);

/* Prints on standard error. Control characters, such as in file names, are shown as \\x1b. Only the
 * format itself may end a line. */
void cmd_message(const char *format, ...) WT_PRINTF(1, 2);
/* Prints text with control characters and bytes that are not UTF-8 as \\x1b. */
void cmd_print_safely(FILE *out, const char *text, size_t length);
/* Removes a progress line from the terminal. */
void cmd_erase_progress(void);
/* Width and largest number of lines of what a terminal shows without --verbose, and the width of
 * the label of a remark. */
enum { CMD_SCREEN_WIDTH = 80, CMD_SCREEN_LINES = 20, CMD_LABEL_WIDTH = 9 };
/* True if remarks are printed in short: standard error is a terminal, without --verbose. */
bool cmd_is_brief(const cmd_session *s);
/* Prints the path of the page of a report. */
void cmd_print_page_location(const char *place);
/* Warns of a missing font; with --strict the call fails. */
void cmd_check_font(cmd_session *s, const char *font);
/* Prints the error as one line and sets the status to failed; returns false. */
bool cmd_fail(cmd_session *s);
/* Prints the error of one of several items; the status becomes partial. */
void cmd_report_failure(cmd_session *s);
/* Sets the status to partial. */
void cmd_set_partial(cmd_session *s);
/* Prints the remarks of a log, equal texts once, and their number; also notes if `notes`; only
 * losses for a quiet call. A loss makes the status partial; with --strict any remark makes it
 * failed. */
void cmd_print_log(cmd_session *s, const wt_log *log, bool notes);
/* Prints the failed files (table "failures", may be NULL); false if there are none. The status
 * becomes partial, or failed if the table states so. */
bool cmd_print_failures(cmd_session *s, const wt_table *failures);

wt_progress cmd_progress_start(cmd_session *s);
/* Until cmd_progress_end, an interruption (Ctrl-C) ends the work at its next step, so that
 * unfinished files are removed. */
void cmd_catch_interruptions(void);
void cmd_progress_end(cmd_session *s);

/* ---- output ------------------------------------------------------------------------------- */

/* Destination of text: the file after -o, which appears when complete, or standard output. */
typedef struct cmd_sink {
    wt_atomic_file *file;
    FILE *stream;
    const char *name; /* for errors */
    FILE *screen;     /* the same stream if it shows the first lines only, or NULL */
} cmd_sink;
wt_status cmd_sink_open(const char *output, cmd_sink *sink, wt_error *err);
/* Closes the sink; after a failure no file appears. Returns the first failure. */
wt_status cmd_sink_close(cmd_sink *sink, wt_status written, wt_error *err);

/* True if standard output is a terminal, without -o and --verbose: long text shows its first lines
 * there. */
bool cmd_shows_first_lines(const cmd_session *s);
/* Makes an open sink show the first lines of its text if cmd_shows_first_lines. */
void cmd_show_first_lines(cmd_session *s, cmd_sink *sink);

/* Writes the result to -o: HDF5 for a name that ends in .h5 or .hdf5, its main table for .csv,
 * all tables for .json, else a text stream; without -o or with "-" on standard output. */
wt_status cmd_write_result(cmd_session *s);
/* True if the short table takes the place of the tables on standard output: it is a terminal, -o
 * was not given, and the result has rows for it. */
bool cmd_shows_short_table(const cmd_session *s);
/* Prints the main numbers of the result as a short table: on standard output where it takes the
 * place of the tables, else on standard error. With --verbose all rows and the reasons. */
void cmd_print_short_table(cmd_session *s, bool findings);
/* Prints where the tables are. */
void cmd_print_place_of_rest(const cmd_session *s);
/* True if the name requests HDF5. */
bool cmd_is_hdf5_path(const char *path);
/* True for standard output: no name, or "-". */
bool cmd_is_standard_stream(const char *path);
/* Returns the form that the end of a name asks for. */
wt_export_form export_form_of_suffix(const char *output, wt_export_form otherwise);
/* For subcommands that write no result: usage error if the name after -o requests HDF5 or, unless
 * `has_table`, another form of tables. */
bool cmd_require_text_output(cmd_session *s, bool has_table);
/* Checks before the computation that the file can be written. NULL and "-" are always possible. */
wt_status cmd_check_output(const char *path, wt_error *err);
/* Returns a default name: "case/road.xml" -> "road" + ending, in the current folder; NULL when out
 * of memory. */
char *cmd_default_name(const char *path, const char *ending);

/* Stores the command line as the user typed it; main calls this first. */
void cmd_set_command_line(int argc, char **argv);
/* Copies the stored command line into a provenance. */
void cmd_record_command(wt_provenance *provenance);

#endif
