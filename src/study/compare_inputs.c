/* Contributions to the ratio of track and bulk by calibration and temperature. Errors shared by
 * both groups cancel; separate errors enter the interval.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/rubber.h"
#include "indentation/law/tip.h"
#include "study/compare.h"

#include "core/base/text.h"
#include "core/math/students_t.h"

#include <math.h>
#include <string.h>

/* Draws of the material for the error of its change with temperature and rate, which is then known
 * to 9 %. */
enum { DRAWS = 64 };

/* Adds a variance to that of the offset. An unknown error is named. */
static void add_offset_error(comparison_inputs *k, double error, const char *words)
{
    if (isnan(error))
        clocale_append(k->lacks, sizeof k->lacks, "%s%s", k->lacks[0] != '\0' ? ", " : "", words);
    if (isnan(error) || error > 0)
        clocale_append(k->includes, sizeof k->includes, "%s%s",
                       isnan(error) ? ", but not, for it is not known: " : ", ", words);
    if (error > 0)
        k->offset.standard_error = hypot(k->offset.standard_error, error);
}

static void cancel_error(comparison_inputs *k, const char *words)
{
    clocale_append(k->cancels, sizeof k->cancels, "%s%s", k->cancels[0] != '\0' ? ", " : "", words);
}

static bool has_two_cantilevers(const compare_pair *p, wt_cantilever_sharing cantilevers)
{
    const double bulk = p->data[0].spring_constant.value, track = p->data[1].spring_constant.value;
    if (cantilevers != WT_CANTILEVERS_AUTO)
        return cantilevers == WT_CANTILEVERS_SEPARATE;
    if (p->data[0].has_tip && p->data[1].has_tip && tips_differ(&p->data[0].tip, &p->data[1].tip))
        return true;
    if (p->data[0].has_several_tips ||
        p->data[1].has_several_tips) /* even if both lists are equal */
        return true;
    return p->data[0].has_several_cantilevers || p->data[1].has_several_cantilevers ||
           fabs(track - bulk) > 1e-9 * fabs(bulk);
}

/* Relative error of one source, stated or assumed, and the gain of ln E; NaN if there is none. */
typedef struct calibration_error {
    double error, gain;
    bool is_stated;
} calibration_error;

static calibration_error group_calibration(const wt_group_data *d, const wt_compare_job *job,
                                           wt_systematic_source source)
{
    const double stated[WT_SYSTEMATIC_SOURCES] = {[WT_SYSTEMATIC_SPRING_CONSTANT] =
                                                      d->spring_constant.standard_error /
                                                      d->spring_constant.value};
    const double given[WT_SYSTEMATIC_SOURCES] = {[WT_SYSTEMATIC_SPRING_CONSTANT] = job->lever_error,
                                                 [WT_SYSTEMATIC_SENSITIVITY] =
                                                     job->sensitivity_error};
    const double usual[WT_SYSTEMATIC_SOURCES] = {
        [WT_SYSTEMATIC_SPRING_CONSTANT] = 1,      [WT_SYSTEMATIC_SENSITIVITY] = d->sensitivity_gain,
        [WT_SYSTEMATIC_HALF_ANGLE] = (double)NAN, [WT_SYSTEMATIC_RADIUS] = (double)NAN,
        [WT_SYSTEMATIC_PIEZO] = (double)NAN,      [WT_SYSTEMATIC_DETECTOR] = (double)NAN};
    calibration_error c = {d->common_error[source], d->common_gain[source].value, true};
    if (!(c.error > 0))
        c.error = stated[source] > 0 ? stated[source] : given[source];
    c.is_stated = c.error > 0;
    if (!c.is_stated && d->assumed_error[source] > 0)
        c.error = d->assumed_error[source];
    if (isnan(c.gain))
        c.gain = usual[source];
    return c;
}

static bool has_tip_error(const wt_group_data *d)
{
    const double *const common = d->common_error, *const assumed = d->assumed_error;
    return common[WT_SYSTEMATIC_HALF_ANGLE] > 0 || common[WT_SYSTEMATIC_RADIUS] > 0 ||
           assumed[WT_SYSTEMATIC_HALF_ANGLE] > 0 || assumed[WT_SYSTEMATIC_RADIUS] > 0;
}

double compare_mean(const double *values, size_t n)
{
    double sum = 0, known = 0;
    for (size_t i = 0; i < n; i++)
        if (isfinite(values[i])) {
            sum += values[i];
            known++;
        }
    return known > 0 ? sum / known : (double)NAN;
}

/* With one cantilever, tip, piezo and sample their errors apply to both groups, and the difference
 * of the gains remains, or of the effects if the errors depend on the range of the curves. The
 * spring constant enters both moduli with the same power and cancels. */
static void add_calibration_error(const compare_pair *p, const wt_compare_job *job,
                                  wt_systematic_source source, bool separate, const char *words,
                                  comparison_inputs *k)
{
    calibration_error bulk = group_calibration(&p->data[0], job, source),
                      track = group_calibration(&p->data[1], job, source);
    if (!separate && bulk.is_stated != track.is_stated) /* one source: what is stated of it holds */
        *(bulk.is_stated ? &track.error : &bulk.error) = bulk.is_stated ? bulk.error : track.error;
    if (source == WT_SYSTEMATIC_THICKNESS) { /* one thickness, sufficient for the deeper curves */
        const double depth[2] = {compare_mean(p->data[0].max_indentation, p->data[0].group.n),
                                 compare_mean(p->data[1].max_indentation, p->data[1].group.n)};
        bulk.error *= fmin(1, depth[0] / depth[1]);
        track.error *= fmin(1, depth[1] / depth[0]);
    }
    const double of_bulk = bulk.error > 0 ? bulk.gain * bulk.error : 0,
                 of_track = track.error > 0 ? track.gain * track.error : 0;
    if (separate) {
        add_offset_error(k, hypot(of_bulk, of_track), words);
        return;
    }
    const double error = fmax(bulk.error > 0 ? bulk.error : 0, track.error > 0 ? track.error : 0);
    if (!(error > 0))
        return;
    cancel_error(k, words);
    if (source >= WT_SYSTEMATIC_PIEZO)
        add_offset_error(k, fabs(of_track - of_bulk), words);
    else if (source != WT_SYSTEMATIC_SPRING_CONSTANT)
        add_offset_error(k, fabs(track.gain - bulk.gain) * error, words);
}

static void add_calibration_errors(const compare_pair *p, const wt_compare_job *job,
                                   comparison_inputs *k)
{
    const wt_group_data *bulk = &p->data[0], *track = &p->data[1];
    k->has_two_cantilevers = has_two_cantilevers(p, job->cantilevers);
    /* a remounted cantilever was calibrated again */
    const double s[2] = {bulk->sensitivity.value, track->sensitivity.value};
    const bool anew = bulk->has_several_sensitivities || track->has_several_sensitivities ||
                      (!isnan(s[0]) && !isnan(s[1]) && s[0] != s[1]);
    add_calibration_error(p, job, WT_SYSTEMATIC_SENSITIVITY, k->has_two_cantilevers || anew,
                          "deflection sensitivity", k);
    add_calibration_error(p, job, WT_SYSTEMATIC_SPRING_CONSTANT, k->has_two_cantilevers,
                          "spring constants", k);
    add_calibration_error(p, job, WT_SYSTEMATIC_PIEZO, false, "bend of the piezo", k);
    add_calibration_error(p, job, WT_SYSTEMATIC_DETECTOR, k->has_two_cantilevers || anew,
                          "nonlinearity of the detector", k);
    add_calibration_error(p, job, WT_SYSTEMATIC_THICKNESS, false, "thickness of the sample", k);
    if (has_tip_error(bulk) || has_tip_error(track)) {
        add_calibration_error(p, job, WT_SYSTEMATIC_HALF_ANGLE, k->has_two_cantilevers,
                              "half-angle of the tip", k);
        add_calibration_error(p, job, WT_SYSTEMATIC_RADIUS, k->has_two_cantilevers,
                              "radius of the tip", k);
    } else if (job->tip_error > 0) {
        if (k->has_two_cantilevers)
            add_offset_error(k, job->tip_error * M_SQRT2, "tips");
        else
            cancel_error(k, "tip");
    }
    if (!k->has_two_cantilevers)
        return;
    for (int g = 0; g < 2; g++)
        if (!group_calibration(&p->data[g], job, WT_SYSTEMATIC_SPRING_CONSTANT).is_stated)
            k->lacks_spring_constant_error = true;
}

/* Adds errors that the curves show, but that the scatter does not. The piezo curvature and the tip
 * shape are shared by both groups. The spectra of bulk and track may differ. */
static void add_curve_errors(const compare_pair *p, comparison_inputs *k)
{
    double loss[2], bend[2], range[2];
    for (int g = 0; g < 2; g++) {
        const wt_group_data *d = &p->data[g];
        loss[g] = p->by_factor ? 0 : d->loss_error;
        bend[g] = d->bend_error;
        range[g] = d->range_error;
    }
    const double of_loss = hypot(loss[0], loss[1]),
                 of_bend =
                     k->has_two_cantilevers ? hypot(bend[0], bend[1]) : fabs(bend[1] - bend[0]),
                 of_range =
                     k->has_two_cantilevers ? hypot(range[0], range[1]) : fabs(range[1] - range[0]);
    k->loss_and_curvature_error = hypot(hypot(of_loss, of_bend), of_range);
    k->lacks_loss_effect = isnan(of_loss);
    k->lacks_second_range = isnan(of_range);
    add_offset_error(k, of_loss, "loss of unknown spectrum");
    add_offset_error(k, of_bend, "bend of the baselines");
    add_offset_error(k, of_range, "range of the fit");
}

/* ---- temperature and rate -------------------------------------------------------------------- */

/* Geometric mean of the equivalent frequencies; NaN if unknown. */
static double mean_frequency(const wt_group_data *d)
{
    double sum = 0;
    for (size_t i = 0; i < d->group.n; i++)
        sum += log(d->equivalent_frequency[i]);
    return exp(sum / (double)d->group.n);
}

static wt_status log_modulus(const wt_rubber *rubber, material_state at, uint64_t seed,
                             size_t replicate, double *value, wt_error *err)
{
    wt_material *material = NULL;
    double storage, loss;
    wt_status status =
        wt_rubber_material(rubber, at.temperature, seed, replicate, &material, NULL, err);
    if (status != WT_OK)
        return status;
    material->law->modulus(material, &at.frequency, 1, &storage, &loss);
    *value = log(hypot(storage, loss));
    wt_material_free(material);
    return WT_OK;
}

wt_status compare_material(const wt_rubber *rubber, const material_state *at, int n_at,
                           const wt_job *work, wt_estimate *value, wt_error *err)
{
    double sum = 0;
    size_t n = 0;
    for (size_t i = 0; i <= DRAWS; i++) {
        const size_t replicate = i == 0 ? WT_NO_REPLICATE : i - 1;
        double y = 0, one = 0;
        wt_status status = WT_OK;
        for (int g = 0; status == WT_OK && g < n_at; g++) {
            status = log_modulus(rubber, at[g], work->seed, replicate, &one, i == 0 ? err : NULL);
            y = one - y;
        }
        if (status != WT_OK && i == 0)
            return status;
        if (i == 0) {
            value->value = y;
        } else if (status == WT_OK && isfinite(y)) {
            sum += (y - value->value) * (y - value->value);
            n++;
        }
    }
    value->standard_error = sum > 0 ? sqrt(sum / (double)n) : (double)NAN;
    return WT_OK;
}

wt_status compare_temperature_error(const wt_rubber *rubber, material_state at, double error,
                                    const wt_job *work, double *relative, wt_error *err)
{
    double y[2] = {0, 0};
    wt_status status = WT_OK;
    const double below = at.temperature - error;
    *relative = 0;
    if (!(error > 0))
        return WT_OK;
    for (int i = 0; status == WT_OK && i < 2; i++) {
        at.temperature = below + 2 * error * i;
        if (!(at.temperature > 0) || !flow_rubber_can_shift(rubber, at.temperature, NULL)) {
            *relative = (double)NAN;
            return WT_OK;
        }
        status = log_modulus(rubber, at, work->seed, WT_NO_REPLICATE, &y[i], err);
    }
    *relative = fabs(y[1] - y[0]) / 2;
    return status;
}

static bool is_within_shift_law(const wt_rubber *rubber, double temperature, comparison_inputs *k)
{
    wt_error why = WT_ERROR_INIT;
    if (rubber == NULL || flow_rubber_can_shift(rubber, temperature, &why))
        return true;
    clocale_print(k->unreachable_temperature, sizeof k->unreachable_temperature, "%.2f °C: %s",
                  temperature - WT_ZERO_CELSIUS, why.message);
    return false;
}

/* Corrects by the DMA from the condition of the bulk to that of the track. */
static wt_status add_dma(const compare_pair *p, const wt_compare_job *job, const wt_job *work,
                         bool by_temperature, double step_error, comparison_inputs *k,
                         wt_error *err)
{
    material_state at[2];
    for (int g = 0; g < 2; g++) {
        at[g].temperature = k->temperature[by_temperature ? g : 0];
        at[g].frequency = mean_frequency(&p->data[k->rates_by_dma ? g : 0]);
    }
    material_state neighbours[2] = {at[1], at[1]};
    neighbours[0].temperature -= 1;
    neighbours[1].temperature += 1;
    const bool needs_neighbours = by_temperature && step_error > 0 && job->rubber != NULL;
    if (!is_within_shift_law(job->rubber, at[0].temperature, k) ||
        !is_within_shift_law(job->rubber, at[1].temperature, k) ||
        (needs_neighbours && !is_within_shift_law(job->rubber, neighbours[0].temperature, k)))
        return WT_OK;
    wt_estimate change = {0, (double)NAN, 0, "1"};
    wt_status status = WT_OK;
    if (job->rubber != NULL)
        status = compare_material(job->rubber, at, 2, work, &change, err);
    k->offset.value += p->by_factor ? 0 : change.value; /* the factors do not depend on it */
    add_offset_error(k, change.standard_error, "material");
    if (status != WT_OK || !needs_neighbours)
        return status;
    status = compare_material(job->rubber, neighbours, 2, work, &change, err);
    add_offset_error(k, fabs(change.value / 2) * step_error, "temperatures");
    return status;
}

wt_status compare_temperature_slope(const compare_pair *p, const wt_compare_job *job,
                                    const wt_job *work, double *slope, wt_error *err)
{
    material_state at = {compare_temperature(job, 0).value, mean_frequency(&p->data[0])};
    double y[2] = {0, 0};
    wt_status status = WT_OK;
    *slope = 0;
    at.temperature -= 1;
    if (!(at.frequency > 0) || !flow_rubber_can_shift(job->rubber, at.temperature, NULL) ||
        !flow_rubber_can_shift(job->rubber, at.temperature + 2, NULL))
        return WT_OK;
    for (int i = 0; status == WT_OK && i < 2; i++, at.temperature += 2)
        status = log_modulus(job->rubber, at, work->seed, WT_NO_REPLICATE, &y[i], err);
    *slope = status == WT_OK && isfinite(y[1] - y[0]) ? (y[1] - y[0]) / 2 : 0;
    return status;
}

wt_status compare_group_with_dma(const compare_pair *p, int g, const wt_compare_job *job,
                                 const wt_job *work, wt_estimate *log_ratio, wt_error *err)
{
    const wt_estimate temperature = compare_temperature(job, g);
    const material_state at = {temperature.value, mean_frequency(&p->data[g])};
    wt_estimate dma;
    wt_group_summary group;
    double by_temperature = 0;
    *log_ratio = (wt_estimate){(double)NAN, (double)NAN, 0, "1"};
    if (!(at.frequency > 0) || !flow_rubber_can_shift(job->rubber, at.temperature, NULL))
        return WT_OK;
    wt_status status = compare_material(job->rubber, &at, 1, work, &dma, err);
    if (status == WT_OK)
        status = compare_temperature_error(job->rubber, at, temperature.standard_error, work,
                                           &by_temperature, err);
    if (status == WT_OK)
        status = wt_group_summarise(&p->data[g].group, &group, err);
    if (status != WT_OK)
        return status;
    const double curves =
        hypot(log(group.high / group.low) / (2 * NORMAL_95), p->data[g].loss_error);
    log_ratio->value = log(group.geometric_mean) - dma.value;
    log_ratio->standard_error = hypot(curves, hypot(dma.standard_error, by_temperature));
    return WT_OK;
}

wt_estimate compare_temperature(const wt_compare_job *job, int group)
{
    wt_estimate t = group == 1 && !isnan(job->track_temperature.value) ? job->track_temperature
                                                                       : job->temperature;
    if (isnan(t.value)) /* a default, which the caveats name */
        t = (wt_estimate){job->rubber->prony.reference_temperature, 0, 0, "K"};
    if (!(t.standard_error > 0))
        t.standard_error = 0;
    return t;
}

static wt_status add_conditions(const compare_pair *p, const wt_compare_job *job,
                                const wt_job *work, comparison_inputs *k, wt_error *err)
{
    const wt_estimate slope = job->temperature_slope;
    wt_estimate bulk = job->temperature;
    if (isnan(bulk.value) && job->rubber != NULL) {
        bulk.value = job->rubber->prony.reference_temperature;
        bulk.standard_error = 0; /* a default, which the caveats name */
    }
    const bool apart = !isnan(job->track_temperature.value);
    const wt_estimate track = apart ? job->track_temperature : bulk;
    const double step = track.value - bulk.value;
    const double step_error = apart ? hypot(bulk.standard_error, track.standard_error) : 0;
    const bool has_dma =
        p->by_factor || (job->rubber != NULL && isfinite(mean_frequency(&p->data[0])) &&
                         isfinite(mean_frequency(&p->data[1])));
    const bool warmer = apart && (step != 0 || step_error > 0);
    k->temperature[0] = bulk.value;
    k->temperature[1] = track.value;
    if (apart && isnan(bulk.value)) {
        k->lacks_temperature_effect = true;
    } else if (warmer && !isnan(slope.value)) {
        k->offset.value += slope.value * step;
        add_offset_error(k, hypot(slope.value * step_error, slope.standard_error * step),
                         "temperatures");
    } else if (warmer && !has_dma) {
        k->lacks_temperature_effect = step != 0;
    }
    const bool by_dma = warmer && isnan(slope.value) && !k->lacks_temperature_effect && has_dma;
    k->rates_by_dma = k->rates_by_dma && has_dma;
    if (by_dma || k->rates_by_dma)
        return add_dma(p, job, work, by_dma, step_error, k, err);
    return WT_OK;
}

wt_status comparison_find_inputs(const compare_pair *p, const wt_compare_job *job,
                                 const wt_job *work, bool rates_by_dma, comparison_inputs *inputs,
                                 wt_error *err)
{
    *inputs = (comparison_inputs){.offset = {0, 0, 0, "1"}, .rates_by_dma = rates_by_dma};
    add_calibration_errors(p, job, inputs);
    add_curve_errors(p, inputs);
    return add_conditions(p, job, work, inputs, err);
}
