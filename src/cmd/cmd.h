/* The command: the table of subcommands, options that are one table each, output and messages.
 * Only this room prints, exits and parses options. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_CMD_H
#define WT_CMD_CMD_H

#include <stdlib.h>

#include "core/base/array.h"
#include "core/base/param.h"
#include "weartrack/weartrack.h"

/* Exit status: all that was asked for, nothing usable or a fault, a wrong call, a part of it. */
enum {
    CMD_OK = WT_ANSWERED_WHOLE,
    CMD_FAILED = WT_ANSWERED_NOTHING,
    CMD_USAGE = 2,
    CMD_PARTLY = WT_ANSWERED_PARTLY
};

/* A subcommand gets its own argv: argv[0] is its name. */
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
int cmd_thermal(int argc, char **argv);
int cmd_dwell(int argc, char **argv);
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
int cmd_validate(int argc, char **argv);
int cmd_table(int argc, char **argv);
int cmd_summary(int argc, char **argv);

/* From now on this process ends where memory runs out (memory.c). */
void cmd_end_without_memory(void);

/* ---- options ------------------------------------------------------------------------------ */

/* A structure whose parameters are options of a subcommand. */
typedef struct cmd_part {
    const wt_params *params;
    void *structure;
    const char *only; /* names of those that are options here, parted by blanks; NULL: all */
    uint64_t given;
} cmd_part;

/* Defines the table of options none of which is set by default. */
#define CMD_OPTIONS(name, type, rows)                                                              \
    static type name##_unset(void)                                                                 \
    {                                                                                              \
        return (type){0};                                                                          \
    }                                                                                              \
    PARAM_LOCAL_TABLE(name, type, rows, name##_unset, NO_PARTS)

/* Options that mean the same everywhere. A subcommand shows those it names. */
typedef enum cmd_log { CMD_LOG_TEXT, CMD_LOG_JSON } cmd_log;
typedef struct cmd_common {
    const char *output;         /* -o, NULL = standard output */
    const char *formats;        /* folder of further descriptions */
    const char *const *columns; /* of plain tables */
    size_t n_columns;
    const char *files_from; /* file with names of files, NULL = none */
    cmd_log log;
    bool provenance, cost;
    bool quiet, strict, help;
} cmd_common;
cmd_common cmd_common_defaults(void);

typedef struct cmd_usage {
    const char *name;      /* of the subcommand */
    const char *arguments; /* "[OPTION]... FILE..." */
    const char *what;      /* what it does, a few lines */
    const char *common; /* as `only` of the common options; quiet, strict and help are everywhere */
    const char *first;  /* the options that most need, for --help without "all"; NULL: all */
    const char *master; /* those that are told by weartrack master; NULL: none */
    const char *notes;  /* after the options; NULL if none */
    bool exports;       /* tables for other programs, databases too */
    int n_files;        /* how many must be given; CMD_SOME: one or more; 0: any number */
    const char *files;  /* said of another number: "two files are needed" */
} cmd_usage;
enum { CMD_SOME = -1 };

/* ---- a call --------------------------------------------------------------------------------- */

/* Shows progress on stderr if it is a terminal, after a second. */
typedef struct cmd_progress {
    double start, shown;
    double interval; /* from one to the next [s] */
    bool active;
} cmd_progress;

/* One call of a subcommand: its words, and what it has beside its job. */
typedef struct cmd_session {
    const char *name;
    cmd_common common;
    cmd_part *parts; /* [n_parts] */
    size_t n_parts;
    const char **files;          /* [n_files] the arguments that are no options and, behind */
    size_t n_arguments, n_files; /* these, the names of files_from */
    char *names;                 /* text of files_from */
    int status;                  /* to exit with */
    wt_error err;
    wt_formats *formats;
    wt_log *log;
    wt_result *result;
    wt_cost *cost; /* NULL: not asked for */
    wt_job work;   /* for the job: what failed is listed, inputs go to the result's provenance */
    cmd_progress progress;
    wt_read_options *shared; /* by files of several kinds: its units are those of columns that one
                                of them has; NULL: none */
} cmd_session;

/* Nothing but the defaults of the job, for its options; may be freed. */
cmd_session cmd_session_defaults(void);
/* Parses argv. False when there is nothing left to do: help was printed, or the words were wrong.
 */
bool cmd_parse(cmd_session *s, const cmd_usage *usage, cmd_part *parts, size_t n_parts, int argc,
               char **argv);
/* Makes log, result and all that the job is given. False if it cannot. */
bool cmd_begin(cmd_session *s);
/* The formats with those of --formats and --columns, which may say what is no quantity. */
bool cmd_read_formats(cmd_session *s);
/* Both; --format (may be NULL) must name one of them. */
bool cmd_begin_reading(cmd_session *s, const char *format);
/* Both for the files of the call, which become those of the set. */
bool cmd_begin_files(cmd_session *s, wt_file_set *set);
/* All that comes before the one job of a subcommand over the files of the call, a stage of its
 * name; false if there is nothing to do. */
bool cmd_begin_job(cmd_session *s, const cmd_usage *usage, cmd_part *parts, size_t n_parts,
                   wt_file_set *set, int argc, char **argv);
/* Says what failed and gives the tables "failures" and "notes" of what was done, unless they would
 * be empty. */
wt_status cmd_give_record(cmd_session *s, wt_table_sink sink, void *user);
/* Files of several kinds are read by these options, which stay where they are until the end: a unit
 * is for a column that any of them has. False if it cannot. */
bool cmd_share_units(cmd_session *s, wt_read_options *read);
/* Says what failed, the remarks and, unless `made` is WT_OK, the error. */
void cmd_end(cmd_session *s, wt_status made);
/* The same after writing the tables, in this order, and the record behind them, if they were made;
 * those that are NULL are left out. Takes them all. */
void cmd_finish(cmd_session *s, wt_status made, wt_table **const tables[], size_t n);
/* Runs a case with what every call that does has in common; its result is that of the session, and
 * *n_failed stages or files are in its table "failures". */
wt_status cmd_run_case(cmd_session *s, const wt_case *c, wt_run_options *run, size_t *n_failed);
/* Returns the exit status. */
int cmd_session_free(cmd_session *s);

/* Whether an option of a part was given. */
bool cmd_given(const cmd_part *part, const char *name);
/* Says what is wrong with the call on stderr, and where help is; returns false. */
bool cmd_usage_error(cmd_session *s, const char *format, ...) WT_PRINTF(2, 3);
/* The same for an error of the library about a parameter, whose name is its place. */
bool cmd_param_error(cmd_session *s);

/* Characters, not bytes: labels hold degree and micro signs. */
size_t cmd_text_width(const char *text, size_t n);
/* Prints the text and a line feed; `column` characters stand on the line already. Lines that grow
 * too long are broken between words and go on after `indent` blanks. */
void cmd_wrap(FILE *out, size_t column, size_t indent, const char *text);

/* ---- messages ----------------------------------------------------------------------------- */

/* From now on what is said is one object of JSON a line, each with its event: message, note,
 * warning, loss, error, failed, progress or end (log.c). */
void cmd_log_json(const char *name);
bool cmd_is_json(void);
/* A member of such an object: a text, or a number where that is NULL. */
typedef struct cmd_word {
    const char *name, *text;
    size_t number;
} cmd_word;
/* Nothing without --log json. Empty texts are left out. */
void cmd_event(const char *event, const cmd_word *words, size_t n);

/* To standard error. What a terminal would obey, in the name of a file say, is shown as \x1b; only
 * the format itself may end a line. */
void cmd_message(const char *format, ...) WT_PRINTF(1, 2);
/* Where the page of a report is that was written to a place. */
void cmd_print_page_location(const char *place);
/* Warns of a font of figures that is not there; with --strict the call has failed. */
void cmd_check_font(cmd_session *s, const char *font);
/* Prints the error on stderr as one line; returns false. */
bool cmd_fail(cmd_session *s);
/* The same of one among others, which go on; what was given is then answered in part. */
void cmd_fail_one(cmd_session *s);
/* Something is missing from what is given. */
void cmd_partly(cmd_session *s);
/* Prints the remarks of a log on stderr, equal words once, and their number; notes too if `notes`;
 * of a quiet call the losses alone. The call has answered in part where something was lost; with
 * --strict it has failed where there is a remark at all. */
void cmd_print_log(cmd_session *s, const wt_log *log, bool notes);
/* Lists the files that failed (table "failures", may be NULL) on stderr; false if there are none.
 * The call has answered in part then, or not at all if the table says so. */
bool cmd_print_failures(cmd_session *s, const wt_table *failures);

wt_progress cmd_progress_start(cmd_session *s);
/* From here to cmd_progress_end, an interruption (Ctrl-C) ends the work at its next step, so that
 * it removes what it had begun. */
void cmd_catch_interruptions(void);
void cmd_progress_end(cmd_session *s);

/* ---- output ------------------------------------------------------------------------------- */

/* Where text goes: the file after -o, which appears when it is complete, or standard output. */
typedef struct cmd_sink {
    wt_atomic_file *file;
    FILE *stream;
    const char *name; /* for errors */
} cmd_sink;
wt_status cmd_sink_open(const char *output, cmd_sink *sink, wt_error *err);
/* Ends it, after a failure without a file; returns the first failure. */
wt_status cmd_sink_close(cmd_sink *sink, wt_status written, wt_error *err);

/* Writes the result to -o: a name that ends in .h5 or .hdf5 is the HDF5 store, anything else the
 * text stream; without -o or with "-" the stream on standard output. */
wt_status cmd_write(cmd_session *s);
/* Whether the name after -o asks for the HDF5 store. */
bool cmd_is_store(const char *path);
/* Whether it is standard output that is meant: without a name, or by "-". */
bool cmd_is_standard(const char *path);
/* Of a subcommand that writes text only: a usage error if the name after -o asks for HDF5. */
bool cmd_is_text(cmd_session *s);
/* Whether that file could be written, before there is work to lose. NULL and "-" can. */
wt_status cmd_try_output(const char *path, wt_error *err);
/* "case/road.xml" -> "road" + ending, in the current folder; NULL when out of memory. */
char *cmd_default_name(const char *path, const char *ending);
/* Records the call in the result's provenance. */
wt_status cmd_provenance(wt_result *result, wt_error *err);

/* Stores the command line as the user typed it; main calls this first. */
void cmd_set_command_line(int argc, char **argv);
/* Copies the stored command line into a provenance. WT_E_MEMORY. */
wt_status cmd_record_command(wt_provenance *provenance);

#endif
