/* Power density that modifies the rubber, against depth.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/cost.h"
#include "layer/layer_energy.h"

#include "core/table/table_rows.h"

#include <math.h>

#define DEPTHS 121 /* resolution of a figure */

TABLE_ROW(energy_density, ENERGY_DENSITY, double depth, energy_density;)

static void add_depths(const wt_energy_source *source, table_writer *t)
{
    double q_min = source->wavenumber[0], q_max = source->wavenumber[0];
    for (size_t i = 1; i < source->n; i++) {
        q_min = fmin(q_min, source->wavenumber[i]);
        q_max = fmax(q_max, source->wavenumber[i]);
    }
    /* from a tenth of the shortest wave to where the longest one has decayed */
    const double first = 0.1 / q_max, last = 3 / q_min;
    for (size_t i = 0; i < DEPTHS; i++) {
        const double depth = first * pow(last / first, (double)i / (DEPTHS - 1));
        TABLE_ADD(energy_density, t, depth, wt_energy_density(source, depth));
    }
}

wt_status wt_energy_density_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                    const wt_job *work, wt_table **table, wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no energy density to make");
    sliding_contact c = {0};
    layer_energy energy = {.source = {.n = 0}};
    wt_job own = *work;
    own.left_out = WT_EXTRA_ALL;
    const wt_layer_state none = {.modulus_ratio = 1};
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = wt_layer_job_check(job, err);
    if (status == WT_OK)
        status = sliding_contact_create(sliding, &own, WT_NO_REPLICATE, NULL, none, &c, err);
    const double velocity = status == WT_OK ? layer_sliding_velocity(sliding, job) : 0;
    if (status == WT_OK)
        status = layer_energy_compute(sliding, job, &c, velocity, none, &energy, err);
    sliding_contact_clear(&c);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&energy_density_schema, err);
    add_depths(&energy.source, &t);
    energy_density_set_value(&t, ENERGY_DENSITY_KEY_VELOCITY, velocity, 0, 0);
    cost_report(work, (cost_summary){.items = DEPTHS,
                                     .tolerance_asked = work->tolerance,
                                     .error_estimated = energy.source.numerical_error});
    layer_energy_clear(&energy);
    return table_end(&t, table);
}
