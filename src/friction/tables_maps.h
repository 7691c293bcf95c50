/* Columns and keys of the friction maps: temperature, pressure, decades of the wavenumber, sliding
 * direction. Included by core/table/registry.h only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_TABLES_MAPS_H
#define WT_FRICTION_TABLES_MAPS_H

#define FRICTION_MAP_COLUMNS(X)                                                                    \
    X(FRICTION_MAP_AGAINST, AS(against),                                                           \
      "what this row belongs to: the temperatures, at the nominal pressure, or the pressures, at " \
      "the nominal temperature",                                                                   \
      TEXT)                                                                                        \
    X(FRICTION_MAP_TEMPERATURE, AS(temperature), "temperature of the rubber", SI(TEMPERATURE))     \
    X(FRICTION_MAP_PRESSURE, AS(pressure), "nominal pressure", SI(PRESSURE))                       \
    X(FRICTION_MAP_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY))                       \
    X(FRICTION_MAP_REDUCED_VELOCITY, AS(reduced_velocity),                                         \
      "sliding velocity times the shift factor, at the reference temperature of the material",     \
      SI(VELOCITY))                                                                                \
    X(FRICTION_MAP_SHIFT_FACTOR, AS(shift_factor), "horizontal shift factor a_T", NUMBER)          \
    X(FRICTION_MAP_TOTAL, "friction",                                                              \
      "friction coefficient, hysteresis and shearing of the real contact", NUMBER, SHOWS(total),   \
      NUMERICAL_ERROR(FRICTION_MAP_TOTAL))                                                         \
    X(FRICTION_MAP_TOTAL_NUMERICAL_ERROR, "friction_numerical_error", "its numerical error",       \
      NUMBER)                                                                                      \
    X(FRICTION_MAP_HYSTERESIS, AS(hysteresis), "hysteresis friction", NUMBER,                      \
      NUMERICAL_ERROR(FRICTION_MAP_HYSTERESIS))                                                    \
    X(FRICTION_MAP_HYSTERESIS_NUMERICAL_ERROR, "hysteresis_numerical_error",                       \
      "its numerical error", NUMBER)                                                               \
    X(FRICTION_MAP_AREA_RATIO, AS(area_ratio), "real over nominal contact area", NUMBER,           \
      NUMERICAL_ERROR(FRICTION_MAP_AREA_RATIO))                                                    \
    X(FRICTION_MAP_AREA_RATIO_NUMERICAL_ERROR, "area_ratio_numerical_error",                       \
      "its numerical error", NUMBER)                                                               \
    X(FRICTION_MAP_EXTRAPOLATED_SHARE, AS(extrapolated_share),                                     \
      "share of the hysteresis from frequencies not measured", NUMBER)

#define FRICTION_MAP_KEYS(X)                                                                       \
    X(FRICTION_MAP_KEY_PRESSURE, AS(pressure), SI(PRESSURE), LABEL("Nominal pressure"))            \
    X(FRICTION_MAP_KEY_TEMPERATURE, AS(temperature), SI(TEMPERATURE),                              \
      LABEL("Nominal temperature"))                                                                \
    X(FRICTION_MAP_KEY_REFERENCE_TEMPERATURE, AS(reference_temperature), SI(TEMPERATURE),          \
      LABEL("Reference temperature of the shift factors"))                                         \
    X(FRICTION_MAP_KEY_SHEAR_STRESS, AS(shear_stress), SI(PRESSURE),                               \
      LABEL("Shear stress of the real contact"))                                                   \
    X(FRICTION_MAP_KEY_MATERIAL, AS(material), TEXT, LABEL("Material"))                            \
    X(FRICTION_MAP_KEY_MATERIAL_STATEMENT, "material_statement", TEXT, SHOWS(statement),           \
      LABEL("Beyond what was measured"), OPTIONAL)                                                 \
    X(FRICTION_MAP_KEY_NUMERICAL_STATEMENT, "numerical_statement", TEXT, SHOWS(numerical),         \
      LABEL("Numerical statement"), OPTIONAL)

#define FRICTION_DECADES_COLUMNS(X)                                                                \
    X(FRICTION_DECADES_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY))                   \
    X(FRICTION_DECADES_FROM, AS(from), "first wavenumber of the decade", SI(WAVENUMBER))           \
    X(FRICTION_DECADES_TO, AS(to), "last wavenumber of the decade", SI(WAVENUMBER))                \
    X(FRICTION_DECADES_HYSTERESIS, AS(hysteresis),                                                 \
      "hysteresis friction by the roughness between these wavenumbers", NUMBER,                    \
      NUMERICAL_ERROR(FRICTION_DECADES_HYSTERESIS))                                                \
    X(FRICTION_DECADES_HYSTERESIS_NUMERICAL_ERROR, "hysteresis_numerical_error",                   \
      "its numerical error", NUMBER)                                                               \
    X(FRICTION_DECADES_SHARE, AS(share), "its share of the hysteresis friction", NUMBER)           \
    X(FRICTION_DECADES_AREA_RATIO, AS(area_ratio),                                                 \
      "contact area seen with roughness up to the last wavenumber over the nominal area", NUMBER,  \
      NUMERICAL_ERROR(FRICTION_DECADES_AREA_RATIO))                                                \
    X(FRICTION_DECADES_AREA_RATIO_NUMERICAL_ERROR, "area_ratio_numerical_error",                   \
      "its numerical error", NUMBER)                                                               \
    X(FRICTION_DECADES_SHEARING, AS(shearing), "friction of shearing this contact area", NUMBER,   \
      OPTIONAL)                                                                                    \
    X(FRICTION_DECADES_TOTAL, "friction",                                                          \
      "friction coefficient if the roughness ended at the last wavenumber", NUMBER, SHOWS(total),  \
      OPTIONAL)
#define FRICTION_DECADES_KEYS(X)                                                                   \
    X(FRICTION_DECADES_KEY_STRONGEST, AS(strongest), TEXT, LABEL("Decade that makes the most"))

#define ANISOTROPY_COLUMNS(X)                                                                      \
    X(ANISOTROPY_VELOCITY, IN(with, velocity), "sliding velocity", SI(VELOCITY))                   \
    X(ANISOTROPY_HYSTERESIS, IN(with, hysteresis), "hysteresis friction", NUMBER,                  \
      NUMERICAL_ERROR(ANISOTROPY_HYSTERESIS))                                                      \
    X(ANISOTROPY_HYSTERESIS_NUMERICAL_ERROR, "hysteresis_numerical_error", "its numerical error",  \
      NUMBER)                                                                                      \
    X(ANISOTROPY_SIDE, "side",                                                                     \
      "force to the side over the load, against the side +90 deg from the velocity", NUMBER,       \
      SHOWS(with.lateral), NUMERICAL_ERROR(ANISOTROPY_SIDE))                                       \
    X(ANISOTROPY_SIDE_NUMERICAL_ERROR, "side_numerical_error", "its numerical error", NUMBER)      \
    X(ANISOTROPY_AREA_RATIO, IN(with, area_ratio), "real over nominal contact area", NUMBER,       \
      NUMERICAL_ERROR(ANISOTROPY_AREA_RATIO))                                                      \
    X(ANISOTROPY_AREA_RATIO_NUMERICAL_ERROR, "area_ratio_numerical_error", "its numerical error",  \
      NUMBER)                                                                                      \
    X(ANISOTROPY_HYSTERESIS_WITHOUT, "hysteresis_without",                                         \
      "hysteresis friction on roughness that is the same in all directions", NUMBER,               \
      SHOWS(without.hysteresis), NUMERICAL_ERROR(ANISOTROPY_HYSTERESIS_WITHOUT))                   \
    X(ANISOTROPY_HYSTERESIS_WITHOUT_NUMERICAL_ERROR, "hysteresis_without_numerical_error",         \
      "its numerical error", NUMBER)                                                               \
    X(ANISOTROPY_AREA_RATIO_WITHOUT, "area_ratio_without", "contact area on the same", NUMBER,     \
      SHOWS(without.area_ratio), NUMERICAL_ERROR(ANISOTROPY_AREA_RATIO_WITHOUT))                   \
    X(ANISOTROPY_AREA_RATIO_WITHOUT_NUMERICAL_ERROR, "area_ratio_without_numerical_error",         \
      "its numerical error", NUMBER)

#define ANISOTROPY_KEYS(X)                                                                         \
    X(ANISOTROPY_KEY_TEXTURE, AS(texture), TEXT, LABEL("Texture of the counter surface"))          \
    X(ANISOTROPY_KEY_SIDE, AS(side), NUMBER,                                                       \
      LABEL("Force to the side over the load, at the reference velocity"))                         \
    X(ANISOTROPY_KEY_EFFECT, AS(effect), TEXT, LABEL("What it does"))

#endif
