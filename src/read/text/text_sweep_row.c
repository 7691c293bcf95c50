/* Quantities of a DMA sweep from a row of a table. Checks a table for repeated rows and for a loss
 * factor that contradicts the moduli.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text_sweep.h"

#include "core/base/array.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
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

/* ---- checks ---------------------------------------------------------------------------------- */

static int compare_row_values(const void *a, const void *b, void *user)
{
    const text_table *const t = user;
    const size_t p = *(const size_t *)a, q = *(const size_t *)b;
    const int order = memcmp(t->values + p * t->n_columns, t->values + q * t->n_columns,
                             t->n_columns * sizeof *t->values);
    return order != 0 ? order : (p > q) - (p < q);
}

/* Warns of repeated rows: a measurement does not repeat all values to the last digit. */
static void warn_duplicate_rows(const text_file *file, text_table *t, wt_log *log)
{
    enum { COLUMNS_LEAST = 3 };
    size_t n = 0, line = SIZE_MAX;
    if (t->n_columns < COLUMNS_LEAST || t->n_rows < 2)
        return;
    size_t *const rows = wt_alloc(t->n_rows, sizeof *rows);
    for (size_t i = 0; i < t->n_rows; i++)
        rows[i] = i;
    qsort_r(rows, t->n_rows, sizeof *rows, compare_row_values, t);
    for (size_t i = 1; i < t->n_rows; i++) {
        const size_t width = t->n_columns;
        const bool twice = memcmp(t->values + rows[i] * width, t->values + rows[i - 1] * width,
                                  width * sizeof *t->values) == 0 &&
                           t->samples[rows[i]] == t->samples[rows[i - 1]] &&
                           t->blocks[rows[i]] == t->blocks[rows[i - 1]];
        n += twice;
        line = twice && t->row_lines[rows[i]] < line ? t->row_lines[rows[i]] : line;
    }
    free(rows);
    if (n > 0)
        wt_log_add(log, WT_WARNING, file->name, format_line_position(line).text,
                   "%zu rows from here on are there twice with the same numbers: was a part "
                   "of the file copied into it?",
                   n);
}

/* Returns E''/E' minus the loss factor of a row; NaN if one is missing. */
static double loss_factor_deviation(const text_table *t, const sweep_columns *c, size_t row)
{
    return text_table_value(t, row, c->loss) / text_table_value(t, row, c->storage) -
           text_table_value(t, row, c->factor);
}

/* Warns of a loss factor that is not the ratio of the moduli although it is in most rows. Two
 * digits allow 5 %. Fixed decimals, or an instrument that averages all three, give similar
 * deviations in most rows. */
static void warn_loss_factors(const text_file *file, const text_table *t, wt_log *log)
{
    static const double two_digits = 0.05, most_rows = 10;
    enum { ROWS_LEAST = 4 };
    const sweep_columns c = sweep_find_columns(t, WT_DEFORMATION_FROM_FILE);
    size_t n = 0, n_wrong = 0, line = SIZE_MAX;
    if (c.storage == NULL || c.loss == NULL || c.factor == NULL || t->n_rows < ROWS_LEAST)
        return;
    double *const gaps = wt_alloc(t->n_rows, sizeof *gaps);
    for (size_t i = 0; i < t->n_rows; i++) {
        const double gap = loss_factor_deviation(t, &c, i);
        if (isfinite(gap))
            gaps[n++] = fabs(gap);
    }
    const double usual = n > 0 ? numbers_median(gaps, n) : (double)NAN;
    free(gaps);
    for (size_t i = 0; i < t->n_rows && n >= ROWS_LEAST; i++) {
        const double gap = fabs(loss_factor_deviation(t, &c, i));
        const bool wrong = isfinite(gap) && gap > most_rows * usual &&
                           gap > two_digits * fabs(text_table_value(t, i, c.factor));
        n_wrong += wrong;
        line = wrong && t->row_lines[i] < line ? t->row_lines[i] : line;
    }
    if (n_wrong > 0)
        wt_log_add(log, WT_WARNING, file->name, format_line_position(line).text,
                   "the loss factor of %zu row%s from here on is not the ratio of the moduli "
                   "beside it, as it is in the others: was a number changed?",
                   n_wrong, n_wrong > 1 ? "s" : "");
}

/* ---- redundant columns ----------------------------------------------------------------------- */

/* Ratio of two statements of one quantity in a row; 1 if they agree. NaN if one is missing. */
typedef double statement_ratio(const text_table *t, const sweep_columns *c, size_t row);

static double ratio_of_loss_factor(const text_table *t, const sweep_columns *c, size_t row)
{
    return text_table_value(t, row, c->factor) * text_table_value(t, row, c->storage) /
           text_table_value(t, row, c->loss);
}

static double ratio_of_frequency(const text_table *t, const sweep_columns *c, size_t row)
{
    (void)c;
    return text_table_value(t, row, text_table_column(t, WT_Q_ANGULAR_FREQUENCY, -1)) /
           (2 * M_PI * text_table_value(t, row, text_table_column(t, WT_Q_FREQUENCY, -1)));
}

static double ratio_of_phase(const text_table *t, const sweep_columns *c, size_t row)
{
    return tan(text_table_value(t, row, c->phase)) * text_table_value(t, row, c->storage) /
           text_table_value(t, row, c->loss);
}

static double ratio_of_angles(const text_table *t, const sweep_columns *c, size_t row)
{
    return tan(text_table_value(t, row, c->phase)) / text_table_value(t, row, c->factor);
}

static double ratio_of_magnitude(const text_table *t, const sweep_columns *c, size_t row)
{
    return text_table_value(t, row, c->magnitude) /
           hypot(text_table_value(t, row, c->storage), text_table_value(t, row, c->loss));
}

/* Median of the ratio over the rows. NaN without a row. */
static double usual_ratio(const text_table *t, const sweep_columns *c, statement_ratio *ratio)
{
    size_t n = 0;
    double *const ratios = wt_alloc(t->n_rows, sizeof *ratios);
    for (size_t i = 0; i < t->n_rows; i++) {
        const double value = ratio(t, c, i);
        if (isfinite(value) && value > 0)
            ratios[n++] = value;
    }
    const double median = n > 0 ? numbers_median(ratios, n) : (double)NAN;
    free(ratios);
    return median;
}

static bool is_outside(double ratio, double factor)
{
    return ratio > factor || ratio < 1 / factor;
}

/* Warns of columns that state one quantity and disagree in most rows. Instruments round and average
 * each column by itself, which leaves a few percent of a loss factor. */
static void warn_contradictions(const text_file *file, const text_table *t, wt_log *log)
{
    const sweep_columns c = sweep_find_columns(t, WT_DEFORMATION_FROM_FILE);
    const bool moduli = c.storage != NULL && c.loss != NULL;
    const struct {
        bool is_stated; /* all columns of the ratio are there */
        statement_ratio *ratio;
        double same_factor;
        const char *before, *behind; /* of the ratio in the message */
    } statements[] = {
        {moduli && c.factor != NULL, ratio_of_loss_factor, 1.2, "the loss factor is ",
         " times E''/E' in most rows; the moduli are used"},
        {moduli && c.phase != NULL, ratio_of_phase, 1.2, "the tangent of the phase angle is ",
         " times E''/E' in most rows; the moduli are used"},
        {!moduli && c.factor != NULL && c.phase != NULL, ratio_of_angles, 1.2,
         "the tangent of the phase angle is ",
         " times the loss factor in most rows; the loss factor is used"},
        {moduli && c.magnitude != NULL, ratio_of_magnitude, 1.2, "the complex modulus is ",
         " times the magnitude of E' and E'' in most rows; E' and E'' are used"},
        {text_table_column(t, WT_Q_ANGULAR_FREQUENCY, -1) != NULL &&
             text_table_column(t, WT_Q_FREQUENCY, -1) != NULL,
         ratio_of_frequency, 1.01, "the angular frequency disagrees with the frequency: it is ",
         " times 2 pi f in most rows; a unit of one of them is wrong, and the angular frequency is "
         "used"},
    };
    for (size_t i = 0; i < COUNT_OF(statements); i++) {
        const double usual = statements[i].is_stated ? usual_ratio(t, &c, statements[i].ratio) : 1;
        if (is_outside(usual, statements[i].same_factor))
            wt_log_action(log, WT_WARNING, WT_CONTRADICTED, t->n_rows, "--columns", file->name,
                          format_line_position(t->names_line).text, "%s%.3g%s",
                          statements[i].before, usual, statements[i].behind);
    }
}

/* Reports two columns of temperature that differ, such as those of the oven and of the sample. */
static void report_other_temperature(const text_file *file, const text_table *t, wt_log *log)
{
    static const double same = 0.5; /* [K] */
    const text_column *const used = text_table_column(t, WT_Q_TEMPERATURE, -1), *other = NULL;
    for (size_t i = 0; i < t->n_columns && used != NULL; i++)
        if (&t->columns[i] != used && t->columns[i].rule->quantity == WT_Q_TEMPERATURE)
            other = &t->columns[i];
    if (other == NULL)
        return;
    double *const differences = wt_alloc(t->n_rows, sizeof *differences);
    size_t n = 0;
    for (size_t i = 0; i < t->n_rows; i++) {
        const double d = text_table_value(t, i, other) - text_table_value(t, i, used);
        if (isfinite(d))
            differences[n++] = d;
    }
    const double median = n > 0 ? numbers_median(differences, n) : 0;
    free(differences);
    if (fabs(median) > same)
        wt_log_action(log, text_column_is_of_sample(used) ? WT_NOTE : WT_WARNING, WT_CONTRADICTED,
                      n, "--columns", file->name, format_line_position(t->names_line).text,
                      "two columns of temperature differ by %.1f K in most rows: \"%s\" is used, "
                      "not \"%s\"",
                      fabs(median), used->name, other->name);
}

void sweep_check_table(const text_file *file, text_table *t, wt_log *log)
{
    warn_duplicate_rows(file, t, log);
    warn_contradictions(file, t, log);
    report_other_temperature(file, t, log);
    warn_loss_factors(file, t, log);
}

/* ---- temperatures ---------------------------------------------------------------------------- */

static double stated_temperature(const text_table *t)
{
    return t->has_own_condition ? t->header.value[HEADER_TEMPERATURE] : (double)NAN;
}

/* Temperatures that lines above the tables, or names, state. */
typedef struct stated_temperatures {
    size_t n_tables;         /* number of tables with one */
    const text_table *first; /* first of these tables */
    bool differ;
} stated_temperatures;

static stated_temperatures find_stated_temperatures(const text_file *file)
{
    stated_temperatures found = {0};
    for (size_t i = 0; i < file->n_tables; i++) {
        const double kelvin = stated_temperature(&file->tables[i]);
        if (isnan(kelvin))
            continue;
        found.first = found.n_tables++ == 0 ? &file->tables[i] : found.first;
        found.differ = found.differ || fabs(kelvin - stated_temperature(found.first)) > 0.01;
    }
    return found;
}

/* Warns of tables that have no temperature of their own among tables that have different ones. */
static void warn_inherited_temperature(const text_file *file, wt_log *log)
{
    for (size_t i = 0; i < file->n_tables; i++) {
        const text_table *const t = &file->tables[i];
        if (isnan(stated_temperature(t)) && text_table_column(t, WT_Q_TEMPERATURE, -1) == NULL &&
            !isnan(t->header.value[HEADER_TEMPERATURE]))
            wt_log_add(log, WT_WARNING, file->name, format_line_position(t->names_line).text,
                       "no temperature above this table, but above others: %.2f degC of the table "
                       "before it is used",
                       t->header.value[HEADER_TEMPERATURE] - WT_ZERO_CELSIUS);
    }
}

wt_status sweep_check_temperatures(const text_file *file, const wt_read_options *options,
                                   wt_log *log, wt_error *err)
{
    const stated_temperatures found = find_stated_temperatures(file);
    if (found.differ)
        warn_inherited_temperature(file, log);
    if (isnan(options->temperature) || found.n_tables == 0)
        return WT_OK;
    const double first = stated_temperature(found.first);
    const line_position_text place = format_line_position(found.first->names_line);
    if (found.differ) {
        wt_fail(err, WT_E_ARG, "one temperature is given for %zu tables that state their own",
                found.n_tables);
        wt_error_place(err, "table at %s", place.text);
        wt_error_found(err, "--temperature %gdegC, and %g degC in the file",
                       options->temperature - WT_ZERO_CELSIUS, first - WT_ZERO_CELSIUS);
        wt_error_advice(err, "leave --temperature out: it is for files that state none");
        return WT_E_ARG;
    }
    if (fabs(first - options->temperature) > 0.01)
        wt_log_add(
            log, WT_WARNING, file->name, place.text,
            "the file states a temperature of %.2f degC, which is used; --temperature is for "
            "files that state none",
            first - WT_ZERO_CELSIUS);
    return WT_OK;
}

/* Returns the mean logarithm of the modulus of an isotherm; NaN if it has no storage modulus. */
static double mean_log_modulus(const wt_isotherm *isotherm)
{
    double sum = 0;
    for (size_t i = 0; i < isotherm->n; i++)
        sum += log(isotherm->storage_modulus[i]);
    return sum / (double)isotherm->n;
}

void sweep_warn_shared_temperature(const text_file *file, const wt_read_options *options,
                                   const wt_sweep *sweep, wt_log *log)
{
    /* repeated measurements at one temperature are closer than a factor of 2 */
    static const double most = M_LN2;
    double low = (double)INFINITY, high = -(double)INFINITY;
    size_t n = 0;
    if (isnan(options->temperature))
        return;
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const wt_isotherm *const s = &sweep->isotherms[i];
        if (s->sample != NULL && file->samples.n > 1)
            return;
        if (fabs(s->temperature - options->temperature) > 1e-6 || !isnan(s->temperature_spread))
            continue;
        low = fmin(low, mean_log_modulus(s));
        high = fmax(high, mean_log_modulus(s));
        n++;
    }
    if (n > 1 && high - low > most)
        wt_log_add(
            log, WT_WARNING, file->name, NULL,
            "one temperature, %.2f degC, is given for %zu isotherms of this file whose moduli "
            "differ by a factor of %.2g: state the temperature of each in a line above its "
            "table, such as \"Temperature: 20 degC\"",
            options->temperature - WT_ZERO_CELSIUS, n, exp(high - low));
}
