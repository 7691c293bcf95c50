/* Text on systematic errors that leave no residual: sizes of the tip, cantilever and piezo as
 * stated, and a base below the sample. The text states the effect and how to detect it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/clocale.h"
#include "core/math/root.h"
#include "indentation/indent.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <string.h>

/* Smallest relative effect of a base that is reported; most stated errors exceed a smaller one. */
static const double base_share = 0.05;
static const double one_degree = M_PI / 180;
static const double tenth = 0.1; /* relative step of a radius */
/* Range of the thickness over the depth. A sample of a thousand depths is thick for any tip. */
static const double thinnest = 0.1, thickest = 1e3;

typedef struct base_search {
    wt_tip tip;
    double depth;
} base_search;

/* Returns a value that rises with the logarithm of the thickness and is 0 at the limit. */
static double base_is_weak(double log_thickness, void *user)
{
    base_search *s = user;
    const contact_point_values thick = contact_values(&s->tip, s->depth);
    wt_tip thin = s->tip;
    thin.sample_thickness = exp(log_thickness);
    return base_share - (thin_sample_values(&thin, thick).g / thick.g - 1);
}

/* Thickness at which a rigid base increases the modulus by base_share; NaN if not known. */
static double thickness_needed(const wt_tip *tip, double depth)
{
    base_search search = {*tip, depth};
    double found = (double)NAN;
    const double low = log(thinnest * depth), high = log(thickest * depth);
    search.tip.sample_thickness = 0;
    if (!(depth > 0) || !(base_is_weak(low, &search) < 0) || !(base_is_weak(high, &search) > 0) ||
        root_find(base_is_weak, &search, low, high, 1e-3, &found, NULL) != WT_OK)
        return (double)NAN;
    return exp(found);
}

/* Appends the effect of a half-angle that is larger by one degree. */
static void say_half_angle(const wt_tip *tip, double depth, char *text, size_t size)
{
    wt_tip wider = *tip;
    wider.half_angle += one_degree;
    if (!(tip->half_angle > 0) || tip->half_angle_error > 0 || wider.half_angle >= M_PI_2)
        return;
    const double g = contact_values(tip, depth).g, of_wider = contact_values(&wider, depth).g;
    clocale_append(
        text, size,
        "half-angle of the tip (a degree wider: a modulus about %.2g %% smaller; state its "
        "error), ",
        100 * (1 - g / of_wider));
}

/* Appends the effect of a larger radius if the tip is a cap alone. There the radius is nearly a
 * factor of the force. */
static void say_radius(const wt_tip *tip, double depth, char *text, size_t size)
{
    wt_tip larger = *tip;
    larger.radius *= 1.0 + tenth;
    if (!(tip->radius > 0) || tip->half_angle > 0 || tip->radius_error > 0)
        return;
    const double g = contact_values(tip, depth).g, of_larger = contact_values(&larger, depth).g;
    clocale_append(text, size,
                   "radius of the tip (%g %% larger: a modulus about %.2g %% smaller; state its "
                   "error), ",
                   100 * tenth, 100 * (1 - g / of_larger));
}

void indent_systematic_errors(const wt_indent_job *job, double depth, char *text, size_t size)
{
    const wt_tip *tip = &job->tip;
    *text = '\0';
    if (!(depth > 0))
        return;
    say_half_angle(tip, depth, text, size);
    say_radius(tip, depth, text, size);
    const double thin = tip->sample_thickness > 0 ? (double)NAN : thickness_needed(tip, depth);
    if (thin > 0) {
        char words[32];
        wt_format_si(thin, "m", 2, words, sizeof words);
        clocale_append(
            text, size,
            "a sample on something hard (thinner than %s: a modulus more than %g %% too large; "
            "--sample-thickness), ",
            words, 100 * base_share);
    }
    clocale_append(text, size,
                   "a piezo that bends in contact only (calibrate it, or press on something hard)");
}
