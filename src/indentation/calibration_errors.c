/* Propagation of errors that all curves share to their moduli. A few curves are fitted again with a
 * source shifted down and up by one standard error. The method assumes no exponent of a contact
 * law. A source without a stated error has an assumed one, because no residual and no scatter shows
 * it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/calibration_errors.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/data/force_curve.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "indentation/indent.h"
#include "indentation/law/tip.h"
#include "indentation/numerics/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *calibration_source_text(wt_systematic_source source)
{
    static const char *const words[WT_SYSTEMATIC_SOURCES] = {
        [WT_SYSTEMATIC_SPRING_CONSTANT] = "spring constant",
        [WT_SYSTEMATIC_SENSITIVITY] = "deflection sensitivity",
        [WT_SYSTEMATIC_HALF_ANGLE] = "half-angle of the tip",
        [WT_SYSTEMATIC_RADIUS] = "radius of the tip",
        [WT_SYSTEMATIC_PIEZO] = "bend of the piezo",
        [WT_SYSTEMATIC_DETECTOR] = "nonlinearity of the detector",
        [WT_SYSTEMATIC_THICKNESS] = "thickness of the sample"};
    return words[source];
}

/* Relative shift of a source without a stated error, and upper limit of each shift. A curve may no
 * longer be accepted after a larger shift. */
static const double default_step = 0.01, max_step = 0.3;

/* Relative standard errors of sources for which none is stated. They are assumptions about usual
 * practice, not limits: 10 % for a spring constant by thermal noise (te Riet et al.,
 * Ultramicroscopy 111 (2011) 1659, compare the methods between laboratories), and a few per cent
 * for the slope on a hard sample. Manufacturers state half-angles within +-2 degrees, which is
 * taken as two standard errors. Radii of spheres are stated within 10 %; a sharp tip after use is
 * not known any better. */
static const double assumed_spring_constant = 0.1, assumed_sensitivity = 0.03,
                    assumed_half_angle = M_PI / 180, assumed_radius = 0.1;

/* Bend of the height over the travel of the approach. A piezo without a sensor has a hysteresis of
 * 10 to 15 % over its whole range, by Rayleigh's law a tenth of it over a tenth of the range, and
 * half of the hysteresis is the bend of one direction. Data sheets state 0.1 % with a sensor. */
static const double assumed_bend = 0.005, assumed_sensor_bend = 0.001;

/* A Gaussian spot on a split detector gives the error function, which lacks pi/12 (U/Um)^2 at the
 * signal U (Thormann et al., Rev. Sci. Instrum. 80 (2009) 093701, measure such a shape). This is
 * taken as two standard errors. Um is the usual full range [V]; files without a sensitivity have a
 * usual one [m/V]. Practice stays below half of the range. */
static const double detector_range = 10, usual_sensitivity = 50e-9, largest_signal = 0.5;

/* A sample counts as thick from ten depths and contact radii on (Bueckle's rule). This limit is
 * taken as two standard errors. */
static const double assumed_shallowness = 0.05;

/* Relative standard error of a stated thickness, as that of the radius. */
static const double assumed_thickness = 0.1;

/* Shift of the linearity of piezo and detector. Their effect is linear, and a smaller shift is lost
 * in the tolerance of a fit. */
static const double linearity_step = 0.01;

static double stated_relative_error(double value, double error)
{
    return error > 0 ? error / value : (double)NAN;
}

static double first_stated(double a, double b)
{
    return isnan(a) && b > 0 ? b : a;
}

static wt_tip shifted_tip(const wt_tip *tip, wt_systematic_source source, double factor)
{
    wt_tip shifted = *tip;
    /* A cap with the default transition has that of the shifted tip. */
    const bool is_default =
        tip->transition_radius > 0 &&
        tip->transition_radius == tip_default_transition(tip->radius, tip->half_angle, tip->sides);
    *(source == WT_SYSTEMATIC_THICKNESS ? &shifted.sample_thickness.value
      : source == WT_SYSTEMATIC_RADIUS  ? &shifted.radius
                                        : &shifted.half_angle) *= factor;
    /* A larger transition radius would make the tip concave. */
    const double largest =
        tip_largest_transition(shifted.radius, shifted.half_angle, shifted.sides);
    if (is_default)
        shifted.transition_radius =
            tip_default_transition(shifted.radius, shifted.half_angle, shifted.sides);
    else if (tip->transition_radius > 0)
        shifted.transition_radius = fmin(tip->transition_radius, largest);
    shifted.half_angle_error = shifted.radius_error = 0;
    return shifted;
}

void calibration_errors_begin(const wt_indent_job *job, calibration_errors *to)
{
    const wt_tip *tip = &job->tip;
    const bool is_thin = tip->sample_thickness.value > 0;
    const wt_estimate k = job->spring_constant, s = job->sensitivity;
    *to = (calibration_errors){
        .error = {[WT_SYSTEMATIC_SPRING_CONSTANT] = first_stated(
                      stated_relative_error(k.value, k.standard_error), job->lever_error),
                  [WT_SYSTEMATIC_SENSITIVITY] = first_stated(
                      stated_relative_error(s.value, s.standard_error), job->sensitivity_error),
                  [WT_SYSTEMATIC_HALF_ANGLE] =
                      stated_relative_error(tip->half_angle, tip->half_angle_error),
                  [WT_SYSTEMATIC_RADIUS] = stated_relative_error(tip->radius, tip->radius_error),
                  [WT_SYSTEMATIC_PIEZO] = first_stated((double)NAN, job->piezo_error),
                  [WT_SYSTEMATIC_DETECTOR] = first_stated((double)NAN, job->detector_error),
                  [WT_SYSTEMATIC_THICKNESS] = stated_relative_error(
                      tip->sample_thickness.value, tip->sample_thickness.standard_error)},
        .assumed = {[WT_SYSTEMATIC_SPRING_CONSTANT] = assumed_spring_constant,
                    [WT_SYSTEMATIC_SENSITIVITY] = assumed_sensitivity,
                    [WT_SYSTEMATIC_HALF_ANGLE] = assumed_half_angle / tip->half_angle,
                    [WT_SYSTEMATIC_RADIUS] = assumed_radius,
                    [WT_SYSTEMATIC_PIEZO] = assumed_sensor_bend,
                    [WT_SYSTEMATIC_THICKNESS] = is_thin ? assumed_thickness : assumed_shallowness},
        .active = true,
        .stride = 1};
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++) {
        to->stated = to->stated || to->error[i] > 0;
        if (to->error[i] > 0)
            to->assumed[i] = (double)NAN;
        to->step[i] = fmin(to->error[i] > 0 ? to->error[i] : default_step, max_step);
    }
    to->step[WT_SYSTEMATIC_PIEZO] = to->step[WT_SYSTEMATIC_DETECTOR] = linearity_step;
    if (!is_thin) /* from thin to thick */
        to->step[WT_SYSTEMATIC_THICKNESS] = job->thick_sample ? 0 : assumed_shallowness / 2;
    if (!(tip->half_angle > 0))
        to->step[WT_SYSTEMATIC_HALF_ANGLE] = 0;
    if (!(tip->radius > 0))
        to->step[WT_SYSTEMATIC_RADIUS] = 0;
    while (tip->half_angle * exp(to->step[WT_SYSTEMATIC_HALF_ANGLE]) >= M_PI_2)
        to->step[WT_SYSTEMATIC_HALF_ANGLE] /= 2;
}

static void clear_common_curve(common_curve *curve)
{
    for (int i = 0; i < 2; i++)
        free(curve->branch[i].height);
    *curve = (common_curve){0};
}

void calibration_errors_clear(calibration_errors *errors)
{
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES; i++)
        for (int side = 0; side < 2; side++)
            wt_contact_table_free(errors->tip[i][side]);
    for (size_t i = 0; i < errors->n; i++)
        clear_common_curve(&errors->curve[i]);
    *errors = (calibration_errors){0};
}

/* ---- curves ---------------------------------------------------------------------------------- */

static void copy_branch(const wt_force_curve *curve, wt_segment_kind kind, common_branch *to)
{
    const wt_segment *segment = wt_force_curve_segment(curve, kind);
    if (segment == NULL || segment->n_points == 0)
        return;
    const size_t n = segment->n_points, bytes = n * sizeof(double);
    double *store = wt_alloc(3, bytes);
    *to = (common_branch){.height = store, .force = store + n};
    const double *height = segment_height(segment),
                 *force = segment_force(segment, &curve->cantilever, to->force),
                 *time = segment_time(segment, store + 2 * n);
    if (height == NULL || force == NULL)
        return;
    memcpy(to->height, height, bytes);
    memmove(to->force, force, bytes);
    if (time != NULL)
        to->time = memmove(store + 2 * n, time, bytes);
    to->n = n;
}

/* Keeps every second curve. The remaining curves are those that twice the stride selects from the
 * start. */
static void halve_curves(calibration_errors *to)
{
    size_t stored = 0;
    for (size_t i = 0; i < to->n; i++)
        if (i % 2 == 0)
            to->curve[stored++] = to->curve[i];
        else
            clear_common_curve(&to->curve[i]);
    to->n = stored;
    to->stride *= 2;
}

/* Assumes the largest error of the linearity among the stored curves, where none is stated. */
static void assume_linearity(calibration_errors *to, const wt_force_curve *curve,
                             const wt_indent_fit *fit)
{
    const wt_segment *approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    double *const piezo = &to->assumed[WT_SYSTEMATIC_PIEZO],
                  *const detector = &to->assumed[WT_SYSTEMATIC_DETECTOR];
    const double stated = curve->cantilever.sensitivity,
                 sensitivity = stated > 0 ? stated : usual_sensitivity,
                 deflection = fit->max_force / curve->cantilever.spring_constant,
                 signal = fmin(deflection / sensitivity / detector_range, largest_signal);
    if (*piezo > 0 &&
        (approach == NULL || wt_segment_channel(approach, WT_Q_MEASURED_HEIGHT) == NULL))
        *piezo = assumed_bend;
    if (!isnan(*detector) && deflection > 0)
        *detector = fmax(*detector, M_PI / 24 * signal * signal);
}

void calibration_errors_store(calibration_errors *to, const wt_force_curve *curve,
                              const wt_indent_fit *fit, const wt_contact_table *contact)
{
    if (!to->active || to->n_offered++ % to->stride != 0)
        return;
    if (to->n == (to->stated ? COMMON_CURVES : ASSUMED_CURVES)) {
        halve_curves(to);
        if ((to->n_offered - 1) % to->stride != 0)
            return;
    }
    common_curve *stored = &to->curve[to->n++];
    assume_linearity(to, curve, fit);
    to->deepest = fmax(to->deepest, fit->max_indentation);
    *stored = (common_curve){.spring_constant = curve->cantilever.spring_constant,
                             .sensitivity_gain = fit->sensitivity_gain,
                             .baseline_offset = fit->baseline_offset.value,
                             .max_force = fit->max_force,
                             .contact = contact,
                             .without_adhesion = isnan(fit->work_of_adhesion.value) &&
                                                 isnan(fit->contact_pull.value)};
    copy_branch(curve, WT_SEGMENT_APPROACH, &stored->branch[0]);
    copy_branch(curve, WT_SEGMENT_RETRACT, &stored->branch[1]);
}

/* ---- fits ------------------------------------------------------------------------------------ */

/* Smallest depth of the tables, below the noise of an AFM [m], and their largest one over the
 * deepest indentation. Others take longer, but have no error. */
static const double least_depth = 1e-11, depth_reserve = 4;

/* Creates the contact tables of the shifted tips and of the assumed thickness, for the depths of
 * the stored curves. */
static wt_status create_shifted_tables(calibration_errors *to, const wt_tip *tip,
                                       const wt_indent_options *options, wt_error *err)
{
    static const wt_systematic_source dimensions[] = {
        WT_SYSTEMATIC_HALF_ANGLE, WT_SYSTEMATIC_RADIUS, WT_SYSTEMATIC_THICKNESS};
    const bool is_thin = tip->sample_thickness.value > 0;
    wt_status status = WT_OK;
    for (size_t i = 0; i < (is_thin ? 3u : 2u); i++) {
        const wt_systematic_source source = dimensions[i];
        for (int side = 0; status == WT_OK && to->step[source] > 0 && side < 2; side++) {
            const wt_tip shifted = shifted_tip(tip, source, exp((2 * side - 1) * to->step[source]));
            status = wt_contact_table_new(&shifted, least_depth, depth_reserve * to->deepest,
                                          &to->tip[source][side], err);
        }
    }
    if (is_thin)
        return status;
    double g, slope;
    wt_tip thin = *tip;
    wt_contact_function(tip, to->deepest, &g, &slope);
    thin.sample_thickness.value = to->thickness =
        fmax(to->deepest, slope / 2) / assumed_shallowness;
    thin.unbonded = thin.unbonded || !indent_is_incompressible(options);
    if (status == WT_OK && to->step[WT_SYSTEMATIC_THICKNESS] > 0)
        status = wt_contact_table_new(&thin, least_depth, depth_reserve * to->deepest,
                                      &to->tip[WT_SYSTEMATIC_THICKNESS][0], err);
    if (status == WT_OK && to->step[WT_SYSTEMATIC_THICKNESS] > 0)
        status = wt_contact_table_new(tip, least_depth, depth_reserve * to->deepest,
                                      &to->tip[WT_SYSTEMATIC_THICKNESS][1], err);
    return status;
}

typedef struct refit {
    calibration_errors *to;
    const wt_indent_options *options;
    wt_indent_workspace *const *workspaces;
    double *scratch; /* shifted heights and forces, [2 capacity] for each thread */
    size_t capacity;
    wt_error *errors; /* one error for each item */
} refit;

/* Branch of a curve with a source shifted by a signed step; scratch: [2 n]. */
static curve_branch shift_branch(const common_curve *curve, const common_branch *b,
                                 wt_systematic_source source, double step, double *scratch)
{
    const common_branch *approach = &curve->branch[0];
    const double first = approach->n > 0 ? approach->height[0] : 0,
                 last = approach->n > 0 ? approach->height[approach->n - 1] : 0;
    const bool scales =
        source == WT_SYSTEMATIC_SPRING_CONSTANT || source == WT_SYSTEMATIC_SENSITIVITY;
    const double factor = scales ? exp(step) : 1,
                 bend = source == WT_SYSTEMATIC_PIEZO ? 4 * step / (last - first) : 0,
                 lack = source == WT_SYSTEMATIC_DETECTOR
                            ? step / (curve->max_force * curve->max_force)
                            : 0;
    double *height = scratch, *force = scratch + b->n;
    for (size_t i = 0; i < b->n; i++) {
        const double z = b->height[i], f = b->force[i] - curve->baseline_offset;
        height[i] = z + bend * (z - first) * (last - z);
        force[i] = factor * b->force[i] + lack * f * f * f;
    }
    return (curve_branch){height, force, b->time, b->n};
}

/* Computes the logarithm of the modulus of a curve with a shifted source. The source changes
 * heights, forces or the law. A fit that no longer passes its tests counts as well. Adhesion has no
 * law on a thin sample, so a change of the thickness is without. */
static wt_status fit_shifted_source(const refit *f, size_t item, int side, unsigned worker,
                                    double *log_modulus)
{
    const calibration_errors *to = f->to;
    const wt_systematic_source source = (wt_systematic_source)(item % WT_SYSTEMATIC_SOURCES);
    const common_curve *curve = &to->curve[item / WT_SYSTEMATIC_SOURCES];
    const double step = (2 * side - 1) * to->step[source];
    double *scratch = f->scratch + worker * f->capacity;
    const curve_branch shifted[2] = {
        shift_branch(curve, &curve->branch[0], source, step, scratch),
        shift_branch(curve, &curve->branch[1], source, step, scratch + 2 * curve->branch[0].n)};
    const wt_contact_table *law = to->tip[source][side];
    wt_indent_workspace *workspace = f->workspaces[worker];
    wt_indent_fit fit;
    const wt_status status = curve_fit_branches(
        law != NULL ? law : curve->contact, f->options, &shifted[0], &shifted[1],
        curve->without_adhesion || source == WT_SYSTEMATIC_THICKNESS,
        curve->spring_constant * (source == WT_SYSTEMATIC_SPRING_CONSTANT ? exp(step) : 1),
        workspace, &fit, &f->errors[item]);
    if (status == WT_OK)
        *log_modulus = fit.modulus.value > 0 ? log(fit.modulus.value) : (double)NAN;
    return status;
}

/* Effect of an assumed error of the cantilever without a fit: force and cantilever scale together
 * with the spring constant, and the fit has the gain of the sensitivity. NaN without a cantilever.
 */
static void set_assumed_gain(const common_curve *curve, wt_systematic_source source, double *gain)
{
    if (curve->spring_constant > 0 && isfinite(curve->spring_constant))
        *gain = source == WT_SYSTEMATIC_SPRING_CONSTANT ? 1 : curve->sensitivity_gain;
}

/* Computes d ln E / d ln source from one step in each direction. The tip of a single file has the
 * relative errors of the tip of the group, and changes the modulus as that does. */
static wt_status measure_source_gain(void *user, size_t item, unsigned worker)
{
    const refit *f = user;
    calibration_errors *to = f->to;
    const size_t at = item / WT_SYSTEMATIC_SOURCES;
    const wt_systematic_source source = (wt_systematic_source)(item % WT_SYSTEMATIC_SOURCES);
    const bool is_of_cantilever =
        source == WT_SYSTEMATIC_SPRING_CONSTANT || source == WT_SYSTEMATIC_SENSITIVITY;
    const bool has_error = to->error[source] > 0 || to->assumed[source] > 0;
    /* one curve is enough for a usual linearity or thickness, whose effect need not be known well
     */
    const bool is_left_out = source >= WT_SYSTEMATIC_PIEZO && to->assumed[source] > 0 && at > 0;
    const double step = has_error && !is_left_out ? to->step[source] : 0;
    double log_modulus[2] = {0, 0};
    to->gain[at][source] = (double)NAN;
    if (!to->stated && is_of_cantilever) {
        set_assumed_gain(&to->curve[at], source, &to->gain[at][source]);
        return WT_OK;
    }
    for (int side = 0; side < 2 && step > 0; side++) {
        const wt_status status = fit_shifted_source(f, item, side, worker, &log_modulus[side]);
        if (status != WT_OK)
            return status;
    }
    if (step > 0)
        to->gain[at][source] = (log_modulus[1] - log_modulus[0]) / (2 * step);
    return WT_OK;
}

wt_status calibration_errors_fit(calibration_errors *to, const wt_tip *tip,
                                 const wt_indent_options *options, unsigned threads,
                                 wt_indent_workspace *const *workspaces, wt_error *err)
{
    const size_t n = to->n * WT_SYSTEMATIC_SOURCES;
    refit f = {.to = to, .options = options, .workspaces = workspaces};
    wt_status status = n > 0 ? create_shifted_tables(to, tip, options, err) : WT_OK;
    if (n == 0 || status != WT_OK)
        return status;
    for (size_t i = 0; i < to->n; i++)
        if (f.capacity < 2 * (to->curve[i].branch[0].n + to->curve[i].branch[1].n))
            f.capacity = 2 * (to->curve[i].branch[0].n + to->curve[i].branch[1].n);
    f.scratch = wt_alloc(threads * f.capacity, sizeof *f.scratch);
    f.errors = wt_alloc(n, sizeof *f.errors);
    status = wt_parallel_for(n, threads, measure_source_gain, &f, NULL, "fitting curves anew");
    size_t first = 0;
    while (first < n && f.errors[first].status == WT_OK)
        first++;
    if (status != WT_OK && first == n)
        (void)wt_fail(err, status, "fitting in parallel failed");
    else if (status != WT_OK && err != NULL)
        *err = f.errors[first];
    free(f.scratch);
    free(f.errors);
    return status;
}

/* Mean gain of a source over the stored curves, with its standard error; NaN if unknown. */
static wt_estimate mean_gain(const calibration_errors *of, wt_systematic_source source)
{
    double known[COMMON_CURVES];
    size_t n = 0;
    for (size_t j = 0; j < of->n; j++)
        if (!isnan(of->gain[j][source]))
            known[n++] = of->gain[j][source];
    const moments m = sample_moments(known, n); /* NaN without a gain */
    return (wt_estimate){m.mean, sqrt(m.variance / m.n), 0, "1"};
}

/* Names an assumed error and its effect on the modulus. */
static void append_assumed_error(const calibration_errors *of, wt_systematic_source source,
                                 double gain, char *text, size_t size)
{
    const double error = of->assumed[source];
    char thickness[32];
    wt_format_si(of->thickness, "m", 2, thickness, sizeof thickness);
    clocale_append(text, size, "%s", *text != '\0' ? ", " : "");
    if (of->thickness > 0 && source == WT_SYSTEMATIC_THICKNESS)
        clocale_append(text, size, "a %s of %s", calibration_source_text(source), thickness);
    else
        clocale_append(text, size, "%s %s the %s", format_percent(error).text,
                       source == WT_SYSTEMATIC_PIEZO || source == WT_SYSTEMATIC_DETECTOR ? "by"
                                                                                         : "of",
                       calibration_source_text(source));
    clocale_append(text, size, " (%s of E)", format_percent(fabs(gain) * error).text);
}

void calibration_errors_set_keys(const calibration_errors *of, table_writer *rows)
{
    char text[640] = "";
    for (int i = 0; i < WT_SYSTEMATIC_SOURCES && of->active; i++) {
        const wt_estimate gain = mean_gain(of, (wt_systematic_source)i);
        if (of->error[i] > 0)
            indentation_set_value(rows, (indentation_key)(INDENTATION_KEY_LEVER_ERROR + i),
                                  of->error[i], 0, 0);
        if (isnan(gain.value))
            continue;
        indentation_set_value(rows, (indentation_key)(INDENTATION_KEY_LEVER_GAIN + i), gain.value,
                              gain.standard_error, 0);
        if (!(of->assumed[i] > 0))
            continue;
        indentation_set_value(rows, (indentation_key)(INDENTATION_KEY_LEVER_ERROR_ASSUMED + i),
                              of->assumed[i], 0, 0);
        append_assumed_error(of, (wt_systematic_source)i, gain.value, text, sizeof text);
    }
    if (text[0] == '\0')
        return;
    clocale_append(text, sizeof text, "; state them to narrow the interval");
    indentation_set_text(rows, INDENTATION_KEY_ASSUMED, text);
}
