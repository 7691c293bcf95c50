/* Columns and keys of the layer tables other than the thickness at constant load: bands,
 * running-in, balances with feedback, regime map. Included by core/table/registry.h only.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_LAYER_TABLES_H
#define WT_LAYER_TABLES_H

#define LAYER_BANDS_COLUMNS(X)                                                                     \
    X(LAYER_BANDS_TIME, AS(time), "time since the start", SI(TIME))                                \
    X(LAYER_BANDS_LOAD, AS(load), "load that lasts then, from 1 on", NUMBER)                       \
    X(LAYER_BANDS_WORN, AS(worn), "depth worn off until then", SI(LENGTH))                         \
    X(LAYER_BANDS_BAND, AS(band), "band, the deepest is 1; 0: nothing is modified", NUMBER)        \
    COLUMN_AND_NEW_ERRORS(X, LAYER_BANDS_UPPER, "upper",                                           \
                          "depth of its upper edge; 0: the surface", SI(LENGTH), SHOWS(upper))     \
    COLUMN_AND_NEW_ERRORS(X, LAYER_BANDS_LOWER, "lower", "depth of its lower edge", SI(LENGTH),    \
                          SHOWS(lower))                                                            \
    X(LAYER_BANDS_SHARE, AS(share),                                                                \
      "share of the replicates with as many bands then, of which the errors are", NUMBER,          \
      OPTIONAL)
#define LAYER_BANDS_KEYS(X)                                                                        \
    X(LAYER_BANDS_KEY_LOADS, AS(loads), TEXT, LABEL("Loads"))                                      \
    X(LAYER_BANDS_KEY_EVENTS, AS(events), TEXT, LABEL("How the modified rubber comes about"),      \
      OPTIONAL)                                                                                    \
    X(LAYER_BANDS_KEY_METHOD, AS(method), TEXT, LABEL("By"))                                       \
    X(LAYER_BANDS_KEY_FIRST, "onset_time", SI(TIME), SHOWS(first),                                 \
      LABEL("Time at which rubber is first modified"), OPTIONAL)                                   \
    X(LAYER_BANDS_KEY_FIRST_LOW, "first_appearance_low", SI(TIME), SHOWS(first_low),               \
      LABEL("Its 95 % interval from"), OPTIONAL)                                                   \
    X(LAYER_BANDS_KEY_FIRST_HIGH, "first_appearance_high", SI(TIME), SHOWS(first_high),            \
      LABEL("to"), OPTIONAL)                                                                       \
    X(LAYER_BANDS_KEY_KNOWN, "first_appearance_known", ENUM(stated_verdict), SHOWS(known),         \
      LABEL("Whether it is known within the errors"), OPTIONAL)                                    \
    X(LAYER_BANDS_KEY_THICKNESS, "last_thickness", SI(LENGTH), SHOWS(thickness),                   \
      LABEL("Depth of the modified rubber at the last time"), OPTIONAL)                            \
    X(LAYER_BANDS_KEY_ERRORS, AS(errors), TEXT, LABEL("Standard errors include"), OPTIONAL)

#define RUNNING_IN_COLUMNS(X)                                                                      \
    X(RUNNING_IN_TIME, AS(time), "time since the start", SI(TIME))                                 \
    COLUMN_AND_NEW_ERRORS(X, RUNNING_IN_THICKNESS, "thickness", "thickness of the modified layer", \
                          SI(LENGTH), SHOWS(thickness))                                            \
    COLUMN_AND_NEW_ERRORS(X, RUNNING_IN_HYSTERESIS, "hysteresis",                                  \
                          "hysteresis friction with this layer", NUMBER, SHOWS(hysteresis))        \
    COLUMN_AND_NEW_ERRORS(X, RUNNING_IN_AREA_RATIO, "area_ratio",                                  \
                          "real over nominal contact area with it", NUMBER, SHOWS(area_ratio))     \
    COLUMN_AND_NEW_ERROR(X, RUNNING_IN_SHEAR_STRESS, "shear_stress",                               \
                         "shear stress of the real contact with it", SI(PRESSURE),                 \
                         SHOWS(shear_stress))                                                      \
    COLUMN_AND_NEW_ERRORS(X, RUNNING_IN_FRICTION, "friction",                                      \
                          "friction coefficient; without a shear stress nan", NUMBER,              \
                          SHOWS(friction))
#define RUNNING_IN_KEYS(X)                                                                         \
    X(RUNNING_IN_KEY_VELOCITY, AS(velocity), SI(VELOCITY), LABEL("Velocity"))                      \
    X(RUNNING_IN_KEY_MODULUS_RATIO, AS(modulus_ratio), NUMBER,                                     \
      LABEL("Modulus of the layer over that of the bulk"), OPTIONAL)                               \
    X(RUNNING_IN_KEY_BARE, "bare_friction", NUMBER, SHOWS(bare),                                   \
      LABEL("Friction coefficient at the start"))                                                  \
    X(RUNNING_IN_KEY_BALANCE, "balance_friction", NUMBER, SHOWS(balance),                          \
      LABEL("Friction coefficient at balance"))                                                    \
    X(RUNNING_IN_KEY_THICKNESS, "balance_thickness", SI(LENGTH), SHOWS(thickness),                 \
      LABEL("Layer thickness at balance"))                                                         \
    X(RUNNING_IN_KEY_SETTLED, AS(settled), SI(TIME),                                               \
      LABEL("Time after which 5 % of the change of friction are left"))                            \
    X(RUNNING_IN_KEY_SETTLED_LOW, AS(settled_low), SI(TIME), LABEL("Its 95 % interval from"),      \
      OPTIONAL)                                                                                    \
    X(RUNNING_IN_KEY_SETTLED_HIGH, AS(settled_high), SI(TIME), LABEL("to"), OPTIONAL)              \
    X(RUNNING_IN_KEY_KNOWN, "settled_known", ENUM(stated_verdict), SHOWS(known),                   \
      LABEL("Whether it is known within the errors"), OPTIONAL)                                    \
    X(RUNNING_IN_KEY_SHEAR, AS(shear), TEXT, LABEL("Shear stress of the layer"))                   \
    X(RUNNING_IN_KEY_BACK, AS(back), TEXT, LABEL("Layer and energy"))                              \
    X(RUNNING_IN_KEY_ERRORS, AS(errors), TEXT, LABEL("Standard errors include"))                   \
    X(RUNNING_IN_KEY_MODULI, "layer_moduli", TEXT, SHOWS(moduli), LABEL("Moduli of the layer"),    \
      OPTIONAL)

/* The pair of balances of a fold is gone above or below its specific wear rate. */
#define BALANCE_STABILITIES(X)                                                                     \
    X(BALANCE_STABLE, "stable")                                                                    \
    X(BALANCE_UNSTABLE, "unstable")                                                                \
    X(FOLD_ABOVE, "above")                                                                         \
    X(FOLD_BELOW, "below")

#define LAYER_FEEDBACK_COLUMNS(X)                                                                  \
    X(LAYER_FEEDBACK_KIND, AS(kind),                                                               \
      "balance, or fold: where two balances meet as the specific wear rate changes", TEXT)         \
    COLUMN_AND_NEW_ERRORS(X, LAYER_FEEDBACK_THICKNESS, "thickness",                                \
                          "thickness of the modified layer", SI(LENGTH), SHOWS(thickness))         \
    X(LAYER_FEEDBACK_STABLE, AS(stable),                                                           \
      "stable or unstable; of a fold above or below: where the pair is gone",                      \
      ENUM(balance_stability))                                                                     \
    COLUMN_AND_NEW_ERROR(                                                                          \
        X, LAYER_FEEDBACK_MAP_SLOPE, "map_slope",                                                  \
        "change of the balance thickness with that of the layer that the energy sees", NUMBER,     \
        SHOWS(map_slope))                                                                          \
    COLUMN_AND_NEW_ERROR(X, LAYER_FEEDBACK_EIGENVALUE, "eigenvalue",                               \
                         "rate at which a deviation grows", SI(RATE), SHOWS(eigenvalue))           \
    COLUMN_AND_NEW_ERROR(X, LAYER_FEEDBACK_WEAR_RATE, "wear_rate", "specific wear rate",           \
                         SI(WEAR_RATE), SHOWS(wear_rate))                                          \
    COLUMN_AND_NEW_ERRORS(X, LAYER_FEEDBACK_HYSTERESIS, "hysteresis",                              \
                          "hysteresis friction with this layer", NUMBER, SHOWS(hysteresis))        \
    COLUMN_AND_NEW_ERRORS(X, LAYER_FEEDBACK_AREA_RATIO, "area_ratio",                              \
                          "real over nominal contact area with it", NUMBER, SHOWS(area_ratio))     \
    COLUMN_AND_NEW_ERRORS(X, LAYER_FEEDBACK_FRICTION, "friction",                                  \
                          "friction coefficient; without a shear stress nan", NUMBER,              \
                          SHOWS(friction))
#define LAYER_FEEDBACK_KEYS(X)                                                                     \
    X(LAYER_FEEDBACK_KEY_ONE_WAY, "one_way_thickness", SI(LENGTH), SHOWS(one_way),                 \
      LABEL("Balance if the layer did not act back"))                                              \
    X(LAYER_FEEDBACK_KEY_RATIO, "bare_formation_wear_ratio", NUMBER, SHOWS(ratio),                 \
      LABEL("Formation over wear on a bare surface, R"))                                           \
    X(LAYER_FEEDBACK_KEY_MODULUS_RATIO, AS(modulus_ratio), NUMBER, LABEL("Modulus ratio"),         \
      OPTIONAL)                                                                                    \
    X(LAYER_FEEDBACK_KEY_LOW, AS(low), SI(LENGTH), LABEL("Looked for from"))                       \
    X(LAYER_FEEDBACK_KEY_HIGH, AS(high), SI(LENGTH), LABEL("Looked for up to"))                    \
    X(LAYER_FEEDBACK_KEY_WORDS, AS(words), TEXT, LABEL("A layer that acts back on its energy"))    \
    X(LAYER_FEEDBACK_KEY_AGREEMENT, AS(agreement), ENUM(stated_verdict),                           \
      LABEL("Whether their number is known within the errors"), OPTIONAL)                          \
    X(LAYER_FEEDBACK_KEY_ERRORS, AS(errors), TEXT, LABEL("Standard errors include"), OPTIONAL)     \
    X(LAYER_FEEDBACK_KEY_MODULI, "layer_moduli", TEXT, SHOWS(moduli),                              \
      LABEL("Moduli of the layer"), OPTIONAL)

#define LAYER_REGIME_MAP_COLUMNS(X)                                                                \
    X(LAYER_REGIME_MAP_PRESSURE, AS(pressure), "nominal pressure", SI(PRESSURE))                   \
    X(LAYER_REGIME_MAP_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY))                   \
    COLUMN_AND_NEW_ERROR(X, LAYER_REGIME_MAP_POWER, "power",                                       \
                         "power per area that modifies the rubber", UNIT("W/m^2"), SHOWS(power))   \
    COLUMN_AND_NEW_ERRORS(X, LAYER_REGIME_MAP_RATIO, "ratio",                                      \
                          "formation rate over wear rate, R; no layer at 1 and below", NUMBER,     \
                          SHOWS(ratio))                                                            \
    COLUMN_AND_NEW_ERRORS(X, LAYER_REGIME_MAP_THICKNESS, "thickness",                              \
                          "thickness of the layer at balance", SI(LENGTH), SHOWS(thickness))       \
    X(LAYER_REGIME_MAP_SHARE, AS(share), "share of the replicates that have a layer", NUMBER,      \
      OPTIONAL)                                                                                    \
    COLUMN_AND_NEW_ERRORS(                                                                         \
        X, LAYER_REGIME_MAP_FRICTION, "friction",                                                  \
        "friction without a layer: total, or hysteresis where no shear stress is known", NUMBER,   \
        SHOWS(friction))                                                                           \
    COLUMN_AND_NEW_ERRORS(X, LAYER_REGIME_MAP_WITH_LAYER, "with_layer",                            \
                          "the same with this layer", NUMBER, SHOWS(with_layer))                   \
    COLUMN_AND_NEW_ERRORS(X, LAYER_REGIME_MAP_CHANGE, "change",                                    \
                          "relative change of friction by the layer", NUMBER, SHOWS(change))
#define LAYER_REGIME_MAP_LIMITS(X, ID, name, unit)                                                 \
    X(ID##_LOW, AS(name##_low), unit, LABEL("Its 95 % interval from"), OPTIONAL)                   \
    X(ID##_HIGH, AS(name##_high), unit, LABEL("to"), OPTIONAL)
#define LAYER_REGIME_MAP_KEYS(X)                                                                   \
    X(LAYER_REGIME_MAP_KEY_PRESSURE, AS(pressure), SI(PRESSURE), LABEL("Nominal pressure"))        \
    X(LAYER_REGIME_MAP_KEY_FROM_VELOCITY, AS(from_velocity), SI(VELOCITY),                         \
      LABEL("There is a layer from the velocity"))                                                 \
    LAYER_REGIME_MAP_LIMITS(X, LAYER_REGIME_MAP_KEY_FROM_VELOCITY, from_velocity, SI(VELOCITY))    \
    X(LAYER_REGIME_MAP_KEY_TO_VELOCITY, AS(to_velocity), SI(VELOCITY),                             \
      LABEL("up to the velocity"))                                                                 \
    LAYER_REGIME_MAP_LIMITS(X, LAYER_REGIME_MAP_KEY_TO_VELOCITY, to_velocity, SI(VELOCITY))        \
    X(LAYER_REGIME_MAP_KEY_FROM_POWER, AS(from_power), UNIT("W/m^2"),                              \
      LABEL("That is from the power"))                                                             \
    LAYER_REGIME_MAP_LIMITS(X, LAYER_REGIME_MAP_KEY_FROM_POWER, from_power, UNIT("W/m^2"))         \
    X(LAYER_REGIME_MAP_KEY_TO_POWER, AS(to_power), UNIT("W/m^2"), LABEL("up to the power"))        \
    LAYER_REGIME_MAP_LIMITS(X, LAYER_REGIME_MAP_KEY_TO_POWER, to_power, UNIT("W/m^2"))             \
    X(LAYER_REGIME_MAP_KEY_WORDS, AS(words), TEXT, LABEL("Where a layer exists"))                  \
    X(LAYER_REGIME_MAP_KEY_KNOWN, AS(known), ENUM(stated_verdict),                                 \
      LABEL("Whether the edges are known within the errors"), OPTIONAL)                            \
    X(LAYER_REGIME_MAP_KEY_ERRORS, AS(errors), TEXT, LABEL("Standard errors include"), OPTIONAL)   \
    X(LAYER_REGIME_MAP_KEY_MODULI, "layer_moduli", TEXT, SHOWS(moduli),                            \
      LABEL("Moduli of the layer"), OPTIONAL)

#define IDENTIFICATION_METHODS(X)                                                                  \
    X(BY_WEAR, "thickness and wear rate")                                                          \
    X(BY_RATES, "thickness and running-in, by the balance of rates")                               \
    X(BY_TRANSPORT, "thickness and running-in, by the transport of damage")                        \
    X(BY_THICKNESS, "thickness alone")

/* Each row is one identification method. */
#define IDENTIFICATION_COLUMNS(X)                                                                  \
    X(IDENTIFICATION_BY, AS(by), "what they are known by", ENUM(identification_method),            \
      LABEL("By"))                                                                                 \
    NUMBER_AND_INTERVAL(X, IDENTIFICATION_ENERGY, "critical_energy", "critical energy U_c",        \
                        SI(ENERGY_DENSITY), "Critical energy", SHOWS(energy))                      \
    NUMBER_AND_INTERVAL(X, IDENTIFICATION_WEAR, "specific_wear_rate", "specific wear rate k",      \
                        SI(WEAR_RATE), "Specific wear rate", SHOWS(wear))                          \
    X(IDENTIFICATION_CORRELATION, IN(axes, correlation), "correlation of ln U_c and ln k", NUMBER, \
      DIGITS(2), LABEL("Correlation"), SPARSE)                                                     \
    X(IDENTIFICATION_LOOSE, IN(axes, loose), "the combination that is known least", TEXT,          \
      LABEL("Known least"))                                                                        \
    X(IDENTIFICATION_LOOSE_ERROR, IN(axes, loose_error),                                           \
      "standard deviation along it, of the logarithms; inf: it is not determined", NUMBER,         \
      DIGITS(2), LABEL("to"), SPARSE)                                                              \
    X(IDENTIFICATION_TIGHT_ERROR, IN(axes, tight_error),                                           \
      "standard deviation across it, of the logarithms", NUMBER, DIGITS(2), LABEL("Across it"),    \
      SPARSE)                                                                                      \
    X(IDENTIFICATION_ENERGY_INPUTS, AS(energy_inputs),                                             \
      "standard deviation of ln U_c by material, surface and conditions alone", NUMBER, OPTIONAL,  \
      SPARSE)                                                                                      \
    X(IDENTIFICATION_WEAR_INPUTS, AS(wear_inputs), "likewise of ln k", NUMBER, OPTIONAL, SPARSE)   \
    X(IDENTIFICATION_CORRELATION_INPUTS, AS(correlation_inputs), "correlation of these two",       \
      NUMBER, OPTIONAL, SPARSE)                                                                    \
    X(IDENTIFICATION_NOTE, AS(note), "what is lacking, or taken from elsewhere", TEXT,             \
      LABEL("Note"))
/* The first two belong to the first method with an interval. */
#define IDENTIFICATION_KEYS(X)                                                                     \
    X(IDENTIFICATION_KEY_ENERGY, "identified_critical_energy", SI(ENERGY_DENSITY),                 \
      HEADLINE("Critical energy by the layer"), OPTIONAL)                                          \
    X(IDENTIFICATION_KEY_WEAR, "identified_wear_rate", SI(WEAR_RATE),                              \
      HEADLINE("Specific wear rate by the layer"), OPTIONAL)                                       \
    X(IDENTIFICATION_KEY_PRODUCT, "wear_times_energy", NUMBER,                                     \
      LABEL("k U_c, which the thickness alone tells"))                                             \
    X(IDENTIFICATION_KEY_RATIO, "formation_wear_ratio", NUMBER,                                    \
      LABEL("Formation rate over wear rate, R"))                                                   \
    X(IDENTIFICATION_KEY_AGREES, "agreement", TEXT, LABEL("Running-in against wear"), OPTIONAL)    \
    X(IDENTIFICATION_KEY_VELOCITY, "velocity", SI(VELOCITY), LABEL("Velocity"))                    \
    X(IDENTIFICATION_KEY_PRESSURE, "pressure", SI(PRESSURE), LABEL("Pressure"))                    \
    X(IDENTIFICATION_KEY_THICKNESS, "observed_thickness", SI(LENGTH), LABEL("Observed thickness")) \
    X(IDENTIFICATION_KEY_INCLUDES, "standard_error_includes", TEXT,                                \
      LABEL("Standard errors include"))                                                            \
    X(IDENTIFICATION_KEY_LACKS, "standard_error_excludes", TEXT, LABEL("No error known of"),       \
      OPTIONAL)

#endif
