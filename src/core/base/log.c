/* Log of notes and warnings. Each text is stored once for a file, with a count.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/clocale.h"
#include "core/base/memory.h"
#include "core/base/utf8.h"

#include <search.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

typedef struct log_entry {
    wt_severity severity;
    wt_log_topic topic;
    char *file, *place, *text;
    size_t count;
} log_entry;

struct wt_log {
    log_entry **entries; /* in order of arrival */
    size_t n;
    void *tree; /* the same entries, for tsearch */
};

static int compare_log_entries(const void *a, const void *b)
{
    const log_entry *const p = a, *const q = b;
    if (p->severity != q->severity)
        return p->severity < q->severity ? -1 : 1;
    const int by_file = strcmp(p->file, q->file);
    return by_file != 0 ? by_file : strcmp(p->text, q->text);
}

static void entry_free(log_entry *e)
{
    free(e->file);
    free(e->place);
    free(e->text);
    free(e);
}

static void free_no_entry(void *node)
{
    (void)node; /* the array owns the entries */
}

const char *wt_severity_name(wt_severity severity)
{
#define SEVERITY_NAME(value, name) [value] = name,
    static const char *const names[] = {WT_SEVERITY_LIST(SEVERITY_NAME)};
#undef SEVERITY_NAME
    return names[severity];
}

wt_log *wt_log_new(void)
{
    return wt_alloc(1, sizeof(wt_log));
}

void wt_log_free(wt_log *log)
{
    if (log == NULL)
        return;
    tdestroy(log->tree, free_no_entry);
    for (size_t i = 0; i < log->n; i++)
        entry_free(log->entries[i]);
    free(log->entries);
    free(log);
}

/* Adds a copy of a text, or increments the count of an equal entry. */
static void add_log_entry(wt_log *log, wt_severity severity, wt_log_topic topic, const char *file,
                          const char *place, const char *text)
{
    log_entry *new_entry = wt_alloc(1, sizeof *new_entry);
    new_entry->severity = severity;
    new_entry->topic = topic;
    new_entry->file = wt_strdup(file != NULL ? file : "");
    new_entry->place = wt_strdup(place != NULL ? place : "");
    new_entry->text = wt_strdup(text);
    new_entry->count = 1;
    log_entry *const *const found = tsearch(new_entry, &log->tree, compare_log_entries);
    if (found == NULL)
        out_of_memory(sizeof *new_entry);
    if (*found == new_entry) {
        log->entries = array_grow(log->entries, log->n, sizeof *log->entries);
        log->entries[log->n++] = new_entry;
        return;
    }
    (*found)->count++;
    entry_free(new_entry);
}

static void print_log_entry(wt_log *log, wt_severity severity, wt_log_topic topic, const char *file,
                            const char *place, const char *format, va_list arguments)
    WT_PRINTF(6, 0);
static void print_log_entry(wt_log *log, wt_severity severity, wt_log_topic topic, const char *file,
                            const char *place, const char *format, va_list arguments)
{
    if (log == NULL)
        return;
    char *text = NULL;
    const locale_t previous = clocale_enter();
    const int length = vasprintf(&text, format, arguments);
    clocale_leave(previous);
    if (length < 0)
        out_of_memory(sizeof *text);
    utf8_sanitize(text);
    add_log_entry(log, severity, topic, file, place, text);
    free(text);
}

void wt_log_add(wt_log *log, wt_severity severity, const char *file, const char *place,
                const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_log_entry(log, severity, WT_TOPIC_NONE, file, place, format, arguments);
    va_end(arguments);
}

void wt_log_add_topic(wt_log *log, wt_severity severity, wt_log_topic topic, const char *file,
                      const char *place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_log_entry(log, severity, topic, file, place, format, arguments);
    va_end(arguments);
}

size_t wt_log_count(const wt_log *log)
{
    return log != NULL ? log->n : 0;
}

wt_log_entry wt_log_get(const wt_log *log, size_t i)
{
    const log_entry *const e = log->entries[i];
    return (wt_log_entry){e->severity, e->topic, e->file, e->place, e->text, e->count};
}
