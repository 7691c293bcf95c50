/* Writes maps of force curves, one for each way in which a file contains many curves. The writers
 * are independent of the library.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "big_map_files.h"
#include "writers/curve_hdf5_writer.h"
#include "writers/ibw_writer.h"
#include "writers/jpk_writer.h"
#include "writers/nanoscope_writer.h"
#include "writers/nid_writer.h"
#include "writers/park_writer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { KINDS = 64 };

static const double modulus = MAP_MODULUS, radius = 1e-6, contact = 0.6e-6, spring_constant = 2;

static double height[2][KINDS][MOST_SAMPLES], force[2][KINDS][MOST_SAMPLES];
static double noise(void)
{
    static unsigned long long state = 2026;
    double sum = 0;
    for (int i = 0; i < 12; i++) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        sum += (double)(state >> 11) / 9007199254740992.0;
    }
    return sum - 6;
}

/* Curves of a paraboloid on a half space. */
void make_kinds(size_t n)
{
    for (size_t c = 0; c < KINDS; c++)
        for (size_t way = 0; way < 2; way++)
            for (size_t i = 0; i < n; i++) {
                const double at = (double)(way == 0 ? i : n - 1 - i) / (double)(n - 1);
                const double position = 1e-6 * at, depth = fmax(position - contact, 0);
                const double pushed = 4. / 3 * modulus / 0.75 * sqrt(radius) * pow(depth, 1.5);
                force[way][c][i] = pushed + 1e-9 * noise();
                height[way][c][i] = -(position + pushed / spring_constant);
            }
}

void write_map(size_t n, size_t samples)
{
    static jpk_writer_segment segments[KINDS][2];
    jpk_writer_curve *const curves = calloc(n, sizeof *curves);
    jpk_writer_file file = jpk_writer_defaults();
    const long side = (long)ceil(sqrt((double)n));
    if (curves == NULL)
        abort();
    for (size_t i = 0; i < 2 * (size_t)KINDS; i++)
        segments[i / 2][i % 2] = (jpk_writer_segment){.style = i % 2 == 0 ? "extend" : "retract",
                                                      .n = samples,
                                                      .duration = 0.5,
                                                      .height = height[i % 2][i / 2],
                                                      .force = force[i % 2][i / 2]};
    for (size_t i = 0; i < n; i++)
        curves[i] = (jpk_writer_curve){i, 1e-6 * (double)(i % (size_t)side),
                                       1e-6 * (double)(i / (size_t)side), 2, segments[i % KINDS]};
    file.path = "map.jpk-force-map";
    file.map = true;
    file.n_curves = n;
    file.curves = curves;
    file.columns = file.rows = side;
    file.spring_constant = spring_constant;
    file.sensitivity = 60e-9;
    file.stored = true;
    if (jpk_write(&file) != 0)
        abort();
    free(curves);
}

/* Returns the values of all curves: approach and retract one after the other, or only the segment
 * `way`. */
static double *all_values(size_t n, size_t samples, int way,
                          double value(size_t kind, size_t way, size_t i, size_t samples))
{
    const size_t ways = way < 0 ? 2 : 1;
    double *const values = calloc(n * ways * samples, sizeof *values);
    if (values == NULL)
        abort();
    for (size_t c = 0, at = 0; c < n; c++)
        for (size_t w = 0; w < ways; w++)
            for (size_t i = 0; i < samples; i++)
                values[at++] = value(c % KINDS, way < 0 ? w : (size_t)way, i, samples);
    return values;
}

static double height_of(size_t kind, size_t way, size_t i, size_t samples)
{
    (void)samples;
    return height[way][kind][i];
}

static double force_of(size_t kind, size_t way, size_t i, size_t samples)
{
    (void)samples;
    return force[way][kind][i];
}

/* The piezo moves at a constant rate, not the tip. Bisection finds the depth at which the
 * cantilever is in equilibrium; noise is added. */
static double volts_of(size_t kind, size_t way, size_t i, size_t samples)
{
    const double at = (double)(way == 0 ? i + 1 : samples - i) / (double)samples;
    const double pressed = 1e-6 * at - contact;
    double low = 0, high = fmax(pressed, 0);
    for (int k = 0; k < 60; k++) {
        const double depth = (low + high) / 2;
        const double pushed = 4. / 3 * modulus / 0.75 * sqrt(radius) * pow(depth, 1.5);
        *(depth + pushed / spring_constant < pressed ? &low : &high) = depth;
    }
    const double still = force[0][kind][i * 37 % (samples / 2)];
    return (fmax(pressed, 0) - low + still / spring_constant) / 60e-9;
}

/* Version 3 states the `lengths` of the lines. */
static void write_nid(size_t n, size_t samples, const size_t *lengths)
{
    static const char *const names[] = {"Spec forward", "Spec backward"};
    nid_writer_channel channels[2][2];
    nid_writer_group groups[2];
    nid_writer_file nid = nid_writer_defaults();
    for (int way = 0; way < 2; way++) {
        channels[way][0] = (nid_writer_channel){
            0, "Deflection", "N", -1e-5, 2e-5, 32, all_values(n, samples, way, force_of)};
        channels[way][1] = (nid_writer_channel){
            1, "Z-Axis", "m", -1e-5, 2e-5, 32, all_values(n, samples, way, height_of)};
        groups[way] = (nid_writer_group){.name = names[way],
                                         .points = samples,
                                         .lines = n,
                                         .line_points = lengths,
                                         .x_name = "Z",
                                         .x_unit = "m",
                                         .y_name = "Curve",
                                         .y_unit = "",
                                         .x_range = 1e-6,
                                         .y_range = 1,
                                         .n_channels = 2,
                                         .channels = channels[way]};
    }
    nid.path = "map.nid";
    nid.n_groups = 2;
    nid.groups = groups;
    nid.spring_constant = spring_constant;
    nid.forward_time = nid.backward_time = 0.5;
    nid.forward_points = nid.backward_points = samples;
    nid.forward_range = 1e-6;
    if (nid_write(&nid) != 0)
        abort();
    for (size_t i = 0; i < 4; i++)
        free((void *)channels[i / 2][i % 2].values);
}

void write_blocks(size_t n, size_t samples)
{
    double *const volts = all_values(n, samples, -1, volts_of);
    const nanoscope_writer_channel channel = {"Deflection Error", "Sens. DeflSens", 3e-4, volts};
    const nanoscope_writer_file spm = {.path = "map.spm",
                                       .volume = true,
                                       .side = (size_t)lrint(sqrt((double)n)),
                                       .n_in = samples,
                                       .n_out = samples,
                                       .width = 4,
                                       .ramp_volts = 100,
                                       .z_sensitivity = 10,
                                       .deflection_sensitivity = 60,
                                       .spring_constant = spring_constant,
                                       .rate = 200,
                                       .n_channels = 1,
                                       .channels = &channel};
    if (nanoscope_write(&spm) != 0)
        abort();
    free(volts);
    write_nid(n, samples, NULL);
}

void write_lines(size_t n, size_t samples)
{
    size_t *const lengths = calloc(n, sizeof *lengths);
    if (lengths == NULL)
        abort();
    for (size_t i = 0; i < n; i++)
        lengths[i] = samples;
    write_nid(n, samples, lengths);
    free(lengths);
}

/* ---- Nanosurf Studio ------------------------------------------------------------------------ */

static void write_studio(size_t n, size_t samples, int version)
{
    static const char *const names[] = {"Advance to Setpoint 1", "Retract 1"};
    nhf_writer_channel channels[2][2];
    nhf_writer_segment segments[2];
    int *const sizes = calloc(n, sizeof *sizes);
    double *const places = calloc(n, sizeof *places);
    if (sizes == NULL || places == NULL)
        abort();
    for (size_t i = 0; i < n; i++) {
        sizes[i] = (int)samples;
        places[i] = 1e-9 * (double)i;
    }
    for (int way = 0; way < 2; way++) {
        channels[way][0] = (nhf_writer_channel){"Deflection", "Newton (N)", -1e-5, 1e-5,
                                                all_values(n, samples, way, force_of)};
        channels[way][1] = (nhf_writer_channel){"Position Z", "m", -1e-5, 1e-5,
                                                all_values(n, samples, way, height_of)};
        segments[way] = (nhf_writer_segment){names[way], sizes, 2, channels[way]};
    }
    const nhf_writer_file file = {.path = "map.nhf",
                                  .version = version,
                                  .type = version == 1 ? "spectroscopy_grid" : "spectroscopy",
                                  .n_curves = n,
                                  .n_segments = 2,
                                  .segments = segments,
                                  .spring_constant = spring_constant,
                                  .sensitivity = 60e-9,
                                  .x = places,
                                  .y = places};
    if (nhf_write(&file) != 0)
        abort();
    for (size_t i = 0; i < 4; i++)
        free((void *)channels[i / 2][i % 2].values);
    free(sizes);
    free(places);
}

void write_studio_1(size_t n, size_t samples)
{
    write_studio(n, samples, 1);
}

void write_studio_2(size_t n, size_t samples)
{
    write_studio(n, samples, 2);
}

/* ---- Park ----------------------------------------------------------------------------------- */

static double microseconds_of(size_t kind, size_t way, size_t i, size_t samples)
{
    (void)kind;
    return 1e3 * (double)(1 + way * samples + i);
}

void write_park(size_t n, size_t samples)
{
    const park_writer_channel channels[] = {
        {"Force", "N", 1, all_values(n, samples, -1, force_of)},
        {"Z Scan", "m", 1, all_values(n, samples, -1, height_of)},
        {"Time Stamp", "usec", 1, all_values(n, samples, -1, microseconds_of)}};
    const park_writer_file file = {.path = "map.tiff",
                                   .n_curves = n,
                                   .n_samples = 2 * samples,
                                   .n_channels = 3,
                                   .channels = channels};
    if (park_write(&file) != 0)
        abort();
    for (size_t i = 0; i < 3; i++)
        free((void *)channels[i].values);
}

/* ---- one file for each curve ---------------------------------------------------------------- */

/* Writes a folder of waves. */
void write_waves(size_t n, size_t samples)
{
    static const char *const labels[] = {"Raw", "Defl"};
    double *const heights = all_values(n, samples, -1, height_of);
    double *const bent = all_values(n, samples, -1, force_of);
    if (mkdir("map.waves", 0777) != 0 && access("map.waves", W_OK) != 0)
        abort();
    for (size_t i = 0; i < 2 * samples * n; i++) {
        heights[i] = -heights[i]; /* towards the sample */
        /* Files with the same samples count once, so each has a different baseline. */
        bent[i] = bent[i] / spring_constant + 1e-12 * (double)(i / (2 * samples));
    }
    for (size_t i = 0; i < n; i++) {
        char path[64], note[256];
        const double *const values[] = {heights + 2 * samples * i, bent + 2 * samples * i};
        (void)snprintf(path, sizeof path, "map.waves/Curve%05zu.ibw", i);
        (void)snprintf(note, sizeof note,
                       "SpringConstant: %g\rInvOLS: 6e-08\rXLVDT: %g\rYLVDT: 0\r"
                       "Indexes: 0,%zu,%zu\rDirection: NaN,1,-1,\r",
                       spring_constant, 1e-9 * (double)i, samples, 2 * samples - 1);
        const ibw_writer_file file = {.path = path,
                                      .n = 2 * samples,
                                      .n_channels = 2,
                                      .labels = labels,
                                      .values = values,
                                      .interval = 1e-3,
                                      .note = note};
        if (ibw_write(&file) != 0)
            abort();
    }
    free(heights);
    free(bent);
}
