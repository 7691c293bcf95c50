/* Surfaces under a tip, written out as height images: what the tests of spots share.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_SPOT_SCENE_H
#define WT_TESTS_SPOT_SCENE_H

#include "truth.h"

#include "indentation/numerics/height_image.h"
#include "weartrack/indentation.h"
#include "writers/nid_writer.h"

enum { N = 128, WAVES = 40 };
#define WIDTH 1e-6
#define STEP (WIDTH / (N - 1))
#define DEPTH 70e-9
#define CONTACT (2 / M_PI * 0.7002075382097097 * DEPTH) /* of a cone of 35 degrees: 2/pi tan 35 */

static char before[] = "/tmp/weartrack-before-XXXXXX", after[] = "/tmp/weartrack-after-XXXXXX";
static wt_formats *formats;

typedef struct surface {
    double amplitude[WAVES], qx[WAVES], qy[WAVES], phase[WAVES];
    int n;
    double tilt_x, tilt_y;
    double x, y, dent;  /* a Gaussian of half the contact radius */
    double noise, rows; /* of a pixel; of a whole line, which scanning adds */
} surface;

/* What is at p lies at p + shift + strain p in the image. */
typedef struct view {
    size_t n;
    double width, shift_x, shift_y, strain;
} view;
static const view whole = {N, WIDTH, 0, 0, 0};

static inline double uniform(uint64_t *state)
{
    return 0.5 * erfc(truth_normal(state) / M_SQRT2);
}

/* Waves of 60 to 400 nm, 1.5 nm rms together. */
static inline surface random_surface(uint64_t *state)
{
    surface s = {.n = WAVES, .tilt_x = 0.02, .tilt_y = -0.03, .noise = 0.05e-9};
    for (int i = 0; i < WAVES; i++) {
        const double q = 2 * M_PI / (60e-9 * pow(400.0 / 60, uniform(state))),
                     way = 2 * M_PI * uniform(state);
        s.amplitude[i] = 1.5e-9 * sqrt(2.0 / WAVES);
        s.qx[i] = q * cos(way);
        s.qy[i] = q * sin(way);
        s.phase[i] = 2 * M_PI * uniform(state);
    }
    return s;
}

/* The waves are products of what the columns and the lines have. */
static inline void add_wave(const surface *s, int wave, const double *x, const double *y, size_t n,
                            double *z)
{
    static double of_x[2][N], of_y[2][N];
    for (size_t i = 0; i < n; i++) {
        of_x[0][i] = cos(s->qx[wave] * x[i] + s->phase[wave]);
        of_x[1][i] = sin(s->qx[wave] * x[i] + s->phase[wave]);
        of_y[0][i] = s->amplitude[wave] * cos(s->qy[wave] * y[i]);
        of_y[1][i] = s->amplitude[wave] * sin(s->qy[wave] * y[i]);
    }
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++)
            z[j * n + i] += of_x[0][i] * of_y[0][j] - of_x[1][i] * of_y[1][j];
}

static inline void make_heights(const surface *s, const view *v, uint64_t *state, double *z)
{
    static double x[N], y[N];
    const size_t n = v->n;
    for (size_t i = 0; i < n; i++) {
        x[i] = ((double)i * v->width / (double)(n - 1) - v->shift_x) / (1 + v->strain);
        y[i] = ((double)i * v->width / (double)(n - 1) - v->shift_y) / (1 + v->strain);
    }
    for (size_t j = 0; j < n; j++) {
        const double row = s->rows * truth_normal(state);
        for (size_t i = 0; i < n; i++) {
            const double r = hypot(x[i] - s->x, y[j] - s->y) / (0.5 * CONTACT);
            z[j * n + i] = s->tilt_x * x[i] + s->tilt_y * y[j] - s->dent * exp(-0.5 * r * r) + row +
                           s->noise * truth_normal(state);
        }
    }
    for (int wave = 0; wave < s->n; wave++)
        add_wave(s, wave, x, y, n, z);
}

static inline void write_heights(const char *path, const double *z, const view *v)
{
    const size_t n = v->n;
    const nid_writer_channel channel = {1, "Z-Axis", "m", -1e-6, 2e-6, 32, z};
    const nid_writer_group group = {"Scan forward", n,   n,        0,        NULL, "X*",    "m",
                                    "Y*",           "m", v->width, v->width, 1,    &channel};
    nid_writer_file file = nid_writer_defaults();
    file.path = path;
    file.n_groups = 1;
    file.groups = &group;
    assert_int_equal(nid_write(&file), 0);
}

static inline void write_image(const char *path, const surface *s, const view *v, uint64_t *state)
{
    static double z[N * N];
    make_heights(s, v, state, z);
    write_heights(path, z, v);
}

static inline wt_spot_job job_of(double depth)
{
    wt_spot_job job = wt_spot_job_defaults();
    assert_int_equal(wt_tip_parse("cone:half-angle=35deg", &job.tip, NULL), WT_OK);
    job.depth = depth;
    return job;
}

static inline wt_table *make(const wt_spot_job *job)
{
    wt_job common = wt_job_defaults();
    wt_error err = WT_ERROR_INIT;
    wt_spot_tables tables = {0};
    common.formats = formats;
    if (wt_spot_compute(job, before, &common, &tables, &err) != WT_OK)
        fail_msg("%s %s", err.message, err.found);
    assert_null(tables.spot_map);
    return tables.spot;
}

/* Of a Gaussian of depth d and width s: mean within a, volume within 2 a. */
static inline double dent_depth(double d)
{
    const double s = 0.5 * CONTACT, a = CONTACT;
    return d * 2 * s * s / (a * a) * (1 - exp(-a * a / (2 * s * s)));
}

static inline double dent_volume(double d)
{
    const double s = 0.5 * CONTACT, a = 2 * CONTACT;
    return d * 2 * M_PI * s * s * (1 - exp(-a * a / (2 * s * s)));
}

static inline int begin(void **state)
{
    (void)state;
    const int files[] = {mkstemp(before), mkstemp(after)};
    for (int i = 0; i < 2; i++)
        if (files[i] < 0 || close(files[i]) != 0)
            return -1;
    return wt_formats_new(NULL, &formats, NULL, NULL) == WT_OK ? 0 : -1;
}

static inline int end(void **state)
{
    (void)state;
    wt_formats_free(formats);
    (void)unlink(before);
    (void)unlink(after);
    return 0;
}

#endif
