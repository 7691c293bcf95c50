/* weartrack layer: formation, wear, balance and thickness of the modified layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/sliding.h"

int cmd_layer(int argc, char **argv)
{
    static const cmd_usage usage = {
        "layer",
        "--material FILE --roughness R --pressure P --velocity V\n"
        "                       --specific-wear-rate K [--critical-energy U | "
        "--observed-thickness D]\n                       [OPTION]...",
        "Energy density with depth, formation and wear rate, balance and thickness in time of the\n"
        "modified layer, for the energy closure at constant load, at the velocity given (the "
        "middle\n"
        "one of a list).",
        "output formats files-from provenance", NULL};
    wt_layer_job job = wt_layer_job_defaults();
    cmd_sliding s;
    cmd_sliding_init(&s, (cmd_part){wt_layer_job_params(), &job, NULL, 0});
    int status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_layer_tables tables = {0};
    if (!cmd_sliding_parse(&s, &usage, argc, argv, &status))
        goto done;
    if (wt_layer_job_check(&job, &err) != WT_OK) {
        status = cmd_param_error("layer", &err);
        goto done;
    }
    status = cmd_sliding_open(&s, "layer");
    if (status != CMD_OK)
        goto done;
    const wt_status made = wt_layer_make(&s.conditions, &job, &s.session.work, &tables, &err);
    wt_table **const parts[] = {&tables.layer, &tables.energy_density};
    status = cmd_finish(&s.session, made, parts, sizeof parts / sizeof parts[0], &err);
done:
    wt_layer_tables_clear(&tables);
    cmd_sliding_free(&s);
    return status;
}
