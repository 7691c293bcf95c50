/* Implements the reader that runs a description, and its detection.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include <stdlib.h>
#include <string.h>

/* Maximum number of bytes that the detection examines; some exports have long headers. */
#define PEEK_MAX ((size_t)1 << 18)

typedef enum probe_result { PROBE_NOT_FOUND, PROBE_FOUND, PROBE_MORE } probe_result;

/* True if the bytes are not text in any encoding. */
static bool is_binary(const file_peek *peek)
{
    const size_t n = peek->length < 1024 ? peek->length : 1024;
    size_t zeros = 0, controls = 0;
    for (size_t i = 0; i < n; i++) {
        const unsigned char c = peek->bytes[i];
        zeros += c == 0;
        controls += c > 0 && c < 0x20 && !(c >= '\t' && c <= '\r') && c != 0x1a && c != 0x1b;
    }
    /* UTF-16 text has at most one zero in two bytes */
    return 10 * zeros > 6 * n || 20 * controls > n;
}

static probe_result run_probe(const text_description *d, const text_probe *probe,
                              const text_lines *lines, bool whole)
{
    /* the last line of a part may be incomplete */
    const size_t complete = whole || lines->n == 0 ? lines->n : lines->n - 1;
    names_row names = {.separator = SEPARATOR_AUTO};
    bool found = false;
    for (size_t i = 0; i < complete && i < probe->within && !found; i++) {
        text_span line = lines->lines[i];
        if (probe->kind == PROBE_NAMES)
            found = names_extract(d, &line) &&
                    names_match(&names, d, line, d->names_separator, d->kinds);
        else if (probe->text != NULL)
            found = strstr(line.text, probe->text) != NULL;
        else
            found = pattern_match(&probe->pattern, line, NULL, 0);
    }
    names_free(&names);
    if (found)
        return PROBE_FOUND;
    return whole || complete >= probe->within ? PROBE_NOT_FOUND : PROBE_MORE;
}

/* ---- decoding shared by the descriptions ----------------------------------------------------- */

struct text_peek {
    bool is_text;
    bool whole;    /* true if no more bytes will be shown */
    size_t length; /* length up to a line end, so that no character is split */
    const text_lines *by_encoding[ENCODING_COUNT]; /* decoded text of each encoding, in `lines` */
    text_lines lines[ENCODING_COUNT];
    size_t n_lines;
};

static struct text_peek *text_peek_new(const file_peek *peek)
{
    struct text_peek *t = wt_alloc(1, sizeof *t);
    t->is_text = peek->length > 0 && !is_binary(peek);
    t->whole = peek->whole || peek->length >= PEEK_MAX;
    t->length = peek->length;
    while (!t->whole && t->length > 0 && peek->bytes[t->length - 1] != '\n' &&
           peek->bytes[t->length - 1] != '\r')
        t->length--;
    if (t->length == 0)
        t->length = peek->length;
    return t;
}

void text_peek_free(struct text_peek *peek)
{
    for (size_t i = 0; peek != NULL && i < peek->n_lines; i++)
        lines_free(&peek->lines[i]);
    free(peek);
}

/* Returns the decoded lines, which all descriptions with the same encoding share. *lines is NULL if
 * the bytes are not text. */
static wt_status text_peek_lines(file_peek *peek, text_encoding encoding, const text_lines **lines)
{
    *lines = NULL;
    if (peek->text == NULL)
        peek->text = text_peek_new(peek);
    struct text_peek *t = peek->text;
    *lines = t->by_encoding[encoding];
    if (!t->is_text || *lines != NULL)
        return WT_OK;
    const char *words = lines_encoding_name(peek->bytes, t->length, encoding);
    size_t i = 0;
    while (i < t->n_lines && strcmp(t->lines[i].encoding, words) != 0)
        i++;
    if (i == t->n_lines) {
        wt_status status = lines_decode(peek->bytes, t->length, encoding, &t->lines[i], peek->err);
        if (status != WT_OK)
            return status;
        t->n_lines++;
    }
    *lines = t->by_encoding[encoding] = &t->lines[i];
    return WT_OK;
}

/* ---- the reader --------------------------------------------------------------------------- */

static recognition detect(const file_reader *self, file_peek *peek)
{
    const text_description *d = NULL;
    const text_lines *lines = NULL;
    recognition answer = {.answer = ANSWER_NO};
    bool more = false;
    if (description_load(self->description, DESCRIPTION_DETECT, &d, peek->err) != WT_OK ||
        text_peek_lines(peek, d->encoding, &lines) == WT_E_MEMORY)
        answer.answer = ANSWER_FAILED;
    if (lines == NULL)
        return answer;
    int score = 0;
    for (size_t i = 0; i < d->n_probes; i++) {
        const text_probe *probe = &d->probes[i];
        const text_description *named = d;
        if (probe->kind == PROBE_NAMES &&
            description_load(self->description, DESCRIPTION_WHOLE, &named, peek->err) != WT_OK) {
            answer.answer = ANSWER_FAILED;
            return answer;
        }
        switch (run_probe(named, probe, lines, peek->text->whole)) {
        case PROBE_FOUND:
            if (probe->kind == PROBE_FORBID)
                return answer;
            score += probe->score;
            break;
        case PROBE_NOT_FOUND:
            if (probe->kind != PROBE_FORBID && probe->kind != PROBE_HINT)
                return answer;
            break;
        case PROBE_MORE:
            more = true;
            break;
        }
    }
    if (more) {
        answer.answer = ANSWER_MORE;
        answer.need = peek->length > PEEK_MAX / 2 ? PEEK_MAX : 2 * peek->length;
        return answer;
    }
    answer.answer = ANSWER_YES;
    answer.score = score < 1 ? 1 : score > 100 ? 100 : score;
    return answer;
}

file_reader text_reader(text_description *d)
{
    return (file_reader){
        .info = {.id = d->id,
                 .title = d->title,
                 .kinds = d->kinds,
                 .verified = d->verified,
                 .given_columns = d->given_columns,
                 .evidence = d->evidence,
                 .version = d->version},
        .description = d,
        .detect = detect,
        .force = (d->kinds & WT_KIND_FORCE) != 0 ? &text_force : NULL,
        .read_sweep = (d->kinds & WT_KIND_SWEEP) != 0 ? text_read_sweep : NULL,
        .read_spectrum = (d->kinds & WT_KIND_SPECTRUM) != 0 ? text_read_spectrum : NULL,
        .read_images = (d->kinds & WT_KIND_IMAGE) != 0 ? text_read_images : NULL,
        .read_record = (d->kinds & WT_KIND_RECORD) != 0 ? text_read_record : NULL,
        .describe = text_describe,
    };
}
