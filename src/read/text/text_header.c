/* Processes lines outside of the rows: header values, steps and markers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text_scanner.h"

#include "core/base/text.h"
#include "read/header_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEPS_MAX ((size_t)64)

/* Without any row the table is one that is not read. */
void scan_check_row_count(text_scanner *s)
{
    if (s->n_rows > 0 && s->n_rows < s->n_declared)
        wt_log_add(s->log, WT_WARNING, s->file->name, NULL,
                   "the file says %zu rows, but only %zu are there: the others are missing, "
                   "as in a file that was cut off",
                   s->n_declared, s->n_rows);
    s->n_declared = s->n_rows = 0;
}

static void apply_field(text_scanner *s, field_sets sets, text_span text)
{
    static const struct {
        const char *word;
        cell_separator separator;
    } separators[] = {{"tab", SEPARATOR_TAB},          {"semicolon", SEPARATOR_SEMICOLON},
                      {";", SEPARATOR_SEMICOLON},      {"comma", SEPARATOR_COMMA},
                      {",", SEPARATOR_COMMA},          {"space", SEPARATOR_WHITESPACE},
                      {"blank", SEPARATOR_WHITESPACE}, {"whitespace", SEPARATOR_WHITESPACE}};
    double number = 0;
    if (sets == FIELD_SETS_ROWS) {
        scan_check_row_count(s);
        if (wt_number_parse(text.text, text.length, '.', &number) && number > 0 && number < 1e15)
            s->n_declared = (size_t)number;
    } else if (sets == FIELD_SETS_DECIMAL) {
        if (name_equals(text, "comma") || name_equals(text, ","))
            s->decimal = ',';
        else if (name_equals(text, "point") || name_equals(text, "dot") || name_equals(text, "."))
            s->decimal = '.';
    } else if (sets == FIELD_SETS_SAMPLE && !s->has_sample_name) {
        s->sample = scan_find_sample(s, text);
        s->has_sample_name = s->sample != NO_SAMPLE;
    } else if (sets == FIELD_SETS_TITLE) {
        text_copy(s->title, sizeof s->title, text);
    } else if (sets == FIELD_SETS_VALUE_UNIT) {
        text_copy(s->names.value_unit, sizeof s->names.value_unit, text);
    } else if (sets == FIELD_SETS_SEPARATOR) {
        for (size_t i = 0; i < sizeof separators / sizeof *separators; i++)
            if (name_equals(text, separators[i].word))
                s->separator = separators[i].separator;
    }
}

/* Parses the number of a field in SI units; false, with a message, for another text. What follows
 * the text on its line is no part of the number. */
static bool parse_field_number(const text_scanner *s, const header_field *field, text_span text,
                               field_value *value, double *number)
{
    const line_position_text place = format_line_position(value->line);
    const size_t rest = (size_t)(s->line.text + s->line.length - text.text);
    const char *unit = value->unit;
    double factor, offset, error;
    size_t end;
    const header_number found = header_number_read(text.text, rest, number, &end);
    const size_t behind = end + header_number_error(text.text + end, rest - end, &error);
    if (behind > end && field->unit_group > 0) { /* the unit stands behind the error */
        const size_t blanks = strspn(text.text + behind, " \t");
        text_copy(
            value->unit, sizeof value->unit,
            (text_span){text.text + behind + blanks, strcspn(text.text + behind + blanks, " \t")});
    }
    if (text.length > end && behind > end)
        text.length = end;
    for (size_t i = 0; i < s->d->n_aliases; i++)
        if (strcmp(s->d->aliases[i].found, unit) == 0)
            unit = s->d->aliases[i].means;
    header_number_warn(found, text.text, rest, field->name, header_number_option(field->quantity),
                       s->file->name, place.text, s->log);
    if (found > HEADER_NUMBER_ONE)
        return false;
    while (text.length > end && strchr(" \t", text.text[text.length - 1]) != NULL)
        text.length--;
    if (found == HEADER_NUMBER_NONE || end != text.length) {
        wt_log_add(s->log, WT_NOTE, s->file->name, place.text, "%s: \"%s\" is not a number",
                   field->name, value->text);
        return false;
    }
    if (wt_unit_to_si(unit, field->quantity, &factor, &offset, NULL) != WT_OK) {
        wt_log_add(s->log, WT_WARNING, s->file->name, place.text,
                   "%s: \"%s\" is not a unit of %s; the value is left out", field->name, unit,
                   wt_quantity_id(field->quantity));
        return false;
    }
    *number = factor * *number + offset;
    return true;
}

/* Reports a second value in one header that differs from the first one. Headers of several curves
 * may differ, so rows in between end a header. Positions and times differ within one. */
static void check_second_value(const text_scanner *s, const header_field *field, header_value h,
                               double number, size_t first_line)
{
    const double before = s->header.value[h], tolerance = 1e-3; /* rounding of a printed value */
    const bool is_one = h == HEADER_SPRING_CONSTANT || h == HEADER_SENSITIVITY ||
                        h == HEADER_LOAD || h == HEADER_RADIUS || h >= HEADER_VALUE_FACTOR;
    if (!is_one || isnan(before) || first_line == 0 || first_line < s->row_line ||
        fabs(number - before) <= tolerance * fabs(before))
        return;
    const char *unit = wt_quantity_unit(field->quantity);
    char first[32], second[32];
    wt_format_si(before, unit, 4, first, sizeof first);
    wt_format_si(number, unit, 4, second, sizeof second);
    wt_log_action(
        s->log, WT_WARNING, WT_CONTRADICTED, 2, header_number_option(field->quantity),
        s->file->name, format_line_position(s->i + 1).text,
        "the header states the %s twice, %s in line %zu and %s here; the last one is used: "
        "delete the wrong line or state the value by an option",
        field->name, first, first_line, second);
}

static void set_field(text_scanner *s, size_t f, const regmatch_t groups[REGEX_GROUPS])
{
    const header_field *field = &s->d->fields[f];
    field_value *value = &s->file->values[f];
    const text_span text = pattern_group(s->line, groups[field->group]);
    const size_t kept = utf8_truncated_length(text.text, text.length, 200);
    const size_t first_line = value->text[0] != '\0' ? value->line : 0;
    double number;
    memcpy(value->text, text.text, kept);
    value->text[kept] = '\0';
    value->line = s->i + 1;
    value->unit[0] = '\0';
    if (field->unit_group > 0 && groups[field->unit_group].rm_so >= 0)
        text_copy(value->unit, sizeof value->unit,
                  pattern_group(s->line, groups[field->unit_group]));
    else if (field->unit != NULL)
        snprintf(value->unit, sizeof value->unit, "%s", field->unit);
    value->unit[strcspn(value->unit, ",;")] = '\0'; /* the rest of the line is not the unit */
    apply_field(s, field->sets, text);
    if (field->quantity == WT_Q_NONE || !parse_field_number(s, field, text, value, &number))
        return;
    const header_value h = find_header_value(field->quantity, field->sets);
    if (h < HEADER_COUNT) {
        check_second_value(s, field, h, number, first_line);
        s->header.value[h] = number;
        s->header.priority[h] = field->fallback ? HEADER_FALLBACK : HEADER_OVERRIDES;
    }
}

void scan_header_fields(text_scanner *s)
{
    for (size_t f = 0; f < s->d->n_fields; f++) {
        regmatch_t groups[REGEX_GROUPS];
        for (size_t g = 0; g < REGEX_GROUPS; g++)
            groups[g].rm_so = groups[g].rm_eo = -1;
        if (pattern_match(&s->d->fields[f].pattern, s->line, groups, REGEX_GROUPS) &&
            groups[s->d->fields[f].group].rm_so >= 0)
            set_field(s, f, groups);
    }
}

void scan_finish_step(text_scanner *s)
{
    const char *title = s->title[0] != '\0' ? s->title : "(no title)";
    if (s->step_line > 0 && !s->step_has_table)
        text_list_add(s->file, &s->file->steps, STEPS_MAX, (text_span){title, strlen(title)});
}

static void start_step(text_scanner *s, const step_marker *step, const regmatch_t *title)
{
    scan_finish_step(s);
    truncation_check_table_end(s);
    s->unclosed = s->d->end_required;
    s->state = SCAN_HEADER;
    s->step_line = s->i + 1;
    s->step_has_table = false;
    s->title_next = step->title_next;
    s->title[0] = '\0';
    if (title->rm_so >= 0)
        text_copy(s->title, sizeof s->title, pattern_group(s->line, *title));
    s->block++;
}

bool scan_match_markers(text_scanner *s)
{
    const text_description *d = s->d;
    for (size_t i = 0; i < d->n_steps; i++) {
        regmatch_t groups[2] = {{-1, -1}, {-1, -1}};
        const step_marker *step = &d->steps[i];
        if (pattern_match(&step->pattern, s->line, groups, step->title_next ? 0 : 2)) {
            start_step(s, step, &groups[1]);
            return true;
        }
    }
    for (size_t i = 0; i < d->n_end_markers; i++)
        if (pattern_match(&d->end_markers[i], s->line, NULL, 0)) {
            s->state = SCAN_HEADER;
            s->unclosed = false;
            return true;
        }
    for (size_t i = 0; i < d->n_markers; i++)
        if (pattern_match(&d->markers[i].pattern, s->line, NULL, 0)) {
            s->kind = (unsigned char)d->markers[i].kind;
            return true;
        }
    return false;
}
