/* Identification job: critical energy U_c and specific wear rate k of a layer, jointly, from its
 * thickness with a wear rate or a running-in time.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/shared_params.h"
#include "friction/replicates.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "job/random_draws.h"

#include "core/base/number.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "weartrack/layer.h"

#include <math.h>
#include <string.h>

/* Variances of ln U_c and ln k of a layer, and their covariance. */
typedef struct pair_covariance {
    double energy, wear, both;
} pair_covariance;

/* Principal axes of a covariance; NaN and "" if unknown. */
typedef struct constant_axes {
    double correlation;
    char loose[32];                  /* combination with the largest uncertainty: "U_c k^-0.42" */
    double loose_error, tight_error; /* standard deviations along and across that combination */
} constant_axes;

static constant_axes constant_axes_compute(pair_covariance c)
{
    const double middle = 0.5 * (c.energy + c.wear),
                 apart = hypot(0.5 * (c.energy - c.wear), c.both),
                 angle = 0.5 * atan2(2 * c.both, c.energy - c.wear),
                 scale = sqrt(c.energy * c.wear);
    constant_axes a = {.correlation = scale > 0 ? fmax(-1, fmin(1, c.both / scale)) : (double)NAN,
                       .loose_error = sqrt(middle + apart),
                       .tight_error = sqrt(fmax(middle - apart, 0))};
    if (isnan(angle))
        a.tight_error = (double)NAN; /* fmax ignores NaN */
    else if (fabs(cos(angle)) >= fabs(sin(angle)))
        clocale_print(a.loose, sizeof a.loose, "U_c k^%.2f", tan(angle));
    else
        clocale_print(a.loose, sizeof a.loose, "k U_c^%.2f", 1 / tan(angle));
    return a;
}

/* ---- parameters ------------------------------------------------------------------------------ */

/* Orders of magnitude: k of tread rubber by Karger-Kocsis and others, with DIN abrasion as the
 * upper bound; U_c follows from layers of micrometres at such k. */
static const double wear_low = 1e-13, wear_high = 1e-11;  /* [m^2/N] */
static const double energy_low = 1e9, energy_high = 1e12; /* [J/m^3] */
/* Share of the thickness after which an instrument resolves no further change of friction. */
static const double default_running_in_share = 0.95;

wt_identify_job wt_identify_job_defaults(void)
{
    return (wt_identify_job){.observed_thickness = {(double)NAN, 0, 0, "m"},
                             .specific_wear_rate = {(double)NAN, 0, 0, "m^2/N"},
                             .running_in_time = {(double)NAN, 0, 0, "s"},
                             .running_in_share = default_running_in_share,
                             .duty = wt_layer_defaults().duty,
                             .wear_low = wear_low,
                             .wear_high = wear_high,
                             .energy_low = energy_low,
                             .energy_high = energy_high};
}

static const wt_param rows[] = {
    {PARAM("observed-thickness", wt_identify_job, observed_thickness, WT_Q_LENGTH, ABOVE(0)),
     .value = "D", .flags = PARAM_REQUIRED,
     .help = SUCH_AS("of the layer at its balance, ", "\"1.6um +- 20%\"", "")},
    {PARAM("specific-wear-rate", wt_identify_job, specific_wear_rate, WT_Q_WEAR_RATE, ABOVE(0)),
     .value = "K", .unset = "",
     .help = SUCH_AS("k as measured, ", "\"1e-3mm^3/(N m) +- 15%\"", "")},
    {PARAM("running-in-time", wt_identify_job, running_in_time, WT_Q_TIME, ABOVE(0)), .value = "T",
     .unset = "", .help = SUCH_AS("that the layer took from bare rubber, ", "\"900s +- 15%\"", "")},
    {PARAM("running-in-share", wt_identify_job, running_in_share, WT_Q_NONE, FROM_TO(0.05, 0.999)),
     .value = "X", .help = "of its thickness that it had then"},
    LAYER_DUTY(wt_identify_job),
    {PARAM("prior-wear-from", wt_identify_job, wear_low, WT_Q_WEAR_RATE, ABOVE(0)), .value = "K",
     .help = "where the thickness is all that is known: k is taken to be within this and the next "
             "(literature, order of magnitude)"},
    {PARAM("prior-wear-to", wt_identify_job, wear_high, WT_Q_WEAR_RATE, ABOVE(0)), .value = "K",
     .help = "the other end"},
    {PARAM("prior-energy-from", wt_identify_job, energy_low, WT_Q_ENERGY_DENSITY, ABOVE(0)),
     .value = "U", .help = "likewise of U_c"},
    {PARAM("prior-energy-to", wt_identify_job, energy_high, WT_Q_ENERGY_DENSITY, ABOVE(0)),
     .value = "U", .help = "the other end"},
};
PARAM_TABLE(wt_identify_job_params, wt_identify_job, rows, wt_identify_job_defaults, NO_PARTS)

/* ---- one set of values ----------------------------------------------------------------------- */

/* Methods other than BY_THICKNESS. */
typedef identification_method method;
enum { N_METHODS = BY_THICKNESS };

/* Logarithms of the results; NaN if not applicable. */
enum {
    LN_PRODUCT, /* ln(k U_c); never NaN */
    LN_RATIO,
    LN_ENERGY,
    LN_WEAR = LN_ENERGY + N_METHODS,
    LN_DISCREPANCY = LN_WEAR + N_METHODS, /* ln of k of a method over the measured k */
    N_NUMBERS = LN_DISCREPANCY + N_METHODS
};

typedef struct identify_task {
    const wt_sliding *sliding;
    const wt_identify_job *job;
    const wt_job *work;
    double velocity;
    replicates replicates;
} identify_task;

static wt_status identify_by_method(const identify_task *task, method by,
                                    const wt_energy_source *source, wt_layer_parameters p,
                                    size_t replicate, double *out, wt_error *err)
{
    const wt_identify_job *const job = task->job;
    const uint64_t seed = task->work->seed;
    const double thickness = flow_draw_positive(job->observed_thickness, seed, replicate,
                                                FLOW_DRAW_OBSERVED),
                 wear =
                     flow_draw_positive(job->specific_wear_rate, seed, replicate, FLOW_DRAW_WEAR),
                 /* the draw of the critical energy is free, because it is not an input here */
        time = flow_draw_positive(job->running_in_time, seed, replicate, FLOW_DRAW_CRITICAL_ENERGY);
    wt_identified_constants found = {0};
    p.incubation = by == BY_TRANSPORT;
    out[LN_ENERGY + by] = out[LN_WEAR + by] = out[LN_DISCREPANCY + by] = (double)NAN;
    if (isnan(by == BY_WEAR ? wear : time))
        return WT_OK;
    const wt_status status = by == BY_WEAR
                                 ? wt_layer_identify_wear(source, &p, thickness, wear, &found, err)
                                 : wt_layer_identify_time(source, &p, thickness, time,
                                                          job->running_in_share, &found, err);
    if (status == WT_OK) {
        out[LN_ENERGY + by] = log(found.critical_energy);
        out[LN_WEAR + by] = log(found.specific_wear_rate);
        out[LN_DISCREPANCY + by] = out[LN_WEAR + by] - log(wear);
    }
    return status;
}

static wt_status identify_all_methods(const identify_task *task, size_t replicate, double *out,
                                      wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    const wt_identify_job *const job = task->job;
    wt_energy_source source = {.n = 0};
    sliding_contact c = {0};
    wt_identified_constants found = {0};
    wt_status status = sliding_contact_create(task->sliding, task->work, replicate,
                                              task->replicates.drawn, none, &c, err);
    if (status == WT_OK)
        status =
            wt_energy_source_from_friction(c.workspace, c.pressure, task->velocity, &source, err);
    wt_layer_parameters p = wt_layer_defaults();
    p.duty = job->duty;
    p.pressure = c.pressure;
    p.velocity = task->velocity;
    if (status == WT_OK) /* with k = 1 the critical energy is the product k U_c */
        status =
            wt_layer_identify_wear(&source, &p,
                                   flow_draw_positive(job->observed_thickness, task->work->seed,
                                                      replicate, FLOW_DRAW_OBSERVED),
                                   1, &found, err);
    out[LN_PRODUCT] = log(found.critical_energy);
    out[LN_RATIO] = log(found.ratio);
    for (method by = 0; status == WT_OK && by < BY_THICKNESS; by++)
        status = identify_by_method(task, by, &source, p, replicate, out, err);
    wt_energy_source_clear(&source);
    sliding_contact_clear(&c);
    return status;
}

static wt_status identify_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    return identify_all_methods(user, i, out, err);
}

/* ---- intervals from the draws ---------------------------------------------------------------- */

/* Results for the stated values, their standard deviations with and without the thickness, and the
 * results at both limits of the interval of the thickness. */
typedef struct identified_constants {
    double value[N_NUMBERS], at_limit[2][N_NUMBERS];
    double error[N_NUMBERS], rest[N_NUMBERS];
    double inputs[N_NUMBERS]; /* standard deviation due to material, surface and conditions only */
} identified_constants;

/* exp of quantity k with its 95 % interval. The thickness is an argument of an exponential, so that
 * its error has an asymmetric effect. The results at its own limits are therefore used and combined
 * in quadrature with the other errors. */
static wt_interval confidence_interval(const identified_constants *found, size_t k)
{
    const double value = found->value[k], rest = NORMAL_95 * found->rest[k],
                 one = found->at_limit[0][k] - value, other = found->at_limit[1][k] - value,
                 up = fmax(fmax(one, other), 0), down = fmin(fmin(one, other), 0);
    return (wt_interval){exp(value), exp(value) * found->error[k], exp(value - hypot(down, rest)),
                         exp(value + hypot(up, rest))};
}

/* ---- the table ------------------------------------------------------------------------------- */

TABLE_ROW(identification, IDENTIFICATION, const char *by; wt_interval energy, wear;
          constant_axes axes; char note[256];
          double energy_inputs, wear_inputs, correlation_inputs;)

static const wt_interval unknown_interval = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};

/* Returns the reason why a method has no interval; NULL if it has one. */
static const char *missing_interval_reason(const identify_task *task, bool wear, bool time)
{
    const wt_identify_job *const job = task->job;
    if (!(job->observed_thickness.standard_error > 0))
        return "no interval: no error is stated of the thickness";
    if (wear && !(job->specific_wear_rate.standard_error > 0))
        return "no interval: no error is stated of the wear rate";
    if (time && !(job->running_in_time.standard_error > 0))
        return "no interval: no error is stated of the running-in time";
    return task->work->replicates == 0 ? "no interval: no replicates are drawn" : NULL;
}

static constant_axes covariance_axes(const double error[N_NUMBERS], method by)
{
    const double energy = error[LN_ENERGY + by], wear = error[LN_WEAR + by],
                 both = error[LN_PRODUCT];
    return constant_axes_compute((pair_covariance){
        energy * energy, wear * wear, 0.5 * (both * both - energy * energy - wear * wear)});
}

static void add_method_row(const identify_task *task, method by, const identified_constants *found,
                           table_writer *t)
{
    const char *const none = missing_interval_reason(task, by == BY_WEAR, by != BY_WEAR);
    const double unknown = (double)NAN;
    identification_row row = {
        .by = identification_method_text(by),
        .axes = constant_axes_compute((pair_covariance){unknown, unknown, unknown}),
        .energy_inputs = unknown,
        .wear_inputs = unknown,
        .correlation_inputs = unknown};
    if (isnan(found->value[LN_ENERGY + by]))
        return;
    row.energy = confidence_interval(found, LN_ENERGY + by);
    row.wear = confidence_interval(found, LN_WEAR + by);
    if (none != NULL) {
        const double energy = row.energy.value, wear = row.wear.value;
        row.energy = row.wear = unknown_interval;
        row.energy.value = energy;
        row.wear.value = wear;
        snprintf(row.note, sizeof row.note, "%s", none);
    } else {
        row.axes = covariance_axes(found->error, by);
        row.energy_inputs = found->inputs[LN_ENERGY + by];
        row.wear_inputs = found->inputs[LN_WEAR + by];
        row.correlation_inputs = covariance_axes(found->inputs, by).correlation;
    }
    identification_add_row(t, &row);
}

/* Sets the headline to the first method with an interval; a value without an interval is no
 * headline. */
static void set_headline(const identify_task *task, const identified_constants *found,
                         table_writer *t)
{
    method by = BY_WEAR;
    while (by < BY_THICKNESS &&
           (isnan(found->value[LN_ENERGY + by]) ||
            missing_interval_reason(task, by == BY_WEAR, by != BY_WEAR) != NULL))
        by++;
    if (by == BY_THICKNESS)
        return;
    const wt_interval energy = confidence_interval(found, LN_ENERGY + by),
                      wear = confidence_interval(found, LN_WEAR + by);
    identification_set_value(t, IDENTIFICATION_KEY_ENERGY, energy.value, energy.standard_error,
                             (double)NAN);
    identification_set_value(t, IDENTIFICATION_KEY_WEAR, wear.value, wear.standard_error,
                             (double)NAN);
}

/* Adds the row of the thickness alone: the part of the literature ranges that the product allows.
 */
static void add_thickness_row(const identify_task *task, wt_interval product, table_writer *t)
{
    const wt_identify_job *const job = task->job;
    identification_row row = {
        .by = identification_method_text(BY_THICKNESS),
        .energy = unknown_interval,
        .wear = unknown_interval,
        .axes = {.correlation = (double)NAN,
                 .loose = "U_c k^-1.00",
                 .loose_error = HUGE_VAL,
                 .tight_error = product.standard_error / product.value * M_SQRT1_2},
        .energy_inputs = (double)NAN,
        .wear_inputs = (double)NAN,
        .correlation_inputs = (double)NAN};
    const double low = isnan(product.low) ? product.value : product.low,
                 high = isnan(product.high) ? product.value : product.high;
    row.energy.low = fmax(job->energy_low, low / job->wear_high);
    row.energy.high = fmin(job->energy_high, high / job->wear_low);
    row.wear.low = fmax(job->wear_low, low / job->energy_high);
    row.wear.high = fmin(job->wear_high, high / job->energy_low);
    if (!(row.energy.low <= row.energy.high)) {
        row.energy = row.wear = unknown_interval;
        snprintf(row.note, sizeof row.note,
                 "the product contradicts the ranges of the literature for k and U_c");
    } else {
        snprintf(row.note, sizeof row.note,
                 "no estimate: the ends are those of the literature's ranges for k and U_c "
                 "(order of magnitude), as far as the product allows");
    }
    identification_add_row(t, &row);
}

/* Compares the wear rate of the running-in with the measured one. A verdict needs the errors of
 * thickness, wear rate and running-in time. */
static void set_agreement_text(const identify_task *task, const identified_constants *found,
                               table_writer *t)
{
    const char *const none = missing_interval_reason(task, true, true);
    char text[400] = "";
    for (method by = BY_RATES; by < BY_THICKNESS; by++) {
        const size_t used = strlen(text);
        if (isnan(found->value[LN_DISCREPANCY + by]))
            return;
        const wt_interval discrepancy = confidence_interval(found, LN_DISCREPANCY + by);
        const bool known = none == NULL && discrepancy.high > discrepancy.low;
        char range[64] = "";
        if (known)
            clocale_print(range, sizeof range, " (95 %%: %s)",
                          format_range(discrepancy.low, discrepancy.high, 3).text);
        clocale_print(text + used, sizeof text - used,
                      "%s%s the running-in requires %.3g times the wear rate that was "
                      "measured%s, %s",
                      used > 0 ? "; " : "",
                      by == BY_RATES ? "by the balance of rates" : "by the transport of damage",
                      discrepancy.value, range,
                      !known                                          ? "which cannot be judged"
                      : discrepancy.low <= 1 && discrepancy.high >= 1 ? "which agrees"
                                                                      : "which contradicts it");
    }
    if (none != NULL)
        clocale_print(text + strlen(text), sizeof text - strlen(text), " (%s)", none);
    identification_set_text(t, IDENTIFICATION_KEY_AGREES, text);
}

static wt_status tabulate_identification(const identify_task *task,
                                         const identified_constants *found, wt_table **table,
                                         wt_error *err)
{
    const replicates *const r = &task->replicates;
    table_writer t = table_begin(&identification_schema, err);
    const wt_interval product = confidence_interval(found, LN_PRODUCT);
    const double ratio = exp(found->value[LN_RATIO]);
    add_thickness_row(task, product, &t);
    for (method by = 0; by < BY_THICKNESS; by++)
        add_method_row(task, by, found, &t);
    set_headline(task, found, &t);
    identification_set_value(&t, IDENTIFICATION_KEY_PRODUCT, product.value, product.standard_error,
                             (double)NAN);
    identification_set_value(&t, IDENTIFICATION_KEY_RATIO, ratio, ratio * found->error[LN_RATIO],
                             (double)NAN);
    set_agreement_text(task, found, &t);
    identification_set_value(&t, IDENTIFICATION_KEY_VELOCITY, task->velocity, 0, 0);
    identification_set(&t, IDENTIFICATION_KEY_PRESSURE,
                       flow_stated_estimate(task->sliding->pressure));
    identification_set(&t, IDENTIFICATION_KEY_THICKNESS,
                       flow_stated_estimate(task->job->observed_thickness));
    identification_set_text(&t, IDENTIFICATION_KEY_INCLUDES, replicates_included_errors(r));
    if (r->lacks[0] != '\0')
        identification_set_text(&t, IDENTIFICATION_KEY_LACKS, r->lacks);
    return table_end(&t, table);
}

/* ---- the job --------------------------------------------------------------------------------- */

/* Creates the task with the errors of the job. */
static identify_task create_task(const wt_sliding *sliding, const wt_identify_job *job,
                                 const wt_job *work)
{
    identify_task task = {.sliding = sliding,
                          .job = job,
                          .work = work,
                          .velocity = flow_reference_velocity(sliding),
                          .replicates = replicates_create(sliding, work, "identification")};
    task.replicates.velocity = task.velocity;
    replicates_add(&task.replicates, job->observed_thickness.standard_error, FLOW_DRAW_OBSERVED,
                   "observed thickness");
    if (!isnan(job->specific_wear_rate.value))
        replicates_add(&task.replicates, job->specific_wear_rate.standard_error, FLOW_DRAW_WEAR,
                       "specific wear rate");
    if (!isnan(job->running_in_time.value))
        replicates_add(&task.replicates, job->running_in_time.standard_error,
                       FLOW_DRAW_CRITICAL_ENERGY, "running-in time");
    return task;
}

static wt_status draw_errors(identify_task *task, double error[N_NUMBERS], wt_error *err)
{
    const wt_status status =
        replicates_draw(&task->replicates, N_NUMBERS, identify_replicate, task, err);
    for (size_t k = 0; status == WT_OK && k < N_NUMBERS; k++)
        error[k] = task->replicates.error[k];
    return status;
}

/* Standard deviations with some inputs fixed: 0 if no other input varies, NaN if no replicates are
 * requested. */
static wt_status draw_fixed_errors(const identify_task *task, const wt_identify_job *job,
                                   double error[N_NUMBERS], wt_error *err)
{
    identify_task fixed = create_task(task->sliding, job, task->work);
    const wt_status status = draw_errors(&fixed, error, err);
    replicates_clear(&fixed.replicates);
    for (size_t k = 0; k < N_NUMBERS && fixed.replicates.n == 0; k++)
        error[k] = task->work->replicates > 0 ? 0 : (double)NAN;
    return status;
}

/* Repeats the draws with fixed thickness: at its value, and at the limits of its interval; then
 * with all layer measurements fixed. */
static wt_status compute_fixed_thickness(const identify_task *task, identified_constants *found,
                                         wt_error *err)
{
    wt_identify_job job = *task->job;
    const wt_estimate thickness = job.observed_thickness;
    const double factor = exp(NORMAL_95 * thickness.standard_error / thickness.value);
    job.observed_thickness.standard_error = 0;
    wt_status status = draw_fixed_errors(task, &job, found->rest, err);
    identify_task fixed = create_task(task->sliding, &job, task->work);
    for (int end = 0; status == WT_OK && end < 2; end++) {
        job.observed_thickness.value =
            end == 0 ? thickness.value / factor : thickness.value * factor;
        status = identify_all_methods(&fixed, WT_NO_REPLICATE, found->at_limit[end], err);
    }
    job.observed_thickness.value = thickness.value;
    job.specific_wear_rate.standard_error = job.running_in_time.standard_error = 0;
    return status == WT_OK ? draw_fixed_errors(task, &job, found->inputs, err) : status;
}

static wt_status check_range(const char *first, const char *last, double low, double high,
                             wt_error *err)
{
    if (low < high)
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "a range of the literature has no room");
    wt_error_place(err, "%s, %s", first, last);
    wt_error_expected(err, "the first below the second");
    wt_error_found(err, "%g and %g", low, high);
    return WT_E_RANGE;
}

static wt_status check_identify_job(const wt_identify_job *job, wt_error *err)
{
    wt_status status = param_check(wt_identify_job_params(), job, err);
    if (status == WT_OK)
        status =
            check_range("prior-wear-from", "prior-wear-to", job->wear_low, job->wear_high, err);
    return status == WT_OK ? check_range("prior-energy-from", "prior-energy-to", job->energy_low,
                                         job->energy_high, err)
                           : status;
}

wt_status wt_identification_compute(const wt_sliding *sliding, const wt_identify_job *job,
                                    const wt_job *work, wt_table **table, wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no identification job");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = check_identify_job(job, err);
    if (status != WT_OK)
        return status;
    identify_task task = create_task(sliding, job, work);
    identified_constants found;
    status = identify_all_methods(&task, WT_NO_REPLICATE, found.value, err);
    if (status == WT_OK)
        status = draw_errors(&task, found.error, err);
    if (status == WT_OK)
        status = compute_fixed_thickness(&task, &found, err);
    if (status == WT_OK)
        status = tabulate_identification(&task, &found, table, err);
    if (status == WT_OK)
        cost_report(work, (cost_summary){.items = (double)wt_table_n_rows(*table),
                                         .tolerance_asked = work->tolerance});
    replicates_clear(&task.replicates);
    return status;
}
