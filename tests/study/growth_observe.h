/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_GROWTH_OBSERVE_H
#define STUDY_GROWTH_OBSERVE_H

#include "scene_draw.h"

family growth_family(void);

#endif
