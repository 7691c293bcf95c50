/* Range of the ratio of the moduli over the choices of the fit: its range, the shape of the tip,
 * the hysteresis loss, the pull of the surface, and the baseline in contact. The fits of the curves
 * state the changes of the moduli, so that no curve is fitted again.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/compare.h"

#include <math.h>

typedef struct fit_choice {
    const char *words, *remedy;
    size_t n; /* alternatives */
    /* relative change of the moduli of a group with an alternative */
    wt_estimate (*shift)(const compare_pair *p, int g, size_t alternative);
} fit_choice;

static wt_estimate exact_shift(double value)
{
    return (wt_estimate){value, 0, 0, "1"};
}

static wt_estimate range_shift(const compare_pair *p, int g, size_t alternative)
{
    return p->data[g].range_shift[alternative];
}

/* Factors on half-angle and radius of a tip of nominal shape, after the tolerances in data sheets
 * of AFM probes: 2.5 degrees of 25, and a largest radius of 12 nm where 8 nm are nominal. The
 * derivative of ln E is good enough for these steps. */
static const struct {
    wt_systematic_source source;
    double factor;
} tip_factors[] = {{WT_SYSTEMATIC_HALF_ANGLE, 1 / 1.1},
                   {WT_SYSTEMATIC_HALF_ANGLE, 1.1},
                   {WT_SYSTEMATIC_RADIUS, 1 / 1.5},
                   {WT_SYSTEMATIC_RADIUS, 1.5}};

/* A tip whose error is stated, for its source or as that of the tip, was measured, and is no
 * choice. */
static wt_estimate tip_shift(const compare_pair *p, int g, size_t alternative)
{
    const wt_group_data *d = &p->data[g];
    const wt_systematic_source source = tip_factors[alternative].source;
    const double change = d->common_gain[source].value * log(tip_factors[alternative].factor);
    const bool stated = !isnan(d->common_error[source]) || d->tip_error > 0;
    return exact_shift(stated ? (double)NAN : expm1(change));
}

/* A fit with the spectrum of the DMA does not choose the loss. */
static wt_estimate loss_shift(const compare_pair *p, int g, size_t alternative)
{
    (void)alternative;
    return exact_shift(p->by_factor ? 0 : p->data[g].loss_shift);
}

static wt_estimate pull_shift(const compare_pair *p, int g, size_t alternative)
{
    (void)alternative;
    return exact_shift(p->data[g].pull_shift);
}

static wt_estimate bend_shift(const compare_pair *p, int g, size_t alternative)
{
    (void)alternative;
    return exact_shift(p->data[g].bend_error);
}

static const fit_choice choices[] = {
    {"range of the fit", "Measure the shape of the tip, or fit one depth for both (fit-depth).",
     WT_FIT_RANGES, range_shift},
    {"shape of the tip", "Measure the radius and half-angle of the tip.", COUNT_OF(tip_factors),
     tip_shift},
    {"loss of the rubber", "Measure a DMA of the rubber.", 1, loss_shift},
    {"adhesion", "Fit the pull of the surface (adhesion), or indent in a liquid.", 1, pull_shift},
    {"baseline in contact", "Press on something hard with the same travel of the piezo.", 1,
     bend_shift}};

/* Change of ln(ratio) with an alternative, without the part that noise makes. NaN if a group does
 * not state it. */
static double log_ratio_shift(const compare_pair *p, const fit_choice *choice, size_t alternative)
{
    double change = 0, noise = 0;
    for (int g = 0; g < 2; g++) {
        const wt_estimate shift = choice->shift(p, g, alternative);
        const double log_shift = shift.value > -1 ? log1p(shift.value) : (double)NAN;
        change = log_shift - change; /* the track over the bulk */
        noise = hypot(noise, shift.standard_error / (1 + shift.value));
    }
    if (isnan(change)) /* fmax would ignore it */
        return change;
    return copysign(sqrt(fmax(change * change - noise * noise, 0)), change);
}

ratio_choices compare_ratio_choices(const compare_pair *p, double ratio)
{
    ratio_choices range = {(double)NAN, (double)NAN, NULL, NULL};
    double low = 0, high = 0, widest = 0;
    for (size_t i = 0; i < COUNT_OF(choices); i++) {
        double below = 0, above = 0;
        for (size_t j = 0; j < choices[i].n; j++) {
            const double shift = log_ratio_shift(p, &choices[i], j);
            below = fmin(below, shift); /* fmin and fmax ignore NaN */
            above = fmax(above, shift);
        }
        low = fmin(low, below);
        high = fmax(high, above);
        if (above - below > widest) {
            widest = above - below;
            range.widest = choices[i].words;
            range.remedy = choices[i].remedy;
        }
    }
    if (!(widest > 0) || isnan(ratio))
        return (ratio_choices){(double)NAN, (double)NAN, NULL, NULL};
    range.low = ratio * exp(low);
    range.high = ratio * exp(high);
    return range;
}
