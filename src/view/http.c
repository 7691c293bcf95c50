/* HTTP server by libmicrohttpd. All requests are answered on the thread that waits, so that nothing
 * needs a lock. SPDX-License-Identifier: GPL-3.0-or-later */
#include "view/http.h"

#include <arpa/inet.h>
#include <errno.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>

/* A client that is slower than this is cut off [s]. */
enum { IDLE_SECONDS = 20, MAX_CONNECTIONS = 32, CONNECTION_MEMORY = 32 << 10 };

struct http_server {
    struct MHD_Daemon *daemon;
    http_admit *admit;
    http_answer *answer;
    void *user;
    unsigned port;
};

typedef struct http_connection {
    char *target; /* as sent, not decoded; NULL if it is too long */
    bool admitted;
    unsigned status;
    view_request request;
    text_buffer body;
} http_connection;

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

static void *start_connection(void *user, const char *target, struct MHD_Connection *connection)
{
    (void)user;
    (void)connection;
    http_connection *c = wt_alloc(1, sizeof *c);
    *c = (http_connection){0};
    if (strnlen(target, VIEW_TARGET_LIMIT + 1) <= VIEW_TARGET_LIMIT)
        c->target = wt_strdup(target);
    return c;
}

static void end_connection(void *user, struct MHD_Connection *connection, void **state,
                           enum MHD_RequestTerminationCode code)
{
    (void)user;
    (void)connection;
    (void)code;
    http_connection *c = *state;
    if (c == NULL)
        return;
    text_free(&c->body);
    free(c->target);
    free(c);
    *state = NULL;
}

static enum MHD_Result send_reply(struct MHD_Connection *connection, view_reply *reply)
{
    struct MHD_Response *response =
        reply->bytes != NULL
            ? MHD_create_response_from_buffer(reply->length, (void *)(size_t)reply->bytes,
                                              MHD_RESPMEM_PERSISTENT)
            : MHD_create_response_from_buffer(reply->text.length, reply->text.bytes,
                                              MHD_RESPMEM_MUST_FREE);
    if (response == NULL) {
        text_free(&reply->text);
        return MHD_NO;
    }
    (void)MHD_add_response_header(response, "Content-Type", reply->media);
    for (size_t i = 0; i < sizeof headers / sizeof headers[0]; i++)
        (void)MHD_add_response_header(response, headers[i][0], headers[i][1]);
    const enum MHD_Result result = MHD_queue_response(connection, reply->status, response);
    MHD_destroy_response(response);
    return result;
}

static enum MHD_Result refuse(struct MHD_Connection *connection, unsigned status)
{
    view_reply reply = {.status = status, .media = "text/plain; charset=utf-8"};
    text_format(&reply.text, "%u: refused; open the address that weartrack view printed\n", status);
    return send_reply(connection, &reply);
}

static enum MHD_Result handle(void *user, struct MHD_Connection *connection, const char *url,
                              const char *method, const char *version, const char *upload,
                              size_t *upload_size, void **state)
{
    enum { HTTP_OK = 200, HTTP_BODY_TOO_LARGE = 413, HTTP_TARGET_TOO_LONG = 414 };
    http_server *server = user;
    http_connection *c = *state;
    (void)url;
    (void)version;
    if (!c->admitted) {
        const view_head head = {
            .method = method,
            .target = c->target,
            .host = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Host"),
            .origin = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Origin"),
            .site = MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Sec-Fetch-Site")};
        c->admitted = true;
        c->status = c->target == NULL ? HTTP_TARGET_TOO_LONG
                                      : server->admit(server->user, &head, &c->request);
        /* A refusal before the body ends the connection, so that a large body is never read. */
        return c->status == HTTP_OK ? MHD_YES : refuse(connection, c->status);
    }
    if (*upload_size > 0) {
        if (c->body.length + *upload_size >
            (c->request.action == VIEW_ADD ? VIEW_FILE_LIMIT : VIEW_BODY_LIMIT))
            c->status = HTTP_BODY_TOO_LARGE;
        else
            text_bytes(&c->body, upload, *upload_size);
        *upload_size = 0;
        return c->status == HTTP_OK ? MHD_YES : MHD_NO;
    }
    view_reply reply = {.status = HTTP_OK, .media = "application/json"};
    server->answer(server->user, &c->request, text_string(&c->body), c->body.length, &reply);
    return send_reply(connection, &reply);
}

wt_status http_open(unsigned port, http_admit *admit, http_answer *answer, void *user,
                    http_server **server, wt_error *err)
{
    struct sockaddr_in loopback = {.sin_family = AF_INET,
                                   .sin_port = htons((uint16_t)port),
                                   .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    http_server *s = wt_alloc(1, sizeof *s);
    *s = (http_server){.admit = admit, .answer = answer, .user = user};
    errno = 0;
    s->daemon = MHD_start_daemon(
        MHD_USE_AUTO, (uint16_t)port, NULL, NULL, handle, s, MHD_OPTION_SOCK_ADDR,
        (struct sockaddr *)&loopback, MHD_OPTION_URI_LOG_CALLBACK, start_connection, NULL,
        MHD_OPTION_NOTIFY_COMPLETED, end_connection, NULL, MHD_OPTION_CONNECTION_LIMIT,
        (unsigned)MAX_CONNECTIONS, MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)IDLE_SECONDS,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)CONNECTION_MEMORY, MHD_OPTION_END);
    const union MHD_DaemonInfo *bound =
        s->daemon != NULL ? MHD_get_daemon_info(s->daemon, MHD_DAEMON_INFO_BIND_PORT) : NULL;
    if (bound == NULL) {
        const int code = errno;
        http_close(s);
        const wt_status status = wt_fail(err, WT_E_IO, "the server could not listen on port %u: %s",
                                         port, code != 0 ? strerror(code) : "unknown reason");
        wt_error_advice(err, "use another --port, or none for a free one");
        return status;
    }
    s->port = bound->port;
    *server = s;
    return WT_OK;
}

unsigned http_port(const http_server *server)
{
    return server->port;
}

wt_status http_wait(http_server *server, unsigned milliseconds, wt_error *err)
{
    return MHD_run_wait(server->daemon, (int32_t)milliseconds) == MHD_YES || errno == EINTR
               ? WT_OK
               : wt_fail(err, WT_E_IO, "the server failed: %s", strerror(errno));
}

void http_close(http_server *server)
{
    if (server != NULL && server->daemon != NULL)
        MHD_stop_daemon(server->daemon);
    free(server);
}
