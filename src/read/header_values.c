/* Numbers in headers of files, and the table of metadata.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/header_values.h"
#include "core/base/array.h"
#include "core/base/memory.h"
#include "core/base/number.h"
#include "core/base/text.h"
#include "core/table/registry.h"

#include <math.h>
#include <string.h>

static size_t skip(const char *text, size_t length, size_t i, const char *bytes)
{
    while (i < length && text[i] != '\0' && strchr(bytes, text[i]) != NULL)
        i++;
    return i;
}

static size_t word_end(const char *text, size_t length, size_t i)
{
    while (i < length && strchr(" \t,;|", text[i]) == NULL)
        i++;
    return i;
}

size_t header_number_parse(const char *text, size_t length, double *value)
{
    const size_t point = number_prefix_length(text, length, '.'),
                 comma = number_prefix_length(text, length, ','), n = comma > point ? comma : point;
    return n > 0 && wt_number_parse(text, n, comma > point ? ',' : '.', value) ? n : 0;
}

/* True if another number stands behind the one that ends at `from`, before the unit ("0.25 0.30
 * N/m") or with a unit of its own ("0.25 N/m 0.30 N/m"). */
static bool differs(const char *text, size_t length, size_t from, double value)
{
    static const char separators[] = " \t,;/|";
    const size_t unit = skip(text, length, from, " \t"), unit_end = word_end(text, length, unit);
    double second;
    size_t at = skip(text, length, from, separators);
    if (at > from && header_number_parse(text + at, length - at, &second) > 0)
        return second < value || second > value;
    at = skip(text, length, unit_end, separators);
    const size_t n = at < length ? header_number_parse(text + at, length - at, &second) : 0,
                 again = skip(text, length, at + n, " \t");
    return n > 0 && word_end(text, length, again) - again == unit_end - unit &&
           memcmp(text + again, text + unit, unit_end - unit) == 0 &&
           (second < value || second > value);
}

size_t header_number_error(const char *text, size_t length, double *error)
{
    static const char *const marks[] = {"+-", "+/-", "\u00b1"};
    const size_t from = skip(text, length, 0, " \t");
    for (size_t i = 0; i < COUNT_OF(marks); i++) {
        const size_t n = strlen(marks[i]);
        if (length - from < n || memcmp(text + from, marks[i], n) != 0)
            continue;
        const size_t at = skip(text, length, from + n, " \t");
        const size_t digits = header_number_parse(text + at, length - at, error);
        if (digits > 0 && *error >= 0)
            return at + digits;
    }
    *error = (double)NAN;
    return 0;
}

header_number header_number_read(const char *text, size_t length, double *value, size_t *end)
{
    const size_t from = skip(text, length, 0, " \t"),
                 n = header_number_parse(text + from, length - from, value);
    header_number found = HEADER_NUMBER_ONE;
    *end = from + n;
    if (n == 0)
        found = HEADER_NUMBER_NONE;
    else if (*end + 1 < length && strchr(".,", text[*end]) != NULL && text[*end] != '\0' &&
             text[*end + 1] >= '0' && text[*end + 1] <= '9')
        found = HEADER_NUMBER_GOES_ON;
    else if (differs(text, length, *end, *value))
        found = HEADER_NUMBER_DIFFER;
    if (found != HEADER_NUMBER_ONE)
        *value = (double)NAN;
    return found;
}

/* Names the error of a number, which stands before or behind the unit. */
static void name_error(const char *text, size_t length, const char *name, const char *option,
                       const char *file, const char *place, wt_log *log)
{
    double value, error;
    size_t end;
    if (header_number_read(text, length, &value, &end) != HEADER_NUMBER_ONE)
        return;
    if (header_number_error(text + end, length - end, &error) == 0) {
        end = word_end(text, length, skip(text, length, end, " \t"));
        if (header_number_error(text + end, length - end, &error) == 0)
            return;
    }
    char advice[64] = "";
    if (option != NULL && fabs(value) > 0)
        clocale_print(advice, sizeof advice, "; %s-error %.3g states it", option,
                      error / fabs(value));
    wt_log_add(log, WT_WARNING, file, place, "%s: its error %.3g is not read%s", name, error,
               advice);
}

void header_number_warn(header_number found, const char *text, size_t length, const char *name,
                        const char *option, const char *file, const char *place, wt_log *log)
{
    const int shown = length < 60 ? (int)length : 60;
    if (found == HEADER_NUMBER_ONE)
        name_error(text, length, name, option, file, place, log);
    if (found != HEADER_NUMBER_GOES_ON && found != HEADER_NUMBER_DIFFER)
        return;
    wt_log_action(log, WT_WARNING, WT_CONTRADICTED, 1, option, file, place,
                  "%s: \"%.*s\" %s; it is not used: correct the line%s%s", name, shown, text,
                  found == HEADER_NUMBER_DIFFER ? "states two values" : "is not one number",
                  option != NULL ? " or state the value by " : "", option != NULL ? option : "");
}

const char *header_number_option(wt_quantity quantity)
{
    return quantity == WT_Q_SPRING_CONSTANT ? "--spring-constant"
           : quantity == WT_Q_SENSITIVITY   ? "--sensitivity"
                                            : NULL;
}

/* ---- metadata -------------------------------------------------------------------------------- */

/* Returns FACT_ITEM_UNKNOWN for an item on which no code acts. */
static fact_item find_kind(const char *item)
{
    const listed_text kind = closed_list_read(&fact_item_list, item);
    return kind.value < FACT_TABLE && kind.reason[0] != '\0' ? FACT_ITEM_UNKNOWN
                                                             : (fact_item)kind.value;
}

void metadata_add(table_writer *metadata, const char *item, const char *unit, const char *source,
                  const char *format, ...)
{
    char *value = NULL;
    va_list arguments;
    va_start(arguments, format);
    const locale_t previous = clocale_enter();
    if (vasprintf(&value, format, arguments) < 0)
        out_of_memory(strlen(format));
    clocale_leave(previous);
    va_end(arguments);
    table_row(metadata);
    facts_put_text(metadata, FACTS_ITEM, item);
    facts_put_text(metadata, FACTS_VALUE, value);
    facts_put_text(metadata, FACTS_UNIT, unit);
    facts_put_text(metadata, FACTS_SOURCE, source);
    facts_put(metadata, FACTS_KIND, (double)find_kind(item));
    free(value);
}

void metadata_add_text(table_writer *metadata, const char *item, const char *key, const char *text)
{
    if (text != NULL && *text != '\0')
        metadata_add(metadata, item, "", key, "%s", text);
}

void metadata_add_number(table_writer *metadata, const char *item, double value, const char *unit,
                         const char *source)
{
    char text[32];
    wt_number_format(value, text);
    metadata_add(metadata, item, unit, source, "%s", isnan(value) ? "unknown" : text);
}
