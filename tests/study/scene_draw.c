/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene_draw.h"
#include "program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

void model_variant_fit(const family *f, int scene, const void *prepared, const stage *st,
                       int number, draw *to)
{
    const char *name = f->facts(scene)->name;
    scene_draw t = {.stage = st, .scene = name, .number = number, .draw = to};
    random_source random = random_for(st->seed, name, (uint64_t)number);
    *to = (draw){.verdict = NO_VERDICT};
    f->observe(scene, prepared, &random, &t);
    for (int i = 0; i < t.n_files && !st->keep; i++)
        unlink(t.files[i]);
}

const char *scene_draw_file(scene_draw *t, const char *name)
{
    if (t->n_files == SCENE_DRAW_FILES_MAX)
        abort();
    char *path = t->files[t->n_files++];
    snprintf(path, sizeof t->files[0], "%s/%s-%d-%s", t->stage->folder, t->scene, t->number, name);
    return path;
}

void scene_draw_broke(scene_draw *t, const char *words)
{
    t->draw->outcome = OUTCOME_BROKEN;
    if (t->draw->words[0] == '\0')
        snprintf(t->draw->words, sizeof t->draw->words, "%s", words);
}

/* 1: explained error of data; 3: an explained error of a part; others: wrong use of the command, or
 * a crash. */
static void note_failure(scene_draw *t, int status, const char *errors)
{
    char line[sizeof t->draw->words];
    FILE *words = fopen(errors, "r");
    if (status != 1 && status != 3)
        t->draw->outcome = OUTCOME_BROKEN;
    else if (t->draw->outcome == OUTCOME_GOOD)
        t->draw->outcome = OUTCOME_REFUSED;
    while (words != NULL && t->draw->words[0] == '\0' && fgets(line, sizeof line, words) != NULL) {
        for (char *c = line; *c != '\0'; c++)
            *c = *c == '\n' ? '\0' : *c == '\t' ? ' ' : *c;
        if (strstr(line, ": warning: ") == NULL)
            snprintf(t->draw->words, sizeof t->draw->words, "%s", line);
    }
    if (words != NULL)
        fclose(words);
}

bool scene_draw_run(scene_draw *t, const char *const *arguments)
{
    struct timespec before, after;
    const char *errors = scene_draw_file(t, "errors.txt");
    clock_gettime(CLOCK_MONOTONIC, &before);
    const int status = program_run(t->stage->program, arguments, errors);
    clock_gettime(CLOCK_MONOTONIC, &after);
    t->draw->seconds +=
        (double)(after.tv_sec - before.tv_sec) + 1e-9 * (double)(after.tv_nsec - before.tv_nsec);
    const bool partial = status == 3 && t->reads_part;
    if (status != 0 && !partial)
        note_failure(t, status, errors);
    unlink(errors);
    t->n_files--;
    return status == 0 || partial;
}

void scene_draw_add(scene_draw *t, quantity q, double truth, estimate found)
{
    if (t->draw->n == OBSERVATIONS_MAX)
        abort();
    t->draw->observations[t->draw->n++] = (observation){q, truth, found};
}
