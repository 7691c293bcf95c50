/* Laws as option values, such as "wlf:c1=8.86,...", and the shifts that the user states: by a law,
 * or by a table of an earlier fit or another program.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "dma/law_parse.h"

#include "core/base/param.h"
#include "core/base/text.h"
#include "dma/sweep_input.h"
#include "job/inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- parser of laws -------------------------------------------------------------------------- */

bool flow_has_law_prefix(const flow_law_text *law, const char *text)
{
    return strncmp(text, law->prefix, strlen(law->prefix)) == 0;
}

static wt_status expect_spelling(const flow_law_text *law, wt_error *err)
{
    wt_error_expected(err, "%s%s", law->prefix, law->example);
    return WT_E_ARG;
}

wt_status flow_law_suggest(const flow_law_text *law, const char *text, wt_status status,
                           wt_error *err)
{
    const size_t length = strcspn(text, ":");
    spell_suggestion near = spell_suggestion_begin(text, length);
    spell_suggestion_try(&near, law->prefix, strlen(law->prefix) - 1);
    if (status != WT_E_NOT_FOUND || text[length] != ':' || near.name == NULL)
        return status;
    status = wt_fail(err, WT_E_ARG, "\"%s\" is no file, and no %s", text, law->name);
    wt_error_advice(err, "did you mean %s%s?", law->prefix, law->example);
    return status;
}

static void suggest_parameter(const wt_params *params, const char *name, wt_error *err)
{
    spell_suggestion near = spell_suggestion_begin(name, strlen(name));
    for (size_t i = 0; i < wt_params_count(params); i++) {
        const char *const known = wt_params_get(params, i)->name;
        spell_suggestion_try(&near, known, strlen(known));
    }
    if (near.name != NULL)
        wt_error_advice(err, "did you mean %s?", near.name);
}

wt_status flow_law_parse(const flow_law_text *law, const char *text, void *structure, wt_error *err)
{
    text += strlen(law->prefix);
    char *copy = wt_strdup(text), *rest = NULL;
    uint64_t given = 0;
    wt_status status = WT_OK;
    for (char *item = strtok_r(copy, ",", &rest); status == WT_OK && item != NULL;
         item = strtok_r(NULL, ",", &rest)) {
        char *value = strchr(item, '=');
        if (value == NULL) {
            wt_fail(err, WT_E_ARG, "\"%s\" is not NAME=VALUE", item);
            status = expect_spelling(law, err);
            break;
        }
        *value++ = '\0';
        status = wt_params_set(law->params(), item, structure, value, &given, err);
        if (status == WT_E_NOT_FOUND) {
            wt_fail(err, WT_E_ARG, "%s has no parameter \"%s\"", law->what, item);
            suggest_parameter(law->params(), item, err);
            status = expect_spelling(law, err);
        } else if (status != WT_OK) {
            wt_error_place(err, "%s, %s", law->what, item);
        }
    }
    if (status == WT_OK && param_find_missing(law->params(), given) != NULL) {
        wt_fail(err, WT_E_MISSING, "the %s is not complete", law->name);
        wt_error_found(err, "\"%s\"", text);
        (void)expect_spelling(law, err);
        status = WT_E_MISSING;
    }
    free(copy);
    return status;
}

/* ---- law as an option value ------------------------------------------------------------------ */

static wt_wlf unset_wlf(void)
{
    return (wt_wlf){(double)NAN, (double)NAN, (double)NAN};
}

static const wt_param wlf_rows[] = {
    {PARAM("reference-temperature", wt_wlf, reference_temperature, WT_Q_TEMPERATURE, ABOVE(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "at which log aT is 0"},
    {PARAM("c1", wt_wlf, c1, WT_Q_NONE, ABOVE(0)), .flags = PARAM_REQUIRED | PARAM_NO_OPTION,
     .help = "constant C1, for log10"},
    {PARAM("c2", wt_wlf, c2, WT_Q_TEMPERATURE_DIFFERENCE, ABOVE(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "constant C2"},
};
PARAM_LOCAL_TABLE(wlf_params, wt_wlf, wlf_rows, unset_wlf, NO_PARTS)

typedef struct arrhenius {
    double activation_energy; /* [J/mol] */
} arrhenius;

static arrhenius unset_arrhenius(void)
{
    return (arrhenius){(double)NAN};
}

static const wt_param arrhenius_rows[] = {
    {PARAM("activation-energy", arrhenius, activation_energy, WT_Q_MOLAR_ENERGY, ABOVE(0)),
     .flags = PARAM_REQUIRED | PARAM_NO_OPTION, .help = "activation energy"},
};
PARAM_LOCAL_TABLE(arrhenius_params, arrhenius, arrhenius_rows, unset_arrhenius, NO_PARTS)

static const flow_law_text wlf_text = {.prefix = "wlf:",
                                       .name = "WLF law",
                                       .what = "the WLF law",
                                       .example = "reference-temperature=20degC,c1=8.86,c2=101.6K",
                                       .params = wlf_params};
static const flow_law_text arrhenius_text = {.prefix = "arrhenius:",
                                             .name = "law of Arrhenius",
                                             .what = "the law of Arrhenius",
                                             .example = "activation-energy=80kJ/mol",
                                             .params = arrhenius_params};

static void suggest_law(const char *text, wt_error *err)
{
    static const flow_law_text *const laws[] = {&wlf_text, &arrhenius_text};
    spell_suggestion near = spell_suggestion_begin(text, strcspn(text, ":"));
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++)
        spell_suggestion_try(&near, laws[i]->prefix, strlen(laws[i]->prefix) - 1);
    if (near.name != NULL)
        wt_error_advice(err, "did you mean %.*s?", (int)near.name_length, near.name);
}

wt_status flow_parse_shift_law(const char *text, wt_shift_law *law, wt_error *err)
{
    const double unknown = (double)NAN, room_temperature = 293.15;
    *law = (wt_shift_law){.wlf = unset_wlf(), .activation_energy = unknown, .joint = unknown};
    if (text == NULL)
        return WT_OK;
    wt_status status;
    if (flow_has_law_prefix(&wlf_text, text)) {
        law->kind = WT_LAW_WLF;
        status = flow_law_parse(&wlf_text, text, &law->wlf, err);
    } else if (flow_has_law_prefix(&arrhenius_text, text)) {
        arrhenius a = unset_arrhenius();
        law->kind = WT_LAW_ARRHENIUS;
        law->wlf.reference_temperature =
            room_temperature; /* arbitrary, because differences of shifts do not depend on it */
        status = flow_law_parse(&arrhenius_text, text, &a, err);
        law->activation_energy = a.activation_energy;
    } else {
        status = wt_fail(err, WT_E_ARG, "\"%s\" is no law of shifts", text);
        wt_error_expected(err, "%s%s or %s%s", wlf_text.prefix, wlf_text.example,
                          arrhenius_text.prefix, arrhenius_text.example);
        suggest_law(text, err);
    }
    return status;
}

/* ---- shifts of the isotherms ----------------------------------------------------------------- */

/* A table row belongs to an isotherm within 0.5 K, the stability of a chamber. */
static const double same_temperature = 0.5;

static wt_status set_law_shifts(const wt_shift_law *law, wt_sweep *sweep, wt_error *err)
{
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        wt_isotherm *t = &sweep->isotherms[i];
        t->stated_log_a = wt_shift_law_log_a(law, t->temperature);
        t->shift_is_stated = isfinite(t->stated_log_a);
        if (t->shift_is_stated)
            continue;
        wt_fail(err, WT_E_RANGE, "an isotherm is at or below the pole of the law that is given");
        wt_error_place(err, "shift-law");
        wt_error_found(err, "%.2f degC", t->temperature - WT_ZERO_CELSIUS);
        wt_error_advice(err, "leave it out, or give a law that reaches it");
        return WT_E_RANGE;
    }
    return WT_OK;
}

/* Table of stated shifts with its conversion to kelvin. */
typedef struct shift_rows {
    const wt_table *table;
    size_t temperature, log_a; /* columns */
    double to_kelvin, zero;
} shift_rows;

static double row_temperature(const shift_rows *r, size_t row)
{
    return wt_table_number(r->table, row, r->temperature) * r->to_kelvin + r->zero;
}

static bool has_shift(const shift_rows *r, size_t row)
{
    return isfinite(wt_table_number(r->table, row, r->log_a));
}

/* Returns the first of the rows nearest to a temperature, or the number of rows. *n_alike:
 * number of such rows. */
static size_t find_nearest_rows(const shift_rows *r, double t, size_t *n_alike)
{
    const size_t n = wt_table_n_rows(r->table);
    size_t best = n;
    double away = same_temperature;
    *n_alike = 0;
    for (size_t i = 0; i < n; i++) {
        const double off = fabs(row_temperature(r, i) - t);
        if (off < away || (best == n && off <= away)) {
            away = off;
            best = i;
            *n_alike = 0;
        }
        *n_alike += best < n && row_temperature(r, i) == row_temperature(r, best);
    }
    return best;
}

/* Finds the row of an isotherm. Runs at one temperature use the rows in their order. */
static wt_status find_isotherm_row(const shift_rows *r, const wt_sweep *sweep, size_t isotherm,
                                   size_t *row, wt_error *err)
{
    const double t = sweep->isotherms[isotherm].temperature;
    size_t rank = 0, runs = 0, n_alike;
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        const bool same = sweep->isotherms[i].temperature == t;
        runs += same;
        rank += same && i < isotherm;
    }
    *row = find_nearest_rows(r, t, &n_alike);
    if (n_alike <= 1)
        return WT_OK;
    if (n_alike != runs) {
        wt_fail(err, WT_E_AMBIGUOUS, "the table has %zu shifts for one temperature", n_alike);
        wt_error_place(err, "shifts");
        wt_error_expected(err, "one, or one for each of the isotherms there (%zu)", runs);
        wt_error_found(err, "%.2f degC", row_temperature(r, *row) - WT_ZERO_CELSIUS);
        return WT_E_AMBIGUOUS;
    }
    const double here = row_temperature(r, *row);
    while (rank > 0 || row_temperature(r, *row) != here)
        rank -= row_temperature(r, (*row)++) == here;
    return WT_OK;
}

/* Counts the rows that belong to no isotherm. They probably come from other files. */
static size_t count_unused_rows(const shift_rows *r, const wt_sweep *sweep)
{
    size_t n = 0;
    for (size_t i = 0; i < wt_table_n_rows(r->table); i++) {
        bool used = !has_shift(r, i);
        for (size_t k = 0; k < sweep->n_isotherms && !used; k++)
            used =
                fabs(row_temperature(r, i) - sweep->isotherms[k].temperature) <= same_temperature;
        n += !used;
    }
    return n;
}

/* Sets the vertical shift of an isotherm if the table has one. */
static wt_status set_vertical_shift(const wt_table *table, size_t row, wt_vertical_shift vertical,
                                    wt_isotherm *t, wt_error *err)
{
    const long column = wt_table_find(table, "log_b");
    t->vertical_shift_is_stated = false;
    t->stated_log_b = 0;
    if (!t->shift_is_stated || column < 0 ||
        wt_table_column_kind(table, (size_t)column) == WT_COLUMN_TEXT)
        return WT_OK;
    const double b = wt_table_number(table, row, (size_t)column);
    if (vertical == WT_VERTICAL_NONE && fabs(b) > 0) {
        wt_fail(err, WT_E_ARG, "the table gives vertical shifts, and vertical-shift is none");
        wt_error_place(err, "shifts");
        wt_error_found(err, "log_b = %g at %.2f degC", b, t->temperature - WT_ZERO_CELSIUS);
        wt_error_advice(err, "leave out its column log_b, or give another --vertical-shift");
        wt_error_options(err, "vertical-shift");
        return WT_E_ARG;
    }
    t->vertical_shift_is_stated = isfinite(b);
    t->stated_log_b = t->vertical_shift_is_stated ? b : 0;
    return WT_OK;
}

static wt_status set_table_shifts(const wt_table *table, wt_vertical_shift vertical,
                                  wt_sweep *sweep, wt_log *log, wt_error *err)
{
    const long temperature = wt_table_find(table, "temperature"),
               log_a = wt_table_find(table, "log_a");
    shift_rows r = {.table = table, .to_kelvin = 1};
    size_t given = 0, held = 0;
    if (temperature < 0 || log_a < 0 ||
        wt_table_column_kind(table, (size_t)temperature) == WT_COLUMN_TEXT ||
        wt_table_column_kind(table, (size_t)log_a) == WT_COLUMN_TEXT) {
        wt_fail(err, WT_E_MISSING, "the table of the shifts has not the columns it needs");
        wt_error_place(err, "shifts");
        wt_error_expected(err, "temperature[K] and log_a[1], as weartrack master --save-shifts "
                               "writes them");
        return WT_E_MISSING;
    }
    r.temperature = (size_t)temperature;
    r.log_a = (size_t)log_a;
    wt_status status = wt_unit_to_si(wt_table_column_unit(table, r.temperature), WT_Q_TEMPERATURE,
                                     &r.to_kelvin, &r.zero, err);
    if (status != WT_OK) {
        wt_error_place(err, "shifts");
        return status;
    }
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        wt_isotherm *t = &sweep->isotherms[i];
        size_t row;
        status = find_isotherm_row(&r, sweep, i, &row, err);
        if (status != WT_OK)
            return status;
        t->shift_is_stated = row < wt_table_n_rows(table) && has_shift(&r, row);
        t->stated_log_a = t->shift_is_stated ? wt_table_number(table, row, r.log_a) : 0;
        given += t->shift_is_stated;
        status = set_vertical_shift(table, row, vertical, t, err);
        if (status != WT_OK)
            return status;
        held += t->vertical_shift_is_stated;
    }
    if (given == 0) {
        wt_fail(err, WT_E_MISSING, "the table has a shift of none of the isotherms");
        wt_error_place(err, "shifts");
        wt_error_expected(err, "log_a at temperatures within %g K of theirs", same_temperature);
        return WT_E_MISSING;
    }
    wt_log_add(log, WT_NOTE, NULL, NULL,
               "%zu of %zu shifts are as given, %zu of them with their vertical shift, without "
               "an error of their own; the others are fitted",
               given, sweep->n_isotherms, held);
    const size_t unused = count_unused_rows(&r, sweep);
    if (unused > 0)
        wt_log_add(log, WT_WARNING, NULL, NULL,
                   "%zu of the %zu given shifts are of no isotherm: no temperature within %g "
                   "K of theirs was measured",
                   unused, wt_table_n_rows(table), same_temperature);
    return WT_OK;
}

wt_status flow_set_stated_shifts(const wt_shift_law *law, const wt_table *table,
                                 wt_vertical_shift vertical, wt_sweep *sweep, wt_log *log,
                                 wt_error *err)
{
    wt_status status = law->kind != WT_LAW_NONE ? set_law_shifts(law, sweep, err) : WT_OK;
    if (status == WT_OK && table != NULL)
        status = set_table_shifts(table, vertical, sweep, log, err);
    return status;
}

/* ---- shifts by hand -------------------------------------------------------------------------- */

typedef struct hand_shift {
    double temperature; /* [K] */
    double log_a;
} hand_shift;

static wt_status parse_hand_shift(const char *text, hand_shift *shift, wt_error *err)
{
    const char *const equals = strrchr(text, '=');
    wt_status status = equals == NULL ? WT_E_ARG : WT_OK;
    if (status == WT_OK) {
        char *const temperature = wt_strndup(text, (size_t)(equals - text));
        status = wt_quantity_parse(temperature, WT_Q_TEMPERATURE, &shift->temperature, err);
        free(temperature);
    }
    if (status == WT_OK)
        status = wt_quantity_parse(equals + 1, WT_Q_NONE, &shift->log_a, err);
    if (status == WT_OK && isfinite(shift->log_a))
        return WT_OK;
    wt_fail(err, WT_E_ARG, "\"%s\" is no shift of an isotherm", text);
    wt_error_expected(err, "TEMPERATURE=LOG_AT, such as 25degC=-1.2");
    return WT_E_ARG;
}

wt_status flow_hand_shifts_check(const char *const *texts, size_t n, wt_error *err)
{
    wt_status status = WT_OK;
    hand_shift shift;
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = parse_hand_shift(texts[i], &shift, err);
    return status;
}

/* Sets one shift for the isotherms of the nearest temperature, which several runs may share. */
static wt_status set_hand_shift(const char *text, wt_sweep *sweep, wt_error *err)
{
    hand_shift shift;
    const wt_status status = parse_hand_shift(text, &shift, err);
    if (status != WT_OK)
        return status;
    double away = HUGE_VAL;
    for (size_t i = 0; i < sweep->n_isotherms; i++)
        away = fmin(away, fabs(sweep->isotherms[i].temperature - shift.temperature));
    if (!(away <= same_temperature)) {
        wt_fail(err, WT_E_NOT_FOUND, "no isotherm to shift by hand at this temperature");
        wt_error_place(err, "shift");
        wt_error_expected(err, "a temperature within %g K of an isotherm", same_temperature);
        wt_error_found(err, "%s", text);
        return WT_E_NOT_FOUND;
    }
    for (size_t i = 0; i < sweep->n_isotherms; i++) {
        wt_isotherm *const t = &sweep->isotherms[i];
        if (fabs(t->temperature - shift.temperature) > away)
            continue;
        if (t->shift_is_by_hand) {
            wt_fail(err, WT_E_AMBIGUOUS, "two shifts by hand of one isotherm");
            wt_error_place(err, "shift");
            wt_error_found(err, "%s", text);
            return WT_E_AMBIGUOUS;
        }
        t->shift_is_stated = t->shift_is_by_hand = true;
        t->vertical_shift_is_stated = false;
        t->stated_log_a = shift.log_a;
    }
    return WT_OK;
}

wt_status flow_set_hand_shifts(const char *const *texts, size_t n, wt_sweep *sweep, wt_log *log,
                               wt_error *err)
{
    wt_status status = WT_OK;
    for (size_t i = 0; i < n && status == WT_OK; i++)
        status = set_hand_shift(texts[i], sweep, err);
    if (status == WT_OK && n > 0)
        wt_log_add(log, WT_NOTE, NULL, NULL,
                   "%zu shift%s by hand, without an error of %s own, against the isotherm nearest "
                   "to the reference temperature",
                   n, n > 1 ? "s are" : " is", n > 1 ? "their" : "its");
    return status;
}
