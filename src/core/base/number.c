/* Parses and formats numbers independently of the locale. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/number.h"
#include "core/base/text.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Range of the SI prefixes of a unit, as powers of 1000. */
typedef struct prefix_range {
    const char *unit;
    const char *text;
    int low, high;
} prefix_range;

/* Finds the prefixes of the first factor of the unit, unless it is raised to a power. */
static prefix_range find_prefix_range(const char *unit)
{
    static const prefix_range known[] = {
        {"Pa", "Pa", -8, 8}, {"Hz", "Hz", -8, 8}, {"N", "N", -8, 8},
        {"m", "m", -8, 1},   {"V", "V", -8, 8},   {"J", "J", -8, 8},
        {"W", "W", -8, 8},   {"s", "s", -8, 0},   {"byte", "B", 0, 8}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const size_t n = strlen(known[i].unit);
        if (strncmp(unit, known[i].unit, n) == 0 && (unit[n] == '\0' || strchr("/ .", unit[n])))
            return known[i];
    }
    return (prefix_range){"", "", 0, 0};
}

/* Formats the significant digits of value / 10^shift: plain for short numbers, otherwise with an
 * exponent. */
static void format_scaled_number(double value, int digits, int shift, char *buffer, size_t size)
{
    char scientific[48], shifted[64];
    (void)snprintf(scientific, sizeof scientific, "%.*e", digits - 1, value);
    char *const e = strchr(scientific, 'e');
    const int exponent = atoi(e + 1) - shift;
    *e = '\0';
    if (exponent < -3 || exponent > 5) {
        (void)snprintf(buffer, size, "%se%d", scientific, exponent);
        return;
    }
    (void)snprintf(shifted, sizeof shifted, "%se%d", scientific, exponent);
    const int decimals = digits - 1 - exponent;
    (void)snprintf(buffer, size, "%.*f", decimals > 0 ? decimals : 0, strtod(shifted, NULL));
}

size_t wt_format_si(double value, const char *unit, int digits, char *buffer, size_t size)
{
    static const char *const names[] = {"y", "z", "a", "f", "p", "n", "\xC2\xB5", "m", "",
                                        "k", "M", "G", "T", "P", "E", "Z",        "Y"};
    char number[64];
    int step = 0;
    prefix_range prefix = find_prefix_range(unit);
    const bool celsius = strcmp(unit, "degC") == 0 || strcmp(unit, "\xC2\xB0"
                                                                   "C") == 0;
    if (celsius) {
        value -= WT_ZERO_CELSIUS;
        unit = "\xC2\xB0"
               "C";
    }
    digits = digits < 1 ? 1 : digits > 17 ? 17 : digits;
    const locale_t previous = clocale_enter();
    if (!isfinite(value)) {
        (void)wt_number_format(value, number);
    } else {
        if (value != 0.0 && prefix.unit[0] != '\0') {
            /* The exponent is that after rounding: 999.96 kPa is 1.00 MPa. */
            char scientific[48];
            (void)snprintf(scientific, sizeof scientific, "%.*e", digits - 1, value);
            step = (int)floor(atoi(strchr(scientific, 'e') + 1) / 3.0);
            step = step < prefix.low ? prefix.low : step > prefix.high ? prefix.high : step;
        }
        format_scaled_number(value, digits, 3 * step, number, sizeof number);
    }
    const bool bare = unit[0] == '\0' || strcmp(unit, "1") == 0;
    const int needed =
        snprintf(buffer, size, "%s%s%s%s%s", number, bare ? "" : " ", names[step + 8], prefix.text,
                 bare ? "" : unit + strlen(prefix.unit));
    clocale_leave(previous);
    return needed > 0 ? (size_t)needed : 0;
}

/* Limits that agree to this number of digits are printed as equal. */
enum { RANGE_DIGITS_MAX = 9 };

/* Returns the number of digits, at least `least`, with which two numbers differ in print. */
static int range_digits(double low, double high, int least)
{
    for (int digits = least; digits <= RANGE_DIGITS_MAX; digits++) {
        char first[32], second[32];
        clocale_print(first, sizeof first, "%.*g", digits, low);
        clocale_print(second, sizeof second, "%.*g", digits, high);
        if (parse_number_or_nan(first) != parse_number_or_nan(second))
            return digits;
    }
    return least;
}

range_text format_range(double low, double high, int least)
{
    const int digits = range_digits(low, high, least);
    range_text ends;
    clocale_print(ends.text, sizeof ends.text, "%.*g to %.*g", digits, low, digits, high);
    return ends;
}

/* Limit for the length of a number. Instruments write far fewer digits. */
enum { NUMBER_MAX = 512 };

static bool is_white_space(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static size_t skip_digits(const char *text, size_t length, size_t i)
{
    while (i < length && text[i] >= '0' && text[i] <= '9')
        i++;
    return i;
}

/* Statistics programs write the minus sign U+2212, and word processors an en dash. Both have three
 * bytes. */
enum { MINUS_SIGN_LENGTH = 3 };

static bool is_minus_sign(const char *text, size_t length)
{
    return length >= MINUS_SIGN_LENGTH && (memcmp(text, "\xe2\x88\x92", MINUS_SIGN_LENGTH) == 0 ||
                                           memcmp(text, "\xe2\x80\x93", MINUS_SIGN_LENGTH) == 0);
}

static size_t skip_sign(const char *text, size_t length, size_t i)
{
    if (i < length && (text[i] == '+' || text[i] == '-'))
        return i + 1;
    return is_minus_sign(text + i, length - i) ? i + MINUS_SIGN_LENGTH : i;
}

/* strtod alone would also accept hexadecimal digits, "nan" and "infinity". */
size_t number_prefix_length(const char *text, size_t length, char decimal)
{
    const size_t whole = skip_sign(text, length, 0);
    size_t i = skip_digits(text, length, whole);
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
        const size_t exponent = skip_sign(text, length, i + 1);
        const size_t end = skip_digits(text, length, exponent);
        if (end > exponent)
            i = end;
    }
    return i;
}

/* Copies a number with ASCII minus signs, as strtod needs them. */
static void copy_number(char *to, const char *text, size_t length)
{
    for (size_t i = 0; i < length;) {
        const bool minus = is_minus_sign(text + i, length - i);
        *to++ = minus ? '-' : text[i];
        i += minus ? MINUS_SIGN_LENGTH : 1;
    }
    *to = '\0';
}

bool wt_number_parse(const char *text, size_t length, char decimal, double *value)
{
    char copy[NUMBER_MAX];
    while (length > 0 && is_white_space(text[0])) {
        text++;
        length--;
    }
    while (length > 0 && is_white_space(text[length - 1]))
        length--;
    if (length == 0 || length >= sizeof copy ||
        number_prefix_length(text, length, decimal) != length)
        return false;
    copy_number(copy, text, length);
    char *const mark = decimal == '.' ? NULL : strchr(copy, decimal);
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

double parse_number_or_nan(const char *text)
{
    double value = (double)NAN;
    return text != NULL && wt_number_parse(text, strlen(text), '.', &value) ? value : (double)NAN;
}

bool is_same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

bool parse_stored_number(const char *text, size_t length, double *value)
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

/* Shortens "1e-05" to "1e-5" and "1e+20" to "1e20". */
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
    while (*from == '0')
        from++;
    while (*from != '\0')
        *to++ = *from++;
    *to = '\0';
    return (size_t)(to - text);
}

double round_to_power_of_ten(double value, int decimals)
{
    const double tens = pow(10, decimals < 0 ? -decimals : 0);
    return decimals < 0 ? tens * round(value / tens) : value;
}

double round_to_digits(double value, int digits)
{
    if (!(fabs(value) > 0) || !isfinite(value))
        return value;
    const double scale = pow(10, digits - 1 - floor(log10(fabs(value))));
    return scale > 1 ? round(value * scale) / scale : round(value * scale) * (1 / scale);
}

percent_text format_percent(double share)
{
    percent_text result;
    /* "%.2g" writes 100 as "1e+02". */
    clocale_print(result.text, sizeof result.text, fabs(share) < 0.0995 ? "%.2g %%" : "%.0f %%",
                  100 * share);
    return result;
}

double round_up_percent(double share)
{
    return fmax(0.1, 0.1 * ceil(1e3 * share));
}

probability_text format_probability(double chance)
{
    probability_text words;
    clocale_print(words.text, sizeof words.text,
                  isnan(chance)   ? "not known"
                  : chance < 1e-3 ? "below 0.001"
                                  : "%.2g",
                  chance);
    return words;
}

/* Formats an integer of up to 15 digits, as %.15g writes it. */
static size_t format_integer(double value, char *buffer)
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

/* ---- formatting in extended precision -------------------------------------------------------- */

/* printf and strtod take ten times as long. They handle only the few per cent of the values that
 * extended precision cannot decide. */
enum { EXACT_POWER_MAX = 27, POWER_MAX = 2 * EXACT_POWER_MAX, DIGITS_MAX = 17 };

/* Decimal number; its first digit has the weight 10^exponent. */
typedef struct decimal {
    uint64_t whole;
    int digits, exponent;
} decimal;

typedef enum round_trip_verdict {
    ROUND_TRIP_UNCERTAIN,
    ROUND_TRIP_FAILS,
    ROUND_TRIP_HOLDS
} round_trip_verdict;

#if LDBL_MANT_DIG >= 64
/* Computes x 10^power. Each product is correct to half a unit in the last place, because these
 * powers of ten are exact. */
static long double scale_by_power_of_ten(long double x, int power)
{
    static const long double tens[EXACT_POWER_MAX + 1] = {
        1e0L,  1e1L,  1e2L,  1e3L,  1e4L,  1e5L,  1e6L,  1e7L,  1e8L,  1e9L,
        1e10L, 1e11L, 1e12L, 1e13L, 1e14L, 1e15L, 1e16L, 1e17L, 1e18L, 1e19L,
        1e20L, 1e21L, 1e22L, 1e23L, 1e24L, 1e25L, 1e26L, 1e27L};
    const int size = abs(power), first = size < EXACT_POWER_MAX ? size : EXACT_POWER_MAX;
    if (power >= 0)
        return x * tens[first] * tens[size - first];
    return x / tens[first] / tens[size - first];
}

/* Rounds a positive value to `digits` digits, and states whether this text reads back as the
 * value. */
static round_trip_verdict try_digits(double value, int digits, decimal *to)
{
    int e;
    const bool power_of_two =
        !(frexp(value, &e) > 0.5); /* The spacing below a power of two is smaller. */
    int exponent = (int)floor((e - 1) * 0.30102999566398120), scale = digits - 1 - exponent;
    if (power_of_two || abs(scale) >= POWER_MAX)
        return ROUND_TRIP_UNCERTAIN;
    const long double most = scale_by_power_of_ten(1.0L, digits);
    long double x = scale_by_power_of_ten((long double)value, scale);
    if (x >= most) {
        exponent++;
        x = scale_by_power_of_ten((long double)value, --scale);
    }
    long double whole = rintl(x);
    if (0.5L - fabsl(x - whole) < 2 * LDBL_EPSILON * x)
        return ROUND_TRIP_UNCERTAIN;
    const long double half = ldexpl(1.0L, e - DBL_MANT_DIG - 1),
                      off = fabsl(scale_by_power_of_ten(whole, -scale) - (long double)value);
    if (fabsl(off - half) < half / 64) /* rounding errors are below half / 512 */
        return ROUND_TRIP_UNCERTAIN;
    if (whole >= most) {
        exponent++;
        whole = scale_by_power_of_ten(1.0L, digits - 1);
    }
    *to = (decimal){(uint64_t)whole, digits, exponent};
    return off < half ? ROUND_TRIP_HOLDS : ROUND_TRIP_FAILS;
}
#else
static round_trip_verdict try_digits(double value, int digits, decimal *to)
{
    (void)value, (void)digits, (void)to;
    return ROUND_TRIP_UNCERTAIN;
}
#endif

/* Formats like %.*g, with the shortest exponent. */
static size_t format_decimal(decimal d, bool negative, char *buffer)
{
    char digit[DIGITS_MAX];
    for (int i = d.digits; i-- > 0; d.whole /= 10)
        digit[i] = (char)('0' + d.whole % 10);
    int n = d.digits;
    while (n > 1 && digit[n - 1] == '0')
        n--;
    const bool scientific = d.exponent < -4 || d.exponent >= d.digits;
    const int before = scientific ? 1 : d.exponent + 1; /* digits before the decimal point */
    char *to = buffer;
    if (negative)
        *to++ = '-';
    if (before <= 0) {
        *to++ = '0';
        *to++ = '.';
    }
    for (int i = before; i < 0; i++)
        *to++ = '0';
    for (int i = 0; i < n || i < before; i++) {
        if (i == before && before > 0)
            *to++ = '.';
        *to++ = i < n ? digit[i] : '0';
    }
    if (scientific)
        to += sprintf(to, "e%d", d.exponent);
    *to = '\0';
    return (size_t)(to - buffer);
}

/* Writes the shortest text of 15 to 17 digits that reads back; 0 if undecided. */
static size_t format_extended(double value, char *buffer)
{
    decimal d;
    for (int digits = 15; digits <= DIGITS_MAX; digits++) {
        const round_trip_verdict back = try_digits(fabs(value), digits, &d);
        if (back == ROUND_TRIP_UNCERTAIN)
            return 0;
        if (back == ROUND_TRIP_HOLDS)
            return format_decimal(d, value < 0.0, buffer);
    }
    return 0;
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
        return format_integer(value, buffer);
    /* A normal double represents any decimal number of 15 digits. So 15 digits without trailing
     * zeros are the shortest text if they read back. Subnormal numbers have fewer digits. */
    const bool subnormal = fpclassify(value) == FP_SUBNORMAL;
    const size_t certain = subnormal ? 0 : format_extended(value, buffer);
    if (certain > 0)
        return certain;
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
