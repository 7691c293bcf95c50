/* Figures of a report: the columns that they draw, their captions, and the required tables.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"
#include "shared_report.h"
#include "table_cells.h"

#include <ctype.h>

/* ---- data ------------------------------------------------------------------------------------ */

static bool has_columns(const wt_table *section, const table_schema *schema,
                        const unsigned *columns, size_t n)
{
    if (wt_table_n_columns(section) != n)
        return false;
    for (size_t i = 0; i < n; i++)
        if (strcmp(wt_table_column_name(section, i), schema->columns[columns[i]].name) != 0 ||
            strcmp(wt_table_column_unit(section, i), schema_unit(&schema->columns[columns[i]])) !=
                0)
            return false;
    return true;
}

static void test_data_have_the_described_columns(void **state)
{
    (void)state;
    NEED_REPORT();
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const figure_description *figure = figure_find(i);
        unsigned columns[FIGURE_COLUMNS];
        const size_t n = drawing_list_columns(figure, columns);
        wt_table *sections[MOST];
        const size_t n_sections = read_sections("out", figure->name, sections);
        size_t found = 0;
        for (size_t k = 0; k < n_sections; k++)
            found += has_columns(sections[k], figure->table, columns, n);
        if (n_sections == 0 || (n > 0 && found == 0))
            fail_msg("%s.tsv lacks what is described", figure->name);
        free_sections(sections, n_sections);
    }
}

/* The table of a figure is one of the tables that a report reads (FIGURE_TABLES). */
static void test_tables_are_read(void **state)
{
    (void)state;
    figure_tables tables = {.n_indentation = 0};
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const figure_description *figure = figure_find(i);
        if (figure_tables_find(&tables, figure->table) == NULL)
            fail_msg("%s: its table %s is not in BOUND_TABLES", figure->name, figure->table->name);
    }
}

/* A description names columns of its own table with the right type. */
static void test_descriptions_fit_their_tables(void **state)
{
    (void)state;
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const figure_description *figure = figure_find(i);
        unsigned columns[FIGURE_COLUMNS];
        const size_t n = drawing_list_columns(figure, columns);
        assert_true(n < FIGURE_COLUMNS);
        for (size_t k = 0; k < n; k++) {
            assert_true(columns[k] < figure->table->n_columns);
            assert_int_equal(figure->table->columns[columns[k]].kind, SCHEMA_NUMBER);
        }
        if (figure->by_group)
            assert_int_equal(figure->table->columns[figure->group].kind, SCHEMA_TEXT);
        for (const figure_curve *curve = figure->curves; curve->form != CURVE_NONE; curve++) {
            const schema_field *column = &figure->table->columns[curve->column];
            assert_true(curve->band == 0 || column->standard_error > 0);
            assert_true(!curve->with_errors || column->standard_error > 0 || column->high > 0);
            assert_true(curve->panel < FIGURE_PANELS);
        }
        assert_true(figure->caption_text != NULL && strlen(figure->title) > 5);
    }
}

/* ---- curves ---------------------------------------------------------------------------------- */

/* Columns that an item of a plot command uses, in their order, each once: "time thickness". */
static void columns_of_item(const char *item, wt_table *const *sections, size_t n, char *words,
                            size_t size)
{
    const char *index = strstr(item, "' index "), *with = strstr(item, " with ");
    assert_true(index != NULL && with != NULL);
    const size_t section = strtoul(index + strlen("' index "), NULL, 10);
    assert_true(section < n);
    words[0] = '\0';
    if (strstr(item, " matrix ") != NULL) { // all of them, whose numbers are $1
        assert_string_equal(wt_table_column_unit(sections[section], 0), "m");
        (void)snprintf(words, size, "matrix");
        return;
    }
    bool inside = false; // of a bracket, where a plain number is a number
    for (const char *s = strstr(index, "using ") + strlen("using "); s < with; s++) {
        inside = (inside || *s == '(') && !(*s == ')' && (s[1] == ':' || s[1] == ' '));
        bool column = *s == '$' || (!inside && isdigit((unsigned char)*s));
        if (!column)
            continue;
        char *end = NULL;
        const size_t place_in = strtoul(s + (*s == '$'), &end, 10);
        s = end - 1;
        if (place_in == 0) // $0 is the number of the row
            continue;
        assert_true(place_in <= wt_table_n_columns(sections[section]));
        const char *name = wt_table_column_name(sections[section], place_in - 1);
        const char *seen = strstr(words, name);
        const size_t length = strlen(name);
        while (seen != NULL && ((seen != words && seen[-1] != ' ') ||
                                (seen[length] != ' ' && seen[length] != '\0')))
            seen = strstr(seen + 1, name);
        if (seen == NULL)
            (void)snprintf(words + strlen(words), size - strlen(words), "%s%s",
                           words[0] == '\0' ? "" : " ", name);
    }
}

/* Options after `with`, and the style that must be used. */
static void test_curves_are_drawn_from_their_columns(void **state)
{
    (void)state;
    NEED_REPORT();
    static const struct {
        const char *figure, *with, *columns;
    } curves[] = {
        {"force_displacement", "ls 1 title 'approach'", "displacement force"},
        {"force_displacement", "ls 31 title 'retract'", "displacement force"},
        {"force_displacement", "title 'contact'",
         "contact_point contact_force contact_point_standard_error"},
        {"force_indentation", "points ls 41 title 'bulk'", "indentation force"},
        {"force_indentation", "title 'fit'", "indentation fitted_force"},
        {"modulus_groups", "points ls 41", "modulus"},
        {"modulus_groups", "yerrorbars ls 13", "geometric_mean low high"},
        {"modulus_map", "boxxyerror", "x y modulus"},
        {"modulus_map", "points ls 14", "x y"},
        {"modulus_depth", "title 'track'", "depth modulus low high"},
        {"curves", "points ls 41", "displacement force"},
        {"curves", "lines ls 45", "displacement force"},
        {"curves", "lines ls 11", "displacement fitted_force"},
        {"modulus_rate", "title 'track'", "indentation_rate geometric_mean low high"},
        {"dma_comparison", "title 'DMA |E*|'", "equivalent_frequency dma_complex_modulus"},
        {"dma_comparison", "title 'DMA E′'", "equivalent_frequency dma_storage_modulus"},
        {"dma_comparison", "title 'bulk'", "equivalent_frequency indentation_modulus low high"},
        {"collected_modulus", ":($4*y_unit) with yerrorlines ls 2",
         "indentation_rate modulus modulus_low modulus_high"},
        {"collected_friction", "($2*y_unit) with lines ls 2 title 'HC'", "velocity friction"},
        {"collected_area", "($2*y_unit) with lines ls 2 title 'HC'", "velocity area_ratio"},
        {"collected_ramp", "($2*y_unit) with linespoints ls 2 title 'HC'",
         "temperature storage_modulus"},
        {"collected_ramp", "($3*y_unit) with linespoints ls 2 title 'HC'",
         "temperature loss_modulus"},
        {"collected_force", "lines ls 2 title 'mild'", "indentation force"},
        {"identification", "($1*x_unit):($2*y_unit) with lines ls 1 title 'wear rate'",
         "critical_energy specific_wear_rate"},
        {"isotherms", ":($2*y_unit)", "own_frequency own_storage temperature"},
        {"isotherms", ":($3*y_unit)", "own_frequency own_loss temperature"},
        {"isotherms", "ratio(", "own_frequency own_storage own_loss temperature"},
        {"master_curve", "points ls 51", "angular_frequency storage_modulus temperature"},
        {"master_curve", "points ls 52", "angular_frequency loss_modulus temperature"},
        {"master_curve", "ratio($2,$3)",
         "angular_frequency storage_modulus loss_modulus temperature"},
        {"master_curve", "($6*y_unit)", "angular_frequency fitted_storage_low fitted_storage_high"},
        {"master_curve", "($9*y_unit)", "angular_frequency fitted_loss_low fitted_loss_high"},
        {"master_curve", "($12*1)",
         "angular_frequency fitted_loss_factor_low fitted_loss_factor_high"},
        {"master_curve", "($11*1)", "angular_frequency fitted_loss_factor"},
        {"master_curve", "title 'one spectrum'", "angular_frequency fitted_storage"},
        {"master_curve", "lines ls 11 notitle", "angular_frequency fitted_loss"},
        {"relaxation", "points ls 51", "time relaxation_modulus temperature"},
        {"relaxation", "title 'one spectrum'", "time fitted_relaxation"},
        {"relaxation", "filledcurves ls 61", "time fitted_relaxation_low fitted_relaxation_high"},
        {"relaxation_isotherms", "points ls 51", "own_time own_relaxation temperature"},
        {"creep_isotherms", "points ls 51", "own_time own_creep temperature"},
        {"creep", "points ls 51", "time creep_compliance temperature"},
        {"creep", "title 'one spectrum'", "time fitted_creep"},
        {"creep", "filledcurves ls 61", "time fitted_creep_low fitted_creep_high"},
        {"shift_factors", "title 'from overlap'",
         "temperature determined log_a log_a_standard_error"},
        {"shift_factors", "title 'too little overlap'", "temperature determined log_a"},
        {"shift_factors", "$2-offset-$5",
         "temperature determined log_a law_log_a log_a_standard_error"},
        {"shift_factors", "-$5):($7-$5)", "temperature law_log_a_low law_log_a law_log_a_high"},
        {"vertical_shifts", "title 'isotherms'", "temperature log_b log_b_standard_error"},
        {"vertical_shifts", "title 'material'", "temperature log_b_material"},
        {"vertical_shifts", "title 'rubber elasticity'", "temperature log_b_physical"},
        {"influences", "with impulses ls 1", "temperature log_a_change"},
        {"influences", "points ls 14", "temperature log_a_half_width"},
        {"relaxation_spectrum", "filledcurves ls 61", "relaxation_time density_low density_high"},
        {"relaxation_spectrum", "lines ls 11", "relaxation_time density"},
        {"van_gurp_palmen", "points ls 51", "storage_modulus loss_modulus temperature"},
        {"van_gurp_palmen", "title 'one spectrum'", "fitted_storage fitted_loss"},
        {"ramp", "points ls 51 lc rgb 'black'", "temperature storage_modulus"},
        {"ramp", "points ls 52 lc rgb 'black'", "temperature loss_modulus"},
        {"ramp", "title 'peak of the loss modulus'",
         "loss_modulus_peak_temperature loss_modulus_peak"},
        {"ramp", "title 'peak of tan δ'", "loss_factor_peak_temperature loss_factor_peak"},
        {"height_map", "with image", "matrix"},
        {"height_profile", "with lines ls 21", "x height"},
        {"measured_spectrum", "title 'measured'", "wavenumber density density_low density_high"},
        {"measured_spectrum", "title 'self-affine law'", "wavenumber self_affine"},
        {"angular_spectrum", "title 'measured'",
         "direction density_ratio density_ratio_low density_ratio_high"},
        {"angular_spectrum", "title 'two terms'", "direction terms"},
        {"payne", "points ls 51", "strain storage_modulus angular_frequency"},
        {"payne", "points ls 52", "strain loss_modulus angular_frequency"},
        {"payne", "title 'a tenth lost'", "strain_tenth storage_start"},
        {"payne", "title 'half lost'", "strain_half storage_start"},
        {"power_spectrum", "lines ls 21", "wavenumber density"},
        {"friction", "ls 71 title", "velocity friction friction_standard_error"},
        {"friction", "ls 72 notitle", "velocity hysteresis hysteresis_standard_error"},
        {"friction", "ls 74 notitle",
         "velocity friction_with_layer friction_with_layer_standard_error"},
        {"friction", "title 'total'", "velocity friction"},
        {"friction", "title 'hysteresis'", "velocity hysteresis"},
        {"friction", "title 'shearing'", "velocity adhesion"},
        {"friction", "title 'total with layer'", "velocity friction_with_layer"},
        {"contact_area", "lines lw 1.8", "magnification area_ratio velocity"},
        {"friction_scales", "lines lw 1.8", "magnification hysteresis velocity"},
        {"transverse_isotropy", "title 'isotropic'", "velocity hysteresis"},
        {"friction_decades", "boxxyerror ls 21", "from to hysteresis"},
        {"friction_decades", "boxxyerror ls 23", "to from hysteresis"},
        {"softening", "title 'moduli soften with strain'", "velocity hysteresis"},
        {"softening", "title 'moduli at small strain'", "velocity hysteresis_without"},
        {"flash_temperature", "lines ls 21", "velocity temperature"},
        {"flash_friction", "title 'with flash temperature'", "velocity hysteresis"},
        {"flash_friction", "title 'as warm as the surroundings'", "velocity hysteresis_without"},
        {"transverse_isotropy", "title 'both'", "velocity hysteresis"},
        {"energy_density", "lines ls 21", "depth energy_density"},
        {"layer", "ls 71 title", "time thickness thickness_standard_error"},
        {"layer", "title 'thickness'", "time thickness"},
        {"layer", "title 'formation'", "time formation_rate"},
        {"track_layer", "title 'track'", "depth modulus low high"},
        {"track_layer", "title 'thinnest layer'", "depth modulus"},
        {"layer", "title 'wear'", "time wear_rate"},
        {"record", "lines ls 21", "number friction_coefficient"},
        {"record", "xerrorbars ls 2",
         "running_in friction_coefficient running_in_low running_in_high"},
        {"record_velocity", "yerrorbars ls 1",
         "velocity friction_coefficient friction_coefficient_low friction_coefficient_high"},
        {"record_load", "yerrorbars ls 1",
         "normal_force friction_coefficient friction_coefficient_low friction_coefficient_high"},
        {"validation", "yerrorbars ls 1",
         "velocity friction_measured friction_measured_low friction_measured_high"},
        {"validation", "yerrorlines ls 21",
         "velocity friction_predicted friction_predicted_standard_error"},
        {"validation", "yerrorlines ls 24",
         "velocity friction_with_layer friction_with_layer_standard_error"},
        {"validation_course", "lines ls 21", "time friction_without_layer"},
        {"validation_course", "lines ls 24", "time friction_with_layer"},
        {"validation_course", "points ls 1", "time friction_measured"},
        {"validation_ratio", "yerrorbars ls 1", "velocity ratio ratio_low ratio_high"},
        {"validation_ratio", "yerrorbars ls 4",
         "velocity ratio_with_layer ratio_with_layer_low ratio_with_layer_high"},
        {"record_temperature", "yerrorbars ls 1",
         "temperature friction_coefficient friction_coefficient_low friction_coefficient_high"},
        {"what_if", "boxxyerror ls 1", "used low high"},
        {"what_if", "xerrorbars ls 13", "used low high"},
        {"work_precision", "linespoints ls 1", "seconds true_error"},
        {"work_precision", "linespoints ls 2", "seconds true_error"},
        {"work_precision", "linespoints ls 31", "seconds stated_error"},
        {"work_precision", "lines ls 12", "seconds reference_error"},
        {"error_budget", "boxxyerror ls 1", "relative_error"},
        {"error_budget", "boxxyerror ls 2", "relative_error"},
        {"cost", "boxxyerror ls 1", "runs cpu_time"},
        {"cost", "points ls 1", "standard_error runs"},
        {"cost", "points ls 2", "error_estimated runs"},
    };
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const char *figure = wt_figure_get(i).name;
        wt_table *sections[MOST];
        const size_t n = read_sections("out", figure, sections);
        size_t checked = 0;
        for (size_t k = 0; k < sizeof curves / sizeof *curves; k++) {
            if (strcmp(curves[k].figure, figure) != 0)
                continue;
            char *script = read_plot("out", figure, "gp"), *rest = NULL, words[256] = "";
            for (char *line = strtok_r(script, "\n", &rest); line != NULL && words[0] == '\0';
                 line = strtok_r(NULL, "\n", &rest)) {
                const char *with = strstr(line, curves[k].with);
                if (with != NULL && strstr(line, "' index ") != NULL)
                    columns_of_item(line, sections, n, words, sizeof words);
            }
            if (strcmp(words, curves[k].columns) != 0)
                fail_msg("%s, %s: drawn from \"%s\", not from \"%s\"", figure, curves[k].with,
                         words, curves[k].columns);
            checked++;
            free(script);
        }
        if (checked == 0)
            fail_msg("no curve of %s is checked", figure);
        free_sections(sections, n);
    }
}

/* A described curve without a number has no entry in the key. */
static void stop_wear(wt_table *layer, size_t row)
{
    (void)row;
    fixture_put(layer, "wear_rate", 0);
}

static void forget_adhesion(wt_table *friction, size_t row)
{
    (void)row;
    fixture_put(friction, "adhesion", (double)NAN);
}

static void test_the_key_lists_what_is_drawn(void **state)
{
    (void)state;
    NEED_REPORT();
    static const fixture_change changes[] = {{"layer", .edit = stop_wear},
                                             {"friction", .edit = forget_adhesion}};
    wt_result *result = fixture_changed(fixture_produced(), changes, 2);
    write_report(result, "key", NULL);
    char *layer = read_plot("key", "layer", "gp"), *friction = read_plot("key", "friction", "gp");
    assert_non_null(strstr(layer, "'formation'"));
    assert_null(strstr(layer, "'wear'"));
    assert_non_null(strstr(friction, "'hysteresis'"));
    assert_null(strstr(friction, "'shearing'"));
    free(layer);
    free(friction);
    wt_result_free(result);
}

/* A model without incubation still states its time; the curve then has none, and no mark. */
static void grow_at_once(wt_table *layer, size_t row)
{
    fixture_put(layer, "thickness", 1e-8 * (double)(row + 1));
}

/* A time at the end of the curve is on its axis. */
static void relax_at_the_end(wt_table *layer)
{
    fixture_key(layer, "relaxation_time", number_cell(layer, wt_table_n_rows(layer) - 1, "time"), 0,
                "s");
}

static void test_marks_at_the_end(void **state)
{
    (void)state;
    NEED_REPORT();
    const fixture_change change = {"layer", .finish = relax_at_the_end};
    wt_result *result = fixture_with(&change);
    const wt_table *const layer = wt_result_find(result, "layer");
    write_report(result, "ends", NULL);
    char *script = read_plot("ends", "layer", "gp");
    const char *label = strstr(script, "set label 'relaxation' at ");
    assert_non_null(label);
    assert_near(strtod(label + strlen("set label 'relaxation' at "), NULL),
                number_cell(layer, wt_table_n_rows(layer) - 1, "time"), 1e-6);
    free(script);
    wt_result_free(result);
}

static void test_incubation_is_marked_where_the_curve_shows_it(void **state)
{
    (void)state;
    NEED_REPORT();
    char *script = read_plot("out", "layer", "gp");
    const wt_table *const layer = wt_result_find(fixture_produced(), "layer");
    wt_estimate incubation;
    const char *label = strstr(script, "set label 'incubation' at ");
    assert_non_null(label);
    assert_true(wt_table_estimate(layer, "incubation_time", &incubation));
    assert_near(strtod(label + strlen("set label 'incubation' at "), NULL), incubation.value, 1e-6);
    assert_near(incubation.value, 1.2, 0.02);
    free(script);
    const fixture_change change = {"layer", .edit = grow_at_once};
    wt_result *result = fixture_with(&change);
    write_report(result, "grows", NULL);
    script = read_plot("grows", "layer", "gp");
    assert_null(strstr(script, "ncubation"));
    free(script);
    wt_result_free(result);
}

/* ---- captions -------------------------------------------------------------------------------- */

static double number_behind(const char *text, const char *words)
{
    const char *at = strstr(text, words);
    if (at == NULL)
        fail_msg("no \"%s\" in the script", words);
    return strtod(at + strlen(words), NULL);
}

/* The axes of a map end half a step beyond the outermost curves, plus a margin. */
static void test_range_of_a_map(void **state)
{
    (void)state;
    NEED_REPORT();
    wt_table *sections[MOST];
    const size_t n = read_sections("out", "modulus_map", sections);
    char *script = read_plot("out", "modulus_map", "gp");
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < n; i++) {
        const long x = wt_table_find(sections[i], "x");
        for (size_t row = 0; x >= 0 && row < wt_table_n_rows(sections[i]); row++) {
            low = fmin(low, wt_table_number(sections[i], row, (size_t)x));
            high = fmax(high, wt_table_number(sections[i], row, (size_t)x));
        }
    }
    const double half = number_behind(script, "half_x = "),
                 unit = number_behind(script, "x_unit = ");
    const double width = high - low + 2 * half;
    assert_true(half > 0 && width > 2 * half);
    const double range = number_behind(script, "set xrange [");
    assert_near(range, (low - half - 0.04 * width) * unit, 1e-9);
    free(script);
    free_sections(sections, n);
}

/* Raw and shifted isotherms share one colour scale, and so does the plane. */
static void test_one_scale_of_colour(void **state)
{
    (void)state;
    NEED_REPORT();
    static const char *const others[] = {"master_curve", "van_gurp_palmen"};
    char *script = read_plot("out", "isotherms", "gp");
    const double low = number_behind(script, "set cbrange [");
    free(script);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        script = read_plot("out", others[i], "gp");
        assert_near(number_behind(script, "set cbrange ["), low, 0);
        free(script);
    }
}

static void warm_by_two_kelvins(wt_table *isotherms, size_t row)
{
    fixture_add_steps(isotherms, row);
    fixture_put(isotherms, "temperature", 293.15 + 2 * (double)(row % 5));
}

/* Set twice, to values of an oven. */
static void warm_once(wt_table *isotherms, size_t row)
{
    static const double set[] = {293.15, 293.45, 295.15, 294.9};
    fixture_add_steps(isotherms, row);
    fixture_put(isotherms, "temperature", set[row % 4]);
}

static size_t count_of(const char *text, const char *words)
{
    size_t n = 0;
    while ((text = strstr(text, words)) != NULL) {
        text += strlen(words);
        n++;
    }
    return n;
}

/* Temperatures are distinguished in kelvins, not relative to 293 K. */
static void test_temperatures_are_colours(void **state)
{
    (void)state;
    NEED_REPORT();
    static const struct {
        const char *folder;
        fixture_change change;
        size_t named; /* in the key; 0: a scale */
    } cases[] = {
        {"five", {"master_curve", .begin = fixture_begin_steps, .edit = warm_by_two_kelvins}, 0},
        {"two", {"master_curve", .begin = fixture_begin_steps, .edit = warm_once}, 2}};
    static const char *const tables[] = {"master_curve"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_result *result = fixture_only(tables, 1, &cases[i].change);
        write_report(result, cases[i].folder, NULL);
        char *script = read_plot(cases[i].folder, "relaxation_isotherms", "gp");
        assert_int_equal(count_of(script, "lc palette cb"), cases[i].named);
        assert_int_equal(count_of(script, "unset colorbox"), cases[i].named > 0);
        free(script);
        wt_result_free(result);
    }
}

/* The axis of a plane extends over both moduli and their derived values. */
static void test_range_of_a_plane(void **state)
{
    (void)state;
    NEED_REPORT();
    wt_table *sections[MOST];
    const size_t n = read_sections("out", "van_gurp_palmen", sections);
    double most = 0;
    for (size_t row = 0; row < wt_table_n_rows(sections[0]); row++)
        most = fmax(most, atan2(wt_table_number(sections[0], row, 2),
                                wt_table_number(sections[0], row, 1)) *
                              180 / M_PI);
    char *script = read_plot("out", "van_gurp_palmen", "gp");
    assert_near(number_behind(script, "set yrange [0:"), 1.04 * most, 1e-6);
    free(script);
    free_sections(sections, n);
}

/* A vertical shift of zero has no picture. */
static void forget_vertical(wt_table *shifts)
{
    fixture_words(shifts, "vertical", "none");
}

static void test_no_vertical_shift_no_figure(void **state)
{
    (void)state;
    NEED_REPORT();
    static const char *const tables[] = {"shift_factors"};
    const fixture_change change = {"shift_factors", .finish = forget_vertical};
    wt_result *result = fixture_only(tables, 1, &change);
    write_report(result, "flat", NULL);
    assert_true(exists("flat/plots/shift_factors.gp"));
    assert_false(exists("flat/plots/vertical_shifts.gp"));
    wt_result_free(result);
}

/* A subscript needs the enhanced mode, which labels do not use. */
static void test_label_with_subscripts(void **state)
{
    (void)state;
    NEED_REPORT();
    char *script = read_plot("out", "shift_factors", "gp");
    assert_non_null(strstr(script, "set ylabel 'Shift factor, log_{10} a_T' enhanced\n"));
    // The law is not drawn over the first isotherm, of -30 degC, which does not determine it.
    const char *low = strstr(script, "; t_low = ");
    assert_non_null(low);
    assert_near_abs(strtod(low + strlen("; t_low = "), NULL), -20, 0.1);
    free(script);
}

/* The labels of vertical axes are on the paper with their ascenders, in both panels. */
static void test_labels_are_on_the_paper(void **state)
{
    (void)state;
    NEED_REPORT();
    char *picture = read_plot("out", "shift_factors", "svg");
    int n = 0;
    for (const char *p = picture; (p = strstr(p, "translate(")) != NULL; p++) {
        double x = 0, y = 0, turn = 0;
        if (sscanf(p, "translate(%lf,%lf) rotate(%lf)", &x, &y, &turn) != 3)
            continue;
        assert_true(x > 15);
        n++;
    }
    assert_int_equal(n, 2);
    free(picture);
}

static void check_caption(const char *folder, const char *figure, const char *words)
{
    char *script = read_plot(folder, figure, "gp"), *end = strstr(script, "\nreset\n");
    assert_non_null(end);
    *end = '\0';
    if (strstr(script, words) == NULL)
        fail_msg("the caption of %s lacks \"%s\":\n%s", figure, words, script);
    free(script);
}

/* Numbers of the case are those of its tables (and of truth.txt, within their errors), or of the
 * fixture. */
static void test_numbers_of_captions(void **state)
{
    (void)state;
    NEED_REPORT();
    static const char *const captions[][2] = {
        {"force_displacement", " (95 %). The vertical line"},
        {"force_indentation", " Lines: contact model with the fitted modulus."},
        {"modulus_groups", " Unit of analysis of the interval: spot. bulk: n = 48, rejected 0. "
                           "track: n = 48, rejected 0."},
        {"modulus_rate", ": bulk n = 16, 16, 16; track n = 16, 16, 16."},
        {"dma_comparison", " 1 of 6 points lie outside"},
        {"master_curve", " of 20 °C, and tan δ below; 192 points of 12 isotherms, "},
        {"master_curve", " one relaxation spectrum of "},
        {"softening", " Softening: given table. Largest strain met: 0.40. more friction."},
        {"friction_decades", " The most: 1e+05 to 1e+06 rad/m"},
        {"flash_temperature", " Surroundings at 20 °C; 28.9 K warmer."},
        {"isotherms", " 12 isotherms. Curves that superposition"},
        {"vertical_shifts", " they deviate from it by up to "},
        {"shift_factors", " C₁ = 6.502 (95 %: 6.479 to 6.525) and C₂ = 110.06 K (95 %: 109.83 to "
                          "110.30), with the offset"},
        {"shift_factors", " Not determined by overlap: 1 of 12 isotherms."},
        {"power_spectrum", " height 44.8 µm. Root-mean-square slope 0.945."},
        {"friction", " (from material with its shift law, roughness, shear stress, "
                     "thickness of the layer, modulus ratio of the layer)."},
        {"friction",
         ", thickness 3.16 µm (95 %: 1.60 to 4.72). Conditions: nominal pressure 400 kPa, "
         "temperature 30 °C, shear stress of the real contact 5 MPa. "},
        {"friction", " numerical error of the hysteresis part: 0.0020 %, not in the bands."},
        {"friction", " Up to 4.0 % of the hysteresis part comes"},
        {"layer", " Balance thickness 3.16 µm (95 %: 1.60 to 4.72). Incubation time 1.20 s (95 %: "
                  "0.882 to 1.53). Relaxation time 46.5 s (95 %: 14.8 to 78.2)."},
    };
    for (size_t i = 0; i < sizeof captions / sizeof *captions; i++)
        check_caption("out", captions[i][0], captions[i][1]);

    const wt_table *curves = wt_result_find(everything, "force_displacement");
    wt_estimate bulk, track;
    assert_true(wt_table_estimate(curves, "contact_point_bulk", &bulk));
    assert_true(wt_table_estimate(curves, "contact_point_track", &track));
    char words[200];
    (void)snprintf(words, sizeof words, " bulk: %s, contact point ± %.3g nm (95 %%). ",
                   wt_table_key(curves, "curve_bulk"), 1e9 * NORMAL_95 * bulk.standard_error);
    check_caption("out", "force_displacement", words);
    /* the interval of the exponent is not that of a normal error */
    wt_estimate low, high;
    const wt_table *surface = wt_result_find(everything, "power_spectrum");
    assert_true(wt_table_estimate(surface, "hurst_low", &low) &&
                wt_table_estimate(surface, "hurst_high", &high));
    (void)snprintf(words, sizeof words, " (95 %%: %.3f to %.3f)", low.value, high.value);
    check_caption("out", "measured_spectrum", words);
    (void)snprintf(words, sizeof words, " curve 7, contact point ± %.3g nm (95 %%). ",
                   1e9 * NORMAL_95 * track.standard_error);
    check_caption("out", "force_displacement", words);
}

static void extrapolate_little(wt_table *friction, size_t row)
{
    fixture_put(friction, "extrapolated_share", row == 0 ? 9e-4 : 0);
}

static void repeat_curves(wt_table *curves)
{
    const size_t n = wt_table_n_rows(curves), columns = wt_table_n_columns(curves);
    for (size_t i = 0; i < 100 * n; i++) {
        fixture_check(wt_table_add_row(curves, NULL));
        for (size_t c = 0; c < columns; c++)
            if (wt_table_column_kind(curves, c) == WT_COLUMN_NUMBER)
                wt_table_set_number(curves, c, wt_table_number(curves, i % n, c));
            else
                wt_table_set_text(curves, c, wt_table_text(curves, i % n, c));
    }
}

/* One more scan, of three points, which is not a grid. */
static void add_ragged(wt_table *map)
{
    for (int i = 0; i < 3; i++) {
        fixture_check(wt_table_add_row(map, NULL));
        fixture_put(map, "scan", 99);
        fixture_put(map, "x", i % 2 * 1e-6);
        fixture_put(map, "y", i / 2 * 1e-6);
        fixture_put(map, "height", 1e-9);
    }
}

/* Every n-th point is drawn, and the caption states it; it also states what cannot be drawn. */
static void test_many_points_are_thinned(void **state)
{
    (void)state;
    NEED_REPORT();
    static const fixture_change changes[] = {{"friction", .edit = extrapolate_little},
                                             {"force_displacement", .finish = repeat_curves},
                                             {"force_indentation", .finish = repeat_curves},
                                             {"indentation/bulk", .finish = repeat_curves},
                                             {"indentation/track", .finish = repeat_curves},
                                             {"height_map", .finish = add_ragged}};
    wt_result *result = fixture_changed(fixture_produced(), changes, 6);
    write_report(result, "crowd", NULL);
    check_caption("crowd", "friction", " Less than 0.1 % of the hysteresis part comes");
    check_caption("crowd", "height_map", " Not drawn: 1 of the scans, whose points are no grid");
    static const struct {
        const char *figure, *words;
        size_t left;
    } crowds[] = {{"force_displacement", "One sample of", 1200},
                  {"force_indentation", "One sample of up to", 220},
                  {"modulus_groups", "One curve of up to", 3000}};
    for (size_t i = 0; i < 3; i++) {
        wt_table *sections[MOST];
        char words[64];
        const size_t n = read_sections("crowd", crowds[i].figure, sections);
        size_t most = 0;
        for (size_t k = 0; k < n; k++)
            most = wt_table_n_rows(sections[k]) > most ? wt_table_n_rows(sections[k]) : most;
        assert_true(most > crowds[i].left);
        (void)snprintf(words, sizeof words, " %s %zu is drawn.", crowds[i].words,
                       (most + crowds[i].left - 1) / crowds[i].left);
        check_caption("crowd", crowds[i].figure, words);
        free_sections(sections, n);
    }
    wt_result_free(result);
}

/* ---- required tables ------------------------------------------------------------------------- */

static void check_refused(const char *table, const char *column, const fixture_change *change,
                          wt_status expected)
{
    wt_result *result = fixture_only(&table, 1, change);
    wt_error err = WT_ERROR_INIT;
    wt_status status = wt_report_write(result, "refused", NULL, NULL, &err);
    if (status != expected || strstr(err.message, table) == NULL ||
        strstr(err.message, column) == NULL || exists("refused"))
        fail_msg("column %s of table %s: status %d, %s", column, table, (int)status, err.message);
    wt_result_free(result);
}

/* A missing required column or key, or one of the wrong type, is an error that names table and
 * column; nothing is written. */
static void test_missing_column_is_an_error(void **state)
{
    (void)state;
    size_t checked = 0;
    assert_int_equal(chdir(place), 0);
    for (size_t t = 0; t < table_n_schemas; t++) {
        const table_schema *schema = table_schemas[t];
        char name[SCHEMA_NAME_SIZE];
        schema_name(schema->name, "bulk", name);
        const wt_table *const produced = wt_result_find(fixture_produced(), name);
        if (produced == NULL || schema == &spectrum_schema)
            continue;
        for (size_t c = 0; c < schema->n_columns; c++) {
            const char *column = schema->columns[c].name;
            const fixture_change without = {name, .without = column},
                                 swapped = {name, .swapped = column};
            if (schema->columns[c].optional && wt_table_find(produced, column) < 0)
                continue; /* of another measurement */
            if (!schema->columns[c].optional)
                check_refused(name, column, &without, WT_E_MISSING);
            check_refused(name, column, &swapped, WT_E_UNIT);
            checked++;
        }
        for (size_t k = 0; k < schema->n_keys; k++) {
            const fixture_change without = {name, .without = schema->keys[k].name};
            if (!schema->keys[k].optional)
                check_refused(name, schema->keys[k].name, &without, WT_E_MISSING);
        }
    }
    assert_true(checked > 100);
}

/* The part of a missing optional column is omitted. */
static void test_optional_columns(void **state)
{
    (void)state;
    NEED_REPORT();
    for (size_t c = 0; c < indentation_schema.n_columns; c++) {
        if (!indentation_schema.columns[c].optional)
            continue;
        const fixture_change change = {"indentation/bulk",
                                       .without = indentation_schema.columns[c].name};
        const char *const tables[] = {"indentation/bulk"};
        wt_result *result = fixture_only(tables, 1, &change);
        write_report(result, "less", NULL);
        wt_result_free(result);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tables_are_read),
        cmocka_unit_test(test_descriptions_fit_their_tables),
        cmocka_unit_test(test_data_have_the_described_columns),
        cmocka_unit_test(test_curves_are_drawn_from_their_columns),
        cmocka_unit_test(test_the_key_lists_what_is_drawn),
        cmocka_unit_test(test_marks_at_the_end),
        cmocka_unit_test(test_incubation_is_marked_where_the_curve_shows_it),
        cmocka_unit_test(test_label_with_subscripts),
        cmocka_unit_test(test_labels_are_on_the_paper),
        cmocka_unit_test(test_range_of_a_map),
        cmocka_unit_test(test_one_scale_of_colour),
        cmocka_unit_test(test_temperatures_are_colours),
        cmocka_unit_test(test_range_of_a_plane),
        cmocka_unit_test(test_no_vertical_shift_no_figure),
        cmocka_unit_test(test_numbers_of_captions),
        cmocka_unit_test(test_many_points_are_thinned),
        cmocka_unit_test(test_missing_column_is_an_error),
        cmocka_unit_test(test_optional_columns),
    };
    return cmocka_run_group_tests(tests, create_shared_report, remove_shared_report);
}
