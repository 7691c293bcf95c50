/* Columns and keys of the table "what_if": one model choice changed at a time. Only the table
 * registry includes this file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_STUDY_TABLES_WHAT_IF_H
#define WT_STUDY_TABLES_WHAT_IF_H

/* A number with its change relative to the first row. */
#define WHAT_IF_NUMBER(X, ID, name, words, unit, heading)                                          \
    X(ID, name, words, unit, LABEL(heading))                                                       \
    X(ID##_CHANGE, name "_change", "its relative change", NUMBER, LABEL("change"))

#define WHAT_IF_COLUMNS(X)                                                                         \
    X(WHAT_IF_CHOICE, "choice", "the choice that is moved; the first row: none", TEXT,             \
      LABEL("Choice"))                                                                             \
    X(WHAT_IF_USED, "used", "what all other tables rest on", TEXT, LABEL("Used"))                  \
    X(WHAT_IF_TRIED, "alternative", "value in this row instead", TEXT, LABEL("Alternative"))       \
    WHAT_IF_NUMBER(X, WHAT_IF_HYSTERESIS, "hysteresis",                                            \
                   "hysteresis friction at the reference velocity", NUMBER, "Hysteresis")          \
    WHAT_IF_NUMBER(X, WHAT_IF_AREA_RATIO, "area_ratio", "real over nominal contact area there",    \
                   NUMBER, "A/A₀")                                                                 \
    WHAT_IF_NUMBER(X, WHAT_IF_FRICTION, "friction", "friction coefficient there", NUMBER,          \
                   "Total μ")                                                                      \
    WHAT_IF_NUMBER(X, WHAT_IF_THICKNESS, "thickness", "thickness of the layer at balance",         \
                   SI(LENGTH), "Thickness")                                                        \
    WHAT_IF_NUMBER(X, WHAT_IF_WITH_LAYER, "friction_with_layer",                                   \
                   "friction coefficient with the modified layer", NUMBER, "With layer")           \
    X(WHAT_IF_WHY, "why", "why this range", TEXT, LABEL("Why this range"))                         \
    X(WHAT_IF_NOTE, "note", "why there is no number", TEXT, LABEL("Not computed because"))

#define WHAT_IF_KEYS(X)                                                                            \
    X(WHAT_IF_KEY_LEFT_OUT, "left_out", TEXT, LABEL("Choices that do not apply"), OPTIONAL)        \
    X(WHAT_IF_KEY_MATERIAL_STATEMENT, "material_statement", TEXT, LABEL("Material statement"),     \
      OPTIONAL)                                                                                    \
    X(WHAT_IF_KEY_EXTRAPOLATED_SHARE, "extrapolated_share", NUMBER, LABEL("Extrapolated share"),   \
      OPTIONAL)                                                                                    \
    X(WHAT_IF_KEY_SHARE_BEYOND, "share_beyond_reliable", NUMBER,                                   \
      LABEL("Share of the hysteresis from waves beyond the reliable range of the surface"),        \
      OPTIONAL)

#endif
