/* The representative curves: the whole curve for force against displacement, the contact part with
 * its fit for force against indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "data/force_curve.h"
#include "flow/job/indentation.h"
#include "flow/job/tables.h"

#include <stdlib.h>

enum { FD_GROUP, FD_SEGMENT, FD_DISPLACEMENT, FD_FORCE };
enum { FI_GROUP, FI_INDENTATION, FI_FORCE, FI_FITTED };

static wt_status make_tables(wt_indent_tables *tables, wt_error *err)
{
    static const flow_column displacement[] = {
        {"group", NULL, "bulk or track"},
        {"segment", NULL, "approach or retract"},
        {"displacement", "m", "piezo displacement towards the sample, from the contact point"},
        {"force", "N", "force above the baseline at contact"},
    };
    static const flow_column indentation[] = {
        {"group", NULL, "bulk or track"},
        {"indentation", "m", "indentation depth"},
        {"force", "N", "force above the baseline"},
        {"fitted_force", "N", "force of the fitted contact model"},
    };
    wt_status status = WT_OK;
    if (tables->force_displacement == NULL)
        status =
            flow_table_new("force_displacement", "Force against piezo displacement", displacement,
                           FLOW_COUNT(displacement), &tables->force_displacement, err);
    if (status == WT_OK && tables->force_indentation == NULL)
        status = flow_table_new("force_indentation", "Force against indentation", indentation,
                                FLOW_COUNT(indentation), &tables->force_indentation, err);
    return status;
}

static wt_status set_keys(wt_table *table, const char *group, const char *file,
                          const wt_force_curve *curve, const wt_indent_fit *fit, wt_error *err)
{
    char key[96];
    snprintf(key, sizeof key, "curve_%s", group);
    wt_status status = flow_table_key(table, err, key, "%s curve %zu", file, curve->index);
    if (status != WT_OK)
        return status;
    snprintf(key, sizeof key, "contact_point_%s", group);
    status = flow_table_value(table, key, 0, fit->contact_point.standard_error, 0, "m", err);
    if (status != WT_OK)
        return status;
    snprintf(key, sizeof key, "contact_force_%s", group);
    return flow_table_value(table, key, 0, fit->baseline_offset.standard_error, 0, "N", err);
}

/* sign: +1 if the height rises towards the sample. */
static wt_status add_segment(wt_table *table, const char *group, const wt_segment *segment,
                             double sign, const wt_indent_fit *fit, const double *force,
                             wt_error *err)
{
    const double *height = segment_height(segment);
    wt_status status = WT_OK;
    if (height == NULL)
        return WT_OK;
    for (size_t i = 0; status == WT_OK && i < segment->n_points; i++) {
        if (!isfinite(height[i]) || !isfinite(force[i]))
            continue;
        status = wt_table_add_row(table, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, FD_GROUP, group, err);
        if (status == WT_OK)
            status = wt_table_put_text(table, FD_SEGMENT, wt_segment_kind_name(segment->kind), err);
        if (status != WT_OK)
            return status;
        wt_table_put(table, FD_DISPLACEMENT, sign * height[i] - fit->contact_point.value);
        wt_table_put(table, FD_FORCE, force[i] - fit->baseline_offset.value);
    }
    return status;
}

wt_status flow_curve_tables_add(wt_indent_tables *tables, const char *group, const char *file,
                                const wt_force_curve *curve, const wt_indent_fit *fit,
                                const wt_contact_table *contact, double poisson_ratio,
                                wt_error *err)
{
    const wt_segment *approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    const wt_segment *retract = wt_force_curve_segment(curve, WT_SEGMENT_RETRACT);
    const double *height = approach == NULL ? NULL : segment_height(approach);
    if (height == NULL || approach->n_points < 2)
        return WT_OK;
    double k = curve->cantilever.spring_constant;
    size_t longest = approach->n_points;
    if (retract != NULL && retract->n_points > longest)
        longest = retract->n_points;
    double *scratch = malloc(4 * longest * sizeof *scratch);
    if (scratch == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    double *delta = scratch + longest, *shown = scratch + 2 * longest,
           *model = scratch + 3 * longest;
    const double *force = segment_force(approach, &curve->cantilever, scratch);
    const double sign = fit->direction;

    wt_status status = make_tables(tables, err);
    if (status != WT_OK || force == NULL)
        goto done;
    if (wt_table_n_rows(tables->force_displacement) > 0)
        status = wt_table_new_block(tables->force_displacement, err);
    if (status == WT_OK && wt_table_n_rows(tables->force_indentation) > 0)
        status = wt_table_new_block(tables->force_indentation, err);
    if (status == WT_OK)
        status = set_keys(tables->force_displacement, group, file, curve, fit, err);
    if (status == WT_OK)
        status = add_segment(tables->force_displacement, group, approach, sign, fit, force, err);
    if (status != WT_OK)
        goto done;

    size_t n = wt_indent_curve(fit, height, force, approach->n_points, k, delta, shown);
    wt_contact_table_eval(contact, delta, n, model, NULL);
    double effective = fit->modulus.value / (1 - poisson_ratio * poisson_ratio);
    for (size_t i = 0; status == WT_OK && i < n; i++) {
        status = wt_table_add_row(tables->force_indentation, err);
        if (status == WT_OK)
            status = wt_table_put_text(tables->force_indentation, FI_GROUP, group, err);
        if (status != WT_OK)
            goto done;
        wt_table_put(tables->force_indentation, FI_INDENTATION, delta[i]);
        wt_table_put(tables->force_indentation, FI_FORCE, shown[i]);
        wt_table_put(tables->force_indentation, FI_FITTED, effective * model[i]);
    }
    if (status == WT_OK && retract != NULL)
        force = segment_force(retract, &curve->cantilever, scratch);
    if (status == WT_OK && retract != NULL && force != NULL)
        status = add_segment(tables->force_displacement, group, retract, sign, fit, force, err);
done:
    free(scratch);
    return status;
}
