/* From samples to a fit without adhesion: scan of the contact point, then refinement.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "fit/curve_fitting.h"

#include <math.h>

static const double weights_matter = 1.2; /* largest 1 + S/k */

static bool scan(curve_fitting *f, bool weighted)
{
    f->n_minima = curve_scan(f->table, &f->input.samples, f->options->fit_tilt, weighted,
                             f->workspace, f->minima);
    return f->n_minima > 0;
}

/* Scan and refinement on the samples as they are now; false if nothing but a baseline is found.
 * The weights of the scan follow from a solution: any that describes the curve will do. */
bool curve_scan_and_refine(curve_fitting *f)
{
    const wt_indent_options *o = f->options;
    const curve_samples *s = &f->input.samples;
    bool fixed = !isnan(o->fixed_contact_point);
    if (fixed) {
        double c = o->fixed_contact_point - f->input.position_origin;
        if (!curve_scan_at(f->table, s, o->fit_tilt, c, f->workspace, &f->minima[0]))
            return false;
        f->n_minima = 1;
    } else {
        if (!scan(f, false))
            return false;
        if (!o->plain_least_squares &&
            curve_weights(f->table, s, &f->minima[0], f->workspace) > weights_matter &&
            !scan(f, true))
            return false;
    }
    const curve_minimum *best = &f->minima[0];
    const double start[CURVE_N_PARAMETERS] = {best->reduced_modulus, best->contact_point,
                                              best->offset, best->tilt, 0.0};
    f->kind =
        (curve_kind){.tilt = o->fit_tilt, .contact_fixed = fixed, .plain = o->plain_least_squares};
    curve_refine(f->table, s, f->kind, start, f->workspace, &f->solution);
    return true;
}
