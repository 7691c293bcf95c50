/* weartrack compare: wear track against bulk. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/tables.h"

typedef struct own_options {
    const char *master;
} own_options;

static const wt_param rows[] = {
    {PARAM_TEXT_OF("master", own_options, master), .value = "FILE", .unset = "",
     .help = "output of weartrack master, to compare with DMA at the frequency of the indentation"},
};
CMD_OPTIONS(own_params, own_options, rows)

int cmd_compare(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "compare",
        .arguments = "[OPTION]... BULK TRACK",
        .what =
            "Compares the moduli of the wear track with those of the bulk: ratio with 95 % "
            "interval, difference, Welch's and the Mann-Whitney test, effect size, and the same "
            "rate by rate. BULK and TRACK are outputs of weartrack indent; - is standard input.",
        .common = "output provenance",
        .n_files = 2,
        .files = "two files are needed, BULK and TRACK"};
    own_options own = {0};
    wt_compare_job job = wt_compare_job_defaults();
    wt_master_job material = wt_master_job_defaults();
    cmd_part parts[] = {{own_params(), &own, NULL, 0},
                        {wt_compare_job_params(), &job, NULL, 0},
                        {wt_master_job_params(), &material, "poisson-ratio", 0}};
    cmd_session s = cmd_session_defaults();
    wt_result *bulk = NULL, *track = NULL, *dma = NULL;
    wt_rubber rubber = {0};
    wt_compare_tables tables = {0};
    if (!cmd_parse(&s, &usage, parts, COUNT_OF(parts), argc, argv) || !cmd_begin(&s))
        goto done;
    wt_status made = cmd_table_read(s.files[0], "indentation/", "indent", &bulk, &job.bulk, &s.err);
    if (made == WT_OK)
        made = cmd_table_read(s.files[1], "indentation/", "indent", &track, &job.track, &s.err);
    if (made == WT_OK && own.master != NULL) {
        made = cmd_rubber_read(own.master, material.poisson_ratio, &dma, &rubber, &s.err);
        job.rubber = &rubber;
    }
    if (made == WT_OK)
        made = wt_compare_groups(&job, &s.work, &tables, &s.err);
    wt_table **const made_tables[] = {&tables.comparison, &tables.modulus_groups,
                                      &tables.modulus_rate, &tables.dma_comparison};
    cmd_finish(&s, made, made_tables, COUNT_OF(made_tables));
done:
    wt_compare_tables_clear(&tables);
    wt_rubber_clear(&rubber);
    wt_result_free(bulk);
    wt_result_free(track);
    wt_result_free(dma);
    return cmd_session_free(&s);
}
