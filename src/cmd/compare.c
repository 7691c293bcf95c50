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

static wt_status read_group(const char *path, wt_result **tables, const wt_table **group,
                            wt_error *err)
{
    wt_status status = cmd_tables_read(path, tables, err);
    return status == WT_OK ? cmd_tables_find(*tables, path, "indentation/", "indent", group, err)
                           : status;
}

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
    wt_result *bulk = NULL, *track = NULL, *dma = NULL;
    cmd_session s = cmd_session_defaults();
    wt_rubber rubber = {0};
    wt_compare_tables tables = {0};

    if (!cmd_parse(&usage, parts, sizeof parts / sizeof parts[0], &common, argc, argv, &first,
                   &status))
        goto done;
    if (argc - first != 2) {
        status = cmd_usage_error("compare", "two files are needed, BULK and TRACK; %d given",
                                 argc - first);
        goto done;
    }
    status = cmd_begin(&s, "compare", &common, NULL);
    if (status != CMD_OK)
        goto done;
    wt_status made = read_group(argv[first], &bulk, &job.bulk, &err);
    if (made == WT_OK)
        made = read_group(argv[first + 1], &track, &job.track, &err);
    if (made == WT_OK && own.master != NULL) {
        made = cmd_tables_rubber(own.master, material.poisson_ratio, &dma, &rubber, &err);
        job.rubber = &rubber;
    }
    if (made == WT_OK)
        made = wt_compare_groups(&job, &s.work, &tables, &err);
    wt_table **const made_tables[] = {&tables.comparison, &tables.modulus_groups,
                                      &tables.modulus_rate, &tables.dma_comparison};
    status = cmd_finish(&s, made, made_tables, sizeof made_tables / sizeof made_tables[0], &err);
done:
    cmd_session_free(&s);
    wt_compare_tables_clear(&tables);
    wt_rubber_clear(&rubber);
    wt_result_free(bulk);
    wt_result_free(track);
    wt_result_free(dma);
    return status;
}
