/* Observes measured surfaces through psd.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_SURFACE_OBSERVE_H
#define STUDY_SURFACE_OBSERVE_H

#include "scene_draw.h"

family surface_family(void);

#endif
