/* Writes messages on standard error as lines of JSON, for programs that run many calls.
 * SPDX-License-Identifier: GPL-3.0-or-later */
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

void cmd_log_event(const char *event, const cmd_json_member *words, size_t n)
{
    if (subcommand_name == NULL)
        return;
    fputc('{', stderr);
    write_json_member("event", event);
    write_time();
    fputs(", ", stderr);
    write_json_member("subcommand", subcommand_name);
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
