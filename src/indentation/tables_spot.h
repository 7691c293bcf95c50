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
      NUMBER, LABEL("Limit"), SPARSE)

#define SPOT_KEYS(X)                                                                               \
    X(SPOT_KEY_TIP, AS(tip), TEXT)                                                                 \
    X(SPOT_KEY_IMAGE, AS(image), TEXT)                                                             \
    X(SPOT_KEY_EFFECT, "largest_effect", PLAIN, SHOWS(effect))                                     \
    X(SPOT_KEY_VERDICT, "roughness_verdict", TEXT, SHOWS(verdict), LABEL("Roughness"))

#endif
