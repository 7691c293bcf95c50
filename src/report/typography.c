/* Replaces the ASCII spelling of numbers and units by the signs of the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/typography.h"

#include "core/base/array.h"

#include <stdlib.h>
#include <string.h>

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
    const size_t sign = *s == '-', n = count_digits(s + sign);
    if (n == 0)
        return 0;
    text_add(text, sign ? "⁻" : "");
    for (size_t i = 0; i < n; i++)
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
    const size_t power =
        s[n] == 'e' ? (s[n + 1] == '-') + count_digits(s + n + 1 + (s[n + 1] == '-')) : 0;
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
