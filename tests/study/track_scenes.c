/* Track against bulk; coverages and widths of ln(ratio) as the theory text gives them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "track_scene.h"

#define COMMON_RATES .rates = {{.2, 2}, {.2, 2}}
#define DIFFERS .facts.right = RIGHT(YES), .ratio = .64
#define PERHAPS .facts.right = RIGHT(YES) | RIGHT(NO) | RIGHT(CANNOT_SAY), .ratio = .64
#define SAME .facts.right = RIGHT(NO) | RIGHT(CANNOT_SAY), .ratio = 1
#define GIVEN(coverage, half) .facts.given = {{Q_RATIO, coverage, half}}
#define FOUR .spots = {4, 4}, .spot_scatter = {.06, .06}, .rate_slope = .06

const track_scene track_scenes[] = {
    {NAMED("T1", "4 + 4 spots, 6 %"), FOUR, COMMON_RATES, DIFFERS, GIVEN(96, .106)},
    {NAMED("T2", "2 + 2 spots, 6 %"), .spots = {2, 2}, .spot_scatter = {.06, .06},
     .rate_slope = .06, COMMON_RATES, PERHAPS, GIVEN(97, .36)},
    {NAMED("T3", "4 + 4 spots, 5 and 25 %"), .spots = {4, 4}, .spot_scatter = {.05, .25},
     .rate_slope = .06, COMMON_RATES, PERHAPS, GIVEN(94, .34)},
    {NAMED("T4", "2 + 6 spots, 6 %"), .spots = {2, 6}, .spot_scatter = {.06, .06},
     .rate_slope = .06, COMMON_RATES, DIFFERS, GIVEN(92, .147)},
    {NAMED("T5", "none to three curves in a cell, rate slope 0.2"), .spots = {4, 4},
     .spot_scatter = {.06, .06}, .rate_slope = .2, COMMON_RATES, .cells_missing = true, DIFFERS,
     GIVEN(96, .118)},
    {NAMED("T6", "one rate in common, rate slope 0.15"), .spots = {4, 4},
     .spot_scatter = {.06, .06}, .rate_slope = .15, .rates = {{.2, 2}, {2, 20}}, DIFFERS,
     GIVEN(95, .108)},
    {NAMED("T7", "no rate in common, rate slope 0.15"), .spots = {4, 4}, .spot_scatter = {.06, .06},
     .rate_slope = .15, .rates = {{2, 20}, {.02, .2}}, DIFFERS, GIVEN(95, .106)},
    {NAMED("T8", "separate levers with 10 % each"), FOUR, COMMON_RATES, .lever_error = .1,
     .levers_separate = true, DIFFERS, GIVEN(96, .289)},
    {NAMED("T9", "one lever with 10 %"), FOUR, COMMON_RATES, .lever_error = .1, DIFFERS,
     GIVEN(96, .105)},
    {NAMED("T10", "one spot in the track"), .spots = {4, 1}, .spot_scatter = {.06, .06},
     .rate_slope = .06, COMMON_RATES, .facts.right = RIGHT(CANNOT_SAY), .ratio = .64},
    {NAMED("T1.same", "T1 without a layer"), FOUR, COMMON_RATES, SAME},
    {NAMED("T3.same", "T3 without a layer"), .spots = {4, 4}, .spot_scatter = {.05, .25},
     .rate_slope = .06, COMMON_RATES, SAME},
    {NAMED("T7.same", "T7 without a layer"), .spots = {4, 4}, .spot_scatter = {.06, .06},
     .rate_slope = .15, .rates = {{2, 20}, {.02, .2}}, SAME},
};
const int n_track_scenes = sizeof track_scenes / sizeof track_scenes[0];
