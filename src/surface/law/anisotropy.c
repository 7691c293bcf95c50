/* Density of an anisotropic roughness over the directions, and its check.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "surface/law/anisotropy.h"
#include "weartrack/surface.h"

#include <float.h>
#include <math.h>

double wt_anisotropy_density(const wt_anisotropy *anisotropy, double angle)
{
    double density = 1;
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS; k++)
        density +=
            anisotropy->amplitude[k] * cos(anisotropy_order(k) * (angle - anisotropy->angle[k]));
    return density;
}

/* Directions looked at: sixteen in a period of the highest order, between which it falls by no more
 * than 1 - cos(pi / 16), 2 %, of its amplitude. */
enum { TRANSVERSE_ISOTROPY = 16 * WT_ANISOTROPY_ORDERS };

wt_status wt_anisotropy_check(const wt_anisotropy *anisotropy, wt_error *err)
{
    double least = (double)INFINITY, where = 0;
    for (size_t k = 0; k < WT_ANISOTROPY_ORDERS; k++)
        if (!isfinite(anisotropy->amplitude[k]) || !isfinite(anisotropy->angle[k]))
            return wt_fail(err, WT_E_RANGE, "an anisotropy of the roughness must be finite");
    for (size_t i = 0; i < TRANSVERSE_ISOTROPY; i++) {
        const double angle = M_PI * (double)i / TRANSVERSE_ISOTROPY;
        const double density = wt_anisotropy_density(anisotropy, angle);
        if (density < least) {
            least = density;
            where = angle;
        }
    }
    if (least >= -8 * WT_ANISOTROPY_ORDERS * DBL_EPSILON)
        return WT_OK;
    wt_fail(err, WT_E_RANGE, "the anisotropy makes the power spectrum negative");
    wt_error_place(err, "%s", anisotropy->amplitude[0] != 0 ? "anisotropy" : "anisotropy-fourth");
    wt_error_expected(err, "a density of at least 0 in every direction");
    wt_error_found(err, "%.3g of the mean at %.0f deg from the velocity", least,
                   where * 180 / M_PI);
    wt_error_advice(err, "an anisotropy of one order alone is at most 1");
    return WT_E_RANGE;
}
