/* Public access to the rows of a result. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/result_row.h"

#include "core/base/memory.h"
#include "weartrack/case.h"

#include <stdlib.h>

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
        .unit = n->unit,
        .text = row->kind == RESULT_ROW_TEXT ? row->text : texts->value,
        .interval = texts->interval,
        .range = texts->range,
        .note = row->note,
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
