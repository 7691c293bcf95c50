/* weartrack identify: critical energy and wear rate from an observed layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/sliding_options.h"

int cmd_identify(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "identify",
        .arguments = "--material FILE --roughness R --pressure P --velocity V --observed-thickness "
                     "D [--specific-wear-rate K] [--running-in-time T] [OPTION]...",
        .description =
            "Critical energy U_c and specific wear rate k that go with a layer of known "
            "thickness: with a wear rate, with the time of its running-in, or both against one "
            "another, at the velocity given (the middle one of a list); with intervals, their "
            "correlation and the combination that the data do not determine.",
        .common = "output formats columns files-from provenance cost",
        .first = "material dma roughness pressure velocity observed-thickness specific-wear-rate "
                 "running-in-time sliding-temperature output",
        .master = CMD_DMA_OPTIONS};
    wt_identify_job job = wt_identify_job_defaults();
    cmd_sliding s;
    wt_table *table = NULL;
    cmd_sliding_init(&s, (cmd_option_group){wt_identify_job_params(), &job, NULL, 0});
    /* the energy does not depend on the shear stress */
    s.parts[CMD_CONTACT].only =
        "material dma roughness strain-softening softening-temperature wear-of";
    s.parts[CMD_CONDITIONS].only = "pressure velocity sliding-temperature "
                                   "flash-temperature contact-size heat-capacity heat-diffusivity";
    if (!cmd_sliding_parse(&s, &usage, argc, argv))
        return cmd_sliding_free(&s);
    if (cmd_sliding_open(&s)) {
        cmd_sliding_set_wear_rate(&s, &job.specific_wear_rate);
        wt_cost_begin_stage(s.session.cost, "identify");
        wt_table **const parts[] = {&table};
        cmd_finish(
            &s.session,
            wt_identification_compute(&s.conditions, &job, &s.session.work, &table, &s.session.err),
            parts, COUNT_OF(parts));
    }
    return cmd_sliding_free(&s);
}
