/* Observes tables of force curves through compare.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_TRACK_OBSERVE_H
#define STUDY_TRACK_OBSERVE_H

#include "scene_draw.h"

family track_family(void);

#endif
