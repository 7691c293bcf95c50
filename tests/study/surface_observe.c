/* Measured surfaces: waves with exponentially distributed squared amplitudes and random phases. The
 * scans are parts of larger surfaces.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface_observe.h"
#include "surface_scene.h"

#include "synthetic_surface.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 112, LINE = 250, MOST_SCANS = 10 };
static const double side = 200e-6;

static const facts *scene_facts(int scene)
{
    return &surface_scenes[scene].facts;
}

static void *prepare(int scene)
{
    (void)scene;
    return NULL;
}

static synthetic_surface surface_of(const surface_scene *s, random_source *random, double length)
{
    const double roll_off = s->roll_off > 0 ? s->roll_off : 6e5,
                 hurst = s->hurst > 0 ? s->hurst : 0.8;
    /* The power law is the same for every roll-off. */
    const double c0 = 1e-25 * pow(roll_off / 6e5, -2 * (1 + hurst));
    return (synthetic_surface){.n = 256,
                               .length = length,
                               .seed = (uint64_t)(random_uniform(random) * 0x1p52),
                               .modes = 126,
                               .c0 = c0,
                               .roll_off = roll_off,
                               .hurst = hurst,
                               .stretch = s->stretch,
                               .texture = s->texture,
                               .exponential = true};
}

/* Writes a part of it as Gwyddion Simple Field. */
static int write_scan(const surface_scene *s, const synthetic_surface *surface,
                      random_source *random, const char *path)
{
    const size_t nx = s->profiles > 0 ? LINE : POINTS, ny = s->profiles > 0 ? 1 : POINTS;
    const double step = surface->length / (double)surface->n;
    double *z = surface_create(surface), square = 0;
    FILE *out = fopen(path, "wb");
    if (out == NULL) {
        free(z);
        return -1;
    }
    for (size_t i = 0; i < surface->n * surface->n; i++)
        square += z[i] * z[i];
    const double form = s->form * sqrt(square) / (double)surface->n;
    const int head = fprintf(out,
                             "Gwyddion Simple Field 1.0\nXRes = %zu\nYRes = %zu\nXReal = %.9g\n"
                             "YReal = %.9g\nXYUnits = m\nZUnits = m\n",
                             nx, ny, step * (double)nx, step * (double)ny);
    for (int i = head; i == head || i % 4 != 0; i++)
        (void)fputc(0, out);
    for (size_t j = ny; j-- > 0;) /* the top line first */
        for (size_t i = 0; i < nx; i++) {
            const double x = (double)i / (double)nx - 0.5, y = (double)j / (double)ny - 0.5;
            const double height = z[(j + 7) * surface->n + i + 3] + form * (3 * x * x + x - 2 * y);
            const bool removed = s->missing > 0 && random_uniform(random) < s->missing;
            const float value = removed ? (float)NAN : (float)height;
            (void)fwrite(&value, sizeof value, 1, out);
        }
    free(z);
    const int bad = ferror(out);
    return fclose(out) != 0 || bad ? -1 : 0;
}

/* Square root of 2 pi int C q^power dq over the rows. */
static double true_rms(const synthetic_surface *truth, double first, double last, double power)
{
    enum { STEPS = 4000 }; /* step of ln q; the law is smooth except for its roll-off */
    const double step = log(last / first) / STEPS;
    double sum = 0;
    for (int i = 0; i <= STEPS; i++) {
        const double q = first * exp(step * i), weight = i == 0 || i == STEPS ? 0.5 : 1;
        sum += weight * surface_density(truth, q) * pow(q, power + 1) * step;
    }
    return sqrt(2 * M_PI * sum);
}

static void read_spectrum(const char *path, const surface_scene *s, const synthetic_surface *truth,
                          scene_draw *t)
{
    stream *found = stream_read(path);
    const int n = found != NULL ? stream_rows(found, place_density.table) : 0;
    if (n < 1)
        scene_draw_broke(t, "no spectrum of a surface");
    for (int i = 0; i < n; i++) {
        const bool by_law =
            stream_is(found, place_density.table, PLACE_SOURCE, i, PLACE_BY_LAW) != 0;
        if (by_law && i + 1 < n)
            continue; /* the errors of all rows of the law are correlated; the last row is tested */
        scene_draw_add(
            t, by_law ? Q_BEYOND : Q_DENSITY,
            surface_density(truth, stream_cell(found, place_density.table, PLACE_WAVENUMBER, i)),
            place_row(found, &place_density, i));
    }
    if (n > 0) {
        const double first = stream_cell(found, place_density.table, PLACE_WAVENUMBER, 0),
                     last = stream_cell(found, place_density.table, PLACE_WAVENUMBER, n - 1);
        scene_draw_add(t, Q_RMS_HEIGHT, true_rms(truth, first, last, 1),
                       place_key(found, &place_rms_height));
        scene_draw_add(t, Q_RMS_SLOPE, true_rms(truth, first, last, 3),
                       place_key(found, &place_rms_slope));
        scene_draw_add(t, Q_HURST, truth->hurst, place_key(found, &place_hurst));
        /* profiles have too few bins for a roll-off */
        if (!(s->roll_off > 0) && s->profiles == 0) {
            scene_draw_add(t, Q_ROLL_OFF, truth->roll_off, place_key(found, &place_roll_off));
            scene_draw_add(t, Q_C0, truth->c0, place_key(found, &place_c0));
        }
    }
    if (n > 0 && s->stretch > 0) {
        scene_draw_add(t, Q_ANISOTROPY, s->stretch, place_key(found, &place_anisotropy));
        scene_draw_add(t, Q_TEXTURE, s->texture, place_key(found, &place_texture));
    }
    stream_free(found);
}

static void observe(int scene, const void *prepared, random_source *random, scene_draw *t)
{
    const surface_scene *s = &surface_scenes[scene];
    const char *made = scene_draw_file(t, "spectrum.tsv");
    const char *arguments[MOST_SCANS + 7] = {"psd", "-o", made, "--no-provenance"};
    const int wide = s->profiles > 0 ? s->profiles
                     : s->places > 0 ? s->places
                                     : 1,
              near_by = wide + s->near_by, all = near_by + s->nearest;
    const double smaller = s->smaller > 0 ? s->smaller : 10;
    synthetic_surface truth = surface_of(s, random, side);
    (void)prepared;
    for (int i = 0; i < all; i++) {
        char name[24];
        synthetic_surface here = surface_of(s, random,
                                            i < wide      ? side
                                            : i < near_by ? side / smaller
                                                          : side / (smaller * smaller));
        here.c0 *= exp(s->scatter * random_normal(random));
        snprintf(name, sizeof name, "scan%d.gsf", i + 1);
        arguments[4 + i] = scene_draw_file(t, name);
        if (write_scan(s, &here, random, arguments[4 + i]) != 0) {
            scene_draw_broke(t, "the scan cannot be written");
            return;
        }
    }
    char end[32];
    snprintf(end, sizeof end, "%grad/m", s->end);
    if (s->end > 0) {
        arguments[4 + all] = "--end";
        arguments[5 + all] = end;
    }
    if (scene_draw_run(t, arguments))
        read_spectrum(made, s, &truth, t);
}

family surface_family(void)
{
    return (family){
        .n = n_surface_scenes, .facts = scene_facts, .prepare = prepare, .observe = observe};
}
