/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_IDENTIFY_OBSERVE_H
#define STUDY_IDENTIFY_OBSERVE_H

#include "scene_draw.h"

family identify_family(void);

#endif
