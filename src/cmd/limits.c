/* What the values of options may be. An option means the same in every subcommand, so its limits
 * stand here once. SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "cmd/cmd.h"

typedef struct limit {
    const char *option;
    double low, high; /* SI */
    bool open;        /* `low` itself is not allowed */
    const char *expected;
} limit;

static const limit limits[] = {
    {"pressure", 0, (double)INFINITY, true, "a pressure above 0"},
    {"shear-stress", 0, (double)INFINITY, false, "a shear stress of 0 or more"},
    {"velocity", 0, (double)INFINITY, true, "velocities above 0"},
    {"poisson-ratio", 0, 0.5, false, "0 to 0.5; rubber is nearly 0.5"},
    {"gamma", 0, 1, false, "0 to 1"},
    {"tolerance", 0, 0.1, true, "above 0, up to 0.1"},
    {"replicates", 0, 100000, false, "0 to 100000"},
    {"threads", 0, 1024, false, "0 (one per processor) to 1024"},
    {"expansion", 0, 0.01, false, "0 to 0.01 per kelvin; rubber is about 7e-4"},
    {"terms-per-decade", 0, 10, true, "above 0, up to 10"},
    {"smoothing", 0, (double)INFINITY, false, "0 or more"},
    {"spring-constant", 0, (double)INFINITY, true, "a spring constant above 0"},
    {"sensitivity", 0, (double)INFINITY, true, "a sensitivity above 0"},
    {"fit-depth", 0, (double)INFINITY, true, "a depth above 0"},
    {"fit-force-fraction", 0, 1, true, "above 0, up to 1"},
    {"minimum-r-squared", 0, 1, false, "0 to 1"},
    {"layer-thickness", 0, (double)INFINITY, true, "a thickness above 0"},
    {"layer-ratio", 0, (double)INFINITY, true, "a ratio above 0"},
    {"specific-wear-rate", 0, (double)INFINITY, false, "a wear rate of 0 or more"},
    {"critical-energy", 0, (double)INFINITY, true, "an energy density above 0"},
    {"observed-thickness", 0, (double)INFINITY, true, "a thickness above 0"},
    {"damage", 0, (double)INFINITY, true, "above 0"},
    {"duty", 0, 1, true, "above 0, up to 1"},
    {"start-thickness", 0, (double)INFINITY, false, "a thickness of 0 or more"},
    {"local-friction", 0, (double)INFINITY, false, "0 or more"},
    {"time", 0, (double)INFINITY, false, "times of 0 or more"},
};

const char *cmd_outside(const char *option, double value)
{
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        const limit *l = &limits[i];
        if (strcmp(l->option, option) == 0 &&
            (value < l->low || value > l->high || (l->open && !(value > l->low))))
            return l->expected;
    }
    return NULL;
}
