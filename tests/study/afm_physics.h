/* Contact of a rigid tip with rubber as a function of the contact radius a: elastic, adhesive,
 * viscoelastic, or on a layer. Attractive forces are negative.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_AFM_PHYSICS_H
#define STUDY_AFM_PHYSICS_H

#include <stddef.h>

/* A paraboloid below the radius b with a regular pyramid (or cone: sides 0) beyond it; a sphere; or
 * a flat punch, for which the depth replaces the contact radius. */
typedef enum afm_end { END_FACES, END_SPHERE, END_FLAT } afm_end;
typedef struct afm_tip {
    double radius, angle, b; /* b infinite: a paraboloid only; b 0: sharp */
    unsigned sides;
    afm_end end;
    const struct thin_sample *thin; /* the sample; NULL: a thick one */
} afm_tip;
afm_tip afm_pyramid(double radius, double angle_degrees, unsigned sides);

/* Depth and force of a tip on a thin sample on a rigid base, bonded or sliding (Poisson's ratio
 * 0.5), relative to a thick sample, for contact radii up to 1.3 thicknesses. `tip` is the tip on a
 * thick sample. Free the result; NULL without memory. */
typedef struct thin_sample thin_sample;
thin_sample *thin_make(const afm_tip *tip, double thickness, int unbonded);
/* The same for a layer bonded to rubber of E/ratio, for contact radii up to `radius`, relative to a
 * thick layer. */
thin_sample *layer_make(const afm_tip *tip, double thickness, double ratio, double radius);
double thin_depth(const thin_sample *s, double a);
double thin_force(const thin_sample *s, double a);

double tip_depth(const afm_tip *t, double a); /* without adhesion */
double tip_force(const afm_tip *t, double a); /* force over E/(1 - nu^2) */
double tip_contact_radius(const afm_tip *t, double depth);

/* Johnson-Kendall-Roberts contact for any tip: depth and force at the contact radius a. */
typedef struct jkr {
    const afm_tip *tip;
    double reduced, work; /* E/(1 - nu^2) [Pa], w [J/m^2] */
} jkr;
double jkr_depth(const jkr *j, double a);
double jkr_force(const jkr *j, double a);
/* Contact radius at pull-off with a spring constant k [N/m]: the minimum of the base position. */
double jkr_release(const jkr *j, double k);
/* Largest contact radius at a base position; 0 without contact. */
double jkr_radius(const jkr *j, double k, double base);

/* E(t) = rest + sum e exp(-t/tau). */
enum { RELAXATIONS = 64 };
typedef struct relaxation {
    size_t n;
    double rest, e[RELAXATIONS], tau[RELAXATIONS];
} relaxation;
/* Cole-Cole law with E from 1000 to 1 and this tan delta at 1 rad/s, on the rubbery side or beyond
 * the peak. */
relaxation relaxation_cole_cole(double alpha, double tan_delta, int beyond);
/* Power law of time over six decades about 1 s, and an equilibrium modulus that sets tan delta at 1
 * rad/s. */
relaxation relaxation_power(double power, double tan_delta);
/* One relaxation time of 1 s and an equilibrium modulus, with this tan delta at 1 rad/s. */
relaxation relaxation_maxwell(double tan_delta);
double relaxation_modulus(const relaxation *r, double omega, double *tan_delta);

/* Forces of a tip during approach and retraction (Lee and Radok, Ting). Base positions are at equal
 * time steps with one maximum, contact at base 0; with k infinite the base is the depth. depth: [n]
 * or NULL. */
int lossy_forces(const afm_tip *tip, const relaxation *r, double poisson, double k,
                 const double *base, size_t n, double step, double *force, double *depth);

/* E relative to the layer, for a layer with ratio E1/E2 at a_hom over its thickness; ratios from
 * 0.3 to 3. */
double layer_apparent(double ratio, double radius_over_thickness);

#endif
