/* Rubbers of known moduli and shifts. T in degC, lg = log10. Nothing here knows how weartrack fits.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_MATERIAL_H
#define STUDY_MATERIAL_H

#include <stdbool.h>
#include <stddef.h>

typedef enum rubber_kind {
    RUBBER_BROAD,
    RUBBER_SHARP,
    RUBBER_TERMINAL,
    RUBBER_PLATEAU,
    RUBBER_TWO,
    RUBBER_RIPPLE,           /* broad with a damped wave on its spectrum */
    RUBBER_HAVRILIAK_NEGAMI, /* two of them */
    RUBBER_FRACTIONAL_ZENER, /* springs and one fractional element */
    RUBBER_LINES,            /* one sharp process a decade, as a short Prony series */
    RUBBER_WIDE,             /* a relaxation over forty decades */
} rubber_kind;

/* lg aT = -B (1/(Tr - Tinf) - 1/(T - Tinf)); below `glass`, if that is not nan, Arrhenius with
 * `slope_below` times the slope that the law has there. */
typedef struct shift_law {
    double b, t_inf;
    double b_second; /* of the second process; 0: the same */
    double glass, slope_below;
    double t_inf_second; /* of the second process; 0: the same */
} shift_law;

double law_shift(const shift_law *law, double reference, double temperature);

#define SPECTRUM_TIMES 261 /* lg tau from -17 to 9, ten a decade */
#define SPECTRUM_MAX (2 * SPECTRUM_TIMES)
typedef struct rubber {
    double equilibrium;
    /* terms of Debye, or powers: strength (1 - (1 + (i w tau)^alpha)^-gamma) */
    size_t n;
    double strength[SPECTRUM_MAX], tau[SPECTRUM_MAX];
    double alpha[SPECTRUM_MAX], gamma[SPECTRUM_MAX]; /* both 1 for Debye */
    int process[SPECTRUM_MAX];                       /* 0 or 1: which law moves it */
} rubber;

rubber rubber_make(rubber_kind kind);
/* A Prony series of its terms, all of Debye, as a table without errors, so that those of what it is
 * used for are all there are. */
bool rubber_write(const rubber *r, const char *path);
/* Each process at its own reduced frequency [rad/s]. */
void rubber_moduli(const rubber *r, const double omega[2], double *storage, double *loss);

/* A rubber at a temperature, relative to the reference: shifts, and a factor of the moduli. */
typedef struct rubber_state {
    const rubber *rubber;
    double a[2], factor;
} rubber_state;

void state_moduli(const rubber_state *state, double omega, double *storage, double *loss);

#endif
