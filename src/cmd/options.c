/* Options: one table per subcommand gives the parser and the help, so they cannot disagree.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <getopt.h>
#include <limits.h>
#include <stdarg.h>
#include <string.h>
#include <sys/stat.h>

#include "cmd/cmd.h"

enum { MAX_OPTIONS = 64, FIRST_CODE = 256 };

void cmd_list_free(cmd_list *list)
{
    free((void *)list->items);
    list->items = NULL;
    list->n = 0;
}

void cmd_values_free(cmd_values *list)
{
    free(list->values);
    list->values = NULL;
    list->n = 0;
}

int cmd_usage_error(const char *name, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fprintf(stderr, "weartrack %s: ", name);
    vfprintf(stderr, format, args);
    fprintf(stderr, "; see weartrack %s --help\n", name);
    va_end(args);
    return CMD_USAGE;
}

static size_t common_options(unsigned bits, cmd_common *common, bool *help, cmd_option *out)
{
    size_t n = 0;
    if (bits & CMD_OPT_OUTPUT)
        out[n++] = (cmd_option){"output",
                                'o',
                                CMD_TEXT,
                                &common->output,
                                "FILE",
                                WT_Q_NONE,
                                "write there instead of standard output; - is standard output"};
    if (bits & CMD_OPT_FORMAT)
        out[n++] = (cmd_option){"format",
                                0,
                                CMD_TEXT,
                                &common->format,
                                "ID",
                                WT_Q_NONE,
                                "read the files as this format (see weartrack formats list)"};
    if (bits & CMD_OPT_FORMATS)
        out[n++] = (cmd_option){"formats",
                                0,
                                CMD_TEXT,
                                &common->formats,
                                "FOLDER",
                                WT_Q_NONE,
                                "use the format descriptions of this folder too"};
    if (bits & CMD_OPT_THREADS)
        out[n++] = (cmd_option){"threads",
                                0,
                                CMD_COUNT,
                                &common->threads,
                                "N",
                                WT_Q_NONE,
                                "threads to use; 0, the default, is one per processor"};
    if (bits & CMD_OPT_SEED)
        out[n++] = (cmd_option){"seed",
                                0,
                                CMD_COUNT,
                                &common->seed,
                                "N",
                                WT_Q_NONE,
                                "seed of the resampling behind the standard errors; default 1"};
    if (bits & CMD_OPT_PROVENANCE)
        out[n++] = (cmd_option){"no-provenance",
                                0,
                                CMD_FLAG,
                                &common->no_provenance,
                                NULL,
                                WT_Q_NONE,
                                "leave out version, command line and times"};
    out[n++] = (cmd_option){"quiet",
                            'q',
                            CMD_FLAG,
                            &common->quiet,
                            NULL,
                            WT_Q_NONE,
                            "no progress and no warnings on standard error"};
    out[n++] = (cmd_option){"help", 'h', CMD_FLAG, help, NULL, WT_Q_NONE, "print this"};
    return n;
}

static void print_option(const cmd_option *o)
{
    enum { HELP_COLUMN = 30 };
    int used =
        o->letter != 0 ? printf("  -%c, --%s", o->letter, o->name) : printf("      --%s", o->name);
    if (o->value != NULL)
        used += printf(" %s", o->value);
    if (used > HELP_COLUMN - 2)
        printf("\n%*s", HELP_COLUMN, "");
    else
        printf("%*s", HELP_COLUMN - used, "");
    cmd_wrap(stdout, HELP_COLUMN, HELP_COLUMN, o->help);
}

static void print_help(const cmd_usage *usage, const cmd_option *options, size_t n)
{
    printf("usage: weartrack %s %s\n\n%s\n\noptions:\n", usage->name, usage->arguments,
           usage->what);
    for (size_t i = 0; i < n; i++)
        print_option(&options[i]);
    if (usage->notes != NULL)
        printf("\n%s\n", usage->notes);
    printf("\nMore in weartrack-%s(1).\n", usage->name);
}

static bool find_choice(const char *choices, const char *text, int *out)
{
    int i = 0;
    const size_t length = strlen(text);
    for (const char *p = choices; *p != '\0'; i++) {
        const size_t word = strcspn(p, "|");
        if (word == length && strncmp(p, text, word) == 0) {
            *out = i;
            return true;
        }
        p += word;
        if (*p == '|')
            p++;
    }
    return false;
}

static bool parse_count(const char *text, unsigned long *out)
{
    unsigned long value = 0;
    for (const char *p = text; *p != '\0'; p++) {
        const unsigned long digit = (unsigned long)*p - '0';
        if (*p < '0' || *p > '9' || value > (ULONG_MAX - digit) / 10)
            return false;
        value = value * 10 + digit;
    }
    *out = value;
    return *text != '\0';
}

/* Says what the option expects, if the value is not that. */
static int check_limits(const char *name, const cmd_option *o, const char *text, double value)
{
    const char *expected = cmd_outside(o->name, value);
    if (expected == NULL)
        return CMD_OK;
    return cmd_usage_error(name, "--%s: out of range; expected %s; found %s", o->name, expected,
                           text);
}

static int append(const char *name, const cmd_option *o, const char *text)
{
    cmd_list *list = o->target;
    const char *equals = strchr(text, '=');
    if (strchr(o->value, '=') != NULL && (equals == NULL || equals == text || equals[1] == '\0'))
        return cmd_usage_error(name, "--%s: expected %s; found '%s'", o->name, o->value, text);
    const char **grown = realloc((void *)list->items, (list->n + 1) * sizeof *grown);
    if (grown == NULL) {
        fprintf(stderr, "weartrack %s: out of memory\n", name);
        return CMD_FAILED;
    }
    grown[list->n++] = text;
    list->items = grown;
    return CMD_OK;
}

static int set_values(const char *name, const cmd_option *o, const char *text, wt_error *err)
{
    cmd_values *list = o->target;
    cmd_values_free(list);
    if (wt_list_parse(text, o->quantity, &list->values, &list->n, err) != WT_OK)
        return CMD_USAGE;
    int status = CMD_OK;
    for (size_t i = 0; i < list->n && status == CMD_OK; i++)
        status = check_limits(name, o, text, list->values[i]);
    return status;
}

/* Stores one value; an exit status other than CMD_OK when it is wrong. */
static int set_option(const char *name, const cmd_option *o, const char *text)
{
    wt_error err = WT_ERROR_INIT;
    int status = CMD_OK;
    if (o->kind != CMD_FLAG && *text == '\0')
        return cmd_usage_error(name, "--%s: the value is empty", o->name);
    switch (o->kind) {
    case CMD_FLAG:
        *(bool *)o->target = true;
        break;
    case CMD_TEXT:
        *(const char **)o->target = text;
        break;
    case CMD_LIST:
        status = append(name, o, text);
        break;
    case CMD_QUANTITY:
        if (wt_quantity_parse(text, o->quantity, o->target, &err) == WT_OK)
            status = check_limits(name, o, text, *(double *)o->target);
        break;
    case CMD_ESTIMATE:
        if (wt_estimate_parse(text, o->quantity, o->target, &err) == WT_OK)
            status = check_limits(name, o, text, ((wt_estimate *)o->target)->value);
        break;
    case CMD_VALUES:
        status = set_values(name, o, text, &err);
        break;
    case CMD_NUMBER:
        if (!wt_number_parse(text, strlen(text), '.', o->target))
            status = cmd_usage_error(name, "--%s: '%s' is not a number", o->name, text);
        else
            status = check_limits(name, o, text, *(double *)o->target);
        break;
    case CMD_COUNT:
        if (!parse_count(text, o->target))
            status = cmd_usage_error(name, "--%s: '%s' is not a whole number, or too large",
                                     o->name, text);
        else
            status = check_limits(name, o, text, (double)*(unsigned long *)o->target);
        break;
    case CMD_CHOICE:
        if (!find_choice(o->value, text, o->target))
            status = cmd_usage_error(name, "--%s: '%s' is none of %s", o->name, text, o->value);
        break;
    }
    if (err.status != WT_OK) {
        char line[1024];
        wt_error_format(&err, line, sizeof line);
        status = cmd_usage_error(name, "--%s: %s", o->name, line);
    }
    return status;
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

bool cmd_same_file(const char *a, const char *b)
{
    struct stat one, other;
    return stat(a, &one) == 0 && S_ISREG(one.st_mode) && stat(b, &other) == 0 &&
           one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

/* A usage error if one of the inputs (NULL is skipped) is empty, is the file of -o, which would be
 * lost, or is standard input a second time. */
static int check_files(const char *name, const cmd_common *common, const char *const *inputs,
                       size_t n, size_t *n_pipes)
{
    for (size_t i = 0; i < n; i++) {
        if (inputs[i] == NULL)
            continue;
        if (*inputs[i] == '\0')
            return cmd_usage_error(name, "a file name is empty");
        if (common->output != NULL && cmd_same_file(common->output, inputs[i]))
            return cmd_usage_error(name, "-o %s is also an input; give another name",
                                   common->output);
        *n_pipes += strcmp(inputs[i], "-") == 0;
        if (*n_pipes > 1)
            return cmd_usage_error(name, "- can stand for one input only");
    }
    return CMD_OK;
}

bool cmd_parse(const cmd_usage *usage, const cmd_option *options, size_t n_options,
               cmd_common *common, int argc, char **argv, int *first, int *status)
{
    bool help = false;
    cmd_option all[MAX_OPTIONS];
    struct option longs[MAX_OPTIONS + 1];
    char letters[2 * MAX_OPTIONS + 3] = ":";
    size_t n_letters = 1;

    for (size_t i = 0; i < n_options; i++)
        all[i] = options[i];
    const size_t n = n_options + common_options(usage->common, common, &help, all + n_options);
    for (size_t i = 0; i < n; i++) {
        const int argument = all[i].kind == CMD_FLAG ? no_argument : required_argument;
        longs[i] = (struct option){all[i].name, argument, NULL, FIRST_CODE + (int)i};
        if (all[i].letter != 0) {
            letters[n_letters++] = all[i].letter;
            if (argument == required_argument)
                letters[n_letters++] = ':';
        }
    }
    letters[n_letters] = '\0';
    longs[n] = (struct option){NULL, 0, NULL, 0};

    *status = CMD_OK;
    optind = 1;
    opterr = 0;
    int code;
    while ((code = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
        if (code == '?' || code == ':') {
            const char letter[] = {'-', (char)optopt, '\0'};
            const bool is_letter = optopt > 0 && optopt < FIRST_CODE;
            *status = bad_option(usage->name, longs, code, is_letter ? letter : argv[optind - 1]);
            return false;
        }
        const cmd_option *chosen = NULL;
        for (size_t i = 0; i < n && chosen == NULL; i++)
            if (code == FIRST_CODE + (int)i || (code < FIRST_CODE && code == all[i].letter))
                chosen = &all[i];
        *status = set_option(usage->name, chosen, optarg);
        if (*status != CMD_OK)
            return false;
    }
    if (help) {
        print_help(usage, all, n);
        return false;
    }
    *first = optind;
    size_t n_pipes = 0;
    for (size_t i = 0; i < n && *status == CMD_OK; i++) {
        const cmd_option *o = &all[i];
        const bool is_file =
            o->value != NULL && (strcmp(o->value, "FILE") == 0 || strcmp(o->value, "R") == 0);
        if (!is_file || o->target == &common->output)
            continue;
        if (o->kind == CMD_TEXT)
            *status = check_files(usage->name, common, o->target, 1, &n_pipes);
        else if (o->kind == CMD_LIST) {
            const cmd_list *list = o->target;
            *status = check_files(usage->name, common, list->items, list->n, &n_pipes);
        }
    }
    if (*status == CMD_OK)
        *status = check_files(usage->name, common, (const char *const *)(argv + optind),
                              (size_t)(argc - optind), &n_pipes);
    return *status == CMD_OK;
}
