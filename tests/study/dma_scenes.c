/* Isotherms. Scenes with a letter and a number are those of the theory text; the widths and
 * coverages with them are reached by its correct method.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma_scene.h"

#include <math.h>

#define NONE ((double)NAN)

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
                                   .layer_compute_energy = 1,
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
                                   .layer_compute_energy = 1,
                                   .wear_rate = 1e-12,
                                   .critical_energy = 1e10};

/* Inputs with errors, which are stated. */
static const contact contact_inputs = {.q0 = 1e3,
                                       .qr = 1e4,
                                       .q1 = 1e6,
                                       .hurst = 0.8,
                                       .c0 = 1e-18,
                                       .pressure = 0.4e6,
                                       .shear_stress = 5e6,
                                       .poisson = 0.5,
                                       .temperature = 20,
                                       .velocities = 1,
                                       .velocity = {0.03},
                                       .wear_rate = 1e-12,
                                       .critical_energy = 2e10,
                                       .error = 0.07};

/* At another temperature than the reference, the error of the law contributes to friction. */
static const contact contact_warm = {.q0 = 2e3,
                                     .qr = 4e3,
                                     .q1 = 2e6,
                                     .hurst = 0.8,
                                     .c0 = 4e-18,
                                     .pressure = 0.2e6,
                                     .shear_stress = 3e6,
                                     .poisson = 0.49,
                                     .temperature = 45,
                                     .velocities = 2,
                                     .velocity = {0.01, 0.3},
                                     .layer_compute_energy = 0,
                                     .wear_rate = 5e-13,
                                     .critical_energy = 1e10};

/* Common members of most scenes, so that a row states the differences. */
#define BASE_LAW .law = {900, -90, 0, NONE, 1, 0}, .reference = 20
#define TWO_LAW .law = {700, -80, 0, NONE, 1, 0}, .reference = 20
#define NOISE(share) .noise_storage = (share), .noise_loss = (share)
#define FREQUENCIES10 .lg_first = -1, .lg_last = 2, .frequencies = 13
#define G10 .first = -30, .last = 60, .step = 10, FREQUENCIES10
#define G13 .first = -40, .last = 80, .step = 10, .lg_first = -1, .lg_last = 2, .frequencies = 16
#define GOOD .facts.right = RIGHT(YES)
#define BAD .facts.right = RIGHT(NO)
#define OPEN .facts.right = RIGHT(INCONCLUSIVE)
/* Promises that the full run supports (table.tsv). */
#define VERDICT_PROMISED .facts.verdict_promised = true
#define PROMISED .facts.intervals_promised = true, VERDICT_PROMISED
#define FREE .vertical = "free"
#define SECOND(...)                                                                                \
    VERDICT_PROMISED, .rubber = RUBBER_TWO, .law = {__VA_ARGS__}, .reference = 20, .first = -40,   \
                      .last = 70, .step = 10, FREQUENCIES10,                                       \
                      .facts.right = RIGHT(NO) | RIGHT(INCONCLUSIVE)
#define D13_GRID                                                                                   \
    .first = -30, .last = 60, .step = 10, .lg_first = -1, .lg_last = 2, .frequencies = 25

const dma_scene dma_scenes[] = {
    /* intervals; default or free vertical shift */
    {NAMED("D1", "broad, 1 %"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), GOOD,
     .contact = &contact_d1,
     .facts.given =
         {{Q_SHIFT, 99, .011}, {Q_LAW, 98, NONE}, {Q_STORAGE, 98, NONE}, {Q_LOSS, 97, NONE}}},
    {NAMED("D2", "broad, 5 %"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.05),
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE), .facts.given = {{Q_SHIFT, 98, .056}}},
    {NAMED("D3", "broad, 0.1 %, 0.05 K"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.001), .temperature_error = .05, GOOD,
     .facts.given = {{Q_LAW, 96, .005}, {Q_STORAGE, 99, NONE}, {Q_LOSS, 98, NONE}}},
    {NAMED("D4", "sharp, 1 %, free b"), PROMISED, .rubber = RUBBER_SHARP, BASE_LAW, G10, NOISE(.01),
     FREE, GOOD, .facts.given = {{Q_SHIFT, 96, .014}, {Q_STORAGE, 96, NONE}, {Q_LOSS, 96, NONE}}},
    {NAMED("D5", "terminal, 1 %, 0.1 K"), PROMISED, .rubber = RUBBER_TERMINAL, BASE_LAW, G10,
     NOISE(.01), .temperature_error = .1, GOOD,
     .facts.given = {{Q_LAW, 100, .015}, {Q_STORAGE, 98, NONE}, {Q_LOSS, 98, NONE}}},
    {NAMED("D5b", "terminal, 1 %, free b"), PROMISED, .rubber = RUBBER_TERMINAL, BASE_LAW, G10,
     NOISE(.01), FREE, GOOD, .facts.given = {{Q_SHIFT, 94, NONE}}},
    {NAMED("D6", "two, 1.5 %, 0.1 K"), PROMISED, .rubber = RUBBER_TWO, TWO_LAW, G13, NOISE(.015),
     .temperature_error = .1, GOOD, .contact = &contact_d6,
     .facts.given = {{Q_LAW, 92, .016}, {Q_STORAGE, 97, NONE}, {Q_LOSS, 96, NONE}}},
    {NAMED("D7", "broad, one decade in steps of 4 K, free b"), PROMISED, .rubber = RUBBER_BROAD,
     .law = {900, -90, 0, NONE, 1, 0}, .reference = 0, .first = -28, .last = 32, .step = 4,
     .lg_first = 0, .lg_last = 1, .frequencies = 11, NOISE(.01), FREE,
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE),
     .facts.given = {{Q_SHIFT, 96, .025}, {Q_STORAGE, 97, NONE}, {Q_LOSS, 97, NONE}}},
    {NAMED("D8", "broad, 1 %, 0.3 K"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .temperature_error = .3, GOOD,
     .facts
         .given = {{Q_LAW, 95, .025}, {Q_STORAGE, 97, NONE}, {Q_LOSS, 96, NONE}, {Q_C2, 97, 3.3}}},
    {NAMED("D9", "broad, 1 %, geometry 2 %"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .geometry_error = .02, GOOD,
     .facts.given = {{Q_SHIFT, 95, .015}, {Q_STORAGE, 94, NONE}, {Q_LOSS, 95, NONE}}},
    {NAMED("D10", "broad, 1 %, b departs from the physical"), PROMISED, .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .departure = .05, GOOD,
     .facts.given = {{Q_SHIFT, 96, .014}, {Q_STORAGE, 99, NONE}, {Q_LOSS, 99, NONE}}},
    {NAMED("D11", "broad, five isotherms, 1 %, 0.3 K"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW,
     .first = -20, .last = 60, .step = 20, FREQUENCIES10, NOISE(.01), .temperature_error = .3, GOOD,
     .facts
         .given = {{Q_LAW, 94, .042}, {Q_STORAGE, 96, NONE}, {Q_LOSS, 94, NONE}, {Q_C2, 95, 6.3}}},
    {NAMED("D12", "broad, E' 0.5 %, E'' 3 %, free b"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW,
     G10, .noise_storage = .005, .noise_loss = .03, FREE, GOOD,
     .facts.given = {{Q_SHIFT, 95, .024}, {Q_STORAGE, 95, NONE}, {Q_LOSS, 95, NONE}}},
    {NAMED("D13", "broad, 1 %, correlated along f"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW,
     D13_GRID, NOISE(.01), .correlation = .7, .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE),
     .facts.given = {{Q_SHIFT, 96, .026}}},
    {NAMED("D14", "broad, 1 %, two isotherms 5 %"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW,
     D13_GRID, NOISE(.01), .loud = .05, GOOD, .facts.given = {{Q_SHIFT, 96, .019}}},

    /* verdicts; free vertical shift */
    {NAMED("V1.D1", "broad, 1 %"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     FREE, GOOD},
    {NAMED("V1.D9", "broad, 1 %, geometry 2 %"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .geometry_error = .02, FREE, GOOD},
    {NAMED("V1.D10", "broad, 1 %, b departs"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .departure = .05, FREE, GOOD},
    {NAMED("V1.plateau", "plateau, 2 %"), PROMISED, .rubber = RUBBER_PLATEAU, BASE_LAW, G10,
     NOISE(.02), FREE, GOOD},
    {NAMED("V1.two", "two, one law, 1.5 %"), PROMISED, .rubber = RUBBER_TWO, BASE_LAW, G13,
     NOISE(.015), FREE, GOOD},
    {NAMED("V2", "two laws, 1.5 %"), VERDICT_PROMISED, .rubber = RUBBER_TWO,
     .law = {900, -90, 300, NONE, 1, 0}, .reference = 20, G13, NOISE(.015), FREE, BAD},
    {NAMED("V3", "two laws, 5 %"), VERDICT_PROMISED, .rubber = RUBBER_TWO,
     .law = {900, -90, 300, NONE, 1, 0}, .reference = 20, G13, NOISE(.05), FREE,
     .facts.right = RIGHT(NO) | RIGHT(INCONCLUSIVE)},
    {NAMED("V4", "E' and E'' exchanged"), VERDICT_PROMISED, .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .exchanged = true, FREE, BAD},
    {NAMED("V5", "crystallising below 10 degC"), VERDICT_PROMISED, .rubber = RUBBER_BROAD, BASE_LAW,
     G10, NOISE(.01), .crystallises = 1, FREE, BAD},
    {NAMED("V6", "steps of 30 K without overlap"), VERDICT_PROMISED, .rubber = RUBBER_BROAD,
     BASE_LAW, .first = -40, .last = 80, .step = 30, FREQUENCIES10, NOISE(.01), FREE, OPEN},
    {NAMED("V7", "one decade in steps of 10 K"), VERDICT_PROMISED, .rubber = RUBBER_BROAD, BASE_LAW,
     .first = -30, .last = 60, .step = 10, .lg_first = 0, .lg_last = 1, .frequencies = 11,
     NOISE(.01), FREE, OPEN},

    /* more scenes, with the default vertical shift */
    {NAMED("exchanged", "V4 by the default"), .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .exchanged = true, BAD},
    {NAMED("crystallises", "V5 by the default"), .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .crystallises = 1, BAD},
    {NAMED("two_laws", "V2 by the default"), .rubber = RUBBER_TWO,
     .law = {900, -90, 300, NONE, 1, 0}, .reference = 20, G13, NOISE(.015), BAD},
    {NAMED("narrow", "V7 by the default"), .rubber = RUBBER_BROAD, BASE_LAW, .first = -30,
     .last = 60, .step = 10, .lg_first = 0, .lg_last = 1, .frequencies = 11, NOISE(.01), OPEN,
     .contact = &contact_d1},
    {NAMED("half_decade", "half a decade in steps of 3 K"), .rubber = RUBBER_BROAD, BASE_LAW,
     .first = -28, .last = 50, .step = 3, .lg_first = 0, .lg_last = .5, .frequencies = 8,
     NOISE(.01), .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)},
    {NAMED("outliers", "3 % of the points 25 % off"), PROMISED, .rubber = RUBBER_BROAD, BASE_LAW,
     G10, NOISE(.01), .outliers = .03, .outlier_size = .25, GOOD},
    {NAMED("outliers_large", "2 % of the points a factor of 3 off"), .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .outliers = .02, .outlier_size = 1.1, GOOD},
    {NAMED("far", "thirty decades of shift, in steps of up to two and a half"),
     .rubber = RUBBER_WIDE, .law = {2500, -105, 0, NONE, 1, 0}, .reference = 20, .first = -55,
     .last = 40, .step = 2.5, .lg_first = -1.5, .lg_last = 2, .frequencies = 15, NOISE(.01),
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)},
    {NAMED("far_steps", "steps of up to twenty decades, nothing overlaps"), .rubber = RUBBER_WIDE,
     .law = {2500, -105, 0, NONE, 1, 0}, .reference = 20, .first = -70, .last = 50, .step = 30,
     FREQUENCIES10, NOISE(.01), OPEN},
    {NAMED("glass", "Arrhenius below -5 degC"), .rubber = RUBBER_BROAD,
     .law = {900, -90, 0, -5, .35, 0}, .reference = 20, .first = -40, .last = 60, .step = 5,
     FREQUENCIES10, NOISE(.01), GOOD, .contact = &contact_d1},
    {NAMED("temperature_geometry", "0.2 K and 2 %"), .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .temperature_error = .2, .geometry_error = .02, GOOD},
    {NAMED("scatter_little", "0.05 K and 0.5 %, about what 1 % of noise hides"),
     .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), .temperature_error = .05,
     .geometry_error = .005, GOOD},
    {NAMED("scatter_little_free", "the same, free b"), .rubber = RUBBER_SHARP, BASE_LAW, G10,
     NOISE(.01), .temperature_error = .05, .geometry_error = .005, FREE, GOOD},
    {NAMED("cool", "D3 up to 40 degC: the slow end of the spectrum 3.5 decades away"),
     .rubber = RUBBER_BROAD, BASE_LAW, .first = -30, .last = 40, .step = 10, FREQUENCIES10,
     NOISE(.001), .temperature_error = .05, GOOD},
    {NAMED("hot", "D3 up to 100 degC: the slow end of the spectrum 1.8 decades away"),
     .rubber = RUBBER_BROAD, BASE_LAW, .first = -30, .last = 100, .step = 10, FREQUENCIES10,
     NOISE(.001), .temperature_error = .05, GOOD},
    {NAMED("temperature_departs", "0.2 K, b departs"), .rubber = RUBBER_SHARP, BASE_LAW, G10,
     NOISE(.01), .temperature_error = .2, .departure = .05, GOOD},
    {NAMED("correlated_strong", "rho 0.9, 2 %"), .rubber = RUBBER_BROAD, BASE_LAW, D13_GRID,
     NOISE(.02), .correlation = .9, .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)},
    {NAMED("havriliak_negami", "two of them, 1 %"), .rubber = RUBBER_HAVRILIAK_NEGAMI, BASE_LAW,
     G10, NOISE(.01), GOOD, .contact = &contact_d1},
    {NAMED("fractional_zener", "1 %, 0.1 K"), .rubber = RUBBER_FRACTIONAL_ZENER, BASE_LAW, G10,
     NOISE(.01), .temperature_error = .1, GOOD, .other_layout = true},
    {NAMED("heteroscedastic", "0.5 % in the middle of an isotherm, 3 % at its ends"),
     .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.005), .bathtub = 6, GOOD},
    {NAMED("ragged", "another grid of frequencies for each isotherm"), .rubber = RUBBER_SHARP,
     BASE_LAW, G10, NOISE(.01), .ragged = true, GOOD, .other_layout = true},
    {NAMED("missing", "a quarter of the points missing"), .rubber = RUBBER_TWO, TWO_LAW, G13,
     NOISE(.015), .missing = .25, GOOD},
    {NAMED("ripple", "a damped wave on the spectrum"), .rubber = RUBBER_RIPPLE, BASE_LAW, G10,
     NOISE(.01), GOOD},
    {NAMED("lines", "one sharp process a decade"), .rubber = RUBBER_LINES, BASE_LAW, G10,
     NOISE(.01), GOOD},
    {NAMED("lines_fine", "one sharp process a decade, 0.4 %"), .rubber = RUBBER_LINES, BASE_LAW,
     G10, NOISE(.004), GOOD},
    {NAMED("reference_between", "a reference temperature between two isotherms"),
     .rubber = RUBBER_BROAD, .law = {900, -90, 0, NONE, 1, 0}, .reference = 25, G10, NOISE(.01),
     .temperature_error = .1, GOOD},
    {NAMED("inputs", "D1, contact and layer known to 7 %"), .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), GOOD, .contact = &contact_inputs},
    {NAMED("warm", "D8 and friction at 45 degC"), .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.01),
     .temperature_error = .3, GOOD, .contact = &contact_warm},
    {NAMED("shear", "D6 measured in shear"), .rubber = RUBBER_TWO, TWO_LAW, G13, NOISE(.015),
     .temperature_error = .1, .shear = true, GOOD, .contact = &contact_d6},
    {NAMED("exact", "next to no errors: are estimates and truth the same thing?"),
     .rubber = RUBBER_TWO, TWO_LAW, G13, NOISE(.0002), .vertical = "physical", GOOD,
     .contact = &contact_d6},

    /* unmeasured parts: an end of the spectrum, or the law */
    {NAMED("short", "four cold isotherms: the slow end of the spectrum four to five decades away"),
     .rubber = RUBBER_BROAD, BASE_LAW, .first = -10, .last = 20, .step = 10, FREQUENCIES10,
     NOISE(.01), .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)},
    {NAMED("short_two", "the same of two processes"), .rubber = RUBBER_TWO, TWO_LAW, .first = 0,
     .last = 40, .step = 10, FREQUENCIES10, NOISE(.01),
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)},
    {NAMED("three", "three isotherms, and friction beyond them"), .rubber = RUBBER_BROAD, BASE_LAW,
     .first = 5, .last = 35, .step = 15, FREQUENCIES10, NOISE(.01),
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE), .contact = &contact_d1},
    {NAMED("three_two", "the same of two processes"), .rubber = RUBBER_TWO, TWO_LAW, .first = 10,
     .last = 30, .step = 10, FREQUENCIES10, NOISE(.01),
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE), .contact = &contact_d1},
    {NAMED("coarse", "five isotherms of five points, 2 %, 0.3 K"), .rubber = RUBBER_BROAD, BASE_LAW,
     .first = -10, .last = 50, .step = 15, .lg_first = -1, .lg_last = 1.4, .frequencies = 5,
     NOISE(.02), .temperature_error = .3, .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE),
     .contact = &contact_d1},
    {NAMED("coarse_two", "the same of two processes"), .rubber = RUBBER_TWO, TWO_LAW, .first = -10,
     .last = 50, .step = 15, .lg_first = -1, .lg_last = 1.4, .frequencies = 5, NOISE(.02),
     .temperature_error = .3, .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE),
     .contact = &contact_d6},

    /* a second process with an increasingly different law; the error grows with the shift */
    {NAMED("second_400", "B 900 and 400 K, 2 %"), SECOND(900, -90, 400, NONE, 1, 0), NOISE(.02)},
    {NAMED("second_500", "B 900 and 500 K, 2 %"), SECOND(900, -90, 500, NONE, 1, 0), NOISE(.02)},
    {NAMED("second_600", "B 900 and 600 K, 1 %"), SECOND(900, -90, 600, NONE, 1, 0), NOISE(.01)},
    {NAMED("second_700", "B 900 and 700 K, 0.5 %"), SECOND(900, -90, 700, NONE, 1, 0), NOISE(.005)},
    {NAMED("second_700_loud", "B 900 and 700 K, 1 %"), SECOND(900, -90, 700, NONE, 1, 0),
     NOISE(.01)},
    {NAMED("second_800", "B 900 and 800 K, 0.5 %"), SECOND(900, -90, 800, NONE, 1, 0), NOISE(.005)},
    {NAMED("second_850", "B 900 and 850 K, 1 %"), SECOND(900, -90, 850, NONE, 1, 0), NOISE(.01)},
    {NAMED("second_cold", "Tinf -90 and -100 degC, 1 %"), SECOND(900, -90, 0, NONE, 1, -100),
     NOISE(.01)},
    {NAMED("second_colder", "Tinf -90 and -110 degC, 1 %"), SECOND(900, -90, 0, NONE, 1, -110),
     NOISE(.01)},
    {NAMED("crystallises_little", "a quarter of V5, 1 %"), VERDICT_PROMISED, .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .crystallises = .25, BAD},

    /* errors of the instrument, which all isotherms share */
    {NAMED("lag", "phase lag of 1 degree at the highest frequency"), .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .phase_lag = .0175, GOOD, .contact = &contact_d1},
    {NAMED("lag_two", "phase lag of -0.3 degrees"), .rubber = RUBBER_TWO, TWO_LAW, G13, NOISE(.015),
     .phase_lag = -.0052, GOOD, .contact = &contact_d6},
    {NAMED("inertia", "2 % of E' at the warmest and fastest point"), .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .inertia = .06, GOOD, .contact = &contact_d1},
    {NAMED("frame", "frame compliance of 1 % of the strain at 1 GPa"), .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .compliance = 1e-11, GOOD, .contact = &contact_d1},

    {NAMED("oven", "a sample that is warmer or colder than stated by 0.5 K"),
     .rubber = RUBBER_BROAD, BASE_LAW, G10, NOISE(.01), .oven = .5, GOOD, .contact = &contact_d1},

    /* other kinds of measurements */
    {NAMED("ramp_2", "temperature ramp at two frequencies"), .rubber = RUBBER_BROAD, BASE_LAW,
     .first = -30, .last = 60, .step = 1, .lg_first = 0, .lg_last = 1, .frequencies = 2, NOISE(.01),
     .ramp = true, .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE), .contact = &contact_d1},
    {NAMED("ramp_4", "temperature ramp at four frequencies"), .rubber = RUBBER_BROAD, BASE_LAW,
     .first = -30, .last = 60, .step = 2, .lg_first = -0.5, .lg_last = 1, .frequencies = 4,
     NOISE(.01), .ramp = true, .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE),
     .contact = &contact_d1},
    {NAMED("relaxation", "relaxation modulus in place of E' and E''"), .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .relaxation = true, OPEN, .contact = &contact_d1},

    /* one isotherm that does not belong to the others */
    {NAMED("bad_loss", "E'' of one isotherm 40 % too high"), .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .bad_loss = .4, .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE),
     .contact = &contact_d1},
    {NAMED("bad_stiffness", "one isotherm 25 % too stiff"), .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .bad_stiffness = .25, .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE),
     .contact = &contact_d1},
    {NAMED("bad_temperature", "one isotherm 5 K warmer than stated"), .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .bad_temperature = 5,
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE), .contact = &contact_d1},
    {NAMED("twice", "one isotherm measured twice, 25 % stiffer then"), .rubber = RUBBER_BROAD,
     BASE_LAW, G10, NOISE(.01), .bad_stiffness = .25, .twice = true,
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE), .contact = &contact_d1},

    /* held out: unused while the methods were chosen */
    {NAMED("held_two", "two, another law and grid, 2 %, 0.15 K"), PROMISED, .rubber = RUBBER_TWO,
     .law = {1100, -70, 0, NONE, 1, 0}, .reference = 34, .first = -10, .last = 100, .step = 11,
     .lg_first = -1.5, .lg_last = 1.5, .frequencies = 10, NOISE(.02), .temperature_error = .15,
     GOOD},
    {NAMED("held_plateau", "plateau, E' 0.8 %, E'' 2 %, geometry 1 %"), PROMISED,
     .rubber = RUBBER_PLATEAU, .law = {600, -60, 0, NONE, 1, 0}, .reference = 30, .first = 0,
     .last = 75, .step = 7.5, .lg_first = -1.5, .lg_last = 1.5, .frequencies = 11,
     .noise_storage = .008, .noise_loss = .02, .geometry_error = .01, GOOD},
    {NAMED("held_zener", "fractional Zener, eight isotherms, 3 %, correlated, b departs"), PROMISED,
     .rubber = RUBBER_FRACTIONAL_ZENER, .law = {800, -110, 0, NONE, 1, 0}, .reference = 0,
     .first = -45, .last = 60, .step = 15, .lg_first = -1, .lg_last = 2, .frequencies = 19,
     NOISE(.03), .correlation = .4, .departure = .03,
     .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)},
    {NAMED("held_ripple", "wave on the spectrum, ragged, points missing, 0.7 %, free b"), PROMISED,
     .rubber = RUBBER_RIPPLE, .law = {1000, -85, 0, NONE, 1, 0}, .reference = 20, .first = -25,
     .last = 65, .step = 9, .lg_first = -1, .lg_last = 1.8, .frequencies = 12, NOISE(.007),
     .missing = .15, .ragged = true, FREE, GOOD},
    {NAMED("held_two_laws", "two laws less far apart, 1 %"), VERDICT_PROMISED, .rubber = RUBBER_TWO,
     .law = {900, -90, 500, NONE, 1, 0}, .reference = 20, .first = -40, .last = 70, .step = 10,
     .lg_first = -1, .lg_last = 2, .frequencies = 13, NOISE(.01), BAD},

    /* one modulus alone */
    {NAMED("storage_alone", "D1 by the storage modulus alone"), .rubber = RUBBER_BROAD, BASE_LAW,
     G10, NOISE(.01), .by = "storage", OPEN},
    {NAMED("loss_alone", "D1 by the loss modulus alone"), .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .by = "loss", OPEN},
    {NAMED("factor_alone", "D1 by the loss factor alone"), .rubber = RUBBER_BROAD, BASE_LAW, G10,
     NOISE(.01), .by = "loss-factor", OPEN},
    {NAMED("storage_alone_two", "D6 by the storage modulus alone"), .rubber = RUBBER_TWO, TWO_LAW,
     G13, NOISE(.015), .temperature_error = .1, .by = "storage", OPEN},
    {NAMED("loss_alone_two", "D6 by the loss modulus alone"), .rubber = RUBBER_TWO, TWO_LAW, G13,
     NOISE(.015), .temperature_error = .1, .by = "loss", OPEN},
    {NAMED("factor_alone_two", "D6 by the loss factor alone"), .rubber = RUBBER_TWO, TWO_LAW, G13,
     NOISE(.015), .temperature_error = .1, .by = "loss-factor", OPEN},
};
const int n_dma_scenes = sizeof dma_scenes / sizeof dma_scenes[0];

double dma_part_of_e(const dma_scene *s)
{
    return s->shear ? 1.0 / 3 : 1;
}

double dma_vertical(const dma_scene *s, double temperature)
{
    return log10(293.15 / (temperature + 273.15)) + s->departure * sin((temperature - 20) / 25);
}

shift_law dma_second_law(const dma_scene *s)
{
    shift_law second = s->law;
    if (second.b_second > 0)
        second.b = second.b_second;
    if (second.t_inf_second < 0)
        second.t_inf = second.t_inf_second;
    return second;
}

rubber_state dma_state(const dma_scene *s, const rubber *r, double temperature)
{
    const shift_law second = dma_second_law(s);
    return (rubber_state){.rubber = r,
                          .a = {pow(10, law_shift(&s->law, s->reference, temperature)),
                                pow(10, law_shift(&second, s->reference, temperature))},
                          .factor = pow(10, -dma_vertical(s, temperature))};
}
