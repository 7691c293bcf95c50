/* Rows of a result: material from DMA, and measured surfaces. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/base/text.h"
#include "core/table/result_rows_parts.h"

#include <math.h>
#include <string.h>

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
    const char *verdict = shift_factors_key_text(v, SHIFT_FACTORS_KEY_SUPERPOSITION);
    result_row *row = rows_add_verdict(s, 0, verdict != NULL ? verdict : "not tested", name);
    row->open =
        shift_factors_key_enum(v, SHIFT_FACTORS_KEY_SUPERPOSITION) != WT_SUPERPOSITION_HOLDS;
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
    clocale_append(s->rows->heading, sizeof s->rows->heading, "%s%s%zu isotherm%s, %s to %s",
                   sample != NULL ? sample : "", sample != NULL ? ": " : "", v->n_rows,
                   v->n_rows == 1 ? "" : "s", rows_short(largest_temperature(v, -1), "degC").value,
                   rows_short(largest_temperature(v, 1), "degC").value);
    result_row *row = add_superposition(s, v, "superposition");
    if (!isnan(high) && low > 0)
        rows_note(row, "misfit %.2g to %.2g %%", 100 * low, 100 * high);
    else if (!isnan(high))
        rows_note(row, "misfit below %.2g %%", 100 * high);
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
            "%c' at %.2g %% strain", letter, 100 * payne_get(v, i, PAYNE_STRAIN_MIN));
        rows_note(row, "at %s",
                  rows_short(payne_get(v, i, PAYNE_ANGULAR_FREQUENCY), "rad/s").value);
        rows_add_number(s, 1, rows_number(payne_get(v, i, PAYNE_STORAGE_END), none, none, "Pa"),
                        "at %.2g %% strain", 100 * payne_get(v, i, PAYNE_STRAIN_MAX));
        if (!isnan(tenth))
            rows_add_number(s, 1, rows_number(tenth, none, none, "%"), "strain, a tenth lost");
    }
}

void rows_of_material(rows_source *s)
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

void rows_of_surface(rows_source *s)
{
    table_view v;
    if (!rows_bind(s, &power_spectrum_schema, &v))
        return;
    const wt_estimate hurst = power_spectrum_value(&v, POWER_SPECTRUM_KEY_HURST),
                      roll_off = power_spectrum_value(&v, POWER_SPECTRUM_KEY_ROLL_OFF),
                      anisotropy = power_spectrum_value(&v, POWER_SPECTRUM_KEY_ANISOTROPY);
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
        rows_add_number(
            s, 0,
            rows_number(hurst.value, power_spectrum_value(&v, POWER_SPECTRUM_KEY_HURST_LOW).value,
                        power_spectrum_value(&v, POWER_SPECTRUM_KEY_HURST_HIGH).value, "1"),
            "Hurst exponent");
    else
        rows_add_text(s, 0, "none", "Hurst exponent");
    rows_reason(&s->rows->rows[s->rows->n - 1], "self-affine law", law);
    if (!isnan(roll_off.value))
        rows_add_number(
            s, 0,
            rows_number(
                roll_off.value, power_spectrum_value(&v, POWER_SPECTRUM_KEY_ROLL_OFF_LOW).value,
                power_spectrum_value(&v, POWER_SPECTRUM_KEY_ROLL_OFF_HIGH).value, roll_off.unit),
            "roll-off wavenumber");
    if (!isnan(anisotropy.value)) {
        row = rows_add_number(s, 0, rows_estimate(anisotropy), "anisotropy");
        rows_reason(row, "directions", power_spectrum_key_text(&v, POWER_SPECTRUM_KEY_DIRECTIONS));
    }
}
