/* Text in the C locale, and UTF-8 text (Unicode standard, table 3-7). SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/text.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

static pthread_once_t once = PTHREAD_ONCE_INIT;
static locale_t c_locale = (locale_t)0;

static void create_c_locale(void)
{
    c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

locale_t clocale_enter(void)
{
    (void)pthread_once(&once, create_c_locale);
    /* uselocale((locale_t)0) changes nothing, which is right if the C locale could not be
     * created. */
    return uselocale(c_locale);
}

void clocale_leave(locale_t previous)
{
    (void)uselocale(previous);
}

int clocale_vprint(char *buffer, size_t size, const char *format, va_list arguments)
{
    const locale_t previous = clocale_enter();
    const int needed = vsnprintf(buffer, size, format, arguments);
    clocale_leave(previous);
    return needed;
}

void clocale_append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    (void)clocale_vprint(text + used, size - used, format, arguments);
    va_end(arguments);
}

int clocale_print(char *buffer, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int needed = clocale_vprint(buffer, size, format, arguments);
    va_end(arguments);
    return needed;
}

/* ---- UTF-8 ----------------------------------------------------------------------------------- */

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
