/* Aligns force curves at their contact points: the fitted contact and baseline are applied to every
 * sample. SPDX-License-Identifier: GPL-3.0-or-later */
#include "job/aligned_curves.h"

#include "core/data/force_curve.h"
#include "core/table/registry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Largest relative difference of the maximum force from that of the result. The fit may exclude
 * samples at the end of the curve; a larger difference means another calibration. */
static const double force_tolerance = 0.02;

wt_status contact_points_read(const char *path, const wt_job *work, contact_points *points,
                              wt_error *err)
{
    static const wt_tables_role role = {
        .curve_role = "contact points",
        .other_role = "contact points",
        .instead = "what weartrack indent or weartrack run wrote of these curves"};
    *points = (contact_points){.path = path};
    return wt_tables_read(path, path, work, role, &points->tables, err);
}

void contact_points_clear(contact_points *points)
{
    wt_result_free(points->tables);
    *points = (contact_points){NULL, NULL};
}

/* Contact point of a curve, and its baseline at this point. */
typedef struct curve_contact {
    double point, offset, tilt, max_force;
} curve_contact;

/* Search for the row of a curve. A row with the exact name of the file takes precedence over rows
 * whose paths have the same end. */
typedef struct row_search {
    const flow_file *file;
    size_t curve;
    flow_name_match best;
    bool is_ambiguous; /* another row matches equally well */
    curve_contact contact;
    char verdict[64];
} row_search;

static void search_indentation_table(row_search *s, const table_view *view)
{
    for (size_t row = 0; row < view->n_rows; row++) {
        const double number = indentation_get(view, row, INDENTATION_CURVE);
        if (!(number >= 0 && (size_t)number == s->curve))
            continue;
        const char *name = indentation_text(view, row, INDENTATION_FILE);
        const flow_name_match as = flow_file_match(s->file, name, strlen(name));
        if (as == FLOW_NAME_DIFFERENT || as < s->best)
            continue;
        s->is_ambiguous = as == s->best;
        s->best = as;
        s->contact = (curve_contact){indentation_get(view, row, INDENTATION_CONTACT_POINT),
                                     indentation_get(view, row, INDENTATION_BASELINE_OFFSET),
                                     indentation_get(view, row, INDENTATION_BASELINE_TILT),
                                     indentation_get(view, row, INDENTATION_MAX_FORCE)};
        snprintf(s->verdict, sizeof s->verdict, "%s",
                 indentation_text(view, row, INDENTATION_VERDICT));
    }
}

static wt_status find_contact(const contact_points *points, const flow_file *file, size_t curve,
                              curve_contact *to, wt_error *err)
{
    const char *const prefix = indentation_schema.name;
    row_search s = {.file = file, .curve = curve, .best = FLOW_NAME_DIFFERENT};
    for (size_t i = 0; i < wt_result_n_tables(points->tables); i++) {
        const wt_table *table = wt_result_table(points->tables, i);
        table_view view;
        if (strncmp(wt_table_name(table), prefix, strlen(prefix)) != 0)
            continue;
        const wt_status status = table_bind(table, &indentation_schema,
                                            wt_table_name(table) + strlen(prefix), &view, err);
        if (status != WT_OK)
            return status;
        search_indentation_table(&s, &view);
    }
    if (s.best == FLOW_NAME_DIFFERENT) {
        wt_fail(err, WT_E_NOT_FOUND, "the curve is not in %s", points->path);
        wt_error_advice(err, "give the result that weartrack indent made of this file");
        return WT_E_NOT_FOUND;
    }
    if (s.is_ambiguous) {
        wt_fail(err, WT_E_AMBIGUOUS, "two files of %s are called so", points->path);
        wt_error_advice(err, "name the file by the path that it has there");
        return WT_E_AMBIGUOUS;
    }
    *to = s.contact;
    if (isfinite(to->point) && isfinite(to->offset) && isfinite(to->tilt))
        return WT_OK;
    return wt_fail(err, WT_E_NOT_FOUND, "no contact point in %s: %s", points->path, s.verdict);
}

static void set_channel_label(wt_channel *channel, wt_quantity quantity, const char *name)
{
    channel->quantity = quantity;
    snprintf(channel->name, sizeof channel->name, "%s", name);
    snprintf(channel->unit, sizeof channel->unit, "%s", wt_quantity_unit(quantity));
}

/* Adds one segment; a segment without height or force is skipped. force: scratch [n_points]. */
static wt_status add_aligned_segment(const wt_segment *from, const wt_cantilever *cantilever,
                                     double direction, const curve_contact *contact, double *force,
                                     wt_force_curve *to, wt_error *err)
{
    enum { HEIGHT, FORCE, INDENTATION, TIME };
    const double *height = segment_height(from);
    const double *measured = segment_force(from, cantilever, force);
    const wt_channel *time = wt_segment_channel(from, WT_Q_TIME);
    if (height == NULL || measured == NULL)
        return WT_OK;
    wt_segment *s =
        wt_force_curve_add_segment(to, from->kind, from->n_points, time != NULL ? TIME + 1 : TIME);
    if (s == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    s->index = from->index;
    s->duration = from->duration;
    s->setpoint = from->setpoint;
    s->velocity = from->velocity;
    s->frequency = from->frequency;
    set_channel_label(&s->channels[HEIGHT], WT_Q_HEIGHT, "height from the contact point");
    set_channel_label(&s->channels[FORCE], WT_Q_FORCE, "force above the baseline");
    set_channel_label(&s->channels[INDENTATION], WT_Q_INDENTATION, "indentation");
    for (size_t i = 0; i < from->n_points; i++) {
        const double z = direction * height[i] - contact->point;
        const double f = measured[i] - contact->offset - contact->tilt * z;
        s->channels[HEIGHT].values[i] = z;
        s->channels[FORCE].values[i] = f;
        s->channels[INDENTATION].values[i] = tip_position(z, f, cantilever->spring_constant);
    }
    if (time != NULL) {
        set_channel_label(&s->channels[TIME], WT_Q_TIME, time->name);
        memcpy(s->channels[TIME].values, time->values, from->n_points * sizeof *time->values);
    }
    return WT_OK;
}

/* Returns +1 if the height increases into the sample, else -1, like the fit. */
static double height_direction(const wt_segment *approach)
{
    const double *height = approach != NULL ? segment_height(approach) : NULL;
    size_t first = 0, last = height != NULL ? approach->n_points : 0;
    while (first < last && !isfinite(height[first]))
        first++;
    while (last > first && !isfinite(height[last - 1]))
        last--;
    if (first == last)
        return (double)NAN;
    return height[last - 1] < height[first] ? -1 : 1;
}

static double largest_approach_force(const wt_force_curve *curve)
{
    const wt_segment *approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    const wt_channel *force = approach != NULL ? wt_segment_channel(approach, WT_Q_FORCE) : NULL;
    double largest = 0;
    for (size_t i = 0; force != NULL && i < approach->n_points; i++)
        largest = fmax(largest, force->values[i]);
    return largest;
}

wt_status align_with_contact(const contact_points *points, const flow_file *file,
                             const wt_force_curve *curve, const wt_job *work, wt_force_curve *to,
                             wt_error *err)
{
    curve_contact contact;
    size_t longest = 1;
    const double direction = height_direction(wt_force_curve_segment(curve, WT_SEGMENT_APPROACH));
    wt_status status = find_contact(points, file, curve->index, &contact, err);
    if (status == WT_OK && (isnan(direction) || isnan(curve->cantilever.spring_constant)))
        status = wt_fail(err, WT_E_MISSING, "no height or no spring constant");
    if (status != WT_OK)
        return status;
    for (size_t i = 0; i < curve->n_segments; i++)
        if (curve->segments[i].n_points > longest)
            longest = curve->segments[i].n_points;
    double *force = wt_alloc(longest, sizeof *force);
    wt_force_curve_reset(to);
    to->index = curve->index;
    to->x = curve->x;
    to->y = curve->y;
    to->grid_x = curve->grid_x;
    to->grid_y = curve->grid_y;
    to->cantilever = curve->cantilever;
    for (size_t i = 0; status == WT_OK && i < curve->n_segments; i++)
        status = add_aligned_segment(&curve->segments[i], &curve->cantilever, direction, &contact,
                                     force, to, err);
    free(force);
    const double ratio = largest_approach_force(to) / contact.max_force;
    if (status == WT_OK && !(ratio > 1 - force_tolerance && ratio < 1 + force_tolerance) &&
        isfinite(ratio))
        wt_log_add(work->log, WT_WARNING, file->name, NULL,
                   "curve %zu: the largest force is %.3g times that of the result: give the "
                   "spring constant and sensitivity that it was made with",
                   curve->index, ratio);
    return status;
}
