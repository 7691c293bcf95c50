/* Track against bulk. Coverages and widths of ln(ratio) are those of the theory text; other scenes
 * have none. Each scene is drawn with and without a layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "track_scene.h"

#include <math.h>

#define COMMON_RATES .rates = {{.2, 2}, {.2, 2}}
#define PARTLY .rates = {{.2, 2}, {2, 20}}
#define DISJOINT .rates = {{2, 20}, {.02, .2}}
#define GIVEN(coverage, half) .facts.given = {{Q_RATIO, coverage, half}}
#define NOT_GIVEN .facts.given = {{0}}
#define SPOTS(bulk, track, bulk_scatter, track_scatter)                                            \
    .spots = {bulk, track}, .spot_scatter = {bulk_scatter, track_scatter}
#define FOUR SPOTS(4, 4, .06, .06), .rate_slope = .06

/* Right verdicts with a layer, and without one. */
#define SEEN RIGHT(YES)
#define PERHAPS RIGHT(YES) | RIGHT(INCONCLUSIVE)
#define UNKNOWN RIGHT(INCONCLUSIVE)
#define NOT_YES RIGHT(NO) | RIGHT(INCONCLUSIVE)

/* No interval where "inconclusive" is the right verdict. */
#define SILENT .facts.verdict_promised = true, NOT_GIVEN
#define STATED .facts.verdict_promised = true, .facts.intervals_promised = true
#define PAIR(name, words, there, absent, ...)                                                      \
    {NAMED(name, words), .facts.right = there, .ratio = .64, __VA_ARGS__},                         \
    {                                                                                              \
        NAMED(name ".same", words ", no layer"), .facts.right = absent, .ratio = 1, __VA_ARGS__    \
    }

const track_scene track_scenes[] = {
    PAIR("T1", "4 + 4 spots, 6 %", SEEN, NOT_YES, FOUR, COMMON_RATES, STATED, GIVEN(96, .106)),
    PAIR("T2", "2 + 2 spots, 6 %", PERHAPS, NOT_YES, SPOTS(2, 2, .06, .06), .rate_slope = .06,
         COMMON_RATES, STATED, GIVEN(97, .36)),
    PAIR("T3", "4 + 4 spots, 5 and 25 %", PERHAPS, NOT_YES, SPOTS(4, 4, .05, .25),
         .rate_slope = .06, COMMON_RATES, STATED, GIVEN(94, .34)),
    PAIR("T4", "2 + 6 spots, 6 %", PERHAPS, NOT_YES, SPOTS(2, 6, .06, .06), .rate_slope = .06,
         COMMON_RATES, STATED, GIVEN(92, .147)),
    PAIR("T5", "none to three curves in a cell, rate slope 0.2", SEEN, NOT_YES,
         SPOTS(4, 4, .06, .06), .rate_slope = .2, COMMON_RATES, .cells_missing = true, STATED,
         GIVEN(96, .118)),
    PAIR("T6", "one rate in common, rate slope 0.15", SEEN, NOT_YES, SPOTS(4, 4, .06, .06),
         .rate_slope = .15, PARTLY, STATED, GIVEN(95, .108)),
    PAIR("T7", "no rate in common, rate slope 0.15", SEEN, NOT_YES, SPOTS(4, 4, .06, .06),
         .rate_slope = .15, DISJOINT, STATED, GIVEN(95, .106)),
    PAIR("T8", "separate levers with 10 % each", PERHAPS, NOT_YES, FOUR, COMMON_RATES,
         .lever_error = {.1, .1}, .levers_separate = true, STATED, GIVEN(96, .289)),
    PAIR("T9", "one lever with 10 %", SEEN, NOT_YES, FOUR, COMMON_RATES, .lever_error = {.1, .1},
         STATED, GIVEN(96, .105)),
    PAIR("T10", "one spot in the track", PERHAPS, NOT_YES, SPOTS(4, 1, .06, .06), .rate_slope = .06,
         COMMON_RATES, STATED, NOT_GIVEN),
    PAIR("T11", "track 10 +- 1 K warmer, slope known", SEEN, NOT_YES, FOUR, COMMON_RATES,
         .warmth = WARMER_SLOPE_KNOWN, STATED, GIVEN(95, (double)NAN)),

    /* scenes without a theory text */
    PAIR("T10.many", "one spot in the track, twelve in the bulk", SEEN, NOT_YES,
         SPOTS(12, 1, .06, .06), .rate_slope = .06, COMMON_RATES, STATED, NOT_GIVEN),
    PAIR("T10.uneven", "one spot in the track that scatters 12 %, twelve in the bulk of 6 %",
         PERHAPS, NOT_YES, SPOTS(12, 1, .06, .12), .rate_slope = .06, COMMON_RATES, STATED,
         NOT_GIVEN),
    PAIR("T10.bulk", "one spot in the bulk, eight in the track", PERHAPS, NOT_YES,
         SPOTS(1, 8, .06, .06), .rate_slope = .06, COMMON_RATES, STATED, NOT_GIVEN),
    PAIR("T1.friction", "T1, on to the friction with the layer", SEEN, NOT_YES, FOUR, COMMON_RATES,
         .through_friction = true, STATED, GIVEN(96, .106)),
    PAIR("T2.three", "3 + 3 spots, 6 %", PERHAPS, NOT_YES, SPOTS(3, 3, .06, .06), .rate_slope = .06,
         COMMON_RATES, STATED, NOT_GIVEN),
    /* Not promised: a larger scatter of two positions cannot be known from two. */
    PAIR("T4.wide", "2 + 6 spots, the two scatter 25 %, the others 5 %", PERHAPS, NOT_YES,
         SPOTS(2, 6, .25, .05), .rate_slope = .06, COMMON_RATES, NOT_GIVEN),
    PAIR("T4.narrow", "2 + 6 spots, the two scatter 5 %, the others 25 %", PERHAPS, NOT_YES,
         SPOTS(2, 6, .05, .25), .rate_slope = .06, COMMON_RATES, STATED, NOT_GIVEN),
    PAIR("T4.three", "3 + 2 spots, 6 %", PERHAPS, NOT_YES, SPOTS(3, 2, .06, .06), .rate_slope = .06,
         COMMON_RATES, STATED, NOT_GIVEN),
    PAIR("T7.alone", "one rate for each zone, no slope", UNKNOWN, UNKNOWN, SPOTS(4, 4, .06, .06),
         .rate_slope = .15, .rates = {{20, 20}, {.05, .05}}, SILENT),
    PAIR("T7.between", "no rate in common, one rate for each spot", PERHAPS, NOT_YES,
         SPOTS(6, 6, .06, .06), .rate_slope = .15, DISJOINT, .one_rate_a_spot = true, STATED,
         NOT_GIVEN),
    PAIR("T7.bent", "no rate in common, the ratio depends on the rate", PERHAPS, PERHAPS,
         SPOTS(4, 4, .06, .06), .rate_slope = .15, .ratio_slope = .1, DISJOINT,
         .facts.verdict_promised = true, NOT_GIVEN),
    PAIR("T1.bent", "the ratio depends on the rate", SEEN, PERHAPS, FOUR, COMMON_RATES,
         .ratio_slope = .1, .facts.verdict_promised = true, NOT_GIVEN),
    PAIR("T8.unequal", "separate levers with 3 and 20 %", PERHAPS, NOT_YES, FOUR, COMMON_RATES,
         .lever_error = {.03, .2}, .levers_separate = true, STATED, NOT_GIVEN),
    PAIR("T8.sensitivity", "separate levers with 10 %, sensitivities with 5 %", PERHAPS, NOT_YES,
         FOUR, COMMON_RATES, .lever_error = {.1, .1}, .sensitivity_error = .05,
         .levers_separate = true, STATED, NOT_GIVEN),
    PAIR("T9.sensitivity", "one lever, its sensitivity with 5 %", SEEN, NOT_YES, FOUR, COMMON_RATES,
         .lever_error = {.1, .1}, .sensitivity_error = .05, STATED, NOT_GIVEN),
    PAIR("T11.unknown", "track 10 K warmer, slope not known", UNKNOWN, UNKNOWN, FOUR, COMMON_RATES,
         .warmth = WARMER, SILENT),
    /* No interval is promised, because the command does not know the temperature. */
    PAIR("T11.unsaid", "track 17 K warmer, no temperature said, the DMA given", PERHAPS, NOT_YES,
         FOUR, COMMON_RATES, .warmth = WARMER_UNSAID, SILENT),
    PAIR("T11.unsaid.alone", "track 17 K warmer, no temperature said, no DMA", PERHAPS, NOT_YES,
         FOUR, COMMON_RATES, .warmth = WARMER_UNSAID_ALONE, SILENT),
    PAIR("T1.unsaid", "T1, no temperature said", SEEN, NOT_YES, FOUR, COMMON_RATES,
         .warmth = NOT_WARMER_UNSAID, STATED, NOT_GIVEN),
    PAIR("T7.unsaid",
         "T7, no temperature said: steep against the rate and so perhaps the temperature", PERHAPS,
         NOT_YES, SPOTS(4, 4, .06, .06), .rate_slope = .15, DISJOINT, .warmth = NOT_WARMER_UNSAID,
         STATED, NOT_GIVEN),
    PAIR("T10.unsaid", "one spot in the track, twelve in the bulk, no temperature said", PERHAPS,
         NOT_YES, SPOTS(12, 1, .06, .06), .rate_slope = .06, COMMON_RATES,
         .warmth = NOT_WARMER_UNSAID, STATED, NOT_GIVEN),
    PAIR("T12", "4 + 4 spots, heavy tails", PERHAPS, NOT_YES, FOUR, COMMON_RATES,
         .heavy_tails = true, STATED, NOT_GIVEN),
    PAIR("T13", "one map in each zone", UNKNOWN, UNKNOWN, SPOTS(1, 1, .06, .06), .rate_slope = .06,
         COMMON_RATES, .maps = true, SILENT),
    PAIR("T13.given", "one map in each zone, the scatter of spots given", SEEN, NOT_YES,
         SPOTS(1, 1, .06, .06), .rate_slope = .06, COMMON_RATES, .maps = true,
         .scatter_is_stated = true, STATED, NOT_GIVEN),
    PAIR("T13.many", "4 + 4 maps", SEEN, NOT_YES, FOUR, COMMON_RATES, .maps = true, STATED,
         NOT_GIVEN),
    PAIR("T14", "2 + 2 spots, those of the track given twice", PERHAPS, NOT_YES,
         SPOTS(2, 2, .06, .06), .rate_slope = .06, COMMON_RATES, .copies = 2, STATED, NOT_GIVEN),
    PAIR("T14.one", "4 spots, and one in the track given twice", PERHAPS, NOT_YES,
         SPOTS(4, 1, .06, .06), .rate_slope = .06, COMMON_RATES, .copies = 1, STATED, NOT_GIVEN),
    PAIR("T14.across", "a file of the bulk in the track, too", UNKNOWN, UNKNOWN, FOUR, COMMON_RATES,
         .copy_across = true, SILENT),
};
const int n_track_scenes = sizeof track_scenes / sizeof track_scenes[0];
