/* weartrack - data room: the types in which the other rooms meet, the text stream and the HDF5
 * store. Everything is in SI units; see base.h for ownership and errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WEARTRACK_DATA_H
#define WEARTRACK_DATA_H

#include "weartrack/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- force curves ------------------------------------------------------------------------- */

/* One column of a segment: SI values with what they measure and how the instrument called it. */
typedef struct wt_channel {
    wt_quantity quantity;
    char name[64];  /* as exported, UTF-8 */
    char unit[32];  /* as exported, before conversion; "" if the file does not say */
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

/* Samples in the order of time. */
typedef struct wt_segment {
    wt_segment_kind kind;
    size_t index;    /* number in the file, counted from 0 */
    size_t n_points; /* of every channel */
    size_t n_channels;
    wt_channel *channels;
    double duration;  /* [s] of n_points intervals: sample i is at duration i/n; NaN if unknown */
    double setpoint;  /* [N] or NaN */
    double velocity;  /* piezo velocity [m/s], NaN if unknown */
    double frequency; /* of a modulation [Hz] as the file says it, NaN if unknown */
} wt_segment;

typedef struct wt_cantilever {
    double spring_constant;     /* [N/m], NaN if unknown */
    double sensitivity;         /* deflection sensitivity InvOLS [m/V], NaN if unknown */
    bool spring_constant_given; /* the user's value replaced (or supplied) the file's */
    bool sensitivity_given;
} wt_cantilever;

/* The segments of one position. A zero-initialised curve is empty and may be given to a reader,
 * which reuses its memory from curve to curve. */
typedef struct wt_force_curve {
    size_t index;        /* number in its file, counted from 0; as the file counts if it does */
    double x, y;         /* lateral position [m], NaN if unknown */
    long grid_x, grid_y; /* place in the grid, -1 if none */
    wt_cantilever cantilever;
    size_t n_segments;
    wt_segment *segments;
    size_t capacity; /* segments allocated; private to wt_force_curve_* */
} wt_force_curve;

WT_API void wt_force_curve_clear(wt_force_curve *curve); /* frees all; the curve is empty again */
/* Makes room for one more segment of n_points samples and n_channels channels (values allocated,
 * not initialised) and returns it, valid until the next one is added; NULL when out of memory.
 * Reuses memory of a curve that was emptied by wt_force_curve_reset. */
WT_API wt_segment *wt_force_curve_add_segment(wt_force_curve *curve, wt_segment_kind kind,
                                              size_t n_points, size_t n_channels);
/* No segments, index 0, position, grid and cantilever unknown; memory kept. */
WT_API void wt_force_curve_reset(wt_force_curve *curve);
WT_API const wt_channel *wt_segment_channel(const wt_segment *segment, wt_quantity quantity);
/* First segment of a kind, NULL if there is none. */
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

/* Heights on a grid [m], row by row, NaN where missing; one row is a profile. Places are counted
 * from the first point. */
typedef struct wt_height_map {
    const double *z; /* [ny * nx] borrowed */
    size_t nx, ny;
    double dx, dy; /* between points [m]; dy NaN of a profile */
} wt_height_map;
/* The heights of an image in metres, borrowed from it. */
WT_API wt_height_map wt_height_map_of(const wt_image *image);

/* ---- DMA ---------------------------------------------------------------------------------- */

typedef enum wt_deformation { WT_TENSION, WT_SHEAR } wt_deformation; /* E or G */

/* What the isotherms of a sweep were measured by. */
typedef enum wt_loading { WT_OSCILLATION, WT_RELAXATION, WT_CREEP } wt_loading;

/* One temperature of a sweep, points in the order of rising frequency. A modulus that was not
 * measured is NaN at all points. Of a step of strain (relaxation) or stress (creep), 1/t stands in
 * the place of the angular frequency, and E(t), or 1/D(t), in that of the storage modulus (of shear
 * G(t), 1/J(t)), so that it rises like one. */
typedef struct wt_isotherm {
    double temperature;        /* mean of the points, or the nominal one if no column says [K] */
    double temperature_spread; /* standard deviation of the points [K], NaN if not measured */
    size_t n;
    double *angular_frequency; /* [n] rad/s */
    double *storage_modulus;   /* [n] Pa, as measured: E' or G' */
    double *loss_modulus;      /* [n] Pa */
    double *strain;            /* [n] or NULL */
    char source[128];          /* file and step it came from */
    double given_log_a;        /* log10 of the horizontal shift, if it is given */
    bool shift_given;          /* differences of given shifts count, and are not fitted */
    bool vertical_given;       /* with shift_given: so is the vertical shift */
    double *loss_factor;       /* [n] where it was measured without a modulus, else NULL */
    char *sample;              /* what it was measured on, as the file calls it; NULL: no name */
    double given_log_b;        /* log10 of the vertical shift, if it is given */
} wt_isotherm;

/* Moduli against temperature at one frequency, heated or cooled once. */
typedef struct wt_ramp {
    double angular_frequency; /* mean of the points [rad/s] */
    size_t n;
    double *temperature;     /* [n] rising [K] */
    double *storage_modulus; /* [n] Pa, as measured: E' or G' */
    double *loss_modulus;    /* [n] Pa */
    char source[128];        /* file and step it came from */
    double *strain;          /* [n] or NULL */
    double *loss_factor;     /* [n] where it was measured without a modulus, else NULL */
    char *sample;            /* as that of an isotherm */
} wt_ramp;

/* Moduli against the amplitude of the strain at one frequency and temperature, raised or lowered
 * once. */
typedef struct wt_strain_sweep {
    double angular_frequency; /* mean of the points [rad/s] */
    double temperature;       /* likewise, or what the header or the user says; NaN: unknown [K] */
    size_t n;
    double *strain;          /* [n] rising */
    double *storage_modulus; /* [n] Pa, as measured: E' or G' */
    double *loss_modulus;    /* [n] Pa */
    char source[128];        /* file and step it came from */
    char *sample;            /* as that of an isotherm */
} wt_strain_sweep;

/* Isotherms in the order of rising temperature (equal temperatures stay separate), temperature
 * sweeps in the order of rising frequency, strain sweeps in that of temperature and frequency. */
typedef struct wt_sweep {
    wt_deformation deformation;
    wt_loading loading; /* of the isotherms, all of them; there are no other sweeps beside a step */
    size_t n_isotherms;
    wt_isotherm *isotherms;
    size_t n_ramps;
    wt_ramp *ramps;
    size_t n_strain_sweeps;
    wt_strain_sweep *strain_sweeps;
} wt_sweep;
WT_API void wt_sweep_clear(wt_sweep *sweep);
/* Arrays that a sweep may have beside those of the moduli. */
enum { WT_WITH_STRAIN = 1, WT_WITH_LOSS_FACTOR = 2 };
/* Appends an isotherm with uninitialised arrays of n points; NULL when out of memory. Call
 * wt_sweep_sort when all are in: it orders the isotherms by temperature (then by source) and the
 * points of each by frequency. */
WT_API wt_isotherm *wt_sweep_add(wt_sweep *sweep, size_t n, unsigned with);
WT_API void wt_sweep_sort(wt_sweep *sweep);
/* The same for a temperature sweep; wt_sweep_sort orders its points by temperature. */
WT_API wt_ramp *wt_sweep_add_ramp(wt_sweep *sweep, size_t n, unsigned with);
/* The same for a strain sweep; wt_sweep_sort orders its points by strain. */
WT_API wt_strain_sweep *wt_sweep_add_strain_sweep(wt_sweep *sweep, size_t n);
/* Of a sorted sweep: takes out isotherms and their points, and other sweeps, that stand there twice
 * to the last bit, with a warning for each (the same file under two names, a table pasted twice):
 * measured again, they would differ. */
WT_API void wt_sweep_drop_copies(wt_sweep *sweep, wt_log *log);
/* Takes out the sweeps of other samples. WT_E_NOT_FOUND if none is left. */
WT_API wt_status wt_sweep_keep_sample(wt_sweep *sweep, const char *name) WT_NODISCARD;

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

/* One-sided power spectrum of the deflection of a lever at rest, and what the instrument says of
 * it; NaN: nothing. */
typedef struct wt_noise_spectrum {
    bool volts; /* of the detector, else deflection in metres */
    size_t n;
    double *frequency;         /* [n] Hz, rising */
    double *density;           /* [n] m^2/Hz or V^2/Hz; NaN: not measured */
    double averages;           /* spectra that were averaged */
    double temperature;        /* [K] */
    double spring_constant;    /* [N/m] */
    double resonance, quality; /* [Hz], 1 */
    double sensitivity;        /* [m/V] */
    bool amplitudes;           /* the file holds square roots, whose squares these are */
} wt_noise_spectrum;
WT_API void wt_noise_spectrum_clear(wt_noise_spectrum *spectrum);

/* ---- friction record ---------------------------------------------------------------------- */

typedef enum wt_record_channel {
    WT_RECORD_TIME,           /* [s]; runs on from step to step */
    WT_RECORD_DISTANCE,       /* [m] slid since the start */
    WT_RECORD_LAPS,           /* revolutions or double strokes since the start */
    WT_RECORD_POSITION,       /* [m] along the stroke */
    WT_RECORD_FRICTION_FORCE, /* [N], with the sign of the file */
    WT_RECORD_NORMAL_FORCE,   /* [N], positive when pressing */
    WT_RECORD_COEFFICIENT,    /* mu as the file says it */
    WT_RECORD_VELOCITY,       /* [m/s] */
    WT_RECORD_ROTATION,       /* [rad/s] of the disc */
    WT_RECORD_PRESSURE,       /* [Pa] nominal */
    WT_RECORD_TEMPERATURE,    /* [K] */
    WT_RECORD_WEAR_DEPTH,     /* [m] */
    WT_RECORD_CHANNELS
} wt_record_channel;

/* What a tribometer recorded, sample by sample. Nothing says that the samples have equal steps of
 * time. */
typedef struct wt_record {
    size_t n;
    double *channel[WT_RECORD_CHANNELS]; /* [n], NaN: no value; NULL: not recorded */
    size_t *step;                        /* [n] number of the step of the instrument, from 0 */
    double radius;                       /* of the track [m] as the file says, NaN */
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
/* Fills an empty series with n terms, all zero; what is not known is NaN. */
WT_API wt_status wt_prony_alloc(wt_prony *prony, size_t n, wt_error *err) WT_NODISCARD;

/* ---- table -------------------------------------------------------------------------------- */

/* Columns of equal length with units, and keys in front: what leaves the program is a table. */
typedef struct wt_table wt_table;

typedef enum wt_column_kind { WT_COLUMN_NUMBER, WT_COLUMN_TEXT } wt_column_kind;

/* name: [a-z0-9_]+ parts joined by '/', unique in a result ("indentation/bulk"); title: words. */
WT_API wt_table *wt_table_new(const char *name, const char *title); /* NULL when out of memory */
WT_API void wt_table_free(wt_table *table);
WT_API const char *wt_table_name(const wt_table *table);
WT_API const char *wt_table_title(const wt_table *table);
WT_API wt_status wt_table_rename(wt_table *table, const char *name, wt_error *err) WT_NODISCARD;

/* Columns are added before rows. name: letters, digits and '_', not "block". unit: UDUNITS spelling
 * of an SI unit, "1" for a number. The text arguments are copied. A wrong name or unit is WT_E_ARG.
 */
WT_API wt_status wt_table_add_column(wt_table *table, const char *name, const char *unit,
                                     const char *long_name, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_table_add_text_column(wt_table *table, const char *name, const char *long_name,
                                          wt_error *err) WT_NODISCARD;
WT_API wt_status wt_table_add_row(wt_table *table, wt_error *err) WT_NODISCARD; /* NaN and "" */
WT_API size_t wt_table_n_rows(const wt_table *table);
WT_API size_t wt_table_n_columns(const wt_table *table);
WT_API wt_column_kind wt_table_column_kind(const wt_table *table, size_t column);
WT_API const char *wt_table_column_name(const wt_table *table, size_t column);
WT_API const char *wt_table_column_unit(const wt_table *table, size_t column); /* "" for text */
WT_API const char *wt_table_column_long_name(const wt_table *table, size_t column);
/* Index of a column by name, or -1. */
WT_API long wt_table_find(const wt_table *table, const char *column_name);
/* Sets a cell of the last row by column number. */
WT_API void wt_table_put(wt_table *table, size_t column, double value);
WT_API wt_status wt_table_put_text(wt_table *table, size_t column, const char *text,
                                   wt_error *err) WT_NODISCARD;
WT_API double wt_table_number(const wt_table *table, size_t row, size_t column);
WT_API const char *wt_table_text(const wt_table *table, size_t row, size_t column);
WT_API const double *wt_table_numbers(const wt_table *table, size_t column); /* [n_rows] */

/* A block break: rows from here on belong to a new block (a new curve, a new velocity). In the
 * stream it is a blank line. A block without rows does not exist. wt_table_block(row) numbers the
 * blocks from 0. */
WT_API wt_status wt_table_new_block(wt_table *table, wt_error *err) WT_NODISCARD;
WT_API size_t wt_table_block(const wt_table *table, size_t row);

/* Keys: one line of text each, in the order they were set; setting again replaces. key: letters,
 * digits and '_', no word that the file formats use ("table", "title", "column", ...), not the name
 * of an estimate key with "_standard_error", "_numerical_error" or "_units"; else WT_E_ARG. The
 * text of an estimate is "17.4 standard_error=0.3 numerical_error=0 unit=K". */
WT_API wt_status wt_table_set_key(wt_table *table, const char *key, const char *text,
                                  wt_error *err) WT_NODISCARD;
WT_API wt_status wt_table_set_estimate(wt_table *table, const char *key, wt_estimate estimate,
                                       wt_error *err) WT_NODISCARD;
WT_API size_t wt_table_n_keys(const wt_table *table);
WT_API const char *wt_table_key_name(const wt_table *table, size_t i);
WT_API const char *wt_table_key(const wt_table *table, const char *key); /* NULL if absent */
/* Reads an estimate key; false if absent. estimate->unit is borrowed from the table. */
WT_API bool wt_table_estimate(const wt_table *table, const char *key, wt_estimate *estimate);

/* ---- result ------------------------------------------------------------------------------- */

/* Tables of one run with their provenance; what the HDF5 store holds and the report reads. */
typedef struct wt_result wt_result;
WT_API wt_result *wt_result_new(void); /* NULL when out of memory */
WT_API void wt_result_free(wt_result *result);
WT_API wt_status wt_result_add(wt_result *result, wt_table *table,
                               wt_error *err) WT_NODISCARD; /* takes the table, also on failure */
WT_API size_t wt_result_n_tables(const wt_result *result);
WT_API const wt_table *wt_result_table(const wt_result *result, size_t i);
WT_API const wt_table *wt_result_find(const wt_result *result, const char *name); /* or NULL */
WT_API wt_provenance *wt_result_provenance(wt_result *result); /* owned by the result */
WT_API const wt_provenance *wt_result_provenance_const(const wt_result *result);
WT_API wt_status wt_result_set_case(wt_result *result, const char *xml, size_t length,
                                    wt_error *err) WT_NODISCARD; /* the case file, whole */
WT_API const char *wt_result_case(const wt_result *result, size_t *length); /* NULL if none */

/* The inputs of a provenance as a table called `name`: path, role, format, bytes [byte], sha256. */
WT_API wt_status wt_provenance_table(const wt_provenance *provenance, const char *name,
                                     wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- stream: weartrack-stream(5) ---------------------------------------------------------- */

/* Writes one table: `## key: value` lines, one header line, tab-separated rows, a blank line
 * between blocks, a line `##` alone at its end. provenance NULL = none (byte-stable output). */
WT_API wt_status wt_stream_write(FILE *out, const wt_table *table, const wt_provenance *provenance,
                                 wt_error *err) WT_NODISCARD;
/* Reads the next table of a stream; WT_END when there is none. `name` is used in errors, in which
 * lines are counted from the start of the table. A table with a `## table:` line that does not end
 * in `##` was cut off: WT_E_CORRUPT. */
WT_API wt_status wt_stream_read(FILE *in, const char *name, wt_table **table,
                                wt_error *err) WT_NODISCARD;

/* ---- for other programs ------------------------------------------------------------------- */

/* Tab-separated and comma-separated cells under one header line, name[unit]; JSON with keys,
 * columns and rows; the text stream; an SQLite database with the table under its name, units and
 * words of its columns in the table weartrack_columns and its keys in weartrack_keys, where what is
 * not known is NULL. Where there are several blocks a column "block" is in front.
 * In the first two an apostrophe stands before a text that a spreadsheet would take for a formula
 * (it begins with = + - @ and is no number), unless formulas are wanted. */
typedef enum wt_export_form {
    WT_EXPORT_TSV,
    WT_EXPORT_CSV,
    WT_EXPORT_JSON,
    WT_EXPORT_STREAM,
    WT_EXPORT_SQLITE /* bytes */
} wt_export_form;
WT_API wt_status wt_table_export(FILE *out, const wt_table *table, wt_export_form form,
                                 bool formulas, wt_error *err) WT_NODISCARD;
/* Table "contents": a row for each table. Table "keys": a row for each key. */
WT_API wt_status wt_result_contents(const wt_result *result, wt_table **contents,
                                    wt_error *err) WT_NODISCARD;
WT_API wt_status wt_table_keys(const wt_table *table, wt_table **keys, wt_error *err) WT_NODISCARD;
/* How much of what was asked for a result answers, as the exit status says it. */
typedef enum wt_answered {
    WT_ANSWERED_WHOLE = 0,
    WT_ANSWERED_NOTHING = 1, /* nothing usable */
    WT_ANSWERED_PARTLY = 3   /* what failed is left out */
} wt_answered;
/* The main numbers and verdicts of a result, as a table "keys". */
WT_API wt_status wt_result_headlines(const wt_result *result, wt_table **headlines,
                                     wt_error *err) WT_NODISCARD;
/* Table "summary" of n of them: a row for each, a column for what one of them has. */
WT_API wt_status wt_summary(const char *const *files, const wt_table *const *headlines, size_t n,
                            wt_table **summary, wt_error *err) WT_NODISCARD;

/* ---- store: weartrack-hdf5(5) ------------------------------------------------------------- */

/* Writes the whole result under a temporary name, then renames. with_provenance false leaves out
 * version, command and times, for byte-stable tests. */
WT_API wt_status wt_store_write(const char *path, const wt_result *result, bool with_provenance,
                                wt_error *err) WT_NODISCARD;
/* A process of its own reads the file, which may be damaged or made to do harm: weartrack-hdf5(5).
 */
WT_API wt_status wt_store_read(const char *path, wt_result **result, wt_error *err) WT_NODISCARD;
/* `name` is used in errors. */
WT_API wt_status wt_store_read_memory(const void *bytes, size_t length, const char *name,
                                      wt_result **result, wt_error *err) WT_NODISCARD;
/* The tables alone that wt_result_headlines takes: from behind the end of the file without HDF5 and
 * without a process, where they stand there, without rows if their keys are enough. WT_E_FORMAT: it
 * is no HDF5 file. */
WT_API wt_status wt_store_read_headlines(const char *path, wt_result **result,
                                         wt_error *err) WT_NODISCARD;

/* A map of force curves in such a file: written curve by curve, so that memory hardly grows with
 * it. The path is borrowed until the end. */
typedef struct wt_map_writer wt_map_writer;
WT_API wt_status wt_map_begin(const char *path, wt_map_writer **writer, wt_error *err) WT_NODISCARD;
WT_API wt_status wt_map_put(wt_map_writer *writer, const wt_force_curve *curve,
                            wt_error *err) WT_NODISCARD;
/* Adds the tables "force_map/..." to the result, writes it with the samples beside them, then
 * renames. Frees the writer. */
WT_API wt_status wt_map_end(wt_map_writer *writer, wt_result *result, bool with_provenance,
                            wt_error *err) WT_NODISCARD;
WT_API void wt_map_discard(wt_map_writer *writer); /* leaves no file; accepts NULL */

#ifdef __cplusplus
}
#endif
#endif
