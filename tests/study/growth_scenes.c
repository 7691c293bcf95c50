/* Running-in of a record against a growing layer. The scenes were fixed before the method was tried
 * on them; the promises were not.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "growth_scene.h"

#define PROMISED .facts.intervals_promised = true, .facts.verdict_promised = true
/* Few draws determine a time, or none. */
#define VERDICT_ALONE .facts.verdict_promised = true
/* Rows as of a recorder, few of them during the change. */
#define ROWS                                                                                       \
    .of_inputs = 0.03, .of_layer = 0.05, .of_ratio = 0.03, .noise = 0.001, .laps = 400, .lengths = 8
#define NOT_NO .facts.right = RIGHT(YES) | RIGHT(INCONCLUSIVE)
#define NOT_YES .facts.right = RIGHT(NO) | RIGHT(INCONCLUSIVE)

const growth_scene growth_scenes[] = {
    {NAMED("R1", "the theory is right, inputs good to 3 %"), PROMISED, .facts.right = RIGHT(YES),
     .of_inputs = 0.03, .of_layer = 0.03, .of_ratio = 0.03},
    {NAMED("R2", "the theory is right, wear and energy good to 20 %"), PROMISED, NOT_NO,
     .of_inputs = 0.05, .of_layer = 0.2, .of_ratio = 0.05},
    {NAMED("R3", "by transport of damage, inputs good to 5 %"), PROMISED, NOT_NO, .of_inputs = 0.05,
     .of_layer = 0.05, .of_ratio = 0.05, .transport = true},
    {NAMED("R4", "five times as slow as the theory"), PROMISED, .facts.right = RIGHT(NO),
     .off_time = 5, .of_inputs = 0.03, .of_layer = 0.05, .of_ratio = 0.03, .lengths = 20},
    {NAMED("R5", "in a fifth of the time"), PROMISED, .facts.right = RIGHT(NO), .off_time = 0.2,
     .of_inputs = 0.03, .of_layer = 0.05, .of_ratio = 0.03},
    {NAMED("R6", "2.2 times as slow, beyond the margin"), PROMISED, NOT_YES, .off_time = 2.2,
     .of_inputs = 0.05, .of_layer = 0.1, .of_ratio = 0.05, .lengths = 10},
    {NAMED("R7", "friction changes the other way"), PROMISED, .facts.right = RIGHT(NO),
     .off_change = -1, .of_inputs = 0.03, .of_layer = 0.05, .of_ratio = 0.03},
    {NAMED("R8", "three times the change"), PROMISED, .facts.right = RIGHT(NO), .off_change = 3,
     .of_inputs = 0.03, .of_layer = 0.05, .of_ratio = 0.03},
    {NAMED("R9", "friction does not change"), PROMISED, .facts.right = RIGHT(NO), .flat = true,
     .of_inputs = 0.03, .of_layer = 0.05, .of_ratio = 0.03},
    {NAMED("R10", "laps that scatter by 1 %, half of it slow"), VERDICT_ALONE, NOT_NO,
     .of_inputs = 0.05, .of_layer = 0.1, .of_ratio = 0.05, .noise = 0.01, .slow = 0.5},
    {NAMED("R11", "a record that ends too soon"), VERDICT_ALONE, NOT_NO, .of_inputs = 0.05,
     .of_layer = 0.05, .of_ratio = 0.05, .lengths = 0.5},
    {NAMED("R12", "three records"), VERDICT_ALONE, NOT_NO, .of_inputs = 0.05, .of_layer = 0.1,
     .of_ratio = 0.05, .noise = 0.006, .slow = 0.3, .records = 3},
    {NAMED("R13", "by transport, five times as slow"), PROMISED, .facts.right = RIGHT(NO),
     .off_time = 5, .of_inputs = 0.03, .of_layer = 0.05, .of_ratio = 0.03, .lengths = 20,
     .transport = true},
    {NAMED("R14", "no shear stress in the case"), PROMISED, .facts.right = RIGHT(INCONCLUSIVE),
     .of_inputs = 0.05, .of_layer = 0.05, .of_ratio = 0.05, .unsaid = true},
    {NAMED("R15", "one row a lap, at its start"), PROMISED, NOT_NO, ROWS, .rows = ROWS_FROM},
    {NAMED("R16", "one row a lap, at its middle, by transport"), PROMISED, NOT_NO, ROWS,
     .rows = ROWS_ABOUT, .transport = true},
    {NAMED("R17", "one row a lap, at its end, by transport"), PROMISED, NOT_NO, ROWS,
     .rows = ROWS_UNTIL, .transport = true},
    {NAMED("R18", "friction at one time of a lap, the first of the bare surface"), PROMISED, NOT_NO,
     ROWS, .rows = ROWS_AT},
    {NAMED("R19", "the same by transport"), PROMISED, NOT_NO, ROWS, .rows = ROWS_AT,
     .transport = true},
};
const int n_growth_scenes = sizeof growth_scenes / sizeof growth_scenes[0];
