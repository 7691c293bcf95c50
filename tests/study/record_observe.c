/* Observes records of friction through weartrack record.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record_observe.h"
#include "record_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846, coefficient = 0.8, lap_time = 0.5, load = 5,
                    radius = 0.012, density = 1150, zero = 0.1;
/* Friction of a velocity step relative to the previous one. */
static const double per_step = 1.1;
enum { STEP_LAPS = 200 };

typedef struct made_record {
    int laps, end;  /* all rows, and those of the running-in */
    double *lap;    /* [laps] mean coefficient */
    double steady;  /* after the running-in, of the first step */
    double drift;   /* of a lap */
    double scatter; /* of a lap */
    int pause_at;   /* laps before the pause */
    double paused;  /* s */
} made_record;

static double running_in(const record_scene *s, double scatter, int lap, int end, int laps)
{
    const double height = (s->height > 0 ? s->height : 4) * scatter, at = (lap + 0.5) / (double)end;
    switch (s->form) {
    case A_JUMP:
        return lap < end ? height : 0;
    case A_LINE:
        return lap < end ? height * (1 - at) : 0;
    case A_HUMP:
        return lap < end ? height * sin(pi * at) : 0;
    case EXPONENTIAL:
        return height * exp(-(lap + 0.5) / (s->length * laps));
    default:
        return 0;
    }
}

static made_record make_record(const record_scene *s, random_source *random)
{
    made_record r = {.laps = s->steps > 0 ? s->steps * STEP_LAPS : s->laps > 0 ? s->laps : 800};
    const double length = 0.2 + 0.2 * random_uniform(random),
                 memory = exp(-1 / (s->memory > 0 ? s->memory : 8));
    double slow = random_normal(random), walk = 0;
    r.steady = coefficient * (1 + 0.1 * random_normal(random));
    r.scatter = (s->scatter > 0 ? s->scatter : 0.02) * r.steady;
    r.end = s->form == NO_RUNNING_IN ? 0 : (int)(length * r.laps);
    r.drift = s->drift * r.scatter / r.laps;
    if (s->pause != NO_PAUSE) { /* anywhere, from five laps to half of the record */
        r.pause_at = (int)((0.05 + 0.9 * random_uniform(random)) * r.laps);
        r.paused = lap_time * 5 * pow(0.1 * r.laps, random_uniform(random));
    }
    r.lap = malloc((size_t)r.laps * sizeof *r.lap);
    for (int i = 0; r.lap != NULL && i < r.laps; i++) {
        const double step = s->steps > 0 ? pow(per_step, i / STEP_LAPS) : 1;
        r.lap[i] =
            r.steady * step + running_in(s, r.scatter, i, r.end, r.laps) +
            r.drift * (i - 0.5 * r.laps) +
            r.scatter * (sqrt(s->slow) * slow + sqrt(1 - s->slow) * random_normal(random) + walk);
        slow = memory * slow + sqrt(1 - memory * memory) * random_normal(random);
        walk += s->moving * random_normal(random);
    }
    return r;
}

/* A disc at rest for a time. The load cell then shows no sliding friction. */
static void write_paused(const record_scene *s, const made_record *r, FILE *out)
{
    const int samples = 25;
    const double speed = 1e3 * 2 * pi * radius / lap_time, at_rest = 0.3;
    double time = 0;
    const bool rests = s->pause == A_REST;
    fprintf(out, rests ? "time (s),velocity (mm/s),mu,Fn (N)\n" : "time (s),laps,mu,Fn (N)\n");
    for (int i = 0; i <= r->laps * samples; i++) {
        const int lap = i < r->laps * samples ? i / samples : r->laps - 1;
        const double step = lap_time / samples;
        if (i == r->pause_at * samples) {
            for (double rest = 0; rests && rest < r->paused; rest += step)
                fprintf(out, "%.9g,0,%.9g,%.9g\n", time + rest, at_rest * r->steady, load);
            time += r->paused;
        }
        fprintf(out, "%.9g,%.9g,%.9g,%.9g\n", time, rests ? speed : i / (double)samples,
                r->lap[lap], load);
        time += step;
    }
}

/* Samples of a lap: a wave with the period of the lap. */
static void write_disc(const record_scene *s, const made_record *r, FILE *out)
{
    const double samples = s->samples > 0 ? s->samples - 0.4 : 25;
    fprintf(out, s->changing_rate ? "time (s),mu\n"
                 : s->steps > 0   ? "time (s),laps,velocity (mm/s),mu\n"
                                  : "time (s),laps,mu,Fn (N)\n");
    double at = 0;
    while (at < r->laps) {
        const int lap = (int)at;
        const double mu = r->lap[lap] * (1 + s->wave * sin(2 * pi * at)), time = lap_time * at;
        if (s->changing_rate)
            fprintf(out, "%.9g,%.9g\n", time, mu);
        else if (s->steps > 0)
            fprintf(out, "%.9g,%.9g,%.9g,%.9g\n", time, at, 10 * pow(3, lap / STEP_LAPS), mu);
        else
            fprintf(out, "%.9g,%.9g,%.9g,%.9g\n", time, at, mu, load);
        at += s->changing_rate ? (2 * lap < r->laps ? 1 : 0.2) : 1 / samples;
    }
    const double last = r->lap[r->laps - 1];
    if (!s->changing_rate) /* the last lap is complete only if another one begins */
        fprintf(out, "%.9g,%.9g,%.9g,%.9g\n", lap_time * at, at,
                s->steps > 0 ? 10 * pow(3, s->steps - 1) : last, s->steps > 0 ? last : load);
}

/* Sine of the position, friction against the motion, a nonzero force at rest. The first and the
 * last stroke are half strokes. */
static void write_strokes(const record_scene *s, const made_record *r, FILE *out)
{
    const int samples = 40;
    (void)s;
    fprintf(out, "time (s),position (mm),Ff (N),Fn (N)\n");
    for (int i = -samples / 2; i <= r->laps * samples + samples / 2; i++) {
        const double phase = 2 * pi * (i + 0.25) / samples;
        int lap = (int)floor((i + 0.25) / samples);
        lap = lap < 0 ? 0 : lap >= r->laps ? r->laps - 1 : lap;
        const double sign = sin(phase) > 0 ? 1 : -1;
        fprintf(out, "%.9g,%.9g,%.9g,%.9g\n", lap_time * i / samples + lap_time, -5 * cos(phase),
                load * r->lap[lap] * (sign + zero), load);
    }
}

static const facts *scene_facts(int scene)
{
    return &record_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static void read_step(const record_scene *s, const made_record *r, const stream *found, int row,
                      scene_draw *t)
{
    const double truth = r->steady * pow(per_step, row);
    const estimate drift = place_row(found, &place_drift, row);
    if (s->drift > 0) { /* the mean is that of a part */
        const double cycles = stream_cell(found, place_steady.table, PLACE_STEADY_CYCLES, row);
        scene_draw_add(t, Q_DRIFT, r->drift * (cycles - 1), drift);
        return;
    }
    scene_draw_add(t, Q_STEADY, truth, place_row(found, &place_steady, row));
    if (s->form == NO_RUNNING_IN)
        scene_draw_add(t, Q_DRIFT, 0, drift);
    else if (s->pause != NO_PAUSE) /* time of sliding */
        scene_draw_add(t, Q_RUNNING_IN, lap_time * r->end,
                       place_row(found, &place_running_in_time, row));
    else if (s->form != EXPONENTIAL)
        scene_draw_add(t, Q_RUNNING_IN, r->end, place_row(found, &place_running_in, row));
}

/* Measured value with its stated error. */
static int add_wear(const record_scene *s, const made_record *r, random_source *random,
                    char words[2][64], const char **arguments, double *truth)
{
    const double rate = 1e-13 * exp(random_normal(random)),
                 volume = rate * load * 2 * pi * radius * (r->laps - 1);
    int n = 0;
    *truth = rate;
    if (s->area_error > 0) {
        const double area =
            volume / (2 * pi * radius) * (1 + s->area_error * random_normal(random));
        snprintf(words[0], sizeof words[0], "%.9gm^2+-%.9g%%", area, 100 * s->area_error);
        arguments[n++] = "--track-area";
        arguments[n++] = words[0];
    } else if (s->mass_error > 0) {
        const double mass = volume * density * (1 + s->mass_error * random_normal(random));
        snprintf(words[0], sizeof words[0], "%.9gkg+-%.9g%%", mass, 100 * s->mass_error);
        snprintf(words[1], sizeof words[1], "%.9gkg/m^3", density);
        arguments[n++] = "--mass-loss";
        arguments[n++] = words[0];
        arguments[n++] = "--density";
        arguments[n++] = words[1];
    }
    return n;
}

static void read_record(const record_scene *s, const made_record *r, double rate, const char *path,
                        scene_draw *t)
{
    stream *found = stream_read(path);
    const int rows = found != NULL ? stream_rows(found, place_steady.table) : 0,
              steps = s->steps > 0 ? s->steps : 1;
    const double paused = rows > 0 && s->pause != NO_PAUSE
                              ? stream_cell(found, place_steady.table, PLACE_PAUSED, 0)
                              : 0;
    if (rows != steps) {
        scene_draw_broke(t, "another number of steps");
    } else if (s->pause != NO_PAUSE && !(fabs(paused - r->paused) < 0.2 * lap_time)) {
        scene_draw_broke(t, "another time of rest");
    } else {
        for (int row = 0; row < rows; row++)
            read_step(s, r, found, row, t);
        if (s->area_error > 0 || s->mass_error > 0)
            scene_draw_add(t, Q_WEAR_RATE, rate, place_row(found, &place_wear_rate, 0));
    }
    stream_free(found);
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const record_scene *s = &record_scenes[scene];
    const char *path = scene_draw_file(t, "record.csv"), *made = scene_draw_file(t, "found.tsv");
    const char *arguments[16] = {"record",         path,  "-o", made, "--no-provenance",
                                 "--track-radius", "12mm"};
    char words[2][64];
    double rate = 0;
    (void)prepared;
    made_record r = make_record(s, random);
    (void)add_wear(s, &r, random, words, arguments + 7, &rate);
    FILE *out = r.lap != NULL ? fopen(path, "w") : NULL;
    if (out == NULL) {
        scene_draw_broke(t, "the record cannot be written");
    } else {
        (s->strokes ? write_strokes : s->pause != NO_PAUSE ? write_paused : write_disc)(s, &r, out);
        if (ferror(out) == 0 && fclose(out) == 0 && scene_draw_run(t, arguments))
            read_record(s, &r, rate, made, t);
    }
    free(r.lap);
}

family record_family(void)
{
    return (family){
        .n = n_record_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
