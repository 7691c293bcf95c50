/* Selection of curves for the table "curves". Their samples are thinned without a visible
 * difference.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/curve_selection.h"

#include "core/base/array.h"
#include "core/data/force_curve.h"
#include "core/table/table_rows.h"
#include "indentation/curve_tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of bins; the table stores the smallest and the largest force of each. The numbers suit a
 * plot of about 600 pixels. The contact is the smaller part of the travel and shows most detail, so
 * it has more bins. */
enum { BINS_BEFORE = 32, BINS_CONTACT = 56, BINS_RETRACT = 24 };

TABLE_ROW(curves, CURVES, const char *group, *file; size_t curve; wt_segment_kind segment;
          double displacement, force, indentation, fitted_force, residual;)

/* ---- selection terms ------------------------------------------------------------------------- */

static const char worst_prefix[] = "worst:";

/* Returns the start of the number in FILE:N, or NULL if the term does not name a curve. */
static const char *curve_number_text(const char *term)
{
    const char *colon = strrchr(term, ':');
    if (colon == NULL || colon == term || colon[1] == '\0' ||
        colon[1 + strspn(colon + 1, "0123456789")] != '\0')
        return NULL;
    return colon + 1;
}

static wt_status read_selection_term(const char *term, curve_selection *selection, wt_error *err)
{
    const char *number = curve_number_text(term);
    const bool is_worst_term = strncmp(term, worst_prefix, strlen(worst_prefix)) == 0;
    const unsigned long n = number != NULL ? strtoul(number, NULL, 10) : 0;
    if (is_worst_term && n > 0) {
        selection->max_worst = n;
        return WT_OK;
    }
    if (!is_worst_term && number != NULL)
        return WT_OK; /* FILE:N */
    if (strcmp(term, "median") == 0)
        selection->median = true;
    else if (strcmp(term, "rejected") == 0)
        selection->rejected = true;
    else if (strcmp(term, "all") == 0)
        selection->all = true;
    else
        return wt_fail(err, WT_E_ARG,
                       "'%s' is not one of median, rejected, worst:N, all and "
                       "FILE:N",
                       term);
    return WT_OK;
}

wt_status curve_selection_begin(const wt_indent_job *job, curve_selection *selection, wt_error *err)
{
    *selection = (curve_selection){.terms = job->curves, .n_terms = job->n_curves};
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < job->n_curves; i++)
        status = read_selection_term(job->curves[i], selection, err);
    selection->median = selection->median || job->median_curve;
    selection->matched = wt_alloc(job->n_curves, sizeof *selection->matched);
    return status;
}

static bool match_named_terms(curve_selection *selection, const flow_file *file, size_t curve)
{
    bool is_match = false;
    for (size_t i = 0; i < selection->n_terms; i++) {
        const char *number = curve_number_text(selection->terms[i]);
        if (number == NULL ||
            strncmp(selection->terms[i], worst_prefix, strlen(worst_prefix)) == 0 ||
            strtoul(number, NULL, 10) != curve ||
            flow_file_match(file, selection->terms[i],
                            (size_t)(number - 1 - selection->terms[i])) == FLOW_NAME_DIFFERENT)
            continue;
        is_match = selection->matched[i] = true;
    }
    return is_match;
}

/* Makes place for a curve of this error in the list of the worst curves: a full list loses the
 * curve with the smallest error. Returns false, and changes nothing, if the error is too small. */
static bool make_place_among_worst(curve_selection *selection, double error)
{
    size_t best = selection->n;
    if (!(error >= 0) || selection->max_worst == 0)
        return false;
    if (selection->n_worst < selection->max_worst)
        return true;
    for (size_t i = 0; i < selection->n; i++)
        if (selection->curve[i].by_error &&
            (best == selection->n || selection->curve[i].error <= selection->curve[best].error))
            best = i;
    if (!(error > selection->curve[best].error))
        return false;
    free(selection->curve[best].sample);
    memmove(&selection->curve[best], &selection->curve[best + 1],
            (selection->n - best - 1) * sizeof *selection->curve);
    selection->n--;
    selection->n_worst--;
    return true;
}

/* ---- samples --------------------------------------------------------------------------------- */

/* Origin of positions and forces: the contact point, or the first sample if there is no contact
 * point. */
typedef struct segment_origin {
    double direction, position, force, tilt, spring_constant;
} segment_origin;

static segment_origin find_segment_origin(const wt_indent_fit *fit, const wt_segment *approach,
                                          double k)
{
    const double *height = segment_height(approach);
    const size_t n = approach->n_points;
    if (isfinite(fit->contact_point.value) && isfinite(fit->direction))
        return (segment_origin){fit->direction, fit->contact_point.value,
                                fit->baseline_offset.value, fit->baseline_tilt.value, k};
    size_t first = 0, last = n;
    while (first < n && !isfinite(height[first]))
        first++;
    while (last > first && !isfinite(height[last - 1]))
        last--;
    if (first >= last)
        return (segment_origin){1, 0, 0, 0, k};
    const double direction = height[last - 1] < height[first] ? -1 : 1;
    return (segment_origin){direction, direction * height[first], 0, 0, k};
}

static selected_sample convert_sample(const segment_origin *from, const wt_segment *segment,
                                      const double *force, size_t i)
{
    const double z = from->direction * segment_height(segment)[i] - from->position;
    const double f = force[i] - from->force - from->tilt * z;
    return (selected_sample){segment->kind, z, f, tip_position(z, f, from->spring_constant),
                             (double)NAN};
}

/* Appends at most 2 samples of each bin, in their order. */
static void thin_samples(const selected_sample *from, size_t n, size_t bins, selected_curve *to)
{
    if (n <= 2 * bins) {
        for (size_t i = 0; i < n; i++)
            to->sample[to->n++] = from[i];
        return;
    }
    for (size_t b = 0; b < bins; b++) {
        const size_t begin = n * b / bins, end = n * (b + 1) / bins;
        size_t low = begin, high = begin;
        for (size_t i = begin + 1; i < end; i++) {
            if (from[i].force < from[low].force)
                low = i;
            if (from[i].force > from[high].force)
                high = i;
        }
        to->sample[to->n++] = from[low < high ? low : high];
        if (low != high)
            to->sample[to->n++] = from[low < high ? high : low];
    }
}

typedef struct selection_scratch {
    selected_sample *sample;                    /* [longest] */
    double *force, *delta, *out, *time, *model; /* [longest], of one allocation */
} selection_scratch;

/* Collects the finite samples of a segment and returns their number. */
static size_t collect_samples(const segment_origin *from, const wt_segment *segment,
                              const double *force, selected_sample *to)
{
    const double *height = segment_height(segment);
    size_t n = 0;
    for (size_t i = 0; i < segment->n_points; i++)
        if (isfinite(height[i]) && isfinite(force[i]))
            to[n++] = convert_sample(from, segment, force, i);
    return n;
}

/* Sets the fitted forces: 0 on the baseline, the contact law in contact. `first` receives the first
 * sample in contact. */
static void add_fitted_forces(const wt_indent_fit *fit, const wt_indent_options *options,
                              const wt_contact_table *contact, const wt_segment *approach,
                              const double *force, const segment_origin *from, selection_scratch *s,
                              size_t n, size_t *first)
{
    *first = n;
    if (!isfinite(fit->modulus.value) || !isfinite(fit->contact_point.value))
        return;
    const size_t m = wt_indent_plot_points(fit, segment_height(approach), force, approach->n_points,
                                           from->spring_constant, s->delta, s->out);
    fitted_forces(fit, options, contact, approach, s->delta, m, s->time, s->model);
    size_t j = 0;
    for (size_t i = 0; i < n; i++) {
        const bool touches = s->sample[i].displacement >= 0;
        if (touches && *first == n)
            *first = i;
        s->sample[i].fitted_force = !touches ? 0 : j < m ? s->model[j++] : (double)NAN;
    }
}

static void add_curve_samples(selected_curve *to, const wt_force_curve *curve,
                              const wt_indent_fit *fit, const wt_contact_table *contact,
                              const wt_indent_options *options, selection_scratch *s)
{
    const wt_segment *approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    const wt_segment *retract = wt_force_curve_segment(curve, WT_SEGMENT_RETRACT);
    const double *force = segment_force(approach, &curve->cantilever, s->force);
    if (force == NULL)
        return;
    const segment_origin from =
        find_segment_origin(fit, approach, curve->cantilever.spring_constant);
    size_t first = 0, n = collect_samples(&from, approach, force, s->sample);
    add_fitted_forces(fit, options, contact, approach, force, &from, s, n, &first);
    if (first == n) /* without contact, all samples have equal density */
        first = n * BINS_BEFORE / (BINS_BEFORE + BINS_CONTACT);
    thin_samples(s->sample, first, BINS_BEFORE, to);
    thin_samples(s->sample + first, n - first, BINS_CONTACT, to);
    force = retract == NULL || segment_height(retract) == NULL
                ? NULL
                : segment_force(retract, &curve->cantilever, s->force);
    if (force == NULL)
        return;
    n = collect_samples(&from, retract, force, s->sample);
    for (first = 0; first < n && s->sample[first].displacement >= 0;)
        first++;
    if (first == n)
        first = n / 2;
    thin_samples(s->sample, first, BINS_RETRACT, to);
    thin_samples(s->sample + first, n - first, BINS_RETRACT, to);
}

static void store_samples(selected_curve *to, const wt_force_curve *curve, const wt_indent_fit *fit,
                          const wt_contact_table *contact, const wt_indent_options *options)
{
    const size_t arrays = 5, most = 2 * (BINS_BEFORE + BINS_CONTACT + 2 * BINS_RETRACT);
    const wt_segment *approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    const wt_segment *retract = wt_force_curve_segment(curve, WT_SEGMENT_RETRACT);
    if (approach == NULL || approach->n_points == 0 || segment_height(approach) == NULL)
        return; /* the verdict states the reason */
    const size_t longest = retract != NULL && retract->n_points > approach->n_points
                               ? retract->n_points
                               : approach->n_points;
    double *numbers = wt_alloc(arrays * longest, sizeof *numbers);
    selection_scratch s = {.sample = wt_alloc(longest, sizeof *s.sample),
                           .force = numbers,
                           .delta = numbers + longest,
                           .out = numbers + 2 * longest,
                           .time = numbers + 3 * longest,
                           .model = numbers + 4 * longest};
    to->sample = wt_alloc(most, sizeof *to->sample);
    add_curve_samples(to, curve, fit, contact, options, &s);
    free(numbers);
    free(s.sample);
}

void curve_selection_add(curve_selection *selection, const flow_file *file,
                         const wt_force_curve *curve, const wt_indent_fit *fit,
                         const wt_contact_table *contact, const wt_indent_options *options)
{
    if (selection->n_terms == 0)
        return;
    const bool usable = wt_curve_verdict_is_usable(fit->verdict);
    const bool is_match = match_named_terms(selection, file, curve->index);
    selected_curve candidate = {.file = file->name, .curve = curve->index};
    if (usable)
        candidate.error = fit->modulus.standard_error / fit->modulus.value;
    if (!is_match && !selection->all && !(selection->rejected && !usable)) {
        if (!usable || !make_place_among_worst(selection, candidate.error))
            return;
        candidate.by_error = true;
    }
    selection->curve = array_grow(selection->curve, selection->n, sizeof *selection->curve);
    store_samples(&candidate, curve, fit, contact, options);
    selection->n_worst += candidate.by_error;
    selection->curve[selection->n++] = candidate;
}

/* ---- the table ------------------------------------------------------------------------------- */

wt_status curve_selection_table(const curve_selection *selection, const char *group,
                                wt_table **table, wt_error *err)
{
    for (size_t i = 0; i < selection->n_terms; i++) {
        if (selection->matched[i] || curve_number_text(selection->terms[i]) == NULL ||
            strncmp(selection->terms[i], worst_prefix, strlen(worst_prefix)) == 0)
            continue;
        const wt_status status =
            wt_fail(err, WT_E_NOT_FOUND, "no curve of the group \"%s\" is '%s'", group,
                    selection->terms[i]);
        wt_error_advice(err, "the columns file and curve of the table indentation/%s name them all",
                        group);
        return status;
    }
    if (selection->n == 0)
        return WT_OK;
    table_writer t = {0};
    if (*table == NULL) {
        t = table_begin(&curves_schema, err);
        if (table_end(&t, table) != WT_OK)
            return t.status;
    }
    t = table_continue(*table, &curves_schema, group, err);
    for (size_t i = 0; i < selection->n; i++) {
        const selected_curve *c = &selection->curve[i];
        table_block(&t);
        for (size_t j = 0; j < c->n; j++) {
            const selected_sample *s = &c->sample[j];
            TABLE_ADD(curves, &t, group, c->file, c->curve, s->segment, s->displacement, s->force,
                      s->indentation, s->fitted_force, s->force - s->fitted_force);
        }
    }
    return table_end(&t, NULL);
}

void curve_selection_clear(curve_selection *selection)
{
    for (size_t i = 0; i < selection->n; i++)
        free(selection->curve[i].sample);
    free(selection->curve);
    free(selection->matched);
    *selection = (curve_selection){0};
}
