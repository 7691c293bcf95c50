/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_VALIDATION_OBSERVE_H
#define STUDY_VALIDATION_OBSERVE_H

#include "scene_draw.h"

family validation_family(void);

#endif
