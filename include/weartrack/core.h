/* weartrack - core: what all slices share. Status, error, log, quantities and units, numbers,
 * parameters, files, provenance, threads; the data that a reader returns; tables, results, the text
 * stream and the HDF5 store.
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
#ifndef WEARTRACK_CORE_H
#define WEARTRACK_CORE_H

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

/* ---- status --------------------------------------------------------------------------------- */

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

/* ---- memory --------------------------------------------------------------------------------- */

/* Called when an allocation of `size` bytes fails. It does not return; the process is aborted if it
 * does. It must not allocate. */
typedef void wt_memory_handler(size_t size);

/* Sets the handler and returns the former one. NULL stands for abort(), the initial handler.
 *
 * Small allocations, whose size follows from data in memory, call the handler. An allocation whose
 * size is stated by a file or by an option, before the data themselves are seen, returns
 * WT_E_MEMORY instead: the statement can be wrong, and the error names the file. */
WT_API wt_memory_handler *wt_memory_set_handler(wt_memory_handler *handler);
/* Allocates n zeroed items of `size` bytes. Never NULL. Free with free(). */
WT_API void *wt_alloc(size_t n, size_t size);
/* Resizes to n items of `size` bytes; new bytes are not set. Never NULL. */
WT_API void *wt_realloc(void *old, size_t n, size_t size);
/* Copies a text. Never NULL. Free with free(). */
WT_API char *wt_strdup(const char *text);
/* Copies the first n characters of a text, which has at least n. Never NULL. Free with free(). */
WT_API char *wt_strndup(const char *text, size_t n);

/* ---- error ---------------------------------------------------------------------------------- */

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
    char options[64];   /* options that the remedy names, without "--", separated by blanks */
} wt_error;

#define WT_ERROR_INIT                                                                              \
    {                                                                                              \
        WT_OK, "", "", "", "", "", "", ""                                                          \
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
WT_API void wt_error_options(wt_error *err, const char *format, ...) WT_PRINTF(2, 3);
/* Formats an error as one line: "FILE: PLACE: MESSAGE; expected ...; found ...; ADVICE". Returns
 * the required length, as snprintf does. */
WT_API size_t wt_error_format(const wt_error *err, char *buffer, size_t size);
/* True if a text equals one that was shown before (NULL: none), so that it is shown once. Nothing
 * else may follow from it: code depends on types, not on texts. */
WT_API bool wt_text_repeats(const char *text, const char *before);

/* ---- parse log ------------------------------------------------------------------------------ */

/* Severity of a log entry. A note is shown on request, a warning always. A loss reports data of the
 * file that could not be read. */
typedef enum wt_severity { WT_NOTE, WT_WARNING, WT_LOSS } wt_severity;
#define WT_SEVERITY_LIST(X) X(WT_NOTE, "note") X(WT_WARNING, "warning") X(WT_LOSS, "loss")
WT_API const char *
wt_severity_name(wt_severity severity); /* Returns "note", "warning" or "loss". Static. */

/* Subject of an entry, for code that acts on it. */
typedef enum wt_log_topic {
    WT_TOPIC_NONE,
    WT_TOPIC_WORST_LIMIT /* the first limit of the answers of a result, or what may be it */
} wt_log_topic;

/* What was done to data, or found in them, between reading and computing. */
typedef enum wt_action {
    WT_ACTION_NONE,
    WT_LEFT_OUT,     /* values, rows or a file do not count */
    WT_CORRECTED,    /* values were changed */
    WT_CONTRADICTED, /* two statements of one input disagree */
    WT_COPIED,       /* the data of another input, which count once */
    WT_IMPLAUSIBLE,  /* values that the quantity does not have; unchanged */
    WT_KEPT          /* all data count as they stand: what would be left out was not looked for */
} wt_action;
#define WT_ACTION_LIST(X)                                                                          \
    X(WT_ACTION_NONE, "none")                                                                      \
    X(WT_LEFT_OUT, "left out")                                                                     \
    X(WT_CORRECTED, "corrected")                                                                   \
    X(WT_CONTRADICTED, "contradicted")                                                             \
    X(WT_COPIED, "copied")                                                                         \
    X(WT_IMPLAUSIBLE, "implausible")                                                               \
    X(WT_KEPT, "kept")

typedef struct wt_log_entry {
    wt_severity severity;
    wt_log_topic topic;
    wt_action action;
    size_t n_values; /* number of values, rows or files that the action concerns; 0 unless known */
    const char *option; /* the option or case element that overrides the action; "" if none */
    const char *file;   /* "" if none */
    const char *place;  /* "" if none */
    const char *text;
    size_t
        count; /* number of entries with this text for this file; place is that of the first one */
    size_t like; /* index of the first entry with this severity and text, for any file */
} wt_log_entry;

/* Log of notes and warnings of reading and fitting. Equal texts for one file are counted, not
 * repeated. Only one thread at a time may use a log. */
typedef struct wt_log wt_log;

WT_API wt_log *wt_log_new(void);
WT_API void wt_log_free(wt_log *log);
/* Adds an entry. log, file and place may be NULL. */
WT_API void wt_log_add(wt_log *log, wt_severity severity, const char *file, const char *place,
                       const char *format, ...) WT_PRINTF(5, 6);
WT_API void wt_log_add_topic(wt_log *log, wt_severity severity, wt_log_topic topic,
                             const char *file, const char *place, const char *format, ...)
    WT_PRINTF(6, 7);
/* The option of actions that wt_read_options.conditioning overrides. */
#define WT_KEEP_OPTION "--conditioning keep"
/* Adds an entry of an action on data. n_values and option: see wt_log_entry; option may be NULL. */
WT_API void wt_log_action(wt_log *log, wt_severity severity, wt_action action, size_t n_values,
                          const char *option, const char *file, const char *place,
                          const char *format, ...) WT_PRINTF(8, 9);
/* Adds the entries of `from`. Texts begin with "PREFIX: " unless prefix is NULL. */
WT_API void wt_log_append(wt_log *to, const wt_log *from, const char *prefix);
WT_API size_t
wt_log_count(const wt_log *log); /* Returns the number of distinct entries; 0 for NULL. */
WT_API wt_log_entry wt_log_get(const wt_log *log, size_t i);

/* ---- quantities and units ------------------------------------------------------------------- */

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
    X(WT_Q_TORQUE, "torque", "N m", "torque of a friction force about the axis of a track")        \
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

/* ---- numbers -------------------------------------------------------------------------------- */

/* Parses exactly `length` bytes as a number, independent of the locale. `decimal` is '.' or ','.
 * Blanks around the number are ignored. A minus sign U+2212 or an en dash counts as "-". Returns
 * false if the bytes are not one finite number ("nan", "inf", "--" and "" are not). */
WT_API bool wt_number_parse(const char *text, size_t length, char decimal, double *value);
/* Writes the shortest text that reads back to the same double; "nan", "inf" or "-inf" otherwise.
 * buffer has at least 32 bytes. Returns the length. */
WT_API size_t wt_number_format(double value, char *buffer);

/* ---- estimate ------------------------------------------------------------------------------- */

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

/* Returns the 97.5 % quantile of Student's t: the half width of a 95 % interval in standard errors.
 * Infinite degrees of freedom are the normal distribution. */
WT_API double wt_student_quantile(double freedom);

/* Parses "0.4MPa", "0.4MPa +- 0.02MPa" or "0.4MPa +- 5%" ("±" is accepted too). The part after +-
 * is one standard error; without it the standard error is 0 (not stated). */
WT_API wt_status wt_estimate_parse(const char *text, wt_quantity quantity, wt_estimate *estimate,
                                   wt_error *err) WT_NODISCARD;
/* Parses a list of values: "0.3m/s" | "1mm/s,1cm/s,0.3m/s" | "1e-4:10m/s:log:40" | "0:50s:lin:11".
 * The unit after the second number of a range holds for both. Values increase strictly. The caller
 * frees *values with free(). */
WT_API wt_status wt_list_parse(const char *text, wt_quantity quantity, double **values, size_t *n,
                               wt_error *err) WT_NODISCARD;

/* ---- parameters ----------------------------------------------------------------------------- */

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
/* True for a parameter of yes or no whose default is yes. */
WT_API bool wt_params_default_flag(const wt_params *params, size_t i);

/* ---- paths, files --------------------------------------------------------------------------- */

/* Joins a folder and a name. Returns a new string. An absolute `name` is returned unchanged. */
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
WT_API void wt_protect_input(const char *path); /* Protects a file; "-" is standard input. */
WT_API wt_status wt_check_overwrite(const char *path, wt_error *err)
    WT_NODISCARD; /* WT_E_ARG if the file is protected. */

/* Writes the SHA-256 digest as 64 hexadecimal digits with a terminating zero. */
WT_API void wt_sha256(const void *bytes, size_t length, char hex[65]);

/* ---- provenance ----------------------------------------------------------------------------- */

/* What an input was used for: enum and text. Force curves are those of a group with a name. */
#define WT_INPUT_ROLE_LIST(X)                                                                      \
    X(WT_ROLE_INPUT, "input")                                                                      \
    X(WT_ROLE_CASE, "case")                                                                        \
    X(WT_ROLE_DMA, "dma")                                                                          \
    X(WT_ROLE_MATERIAL, "material")                                                                \
    X(WT_ROLE_SHIFTS, "shifts")                                                                    \
    X(WT_ROLE_SOFTENING, "softening")                                                              \
    X(WT_ROLE_ROUGHNESS, "roughness")                                                              \
    X(WT_ROLE_TOPOGRAPHY, "topography")                                                            \
    X(WT_ROLE_RECORD, "record")                                                                    \
    X(WT_ROLE_PROFILE, "profile")                                                                  \
    X(WT_ROLE_SPOT, "before")                                                                      \
    X(WT_ROLE_SENSITIVITY, "sensitivity")                                                          \
    X(WT_ROLE_OVERRIDES, "overrides")                                                              \
    X(WT_ROLE_LAYER_MODULUS, "modulus of the layer")                                               \
    X(WT_ROLE_LAYER_WEAR, "wear of the layer")                                                     \
    X(WT_ROLE_RESULT, "result")
typedef enum wt_input_role {
#define WT_INPUT_ROLE_ENUM(name, text) name,
    WT_INPUT_ROLE_LIST(WT_INPUT_ROLE_ENUM) WT_ROLE_GROUP
#undef WT_INPUT_ROLE_ENUM
} wt_input_role;

typedef struct wt_provenance_input {
    const char *path;       /* as the user wrote it */
    wt_input_role role;     /* what it was used for */
    const char *group;      /* "bulk", "track", ... of WT_ROLE_GROUP; "" otherwise */
    const char *format;     /* id of the reader or description, with its version */
    const char *instrument; /* as the file states it, and the title of the format; "" if unknown */
    uint64_t bytes;
    char sha256[65];      /* "" if not requested */
    uint64_t fingerprint; /* hash of the bytes, equal for copies; 0 = unknown */
    bool given_columns;   /* read by the columns that the caller named; false if read from a file */
} wt_provenance_input;

typedef struct wt_provenance wt_provenance;
WT_API wt_provenance *wt_provenance_new(void);
WT_API void wt_provenance_free(wt_provenance *p);
WT_API void wt_provenance_set_command(wt_provenance *p, int argc, char *const argv[]);
/* Copies the input. */
WT_API void wt_provenance_add_input(wt_provenance *p, const wt_provenance_input *input);
/* Returns the version of the program that wrote the result: this one, unless a file was read.
 * Borrowed. */
WT_API const char *wt_provenance_version(const wt_provenance *p);
WT_API const char *wt_provenance_command(const wt_provenance *p); /* "" if not set; borrowed */
WT_API size_t wt_provenance_n_inputs(const wt_provenance *p);
WT_API const wt_provenance_input *wt_provenance_get_input(const wt_provenance *p, size_t i);
/* Returns the text of the role, or the name of the group; borrowed. */
WT_API const char *wt_provenance_input_role(const wt_provenance_input *input);

/* ---- threads and progress ------------------------------------------------------------------- */

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

/* HDF5 files are read in confined processes, and Gwyddion and gnuplot are confined. Returns the
 * restrictions that this system could not apply to them, as a sentence that the thread keeps until
 * its next call; NULL if all applied or no process has started yet. */
WT_API const char *wt_sandbox_limitations(void);

/* Wall and processor time of this process [s] since an arbitrary start. */
WT_API double wt_time_wall(void);
WT_API double wt_time_cpu(void);

/* ---- force curves --------------------------------------------------------------------------- */

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
#define WT_SEGMENT_KIND_LIST(X)                                                                    \
    X(WT_SEGMENT_APPROACH, "approach")                                                             \
    X(WT_SEGMENT_RETRACT, "retract")                                                               \
    X(WT_SEGMENT_DWELL, "dwell")                                                                   \
    X(WT_SEGMENT_MODULATION, "modulation")                                                         \
    X(WT_SEGMENT_OTHER, "other")
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

/* ---- image ---------------------------------------------------------------------------------- */

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
    bool levelled; /* the mean of each row was subtracted: modes across the rows are unknown */
} wt_height_map;
/* Returns the heights of an image in metres, borrowed from the image. */
WT_API wt_height_map wt_image_height_map(const wt_image *image);

/* ---- DMA ------------------------------------------------------------------------------------ */

typedef enum wt_deformation { WT_TENSION, WT_SHEAR } wt_deformation; /* E or G */
#define WT_DEFORMATION_LIST(X) X(WT_TENSION, "tension") X(WT_SHEAR, "shear")

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
    bool shift_is_stated;  /* the horizontal shift is stated: it is used, not fitted, up to a common
                          factor */
    bool shift_is_by_hand; /* with shift_is_stated: the shift is against the isotherm nearest to the
                              reference temperature */
    bool vertical_shift_is_stated; /* with shift_is_stated: the vertical shift is stated, too */
    double *loss_factor;           /* [n] if measured without a modulus, else NULL */
    char *sample;                  /* name of the sample in the file; NULL if none */
    double stated_log_b;           /* log10 of the stated vertical shift */
    double *point_temperature;     /* [n] K, if the temperature drifts; else NULL */
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
enum { WT_SWEEP_HAS_STRAIN = 1, WT_SWEEP_HAS_LOSS_FACTOR = 2, WT_SWEEP_HAS_TEMPERATURE = 4 };
/* Appends an isotherm with arrays of n points; never NULL. `with` is a
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

/* ---- power spectrum ------------------------------------------------------------------------- */

typedef enum wt_spectrum_kind { WT_SPECTRUM_2D, WT_SPECTRUM_1D } wt_spectrum_kind; /* m^4 | m^3 */

typedef struct wt_power_spectrum {
    wt_spectrum_kind kind;
    size_t n;
    double *wavenumber; /* [n] rad/m, rising */
    double *density;    /* [n] C(q): m^4 (2D: h_rms^2 = 2 pi int q C dq) or m^3 (1D) */
} wt_power_spectrum;
WT_API void wt_power_spectrum_clear(wt_power_spectrum *spectrum);

/* ---- friction record ------------------------------------------------------------------------ */

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
    WT_RECORD_TORQUE,         /* [N m] of the friction force, if the file has no force */
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
/* Makes the torque the friction force on a track of a `radius` [m], unless the record has a force
 * or the radius is unknown (NaN). */
WT_API void wt_record_torque_to_force(wt_record *record, double radius);

/* ---- Prony series --------------------------------------------------------------------------- */

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
WT_API void wt_prony_alloc(wt_prony *prony, size_t n);

/* ---- table ---------------------------------------------------------------------------------- */

/* A table: columns of equal length with units, and keys. All output of the program consists of
 * tables. */
typedef struct wt_table wt_table;

typedef enum wt_column_kind { WT_COLUMN_NUMBER, WT_COLUMN_TEXT } wt_column_kind;

/* Creates a table. name: [a-z0-9_]+ parts joined by '/', unique in a result ("indentation/bulk");
 * title: plain text. */
WT_API wt_table *wt_table_new(const char *name, const char *title);
WT_API void wt_table_free(wt_table *table);
/* Frees the tables of a structure that has only tables as members, such as wt_ramp_tables, and sets
 * them to NULL. size: size of the structure. */
WT_API void wt_tables_clear(void *tables, size_t size);
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
WT_API void wt_table_set_text(wt_table *table, size_t column, const char *text);
WT_API double wt_table_number(const wt_table *table, size_t row, size_t column);
WT_API const char *wt_table_text(const wt_table *table, size_t row, size_t column);
WT_API const double *wt_table_numbers(const wt_table *table, size_t column); /* [n_rows] */

/* Starts a new block of rows (a new curve, a new velocity). In the stream it is a blank line.
 * Blocks are never empty. wt_table_block returns the block of a row, from 0. */
WT_API void wt_table_new_block(wt_table *table);
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

/* ---- result --------------------------------------------------------------------------------- */

/* Result: the tables of one run with their provenance. It is the content of the HDF5 file and the
 * input of the report. */
typedef struct wt_result wt_result;
WT_API wt_result *wt_result_new(void);
WT_API void wt_result_free(wt_result *result);
WT_API wt_status wt_result_add(wt_result *result, wt_table *table, wt_error *err)
    WT_NODISCARD; /* Takes ownership of the table, also on failure. */
WT_API size_t wt_result_n_tables(const wt_result *result);
WT_API const wt_table *wt_result_table(const wt_result *result, size_t i);
WT_API const wt_table *wt_result_find(const wt_result *result, const char *name); /* or NULL */
WT_API wt_provenance *wt_result_provenance(wt_result *result); /* Borrowed from the result. */
WT_API const wt_provenance *wt_result_provenance_const(const wt_result *result);
/* Sets the case file, whole. */
WT_API void wt_result_set_case(wt_result *result, const char *xml, size_t length);
WT_API const char *wt_result_case(const wt_result *result, size_t *length); /* NULL if none */

/* Creates a table `name` of the inputs of a provenance: path, role, format, bytes [byte], sha256.
 */
WT_API wt_status wt_provenance_table(const wt_provenance *provenance, const char *name,
                                     wt_table **table, wt_error *err) WT_NODISCARD;

/* ---- stream: weartrack-stream(5) ------------------------------------------------------------ */

/* Writes one table: `## key: value` lines, one header line, tab-separated rows, a blank line
 * between blocks, and a final line `##`. provenance NULL = none (byte-stable output). */
WT_API wt_status wt_stream_write(FILE *out, const wt_table *table, const wt_provenance *provenance,
                                 wt_error *err) WT_NODISCARD;
/* Reads the next table of a stream; WT_END if there is none. Errors show `name` and count lines
 * from the start of the table. WT_E_CORRUPT if a table with a `## table:` line does not end in
 * `##`: the file is truncated. */
WT_API wt_status wt_stream_read(FILE *in, const char *name, wt_table **table,
                                wt_error *err) WT_NODISCARD;

/* ---- for other programs --------------------------------------------------------------------- */

/* Export formats. TSV and CSV have one header line, name[unit]. JSON has keys, columns and rows.
 * STREAM is the text stream. A table with several blocks has a first column "block".
 * In TSV and CSV an apostrophe precedes a text that a spreadsheet would evaluate (it begins with =
 * + - @ and is not a number), unless formulas are requested. */
typedef enum wt_export_form {
    WT_EXPORT_TSV,
    WT_EXPORT_CSV,
    WT_EXPORT_JSON,
    WT_EXPORT_STREAM
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

/* ---- store: weartrack-hdf5(5) --------------------------------------------------------------- */

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

#ifdef __cplusplus
}
#endif
#endif
