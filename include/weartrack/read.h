/* weartrack - read: input bytes, format detection, and readers of force curves (as a stream), DMA
 * sweeps, images, spectra and friction records.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_READ_H
#define WEARTRACK_READ_H

#include "weartrack/core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- input ---------------------------------------------------------------------------------- */

/* Input bytes. A file is read into memory only as far as needed; a pipe is buffered. Detection and
 * readers unpack gzip archives and spreadsheets. The functions here return the bytes of the file
 * itself. */
typedef struct wt_input wt_input;
/* Opens an input; path "-" is standard input. A named pipe and a device are rejected, as reading
 * them could take for ever. */
WT_API wt_status wt_input_open(const char *path, wt_input **input, wt_error *err) WT_NODISCARD;
/* Sets the largest number of bytes that are kept of a pipe, or of a file whose bytes are returned
 * as a whole. More is WT_E_RANGE; a file is not read then. */
#define WT_INPUT_LIMIT ((size_t)16 << 30)          /* measured data, unless another limit is set */
#define WT_INPUT_SETTINGS_LIMIT ((size_t)64 << 20) /* cases, descriptions, lists of files */
WT_API void wt_input_limit(wt_input *input, size_t most);
/* Opens an input in memory. The bytes are borrowed until it is closed. */
WT_API wt_status wt_input_open_memory(const void *bytes, size_t length, const char *name,
                                      wt_input **input, wt_error *err) WT_NODISCARD;
WT_API void wt_input_close(wt_input *input);
WT_API const char *wt_input_name(const wt_input *input);
/* Returns all bytes, borrowed until the input is closed. A pipe is read to its end. */
WT_API wt_status wt_input_bytes(wt_input *input, const unsigned char **bytes, size_t *length,
                                wt_error *err) WT_NODISCARD;
/* Returns the number of bytes. A pipe is read to its end. */
WT_API wt_status wt_input_size(wt_input *input, size_t *size, wt_error *err) WT_NODISCARD;
/* Copies bytes [from, from + n) without buffering those of a file. WT_E_IO if the file has become
 * shorter. */
WT_API wt_status wt_input_copy(wt_input *input, size_t from, void *to, size_t n,
                               wt_error *err) WT_NODISCARD;
/* Opens a second input of the same file for another thread. It is NULL (and WT_OK) for an input
 * that is or may be stored in memory as a whole. The caller closes it, in any order. */
WT_API wt_status wt_input_sibling(const wt_input *input, wt_input **sibling,
                                  wt_error *err) WT_NODISCARD;
/* Returns at least the first `n_min` bytes if there are as many; *whole is true if these are all.
 */
WT_API wt_status wt_input_peek(wt_input *input, size_t n_min, const unsigned char **bytes,
                               size_t *length, bool *whole, wt_error *err) WT_NODISCARD;

/* ---- formats -------------------------------------------------------------------------------- */

#define WT_KIND_FORCE 1u    /* force curves */
#define WT_KIND_SWEEP 2u    /* DMA sweeps */
#define WT_KIND_IMAGE 4u    /* topography and other images */
#define WT_KIND_SPECTRUM 8u /* power spectra of surfaces */
#define WT_KIND_RECORD 16u  /* friction records */

typedef struct wt_format_info {
    const char *id;       /* "jpk", "trios-lims" */
    const char *title;    /* "JPK force curves and maps (ZIP)" */
    unsigned kinds;       /* WT_KIND_* */
    bool verified;        /* checked on a genuine file of the instrument */
    bool given_columns;   /* the description of wt_formats_add_columns */
    const char *evidence; /* source of the description: "measured files of software 1.7 to 3.10" */
    const char *version;  /* version of the description or of the library */
} wt_format_info;
/* True for the formats that this program writes, whose ids begin with "weartrack-". NULL: false. */
WT_API bool wt_format_is_own(const wt_format_info *format);

/* Set of formats: the binary readers and the XML descriptions. It is immutable after creation and
 * may be shared between threads. folder NULL = built-in descriptions only. The descriptions of
 * `folder` are added and replace built-in ones of the same id (noted in the log). */
typedef struct wt_formats wt_formats;
WT_API wt_status wt_formats_new(const char *folder, wt_formats **formats, wt_log *log,
                                wt_error *err) WT_NODISCARD;
/* Adds a description "given-columns" of plain tables from "NAME=QUANTITY" or "NAME=QUANTITY:UNIT"
 * (wt_formats_xml shows it). Call it before the set is used. */
WT_API wt_status wt_formats_add_columns(wt_formats *formats, const char *const *columns, size_t n,
                                        wt_error *err) WT_NODISCARD;
WT_API void wt_formats_free(wt_formats *formats);
WT_API size_t wt_formats_count(const wt_formats *formats);
WT_API const wt_format_info *wt_formats_get(const wt_formats *formats, size_t i);
/* Returns the XML text of a description, NULL for a binary reader or an unknown id; borrowed. */
WT_API const char *wt_formats_xml(const wt_formats *formats, const char *id);
/* Returns the schema of descriptions (XSD text); static. */
WT_API const char *wt_formats_schema(void);
/* Returns the format of an id, or NULL. */
WT_API const wt_format_info *wt_formats_find(const wt_formats *formats, const char *id);
/* Detects the format of the input or of its packed content. `kinds` restricts the kinds (0 = any).
 * Of the options (NULL = defaults) the sheet is used. Pass the id in wt_read_options.format to
 * avoid a second detection. */
struct wt_read_options;
WT_API wt_status wt_format_detect(const wt_formats *formats, wt_input *input,
                                  const struct wt_read_options *options, unsigned kinds,
                                  const wt_format_info **info, wt_error *err) WT_NODISCARD;

/* ---- options -------------------------------------------------------------------------------- */

/* Deformation of moduli whose names do not state it, such as "storage modulus". Bending moduli are
 * tensile moduli. */
typedef enum wt_read_deformation {
    WT_DEFORMATION_FROM_FILE,
    WT_DEFORMATION_TENSION,
    WT_DEFORMATION_SHEAR,
    WT_DEFORMATION_BENDING
} wt_read_deformation;

/* Rule that separates the samples of DMA sweeps. */
typedef enum wt_sample_grouping {
    WT_SAMPLE_BY_NAME, /* name in a column or header */
    WT_SAMPLE_BY_FILE  /* each file is a sample with the name of the file */
} wt_sample_grouping;

/* Use of data that the instrument or a check calls faulty, of copies, and of what could be
 * corrected.
 */
typedef enum wt_conditioning {
    WT_CONDITIONING_MEND, /* they are left out or corrected, and named */
    WT_CONDITIONING_KEEP  /* all data count as they stand in the files */
} wt_conditioning;

/* Convention of the densities of a power spectrum; q = 2 pi / wavelength in each. */
typedef enum wt_spectrum_convention {
    WT_CONVENTION_WEARTRACK,          /* h_rms^2 = 2 pi int q C dq = 2 int_0^inf C1 dq */
    WT_CONVENTION_CONTACT_ENGINEERING /* (2 pi)^2 C of an area, 2 pi C1 of a profile */
} wt_spectrum_convention;

/* Use of a --units value for columns of files of several kinds. */
typedef struct wt_unit_usage {
    bool used;       /* a file has that column, without a unit or with the same one */
    bool overruled;  /* a file has it with another unit, which takes precedence */
    char stated[32]; /* unit of the first such file */
} wt_unit_usage;

/* Options of reading. Only the requested data are decoded. */
typedef struct wt_read_options {
    const char *format; /* id that replaces detection, or NULL */
    wt_quantity_set
        want; /* channels to decode; a force needs only its own column. A force without calibration
                 is WT_E_MISSING; with WT_Q_ALL it is omitted with a warning */
    unsigned segments;        /* WT_SEGMENT_BIT()s to decode */
    double spring_constant;   /* [N/m] replaces the value of the file; NaN = that of the file */
    double sensitivity;       /* [m/V] replaces the value of the file; NaN = that of the file */
    double temperature;       /* [K] for a sweep whose file states none; NaN = none */
    const char *const *units; /* "NAME=UNIT" for columns without a unit in the file */
    size_t n_units;
    wt_unit_usage *unit_usage; /* [n_units] for files of several kinds: set by each reader, on any
                              thread, instead of a warning for each file; NULL = warnings */
    bool allow_missing_temperature; /* a sweep without a temperature is read with NaN */
    bool sensor_height_only; /* of the requested heights only the sensor height, if there is one */
    const char *sheet; /* name of a sheet of a spreadsheet; "all" = all recognised sheets in turn;
                          NULL = the only recognised sheet */
    wt_read_deformation deformation; /* WT_E_UNIT if the file contradicts it */
    double strain; /* of isotherms at several strain amplitudes, the nearest to this is read; NaN =
                      none */
    const char *sample; /* sample of DMA sweeps; "all" = all are one material, whatever their names;
                           NULL = none chosen */
    wt_sample_grouping sample_by;
    wt_spectrum_convention spectrum_convention;
    const char
        *temperature_in_name; /* pattern of names of files without a temperature: "#" is the
                                 temperature in degrees Celsius, "*" is anything; NULL = none */
    double pixel_size;        /* [m] for images without a size in the file; NaN = none */
    const char
        *height_unit; /* for images whose values have no unit of length in the file; NULL = none */
    double frequency; /* [Hz] for strain or temperature sweeps whose file states none; NaN = none */
    wt_conditioning conditioning;
} wt_read_options;
WT_API wt_read_options wt_read_defaults(void); /* Reads everything, replaces nothing. */
WT_API const wt_params *wt_read_params(void);

/* ---- reading -------------------------------------------------------------------------------- */

/* Stream of force curves: memory does not grow with the map. Samples are in order of time, which
 * continues from segment to segment. Forces are positive when the tip is repelled. Heights keep the
 * direction of the file (in JPK files they fall during the approach). The source borrows the input
 * and the formats. A curve that cannot be read returns its status and message; the next call
 * continues with the next curve, until WT_END. */
typedef struct wt_force_source wt_force_source;
WT_API wt_status wt_force_open(const wt_formats *formats, wt_input *input,
                               const wt_read_options *options, wt_log *log,
                               wt_force_source **source, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_force_next(wt_force_source *source, wt_force_curve *curve,
                               wt_error *err) WT_NODISCARD;
WT_API void wt_force_close(wt_force_source *source);
WT_API size_t wt_force_count(const wt_force_source *source); /* SIZE_MAX if unknown */

/* Appends the isotherms of one file to `sweep` (zero-initialised for the first file). WT_E_UNIT if
 * tension and shear are mixed. */
WT_API wt_status wt_sweep_read(const wt_formats *formats, wt_input *input,
                               const wt_read_options *options, wt_log *log, wt_sweep *sweep,
                               wt_error *err) WT_NODISCARD;
/* Reads all images (or one-row spectra) of a file. *images is an array of *n. The caller clears
 * each with wt_image_clear and frees the array with free(). */
WT_API wt_status wt_images_read(const wt_formats *formats, wt_input *input,
                                const wt_read_options *options, wt_log *log, wt_image **images,
                                size_t *n, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_power_spectrum_read(const wt_formats *formats, wt_input *input,
                                        const wt_read_options *options, wt_log *log,
                                        wt_power_spectrum *spectrum, wt_error *err) WT_NODISCARD;
/* Reads a friction record. The sign of a load that is negative under pressure is inverted. */
WT_API wt_status wt_record_read(const wt_formats *formats, wt_input *input,
                                const wt_read_options *options, wt_log *log, wt_record *record,
                                wt_error *err) WT_NODISCARD;
/* Creates the metadata table of a file for `weartrack info`: rows of (item, value, unit, source),
 * all text. */
WT_API wt_status wt_input_describe(const wt_formats *formats, wt_input *input,
                                   const wt_read_options *options, wt_log *log, wt_table **metadata,
                                   wt_error *err) WT_NODISCARD;

/* ---- descriptions --------------------------------------------------------------------------- */

/* Checks one description (schema, then further rules). If sample is not NULL, it also reads that
 * file. `report` receives rows of (column, quantity, unit, first value, ...) of the recognised
 * columns. */
WT_API wt_status wt_format_description_check(const char *xml_path, wt_input *sample,
                                             const wt_read_options *options, wt_log *log,
                                             wt_table **report, wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
