/* A case of sliding rubber.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_SLIDING_CASE_H
#define STUDY_SLIDING_CASE_H

#include "contact.h"

#include <stdio.h>

/* Writes the case up to <sliding>: the rubber as its lines, and the counter surface with the
 * relative error of its density. NULL on failure. */
FILE *sliding_case_begin(const char *path, const contact *stated, double error);

#endif
