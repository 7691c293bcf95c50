/* The command: the table of subcommands, options that are one table each, output and messages.
 * Only this room prints, exits and parses options. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_CMD_H
#define WT_CMD_CMD_H

#include <stdlib.h>

#include "weartrack/weartrack.h"

/* Exit status: good, data or run-time error, usage error. */
enum { CMD_OK = 0, CMD_FAILED = 1, CMD_USAGE = 2 };

/* A subcommand gets its own argv: argv[0] is its name. */
typedef struct cmd_command {
    const char *name;
    int (*run)(int argc, char **argv); /* NULL: `name` is the heading of a group */
    const char *help;                  /* one line */
} cmd_command;
extern const cmd_command cmd_commands[]; /* ends with a NULL name */

int cmd_info(int argc, char **argv);
int cmd_convert(int argc, char **argv);
int cmd_formats(int argc, char **argv);
int cmd_indent(int argc, char **argv);
int cmd_compare(int argc, char **argv);
int cmd_master(int argc, char **argv);
int cmd_friction(int argc, char **argv);
int cmd_layer(int argc, char **argv);
int cmd_run(int argc, char **argv);
int cmd_report(int argc, char **argv);

/* ---- options ------------------------------------------------------------------------------ */

typedef enum cmd_option_kind {
    CMD_FLAG,     /* bool */
    CMD_TEXT,     /* const char *, borrowed from argv */
    CMD_LIST,     /* cmd_list, may be given several times */
    CMD_QUANTITY, /* double in SI, of `quantity` */
    CMD_ESTIMATE, /* wt_estimate, as wt_estimate_parse reads it */
    CMD_VALUES,   /* cmd_values: a list of `quantity`, as wt_list_parse reads it */
    CMD_NUMBER,   /* double, dimensionless */
    CMD_COUNT,    /* unsigned long, >= 0 */
    CMD_CHOICE    /* int: which of the words of `value`, parted by '|' */
} cmd_option_kind;

typedef struct cmd_list {
    const char **items; /* borrowed texts; the array is freed by cmd_list_free */
    size_t n;
} cmd_list;
void cmd_list_free(cmd_list *list);

typedef struct cmd_values {
    double *values; /* [n] SI */
    size_t n;
} cmd_values;
void cmd_values_free(cmd_values *list);

typedef struct cmd_option {
    const char *name; /* long name, without the dashes */
    char letter;      /* 0 if none */
    cmd_option_kind kind;
    void *target;
    const char *value; /* what stands for the value in the help, or the choices; NULL for a flag */
    wt_quantity quantity;
    const char *help;
} cmd_option;

/* Options that mean the same everywhere. A subcommand shows those it names. */
typedef struct cmd_common {
    const char *output;  /* -o, NULL = standard output */
    const char *format;  /* id that overrules detection */
    const char *formats; /* folder of further descriptions */
    unsigned long threads;
    unsigned long seed;
    bool quiet;
    bool no_provenance;
} cmd_common;
#define CMD_COMMON_DEFAULTS                                                                        \
    {                                                                                              \
        NULL, NULL, NULL, 0, 1, false, false                                                       \
    }
#define CMD_OPT_OUTPUT 1u
#define CMD_OPT_FORMAT 2u
#define CMD_OPT_FORMATS 4u
#define CMD_OPT_THREADS 8u
#define CMD_OPT_SEED 16u
#define CMD_OPT_PROVENANCE 32u

typedef struct cmd_usage {
    const char *name;      /* of the subcommand */
    const char *arguments; /* "[OPTION]... FILE..." */
    const char *what;      /* what it does, a few lines */
    unsigned common;       /* CMD_OPT_ bits; --quiet and --help are everywhere */
    const char *notes;     /* after the options; NULL if none */
} cmd_usage;

/* Parses argv. Returns true to go on, with *first the index of the first argument that is no
 * option; false with the exit status in *status (help was printed, or the words were wrong). */
bool cmd_parse(const cmd_usage *usage, const cmd_option *options, size_t n_options,
               cmd_common *common, int argc, char **argv, int *first, int *status);
/* What the option expects if this value (SI) is outside its limits; NULL if it is good. */
const char *cmd_outside(const char *option, double value);
/* The two names are those of one regular file. */
bool cmd_same_file(const char *a, const char *b);
/* A usage error if --format names no format. */
int cmd_check_format(const char *name, const cmd_common *common, const wt_formats *formats);
/* Says what is wrong with the call on stderr, and where help is; returns CMD_USAGE. */
int cmd_usage_error(const char *name, const char *format, ...) WT_PRINTF(2, 3);

/* Characters, not bytes: labels hold degree and micro signs. */
size_t cmd_text_width(const char *text, size_t n);
/* Prints the text and a line feed; `column` characters stand on the line already. Lines that grow
 * too long are broken between words and go on after `indent` blanks. */
void cmd_wrap(FILE *out, size_t column, size_t indent, const char *text);

/* ---- messages ----------------------------------------------------------------------------- */

/* Prints the error on stderr as one line and returns the exit status that fits. */
int cmd_fail(const char *name, const wt_error *err);
/* Prints the warnings of the log on stderr, notes too if `notes`; nothing if quiet. */
void cmd_print_log(const char *name, const wt_parselog *log, bool notes, bool quiet);

/* Lists the files that failed (table "failures") on stderr; returns how many there are. */
size_t cmd_print_failures(const char *name, const wt_table *failures);

/* Shows progress on stderr if it is a terminal, after a second. */
typedef struct cmd_progress {
    double start, shown;
    bool active, printed;
} cmd_progress;
wt_progress cmd_progress_start(cmd_progress *state, bool quiet);
/* From here to cmd_progress_end, an interruption (Ctrl-C) ends the work at its next step, so that
 * it removes what it had begun. */
void cmd_catch_interruptions(void);
void cmd_progress_end(cmd_progress *state);

/* ---- output ------------------------------------------------------------------------------- */

/* Writes the tables to -o: a name that ends in .h5 or .hdf5 is the HDF5 store, anything else
 * the text stream; without -o or with "-" the stream on standard output. `result` is not freed. */
wt_status cmd_write(const cmd_common *common, wt_result *result, wt_error *err);
/* Moves n tables into the result, in this order; those that are NULL are left out. Takes them all,
 * also on failure. */
wt_status cmd_collect(wt_result *result, wt_table **const tables[], size_t n, wt_error *err);
/* Whether the name after -o asks for the HDF5 store. */
bool cmd_is_store(const char *path);
/* Refuses an output that is one of the files read: the input would be lost. */
wt_status cmd_check_output(const char *output, const wt_result *result, wt_error *err);
/* Records the call in the result's provenance. */
wt_status cmd_provenance(wt_result *result, int argc, char **argv, wt_error *err);

/* ---- around a job --------------------------------------------------------------------------- */

/* What a subcommand that calls a job has beside it. Zero-initialised it may be freed. */
typedef struct cmd_session {
    const char *name;
    const cmd_common *common;
    wt_formats *formats;
    wt_parselog *log;
    wt_result *result;
    wt_job work; /* for the job: what failed is listed, inputs go to the result's provenance */
    cmd_progress progress;
} cmd_session;

/* Makes all of it from the common options; an exit status other than CMD_OK ends the call. */
int cmd_begin(cmd_session *s, const char *name, const cmd_common *common);
/* Says what failed, the warnings and, unless `made` is WT_OK, the error; returns the exit status.
 */
int cmd_end(cmd_session *s, wt_status made, const wt_error *err);
/* The same after writing the tables (see cmd_collect) if they were made. */
int cmd_finish(cmd_session *s, wt_status made, wt_table **const tables[], size_t n, wt_error *err);
void cmd_session_free(cmd_session *s);

/* The call as the user typed it, set by main. */
extern int cmd_full_argc;
extern char **cmd_full_argv;

#endif
