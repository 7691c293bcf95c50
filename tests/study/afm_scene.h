/* Force curves on rubbers of known modulus. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_AFM_SCENE_H
#define STUDY_AFM_SCENE_H

#include "facts.h"

typedef enum afm_noise {
    NOISE_WHITE,
    NOISE_CORRELATED, /* 70 % of the variance first-order with 0.95, the rest white */
    NOISE_FLICKER,    /* 70 % 1/f, the rest white */
} afm_noise;

/* The first of 20 nm and 35 degrees, the round and flat ones of 100 nm. */
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

/* A four-sided pyramid of 35 degrees and 20 nm, pressed 70 nm into rubber of 5 MPa by a lever of
 * 0.5 N/m, unless a member says otherwise. */
typedef struct afm_scene {
    facts facts;
    double noise; /* of the largest force */
    afm_noise kind;
    double work, work_out; /* of adhesion on the way in and out [J/m^2] */
    bool dmt;              /* a pull of 2 pi w R without long contact, else JKR */
    double pull, reach;    /* the same pull in both ways [N], which falls off with the distance as
                              exp(-gap/reach) [m]; 0: none, and at contact */
    afm_loss loss;
    double tan_delta;                    /* at 1/t_c */
    double dma;                          /* the spectrum is given, as if it were 1/dma of it */
    double spring_constant, modulus;     /* 0: 0.5 N/m, 5 MPa */
    double layer_ratio, layer_thickness; /* E1/E2; [m] */
    double radius_factor, angle_factor;  /* the tip's over the stated ones; 0: 1 */
    afm_kind tip;
    double thickness;            /* of the sample on its base [m]; 0: thick */
    bool unbonded;               /* it slides on the base */
    double depth_from, force_to; /* range of the fit: from a depth [m], to a share of the force */
    double depth;                /* [m], 0: 70 nm */
    double bow;                  /* of the deflection over the way in [m] */
    double drift;                /* of the force by the end, as the square root of time */
    double saturation;           /* force at which the detector has lost 10 %, of the largest */
    double spikes;               /* share of samples 20 to 40 noises off */
    double interference, period; /* amplitude in noises; of the path [m] */
    bool with_height;  /* the path is that of the piezo in contact, too, else that of the tip */
    double soft_top;   /* share of the largest force that the detector loses there, little before */
    double pull_share; /* constant while in contact, of the largest force */
    double attraction, attraction_reach; /* exp(-gap/reach) before contact, all of it in contact; of
                                 the largest force; [m] */
    double drag;                         /* of the largest force, with the velocity of the tip */
    double piezo_bow;                    /* of the height over the way in [m] */
    double roughness;                    /* rms of the heights at which the tip touches [m] */
    bool untold;                         /* the thickness is not given */
    double radius_stated, angle_stated;  /* relative standard errors that are told */
    double before;                       /* share of the way in before contact; 0: two thirds */
    const struct thin_sample
        *layered; /* a layer by the integral equation, made before; NULL: none */
    double spots; /* relative scatter of the moduli of six spots, a file each; 0: one spot */
} afm_scene;

extern const afm_scene afm_scenes[];
extern const int n_afm_scenes;

#endif
