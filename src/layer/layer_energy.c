/* A layer in one sliding contact: energy that modifies the rubber (hysteresis, shearing of the
 * surface or both), operating point, friction on the layer and default times.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/layer_energy.h"
#include "core/table/registry.h"
#include "job/random_draws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* State of a layer with the modulus of the context. */
static wt_layer_state layer_state(const layer_context *context, double thickness)
{
    return thickness > 0 ? (wt_layer_state){.thickness = thickness,
                                            .modulus_ratio = context->modulus_ratio,
                                            .slope = context->slope}
                         : (wt_layer_state){.modulus_ratio = 1};
}

static void set_total(const layer_context *context, double thickness, layer_friction *f)
{
    const double ratio = thickness > 0 && !context->bulk_shear ? f->ratio : 1;
    f->total = f->hysteresis + f->bulk_stress * ratio * f->area_ratio / f->pressure;
}

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
        const wt_status status =
            layer_compute_friction(f->context, exp(f->log_thickness[i]), &at, err);
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
    const wt_layer_state layer = layer_state(model->context, thickness);
    *f = (layer_friction){unknown, unknown, unknown, unknown, unknown, unknown};
    if (!isfinite(thickness))
        return WT_OK;
    if (model->n == 0 || !(thickness > 0))
        return layer_compute_friction(model->context, thickness, f, err);
    const double *const at = model->log_thickness;
    const double x = fmin(fmax(log(thickness), at[0]), at[model->n - 1]);
    f->hysteresis = akima_curve_value(model->curve[NODE_HYSTERESIS], x);
    f->area_ratio = akima_curve_value(model->curve[NODE_AREA], x);
    f->bulk_stress = akima_curve_value(model->curve[NODE_BULK_STRESS], x);
    f->pressure = model->pressure;
    f->ratio = layer.slope.exponent != 0 ? akima_curve_value(model->curve[NODE_MODULUS_RATIO], x)
                                         : layer.modulus_ratio;
    set_total(model->context, thickness, f);
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

/* Creates the contact of a context at the velocity of the wear. */
static wt_status create_contact(const layer_context *context, wt_layer_state layer,
                                double *velocity, sliding_contact *c, wt_error *err)
{
    wt_sliding s = *context->sliding;
    wt_job local_job = *context->work;
    local_job.left_out = WT_EXTRA_ALL;
    *velocity = layer_sliding_velocity(context->sliding, context->job);
    s.velocity = velocity;
    s.n_velocity = 1;
    s.reference_velocity = *velocity;
    return sliding_contact_create(&s, &local_job, context->replicate, context->drawn, layer, c,
                                  err);
}

wt_status layer_compute_energy(const layer_context *context, layer_energy *energy,
                               wt_layer_parameters *parameters, wt_error *err)
{
    double velocity;
    sliding_contact c = {0};
    wt_status status = create_contact(context, layer_state(context, 0), &velocity, &c, err);
    if (status == WT_OK)
        status = layer_energy_compute(context->sliding, context->job, &c, velocity, energy, err);
    if (status == WT_OK)
        *parameters = layer_parameters_create(context->job, &c, velocity, context->work->seed,
                                              context->replicate);
    sliding_contact_clear(&c);
    return status;
}

wt_status layer_compute_friction(const layer_context *context, double thickness,
                                 layer_friction *friction, wt_error *err)
{
    double velocity;
    wt_friction_point p;
    sliding_contact c = {0};
    const wt_layer_state layer = layer_state(context, thickness);
    wt_status status = create_contact(context, layer, &velocity, &c, err);
    if (status == WT_OK)
        status = wt_friction_compute(c.workspace, c.pressure, &velocity, 1, &p, err);
    if (status == WT_OK) {
        *friction = (layer_friction){
            .hysteresis = p.hysteresis.value,
            .area_ratio = p.area_ratio.value,
            .bulk_stress = c.shear_stress,
            .pressure = c.pressure,
            .ratio = sliding_layer_at_shear_rate(&c, layer, velocity).modulus_ratio};
        set_total(context, thickness, friction);
    }
    sliding_contact_clear(&c);
    return status;
}

wt_status layer_job_calibrate(const layer_context *context, wt_layer_job *calibrated, wt_error *err)
{
    *calibrated = *context->job;
    if (isnan(context->job->observed_thickness.value))
        return WT_OK;
    layer_energy energy = {.source = {.n = 0}};
    wt_layer_parameters p;
    const wt_status status = layer_compute_energy(context, &energy, &p, err);
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
#define LEAST_OVER_LAST 1e-15 /* an incubation far below this is none */

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
    last = TIME_SPAN * fmax(last, first / 2);
    first = fmax(first / 2, LEAST_OVER_LAST * last);
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
static wt_status compute_contact_area(const sliding_contact *c, double velocity, layer_energy *e,
                                      wt_error *err)
{
    const wt_status status =
        wt_friction_compute(c->workspace, c->pressure, &velocity, 1, &e->point, err);
    if (status != WT_OK)
        return status;
    e->shear_power = c->shear_stress * e->point.area_ratio.value * fabs(velocity);
    return WT_OK;
}

wt_status layer_energy_compute(const wt_sliding *sliding, const wt_layer_job *job,
                               const sliding_contact *contact, double velocity,
                               layer_energy *energy, wt_error *err)
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
        status = compute_contact_area(contact, velocity, &e, err);
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

double layer_replicates_add(replicates *r, const wt_sliding *sliding, const wt_layer_job *job)
{
    replicates_add(r, job->specific_wear_rate.standard_error, FLOW_DRAW_WEAR, "specific wear rate");
    const bool calibrated = !isnan(job->observed_thickness.value);
    const double given =
        (calibrated ? job->observed_thickness : job->critical_energy).standard_error;
    replicates_add(r, given, calibrated ? FLOW_DRAW_OBSERVED : FLOW_DRAW_CRITICAL_ENERGY,
                   calibrated ? "observed thickness" : "critical energy");
    if (job->energy != WT_LAYER_HYSTERESIS)
        replicates_add(r, sliding->shear_stress.standard_error, FLOW_DRAW_SHEAR_STRESS,
                       error_source_text(SOURCE_SHEAR_STRESS));
    return given;
}

wt_layer_parameters layer_parameters_create(const wt_layer_job *job, const sliding_contact *contact,
                                            double velocity, uint64_t seed, size_t replicate)
{
    wt_layer_parameters p = wt_layer_defaults();
    p.duty = job->duty;
    p.incubation = job->incubation;
    p.skip_numerical_errors = replicate != WT_NO_REPLICATE;
    p.pressure = contact->pressure;
    p.velocity = velocity;
    p.specific_wear_rate =
        flow_draw_positive(job->specific_wear_rate, seed, replicate, FLOW_DRAW_WEAR);
    p.critical_energy =
        flow_draw_positive(job->critical_energy, seed, replicate, FLOW_DRAW_CRITICAL_ENERGY);
    return p;
}
