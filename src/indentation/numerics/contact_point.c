/* Fit without adhesion from the scan of the contact point.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"

#include <math.h>

/* ---- fit without adhesion -------------------------------------------------------------------- */

/* Fit without adhesion: scan of the contact point, refinement, and a viscoelastic refinement if
 * the spectrum of the rubber is known. */

static const double better_chi2 = 9.0; /* smallest 2 ln(likelihood ratio) against viscoelasticity */

/* Finds the times of the remaining samples, which are a subset of the measured ones in the same
 * order. Returns false unless the times rise. */
static bool match_sample_times(const curve_fitting *f)
{
    const curve_samples *s = &f->input.samples;
    const curve_branch *measured = f->approach;
    double *time = f->workspace->time;
    size_t i = 0;
    for (size_t j = 0; measured->time != NULL && j < measured->n && i < s->n; j++) {
        const double z = f->input.direction * measured->height[j] - f->input.position_origin,
                     force = measured->force[j] - f->input.force_origin;
        if (z - s->position[i] != 0.0 || force - f->workspace->force[i] != 0.0)
            continue;
        time[i] = measured->time[j];
        if (i > 0 && !(time[i] > time[i - 1]))
            return false;
        i++;
    }
    return i == s->n;
}

bool curve_prepare_relaxation(curve_fitting *f, const wt_prony *series, bool in_loading_times)
{
    wt_indent_workspace *w = f->workspace;
    const curve_samples *s = &f->input.samples;
    const size_t first = f->solution.first_contact;
    if (first < 1 || first + 1 >= s->n || !match_sample_times(f))
        return false;
    const double load = w->time[s->n - 1] - w->time[first - 1];
    double shortest = load;
    for (size_t i = 0; in_loading_times && i < s->n; i++)
        w->time[i] /= load;
    for (size_t i = first; i < s->n; i++)
        shortest = fmin(shortest, w->time[i] - w->time[i - 1]);
    f->unit = hereditary_modulus(series, in_loading_times ? 1.0 : 1.0 / load);
    hereditary_begin(&w->memory, series, 1.0 / f->unit, shortest, w->time[s->n - 1] - w->time[0]);
    return true;
}

/* Refits an elastic solution with the spectrum of the options if the times are known. A curve that
 * the elastic fit describes better has another spectrum. */
static void refit_with_spectrum(curve_fitting *f)
{
    const curve_solution elastic = f->solution;
    if (!curve_prepare_relaxation(f, f->options->spectrum, false))
        return;
    f->kind.memory = true;
    curve_refine(f->table, &f->input.samples, f->kind, elastic.p, f->workspace, &f->solution);
    f->spectrum_mismatch = elastic.effective_n * log(f->solution.cost / elastic.cost) > better_chi2;
    if (f->solution.converged && !f->spectrum_mismatch)
        return;
    f->kind.memory = false;
    f->solution = elastic;
}

bool curve_scan_and_refine(curve_fitting *f)
{
    const wt_indent_options *o = f->options;
    const curve_samples *s = &f->input.samples;
    bool fixed = !isnan(o->fixed_contact_point);
    if (fixed) {
        double c = o->fixed_contact_point - f->input.position_origin;
        if (!curve_scan_point(f->table, s, o->fit_tilt, c, f->workspace, &f->minima[0]))
            return false;
        f->n_minima = 1;
    } else {
        f->n_minima =
            curve_scan(f->table, s, o->fit_tilt, !o->plain_least_squares, f->workspace, f->minima);
        if (f->n_minima == 0)
            return false;
    }
    const curve_minimum *best = &f->minima[0];
    const double start[CURVE_N_PARAMETERS] = {best->reduced_modulus, best->contact_point,
                                              best->offset, best->tilt, 0.0};
    f->kind = (curve_kind){.tilt = o->fit_tilt,
                           .contact_fixed = fixed,
                           .plain = o->plain_least_squares,
                           .wave = f->kind.wave};
    curve_refine(f->table, s, f->kind, start, f->workspace, &f->solution);
    if (o->spectrum != NULL && !o->plain_least_squares)
        refit_with_spectrum(f);
    return true;
}
