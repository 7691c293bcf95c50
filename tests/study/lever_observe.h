/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_LEVER_OBSERVE_H
#define STUDY_LEVER_OBSERVE_H

#include "scene_draw.h"

family lever_family(void);

#endif
