/* What must be said with the answer: what the numbers rest on and what they leave out.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "flow/answer/answer.h"
#include "flow/job/tables.h"

#include "base/clocale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char question[] = "What must be kept in mind?";

/* An indentation feels what is below a layer when it goes deeper than this share of it (Bueckle's
 * rule for films). */
#define DEEP_SHARE 0.1

/* Median of a column over the accepted curves; NaN if there are none. */
static double median_accepted(const wt_table *table, const char *column)
{
    size_t rows = wt_table_n_rows(table), n = 0;
    double *values = malloc((rows + 1) * sizeof *values), median = (double)NAN;
    if (values == NULL)
        return (double)NAN;
    for (size_t i = 0; i < rows; i++) {
        double value = flow_table_get(table, i, column);
        if (!isnan(value) && strcmp(flow_table_get_text(table, i, "verdict"), "accepted") == 0)
            values[n++] = value;
    }
    if (n > 0) {
        flow_sort(values, n);
        median = (values[(n - 1) / 2] + values[n / 2]) / 2;
    }
    free(values);
    return median;
}

/* "3 poor_fit, 1 saturated" of the rejected curves. */
static size_t list_rejected(const wt_table *table, char *text, size_t size)
{
    size_t counts[WT_CURVE_UNREADABLE + 1] = {0}, total = 0, used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        const char *verdict = flow_table_get_text(table, i, "verdict");
        for (int v = WT_CURVE_ACCEPTED + 1; v <= WT_CURVE_UNREADABLE; v++)
            if (strcmp(verdict, wt_curve_verdict_id((wt_curve_verdict)v)) == 0)
                counts[v]++;
    }
    for (int v = WT_CURVE_ACCEPTED + 1; v <= WT_CURVE_UNREADABLE; v++) {
        total += counts[v];
        if (counts[v] > 0 && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%zu %s", used > 0 ? ", " : "",
                                     counts[v], wt_curve_verdict_text((wt_curve_verdict)v));
    }
    return total;
}

static wt_status indentation_caveats(const flow_story *story, wt_table *table, wt_error *err)
{
    static const char *const names[2] = {"indentation/bulk", "indentation/track"};
    static const char *const words[2] = {"bulk", "wear-track"};
    wt_status status = WT_OK;
    for (int g = 0; status == WT_OK && g < 2; g++) {
        const wt_table *t = wt_result_find(story->result, names[g]);
        if (t == NULL)
            continue;
        char reasons[512];
        size_t rejected = list_rejected(t, reasons, sizeof reasons);
        const char *spots = wt_table_key(t, "spots");
        if (rejected > 0)
            status = flow_answer_add(table, err, question, "caveat",
                                     "%zu of %zu %s curves were rejected: %s.", rejected,
                                     wt_table_n_rows(t), words[g], reasons);
        if (status == WT_OK && spots != NULL && strcmp(spots, "named") != 0)
            status = flow_answer_add(table, err, question, "caveat",
                                     "Spots of the %s curves (%s): if some are of one place, they "
                                     "are not independent and the intervals are too narrow.",
                                     words[g], spots);
    }
    return status;
}

/* Relative stated error of the spring constant; 0 if none is stated. */
static double lever_error(const wt_table *indentation)
{
    wt_estimate k = flow_key(indentation, "spring_constant");
    double error = k.standard_error / k.value;
    return error > 0 ? error : 0;
}

/* What an error of calibration does: to a modulus by its gain, to the ratio only if the cantilevers
 * were calibrated separately, or as far as the gains differ. */
static wt_status calibration_caveats(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *bulk = wt_result_find(story->result, "indentation/bulk");
    const wt_table *track = wt_result_find(story->result, "indentation/track");
    const wt_table *const both[2] = {bulk, track};
    static const char *const words[2] = {"bulk", "wear-track"};
    double gain[2] = {(double)NAN, (double)NAN};
    wt_status status = WT_OK;
    for (int g = 0; status == WT_OK && g < 2; g++) {
        if (both[g] == NULL || isnan(gain[g] = median_accepted(both[g], "sensitivity_gain")))
            continue;
        double k = lever_error(both[g]);
        char lever[96] = "No error of the spring constant is stated";
        if (k > 0)
            clocale_print(lever, sizeof lever, "The stated error of the spring constant is %.2g %%",
                          100 * k);
        status = flow_answer_add(table, err, question, "caveat",
                                 "An error of 1 %% in the deflection sensitivity changes the %s "
                                 "modulus by %.3g %%, one of the spring constant by about as much "
                                 "as itself. %s. The interval of the modulus does not include "
                                 "errors of sensitivity, spring constant and tip.",
                                 words[g], gain[g], lever);
    }
    if (status != WT_OK || isnan(gain[0]) || isnan(gain[1]))
        return status;
    double k[2] = {flow_key(bulk, "spring_constant").value,
                   flow_key(track, "spring_constant").value};
    if (fabs(k[0] - k[1]) <= 1e-9 * k[0])
        return flow_answer_add(table, err, question, "caveat",
                               "Track and bulk have the same spring constant: if it is one "
                               "cantilever, its error cancels in the ratio, and 1 %% of "
                               "sensitivity changes the ratio by %.2g %% only.",
                               fabs(gain[1] - gain[0]));
    char which[256] = "";
    if (!isnan(k[0]) && !isnan(k[1]))
        snprintf(which, sizeof which, " (bulk %s, track %s)", flow_say(k[0], "N/m").text,
                 flow_say(k[1], "N/m").text);
    return flow_answer_add(table, err, question, "caveat",
                           "The spring constants of the curves differ%s: they were calibrated "
                           "separately, so errors of spring constant and sensitivity do not cancel "
                           "in the ratio, and its interval does not include them.",
                           which);
}

/* A temperature that the case does not say is taken from the material. */
static wt_status temperature_caveats(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *friction = wt_result_find(story->result, "friction");
    const wt_table *dma = wt_result_find(story->result, "dma_comparison");
    wt_status status = WT_OK;
    if (friction != NULL && isnan(story->c->sliding.temperature.value))
        status =
            isnan(flow_key(friction, "temperature").value)
                ? flow_answer_add(table, err, question, "caveat",
                                  "Neither the case nor its material says a temperature: friction "
                                  "is that at the temperature the material was given for.")
                : flow_answer_add(table, err, question, "caveat",
                                  "The case does not say the temperature of sliding: friction is "
                                  "that at the reference temperature of the material, %s.",
                                  flow_say_celsius(flow_key(friction, "temperature").value).text);
    if (status == WT_OK && dma != NULL && isnan(story->c->compare.temperature))
        status = flow_answer_add(table, err, question, "caveat",
                                 "The case does not say the temperature of indentation: it is "
                                 "compared with DMA at the reference temperature, %s.",
                                 flow_say_celsius(flow_key(dma, "temperature").value).text);
    return status;
}

/* "The standard errors of the friction include: ...; they do not include the model." */
static wt_status say_includes(const wt_table *of, const char *what, wt_table *table, wt_error *err)
{
    const char *includes = wt_table_key(of, "standard_error_includes");
    const char *lacks = wt_table_key(of, "standard_error_lacks");
    if (includes == NULL)
        return WT_OK;
    return flow_answer_add(table, err, question, "caveat",
                           "The standard errors of the %s include: %s. They do not include the "
                           "model%s%s.",
                           what, includes,
                           lacks != NULL ? ", nor, because no error is stated: " : "",
                           lacks != NULL ? lacks : "");
}

/* The first warnings in full, the others by number. */
static wt_status warnings(const flow_story *story, wt_table *table, wt_error *err)
{
    enum { SHOWN = 5 };
    size_t n = 0;
    wt_status status = WT_OK;
    for (size_t i = 0; status == WT_OK && i < wt_parselog_count(story->log); i++) {
        wt_log_entry entry = wt_parselog_get(story->log, i);
        if (entry.severity != WT_WARNING || ++n > SHOWN)
            continue;
        status = flow_answer_add(table, err, question, "caveat", "Warning%s%s: %s.",
                                 entry.file[0] != '\0' ? " of " : "", wt_path_base(entry.file),
                                 entry.text);
    }
    if (status == WT_OK && n > SHOWN)
        status = flow_answer_add(table, err, question, "caveat",
                                 "%zu more warnings are in the table notes.", n - SHOWN);
    return status;
}

static wt_status comparison_caveats(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *comparison = wt_result_find(story->result, "comparison");
    const wt_table *dma = wt_result_find(story->result, "dma_comparison");
    const char *unit = comparison == NULL ? NULL : wt_table_key(comparison, "unit_of_analysis");
    wt_status status = WT_OK;
    if (unit != NULL && strcmp(unit, "spot") != 0)
        status = flow_answer_add(table, err, question, "caveat",
                                 "The unit of analysis of the comparison is the %s.", unit);
    size_t extrapolated = 0;
    for (size_t i = 0; dma != NULL && i < wt_table_n_rows(dma); i++)
        extrapolated += flow_table_get(dma, i, "extrapolated") > 0;
    if (status == WT_OK && extrapolated > 0)
        status = flow_answer_add(table, err, question, "caveat",
                                 "%zu of %zu comparisons with DMA lie outside the measured "
                                 "frequencies.",
                                 extrapolated, wt_table_n_rows(dma));
    const char *statement = dma == NULL ? NULL : wt_table_key(dma, "material_statement");
    if (status == WT_OK && statement != NULL)
        status =
            flow_answer_add(table, err, question, "caveat", "Comparison with DMA: %s.", statement);
    return status;
}

static wt_status material_caveats(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *shifts = wt_result_find(story->result, "shift_factors");
    wt_status status = WT_OK;
    if (shifts == NULL)
        return WT_OK;
    const char *superposition = wt_table_key(shifts, "superposition");
    const char *straight = wt_table_key(shifts, "wlf_straight");
    size_t undetermined = 0, rows = wt_table_n_rows(shifts);
    for (size_t i = 0; i < rows; i++)
        undetermined += !(flow_table_get(shifts, i, "determined") > 0);
    if (superposition != NULL && strncmp(superposition, "failed", 6) == 0)
        status = flow_answer_add(table, err, question, "caveat",
                                 "Time-temperature superposition %s. What rests on the master "
                                 "curve is doubtful.",
                                 superposition);
    if (status == WT_OK && superposition != NULL && strncmp(superposition, "not", 3) == 0)
        status = flow_answer_add(table, err, question, "caveat",
                                 "The material is known from one isotherm: no time-temperature "
                                 "superposition widens its frequencies.");
    if (status == WT_OK && undetermined > 0)
        status = flow_answer_add(table, err, question, "caveat",
                                 "The shift of %zu of %zu isotherms is not determined by the data; "
                                 "they are not in the master curve.",
                                 undetermined, rows);
    if (status == WT_OK && straight != NULL && strncmp(straight, "yes", 3) == 0)
        status = flow_answer_add(table, err, question, "caveat",
                                 "The shift factors determine only the slope c1/c2 of the WLF law, "
                                 "not c1 and c2: use it inside the measured temperatures.");
    return status;
}

static wt_status friction_caveats(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *friction = wt_result_find(story->result, "friction");
    if (friction == NULL)
        return WT_OK;
    double share = 0;
    for (size_t i = 0; i < wt_table_n_rows(friction); i++)
        share = fmax(share, flow_table_get(friction, i, "extrapolated_share"));
    const char *statement = wt_table_key(friction, "material_statement");
    wt_status status = WT_OK;
    if (share > 0) {
        char percent[32] = "Less than 0.1";
        if (share >= 0.001)
            clocale_print(percent, sizeof percent, share >= 0.1 ? "Up to %.0f" : "Up to %.2g",
                          100 * share);
        status = flow_answer_add(table, err, question, "caveat",
                                 "%s %% of the hysteresis friction comes from frequencies outside "
                                 "the measured range of the material.",
                                 percent);
    }
    if (status == WT_OK && statement != NULL)
        status = flow_answer_add(table, err, question, "caveat", "Friction: %s.", statement);
    if (status == WT_OK)
        status = say_includes(friction, "friction", table, err);
    if (status == WT_OK)
        status = flow_answer_add(table, err, question, "caveat",
                                 "Friction is that of Persson's theory for small strain at one "
                                 "temperature: no flash heating, no strain softening, dry "
                                 "contact.");
    if (status == WT_OK && wt_table_key(friction, "layer_thickness") != NULL)
        status = flow_answer_add(table, err, question, "caveat",
                                 "With the layer, its modulus is the bulk's times one ratio at all "
                                 "frequencies, and the shear stress is scaled by the same ratio; "
                                 "neither is measured at the frequencies of sliding.");
    return status;
}

static wt_status layer_caveats(const flow_story *story, wt_table *table, wt_error *err)
{
    const wt_table *layer = wt_result_find(story->result, "layer");
    if (layer == NULL)
        return WT_OK;
    const char *from = wt_table_key(layer, "critical_energy_from");
    bool calibrated = from != NULL && strncmp(from, "calibrated", 10) == 0;
    wt_estimate energy = flow_key(layer, "critical_energy");
    wt_status status = flow_answer_add(
        table, err, question, "caveat",
        calibrated ? "The critical energy U_c = %s is calibrated so that the observed thickness is "
                     "the balance: the thickness is put in, not predicted."
                   : "The critical energy U_c = %s is given: nothing in this case measures it.",
        flow_say_estimate(energy).text);
    if (status == WT_OK)
        status = say_includes(layer, "thickness", table, err);
    if (status == WT_OK)
        status = flow_answer_add(table, err, question, "caveat",
                                 "The layer model (energy closure, wear by Archard's law) is not "
                                 "validated against measured thicknesses. Its energy is the "
                                 "hysteresis of the bulk alone: the layer does not act back on it, "
                                 "and shearing of the surface is not counted.");
    double thickness = flow_key(layer, "balance_thickness").value;
    const wt_table *roughness = wt_result_find(story->result, "roughness");
    double longest =
        roughness == NULL ? (double)NAN : 1 / flow_table_get(roughness, 0, "wavenumber");
    if (status == WT_OK && isfinite(thickness) && thickness > longest)
        status = flow_answer_add(table, err, question, "caveat",
                                 "The layer is thicker than the longest wave of the roughness "
                                 "reaches (1/q0 = %s): the layer model is outside its range.",
                                 flow_say(longest, "m").text);
    const wt_table *track = wt_result_find(story->result, "indentation/track");
    double depth = track == NULL ? (double)NAN : median_accepted(track, "max_indentation");
    if (status == WT_OK && isfinite(thickness) && thickness > 0 && depth > DEEP_SHARE * thickness)
        status = flow_answer_add(table, err, question, "caveat",
                                 "Indentations in the track go %s deep, %.2g times the thickness "
                                 "of the layer: the bulk below it is felt, so the layer differs "
                                 "more than the ratio says.",
                                 flow_say(depth, "m").text, depth / thickness);
    return status;
}

wt_status flow_caveats(const flow_story *story, wt_table *table, wt_error *err)
{
    wt_status status = WT_OK;
    const size_t n_failures = wt_table_n_rows(story->failures);
    if (n_failures > 0)
        status = flow_answer_add(table, err, question, "caveat",
                                 "%zu files or stages failed and are not in these results; the "
                                 "table failures lists them.",
                                 n_failures);
    if (status == WT_OK)
        status = indentation_caveats(story, table, err);
    if (status == WT_OK)
        status = calibration_caveats(story, table, err);
    if (status == WT_OK)
        status = comparison_caveats(story, table, err);
    if (status == WT_OK)
        status = material_caveats(story, table, err);
    if (status == WT_OK)
        status = friction_caveats(story, table, err);
    if (status == WT_OK)
        status = layer_caveats(story, table, err);
    if (status == WT_OK)
        status = temperature_caveats(story, table, err);
    if (status == WT_OK)
        status = warnings(story, table, err);
    return status;
}
