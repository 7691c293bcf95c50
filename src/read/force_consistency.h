/* Declares checks for inconsistent metadata of force curves.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_FORCE_CONSISTENCY_H
#define WT_READ_FORCE_CONSISTENCY_H

#include "read/force_assembler.h"

/* Warns once per source if stored force and deflection imply another spring constant than the
 * stated one. The file states it, else the user. Either signal may be NULL if it is not stored. */
wt_status check_spring_constant(wt_force_source *source, const force_metadata *metadata,
                                const force_signal *force, const force_signal *deflection,
                                wt_error *err);
/* Reports once per source which calibration values of the user replace those of the file. It is a
 * warning if the ratio suggests a wrong unit. */
void report_overrides(wt_force_source *source, const force_metadata *metadata);
/* Notes once per source if the piezo height and the measured height of an approach differ in their
 * range. */
void check_height_ranges(wt_force_source *source, const force_metadata *metadata,
                         const wt_segment *segment);

#endif
