/* Numbers as text, independent of the locale. SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/number.h"
#include "base/clocale.h"
#include "weartrack/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Far more digits than any instrument writes; what is longer is not a number of this trade. */
enum { NUMBER_MAX = 512 };

static bool is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static size_t skip_digits(const char *text, size_t length, size_t i)
{
    while (i < length && text[i] >= '0' && text[i] <= '9')
        i++;
    return i;
}

/* strtod alone would also take hexadecimal digits, "nan" and "infinity". */
size_t number_prefix(const char *text, size_t length, char decimal)
{
    size_t i = 0;
    if (i < length && (text[i] == '+' || text[i] == '-'))
        i++;
    const size_t whole = i;
    i = skip_digits(text, length, i);
    size_t digits = i - whole;
    if (i < length && text[i] == decimal) {
        const size_t fraction = i + 1;
        const size_t end = skip_digits(text, length, fraction);
        digits += end - fraction;
        i = end;
    }
    if (digits == 0)
        return 0;
    if (i < length && (text[i] == 'e' || text[i] == 'E')) {
        size_t exponent = i + 1;
        if (exponent < length && (text[exponent] == '+' || text[exponent] == '-'))
            exponent++;
        const size_t end = skip_digits(text, length, exponent);
        if (end > exponent)
            i = end;
    }
    return i;
}

bool wt_number_parse(const char *text, size_t length, char decimal, double *value)
{
    char copy[NUMBER_MAX];
    while (length > 0 && is_blank(text[0])) {
        text++;
        length--;
    }
    while (length > 0 && is_blank(text[length - 1]))
        length--;
    if (length == 0 || length >= sizeof copy || number_prefix(text, length, decimal) != length)
        return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    char *const mark = decimal == '.' ? NULL : memchr(copy, decimal, length);
    if (mark != NULL)
        *mark = '.';
    const locale_t previous = clocale_enter();
    const double parsed = strtod(copy, NULL);
    clocale_leave(previous);
    if (!isfinite(parsed))
        return false;
    *value = parsed;
    return true;
}

double number_of(const char *text)
{
    double value = (double)NAN;
    return text != NULL && wt_number_parse(text, strlen(text), '.', &value) ? value : (double)NAN;
}

bool number_read(const char *text, size_t length, double *value)
{
    static const struct {
        const char *text;
        double value;
    } special[] = {{"nan", (double)NAN}, {"inf", (double)INFINITY}, {"-inf", -(double)INFINITY}};
    for (size_t i = 0; i < sizeof special / sizeof *special; i++) {
        if (length == strlen(special[i].text) && memcmp(text, special[i].text, length) == 0) {
            *value = special[i].value;
            return true;
        }
    }
    return wt_number_parse(text, length, '.', value);
}

/* "1e-05" to "1e-5", "1e+20" to "1e20". */
static size_t shorten_exponent(char *text, size_t length)
{
    char *const e = memchr(text, 'e', length);
    if (e == NULL)
        return length;
    char *to = e + 1;
    const char *from = e + 1;
    if (*from == '-')
        *to++ = *from++;
    else if (*from == '+')
        from++;
    while (*from == '0' && from[1] != '\0')
        from++;
    while (*from != '\0')
        *to++ = *from++;
    *to = '\0';
    return (size_t)(to - text);
}

double number_to_tens(double value, int decimals)
{
    const double tens = pow(10, decimals < 0 ? -decimals : 0);
    return decimals < 0 ? tens * round(value / tens) : value;
}

chance_words number_chance(double chance)
{
    chance_words words;
    clocale_print(words.text, sizeof words.text,
                  isnan(chance)   ? "not known"
                  : chance < 1e-3 ? "below 0.001"
                                  : "%.2g",
                  chance);
    return words;
}

/* A whole number of up to 15 digits, as %.15g writes it. */
static size_t format_whole(double value, char *buffer)
{
    char digits[16];
    size_t n = 0, length = 0;
    uint64_t left = (uint64_t)fabs(value);
    do
        digits[n++] = (char)('0' + left % 10);
    while ((left /= 10) > 0);
    if (signbit(value))
        buffer[length++] = '-';
    while (n > 0)
        buffer[length++] = digits[--n];
    buffer[length] = '\0';
    return length;
}

size_t wt_number_format(double value, char *buffer)
{
    enum { SIZE = 32 };
    if (!isfinite(value)) {
        const char *const text = isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
        const size_t length = strlen(text);
        memcpy(buffer, text, length + 1);
        return length;
    }
    if (fabs(value) < 1e15 && !(fabs(value - trunc(value)) > 0))
        return format_whole(value, buffer);
    /* Any decimal number of 15 digits survives a normal double, so 15 digits without their trailing
     * zeros are the shortest text if they read back. Subnormal numbers hold fewer digits. */
    const bool subnormal = fpclassify(value) == FP_SUBNORMAL;
    const locale_t previous = clocale_enter();
    int length = 0;
    for (int digits = subnormal ? 1 : 15; digits <= 17; digits++) {
        length = snprintf(buffer, SIZE, "%.*g", digits, value);
        if (strtod(buffer, NULL) == value)
            break;
    }
    clocale_leave(previous);
    return shorten_exponent(buffer, (size_t)length);
}
