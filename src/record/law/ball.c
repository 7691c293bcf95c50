/* Hertzian contact of a ball: nominal pressure, load and duty of a point of the track.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/record.h"

#include <math.h>

wt_ball_contact wt_ball_contact_compute(double load, double radius, double modulus,
                                        double poisson_ratio)
{
    const double a = cbrt(0.75 * load * radius * (1 - poisson_ratio * poisson_ratio) / modulus);
    return (wt_ball_contact){a, load / (M_PI * a * a)};
}

double wt_ball_load(double pressure, double radius, double modulus, double poisson_ratio)
{
    const double a =
        0.75 * M_PI * pressure * radius * (1 - poisson_ratio * poisson_ratio) / modulus;
    return M_PI * a * a * pressure;
}

double wt_ball_duty(double contact_radius, double track_radius, double aside)
{
    const double y = aside / contact_radius, part = 1 - y * y;
    return 3 * contact_radius / (8 * track_radius) * (part < 0 ? 0 : part);
}
