/* Rubbers with known moduli and shifts. T in degC, lg = log10. Independent of the fits of
 * weartrack.
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
    RUBBER_RIPPLE,           /* broad with a damped oscillation of the spectrum */
    RUBBER_HAVRILIAK_NEGAMI, /* two processes */
    RUBBER_FRACTIONAL_ZENER, /* springs and one fractional element */
    RUBBER_LINES,            /* one sharp process per decade, as a short Prony series */
    RUBBER_WIDE,             /* relaxation over forty decades */
} rubber_kind;

/* lg aT = -B (1/(Tr - Tinf) - 1/(T - Tinf)); below `glass` (unless nan) Arrhenius with
 * `slope_below` times the slope of the law there. */
typedef struct shift_law {
    double b, t_inf;
    double b_second; /* value of the second process; 0: the same */
    double glass, slope_below;
    double t_inf_second; /* value of the second process; 0: the same */
} shift_law;

double law_shift(const shift_law *law, double reference, double temperature);

#define SPECTRUM_TIMES 261 /* lg tau from -17 to 9, ten per decade */
#define SPECTRUM_MAX (2 * SPECTRUM_TIMES)
typedef struct rubber {
    double equilibrium;
    /* Debye terms, or power laws: strength (1 - (1 + (i w tau)^alpha)^-gamma) */
    size_t n;
    double strength[SPECTRUM_MAX], tau[SPECTRUM_MAX];
    double alpha[SPECTRUM_MAX], gamma[SPECTRUM_MAX]; /* both 1 for Debye */
    int process[SPECTRUM_MAX];                       /* 0 or 1: its shift law */
} rubber;

rubber rubber_make(rubber_kind kind);
/* Prony series of Debye terms as a table without errors, so that only the errors of the tested
 * quantity count. */
bool rubber_write(const rubber *r, const char *path);
/* Each process has its reduced frequency [rad/s]. */
void rubber_moduli(const rubber *r, const double omega[2], double *storage, double *loss);

/* A rubber at a temperature relative to the reference: shifts, and a factor of the moduli. */
typedef struct rubber_state {
    const rubber *rubber;
    double a[2], factor;
} rubber_state;

/* Relaxation modulus [Pa] at the time [s], of Debye terms. */
double state_relaxation(const rubber_state *state, double time);
void state_moduli(const rubber_state *state, double omega, double *storage, double *loss);

#endif
