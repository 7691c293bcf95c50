/* weartrack compare: wear track against bulk. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/tables.h"

typedef struct own_options {
    const char *master;
} own_options;

static own_options no_options(void)
{
    return (own_options){NULL};
}

static const wt_param rows[] = {
    {PARAM_TEXT_OF("master", own_options, master), .value = "FILE", .unset = "",
     .help = "output of weartrack master, to compare with DMA at the frequency of the indentation"},
};
PARAM_LOCAL_TABLE(own_params, own_options, rows, no_options, NO_PARTS)

int cmd_compare(int argc, char **argv)
{
    static const cmd_usage usage = {
        "compare", "[OPTION]... BULK TRACK",
        "Compares the moduli of the wear track with those of the bulk: ratio with 95 % interval,\n"
        "difference, Welch's and the Mann-Whitney test, effect size, and the same rate by rate. "
        "BULK\n"
        "and TRACK are outputs of weartrack indent; - is standard input.",
        "output provenance", NULL};
    cmd_common common = cmd_common_defaults();
    own_options own = no_options();
    wt_compare_job job = wt_compare_job_defaults();
    wt_master_job material = wt_master_job_defaults();
    cmd_part parts[] = {{own_params(), &own, NULL, 0},
                        {wt_compare_job_params(), &job, NULL, 0},
                        {wt_master_job_params(), &material, "poisson-ratio", 0}};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_result *bulk = NULL, *track = NULL, *dma = NULL, *result = NULL;
    wt_parselog *log = NULL;
    wt_rubber rubber = {0};
    wt_compare_tables tables = {0};
    wt_job work = wt_job_defaults();

    if (!cmd_parse(&usage, parts, sizeof parts / sizeof parts[0], &common, argc, argv, &first,
                   &status))
        goto done;
    if (argc - first != 2) {
        status = cmd_usage_error("compare", "two files are needed, BULK and TRACK; %d given",
                                 argc - first);
        goto done;
    }
    if (cmd_tables_read(argv[first], &bulk, &err) != WT_OK ||
        cmd_tables_find(bulk, argv[first], "indentation/", "indent", &job.bulk, &err) != WT_OK ||
        cmd_tables_read(argv[first + 1], &track, &err) != WT_OK ||
        cmd_tables_find(track, argv[first + 1], "indentation/", "indent", &job.track, &err) !=
            WT_OK)
        goto fail;
    if (own.master != NULL) {
        const wt_table *prony = NULL;
        if (cmd_tables_read(own.master, &dma, &err) != WT_OK ||
            cmd_tables_find(dma, own.master, "prony", "master", &prony, &err) != WT_OK ||
            wt_rubber_from_tables(prony, wt_result_find(dma, "shift_factors"),
                                  material.poisson_ratio, &rubber, &err) != WT_OK)
            goto fail;
        job.rubber = &rubber;
    }
    result = wt_result_new();
    work.log = log = wt_parselog_new();
    if (result == NULL || log == NULL) {
        wt_fail(&err, WT_E_MEMORY, "out of memory");
        goto fail;
    }
    if (wt_compare_groups(&job, &work, &tables, &err) != WT_OK)
        goto fail;
    wt_table **const made[] = {&tables.comparison, &tables.modulus_groups, &tables.modulus_rate,
                               &tables.dma_comparison};
    if (cmd_collect(result, made, sizeof made / sizeof made[0], &err) != WT_OK ||
        cmd_write(&common, result, &err) != WT_OK)
        goto fail;
    cmd_print_log("compare", log, false, common.quiet);
    goto done;
fail:
    cmd_print_log("compare", log, false, common.quiet);
    status = cmd_fail("compare", &err);
done:
    wt_parselog_free(log);
    wt_compare_tables_clear(&tables);
    wt_rubber_clear(&rubber);
    wt_result_free(bulk);
    wt_result_free(track);
    wt_result_free(dma);
    wt_result_free(result);
    return status;
}
