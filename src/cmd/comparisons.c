/* weartrack compare and collect: compares groups of curves, and results of cases.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/table_output.h"

#include <string.h>

/* ---- compare --------------------------------------------------------------------------------- */

/* A file: its tables, or the error that it has none. */
typedef struct compare_input {
    const char *path;
    wt_result *tables;
    wt_error failure;
} compare_input;

typedef struct compare_call {
    cmd_session s;
    wt_compare_job groups;
    wt_master_job master;
    wt_read_options read; /* sample of --master */
    compare_input *input; /* [s.n_files] */
} compare_call;

/* ---- groups of curves ------------------------------------------------------------------------ */

typedef struct compare_dma_options {
    const char *master;
} compare_dma_options;

static const wt_param rows[] = {
    {PARAM_TEXT_OF("master", compare_dma_options, master), .value = "FILE", .unset = "",
     .flags = PARAM_READ,
     .help = "output of weartrack master, to compare with DMA at the frequency of the indentation"},
};
CMD_OPTIONS(compare_dma_params, compare_dma_options, rows)

static const char *const names[2] = {"indentation/bulk", "indentation/track"};

static bool has_table_name(const wt_table *table, const char *name)
{
    return strcmp(wt_table_name(table), name) == 0;
}

/* Finds the table of the group, or else the first indentation table; a table of the track is no
 * bulk. */
static wt_status find_group_table(const compare_call *call, int g, const wt_table **table,
                                  wt_error *err)
{
    const compare_input *input = &call->input[g];
    if (input->tables == NULL) {
        *err = input->failure;
        if (err->status != WT_E_IO)
            wt_error_advice(err, "force curves go to `weartrack indent` first, bulk and track "
                                 "each: compare takes what it writes; a DMA goes to `weartrack "
                                 "master`, and its output to --master");
        return err->status;
    }
    const wt_status status =
        cmd_table_find(input->tables, input->path, "indentation/", "indent", table, err);
    if (status != WT_OK &&
        (cmd_tables_contain(input->tables, "prony") || cmd_tables_contain(input->tables, "sweep")))
        wt_error_advice(err, "materials are not compared any more: BULK and TRACK are outputs of "
                             "`weartrack indent`, and a DMA goes to --master");
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < wt_result_n_tables(input->tables); i++)
        if (has_table_name(wt_result_table(input->tables, i), names[g]))
            *table = wt_result_table(input->tables, i);
    const bool same = strcmp(call->input[0].path, call->input[1].path) == 0;
    if (!same && (g > 0 || !has_table_name(*table, names[1])))
        return WT_OK;
    wt_fail(err, WT_E_ARG, same ? "BULK and TRACK are one file" : "the first file is the track");
    wt_error_file(err, input->path);
    if (!same) {
        wt_error_expected(err, "the table of the bulk");
        wt_error_found(err, "'%s'", wt_table_name(*table));
    }
    wt_error_advice(err, "give the bulk first, then the track: compare BULK TRACK");
    return WT_E_ARG;
}

static void run_group_comparison(compare_call *call, const char *master)
{
    cmd_session *s = &call->s;
    wt_compare_job *job = &call->groups;
    wt_result *dma = NULL;
    wt_rubber rubber = {0};
    wt_compare_tables tables = {0};
    wt_status status = find_group_table(call, 0, &job->bulk, &s->err);
    if (status == WT_OK)
        status = find_group_table(call, 1, &job->track, &s->err);
    if (status == WT_OK && s->n_files > 2)
        status =
            wt_fail(&s->err, WT_E_ARG, "BULK and TRACK are two files, %zu are given", s->n_files);
    if (status == WT_OK && has_table_name(job->track, names[0]))
        wt_log_add(s->log, WT_WARNING, s->files[1], NULL,
                   "its curves are called bulk and are treated as those of the track; "
                   "`weartrack indent --group track` names them");
    if (status == WT_OK && master != NULL) {
        status = cmd_rubber_read(master, call->read.sample, call->master.poisson_ratio, &s->work,
                                 &dma, &rubber, &s->err);
        job->rubber = &rubber;
    }
    if (status == WT_OK)
        status = wt_compare_groups(job, &s->work, &tables, &s->err);
    wt_table *layer = NULL;
    if (status == WT_OK)
        status = wt_track_layer_compute(job, NULL, &s->work, &layer, &s->err);
    wt_table **const made_tables[] = {&tables.comparison,     &tables.modulus_groups,
                                      &tables.modulus_budget, &tables.modulus_rate,
                                      &tables.dma_comparison, &layer};
    cmd_finish(s, status, made_tables, COUNT_OF(made_tables));
    wt_rubber_clear(&rubber);
    wt_result_free(dma);
}

enum { PART_DMA, PART_GROUPS, PART_RUBBER, PART_READING, N_PARTS };

/* Rejects options that have no effect on this comparison. */
static bool check_compare_options(compare_call *call, bool master)
{
    const cmd_option_group *parts = call->s.parts;
    if (!master && parts[PART_RUBBER].given + parts[PART_READING].given != 0)
        return cmd_usage_error(&call->s, "--poisson-ratio and --sample are of --master");
    return true;
}

static bool fail_two_files(cmd_session *s)
{
    return cmd_usage_error(s, "two files are needed, BULK and TRACK; %zu given", s->n_files);
}

/* Reads the inputs. The content of a file decides its kind. */
static bool read_compare_inputs(compare_call *call)
{
    cmd_session *s = &call->s;
    if (s->n_files < 2)
        return fail_two_files(s);
    call->input = wt_alloc(s->n_files, sizeof *call->input);
    if (!cmd_begin(s))
        return false;
    for (size_t i = 0; i < s->n_files; i++) {
        compare_input *input = &call->input[i];
        input->path = s->files[i];
        const wt_tables_role role = {i == 0 ? "bulk" : "track", WT_ROLE_MATERIAL, NULL};
        if (wt_tables_read(input->path, input->path, &s->work, role, &input->tables,
                           &input->failure) != WT_OK)
            input->tables = NULL;
    }
    return true;
}

int cmd_compare(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "compare",
        .arguments = "[OPTION]... BULK TRACK",
        .description =
            "Compares the moduli of the wear track with those of the bulk: does it differ (yes, no "
            "or inconclusive), the ratio with its 95 % interval, Welch's and the Mann-Whitney "
            "test, "
            "effect size, and the same rate by rate. BULK and TRACK are outputs of weartrack "
            "indent; - is standard input.",
        .common = "output provenance",
        .first = "master indentation-temperature track-temperature cantilevers "
                 "spring-constant-error tip-error output",
        .master = "sample",
        .n_files = CMD_ONE_OR_MORE};
    compare_dma_options own = {0};
    compare_call call = {.s = cmd_session_defaults(),
                         .groups = wt_compare_job_defaults(),
                         .master = wt_master_job_defaults(),
                         .read = wt_read_defaults()};
    cmd_option_group parts[N_PARTS] = {
        [PART_DMA] = {compare_dma_params(), &own, NULL, 0},
        [PART_GROUPS] = {wt_compare_job_params(), &call.groups, NULL, 0},
        [PART_RUBBER] = {wt_master_job_params(), &call.master, "poisson-ratio", 0},
        [PART_READING] = {wt_read_params(), &call.read, "sample", 0}};
    if (cmd_parse(&call.s, &usage, parts, N_PARTS, argc, argv) && read_compare_inputs(&call) &&
        check_compare_options(&call, own.master != NULL))
        run_group_comparison(&call, own.master);
    for (size_t i = 0; call.input != NULL && i < call.s.n_files; i++)
        wt_result_free(call.input[i].tables);
    free(call.input);
    return cmd_session_free(&call.s);
}

/* ---- collect --------------------------------------------------------------------------------- */

/* Reads the results. A file that cannot be read is reported and skipped. Returns their number. */
static size_t read_collected_cases(cmd_session *s, wt_collected_result *cases, wt_result **results)
{
    const wt_progress *progress = &s->work.progress;
    size_t n = 0;
    for (size_t i = 0; i < s->n_files; i++) {
        const char *path = s->files[i];
        wt_result *result = NULL;
        if (progress->report != NULL)
            (void)progress->report(progress->user, "result", i + 1, s->n_files);
        wt_status read = wt_tables_read(
            path, path, &s->work,
            (wt_tables_role){NULL, WT_ROLE_RESULT, "what weartrack run wrote"}, &result, &s->err);
        if (read == WT_OK && wt_result_find(result, "answer") == NULL &&
            wt_result_find(result, "force_indentation") == NULL &&
            wt_result_find(result, "ramp") == NULL) {
            read = wt_fail(&s->err, WT_E_NOT_FOUND,
                           "this is no result of a case, and no curve of it has a modulus");
            wt_error_file(&s->err, path);
            wt_error_advice(&s->err, "give what weartrack run wrote or, for moduli against "
                                     "temperature, weartrack ramp; beside it, weartrack indent "
                                     "with --curves median; a hard particle needs a stiff "
                                     "cantilever for a modulus");
        }
        if (read != WT_OK) {
            wt_error_file(&s->err, path);
            cmd_report_failure(s);
            wt_result_free(result);
            continue;
        }
        cmd_apply_strict(s, path, cmd_count_remarks(result));
        results[n] = result;
        cases[n++] = (wt_collected_result){result, path};
    }
    return n;
}

int cmd_collect(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "collect",
        .arguments = "[OPTION]... RESULT...",
        .description =
            "Sets the results of cases side by side by their <sample> and <condition>: modulus "
            "of bulk and track against the indentation rate, friction against velocity, and "
            "whether the track of one condition or sample is more different from its bulk than "
            "that of another, corrected for the number of pairs. RESULT may be an output of "
            "weartrack indent, too, such as that of a particle of the filler, whose curve stands "
            "beside, or of weartrack ramp, whose moduli stand in one picture with those of "
            "others.",
        .common = "output files-from provenance",
        .notes = "The tables collection, collected_modulus, collected_friction, collected_ramp, "
                 "collected_force and ratio_pairs follow one another; weartrack report draws "
                 "them.",
        .n_files = CMD_ONE_OR_MORE,
        .files = "no result given"};
    wt_collect_job job = wt_collect_job_defaults();
    cmd_option_group part = {wt_collect_job_params(), &job, NULL, 0};
    cmd_session s = cmd_session_defaults();
    wt_collection_tables tables = {0};
    if (!cmd_parse(&s, &usage, &part, 1, argc, argv) || !cmd_begin(&s))
        return cmd_session_free(&s);
    wt_collected_result *cases = wt_alloc(s.n_files, sizeof *cases);
    wt_result **results = wt_alloc(s.n_files, sizeof *results);
    const size_t n = read_collected_cases(&s, cases, results);
    wt_status status = WT_OK;
    if (n == 0) {
        s.status = CMD_FAILED;
        cmd_end(&s, WT_OK);
    } else
        status = wt_collection_compute(cases, n, &job, &tables, &s.err);
    wt_table **const made_tables[] = {&tables.collection,         &tables.collected_modulus,
                                      &tables.collected_friction, &tables.collected_ramp,
                                      &tables.collected_force,    &tables.ratio_pairs};
    if (n > 0 || status != WT_OK)
        cmd_finish(&s, status, made_tables, COUNT_OF(made_tables));
    for (size_t i = 0; i < n; i++)
        wt_result_free(results[i]);
    free(results);
    free(cases);
    return cmd_session_free(&s);
}
