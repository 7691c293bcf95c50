/* Friction by the plain textbook method, as a measure for the kernel: one grid of wavenumbers,
 * equally spaced in ln q, the trapezoidal rule along it, and over the angle at each the closed form
 * of the law, or Simpson's rule where it has none. The contact area of an interval is the one at
 * its end. No grading, no error. */
#ifndef WT_STUDY_TEXTBOOK_METHODS_H
#define WT_STUDY_TEXTBOOK_METHODS_H

#include "weartrack/model.h"

typedef struct textbook_friction {
    double stress_variance, area_ratio, hysteresis;
} textbook_friction;

/* int_0^2pi cos(phi) E'' and |E|^2 by Simpson's rule over a quarter turn of n intervals (even);
 * scratch: 3 (n + 1). */
void textbook_angular(const wt_material *material, double w, size_t n, double *scratch, double *j1,
                      double *j2);

/* n_q >= 2 wavenumbers from q0 to q1, n_angle >= 2 intervals (even) over a quarter turn where
 * there is no closed form. Velocity > 0. WT_E_MEMORY, or WT_E_ARG for too few of either. */
wt_status friction_textbook(const wt_material *material, const wt_roughness *roughness,
                            double pressure, double velocity, size_t n_q, size_t n_angle,
                            textbook_friction *result) WT_NODISCARD;

#endif
