/* Declares checks for inconsistent metadata of force curves.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_FORCE_CONSISTENCY_H
#define WT_READ_FORCE_CONSISTENCY_H

#include "read/force_assembler.h"

/* Warns once per source if stored force and deflection imply another spring constant than the
 * stated one. The file states it, else the user. Either signal may be NULL if it is not stored. */
wt_status contradiction_constant(wt_force_source *source, const force_metadata *facts,
                                 const force_signal *force, const force_signal *bend,
                                 wt_error *err);
/* Reports once per source which calibration values of the user replace those of the file. It is a
 * warning if the ratio suggests a wrong unit. */
void contradiction_given(wt_force_source *source, const force_metadata *facts);
/* Notes once per source if the piezo height and the measured height of an approach differ in their
 * range. */
void contradiction_heights(wt_force_source *source, const force_metadata *facts,
                           const wt_segment *segment);

#endif
