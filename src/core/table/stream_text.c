/* Escapes text in the cells and keys of a stream. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/stream.h"

#include "core/base/utf8.h"

#include <string.h>

/* Escaped characters, and their letters after a backslash. The last two are escaped only at the
 * start of a text. */
static const char raw[] = "\t\n\r\\#-", letters[] = "tnr\\#-";
enum { ALWAYS_ESCAPED = 4 };

void stream_write_text(FILE *out, const char *text)
{
    const size_t length = strlen(text);
    if (length == 0) {
        (void)putc('-', out);
        return;
    }
    /* A row must differ from a comment, and a hyphen from the empty text. */
    if (text[0] == '#' || strcmp(text, "-") == 0)
        (void)putc('\\', out);
    size_t i = 0;
    while (i < length) {
        const size_t n = utf8_character_length(text + i, length - i);
        const unsigned char c = (unsigned char)text[i];
        const char *const escaped = memchr(raw, c, ALWAYS_ESCAPED);
        if (n > 1)
            (void)fwrite(text + i, 1, n, out);
        else if (escaped != NULL)
            (void)fprintf(out, "\\%c", letters[escaped - raw]);
        else if (n == 0 || c < ' ' || c == 0x7F)
            (void)fprintf(out, "\\x%02X", c);
        else
            (void)putc(c, out);
        i += n > 0 ? n : 1;
    }
}

static int hex_digit_value(char c)
{
    static const char digits[] = "0123456789ABCDEF";
    const char *const found = c != '\0' ? strchr(digits, c) : NULL;
    return found != NULL ? (int)(found - digits) : -1;
}

bool stream_unescape(char *text, size_t length)
{
    if (length == 1 && text[0] == '-')
        length = 0;
    size_t to = 0;
    for (size_t from = 0; from < length; from++) {
        char c = text[from];
        if (c == '\\') {
            from++;
            const char escape = from < length ? text[from] : '\0';
            const char *const letter = memchr(letters, escape, sizeof letters - 1);
            if (letter != NULL) {
                c = raw[letter - letters];
            } else if (escape == 'x' && length - from > 2) {
                const int high = hex_digit_value(text[from + 1]),
                          low = hex_digit_value(text[from + 2]);
                if (high < 0 || low < 0 || (high == 0 && low == 0))
                    return false;
                c = (char)(high * 16 + low);
                from += 2;
            } else {
                return false;
            }
        }
        text[to++] = c;
    }
    text[to] = '\0';
    return true;
}
