/* Computes a case again: the stages before what has changed run once for their sections.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/run/refit.h"

#include "case/run/stage_functions.h"
#include "core/base/memory.h"
#include "job/inputs.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct case_refit {
    const wt_formats *formats;
    wt_case *c;   /* case of the material, which borrows from it */
    flow_run run; /* with the material */
    bool has_material;
    wt_single_curve one; /* the last curve, which is kept in memory */
    char *file, *group;  /* its file; text of the section of its group */
    flow_kept kept;      /* rubber and surface of the last run */
    char *kept_for;      /* sections and files that they are from */
};

case_refit *case_refit_new(const wt_formats *formats)
{
    case_refit *refit = wt_alloc(1, sizeof *refit);
    *refit = (case_refit){.formats = formats};
    return refit;
}

static void forget_curve(case_refit *refit)
{
    wt_force_curve_clear(&refit->one.curve);
    free(refit->file);
    free(refit->group);
    refit->file = refit->group = NULL;
    refit->one = (wt_single_curve){0};
}

void case_refit_forget(case_refit *refit)
{
    flow_run_clear(&refit->run);
    wt_case_free(refit->c);
    refit->c = NULL;
    refit->has_material = false;
    forget_curve(refit);
    flow_kept_clear(&refit->kept);
}

void case_refit_free(case_refit *refit)
{
    if (refit != NULL)
        case_refit_forget(refit);
    if (refit != NULL)
        free(refit->kept_for);
    free(refit);
}

/* Returns a copy of the text of a section. It is "" if there is none. */
static char *copy_section(const wt_case *c, const char *name)
{
    char begin[32], end[32];
    (void)snprintf(begin, sizeof begin, "<%s", name);
    (void)snprintf(end, sizeof end, "</%s>", name);
    const char *from = memmem(c->xml, c->xml_length, begin, strlen(begin));
    const size_t left = from != NULL ? c->xml_length - (size_t)(from - c->xml) : 0;
    const char *to = from != NULL ? memmem(from, left, end, strlen(end)) : NULL;
    return wt_strndup(from != NULL ? from : "", to != NULL ? (size_t)(to - from) : 0);
}

static bool has_same_material(const wt_case *a, const wt_case *b)
{
    char *of_a = copy_section(a, "dma"), *of_b = copy_section(b, "dma");
    const bool same = strcmp(of_a, of_b) == 0;
    free(of_a);
    free(of_b);
    return same;
}

/* Keeps the last curve if the same one of the same files is requested. */
static void choose_curve(case_refit *refit, const wt_case *c, const refit_curve *which)
{
    char *group = copy_section(c, which->group);
    if (refit->file == NULL || strcmp(refit->file, which->file) != 0 ||
        refit->one.index != which->curve || strcmp(refit->group, group) != 0) {
        forget_curve(refit);
        refit->file = wt_strdup(which->file);
        refit->group = wt_strdup(group);
        refit->one.file = refit->file;
        refit->one.index = which->curve;
    }
    free(group);
}

static wt_job refit_work(const case_refit *refit, wt_log *log)
{
    wt_job work = wt_job_defaults();
    work.formats = refit->formats;
    work.log = log;
    work.left_out = WT_EXTRA_ALL;
    return work;
}

/* Computes the material that the fit of the curves uses. Without one each curve has the modulus of
 * its own rate, as in a run whose DMA stage fails. */
static void find_material(case_refit *refit, const flow_plan *plan, wt_log *log)
{
    static const flow_stage_id stages[] = {FLOW_STAGE_MASTER_CURVE, FLOW_STAGE_GIVEN_MATERIAL};
    wt_status (*const steps[])(flow_run *, wt_error *) = {flow_step_master,
                                                          flow_step_given_material};
    refit->run = (flow_run){.c = refit->c, .job = refit_work(refit, log), .plan = *plan};
    for (size_t i = 0; i < COUNT_OF(stages) && !refit->has_material; i++)
        if (plan->chosen[stages[i]])
            refit->has_material = steps[i](&refit->run, NULL) == WT_OK;
}

wt_status case_refit_curve(case_refit *refit, const char *xml, size_t length, const char *path,
                           const refit_curve *which, wt_log *log, wt_indent_tables *tables,
                           wt_error *err)
{
    static const char *const samples[] = {"all"};
    const int g = strcmp(which->group, "track") == 0;
    const flow_stage_id stage = g ? FLOW_STAGE_INDENTATION_TRACK : FLOW_STAGE_INDENTATION_BULK;
    wt_case *c = NULL;
    flow_run run = {0};
    uint64_t given = 0;
    wt_status status = case_from_bytes(xml, length, path, &c, err);
    if (status != WT_OK)
        return status;
    flow_plan_create(c, &run.plan);
    if (refit->c == NULL || !has_same_material(refit->c, c)) {
        case_refit_forget(refit);
        status = case_from_bytes(xml, length, path, &refit->c, err);
        if (status == WT_OK)
            find_material(refit, &run.plan, log);
    }
    if (status == WT_OK) {
        run.c = c;
        run.job = refit_work(refit, log);
        run.job.threads = 1;
        run.rubber = refit->run.rubber; /* borrowed */
        run.level = refit->has_material ? run.plan.level[stage] : 0;
        wt_indent_job job = flow_group_job(&run, g);
        choose_curve(refit, c, which);
        job.only = &refit->one;
        job.median_curve = false;
        job.curves = samples;
        job.n_curves = COUNT_OF(samples);
        if (which->option[0] != '\0')
            status = wt_params_set(wt_indent_params(), which->option, &job.options, which->value,
                                   &given, err);
        if (status == WT_OK)
            status = wt_indent_group(&job, &run.job, tables, err);
    }
    wt_case_free(c);
    return status;
}

/* ---- the whole case -------------------------------------------------------------------------- */

/* Appends size and time of each file of a role. */
static void append_files(FILE *to, const case_files *role, const wt_job *work)
{
    flow_files files = {0};
    struct stat state;
    /* A pattern without a file is an error, which the run reports. */
    if (flow_files_list(role->sets, role->n, work, &files, NULL) == WT_OK)
        for (size_t i = 0; i < files.n; i++)
            if (stat(files.file[i].path, &state) == 0)
                (void)fprintf(to, "%s %lld %lld %ld\n", files.file[i].path,
                              (long long)state.st_size, (long long)state.st_mtim.tv_sec,
                              state.st_mtim.tv_nsec);
    flow_files_clear(&files);
}

/* Returns a text that changes with the sections and the files of rubber and surface. */
static char *describe_kept(const case_refit *refit, const wt_case *c)
{
    static const char *const sections[] = {"dma", "roughness"};
    char *bytes = NULL;
    size_t length = 0;
    const wt_job work = refit_work(refit, NULL);
    FILE *stream = text_stream_open(&bytes, &length);
    for (size_t i = 0; i < COUNT_OF(sections); i++) {
        char *text = copy_section(c, sections[i]);
        (void)fprintf(stream, "%s\n", text);
        free(text);
    }
    append_files(stream, &c->dma, &work);
    append_files(stream, &c->height_maps, &work);
    text_stream_close(stream);
    return bytes;
}

wt_status case_refit_run(case_refit *refit, const char *xml, size_t length, const char *path,
                         const char *tables, const wt_run_options *options, wt_result **result,
                         wt_error *err)
{
    wt_case *c = NULL;
    wt_status status = case_from_bytes(xml, length, path, &c, err);
    if (status == WT_OK)
        status = wt_case_request_tables(c, tables, err);
    if (status == WT_OK) {
        char *of = describe_kept(refit, c);
        if (refit->kept_for == NULL || strcmp(refit->kept_for, of) != 0)
            flow_kept_clear(&refit->kept);
        free(refit->kept_for);
        refit->kept_for = of;
        /* the draws of the rubber are not kept */
        status = flow_run_case(c, options, options->replicates < 2 ? &refit->kept : NULL, NULL,
                               result, NULL, err);
    }
    wt_case_free(c);
    return status;
}
