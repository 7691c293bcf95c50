/* Log of notes and warnings. Each text is stored once for a file, with a count.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/text.h"

#include <search.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

typedef struct log_entry {
    wt_severity severity;
    wt_log_topic topic;
    wt_action action;
    size_t n_values;
    char *option; /* NULL if none */
    char *file, *place, *text;
    size_t count, like;
} log_entry;

struct wt_log {
    log_entry **entries; /* in order of arrival */
    size_t n;
    void *tree, *texts; /* for tsearch: the same entries, and the first one of each text */
};

static int compare_log_texts(const void *a, const void *b)
{
    const log_entry *const p = a, *const q = b;
    return p->severity != q->severity ? (p->severity < q->severity ? -1 : 1)
                                      : strcmp(p->text, q->text);
}

static int compare_log_entries(const void *a, const void *b)
{
    const log_entry *const p = a, *const q = b;
    const int by_file = strcmp(p->file, q->file);
    return by_file != 0 ? by_file : compare_log_texts(p, q);
}

static void entry_free(log_entry *e)
{
    free(e->option);
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
    tdestroy(log->texts, free_no_entry);
    for (size_t i = 0; i < log->n; i++)
        entry_free(log->entries[i]);
    free(log->entries);
    free(log);
}

/* Adds an entry, or increments the count of an equal one. The log owns new_entry. */
static void add_log_entry(wt_log *log, log_entry *new_entry)
{
    log_entry *const *const found = tsearch(new_entry, &log->tree, compare_log_entries);
    if (found == NULL)
        out_of_memory(sizeof *new_entry);
    if (*found == new_entry) {
        log_entry *const *const first = tsearch(new_entry, &log->texts, compare_log_texts);
        if (first == NULL)
            out_of_memory(sizeof *new_entry);
        new_entry->like = *first == new_entry ? log->n : (*first)->like;
        log->entries = array_grow(log->entries, log->n, sizeof *log->entries);
        log->entries[log->n++] = new_entry;
        return;
    }
    (*found)->count += new_entry->count;
    (*found)->n_values += new_entry->n_values;
    entry_free(new_entry);
}

/* Completes a copy of `shape` with its texts and adds it. */
static void print_log_entry(wt_log *log, const log_entry *shape, const char *file,
                            const char *place, const char *format, va_list arguments)
    WT_PRINTF(5, 0);
static void print_log_entry(wt_log *log, const log_entry *shape, const char *file,
                            const char *place, const char *format, va_list arguments)
{
    if (log == NULL)
        return;
    log_entry *const e = wt_alloc(1, sizeof *e);
    *e = *shape;
    e->count = shape->count > 0 ? shape->count : 1;
    e->option = shape->option != NULL ? wt_strdup(shape->option) : NULL;
    e->file = wt_strdup(file != NULL ? file : "");
    e->place = wt_strdup(place != NULL ? place : "");
    const locale_t previous = clocale_enter();
    const int length = vasprintf(&e->text, format, arguments);
    clocale_leave(previous);
    if (length < 0)
        out_of_memory(sizeof *e->text);
    utf8_sanitize(e->text);
    add_log_entry(log, e);
}

void wt_log_add(wt_log *log, wt_severity severity, const char *file, const char *place,
                const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_log_entry(log, &(log_entry){.severity = severity}, file, place, format, arguments);
    va_end(arguments);
}

void wt_log_add_topic(wt_log *log, wt_severity severity, wt_log_topic topic, const char *file,
                      const char *place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_log_entry(log, &(log_entry){.severity = severity, .topic = topic}, file, place, format,
                    arguments);
    va_end(arguments);
}

void wt_log_action(wt_log *log, wt_severity severity, wt_action action, size_t n_values,
                   const char *option, const char *file, const char *place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_log_entry(
        log,
        &(log_entry){
            .severity = severity, .action = action, .n_values = n_values, .option = (char *)option},
        file, place, format, arguments);
    va_end(arguments);
}

static void append_entry(wt_log *log, const log_entry *e, const char *format, ...) WT_PRINTF(3, 4);
static void append_entry(wt_log *log, const log_entry *e, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_log_entry(log, e, e->file, e->place, format, arguments);
    va_end(arguments);
}

void wt_log_append(wt_log *to, const wt_log *from, const char *prefix)
{
    for (size_t i = 0; to != NULL && i < wt_log_count(from); i++)
        append_entry(to, from->entries[i], "%s%s%s", prefix != NULL ? prefix : "",
                     prefix != NULL ? ": " : "", from->entries[i]->text);
}

size_t wt_log_count(const wt_log *log)
{
    return log != NULL ? log->n : 0;
}

wt_log_entry wt_log_get(const wt_log *log, size_t i)
{
    const log_entry *const e = log->entries[i];
    return (wt_log_entry){.severity = e->severity,
                          .topic = e->topic,
                          .action = e->action,
                          .n_values = e->n_values,
                          .option = e->option != NULL ? e->option : "",
                          .file = e->file,
                          .place = e->place,
                          .text = e->text,
                          .count = e->count,
                          .like = e->like};
}
