/* Reads the lines of an input as far as requested. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include <stdlib.h>
#include <string.h>

typedef struct feed_piece {
    text_lines lines;
    size_t first; /* index of its first line */
    struct feed_piece *next;
} feed_piece;

/* Returns the end of the last complete line. A CR at the end of the bytes is not complete, since an
 * LF may follow. */
static size_t complete_length(const unsigned char *bytes, size_t n)
{
    for (size_t end = n; end > 0; end--)
        if (bytes[end - 1] == '\n' || (bytes[end - 1] == '\r' && end < n))
            return end;
    return 0;
}

static wt_status add_bytes(text_feed *feed, const unsigned char *bytes, size_t n, wt_error *err)
{
    feed_piece *const piece = wt_alloc(1, sizeof *piece);
    const wt_status status = feed->at == 0
                                 ? lines_decode(bytes, n, feed->encoding, &piece->lines, err)
                                 : lines_decode_next(bytes, n, &piece->lines, err);
    if (status != WT_OK) {
        free(piece);
        return status;
    }
    if (feed->at == 0)
        feed->words = piece->lines.encoding;
    feed->at += n;
    feed->n_replaced += piece->lines.n_replaced;
    feed->end = piece->lines.end;
    piece->first = feed->n;
    feed->n += piece->lines.n;
    if (feed->last != NULL)
        feed->last->next = piece;
    else
        feed->first = piece;
    feed->last = piece;
    return WT_OK;
}

static wt_status read_whole_input(text_feed *feed, wt_error *err)
{
    const unsigned char *bytes = NULL;
    const wt_status status = wt_input_bytes(feed->input, &bytes, &feed->size, err);
    return status == WT_OK ? add_bytes(feed, bytes, feed->size, err) : status;
}

/* Reads the next piece, which grows for a line that is longer than a piece. */
static wt_status read_next_piece(text_feed *feed, wt_error *err)
{
    const size_t left = feed->size - feed->at;
    for (size_t n = feed->piece;; n = n > SIZE_MAX / 2 ? SIZE_MAX : 2 * n) {
        n = n < left ? n : left;
        if (n > feed->buffer_size) {
            feed->buffer = wt_realloc(feed->buffer, n, 1);
            feed->buffer_size = n;
        }
        const wt_status status = wt_input_copy(feed->input, feed->at, feed->buffer, n, err);
        if (status != WT_OK)
            return status;
        const size_t whole = n == left ? n : complete_length(feed->buffer, n);
        if (whole > 0)
            return add_bytes(feed, feed->buffer, whole, err);
    }
}

static wt_status read_more(text_feed *feed, wt_error *err)
{
    wt_status status = WT_OK;
    if (!feed->began && feed->piece == SIZE_MAX)
        status = read_whole_input(feed, err);
    else if (!feed->began)
        status = wt_input_size(feed->input, &feed->size, err);
    feed->began = status == WT_OK;
    if (status == WT_OK && feed->at < feed->size)
        status = read_next_piece(feed, err);
    return status;
}

wt_status feed_line(text_feed *feed, size_t i, text_span *line, wt_error *err)
{
    while (i >= feed->n) {
        if (feed->began && feed->at == feed->size)
            return WT_END;
        const wt_status status = read_more(feed, err);
        if (status != WT_OK)
            return status;
    }
    const feed_piece *piece = feed->first;
    while (i - piece->first >= piece->lines.n)
        piece = piece->next;
    *line = piece->lines.lines[i - piece->first];
    return WT_OK;
}

line_end feed_line_end(const text_feed *feed, size_t i)
{
    return i + 1 == feed->n && feed->at == feed->size ? feed->end : END_WHOLE;
}

static void discard_first(text_feed *feed)
{
    feed_piece *const piece = feed->first;
    feed->first = piece->next;
    if (feed->first == NULL)
        feed->last = NULL;
    lines_free(&piece->lines);
    free(piece);
}

void feed_discard(text_feed *feed, size_t i)
{
    while (feed->first != NULL && i - feed->first->first >= feed->first->lines.n)
        discard_first(feed);
}

void feed_free(text_feed *feed)
{
    while (feed != NULL && feed->first != NULL)
        discard_first(feed);
    if (feed != NULL)
        free(feed->buffer);
    free(feed);
}
