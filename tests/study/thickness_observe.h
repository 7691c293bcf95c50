/* Observes curves of bulk and track through indent and compare, with a stated thickness.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_THICKNESS_OBSERVE_H
#define STUDY_THICKNESS_OBSERVE_H

#include "scene_draw.h"

family thickness_family(void);

#endif
