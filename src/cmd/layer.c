/* weartrack layer: formation, wear, balance and thickness of the modified layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "cmd/sliding.h"

int cmd_layer(int argc, char **argv)
{
    cmd_common common = CMD_COMMON_DEFAULTS;
    cmd_sliding s;
    cmd_sliding_init(&s);
    wt_layer_job job = wt_layer_job_defaults();
    cmd_values time = {NULL, 0};
    int profile = (int)job.profile;
    bool no_incubation = false;
    job.specific_wear_rate.value = (double)NAN;
    cmd_option options[CMD_SLIDING_OPTIONS + 10];
    size_t n = cmd_sliding_options(&s, options);
    const cmd_option own[] = {
        {"specific-wear-rate", 0, CMD_ESTIMATE, &job.specific_wear_rate, "K", WT_Q_WEAR_RATE,
         "k, such as \"1e-3mm^3/(N m)\"; required"},
        {"critical-energy", 0, CMD_ESTIMATE, &job.critical_energy, "U", WT_Q_ENERGY_DENSITY,
         "U_c, such as 2e10J/m^3"},
        {"observed-thickness", 0, CMD_ESTIMATE, &job.observed_thickness, "D", WT_Q_LENGTH,
         "calibrate U_c so that this is the balance, instead of --critical-energy"},
        {"damage", 0, CMD_NUMBER, &job.damage, "L", WT_Q_NONE, "Lambda; default 1"},
        {"duty", 0, CMD_NUMBER, &job.duty, "X", WT_Q_NONE,
         "share of the time in contact; default 1: times are contact times"},
        {"start-thickness", 0, CMD_QUANTITY, &job.start_thickness, "D", WT_Q_LENGTH,
         "of the layer at time 0; default 0"},
        {"no-incubation", 0, CMD_FLAG, &no_incubation, NULL, WT_Q_NONE,
         "balance of the rates from the beginning instead of transport of damage"},
        {"profile", 0, CMD_CHOICE, &profile, "persson|incompressible", WT_Q_NONE,
         "how the energy falls off with depth; default persson"},
        {"local-friction", 0, CMD_NUMBER, &job.local_friction, "M", WT_Q_NONE,
         "local friction of the incompressible profile; default 0"},
        {"time", 0, CMD_VALUES, &time, "T", WT_Q_TIME,
         "1:1e4s:log:40 and the like; default: around the time scales"}};
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        options[n++] = own[i];
    const cmd_usage usage = {
        "layer",
        "--material FILE --roughness R --pressure P --velocity V\n"
        "                       --specific-wear-rate K [--critical-energy U | "
        "--observed-thickness D]\n                       [OPTION]...",
        "Energy density with depth, formation and wear rate, balance and thickness in time of the\n"
        "modified layer, for the energy closure at constant load, at the velocity given (the "
        "middle\n"
        "one of a list).",
        CMD_OPT_OUTPUT | CMD_OPT_FORMAT | CMD_OPT_FORMATS | CMD_OPT_THREADS | CMD_OPT_SEED |
            CMD_OPT_PROVENANCE,
        NULL};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_layer_tables tables = {0};
    if (!cmd_parse(&usage, options, n, &common, argc, argv, &first, &status))
        goto done;
    if (isnan(job.specific_wear_rate.value)) {
        status = cmd_usage_error("layer", "--specific-wear-rate is missing");
        goto done;
    }
    if (isnan(job.critical_energy.value) == isnan(job.observed_thickness.value)) {
        status = cmd_usage_error("layer", "give either --critical-energy or --observed-thickness");
        goto done;
    }
    status = cmd_sliding_open(&s, "layer", &common, argc, first);
    if (status != CMD_OK)
        goto done;
    job.profile = (wt_depth_profile)profile;
    job.incubation = !no_incubation;
    job.time = time.values;
    job.n_time = time.n;
    cmd_progress progress;
    s.work.progress = cmd_progress_start(&progress, common.quiet);
    const wt_status made = wt_layer_make(&s.conditions, &job, &s.work, &tables, &err);
    cmd_progress_end(&progress);
    cmd_print_log("layer", s.log, false, common.quiet);
    if (made != WT_OK) {
        status = cmd_fail("layer", &err);
        goto done;
    }
    wt_table **const parts[] = {&tables.layer, &tables.energy_density};
    if (cmd_collect(s.result, parts, sizeof parts / sizeof parts[0], &err) != WT_OK ||
        cmd_write(&common, s.result, &err) != WT_OK)
        status = cmd_fail("layer", &err);
done:
    wt_layer_tables_clear(&tables);
    cmd_values_free(&time);
    cmd_sliding_free(&s);
    return status;
}
