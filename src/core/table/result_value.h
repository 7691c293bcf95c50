/* Result values: each number or verdict that answers a question of the user is computed here once,
 * from the tables of the result. The summary line, the answer, the page and `summary` format these
 * values and compute nothing. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_RESULT_VALUE_H
#define WT_CORE_TABLE_RESULT_VALUE_H

#include "core/table/registry.h"

/* Range over model choices, each of which is changed alone: those of friction and layer are in the
 * table what_if, those of the ratio of the moduli in the keys of the comparison. */
typedef struct result_value_range {
    double low, high; /* NaN: no choice was tried, or none changes the number */
    const char *
        widest; /* the choice with the largest effect, which a measurement should decide; or NULL */
    const char *remedy;         /* what to measure for the widest choice, or NULL */
    double rest_low, rest_high; /* range of the other choices; NaN if unknown */
} result_value_range;

typedef struct result_value {
    const char *name;  /* of its columns in `summary` */
    const char *words; /* heading */
    wt_quantity quantity;
    wt_estimate number; /* the value is NaN if it is unknown */
    double low, high;   /* 95 % interval; NaN if unknown */
    bool predicted;     /* true for a prediction, false for a measurement */
    double neutral;     /* value without an effect: 1 for a ratio, 0 for a change; else NaN */
    result_value_range range;
    listed_text verdict; /* of a test; its texts are "" without one */
    const char *remedy;  /* how to decide an inconclusive verdict, or NULL */
    const char *includes,
        *lacks;          /* error sources that the interval includes and excludes, or NULL */
    double frequency[2]; /* angular frequency range [rad/s]; NaN if unknown or not applicable */
    double velocity,
        pressure; /* sliding velocity [m/s] and pressure [Pa]; NaN if unknown or not applicable */
} result_value;

/* Position of a value relative to its neutral value; SIGN_UNDECIDED if the interval includes both
 * signs. */
typedef enum sign_verdict { SIGN_BELOW = -1, SIGN_UNDECIDED = 0, SIGN_ABOVE = 1 } sign_verdict;

/* Bound tables from which result values are computed. Each table may be absent. */
typedef struct result_value_tables {
    table_view groups, budget, rates, comparison, friction, layer, what_if, track_layer;
    table_view answer, notes, failures, shifts; /* of wt_result_main_values */
} result_value_tables;

/* Binds the tables of a result. A table that cannot be bound is an error and is then absent. */
wt_status result_values_bind(const wt_result *result, result_value_tables *tables,
                             wt_error *err) WT_NODISCARD;
/* True if wt_result_main_values reads the table, whose name may be a former one. */
bool result_values_use(const char *table);

/* Modulus of a group, for a row of modulus_groups. The interval is the one of that row: the
 * scatter of the spots and the errors that all curves share. */
result_value result_value_group(const result_value_tables *tables, size_t row);
/* Ratio of the moduli of the groups over all rates. */
result_value result_value_ratio(const result_value_tables *tables);
/* Values of friction and layer, selected by the key of the number. */
result_value result_value_friction(const result_value_tables *tables, friction_key key);
result_value result_value_thickness(const result_value_tables *tables);
/* Variant for a key of any schema. False if the key is not a result value. */
bool result_value_from_key(const result_value_tables *tables, const schema_field *key,
                           result_value *f);
/* Number of digits for a value and the limits of its interval: three, or as many as print two
 * digits of the half width, at most six. */
int result_value_digits(double value, double low, double high);
sign_verdict result_value_sign(const result_value *f);

#endif
