/* Appends HTML and gnuplot text to a growing buffer.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report_text.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/text.h"
#include "report/report_tables.h"

#include <stdlib.h>
#include <string.h>

void text_free(text_buffer *text)
{
    free(text->bytes);
    *text = (text_buffer){0};
}

const char *text_string(const text_buffer *text)
{
    return text->bytes != NULL ? text->bytes : "";
}

static void reserve_bytes(text_buffer *text, size_t more)
{
    enum { FIRST = 256 };
    if (more > SIZE_MAX / 4 || text->length > SIZE_MAX / 4)
        out_of_memory(more);
    const size_t needed = text->length + more + 1;
    if (needed <= text->capacity)
        return;
    if (text->capacity < FIRST)
        text->capacity = FIRST;
    while (text->capacity < needed)
        text->capacity *= 2;
    text->bytes = wt_realloc(text->bytes, text->capacity, 1);
}

void text_bytes(text_buffer *text, const char *bytes, size_t length)
{
    reserve_bytes(text, length);
    memcpy(text->bytes + text->length, bytes, length);
    text->length += length;
    text->bytes[text->length] = '\0';
}

void text_add(text_buffer *text, const char *string)
{
    text_bytes(text, string, strlen(string));
}

void text_vformat(text_buffer *text, const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    if (length > 0) {
        reserve_bytes(text, (size_t)length);
        (void)vsnprintf(text->bytes + text->length, (size_t)length + 1, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
}

void text_format(text_buffer *text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    text_vformat(text, format, arguments);
    va_end(arguments);
}

void text_file_name(text_buffer *text, const char *name, size_t most)
{
    const size_t length = strlen(name);
    if (length > most) {
        text_add(text, "...");
        name += length - most;
        while ((*name & 0xC0) == 0x80) /* inside of a character */
            name++;
    }
    text_add(text, name);
}

#define REPLACEMENT "\xef\xbf\xbd" /* U+FFFD */

/* Returns the length of the character at s, 0 if it is not UTF-8 or not allowed in XML 1.0. */
static size_t xml_character_length(const char *s, size_t left)
{
    size_t length = utf8_character_length(s, left);
    unsigned char first = (unsigned char)s[0];
    if (length == 1 && first < 0x20 && first != '\t' && first != '\n' && first != '\r')
        return 0;
    if (length == 3 && (memcmp(s, "\xef\xbf\xbe", 3) == 0 || memcmp(s, "\xef\xbf\xbf", 3) == 0))
        return 0;
    return length;
}

/* Returns the entity of a character in markup, NULL for none. A literal carriage return would be
 * read as a line feed. */
static const char *character_entity(char c)
{
    static const char marks[] = "&<>\"'\r";
    static const char *const entities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;", "&#13;"};
    const char *const mark = memchr(marks, c, sizeof marks - 1);
    return mark != NULL ? entities[mark - marks] : NULL;
}

static void add_escaped(text_buffer *text, const char *string)
{
    size_t left = strlen(string);
    for (const char *s = string; left > 0;) {
        size_t length = xml_character_length(s, left), step = length > 0 ? length : 1;
        const char *entity = length == 0 ? REPLACEMENT : character_entity(*s);
        if (entity != NULL)
            text_add(text, entity);
        else
            text_bytes(text, s, length);
        s += step;
        left -= step;
    }
}

void text_html(text_buffer *text, const char *markup, ...)
{
    va_list arguments;
    va_start(arguments, markup);
    for (const char *mark = strchr(markup, '%'); mark != NULL; mark = strchr(markup, '%')) {
        text_bytes(text, markup, (size_t)(mark - markup));
        add_escaped(text, va_arg(arguments, const char *));
        markup = mark + strlen("%s");
    }
    text_add(text, markup);
    va_end(arguments);
}

void text_data_link(text_buffer *text, const char *media, const char *bytes, size_t length)
{
    static const char digits[] = "0123456789ABCDEF",
                      plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                "-._~:/,;=+*()!$@?";
    text_format(text, "data:%s;charset=utf-8,", media);
    for (const char *s = bytes; s < bytes + length;) {
        const char *first = s;
        while (s < bytes + length && memchr(plain, *s, sizeof plain - 1) != NULL)
            s++;
        text_bytes(text, first, (size_t)(s - first));
        if (s == bytes + length)
            break;
        const unsigned char c = (unsigned char)*s++;
        const char code[] = {'%', digits[c >> 4], digits[c & 15]};
        text_bytes(text, code, sizeof code);
    }
}

/* Characters that gnuplot interprets: quotes, escapes, commands, macros. Doubling single quotes is
 * no escape, as gnuplot 5.4 fails on it at either end of a string. */
#define SPECIAL "'\"\\`@"

void text_quoted(text_buffer *text, const char *string)
{
    const char *quote = strpbrk(string, SPECIAL) == NULL ? "'" : "\"";
    size_t left = strlen(string);
    text_add(text, quote);
    for (const char *s = string; left > 0;) {
        const size_t length = xml_character_length(s, left), step = length > 0 ? length : 1;
        const unsigned char c = (unsigned char)*s;
        if (c < 0x20 || c == 0x7f)
            text_add(text, " ");
        else if (length == 0)
            text_add(text, REPLACEMENT);
        else if (c == '"' || c == '\\')
            text_format(text, "\\%c", c);
        else if (c == '`' || c == '@')
            text_format(text, "\\%o", c);
        else if (c == '>' && s - string >= 2 && s[-1] == ']' && s[-2] == ']')
            text_add(text, " >"); // gnuplot does not escape it, and "]]>" is not allowed in XML
        else
            text_bytes(text, s, length);
        s += step;
        left -= step;
    }
    text_add(text, quote);
}

void text_tic_label(text_buffer *text, const char *string)
{
    text_buffer format = {0};
    for (const char *s = string; *s != '\0'; s++)
        text_bytes(&format, *s == '%' ? "%%" : s, *s == '%' ? 2 : 1);
    text_quoted(text, text_string(&format));
    text_free(&format);
}

void text_comment(text_buffer *text, const char *string)
{
    text_add(text, "# ");
    for (const char *s = string; *s != '\0'; s++) {
        unsigned char c = (unsigned char)*s;
        // A backslash at the end would continue the comment; a back quote would run a command.
        if (c < 0x20 || c == 0x7f || c == '\\' || c == '`')
            text_add(text, " ");
        else
            text_bytes(text, s, 1);
    }
    text_add(text, "\n");
}

void text_json(text_buffer *text, const char *string)
{
    static const char escaped[] = "\"\\<>&\x7f";
    size_t left = strlen(string);
    text_add(text, "\"");
    for (const char *c = string; left > 0;) {
        const size_t length = utf8_character_length(c, left), step = length > 0 ? length : 1;
        const unsigned char byte = (unsigned char)*c;
        if (length == 0)
            text_add(text, "\\ufffd");
        else if (byte < ' ' || strchr(escaped, byte) != NULL)
            text_format(text, "\\u%04x", byte);
        else
            text_bytes(text, c, length);
        c += step;
        left -= step;
    }
    text_add(text, "\"");
}

/* ---- typography ------------------------------------------------------------------------------ */

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/* True if a word, a number or a unit can begin after the character. */
static bool is_boundary(char before)
{
    return before == '\0' || strchr(" (/=;,", before) != NULL;
}

static size_t count_digits(const char *s)
{
    size_t n = 0;
    while (is_digit(s[n]))
        n++;
    return n;
}

/* Appends an exponent with an optional sign as superscript. Returns its length, 0 if there is none.
 */
static size_t append_superscript(text_buffer *text, const char *s)
{
    static const char *const digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const size_t sign = *s == '-' || *s == '+', n = count_digits(s + sign);
    if (n == 0)
        return 0;
    text_add(text, *s == '-' ? "⁻" : "");
    size_t i = 0;
    while (s[sign + i] == '0' && i + 1 < n) /* "e-05" is 10⁻⁵ */
        i++;
    for (; i < n; i++)
        text_add(text, digit[s[sign + i] - '0']);
    return sign + n;
}

/* Appends a number at the start of s: "-0.0612", "6.37e4". Returns its length. */
static size_t append_number(text_buffer *text, const char *s)
{
    const size_t sign = *s == '-';
    size_t n = sign + count_digits(s + sign);
    if (n == sign)
        return 0;
    if (s[n] == '.')
        n += 1 + count_digits(s + n + 1);
    text_add(text, sign ? "−" : "");
    text_bytes(text, s + sign, n - sign);
    const size_t with_sign = s[n] == 'e' && (s[n + 1] == '-' || s[n + 1] == '+');
    const size_t power = s[n] == 'e' ? with_sign + count_digits(s + n + 1 + with_sign) : 0;
    if (power == 0 || !is_digit(s[n + power]) || is_letter(s[n + 1 + power]))
        return n;
    text_add(text, "×10");
    return n + 1 + append_superscript(text, s + n + 1);
}

/* Appends a unit whose sign is not ASCII. Returns the length of its ASCII name, 0 if there is none.
 */
static size_t append_unit(text_buffer *text, const char *s)
{
    static const struct {
        const char *ascii, *shown;
    } units[] = {{"degC", "°C"}, {"um", "µm"}, {"uN", "µN"}, {">=", "≥"}};
    for (size_t i = 0; i < COUNT_OF(units); i++) {
        const size_t n = strlen(units[i].ascii);
        if (strncmp(s, units[i].ascii, n) == 0 && !is_letter(s[n])) {
            text_add(text, units[i].shown);
            return n;
        }
    }
    return 0;
}

void text_typographic(text_buffer *text, const char *ascii)
{
    char before = '\0';
    for (const char *s = ascii; *s != '\0';) {
        size_t n = 0;
        if (is_boundary(before))
            n = append_unit(text, s);
        if (n == 0 && is_boundary(before))
            n = append_number(text, s);
        if (n == 0 && *s == '^' && is_letter(before)) {
            const size_t power = append_superscript(text, s + 1);
            n = power > 0 ? power + 1 : 0;
        }
        if (n == 0) { /* whole words, so that characters of several bytes stay together */
            n = 1;
            while (s[n] != '\0' && s[n] != '^' && !is_boundary(s[n - 1]))
                n++;
            char *const word = wt_strndup(s, n);
            text_html(text, "%s", word);
            free(word);
        }
        before = s[n - 1];
        s += n;
    }
}

void text_json_list(text_buffer *text, const char *const *strings, size_t n)
{
    text_add(text, "[");
    for (size_t i = 0; i < n; i++) {
        text_add(text, i > 0 ? "," : "");
        text_json(text, strings[i]);
    }
    text_add(text, "]");
}

/* ---- verdicts -------------------------------------------------------------------------------- */

#define VERDICT_NAMES(name, id, text) {id, text},
static const char *const verdicts[][2] = {WT_CURVE_VERDICT_LIST(VERDICT_NAMES)};

const char *verdict_text(int verdict)
{
    return verdict >= 0 && verdict <= WT_CURVE_UNREADABLE ? verdicts[verdict][1] : "";
}

void append_verdict_text(text_buffer *to)
{
    for (int k = WT_CURVE_DOUBTFUL + 1; k <= WT_CURVE_UNREADABLE; k++) {
        text_add(to, k == WT_CURVE_DOUBTFUL + 1 ? "{" : ",");
        text_json(to, verdicts[k][0]);
        text_add(to, ":");
        text_json(to, verdicts[k][1]);
    }
    text_add(to, "}");
}

void text_sentence(text_buffer *text, const char *ascii)
{
    char *const sentence = wt_strdup(ascii);
    if (sentence[0] >= 'a' && sentence[0] <= 'z')
        sentence[0] = (char)(sentence[0] - 'a' + 'A');
    text_typographic(text, sentence);
    free(sentence);
}
