/* What every scene has: what can be stated of it, what is right, what is promised.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_FACTS_H
#define STUDY_FACTS_H

#include <stdbool.h>

#define GIVEN_MAX 5

/* Whatever an interval can be stated of. */
typedef enum quantity {
    Q_SHIFT,       /* lg aT of an isotherm, as it was measured */
    Q_LAW,         /* lg aT of the law between the isotherms */
    Q_LAW_OUTSIDE, /* and 10 K beyond them */
    Q_C1,
    Q_C2,
    Q_STORAGE, /* of the material at the reference temperature, along the master curve */
    Q_LOSS,
    Q_EQUILIBRIUM,
    Q_PRONY_STORAGE, /* of the series */
    Q_PRONY_LOSS,
    Q_HYSTERESIS,
    Q_AREA,
    Q_FRICTION,
    Q_THICKNESS,
    Q_HYSTERESIS_KEPT, /* from the stored master curve instead of the isotherms */
    Q_AREA_KEPT,
    Q_MODULUS,       /* of one force curve */
    Q_FACTOR,        /* on the spectrum of the DMA, of one */
    Q_DEPTH,         /* modulus at a depth, of all curves */
    Q_GROUP_MODULUS, /* of all curves, with what they share */
    Q_RATIO,         /* modulus of the track over that of the bulk */
    Q_LAYERED_FRICTION,
    Q_DWELL_STORAGE, /* of one held curve, at a frequency */
    Q_DWELL_LOSS,
    Q_DENSITY, /* C(q) of a surface, at a wavenumber */
    Q_HURST,
    Q_ROLL_OFF,
    Q_C0,
    Q_BEYOND,     /* C(q) by the law, at the end that was asked for */
    Q_RMS_HEIGHT, /* of the spectrum, from its first row to its last */
    Q_RMS_SLOPE,
    Q_ANISOTROPY, /* amplitude of order 2 */
    Q_TEXTURE,    /* its direction */
    Q_STEADY,     /* friction coefficient behind a running-in */
    Q_RUNNING_IN, /* cycles before it */
    Q_DRIFT,
    Q_WEAR_RATE,
    Q_CRITICAL_ENERGY, /* of a layer */
    Q_FRICTION_RATIO,  /* measured over predicted */
    Q_NEEDED_SHEAR,    /* stress that a record asks for */
    Q_CHANGE,          /* of the friction by a layer */
    Q_RATIO_PAIR,      /* modulus ratio of a case over that of another */
    Q_SHARED_WEAR,     /* wear rate of all cases of a severity */
    Q_SHARED_SHEAR,    /* shear stress of all cases */
    Q_SHARED_RATE,     /* modulus over a decade of rate, of all cases of a compound, or of all */
    /* "Yes" and "no" as intervals that hold the truth if they are right; "inconclusive" states none
     */
    Q_SAID_DIFFERS,
    Q_SAID_PAIR,
    Q_SAID_RECORD,
    Q_SAID_SHARED,
    Q_SAID_RUNNING_IN,
    Q_SAID_WEAR,    /* the time of a running-in agrees with the wear, or contradicts it */
    Q_SETTLED,      /* time after which friction stands */
    Q_TIME_RATIO,   /* measured over predicted */
    Q_CHANGE_RATIO, /* of friction in the running-in, likewise */
    Q_NEEDED_WEAR,  /* rate that a running-in asks for */
    Q_NEEDED_ENERGY,
    Q_ALLOWED, /* ln of the thickness of a layer that curves allow, in nm */
    Q_BOTH,    /* and of that which they and another source allow */
    Q_COUNT
} quantity;

typedef struct quantity_facts {
    const char *name;
    bool relative; /* errors are compared as parts of the truth */
} quantity_facts;
extern const quantity_facts quantities[Q_COUNT];

/* Yes: superposition holds; the track is another rubber than the bulk; the
 * contact law describes the curves. */
typedef enum verdict { INCONCLUSIVE, YES, NO, NO_VERDICT, VERDICT_COUNT } verdict;
#define RIGHT(v) (1u << (v))

/* What statistics-scenes gives: coverage in percent, median half width; nan where it gives none. */
typedef struct given {
    quantity quantity;
    double coverage, half_width;
} given;

typedef struct facts {
    const char *name, *about;
    unsigned right; /* which verdicts are */
    /* The author of the method switches these on: the short run then fails when chance cannot
     * explain what it finds. */
    bool intervals_promised, verdict_promised;
    bool sometimes_silent; /* some draws state nothing, and rightly; less than half of them */
    given given[GIVEN_MAX];
} facts;
/* How the row of a scene begins. */
#define NAMED(scene, words) .facts.name = (scene), .facts.about = (words)

#endif
