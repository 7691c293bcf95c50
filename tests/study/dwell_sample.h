/* Held force curve with the errors of the instrument.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_DWELL_SAMPLE_H
#define STUDY_DWELL_SAMPLE_H

#include "afm_physics.h"
#include "dwell_scene.h"
#include "random.h"

enum { DWELL_FREE = 1000, DWELL_IN = 500, DWELL_HELD = 2000, DWELL_OUT = 1000 };
enum { DWELL_SAMPLES = DWELL_FREE + DWELL_IN + DWELL_HELD + DWELL_OUT };

/* E(t) of a draw [Pa]. */
relaxation dwell_relaxation(const dwell_scene *s, random_source *random);
/* Curve from Maxwell terms in time steps, with noise and drift, written as a table of a text
 * stream; returns -1 if it cannot be written. */
int dwell_sample_write(const dwell_scene *s, const relaxation *r, random_source *random,
                       const char *path);

#endif
