/* Parameters of friction records.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/param.h"
#include "weartrack/record.h"

/* Poisson's ratio of filled rubber well above its glass transition. */
static const double incompressible = 0.5;

wt_record_job wt_record_job_defaults(void)
{
    const double unknown = (double)NAN;
    return (wt_record_job){.load = {unknown, 0, 0, "N"},
                           .track_radius = {unknown, 0, 0, "m"},
                           .track_area = {unknown, 0, 0, "m^2"},
                           .mass_loss = {unknown, 0, 0, "kg"},
                           .density = {unknown, 0, 0, "kg/m^3"},
                           .track_length = {unknown, 0, 0, "m"},
                           .ball_radius = {unknown, 0, 0, "m"},
                           .modulus = {unknown, 0, 0, "Pa"},
                           .poisson_ratio = incompressible};
}

static const wt_param rows[] = {
    {PARAM_CHOICE_OF("average", wt_record_job, cycle, "auto|stroke|lap|time|sample"),
     .help = "what friction is averaged over before its scatter is judged: double strokes, laps or "
             "equal spans of time, or every sample by itself"},
    {PARAM_CHOICE_OF("running-in", wt_record_job, running_in, "change|none"),
     .help = "how the end of the running-in is found: by likelihood with an interval; none: all is "
             "steady"},
    {PARAM("load", wt_record_job, load, WT_Q_NORMAL_FORCE, ABOVE(0)), .value = "F",
     .unset = "that of the file",
     .help = SUCH_AS("normal force where the record says none, ", "\"5N +- 1%\"", "")},
    {PARAM("track-radius", wt_record_job, track_radius, WT_Q_LENGTH, ABOVE(0)), .value = "R",
     .unset = "that of the file",
     .help = "radius of the track on a disc, which relates distance to laps and velocity to "
             "rotation"},
    {PARAM("track-area", wt_record_job, track_area, WT_Q_AREA, ABOVE(0)), .value = "A", .unset = "",
     .help = SUCH_AS("cross-section that the track has lost, ", "\"3e-11m^2 +- 20%\"",
                     ", for the specific wear rate")},
    {PARAM_TEXT_OF("profile", wt_record_job, profile), .value = "FILE", .unset = "",
     .flags = PARAM_NO_CASE,
     .help =
         "the same from profiles of heights across the track: a file, a folder or a pattern; of "
         "several the mean, with their scatter"},
    {PARAM("mass-loss", wt_record_job, mass_loss, WT_Q_MASS, ABOVE(0)), .value = "M", .unset = "",
     .help = SUCH_AS("mass that was lost, ", "\"3mg +- 0.2mg\"", "; with --density")},
    {PARAM("density", wt_record_job, density, WT_Q_MASS_DENSITY, ABOVE(0)), .value = "RHO",
     .unset = "", .help = SUCH_AS("density of the rubber, ", "1150kg/m^3", "")},
    {PARAM("track-length", wt_record_job, track_length, WT_Q_LENGTH, ABOVE(0)), .value = "L",
     .unset = "the circumference of the track, or the length of its strokes",
     .help = "length of the track, such as the stroke of a reciprocating record"},
    {PARAM("ball-radius", wt_record_job, ball_radius, WT_Q_LENGTH, ABOVE(0)), .value = "R",
     .unset = "",
     .help = "radius of the ball: with --modulus its nominal pressure; and the cross-section that "
             "it has worn, by the depth of the record, if it is harder than the track"},
    {PARAM("modulus", wt_record_job, modulus, WT_Q_MODULUS, ABOVE(0)), .value = "E", .unset = "",
     .help =
         SUCH_AS("Young's modulus of the rubber at the frequency of the contact, ", "20MPa", "")},
    {PARAM("poisson-ratio", wt_record_job, poisson_ratio, WT_Q_NONE, FROM_TO(0, 0.5)), .value = "X",
     .help = "Poisson's ratio of the rubber"},
};
PARAM_TABLE(wt_record_job_params, wt_record_job, rows, wt_record_job_defaults, NO_PARTS)
