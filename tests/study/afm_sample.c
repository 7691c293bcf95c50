/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "afm_sample.h"
#include "afm_physics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double poisson = 0.5;
enum { FINE = 4 };

static int free_of(const afm_scene *s)
{
    return (int)((s->before > 0 ? s->before : 2.0 / 3) * AFM_BRANCH);
}

static double modulus_of(const afm_scene *s)
{
    return s->modulus > 0 ? s->modulus : 5e6;
}

afm_tip afm_true_tip(const afm_scene *s)
{
    const double factor = s->radius_factor > 0 ? s->radius_factor : 1;
    const double angle = 35 * (s->angle_factor > 0 ? s->angle_factor : 1);
    afm_tip tip = {.radius = 100e-9 * factor, .angle = 1, .b = (double)INFINITY};
    switch (s->tip) {
    case TIP_PARABOLOID:
        return tip;
    case TIP_SPHERE:
        tip.end = END_SPHERE;
        return tip;
    case TIP_PUNCH:
        tip.end = END_FLAT;
        return tip;
    case TIP_SHARP:
        return afm_pyramid(0, angle, 4);
    case TIP_CONE:
        return afm_pyramid(0, angle, 0);
    case TIP_BLUNT_CONE:
        return afm_pyramid(20e-9 * factor, angle, 0);
    case TIP_THREE_SIDES:
        return afm_pyramid(20e-9 * factor, angle, 3);
    case TIP_PYRAMID:
        break;
    }
    return afm_pyramid(20e-9 * factor, angle, 4);
}

static double true_depth(const afm_scene *s)
{
    return s->depth > 0 ? s->depth : s->tip >= TIP_PARABOLOID ? 50e-9 : 70e-9;
}

static double layer_reduced(const afm_scene *s, double a)
{
    const double reduced = modulus_of(s) / (1 - poisson * poisson);
    return s->layer_thickness > 0 ? reduced * layer_apparent(s->layer_ratio, a / s->layer_thickness)
                                  : reduced;
}

/* Cantilever deflection before contact, due to an attraction A exp(gap / reach), up to the snap-in;
 * 1 in contact. */
static double attracted(double a, double reach, double k, double base)
{
    double force = 0;
    for (int i = 0; i < 200; i++) {
        const double tip = base + force / k;
        if (tip >= 0)
            return a;
        force = a * exp(tip / reach);
    }
    return force;
}

/* Deflection of a tip without snap-in. */
static double smooth_force(const afm_scene *s, const afm_tip *tip, double k, double base, int out)
{
    const double w = out ? s->work_out : s->work;
    if (w > 0 && !s->dmt) {
        const jkr law = {tip, layer_reduced(s, 0), w};
        const double a = out || base > 0 ? jkr_radius(&law, k, base) : 0;
        return a > 0 ? jkr_force(&law, a) : 0;
    }
    const double depth = true_depth(s), most = tip_contact_radius(tip, depth);
    const double top = layer_reduced(s, most) * tip_force(tip, most);
    const double pull = (s->pull > 0 ? s->pull : 2 * M_PI * w * tip->radius) +
                        (s->pull_share + s->attraction) * top;
    double low = 0, high = 1e-9;
    if (s->attraction > 0 && attracted(pull, s->attraction_reach, k, base) < pull)
        return -attracted(pull, s->attraction_reach, k, base);
    if (base + pull / k <= 0 ||
        /* without the deflection of the cantilever there */
        (!out && base <= 0 && !(s->attraction > 0)))
        return s->reach > 0 ? -pull * exp((out ? base + pull / k : base) / s->reach) : 0;
#define BASE(a) (tip_depth(tip, a) + (layer_reduced(s, a) * tip_force(tip, a) - pull) / k)
    while (BASE(high) < base)
        high *= 2;
    for (int i = 0; i < 100; i++) {
        const double middle = 0.5 * (low + high);
        *(BASE(middle) > base ? &high : &low) = middle;
    }
#undef BASE
    return layer_reduced(s, low) * tip_force(tip, low) - pull;
}

/* Elastic force at a base position; contact lasts longer during retraction. Roughness: mean force
 * over normally distributed heights at one tip position. */
static double elastic_force(const afm_scene *s, const afm_tip *tip, double k, double base, int out)
{
    if (!(s->roughness > 0))
        return smooth_force(s, tip, k, base, out);
    double low = -10 * s->roughness, high = fmax(base, 0) + s->roughness, force = 0;
    for (int i = 0; i < 60; i++) {
        const double at = 0.5 * (low + high);
        force = 0;
        double weights = 0;
        for (int j = -20; j <= 20; j++) {
            const double x = 0.2 * j, weight = exp(-0.5 * x * x), depth = at - x * s->roughness;
            const double a = depth > 0 ? tip_contact_radius(tip, depth) : 0;
            force += weight * (a > 0 ? layer_reduced(s, a) * tip_force(tip, a) : 0);
            weights += weight;
        }
        force /= weights;
        *(at + force / k > base ? &high : &low) = at;
    }
    return force;
}

static void add_elastic(const afm_scene *s, const afm_tip *tip, afm_sample *to)
{
    for (int i = 0; i < AFM_SAMPLES; i++)
        to->force[i] = elastic_force(s, tip, to->spring_constant, to->base[i], i >= AFM_BRANCH);
}

relaxation afm_relaxation(const afm_scene *s)
{
    relaxation r = s->loss == LOSS_MAXWELL ? relaxation_maxwell(s->tan_delta)
                   : s->loss == LOSS_POWER
                       ? relaxation_power(0.25, s->tan_delta)
                       : relaxation_cole_cole(0.6, s->tan_delta, s->loss == LOSS_BEYOND);
    double found;
    const double scale = modulus_of(s) / relaxation_modulus(&r, 1, &found);
    r.rest *= scale;
    for (size_t i = 0; i < r.n; i++)
        r.e[i] *= scale;
    return r;
}

/* Uses steps finer than the samples, from the first sample in contact. */
static int add_lossy(const afm_scene *s, const afm_tip *tip, afm_sample *to)
{
    const int first = free_of(s), n = (AFM_SAMPLES - first) * FINE;
    double *base = calloc((size_t)n, sizeof *base), *force = calloc((size_t)n, sizeof *force);
    const relaxation r = afm_relaxation(s);
    int bad = base == NULL || force == NULL;
    for (int i = 0; !bad && i < n; i++) {
        const int at = first - 1 + i / FINE;
        const double part = (double)(i % FINE + 1) / FINE;
        base[i] = fmax(0, to->base[at] + part * (to->base[at + 1] - to->base[at]));
    }
    bad = bad || lossy_forces(tip, &r, poisson, to->spring_constant, base, (size_t)n,
                              (to->time[1] - to->time[0]) / FINE, force, NULL) != 0;
    afm_scene clean = *s; /* Adhesion adds the same force as without loss. */
    clean.work = clean.work_out = 0;
    for (int i = first; !bad && i < AFM_SAMPLES; i++) {
        const int out = i >= AFM_BRANCH;
        to->force[i] = force[(i - first) * FINE + FINE - 1];
        if (s->work > 0)
            to->force[i] += elastic_force(s, tip, to->spring_constant, to->base[i], out) -
                            elastic_force(&clean, tip, to->spring_constant, to->base[i], out);
    }
    free(base);
    free(force);
    return bad ? -1 : 0;
}

/* Effects of piezo, cantilever and detector on the force, and the truth at the largest depth. */
static void disturb(const afm_scene *s, afm_sample *to)
{
    double elastic[AFM_SAMPLES];
    memcpy(elastic, to->force, sizeof elastic);
    for (int i = 1; i < AFM_SAMPLES; i++) { /* velocity of the piezo, and of the tip */
        const double moved = to->base[i] - to->base[i - 1],
                     by_tip = moved - (elastic[i] - elastic[i - 1]) / to->spring_constant;
        const double step = fabs(to->base[2] - to->base[1]);
        to->force[i] += s->drag * to->largest * fmax(-1, fmin(1, by_tip / step));
    }
    to->force[0] += s->drag * to->largest;
    for (int i = 0; i < AFM_SAMPLES; i++) {
        const double part = (double)i / AFM_BRANCH;
        to->force[i] += 4 * s->bow * to->spring_constant * part * (1 - part) +
                        s->drift * to->largest * sqrt(part);
        if (s->saturation > 0)
            to->force[i] -= 0.1 * s->saturation * to->largest * pow(to->force[i] / to->largest, 3);
        if (s->soft_top > 0 && to->force[i] > 0) /* x / (1 + a x^8)^(1/8) */
            to->force[i] *= pow(
                1 + (pow(1 - s->soft_top, -8) - 1) * pow(to->force[i] / to->largest, 8), -1.0 / 8);
    }
}

afm_sample *afm_sample_make(const afm_scene *s)
{
    afm_sample *to = calloc(1, sizeof *to);
    afm_tip tip = afm_true_tip(s);
    if (to == NULL)
        return NULL;
    thin_sample *thin = s->thickness > 0 ? thin_make(&tip, s->thickness, s->unbonded) : NULL;
    tip.thin = s->layered != NULL ? s->layered : thin;
    to->spring_constant = s->spring_constant > 0 ? s->spring_constant : 0.5;
    const double depth = true_depth(s);
    const double a = tip_contact_radius(&tip, depth),
                 top = layer_reduced(s, a) * tip_force(&tip, a);
    const double most = depth + top / to->spring_constant;
    const int free_samples = free_of(s);
    const double step = most / (AFM_BRANCH - free_samples);
    to->largest = top;
    to->modulus = layer_reduced(s, a) * (1 - poisson * poisson);
    for (int i = 0; i < AFM_SAMPLES;
         i++) { /* contact 0.3 of a step after a sample; 1 s to the maximum */
        to->base[i] = (i < AFM_BRANCH ? i + 1 - free_samples - 0.3
                                      : 2 * AFM_BRANCH - 1 - i - free_samples - 0.3) *
                      step;
        to->time[i] = (double)i / (AFM_BRANCH - free_samples - 0.3);
    }
    if (s->loss == LOSS_NONE) {
        add_elastic(s, &tip, to);
    } else if (add_lossy(s, &tip, to) != 0) {
        free(to);
        free(thin);
        return NULL;
    }
    free(thin);
    disturb(s, to);
    if (s->loss != LOSS_NONE && s->force_to > 0) { /* |E*| is that at 1/(loading time) */
        double found;
        int last = free_samples;
        const relaxation r = afm_relaxation(s);
        while (last < AFM_BRANCH && to->force[last] < s->force_to * to->force[AFM_BRANCH - 1])
            last++;
        to->modulus = relaxation_modulus(
            &r, 1 / ((last - free_samples + 0.7) * (to->time[1] - to->time[0])), &found);
    }
    return to;
}

void afm_sample_as_stated(afm_sample *sample, double cantilever, double sensitivity)
{
    for (int i = 0; i < AFM_SAMPLES; i++)
        sample->force[i] /= cantilever * sensitivity;
    sample->largest /= cantilever * sensitivity;
    sample->spring_constant /= cantilever;
}

double afm_apparent(const afm_scene *s, const afm_sample *sample, double share)
{
    const double depth = share * true_depth(s);
    afm_scene stated = *s;
    stated.radius_factor = stated.angle_factor = 1;
    const afm_tip tip = afm_true_tip(s), as_stated = afm_true_tip(&stated);
    const double a = tip_contact_radius(&tip, depth),
                 of_stated = tip_contact_radius(&as_stated, depth);
    if (s->loss != LOSS_NONE || (s->thickness > 0 && !s->untold))
        return sample->modulus;
    return layer_reduced(s, a) * (1 - poisson * poisson) * tip_force(&tip, a) /
           tip_force(&as_stated, of_stated);
}

/* ---- noise ----------------------------------------------------------------------------------- */

enum { OCTAVES = 12 };
typedef struct noise_state {
    double slow, octave[OCTAVES];
} noise_state;

static double next_noise(afm_noise kind, int i, noise_state *state, random_source *random)
{
    const double white = random_normal(random);
    double sum = 0;
    if (kind == NOISE_WHITE)
        return white;
    if (kind == NOISE_CORRELATED) {
        state->slow = i == 0 ? random_normal(random)
                             : 0.95 * state->slow + sqrt(1 - 0.95 * 0.95) * random_normal(random);
        return sqrt(0.7) * state->slow + sqrt(0.3) * white;
    }
    for (int k = 0; k < OCTAVES; k++) { /* one process for each octave gives 1/f noise */
        const double rho = exp(-ldexp(1, -k));
        state->octave[k] =
            i == 0 ? random_normal(random)
                   : rho * state->octave[k] + sqrt(1 - rho * rho) * random_normal(random);
        sum += state->octave[k] / sqrt(OCTAVES);
    }
    return sqrt(0.7) * sum + sqrt(0.3) * white;
}

void afm_sample_write(const afm_sample *sample, const afm_scene *s, random_source *random,
                      int curve, FILE *file)
{
    const double sd = s->noise * sample->largest;
    const double phase = s->interference > 0 ? 2 * M_PI * random_uniform(random) : 0;
    noise_state state = {0};
    fprintf(file,
            "## table: force_curve/%d\n"
            "## spring_constant: %.9g standard_error=0 numerical_error=0 unit=N/m\n"
            "## curve: %d\n# segment[text]\theight[m]\tforce[N]\ttime[s]\n",
            curve, sample->spring_constant, curve);
    for (int i = 0; i < AFM_SAMPLES; i++) {
        double force = sample->force[i] + sd * next_noise(s->kind, i, &state, random);
        if (s->interference > 0) {
            const double way = s->with_height || sample->base[i] < 0
                                   ? sample->base[i]
                                   : sample->base[i] - sample->force[i] / sample->spring_constant;
            force += s->interference * sd * sin(2 * M_PI * way / s->period + phase);
        }
        if (s->spikes > 0 && random_uniform(random) < s->spikes)
            force += sd * (20 + 20 * random_uniform(random));
        const double part = (i < AFM_BRANCH ? i : 2 * AFM_BRANCH - 1 - i) / (double)AFM_BRANCH,
                     bow = 4 * s->piezo_bow * part * (1 - part);
        if (i == AFM_BRANCH)
            fputs("\n", file);
        fprintf(file, "%s\t%.9g\t%.9g\t%.6g\n", i < AFM_BRANCH ? "approach" : "retract",
                5e-6 - sample->base[i] - bow, force, sample->time[i]);
    }
    fputs("##\n", file);
}
