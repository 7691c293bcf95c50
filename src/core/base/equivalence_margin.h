/* Parameter "equivalence-margin", shared by all comparisons. Internal to core.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_BASE_EQUIVALENCE_MARGIN_H
#define WT_CORE_BASE_EQUIVALENCE_MARGIN_H

#include "core/base/param.h"

/* Parameter record for the comparison of groups of curves and of materials. */
#define EQUIVALENCE_MARGIN(type)                                                                   \
    {                                                                                              \
        PARAM("equivalence-margin", type, margin, WT_Q_NONE, ABOVE(0)),                            \
            .value = "X",                                                                          \
            .help = "relative difference of the moduli that does not matter: \"no difference\" "   \
                    "is said "                                                                     \
                    "only if the whole interval lies within it"                                    \
    }

#endif
