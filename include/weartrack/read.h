/* weartrack - read room: bytes from a file, a pipe or memory; which format they are; force curves
 * as a stream, DMA sweeps, images and power spectra.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WEARTRACK_READ_H
#define WEARTRACK_READ_H

#include "weartrack/data.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- input -------------------------------------------------------------------------------- */

/* Bytes with peek. A file is read into memory as far as it is asked for, a pipe is buffered. Gzip
 * archives and spreadsheets are unpacked where formats are detected and data read, a ZIP archive of
 * files of force curves is read as one; the bytes here are those of the file. */
typedef struct wt_input wt_input;
/* path "-" is standard input. A named pipe is refused: nobody may ever write to it. */
WT_API wt_status wt_input_open(const char *path, wt_input **input, wt_error *err) WT_NODISCARD;
/* Borrows the bytes until closed. */
WT_API wt_status wt_input_open_memory(const void *bytes, size_t length, const char *name,
                                      wt_input **input, wt_error *err) WT_NODISCARD;
WT_API void wt_input_close(wt_input *input);
WT_API const char *wt_input_name(const wt_input *input);
/* All bytes, borrowed until the input is closed (a pipe is read to its end). */
WT_API wt_status wt_input_bytes(wt_input *input, const unsigned char **bytes, size_t *length,
                                wt_error *err) WT_NODISCARD;
/* How many bytes there are (a pipe is read to its end). */
WT_API wt_status wt_input_size(wt_input *input, size_t *size, wt_error *err) WT_NODISCARD;
/* Copies bytes [from, from + n), without keeping those of a file. WT_E_IO if there are not so many:
 * the file has become shorter. */
WT_API wt_status wt_input_at(wt_input *input, size_t from, void *to, size_t n,
                             wt_error *err) WT_NODISCARD;
/* A second input of the same file, of which another thread may ask parts meanwhile; NULL (and
 * WT_OK) of what is or may be kept in memory as a whole. To be closed by the caller, in any order.
 */
WT_API wt_status wt_input_sibling(const wt_input *input, wt_input **beside,
                                  wt_error *err) WT_NODISCARD;
/* At least the first `want` bytes if there are as many; *whole says that this is all. */
WT_API wt_status wt_input_peek(wt_input *input, size_t want, const unsigned char **bytes,
                               size_t *length, bool *whole, wt_error *err) WT_NODISCARD;

/* ---- formats ------------------------------------------------------------------------------ */

#define WT_KIND_FORCE 1u    /* force curves */
#define WT_KIND_SWEEP 2u    /* DMA sweeps */
#define WT_KIND_IMAGE 4u    /* topography and other images */
#define WT_KIND_SPECTRUM 8u /* power spectra of surfaces */
#define WT_KIND_NOISE 16u   /* spectra of the thermal noise of a lever */
#define WT_KIND_RECORD 32u  /* records of friction */

typedef struct wt_format_info {
    const char *id;       /* "jpk", "trios-lims" */
    const char *title;    /* "JPK force curves and maps (ZIP)" */
    unsigned kinds;       /* WT_KIND_* */
    bool verified;        /* read and checked on a genuine file */
    const char *evidence; /* how it is known: "measured files of software 1.7 to 3.10" */
    const char *version;  /* of the description, or of the library */
} wt_format_info;

/* The formats: the binary readers and the XML descriptions. A set is immutable once it is made and
 * may be shared between threads. folder NULL = built-in descriptions only; the descriptions of
 * `folder` are added and replace built-in ones of the same id (noted in the log). */
typedef struct wt_formats wt_formats;
WT_API wt_status wt_formats_new(const char *folder, wt_formats **formats, wt_log *log,
                                wt_error *err) WT_NODISCARD;
/* The columns of plain tables, "NAME=QUANTITY" or "NAME=QUANTITY:UNIT", as a description called
 * "given-columns" (wt_formats_xml shows it). Before the set is used. */
WT_API wt_status wt_formats_add_columns(wt_formats *formats, const char *const *columns, size_t n,
                                        wt_error *err) WT_NODISCARD;
WT_API void wt_formats_free(wt_formats *formats);
WT_API size_t wt_formats_count(const wt_formats *formats);
WT_API const wt_format_info *wt_formats_get(const wt_formats *formats, size_t i);
/* The XML text of a description, NULL for a binary reader or an unknown id; borrowed. */
WT_API const char *wt_formats_xml(const wt_formats *formats, const char *id);
/* The schema of descriptions (XSD text); static. */
WT_API const char *wt_formats_schema(void);
/* The format of that id, or NULL. */
WT_API const wt_format_info *wt_formats_find(const wt_formats *formats, const char *id);
/* Which format the input is, or what is packed in it. `kinds` limits the question (0 = any); of the
 * options (NULL = the defaults) the sheet is used. Its id in wt_read_options.format hands the
 * answer on: nobody is asked again when the input is read. */
struct wt_read_options;
WT_API wt_status wt_detect(const wt_formats *formats, wt_input *input,
                           const struct wt_read_options *options, unsigned kinds,
                           const wt_format_info **info, wt_error *err) WT_NODISCARD;

/* ---- options ------------------------------------------------------------------------------ */

/* What moduli are of whose names do not say it, as "storage modulus". Those of bending are of
 * tension. */
typedef enum wt_read_deformation {
    WT_DEFORMATION_OF_FILE,
    WT_DEFORMATION_TENSION,
    WT_DEFORMATION_SHEAR,
    WT_DEFORMATION_BENDING
} wt_read_deformation;

/* What tells the samples of DMA sweeps apart. */
typedef enum wt_sample_by {
    WT_SAMPLE_BY_NAME, /* that a column or the header says */
    WT_SAMPLE_BY_FILE  /* each file is of one, which is called as the file is */
} wt_sample_by;

/* What the densities of a power spectrum are; q is 2 pi / wavelength in each. */
typedef enum wt_spectrum_convention {
    WT_CONVENTION_WEARTRACK,          /* h_rms^2 = 2 pi int q C dq = 2 int_0^inf C1 dq */
    WT_CONVENTION_CONTACT_ENGINEERING /* (2 pi)^2 C of an area, 2 pi C1 of a profile */
} wt_spectrum_convention;

/* What became of a unit that is given for columns of files of several kinds. */
typedef struct wt_unit_use {
    bool used;       /* a file has that column, without a unit or in the same */
    bool overruled;  /* a file has it in another unit, which stands */
    char stated[32]; /* that of the first such file */
} wt_unit_use;

/* Nothing that is not asked for is decoded. */
typedef struct wt_read_options {
    const char *format;   /* id that overrules detection, or NULL */
    wt_quantity_set want; /* channels to decode; a force needs no more than its own column. A force
                             that the calibration does not allow is WT_E_MISSING, or with
                             WT_Q_ALL left out with a warning */
    unsigned segments;    /* WT_SEGMENT_BIT()s to decode */
    double spring_constant;   /* [N/m] replaces the file's; NaN = the file's */
    double sensitivity;       /* [m/V] replaces the file's; NaN = the file's */
    double temperature;       /* [K] for a sweep whose file gives none; NaN = none */
    const char *const *units; /* "NAME=UNIT" for columns of files that carry no units */
    size_t n_units;
    wt_unit_use *unit_use; /* [n_units] of files of several kinds: set by what each has, by any
                              thread, and no file is warned of; NULL = each is */
    bool any_temperature;  /* a sweep without a temperature is read, as NaN */
    bool one_height;       /* of the heights wanted only that of a sensor, where there is one */
    const char *sheet; /* of a spreadsheet: its name; "all" = all that are recognised, one after the
                          other; NULL = the only one that is */
    wt_read_deformation deformation; /* one that the file contradicts is WT_E_UNIT */
    double strain; /* of isotherms at several strain amplitudes take those nearest to this; NaN */
    const char *sample; /* of DMA sweeps of several samples: its name; "all" = they are of one
                           material, whatever they are called; NULL = none is chosen */
    wt_sample_by sample_by;
    wt_spectrum_convention spectrum_convention;
    const char *temperature_in_name; /* pattern of the names of files that say no temperature: a "#"
                                        stands where it does, in degrees Celsius, a "*" for
                                        anything; NULL = none */
    double pixel_size;               /* [m] of images whose file does not give their size; NaN */
    const char *height_unit;         /* of images whose values the file gives as no length; NULL */
    double frequency; /* [Hz] of sweeps of strain or temperature whose file gives none; NaN */
} wt_read_options;
WT_API wt_read_options wt_read_defaults(void); /* everything, nothing replaced */
WT_API const wt_params *wt_read_params(void);

/* ---- reading ------------------------------------------------------------------------------ */

/* Force curves as a stream: memory does not grow with the map. Samples are in the order of time,
 * which runs on from segment to segment; a force is positive when the tip is pushed away from the
 * sample; heights keep the direction of the file (in JPK files they fall during the approach). The
 * source borrows the input and the formats. A curve that cannot be read gives its status and
 * message; the next call goes on with the curve after it, until WT_END. */
typedef struct wt_force_source wt_force_source;
WT_API wt_status wt_force_open(const wt_formats *formats, wt_input *input,
                               const wt_read_options *options, wt_log *log,
                               wt_force_source **source, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_force_next(wt_force_source *source, wt_force_curve *curve,
                               wt_error *err) WT_NODISCARD;
WT_API void wt_force_close(wt_force_source *source);
WT_API size_t wt_force_count(const wt_force_source *source); /* SIZE_MAX if not known */

/* Appends the isotherms of one file to `sweep` (zero-initialised for the first file). Mixing
 * tension and shear is WT_E_UNIT. */
WT_API wt_status wt_sweep_read(const wt_formats *formats, wt_input *input,
                               const wt_read_options *options, wt_log *log, wt_sweep *sweep,
                               wt_error *err) WT_NODISCARD;
/* All images (or one-row spectra) of a file: *images is an array of *n, each to be cleared, then
 * the array freed with free(). */
WT_API wt_status wt_images_read(const wt_formats *formats, wt_input *input,
                                const wt_read_options *options, wt_log *log, wt_image **images,
                                size_t *n, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_power_spectrum_read(const wt_formats *formats, wt_input *input,
                                        const wt_read_options *options, wt_log *log,
                                        wt_power_spectrum *spectrum, wt_error *err) WT_NODISCARD;
/* The thermal noise of a lever; amplitude densities are squared. */
WT_API wt_status wt_noise_read(const wt_formats *formats, wt_input *input,
                               const wt_read_options *options, wt_log *log,
                               wt_noise_spectrum *spectrum, wt_error *err) WT_NODISCARD;
/* A record of friction. A load that is negative when it presses is turned round. */
WT_API wt_status wt_record_read(const wt_formats *formats, wt_input *input,
                                const wt_read_options *options, wt_log *log, wt_record *record,
                                wt_error *err) WT_NODISCARD;
/* What a file is, for `weartrack info`: rows of (item, value, unit, source), all text. */
WT_API wt_status wt_describe(const wt_formats *formats, wt_input *input,
                             const wt_read_options *options, wt_log *log, wt_table **facts,
                             wt_error *err) WT_NODISCARD;

/* ---- descriptions ------------------------------------------------------------------------- */

/* Checks one description (schema, then what a schema cannot say) and, if sample is not NULL, runs
 * it on that file. `report` gets rows of (column, quantity, unit, first value, ...) of what is
 * understood. */
WT_API wt_status wt_description_check(const char *xml_path, wt_input *sample,
                                      const wt_read_options *options, wt_log *log,
                                      wt_table **report, wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
