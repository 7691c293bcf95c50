/* Common properties of scenes: quantities with intervals, right verdicts and promises.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_FACTS_H
#define STUDY_FACTS_H

#include <stdbool.h>

#define GIVEN_MAX 5

/* Quantities with an interval. */
typedef enum quantity {
    Q_SHIFT,       /* lg aT of a measured isotherm */
    Q_LAW,         /* lg aT of the law between the isotherms */
    Q_LAW_OUTSIDE, /* the same 10 K beyond them */
    Q_C1,
    Q_C2,
    Q_STORAGE, /* modulus at the reference temperature, along the master curve */
    Q_LOSS,
    Q_EQUILIBRIUM,
    Q_PRONY_STORAGE, /* modulus of the series */
    Q_PRONY_LOSS,
    Q_HYSTERESIS,
    Q_AREA,
    Q_FRICTION,
    Q_THICKNESS,
    Q_HYSTERESIS_KEPT, /* from the stored master curve in place of the isotherms */
    Q_AREA_KEPT,
    Q_MODULUS,       /* modulus of one force curve */
    Q_FACTOR,        /* factor of one curve on the spectrum of the DMA */
    Q_DEPTH,         /* modulus at a depth, from all curves */
    Q_GROUP_MODULUS, /* modulus of all curves, with shared errors */
    Q_RATIO,         /* modulus ratio of track and bulk */
    Q_LAYERED_FRICTION,
    Q_DENSITY, /* C(q) of a surface at a wavenumber */
    Q_HURST,
    Q_ROLL_OFF,
    Q_C0,
    Q_BEYOND,     /* C(q) by the law at the requested limit */
    Q_RMS_HEIGHT, /* from the spectrum, over all its rows */
    Q_RMS_SLOPE,
    Q_ANISOTROPY, /* amplitude of order 2 */
    Q_TEXTURE,    /* direction of the anisotropy */
    Q_STEADY,     /* friction coefficient after a running-in */
    Q_RUNNING_IN, /* cycles before the steady state */
    Q_DRIFT,
    Q_WEAR_RATE,
    Q_CRITICAL_ENERGY, /* critical energy of a layer */
    Q_FRICTION_RATIO,  /* measured over predicted */
    Q_NEEDED_SHEAR,    /* shear stress that a record requires */
    Q_CHANGE,          /* change of friction by a layer */
    Q_RATIO_PAIR,      /* ratio of the modulus ratios of two cases */
    /* "Yes" and "no" count as intervals that contain the truth if they are right; "inconclusive"
     * states none. */
    Q_SAID_DIFFERS,
    Q_SAID_PAIR,
    Q_SAID_RECORD,
    Q_SETTLED,       /* time after which friction is steady, as predicted */
    Q_MEASURED_TIME, /* the same as measured */
    Q_TIME_RATIO,    /* measured over predicted */
    Q_ALLOWED,       /* ln of the layer thickness [nm] that the curves allow */
    Q_BOTH,          /* the same for the curves and another source together */
    Q_COUNT
} quantity;

typedef struct quantity_facts {
    const char *name;
    bool relative; /* errors are relative to the truth */
} quantity_facts;
extern const quantity_facts quantities[Q_COUNT];

/* YES: superposition holds, the track is another rubber than the bulk, or the contact law describes
 * the curves. */
typedef enum verdict { INCONCLUSIVE, YES, NO, NO_VERDICT, VERDICT_COUNT } verdict;
#define RIGHT(v) (1u << (v))

/* Expected values of statistics-scenes: coverage in percent, median half width; nan where there are
 * none. */
typedef struct given {
    quantity quantity;
    double coverage, half_width;
} given;

typedef struct facts {
    const char *name, *about;
    unsigned right; /* set of right verdicts */
    /* Set by the author of the method. The short run then fails if chance cannot explain its
     * outcome. */
    bool intervals_promised, verdict_promised;
    bool sometimes_silent; /* some draws correctly state no interval; less than half of them */
    given given[GIVEN_MAX];
} facts;
/* First members of a scene. */
#define NAMED(scene, words) .facts.name = (scene), .facts.about = (words)

#endif
