/* Entry point of the command: finds the subcommand in the table and checks that the output was
 * written. SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <signal.h>
#include <string.h>

#include "cmd/cmd.h"
#include "core/base/text.h"

/* One table drives dispatch, --help and the tests. */
const cmd_command cmd_commands[] = {
    {"Files", NULL, NULL},
    {"info", cmd_info, "what a file is, what is in it, what is missing or odd"},
    {"convert", cmd_convert, "instrument file to an open one (text table or HDF5)"},
    {"formats", cmd_formats, "the formats that are understood; check a description"},
    {"Indentation", NULL, NULL},
    {"indent", cmd_indent, "contact point and modulus of every force curve"},
    {"spot", cmd_spot, "roughness of a spot against the depth; what stayed of an indentation"},
    {"sensitivity", cmd_sensitivity, "deflection sensitivity from curves on a hard surface"},
    {"compare", cmd_compare, "wear track against bulk"},
    {"Material and sliding", NULL, NULL},
    {"master", cmd_master, "shift factors, master curve, WLF and Prony series of DMA sweeps"},
    {"ramp", cmd_ramp, "glass transition and moduli of DMA temperature sweeps"},
    {"payne", cmd_payne, "softening with strain, of DMA strain sweeps"},
    {"psd", cmd_psd, "power spectrum of a surface, from height maps and profiles"},
    {"record", cmd_record, "friction and wear as a tribometer measured them"},
    {"friction", cmd_friction, "hysteresis friction and contact area against velocity"},
    {"layer", cmd_layer, "formation, wear, balance and thickness of the modified layer"},
    {"identify", cmd_identify, "critical energy and wear rate from a layer of known thickness"},
    {"Everything", NULL, NULL},
    {"new-case", cmd_new_case, "a commented case file from the files that there are"},
    {"run", cmd_run, "a whole case from one case file; --plan shows what it would do"},
    {"validate", cmd_validate, "whether a case explains friction as measured"},
    {"accuracy", cmd_accuracy, "error budget and error against run time of a case"},
    {"view", cmd_view, "a case in the browser: curves, master curve, friction; local only"},
    {"report", cmd_report, "plots and one page from a result file"},
    {"table", cmd_table, "a table of a result as TSV, CSV or JSON"},
    {"collect", cmd_collect, "cases of several samples and conditions side by side"},
    {"summary", cmd_summary, "one row for each of many results"},
    {NULL, NULL, NULL}};

static void print_main_help(FILE *out)
{
    fputs("usage: weartrack SUBCOMMAND [OPTION]... [FILE]...\n\n"
          "How does the rubber in a wear track differ from the bulk, and what does that\n"
          "do to friction? From the files the instruments export to one page that answers.\n",
          out);
    for (const cmd_command *c = cmd_commands; c->name != NULL; c++) {
        if (c->run == NULL)
            fprintf(out, "\n%s\n", c->name);
        else
            fprintf(out, "  %-11s %s\n", c->name, c->help);
    }
    fputs("\n  help        the same; `weartrack help SUBCOMMAND` for one of them\n\n"
          "options: --help, --version. Each subcommand has --help (and --help all) and a\n"
          "page weartrack-SUBCOMMAND(1). To begin: weartrack-tutorial(7).\n"
          "Exit status: 0 whole, 1 nothing usable or a fault, 2 usage error, 3 in part.\n",
          out);
}

/* Closes standard output. A full disk or a closed pipe is a failure. */
static int close_stdout(int status)
{
    if (fflush(stdout) != 0 || ferror(stdout) || fclose(stdout) != 0) {
        if (errno != EPIPE)
            cmd_message("weartrack: standard output: %s\n", strerror(errno));
        return status == CMD_OK ? CMD_FAILED : status;
    }
    return status;
}

static int dispatch(int argc, char **argv)
{
    const char *name = argv[0];
    spell_suggestion near = spell_suggestion_begin(name, strlen(name));
    /* what other programs call it */
    static const struct {
        const char *other, *name;
    } synonyms[] = {{"plot", "report"}, {"draw", "report"}, {"show", "info"}};
    for (size_t i = 0; i < COUNT_OF(synonyms); i++)
        if (strcmp(synonyms[i].other, name) == 0) {
            cmd_message("weartrack: there is no subcommand '%s'; it is called %s, see weartrack %s "
                        "--help\n",
                        name, synonyms[i].name, synonyms[i].name);
            return CMD_USAGE;
        }
    for (const cmd_command *c = cmd_commands; c->name != NULL; c++) {
        if (c->run != NULL && strcmp(c->name, name) == 0)
            return c->run(argc, argv);
        if (c->run != NULL)
            spell_suggestion_try(&near, c->name, strlen(c->name));
    }
    if (near.name != NULL)
        cmd_message(
            "weartrack: there is no subcommand '%s'; did you mean %s? See weartrack --help\n", name,
            near.name);
    else
        cmd_message("weartrack: there is no subcommand '%s'; see weartrack --help\n", name);
    return CMD_USAGE;
}

int main(int argc, char **argv)
{
    cmd_set_command_line(argc, argv);
    /* `weartrack ... | head` shall end quietly, also where a parent ignores the signal. */
    signal(SIGPIPE, SIG_DFL);
    wt_protect_begin();
    cmd_exit_on_allocation_failure();
    /* Standard error is line-buffered: one write per line. The buffer is static, as a message about
     * memory must not need any. */
    static char words[BUFSIZ];
    (void)setvbuf(stderr, words, _IOLBF, sizeof words);

    if (argc < 2) {
        print_main_help(stderr);
        return CMD_USAGE;
    }
    const char *word = argv[1];
    const bool help = strcmp(word, "help") == 0;
    char help_option[] = "--help";
    int status = CMD_OK;
    if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0)
        printf("weartrack %s\nLicence GPL-3.0-or-later. There is no warranty.\n", wt_version());
    else if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 ||
             (help &&
              (argc == 2 || strcmp(argv[2], "help") == 0 || strcmp(argv[2], "--help") == 0)))
        print_main_help(stdout);
    else if (help)
        status = dispatch(argc > 3 ? 3 : 2, (char *[]){argv[2], help_option, argv[3], NULL});
    else
        status = dispatch(argc - 1, argv + 1);
    if (wt_sandbox_limitations() !=
        NULL) /* about the system, not the data: no remark of a result */
        cmd_message("weartrack: warning: %s\n", wt_sandbox_limitations());
    status = close_stdout(status);
    const cmd_json_member last = {"status", NULL, (size_t)status};
    cmd_log_event("end", &last, 1);
    return status;
}
