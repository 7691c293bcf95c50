/* Causes other than the rubber that would produce the ratio: tip wear, adhesion, or another
 * temperature, not stated or different between the groups. If one of them is plausible, the ratio
 * neither shows nor excludes a difference of the rubber.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/compare.h"

#include "core/base/number.h"
#include "core/base/text.h"
#include "core/math/root.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Significance level for adhesion or lack of fit in one group, against the stated conditions. */
static const double level = 0.05;
/* Significance level for the lack of fit of few curves. A missed effect causes a wrong yes, a false
 * alarm only an "inconclusive". The level is therefore the usual type II error. */
static const double few_level = 0.2;
/* [m] Limit of tip wear: probes of 10 to 20 nm reach 50 to 100 nm after scans over hard
 * fillers. Blunter tips image themselves instead of the sample. */
static const double worn_radius = 100e-9;
/* [K] Range of laboratory temperatures, 15 to 35 degC. A scanner warms the sample by a
 * few kelvin. */
static const double room_span = 20;
/* [1/K] -d ln aT/dT by Williams, Landel and Ferry (J. Am. Chem. Soc. 77 (1955) 3701: 17.44, 51.6 K)
 * at 70 K above the glass transition. A rubber with a transition at -45 degC is there at room
 * temperature. The slope is 0.22 at 45 K and 0.07 at 120 K. */
static const double shift_slope = 0.14;
/* d ln E/d ln rate if the curves do not determine it: 2/pi times a loss factor of 0.1, that of many
 * compounds at room temperature. */
static const double usual_rate_slope = 0.06;
/* Multiple of a stated standard error on both sides. */
static const double two_errors = 2;

/* Mean curve of a group at its largest force. Without a spring constant the cantilever is rigid. */
typedef struct pressed_curve {
    double depth, force, bending;
} pressed_curve;

static pressed_curve mean_pressed_curve(const wt_group_data *d)
{
    pressed_curve p = {compare_mean(d->max_indentation, d->group.n),
                       compare_mean(d->max_force, d->group.n), 0};
    if (d->spring_constant.value > 0 && p.force > 0)
        p.bending = p.force / d->spring_constant.value;
    return p;
}

/* ---- causes ---------------------------------------------------------------------------------- */

/* Largest effect of a cause on ln(ratio): the ratio of the rubber may be lower or higher by it. */
typedef struct cause_effect {
    double lower, higher;
} cause_effect;

/* Effect of a cause that increases the modulus of a group. */
static cause_effect group_effect(int group, double effect)
{
    return group == 1 ? (cause_effect){effect, 0} : (cause_effect){0, effect};
}

/* Adds a cause to the text. Plausible causes prevent a verdict. */
static void add_cause(unstated_errors *u, bool plausible, cause_effect effect, const char *words,
                      const char *settled_by)
{
    clocale_append(u->would_explain, sizeof u->would_explain, "%s%s",
                   u->would_explain[0] != '\0' ? "; " : "", words);
    if (!plausible)
        return;
    u->lower += effect.lower;
    u->higher += effect.higher;
    const char *const between = u->plausible[0] != '\0' ? "; " : "";
    clocale_append(u->settled_by, sizeof u->settled_by, "%s%s", between, settled_by);
    clocale_append(u->plausible, sizeof u->plausible, "%s%s", between, words);
}

static double contact_force(const wt_tip *tip, double depth)
{
    double g, slope;
    wt_contact_function(tip, depth, &g, &slope);
    return g;
}

/* Fit of a curve with tip wear, and the effect on ln(modulus) that it must have. */
typedef struct wear_search {
    const wt_tip *tip;
    const pressed_curve *at;
    double effect;
    wt_tip_wear fit;
    wt_status status;
    wt_error *err;
} wear_search;

static double wear_excess(double radius, void *user)
{
    wear_search *s = user;
    if (s->status == WT_OK)
        s->status = wt_tip_wear_fit(s->tip, radius, s->at->depth, s->at->bending, &s->fit, s->err);
    return s->fit.log_modulus - s->effect;
}

/* Share of the radius to which it is found: far more than the text shows. */
static const double radius_share = 1e-7;

/* Finds the radius that increases the modulus by exp(effect), and its lack of fit. Infinity if ten
 * times the largest worn radius does not suffice. */
static wt_status required_radius(const wt_tip *tip, const pressed_curve *at, double effect,
                                 double *radius, double *misfit, wt_error *err)
{
    wear_search s = {.tip = tip, .at = at, .effect = effect, .err = err};
    const double high = 10 * worn_radius;
    wt_status status = WT_OK;
    *radius = wear_excess(high, &s) > 0 ? tip->radius : (double)INFINITY;
    if (s.status == WT_OK && *radius < high && wear_excess(*radius, &s) < 0)
        status = root_find(wear_excess, &s, *radius, high, radius_share * *radius, radius, err);
    *misfit = s.fit.misfit;
    return s.status != WT_OK ? s.status : status;
}

/* p values of tip wear in each group, which only the lack of fit shows: relative to the other
 * group, and over all curves. */
static void misfit_p_values(const compare_pair *p, double chance[2])
{
    const wt_group_data *bulk = &p->data[0], *track = &p->data[1];
    const double *const values[2] = {bulk->lack_of_fit, track->lack_of_fit};
    const long *const spots[2] = {bulk->fitted_spot, track->fitted_spot};
    const size_t n[2] = {bulk->n_fitted, track->n_fitted};
    const wt_mean_comparison lack = wt_compare_means(values, spots, n);
    for (int g = 0; g < 2; g++)
        chance[g] = wt_combined_p_value(lack.larger_p[g], p->data[g].pooled_misfit_p);
}

/* True for a pyramid or cone with a cap. */
static bool is_blunted_tip(const wt_group_data *d)
{
    return d->has_tip && d->tip.shape == WT_TIP_BLUNTED_PYRAMID && d->tip.transition_radius > 0;
}

/* Returns the largest plausible tip radius. */
static double largest_radius(const wt_group_data *d, const wt_compare_job *job, const wt_tip *tip)
{
    const double stated = d->common_error[WT_SYSTEMATIC_RADIUS];
    if (stated > 0)
        return tip->radius * (1 + two_errors * stated);
    return job->tip_error > 0 ? tip->radius : worn_radius;
}

/* True if the lack of fit is closer to that of tip wear than to zero. Few curves give only a p
 * value. A stated tip is accepted unless the curves contradict it. */
static bool shows_wear(const wt_group_data *d, const wt_compare_job *job, double misfit,
                       double chance)
{
    const bool stated = d->common_error[WT_SYSTEMATIC_RADIUS] > 0 || job->tip_error > 0;
    if (stated)
        return chance < level;
    return isnan(d->pooled_misfit) ? chance < few_level : d->pooled_misfit > misfit / 2;
}

/* The tip is blunter in the group that seems stiffer, or else in the one with the lack of fit. */
static wt_status add_tip_cause(const compare_pair *p, const wt_compare_job *job, bool within,
                               unstated_errors *u, wt_error *err)
{
    double chance[2], needed, least, misfit, ignored;
    misfit_p_values(p, chance);
    const int worn = within ? chance[1] < chance[0] : u->log_ratio > 0;
    const wt_group_data *d = &p->data[worn];
    const pressed_curve at = mean_pressed_curve(d);
    const wt_tip tip = d->tip;
    if (!is_blunted_tip(d) || !(at.depth > 0) || !(tip.radius < worn_radius))
        return WT_OK;
    wt_status status = required_radius(
        &tip, &at, within ? u->smallest_to_explain : fabs(u->log_ratio), &needed, &misfit, err);
    if (status != WT_OK || isinf(needed))
        return status;
    status = required_radius(&tip, &at, u->smallest_to_explain, &least, &ignored, err);
    if (status != WT_OK)
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
    add_cause(u, plausible, group_effect(worn, most.log_modulus), words,
              "the radius of the tip before and after, with its error (radius=20nm+-10%), or "
              "curves on the bulk again after the track");
    return status;
}

/* More than the 53 binary digits of a double. */
enum { BISECTIONS = 60 };

/* Curve with an adhesion: its share of the force, or the effect that is asked for. */
typedef struct pulled_curve {
    const wt_tip *tip;
    double depth, share, force, effect;
} pulled_curve;

/* True if the force at a share of the whole depth does not exceed the adhesion. */
static bool is_below_pull(double x, void *user)
{
    const pulled_curve *p = user;
    const double all = p->depth / (1 - x);
    return !(contact_force(p->tip, x * all) > p->share * contact_force(p->tip, all));
}

/* Largest effect of an adhesion that acts throughout the contact. The apparent contact begins where
 * the force compensates it, and the remainder is fitted as the whole curve. Without a known tip the
 * force is quadratic in the depth. */
static double pull_effect(const wt_tip *tip, double depth, double force, double pull)
{
    const double share = pull / (force + pull);
    double low = 0, high = 1;
    if (tip == NULL)
        return log1p(sqrt(share)) - log1p(-sqrt(share));
    /* the whole depth is the depth at compensation plus the apparent depth */
    pulled_curve of = {.tip = tip, .depth = depth, .share = share};
    root_bisect(is_below_pull, &of, &low, &high, 0, BISECTIONS);
    const double all = depth / (1 - low);
    return log((contact_force(tip, all) - contact_force(tip, low * all)) /
               contact_force(tip, depth));
}

static bool is_pull_too_small(double pull, void *user)
{
    const pulled_curve *p = user;
    return !(pull_effect(p->tip, p->depth, p->force, pull) > p->effect);
}

static double required_pull(const wt_tip *tip, double depth, double force, double effect)
{
    double low = 0, high = force;
    pulled_curve of = {.tip = tip, .depth = depth, .force = force, .effect = effect};
    if (is_pull_too_small(high, &of))
        return (double)INFINITY;
    root_bisect(is_pull_too_small, &of, &low, &high, 0, BISECTIONS);
    return high;
}

/* Adds adhesion if it is larger in one group. */
static void add_pull_cause(const compare_pair *p, bool within, unstated_errors *u)
{
    const double *const values[2] = {p->data[0].pull, p->data[1].pull};
    const long *const spots[2] = {p->data[0].group.spot, p->data[1].group.spot};
    const size_t n[2] = {p->data[0].group.n, p->data[1].group.n};
    const wt_mean_comparison pulls = wt_compare_means(values, spots, n);
    const int more = pulls.mean[1] > pulls.mean[0];
    const wt_group_data *d = &p->data[more];
    const pressed_curve at = mean_pressed_curve(d);
    const double there = pulls.mean[more] - pulls.mean[!more];
    if (!(pulls.larger_p[more] < level) || !(at.depth > 0) || !(at.force > 0))
        return;
    const wt_tip *const known = is_blunted_tip(d) ? &d->tip : NULL;
    const double needed = required_pull(known, at.depth, at.force,
                                        within ? u->smallest_to_explain : fabs(u->log_ratio)),
                 least = required_pull(known, at.depth, at.force, u->smallest_to_explain);
    char words[200], is[32], would[32];
    if (isinf(needed))
        return;
    wt_format_si(there, "N", 2, is, sizeof is);
    wt_format_si(needed, "N", 2, would, sizeof would);
    clocale_print(words, sizeof words,
                  "a pull of %s more in the %s that the contact law does not have%s (%s more were "
                  "measured)",
                  would, compare_group_name[more], within ? ", which would hide the margin" : "",
                  is);
    add_cause(u, least <= there, group_effect(more, pull_effect(known, at.depth, at.force, there)),
              words, "curves without the pull, under liquid or after drying");
}

/* d ln E/dT without a DMA. By time-temperature superposition it is the slope against ln rate times
 * that of ln aT. If that is small, it is the rubber elasticity, 1/T. */
static double default_temperature_slope(const compare_row *row)
{
    const wt_estimate *rate = &row->c.rate_slope;
    const bool known = rate->standard_error < usual_rate_slope;
    const double fall = shift_slope * (known ? fmax(rate->value, 0) : usual_rate_slope),
                 rise = 1 / (WT_ZERO_CELSIUS + 25);
    return fall > rise ? -fall : rise;
}

/* Adds the temperature if none is stated. */
static wt_status add_temperature_cause(const compare_pair *p, const wt_compare_job *job,
                                       const wt_job *work, const compare_row *row, bool within,
                                       unstated_errors *u, wt_error *err)
{
    const bool stated = !isnan(job->temperature.value) || !isnan(job->track_temperature.value) ||
                        !isnan(job->temperature_slope.value);
    const bool by_dma = job->rubber != NULL;
    double slope = default_temperature_slope(row);
    if (stated || (!by_dma && p->by_factor)) /* the factors do not depend on the temperature */
        return WT_OK;
    wt_status status = WT_OK;
    if (by_dma)
        status = compare_temperature_slope(p, job, work, &slope, err);
    if (status != WT_OK || !(fabs(slope) > 0))
        return status;
    const double needed = (within ? u->smallest_to_explain : u->log_ratio) / slope,
                 effect = room_span * fabs(slope);
    char words[200], by[80] = "by the DMA";
    if (!by_dma)
        clocale_print(by, sizeof by, "if the modulus %s by %s a kelvin",
                      slope < 0 ? "falls" : "rises", format_percent(fabs(slope)).text);
    clocale_print(words, sizeof words,
                  "a track %.2g K %s than the bulk, %s%s (no "
                  "temperature is stated)",
                  fabs(needed), needed > 0 ? "warmer" : "colder", by,
                  within ? ", which would hide the margin" : "");
    /* A hidden difference must be as large as the margin and of the other sign. This is plausible
     * only with a known slope. */
    const bool plausible = (by_dma || !within) && u->smallest_to_explain <= effect;
    add_cause(u, plausible, (cause_effect){effect, effect}, words,
              by_dma ? "the temperature of the curves (indentation-temperature, track-temperature)"
                     : "the temperature of the curves, one for both if it was "
                       "(indentation-temperature, track-temperature)");
    return WT_OK;
}

/* Adds a calibration that is wrong in the bulk alone: the moduli of the track are those of the DMA,
 * and those of the bulk, the rubber of the DMA, are not. An error that both share moves both. */
static wt_status add_calibration_cause(const compare_pair *p, const wt_compare_job *job,
                                       const wt_job *work, bool within, unstated_errors *u,
                                       wt_error *err)
{
    wt_estimate away[2];
    wt_status status = WT_OK;
    if (within || job->rubber == NULL || isnan(job->temperature.value) ||
        job->cantilevers == WT_CANTILEVERS_SHARED)
        return WT_OK;
    for (int g = 0; status == WT_OK && g < 2; g++)
        status = compare_group_with_dma(p, g, job, work, &away[g], err);
    if (status != WT_OK || !(fabs(away[0].value) > two_errors * away[0].standard_error) ||
        !(fabs(away[1].value) < fabs(away[0].value) / 2))
        return status;
    char words[200];
    clocale_print(words, sizeof words,
                  "a spring constant, sensitivity or tip that is wrong in the bulk alone, which "
                  "has %.2g times the modulus of its DMA where the track has %.2g times",
                  exp(away[0].value), exp(away[1].value));
    add_cause(u, true, group_effect(u->log_ratio > 0, fabs(u->log_ratio)), words,
              "the calibration of the cantilever in the bulk once more, or a statement that both "
              "were indented with one (cantilevers one)");
    return WT_OK;
}

wt_status compare_find_unstated_errors(const compare_pair *p, const wt_compare_job *job,
                                       const wt_job *work, const compare_row *row,
                                       unstated_errors *u, wt_error *err)
{
    const wt_comparison *c = &row->c;
    *u = (unstated_errors){.log_ratio = c->log_ratio.value};
    if (!row->valid || isnan(u->log_ratio))
        return WT_OK;
    const double low = log(c->ratio_low), high = log(c->ratio_high);
    const bool within = !(low > 0) && !(high < 0);
    /* Smallest effect that changes the verdict. A yes needs the nearest limit of the interval at 1;
     * a no needs a difference as large as the margin. */
    u->smallest_to_explain = low > 0 ? low : high < 0 ? -high : log1p(job->margin);
    wt_status status = add_tip_cause(p, job, within, u, err);
    if (status != WT_OK)
        return status;
    add_pull_cause(p, within, u);
    status = add_calibration_cause(p, job, work, within, u, err);
    if (status != WT_OK)
        return status;
    return add_temperature_cause(p, job, work, row, within, u, err);
}
