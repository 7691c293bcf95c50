/* Lines outside the rows: header values, steps, markers.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text_scan.h"

#include "base/utf8.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEPS_MAX ((size_t)64)

static void set_declared(text_scanner *s, field_sets sets, const char *text, size_t length)
{
    static const struct {
        const char *word;
        cell_separator separator;
    } separators[] = {{"tab", SEPARATOR_TAB},          {"semicolon", SEPARATOR_SEMICOLON},
                      {";", SEPARATOR_SEMICOLON},      {"comma", SEPARATOR_COMMA},
                      {",", SEPARATOR_COMMA},          {"space", SEPARATOR_WHITESPACE},
                      {"blank", SEPARATOR_WHITESPACE}, {"whitespace", SEPARATOR_WHITESPACE}};
    if (sets == FIELD_SETS_DECIMAL) {
        if (name_is(text, length, "comma") || name_is(text, length, ","))
            s->decimal = ',';
        else if (name_is(text, length, "point") || name_is(text, length, "dot") ||
                 name_is(text, length, "."))
            s->decimal = '.';
    } else if (sets == FIELD_SETS_SEPARATOR) {
        for (size_t i = 0; i < sizeof separators / sizeof *separators; i++)
            if (name_is(text, length, separators[i].word))
                s->separator = separators[i].separator;
    }
}

static void set_field(text_scanner *s, size_t f, size_t line_number, const char *line,
                      const regmatch_t groups[GROUPS])
{
    const header_field *field = &s->d->fields[f];
    field_value *value = &s->file->values[f];
    const regmatch_t *found = &groups[field->group];
    const char *text = line + found->rm_so;
    const size_t length = (size_t)(found->rm_eo - found->rm_so);
    const size_t kept = utf8_cut(text, length, 200);
    memcpy(value->text, text, kept);
    value->text[kept] = '\0';
    value->line = line_number;
    value->unit[0] = '\0';
    if (field->unit_group > 0 && groups[field->unit_group].rm_so >= 0)
        text_copy(value->unit, sizeof value->unit, line + groups[field->unit_group].rm_so,
                  (size_t)(groups[field->unit_group].rm_eo - groups[field->unit_group].rm_so));
    else if (field->unit != NULL)
        snprintf(value->unit, sizeof value->unit, "%s", field->unit);
    set_declared(s, field->sets, text, length);
    if (field->quantity == WT_Q_NONE)
        return;
    double number, factor, offset;
    const char *unit = value->unit;
    for (size_t i = 0; i < s->d->n_aliases; i++)
        if (strcmp(s->d->aliases[i].found, unit) == 0)
            unit = s->d->aliases[i].means;
    const text_place place = line_place(line_number);
    if (!wt_number_parse(text, length, '.', &number) &&
        !wt_number_parse(text, length, ',', &number)) {
        wt_parselog_add(s->log, WT_NOTE, s->file->name, place.words, "%s: \"%s\" is not a number",
                        field->name, value->text);
        return;
    }
    if (wt_unit_to_si(unit, field->quantity, &factor, &offset, NULL) != WT_OK) {
        wt_parselog_add(s->log, WT_WARNING, s->file->name, place.words,
                        "%s: \"%s\" is not a unit of %s; the value is left out", field->name, unit,
                        wt_quantity_id(field->quantity));
        return;
    }
    const header_value h = header_of(field->quantity);
    if (h < HEADER_COUNT) {
        s->header.value[h] = factor * number + offset;
        s->header.fallback[h] = field->fallback;
    }
    return;
}

void scan_fields(text_scanner *s, size_t line_number, const char *line, size_t length)
{
    for (size_t f = 0; f < s->d->n_fields; f++) {
        regmatch_t groups[GROUPS];
        for (size_t g = 0; g < GROUPS; g++)
            groups[g].rm_so = groups[g].rm_eo = -1;
        if (pattern_match(&s->d->fields[f].pattern, line, length, groups, GROUPS) &&
            groups[s->d->fields[f].group].rm_so >= 0)
            set_field(s, f, line_number, line, groups);
    }
}

wt_status scan_finish_step(text_scanner *s)
{
    const char *title = s->title[0] != '\0' ? s->title : "(no title)";
    if (s->step_line == 0 || s->step_has_table)
        return WT_OK;
    return text_list_add(s->file, &s->file->steps, STEPS_MAX, (text_cell){title, strlen(title)},
                         s->err);
}

void scan_close(text_scanner *s)
{
    s->state = SCAN_HEADER;
}

wt_status scan_marks(text_scanner *s, size_t line_number, const char *line, size_t length, bool *is)
{
    const text_description *d = s->d;
    *is = false;
    for (size_t i = 0; i < d->n_steps; i++) {
        regmatch_t groups[2] = {{-1, -1}, {-1, -1}};
        if (!pattern_match(&d->steps[i].pattern, line, length, groups,
                           d->steps[i].title_next ? 0 : 2))
            continue;
        wt_status status = scan_finish_step(s);
        scan_close(s);
        s->step_line = line_number;
        s->step_has_table = false;
        s->title_next = d->steps[i].title_next;
        s->title[0] = '\0';
        if (groups[1].rm_so >= 0)
            text_copy(s->title, sizeof s->title, line + groups[1].rm_so,
                      (size_t)(groups[1].rm_eo - groups[1].rm_so));
        s->block++;
        *is = true;
        return status;
    }
    for (size_t i = 0; i < d->n_ends; i++)
        if (pattern_match(&d->ends[i], line, length, NULL, 0)) {
            scan_close(s);
            *is = true;
            return WT_OK;
        }
    for (size_t i = 0; i < d->n_markers; i++)
        if (pattern_match(&d->markers[i].pattern, line, length, NULL, 0)) {
            s->kind = (unsigned char)d->markers[i].kind;
            *is = true;
            return WT_OK;
        }
    return WT_OK;
}
