/* The scenes. Those with a letter and a number are of the theory text; the widths and coverages
 * beside them are what its right method reaches. SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene.h"

#include <math.h>

#define NONE ((double)NAN)

const quantity_facts quantities[Q_COUNT] = {
    [Q_SHIFT] = {"shift", false},
    [Q_LAW] = {"law", false},
    [Q_LAW_OUTSIDE] = {"law_outside", false},
    [Q_C1] = {"C1", false},
    [Q_C2] = {"C2", false},
    [Q_STORAGE] = {"storage", true},
    [Q_LOSS] = {"loss", true},
    [Q_EQUILIBRIUM] = {"equilibrium", false},
    [Q_PRONY_STORAGE] = {"prony_storage", true},
    [Q_PRONY_LOSS] = {"prony_loss", true},
    [Q_HYSTERESIS] = {"hysteresis", true},
    [Q_AREA] = {"area", true},
    [Q_FRICTION] = {"friction", true},
    [Q_THICKNESS] = {"thickness", true},
    [Q_HYSTERESIS_KEPT] = {"hysteresis_kept", true},
    [Q_AREA_KEPT] = {"area_kept", true},
};

static const contact contact_d1 = {.q0 = 1e3,
                                   .qr = 1e4,
                                   .q1 = 1e6,
                                   .hurst = 0.8,
                                   .c0 = 1e-18,
                                   .pressure = 0.4e6,
                                   .shear_stress = 5e6,
                                   .poisson = 0.5,
                                   .temperature = 20,
                                   .velocities = 3,
                                   .velocity = {1e-3, 0.03, 1},
                                   .layer_at = 1,
                                   .wear_rate = 1e-12,
                                   .critical_energy = 2e10};

static const contact contact_d6 = {.q0 = 1e3,
                                   .qr = 5e3,
                                   .q1 = 1e6,
                                   .hurst = 0.85,
                                   .c0 = 2e-18,
                                   .pressure = 0.3e6,
                                   .shear_stress = 4e6,
                                   .poisson = 0.5,
                                   .temperature = 30,
                                   .velocities = 3,
                                   .velocity = {1e-3, 0.03, 1},
                                   .layer_at = 1,
                                   .wear_rate = 1e-12,
                                   .critical_energy = 1e10};

/* What most scenes have, so that a row says what is its own. */
#define BASE_LAW .law = {900, -90, 0, NONE, 1}, .reference = 20
#define TWO_LAW .law = {700, -80, 0, NONE, 1}, .reference = 20
#define NOISE(share) .noise_storage = (share), .noise_loss = (share)
#define FREQUENCIES10 .lg_first = -1, .lg_last = 2, .frequencies = 13
#define G10 .first = -30, .last = 60, .step = 10, FREQUENCIES10
#define G13 .first = -40, .last = 80, .step = 10, .lg_first = -1, .lg_last = 2, .frequencies = 16
#define GOOD .right = RIGHT(HOLDS)
#define BAD .right = RIGHT(FAILS)
#define OPEN .right = RIGHT(CANNOT_SAY)
#define FREE .vertical = "free"
#define D13_GRID                                                                                   \
    .first = -30, .last = 60, .step = 10, .lg_first = -1, .lg_last = 2, .frequencies = 25

/* clang-format off: one row each */
const scene scenes[] = {
    /* intervals; the vertical shift of the default, or free */
    {"D1", "broad, 1 %", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), GOOD, .contact = &contact_d1,
     .given = {{Q_SHIFT, 99, .011}, {Q_LAW, 98, NONE}, {Q_STORAGE, 98, NONE}, {Q_LOSS, 97, NONE}}},
    {"D2", "broad, 5 %", RUBBER_BROAD, BASE_LAW, G10, NOISE(.05),
     .right = RIGHT(HOLDS) | RIGHT(CANNOT_SAY), .given = {{Q_SHIFT, 98, .056}}},
    {"D3", "broad, 0.1 %, 0.05 K", RUBBER_BROAD, BASE_LAW, G10, NOISE(.001),
     .temperature_error = .05, GOOD,
     .given = {{Q_LAW, 96, .005}, {Q_STORAGE, 99, NONE}, {Q_LOSS, 98, NONE}}},
    {"D4", "sharp, 1 %, free b", RUBBER_SHARP, BASE_LAW, G10, NOISE(.01), FREE, GOOD,
     .given = {{Q_SHIFT, 96, .014}, {Q_STORAGE, 96, NONE}, {Q_LOSS, 96, NONE}}},
    {"D5", "terminal, 1 %, 0.1 K", RUBBER_TERMINAL, BASE_LAW, G10, NOISE(.01),
     .temperature_error = .1, GOOD,
     .given = {{Q_LAW, 100, .015}, {Q_STORAGE, 98, NONE}, {Q_LOSS, 98, NONE}}},
    {"D5b", "terminal, 1 %, free b", RUBBER_TERMINAL, BASE_LAW, G10, NOISE(.01), FREE, GOOD,
     .given = {{Q_SHIFT, 94, NONE}}},
    {"D6", "two, 1.5 %, 0.1 K", RUBBER_TWO, TWO_LAW, G13, NOISE(.015), .temperature_error = .1,
     GOOD, .contact = &contact_d6,
     .given = {{Q_LAW, 92, .016}, {Q_STORAGE, 97, NONE}, {Q_LOSS, 96, NONE}}},
    {"D7", "broad, one decade in steps of 4 K, free b", RUBBER_BROAD, .law = {900, -90, 0, NONE, 1},
     .reference = 0, .first = -28, .last = 32, .step = 4, .lg_first = 0, .lg_last = 1,
     .frequencies = 11, NOISE(.01), FREE, .right = RIGHT(HOLDS) | RIGHT(CANNOT_SAY),
     .given = {{Q_SHIFT, 96, .025}, {Q_STORAGE, 97, NONE}, {Q_LOSS, 97, NONE}}},
    {"D8", "broad, 1 %, 0.3 K", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), .temperature_error = .3,
     GOOD,
     .given = {{Q_LAW, 95, .025}, {Q_STORAGE, 97, NONE}, {Q_LOSS, 96, NONE}, {Q_C2, 97, 3.3}}},
    {"D9", "broad, 1 %, geometry 2 %", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .geometry_error = .02, GOOD,
     .given = {{Q_SHIFT, 95, .015}, {Q_STORAGE, 94, NONE}, {Q_LOSS, 95, NONE}}},
    {"D10", "broad, 1 %, b departs from the physical", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .departure = .05, GOOD,
     .given = {{Q_SHIFT, 96, .014}, {Q_STORAGE, 99, NONE}, {Q_LOSS, 99, NONE}}},
    {"D11", "broad, five isotherms, 1 %, 0.3 K", RUBBER_BROAD, BASE_LAW, .first = -20, .last = 60,
     .step = 20, FREQUENCIES10, NOISE(.01), .temperature_error = .3, GOOD,
     .given = {{Q_LAW, 94, .042}, {Q_STORAGE, 96, NONE}, {Q_LOSS, 94, NONE}, {Q_C2, 95, 6.3}}},
    {"D12", "broad, E' 0.5 %, E'' 3 %, free b", RUBBER_BROAD, BASE_LAW, G10, .noise_storage = .005,
     .noise_loss = .03, FREE, GOOD,
     .given = {{Q_SHIFT, 95, .024}, {Q_STORAGE, 95, NONE}, {Q_LOSS, 95, NONE}}},
    {"D13", "broad, 1 %, correlated along f", RUBBER_BROAD, BASE_LAW, D13_GRID, NOISE(.01),
     .correlation = .7, .right = RIGHT(HOLDS) | RIGHT(CANNOT_SAY), .given = {{Q_SHIFT, 96, .026}}},
    {"D14", "broad, 1 %, two isotherms 5 %", RUBBER_BROAD, BASE_LAW, D13_GRID, NOISE(.01),
     .loud = .05, GOOD, .given = {{Q_SHIFT, 96, .019}}},

    /* verdicts; free vertical shift */
    {"V1.D1", "broad, 1 %", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), FREE, GOOD},
    {"V1.D9", "broad, 1 %, geometry 2 %", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .geometry_error = .02, FREE, GOOD},
    {"V1.D10", "broad, 1 %, b departs", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), .departure = .05,
     FREE, GOOD},
    {"V1.plateau", "plateau, 2 %", RUBBER_PLATEAU, BASE_LAW, G10, NOISE(.02), FREE, GOOD},
    {"V1.two", "two, one law, 1.5 %", RUBBER_TWO, BASE_LAW, G13, NOISE(.015), FREE, GOOD},
    {"V2", "two laws, 1.5 %", RUBBER_TWO, .law = {900, -90, 300, NONE, 1}, .reference = 20, G13,
     NOISE(.015), FREE, BAD},
    {"V3", "two laws, 5 %", RUBBER_TWO, .law = {900, -90, 300, NONE, 1}, .reference = 20, G13,
     NOISE(.05), FREE, .right = RIGHT(FAILS) | RIGHT(CANNOT_SAY)},
    {"V4", "E' and E'' exchanged", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), .exchanged = true, FREE,
     BAD},
    {"V5", "crystallising below 10 degC", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .crystallises = true, FREE, BAD},
    {"V6", "steps of 30 K without overlap", RUBBER_BROAD, BASE_LAW, .first = -40, .last = 80,
     .step = 30, FREQUENCIES10, NOISE(.01), FREE, OPEN},
    {"V7", "one decade in steps of 10 K", RUBBER_BROAD, BASE_LAW, .first = -30, .last = 60,
     .step = 10, .lg_first = 0, .lg_last = 1, .frequencies = 11, NOISE(.01), FREE, OPEN},

    /* further ones, with the vertical shift of the default */
    {"exchanged", "V4 by the default", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), .exchanged = true,
     BAD},
    {"crystallises", "V5 by the default", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .crystallises = true, BAD},
    {"two_laws", "V2 by the default", RUBBER_TWO, .law = {900, -90, 300, NONE, 1}, .reference = 20,
     G13, NOISE(.015), BAD},
    {"narrow", "V7 by the default", RUBBER_BROAD, BASE_LAW, .first = -30, .last = 60, .step = 10,
     .lg_first = 0, .lg_last = 1, .frequencies = 11, NOISE(.01), OPEN},
    {"half_decade", "half a decade in steps of 3 K", RUBBER_BROAD, BASE_LAW, .first = -28,
     .last = 50, .step = 3, .lg_first = 0, .lg_last = .5, .frequencies = 8, NOISE(.01),
     .right = RIGHT(HOLDS) | RIGHT(CANNOT_SAY)},
    {"outliers", "3 % of the points 25 % off", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .outliers = .03, .outlier_size = .25, GOOD},
    {"outliers_large", "2 % of the points a factor of 3 off", RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .outliers = .02, .outlier_size = 1.1, GOOD},
    {"far", "forty decades of shift, in steps of up to three", RUBBER_WIDE,
     .law = {2500, -105, 0, NONE, 1}, .reference = 20, .first = -65, .last = 60, .step = 5,
     .lg_first = -1.5, .lg_last = 2, .frequencies = 15, NOISE(.01), GOOD},
    {"far_steps", "steps of up to twenty decades, nothing overlaps", RUBBER_WIDE,
     .law = {2500, -105, 0, NONE, 1}, .reference = 20, .first = -70, .last = 50, .step = 30,
     FREQUENCIES10, NOISE(.01), OPEN},
    {"glass", "Arrhenius below -5 degC", RUBBER_BROAD, .law = {900, -90, 0, -5, .35},
     .reference = 20, .first = -40, .last = 60, .step = 5, FREQUENCIES10, NOISE(.01), GOOD},
    {"temperature_geometry", "0.2 K and 2 %", RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .temperature_error = .2, .geometry_error = .02, GOOD},
    {"temperature_departs", "0.2 K, b departs", RUBBER_SHARP, BASE_LAW, G10, NOISE(.01),
     .temperature_error = .2, .departure = .05, GOOD},
    {"correlated_strong", "rho 0.9, 2 %", RUBBER_BROAD, BASE_LAW, D13_GRID, NOISE(.02),
     .correlation = .9, .right = RIGHT(HOLDS) | RIGHT(CANNOT_SAY)},
    {"havriliak_negami", "two of them, 1 %", RUBBER_HAVRILIAK_NEGAMI, BASE_LAW, G10, NOISE(.01),
     GOOD, .contact = &contact_d1},
    {"fractional_zener", "1 %, 0.1 K", RUBBER_FRACTIONAL_ZENER, BASE_LAW, G10, NOISE(.01),
     .temperature_error = .1, GOOD, .other_layout = true},
    {"heteroscedastic", "0.5 % in the middle of an isotherm, 3 % at its ends", RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.005), .bathtub = 6, GOOD},
    {"ragged", "another grid of frequencies for each isotherm", RUBBER_SHARP, BASE_LAW, G10,
     NOISE(.01), .ragged = true, GOOD, .other_layout = true},
    {"missing", "a quarter of the points missing", RUBBER_TWO, TWO_LAW, G13, NOISE(.015),
     .missing = .25, GOOD},
    {"ripple", "a damped wave on the spectrum", RUBBER_RIPPLE, BASE_LAW, G10, NOISE(.01), GOOD},
    {"reference_between", "a reference temperature between two isotherms", RUBBER_BROAD,
     .law = {900, -90, 0, NONE, 1}, .reference = 25, G10, NOISE(.01), .temperature_error = .1,
     GOOD},
};
/* clang-format on */
const int n_scenes = sizeof scenes / sizeof scenes[0];

double scene_vertical(const scene *s, double temperature)
{
    return log10(293.15 / (temperature + 273.15)) + s->departure * sin((temperature - 20) / 25);
}

rubber_state scene_state(const scene *s, const rubber *r, double temperature)
{
    shift_law second = s->law;
    if (second.b_second > 0)
        second.b = second.b_second;
    return (rubber_state){.rubber = r,
                          .a = {pow(10, law_shift(&s->law, s->reference, temperature)),
                                pow(10, law_shift(&second, s->reference, temperature))},
                          .factor = pow(10, -scene_vertical(s, temperature))};
}
