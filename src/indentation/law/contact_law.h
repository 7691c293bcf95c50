/* Layer (E1, thickness h) bonded to a half-space (E2), both incompressible, under a rigid tip
 * without friction. Internal to the library.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_INDENTATION_LAW_CONTACT_LAW_H
#define WT_INDENTATION_LAW_CONTACT_LAW_H

#include <stdbool.h>

/* Range of the ratio of moduli within which the law is accurate to 2 %. */
#define THIN_LAYER_MIN_RATIO 0.3
#define THIN_LAYER_MAX_RATIO 3.0

/* Apparent modulus of a homogeneous model over E1. ratio = E1/E2; x = contact radius of the
 * homogeneous half-space at that depth over h. The error is below 2 % where thin_layer_is_valid. */
double thin_layer_apparent_modulus(double ratio, double x);
bool thin_layer_is_valid(double ratio, double x);

#endif
