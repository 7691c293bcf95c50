/* Thickness of the layer that the curves of bulk and track allow, compared with that of the theory
 * or a stated one. The result includes the modulus against depth of bulk, track and such layers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/math/root.h"
#include "core/math/students_t.h"
#include "core/table/result_value.h"
#include "core/table/table_rows.h"
#include "indentation/indent.h"
#include "indentation/law/tip.h"
#include "study/compare.h"
#include "weartrack/indentation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Thickness from another source; the value is NaN if there is none. */
typedef struct alternative_thickness {
    wt_interval thickness;
    const char *from;  /* description of the source; "" if none */
    const char *lacks; /* missing component of its error, or NULL */
    bool given;        /* true if the user states it, false if it is that of the theory */
} alternative_thickness;

/* The reason why the curves are not used, with a remedy. NULL if they are used. */
typedef struct track_obstacle {
    const char *reason, *settled_by;
} track_obstacle;

typedef struct track_layer_result {
    wt_layer_profile profile;
    wt_layer_agreement agreement;
    alternative_thickness other;
    double ratio, ratio_error; /* ratio of the moduli; error of its logarithm; NaN if unknown */
    const wt_tip *tip;         /* of the track; NULL if unknown */
    track_obstacle obstacle;
} track_layer_result;

/* A length or a range of lengths. */
typedef struct metres_text {
    char text[80];
} metres_text;

static metres_text format_length(double value)
{
    metres_text w;
    wt_format_si(value, "m", 3, w.text, sizeof w.text);
    return w;
}

/* Formats a range of thicknesses. A limit that is not positive or not finite is omitted. */
static metres_text format_thickness_range(double low, double high)
{
    metres_text w;
    const bool from = low > 0 && isfinite(low), to = high > 0 && isfinite(high);
    clocale_print(w.text, sizeof w.text, "%s%s%s%s",
                  from && to ? ""
                  : from     ? "at least "
                  : to       ? "up to "
                             : "any",
                  from ? format_length(low).text : "", from && to ? " to " : "",
                  to ? format_length(high).text : "");
    return w;
}

/* ---- remedies -------------------------------------------------------------------------------- */

typedef struct required_contact {
    const wt_tip *tip;
    double radius;
} required_contact;

static double contact_radius(const wt_tip *tip, double depth)
{
    double g, slope;
    wt_contact_function(tip, depth, &g, &slope);
    return slope / 2;
}

static bool is_too_shallow(double depth, void *user)
{
    const required_contact *w = user;
    return contact_radius(w->tip, depth) < w->radius;
}

/* Depth of this tip for a contact radius. Infinity if 1000 times the depth does not suffice. */
static double depth_at_radius(const wt_tip *tip, double depth, double radius)
{
    enum { HALVES = 50 }; /* to 1e-12 of the depth */
    double low = 0, high = 1000 * depth;
    required_contact w = {tip, radius};
    if (is_too_shallow(high, &w))
        return (double)INFINITY;
    root_bisect(is_too_shallow, &w, &low, &high, 0, HALVES);
    return high;
}

/* Advises another contact radius, as a depth of this tip or as a sphere. The sensitivity to a layer
 * depends on contact radius over thickness. */
static void write_contact_advice(const track_layer_result *f, double radius, char *text,
                                 size_t size)
{
    const wt_layer_profile *p = &f->profile;
    const double depth =
        f->tip != NULL ? depth_at_radius(f->tip, p->depth, radius) : (double)INFINITY;
    char deep[96] = "";
    if (isfinite(depth))
        clocale_print(deep, sizeof deep, "%s deep with this tip, or ", format_length(depth).text);
    clocale_print(text, size,
                  "contacts with a radius of %s (%s%s deep with a sphere of %s) in bulk and track",
                  format_length(radius).text, deep, format_length(p->depth).text,
                  format_length(radius * radius / p->depth).text);
}

static bool is_ratio_inconclusive(const track_layer_result *f)
{
    return !(fabs(log(f->ratio)) > 2 * f->ratio_error);
}

static bool has_no_error(const track_layer_result *f)
{
    return isnan(f->other.thickness.low) || isnan(f->other.thickness.high);
}

/* True if an unknown error may change the verdict. */
static bool may_lack_error(const track_layer_result *f)
{
    return f->other.lacks != NULL && (f->agreement.differ || f->agreement.agree);
}

static void write_remedy(const track_layer_result *f, char *text, size_t size)
{
    const wt_layer_profile *p = &f->profile;
    const bool other = f->other.thickness.value > 0;
    text[0] = '\0';
    const bool told = other && (f->agreement.agree || f->agreement.differ) && !may_lack_error(f);
    if (told)
        return;
    if (f->obstacle.reason != NULL)
        clocale_print(text, size, "%s", f->obstacle.settled_by);
    else if (p->bound_kind == WT_LAYER_BOUND_UNKNOWN)
        clocale_print(
            text, size,
            "12 curves without adhesion in the bulk and in the track, with one tip, cantilever "
            "and depth, better on three spots or more each");
    else if (p->bound_kind == WT_LAYER_BOUND_OUTSIDE_LAW)
        clocale_print(text, size,
                      "a section across the track under a microscope: with such moduli the "
                      "curves do not determine a thickness");
    else if (other && has_no_error(f))
        clocale_print(text, size, "a standard error of the thickness by %s", f->other.from);
    else if (is_ratio_inconclusive(f))
        clocale_print(text, size,
                      "more spots in bulk and track, until the ratio of their moduli differs "
                      "from 1 with certainty");
    else if (p->bound_kind == WT_LAYER_BOUND_EMPTY)
        clocale_print(text, size,
                      "curves at a second rate or with a second tip, in bulk and track: "
                      "effects other than that of the layer change with them");
    else if (other && may_lack_error(f))
        clocale_print(text, size, "a stated error of %s", f->other.lacks);
    else if (p->bound_kind == WT_LAYER_BOUND_LOWER && other)
        write_contact_advice(f, p->contact_radius * f->other.thickness.value / p->thickness.low,
                             text, size);
    else if (p->bound_kind == WT_LAYER_BOUND_LOWER)
        clocale_print(text, size,
                      "deeper indentations in bulk and track, or a wider tip: the bound "
                      "goes with the contact radius");
    else if (p->bound_kind == WT_LAYER_BOUND_UPPER)
        clocale_print(text, size, "shallower indentations in bulk and track, or a sharper tip");
    else
        clocale_print(text, size, "more curves on more spots in bulk and track");
}

/* ---- allowed thickness ----------------------------------------------------------------------- */

static void write_allowed_thickness(const track_layer_result *f, char *text, size_t size)
{
    const wt_layer_profile *p = &f->profile;
    const metres_text low = format_length(p->thickness.low),
                      high = format_length(p->thickness.high),
                      least = format_length(p->smallest_thickness), depth = format_length(p->depth);
    if (f->obstacle.reason != NULL)
        clocale_print(text, size, "inconclusive: %s", f->obstacle.reason);
    else if (p->bound_kind == WT_LAYER_BOUND_OUTSIDE_LAW)
        clocale_print(text, size,
                      "inconclusive: the law of a layer is known for moduli of %g to %g times that "
                      "of the bulk, the modulus of the track is %.3g of it",
                      THIN_LAYER_MIN_RATIO, THIN_LAYER_MAX_RATIO, f->ratio);
    else if (p->bound_kind == WT_LAYER_BOUND_UNKNOWN && p->n[0] >= WT_DEPTH_MIN_CURVES &&
             p->n[1] >= WT_DEPTH_MIN_CURVES)
        clocale_print(text, size,
                      "inconclusive: no change with depth can be fitted to the residuals of "
                      "the curves of bulk and track");
    else if (p->bound_kind == WT_LAYER_BOUND_UNKNOWN)
        clocale_print(text, size,
                      "inconclusive: %zu curves of the bulk and %zu of the track are usable, "
                      "%d of each are needed, without adhesion or loss whose effect is not "
                      "known",
                      p->n[0], p->n[1], WT_DEPTH_MIN_CURVES);
    else if (p->bound_kind == WT_LAYER_BOUND_ANY)
        clocale_print(text, size, "every thickness that was tried, from %s on: %s", least.text,
                      is_ratio_inconclusive(f)
                          ? "the moduli of track and bulk do not differ significantly"
                          : "the curves do not determine how the modulus changes with depth");
    else if (p->bound_kind == WT_LAYER_BOUND_LOWER)
        clocale_print(text, size,
                      "at least %s (95 %%): down to %s the modulus of the track changes no "
                      "more than that of the bulk; over a thinner layer it would",
                      low.text, depth.text);
    else if (p->bound_kind == WT_LAYER_BOUND_UPPER)
        clocale_print(text, size,
                      "less than %s (95 %%): down to %s the modulus of the track changes more "
                      "than with a thicker layer; the law of a layer ends at %s and does not "
                      "determine how thin",
                      high.text, depth.text, least.text);
    else if (p->bound_kind == WT_LAYER_BOUND_EMPTY)
        clocale_print(text, size,
                      "none: no layer on this bulk explains how the modulus of the track "
                      "changes down to %s",
                      depth.text);
    else
        clocale_print(text, size,
                      "%s (95 %% interval %s to %s): down to %s the modulus of the track "
                      "approaches that of the bulk as it would with such a layer",
                      format_length(p->thickness.value).text, low.text, high.text, depth.text);
}

/* ---- agreement with another source ----------------------------------------------------------- */

static void write_agreement(const track_layer_result *f, char *text, size_t size)
{
    const alternative_thickness *o = &f->other;
    const wt_layer_profile *p = &f->profile;
    text[0] = '\0';
    if (o->from[0] == '\0')
        return;
    if (!(o->thickness.value > 0) || !isfinite(o->thickness.value)) {
        clocale_print(text, size, "inconclusive: %s gives no thickness above zero", o->from);
        return;
    }
    const metres_text here = format_length(o->thickness.value),
                      both = format_thickness_range(f->agreement.low, f->agreement.high);
    if (f->obstacle.reason != NULL || p->bound_kind == WT_LAYER_BOUND_UNKNOWN ||
        p->bound_kind == WT_LAYER_BOUND_OUTSIDE_LAW)
        clocale_print(text, size, "inconclusive: the curves do not determine it");
    else if (p->bound_kind == WT_LAYER_BOUND_EMPTY)
        clocale_print(text, size, "inconclusive: something else than a layer changes the curves");
    else if (has_no_error(f))
        clocale_print(text, size, "inconclusive: the error of %s by %s is not known", here.text,
                      o->from);
    else if (may_lack_error(f))
        clocale_print(text, size,
                      "inconclusive: the interval of %s by %s lacks the error of %s, and with it "
                      "the curves might %s it",
                      here.text, o->from, o->lacks, f->agreement.differ ? "allow" : "not allow");
    else if (f->agreement.differ)
        clocale_print(text, size,
                      "no: %s by %s (95 %% interval: %s) is outside of what the "
                      "curves allow",
                      here.text, o->from,
                      format_thickness_range(o->thickness.low, o->thickness.high).text);
    else if (f->agreement.agree)
        clocale_print(text, size, "yes, within a factor of %g: %s by %s; both together allow %s",
                      WT_LAYER_MARGIN, here.text, o->from, both.text);
    else
        clocale_print(
            text, size,
            "inconclusive: the curves allow the %s by %s, and others that differ from it by "
            "more than a factor of %g; both together allow %s",
            here.text, o->from, WT_LAYER_MARGIN, both.text);
}

/* ---- input tables ---------------------------------------------------------------------------- */

/* Curves of a group with depth information, and their common quantities. */
typedef struct depth_group {
    wt_curve_residuals *curve; /* [n] */
    size_t n;
    bool there; /* the table has the columns */
    track_obstacle obstacle;
    wt_tip tip;
    wt_contact_table *contact;
    double poisson_ratio;
    wt_modulus_profile depth;
} depth_group;

static void read_depth_curve(const table_view *t, size_t row, double k, wt_curve_residuals *to)
{
    *to = (wt_curve_residuals){.modulus = indentation_get(t, row, INDENTATION_MODULUS),
                               .depth = indentation_get(t, row, INDENTATION_MAX_INDENTATION),
                               .spring_constant = k,
                               .baseline = indentation_get(t, row, INDENTATION_BASELINE_LENGTH),
                               .window = indentation_get(t, row, INDENTATION_MISFIT_LENGTH),
                               .curvature = indentation_get(t, row, INDENTATION_BASELINE_CURVATURE),
                               .loss_error = indentation_get(t, row, INDENTATION_LOSS_ERROR)};
    for (unsigned i = 0; i < WT_MISFIT_TERMS; i++)
        to->misfit[i] =
            indentation_get(t, row, (indentation_column)(INDENTATION_MISFIT_WAVE_1 + i));
}

/* True if all quantities exist. A table may come from another program; its incomplete curves are
 * skipped. */
static bool is_complete_curve(const wt_curve_residuals *c)
{
    bool whole = c->modulus > 0 && c->depth > 0 && c->baseline > 0 && c->window > 0 &&
                 isfinite(c->curvature) && isfinite(c->modulus) && isfinite(c->depth) &&
                 isfinite(c->baseline) && isfinite(c->window);
    for (size_t i = 0; i < WT_MISFIT_TERMS; i++)
        whole = whole && isfinite(c->misfit[i]);
    return whole;
}

static void read_depth_curves(const table_view *t, double k, depth_group *g)
{
    const char *last = NULL;
    long spots = 0;
    g->curve = wt_alloc(t->n_rows, sizeof *g->curve);
    for (size_t row = 0; row < t->n_rows; row++) {
        wt_curve_residuals *to = &g->curve[g->n];
        const char *spot = indentation_text(t, row, INDENTATION_SPOT);
        read_depth_curve(t, row, k, to);
        if (!is_complete_curve(to))
            continue;
        spots += last == NULL || strcmp(last, spot) != 0;
        last = spot;
        to->spot = spots;
        g->n++;
    }
}

/* Smallest Poisson's ratio. The law of a layer holds for incompressible rubber. At 0.45, a thin
 * sample on a rigid base is 8 % less stiff than at 0.5 (Dimitriadis et al., Biophys. J. 82 (2002)
 * 2798). A layer on rubber has less effect and a smaller error. */
static const double least_poisson_ratio = 0.45;

/* Finds the reason why the curves cannot be used. tip: its description; NULL if it is not
 * understood. */
static track_obstacle find_obstacle(const depth_group *g, bool has_tip, double k)
{
    if (!g->there)
        return (track_obstacle){"the tables of bulk and track say nothing of depth",
                                "the same curves once more through this version of weartrack "
                                "indent, which writes it"};
    if (!(k > 0))
        return (track_obstacle){"curves of one group have several cantilevers, or none is stated",
                                "one cantilever in a group, its spring constant stated"};
    if (!has_tip)
        return (track_obstacle){"curves of one group have several tips, or none is stated",
                                "one tip in bulk and track, its shape stated"};
    if (!(g->poisson_ratio >= least_poisson_ratio && g->poisson_ratio <= 0.5))
        return (track_obstacle){"the law of a layer is that of incompressible rubber, which a "
                                "Poisson's ratio below 0.45, or one that is not stated, is not",
                                "a Poisson's ratio of rubber (0.5) in weartrack indent, if the "
                                "sample is rubber"};
    if (g->tip.sample_thickness.value > 0)
        return (track_obstacle){"the law of a layer on a thin sample is not known",
                                "curves on a thick piece of the sample"};
    return (track_obstacle){NULL, NULL};
}

static wt_status read_depth_group(const wt_table *table, depth_group *g, wt_error *err)
{
    table_view t;
    wt_status status = table_bind(table, &indentation_schema, "", &t, err);
    if (status != WT_OK)
        return status;
    const char *poisson = indentation_key_text(&t, INDENTATION_KEY_POISSON_RATIO);
    const double k = indentation_value(&t, INDENTATION_KEY_SPRING_CONSTANT).value;
    const bool has_tip = indent_tip_from_table(&t, &g->tip);
    g->there = indentation_has(&t, INDENTATION_MISFIT_WAVE_1);
    g->poisson_ratio = parse_number_or_nan(poisson);
    g->obstacle = find_obstacle(g, has_tip, k);
    if (g->obstacle.reason != NULL)
        return WT_OK;
    read_depth_curves(&t, k, g);
    status = indent_contact_table(&g->tip, &g->contact, err);
    return status == WT_OK ? wt_modulus_profile_fit(g->contact, g->poisson_ratio, g->curve, g->n,
                                                    &g->depth, err)
                           : status;
}

/* Finds the thickness from another source: the stated one with a normal 95 % interval, else that of
 * the theory. */
static wt_status find_other_thickness(const wt_compare_job *job, const wt_table *layer,
                                      alternative_thickness *to, wt_error *err)
{
    const double none = (double)NAN;
    result_value_tables tables = {0};
    *to = (alternative_thickness){.thickness = {none, none, none, none}, .from = ""};
    if (job->expected_thickness.value > 0) {
        const wt_estimate *given = &job->expected_thickness;
        const double reach = NORMAL_95 * given->standard_error;
        to->from = "what is given";
        to->given = true;
        to->thickness = (wt_interval){given->value, given->standard_error, given->value - reach,
                                      given->value + reach};
        return WT_OK;
    }
    if (layer == NULL)
        return WT_OK;
    const wt_status status = table_bind(layer, &layer_schema, "", &tables.layer, err);
    if (status != WT_OK)
        return status;
    const result_value f = result_value_thickness(&tables);
    to->from = isnan(layer_value(&tables.layer, LAYER_KEY_OBSERVED_THICKNESS).value)
                   ? "the balance of formation and wear"
                   : "the balance, whose critical energy is from an observed thickness";
    to->thickness = (wt_interval){f.number.value, f.number.standard_error, f.low, f.high};
    to->lacks = f.lacks;
    return WT_OK;
}

/* ---- table ----------------------------------------------------------------------------------- */

TABLE_ROW(track_layer, TRACK_LAYER, const char *curve; double depth; wt_interval modulus;)

TABLE_KEYS(track_layer, TRACK_LAYER, const char *allowed, *agree, *settled_by, *other_from;
           double deepest, contact_radius, thickness, low, high, least, layer_ratio, other,
           other_low, other_high, both_low, both_high, over_low, over_high;)

static double finite_or_none(double value)
{
    return isfinite(value) && value > 0 ? value : (double)NAN;
}

static void set_track_layer_keys(table_writer *t, const track_layer_result *f)
{
    const wt_layer_profile *p = &f->profile;
    char allowed[480], agree[480], settled_by[400];
    write_allowed_thickness(f, allowed, sizeof allowed);
    write_agreement(f, agree, sizeof agree);
    write_remedy(f, settled_by, sizeof settled_by);
    const double thickness = p->thickness.value;
    track_layer_keys keys = {.allowed = allowed,
                             .agree = agree,
                             .settled_by = settled_by,
                             .other_from = f->other.from,
                             .deepest = finite_or_none(p->depth),
                             .contact_radius = finite_or_none(p->contact_radius),
                             .thickness = thickness,
                             .low = finite_or_none(p->thickness.low),
                             .high = finite_or_none(p->thickness.high),
                             .least = p->smallest_thickness,
                             .layer_ratio = (double)NAN,
                             .other = finite_or_none(f->other.thickness.value),
                             .other_low = finite_or_none(f->other.thickness.low),
                             .other_high = finite_or_none(f->other.thickness.high),
                             .both_low = finite_or_none(f->agreement.low),
                             .both_high = finite_or_none(f->agreement.high),
                             .over_low = finite_or_none(f->agreement.ratio_low),
                             .over_high = finite_or_none(f->agreement.ratio_high)};
    if (p->bound_kind == WT_LAYER_BOUND_BOTH) /* at depth 0 it is the modulus of the layer */
        keys.layer_ratio = wt_layer_modulus(p, f->ratio, thickness, 0);
    track_layer_set_keys(t, &keys);
}

/* Adds the modulus against depth of a layer with the measured ratio, down to depths where it
 * approaches the bulk. */
static void add_layer_rows(table_writer *t, const char *name, const track_layer_result *f,
                           double bulk, double thickness)
{
    enum { POINTS = 40 };                                     /* points of a smooth curve */
    const double shallow = 0.2, deep = 5, none = (double)NAN; /* multiples of the depth and of
                                                                 the thickness */
    const wt_layer_profile *p = &f->profile;
    const double from = log(shallow * p->depth), to = log(fmax(deep * thickness, 2 * p->depth));
    if (!(thickness > 0) || !isfinite(thickness) || !(bulk > 0))
        return;
    table_block(t);
    for (size_t i = 0; i < POINTS; i++) {
        const double depth = exp(from + (to - from) * (double)i / (POINTS - 1));
        const double over = wt_layer_modulus(p, f->ratio, thickness, contact_radius(f->tip, depth));
        if (!isnan(over))
            TABLE_ADD(track_layer, t, name, depth, {bulk * over, none, none, none});
    }
}

static wt_status make_track_layer_table(const depth_group group[2], const track_layer_result *f,
                                        wt_table **table, wt_error *err)
{
    table_writer t = table_begin(&track_layer_schema, err);
    set_track_layer_keys(&t, f);
    for (int g = 0; g < 2 && f->obstacle.reason == NULL; g++) {
        const wt_modulus_profile *const d = &group[g].depth;
        table_block(&t);
        for (size_t i = 0; i < WT_DEPTHS && !isnan(d->change.value); i++)
            TABLE_ADD(track_layer, &t, compare_group_name[g], d->depth[i], d->modulus[i]);
    }
    if (f->profile.n_steps > 1) {
        const double bulk = group[1].depth.modulus[WT_DEPTHS - 1].value / f->ratio;
        const wt_layer_bound_kind says = f->profile.bound_kind;
        if (says == WT_LAYER_BOUND_BOTH)
            add_layer_rows(&t, "layer of the curves", f, bulk, f->profile.thickness.value);
        if (says == WT_LAYER_BOUND_LOWER || says == WT_LAYER_BOUND_UPPER)
            add_layer_rows(&t, says == WT_LAYER_BOUND_LOWER ? "thinnest layer" : "thickest layer",
                           f, bulk,
                           says == WT_LAYER_BOUND_LOWER ? f->profile.thickness.low
                                                        : f->profile.thickness.high);
        add_layer_rows(&t, f->other.given ? "layer as given" : "layer of the theory", f, bulk,
                       f->other.thickness.value);
    }
    return table_end(&t, table);
}

/* Computes ln of the ratio with its error by the comparison, and the profile. */
static wt_status find_profile(const depth_group group[2], const wt_compare_job *job,
                              const wt_job *work, track_layer_result *f, wt_error *err)
{
    const wt_contact_table *const contact[2] = {group[0].contact, group[1].contact};
    const wt_curve_residuals *const curve[2] = {group[0].curve, group[1].curve};
    const size_t n[2] = {group[0].n, group[1].n};
    wt_job quiet = *work; /* the comparison itself has issued its warnings */
    quiet.log = NULL;
    wt_estimate log_ratio;
    double df;
    wt_status status = compare_fitted_ratio(job, &quiet, &log_ratio, &df, err);
    if (status != WT_OK)
        return status;
    f->ratio = exp(log_ratio.value);
    f->ratio_error = log_ratio.standard_error;
    if (!(f->ratio > 0) || !(f->ratio_error >= 0)) {
        f->obstacle = (track_obstacle){
            "the ratio of the moduli of track and bulk, or its error, is not known; the "
            "comparison says why",
            "more spots in both groups, as the comparison asks for"};
        return WT_OK;
    }
    if (tips_differ(&group[0].tip, &group[1].tip)) {
        f->obstacle = (track_obstacle){
            "bulk and track were indented with different tips, so that the bulk does not show "
            "how much of the change with depth the tip causes",
            "curves of the bulk and of the track with one tip"};
        return WT_OK;
    }
    f->tip = &group[1].tip;
    status = wt_layer_profile_compute(contact, group[1].poisson_ratio, curve, n, log_ratio, df,
                                      &f->profile, err);
    if (status == WT_OK)
        f->agreement = wt_layer_compare(&f->profile, f->other.thickness);
    return status;
}

wt_status wt_track_layer_compute(const wt_compare_job *job, const wt_table *layer,
                                 const wt_job *work, wt_table **table, wt_error *err)
{
    if (job == NULL || job->bulk == NULL || job->track == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no bulk, no track or no room for what is made of them");
    const double none = (double)NAN;
    const wt_table *const tables[2] = {job->bulk, job->track};
    depth_group group[2] = {{.n = 0}, {.n = 0}};
    track_layer_result f = {.profile.thickness = {none, none, none, none},
                            .profile.smallest_thickness = none,
                            .agreement = {none, none, none, none, false, false},
                            .ratio = none,
                            .ratio_error = none};
    wt_status status = find_other_thickness(job, layer, &f.other, err);
    for (int g = 0; status == WT_OK && g < 2; g++) {
        status = read_depth_group(tables[g], &group[g], err);
        if (f.obstacle.reason == NULL)
            f.obstacle = group[g].obstacle;
    }
    if (status == WT_OK && f.obstacle.reason == NULL)
        status = find_profile(group, job, work, &f, err);
    const bool silent = !group[0].there && !group[1].there && !(job->expected_thickness.value > 0);
    if (status == WT_OK && !silent)
        status = make_track_layer_table(group, &f, table, err);
    for (int g = 0; g < 2; g++) {
        free(group[g].curve);
        wt_contact_table_free(group[g].contact);
    }
    return status;
}
