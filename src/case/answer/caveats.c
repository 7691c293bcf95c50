/* Adds the caveats of an answer: assumptions, excluded errors and doubtful data.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/caveats.h"

#include "core/base/array.h"
#include "core/base/clocale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const group_names[2] = {"bulk", "wear-track"};

/* Limit of the indentation depth over the layer thickness. A deeper indentation also deforms the
 * material below the layer (Bueckle's rule for films). */
#define DEEP_SHARE 0.1

/* Curves with the verdict "doubtful" count as accepted: they have a modulus. */
static bool is_usable_curve(const table_view *indentation, size_t row)
{
    return wt_curve_verdict_is_usable(
        (wt_curve_verdict)indentation_enum(indentation, row, INDENTATION_VERDICT));
}

/* Returns the median of a column over the accepted curves, NaN without accepted curves. */
static double accepted_median(const table_view *indentation, indentation_column column)
{
    size_t n = 0;
    double *values = malloc((indentation->n_rows + 1) * sizeof *values), median = (double)NAN;
    if (values == NULL)
        return (double)NAN;
    for (size_t i = 0; i < indentation->n_rows; i++) {
        double value = indentation_get(indentation, i, column);
        if (!isnan(value) && is_usable_curve(indentation, i))
            values[n++] = value;
    }
    if (n > 0)
        median = numbers_median(values, n);
    free(values);
    return median;
}

/* Returns the rest of a sentence "the ... curves ..." on the assignment of curves to spots; NULL if
 * the spots are named. */
static const char *format_spots_caveat(const answer_context *context, const table_view *t)
{
    if (indentation_key_text(t, INDENTATION_KEY_SPOTS) == NULL ||
        indentation_key_enum(t, INDENTATION_KEY_SPOTS) == SPOTS_NAMED)
        return NULL;
    return context->c->compare.map_spots
               ? "curves without a named spot count as a spot for each place, as the case says: if "
                 "places are near to each other, the intervals are too narrow"
               : "curves without a named spot count as one spot for each file: if some files are "
                 "of one place, they are not independent and the intervals are too narrow";
}

/* Adds the text of a key that is the same for both groups. */
static void add_shared_text(answer_context *context, indentation_key key, const char *begin)
{
    for (int g = 0; g < 2; g++) {
        const char *text = indentation_key_text(&context->indentation[g], key);
        if (text == NULL)
            continue;
        answer_add_caveat(context, CAVEAT_CONDITIONS, "%s: %s.", begin, text);
        return;
    }
}

/* A caveat that holds for both groups is added once. */
static void indentation_caveats(answer_context *context)
{
    char reasons[2][512];
    size_t rejected[2];
    const char *spots[2];
    for (int g = 0; g < 2; g++) {
        const table_view *t = &context->indentation[g];
        rejected[g] = format_rejected_curves(t, reasons[g], sizeof reasons[g]);
        spots[g] = format_spots_caveat(context, t);
    }
    for (int g = 0; g < 2; g++) {
        char text[512];
        text_builder t = {text, sizeof text, 0};
        if (context->indentation[g].table != NULL &&
            append_spectrum_mismatch(&t, &context->indentation[g], g == 0 ? "bulk" : "track"))
            answer_add_caveat(context, CAVEAT_VERDICT, "%s.", text);
    }
    add_shared_text(context, INDENTATION_KEY_ASSUMED,
                    "The interval of a modulus holds errors that are assumed");
    add_shared_text(context, INDENTATION_KEY_NOT_SHOWN,
                    "No indentation curve shows, and no interval of a modulus holds");
    const bool both = spots[0] != NULL && spots[1] == spots[0];
    for (int g = 0; g < (both ? 1 : 2); g++)
        if (spots[g] != NULL)
            answer_add_caveat(context, CAVEAT_VERDICT, "The %s %s.",
                              both ? "bulk and wear-track" : group_names[g], spots[g]);
    for (int g = 0; g < 2; g++)
        if (rejected[g] > 0)
            answer_add_caveat(context, CAVEAT_CONDITIONS, "%zu of %zu %s curves were rejected: %s.",
                              rejected[g], context->indentation[g].n_rows, group_names[g],
                              reasons[g]);
}

/* Example: "moduli by 1.3 %", or one number for each group. */
static void format_gains(const double gain[2], char *text, size_t size)
{
    if (isnan(gain[0]) || isnan(gain[1]))
        clocale_print(text, size, "%s modulus by %.2g %%", group_names[isnan(gain[0]) ? 1 : 0],
                      isnan(gain[0]) ? gain[1] : gain[0]);
    else if (fabs(gain[0] - gain[1]) < 0.005 * fabs(gain[0]))
        clocale_print(text, size, "moduli by %.2g %%", gain[0]);
    else
        clocale_print(text, size, "bulk modulus by %.3g %% and that of the wear track by %.3g %%",
                      gain[0], gain[1]);
}

/* An error of the sensitivity changes a modulus by its gain. It changes the ratio of the groups
 * only if the cantilevers were calibrated separately, or as far as the gains differ. */
static void calibration_caveats(answer_context *context)
{
    double gain[2];
    wt_estimate k[2];
    for (int g = 0; g < 2; g++) {
        gain[g] = accepted_median(&context->indentation[g], INDENTATION_SENSITIVITY_GAIN);
        k[g] = indentation_value(&context->indentation[g], INDENTATION_KEY_SPRING_CONSTANT);
    }
    if (isnan(gain[0]) && isnan(gain[1]))
        return;
    char gains[160], lever[128] = "No error of the spring constant is stated";
    const double error[2] = {100 * k[0].standard_error / k[0].value,
                             100 * k[1].standard_error / k[1].value};
    format_gains(gain, gains, sizeof gains);
    if (error[0] > 0 && error[1] > 0 && fabs(error[0] - error[1]) > 1e-9 * error[0])
        clocale_print(lever, sizeof lever,
                      "The stated errors of the spring constants are %.2g %% and %.2g %%", error[0],
                      error[1]);
    else if (error[0] > 0 || error[1] > 0)
        clocale_print(lever, sizeof lever, "The stated error of the spring constant is %.2g %%",
                      error[0] > 0 ? error[0] : error[1]);
    char text[1000];
    text_builder t = {text, sizeof text, 0};
    text_append(
        &t,
        "An error of 1 %% in the deflection sensitivity changes the %s, one of the spring constant "
        "by about as much as itself. %s",
        gains, lever);
    text_append(
        &t, "; the intervals of the moduli hold what is stated, and an assumed error where none "
            "is.");
    /* A group without a modulus has no gain, and there is no ratio in which an error could
     * cancel. */
    const cantilever_count cantilevers =
        isnan(gain[0]) || isnan(gain[1])
            ? CANTILEVER_COUNT_UNKNOWN
            : (cantilever_count)comparison_key_enum(&context->values.comparison,
                                                    COMPARISON_KEY_CANTILEVERS);
    const char *includes =
        comparison_key_text(&context->values.comparison, COMPARISON_KEY_INCLUDES);
    if (cantilevers == ONE_CANTILEVER)
        text_append(
            &t,
            " Track and bulk are taken to be indented with one cantilever, %s: its errors cancel "
            "in the ratio, but for %.2g %% in each 1 %% of sensitivity.",
            context->c->compare.cantilevers == WT_CANTILEVERS_SHARED
                ? "as the case says"
                : "for no spring constants differ",
            fabs(gain[1] - gain[0]));
    else if (cantilevers == TWO_CANTILEVERS)
        text_append(
            &t,
            " Track and bulk were indented with different cantilevers (bulk %s, track %s), whose "
            "errors do not cancel in the ratio%s%s.",
            format_value(k[0]).text, format_value(k[1]).text,
            includes != NULL ? "; its interval includes: " : "", includes != NULL ? includes : "");
    answer_add_caveat(context, CAVEAT_MODULI, "%s", text);
}

/* A temperature that the case does not state is that of the material, or equal for both groups. */
static void temperature_caveats(answer_context *context)
{
    const double sliding =
        friction_value(&context->values.friction, FRICTION_KEY_TEMPERATURE).value;
    if (context->values.friction.table != NULL && isnan(context->c->sliding.temperature.value)) {
        if (isnan(sliding))
            answer_add_caveat(
                context, CAVEAT_FRICTION,
                "Neither the case nor its material says a temperature: friction is that "
                "at the temperature the material was given for.");
        else
            answer_add_caveat(
                context, CAVEAT_FRICTION,
                "The case does not say the temperature of sliding: friction is that at "
                "the reference temperature of the material, %s.",
                format_celsius(sliding).text);
    }
    if (context->dma_comparison.table != NULL && isnan(context->c->compare.temperature.value))
        answer_add_caveat(
            context, CAVEAT_MODULI,
            "The case does not say the temperature of indentation: it is compared with DMA at "
            "the reference temperature, %s.",
            format_celsius(
                dma_comparison_value(&context->dma_comparison, DMA_COMPARISON_KEY_TEMPERATURE)
                    .value)
                .text);
}

/* Describes the corrections of the track data before the ratio was computed. */
static void ratio_caveats(answer_context *context)
{
    const table_view *comparison = &context->values.comparison;
    const wt_compare_job *job = &context->c->compare;
    const double track = job->track_temperature.value;
    if (comparison->table == NULL)
        return;
    if (isnan(track))
        answer_add_caveat(
            context, CAVEAT_CONDITIONS,
            "The case does not say that the track was indented at another temperature "
            "than the bulk: they are taken to be as warm as each other.");
    if (isnan(comparison_value(comparison, COMPARISON_KEY_MODULUS_RATIO).value))
        return;
    if (!isnan(track) && track != job->temperature.value)
        answer_add_caveat(
            context, CAVEAT_VERDICT,
            "The track was indented at %s: the ratio is brought to the temperature of the bulk "
            "by %s; the moduli of bulk and track are as measured.",
            format_celsius(track).text,
            isnan(job->temperature_slope.value) ? "the DMA" : "the temperature slope given");
    const char *rates = comparison_key_text(comparison, COMPARISON_KEY_RATES);
    if (comparison_key_enum(comparison, COMPARISON_KEY_RATES) == RATES_BROUGHT)
        answer_add_caveat(context, CAVEAT_VERDICT,
                          "Bulk and track have no indentation rate in common: the rates are %s.",
                          rates);
}

/* Example: " The interval of the friction holds: ...; not the model, nor, because no error is
 * known: ..." */
static void append_interval(text_builder *t, const char *whose, const result_value *f)
{
    text_append(t, " The interval of the %s holds: %s; not the model%s%s.", whose, f->includes,
                f->lacks != NULL ? ", nor, because no error is known: " : "",
                f->lacks != NULL ? f->lacks : "");
}

/* True if the log has a warning about superposition that material_caveats reports, too. Then it is
 * the first one: the rubber is fitted before a layer of another material. */
static bool is_superposition_reported(const answer_context *context)
{
    const table_view *shifts = &context->shift_factors;
    return shifts->n_rows > 1 &&
           shift_factors_key_text(shifts, SHIFT_FACTORS_KEY_SHIFTED_BY) == NULL &&
           shift_factors_key_enum(shifts, SHIFT_FACTORS_KEY_SUPERPOSITION) !=
               WT_SUPERPOSITION_HOLDS;
}

/* Adds the first warnings in full and the number of the others. */
static void warning_caveats(answer_context *context)
{
    enum { SHOWN = 5 }; /* limit for the length of the answer */
    size_t n = 0;
    bool is_reported = is_superposition_reported(context);
    for (size_t i = 0; i < wt_log_count(context->log); i++) {
        wt_log_entry entry = wt_log_get(context->log, i);
        if (is_reported && entry.topic == WT_TOPIC_SUPERPOSITION)
            is_reported = false;
        else if (entry.severity != WT_NOTE && ++n <= SHOWN)
            answer_add_caveat(
                context, CAVEAT_DATA, "%s%s%s: %s.", entry.severity == WT_LOSS ? "Lost" : "Warning",
                entry.file[0] != '\0' ? " of " : "", wt_path_base(entry.file), entry.text);
    }
    if (n > SHOWN)
        answer_add_caveat(context, CAVEAT_DATA, "%zu more warning%s in the table notes.", n - SHOWN,
                          n == SHOWN + 1 ? " is" : "s are");
}

static void comparison_caveats(answer_context *context)
{
    const table_view *dma = &context->dma_comparison;
    const char *statement = dma_comparison_key_text(dma, DMA_COMPARISON_KEY_MATERIAL_STATEMENT);
    const size_t extrapolated = count_extrapolated(dma);
    if (comparison_key_enum(&context->values.comparison, COMPARISON_KEY_UNIT_OF_ANALYSIS) ==
        UNIT_IS_CURVE)
        answer_add_caveat(
            context, CAVEAT_VERDICT,
            "The tables name no spots: each curve counts as one in the comparison, which "
            "makes its interval too narrow if some are of one place.");
    if (extrapolated > 0)
        answer_add_caveat(context, CAVEAT_CONDITIONS,
                          "%zu of %zu comparisons with DMA lie outside the measured frequencies.",
                          extrapolated, dma->n_rows);
    if (statement != NULL)
        answer_add_caveat(context, CAVEAT_DATA, "Comparison with DMA: %s.", statement);
}

static void append_layer_moduli(text_builder *t, const table_view *friction)
{
    const char *const shear = friction_key_text(friction, FRICTION_KEY_LAYER_SHEAR);
    const char *const moduli = friction_key_text(friction, FRICTION_KEY_LAYER_MODULI);
    const double outside = friction_value(friction, FRICTION_KEY_LAYER_OUTSIDE).value;
    if (moduli == NULL) {
        text_append(
            t,
            " The modulus of the layer is the bulk's times one ratio at all frequencies, and its "
            "shear stress is %s; neither is measured at the frequencies of sliding.",
            shear != NULL ? shear : "scaled by the same ratio");
        return;
    }
    text_append(t, " The moduli of the layer are %s; its shear stress is %s.", moduli,
                shear != NULL ? shear : "scaled by their ratio");
    if (isnan(outside))
        text_append(t, " Which frequencies they were measured at is not known.");
    else
        text_append(
            t,
            " %.3g %% of the hysteresis on it are of frequencies at which they were not measured.",
            100 * outside);
}

static void material_caveats(answer_context *context)
{
    const table_view *shifts = &context->shift_factors;
    if (shifts->table == NULL)
        return;
    const char *reason = shift_factors_key_text(shifts, SHIFT_FACTORS_KEY_SUPERPOSITION);
    const wt_superposition superposition =
        (wt_superposition)shift_factors_key_enum(shifts, SHIFT_FACTORS_KEY_SUPERPOSITION);
    size_t undetermined = 0;
    for (size_t i = 0; i < shifts->n_rows; i++)
        undetermined += !(shift_factors_get(shifts, i, SHIFT_FACTORS_DETERMINED) > 0);
    if (superposition == WT_SUPERPOSITION_FAILS)
        answer_add_caveat(context, CAVEAT_DATA,
                          "Time-temperature superposition %s. What rests on the master curve is "
                          "doubtful.",
                          reason);
    else if (shifts->n_rows < 2)
        answer_add_caveat(
            context, CAVEAT_DATA,
            "The material is known from one isotherm: no time-temperature superposition "
            "widens its frequencies.");
    else if (superposition == WT_SUPERPOSITION_INCONCLUSIVE)
        answer_add_caveat(context, CAVEAT_DATA,
                          "Whether time-temperature superposition holds the data %s.", reason);
    if (undetermined > 0)
        answer_add_caveat(
            context, CAVEAT_DATA,
            "The shift of %zu of %zu isotherms is not determined by the data; they are "
            "not in the master curve.",
            undetermined, shifts->n_rows);
}

static void append_theory(text_builder *t, const table_view *friction)
{
    const char *softening = friction_key_text(friction, FRICTION_KEY_SOFTENING);
    const bool flash = friction_key_text(friction, FRICTION_KEY_FLASH) != NULL;
    const char *temperature = flash ? "with a flash temperature" : "at one temperature";
    const char *heating = flash ? "" : "no flash heating, ";
    if (softening != NULL)
        text_append(t,
                    "Friction is that of Persson's theory %s with moduli that soften with "
                    "strain (%s; the largest strain met is %.3g): %sdry contact.",
                    temperature, softening, friction_value(friction, FRICTION_KEY_STRAIN).value,
                    heating);
    else
        text_append(
            t,
            "Friction is that of Persson's theory for small strain %s: %sno strain softening, dry "
            "contact.",
            temperature, heating);
    if (friction_key_text(friction, FRICTION_KEY_LAYER_THICKNESS) != NULL)
        append_layer_moduli(t, friction);
}

static void friction_caveats(answer_context *context)
{
    const table_view *friction = &context->values.friction;
    if (friction->table == NULL)
        return;
    const result_value hysteresis =
        result_value_friction(&context->values, FRICTION_KEY_HYSTERESIS);
    const double share = largest_extrapolated_share(friction);
    const char *statement = friction_key_text(friction, FRICTION_KEY_MATERIAL_STATEMENT);
    char text[1100];
    text_builder t = {text, sizeof text, 0};
    if (statement != NULL)
        answer_add_caveat(context, CAVEAT_DATA, "Friction: %s.", statement);
    if (share >= ANSWER_SHARE_MIN)
        answer_add_caveat(context, CAVEAT_FRICTION,
                          "Up to %s of the hysteresis friction comes from frequencies outside the "
                          "measured range of the material.",
                          format_share(share).text);
    if (friction->n_rows > 0 && isnan(friction_get(friction, 0, FRICTION_EXTRAPOLATED_SHARE)))
        answer_add_caveat(
            context, CAVEAT_FRICTION,
            "How much of the hysteresis friction comes from frequencies that were not "
            "measured is not known: the material does not say which were.");
    append_theory(&t, friction);
    append_interval(&t, "friction", &hysteresis);
    answer_add_caveat(context, CAVEAT_FRICTION, "%s", text);
    if (isnan(context->c->sliding.reference_velocity) && friction->n_rows > 1)
        answer_add_caveat(context, CAVEAT_CONDITIONS,
                          "The case does not say at which velocity the answer is wanted: %s is a "
                          "default.",
                          format_with_unit(hysteresis.velocity, "m/s").text);
}

/* Adds a caveat if the thickness is outside the range of the layer model or small against the
 * indentation depth. */
static void depth_caveats(answer_context *context, double thickness)
{
    if (!isfinite(thickness))
        return;
    if (context->roughness.n_rows > 0) {
        const double longest = 1 / roughness_get(&context->roughness, 0, ROUGHNESS_WAVENUMBER);
        if (thickness > longest)
            answer_add_caveat(context, CAVEAT_THICKNESS,
                              "The layer is thicker than the longest wave of the roughness reaches "
                              "(1/q0 = %s): the layer model is outside its range.",
                              format_with_unit(longest, "m").text);
    }
    const double depth = accepted_median(&context->indentation[1], INDENTATION_MAX_INDENTATION);
    if (thickness > 0 && depth > DEEP_SHARE * thickness)
        answer_add_caveat(
            context, CAVEAT_VERDICT,
            "Indentations in the track go %s deep, %.2g times the thickness of the layer: the "
            "bulk below it is felt, so the layer differs more than the ratio says.",
            format_with_unit(depth, "m").text, depth / thickness);
}

static void layer_caveats(answer_context *context)
{
    const table_view *layer = &context->values.layer;
    if (layer->table == NULL)
        return;
    const result_value thickness = result_value_thickness(&context->values);
    const number_text energy = format_known_estimate(layer_value(layer, LAYER_KEY_CRITICAL_ENERGY));
    char text[1100];
    text_builder t = {text, sizeof text, 0};
    const char *energy_from = layer_key_text(layer, LAYER_KEY_ENERGY_FROM);
    if (is_thickness_put_in(&context->values))
        text_append(
            &t,
            "The critical energy U_c = %s is calibrated so that the observed thickness is the "
            "balance: the thickness is put in, not predicted.",
            energy.text);
    else
        text_append(&t, "The critical energy U_c = %s is given: nothing in this case measures it.",
                    energy.text);
    text_append(&t,
                " The layer model (energy closure, wear by Archard's law) is not validated against "
                "measured thicknesses. ");
    const char *const but =
        context->layer_feedback.table != NULL ? " but in the table layer_feedback" : "";
    if (energy_from != NULL)
        text_append(&t, "What modifies the rubber is %s; the layer does not act back on it%s.",
                    energy_from, but);
    else
        text_append(
            &t,
            "Its energy is the hysteresis of the bulk alone: the layer does not act back on it%s, "
            "and shearing of the surface is not counted.",
            but);
    append_interval(&t, "thickness", &thickness);
    answer_add_caveat(context, CAVEAT_THICKNESS, "%s", text);
    depth_caveats(context, thickness.number.value);
}

void answer_caveats(answer_context *context)
{
    const size_t failed = context->failures.n_rows;
    if (failed > 0)
        answer_add_caveat(context, CAVEAT_FAILURES,
                          "%zu file%s or stage%s failed and %s not in these results; the table "
                          "failures lists them.",
                          failed, failed == 1 ? "" : "s", failed == 1 ? "" : "s",
                          failed == 1 ? "is" : "are");
    indentation_caveats(context);
    calibration_caveats(context);
    comparison_caveats(context);
    material_caveats(context);
    friction_caveats(context);
    layer_caveats(context);
    temperature_caveats(context);
    ratio_caveats(context);
    warning_caveats(context); /* after the caveats about the results */
}
