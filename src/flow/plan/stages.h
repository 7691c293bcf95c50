/* The stages of a run: a stage is a row here and a function in run/steps.c. Internal
 * to flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_STAGES_H
#define WEARTRACK_FLOW_STAGES_H

#include "flow/case/things.h"

/* id, name, title, what it needs, what it gives, its function. In an order in which every stage
 * comes after those it needs, and the fuller of two that give the same before the plainer one,
 * which then stands in if the fuller one fails. */
#define STAGES(X)                                                                                  \
    X(MASTER_CURVE, master_curve, "Shift factors, WLF law, master curve, Prony series",            \
      B(DMA_FILES),                                                                                \
      B(SHIFT_FACTORS) | B(MASTER_CURVE) | B(PRONY) | B(RELAXATION_SPECTRUM) | B(PRONY_REDUCED) |  \
          B(MATERIAL_DRAWS) | B(SERIES_DRAWS) | B(RUBBER),                                         \
      flow_step_master)                                                                            \
    X(RAMP, ramp, "Glass transition and moduli against temperature", B(DMA_FILES),                 \
      B(RAMP) | B(GLASS_TRANSITION) | B(MODULI_AT), flow_step_ramp)                                \
    X(PAYNE, payne, "Softening with strain", B(DMA_FILES), B(PAYNE) | B(PAYNE_SWEEP),              \
      flow_step_payne)                                                                             \
    X(GIVEN_MATERIAL, given_material, "Material as given in the case", B(GIVEN_MATERIAL),          \
      B(RUBBER), flow_step_given_material)                                                         \
    X(INDENTATION_BULK_WITH_MATERIAL, indentation_bulk_with_material,                              \
      "Contact point and modulus of every bulk curve, by the spectrum of the material",            \
      B(BULK_CURVES) | B(RUBBER), B(INDENTATION_BULK) | B(CURVE_BULK) | B(DEPTH_BULK),             \
      flow_step_bulk_with_material)                                                                \
    X(INDENTATION_TRACK_WITH_MATERIAL, indentation_track_with_material,                            \
      "Contact point and modulus of every wear-track curve, by the spectrum of the material",      \
      B(TRACK_CURVES) | B(RUBBER), B(INDENTATION_TRACK) | B(CURVE_TRACK) | B(DEPTH_TRACK),         \
      flow_step_track_with_material)                                                               \
    X(INDENTATION_BULK, indentation_bulk, "Contact point and modulus of every bulk curve",         \
      B(BULK_CURVES), B(INDENTATION_BULK) | B(CURVE_BULK) | B(DEPTH_BULK), flow_step_bulk)         \
    X(INDENTATION_TRACK, indentation_track, "Contact point and modulus of every wear-track curve", \
      B(TRACK_CURVES), B(INDENTATION_TRACK) | B(CURVE_TRACK) | B(DEPTH_TRACK), flow_step_track)    \
    X(COMPARISON_WITH_MATERIAL, comparison_with_material,                                          \
      "Wear track against bulk, at one rate and temperature by the material",                      \
      B(INDENTATION_BULK) | B(INDENTATION_TRACK) | B(RUBBER),                                      \
      B(MODULUS_GROUPS) | B(MODULUS_BUDGET) | B(COMPARISON) | B(MODULUS_RATE) | B(MODULUS_RATIO),  \
      flow_step_compare)                                                                           \
    X(COMPARISON, comparison, "Wear track against bulk",                                           \
      B(INDENTATION_BULK) | B(INDENTATION_TRACK),                                                  \
      B(MODULUS_GROUPS) | B(MODULUS_BUDGET) | B(COMPARISON) | B(MODULUS_RATE) | B(MODULUS_RATIO),  \
      flow_step_compare)                                                                           \
    X(GROUPS, groups, "Modulus of bulk and wear track",                                            \
      B(INDENTATION_BULK) | B(INDENTATION_TRACK),                                                  \
      B(MODULUS_GROUPS) | B(MODULUS_BUDGET) | B(MODULUS_RATE), flow_step_groups)                   \
    X(BULK_ALONE, bulk_alone, "Modulus of the bulk", B(INDENTATION_BULK),                          \
      B(MODULUS_GROUPS) | B(MODULUS_BUDGET) | B(MODULUS_RATE), flow_step_groups)                   \
    X(TRACK_ALONE, track_alone, "Modulus of the wear track", B(INDENTATION_TRACK),                 \
      B(MODULUS_GROUPS) | B(MODULUS_BUDGET) | B(MODULUS_RATE), flow_step_groups)                   \
    X(DMA_COMPARISON, dma_comparison, "Indentation of bulk and wear track against DMA",            \
      B(INDENTATION_BULK) | B(INDENTATION_TRACK) | B(RUBBER), B(DMA_COMPARISON),                   \
      flow_step_dma_comparison)                                                                    \
    X(DMA_COMPARISON_BULK, dma_comparison_bulk, "Indentation of the bulk against DMA",             \
      B(INDENTATION_BULK) | B(RUBBER), B(DMA_COMPARISON), flow_step_dma_comparison)                \
    X(ROUGHNESS, roughness, "Power spectrum of the counter surface", B(COUNTER_SURFACE),           \
      B(ROUGHNESS) | B(SURFACE), flow_step_roughness)                                              \
    X(GIVEN_RATIO, given_ratio, "Modulus ratio as given in the case", B(GIVEN_RATIO),              \
      B(MODULUS_RATIO), flow_step_given_ratio)                                                     \
    X(GIVEN_SOFTENING, given_softening, "Softening with strain as given in the case",              \
      B(GIVEN_SOFTENING), B(SOFTENING), flow_step_given_softening)                                 \
    X(SWEPT_SOFTENING, swept_softening, "Softening with strain for the sliding contact",           \
      B(PAYNE_SWEEP) | B(ASKED_SOFTENING), B(SOFTENING), flow_step_swept_softening)                \
    X(LAYER, layer, "Formation, wear and thickness of the modified layer",                         \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS), B(LAYER), flow_step_layer)     \
    X(ENERGY_DENSITY, energy_density, "Energy density against depth",                              \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS), B(ENERGY_DENSITY),             \
      flow_step_energy_density)                                                                    \
    X(FRICTION_WITH_LAYER, friction_with_layer,                                                    \
      "Contact area and friction, with and without the layer",                                     \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER) | B(MODULUS_RATIO), B(FRICTION),           \
      flow_step_friction_with_layer)                                                               \
    X(FRICTION, friction, "Contact area and friction", B(RUBBER) | B(SURFACE) | B(CONDITIONS),     \
      B(FRICTION), flow_step_friction)                                                             \
    X(CONTACT_AREA, contact_area, "Contact area against magnification",                            \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS), B(CONTACT_AREA), flow_step_contact_area)             \
    X(DIRECTIONS, directions, "What the directions of the material do",                            \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(GIVEN_DIRECTIONS), B(DIRECTIONS),                 \
      flow_step_directions)                                                                        \
    X(SOFTENING_EFFECT, softening_effect, "What softening with strain does",                       \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(SOFTENING), B(SOFTENING_EFFECT),                  \
      flow_step_softening_effect)                                                                  \
    X(WHAT_IF_WITH_LAYER, what_if_with_layer,                                                      \
      "What if a choice of the model were another, friction with layer",                           \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS) | B(MODULUS_RATIO), B(WHAT_IF), \
      flow_step_what_if_with_layer)                                                                \
    X(WHAT_IF_LAYER, what_if_layer,                                                                \
      "What if a choice of the model were another, friction and layer",                            \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS), B(WHAT_IF),                    \
      flow_step_what_if_layer)                                                                     \
    X(WHAT_IF, what_if, "What if a choice of the model were another, friction",                    \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS), B(WHAT_IF), flow_step_what_if)                       \
    X(ERROR_BUDGET_WITH_LAYER, error_budget_with_layer,                                            \
      "Which error costs the numbers most, friction with layer",                                   \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(WHAT_IF) | B(LAYER_PARAMETERS) |                  \
          B(MODULUS_RATIO),                                                                        \
      B(ERROR_BUDGET), flow_step_budget_with_layer)                                                \
    X(ERROR_BUDGET_LAYER, error_budget_layer,                                                      \
      "Which error costs the numbers most, friction and layer",                                    \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(WHAT_IF) | B(LAYER_PARAMETERS), B(ERROR_BUDGET),  \
      flow_step_budget_layer)                                                                      \
    X(ERROR_BUDGET, error_budget, "Which error costs the numbers most, friction",                  \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(WHAT_IF), B(ERROR_BUDGET), flow_step_budget)      \
    X(COVERAGE_WITH_LAYER, coverage_with_layer,                                                    \
      "How often the stated intervals hold, friction with layer",                                  \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS) | B(MODULUS_RATIO),             \
      B(COVERAGE), flow_step_coverage_with_layer)                                                  \
    X(COVERAGE_LAYER, coverage_layer, "How often the stated intervals hold, friction and layer",   \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS), B(COVERAGE),                   \
      flow_step_coverage_layer)                                                                    \
    X(COVERAGE, coverage, "How often the stated intervals hold, friction",                         \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS), B(COVERAGE), flow_step_coverage)

#define STAGE_ID(id, ...) FLOW_STAGE_##id,
typedef enum flow_stage_id { STAGES(STAGE_ID) FLOW_N_STAGES } flow_stage_id;

typedef struct flow_stage {
    const char *id, *title;
    flow_things needs, gives;
} flow_stage;
extern const flow_stage flow_stages[FLOW_N_STAGES];

#endif
