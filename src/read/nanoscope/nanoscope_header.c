/* Parses the text at the beginning of a NanoScope file. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/header_values.h"
#include "read/nanoscope/nanoscope.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool nanoscope_is_header(const unsigned char *bytes, size_t length)
{
    static const char *const first[] = {"\\*Force file list", "\\*File list", "\\*EC File list"};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        if (length >= strlen(first[i]) && memcmp(bytes, first[i], strlen(first[i])) == 0)
            return true;
    return false;
}

/* Parses a line. "\@4:Z scale: V ..." has the key "Z scale" and the value "V ..."; a section has
 * its name as key. */
static void parse_line(nanoscope_header *header, char *line, size_t number)
{
    nanoscope_line *to = &header->lines[header->n];
    char *end = line + strlen(line);
    if (*line != '\\')
        return;
    while (end > line && isspace((unsigned char)end[-1]))
        *--end = '\0';
    line++;
    if (*line == '*') {
        *to = (nanoscope_line){header->n_sections++, line + 1, "", number};
        header->n++;
        return;
    }
    if (*line == '@') {
        char *group = ++line;
        while (isdigit((unsigned char)*group))
            group++;
        if (group > line && *group == ':')
            line = group + 1;
    }
    char *colon = strchr(line, ':');
    if (colon == NULL || header->n_sections == 0)
        return;
    *colon++ = '\0';
    *to = (nanoscope_line){header->n_sections - 1, line, colon + strspn(colon, " "), number};
    header->n++;
}

wt_status nanoscope_header_read(const unsigned char *bytes, size_t length, nanoscope_header *header,
                                wt_error *err)
{
    const unsigned char *end =
        memchr(bytes, 0x1a, length < NANOSCOPE_HEADER_MAX ? length : NANOSCOPE_HEADER_MAX);
    const size_t n = end != NULL ? (size_t)(end - bytes) : 0;
    size_t lines = 1;
    *header = (nanoscope_header){.text = NULL};
    if (end == NULL) {
        wt_fail(err, WT_E_CORRUPT,
                length < NANOSCOPE_HEADER_MAX ? "the file is cut off within its header"
                                              : "the header has no end");
        wt_error_expected(err, "the byte 1A behind the line \"\\*File list end\"");
        return WT_E_CORRUPT;
    }
    header->text = wt_alloc(n + 1, 1);
    for (size_t i = 0; i < n; i++)
        lines += bytes[i] == '\n';
    header->lines = wt_alloc(lines, sizeof *header->lines);
    /* all texts that are used are ASCII, and "~m" is a micrometre: Latin-1 micro, in UTF-8 behind
     * C2 */
    for (size_t i = 0, out = 0; i < n; i++)
        if (bytes[i] != 0xc2 || bytes[i + 1] != 0xb5)
            header->text[out++] = (char)(bytes[i] == 0xb5                    ? '~'
                                         : bytes[i] == 0 || bytes[i] >= 0x80 ? '?'
                                                                             : bytes[i]);
    size_t number = 0;
    for (char *line = header->text; line != NULL;) {
        char *next = strchr(line, '\n');
        if (next != NULL)
            *next++ = '\0';
        parse_line(header, line, ++number);
        line = next;
    }
    return WT_OK;
}

void nanoscope_header_clear(nanoscope_header *header)
{
    free(header->lines);
    free(header->text);
    *header = (nanoscope_header){.text = NULL};
}

size_t nanoscope_section(const nanoscope_header *header, const char *name, size_t number)
{
    for (size_t i = 0; i < header->n; i++)
        if (header->lines[i].value[0] == '\0' && strcmp(header->lines[i].key, name) == 0 &&
            (i == 0 || header->lines[i - 1].section != header->lines[i].section) && number-- == 0)
            return header->lines[i].section;
    return SIZE_MAX;
}

const char *nanoscope_get(const nanoscope_header *header, size_t section, const char *key)
{
    for (size_t i = 0; i < header->n && header->lines[i].section <= section; i++)
        if (header->lines[i].section == section && strcasecmp(header->lines[i].key, key) == 0)
            return header->lines[i].value;
    return NULL;
}

/* Returns the number at the beginning of a text, after blanks. */
static double parse_leading_number(const char *text)
{
    double value;
    size_t end;
    (void)header_number_read(text, strlen(text), &value, &end);
    return value;
}

double nanoscope_number(const nanoscope_header *header, size_t section, const char *key)
{
    const char *text = nanoscope_get(header, section, key);
    return text != NULL ? parse_leading_number(text) : (double)NAN;
}

nanoscope_value nanoscope_parse_value(const char *text)
{
    nanoscope_value v = {.soft = "", .step = (double)NAN, .value = (double)NAN};
    if (text == NULL)
        return v;
    const char *open = strchr(text, '['), *close = open != NULL ? strchr(open, ']') : NULL;
    if (close != NULL) {
        snprintf(v.soft, sizeof v.soft, "%.*s", (int)(close - open - 1), open + 1);
        text = close + 1;
    } else {
        text += text[0] == 'V' ? 1 : 0;
    }
    /* the text in round brackets may be anything */
    open = strchr(text, '(');
    close = open != NULL ? strchr(open, ')') : NULL;
    if (close != NULL)
        v.step = parse_leading_number(open + 1);
    v.value = parse_leading_number(close != NULL ? close + 1 : text);
    return v;
}

double nanoscope_soft_scale(const nanoscope_header *header, const char *soft)
{
    static const char *const lists[] = {"Ciao scan list", "Scanner list"};
    double factor = 1e-9, offset = 0;
    for (size_t i = 0; *soft != '\0' && i < sizeof lists / sizeof *lists; i++) {
        const size_t section = nanoscope_section(header, lists[i], 0);
        const char *text = nanoscope_get(header, section, soft);
        if (text == NULL)
            continue;
        text += text[0] == 'V' ? 1 : 0;
        text += strspn(text, " ");
        const char *unit = text + strcspn(text, " ");
        unit += strspn(unit, " ");
        /* Software 9.2 omits the unit, which is then nm/V. */
        if (*unit != '\0' && wt_unit_to_si(unit, WT_Q_SENSITIVITY, &factor, &offset, NULL) != WT_OK)
            return (double)NAN;
        return force_positive_or_nan(factor * parse_leading_number(text));
    }
    return (double)NAN;
}

void nanoscope_check_calibration(const nanoscope_header *header, const char *file, wt_log *log)
{
    static const struct {
        const char *key;
        wt_quantity quantity;
    } known[] = {{"Spring Constant", WT_Q_SPRING_CONSTANT}, {"Sens. ", WT_Q_SENSITIVITY}};
    for (size_t i = 0; i < header->n; i++)
        for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
            const char *const key = header->lines[i].key;
            const char *text = header->lines[i].value;
            double value;
            size_t end;
            char place[64];
            if (strncasecmp(key, known[k].key, strlen(known[k].key)) != 0)
                continue;
            text += text[0] == 'V' ? 1 : 0;
            snprintf(place, sizeof place, "line %zu", header->lines[i].number);
            header_number_warn(header_number_read(text, strlen(text), &value, &end), text,
                               strlen(text), key, header_number_option(known[k].quantity), file,
                               place, log);
        }
}
