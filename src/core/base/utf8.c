/* Checks UTF-8 text (Unicode standard, table 3-7). SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/utf8.h"

#include <stdio.h>
#include <string.h>

void json_write_text(FILE *out, const char *text)
{
    (void)putc('"', out);
    for (size_t left = strlen(text), n; left > 0; text += n, left -= n) {
        const unsigned char c = (unsigned char)*text;
        n = utf8_character_length(text, left);
        if (n == 0) {
            (void)fputs("\\ufffd", out);
            n = 1;
        } else if (c < ' ') {
            (void)fprintf(out, "\\u%04x", c);
        } else {
            if (c == '"' || c == '\\')
                (void)putc('\\', out);
            (void)fwrite(text, 1, n, out);
        }
    }
    (void)putc('"', out);
}

size_t utf8_character_length(const char *text, size_t length)
{
    const unsigned char *s = (const unsigned char *)text;
    size_t n;
    unsigned char low = 0x80, high = 0xBF; /* range of the second byte */
    if (length == 0)
        return 0;
    if (s[0] < 0x80)
        return 1;
    if (s[0] >= 0xC2 && s[0] <= 0xDF) {
        n = 2;
    } else if (s[0] >= 0xE0 && s[0] <= 0xEF) {
        n = 3;
        if (s[0] == 0xE0)
            low = 0xA0;
        if (s[0] == 0xED)
            high = 0x9F;
    } else if (s[0] >= 0xF0 && s[0] <= 0xF4) {
        n = 4;
        if (s[0] == 0xF0)
            low = 0x90;
        if (s[0] == 0xF4)
            high = 0x8F;
    } else {
        return 0;
    }
    if (length < n || s[1] < low || s[1] > high)
        return 0;
    for (size_t i = 2; i < n; i++) {
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    }
    return n;
}

size_t utf8_valid_length(const char *text, size_t length)
{
    size_t i = 0;
    while (i < length) {
        const size_t n =
            (unsigned char)text[i] < 0x80 ? 1 : utf8_character_length(text + i, length - i);
        if (n == 0)
            return i;
        i += n;
    }
    return length;
}

size_t utf8_truncated_length(const char *text, size_t length, size_t limit)
{
    size_t i = 0;
    while (i < length) {
        size_t n = utf8_character_length(text + i, length - i);
        if (n == 0)
            n = 1;
        if (i + n > limit)
            return i;
        i += n;
    }
    return length;
}

void utf8_copy(char *to, size_t size, const char *text)
{
    const size_t n = utf8_truncated_length(text, strlen(text), size - 1);
    memcpy(to, text, n);
    to[n] = '\0';
}

void utf8_sanitize(char *text)
{
    const size_t length = strlen(text);
    size_t i = 0;
    while (i < length) {
        const size_t n = utf8_character_length(text + i, length - i);
        if (n == 0)
            text[i] = '?';
        else if (n == 1 && ((unsigned char)text[i] < 0x20 || text[i] == 0x7F))
            text[i] = ' ';
        i += n > 0 ? n : 1;
    }
}
