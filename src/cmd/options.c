/* Options: one table per subcommand gives the parser and the help, so they cannot disagree.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <getopt.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

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
    char left[80];
    int used = o->letter != 0 ? snprintf(left, sizeof left, "  -%c, --%s", o->letter, o->name)
                              : snprintf(left, sizeof left, "      --%s", o->name);
    if (o->value != NULL && used > 0 && (size_t)used < sizeof left)
        snprintf(left + used, sizeof left - (size_t)used, " %s", o->value);
    if (strlen(left) > 28)
        printf("%s\n%30s%s\n", left, "", o->help);
    else
        printf("%-30s%s\n", left, o->help);
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
    if (*text < '0' || *text > '9')
        return false;
    unsigned long value = 0;
    for (const char *p = text; *p != '\0'; p++) {
        if (*p < '0' || *p > '9' || value > (1ul << 62) / 10)
            return false;
        value = value * 10 + (unsigned long)(*p - '0');
    }
    *out = value;
    return true;
}

/* Stores one value; an exit status other than CMD_OK when it is wrong. */
static int set_option(const char *name, const cmd_option *o, const char *text)
{
    wt_error err = WT_ERROR_INIT;
    wt_status status = WT_OK;
    switch (o->kind) {
    case CMD_FLAG:
        *(bool *)o->target = true;
        return CMD_OK;
    case CMD_TEXT:
        *(const char **)o->target = text;
        return CMD_OK;
    case CMD_LIST: {
        cmd_list *list = o->target;
        const char **grown = realloc((void *)list->items, (list->n + 1) * sizeof *grown);
        if (grown == NULL) {
            fprintf(stderr, "weartrack %s: out of memory\n", name);
            return CMD_FAILED;
        }
        grown[list->n++] = text;
        list->items = grown;
        return CMD_OK;
    }
    case CMD_QUANTITY:
        status = wt_quantity_parse(text, o->quantity, o->target, &err);
        break;
    case CMD_ESTIMATE:
        status = wt_estimate_parse(text, o->quantity, o->target, &err);
        break;
    case CMD_VALUES:
        cmd_values_free(o->target);
        status = wt_list_parse(text, o->quantity, &((cmd_values *)o->target)->values,
                               &((cmd_values *)o->target)->n, &err);
        break;
    case CMD_NUMBER:
        if (!wt_number_parse(text, strlen(text), '.', o->target))
            return cmd_usage_error(name, "--%s: '%s' is not a number", o->name, text);
        return CMD_OK;
    case CMD_COUNT:
        if (!parse_count(text, o->target))
            return cmd_usage_error(name, "--%s: '%s' is not a whole number", o->name, text);
        return CMD_OK;
    case CMD_CHOICE:
        if (!find_choice(o->value, text, o->target))
            return cmd_usage_error(name, "--%s: '%s' is none of %s", o->name, text, o->value);
        return CMD_OK;
    }
    if (status != WT_OK) {
        char line[1024];
        wt_error_format(&err, line, sizeof line);
        return cmd_usage_error(name, "--%s: %s", o->name, line);
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
            const char *word = argv[optind - 1];
            *status = code == ':' ? cmd_usage_error(usage->name, "%s needs a value", word)
                                  : cmd_usage_error(usage->name, "unknown option '%s'", word);
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
    return true;
}
