/* A scene: a rubber, how it is measured, and what is right to say about it.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_SCENE_H
#define STUDY_SCENE_H

#include "contact.h"
#include "material.h"

#include <stdbool.h>

#define ISOTHERMS_MAX 40
#define POINTS_MAX 64
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
    Q_COUNT
} quantity;

typedef struct quantity_facts {
    const char *name;
    bool relative; /* errors are compared as parts of the truth */
} quantity_facts;
extern const quantity_facts quantities[Q_COUNT];

typedef enum verdict { CANNOT_SAY, HOLDS, FAILS, NO_VERDICT, VERDICT_COUNT } verdict;
#define RIGHT(v) (1u << (v))

/* What statistics-scenes gives: coverage in percent, median half width; nan where it gives none. */
typedef struct given {
    quantity quantity;
    double coverage, half_width;
} given;

typedef struct scene {
    const char *name, *about;

    rubber_kind rubber;
    shift_law law;
    double reference; /* degC */

    double first, last, step; /* of the temperatures */
    double lg_first, lg_last; /* of the frequencies in Hz */
    int frequencies;

    double noise_storage, noise_loss; /* relative */
    double temperature_error;         /* K, of each isotherm */
    double geometry_error;            /* relative, of each isotherm */
    double departure;                 /* decade: of b, times sin((T - 20)/25) */
    double correlation;               /* AR(1) of neighbouring points of one isotherm */
    double loud;                      /* noise of the third and the eighth isotherm */
    double outliers, outlier_size;    /* share of the points, and of ln E */
    double missing;                   /* share of the points */
    double bathtub;                   /* noise at the ends of an isotherm over that in the middle */
    bool ragged;                      /* each isotherm has its own frequencies */
    bool exchanged;                   /* E' in the column of E'' */
    bool crystallises;                /* below 10 degC */

    const char *vertical; /* of --vertical-shift; NULL: the default */
    unsigned right;       /* which verdicts are */
    const contact *contact;
    bool other_layout; /* of the file */

    /* The fit's author switches these on: the short run then fails when chance cannot explain what
     * it finds. */
    bool intervals_promised, verdict_promised;
    given given[GIVEN_MAX];
} scene;

extern const scene scenes[];
extern const int n_scenes;

/* lg b that the material has at a temperature, the error of the geometry left out. */
double scene_vertical(const scene *s, double temperature);
/* The material at a temperature, its shift relative to the reference of the scene. */
rubber_state scene_state(const scene *s, const rubber *r, double temperature);

#endif
