/* A layer in time through weartrack layer. SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer_observe.h"
#include "layer_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const contact nominal = {.q0 = 2e3,
                                .qr = 4e3,
                                .q1 = 1e6,
                                .hurst = 0.8,
                                .c0 = 2e-17,
                                .pressure = 0.4e6,
                                .shear_stress = 5e6,
                                .poisson = 0.5,
                                .temperature = 20,
                                .velocities = 1,
                                .velocity = {0.3}};
/* Fewer than by default: they cost most of a draw, and scatter the errors by 8 %. */
static const char replicates[] = "80", few[] = "24"; /* of moduli at each wave */
/* Edges are looked for between these velocities, which are those of the command. */
static const char list[] = "3e-3:30m/s:log:9"; /* the middle one is that of the contact */
static const double slowest = 3e-3, fastest = 30;

static const facts *scene_facts(int scene)
{
    return &layer_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

/* ---- truth ----------------------------------------------------------------------------------- */

typedef struct looking {
    const contact *contact;
    const rubber_state *state;
    double severity;
    slide slide;
    heat heat;
} looking;

/* Is there a layer at a velocity, at the pressure of the contact? */
static bool is_formed(looking *l, double velocity)
{
    slide_make(l->contact, l->state, velocity, &l->slide);
    heat_make(&l->slide, l->contact->pressure, l->severity, &l->heat);
    return l->heat.surface > l->contact->critical_energy * l->heat.wear;
}

/* Up to which velocity; NaN: none of the list's ends is that of a layer, or both are. */
static double edge_of(const contact *c, const rubber_state *state, double severity)
{
    looking *l = malloc(sizeof *l);
    double low = slowest, high = fastest;
    if (l == NULL)
        abort();
    *l = (looking){.contact = c, .state = state, .severity = severity};
    const bool there = is_formed(l, low) && !is_formed(l, high);
    for (int k = 0; k < 24; k++) {
        const double middle = sqrt(low * high);
        *(is_formed(l, middle) ? &low : &high) = middle;
    }
    free(l);
    return there ? low : (double)NAN;
}

typedef struct layer_truth {
    double thickness, first, edge;
    settling settling;
} layer_truth;

static layer_truth solve(const layer_context *s, const contact *c, const rubber_state *state,
                         double ratio)
{
    slide *slides = malloc((LOADS_MAX + 1) * sizeof *slides);
    heat *heats = malloc((LOADS_MAX + 1) * sizeof *heats);
    history h = {.n = s->loads};
    layer_truth truth = {.edge = (double)NAN};
    double time = 0;
    if (slides == NULL || heats == NULL)
        abort();
    for (int i = 0; i < s->loads; i++) {
        slide_make(c, state, s->load[i].velocity * nominal.velocity[0], &slides[i]);
        heat_make(&slides[i], s->load[i].pressure * c->pressure, s->severity, &heats[i]);
        h.load[i] = &heats[i];
        h.lasts[i] = s->load[i].lasts;
        time += s->load[i].lasts;
    }
    truth.thickness = history_thickness(&h, time);
    truth.first = history_first(&h, time);
    slide_make(c, state, nominal.velocity[0], &slides[LOADS_MAX]);
    heat_make(&slides[LOADS_MAX], c->pressure, s->severity, &heats[LOADS_MAX]);
    own_ratio own = s->own;
    own.ratio = ratio;
    if (own.slope == 0)
        truth.settling = settle(&heats[LOADS_MAX], ratio);
    else
        truth.settling = (settling){slide_on_own(&slides[LOADS_MAX], state, c->pressure,
                                                 heat_balance(&heats[LOADS_MAX]), &own),
                                    (double)NAN};
    if (s->severity > 0)
        truth.edge = edge_of(c, state, s->severity);
    free(slides);
    free(heats);
    return truth;
}

/* ---- the command ----------------------------------------------------------------------------- */

static void read_found(const layer_context *s, const layer_truth *truth, const char *path, trial *t)
{
    stream *found = stream_read(path);
    if (found == NULL) {
        trial_broke(t, "there is no table");
        return;
    }
    trial_add(t, Q_HISTORY_THICKNESS, truth->thickness, place_key(found, &place_last_thickness));
    trial_add(t, Q_FIRST_APPEARANCE, truth->first, place_key(found, &place_first_appearance));
    if (s->own.slope == 0)
        trial_add(t, Q_SETTLED, truth->settling.settled, place_key(found, &place_settled));
    trial_add(t, Q_END_FRICTION, truth->settling.end, place_key(found, &place_end_friction));
    if (s->severity > 0)
        trial_add(t, Q_EDGE_VELOCITY, truth->edge, place_key(found, &place_edge_velocity));
    stream_free(found);
}

/* The loads, of which the last one is looked at at its end. */
static void say_loads(const layer_context *s, char *loads, size_t size, char *times, size_t n)
{
    double end = 0;
    loads[0] = '\0';
    for (int i = 0; i < s->loads; i++) {
        const layer_load *l = &s->load[i];
        const size_t used = strlen(loads);
        end += l->lasts;
        snprintf(loads + used, size - used, "%s", i > 0 ? ";" : "");
        if (i + 1 < s->loads)
            snprintf(loads + strlen(loads), size - strlen(loads), "time=%gs,", l->lasts);
        snprintf(loads + strlen(loads), size - strlen(loads), "pressure=%gPa,velocity=%gm/s",
                 l->pressure * nominal.pressure, l->velocity * nominal.velocity[0]);
    }
    snprintf(times, n, "%gs", end);
}

typedef struct words {
    char surface[160], pressure[48], wear[48], energy[48], shear[48], ratio[48], loads[320],
        severity[48], times[48], slope[48], reference[48], low[48], high[48];
} words;

/* What is measured of the truth, with the errors that are stated. */
static void say_inputs(const layer_context *s, const contact *truth, double ratio,
                       random_source *random, words *w)
{
    snprintf(w->surface, sizeof w->surface,
             "self-affine:q0=%grad/m,qr=%grad/m,q1=%grad/m,hurst=%g,c0=%.9gm^4+-%g%%", nominal.q0,
             nominal.qr, nominal.q1, nominal.hurst, random_about(truth->c0, s->of_surface, random),
             100 * s->of_surface);
    snprintf(w->pressure, sizeof w->pressure, "%gPa+-%g%%", nominal.pressure, 100 * s->of_load);
    snprintf(w->wear, sizeof w->wear, "%.9gm^2/N+-%g%%",
             random_about(truth->wear_rate, s->of_wear, random), 100 * s->of_wear);
    snprintf(w->energy, sizeof w->energy, "%.9gJ/m^3+-%g%%",
             random_about(truth->critical_energy, s->of_energy, random), 100 * s->of_energy);
    snprintf(w->shear, sizeof w->shear, "%.9gPa+-%g%%",
             random_about(truth->shear_stress, s->of_shear, random), 100 * s->of_shear);
    snprintf(w->ratio, sizeof w->ratio, "%.9g+-%g%%", random_about(ratio, s->of_ratio, random),
             100 * s->of_ratio);
    snprintf(w->severity, sizeof w->severity, "%gW/m^2", s->severity);
    snprintf(w->slope, sizeof w->slope, "%.9g+-%g",
             s->own.slope + s->of_slope * random_normal(random), s->of_slope);
    snprintf(w->reference, sizeof w->reference, "%grad/s", s->own.reference);
    snprintf(w->low, sizeof w->low, "%grad/s", s->own.low);
    snprintf(w->high, sizeof w->high, "%grad/s", s->own.high);
    say_loads(s, w->loads, sizeof w->loads, w->times, sizeof w->times);
}

/* Of the loads at one time, of running-in at the times that the command chooses. */
static bool run_command(const layer_context *s, const words *w, const char *material,
                        const char *made, const char *grown, trial *t)
{
    const char *const slope = s->own.slope != 0 && !s->as_one ? "--ratio-slope" : NULL;
    const char *const in_turn[] = {"layer",     "--material",
                                   material,    "--roughness",
                                   w->surface,  "--pressure",
                                   w->pressure, "--velocity",
                                   "0.3m/s",    "--specific-wear-rate",
                                   w->wear,     "--critical-energy",
                                   w->energy,   "--severity-power",
                                   w->severity, "--loads",
                                   w->loads,    "--times",
                                   w->times,    "--replicates",
                                   replicates,  "-o",
                                   made,        "--no-provenance",
                                   NULL};
    const char *const friction[] = {"layer",
                                    "--material",
                                    material,
                                    "--roughness",
                                    w->surface,
                                    "--pressure",
                                    w->pressure,
                                    "--velocity",
                                    s->severity > 0 ? list : "0.3m/s",
                                    "--specific-wear-rate",
                                    w->wear,
                                    "--critical-energy",
                                    w->energy,
                                    "--severity-power",
                                    w->severity,
                                    "--shear-stress",
                                    w->shear,
                                    "--modulus-ratio",
                                    w->ratio,
                                    "--running-in-friction",
                                    "--replicates",
                                    slope != NULL ? few : replicates,
                                    "-o",
                                    grown,
                                    "--no-provenance",
                                    s->severity > 0 ? "--regime-map" : slope,
                                    s->severity > 0 ? NULL : w->slope,
                                    "--ratio-frequency",
                                    w->reference,
                                    "--ratio-lowest",
                                    w->low,
                                    "--ratio-highest",
                                    w->high,
                                    NULL};
    return trial_run(t, in_turn) && trial_run(t, friction);
}

static bool join(const char *to, const char *from)
{
    char line[4096];
    FILE *in = fopen(from, "r"), *out = fopen(to, "a");
    const bool open = in != NULL && out != NULL;
    while (open && fgets(line, sizeof line, in) != NULL)
        fputs(line, out);
    if (in != NULL)
        fclose(in);
    return out != NULL && fclose(out) == 0 && open;
}

static void observe(int scene, const void *prepared, random_source *random, trial *t)
{
    const layer_context *s = &layer_scenes[scene];
    const char *material = trial_file(t, "material.tsv"), *made = trial_file(t, "made.tsv"),
               *grown = trial_file(t, "grown.tsv");
    const rubber lines = rubber_make(RUBBER_LINES);
    const rubber_state state = {.rubber = &lines, .a = {1, 1}, .factor = 1};
    contact truth = nominal;
    words w;
    (void)prepared;
    truth.pressure = random_about(nominal.pressure, s->of_load, random);
    truth.c0 = random_about(nominal.c0, 0.1, random);
    truth.shear_stress = random_about(nominal.shear_stress, 0.1, random);
    truth.wear_rate = random_about(s->wear_rate, 0.1, random);
    truth.critical_energy = random_about(s->critical_energy, 0.1, random);
    const double ratio = random_about(s->ratio, 0.1, random);
    const layer_truth layer = solve(s, &truth, &state, ratio);
    say_inputs(s, &truth, ratio, random, &w);
    if (!(layer.thickness > 0))
        trial_broke(t, "there is no layer");
    else if (!rubber_write(&lines, material))
        trial_broke(t, "the material cannot be written");
    else if (run_command(s, &w, material, made, grown, t) && join(made, grown))
        read_found(s, &layer, made, t);
}

family layer_family(void)
{
    return (family){
        .n = n_layer_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
