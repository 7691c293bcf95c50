/* Parses the descriptions that are embedded in the library, as far as requested.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/description/description_xml.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Returns the text between a mark of the head and the next `end`. The heads have a plain form; a
 * test compares the result with that of the XML parser. */
static char *text_after(text_description *d, const char *mark, char end)
{
    const char *const from = strstr(strstr(d->xml, "<format "), mark) + strlen(mark);
    return arena_text(&d->memory, from, (size_t)(strchrnul(from, end) - from));
}

wt_status description_of_library(const embedded_text *file, text_description **description,
                                 wt_error *err)
{
    text_description *const d = calloc(1, sizeof *d);
    if (d == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a format description");
    d->xml = file->text;
    d->id = text_after(d, " id=\"", '"');
    d->version = text_after(d, " version=\"", '"');
    d->title = text_after(d, "<title>", '<');
    d->evidence = text_after(d, "<evidence>", '<');
    const char *const kinds = text_after(d, " kinds=\"", '"');
    if (d->memory.failed) {
        description_free(d);
        return wt_fail(err, WT_E_MEMORY, "no memory for a format description");
    }
    d->kinds = parse_kinds(kinds);
    d->verified = strstr(d->xml, " verified=\"true\"") != NULL;
    *description = d;
    return WT_OK;
}

/* Parses the document up to the description of the file content. */
static wt_status read_detect(const text_description *d, text_description **read, wt_error *err)
{
    const char *end = strstr(d->xml, "\n  <header>");
    char *text = NULL;
    end = end != NULL ? end : strstr(d->xml, "\n  <table");
    const int length = asprintf(&text, "%.*s</format>", (int)(end - d->xml), d->xml);
    if (length < 0)
        return wt_fail(err, WT_E_MEMORY, "no memory for a format description");
    const wt_status status =
        parse_document(NULL, text, (size_t)length, d->id, parse_detect, read, err);
    free(text);
    return status;
}

wt_status description_need(text_description *d, description_extent extent,
                           const text_description **known, wt_error *err)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    wt_status status = WT_OK;
    *known = d;
    if (d->extent >= extent)
        return WT_OK;
    (void)pthread_mutex_lock(&lock);
    text_description **const more = &d->more[extent];
    if (*more == NULL && extent == DESCRIPTION_DETECT)
        status = read_detect(d, more, err);
    else if (*more == NULL)
        status = parse_document(NULL, d->xml, strlen(d->xml), d->id, parse_format, more, err);
    *known = *more;
    (void)pthread_mutex_unlock(&lock);
    return status;
}
