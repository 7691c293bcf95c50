/* The fit of one force curve: scan, refinement, and the verdict with its reason.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/base/memory.h"
#include "core/base/param.h"
#include "core/math/special.h"
#include "dma/law/material.h"
#include "indentation/law/adhesion.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve_fitting.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_indent_options wt_indent_defaults(void)
{
    return (wt_indent_options){.poisson_ratio = 0.5,
                               .fit_depth = 0.0,
                               .fit_force_fraction = 1.0,
                               .fit_tilt = true,
                               .misfit_p_threshold = 0.01,
                               .largest_error = 1.0,
                               .doubtful_error = 0.2,
                               .plain_least_squares = false,
                               .fixed_contact_point = (double)NAN,
                               .baseline_from = (double)NAN,
                               .baseline_to = (double)NAN};
}

static const wt_param rows[] = {
    POISSON_RATIO(wt_indent_options),
    {PARAM("fit-depth", wt_indent_options, fit_depth, WT_Q_LENGTH, AT_LEAST(0)), .value = "D",
     .help = SUCH_AS("fit indentations up to this depth, ", "50nm", "; 0 is all")},
    {PARAM("fit-force-fraction", wt_indent_options, fit_force_fraction, WT_Q_NONE, ABOVE_TO(0, 1)),
     .value = "X", .help = "fit forces up to this share of the largest"},
    {PARAM("fit-radii", wt_indent_options, fit_radii, WT_Q_NONE, AT_LEAST(0)), .value = "X",
     .help = "fit indentations up to so many radii of the tip; 0 is all"},
    {PARAM("fit-force", wt_indent_options, fit_force, WT_Q_FORCE, AT_LEAST(0)), .value = "F",
     .help = SUCH_AS("fit forces up to this above the baseline, ", "10nN", "; 0 is all")},
    {PARAM("fit-depth-from", wt_indent_options, fit_depth_from, WT_Q_LENGTH, AT_LEAST(0)),
     .value = "D", .help = "of the contact fit indentations from this on; the baseline stays"},
    {PARAM("fit-force-from", wt_indent_options, fit_force_from, WT_Q_FORCE, AT_LEAST(0)),
     .value = "F", .help = "of the contact fit forces from this on; the baseline stays"},
    {PARAM("fit-force-fraction-from", wt_indent_options, fit_force_fraction_from, WT_Q_NONE,
           FROM_BELOW(0, 1)),
     .value = "X",
     .help = "of the contact fit forces from this share of the largest on; the baseline stays"},
    {PARAM("misfit-p-threshold", wt_indent_options, misfit_p_threshold, WT_Q_NONE,
           FROM_BELOW(0, 1)),
     .former = "least-chance", .value = "P",
     .help = "residuals that noise makes with a smaller chance are called a misfit; larger calls "
             "more curves so, moduli stay; 0: no misfit is looked for, errors are those of noise "
             "alone"},
    {PARAM("warn-relative-error", wt_indent_options, doubtful_error, WT_Q_NONE, ABOVE(0)),
     .former = "doubtful-error", .value = "X",
     .help =
         "mark a modulus with a larger standard error, as a share of it, as wide; it stays in all "
         "means; larger marks fewer"},
    {PARAM("max-relative-error", wt_indent_options, largest_error, WT_Q_NONE, ABOVE(0)),
     .former = "largest-error", .value = "X",
     .help = "leave a modulus with a larger standard error, as a share of it, out of all means; at "
             "0.5 its 95 % interval reaches twice the modulus; smaller keeps fewer, surer curves"},
    {PARAM("fixed-contact-point", wt_indent_options, fixed_contact_point, WT_Q_LENGTH, ANY_NUMBER),
     .value = "Z", .unset = "", .flags = PARAM_NO_CASE,
     .help = "do not fit the contact point: take this tip position"},
    {PARAM("baseline-from", wt_indent_options, baseline_from, WT_Q_LENGTH, ANY_NUMBER),
     .value = "Z", .unset = "", .flags = PARAM_NO_CASE,
     .help = "of the samples before contact fit those from this tip position on"},
    {PARAM("baseline-to", wt_indent_options, baseline_to, WT_Q_LENGTH, ANY_NUMBER), .value = "Z",
     .unset = "", .flags = PARAM_NO_CASE,
     .help = "of the samples before contact fit those up to this tip position; the contact point "
             "may be later"},
    {PARAM_FLAG_OF("fit-retract", wt_indent_options, fit_retract),
     .help = "also fit an elastic contact to the retract alone, with its own modulus and adhesion: "
             "a check, which changes no other number"},
    {PARAM_FLAG_OF("fit-tilt", wt_indent_options, fit_tilt),
     .help = "tilt of the baseline, which without it has an offset only"},
};
PARAM_TABLE(wt_indent_params, wt_indent_options, rows, wt_indent_defaults, NO_PARTS)

wt_indent_workspace *wt_indent_workspace_new(void)
{
    gsl_quiet();
    wt_indent_workspace *workspace = wt_alloc(1, sizeof *workspace);
    workspace->minimizer = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (workspace->minimizer == NULL)
        out_of_memory(sizeof *workspace->minimizer);
    return workspace;
}

void wt_indent_workspace_free(wt_indent_workspace *workspace)
{
    if (workspace == NULL)
        return;
    gsl_min_fminimizer_free(workspace->minimizer);
    hereditary_clear(&workspace->memory);
    free(workspace->block);
    free(workspace);
}

/* ---- rates ----------------------------------------------------------------------------------- */

static bool is_finite_sample(const curve_branch *b, size_t i)
{
    return isfinite(b->height[i]) && isfinite(b->force[i]);
}

static void compute_rates(const curve_fitting *f, const curve_branch *approach, wt_indent_fit *fit)
{
    const double *height = approach->height, *time = approach->time;
    const size_t n = approach->n;
    const curve_samples *fitted = &f->input.samples;
    const double c = fit->contact_point.value,
                 end = fitted->position[fitted->n - 1] + f->input.position_origin;
    const double direction = f->input.direction;
    size_t first = 0, last = n, last_fitted = n, contact = 0;
    while (first < n && !is_finite_sample(approach, first))
        first++;
    while (last > first && !is_finite_sample(approach, last - 1))
        last--;
    while (last_fitted > 0 && !(direction * height[last_fitted - 1] <= end &&
                                is_finite_sample(approach, last_fitted - 1)))
        last_fitted--;
    while (contact < n &&
           !(direction * height[contact] >= c && is_finite_sample(approach, contact)))
        contact++;
    last = last > first ? last - 1 : n;
    last_fitted = last_fitted > 0 ? last_fitted - 1 : n;
    fit->contact_index = contact;
    size_t i = fit->contact_index;
    if (time == NULL || last <= first || i > last)
        return;
    double duration = time[last] - time[first];
    if (duration > 0.0)
        fit->piezo_rate = fabs(height[last] - height[first]) / duration;
    double start = time[i];
    if (i > first && isfinite(height[i - 1])) { /* contact lies between two samples */
        double before = f->input.direction * height[i - 1], at = f->input.direction * height[i];
        if (at > before && c > before)
            start -= (at - c) / (at - before) * (time[i] - time[i - 1]);
    }
    if (fitted->n < f->input.n_all - f->n_snap && last_fitted < n)
        last = last_fitted;
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
                           .lack_of_fit = nan_,
                           .lack_of_fit_p = nan_,
                           .baseline_p = nan_,
                           .curvature_shift = nan_,
                           .max_force = nan_,
                           .max_indentation = nan_,
                           .adhesion_force = nan_,
                           .work_of_adhesion = {nan_, nan_, 0.0, "J/m^2"},
                           .pull_off_force = nan_,
                           .pull_off_work = nan_,
                           .contact_pull = {nan_, nan_, 0.0, "N"},
                           .tabor_number = nan_,
                           .loss = nan_,
                           .loss_bias = nan_,
                           .loss_power = nan_,
                           .loss_shift = nan_,
                           .loss_error = nan_,
                           .baseline_curvature = nan_,
                           .piezo_rate = nan_,
                           .indentation_rate = nan_,
                           .load_time = nan_,
                           .second_minimum_ratio = nan_,
                           .second_contact_point = nan_,
                           .sensitivity_gain = nan_,
                           .misfit_error = nan_,
                           .contact_misfit_error = nan_,
                           .baseline_length = nan_,
                           .misfit_length = nan_,
                           .spectrum_factor = {nan_, nan_, 0.0, "1"},
                           .fitted_from = nan_,
                           .interference_amplitude = nan_,
                           .interference_period = nan_,
                           .retract_modulus = {nan_, nan_, 0.0, "Pa"},
                           .retract_work = {nan_, nan_, 0.0, "J/m^2"},
                           .retract_pull = {nan_, nan_, 0.0, "N"},
                           .direction = nan_};
    for (int j = 0; j < CURVE_WAVES; j++)
        fit->misfit[j] = nan_;
    for (int j = 0; j < WT_FIT_RANGES; j++)
        fit->range_shift[j] = fit->range_error[j] = nan_;
}

static void report_adhesion(const curve_fitting *f, wt_indent_fit *fit)
{
    const curve_solution *s = &f->solution;
    const double root = s->p[CURVE_W], k = f->input.samples.spring_constant;
    adhesion law = {f->table, s->p[CURVE_E], 0.0};
    fit->adhesion_force = f->snap_in_pull;
    fit->pull_off_force = f->pull_off;
    if (f->pull_off >= 0.0 && !(f->pull_off > 0.0 && curve_is_thin(f)))
        fit->pull_off_work =
            f->pull_off > 0.0 ? adhesion_work(f->table, law.reduced, k, f->pull_off) : 0.0;
    const bool long_range = f->kind.adhesive && f->kind.constant_pull;
    if (long_range) {
        fit->contact_pull.value = root;
        fit->contact_pull.standard_error = s->standard_error[CURVE_W];
    } else if (f->kind.adhesive) {
        fit->work_of_adhesion.value = root * root;
        fit->work_of_adhesion.standard_error = 2.0 * root * s->standard_error[CURVE_W];
    }
    law.work = fmax(f->kind.adhesive && !long_range ? root * root : 0.0,
                    f->pull_off > 0.0 ? fit->pull_off_work : 0.0);
    if (law.work > 0.0)
        fit->tabor_number = adhesion_tabor(&law);
}

/* Computes the factor on the spectrum, and the modulus at the loading time of the curve. */
static void report_spectrum(const curve_fitting *f, wt_indent_fit *fit)
{
    const wt_prony *spectrum = f->options->spectrum;
    /* A power-law relaxation replaces the spectrum if that does not converge, and has another unit.
     */
    const bool memory = f->kind.memory && !f->kind.adhesive && !(f->loss_power > 0.0);
    if (spectrum == NULL || !(fit->load_time > 0.0) || (f->spectrum_mismatch && !f->kind.adhesive))
        return;
    const double loading_modulus = hereditary_modulus(spectrum, 1.0 / fit->load_time);
    const double unit = memory ? f->unit : loading_modulus;
    fit->spectrum_factor.value = fit->modulus.value / unit;
    fit->spectrum_factor.standard_error = fit->modulus.standard_error / unit;
    fit->modulus.value *= loading_modulus / unit;
    fit->modulus.standard_error *= loading_modulus / unit;
    fit->misfit_error *= loading_modulus / unit;
}

/* Adds the error of a snap-in that was left out of a fit without adhesion. */
static void add_left_out_pull(const curve_fitting *f, wt_indent_fit *fit)
{
    const double error = curve_left_out_error(fit) * fit->modulus.value;
    if (f->options->plain_least_squares)
        return;
    fit->misfit_error = hypot(fit->misfit_error, error); /* NaN stays unknown */
    fit->modulus.standard_error = hypot(fit->modulus.standard_error, error);
}

/* Cost at the second minimum over that of the fit. The scan gives the difference of both. */
static double second_cost_ratio(const curve_fitting *f)
{
    return 1.0 + (f->minima[1].cost - f->minima[0].cost) / f->solution.cost;
}

static void report_fit(curve_fitting *f, wt_indent_fit *fit)
{
    const curve_solution *s = &f->solution;
    const curve_samples *samples = &f->input.samples;
    double reduced = 1.0 - f->options->poisson_ratio * f->options->poisson_ratio;
    const double e = reduced * s->p[CURVE_E] * (1.0 + f->loss_shift);
    fit->modulus.value = e;
    const double error = hypot(s->standard_error[CURVE_E] / s->p[CURVE_E], f->loss_error);
    fit->modulus.standard_error = e * hypot(error, hypot(f->contact_error, f->law_error));
    fit->contact_point.value = s->p[CURVE_C] + f->input.position_origin;
    fit->contact_point.standard_error = s->standard_error[CURVE_C];
    fit->misfit_error = e * s->misfit_error[CURVE_E] / s->p[CURVE_E];
    fit->contact_misfit_error = s->misfit_error[CURVE_C];
    fit->baseline_offset.value = s->p[CURVE_F0] + f->input.force_origin;
    fit->baseline_offset.standard_error = s->standard_error[CURVE_F0];
    fit->baseline_tilt.value = s->p[CURVE_T];
    fit->baseline_tilt.standard_error = s->standard_error[CURVE_T];
    fit->baseline_length = s->p[CURVE_C] - samples->position[0];
    fit->misfit_length = s->lack.window;
    fit->noise = s->noise;
    fit->correlation_length = s->correlation_length;
    fit->loss = f->loss > 1.0 ? 1.0 : f->loss;
    fit->loss_bias = f->loss_bias;
    fit->loss_power = f->loss_power;
    fit->loss_shift = f->loss_shift;
    fit->loss_error = f->loss_error;
    fit->baseline_curvature = s->curvature;
    fit->lack_of_fit = s->lack.statistic;
    fit->lack_of_fit_p = s->lack.chance;
    fit->baseline_p = s->lack.baseline_p;
    fit->curvature_shift = reduced * s->bend_shift;
    fit->max_indentation = s->max_indentation;
    fit->sensitivity_gain = s->sensitivity_gain;
    fit->n_fitted = samples->n - (samples->gap_to - samples->gap_from);
    fit->fitted_from = samples->gap_to > samples->gap_from && samples->gap_to < samples->n
                           ? fmax(0.0, f->workspace->delta[samples->gap_to])
                           : 0.0;
    const size_t n = f->input.n_all - f->n_snap;
    double *above = f->workspace->scratch;
    for (size_t i = 0; i < n; i++)
        above[i] = samples->force[i] - curve_baseline(s, samples->position[i]);
    fit->max_force = fmax(curve_find_span(above, n).high, 0.0);
    for (int j = 0; j < CURVE_WAVES; j++)
        fit->misfit[j] = s->lack.wave[j] / fit->max_force;
    memcpy(fit->range_shift, s->range_shift, sizeof fit->range_shift);
    memcpy(fit->range_error, s->range_error, sizeof fit->range_error);
    if (curve_has_wave(&s->wave)) {
        fit->interference_amplitude = curve_wave_amplitude(&s->wave);
        fit->interference_period = 2.0 * M_PI / s->wave.p[WAVE_NUMBER];
    } else {
        fit->interference_amplitude = 0.0;
    }
    report_adhesion(f, fit);
    add_left_out_pull(f, fit);
    if (f->n_minima > 1) {
        fit->second_minimum_ratio = second_cost_ratio(f);
        fit->second_contact_point = f->minima[1].contact_point + f->input.position_origin;
    }
}

/* 2 ln(likelihood ratio) of a 95 % interval for one parameter. */
static const double interval_chi2 = 3.84;

/* Adds the error due to a second contact point of similar likelihood. The result keeps the modulus
 * of the better one. */
static void add_second_contact(curve_fitting *f)
{
    if (f->n_minima < 2 || f->kind.adhesive)
        return;
    const double chi2 = f->solution.effective_n * log(second_cost_ratio(f));
    if (chi2 < interval_chi2)
        f->contact_error = curve_alternative_error(
            -fmax(chi2, 0.0), f->minima[1].reduced_modulus / f->minima[0].reduced_modulus - 1.0);
}

static wt_status check_fit_arguments(const wt_indent_options *options, const wt_tip *tip, size_t n,
                                     double spring_constant, wt_error *err)
{
    if (n == 0)
        return wt_fail(err, WT_E_ARG, "a force curve without samples");
    if (!(spring_constant > 0.0) || !isfinite(spring_constant)) {
        wt_status status = wt_fail(err, WT_E_ARG, "spring constant is not usable");
        wt_error_expected(err, "a value above 0 N/m");
        wt_error_found(err, "%g N/m", spring_constant);
        return status;
    }
    const wt_status status = param_check(wt_indent_params(), options, err);
    return status == WT_OK ? curve_range_check(options, tip, err) : status;
}

static void fit_samples(const curve_fitting *of, const curve_branch *retract,
                        double spring_constant, curve_fitting *f, wt_indent_fit *fit)
{
    const curve_branch *approach = of->approach;
    *f = *of;
    curve_fit_empty(fit);
    fit->verdict = curve_prepare(approach->height, approach->force, approach->n, spring_constant,
                                 f->options, f->contact, f->workspace, &f->input, fit->reason);
    f->input.saturated = f->input.saturated || f->below_saturation;
    if (fit->verdict != WT_CURVE_ACCEPTED)
        return;
    fit->direction = f->input.direction;
    if (curve_is_retract(f, fit->reason)) {
        fit->verdict = WT_CURVE_NO_APPROACH;
        return;
    }
    bool found = curve_scan_and_refine(f) && curve_fit_interference(f);
    if (found && curve_find_snap_in(f, &f->snap))
        f->snap_in_pull = f->snap.pull;
    if (found && retract->n > 0)
        curve_read_retract(f, retract->height, retract->force, retract->n);
    if (found)
        found = curve_fit_adhesion(f);
    if (found)
        found = curve_fit_range(f);
    if (!found) {
        fit->verdict = curve_no_contact_verdict(f, fit->reason);
        return;
    }
    curve_fit_loss(f);
    curve_add_misfit(f);
    add_second_contact(f);
    report_fit(f, fit);
    compute_rates(f, approach, fit);
    report_spectrum(f, fit);
    fit->verdict = curve_assess(f, fit);
    if (f->options->fit_retract)
        curve_report_unloading(f, fit);
}

/* Samples between the chosen end of the baseline and contact are left out once a first fit has
 * found the contact point, which is fitted again. */
static void fit_once(const curve_fitting *of, const curve_branch *retract, double spring_constant,
                     curve_fitting *f, wt_indent_fit *fit)
{
    fit_samples(of, retract, spring_constant, f, fit);
    if (!(of->options->baseline_to < fit->contact_point.value))
        return;
    curve_fitting again = *of;
    again.contact = fit->contact_point.value;
    fit_samples(&again, retract, spring_constant, f, fit);
}

/* Fits the forces up to a limit, as the option fit-force does. */
static void fit_below_limit(const curve_fitting *of, const curve_branch *retract,
                            double spring_constant, double limit, curve_fitting *f,
                            wt_indent_fit *fit)
{
    wt_indent_options options = *of->options;
    curve_fitting below = *of;
    options.fit_force = limit;
    below.options = &options;
    below.below_saturation = true;
    fit_once(&below, retract, spring_constant, f, fit);
    f->options = of->options;
}

/* Each limit is at most three quarters of the previous one, down to a third of the force. */
enum { LIMIT_ROUNDS = 4 };

/* Fits a saturated curve below the force in its verdict, and repeats this if the result is still
 * saturated. The curve stays rejected if the lower part has no modulus. */
static void fit_below_saturation(const curve_fitting *of, const curve_branch *retract,
                                 double spring_constant, curve_fitting *f, wt_indent_fit *fit)
{
    const wt_indent_options *o = of->options;
    wt_indent_fit below = *fit;
    curve_fitting rest = *f;
    double limit = 0.0;
    for (int round = 0; round < LIMIT_ROUNDS && below.verdict == WT_CURVE_SATURATED; round++) {
        const double next = curve_linear_limit(&rest);
        if (!(next > o->fit_force_from) || (limit > 0.0 && !(next < limit)))
            break;
        limit = next;
        fit_below_limit(of, retract, spring_constant, limit, &rest, &below);
    }
    if (wt_curve_verdict_is_usable(below.verdict)) {
        *f = rest;
        *fit = below;
    } else if (limit > 0.0) {
        curve_append_limit_verdict(limit, below.verdict, fit->reason);
    }
}

wt_status curve_fit_branches(const wt_contact_table *table, const wt_indent_options *options,
                             const curve_branch *approach, const curve_branch *retract,
                             bool without_adhesion, double spring_constant,
                             wt_indent_workspace *workspace, wt_indent_fit *fit, wt_error *err)
{
    const wt_indent_options defaults = wt_indent_defaults();
    const size_t n = approach->n;
    if (options == NULL)
        options = &defaults;
    const wt_status status =
        check_fit_arguments(options, contact_table_tip(table), n, spring_constant, err);
    if (status != WT_OK)
        return status;
    curve_reserve(workspace, retract->n > n ? retract->n : n);
    const size_t terms = options->spectrum != NULL ? options->spectrum->n : 0;
    hereditary_reserve(&workspace->memory, terms > CURVE_POWER_TERMS ? terms : CURVE_POWER_TERMS);

    const curve_fitting initial = {.table = table,
                                   .options = options,
                                   .approach = approach,
                                   .workspace = workspace,
                                   .contact = (double)NAN,
                                   .pull_off = (double)NAN,
                                   .loss = (double)NAN,
                                   .loss_bias = (double)NAN,
                                   .loss_power = (double)NAN,
                                   .range_converged = true,
                                   .without_adhesion = without_adhesion};
    curve_fitting f;
    fit_once(&initial, retract, spring_constant, &f, fit);
    if (fit->verdict == WT_CURVE_SATURATED)
        fit_below_saturation(&initial, retract, spring_constant, &f, fit);
    if (wt_curve_verdict_is_usable(fit->verdict)) {
        workspace->step_allowed = fmax(workspace->step_allowed, f.solution.step_allowed);
        workspace->step_left = fmax(workspace->step_left, f.solution.step_left);
    }
    return WT_OK;
}

wt_status wt_indent_fit_curve(const wt_contact_table *table, const wt_indent_options *options,
                              const double *height, const double *force, const double *time,
                              size_t n, double spring_constant, wt_indent_workspace *workspace,
                              wt_indent_fit *fit, wt_error *err)
{
    const curve_branch approach = {height, force, time, n}, none = {NULL, NULL, NULL, 0};
    return curve_fit_branches(table, options, &approach, &none, false, spring_constant, workspace,
                              fit, err);
}
