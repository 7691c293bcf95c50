/* Tables of a text export to force curves.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A curve that turns comes back by more than the noise of its last point before it. */
static const double least_return = 0.1;

/* Rows [first, end) of a table. */
typedef struct span {
    size_t table, first, end;
} span;

typedef struct text_source {
    wt_force_source base;
    text_file file;
    wt_read_options options;
    wt_parselog *log;
    span next; /* where the next curve begins */
    size_t index;
} text_source;

/* One channel of a segment: a column, or a force made from a deflection. */
typedef struct channel_plan {
    wt_quantity quantity;
    const text_column *column;
    double factor;
} channel_plan;
#define CHANNELS_MAX ((size_t)WT_Q_COUNT + 2)

static double header(const text_table *t, header_value value)
{
    return t->header.value[value];
}

static wt_cantilever cantilever(const text_source *s, const text_table *t)
{
    wt_cantilever c = {.spring_constant = header(t, HEADER_SPRING_CONSTANT),
                       .sensitivity = header(t, HEADER_SENSITIVITY),
                       .spring_constant_given = !isnan(s->options.spring_constant),
                       .sensitivity_given = !isnan(s->options.sensitivity)};
    if (c.spring_constant_given)
        c.spring_constant = s->options.spring_constant;
    if (c.sensitivity_given)
        c.sensitivity = s->options.sensitivity;
    return c;
}

static wt_status missing(const text_source *s, const text_table *t, const char *what,
                         const char *advice, const char *column, wt_error *err)
{
    wt_fail(err, WT_E_MISSING, "the %s is not known", what);
    wt_error_file(err, s->file.name);
    wt_error_place(err, "table at line %zu", t->names_line);
    wt_error_found(err, "only \"%s\"", column);
    wt_error_advice(err, "give it with %s", advice);
    return WT_E_MISSING;
}

/* The file's force or deflection was made with the file's calibration; a given one replaces it. */
static double recalibrate(const text_source *s, const text_table *t, bool force)
{
    const double k = header(t, HEADER_SPRING_CONSTANT);
    const double sensitivity = header(t, HEADER_SENSITIVITY);
    double factor = 1;
    if (!isnan(s->options.sensitivity)) {
        if (sensitivity > 0)
            factor *= s->options.sensitivity / sensitivity;
        else
            wt_parselog_add(s->log, WT_WARNING, s->file.name, NULL,
                            "the file does not say its sensitivity, so the given one cannot "
                            "replace it in a column of %s",
                            force ? "force" : "deflection");
    }
    if (force && !isnan(s->options.spring_constant)) {
        if (k > 0)
            factor *= s->options.spring_constant / k;
        else
            wt_parselog_add(s->log, WT_WARNING, s->file.name, NULL,
                            "the file does not say its spring constant, so the given one cannot "
                            "replace it in a column of force");
    }
    return factor;
}

/* Force from what the table has: force, deflection times k, or voltage times sensitivity times k.
 */
static wt_status plan_force(const text_source *s, const text_table *t, int kind,
                            const wt_cantilever *c, channel_plan *plan, wt_error *err)
{
    plan->quantity = WT_Q_FORCE;
    plan->column = text_table_column(t, WT_Q_FORCE, kind);
    if (plan->column != NULL) {
        plan->factor = recalibrate(s, t, true);
        return WT_OK;
    }
    const text_column *deflection = text_table_column(t, WT_Q_DEFLECTION, kind);
    plan->column =
        deflection != NULL ? deflection : text_table_column(t, WT_Q_DEFLECTION_VOLTAGE, kind);
    if (plan->column == NULL)
        return WT_OK;
    if (deflection == NULL && !(c->sensitivity > 0))
        return missing(s, t, "deflection sensitivity", "--sensitivity, such as 60nm/V",
                       plan->column->name, err);
    if (!(c->spring_constant > 0))
        return missing(s, t, "spring constant", "--spring-constant, such as 0.1N/m",
                       plan->column->name, err);
    plan->factor =
        c->spring_constant * (deflection != NULL ? recalibrate(s, t, false) : c->sensitivity);
    return WT_OK;
}

static wt_status plan_channels(const text_source *s, const text_table *t, int kind,
                               const wt_cantilever *c, channel_plan plan[CHANNELS_MAX], size_t *n,
                               wt_error *err)
{
    *n = 0;
    if ((s->options.want & WT_Q_BIT(WT_Q_FORCE)) != 0) {
        wt_error missed = WT_ERROR_INIT;
        wt_status status = plan_force(s, t, kind, c, &plan[0], &missed);
        /* who asks for all that is there gets what is there; who asks for the force must have it */
        if (status == WT_E_MISSING && s->options.want == WT_Q_ALL) {
            wt_parselog_add(s->log, WT_WARNING, s->file.name, missed.place, "no force: %s; %s",
                            missed.message, missed.advice);
        } else if (status != WT_OK) {
            if (err != NULL)
                *err = missed;
            return status;
        } else {
            *n = plan[0].column != NULL;
        }
    }
    for (size_t i = 0; i < t->n_columns && *n < CHANNELS_MAX; i++) {
        const column_rule *rule = t->columns[i].rule;
        if ((rule->has_segment && (int)rule->segment != kind) || rule->quantity == WT_Q_FORCE ||
            (s->options.want & WT_Q_BIT(rule->quantity)) == 0)
            continue;
        const bool deflection = rule->quantity == WT_Q_DEFLECTION;
        plan[(*n)++] = (channel_plan){rule->quantity, &t->columns[i],
                                      deflection ? recalibrate(s, t, false) : 1};
    }
    return WT_OK;
}

/* Rows where every channel is empty belong to the longer partner of a column pair. */
static void trim(const text_table *t, const channel_plan *plan, size_t n, span *rows)
{
    for (; rows->end > rows->first; rows->end--)
        for (size_t i = 0; i < n; i++)
            if (!isnan(text_table_value(t, rows->end - 1, plan[i].column)))
                return;
}

static wt_status add_segment(const text_source *s, wt_force_curve *curve, wt_segment_kind kind,
                             span rows, wt_error *err)
{
    const text_table *t = &s->file.tables[rows.table];
    channel_plan plan[CHANNELS_MAX];
    size_t n = 0;
    if ((s->options.segments & WT_SEGMENT_BIT(kind)) == 0)
        return WT_OK;
    wt_status status = plan_channels(s, t, (int)kind, &curve->cantilever, plan, &n, err);
    if (status != WT_OK)
        return status;
    trim(t, plan, n, &rows);
    const size_t n_points = rows.end - rows.first;
    if (n == 0 || n_points == 0)
        return WT_OK;
    wt_segment *segment = wt_force_curve_add_segment(curve, kind, n_points, n);
    if (segment == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for a segment");
    for (size_t i = 0; i < n; i++) {
        wt_channel *channel = &segment->channels[i];
        channel->quantity = plan[i].quantity;
        memcpy(channel->name, plan[i].column->name, sizeof channel->name);
        memcpy(channel->unit, plan[i].column->unit, sizeof channel->unit);
        for (size_t r = 0; r < n_points; r++)
            channel->values[r] =
                plan[i].factor * text_table_value(t, rows.first + r, plan[i].column);
    }
    segment->duration = header(t, HEADER_DURATION);
    segment->setpoint = header(t, HEADER_SETPOINT);
    segment->velocity = header(t, HEADER_VELOCITY);
    const text_column *time = text_table_column(t, WT_Q_TIME, (int)kind);
    if (isnan(segment->duration) && time != NULL)
        segment->duration =
            text_table_value(t, rows.end - 1, time) - text_table_value(t, rows.first, time);
    return WT_OK;
}

/* Approach and retract in one column: it turns where the height is farthest from its start. */
static wt_status add_turning(const text_source *s, wt_force_curve *curve, span rows, wt_error *err)
{
    const text_table *t = &s->file.tables[rows.table];
    const text_column *height = text_table_column(t, WT_Q_MEASURED_HEIGHT, -1);
    span approach = rows, retract = rows;
    double farthest = 0;
    if (height == NULL)
        height = text_table_column(t, WT_Q_HEIGHT, -1);
    /* Rows without a height at either end tell no distance. */
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

/* Rows of one table and one kind. */
static wt_status add_rows(const text_source *s, wt_force_curve *curve, span rows, wt_error *err)
{
    const text_table *t = &s->file.tables[rows.table];
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
    if (s->file.description->turning_point)
        return add_turning(s, curve, rows, err);
    return add_segment(s, curve, WT_SEGMENT_APPROACH, rows, err);
}

/* The block that a curve is made of ends where the number of the block changes. */
static wt_status text_next(wt_force_source *source, wt_force_curve *curve, wt_error *err)
{
    text_source *s = (text_source *)source;
    const text_file *file = &s->file;
    wt_status status = WT_OK;
    wt_force_curve_reset(curve);
    if (s->next.table >= file->n_tables)
        return WT_END;
    const text_table *t = &file->tables[s->next.table];
    const size_t block = t->blocks[s->next.first];
    curve->index = s->index++;
    curve->x = header(t, HEADER_POSITION_X);
    curve->y = header(t, HEADER_POSITION_Y);
    curve->grid_x = curve->grid_y = -1;
    curve->cantilever = cantilever(s, t);
    while (s->next.table < file->n_tables) {
        t = &file->tables[s->next.table];
        span rows = s->next;
        if (t->blocks[rows.first] != block)
            break;
        for (rows.end = rows.first + 1; rows.end < t->n_rows; rows.end++)
            if (t->blocks[rows.end] != block || t->kinds[rows.end] != t->kinds[rows.first])
                break;
        if (status == WT_OK)
            status = text_table_require(file, t, WT_KIND_FORCE, err);
        if (status == WT_OK)
            status = add_rows(s, curve, rows, err);
        s->next.first = rows.end;
        if (rows.end == t->n_rows)
            s->next = (span){.table = s->next.table + 1};
    }
    if (status != WT_OK) {
        wt_error_file(err, file->name);
        wt_force_curve_reset(curve);
    }
    return status;
}

static void text_close(wt_force_source *source)
{
    text_source *s = (text_source *)source;
    text_file_free(&s->file);
    free(s);
}

static size_t count_curves(const text_file *file)
{
    size_t n = 0, block = 0;
    for (size_t i = 0; i < file->n_tables; i++)
        for (size_t r = 0; r < file->tables[i].n_rows; r++) {
            n += n == 0 || file->tables[i].blocks[r] != block;
            block = file->tables[i].blocks[r];
        }
    return n;
}

wt_status text_open_force(const file_reader *self, wt_input *input, const wt_read_options *options,
                          wt_parselog *log, wt_force_source **source, wt_error *err)
{
    text_source *s = calloc(1, sizeof *s);
    if (s == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the force curves");
    wt_status status =
        text_scan(self->description, input, WT_KIND_FORCE, options, log, &s->file, err);
    if (status != WT_OK) {
        free(s);
        return status;
    }
    if (s->file.n_tables == 0) {
        status = text_nothing(&s->file, "force curve", err);
        text_close(&s->base);
        return status;
    }
    text_log_unknown(&s->file, log);
    s->base.next = text_next;
    s->base.close = text_close;
    s->base.n_curves = count_curves(&s->file);
    s->options = *options;
    s->options.units = NULL; /* used up; the caller's array may go */
    s->options.n_units = 0;
    s->log = log;
    *source = &s->base;
    return WT_OK;
}
