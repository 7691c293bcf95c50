/* weartrack compare: wear track against bulk. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "cmd/tables.h"

int cmd_compare(int argc, char **argv)
{
    cmd_common common = CMD_COMMON_DEFAULTS;
    const char *master = NULL;
    double temperature = (double)NAN, poisson_ratio = 0.5;
    const cmd_option options[] = {
        {"master", 0, CMD_TEXT, &master, "FILE", WT_Q_NONE,
         "output of weartrack master, to compare with DMA at the frequency of the indentation"},
        {"temperature", 0, CMD_QUANTITY, &temperature, "T", WT_Q_TEMPERATURE,
         "of the indentation, such as 23degC; default: the reference of the master curve"},
        {"poisson-ratio", 0, CMD_NUMBER, &poisson_ratio, "NU", WT_Q_NONE,
         "of the rubber, to go from shear to tension; default 0.5"}};
    const cmd_usage usage = {
        "compare", "[OPTION]... BULK TRACK",
        "Compares the moduli of the wear track with those of the bulk: ratio with 95 % interval,\n"
        "difference, Welch's and the Mann-Whitney test, effect size, and the same rate by rate. "
        "BULK\n"
        "and TRACK are outputs of weartrack indent; - is standard input.",
        CMD_OPT_OUTPUT | CMD_OPT_PROVENANCE, NULL};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_result *bulk = NULL, *track = NULL, *dma = NULL, *result = NULL;
    wt_parselog *log = NULL;
    wt_rubber rubber = {0};
    wt_compare_tables tables = {0};
    wt_compare_job job = wt_compare_job_defaults();
    wt_job work = wt_job_defaults();

    if (!cmd_parse(&usage, options, sizeof options / sizeof options[0], &common, argc, argv, &first,
                   &status))
        goto done;
    if (argc - first != 2) {
        status = cmd_usage_error("compare", "two files are needed, BULK and TRACK; %d given",
                                 argc - first);
        goto done;
    }
    job.temperature = temperature;
    if (cmd_tables_read(argv[first], &bulk, &err) != WT_OK ||
        cmd_tables_find(bulk, argv[first], "indentation/", "indent", &job.bulk, &err) != WT_OK ||
        cmd_tables_read(argv[first + 1], &track, &err) != WT_OK ||
        cmd_tables_find(track, argv[first + 1], "indentation/", "indent", &job.track, &err) !=
            WT_OK)
        goto fail;
    if (master != NULL) {
        const wt_table *prony = NULL;
        if (cmd_tables_read(master, &dma, &err) != WT_OK ||
            cmd_tables_find(dma, master, "prony", "master", &prony, &err) != WT_OK ||
            wt_rubber_from_tables(prony, wt_result_find(dma, "shift_factors"), poisson_ratio,
                                  &rubber, &err) != WT_OK)
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
    wt_table **const parts[] = {&tables.comparison, &tables.modulus_groups, &tables.modulus_rate,
                                &tables.dma_comparison};
    if (cmd_collect(result, parts, sizeof parts / sizeof parts[0], &err) != WT_OK ||
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
