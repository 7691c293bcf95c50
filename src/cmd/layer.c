/* weartrack layer: formation, wear, balance and thickness of the modified layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/sliding.h"

int cmd_layer(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "layer",
        .arguments = "--material FILE --roughness R --pressure P --velocity V --specific-wear-rate "
                     "K [--critical-energy U | --observed-thickness D] [OPTION]...",
        .what = "Energy density with depth, formation and wear rate, balance and thickness in time "
                "of the modified layer, for the energy closure at constant load, at the velocity "
                "given (the middle one of a list).",
        .common = "output formats columns files-from provenance cost"};
    wt_layer_job job = wt_layer_job_defaults();
    cmd_sliding s;
    cmd_sliding_init(&s, (cmd_part){wt_layer_job_params(), &job, NULL, 0});
    s.parts[CMD_CONDITIONS].only =
        "pressure velocity sliding-temperature gamma strain-factor anisotropy texture-angle "
        "anisotropy-fourth texture-angle-fourth area-law flash-temperature contact-size "
        "heat-capacity heat-diffusivity macroscopic-area clip-heat shear-stress shear-law "
        "shear-peak-velocity shear-width shear-activation shear-temperature";
    wt_layer_tables tables = {0};
    wt_table *energy_density = NULL, *softening = NULL, *flash = NULL, *what_if = NULL;
    if (!cmd_sliding_parse(&s, &usage, argc, argv))
        return cmd_sliding_free(&s);
    if (wt_layer_job_check(&job, &s.session.err) != WT_OK)
        cmd_param_error(&s.session);
    else if (cmd_sliding_open(&s)) {
        wt_cost_stage(s.session.cost, "layer");
        wt_status made =
            wt_layer_make(&s.conditions, &job, &s.session.work, &tables, &s.session.err);
        wt_cost_stage(s.session.cost, "energy_density");
        if (made == WT_OK)
            made = wt_energy_density_table(&s.conditions, &job, &s.session.work, &energy_density,
                                           &s.session.err);
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
            made = wt_what_if_make(&s.conditions, &job, NULL, &s.session.work, &what_if,
                                   &s.session.err);
        wt_table **const parts[] = {&tables.layer, &energy_density, &softening, &flash, &what_if};
        cmd_finish(&s.session, made, parts, COUNT_OF(parts));
    }
    return cmd_sliding_free(&s);
}
