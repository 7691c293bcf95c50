/* Display units.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/display_units.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "report/report_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct display_unit_series {
    const char *unit; /* SI */
    int power;        /* exponent of ten of the first label; each next one is less by three */
    const char *labels[5];
} display_unit_series;

/* Series of units, smallest first. */
static const display_unit_series choices[] = {
    {"m", 9, {"nm", "µm", "mm", "m"}},
    {"N", 12, {"pN", "nN", "µN", "mN", "N"}},
    {"Pa", 0, {"Pa", "kPa", "MPa", "GPa"}},
    {"s", 9, {"ns", "µs", "ms", "s"}},
    {"m/s", 9, {"nm/s", "µm/s", "mm/s", "m/s"}},
    {"m/V", 9, {"nm/V", "µm/V"}},
    {"W/m^2", 0, {"W/m²", "kW/m²", "MW/m²"}},
    {"W/m^3", 0, {"W/m³", "kW/m³", "MW/m³", "GW/m³"}},
    {"J/m^3", 0, {"J/m³", "kJ/m³", "MJ/m³", "GJ/m³"}},
    {"J/mol", 0, {"J/mol", "kJ/mol"}},
    {"m^2/N", 9, {"mm³/(N·m)"}},
    {"m^4", 0, {"m⁴"}},
    {"byte", 0, {"byte"}},
    {"1", 0, {""}},
    {"", 0, {""}},
};

display_unit select_display_unit(wt_quantity quantity, const char *unit, double magnitude)
{
    if (unit == NULL)
        unit = wt_quantity_unit(quantity);
    display_unit lab = {.factor = 1, .offset = 0, .label = ""};
    if (quantity == WT_Q_TEMPERATURE && strcmp(unit, "K") == 0) {
        lab.offset = -WT_ZERO_CELSIUS;
        (void)strcpy(lab.label, "°C");
        return lab;
    }
    if (strcmp(unit, "rad") == 0) {
        lab.factor = 180 / M_PI;
        (void)strcpy(lab.label, "°");
        return lab;
    }
    const display_unit_series *choice = choices, *end = choices + sizeof choices / sizeof *choices;
    while (choice < end && strcmp(choice->unit, unit) != 0)
        choice++;
    if (choice == end)
        (void)snprintf(lab.label, sizeof lab.label, "%s", unit);
    for (int i = 0; choice < end && i < 5 && choice->labels[i] != NULL; i++) {
        double factor = pow(10, choice->power - 3 * i);
        // A tolerance of a thousandth: 0.99999 µm by rounding is still 1 µm.
        if (i > 0 && !(isfinite(magnitude) && fabs(magnitude) * factor >= 0.999))
            continue;
        lab.factor = factor;
        (void)snprintf(lab.label, sizeof lab.label, "%s", choice->labels[i]);
    }
    return lab;
}

double to_display_value(const display_unit *lab, double value)
{
    return value * lab->factor + lab->offset;
}

display_value_text format_display_value(wt_quantity quantity, const char *unit, double value)
{
    display_unit lab = select_display_unit(quantity, unit, value);
    bool bare = !isfinite(value) || lab.label[0] == '\0';
    display_value_text text;
    (void)snprintf(text.chars, sizeof text.chars, "%s%s%s",
                   SHORT_NUMBER(to_display_value(&lab, value), 3), bare ? "" : " ",
                   bare ? "" : lab.label);
    return text;
}

display_value_text format_display_row(row_number number)
{
    const row_number_text shown = row_number_format(&number);
    display_value_text text;
    text_buffer words = {0};
    text_typographic(&words, shown.value);
    text_add(&words, shown.interval[0] != '\0' ? " (95 %: " : "");
    text_typographic(&words, shown.interval);
    text_add(&words, shown.interval[0] != '\0' ? ")" : "");
    (void)snprintf(text.chars, sizeof text.chars, "%s", text_string(&words));
    text_free(&words);
    return text;
}

display_value_text format_display_estimate(const wt_estimate *estimate)
{
    display_value_text text = format_display_row(rows_estimate(*estimate));
    if (isnan(estimate->standard_error) && isfinite(estimate->value))
        (void)strcat(text.chars, " (error not known)");
    return text;
}

/* ---- formats of numbers ---------------------------------------------------------------------- */

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
