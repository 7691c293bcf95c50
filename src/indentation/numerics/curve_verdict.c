/* Verdict on one force curve and its reason.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/numerics/curve_fitting.h"

#include "core/base/number.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "indentation/law/tip.h"

#include <math.h>
#include <string.h>

/* Limits of plausibility; each verdict states the value and the limit. */
/* Smallest force in contact over the noise of the baseline. The largest of 2,000 samples is 3.5. */
static const double contact_noise = 5.0;
/* Largest departure from a line over the largest force. In contact it would cause an error of the
 * modulus of at least that size. */
static const double baseline_bend = 0.1;
/* Largest change of the modulus in per cent per per cent of sensitivity. Sensitivities have errors
 * of 1 % at best, and the modulus then has largest_error. */
static const double max_gain = 50.0;
static const double max_reported_gain =
    1000.0;                              /* largest reported value; a larger one has no meaning */
static const double reverse_ratio = 0.5; /* cost of the reversed fit; near ties do not count */
enum { BEND_BLOCKS = 16 };
static const double min_reported_bias = 0.005; /* smallest reported bias of the modulus by loss */
/* Largest tested loss over the work, at a tan delta of 1. Elastic fits of rubber with broad spectra
 * differed by up to 12 % for a pyramid and 17 % for a cone. */
static const double max_tested_loss = 0.85;
/* Significance level of flattening by noise; a map of a thousand curves has one. */
static const double flat_chance = 0.001;
static const double max_flat_loss = 0.5; /* largest loss; more loss flattens the force too */
static const double plateau_share = 0.9; /* share of the plateau force that is clear of its noise */
static const double min_reported_error =
    0.2; /* smallest reported error of the modulus; only its order of magnitude is known */

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

bool wt_curve_verdict_is_usable(wt_curve_verdict verdict)
{
    return verdict == WT_CURVE_ACCEPTED || verdict == WT_CURVE_WIDE || verdict == WT_CURVE_DOUBTFUL;
}

/* Peak-to-peak departure of the baseline residual from a line: that of a sine with the variance of
 * the block means in excess of white noise. */
static double baseline_departure(const curve_fitting *f)
{
    const curve_samples *s = &f->input.samples;
    size_t length = f->solution.first_contact / BEND_BLOCKS;
    if (length == 0)
        return 0.0;
    double square = 0.0;
    for (size_t block = 0; block < BEND_BLOCKS; block++) {
        double sum = 0.0;
        for (size_t i = block * length; i < (block + 1) * length; i++)
            sum += s->force[i] - curve_baseline(&f->solution, s->position[i]);
        square += sum / (double)length * (sum / (double)length) / BEND_BLOCKS;
    }
    square -= f->input.step_noise * f->input.step_noise / (double)length;
    return square > 0.0 ? 2.0 * M_SQRT2 * sqrt(square) : 0.0;
}

/* Smallest pull over the largest force that changes a fit without it. */
static const double small_pull = 0.1;

double curve_left_out_pull(const wt_indent_fit *fit)
{
    const bool is_described =
        !isnan(fit->work_of_adhesion.value) || !isnan(fit->contact_pull.value);
    const double pull = fmax(fit->adhesion_force, fit->pull_off_force); /* fmax ignores NaN */
    return fit->adhesion_force > 0.0 && !is_described && pull > small_pull * fit->max_force ? pull
                                                                                            : 0.0;
}

double curve_left_out_error(const wt_indent_fit *fit)
{
    const double pull = curve_left_out_pull(fit);
    return pull > 0.0 ? pull / fit->max_force / NORMAL_95 : 0.0;
}

/* ---- verdict --------------------------------------------------------------------------------- */

/* Decrease of the mean force from the first tenth of the samples to the last. */
WIDE_REGISTERS static double force_fall(const curve_samples *s)
{
    const size_t tenth = s->n / 10;
    return (curve_sum(s->force, tenth) - curve_sum(s->force + s->n - tenth, tenth)) / (double)tenth;
}

wt_curve_verdict curve_no_contact_verdict(curve_fitting *f, char reason[160])
{
    const double fall = force_fall(&f->input.samples);
    const si_text change = curve_format_si(fabs(fall), "N"),
                  noise = curve_format_si(f->input.step_noise, "N");
    if (fall > contact_noise * f->input.step_noise) {
        curve_set_reason(
            reason, "the force falls by %s towards the sample (noise %s): sign of the deflection?",
            change.buffer, noise.buffer);
        return WT_CURVE_NEGATIVE;
    }
    curve_set_reason(reason, "the force changes by %s from start to end (noise %s)", change.buffer,
                     noise.buffer);
    return WT_CURVE_NO_CONTACT;
}

bool curve_is_retract(curve_fitting *f, char reason[160])
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
        curve_set_reason(reason, "the force falls by %s along the segment: it leaves the sample",
                         curve_format_si(fall, "N").buffer);
        return true;
    }
    curve_reverse(s);
    return false;
}

/* Tests the contact point. Returns accepted if there is no objection. */
static wt_curve_verdict contact_verdict(const curve_fitting *f, const wt_indent_fit *fit,
                                        char reason[160])
{
    const curve_solution *s = &f->solution;
    const curve_samples *samples = &f->input.samples;
    const double length = s->p[CURVE_C] - samples->position[0];
    if (length <= 0.0) {
        curve_set_reason(reason, "contact is found %s before the first sample",
                         curve_format_si(-length, "m").buffer);
        return WT_CURVE_NO_BASELINE;
    }
    if (!(fit->max_force > contact_noise * s->noise)) {
        curve_set_reason(reason, "largest force %s is %.1f times the noise of %s, %g needed",
                         curve_format_si(fit->max_force, "N").buffer, fit->max_force / s->noise,
                         curve_format_si(s->noise, "N").buffer, contact_noise);
        return WT_CURVE_NO_CONTACT;
    }
    if (s->first_contact < CURVE_BASELINE_SAMPLES) {
        curve_set_reason(reason, "baseline of %zu samples, %d needed", s->first_contact,
                         CURVE_BASELINE_SAMPLES);
        return WT_CURVE_NO_BASELINE;
    }
    if (f->range_empty || curve_count_in_range(f) < CURVE_CONTACT_SAMPLES) {
        curve_set_reason(reason, "%zu samples in contact%s, %d needed", curve_count_in_range(f),
                         f->range_empty || samples->gap_to > samples->gap_from ||
                                 samples->n < f->input.n_all - f->n_snap
                             ? " in the range of the fit"
                             : "",
                         CURVE_CONTACT_SAMPLES);
        return WT_CURVE_TOO_SHORT;
    }
    if (s->sensitivity_gain > max_gain) {
        curve_set_reason(
            reason,
            "1 %% of deflection sensitivity would change the modulus by %s%.0f %%, %g %% allowed",
            s->sensitivity_gain > max_reported_gain ? "more than " : "",
            fmin(s->sensitivity_gain, max_reported_gain), max_gain);
        return WT_CURVE_RIGID;
    }
    return WT_CURVE_ACCEPTED;
}

bool curve_passes_misfit_test(const curve_fitting *f)
{
    return !(f->solution.lack.chance < f->options->misfit_p_threshold);
}

bool curve_has_unknown_loss(const curve_fitting *f)
{
    return contact_table_tip(f->table)->shape == WT_TIP_PUNCH && f->loss > CURVE_MIN_LOSS &&
           !f->kind.memory;
}

/* True if the force flattens. A punch is exempt, because its force need not steepen. */
static bool force_flattens(const curve_fitting *f)
{
    return f->solution.lack.flat_chance < flat_chance && !(f->loss > max_flat_loss) &&
           contact_table_tip(f->table)->shape != WT_TIP_PUNCH;
}

/* True if the depth exceeds the range of the contact law. */
static bool exceeds_contact_law(const curve_fitting *f, char reason[160])
{
    const double depth = f->solution.max_indentation;
    const wt_tip *tip = contact_table_tip(f->table);
    const double reach = thin_sample_radius_ratio(tip, depth);
    if (!contact_law_is_valid(tip, depth) && !(reach > THIN_SAMPLE_MAX_RATIO)) {
        curve_set_reason(reason, "%s deep, %.1f radii of the tip; the contact law holds to %g",
                         curve_format_si(depth, "m").buffer, depth / tip->radius,
                         ROUND_TIP_MAX_DEPTH_RATIO);
        return true;
    }
    if (reach > THIN_SAMPLE_MAX_RATIO)
        curve_set_reason(reason,
                         "contact radius %.2f of the thickness of the sample; its law holds to %g",
                         reach, THIN_SAMPLE_MAX_RATIO);
    return reach > THIN_SAMPLE_MAX_RATIO;
}

/* Formats "E +- 7 % (6 % from the fit range)" with the standard errors. */
static si_text misfit_text(const wt_indent_fit *fit)
{
    si_text text;
    clocale_print(text.buffer, sizeof text.buffer, "E +- %s (%s from the fit range)",
                  format_percent(fit->modulus.standard_error / fit->modulus.value).text,
                  format_percent(fmax(fit->misfit_error, 0.0) / fit->modulus.value).text);
    return text;
}

/* Returns possible causes of a misfit. */
static const char *misfit_cause(const curve_fitting *f)
{
    if (f->snap_in_pull > 0.0 || f->pull_off > 0.0)
        return "a pull that the contact law does not describe";
    if (f->solution.bent)
        return "baseline bent: piezo or drift";
    return "another tip, a layer, loss, adhesion, piezo or detector";
}

/* Tests the interval of the modulus and states why it is wide. */
static wt_curve_verdict interval_verdict(const curve_fitting *f, const wt_indent_fit *fit,
                                         char reason[160])
{
    const double e = fit->modulus.value, error = fit->modulus.standard_error / e;
    if (!(error > f->options->largest_error))
        return WT_CURVE_ACCEPTED;
    if (f->contact_error * f->contact_error > 0.5 * error * error) {
        const curve_minimum *first = &f->minima[0], *second = &f->minima[1];
        curve_set_reason(
            reason, "a contact point %s away gives %s instead of %s at %.3f times the cost",
            curve_format_si(fabs(second->contact_point - first->contact_point), "m").buffer,
            curve_format_si(second->reduced_modulus / first->reduced_modulus * e, "Pa").buffer,
            curve_format_si(e, "Pa").buffer, second->cost / first->cost);
        return WT_CURVE_AMBIGUOUS;
    }
    if (fit->misfit_error * fit->misfit_error > 0.5 * error * error * e * e) {
        curve_set_reason(reason, "misfit: %s, %g %% allowed; %s", misfit_text(fit).buffer,
                         100.0 * f->options->largest_error, misfit_cause(f));
        return f->snap_in_pull > 0.0 || f->pull_off > 0.0 ? WT_CURVE_ADHESIVE
               : f->solution.bent                         ? WT_CURVE_DRIFT
                                                          : WT_CURVE_POOR_FIT;
    }
    curve_set_reason(reason, "standard error %.0f %% of the modulus of %s, %g %% allowed%s",
                     100.0 * error, curve_format_si(e, "Pa").buffer,
                     100.0 * f->options->largest_error, f->solution.bent ? "; baseline bent" : "");
    return WT_CURVE_IMPRECISE;
}

/* Tests the modulus and states the objections. */
static wt_curve_verdict law_verdict(curve_fitting *f, const wt_indent_fit *fit, char reason[160])
{
    const curve_solution *s = &f->solution;
    const double departure = baseline_departure(f);
    if (force_flattens(f)) {
        curve_set_reason(
            reason,
            "the force flattens towards its maximum (chance %s by noise): detector, or the "
            "sample yields",
            format_probability(s->lack.flat_chance).text);
        return WT_CURVE_SATURATED;
    }
    if (!s->converged || isnan(s->standard_error[CURVE_E])) {
        curve_set_reason(reason, "the least-squares fit found no minimum within its iterations");
        return WT_CURVE_POOR_FIT;
    }
    const wt_curve_verdict verdict = interval_verdict(f, fit, reason);
    if (verdict != WT_CURVE_ACCEPTED)
        return verdict;
    if (exceeds_contact_law(f, reason))
        return WT_CURVE_DOUBTFUL;
    if (curve_has_unknown_loss(f)) {
        curve_set_reason(reason,
                         "%.0f %% of the work lost; the effect of loss under a punch is known "
                         "with the DMA only",
                         100.0 * f->loss);
        return WT_CURVE_DOUBTFUL;
    }
    const double error = fit->modulus.standard_error / fit->modulus.value;
    if (error > f->options->doubtful_error) {
        const bool by_misfit = fit->misfit_error > 0.5 * fit->modulus.standard_error;
        curve_set_reason(reason, "the 95 %% interval is wide: %s, above %g %%; %s",
                         misfit_text(fit).buffer, 100.0 * f->options->doubtful_error,
                         by_misfit ? misfit_cause(f) : "noise, baseline or loss");
        f->misfit_is_named = true;
        f->bend_is_named = by_misfit && !(f->snap_in_pull > 0.0) && !(f->pull_off > 0.0);
        return WT_CURVE_WIDE;
    }
    if (isnan(fit->misfit_error) && f->options->misfit_p_threshold > 0.0 && !f->kind.plain) {
        curve_set_reason(reason, "the effect of the misfit on the modulus is not known: too "
                                 "few samples in contact for other ranges of the fit");
        f->misfit_is_named = true;
        return WT_CURVE_DOUBTFUL;
    }
    const double left_out = f->kind.plain ? 0.0 : curve_left_out_pull(fit);
    if (left_out > 0.0) {
        curve_set_reason(reason,
                         "adhesion: no law describes the pull of %s, %.0f %% of the "
                         "largest force: %s",
                         curve_format_si(left_out, "N").buffer, 100.0 * left_out / fit->max_force,
                         misfit_text(fit).buffer);
        f->misfit_is_named = true;
        return WT_CURVE_DOUBTFUL;
    }
    const double pull = fmax(f->snap_in_pull, f->pull_off > 0.0 ? f->pull_off : 0.0);
    if (departure > baseline_bend * fit->max_force && pull > 0.0) {
        curve_set_reason(reason, "adhesion: a pull of %s, and %s before contact; %s",
                         curve_format_si(pull, "N").buffer, curve_format_si(departure, "N").buffer,
                         "a longer baseline would separate them");
        return WT_CURVE_DOUBTFUL;
    }
    if (departure > baseline_bend * fit->max_force) {
        curve_set_reason(reason, "baseline departs from a line by %s, %.0f %% of %s",
                         curve_format_si(departure, "N").buffer, 100.0 * departure / fit->max_force,
                         curve_format_si(fit->max_force, "N").buffer);
        return WT_CURVE_DOUBTFUL;
    }
    curve_set_reason(reason, "accepted");
    return WT_CURVE_ACCEPTED;
}

bool curve_append_note(char reason[160], const char *text)
{
    const bool has_room = strlen(reason) + strlen(text) < 160;
    if (has_room)
        strcat(reason, text);
    return has_room;
}

/* Appends remarks on an accepted curve. */
static void append_notes(const curve_fitting *f, const wt_indent_fit *fit, char reason[160])
{
    char text[160];
    if (f->kind.adhesive && f->kind.constant_pull) {
        curve_set_reason(text, "; with a constant pull of %s",
                         curve_format_si(fit->contact_pull.value, "N").buffer);
        curve_append_note(reason, text);
    } else if (f->kind.adhesive) {
        curve_set_reason(text, "; with adhesion of %.3g mJ/m^2", 1e3 * fit->work_of_adhesion.value);
        curve_append_note(reason, text);
    } else if (f->snap_in_pull > 0.0) {
        curve_set_reason(text, "; snap-on of %s left out (%zu samples)",
                         curve_format_si(f->snap_in_pull, "N").buffer, f->n_snap);
        curve_append_note(reason, text);
    }
    if (f->pull_off > 0.0 && isnan(fit->pull_off_work) && !curve_is_thin(f)) {
        curve_set_reason(text,
                         "; a pull-off of %s needs no work of adhesion from 1 nJ/m^2 to 1 kJ/m^2",
                         curve_format_si(f->pull_off, "N").buffer);
        curve_append_note(reason, text);
    }
    if (f->spectrum_mismatch && !f->kind.adhesive)
        curve_append_note(reason, "; not of the spectrum of the DMA");
    if (!curve_passes_misfit_test(f) && !f->misfit_is_named) {
        curve_set_reason(text, "; misfit: %s", misfit_text(fit).buffer);
        curve_append_note(reason, text);
    }
    if (f->unknown_loss && f->kind.memory) {
        curve_append_note(reason, "; the spectrum of the DMA does not describe its loss");
    } else if (fabs(f->loss_bias) >= min_reported_bias) {
        curve_set_reason(
            text, "; %.0f %% of the work lost: with a memory of time^-%.2g, %s %s than without",
            100.0 * fit->loss, f->loss_power, format_percent(fabs(f->loss_bias)).text,
            f->loss_bias > 0.0 ? "less" : "more");
        curve_append_note(reason, text);
    } else if (f->unknown_loss) {
        curve_set_reason(text, "; %.0f %% of the work lost: %s", 100.0 * fit->loss,
                         fit->loss > max_tested_loss ? "how near |E*| is not known"
                                                     : "|E*| at 1/(loading time) within 20 %");
        curve_append_note(reason, text);
    }
    if (fit->interference_amplitude > 0.0) {
        curve_set_reason(text, "; interference of %s and a period of %s fitted",
                         curve_format_si(fit->interference_amplitude, "N").buffer,
                         curve_format_si(fit->interference_period, "m").buffer);
        curve_append_note(reason, text);
    }
    if (f->solution.bent && !f->bend_is_named)
        curve_append_note(reason, "; baseline bent, which is in the error");
    const double error = fit->modulus.standard_error / fit->modulus.value;
    if (error > min_reported_error) {
        curve_set_reason(text, "; standard error %.0f %%", 100.0 * error);
        curve_append_note(reason, text);
    }
    const struct {
        size_t n;
        const char *what;
    } excluded[] = {{f->input.n_missing, "missing samples"},
                    {f->input.n_repeated, "repeated samples"},
                    {f->input.n_spikes, "spikes left out"}};
    for (size_t i = 0; i < sizeof excluded / sizeof excluded[0]; i++)
        if (excluded[i].n > 0) {
            curve_set_reason(text, "; %zu %s", excluded[i].n, excluded[i].what);
            curve_append_note(reason, text);
        }
    if (!f->range_converged)
        curve_append_note(reason, "; the range of the fit did not settle");
}

/* Changes the verdict of a usable fit to doubtful, because it only covers forces below a limit. The
 * reason keeps that of the fit. */
static wt_curve_verdict verdict_below_limit(curve_fitting *f, wt_curve_verdict verdict,
                                            char reason[160])
{
    char all[160], text[160];
    memcpy(all, reason, sizeof all);
    curve_set_reason(reason,
                     "fitted up to %s, above which the force flattens: detector, or the sample "
                     "yields",
                     curve_format_si(f->options->fit_force, "N").buffer);
    if (verdict != WT_CURVE_ACCEPTED) {
        curve_set_reason(text, "; %s", all);
        f->misfit_is_named = curve_append_note(reason, text) && f->misfit_is_named;
    }
    return WT_CURVE_DOUBTFUL;
}

wt_curve_verdict curve_assess(curve_fitting *f, wt_indent_fit *fit)
{
    wt_curve_verdict verdict = contact_verdict(f, fit, fit->reason);
    if (verdict != WT_CURVE_ACCEPTED)
        return verdict;
    verdict = law_verdict(f, fit, fit->reason);
    if (wt_curve_verdict_is_usable(verdict) && f->below_saturation)
        verdict = verdict_below_limit(f, verdict, fit->reason);
    if (wt_curve_verdict_is_usable(verdict))
        append_notes(f, fit, fit->reason);
    return verdict;
}

double curve_linear_limit(const curve_fitting *f)
{
    return f->input.flat_level > 0.0 ? plateau_share * f->input.flat_level
                                     : f->solution.lack.flat_from;
}

void curve_append_limit_verdict(double limit, wt_curve_verdict below, char reason[160])
{
    char text[160];
    curve_set_reason(text, "; up to %s: %s", curve_format_si(limit, "N").buffer,
                     wt_curve_verdict_text(below));
    curve_append_note(reason, text);
}
