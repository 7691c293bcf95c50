/* Force curves inside the library: what follows from the deflection of the cantilever, and the time
 * of a sample.
 *
 * Voltage of the detector times sensitivity is deflection, times spring constant is force.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_CORE_DATA_FORCE_CURVE_H
#define WT_CORE_DATA_FORCE_CURVE_H

#include "weartrack/data.h"

/* From a signal of the quantity `from` to the quantity `to`; both are a deflection voltage, a
 * deflection or a force. The instrument made the signal with the calibration `file`, the result has
 * the calibration `used`: what was given in it replaces the file's, if the file tells its own. NaN
 * if a value that it takes is not known. */
double deflection_factor(wt_quantity from, wt_quantity to, const wt_cantilever *file,
                         const wt_cantilever *used);

/* How far the tip is, if the cantilever is bent by `force` [N] at a piezo position [m] that rises
 * towards the sample. */
static inline double tip_position(double position, double force, double spring_constant)
{
    return position - force / spring_constant;
}

/* Sample i is at start + duration i/n: a duration ends where the next segment begins, not at the
 * last sample. (JPK files say so: a segment that was stopped after one sample has a duration of one
 * interval.) */
void sample_times(double start, double duration, size_t n, double *times);

/* Force of every sample [N]: as stored, or made in scratch [n_points] from the deflection; NULL if
 * the segment has no such channel or the calibration does not allow it. */
const double *segment_force(const wt_segment *segment, const wt_cantilever *cantilever,
                            double *scratch);
/* The height that the fit uses: that of a sensor where there is one; NULL if there is none. */
const double *segment_height(const wt_segment *segment);
/* Time of every sample as stored, or made in scratch [n_points] from the duration; NULL if neither
 * is known. */
const double *segment_time(const wt_segment *segment, double *scratch);

#endif
