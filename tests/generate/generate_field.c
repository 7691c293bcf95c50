/* A part of a synthetic surface as Gwyddion Simple Field.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "generate_field.h"

#include <stdio.h>

int write_field(const char *folder, const char *name, const synthetic_surface *s, size_t n,
                size_t rows, size_t x, size_t y)
{
    char path[1024];
    double *z = surface_create(s);
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
