/* Height maps of the bundled case: a road at two positions, each measured at two magnifications, so
 * that waves of 2 mm to 2 um are resolved.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "generate.h"
#include "generate_field.h"

#include <stdio.h>

enum { SURFACE = 512, MODES = 254, WIDE = 192, NEAR = 224 };
/* Point distance [m] of an optical profiler and an AFM. */
static const double wide_step = 22e-6, near_step = 0.55e-6;

static int write_map(const char *folder, const char *name, double step, size_t points,
                     uint64_t seed)
{
    const synthetic_surface road = {SURFACE,        SURFACE * step, seed, MODES, TRUTH_ROAD_C0,
                                    TRUTH_ROLL_OFF, TRUTH_HURST,    0,    true,  0};
    /* offset from the edges, because a synthetic surface is periodic */
    if (write_field(folder, name, &road, points, points, 60, 80) == 0)
        return 0;
    fprintf(stderr, "%s cannot be written\n", name);
    return -1;
}

int generate_road(const char *folder, uint64_t variant)
{
    enum { MAPS = 4 }; /* one seed for each */
    const uint64_t seed = 41 + MAPS * variant;
    return write_map(folder, "road-1.gsf", wide_step, WIDE, seed) != 0 ||
                   write_map(folder, "road-2.gsf", wide_step, WIDE, seed + 1) != 0 ||
                   write_map(folder, "road-1-near.gsf", near_step, NEAR, seed + 2) != 0 ||
                   write_map(folder, "road-2-near.gsf", near_step, NEAR, seed + 3) != 0
               ? -1
               : 0;
}
