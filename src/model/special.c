/* Special functions, from GSL.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "model/special.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_psi.h>
#include <math.h>

double digamma(double x)
{
    gsl_sf_result result;
    if (!(x > 0.0) || isinf(x) || gsl_sf_psi_e(x, &result) != GSL_SUCCESS)
        return (double)NAN;
    return result.val;
}
