/* Conversions of force curves: force, deflection and voltage of the cantilever, and the time of a
 * sample.
 *
 * The deflection is the detector voltage times the sensitivity. The force is the deflection times
 * the spring constant. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CORE_DATA_FORCE_CURVE_H
#define WT_CORE_DATA_FORCE_CURVE_H

#include "weartrack/core.h"

/* Returns the factor that converts a signal of the quantity `from` to the quantity `to`; both are a
 * deflection voltage, a deflection or a force. The instrument computed the signal with the
 * calibration `file`. The result has the calibration `used`, whose stated values replace those of
 * the file. NaN if a necessary value is unknown. */
double deflection_factor(wt_quantity from, wt_quantity to, const wt_cantilever *file,
                         const wt_cantilever *used);

/* Returns the position of the tip [m] for a force [N] at a piezo position [m] that increases
 * towards the sample. */
static inline double tip_position(double position, double force, double spring_constant)
{
    return position - force / spring_constant;
}

/* Computes the time of sample i as start + duration i/n. A duration ends at the start of the next
 * segment, not at the last sample. JPK files use this definition: a segment with one sample has the
 * duration of one interval. */
void sample_times(double start, double duration, size_t n, double *times);

/* Returns the force of every sample [N], as stored or computed from the deflection in scratch
 * [n_points]. NULL without a suitable channel or calibration. */
const double *segment_force(const wt_segment *segment, const wt_cantilever *cantilever,
                            double *scratch);
/* Returns the height for the fit, measured by a sensor if possible; NULL without a height. */
const double *segment_height(const wt_segment *segment);
/* Returns the time of every sample [s], as stored or computed from the duration in scratch
 * [n_points]; NULL if both are unknown. */
const double *segment_time(const wt_segment *segment, double *scratch);

#endif
