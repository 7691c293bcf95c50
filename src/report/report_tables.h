/* Tables of a result for a report, bound to their schemas once. A result may come from a file, so
 * tables may be missing or incomplete.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_REPORT_TABLES_H
#define WT_REPORT_REPORT_TABLES_H

#include "core/table/registry.h"

/* clang-format off */
#define FIGURE_TABLES(X)                                                                            \
    X(answer) X(methods) X(inputs) X(notes) X(limits) X(data_quality) X(failures) X(cost) X(force_displacement) X(force_indentation) X(curves)    \
    X(modulus_groups) X(modulus_budget) X(modulus_depth) X(modulus_rate) X(comparison) X(track_layer) X(dma_comparison) X(shift_factors)             \
    X(ramp) X(glass_transition) X(moduli_at) X(payne) X(payne_sweep) X(master_curve) X(prony) X(prony_reduced) X(influences) X(relaxation_spectrum) X(material_draws) X(series_draws) X(roughness) X(friction)            \
    X(contact_area) X(layer) X(energy_density) X(identification) X(what_if) X(error_budget)      \
    X(work_precision) X(transverse_isotropy) X(softening) X(flash) X(friction_decades) X(spot) X(collection) X(collected_modulus) X(collected_friction) X(collected_ramp) X(collected_force) X(ratio_pairs) X(power_spectrum) X(angular_spectrum) X(surfaces) X(height_map) X(height_profile) X(record) X(record_cycles) X(wear) X(validation) X(validation_running_in) X(validation_course) X(validation_sources)
/* clang-format on */

typedef struct figure_tables {
#define FIGURE_TABLE_MEMBER(table) table_view table;
    FIGURE_TABLES(FIGURE_TABLE_MEMBER)
    table_view
        *indentation; /* [n_indentation], one for each group, whose name is the suffix; owned */
    size_t n_indentation;
} figure_tables;

/* Binds the tables. The views borrow from the result. Call figure_tables_clear also after a
 * failure. */
wt_status figure_tables_bind(const wt_result *result, figure_tables *tables,
                             wt_error *err) WT_NODISCARD;
void figure_tables_clear(figure_tables *tables);
/* Returns the view of a schema in the list above, NULL for any other. */
const table_view *figure_tables_find(const figure_tables *tables, const table_schema *schema);
/* Returns the indentation table of a group, NULL if there is none. */
const table_view *figure_tables_indentation(const figure_tables *tables, const char *group);

#endif
