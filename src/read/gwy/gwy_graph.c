/* Reads the graphs of a Gwyddion file, in which profiles are stored.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/gwy/gwy_graph.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Tolerance of equal steps, relative to a step. It changes no spectrum noticeably. */
static const double step_tolerance = 1e-3;

static const char prefix[] = "/0/graph/graph/";

bool gwy_is_graph(const char *key)
{
    return strncmp(key, prefix, sizeof prefix - 1) == 0 &&
           strspn(key + sizeof prefix - 1, "0123456789") == strlen(key + sizeof prefix - 1);
}

static bool has_equal_steps(const double *x, size_t n)
{
    const double step = (x[n - 1] - x[0]) / (double)(n - 1);
    bool equal = step > 0 && isfinite(step);
    for (size_t i = 0; equal && i < n; i++)
        equal = fabs(x[i] - x[0] - step * (double)i) <= step_tolerance * step;
    return equal;
}

static wt_status add_graph_profile(image_list *list, gwy_bytes graph, gwy_bytes curve,
                                   const char *key, const char *file, wt_log *log, wt_error *err)
{
    gwy_component x, y, title;
    double lateral = 1, vertical = 1, offset = 0, *values = NULL;
    const bool whole = gwy_find_component(curve, "xdata", 'D', &x) &&
                       gwy_find_component(curve, "ydata", 'D', &y) && x.n == y.n && x.n > 1;
    const bool lengths =
        whole &&
        wt_unit_to_si(gwy_unit(graph, "x_unit"), WT_Q_LENGTH, &lateral, &offset, NULL) == WT_OK &&
        wt_unit_to_si(gwy_unit(graph, "y_unit"), WT_Q_LENGTH, &vertical, &offset, NULL) == WT_OK;
    double *const positions = lengths ? malloc(x.n * sizeof *positions) : NULL;
    if (lengths && positions == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a profile");
    if (lengths)
        (void)samples_decode(SAMPLE_FLOAT64, false, x.value.at, x.n, lateral, 0, positions);
    wt_status status = WT_OK;
    if (!lengths || !has_equal_steps(positions, x.n)) {
        wt_log_add(log, WT_NOTE, file, key,
                   "a graph that is no profile is left out: lengths against lengths at equal "
                   "steps would be one");
    } else {
        wt_image head = {.n_columns = x.n,
                         .n_rows = 1,
                         .unit = "m",
                         .x_unit = "m",
                         .width = positions[x.n - 1] - positions[0],
                         .x_min = positions[0]};
        images_set_name(&head, gwy_find_component(graph, "title", 's', &title)
                                   ? (const char *)title.value.at
                                   : "profile");
        status = images_add(list, &head, &values, err);
        if (status == WT_OK)
            (void)samples_decode(SAMPLE_FLOAT64, false, y.value.at, y.n, vertical, 0, values);
    }
    free(positions);
    return status;
}

wt_status gwy_add_profiles(image_list *list, gwy_bytes graph, const char *key, const char *file,
                           wt_log *log, wt_error *err)
{
    gwy_component curves;
    wt_status status = WT_OK;
    if (!gwy_find_component(graph, "curves", 'O', &curves))
        return WT_OK;
    for (size_t i = 0; status == WT_OK && i < curves.n; i++) {
        const char *name = NULL;
        gwy_bytes curve;
        if (!gwy_read_object(&curves.value, &name, &curve))
            break; /* all objects were checked before */
        status = add_graph_profile(list, graph, curve, key, file, log, err);
    }
    return status;
}
