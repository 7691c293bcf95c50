/* Collects the rows of a result. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/result_row.h"

#include "core/base/text.h"
#include "core/table/finding.h"
#include "core/table/result_rows_parts.h"

#include <math.h>
#include <stdlib.h>

static void add_subjects(const wt_result *result, int from, int to, result_rows *rows)
{
    static void (*const add[RESULT_SUBJECTS])(rows_source *) = {
        [SUBJECT_RECORDS] = rows_of_records, [SUBJECT_ERRORS] = rows_of_errors,
        [SUBJECT_CURVES] = rows_of_curves,   [SUBJECT_MATERIAL] = rows_of_material,
        [SUBJECT_SURFACE] = rows_of_surface, [SUBJECT_FRICTION] = rows_of_friction,
        [SUBJECT_LAYER] = rows_of_layer,     [SUBJECT_COLLECTION] = rows_of_collection};
    rows_source s = {.result = result, .rows = rows};
    *rows = (result_rows){.n = 0};
    if (result_values_bind(result, &s.values, NULL) != WT_OK) {
        /* A table without a required column adds no row; the other tables do. */
    }
    for (int i = from; i < to; i++)
        add[i](&s);
}

void result_rows_compute(const wt_result *result, result_rows *rows)
{
    add_subjects(result, 0, RESULT_SUBJECTS, rows);
}

void result_rows_of_subject(const wt_result *result, result_subject subject, result_rows *rows)
{
    add_subjects(result, (int)subject, (int)subject + 1, rows);
}

/* Row of the number behind a finding. */
static void add_finding_number(rows_source *s, const finding *f)
{
    static const char *const names[FINDING_QUESTIONS] = {[FINDING_TRACK_DIFFERS] = "track / bulk",
                                                         [FINDING_LAYER_THICKNESS] = "at balance",
                                                         [FINDING_FRICTION_CHANGE] = "change"};
    if (isnan(f->value.number.value))
        return;
    result_row *row = rows_add_value(s, 1, &f->value, names[f->question]);
    if (!isnan(f->value.velocity))
        clocale_append(row->name, sizeof row->name, ", %s",
                       rows_short(f->value.velocity, "m/s").value);
}

bool result_rows_of_findings(const wt_result *result, result_rows *rows)
{
    finding *const findings = rows->findings;
    rows_source s = {.result = result, .rows = rows};
    *rows = (result_rows){.n = 0};
    if (result_values_bind(result, &s.values, NULL) != WT_OK) {
        /* A table without a required column adds nothing. */
    }
    table_view answer;
    /* a run states why a number is missing */
    const bool stated = rows_bind(&s, &answer_schema, &answer) && findings_are_stated(&answer);
    if (!findings_compute(&s.values, findings) && !stated)
        return false;
    const result_value friction = result_value_friction(&s.values, FRICTION_KEY_HYSTERESIS);
    rows_condition(&s, friction.velocity, "m/s");
    rows_condition(&s, friction.pressure, "Pa");
    for (size_t i = 0; i < FINDING_QUESTIONS; i++) {
        const finding *f = &findings[i];
        result_row *row = rows_add_text(&s, 0, finding_verdict_text(f->verdict), "%s",
                                        finding_question_text(f->question));
        clocale_append(row->text, sizeof row->text, "%s", finding_side_text(f));
        const char *reason = stated ? answer_text(&answer, i, ANSWER_ANSWER) : f->sentence;
        row->missing = f->verdict == FINDING_NOT_COMPUTED || f->verdict == FINDING_NOT_ENOUGH_DATA;
        if (f->as_if_layer && !row->missing)
            rows_note(row, "as if there were a layer");
        rows_reason(row, finding_basis_text(f->basis), reason);
        rows_reason(row, "to settle it", f->remedy);
        add_finding_number(&s, f);
    }
    rows_of_records(&s);
    return true;
}

void result_rows_clear(result_rows *rows)
{
    free(rows->rows);
    *rows = (result_rows){.n = 0};
}
