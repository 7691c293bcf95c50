/* The columns and keys of the tables that set materials side by side. Included by tables.h alone.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DATA_TABLES_MATERIALS_H
#define WT_DATA_TABLES_MATERIALS_H

/* A number with the ends of its interval, which are missing where its error is not known. */
#define VALUE_AND_INTERVAL(X, ID, name, words, unit)                                               \
    X(ID, name, words, unit, INTERVAL(ID##_LOW, ID##_HIGH))                                        \
    X(ID##_LOW, name "_low", "lower end of its 95 % interval", unit, SPARSE)                       \
    X(ID##_HIGH, name "_high", "upper end of its 95 % interval", unit, SPARSE)

/* A block for each material. */
#define MATERIALS_COLUMNS(X)                                                                       \
    X(MATERIALS_MATERIAL, "material", "name of the material", TEXT)                                \
    X(MATERIALS_ANGULAR_FREQUENCY, "angular_frequency", "angular frequency",                       \
      SI(ANGULAR_FREQUENCY))                                                                       \
    VALUE_AND_INTERVAL(X, MATERIALS_STORAGE, "storage_modulus", "storage modulus",                 \
                       SI(STORAGE_MODULUS))                                                        \
    VALUE_AND_INTERVAL(X, MATERIALS_LOSS, "loss_modulus", "loss modulus", SI(LOSS_MODULUS))        \
    VALUE_AND_INTERVAL(X, MATERIALS_FACTOR, "loss_factor", "tan delta", NUMBER)
#define MATERIALS_KEYS(X) X(MATERIALS_KEY_TEMPERATURE, "temperature", SI(TEMPERATURE))

/* A block for each material but the first, over frequency, and one over temperature. */
#define MATERIAL_RATIO_COLUMNS(X)                                                                  \
    X(MATERIAL_RATIO_MATERIAL, "material", "material whose moduli are divided by the first's",     \
      TEXT)                                                                                        \
    X(MATERIAL_RATIO_OVER, "over", "frequency or temperature: what changes in the block", TEXT)    \
    X(MATERIAL_RATIO_TEMPERATURE, "temperature", "temperature", SI(TEMPERATURE))                   \
    X(MATERIAL_RATIO_ANGULAR_FREQUENCY, "angular_frequency", "angular frequency",                  \
      SI(ANGULAR_FREQUENCY))                                                                       \
    VALUE_AND_INTERVAL(X, MATERIAL_RATIO_STORAGE, "storage_ratio", "ratio of the storage moduli",  \
                       NUMBER)                                                                     \
    VALUE_AND_INTERVAL(X, MATERIAL_RATIO_LOSS, "loss_ratio", "ratio of the loss moduli", NUMBER)   \
    VALUE_AND_INTERVAL(X, MATERIAL_RATIO_FACTOR, "loss_factor_ratio", "ratio of tan delta", NUMBER)

#define MATERIAL_RATIO_KEYS(X)                                                                     \
    X(MATERIAL_RATIO_KEY_DIFFERS, "differs", TEXT, LABEL("Do the materials differ"),               \
      HEADLINE("Do the materials differ"))                                                         \
    X(MATERIAL_RATIO_KEY_SETTLED_BY, "settled_by", TEXT, LABEL("What would settle it"), OPTIONAL)  \
    X(MATERIAL_RATIO_KEY_FIRST, "first_material", TEXT, LABEL("Divided by"))                       \
    X(MATERIAL_RATIO_KEY_TEMPERATURE, "temperature", SI(TEMPERATURE),                              \
      LABEL("Temperature, over frequency"))                                                        \
    X(MATERIAL_RATIO_KEY_FREQUENCY, "angular_frequency", SI(ANGULAR_FREQUENCY),                    \
      LABEL("Angular frequency, over temperature"), OPTIONAL)                                      \
    X(MATERIAL_RATIO_KEY_INCLUDES, "interval_includes", TEXT, LABEL("The interval includes"),      \
      OPTIONAL)                                                                                    \
    X(MATERIAL_RATIO_KEY_LACKS, "interval_lacks", TEXT, LABEL("It does not include"), OPTIONAL)    \
    X(MATERIAL_RATIO_KEY_OUTSIDE, "outside", TEXT, LABEL("Not compared: measured of one alone"),   \
      OPTIONAL)                                                                                    \
    X(MATERIAL_RATIO_KEY_MARGIN, "equivalence_margin", PLAIN)

#endif
