/* Verdict on the difference between wear track and bulk: yes, no within a margin, or inconclusive
 * with a remedy, and the range of the ratio over the choices of the fit: its range, the shape of
 * the tip, the hysteresis loss, the pull of the surface, and the baseline in contact. The fits of
 * the curves state the changes of the moduli, so that no curve is fitted again.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/compare.h"

#include "core/base/number.h"
#include "core/base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- range over the choices of the fit ------------------------------------------------------- */

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

static ratio_choices compare_ratio_choices(const compare_pair *p, double ratio)
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

/* ---- verdict --------------------------------------------------------------------------------- */

/* Assumed scatter of ln E between spots for the advised number of spots if none is measured. Twice
 * the scatter requires four times the spots. */
static const double scatter_assumed = 0.15;
/* Significance level of the tests and of the intervals. */
static const double level = 0.05;

typedef struct short_text {
    char text[48];
} short_text;

static short_text format_rate(double rate)
{
    short_text w;
    wt_format_si(rate, "m/s", 2, w.text, sizeof w.text);
    return w;
}

#define SET_VERDICT(v, value, ...)                                                                 \
    ((v)->verdict = (value), clocale_print((v)->reason, sizeof(v)->reason, __VA_ARGS__))

/* Advises a number of spots for the present scatter and the apparent difference, which is at least
 * the margin. */
static void advise_spots(const wt_compare_job *job, const wt_comparison *c, compare_verdict *v)
{
    const double least = log1p(job->margin);
    const double found = isnan(c->log_ratio.value) ? 0 : c->log_ratio.value;
    const double difference = fabs(found) > least ? found : least;
    const bool measured = c->scatter > 0;
    const bool given = !measured && job->spot_scatter > 0;
    const double scatter = measured ? c->scatter : given ? job->spot_scatter : scatter_assumed;
    const size_t n = wt_required_spots(difference, scatter);
    char number[64];
    if (n == 0)
        snprintf(number, sizeof number, "more than 1000 spots");
    else
        snprintf(number, sizeof number, "%zu spots", n < 3 ? 3 : n);
    const char *third = "";
    if (c->by_spot && c->n_bulk == 2 && c->n_track > 2)
        third = "a third spot in the bulk first, because two do not determine their scatter; ";
    else if (c->by_spot && c->n_track == 2 && c->n_bulk > 2)
        third = "a third spot in the track first, because two do not determine their scatter; ";
    clocale_print(
        v->settled_by, sizeof v->settled_by,
        "%s%s in each group would show a difference of %s in four of five trials where spots "
        "scatter by %s%s; more curves on a spot do not help",
        third, number, format_percent(fabs(expm1(difference))).text, format_percent(scatter).text,
        measured ? ", as they do here"
        : given  ? ", as given"
                 : " (assumed)");
}

static void format_group_rates(const compare_pair *p, int g, char *text, size_t size)
{
    size_t first = p->n_bins, last = 0;
    for (size_t b = 0; b < p->n_bins; b++)
        for (size_t i = 0; i < p->data[g].group.n; i++)
            if (p->bin[g][i] == b) {
                first = b < first ? b : first;
                last = b;
            }
    if (first == p->n_bins)
        snprintf(text, size, "not known");
    else if (first == last)
        snprintf(text, size, "%s", format_rate(p->high[last]).text);
    else
        snprintf(text, size, "%s to %s", format_rate(p->low[first]).text,
                 format_rate(p->high[last]).text);
}

static void report_disjoint_rates(const compare_pair *p, bool twisted, compare_verdict *v)
{
    char bulk[112], track[112];
    format_group_rates(p, 0, bulk, sizeof bulk);
    format_group_rates(p, 1, track, sizeof track);
    SET_VERDICT(v, VERDICT_INCONCLUSIVE,
                "bulk (%s) and track (%s) have no indentation rate in common, and %s", bulk, track,
                twisted ? "their moduli change with the rate in different ways"
                        : "nothing says how the modulus depends on the rate");
    clocale_print(v->settled_by, sizeof v->settled_by, "curves of both at one rate%s",
                  twisted ? "" : ", or at several rates on each spot, or a DMA of the rubber");
}

/* Returns a remedy for curves that were rejected for this reason. */
static const char *curve_remedy(wt_curve_verdict main_rejection)
{
    switch (main_rejection) {
    case WT_CURVE_POOR_FIT:
    case WT_CURVE_ADHESIVE:
    case WT_CURVE_AMBIGUOUS:
        return "what the contact law lacks: radius and half-angle of the tip as it is now "
               "(curves on the bulk again after the track show whether it wore), curves "
               "without a pull, a DMA of the rubber for its loss, a larger depth if it is rough";
    case WT_CURVE_NO_BASELINE:
    case WT_CURVE_DRIFT:
        return "curves that begin farther from the sample, with a straight baseline";
    case WT_CURVE_NO_CONTACT:
    case WT_CURVE_IMPRECISE:
        return "curves that are pressed further, or with less noise";
    case WT_CURVE_SATURATED:
        return "curves that are pressed less far, or a stiffer cantilever";
    case WT_CURVE_NEGATIVE:
    case WT_CURVE_RIGID:
        return "the sign of the deflection and the deflection sensitivity, or a stiffer cantilever";
    default:
        return "curves whose approach is there as a whole";
    }
}

/* Assesses groups without a usable curve; each group is assessed separately. */
static bool assess_empty_groups(const compare_pair *p, compare_verdict *v)
{
    const bool empty[2] = {p->data[0].group.n == 0, p->data[1].group.n == 0};
    if (!empty[0] && !empty[1])
        return false;
    v->is_unreportable = true;
    v->verdict = VERDICT_INCONCLUSIVE;
    for (int g = 0; g < 2; g++) {
        const wt_group_data *d = &p->data[g];
        if (!empty[g])
            continue;
        const char *also = g > 0 && empty[0] ? "; " : "";
        if (d->group.n_rejected == 1)
            clocale_append(v->reason, sizeof v->reason, "%sthe only curve of the %s has no modulus",
                           also, compare_group_name[g]);
        else
            clocale_append(v->reason, sizeof v->reason,
                           "%snone of the %zu curves of the %s has a modulus", also,
                           d->group.n_rejected, compare_group_name[g]);
        const char *better = curve_remedy(d->main_rejection);
        const bool is_named =
            g > 0 && empty[0] && curve_remedy(p->data[0].main_rejection) == better;
        if (d->n_main_rejection > 0)
            clocale_append(v->reason, sizeof v->reason, " (%zu: %s)", d->n_main_rejection,
                           wt_curve_verdict_text(d->main_rejection));
        if (!is_named)
            clocale_append(v->settled_by, sizeof v->settled_by, "%s%s",
                           v->settled_by[0] != '\0' ? "; " : "", better);
    }
    return true;
}

/* Assesses conditions that leave the ratio unknown. */
static bool assess_conditions(const compare_pair *p, const comparison_inputs *k,
                              const compare_row *row, compare_verdict *v)
{
    const wt_comparison *c = &row->c;
    v->is_unreportable = true;
    if (k->lacks_temperature_effect) {
        SET_VERDICT(v, VERDICT_INCONCLUSIVE,
                    "bulk and track were indented at different temperatures, and "
                    "nothing says how the modulus changes with temperature");
        clocale_print(v->settled_by, sizeof v->settled_by,
                      "a DMA of the rubber, the slope of ln E against temperature "
                      "(temperature-slope), or curves at one temperature");
    } else if (k->unreachable_temperature[0] != '\0') {
        SET_VERDICT(v, VERDICT_INCONCLUSIVE, "the DMA does not reach %s",
                    k->unreachable_temperature);
        clocale_print(v->settled_by, sizeof v->settled_by, "DMA isotherms at that temperature, %s",
                      k->rates_by_dma
                          ? "or curves of both at one rate"
                          : "the slope of ln E against temperature (temperature-slope), or "
                            "curves at one temperature");
    } else if (c->undecided_reason == WT_UNDECIDED_NO_COMMON_RATE ||
               c->undecided_reason == WT_UNDECIDED_SLOPES_DIFFER) {
        report_disjoint_rates(p, c->undecided_reason == WT_UNDECIDED_SLOPES_DIFFER, v);
    } else {
        v->is_unreportable = false;
    }
    return v->is_unreportable;
}

/* Assesses missing information that leaves the ratio without an interval. */
static bool assess_missing_error(const compare_pair *p, const wt_compare_job *job,
                                 const comparison_inputs *k, const compare_row *row,
                                 compare_verdict *v)
{
    const wt_comparison *c = &row->c;
    if (c->undecided_reason == WT_UNDECIDED_ONE_SPOT) {
        const bool both = c->n_bulk < 2 && c->n_track < 2;
        const bool file = (c->n_bulk < 2 && !p->data[0].spots_are_named && !job->map_spots) ||
                          (c->n_track < 2 && !p->data[1].spots_are_named && !job->map_spots);
        SET_VERDICT(v, VERDICT_INCONCLUSIVE,
                    "%s measured on one spot only%s, so it is not known how much the modulus "
                    "changes from place to place",
                    both            ? "bulk and track were each"
                    : c->n_bulk < 2 ? "the bulk was"
                                    : "the track was",
                    file ? " (the curves of one file, none of them with a named spot)" : "");
        advise_spots(job, c, v);
        return true;
    }
    if (k->lacks_spring_constant_error) {
        SET_VERDICT(v, VERDICT_INCONCLUSIVE,
                    "bulk and track were indented with different cantilevers, and "
                    "the error of a spring constant is not stated");
        clocale_print(v->settled_by, sizeof v->settled_by,
                      "one cantilever for both, or the errors of the spring constants "
                      "(spring-constant-error)");
        return true;
    }
    return false;
}

/* Assesses a ratio that depends on the rate: each rate separately, with corrected p values. */
static void assess_rate_dependence(const compare_row *rates, size_t n, double interaction,
                                   compare_verdict *v)
{
    bool softer = false, stiffer = false;
    for (size_t i = 0; i < n; i++) {
        if (!rates[i].valid || !(rates[i].holm < level))
            continue;
        softer = softer || rates[i].c.ratio < 1;
        stiffer = stiffer || rates[i].c.ratio > 1;
    }
    v->depends_on_rate = true;
    if (!softer && !stiffer) {
        SET_VERDICT(v, VERDICT_INCONCLUSIVE,
                    "the ratio depends on the rate (p %s), and at no single rate is a "
                    "difference shown",
                    format_probability(interaction).text);
        clocale_print(v->settled_by, sizeof v->settled_by, "more spots at each rate");
        return;
    }
    SET_VERDICT(v, VERDICT_YES,
                "the wear track is %s the bulk, by a ratio that depends on the rate (p %s)",
                softer && stiffer ? "at some rates softer and at others stiffer than"
                : softer          ? "softer than"
                                  : "stiffer than",
                format_probability(interaction).text);
}

/* An interval without a known error source does not show that the difference is small. */
static void report_incomplete_interval(const wt_compare_job *job, const comparison_inputs *k,
                                       compare_verdict *v)
{
    SET_VERDICT(v, VERDICT_INCONCLUSIVE,
                "the interval of the ratio contains no difference above %s, but it lacks an "
                "error that is not known: %s",
                format_percent(job->margin).text, k->lacks);
    if (k->lacks_loss_effect)
        clocale_print(
            v->settled_by, sizeof v->settled_by, "%s",
            "curves whose samples have times, or a DMA of the rubber: either determines the "
            "effect of the loss on the moduli");
    else if (k->lacks_second_range)
        clocale_print(v->settled_by, sizeof v->settled_by, "%s",
                      "indent with --misfit-p-threshold 0.01, and curves with more samples in "
                      "contact: either tests the contact law in a second range of the fit");
    else
        clocale_print(v->settled_by, sizeof v->settled_by, "the error or the effect of: %s",
                      k->lacks);
}

/* Plausible other causes prevent a verdict. */
static void report_unstated_errors(const unstated_errors *unstated, const char *seems,
                                   compare_verdict *v)
{
    SET_VERDICT(v, VERDICT_INCONCLUSIVE, "the wear track %s, but this may be as well: %s", seems,
                unstated->plausible);
    clocale_print(v->settled_by, sizeof v->settled_by, "%s", unstated->settled_by);
}

/* Assesses the difference by its interval. */
static compare_verdict assess_interval(const compare_pair *p, const wt_compare_job *job,
                                       const comparison_inputs *inputs,
                                       const unstated_errors *unstated, const compare_row *row,
                                       const compare_row *rates, size_t n_rates)
{
    const wt_comparison *c = &row->c;
    const double margin = log1p(job->margin);
    compare_verdict v = {0};
    if (assess_empty_groups(p, &v) || assess_conditions(p, inputs, row, &v) ||
        assess_missing_error(p, job, inputs, row, &v))
        return v;
    if (c->interaction_p < level) {
        assess_rate_dependence(rates, n_rates, c->interaction_p, &v);
        if (v.verdict == VERDICT_YES && unstated->plausible[0] != '\0')
            report_unstated_errors(unstated, "seems to differ, by a ratio that depends on the rate",
                                   &v);
        return v;
    }
    const double low = log(c->ratio_low), high = log(c->ratio_high);
    const bool within = low > -margin && high < margin;
    if (within && inputs->lacks[0] != '\0') {
        report_incomplete_interval(job, inputs, &v);
    } else if ((low > 0 || high < 0 || within) && unstated->plausible[0] != '\0') {
        report_unstated_errors(unstated,
                               high < 0  ? "seems softer"
                               : low > 0 ? "seems stiffer"
                                         : "seems to differ by less than the margin",
                               &v);
    } else if (low > 0 || high < 0) {
        SET_VERDICT(&v, VERDICT_YES, "the wear track is %s than the bulk%s",
                    high < 0 ? "softer" : "stiffer", within ? ", by less than the margin" : "");
    } else if (within) {
        SET_VERDICT(&v, VERDICT_NO,
                    "the wear track differs from the bulk by less than %s, the margin set",
                    format_percent(job->margin).text);
    } else {
        SET_VERDICT(&v, VERDICT_INCONCLUSIVE,
                    "the interval of the ratio contains both no difference and one above %s",
                    format_percent(job->margin).text);
        const double known_error = inputs->offset.standard_error;
        if (c->offset_variance_share > 0.5 &&
            inputs->loss_and_curvature_error * inputs->loss_and_curvature_error >
                0.5 * known_error * known_error)
            clocale_print(
                v.settled_by, sizeof v.settled_by, "%s",
                "a DMA of the rubber, which determines the spectrum of the loss, or curves "
                "with straight baselines: loss and bent baselines cause most of the interval");
        else if (c->offset_variance_share > 0.5)
            clocale_print(
                v.settled_by, sizeof v.settled_by, "%s",
                inputs->has_two_cantilevers
                    ? "one cantilever for both groups: its errors cancel in the ratio"
                    : "temperature and rate the same in both groups: their errors are most of "
                      "the interval");
        else
            advise_spots(job, c, &v);
    }
    return v;
}

/* Withdraws the verdict of the interval if another choice of the fit contradicts it. */
static void assess_choices(double margin, compare_verdict *v)
{
    const double low = log(v->choices.low), high = log(v->choices.high);
    const bool contradicts = v->verdict == VERDICT_YES  ? low <= 0 && high >= 0
                             : v->verdict == VERDICT_NO ? low <= -margin || high >= margin
                                                        : false;
    if (!contradicts || v->depends_on_rate)
        return;
    SET_VERDICT(
        v, VERDICT_INCONCLUSIVE,
        "the interval alone would decide, but other choices of the fit give ratios from %.3g "
        "to %.3g; the choice with the largest effect is: %s",
        v->choices.low, v->choices.high, v->choices.widest);
    clocale_print(v->settled_by, sizeof v->settled_by, "%s", v->choices.remedy);
}

/* ---- a spot that does not belong ------------------------------------------------------------- */

/* Chance below which a spot is named as one that does not belong. */
static const double outlier_level = 0.01;

/* Compares without one spot of a group. False if that leaves no interval. */
static bool compare_without_spot(const compare_pair *p, const comparison_inputs *k, int group,
                                 long spot, wt_comparison *c)
{
    wt_group g[2] = {compare_select_curves(p, 0, COMPARE_ALL_BINS, 0, p->by_factor)};
    g[1] = compare_select_curves(p, 1, COMPARE_ALL_BINS, g[0].n, p->by_factor);
    const size_t first = group == 0 ? 0 : g[0].n, n = g[group].n;
    size_t kept = first;
    if (k->rates_by_dma)
        g[0].rate = g[1].rate = NULL;
    for (size_t i = first; i < first + n; i++) {
        if (p->spot[i] == spot)
            continue;
        p->modulus[kept] = p->modulus[i];
        p->rate[kept] = p->rate[i];
        p->spot[kept] = p->spot[i];
        p->rate_class[kept++] = p->rate_class[i];
    }
    g[group].n = kept - first;
    return wt_compare_moduli(&g[0], &g[1], &k->offset, c, NULL) == WT_OK &&
           c->undecided_reason == WT_UNDECIDED_NOT;
}

/* Names a spot that widens the interval, and the ratio without it, before the other remedies. */
static void name_outlying_spot(const compare_pair *p, const comparison_inputs *k,
                               compare_verdict *v)
{
    for (int g = 0; g < 2; g++) {
        const wt_group_data *d = &p->data[g];
        double *logs = wt_alloc(d->group.n, sizeof *logs), chance;
        for (size_t i = 0; i < d->group.n; i++)
            logs[i] = log(p->by_factor ? d->spectrum_factor[i] : d->modulus[i]);
        const long spot = wt_outlying_spot(logs, d->group.spot, d->group.n, &chance);
        free(logs);
        wt_comparison c;
        char others[sizeof v->settled_by];
        size_t first = 0;
        if (!(chance < outlier_level) || d->group.spot == NULL ||
            !compare_without_spot(p, k, g, spot, &c))
            continue;
        while (d->spot[first] != spot)
            first++;
        snprintf(others, sizeof others, "%s", v->settled_by);
        clocale_print(v->settled_by, sizeof v->settled_by,
                      "the spot %s of the %s measured again: it is far from the others (chance "
                      "%s), and without it the ratio is %.3g (%.3g to %.3g); %s",
                      d->spot_name[first], compare_group_name[g], format_probability(chance).text,
                      c.ratio, c.ratio_low, c.ratio_high, others);
        return;
    }
}

compare_verdict compare_assess(const compare_pair *p, const wt_compare_job *job,
                               const comparison_inputs *inputs, const unstated_errors *unstated,
                               const compare_row *row, const compare_row *rates, size_t n_rates)
{
    compare_verdict v = assess_interval(p, job, inputs, unstated, row, rates, n_rates);
    v.choices = compare_ratio_choices(p, v.is_unreportable ? (double)NAN : row->c.ratio);
    assess_choices(log1p(job->margin), &v);
    if (v.verdict == VERDICT_INCONCLUSIVE && row->valid)
        name_outlying_spot(p, inputs, &v);
    return v;
}
