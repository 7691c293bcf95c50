/* The layer job: energy density with depth, formation against wear, thickness at balance and in
 * time, with standard errors from replicates.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/job/conditions.h"
#include "flow/job/draws.h"
#include "kernel/params.h"

#include "base/array.h"
#include "data/tables/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Single numbers of one replicate; the thicknesses in time follow them. */
enum {
    THICKNESS,
    RATIO,
    INCUBATION,
    RELAXATION,
    CRITICAL_WEAR,
    REMOVAL,
    ENERGY,
    SURFACE_POWER,
    NINETY,
    N_NUMBERS
};

typedef struct layer_task {
    const wt_sliding *sliding;
    const wt_layer_job *job;
    const wt_job *work;
    double velocity;
    double *time; /* [n] */
    size_t n, stride, n_replicates;
    double *replicate; /* [n_replicates * stride] */
    double *error;     /* [stride] */
    bool varies;
    char words[256], lacks[256];
} layer_task;

/* The centre, kept for the tables. */
typedef struct centre {
    wt_energy_source source;
    wt_layer_parameters parameters;
    wt_layer_balance balance;
    wt_layer_point *points; /* [n] */
    char statement[256];
} centre;

wt_layer_job wt_layer_job_defaults(void)
{
    return (wt_layer_job){
        .critical_energy = {(double)NAN, 0, 0, "J/m^3"},
        .observed_thickness = {(double)NAN, 0, 0, "m"},
        .specific_wear_rate = {(double)NAN, 0, 0, "m^2/N"},
        .damage = wt_layer_defaults().damage,
        .duty = wt_layer_defaults().duty,
        .incubation = true,
        .profile = WT_PROFILE_PERSSON,
        .velocity = (double)NAN,
    };
}

static const wt_param rows[] = {
    {PARAM("critical-energy", wt_layer_job, critical_energy, WT_Q_ENERGY_DENSITY, ABOVE(0)),
     .value = "U", .unset = "",
     .help = "U_c, the energy per volume that modifies the rubber, such "
             "as 2e10J/m^3"},
    {PARAM("observed-thickness", wt_layer_job, observed_thickness, WT_Q_LENGTH, ABOVE(0)),
     .value = "D", .unset = "",
     .help = "of a layer, instead of the critical energy: this is to be "
             "the balance"},
    LAYER_ROWS(wt_layer_job, PARAM_REQUIRED),
    ENERGY_PROFILE(wt_layer_job),
    ENERGY_LOCAL_FRICTION(wt_layer_job),
    {PARAM_LIST_OF("times", wt_layer_job, time, n_time, WT_Q_TIME, AT_LEAST(0)), .value = "T",
     .unset = "around the time scales", .help = "such as 1:1e4s:log:40"},
    {PARAM("layer-velocity", wt_layer_job, velocity, WT_Q_VELOCITY, ABOVE(0)),
     .unset = "the reference velocity", .flags = PARAM_NO_OPTION,
     .help = "at which the track was worn"},
};
PARAM_TABLE(wt_layer_job_params, wt_layer_job, rows, wt_layer_job_defaults, NO_PARTS)

void wt_layer_tables_clear(wt_layer_tables *tables)
{
    if (tables == NULL)
        return;
    wt_table_free(tables->layer);
    wt_table_free(tables->energy_density);
    *tables = (wt_layer_tables){0};
}

wt_status wt_layer_job_check(const wt_layer_job *job, wt_error *err)
{
    const bool energy = !isnan(job->critical_energy.value);
    const bool observed = !isnan(job->observed_thickness.value);
    wt_status status = param_check(wt_layer_job_params(), job, err);
    if (status != WT_OK)
        return status;
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

/* U_c that makes the observed thickness the balance of this source: Qf(d) = Qw (theory B3), for any
 * depth profile. The duty cancels. */
static double calibrate(const wt_energy_source *source, const wt_layer_parameters *p,
                        double thickness)
{
    return wt_energy_tail(source, thickness) /
           (p->damage * p->specific_wear_rate * p->pressure * p->velocity);
}

static wt_status source_and_parameters(const layer_task *task, size_t replicate,
                                       wt_energy_source *source, wt_layer_parameters *parameters,
                                       char statement[256], wt_error *err)
{
    const wt_layer_state none = {.modulus_ratio = 1};
    const wt_layer_job *job = task->job;
    uint64_t seed = task->work->seed;
    flow_conditions c = {0};
    double tolerance =
        replicate == WT_NO_REPLICATE ? task->work->tolerance : FLOW_REPLICATE_TOLERANCE;
    wt_status status =
        flow_conditions_make(task->sliding, seed, replicate, tolerance, 1, none, &c, err);
    if (status == WT_OK)
        status = wt_energy_source_friction(c.workspace, c.pressure, task->velocity, source, err);
    if (status != WT_OK)
        goto done;
    source->profile = job->profile;
    source->local_friction = job->local_friction;
    *parameters = wt_layer_defaults();
    parameters->damage = job->damage;
    parameters->duty = job->duty;
    parameters->start_thickness = job->start_thickness;
    parameters->incubation = job->incubation;
    parameters->pressure = c.pressure;
    parameters->velocity = task->velocity;
    parameters->specific_wear_rate =
        flow_draw_positive(job->specific_wear_rate, seed, replicate, FLOW_DRAW_WEAR);
    parameters->critical_energy =
        isnan(job->critical_energy.value)
            ? calibrate(
                  source, parameters,
                  flow_draw_positive(job->observed_thickness, seed, replicate, FLOW_DRAW_OBSERVED))
            : flow_draw_positive(job->critical_energy, seed, replicate, FLOW_DRAW_CRITICAL_ENERGY);
    if (statement != NULL)
        memcpy(statement, c.statement, sizeof c.statement);
done:
    flow_conditions_clear(&c);
    return status;
}

static void put_numbers(const wt_layer_balance *b, const wt_layer_parameters *p, double *out)
{
    out[THICKNESS] = b->thickness.value;
    out[RATIO] = b->ratio;
    out[INCUBATION] = b->incubation_time;
    out[RELAXATION] = b->relaxation_time;
    out[CRITICAL_WEAR] = b->critical_specific_wear_rate;
    out[REMOVAL] = b->removal_time;
    out[ENERGY] = p->critical_energy;
    out[SURFACE_POWER] = b->surface_power;
}

/* When a growing layer gets to a thickness, between the times of its history; NaN if outside them.
 * The relaxation time is no such time: the slowest waves of the roughness decide how the layer with
 * its damage beneath settles. */
static double time_to_share(const wt_layer_point *points, size_t n, double thickness)
{
    if (!(thickness > 0) || !isfinite(thickness))
        return (double)NAN;
    for (size_t i = 1; i < n; i++) {
        double before = points[i - 1].thickness.value, after = points[i].thickness.value;
        if (!(points[i - 1].time > 0) || !(before < thickness) || !(after >= thickness))
            continue;
        double share = (thickness - before) / (after - before);
        return points[i - 1].time * pow(points[i].time / points[i - 1].time, share);
    }
    return (double)NAN;
}

/* ---- times ------------------------------------------------------------------------------------
 */

#define TIMES 61

/* From well before the first change to well after the last one. */
static wt_status choose_times(layer_task *task, const wt_layer_balance *b, wt_error *err)
{
    task->n = task->job->time != NULL ? task->job->n_time : TIMES;
    task->time = malloc((task->n > 0 ? task->n : 1) * sizeof *task->time);
    if (task->time == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    if (task->job->time != NULL) {
        memcpy(task->time, task->job->time, task->n * sizeof *task->time);
        return WT_OK;
    }
    double first = b->incubation_time, last = b->relaxation_time;
    if (!(first > 0) || !isfinite(first))
        first = isfinite(last) && last > 0 ? last / 1000 : 1;
    if (!(last > 0) || !isfinite(last))
        last = 1e6 * first;
    first /= 2;
    last = fmax(100 * last, 100 * first);
    for (size_t i = 0; i < task->n; i++)
        task->time[i] = first * pow(last / first, (double)i / (double)(task->n - 1));
    return WT_OK;
}

/* ---- replicates -------------------------------------------------------------------------------
 */

static wt_status one_replicate(void *user, size_t i, unsigned worker)
{
    (void)worker;
    layer_task *task = user;
    double *out = task->replicate + i * task->stride;
    wt_energy_source source = {0};
    wt_layer_parameters parameters;
    wt_layer_balance balance;
    wt_error ignored = WT_ERROR_INIT;
    wt_layer_point *points = malloc((task->n > 0 ? task->n : 1) * sizeof *points);
    if (points == NULL)
        return WT_E_MEMORY;
    wt_status status = source_and_parameters(task, i, &source, &parameters, NULL, &ignored);
    if (status == WT_OK)
        status = wt_layer_balance_compute(&source, &parameters, &balance, &ignored);
    if (status == WT_OK)
        status = wt_layer_history(&source, &parameters, task->time, task->n, points, &ignored);
    if (status == WT_OK) {
        put_numbers(&balance, &parameters, out);
        out[NINETY] = time_to_share(points, task->n, 0.9 * balance.thickness.value);
        for (size_t k = 0; k < task->n; k++)
            out[N_NUMBERS + k] = points[k].thickness.value;
    } else {
        for (size_t k = 0; k < task->stride; k++)
            out[k] = (double)NAN;
    }
    wt_energy_source_clear(&source);
    free(points);
    return status == WT_E_MEMORY ? status : WT_OK;
}

static wt_status replicate_all(layer_task *task, wt_error *err)
{
    for (size_t k = 0; k < task->stride; k++)
        task->error[k] = (double)NAN;
    if (!task->varies)
        return WT_OK;
    wt_status status = wt_parallel_for(task->n_replicates, task->work->threads, one_replicate, task,
                                       &task->work->progress, "layer replicates");
    if (status != WT_OK)
        return wt_fail(err, status, "the replicates of the layer failed");
    size_t without = 0, lost = 0;
    for (size_t i = 0; i < task->n_replicates; i++) {
        double thickness = task->replicate[i * task->stride + THICKNESS];
        lost += isnan(thickness) != 0;
        without += thickness <= 0;
    }
    if (lost > 0)
        wt_parselog_add(task->work->log, WT_WARNING, NULL, NULL,
                        "%zu of %zu replicates of the layer have no solution and are left out of "
                        "the standard errors",
                        lost, task->n_replicates);
    if (without > 0 && without + lost < task->n_replicates)
        wt_parselog_add(task->work->log, WT_WARNING, NULL, NULL,
                        "within the stated errors the layer may be there or not: %zu of %zu "
                        "replicates have none",
                        without, task->n_replicates - lost);
    for (size_t k = 0; k < task->stride; k++)
        task->error[k] = flow_spread(task->replicate + k, task->n_replicates, task->stride);
    return WT_OK;
}

/* ---- tables -----------------------------------------------------------------------------------
 */

static const char *regime_name(wt_layer_regime regime)
{
    static const char *const names[] = {"none", "thin", "thick"};
    return names[regime];
}

static void set_numbers(const layer_task *task, const centre *c, table_writer *t)
{
    static const struct {
        int index;
        layer_key key;
    } keys[] = {
        {RATIO, LAYER_KEY_FORMATION_WEAR_RATIO},  {INCUBATION, LAYER_KEY_INCUBATION_TIME},
        {RELAXATION, LAYER_KEY_RELAXATION_TIME},  {CRITICAL_WEAR, LAYER_KEY_CRITICAL_WEAR_RATE},
        {REMOVAL, LAYER_KEY_REMOVAL_TIME},        {ENERGY, LAYER_KEY_CRITICAL_ENERGY},
        {SURFACE_POWER, LAYER_KEY_SURFACE_POWER}, {NINETY, LAYER_KEY_TIME_TO_90_PERCENT},
    };
    double value[N_NUMBERS];
    put_numbers(&c->balance, &c->parameters, value);
    value[NINETY] = time_to_share(c->points, task->n, 0.9 * c->balance.thickness.value);
    layer_set_value(t, LAYER_KEY_BALANCE_THICKNESS, value[THICKNESS], task->error[THICKNESS],
                    c->balance.thickness.numerical_error);
    /* d ln thickness / d ln k = -Qw / (thickness |dQf/dz|): the balance is where Qf(z) = Qw */
    double sensitivity =
        -c->balance.wear_rate * c->balance.relaxation_time / c->balance.thickness.value;
    if (isfinite(sensitivity))
        layer_set_value(t, LAYER_KEY_WEAR_SENSITIVITY, sensitivity, (double)NAN, 0);
    for (size_t i = 0; i < COUNT_OF(keys); i++)
        layer_set_value(t, keys[i].key, value[keys[i].index], task->error[keys[i].index], 0);
}

static void set_keys(const layer_task *task, const centre *c, table_writer *t)
{
    const wt_layer_job *job = task->job;
    const bool calibrated = isnan(job->critical_energy.value);
    set_numbers(task, c, t);
    layer_set_text(t, LAYER_KEY_REGIME, regime_name(c->balance.regime));
    layer_set_value(t, LAYER_KEY_VELOCITY, task->velocity, 0, 0);
    layer_set(t, LAYER_KEY_PRESSURE, task->sliding->pressure);
    layer_set(t, LAYER_KEY_WEAR_RATE, job->specific_wear_rate);
    if (calibrated)
        layer_set(t, LAYER_KEY_OBSERVED_THICKNESS, job->observed_thickness);
    layer_set_text(t, LAYER_KEY_CRITICAL_ENERGY_FROM,
                   calibrated ? "calibrated: makes the observed thickness the balance" : "given");
    layer_set_print(t, LAYER_KEY_DAMAGE, "%g", job->damage);
    layer_set_print(t, LAYER_KEY_DUTY, "%g", job->duty);
    layer_set_text(t, LAYER_KEY_ERROR_INCLUDES,
                   task->varies ? task->words : "nothing, for no error was measured or stated");
    if (task->lacks[0] != '\0')
        layer_set_text(t, LAYER_KEY_ERROR_LACKS, task->lacks);
    if (c->statement[0] != '\0')
        layer_set_text(t, LAYER_KEY_MATERIAL_STATEMENT, c->statement);
}

static wt_status layer_table(const layer_task *task, const centre *c, wt_table **out, wt_error *err)
{
    table_writer t = table_begin(&layer_schema, err);
    for (size_t i = 0; i < task->n; i++) {
        const wt_layer_point *p = &c->points[i];
        table_row(&t);
        layer_put(&t, LAYER_TIME, p->time);
        layer_put(&t, LAYER_THICKNESS, p->thickness.value);
        layer_put(&t, LAYER_THICKNESS_STANDARD_ERROR, task->error[N_NUMBERS + i]);
        layer_put(&t, LAYER_THICKNESS_NUMERICAL_ERROR, p->thickness.numerical_error);
        layer_put(&t, LAYER_FORMATION_RATE, p->formation_rate);
        layer_put(&t, LAYER_WEAR_RATE, p->wear_rate);
    }
    set_keys(task, c, &t);
    return table_end(&t, out);
}

#define DEPTHS 121

static wt_status energy_table(const layer_task *task, const wt_energy_source *source,
                              wt_table **out, wt_error *err)
{
    double q_min = source->wavenumber[0], q_max = source->wavenumber[0];
    for (size_t i = 1; i < source->n; i++) {
        q_min = fmin(q_min, source->wavenumber[i]);
        q_max = fmax(q_max, source->wavenumber[i]);
    }
    /* from a tenth of the shortest wave to where the longest one has died out */
    double first = 0.1 / q_max, last = 3 / q_min;
    table_writer t = table_begin(&energy_density_schema, err);
    for (size_t i = 0; i < DEPTHS; i++) {
        double depth = first * pow(last / first, (double)i / (DEPTHS - 1));
        table_row(&t);
        energy_density_put(&t, ENERGY_DENSITY_DEPTH, depth);
        energy_density_put(&t, ENERGY_DENSITY_POWER, wt_energy_density(source, depth));
    }
    energy_density_set_value(&t, ENERGY_DENSITY_KEY_VELOCITY, task->velocity, 0, 0);
    return table_end(&t, out);
}

/* ---- the job ----------------------------------------------------------------------------------
 */

static void find_words(layer_task *task)
{
    const wt_layer_job *job = task->job;
    task->varies = flow_conditions_vary(task->sliding, task->work, task->words, sizeof task->words);
    const struct {
        double error;
        const char *what;
    } stated[] = {
        {job->specific_wear_rate.standard_error, "specific wear rate"},
        {isnan(job->critical_energy.value) ? 0 : job->critical_energy.standard_error,
         "critical energy"},
        {isnan(job->observed_thickness.value) ? 0 : job->observed_thickness.standard_error,
         "observed thickness"},
    };
    for (size_t i = 0; task->work->replicates > 1 && i < COUNT_OF(stated); i++) {
        if (!(stated[i].error > 0))
            continue;
        flow_add_words(task->words, sizeof task->words, stated[i].what);
        task->varies = true;
    }
    flow_conditions_lack(task->sliding, task->lacks, sizeof task->lacks);
    if (!(job->specific_wear_rate.standard_error > 0))
        flow_add_words(task->lacks, sizeof task->lacks, "specific wear rate");
    if (!isnan(job->critical_energy.value) && !(job->critical_energy.standard_error > 0))
        flow_add_words(task->lacks, sizeof task->lacks, "critical energy");
    if (!isnan(job->observed_thickness.value) && !(job->observed_thickness.standard_error > 0))
        flow_add_words(task->lacks, sizeof task->lacks, "observed thickness");
}

static wt_status allocate(layer_task *task, centre *c, wt_error *err)
{
    task->stride = N_NUMBERS + task->n;
    task->error = malloc(task->stride * sizeof *task->error);
    task->replicate =
        calloc(task->varies ? task->n_replicates : 1, task->stride * sizeof *task->replicate);
    c->points = malloc((task->n > 0 ? task->n : 1) * sizeof *c->points);
    if (task->error == NULL || task->replicate == NULL || c->points == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    return WT_OK;
}

wt_status wt_layer_make(const wt_sliding *sliding, const wt_layer_job *job, const wt_job *work,
                        wt_layer_tables *tables, wt_error *err)
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
                       .velocity =
                           isnan(job->velocity) ? flow_reference_velocity(sliding) : job->velocity,
                       .n_replicates = work->replicates};
    centre c = {0};
    wt_layer_tables t = {0};
    find_words(&task);
    status =
        source_and_parameters(&task, WT_NO_REPLICATE, &c.source, &c.parameters, c.statement, err);
    if (status == WT_OK)
        status = wt_layer_balance_compute(&c.source, &c.parameters, &c.balance, err);
    if (status == WT_OK)
        status = choose_times(&task, &c.balance, err);
    if (status == WT_OK)
        status = allocate(&task, &c, err);
    if (status == WT_OK)
        status = wt_layer_history(&c.source, &c.parameters, task.time, task.n, c.points, err);
    if (status == WT_OK)
        status = replicate_all(&task, err);
    if (status == WT_OK)
        status = layer_table(&task, &c, &t.layer, err);
    if (status == WT_OK)
        status = energy_table(&task, &c.source, &t.energy_density, err);
    if (status == WT_OK) {
        t.balance = c.balance;
        t.thickness = c.balance.thickness;
        t.thickness.standard_error = task.error[THICKNESS];
        t.balance.thickness = t.thickness;
        *tables = t;
        t = (wt_layer_tables){0};
    }
    wt_energy_source_clear(&c.source);
    wt_layer_tables_clear(&t);
    free(c.points);
    free(task.time);
    free(task.error);
    free(task.replicate);
    return status;
}
