/* Wraps text between words. SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "cmd/cmd.h"

size_t cmd_text_width(const char *text, size_t n)
{
    size_t width = 0;
    for (size_t i = 0; i < n; i++)
        width += ((unsigned char)text[i] & 0xC0) != 0x80;
    return width;
}

size_t cmd_text_fit(const char *text, size_t length, size_t width)
{
    size_t n = 0;
    for (size_t used = 0; n < length; n++) {
        used += ((unsigned char)text[n] & 0xC0) != 0x80;
        if (used > width)
            break;
    }
    return n;
}

void cmd_print_argument(FILE *out, const char *word)
{
    static const char plain[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./=,:@";
    const char *mark = word[strspn(word, plain)] != '\0' ? "'" : "";
    fprintf(out, " %s", mark);
    for (const char *p = word; *p != '\0'; p++)
        if (*p == '\'')
            fputs("'\\''", out);
        else
            fputc((unsigned char)*p < ' ' ? '?' : *p, out);
    fputs(mark, out);
}

void cmd_wrap(FILE *out, size_t column, size_t indent, const char *text)
{
    bool begin = true; /* the line has no text yet */
    for (const char *p = text; *p != '\0';) {
        const size_t blanks = strspn(p, " ");
        size_t word = strcspn(p + blanks, " \n");
        if (p[blanks + word] == ' ' &&
            p[blanks + word + 1] == '%') /* a number keeps its percent sign */
            word += 1 + strcspn(p + blanks + word + 1, " \n");
        const size_t width = cmd_text_width(p, blanks + word);
        if (!begin && column + width > CMD_SCREEN_WIDTH) {
            fprintf(out, "\n%*s", (int)indent, "");
            column = indent;
            begin = true;
        }
        const size_t skip = begin ? blanks : 0;
        fwrite(p + skip, 1, blanks - skip + word, out);
        column += width - skip;
        begin = begin && word == 0;
        p += blanks + word;
        if (*p == '\n') {
            fprintf(out, "\n%*s", (int)indent, "");
            column = indent;
            begin = true;
            p++;
        }
    }
    fputc('\n', out);
}
