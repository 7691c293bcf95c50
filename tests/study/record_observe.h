/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_RECORD_OBSERVE_H
#define STUDY_RECORD_OBSERVE_H

#include "scene_draw.h"

family record_family(void);

#endif
