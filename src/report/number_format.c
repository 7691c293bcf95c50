/* Formats numbers for display and for gnuplot.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/number_format.h"

#include "core/base/clocale.h"
#include "core/base/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DIGITS = 17, PLAIN_SIZE = MAX_DIGITS + 8 };

/* Formats an integer as a power of ten: "×10⁻⁷". */
static void format_power_of_ten(int exponent, char chars[PLAIN_SIZE])
{
    static const char *const digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char plain[8];
    (void)snprintf(plain, sizeof plain, "%d", exponent);
    (void)strcpy(chars, "×10");
    for (const char *s = plain; *s != '\0'; s++)
        (void)strcat(chars, *s == '-' ? "⁻" : digit[*s - '0']);
}

/* Rounds |value| to `count` significant digits; returns the exponent of the first one. */
static int decimal_digits(double value, int count, char digits[MAX_DIGITS + 1])
{
    char plain[MAX_DIGITS + 8];
    (void)clocale_print(plain, sizeof plain, "%.*e", count - 1, fabs(value));
    digits[0] = plain[0];
    memcpy(digits + 1, plain + 2, (size_t)count - 1); // after the point
    digits[count] = '\0';
    return atoi(strchr(plain, 'e') + 1);
}

static void trim_zeros(char *digits)
{
    for (size_t n = strlen(digits); n > 1 && digits[n - 1] == '0'; n--)
        digits[n - 1] = '\0';
}

/* Inserts the decimal point after the digit of weight 10^0; for exponents from -3 to 17. */
static void format_plain_number(const char *digits, int exponent, char chars[PLAIN_SIZE])
{
    int count = (int)strlen(digits), n = 0;
    for (int i = exponent < 0 ? exponent : 0; i < count || i <= exponent; i++) {
        if (i == exponent + 1)
            chars[n++] = '.';
        chars[n++] = i < 0 || i >= count ? '0' : digits[i];
    }
    chars[n] = '\0';
}

static number_text format_not_finite(double value)
{
    number_text number;
    (void)snprintf(number.chars, sizeof number.chars, "%s",
                   isnan(value) ? "not known"
                   : value < 0  ? "−∞"
                                : "∞");
    return number;
}

number_text number_rounded(double value, int significant, bool trimmed)
{
    number_text number = {"0"};
    char digits[MAX_DIGITS + 1], chars[PLAIN_SIZE], power[PLAIN_SIZE] = "";
    int count = significant < 1 ? 1 : significant > MAX_DIGITS ? MAX_DIGITS : significant;
    if (!isfinite(value))
        return format_not_finite(value);
    if (value == 0)
        return number;
    int whole = decimal_digits(value, MAX_DIGITS, digits); // exponent before rounding
    int exponent = decimal_digits(value, count, digits);
    bool plain = exponent >= -3 && whole <= 4;
    if (plain && whole + 1 > count)
        exponent = decimal_digits(value, whole + 1, digits);
    if (trimmed)
        trim_zeros(digits);
    format_plain_number(digits, plain ? exponent : 0, chars);
    if (!plain)
        format_power_of_ten(exponent, power);
    (void)snprintf(number.chars, sizeof number.chars, "%s%s%s", value < 0 ? "−" : "", chars, power);
    return number;
}

number_text number_fixed(double value, int decimals)
{
    enum { MAX_DECIMALS = 15, MARK = sizeof "−" - 1 };
    number_text number = {"−"};
    int after = decimals < 0 ? 0 : decimals > MAX_DECIMALS ? MAX_DECIMALS : decimals;
    if (!isfinite(value))
        return format_not_finite(value);
    (void)clocale_print(number.chars + MARK, sizeof number.chars - MARK, "%.*f", after,
                        fabs(value));
    if (value >= 0 || strpbrk(number.chars, "123456789") == NULL)
        memmove(number.chars, number.chars + MARK, strlen(number.chars + MARK) + 1);
    return number;
}

number_text number_literal(double value)
{
    if (isnan(value) || value == 0)
        return isnan(value) ? (number_text){"NaN"} : (number_text){"0"};
    if (isinf(value))
        return value < 0 ? (number_text){"-1e308"} : (number_text){"1e308"};
    number_text number;
    char digits[MAX_DIGITS + 1], chars[PLAIN_SIZE], power[8] = "";
    int exponent = decimal_digits(value, 10, digits);
    trim_zeros(digits);
    bool plain = exponent >= -3 && exponent <= 5;
    if (!plain)
        (void)snprintf(power, sizeof power, "e%d", exponent);
    else if ((int)strlen(digits) <= exponent + 1) // gnuplot divides integers as integers: 1/3 = 0
        (void)strcpy(power, ".0");
    format_plain_number(digits, plain ? exponent : 0, chars);
    (void)snprintf(number.chars, sizeof number.chars, "%s%s%s", value < 0 ? "-" : "", chars, power);
    return number;
}

double number_to_digits(double value, int significant)
{
    char text[MAX_DIGITS + 10];
    double rounded = value;
    const int length = clocale_print(text, sizeof text, "%.*e", significant - 1, value);
    return isfinite(value) && parse_stored_number(text, (size_t)length, &rounded) ? rounded : value;
}
