/* Parameters of option structures. One record describes one member. The table of a structure stands
 * next to its function of defaults. The default of a member is the value that this function sets.
 *
 *     static const wt_param rows[] = {
 *         {PARAM("duty-cycle", wt_layer_job, duty, WT_Q_NONE, ABOVE_TO(0, 1)), .value = "X",
 *          .help = "share of the time in contact"},
 *     };
 *     PARAM_TABLE(wt_layer_job_params, wt_layer_job, rows, wt_layer_job_defaults, NO_PARTS)
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_PARAM_H
#define WT_CORE_BASE_PARAM_H

#include "weartrack/core.h"

#include <math.h>

typedef enum param_kind {
    PARAM_NUMBER,   /* double */
    PARAM_ESTIMATE, /* wt_estimate */
    PARAM_LIST,     /* const double * with increasing values, and their number */
    PARAM_COUNT,    /* unsigned, size_t or uint64_t */
    PARAM_FLAG,     /* bool, "yes" or "no" */
    PARAM_CHOICE,   /* enumeration from 0: index of a name in `value` */
    PARAM_TEXT,     /* const char * */
    PARAM_TEXTS,    /* const char *const * and their number; separated by ';' or repeated */
    PARAM_OTHER     /* parsed by `read` */
} param_kind;

/* Range from low to high. NaN is outside of every range. */
typedef struct param_limits {
    double low, high;
    bool with_low, with_high;
} param_limits;
#define BRACED(...)                                                                                \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }
#define ANY_NUMBER BRACED(-(double)INFINITY, (double)INFINITY, false, false)
#define ABOVE(bound) BRACED(bound, (double)INFINITY, false, false)
#define AT_LEAST(bound) BRACED(bound, (double)INFINITY, true, false)
#define ABOVE_TO(bound, last) BRACED(bound, last, false, true)
#define FROM_TO(first, last) BRACED(first, last, true, true)
#define FROM_BELOW(first, bound) BRACED(first, bound, true, false)

/* Help with an example, which messages about a wrong value show. */
#define SUCH_AS(before, example_, after) before "such as " example_ after, .example = (example_)

/* Flags for options and case elements. By default a parameter has both. */
#define PARAM_REQUIRED 1u
#define PARAM_NO_OPTION 2u
#define PARAM_NO_CASE 4u
#define PARAM_ONLY_C (PARAM_NO_OPTION | PARAM_NO_CASE)
/* Name of an input file. */
#define PARAM_READ 8u

struct wt_param {
    const char *name; /* option and case element; in a section of the same name, such as <sliding>,
                         the prefix of "sliding-temperature" is omitted */
    param_kind kind;
    wt_quantity quantity;
    param_limits limits;
    size_t offset, count_offset, size;
    const char *former; /* name in an earlier version: accepted, but not shown; NULL for most */
    const char *value;  /* what stands for the value in the help, or the choices parted by '|' */
    const char *help;
    const char *example; /* in the help and in messages; NULL for that of the quantity */
    const char
        *unset; /* text for NaN, NULL or an empty list, which are then allowed; "" without a text */
    unsigned flags;
    char letter; /* short option; 0 without one */
    wt_status (*read)(const char *text, void *member, wt_error *err);
    wt_status (*check)(const void *member,
                       wt_error *err); /* check beyond the limits; may be NULL */
};

/* Parameters of a structure that is a member of another one. */
typedef struct param_part {
    const wt_params *(*params)(void);
    size_t offset;
} param_part;
enum {
    PARAM_PARTS = 3,
    PARAM_COUNT_MAX = 64 /* bits of `given` */,
    PARAM_STRUCTURE_SIZE_MAX = 1024
};

struct wt_params {
    const wt_param *records;
    size_t n_records;
    void (*defaults)(void *structure);
    param_part part[PARAM_PARTS];
};

/* The macros derive the kind from the member, so that both agree. */
#define PARAM_MEMBER(type, member) (((type *)NULL)->member)
#define PARAM_AT(type, member)                                                                     \
    .offset = offsetof(type, member), .size = sizeof PARAM_MEMBER(type, member)
#define PARAM(name_, type, member, quantity_, ...)                                                 \
    .name = (name_), PARAM_AT(type, member), .quantity = (quantity_), .limits = __VA_ARGS__,       \
    .kind = _Generic(PARAM_MEMBER(type, member), double                                            \
                     : PARAM_NUMBER, wt_estimate                                                   \
                     : PARAM_ESTIMATE, unsigned                                                    \
                     : PARAM_COUNT, unsigned long                                                  \
                     : PARAM_COUNT, unsigned long long                                             \
                     : PARAM_COUNT)
#define PARAM_LIST_OF(name_, type, member, number, quantity_, ...)                                 \
    .name = (name_), PARAM_AT(type, member), .count_offset = offsetof(type, number),               \
    .quantity = (quantity_), .limits = __VA_ARGS__,                                                \
    .kind = _Generic(PARAM_MEMBER(type, member), const double *: PARAM_LIST)
#define PARAM_FLAG_OF(name_, type, member)                                                         \
    .name = (name_), PARAM_AT(type, member),                                                       \
    .kind = _Generic(PARAM_MEMBER(type, member), bool                                              \
                     : PARAM_FLAG)
/* The type of an enumeration is unsigned or int, depending on the compiler. */
#define PARAM_CHOICE_OF(name_, type, member, words)                                                \
    .name = (name_), PARAM_AT(type, member), .value = (words),                                     \
    .kind = _Generic(PARAM_MEMBER(type, member), unsigned                                          \
                     : PARAM_CHOICE, int                                                           \
                     : PARAM_CHOICE)
#define PARAM_TEXT_OF(name_, type, member)                                                         \
    .name = (name_), PARAM_AT(type, member),                                                       \
    .kind = _Generic(PARAM_MEMBER(type, member), const char *: PARAM_TEXT)
#define PARAM_TEXTS_OF(name_, type, member, number)                                                \
    .name = (name_), PARAM_AT(type, member), .count_offset = offsetof(type, number),               \
    .kind = _Generic(PARAM_MEMBER(type, member), const char *const *: PARAM_TEXTS)
/* Parameter that `function` parses. */
#define PARAM_OTHER_OF(name_, type, member, function)                                              \
    .name = (name_), PARAM_AT(type, member), .kind = PARAM_OTHER, .read = (function)

/* Parameter that many structures have. */
#define PARAM_THREADS(type)                                                                        \
    {                                                                                              \
        PARAM("threads", type, threads, WT_Q_NONE, FROM_TO(0, 1024)),                              \
            .value = "N", .flags = PARAM_NO_CASE,                                                  \
            .help = "threads to use, which change no result; 0 is one per processor"               \
    }

/* Defines a function that returns the table of parameters of a structure. The last arguments are
 * the nested structures. */
#define NO_PARTS BRACED(NULL, 0)
#define PARAM_PART(table, type, member) BRACED(table, offsetof(type, member))
#define PARAM_TABLE(name, type, rows, function, ...)                                               \
    static void name##_fill(void *structure)                                                       \
    {                                                                                              \
        _Static_assert(sizeof(type) <= PARAM_STRUCTURE_SIZE_MAX,                                   \
                       "room for the default of any structure");                                   \
        *(type *)structure = function();                                                           \
    }                                                                                              \
    const wt_params *name(void)                                                                    \
    {                                                                                              \
        static const wt_params table = {                                                           \
            rows, sizeof rows / sizeof rows[0], name##_fill, {__VA_ARGS__}};                       \
        return &table;                                                                             \
    }

/* Variant for a table that is used in one file only. */
#define PARAM_LOCAL_TABLE(name, type, rows, function, ...)                                         \
    static const wt_params *name(void);                                                            \
    PARAM_TABLE(name, type, rows, function, __VA_ARGS__)

/* Checks all values of a structure. Errors: WT_E_RANGE, or WT_E_MISSING if a required value is not
 * set. The place of the error is the name of the parameter. */
wt_status param_check(const wt_params *params, const void *structure, wt_error *err) WT_NODISCARD;
/* Variant for one number without a structure. */
wt_status param_check_number(const wt_param *param, double value, wt_error *err) WT_NODISCARD;
/* Creates the error WT_E_RANGE for a number that is not a parameter. */
wt_status range_error(const char *name, double value, const char *expected, wt_error *err);
/* Writes the name of a choice to the buffer, "" if there is none. */
enum { PARAM_CHOICE_NAME_SIZE = 32 };
void param_choice_name(const wt_params *params, const char *name, unsigned value, char *buffer,
                       size_t size);
/* Copies the stated members between two structures, without nested structures. Lists and texts must
 * not be among them, because they have one owner. */
void param_copy(const wt_params *params, const void *from, uint64_t given, void *to);
/* Returns the name of the first required parameter that is not stated; NULL if there is none. */
const char *param_find_missing(const wt_params *params, uint64_t given);

#endif
