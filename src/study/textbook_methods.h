/* Friction by the plain textbook method, for comparison with the kernel. It uses one grid of
 * wavenumbers, equidistant in ln q, with the trapezoidal rule. The angle uses the closed form of
 * the law, or else Simpson's rule. The contact area of an interval is that at its end. There is no
 * grading and no error estimate. */
#ifndef WT_STUDY_TEXTBOOK_METHODS_H
#define WT_STUDY_TEXTBOOK_METHODS_H

#include "weartrack/dma.h"
#include "weartrack/surface.h"

typedef struct textbook_friction {
    double stress_variance, area_ratio, hysteresis;
} textbook_friction;

/* Computes int_0^2pi cos(phi) E'' and int_0^2pi |E|^2 by Simpson's rule over a quarter turn of n
 * intervals (even). scratch: 3 (n + 1). */
void textbook_angular_integrals(const wt_material *material, double w, size_t n, double *scratch,
                                double *j1, double *j2);

/* Computes friction with n_q >= 2 wavenumbers from q0 to q1 and, without a closed form, n_angle >=
 * 2 intervals (even) over a quarter turn. Velocity > 0 [m/s]. Returns WT_E_ARG for
 * too few points. */
wt_status textbook_friction_compute(const wt_material *material, const wt_roughness *roughness,
                                    double pressure, double velocity, size_t n_q, size_t n_angle,
                                    textbook_friction *result) WT_NODISCARD;

#endif
