/* Specific wear rate of a record by what the track lost, and the nominal pressure of its ball.
 *
 * Archard, J. Appl. Phys. 24 (1953) 981: volume = k load distance.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/record/record.h"

#include "base/array.h"
#include "data/tables/rows.h"

#include <math.h>
#include <stdlib.h>

static const double normal_95 = 1.959963984540054; /* 97.5 % of the normal law */
/* Cycles at either end of a record that tell the depth there: a fiftieth of it. */
enum { END_SHARE = 50, END_LEAST = 4 };
/* Hertz's law is of contacts that are small against the ball; tribolayer-beyond says where. */
static const double small_contact = 0.3;

TABLE_ROW(wear, WEAR, wt_interval rate; const char *of; wt_estimate volume, depth;
          double normal_force, distance; wt_ball_contact ball; double duty;
          const char *note, *file;)

static bool given(wt_estimate e)
{
    return !isnan(e.value);
}

bool wear_is_asked(const wt_record_job *job)
{
    return job->profile != NULL || given(job->track_area) || given(job->mass_loss) ||
           given(job->ball_radius);
}

wt_record_job wear_left_out(wt_record_job job)
{
    job.track_area.value = job.mass_loss.value = job.density.value = job.ball_radius.value =
        (double)NAN;
    job.profile = NULL;
    return job;
}

static double relative(wt_estimate e)
{
    return e.standard_error / e.value;
}

static wt_estimate product(wt_estimate a, wt_estimate b, const char *unit)
{
    const double value = a.value * b.value;
    return (wt_estimate){value, value * hypot(relative(a), relative(b)), 0, unit};
}

/* ---- what is known of the record ------------------------------------------------------------- */

static double distance_of(const wt_record *record, const wt_cycles *cycles, double radius)
{
    const double *const distance = record->channel[WT_RECORD_DISTANCE],
                        *const laps = record->channel[WT_RECORD_LAPS],
                        *const time = record->channel[WT_RECORD_TIME];
    const size_t last = record->n - 1;
    if (distance != NULL)
        return distance[last] - distance[0];
    if (laps != NULL && radius > 0)
        return 2 * M_PI * radius * (laps[last] - laps[0]);
    if (time == NULL)
        return (double)NAN;
    double sum = 0, n = 0;
    for (size_t i = 0; i < cycles->n; i++)
        if (!isnan(cycles->cycle[i].velocity)) {
            sum += cycles->cycle[i].velocity;
            n++;
        }
    return sum / n * (time[last] - time[0]);
}

static wt_estimate load_of(const wt_record_job *job, const wt_cycles *cycles)
{
    const double load = conditions_of(cycles->cycle, cycles->n).normal_force;
    const double error = given(job->load) ? relative(job->load) : 0;
    return (wt_estimate){load, load * error, 0, "N"};
}

/* Depth at the end over that at the beginning, each by the cycles there. */
static wt_status depth_of(const wt_cycles *cycles, wt_estimate *depth, wt_error *err)
{
    const size_t n = cycles->n / END_SHARE > END_LEAST ? cycles->n / END_SHARE : END_LEAST;
    wt_steady end[2];
    *depth = (wt_estimate){(double)NAN, (double)NAN, 0, "m"};
    if (cycles->n < 2 * n)
        return WT_OK;
    double *const y = malloc(n * sizeof *y);
    wt_status status = y != NULL ? WT_OK : wt_fail(err, WT_E_MEMORY, "out of memory");
    for (size_t e = 0; e < COUNT_OF(end) && status == WT_OK; e++) {
        for (size_t i = 0; i < n; i++)
            y[i] = cycles->cycle[e == 0 ? i : cycles->n - n + i].wear_depth;
        status = wt_steady_mean(y, n, &end[e], err);
    }
    free(y);
    if (status == WT_OK)
        *depth =
            (wt_estimate){end[1].mean.value - end[0].mean.value,
                          hypot(end[0].mean.standard_error, end[1].mean.standard_error), 0, "m"};
    return status;
}

/* Cross-section of a cap of a ball, with its slope against the depth. */
static wt_estimate cap_of(wt_estimate depth, double radius)
{
    const double h = depth.value, half = sqrt(h * (2 * radius - h));
    return (wt_estimate){radius * radius * acos(1 - h / radius) - (radius - h) * half,
                         2 * half * depth.standard_error, 0, "m^2"};
}

/* ---- rows ------------------------------------------------------------------------------------ */

static void set_rate(wear_row *r, wt_estimate load, const char *of_ball)
{
    const double value = r->volume.value / (load.value * r->distance),
                 error = hypot(relative(r->volume), relative(load));
    const double none = (double)NAN;
    r->rate = (wt_interval){value, none, none, none};
    if (!(value > 0)) {
        r->rate.value = none;
        r->note = isnan(load.value)    ? "no load: give --load"
                  : isnan(r->distance) ? "no distance: give --track-radius"
                                       : "no volume: give --track-length or --track-radius";
    } else if (error > 0) {
        r->rate = (wt_interval){value, value * error, value * exp(-normal_95 * error),
                                value * exp(normal_95 * error)};
        r->note = of_ball;
    } else {
        r->note = "no error of what was lost is given";
    }
}

static void set_ball(const wt_record_job *job, wt_estimate load, double track_radius, wear_row *r)
{
    const double none = (double)NAN;
    r->ball = (wt_ball_contact){none, none};
    r->duty = none;
    if (!given(job->ball_radius) || !given(job->modulus))
        return;
    r->ball = wt_ball_contact_of(load.value, job->ball_radius.value, job->modulus.value,
                                 job->poisson_ratio);
    /* Hertz's pressure on the middle line, of which the nominal one is the mean */
    r->duty = 3 * r->ball.contact_radius / (8 * track_radius);
}

static void put(const wt_record_job *job, const char *of, wt_estimate volume, wear_row *r,
                wt_estimate load, table_writer *t, wear_rates *rates)
{
    const bool large = r->ball.contact_radius > small_contact * job->ball_radius.value;
    r->of = of;
    r->volume = volume;
    set_rate(r, load, large ? "the contact is large against the ball" : "");
    wear_add_row(t, r);
    if (isnan(r->rate.value))
        return;
    wear_count(rates, r->rate.value, r->rate.standard_error);
}

void wear_count(wear_rates *rates, double rate, double standard_error)
{
    rates->n++;
    rates->sum += rate;
    rates->squares += rate * rate;
    rates->own += standard_error * standard_error;
}

wt_status wear_add(const wt_record_job *job, const wt_record *record, const wt_cycles *cycles,
                   wt_estimate radius, const char *file, table_writer *t, wear_rates *rates,
                   wt_error *err)
{
    const wt_estimate load = load_of(job, cycles),
                      round = {2 * M_PI * radius.value, 2 * M_PI * radius.standard_error, 0, "m"},
                      length = given(job->track_length) ? job->track_length : round;
    wear_row r = {.distance = distance_of(record, cycles, radius.value),
                  .normal_force = load.value,
                  .depth = {(double)NAN, (double)NAN, 0, "m"},
                  .file = file};
    set_ball(job, load, radius.value, &r);
    if (given(job->mass_loss)) {
        const wt_estimate inverse = {1 / job->density.value,
                                     relative(job->density) / job->density.value, 0, "m^3/kg"};
        put(job, "mass", product(job->mass_loss, inverse, "m^3"), &r, load, t, rates);
    }
    if (given(job->track_area))
        put(job, "area of the track", product(job->track_area, length, "m^3"), &r, load, t, rates);
    wt_status status = WT_OK;
    if (given(job->ball_radius) && record->channel[WT_RECORD_WEAR_DEPTH] != NULL)
        status = depth_of(cycles, &r.depth, err);
    const double h = r.depth.value;
    if (status == WT_OK && h > 0 && h < job->ball_radius.value)
        put(job, "depth of the record",
            product(cap_of(r.depth, job->ball_radius.value), length, "m^3"), &r, load, t, rates);
    else if (status == WT_OK && !given(job->mass_loss) && !given(job->track_area))
        put(job, "nothing", (wt_estimate){(double)NAN, (double)NAN, 0, "m^3"}, &r, load, t, rates);
    return status;
}

void wear_set_keys(const wear_rates *rates, table_writer *t)
{
    if (!(rates->n > 0))
        return;
    const double mean = rates->sum / rates->n,
                 between = rates->n > 1 ? (rates->squares - rates->n * mean * mean) /
                                              (rates->n * (rates->n - 1))
                                        : 0;
    wear_set(
        t, WEAR_KEY_RATE,
        (wt_estimate){mean, sqrt(fmax(rates->own / (rates->n * rates->n), between)), 0, "m^2/N"});
}
