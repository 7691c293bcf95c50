/* The sentences of an answer. SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/answer/story.h"

#include "base/clocale.h"

void answer_say(const answer_story *story, const char *question, const char *kind,
                const char *format, ...)
{
    char text[1200];
    va_list list;
    va_start(list, format);
    clocale_vprint(text, sizeof text, format, list);
    va_end(list);
    table_row(story->answer);
    answer_put_text(story->answer, ANSWER_QUESTION, question);
    answer_put_text(story->answer, ANSWER_ANSWER, text);
    answer_put_text(story->answer, ANSWER_KIND, kind);
}
