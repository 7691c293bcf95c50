/* Writes the height maps of fixtures/surface as Gwyddion Simple Field: two positions of a random
 * surface with a known spectrum, one smaller window, and profiles.
 *
 * Usage: generate_surface FOLDER
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "generate_field.h"

#include <stdio.h>

/* Ground steel or fine asphalt: 1 um rms, waves down to two points. */
static const synthetic_surface wide = {256, 200e-6, 21, 126, 6e-26, 6e5, 0.8, 0, true, 0};
/* The bundled case: a road of 40 um rms. */
static const synthetic_surface road = {256, 6.4e-3, 23, 126, 2e-17, 4e3, 0.8, 0, true, 0};
static const synthetic_surface narrow = {256, 20e-6, 22, 126, 6e-26, 6e5, 0.8, 0, true, 0};

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    for (size_t i = 0; i < 8; i++) {
        char name[32];
        snprintf(name, sizeof name, "profile-%zu.gsf", i + 1);
        if (write_field(argv[1], name, &wide, 250, 1, 2, 5 + 31 * i) != 0)
            return 1;
    }
    if (write_field(argv[1], "road.gsf", &road, 160, 160, 40, 60) != 0)
        return 1;
    return write_field(argv[1], "place-1.gsf", &wide, 112, 112, 5, 9) ||
           write_field(argv[1], "place-2.gsf", &wide, 112, 112, 130, 131) ||
           write_field(argv[1], "near-by.gsf", &narrow, 112, 112, 40, 60);
}
