/* HTTP server on 127.0.0.1. Only http.c uses libmicrohttpd.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_VIEW_HTTP_H
#define WT_VIEW_HTTP_H

#include "report/report_text.h"
#include "view/request.h"

/* The answer to a request. */
typedef struct view_reply {
    unsigned status;
    const char *media; /* static */
    text_buffer text;  /* owned; or */
    const char *bytes; /* [length] static bytes; NULL: text */
    size_t length;
} view_reply;

/* Checks the head of a request and returns the HTTP status; 200 admits it. */
typedef unsigned http_admit(void *user, const view_head *head, view_request *request);
/* Answers an admitted request. `body` ends with a zero. */
typedef void http_answer(void *user, const view_request *request, const char *body, size_t length,
                         view_reply *reply);

typedef struct http_server http_server;
wt_status http_open(unsigned port, http_admit *admit, http_answer *answer, void *user,
                    http_server **server, wt_error *err) WT_NODISCARD;
unsigned http_port(const http_server *server);
/* Answers requests for about this time, on the calling thread. */
wt_status http_wait(http_server *server, unsigned milliseconds, wt_error *err) WT_NODISCARD;
void http_close(http_server *server); /* accepts NULL */

#endif
