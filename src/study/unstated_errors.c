/* What else than the rubber would make the ratio what it is: a worn tip, a pull, another
 * temperature, which nobody stated or in which the groups differ. Where one of them is plausible,
 * the ratio does not tell that the rubber differs, nor that it does not. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "study/compare.h"

#include "core/base/clocale.h"
#include "core/math/root.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Customary, of evidence that one group is pulled, or has a misfit, against what was stated. */
static const double level = 0.05;
/* Of a misfit that few curves do not show well: one that is not there costs a "cannot say", one
 * that is not seen a wrong yes, so that the customary error of the second kind is that of the
 * first. */
static const double few_level = 0.2;
/* A heuristic: probes of 10 to 20 nm are found with 50 to 100 nm after scans over hard fillers, and
 * with more than that images show the tip instead of the sample. */
static const double worn_radius = 100e-9;
/* A heuristic: rooms in which people measure lie between 15 and 35 degC, and a scanner warms the
 * sample by some kelvin of that. */
static const double room_span = 20;
/* -d ln aT/dT [1/K] by Williams, Landel and Ferry (J. Am. Chem. Soc. 77 (1955) 3701: 17.44, 51.6 K)
 * 70 K above the glass transition, where rubbers with theirs at -45 degC are at room temperature;
 * it is 0.22 at 45 K and 0.07 at 120 K. */
static const double shift_slope = 0.14;
/* d ln E/d ln rate where the curves do not tell it: of a loss factor of 0.1, that of many compounds
 * at room temperature, 2/pi times. */
static const double usual_rate_slope = 0.06;
/* Of a stated standard error, both ways. */
static const double two_errors = 2;

static double mean_of(const double *values, size_t n)
{
    double sum = 0, known = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(values[i])) {
            sum += values[i];
            known++;
        }
    return known > 0 ? sum / known : (double)NAN;
}

/* The mean curve of a group at its largest force; the lever is stiff where nothing says how stiff.
 */
typedef struct pressed {
    double depth, force, bending;
} pressed;

static pressed pressed_of(const wt_group_data *d)
{
    pressed p = {mean_of(d->max_indentation, d->group.n), mean_of(d->max_force, d->group.n), 0};
    if (d->spring_constant.value > 0 && p.force > 0)
        p.bending = p.force / d->spring_constant.value;
    return p;
}

/* ---- causes ---------------------------------------------------------------------------------- */

static void add_words(char *to, size_t size, const char *words)
{
    const size_t used = strlen(to);
    snprintf(to + used, size - used, "%s%s", used > 0 ? "; " : "", words);
}

/* What a cause may make of ln(ratio) at most: that of the rubber may be as much lower or higher. */
typedef struct cause_effect {
    double lower, higher;
} cause_effect;

/* Of a cause that makes the modulus of a group larger. */
static cause_effect effect_in(int group, double effect)
{
    return group == 1 ? (cause_effect){effect, 0} : (cause_effect){0, effect};
}

/* A cause that would do it, in words; `plausible` ones are those that keep the answer back. */
static void add_cause(unstated_errors *u, bool plausible, cause_effect effect, const char *words,
                      const char *settled_by)
{
    add_words(u->would_explain, sizeof u->would_explain, words);
    if (!plausible)
        return;
    u->lower += effect.lower;
    u->higher += effect.higher;
    add_words(u->plausible, sizeof u->plausible, words);
    add_words(u->settled_by, sizeof u->settled_by, settled_by);
}

static double contact_force(const wt_tip *tip, double depth)
{
    double g, slope;
    wt_contact_function(tip, depth, &g, &slope);
    return g;
}

/* The radius that makes the modulus larger by exp(effect), and what it leaves of the curves;
 * infinity where none up to ten times the largest worn one does. */
static wt_status radius_for(const wt_tip *tip, const pressed *at, double effect, double *radius,
                            double *misfit, wt_error *err)
{
    double low = tip->radius, high = 10 * worn_radius;
    wt_tip_wear fit = {0};
    wt_status status = wt_tip_wear_fit(tip, high, at->depth, at->bending, &fit, err);
    *radius = (double)INFINITY;
    *misfit = fit.misfit;
    if (status != WT_OK || !(fit.log_modulus > effect))
        return status;
    for (int i = 0; status == WT_OK && i < 30; i++) { /* to 1e-9 of the bracket */
        *radius = 0.5 * (low + high);
        status = wt_tip_wear_fit(tip, *radius, at->depth, at->bending, &fit, err);
        *(fit.log_modulus > effect ? &high : &low) = *radius;
    }
    *misfit = fit.misfit;
    return status;
}

/* A tip wears, and nothing but the misfit of the curves shows it: that of each beside the other
 * group's, and that of all together. */
static wt_status misfit_chances(const compare_pair *p, double chance[2], wt_error *err)
{
    const wt_group_data *bulk = &p->data[0], *track = &p->data[1];
    const double *const values[2] = {bulk->lack_of_fit, track->lack_of_fit};
    const long *const spots[2] = {bulk->fitted_spot, track->fitted_spot};
    const size_t n[2] = {bulk->n_fitted, track->n_fitted};
    wt_sign_comparison lack;
    const wt_status status = wt_compare_signs(values, spots, n, &lack, err);
    for (int g = 0; status == WT_OK && g < 2; g++)
        chance[g] = wt_combined_p_value(lack.larger_chance[g], p->data[g].pooled_misfit_p);
    return status;
}

/* The largest radius that a tip may have. */
static double largest_radius(const wt_group_data *d, const wt_compare_job *job, const wt_tip *tip)
{
    const double stated = d->common_error[WT_COMMON_RADIUS];
    if (stated > 0)
        return tip->radius * (1 + two_errors * stated);
    return job->tip_error > 0 ? tip->radius : worn_radius;
}

/* Whether the curves leave as much as a worn tip would: nearer to that than to nothing. Of few
 * curves only the chance is known. A tip that is stated is as stated unless the curves say
 * otherwise. */
static bool shows_wear(const wt_group_data *d, const wt_compare_job *job, double misfit,
                       double chance)
{
    const bool stated = d->common_error[WT_COMMON_RADIUS] > 0 || job->tip_error > 0;
    if (stated)
        return chance < level;
    return isnan(d->pooled_misfit) ? chance < few_level : d->pooled_misfit > misfit / 2;
}

/* It is blunter in the group that seems stiffer; where none does, in the one with the misfit. */
static wt_status add_tip(const compare_pair *p, const wt_compare_job *job, bool within,
                         unstated_errors *u, wt_error *err)
{
    wt_tip tip;
    double chance[2], needed, least, misfit, ignored;
    wt_status status = misfit_chances(p, chance, err);
    if (status != WT_OK)
        return status;
    const int worn = within ? chance[1] < chance[0] : u->log_ratio > 0;
    const wt_group_data *d = &p->data[worn];
    const pressed at = pressed_of(d);
    if (d->tip == NULL || !(at.depth > 0) || !tip_from_description(d->tip, &tip) ||
        !(tip.radius < worn_radius))
        return WT_OK;
    status = radius_for(&tip, &at, within ? u->least : fabs(u->log_ratio), &needed, &misfit, err);
    if (status == WT_OK)
        status = radius_for(&tip, &at, u->least, &least, &ignored, err);
    if (status != WT_OK || isinf(needed))
        return status;
    const double largest = largest_radius(d, job, &tip);
    const bool plausible = least <= largest && shows_wear(d, job, misfit, chance[worn]);
    wt_tip_wear most = {0};
    if (plausible)
        status = wt_tip_wear_fit(&tip, largest, at.depth, at.bending, &most, err);
    char words[240], here[32], there[32];
    wt_format_si(tip.radius, "m", 2, here, sizeof here);
    wt_format_si(needed, "m", 2, there, sizeof there);
    clocale_print(
        words, sizeof words,
        "a tip radius of %s instead of %s in the %s%s, whose curves %s off the law as that would "
        "leave them",
        there, here, compare_group_name[worn], within ? ", which would hide the margin" : "",
        plausible ? "may be as far" : "are not as far");
    add_cause(u, plausible, effect_in(worn, most.log_modulus), words,
              "the radius of the tip before and after, with its error (radius=20nm+-10%), or "
              "curves on the bulk again after the track");
    return status;
}

/* More than the 53 binary digits of a double. */
enum { BISECTIONS = 60 };

typedef struct pulled_depth {
    const wt_tip *tip;
    double depth, share;
} pulled_depth;

/* Whether the force at a share of the whole depth is not above that of the pull. */
static bool is_within_pull(double x, void *user)
{
    const pulled_depth *p = user;
    const double all = p->depth / (1 - x);
    return !(contact_force(p->tip, x * all) > p->share * contact_force(p->tip, all));
}

/* What a pull that acts throughout the contact makes of the modulus at most: the contact begins
 * where the force has made up for it, and what is left is fitted as all. Without a tip that is
 * known forces go with the square of the depth. */
static double pull_effect(const wt_tip *tip, double depth, double force, double pull)
{
    const double share = pull / (force + pull);
    double low = 0, high = 1;
    if (tip == NULL)
        return log1p(sqrt(share)) - log1p(-sqrt(share));
    /* of the depth whose force is that of the pull, and the curve's own beyond it */
    pulled_depth of = {tip, depth, share};
    root_halve(is_within_pull, &of, &low, &high, 0, BISECTIONS);
    const double all = depth / (1 - low);
    return log((contact_force(tip, all) - contact_force(tip, low * all)) /
               contact_force(tip, depth));
}

typedef struct required_adhesion {
    const wt_tip *tip;
    double depth, force, effect;
} required_adhesion;

static bool is_too_little(double pull, void *user)
{
    const required_adhesion *p = user;
    return !(pull_effect(p->tip, p->depth, p->force, pull) > p->effect);
}

static double pull_for(const wt_tip *tip, double depth, double force, double effect)
{
    double low = 0, high = force;
    if (!(pull_effect(tip, depth, force, high) > effect))
        return (double)INFINITY;
    required_adhesion of = {tip, depth, force, effect};
    root_halve(is_too_little, &of, &low, &high, 0, BISECTIONS);
    return high;
}

/* Where the curves of one group are pulled more than those of the other. */
static wt_status add_pull(const compare_pair *p, bool within, unstated_errors *u, wt_error *err)
{
    const double *const values[2] = {p->data[0].pull, p->data[1].pull};
    const long *const spots[2] = {p->data[0].group.spot, p->data[1].group.spot};
    const size_t n[2] = {p->data[0].group.n, p->data[1].group.n};
    wt_sign_comparison pulls;
    wt_tip tip;
    const wt_status status = wt_compare_signs(values, spots, n, &pulls, err);
    if (status != WT_OK)
        return status;
    const int more = pulls.mean[1] > pulls.mean[0];
    const wt_group_data *d = &p->data[more];
    const pressed at = pressed_of(d);
    const double there = pulls.mean[more] - pulls.mean[!more];
    if (!(pulls.larger_chance[more] < level) || !(at.depth > 0) || !(at.force > 0))
        return WT_OK;
    const wt_tip *const known = d->tip != NULL && tip_from_description(d->tip, &tip) ? &tip : NULL;
    const double needed =
                     pull_for(known, at.depth, at.force, within ? u->least : fabs(u->log_ratio)),
                 least = pull_for(known, at.depth, at.force, u->least);
    char words[200], is[32], would[32];
    if (isinf(needed))
        return WT_OK;
    wt_format_si(there, "N", 2, is, sizeof is);
    wt_format_si(needed, "N", 2, would, sizeof would);
    clocale_print(words, sizeof words,
                  "a pull of %s more in the %s that the contact law does not have%s (%s more were "
                  "measured)",
                  would, compare_group_name[more], within ? ", which would hide the margin" : "",
                  is);
    add_cause(u, least <= there, effect_in(more, pull_effect(known, at.depth, at.force, there)),
              words, "curves without the pull, under liquid or after drying");
    return WT_OK;
}

/* Of ln E against temperature where no DMA says it: at a loading time the modulus of a rubber is
 * that of times longer or shorter by its shift factor, so that the slope is that against ln rate
 * times that of ln aT; or, where there is next to none, that of the rubber's elasticity, 1/T. */
static double slope_of_rubbers(const compare_row *row)
{
    const wt_estimate *rate = &row->c.rate_slope;
    const bool known = rate->standard_error < usual_rate_slope;
    const double fall = shift_slope * (known ? fmax(rate->value, 0) : usual_rate_slope),
                 rise = 1 / (WT_ZERO_CELSIUS + 25);
    return fall > rise ? -fall : rise;
}

/* Where no temperature is stated. */
static wt_status add_temperature(const compare_pair *p, const wt_compare_job *job,
                                 const wt_job *work, const compare_row *row, bool within,
                                 unstated_errors *u, wt_error *err)
{
    const bool stated = !isnan(job->temperature.value) || !isnan(job->track_temperature.value) ||
                        !isnan(job->temperature_slope.value);
    const bool by_dma = job->rubber != NULL;
    double slope = slope_of_rubbers(row);
    if (stated || (!by_dma && p->by_factor)) /* no temperature is left in factors */
        return WT_OK;
    wt_status status = WT_OK;
    if (by_dma)
        status = compare_temperature_slope(p, job, work, &slope, err);
    if (status != WT_OK || !(fabs(slope) > 0))
        return status;
    const double needed = (within ? u->least : u->log_ratio) / slope,
                 effect = room_span * fabs(slope);
    char words[200], by[80] = "by the DMA";
    if (!by_dma)
        clocale_print(by, sizeof by, "if the modulus %s by %.2g %% a kelvin",
                      slope < 0 ? "falls" : "rises", 100 * fabs(slope));
    clocale_print(words, sizeof words,
                  "a track %.2g K %s than the bulk, %s%s (no "
                  "temperature is stated)",
                  fabs(needed), needed > 0 ? "warmer" : "colder", by,
                  within ? ", which would hide the margin" : "");
    /* What would hide a difference as large as the margin must be as large, and of the other sign:
     * to expect that takes a slope that is known. */
    const bool plausible = (by_dma || !within) && u->least <= effect;
    add_cause(u, plausible, (cause_effect){effect, effect}, words,
              by_dma ? "the temperature of the curves (indentation-temperature, track-temperature)"
                     : "the temperature of the curves, one for both if it was "
                       "(indentation-temperature, track-temperature)");
    return WT_OK;
}

wt_status compare_find_unsaid(const compare_pair *p, const wt_compare_job *job, const wt_job *work,
                              const compare_row *row, unstated_errors *u, wt_error *err)
{
    const wt_comparison *c = &row->c;
    *u = (unstated_errors){.log_ratio = c->log_ratio.value};
    if (!row->valid || isnan(u->log_ratio))
        return WT_OK;
    const double low = log(c->ratio_low), high = log(c->ratio_high);
    const bool within = !(low > 0) && !(high < 0);
    /* What takes the yes away: what brings the end of the interval that is next to 1 there. What
     * takes the no away: what hides a difference as large as the margin. */
    u->least = low > 0 ? low : high < 0 ? -high : log1p(job->margin);
    wt_status status = add_tip(p, job, within, u, err);
    if (status == WT_OK)
        status = add_pull(p, within, u, err);
    return status == WT_OK ? add_temperature(p, job, work, row, within, u, err) : status;
}
