/* Writes JSON strings. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/json.h"

#include <string.h>

#include "core/base/utf8.h"

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
