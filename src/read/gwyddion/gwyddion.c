/* Reads height maps of other manufacturers with the program Gwyddion. The program converts them to
 * .gwy, and the result is read.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/gwyddion/gwyddion.h"

#include "read/gwy/gwy.h"
#include "read/gwyddion/surf.h"
#include "read/images.h"
#include "read/reader.h"

#include <math.h>
#include <string.h>

/* Returns the manufacturer of a recognised file, or NULL. Other files need --format gwyddion. */
static const char *maker_name(const file_peek *peek)
{
    if (PEEK_BEGINS(peek, "AliconaImaging"))
        return "Alicona";
    if (PEEK_BEGINS(peek, SURF_PLAIN) || PEEK_BEGINS(peek, SURF_PACKED))
        return "Digital Surf, MountainsMap";
    if (PEEK_BEGINS(peek, "\1\0Directory"))
        return "Wyko, Veeco";
    if (PEEK_BEGINS(peek, "VCA DATA"))
        return "Dektak, Bruker";
    if (PEEK_BEGINS(peek, "aISO-1.0") || PEEK_BEGINS(peek, "aBCR-1.0"))
        return "SDF, ISO 25178-71";
    /* force curves of WSxM have the same first line */
    if (PEEK_BEGINS(peek, "WSxM file copyright") && PEEK_CONTAINS(peek, "SxM Image file"))
        return "WSxM";
    return NULL;
}

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(maker_name(peek) != NULL, 90);
}

/* True if the head of a Digital Surf file states missing points: the little-endian int16 at byte
 * 86. */
static bool surf_has_missing(const file_peek *peek)
{
    enum { FLAG = 86 };
    return (PEEK_BEGINS(peek, SURF_PLAIN) || PEEK_BEGINS(peek, SURF_PACKED)) &&
           peek->length > FLAG + 1 && peek->bytes[FLAG] == 1 && peek->bytes[FLAG + 1] == 0;
}

/* Marks the points at the lowest height as missing. Digital Surf encodes missing points as a height
 * below all others, which Gwyddion 2.62 reads as a height. If a newer version has marked missing
 * points already, nothing changes. */
static void mark_lowest_missing(wt_image *image, const char *file, wt_log *log)
{
    const size_t n = image->n_columns * image->n_rows;
    double lowest = (double)INFINITY;
    size_t n_marked = 0;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(image->values[i]))
            return;
        lowest = image->values[i] < lowest ? image->values[i] : lowest;
    }
    for (size_t i = 0; i < n; i++)
        if (image->values[i] <= lowest) {
            image->values[i] = (double)NAN;
            n_marked++;
        }
    wt_log_add(log, WT_WARNING, file, image->name,
               "the file says that heights are missing; the %zu of %zu at the lowest height, "
               "which marks them, are left out",
               n_marked, n);
}

static wt_status peek_head(wt_input *input, file_peek *peek, wt_error *err)
{
    enum { HEAD = 512 };
    return wt_input_peek(input, HEAD, &peek->bytes, &peek->length, &peek->whole, err);
}

/* Converts the file with Gwyddion. A compressed Digital Surf file is unpacked first. */
static wt_status convert_file(wt_input *input, wt_log *log, wt_input **converted, char version[64],
                              wt_error *err)
{
    const gwyddion_limits *const limits = &gwyddion_default_limits;
    file_peek peek = {.name = wt_input_name(input)};
    wt_status status = peek_head(input, &peek, err);
    if (status != WT_OK || !PEEK_BEGINS(&peek, SURF_PACKED))
        return status == WT_OK ? gwyddion_convert(input, limits, converted, version, err) : status;
    wt_input *plain = NULL;
    status = surf_unpack(input, limits->file_size, log, &plain, err);
    if (status == WT_OK)
        status = gwyddion_convert(plain, limits, converted, version, err);
    wt_input_close(plain);
    return status;
}

static wt_status read_images(const file_reader *self, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_image **images,
                             size_t *n_images, wt_error *err)
{
    char version[64];
    file_peek peek = {.name = wt_input_name(input)};
    wt_input *converted = NULL;
    wt_error inner = WT_ERROR_INIT;
    (void)self;
    (void)options;
    wt_status status = convert_file(input, log, &converted, version, err);
    if (status == WT_OK) {
        status = gwy_read(converted, true, log, images, n_images, &inner);
        if (status != WT_OK) {
            wt_fail(err, status, "what Gwyddion made of the file: %s", inner.message);
            wt_error_advice(err, "open it in Gwyddion: a profile or an image without heights gives "
                                 "no height map");
        }
        wt_input_close(converted);
    }
    const wt_status peek_status = peek_head(input, &peek, NULL); /* the bytes may have moved */
    if (status != WT_OK) {
        const char *const maker = peek_status == WT_OK ? maker_name(&peek) : NULL;
        if (maker != NULL && (err == NULL || err->found[0] == '\0'))
            wt_error_found(err, "a topography (%s)", maker);
        return status;
    }
    wt_log_add(log, WT_NOTE, peek.name, NULL, "converted by %s", version);
    if (peek_status == WT_OK && surf_has_missing(&peek))
        mark_lowest_missing(&(*images)[0], peek.name, log);
    return WT_OK;
}

const file_reader reader_gwyddion = {
    .info = {.id = "gwyddion",
             .title = "height maps of Alicona, Digital Surf, Wyko, Dektak, SDF, WSxM, by the "
                      "program Gwyddion",
             .kinds = WT_KIND_IMAGE,
             .verified = true,
             .evidence = "measured files of Alicona, Digital Surf, Wyko and WSxM, whose numbers "
                         "other programs agree on",
             .version = "1"},
    .detect = detect,
    .read_images = read_images,
    .describe = images_describe,
};
