/* Writes messages on standard error as lines of JSON, for programs that run many calls.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>
#include <time.h>

#include "cmd/cmd.h"
#include "core/base/json.h"

static const char *of; /* name of the subcommand; NULL: messages are plain text */

void cmd_log_json(const char *name)
{
    of = name;
}

bool cmd_is_json(void)
{
    return of != NULL;
}

static void put_member(const char *name, const char *text)
{
    fprintf(stderr, "\"%s\": ", name);
    json_put_text(stderr, text);
}

/* Writes the time in UTC (ISO 8601); nothing if the clock is invalid. */
static void put_time(void)
{
    char text[32];
    struct tm utc;
    const time_t now = time(NULL);
    if (gmtime_r(&now, &utc) == NULL ||
        strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc) == 0)
        return;
    fputs(", ", stderr);
    put_member("time", text);
}

void cmd_event(const char *event, const cmd_word *words, size_t n)
{
    if (of == NULL)
        return;
    fputc('{', stderr);
    put_member("event", event);
    put_time();
    fputs(", ", stderr);
    put_member("subcommand", of);
    for (size_t i = 0; i < n; i++) {
        if (words[i].text != NULL && words[i].text[0] == '\0')
            continue;
        fputs(", ", stderr);
        if (words[i].text != NULL)
            put_member(words[i].name, words[i].text);
        else
            fprintf(stderr, "\"%s\": %zu", words[i].name, words[i].number);
    }
    fputs("}\n", stderr);
}
