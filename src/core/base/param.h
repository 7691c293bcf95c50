/* Parameters: one record says all there is to say about a member of a structure of options. The
 * table of a structure stands beside its function of defaults, and the default itself is what that
 * function leaves in the member.
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

#include "weartrack/base.h"

#include <math.h>

typedef enum param_kind {
    PARAM_NUMBER,   /* double */
    PARAM_ESTIMATE, /* wt_estimate */
    PARAM_LIST,     /* const double * of rising values and their number */
    PARAM_COUNT,    /* unsigned, size_t or uint64_t */
    PARAM_FLAG,     /* bool, "yes" or "no" */
    PARAM_CHOICE,   /* enumeration from 0 on: which of the words of `value` */
    PARAM_TEXT,     /* const char * */
    PARAM_TEXTS, /* const char *const * and their number, parted by ';' or given again and again */
    PARAM_OTHER  /* `read` knows */
} param_kind;

/* From low to high; NaN never lies within. */
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

/* Where it may stand. Without either it stands in both. */
#define PARAM_REQUIRED 1u
#define PARAM_NO_OPTION 2u
#define PARAM_NO_CASE 4u
#define PARAM_ONLY_C (PARAM_NO_OPTION | PARAM_NO_CASE)
/* A file that is written: no input. */
#define PARAM_WRITTEN 8u

struct wt_param {
    const char *name; /* option and element; in a section of the same name, <sliding>, that part of
                         "sliding-temperature" is left out */
    param_kind kind;
    wt_quantity quantity;
    param_limits limits;
    size_t offset, count_offset, size;
    const char *former; /* name in an earlier version: accepted, but not shown; NULL for most */
    const char *value;  /* what stands for the value in the help, or the choices parted by '|' */
    const char *help;
    const char
        *unset; /* it may be NaN, NULL or no item, and what then holds; "" = nothing to say */
    unsigned flags;
    char letter; /* short option, 0 = none */
    wt_status (*read)(const char *text, void *member, wt_error *err);
    wt_status (*check)(const void *member, wt_error *err); /* beyond the limits; may be NULL */
};

/* The parameters of a structure that lies in another one. */
typedef struct param_part {
    const wt_params *(*params)(void);
    size_t offset;
} param_part;
enum { PARAM_PARTS = 3, PARAM_MOST = 64 /* bits of `given` */, PARAM_LARGEST = 1024 };

struct wt_params {
    const wt_param *own;
    size_t n_own;
    void (*defaults)(void *structure);
    param_part part[PARAM_PARTS];
};

/* The kind follows from the member, so the two cannot disagree. */
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
/* A compiler takes an enumeration for unsigned or for int. */
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
/* `function` reads it. */
#define PARAM_OTHER_OF(name_, type, member, function)                                              \
    .name = (name_), PARAM_AT(type, member), .kind = PARAM_OTHER, .read = (function)

/* A record that many have. */
#define PARAM_THREADS(type)                                                                        \
    {                                                                                              \
        PARAM("threads", type, threads, WT_Q_NONE, FROM_TO(0, 1024)),                              \
            .value = "N", .flags = PARAM_NO_CASE,                                                  \
            .help = "threads to use, which change no result; 0 is one per processor"               \
    }

/* Defines a function that gives the table of a structure; the last arguments are the structures
 * that lie in it. */
#define NO_PARTS BRACED(NULL, 0)
#define PARAM_PART(table, type, member) BRACED(table, offsetof(type, member))
#define PARAM_TABLE(name, type, rows, function, ...)                                               \
    static void name##_fill(void *structure)                                                       \
    {                                                                                              \
        _Static_assert(sizeof(type) <= PARAM_LARGEST, "room for the default of any structure");    \
        *(type *)structure = function();                                                           \
    }                                                                                              \
    const wt_params *name(void)                                                                    \
    {                                                                                              \
        static const wt_params table = {                                                           \
            rows, sizeof rows / sizeof rows[0], name##_fill, {__VA_ARGS__}};                       \
        return &table;                                                                             \
    }

/* The same for a table of one file. */
#define PARAM_LOCAL_TABLE(name, type, rows, function, ...)                                         \
    static const wt_params *name(void);                                                            \
    PARAM_TABLE(name, type, rows, function, __VA_ARGS__)

/* All values of a structure: WT_E_RANGE, or WT_E_MISSING if a required one is not set; the place of
 * the error is the name. */
wt_status param_check(const wt_params *params, const void *structure, wt_error *err) WT_NODISCARD;
/* The same for one number that is in no structure. */
wt_status param_check_number(const wt_param *param, double value, wt_error *err) WT_NODISCARD;
/* The error of a number that is not a parameter: WT_E_RANGE. */
wt_status range_error(const char *name, double value, const char *expected, wt_error *err);
/* The word that a choice has for a value, for who tells what was chosen; "" for none. */
enum { PARAM_WORD = 32 };
void param_word(const wt_params *params, const char *name, unsigned value, char *buffer,
                size_t size);
/* The members of those of its own rows that are given, from one structure to another; not of lists
 * and texts, which have an owner. */
void param_copy(const wt_params *params, const void *from, uint64_t given, void *to);
/* Name of the first required parameter that is not given; NULL if there is none. */
const char *param_missing(const wt_params *params, uint64_t given);

#endif
