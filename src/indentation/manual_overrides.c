/* Manual overrides: reads their table, assigns them to files and curves, and writes the applied
 * overrides. The written table is valid input.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "indentation/manual_overrides.h"

#include "core/base/array.h"
#include "core/base/param.h"
#include "core/base/text.h"
#include "core/table/table_rows.h"
#include "indentation/indent.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

TABLE_ROW(overrides, OVERRIDES, const char *group, *file; double curve;
          const char *choice, *value, *note; size_t applied;)

static choice_values empty_choice_values(void)
{
    const double none = (double)NAN;
    return (choice_values){none, none, none, none, none, {0}};
}

/* Names and limits of the overrides that have a value. */
static const wt_param rows[] = {
    {PARAM("contact-point", choice_values, contact_point, WT_Q_LENGTH, ANY_NUMBER), .unset = ""},
    {PARAM("baseline-from", choice_values, baseline_from, WT_Q_LENGTH, ANY_NUMBER), .unset = ""},
    {PARAM("baseline-to", choice_values, baseline_to, WT_Q_LENGTH, ANY_NUMBER), .unset = ""},
    {PARAM("spring-constant", choice_values, spring_constant, WT_Q_SPRING_CONSTANT, ABOVE(0)),
     .unset = ""},
    {PARAM("sensitivity", choice_values, sensitivity, WT_Q_SENSITIVITY, ABOVE(0)), .unset = ""},
    {PARAM_OTHER_OF("tip", choice_values, tip, indent_read_tip), .check = indent_check_tip},
};
PARAM_LOCAL_TABLE(value_params, choice_values, rows, empty_choice_values, NO_PARTS)

static const struct {
    const char *id;
    bool for_curve, for_file; /* valid targets */
} kinds[CHOICE_KINDS] = {[CHOICE_EXCLUDE] = {"exclude", true, true},
                         [CHOICE_CONTACT_POINT] = {"contact-point", true, false},
                         [CHOICE_BASELINE_FROM] = {"baseline-from", true, false},
                         [CHOICE_BASELINE_TO] = {"baseline-to", true, false},
                         [CHOICE_SPRING_CONSTANT] = {"spring-constant", false, true},
                         [CHOICE_SENSITIVITY] = {"sensitivity", false, true},
                         [CHOICE_TIP] = {"tip", false, true}};

/* Adds the file and the row of the override to an error. */
static wt_status locate_choice_error(const manual_overrides *choices, const manual_override *c,
                                     wt_error *err)
{
    wt_error_file(err, choices->path);
    if (isnan(c->curve))
        wt_error_place(err, "row %zu, %s of %s", c->row + 1, kinds[c->kind].id, c->file);
    else
        wt_error_place(err, "row %zu, %s of %s curve %.0f", c->row + 1, kinds[c->kind].id, c->file,
                       c->curve);
    return err != NULL ? err->status : WT_E_ARG;
}

/* ---- reading --------------------------------------------------------------------------------- */

static wt_status check_choice_target(const manual_override *c, wt_error *err)
{
    if (isnan(c->curve) ? !kinds[c->kind].for_file : !kinds[c->kind].for_curve) {
        const wt_status status =
            wt_fail(err, WT_E_ARG, "%s is chosen for %s", kinds[c->kind].id,
                    kinds[c->kind].for_file ? "a file, not for one curve" : "one curve");
        wt_error_advice(err, "%s in the column curve",
                        kinds[c->kind].for_file ? "write nan" : "write the number of the curve");
        return status;
    }
    if (!isnan(c->curve) && !(c->curve >= 0 && c->curve < 0x1p53 && floor(c->curve) == c->curve)) {
        const wt_status status = wt_fail(err, WT_E_RANGE, "that is no number of a curve");
        wt_error_expected(err, "0, 1, 2, ..., or nan for all of the file");
        wt_error_found(err, "%g", c->curve);
        return status;
    }
    return WT_OK;
}

static wt_status read_choice_value(manual_override *c, const wt_indent_job *job, const wt_job *work,
                                   wt_error *err)
{
    uint64_t given = 0;
    c->values = empty_choice_values();
    c->values.tip = job->tip; /* the thickness and the bond of the sample do not change */
    if (c->kind == CHOICE_EXCLUDE)
        return c->value[0] == '\0'
                   ? WT_OK
                   : wt_fail(err, WT_E_ARG, "exclude has no value, but \"%s\"; a reason is a note",
                             c->value);
    wt_status status =
        wt_params_set(value_params(), kinds[c->kind].id, &c->values, c->value, &given, err);
    if (status != WT_OK || c->kind != CHOICE_TIP)
        return status;
    const bool has_error = c->values.tip.radius_error > 0 || c->values.tip.half_angle_error > 0;
    if (has_error)
        wt_log_add(work->log, WT_WARNING, c->file, NULL,
                   "errors of a tip that is chosen for a file are not in those of its moduli");
    c->values.tip.radius_error = c->values.tip.half_angle_error = 0;
    return indent_contact_table(&c->values.tip, &c->contact, err);
}

static wt_status read_choice_row(const table_view *view, size_t row, const wt_indent_job *job,
                                 const wt_job *work, manual_overrides *to, wt_error *err)
{
    const char *id = overrides_text(view, row, OVERRIDES_CHOICE);
    to->choice = array_grow(to->choice, to->n, sizeof *to->choice);
    manual_override *c = &to->choice[to->n++];
    *c = (manual_override){.kind = CHOICE_EXCLUDE,
                           .row = row,
                           .file = overrides_text(view, row, OVERRIDES_FILE),
                           .value = overrides_text(view, row, OVERRIDES_VALUE),
                           .note = overrides_text(view, row, OVERRIDES_NOTE),
                           .curve = overrides_get(view, row, OVERRIDES_CURVE)};
    while (c->kind < CHOICE_KINDS && strcmp(kinds[c->kind].id, id) != 0)
        c->kind++;
    if (c->kind == CHOICE_KINDS) {
        const wt_status status = wt_fail(err, WT_E_ARG, "no choice is called \"%s\"", id);
        wt_error_file(err, to->path);
        wt_error_place(err, "row %zu", row + 1);
        wt_error_expected(err, "exclude, contact-point, baseline-from, baseline-to, "
                               "spring-constant, sensitivity or tip");
        return status;
    }
    wt_status status = check_choice_target(c, err);
    if (status == WT_OK)
        status = read_choice_value(c, job, work, err);
    for (size_t i = 0; status == WT_OK && i + 1 < to->n; i++) {
        const manual_override *before = &to->choice[i];
        const bool same_curve =
            before->curve == c->curve || (isnan(before->curve) && isnan(c->curve));
        if (before->kind == c->kind && same_curve && strcmp(before->file, c->file) == 0)
            status =
                wt_fail(err, WT_E_ARG, "chosen twice, the first time in row %zu", before->row + 1);
    }
    return status == WT_OK ? WT_OK : locate_choice_error(to, c, err);
}

/* True if the file is an input already. Each group of a case reads it, but it is one input. */
static bool is_recorded(const wt_job *work, const char *path)
{
    for (size_t i = 0; work->provenance != NULL && i < wt_provenance_n_inputs(work->provenance);
         i++)
        if (strcmp(wt_provenance_get_input(work->provenance, i)->path, path) == 0)
            return true;
    return false;
}

wt_status manual_overrides_read(const wt_indent_job *job, const wt_job *work,
                                manual_overrides *choices, wt_error *err)
{
    static const wt_tables_role role = {.role = WT_ROLE_OVERRIDES,
                                        .instead = "a table of choices, as weartrack view writes "
                                                   "it: weartrack-indent(1)"};
    *choices = (manual_overrides){.path = job->choices, .group = job->group};
    if (job->choices == NULL)
        return WT_OK;
    table_view view;
    wt_status status =
        wt_tables_read(job->choices, job->choices, is_recorded(work, job->choices) ? NULL : work,
                       role, &choices->tables, err);
    if (status != WT_OK)
        return status;
    /* a table by hand need not say its name */
    const wt_table *table = wt_result_find(choices->tables, overrides_schema.name);
    status = table_bind(table != NULL ? table : wt_result_table(choices->tables, 0),
                        &overrides_schema, "", &view, err);
    if (status != WT_OK)
        wt_error_file(err, job->choices);
    for (size_t row = 0; status == WT_OK && row < view.n_rows; row++) {
        const char *group = overrides_text(&view, row, OVERRIDES_GROUP);
        if (group[0] == '\0' || strcmp(group, job->group) == 0)
            status = read_choice_row(&view, row, job, work, choices, err);
    }
    if (status == WT_OK && choices->n == 0 && view.n_rows > 0)
        wt_log_add(work->log, WT_WARNING, job->choices, NULL, "no choice is for the group \"%s\"",
                   job->group);
    return status;
}

/* Finds the file of an override. An exact name takes precedence over paths with the same end. */
static wt_status find_choice_file(const manual_overrides *choices, manual_override *c,
                                  const flow_files *files, wt_error *err)
{
    flow_name_match best = FLOW_NAME_DIFFERENT;
    const flow_file *other = NULL;
    for (size_t k = 0; k < files->n; k++) {
        const flow_name_match as = flow_file_match(&files->file[k], c->file, strlen(c->file));
        if (as == FLOW_NAME_DIFFERENT || as < best)
            continue;
        other = as == best ? c->of : NULL;
        c->of = &files->file[k];
        best = as;
    }
    if (c->of == NULL) {
        (void)wt_fail(err, WT_E_NOT_FOUND, "no file of the group \"%s\" is called so",
                      choices->group);
        wt_error_advice(err, "correct the column file, delete the row, or name another group in "
                             "the column group");
        return locate_choice_error(choices, c, err);
    }
    if (other == NULL)
        return WT_OK;
    (void)wt_fail(err, WT_E_ARG, "two files are called so");
    wt_error_found(err, "%s and %s", other->name, c->of->name);
    wt_error_advice(err, "write more of the path in the column file");
    return locate_choice_error(choices, c, err);
}

wt_status manual_overrides_bind(manual_overrides *choices, const flow_files *files, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < choices->n; i++)
        status = find_choice_file(choices, &choices->choice[i], files, err);
    return status;
}

/* ---- applying -------------------------------------------------------------------------------- */

void manual_overrides_apply_file(const manual_overrides *choices, const flow_file *file,
                                 wt_read_options *read, const wt_contact_table **contact,
                                 const wt_tip **tip)
{
    for (size_t i = 0; i < choices->n; i++) {
        const manual_override *c = &choices->choice[i];
        if (c->of != file)
            continue;
        if (c->kind == CHOICE_SPRING_CONSTANT)
            read->spring_constant = c->values.spring_constant;
        if (c->kind == CHOICE_SENSITIVITY)
            read->sensitivity = c->values.sensitivity;
        if (c->kind != CHOICE_TIP)
            continue;
        *contact = c->contact;
        *tip = &c->values.tip;
    }
}

curve_choice manual_overrides_curve_choice(manual_overrides *choices, const flow_file *file,
                                           size_t curve)
{
    curve_choice of = {(double)NAN, (double)NAN, (double)NAN, NULL};
    for (size_t i = 0; i < choices->n; i++) {
        manual_override *c = &choices->choice[i];
        if (c->of != file || (!isnan(c->curve) && (size_t)c->curve != curve))
            continue;
        c->n_curves++;
        if (c->kind == CHOICE_CONTACT_POINT)
            of.contact_point = c->values.contact_point;
        if (c->kind == CHOICE_BASELINE_FROM)
            of.baseline_from = c->values.baseline_from;
        if (c->kind == CHOICE_BASELINE_TO)
            of.baseline_to = c->values.baseline_to;
        if (c->kind == CHOICE_EXCLUDE && (of.exclude == NULL || !isnan(c->curve)))
            of.exclude = c;
    }
    return of;
}

void manual_overrides_apply_fit(const curve_choice *choice, wt_indent_fit *fit)
{
    enum { NOTE = 60 }; /* characters of the note, so that the verdict of the fit has space */
    char fit_text[2 * sizeof fit->reason], text[4 * sizeof fit->reason];
    const char *verdict = wt_curve_verdict_id(fit->verdict);
    const bool contact = !isnan(choice->contact_point),
               baseline = !isnan(choice->baseline_from) || !isnan(choice->baseline_to),
               by_hand = contact || baseline;
    snprintf(fit_text, sizeof fit_text, "%s%s%s%s%s%s", contact ? "contact point" : "",
             contact && baseline ? " and " : "", baseline ? "baseline" : "",
             by_hand ? " by hand" : "", by_hand && fit->reason[0] != '\0' ? "; " : "", fit->reason);
    if (choice->exclude == NULL) {
        utf8_copy(fit->reason, sizeof fit->reason, fit_text);
        return;
    }
    const char *note = choice->exclude->note;
    /* The reason of an accepted fit begins with its verdict. */
    const bool has_verdict_prefix = fit->verdict == WT_CURVE_ACCEPTED && !by_hand;
    snprintf(text, sizeof text, "left out by hand%s%.*s; the fit: %s%s%s",
             note[0] != '\0' ? ": " : "", (int)utf8_truncated_length(note, strlen(note), NOTE),
             note, has_verdict_prefix ? "" : verdict,
             has_verdict_prefix || fit_text[0] == '\0' ? "" : ", ", fit_text);
    utf8_copy(fit->reason, sizeof fit->reason, text);
    fit->verdict = WT_CURVE_EXCLUDED;
}

/* ---- the table ------------------------------------------------------------------------------- */

/* Reports the applied overrides to the reader of the result. */
static void report_choices(const manual_overrides *choices, const wt_job *work)
{
    size_t n_curves[CHOICE_KINDS] = {0}, used = 0;
    char text[256] = "";
    for (size_t i = 0; i < choices->n; i++)
        n_curves[choices->choice[i].kind] += choices->choice[i].n_curves;
    for (int k = 0; k < CHOICE_KINDS; k++)
        if (n_curves[k] > 0)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%s of %zu",
                                     used > 0 ? ", " : "", kinds[k].id, n_curves[k]);
    wt_log_add(work->log, WT_NOTE, choices->path, NULL,
               "%s: chosen by hand, in curves: %s (table choices)", choices->group, text);
}

wt_status manual_overrides_table(const manual_overrides *choices, const wt_job *work,
                                 wt_table **table, wt_error *err)
{
    if (choices->n == 0)
        return WT_OK;
    report_choices(choices, work);
    table_writer t = {0};
    if (*table == NULL) {
        t = table_begin(&overrides_schema, err);
        if (table_end(&t, table) != WT_OK)
            return t.status;
    }
    t = table_continue(*table, &overrides_schema, choices->group, err);
    for (size_t i = 0; i < choices->n; i++) {
        const manual_override *c = &choices->choice[i];
        if (c->n_curves == 0) {
            (void)wt_fail(err, WT_E_NOT_FOUND,
                          isnan(c->curve) ? "no curve of the file could be read"
                                          : "the file has no such curve");
            return locate_choice_error(choices, c, err);
        }
        TABLE_ADD(overrides, &t, choices->group, c->file, c->curve, kinds[c->kind].id, c->value,
                  c->note, c->n_curves);
    }
    return table_end(&t, NULL);
}

void manual_overrides_clear(manual_overrides *choices)
{
    for (size_t i = 0; i < choices->n; i++)
        wt_contact_table_free(choices->choice[i].contact);
    free(choices->choice);
    wt_result_free(choices->tables);
    *choices = (manual_overrides){0};
}
