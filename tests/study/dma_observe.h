/* Observes isotherms through master, friction and layer.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_DMA_OBSERVE_H
#define STUDY_DMA_OBSERVE_H

#include "scene_draw.h"

family dma_family(void);

#endif
