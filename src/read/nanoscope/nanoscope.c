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
    return recognised(nanoscope_is(peek->bytes, peek->length), 95);
}

static void add_identity(const nanoscope_file *f, table_writer *facts)
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
            facts_add(facts, known[i].item, "", known[i].key, "%s", text);
    }
}

static void add_curves(const nanoscope_file *f, const wt_read_options *options, table_writer *facts)
{
    const force_metadata read = nanoscope_facts(f, 0);
    facts_add(facts, "curves", "", "Data length", "%zu", f->n_curves);
    if (f->n_curves < f->n_planned)
        facts_add(facts, "curves planned", "", "Data length", "%zu", f->n_planned);
    if (f->columns > 0)
        facts_add(facts, "grid", "", "force/line", "%ld x %ld", f->columns, f->rows);
    for (size_t s = 0; s < 3; s++) {
        char item[32];
        const force_metadata segment = nanoscope_facts(f, s);
        snprintf(item, sizeof item, "segment %zu", segment.index);
        if (segment.n_points > 0)
            facts_add(facts, item, "", "Samps/line", "%s, %zu points",
                      wt_segment_kind_name(segment.kind), segment.n_points);
    }
    for (size_t i = 0; i < f->n_channels; i++) {
        const nanoscope_channel *c = &f->channels[i];
        const wt_quantity q = force_read_as(&read, options, c);
        facts_add(facts, c->name, "", "Image Data", "%s, %u bits%s",
                  q == WT_Q_NONE ? "not read" : wt_quantity_id(q), 8 * c->width,
                  f->scaled ? ", 256 times the counts of the header" : "");
    }
    facts_number(facts, f->sinusoid ? "oscillation of the piezo" : "ramp size", f->ramp, "m",
                 f->sinusoid ? "Peak Force Amplitude" : "Ramp size, Sens. Zsens");
    force_describe_calibration(&read, options, "Spring Constant", "Sens. DeflSens", facts);
    if (f->sinusoid)
        facts_add(facts, "odd", "", "", "PeakForce captures were not verified on a genuine file");
}

static wt_status describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_log *log, table_writer *facts)
{
    nanoscope_file file;
    wt_error err = WT_ERROR_INIT;
    const wt_status status = nanoscope_file_open(input, log, &file, &err);
    if (status == WT_OK) {
        add_identity(&file, facts);
        add_curves(&file, options, facts);
    }
    nanoscope_file_close(&file);
    return images_facts(self, input, options, log, facts, status, &err);
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
