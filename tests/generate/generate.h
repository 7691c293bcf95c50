/* True values of the bundled case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TESTS_GENERATE_GENERATE_H
#define TESTS_GENERATE_GENERATE_H

#include "weartrack/dma.h"
#include "weartrack/indentation.h"

/* Rubber: a Prony series in shear at 20 degC, WLF, moduli proportional to the temperature. */
#define TRUTH_REFERENCE 293.15
#define TRUTH_C1 6.5
#define TRUTH_C2 110.0
#define TRUTH_TERMS 23

/* Indentation at 23 degC; the wear track is softer by the same factor at all rates. */
#define TRUTH_TEMPERATURE 296.15
#define TRUTH_RATIO 0.64

/* The road: C0 [m^4] up to a roll-off [rad/m], and a power law above it. */
#define TRUTH_ROAD_C0 2e-17
#define TRUTH_ROLL_OFF 4e3
#define TRUTH_HURST 0.8

wt_rubber truth_rubber(double relaxation_time[TRUTH_TERMS], double modulus[TRUTH_TERMS]);
/* Vertical shift b(T): the measured moduli times b are those at the reference temperature. */
double truth_vertical(double temperature);

/* Normal deviates that are equal on every machine (except for the mathematical library). */
double truth_normal(uint64_t *state);

/* A tip on a cantilever is pressed into a rubber with `factor` times the modulus. The base moves
 * from contact at a constant rate by `travel` and back. */
typedef struct truth_press {
    const wt_tip *tip;
    double spring_constant, travel, rate, factor, temperature;
} truth_press;
enum { TRUTH_STEPS = 400 }; /* steps of each direction */
/* Returns the travel for an approximate depth, by |E*| at 1/(loading time). */
double truth_travel(const wt_material *material, const truth_press *p, double depth);
/* Interpolates the force at a time in steps. */
double truth_force_after(const double force[2 * TRUTH_STEPS + 1], double steps);
/* Computes the forces [N] at the ends of the steps. */
void truth_indent(const truth_press *p, const wt_rubber *rubber, double force[2 * TRUTH_STEPS + 1]);

/* Each function writes its files into a folder and returns 0, or -1 with a message on stderr.
 * Variant 0 is the bundled case; other variants have the same truth and other measurement
 * errors. */
int generate_dma(const wt_rubber *rubber, const char *folder, uint64_t variant);
int generate_curves(const wt_rubber *rubber, const char *folder, uint64_t variant, double ratio);
int generate_road(const char *folder, uint64_t variant);

#endif
