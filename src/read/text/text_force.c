/* Converts the tables of a text export to force curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/array.h"
#include "read/force_assembler.h"
#include "read/text/text.h"

#include <math.h>
#include <string.h>

/* Minimum return of a curve with a turning point, relative to its range. It exceeds the noise of
 * the last point. */
static const double least_return = 0.1;

/* The rows [first, end) of a table. */
typedef struct row_span {
    size_t table, first, end;
} row_span;

typedef struct text_source {
    wt_force_source base;
    wt_input *text; /* text converted from the input, or NULL */
    text_parts *parts;
    const text_file *file; /* current part */
    wt_error broken;       /* failure that ends the curves early */
    row_span next;         /* beginning of the next curve */
    row_span rows;         /* rows of the current segment */
    size_t index;
} text_source;

static double stated_value(const text_table *t, header_value value)
{
    return t->header.value[value];
}

static wt_status decode(wt_force_source *base, const force_signal *signal, force_linear scaling,
                        size_t n, double *values, wt_error *err)
{
    const text_source *s = (const text_source *)base;
    const text_table *t = &s->file->tables[s->rows.table];
    (void)err;
    for (size_t i = 0; i < n; i++)
        values[i] = scaling.multiplier * text_table_value(t, s->rows.first + i, signal->channel);
    return WT_OK;
}

/* Adds the requested columns of a segment kind, and the force, which is computed from the columns
 * of the table. */
static void add_signals(const text_source *s, const text_table *t, wt_segment_kind kind,
                        force_metadata *metadata)
{
    const wt_quantity_set bending =
        WT_Q_BIT(WT_Q_FORCE) | WT_Q_BIT(WT_Q_DEFLECTION) | WT_Q_BIT(WT_Q_DEFLECTION_VOLTAGE);
    const wt_quantity_set want = s->base.options.want;
    const wt_quantity_set use = (want & WT_Q_BIT(WT_Q_FORCE)) != 0 ? want | bending : want;
    force_add_offer(metadata, WT_Q_FORCE);
    for (size_t i = 0; i < t->n_columns; i++) {
        const text_column *c = &t->columns[i];
        const wt_quantity q = c->rule->quantity;
        if ((c->rule->has_segment && c->rule->segment != kind) || (use & WT_Q_BIT(q)) == 0)
            continue;
        force_add_signal(
            metadata,
            (force_signal){
                .quantity = q, .name = c->name, .unit = c->unit, .to_si = {1, 0}, .channel = c});
        force_add_offer(metadata, q);
    }
}

/* Drops rows at the end in which every channel is empty; they belong to the longer segment of a
 * column pair. */
static void drop_empty_rows(const text_table *t, const force_metadata *metadata, row_span *rows)
{
    for (; rows->end > rows->first; rows->end--)
        for (size_t i = 0; i < metadata->n_signals; i++)
            if (!isnan(text_table_value(t, rows->end - 1, metadata->signals[i].channel)))
                return;
}

/* Returns the duration of the header, else that of the time column, which ends one interval earlier
 * [s]. */
static double segment_duration(const text_table *t, wt_segment_kind kind, row_span rows)
{
    const double n = (double)(rows.end - rows.first);
    const text_column *time = text_table_column(t, WT_Q_TIME, (int)kind);
    const double stated = stated_value(t, HEADER_DURATION);
    if (!isnan(stated) || time == NULL || n < 2)
        return stated;
    return (text_table_value(t, rows.end - 1, time) - text_table_value(t, rows.first, time)) * n /
           (n - 1);
}

static wt_status add_segment(text_source *s, wt_force_curve *curve, wt_segment_kind kind,
                             row_span rows, wt_error *err)
{
    const text_table *t = &s->file->tables[rows.table];
    char place[40];
    snprintf(place, sizeof place, "table at line %zu", t->names_line);
    force_metadata metadata = {
        .kind = kind,
        .index = curve->n_segments,
        .place = place,
        .velocity = stated_value(t, HEADER_VELOCITY),
        .setpoint = stated_value(t, HEADER_SETPOINT),
        .setpoint_quantity = WT_Q_FORCE,
        .cantilever = {.spring_constant =
                           force_positive_or_nan(stated_value(t, HEADER_SPRING_CONSTANT)),
                       .sensitivity = force_positive_or_nan(stated_value(t, HEADER_SENSITIVITY))}};
    if (!force_is_segment_requested(&s->base, kind))
        return WT_OK;
    add_signals(s, t, kind, &metadata);
    drop_empty_rows(t, &metadata, &rows);
    metadata.n_points = rows.end - rows.first;
    metadata.duration = segment_duration(t, kind, rows);
    s->rows = rows;
    text_check_steps(s->file, t, (int)kind, rows.first, rows.end, s->base.log);
    return force_add_segment(&s->base, &metadata, curve, err);
}

/* Splits approach and retract at the row with the height farthest from its start. */
static wt_status add_turning_segments(text_source *s, wt_force_curve *curve, row_span rows,
                                      wt_error *err)
{
    const text_table *t = &s->file->tables[rows.table];
    const text_column *height = text_table_column(t, WT_Q_MEASURED_HEIGHT, -1);
    row_span approach = rows, retract = rows;
    double farthest = 0;
    if (height == NULL)
        height = text_table_column(t, WT_Q_HEIGHT, -1);
    /* rows without a height at either end have no distance */
    while (rows.first + 1 < rows.end && isnan(text_table_value(t, rows.first, height)))
        rows.first++;
    while (rows.end - 1 > rows.first && isnan(text_table_value(t, rows.end - 1, height)))
        rows.end--;
    const double start = text_table_value(t, rows.first, height);
    const double end = text_table_value(t, rows.end - 1, height);
    size_t turn = rows.end - 1;
    for (size_t r = rows.first; r < rows.end; r++) {
        const double distance = fabs(text_table_value(t, r, height) - start);
        if (distance > farthest) {
            farthest = distance;
            turn = r;
        }
    }
    const double back = fabs(end - text_table_value(t, turn, height));
    if (back > least_return * farthest)
        approach.end = retract.first = turn + 1;
    else
        retract.first = retract.end;
    wt_status status = add_segment(s, curve, WT_SEGMENT_APPROACH, approach, err);
    if (status == WT_OK && retract.first < retract.end)
        status = add_segment(s, curve, WT_SEGMENT_RETRACT, retract, err);
    return status;
}

/* Adds the segments of rows of one table and kind. */
static wt_status add_row_segments(text_source *s, wt_force_curve *curve, row_span rows,
                                  wt_error *err)
{
    const text_table *t = &s->file->tables[rows.table];
    wt_status status = WT_OK;
    bool pairs = false;
    for (int kind = WT_SEGMENT_APPROACH; kind <= WT_SEGMENT_OTHER && status == WT_OK; kind++) {
        bool has = false;
        for (size_t i = 0; i < t->n_columns; i++)
            has |= t->columns[i].rule->has_segment && (int)t->columns[i].rule->segment == kind;
        pairs |= has;
        if (has)
            status = add_segment(s, curve, (wt_segment_kind)kind, rows, err);
    }
    if (pairs || status != WT_OK)
        return status;
    if (t->kinds[rows.first] != ROW_KIND_NONE)
        return add_segment(s, curve, (wt_segment_kind)t->kinds[rows.first], rows, err);
    if (s->file->description->turning_point)
        return add_turning_segments(s, curve, rows, err);
    return add_segment(s, curve, WT_SEGMENT_APPROACH, rows, err);
}

/* Reads the part with the next curve. The file was read to its end when it was opened. If it now
 * ends differently, it has changed, and all further curves fail. */
static wt_status advance_part(text_source *s, wt_error *err)
{
    const bool left = s->index < s->base.n_curves;
    wt_status status = s->broken.status;
    while (status == WT_OK && s->next.table >= s->file->n_tables) {
        s->next = (row_span){.table = 0};
        status = left ? text_parts_next(s->parts, &s->broken) : WT_END;
    }
    if (status == WT_END && left && s->base.n_curves != SIZE_MAX) {
        status = wt_fail(&s->broken, WT_E_IO, "has been changed while it was read");
        wt_error_file(&s->broken, s->base.name);
    }
    if (status != WT_OK && status != WT_END && err != NULL)
        *err = s->broken;
    return left || status == WT_OK ? status : WT_END;
}

/* Reads the next curve, which is the block of rows with one block number. */
static wt_status text_force_next(wt_force_source *source, wt_force_curve *curve, wt_error *err)
{
    text_source *s = (text_source *)source;
    const text_file *file = s->file;
    wt_status status = advance_part(s, err);
    if (status == WT_END)
        return status;
    curve->index = s->index++;
    if (status != WT_OK)
        return status;
    const text_table *t = &file->tables[s->next.table];
    const size_t block = t->blocks[s->next.first];
    curve->x = stated_value(t, HEADER_POSITION_X);
    curve->y = stated_value(t, HEADER_POSITION_Y);
    while (s->next.table < file->n_tables) {
        t = &file->tables[s->next.table];
        row_span rows = s->next;
        if (t->blocks[rows.first] != block)
            break;
        for (rows.end = rows.first + 1; rows.end < t->n_rows; rows.end++)
            if (t->blocks[rows.end] != block || t->kinds[rows.end] != t->kinds[rows.first])
                break;
        if (status == WT_OK)
            status = text_table_require(t, WT_KIND_FORCE, err);
        if (status == WT_OK)
            status = add_row_segments(s, curve, rows, err);
        s->next.first = rows.end;
        if (rows.end == t->n_rows)
            s->next = (row_span){.table = s->next.table + 1};
    }
    return status;
}

static void text_force_close(wt_force_source *source)
{
    text_source *s = (text_source *)source;
    text_parts_free(s->parts);
    wt_input_close(s->text);
}

size_t text_count_curves(const text_file *file, unsigned kinds)
{
    size_t n = 0, block = 0;
    for (size_t i = 0; i < file->n_tables; i++) {
        const text_table *t = &file->tables[i];
        const bool has = kinds == 0 || quantities_suffice(t->quantities, kinds);
        for (size_t r = 0; has && r < t->n_rows; r++) {
            n += n == 0 || t->blocks[r] != block;
            block = t->blocks[r];
        }
    }
    return n;
}

static wt_status begin_text_parts(text_source *s, const file_reader *self, wt_input *text,
                                  size_t piece, wt_log *log, wt_error *err)
{
    text_parts_free(s->parts);
    s->parts = NULL;
    const wt_status status =
        text_parts_begin(self, text, piece, WT_KIND_FORCE, &s->base.options, log, &s->parts, err);
    if (status == WT_OK)
        s->file = text_parts_file(s->parts);
    return status;
}

/* Reads all parts, so that a defect of the file is reported before its first curve. */
static wt_status scan_all_parts(text_source *s, wt_error *err)
{
    wt_status status = WT_OK;
    while ((status = text_parts_next(s->parts, err)) == WT_OK) {
        s->base.n_curves += text_count_curves(s->file, 0);
        text_log_assumed(s->file, s->base.log);
    }
    if (status != WT_END)
        return status;
    if (s->file->n_seen == 0)
        return text_fail_empty(s->file, "force curve", err);
    text_log_unknown(s->file, s->base.log);
    return WT_OK;
}

static wt_status text_force_open(wt_force_source *source, const file_reader *self, wt_input *input,
                                 wt_error *err)
{
    text_source *s = (text_source *)source;
    size_t piece = 0;
    wt_status status =
        self->as_text != NULL ? self->as_text(self, input, source->log, &s->text, err) : WT_OK;
    wt_input *const text = s->text != NULL ? s->text : input;
    if (status == WT_OK)
        status = text_choose_piece(self->description, text, &piece, err);
    if (status == WT_OK)
        status = begin_text_parts(s, self, text, piece, source->log, err);
    if (status == WT_OK)
        status = scan_all_parts(s, err);
    /* if some tables are no longer in memory, they are read again without messages */
    if (status == WT_OK && s->file->n_tables < s->file->n_seen)
        status = begin_text_parts(s, self, text, piece, NULL, err);
    return status;
}

static wt_status text_force_open_streamed(wt_force_source *source, const file_reader *self,
                                          wt_input *input, wt_error *err)
{
    text_source *s = (text_source *)source;
    size_t piece = 0;
    wt_status status = text_choose_piece(self->description, input, &piece, err);
    s->base.n_curves = SIZE_MAX;
    return status == WT_OK ? begin_text_parts(s, self, input, piece, source->log, err) : status;
}

const force_stream text_force_streamed = {.size = sizeof(text_source),
                                          .open = text_force_open_streamed,
                                          .next = text_force_next,
                                          .decode = decode,
                                          .close = text_force_close};

const force_stream text_force = {.size = sizeof(text_source),
                                 .open = text_force_open,
                                 .next = text_force_next,
                                 .decode = decode,
                                 .close = text_force_close};

/* ---- equal steps ----------------------------------------------------------------------------- */

/* Number of steps that define the usual step, and the minimum for a check. */
enum { FIRST = 5, STEPS_MIN = 20 };
/* Limits relative to the usual step. Equal steps have at least three digits. A missing row doubles
 * a step; a repeated row or a wrong number gives a step near zero or of another size. */
static const double equal = 0.01, gap_min = 1.5, wrong_max = 0.5;
/* Maximum number of wrong steps; with more the steps are not equal. A moved part causes three, an
 * exchange of two parts four. */
enum { WRONG_MAX = 4 };

typedef struct broken_steps {
    size_t first; /* first row after a break; 0 if there is none or the other steps are not equal */
    size_t gaps;  /* gaps between equal steps */
    size_t wrong; /* other breaks */
} broken_steps;

/* Finds breaks in otherwise equal steps. A ramp of two rates, scattered steps and a noisy height
 * have none. The first and the last step may be incomplete. */
static broken_steps find_step_breaks(const text_table *t, size_t first, size_t end,
                                     const text_column *c)
{
    static const broken_steps none = {0, 0, 0};
    double start[FIRST];
    broken_steps found = none;
    bool after_gap = true;
    for (size_t i = 0; i < FIRST; i++)
        start[i] = text_table_value(t, first + i + 1, c) - text_table_value(t, first + i, c);
    const double usual = numbers_median(start, FIRST);
    for (size_t row = first + 1; row < end; row++) {
        const double steps =
            (text_table_value(t, row, c) - text_table_value(t, row - 1, c)) / usual;
        const bool even = fabs(steps - 1) <= equal, inner = row > first + 1 && row + 1 < end;
        const bool gap = steps >= gap_min && !after_gap && inner;
        const bool wrong = !gap && (steps >= gap_min || steps <= wrong_max) && inner;
        if (!isfinite(steps) || (!even && !gap && !wrong))
            return none;
        found.gaps += gap;
        found.wrong += wrong;
        found.first = !even && found.first == 0 ? row : found.first;
        after_gap = !even;
    }
    return found.wrong <= WRONG_MAX ? found : none;
}

void text_check_steps(const text_file *file, const text_table *t, int segment, size_t first,
                      size_t end, wt_log *log)
{
    static const wt_quantity even[] = {WT_Q_TIME, WT_Q_HEIGHT, WT_Q_MEASURED_HEIGHT};
    for (size_t i = 0; i < COUNT_OF(even); i++) {
        const text_column *const c = text_table_column(t, even[i], segment);
        const broken_steps broken = c != NULL && end > first + STEPS_MIN
                                        ? find_step_breaks(t, first, end, c)
                                        : (broken_steps){0, 0, 0};
        if (broken.first == 0)
            continue;
        const line_position_text place = format_line_position(t->row_lines[broken.first]);
        if (broken.wrong == 0)
            wt_log_add(log, WT_WARNING, file->name, place.text,
                       "the equal steps of %s have %zu gap%s from here on: are rows missing?",
                       c->name, broken.gaps, broken.gaps > 1 ? "s" : "");
        else
            wt_log_add(log, WT_WARNING, file->name, place.text,
                       "the equal steps of %s are broken at %zu place%s from here on: are "
                       "rows missing, there twice, moved or changed?",
                       c->name, broken.gaps + broken.wrong,
                       broken.gaps + broken.wrong > 1 ? "s" : "");
        return;
    }
}
