/* What `info` says about a text export.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/text/text.h"

#include "base/clocale.h"
#include "read/facts.h"

#include <math.h>
#include <string.h>

/* Tables beyond this many repeat what the first ones say. */
#define TABLES_SHOWN ((size_t)4)

static wt_status add(wt_table *facts, const char *item, const char *value, const char *unit,
                     size_t line, wt_error *err)
{
    char source[32] = "";
    if (line > 0)
        snprintf(source, sizeof source, "line %zu", line);
    return facts_add(facts, item, value, unit, source, err);
}

static wt_status add_header(const text_file *file, wt_table *facts, wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; i < file->description->n_fields && status == WT_OK; i++)
        if (file->values[i].line > 0)
            status = add(facts, file->description->fields[i].name, file->values[i].text,
                         file->values[i].unit, file->values[i].line, err);
    return status;
}

static wt_status add_column(const text_table *t, const text_column *c, wt_table *facts,
                            wt_error *err)
{
    char item[96], value[160];
    const wt_quantity q = c->rule->quantity;
    snprintf(item, sizeof item, "column \"%s\"", c->name);
    switch (c->problem) {
    case COLUMN_GOOD:
        snprintf(value, sizeof value, "%s, %s -> %s%s%s", wt_quantity_id(q),
                 c->unit[0] != '\0' ? c->unit : "no unit", wt_quantity_unit(q),
                 c->rule->has_segment ? ", " : "",
                 c->rule->has_segment ? wt_segment_kind_name(c->rule->segment) : "");
        break;
    case COLUMN_NO_UNIT:
        snprintf(value, sizeof value, "%s, but its unit is not said: give --units \"%s=...\"",
                 wt_quantity_id(q), c->name);
        break;
    case COLUMN_BAD_UNIT:
        snprintf(value, sizeof value, "unit \"%s\" does not fit %s", c->unit, wt_quantity_id(q));
        break;
    default:
        snprintf(value, sizeof value, "not clear without a column \"%s\"", c->rule->with);
        break;
    }
    return add(facts, item, value, c->unit, t->names_line, err);
}

static wt_status add_table(const text_file *file, size_t number, wt_table *facts, wt_error *err)
{
    const text_table *t = &file->tables[number];
    char item[32], value[192];
    snprintf(item, sizeof item, "table %zu", number + 1);
    snprintf(value, sizeof value, "%s%s%zu rows, separator %s, decimal %s", t->title,
             t->title[0] != '\0' ? ": " : "", t->n_rows, separator_name(t->separator),
             t->decimal == ',' ? "comma" : "point");
    wt_status status = add(facts, item, value, "", t->names_line, err);
    /* Tables of one file mostly have the columns of the first. */
    const bool same = number > 0 && t->n_columns == file->tables[0].n_columns &&
                      t->quantities == file->tables[0].quantities && t->n_problems == 0;
    for (size_t i = 0; !same && i < t->n_columns && status == WT_OK; i++)
        status = add_column(t, &t->columns[i], facts, err);
    for (size_t i = 0; !same && i < t->n_problems && status == WT_OK; i++)
        status = add_column(t, &t->problems[i], facts, err);
    return status;
}

static wt_status add_problem(wt_table *facts, wt_error *problem, wt_error *err)
{
    char text[1024], place[sizeof problem->place];
    memcpy(place, problem->place, sizeof place);
    problem->file[0] = problem->place[0] = '\0'; /* they stand elsewhere */
    wt_error_format(problem, text, sizeof text);
    return facts_add(facts, "not readable as it is", text, "", place, err);
}

static wt_status add_sweep(const text_file *file, const wt_read_options *options, wt_parselog *log,
                           wt_table *facts, wt_error *err)
{
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error problem = WT_ERROR_INIT;
    wt_status status;
    if (text_sweep(file, options, log, &sweep, &problem) != WT_OK)
        return add_problem(facts, &problem, err);
    status = facts_add(facts, "deformation",
                       sweep.deformation == WT_TENSION ? "tension (E)" : "shear (G)", "", "", err);
    if (status == WT_OK)
        status = facts_count(facts, "isotherms", sweep.n_isotherms, "", err);
    for (size_t i = 0; i < sweep.n_isotherms && status == WT_OK; i++) {
        const wt_isotherm *s = &sweep.isotherms[i];
        char value[128];
        clocale_print(value, sizeof value, "%.2f degC, %zu points, %.4g to %.4g rad/s",
                      s->temperature - WT_ZERO_CELSIUS, s->n, s->angular_frequency[0],
                      s->angular_frequency[s->n - 1]);
        status = facts_add(facts, "isotherm", value, "", s->source, err);
    }
    wt_sweep_clear(&sweep);
    return status;
}

static wt_status add_curve(const wt_force_curve *curve, wt_table *facts, wt_error *err)
{
    char item[64], value[64];
    wt_status status = WT_OK;
    for (size_t i = 0; i < curve->n_segments && status == WT_OK; i++) {
        const wt_segment *s = &curve->segments[i];
        snprintf(item, sizeof item, "curve %zu, segment %zu", curve->index, s->index);
        snprintf(value, sizeof value, "%s, %zu points", wt_segment_kind_name(s->kind), s->n_points);
        status = facts_add(facts, item, value, "", "", err);
    }
    return status;
}

/* The curves without their forces, which may need a calibration that is not known. */
static wt_status add_curves(const file_reader *self, wt_input *input,
                            const wt_read_options *options, wt_table *facts, wt_error *err)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_error problem = WT_ERROR_INIT;
    wt_read_options bare = *options;
    bare.want &= ~WT_Q_BIT(WT_Q_FORCE);
    if (text_open_force(self, input, &bare, NULL, &source, &problem) != WT_OK)
        return add_problem(facts, &problem, err);
    wt_status status = facts_count(facts, "curves", wt_force_count(source), "", err);
    for (size_t i = 0; i < TABLES_SHOWN && status == WT_OK; i++) {
        const wt_status got = wt_force_next(source, &curve, &problem);
        if (got == WT_END)
            break;
        if (got != WT_OK) {
            status = add_problem(facts, &problem, err);
            break;
        }
        status = add_curve(&curve, facts, err);
        if (status == WT_OK && i == 0)
            status = facts_number(facts, "spring constant", curve.cantilever.spring_constant, "N/m",
                                  "", err);
        if (status == WT_OK && i == 0)
            status =
                facts_number(facts, "sensitivity", curve.cantilever.sensitivity, "m/V", "", err);
    }
    wt_force_curve_clear(&curve);
    wt_force_close(source);
    return status;
}

static wt_status add_force(const file_reader *self, wt_input *input, const wt_read_options *options,
                           wt_table *facts, wt_error *err)
{
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_error problem = WT_ERROR_INIT;
    wt_read_options force_only = *options;
    force_only.want = WT_Q_BIT(WT_Q_FORCE);
    wt_status status = add_curves(self, input, options, facts, err);
    if (status == WT_OK &&
        text_open_force(self, input, &force_only, NULL, &source, &problem) == WT_OK) {
        if (wt_force_next(source, &curve, &problem) == WT_E_MISSING)
            status = add_problem(facts, &problem, err);
        wt_force_curve_clear(&curve);
        wt_force_close(source);
    }
    return status;
}

static wt_status add_spectrum(const file_reader *self, wt_input *input,
                              const wt_read_options *options, wt_table *facts, wt_error *err)
{
    wt_power_spectrum spectrum = {.n = 0};
    wt_error problem = WT_ERROR_INIT;
    char value[128];
    if (text_read_spectrum(self, input, options, NULL, &spectrum, &problem) != WT_OK)
        return add_problem(facts, &problem, err);
    clocale_print(value, sizeof value, "%s, %zu points, %.4g to %.4g rad/m",
                  spectrum.kind == WT_SPECTRUM_2D ? "two-dimensional" : "one-dimensional",
                  spectrum.n, spectrum.wavenumber[0], spectrum.wavenumber[spectrum.n - 1]);
    wt_power_spectrum_clear(&spectrum);
    return facts_add(facts, "power spectrum", value, "", "", err);
}

static wt_status add_layout(const text_file *file, wt_table *facts, wt_error *err)
{
    wt_status status = facts_add(facts, "encoding", file->lines.encoding, "", "", err);
    if (status == WT_OK)
        status = add_header(file, facts, err);
    if (status == WT_OK)
        status = facts_count(facts, "tables", file->n_tables, "", err);
    for (size_t i = 0; i < file->n_tables && i < TABLES_SHOWN && status == WT_OK; i++)
        status = add_table(file, i, facts, err);
    for (size_t i = 0; i < file->steps.n && status == WT_OK; i++)
        status = facts_add(facts, "step without a table that is understood", file->steps.items[i],
                           "", "", err);
    if (status == WT_OK && file->unknown.n > 0) {
        char names[4096];
        text_unknown(file, names, sizeof names);
        status = facts_add(facts, "columns not used", names, "", "", err);
    }
    return status;
}

wt_status text_describe(const file_reader *self, wt_input *input, const wt_read_options *options,
                        wt_parselog *log, wt_table *facts, wt_error *err)
{
    const text_description *description = self->description;
    text_file file;
    wt_error problem = WT_ERROR_INIT;
    wt_status status = facts_add(facts, "description version", description->version, "", "", err);
    if (status != WT_OK)
        return status;
    if (text_scan(description, input, description->kinds, options, log, &file, &problem) != WT_OK)
        return add_problem(facts, &problem, err);
    status = add_layout(&file, facts, err);
    if (status == WT_OK && file.n_tables == 0) {
        (void)text_nothing(&file, "table that is understood", &problem);
        status = add_problem(facts, &problem, err);
    }
    const bool has_sweep = text_has(&file, WT_KIND_SWEEP) && file.n_tables > 0;
    const bool has_force = text_has(&file, WT_KIND_FORCE);
    const bool has_spectrum = text_has(&file, WT_KIND_SPECTRUM);
    if (status == WT_OK && has_sweep)
        status = add_sweep(&file, options, log, facts, err);
    text_file_free(&file);
    if (status == WT_OK && has_force)
        status = add_force(self, input, options, facts, err);
    if (status == WT_OK && has_spectrum)
        status = add_spectrum(self, input, options, facts, err);
    return status;
}
