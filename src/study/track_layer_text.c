/* Text on the thickness that the curves allow, its agreement with another source, and how to
 * decide.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/track_layer.h"

#include "core/base/clocale.h"
#include "core/math/root.h"
#include "indentation/law/thin_layer.h"

#include <math.h>
#include <string.h>

typedef struct metres_text {
    char text[32];
} metres_text;

static metres_text format_length(double value)
{
    metres_text w;
    wt_format_si(value, "m", 3, w.text, sizeof w.text);
    return w;
}

typedef struct thickness_range_text {
    char text[80];
} thickness_range_text;

/* Formats a range of thicknesses. A limit that is not positive or not finite is omitted. */
static thickness_range_text format_thickness_range(double low, double high)
{
    thickness_range_text w;
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

static bool is_too_shallow(double depth, void *user)
{
    const required_contact *w = user;
    double g, slope;
    wt_contact_function(w->tip, depth, &g, &slope);
    return slope < 2 * w->radius;
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
        clocale_print(deep, sizeof deep, "indentations of %s with this tip, or ",
                      format_length(depth).text);
    clocale_print(text, size,
                  "contacts with a radius of %s, which are %s%s with a sphere of %s, in bulk and "
                  "track: as many curves would then tell a layer of that thickness",
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
            "12 curves without adhesion in the bulk and in the track, with one tip, lever "
            "and depth, better on three spots or more each");
    else if (p->bound_kind == WT_LAYER_BOUND_OUTSIDE_LAW)
        clocale_print(text, size,
                      "a section across the track under a microscope: of such moduli the curves "
                      "do not tell a thickness");
    else if (other && has_no_error(f))
        clocale_print(text, size, "a standard error of the thickness by %s", f->other.from);
    else if (is_ratio_inconclusive(f))
        clocale_print(text, size,
                      "more spots in bulk and track, until the ratio of their moduli is "
                      "told from 1");
    else if (p->bound_kind == WT_LAYER_BOUND_EMPTY)
        clocale_print(text, size,
                      "curves at a second rate or with a second tip, in bulk and track: "
                      "what is not of the layer changes with them");
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
        clocale_print(text, size, "cannot say: %s", f->obstacle.reason);
    else if (p->bound_kind == WT_LAYER_BOUND_OUTSIDE_LAW)
        clocale_print(text, size,
                      "cannot say: the law of a layer is known for moduli of %g to %g times that "
                      "of the bulk, the modulus of the track is %.3g of it",
                      THIN_LAYER_MIN_RATIO, THIN_LAYER_MAX_RATIO, f->ratio);
    else if (p->bound_kind == WT_LAYER_BOUND_UNKNOWN && p->n[0] >= WT_DEPTH_MIN_CURVES &&
             p->n[1] >= WT_DEPTH_MIN_CURVES)
        clocale_print(text, size,
                      "cannot say: no change with depth can be fitted to what the contact law "
                      "leaves of the curves of bulk and track");
    else if (p->bound_kind == WT_LAYER_BOUND_UNKNOWN)
        clocale_print(text, size,
                      "cannot say: %zu curves of the bulk and %zu of the track tell of depth, %d "
                      "of each are needed, without adhesion or loss whose effect is not known",
                      p->n[0], p->n[1], WT_DEPTH_MIN_CURVES);
    else if (p->bound_kind == WT_LAYER_BOUND_ANY)
        clocale_print(text, size, "every thickness that was tried, from %s on: %s", least.text,
                      is_ratio_inconclusive(f)
                          ? "the moduli of track and bulk are not told apart"
                          : "the curves do not tell how the modulus changes with depth");
    else if (p->bound_kind == WT_LAYER_BOUND_LOWER)
        clocale_print(text, size,
                      "at least %s (95 %%): down to %s the modulus of the track changes no more "
                      "than that of the bulk, as it would if the bulk were nearer",
                      low.text, depth.text);
    else if (p->bound_kind == WT_LAYER_BOUND_UPPER)
        clocale_print(text, size,
                      "less than %s (95 %%): down to %s the modulus of the track changes more than "
                      "with a thicker layer; how thin the law of a layer, which ends at %s, does "
                      "not tell",
                      high.text, depth.text, least.text);
    else if (p->bound_kind == WT_LAYER_BOUND_EMPTY)
        clocale_print(text, size,
                      "none: down to %s the modulus of the track changes as no layer on this bulk "
                      "would make it",
                      depth.text);
    else
        clocale_print(text, size,
                      "%s (95 %% interval %s to %s): down to %s the modulus of the track goes "
                      "to that of the bulk as it would with such a layer",
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
        clocale_print(text, size, "cannot say: %s gives no thickness above zero", o->from);
        return;
    }
    const metres_text here = format_length(o->thickness.value);
    const thickness_range_text both = format_thickness_range(f->agreement.low, f->agreement.high);
    if (f->obstacle.reason != NULL || p->bound_kind == WT_LAYER_BOUND_UNKNOWN ||
        p->bound_kind == WT_LAYER_BOUND_OUTSIDE_LAW)
        clocale_print(text, size, "cannot say: the curves do not tell");
    else if (p->bound_kind == WT_LAYER_BOUND_EMPTY)
        clocale_print(text, size, "cannot say: something else than a layer changes the curves");
    else if (has_no_error(f))
        clocale_print(text, size, "cannot say: the error of %s by %s is not known", here.text,
                      o->from);
    else if (may_lack_error(f))
        clocale_print(text, size,
                      "cannot say: the interval of %s by %s lacks the error of %s, and with it "
                      "the curves might %s it",
                      here.text, o->from, o->lacks, f->agreement.differ ? "allow" : "not allow");
    else if (f->agreement.differ)
        clocale_print(text, size, "no: %s by %s (95 %% interval: %s) is not what the curves allow",
                      here.text, o->from,
                      format_thickness_range(o->thickness.low, o->thickness.high).text);
    else if (f->agreement.agree)
        clocale_print(text, size, "yes, within a factor of %g: %s by %s; both together allow %s",
                      WT_LAYER_MARGIN, here.text, o->from, both.text);
    else
        clocale_print(
            text, size,
            "cannot say: the curves allow the %s by %s, and others that differ from it by "
            "more than a factor of %g; both together allow %s",
            here.text, o->from, WT_LAYER_MARGIN, both.text);
}

void track_layer_write_sentences(const track_layer_result *found, track_layer_sentences *words)
{
    write_allowed_thickness(found, words->allowed, sizeof words->allowed);
    write_agreement(found, words->agree, sizeof words->agree);
    write_remedy(found, words->settled_by, sizeof words->settled_by);
}
