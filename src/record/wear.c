/* Specific wear rate of a record from the lost volume, and nominal pressure of the ball. Archard,
 * J. Appl. Phys. 24 (1953) 981: volume = k load distance. Cross-section of a wear track from
 * profiles across it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/math/students_t.h"
#include "core/table/table_rows.h"
#include "job/inputs.h"
#include "record/record.h"

#include <math.h>
#include <stdlib.h>

/* ---- profiles across the track --------------------------------------------------------------- */

static wt_status find_track(const wt_image *image, wt_track *track, wt_error *err)
{
    const size_t n = image->n_columns;
    double *const x = wt_alloc(n, sizeof *x);
    double *const z = wt_alloc(n, sizeof *z);
    size_t k = 0;
    for (size_t i = 0; i < n; i++)
        if (!isnan(image->values[i])) {
            x[k] = image->x_min + image->width * (double)i / (double)(n - 1);
            z[k++] = image->values[i];
        }
    const wt_status status = wt_track_find(x, z, k, track, err);
    free(x);
    free(z);
    return status;
}

typedef struct profile_areas {
    const wt_job *work;
    record_group areas;
} profile_areas;

static wt_status measure_profile(void *user, flow_file *file, size_t i, wt_error *err)
{
    profile_areas *const to = user;
    (void)i;
    wt_image image = {.values = NULL};
    wt_track track = {.found = false};
    wt_status status = flow_heights_read(file, NULL, true, WT_ROLE_PROFILE, to->work, &image, err);
    if (status == WT_OK && image.n_rows > 1) {
        status = wt_fail(err, WT_E_ARG, "a height map, and the track is measured across it");
        wt_error_advice(err, "export profiles across the track, a file each");
    }
    if (status == WT_OK)
        status = find_track(&image, &track, err);
    wt_image_clear(&image);
    if (status != WT_OK)
        return status;
    if (!track.found) {
        wt_fail(err, WT_E_EMPTY, "no track in the profile");
        wt_error_expected(err, "heights in its middle that lie deeper than the scatter of its "
                               "outer quarters");
        wt_error_advice(err, "measure across the whole track, with as much beside it");
        return WT_E_EMPTY;
    }
    record_group_add(&to->areas, track.area);
    if (track.ridges > track.area.value)
        wt_log_add(to->work->log, WT_WARNING, file->name, NULL,
                   "more stands above the surface beside the track than is missing in it: "
                   "material was pushed aside or transferred, and its volume is no wear");
    return WT_OK;
}

wt_status wear_profile_area(const wt_record_job *job, const wt_job *work, wt_estimate *area,
                            wt_error *err)
{
    wt_file_set set = job->profile_set != NULL ? *job->profile_set : job->sets[0];
    set.patterns = &job->profile;
    set.n_patterns = 1;
    if (job->profile_set == NULL)
        set.read.format = NULL; /* that of the records does not apply */
    flow_files files = {0};
    profile_areas found = {.work = work};
    size_t n_failed = 0;
    wt_status status = flow_files_list(&set, 1, work, &files, err);
    if (status == WT_OK)
        status = flow_files_process(&files, work, measure_profile, &found, &n_failed, err);
    if (status == WT_OK && !(found.areas.n > 0)) {
        status = wt_fail(err, WT_E_EMPTY, "no profile shows the track");
        flow_error_add_files(&files, n_failed, err);
    }
    flow_files_clear(&files);
    if (status == WT_OK)
        *area = record_group_mean(&found.areas, "m^2");
    return status;
}

/* Cycles that determine the depth at either end of a record: 1/50 of them, and the fewest. */
enum { END_SHARE = 50, END_LEAST = 4 };
/* Largest contact radius over ball radius. Hertz's law holds for small contacts; see
 * tribolayer-beyond. */
static const double small_contact = 0.3;

TABLE_ROW(wear, WEAR, wt_interval rate; const char *of; wt_estimate volume, depth;
          double normal_force, distance; wt_ball_contact ball; double duty;
          const char *note, *file;)

/* ---- inputs ---------------------------------------------------------------------------------- */

static bool is_stated(wt_estimate e)
{
    return !isnan(e.value);
}

bool wear_is_requested(const wt_record_job *job)
{
    return job->profile != NULL || is_stated(job->track_area) || is_stated(job->mass_loss) ||
           is_stated(job->ball_radius);
}

wt_record_job wear_without_inputs(wt_record_job job)
{
    job.track_area.value = job.mass_loss.value = job.density.value = job.ball_radius.value =
        (double)NAN;
    job.profile = NULL;
    return job;
}

static double relative_error(wt_estimate e)
{
    return e.standard_error / e.value;
}

static wt_estimate estimate_product(wt_estimate a, wt_estimate b, const char *unit)
{
    const double value = a.value * b.value;
    return (wt_estimate){value, value * hypot(relative_error(a), relative_error(b)), 0, unit};
}

/* ---- quantities of the record ---------------------------------------------------------------- */

/* Mean velocity of strokes on a track of known length, which is passed twice. NaN if the cycles are
 * not strokes or have no time. */
static double mean_stroke_velocity(const wt_cycles *cycles, double length)
{
    double time = 0;
    for (size_t i = 0; i < cycles->n; i++)
        time += cycles->cycle[i].duration;
    return cycles->kind == WT_CYCLE_STROKE && time > 0 ? 2 * length * (double)cycles->n / time
                                                       : (double)NAN;
}

/* Time of all steps without the gaps between them. */
static double total_step_time(const wt_record *record)
{
    const double *const time = record->channel[WT_RECORD_TIME];
    double sum = 0;
    for (size_t i = 1; i < record->n; i++)
        sum += record->step[i] == record->step[i - 1] ? time[i] - time[i - 1] : 0;
    return sum;
}

static double sliding_distance(const wt_record *record, const wt_cycles *cycles, double radius,
                               double length)
{
    const double *const distance = record->channel[WT_RECORD_DISTANCE],
                        *const laps = record->channel[WT_RECORD_LAPS];
    const size_t last = record->n - 1;
    if (distance != NULL)
        return distance[last] - distance[0];
    if (laps != NULL && radius > 0 && cycles->kind != WT_CYCLE_STROKE)
        return 2 * M_PI * radius * (laps[last] - laps[0]);
    if (record->channel[WT_RECORD_TIME] == NULL)
        return (double)NAN;
    const double velocity = conditions_mean(cycles->cycle, cycles->n).velocity;
    return total_step_time(record) *
           (isnan(velocity) ? mean_stroke_velocity(cycles, length) : velocity);
}

/* Length of the track as stated, else half the path of a double stroke, else the circumference. */
static wt_estimate track_length(const wt_record_job *job, const wt_cycles *cycles,
                                wt_estimate radius)
{
    if (is_stated(job->track_length))
        return job->track_length;
    if (cycles->kind != WT_CYCLE_STROKE)
        return (wt_estimate){2 * M_PI * radius.value, 2 * M_PI * radius.standard_error, 0, "m"};
    double path = 0;
    for (size_t i = 0; i < cycles->n; i++)
        path += cycles->cycle[i].velocity * cycles->cycle[i].duration;
    return (wt_estimate){path / (2 * (double)cycles->n), 0, 0, "m"};
}

/* Depth at the end less depth at the beginning, by means over cycles. The correction for the finite
 * length of the means depends on the law of wear. Half of it is taken as an error. By Archard's law
 * the volume of a ball cap grows with the distance, and its depth with the power 2/3. */
static wt_status worn_depth(const wt_cycles *cycles, wt_estimate *depth, wt_error *err)
{
    const size_t n = cycles->n / END_SHARE > END_LEAST ? cycles->n / END_SHARE : END_LEAST;
    wt_steady end[2];
    *depth = (wt_estimate){(double)NAN, (double)NAN, 0, "m"};
    if (cycles->n < 2 * n)
        return WT_OK;
    double *const y = wt_alloc(n, sizeof *y);
    wt_status status = WT_OK;
    for (size_t e = 0; e < COUNT_OF(end) && status == WT_OK; e++) {
        for (size_t i = 0; i < n; i++)
            y[i] = cycles->cycle[e == 0 ? i : cycles->n - n + i].wear_depth;
        status = wt_steady_mean(y, n, &end[e], err);
    }
    free(y);
    if (status == WT_OK) {
        const double seen = end[1].mean.value - end[0].mean.value,
                     part = (double)n / (double)cycles->n,
                     share = 0.6 * ((1 - pow(1 - part, 5.0 / 3)) / part - pow(part, 2.0 / 3)),
                     scatter =
                         hypot(end[0].mean.standard_error, end[1].mean.standard_error) / share;
        *depth = (wt_estimate){seen / share, hypot(scatter, 0.5 * seen * (1 / share - 1)), 0, "m"};
    }
    return status;
}

/* Cross-section of a ball cap, with its derivative with respect to the depth. */
static wt_estimate cap_area(wt_estimate depth, double radius)
{
    const double h = depth.value, half = sqrt(h * (2 * radius - h));
    return (wt_estimate){radius * radius * acos(1 - h / radius) - (radius - h) * half,
                         2 * half * depth.standard_error, 0, "m^2"};
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* True if the radius of the track gives the distance: laps or rotations are counted. */
static bool counts_rounds(const wt_record *record)
{
    return record->channel[WT_RECORD_LAPS] != NULL || record->channel[WT_RECORD_ROTATION] != NULL;
}

/* Names the first missing input of the rate. */
static const char *missing_wear_input(const wt_record_job *job, const wear_row *r, wt_estimate load,
                                      bool strokes, bool rounds)
{
    if (!is_stated(job->mass_loss) && !is_stated(job->track_area) && isnan(r->depth.value))
        return "the loss of the track is not known: give --profile, --track-area or "
               "--mass-loss, or record the depth";
    if (isnan(load.value))
        return "no load: give --load";
    if (isnan(r->distance))
        return strokes  ? "no distance: give --track-length"
               : rounds ? "no distance: give --track-radius"
                        : "no distance, velocity, laps or rotation in the record";
    if (r->depth.value <= 0)
        return "the depth of the record does not grow";
    return strokes ? "no volume: give --track-length"
                   : "no volume: give --track-length or --track-radius";
}

static void set_rate(const wt_record_job *job, wear_row *r, wt_estimate load, bool strokes,
                     bool rounds, const char *of_ball)
{
    const double value = r->volume.value / (load.value * r->distance),
                 error = hypot(relative_error(r->volume), relative_error(load));
    const double none = (double)NAN;
    r->rate = (wt_interval){value, none, none, none};
    if (!(value > 0)) {
        r->rate.value = none;
        r->note = missing_wear_input(job, r, load, strokes, rounds);
    } else if (error > 0) {
        r->rate = (wt_interval){value, value * error, value * exp(-NORMAL_95 * error),
                                value * exp(NORMAL_95 * error)};
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
    if (!is_stated(job->ball_radius) || !is_stated(job->modulus))
        return;
    r->ball = wt_ball_contact_compute(load.value, job->ball_radius.value, job->modulus.value,
                                      job->poisson_ratio);
    r->duty = wt_ball_duty(r->ball.contact_radius, track_radius, 0);
}

/* Rows of a record and their common quantities. */
typedef struct wear_rows {
    const wt_record_job *job;
    wear_row row;
    wt_estimate load;
    bool strokes, rounds;
    table_writer *t;
    wear_rates *rates;
} wear_rows;

static void add_wear_volume(wear_rows *rows, const char *of, wt_estimate volume)
{
    wear_row *const r = &rows->row;
    const bool large = r->ball.contact_radius > small_contact * rows->job->ball_radius.value;
    r->of = of;
    r->volume = volume;
    if (!(volume.standard_error > 0)) /* no error was stated */
        r->volume.standard_error = (double)NAN;
    set_rate(rows->job, r, rows->load, rows->strokes, rows->rounds,
             large ? "the contact is large against the ball" : "");
    wear_add_row(rows->t, r);
    if (!isnan(r->rate.value))
        record_group_add(&rows->rates->run,
                         (wt_estimate){r->rate.value, r->rate.standard_error, 0, "m^2/N"});
}

wt_status wear_add(const wt_record_job *job, const wt_record *record, const wt_cycles *cycles,
                   wt_estimate radius, const char *file, table_writer *t, wear_rates *rates,
                   wt_error *err)
{
    const double none = (double)NAN;
    const wt_estimate length = track_length(job, cycles, radius),
                      no_volume = {none, none, 0, "m^3"};
    const double load = conditions_mean(cycles->cycle, cycles->n).normal_force,
                 load_error = is_stated(job->load) ? relative_error(job->load) : 0;
    wear_rows rows = {.job = job,
                      .load = {load, load * load_error, 0, "N"},
                      .strokes = cycles->kind == WT_CYCLE_STROKE,
                      .rounds = counts_rounds(record),
                      .t = t,
                      .rates = rates};
    wear_row *const r = &rows.row;
    *r = (wear_row){.distance =
                        sliding_distance(record, cycles, radius.value, job->track_length.value),
                    .normal_force = rows.load.value,
                    .depth = {none, none, 0, "m"},
                    .file = file};
    set_ball(job, rows.load, radius.value, r);
    if (is_stated(job->mass_loss)) {
        const wt_estimate inverse = {
            1 / job->density.value, relative_error(job->density) / job->density.value, 0, "m^3/kg"};
        add_wear_volume(&rows, "mass", estimate_product(job->mass_loss, inverse, "m^3"));
    }
    if (is_stated(job->track_area))
        add_wear_volume(&rows, "area of the track",
                        estimate_product(job->track_area, length, "m^3"));
    wt_status status = WT_OK;
    if (is_stated(job->ball_radius) && record->channel[WT_RECORD_WEAR_DEPTH] != NULL)
        status = worn_depth(cycles, &r->depth, err);
    if (status == WT_OK && !isnan(r->depth.value))
        add_wear_volume(
            &rows, "depth of the record",
            r->depth.value > 0 && r->depth.value < job->ball_radius.value
                ? estimate_product(cap_area(r->depth, job->ball_radius.value), length, "m^3")
                : no_volume);
    else if (status == WT_OK && !is_stated(job->mass_loss) && !is_stated(job->track_area))
        add_wear_volume(&rows, "nothing", no_volume);
    wear_rates_close_run(rates);
    return status;
}
