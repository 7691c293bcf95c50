/* Principal axes of two correlated constants.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "layer/numerics/correlated_pair.h"

#include "core/base/clocale.h"

#include <math.h>

constant_axes constant_axes_compute(pair_covariance c)
{
    const double middle = 0.5 * (c.energy + c.wear),
                 apart = hypot(0.5 * (c.energy - c.wear), c.both),
                 angle = 0.5 * atan2(2 * c.both, c.energy - c.wear),
                 scale = sqrt(c.energy * c.wear);
    constant_axes a = {.correlation = scale > 0 ? fmax(-1, fmin(1, c.both / scale)) : (double)NAN,
                       .loose_error = sqrt(middle + apart),
                       .tight_error = sqrt(fmax(middle - apart, 0))};
    if (isnan(angle))
        a.tight_error = (double)NAN; /* fmax ignores NaN */
    else if (fabs(cos(angle)) >= fabs(sin(angle)))
        clocale_print(a.loose, sizeof a.loose, "U_c k^%.2f", tan(angle));
    else
        clocale_print(a.loose, sizeof a.loose, "k U_c^%.2f", 1 / tan(angle));
    return a;
}
