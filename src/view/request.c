/* Parses the head of a request and refuses what the page of this server does not send.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/request.h"

#include "core/base/utf8.h"
#include "weartrack/core.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    HTTP_OK = 200,
    HTTP_BAD_REQUEST = 400,
    HTTP_FORBIDDEN = 403,
    HTTP_NOT_FOUND = 404,
    HTTP_METHOD = 405,
    HTTP_TOO_LONG = 414
};

static const struct {
    const char *name;
    bool post;
} actions[VIEW_ACTIONS] = {
    [VIEW_FILE] = {"", false},
    [VIEW_STATE] = {"state", false},
    [VIEW_INFO] = {"info", false},
    [VIEW_TABLE] = {"table", false},
    [VIEW_REPORT] = {"report", false},
    [VIEW_PROGRESS] = {"progress", false},
    [VIEW_CHECK] = {"check", true},
    [VIEW_TRIAL] = {"trial", true},
    [VIEW_CURVE] = {"curve", true},
    [VIEW_CASE] = {"case", true},
    [VIEW_OVERRIDES] = {"overrides", true},
    [VIEW_ADD] = {"add", true},
    [VIEW_NEW_CASE] = {"new-case", true},
    [VIEW_RUN] = {"run", true},
    [VIEW_STOP] = {"stop", true},
    [VIEW_ALIVE] = {"alive", true},
    [VIEW_LEAVE] = {"leave", true},
};

/* ---- addresses ------------------------------------------------------------------------------- */

/* True for the address of this server: a page with another name that resolves to 127.0.0.1 is
 * refused, too. */
static bool is_own_address(const char *text, const char *scheme, unsigned port)
{
    static const char *const names[] = {"127.0.0.1", "localhost"};
    char own[64];
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        (void)snprintf(own, sizeof own, "%s%s:%u", scheme, names[i], port);
        if (strcmp(text, own) == 0)
            return true;
    }
    return false;
}

static bool is_from_own_page(const view_head *head, unsigned port)
{
    if (head->host == NULL || !is_own_address(head->host, "", port))
        return false;
    if (head->origin != NULL && !is_own_address(head->origin, "http://", port))
        return false;
    return head->site == NULL || strcmp(head->site, "same-origin") == 0 ||
           strcmp(head->site, "none") == 0;
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

/* ---- query ----------------------------------------------------------------------------------- */

static int hexadecimal_digit(char c)
{
    static const char digits[] = "0123456789abcdef";
    const char lower = (char)(c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c);
    const char *at = c != '\0' ? strchr(digits, lower) : NULL;
    return at != NULL ? (int)(at - digits) : -1;
}

/* Decodes a value. False if it is too long, not UTF-8, or has a control character. */
static bool decode_value(const char *from, size_t length, char *to, size_t size)
{
    enum { FIRST_PRINTABLE = 0x20, DELETE = 0x7f };
    size_t n = 0;
    for (size_t i = 0; i < length; i++) {
        char c = from[i];
        if (c == '%') {
            const int high = i + 2 < length ? hexadecimal_digit(from[i + 1]) : -1;
            const int low = i + 2 < length ? hexadecimal_digit(from[i + 2]) : -1;
            if (high < 0 || low < 0)
                return false;
            c = (char)(high * 16 + low);
            i += 2;
        } else if (c == '+') {
            c = ' ';
        }
        const unsigned char byte = (unsigned char)c;
        if (byte < FIRST_PRINTABLE || byte == DELETE || n + 1 >= size)
            return false;
        to[n++] = c;
    }
    to[n] = '\0';
    for (size_t i = 0, step; i < n; i += step)
        if ((step = utf8_character_length(to + i, n - i)) == 0)
            return false;
    return true;
}

static bool parse_whole_number(const char *text, double most, double *value)
{
    return wt_number_parse(text, strlen(text), '.', value) && *value >= 0 && *value <= most &&
           floor(*value) == *value;
}

static bool is_hexadecimal(const char *text)
{
    while (hexadecimal_digit(*text) >= 0)
        text++;
    return *text == '\0';
}

/* Stores one parameter. False if its name is unknown or its value invalid. */
static bool store_parameter(const char *name, size_t name_length, const char *value, size_t length,
                            view_request *to)
{
    enum { MAX_REPLICATES = 100000 };
    char number[64];
    double parsed = 0;
    const struct {
        const char *name;
        char *to;
        size_t size;
    } texts[] = {{"name", to->name, sizeof to->name}, {"group", to->group, sizeof to->group},
                 {"file", to->file, sizeof to->file}, {"was", to->digest, sizeof to->digest},
                 {"page", to->page, sizeof to->page}, {"number", number, sizeof number},
                 {"contact", number, sizeof number},  {"replicates", number, sizeof number}};
    size_t k = 0;
    while (k < sizeof texts / sizeof texts[0] &&
           (strlen(texts[k].name) != name_length || memcmp(texts[k].name, name, name_length) != 0))
        k++;
    if (k == sizeof texts / sizeof texts[0] ||
        !decode_value(value, length, texts[k].to, texts[k].size))
        return false;
    if (texts[k].to == to->digest || texts[k].to == to->page)
        return is_hexadecimal(texts[k].to);
    if (texts[k].to != number)
        return true;
    if (strcmp(texts[k].name, "contact") == 0)
        return wt_number_parse(number, strlen(number), '.', &to->contact_point) &&
               isfinite(to->contact_point);
    const bool is_number = strcmp(texts[k].name, "number") == 0;
    if (!parse_whole_number(number, is_number ? 0x1p40 : MAX_REPLICATES, &parsed))
        return false;
    if (is_number)
        to->number = (size_t)parsed;
    else
        to->replicates = (unsigned)parsed;
    return true;
}

static bool parse_query(const char *query, view_request *to)
{
    while (*query != '\0') {
        const size_t length = strcspn(query, "&"), name = strcspn(query, "=&");
        if (name == length ||
            !store_parameter(query, name, query + name + 1, length - name - 1, to))
            return false;
        query += length + (query[length] == '&');
    }
    return true;
}

/* ---- request --------------------------------------------------------------------------------- */

/* Finds the action of a path, or the embedded file that it names. */
static bool find_action(const char *path, size_t length, view_request *to)
{
    static const char allowed[] = "abcdefghijklmnopqrstuvwxyz.";
    for (int k = 1; k < VIEW_ACTIONS; k++)
        if (strlen(actions[k].name) == length && memcmp(actions[k].name, path, length) == 0) {
            to->action = (view_action)k;
            return true;
        }
    to->action = VIEW_FILE;
    if (length >= sizeof to->name || strspn(path, allowed) < length)
        return false;
    memcpy(to->name, length > 0 ? path : "view.html", length > 0 ? length : sizeof "view.html");
    return length == 0 || memchr(path, '.', length) != NULL;
}

unsigned view_request_parse(const view_head *head, const char *token, unsigned port,
                            view_request *request)
{
    *request = (view_request){.contact_point = (double)NAN};
    if (head->target == NULL || head->method == NULL)
        return HTTP_BAD_REQUEST;
    if (strnlen(head->target, VIEW_TARGET_LIMIT + 1) > VIEW_TARGET_LIMIT)
        return HTTP_TOO_LONG;
    if (!is_from_own_page(head, port) || !has_token(head->target, token))
        return HTTP_FORBIDDEN;
    const char *path = head->target + VIEW_TOKEN_LENGTH + 2;
    const size_t length = strcspn(path, "?");
    if (!find_action(path, length, request))
        return HTTP_NOT_FOUND;
    if (strcmp(head->method, actions[request->action].post ? "POST" : "GET") != 0)
        return HTTP_METHOD;
    return path[length] == '\0' || parse_query(path + length + 1, request) ? HTTP_OK
                                                                           : HTTP_BAD_REQUEST;
}
