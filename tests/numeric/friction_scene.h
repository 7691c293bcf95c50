/* One friction case as numbers. It is read from friction.txt and similar files and becomes a
 * material and a roughness of the library. */
#ifndef WT_TESTS_FRICTION_SCENE_H
#define WT_TESTS_FRICTION_SCENE_H

#include "numeric/cases.h"
#include "weartrack/dma.h"
#include "weartrack/surface.h"

#include <math.h>

typedef enum law_kind { PRONY, TABLE, ZENER } law_kind;

typedef struct scene {
    law_kind law;
    bool slope;      /* extrapolates the end slopes of a table */
    bool transverse; /* uses the factors below */
    wt_transverse factors;
    size_t n;         /* terms or knots */
    double e0, alpha; /* Zener: e[0], e[1], tau[0] */
    const double *e, *tau, *loss;
    double nu, pressure, velocity, gamma;
    double q0, qr, q1, hurst, c0;
    size_t n_density; /* 0: self-affine spectrum */
    const double *wavenumber, *density;
    double thickness, ratio; /* thickness and modulus ratio of a layer; 0: none */
    size_t n_strain;         /* strains of a softening; 0: none */
    const double *strain, *f, *g;
    double strain_factor;
} scene;

/* Creates the material of the library. */
static inline wt_status scene_material(const scene *s, wt_material **material, wt_error *err)
{
    wt_prony prony = {.deformation = WT_TENSION,
                      .reference_temperature = (double)NAN,
                      .equilibrium_modulus = s->e0,
                      .n = s->n,
                      .relaxation_time = (double *)s->tau,
                      .modulus = (double *)s->e,
                      .frequency_min = (double)NAN,
                      .frequency_max = (double)NAN};
    wt_material *law = NULL;
    wt_status status = WT_OK;
    *material = NULL;
    if (s->law == PRONY)
        status = wt_material_prony(&prony, s->nu, &law, err);
    else if (s->law == TABLE)
        status =
            wt_material_table(s->tau, s->e, s->loss, s->n, s->nu,
                              s->slope ? WT_EXTRAPOLATE_SLOPE : WT_EXTRAPOLATE_HOLD, &law, err);
    else
        status =
            wt_material_fractional_zener(s->e[0], s->e[1], s->tau[0], s->alpha, s->nu, &law, err);
    if (status != WT_OK || !s->transverse) {
        *material = law;
        return status;
    }
    return wt_material_transverse(law, NULL, NULL, &s->factors, s->nu, material, err);
}

static inline wt_status scene_roughness(const scene *s, wt_roughness **roughness, wt_error *err)
{
    if (s->n_density > 0)
        return wt_roughness_table(s->wavenumber, s->density, s->n_density, roughness, err);
    return wt_roughness_self_affine(s->q0, s->qr, s->q1, s->hurst, s->c0, roughness, err);
}

/* Returns no table without points. */
static inline wt_softening scene_softening(const scene *s)
{
    return (wt_softening){.n = s->n_strain,
                          .strain = (double *)s->strain,
                          .storage = (double *)s->f,
                          .loss = (double *)s->g};
}

/* ---- from a case ----------------------------------------------------------------------------- */

enum { SCENE_MOST = 2000 };

/* A scene with storage for its numbers. */
typedef struct case_scene {
    scene s;
    double e[SCENE_MOST], tau[SCENE_MOST], loss[SCENE_MOST];
    double wavenumber[CASE_VALUES], density[CASE_VALUES];
    double strain[CASE_VALUES], f[CASE_VALUES], g[CASE_VALUES];
} case_scene;

static inline size_t case_numbers(const numeric_case *c, const char *key, double *value)
{
    const case_line *line = case_find(c, false, key);
    if (line == NULL)
        return 0;
    memcpy(value, line->value, line->n * sizeof *value);
    return line->n;
}

/* given spread N TAU TAU E E: terms at equal logarithmic distances, from the first to the last.
 * given noisy N OMEGA OMEGA E E TAN NOISE: knots at equal distances, E'' = TAN E', both multiplied
 * by exp(NOISE u) with u uniform in -1..1. */
static inline void case_made(const numeric_case *c, case_scene *made)
{
    const case_line *spread = case_find(c, false, "spread"), *noisy = case_find(c, false, "noisy");
    const case_line *line = spread != NULL ? spread : noisy;
    if (line == NULL)
        return;
    const double *v = line->value;
    uint64_t state = 1;
    made->s.n = (size_t)v[0];
    for (size_t k = 0; k < made->s.n; k++) {
        const double part = (double)k / (double)(made->s.n - 1);
        double noise[2] = {0};
        for (size_t i = 0; noisy != NULL && i < 2; i++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            noise[i] = v[6] * ((double)(state >> 11) * 0x1p-52 - 1);
        }
        made->tau[k] = v[1] * pow(v[2] / v[1], part);
        made->e[k] = v[3] * pow(v[4] / v[3], part) * exp(noise[0]);
        made->loss[k] = noisy != NULL ? v[5] * v[3] * pow(v[4] / v[3], part) * exp(noise[1]) : 0;
    }
}

static inline void case_directions(const numeric_case *c, scene *s)
{
    const case_line *axial = case_find(c, false, "axial"), *plane = case_find(c, false, "plane"),
                    *shear = case_find(c, false, "shear");
    s->transverse = axial != NULL && plane != NULL && shear != NULL;
    if (!s->transverse)
        return;
    wt_transverse *t = &s->factors;
    *t = (wt_transverse){0};
    t->axial_storage = axial->value[0];
    t->axial_loss = axial->value[1];
    t->plane_storage = plane->value[0];
    t->plane_loss = plane->value[1];
    t->shear_storage = shear->value[0];
    t->shear_loss = shear->value[1];
    t->plane_poisson = case_number(c, false, "plane_poisson", (double)NAN);
    t->axial_poisson = case_number(c, false, "axial_poisson", (double)NAN);
}

static inline void case_to_scene(const numeric_case *c, case_scene *made)
{
    const char *kind = case_word(c, false, "material");
    *made = (case_scene){0};
    scene *s = &made->s;
    s->e = made->e;
    s->tau = made->tau;
    s->loss = made->loss;
    s->wavenumber = made->wavenumber;
    s->density = made->density;
    s->nu = case_number(c, false, "poisson_ratio", (double)NAN);
    if (strcmp(kind, "prony") == 0) {
        s->law = PRONY;
        s->e0 = case_number(c, false, "equilibrium_modulus", 0);
        s->n = case_numbers(c, "modulus", made->e);
        (void)case_numbers(c, "relaxation_time", made->tau);
    } else if (strcmp(kind, "table") == 0) {
        s->law = TABLE;
        s->slope = strcmp(case_word(c, false, "extrapolation"), "hold") != 0;
        s->n = case_numbers(c, "angular_frequency", made->tau);
        (void)case_numbers(c, "storage_modulus", made->e);
        (void)case_numbers(c, "loss_modulus", made->loss);
    } else {
        s->law = ZENER;
        s->n = 1;
        made->e[0] = case_number(c, false, "e0", (double)NAN);
        made->e[1] = case_number(c, false, "eg", (double)NAN);
        made->tau[0] = case_number(c, false, "tau", (double)NAN);
        s->alpha = case_number(c, false, "alpha", (double)NAN);
    }
    case_made(c, made);
    case_directions(c, s);
    s->pressure = case_number(c, false, "pressure", 0);
    s->velocity = case_number(c, false, "velocity", 0);
    s->gamma = case_number(c, false, "gamma", 1);
    s->thickness = case_number(c, false, "layer_thickness", 0);
    s->ratio = case_number(c, false, "modulus_ratio", 1);
    s->n_density = case_numbers(c, "wavenumber", made->wavenumber);
    (void)case_numbers(c, "density", made->density);
    s->q0 = s->n_density ? s->wavenumber[0] : case_number(c, false, "q0", (double)NAN);
    s->q1 =
        s->n_density ? s->wavenumber[s->n_density - 1] : case_number(c, false, "q1", (double)NAN);
    s->qr = case_number(c, false, "qr", (double)NAN);
    s->hurst = case_number(c, false, "hurst", (double)NAN);
    s->c0 = case_number(c, false, "c0", (double)NAN);
    s->n_strain = case_numbers(c, "strain", made->strain);
    (void)case_numbers(c, "f", made->f);
    (void)case_numbers(c, "g", made->g);
    s->strain = made->strain;
    s->f = made->f;
    s->g = made->g;
    s->strain_factor = case_number(c, false, "strain_factor", 1);
}

static inline wt_status friction_case_material(const numeric_case *c, wt_material **material,
                                               wt_error *err)
{
    case_scene made;
    case_to_scene(c, &made);
    return scene_material(&made.s, material, err);
}

static inline wt_status friction_case_roughness(const numeric_case *c, wt_roughness **roughness,
                                                wt_error *err)
{
    case_scene made;
    case_to_scene(c, &made);
    return scene_roughness(&made.s, roughness, err);
}

#endif
