/* Refuses what the page of this server does not send. SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include <stdio.h>
#include <string.h>

/* True for the address of this server: a page with another name that resolves to 127.0.0.1 is
 * refused, too. */
static bool is_own_address(const char *text, const char *scheme, unsigned port)
{
    char own[2][64];
    (void)snprintf(own[0], sizeof own[0], "%s127.0.0.1:%u", scheme, port);
    (void)snprintf(own[1], sizeof own[1], "%slocalhost:%u", scheme, port);
    return strcmp(text, own[0]) == 0 || strcmp(text, own[1]) == 0;
}

static bool is_from_own_page(const view_head *head, unsigned port)
{
    return head->host != NULL && is_own_address(head->host, "", port) &&
           (head->origin == NULL || is_own_address(head->origin, "http://", port)) &&
           (head->site == NULL || strcmp(head->site, "same-origin") == 0 ||
            strcmp(head->site, "none") == 0);
}

/* Compares in a time that does not depend on the position of the first difference. */
static bool has_token(const char *target, const char *token)
{
    unsigned differences = 0;
    if (target[0] != '/' || strnlen(target + 1, VIEW_TOKEN_LENGTH) < VIEW_TOKEN_LENGTH ||
        target[1 + VIEW_TOKEN_LENGTH] != '/')
        return false;
    for (size_t i = 0; i < VIEW_TOKEN_LENGTH; i++)
        differences |= (unsigned char)(target[1 + i] ^ token[i]);
    return differences == 0;
}

unsigned view_admit(const view_head *head, const char *token, unsigned port,
                    const view_route *routes, const view_route **route)
{
    enum {
        OK = 200,
        BAD_REQUEST = 400,
        FORBIDDEN = 403,
        NOT_FOUND = 404,
        METHOD = 405,
        TOO_LONG = 414
    };
    static const char allowed[] = "abcdefghijklmnopqrstuvwxyz.";
    if (head->target == NULL || head->method == NULL)
        return BAD_REQUEST;
    if (strnlen(head->target, VIEW_TARGET_LIMIT + 1) > VIEW_TARGET_LIMIT)
        return TOO_LONG;
    if (!is_from_own_page(head, port) || !has_token(head->target, token))
        return FORBIDDEN;
    const char *path = head->target + VIEW_TOKEN_LENGTH + 2;
    const size_t length = strcspn(path, "?");
    const view_route *r = routes + 1;
    while (r->path != NULL && (strlen(r->path) != length || memcmp(r->path, path, length) != 0))
        r++;
    if (r->path == NULL && path[strspn(path, allowed)] == '\0' &&
        (length == 0 || strchr(path, '.') != NULL))
        r = routes;
    if (r->path == NULL)
        return NOT_FOUND;
    *route = r;
    return strcmp(head->method, r->limit > 0 ? "POST" : "GET") == 0 ? OK : METHOD;
}
