/* Overlaps of the isotherms of a fit. SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/master_fit.h"

#include "core/math/arena_gsl.h"

/* A shift with a larger error is not determined [decade]. Its 95 % interval is most of a decade,
 * as wide as a step of 5 to 10 K between isotherms. */
const double master_max_shift_error = 0.2;

void master_overlap_edges(const master_work *work, bool physical, overlap_edge *edge)
{
    const size_t n = work->set.n;
    arena memory = {0};
    double *none = arena_numbers(&memory, n), *rubber = arena_numbers(&memory, n);
    for (size_t i = 0; i < n; i++)
        rubber[i] = work->physical[i] - work->physical[work->anchor];
    overlap_chain(&work->set, work->anchor, physical ? rubber : none, physical ? none : rubber,
                  edge);
    arena_free(&memory);
}

/* Uses the vertical shift of rubber elasticity if requested, otherwise none. E' alone does not
 * separate it from the horizontal shift, and a glass has none. */
void master_find_overlaps(master_work *work)
{
    master_overlap_edges(work, work->options.vertical == WT_VERTICAL_PHYSICAL, work->edge);
}
