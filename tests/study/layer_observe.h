/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_LAYER_OBSERVE_H
#define STUDY_LAYER_OBSERVE_H

#include "trial.h"

family layer_family(void);

#endif
