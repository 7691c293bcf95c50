/* Parameter records that a structure of a computation and one of a job share. The members have the
 * same names unless an argument states them. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_SHARED_PARAMS_H
#define WT_CORE_BASE_SHARED_PARAMS_H

#include "core/base/param.h"
#include "weartrack/core.h"

/* Default relative numerical error of a job and of the friction kernel. */
#define DEFAULT_TOLERANCE 1e-10

/* clang-format off: one a line */

#define FRICTION_TOLERANCE(type)                                                                   \
    {                                                                                              \
        PARAM("tolerance", type, tolerance, WT_Q_NONE, ABOVE_TO(0, 0.1)),                          \
            .value = "X", .flags = PARAM_ONLY_C,                                                   \
            .help = "relative numerical error that is not to be exceeded"                          \
    }
#define FRICTION_GAMMA(type)                                                                       \
    {                                                                                              \
        PARAM("gamma", type, gamma, WT_Q_NONE, FROM_TO(0, 1)),                                     \
            .value = "G", .flags = PARAM_ONLY_C,                                                   \
            .help = "partial-contact factor S = G + (1-G)P^2 of the friction integral; 1 is "      \
                    "Persson 2001"                                                                 \
    }

#define FRICTION_STRAIN_FACTOR(type)                                                               \
    {                                                                                              \
        PARAM("strain-factor", type, strain_factor, WT_Q_NONE, FROM_TO(0.01, 100)),                \
            .value = "X", .flags = PARAM_ONLY_C,                                                   \
            .help = "strain at a wavenumber over the rms slope of the roughness up "               \
                    "to there, for the softening"                                                  \
    }

/* `in` is a prefix of the member. */
#define FLASH_ROWS(type, in)                                                                       \
    {PARAM_FLAG_OF("flash-temperature", type, in on),                                              \
     .help = "the heat of sliding warms the rubber at every length scale (Persson 2006); the "     \
             "sliding temperature is that of the surroundings"},                                   \
        {PARAM("contact-size", type, in contact_size, WT_Q_LENGTH, FROM_TO(1e-6, 1)),              \
         .value = "R",                                                                             \
         .help = "of a macroscopic contact, which lasts R/v, for the flash temperature; 1 mm is "  \
                 "typical of asphalt (Persson 2006)"},                                             \
        {PARAM("heat-capacity", type, in heat_capacity, WT_Q_HEAT_CAPACITY, FROM_TO(1e4, 1e8)),    \
         .value = "C", .help = "of the rubber by volume; 2.2 MJ/(m^3 K) is typical"},              \
        {PARAM("heat-diffusivity", type, in diffusivity, WT_Q_DIFFUSIVITY, FROM_TO(1e-12, 1)),     \
         .value = "D", .help = "of the rubber; 1e-7 m^2/s is typical"},                            \
    {                                                                                              \
        PARAM("macroscopic-area", type, in macroscopic, WT_Q_NONE, FROM_TO(0.01, 1)),              \
            .value = "X", .flags = PARAM_ONLY_C,                                                   \
            .help =                                                                                \
                "share of the nominal area in macroscopic contacts, in which the heat is made "    \
                "(Persson 2006)"                                                                   \
    }

/* State of the surface layer. `in` is a prefix of the member. */
#define LAYER_STATE_ROWS(type, in)                                                                 \
    {PARAM("layer-thickness", type, in thickness, WT_Q_LENGTH, AT_LEAST(0)), .value = "D",         \
     .flags = PARAM_NO_CASE, .help = SUCH_AS("of the modified layer, ", "1um", "")},               \
    {                                                                                              \
        PARAM("modulus-ratio", type, in modulus_ratio, WT_Q_NONE, ABOVE(0)),                       \
            .value = "X", .help = "modulus of the layer over that of the bulk"                     \
    }

#define LAYER_WEAR_RATE(type, wear_unset)                                                          \
    {                                                                                              \
        PARAM("specific-wear-rate", type, specific_wear_rate, WT_Q_WEAR_RATE, AT_LEAST(0)),        \
            .value = "K", .unset = (wear_unset), .help = SUCH_AS("k, ", "\"1e-3mm^3/(N m)\"", "")  \
    }
#define LAYER_DUTY(type)                                                                           \
    {                                                                                              \
        PARAM("duty-cycle", type, duty, WT_Q_NONE, ABOVE_TO(0, 1)),                                \
            .former = "duty", .value = "X",                                                        \
            .help = "share of the time in contact; with 1, times are contact times"                \
    }
#define ENERGY_LOCAL_FRICTION(type)                                                                \
    {                                                                                              \
        PARAM("local-friction", type, local_friction, WT_Q_NONE, AT_LEAST(0)),                     \
            .value = "M", .flags = PARAM_ONLY_C,                                                   \
            .help = "local friction of the incompressible profile"                                 \
    }

/* Parameter record for the comparison of groups of curves. */
#define EQUIVALENCE_MARGIN(type)                                                                   \
    {                                                                                              \
        PARAM("equivalence-margin", type, margin, WT_Q_NONE, ABOVE(0)),                            \
            .value = "X",                                                                          \
            .help = "relative difference of the moduli that does not matter: \"no difference\" "   \
                    "is said "                                                                     \
                    "only if the whole interval lies within it"                                    \
    }

/* clang-format on */

/* Rows of the parameter table for the calibration of the cantilever. `where`: flags of the row.
 * `test`: check of the member, or NULL. */
#define SPRING_CONSTANT(type, where, test)                                                         \
    {                                                                                              \
        PARAM("spring-constant", type, spring_constant, WT_Q_SPRING_CONSTANT, ABOVE(0)),           \
            .check = (test), .value = "K", .unset = "that of the files", .flags = (where),         \
            .help = SUCH_AS("spring constant of the cantilever, ", "0.1N/m", "")                   \
    }
#define SENSITIVITY(type, where, test)                                                             \
    {                                                                                              \
        PARAM("sensitivity", type, sensitivity, WT_Q_SENSITIVITY, ABOVE(0)),                       \
            .check = (test), .value = "S", .unset = "that of the files", .flags = (where),         \
            .help = SUCH_AS("deflection sensitivity (InvOLS), ", "60nm/V", "")                     \
    }

#endif
