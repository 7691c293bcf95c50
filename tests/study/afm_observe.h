/* Force curves through indent. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_AFM_OBSERVE_H
#define STUDY_AFM_OBSERVE_H

#include "scene_draw.h"

family afm_family(void);

#endif
