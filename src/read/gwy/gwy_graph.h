/* Declares the reader of graphs of a Gwyddion file. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_GWY_GRAPH_H
#define WT_READ_GWY_GRAPH_H

#include "read/gwy/gwy_object.h"
#include "read/images.h"

/* True if the key belongs to a graph of the container. */
bool gwy_is_graph(const char *key);
/* Adds the curves of a graph (the components of its object) that are profiles: lengths against
 * lengths at equal steps. Other curves are skipped with a note. */
wt_status gwy_add_profiles(image_list *list, gwy_bytes graph, const char *key, const char *file,
                           wt_log *log, wt_error *err);

#endif
