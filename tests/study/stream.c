/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stream.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The file split into lines, and the first line of each table. */
struct stream {
    char *text;
    char **lines;
    int n;
};

static char *read_all(const char *path)
{
    FILE *file = fopen(path, "r");
    char *text = NULL;
    size_t n = 0;
    if (file == NULL)
        return NULL;
    for (;;) {
        char *grown = realloc(text, n + 65536 + 1);
        if (grown == NULL) {
            free(text);
            fclose(file);
            return NULL;
        }
        text = grown;
        const size_t got = fread(text + n, 1, 65536, file);
        n += got;
        if (got == 0)
            break;
    }
    text[n] = '\0';
    fclose(file);
    return text;
}

stream *stream_read(const char *path)
{
    stream *s = calloc(1, sizeof *s);
    if (s != NULL)
        s->text = read_all(path);
    if (s == NULL || s->text == NULL) {
        stream_free(s);
        return NULL;
    }
    int lines = 1;
    for (const char *c = s->text; *c != '\0'; c++)
        lines += *c == '\n';
    s->lines = calloc((size_t)lines, sizeof *s->lines);
    if (s->lines == NULL) {
        stream_free(s);
        return NULL;
    }
    char *rest = s->text;
    while (rest != NULL)
        s->lines[s->n++] = strsep(&rest, "\n");
    return s;
}

void stream_free(stream *s)
{
    if (s == NULL)
        return;
    free(s->text);
    free(s->lines);
    free(s);
}

static const char *after(const char *line, const char *start)
{
    const size_t n = strlen(start);
    return strncmp(line, start, n) == 0 ? line + n : NULL;
}

/* Line after the start of the table; -1 if there is none. */
static int table_start(const stream *s, const char *table)
{
    for (int i = 0; i < s->n; i++) {
        const char *name = after(s->lines[i], "## table: ");
        if (name != NULL && strcmp(name, table) == 0)
            return i + 1;
    }
    return -1;
}

const char *stream_key(const stream *s, const char *table, const char *key)
{
    for (int i = table_start(s, table); i >= 0 && i < s->n; i++) {
        const char *rest = after(s->lines[i], "## ");
        if (rest == NULL)
            break;
        rest = after(rest, key);
        if (rest != NULL && strncmp(rest, ": ", 2) == 0)
            return rest + 2;
    }
    return NULL;
}

double stream_number(const stream *s, const char *table, const char *key, const char *attribute)
{
    const char *text = stream_key(s, table, key);
    if (text != NULL && attribute != NULL) {
        char wanted[64];
        snprintf(wanted, sizeof wanted, " %s=", attribute);
        text = strstr(text, wanted);
        if (text != NULL)
            text += strlen(wanted);
    }
    char *end = NULL;
    const double value = text != NULL ? strtod(text, &end) : (double)NAN;
    return end != text ? value : (double)NAN;
}

/* Line with the column names; -1 if there is none. */
static int names_line(const stream *s, const char *table)
{
    int i = table_start(s, table);
    while (i >= 0 && i < s->n && after(s->lines[i], "## ") != NULL)
        i++;
    return i >= 0 && i < s->n && after(s->lines[i], "# ") != NULL ? i : -1;
}

/* Line of a row; blank lines are not rows. */
static int row_line(const stream *s, const char *table, int row)
{
    const int names = names_line(s, table);
    if (names < 0)
        return -1;
    for (int i = names + 1, k = 0; i < s->n && s->lines[i][0] != '#'; i++)
        if (s->lines[i][0] != '\0' && k++ == row)
            return i;
    return -1;
}

int stream_rows(const stream *s, const char *table)
{
    const int names = names_line(s, table);
    int n = 0;
    if (names >= 0)
        for (int i = names + 1; i < s->n && s->lines[i][0] != '#'; i++)
            n += s->lines[i][0] != '\0';
    return n;
}

/* NULL without such a table, column or row. */
static const char *cell_at(const stream *s, const char *table, const char *column, int row)
{
    const int names = names_line(s, table), line = row_line(s, table, row);
    if (line < 0)
        return NULL;
    const size_t length = strlen(column);
    const char *name = s->lines[names] + 2, *cell = s->lines[line];
    while (strncmp(name, column, length) != 0 || name[length] != '[') {
        name = strchr(name, '\t');
        cell = strchr(cell, '\t');
        if (name == NULL || cell == NULL)
            return NULL;
        name++;
        cell++;
    }
    return cell;
}

double stream_cell(const stream *s, const char *table, const char *column, int row)
{
    const char *cell = cell_at(s, table, column, row);
    char *end;
    const double value = cell != NULL ? strtod(cell, &end) : (double)NAN;
    return cell != NULL && end != cell ? value : (double)NAN;
}

int stream_is(const stream *s, const char *table, const char *column, int row, const char *text)
{
    const char *cell = cell_at(s, table, column, row);
    const size_t length = strlen(text);
    return cell != NULL && strncmp(cell, text, length) == 0 &&
           (cell[length] == '\t' || cell[length] == '\0');
}
