/* Rows of a result: force curves with their calibration and comparison, material and measured
 * surfaces; and the collection of all rows.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/table/result_row.h"

#include "core/base/number.h"
#include "core/base/text.h"
#include "core/table/finding.h"
#include "core/table/result_rows_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- force curves ---------------------------------------------------------------------------- */

typedef struct verdict_counts {
    size_t of[WT_CURVE_UNREADABLE + 1];
    size_t used, all;
} verdict_counts;

static verdict_counts count_verdicts(const table_view *curves)
{
    verdict_counts counts = {.all = curves->n_rows};
    for (size_t i = 0; i < curves->n_rows; i++) {
        const int verdict = indentation_enum(curves, i, INDENTATION_VERDICT);
        if (verdict >= 0 && verdict <= WT_CURVE_UNREADABLE)
            counts.of[verdict]++;
        counts.used += verdict >= WT_CURVE_ACCEPTED && verdict <= WT_CURVE_DOUBTFUL ? 1 : 0;
    }
    return counts;
}

static const char *verdict_text(int verdict)
{
    static const char *const texts[] = {
#define VERDICT_TEXT(name, id, text) text,
        WT_CURVE_VERDICT_LIST(VERDICT_TEXT)
#undef VERDICT_TEXT
    };
    return texts[verdict];
}

/* Numbers of accepted, wide and doubtful curves, and why the others are rejected. */
static void add_counts(rows_source *s, const table_view *curves, int level, const char *name)
{
    const verdict_counts counts = count_verdicts(curves);
    char text[64];
    snprintf(text, sizeof text, "%zu of %zu", counts.used, counts.all);
    result_row *row = rows_add_text(s, level, text, "%s", name);
    rows_note(row, "%zu accepted, %zu wide, %zu doubtful", counts.of[WT_CURVE_ACCEPTED],
              counts.of[WT_CURVE_WIDE], counts.of[WT_CURVE_DOUBTFUL]);
    if (counts.used == counts.all)
        return;
    snprintf(text, sizeof text, "%zu", counts.all - counts.used);
    row = rows_add_text(s, 1, text, "curves rejected");
    for (int v = WT_CURVE_DOUBTFUL + 1; v <= WT_CURVE_UNREADABLE; v++)
        if (counts.of[v] > 0)
            clocale_append(row->note, sizeof row->note, "%s%zu %s",
                           row->note[0] != '\0' ? ", " : "", counts.of[v], verdict_text(v));
}

static void add_group(rows_source *s, size_t i)
{
    const table_view *groups = &s->values.groups;
    const result_value modulus = result_value_group(&s->values, i);
    const char *group = modulus_groups_text(groups, i, MODULUS_GROUPS_GROUP);
    const double n = modulus_groups_get(groups, i, MODULUS_GROUPS_N),
                 spots = modulus_groups_get(groups, i, MODULUS_GROUPS_N_SPOTS);
    const bool alone = groups->n_rows == 1;
    result_row *row;
    if (isnan(modulus.number.value))
        row = rows_add_text(s, 0, "none", alone ? "Young's modulus" : "%s", group);
    else if (alone)
        row = rows_add_value(s, 0, &modulus, "Young's modulus");
    else
        row = rows_add_value(s, 0, &modulus, group);
    if (isnan(modulus.number.value))
        rows_note(row, "no curve has a modulus");
    else
        rows_note(row, "%.0f curve%s, %.0f spot%s%s", n, n == 1 ? "" : "s", spots,
                  spots == 1 ? "" : "s", isnan(modulus.low) ? ": no interval" : "");
    table_view curves;
    if (table_bind_result(s->result, &indentation_schema, group, &curves, NULL) != WT_OK ||
        curves.table == NULL)
        return;
    if (!isnan(modulus.number.value) &&
        isnan(indentation_value(&curves, INDENTATION_KEY_RANGE_ERROR).value))
        clocale_append(row->note, sizeof row->note, "; range of the fit not tested");
    rows_reason(row, "errors that no curve shows",
                indentation_key_text(&curves, INDENTATION_KEY_NOT_SHOWN));
    add_counts(s, &curves, 1, "curves used");
    const char *const assumed = indentation_key_text(&curves, INDENTATION_KEY_ASSUMED);
    if (assumed != NULL)
        rows_note(rows_add_text(s, 1, "", "errors assumed"), "%s", assumed);
}

static void add_ratio(rows_source *s, const table_view *v)
{
    if (v->n_rows == 0)
        return;
    finding findings[FINDING_QUESTIONS];
    (void)findings_compute(&s->values, findings);
    const finding *const differs = &findings[FINDING_TRACK_DIFFERS];
    const char *const reason = differs->value.verdict.reason;
    const bool stated = differs->verdict == FINDING_NOT_ENOUGH_DATA && reason[0] != '\0';
    result_row *row = rows_add_value(s, 0, &differs->value, "track / bulk");
    rows_note(row, "%s%s%s%s", finding_verdict_text(differs->verdict), finding_side_text(differs),
              stated ? ": " : "", stated ? reason : "");
    rows_reason(row, "is the track different", reason);
    rows_reason(row, "how to decide it", differs->value.remedy);
    rows_reason(row, "what else would explain it",
                comparison_key_text(v, COMPARISON_KEY_WOULD_EXPLAIN));
}

static void add_sensitivity(rows_source *s, const table_view *v)
{
    const wt_estimate value = sensitivity_value(v, SENSITIVITY_KEY_SENSITIVITY),
                      factor = sensitivity_value(v, SENSITIVITY_KEY_FACTOR);
    const slope_direction direction =
        (slope_direction)sensitivity_key_enum(v, SENSITIVITY_KEY_DIRECTION);
    const char *option = sensitivity_key_text(v, SENSITIVITY_KEY_INDENT),
               *compare = sensitivity_key_text(v, SENSITIVITY_KEY_COMPARE);
    result_row *row = rows_add_number(s, 0, rows_estimate(value), "deflection sensitivity");
    for (size_t i = 0; i < v->n_rows; i++)
        if (sensitivity_enum(v, i, SENSITIVITY_DIRECTION) == (int)direction)
            rows_note(row, "%.0f curve%s, %s", sensitivity_get(v, i, SENSITIVITY_N),
                      sensitivity_get(v, i, SENSITIVITY_N) == 1 ? "" : "s",
                      direction == SLOPE_OF_BOTH ? "approach and retract"
                                                 : slope_direction_text(direction));
    if (!isnan(factor.value))
        rows_add_number(s, 0, rows_estimate(factor), "over that of the file");
    rows_add_verdict(s, sensitivity_key_listed(v, SENSITIVITY_KEY_VERDICT), "slope");
    if (option != NULL)
        rows_add_text(s, 1, "", "for weartrack indent: %s", option);
    if (compare != NULL)
        rows_add_text(s, 1, "", "for weartrack compare: %s", compare);
}

static void add_spot(rows_source *s, const table_view *v)
{
    if (v->n_rows == 0)
        return;
    rows_add_verdict(s, spot_key_listed(v, SPOT_KEY_VERDICT), "smooth enough for the depth");
    rows_add_number(s, 0,
                    rows_number(spot_get(v, 0, SPOT_ROUGHNESS), spot_get(v, 0, SPOT_ROUGHNESS_LOW),
                                spot_get(v, 0, SPOT_ROUGHNESS_HIGH), "m"),
                    "rms roughness");
    result_row *row =
        rows_add_number(s, 0,
                        rows_number(spot_get(v, 0, SPOT_RATIO), spot_get(v, 0, SPOT_RATIO_LOW),
                                    spot_get(v, 0, SPOT_RATIO_HIGH), "1"),
                        "roughness / depth");
    rows_note(row, "limit %s", rows_short(spot_get(v, 0, SPOT_LIMIT), "1").value);
}

static void add_track_layer(rows_source *s, const table_view *v)
{
    const wt_estimate thickness = track_layer_value(v, TRACK_LAYER_KEY_THICKNESS);
    const char *allowed = track_layer_key_text(v, TRACK_LAYER_KEY_ALLOWED);
    const double low = track_layer_value(v, TRACK_LAYER_KEY_LOW).value,
                 high = track_layer_value(v, TRACK_LAYER_KEY_HIGH).value;
    if (isnan(thickness.value) && isnan(low))
        return;
    result_row *row = rows_add_number(
        s, 0, rows_number(thickness.value, low, isnan(high) ? (double)INFINITY : high, "m"),
        "layer by the curves");
    rows_reason(row, "thickness that the curves allow", allowed);
    rows_reason(row, "curves and theory", track_layer_key_text(v, TRACK_LAYER_KEY_AGREE));
}

static void rows_of_curves(rows_source *s)
{
    static const struct {
        const table_schema *schema;
        void (*add)(rows_source *s, const table_view *view);
    } parts[] = {{&sensitivity_schema, add_sensitivity},
                 {&spot_schema, add_spot},
                 {&comparison_schema, add_ratio}};
    table_view view;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (rows_bind(s, parts[i].schema, &view))
            parts[i].add(s, &view);
    for (size_t i = 0; i < s->values.groups.n_rows; i++)
        add_group(s, i);
    for (size_t i = 0; i < wt_result_n_tables(s->result) && s->values.groups.n_rows == 0; i++) {
        const char *const name = wt_table_name(wt_result_table(s->result, i));
        const size_t length = strlen(indentation_schema.name);
        if (strncmp(name, indentation_schema.name, length) == 0 &&
            table_bind_result(s->result, &indentation_schema, name + length, &view, NULL) ==
                WT_OK &&
            view.table != NULL) {
            char label[64];
            snprintf(label, sizeof label, "%s curves used", name + length);
            add_counts(s, &view, 0, label);
        }
    }
    if (rows_bind(s, &track_layer_schema, &view))
        add_track_layer(s, &view);
}

/* ---- material and surface -------------------------------------------------------------------- */

static void note_law(result_row *row, const table_view *v)
{
    const wt_estimate c1 = shift_factors_value(v, SHIFT_FACTORS_KEY_WLF_C1),
                      c2 = shift_factors_value(v, SHIFT_FACTORS_KEY_WLF_C2);
    if (!isnan(c1.value))
        rows_note(row, "C1 = %s, C2 = %s", rows_short(c1.value, "1").value,
                  rows_short(c2.value, "K").value);
}

static result_row *add_superposition(rows_source *s, const table_view *v, const char *name)
{
    const listed_text verdict = shift_factors_key_listed(v, SHIFT_FACTORS_KEY_SUPERPOSITION);
    result_row *row = rows_add_verdict(s, verdict, name);
    row->open = verdict.value != WT_SUPERPOSITION_HOLDS;
    return row;
}

static double largest_temperature(const table_view *v, double sign)
{
    double most = (double)NAN;
    for (size_t i = 0; i < v->n_rows; i++)
        most = fmax(most, sign * shift_factors_get(v, i, SHIFT_FACTORS_TEMPERATURE));
    return sign * most;
}

static void add_prony(rows_source *s)
{
    table_view prony;
    if (!rows_bind(s, &prony_schema, &prony))
        return;
    const wt_estimate modulus = prony_value(&prony, PRONY_KEY_EQUILIBRIUM_MODULUS);
    const char *deformation = prony_key_text(&prony, PRONY_KEY_DEFORMATION);
    const double from = prony_value(&prony, PRONY_KEY_FREQUENCY_MIN).value,
                 to = prony_value(&prony, PRONY_KEY_FREQUENCY_MAX).value;
    result_row *row = rows_add_number(s, 0, rows_estimate(modulus), "equilibrium modulus");
    if (modulus.value == 0)
        rows_note(row, "not determined by the data");
    else if (deformation != NULL)
        rows_note(row, "%s%s", deformation,
                  isnan(modulus.standard_error) ? "; error not known: no interval" : "");
    char text[64];
    snprintf(text, sizeof text, "%zu terms", prony.n_rows);
    row = rows_add_text(s, 0, text, "Prony series");
    rows_note(row, "%s to %s rad/s", rows_short(from, "1").value, rows_short(to, "1").value);
    if (rows_bind(s, &prony_reduced_schema, &prony)) {
        snprintf(text, sizeof text, "%zu terms", prony.n_rows);
        rows_add_text(s, 1, text, "reduced");
    }
}

/* Adds the isotherm that moves a shift farthest out of its interval if it is left out. */
static void add_influence(rows_source *s)
{
    table_view v;
    size_t worst = SIZE_MAX;
    if (!rows_bind(s, &influences_schema, &v))
        return;
    for (size_t i = 0; i < v.n_rows; i++)
        if (influences_get(&v, i, INFLUENCES_OUTSIDE) > 0 &&
            (worst == SIZE_MAX || fabs(influences_get(&v, i, INFLUENCES_CHANGE)) >
                                      fabs(influences_get(&v, worst, INFLUENCES_CHANGE))))
            worst = i;
    if (worst == SIZE_MAX) {
        rows_add_text(s, 1, "none", "isotherm to measure again");
        return;
    }
    result_row *const row = rows_add_text(
        s, 1, rows_short(influences_get(&v, worst, INFLUENCES_TEMPERATURE), "degC").value,
        "isotherm to measure again");
    rows_note(row, "without it log aT at %s changes by %.2g",
              rows_short(influences_get(&v, worst, INFLUENCES_CHANGE_AT), "degC").value,
              influences_get(&v, worst, INFLUENCES_CHANGE));
}

static void add_shifts(rows_source *s, const table_view *v)
{
    const wt_estimate c1 = shift_factors_value(v, SHIFT_FACTORS_KEY_WLF_C1),
                      energy = shift_factors_value(v, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY),
                      reference = shift_factors_value(v, SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE);
    const char *const sample = shift_factors_key_text(v, SHIFT_FACTORS_KEY_SAMPLE);
    const double low = rows_plain_key(shift_factors_key_text(v, SHIFT_FACTORS_KEY_MISFIT_LOW)),
                 high = rows_plain_key(shift_factors_key_text(v, SHIFT_FACTORS_KEY_MISFIT_HIGH));
    size_t odd = 0;
    for (size_t i = 0; i < v->n_rows; i++)
        odd += shift_factors_get(v, i, SHIFT_FACTORS_DETERMINED) > 0 ? 0 : 1;
    clocale_append(s->rows->heading, sizeof s->rows->heading, "%s%s%zu isotherm%s, %s",
                   sample != NULL ? sample : "", sample != NULL ? ": " : "", v->n_rows,
                   v->n_rows == 1 ? "" : "s", rows_short(largest_temperature(v, -1), "degC").value);
    if (v->n_rows > 1)
        clocale_append(s->rows->heading, sizeof s->rows->heading, " to %s",
                       rows_short(largest_temperature(v, 1), "degC").value);
    result_row *row = add_superposition(s, v, "superposition");
    if (!isnan(high) && low > 0)
        rows_note(row, "misfit %.1f to %.1f %%", 100 * low, 100 * high);
    else if (!isnan(high))
        rows_note(row, "misfit below %.1f %%", round_up_percent(high));
    const double from = shift_factors_value(v, SHIFT_FACTORS_KEY_HOLDS_FROM).value,
                 to = shift_factors_value(v, SHIFT_FACTORS_KEY_HOLDS_TO).value;
    if (!isnan(from)) {
        row = rows_add_text(s, 1, rows_short(from, "degC").value, "holds from");
        rows_note(row, "to %s", rows_short(to, "degC").value);
    }
    if (odd > 0 && v->n_rows > 1) {
        char text[64];
        snprintf(text, sizeof text, "%zu of %zu", odd, v->n_rows);
        rows_add_text(s, 1, text, "isotherms not joined");
    }
    add_influence(s);
    if (!isnan(c1.value)) {
        row = rows_add_number(s, 0, rows_estimate(c1), "WLF C1");
        rows_note(row, "at %s", rows_short(reference.value, "degC").value);
        rows_add_number(s, 0, rows_estimate(shift_factors_value(v, SHIFT_FACTORS_KEY_WLF_C2)),
                        "WLF C2");
    }
    if (!isnan(energy.value))
        rows_add_number(s, 0, rows_estimate(energy), "activation energy");
    add_prony(s);
}

/* Each of several samples has a table of its own. */
static void add_samples(rows_source *s)
{
    static const char prefix[] = "shift_factors/";
    for (size_t i = 0; i < wt_result_n_tables(s->result); i++) {
        const wt_table *const table = wt_result_table(s->result, i);
        table_view view;
        if (strncmp(wt_table_name(table), prefix, strlen(prefix)) != 0 ||
            table_bind(table, &shift_factors_schema, "", &view, NULL) != WT_OK)
            continue;
        const char *sample = shift_factors_key_text(&view, SHIFT_FACTORS_KEY_SAMPLE);
        char name[64];
        snprintf(name, sizeof name, "%s", sample != NULL ? sample : wt_table_name(table));
        note_law(add_superposition(s, &view, name), &view);
    }
}

static void add_transition(rows_source *s, const table_view *v)
{
    const wt_estimate factor = glass_transition_value(v, GLASS_TRANSITION_KEY_FACTOR_PEAK),
                      loss = glass_transition_value(v, GLASS_TRANSITION_KEY_LOSS_PEAK),
                      onset = glass_transition_value(v, GLASS_TRANSITION_KEY_ONSET),
                      energy = glass_transition_value(v, isnan(factor.value)
                                                             ? GLASS_TRANSITION_KEY_LOSS_ENERGY
                                                             : GLASS_TRANSITION_KEY_FACTOR_ENERGY);
    const double at = glass_transition_value(v, GLASS_TRANSITION_KEY_ANGULAR_FREQUENCY).value;
    const struct {
        wt_estimate estimate;
        const char *note;
    } rows[] = {{factor, "peak of tan delta"},
                {loss, "peak of the loss modulus"},
                {onset, "onset of the storage modulus"}};
    if (!isnan(at)) {
        rows_condition(s, at, "rad/s");
    }
    if (isnan(factor.value) && isnan(loss.value))
        rows_note(rows_add_text(s, 0, "none", "glass transition"), "in the range measured");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (!isnan(rows[i].estimate.value))
            rows_note(rows_add_number(s, 0, rows_temperature(rows[i].estimate), "glass transition"),
                      "%s", rows[i].note);
    if (!isnan(energy.value))
        rows_add_number(s, 0, rows_estimate(energy), "activation energy");
}

static void add_payne(rows_source *s, const table_view *v)
{
    const double none = (double)NAN;
    const char letter = payne_key_enum(v, PAYNE_KEY_DEFORMATION) == WT_SHEAR ? 'G' : 'E';
    for (size_t i = 0; i < v->n_rows; i++) {
        const double tenth = payne_get(v, i, PAYNE_STRAIN_TENTH);
        result_row *row = rows_add_number(
            s, 0, rows_number(payne_get(v, i, PAYNE_STORAGE_START), none, none, "Pa"),
            "%c' at %s strain", letter, format_percent(payne_get(v, i, PAYNE_STRAIN_MIN)).text);
        rows_note(row, "at %s",
                  rows_short(payne_get(v, i, PAYNE_ANGULAR_FREQUENCY), "rad/s").value);
        rows_add_number(s, 1, rows_number(payne_get(v, i, PAYNE_STORAGE_END), none, none, "Pa"),
                        "at %s strain", format_percent(payne_get(v, i, PAYNE_STRAIN_MAX)).text);
        if (!isnan(tenth))
            rows_add_number(s, 1, rows_number(tenth, none, none, "%"), "strain, a tenth lost");
    }
}

static void rows_of_material(rows_source *s)
{
    static const struct {
        const table_schema *schema;
        void (*add)(rows_source *s, const table_view *view);
    } parts[] = {{&shift_factors_schema, add_shifts},
                 {&glass_transition_schema, add_transition},
                 {&payne_schema, add_payne}};
    table_view view;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (rows_bind(s, parts[i].schema, &view))
            parts[i].add(s, &view);
    add_samples(s);
}

static void rows_of_surface(rows_source *s)
{
    table_view v;
    if (!rows_bind(s, &power_spectrum_schema, &v))
        return;
    const row_number hurst = rows_of_keys(&v, POWER_SPECTRUM_KEY_HURST),
                     roll_off = rows_of_keys(&v, POWER_SPECTRUM_KEY_ROLL_OFF);
    const wt_estimate anisotropy = power_spectrum_value(&v, POWER_SPECTRUM_KEY_ANISOTROPY);
    const char *law = power_spectrum_key_text(&v, POWER_SPECTRUM_KEY_LAW),
               *scans = power_spectrum_key_text(&v, POWER_SPECTRUM_KEY_N_SCANS);
    rows_add_number(s, 0, rows_estimate(power_spectrum_value(&v, POWER_SPECTRUM_KEY_RMS_HEIGHT)),
                    "rms height");
    if (scans != NULL)
        rows_note(&s->rows->rows[s->rows->n - 1], "%s scan%s", scans,
                  scans[0] == '1' && scans[1] == '\0' ? "" : "s");
    result_row *row = rows_add_number(
        s, 0, rows_estimate(power_spectrum_value(&v, POWER_SPECTRUM_KEY_RMS_SLOPE)), "rms slope");
    rows_reason(row, "standard errors include",
                power_spectrum_key_text(&v, POWER_SPECTRUM_KEY_INCLUDES));
    rows_reason(row, "no error known of", power_spectrum_key_text(&v, POWER_SPECTRUM_KEY_LACKS));
    const double from = power_spectrum_value(&v, POWER_SPECTRUM_KEY_FROM).value,
                 to = power_spectrum_value(&v, POWER_SPECTRUM_KEY_TO).value;
    char text[64];
    clocale_print(text, sizeof text, "%s to %s rad/m", rows_short(from, "1").value,
                  rows_short(to, "1").value);
    rows_add_text(s, 0, text, "reliable wavenumbers");
    if (!isnan(hurst.value))
        rows_add_number(s, 0, hurst, "Hurst exponent");
    else
        rows_add_text(s, 0, "none", "Hurst exponent");
    rows_reason(&s->rows->rows[s->rows->n - 1], "self-affine law", law);
    if (!isnan(roll_off.value))
        rows_add_number(s, 0, roll_off, "roll-off wavenumber");
    if (!isnan(anisotropy.value)) {
        row = rows_add_number(s, 0, rows_estimate(anisotropy), "anisotropy");
        rows_reason(row, "directions", power_spectrum_key_text(&v, POWER_SPECTRUM_KEY_DIRECTIONS));
    }
}

/* ---- all rows -------------------------------------------------------------------------------- */

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
