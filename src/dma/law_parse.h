/* A law in one word, as an option has it.
 * Internal to dma. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_LAW_PARSE_H
#define WT_DMA_LAW_PARSE_H

#include "weartrack/flow.h"

/* A law in one word: "self-affine:q0=1e3rad/m,...". */
typedef struct flow_law_text {
    const char *prefix, *name; /* "self-affine:", "self-affine law" */
    const char *what;          /* it is a law of: "roughness" */
    const char *example;       /* after the prefix */
    const wt_params *(*params)(void);
} flow_law_text;
/* Whether the text begins with the prefix. */
bool flow_is_law(const flow_law_text *law, const char *text);
/* Where reading the text as a file ended with WT_E_NOT_FOUND and it is nearly the prefix, says
 * which law is meant; else the status. */
wt_status flow_law_meant(const flow_law_text *law, const char *text, wt_status status,
                         wt_error *err) WT_NODISCARD;
/* Sets the parameters that are there; all required ones must be. */
wt_status flow_law_parse(const flow_law_text *law, const char *text, void *structure,
                         wt_error *err) WT_NODISCARD;

#endif
