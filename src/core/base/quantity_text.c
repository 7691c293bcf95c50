/* Parses quantities: an estimate with its stated error, or a list of values.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/quantity.h"
#include "core/base/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_blank_or_line_end(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* Copies [begin, end) without surrounding blanks. */
static char *copy_trimmed(const char *begin, const char *end)
{
    while (begin < end && is_blank_or_line_end(*begin))
        begin++;
    while (end > begin && is_blank_or_line_end(end[-1]))
        end--;
    return wt_strndup(begin, (size_t)(end - begin));
}

/* Returns the length of the text before a "%" or "percent" at its end; 0 without one. */
static size_t length_before_percent(const char *text)
{
    static const char *const marks[] = {"%", "percent"};
    const size_t n = strlen(text);
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++) {
        const size_t mark = strlen(marks[i]);
        size_t left = n > mark && strcmp(text + n - mark, marks[i]) == 0 ? n - mark : 0;
        while (left > 0 && is_blank_or_line_end(text[left - 1]))
            left--;
        if (left > 0)
            return left;
    }
    return 0;
}

/* Parses a stated error: a percentage of the value, or a quantity of the same dimension. */
static wt_status parse_stated_error(const char *text, wt_quantity quantity, const char *example,
                                    double value, double *error, wt_error *err)
{
    const size_t before = length_before_percent(text);
    if (before > 0) {
        double percent = (double)NAN;
        if (!wt_number_parse(text, before, '.', &percent) || percent < 0) {
            wt_fail(err, WT_E_RANGE, "the stated error is not a share in per cent");
            wt_error_expected(err, "a number >= 0 before %%, as in \"0.4MPa +- 5%%\"");
            wt_error_found(err, "\"%s\"", text);
            return WT_E_RANGE;
        }
        if (quantity == WT_Q_TEMPERATURE) {
            wt_fail(err, WT_E_UNIT, "a share of a temperature means nothing");
            wt_error_advice(err, "state it in kelvin: \"20degC +- 0.5K\"");
            return WT_E_UNIT;
        }
        if (value == 0 && percent > 0) {
            wt_fail(err, WT_E_RANGE, "a share of zero is no error");
            wt_error_expected(err, "the error itself, as in \"0 +- 0.1\"");
            wt_error_found(err, "\"%s\"", text);
            return WT_E_RANGE;
        }
        *error = fabs(value) * percent / 100;
        return WT_OK;
    }
    wt_quantity kind = quantity == WT_Q_TEMPERATURE ? WT_Q_TEMPERATURE_DIFFERENCE : quantity;
    double parsed = (double)NAN;
    wt_status status = quantity_parse(text, kind, example, &parsed, err);
    if (status != WT_OK)
        return status;
    if (!(parsed >= 0)) {
        wt_fail(err, WT_E_RANGE, "a standard error is not negative");
        wt_error_found(err, "\"%s\"", text);
        return WT_E_RANGE;
    }
    *error = parsed;
    return WT_OK;
}

/* "60 % +- 5 %" is ambiguous: a relative error or percentage points. */
static wt_status fail_two_percents(const char *text, wt_error *err)
{
    wt_fail(err, WT_E_UNIT,
            "the error of a value in percent is a part of it, or percentage points");
    wt_error_expected(err,
                      "the value as a number, as in \"0.6 +- 5%%\" (of it) or \"0.6 +- 0.05\"");
    wt_error_found(err, "\"%s\"", text);
    return WT_E_UNIT;
}

wt_status wt_estimate_parse(const char *text, wt_quantity quantity, wt_estimate *estimate,
                            wt_error *err)
{
    return estimate_parse(text, quantity, NULL, estimate, err);
}

wt_status estimate_parse(const char *text, wt_quantity quantity, const char *example,
                         wt_estimate *estimate, wt_error *err)
{
    if (text == NULL || estimate == NULL)
        return wt_fail(err, WT_E_ARG, "no text to parse");
    wt_estimate parsed = {(double)NAN, 0, 0, wt_quantity_unit(quantity)};
    const char *const ascii = strstr(text, "+-"); /* "+-" and "±" have two bytes */
    const char *sign = ascii != NULL ? ascii : strstr(text, "\xc2\xb1"), *end = text + strlen(text);
    char *head = copy_trimmed(text, sign != NULL ? sign : end);
    char *tail = sign != NULL ? copy_trimmed(sign + 2, end) : NULL;
    wt_status status = quantity_parse(head, quantity, example, &parsed.value, err);
    if (status == WT_OK && tail != NULL && length_before_percent(head) > 0 &&
        length_before_percent(tail) > 0)
        status = fail_two_percents(text, err);
    if (status == WT_OK && tail != NULL)
        status =
            parse_stated_error(tail, quantity, example, parsed.value, &parsed.standard_error, err);
    if (status == WT_OK)
        *estimate = parsed;
    free(head);
    free(tail);
    return status;
}

/* ---- lists ----------------------------------------------------------------------------------- */

#define MAX_LIST 100000

typedef struct value_list {
    double *v;
    size_t n;
} value_list;

static wt_status fail_list(const char *text, const char *what, wt_error *err)
{
    wt_fail(err, WT_E_RANGE, "%s", what);
    wt_error_expected(err, "one value, values parted by commas, or FIRST:LAST UNIT:log|lin:COUNT");
    wt_error_found(err, "\"%s\"", text);
    wt_error_advice(err, "for example 1e-4:10m/s:log:40");
    return WT_E_RANGE;
}

/* Parses FIRST:LAST UNIT:log|lin:COUNT; `part` contains the four parts. */
static wt_status parse_range(const char *text, char *const *part, wt_quantity quantity,
                             const char *example, value_list *out, wt_error *err)
{
    const char *unit = part[1];
    unit += strspn(unit, "0123456789.");
    if ((*unit == 'e' || *unit == 'E') && strspn(unit + 1, "+-0123456789") > 0)
        unit += 1 + strspn(unit + 1, "+-0123456789");
    char first_text[128];
    size_t plain = strspn(part[0], "+-0123456789.eE");
    int written = part[0][plain] == '\0'
                      ? snprintf(first_text, sizeof first_text, "%s%s", part[0], unit)
                      : snprintf(first_text, sizeof first_text, "%s", part[0]);
    if (written < 0 || (size_t)written >= sizeof first_text)
        return fail_list(text, "the first value is too long", err);
    double first = (double)NAN, last = (double)NAN, count = (double)NAN;
    wt_status status = quantity_parse(first_text, quantity, example, &first, err);
    if (status == WT_OK)
        status = quantity_parse(part[1], quantity, example, &last, err);
    if (status != WT_OK)
        return status;
    bool logarithmic = strcmp(part[2], "log") == 0;
    if (!logarithmic && strcmp(part[2], "lin") != 0)
        return fail_list(text, "the spacing is neither log nor lin", err);
    if (!wt_number_parse(part[3], strlen(part[3]), '.', &count) || count < 2 || count > MAX_LIST ||
        floor(count) < count)
        return fail_list(text, "the count is not an integer from 2 to 100000", err);
    if (!(last > first) || (logarithmic && !(first > 0)))
        return fail_list(text, "the values do not rise (and are positive for log)", err);
    out->n = (size_t)count;
    out->v = wt_alloc(out->n, sizeof *out->v);
    for (size_t i = 0; i < out->n; i++) {
        const double t = (double)i / (double)(out->n - 1);
        const double v = logarithmic ? first * pow(last / first, t) : first + (last - first) * t;
        /* rounds to 15 digits, so that a decade is 0.01 and not 0.009999999999999998 */
        char digits[32];
        clocale_print(digits, sizeof digits, "%.15g", v);
        if (!wt_number_parse(digits, strlen(digits), '.', &out->v[i]))
            out->v[i] = v;
    }
    out->v[0] = first;
    out->v[out->n - 1] = last;
    return WT_OK;
}

/* Splits a text into n parts without surrounding blanks. */
static char **split_at_mark(const char *text, char mark, size_t n)
{
    char **pieces = wt_alloc(n, sizeof *pieces);
    const char *begin = text;
    for (size_t i = 0; i < n; i++) {
        const char *end = strchrnul(begin, mark);
        pieces[i] = copy_trimmed(begin, end);
        begin = end + 1;
    }
    return pieces;
}

wt_status wt_list_parse(const char *text, wt_quantity quantity, double **result, size_t *n,
                        wt_error *err)
{
    return list_parse(text, quantity, NULL, result, n, err);
}

wt_status list_parse(const char *text, wt_quantity quantity, const char *example, double **result,
                     size_t *n, wt_error *err)
{
    if (text == NULL || result == NULL || n == NULL)
        return wt_fail(err, WT_E_ARG, "no text to parse");
    wt_status status = WT_OK;
    value_list list = {NULL, 0};
    const bool range = strchr(text, ':') != NULL;
    size_t n_parts = 1;
    for (const char *p = text; *p != '\0'; p++)
        n_parts += *p == (range ? ':' : ',');
    if (n_parts > (range ? 4 : MAX_LIST))
        return fail_list(text, range ? "too many parts" : "the list is too long", err);
    char **parts = split_at_mark(text, range ? ':' : ',', n_parts);
    if (!range) {
        list = (value_list){wt_alloc(n_parts, sizeof *list.v), n_parts};
        for (size_t i = 0; status == WT_OK && i < n_parts; i++)
            status = quantity_parse(parts[i], quantity, example, &list.v[i], err);
    } else if (n_parts == 4)
        status = parse_range(text, parts, quantity, example, &list, err);
    else
        status = fail_list(text, "a range has four parts", err);
    for (size_t i = 1; status == WT_OK && i < list.n; i++)
        if (!(list.v[i] > list.v[i - 1]))
            status = fail_list(text, "the values do not rise", err);
    if (status == WT_OK) {
        *result = list.v;
        *n = list.n;
        list.v = NULL;
    }
    free(list.v);
    wt_strings_free(parts, n_parts);
    return status;
}
