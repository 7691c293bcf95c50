/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "collection_sample.h"
#include "dma_sample.h"
#include "synthetic_surface.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const double study_velocity[STUDY_VELOCITIES] = {1e-3, 1e-2, 0.1, 1};
const double study_q0 = 5701.96, study_q1 = 1e6;
const char *const study_compound[COMPOUNDS] = {"HC", "HS"};
const char *const study_severity[SEVERITIES] = {"mild", "severe"};

static const double pi = 3.14159265358979323846;

/* Inputs of the cases, with relative errors by which the truth differs. */
static const double pressure[SEVERITIES] = {0.2e6, 0.6e6}, wear_rate[SEVERITIES] = {5e-13, 1e-12},
                    critical_energy[COMPOUNDS] = {3e11, 5e11}, shear_stress = 3e6;
static const double of_pressure = 0.03, of_wear = 0.1, of_energy = 0.1, of_shear = 0.05,
                    of_lever = 0.05, of_track_area = 0.1;
static const double indented_at = 20, slid_at = 30; /* [degC]; the first is the reference, too */

/* ---- force curves ---------------------------------------------------------------------------- */

static const double cantilever = 0.3, depth = 70e-9, poisson = 0.5, curve_noise = 0.005;
static const double loading[STUDY_RATES] = {0.7, 0.07, 0.007}; /* [s]: 0.1, 1 and 10 um/s */
/* Ratio of the moduli of the second and the first compound. */
static const double stiffer[COMPOUNDS] = {1, 1.5};
enum { FREE = 600, FINE = 4 };

/* Times up to a thousand times the slowest loading; two terms are merged into one. Slower terms
 * are elastic, faster ones have relaxed. A glassy term of 1 us still contributes to the force of
 * the fastest loading: without the terms down to 0.1 us the force lacks 0.24 % and the modulus
 * 0.1 %. */
static relaxation slow_part(const rubber *r)
{
    const double fastest = 1e-8, slowest = 1e3;
    relaxation to = {.rest = r->equilibrium};
    for (size_t i = 0; i < r->n; i++) {
        if (r->tau[i] > slowest)
            to.rest += r->strength[i];
        if (r->tau[i] < fastest || r->tau[i] > slowest)
            continue;
        if (i % 2 == 0 && to.n < RELAXATIONS) {
            to.tau[to.n] = r->tau[i] * pow(10, 0.05);
            to.e[to.n++] = r->strength[i];
        } else if (to.n > 0) {
            to.e[to.n - 1] += r->strength[i];
        }
    }
    return to;
}

/* Depth and force of a triangular motion, contact 0.3 of a sample after one; `base` and `force` are
 * those of the sample. */
static afm_sample *make_curve(const relaxation *r, double seconds)
{
    const afm_tip tip = afm_pyramid(20e-9, 35, 4);
    enum { FINER = (AFM_SAMPLES - FREE) * FINE };
    afm_sample *to = calloc(1, sizeof *to);
    double *base = calloc(2 * (size_t)FINER, sizeof *base), *force = base + FINER;
    if (to == NULL || base == NULL)
        abort();
    const double top = AFM_BRANCH - FREE - 0.3, step = seconds / top;
    for (int i = 0; i < AFM_SAMPLES; i++) {
        to->base[i] = depth / top *
                      (i < AFM_BRANCH ? i + 1 - FREE - 0.3 : 2 * AFM_BRANCH - 1 - i - FREE - 0.3);
        to->time[i] = step * i;
    }
    for (int i = 0; i < FINER; i++) {
        const int at = FREE - 1 + i / FINE;
        const double part = (double)(i % FINE + 1) / FINE;
        base[i] = fmax(0, to->base[at] + part * (to->base[at + 1] - to->base[at]));
    }
    if (lossy_forces(&tip, r, poisson, (double)INFINITY, base, FINER, step / FINE, force, NULL) !=
        0)
        abort();
    for (int i = FREE; i < AFM_SAMPLES; i++) {
        to->force[i] = force[(i - FREE) * FINE + FINE - 1];
        to->largest = fmax(to->largest, to->force[i]);
    }
    free(base);
    return to;
}

study_prepared *study_prepare(void)
{
    study_prepared *p = calloc(1, sizeof *p + COMPOUNDS * STUDY_RATES * sizeof(afm_sample));
    if (p == NULL)
        abort();
    afm_sample *curves = (afm_sample *)(p + 1);
    for (int c = 0; c < COMPOUNDS; c++) {
        study_compound_truth *to = &p->compound[c];
        to->rubber = rubber_make(RUBBER_BROAD);
        to->rubber.equilibrium *= stiffer[c];
        for (size_t i = 0; i < to->rubber.n; i++)
            to->rubber.strength[i] *= stiffer[c];
        const relaxation r = slow_part(&to->rubber);
        for (int k = 0; k < STUDY_RATES; k++) {
            double found;
            afm_sample *made = make_curve(&r, loading[k]);
            to->curve[k] = curves++;
            *to->curve[k] = *made;
            free(made);
            to->modulus[k] = relaxation_modulus(&r, 1 / loading[k], &found);
        }
    }
    return p;
}

/* The force bends the cantilever; the file has the stated spring constant. */
static void write_curve(const afm_sample *from, double factor, double true_lever,
                        random_source *random, int number, FILE *file)
{
    const afm_scene scene = {.noise = curve_noise};
    afm_sample here = *from;
    here.spring_constant = cantilever;
    here.largest = from->largest * factor * cantilever / true_lever;
    for (int i = 0; i < AFM_SAMPLES; i++) {
        const double force = from->force[i] * factor;
        here.base[i] = from->base[i] + force / true_lever;
        here.force[i] = force * cantilever / true_lever;
    }
    afm_sample_write(&here, &scene, random, number, file);
}

/* A file for each position, with a curve at each rate. */
static int write_spot(const study_compound_truth *c, double factor, double true_lever,
                      random_source *random, const char *path)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        return -1;
    for (int k = 0; k < STUDY_RATES; k++)
        write_curve(c->curve[k], factor, true_lever, random, k, file);
    const int bad = ferror(file);
    return fclose(file) != 0 || bad ? -1 : 0;
}

/* ---- isotherms and scans --------------------------------------------------------------------- */

const dma_scene study_isotherms = {.law = {900, -90, 0, (double)NAN, 1, 0},
                                   .reference = 20,
                                   .first = -20,
                                   .last = 80,
                                   .step = 10,
                                   .lg_first = -1,
                                   .lg_last = 2,
                                   .frequencies = 13,
                                   .noise_storage = 0.01,
                                   .noise_loss = 0.01};
/* The power law of the surface and the maps: two positions, each at two magnifications. */
static const double roll_off = 1e4, hurst = 0.8, c0 = 1e-18, map_step[2] = {22e-6, 0.55e-6};
enum { SURFACE = 256, MODES = 126, POINTS = 112, ASIDE = 20 };

/* A part of a synthetic surface, away from its edges, as Gwyddion Simple Field. */
static int write_map(double step, random_source *random, const char *path)
{
    const synthetic_surface surface = {.n = SURFACE,
                                       .length = SURFACE * step,
                                       .seed = (uint64_t)(random_uniform(random) * 0x1p52),
                                       .modes = MODES,
                                       .c0 = c0,
                                       .roll_off = roll_off,
                                       .hurst = hurst,
                                       .exponential = true};
    FILE *out = fopen(path, "wb");
    if (out == NULL)
        return -1;
    double *z = surface_create(&surface);
    const int head = fprintf(out,
                             "Gwyddion Simple Field 1.0\nXRes = %d\nYRes = %d\nXReal = %.9g\n"
                             "YReal = %.9g\nXYUnits = m\nZUnits = m\n",
                             POINTS, POINTS, step * POINTS, step * POINTS);
    for (int i = head; i == head || i % 4 != 0; i++)
        (void)fputc(0, out);
    for (size_t j = ASIDE; j < ASIDE + POINTS; j++)
        for (size_t i = ASIDE; i < ASIDE + POINTS; i++) {
            const float value = (float)z[j * SURFACE + i];
            (void)fwrite(&value, sizeof value, 1, out);
        }
    free(z);
    const int bad = ferror(out);
    return fclose(out) != 0 || bad ? -1 : 0;
}

int study_write_common(const study_prepared *p, random_source *random, const study_files *files)
{
    int bad = 0;
    sample *measured = calloc(1, sizeof *measured);
    if (measured == NULL)
        abort();
    for (int c = 0; c < COMPOUNDS && !bad; c++) {
        sample_draw(&study_isotherms, &p->compound[c].rubber, random, measured);
        bad = sample_write(&study_isotherms, measured, files->sweep[c]);
    }
    free(measured);
    for (int i = 0; i < 4 && !bad; i++)
        bad = write_map(map_step[i / 2], random, files->scans[i]);
    return bad;
}

/* ---- contact --------------------------------------------------------------------------------- */

enum { REFERENCE = 2 }; /* velocity that forms the layer */

static bool is_by_transport(int compound)
{
    return compound == 1;
}

static void draw_growth(const contact *layered, const rubber_state *state, int compound,
                        growth_truth *to)
{
    contact of = *layered;
    of.velocities = 1;
    of.velocity[0] = study_velocity[REFERENCE];
    of.layer_ratio = of.layer_thickness = 0;
    if (!growth_solve(&of, state, layered->layer_ratio, is_by_transport(compound), to))
        abort();
}

study_truth study_draw(const collection_scene *s, const study_prepared *p, random_source *random)
{
    enum { INTERVALS = 60 };
    study_truth t = {.shear_stress = random_about(shear_stress, of_shear, random),
                     .cantilever = random_about(cantilever, of_lever, random)};
    double pressed[SEVERITIES];
    for (int k = 0; k < SEVERITIES; k++) {
        t.wear_rate[k] = random_about(wear_rate[k], of_wear, random);
        pressed[k] = random_about(pressure[k], of_pressure, random);
    }
    for (int c = 0; c < COMPOUNDS; c++) {
        const rubber_state state = dma_state(&study_isotherms, &p->compound[c].rubber, slid_at);
        t.critical_energy[c] = random_about(critical_energy[c], of_energy, random);
        for (int k = 0; k < SEVERITIES; k++) {
            contact of = {.q0 = study_q0,
                          .qr = roll_off,
                          .q1 = study_q1,
                          .hurst = hurst,
                          .c0 = c0,
                          .pressure = pressed[k],
                          .shear_stress = t.shear_stress,
                          .poisson = poisson,
                          .velocities = STUDY_VELOCITIES,
                          .layer_compute_energy = REFERENCE,
                          .wear_rate = t.wear_rate[k],
                          .critical_energy = t.critical_energy[c]};
            memcpy(of.velocity, study_velocity, sizeof of.velocity);
            t.contact[c][k] = contact_solve(&of, &state, INTERVALS);
            of.layer_ratio = s->cases[c][k].ratio;
            of.layer_thickness = t.contact[c][k].thickness;
            const contact_truth layered = contact_solve(&of, &state, INTERVALS);
            memcpy(t.with_layer[c][k], layered.friction, sizeof t.with_layer[c][k]);
            if (s->running_in && s->cases[c][k].ratio < 1)
                draw_growth(&of, &state, c, &t.growth[c][k]);
        }
    }
    return t;
}

/* ---- record and case ------------------------------------------------------------------------- */

/* at each velocity; a running-in is longer and has a row per lap */
enum { LAPS = 60, SAMPLES = 4 };
static const double track_radius = 0.0125, load = 5, settled_times = 4;

int study_step(const collection_scene *s, int step)
{
    static const int layer_first[STUDY_VELOCITIES] = {REFERENCE, 0, 1, 3};
    return s->running_in ? layer_first[step] : step;
}

static double lap_time(int velocity)
{
    return 2 * pi * track_radius / study_velocity[velocity];
}

static bool has_running_in(const growth_truth *growth, int step)
{
    return step == 0 && growth->settled > 0;
}

/* Number of laps of a step. */
static int lap_count(const growth_truth *growth, int step)
{
    const double laps = settled_times * growth->settled / lap_time(REFERENCE);
    return has_running_in(growth, step) && laps > LAPS ? (int)ceil(laps) : LAPS;
}

static int all_laps(const growth_truth *growth)
{
    int laps = 0;
    for (int step = 0; step < STUDY_VELOCITIES; step++)
        laps += lap_count(growth, step);
    return laps;
}

/* Mean from `time` on. */
static double mean_in_running_in(const growth_truth *growth, double time, double length)
{
    enum { WITHIN = 16 };
    double sum = 0;
    for (int i = 0; i < WITHIN; i++)
        sum += growth_friction(growth, time + length * (i + 0.5) / WITHIN);
    return sum / WITHIN;
}

static int write_record(const collection_scene *s, const double *friction,
                        const growth_truth *growth, random_source *random, const char *path)
{
    double time = 0;
    int lap = 0;
    FILE *out = fopen(path, "w");
    if (out == NULL)
        return -1;
    fprintf(out, "time (s),laps,velocity (mm/s),mu\n");
    for (int step = 0; step < STUDY_VELOCITIES; step++) {
        const int v = study_step(s, step), samples = has_running_in(growth, step) ? 1 : SAMPLES;
        for (int i = 0; i < lap_count(growth, step); i++, lap++) {
            const double of_lap = 1 + s->lap_noise * random_normal(random),
                         here = has_running_in(growth, step)
                                    ? mean_in_running_in(growth, time, lap_time(v))
                                    : friction[v];
            for (int k = 0; k < samples; k++, time += lap_time(v) / samples)
                fprintf(out, "%.9g,%.9g,%.9g,%.9g\n", time, lap + (double)k / samples,
                        1e3 * study_velocity[v], here * of_lap);
        }
    }
    const int bad = ferror(out);
    return fclose(out) != 0 || bad ? -1 : 0;
}

static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

/* Curves of a zone, and their element in the case; `of` names the case. */
static int write_zone(const study_case *s, const study_compound_truth *compound, const char *of,
                      const char *zone, double true_lever, random_source *random, scene_draw *t,
                      FILE *out)
{
    const double ratio = strcmp(zone, "bulk") == 0 ? 1 : s->ratio;
    int bad = 0;
    fprintf(out, "<%s spring-constant=\"%gN/m +- %g%%\">\n", zone, cantilever, 100 * of_lever);
    for (int i = 0; i < s->spots && !bad; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s-%s%d.tsv", of, zone, i + 1);
        const char *path = scene_draw_file(t, name);
        bad = write_spot(compound, ratio * exp(s->spot_scatter * random_normal(random)), true_lever,
                         random, path);
        fprintf(out, "<files spot=\"%s%d\">%s</files>\n", zone, i + 1, base_name(path));
    }
    fprintf(out, "</%s>\n", zone);
    return bad;
}

static void write_sections(const collection_scene *s, const study_truth *truth,
                           const study_files *files, int c, int k, random_source *random,
                           const char *record, FILE *out)
{
    const double laps = all_laps(&truth->growth[c][k]) - 1.0 / SAMPLES,
                 area = random_about(truth->wear_rate[k] * load * laps, of_track_area, random);
    fprintf(out,
            "<dma><poisson-ratio>%g</poisson-ratio><reference-temperature>%gdegC"
            "</reference-temperature><files>%s</files></dma>\n<roughness><end>%grad/m</end>\n",
            poisson, study_isotherms.reference, base_name(files->sweep[c]), study_q1);
    for (int i = 0; i < 4; i++)
        fprintf(out, "<files>%s</files>\n", base_name(files->scans[i]));
    fprintf(out,
            "</roughness>\n<sliding><pressure>%gPa +- %g%%</pressure><temperature>%gdegC"
            "</temperature><velocity>1e-3:1m/s:log:%d</velocity><reference-velocity>0.1m/s"
            "</reference-velocity><shear-stress>%gPa +- %g%%</shear-stress></sliding>\n",
            pressure[k], 100 * of_pressure, slid_at, STUDY_VELOCITIES, shear_stress,
            100 * of_shear);
    fprintf(out,
            "<layer><specific-wear-rate>%gm^2/N +- %g%%</specific-wear-rate><critical-energy>"
            "%gJ/m^3 +- %g%%</critical-energy>",
            wear_rate[k], 100 * of_wear, critical_energy[c], 100 * of_energy);
    if (s->running_in)
        fprintf(out, "<incubation>%s</incubation>", is_by_transport(c) ? "yes" : "no");
    fprintf(out, "</layer>\n");
    fprintf(out,
            "<record><load>%gN</load><track-radius>%gm</track-radius><track-area>%.9gm^2 +- %g%%"
            "</track-area><files>%s</files></record>\n"
            "<compare><track-to-bulk/><by-rate/></compare>\n</case>\n",
            load, track_radius, area, 100 * of_track_area, base_name(record));
}

int study_write_case(const collection_scene *s, const study_prepared *p, const study_truth *truth,
                     const study_files *files, int c, int k, random_source *random, scene_draw *t,
                     const char *path)
{
    char of[16], name[24];
    const study_case *here = &s->cases[c][k];
    snprintf(of, sizeof of, "%s-%s", study_compound[c], study_severity[k]);
    snprintf(name, sizeof name, "%s.csv", of);
    const char *record = scene_draw_file(t, name);
    FILE *out = fopen(path, "w");
    if (out == NULL ||
        write_record(s, truth->with_layer[c][k], &truth->growth[c][k], random, record) != 0)
        return -1;
    fprintf(
        out,
        "<case version=\"1\"><title>%s, %s</title><sample>%s</sample><condition>%s</condition>\n"
        "<indentation><tip>pyramid:half-angle=35deg,radius=20nm</tip><temperature>%gdegC"
        "</temperature>\n",
        study_compound[c], study_severity[k], study_compound[c], study_severity[k], indented_at);
    int bad =
        write_zone(here, &p->compound[c], of, "bulk", truth->cantilever, random, t, out) != 0 ||
        write_zone(here, &p->compound[c], of, "track", truth->cantilever, random, t, out) != 0;
    fprintf(out, "</indentation>\n");
    write_sections(s, truth, files, c, k, random, record, out);
    bad = ferror(out) != 0 || bad;
    return fclose(out) != 0 || bad ? -1 : 0;
}
