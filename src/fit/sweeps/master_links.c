/* The overlaps of the isotherms of a fit. SPDX-License-Identifier: GPL-3.0-or-later */
#include "fit/sweeps/master.h"

#include "fit/pool_gsl.h"

/* A shift with a larger error is not determined [decade]: 95 % of it is then most of a decade, and
 * as wide as the step of 5 to 10 K between isotherms that it is to tell. */
const double master_largest_sigma = 0.2;

/* The overlaps with the vertical shift of rubber elasticity, or with none. */
wt_status master_links(const master_work *work, bool physical, double *b, overlap_link *link,
                       wt_error *err)
{
    for (size_t i = 0; i < work->set.n; i++)
        b[i] = physical ? work->physical[i] - work->physical[work->anchor] : 0.0;
    return overlap_chain(&work->set, work->anchor, b, link, err);
}

/* Vertical shifts are those of rubber elasticity if they are asked for, else there are none: the
 * storage modulus alone does not tell them from horizontal ones, and a glass has none. */
wt_status master_overlaps(master_work *work, wt_error *err)
{
    double *b = pool_numbers(&work->memory, work->set.n);
    if (b == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the overlaps");
    return master_links(work, work->options.vertical == WT_VERTICAL_PHYSICAL, b, work->link, err);
}
