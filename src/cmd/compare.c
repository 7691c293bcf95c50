/* weartrack compare: wear track against bulk. SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/tables.h"

#include <string.h>

typedef struct own_options {
    const char *master;
} own_options;

static const wt_param rows[] = {
    {PARAM_TEXT_OF("master", own_options, master), .value = "FILE", .unset = "",
     .help = "output of weartrack master, to compare with DMA at the frequency of the indentation"},
};
CMD_OPTIONS(own_params, own_options, rows)

static const char *const names[2] = {"indentation/bulk", "indentation/track"};

static bool is_called(const wt_table *table, const char *name)
{
    return strcmp(wt_table_name(table), name) == 0;
}

/* The table of the group, or the first of another name; what is called the track is no bulk. */
static wt_status read_group(cmd_session *s, int g, wt_result **tables, const wt_table **table)
{
    const char **files = s->files;
    wt_error *err = &s->err;
    wt_status status =
        cmd_table_read(files[g], "indentation/", (cmd_made){"indent", g == 0 ? "bulk" : "track"},
                       &s->work, tables, table, err);
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < wt_result_n_tables(*tables); i++)
        if (is_called(wt_result_table(*tables, i), names[g]))
            *table = wt_result_table(*tables, i);
    const bool same = strcmp(files[0], files[1]) == 0;
    if (!same && (g > 0 || !is_called(*table, names[1])))
        return WT_OK;
    wt_fail(err, WT_E_ARG, same ? "BULK and TRACK are one file" : "the first file is the track");
    wt_error_file(err, files[g]);
    if (!same) {
        wt_error_expected(err, "the table of the bulk");
        wt_error_found(err, "'%s'", wt_table_name(*table));
    }
    wt_error_advice(err, "give the bulk first, then the track: compare BULK TRACK");
    return WT_E_ARG;
}

int cmd_compare(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "compare",
        .arguments = "[OPTION]... BULK TRACK",
        .what =
            "Compares the moduli of the wear track with those of the bulk: does it differ (yes, no "
            "or cannot say), the ratio with its 95 % interval, Welch's and the Mann-Whitney test, "
            "effect size, and the same rate by rate. BULK and TRACK are outputs of weartrack "
            "indent; - is standard input.",
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
    wt_status made = read_group(&s, 0, &bulk, &job.bulk);
    if (made == WT_OK)
        made = read_group(&s, 1, &track, &job.track);
    if (made == WT_OK && is_called(job.track, names[0]))
        wt_parselog_add(s.log, WT_WARNING, s.files[1], NULL,
                        "its curves are called bulk and are taken for those of the track; "
                        "`weartrack indent --group track` names them");
    if (made == WT_OK && own.master != NULL) {
        made = cmd_rubber_read(own.master, material.poisson_ratio, &s.work, &dma, &rubber, &s.err);
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
