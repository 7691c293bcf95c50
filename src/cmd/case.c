/* weartrack run, view, validate and accuracy: a case, its page and its comparisons.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"

#include "core/table/registry.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- run ------------------------------------------------------------------------------------- */

static bool plan_runs_stage(const wt_table *plan)
{
    for (size_t i = 0; i < wt_table_n_rows(plan); i++)
        if (wt_table_number(plan, i, PLAN_RUNS) > 0)
            return true;
    return false;
}

/* Prints the names of the stages that run, and the number of the others. */
static void print_plan_briefly(const wt_table *plan)
{
    enum { LINES_SHOWN = CMD_SCREEN_LINES - 4 };
    const size_t n = wt_table_n_rows(plan);
    size_t n_run = 0;
    for (size_t i = 0; i < n; i++)
        if (wt_table_number(plan, i, PLAN_RUNS) > 0 && n_run++ < LINES_SHOWN)
            printf("run     %s\n", wt_table_text(plan, i, PLAN_TITLE));
    if (n_run > LINES_SHOWN)
        printf("        and %zu more\n", n_run - LINES_SHOWN);
    printf("leave   %zu stages; reasons: --verbose\n", n - n_run);
}

static void print_plan(const wt_table *plan)
{
    enum { INDENT = 8 };
    for (size_t i = 0; i < wt_table_n_rows(plan); i++) {
        const bool does = wt_table_number(plan, i, PLAN_RUNS) > 0;
        printf("%-*s%s\n%*s", INDENT, does ? "run" : "leave", wt_table_text(plan, i, PLAN_TITLE),
               INDENT, "");
        cmd_wrap(stdout, INDENT, INDENT, wt_table_text(plan, i, PLAN_REASON));
    }
}

/* Lines that say where the result and the page are. */
enum { LINES_OF_PLACES = 2 };

/* Prints the findings on standard output, as they are the data of this subcommand. A pipe gets
 * their reasons and the limits, too; a terminal gets these with --verbose, and nothing with
 * --quiet. */
static void print_answer(cmd_session *s)
{
    const wt_table *const limits = wt_result_find(s->result, "limits");
    const bool verbose = s->common.verbose, is_pipe = isatty(STDOUT_FILENO) == 0,
               whole = verbose || is_pipe;
    if (s->common.quiet && !is_pipe)
        return;
    s->lines_left -= LINES_OF_PLACES;
    s->common.verbose = whole;
    cmd_print_short_table(s, true);
    s->common.verbose = verbose; /* of the warnings on standard error */
    for (size_t i = 0; limits != NULL && whole && i < wt_table_n_rows(limits); i++) {
        fputs(i == 0 ? "Limits\n  " : "  ", stdout);
        cmd_wrap(stdout, 2, 4, wt_table_text(limits, i, LIMITS_LIMIT));
    }
    fflush(stdout); /* the answer is complete even if drawing fails */
}

typedef struct run_flags {
    bool plan, no_report;
    const char *report;
} run_flags;

static const wt_param output_rows[] = {
    {PARAM_TEXT_OF("output", cmd_common_options, output), .value = "FILE", .letter = 'o',
     .unset = "the name of the case with .h5, in the current folder", .help = "the result, HDF5"},
};
PARAM_LOCAL_TABLE(output_params, cmd_common_options, output_rows, cmd_common_defaults, NO_PARTS)

static const wt_param run_flag_rows[] = {
    {PARAM_FLAG_OF("plan", run_flags, plan),
     .help = "only print which stages would run and why, and why the others would not"},
    {PARAM_TEXT_OF("report", run_flags, report), .value = "PLACE", .letter = 'r',
     .unset = "the name of the case with -report, in the current folder",
     .help = "place of the report: one page if the name ends in .html, else a folder; an existing "
             "report is replaced, and anything else is not"},
    {PARAM_FLAG_OF("no-report", run_flags, no_report), .help = "write no report"},
};
CMD_OPTIONS(run_flag_params, run_flags, run_flag_rows)

/* One call of weartrack run. */
typedef struct run_call {
    cmd_session s;
    run_flags call_flags;
    wt_run_options run;
    wt_report_options report;
    wt_case *case_file;
    wt_table *plan;
    char *result_name, *folder_name;
} run_call;

/* Makes all checks that can fail before the computation. */
static wt_status prepare_outputs(run_call *r)
{
    const char *path = r->s.files[0], *output = r->s.common.output;
    wt_error *err = &r->s.err;
    r->result_name = output != NULL ? wt_strdup(output) : cmd_default_name(path, ".h5");
    r->folder_name = r->call_flags.report != NULL
                         ? wt_strdup(r->call_flags.report)
                         : cmd_default_name(strcmp(path, "-") == 0 ? output : path, "-report");
    r->s.log = wt_log_new();
    if (wt_check_overwrite(r->result_name, err) != WT_OK)
        return err->status;
    if (!plan_runs_stage(r->plan)) {
        wt_fail(err, WT_E_EMPTY, "nothing to do: the case gives no stage what it needs");
        wt_error_file(err, path);
        wt_error_advice(err, "`weartrack run --plan` says what each stage lacks");
        return WT_E_EMPTY;
    }
    r->report.with_provenance = r->s.common.provenance;
    return r->call_flags.no_report ? WT_OK : wt_report_check(r->folder_name, &r->report, err);
}

static wt_status run_case_and_report(run_call *r)
{
    cmd_session *s = &r->s;
    size_t n_failed = 0;
    wt_status status = cmd_run_case(s, r->case_file, &r->run, &n_failed);
    if (status == WT_OK) {
        cmd_record_command(wt_result_provenance(s->result));
        status = wt_store_write(r->result_name, s->result, s->common.provenance, &s->err);
    }
    if (status == WT_OK)
        print_answer(s);
    if (s->result != NULL && n_failed > 0)
        cmd_print_failures(s, wt_result_find(s->result, "failures"));
    cmd_print_log(s, s->log, false);
    return status;
}

static wt_status draw_page(run_call *r)
{
    cmd_check_font(&r->s, r->report.font);
    r->run.progress = cmd_progress_start(&r->s);
    cmd_catch_interruptions();
    wt_status status =
        wt_report_write(r->s.result, r->folder_name, &r->report, &r->run.progress, &r->s.err);
    cmd_progress_end(&r->s);
    if (status == WT_OK && !r->s.common.quiet)
        cmd_print_page_location(r->folder_name);
    return status;
}

/* Uses the report options of the case unless the call sets them. */
static void apply_case_report_options(run_call *r, const cmd_option_group *given)
{
    const wt_report_options *const asked = wt_case_report_options(r->case_file);
    if (!cmd_option_is_set(given, "style"))
        r->report.style = asked->style;
    if (!cmd_option_is_set(given, "figures"))
        r->report.figures = asked->figures;
    if (!cmd_option_is_set(given, "width"))
        r->report.width = asked->width;
    if (!cmd_option_is_set(given, "font"))
        r->report.font = asked->font;
}

static wt_status run_whole_case(run_call *r, const cmd_option_group *report_given)
{
    struct stat info;
    const char *path = r->s.files[0];
    wt_status status = wt_case_read(path, &r->case_file, &r->s.err);
    if (status != WT_OK && stat(path, &info) == 0 && S_ISDIR(info.st_mode)) {
        wt_error_expected(&r->s.err, "a case file");
        wt_error_advice(&r->s.err, "`weartrack new-case %s -o case.xml` writes one for its files",
                        path);
    }
    if (status == WT_OK)
        status = wt_plan(r->case_file, &r->plan, &r->s.err);
    if (status == WT_OK && r->call_flags.plan) {
        if (cmd_shows_first_lines(&r->s))
            print_plan_briefly(r->plan);
        else
            print_plan(r->plan);
        return WT_OK;
    }
    if (status == WT_OK) {
        apply_case_report_options(r, report_given);
        status = prepare_outputs(r);
    }
    if (status == WT_OK)
        status = cmd_check_output(r->result_name, &r->s.err);
    if (status == WT_OK)
        status = run_case_and_report(r);
    if (status != WT_OK)
        return status;
    if (!r->s.common.quiet)
        cmd_message("result: %s\n", r->result_name);
    return r->call_flags.no_report ? WT_OK : draw_page(r);
}

static bool check_run_output(run_call *r)
{
    const char *output = r->s.common.output;
    const char *dot = output != NULL ? strrchr(wt_path_base(output), '.') : NULL;
    const int stem = dot != NULL ? (int)(dot - output) : output != NULL ? (int)strlen(output) : 0;
    if (output == NULL && strcmp(r->s.files[0], "-") == 0 && !r->call_flags.plan)
        return cmd_usage_error(&r->s, "a case from a pipe has no name for its result; give -o "
                                      "case.h5");
    if (output == NULL || cmd_is_hdf5_path(output))
        return true;
    if (strcmp(output, "-") == 0)
        return cmd_usage_error(&r->s, "-o -: the result is an HDF5 file; type -o case.h5 and then "
                                      "weartrack table case.h5 NAME");
    return cmd_usage_error(&r->s,
                           "-o %s: the result is an HDF5 file; type -o %.*s.h5 and then "
                           "weartrack table %.*s.h5 NAME -o %s",
                           output, stem, output, stem, output, output);
}

int cmd_run(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "run",
        .arguments = "[OPTION]... CASE.xml",
        .description =
            "Runs a whole case: what the case asks for, and nothing else. The answer goes to "
            "standard output, the result to an HDF5 file and the figures to a report folder "
            "with one page.",
        .common = "formats columns provenance",
        .notes = "--style, --figures, --width and --font replace those of the case.\n"
                 "Exit status 3 if a file or a stage of the case failed and the rest is answered, "
                 "1 if nothing is.",
        .n_files = 1,
        .files = "one case file is needed"};
    run_call r = {.s = cmd_session_defaults(),
                  .call_flags = {0},
                  .run = wt_run_defaults(),
                  .report = wt_report_defaults()};
    cmd_option_group parts[] = {{output_params(), &r.s.common, NULL, 0},
                                {run_flag_params(), &r.call_flags, NULL, 0},
                                {wt_report_params(), &r.report, "style figures width font", 0},
                                {wt_run_params(), &r.run, NULL, 0}};
    if (cmd_parse(&r.s, &usage, parts, COUNT_OF(parts), argc, argv) && check_run_output(&r) &&
        (r.s.common.n_columns == 0 || cmd_read_formats(&r.s)) &&
        run_whole_case(&r, &parts[2]) != WT_OK)
        cmd_fail(&r.s);
    free(r.result_name);
    free(r.folder_name);
    wt_table_free(r.plan);
    wt_case_free(r.case_file);
    return cmd_session_free(&r.s);
}

/* ---- view ------------------------------------------------------------------------------------ */

typedef struct view_flags {
    bool no_open;
} view_flags;

static const wt_param flag_rows[] = {
    {PARAM_FLAG_OF("no-open", view_flags, no_open),
     .help = "only print the address of the page, do not open it in a browser"},
};
CMD_OPTIONS(view_flag_params, view_flags, flag_rows)

/* Returns the path of this program, which the server starts for whole runs. */
static const char *own_path(char *path, size_t size)
{
    const ssize_t length = readlink("/proc/self/exe", path, size - 1);
    path[length > 0 ? length : 0] = '\0';
    return length > 0 ? path : "weartrack";
}

int cmd_view(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "view",
        .arguments = "[OPTION]... [FOLDER|CASE.xml|RESULT.h5|FILE...]",
        .description =
            "Opens a page in the browser on which a case is looked at and changed: its files, "
            "force curves with their fits, master curve, surface, friction and answer. The page "
            "edits the case file and its manual overrides and computes nothing; weartrack run "
            "gives the same numbers. Only this computer can reach the page, through the address "
            "that is printed. The program ends with the last page, or with Ctrl-C.",
        .common = "formats"};
    cmd_session s = cmd_session_defaults();
    wt_view_options options = wt_view_defaults();
    view_flags own = {0};
    char path[4096];
    wt_view *view = NULL;
    cmd_option_group parts[] = {{wt_view_params(), &options, NULL, 0},
                                {view_flag_params(), &own, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv))
        return cmd_session_free(&s);
    options.paths = s.files;
    options.n_paths = s.n_files;
    options.formats = s.common.formats;
    options.program = own_path(path, sizeof path);
    wt_status status = wt_view_open(&options, &view, &s.err);
    if (status == WT_OK) {
        printf("%s\n", wt_view_address(view));
        fflush(stdout);
        if (!own.no_open && !wt_view_show(view))
            cmd_message("weartrack view: no browser found; open the address by hand\n");
        s.common.quiet = true; /* serving has no progress */
        wt_progress progress = cmd_progress_start(&s);
        cmd_catch_interruptions();
        status = wt_view_serve(view, &progress, &s.err);
    }
    wt_view_close(view);
    cmd_progress_end(&s);
    if (status != WT_OK)
        cmd_fail(&s);
    return cmd_session_free(&s);
}

/* ---- validate -------------------------------------------------------------------------------- */

static wt_status run_validation_case(cmd_session *s, wt_run_options *run,
                                     const cmd_option_group *job)
{
    const cmd_case_tables requested = {
        .tables = "validation validation_running_in validation_course validation_sources wear",
        .main = "validation",
        .missing = "nothing could be compared with the record",
        .expected = "a case with a material, a counter surface and sliding conditions, "
                    "and a record",
        .records = job};
    const wt_status status = cmd_run_case_tables(s, &requested, run);
    return status == WT_OK && !cmd_shows_short_table(s) ? cmd_write_result(s) : status;
}

int cmd_validate(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "validate",
        .arguments = "[OPTION]... CASE.xml [RECORD]...",
        .description =
            "Does the theory explain the friction that was measured? Records of a tribometer, "
            "or results of weartrack record, are compared with what a case predicts at their "
            "velocities, with and without the layer: yes, no, or inconclusive; the "
            "shear stress that the record asks for; and where the error comes from.",
        .common = "output formats columns provenance",
        .notes = "Without a RECORD those of the case (<record>) are taken."};
    cmd_session s = cmd_session_defaults();
    wt_run_options run = wt_run_defaults();
    wt_validation_job job = wt_validation_job_defaults();
    cmd_option_group parts[] = {{wt_validation_job_params(), &job, NULL, 0},
                                {wt_run_params(), &run, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv))
        return cmd_session_free(&s);
    bool good = s.n_files > 0 || cmd_usage_error(&s, "one case file is needed");
    good = good && (s.common.n_columns == 0 || cmd_read_formats(&s));
    if (good) {
        s.log = wt_log_new();
        cmd_end(&s, run_validation_case(&s, &run, &parts[0]));
    }
    return cmd_session_free(&s);
}

/* ---- accuracy -------------------------------------------------------------------------------- */

static void print_text_keys(const cmd_session *s, const wt_table *table)
{
    for (size_t i = 0; i < wt_table_n_keys(table) && !s->common.quiet; i++) {
        const char *name = wt_table_key_name(table, i);
        wt_estimate number;
        if (!wt_table_estimate(table, name, &number))
            cmd_message("%s: %s\n", name, wt_table_key(table, name));
    }
}

/* Runs a case with requests for only its error budget and error against run time. */
static wt_status run_accuracy_case(cmd_session *s, wt_run_options *run)
{
    static const cmd_case_tables requested = {
        .tables = "error_budget work_precision",
        .main = "error_budget",
        .missing = "the case has no error budget",
        .expected = "a material, a counter surface and sliding conditions"};
    const wt_status status = cmd_run_case_tables(s, &requested, run);
    if (status == WT_OK && !cmd_is_brief(s)) {
        print_text_keys(s, wt_result_find(s->result, "error_budget"));
        if (wt_result_find(s->result, "work_precision") != NULL)
            print_text_keys(s, wt_result_find(s->result, "work_precision"));
    }
    return status == WT_OK && !cmd_shows_short_table(s) ? cmd_write_result(s) : status;
}

int cmd_accuracy(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "accuracy",
        .arguments = "CASE.xml [OPTION]...",
        .description = "Reports which error costs each number of a case most, what would make it "
                       "smaller, and the error against run time for several tolerances, numbers of "
                       "replicates and numbers of isotherms.",
        .common = "output formats columns provenance"};
    cmd_session s = cmd_session_defaults();
    wt_accuracy_job job = wt_accuracy_job_defaults();
    wt_run_options run = wt_run_defaults();
    cmd_option_group parts[] = {{wt_accuracy_job_params(), &job, NULL, 0},
                                {wt_run_params(), &run, NULL, 0}};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv))
        return cmd_session_free(&s);
    bool good = true;
    if (s.n_files != 1)
        good = cmd_usage_error(&s, "give the case file");
    good = good && (s.common.n_columns == 0 || cmd_read_formats(&s));
    if (good) {
        s.log = wt_log_new();
        run.precision = job;
        cmd_end(&s, run_accuracy_case(&s, &run));
    }
    return cmd_session_free(&s);
}
