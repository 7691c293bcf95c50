/* Declares what the files of the JPK reader share.
 *
 * A file is a ZIP archive of .properties headers and raw channels. The names of the entries, and
 * not of folders, define the curves and segments.
 *
 * Keys that many segments share are stored once in shared-data/header.properties.
 * `channel.C.lcd-info.*=N` means that channel C has the keys `lcd-info.N.…` of that file. The
 * segment header has such references as well. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_JPK_H
#define WT_READ_JPK_H

#include "read/bytes/samples.h"
#include "read/bytes/zip.h"
#include "read/force_assembler.h"
#include "read/reader.h"
#include "weartrack/core.h"

typedef struct property_entry {
    const char *key;
    const char *value;
} property_entry;

/* A table of properties; zero-initialised is empty. Parsing again reuses the memory, so one table
 * serves the headers of all segments of a map. */
typedef struct property_list {
    property_entry *items; /* [n] sorted by key; of equal keys the last one in the file */
    size_t n;
    size_t capacity; /* size of the block of items and text [byte] */
    char *text;      /* keys and values, UTF-8 */
} property_list;

/* Parses Latin-1 text with `#` and `!` comments, and `=`, `:` or blank between key and value. It
 * knows the escapes \t \n \r \f \uXXXX and continued lines. Returns WT_E_CORRUPT and an empty table
 * for a zero byte or an invalid \u. */
wt_status properties_parse(property_list *properties, const unsigned char *bytes, size_t length,
                           wt_error *err) WT_NODISCARD;
void properties_clear(
    property_list *properties); /* frees the memory; the table is empty afterwards */

/* Returns the value of a key, or NULL. */
const char *properties_get(const property_list *properties, const char *key);
/* Returns the value of the key prefix + suffix, or NULL; NULL also for a key that is too long. */
const char *properties_find(const property_list *properties, const char *prefix,
                            const char *suffix);
/* Reads the next word of a list and moves *list past it. Returns false if there is none or it does
 * not fit; *list is then the rest. *list may be NULL. */
bool property_next_token(const char **list, char *word, size_t size);
/* Returns the number of the key prefix + suffix; NaN if it is absent or no number. */
double properties_number(const property_list *properties, const char *prefix, const char *suffix);

#define JPK_NAME 64

#define JPK_SLOTS 12

#define JPK_CHANNELS 64

/* Maximum size of a header; real headers have a few kilobytes [byte]. */
#define JPK_HEADER_MAX ((size_t)8 * 1024 * 1024)

/* ---- channels: jpk_channel.c -------------------------------------------------------------- */

/* A calibration slot, which computes its values from those of the slot `base`. */
typedef struct jpk_slot {
    char name[JPK_NAME];
    char base[JPK_NAME];
    char unit[16];
    force_linear scaling;
} jpk_slot;

/* Encoding and calibration of a channel ("lcd-info"). */
typedef struct jpk_lcd {
    sample_type encoding;     /* of the data file, big-endian */
    bool raster;              /* true for values start + i * step without a data file */
    force_linear encoder;     /* from the raw number to the value of the base slot */
    char base[JPK_NAME];      /* "volts", "absolute" */
    char base_unit[16];       /* "V", "m" */
    char preferred[JPK_NAME]; /* slot that the instrument shows */
    jpk_slot slots[JPK_SLOTS];
    size_t n_slots;
    long id; /* number in the shared header, for a shared block */
} jpk_lcd;

const jpk_slot *jpk_lcd_slot(const jpk_lcd *lcd,
                             const char *name); /* NULL if the slot is absent or undefined */
/* Computes the conversion from the base value to the value of a slot; false if the slots do not
 * lead to the base. */
bool jpk_lcd_chain(const jpk_lcd *lcd, const char *slot, force_linear *chain);

/* ---- the file: jpk_file.c ----------------------------------------------------------------- */

typedef struct jpk_segment_ref {
    uint32_t curve;   /* number in the file */
    uint32_t segment; /* number in the file */
    uint32_t entry;   /* entry of its segment-header.properties */
} jpk_segment_ref;

typedef struct jpk_file {
    zip_archive *archive;
    const char *name;       /* name of the input */
    wt_log *log;            /* borrowed, may be NULL */
    bool map;               /* true if the curves are in index/N/ */
    property_list header;   /* header.properties; empty if missing */
    property_list shared;   /* shared-data/header.properties; empty if missing */
    property_list position; /* scratch: index/N/header.properties */
    byte_buffer buffer;     /* scratch: unpacked entry */
    jpk_segment_ref *refs;  /* [n_refs] by curve, then segment */
    size_t n_refs;
    size_t n_curves;
    jpk_lcd *lcds; /* blocks of `shared` that were read so far */
    size_t n_lcds;
    long columns, rows; /* grid; 0 if there is none */
    bool back_and_forth;
    size_t n_expected; /* number of curves that the header states; 0 if none */
} jpk_file;

wt_status jpk_file_open(wt_input *input, wt_log *log, jpk_file *file, wt_error *err);
void jpk_file_close(jpk_file *file); /* accepts a zero-initialised file */
/* Sets the position and the grid position of the curve of refs[ref]; unknown ones are NaN and
 * -1. */
void jpk_file_set_position(jpk_file *file, size_t ref, wt_force_curve *curve);
/* Warns if the curve has fewer segments than its header states. Call it after
 * jpk_file_set_position. `n`: number of segments from refs[ref] on. */
void jpk_file_check_segments(const jpk_file *file, size_t ref, size_t n);

/* ---- a segment: jpk_segment.c ------------------------------------------------------------- */

typedef struct jpk_channel {
    char name[JPK_NAME];
    size_t n_points;
    size_t entry;        /* entry of its data file, if has_file */
    bool has_file;       /* false for a raster or a missing file */
    bool understood;     /* `lcd` is filled */
    char problem[192];   /* reason, if it is not understood */
    force_linear raster; /* value of the base slot = multiplier * i + offset */
    jpk_lcd lcd;
} jpk_channel;

typedef struct jpk_segment {
    property_list header; /* reused from segment to segment */
    jpk_channel channels[JPK_CHANNELS];
    size_t n_channels;
    wt_segment_kind kind;
    char style[JPK_NAME];
    size_t n_points;         /* number of samples that every channel with a file has */
    bool incomplete;         /* a data file is missing or short */
    double duration;         /* [s], NaN if unknown */
    double velocity;         /* [m/s], NaN if unknown */
    double frequency;        /* modulation frequency [Hz] */
    double setpoint_voltage; /* [V], NaN if none */
} jpk_segment;

wt_status jpk_segment_read(jpk_file *file, const jpk_segment_ref *ref, jpk_segment *segment,
                           wt_error *err);
/* Returns NULL if there is none. */
const jpk_channel *jpk_segment_channel(const jpk_segment *segment, const char *name);

#endif
