/* weartrack friction: hysteresis friction, contact area and total friction against velocity.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/sliding_options.h"

/* The tables that follow that of friction, each where it has something to say. */
enum { AREA, TRANSVERSE_ISOTROPY, SOFTENING, FLASH, DECADES, N_FURTHER };

static bool is_table_requested(const wt_sliding *s, size_t k)
{
    switch (k) {
    case TRANSVERSE_ISOTROPY:
        return s->rubber->is_transverse;
    case SOFTENING:
        return s->strain_softening != NULL;
    case FLASH:
        return s->flash.on;
    case DECADES:
        return s->decades;
    default:
        return true;
    }
}

static wt_status compute_further_tables(cmd_sliding *s, wt_table *further[N_FURTHER])
{
    static const struct {
        const char *stage;
        wt_status (*compute)(const wt_sliding *, const wt_job *, wt_table **, wt_error *);
    } made[N_FURTHER] = {
        [AREA] = {"contact_area", wt_contact_area_compute},
        [TRANSVERSE_ISOTROPY] = {"transverse_isotropy", wt_transverse_isotropy_compute},
        [SOFTENING] = {"softening", wt_softened_friction_compute},
        [FLASH] = {"flash_temperature", wt_flash_temperature_compute},
        [DECADES] = {"friction_decades", wt_friction_by_scale_compute}};
    wt_status status = WT_OK;
    for (size_t k = 0; status == WT_OK && k < N_FURTHER; k++) {
        if (!is_table_requested(&s->conditions, k))
            continue;
        wt_cost_begin_stage(s->session.cost, made[k].stage);
        status = made[k].compute(&s->conditions, &s->session.work, &further[k], &s->session.err);
    }
    return status;
}

int cmd_friction(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "friction",
        .next = "layer with these options, a wear rate and a critical energy",
        .arguments = "--material FILE --roughness R --pressure P --velocity V [OPTION]...",
        .description =
            "Persson's hysteresis friction, contact area and, with --shear-stress, total "
            "friction at each velocity, each with its numerical and its standard error; with a "
            "modified layer on top if its thickness and modulus ratio are given.",
        .common = "output formats columns files-from provenance cost",
        .first = "material dma roughness pressure velocity sliding-temperature shear-stress "
                 "layer-thickness modulus-ratio strain-softening flash-temperature "
                 "output",
        .master = CMD_DMA_OPTIONS};
    wt_layer_observation layer = wt_layer_observation_defaults();
    cmd_sliding s;
    cmd_sliding_init(&s, (cmd_option_group){wt_layer_observation_params(), &layer, NULL, 0});
    const cmd_option_group *own = &s.parts[CMD_SUBCOMMAND];
    wt_friction_tables tables = {0};
    wt_table *further[N_FURTHER] = {NULL}, *what_if = NULL;
    if (!cmd_sliding_parse(&s, &usage, argc, argv))
        return cmd_sliding_free(&s);
    const bool has_layer = cmd_option_is_set(own, "layer-thickness");
    if (has_layer != cmd_sliding_has_layer(&s, own))
        cmd_usage_error(&s.session, "--layer-thickness and --modulus-ratio (or a file of it) go "
                                    "together");
    else if (cmd_sliding_open(&s)) {
        const wt_layer_observation *observation = has_layer ? &layer : NULL;
        wt_cost_begin_stage(s.session.cost, has_layer ? "friction_with_layer" : "friction");
        wt_status status = wt_sliding_friction_compute(&s.conditions, observation, &s.session.work,
                                                       &tables, &s.session.err);
        if (status == WT_OK)
            status = compute_further_tables(&s, further);
        wt_cost_begin_stage(s.session.cost, "what_if");
        if (status == WT_OK)
            status = wt_model_sensitivity_compute(&s.conditions, NULL, observation, &s.session.work,
                                                  &what_if, &s.session.err);
        wt_table **const parts[] = {&tables.friction,
                                    &further[AREA],
                                    &further[TRANSVERSE_ISOTROPY],
                                    &further[SOFTENING],
                                    &further[FLASH],
                                    &further[DECADES],
                                    &what_if};
        cmd_finish(&s.session, status, parts, COUNT_OF(parts));
    }
    return cmd_sliding_free(&s);
}
