/* State of the local server, shared by its answers. Internal to view.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_VIEW_VIEW_H
#define WT_VIEW_VIEW_H

#include "case/case.h"
#include "case/run/refit.h"
#include "view/case_folder.h"
#include "view/http.h"
#include "view/program.h"
#include "weartrack/view.h"

#include <time.h>

enum { VIEW_PAGES = 16 };

/* An open page, which reports regularly that it is open. */
typedef struct open_page {
    char name[33];
    double last; /* time of its last report [s] */
} open_page;

struct wt_view {
    wt_view_options options;
    case_folder folder;
    char *case_name, *case_path; /* in the folder; the file need not exist yet */
    char *result_name;           /* in the folder */
    char *report_name;           /* folder of the report in the folder */
    char **given;                /* [n_given] absolute paths of data files */
    size_t n_given;
    bool by_files; /* the call names data files; else they are those of the folder */
    char **files;  /* [n_files] paths of the files of the last state, by number */
    size_t n_files;
    char token[VIEW_TOKEN_LENGTH + 1], address[96];
    http_server *server;
    wt_formats *formats;
    case_refit *refit;
    wt_result *result; /* as read from result_name; NULL: none */
    struct timespec result_time;
    view_program *program;
    open_page pages[VIEW_PAGES];
    size_t n_pages;
    double
        close_time; /* without a page the server ends at this time [s]; 0: no page was open yet */
};

/* Answers an admitted request (http_answer). */
void view_answer(void *user, const view_request *request, const char *body, size_t length,
                 view_reply *reply);
/* Adds a data file to those of the case to be written; takes ownership of the path. */
void view_give_file(wt_view *view, char *path);
/* Appends case, overrides, files and results as JSON. */
wt_status view_append_state(wt_view *view, text_buffer *to, wt_error *err) WT_NODISCARD;
/* Reads the result again if its file has changed; view->result is NULL if there is none. */
wt_status view_read_result(wt_view *view, wt_error *err) WT_NODISCARD;
/* Returns the file of the manual overrides of the case that is on the disk, a name in its folder.
 * NULL if the case names a file elsewhere. The caller frees it. */
char *view_overrides_name(const wt_view *view);

#endif
