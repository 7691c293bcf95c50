/* Options: the parameters of the structures that a subcommand fills give the parser and the help,
 * so they cannot disagree. SPDX-License-Identifier: GPL-3.0-or-later */
#include <getopt.h>
#include <stdarg.h>
#include <string.h>

#include "cmd/cmd.h"

enum { MAX_OPTIONS = 64, FIRST_CODE = 256, NAME_SIZE = 48, TEXT_SIZE = 512 };

cmd_common cmd_common_defaults(void)
{
    return (cmd_common){.provenance = true};
}

static const wt_param common_rows[] = {
    {PARAM_TEXT_OF("output", cmd_common, output), .value = "FILE", .letter = 'o', .unset = "",
     .help = "write there instead of standard output, as HDF5 if the name ends in .h5 or .hdf5; - "
             "is standard output"},
    {PARAM_TEXT_OF("formats", cmd_common, formats), .value = "FOLDER", .unset = "",
     .help =
         "use the format descriptions (*.xml) of this folder too; one with the id of a built-in "
         "description takes its place"},
    {PARAM_TEXT_OF("files-from", cmd_common, files_from), .value = "FILE", .unset = "",
     .help =
         "files to read, besides those named in the call: their names, a line each or parted by "
         "zero bytes; - is standard input"},
    {PARAM_FLAG_OF("provenance", cmd_common, provenance),
     .help = "version, command line and times in what is written"},
    {PARAM_FLAG_OF("quiet", cmd_common, quiet), .letter = 'q',
     .help = "no progress and no warnings on standard error; errors are printed all the same"},
    {PARAM_FLAG_OF("strict", cmd_common, strict),
     .help = "exit status 1 if there is a remark (warning), too"},
    {PARAM_FLAG_OF("help", cmd_common, help), .letter = 'h', .help = "print this"},
};
PARAM_LOCAL_TABLE(common_params, cmd_common, common_rows, cmd_common_defaults, NO_PARTS)

/* One option of the call. */
typedef struct option_row {
    cmd_part *part;
    size_t number; /* of the parameter in the table */
    const wt_param *param;
    bool negated; /* a flag that is set by default: --no-NAME */
    char name[NAME_SIZE];
} option_row;

typedef struct option_list {
    option_row rows[MAX_OPTIONS];
    size_t n;
} option_list;

void cmd_parts_clear(cmd_part *parts, size_t n)
{
    for (size_t i = 0; i < n; i++)
        wt_params_clear(parts[i].params, parts[i].structure, &parts[i].given);
}

bool cmd_given(const cmd_part *part, const char *name)
{
    for (size_t i = 0; i < wt_params_count(part->params); i++)
        if (strcmp(wt_params_get(part->params, i)->name, name) == 0)
            return (part->given & UINT64_C(1) << i) != 0;
    return false;
}

int cmd_usage_error(const char *name, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *text = NULL;
    const int written = vasprintf(&text, format, args);
    va_end(args);
    cmd_say("weartrack %s: %s; see weartrack %s --help\n", name, written < 0 ? "" : text, name);
    if (written >= 0)
        free(text);
    return CMD_USAGE;
}

static int option_error(const char *name, const char *option, const wt_error *err)
{
    char line[1024];
    wt_error_format(err, line, sizeof line);
    return cmd_usage_error(name, "--%s: %s", option, line);
}

int cmd_param_error(const char *name, wt_error *err)
{
    char line[1024], option[sizeof err->place];
    snprintf(option, sizeof option, "%s", err->place);
    err->place[0] = '\0';
    if (option[0] != '\0')
        return option_error(name, option, err);
    wt_error_format(err, line, sizeof line);
    return cmd_usage_error(name, "%s", line);
}

/* Whether `names`, parted by blanks, has this one. */
static bool is_listed(const char *names, const char *name)
{
    const size_t length = strlen(name);
    for (const char *p = names; *p != '\0'; p += strcspn(p, " "), p += strspn(p, " "))
        if (strcspn(p, " ") == length && strncmp(p, name, length) == 0)
            return true;
    return false;
}

static void add_part(option_list *list, cmd_part *part)
{
    for (size_t i = 0; i < wt_params_count(part->params) && list->n < MAX_OPTIONS; i++) {
        const wt_param *param = wt_params_get(part->params, i);
        if ((param->flags & PARAM_NO_OPTION) != 0 ||
            (part->only != NULL && !is_listed(part->only, param->name)))
            continue;
        char set[8];
        wt_params_default(part->params, i, set, sizeof set);
        option_row *row = &list->rows[list->n++];
        *row =
            (option_row){part, i, param, param->kind == PARAM_FLAG && strcmp(set, "yes") == 0, ""};
        snprintf(row->name, sizeof row->name, "%s%s", row->negated ? "no-" : "", param->name);
    }
}

/* ---- help --------------------------------------------------------------------------------- */

static void print_option(const option_row *row)
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
    const bool in_words = p->unset != NULL && strcmp(p->unset, set) == 0;
    snprintf(text, sizeof text, "%s%s%s%s", row->negated ? "no " : "", p->help,
             (p->flags & PARAM_REQUIRED) != 0 ? "; required"
             : set[0] == '\0'                 ? ""
             : in_words                       ? "; default: "
                                              : "; default ",
             set);
    cmd_wrap(stdout, HELP_COLUMN, HELP_COLUMN, text);
}

static void print_help(const cmd_usage *usage, const option_list *list)
{
    printf("usage: weartrack %s %s\n\n%s\n\noptions:\n", usage->name, usage->arguments,
           usage->what);
    for (size_t i = 0; i < list->n; i++)
        print_option(&list->rows[i]);
    if (usage->notes != NULL)
        printf("\n%s\n", usage->notes);
    printf("\nMore in weartrack-%s(1).\n", usage->name);
}

/* ---- parsing ------------------------------------------------------------------------------ */

/* Stores one value; an exit status other than CMD_OK when it is wrong. */
static int set_option(const char *name, const option_row *row, const char *text)
{
    wt_error err = WT_ERROR_INIT;
    cmd_part *part = row->part;
    if (row->param->kind == PARAM_FLAG)
        text = row->negated ? "no" : "yes";
    if (wt_params_set(part->params, row->param->name, part->structure, text, &part->given, &err) ==
        WT_OK)
        return CMD_OK;
    return err.status == WT_E_MEMORY ? cmd_fail(name, &err) : option_error(name, row->name, &err);
}

/* What getopt did not like, in words. `word` is the argument it stopped at. */
static int bad_option(const char *name, const struct option *longs, int code, const char *word)
{
    if (code == ':')
        return cmd_usage_error(name, "%s needs a value", word);
    const size_t length = strcspn(word, "=");
    size_t n_like = 0;
    const struct option *like = NULL;
    for (const struct option *o = longs; o->name != NULL && strncmp(word, "--", 2) == 0; o++)
        if (length > 2 && strncmp(o->name, word + 2, length - 2) == 0) {
            if (strlen(o->name) == length - 2)
                return cmd_usage_error(name, "--%s takes no value", o->name);
            like = o;
            n_like++;
        }
    if (n_like == 1)
        return cmd_usage_error(name, "--%s takes no value", like->name);
    return cmd_usage_error(name, "%s option '%s'", n_like > 1 ? "ambiguous" : "unknown", word);
}

/* A usage error if one of the inputs is empty, is the file of -o, which would be lost, or is
 * standard input a second time. */
static int check_files(const char *name, const cmd_common *common, const char *const *inputs,
                       size_t n, size_t *n_pipes)
{
    wt_error err = WT_ERROR_INIT;
    for (size_t i = 0; i < n; i++) {
        if (*inputs[i] == '\0')
            return cmd_usage_error(name, "a file name is empty");
        if (wt_guard_read(inputs[i], &err) != WT_OK)
            return cmd_fail(name, &err);
        if (common->output != NULL && wt_guard_write(common->output, &err) != WT_OK)
            return cmd_usage_error(name, "-o %s is also an input; give another name",
                                   common->output);
        *n_pipes += strcmp(inputs[i], "-") == 0;
        if (*n_pipes > 1)
            return cmd_usage_error(name, "- can stand for one input only");
    }
    return CMD_OK;
}

/* The names in the text, parted by its zero bytes or else by its lines; or their number alone. */
static size_t split_names(char *text, size_t length, const char **names)
{
    const char end = memchr(text, '\0', length) != NULL ? '\0' : '\n';
    size_t n = 0;
    for (char *p = text; p < text + length;) {
        char *stop = memchr(p, end, (size_t)(text + length - p));
        stop = stop != NULL ? stop : text + length;
        const bool is_line = end == '\n' && stop > p && stop[-1] == '\r';
        if (stop - is_line > p && names != NULL) {
            stop[-is_line] = '\0';
            names[n] = p;
        }
        n += stop - is_line > p;
        p = stop + 1;
    }
    return n;
}

/* The files of the call: its arguments and what --files-from names. */
static int list_files(const char *name, cmd_common *common, int n, char **arguments)
{
    wt_error err = WT_ERROR_INIT;
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    static char *text; /* both live until the next call, as the arguments do */
    static const char **files;
    size_t length = 0, n_names = 0;
    wt_status status = WT_OK;
    if (common->files_from != NULL) {
        status = wt_input_open(common->files_from, &input, &err);
        if (status == WT_OK)
            status = wt_input_bytes(input, &bytes, &length, &err);
        wt_error_file(&err, common->files_from);
    }
    free(text);
    free(files);
    files = NULL;
    text = status == WT_OK ? malloc(length + 1) : NULL;
    if (text != NULL) {
        if (length > 0)
            memcpy(text, bytes, length);
        text[length] = '\0';
        n_names = split_names(text, length, NULL);
        common->files = files = malloc(((size_t)n + n_names + 1) * sizeof *files);
    }
    wt_input_close(input);
    if (status == WT_OK && common->files == NULL)
        status = wt_fail(&err, WT_E_MEMORY, "out of memory");
    if (status != WT_OK)
        return cmd_fail(name, &err);
    for (int i = 0; i < n; i++)
        common->files[i] = arguments[i];
    common->n_files = (size_t)n + split_names(text, length, common->files + n);
    if (common->files_from != NULL && n_names == 0)
        return cmd_usage_error(name, "--files-from %s: it names no file", common->files_from);
    return CMD_OK;
}

/* The options as getopt wants them. */
static void list_for_getopt(const option_list *list, struct option *longs, char *letters)
{
    size_t n_letters = 0;
    letters[n_letters++] = ':';
    for (size_t i = 0; i < list->n; i++) {
        const option_row *row = &list->rows[i];
        const int argument = row->param->kind == PARAM_FLAG ? no_argument : required_argument;
        longs[i] = (struct option){row->name, argument, NULL, FIRST_CODE + (int)i};
        if (row->param->letter != 0) {
            letters[n_letters++] = row->param->letter;
            if (argument == required_argument)
                letters[n_letters++] = ':';
        }
    }
    letters[n_letters] = '\0';
    longs[list->n] = (struct option){NULL, 0, NULL, 0};
}

/* Sets all options; `inputs` [argc] gets the files among their values. */
static int parse_options(const cmd_usage *usage, const option_list *list, int argc, char **argv,
                         const char **inputs, size_t *n_inputs)
{
    struct option longs[MAX_OPTIONS + 1];
    char letters[2 * MAX_OPTIONS + 3];
    list_for_getopt(list, longs, letters);
    optind = 1;
    opterr = 0;
    int code, status = CMD_OK;
    while (status == CMD_OK && (code = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
        if (code == '?' || code == ':') {
            const char letter[] = {'-', (char)optopt, '\0'};
            const bool is_letter = optopt > 0 && optopt < FIRST_CODE;
            return bad_option(usage->name, longs, code, is_letter ? letter : argv[optind - 1]);
        }
        const option_row *row = NULL;
        for (size_t i = 0; i < list->n && row == NULL; i++)
            if (code == FIRST_CODE + (int)i ||
                (code < FIRST_CODE && code == list->rows[i].param->letter))
                row = &list->rows[i];
        status = set_option(usage->name, row, optarg);
        const char *value = row->param->value;
        if (value != NULL && (strcmp(value, "FILE") == 0 || strcmp(value, "R") == 0) &&
            strcmp(row->name, "output") != 0)
            inputs[(*n_inputs)++] = optarg;
    }
    return status;
}

bool cmd_parse(const cmd_usage *usage, cmd_part *parts, size_t n_parts, cmd_common *common,
               int argc, char **argv, int *first, int *status)
{
    option_list list = {.n = 0};
    char names[TEXT_SIZE];
    size_t n_inputs = 0, n_pipes = 0;
    const char **inputs = calloc((size_t)argc + 1, sizeof *inputs);
    snprintf(names, sizeof names, "%s quiet strict help", usage->common);
    cmd_part last = {common_params(), common, names, 0};
    for (size_t i = 0; i < n_parts; i++)
        add_part(&list, &parts[i]);
    add_part(&list, &last);
    if (inputs == NULL)
        cmd_say("weartrack %s: out of memory\n", usage->name);
    *status =
        inputs == NULL ? CMD_FAILED : parse_options(usage, &list, argc, argv, inputs, &n_inputs);
    if (*status == CMD_OK && common->help) {
        print_help(usage, &list);
        free(inputs);
        return false;
    }
    *first = optind;
    if (*status == CMD_OK)
        *status = list_files(usage->name, common, argc - optind, argv + optind);
    for (size_t i = 0; i < list.n && *status == CMD_OK; i++) {
        const option_row *row = &list.rows[i];
        if ((row->param->flags & PARAM_REQUIRED) != 0 &&
            (row->part->given & UINT64_C(1) << row->number) == 0)
            *status = cmd_usage_error(usage->name, "--%s is missing", row->name);
    }
    if (*status == CMD_OK)
        *status = check_files(usage->name, common, inputs, n_inputs, &n_pipes);
    if (*status == CMD_OK)
        *status = check_files(usage->name, common, common->files, common->n_files, &n_pipes);
    free(inputs);
    return *status == CMD_OK;
}
