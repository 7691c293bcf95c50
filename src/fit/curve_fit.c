/* The fit of one force curve: scan, refinement, and the verdict with its reason.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/gsl_quiet.h"
#include "base/param.h"
#include "fit/curve.h"
#include "model/material.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Limits of plausibility; every verdict names the number and the limit. */
static const double contact_noise = 5.0;   /* force in contact, in noise of the baseline */
static const double snap_noise = 6.0;      /* pull of a snap-on, in noise of the baseline */
static const double snap_rest = 1.5;       /* and against the deepest pull elsewhere */
static const double baseline_length = 0.1; /* of the largest indentation */
static const size_t baseline_samples = 10;
static const size_t contact_samples = 8;
static const double baseline_bend = 0.1;   /* departure from a line, of the largest force */
static const double rigid_gain = 50.0;     /* % of modulus per % of sensitivity */
static const double ambiguous_chi2 = 4.0;  /* 2 ln(likelihood ratio) of two contact points */
static const double ambiguous_ratio = 0.1; /* least |ln(E2/E1)| to call them different */
static const double weights_matter = 1.2;  /* largest 1 + S/k */
static const double reverse_ratio = 0.5;   /* cost of the fit in reverse against the fit */
static const double gap_tolerance = 0.5;   /* of the indentation: how far a snap-on may lie */
enum { MAX_DEPTH_ROUNDS = 8, BEND_BLOCKS = 16 };

static const struct {
    const char *id, *text;
} verdicts[] = {
#define VERDICT_ROW(name, id, text) {id, text},
    WT_CURVE_VERDICT_LIST(VERDICT_ROW)
#undef VERDICT_ROW
};

const char *wt_curve_verdict_id(wt_curve_verdict verdict)
{
    size_t i = (size_t)verdict;
    return i < sizeof verdicts / sizeof verdicts[0] ? verdicts[i].id : "unknown";
}

const char *wt_curve_verdict_text(wt_curve_verdict verdict)
{
    size_t i = (size_t)verdict;
    return i < sizeof verdicts / sizeof verdicts[0] ? verdicts[i].text : "unknown verdict";
}

wt_indent_options wt_indent_defaults(void)
{
    return (wt_indent_options){.poisson_ratio = 0.5,
                               .fit_depth = 0.0,
                               .fit_force_fraction = 1.0,
                               .fit_tilt = true,
                               .minimum_r_squared = 0.9,
                               .plain_least_squares = false,
                               .fixed_contact_point = (double)NAN};
}

static const wt_param rows[] = {
    POISSON_RATIO(wt_indent_options),
    {PARAM("fit-depth", wt_indent_options, fit_depth, WT_Q_LENGTH, AT_LEAST(0)), .value = "D",
     .help = "fit indentations up to this depth, such as 50nm; 0 is all"},
    {PARAM("fit-force-fraction", wt_indent_options, fit_force_fraction, WT_Q_NONE, ABOVE_TO(0, 1)),
     .value = "X", .help = "fit forces up to this share of the largest"},
    {PARAM("minimum-r-squared", wt_indent_options, minimum_r_squared, WT_Q_NONE, FROM_BELOW(0, 1)),
     .value = "X", .help = "reject a curve whose contact part has a smaller R squared"},
    {PARAM("fixed-contact-point", wt_indent_options, fixed_contact_point, WT_Q_LENGTH, ANY_NUMBER),
     .value = "Z", .unset = "", .flags = PARAM_NO_CASE,
     .help = "do not fit the contact point: take this tip position"},
    {PARAM_FLAG_OF("fit-tilt", wt_indent_options, fit_tilt),
     .help = "tilt of the baseline, which without it has an offset only"},
};
PARAM_TABLE(wt_indent_params, wt_indent_options, rows, wt_indent_defaults, NO_PARTS)

wt_indent_workspace *wt_indent_workspace_new(void)
{
    gsl_quiet();
    wt_indent_workspace *workspace = calloc(1, sizeof *workspace);
    if (workspace == NULL)
        return NULL;
    workspace->minimizer = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (workspace->minimizer == NULL) {
        free(workspace);
        return NULL;
    }
    return workspace;
}

void wt_indent_workspace_free(wt_indent_workspace *workspace)
{
    if (workspace == NULL)
        return;
    gsl_min_fminimizer_free(workspace->minimizer);
    free(workspace->block);
    free(workspace);
}

/* ---- parts of the fit ------------------------------------------------------------------------ */

typedef struct fitting {
    const wt_contact_table *table;
    const wt_indent_options *options;
    wt_indent_workspace *workspace;
    curve_input input;
    curve_solution solution;
    curve_minimum minima[CURVE_MAX_MINIMA];
    size_t n_minima;
    double adhesion;
    size_t n_snap; /* samples left out because of a snap-on */
    bool depth_settled;
} fitting;

static double baseline_at(const curve_solution *s, double position)
{
    return s->p[CURVE_F0] + s->p[CURVE_T] * (position - s->p[CURVE_C]);
}

static bool scan(fitting *f, bool weighted)
{
    f->n_minima = curve_scan(f->table, &f->input.samples, f->options->fit_tilt, weighted,
                             f->workspace, f->minima);
    return f->n_minima > 0;
}

/* Scan and refinement on the samples as they are now; false if nothing but a baseline is found.
 * The weights of the scan follow from a solution: any that describes the curve will do. */
static bool scan_and_refine(fitting *f)
{
    const wt_indent_options *o = f->options;
    const curve_samples *s = &f->input.samples;
    bool fixed = !isnan(o->fixed_contact_point);
    if (fixed) {
        double c = o->fixed_contact_point - f->input.position_origin;
        if (!curve_scan_at(f->table, s, o->fit_tilt, c, f->workspace, &f->minima[0]))
            return false;
        f->n_minima = 1;
    } else {
        if (!scan(f, false))
            return false;
        if (!o->plain_least_squares &&
            curve_weights(f->table, s, &f->minima[0], f->workspace) > weights_matter &&
            !scan(f, true))
            return false;
    }
    curve_refine(f->table, s, &f->minima[0], o->fit_tilt, fixed, o->plain_least_squares,
                 f->workspace, &f->solution);
    return true;
}

/* A jump to contact: a pull right before the force rises that stands out of everything before it.
 * The law knows no attraction, so these samples are taken out. True if samples were removed. */
static bool remove_snap_on(fitting *f)
{
    curve_samples *s = &f->input.samples;
    const curve_solution *fit = &f->solution;
    double *above = f->workspace->scratch;
    size_t deepest = 0;
    for (size_t i = 0; i < s->n; i++) {
        above[i] = s->force[i] - baseline_at(fit, s->position[i]);
        if (above[i] < above[deepest])
            deepest = i;
    }
    double pull = -above[deepest];
    size_t start = deepest, end = deepest;
    while (start > 0 && above[start - 1] < -2.0 * f->input.step_noise && above[start - 1] < 0.0)
        start--;
    while (end < s->n && above[end] < 0.0)
        end++;
    double elsewhere = 0.0, noise = 0.0;
    for (size_t i = 0; i < start; i++) {
        elsewhere = fmax(elsewhere, -above[i]);
        noise += above[i] * above[i];
    }
    if (start < baseline_samples)
        return false;
    noise = sqrt(noise / (double)start);
    double after_contact = s->position[start] - fit->p[CURVE_C];
    double reach = s->position[s->n - 1] - fit->p[CURVE_C];
    if (!(pull > snap_noise * noise) || !(pull > snap_rest * elsewhere) ||
        !(fabs(after_contact) < gap_tolerance * reach) || end == s->n ||
        s->n - (end - start) < CURVE_MIN_SAMPLES)
        return false;
    f->adhesion = pull;
    f->n_snap = end - start;
    memmove(s->position + start, s->position + end, (s->n - end) * sizeof *s->position);
    memmove(s->force + start, s->force + end, (s->n - end) * sizeof *s->force);
    s->n -= f->n_snap;
    return true;
}

/* Samples up to the first that is deeper than the limit. */
static size_t count_to_depth(const fitting *f)
{
    const curve_samples *s = &f->input.samples;
    const double *p = f->solution.p;
    double k = s->spring_constant;
    for (size_t i = 0; i < f->input.n_all - f->n_snap; i++) {
        double delta = (s->position[i] - p[CURVE_C]) * (1.0 + p[CURVE_T] / k) -
                       (s->force[i] - p[CURVE_F0]) / k;
        if (delta > f->options->fit_depth)
            return i;
    }
    return f->input.n_all - f->n_snap;
}

/* What is fitted depends on the contact point and the contact point on what is fitted. */
static bool fit_to_depth(fitting *f)
{
    size_t limit = f->input.samples.n;
    for (int round = 0; round < MAX_DEPTH_ROUNDS; round++) {
        size_t n = count_to_depth(f);
        n = n < limit ? n : limit;
        if (n == f->input.samples.n)
            return true;
        if (n < CURVE_MIN_SAMPLES)
            return true; /* the verdict on the samples in contact follows */
        f->input.samples.n = n;
        if (!scan_and_refine(f))
            return false;
    }
    f->depth_settled = false;
    return true;
}

/* How far means over blocks of the baseline residual depart from a line, peak to peak of a wave of
 * their scatter, beyond what white noise does. */
static double baseline_departure(const fitting *f)
{
    const curve_samples *s = &f->input.samples;
    size_t length = f->solution.first_contact / BEND_BLOCKS;
    if (length == 0)
        return 0.0;
    double square = 0.0;
    for (size_t block = 0; block < BEND_BLOCKS; block++) {
        double sum = 0.0;
        for (size_t i = block * length; i < (block + 1) * length; i++)
            sum += s->force[i] - baseline_at(&f->solution, s->position[i]);
        square += sum / (double)length * (sum / (double)length) / BEND_BLOCKS;
    }
    square -= f->input.step_noise * f->input.step_noise / (double)length;
    return square > 0.0 ? 2.0 * M_SQRT2 * sqrt(square) : 0.0;
}

/* ---- verdict --------------------------------------------------------------------------------- */

/* How far the mean force falls from the first tenth of the samples to the last. */
static double force_fall(const curve_samples *s)
{
    size_t tenth = s->n / 10;
    double first = 0.0, last = 0.0;
    for (size_t i = 0; i < tenth; i++) {
        first += s->force[i] / (double)tenth;
        last += s->force[s->n - 1 - i] / (double)tenth;
    }
    return first - last;
}

static wt_curve_verdict no_contact_verdict(fitting *f, char reason[160])
{
    const double fall = force_fall(&f->input.samples);
    const si_text change = curve_si(fabs(fall), "N"), noise = curve_si(f->input.step_noise, "N");
    if (fall > contact_noise * f->input.step_noise) {
        curve_say(reason,
                  "the force falls by %s towards the sample (noise %s): sign of the deflection?",
                  change.words, noise.words);
        return WT_CURVE_NEGATIVE;
    }
    curve_say(reason, "the force changes by %s from start to end (noise %s)", change.words,
              noise.words);
    return WT_CURVE_NO_CONTACT;
}

/* Does the curve look more like a contact when it is run backwards? Destroys the samples then. */
static bool leaves_the_sample(fitting *f, char reason[160])
{
    curve_samples *s = &f->input.samples;
    const double fall = force_fall(s);
    if (!(fall > contact_noise * f->input.step_noise))
        return false;
    curve_minimum minima[CURVE_MAX_MINIMA];
    double cost = (double)INFINITY;
    size_t n = curve_scan(f->table, s, true, false, f->workspace, minima);
    if (n > 0 && minima[0].contact_point > s->position[0])
        cost = minima[0].cost;
    curve_reverse(s);
    n = curve_scan(f->table, s, true, false, f->workspace, minima);
    if (n > 0 && minima[0].contact_point > s->position[0] &&
        minima[0].cost < reverse_ratio * cost) {
        curve_say(reason, "the force falls by %s along the segment: it leaves the sample",
                  curve_si(fall, "N").words);
        return true;
    }
    curve_reverse(s);
    return false;
}

static wt_curve_verdict judge(fitting *f, double max_force, wt_indent_fit *fit)
{
    const curve_solution *s = &f->solution;
    const curve_samples *samples = &f->input.samples;
    char *reason = fit->reason;

    double length = s->p[CURVE_C] - samples->position[0];
    if (length <= 0.0) {
        curve_say(reason, "contact is found %s before the first sample",
                  curve_si(-length, "m").words);
        return WT_CURVE_NO_BASELINE;
    }
    if (!(max_force > contact_noise * s->noise)) {
        curve_say(reason, "largest force %s is %.1f times the noise of %s, %g needed",
                  curve_si(max_force, "N").words, max_force / s->noise,
                  curve_si(s->noise, "N").words, contact_noise);
        return WT_CURVE_NO_CONTACT;
    }
    if (s->first_contact < baseline_samples || length < baseline_length * s->max_indentation) {
        curve_say(reason, "baseline of %zu samples and %s; %zu samples and %s needed",
                  s->first_contact, curve_si(length, "m").words, baseline_samples,
                  curve_si(baseline_length * s->max_indentation, "m").words);
        return WT_CURVE_NO_BASELINE;
    }
    if (samples->n - s->first_contact < contact_samples) {
        curve_say(reason, "%zu samples in contact, %zu needed", samples->n - s->first_contact,
                  contact_samples);
        return WT_CURVE_TOO_SHORT;
    }
    if (s->sensitivity_gain > rigid_gain) {
        curve_say(
            reason,
            "1 %% of deflection sensitivity would change the modulus by %.0f %%, %g %% allowed",
            s->sensitivity_gain, rigid_gain);
        return WT_CURVE_RIGID;
    }
    if (f->n_minima > 1) {
        const curve_minimum *second = &f->minima[1];
        double ratio = second->cost / f->minima[0].cost;
        double moduli = log(second->reduced_modulus / s->p[CURVE_E]);
        if (s->effective_n * log(ratio) < ambiguous_chi2 && fabs(moduli) > ambiguous_ratio) {
            const double away = fabs(second->contact_point - s->p[CURVE_C]);
            const double other = second->reduced_modulus * fit->modulus.value / s->p[CURVE_E];
            curve_say(reason,
                      "a contact point %s away gives %s instead of %s at %.3f times the cost",
                      curve_si(away, "m").words, curve_si(other, "Pa").words,
                      curve_si(fit->modulus.value, "Pa").words, ratio);
            return WT_CURVE_AMBIGUOUS;
        }
    }
    double departure = baseline_departure(f);
    if (departure > baseline_bend * max_force) {
        curve_say(reason, "baseline departs from a line by %s, %.0f %% of %s; %g %% allowed",
                  curve_si(departure, "N").words, 100.0 * departure / max_force,
                  curve_si(max_force, "N").words, 100.0 * baseline_bend);
        return WT_CURVE_DRIFT;
    }
    if (!s->converged || isnan(s->standard_error[CURVE_E])) {
        curve_say(reason, "the least-squares fit found no minimum within its iterations");
        return WT_CURVE_POOR_FIT;
    }
    if (!(s->r_squared >= f->options->minimum_r_squared)) {
        curve_say(reason, "R^2 of the contact part %.3f is below %g", s->r_squared,
                  f->options->minimum_r_squared);
        return WT_CURVE_POOR_FIT;
    }
    curve_say(reason, "accepted");
    return WT_CURVE_ACCEPTED;
}

/* Appends what is odd about an accepted curve. */
static void add_notes(const fitting *f, char reason[160])
{
    char text[96];
    if (f->n_snap > 0) {
        snprintf(text, sizeof text, "; snap-on of %s left out (%zu samples)",
                 curve_si(f->adhesion, "N").words, f->n_snap);
        strncat(reason, text, 159 - strlen(reason));
    }
    if (f->input.n_missing > 0) {
        snprintf(text, sizeof text, "; %zu missing samples", f->input.n_missing);
        strncat(reason, text, 159 - strlen(reason));
    }
    if (f->input.n_repeated > 0) {
        snprintf(text, sizeof text, "; %zu repeated samples", f->input.n_repeated);
        strncat(reason, text, 159 - strlen(reason));
    }
    if (!f->depth_settled)
        strncat(reason, "; the limit of depth did not settle", 159 - strlen(reason));
}

/* ---- rates ----------------------------------------------------------------------------------- */

static void find_rates(const fitting *f, const double *height, const double *force,
                       const double *time, size_t n, wt_indent_fit *fit)
{
    const double c = fit->contact_point.value;
    fit->contact_index = n;
    size_t first = n, last = n;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(height[i]) || !isfinite(force[i]))
            continue;
        if (first == n)
            first = i;
        last = i;
        if (fit->contact_index == n && f->input.direction * height[i] >= c)
            fit->contact_index = i;
    }
    size_t i = fit->contact_index;
    if (time == NULL || last <= first || i > last)
        return;
    double duration = time[last] - time[first];
    if (duration > 0.0)
        fit->piezo_rate = fabs(height[last] - height[first]) / duration;
    double start = time[i];
    if (i > first && isfinite(height[i - 1])) { /* between the two samples around contact */
        double before = f->input.direction * height[i - 1], at = f->input.direction * height[i];
        if (at > before && c > before)
            start -= (at - c) / (at - before) * (time[i] - time[i - 1]);
    }
    if (time[last] > start) {
        fit->load_time = time[last] - start;
        fit->indentation_rate = fit->max_indentation / fit->load_time;
    }
}

void curve_fit_empty(wt_indent_fit *fit)
{
    const double nan_ = (double)NAN;
    *fit = (wt_indent_fit){.modulus = {nan_, nan_, 0.0, "Pa"},
                           .contact_point = {nan_, nan_, 0.0, "m"},
                           .baseline_offset = {nan_, nan_, 0.0, "N"},
                           .baseline_tilt = {nan_, nan_, 0.0, "N/m"},
                           .noise = nan_,
                           .correlation_length = nan_,
                           .r_squared = nan_,
                           .max_force = nan_,
                           .max_indentation = nan_,
                           .adhesion_force = nan_,
                           .piezo_rate = nan_,
                           .indentation_rate = nan_,
                           .load_time = nan_,
                           .second_minimum_ratio = nan_,
                           .second_contact_point = nan_,
                           .sensitivity_gain = nan_,
                           .direction = nan_};
}

static void report(fitting *f, wt_indent_fit *fit)
{
    const curve_solution *s = &f->solution;
    const curve_samples *samples = &f->input.samples;
    double reduced = 1.0 - f->options->poisson_ratio * f->options->poisson_ratio;
    fit->modulus.value = reduced * s->p[CURVE_E];
    fit->modulus.standard_error = reduced * s->standard_error[CURVE_E];
    fit->contact_point.value = s->p[CURVE_C] + f->input.position_origin;
    fit->contact_point.standard_error = s->standard_error[CURVE_C];
    fit->baseline_offset.value = s->p[CURVE_F0] + f->input.force_origin;
    fit->baseline_offset.standard_error = s->standard_error[CURVE_F0];
    fit->baseline_tilt.value = s->p[CURVE_T];
    fit->baseline_tilt.standard_error = s->standard_error[CURVE_T];
    fit->noise = s->noise;
    fit->correlation_length = s->correlation_length;
    fit->r_squared = s->r_squared;
    fit->max_indentation = s->max_indentation;
    fit->adhesion_force = f->adhesion;
    fit->sensitivity_gain = s->sensitivity_gain;
    fit->n_fitted = samples->n;
    fit->max_force = 0.0;
    for (size_t i = 0; i < f->input.n_all - f->n_snap; i++)
        fit->max_force =
            fmax(fit->max_force, samples->force[i] - baseline_at(s, samples->position[i]));
    if (f->n_minima > 1) {
        fit->second_minimum_ratio = f->minima[1].cost / f->minima[0].cost;
        fit->second_contact_point = f->minima[1].contact_point + f->input.position_origin;
    }
}

static wt_status check_arguments(const wt_indent_options *options, size_t n, double spring_constant,
                                 wt_error *err)
{
    if (n == 0)
        return wt_fail(err, WT_E_ARG, "a force curve without samples");
    if (!(spring_constant > 0.0) || !isfinite(spring_constant)) {
        wt_status status = wt_fail(err, WT_E_ARG, "spring constant is not usable");
        wt_error_expected(err, "a value above 0 N/m");
        wt_error_found(err, "%g N/m", spring_constant);
        return status;
    }
    return param_check(wt_indent_params(), options, err);
}

wt_status wt_indent_fit_curve(const wt_contact_table *table, const wt_indent_options *options,
                              const double *height, const double *force, const double *time,
                              size_t n, double spring_constant, wt_indent_workspace *workspace,
                              wt_indent_fit *fit, wt_error *err)
{
    const wt_indent_options defaults = wt_indent_defaults();
    if (options == NULL)
        options = &defaults;
    wt_status status = check_arguments(options, n, spring_constant, err);
    if (status == WT_OK)
        status = curve_reserve(workspace, n, err);
    if (status != WT_OK)
        return status;

    fitting f = {.table = table, .options = options, .workspace = workspace, .depth_settled = true};
    curve_fit_empty(fit);
    fit->verdict = curve_prepare(height, force, n, spring_constant, options->fit_force_fraction,
                                 workspace, &f.input, fit->reason);
    if (fit->verdict != WT_CURVE_ACCEPTED)
        return WT_OK;
    fit->direction = f.input.direction;
    if (leaves_the_sample(&f, fit->reason)) {
        fit->verdict = WT_CURVE_NO_APPROACH;
        return WT_OK;
    }
    bool found = scan_and_refine(&f);
    if (found && remove_snap_on(&f))
        found = scan_and_refine(&f);
    if (found && options->fit_depth > 0.0)
        found = fit_to_depth(&f);
    if (!found) {
        fit->verdict = no_contact_verdict(&f, fit->reason);
        return WT_OK;
    }
    report(&f, fit);
    find_rates(&f, height, force, time, n, fit);
    fit->verdict = judge(&f, fit->max_force, fit);
    if (fit->verdict == WT_CURVE_ACCEPTED)
        add_notes(&f, fit->reason);
    else
        fit->modulus.value = fit->modulus.standard_error = (double)NAN;
    return WT_OK;
}
