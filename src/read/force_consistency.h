/* What a file says twice and not alike. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_FORCE_CONSISTENCY_H
#define WT_READ_FORCE_CONSISTENCY_H

#include "read/force_assembler.h"

/* Warns, once for a source, if force and deflection that are stored both (NULL: one is not) mean
 * another spring constant than the file says or, where it says none, the user. */
wt_status contradiction_constant(wt_force_source *source, const force_metadata *facts,
                                 const force_signal *force, const force_signal *bend,
                                 wt_error *err);
/* Says, once for a source, which values of the user replace others that the file says: a warning
 * where they are so far from them that a unit may be wrong. */
void contradiction_given(wt_force_source *source, const force_metadata *facts);
/* Notes, once for a source, if the two heights of an approach that was read differ in their range.
 */
void contradiction_heights(wt_force_source *source, const force_metadata *facts,
                           const wt_segment *segment);

#endif
