/* List of the stages of a run. A stage is a row here and a function in case/run. Internal to case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_PLAN_STAGES_H
#define WT_CASE_PLAN_STAGES_H

#include "case/resources.h"

/* Sets of optional inputs, which a stage uses if they are available. plan.c lists their
 * resources. */
typedef enum flow_optional_input_id {
    FLOW_OPTIONAL_NONE,
    FLOW_OPTIONAL_SPECTRUM,
    FLOW_OPTIONAL_RATE_CORRECTION,
    FLOW_OPTIONAL_TRACK,
    FLOW_OPTIONAL_LAYER,
    FLOW_OPTIONAL_THICKNESS,
    FLOW_OPTIONAL_STEADY_STATE,
    FLOW_OPTIONAL_WEAR,
    FLOW_N_OPTIONAL_INPUTS
} flow_optional_input_id;

/* Columns: id, name, title, needs, alternatives (at least one is needed, all available ones are
 * used; 0 without such inputs), optional inputs, outputs, function. B(X) is the bit of the resource
 * FLOW_X; the file that expands the list defines it.
 *
 * Every stage follows those that it needs. Of two stages with a common output the more complete
 * one is first. The other one replaces it if it fails. */
#define STAGES(X)                                                                                  \
    X(MASTER_CURVE, master_curve, "Shift factors, WLF law, master curve, Prony series",            \
      B(DMA_FILES), 0, FLOW_OPTIONAL_NONE,                                                         \
      B(SHIFT_FACTORS) | B(MASTER_CURVE) | B(PRONY) | B(RELAXATION_SPECTRUM) | B(INFLUENCES) |     \
          B(PRONY_REDUCED) | B(MATERIAL_DRAWS) | B(SERIES_DRAWS) | B(RUBBER),                      \
      flow_step_master)                                                                            \
    X(RAMP, ramp, "Glass transition and moduli against temperature", B(DMA_FILES), 0,              \
      FLOW_OPTIONAL_NONE, B(RAMP) | B(GLASS_TRANSITION) | B(MODULI_AT), flow_step_ramp)            \
    X(PAYNE, payne, "Softening with strain", B(DMA_FILES), 0, FLOW_OPTIONAL_NONE,                  \
      B(PAYNE) | B(PAYNE_SWEEP), flow_step_payne)                                                  \
    X(GIVEN_MATERIAL, given_material, "Material as given in the case", B(GIVEN_MATERIAL), 0,       \
      FLOW_OPTIONAL_NONE, B(RUBBER), flow_step_given_material)                                     \
    X(INDENTATION_BULK, indentation_bulk, "Contact point and modulus of every bulk curve",         \
      B(BULK_CURVES), 0, FLOW_OPTIONAL_SPECTRUM,                                                   \
      B(INDENTATION_BULK) | B(CURVE_BULK) | B(DEPTH_BULK), flow_step_bulk)                         \
    X(INDENTATION_TRACK, indentation_track, "Contact point and modulus of every wear-track curve", \
      B(TRACK_CURVES), 0, FLOW_OPTIONAL_SPECTRUM,                                                  \
      B(INDENTATION_TRACK) | B(CURVE_TRACK) | B(DEPTH_TRACK), flow_step_track)                     \
    X(COMPARISON, comparison, "Wear track against bulk",                                           \
      B(INDENTATION_BULK) | B(INDENTATION_TRACK), 0, FLOW_OPTIONAL_RATE_CORRECTION,                \
      B(MODULUS_GROUPS) | B(MODULUS_BUDGET) | B(COMPARISON) | B(MODULUS_RATE) | B(MODULUS_RATIO),  \
      flow_step_compare)                                                                           \
    X(GROUPS, groups, "Modulus of the groups", 0, B(INDENTATION_BULK) | B(INDENTATION_TRACK),      \
      FLOW_OPTIONAL_NONE, B(MODULUS_GROUPS) | B(MODULUS_BUDGET) | B(MODULUS_RATE),                 \
      flow_step_groups)                                                                            \
    X(DMA_COMPARISON, dma_comparison, "Indentation against DMA, bulk",                             \
      B(INDENTATION_BULK) | B(RUBBER), 0, FLOW_OPTIONAL_TRACK, B(DMA_COMPARISON),                  \
      flow_step_dma_comparison)                                                                    \
    X(WEAR, wear, "Friction and wear as measured", B(RECORD_FILES) | B(GIVEN_WEAR), 0,             \
      FLOW_OPTIONAL_NONE, B(RECORD) | B(RECORD_CYCLES) | B(WEAR), flow_step_wear)                  \
    X(RECORD, record, "Friction as measured", B(RECORD_FILES), 0, FLOW_OPTIONAL_NONE,              \
      B(RECORD) | B(RECORD_CYCLES), flow_step_record)                                              \
    X(ROUGHNESS, roughness, "Power spectrum of the counter surface", B(COUNTER_SURFACE), 0,        \
      FLOW_OPTIONAL_NONE, B(ROUGHNESS) | B(SURFACE), flow_step_roughness)                          \
    X(TOPOGRAPHY, topography, "Power spectrum of the measured counter surface", B(HEIGHT_MAPS), 0, \
      FLOW_OPTIONAL_NONE,                                                                          \
      B(POWER_SPECTRUM) | B(PLACE_ERRORS) | B(ANGULAR_SPECTRUM) | B(SURFACES) | B(HEIGHT_MAP) |    \
          B(HEIGHT_PROFILE) | B(ROUGHNESS) | B(SURFACE),                                           \
      flow_step_topography)                                                                        \
    X(GIVEN_RATIO, given_ratio, "Modulus ratio as given in the case", B(GIVEN_RATIO), 0,           \
      FLOW_OPTIONAL_NONE, B(MODULUS_RATIO), flow_step_given_ratio)                                 \
    X(GIVEN_SOFTENING, given_softening, "Softening with strain as given in the case",              \
      B(GIVEN_SOFTENING), 0, FLOW_OPTIONAL_NONE, B(SOFTENING), flow_step_given_softening)          \
    X(SWEPT_SOFTENING, swept_softening, "Softening with strain for the sliding contact",           \
      B(PAYNE_SWEEP) | B(REQUESTED_SOFTENING), 0, FLOW_OPTIONAL_NONE, B(SOFTENING),                \
      flow_step_swept_softening)                                                                   \
    X(LAYER, layer, "Formation, wear and thickness of the modified layer",                         \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS), 0, FLOW_OPTIONAL_NONE,         \
      B(LAYER), flow_step_layer)                                                                   \
    X(TRACK_LAYER, track_layer, "Thickness of the layer by the curves",                            \
      B(INDENTATION_BULK) | B(INDENTATION_TRACK) | B(COMPARISON), 0, FLOW_OPTIONAL_STEADY_STATE,   \
      B(TRACK_LAYER), flow_step_track_layer)                                                       \
    X(ENERGY_DENSITY, energy_density, "Energy density against depth",                              \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS), 0, FLOW_OPTIONAL_NONE,         \
      B(ENERGY_DENSITY), flow_step_energy_density)                                                 \
    X(FRICTION, friction, "Contact area and friction", B(RUBBER) | B(SURFACE) | B(CONDITIONS), 0,  \
      FLOW_OPTIONAL_LAYER, B(FRICTION), flow_step_friction)                                        \
    X(CONTACT_AREA, contact_area, "Contact area against magnification",                            \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS), 0, FLOW_OPTIONAL_NONE, B(CONTACT_AREA),              \
      flow_step_contact_area)                                                                      \
    X(TRANSVERSE_ISOTROPY, transverse_isotropy, "What the directions of the material do",          \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(GIVEN_DIRECTIONS), 0, FLOW_OPTIONAL_NONE,         \
      B(TRANSVERSE_ISOTROPY), flow_step_directions)                                                \
    X(SOFTENING_EFFECT, softening_effect, "What softening with strain does",                       \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(SOFTENING), 0, FLOW_OPTIONAL_NONE,                \
      B(SOFTENING_EFFECT), flow_step_softening_effect)                                             \
    X(FRICTION_DECADES, friction_decades, "Friction by decades of the wavenumber",                 \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(REQUESTED_DECADES), 0, FLOW_OPTIONAL_NONE,        \
      B(FRICTION_DECADES), flow_step_friction_decades)                                             \
    X(IDENTIFICATION, identification, "Critical energy and wear rate of the layer that is seen",   \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(REQUESTED_IDENTIFICATION), 0, FLOW_OPTIONAL_WEAR, \
      B(IDENTIFICATION), flow_step_identification)                                                 \
    X(FLASH_EFFECT, flash_effect, "What the flash temperature does",                               \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(REQUESTED_FLASH), 0, FLOW_OPTIONAL_NONE,          \
      B(FLASH_EFFECT), flow_step_flash_effect)                                                     \
    X(WHAT_IF, what_if, "What if a choice of the model were another: friction",                    \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS), 0, FLOW_OPTIONAL_THICKNESS, B(WHAT_IF),              \
      flow_step_what_if)                                                                           \
    X(VALIDATION, validation, "Measured friction against predicted friction",                      \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(RECORD), 0, FLOW_OPTIONAL_LAYER,                  \
      B(VALIDATION) | B(VALIDATION_SOURCES), flow_step_validation)                                 \
    X(VALIDATION_RUNNING_IN, validation_running_in, "Measured running-in against the layer",       \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(LAYER_PARAMETERS) | B(MODULUS_RATIO) |            \
          B(RECORD) | B(RECORD_CYCLES),                                                            \
      0, FLOW_OPTIONAL_NONE, B(VALIDATION_RUNNING_IN) | B(VALIDATION_COURSE),                      \
      flow_step_validation_running_in)                                                             \
    X(ERROR_BUDGET, error_budget, "Which error costs the numbers most: friction",                  \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS) | B(WHAT_IF), 0, FLOW_OPTIONAL_THICKNESS,             \
      B(ERROR_BUDGET), flow_step_budget)                                                           \
    X(WORK_PRECISION, work_precision, "Error against run time: friction",                          \
      B(RUBBER) | B(SURFACE) | B(CONDITIONS), 0, FLOW_OPTIONAL_THICKNESS, B(WORK_PRECISION),       \
      flow_step_precision)

#define STAGE_ID(id, ...) FLOW_STAGE_##id,
typedef enum flow_stage_id { STAGES(STAGE_ID) FLOW_N_STAGES } flow_stage_id;

/* Largest number of optional inputs of a stage. */
enum { FLOW_OPTIONAL_INPUTS_MAX = 2 };

/* Optional inputs are used completely or not at all. `title` extends the title of the stage;
 * `label` completes "without ...". */
typedef struct flow_optional_input {
    flow_resource_set resources;
    const char *title, *label;
} flow_optional_input;

typedef struct flow_stage {
    const char *id, *title;
    flow_resource_set needs, alternatives;
    const flow_optional_input *optional_inputs; /* [FLOW_OPTIONAL_INPUTS_MAX]; the second is used
                                        only with the first; no resources marks the end */
    flow_resource_set outputs;
} flow_stage;
extern const flow_stage flow_stages[FLOW_N_STAGES];

/* Returns the highest level of a stage, which is its number of optional inputs. */
unsigned flow_stage_levels(size_t stage);
/* Returns the inputs that a stage needs at a level. */
flow_resource_set flow_stage_needs(size_t stage, unsigned level);
/* Example: "Contact area and friction, with and without the layer". */
void flow_stage_title(size_t stage, unsigned level, char *text, size_t size);

#endif
