/* weartrack friction: hysteresis friction, contact area and total friction against velocity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "cmd/sliding.h"

int cmd_friction(int argc, char **argv)
{
    cmd_common common = CMD_COMMON_DEFAULTS;
    cmd_sliding s;
    cmd_sliding_init(&s);
    wt_layer_known layer = {.thickness = {(double)NAN, 0, 0, "m"},
                            .modulus_ratio = {(double)NAN, 0, 0, "1"}};
    cmd_option options[CMD_SLIDING_OPTIONS + 2];
    size_t n = cmd_sliding_options(&s, options);
    options[n++] = (cmd_option){"layer-thickness",
                                0,
                                CMD_ESTIMATE,
                                &layer.thickness,
                                "D",
                                WT_Q_LENGTH,
                                "of the modified layer, such as 1um"};
    options[n++] = (cmd_option){"layer-ratio",
                                0,
                                CMD_ESTIMATE,
                                &layer.modulus_ratio,
                                "X",
                                WT_Q_NONE,
                                "modulus of the layer over that of the bulk"};
    const cmd_usage usage = {
        "friction", "--material FILE --roughness R --pressure P --velocity V [OPTION]...",
        "Persson's hysteresis friction, contact area and, with --shear-stress, total friction at\n"
        "each velocity, each with its numerical and its standard error; with a modified layer on\n"
        "top if its thickness and modulus ratio are given.",
        CMD_OPT_OUTPUT | CMD_OPT_FORMAT | CMD_OPT_FORMATS | CMD_OPT_THREADS | CMD_OPT_SEED |
            CMD_OPT_PROVENANCE,
        NULL};
    int first = 0, status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_friction_tables tables = {0};
    if (!cmd_parse(&usage, options, n, &common, argc, argv, &first, &status))
        goto done;
    const bool has_layer = !isnan(layer.thickness.value);
    if (has_layer != !isnan(layer.modulus_ratio.value)) {
        status = cmd_usage_error("friction", "--layer-thickness and --layer-ratio go together");
        goto done;
    }
    status = cmd_sliding_open(&s, "friction", &common, argc, first);
    if (status != CMD_OK)
        goto done;
    cmd_progress progress;
    s.work.progress = cmd_progress_start(&progress, common.quiet);
    const wt_status made =
        wt_friction_make(&s.conditions, has_layer ? &layer : NULL, &s.work, &tables, &err);
    cmd_progress_end(&progress);
    cmd_print_log("friction", s.log, false, common.quiet);
    if (made != WT_OK) {
        status = cmd_fail("friction", &err);
        goto done;
    }
    wt_table **const parts[] = {&tables.friction, &tables.contact_area};
    if (cmd_collect(s.result, parts, sizeof parts / sizeof parts[0], &err) != WT_OK ||
        cmd_write(&common, s.result, &err) != WT_OK)
        status = cmd_fail("friction", &err);
done:
    wt_friction_tables_clear(&tables);
    cmd_sliding_free(&s);
    return status;
}
