/* weartrack - base: status, error, parse log, quantities and units, numbers, paths, output files,
 * digests, provenance, estimates and threads.
 *
 * Conventions of the whole library:
 * - All values are in SI units. A `double` has the SI unit of its quantity unless its name
 *   states another one.
 * - A function that can fail returns wt_status and has a wt_error as its last argument, which
 *   may be NULL. Outputs are unchanged on failure unless the comment states otherwise.
 * - The caller owns the result of a `_new` or `_open` function and frees it with the matching
 *   `_free` or `_close`, which accept NULL. A returned `const` pointer is borrowed from the object
 *   that was passed and is valid as long as that object is unchanged.
 * - The library never prints, never exits and never changes the locale.
 *
 * Compatibility between versions:
 * - While MAJOR is 0, a new MINOR may break programs. From 1 on, only a new MAJOR may. A new PATCH
 *   never does: it does not change structures and enumerations. The soname and the CMake package
 *   follow this rule: libweartrack.so.0.MINOR (later .MAJOR), find_package(weartrack 0.MINOR).
 *   A program needs a library that is at least as new as its headers.
 * - Initialise a structure with its `_defaults` function, or with zeros (`wt_tip tip = {0}`) if it
 *   has none. Name the members in initialisers. Members of later versions then have the value
 *   that preserves the old behaviour.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_BASE_H
#define WEARTRACK_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Version of the library. The build system reads it from here. */
#define WT_VERSION_MAJOR 0
#define WT_VERSION_MINOR 9
#define WT_VERSION_PATCH 0

#if defined(__GNUC__)
#define WT_API __attribute__((visibility("default")))
#define WT_NODISCARD __attribute__((warn_unused_result))
#define WT_PRINTF(fmt, args) __attribute__((format(printf, fmt, args)))
#else
#define WT_API
#define WT_NODISCARD
#define WT_PRINTF(fmt, args)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the version "MAJOR.MINOR.PATCH" of the running library. Static. */
WT_API const char *wt_version(void);

/* ---- status ------------------------------------------------------------------------------- */

/* One list defines the enumerators and their texts, so that they cannot disagree. */
#define WT_STATUS_LIST(X)                                                                          \
    X(WT_OK, "no error")                                                                           \
    X(WT_END, "no more items")                                                                     \
    X(WT_E_ARG, "invalid argument")                                                                \
    X(WT_E_MEMORY, "out of memory")                                                                \
    X(WT_E_IO, "input or output failed")                                                           \
    X(WT_E_NOT_FOUND, "not found")                                                                 \
    X(WT_E_FORMAT, "file format not recognised")                                                   \
    X(WT_E_AMBIGUOUS, "file format ambiguous")                                                     \
    X(WT_E_UNSUPPORTED, "file format recognised but not supported")                                \
    X(WT_E_CORRUPT, "file is damaged or inconsistent")                                             \
    X(WT_E_EMPTY, "no data")                                                                       \
    X(WT_E_UNIT, "unit missing, unknown or of another dimension")                                  \
    X(WT_E_MISSING, "required information is missing")                                             \
    X(WT_E_RANGE, "value outside its allowed range")                                               \
    X(WT_E_SCHEMA, "XML document does not follow its schema")                                      \
    X(WT_E_NO_OVERLAP, "curves do not overlap")                                                    \
    X(WT_E_CONVERGENCE, "no convergence")                                                          \
    X(WT_E_TOOL, "an external program failed")                                                     \
    X(WT_E_CANCELLED, "cancelled")                                                                 \
    X(WT_E_INTERNAL, "internal error")

typedef enum wt_status {
#define WT_STATUS_ENUM(name, text) name,
    WT_STATUS_LIST(WT_STATUS_ENUM)
#undef WT_STATUS_ENUM
} wt_status;

WT_API const char *
wt_status_text(wt_status status); /* Returns the text of a status, such as "no data". Static. */

/* ---- error -------------------------------------------------------------------------------- */

/* An error: message, location, expected and found values, and a remedy. It lives on the caller's
 * stack. Texts that do not fit are truncated at a whole UTF-8 character and end in "...". Unset
 * parts are empty strings. Initialise it with WT_ERROR_INIT. */
typedef struct wt_error {
    wt_status status;
    char message[256]; /* the error itself */
    char file[512];    /* name of the file; "" if none, "-" for standard input */
    char place[160]; /* location in the file: "line 12, column 3", "segments/0/channels/height.dat"
                      */
    char expected[192]; /* expected value or form */
    char found[192];    /* value found */
    char advice[256];   /* remedy */
} wt_error;

#define WT_ERROR_INIT                                                                              \
    {                                                                                              \
        WT_OK, "", "", "", "", "", ""                                                              \
    }

/* Starts an error: sets status and message and clears the other parts. Returns `status`. err may be
 * NULL. */
WT_API wt_status wt_fail(wt_error *err, wt_status status, const char *format, ...) WT_PRINTF(3, 4);
/* These functions complete an error. err may be NULL. wt_error_file does not replace a file that is
 * already set. */
WT_API void wt_error_file(wt_error *err, const char *file);
WT_API void wt_error_place(wt_error *err, const char *format, ...) WT_PRINTF(2, 3);
WT_API void wt_error_expected(wt_error *err, const char *format, ...) WT_PRINTF(2, 3);
WT_API void wt_error_found(wt_error *err, const char *format, ...) WT_PRINTF(2, 3);
WT_API void wt_error_advice(wt_error *err, const char *format, ...) WT_PRINTF(2, 3);
/* Formats an error as one line: "FILE: PLACE: MESSAGE; expected ...; found ...; ADVICE". Returns
 * the required length, as snprintf does. */
WT_API size_t wt_error_format(const wt_error *err, char *buffer, size_t size);

/* ---- parse log ---------------------------------------------------------------------------- */

/* Severity of a log entry. A note is shown on request, a warning always. A loss reports data of the
 * file that could not be read. */
typedef enum wt_severity { WT_NOTE, WT_WARNING, WT_LOSS } wt_severity;
WT_API const char *
wt_severity_name(wt_severity severity); /* Returns "note", "warning" or "loss". Static. */

typedef struct wt_log_entry {
    wt_severity severity;
    const char *file;  /* "" if none */
    const char *place; /* "" if none */
    const char *text;
    size_t
        count; /* number of entries with this text for this file; place is that of the first one */
} wt_log_entry;

/* Log of notes and warnings of reading and fitting. Equal texts for one file are counted, not
 * repeated. Only one thread at a time may use a log. */
typedef struct wt_log wt_log;

WT_API wt_log *wt_log_new(void); /* NULL when out of memory */
WT_API void wt_log_free(wt_log *log);
/* Adds an entry. log, file and place may be NULL. An entry that cannot be allocated is counted by
 * wt_log_dropped. */
WT_API void wt_log_add(wt_log *log, wt_severity severity, const char *file, const char *place,
                       const char *format, ...) WT_PRINTF(5, 6);
WT_API size_t
wt_log_count(const wt_log *log); /* Returns the number of distinct entries; 0 for NULL. */
WT_API wt_log_entry wt_log_get(const wt_log *log, size_t i);
WT_API size_t wt_log_dropped(const wt_log *log);

/* ---- quantities and units ----------------------------------------------------------------- */

/* Closed list of quantities: enumerator, identifier in files, SI unit (UDUNITS spelling),
 * description. */
#define WT_QUANTITY_LIST(X)                                                                        \
    X(WT_Q_NONE, "none", "1", "dimensionless number")                                              \
    X(WT_Q_TIME, "time", "s", "time")                                                              \
    X(WT_Q_HEIGHT, "height", "m", "piezo height as commanded")                                     \
    X(WT_Q_MEASURED_HEIGHT, "measured_height", "m", "height measured by a sensor")                 \
    X(WT_Q_DEFLECTION, "deflection", "m", "cantilever deflection")                                 \
    X(WT_Q_DEFLECTION_VOLTAGE, "deflection_voltage", "V", "deflection signal of the detector")     \
    X(WT_Q_FORCE, "force", "N", "force")                                                           \
    X(WT_Q_INDENTATION, "indentation", "m", "indentation depth")                                   \
    X(WT_Q_LATERAL_DEFLECTION, "lateral_deflection", "V", "lateral deflection signal")             \
    X(WT_Q_AMPLITUDE, "amplitude", "V", "oscillation amplitude")                                   \
    X(WT_Q_PHASE, "phase", "rad", "phase")                                                         \
    X(WT_Q_SPECTRAL_DENSITY, "spectral_density", "m.Hz^-0.5", "amplitude spectral density")        \
    X(WT_Q_POSITION_X, "position_x", "m", "lateral position x")                                    \
    X(WT_Q_POSITION_Y, "position_y", "m", "lateral position y")                                    \
    X(WT_Q_FREQUENCY, "frequency", "Hz", "frequency")                                              \
    X(WT_Q_ANGULAR_FREQUENCY, "angular_frequency", "rad/s", "angular frequency")                   \
    X(WT_Q_TEMPERATURE, "temperature", "K", "temperature")                                         \
    X(WT_Q_TEMPERATURE_DIFFERENCE, "temperature_difference", "K", "temperature difference")        \
    X(WT_Q_STORAGE_MODULUS, "storage_modulus", "Pa", "tensile storage modulus E'")                 \
    X(WT_Q_LOSS_MODULUS, "loss_modulus", "Pa", "tensile loss modulus E''")                         \
    X(WT_Q_SHEAR_STORAGE_MODULUS, "shear_storage_modulus", "Pa", "shear storage modulus G'")       \
    X(WT_Q_SHEAR_LOSS_MODULUS, "shear_loss_modulus", "Pa", "shear loss modulus G''")               \
    X(WT_Q_COMPLEX_MODULUS, "complex_modulus", "Pa",                                               \
      "absolute value of the complex tensile modulus")                                             \
    X(WT_Q_LOSS_FACTOR, "loss_factor", "1", "loss factor tan delta")                               \
    X(WT_Q_STRAIN, "strain", "1", "strain amplitude")                                              \
    X(WT_Q_STRESS, "stress", "Pa", "stress amplitude")                                             \
    X(WT_Q_MODULUS, "modulus", "Pa", "Young's modulus")                                            \
    X(WT_Q_LENGTH, "length", "m", "length")                                                        \
    X(WT_Q_WAVENUMBER, "wavenumber", "rad/m", "wavenumber")                                        \
    X(WT_Q_POWER_SPECTRUM_2D, "power_spectrum_2d", "m^4", "two-dimensional power spectrum C(q)")   \
    X(WT_Q_POWER_SPECTRUM_1D, "power_spectrum_1d", "m^3", "power spectrum of a line, C1(q)")       \
    X(WT_Q_PRESSURE, "pressure", "Pa", "nominal contact pressure")                                 \
    X(WT_Q_VELOCITY, "velocity", "m/s", "velocity")                                                \
    X(WT_Q_SPRING_CONSTANT, "spring_constant", "N/m", "spring constant of the cantilever")         \
    X(WT_Q_SENSITIVITY, "sensitivity", "m/V", "deflection sensitivity")                            \
    X(WT_Q_ANGLE, "angle", "rad", "angle")                                                         \
    X(WT_Q_WEAR_RATE, "specific_wear_rate", "m^2/N", "specific wear rate k")                       \
    X(WT_Q_ENERGY_DENSITY, "energy_density", "J/m^3", "energy per volume")                         \
    X(WT_Q_POWER_DENSITY, "power_density", "W/m^3", "power per volume")                            \
    X(WT_Q_RATE, "rate", "1/s", "rate")                                                            \
    X(WT_Q_DATA_SIZE, "data_size", "byte", "size of a file")                                       \
    X(WT_Q_SHEAR_COMPLEX_MODULUS, "shear_complex_modulus", "Pa",                                   \
      "absolute value of the complex shear modulus")                                               \
    X(WT_Q_DEFLECTION_NOISE, "deflection_noise", "m^2/Hz", "power spectral density of deflection") \
    X(WT_Q_VOLTAGE_NOISE, "voltage_noise", "V^2/Hz", "power spectral density of the detector")     \
    X(WT_Q_VOLTAGE_DENSITY, "voltage_density", "V.Hz^-0.5",                                        \
      "amplitude spectral density of the detector")                                                \
    X(WT_Q_MASS_DENSITY, "mass_density", "kg/m^3", "mass per volume")                              \
    X(WT_Q_THERMAL_EXPANSION, "thermal_expansion", "1/K", "coefficient of linear expansion")       \
    X(WT_Q_SURFACE_HEIGHT, "surface_height", "m", "height of a surface")                           \
    X(WT_Q_RELAXATION_MODULUS, "relaxation_modulus", "Pa", "tensile relaxation modulus E(t)")      \
    X(WT_Q_SHEAR_RELAXATION_MODULUS, "shear_relaxation_modulus", "Pa",                             \
      "shear relaxation modulus G(t)")                                                             \
    X(WT_Q_CREEP_COMPLIANCE, "creep_compliance", "1/Pa", "tensile creep compliance D(t)")          \
    X(WT_Q_SHEAR_CREEP_COMPLIANCE, "shear_creep_compliance", "1/Pa",                               \
      "shear creep compliance J(t)")                                                               \
    X(WT_Q_FRICTION_COEFFICIENT, "friction_coefficient", "1", "friction coefficient mu")           \
    X(WT_Q_FRICTION_FORCE, "friction_force", "N", "friction force, with its sign")                 \
    X(WT_Q_NORMAL_FORCE, "normal_force", "N", "load of a contact")                                 \
    X(WT_Q_SLIDING_DISTANCE, "sliding_distance", "m", "distance slid since the start")             \
    X(WT_Q_LAPS, "laps", "1", "revolutions or double strokes since the start")                     \
    X(WT_Q_WEAR_DEPTH, "wear_depth", "m", "depth that a contact has sunk in")                      \
    X(WT_Q_AREA, "area", "m^2", "area")                                                            \
    X(WT_Q_MASS, "mass", "kg", "mass")                                                             \
    X(WT_Q_HEAT_CAPACITY, "heat_capacity", "J/(m^3 K)", "heat capacity per volume")                \
    X(WT_Q_DIFFUSIVITY, "diffusivity", "m^2/s", "thermal diffusivity")                             \
    X(WT_Q_ENERGY, "energy", "J", "energy")                                                        \
    X(WT_Q_MOLAR_ENERGY, "molar_energy", "J/mol", "energy per mole")

typedef enum wt_quantity {
#define WT_QUANTITY_ENUM(name, id, unit, text) name,
    WT_QUANTITY_LIST(WT_QUANTITY_ENUM)
#undef WT_QUANTITY_ENUM
        WT_Q_COUNT
} wt_quantity;

typedef uint64_t wt_quantity_set; /* bit i = quantity i; the list has 64 entries at most */
#define WT_Q_BIT(q) ((wt_quantity_set)1 << (unsigned)(q))
#define WT_Q_ALL (~(wt_quantity_set)0)

WT_API const char *wt_quantity_id(wt_quantity quantity);   /* "force"; static */
WT_API const char *wt_quantity_unit(wt_quantity quantity); /* "N"; static */
/* Finds a quantity by its identifier; false if there is none. */
WT_API bool wt_quantity_find(const char *id, wt_quantity *quantity);

/* Returns the conversion of a unit to SI: x_si = factor * x + offset.
 * The unit may have any UDUNITS-2 spelling in UTF-8, also "%", "°C", "µm" and square brackets
 * around it; "" and "-" are the unit of a dimensionless quantity. WT_E_UNIT if the unit is unknown
 * or does not measure `quantity`. Hz and rad/s are never converted into each other; the reader
 * decides. 1/m counts as rad/m. Only a temperature has an offset. Thread-safe. UDUNITS-2 resolves
 * units that are not built in. Its scanner calls exit(2) when out of memory, so the command ends
 * before that. */
WT_API wt_status wt_unit_to_si(const char *unit, wt_quantity quantity, double *factor,
                               double *offset, wt_error *err) WT_NODISCARD;
/* Parses "0.4MPa", "20 degC", "35deg" or "1e-4 mm^3/(N m)" to SI. The unit is required unless the
 * quantity is dimensionless; the error shows the correct spelling. WT_E_ARG if the text is not a
 * number with a unit, WT_E_UNIT for a wrong unit, WT_E_RANGE for overflow or a temperature below
 * absolute zero. */
WT_API wt_status wt_quantity_parse(const char *text, wt_quantity quantity, double *value,
                                   wt_error *err) WT_NODISCARD;
/* Zero of the Celsius scale [K], by definition. */
#define WT_ZERO_CELSIUS 273.15
/* Formats a value of the SI unit `unit` as short text with an SI prefix: "412 kPa", "1.15 µm". For
 * the unit "degC" the value is in K and is shown in °C: "20.0 °C". digits = significant digits.
 * Returns the length as snprintf does. */
WT_API size_t wt_format_si(double value, const char *unit, int digits, char *buffer, size_t size);

/* ---- numbers ------------------------------------------------------------------------------ */

/* Parses exactly `length` bytes as a number, independent of the locale. `decimal` is '.' or ','.
 * Blanks around the number are ignored. Returns false if the bytes are not one finite number
 * ("nan", "inf", "--" and "" are not). */
WT_API bool wt_number_parse(const char *text, size_t length, char decimal, double *value);
/* Writes the shortest text that reads back to the same double; "nan", "inf" or "-inf" otherwise.
 * buffer has at least 32 bytes. Returns the length. */
WT_API size_t wt_number_format(double value, char *buffer);

/* ---- estimate ----------------------------------------------------------------------------- */

/* A reported number with its errors. An error that does not apply is 0; an unknown error is NaN. */
typedef struct wt_estimate {
    double value;
    double standard_error;  /* statistical: from fits and scatter */
    double numerical_error; /* numerical: from integration, interpolation, iteration */
    const char *unit;       /* SI unit, static text */
} wt_estimate;

/* A number with its 95 % interval. standard_error is half the width over 1.96. */
typedef struct wt_interval {
    double value, standard_error, low, high;
} wt_interval;

/* Parses "0.4MPa", "0.4MPa +- 0.02MPa" or "0.4MPa +- 5%" ("±" is accepted too). The part after +-
 * is one standard error; without it the standard error is 0 (not stated). */
WT_API wt_status wt_estimate_parse(const char *text, wt_quantity quantity, wt_estimate *estimate,
                                   wt_error *err) WT_NODISCARD;
/* Parses a list of values: "0.3m/s" | "1mm/s,1cm/s,0.3m/s" | "1e-4:10m/s:log:40" | "0:50s:lin:11".
 * The unit after the second number of a range holds for both. Values increase strictly. The caller
 * frees *values with free(). */
WT_API wt_status wt_list_parse(const char *text, wt_quantity quantity, double **values, size_t *n,
                               wt_error *err) WT_NODISCARD;

/* ---- parameters --------------------------------------------------------------------------- */

/* Parameters of an options structure such as wt_layer_job. Each is declared once with name,
 * quantity, limits and help, for the command line, case files, their documentation and calls from
 * C. A function such as wt_layer_job_params returns the table. The `_defaults` function initialises
 * the structure. */
typedef struct wt_param wt_param;
typedef struct wt_params wt_params;
WT_API size_t wt_params_count(const wt_params *params);
WT_API const wt_param *wt_params_get(const wt_params *params, size_t i); /* static */
/* Sets the parameter `name` from a user's text such as "0.4MPa +- 5%" and sets bit i of *given,
 * where i is the index in the table. Texts are borrowed. Lists are allocated; wt_params_clear frees
 * those marked in *given. WT_E_NOT_FOUND for an unknown name; other errors do not state the name.
 */
WT_API wt_status wt_params_set(const wt_params *params, const char *name, void *structure,
                               const char *text, uint64_t *given, wt_error *err) WT_NODISCARD;
WT_API void wt_params_clear(const wt_params *params, void *structure, uint64_t *given);
/* Formats the default, "0.5", or its description if there is no value, "the middle isotherm"; "" if
 * there is neither. Returns the length as snprintf does. */
WT_API size_t wt_params_default(const wt_params *params, size_t i, char *buffer, size_t size);

/* ---- paths, files ------------------------------------------------------------------------- */

/* Joins a folder and a name. Returns a new string, NULL when out of memory. An absolute `name` is
 * returned unchanged. */
WT_API char *wt_path_join(const char *folder, const char *name);
WT_API char *wt_path_folder(const char *path);     /* folder of a path, "." if none; new */
WT_API const char *wt_path_base(const char *path); /* name after the last '/'; borrowed */
/* Lists the files that match a shell pattern relative to `folder` (NULL = current), sorted
 * bytewise. A folder stands for its regular files that are not hidden. The paths begin with
 * `folder`. A pattern that equals the name of a file matches only that file. WT_E_NOT_FOUND if
 * nothing matches. Free the list with wt_strings_free. */
WT_API wt_status wt_glob(const char *folder, const char *pattern, char ***paths, size_t *n,
                         wt_error *err) WT_NODISCARD;
WT_API void wt_strings_free(char **strings, size_t n);

/* Output file that appears under its name only when it is complete. It is written in the same
 * folder under a temporary name and then renamed. It keeps the mode of the file it replaces.
 * Symbolic links are followed, also to a file that does not exist yet. A device or a pipe is
 * written directly. */
typedef struct wt_atomic_file wt_atomic_file;
WT_API wt_status wt_outfile_open(const char *path, wt_atomic_file **file,
                                 wt_error *err) WT_NODISCARD;
WT_API FILE *wt_outfile_stream(wt_atomic_file *file); /* borrowed */
/* Flushes, checks, renames and frees. On failure it removes the temporary file and frees `file`. */
WT_API wt_status wt_outfile_commit(wt_atomic_file *file, wt_error *err) WT_NODISCARD;
WT_API void
wt_outfile_discard(wt_atomic_file *file); /* Removes the temporary file and frees. Accepts NULL. */

/* After wt_protect_begin the library does not overwrite files that this process has read, standard
 * input included: outputs refuse them with WT_E_ARG. It also refuses files that are neither text
 * nor HDF5, such as instrument files. */
WT_API void wt_protect_begin(void);
WT_API wt_status wt_protect_input(const char *path, wt_error *err)
    WT_NODISCARD; /* Protects one more file; "-" is standard input. */
WT_API wt_status wt_check_overwrite(const char *path, wt_error *err)
    WT_NODISCARD; /* WT_E_ARG if the file is protected. */

/* Writes the SHA-256 digest as 64 hexadecimal digits with a terminating zero. */
WT_API void wt_sha256(const void *bytes, size_t length, char hex[65]);

/* ---- provenance --------------------------------------------------------------------------- */

typedef struct wt_provenance_input {
    const char *path;   /* as the user wrote it */
    const char *role;   /* "bulk", "track", "dma", "case", ... */
    const char *format; /* id of the reader or description, with its version */
    uint64_t bytes;
    char sha256[65];      /* "" if not requested */
    uint64_t fingerprint; /* hash of the bytes, equal for copies; 0 = unknown */
} wt_provenance_input;

typedef struct wt_provenance wt_provenance;
WT_API wt_provenance *wt_provenance_new(void); /* NULL when out of memory */
WT_API void wt_provenance_free(wt_provenance *p);
WT_API wt_status wt_provenance_set_command(wt_provenance *p, int argc,
                                           char *const argv[]) WT_NODISCARD;
WT_API wt_status wt_provenance_add_input(wt_provenance *p, const wt_provenance_input *input)
    WT_NODISCARD; /* Copies the input. */
/* Returns the version of the program that wrote the result: this one, unless a file was read.
 * Borrowed. */
WT_API const char *wt_provenance_version(const wt_provenance *p);
WT_API const char *wt_provenance_command(const wt_provenance *p); /* "" if not set; borrowed */
WT_API size_t wt_provenance_n_inputs(const wt_provenance *p);
WT_API const wt_provenance_input *wt_provenance_get_input(const wt_provenance *p, size_t i);

/* ---- threads and progress ----------------------------------------------------------------- */

/* Callback of long computations, never called by two threads at once. total 0 = unknown. Returning
 * false cancels the computation with WT_E_CANCELLED. */
typedef bool (*wt_progress_fn)(void *user, const char *what, size_t done, size_t total);

typedef struct wt_progress {
    wt_progress_fn report; /* NULL = none */
    void *user;
} wt_progress;

/* Runs body(user, i, worker) for i in [0, n) on up to `threads` threads (0 = one per processor).
 * worker < wt_thread_count(threads) identifies the thread, for scratch memory. Items must be
 * independent, so that the result does not depend on the number of threads. Every item runs; the
 * function returns the status that is not WT_OK of the lowest i. */
typedef wt_status (*wt_parallel_fn)(void *user, size_t i, unsigned worker);
WT_API unsigned wt_thread_count(unsigned threads);
WT_API wt_status wt_parallel_for(size_t n, unsigned threads, wt_parallel_fn body, void *user,
                                 const wt_progress *progress, const char *what) WT_NODISCARD;

/* HDF5 files are read in sandboxed processes. Returns the restrictions that this system could not
 * apply to them, as a sentence; NULL if all applied or no process has started yet. */
WT_API const char *wt_sandbox_limitations(void);

/* Wall and processor time of this process [s] since an arbitrary start. */
WT_API double wt_time_wall(void);
WT_API double wt_time_cpu(void);

/* ---- Student's t ----------------------------------------------------------------------------- */

/* Returns the 97.5 % quantile of Student's t: the half width of a 95 % interval in standard errors.
 * Infinite degrees of freedom are the normal distribution. */
WT_API double wt_student_quantile(double freedom);

#ifdef __cplusplus
}
#endif
#endif
