/* A layer in time by own integrals: contacts at one velocity, with and without a layer, damage that
 * is carried to the surface, and what friction makes of it. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef STUDY_LAYER_PHYSICS_H
#define STUDY_LAYER_PHYSICS_H

#include "contact.h"

#define WAVES 1201 /* of equal ratio */
/* What the wavenumbers of a contact need at one velocity. */
typedef struct slide {
    const contact *contact;
    double velocity, step;                                       /* of ln q */
    double q[WAVES], density[WAVES], loss[WAVES], square[WAVES]; /* q^3 C, and both angles */
} slide;
void slide_make(const contact *c, const rubber_state *state, double velocity, slide *to);
/* Modulus that a wave sees over that of the bulk, of a bonded incompressible layer (Burmister);
 * x: wavenumber times thickness. */
double layer_seen(double x, double ratio);
/* Under a bonded layer of a thickness, `ratio` times as stiff. */
void slide_friction(const slide *s, double pressure, double thickness, double ratio,
                    double *hysteresis, double *area);

/* A ratio of moduli that goes as omega^slope from `low` to `high` [rad/s] and is `ratio` at the
 * reference, constant outside; its phase by an integral over what d ln ratio / d ln omega is. */
typedef struct own_ratio {
    double ratio, slope, reference, low, high;
} own_ratio;
/* Friction on a bonded layer of such moduli, each wave at its complex stiffness: total, with the
 * shear stress times |ratio| at velocity / thickness. */
double slide_on_own(const slide *s, const rubber_state *state, double pressure, double thickness,
                    const own_ratio *own);
/* The phase of the ratio at a frequency. */
double own_phase(const own_ratio *own, double omega);

/* J of the contact on bare rubber, below a depth. */
typedef struct heat {
    const slide *slide;
    double power[WAVES];  /* of the waves, per area */
    double surface, wear; /* of all of them; Qw [m/s] */
} heat;
/* wear rate k (1 + (power / severity)^1), severity 0: none. */
void heat_make(const slide *s, double pressure, double severity, heat *to);
double heat_below(const heat *h, double depth);

#define LOADS_MAX 4
typedef struct history {
    int n;
    heat *load[LOADS_MAX];
    double lasts[LOADS_MAX]; /* [s]; the last one for ever */
} history;
/* Where the damage suffices, and when it first does at the surface; NaN: not within `latest`. */
double history_thickness(const history *h, double time);
double history_first(const history *h, double latest);
/* Thickness at balance; 0: none. */
double heat_balance(const heat *h);

/* Friction with the layer that one load has made: total with tau (ratio) on it. */
typedef struct settling {
    double end, settled;
} settling;
settling settle(const heat *h, double ratio);

#endif
