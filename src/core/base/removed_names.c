/* Options and case elements of earlier versions. CHANGELOG.md has the reasons.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/removed_names.h"
#include "core/base/array.h"

#include <string.h>

const char *removed_name_advice(const char *name, size_t length)
{
    static const struct {
        const char *name, *instead;
    } removed[] = {
        {"acts-back", "a layer as soft as measured ones has one balance, that of the table layer"},
        {"anisotropy-fourth", "give anisotropy and texture-angle"},
        {"bands", "the table layer gives the deepest edge, which is the thickness"},
        {"damage", "multiply the critical energy by it: only their product counts"},
        {"existence", "a layer exists where mu_hys exceeds k U_c, see the table friction"},
        {"extrapolation", "the end values hold outside the points of a table"},
        {"feedback", "a layer as soft as measured ones has one balance, that of the table layer"},
        {"layer-material", "give modulus-ratio or layer-comparison"},
        {"loads", "compute each load by a call of its own: the balance forgets those before"},
        {"local-friction", "the table what_if has the thickness by other depth profiles"},
        {"moduli", "the Prony series gives the same friction to 0.3 %"},
        {"profile", "the table what_if has the thickness by other depth profiles"},
        {"ratio-frequency", "give layer-comparison, which contains it"},
        {"ratio-highest", "give layer-comparison, which contains it"},
        {"ratio-lowest", "give layer-comparison, which contains it"},
        {"ratio-slope", "give layer-comparison, or ratio-by-rate in a case"},
        {"regime-map", "a layer exists where mu_hys exceeds k U_c, see the table friction"},
        {"running-in-friction", "hold a record against the growing layer: weartrack validate"},
        {"severity-exponent", "give the specific wear rate at the power of the sliding"},
        {"severity-power", "give the specific wear rate at the power of the sliding"},
        {"shear-decay-length", "the table what_if has friction by the shear stress of the bulk"},
        {"shear-reach", "the table what_if has friction by the shear stress of the bulk"},
        {"start-thickness", "the balance does not depend on it"},
        {"texture-angle-fourth", "give anisotropy and texture-angle"},
        {"tolerance", "friction is computed to 1e-10; a looser tolerance saved no time"},
    };
    for (size_t i = 0; i < COUNT_OF(removed); i++)
        if (strlen(removed[i].name) == length && strncmp(removed[i].name, name, length) == 0)
            return removed[i].instead;
    return NULL;
}
