/* Columns and keys of the tables of friction records. Only the table registry includes this
 * file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_TABLES_H
#define WT_RECORD_TABLES_H

/* Each row is one step of a record: its conditions, then friction in its steady state. */
#define RECORD_COLUMNS(X)                                                                          \
    X(RECORD_VELOCITY, IN(at, velocity), "sliding velocity", SI(VELOCITY), LABEL("Velocity"),      \
      SPARSE)                                                                                      \
    X(RECORD_ROTATION, IN(at, rotation), "rotation of the disc", SI(ANGULAR_FREQUENCY),            \
      LABEL("Rotation"), OPTIONAL, SPARSE)                                                         \
    X(RECORD_NORMAL_FORCE, IN(at, normal_force), "normal force", SI(NORMAL_FORCE), LABEL("Load"),  \
      SPARSE)                                                                                      \
    X(RECORD_PRESSURE, IN(at, pressure), "nominal pressure that the record says", SI(PRESSURE),    \
      LABEL("Pressure"), SPARSE)                                                                   \
    X(RECORD_TEMPERATURE, IN(at, temperature), "temperature", SI(TEMPERATURE),                     \
      LABEL("Temperature"), SPARSE)                                                                \
    NUMBER_AND_INTERVAL(X, RECORD_FRICTION, "friction_coefficient",                                \
                        "mean friction coefficient of the steady part", NUMBER, "Friction",        \
                        SHOWS(steady.mean))                                                        \
    X(RECORD_DEVIATION, IN(steady, deviation), "standard deviation of the cycles in it", NUMBER,   \
      DIGITS(2), LABEL("Scatter of the cycles"), SPARSE)                                           \
    X(RECORD_MIN, "friction_min", "smallest of the cycles in it", NUMBER, SHOWS(steady.min),       \
      SPARSE)                                                                                      \
    X(RECORD_MAX, "friction_max", "largest of the cycles in it", NUMBER, SHOWS(steady.max),        \
      SPARSE)                                                                                      \
    X(RECORD_CORRELATION, IN(steady, correlation),                                                 \
      "variance of the mean over that of as many independent cycles", NUMBER, DIGITS(2),           \
      LABEL("Correlation, cycles"), SPARSE)                                                        \
    NUMBER_AND_INTERVAL(X, RECORD_DRIFT, "drift",                                                  \
                        "change of the friction coefficient from end to end of the steady part",   \
                        NUMBER, "Drift", SHOWS(drift))                                             \
    NUMBER_AND_INTERVAL(X, RECORD_RUNNING_IN, "running_in", "cycles before the steady part",       \
                        NUMBER, "Running-in, cycles", SHOWS(end))                                  \
    NUMBER_AND_INTERVAL(X, RECORD_RUNNING_IN_TIME, "running_in_time", "time before it", SI(TIME),  \
                        "Running-in, time", SHOWS(end_time))                                       \
    NUMBER_AND_INTERVAL(X, RECORD_RUNNING_IN_DISTANCE, "running_in_distance",                      \
                        "distance slid before it", SI(SLIDING_DISTANCE), "Running-in, distance",   \
                        SHOWS(end_distance))                                                       \
    X(RECORD_RUNNING_IN_NOTE, "running_in_note", "why there is no end of it", TEXT,                \
      SHOWS(end_note), LABEL("Note"))                                                              \
    X(RECORD_ZERO, AS(zero),                                                                       \
      "zero of a reciprocating record: half of there and back with their signs, as a coefficient", \
      NUMBER, LABEL("Zero"), SPARSE)                                                               \
    X(RECORD_DIFFERENCE, AS(difference),                                                           \
      "largest difference of the coefficient that the file says and friction force over load",     \
      NUMBER, DIGITS(2), LABEL("µ against F/F_N"), SPARSE)                                         \
    X(RECORD_CYCLES_ALL, AS(cycles), "cycles of the step", NUMBER, LABEL("Cycles"))                \
    X(RECORD_STEADY_CYCLES, "steady_cycles", "cycles of the steady part", NUMBER, SHOWS(steady.n), \
      LABEL("of them steady"))                                                                     \
    X(RECORD_SAMPLES, AS(samples), "samples in a cycle", NUMBER, LABEL("Samples in one"))          \
    X(RECORD_PAUSES, AS(pauses), "pauses in it, which no time and no distance holds", NUMBER,      \
      LABEL("Pauses"), OPTIONAL, SPARSE)                                                           \
    X(RECORD_PAUSED, "paused_time", "time that they took", SI(TIME), SHOWS(paused),                \
      LABEL("Time paused"), OPTIONAL, SPARSE)                                                      \
    X(RECORD_AVERAGED_OVER, AS(averaged_over), "what a cycle is", TEXT, LABEL("A cycle is"))       \
    X(RECORD_STEP, AS(step), "number of the step in its file", NUMBER, LABEL("Step"))              \
    X(RECORD_NOTE, AS(note), "what is lacking", TEXT, LABEL("Note"))                               \
    X(RECORD_FILE, AS(file), "file of the record", TEXT, LABEL("File"))
/* The friction coefficient is the mean over all rows, if their conditions are equal. */
#define RECORD_KEYS(X)                                                                             \
    X(RECORD_KEY_FRICTION, "friction_coefficient", UNIT("1"), HEADLINE("Friction, measured"),      \
      OPTIONAL)                                                                                    \
    X(RECORD_KEY_N_FILES, "n_files", PLAIN)

/* Each row is a cycle; each block is a step of a record. */
#define RECORD_CYCLES_COLUMNS(X)                                                                   \
    X(RECORD_CYCLES_CYCLE, AS(number), "number of the cycle in its step", NUMBER)                  \
    X(RECORD_CYCLES_TIME, IN(cycle, time), "time", SI(TIME), SPARSE)                               \
    X(RECORD_CYCLES_DISTANCE, IN(cycle, distance), "distance slid", SI(SLIDING_DISTANCE), SPARSE)  \
    X(RECORD_CYCLES_LAPS, IN(cycle, laps), "laps", SI(LAPS), SPARSE)                               \
    X(RECORD_CYCLES_FRICTION, "friction_coefficient", "mean friction coefficient", NUMBER,         \
      SHOWS(cycle.coefficient))                                                                    \
    X(RECORD_CYCLES_DEVIATION, IN(cycle, deviation), "standard deviation of its samples", NUMBER,  \
      SPARSE)                                                                                      \
    X(RECORD_CYCLES_ZERO, IN(cycle, zero),                                                         \
      "half of there and back with their signs, as a coefficient", NUMBER, SPARSE)                 \
    X(RECORD_CYCLES_NORMAL_FORCE, IN(cycle, normal_force), "normal force", SI(NORMAL_FORCE),       \
      SPARSE)                                                                                      \
    X(RECORD_CYCLES_VELOCITY, IN(cycle, velocity), "sliding velocity", SI(VELOCITY), SPARSE)       \
    X(RECORD_CYCLES_PRESSURE, IN(cycle, pressure), "nominal pressure", SI(PRESSURE), SPARSE)       \
    X(RECORD_CYCLES_TEMPERATURE, IN(cycle, temperature), "temperature", SI(TEMPERATURE), SPARSE)   \
    X(RECORD_CYCLES_WEAR_DEPTH, IN(cycle, wear_depth), "wear depth", SI(WEAR_DEPTH), SPARSE)       \
    X(RECORD_CYCLES_STEADY, AS(steady), "1: it is of the steady part", YES_NO)                     \
    X(RECORD_CYCLES_STEP, AS(step), "number of the step in its file", NUMBER)                      \
    X(RECORD_CYCLES_FILE, AS(file), "file of the record", TEXT)
#define RECORD_CYCLES_KEYS(X) X(RECORD_CYCLES_KEY_AVERAGED_OVER, "averaged_over", TEXT)

/* Each row is a record. */
#define WEAR_COLUMNS(X)                                                                            \
    NUMBER_AND_INTERVAL(X, WEAR_RATE, "specific_wear_rate", "specific wear rate k", SI(WEAR_RATE), \
                        "Specific wear rate", SHOWS(rate))                                         \
    X(WEAR_OF, AS(of), "what the volume is of", TEXT, LABEL("By"))                                 \
    X(WEAR_VOLUME, "volume", "volume that was worn", UNIT("m^3"), SHOWS(volume.value),             \
      LABEL("Volume"), STANDARD_ERROR(WEAR_VOLUME), SPARSE)                                        \
    X(WEAR_VOLUME_STANDARD_ERROR, "volume_standard_error", "its standard error", UNIT("m^3"),      \
      SHOWS(volume.standard_error), SPARSE)                                                        \
    X(WEAR_DEPTH, "depth", "depth that was worn, by that of the record", SI(WEAR_DEPTH),           \
      SHOWS(depth.value), LABEL("Depth"), STANDARD_ERROR(WEAR_DEPTH), SPARSE)                      \
    X(WEAR_DEPTH_STANDARD_ERROR, "depth_standard_error", "its standard error", SI(WEAR_DEPTH),     \
      SHOWS(depth.standard_error), SPARSE)                                                         \
    X(WEAR_NORMAL_FORCE, AS(normal_force), "mean normal force", SI(NORMAL_FORCE), LABEL("Load"),   \
      SPARSE)                                                                                      \
    X(WEAR_DISTANCE, AS(distance), "distance slid", SI(SLIDING_DISTANCE), LABEL("Distance"),       \
      SPARSE)                                                                                      \
    X(WEAR_CONTACT_RADIUS, IN(ball, contact_radius), "radius of the contact of the ball",          \
      SI(LENGTH), LABEL("Contact radius"), SPARSE)                                                 \
    X(WEAR_PRESSURE, "pressure", "nominal pressure: load over the area of the contact",            \
      SI(PRESSURE), SHOWS(ball.pressure), LABEL("Pressure of the ball"), SPARSE)                   \
    X(WEAR_DUTY, AS(duty),                                                                         \
      "effective duty on the middle line of the track: share of the time under that pressure",     \
      NUMBER, LABEL("Effective duty"), SPARSE)                                                     \
    X(WEAR_NOTE, AS(note), "why there is no rate, or what it lacks", TEXT, LABEL("Note"))          \
    X(WEAR_FILE, AS(file), "file of the record", TEXT, LABEL("File"))
/* The rate is the mean of several rows, with their scatter. */
#define WEAR_KEYS(X)                                                                               \
    X(WEAR_KEY_RATE, "specific_wear_rate", SI(WEAR_RATE), HEADLINE("Specific wear rate"),          \
      OPTIONAL)                                                                                    \
    X(WEAR_KEY_RATE_DF, "specific_wear_rate_df", NUMBER, LABEL("Degrees of freedom of its error"), \
      OPTIONAL)

#endif
