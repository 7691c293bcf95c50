/* weartrack layer: formation, wear, balance and thickness of the modified layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "cmd/sliding_options.h"

/* Output tables, each if requested. */
enum { LAYER, ENERGY_DENSITY, SOFTENING, FLASH, WHAT_IF, N_TABLES };

static wt_status compute_layer_tables(cmd_sliding *s, const wt_layer_job *job,
                                      wt_layer_tables *tables, wt_table *table[N_TABLES])
{
    const wt_job *work = &s->session.work;
    wt_error *err = &s->session.err;
    wt_cost_begin_stage(s->session.cost, "layer");
    wt_status status = wt_layer_thickness_compute(&s->conditions, job, work, tables, err);
    table[LAYER] = tables->layer;
    tables->layer = NULL;
    wt_cost_begin_stage(s->session.cost, "energy_density");
    if (status == WT_OK)
        status = wt_energy_density_compute(&s->conditions, job, work, &table[ENERGY_DENSITY], err);
    if (status == WT_OK && s->conditions.strain_softening != NULL) {
        wt_cost_begin_stage(s->session.cost, "softening");
        status = wt_softened_friction_compute(&s->conditions, work, &table[SOFTENING], err);
    }
    if (status == WT_OK && s->conditions.flash.on) {
        wt_cost_begin_stage(s->session.cost, "flash_temperature");
        status = wt_flash_temperature_compute(&s->conditions, work, &table[FLASH], err);
    }
    wt_cost_begin_stage(s->session.cost, "what_if");
    if (status == WT_OK)
        status =
            wt_model_sensitivity_compute(&s->conditions, job, NULL, work, &table[WHAT_IF], err);
    return status;
}

int cmd_layer(int argc, char **argv)
{
    static const cmd_usage usage = {
        .name = "layer",
        .arguments = "--material FILE --roughness R --pressure P --velocity V "
                     "{--specific-wear-rate K | --wear-of FILE} [--critical-energy U | "
                     "--observed-thickness D] [OPTION]...",
        .description =
            "Energy density with depth, formation and wear rate, balance and thickness in time "
            "of the modified layer, at constant load and the velocity given (the middle one of a "
            "list).",
        .common = "output formats columns files-from provenance cost",
        .first = "material dma roughness pressure velocity sliding-temperature "
                 "specific-wear-rate critical-energy observed-thickness duty-cycle times "
                 "energy-from output",
        .master = CMD_DMA_OPTIONS};
    wt_layer_job job = wt_layer_job_defaults();
    cmd_sliding s;
    cmd_sliding_init(&s, (cmd_option_group){wt_layer_job_params(), &job, NULL, 0});
    s.parts[CMD_CONTACT].only =
        "material dma roughness strain-softening softening-temperature wear-of";
    s.parts[CMD_CONDITIONS].only = "pressure velocity sliding-temperature "
                                   "flash-temperature contact-size heat-capacity "
                                   "heat-diffusivity shear-stress";
    wt_layer_tables tables = {0};
    wt_table *table[N_TABLES] = {NULL};
    if (!cmd_sliding_parse(&s, &usage, argc, argv))
        return cmd_sliding_free(&s);
    if (s.contact.wear_of == NULL && wt_layer_job_check(&job, &s.session.err) != WT_OK)
        cmd_param_error(&s.session);
    else if (cmd_sliding_open(&s)) {
        cmd_sliding_set_wear_rate(&s, &job.specific_wear_rate);
        const wt_status status = compute_layer_tables(&s, &job, &tables, table);
        wt_table **parts[N_TABLES];
        for (size_t i = 0; i < N_TABLES; i++)
            parts[i] = &table[i];
        cmd_finish(&s.session, status, parts, N_TABLES);
    }
    return cmd_sliding_free(&s);
}
