/* Start of the fit: places the isotherms one by one from the anchor outwards.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/numerics/spectrum_start.h"

#include <math.h>

/* Number of neighbours on which an isotherm is tried before it counts as unplaced. */
enum { NEIGHBOURS = 3 };

/* Places curve i on the nearest placed curve towards the anchor, or on the one after it if that
 * fails. */
static void find_initial_shift(const shift_set *set, size_t anchor, wt_vertical_shift kind,
                               size_t i, bool *placed, double *a, double *b)
{
    const bool free_b = set->used[STORAGE] && set->used[LOSS] &&
                        (kind == WT_VERTICAL_FREE || kind == WT_VERTICAL_TIED);
    if (placed[i])
        return;
    const long inwards = i > anchor ? -1 : 1;
    int tried = 0;
    for (long p = (long)i + inwards; tried < NEIGHBOURS; p += inwards) {
        double by = 0.0, vertical = b[i] - b[p];
        if (placed[p]) {
            tried++;
            placed[i] = shift_pair_fit(set, (size_t)p, i, free_b, &by, &vertical);
        }
        if (placed[i]) {
            a[i] = a[p] + by;
            b[i] = b[p] + vertical;
            return;
        }
        if ((size_t)p == anchor)
            return;
    }
}

void spectrum_find_initial_shifts(const shift_set *set, size_t anchor, wt_vertical_shift kind,
                                  const double *physical, bool *placed, double *a, double *b)
{
    /* a table for another reference includes the vertical shift of this one in all rows */
    const shift_curve *at = &set->curves[anchor];
    const double off =
        at->is_vertical_fixed && at->fixed_log_a != 0.0 ? at->fixed_log_b - physical[anchor] : 0.0;
    for (size_t i = 0; i < set->n; i++) {
        const shift_curve *c = &set->curves[i];
        placed[i] = i == anchor || (c->is_shift_fixed && c->n >= SHIFT_MIN_POINTS);
        a[i] = c->is_shift_fixed ? c->fixed_log_a - set->curves[anchor].fixed_log_a : 0.0;
        b[i] = c->is_vertical_fixed ? c->fixed_log_b - off
               : kind == WT_VERTICAL_NONE || set->quantity == WT_SHIFT_LOSS_FACTOR ? 0.0
                                                                                   : physical[i];
    }
    for (size_t i = anchor + 1; i < set->n; i++)
        find_initial_shift(set, anchor, kind, i, placed, a, b);
    for (size_t i = anchor; i-- > 0;)
        find_initial_shift(set, anchor, kind, i, placed, a, b);
}

static double shared_decades(const shift_curve *p, double a_p, const shift_curve *s, double a_s)
{
    return fmin(p->x[p->n - 1] + a_p, s->x[s->n - 1] + a_s) - fmax(p->x[0] + a_p, s->x[0] + a_s);
}

size_t spectrum_select_connected(const shift_set *set, size_t anchor, const double *a, bool *placed,
                                 double *overlap)
{
    size_t count = 1;
    for (size_t i = 0; i < set->n; i++)
        overlap[i] = i == anchor || (placed[i] && set->curves[i].is_shift_fixed) ? HUGE_VAL : 0.0;
    /* The overlap of an isotherm is the largest minimum overlap on a path to the anchor. */
    for (bool grown = true; grown;) {
        grown = false;
        for (size_t i = 0; i < set->n; i++)
            for (size_t p = 0; placed[i] && p < set->n; p++) {
                if (p == i || !placed[p])
                    continue;
                const double both =
                    fmin(shared_decades(&set->curves[p], a[p], &set->curves[i], a[i]), overlap[p]);
                if (both > overlap[i]) {
                    overlap[i] = both;
                    grown = true;
                }
            }
    }
    for (size_t i = 0; i < set->n; i++) {
        placed[i] = placed[i] && overlap[i] > 0.0;
        count += placed[i] && i != anchor;
    }
    return count;
}
