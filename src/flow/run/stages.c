/* The table of stages.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/run/stages.h"
#include "flow/run/steps.h"

#define B FLOW_BIT

const flow_stage flow_stages[] = {
    {"indentation_bulk", "Contact point and modulus of every bulk curve", B(FLOW_BULK_CURVES),
     B(FLOW_INDENTATION_BULK) | B(FLOW_CURVE_BULK), flow_step_bulk},
    {"indentation_track", "Contact point and modulus of every wear-track curve",
     B(FLOW_TRACK_CURVES), B(FLOW_INDENTATION_TRACK) | B(FLOW_CURVE_TRACK), flow_step_track},
    {"comparison", "Wear track against bulk", B(FLOW_INDENTATION_BULK) | B(FLOW_INDENTATION_TRACK),
     B(FLOW_MODULUS_GROUPS) | B(FLOW_COMPARISON) | B(FLOW_MODULUS_RATE) | B(FLOW_MODULUS_RATIO),
     flow_step_compare},
    {"groups", "Modulus of bulk and wear track",
     B(FLOW_INDENTATION_BULK) | B(FLOW_INDENTATION_TRACK),
     B(FLOW_MODULUS_GROUPS) | B(FLOW_MODULUS_RATE), flow_step_groups},
    {"bulk_alone", "Modulus of the bulk", B(FLOW_INDENTATION_BULK),
     B(FLOW_MODULUS_GROUPS) | B(FLOW_MODULUS_RATE), flow_step_groups},
    {"track_alone", "Modulus of the wear track", B(FLOW_INDENTATION_TRACK),
     B(FLOW_MODULUS_GROUPS) | B(FLOW_MODULUS_RATE), flow_step_groups},
    {"master_curve", "Shift factors, WLF law, master curve, Prony series", B(FLOW_DMA_FILES),
     B(FLOW_SHIFT_FACTORS) | B(FLOW_MASTER_CURVE) | B(FLOW_PRONY) | B(FLOW_RUBBER),
     flow_step_master},
    {"given_material", "Material as given in the case", B(FLOW_GIVEN_MATERIAL), B(FLOW_RUBBER),
     flow_step_given_material},
    {"dma_comparison", "Indentation of bulk and wear track against DMA",
     B(FLOW_INDENTATION_BULK) | B(FLOW_INDENTATION_TRACK) | B(FLOW_RUBBER), B(FLOW_DMA_COMPARISON),
     flow_step_dma_comparison},
    {"dma_comparison_bulk", "Indentation of the bulk against DMA",
     B(FLOW_INDENTATION_BULK) | B(FLOW_RUBBER), B(FLOW_DMA_COMPARISON), flow_step_dma_comparison},
    {"roughness", "Power spectrum of the counter surface", B(FLOW_COUNTER_SURFACE),
     B(FLOW_ROUGHNESS) | B(FLOW_SURFACE), flow_step_roughness},
    {"given_ratio", "Modulus ratio as given in the case", B(FLOW_GIVEN_RATIO),
     B(FLOW_MODULUS_RATIO), flow_step_given_ratio},
    {"layer", "Formation, wear and thickness of the modified layer",
     B(FLOW_RUBBER) | B(FLOW_SURFACE) | B(FLOW_CONDITIONS) | B(FLOW_LAYER_PARAMETERS),
     B(FLOW_LAYER) | B(FLOW_ENERGY_DENSITY), flow_step_layer},
    {"friction_with_layer", "Contact area and friction, with and without the layer",
     B(FLOW_RUBBER) | B(FLOW_SURFACE) | B(FLOW_CONDITIONS) | B(FLOW_LAYER) | B(FLOW_MODULUS_RATIO),
     B(FLOW_FRICTION) | B(FLOW_CONTACT_AREA), flow_step_friction_with_layer},
    {"friction", "Contact area and friction", B(FLOW_RUBBER) | B(FLOW_SURFACE) | B(FLOW_CONDITIONS),
     B(FLOW_FRICTION) | B(FLOW_CONTACT_AREA), flow_step_friction},
};
const size_t flow_n_stages = sizeof flow_stages / sizeof flow_stages[0];

_Static_assert(sizeof flow_stages / sizeof flow_stages[0] <= FLOW_MAX_STAGES,
               "a plan has room for every stage");
_Static_assert(FLOW_N_THINGS <= 64, "a set of things is a 64-bit number");
