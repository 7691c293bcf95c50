/* What a result found: each number or verdict that answers a question is made here, once, from the
 * tables of the result. The sentence on standard error, the answer and the page, and the row of
 * `summary` tell it at their lengths and compute nothing of their own.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_TABLE_RESULT_VALUE_H
#define WT_CORE_TABLE_RESULT_VALUE_H

#include "core/table/registry.h"

/* Over the choices of the model: the table what_if, each moved alone. */
typedef struct result_value_range {
    double low, high;                   /* NaN: none was tried, or none moves it */
    const char *low_choice, *low_tried; /* "" = as used; borrowed from the table */
    const char *high_choice, *high_tried;
    const char *widest; /* the choice that alone moves it most: a measurement that settles it is
                           what it takes to know the number better; or NULL */
} result_value_range;

typedef struct result_value {
    const char *name;  /* of its columns in `summary` */
    const char *words; /* what it is, as a heading */
    wt_quantity quantity;
    wt_estimate number; /* value NaN: not known */
    double low, high;   /* interval of 95 %, NaN: not known */
    bool predicted;     /* by a model, else measured */
    double neutral;     /* nothing differs: 1 of a ratio, 0 of a change, else NaN */
    result_value_range range;
    const char *verdict;          /* "yes: ...", or NULL */
    const char *remedy;           /* what it would take to settle it, or NULL */
    const char *includes, *lacks; /* what the interval holds and what not, or NULL */
    double frequency[2];       /* angular ones that it is for [rad/s], NaN: not known or of none */
    double velocity, pressure; /* of sliding that it is for, likewise */
} result_value;

/* Below or above its neutral value, whatever is known of it; open where that leaves room for both.
 */
typedef enum finding_sign { FINDING_LESS = -1, FINDING_OPEN = 0, FINDING_MORE = 1 } finding_sign;

/* The tables that findings are made of, bound; each may be absent. */
typedef struct result_value_tables {
    table_view groups, budget, rates, comparison, friction, layer, what_if;
} result_value_tables;

/* Their names, one after the other; NULL: no more. */
const char *result_values_table(size_t i);
/* Whether a table is one of them. */
bool result_values_are_of(const char *table);

/* One that cannot be bound is an error, and as absent. */
wt_status result_values_bind(const wt_result *result, result_value_tables *tables,
                             wt_error *err) WT_NODISCARD;

/* The modulus of a group, with the errors of calibration in its interval where any is stated; a row
 * of modulus_groups. */
result_value result_value_of_group(const result_value_tables *tables, size_t row);
/* Of the groups' moduli, over all rates. */
result_value result_value_of_ratio(const result_value_tables *tables);
/* The ratio of the moduli as the table has them side by side, which is not that of the rates that
 * both groups have; NaN where it is the same within the interval of the latter or not known. */
double result_value_ratio_of_all(const result_value_tables *tables);
/* Sliding and layer, by the key that holds the number. */
result_value result_value_of_friction(const result_value_tables *tables, friction_key key);
result_value result_value_of_thickness(const result_value_tables *tables);
/* The same of a key of any schema; false if it is none of them. */
bool result_value_of_key(const result_value_tables *tables, const schema_field *key,
                         result_value *f);

/* Digits of a number and of the ends of its interval: three, or as many as tell two of half the
 * interval, six at most. */
int result_value_digits(double value, double low, double high);

/* By the interval alone, and by all choices of the model beside it. */
finding_sign result_value_sign_measured(const result_value *f);
finding_sign result_value_sign(const result_value *f);

#endif
