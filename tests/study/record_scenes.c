/* Records of friction, fixed before the method was tried on them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record_scene.h"

#define PROMISED .facts.intervals_promised = true

const record_scene record_scenes[] = {
    {NAMED("F1", "a jump, white scatter"), PROMISED, .form = A_JUMP, .height = 1},
    {NAMED("F2", "a jump, half of the scatter slow"), PROMISED, .form = A_JUMP, .height = 3,
     .slow = 0.5},
    {NAMED("F3", "a line, white scatter"), PROMISED, .form = A_LINE},
    {NAMED("F4", "a line, most of the scatter slow"), PROMISED, .form = A_LINE, .height = 6,
     .slow = 0.8},
    {NAMED("F5", "a hump, half of the scatter slow"), PROMISED, .form = A_HUMP, .height = 10,
     .slow = 0.5},
    {NAMED("F6", "exponential, half of the scatter slow"), PROMISED, .form = EXPONENTIAL,
     .height = 8, .slow = 0.5, .length = 0.05},
    {NAMED("F7", "no running-in, white scatter"), PROMISED},
    {NAMED("F8", "no running-in, all scatter slow, 20 laps"), PROMISED, .slow = 1, .memory = 20},
    {NAMED("F9", "no running-in, a short record"), PROMISED, .slow = 0.7, .laps = 120, .memory = 4},
    {NAMED("F10", "drift, half of the scatter slow"), .facts.intervals_promised = true, .slow = 0.5,
     .drift = 2},
    {NAMED("F11", "a wave of the lap, 7.6 samples in it"), PROMISED, .form = A_JUMP, .height = 4,
     .samples = 8, .wave = 0.1},
    {NAMED("F12", "there and back, with a zero"), PROMISED, .facts.sometimes_silent = true,
     .form = A_LINE, .strokes = true, .slow = 0.3},
    {NAMED("F13", "time alone, sampled at another rate half-way"), PROMISED, .form = A_JUMP,
     .height = 3, .slow = 0.5, .changing_rate = true},
    {NAMED("F14", "four velocities"), PROMISED, .steps = 4, .slow = 0.5},
    {NAMED("F15", "wear by the area of the track, 10 %"), PROMISED, .area_error = 0.1},
    {NAMED("F16", "wear by mass, 20 %"), PROMISED, .mass_error = 0.2},
    {NAMED("F17", "a jump, scatter that wanders with the square root of the time"), .form = A_JUMP,
     .height = 6, .moving = 0.05, .slow = 0.5},
    {NAMED("F18", "a rest of drawn place and length, wear 10 %"), PROMISED, .form = A_LINE,
     .height = 6, .area_error = 0.1, .pause = A_REST},
    {NAMED("F19", "a gap of drawn place and length, wear 10 %"), PROMISED, .form = A_LINE,
     .height = 6, .area_error = 0.1, .pause = A_GAP},
};
const int n_record_scenes = sizeof record_scenes / sizeof record_scenes[0];
