/* weartrack run: a whole case. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/cmd.h"

static bool any_stage(const wt_table *plan)
{
    const long runs = wt_table_find(plan, "runs");
    for (size_t i = 0; i < wt_table_n_rows(plan); i++)
        if (wt_table_number(plan, i, (size_t)runs) > 0)
            return true;
    return false;
}

static void print_plan(const wt_table *plan)
{
    enum { INDENT = 8 };
    const long title = wt_table_find(plan, "title"), runs = wt_table_find(plan, "runs");
    const long because = wt_table_find(plan, "because");
    for (size_t i = 0; i < wt_table_n_rows(plan); i++) {
        const bool does = wt_table_number(plan, i, (size_t)runs) > 0;
        printf("%-*s%s\n%*s", INDENT, does ? "run" : "leave", wt_table_text(plan, i, (size_t)title),
               INDENT, "");
        cmd_wrap(stdout, INDENT, INDENT, wt_table_text(plan, i, (size_t)because));
    }
}

/* The answer is the data of this subcommand: it goes to standard output. */
static void print_answer(const wt_result *result)
{
    const wt_table *answer = wt_result_find(result, "answer");
    if (answer == NULL)
        return;
    const long question = wt_table_find(answer, "question"), text = wt_table_find(answer, "answer");
    const char *last = "";
    for (size_t i = 0; i < wt_table_n_rows(answer); i++) {
        const char *q = wt_table_text(answer, i, (size_t)question);
        if (strcmp(q, last) != 0)
            printf("%s%s\n", i > 0 ? "\n" : "", q);
        last = q;
        fputs("  ", stdout);
        cmd_wrap(stdout, 2, 4, wt_table_text(answer, i, (size_t)text));
    }
}

/* "case/road.xml" -> "road" + ending, in the current folder. */
static char *default_name(const char *path, const char *ending)
{
    const char *base = wt_path_base(path);
    const char *dot = strrchr(base, '.');
    const size_t stem = dot != NULL && dot != base ? (size_t)(dot - base) : strlen(base);
    char *name = malloc(stem + strlen(ending) + 1);
    if (name != NULL) {
        memcpy(name, base, stem);
        memcpy(name + stem, ending, strlen(ending) + 1);
    }
    return name;
}

typedef struct own_options {
    bool plan, no_report;
    const char *report;
} own_options;

static own_options no_options(void)
{
    return (own_options){false, false, NULL};
}

static const wt_param output_rows[] = {
    {PARAM_TEXT_OF("output", cmd_common, output), .value = "FILE", .letter = 'o',
     .unset = "the name of the case with .h5, in the current folder", .help = "the result, HDF5"},
};
PARAM_LOCAL_TABLE(output_params, cmd_common, output_rows, cmd_common_defaults, NO_PARTS)

static const wt_param own_rows[] = {
    {PARAM_FLAG_OF("plan", own_options, plan),
     .help = "only say which stages would run and why, and why the others would not"},
    {PARAM_TEXT_OF("report", own_options, report), .value = "FOLDER", .letter = 'r',
     .unset = "the name of the case with -report, in the current folder",
     .help = "where the report goes; a report that is there is replaced, another folder is not"},
    {PARAM_FLAG_OF("no-report", own_options, no_report), .help = "write no report"},
};
PARAM_LOCAL_TABLE(own_params, own_options, own_rows, no_options, NO_PARTS)

int cmd_run(int argc, char **argv)
{
    static const cmd_usage usage = {
        "run", "[OPTION]... CASE.xml",
        "Runs a whole case: what the case asks for, and nothing else. The answer goes to standard\n"
        "output, the result to an HDF5 file and the figures to a report folder with one page.",
        "formats provenance",
        "--style replaces that of the case.\n"
        "Exit status 1 if a file of the case failed; the rest is answered all the same."};
    cmd_common common = cmd_common_defaults();
    own_options own = no_options();
    wt_run_options run_options = wt_run_defaults();
    wt_report_options report_options = wt_report_defaults();
    cmd_part parts[] = {{output_params(), &common, NULL, 0},
                        {own_params(), &own, NULL, 0},
                        {wt_report_params(), &report_options, "style", 0},
                        {wt_run_params(), &run_options, NULL, 0}};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_case *the_case = NULL;
    wt_parselog *log = NULL;
    wt_result *result = NULL;
    wt_table *plan = NULL;
    char *result_name = NULL, *folder_name = NULL;
    size_t n_failed = 0;

    if (!cmd_parse(&usage, parts, sizeof parts / sizeof parts[0], &common, argc, argv, &first,
                   &status))
        goto done;
    if (argc - first != 1) {
        status = cmd_usage_error("run", "one case file is needed; %d given", argc - first);
        goto done;
    }
    const char *path = argv[first];
    if (wt_case_read(path, &the_case, &err) != WT_OK)
        goto fail;
    if (own.plan) {
        if (wt_plan(the_case, &plan, &err) != WT_OK)
            goto fail;
        print_plan(plan);
        goto done;
    }
    result_name = common.output != NULL ? strdup(common.output) : default_name(path, ".h5");
    folder_name = own.report != NULL ? strdup(own.report) : default_name(path, "-report");
    log = wt_parselog_new();
    if (result_name == NULL || folder_name == NULL || log == NULL) {
        wt_fail(&err, WT_E_MEMORY, "out of memory");
        goto fail;
    }
    if (strcmp(result_name, "-") == 0) {
        status = cmd_usage_error("run", "the result is an HDF5 file and cannot go to a pipe");
        goto done;
    }
    if (!cmd_is_store(result_name)) {
        status = cmd_usage_error(
            "run", "-o %s: the result is an HDF5 file; its name must end in .h5", result_name);
        goto done;
    }
    if (wt_plan(the_case, &plan, &err) != WT_OK)
        goto fail;
    if (!any_stage(plan)) {
        wt_fail(&err, WT_E_EMPTY, "nothing to do: the case gives no stage what it needs");
        wt_error_file(&err, path);
        wt_error_advice(&err, "`weartrack run --plan` says what each stage lacks");
        goto fail;
    }
    if (!cmd_given(&parts[2], "style"))
        report_options.style = wt_case_style(the_case);
    report_options.with_provenance = common.provenance;
    if (!own.no_report && wt_report_check(folder_name, &report_options, &err) != WT_OK)
        goto fail;
    cmd_progress progress;
    run_options.progress = cmd_progress_start(&progress, common.quiet);
    run_options.no_timing = !common.provenance;
    run_options.formats = common.formats;
    const wt_status ran = wt_run(the_case, &run_options, log, &result, &n_failed, &err);
    cmd_progress_end(&progress);
    cmd_print_log("run", log, false, common.quiet);
    if (result != NULL && n_failed > 0) {
        cmd_print_failures("run", wt_result_find(result, "failures"));
        status = CMD_FAILED;
    }
    if (ran != WT_OK)
        goto fail;
    if (cmd_provenance(result, cmd_full_argc, cmd_full_argv, &err) != WT_OK ||
        cmd_check_output(result_name, result, &err) != WT_OK ||
        wt_store_write(result_name, result, common.provenance, &err) != WT_OK)
        goto fail;
    print_answer(result);
    fflush(stdout); /* it stands, whatever becomes of the pictures */
    if (!common.quiet)
        fprintf(stderr, "result: %s\n", result_name);
    if (!own.no_report) {
        run_options.progress = cmd_progress_start(&progress, common.quiet);
        cmd_catch_interruptions();
        const wt_status drawn =
            wt_report_write(result, folder_name, &report_options, &run_options.progress, &err);
        cmd_progress_end(&progress);
        if (drawn != WT_OK)
            goto fail;
        if (!common.quiet)
            fprintf(stderr, "report page: %s/index.html\n", folder_name);
    }
    goto done;
fail:
    status = cmd_fail("run", &err);
done:
    free(result_name);
    free(folder_name);
    wt_table_free(plan);
    wt_result_free(result);
    wt_parselog_free(log);
    wt_case_free(the_case);
    return status;
}
