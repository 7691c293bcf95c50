/* Implements the status codes and the error object. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/text.h"

#include <stdarg.h>
#include <string.h>

#define STRINGIFY(x) #x

#define STRINGIFY_VALUE(x) STRINGIFY(x)

const char *wt_version(void)
{
    return STRINGIFY_VALUE(WT_VERSION_MAJOR) "." STRINGIFY_VALUE(
        WT_VERSION_MINOR) "." STRINGIFY_VALUE(WT_VERSION_PATCH);
}

const char *wt_status_text(wt_status status)
{
    static const char *const texts[] = {
#define STATUS_TEXT(name, text) text,
        WT_STATUS_LIST(STATUS_TEXT)
#undef STATUS_TEXT
    };
    const size_t i = (size_t)status;
    return i < sizeof texts / sizeof *texts ? texts[i] : "unknown status";
}

/* Replaces the end of a truncated text by "...", at a character boundary. */
static void mark_truncation(char *buffer, size_t size)
{
    const size_t cut = utf8_truncated_length(buffer, strlen(buffer), size - 4);
    memcpy(buffer + cut, "...", 4);
}

static void format_error_text(char *buffer, size_t size, const char *format, va_list arguments)
    WT_PRINTF(3, 0);
static void format_error_text(char *buffer, size_t size, const char *format, va_list arguments)
{
    const int needed = clocale_vprint(buffer, size, format, arguments);
    if (needed < 0)
        buffer[0] = '\0';
    else if ((size_t)needed >= size)
        mark_truncation(buffer, size);
    utf8_sanitize(buffer);
}

wt_status wt_fail(wt_error *err, wt_status status, const char *format, ...)
{
    if (err != NULL) {
        /* The arguments may point into *err: the text is formatted before the error is cleared. */
        char message[sizeof err->message];
        va_list arguments;
        va_start(arguments, format);
        format_error_text(message, sizeof message, format, arguments);
        va_end(arguments);
        *err = (wt_error)WT_ERROR_INIT;
        err->status = status;
        memcpy(err->message, message, sizeof message);
    }
    return status;
}

void wt_error_file(wt_error *err, const char *file)
{
    if (err == NULL || file == NULL || err->file[0] != '\0')
        return;
    err->file[sizeof err->file - 1] = '\0';
    strncpy(err->file, file, sizeof err->file - 1);
    if (strlen(file) >= sizeof err->file)
        mark_truncation(err->file, sizeof err->file);
}

#define DEFINE_ERROR_SETTER(part)                                                                  \
    void wt_error_##part(wt_error *err, const char *format, ...)                                   \
    {                                                                                              \
        if (err != NULL) {                                                                         \
            char text[sizeof err->part];                                                           \
            va_list arguments;                                                                     \
            va_start(arguments, format);                                                           \
            format_error_text(text, sizeof text, format, arguments);                               \
            va_end(arguments);                                                                     \
            memcpy(err->part, text, sizeof text);                                                  \
        }                                                                                          \
    }
DEFINE_ERROR_SETTER(place)
DEFINE_ERROR_SETTER(expected)
DEFINE_ERROR_SETTER(found)
DEFINE_ERROR_SETTER(advice)
DEFINE_ERROR_SETTER(options)
#undef DEFINE_ERROR_SETTER

bool wt_text_repeats(const char *text, const char *before)
{
    return before != NULL && strcmp(text, before) == 0;
}

size_t wt_error_format(const wt_error *err, char *buffer, size_t size)
{
    char file[sizeof err->file];
    memcpy(file, err->file, sizeof file);
    utf8_sanitize(file);
    const char *const message =
        err->message[0] != '\0' ? err->message : wt_status_text(err->status);
    const struct {
        const char *before, *text;
    } parts[] = {{"", file},
                 {": ", err->place},
                 {": ", message},
                 {"; expected ", err->expected},
                 {"; found ", err->found},
                 {"; ", err->advice}};
    size_t needed = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        if (parts[i].text[0] == '\0')
            continue;
        const char *const pieces[2] = {needed > 0 ? parts[i].before : "", parts[i].text};
        for (size_t k = 0; k < 2; k++) {
            const size_t length = strlen(pieces[k]);
            if (needed < size) {
                const size_t capacity = size - needed - 1;
                memcpy(buffer + needed, pieces[k], length < capacity ? length : capacity);
            }
            needed += length;
        }
    }
    if (size > 0) {
        buffer[needed < size ? needed : size - 1] = '\0';
        if (needed >= size && size >= 4)
            mark_truncation(buffer, size);
    }
    return needed;
}
