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

/* One call. */
typedef struct run_call {
    const char *path; /* of the case */
    cmd_common common;
    own_options own;
    wt_run_options run;
    wt_report_options report;
    wt_case *the_case;
    wt_table *plan;
    wt_parselog *log;
    wt_result *result;
    char *result_name, *folder_name;
    int said; /* what the remarks make of the exit status */
} run_call;

/* Everything that can be refused is refused before the work begins. */
static wt_status prepare(run_call *r, wt_error *err)
{
    r->result_name =
        r->common.output != NULL ? strdup(r->common.output) : default_name(r->path, ".h5");
    r->folder_name =
        r->own.report != NULL ? strdup(r->own.report) : default_name(r->path, "-report");
    r->log = wt_parselog_new();
    if (r->result_name == NULL || r->folder_name == NULL || r->log == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    wt_status status = wt_guard_write(r->result_name, err);
    if (status == WT_OK)
        status = wt_plan(r->the_case, &r->plan, err);
    if (status != WT_OK)
        return status;
    if (!any_stage(r->plan)) {
        wt_fail(err, WT_E_EMPTY, "nothing to do: the case gives no stage what it needs");
        wt_error_file(err, r->path);
        wt_error_advice(err, "`weartrack run --plan` says what each stage lacks");
        return WT_E_EMPTY;
    }
    r->report.with_provenance = r->common.provenance;
    return r->own.no_report ? WT_OK : wt_report_check(r->folder_name, &r->report, err);
}

static wt_status compute(run_call *r, size_t *n_failed, wt_error *err)
{
    cmd_progress progress;
    r->run.progress = cmd_progress_start(&progress, r->common.quiet);
    r->run.no_timing = !r->common.provenance;
    r->run.formats = r->common.formats;
    wt_status status = wt_run(r->the_case, &r->run, r->log, &r->result, n_failed, err);
    cmd_progress_end(&progress);
    r->said = cmd_say_log("run", &r->common, r->log, false);
    if (r->result != NULL && *n_failed > 0)
        cmd_print_failures("run", wt_result_find(r->result, "failures"));
    if (status == WT_OK)
        status = cmd_provenance(r->result, cmd_full_argc, cmd_full_argv, err);
    if (status == WT_OK)
        status = wt_store_write(r->result_name, r->result, r->common.provenance, err);
    return status;
}

static wt_status draw(run_call *r, wt_error *err)
{
    cmd_progress progress;
    r->run.progress = cmd_progress_start(&progress, r->common.quiet);
    cmd_catch_interruptions();
    wt_status status =
        wt_report_write(r->result, r->folder_name, &r->report, &r->run.progress, err);
    cmd_progress_end(&progress);
    if (status == WT_OK && !r->common.quiet)
        cmd_say("report page: %s/index.html\n", r->folder_name);
    return status;
}

static int run_case(run_call *r, bool style_given)
{
    wt_error err = WT_ERROR_INIT;
    size_t n_failed = 0;
    wt_status status = wt_case_read(r->path, &r->the_case, &err);
    if (status == WT_OK && r->own.plan) {
        status = wt_plan(r->the_case, &r->plan, &err);
        if (status != WT_OK)
            return cmd_fail("run", &err);
        print_plan(r->plan);
        return CMD_OK;
    }
    if (status == WT_OK && !style_given)
        r->report.style = wt_case_style(r->the_case);
    if (status == WT_OK)
        status = prepare(r, &err);
    if (status == WT_OK)
        status = compute(r, &n_failed, &err);
    if (status != WT_OK)
        return cmd_fail("run", &err);
    print_answer(r->result);
    fflush(stdout); /* it stands, whatever becomes of the pictures */
    if (!r->common.quiet)
        cmd_say("result: %s\n", r->result_name);
    if (!r->own.no_report && draw(r, &err) != WT_OK)
        return cmd_fail("run", &err);
    return n_failed > 0 ? CMD_FAILED : r->said;
}

int cmd_run(int argc, char **argv)
{
    static const cmd_usage usage = {
        "run", "[OPTION]... CASE.xml",
        "Runs a whole case: what the case asks for, and nothing else. The answer goes to standard\n"
        "output, the result to an HDF5 file and the figures to a report folder with one page.",
        "formats provenance",
        "--style replaces that of the case.\n"
        "Exit status 1 if a file of the case failed; the rest is answered all the same."};
    run_call r = {.common = cmd_common_defaults(),
                  .own = no_options(),
                  .run = wt_run_defaults(),
                  .report = wt_report_defaults()};
    cmd_part parts[] = {{output_params(), &r.common, NULL, 0},
                        {own_params(), &r.own, NULL, 0},
                        {wt_report_params(), &r.report, "style", 0},
                        {wt_run_params(), &r.run, NULL, 0}};
    int first = 0, status = CMD_OK;
    if (!cmd_parse(&usage, parts, sizeof parts / sizeof parts[0], &r.common, argc, argv, &first,
                   &status))
        return status;
    const char *output = r.common.output;
    const char *dot = output != NULL ? strrchr(wt_path_base(output), '.') : NULL;
    const int stem = dot != NULL ? (int)(dot - output) : output != NULL ? (int)strlen(output) : 0;
    if (argc - first != 1)
        return cmd_usage_error("run", "one case file is needed; %d given", argc - first);
    if (output != NULL && strcmp(output, "-") == 0)
        return cmd_usage_error("run", "-o -: the result is an HDF5 file; type -o case.h5 and then "
                                      "weartrack table case.h5 NAME");
    if (output != NULL && !cmd_is_store(output))
        return cmd_usage_error("run",
                               "-o %s: the result is an HDF5 file; type -o %.*s.h5 and then "
                               "weartrack table %.*s.h5 NAME -o %s",
                               output, stem, output, stem, output, output);
    r.path = argv[first];
    status = run_case(&r, cmd_given(&parts[2], "style"));
    free(r.result_name);
    free(r.folder_name);
    wt_table_free(r.plan);
    wt_result_free(r.result);
    wt_parselog_free(r.log);
    wt_case_free(r.the_case);
    return status;
}
