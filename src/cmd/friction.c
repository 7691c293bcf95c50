/* weartrack friction: hysteresis friction, contact area and total friction against velocity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/sliding.h"

int cmd_friction(int argc, char **argv)
{
    static const cmd_usage usage = {
        "friction", "--material FILE --roughness R --pressure P --velocity V [OPTION]...",
        "Persson's hysteresis friction, contact area and, with --shear-stress, total friction at\n"
        "each velocity, each with its numerical and its standard error; with a modified layer on\n"
        "top if its thickness and modulus ratio are given.",
        "output formats files-from provenance", NULL};
    wt_layer_known layer = {0};
    cmd_sliding s;
    cmd_sliding_init(&s, (cmd_part){wt_layer_known_params(), &layer, NULL, 0});
    const cmd_part *own = &s.parts[CMD_OWN];
    int status = CMD_OK;
    wt_error err = WT_ERROR_INIT;
    wt_friction_tables tables = {0};
    if (!cmd_sliding_parse(&s, &usage, argc, argv, &status))
        goto done;
    const bool has_layer = cmd_given(own, "layer-thickness");
    if (has_layer != cmd_given(own, "modulus-ratio")) {
        status = cmd_usage_error("friction", "--layer-thickness and --modulus-ratio go together");
        goto done;
    }
    status = cmd_sliding_open(&s, "friction");
    if (status != CMD_OK)
        goto done;
    const wt_status made =
        wt_friction_make(&s.conditions, has_layer ? &layer : NULL, &s.session.work, &tables, &err);
    wt_table **const parts[] = {&tables.friction, &tables.contact_area};
    status = cmd_finish(&s.session, made, parts, sizeof parts / sizeof parts[0], &err);
done:
    wt_friction_tables_clear(&tables);
    cmd_sliding_free(&s);
    return status;
}
