/* A layer in one sliding contact: energy that modifies the rubber (hysteresis, shearing of the
 * surface or both), operating point, friction on the layer and default times.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_energy.h"
#include "core/math/special.h"
#include "job/random_draws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Smallest ratio of the thickest to the thinnest layer for interpolation: nodes must be distinct.
 */
static const double min_thickness_ratio = 1 + 1e-6;

static wt_status compute_nodes(layer_friction_model *f, double thinnest, double thickest, size_t n,
                               wt_error *err)
{
    const double low = log(thinnest), high = log(thickest);
    for (size_t i = 0; i < n; i++) {
        layer_friction at;
        f->log_thickness[i] = low + (high - low) * (double)i / (double)(n - 1);
        const wt_status status = layer_compute_friction(
            f->context, operating_point_under_layer(f->context, exp(f->log_thickness[i])), &at,
            err);
        if (status != WT_OK)
            return status;
        f->value[NODE_HYSTERESIS][i] = at.hysteresis;
        f->value[NODE_AREA][i] = at.area_ratio;
        f->value[NODE_BULK_STRESS][i] = at.bulk_stress;
        f->value[NODE_MODULUS_RATIO][i] = at.ratio;
        f->pressure = at.pressure;
    }
    f->n = n;
    return WT_OK;
}

wt_status layer_friction_model_create(const layer_context *context, double thinnest,
                                      double thickest, size_t n, layer_friction_model *friction,
                                      wt_error *err)
{
    *friction = (layer_friction_model){.context = context};
    if (n < AKIMA_POINTS_MIN || !(thickest > min_thickness_ratio * thinnest))
        return WT_OK;
    double *all = wt_alloc((N_NODE_QUANTITIES + 1) * n, sizeof *all);
    friction->log_thickness = all;
    for (size_t k = 0; k < N_NODE_QUANTITIES; k++)
        friction->value[k] = all + (k + 1) * n;
    wt_status status = compute_nodes(friction, thinnest, thickest, n, err);
    for (size_t k = 0; status == WT_OK && k < N_NODE_QUANTITIES; k++)
        friction->curve[k] = akima_curve_new(friction->log_thickness, friction->value[k], n);

    if (status != WT_OK)
        layer_friction_model_clear(friction);
    return status;
}

wt_status layer_friction_model_evaluate(const layer_friction_model *model, double thickness,
                                        layer_friction *f, wt_error *err)
{
    const double unknown = (double)NAN;
    const operating_point conditions = operating_point_under_layer(model->context, thickness);
    *f = (layer_friction){unknown, unknown, unknown, unknown, unknown,
                          unknown, unknown, unknown, unknown, unknown};
    if (!isfinite(thickness))
        return WT_OK;
    if (model->n == 0 || !(thickness > 0))
        return layer_compute_friction(model->context, conditions, f, err);
    const double *const at = model->log_thickness;
    const double x = fmin(fmax(log(thickness), at[0]), at[model->n - 1]);
    f->hysteresis = akima_curve_value(model->curve[NODE_HYSTERESIS], x);
    f->area_ratio = akima_curve_value(model->curve[NODE_AREA], x);
    f->bulk_stress = akima_curve_value(model->curve[NODE_BULK_STRESS], x);
    f->pressure = model->pressure;
    const bool own =
        model->context->sliding->layer_rubber != NULL || conditions.layer.slope.exponent != 0;
    f->ratio = own ? akima_curve_value(model->curve[NODE_MODULUS_RATIO], x)
                   : conditions.layer.modulus_ratio;
    layer_friction_set_total(model->context->job, conditions.layer, f);
    return WT_OK;
}

void layer_friction_model_clear(layer_friction_model *friction)
{
    for (size_t k = 0; k < N_NODE_QUANTITIES; k++)
        akima_curve_free(friction->curve[k]);
    free(friction->log_thickness);
    *friction = (layer_friction_model){.n = 0};
}

double layer_sliding_velocity(const wt_sliding *sliding, const wt_layer_job *layer)
{
    return isnan(layer->velocity) ? flow_reference_velocity(sliding) : layer->velocity;
}

operating_point operating_point_default(void)
{
    return (operating_point){.pressure = (double)NAN,
                             .velocity = (double)NAN,
                             .temperature = (double)NAN,
                             .layer = {.modulus_ratio = 1}};
}

operating_point operating_point_under_layer(const layer_context *context, double thickness)
{
    operating_point conditions = operating_point_default();
    if (thickness > 0)
        conditions.layer = (wt_layer_state){.thickness = thickness,
                                            .modulus_ratio = context->modulus_ratio,
                                            .slope = context->slope};
    return conditions;
}

wt_estimate estimate_without_error(double value)
{
    return (wt_estimate){value, (double)NAN, (double)NAN, NULL};
}

/* Sliding with the values of an operating point; *velocity must outlive the result. */
static wt_sliding sliding_at_conditions(const layer_context *context, operating_point conditions,
                                        double *velocity)
{
    wt_sliding s = *context->sliding;
    *velocity = isnan(conditions.velocity) ? layer_sliding_velocity(context->sliding, context->job)
                                           : conditions.velocity;
    s.velocity = velocity;
    s.n_velocity = 1;
    s.reference_velocity = *velocity;
    if (!isnan(conditions.pressure)) {
        s.pressure.standard_error *= conditions.pressure / s.pressure.value;
        s.pressure.value = conditions.pressure;
    }
    if (!isnan(conditions.temperature))
        s.temperature.value = conditions.temperature;
    return s;
}

static wt_status create_operating_contact(const layer_context *context, const wt_sliding *s,
                                          operating_point conditions, sliding_contact *c,
                                          wt_error *err)
{
    wt_job local_job = *context->work;
    local_job.left_out = WT_EXTRA_ALL;
    /* the cached materials are for the temperature of the sliding */
    return sliding_contact_create(s, &local_job, context->replicate,
                                  isnan(conditions.temperature) ? context->drawn : NULL,
                                  conditions.layer, c, err);
}

void layer_friction_set_total(const wt_layer_job *job, wt_layer_state layer, layer_friction *f)
{
    layer.modulus_ratio = f->ratio;
    const double stress = wt_layer_shear_stress(&job->shear, f->bulk_stress, layer);
    f->shear_stress = stress;
    f->total = f->hysteresis + stress * f->area_ratio / f->pressure;
    f->total_error = f->hysteresis_error + stress * f->area_error / f->pressure;
}

double layer_friction_coefficient(const layer_friction *f)
{
    return isnan(f->total) ? f->hysteresis : f->total;
}

static wt_status compute_friction_at_point(const layer_context *context, const wt_sliding *s,
                                           const sliding_contact *c, operating_point conditions,
                                           layer_friction *friction, wt_error *err)
{
    wt_friction_point p;
    const wt_status status =
        wt_friction_compute(c->workspace, c->pressure, s->velocity, 1, &p, err);
    if (status != WT_OK)
        return status;
    *friction = (layer_friction){
        .hysteresis = p.hysteresis.value,
        .area_ratio = p.area_ratio.value,
        .hysteresis_error = p.hysteresis.numerical_error,
        .area_error = p.area_ratio.numerical_error,
        .bulk_stress = c->shear_stress,
        .pressure = c->pressure,
        .ratio = sliding_layer_at_shear_rate(c, conditions.layer, s->velocity[0]).modulus_ratio};
    layer_friction_set_total(context->job, conditions.layer, friction);
    return WT_OK;
}

wt_status layer_compute_contact(const layer_context *context, operating_point conditions,
                                layer_energy *energy, wt_layer_parameters *parameters,
                                layer_friction *friction, wt_error *err)
{
    double velocity;
    const wt_sliding s = sliding_at_conditions(context, conditions, &velocity);
    sliding_contact c = {0};
    wt_status status = create_operating_contact(context, &s, conditions, &c, err);
    if (status == WT_OK && friction != NULL)
        status = compute_friction_at_point(context, &s, &c, conditions, friction, err);
    if (status == WT_OK && energy != NULL) {
        status =
            layer_energy_compute(&s, context->job, &c, velocity, conditions.layer, energy, err);
        if (status == WT_OK)
            *parameters = layer_parameters_create(context->job, &c, velocity, context->work->seed,
                                                  context->replicate);
    }
    sliding_contact_clear(&c);
    return status;
}

wt_status layer_compute_energy(const layer_context *context, operating_point conditions,
                               layer_energy *energy, wt_layer_parameters *parameters, wt_error *err)
{
    return layer_compute_contact(context, conditions, energy, parameters, NULL, err);
}

wt_status layer_compute_friction(const layer_context *context, operating_point conditions,
                                 layer_friction *friction, wt_error *err)
{
    return layer_compute_contact(context, conditions, NULL, NULL, friction, err);
}

wt_status layer_job_calibrate(const layer_context *context, wt_layer_job *calibrated, wt_error *err)
{
    *calibrated = *context->job;
    if (isnan(context->job->observed_thickness.value))
        return WT_OK;
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    const wt_status status =
        layer_compute_energy(context, operating_point_default(), &energy, &p, err);
    if (status != WT_OK)
        return status;
    calibrated->critical_energy = (wt_estimate){
        wt_layer_calibrate(&energy.source, &p,
                           flow_draw_positive(context->job->observed_thickness, context->work->seed,
                                              context->replicate, FLOW_DRAW_OBSERVED)),
        0, 0, "J/m^3"};
    calibrated->observed_thickness.value = (double)NAN;
    layer_energy_clear(&energy);
    return WT_OK;
}

/* Number of default times, as many as a figure shows well. They reach from half the first time
 * scale to a multiple of the last, where the layer is steady. A missing scale is set by a ratio to
 * the other one. The choice of times does not affect their results. */
#define DEFAULT_TIMES 61
#define TIME_SPAN 100
#define FIRST_OVER_LAST 1e-3
#define LAST_OVER_FIRST 1e6

/* Times from well before the first change to well after the last one. */
double *layer_times_choose(const wt_layer_job *job, const wt_layer_steady_state *b, size_t *n)
{
    *n = job->time != NULL ? job->n_time : DEFAULT_TIMES;
    double *const time = wt_alloc(*n > 0 ? *n : 1, sizeof *time);
    if (job->time != NULL) {
        memcpy(time, job->time, *n * sizeof *time);
        return time;
    }
    double first = b->incubation_time.value, last = b->relaxation_time.value;
    if (!(first > 0) || !isfinite(first))
        first = isfinite(last) && last > 0 ? FIRST_OVER_LAST * last : 1;
    if (!(last > 0) || !isfinite(last))
        last = LAST_OVER_FIRST * first;
    first /= 2;
    last = TIME_SPAN * fmax(last, first);
    for (size_t i = 0; i < *n; i++)
        time[i] = first * pow(last / first, (double)i / (double)(*n - 1));
    return time;
}

void layer_energy_clear(layer_energy *energy)
{
    wt_energy_source_clear(&energy->source);
}

/* Ratio of the effective power to that of the hysteresis. */
static double power_factor(const wt_layer_job *job, const layer_energy *e)
{
    const double shear = job->energy == WT_LAYER_HYSTERESIS ? 0 : e->shear_power;
    const double hysteresis = job->energy == WT_LAYER_SHEAR ? 0 : e->hysteresis_power;
    return (hysteresis + shear) / e->hysteresis_power;
}

/* Computes friction, contact area and the power of shearing. */
static wt_status compute_contact_area(const wt_layer_job *job, const sliding_contact *c,
                                      double velocity, wt_layer_state layer, layer_energy *e,
                                      wt_error *err)
{
    const wt_status status =
        wt_friction_compute(c->workspace, c->pressure, &velocity, 1, &e->point, err);
    if (status != WT_OK)
        return status;
    const double area = e->point.area_ratio.value;
    e->shear_power = wt_layer_shear_stress(&job->shear, c->shear_stress,
                                           sliding_layer_at_shear_rate(c, layer, velocity)) *
                     area * fabs(velocity);
    return WT_OK;
}

wt_status layer_energy_compute(const wt_sliding *sliding, const wt_layer_job *job,
                               const sliding_contact *contact, double velocity,
                               wt_layer_state layer, layer_energy *energy, wt_error *err)
{
    layer_energy e = {.shear_power = (double)NAN};
    if (job->energy != WT_LAYER_HYSTERESIS && isnan(sliding->shear_stress.value)) {
        wt_fail(err, WT_E_MISSING, "what shearing the surface costs is not known");
        wt_error_expected(err, "shear-stress, as energy-from is not hysteresis");
        wt_error_advice(err, "give the shear stress of the real contact, such as 5MPa");
        return WT_E_MISSING;
    }
    wt_status status = wt_energy_source_from_friction(contact->workspace, contact->pressure,
                                                      velocity, &e.source, err);
    if (status == WT_OK && job->energy != WT_LAYER_HYSTERESIS)
        status = compute_contact_area(job, contact, velocity, layer, &e, err);
    e.source.profile = job->profile;
    e.source.local_friction = job->local_friction;
    for (size_t i = 0; i < e.source.n; i++)
        e.hysteresis_power += e.source.power[i];
    if (status == WT_OK && job->energy != WT_LAYER_HYSTERESIS) {
        const double factor = power_factor(job, &e);
        if (!isfinite(factor))
            status = wt_fail(err, WT_E_RANGE,
                             "shearing goes as deep as the hysteresis, of which there is none");
        for (size_t i = 0; i < e.source.n; i++)
            e.source.power[i] *= factor;
        e.source.numerical_error += e.point.area_ratio.numerical_error / e.point.area_ratio.value;
    }
    if (status == WT_OK)
        *energy = e;
    else
        layer_energy_clear(&e);
    return status;
}

wt_layer_parameters layer_parameters_create(const wt_layer_job *job, const sliding_contact *contact,
                                            double velocity, uint64_t seed, size_t replicate)
{
    wt_layer_parameters p = wt_layer_defaults();
    p.damage = job->damage;
    p.duty = job->duty;
    p.start_thickness = job->start_thickness;
    p.incubation = job->incubation;
    p.skip_numerical_errors = replicate != WT_NO_REPLICATE;
    p.pressure = contact->pressure;
    p.velocity = velocity;
    p.severity_power = job->severity_power;
    p.severity_exponent = job->severity_exponent;
    p.specific_wear_rate =
        flow_draw_positive(job->specific_wear_rate, seed, replicate, FLOW_DRAW_WEAR);
    p.critical_energy =
        flow_draw_positive(job->critical_energy, seed, replicate, FLOW_DRAW_CRITICAL_ENERGY);
    return p;
}
