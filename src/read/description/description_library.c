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
static char *extract_text(text_description *d, const char *mark, char end)
{
    const char *const from = strstr(strstr(d->xml, "<format "), mark) + strlen(mark);
    return arena_text(&d->memory, from, (size_t)(strchrnul(from, end) - from));
}

text_description *description_from_library(const embedded_text *file)
{
    text_description *const d = wt_alloc(1, sizeof *d);
    d->xml = file->text;
    d->id = extract_text(d, " id=\"", '"');
    d->version = extract_text(d, " version=\"", '"');
    d->title = extract_text(d, "<title>", '<');
    d->evidence = extract_text(d, "<evidence>", '<');
    d->kinds = parse_kinds(extract_text(d, " kinds=\"", '"'));
    d->verified = strstr(d->xml, " verified=\"true\"") != NULL;
    return d;
}

/* Parses the document up to the description of the file content. */
static wt_status parse_detection_part(const text_description *d, text_description **read,
                                      wt_error *err)
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

wt_status description_load(text_description *d, description_extent extent,
                           const text_description **result, wt_error *err)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    wt_status status = WT_OK;
    *result = d;
    if (d->extent >= extent)
        return WT_OK;
    (void)pthread_mutex_lock(&lock);
    text_description **const loaded = &d->loaded[extent];
    if (*loaded == NULL && extent == DESCRIPTION_DETECT)
        status = parse_detection_part(d, loaded, err);
    else if (*loaded == NULL)
        status = parse_document(NULL, d->xml, strlen(d->xml), d->id, parse_format, loaded, err);
    *result = *loaded;
    (void)pthread_mutex_unlock(&lock);
    return status;
}
