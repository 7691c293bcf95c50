/* Any request: what is admitted has the token, the host and the method of its action, and its names
 * are text. The lines are method, target, host, origin and site; missing ones are missing headers.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/utf8.h"
#include "view/request.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_text(const char *text, size_t size)
{
    const size_t length = strnlen(text, size);
    if (length == size)
        abort();
    for (size_t i = 0, step; i < length; i += step)
        if ((step = utf8_character_length(text + i, length - i)) == 0 ||
            (unsigned char)text[i] < ' ')
            abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char token[] = "0123456789abcdef0123456789abcdef";
    enum { PORT = 4711, LINES = 5 };
    char *text = strndup((const char *)data, size), *rest = text, *line[LINES] = {NULL};
    view_request request;
    if (text == NULL)
        abort();
    for (int i = 0; i < LINES && rest != NULL; i++)
        line[i] = strsep(&rest, "\n");
    const view_head head = {line[0], line[1], line[2], line[3], line[4]};
    if (view_request_parse(&head, token, PORT, &request) == 200) {
        if (strncmp(line[1] + 1, token, sizeof token - 1) != 0 || line[2] == NULL ||
            (strcmp(line[2], "127.0.0.1:4711") != 0 && strcmp(line[2], "localhost:4711") != 0) ||
            (line[3] != NULL && strstr(line[3], ":4711") == NULL) || request.action >= VIEW_ACTIONS)
            abort();
        if ((request.action == VIEW_CASE || request.action == VIEW_OVERRIDES ||
             request.action == VIEW_RUN) &&
            strcmp(line[0], "POST") != 0)
            abort();
        check_text(request.name, sizeof request.name);
        check_text(request.group, sizeof request.group);
        check_text(request.file, sizeof request.file);
        check_text(request.digest, sizeof request.digest);
        check_text(request.page, sizeof request.page);
    }
    free(text);
    return 0;
}
