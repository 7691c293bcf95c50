/* Checks of the geometry of tips.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "indentation/law/tip.h"

#include "core/base/quantity.h"

#include <float.h>
#include <math.h>

static const double degree = M_PI / 180.0; /* [rad] */

/* Smallest half-angle of pyramids and cones; no real needle is sharper. */
#define MIN_HALF_ANGLE (M_PI / 180.0)

const wt_param tip_dimensions[TIP_N_DIMENSIONS] = {
    [TIP_HALF_ANGLE] = {PARAM("half-angle", wt_tip, half_angle, WT_Q_ANGLE,
                              FROM_BELOW(MIN_HALF_ANGLE, M_PI_2))},
    [TIP_RADIUS] = {PARAM("radius", wt_tip, radius, WT_Q_LENGTH, AT_LEAST(0))},
    [TIP_SIDES] = {PARAM("sides", wt_tip, sides, WT_Q_NONE, FROM_TO(3, 1e6))},
    [TIP_TRANSITION] = {PARAM("transition", wt_tip, transition_radius, WT_Q_LENGTH, AT_LEAST(0))},
};

static bool is_valid_dimension(tip_dimension which, double value)
{
    return param_check_number(&tip_dimensions[which], value, NULL) == WT_OK;
}

double wt_tip_tangent_transition(double radius, double half_angle)
{
    return radius * cos(half_angle);
}

double tip_largest_transition(double radius, double half_angle, unsigned sides)
{
    return radius * tip_facet_factor(sides) / tan(half_angle);
}

double tip_default_transition(double radius, double half_angle, unsigned sides)
{
    return fmin(wt_tip_tangent_transition(radius, half_angle),
                tip_largest_transition(radius, half_angle, sides));
}

static wt_status check_positive(double value, const char *name, wt_error *err)
{
    if (value > 0.0 && is_valid_dimension(TIP_RADIUS, value))
        return WT_OK;
    wt_status status = wt_fail(err, WT_E_RANGE, "%s is not usable", name);
    wt_error_expected(err, "a length above 0, at most %g m",
                      quantity_plausible_maximum(WT_Q_LENGTH));
    wt_error_found(err, "%g m", value);
    return status;
}

static wt_status check_half_angle(double half_angle, wt_error *err)
{
    if (is_valid_dimension(TIP_HALF_ANGLE, half_angle))
        return WT_OK;
    wt_status status = wt_fail(err, WT_E_RANGE, "half-angle of the tip is not usable");
    wt_error_expected(err, "an angle from the axis to the face between 1 and 90 degrees");
    wt_error_found(err, "%g degrees", half_angle / degree);
    return status;
}

static wt_status check_cap(const wt_tip *tip, wt_error *err)
{
    double b = tip->transition_radius;
    if (!is_valid_dimension(TIP_TRANSITION, b)) {
        wt_status status = wt_fail(err, WT_E_RANGE, "transition radius of the tip is not usable");
        wt_error_expected(err, "a length of 0 (sharp) or more");
        wt_error_found(err, "%g m", b);
        return status;
    }
    /* The slope of the cap at b must not exceed that of the faces. A smooth cap with equal slopes
     * is valid; its computed b may have a rounding error. */
    double b_max = tip_largest_transition(tip->radius, tip->half_angle, tip->sides);
    if (b <= b_max * (1.0 + 4.0 * DBL_EPSILON))
        return WT_OK;
    wt_status status = wt_fail(err, WT_E_RANGE, "the tip is concave where the cap meets the faces");
    wt_error_expected(err, "a transition radius of at most %.4g nm for this radius and half-angle",
                      b_max * 1e9);
    wt_error_found(err, "%.4g nm", b * 1e9);
    wt_error_advice(err,
                    "check that half-angle is measured from the axis to a face, or give a smaller "
                    "transition radius, e.g. transition=%gnm",
                    floor(b_max * 1e11) / 1e2);
    return status;
}

/* Checks a standard error. An error as large as the value makes the value meaningless. */
static wt_status check_tip_error(double value, double error, const char *name, wt_error *err)
{
    if (error == 0.0 || (error > 0.0 && error < value))
        return WT_OK;
    const wt_status status =
        wt_fail(err, WT_E_RANGE, "the standard error of the %s is not usable", name);
    wt_error_expected(err, "one below the %s itself", name);
    wt_error_found(err, "%g of %g in SI units", error, value);
    return status;
}

wt_status wt_tip_check(const wt_tip *tip, wt_error *err)
{
    wt_status status = check_tip_error(tip->half_angle, tip->half_angle_error, "half-angle", err);
    if (status == WT_OK)
        status = check_tip_error(tip->radius, tip->radius_error, "radius", err);
    if (status == WT_OK && tip->sample_thickness != 0.0)
        status = check_positive(tip->sample_thickness, "thickness of the sample", err);
    if (status != WT_OK)
        return status;
    switch (tip->shape) {
    case WT_TIP_PARABOLOID:
    case WT_TIP_SPHERE:
    case WT_TIP_PUNCH:
        return check_positive(tip->radius, "radius of the tip", err);
    case WT_TIP_CONE:
        return check_half_angle(tip->half_angle, err);
    case WT_TIP_BLUNTED_PYRAMID:
        if (tip->sides != 0 && !is_valid_dimension(TIP_SIDES, tip->sides)) {
            status = wt_fail(err, WT_E_RANGE, "a pyramid of %u sides does not exist", tip->sides);
            wt_error_expected(err, "3 sides or more, up to 1e6, or 0 for a cone");
            return status;
        }
        status = check_half_angle(tip->half_angle, err);
        if (status == WT_OK && !(tip->radius == 0.0 && tip->transition_radius == 0.0))
            status = check_positive(tip->radius, "cap radius of the tip", err);
        if (status == WT_OK)
            status = check_cap(tip, err);
        return status;
    }
    return wt_fail(err, WT_E_ARG, "unknown tip shape %d", (int)tip->shape);
}
