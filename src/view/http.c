/* HTTP server by libmicrohttpd. All requests are answered on the thread that waits, so that nothing
 * needs a lock. SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/view.h"

#include <arpa/inet.h>
#include <errno.h>
#include <math.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- refused requests ------------------------------------------------------------------------ */

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

/* ---- server ---------------------------------------------------------------------------------- */

/* A client that is slower than this is cut off [s]. */
enum { IDLE_SECONDS = 20, MAX_CONNECTIONS = 32, CONNECTION_MEMORY = 32 << 10 };
enum { HTTP_OK = 200, HTTP_TARGET_TOO_LONG = 414, HTTP_UNPROCESSABLE = 422 };

/* The policy lets the page load and call this server only. */
static const char *const headers[][2] = {{"Cache-Control", "no-store"},
                                         {"X-Content-Type-Options", "nosniff"},
                                         {"Referrer-Policy", "no-referrer"},
                                         {"Cross-Origin-Resource-Policy", "same-origin"},
                                         {"Cross-Origin-Opener-Policy", "same-origin"},
                                         {"X-Frame-Options", "SAMEORIGIN"},
                                         {"Content-Security-Policy",
                                          "default-src 'none'; script-src 'self'; style-src 'self' "
                                          "'unsafe-inline'; img-src 'self' data:; "
                                          "font-src data:; connect-src 'self'; frame-src 'self'; "
                                          "frame-ancestors 'self'; base-uri 'none'; "
                                          "form-action 'none'"}};

static void *start_call(void *view, const char *target, struct MHD_Connection *connection)
{
    view_call *call = wt_alloc(1, sizeof *call);
    *call = (view_call){.view = view, .connection = connection, .media = "application/json"};
    if (strnlen(target, VIEW_TARGET_LIMIT + 1) <= VIEW_TARGET_LIMIT)
        call->target = wt_strdup(target);
    return call;
}

static void end_call(void *view, struct MHD_Connection *connection, void **state,
                     enum MHD_RequestTerminationCode code)
{
    view_call *call = *state;
    (void)view;
    (void)connection;
    (void)code;
    if (call == NULL)
        return;
    text_free(&call->body);
    text_free(&call->reply);
    free(call->target);
    free(call);
    *state = NULL;
}

static enum MHD_Result send_reply(const view_call *call)
{
    /* The reply is freed with the call, after it is sent. */
    struct MHD_Response *response = MHD_create_response_from_buffer(
        call->reply.length, (void *)(size_t)text_string(&call->reply), MHD_RESPMEM_PERSISTENT);
    if (response == NULL)
        return MHD_NO;
    (void)MHD_add_response_header(response, "Content-Type", call->media);
    for (size_t i = 0; i < COUNT_OF(headers); i++)
        (void)MHD_add_response_header(response, headers[i][0], headers[i][1]);
    const enum MHD_Result result = MHD_queue_response(call->connection, call->status, response);
    MHD_destroy_response(response);
    return result;
}

static const char *header(const view_call *call, const char *name)
{
    return MHD_lookup_connection_value(call->connection, MHD_HEADER_KIND, name);
}

static void answer(view_call *call)
{
    wt_error err = WT_ERROR_INIT;
    char message[2048];
    if (call->route->answer(call, &err) != WT_OK) {
        wt_error_format(&err, message, sizeof message);
        text_free(&call->reply);
        call->status = call->status == HTTP_OK ? HTTP_UNPROCESSABLE : call->status;
        call->media = "application/json";
        text_add(&call->reply, "{\"error\":");
        text_json(&call->reply, message);
        text_add(&call->reply, "}");
    } else if (call->reply.length == 0) {
        text_add(&call->reply, "{}");
    }
}

static enum MHD_Result handle(void *user, struct MHD_Connection *connection, const char *url,
                              const char *method, const char *version, const char *upload,
                              size_t *upload_size, void **state)
{
    const wt_view *view = user;
    view_call *call = *state;
    (void)connection;
    (void)url;
    (void)version;
    if (call->status == 0) {
        const view_head head = {method, call->target, header(call, "Host"), header(call, "Origin"),
                                header(call, "Sec-Fetch-Site")};
        call->status = call->target == NULL
                           ? HTTP_TARGET_TOO_LONG
                           : view_admit(&head, view->token, view->port, view->routes, &call->route);
        if (call->status == HTTP_OK)
            return MHD_YES;
        /* A refusal before the body ends the connection, so that a large body is never read. */
        call->media = "text/plain; charset=utf-8";
        text_format(&call->reply, "%u: refused; open the address that weartrack view printed\n",
                    call->status);
        return send_reply(call);
    }
    if (*upload_size > 0) {
        if (call->body.length + *upload_size > call->route->limit)
            return MHD_NO;
        text_bytes(&call->body, upload, *upload_size);
        *upload_size = 0;
        return MHD_YES;
    }
    answer(call);
    return send_reply(call);
}

const char *call_text(const view_call *call, const char *name)
{
    const char *value = NULL;
    size_t size = 0;
    return MHD_lookup_connection_value_n(call->connection, MHD_GET_ARGUMENT_KIND, name,
                                         strlen(name), &value, &size) == MHD_YES &&
                   value != NULL && strlen(value) == size
               ? value
               : "";
}

size_t call_number(const view_call *call, const char *name, size_t most)
{
    const char *text = call_text(call, name);
    double value = 0;
    return text[0] == '\0' ? 0
           : wt_number_parse(text, strlen(text), '.', &value) && value >= 0 &&
                   value < (double)most && floor(value) == value
               ? (size_t)value
               : most;
}

wt_status http_open(wt_view *view, wt_error *err)
{
    struct sockaddr_in loopback = {.sin_family = AF_INET,
                                   .sin_port = htons((uint16_t)view->options.port),
                                   .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    errno = 0;
    view->daemon = MHD_start_daemon(
        MHD_USE_AUTO, (uint16_t)view->options.port, NULL, NULL, handle, view, MHD_OPTION_SOCK_ADDR,
        (struct sockaddr *)&loopback, MHD_OPTION_URI_LOG_CALLBACK, start_call, view,
        MHD_OPTION_NOTIFY_COMPLETED, end_call, NULL, MHD_OPTION_CONNECTION_LIMIT,
        (unsigned)MAX_CONNECTIONS, MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)IDLE_SECONDS,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)CONNECTION_MEMORY, MHD_OPTION_END);
    const union MHD_DaemonInfo *bound =
        view->daemon != NULL ? MHD_get_daemon_info(view->daemon, MHD_DAEMON_INFO_BIND_PORT) : NULL;
    if (bound != NULL) {
        view->port = bound->port;
        return WT_OK;
    }
    const wt_status status =
        wt_fail(err, WT_E_IO, "the server could not listen on port %u: %s", view->options.port,
                errno != 0 ? strerror(errno) : "unknown reason");
    wt_error_advice(err, "use another --port, or none for a free one");
    return status;
}

wt_status http_wait(wt_view *view, unsigned milliseconds, wt_error *err)
{
    return MHD_run_wait(view->daemon, (int32_t)milliseconds) == MHD_YES || errno == EINTR
               ? WT_OK
               : wt_fail(err, WT_E_IO, "the server failed: %s", strerror(errno));
}

void http_close(wt_view *view)
{
    MHD_stop_daemon(view->daemon); /* accepts NULL */
}
