/* Reading quantities, flags and files from the nodes of a case file. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_CASE_NODE_H
#define WEARTRACK_FLOW_CASE_NODE_H

#include "flow/case/case.h"

#include <libxml/tree.h>

/* First child element of that name, NULL if there is none. */
xmlNode *case_child(const xmlNode *parent, const char *name);
/* Next sibling element of that name. */
xmlNode *case_next(const xmlNode *node, const char *name);

/* Adds "line N, <name>" to an error and returns `status`. */
wt_status case_at(const xmlNode *node, const char *attribute, wt_status status, wt_error *err);

/* Each reads a child element (or an attribute) if it is there and leaves the output alone if not.
 * Text is owned by the case. */
wt_status case_get_text(wt_case *c, const xmlNode *parent, const char *name, const char **text,
                        wt_error *err) WT_NODISCARD;
/* Text of the node itself. */
wt_status case_node_text(wt_case *c, const xmlNode *node, const char **text,
                         wt_error *err) WT_NODISCARD;
wt_status case_get_attribute(wt_case *c, const xmlNode *node, const char *name, const char **text,
                             wt_error *err) WT_NODISCARD;
wt_status case_get_estimate(wt_case *c, const xmlNode *parent, const char *name,
                            wt_quantity quantity, wt_estimate *estimate,
                            wt_error *err) WT_NODISCARD;
/* A quantity whose error has no use: stating one is refused rather than ignored. */
wt_status case_get_number(wt_case *c, const xmlNode *parent, const char *name, wt_quantity quantity,
                          double *value, wt_error *err) WT_NODISCARD;
wt_status case_get_attribute_estimate(wt_case *c, const xmlNode *node, const char *name,
                                      wt_quantity quantity, wt_estimate *estimate,
                                      wt_error *err) WT_NODISCARD;
/* The same for a value that carries no error: stating one is refused. */
wt_status case_get_attribute_number(wt_case *c, const xmlNode *node, const char *name,
                                    wt_quantity quantity, double *value, wt_error *err);
wt_status case_get_flag(wt_case *c, const xmlNode *parent, const char *name, bool *flag,
                        wt_error *err) WT_NODISCARD;
wt_status case_get_list(wt_case *c, const xmlNode *parent, const char *name, wt_quantity quantity,
                        const double **values, size_t *n, wt_error *err) WT_NODISCARD;

/* WT_E_RANGE with the place unless `good`. */
wt_status case_require(bool good, const xmlNode *parent, const char *name, const char *expected,
                       double found, wt_error *err) WT_NODISCARD;

#endif
