/* Columns and keys of the table "spot": a position of a height image under a tip. Only
 * core/table/registry.h includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_INDENTATION_TABLES_SPOT_H
#define WT_INDENTATION_TABLES_SPOT_H

#define SPOT_COLUMNS(X)                                                                            \
    X(SPOT_X, AS(x), "place in the image", SI(POSITION_X), LABEL("x"))                             \
    X(SPOT_Y, AS(y), "place in the image", SI(POSITION_Y), LABEL("y"))                             \
    X(SPOT_INDENTATION, "indentation", "depth that the tip reached", SI(INDENTATION),              \
      SHOWS(depth), LABEL("Indentation"))                                                          \
    X(SPOT_CONTACT_RADIUS, "contact_radius", "of the tip at this depth", SI(LENGTH),               \
      SHOWS(spot.contact), LABEL("Contact radius"))                                                \
    X(SPOT_PIXELS, "pixels", "pixels within the contact radius", NUMBER, SHOWS(spot.plane.n),      \
      LABEL("Pixels"))                                                                             \
    X(SPOT_TILT, AS(tilt), "slope of the plane over the contact", NUMBER, LABEL("Slope"), SPARSE)  \
    X(SPOT_ROUGHNESS, AS(roughness), "rms height over the contact, less its plane", SI(LENGTH),    \
      LABEL("Roughness"), INTERVAL(SPOT_ROUGHNESS_LOW, SPOT_ROUGHNESS_HIGH), SPARSE)               \
    X(SPOT_ROUGHNESS_LOW, "roughness_low", "least within the error of the position", SI(LENGTH),   \
      SPARSE)                                                                                      \
    X(SPOT_ROUGHNESS_HIGH, "roughness_high", "largest within the error of the position",           \
      SI(LENGTH), SPARSE)                                                                          \
    X(SPOT_ROUGHNESS_MEDIAN, "roughness_median", "median of as large places all over the image",   \
      SI(LENGTH), SHOWS(spot.median), LABEL("Roughness elsewhere"), SPARSE)                        \
    X(SPOT_RATIO, AS(ratio), "roughness over indentation", NUMBER, LABEL("Roughness / depth"),     \
      INTERVAL(SPOT_RATIO_LOW, SPOT_RATIO_HIGH), SPARSE)                                           \
    X(SPOT_RATIO_LOW, "ratio_low", "least within the error of the position", NUMBER, SPARSE)       \
    X(SPOT_RATIO_HIGH, "ratio_high", "largest within the error of the position", NUMBER, SPARSE)   \
    X(SPOT_LIMIT, AS(limit), "ratio at which the contact area is uncertain by the largest effect", \
      NUMBER, LABEL("Limit"), SPARSE)                                                              \
    X(SPOT_SHIFT_X, AS(shift_x),                                                                   \
      "image after the indentation beside the one before, at the place", SI(LENGTH),               \
      LABEL("Drift x"), STANDARD_ERROR(SPOT_SHIFT_X), SPARSE)                                      \
    X(SPOT_SHIFT_X_STANDARD_ERROR, "shift_x_standard_error", "its standard error", SI(LENGTH),     \
      SPARSE)                                                                                      \
    X(SPOT_SHIFT_Y, AS(shift_y),                                                                   \
      "image after the indentation beside the one before, at the place", SI(LENGTH),               \
      LABEL("Drift y"), STANDARD_ERROR(SPOT_SHIFT_Y), SPARSE)                                      \
    X(SPOT_SHIFT_Y_STANDARD_ERROR, "shift_y_standard_error", "its standard error", SI(LENGTH),     \
      SPARSE)                                                                                      \
    X(SPOT_STRAIN, "shift_strain", "largest change of the shift along the image, per length",      \
      NUMBER, SHOWS(left.strain), LABEL("Change of the drift"), DIGITS(2), SPARSE)                 \
    X(SPOT_OVERLAP, IN(left.shift, overlap), "share of the image that is in the one after",        \
      NUMBER, LABEL("Overlap"), SPARSE)                                                            \
    NUMBER_AND_INTERVAL(X, SPOT_IMPRINT, "imprint", "mean depth of what stayed over the contact",  \
                        SI(LENGTH), "Residual imprint", SHOWS(left.depth))                         \
    NUMBER_AND_INTERVAL(X, SPOT_VOLUME, "imprint_volume",                                          \
                        "volume of what stayed within two contact radii", UNIT("m^3"),             \
                        "Volume of the imprint", SHOWS(left.volume))                               \
    X(SPOT_PLACES, AS(places), "untouched places by which the error of the imprint is known",      \
      NUMBER, LABEL("Places"), SPARSE)                                                             \
    X(SPOT_DEEPEST, IN(left, deepest), "largest imprint within the error of the position",         \
      SI(LENGTH), LABEL("Deepest near by"), SPARSE)                                                \
    X(SPOT_DEEPEST_X, AS(deepest_x), "where that is", SI(POSITION_X), SPARSE)                      \
    X(SPOT_DEEPEST_Y, AS(deepest_y), "where that is", SI(POSITION_Y), SPARSE)

#define SPOT_KEYS(X)                                                                               \
    X(SPOT_KEY_TIP, AS(tip), TEXT)                                                                 \
    X(SPOT_KEY_IMAGE, AS(image), TEXT)                                                             \
    X(SPOT_KEY_EFFECT, "largest_effect", PLAIN, SHOWS(effect))                                     \
    X(SPOT_KEY_VERDICT, "roughness_verdict", TEXT, SHOWS(verdict), LABEL("Roughness"))             \
    X(SPOT_KEY_IMPRINT, "imprint_verdict", TEXT, LABEL("Residual imprint"), OPTIONAL)

#define SPOT_MAP_COLUMNS(X)                                                                        \
    X(SPOT_MAP_X, AS(x), "from the place", SI(LENGTH))                                             \
    X(SPOT_MAP_Y, AS(y), "from the place", SI(LENGTH))                                             \
    X(SPOT_MAP_BEFORE, AS(before), "height before the indentation, less a plane", SI(LENGTH))      \
    X(SPOT_MAP_AFTER, AS(after), "height after it at the same place, less a plane", SI(LENGTH))    \
    X(SPOT_MAP_CHANGE, AS(change), "height after it less that before, less a plane", SI(LENGTH))

#define SPOT_MAP_KEYS(X) X(SPOT_MAP_KEY_CONTACT_RADIUS, "contact_radius", SI(LENGTH))

#endif
