/* The indentation job: every curve of every file of a group, streamed, fitted in parallel in
 * batches, written in order.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/param.h"
#include "flow/job/indentation.h"
#include "flow/job/inputs.h"
#include "flow/job/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A batch ends with the first of the two: it bounds memory and keeps all threads busy. */
#define BATCH_CURVES 256
#define BATCH_SAMPLES ((size_t)1 << 22)

/* Range of indentations that the table of the contact function covers; outside it the function is
 * computed directly, so this is only about speed. */
#define DEPTH_MIN 1e-11
#define DEPTH_MAX 1e-4

typedef struct item {
    wt_force_curve curve;
    wt_status status;
    wt_error error;
    wt_indent_fit fit;
} item;

typedef struct accepted {
    double modulus;
    size_t row;
} accepted;

typedef struct work {
    const wt_indent_job *job;
    const wt_job *common;
    flow_file *file;
    const char *spot; /* of the set or the file; NULL = by position */
    wt_contact_table *contact;
    wt_indent_workspace **scratch; /* [n_workers] */
    unsigned n_workers;
    item *items; /* [BATCH_CURVES] */
    size_t n_items;
    wt_table *table;
    size_t n_curves, n_accepted, n_failed;
    /* equal failures of one file make one row */
    wt_error failure;
    size_t n_equal, first_equal;
    /* accepted moduli with the row they are in, for the representative curve */
    accepted *moduli;
    size_t n_moduli, capacity;
    double k_low, k_high; /* spring constants of the accepted curves [N/m] */
} work;

wt_indent_job wt_indent_job_defaults(void)
{
    return (wt_indent_job){
        .group = "bulk",
        .options = wt_indent_defaults(),
        .spring_constant = {(double)NAN, 0, 0, "N/m"},
        .rates = true,
    };
}

static wt_status read_tip(const char *text, void *tip, wt_error *err)
{
    return wt_tip_parse(text, tip, err);
}

static wt_status check_tip(const void *tip, wt_error *err)
{
    return wt_tip_check(tip, err);
}

static wt_status check_group(const void *member, wt_error *err)
{
    const char *group = *(const char *const *)member;
    if (*group != '\0' && group[strspn(group, "abcdefghijklmnopqrstuvwxyz0123456789_")] == '\0')
        return WT_OK;
    return wt_fail(err, WT_E_ARG, "'%s' is not made of a-z, 0-9 and _", group);
}

static const wt_param rows[] = {
    {PARAM_OTHER_OF("tip", wt_indent_job, tip, read_tip), .check = check_tip, .value = "TIP",
     .flags = PARAM_REQUIRED,
     .help = "pyramid:half-angle=35deg,radius=20nm[,sides=4][,transition=16nm] (axis to FACE), "
             "sphere:radius=5um or cone:half-angle=20deg"},
    {PARAM_TEXT_OF("group", wt_indent_job, group), .check = check_group, .value = "NAME",
     .flags = PARAM_NO_CASE, .help = "what these curves are: bulk, track or another name"},
    {PARAM_FLAG_OF("curves", wt_indent_job, curves), .flags = PARAM_NO_CASE,
     .help = "also the representative (median) curve and its fit"},
};
PARAM_TABLE(wt_indent_job_params, wt_indent_job, rows, wt_indent_job_defaults,
            PARAM_PART(wt_indent_params, wt_indent_job, options))

static wt_quantity_set wanted_channels(bool rates)
{
    wt_quantity_set want = WT_Q_BIT(WT_Q_HEIGHT) | WT_Q_BIT(WT_Q_MEASURED_HEIGHT) |
                           WT_Q_BIT(WT_Q_FORCE) | WT_Q_BIT(WT_Q_DEFLECTION) |
                           WT_Q_BIT(WT_Q_DEFLECTION_VOLTAGE);
    return rates ? want | WT_Q_BIT(WT_Q_TIME) : want;
}

/* ---- failures of curves -----------------------------------------------------------------------
 */

static wt_status flush_failures(work *w, wt_error *err)
{
    if (w->n_equal == 0)
        return WT_OK;
    wt_error failure = w->failure;
    if (w->n_equal > 1)
        wt_error_place(&failure, "curve %zu and %zu more", w->first_equal, w->n_equal - 1);
    else
        wt_error_place(&failure, "curve %zu", w->first_equal);
    w->n_equal = 0;
    w->n_failed++;
    return flow_failed(w->common, w->file->name, &failure, err);
}

static wt_status note_failure(work *w, size_t curve, const wt_error *failure, wt_error *err)
{
    if (w->n_equal > 0 && strcmp(failure->message, w->failure.message) == 0) {
        w->n_equal++;
        return WT_OK;
    }
    wt_status status = flush_failures(w, err);
    w->failure = *failure;
    w->first_equal = curve;
    w->n_equal = 1;
    return status;
}

/* ---- one batch --------------------------------------------------------------------------------
 */

static wt_status fit_item(void *user, size_t i, unsigned worker)
{
    work *w = user;
    item *it = &w->items[i];
    if (it->status == WT_OK)
        it->status = wt_indent_force_curve(w->contact, &w->job->options, &it->curve,
                                           w->scratch[worker], &it->fit, &it->error);
    return WT_OK; /* a curve that fails does not stop the others */
}

static wt_indent_fit unreadable(const wt_error *error)
{
    wt_estimate none_pa = {(double)NAN, (double)NAN, (double)NAN, "Pa"},
                none_m = {(double)NAN, (double)NAN, (double)NAN, "m"},
                none_n = {(double)NAN, (double)NAN, (double)NAN, "N"},
                none_tilt = {(double)NAN, (double)NAN, (double)NAN, "N/m"};
    wt_indent_fit fit = {
        .verdict = WT_CURVE_UNREADABLE,
        .modulus = none_pa,
        .contact_point = none_m,
        .baseline_offset = none_n,
        .baseline_tilt = none_tilt,
        .noise = (double)NAN,
        .correlation_length = (double)NAN,
        .r_squared = (double)NAN,
        .max_force = (double)NAN,
        .max_indentation = (double)NAN,
        .adhesion_force = (double)NAN,
        .piezo_rate = (double)NAN,
        .indentation_rate = (double)NAN,
        .load_time = (double)NAN,
        .second_minimum_ratio = (double)NAN,
        .second_contact_point = (double)NAN,
        .sensitivity_gain = (double)NAN,
    };
    snprintf(fit.reason, sizeof fit.reason, "%.159s", error->message);
    return fit;
}

static wt_status keep_modulus(work *w, double modulus, wt_error *err)
{
    if (w->n_moduli == w->capacity) {
        size_t grown = w->capacity == 0 ? 256 : w->capacity * 2;
        accepted *moduli = realloc(w->moduli, grown * sizeof *moduli);
        if (moduli == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
        w->moduli = moduli;
        w->capacity = grown;
    }
    w->moduli[w->n_moduli++] = (accepted){modulus, wt_table_n_rows(w->table) - 1};
    return WT_OK;
}

/* Local exponent p of F ~ delta^p at the deepest point, for the equivalent frequency. */
static double equivalent_frequency(const wt_tip *tip, const wt_indent_fit *fit)
{
    double g = (double)NAN, slope = (double)NAN;
    if (!(fit->load_time > 0) || !(fit->max_indentation > 0))
        return (double)NAN;
    wt_contact_function(tip, fit->max_indentation, &g, &slope);
    return wt_equivalent_frequency(fit->load_time, fit->max_indentation * slope / g);
}

static wt_status write_item(work *w, item *it, wt_error *err)
{
    char spot[64];
    wt_status status = WT_OK;
    if (it->status != WT_OK) {
        if (!flow_goes_on(w->common, it->status)) {
            wt_error_file(&it->error, w->file->name);
            if (err != NULL)
                *err = it->error;
            return it->status;
        }
        it->fit = unreadable(&it->error);
        status = note_failure(w, it->curve.index, &it->error, err);
    }
    if (w->spot == NULL) {
        if (it->curve.grid_x >= 0 && it->curve.grid_y >= 0)
            snprintf(spot, sizeof spot, "%ld,%ld", it->curve.grid_x, it->curve.grid_y);
        else
            snprintf(spot, sizeof spot, "curve %zu", it->curve.index);
    }
    flow_indentation row = {
        .curve = it->curve.index,
        .x = it->curve.x,
        .y = it->curve.y,
        .file = w->file->name,
        .spot = w->spot != NULL ? w->spot : spot,
        .equivalent_frequency = equivalent_frequency(&w->job->tip, &it->fit),
        .fit = it->fit,
    };
    if (!w->job->rates) {
        row.fit.piezo_rate = row.fit.indentation_rate = row.fit.load_time = (double)NAN;
        row.equivalent_frequency = (double)NAN;
    }
    if (status == WT_OK)
        status = flow_indentation_add(w->table, &row, err);
    if (status != WT_OK)
        return status;
    w->n_curves++;
    if (it->fit.verdict != WT_CURVE_ACCEPTED)
        return WT_OK;
    w->n_accepted++;
    w->k_low = fmin(w->k_low, it->curve.cantilever.spring_constant);
    w->k_high = fmax(w->k_high, it->curve.cantilever.spring_constant);
    return keep_modulus(w, it->fit.modulus.value, err);
}

static wt_status run_batch(work *w, wt_error *err)
{
    wt_status status =
        wt_parallel_for(w->n_items, w->common->threads, fit_item, w, NULL, "fitting curves");
    if (status != WT_OK)
        return wt_fail(err, status, "fitting in parallel failed");
    for (size_t i = 0; status == WT_OK && i < w->n_items; i++)
        status = write_item(w, &w->items[i], err);
    w->n_items = 0;
    const wt_progress *progress = &w->common->progress;
    if (status == WT_OK && progress->report != NULL &&
        !progress->report(progress->user, "indentation", w->n_curves, 0))
        status = wt_fail(err, WT_E_CANCELLED, "cancelled");
    return status;
}

static size_t samples_of(const wt_force_curve *curve)
{
    size_t n = 0;
    for (size_t i = 0; i < curve->n_segments; i++)
        n += curve->segments[i].n_points * curve->segments[i].n_channels;
    return n;
}

/* ---- one file ---------------------------------------------------------------------------------
 */

static wt_status read_file(work *w, wt_error *err)
{
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    size_t samples = 0;
    wt_status status = flow_open(w->common, w->file, w->job->group, WT_KIND_FORCE, &input, err);
    wt_read_options options = w->file->read;
    options.want &= wanted_channels(w->job->rates);
    options.segments &= WT_SEGMENT_BIT(WT_SEGMENT_APPROACH);
    if (status == WT_OK)
        status = wt_force_open(w->common->formats, input, &options, w->common->log, &source, err);
    if (status != WT_OK)
        goto done;
    for (;;) {
        item *it = &w->items[w->n_items];
        it->error = (wt_error)WT_ERROR_INIT;
        it->status = wt_force_next(source, &it->curve, &it->error);
        if (it->status == WT_END)
            break;
        samples += it->status == WT_OK ? samples_of(&it->curve) : 0;
        w->n_items++;
        if (w->n_items == BATCH_CURVES || samples >= BATCH_SAMPLES) {
            status = run_batch(w, err);
            samples = 0;
            if (status != WT_OK)
                goto done;
        }
    }
    status = run_batch(w, err);
    if (status == WT_OK)
        status = flush_failures(w, err);
done:
    wt_force_close(source);
    wt_input_close(input);
    return status;
}

static wt_status read_files(work *w, const flow_files *files, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < files->n; i++) {
        wt_error failure = WT_ERROR_INIT;
        w->file = &files->file[i];
        w->spot = w->file->set->spot;
        if (w->spot == NULL && files->n > 1)
            w->spot = w->file->name;
        w->n_items = 0;
        status = read_file(w, &failure);
        if (status != WT_OK && flow_goes_on(w->common, status)) {
            w->n_failed++;
            status = flow_failed(w->common, w->file->name, &failure, err);
        } else if (status != WT_OK && err != NULL) {
            *err = failure;
            wt_error_file(err, w->file->name);
        }
    }
    return status;
}

/* ---- the representative curve -----------------------------------------------------------------
 */

static int by_modulus(const void *a, const void *b)
{
    const accepted *x = a, *y = b;
    if (x->modulus < y->modulus || x->modulus > y->modulus)
        return x->modulus < y->modulus ? -1 : 1;
    return x->row < y->row ? -1 : x->row > y->row;
}

/* Row of the curve with the (lower) median modulus; the first one of equal moduli. */
static size_t median_row(work *w)
{
    qsort(w->moduli, w->n_moduli, sizeof *w->moduli, by_modulus);
    return w->moduli[(w->n_moduli - 1) / 2].row;
}

/* Reads that one curve again, now with its retract segment. */
static wt_status add_representative(work *w, const flow_files *files, wt_indent_tables *tables,
                                    wt_error *err)
{
    size_t row = median_row(w);
    const char *name = flow_table_get_text(w->table, row, "file");
    size_t number = (size_t)flow_table_get(w->table, row, "curve");
    const flow_file *file = NULL;
    for (size_t i = 0; i < files->n && file == NULL; i++)
        if (strcmp(files->file[i].name, name) == 0)
            file = &files->file[i];
    if (file == NULL || strcmp(file->path, "-") == 0)
        return WT_OK; /* a pipe cannot be read twice */
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve *curve = &w->items[0].curve;
    wt_read_options options = file->read;
    options.want &= wanted_channels(false);
    options.segments &= WT_SEGMENT_BIT(WT_SEGMENT_APPROACH) | WT_SEGMENT_BIT(WT_SEGMENT_RETRACT);
    wt_status status = wt_input_open(file->path, &input, err);
    if (status == WT_OK)
        status = wt_force_open(w->common->formats, input, &options, NULL, &source, err);
    while (status == WT_OK) {
        wt_error ignored = WT_ERROR_INIT;
        wt_status next = wt_force_next(source, curve, &ignored);
        if (next == WT_END)
            break;
        if (next == WT_E_MEMORY)
            status = wt_fail(err, next, "no memory for the representative curve");
        if (next != WT_OK || curve->index != number)
            continue;
        wt_indent_fit fit;
        status =
            wt_indent_force_curve(w->contact, &w->job->options, curve, w->scratch[0], &fit, err);
        if (status == WT_OK)
            status = flow_curve_tables_add(tables, w->job->group, file->name, curve, &fit,
                                           w->contact, w->job->options.poisson_ratio, err);
        break;
    }
    wt_force_close(source);
    wt_input_close(input);
    return status;
}

/* ---- the group --------------------------------------------------------------------------------
 */

static wt_status set_keys(const work *w, const flow_files *files, wt_error *err)
{
    const wt_indent_job *job = w->job;
    char text[256];
    size_t named = 0;
    for (size_t i = 0; i < files->n; i++)
        named += files->file[i].set->spot != NULL;
    const char *spots = "mixed: some named, the others one for each file";
    if (named == files->n)
        spots = "named";
    else if (named == 0)
        spots = files->n > 1 ? "file: each file is a spot, none were named"
                             : "position: each curve is a spot, none were named";
    wt_tip_describe(&job->tip, text, sizeof text);
    wt_status status = wt_table_set_key(w->table, "tip", text, err);
    if (status == WT_OK)
        status = flow_table_key(w->table, err, "poisson_ratio", "%g", job->options.poisson_ratio);
    /* that of the user; else that of the files, whose error they do not say */
    wt_estimate k = job->spring_constant;
    if (isnan(k.value) && w->k_low >= w->k_high)
        k = (wt_estimate){w->k_low, (double)NAN, 0, "N/m"};
    if (status == WT_OK && !isnan(k.value))
        status = wt_table_set_estimate(w->table, "spring_constant", k, err);
    if (status == WT_OK && w->k_low < w->k_high)
        status = flow_table_key(w->table, err, "spring_constants", "%.4g to %.4g N/m", w->k_low,
                                w->k_high);
    if (status == WT_OK)
        status = wt_table_set_key(w->table, "spots", spots, err);
    if (status == WT_OK)
        status = flow_table_key(w->table, err, "n_accepted", "%zu", w->n_accepted);
    if (status == WT_OK)
        status = flow_table_key(w->table, err, "n_rejected", "%zu", w->n_curves - w->n_accepted);
    return status;
}

static wt_status prepare(work *w, wt_error *err)
{
    wt_status status = param_check(wt_indent_job_params(), w->job, err);
    if (status == WT_OK)
        status = param_check(wt_job_params(), w->common, err);
    if (status == WT_OK)
        status = wt_contact_table_new(&w->job->tip, DEPTH_MIN, DEPTH_MAX, &w->contact, err);
    if (status == WT_OK)
        status = flow_indentation_table(w->job->group, &w->table, err);
    if (status != WT_OK)
        return status;
    w->n_workers = wt_thread_count(w->common->threads);
    if (w->n_workers > BATCH_CURVES)
        w->n_workers = BATCH_CURVES;
    w->scratch = calloc(w->n_workers, sizeof(wt_indent_workspace *));
    w->items = calloc(BATCH_CURVES, sizeof *w->items);
    if (w->scratch == NULL || w->items == NULL)
        return wt_fail(err, WT_E_MEMORY, "out of memory");
    for (unsigned i = 0; i < w->n_workers; i++)
        if ((w->scratch[i] = wt_indent_workspace_new()) == NULL)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
    return WT_OK;
}

static void release(work *w)
{
    for (unsigned i = 0; w->scratch != NULL && i < w->n_workers; i++)
        wt_indent_workspace_free(w->scratch[i]);
    for (size_t i = 0; w->items != NULL && i < BATCH_CURVES; i++)
        wt_force_curve_clear(&w->items[i].curve);
    free(w->scratch);
    free(w->items);
    free(w->moduli);
    wt_contact_table_free(w->contact);
    wt_table_free(w->table);
}

wt_status wt_indent_group(const wt_indent_job *job, const wt_job *common, wt_indent_tables *tables,
                          wt_error *err)
{
    if (job == NULL || common == NULL || tables == NULL || job->group == NULL)
        return wt_fail(err, WT_E_ARG, "no indentation job");
    if (tables->indentation != NULL)
        return wt_fail(err, WT_E_ARG, "the indentation table of the group before is still there");
    work w = {.job = job, .common = common, .k_low = (double)NAN, .k_high = (double)NAN};
    flow_files files = {NULL, 0};
    wt_status status = flow_files_list(job->sets, job->n_sets, common, &files, err);
    if (status == WT_OK)
        status = prepare(&w, err);
    if (status == WT_OK)
        status = read_files(&w, &files, err);
    if (status != WT_OK)
        goto done;
    if (w.n_curves == 0) {
        status = wt_fail(err, WT_E_EMPTY, "no force curve could be read for \"%s\"", job->group);
        wt_error_found(err, "files: %zu, failed: %zu", files.n, w.n_failed);
        wt_error_advice(err, "`weartrack info FILE` shows what a file holds");
        goto done;
    }
    status = set_keys(&w, &files, err);
    if (status == WT_OK && job->curves && w.n_moduli > 0)
        status = add_representative(&w, &files, tables, err);
    if (status != WT_OK)
        goto done;
    tables->indentation = w.table;
    w.table = NULL;
    tables->n_files = files.n;
    tables->n_curves = w.n_curves;
    tables->n_accepted = w.n_accepted;
    tables->n_failed = w.n_failed;
done:
    release(&w);
    flow_files_clear(&files);
    return status;
}
