/* Columns and keys of the tables of measured surfaces: power spectrum, angular spectrum, scans
 * and their spectra. Only core/table/registry.h includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_SURFACE_TABLES_H
#define WT_SURFACE_TABLES_H

/* Maximum correlation of each number in a chain with the next one, if it correlates with no
 * other. */
#define POWER_SPECTRUM_MAX_CORRELATION 0.5

/* Wavenumber and density have the column names that the reader of spectra expects. */
#define POWER_SPECTRUM_COLUMNS(X)                                                                  \
    X(POWER_SPECTRUM_WAVENUMBER, AS(wavenumber), "wavenumber q = 2 pi / wavelength",               \
      SI(WAVENUMBER), LABEL("Wavenumber"))                                                         \
    NUMBER_AND_INTERVAL(X, POWER_SPECTRUM_DENSITY, "density",                                      \
                        "two-dimensional power spectrum C(q), with h_rms^2 = 2 pi int q C dq",     \
                        SI(POWER_SPECTRUM_2D), "C(q)", SHOWS(density))                             \
    X(POWER_SPECTRUM_MODES_ERROR, AS(modes_error),                                                 \
      "standard error of ln C by the scatter of its modes", NUMBER, SPARSE)                        \
    X(POWER_SPECTRUM_MODES_TIE, AS(modes_tie),                                                     \
      "correlation of that scatter with that of the next row, which share modes by the window",    \
      NUMBER, OPTIONAL, SPARSE)                                                                    \
    X(POWER_SPECTRUM_LAW_ERROR, AS(law_error),                                                     \
      "of rows of the law: standard error of ln C by the constants of the law, all such rows "     \
      "together",                                                                                  \
      NUMBER, OPTIONAL, SPARSE)                                                                    \
    X(POWER_SPECTRUM_LAW, AS(self_affine), "the self-affine law that is fitted",                   \
      SI(POWER_SPECTRUM_2D), SPARSE)                                                               \
    X(POWER_SPECTRUM_MODES, AS(modes), "modes of the full plane in the bin", NUMBER, SPARSE)       \
    X(POWER_SPECTRUM_SCANS, AS(scans), "scans that they are of", NUMBER, SPARSE)                   \
    X(POWER_SPECTRUM_SOURCE, AS(source),                                                           \
      "measured; cut: between two bins, at an end that was asked for; law: beyond the reliable "   \
      "range, by the self-affine law",                                                             \
      TEXT)

#define POWER_SPECTRUM_KEYS(X)                                                                     \
    X(POWER_SPECTRUM_KEY_RMS_HEIGHT, AS(rms_height), SI(LENGTH),                                   \
      HEADLINE("Root-mean-square height of the surface"))                                          \
    X(POWER_SPECTRUM_KEY_RMS_SLOPE, AS(rms_slope), NUMBER,                                         \
      HEADLINE("Root-mean-square slope of the surface"))                                           \
    X(POWER_SPECTRUM_KEY_HURST, AS(hurst), NUMBER, LABEL("Hurst exponent"), OPTIONAL)              \
    X(POWER_SPECTRUM_KEY_HURST_LOW, AS(hurst_low), NUMBER,                                         \
      LABEL("Hurst exponent, 95 % interval from"), OPTIONAL)                                       \
    X(POWER_SPECTRUM_KEY_HURST_HIGH, AS(hurst_high), NUMBER, LABEL("to"), OPTIONAL)                \
    X(POWER_SPECTRUM_KEY_C0, AS(c0), SI(POWER_SPECTRUM_2D), LABEL("C₀"), OPTIONAL)                 \
    X(POWER_SPECTRUM_KEY_ROLL_OFF, AS(roll_off), SI(WAVENUMBER), LABEL("Roll-off wavenumber"),     \
      OPTIONAL)                                                                                    \
    X(POWER_SPECTRUM_KEY_ROLL_OFF_LOW, AS(roll_off_low), SI(WAVENUMBER),                           \
      LABEL("Roll-off wavenumber, 95 % interval from"), OPTIONAL)                                  \
    X(POWER_SPECTRUM_KEY_ROLL_OFF_HIGH, AS(roll_off_high), SI(WAVENUMBER), LABEL("to"), OPTIONAL)  \
    X(POWER_SPECTRUM_KEY_LAW, "law_verdict", TEXT, SHOWS(law), LABEL("Self-affine law"))           \
    X(POWER_SPECTRUM_KEY_FROM, AS(reliable_from), SI(WAVENUMBER), LABEL("Reliable from"))          \
    X(POWER_SPECTRUM_KEY_TO, AS(reliable_to), SI(WAVENUMBER), LABEL("Reliable to"))                \
    X(POWER_SPECTRUM_KEY_ENDS_BY, "reliable_ends_by", TEXT, SHOWS(ends_by))                        \
    X(POWER_SPECTRUM_KEY_STEEP, "steep_wavenumber", SI(WAVENUMBER), SHOWS(steep),                  \
      LABEL("Slope 1.3 reached at"), OPTIONAL)                                                     \
    X(POWER_SPECTRUM_KEY_STEEP_BY, AS(steep_by), TEXT)                                             \
    X(POWER_SPECTRUM_KEY_SHARE, AS(extrapolated_share), NUMBER,                                    \
      LABEL("Extrapolated share of the squared slope"), OPTIONAL)                                  \
    X(POWER_SPECTRUM_KEY_PLACES, AS(place_scatter), NUMBER,                                        \
      LABEL("Scatter from place to place, of ln C"), OPTIONAL)                                     \
    X(POWER_SPECTRUM_KEY_PLACES_ERROR, AS(place_error), NUMBER,                                    \
      LABEL("Standard error of ln C by it"), OPTIONAL)                                             \
    X(POWER_SPECTRUM_KEY_ANISOTROPY, AS(anisotropy), NUMBER, LABEL("Anisotropy"), OPTIONAL)        \
    X(POWER_SPECTRUM_KEY_DIRECTION, AS(anisotropy_direction), SI(ANGLE),                           \
      LABEL("Roughest direction from x"), OPTIONAL)                                                \
    X(POWER_SPECTRUM_KEY_FOURTH, AS(anisotropy_fourth), NUMBER, LABEL("Anisotropy of order 4"),    \
      OPTIONAL)                                                                                    \
    X(POWER_SPECTRUM_KEY_FOURTH_DIRECTION, AS(anisotropy_fourth_direction), SI(ANGLE),             \
      LABEL("Roughest direction of order 4 from x"), OPTIONAL)                                     \
    X(POWER_SPECTRUM_KEY_DIRECTIONS, "directions_verdict", TEXT, SHOWS(directions),                \
      LABEL("Directions"))                                                                         \
    X(POWER_SPECTRUM_KEY_PROFILES, AS(profiles), TEXT, LABEL("What the profiles add"), OPTIONAL)   \
    X(POWER_SPECTRUM_KEY_INCLUDES, "standard_error_includes", TEXT, SHOWS(includes),               \
      LABEL("Standard errors include"))                                                            \
    X(POWER_SPECTRUM_KEY_LACKS, "standard_error_excludes", TEXT, SHOWS(lacks),                     \
      LABEL("No error known of"), OPTIONAL)                                                        \
    X(POWER_SPECTRUM_KEY_OPTION, "roughness_option", TEXT, SHOWS(option), OPTIONAL)                \
    X(POWER_SPECTRUM_KEY_CONVENTION, "convention", TEXT, SHOWS(convention), OPTIONAL)              \
    X(POWER_SPECTRUM_KEY_N_SCANS, "n_scans", PLAIN, SHOWS(n_scans))

/* Place errors of the rows of the spectrum for each scan size. */
#define PLACE_ERRORS_COLUMNS(X)                                                                    \
    X(PLACE_ERRORS_SIZE, AS(size),                                                                 \
      "scans that are alike in size and points, counted from the widest", NUMBER)                  \
    X(PLACE_ERRORS_ROW, AS(row), "row of the table power_spectrum, from 1", NUMBER)                \
    X(PLACE_ERRORS_WAVENUMBER, AS(wavenumber), "its wavenumber", SI(WAVENUMBER),                   \
      LABEL("Wavenumber"))                                                                         \
    X(PLACE_ERRORS_ERROR, "places_error",                                                          \
      "standard error of ln C of the row by the places of these scans: all rows of a size "        \
      "together, those of another size by themselves",                                             \
      NUMBER, SHOWS(error))
#define PLACE_ERRORS_KEYS(X)

/* One direction in each row over half a turn; the other half is equal. */
#define ANGULAR_SPECTRUM_COLUMNS(X)                                                                \
    X(ANGULAR_SPECTRUM_DIRECTION, AS(direction), "direction of the wave vector, from x",           \
      SI(ANGLE), LABEL("Direction"))                                                               \
    NUMBER_AND_INTERVAL(                                                                           \
        X, ANGULAR_SPECTRUM_RATIO, "density_ratio",                                                \
        "C(q) there over that of all directions, the mean over the reliable range", NUMBER,        \
        "C(phi) / C", SHOWS(ratio))                                                                \
    X(ANGULAR_SPECTRUM_TERMS, AS(terms), "1 + a cos 2 (phi - t) + b cos 4 (phi - u), as fitted",   \
      NUMBER)                                                                                      \
    X(ANGULAR_SPECTRUM_MODES, AS(modes), "modes of the full plane there", NUMBER)
#define ANGULAR_SPECTRUM_KEYS(X)                                                                   \
    X(ANGULAR_SPECTRUM_KEY_CHANCE, "p_value", NUMBER, SHOWS(chance))                               \
    X(ANGULAR_SPECTRUM_KEY_CHANCE_FOURTH, AS(p_value_fourth), NUMBER)

/* Heights without their form, thinned for a figure. Scans are counted from 1 in the order of the
 * table surfaces. */
#define HEIGHT_MAP_COLUMNS(X)                                                                      \
    X(HEIGHT_MAP_SCAN, AS(scan), "row of the table surfaces", NUMBER)                              \
    X(HEIGHT_MAP_X, AS(x), "place along x, from the first point", SI(LENGTH))                      \
    X(HEIGHT_MAP_Y, AS(y), "place along y, likewise", SI(LENGTH))                                  \
    X(HEIGHT_MAP_HEIGHT, AS(height), "height less the form of the scan; missing: not a number",    \
      SI(LENGTH), SPARSE)
#define HEIGHT_MAP_KEYS(X)

/* The same heights along a line. A map uses its middle line. */
#define HEIGHT_PROFILE_COLUMNS(X)                                                                  \
    X(HEIGHT_PROFILE_SCAN, AS(scan), "row of the table surfaces", NUMBER)                          \
    X(HEIGHT_PROFILE_X, AS(x), "place along x, from the first point", SI(LENGTH))                  \
    X(HEIGHT_PROFILE_HEIGHT, AS(height),                                                           \
      "height less the form of the scan; missing: not a number", SI(LENGTH), SPARSE)
#define HEIGHT_PROFILE_KEYS(X)

/* One scan in each row. Slopes are forward differences of neighbours. */
#define SURFACES_COLUMNS(X)                                                                        \
    X(SURFACES_FILE, "file", "file of the scan", TEXT, SHOWS(name), LABEL("File"))                 \
    X(SURFACES_IMAGE, AS(image), "name of the image in it", TEXT)                                  \
    X(SURFACES_COLUMNS_N, "points_x", "points along x", NUMBER, SHOWS(map.nx))                     \
    X(SURFACES_ROWS_N, "points_y", "points along y; 1: a profile", NUMBER, SHOWS(map.ny))          \
    X(SURFACES_STEP_X, "step_x", "distance of points along x", SI(LENGTH), SHOWS(map.dx))          \
    X(SURFACES_STEP_Y, "step_y", "distance of points along y", SI(LENGTH), SHOWS(map.dy), SPARSE)  \
    X(SURFACES_MISSING, AS(missing_share), "share of the heights that are missing", NUMBER,        \
      LABEL("Missing"))                                                                            \
    X(SURFACES_RMS_HEIGHT, "rms_height", "root-mean-square height, Sq or Rq", SI(LENGTH),          \
      SHOWS(heights.rms), LABEL("Sq"))                                                             \
    X(SURFACES_MEAN_DEVIATION, "mean_deviation", "mean absolute height, Sa or Ra", SI(LENGTH),     \
      SHOWS(heights.mean_deviation), LABEL("Sa"))                                                  \
    X(SURFACES_PEAK_TO_VALLEY, "peak_to_valley", "highest peak to deepest valley, Sz", SI(LENGTH), \
      SHOWS(heights.peak_to_valley), LABEL("Sz"))                                                  \
    X(SURFACES_SKEWNESS, "skewness", "skewness of the heights, Ssk", NUMBER,                       \
      SHOWS(heights.skewness), LABEL("Ssk"))                                                       \
    X(SURFACES_KURTOSIS, "kurtosis", "kurtosis of the heights, Sku; 3 of Gaussian ones", NUMBER,   \
      SHOWS(heights.kurtosis), LABEL("Sku"))                                                       \
    X(SURFACES_RMS_SLOPE, "rms_slope",                                                             \
      "root-mean-square slope by forward differences of neighbours, Sdq", NUMBER,                  \
      SHOWS(heights.rms_slope), LABEL("Sdq"))                                                      \
    X(SURFACES_SLOPE_X, "slope_x", "its part along x", NUMBER, SHOWS(heights.slope_x))             \
    X(SURFACES_SLOPE_Y, "slope_y", "its part along y", NUMBER, SHOWS(heights.slope_y), SPARSE)     \
    X(SURFACES_AREA_EXCESS, "area_excess",                                                         \
      "area of the surface over its projection, less 1, by the same differences, Sdr", NUMBER,     \
      SHOWS(heights.area_excess), LABEL("Sdr"), SPARSE)                                            \
    X(SURFACES_FROM, "reliable_from", "first reliable wavenumber", SI(WAVENUMBER),                 \
      SHOWS(spectrum.from))                                                                        \
    X(SURFACES_TO, "reliable_to", "last reliable wavenumber", SI(WAVENUMBER), SHOWS(spectrum.to))  \
    X(SURFACES_ENDS_BY, "reliable_ends_by", "what ends it: points, or the tip", TEXT,              \
      SHOWS(spectrum.ends_by))                                                                     \
    X(SURFACES_ANISOTROPY, "anisotropy", "a of C(phi) = C (1 + a cos 2 (phi - direction))",        \
      NUMBER, SHOWS(directions.amplitude), LABEL("Anisotropy"), SPARSE)                            \
    X(SURFACES_DIRECTION, "anisotropy_direction", "where it is roughest, from x", SI(ANGLE),       \
      SHOWS(directions.direction), SPARSE)                                                         \
    X(SURFACES_CHANCE, "anisotropy_p", "chance of as much by scatter alone", NUMBER,               \
      SHOWS(directions.p_value), DIGITS(2), SPARSE)
#define SURFACES_KEYS(X)                                                                           \
    X(SURFACES_KEY_FORM, AS(form), TEXT)                                                           \
    X(SURFACES_KEY_WINDOW, AS(window), TEXT)

#endif
