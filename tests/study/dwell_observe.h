/* Observes held force curves through dwell.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_DWELL_OBSERVE_H
#define STUDY_DWELL_OBSERVE_H

#include "trial.h"

family dwell_family(void);

#endif
