/* Range of the fit: the samples in contact that are compared with the law. Deeper samples are
 * excluded. Shallower samples are modelled, because they affect viscoelastic rubber, but not
 * compared. The contact point is free, and the fit includes the baseline.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"

#include "indentation/law/tip.h"

#include <math.h>

/* Limits of the iterations. After six rounds the range may only change in one direction, which ends
 * a cycle. */
enum { MAX_ROUNDS = 12, FREE_ROUNDS = 6 };

static wt_status check_limit_order(const char *from_name, double from, const char *to_name,
                                   double to, wt_error *err)
{
    if (!(to > 0.0) || from < to)
        return WT_OK;
    const wt_status status = wt_fail(err, WT_E_RANGE, "the range of the fit is empty");
    wt_error_expected(err, "%s below %s", from_name, to_name);
    wt_error_found(err, "%g and %g", from, to);
    return status;
}

wt_status curve_range_check(const wt_indent_options *o, const wt_tip *tip, wt_error *err)
{
    if (o->fit_radii > 0.0 && !(tip->radius > 0.0)) {
        const wt_status status = wt_fail(err, WT_E_RANGE, "a sharp tip has no radius");
        wt_error_expected(err, "fit-depth in place of fit-radii, or the radius of the tip");
        return status;
    }
    wt_status status =
        check_limit_order("fit-depth-from", o->fit_depth_from, "fit-depth", o->fit_depth, err);
    if (status == WT_OK)
        status = check_limit_order("fit-depth-from", o->fit_depth_from, "fit-radii",
                                   o->fit_radii * tip->radius, err);
    if (status == WT_OK)
        status =
            check_limit_order("fit-force-from", o->fit_force_from, "fit-force", o->fit_force, err);
    if (status == WT_OK)
        status = check_limit_order("fit-force-fraction-from", o->fit_force_fraction_from,
                                   "fit-force-fraction", o->fit_force_fraction, err);
    return status;
}

/* ---- positions of the limits ----------------------------------------------------------------- */

static double sample_force(const curve_fitting *f, size_t i)
{
    const curve_samples *s = &f->input.samples;
    return s->force[i] - curve_baseline(&f->solution, s->position[i]);
}

static double sample_depth(const curve_fitting *f, size_t i)
{
    const curve_samples *s = &f->input.samples;
    return s->position[i] - f->solution.p[CURVE_C] - sample_force(f, i) / s->spring_constant;
}

static size_t count_samples(const curve_fitting *f)
{
    return f->input.n_all - f->n_snap;
}

/* Returns the first sample in contact beyond a limit. It is halfway between the first sample above
 * and the last below, so that noise does not decide. */
static size_t limit_crossing(const curve_fitting *f, double (*value)(const curve_fitting *, size_t),
                             double limit)
{
    const size_t n = count_samples(f);
    size_t first_above = n, last_below = f->solution.first_contact;
    for (size_t i = f->solution.first_contact; i < n; i++) {
        if (value(f, i) <= limit)
            last_below = i;
        else if (first_above == n)
            first_above = i;
    }
    return (first_above + last_below + 1) / 2;
}

static double max_sample_force(const curve_fitting *f)
{
    double largest = 0.0;
    for (size_t i = 0; i < count_samples(f); i++)
        largest = fmax(largest, sample_force(f, i));
    return largest;
}

/* Samples from `from` to before `to` are in the range. */
typedef struct sample_range {
    size_t from, to;
} sample_range;

static sample_range find_fit_range(const curve_fitting *f)
{
    const wt_indent_options *o = f->options;
    double deepest = (double)INFINITY, strongest = (double)INFINITY, weakest = o->fit_force_from;
    if (o->fit_depth > 0.0)
        deepest = o->fit_depth;
    if (o->fit_radii > 0.0)
        deepest = fmin(deepest, o->fit_radii * contact_table_tip(f->table)->radius);
    if (o->fit_force > 0.0)
        strongest = o->fit_force;
    if (o->fit_force_fraction < 1.0 || o->fit_force_fraction_from > 0.0) {
        const double largest = max_sample_force(f);
        weakest = fmax(weakest, o->fit_force_fraction_from * largest);
        if (o->fit_force_fraction < 1.0)
            strongest = fmin(strongest, o->fit_force_fraction * largest);
    }
    sample_range r = {f->solution.first_contact, count_samples(f)};
    if (isfinite(deepest))
        r.to = limit_crossing(f, sample_depth, deepest);
    if (isfinite(strongest)) {
        const size_t to = limit_crossing(f, sample_force, strongest);
        r.to = to < r.to ? to : r.to;
    }
    if (o->fit_depth_from > 0.0)
        r.from = limit_crossing(f, sample_depth, o->fit_depth_from);
    if (weakest > 0.0) {
        const size_t from = limit_crossing(f, sample_force, weakest);
        r.from = from > r.from ? from : r.from;
    }
    r.from = r.from < r.to ? r.from : r.to;
    return r;
}

size_t curve_count_in_range(const curve_fitting *f)
{
    const curve_samples *s = &f->input.samples;
    const size_t first =
        s->gap_to > f->solution.first_contact ? s->gap_to : f->solution.first_contact;
    return s->n > first ? s->n - first : 0;
}

/* ---- fit of the range ------------------------------------------------------------------------ */

static bool has_limits(const wt_indent_options *o)
{
    return o->fit_depth > 0.0 || o->fit_radii > 0.0 || o->fit_force > 0.0 ||
           o->fit_force_fraction < 1.0 || o->fit_depth_from > 0.0 || o->fit_force_from > 0.0 ||
           o->fit_force_fraction_from > 0.0;
}

/* The range depends on the contact point and the contact point on the range, so the fit iterates.
 */
bool curve_fit_range(curve_fitting *f)
{
    curve_samples *s = &f->input.samples;
    if (!has_limits(f->options))
        return true;
    for (int round = 0; round < MAX_ROUNDS; round++) {
        sample_range now = find_fit_range(f);
        const bool has_lower_limit = now.from > f->solution.first_contact;
        size_t gap_from = has_lower_limit ? f->solution.first_contact : 0;
        size_t gap_to = has_lower_limit ? now.from : 0;
        if (round >= FREE_ROUNDS) { /* prevents a cycle */
            now.to = now.to < s->n ? now.to : s->n;
            gap_to = gap_to > s->gap_to ? gap_to : s->gap_to;
            gap_from = gap_from < s->gap_from ? gap_from : s->gap_from;
        }
        const bool same_end = now.to == s->n;
        if (same_end && gap_from == s->gap_from && gap_to == s->gap_to)
            return true;
        s->n = now.to;
        s->gap_from = gap_from;
        s->gap_to = gap_to;
        if (curve_count_in_range(f) < CURVE_CONTACT_SAMPLES) {
            f->range_empty = true; /* the verdict reports it */
            return true;
        }
        if (same_end || f->kind.adhesive)
            curve_refine(f->table, s, f->kind, f->solution.p, f->workspace, &f->solution);
        else if (!curve_scan_and_refine(f))
            return false;
    }
    f->range_converged = false;
    return true;
}
