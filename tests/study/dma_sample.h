/* One draw of a scene: the measured isotherms.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef STUDY_DMA_SAMPLE_H
#define STUDY_DMA_SAMPLE_H

#include "dma_scene.h"
#include "random.h"

typedef struct isotherm {
    double temperature, true_temperature; /* degC */
    int n;
    double frequency[POINTS_MAX], storage[POINTS_MAX], loss[POINTS_MAX]; /* Hz, Pa */
    double drift[POINTS_MAX]; /* [K], of the temperature since the first point */
} isotherm;

typedef struct sample {
    int n;
    isotherm isotherms[ISOTHERMS_MAX];
} sample;

void sample_draw(const dma_scene *s, const rubber *r, random_source *random, sample *to);
/* Writes the table of an instrument; returns 0 or -1. */
int sample_write(const dma_scene *s, const sample *from, const char *path);

#endif
