/* Columns and keys of the tables of the sliding contact: counter surface, friction, layer. Included
 * by core/table/registry.h only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_FRICTION_TABLES_H
#define WT_FRICTION_TABLES_H

/* Error sources that code asks for, in a list of those that an error lacks. The texts of others are
 * free. */
#define ERROR_SOURCES(X)                                                                           \
    X(SOURCE_MATERIAL, "material")                                                                 \
    X(SOURCE_TEMPERATURE, "temperature")                                                           \
    X(SOURCE_SHEAR_STRESS, "shear stress")                                                         \
    X(SOURCE_MODULUS_RATIO, "modulus ratio")

#define ROUGHNESS_COLUMNS(X)                                                                       \
    X(ROUGHNESS_WAVENUMBER, AS(wavenumber), "wavenumber", SI(WAVENUMBER))                          \
    X(ROUGHNESS_DENSITY, AS(density), "two-dimensional power spectrum C(q)", SI(POWER_SPECTRUM_2D))

/* The last three exist for a self-affine law only. */
#define ROUGHNESS_KEYS(X)                                                                          \
    X(ROUGHNESS_KEY_RMS_HEIGHT, "rms_height", SI(LENGTH), LABEL("Root-mean-square height"))        \
    X(ROUGHNESS_KEY_RMS_SLOPE, "rms_slope", NUMBER, LABEL("Root-mean-square slope"))               \
    X(ROUGHNESS_KEY_HURST, "hurst", PLAIN, LABEL("Hurst exponent"), OPTIONAL)                      \
    X(ROUGHNESS_KEY_C0, "c0", SI(POWER_SPECTRUM_2D), LABEL("C₀"), OPTIONAL)                        \
    X(ROUGHNESS_KEY_ROLL_OFF, "roll_off", SI(WAVENUMBER), LABEL("Roll-off wavenumber"), OPTIONAL)

#define FRICTION_COLUMNS(X)                                                                        \
    X(FRICTION_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY), LABEL("Velocity"))        \
    COLUMN_AND_ERRORS(X, FRICTION_TOTAL, "friction",                                               \
                      "friction coefficient, hysteresis and shearing of the real contact", NUMBER, \
                      "Total μ", SHOWS(total))                                                     \
    COLUMN_AND_ERRORS(X, FRICTION_HYSTERESIS, "hysteresis", "hysteresis friction", NUMBER,         \
                      "Hysteresis", SHOWS(hysteresis))                                             \
    X(FRICTION_ADHESION, AS(adhesion), "friction of shearing the real contact", NUMBER,            \
      LABEL("Shearing"))                                                                           \
    COLUMN_AND_ERRORS(X, FRICTION_AREA_RATIO, "area_ratio", "real over nominal contact area",      \
                      NUMBER, "A/A₀", SHOWS(area))                                                 \
    COLUMN_AND_ERROR(X, FRICTION_WITH_LAYER, "friction_with_layer",                                \
                     "friction coefficient with the modified layer", NUMBER, "With layer",         \
                     SHOWS(with_layer))                                                            \
    X(FRICTION_EXTRAPOLATED_SHARE, AS(extrapolated_share),                                         \
      "share of the hysteresis from frequencies not measured", NUMBER,                             \
      LABEL("Outside measured frequencies, share"))

/* The last keys exist with a layer only. */
#define FRICTION_KEYS(X)                                                                           \
    X(FRICTION_KEY_PRESSURE, AS(pressure), SI(PRESSURE), LABEL("Pressure"))                        \
    X(FRICTION_KEY_TEMPERATURE, AS(temperature), SI(TEMPERATURE), LABEL("Temperature"))            \
    X(FRICTION_KEY_SHEAR_STRESS, AS(shear_stress), SI(PRESSURE),                                   \
      LABEL("Shear stress of the real contact"))                                                   \
    X(FRICTION_KEY_GAMMA, AS(gamma), PLAIN, LABEL("Factor gamma of partial contact"))              \
    X(FRICTION_KEY_REFERENCE_VELOCITY, AS(reference_velocity), SI(VELOCITY),                       \
      LABEL("Reference velocity"))                                                                 \
    X(FRICTION_KEY_FRICTION, "friction_at_reference", NUMBER, SHOWS(total),                        \
      HEADLINE("Friction coefficient"))                                                            \
    X(FRICTION_KEY_HYSTERESIS, "hysteresis_at_reference", NUMBER, SHOWS(hysteresis),               \
      HEADLINE("Friction coefficient, hysteresis part"))                                           \
    X(FRICTION_KEY_SHEARING, "shearing_at_reference", NUMBER, SHOWS(shearing),                     \
      HEADLINE("Friction coefficient, shearing part"), OPTIONAL)                                   \
    X(FRICTION_KEY_AREA_RATIO, "area_ratio_at_reference", NUMBER, SHOWS(area),                     \
      HEADLINE("Real over nominal contact area"))                                                  \
    X(FRICTION_KEY_ERROR_INCLUDES, "standard_error_includes", TEXT, SHOWS(includes),               \
      LABEL("Standard errors include"))                                                            \
    X(FRICTION_KEY_ERROR_LACKS, "standard_error_excludes", ENUM(error_source), SHOWS(lacks),       \
      LABEL("No error known of"), OPTIONAL)                                                        \
    X(FRICTION_KEY_REPLICATES, AS(replicates), PLAIN, LABEL("Replicates"))                         \
    X(FRICTION_KEY_MATERIAL, AS(material), TEXT, LABEL("Material"), OPTIONAL)                      \
    X(FRICTION_KEY_MATERIAL_STATEMENT, "material_statement", TEXT, SHOWS(statement),               \
      LABEL("Material statement"), OPTIONAL)                                                       \
    X(FRICTION_KEY_SOFTENING, AS(softening), TEXT, LABEL("Softening with strain"), OPTIONAL)       \
    X(FRICTION_KEY_STRAIN, AS(strain), NUMBER, LABEL("Largest strain met"), OPTIONAL)              \
    X(FRICTION_KEY_NUMERICAL_STATEMENT, "numerical_statement", TEXT, SHOWS(numerical),             \
      LABEL("Numerical statement"), OPTIONAL)                                                      \
    X(FRICTION_KEY_FLASH, "flash_temperature", TEXT, SHOWS(flash), LABEL("Flash temperature"),     \
      OPTIONAL)                                                                                    \
    X(FRICTION_KEY_LAYER_THICKNESS, AS(layer_thickness), SI(LENGTH), LABEL("Layer thickness"),     \
      OPTIONAL)                                                                                    \
    X(FRICTION_KEY_LAYER_MODULUS_RATIO, AS(layer_modulus_ratio), NUMBER,                           \
      LABEL("Layer modulus ratio"), OPTIONAL)                                                      \
    X(FRICTION_KEY_LAYER_MODULI, AS(layer_moduli), TEXT, LABEL("Moduli of the layer"), OPTIONAL)   \
    X(FRICTION_KEY_LAYER_SLOPE, "layer_ratio_slope", NUMBER, SHOWS(layer_slope),                   \
      LABEL("Slope of the modulus ratio with the frequency"), OPTIONAL)                            \
    X(FRICTION_KEY_LAYER_OUTSIDE, "layer_outside_share", NUMBER, SHOWS(layer_outside),             \
      LABEL("Share of the hysteresis on the layer from frequencies at which it was not measured"), \
      OPTIONAL)                                                                                    \
    X(FRICTION_KEY_WITH_LAYER, "friction_with_layer_at_reference", NUMBER, SHOWS(with_layer),      \
      HEADLINE("Friction coefficient with layer"), OPTIONAL)                                       \
    X(FRICTION_KEY_CHANGE, "friction_change_at_reference", NUMBER, SHOWS(change),                  \
      HEADLINE("Change of friction by the layer"), OPTIONAL)                                       \
    X(FRICTION_KEY_RELATIVE_CHANGE, "relative_change_at_reference", NUMBER,                        \
      SHOWS(relative_change), HEADLINE("Relative change of friction by the layer"), OPTIONAL)      \
    X(FRICTION_KEY_RELATIVE_CHANGE_LOW, AS(relative_change_low), NUMBER,                           \
      LABEL("Relative change, lowest of all velocities"), OPTIONAL)                                \
    X(FRICTION_KEY_RELATIVE_CHANGE_HIGH, AS(relative_change_high), NUMBER,                         \
      LABEL("Relative change, highest of all velocities"), OPTIONAL)

#define TRANSVERSE_ISOTROPY_COLUMNS(X)                                                             \
    X(TRANSVERSE_ISOTROPY_FACTORS, AS(factors),                                                    \
      "which factors of the directions are kept: none (isotropic), loss, storage, both", TEXT)     \
    X(TRANSVERSE_ISOTROPY_VELOCITY, IN(point, velocity), "sliding velocity", SI(VELOCITY))         \
    X(TRANSVERSE_ISOTROPY_HYSTERESIS, IN(point, hysteresis), "hysteresis friction", NUMBER,        \
      NUMERICAL_ERROR(TRANSVERSE_ISOTROPY_HYSTERESIS))                                             \
    X(TRANSVERSE_ISOTROPY_HYSTERESIS_NUMERICAL_ERROR, "hysteresis_numerical_error",                \
      "its numerical error", NUMBER)                                                               \
    X(TRANSVERSE_ISOTROPY_AREA_RATIO, IN(point, area_ratio), "real over nominal contact area",     \
      NUMBER, NUMERICAL_ERROR(TRANSVERSE_ISOTROPY_AREA_RATIO))                                     \
    X(TRANSVERSE_ISOTROPY_AREA_RATIO_NUMERICAL_ERROR, "area_ratio_numerical_error",                \
      "its numerical error", NUMBER)

#define TRANSVERSE_ISOTROPY_KEYS(X)                                                                \
    X(TRANSVERSE_ISOTROPY_KEY_MATERIAL, "material", TEXT, LABEL("Material"))                       \
    X(TRANSVERSE_ISOTROPY_KEY_LOSS, "by_loss", TEXT, LABEL("The factors on E″ alone"), OPTIONAL)   \
    X(TRANSVERSE_ISOTROPY_KEY_STORAGE, "by_storage", TEXT, LABEL("The factors on E′ alone"),       \
      OPTIONAL)                                                                                    \
    X(TRANSVERSE_ISOTROPY_KEY_BOTH, "by_both", TEXT, LABEL("Both"), OPTIONAL)                      \
    X(TRANSVERSE_ISOTROPY_KEY_LEFT_OUT, "left_out", TEXT, LABEL("Not computed"), OPTIONAL)

#define SOFTENING_COLUMNS(X)                                                                       \
    X(SOFTENING_VELOCITY, IN(with, velocity), "sliding velocity", SI(VELOCITY))                    \
    X(SOFTENING_HYSTERESIS, IN(with, hysteresis), "hysteresis friction", NUMBER,                   \
      NUMERICAL_ERROR(SOFTENING_HYSTERESIS))                                                       \
    X(SOFTENING_HYSTERESIS_NUMERICAL_ERROR, "hysteresis_numerical_error", "its numerical error",   \
      NUMBER)                                                                                      \
    X(SOFTENING_HYSTERESIS_WITHOUT, "hysteresis_without", "hysteresis friction without softening", \
      NUMBER, SHOWS(without.hysteresis), NUMERICAL_ERROR(SOFTENING_HYSTERESIS_WITHOUT))            \
    X(SOFTENING_HYSTERESIS_WITHOUT_NUMERICAL_ERROR, "hysteresis_without_numerical_error",          \
      "its numerical error", NUMBER)                                                               \
    X(SOFTENING_AREA_RATIO, IN(with, area_ratio), "real over nominal contact area", NUMBER,        \
      NUMERICAL_ERROR(SOFTENING_AREA_RATIO))                                                       \
    X(SOFTENING_AREA_RATIO_NUMERICAL_ERROR, "area_ratio_numerical_error", "its numerical error",   \
      NUMBER)                                                                                      \
    X(SOFTENING_AREA_RATIO_WITHOUT, "area_ratio_without", "the same without softening", NUMBER,    \
      SHOWS(without.area_ratio), NUMERICAL_ERROR(SOFTENING_AREA_RATIO_WITHOUT))                    \
    X(SOFTENING_AREA_RATIO_WITHOUT_NUMERICAL_ERROR, "area_ratio_without_numerical_error",          \
      "its numerical error", NUMBER)                                                               \
    X(SOFTENING_SHARE_BELOW, "share_below",                                                        \
      "share of the hysteresis from strains below those of the table, where its first f and g "    \
      "hold",                                                                                      \
      NUMBER, SHOWS(below))                                                                        \
    X(SOFTENING_SHARE_ABOVE, "share_above",                                                        \
      "share of the hysteresis from strains above those of the table, where its last f and g "     \
      "hold",                                                                                      \
      NUMBER, SHOWS(above))

#define SOFTENING_KEYS(X)                                                                          \
    X(SOFTENING_KEY_SOURCE, AS(source), TEXT, LABEL("Softening with strain"))                      \
    X(SOFTENING_KEY_STRAIN_FACTOR, AS(strain_factor), PLAIN, LABEL("Strain over rms slope"))       \
    X(SOFTENING_KEY_STRAIN, AS(strain), NUMBER, LABEL("Largest strain met"))                       \
    X(SOFTENING_KEY_SHARE_ABOVE, AS(share_above), NUMBER,                                          \
      LABEL("Share of the hysteresis from strains above those known, largest"))                    \
    X(SOFTENING_KEY_UNKNOWN, "shares_unknown", TEXT, LABEL("Shares not known"), OPTIONAL)          \
    X(SOFTENING_KEY_EFFECT, AS(effect), TEXT, LABEL("What it does"))

#define FLASH_COLUMNS(X)                                                                           \
    X(FLASH_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY))                              \
    X(FLASH_TEMPERATURE, IN(with, temperature),                                                    \
      "temperature of the rubber at the finest scale of the contact", SI(TEMPERATURE),             \
      NUMERICAL_ERROR(FLASH_TEMPERATURE))                                                          \
    X(FLASH_TEMPERATURE_NUMERICAL_ERROR, "temperature_numerical_error", "its numerical error",     \
      SI(TEMPERATURE_DIFFERENCE))                                                                  \
    X(FLASH_HYSTERESIS, IN(with, hysteresis), "hysteresis friction", NUMBER,                       \
      NUMERICAL_ERROR(FLASH_HYSTERESIS))                                                           \
    X(FLASH_HYSTERESIS_NUMERICAL_ERROR, "hysteresis_numerical_error", "its numerical error",       \
      NUMBER)                                                                                      \
    X(FLASH_HYSTERESIS_WITHOUT, "hysteresis_without",                                              \
      "hysteresis friction of rubber at the temperature of its surroundings", NUMBER,              \
      SHOWS(without.hysteresis), NUMERICAL_ERROR(FLASH_HYSTERESIS_WITHOUT))                        \
    X(FLASH_HYSTERESIS_WITHOUT_NUMERICAL_ERROR, "hysteresis_without_numerical_error",              \
      "its numerical error", NUMBER)                                                               \
    X(FLASH_AREA_RATIO, IN(with, area_ratio), "real over nominal contact area", NUMBER,            \
      NUMERICAL_ERROR(FLASH_AREA_RATIO))                                                           \
    X(FLASH_AREA_RATIO_NUMERICAL_ERROR, "area_ratio_numerical_error", "its numerical error",       \
      NUMBER)                                                                                      \
    X(FLASH_AREA_RATIO_WITHOUT, "area_ratio_without", "the same without flash temperature",        \
      NUMBER, SHOWS(without.area_ratio), NUMERICAL_ERROR(FLASH_AREA_RATIO_WITHOUT))                \
    X(FLASH_AREA_RATIO_WITHOUT_NUMERICAL_ERROR, "area_ratio_without_numerical_error",              \
      "its numerical error", NUMBER)

#define FLASH_KEYS(X)                                                                              \
    X(FLASH_KEY_SURROUNDINGS, "surroundings", SI(TEMPERATURE), SHOWS(surroundings),                \
      LABEL("Temperature of the surroundings"))                                                    \
    X(FLASH_KEY_CONTACT_SIZE, AS(contact_size), SI(LENGTH),                                        \
      LABEL("Size of a macroscopic contact"))                                                      \
    X(FLASH_KEY_HEAT_CAPACITY, AS(heat_capacity), SI(HEAT_CAPACITY), LABEL("Heat capacity"))       \
    X(FLASH_KEY_DIFFUSIVITY, "heat_diffusivity", SI(DIFFUSIVITY), SHOWS(diffusivity),              \
      LABEL("Diffusivity of heat"))                                                                \
    X(FLASH_KEY_MACROSCOPIC, "macroscopic_area", PLAIN, SHOWS(macroscopic),                        \
      LABEL("Share of the area in macroscopic contacts"))                                          \
    X(FLASH_KEY_EFFECT, AS(effect), TEXT, LABEL("What it does"))                                   \
    X(FLASH_KEY_UNSETTLED, AS(unsettled), TEXT, LABEL("Without a solution"), OPTIONAL)             \
    X(FLASH_KEY_LAW_RANGE, AS(law_range), TEXT, LABEL("Shift law"), OPTIONAL)

#define CONTACT_AREA_COLUMNS(X)                                                                    \
    X(CONTACT_AREA_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY))                       \
    X(CONTACT_AREA_MAGNIFICATION, AS(magnification), "wavenumber over the smallest one", NUMBER)   \
    X(CONTACT_AREA_WAVENUMBER, AS(wavenumber), "wavenumber up to which roughness is seen",         \
      SI(WAVENUMBER))                                                                              \
    X(CONTACT_AREA_AREA_RATIO, IN(node, area_ratio),                                               \
      "contact area seen at this magnification over the nominal area", NUMBER)                     \
    X(CONTACT_AREA_HYSTERESIS, IN(node, hysteresis), "hysteresis friction up to this wavenumber",  \
      NUMBER)                                                                                      \
    X(CONTACT_AREA_ISOTROPIC, "isotropic_area_ratio",                                              \
      "contact area of the isotropic rubber, where the material is transversely isotropic",        \
      NUMBER, SPARSE, SHOWS(isotropic))
#define CONTACT_AREA_KEYS(X)

#define CRITICAL_ENERGY_ORIGINS(X)                                                                 \
    X(ENERGY_GIVEN, "given")                                                                       \
    X(ENERGY_CALIBRATED, "calibrated")

#define LAYER_COLUMNS(X)                                                                           \
    X(LAYER_TIME, AS(time), "time since the start", SI(TIME))                                      \
    COLUMN_AND_ERRORS(X, LAYER_THICKNESS, "thickness", "thickness of the modified layer",          \
                      SI(LENGTH), "Thickness", SHOWS(thickness))                                   \
    X(LAYER_FORMATION_RATE, AS(formation_rate), "rate of formation at this thickness",             \
      SI(VELOCITY))                                                                                \
    X(LAYER_WEAR_RATE, AS(wear_rate), "rate of wear", SI(VELOCITY))

#define LAYER_KEYS(X)                                                                              \
    X(LAYER_KEY_BALANCE_THICKNESS, "balance_thickness", SI(LENGTH),                                \
      HEADLINE("Layer thickness at balance"))                                                      \
    X(LAYER_KEY_WEAR_SENSITIVITY, "wear_sensitivity", NUMBER,                                      \
      LABEL("Relative change of the thickness per relative change of the wear rate"), OPTIONAL)    \
    X(LAYER_KEY_FORMATION_WEAR_RATIO, "formation_wear_ratio", NUMBER,                              \
      LABEL("Formation rate over wear rate, R"))                                                   \
    X(LAYER_KEY_INCUBATION_TIME, "incubation_time", SI(TIME), LABEL("Incubation time"))            \
    X(LAYER_KEY_RELAXATION_TIME, "relaxation_time", SI(TIME), LABEL("Relaxation time"))            \
    X(LAYER_KEY_CRITICAL_WEAR_RATE, "critical_specific_wear_rate", SI(WEAR_RATE),                  \
      LABEL("Critical specific wear rate"))                                                        \
    X(LAYER_KEY_CRITICAL_ENERGY, "critical_energy", SI(ENERGY_DENSITY), LABEL("Critical energy"))  \
    X(LAYER_KEY_SURFACE_POWER, "surface_power", UNIT("W/m^2"), LABEL("Surface power"))             \
    X(LAYER_KEY_TIME_TO_90_PERCENT, "time_to_90_percent", SI(TIME),                                \
      LABEL("Time to 90 % of the balance thickness"))                                              \
    X(LAYER_KEY_REGIME, AS(regime), ENUM(layer_regime), HEADLINE("Regime of the layer"))           \
    X(LAYER_KEY_VELOCITY, AS(velocity), SI(VELOCITY), LABEL("Velocity"))                           \
    X(LAYER_KEY_PRESSURE, AS(pressure), SI(PRESSURE), LABEL("Pressure"))                           \
    X(LAYER_KEY_WEAR_RATE, "specific_wear_rate", SI(WEAR_RATE), SHOWS(wear_rate),                  \
      LABEL("Specific wear rate"))                                                                 \
    X(LAYER_KEY_OBSERVED_THICKNESS, "observed_thickness", SI(LENGTH), SHOWS(observed),             \
      LABEL("Observed thickness"), OPTIONAL)                                                       \
    X(LAYER_KEY_CRITICAL_ENERGY_FROM, AS(critical_energy_from), ENUM(critical_energy_origin),      \
      LABEL("Critical energy from"))                                                               \
    X(LAYER_KEY_DUTY, AS(duty), PLAIN, LABEL("Duty"))                                              \
    X(LAYER_KEY_ERROR_INCLUDES, "standard_error_includes", TEXT, SHOWS(includes),                  \
      LABEL("Standard errors include"))                                                            \
    X(LAYER_KEY_ERROR_LACKS, "standard_error_excludes", ENUM(error_source), SHOWS(lacks),          \
      LABEL("No error known of"), OPTIONAL)                                                        \
    X(LAYER_KEY_MATERIAL_STATEMENT, "material_statement", TEXT, SHOWS(statement),                  \
      LABEL("Material statement"), OPTIONAL)                                                       \
    X(LAYER_KEY_SOFTENING, AS(softening), TEXT, LABEL("Softening with strain"), OPTIONAL)          \
    X(LAYER_KEY_ENERGY_FROM, AS(energy_from), TEXT, LABEL("What modifies the rubber"), OPTIONAL)   \
    X(LAYER_KEY_HYSTERESIS_POWER, AS(hysteresis_power), UNIT("W/m^2"),                             \
      LABEL("Power of hysteresis"), OPTIONAL)                                                      \
    X(LAYER_KEY_SHEAR_POWER, AS(shear_power), UNIT("W/m^2"),                                       \
      LABEL("Power of shearing the surface"), OPTIONAL)                                            \
    X(LAYER_KEY_NUMERICAL_STATEMENT, "numerical_statement", TEXT, SHOWS(numerical),                \
      LABEL("Numerical statement"), OPTIONAL)

#define ENERGY_DENSITY_COLUMNS(X)                                                                  \
    X(ENERGY_DENSITY_DEPTH, AS(depth), "depth below the surface", SI(LENGTH))                      \
    X(ENERGY_DENSITY_POWER, AS(energy_density), "power dissipated per volume", SI(POWER_DENSITY))
#define ENERGY_DENSITY_KEYS(X) X(ENERGY_DENSITY_KEY_VELOCITY, "velocity", SI(VELOCITY))

#define FRICTION_DECADES_COLUMNS(X)                                                                \
    X(FRICTION_DECADES_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY))                   \
    X(FRICTION_DECADES_FROM, AS(from), "first wavenumber of the decade", SI(WAVENUMBER))           \
    X(FRICTION_DECADES_TO, AS(to), "last wavenumber of the decade", SI(WAVENUMBER))                \
    X(FRICTION_DECADES_HYSTERESIS, AS(hysteresis),                                                 \
      "contribution of the roughness between these wavenumbers to the hysteresis friction",        \
      NUMBER, NUMERICAL_ERROR(FRICTION_DECADES_HYSTERESIS))                                        \
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

#endif
