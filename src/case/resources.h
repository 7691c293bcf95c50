/* Resources of a plan: what a case contains, what it can request, and what stages pass to other
 * stages. A new resource is a row here. Internal to case. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CASE_RESOURCES_H
#define WT_CASE_RESOURCES_H

#include "core/table/schema.h"

/* Sources: id, name, text for a case without it, condition that the case `c` has it. */
#define SOURCES(X)                                                                                 \
    X(BULK_CURVES, "bulk curves", "no bulk curves (<bulk> in <indentation>)", c->bulk.n > 0)       \
    X(TRACK_CURVES, "wear-track curves", "no wear-track curves (<track> in <indentation>)",        \
      c->track.n > 0)                                                                              \
    X(DMA_FILES, "DMA files", "no DMA files (<files> in <dma>)", c->dma.n > 0)                     \
    X(GIVEN_MATERIAL, "given material",                                                            \
      "no material (<prony>, <table> or <fractional-zener> in <dma>)", c->has_material)            \
    X(COUNTER_SURFACE, "counter surface", "no counter surface (<roughness>)",                      \
      c->has_self_affine || c->has_spectrum)                                                       \
    X(HEIGHT_MAPS, "height maps of the counter surface",                                           \
      "no height maps of the counter surface (<files> in <roughness>)", c->height_maps.n > 0)      \
    X(CONDITIONS, "sliding conditions", "no sliding conditions (<sliding>)", c->has_sliding)       \
    X(LAYER_PARAMETERS, "layer parameters", "no layer parameters (<layer>)", c->has_layer)         \
    X(GIVEN_RATIO, "given modulus ratio", "no modulus ratio (<modulus-ratio> in <layer>)",         \
      c->has_modulus_ratio)                                                                        \
    X(GIVEN_DIRECTIONS, "directions of the material",                                              \
      "no directions of the material (<transverse> in <dma>)", c->is_transverse)                   \
    X(GIVEN_SOFTENING, "given softening", "no table of softening (<file> in <strain-softening>)",  \
      c->softening.n > 0)                                                                          \
    X(REQUESTED_SOFTENING, "softening by strain sweeps",                                           \
      "no softening by strain sweeps (<sweeps> in <strain-softening>)",                            \
      c->softens && c->softening.n == 0)                                                           \
    X(RECORD_FILES, "records of friction", "no records of friction (<files> in <record>)",         \
      c->record.n > 0)                                                                             \
    X(GIVEN_WEAR, "what was worn",                                                                 \
      "nothing that was worn (<track-area>, <profile>, <mass-loss> or <ball-radius> in <record>)", \
      c->has_wear)                                                                                 \
    X(MEASURED_WEAR, "wear of the layer by the records", "a specific wear rate in <layer>",        \
      c->has_layer &&isnan(c->layer.specific_wear_rate.value))                                     \
    X(REQUESTED_DECADES, "decades of the wavenumber",                                              \
      "no decades asked for (<decades> in <sliding>)", c->sliding.decades)                         \
    X(REQUESTED_IDENTIFICATION, "what is seen of the layer",                                       \
      "nothing that is seen of a layer (<identify>)", c->identifies)                               \
    X(REQUESTED_FLASH, "flash temperature",                                                        \
      "no flash temperature (<flash-temperature> in <sliding>)",                                   \
      c->has_sliding && c->sliding.flash.on)

/* Tables: id, name, schema, suffix of the table name. The curve of a group is a block in two tables
 * that both groups share. */
#define TABLE_RESOURCES(X)                                                                         \
    X(INDENTATION_BULK, "indentation/bulk", &indentation_schema, "bulk")                           \
    X(INDENTATION_TRACK, "indentation/track", &indentation_schema, "track")                        \
    X(CURVE_BULK, "bulk curve", NULL, "")                                                          \
    X(CURVE_TRACK, "wear-track curve", NULL, "")                                                   \
    X(DEPTH_BULK, "bulk modulus against depth", NULL, "")                                          \
    X(DEPTH_TRACK, "wear-track modulus against depth", NULL, "")                                   \
    X(COMPARISON, "comparison", &comparison_schema, "")                                            \
    X(MODULUS_GROUPS, "modulus_groups", &modulus_groups_schema, "")                                \
    X(MODULUS_BUDGET, "modulus_budget", &modulus_budget_schema, "")                                \
    X(MODULUS_RATE, "modulus_rate", &modulus_rate_schema, "")                                      \
    X(TRACK_LAYER, "track_layer", &track_layer_schema, "")                                         \
    X(DMA_COMPARISON, "dma_comparison", &dma_comparison_schema, "")                                \
    X(SHIFT_FACTORS, "shift_factors", &shift_factors_schema, "")                                   \
    X(MASTER_CURVE, "master_curve", &master_curve_schema, "")                                      \
    X(PRONY, "prony", &prony_schema, "")                                                           \
    X(RELAXATION_SPECTRUM, "relaxation_spectrum", &relaxation_spectrum_schema, "")                 \
    X(INFLUENCES, "influences", &influences_schema, "")                                            \
    X(PRONY_REDUCED, "prony_reduced", &prony_reduced_schema, "")                                   \
    X(MATERIAL_DRAWS, "material_draws", &material_draws_schema, "")                                \
    X(SERIES_DRAWS, "series_draws", &series_draws_schema, "")                                      \
    X(RAMP, "ramp", &ramp_schema, "")                                                              \
    X(GLASS_TRANSITION, "glass_transition", &glass_transition_schema, "")                          \
    X(MODULI_AT, "moduli_at", &moduli_at_schema, "")                                               \
    X(PAYNE, "payne", &payne_schema, "")                                                           \
    X(PAYNE_SWEEP, "payne_sweep", &payne_sweep_schema, "")                                         \
    X(RECORD, "record", &record_schema, "")                                                        \
    X(RECORD_CYCLES, "record_cycles", &record_cycles_schema, "")                                   \
    X(WEAR, "wear", &wear_schema, "")                                                              \
    X(ROUGHNESS, "roughness", &roughness_schema, "")                                               \
    X(POWER_SPECTRUM, "power_spectrum", &power_spectrum_schema, "")                                \
    X(PLACE_ERRORS, "place_errors", &place_errors_schema, "")                                      \
    X(ANGULAR_SPECTRUM, "angular_spectrum", &angular_spectrum_schema, "")                          \
    X(SURFACES, "surfaces", &surfaces_schema, "")                                                  \
    X(HEIGHT_MAP, "height_map", &height_map_schema, "")                                            \
    X(HEIGHT_PROFILE, "height_profile", &height_profile_schema, "")                                \
    X(LAYER, "layer", &layer_schema, "")                                                           \
    X(ENERGY_DENSITY, "energy_density", &energy_density_schema, "")                                \
    X(IDENTIFICATION, "identification", &identification_schema, "")                                \
    X(FRICTION, "friction", &friction_schema, "")                                                  \
    X(CONTACT_AREA, "contact_area", &contact_area_schema, "")                                      \
    X(TRANSVERSE_ISOTROPY, "transverse_isotropy", &transverse_isotropy_schema, "")                 \
    X(SOFTENING_EFFECT, "softening", &softening_schema, "")                                        \
    X(FRICTION_DECADES, "friction_decades", &friction_decades_schema, "")                          \
    X(FLASH_EFFECT, "flash_temperature", &flash_schema, "")                                        \
    X(WHAT_IF, "what_if", &what_if_schema, "")                                                     \
    X(VALIDATION, "validation", &validation_schema, "")                                            \
    X(VALIDATION_RUNNING_IN, "validation_running_in", &validation_running_in_schema, "")           \
    X(VALIDATION_COURSE, "validation_course", &validation_course_schema, "")                       \
    X(VALIDATION_SOURCES, "validation_sources", &validation_sources_schema, "")                    \
    X(ERROR_BUDGET, "error_budget", &error_budget_schema, "")                                      \
    X(WORK_PRECISION, "work_precision", &work_precision_schema, "")

/* Resources that are passed between stages only: id, name. */
#define INNER_RESOURCES(X)                                                                         \
    X(RUBBER, "material")                                                                          \
    X(SURFACE, "roughness law")                                                                    \
    X(MODULUS_RATIO, "modulus ratio")                                                              \
    X(SOFTENING, "softening with strain")

#define RESOURCE_ID(id, ...) FLOW_##id,
typedef enum flow_resource {
    SOURCES(RESOURCE_ID) TABLE_RESOURCES(RESOURCE_ID) INNER_RESOURCES(RESOURCE_ID) FLOW_N_RESOURCES
} flow_resource;
enum { FLOW_FIRST_TABLE = FLOW_INDENTATION_BULK, FLOW_FIRST_INNER = FLOW_RUBBER };

/* Set of resources: bit i stands for resource i. There are more than 64. */
__extension__ typedef unsigned __int128 flow_resource_set;
#define FLOW_BIT(resource) ((flow_resource_set)1 << (unsigned)(resource))
#define FLOW_SOURCES (FLOW_BIT(FLOW_FIRST_TABLE) - 1)
#define FLOW_TABLES (FLOW_BIT(FLOW_FIRST_INNER) - 1 - FLOW_SOURCES)
/* Tables that are expensive, or that concern another measurement than sliding. They are computed
 * only if a case names them. */
#define FLOW_ONLY_REQUESTED                                                                        \
    (FLOW_BIT(FLOW_ERROR_BUDGET) | FLOW_BIT(FLOW_WORK_PRECISION) | FLOW_BIT(FLOW_RAMP) |           \
     FLOW_BIT(FLOW_GLASS_TRANSITION) | FLOW_BIT(FLOW_MODULI_AT) | FLOW_BIT(FLOW_PRONY_REDUCED) |   \
     FLOW_BIT(FLOW_RELAXATION_SPECTRUM) | FLOW_BIT(FLOW_INFLUENCES) | FLOW_BIT(FLOW_PAYNE) |       \
     FLOW_BIT(FLOW_PAYNE_SWEEP))

/* Comparison of the case with its records. */
#define FLOW_VALIDATIONS                                                                           \
    (FLOW_BIT(FLOW_VALIDATION) | FLOW_BIT(FLOW_VALIDATION_RUNNING_IN) |                            \
     FLOW_BIT(FLOW_VALIDATION_COURSE) | FLOW_BIT(FLOW_VALIDATION_SOURCES))

typedef struct flow_resource_row {
    const char *label, *missing;
    const table_schema *schema; /* NULL if the resource is not a table of its own */
    const char *suffix;
} flow_resource_row;
extern const flow_resource_row flow_resource_rows[FLOW_N_RESOURCES];

/* Writes the names of the resources, separated by commas. */
void flow_resources_list(flow_resource_set resources, char *text, size_t size);
int flow_resources_count(flow_resource_set resources);
/* Finds the resources of a table or a figure. The set is empty for tables that every result has.
 * False if the name is unknown. */
bool flow_table_resources(const char *table, flow_resource_set *resources);
bool flow_figure_resources(const char *figure, flow_resource_set *resources);

#endif
