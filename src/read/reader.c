/* Detects a format by the first bytes of a file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/reader.h"

#include <string.h>

bool peek_begins(const file_peek *peek, const char *bytes, size_t n)
{
    return peek->length >= n && memcmp(peek->bytes, bytes, n) == 0;
}

bool peek_contains(const file_peek *peek, const char *bytes, size_t n)
{
    return memmem(peek->bytes, peek->length, bytes, n) != NULL;
}

recognition recognition_result(bool matches, int score)
{
    return matches ? (recognition){.answer = ANSWER_YES, .score = score}
                   : (recognition){.answer = ANSWER_NO};
}
