/* Adds sentences and caveats to an answer. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer_context.h"

#include "core/base/array.h"
#include "core/base/clocale.h"

#include <stdlib.h>
#include <string.h>

/* Length of a sentence in bytes; longer sentences are truncated. */
enum { LONGEST = 1200 };

static void put(const answer_context *story, const char *question, const char *kind,
                const char *text)
{
    table_row(story->answer);
    answer_put_text(story->answer, ANSWER_QUESTION, question);
    answer_put_text(story->answer, ANSWER_ANSWER, text);
    answer_put_text(story->answer, ANSWER_KIND, kind);
}

void answer_add_sentence(const answer_context *story, const char *question, const char *kind,
                         const char *format, ...)
{
    char text[LONGEST];
    va_list list;
    va_start(list, format);
    clocale_vprint(text, sizeof text, format, list);
    va_end(list);
    put(story, question, kind, text);
}

void answer_caveat(answer_context *story, caveat_of of, const char *format, ...)
{
    char text[LONGEST];
    va_list list;
    va_start(list, format);
    clocale_vprint(text, sizeof text, format, list);
    va_end(list);
    caveat *grown = array_grow(story->caveats, story->n_caveats, sizeof *grown);
    char *copy = grown != NULL ? strdup(text) : NULL;
    if (grown != NULL)
        story->caveats = grown;
    if (copy == NULL) {
        story->status = WT_E_MEMORY;
        return;
    }
    grown[story->n_caveats++] = (caveat){of, copy};
}

void answer_put_caveats(answer_context *story)
{
    size_t told = 0;
    for (int of = 0; of < CAVEATS_OF; of++)
        for (size_t i = 0; i < story->n_caveats; i++)
            if (story->caveats[i].of == (caveat_of)of)
                put(story, "What must be kept in mind?",
                    told++ < CAVEATS_OPEN ? "caveat" : "folded", story->caveats[i].text);
}

void answer_context_clear(answer_context *story)
{
    for (size_t i = 0; i < story->n_caveats; i++)
        free(story->caveats[i].text);
    free(story->caveats);
}
