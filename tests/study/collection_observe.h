/* Observes whole studies through run and collect.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_COLLECTION_OBSERVE_H
#define STUDY_COLLECTION_OBSERVE_H

#include "scene_draw.h"

family collection_family(void);

#endif
