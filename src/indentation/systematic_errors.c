/* Text on systematic errors that leave no residual and that no interval holds: a base below the
 * sample and a piezo that bends. The text states the effect and how to detect it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/clocale.h"
#include "core/math/root.h"
#include "indentation/indent.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <string.h>

/* Smallest relative effect of a base that is reported; most stated errors exceed a smaller one. */
static const double min_base_effect = 0.05;
/* Range of the thickness over the depth. A sample of a thousand depths is thick for any tip. */
static const double min_thickness_ratio = 0.1, max_thickness_ratio = 1e3;

typedef struct base_search {
    wt_tip tip;
    double depth;
} base_search;

/* Returns a value that rises with the logarithm of the thickness and is 0 at the limit. */
static double base_effect_margin(double log_thickness, void *user)
{
    base_search *s = user;
    const contact_point_values thick = contact_values(&s->tip, s->depth);
    wt_tip thin = s->tip;
    thin.sample_thickness = exp(log_thickness);
    return min_base_effect - (thin_sample_values(&thin, thick).g / thick.g - 1);
}

/* Thickness at which a rigid base increases the modulus by min_base_effect; NaN if not known. */
static double required_thickness(const wt_tip *tip, double depth)
{
    base_search search = {*tip, depth};
    double found = (double)NAN;
    const double low = log(min_thickness_ratio * depth), high = log(max_thickness_ratio * depth);
    search.tip.sample_thickness = 0;
    if (!(depth > 0) || !(base_effect_margin(low, &search) < 0) ||
        !(base_effect_margin(high, &search) > 0) ||
        root_find(base_effect_margin, &search, low, high, 1e-3, &found, NULL) != WT_OK)
        return (double)NAN;
    return exp(found);
}

void indent_systematic_errors(const wt_indent_job *job, double depth, char *text, size_t size)
{
    const wt_tip *tip = &job->tip;
    *text = '\0';
    if (!(depth > 0))
        return;
    const double thin = tip->sample_thickness > 0 ? (double)NAN : required_thickness(tip, depth);
    if (thin > 0) {
        char thickness_text[32];
        wt_format_si(thin, "m", 2, thickness_text, sizeof thickness_text);
        clocale_append(
            text, size,
            "a sample on something hard (thinner than %s: a modulus more than %g %% too large; "
            "--sample-thickness), ",
            thickness_text, 100 * min_base_effect);
    }
    clocale_append(text, size,
                   "a piezo that bends in contact only (calibrate it, or press on something hard)");
}
