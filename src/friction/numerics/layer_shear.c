/* Shear stress of the real contact on a modified layer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "weartrack/friction.h"

#include <math.h>

wt_layer_shear wt_layer_shear_defaults(void)
{
    return (wt_layer_shear){.exponent = 1};
}

double wt_layer_shear_stress(const wt_layer_shear *shear, double bulk, wt_layer_state layer)
{
    double stress = bulk;
    if (layer.thickness > 0) {
        const double whole = pow(layer.modulus_ratio, shear->exponent);
        stress *= shear->transition_thickness > 0
                      ? 1 - (whole - 1) * expm1(-layer.thickness / shear->transition_thickness)
                      : whole;
    }
    return stress;
}
