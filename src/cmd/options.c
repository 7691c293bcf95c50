/* Parses options and prints help, both from the parameter tables of the structures of a subcommand.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <getopt.h>
#include <stdarg.h>
#include <string.h>

#include "cmd/cmd.h"
#include "core/base/text.h"

enum { MAX_OPTIONS = 160, FIRST_CODE = 256, NAME_SIZE = 48, TEXT_SIZE = 512 };

cmd_common_options cmd_common_defaults(void)
{
    return (cmd_common_options){.provenance = true};
}

static const wt_param common_rows[] = {
    {PARAM_TEXT_OF("output", cmd_common_options, output), .value = "FILE", .letter = 'o',
     .unset = "",
     .help = "write the output to this file; the end of its name is the form: .h5 or .hdf5 (HDF5) "
             "and .json have all tables, .csv the main table under one header line, other names, "
             "such as .tsv, the text stream of all tables; default and -: standard output"},
    {PARAM_TEXT_OF("formats", cmd_common_options, formats), .value = "FOLDER", .unset = "",
     .help = "also use the format descriptions (*.xml) of this folder; one with the id of a "
             "built-in description replaces it"},
    {PARAM_TEXTS_OF("columns", cmd_common_options, columns, n_columns),
     .value = "NAME=QUANTITY:UNIT", .unset = "",
     .help =
         "quantity of a column whose name is not known, such as \"Stor. "
         "Mod.=storage_modulus:MPa\"; the unit applies only if the file states none; repeatable"},
    {PARAM_TEXT_OF("files-from", cmd_common_options, files_from), .value = "FILE", .unset = "",
     .flags = PARAM_READ,
     .help = "read the names of further files from this file, one in each line or separated by "
             "zero bytes; - is standard input"},
    {PARAM_FLAG_OF("provenance", cmd_common_options, provenance),
     .help = "version, command line, digests and times in what is written"},
    {PARAM_FLAG_OF("cost", cmd_common_options, cost),
     .help = "also write the table cost: time, nodes, files and errors of each stage"},
    {PARAM_CHOICE_OF("log", cmd_common_options, log, "text|json"),
     .help = "form of standard error: text for people, or JSON with one object in each line for "
             "every message, every failure, the progress once a second, and the exit status"},
    {PARAM_FLAG_OF("quiet", cmd_common_options, quiet), .letter = 'q',
     .help = "print errors only, without the table of the main numbers, progress and warnings"},
    {PARAM_FLAG_OF("verbose", cmd_common_options, verbose), .letter = 'v',
     .help = "print every main number with its reasons, and all warnings in full; without this a "
             "terminal gets at most 20 lines"},
    {PARAM_FLAG_OF("strict", cmd_common_options, strict),
     .help = "a remark (warning) makes the exit status 1, too"},
    {PARAM_FLAG_OF("help", cmd_common_options, help), .letter = 'h',
     .help = "print this help; --help all lists every option"},
};
PARAM_LOCAL_TABLE(common_params, cmd_common_options, common_rows, cmd_common_defaults, NO_PARTS)

/* One option of the call. */
typedef struct option_row {
    cmd_option_group *part;
    size_t number; /* index of the parameter in its table */
    const wt_param *param;
    bool negated; /* a flag that is set by default: --no-NAME */
    bool former;  /* the name is that of an earlier version: accepted, but not shown */
    char name[NAME_SIZE];
} option_row;

typedef struct option_list {
    option_row rows[MAX_OPTIONS];
    size_t n;
} option_list;

bool cmd_option_is_set(const cmd_option_group *part, const char *name)
{
    for (size_t i = 0; i < wt_params_count(part->params); i++)
        if (strcmp(wt_params_get(part->params, i)->name, name) == 0)
            return (part->given & UINT64_C(1) << i) != 0;
    return false;
}

bool cmd_usage_error(cmd_session *s, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = NULL;
    if (vasprintf(&text, format, args) < 0)
        cmd_exit_without_memory(strlen(format));
    va_end(args);
    cmd_message("weartrack %s: %s; see weartrack %s --help\n", s->name, text, s->name);
    free(text);
    s->status = CMD_USAGE;
    return false;
}

static bool option_error(cmd_session *s, const char *option)
{
    char line[1024];
    wt_error_format(&s->err, line, sizeof line);
    return cmd_usage_error(s, *option != '\0' ? "--%s: %s" : "%s%s", option, line);
}

bool cmd_param_error(cmd_session *s)
{
    char option[sizeof s->err.place];
    snprintf(option, sizeof option, "%s", s->err.place);
    s->err.place[0] = '\0';
    return option_error(s, option);
}

bool cmd_names_contain(const char *names, const char *name)
{
    const size_t length = strlen(name);
    for (const char *p = names; *p != '\0'; p += strcspn(p, " "), p += strspn(p, " "))
        if (strcspn(p, " ") == length && strncmp(p, name, length) == 0)
            return true;
    return false;
}

static void add_option_group(option_list *list, cmd_option_group *part)
{
    for (size_t i = 0; i < wt_params_count(part->params) && list->n < MAX_OPTIONS; i++) {
        const wt_param *param = wt_params_get(part->params, i);
        if ((param->flags & PARAM_NO_OPTION) != 0 ||
            (part->only != NULL && !cmd_names_contain(part->only, param->name)))
            continue;
        option_row *row = &list->rows[list->n++];
        *row = (option_row){part, i, param, wt_params_default_flag(part->params, i), false, ""};
        snprintf(row->name, sizeof row->name, "%s%s", row->negated ? "no-" : "", param->name);
        if (param->former != NULL && list->n < MAX_OPTIONS) {
            option_row *former = &list->rows[list->n++];
            *former = *row;
            former->former = true;
            snprintf(former->name, sizeof former->name, "%s%s", row->negated ? "no-" : "",
                     param->former);
        }
    }
}

/* ---- help --------------------------------------------------------------------------------- */

static void print_option_help(const option_row *row)
{
    enum { HELP_COLUMN = 30 };
    const wt_param *p = row->param;
    char text[TEXT_SIZE], set[128] = "";
    int used = p->letter != 0 ? printf("  -%c, --%s", p->letter, row->name)
                              : printf("      --%s", row->name);
    if (p->value != NULL)
        used += printf(" %s", p->value);
    if (used > HELP_COLUMN - 2)
        printf("\n%*s", HELP_COLUMN, "");
    else
        printf("%*s", HELP_COLUMN - used, "");
    if (p->kind != PARAM_FLAG)
        wt_params_default(row->part->params, row->number, set, sizeof set);
    snprintf(text, sizeof text, "%s%s%s%s", row->negated ? "no " : "", p->help,
             (p->flags & PARAM_REQUIRED) != 0 ? "; required"
             : set[0] != '\0'                 ? "; default: "
                                              : "",
             set);
    cmd_wrap(stdout, HELP_COLUMN, HELP_COLUMN, text);
}

static const option_row *find_option(const option_list *list, const char *name, size_t length)
{
    for (size_t i = 0; i < list->n; i++)
        if (strlen(list->rows[i].name) == length && strncmp(list->rows[i].name, name, length) == 0)
            return &list->rows[i];
    return NULL;
}

/* Prints the options in the order of `names`, separated by blanks. An unknown name is printed
 * unchanged, which the tests detect. */
static void print_listed_options(const option_list *list, const char *names)
{
    for (const char *p = names; *p != '\0'; p += strspn(p, " ")) {
        const size_t length = strcspn(p, " ");
        const option_row *row = find_option(list, p, length);
        if (row != NULL)
            print_option_help(row);
        else
            printf("      --%.*s\n", (int)length, p);
        p += length;
    }
}

static void print_all_options(const cmd_usage *usage, const option_list *list)
{
    const char *elsewhere = usage->master != NULL ? usage->master : "";
    puts("\noptions:");
    for (size_t i = 0; i < list->n; i++)
        if (!list->rows[i].former && !cmd_names_contain(elsewhere, list->rows[i].name))
            print_option_help(&list->rows[i]);
    if (usage->master == NULL)
        return;
    puts("\nof DMA files, as in weartrack master --help all:");
    for (size_t i = 0; i < list->n; i++)
        if (!list->rows[i].former && cmd_names_contain(elsewhere, list->rows[i].name))
            printf("      --%s%s%s\n", list->rows[i].name,
                   list->rows[i].param->value != NULL ? " " : "",
                   list->rows[i].param->value != NULL ? list->rows[i].param->value : "");
}

static size_t count_shown(const option_list *list)
{
    size_t n = 0;
    for (size_t i = 0; i < list->n; i++)
        n += !list->rows[i].former;
    return n;
}

static void print_subcommand_help(const cmd_usage *usage, const option_list *list, bool all)
{
    const size_t used = (size_t)printf("usage: weartrack %s ", usage->name);
    cmd_wrap(stdout, used, used, usage->arguments);
    putchar('\n');
    cmd_wrap(stdout, 0, 0, usage->description);
    if (all || usage->first == NULL) {
        print_all_options(usage, list);
    } else {
        printf("\noptions that most need, of %zu; --help all has every one:\n", count_shown(list));
        print_listed_options(list, usage->first);
        print_listed_options(list, "quiet verbose help");
    }
    if (usage->notes != NULL) {
        putchar('\n');
        cmd_wrap(stdout, 0, 0, usage->notes);
    }
    printf("\nMore in weartrack-%s(1).\n", usage->name);
}

/* ---- parsing ------------------------------------------------------------------------------ */

/* Sets one option; false if the value is invalid. */
static bool set_option(cmd_session *s, const option_row *row, const char *text)
{
    cmd_option_group *part = row->part;
    if (row->param->kind == PARAM_FLAG)
        text = row->negated ? "no" : "yes";
    else if (row->param->kind != PARAM_TEXTS && (part->given & UINT64_C(1) << row->number) != 0)
        return cmd_usage_error(s, "--%s is there twice, and '%s' would take the place of the first",
                               row->name, text);
    if (wt_params_set(part->params, row->param->name, part->structure, text, &part->given,
                      &s->err) == WT_OK)
        return true;
    return s->err.status == WT_E_MEMORY ? cmd_fail(s) : option_error(s, row->name);
}

/* Reports an option that getopt rejected. `word` is the argument. */
static bool report_bad_option(cmd_session *s, const struct option *longs, int code,
                              const char *word)
{
    if (code == ':')
        return cmd_usage_error(s, "%s needs a value", word);
    const size_t length = strcspn(word, "=");
    size_t n_like = 0;
    const struct option *like = NULL;
    for (const struct option *o = longs; o->name != NULL && strncmp(word, "--", 2) == 0; o++)
        if (length > 2 && strncmp(o->name, word + 2, length - 2) == 0) {
            if (strlen(o->name) == length - 2)
                return cmd_usage_error(s, "--%s takes no value", o->name);
            like = o;
            n_like++;
        }
    if (n_like == 1)
        return cmd_usage_error(s, "--%s takes no value", like->name);
    if (n_like > 1)
        return cmd_usage_error(s, "ambiguous option '%s'", word);
    const char *const instead = length > 2 ? removed_name_advice(word + 2, length - 2) : NULL;
    if (instead != NULL)
        return cmd_usage_error(s, "there is no option %.*s any more: %s", (int)length, word,
                               instead);
    spell_suggestion near = spell_suggestion_begin(word + 2, length > 2 ? length - 2 : 0);
    for (const struct option *o = longs; o->name != NULL && strncmp(word, "--", 2) == 0; o++)
        spell_suggestion_try(&near, o->name, strlen(o->name));
    return near.name != NULL
               ? cmd_usage_error(s, "unknown option '%s'; did you mean --%s?", word, near.name)
               : cmd_usage_error(s, "unknown option '%s'", word);
}

/* Rejects output suffixes of formats that are not supported. */
static bool check_output_suffix(cmd_session *s, const cmd_usage *usage)
{
    static const char of_sheet[] = "TABLE.csv` gives a table that one opens",
                      of_json[] = "TABLE.json` gives a table in it";
    static const struct {
        const char *ending, *what, *instead;
        bool whole;
    } others[] = {
        {".xlsx", "spreadsheet", of_sheet, false},     {".xlsm", "spreadsheet", of_sheet, false},
        {".xls", "spreadsheet", of_sheet, false},      {".ods", "spreadsheet", of_sheet, false},
        {".parquet", "Parquet file", of_sheet, false}, {".sqlite", "database", of_sheet, false},
        {".sqlite3", "database", of_sheet, false},     {".db", "database", of_sheet, false},
        {".csv", "CSV file", of_sheet, true},          {".json", "JSON file", of_json, true}};
    const char *const output = s->common.output;
    const char *const dot = output != NULL ? strrchr(output, '.') : NULL;
    for (size_t i = 0; dot != NULL && i < COUNT_OF(others); i++) {
        if (strcasecmp(dot, others[i].ending) != 0 || (others[i].whole && !usage->one_by_one))
            continue;
        if (usage->exports)
            return cmd_usage_error(s,
                                   "-o %s: no %s is written; -o TABLE.csv is what a spreadsheet "
                                   "opens",
                                   output, others[i].what);
        return cmd_usage_error(s,
                               "-o %s: no %s is written; write the result as .h5, then "
                               "`weartrack table RESULT NAME -o %s",
                               output, others[i].what, others[i].instead);
    }
    return true;
}

/* Usage error if an input is empty or is standard input for the second time, or if -o would
 * overwrite an input. */
static bool check_input_files(cmd_session *s, const char *const *inputs, size_t n, size_t *n_pipes)
{
    const char *output = s->common.output;
    for (size_t i = 0; i < n; i++) {
        if (*inputs[i] == '\0')
            return cmd_usage_error(s, "a file name is empty");
        wt_protect_input(inputs[i]);
        if (output != NULL && wt_check_overwrite(output, &s->err) != WT_OK)
            return cmd_usage_error(s, "-o %s: %s; give another name", output, s->err.message);
        *n_pipes += strcmp(inputs[i], "-") == 0;
        if (*n_pipes > 1)
            return cmd_usage_error(s, "- can stand for one input only");
    }
    return true;
}

static bool check_file_count(cmd_session *s, const cmd_usage *usage)
{
    if (usage->n_files == CMD_ONE_OR_MORE && s->n_files == 0)
        return cmd_usage_error(s, "%s", usage->files != NULL ? usage->files : "no file given");
    if (usage->n_files > 0 && s->n_files != (size_t)usage->n_files)
        return cmd_usage_error(s, "%s; %zu given", usage->files, s->n_files);
    return true;
}

/* Splits names that are separated by zero bytes or else by lines; returns their number. */
static size_t split_names(char *text, size_t length, const char **names)
{
    const char end = memchr(text, '\0', length) != NULL ? '\0' : '\n';
    size_t n = 0;
    for (char *p = text; p < text + length;) {
        char *stop = memchr(p, end, (size_t)(text + length - p));
        stop = stop != NULL ? stop : text + length;
        const bool is_line = end == '\n' && stop > p && stop[-1] == '\r';
        stop[-is_line] = '\0';
        if (stop - is_line > p)
            names[n++] = p;
        p = stop + 1;
    }
    return n;
}

/* Collects the files of the call: arguments and those of --files-from. */
static bool list_files(cmd_session *s, size_t n, char **arguments)
{
    const char *from = s->common.files_from;
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = from != NULL ? wt_input_open(from, &input, &s->err) : WT_OK;
    if (status == WT_OK && from != NULL) {
        wt_input_limit(input, WT_INPUT_SETTINGS_LIMIT);
        status = wt_input_bytes(input, &bytes, &length, &s->err);
    }
    if (status == WT_OK) {
        s->names = wt_alloc(length + 1, 1);
        /* a name and its separator need 2 bytes */
        s->files = wt_alloc(n + length / 2 + 1, sizeof *s->files);
        for (size_t i = 0; i < n; i++)
            s->files[i] = arguments[i];
        if (length > 0)
            memcpy(s->names, bytes, length);
        s->n_arguments = n;
        s->n_files = n + split_names(s->names, length, s->files + n);
    }
    wt_input_close(input);
    wt_error_file(status != WT_OK ? &s->err : NULL, from);
    if (status != WT_OK)
        return cmd_fail(s);
    if (from != NULL && s->n_files == n)
        return cmd_usage_error(s, "--files-from %s: it names no file", from);
    return true;
}

/* Builds the option tables of getopt. */
static void build_getopt_options(const option_list *list, struct option *longs, char *letters)
{
    size_t n_letters = 0;
    letters[n_letters++] = ':';
    for (size_t i = 0; i < list->n; i++) {
        const option_row *row = &list->rows[i];
        const int argument = row->param->kind == PARAM_FLAG ? no_argument : required_argument;
        longs[i] = (struct option){row->name, argument, NULL, FIRST_CODE + (int)i};
        if (row->param->letter != 0 && !row->former) {
            letters[n_letters++] = row->param->letter;
            if (argument == required_argument)
                letters[n_letters++] = ':';
        }
    }
    letters[n_letters] = '\0';
    longs[list->n] = (struct option){NULL, 0, NULL, 0};
}

/* Sets all options; `inputs` [argc] receives the input files among their values. */
static bool parse_options(cmd_session *s, const option_list *list, int argc, char **argv,
                          const char **inputs, size_t *n_inputs)
{
    struct option longs[MAX_OPTIONS + 1];
    char letters[2 * MAX_OPTIONS + 3];
    build_getopt_options(list, longs, letters);
    optind = 1;
    opterr = 0;
    int code;
    while ((code = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
        if (code == '?' || code == ':') {
            const char letter[] = {'-', (char)optopt, '\0'};
            const bool is_letter = optopt > 0 && optopt < FIRST_CODE;
            return report_bad_option(s, longs, code, is_letter ? letter : argv[optind - 1]);
        }
        const option_row *row = NULL;
        for (size_t i = 0; i < list->n && row == NULL; i++)
            if (code == FIRST_CODE + (int)i ||
                (code < FIRST_CODE && code == list->rows[i].param->letter))
                row = &list->rows[i];
        if (!set_option(s, row, optarg))
            return false;
        if (s->common.log == CMD_LOG_JSON)
            cmd_log_json(s->name);
        if ((row->param->flags & PARAM_READ) != 0)
            inputs[(*n_inputs)++] = optarg;
    }
    return true;
}

/* Names all required options that are missing. */
static bool check_required(cmd_session *s, const option_list *list)
{
    char names[TEXT_SIZE] = "";
    size_t used = 0, n = 0;
    for (size_t i = 0; i < list->n && used < sizeof names; i++) {
        const option_row *row = &list->rows[i];
        if ((row->param->flags & PARAM_REQUIRED) == 0 ||
            (row->part->given & UINT64_C(1) << row->number) != 0)
            continue;
        used += (size_t)snprintf(names + used, sizeof names - used, "%s--%s", n++ > 0 ? ", " : "",
                                 row->name);
    }
    return n == 0 || cmd_usage_error(s, "%s %s missing", names, n == 1 ? "is" : "are");
}

bool cmd_parse(cmd_session *s, const cmd_usage *usage, cmd_option_group *parts, size_t n_parts,
               int argc, char **argv)
{
    option_list list = {.n = 0};
    char names[TEXT_SIZE];
    size_t n_inputs = 0, n_pipes = 0;
    const char **inputs = wt_alloc((size_t)argc + 1, sizeof *inputs);
    snprintf(names, sizeof names, "%s log quiet verbose strict help", usage->common);
    cmd_option_group last = {common_params(), &s->common, names, 0};
    s->name = usage->name;
    s->next = usage->next;
    s->parts = parts;
    s->n_parts = n_parts;
    for (size_t i = 0; i < n_parts; i++)
        add_option_group(&list, &parts[i]);
    add_option_group(&list, &last);
    bool good = parse_options(s, &list, argc, argv, inputs, &n_inputs);
    if (good && s->common.help) {
        print_subcommand_help(usage, &list, optind < argc && strcmp(argv[optind], "all") == 0);
        good = false;
    }
    good = good && check_output_suffix(s, usage) &&
           list_files(s, (size_t)(argc - optind), argv + optind) && check_required(s, &list) &&
           check_input_files(s, inputs, n_inputs, &n_pipes) &&
           check_input_files(s, s->files, s->n_files, &n_pipes) && check_file_count(s, usage);
    free(inputs);
    return good;
}
