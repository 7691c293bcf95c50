/* Force curves on rubbers with known modulus.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_AFM_SCENE_H
#define STUDY_AFM_SCENE_H

#include "facts.h"

typedef enum afm_noise {
    NOISE_WHITE,
    NOISE_CORRELATED, /* 70 % of the variance AR(1) with 0.95, the rest white */
    NOISE_FLICKER,    /* 70 % 1/f, the rest white */
} afm_noise;

/* The first tips have 20 nm and 35 degrees, the round and flat ones 100 nm. */
typedef enum afm_kind {
    TIP_PYRAMID,
    TIP_SHARP,
    TIP_THREE_SIDES,
    TIP_CONE,
    TIP_BLUNT_CONE,
    TIP_PARABOLOID,
    TIP_SPHERE,
    TIP_PUNCH
} afm_kind;

typedef enum afm_loss { LOSS_NONE, LOSS_COLE_COLE, LOSS_BEYOND, LOSS_POWER, LOSS_MAXWELL } afm_loss;

typedef enum calibration_kind {
    CALIBRATION_UNSAID, /* true values, stated without an error */
    /* Without an error, off by 10 % (spring constant), 3 % (sensitivity), 1 degree and 10 %
     * (radius), normally distributed: what the program assumes of values without a stated error. */
    CALIBRATION_DRAWN,
    CALIBRATION_EXACT,  /* true values, stated with errors of 0.01 %; linear, thick sample */
    CALIBRATION_UNTOLD, /* as exact, but nothing is stated of piezo, detector and sample */
} calibration_kind;

/* Defaults: a four-sided pyramid of 35 degrees and 20 nm indents rubber of 5 MPa by 70 nm with a
 * spring constant of 0.5 N/m. */
typedef struct afm_scene {
    facts facts;
    double noise; /* relative to the largest force */
    afm_noise kind;
    double work, work_out; /* work of adhesion during approach and retraction [J/m^2] */
    bool dmt;              /* a force of 2 pi w R without long contact, else JKR */
    /* equal attraction [N] in both directions, which decays as exp(-gap/reach) [m]; 0: none, and
     * at contact */
    double pull, reach;
    afm_loss loss;
    double tan_delta;                    /* at 1/t_c */
    double dma;                          /* spectrum on input, with moduli 1/dma of the true ones */
    double spring_constant, modulus;     /* 0: 0.5 N/m, 5 MPa */
    double layer_ratio, layer_thickness; /* E1/E2; [m] */
    double radius_factor, angle_factor;  /* true over stated values; 0: 1 */
    afm_kind tip;
    double thickness;            /* thickness of the sample on its base [m]; 0: thick */
    bool unbonded;               /* the sample slides on the base */
    double depth_from, force_to; /* fit range: from a depth [m], to a share of the force */
    double depth;                /* [m], 0: 70 nm */
    double bow;                  /* bow of the deflection over the approach [m] */
    double drift;                /* drift of the force at the end, as the square root of time */
    /* force at which the detector has lost 10 %, relative to the largest */
    double saturation;
    double spikes;               /* share of samples with an error of 20 to 40 times the noise */
    double interference, period; /* amplitude relative to the noise; period of the path [m] */
    bool with_height;  /* the path is that of the piezo also in contact, else that of the tip */
    double soft_top;   /* relative loss of the detector at the largest force, small below it */
    double pull_share; /* constant in contact, relative to the largest force */
    /* exp(-gap/reach) before contact, full in contact; relative to the largest force; [m] */
    double attraction, attraction_reach;
    /* relative to the largest force, proportional to the tip velocity */
    double drag;
    double piezo_bow;                   /* bow of the height over the approach [m] */
    double roughness;                   /* rms of the heights at first contact [m] */
    bool untold;                        /* the thickness is not stated */
    double radius_stated, angle_stated; /* stated relative standard errors */
    double before;                      /* share of the approach before contact; 0: two thirds */
    const struct thin_sample
        *layered; /* layer by the integral equation, computed before; NULL: none */
    /* relative scatter of the moduli of six positions, a file each; 0: one position */
    double spots;
    calibration_kind calibration; /* of lever and tip, once for all curves of a draw */
} afm_scene;

extern const afm_scene afm_scenes[];
extern const int n_afm_scenes;

#endif
