/* Validation job: measured over predicted friction, and the required inputs.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/validation.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "job/random_draws.h"

#include <math.h>
#include <stdlib.h>

/* A value far above 0 has a log-normal interval, because its inputs (pressure, area, modulus ratio)
 * are factors. A smaller one has a normal interval that may include 0. */
static const double well_above = 3; /* standard errors */

/* ---- required shear stress ------------------------------------------------------------------- */

/* Returns the 95 % interval of a required shear stress, with its standard error. */
static wt_interval required_shear_interval(double value, double error, double df)
{
    const double half = agreement_quantile(df) * error, factor = exp(half / value);
    if (value > well_above * error)
        return (wt_interval){value, error, value / factor, value * factor};
    return (wt_interval){value, error, value - half, value + half};
}

/* Weighted mean of the required shear stress of the steps, for the nominal values and for each
 * draw. */
static void find_required_shear(validation *v)
{
    const model_variant *const t = &v->shear;
    v->needed = required_shear_interval(t->fit.coefficient[0], t->fit.error[0], t->fit.df[0]);
    v->needed_shear = wt_alloc(1 + v->p.n_draws, sizeof *v->needed_shear);
    for (size_t k = 0; k <= v->p.n_draws; k++)
        for (size_t i = 0; i < v->steps.n; i++) {
            const double rest = v->steps.step[i].friction -
                                prediction_total(&v->p, k, v->layered, i, 0),
                         slope = prediction_total(&v->p, k, v->layered, i, 1) -
                                 prediction_total(&v->p, k, v->layered, i, 0);
            v->needed_shear[k] += t->fit.weight[i] * rest / slope;
        }
}

/* Computes the required shear stress and the remaining difference with it. */
static wt_status required_shear_compute(validation *v, wt_error *err)
{
    wt_status status =
        model_variant_fit_shear(&v->p, &v->steps, v->layered, v->work->seed, &v->shear, err);
    if (status == WT_OK)
        find_required_shear(v);
    if (status != WT_OK || !(v->needed.value > 0) || v->ratio[0].fit.terms < 2)
        return status; /* one velocity determines one number, the shear stress */
    const ratio_inputs of = {&v->p, &v->steps, v->needed_shear, v->layered};
    status = model_variant_fit_ratio(&of, v->work->seed, &v->shape, err);
    if (status == WT_OK)
        agreement_assess(&v->shape.fit, validation_margin(v));
    return status;
}

/* Plausible shear stresses of the real contact [Pa]. Tread compounds on road and concrete: Lorenz
 * et al., J. Chem. Phys. 142 (2015) 194701; Tolpekina and Persson, Lubricants 7 (2019) 20. Soft and
 * contaminated contacts have less. */
static const double shear_low = 1e6, shear_high = 10e6;
/* Source of the range, so that a reader can disagree. */
static const char literature[] = "the range of the literature for rubber on rough counter surfaces";

static stated_verdict plausibility(const validation *v)
{
    const wt_interval *const n = &v->needed;
    return n->high < shear_low || n->low > shear_high   ? VERDICT_NO
           : n->low > shear_low && n->high < shear_high ? VERDICT_YES
                                                        : VERDICT_INCONCLUSIVE;
}

static void set_plausibility(const validation *v, table_writer *t)
{
    const stated_verdict verdict = plausibility(v);
    const char *const words = verdict == VERDICT_YES            ? "all of its interval is in"
                              : verdict == VERDICT_INCONCLUSIVE ? "it may be in or out of"
                              : v->needed.high < shear_low      ? "it is below"
                                                                : "it is above";
    char text[320];
    if (v->needed.high < 0)
        clocale_print(text, sizeof text, "no: the hysteresis part alone is more than was measured");
    else
        clocale_print(text, sizeof text, "%s: %s %.3g MPa to %.3g MPa, %s",
                      stated_verdict_text(verdict), words, 1e-6 * shear_low, 1e-6 * shear_high,
                      literature);
    validation_set_text(t, VALIDATION_KEY_PLAUSIBLE, text);
}

/* Probability that a fit whose errors are those of this one, of a theory without a deviation, lies
 * within the margin at the step that decides. */
static double verdict_power(const validation *v, const model_variant *t)
{
    double ends[2];
    agreement_interval(&t->fit, t->fit.deciding_step, false, ends);
    const double half = (ends[1] - ends[0]) / 2,
                 room = (validation_margin(v) - half) * NORMAL_95 / half;
    return room > 0 ? erf(room / M_SQRT2) : 0;
}

/* Sets the headline: the verdict as given, or that with the shear stress that the record asks for
 * where this decides it and is plausible. */
static void set_outcome(const validation *v, table_writer *t)
{
    static const validation_outcome as_given[] = {[AGREEMENT_INCONCLUSIVE] = OUTCOME_INCONCLUSIVE,
                                                  [AGREEMENT_YES] = OUTCOME_YES,
                                                  [AGREEMENT_NO] = OUTCOME_NO};
    const model_variant *fit = v->has_shear ? &v->ratio[v->layered] : NULL;
    validation_outcome outcome = fit != NULL ? as_given[fit->fit.verdict] : OUTCOME_INCONCLUSIVE;
    char with[160] = "", text[400], power[96] = "";
    if (outcome != OUTCOME_YES && v->shape.n > 0 && v->shape.fit.verdict == AGREEMENT_YES &&
        plausibility(v) == VERDICT_YES) {
        outcome = OUTCOME_YES_WITH_SHEAR;
        fit = &v->shape;
        clocale_print(with, sizeof with, " of %.3g MPa (95 %%: %s), which is plausible",
                      1e-6 * v->needed.value,
                      format_range(1e-6 * v->needed.low, 1e-6 * v->needed.high, 3).text);
    }
    if (fit != NULL) {
        const double found = verdict_power(v, fit);
        validation_set_value(t, VALIDATION_KEY_POWER, found, (double)NAN, (double)NAN);
        clocale_print(power, sizeof power, ", such a record shows a true theory in %.0f %%",
                      100 * found);
    }
    clocale_print(text, sizeof text, "%s%s; margin %.3g %%%s", validation_outcome_text(outcome),
                  with, 100 * v->job->margin, power);
    validation_set_text(t, VALIDATION_KEY_OUTCOME, text);
}

static void required_shear_set_keys(const validation *v, table_writer *t)
{
    if (v->shear.n == 0)
        return;
    validation_set_value(t, VALIDATION_KEY_NEEDED, v->needed.value, v->needed.standard_error,
                         (double)NAN);
    validation_set_value(t, VALIDATION_KEY_NEEDED_LOW, v->needed.low, 0, 0);
    validation_set_value(t, VALIDATION_KEY_NEEDED_HIGH, v->needed.high, 0, 0);
    set_plausibility(v, t);
    if (v->shape.n > 0)
        validation_set_text(t, VALIDATION_KEY_SHAPE, model_variant_verdict(v, &v->shape).text);
    else
        validation_set_text(t, VALIDATION_KEY_SHAPE,
                            v->needed.value > 0
                                ? "inconclusive: with so few velocities some shear stress fits "
                                  "any measurement"
                                : "no: the hysteresis part alone is more than was measured");
}

/* ---- parameters ------------------------------------------------------------------------------ */

/* Friction of one pair of materials on a pin-on-disc tribometer differs by about 20 % between
 * laboratories (ASTM G99, interlaboratory test). A theory within this margin explains it. */
static const double reproducibility = 0.2;

wt_validation_job wt_validation_job_defaults(void)
{
    return (wt_validation_job){.margin = reproducibility, .wanted = true};
}

static const wt_param rows[] = {
    {PARAM("margin", wt_validation_job, margin, WT_Q_NONE, FROM_TO(0.01, 1)), .value = "X",
     .help = "measured over predicted friction that is treated as agreement: 0.2 is from 1/1.2 to "
             "1.2, about what laboratories differ by (ASTM G99)"},
    {PARAM_FLAG_OF("validate", wt_validation_job, wanted), .flags = PARAM_NO_OPTION,
     .help = "whether a run compares the records with the prediction of the case, also where "
             "figures or results are listed"},
};
PARAM_TABLE(wt_validation_job_params, wt_validation_job, rows, wt_validation_job_defaults, NO_PARTS)

/* ---- the steps ------------------------------------------------------------------------------- */

static const wt_interval not_known = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
static const wt_estimate no_number = {(double)NAN, (double)NAN, (double)NAN, "1"};

TABLE_ROW(validation, VALIDATION, double velocity, temperature, pressure; wt_interval measured;
          wt_estimate predicted, with_layer; wt_interval ratio, ratio_with_layer, needed;
          const char *note, *file;)

/* Standard error of a single step; it includes the scatter between the steps. */
static double step_error(const model_variant *t, size_t i)
{
    return sqrt(t->measurement_variance[i] + t->fit.scatter +
                t->prediction_covariance[i * t->n + i]);
}

static void fill_ratio(const validation *v, bool layered, size_t i, wt_estimate *predicted,
                       wt_interval *ratio)
{
    const model_variant *const t = &v->ratio[layered];
    if (t->n == 0)
        return;
    const double error = step_error(t, i);
    predicted->value = prediction_total(&v->p, 0, layered, i, v->p.shear[0]);
    predicted->standard_error =
        v->p.n_draws > 0 ? predicted->value * sqrt(t->prediction_covariance[i * t->n + i])
                         : (double)NAN;
    *ratio = validation_factor(t->value[i], error,
                               agreement_df(error * error, t->fit.scatter, t->fit.scatter_df));
}

static void add_step(const validation *v, size_t i, table_writer *t)
{
    const measured_step *const s = &v->steps.step[i];
    validation_row row = {.velocity = s->velocity,
                          .temperature = s->temperature,
                          .pressure = s->pressure,
                          .measured = s->measured,
                          .predicted = no_number,
                          .with_layer = no_number,
                          .ratio = not_known,
                          .ratio_with_layer = not_known,
                          .needed = not_known,
                          .note = s->note,
                          .file = s->file};
    if (isnan(row.temperature))
        row.temperature = v->used.sliding.rubber->prony.reference_temperature;
    if (i < v->steps.n) {
        fill_ratio(v, false, i, &row.predicted, &row.ratio);
        fill_ratio(v, true, i, &row.with_layer, &row.ratio_with_layer);
        const agreement *const fit = &v->shear.fit;
        const double error = step_error(&v->shear, i),
                     df = agreement_df(error * error, fit->scatter, fit->scatter_df);
        row.needed = required_shear_interval(v->shear.value[i], error, df);
    }
    validation_add_row(t, &row);
}

/* ---- keys ------------------------------------------------------------------------------------ */

/* Sets a limit, which has no error. */
static void set_bound(table_writer *t, validation_key key, double value)
{
    if (isfinite(value))
        validation_set_value(t, key, value, 0, 0);
}

static void set_validation_interval(table_writer *t, validation_key key, validation_key low,
                                    validation_key high, wt_interval i)
{
    validation_set_value(t, key, i.value, i.standard_error, (double)NAN);
    set_bound(t, low, i.low);
    set_bound(t, high, i.high);
}

static void set_verdicts(const validation *v, table_writer *t)
{
    static const char no_shear[] =
        "inconclusive: no shear stress is given, and the total friction is "
        "not predicted without it";
    const bool layer = v->ratio[1].n > 0;
    validation_set_text(t, VALIDATION_KEY_JUDGED,
                        v->layered ? "friction with the layer" : "friction without a layer");
    if (!v->has_shear) {
        validation_set_text(t, VALIDATION_KEY_VERDICT, no_shear);
        validation_set_text(t, VALIDATION_KEY_WITHOUT, no_shear);
    } else {
        validation_set_text(t, VALIDATION_KEY_VERDICT,
                            model_variant_verdict(v, &v->ratio[v->layered]).text);
        validation_set_text(t, VALIDATION_KEY_WITHOUT, model_variant_verdict(v, &v->ratio[0]).text);
        if (layer)
            validation_set_text(t, VALIDATION_KEY_WITH,
                                model_variant_verdict(v, &v->ratio[1]).text);
    }
    validation_set_print(
        t, VALIDATION_KEY_TEST,
        "yes: at every step the interval of 95 %% of measured over predicted, smooth over the "
        "velocity, is from %s; no: at some step the interval that holds 95 %% at "
        "all "
        "steps at once is outside; else it is inconclusive. Errors of record and scatter between "
        "steps "
        "are in it, %s, choices of the model are not",
        validation_requested_range(v->job->margin).text,
        v->p.n_draws > 0 ? "and stated errors of the prediction"
                         : "errors of the prediction are not, without replicates");
}

static void set_ratio_interval(const validation *v, table_writer *t)
{
    if (!v->has_shear)
        return;
    const agreement *const fit = &v->ratio[v->layered].fit;
    set_validation_interval(t, VALIDATION_KEY_RATIO, VALIDATION_KEY_RATIO_LOW,
                            VALIDATION_KEY_RATIO_HIGH,
                            validation_factor(v->mean.value, v->mean.error, v->mean.df));
    if (fit->terms > 1) {
        const double error =
            model_variant_components(&v->ratio[v->layered], fit->weight + fit->n).all;
        validation_set_value(t, VALIDATION_KEY_TREND, expm1(fit->coefficient[1] / fit->span),
                             exp(fit->coefficient[1] / fit->span) * sqrt(error) / fit->span,
                             (double)NAN);
    }
    if (fit->scatter_df > 0)
        validation_set_value(t, VALIDATION_KEY_SCATTER, sqrt(fit->scatter), (double)NAN,
                             (double)NAN);
}

/* Compares the measured wear rate with that of the layer. */
static wt_status set_wear(const validation *v, table_writer *t, wt_error *err)
{
    table_view wear = {0};
    if (v->job->wear == NULL || v->job->layer == NULL)
        return WT_OK;
    const wt_status status = table_bind(v->job->wear, &wear_schema, "", &wear, err);
    const wt_estimate is = status == WT_OK ? wear_value(&wear, WEAR_KEY_RATE) : no_number,
                      used = v->job->layer->specific_wear_rate;
    if (status != WT_OK || !(is.value > 0) || !(used.value > 0) || is.value == used.value)
        return status; /* the layer uses the measured rate */
    const bool known = is.standard_error > 0;
    const double error =
        hypot(known ? is.standard_error / is.value : (double)NAN, used.standard_error / used.value);
    const wt_interval ratio =
        validation_factor(log(is.value / used.value), error, (double)INFINITY);
    set_validation_interval(t, VALIDATION_KEY_WEAR_RATIO, VALIDATION_KEY_WEAR_RATIO_LOW,
                            VALIDATION_KEY_WEAR_RATIO_HIGH, ratio);
    validation_set_text(t, VALIDATION_KEY_WEAR,
                        isnan(error) ? "inconclusive: what was worn has no stated error"
                        : ratio.low <= 1 && ratio.high >= 1
                            ? "agrees within the errors"
                            : "differs: compute the layer with the wear rate that was measured");
    return WT_OK;
}

/* Sets the keys of the layer that friction was predicted with. */
static void set_predicted_layer_keys(const validation *v, table_writer *t)
{
    char moduli[512];
    if (!v->layered)
        return;
    const wt_estimate thickness = flow_stated_estimate(v->layer_observation->thickness),
                      ratio = flow_stated_estimate(v->layer_observation->modulus_ratio);
    validation_set(t, VALIDATION_KEY_LAYER_THICKNESS, thickness);
    validation_set(t, VALIDATION_KEY_LAYER_RATIO, ratio);
    sliding_layer_describe(v->layer_observation, v->p.zero_loss_range, v->work->log, moduli,
                           sizeof moduli);
    if (moduli[0] == '\0')
        return;
    validation_set_text(t, VALIDATION_KEY_LAYER_MODULI, moduli);
    validation_set(t, VALIDATION_KEY_LAYER_SLOPE,
                   flow_stated_estimate(v->layer_observation->ratio_slope));
}

static wt_status set_validation_keys(const validation *v, const source_advice *advice,
                                     table_writer *t, wt_error *err)
{
    set_outcome(v, t);
    set_verdicts(v, t);
    if (advice->settles[0] != '\0')
        validation_set_text(t, VALIDATION_KEY_SETTLED_BY, advice->settles);
    if (!v->has_shear)
        validation_set_text(t, VALIDATION_KEY_SETTLED_BY, "a shear stress of the real contact");
    set_ratio_interval(v, t);
    set_predicted_layer_keys(v, t);
    if (v->has_shear)
        validation_set(t, VALIDATION_KEY_SHEAR, flow_stated_estimate(v->used.sliding.shear_stress));
    required_shear_set_keys(v, t);
    const wt_status status = set_wear(v, t, err);
    validation_set_print(t, VALIDATION_KEY_STEPS, "%zu", v->steps.n);
    validation_set_print(t, VALIDATION_KEY_LEFT_OUT, "%zu", v->steps.n_all - v->steps.n);
    if (v->steps.remarks[0] != '\0')
        validation_set_text(t, VALIDATION_KEY_REMARKS, v->steps.remarks);
    return status;
}

/* ---- the job --------------------------------------------------------------------------------- */

static wt_status compare_ratios(validation *v, wt_error *err)
{
    wt_status status = WT_OK;
    for (int layered = 0; status == WT_OK && layered < (v->layer_observation != NULL ? 2 : 1);
         layered++) {
        const ratio_inputs of = {&v->p, &v->steps, v->p.shear, layered != 0};
        status = model_variant_fit_ratio(&of, v->work->seed, &v->ratio[layered], err);
        if (status == WT_OK)
            agreement_assess(&v->ratio[layered].fit, validation_margin(v));
    }
    if (status == WT_OK)
        v->mean = mean_ratio_compute(&v->ratio[v->layered]);
    return status;
}

/* A layer that grows without limit has no friction. */
static wt_status begin_validation(validation *v, wt_error *err)
{
    table_view record = {0};
    const wt_validation_job *const job = v->job;
    wt_status status = case_variant_create(job->sliding, job->layer, job->layer_observation,
                                           v->work, &v->used, err);
    if (status == WT_OK)
        status = table_bind(job->record, &record_schema, "", &record, err);
    if (status == WT_OK)
        status = measured_steps_read(&record, job->sliding, &v->steps, err);
    v->layer_observation =
        job->layer_observation != NULL && isfinite(job->layer_observation->thickness.value)
            ? job->layer_observation
            : NULL;
    v->layered = v->layer_observation != NULL;
    if (status == WT_OK && job->layer_observation != NULL && !v->layered)
        measured_steps_add_remark(
            &v->steps, "without wear, or where it ages, the layer grows without end and "
                       "friction with it is not known: friction without a layer is compared");
    v->has_shear = !isnan(job->sliding->shear_stress.value);
    if (status == WT_OK)
        status = predict_friction(job->sliding, v->layer_observation, &v->steps, v->work, true,
                                  &v->p, err);
    if (status == WT_OK && v->p.n_draws == 0)
        measured_steps_add_remark(&v->steps,
                                  "intervals and verdicts contain no errors of the prediction, "
                                  "because they need replicates");
    return status;
}

static wt_status make_validation_tables(const validation *v, wt_validation_tables *tables,
                                        wt_error *err)
{
    source_advice advice = {.narrows = ""};
    wt_status status = error_sources_tabulate(v, &advice, &tables->sources, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&validation_schema, err);
    size_t next = 0; /* first step with another temperature or pressure, which begins a new block */
    for (size_t i = 0; i < v->steps.n_all; i++) {
        if (i < v->steps.n && i == next) {
            table_block(&t);
            next += measured_group_length(&v->steps, i);
        }
        add_step(v, i, &t);
    }
    t.status = t.status == WT_OK ? set_validation_keys(v, &advice, &t, err) : t.status;
    return table_end(&t, &tables->validation);
}

static void validation_clear(validation *v)
{
    for (int i = 0; i < 2; i++)
        model_variant_clear(&v->ratio[i]);
    model_variant_clear(&v->shear);
    model_variant_clear(&v->shape);
    free(v->mean.row);
    free(v->needed_shear);
    prediction_clear(&v->p);
    measured_steps_clear(&v->steps);
}

wt_status wt_validation_compute(const wt_validation_job *job, const wt_job *work,
                                wt_validation_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL || job->record == NULL)
        return wt_fail(err, WT_E_ARG, "no validation job");
    validation v = {.job = job, .work = work};
    wt_validation_tables made = {0};
    wt_status status = param_check(wt_validation_job_params(), job, err);
    if (status == WT_OK)
        status = begin_validation(&v, err);
    if (status == WT_OK && v.has_shear)
        status = compare_ratios(&v, err);
    if (status == WT_OK)
        status = required_shear_compute(&v, err);
    if (status == WT_OK)
        status = make_validation_tables(&v, &made, err);
    cost_report(work,
                (cost_summary){.items = (double)v.steps.n, .tolerance_asked = work->tolerance});
    validation_clear(&v);
    if (status == WT_OK) {
        *tables = made;
        made = (wt_validation_tables){0};
    }
    wt_tables_clear(&made, sizeof made);
    return status;
}
