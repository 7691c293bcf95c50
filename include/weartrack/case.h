/* weartrack - case: the case file, the plan (which stages it needs and why), its run, and results
 * in words.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_CASE_H
#define WEARTRACK_CASE_H

#include "weartrack/record.h"
#include "weartrack/report.h"
#include "weartrack/study.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- case ----------------------------------------------------------------------------------- */

/* Placeholder of values that are still to be put into a case, which is no valid quantity or tip. */
#define WT_CASE_FILL_IN "FILL IN"

typedef struct wt_case wt_case;
/* Reads and checks a case file (schema, then further rules). Its paths are relative to the file. */
WT_API wt_status wt_case_read(const char *path, wt_case **out, wt_error *err) WT_NODISCARD;
WT_API void wt_case_free(wt_case *c);
/* Restricts the requests of the case to these tables (names in a result, separated by blanks). */
WT_API wt_status wt_case_request_tables(wt_case *c, const char *tables, wt_error *err) WT_NODISCARD;
/* Replaces the records of the case (files, folders or patterns, relative to the current folder) and
 * those parameters of the validation that are marked in `given`, as set by wt_params_set for `job`.
 */
WT_API wt_status wt_case_set_validation(wt_case *c, const char *const *records, size_t n,
                                        const wt_validation_job *job, uint64_t given,
                                        wt_error *err) WT_NODISCARD;
WT_API const char *wt_case_schema(void);            /* XSD text; static */
WT_API const char *wt_case_title(const wt_case *c); /* Returns the title, "" if none; borrowed. */
/* Returns the report options of the case: its style, figures, width and font, or the
 * defaults. Borrowed. */
WT_API const wt_report_options *wt_case_report_options(const wt_case *c);

/* ---- plan and run --------------------------------------------------------------------------- */

typedef struct wt_run_options {
    const char *formats; /* folder of further descriptions, NULL = none */
    double tolerance;    /* requested relative numerical error; default 1e-10 */
    unsigned threads;    /* 0 = one per processor */
    uint64_t seed;       /* seed of the draws */
    size_t replicates;   /* number of draws; default 200 */
    wt_progress progress;
    wt_accuracy_job precision;  /* options of the table "work_precision" */
    bool no_provenance;         /* no times in "cost", no digests in "inputs" */
    const char *const *columns; /* of plain tables, as in wt_formats_add_columns */
    size_t n_columns;
} wt_run_options;
WT_API wt_run_options wt_run_defaults(void);
WT_API const wt_params *wt_run_params(void);

/* Creates the plan as a table: stage, title, runs (1 or 0), because (reason), needs, gives. Reads
 * no data file. */
WT_API wt_status wt_plan(const wt_case *c, wt_table **plan, wt_error *err) WT_NODISCARD;
/* Runs the plan. Skipped stages have no tables; the table "cost" lists every stage. A failed file
 * does not stop the others: the table "failures" lists it and *n_failed counts it. The same holds
 * for a failed stage; the stages that need it are skipped. If no requested table exists, the result
 * still exists, with the status WT_RESULT_EMPTY. */
WT_API wt_status wt_run_case(const wt_case *c, const wt_run_options *options, wt_log *log,
                             wt_result **result, size_t *n_failed, wt_error *err) WT_NODISCARD;

/* ---- a result in words ---------------------------------------------------------------------- */

/* Creates the table "methods" of a result: the methods that produced its tables, in sentences with
 * numbers and references. */
WT_API wt_status wt_methods_table(const wt_result *result, wt_table **table,
                                  wt_error *err) WT_NODISCARD;

/* Logs remarks on the tables of a result: a tolerance that is not reached, extrapolation. The first
 * one, the worst, has the topic WT_TOPIC_WORST_LIMIT unless the fit of the material has told it. */
WT_API void wt_result_log_remarks(const wt_result *result, wt_log *log);
/* A main number or verdict of a result, as a row of a short table. Texts are owned by the rows. */
enum { WT_RESULT_ROW_REASONS = 4 };
typedef struct wt_result_row {
    const char *name;                               /* of the quantity */
    int level;                                      /* 1: part of the last row of level 0 */
    double value, low, high, range_low, range_high; /* NaN for a text or if it is unknown */
    const char *unit; /* of the numbers, SI; a text may show another one: "20 degC", "5 %" */
    /* As people read it: value with unit, or text; 95 % interval and range over choices of the
     * model, "" if unknown; note. */
    const char *text, *interval, *range, *note;
    bool missing; /* the answer lacks its number or interval: the first reason says why */
    struct {
        const char *heading, *text; /* NULL after the last one */
    } reasons[WT_RESULT_ROW_REASONS];
} wt_result_row;
typedef struct wt_result_rows wt_result_rows;

/* Creates the rows of a result: its findings if `findings` and it has some, else its main numbers.
 * The result must exist as long as the rows. */
WT_API wt_result_rows *wt_result_rows_new(const wt_result *result, bool findings);
WT_API void wt_result_rows_free(wt_result_rows *rows);
WT_API size_t wt_result_rows_count(const wt_result_rows *rows);
WT_API wt_result_row wt_result_rows_get(const wt_result_rows *rows, size_t i);
WT_API const char *wt_result_rows_heading(const wt_result_rows *rows); /* conditions, or "" */

#ifdef __cplusplus
}
#endif
#endif
