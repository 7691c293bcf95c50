/* Writes messages on standard error as lines of JSON, for programs that run many calls.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>
#include <time.h>

#include "cmd/cmd.h"
#include "core/base/utf8.h"

static const char *subcommand_name; /* name of the subcommand; NULL: messages are plain text */

void cmd_log_json(const char *name)
{
    subcommand_name = name;
}

bool cmd_log_is_json(void)
{
    return subcommand_name != NULL;
}

static void write_json_member(const char *name, const char *text)
{
    fprintf(stderr, "\"%s\": ", name);
    json_write_text(stderr, text);
}

/* Writes the time in UTC (ISO 8601); nothing if the clock is invalid. */
static void write_time(void)
{
    char text[32];
    struct tm utc;
    const time_t now = time(NULL);
    if (gmtime_r(&now, &utc) == NULL ||
        strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc) == 0)
        return;
    fputs(", ", stderr);
    write_json_member("time", text);
}

static void begin_event(const char *event)
{
    fputc('{', stderr);
    write_json_member("event", event);
    write_time();
    fputs(", ", stderr);
    write_json_member("subcommand", subcommand_name);
}

/* A number that is not finite has no form in JSON and is left out. */
static void write_json_number(const char *name, double value)
{
    char text[32];
    if (!isfinite(value))
        return;
    (void)wt_number_format(value, text);
    fprintf(stderr, ", \"%s\": %s", name, text);
}

void cmd_log_row(const wt_result_row *row)
{
    if (subcommand_name == NULL)
        return;
    begin_event("row");
    fputs(", ", stderr);
    write_json_member("name", row->name);
    fputs(", ", stderr);
    write_json_member("text", row->text);
    write_json_number("value", row->value);
    write_json_number("low", row->low);
    write_json_number("high", row->high);
    write_json_number("range_low", row->range_low);
    write_json_number("range_high", row->range_high);
    if (isfinite(row->value)) {
        fputs(", ", stderr);
        write_json_member("unit", row->unit);
    }
    if (*row->note != '\0') {
        fputs(", ", stderr);
        write_json_member("note", row->note);
    }
    fputs("}\n", stderr);
}

void cmd_log_event(const char *event, const cmd_json_member *words, size_t n)
{
    if (subcommand_name == NULL)
        return;
    begin_event(event);
    for (size_t i = 0; i < n; i++) {
        if (words[i].text != NULL && words[i].text[0] == '\0')
            continue;
        fputs(", ", stderr);
        if (words[i].text != NULL)
            write_json_member(words[i].name, words[i].text);
        else
            fprintf(stderr, "\"%s\": %zu", words[i].name, words[i].number);
    }
    fputs("}\n", stderr);
}
