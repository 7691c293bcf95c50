/* Defines the parameters of reading that other structures share. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_READ_READ_PARAMS_H
#define WT_READ_READ_PARAMS_H

#include "core/base/param.h"
#include "weartrack/core.h"

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
