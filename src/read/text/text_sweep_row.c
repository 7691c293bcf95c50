/* Computes the quantities of a sweep from a row of a table.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text_sweep.h"

#include <math.h>
#include <string.h>

/* Finds the columns of relaxation or creep. A table with a frequency is an oscillation in any
 * case. */
static void find_step_columns(const text_table *t, bool tension, sweep_columns *c)
{
    const text_column *const modulus =
        text_table_column(t, tension ? WT_Q_RELAXATION_MODULUS : WT_Q_SHEAR_RELAXATION_MODULUS, -1);
    const text_column *const compliance =
        text_table_column(t, tension ? WT_Q_CREEP_COMPLIANCE : WT_Q_SHEAR_CREEP_COMPLIANCE, -1);
    if (c->frequency != NULL || c->time == NULL || (modulus == NULL && compliance == NULL))
        return;
    c->step = modulus != NULL ? modulus : compliance;
    c->loading = modulus != NULL ? WT_RELAXATION : WT_CREEP;
    c->has_storage = true; /* the step modulus replaces it */
    c->has_loss = false;
    c->strain = c->factor = c->phase = NULL; /* a creep strain is no amplitude */
}

sweep_columns sweep_find_columns(const text_table *t, wt_read_deformation stated)
{
    sweep_columns c = {.to_angular = 1};
    /* a loss factor alone fits either deformation */
    const bool tension = (t->quantities & TENSION_MODULI) != 0 ||
                         ((t->quantities & SHEAR_MODULI) == 0 && stated != WT_DEFORMATION_SHEAR);
    c.deformation = tension ? WT_TENSION : WT_SHEAR;
    c.frequency = text_table_column(t, WT_Q_ANGULAR_FREQUENCY, -1);
    if (c.frequency == NULL) {
        c.frequency = text_table_column(t, WT_Q_FREQUENCY, -1);
        c.to_angular = 2 * M_PI;
    }
    c.storage =
        text_table_column(t, tension ? WT_Q_STORAGE_MODULUS : WT_Q_SHEAR_STORAGE_MODULUS, -1);
    c.loss = text_table_column(t, tension ? WT_Q_LOSS_MODULUS : WT_Q_SHEAR_LOSS_MODULUS, -1);
    c.magnitude =
        text_table_column(t, tension ? WT_Q_COMPLEX_MODULUS : WT_Q_SHEAR_COMPLEX_MODULUS, -1);
    c.factor = text_table_column(t, WT_Q_LOSS_FACTOR, -1);
    c.phase = text_table_column(t, WT_Q_PHASE, -1);
    c.temperature = text_table_column(t, WT_Q_TEMPERATURE, -1);
    c.strain = text_table_column(t, WT_Q_STRAIN, -1);
    c.time = text_table_column(t, WT_Q_TIME, -1);
    const bool has_angle = c.factor != NULL || c.phase != NULL;
    const bool two = (c.loss != NULL) + has_angle + (c.magnitude != NULL) >= 2;
    c.has_storage = c.storage != NULL || two;
    c.has_loss = c.loss != NULL || (c.has_storage && (has_angle || c.magnitude != NULL));
    find_step_columns(t, tension, &c);
    return c;
}

double sweep_angular_frequency(const sweep_builder *b, size_t row)
{
    if (b->c.step != NULL)
        return 1 / text_table_value(b->table, row, b->c.time);
    if (b->c.frequency == NULL) {
        const double stated = b->table->header.value[HEADER_ANGULAR_FREQUENCY];
        return isnan(stated) ? 2 * M_PI * b->options->frequency : stated;
    }
    return b->c.to_angular * text_table_value(b->table, row, b->c.frequency);
}

double sweep_loss_factor(const sweep_builder *b, size_t row)
{
    if (b->c.factor == NULL && b->c.phase != NULL)
        return tan(text_table_value(b->table, row, b->c.phase));
    return b->c.factor != NULL ? text_table_value(b->table, row, b->c.factor) : (double)NAN;
}

/* Returns the other leg of a right triangle; NaN if the leg is longer than the hypotenuse. */
static double other_leg(double hypotenuse, double leg)
{
    return sqrt((hypotenuse - leg) * (hypotenuse + leg));
}

double sweep_storage_modulus(const sweep_builder *b, size_t row)
{
    const sweep_columns *const c = &b->c;
    if (!c->has_storage)
        return (double)NAN;
    if (c->step != NULL) {
        const double value = text_table_value(b->table, row, c->step);
        return c->loading == WT_CREEP ? 1 / value : value;
    }
    if (c->storage != NULL)
        return text_table_value(b->table, row, c->storage);
    if (c->magnitude == NULL) {
        const double ratio = text_table_value(b->table, row, c->loss) / sweep_loss_factor(b, row);
        return isfinite(ratio) ? ratio : (double)NAN;
    }
    const double magnitude = text_table_value(b->table, row, c->magnitude);
    if (c->factor != NULL)
        return magnitude / hypot(1.0, sweep_loss_factor(b, row));
    if (c->phase != NULL)
        return magnitude * cos(text_table_value(b->table, row, c->phase));
    return other_leg(magnitude, text_table_value(b->table, row, c->loss));
}

double sweep_loss_modulus(const sweep_builder *b, size_t row)
{
    const sweep_columns *const c = &b->c;
    if (!c->has_loss)
        return (double)NAN;
    if (c->loss != NULL)
        return text_table_value(b->table, row, c->loss);
    const double storage = sweep_storage_modulus(b, row);
    if (c->factor == NULL && c->phase == NULL)
        return other_leg(text_table_value(b->table, row, c->magnitude), storage);
    return storage * sweep_loss_factor(b, row);
}

unsigned sweep_optional_arrays(const sweep_columns *c)
{
    const bool alone = (c->factor != NULL || c->phase != NULL) && !c->has_storage && !c->has_loss;
    return (c->strain != NULL ? (unsigned)WT_SWEEP_HAS_STRAIN : 0) |
           (alone ? (unsigned)WT_SWEEP_HAS_LOSS_FACTOR : 0);
}

double sweep_temperature(const sweep_builder *b, size_t row)
{
    return b->c.temperature != NULL ? text_table_value(b->table, row, b->c.temperature)
                                    : (double)NAN;
}

int sweep_direction(const sweep_builder *b, size_t from, size_t to)
{
    const double ratio = sweep_angular_frequency(b, to) / sweep_angular_frequency(b, from);
    return ratio > 1 + SAME_FREQUENCY ? 1 : ratio < 1 / (1 + SAME_FREQUENCY) ? -1 : 0;
}

bool sweep_is_valid_row(const sweep_builder *b, size_t row)
{
    const sweep_columns *c = &b->c;
    /* some programs separate segments by rows of negative time */
    const bool marker = c->time != NULL && text_table_value(b->table, row, c->time) < 0;
    const bool alone = !c->has_storage && !c->has_loss;
    /* the step itself is at time 0 without creep, so neither value is finite */
    return !marker && sweep_angular_frequency(b, row) > 0 &&
           isfinite(sweep_angular_frequency(b, row)) &&
           (!c->has_storage || isfinite(sweep_storage_modulus(b, row))) &&
           (!c->has_loss || isfinite(sweep_loss_modulus(b, row))) &&
           (!alone || isfinite(sweep_loss_factor(b, row)));
}

/* Formats the source as "FILE, TITLE OF THE STEP". The title distinguishes the isotherms, so a long
 * file name is cut. */
void sweep_format_source(const sweep_builder *b, char *source, size_t size)
{
    const text_table *t = b->table;
    const char *name = wt_path_base(b->file->name);
    char end[112];
    if (t->title[0] != '\0')
        snprintf(end, sizeof end, ", %s", t->title);
    else if (b->sample != NO_SAMPLE && t->sample_cell != SIZE_MAX)
        snprintf(end, sizeof end, ", %.60s", b->file->samples.items[b->sample]);
    else
        snprintf(end, sizeof end, ", line %zu", t->names_line);
    const size_t length = strlen(end);
    text_copy(source, size - length, (text_span){name, strlen(name)});
    memcpy(source + strlen(source), end, length + 1);
}

static wt_status temperature_in_name(const sweep_builder *b, double *temperature)
{
    const char *pattern = b->options->temperature_in_name, *name = wt_path_base(b->file->name);
    text_condition c;
    if (!condition_match_name(pattern, name, &c)) {
        wt_fail(b->err, WT_E_MISSING, "no temperature in the name of the file");
        wt_error_expected(b->err, "a name like \"%s\"", pattern);
        wt_error_found(b->err, "\"%s\"", name);
        return WT_E_MISSING;
    }
    *temperature = c.temperature;
    return WT_OK;
}

wt_status sweep_set_temperature(const sweep_builder *b, double *temperature, double *spread)
{
    const double header = b->table->header.value[HEADER_TEMPERATURE];
    const header_priority priority = b->table->header.priority[HEADER_TEMPERATURE];
    double mean = 0, scatter = 0;
    size_t n = 0;
    /* Welford's recurrence keeps a standard deviation of 0.01 K at 300 K free of rounding
     * errors. */
    for (size_t i = 0; i < b->n; i++) {
        const double t = sweep_temperature(b, b->rows[i]);
        if (isnan(t))
            continue;
        const double before = t - mean;
        mean += before / (double)++n;
        scatter += before * (t - mean);
    }
    *spread = n > 1 ? sqrt(scatter / (double)(n - 1)) : (double)NAN;
    if (!isnan(header) && (priority == HEADER_OVERRIDES || n == 0)) {
        *temperature = header;
        if (priority == HEADER_FALLBACK)
            wt_log_add(b->log, WT_WARNING, b->file->name, NULL,
                       "the temperature stands in the header text only");
    } else if (n > 0) {
        *temperature = mean;
    } else if (b->options->temperature_in_name != NULL) {
        const wt_status status = temperature_in_name(b, temperature);
        if (status != WT_OK)
            return status;
    } else if (!isnan(b->options->temperature) || b->options->allow_missing_temperature) {
        *temperature = b->options->temperature;
    } else {
        wt_status status = text_table_problem(b->table, WT_Q_BIT(WT_Q_TEMPERATURE), b->err);
        if (status != WT_OK)
            return status;
        wt_fail(b->err, WT_E_MISSING, "no temperature");
        wt_error_place(b->err, "table at line %zu", b->table->names_line);
        wt_error_expected(b->err, "a column of temperature or a header line with it");
        wt_error_advice(b->err, "give it with --temperature 25degC, or say where it stands in the "
                                "names of the sheets or files with --temperature-in-name "
                                "\"*_#C*\"");
        wt_error_options(b->err, "temperature temperature-in-name");
        return WT_E_MISSING;
    }
    if (*temperature <= 0) {
        wt_fail(b->err, WT_E_RANGE, "temperature below absolute zero");
        wt_error_place(b->err, "table at line %zu", b->table->names_line);
        wt_error_found(b->err, "%g K", *temperature);
        return WT_E_RANGE;
    }
    return WT_OK;
}
