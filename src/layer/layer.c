/* Layer job: energy density against depth, formation and wear, thickness at balance and against
 * time, with standard errors from replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/param.h"
#include "core/base/shared_params.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"
#include "dma/rubber.h"
#include "friction/sliding_contact.h"
#include "job/cost.h"
#include "job/random_draws.h"
#include "layer/layer_energy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

wt_layer_job wt_layer_job_defaults(void)
{
    return (wt_layer_job){
        .critical_energy = {(double)NAN, 0, 0, "J/m^3"},
        .observed_thickness = {(double)NAN, 0, 0, "m"},
        .specific_wear_rate = {(double)NAN, 0, 0, "m^2/N"},
        .duty = wt_layer_defaults().duty,
        .incubation = true,
        .profile = WT_PROFILE_PERSSON,
        .velocity = (double)NAN,
        .energy = WT_LAYER_HYSTERESIS,
    };
}

static const wt_param rows[] = {
    {PARAM("critical-energy", wt_layer_job, critical_energy, WT_Q_ENERGY_DENSITY, ABOVE(0)),
     .value = "U", .unset = "",
     .help = SUCH_AS("U_c, the energy per volume that modifies the rubber, ", "2e10J/m^3", "")},
    {PARAM("observed-thickness", wt_layer_job, observed_thickness, WT_Q_LENGTH, ABOVE(0)),
     .value = "D", .unset = "",
     .help = "of a layer at balance, from which the critical energy is calculated"},
    LAYER_WEAR_RATE(wt_layer_job, "as measured"),
    LAYER_DUTY(wt_layer_job),
    {PARAM_FLAG_OF("incubation", wt_layer_job, incubation),
     .help = "transport of damage (exact at constant load), without which the rates are balanced "
             "from the beginning"},
    {PARAM_CHOICE_OF("profile", wt_layer_job, profile, "persson|incompressible"),
     .flags = PARAM_ONLY_C, .help = "how the energy falls off with depth"},
    ENERGY_LOCAL_FRICTION(wt_layer_job),
    {PARAM_LIST_OF("times", wt_layer_job, time, n_time, WT_Q_TIME, AT_LEAST(0)), .value = "T",
     .unset = "around the time scales", .help = SUCH_AS("", "1:1e4s:log:40", "")},
    {PARAM("layer-velocity", wt_layer_job, velocity, WT_Q_VELOCITY, ABOVE(0)),
     .unset = "the reference velocity", .flags = PARAM_NO_OPTION,
     .help = "at which the track was worn"},
    {PARAM_CHOICE_OF("energy-from", wt_layer_job, energy, "hysteresis|shear|both"),
     .help = "what modifies the rubber: the hysteresis, the shearing of the real contact by the "
             "shear stress, or both; the shearing is taken to go as deep as the hysteresis "
             "(reconstructed)"},
};
PARAM_TABLE(wt_layer_job_params, wt_layer_job, rows, wt_layer_job_defaults, NO_PARTS)

wt_status wt_layer_job_check(const wt_layer_job *job, wt_error *err)
{
    const bool energy = !isnan(job->critical_energy.value);
    const bool observed = !isnan(job->observed_thickness.value);
    wt_status status = param_check(wt_layer_job_params(), job, err);
    if (status != WT_OK)
        return status;
    if (isnan(job->specific_wear_rate.value)) {
        status =
            wt_fail(err, WT_E_MISSING, "no specific wear rate is given, and none was measured");
        wt_error_advice(err, "give specific-wear-rate, such as \"1e-3mm^3/(N m)\", or a record "
                             "with the wear");
        return status;
    }
    if (energy == observed) {
        status = wt_fail(err, energy ? WT_E_ARG : WT_E_MISSING,
                         "a layer has either a critical energy or an observed thickness");
        wt_error_expected(err, "one of critical-energy, observed-thickness");
        wt_error_found(err, energy ? "both" : "neither");
        wt_error_advice(err, "from an observed thickness the critical energy is calculated");
        return status;
    }
    if (observed && !(job->specific_wear_rate.value > 0)) {
        wt_fail(err, WT_E_RANGE, "an observed thickness is calibrated against wear");
        wt_error_place(err, "specific-wear-rate");
        wt_error_expected(err, "above 0");
        wt_error_found(err, "%g m^2/N", job->specific_wear_rate.value);
        return WT_E_RANGE;
    }
    return WT_OK;
}

/* ---- energy density -------------------------------------------------------------------------- */

#define DEPTHS 121 /* resolution of a figure */

TABLE_ROW(energy_density, ENERGY_DENSITY, double depth, energy_density;)

static void add_depths(const wt_energy_source *source, table_writer *t)
{
    double q_min = source->wavenumber[0], q_max = source->wavenumber[0];
    for (size_t i = 1; i < source->n; i++) {
        q_min = fmin(q_min, source->wavenumber[i]);
        q_max = fmax(q_max, source->wavenumber[i]);
    }
    /* from a tenth of the shortest wave to where the longest one has decayed */
    const double first = 0.1 / q_max, last = 3 / q_min;
    for (size_t i = 0; i < DEPTHS; i++) {
        const double depth = first * pow(last / first, (double)i / (DEPTHS - 1));
        TABLE_ADD(energy_density, t, depth, wt_energy_density(source, depth));
    }
}

wt_status wt_energy_density_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                    const wt_job *work, wt_table **table, wt_error *err)
{
    if (job == NULL || work == NULL || table == NULL)
        return wt_fail(err, WT_E_ARG, "no energy density to make");
    sliding_contact c = {0};
    layer_energy energy = {.source = {.n = 0}};
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = wt_layer_job_check(job, err);
    if (status == WT_OK)
        status = sliding_contact_create_stated(sliding, work, &c, err);
    const double velocity = status == WT_OK ? layer_sliding_velocity(sliding, job) : 0;
    if (status == WT_OK)
        status = layer_energy_compute(sliding, job, &c, velocity, &energy, err);
    sliding_contact_clear(&c);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&energy_density_schema, err);
    add_depths(&energy.source, &t);
    energy_density_set_value(&t, ENERGY_DENSITY_KEY_VELOCITY, velocity, 0, 0);
    cost_report(work, (cost_summary){.items = DEPTHS,
                                     .tolerance_asked = work->tolerance,
                                     .error_estimated = energy.source.numerical_error});
    layer_energy_clear(&energy);
    return table_end(&t, table);
}

/* Writes what modifies the rubber; "" for the hysteresis alone. */
static void describe_energy(const wt_layer_job *job, const layer_energy *energy, char *text,
                            size_t size)
{
    text[0] = '\0';
    if (job->energy == WT_LAYER_SHEAR)
        clocale_print(text, size,
                      "shearing of the surface, which goes as deep as the hysteresis "
                      "(reconstructed)");
    if (job->energy == WT_LAYER_BOTH)
        clocale_print(
            text, size,
            "hysteresis, and shearing of the surface, which goes as deep (reconstructed): "
            "shearing is %.3g %% of it",
            100 * energy->shear_power / (energy->hysteresis_power + energy->shear_power));
}

/* Balance for one set of values. */
typedef struct layer_run {
    layer_energy energy;
    wt_layer_parameters parameters;
    wt_layer_steady_state balance;
    wt_estimate critical_energy, time_to_90_percent;
    wt_layer_point *points; /* [n of the task] */
    char statement[512];
} layer_run;

/* Scalar quantities of a run with their keys; the thicknesses at the times follow them. */
#define NUMBERS(X)                                                                                 \
    X(BALANCE_THICKNESS, run->balance.thickness)                                                   \
    X(FORMATION_WEAR_RATIO, rate_estimate(run, run->balance.ratio))                                \
    X(INCUBATION_TIME, run->balance.incubation_time)                                               \
    X(RELAXATION_TIME, run->balance.relaxation_time)                                               \
    X(CRITICAL_WEAR_RATE, rate_estimate(run, run->balance.critical_specific_wear_rate))            \
    X(CRITICAL_ENERGY, run->critical_energy)                                                       \
    X(SURFACE_POWER, power_estimate(run, run->balance.surface_power))                              \
    X(TIME_TO_90_PERCENT, run->time_to_90_percent)
#define NUMBER_ID(key, value) NUMBER_##key,
enum { NUMBERS(NUMBER_ID) N_NUMBERS };

typedef struct layer_task {
    const wt_sliding *sliding;
    const wt_layer_job *job;
    const wt_job *work;
    double velocity;
    double *time; /* [n] */
    size_t n;
    replicates replicates;
} layer_task;

/* Estimate of a quantity proportional to the total power, with its relative numerical error. */
static wt_estimate power_estimate(const layer_run *run, double value)
{
    return (wt_estimate){.value = value,
                         .numerical_error = fabs(value) * run->energy.source.numerical_error};
}

/* Estimate of a quantity proportional to formation or wear, which depend on the power through
 * closure. */
static wt_estimate rate_estimate(const layer_run *run, double value)
{
    return (wt_estimate){.value = value, .numerical_error = fabs(value) * run->balance.ratio_error};
}

static void store_numbers(const layer_run *run, wt_estimate *out)
{
#define STORE_NUMBER(key, number) out[NUMBER_##key] = number;
    NUMBERS(STORE_NUMBER)
}

/* ---- one run --------------------------------------------------------------------------------- */

static wt_status compute_balance(const layer_task *task, size_t replicate, layer_run *run,
                                 wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    const wt_layer_job *job = task->job;
    const uint64_t seed = task->work->seed;
    sliding_contact c = {0};
    wt_job work = *task->work;
    const bool with_times = (work.left_out & WT_EXTRA_LAYER_TIMES) == 0;
    work.left_out |= WT_EXTRA_EXTRAPOLATED_SHARE;
    wt_status status = sliding_contact_create(task->sliding, &work, replicate,
                                              task->replicates.drawn, none, &c, err);
    if (status == WT_OK)
        status = layer_energy_compute(task->sliding, job, &c, task->velocity, &run->energy, err);
    if (status == WT_OK) {
        memcpy(run->statement, c.statement, sizeof c.statement);
        wt_layer_parameters *p = &run->parameters;
        *p = layer_parameters_create(job, &c, task->velocity, seed, replicate);
        p->balance_only = !with_times;
        const bool calibrated = !isnan(job->observed_thickness.value);
        if (calibrated)
            p->critical_energy = wt_layer_calibrate(
                &run->energy.source, p,
                flow_draw_positive(job->observed_thickness, seed, replicate, FLOW_DRAW_OBSERVED));
        status = wt_layer_steady_state_compute(&run->energy.source, p, &run->balance, err);
        run->critical_energy = calibrated ? rate_estimate(run, p->critical_energy)
                                          : (wt_estimate){.value = p->critical_energy};
    }
    wt_estimate most = run->balance.thickness;
    most.value *= 0.9;
    most.numerical_error *= 0.9;
    run->time_to_90_percent = (wt_estimate){(double)NAN, (double)NAN, (double)NAN, "s"};
    if (status == WT_OK && with_times)
        status = wt_layer_growth_time(&run->energy.source, &run->parameters, most,
                                      &run->time_to_90_percent, err);
    sliding_contact_clear(&c);
    return status;
}

static wt_status compute_history(const layer_task *task, layer_run *run, wt_error *err)
{
    run->points = wt_alloc(task->n + 1, sizeof *run->points);
    return wt_layer_history(&run->energy.source, &run->parameters, task->time, task->n, run->points,
                            err);
}

static void clear_run(layer_run *run)
{
    layer_energy_clear(&run->energy);
    free(run->points);
}

static wt_status compute_layer_replicate(const void *user, size_t i, double *out, wt_error *err)
{
    const layer_task *task = user;
    layer_run run = {.points = NULL};
    wt_status status = compute_balance(task, i, &run, err);
    if (status == WT_OK)
        status = compute_history(task, &run, err);
    if (status == WT_OK) {
        wt_estimate number[N_NUMBERS];
        store_numbers(&run, number);
        for (size_t k = 0; k < N_NUMBERS; k++)
            out[k] = number[k].value;
        for (size_t k = 0; k < task->n; k++)
            out[N_NUMBERS + k] = run.points[k].thickness.value;
    }
    clear_run(&run);
    return status;
}

/* ---- replicates ------------------------------------------------------------------------------ */

static wt_status draw_layer_replicates(layer_task *task, wt_error *err)
{
    const wt_layer_job *job = task->job;
    replicates *r = &task->replicates;
    const bool calibrated = !isnan(job->observed_thickness.value);
    const double given = layer_replicates_add(r, task->sliding, job);
    wt_status status = replicates_draw(r, N_NUMBERS + task->n, compute_layer_replicate, task, err);
    /* The input keeps its stated error; the replicates would give it with their own noise. */
    if (status == WT_OK)
        r->error[calibrated ? NUMBER_BALANCE_THICKNESS : NUMBER_CRITICAL_ENERGY] =
            given > 0 ? given : (double)NAN;
    size_t without = 0, solved = 0;
    for (size_t i = 0; status == WT_OK && i < r->n; i++) {
        const double thickness = r->value[i * r->stride + NUMBER_BALANCE_THICKNESS];
        solved += isnan(thickness) == 0;
        without += thickness <= 0;
    }
    if (without > 0 && without < solved)
        wt_log_add(task->work->log, WT_WARNING, NULL, NULL,
                   "within the stated errors there may be a layer or none: %zu of %zu "
                   "replicates have none",
                   without, solved);
    return status;
}

/* ---- tables ---------------------------------------------------------------------------------- */

static void set_numbers(const layer_task *task, const layer_run *run, table_writer *t)
{
#define NUMBER_KEY(key, value) LAYER_KEY_##key,
    static const layer_key keys[] = {NUMBERS(NUMBER_KEY)};
    const wt_layer_steady_state *b = &run->balance;
    wt_estimate number[N_NUMBERS];
    store_numbers(run, number);
    for (size_t i = 0; i < N_NUMBERS; i++) {
        layer_set_value(t, keys[i], number[i].value, task->replicates.error[i],
                        number[i].numerical_error);
        /* d ln thickness / d ln k = -Qw / (thickness |dQf/dz|), because the balance is at Qf(z) =
         * Qw */
        const double sensitivity = -b->wear_rate * b->relaxation_time.value / b->thickness.value;
        if (keys[i] == LAYER_KEY_BALANCE_THICKNESS && isfinite(sensitivity))
            layer_set_value(t, LAYER_KEY_WEAR_SENSITIVITY, sensitivity, (double)NAN, 0);
    }
}

TABLE_ROW_OF(layer, LAYER, wt_layer_point)

TABLE_KEYS(layer, LAYER, wt_layer_regime regime;
           const char *critical_energy_from, *includes, *lacks, *statement; double velocity, duty;
           wt_estimate pressure, wear_rate, observed;
           char energy_from[256], softening[256], numerical[512];
           wt_estimate hysteresis_power, shear_power;)

static void set_layer_keys(const layer_task *task, const layer_run *run, table_writer *t)
{
    const wt_layer_job *job = task->job;
    const bool calibrated = !isnan(job->observed_thickness.value);
    char from[80];
    snprintf(from, sizeof from, "%s%s",
             critical_energy_origin_text(calibrated ? ENERGY_CALIBRATED : ENERGY_GIVEN),
             calibrated ? ": makes the observed thickness the balance" : "");
    layer_keys keys = {.regime = run->balance.regime,
                       .critical_energy_from = from,
                       .includes = replicates_included_errors(&task->replicates),
                       .lacks = task->replicates.lacks,
                       .statement = run->statement,
                       .velocity = task->velocity,
                       .duty = job->duty,
                       .pressure = flow_stated_estimate(task->sliding->pressure),
                       .wear_rate = flow_stated_estimate(job->specific_wear_rate),
                       .observed = flow_stated_estimate(job->observed_thickness)};
    if (!calibrated)
        keys.observed.value = (double)NAN;
    keys.hysteresis_power = keys.shear_power =
        (wt_estimate){(double)NAN, (double)NAN, (double)NAN, NULL};
    describe_energy(job, &run->energy, keys.energy_from, sizeof keys.energy_from);
    if (job->energy != WT_LAYER_HYSTERESIS) {
        keys.hysteresis_power.value = run->energy.hysteresis_power;
        keys.shear_power.value = run->energy.shear_power;
    }
    if (task->sliding->strain_softening != NULL)
        strain_softening_describe(task->sliding->strain_softening, keys.softening,
                                  sizeof keys.softening);
    if (run->energy.source.numerical_error > task->work->tolerance)
        clocale_print(keys.numerical, sizeof keys.numerical, TOLERANCE_STATEMENT,
                      task->work->tolerance, run->energy.source.numerical_error);
    set_numbers(task, run, t);
    layer_set_keys(t, &keys);
}

static wt_status make_layer_table(const layer_task *task, const layer_run *run, wt_table **out,
                                  wt_error *err)
{
    table_writer t = table_begin(&layer_schema, err);
    for (size_t i = 0; i < task->n; i++) {
        layer_row row = run->points[i];
        row.thickness.standard_error = task->replicates.error[N_NUMBERS + i];
        layer_add_row(&t, &row);
    }
    set_layer_keys(task, run, &t);
    return table_end(&t, out);
}

/* ---- the job --------------------------------------------------------------------------------- */

wt_status wt_layer_thickness_compute(const wt_sliding *sliding, const wt_layer_job *job,
                                     const wt_job *work, wt_layer_tables *tables, wt_error *err)
{
    if (job == NULL || work == NULL || tables == NULL)
        return wt_fail(err, WT_E_ARG, "no layer job");
    wt_status status = flow_sliding_check(sliding, work, err);
    if (status == WT_OK)
        status = wt_layer_job_check(job, err);
    if (status != WT_OK)
        return status;
    layer_task task = {.sliding = sliding,
                       .job = job,
                       .work = work,
                       .velocity = layer_sliding_velocity(sliding, job),
                       .replicates = replicates_create(sliding, work, "layer")};
    task.replicates.velocity = task.velocity;
    layer_run centre = {.points = NULL};
    wt_layer_tables t = {0};
    status = compute_balance(&task, WT_NO_REPLICATE, &centre, err);
    if (status == WT_OK)
        task.time = layer_times_choose(job, &centre.balance, &task.n);
    if (status == WT_OK)
        status = compute_history(&task, &centre, err);
    if (status == WT_OK)
        status = draw_layer_replicates(&task, err);
    if (status == WT_OK)
        status = make_layer_table(&task, &centre, &t.layer, err);
    if (status == WT_OK) {
        t.balance = centre.balance;
        t.thickness = centre.balance.thickness;
        t.thickness.standard_error = task.replicates.error[NUMBER_BALANCE_THICKNESS];
        t.balance.thickness = t.thickness;
        const double thickness = t.thickness.value > 0 ? t.thickness.value : (double)NAN;
        cost_report(work, (cost_summary){.items = (double)(task.n * (1 + task.replicates.n)),
                                         .tolerance_asked = work->tolerance,
                                         .error_estimated = t.thickness.numerical_error / thickness,
                                         .number = t.thickness});
        *tables = t;
        t = (wt_layer_tables){0};
    }
    clear_run(&centre);
    wt_table_free(t.layer);
    free(task.time);
    replicates_clear(&task.replicates);
    return status;
}
