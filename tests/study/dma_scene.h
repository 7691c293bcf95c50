/* A rubber and the measurement of its isotherms.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_DMA_SCENE_H
#define STUDY_DMA_SCENE_H

#include "contact.h"
#include "facts.h"
#include "material.h"

#define ISOTHERMS_MAX 220
#define POINTS_MAX 64

typedef struct dma_scene {
    facts facts;

    rubber_kind rubber;
    shift_law law;
    double reference; /* [degC] */

    double first, last, step; /* temperatures */
    double lg_first, lg_last; /* log10 of the frequencies in Hz */
    int frequencies;

    double noise_storage, noise_loss; /* relative */
    double temperature_error;         /* [K], of each isotherm */
    double geometry_error;            /* relative, of each isotherm */
    double departure;                 /* [decade], of b, times sin((T - 20)/25) */
    double correlation;               /* AR(1) of neighbouring points of one isotherm */
    double loud;                      /* noise factor of the third and the eighth isotherm */
    double outliers, outlier_size;    /* share of the points, and size in ln E */
    double missing;                   /* share of the points */
    double bathtub;                   /* noise ratio of the ends and the middle of an isotherm */
    bool ramp;                        /* the temperature rises steadily, also during a cycle */
    bool relaxation;                  /* E(t) after a step at 1/(2 pi f), not E' and E'' */
    bool ragged;                      /* each isotherm has different frequencies */
    bool exchanged;                   /* E' in the column of E'' */
    double crystallises;              /* crystallization below 10 degC; 1 is strong */
    double phase_lag;                 /* [rad] at the highest frequency, in proportion to it */
    double inertia;                   /* [Pa s^2], taken off E' times the square of omega */
    double compliance;                /* [1/Pa], of the frame, in series with the sample */
    double oven;                      /* [K], true minus stated, of all isotherms; it is stated */
    double bad_loss, bad_stiffness;   /* relative, E'' or both moduli of the fifth isotherm */
    double bad_temperature;           /* [K], true minus stated, of the fifth isotherm */
    bool twice;                       /* the fifth isotherm is measured before, without that */

    const char *vertical; /* value of --vertical-shift; NULL: the default */
    const char *by;       /* value of --shift-by; NULL: both moduli */
    const contact *contact;
    bool other_layout; /* layout of the file */
    bool shear;        /* G = E/3 is measured, and the results are of G */
} dma_scene;

extern const dma_scene dma_scenes[];
extern const int n_dma_scenes;

/* Measured modulus as a share of E. */
double dma_part_of_e(const dma_scene *s);
/* lg b of the material at a temperature, without the geometry error. */
double dma_vertical(const dma_scene *s, double temperature);
/* Law of the second process. */
shift_law dma_second_law(const dma_scene *s);
/* Material at a temperature, with its shift relative to the reference of the scene. */
rubber_state dma_state(const dma_scene *s, const rubber *r, double temperature);

#endif
