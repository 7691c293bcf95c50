/* Parameter tables of the sections of a case, for the checks and the generated texts.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_PARAMS_SECTIONS_H
#define TESTS_PARAMS_SECTIONS_H

#include "case/case_node.h"
#include "core/base/param.h"
#include "dma/rubber.h"
#include "friction/counter_surface.h"
#include "job/inputs.h"

enum { SECTION_TABLES = 4 };

static const struct {
    const char *name;
    const wt_params *(*params[SECTION_TABLES])(void);
} case_sections[] = {
    {"indentation", {wt_indent_job_params, wt_compare_job_params}},
    {"dma", {wt_master_job_params, wt_ramp_job_params, wt_reduction_params}},
    {"fractional-zener", {flow_zener_params, NULL}},
    {"transverse", {wt_transverse_params, NULL}},
    {"wlf", {case_wlf_params, NULL}},
    {"self-affine", {flow_self_affine_params, NULL}},
    {"spectrum", {flow_spectrum_params, NULL}},
    {"measured", {wt_topography_job_params, NULL}},
    {"sliding", {wt_sliding_params, NULL}},
    {"layer", {wt_layer_job_params, wt_layer_observation_params}},
    {"identify", {wt_identify_job_params}},
    {"record", {wt_record_job_params, wt_validation_job_params, NULL}},
};
enum { N_CASE_SECTIONS = sizeof case_sections / sizeof case_sections[0] };

#endif
