/* weartrack - data: the shared data types, the text stream and the HDF5 store. All values are in SI
 * units. See base.h for ownership and errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_DATA_H
#define WEARTRACK_DATA_H

#include "weartrack/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- force curves ------------------------------------------------------------------------- */

/* One column of a segment: SI values with their quantity and the instrument's name for them. */
typedef struct wt_channel {
    wt_quantity quantity;
    char name[64];  /* as exported, UTF-8 */
    char unit[32];  /* as exported, before conversion; "" if not stated */
    double *values; /* [n_points] of the segment, SI; NaN = missing sample */
} wt_channel;

typedef enum wt_segment_kind {
    WT_SEGMENT_APPROACH,
    WT_SEGMENT_RETRACT,
    WT_SEGMENT_DWELL,
    WT_SEGMENT_MODULATION,
    WT_SEGMENT_OTHER
} wt_segment_kind;
#define WT_SEGMENT_BIT(kind) (1u << (unsigned)(kind))
#define WT_SEGMENT_ALL (~0u)

WT_API const char *wt_segment_kind_name(wt_segment_kind kind); /* "approach"; static */

/* A segment of a force curve. Samples are in order of time. */
typedef struct wt_segment {
    wt_segment_kind kind;
    size_t index;    /* number in the file, counted from 0 */
    size_t n_points; /* samples of each channel */
    size_t n_channels;
    wt_channel *channels;
    double duration;  /* duration of n_points intervals [s]; sample i is at duration i/n; NaN if
                         unknown */
    double setpoint;  /* [N] or NaN */
    double velocity;  /* piezo velocity [m/s], NaN if unknown */
    double frequency; /* stated modulation frequency [Hz], NaN if unknown */
} wt_segment;

typedef struct wt_cantilever {
    double spring_constant;             /* [N/m], NaN if unknown */
    double sensitivity;                 /* deflection sensitivity InvOLS [m/V], NaN if unknown */
    bool spring_constant_is_overridden; /* the user's value replaces (or supplies) that of the file
                                         */
    bool sensitivity_is_overridden;
} wt_cantilever;

/* The segments of one position. A zero-initialised curve is empty. A reader reuses the memory of a
 * curve. */
typedef struct wt_force_curve {
    size_t index;        /* number in the file as the file counts, else from 0 */
    double x, y;         /* lateral position [m], NaN if unknown */
    long grid_x, grid_y; /* position in the grid, -1 if none */
    wt_cantilever cantilever;
    size_t n_segments;
    wt_segment *segments;
    size_t capacity; /* segments allocated; internal to wt_force_curve_* */
} wt_force_curve;

WT_API void
wt_force_curve_clear(wt_force_curve *curve); /* Frees all memory; the curve is empty again. */
/* Adds a segment of n_points samples and n_channels channels. Values are allocated, not
 * initialised. The pointer is valid until the next segment is added; NULL when out of memory.
 * Memory of a curve that was emptied by wt_force_curve_reset is reused. */
WT_API wt_segment *wt_force_curve_add_segment(wt_force_curve *curve, wt_segment_kind kind,
                                              size_t n_points, size_t n_channels);
/* Empties a curve but keeps its memory: no segments, index 0, position, grid and cantilever
 * unknown. */
WT_API void wt_force_curve_reset(wt_force_curve *curve);
WT_API const wt_channel *wt_segment_channel(const wt_segment *segment, wt_quantity quantity);
/* Returns the first segment of a kind, NULL if there is none. */
WT_API const wt_segment *wt_force_curve_segment(const wt_force_curve *curve, wt_segment_kind kind);

/* ---- image -------------------------------------------------------------------------------- */

/* A height map or another image channel; row 0 is the bottom line, values row by row. */
typedef struct wt_image {
    char name[64];
    char unit[32]; /* SI unit of the values */
    size_t n_columns, n_rows;
    double width, height; /* [m]; for a spectrum of one row `width` is its range in x_unit */
    double x_min, y_min;
    char x_unit[32];
    double *values; /* [n_rows * n_columns] */
} wt_image;
WT_API void wt_image_clear(wt_image *image);

/* Heights on a grid [m], row by row, NaN where missing. One row is a profile. Coordinates start at
 * the first point. */
typedef struct wt_height_map {
    const double *z; /* [ny * nx] borrowed */
    size_t nx, ny;
    double dx, dy; /* spacing [m]; dy is NaN for a profile */
} wt_height_map;
/* Returns the heights of an image in metres, borrowed from the image. */
WT_API wt_height_map wt_image_height_map(const wt_image *image);

/* ---- DMA ---------------------------------------------------------------------------------- */

typedef enum wt_deformation { WT_TENSION, WT_SHEAR } wt_deformation; /* E or G */

/* Test method of the isotherms of a sweep. */
typedef enum wt_loading { WT_OSCILLATION, WT_RELAXATION, WT_CREEP } wt_loading;

/* One temperature of a sweep, points in order of rising frequency. A modulus that was not measured
 * is NaN at all points. For a step of strain (relaxation) or stress (creep), angular_frequency
 * contains 1/t. storage_modulus then contains E(t) or 1/D(t), in shear G(t) or 1/J(t), so that it
 * rises with 1/t. */
typedef struct wt_isotherm {
    double temperature;        /* mean of the points, else the nominal temperature [K] */
    double temperature_spread; /* standard deviation of the points [K], NaN if not measured */
    size_t n;
    double *angular_frequency; /* [n] rad/s */
    double *storage_modulus;   /* [n] Pa, as measured: E' or G' */
    double *loss_modulus;      /* [n] Pa */
    double *strain;            /* [n] or NULL */
    char source[128];          /* file and step of origin */
    double stated_log_a;       /* log10 of the stated horizontal shift */
    bool shift_is_stated; /* the horizontal shift is stated: it is used, not fitted, up to a common
                         factor */
    bool vertical_shift_is_stated; /* with shift_is_stated: the vertical shift is stated, too */
    double *loss_factor;           /* [n] if measured without a modulus, else NULL */
    char *sample;                  /* name of the sample in the file; NULL if none */
    double stated_log_b;           /* log10 of the stated vertical shift */
} wt_isotherm;

/* Moduli against temperature at one frequency, in one heating or cooling. */
typedef struct wt_ramp {
    double angular_frequency; /* mean of the points [rad/s] */
    size_t n;
    double *temperature;     /* [n] rising [K] */
    double *storage_modulus; /* [n] Pa, as measured: E' or G' */
    double *loss_modulus;    /* [n] Pa */
    char source[128];        /* file and step of origin */
    double *strain;          /* [n] or NULL */
    double *loss_factor;     /* [n] if measured without a modulus, else NULL */
    char *sample;            /* as in wt_isotherm */
} wt_ramp;

/* Moduli against strain amplitude at one frequency and temperature, in one rising or falling sweep.
 */
typedef struct wt_strain_sweep {
    double angular_frequency; /* mean of the points [rad/s] */
    double
        temperature; /* mean of the points, else as stated by header or user [K]; NaN if unknown */
    size_t n;
    double *strain;          /* [n] rising */
    double *storage_modulus; /* [n] Pa, as measured: E' or G' */
    double *loss_modulus;    /* [n] Pa */
    char source[128];        /* file and step of origin */
    char *sample;            /* as in wt_isotherm */
} wt_strain_sweep;

/* Isotherms in the order of rising temperature (equal temperatures stay separate), temperature
 * sweeps in the order of rising frequency, strain sweeps in that of temperature and frequency. */
typedef struct wt_sweep {
    wt_deformation deformation;
    wt_loading loading; /* of all isotherms; a sweep of step tests has no other sweeps */
    size_t n_isotherms;
    wt_isotherm *isotherms;
    size_t n_ramps;
    wt_ramp *ramps;
    size_t n_strain_sweeps;
    wt_strain_sweep *strain_sweeps;
} wt_sweep;
WT_API void wt_sweep_clear(wt_sweep *sweep);
/* Optional arrays of a sweep. */
enum { WT_SWEEP_HAS_STRAIN = 1, WT_SWEEP_HAS_LOSS_FACTOR = 2 };
/* Appends an isotherm with uninitialised arrays of n points; NULL when out of memory. `with` is a
 * combination of the flags above. After the last one, wt_sweep_sort orders the isotherms by
 * temperature (then by source) and the points of each by frequency. */
WT_API wt_isotherm *wt_sweep_add(wt_sweep *sweep, size_t n, unsigned with);
WT_API void wt_sweep_sort(wt_sweep *sweep);
/* Appends a temperature sweep; wt_sweep_sort orders its points by temperature. */
WT_API wt_ramp *wt_sweep_add_ramp(wt_sweep *sweep, size_t n, unsigned with);
/* Appends a strain sweep; wt_sweep_sort orders its points by strain. */
WT_API wt_strain_sweep *wt_sweep_add_strain_sweep(wt_sweep *sweep, size_t n);
/* Removes exact duplicates of isotherms, points and other sweeps from a sorted sweep, with a
 * warning for each. A duplicate is the same file under two names or a table pasted twice: a
 * repeated measurement would differ. */
WT_API void wt_sweep_remove_duplicates(wt_sweep *sweep, wt_log *log);
/* Removes the sweeps of other samples. WT_E_NOT_FOUND if none remains. */
WT_API wt_status wt_sweep_select_sample(wt_sweep *sweep, const char *name) WT_NODISCARD;

/* ---- power spectrum ----------------------------------------------------------------------- */

typedef enum wt_spectrum_kind { WT_SPECTRUM_2D, WT_SPECTRUM_1D } wt_spectrum_kind; /* m^4 | m^3 */

typedef struct wt_power_spectrum {
    wt_spectrum_kind kind;
    size_t n;
    double *wavenumber; /* [n] rad/m, rising */
    double *density;    /* [n] C(q): m^4 (2D: h_rms^2 = 2 pi int q C dq) or m^3 (1D) */
} wt_power_spectrum;
WT_API void wt_power_spectrum_clear(wt_power_spectrum *spectrum);

/* ---- thermal noise ------------------------------------------------------------------------ */

/* One-sided power spectrum of the deflection of a free cantilever with the instrument's metadata.
 * NaN = not stated. */
typedef struct wt_noise_spectrum {
    bool volts; /* true: detector signal [V]; false: deflection [m] */
    size_t n;
    double *frequency;         /* [n] Hz, rising */
    double *density;           /* [n] m^2/Hz or V^2/Hz; NaN: not measured */
    double averages;           /* number of averaged spectra */
    double temperature;        /* [K] */
    double spring_constant;    /* [N/m] */
    double resonance, quality; /* [Hz], 1 */
    double sensitivity;        /* [m/V] */
    bool amplitudes; /* the file contains amplitude densities; `density` has their squares */
} wt_noise_spectrum;
WT_API void wt_noise_spectrum_clear(wt_noise_spectrum *spectrum);

/* ---- friction record ---------------------------------------------------------------------- */

typedef enum wt_record_channel {
    WT_RECORD_TIME,           /* [s]; continuous over the steps */
    WT_RECORD_DISTANCE,       /* [m] slid since the start */
    WT_RECORD_LAPS,           /* revolutions or double strokes since the start */
    WT_RECORD_POSITION,       /* [m] along the stroke */
    WT_RECORD_FRICTION_FORCE, /* [N], with the sign of the file */
    WT_RECORD_NORMAL_FORCE,   /* [N], positive when pressing */
    WT_RECORD_COEFFICIENT,    /* friction coefficient of the file */
    WT_RECORD_VELOCITY,       /* [m/s] */
    WT_RECORD_ROTATION,       /* [rad/s] of the disc */
    WT_RECORD_PRESSURE,       /* [Pa] nominal */
    WT_RECORD_TEMPERATURE,    /* [K] */
    WT_RECORD_WEAR_DEPTH,     /* [m] */
    WT_RECORD_CHANNELS
} wt_record_channel;

/* Record of a tribometer, sample by sample. The time steps need not be equal. */
typedef struct wt_record {
    size_t n;
    double *channel[WT_RECORD_CHANNELS]; /* [n], NaN: no value; NULL: not recorded */
    size_t *step;                        /* [n] step of the instrument, from 0 */
    double radius;                       /* stated radius of the track [m], NaN if unknown */
} wt_record;
WT_API void wt_record_clear(wt_record *record);

/* ---- Prony series ------------------------------------------------------------------------- */

/* M(w) = equilibrium + sum_k modulus[k] i w tau[k] / (1 + i w tau[k]) at one temperature. */
typedef struct wt_prony {
    wt_deformation deformation;   /* the moduli are E or G */
    double reference_temperature; /* [K], NaN if unknown */
    double equilibrium_modulus;   /* [Pa] */
    size_t n;
    double *relaxation_time;             /* [n] s, falling or rising, > 0 */
    double *modulus;                     /* [n] Pa, >= 0 */
    double frequency_min, frequency_max; /* measured range [rad/s], NaN if unknown */
} wt_prony;
WT_API void wt_prony_clear(wt_prony *prony);
/* Allocates n terms of zero in an empty series and sets unknown values to NaN. */
WT_API wt_status wt_prony_alloc(wt_prony *prony, size_t n, wt_error *err) WT_NODISCARD;

/* ---- table -------------------------------------------------------------------------------- */

/* A table: columns of equal length with units, and keys. All output of the program consists of
 * tables. */
typedef struct wt_table wt_table;

typedef enum wt_column_kind { WT_COLUMN_NUMBER, WT_COLUMN_TEXT } wt_column_kind;

/* Creates a table. name: [a-z0-9_]+ parts joined by '/', unique in a result ("indentation/bulk");
 * title: plain text. */
WT_API wt_table *wt_table_new(const char *name, const char *title); /* NULL when out of memory */
WT_API void wt_table_free(wt_table *table);
WT_API const char *wt_table_name(const wt_table *table);
WT_API const char *wt_table_title(const wt_table *table);
WT_API wt_status wt_table_rename(wt_table *table, const char *name, wt_error *err) WT_NODISCARD;

/* Adds a column; columns come before rows. name: letters, digits and '_', not "block". unit:
 * UDUNITS spelling of an SI unit, "1" for a number. The text arguments are copied. WT_E_ARG for an
 * invalid name or unit. */
WT_API wt_status wt_table_add_column(wt_table *table, const char *name, const char *unit,
                                     const char *long_name, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_table_add_text_column(wt_table *table, const char *name, const char *long_name,
                                          wt_error *err) WT_NODISCARD;
WT_API wt_status wt_table_add_row(wt_table *table,
                                  wt_error *err) WT_NODISCARD; /* Adds a row of NaN and "". */
WT_API size_t wt_table_n_rows(const wt_table *table);
WT_API size_t wt_table_n_columns(const wt_table *table);
WT_API wt_column_kind wt_table_column_kind(const wt_table *table, size_t column);
WT_API const char *wt_table_column_name(const wt_table *table, size_t column);
WT_API const char *wt_table_column_unit(const wt_table *table, size_t column); /* "" for text */
WT_API const char *wt_table_column_long_name(const wt_table *table, size_t column);
/* Returns the index of a column, -1 if it is missing. */
WT_API long wt_table_find(const wt_table *table, const char *column_name);
/* Sets a cell of the last row by column number. */
WT_API void wt_table_set_number(wt_table *table, size_t column, double value);
WT_API wt_status wt_table_set_text(wt_table *table, size_t column, const char *text,
                                   wt_error *err) WT_NODISCARD;
WT_API double wt_table_number(const wt_table *table, size_t row, size_t column);
WT_API const char *wt_table_text(const wt_table *table, size_t row, size_t column);
WT_API const double *wt_table_numbers(const wt_table *table, size_t column); /* [n_rows] */

/* Starts a new block of rows (a new curve, a new velocity). In the stream it is a blank line.
 * Blocks are never empty. wt_table_block returns the block of a row, from 0. */
WT_API wt_status wt_table_new_block(wt_table *table, wt_error *err) WT_NODISCARD;
WT_API size_t wt_table_block(const wt_table *table, size_t row);

/* Sets a key: one line of text. Keys keep their order; setting one again replaces it. key: letters,
 * digits and '_', no reserved word of the file formats ("table", "title", "column", ...), and not
 * an estimate key with "_standard_error", "_numerical_error" or "_units" appended; else WT_E_ARG.
 * The text of an estimate is "17.4 standard_error=0.3 numerical_error=0 unit=K". */
WT_API wt_status wt_table_set_key(wt_table *table, const char *key, const char *text,
                                  wt_error *err) WT_NODISCARD;
WT_API wt_status wt_table_set_estimate(wt_table *table, const char *key, wt_estimate estimate,
                                       wt_error *err) WT_NODISCARD;
WT_API size_t wt_table_n_keys(const wt_table *table);
WT_API const char *wt_table_key_name(const wt_table *table, size_t i);
WT_API const char *wt_table_key(const wt_table *table, const char *key); /* NULL if absent */
/* Reads an estimate key; false if it is missing. estimate->unit is borrowed from the table. */
WT_API bool wt_table_estimate(const wt_table *table, const char *key, wt_estimate *estimate);

/* ---- result ------------------------------------------------------------------------------- */

/* Result: the tables of one run with their provenance. It is the content of the HDF5 file and the
 * input of the report. */
typedef struct wt_result wt_result;
WT_API wt_result *wt_result_new(void); /* NULL when out of memory */
WT_API void wt_result_free(wt_result *result);
WT_API wt_status wt_result_add(wt_result *result, wt_table *table, wt_error *err)
    WT_NODISCARD; /* Takes ownership of the table, also on failure. */
WT_API size_t wt_result_n_tables(const wt_result *result);
WT_API const wt_table *wt_result_table(const wt_result *result, size_t i);
WT_API const wt_table *wt_result_find(const wt_result *result, const char *name); /* or NULL */
WT_API wt_provenance *wt_result_provenance(wt_result *result); /* Borrowed from the result. */
WT_API const wt_provenance *wt_result_provenance_const(const wt_result *result);
WT_API wt_status wt_result_set_case(wt_result *result, const char *xml, size_t length,
                                    wt_error *err) WT_NODISCARD; /* the case file, whole */
WT_API const char *wt_result_case(const wt_result *result, size_t *length); /* NULL if none */

/* Creates a table `name` of the inputs of a provenance: path, role, format, bytes [byte], sha256.
 */
WT_API wt_status wt_provenance_table(const wt_provenance *provenance, const char *name,
                                     wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- stream: weartrack-stream(5) ---------------------------------------------------------- */

/* Writes one table: `## key: value` lines, one header line, tab-separated rows, a blank line
 * between blocks, and a final line `##`. provenance NULL = none (byte-stable output). */
WT_API wt_status wt_stream_write(FILE *out, const wt_table *table, const wt_provenance *provenance,
                                 wt_error *err) WT_NODISCARD;
/* Reads the next table of a stream; WT_END if there is none. Errors show `name` and count lines
 * from the start of the table. WT_E_CORRUPT if a table with a `## table:` line does not end in
 * `##`: the file is truncated. */
WT_API wt_status wt_stream_read(FILE *in, const char *name, wt_table **table,
                                wt_error *err) WT_NODISCARD;

/* ---- for other programs ------------------------------------------------------------------- */

/* Export formats. TSV and CSV have one header line, name[unit]. JSON has keys, columns and rows.
 * STREAM is the text stream. SQLITE is a database with the table under its name, the units and
 * descriptions of columns in weartrack_columns and the keys in weartrack_keys; unknown values are
 * NULL. A table with several blocks has a first column "block".
 * In TSV and CSV an apostrophe precedes a text that a spreadsheet would evaluate (it begins with =
 * + - @ and is not a number), unless formulas are requested. */
typedef enum wt_export_form {
    WT_EXPORT_TSV,
    WT_EXPORT_CSV,
    WT_EXPORT_JSON,
    WT_EXPORT_STREAM,
    WT_EXPORT_SQLITE /* binary */
} wt_export_form;
WT_API wt_status wt_table_export(FILE *out, const wt_table *table, wt_export_form form,
                                 bool formulas, wt_error *err) WT_NODISCARD;
/* Creates the table "contents", a row for each table, or "keys", a row for each key. */
WT_API wt_status wt_result_contents(const wt_result *result, wt_table **contents,
                                    wt_error *err) WT_NODISCARD;
WT_API wt_status wt_table_keys(const wt_table *table, wt_table **keys, wt_error *err) WT_NODISCARD;
/* Completeness of a result. The values are exit statuses. */
typedef enum wt_result_status {
    WT_RESULT_COMPLETE = 0,
    WT_RESULT_EMPTY = 1,  /* no usable result */
    WT_RESULT_PARTIAL = 3 /* failed parts are missing */
} wt_result_status;
/* Collects the main numbers and verdicts of a result in a table "keys". */
WT_API wt_status wt_result_main_values(const wt_result *result, wt_table **headlines,
                                       wt_error *err) WT_NODISCARD;
/* Creates the table "summary" of n such tables: one row each, and a column for each key that
 * occurs. */
WT_API wt_status wt_summary_table(const char *const *files, const wt_table *const *headlines,
                                  size_t n, wt_table **summary, wt_error *err) WT_NODISCARD;

/* ---- store: weartrack-hdf5(5) ------------------------------------------------------------- */

/* Writes the result under a temporary name and renames it. Without with_provenance it has no
 * version, command and times (byte-stable tests). */
WT_API wt_status wt_store_write(const char *path, const wt_result *result, bool with_provenance,
                                wt_error *err) WT_NODISCARD;
/* Reads a result in a sandboxed process, as the file may be damaged or malicious:
 * weartrack-hdf5(5). */
WT_API wt_status wt_store_read(const char *path, wt_result **result, wt_error *err) WT_NODISCARD;
/* Reads a result from memory. Errors show `name`. */
WT_API wt_status wt_store_read_memory(const void *bytes, size_t length, const char *name,
                                      wt_result **result, wt_error *err) WT_NODISCARD;
/* Reads only the tables that wt_result_main_values uses. If the file has them appended at its end,
 * neither HDF5 nor a process is needed; tables whose keys suffice then have no rows. WT_E_FORMAT if
 * it is not an HDF5 file. */
WT_API wt_status wt_store_read_main_values(const char *path, wt_result **result,
                                           wt_error *err) WT_NODISCARD;

/* Writes a map of force curves to an HDF5 result curve by curve, so that memory hardly grows with
 * the map. The path is borrowed until the end. */
typedef struct wt_map_writer wt_map_writer;
WT_API wt_status wt_map_open(const char *path, wt_map_writer **writer, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_map_add_curve(wt_map_writer *writer, const wt_force_curve *curve,
                                  wt_error *err) WT_NODISCARD;
/* Adds the tables "force_map/..." to the result, writes it with the samples and renames the file.
 * Frees the writer. */
WT_API wt_status wt_map_commit(wt_map_writer *writer, wt_result *result, bool with_provenance,
                               wt_error *err) WT_NODISCARD;
WT_API void
wt_map_discard(wt_map_writer *writer); /* Removes the temporary file and frees. Accepts NULL. */

#ifdef __cplusplus
}
#endif
#endif
