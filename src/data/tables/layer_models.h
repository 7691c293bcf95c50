/* The columns and keys of what a layer is beyond its thickness at constant load: bands, running-in,
 * a layer that acts back, where there is one. Included by tables.h alone. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_DATA_TABLES_LAYER_MODELS_H
#define WT_DATA_TABLES_LAYER_MODELS_H

#define LAYER_BANDS_COLUMNS(X)                                                                     \
    X(LAYER_BANDS_TIME, AS(time), "time since the start", SI(TIME))                                \
    X(LAYER_BANDS_LOAD, AS(load), "load that lasts then, from 1 on", NUMBER)                       \
    X(LAYER_BANDS_WORN, AS(worn), "depth worn off until then", SI(LENGTH))                         \
    X(LAYER_BANDS_BAND, AS(band), "band, the deepest is 1; 0: nothing is modified", NUMBER)        \
    X(LAYER_BANDS_UPPER, AS(upper), "depth of its upper edge; 0: the surface", SI(LENGTH),         \
      NUMERICAL_ERROR(LAYER_BANDS_UPPER))                                                          \
    X(LAYER_BANDS_UPPER_NUMERICAL_ERROR, "upper_numerical_error", "its numerical error",           \
      SI(LENGTH))                                                                                  \
    X(LAYER_BANDS_LOWER, AS(lower), "depth of its lower edge", SI(LENGTH),                         \
      NUMERICAL_ERROR(LAYER_BANDS_LOWER))                                                          \
    X(LAYER_BANDS_LOWER_NUMERICAL_ERROR, "lower_numerical_error", "its numerical error", SI(LENGTH))
#define LAYER_BANDS_KEYS(X)                                                                        \
    X(LAYER_BANDS_KEY_LOADS, AS(loads), TEXT, LABEL("Loads"))                                      \
    X(LAYER_BANDS_KEY_EVENTS, AS(events), TEXT, LABEL("How the modified rubber comes about"),      \
      OPTIONAL)                                                                                    \
    X(LAYER_BANDS_KEY_METHOD, AS(method), TEXT, LABEL("By"))

#define RUNNING_IN_COLUMNS(X)                                                                      \
    X(RUNNING_IN_TIME, AS(time), "time since the start", SI(TIME))                                 \
    X(RUNNING_IN_THICKNESS, AS(thickness), "thickness of the modified layer", SI(LENGTH))          \
    X(RUNNING_IN_HYSTERESIS, AS(hysteresis), "hysteresis friction with this layer", NUMBER)        \
    X(RUNNING_IN_AREA_RATIO, AS(area_ratio), "real over nominal contact area with it", NUMBER)     \
    X(RUNNING_IN_SHEAR_STRESS, AS(shear_stress), "shear stress of the real contact with it",       \
      SI(PRESSURE))                                                                                \
    X(RUNNING_IN_FRICTION, AS(friction), "friction coefficient; without a shear stress nan", NUMBER)
#define RUNNING_IN_KEYS(X)                                                                         \
    X(RUNNING_IN_KEY_VELOCITY, AS(velocity), SI(VELOCITY))                                         \
    X(RUNNING_IN_KEY_MODULUS_RATIO, AS(modulus_ratio), NUMBER,                                     \
      LABEL("Modulus of the layer over that of the bulk"))                                         \
    X(RUNNING_IN_KEY_BARE, "bare_friction", NUMBER, SHOWS(bare),                                   \
      LABEL("Friction coefficient at the start"))                                                  \
    X(RUNNING_IN_KEY_BALANCE, "balance_friction", NUMBER, SHOWS(balance),                          \
      LABEL("Friction coefficient at balance"))                                                    \
    X(RUNNING_IN_KEY_THICKNESS, "balance_thickness", SI(LENGTH), SHOWS(thickness),                 \
      LABEL("Layer thickness at balance"))                                                         \
    X(RUNNING_IN_KEY_SETTLED, AS(settled), SI(TIME),                                               \
      LABEL("Time after which 5 % of the change of friction are left"))                            \
    X(RUNNING_IN_KEY_SHEAR, AS(shear), TEXT, LABEL("Shear stress of the layer"))                   \
    X(RUNNING_IN_KEY_BACK, AS(back), TEXT, LABEL("Layer and energy"))                              \
    X(RUNNING_IN_KEY_ERRORS, AS(errors), TEXT, LABEL("Errors"))

#define LAYER_BALANCES_COLUMNS(X)                                                                  \
    X(LAYER_BALANCES_KIND, AS(kind),                                                               \
      "balance, or fold: where two balances meet as the specific wear rate changes", TEXT)         \
    X(LAYER_BALANCES_THICKNESS, AS(thickness), "thickness of the modified layer", SI(LENGTH))      \
    X(LAYER_BALANCES_STABLE, AS(stable),                                                           \
      "stable or unstable; of a fold above or below: where the pair is gone", TEXT)                \
    X(LAYER_BALANCES_MAP_SLOPE, AS(map_slope),                                                     \
      "change of the balance thickness with that of the layer that the energy sees", NUMBER)       \
    X(LAYER_BALANCES_EIGENVALUE, AS(eigenvalue), "rate at which a deviation grows", SI(RATE))      \
    X(LAYER_BALANCES_WEAR_RATE, AS(wear_rate), "specific wear rate", SI(WEAR_RATE))                \
    X(LAYER_BALANCES_HYSTERESIS, AS(hysteresis), "hysteresis friction with this layer", NUMBER)    \
    X(LAYER_BALANCES_AREA_RATIO, AS(area_ratio), "real over nominal contact area with it", NUMBER) \
    X(LAYER_BALANCES_FRICTION, AS(friction), "friction coefficient; without a shear stress nan",   \
      NUMBER)
#define LAYER_BALANCES_KEYS(X)                                                                     \
    X(LAYER_BALANCES_KEY_ONE_WAY, "one_way_thickness", SI(LENGTH), SHOWS(one_way),                 \
      LABEL("Balance if the layer did not act back"))                                              \
    X(LAYER_BALANCES_KEY_RATIO, "bare_formation_wear_ratio", NUMBER, SHOWS(ratio),                 \
      LABEL("Formation over wear on a bare surface, R"))                                           \
    X(LAYER_BALANCES_KEY_MODULUS_RATIO, AS(modulus_ratio), NUMBER)                                 \
    X(LAYER_BALANCES_KEY_LOW, AS(low), SI(LENGTH), LABEL("Looked for from"))                       \
    X(LAYER_BALANCES_KEY_HIGH, AS(high), SI(LENGTH), LABEL("Looked for up to"))                    \
    X(LAYER_BALANCES_KEY_WORDS, AS(words), TEXT, LABEL("A layer that acts back on its energy"))

#define EXISTENCE_COLUMNS(X)                                                                       \
    X(EXISTENCE_PRESSURE, AS(pressure), "nominal pressure", SI(PRESSURE))                          \
    X(EXISTENCE_VELOCITY, AS(velocity), "sliding velocity", SI(VELOCITY))                          \
    X(EXISTENCE_POWER, AS(power), "power per area that modifies the rubber", UNIT("W/m^2"))        \
    X(EXISTENCE_RATIO, AS(ratio), "formation rate over wear rate, R; no layer at 1 and below",     \
      NUMBER)                                                                                      \
    X(EXISTENCE_THICKNESS, AS(thickness), "thickness of the layer at balance", SI(LENGTH))         \
    X(EXISTENCE_FRICTION, AS(friction),                                                            \
      "friction without a layer: total, or hysteresis where no shear stress is known", NUMBER)     \
    X(EXISTENCE_WITH_LAYER, AS(with_layer), "the same with this layer", NUMBER)                    \
    X(EXISTENCE_CHANGE, AS(change), "relative change of friction by the layer", NUMBER)
#define EXISTENCE_KEYS(X)                                                                          \
    X(EXISTENCE_KEY_PRESSURE, AS(pressure), SI(PRESSURE), LABEL("Nominal pressure"))               \
    X(EXISTENCE_KEY_FROM_VELOCITY, AS(from_velocity), SI(VELOCITY),                                \
      LABEL("There is a layer from the velocity"))                                                 \
    X(EXISTENCE_KEY_TO_VELOCITY, AS(to_velocity), SI(VELOCITY), LABEL("up to the velocity"))       \
    X(EXISTENCE_KEY_FROM_POWER, AS(from_power), UNIT("W/m^2"), LABEL("That is from the power"))    \
    X(EXISTENCE_KEY_TO_POWER, AS(to_power), UNIT("W/m^2"), LABEL("up to the power"))               \
    X(EXISTENCE_KEY_WORDS, AS(words), TEXT, LABEL("Where a layer exists"))

#endif
