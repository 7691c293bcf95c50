/* A rigid tip pressed into rubber, written by the contact radius a: elastic, adhesive, with loss,
 * on a layer. Forces pull when negative. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_AFM_PHYSICS_H
#define STUDY_AFM_PHYSICS_H

#include <stddef.h>

/* Paraboloid below the radius b, regular pyramid (or cone: sides 0) beyond it; a sphere; the flat
 * end of a cylinder, for which the depth stands in the place of a contact radius. */
typedef enum afm_end { END_FACES, END_SPHERE, END_FLAT } afm_end;
typedef struct afm_tip {
    double radius, angle, b; /* b infinite: a paraboloid only; b 0: sharp */
    unsigned sides;
    afm_end end;
    const struct thin_sample *thin; /* what it is pressed into; NULL: a thick one */
} afm_tip;
afm_tip afm_pyramid(double radius, double angle_degrees, unsigned sides);

/* Depth and force of a tip on a thin sample on a rigid base, bonded or sliding (Poisson's ratio
 * 0.5), over those on a thick one, at contact radii up to 1.3 thicknesses. The tip is that on a
 * thick one. To be freed; NULL without memory. */
typedef struct thin_sample thin_sample;
thin_sample *thin_make(const afm_tip *tip, double thickness, int unbonded);
/* The same of a layer that sticks to rubber of E/ratio, at contact radii up to `radius`: depth and
 * force over those on a thick layer. */
thin_sample *layer_make(const afm_tip *tip, double thickness, double ratio, double radius);
double thin_depth(const thin_sample *s, double a);
double thin_force(const thin_sample *s, double a);

double tip_depth(const afm_tip *t, double a); /* without adhesion */
double tip_force(const afm_tip *t, double a); /* over E/(1 - nu^2) */
double tip_contact_radius(const afm_tip *t, double depth);

/* Johnson, Kendall and Roberts for any tip: depth and force at the contact radius a. */
typedef struct jkr {
    const afm_tip *tip;
    double reduced, work; /* E/(1 - nu^2) [Pa], w [J/m^2] */
} jkr;
double jkr_depth(const jkr *j, double a);
double jkr_force(const jkr *j, double a);
/* The contact radius at which a lever of k [N/m] lets go: the least base position. */
double jkr_release(const jkr *j, double k);
/* The largest contact radius at a base position; 0 if there is none. */
double jkr_radius(const jkr *j, double k, double base);

/* E(t) = rest + sum e exp(-t/tau). */
enum { RELAXATIONS = 64 };
typedef struct relaxation {
    size_t n;
    double rest, e[RELAXATIONS], tau[RELAXATIONS];
} relaxation;
/* Cole and Cole, 1000 to 1, with this tan delta at 1 rad/s, on the side of the rubber or beyond the
 * peak. */
relaxation relaxation_cole_cole(double alpha, double tan_delta, int beyond);
/* A power of time over six decades about 1 s, and a rest that sets tan delta at 1 rad/s. */
relaxation relaxation_power(double power, double tan_delta);
/* One time of 1 s and a rest, with this tan delta at 1 rad/s. */
relaxation relaxation_maxwell(double tan_delta);
double relaxation_modulus(const relaxation *r, double omega, double *tan_delta);

/* Forces of a tip that goes in and out (Lee and Radok, Ting), base positions at equal steps of time
 * with one maximum, contact at base 0; k infinite: the base is the depth. depth: [n] or NULL. */
int lossy_forces(const afm_tip *tip, const relaxation *r, double poisson, double k,
                 const double *base, size_t n, double step, double *force, double *depth);

/* E over that of the layer, of a layer with ratio E1/E2 at a_hom over its thickness; for ratios of
 * 0.3 to 3. */
double layer_apparent(double ratio, double radius_over_thickness);

#endif
