/* Writes a reproducible running-in with known truth: write_growth FOLDER creates case.xml,
 * record.csv and truth.txt.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "growth_sample.h"

#include <stdio.h>

static bool write_truth(const growth_made *m, const char *path)
{
    FILE *out = fopen(path, "w");
    if (out == NULL)
        return false;
    fprintf(
        out,
        "specific wear rate %.4g m^2/N\ncritical energy %.4g J/m^3\nfriction is steady, to 5 %% "
        "of its change, after %.4g s\nfriction %.4g without a layer, %.4g in the end\n",
        m->truth.wear_rate, m->truth.critical_energy, m->growth.settled, m->growth.start,
        m->growth.end);
    return ferror(out) == 0 && fclose(out) == 0;
}

int main(int argc, char **argv)
{
    static const growth_scene scene = {.of_inputs = 0.03,
                                       .of_layer = 0.05,
                                       .of_ratio = 0.03,
                                       .laps = 400,
                                       .samples = 2,
                                       .weighed = 0.05};
    char path[3][1024];
    growth_made m;
    random_source random = random_for(1, "fixture", 0);
    if (argc != 2)
        return 2;
    snprintf(path[0], sizeof path[0], "%s/case.xml", argv[1]);
    snprintf(path[1], sizeof path[1], "%s/record.csv", argv[1]);
    snprintf(path[2], sizeof path[2], "%s/truth.txt", argv[1]);
    return growth_make(&scene, &random, &m) && growth_write_case(&scene, &m, path[0]) &&
                   growth_write_record(&scene, &m, path[1], &random) && write_truth(&m, path[2])
               ? 0
               : 1;
}
