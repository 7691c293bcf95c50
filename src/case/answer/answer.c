/* Writes the table of the answers of a run: its findings, and why one is missing. Public access to
 * the rows of a result.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/answer.h"
#include "core/base/array.h"
#include "core/base/text.h"
#include "core/table/finding.h"
#include "core/table/result_row.h"
#include "core/table/table_rows.h"
#include "weartrack/case.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

TABLE_ROW(answer, ANSWER, const char *question, *verdict, *basis;
          double value, low, high, range_low, range_high;
          const char *unit, *widest, *answer, *remedy;)

/* Returns the stage that keeps `stage` from running. It is the first failed stage among those whose
 * outputs `stage` needs; blocked stages are followed to their own cause. */
static flow_stage_id find_failed_stage(const flow_plan *plan, flow_stage_id stage, unsigned level)
{
    const flow_resource_set takes =
        flow_plan_needs(plan, stage, level) | flow_stages[stage].alternatives;
    for (size_t i = 0; i < FLOW_N_STAGES && i < (size_t)stage; i++) {
        if ((flow_stages[i].outputs & takes) == 0)
            continue;
        if (plan->outcome[i] == FLOW_FAILED)
            return (flow_stage_id)i;
        if (plan->outcome[i] == FLOW_BLOCKED)
            return find_failed_stage(plan, (flow_stage_id)i, 0);
    }
    return stage;
}

typedef struct reason_text {
    char text[700];
} reason_text;

/* Explains an outcome of a stage without a result; "" for a stage that ran. */
static reason_text explain_outcome(const flow_plan *plan, flow_stage_id stage, flow_outcome outcome,
                                   const char *why_excluded)
{
    reason_text reason = {""};
    const flow_stage_id root =
        outcome == FLOW_BLOCKED ? find_failed_stage(plan, stage, plan->level[stage]) : stage;
    const char *const message = plan->failure[root][0] != '\0' ? plan->failure[root] : "no message";
    if (outcome == FLOW_FAILED)
        clocale_print(reason.text, sizeof reason.text, "The stage failed: %s.", message);
    else if (outcome == FLOW_BLOCKED)
        clocale_print(reason.text, sizeof reason.text, "A stage that %s needs failed (%s): %s.",
                      flow_stages[stage].id, flow_stages[root].id, message);
    else if (outcome == FLOW_UNMEASURED)
        clocale_print(reason.text, sizeof reason.text, "Not measured: %s.",
                      plan->unmeasured_reason);
    else if (outcome == FLOW_EXCLUDED && why_excluded[0] != '\0')
        clocale_print(reason.text, sizeof reason.text, "The case does not request it: %s.",
                      why_excluded);
    return reason;
}

static const flow_stage_id stage_of_question[FINDING_QUESTIONS] = {
    [FINDING_TRACK_DIFFERS] = FLOW_STAGE_COMPARISON,
    [FINDING_LAYER_THICKNESS] = FLOW_STAGE_LAYER,
    [FINDING_FRICTION_CHANGE] = FLOW_STAGE_FRICTION};

/* True if the stage of a question was chosen and has no result. */
static bool has_failed_question(const flow_plan *plan)
{
    for (size_t i = 0; i < FINDING_QUESTIONS; i++) {
        const flow_outcome outcome = plan->outcome[stage_of_question[i]];
        if (outcome != FLOW_DONE && outcome != FLOW_EXCLUDED)
            return true;
    }
    return false;
}

static void add_finding(table_writer *t, const flow_plan *plan, const finding *f)
{
    const flow_stage_id stage = stage_of_question[f->question];
    const flow_outcome outcome = plan->outcome[stage];
    reason_text reason = {""};
    if (f->verdict == FINDING_NOT_COMPUTED && outcome != FLOW_DONE)
        reason = explain_outcome(plan, stage, outcome, plan->reason[stage]);
    else if (f->verdict == FINDING_NOT_COMPUTED && f->question == FINDING_FRICTION_CHANGE)
        /* friction without the layer is a lower level of its stage */
        reason = explain_outcome(plan, stage, plan->full_outcome[stage],
                                 plan->lower_level_reason[stage]);
    else if (f->verdict == FINDING_NOT_COMPUTED &&
             (flow_stages[stage].outputs & FLOW_TABLES & plan->required) == 0)
        clocale_print(reason.text, sizeof reason.text,
                      "This result does not include it. A run of the case computes it.");
    const result_value *const v = &f->value;
    TABLE_ADD(answer, t, finding_question_text(f->question), finding_verdict_text(f->verdict),
              finding_basis_text(f->basis), v->number.value, v->low, v->high, v->range.low,
              v->range.high, v->number.unit, v->range.widest,
              reason.text[0] != '\0' ? reason.text : f->sentence, f->remedy);
}

wt_status flow_answer(const wt_case *c, const flow_plan *plan, const wt_result *result,
                      const wt_table *failures, wt_table **table, wt_table **limits, wt_error *err)
{
    answer_context context = {.c = c};
    finding findings[FINDING_QUESTIONS];
    wt_status status = answer_context_bind(&context, result, err);
    if (status == WT_OK)
        status = table_bind(failures, &failures_schema, "", &context.failures, err);
    if (status != WT_OK)
        return status;
    table_writer t = table_begin(&answer_schema, err);
    if (findings_compute(&context.values, findings) || has_failed_question(plan))
        for (size_t i = 0; i < FINDING_QUESTIONS; i++)
            add_finding(&t, plan, &findings[i]);
    if (wt_case_title(c)[0] != '\0')
        answer_set_text(&t, ANSWER_KEY_CASE_TITLE, wt_case_title(c));
    if (c->sample[0] != '\0')
        answer_set_text(&t, ANSWER_KEY_CASE_SAMPLE, c->sample);
    if (c->condition[0] != '\0')
        answer_set_text(&t, ANSWER_KEY_CASE_CONDITION, c->condition);
    wt_table *made = NULL;
    status = table_end(&t, &made);
    if (status == WT_OK)
        status = limits_table(&context, limits, err);
    if (status == WT_OK)
        *table = made;
    else
        wt_table_free(made);
    return status;
}

struct wt_result_rows {
    result_rows list;
    row_number_text *texts; /* [list.n] */
};

wt_result_rows *wt_result_rows_new(const wt_result *result, bool findings)
{
    wt_result_rows *r = wt_alloc(1, sizeof *r);
    if (!findings || !result_rows_of_findings(result, &r->list))
        result_rows_compute(result, &r->list);
    r->texts = wt_alloc(r->list.n + 1, sizeof *r->texts);
    for (size_t i = 0; i < r->list.n; i++)
        r->texts[i] = row_number_format(&r->list.rows[i].number);
    return r;
}

void wt_result_rows_free(wt_result_rows *r)
{
    if (r == NULL)
        return;
    result_rows_clear(&r->list);
    free(r->texts);
    free(r);
}

size_t wt_result_rows_count(const wt_result_rows *r)
{
    return r->list.n;
}

wt_result_row wt_result_rows_get(const wt_result_rows *r, size_t i)
{
    const result_row *row = &r->list.rows[i];
    const row_number *n = &row->number;
    const row_number_text *texts = &r->texts[i];
    wt_result_row out = {
        .name = row->name,
        .level = row->level,
        .value = n->value,
        .low = n->low,
        .high = n->high,
        .range_low = n->range_low,
        .range_high = n->range_high,
        .unit = row_number_unit(n),
        .text = row->kind == RESULT_ROW_TEXT ? row->text : texts->value,
        .interval = texts->interval,
        .range = texts->range,
        .note = row->note,
        .missing = row->missing,
    };
    for (size_t k = 0; k < RESULT_ROW_REASONS; k++) {
        out.reasons[k].heading = row->reasons[k].heading;
        out.reasons[k].text = row->reasons[k].text;
    }
    return out;
}

const char *wt_result_rows_heading(const wt_result_rows *r)
{
    return r->list.heading;
}
