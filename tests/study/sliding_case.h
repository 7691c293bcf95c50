/* A case of rubber that slides. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_SLIDING_CASE_H
#define STUDY_SLIDING_CASE_H

#include "contact.h"

#include <stdio.h>

/* The case up to <sliding>: the rubber of the study as its lines, and the counter surface with the
 * relative error of its density. NULL: it cannot be written. */
FILE *sliding_case_begin(const char *path, const contact *stated, double error);

#endif
