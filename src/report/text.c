/* A text that grows, and the ways of writing into it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/text.h"

#include "base/utf8.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

void text_free(growing_text *text)
{
    free(text->bytes);
    *text = (growing_text){0};
}

void text_done(growing_text *part, growing_text *whole)
{
    whole->failed = whole->failed || part->failed;
    text_free(part);
}

const char *text_string(const growing_text *text)
{
    return text->bytes != NULL ? text->bytes : "";
}

static bool make_room(growing_text *text, size_t more)
{
    if (text->failed)
        return false;
    if (more > SIZE_MAX / 4 || text->length > SIZE_MAX / 4) {
        text->failed = true;
        return false;
    }
    size_t needed = text->length + more + 1;
    if (needed <= text->capacity)
        return true;
    size_t capacity = text->capacity < 256 ? 256 : text->capacity;
    while (capacity < needed)
        capacity *= 2;
    char *bytes = realloc(text->bytes, capacity);
    if (bytes == NULL) {
        text->failed = true;
        return false;
    }
    text->bytes = bytes;
    text->capacity = capacity;
    return true;
}

void text_bytes(growing_text *text, const char *bytes, size_t length)
{
    if (!make_room(text, length))
        return;
    memcpy(text->bytes + text->length, bytes, length);
    text->length += length;
    text->bytes[text->length] = '\0';
}

void text_add(growing_text *text, const char *string)
{
    text_bytes(text, string, strlen(string));
}

void text_format(growing_text *text, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    if (length < 0)
        text->failed = true;
    else if (make_room(text, (size_t)length)) {
        (void)vsnprintf(text->bytes + text->length, (size_t)length + 1, format, again);
        text->length += (size_t)length;
    }
    va_end(again);
    va_end(arguments);
}

/* Length of the character at s, 0 if it is not UTF-8 or not allowed in XML 1.0. */
static size_t character_length(const char *s, size_t left)
{
    size_t length = utf8_character(s, left);
    unsigned char first = (unsigned char)s[0];
    if (length == 1 && first < 0x20 && first != '\t' && first != '\n' && first != '\r')
        return 0;
    if (length == 3 && (memcmp(s, "\xef\xbf\xbe", 3) == 0 || memcmp(s, "\xef\xbf\xbf", 3) == 0))
        return 0;
    return length;
}

void text_html(growing_text *text, const char *string)
{
    size_t left = strlen(string);
    for (const char *s = string; left > 0;) {
        size_t length = character_length(s, left);
        if (length == 0) {
            text_add(text, "\xef\xbf\xbd");
            s++;
            left--;
            continue;
        }
        switch (*s) {
        case '&':
            text_add(text, "&amp;");
            break;
        case '<':
            text_add(text, "&lt;");
            break;
        case '>':
            text_add(text, "&gt;");
            break;
        case '"':
            text_add(text, "&quot;");
            break;
        case '\'':
            text_add(text, "&#39;");
            break;
        case '\r': // a literal one would be read back as a line feed
            text_add(text, "&#13;");
            break;
        default:
            text_bytes(text, s, length);
        }
        s += length;
        left -= length;
    }
}

void text_quoted(growing_text *text, const char *string)
{
    text_add(text, "'");
    for (const char *s = string; *s != '\0'; s++) {
        unsigned char c = (unsigned char)*s;
        if (c == '\'')
            text_add(text, "''");
        else if (c < 0x20 || c == 0x7f)
            text_add(text, " ");
        else if (c == '\\' && s[1] == '\0') // the last one would join this line to the next
            text_add(text, "\\ ");
        else
            text_bytes(text, s, 1);
    }
    text_add(text, "'");
}

void text_comment(growing_text *text, const char *string)
{
    text_add(text, "# ");
    for (const char *s = string; *s != '\0'; s++) {
        unsigned char c = (unsigned char)*s;
        // A backslash at the end would continue the comment, a back quote would run a command.
        if (c < 0x20 || c == 0x7f || c == '\\' || c == '`')
            text_add(text, " ");
        else
            text_bytes(text, s, 1);
    }
    text_add(text, "\n");
}

/* A whole number as exponent: "⁻⁷". */
static void superscript(growing_text *text, long value)
{
    static const char *const digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char plain[32];
    (void)snprintf(plain, sizeof plain, "%ld", value);
    for (const char *s = plain; *s != '\0'; s++)
        text_add(text, *s == '-' ? "⁻" : digit[*s - '0']);
}

enum { MAX_DIGITS = 17 };

/* |value| rounded to `count` significant digits; *exponent is that of the first one. The C library
 * writes the decimal mark of the locale, so only its digits are used. */
static void decimal_digits(double value, int count, char digits[MAX_DIGITS + 1], int *exponent)
{
    char plain[64];
    (void)snprintf(plain, sizeof plain, "%.*e", count - 1, fabs(value));
    int n = 0;
    const char *s = plain;
    for (; *s != '\0' && *s != 'e'; s++)
        if (*s >= '0' && *s <= '9' && n < count)
            digits[n++] = *s;
    digits[n] = '\0';
    *exponent = *s == 'e' ? (int)strtol(s + 1, NULL, 10) : 0;
}

static bool not_finite(growing_text *text, double value)
{
    if (isnan(value))
        text_add(text, "not known");
    else if (isinf(value))
        text_add(text, value < 0 ? "−∞" : "∞");
    else
        return false;
    return true;
}

/* Digits with the decimal point after the one of weight 10^0. */
static void add_plain(growing_text *text, const char *digits, int exponent)
{
    int count = (int)strlen(digits);
    if (exponent < 0) {
        text_add(text, "0.");
        for (int i = -1; i > exponent; i--)
            text_add(text, "0");
        text_add(text, digits);
        return;
    }
    for (int i = 0; i < count || i <= exponent; i++) {
        if (i == exponent + 1)
            text_add(text, ".");
        if (i < count)
            text_bytes(text, digits + i, 1);
        else
            text_add(text, "0");
    }
}

static void add_number(growing_text *text, double value, int significant, bool trim)
{
    if (not_finite(text, value))
        return;
    if (value == 0) {
        text_add(text, "0");
        return;
    }
    char digits[MAX_DIGITS + 1];
    int exponent = 0;
    int count = significant < 1 ? 1 : significant > MAX_DIGITS ? MAX_DIGITS : significant;
    int whole = 0; // exponent before rounding
    decimal_digits(value, MAX_DIGITS, digits, &whole);
    decimal_digits(value, count, digits, &exponent);
    bool plain = exponent >= -3 && whole <= 4;
    if (plain && whole + 1 > count)
        decimal_digits(value, whole + 1, digits, &exponent);
    for (size_t n = strlen(digits); trim && n > 1 && digits[n - 1] == '0'; n--)
        digits[n - 1] = '\0';
    if (value < 0)
        text_add(text, "−");
    add_plain(text, digits, plain ? exponent : 0);
    if (plain)
        return;
    text_add(text, "×10");
    superscript(text, exponent);
}

void text_number(growing_text *text, double value, int significant)
{
    add_number(text, value, significant, false);
}

void text_short(growing_text *text, double value, int significant)
{
    add_number(text, value, significant, true);
}

void text_fixed(growing_text *text, double value, int decimals)
{
    if (not_finite(text, value))
        return;
    enum { MAX_DECIMALS = 15 };
    char plain[400]; // 309 digits before the decimal mark at most
    int after = decimals < 0 ? 0 : decimals > MAX_DECIMALS ? MAX_DECIMALS : decimals;
    (void)snprintf(plain, sizeof plain, "%.*f", after, fabs(value));
    size_t length = strlen(plain), before = strspn(plain, "0123456789");
    if (value < 0 && strpbrk(plain, "123456789") != NULL)
        text_add(text, "−");
    text_bytes(text, plain, before);
    if (after > 0) { // the mark between is that of the locale
        text_add(text, ".");
        text_add(text, plain + length - (size_t)after);
    }
}

void text_literal(growing_text *text, double value)
{
    if (isnan(value)) {
        text_add(text, "NaN");
        return;
    }
    if (value == 0 || isinf(value)) {
        text_add(text, value == 0 ? "0" : value < 0 ? "-1e308" : "1e308");
        return;
    }
    char digits[MAX_DIGITS + 1];
    int exponent = 0;
    decimal_digits(value, 10, digits, &exponent);
    size_t n = strlen(digits);
    while (n > 1 && digits[n - 1] == '0')
        digits[--n] = '\0';
    text_add(text, value < 0 ? "-" : "");
    if (exponent >= -3 && exponent <= 5)
        add_plain(text, digits, exponent);
    else {
        add_plain(text, digits, 0);
        text_format(text, "e%d", exponent);
    }
    // 1/3 of whole numbers would be 0 in gnuplot.
    if (exponent >= 0 && exponent <= 5 && n <= (size_t)exponent + 1)
        text_add(text, ".0");
}
