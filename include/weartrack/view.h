/* weartrack - view: a local server for one page on which a case is looked at and edited. The page
 * computes nothing: the server runs the case, or a part of it, with the functions of this library.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_VIEW_H
#define WEARTRACK_VIEW_H

#include "weartrack/case.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wt_view_options {
    const char *const *paths; /* [n_paths] one case, result or folder; or data files */
    size_t n_paths;
    const char *program; /* path of weartrack, which the server starts for whole runs */
    const char *formats; /* folder of further descriptions, NULL = none */
    unsigned port;       /* 0 (default): a free one */
    unsigned threads;    /* 0 (default) = one per processor */
} wt_view_options;
WT_API wt_view_options wt_view_defaults(void);
WT_API const wt_params *wt_view_params(void);

typedef struct wt_view wt_view;
/* Opens the files and listens on 127.0.0.1. WT_E_ARG if the files do not belong together, WT_E_IO
 * if the port is not free. */
WT_API wt_status wt_view_open(const wt_view_options *options, wt_view **view,
                              wt_error *err) WT_NODISCARD;
/* Returns the address of the page, which contains a random token; borrowed. */
WT_API const char *wt_view_address(const wt_view *view);
/* Opens the address in the browser of the user. False if there is none. */
WT_API bool wt_view_show(const wt_view *view);
/* Answers requests until `progress` returns false or the last page is closed. */
WT_API wt_status wt_view_serve(wt_view *view, const wt_progress *progress,
                               wt_error *err) WT_NODISCARD;
WT_API void wt_view_close(wt_view *view); /* Accepts NULL. */

#ifdef __cplusplus
}
#endif
#endif
