/* Makes the height maps of fixtures/surface: two places of a random surface with a spectrum that is
 * known, one of it in a smaller window and profiles, as Gwyddion Simple Field.
 * Usage: generate_surface FOLDER. SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/made_surface.h"

#include <stdio.h>

/* Of a ground steel or fine asphalt: 1 um rms, waves down to two points. */
static const made_surface wide = {256, 200e-6, 21, 126, 6e-26, 6e5, 0.8, 0, true, 0};
/* Of the bundled case: a road of 40 um rms. */
static const made_surface road = {256, 6.4e-3, 23, 126, 2e-17, 4e3, 0.8, 0, true, 0};
static const made_surface narrow = {256, 20e-6, 22, 126, 6e-26, 6e5, 0.8, 0, true, 0};

static int write_field(const char *folder, const char *name, const made_surface *s, size_t n,
                       size_t rows, size_t x, size_t y)
{
    char path[1024];
    double *z = make_surface(s);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *out = fopen(path, "wb");
    if (out == NULL)
        return 1;
    const double step = s->length / (double)s->n;
    const int head = fprintf(out,
                             "Gwyddion Simple Field 1.0\nXRes = %zu\nYRes = %zu\nXReal = %.9g\n"
                             "YReal = %.9g\nXYUnits = m\nZUnits = m\nTitle = height\n",
                             n, rows, step * (double)n, step * (double)rows);
    for (int i = head; i == head || i % 4 != 0; i++)
        putc(0, out);
    for (size_t j = 0; j < rows; j++)
        for (size_t i = 0; i < n; i++) {
            const float value = (float)z[(y + j) * s->n + x + i];
            if (fwrite(&value, sizeof value, 1, out) != 1)
                return 1;
        }
    free(z);
    return fclose(out) != 0;
}

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
