/* Observes isotherms through master, friction and layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma_observe.h"
#include "dma_sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Number of compared points of a curve. */
#define ALONG 9

/* True if C1 and C2 state the law at a temperature. */
static bool is_wlf(const stream *t, double temperature)
{
    const char *law = stream_key(t, place_shift.table, PLACE_LAW);
    const double joint = stream_number(t, place_shift.table, PLACE_JOINT, NULL) - 273.15;
    return law == NULL || strcmp(law, PLACE_LAW_WLF) == 0 || temperature >= joint;
}

/* The law at a temperature from C1, C2, their errors and their correlation. */
static estimate law_of_constants(const stream *t, const dma_scene *s, double temperature)
{
    const estimate c1 = place_key(t, &place_c1), c2 = place_key(t, &place_c2);
    const double e1 = (c1.high - c1.low) / 2, e2 = (c2.high - c2.low) / 2;
    const double together = stream_number(t, place_shift.table, PLACE_CORRELATION, NULL) * e1 * e2;
    const double d = temperature - s->reference, below = c2.value + d;
    const double value = -c1.value * d / below;
    const double g1 = -d / below, g2 = c1.value * d / (below * below);
    const double half = sqrt(g1 * g1 * e1 * e1 + g2 * g2 * e2 * e2 + 2 * g1 * g2 * together);
    if (!(below > 0) || !is_wlf(t, temperature)) /* no law beyond the pole */
        return (estimate){(double)NAN, (double)NAN, (double)NAN};
    return (estimate){value, value - half, value + half};
}

/* Superposition does not hold: only the shifts have true values. */
static bool is_failing(const dma_scene *s)
{
    return (s->facts.right & ~RIGHT(INCONCLUSIVE)) == RIGHT(NO);
}

/* Shift relative to the reference isotherm, both at their true temperatures. Two processes with
 * different laws have no single shift; any value between the two is right. */
static double true_shift(const dma_scene *s, double temperature, double reference, double found)
{
    const shift_law law[] = {s->law, dma_second_law(s)};
    double shift[2];
    for (int p = 0; p < 2; p++)
        shift[p] = law_shift(&law[p], s->reference, temperature) -
                   law_shift(&law[p], s->reference, reference);
    return fmax(fmin(shift[0], shift[1]), fmin(found, fmax(shift[0], shift[1])));
}

static void compare_shifts(const stream *t, const dma_scene *s, const sample *measured,
                           scene_draw *to)
{
    double reference = s->reference;
    for (int i = 0; i < measured->n; i++)
        if (fabs(measured->isotherms[i].temperature - s->reference) < 0.01)
            reference = measured->isotherms[i].true_temperature;
    for (int row = 0; row < stream_rows(t, place_shift.table); row++) {
        const double at = stream_cell(t, place_shift.table, PLACE_TEMPERATURE, row) - 273.15;
        for (int i = 0; i < measured->n; i++) {
            const isotherm *m = &measured->isotherms[i];
            if (fabs(m->temperature - at) > 0.01 || fabs(at - s->reference) < 0.01)
                continue;
            const estimate shift = place_row(t, &place_shift, row);
            scene_draw_add(to, Q_SHIFT, true_shift(s, m->true_temperature, reference, shift.value),
                           shift);
            if (is_failing(s))
                continue;
            const estimate law = place_row(t, &place_law, row);
            scene_draw_add(to, Q_LAW, law_shift(&s->law, s->reference, at),
                           isnan(law.low) ? law_of_constants(t, s, at) : law);
        }
    }
}

static void compare_constants(const stream *t, const dma_scene *s, scene_draw *to)
{
    const double reach = s->reference - s->law.t_inf;
    scene_draw_add(to, Q_C1, s->law.b / reach, place_key(t, &place_c1));
    scene_draw_add(to, Q_C2, reach, place_key(t, &place_c2));
    const double outside[] = {s->first - 10, s->last + 10};
    for (int i = 0; i < 2; i++)
        scene_draw_add(to, Q_LAW_OUTSIDE, law_shift(&s->law, s->reference, outside[i]),
                       law_of_constants(t, s, outside[i]));
}

static int ascending(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* Quantity of the stated moduli: at the reference temperature, E or G. */
static rubber_state stated_state(const dma_scene *s, const rubber *r)
{
    rubber_state state = dma_state(s, r, s->reference);
    state.factor *= dma_part_of_e(s);
    return state;
}

/* Stated interval of the row with the nearest frequency. */
static void compare_row(const stream *t, const dma_scene *s, const rubber *r, double omega,
                        scene_draw *to)
{
    const rubber_state state = stated_state(s, r);
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
    scene_draw_add(to, Q_STORAGE, storage, place_row(t, &place_storage, nearest));
    scene_draw_add(to, Q_LOSS, loss, place_row(t, &place_loss, nearest));
}

/* Sum of the terms; its error is that of the curve with it, if stated. */
static void compare_prony(const stream *t, const dma_scene *s, const rubber *r, double omega,
                          scene_draw *to)
{
    if (stream_rows(t, PLACE_PRONY) == 0)
        return; /* one modulus alone determines no series */
    const rubber_state state = stated_state(s, r);
    double storage, loss, sum_storage = place_key(t, &place_equilibrium).value, sum_loss = 0;
    for (int row = 0; row < stream_rows(t, PLACE_PRONY); row++) {
        const double z = omega * stream_cell(t, PLACE_PRONY, PLACE_PRONY_TIME, row);
        const double term = stream_cell(t, PLACE_PRONY, PLACE_PRONY_MODULUS, row) * z / (1 + z * z);
        sum_storage += term * z;
        sum_loss += term;
    }
    state_moduli(&state, omega, &storage, &loss);
    /* argument of compare_row */
    const observation *curve = &to->draw->observations[to->draw->n - 2];
    const estimate es = curve[0].found, el = curve[1].found;
    const double ds = (es.high - es.low) / 2 * sum_storage / es.value;
    const double dl = (el.high - el.low) / 2 * sum_loss / el.value;
    scene_draw_add(to, Q_PRONY_STORAGE, storage,
                   (estimate){sum_storage, sum_storage - ds, sum_storage + ds});
    scene_draw_add(to, Q_PRONY_LOSS, loss, (estimate){sum_loss, sum_loss - dl, sum_loss + dl});
}

/* Frequencies at equal logarithmic distances over the master curve, with both ends. */
static void compare_curve(const stream *t, const dma_scene *s, const rubber *r, scene_draw *to)
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
    scene_draw_add(to, Q_EQUILIBRIUM, stated_state(s, r).factor * r->equilibrium,
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
    if (begins(text, PLACE_HOLDS))
        return YES;
    if (begins(text, PLACE_FAILS))
        return NO;
    return begins(text, PLACE_INCONCLUSIVE) || begins(text, PLACE_UNTESTED) ? INCONCLUSIVE
                                                                            : NO_VERDICT;
}

static void compare_master(const char *path, const dma_scene *s, const rubber *r,
                           const sample *measured, scene_draw *to)
{
    stream *t = stream_read(path);
    if (t == NULL || stream_rows(t, place_shift.table) == 0) {
        scene_draw_broke(to, "no shift factors in what was written");
        stream_free(t);
        return;
    }
    to->draw->verdict = read_verdict(t);
    compare_shifts(t, s, measured, to);
    if (!is_failing(s)) {
        compare_constants(t, s, to);
        compare_curve(t, s, r, to);
    }
    stream_free(t);
}

static void compare_friction(const char *path, const contact *c, const contact_truth *truth,
                             bool kept, scene_draw *to)
{
    stream *t = stream_read(path);
    if (t == NULL) {
        scene_draw_broke(to, "no friction in what was written");
        return;
    }
    for (int i = 0; i < c->velocities; i++)
        for (int row = 0; row < stream_rows(t, place_hysteresis.table); row++) {
            const double v = stream_cell(t, place_hysteresis.table, PLACE_VELOCITY, row);
            if (fabs(v / c->velocity[i] - 1) > 1e-6)
                continue;
            scene_draw_add(to, kept ? Q_HYSTERESIS_KEPT : Q_HYSTERESIS, truth->hysteresis[i],
                           place_row(t, &place_hysteresis, row));
            scene_draw_add(to, kept ? Q_AREA_KEPT : Q_AREA, truth->area[i],
                           place_row(t, &place_area, row));
            if (!kept)
                scene_draw_add(to, Q_FRICTION, truth->friction[i],
                               place_row(t, &place_friction, row));
        }
    stream_free(t);
}

static void compare_layer(const char *path, const contact_truth *truth, scene_draw *to)
{
    stream *t = stream_read(path);
    if (t == NULL)
        scene_draw_broke(to, "no layer in what was written");
    else
        scene_draw_add(to, Q_THICKNESS, truth->thickness, place_key(t, &place_thickness));
    stream_free(t);
}

/* Builder of a command line. */
typedef struct line {
    const char *words[50];
    int n;
    char numbers[20][200];
    int n_numbers;
} line;

static void append_argument(line *l, const char *option, const char *value)
{
    if (value == NULL)
        return;
    l->words[l->n++] = option;
    l->words[l->n++] = value;
}

static void append_number(line *l, const char *option, double value, const char *unit)
{
    char *text = l->numbers[l->n_numbers++];
    snprintf(text, sizeof l->numbers[0], "%.15g%s", value, unit);
    append_argument(l, option, text);
}

/* " +- 7%" after a unit, or "". */
typedef struct share {
    char words[32];
} share;

static share stated_error(double error)
{
    share s = {""};
    if (error > 0)
        snprintf(s.words, sizeof s.words, " +- %.15g%%", 100 * error);
    return s;
}

static void append_uncertain(line *l, const char *option, double value, const char *unit,
                             double error)
{
    char words[48];
    snprintf(words, sizeof words, "%s%s", unit, stated_error(error).words);
    append_number(l, option, value, words);
}

static void append_contact(line *l, const contact *c)
{
    char *roughness = l->numbers[l->n_numbers++];
    snprintf(roughness, sizeof l->numbers[0],
             "self-affine:q0=%.15grad/m,qr=%.15grad/m,q1=%.15grad/m,hurst=%.15g,c0=%.15gm^4%s",
             c->q0, c->qr, c->q1, c->hurst, c->c0, stated_error(c->error).words);
    append_argument(l, "--roughness", roughness);
    append_uncertain(l, "--pressure", c->pressure, "Pa", c->error);
    append_number(l, "--sliding-temperature", c->temperature, "degC");
    append_number(l, "--poisson-ratio", c->poisson, "");
    append_argument(l, "--threads", "1");
}

static void append_velocities(line *l, const contact *c)
{
    char *text = l->numbers[l->n_numbers++];
    size_t used = 0;
    for (int i = 0; i < c->velocities && used < sizeof l->numbers[0]; i++)
        used += (size_t)snprintf(text + used, sizeof l->numbers[0] - used, "%s%.15gm/s",
                                 i > 0 ? "," : "", c->velocity[i]);
    append_argument(l, "--velocity", text);
}

static void append_isotherms(line *l, const dma_scene *s, const char *sweep)
{
    append_number(l, "--sample-temperature-error", s->oven, "K");
    append_argument(l, "--dma", sweep);
    append_number(l, "--reference-temperature", s->reference, "degC");
    append_argument(l, "--vertical-shift", s->vertical);
}

static bool run(line *l, const char *output, scene_draw *t)
{
    append_argument(l, "-o", output);
    l->words[l->n++] = "--no-provenance";
    l->words[l->n] = NULL;
    return scene_draw_run(t, l->words);
}

/* Friction from the isotherms and from the stored master curve, and the layer. */
static void observe_contact(const dma_scene *s, const contact_truth *truth, const char *sweep,
                            const char *master, scene_draw *t)
{
    const contact *c = s->contact;
    const char *friction = scene_draw_file(t, "friction.tsv"),
               *kept = scene_draw_file(t, "kept.tsv");
    const char *layer = scene_draw_file(t, "layer.tsv");
    line from_sweep = {.words = {"friction"}, .n = 1}, from_master = from_sweep;
    append_contact(&from_sweep, c);
    append_uncertain(&from_sweep, "--shear-stress", c->shear_stress, "Pa", c->error);
    append_velocities(&from_sweep, c);
    append_isotherms(&from_sweep, s, sweep);
    if (run(&from_sweep, friction, t))
        compare_friction(friction, c, truth, false, t);
    append_contact(&from_master, c);
    append_uncertain(&from_master, "--shear-stress", c->shear_stress, "Pa", c->error);
    append_velocities(&from_master, c);
    append_argument(&from_master, "--material", master);
    if (run(&from_master, kept, t))
        compare_friction(kept, c, truth, true, t);
    line wear = {.words = {"layer"}, .n = 1};
    append_contact(&wear, c);
    append_isotherms(&wear, s, sweep);
    append_number(&wear, "--velocity", c->velocity[c->layer_compute_energy], "m/s");
    append_uncertain(&wear, "--specific-wear-rate", c->wear_rate, "m^2/N", c->error);
    append_uncertain(&wear, "--critical-energy", c->critical_energy, "J/m^3", c->error);
    if (run(&wear, layer, t))
        compare_layer(layer, truth, t);
}

/* True contact where its inputs have errors. */
static contact_truth draw_contact(const dma_scene *s, const rubber *r, random_source *random)
{
    contact c = *s->contact;
    double *const uncertain[] = {&c.c0, &c.pressure, &c.shear_stress, &c.wear_rate,
                                 &c.critical_energy};
    for (size_t i = 0; i < sizeof uncertain / sizeof uncertain[0]; i++)
        *uncertain[i] *= exp(c.error * random_normal(random));
    const rubber_state state = dma_state(s, r, c.temperature);
    return contact_solve(&c, &state, 50);
}

typedef struct prepared {
    rubber rubber;
    contact_truth truth;
} prepared;

static const facts *scene_facts(int scene)
{
    return &dma_scenes[scene].facts;
}

static void *prepare(int scene)
{
    const dma_scene *s = &dma_scenes[scene];
    prepared *p = calloc(1, sizeof *p);
    if (p == NULL)
        abort();
    p->rubber = rubber_make(s->rubber);
    if (s->contact != NULL) {
        const rubber_state state = dma_state(s, &p->rubber, s->contact->temperature);
        p->truth = contact_solve(s->contact, &state, 100);
    }
    return p;
}

static void observe(int scene, const void *what, random_source *random, scene_draw *t)
{
    const dma_scene *s = &dma_scenes[scene];
    const prepared *p = what;
    const char *sweep = scene_draw_file(t, "sweep.csv"), *master = scene_draw_file(t, "master.tsv");
    sample *measured = calloc(1, sizeof *measured);
    line l = {.words = {"master", sweep}, .n = 2};
    if (measured == NULL)
        abort();
    t->reads_part = true; /* without an isotherm that does not belong to the others */
    sample_draw(s, &p->rubber, random, measured);
    append_number(&l, "--reference-temperature", s->reference, "degC");
    append_argument(&l, "--vertical-shift", s->vertical);
    append_argument(&l, "--shift-by", s->by);
    append_number(&l, "--sample-temperature-error", s->oven, "K");
    if (sample_write(s, measured, sweep) != 0) {
        scene_draw_broke(t, "the isotherms cannot be written");
    } else if (run(&l, master, t)) {
        if (s->oven == 0) /* otherwise law and moduli are those of stated temperatures */
            compare_master(master, s, &p->rubber, measured, t);
        contact_truth truth = p->truth;
        if (s->contact != NULL && s->contact->error > 0)
            truth = draw_contact(s, &p->rubber, random);
        if (s->contact != NULL)
            observe_contact(s, &truth, sweep, master, t);
    }
    free(measured);
}

family dma_family(void)
{
    return (family){
        .n = n_dma_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
