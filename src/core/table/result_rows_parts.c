/* Adds rows to those of a result. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/result_rows_parts.h"
#include "core/base/array.h"
#include "core/base/text.h"
#include "core/math/students_t.h"
#include "core/table/result_row.h"
#include "core/table/result_value.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

static result_row *add_row(rows_source *s, int level, const char *name, va_list list)
    WT_PRINTF(3, 0);
static result_row *add_row(rows_source *s, int level, const char *name, va_list list)
{
    result_rows *r = s->rows;
    r->rows = array_grow(r->rows, r->n, sizeof *r->rows);
    result_row *row = &r->rows[r->n++];
    const double none = (double)NAN;
    *row = (result_row){.level = level, .number = {none, none, none, none, none, "1"}};
    clocale_vprint(row->name, sizeof row->name, name, list);
    return row;
}

result_row *rows_add_text(rows_source *s, int level, const char *text, const char *name, ...)
{
    va_list list;
    va_start(list, name);
    result_row *row = add_row(s, level, name, list);
    va_end(list);
    row->kind = RESULT_ROW_TEXT;
    snprintf(row->text, sizeof row->text, "%s", text);
    return row;
}

result_row *rows_add_number(rows_source *s, int level, row_number number, const char *name, ...)
{
    va_list list;
    va_start(list, name);
    result_row *row = add_row(s, level, name, list);
    va_end(list);
    row->number = number;
    return row;
}

row_number row_number_of_value(const result_value *value)
{
    return (row_number){value->number.value,
                        value->low,
                        value->high,
                        value->range.low,
                        value->range.high,
                        value->neutral == 0                   ? "%"
                        : value->quantity == WT_Q_TEMPERATURE ? "degC"
                                                              : value->number.unit};
}

result_row *rows_add_value(rows_source *s, int level, const result_value *value, const char *name)
{
    result_row *row = rows_add_number(s, level, row_number_of_value(value), "%s", name);
    rows_reason(row, "the interval includes", isnan(value->low) ? NULL : value->includes);
    rows_reason(row, "no error known of", value->lacks);
    rows_reason(row, "widest choice of the model", value->range.widest);
    return row;
}

result_row *rows_add_verdict(rows_source *s, listed_text verdict, const char *name)
{
    result_row *row = rows_add_text(
        s, 0, verdict.text[0] != '\0' ? verdict.text : stated_verdict_text(VERDICT_NOT_TESTED),
        "%s", name);
    rows_reason(row, "reason", verdict.reason);
    return row;
}

void rows_note(result_row *row, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    clocale_vprint(row->note, sizeof row->note, format, list);
    va_end(list);
}

void rows_reason(result_row *row, const char *heading, const char *text)
{
    size_t i = 0;
    while (i < RESULT_ROW_REASONS && row->reasons[i].text != NULL)
        i++;
    if (text != NULL && text[0] != '\0' && i < RESULT_ROW_REASONS)
        row->reasons[i] = (result_row_reason){heading, text};
}

void rows_condition(rows_source *s, double value, const char *unit)
{
    char *heading = s->rows->heading;
    if (!isnan(value))
        clocale_append(heading, sizeof s->rows->heading, "%s%s", heading[0] != '\0' ? ", " : "",
                       rows_short(value, unit).value);
}

row_number rows_number(double value, double low, double high, const char *unit)
{
    const double none = (double)NAN;
    return (row_number){value, low, high, none, none, unit};
}

row_number rows_of_keys(const table_view *v, unsigned key)
{
    return rows_number(view_key(v, v->schema, key).value, view_key(v, v->schema, key + 1).value,
                       view_key(v, v->schema, key + 2).value, schema_unit(&v->schema->keys[key]));
}

row_number rows_estimate(wt_estimate e)
{
    const double half = NORMAL_95 * e.standard_error;
    const bool known = half > 0 && isfinite(half);
    const double none = (double)NAN, least = e.value > 0 ? 0 : -(double)INFINITY;
    return rows_number(e.value, known ? fmax(e.value - half, least) : none,
                       known ? e.value + half : none, e.unit);
}

row_number rows_temperature(wt_estimate kelvin)
{
    row_number number = rows_estimate(kelvin);
    number.unit = "degC";
    return number;
}

double rows_plain_key(const char *text)
{
    double number = (double)NAN;
    if (text == NULL || !wt_number_parse(text, strlen(text), '.', &number))
        return (double)NAN;
    return number;
}

row_number_text rows_short(double value, const char *unit)
{
    const double none = (double)NAN;
    const row_number number = rows_number(value, none, none, unit);
    return row_number_format(&number);
}

bool rows_bind(const rows_source *s, const table_schema *schema, table_view *view)
{
    return table_bind_result(s->result, schema, "", view, NULL) == WT_OK && view->table != NULL;
}

/* ---- formats of numbers ---------------------------------------------------------------------- */

enum { LEAST_DIGITS = 3, MOST_DIGITS = 9 };

/* What a number in SI units is multiplied by and its unit is then called. */
typedef struct row_scale {
    double factor, offset;
    const char *si; /* unit before that */
    char unit[32];
} row_scale;

/* Copies a unit in ASCII: "um" for micrometre. */
static void copy_ascii_unit(const char *unit, char *copy, size_t size)
{
    size_t n = 0;
    for (; *unit != '\0' && n + 1 < size; unit++) {
        const unsigned char c = (unsigned char)*unit;
        if (c < 0x80)
            copy[n++] = (char)c;
        else if (c >= 0xC0)
            copy[n++] = 'u'; /* the prefix micro is the only such character of a unit */
    }
    copy[n] = '\0';
}

/* Scale with the SI prefix that suits a number. */
static row_scale scale_for(double value, const char *unit)
{
    char text[96];
    row_scale scale = {1, 0, unit, ""};
    if (strcmp(unit, "degC") == 0) {
        scale.offset = -WT_ZERO_CELSIUS;
        scale.si = "K";
        copy_ascii_unit(unit, scale.unit, sizeof scale.unit);
    } else if (strcmp(unit, "%") == 0) {
        scale.factor = 100;
        scale.si = "1";
        copy_ascii_unit(unit, scale.unit, sizeof scale.unit);
    } else if (strcmp(unit, "m^2/N") == 0) {
        scale.factor = 1e9;
        copy_ascii_unit("mm^3/(N m)", scale.unit, sizeof scale.unit);
    } else if (strcmp(unit, "1") != 0 && unit[0] != '\0') {
        const double of = isfinite(value) && value != 0 ? fabs(value) : 1;
        wt_format_si(of, unit, LEAST_DIGITS, text, sizeof text);
        const char *blank = strchr(text, ' ');
        double shown = of;
        if (blank != NULL && wt_number_parse(text, (size_t)(blank - text), '.', &shown))
            scale.factor = pow(10.0, round(log10(shown / of)));
        copy_ascii_unit(blank != NULL ? blank + 1 : unit, scale.unit, sizeof scale.unit);
    }
    return scale;
}

const char *row_number_unit(const row_number *n)
{
    return scale_for(n->value, n->unit).si;
}

static int magnitude(double x)
{
    /* 9.9996 with few digits is 10.00 */
    return x != 0 && isfinite(x) ? (int)floor(log10(fabs(x)) + 1e-6) : 0;
}

/* Removes the sign and zeros of an exponent: "5.90e5". */
static void shorten_exponent(char *text)
{
    char *e = strchr(text, 'e');
    if (e == NULL)
        return;
    char *to = e + 1, *from = e + 1;
    if (*from == '-')
        to++;
    from++;
    while (*from == '0' && from[1] != '\0')
        from++;
    memmove(to, from, strlen(from) + 1);
}

/* Writes a number that is scaled already. A power of ten is used for small numbers, and for large
 * ones of which not all digits before the point are known. */
static void format_scaled(double x, int decimals, char *text, size_t size)
{
    const int power = magnitude(x);
    if (x == 0) {
        clocale_print(text, size, "0");
    } else if (power < -4 || decimals < -1) {
        clocale_print(text, size, "%.*e", decimals + power > 1 ? decimals + power : 2, x);
        shorten_exponent(text);
    } else {
        clocale_print(text, size, "%.*f", decimals > 0 ? decimals : 0, x);
    }
}

/* Writes a limit with the decimals of the value, or with three digits if it is smaller or much
 * larger than the value. */
static void format_limit(double x, int decimals, int power, char *text, size_t size)
{
    const int own = LEAST_DIGITS - 1 - magnitude(x);
    const bool far = x != 0 && (magnitude(x) > power || own > decimals);
    format_scaled(x, far && (own > decimals || magnitude(x) > power + 1) ? own : decimals, text,
                  size);
}

/* True if a limit is too far from the value for its unit. */
static bool needs_own_unit(double x, const row_scale *scale, const char *unit)
{
    const int power = magnitude(x);
    return x != 0 && isfinite(x) && (power < -3 || power > 4) &&
           strcmp(scale_for(x / scale->factor, unit).unit, scale->unit) != 0;
}

static void format_with_own_unit(double value, const char *unit, char *text, size_t size)
{
    char number[40];
    const row_scale scale = scale_for(value, unit);
    const double x = value * scale.factor + scale.offset;
    format_scaled(x, LEAST_DIGITS - 1 - magnitude(x), number, sizeof number);
    clocale_print(text, size, "%s %s", number, scale.unit);
}

/* Returns true if limits that differ have the same text. */
static bool format_limits(const row_number *n, double low, double high, const row_scale *scale,
                          int decimals, char *text, size_t size)
{
    char first[48], second[48];
    if (isnan(low) || isnan(high))
        return false;
    const double at[2] = {low * scale->factor + scale->offset,
                          high * scale->factor + scale->offset},
                 center = n->value * scale->factor + scale->offset;
    if (needs_own_unit(at[0], scale, n->unit) || needs_own_unit(at[1], scale, n->unit)) {
        format_with_own_unit(low, n->unit, first, sizeof first);
        format_with_own_unit(high, n->unit, second, sizeof second);
    } else {
        const int power = magnitude(isfinite(center) ? center : at[0]);
        format_limit(at[0], decimals, power, first, sizeof first);
        format_limit(at[1], decimals, power, second, sizeof second);
    }
    const bool lacks_unit = isnan(n->value) && strchr(first, ' ') == NULL && scale->unit[0] != '\0';
    const char *blank = lacks_unit ? " " : "", *unit = lacks_unit ? scale->unit : "";
    if (isinf(high))
        clocale_print(text, size, ">= %s%s%s", first, blank, unit);
    else
        clocale_print(text, size, "%s to %s%s%s", first, second, blank, unit);
    return low < high && isfinite(high) && strcmp(first, second) == 0;
}

row_number_text row_number_format(const row_number *n)
{
    row_number_text out = {"", "", ""};
    const double of = isfinite(n->value) && n->value != 0 ? n->value
                      : isfinite(n->low) && n->low != 0   ? n->low
                                                          : n->high;
    const row_scale scale = scale_for(of, n->unit);
    const double x = n->value * scale.factor + scale.offset,
                 low = n->low * scale.factor + scale.offset,
                 high = n->high * scale.factor + scale.offset;
    int digits = result_value_digits(x, low, high);
    char number[48];
    for (int decimals;; digits++) {
        decimals = digits - 1 - magnitude(isfinite(x) ? x : of * scale.factor);
        out.interval[0] = '\0';
        const bool alike =
            format_limits(n, n->low, n->high, &scale, decimals, out.interval, sizeof out.interval);
        if (isfinite(x))
            format_scaled(x, decimals, number, sizeof number);
        out.range[0] = '\0';
        (void)format_limits(n, n->range_low, n->range_high, &scale, decimals, out.range,
                            sizeof out.range);
        if (!alike || digits >= MOST_DIGITS)
            break;
    }
    if (isnan(n->value))
        clocale_print(out.value, sizeof out.value, "%s", isnan(n->low) ? "not known" : "-");
    else if (isinf(n->value))
        clocale_print(out.value, sizeof out.value, "no limit");
    else
        clocale_print(out.value, sizeof out.value, "%s%s%.20s", number,
                      scale.unit[0] != '\0' ? " " : "", scale.unit);
    return out;
}
