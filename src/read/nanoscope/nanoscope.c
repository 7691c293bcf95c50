/* Reads NanoScope files: descriptor, detection, and the metadata for `info`.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/nanoscope/nanoscope.h"

#include "read/images.h"
#include "read/metadata.h"

#include <math.h>

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(nanoscope_is_header(peek->bytes, peek->length), 95);
}

static void add_identity(const nanoscope_file *f, table_writer *metadata)
{
    static const struct {
        const char *item, *section, *key;
    } known[] = {{"software version", "Force file list", "Version"},
                 {"date", "Force file list", "Date"},
                 {"instrument", "Equipment list", "Description"},
                 {"operating mode", "Ciao scan list", "Operating mode"},
                 {"trigger mode", "Ciao force list", "Trigger mode"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const char *text = nanoscope_get(
            &f->header, nanoscope_section(&f->header, known[i].section, 0), known[i].key);
        if (text != NULL && *text != '\0')
            metadata_add(metadata, known[i].item, "", known[i].key, "%s", text);
    }
}

static void add_curves(const nanoscope_file *f, const wt_read_options *options,
                       table_writer *metadata)
{
    const force_metadata read = nanoscope_metadata(f, 0);
    metadata_add(metadata, "curves", "", "Data length", "%zu", f->n_curves);
    if (f->n_curves < f->n_planned)
        metadata_add(metadata, "curves planned", "", "Data length", "%zu", f->n_planned);
    if (f->columns > 0)
        metadata_add(metadata, "grid", "", "force/line", "%ld x %ld", f->columns, f->rows);
    for (size_t s = 0; s < 3; s++) {
        char item[32];
        const force_metadata segment = nanoscope_metadata(f, s);
        snprintf(item, sizeof item, "segment %zu", segment.index);
        if (segment.n_points > 0)
            metadata_add(metadata, item, "", "Samps/line", "%s, %zu points",
                         wt_segment_kind_name(segment.kind), segment.n_points);
    }
    for (size_t i = 0; i < f->n_channels; i++) {
        const nanoscope_channel *c = &f->channels[i];
        const wt_quantity q = force_channel_quantity(&read, options, c);
        metadata_add(metadata, c->name, "", "Image Data", "%s, %u bits%s",
                     q == WT_Q_NONE ? "not read" : wt_quantity_id(q), 8 * c->width,
                     f->scaled ? ", 256 times the counts of the header" : "");
    }
    metadata_add_number(metadata, f->sinusoid ? "oscillation of the piezo" : "ramp size", f->ramp,
                        "m", f->sinusoid ? "Peak Force Amplitude" : "Ramp size, Sens. Zsens");
    force_describe_calibration(&read, options, "Spring Constant", "Sens. DeflSens", metadata);
    if (f->sinusoid)
        metadata_add(metadata, "odd", "", "",
                     "PeakForce captures were not verified on a genuine file");
}

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, table_writer *metadata)
{
    nanoscope_file file;
    wt_error err = WT_ERROR_INIT;
    const wt_status status = nanoscope_file_open(input, log, &file, &err);
    if (status == WT_OK) {
        add_identity(&file, metadata);
        add_curves(&file, options, metadata);
    }
    nanoscope_file_close(&file);
    return images_add_metadata(self, input, options, log, metadata, status, &err);
}

const file_reader reader_nanoscope = {
    .info = {.id = "nanoscope",
             .title = "NanoScope force curves, force volumes, PeakForce captures and images of "
                      "Bruker and Veeco (.spm, .pfc, .000)",
             .kinds = WT_KIND_FORCE | WT_KIND_IMAGE,
             .verified = true,
             .evidence =
                 "measured single curves and a force volume of software 8.15 and 9.2; "
                 "the heights of images (tried on those of the volume) were not compared with "
                 "another program; PeakForce captures, hold segments, force volumes and "
                 "images of 32 bits: not verified on a genuine file",
             .version = "1"},
    .detect = detect,
    .force = &nanoscope_force,
    .read_images = nanoscope_images,
    .describe = describe,
};
