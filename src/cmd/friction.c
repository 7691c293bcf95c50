/* weartrack friction: hysteresis friction, contact area and total friction against velocity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/sliding.h"

int cmd_friction(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "friction",
        .arguments = "--material FILE --roughness R --pressure P --velocity V [OPTION]...",
        .what = "Persson's hysteresis friction, contact area and, with --shear-stress, total "
                "friction at each velocity, each with its numerical and its standard error; with a "
                "modified layer on top if its thickness and modulus ratio are given.",
        .common = "output formats columns files-from provenance cost"};
    wt_layer_known layer = {0};
    cmd_sliding s;
    cmd_sliding_init(&s, (cmd_part){wt_layer_known_params(), &layer, NULL, 0});
    const cmd_part *own = &s.parts[CMD_OWN];
    wt_friction_tables tables = {0};
    wt_table *contact_area = NULL, *directions = NULL, *softening = NULL, *flash = NULL,
             *what_if = NULL;
    if (!cmd_sliding_parse(&s, &usage, argc, argv))
        return cmd_sliding_free(&s);
    const bool has_layer = cmd_given(own, "layer-thickness");
    if (has_layer != cmd_given(own, "modulus-ratio"))
        cmd_usage_error(&s.session, "--layer-thickness and --modulus-ratio go together");
    else if (cmd_sliding_open(&s)) {
        const wt_layer_known *known = has_layer ? &layer : NULL;
        wt_cost_stage(s.session.cost, has_layer ? "friction_with_layer" : "friction");
        wt_status made =
            wt_friction_make(&s.conditions, known, &s.session.work, &tables, &s.session.err);
        wt_cost_stage(s.session.cost, "contact_area");
        if (made == WT_OK)
            made = wt_contact_area_table(&s.conditions, &s.session.work, &contact_area,
                                         &s.session.err);
        if (made == WT_OK && s.rubber.is_transverse) {
            wt_cost_stage(s.session.cost, "directions");
            made = wt_directions_make(&s.conditions, &s.session.work, &directions, &s.session.err);
        }
        if (made == WT_OK && s.conditions.softness != NULL) {
            wt_cost_stage(s.session.cost, "softening");
            made = wt_softening_make(&s.conditions, &s.session.work, &softening, &s.session.err);
        }
        if (made == WT_OK && s.conditions.flash.on) {
            wt_cost_stage(s.session.cost, "flash_temperature");
            made = wt_flash_make(&s.conditions, &s.session.work, &flash, &s.session.err);
        }
        wt_cost_stage(s.session.cost, "what_if");
        if (made == WT_OK)
            made = wt_what_if_make(&s.conditions, NULL, known, &s.session.work, &what_if,
                                   &s.session.err);
        wt_table **const parts[] = {&tables.friction, &contact_area, &directions,
                                    &softening,       &flash,        &what_if};
        cmd_finish(&s.session, made, parts, COUNT_OF(parts));
    }
    return cmd_sliding_free(&s);
}
