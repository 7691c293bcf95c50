/* Does a description fit the beginning of a file?
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include <string.h>

/* Some exports have long headers; what is not seen in this much is not there. */
#define PEEK_MAX ((size_t)1 << 18)

typedef enum probe_is { PROBE_NOT_FOUND, PROBE_FOUND, PROBE_MORE } probe_is;

/* A file with these bytes is not text in any encoding. */
static bool is_binary(const file_peek *peek)
{
    const size_t n = peek->length < 1024 ? peek->length : 1024;
    size_t zeros = 0, controls = 0;
    for (size_t i = 0; i < n; i++) {
        const unsigned char c = peek->bytes[i];
        zeros += c == 0;
        controls += c > 0 && c < 0x20 && !(c >= '\t' && c <= '\r') && c != 0x1a && c != 0x1b;
    }
    /* UTF-16 text has at most one zero in two bytes. */
    return 10 * zeros > 6 * n || 20 * controls > n;
}

static bool names_line(name_set *names, const text_description *d, const char *line, size_t length)
{
    if (d->has_names_line) {
        regmatch_t groups[2] = {{-1, -1}, {-1, -1}};
        if (!pattern_match(&d->names_line, line, length, groups, 2) || groups[1].rm_so < 0)
            return false;
        line += groups[1].rm_so;
        length = (size_t)(groups[1].rm_eo - groups[1].rm_so);
    } else if (d->comment != NULL && strncmp(line, d->comment, strlen(d->comment)) == 0) {
        line += strlen(d->comment);
        length -= strlen(d->comment);
    }
    return names_match(names, d, line, length, d->names_separator, d->kinds);
}

static probe_is look_for(const text_description *d, const text_probe *probe,
                         const text_lines *lines, bool whole)
{
    /* The last line of a part of a file may be half a line. */
    const size_t complete = whole || lines->n == 0 ? lines->n : lines->n - 1;
    name_set names = {.separator = SEPARATOR_AUTO};
    bool found = false;
    for (size_t i = 0; i < complete && i < probe->within && !found; i++) {
        size_t length;
        const char *line = lines_get(lines, i, &length);
        if (probe->kind == PROBE_NAMES)
            found = names_line(&names, d, line, length);
        else if (probe->text != NULL)
            found = strstr(line, probe->text) != NULL;
        else
            found = pattern_match(&probe->pattern, line, length, NULL, 0);
    }
    names_free(&names);
    if (found)
        return PROBE_FOUND;
    return whole || complete >= probe->within ? PROBE_NOT_FOUND : PROBE_MORE;
}

detector_match text_detect(const text_description *d, const file_peek *peek)
{
    detector_match match = {.answer = ANSWER_NO};
    text_lines lines = {.n = 0};
    bool more = false;
    const bool whole = peek->whole || peek->length >= PEEK_MAX;
    /* Up to a line end, so that no character is cut in two. */
    size_t length = peek->length;
    while (!whole && length > 0 && peek->bytes[length - 1] != '\n' &&
           peek->bytes[length - 1] != '\r')
        length--;
    if (peek->length == 0 || is_binary(peek) ||
        lines_decode(peek->bytes, length > 0 ? length : peek->length, d->encoding, &lines, NULL) !=
            WT_OK)
        return match;
    int score = 0;
    bool fits = true;
    for (size_t i = 0; i < d->n_probes && fits; i++) {
        const text_probe *probe = &d->probes[i];
        switch (look_for(d, probe, &lines, whole)) {
        case PROBE_FOUND:
            fits = probe->kind != PROBE_FORBID;
            score += probe->score;
            break;
        case PROBE_NOT_FOUND:
            fits = probe->kind == PROBE_FORBID || probe->kind == PROBE_HINT;
            break;
        case PROBE_MORE:
            more = true;
            break;
        }
    }
    lines_free(&lines);
    if (!fits)
        return match;
    if (more) {
        match.answer = ANSWER_MORE;
        match.need = peek->length > PEEK_MAX / 2 ? PEEK_MAX : 2 * peek->length;
        return match;
    }
    match.answer = ANSWER_YES;
    match.score = score < 1 ? 1 : score > 100 ? 100 : score;
    return match;
}
