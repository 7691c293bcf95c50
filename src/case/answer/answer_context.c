/* Adds sentences and caveats to an answer. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer_context.h"

#include "core/base/array.h"
#include "core/base/clocale.h"

#include <stdlib.h>
#include <string.h>

/* Length of a sentence in bytes; longer sentences are truncated. */
enum { LONGEST = 1200 };

static void add_answer_row(const answer_context *context, const char *question, answer_kind kind,
                           const char *text)
{
    table_row(context->answer);
    answer_put_text(context->answer, ANSWER_QUESTION, question);
    answer_put_text(context->answer, ANSWER_ANSWER, text);
    answer_put_text(context->answer, ANSWER_KIND, answer_kind_text(kind));
}

bool wt_answer_is_folded(const wt_table *answer, size_t row)
{
    table_view view;
    return table_bind(answer, &answer_schema, "", &view, NULL) == WT_OK &&
           answer_enum(&view, row, ANSWER_KIND) == ANSWER_KIND_FOLDED;
}

void answer_add_sentence(const answer_context *context, const char *question, answer_kind kind,
                         const char *format, ...)
{
    char text[LONGEST];
    va_list list;
    va_start(list, format);
    clocale_vprint(text, sizeof text, format, list);
    va_end(list);
    add_answer_row(context, question, kind, text);
}

void answer_add_caveat(answer_context *context, caveat_topic topic, const char *format, ...)
{
    char text[LONGEST];
    va_list list;
    va_start(list, format);
    clocale_vprint(text, sizeof text, format, list);
    va_end(list);
    caveat *grown = array_grow(context->caveats, context->n_caveats, sizeof *grown);
    char *copy = grown != NULL ? strdup(text) : NULL;
    if (grown != NULL)
        context->caveats = grown;
    if (copy == NULL) {
        context->status = WT_E_MEMORY;
        return;
    }
    grown[context->n_caveats++] = (caveat){topic, copy};
}

void answer_write_caveats(answer_context *context)
{
    size_t n_written = 0;
    for (int topic = 0; topic < CAVEAT_TOPICS; topic++)
        for (size_t i = 0; i < context->n_caveats; i++)
            if (context->caveats[i].topic == (caveat_topic)topic)
                add_answer_row(context, "What must be kept in mind?",
                               n_written++ < CAVEATS_SHOWN ? ANSWER_KIND_CAVEAT
                                                           : ANSWER_KIND_FOLDED,
                               context->caveats[i].text);
}

void answer_context_clear(answer_context *context)
{
    for (size_t i = 0; i < context->n_caveats; i++)
        free(context->caveats[i].text);
    free(context->caveats);
}
