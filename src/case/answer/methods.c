/* Table of the methods of a result: a sentence for a paper with the numbers of the result, and the
 * reference of each method. SPDX-License-Identifier: GPL-3.0-or-later */
#include "case/answer/format_number.h"

#include <math.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/number.h"
#include "core/table/table_rows.h"
#include "weartrack/case.h"

/* A method belongs to every result that has its table, if `used` agrees. */
typedef struct method {
    const char *name;
    const table_schema *table;
    bool (*used)(const table_view *table); /* NULL if the method is always used */
    void (*describe)(text_builder *t, const table_view *table);
    const char *reference, *doi; /* as printed in journals; "" without a reference */
} method;

/* ---- indentation ----------------------------------------------------------------------------- */

static bool is_blunted(const table_view *table)
{
    const tip_form form = (tip_form)indentation_key_enum(table, INDENTATION_KEY_TIP);
    return form == TIP_BLUNTED_PYRAMID || form == SEVERAL_BLUNTED_PYRAMIDS;
}

static bool is_general_tip(const table_view *table)
{
    return !is_blunted(table);
}

/* Appends the range of a column over the curves with a modulus; nothing if none states it. */
static void append_range(text_builder *t, const table_view *table, indentation_column column,
                         const char *unit, const char *before)
{
    double low = (double)NAN, high = (double)NAN;
    for (size_t i = 0; i < table->n_rows; i++)
        if (isfinite(indentation_get(table, i, INDENTATION_MODULUS))) {
            const double value = indentation_get(table, i, column);
            low = fmin(low, value); /* fmin and fmax ignore NaN */
            high = fmax(high, value);
        }
    if (isnan(low))
        return;
    text_append(t, "%s%s", before, format_with_unit(low, unit).text);
    if (high > low)
        text_append(t, " to %s", format_with_unit(high, unit).text);
}

/* Appends cantilever, indentation rate and depth, as far as the table states them. */
static void describe_experiment(text_builder *t, const table_view *table)
{
    const wt_estimate constant = indentation_value(table, INDENTATION_KEY_SPRING_CONSTANT);
    const size_t begin = t->used;
    text_append(t, "The sample was indented");
    const size_t stated = t->used;
    if (isfinite(constant.value))
        text_append(t, " with a cantilever of %s", format_estimate(constant).text);
    append_range(t, table, INDENTATION_RATE, "m/s", " at ");
    append_range(t, table, INDENTATION_MAX_INDENTATION, "m", " to a depth of ");
    if (t->used > stated)
        text_append(t, ". ");
    else
        t->text[t->used = begin] = '\0';
}

static void describe_indentation(text_builder *t, const table_view *table)
{
    const char *tip = indentation_key_text(table, INDENTATION_KEY_TIP),
               *ratio = indentation_key_text(table, INDENTATION_KEY_POISSON_RATIO),
               *used = indentation_key_text(table, INDENTATION_KEY_N_USED);
    describe_experiment(t, table);
    text_append(
        t,
        "Young's modulus of each of %zu force curve%s%s%s%s was fitted together with the line of "
        "the baseline and the contact point",
        table->n_rows, table->n_rows == 1 ? "" : "s", used != NULL ? " (" : "",
        used != NULL ? used : "", used != NULL ? " of them used)" : "");
    text_append(t, ", with the contact law of the tip (%s)", tip != NULL ? tip : "not stated");
    text_append(t, ratio != NULL ? " and a Poisson's ratio of %s." : ".%s",
                ratio != NULL ? ratio : "");
}

/* ---- comparison ------------------------------------------------------------------------------ */

static void describe_welch(text_builder *t, const table_view *table)
{
    const char *unit = comparison_key_text(table, COMPARISON_KEY_UNIT_OF_ANALYSIS);
    const wt_estimate ratio = comparison_value(table, COMPARISON_KEY_MODULUS_RATIO);
    text_append(
        t, "Wear track and bulk were compared by Welch's t test of the logarithm of the modulus");
    if (unit != NULL)
        text_append(t, ", with the %s as the unit of analysis", unit);
    if (isfinite(ratio.value))
        text_append(t, "; the ratio of their geometric means is %s", format_estimate(ratio).text);
    text_append(t, ".");
}

static void describe_mann_whitney(text_builder *t, const table_view *table)
{
    (void)table;
    text_append(t, "The test of Mann and Whitney was done beside it.");
}

static bool has_several_rates(const table_view *table)
{
    return table->n_rows > 2;
}

static void describe_holm(text_builder *t, const table_view *table)
{
    text_append(t, "The p-values of %zu indentation rates were corrected by the method of Holm.",
                table->n_rows - 1);
}

static void describe_hedges(text_builder *t, const table_view *table)
{
    (void)table;
    text_append(t, "The effect size is Hedges' g.");
}

/* ---- material -------------------------------------------------------------------------------- */

/* Appends the strain amplitudes of the isotherms, if the files state them. */
static void append_strain(text_builder *t, const table_view *table)
{
    const double low = shift_factors_value(table, SHIFT_FACTORS_KEY_STRAIN_LOW).value,
                 high = shift_factors_value(table, SHIFT_FACTORS_KEY_STRAIN_HIGH).value;
    if (isnan(low))
        return;
    text_append(t, "The isotherms were measured with a strain amplitude of %s. ",
                format_range_with_unit(1e2 * low, 1e2 * high, "%").text);
}

static void describe_shifting(text_builder *t, const table_view *table)
{
    const double reference =
        shift_factors_value(table, SHIFT_FACTORS_KEY_REFERENCE_TEMPERATURE).value;
    const char *by = shift_factors_key_text(table, SHIFT_FACTORS_KEY_SHIFTED_BY);
    append_strain(t, table);
    if (table->n_rows == 1)
        text_append(
            t,
            "One relaxation spectrum was fitted to the isotherm at %s, with its smoothness and "
            "the noise by restricted maximum likelihood.",
            format_celsius(reference).text);
    else
        text_append(
            t,
            "%zu isotherms were shifted to %s%s%s so that one relaxation spectrum lies behind all "
            "of them, with its smoothness and their noise by restricted maximum likelihood "
            "(superposition %s).",
            table->n_rows, format_celsius(reference).text, by != NULL ? " by the " : "",
            by != NULL ? by : "", shift_factors_key_text(table, SHIFT_FACTORS_KEY_SUPERPOSITION));
}

static bool has_wlf_constants(const table_view *table)
{
    return isfinite(shift_factors_value(table, SHIFT_FACTORS_KEY_WLF_C1).value);
}

static void describe_wlf(text_builder *t, const table_view *table)
{
    const wt_estimate c1 = shift_factors_value(table, SHIFT_FACTORS_KEY_WLF_C1),
                      c2 = shift_factors_value(table, SHIFT_FACTORS_KEY_WLF_C2);
    text_append(t,
                "The shift factors follow the law of Williams, Landel and Ferry with C1 = %s and "
                "C2 = %s.",
                format_estimate(c1).text, format_estimate(c2).text);
}

static bool has_activation_energy(const table_view *table)
{
    return isfinite(shift_factors_value(table, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY).value);
}

static void describe_arrhenius(text_builder *t, const table_view *table)
{
    const wt_estimate energy = shift_factors_value(table, SHIFT_FACTORS_KEY_ACTIVATION_ENERGY);
    text_append(t, "The shift factors follow Arrhenius' law%s with an activation energy of %s.",
                has_wlf_constants(table) ? " in the cold" : "", format_estimate(energy).text);
}

/* ---- sliding --------------------------------------------------------------------------------- */

static void describe_power_spectrum(text_builder *t, const table_view *table)
{
    const char *scans = power_spectrum_key_text(table, POWER_SPECTRUM_KEY_N_SCANS);
    const bool one = parse_number_or_nan(scans) == 1;
    text_append(t, "The power spectrum of the counter surface was computed from %s scan%s.",
                scans != NULL ? scans : "its", one ? "" : "s");
}

static void describe_friction(text_builder *t, const table_view *table)
{
    const wt_estimate pressure = friction_value(table, FRICTION_KEY_PRESSURE),
                      temperature = friction_value(table, FRICTION_KEY_TEMPERATURE),
                      shear = friction_value(table, FRICTION_KEY_SHEAR_STRESS);
    text_append(
        t,
        "Contact area and hysteresis friction were computed by Persson's theory at a nominal "
        "pressure of %s and %s",
        format_value(pressure).text, format_celsius(temperature.value).text);
    if (isfinite(shear.value))
        text_append(t, ", with a shear stress of %s in the real contact",
                    format_estimate(shear).text);
    const char *draws = friction_key_text(table, FRICTION_KEY_REPLICATES);
    if (parse_number_or_nan(draws) > 0)
        text_append(t, "; intervals by %s draws of what has an error", draws);
    text_append(t, ".");
}

static double partial_contact_gamma(const table_view *table)
{
    const char *words = friction_key_text(table, FRICTION_KEY_GAMMA);
    double gamma = 1;
    return words != NULL && parse_stored_number(words, strlen(words), &gamma) ? gamma : 1;
}

static bool has_gamma(const table_view *table)
{
    return partial_contact_gamma(table) != 1;
}

static void describe_gamma(text_builder *t, const table_view *table)
{
    text_append(t, "The energy of partial contact was lowered by the factor gamma = %g.",
                partial_contact_gamma(table));
}

static void describe_softening(text_builder *t, const table_view *table)
{
    text_append(t, "The moduli soften with the strain at each length scale (%s).",
                softening_key_text(table, SOFTENING_KEY_SOURCE));
}

static void describe_flash(text_builder *t, const table_view *table)
{
    const wt_estimate around = flash_value(table, FLASH_KEY_SURROUNDINGS);
    text_append(t,
                "The flash temperature at each length scale was computed with surroundings at %s.",
                format_celsius(around.value).text);
}

static void describe_layer(text_builder *t, const table_view *table)
{
    const wt_estimate critical = layer_value(table, LAYER_KEY_CRITICAL_ENERGY);
    text_append(t,
                "The thickness of the modified layer follows from the energy dissipated below the "
                "surface over a critical energy of %s (%s).",
                format_estimate(critical).text,
                layer_key_text(table, LAYER_KEY_CRITICAL_ENERGY_FROM));
}

static void describe_archard(text_builder *t, const table_view *table)
{
    const wt_estimate rate = layer_value(table, LAYER_KEY_WEAR_RATE);
    text_append(t, "It wears by Archard's law with a specific wear rate of %s.",
                format_estimate(rate).text);
}

static bool has_depth_bound(const table_view *table)
{
    return isfinite(track_layer_value(table, TRACK_LAYER_KEY_LEAST).value);
}

static void describe_track_layer(text_builder *t, const table_view *table)
{
    const wt_estimate depth = track_layer_value(table, TRACK_LAYER_KEY_DEPTH),
                      least = track_layer_value(table, TRACK_LAYER_KEY_LEAST);
    text_append(
        t,
        "Which thickness of a layer on the bulk the curves of the track allow was tested for each "
        "one from %s on by the change of the modulus over an indentation of %s",
        format_value(least).text, format_value(depth).text);
    text_append(
        t, ", with the ratio of the moduli, beside the change of the bulk, at 5 %%, by a contact "
           "law fitted to the integral equation for a bonded layer on a half-space.");
}

/* ---- the list -------------------------------------------------------------------------------- */

static const method methods[] = {
    {"contact law of a blunted pyramid", &indentation_schema, is_blunted, describe_indentation,
     "F. Rico et al., Phys. Rev. E 72 (2005) 021914", "10.1103/PhysRevE.72.021914"},
    {"contact law of the tip", &indentation_schema, is_general_tip, describe_indentation,
     "I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47", "10.1016/0020-7225(65)90019-4"},
    {"Welch's t test", &comparison_schema, NULL, describe_welch,
     "B. L. Welch, Biometrika 34 (1947) 28", "10.1093/biomet/34.1-2.28"},
    {"test of Mann and Whitney", &comparison_schema, NULL, describe_mann_whitney,
     "H. B. Mann and D. R. Whitney, Ann. Math. Stat. 18 (1947) 50", "10.1214/aoms/1177730491"},
    {"Holm's correction", &comparison_schema, has_several_rates, describe_holm,
     "S. Holm, Scand. J. Stat. 6 (1979) 65", ""},
    {"Hedges' g", &comparison_schema, NULL, describe_hedges,
     "L. V. Hedges, J. Educ. Stat. 6 (1981) 107", "10.3102/10769986006002107"},
    {"one relaxation spectrum", &shift_factors_schema, NULL, describe_shifting,
     "S. N. Wood and M. Fasiolo, Biometrics 73 (2017) 1071", "10.1111/biom.12666"},
    {"law of Williams, Landel and Ferry", &shift_factors_schema, has_wlf_constants, describe_wlf,
     "M. L. Williams, R. F. Landel and J. D. Ferry, J. Am. Chem. Soc. 77 (1955) 3701",
     "10.1021/ja01619a008"},
    {"Arrhenius' law", &shift_factors_schema, has_activation_energy, describe_arrhenius, "", ""},
    {"power spectrum of height maps", &power_spectrum_schema, NULL, describe_power_spectrum,
     "T. D. B. Jacobs, T. Junge and L. Pastewka, Surf. Topogr.: Metrol. Prop. 5 (2017) 013001",
     "10.1088/2051-672X/aa51f8"},
    {"Persson's theory of contact and friction", &friction_schema, NULL, describe_friction,
     "B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840", "10.1063/1.1388626"},
    {"factor gamma of partial contact", &friction_schema, has_gamma, describe_gamma,
     "M. Scaraggi and B. N. J. Persson, J. Phys.: Condens. Matter 27 (2015) 105102",
     "10.1088/0953-8984/27/10/105102"},
    {"softening with strain in friction", &softening_schema, NULL, describe_softening,
     "B. Lorenz et al., J. Chem. Phys. 142 (2015) 194701", "10.1063/1.4919221"},
    {"flash temperature", &flash_schema, NULL, describe_flash,
     "B. N. J. Persson, J. Phys.: Condens. Matter 18 (2006) 7789", "10.1088/0953-8984/18/32/025"},
    {"formation of the modified layer", &layer_schema, NULL, describe_layer,
     "M. Mokhtari, thesis, University of Twente (2015)", "10.3990/1.9789036540018"},
    {"layer on a half-space", &track_layer_schema, has_depth_bound, describe_track_layer,
     "D. M. Burmister, J. Appl. Phys. 16 (1945) 89", "10.1063/1.1707558"},
    {"Archard's law of wear", &layer_schema, NULL, describe_archard,
     "J. F. Archard, J. Appl. Phys. 24 (1953) 981", "10.1063/1.1721448"},
};

TABLE_ROW(methods, METHODS, const char *method, *text, *reference, *doi;)

/* Returns the suffix of a table name that belongs to the schema, such as a group or sample; ""
 * without a suffix, NULL for another table. */
static const char *schema_suffix(const table_schema *schema, const wt_table *table)
{
    const char *const name = wt_table_name(table);
    const size_t length = strlen(schema->name);
    if (strncmp(name, schema->name, length) != 0)
        return NULL;
    if (length > 0 && schema->name[length - 1] == '/')
        return name + length;
    return name[length] == '\0' ? "" : name[length] == '/' ? name + length + 1 : NULL;
}

/* Two groups may have the same tip: a sentence is listed once. */
static bool has_sentence(const wt_table *table, const char *text)
{
    for (size_t row = 0; table != NULL && row < wt_table_n_rows(table); row++)
        if (wt_text_repeats(text, wt_table_text(table, row, METHODS_TEXT)))
            return true;
    return false;
}

static void add_method(table_writer *writer, const method *m, const wt_result *result)
{
    char text[1024];
    for (size_t i = 0; i < wt_result_n_tables(result); i++) {
        const wt_table *const table = wt_result_table(result, i);
        const char *const suffix = schema_suffix(m->table, table);
        table_view view;
        text_builder sentence = {text, sizeof text, 0};
        if (suffix == NULL || table_bind(table, m->table, suffix, &view, NULL) != WT_OK ||
            (m->used != NULL && !m->used(&view)))
            continue;
        text[0] = '\0';
        if (suffix[0] != '\0')
            text_append(&sentence, "%s: ", suffix);
        m->describe(&sentence, &view);
        if (!has_sentence(writer->table, text))
            TABLE_ADD(methods, writer, m->name, text, m->reference, m->doi);
    }
}

/* Adds the instruments of the files, by the role of the files. */
static void add_instruments(table_writer *writer, const wt_result *result)
{
    const wt_provenance *const provenance = wt_result_provenance_const(result);
    for (size_t i = 0; i < wt_provenance_n_inputs(provenance); i++) {
        const wt_provenance_input *const input = wt_provenance_get_input(provenance, i);
        char text[512];
        snprintf(text, sizeof text, "%s: The data come from %s.", wt_provenance_input_role(input),
                 input->instrument);
        if (input->instrument[0] != '\0' && !has_sentence(writer->table, text))
            TABLE_ADD(methods, writer, "instrument", text, "", "");
    }
}

wt_status wt_methods_table(const wt_result *result, wt_table **table, wt_error *err)
{
    table_writer writer = table_begin(&methods_schema, err);
    add_instruments(&writer, result);
    for (size_t i = 0; i < COUNT_OF(methods); i++)
        add_method(&writer, &methods[i], result);
    return table_end(&writer, table);
}
