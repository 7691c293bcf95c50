/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "observe.h"
#include "program.h"
#include "sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* How many places along a curve are compared. */
#define ALONG 9

typedef struct files {
    char sweep[512], master[512], friction[512], kept[512], layer[512], errors[512];
} files;

static files name_files(const stage *st, const scene *s, int number)
{
    files f;
    const struct {
        char *to;
        const char *name;
    } all[] = {{f.sweep, "sweep.csv"}, {f.master, "master.tsv"}, {f.friction, "friction.tsv"},
               {f.kept, "kept.tsv"},   {f.layer, "layer.tsv"},   {f.errors, "errors.txt"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        snprintf(all[i].to, sizeof f.sweep, "%s/%s-%d-%s", st->folder, s->name, number,
                 all[i].name);
    return f;
}

static void remove_files(const files *f)
{
    const char *const all[] = {f->sweep, f->master, f->friction, f->kept, f->layer, f->errors};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        unlink(all[i]);
}

static void note_failure(draw *to, int status, const files *f)
{
    FILE *words = fopen(f->errors, "r");
    if (to->status != 0)
        status = to->status;
    to->status = status;
    /* 1 is an error of data that is explained; others are misuse of the command, or a crash */
    if (status == 1 && to->outcome == OUTCOME_GOOD)
        to->outcome = OUTCOME_REFUSED;
    else if (status != 1)
        to->outcome = OUTCOME_BROKEN;
    if (words == NULL)
        return;
    char line[sizeof to->words];
    while (fgets(line, sizeof line, words) != NULL) {
        line[strcspn(line, "\n\t")] = '\0';
        if (strstr(line, ": warning: ") == NULL && to->words[0] == '\0')
            snprintf(to->words, sizeof to->words, "%s", line);
    }
    fclose(words);
}

static bool run(const stage *st, const char *const *arguments, const files *f, draw *to)
{
    struct timespec before, after;
    clock_gettime(CLOCK_MONOTONIC, &before);
    const int status = program_run(st->program, arguments, f->errors);
    clock_gettime(CLOCK_MONOTONIC, &after);
    to->seconds +=
        (double)(after.tv_sec - before.tv_sec) + 1e-9 * (double)(after.tv_nsec - before.tv_nsec);
    if (status != 0)
        note_failure(to, status, f);
    return status == 0;
}

static void add(draw *to, quantity q, double truth, estimate found)
{
    if (to->n < OBSERVATIONS_MAX)
        to->observations[to->n++] = (observation){q, truth, found};
}

/* The law at a temperature as a reader of C1, C2, their errors and their correlation works it out.
 */
static estimate law_of_constants(const stream *t, const scene *s, double temperature)
{
    const estimate c1 = place_key(t, &place_c1), c2 = place_key(t, &place_c2);
    const double e1 = (c1.high - c1.low) / 2, e2 = (c2.high - c2.low) / 2;
    const double together = stream_number(t, place_shift.table, PLACE_CORRELATION, NULL) * e1 * e2;
    const double d = temperature - s->reference, below = c2.value + d;
    const double value = -c1.value * d / below;
    const double g1 = -d / below, g2 = c1.value * d / (below * below);
    const double half = sqrt(g1 * g1 * e1 * e1 + g2 * g2 * e2 * e2 + 2 * g1 * g2 * together);
    if (!(below > 0)) /* beyond the pole there is no law */
        return (estimate){(double)NAN, (double)NAN, (double)NAN};
    return (estimate){value, value - half, value + half};
}

/* The shift of an isotherm is relative to the isotherm of the reference, both at the temperatures
 * that they really had. */
static void compare_shifts(const stream *t, const scene *s, const sample *measured, draw *to)
{
    double zero = 0;
    for (int i = 0; i < measured->n; i++)
        if (fabs(measured->isotherms[i].temperature - s->reference) < 0.01)
            zero = law_shift(&s->law, s->reference, measured->isotherms[i].true_temperature);
    for (int row = 0; row < stream_rows(t, place_shift.table); row++) {
        const double at = stream_cell(t, place_shift.table, PLACE_TEMPERATURE, row) - 273.15;
        for (int i = 0; i < measured->n; i++) {
            const isotherm *m = &measured->isotherms[i];
            if (fabs(m->temperature - at) > 0.01 || fabs(at - s->reference) < 0.01)
                continue;
            add(to, Q_SHIFT, law_shift(&s->law, s->reference, m->true_temperature) - zero,
                place_row(t, &place_shift, row));
            const estimate law = place_row(t, &place_law, row);
            add(to, Q_LAW, law_shift(&s->law, s->reference, at),
                isnan(law.low) ? law_of_constants(t, s, at) : law);
        }
    }
}

static void compare_constants(const stream *t, const scene *s, draw *to)
{
    const double reach = s->reference - s->law.t_inf;
    add(to, Q_C1, s->law.b / reach, place_key(t, &place_c1));
    add(to, Q_C2, reach, place_key(t, &place_c2));
    const double outside[] = {s->first - 10, s->last + 10};
    for (int i = 0; i < 2; i++)
        add(to, Q_LAW_OUTSIDE, law_shift(&s->law, s->reference, outside[i]),
            law_of_constants(t, s, outside[i]));
}

static int ascending(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* The stated interval of the row whose frequency is nearest. */
static void compare_row(const stream *t, const scene *s, const rubber *r, double omega, draw *to)
{
    const rubber_state state = scene_state(s, r, s->reference);
    int nearest = 0;
    double distance = (double)INFINITY, storage, loss;
    for (int row = 0; row < stream_rows(t, place_storage.table); row++) {
        const double w = stream_cell(t, place_storage.table, PLACE_FREQUENCY, row);
        if (fabs(log(w / omega)) < distance) {
            distance = fabs(log(w / omega));
            nearest = row;
        }
    }
    state_moduli(&state, stream_cell(t, place_storage.table, PLACE_FREQUENCY, nearest), &storage,
                 &loss);
    add(to, Q_STORAGE, storage, place_row(t, &place_storage, nearest));
    add(to, Q_LOSS, loss, place_row(t, &place_loss, nearest));
}

/* The sum of the terms; its error is that of the curve beside it, if one is stated. */
static void compare_prony(const stream *t, const scene *s, const rubber *r, double omega, draw *to)
{
    const rubber_state state = scene_state(s, r, s->reference);
    double storage, loss, sum_storage = place_key(t, &place_equilibrium).value, sum_loss = 0;
    for (int row = 0; row < stream_rows(t, PLACE_PRONY); row++) {
        const double z = omega * stream_cell(t, PLACE_PRONY, PLACE_PRONY_TIME, row);
        const double term = stream_cell(t, PLACE_PRONY, PLACE_PRONY_MODULUS, row) * z / (1 + z * z);
        sum_storage += term * z;
        sum_loss += term;
    }
    state_moduli(&state, omega, &storage, &loss);
    const observation *curve = &to->observations[to->n - 2]; /* of compare_row */
    const estimate es = curve[0].found, el = curve[1].found;
    const double ds = (es.high - es.low) / 2 * sum_storage / es.value;
    const double dl = (el.high - el.low) / 2 * sum_loss / el.value;
    add(to, Q_PRONY_STORAGE, storage, (estimate){sum_storage, sum_storage - ds, sum_storage + ds});
    add(to, Q_PRONY_LOSS, loss, (estimate){sum_loss, sum_loss - dl, sum_loss + dl});
}

/* At frequencies spread evenly over the logarithms of those of the master curve, the ends too. */
static void compare_curve(const stream *t, const scene *s, const rubber *r, draw *to)
{
    const int n = stream_rows(t, place_storage.table);
    double *omega = malloc((size_t)(n + 1) * sizeof *omega);
    if (omega == NULL)
        abort();
    int m = 0;
    for (int row = 0; row < n; row++) {
        const double w = stream_cell(t, place_storage.table, PLACE_FREQUENCY, row);
        if (w > 0)
            omega[m++] = w;
    }
    qsort(omega, (size_t)m, sizeof *omega, ascending);
    for (int k = 0; k < ALONG && m > 1; k++) {
        const double w = omega[0] * pow(omega[m - 1] / omega[0], k / (ALONG - 1.0));
        compare_row(t, s, r, w, to);
        compare_prony(t, s, r, w, to);
    }
    add(to, Q_EQUILIBRIUM, scene_state(s, r, s->reference).factor * r->equilibrium,
        place_key(t, &place_equilibrium));
    free(omega);
}

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

static verdict read_verdict(const stream *t)
{
    const char *text = stream_key(t, place_shift.table, PLACE_VERDICT);
    if (text == NULL)
        return NO_VERDICT;
    return begins(text, PLACE_HOLDS)                                        ? HOLDS
           : begins(text, PLACE_FAILS)                                      ? FAILS
           : begins(text, PLACE_CANNOT_SAY) || begins(text, PLACE_UNTESTED) ? CANNOT_SAY
                                                                            : NO_VERDICT;
}

static void compare_master(const files *f, const scene *s, const rubber *r, const sample *measured,
                           draw *to)
{
    stream *t = stream_read(f->master);
    if (t == NULL || stream_rows(t, place_shift.table) == 0) {
        to->outcome = OUTCOME_BROKEN;
        snprintf(to->words, sizeof to->words, "no table %s in what was written", place_shift.table);
    } else {
        to->verdict = read_verdict(t);
        compare_shifts(t, s, measured, to);
        compare_constants(t, s, to);
        compare_curve(t, s, r, to);
    }
    stream_free(t);
}

typedef struct contact_words {
    char roughness[200], pressure[40], velocities[VELOCITIES_MAX * 32], temperature[40],
        shear_stress[40], one_velocity[40], wear[48], energy[40];
} contact_words;

static contact_words say(const contact *c)
{
    contact_words w;
    snprintf(w.roughness, sizeof w.roughness,
             "self-affine:q0=%.15grad/m,qr=%.15grad/m,q1=%.15grad/m,hurst=%.15g,c0=%.15gm^4", c->q0,
             c->qr, c->q1, c->hurst, c->c0);
    snprintf(w.pressure, sizeof w.pressure, "%.15gPa", c->pressure);
    snprintf(w.temperature, sizeof w.temperature, "%.15gdegC", c->temperature);
    snprintf(w.shear_stress, sizeof w.shear_stress, "%.15gPa", c->shear_stress);
    snprintf(w.one_velocity, sizeof w.one_velocity, "%.15gm/s", c->velocity[c->layer_at]);
    snprintf(w.wear, sizeof w.wear, "%.15gm^2/N", c->wear_rate);
    snprintf(w.energy, sizeof w.energy, "%.15gJ/m^3", c->critical_energy);
    w.velocities[0] = '\0';
    for (int i = 0; i < c->velocities; i++) {
        const size_t used = strlen(w.velocities);
        snprintf(w.velocities + used, sizeof w.velocities - used, "%s%.15gm/s", i > 0 ? "," : "",
                 c->velocity[i]);
    }
    return w;
}

static void compare_friction(const char *path, const contact *c, const contact_truth *truth,
                             bool kept, draw *to)
{
    stream *t = stream_read(path);
    if (t == NULL)
        return;
    for (int i = 0; i < c->velocities; i++)
        for (int row = 0; row < stream_rows(t, place_hysteresis.table); row++) {
            const double v = stream_cell(t, place_hysteresis.table, PLACE_VELOCITY, row);
            if (fabs(v / c->velocity[i] - 1) > 1e-6)
                continue;
            add(to, kept ? Q_HYSTERESIS_KEPT : Q_HYSTERESIS, truth->hysteresis[i],
                place_row(t, &place_hysteresis, row));
            add(to, kept ? Q_AREA_KEPT : Q_AREA, truth->area[i], place_row(t, &place_area, row));
            if (!kept)
                add(to, Q_FRICTION, truth->friction[i], place_row(t, &place_friction, row));
        }
    stream_free(t);
}

/* The master curve of one draw goes into friction from the isotherms and from what was stored. */
static void observe_contact(const stage *st, const scene *s, const contact_truth *truth,
                            const char *reference, const files *f, draw *to)
{
    const contact *c = s->contact;
    const contact_words w = say(c);
    const char *const common[] = {"--roughness",
                                  w.roughness,
                                  "--pressure",
                                  w.pressure,
                                  "--shear-stress",
                                  w.shear_stress,
                                  "--sliding-temperature",
                                  w.temperature,
                                  "--threads",
                                  "1",
                                  "--quiet",
                                  "--no-provenance"};
    enum { COMMON = sizeof common / sizeof common[0] };
    const char *friction[COMMON + 16] = {
        "friction",  "--velocity", w.velocities, "-o",
        f->friction, "--dma",      f->sweep,     "--reference-temperature",
        reference};
    const char *kept[COMMON + 16] = {"friction", "--velocity", w.velocities, "-o",
                                     f->kept,    "--material", f->master};
    const char *layer[COMMON + 16] = {"layer",        "--velocity",
                                      w.one_velocity, "-o",
                                      f->layer,       "--dma",
                                      f->sweep,       "--reference-temperature",
                                      reference,      "--specific-wear-rate",
                                      w.wear,         "--critical-energy",
                                      w.energy};
    memcpy(friction + 9, common, sizeof common);
    memcpy(kept + 7, common, sizeof common);
    memcpy(layer + 13, common, sizeof common);
    if (run(st, friction, f, to))
        compare_friction(f->friction, c, truth, false, to);
    if (run(st, kept, f, to))
        compare_friction(f->kept, c, truth, true, to);
    if (run(st, layer, f, to)) {
        stream *t = stream_read(f->layer);
        if (t != NULL)
            add(to, Q_THICKNESS, truth->thickness, place_key(t, &place_thickness));
        stream_free(t);
    }
}

void observe(const stage *st, const scene *s, const rubber *r, const contact_truth *truth,
             int number, draw *to)
{
    const files f = name_files(st, s, number);
    random_source random = random_for(st->seed, s->name, (uint64_t)number);
    sample *measured = calloc(1, sizeof *measured);
    char reference[40];
    *to = (draw){.verdict = NO_VERDICT};
    if (measured == NULL)
        abort();
    sample_draw(s, r, &random, measured);
    snprintf(reference, sizeof reference, "%.15gdegC", s->reference);
    const char *const master[] = {"master",    "-o",
                                  f.master,    "--reference-temperature",
                                  reference,   "--no-provenance",
                                  f.sweep,     s->vertical ? "--vertical-shift" : NULL,
                                  s->vertical, NULL};
    if (sample_write(s, measured, f.sweep) != 0) {
        to->outcome = OUTCOME_BROKEN;
        snprintf(to->words, sizeof to->words, "cannot write the isotherms");
    } else if (run(st, master, &f, to)) {
        compare_master(&f, s, r, measured, to);
        if (s->contact != NULL)
            observe_contact(st, s, truth, reference, &f, to);
    }
    free(measured);
    if (!st->keep)
        remove_files(&f);
}
