/* One program at a time, which the server starts for long work: weartrack itself.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_VIEW_PROGRAM_H
#define WT_VIEW_PROGRAM_H

#include "core/system/subprocess.h"

typedef struct view_program view_program;
view_program *view_program_new(const char *path); /* borrows the path */
void view_program_free(view_program *program);    /* ends the program; accepts NULL */
/* Starts the program with copies of n arguments in a folder. WT_E_ARG if one is running. */
wt_status view_program_start(view_program *program, const char *folder,
                             const char *const *arguments, size_t n, wt_error *err) WT_NODISCARD;
void view_program_stop(view_program *program);

typedef struct view_program_state {
    bool running;
    size_t n_ended;               /* number of programs that have ended */
    double time;                  /* since the start, or duration [s] */
    program_result end;           /* of the last one */
    const char *const *arguments; /* [n_arguments] of the last one, borrowed until the next start */
    size_t n_arguments;
} view_program_state;
view_program_state view_program_get(view_program *program);

#endif
