/* Writer of JPK force files for tests and fixtures.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "writers/jpk_writer.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zip.h>

/* Piezo of this instrument: volts to nominal metres, then a correction. */
#define NOMINAL_OFFSET 1.5e-5
#define NOMINAL_MULTIPLIER (-1.3125e-7)
#define CALIBRATED_MULTIPLIER 0.75
/* Sensor: absolute to nominal metres. */
#define SENSOR_OFFSET 2.5e-5

#define N_CHANNELS 3
enum channel { HEIGHT, DEFLECTION, SENSOR };
static const char *const channel_names[N_CHANNELS] = {"height", "vDeflection", "measuredHeight"};
static const char *const styles[] = {"extend", "retract", "pause", "modulation"};
#define N_STYLES 4

/* raw = (value - offset) / multiplier */
typedef struct encoder {
    double offset, multiplier;
} encoder;

typedef struct writer {
    const jpk_writer_file *file;
    zip_t *zip;
    encoder encoders[N_CHANNELS];
} writer;

jpk_writer_file jpk_writer_defaults(void)
{
    return (jpk_writer_file){.spring_constant = (double)NAN,
                             .sensitivity = (double)NAN,
                             .setpoint = (double)NAN,
                             .encoding = JPK_WRITE_INT32};
}

/* ---- from SI to what the channel stores --------------------------------------------------- */

static const double *channel_values(const jpk_writer_segment *s, enum channel c)
{
    return c == HEIGHT ? s->height : c == DEFLECTION ? s->force : s->measured_height;
}

static double volts_per_newton(const jpk_writer_file *file)
{
    double metres = isnan(file->spring_constant) ? 1 : 1 / file->spring_constant;
    return isnan(file->sensitivity) ? 1 : metres / file->sensitivity;
}

static double to_base(const jpk_writer_file *file, enum channel c, double value)
{
    if (c == HEIGHT)
        return (value / CALIBRATED_MULTIPLIER - NOMINAL_OFFSET) / NOMINAL_MULTIPLIER;
    if (c == DEFLECTION)
        return value * volts_per_newton(file);
    return value - SENSOR_OFFSET;
}

static double raw_limit(const jpk_writer_file *file)
{
    return file->encoding == JPK_WRITE_INT16 ? 32767 : 2147483647;
}

/* Encoder that uses the whole range of the integers. */
static encoder make_encoder(const jpk_writer_file *file, enum channel c)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    if (file->encoding == JPK_WRITE_FLOAT || file->encoding == JPK_WRITE_DOUBLE)
        return (encoder){0, 1};
    for (size_t i = 0; i < file->n_curves; i++) {
        for (size_t k = 0; k < file->curves[i].n_segments; k++) {
            const jpk_writer_segment *s = &file->curves[i].segments[k];
            const double *values = channel_values(s, c);
            for (size_t j = 0; values != NULL && j < s->n; j++) {
                double base = to_base(file, c, values[j]);
                low = fmin(low, base);
                high = fmax(high, base);
            }
        }
    }
    if (!(high > low))
        return (encoder){isfinite(low) ? low : 0, 1};
    return (encoder){low + (high - low) / 2, (high - low) / (2 * raw_limit(file))};
}

static double half_step(const jpk_writer_file *file, enum channel c)
{
    bool whole = file->encoding == JPK_WRITE_INT16 || file->encoding == JPK_WRITE_INT32;
    return whole ? make_encoder(file, c).multiplier / 2 : 0;
}

double jpk_writer_height_step(const jpk_writer_file *file)
{
    return half_step(file, HEIGHT) * fabs(NOMINAL_MULTIPLIER * CALIBRATED_MULTIPLIER);
}

double jpk_writer_force_step(const jpk_writer_file *file)
{
    return half_step(file, DEFLECTION) / volts_per_newton(file);
}

static void put_big_endian(unsigned char *to, uint64_t bits, size_t width)
{
    for (size_t i = 0; i < width; i++)
        to[i] = (unsigned char)(bits >> (8 * (width - 1 - i)) & 0xff);
}

static size_t sample_width(const jpk_writer_file *file)
{
    return file->encoding == JPK_WRITE_INT16 ? 2 : file->encoding == JPK_WRITE_DOUBLE ? 8 : 4;
}

static void put_sample(const writer *w, enum channel c, double value, unsigned char *to)
{
    double base = to_base(w->file, c, value);
    if (w->file->encoding == JPK_WRITE_DOUBLE) {
        uint64_t bits;
        memcpy(&bits, &base, sizeof bits);
        put_big_endian(to, bits, 8);
    } else if (w->file->encoding == JPK_WRITE_FLOAT) {
        float single = (float)base;
        uint32_t bits;
        memcpy(&bits, &single, sizeof bits);
        put_big_endian(to, bits, 4);
    } else {
        double raw = round((base - w->encoders[c].offset) / w->encoders[c].multiplier);
        double limit = raw_limit(w->file);
        raw = fmax(-limit, fmin(limit, raw));
        put_big_endian(to, (uint64_t)(int64_t)raw, sample_width(w->file));
    }
}

/* ---- entries ------------------------------------------------------------------------------ */

/* Takes ownership of the data. All entries have the same time, so that the file does not depend on
 * the date. */
static int add_entry(const writer *w, const char *name, void *data, size_t size)
{
    zip_source_t *source = zip_source_buffer(w->zip, data, size, 1);
    if (source == NULL) {
        free(data);
        return -1;
    }
    zip_int64_t i = zip_file_add(w->zip, name, source, 0);
    if (i < 0) {
        zip_source_free(source);
        return -1;
    }
    if (w->file->stored && zip_set_file_compression(w->zip, (zip_uint64_t)i, ZIP_CM_STORE, 0) != 0)
        return -1;
    return zip_file_set_dostime(w->zip, (zip_uint64_t)i, 0, 0x5021, 0);
}

static int add_folder(const writer *w, const char *name)
{
    zip_int64_t i = w->file->folders ? zip_dir_add(w->zip, name, 0) : 0;
    if (w->file->folders && i >= 0)
        return zip_file_set_dostime(w->zip, (zip_uint64_t)i, 0, 0x5021, 0);
    return i < 0 ? -1 : 0;
}

typedef struct text {
    char *data;
    size_t size;
    FILE *out;
} text;

static int text_open(text *t)
{
    *t = (text){0};
    t->out = open_memstream(&t->data, &t->size);
    return t->out == NULL ? -1 : fputs("#Tue Jan 01 00:00:00 UTC 2030\n", t->out) < 0 ? -1 : 0;
}

static int text_add(const writer *w, text *t, const char *name)
{
    return fclose(t->out) == 0 ? add_entry(w, name, t->data, t->size) : -1;
}

/* ---- headers ------------------------------------------------------------------------------ */

static void put_unit(FILE *out, const char *prefix, const char *unit)
{
    fprintf(out, "%sunit.type=metric-unit\n%sunit.unit=%s\n", prefix, prefix, unit);
}

static void put_scaling(FILE *out, const char *prefix, double offset, double multiplier,
                        const char *unit)
{
    fprintf(out, "%sscaling.type=linear\n%sscaling.style=offsetmultiplier\n", prefix, prefix);
    fprintf(out, "%sscaling.offset=%.17g\n%sscaling.multiplier=%.17g\n", prefix, offset, prefix,
            multiplier);
    fprintf(out, "%sscaling.unit.type=metric-unit\n%sscaling.unit.unit=%s\n", prefix, prefix, unit);
}

static void put_slot(FILE *out, const char *prefix, const char *name, const char *base,
                     double offset, double multiplier, const char *unit)
{
    char inner[160];
    snprintf(inner, sizeof inner, "%sconversion-set.conversion.%s.", prefix, name);
    fprintf(out, "%sname=%s\n", inner, name);
    if (base == NULL || isnan(multiplier)) {
        fprintf(out, "%sdefined=false\n", inner);
        return;
    }
    fprintf(out, "%sdefined=true\n%stype=simple\n%scomment=\n", inner, inner, inner);
    fprintf(out, "%sbase-calibration-slot=%s\n%scalibration-slot=%s\n", inner, base, inner, name);
    put_scaling(out, inner, offset, multiplier, unit);
}

static void put_slots(FILE *out, const char *prefix, const char *list, const char *preferred,
                      const char *base)
{
    fprintf(out, "%sconversion-set.conversions.list=%s\n", prefix, list);
    fprintf(out, "%sconversion-set.conversions.default=%s\n", prefix, preferred);
    fprintf(out, "%sconversion-set.conversions.base=%s\n", prefix, base);
    put_slot(out, prefix, base, NULL, 0, 0, NULL);
}

/* Encoding and calibration of a channel. */
static void put_channel(const writer *w, FILE *out, const char *prefix, enum channel c)
{
    static const char *const types[] = {"integer-data", "short-data", "float-data", "double-data"};
    static const char *const encoders[] = {"signedinteger", "signedshort", NULL, NULL};
    const jpk_writer_file *file = w->file;
    const char *base_unit = c == SENSOR ? "m" : "V";
    char inner[160];
    fprintf(out, "%stype=%s\n%schannel.type=channel\n%schannel.name=%s\n", prefix,
            types[file->encoding], prefix, prefix, channel_names[c]);
    put_unit(out, prefix, base_unit);
    if (encoders[file->encoding] != NULL) {
        fprintf(out, "%sencoder.type=%s\n", prefix,
                file->odd_height && c == HEIGHT ? "oddinteger" : encoders[file->encoding]);
        snprintf(inner, sizeof inner, "%sencoder.", prefix);
        put_scaling(out, inner, w->encoders[c].offset, w->encoders[c].multiplier, base_unit);
    }
    if (c == HEIGHT) {
        const char *from = file->bare_height ? NULL : "volts";
        put_slots(out, prefix, "nominal calibrated", from != NULL ? "calibrated" : "volts",
                  "volts");
        put_slot(out, prefix, "nominal", from, NOMINAL_OFFSET, NOMINAL_MULTIPLIER, "m");
        put_slot(out, prefix, "calibrated", from != NULL ? "nominal" : NULL, 0,
                 CALIBRATED_MULTIPLIER, "m");
    } else if (c == DEFLECTION) {
        bool calibrated = !isnan(file->sensitivity) && !isnan(file->spring_constant);
        put_slots(out, prefix, "distance force", calibrated ? "force" : "volts", "volts");
        put_slot(out, prefix, "distance", "volts", 0, file->sensitivity, "m");
        if (file->force_from_volts)
            put_slot(out, prefix, "force", "volts", 0, file->spring_constant * file->sensitivity,
                     "N");
        else
            put_slot(out, prefix, "force", "distance", 0,
                     isnan(file->sensitivity) ? (double)NAN : file->spring_constant, "N");
    } else {
        put_slots(out, prefix, "nominal", "nominal", "absolute");
        put_slot(out, prefix, "nominal", "absolute", SENSOR_OFFSET, 1, "m");
    }
}

static size_t style_number(const char *style)
{
    size_t i = 0;
    while (i < N_STYLES - 1 && strcmp(styles[i], style) != 0)
        i++;
    return i;
}

static void put_style(const writer *w, FILE *out, const char *prefix, const char *style)
{
    fprintf(out, "%stype=spm-force-segment-header\n", prefix);
    fprintf(out, "%ssettings.style=%s\n%ssettings.segment-settings.style=%s\n", prefix, style,
            prefix, style);
    if (strcmp(style, "extend") == 0 && !isnan(w->file->setpoint))
        fprintf(out, "%ssettings.segment-settings.setpoint=%.17g\n", prefix,
                w->file->setpoint * volts_per_newton(w->file));
}

static int add_shared(const writer *w)
{
    text t;
    char prefix[64];
    if (text_open(&t) != 0)
        return -1;
    fprintf(t.out, "force-segment-header-infos.count=%d\nlcd-infos.count=%d\n", N_STYLES,
            N_CHANNELS);
    for (size_t i = 0; i < N_STYLES; i++) {
        snprintf(prefix, sizeof prefix, "force-segment-header-info.%zu.", i);
        put_style(w, t.out, prefix, styles[i]);
    }
    for (size_t c = 0; c < N_CHANNELS; c++) {
        snprintf(prefix, sizeof prefix, "lcd-info.%zu.", c);
        put_channel(w, t.out, prefix, (enum channel)c);
    }
    return text_add(w, &t, "shared-data/header.properties");
}

static int add_root(const writer *w)
{
    const jpk_writer_file *file = w->file;
    const char *type = file->map ? "force-scan-map" : "force-scan-series";
    text t;
    if (text_open(&t) != 0)
        return -1;
    fprintf(t.out, "jpk-data-file=%s\nfile-format-version=2.0\ntype=%s\n",
            file->map ? "spm-force-scan-map-file" : "spm-forcefile", type);
    fprintf(t.out, "%s.description.instrument=WT-TEST\n%s.description.source-software=writer\n",
            type, type);
    /* The colon of the time is escaped, as in files of the instrument. */
    fprintf(t.out, "%s.start-time=2030-01-01 00\\:00\\:00.000 +0000\n", type);
    if (!file->map && file->miscounted == &file->curves[0])
        fprintf(t.out, "%s.force-segments.count=%zu\n", type, file->curves[0].n_segments + 1);
    if (!file->map) {
        fprintf(t.out, "%s.header.position.x=%.17g\n%s.header.position.y=%.17g\n", type,
                file->curves[0].x, type, file->curves[0].y);
        return text_add(w, &t, "header.properties");
    }
    size_t planned = file->n_planned > 0 ? file->n_planned : file->n_curves;
    fprintf(t.out, "%s.indexes.type=range\n%s.indexes.min=0\n%s.indexes.max=%zu\n", type, type,
            type, planned - 1);
    if (file->columns > 0) {
        fprintf(t.out, "%s.position-pattern.type=grid-position-pattern\n", type);
        fprintf(t.out, "%s.position-pattern.back-and-forth=%s\n", type,
                file->back_and_forth ? "true" : "false");
        fprintf(t.out, "%s.position-pattern.grid.ilength=%ld\n", type, file->columns);
        fprintf(t.out, "%s.position-pattern.grid.jlength=%ld\n", type, file->rows);
    }
    return text_add(w, &t, "header.properties");
}

static int add_curve_header(const writer *w, const jpk_writer_curve *curve, const char *folder)
{
    text t;
    char name[128];
    if (text_open(&t) != 0)
        return -1;
    fprintf(t.out, "type=force-scan-series\nforce-scan-series.force-segments.count=%zu\n",
            curve->n_segments + (w->file->miscounted == curve));
    fprintf(t.out, "force-scan-series.header.position.x=%.17g\n", curve->x);
    fprintf(t.out, "force-scan-series.header.position.y=%.17g\n", curve->y);
    fprintf(t.out, "force-scan-series.header.position-index=%zu\n", curve->index);
    snprintf(name, sizeof name, "%sheader.properties", folder);
    return text_add(w, &t, name);
}

static int add_segment_header(const writer *w, const jpk_writer_segment *s, const char *folder)
{
    static const char own[] = "force-segment-header.";
    text t;
    char name[128], prefix[64];
    if (text_open(&t) != 0)
        return -1;
    if (w->file->inline_headers)
        put_style(w, t.out, own, s->style);
    else
        fprintf(t.out, "%sforce-segment-header-info.*=%zu\n", own, style_number(s->style));
    snprintf(name, sizeof name, "%ssegment-header.properties", folder);
    if (w->file->without_rest == s)
        return text_add(w, &t, name);
    fprintf(t.out, "%snum-points=%zu\n", own, s->n);
    if (!isnan(s->duration))
        fprintf(t.out, "%sduration=%.17g\n%ssettings.segment-settings.duration=%.17g\n", own,
                s->duration, own, s->duration);
    if (s->n > 0)
        fprintf(t.out,
                "%ssettings.segment-settings.z-start=%.17g\n"
                "%ssettings.segment-settings.z-end=%.17g\n",
                own, s->height[0], own, s->height[s->n - 1]);
    fprintf(t.out, "channels.list=height vDeflection%s",
            s->measured_height != NULL ? " measuredHeight" : "");
    for (unsigned i = 0; i < w->file->n_more; i++)
        fprintf(t.out, " more%u", i);
    fputc('\n', t.out);
    for (size_t c = 0; c < N_CHANNELS; c++) {
        if (channel_values(s, (enum channel)c) == NULL)
            continue;
        snprintf(prefix, sizeof prefix, "channel.%s.", channel_names[c]);
        if (w->file->inline_headers)
            put_channel(w, t.out, prefix, (enum channel)c);
        else
            fprintf(t.out, "%slcd-info.*=%zu\n", prefix, c);
        fprintf(t.out, "%sdata.file.name=channels/%s.dat\n%sdata.file.format=raw\n", prefix,
                channel_names[c], prefix);
        fprintf(t.out, "%sdata.num-points=%zu\n", prefix, s->n);
    }
    return text_add(w, &t, name);
}

static int add_channel_data(const writer *w, const jpk_writer_segment *s, enum channel c,
                            const char *folder)
{
    const double *values = channel_values(s, c);
    char name[128];
    size_t width = sample_width(w->file);
    if (values == NULL)
        return 0;
    unsigned char *data = malloc(s->n * width + 1);
    if (data == NULL)
        return -1;
    for (size_t i = 0; i < s->n; i++)
        put_sample(w, c, values[i], data + i * width);
    snprintf(name, sizeof name, "%schannels/%s.dat", folder, channel_names[c]);
    return add_entry(w, name, data, s->n * width);
}

static int add_curve(const writer *w, const jpk_writer_curve *curve)
{
    char folder[64] = "", inner[96];
    if (w->file->map) {
        snprintf(folder, sizeof folder, "index/%zu/", curve->index);
        if (add_folder(w, folder) != 0 || add_curve_header(w, curve, folder) != 0)
            return -1;
    }
    for (size_t i = 0; i < curve->n_segments; i++) {
        snprintf(inner, sizeof inner, "%ssegments/%zu/", folder, i);
        if (add_folder(w, inner) != 0 || add_segment_header(w, &curve->segments[i], inner) != 0)
            return -1;
        for (size_t c = 0; c < N_CHANNELS; c++)
            if (add_channel_data(w, &curve->segments[i], (enum channel)c, inner) != 0)
                return -1;
    }
    return 0;
}

int jpk_write(const jpk_writer_file *file)
{
    writer w = {.file = file};
    int error = 0;
    w.zip = zip_open(file->path, ZIP_CREATE | ZIP_TRUNCATE, &error);
    if (w.zip == NULL) {
        fprintf(stderr, "%s: cannot be written\n", file->path);
        return -1;
    }
    for (size_t c = 0; c < N_CHANNELS; c++)
        w.encoders[c] = make_encoder(file, (enum channel)c);
    int bad = add_root(&w);
    if (bad == 0 && !file->inline_headers)
        bad = add_shared(&w);
    for (size_t i = 0; i < file->n_curves && bad == 0; i++)
        bad = add_curve(&w, &file->curves[i]);
    if (bad == 0 && zip_close(w.zip) == 0)
        return 0;
    fprintf(stderr, "%s: %s\n", file->path, zip_strerror(w.zip));
    zip_discard(w.zip);
    return -1;
}
