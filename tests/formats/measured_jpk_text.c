/* Compares the text export of a JPK force curve, packed with gzip, with its own bytes. The file
 * is shared reference data; without it the exit status is 77 (skipped).
 *
 * measured_jpk_text FILE.gz
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static int failures;

static void is(const char *what, double found, double expected)
{
    if (!(fabs(found - expected) <= 1e-15 * fabs(expected))) {
        fprintf(stderr, "%s is %.17g, expected %.17g\n", what, found, expected);
        failures++;
    }
}

static double value(const wt_segment *s, wt_quantity q, size_t i)
{
    const wt_channel *c = wt_segment_channel(s, q);
    return c != NULL ? c->values[i] : (double)NAN;
}

static void check(const wt_force_curve *curve)
{
    static const size_t points[] = {1025, 20480, 1024};
    static const wt_segment_kind kinds[] = {WT_SEGMENT_APPROACH, WT_SEGMENT_DWELL,
                                            WT_SEGMENT_RETRACT};
    is("segments", (double)curve->n_segments, 3);
    for (size_t i = 0; i < 3 && i < curve->n_segments; i++) {
        is("kind", (double)curve->segments[i].kind, (double)kinds[i]);
        is("points", (double)curve->segments[i].n_points, (double)points[i]);
    }
    if (failures > 0)
        return;
    is("x", curve->x, 7.1428544015654876E-6);
    is("y", curve->y, -1.4285711261001129E-5);
    is("spring constant", curve->cantilever.spring_constant, 52.914600222226326);
    is("sensitivity", curve->cantilever.sensitivity, 2.1757005816155677E-8);
    const wt_segment *approach = &curve->segments[0], *retract = &curve->segments[2];
    is("first height", value(approach, WT_Q_HEIGHT, 0), 8.5034535E-6);
    is("first force", value(approach, WT_Q_FORCE, 0), -1.832529E-7);
    is("second force", value(approach, WT_Q_FORCE, 1), -1.8320002E-7);
    is("first measured height", value(approach, WT_Q_MEASURED_HEIGHT, 0), 8.323706E-6);
    is("first force of the pause", value(&curve->segments[1], WT_Q_FORCE, 0), 9.301572E-7);
    is("first force of retract", value(retract, WT_Q_FORCE, 0), 6.2592164E-7);
    is("second measured height of retract", value(retract, WT_Q_MEASURED_HEIGHT, 1), 6.822052E-6);
}

static char *unpack(const char *path, size_t *length)
{
    const size_t most = (size_t)8 << 20;
    char *text = malloc(most);
    gzFile in = gzopen(path, "rb");
    int n = in != NULL && text != NULL ? gzread(in, text, (unsigned)most) : -1;
    if (in != NULL)
        gzclose(in);
    if (n <= 0) {
        free(text);
        return NULL;
    }
    *length = (size_t)n;
    return text;
}

int main(int argc, char *argv[])
{
    wt_formats *formats = NULL;
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    const wt_format_info *info = NULL;
    wt_error err = WT_ERROR_INIT;
    size_t length = 0;
    char *text = argc == 2 ? unpack(argv[1], &length) : NULL;
    if (text == NULL)
        return 77;
    wt_status status = wt_formats_new(NULL, &formats, NULL, &err);
    if (status == WT_OK)
        status = wt_input_open_memory(text, length, "curve.txt", &input, &err);
    if (status == WT_OK)
        status = wt_format_detect(formats, input, NULL, 0, &info, &err);
    if (status == WT_OK && strcmp(info->id, "jpk-text") != 0)
        status = wt_fail(&err, WT_E_FORMAT, "recognised as %s", info->id);
    if (status == WT_OK)
        status = wt_force_open(formats, input, NULL, NULL, &source, &err);
    if (status == WT_OK)
        status = wt_force_next(source, &curve, &err);
    if (status == WT_OK)
        check(&curve);
    else
        fprintf(stderr, "%s: %s\n", err.place, err.message);
    wt_force_close(source);
    wt_force_curve_clear(&curve);
    wt_input_close(input);
    wt_formats_free(formats);
    free(text);
    return status == WT_OK && failures == 0 ? 0 : 1;
}
