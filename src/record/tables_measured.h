/* Columns and keys of measurements as `weartrack convert` writes them. Only the table registry
 * includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_RECORD_TABLES_MEASURED_H
#define WT_RECORD_TABLES_MEASURED_H

/* One column follows for each quantity of the file, named by its identifier. */
#define FORCE_CURVE_COLUMNS(X) X(FORCE_CURVE_SEGMENT, "segment", "kind of segment", TEXT)
#define FORCE_CURVE_KEYS(X)                                                                        \
    X(FORCE_CURVE_KEY_POSITION_X, "position_x", SI(POSITION_X), OPTIONAL)                          \
    X(FORCE_CURVE_KEY_POSITION_Y, "position_y", SI(POSITION_Y), OPTIONAL)                          \
    X(FORCE_CURVE_KEY_SPRING_CONSTANT, "spring_constant", SI(SPRING_CONSTANT), OPTIONAL)           \
    X(FORCE_CURVE_KEY_SENSITIVITY, "sensitivity", SI(SENSITIVITY), OPTIONAL)                       \
    X(FORCE_CURVE_KEY_CURVE, "curve", PLAIN)

/* Measured moduli in tension or in shear. */
#define SWEEP_COLUMNS(X)                                                                           \
    X(SWEEP_TEMPERATURE, "temperature", "temperature", SI(TEMPERATURE))                            \
    X(SWEEP_ANGULAR_FREQUENCY, "angular_frequency", "angular frequency", SI(ANGULAR_FREQUENCY),    \
      OPTIONAL, SPARSE)                                                                            \
    X(SWEEP_STORAGE_MODULUS, "storage_modulus", "tensile storage modulus E'", SI(STORAGE_MODULUS), \
      OPTIONAL, SPARSE)                                                                            \
    X(SWEEP_LOSS_MODULUS, "loss_modulus", "tensile loss modulus E''", SI(LOSS_MODULUS), OPTIONAL,  \
      SPARSE)                                                                                      \
    X(SWEEP_SHEAR_STORAGE_MODULUS, "shear_storage_modulus", "shear storage modulus G'",            \
      SI(SHEAR_STORAGE_MODULUS), OPTIONAL, SPARSE)                                                 \
    X(SWEEP_SHEAR_LOSS_MODULUS, "shear_loss_modulus", "shear loss modulus G''",                    \
      SI(SHEAR_LOSS_MODULUS), OPTIONAL, SPARSE)                                                    \
    X(SWEEP_STRAIN, "strain", "strain amplitude", SI(STRAIN), OPTIONAL, SPARSE)                    \
    X(SWEEP_LOSS_FACTOR, "loss_factor", "loss factor tan delta, where it was measured alone",      \
      SI(LOSS_FACTOR), OPTIONAL, SPARSE)                                                           \
    X(SWEEP_SAMPLE, "sample", "name of the sample", TEXT, OPTIONAL, SPARSE)                        \
    X(SWEEP_TIME, "time", "time after a step of strain or stress", SI(TIME), OPTIONAL, SPARSE)     \
    X(SWEEP_RELAXATION_MODULUS, "relaxation_modulus", "tensile relaxation modulus E(t)",           \
      SI(RELAXATION_MODULUS), OPTIONAL, SPARSE)                                                    \
    X(SWEEP_SHEAR_RELAXATION_MODULUS, "shear_relaxation_modulus", "shear relaxation modulus G(t)", \
      SI(SHEAR_RELAXATION_MODULUS), OPTIONAL, SPARSE)                                              \
    X(SWEEP_CREEP_COMPLIANCE, "creep_compliance", "tensile creep compliance D(t)",                 \
      SI(CREEP_COMPLIANCE), OPTIONAL, SPARSE)                                                      \
    X(SWEEP_SHEAR_CREEP_COMPLIANCE, "shear_creep_compliance", "shear creep compliance J(t)",       \
      SI(SHEAR_CREEP_COMPLIANCE), OPTIONAL, SPARSE)
#define SWEEP_KEYS(X)

/* Measured power spectrum of a surface or of a line. */
#define SPECTRUM_COLUMNS(X)                                                                        \
    X(SPECTRUM_WAVENUMBER, "wavenumber", "wavenumber", SI(WAVENUMBER))                             \
    X(SPECTRUM_DENSITY_2D, "power_spectrum_2d", "two-dimensional power spectrum C(q)",             \
      SI(POWER_SPECTRUM_2D), OPTIONAL)                                                             \
    X(SPECTRUM_DENSITY_1D, "power_spectrum_1d", "power spectrum of a line, C1(q)",                 \
      SI(POWER_SPECTRUM_1D), OPTIONAL)
#define SPECTRUM_KEYS(X)

/* The units and the label of the value are those of the image. A single line has no y. */
#define IMAGE_COLUMNS(X)                                                                           \
    X(IMAGE_X, "x", "first axis", UNIT("as measured"))                                             \
    X(IMAGE_Y, "y", "second axis", SI(LENGTH), OPTIONAL)                                           \
    X(IMAGE_VALUE, "value", "name of the image", UNIT("as measured"))
#define IMAGE_KEYS(X)

#endif
