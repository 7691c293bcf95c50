/* Readers for the sections of a case file. Each function also checks the rules that the schema
 * cannot express. Internal to case. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_CASE_SECTIONS_H
#define WT_CASE_CASE_SECTIONS_H

#include "case/case_node.h"

wt_status case_read_indentation(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;
wt_status case_read_dma(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;
wt_status case_read_roughness(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;
wt_status case_read_sliding(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;
/* Must run after case_read_indentation: a modulus ratio is either measured or stated. */
wt_status case_read_layer(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;
wt_status case_read_identify(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;
wt_status case_read_record(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;
wt_status case_read_compare(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;
wt_status case_read_report(wt_case *c, const xmlNode *section, wt_error *err) WT_NODISCARD;

/* Tables of the parameters that only a case has. */
const wt_params *case_prony_params(void);
const wt_params *case_term_params(void);
const wt_params *case_wlf_params(void);

#endif
