/* Fuzz target: any HTTP request. An admitted request has the token, the host and the method of
 * its route. The lines are method, target, host, origin and site; a missing line is a missing
 * header.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char token[] = "0123456789abcdef0123456789abcdef";
    enum { PORT = 4711, LINES = 5 };
    char *text = strndup((const char *)data, size), *rest = text, *line[LINES] = {NULL};
    const view_route *route = NULL;
    if (text == NULL)
        abort();
    for (int i = 0; i < LINES && rest != NULL; i++)
        line[i] = strsep(&rest, "\n");
    const view_head head = {line[0], line[1], line[2], line[3], line[4]};
    if (view_admit(&head, token, PORT, view_routes, &route) == 200 &&
        (strncmp(line[1] + 1, token, sizeof token - 1) != 0 || line[2] == NULL ||
         (strcmp(line[2], "127.0.0.1:4711") != 0 && strcmp(line[2], "localhost:4711") != 0) ||
         (line[3] != NULL && strstr(line[3], ":4711") == NULL) || route->answer == NULL ||
         strcmp(line[0], route->limit > 0 ? "POST" : "GET") != 0))
        abort();
    free(text);
    return 0;
}
