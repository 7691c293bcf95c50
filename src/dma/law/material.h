/* Internal to the model room: what the laws of materials share.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_DMA_LAW_MATERIAL_H
#define WT_DMA_LAW_MATERIAL_H

#include "core/base/param.h"
#include "weartrack/model.h"

/* The record of a Poisson ratio, for every structure that has one. */
#define POISSON_RATIO(type)                                                                        \
    {                                                                                              \
        PARAM("poisson-ratio", type, poisson_ratio, WT_Q_NONE, FROM_TO(0, 0.5)),                   \
            .value = "NU", .help = "of the rubber, which is nearly incompressible"                 \
    }
/* WT_E_RANGE unless 0 <= poisson_ratio <= 0.5. */
wt_status material_check_poisson(double poisson_ratio, wt_error *err) WT_NODISCARD;
/* WT_E_RANGE naming the parameter unless `good` and the value is finite. */
wt_status material_check_value(const char *name, double value, const char *expected, bool good,
                               wt_error *err) WT_NODISCARD;
/* A material around `data`, which it takes, also on failure. NaN: the range of frequencies is not
 * limited. */
wt_status material_wrap(const wt_material_law *law, void *data, double poisson_ratio,
                        double frequency_min, double frequency_max, wt_material **material,
                        wt_error *err) WT_NODISCARD;
/* The `free` of a law whose data are one block of memory. */
void material_free_data(wt_material *material);

/* Moduli whose squares are numbers [Pa]: a double ends at 1e-308 and 1e308. */
#define MODULUS_LEAST 1e-150
#define MODULUS_MOST 1e150
#define MODULUS_RANGE "from 1e-150 to 1e150 Pa"

#endif
