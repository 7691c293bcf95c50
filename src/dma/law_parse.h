/* Parser of a law given as an option value. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_LAW_PARSE_H
#define WT_DMA_LAW_PARSE_H

#include "weartrack/core.h"

/* Description of a law: prefix, names and parameters. */
typedef struct flow_law_text {
    const char *prefix, *name; /* "self-affine:", "self-affine law" */
    const char *what;          /* described quantity: "roughness" */
    const char *example;       /* example text after the prefix */
    const wt_params *(*params)(void);
} flow_law_text;

/* Returns true if the text begins with the prefix. */
bool flow_has_law_prefix(const flow_law_text *law, const char *text);

/* Handles a text that was not found as a file. If the text resembles the prefix it suggests the
 * law, otherwise it returns `status`. */
wt_status flow_law_suggest(const flow_law_text *law, const char *text, wt_status status,
                           wt_error *err) WT_NODISCARD;

/* Sets the parameters that the text contains. All required parameters must be present. */
wt_status flow_law_parse(const flow_law_text *law, const char *text, void *structure,
                         wt_error *err) WT_NODISCARD;

#endif
