/* State of the local server and of a request. Internal to view.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_VIEW_VIEW_H
#define WT_VIEW_VIEW_H

#include "case/case.h"
#include "case/run/refit.h"
#include "core/system/subprocess.h"
#include "report/report_text.h"
#include "weartrack/view.h"

/* Limits of a request [bytes]. */
enum {
    VIEW_TARGET_LIMIT = 4096,
    VIEW_BODY_LIMIT = 4 << 20,  /* of the text of a case */
    VIEW_FILE_LIMIT = 64 << 20, /* of a file that is written */
    VIEW_TOKEN_LENGTH = 32
};

typedef struct view_call view_call;
/* What the server does for a path of its page. */
typedef struct view_route {
    const char *path; /* behind the token */
    size_t limit;     /* of the body of a POST; 0: a GET */
    wt_status (*answer)(view_call *call, wt_error *err);
} view_route;
extern const view_route view_routes[]; /* first the files of the page; ends with a NULL path */

/* What the client sent; missing headers are NULL. */
typedef struct view_head {
    const char *method, *target, *host, *origin;
    const char *site; /* header Sec-Fetch-Site */
} view_head;

/* Checks the head of a request for the server on this port and finds its route. Returns the HTTP
 * status: 200, or the reason for the refusal. */
unsigned view_admit(const view_head *head, const char *token, unsigned port,
                    const view_route *routes, const view_route **route);

/* The program that the server runs for whole cases: weartrack itself, one at a time. */
typedef struct view_program {
    char **arguments; /* [n + 1] of the last one, ends with NULL */
    size_t n;
    bool running; /* or about to be started by wt_view_serve */
    bool stop;
    size_t n_ended;     /* number of programs that have ended */
    double time;        /* of its start, or duration [s] */
    program_result end; /* of the last one */
} view_program;

struct wt_view {
    wt_view_options options;
    char *folder;                /* absolute */
    char *case_name, *case_path; /* in the folder; the file need not exist yet */
    char *result_name;           /* in the folder */
    char *report_name;           /* folder of the report in the folder */
    char *overrides_name; /* of the last state, in the folder; NULL: the case names a file elsewhere
                           */
    char **given;         /* [n_given] absolute paths of data files */
    size_t n_given;
    bool by_files; /* the call names data files; else they are those of the folder */
    char **files;  /* [n_files] paths of the files of the last state, by number */
    size_t n_files;
    char token[VIEW_TOKEN_LENGTH + 1], address[96];
    struct MHD_Daemon *daemon;
    const view_route *routes; /* static */
    unsigned port;
    wt_formats *formats;
    case_refit *refit;
    wt_result *result;   /* as read from result_name; NULL: none */
    int64_t result_time; /* of its file */
    view_program program;
    const wt_progress *progress;
    size_t n_pages;  /* open pages */
    double end_time; /* the server ends at this time [s]; 0: no page was open yet */
};

/* A request and its reply. The status of a failed answer is 422 unless it sets another. */
struct view_call {
    wt_view *view;
    struct MHD_Connection *connection;
    char *target; /* as sent, not decoded; NULL if it is too long */
    const view_route *route;
    text_buffer body;
    unsigned status;
    const char *media; /* static */
    text_buffer reply;
};

/* ---- HTTP on 127.0.0.1: http.c, which alone uses libmicrohttpd ------------------------------- */

wt_status http_open(wt_view *view, wt_error *err) WT_NODISCARD;
/* Answers requests for about this time, on the calling thread. */
wt_status http_wait(wt_view *view, unsigned milliseconds, wt_error *err) WT_NODISCARD;
void http_close(wt_view *view);
/* Returns a parameter of the request, "" without one or if it contains a zero; borrowed. */
const char *call_text(const view_call *call, const char *name);
/* Returns a parameter that is an integer from 0 on; 0 without one, `most` if it is invalid. */
size_t call_number(const view_call *call, const char *name, size_t most);

/* ---- files of the folder: case_file.c. No name with a folder, no link, no special file.
 * ----------
 */

/* True for a plain file name: not hidden, no option, and without '/' and control characters. */
bool is_plain_name(const char *name);
/* Reads a file of at most `limit` bytes. WT_E_NOT_FOUND if there is none. */
wt_status case_file_read(const char *folder, const char *name, size_t limit, text_buffer *text,
                         wt_error *err) WT_NODISCARD;
/* Writes a file, which is complete at every moment. Without `replace` it fails if there is a file
 * of this name. */
wt_status case_file_write(const char *folder, const char *name, bool replace,
                          const text_buffer *text, wt_error *err) WT_NODISCARD;

/* Appends case, overrides, files and results as JSON. */
wt_status view_answer_state(view_call *call, wt_error *err) WT_NODISCARD;
/* Adds a data file to those of the case to be written; takes ownership of the path. */
void view_give_file(wt_view *view, char *path);
/* Reads the result again if its file has changed; view->result is NULL if there is none. */
wt_status view_read_result(wt_view *view, wt_error *err) WT_NODISCARD;

#endif
