/* What must be said with the answer. Internal to flow. SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_CAVEATS_H
#define WEARTRACK_FLOW_CAVEATS_H

#include "flow/answer/story.h"

/* Remembers them all. */
void answer_caveats(answer_story *story);

#endif
