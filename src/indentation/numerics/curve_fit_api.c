/* Fit of a force curve as it was read: selection of segment and channels, missing channels, and
 * indentations for plots.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/data/force_curve.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <string.h>

static wt_status set_no_approach(const wt_force_curve *curve, wt_indent_fit *fit)
{
    fit->verdict = WT_CURVE_NO_APPROACH;
    size_t length = (size_t)snprintf(fit->reason, sizeof fit->reason, "segments in the curve:");
    for (size_t i = 0; i < curve->n_segments && length < sizeof fit->reason; i++)
        length +=
            (size_t)snprintf(fit->reason + length, sizeof fit->reason - length, "%s %s",
                             i == 0 ? "" : ",", wt_segment_kind_name(curve->segments[i].kind));
    if (curve->n_segments == 0)
        snprintf(fit->reason, sizeof fit->reason, "the curve has no segments");
    return WT_OK;
}

static wt_status fail_missing(wt_error *err, const wt_segment *segment, const char *quantity,
                              const char *expected, const char *advice)
{
    wt_status status = wt_fail(err, WT_E_MISSING, "%s is missing", quantity);
    wt_error_place(err, "segment %zu", segment->index);
    wt_error_expected(err, "%s", expected);
    wt_error_advice(err, "%s", advice);
    return status;
}

static wt_status fail_no_force(wt_error *err, const wt_segment *segment)
{
    if (wt_segment_channel(segment, WT_Q_DEFLECTION_VOLTAGE) != NULL)
        return fail_missing(err, segment, "the deflection sensitivity",
                            "metres per volt in the file or given",
                            "give it, e.g. --sensitivity 60nm/V");
    return fail_missing(err, segment, "the force",
                        "a channel of force, deflection or deflection voltage",
                        "see what the file holds with: weartrack info FILE");
}

/* Returns the retract; it is empty if height or force are missing. */
static curve_branch retract_branch(const wt_segment *retract, const wt_cantilever *cantilever,
                                   wt_indent_workspace *workspace)
{
    const double *height = retract != NULL ? segment_height(retract) : NULL;
    const double *force =
        height != NULL ? segment_force(retract, cantilever, workspace->input_retract) : NULL;
    return (curve_branch){height, force, NULL, force != NULL ? retract->n_points : 0};
}

wt_status wt_indent_fit_force_curve(const wt_contact_table *table, const wt_indent_options *options,
                                    const wt_force_curve *curve, wt_indent_workspace *workspace,
                                    wt_indent_fit *fit, wt_error *err)
{
    const double k = curve->cantilever.spring_constant;
    const wt_segment *approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    if (approach == NULL || approach->n_points == 0) {
        curve_fit_empty(fit);
        return set_no_approach(curve, fit);
    }
    if (isnan(k))
        return fail_missing(err, approach, "the spring constant", "a value in the file or given",
                            "give it, e.g. --spring-constant 0.1N/m");
    const double *height = segment_height(approach);
    if (height == NULL)
        return fail_missing(err, approach, "the height", "a channel of height or measured height",
                            "see what the file holds with: weartrack info FILE");
    const wt_segment *retract = wt_force_curve_segment(curve, WT_SEGMENT_RETRACT);
    const size_t n_out = retract != NULL ? retract->n_points : 0;
    curve_reserve(workspace, n_out > approach->n_points ? n_out : approach->n_points);
    const double *force = segment_force(approach, &curve->cantilever, workspace->input_force);
    if (force == NULL)
        return fail_no_force(err, approach);
    const curve_branch in = {height, force, segment_time(approach, workspace->input_time),
                             approach->n_points};
    const curve_branch out = retract_branch(retract, &curve->cantilever, workspace);
    const wt_status status =
        curve_fit_branches(table, options, &in, &out, false, k, workspace, fit, err);
    if (status == WT_OK && fit->verdict == WT_CURVE_ACCEPTED) {
        if (retract != NULL && retract < approach)
            strncat(fit->reason, "; the retract comes first in the file",
                    sizeof fit->reason - 1 - strlen(fit->reason));
    }
    return status;
}

size_t wt_indent_plot_points(const wt_indent_fit *fit, const double *height, const double *force,
                             size_t n, double spring_constant, double *delta, double *out_force)
{
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        double z = fit->direction * height[i] - fit->contact_point.value;
        double f = force[i] - fit->baseline_offset.value;
        double tilted = fit->baseline_tilt.value * z;
        if (!(z >= 0.0) || !isfinite(f))
            continue;
        out_force[m] = f - tilted;
        delta[m] = tip_position(z, out_force[m], spring_constant);
        m++;
    }
    return m;
}
