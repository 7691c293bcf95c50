/* weartrack - flow room: the case file, the plan (which stages it needs and why), running it.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WEARTRACK_FLOW_H
#define WEARTRACK_FLOW_H

#include "weartrack/fit.h"
#include "weartrack/kernel.h"
#include "weartrack/read.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct wt_case wt_case;
/* Reads and checks a case file (schema, then what a schema cannot say). Paths in it are relative to
 * it. */
WT_API wt_status wt_case_read(const char *path, wt_case **out, wt_error *err) WT_NODISCARD;
WT_API void wt_case_free(wt_case *c);
WT_API const char *wt_case_schema(void); /* XSD text; static */

typedef struct wt_run_options {
    const char *formats; /* folder of further descriptions, NULL = none */
    double tolerance;    /* numerical error asked for; 0 = the case's or the default */
    unsigned threads;    /* 0 = one per processor */
    uint64_t seed;       /* of the resampling */
    wt_progress progress;
} wt_run_options;
WT_API wt_run_options wt_run_defaults(void);

/* The plan as a table: stage, runs (1 or 0), because (words), needs, gives. Reads no data file. */
WT_API wt_status wt_plan(const wt_case *c, wt_table **plan, wt_error *err) WT_NODISCARD;
/* Runs what the plan says. Stages left out leave no tables; the table "cost" lists every stage.
 * A file that fails in a batch does not stop the others: it is listed in the table "failures" and
 * *n_failed counts it. */
WT_API wt_status wt_run(const wt_case *c, const wt_run_options *options, wt_parselog *log,
                        wt_result **result, size_t *n_failed, wt_error *err) WT_NODISCARD;

#ifdef __cplusplus
}
#endif
#endif
