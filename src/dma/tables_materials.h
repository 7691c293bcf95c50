/* Columns and keys of the tables that compare materials. Only core/table/registry.h includes
 * this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_TABLES_MATERIALS_H
#define WT_DMA_TABLES_MATERIALS_H

/* A number with its limits, which are missing if its error is unknown. */
#define VALUE_AND_INTERVAL(X, ID, name, words, unit, ...)                                          \
    X(ID, name, words, unit, INTERVAL(ID##_LOW, ID##_HIGH), __VA_ARGS__)                           \
    X(ID##_LOW, name "_low", "lower end of its 95 % interval", unit, SPARSE)                       \
    X(ID##_HIGH, name "_high", "upper end of its 95 % interval", unit, SPARSE)

/* One block for each material. */
#define MATERIALS_COLUMNS(X)                                                                       \
    X(MATERIALS_MATERIAL, AS(material), "name of the material", TEXT)                              \
    X(MATERIALS_ANGULAR_FREQUENCY, AS(angular_frequency), "angular frequency",                     \
      SI(ANGULAR_FREQUENCY))                                                                       \
    VALUE_AND_INTERVAL(X, MATERIALS_STORAGE, "storage_modulus", "storage modulus",                 \
                       SI(STORAGE_MODULUS), SHOWS(storage))                                        \
    VALUE_AND_INTERVAL(X, MATERIALS_LOSS, "loss_modulus", "loss modulus", SI(LOSS_MODULUS),        \
                       SHOWS(loss))                                                                \
    VALUE_AND_INTERVAL(X, MATERIALS_FACTOR, "loss_factor", "tan delta", NUMBER, SHOWS(factor))
#define MATERIALS_KEYS(X) X(MATERIALS_KEY_TEMPERATURE, "temperature", SI(TEMPERATURE))

/* One block over frequency and one over temperature for each material except the first. */
#define MATERIAL_RATIO_COLUMNS(X)                                                                  \
    X(MATERIAL_RATIO_MATERIAL, AS(material), "material whose moduli are divided by the first's",   \
      TEXT)                                                                                        \
    X(MATERIAL_RATIO_OVER, AS(over), "frequency or temperature: what changes in the block", TEXT)  \
    X(MATERIAL_RATIO_TEMPERATURE, AS(temperature), "temperature", SI(TEMPERATURE))                 \
    X(MATERIAL_RATIO_ANGULAR_FREQUENCY, AS(angular_frequency), "angular frequency",                \
      SI(ANGULAR_FREQUENCY))                                                                       \
    VALUE_AND_INTERVAL(X, MATERIAL_RATIO_STORAGE, "storage_ratio", "ratio of the storage moduli",  \
                       NUMBER, SHOWS(storage))                                                     \
    VALUE_AND_INTERVAL(X, MATERIAL_RATIO_LOSS, "loss_ratio", "ratio of the loss moduli", NUMBER,   \
                       SHOWS(loss))                                                                \
    VALUE_AND_INTERVAL(X, MATERIAL_RATIO_FACTOR, "loss_factor_ratio", "ratio of tan delta",        \
                       NUMBER, SHOWS(factor))

#define MATERIAL_RATIO_KEYS(X)                                                                     \
    X(MATERIAL_RATIO_KEY_DIFFERS, AS(differs), TEXT, LABEL("Do the materials differ"),             \
      HEADLINE("Do the materials differ"))                                                         \
    X(MATERIAL_RATIO_KEY_SETTLED_BY, AS(settled_by), TEXT, LABEL("What would settle it"),          \
      OPTIONAL)                                                                                    \
    X(MATERIAL_RATIO_KEY_FIRST, AS(first_material), TEXT, LABEL("Divided by"))                     \
    X(MATERIAL_RATIO_KEY_TEMPERATURE, AS(temperature), SI(TEMPERATURE),                            \
      LABEL("Temperature, over frequency"))                                                        \
    X(MATERIAL_RATIO_KEY_FREQUENCY, AS(angular_frequency), SI(ANGULAR_FREQUENCY),                  \
      LABEL("Angular frequency, over temperature"), OPTIONAL)                                      \
    X(MATERIAL_RATIO_KEY_INCLUDES, "interval_includes", TEXT, SHOWS(includes),                     \
      LABEL("The interval includes"), OPTIONAL)                                                    \
    X(MATERIAL_RATIO_KEY_LACKS, "interval_excludes", TEXT, SHOWS(lacks),                           \
      LABEL("It does not include"), OPTIONAL)                                                      \
    X(MATERIAL_RATIO_KEY_OUTSIDE, AS(outside), TEXT, LABEL("Not compared: measured of one alone"), \
      OPTIONAL)                                                                                    \
    X(MATERIAL_RATIO_KEY_MARGIN, "equivalence_margin", PLAIN, SHOWS(margin),                       \
      LABEL("Margin within which they are alike"))

#endif
