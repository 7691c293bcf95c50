/* Conditions of a record: parameters, division into steps where velocity, load, pressure or
 * temperature change their value, and combination of repeated measurements.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/param.h"

#include "record/record.h"
#include "weartrack/record.h"

#include <math.h>

/* Poisson's ratio of filled rubber well above its glass transition. */
static const double incompressible = 0.5;

wt_record_job wt_record_job_defaults(void)
{
    const double unknown = (double)NAN;
    return (wt_record_job){.load = {unknown, 0, 0, "N"},
                           .track_radius = {unknown, 0, 0, "m"},
                           .track_area = {unknown, 0, 0, "m^2"},
                           .mass_loss = {unknown, 0, 0, "kg"},
                           .density = {unknown, 0, 0, "kg/m^3"},
                           .track_length = {unknown, 0, 0, "m"},
                           .ball_radius = {unknown, 0, 0, "m"},
                           .modulus = {unknown, 0, 0, "Pa"},
                           .poisson_ratio = incompressible};
}

static const wt_param rows[] = {
    {PARAM_CHOICE_OF("average", wt_record_job, cycle, "auto|stroke|lap|time|sample"),
     .help = "what friction is averaged over before its scatter is judged: double strokes, laps or "
             "equal spans of time, or every sample by itself"},
    {PARAM_CHOICE_OF("running-in", wt_record_job, running_in, "change|none"),
     .help = "how the end of the running-in is found: by likelihood with an interval; none: all is "
             "steady"},
    {PARAM("load", wt_record_job, load, WT_Q_NORMAL_FORCE, ABOVE(0)), .value = "F",
     .unset = "that of the file",
     .help = SUCH_AS("normal force where the record says none, ", "\"5N +- 1%\"", "")},
    {PARAM("track-radius", wt_record_job, track_radius, WT_Q_LENGTH, ABOVE(0)), .value = "R",
     .unset = "that of the file",
     .help = "radius of the track on a disc, which relates distance to laps and velocity to "
             "rotation"},
    {PARAM("track-area", wt_record_job, track_area, WT_Q_AREA, ABOVE(0)), .value = "A", .unset = "",
     .help = SUCH_AS("cross-section that the track has lost, ", "\"3e-11m^2 +- 20%\"",
                     ", for the specific wear rate")},
    {PARAM_TEXT_OF("profile", wt_record_job, profile), .value = "FILE", .unset = "",
     .flags = PARAM_NO_CASE | PARAM_READ,
     .help =
         "the same from profiles of heights across the track: a file, a folder or a pattern; of "
         "several the mean, with their scatter"},
    {PARAM("mass-loss", wt_record_job, mass_loss, WT_Q_MASS, ABOVE(0)), .value = "M", .unset = "",
     .help = SUCH_AS("mass that was lost, ", "\"3mg +- 0.2mg\"", "; with --density")},
    {PARAM("density", wt_record_job, density, WT_Q_MASS_DENSITY, ABOVE(0)), .value = "RHO",
     .unset = "", .help = SUCH_AS("density of the rubber, ", "1150kg/m^3", "")},
    {PARAM("track-length", wt_record_job, track_length, WT_Q_LENGTH, ABOVE(0)), .value = "L",
     .unset = "the circumference of the track, or the length of its strokes",
     .help = "length of the track, such as the stroke of a reciprocating record"},
    {PARAM("ball-radius", wt_record_job, ball_radius, WT_Q_LENGTH, ABOVE(0)), .value = "R",
     .unset = "",
     .help = "radius of the ball: with --modulus its nominal pressure; and the cross-section that "
             "it has worn, by the depth of the record, if it is harder than the track"},
    {PARAM("modulus", wt_record_job, modulus, WT_Q_MODULUS, ABOVE(0)), .value = "E", .unset = "",
     .help =
         SUCH_AS("Young's modulus of the rubber at the frequency of the contact, ", "20MPa", "")},
    {PARAM("poisson-ratio", wt_record_job, poisson_ratio, WT_Q_NONE, FROM_TO(0, 0.5)), .value = "X",
     .help = "Poisson's ratio of the rubber"},
};
PARAM_TABLE(wt_record_job_params, wt_record_job, rows, wt_record_job_defaults, NO_PARTS)

/* ---- repeated measurements ------------------------------------------------------------------- */

void record_group_add(record_group *s, wt_estimate e)
{
    s->n++;
    const double off = e.value - s->mean;
    s->mean += off / s->n;
    s->squares += off * (e.value - s->mean);
    s->error_squares += e.standard_error * e.standard_error;
}

static double scatter_variance(const record_group *s)
{
    return s->n > 1 ? s->squares / (s->n * (s->n - 1)) : 0;
}

/* Returns the degrees of freedom of the error if it is the scatter, else NaN. */
static double record_group_df(const record_group *s)
{
    const double by_errors = s->error_squares / (s->n * s->n);
    return s->n > 1 && (isnan(by_errors) || scatter_variance(s) > by_errors) ? s->n - 1
                                                                             : (double)NAN;
}

wt_estimate record_group_mean(const record_group *s, const char *unit)
{
    if (!(s->n > 0))
        return (wt_estimate){(double)NAN, (double)NAN, 0, unit};
    const double by_scatter = scatter_variance(s), by_errors = s->error_squares / (s->n * s->n);
    /* An unknown standard error leaves only the scatter, which a single measurement does not
     * have. */
    if (isnan(by_errors) && s->n > 1)
        return (wt_estimate){s->mean, sqrt(by_scatter), 0, unit};
    return (wt_estimate){s->mean, isnan(by_errors) ? by_errors : sqrt(fmax(by_errors, by_scatter)),
                         0, unit};
}

void wear_rates_close_run(wear_rates *rates)
{
    if (!(rates->run.n > 0))
        return;
    record_group_add(&rates->all, record_group_mean(&rates->run, "m^2/N"));
    rates->freedom = record_group_df(&rates->run);
    rates->run = (record_group){.n = 0};
}

double wear_rates_df(const wear_rates *rates)
{
    return rates->all.n == 1 ? rates->freedom : record_group_df(&rates->all);
}

/* A change counts only if it exceeds the control accuracy of the instrument. Rubber friction
 * depends on the logarithm of the velocity. A change of 10 % is therefore not a new condition.
 * Glass transitions shift by 5 K per decade. */
static const double same_ratio = 0.1, same_temperature = 5; /* [K] */
/* Number of cycles that a new value must last, and the fewest cycles of a comparison. */
enum { LASTING = 10, FEWEST = 3 };
static const double outstanding = 5; /* threshold of a change [standard errors] */

/* The rotation is compared if no radius gives the velocity. */
typedef enum condition {
    VELOCITY,
    ROTATION,
    NORMAL_FORCE,
    PRESSURE,
    TEMPERATURE,
    CONDITIONS
} condition;

static double condition_value(const wt_cycle *c, condition which)
{
    const double values[CONDITIONS] = {c->velocity, c->rotation, c->normal_force, c->pressure,
                                       c->temperature};
    return values[which];
}

static double min_change(condition which, double value)
{
    return which == TEMPERATURE ? same_temperature : same_ratio * fabs(value);
}

/* Unknown values are skipped. */
static void add_condition(record_group *s, const wt_cycle *c, condition which)
{
    const double value = condition_value(c, which);
    if (!isnan(value))
        record_group_add(s, (wt_estimate){.value = value});
}

static record_group condition_moments(const wt_cycle *cycles, size_t n, condition which)
{
    record_group s = {0};
    for (size_t i = 0; i < n; i++)
        add_condition(&s, &cycles[i], which);
    return s;
}

/* True if the mean of the next cycles differs from the mean before. */
static bool has_changed(const record_group *before, const record_group *next, condition which)
{
    const double change = fabs(next->mean - before->mean);
    if (!(before->n > 0) || !(next->n > 0) || change <= min_change(which, before->mean))
        return false;
    const double variance = (before->squares + next->squares) / fmax(before->n + next->n - 2, 1);
    return change > outstanding * sqrt(variance * (1 / before->n + 1 / next->n));
}

/* Returns the first cycle that is closer to the new value than to the old one. */
static size_t find_change(const wt_cycle *cycles, size_t i, size_t n, condition which, double old)
{
    const size_t from = i + LASTING < n ? i + LASTING / 2 : i;
    const size_t end = from + LASTING < n ? from + LASTING : n;
    const double next = condition_moments(cycles + from, end - from, which).mean;
    while (i < n && fabs(condition_value(&cycles[i], which) - old) <
                        fabs(condition_value(&cycles[i], which) - next))
        i++;
    return i;
}

static bool is_at_rest(const wt_cycle *c)
{
    return c->velocity == 0 || (isnan(c->velocity) && c->rotation == 0);
}

size_t conditions_step_length(const wt_cycle *cycles, size_t n)
{
    record_group before[CONDITIONS] = {{0}};
    size_t end = 1;
    while (end < n && cycles[end].step == cycles[0].step)
        end++;
    /* A rest before sliding begins is a step of its own, however short it is. */
    for (size_t still = 0; still < end && is_at_rest(&cycles[still]); still++)
        if (still + 1 < end && !is_at_rest(&cycles[still + 1]))
            return still + 1;
    for (size_t i = 0; i < end; i++) {
        const size_t next = i + LASTING < end ? LASTING : end - i;
        for (condition c = VELOCITY; c < CONDITIONS && i >= FEWEST && next >= FEWEST; c++) {
            const record_group ahead = condition_moments(cycles + i, next, c);
            if (has_changed(&before[c], &ahead, c))
                return find_change(cycles, i, end, c, before[c].mean);
        }
        for (condition c = VELOCITY; c < CONDITIONS; c++)
            add_condition(&before[c], &cycles[i], c);
    }
    return end;
}

static double mean_condition(const wt_cycle *cycles, size_t n, condition which)
{
    const record_group s = condition_moments(cycles, n, which);
    return s.n > 0 ? s.mean : (double)NAN;
}

/* Path over time. Laps with different numbers of samples have the same length. */
static double mean_velocity(const wt_cycle *cycles, size_t n)
{
    double path = 0, time = 0;
    for (size_t i = 0; i < n; i++)
        if (cycles[i].duration > 0 && !isnan(cycles[i].velocity)) {
            path += cycles[i].velocity * cycles[i].duration;
            time += cycles[i].duration;
        }
    return time > 0 ? path / time : mean_condition(cycles, n, VELOCITY);
}

record_conditions conditions_mean(const wt_cycle *cycles, size_t n)
{
    return (record_conditions){mean_velocity(cycles, n), mean_condition(cycles, n, ROTATION),
                               mean_condition(cycles, n, NORMAL_FORCE),
                               mean_condition(cycles, n, PRESSURE),
                               mean_condition(cycles, n, TEMPERATURE)};
}

bool conditions_are_at_rest(record_conditions at)
{
    return !(at.velocity > 0 || at.rotation > 0) && (at.velocity == 0 || at.rotation == 0);
}

/* A quantity that only one of both states is not equal. */
static bool is_same_condition(double a, double b, condition which)
{
    if (isnan(a) || isnan(b))
        return isnan(a) && isnan(b);
    return fabs(a - b) <= min_change(which, fmax(fabs(a), fabs(b)));
}

bool conditions_are_equal(record_conditions a, record_conditions b)
{
    return is_same_condition(a.velocity, b.velocity, VELOCITY) &&
           (!isnan(a.velocity) || is_same_condition(a.rotation, b.rotation, ROTATION)) &&
           is_same_condition(a.normal_force, b.normal_force, NORMAL_FORCE) &&
           is_same_condition(a.pressure, b.pressure, PRESSURE) &&
           is_same_condition(a.temperature, b.temperature, TEMPERATURE);
}
