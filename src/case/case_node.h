/* Functions that read parameters, text, file sets and sections from the nodes of a case file.
 * Internal to case. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_CASE_NODE_H
#define WT_CASE_CASE_NODE_H

#include "case/case.h"

#include <libxml/tree.h>

/* Returns the first child element with the name, NULL if there is none. */
xmlNode *case_child(const xmlNode *parent, const char *name);

/* Returns the text of a node. The case owns the text. */
const char *case_node_text(wt_case *c, const xmlNode *node);
/* Returns the element name of a parameter: in <sliding>, "sliding-temperature" is "temperature". */
const char *case_param_name(const char *section, const char *param);
/* Table of the attributes of a file set that only a case has. */
const wt_params *case_group_params(void);

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
