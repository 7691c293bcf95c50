/* Reads height maps of other manufacturers with the program Gwyddion. The program converts them to
 * .gwy, and the result is read. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/gwyddion/gwyddion.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/text.h"
#include "core/system/subprocess.h"
#include "core/system/temporary.h"
#include "read/bytes/bytes.h"
#include "read/bytes/input.h"
#include "read/images.h"
#include "read/reader.h"
#include "weartrack/read.h"

#include <errno.h>
#include <fcntl.h>
#include <libdeflate.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define SURF_PLAIN "DIGITAL SURF"

#define SURF_PACKED "DSCOMPRESSED"

/* Offsets in the head, the length of the head, and the sizes of the piece count and of a piece
 * record [byte]. */
enum {
    BITS = 98,
    N_POINTS = 116,
    COMMENT = 334,
    PRIVATE = 336,
    HEAD_SIZE = 512,
    COUNT = 4,
    PIECE = 8
};

/* Maximum ratio of plain to packed bytes of Deflate. */
enum { MAX_DEFLATE_RATIO = 1032 };

typedef struct surf_pieces {
    const unsigned char *bytes;
    size_t length, head; /* size of the file; size of all before the piece count */
    size_t n, packed;    /* number of pieces; offset of the first */
    size_t plain;        /* total unpacked size */
} surf_pieces;

static wt_status fail_surf(const char *what, wt_error *err)
{
    wt_fail(err, WT_E_CORRUPT, "a compressed file of Digital Surf is damaged: %s", what);
    wt_error_advice(err, "copy it again, or save it in MountainsMap without compression");
    return WT_E_CORRUPT;
}

static size_t plain_size(const surf_pieces *p, size_t i)
{
    return le32(p->bytes + p->head + COUNT + PIECE * i);
}

static size_t packed_size(const surf_pieces *p, size_t i)
{
    return le32(p->bytes + p->head + COUNT + PIECE * i + PIECE / 2);
}

static wt_status find_pieces(surf_pieces *p, wt_error *err)
{
    if (p->length < HEAD_SIZE)
        return fail_surf("its head is cut", err);
    const size_t comment = le16(p->bytes + COMMENT), private_size = le16(p->bytes + PRIVATE);
    p->head = HEAD_SIZE + comment + private_size;
    if (comment > INT16_MAX || private_size > INT16_MAX || p->head + COUNT > p->length)
        return fail_surf("it ends before its heights", err);
    p->n = le32(p->bytes + p->head);
    if (p->n == 0 || p->n > (p->length - p->head - COUNT) / PIECE)
        return fail_surf("it says of more pieces than it has room for", err);
    p->packed = p->head + COUNT + PIECE * p->n;
    return WT_OK;
}

/* Checks that the pieces lie in the file and have the size that the head states. */
static wt_status check_pieces(surf_pieces *p, size_t max_size, wt_error *err)
{
    const uint64_t heights = (uint64_t)le32(p->bytes + N_POINTS) * (le16(p->bytes + BITS) / 8U);
    size_t left = p->length - p->packed;
    for (size_t i = 0; i < p->n; i++) {
        const size_t packed = packed_size(p, i), plain = plain_size(p, i);
        if (packed > left || plain / MAX_DEFLATE_RATIO > packed)
            return fail_surf("a piece of its heights lies outside of it", err);
        left -= packed;
        p->plain += plain; /* at most MAX_DEFLATE_RATIO times the file size */
    }
    if (p->plain > max_size) {
        wt_fail(err, WT_E_UNSUPPORTED, "the heights of the file are larger than is read");
        wt_error_expected(err, "%zu bytes at most", max_size);
        wt_error_found(err, "%zu", p->plain);
        return WT_E_UNSUPPORTED;
    }
    if (p->plain != heights) {
        fail_surf("its head and its heights are not of one size", err);
        wt_error_expected(err, "%llu bytes", (unsigned long long)heights);
        wt_error_found(err, "%zu", p->plain);
        return WT_E_CORRUPT;
    }
    return WT_OK;
}

static wt_status unpack_pieces(const surf_pieces *p, char *to, size_t *end, wt_error *err)
{
    struct libdeflate_decompressor *const unpacker = libdeflate_alloc_decompressor();
    wt_status status = WT_OK;
    if (unpacker == NULL)
        out_of_memory(0);
    size_t at = p->packed, done = 0;
    for (size_t i = 0; status == WT_OK && i < p->n; i++) {
        if (libdeflate_zlib_decompress(unpacker, p->bytes + at, packed_size(p, i), to + done,
                                       plain_size(p, i), NULL) != LIBDEFLATE_SUCCESS)
            status = fail_surf("a piece of its heights cannot be unpacked", err);
        at += packed_size(p, i);
        done += plain_size(p, i);
    }
    *end = at;
    libdeflate_free_decompressor(unpacker);
    return status;
}

wt_status surf_unpack(wt_input *input, size_t max_size, wt_log *log, wt_input **unpacked,
                      wt_error *err)
{
    surf_pieces p = {.n = 0};
    size_t end = 0;
    wt_status status = wt_input_bytes(input, &p.bytes, &p.length, err);
    if (status == WT_OK)
        status = find_pieces(&p, err);
    if (status == WT_OK)
        status = check_pieces(&p, max_size, err);
    if (status != WT_OK)
        return status;
    char *const plain = try_alloc(p.head + p.plain + 1, 1);
    if (plain == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a height map");
    memcpy(plain, p.bytes, p.head);
    memcpy(plain, SURF_PLAIN, strlen(SURF_PLAIN));
    status = unpack_pieces(&p, plain + p.head, &end, err);
    if (status != WT_OK) {
        free(plain);
        return status;
    }
    if (end < p.length)
        wt_log_add(log, WT_WARNING, wt_input_name(input), NULL,
                   "%zu bytes behind the heights of the first surface are not read",
                   p.length - end);
    *unpacked = input_from_bytes(plain, p.head + p.plain, wt_input_name(input));
    return WT_OK;
}

#define CONVERTED_NAME "converted.gwy"

/* A map of 4000 x 4000 points takes 2 s. An upper bound of 2^27 points is 1 GiB as written by
 * Gwyddion, and Gwyddion holds up to four copies. */
const gwyddion_limits gwyddion_default_limits = {
    .time = 60, .cpu_time = 60, .file_size = (size_t)1 << 30, .memory = (size_t)4 << 30};

/* limit for the version query, which is fast [s] */
static const double VERSION_TIME = 10;

/* Formats that are recognised by their first bytes, and the ending of their files. */
typedef struct known_format {
    const char *magic;
    size_t length;
    const char *maker, *ending;
} known_format;
#define MAGIC(bytes) bytes, sizeof(bytes) - 1

static const known_format known_formats[] = {
    {MAGIC("AliconaImaging"), "Alicona", ".al3d"},
    {MAGIC(SURF_PLAIN), "Digital Surf, MountainsMap", ".sur"},
    {MAGIC(SURF_PACKED), "Digital Surf, MountainsMap", ".sur"},
    {MAGIC("\1\0Directory"), "Wyko, Veeco", ".opd"},
    {MAGIC("VCA DATA"), "Dektak, Bruker", ".opdx"},
    {MAGIC("aISO-1.0"), "SDF, ISO 25178-71", ".sdf"},
    {MAGIC("aBCR-1.0"), "SDF, ISO 25178-71", ".sdf"},
};

/* Returns the format of a file, or NULL. Other files need --format gwyddion. */
static const known_format *find_format(const file_peek *peek)
{
    for (size_t i = 0; i < COUNT_OF(known_formats); i++) {
        const known_format *const known = &known_formats[i];
        if (peek_begins(peek, known->magic, known->length))
            return known;
    }
    return NULL;
}

static wt_status peek_head(wt_input *input, file_peek *peek, wt_error *err)
{
    enum { HEAD = 512 };
    return wt_input_peek(input, HEAD, &peek->bytes, &peek->length, &peek->whole, err);
}

static wt_status write_copy(wt_input *input, const char *folder, const char *name, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    char *const path = wt_path_join(folder, name);
    const int file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0)
        status = wt_fail(err, WT_E_IO, "no copy for Gwyddion: %s", strerror(errno));
    else
        status = scratch_write(file, bytes, length, wt_input_name(input), err);
    if (file >= 0)
        close(file);
    free(path);
    return status;
}

static wt_status add_export_advice(wt_error *err)
{
    wt_error_advice(err,
                    "see whether Gwyddion opens the file, and save it there as .gwy; or export "
                    "it as .x3p, .gwy or .gsf");
    return WT_E_TOOL;
}

static wt_status fail_tool(const char *what, wt_error *err)
{
    wt_fail(err, WT_E_TOOL, "%s", what);
    return add_export_advice(err);
}

static wt_status check_program_end(const program_result *end, const gwyddion_limits *limits,
                                   wt_error *err)
{
    switch (end->outcome) {
    case PROGRAM_NOT_STARTED:
        if (end->code == ENOENT)
            wt_fail(err, WT_E_TOOL,
                    "such a file is read by the program Gwyddion, which is missing");
        else
            wt_fail(err, WT_E_TOOL, "the program Gwyddion cannot be started: %s",
                    strerror(end->code));
        wt_error_advice(err, end->code == EMFILE || end->code == ENFILE
                                 ? MORE_FILES_ADVICE
                                 : "install Gwyddion (apt-get install gwyddion), or export the "
                                   "file as .x3p, .gwy or .gsf");
        return WT_E_TOOL;
    case PROGRAM_SIGNALLED:
        wt_fail(err, WT_E_TOOL, "Gwyddion failed on the file: it was ended by signal %d",
                end->code);
        return add_export_advice(err);
    case PROGRAM_EXITED:
        if (end->code == 0)
            return WT_OK;
        wt_fail(err, WT_E_TOOL, "Gwyddion cannot read the file: it ended with exit status %d",
                end->code);
        return add_export_advice(err);
    case PROGRAM_TOO_LARGE:
        wt_fail(err, WT_E_TOOL, "Gwyddion wrote more than %zu MiB", 2 * limits->file_size >> 20);
        return add_export_advice(err);
    case PROGRAM_TOO_LONG:
    case PROGRAM_CANCELLED:
    default:
        wt_fail(err, WT_E_TOOL, "Gwyddion did not end within %g s", limits->time);
        return add_export_advice(err);
    }
}

static wt_status run_gwyddion(const char *folder, const char *const *arguments,
                              const gwyddion_limits *limits, program_result *end, wt_error *err)
{
    /* Gwyddion must not see settings of the user or a display. */
    static const char *const hidden[] = {"HOME=",   "XDG_",        "DISPLAY=", "WAYLAND_",
                                         "DBUS_",   "GTK",         "GWYDDION", "G_",
                                         "TMPDIR=", "LD_PRELOAD=", NULL};
    char *const home = format_text("HOME=%s", folder);
    char *const temporary = format_text("TMPDIR=%s", folder);
    const char *const added[] = {home, temporary, NULL};
    const program_call call = {.program = "gwyddion",
                               .arguments = arguments,
                               .folder = folder,
                               .hidden = hidden,
                               .added = added,
                               .limit = limits->time,
                               .foreign = true,
                               .file_size = limits->file_size,
                               .folder_size = 2 * limits->file_size,
                               .memory = limits->memory,
                               .cpu_time = limits->cpu_time};
    const wt_status status = program_run(&call, end, err);
    free(home);
    free(temporary);
    return status;
}

/* Reads the converted bytes, so that the folder can be removed. Only a regular file is accepted. */
static wt_status read_converted(const char *folder, const char *name, size_t max_size,
                                wt_input **converted, wt_error *err)
{
    struct stat known;
    char *const path = wt_path_join(folder, CONVERTED_NAME);
    wt_status status = WT_OK;
    const int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    free(path);
    if (file < 0 || fstat(file, &known) != 0 || !S_ISREG(known.st_mode) || known.st_size == 0) {
        status = fail_tool("Gwyddion made nothing of the file", err);
    } else if ((size_t)known.st_size >= max_size) { /* it was truncated at the limit */
        status = fail_tool("Gwyddion made more of the file than is read", err);
    } else {
        const size_t length = (size_t)known.st_size;
        size_t done = 0;
        ssize_t got = 1;
        char *const bytes = wt_alloc(length + 1, 1);
        while (done < length && got > 0) {
            got = read(file, bytes + done, length - done);
            done += got > 0 ? (size_t)got : 0;
        }
        if (done < length) {
            status = fail_tool("what Gwyddion wrote cannot be read", err);
            free(bytes);
        } else {
            *converted = input_from_bytes(bytes, length, name);
        }
    }
    if (file >= 0)
        close(file);
    return status;
}

static void read_version(const char *folder, const gwyddion_limits *limits, char version[64])
{
    static const char *const arguments[] = {"--version", NULL};
    gwyddion_limits short_time = *limits;
    program_result end;
    if (short_time.time > VERSION_TIME)
        short_time.time = VERSION_TIME;
    const bool known = run_gwyddion(folder, arguments, &short_time, &end, NULL) == WT_OK &&
                       end.outcome == PROGRAM_EXITED && end.code == 0 && end.words[0] != '\0';
    if (known)
        end.words[utf8_truncated_length(end.words, strlen(end.words), 63)] = '\0';
    snprintf(version, 64, "%.63s", known ? end.words : "Gwyddion of an unknown version");
    utf8_sanitize(version);
}

wt_status gwyddion_convert(wt_input *input, const gwyddion_limits *limits, wt_input **converted,
                           char version[64], wt_error *err)
{
    int held = -1;
    char name[32];
    program_result end;
    file_peek peek = {.name = wt_input_name(input)};
    wt_status status = peek_head(input, &peek, err);
    if (status != WT_OK)
        return status;
    char *const place = realpath(temporary_directory(), NULL);
    if (place != NULL)
        temporary_remove_abandoned(place);
    char *const folder = place != NULL ? temporary_folder_create(place, &held) : NULL;
    if (folder == NULL || fchmod(held, 0700) != 0) {
        wt_fail(err, WT_E_IO, "no temporary folder for Gwyddion: %s", strerror(errno));
        wt_error_advice(err, "set TMPDIR to a folder with room for the height map");
        free(place);
        free(folder);
        return WT_E_IO;
    }
    free(place);
    /* Gwyddion regards the ending of the name. It must not be chosen by the name of the file. */
    const known_format *const known = find_format(&peek);
    (void)snprintf(name, sizeof name, "surface%s", known != NULL ? known->ending : "");
    const char *const arguments[] = {"--convert-to-gwy=" CONVERTED_NAME, name, NULL};
    status = write_copy(input, folder, name, err);
    if (status == WT_OK)
        status = run_gwyddion(folder, arguments, limits, &end, err);
    if (status == WT_OK)
        status = check_program_end(&end, limits, err);
    if (status == WT_OK)
        status = read_converted(folder, wt_input_name(input), limits->file_size, converted, err);
    if (status == WT_OK)
        read_version(folder, limits, version);
    temporary_remove(folder);
    close(held);
    free(folder);
    return status;
}

static recognition detect(const file_reader *self, file_peek *peek)
{
    (void)self;
    return recognition_result(find_format(peek) != NULL, 90);
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
        const known_format *const known = peek_status == WT_OK ? find_format(&peek) : NULL;
        if (known != NULL && (err == NULL || err->found[0] == '\0'))
            wt_error_found(err, "a topography (%s)", known->maker);
        return status;
    }
    wt_log_add(log, WT_NOTE, peek.name, NULL, "converted by %s", version);
    if (peek_status == WT_OK && surf_has_missing(&peek))
        mark_lowest_missing(&(*images)[0], peek.name, log);
    return WT_OK;
}

const file_reader reader_gwyddion = {
    .info = {.id = "gwyddion",
             .title = "height maps of Alicona, Digital Surf, Wyko, Dektak, SDF, by the program "
                      "Gwyddion",
             .kinds = WT_KIND_IMAGE,
             .verified = true,
             .evidence = "measured files of Alicona, Digital Surf and Wyko, whose numbers other "
                         "programs agree on",
             .version = "1"},
    .detect = detect,
    .read_images = read_images,
    .describe = images_describe,
};
