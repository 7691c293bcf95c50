/* Measured JPK curves of the shared reference data, if they exist, against the fits of another
 * program: blunted pyramid (n = 4, R = 20 nm, half-angle 20 degrees, b = R cos theta, nu = 0.5),
 * plain least squares over the whole approach, only an offset as baseline. The probes were others,
 * so that the moduli compare programs and not materials.
 *
 * The same function of the same samples is minimised here, so that modulus and smallest cost agree.
 * The scan covers the whole curve, the other program descends from its first guess: where the
 * results differ, the cost here is the lower one.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "indentation/numerics/curve.h"
#include "weartrack/indentation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define REFERENCE WT_SHARED_DIR "/reference/blunted-pyramid-fits.csv"
#define DATA WT_SHARED_DIR "/data/afm/"

/* The reference prints the cost with 6 digits. */
static const double cost_tolerance = 1e-5;
static const double modulus_tolerance = 5e-4;

enum { MAX_ROWS = 200 };

typedef struct row {
    char file[256];
    size_t curve;
    double modulus, cost;
} row;

static row rows[MAX_ROWS];
static size_t n_rows;
static wt_contact_table *table;
static wt_indent_workspace *workspace;
static wt_formats *formats;

static void read_reference(void)
{
    FILE *in = fopen(REFERENCE, "r");
    assert_non_null(in);
    char line[1024];
    while (fgets(line, sizeof line, in) != NULL) {
        row r;
        double weight;
        if (strncmp(line, "jpk/", 4) == 0 &&
            sscanf(line, "%255[^,],%zu,%lf,%lf,%*[^,],%*[^,],%*[^,],%*[^,],%lf", r.file, &r.curve,
                   &weight, &r.modulus, &r.cost) == 5 &&
            weight == 0.0) {
            assert_true(n_rows < MAX_ROWS);
            rows[n_rows++] = r;
        }
    }
    fclose(in);
}

static const row *find_row(const char *file, size_t curve)
{
    for (size_t i = 0; i < n_rows; i++)
        if (rows[i].curve == curve && strcmp(rows[i].file, file) == 0)
            return &rows[i];
    return NULL;
}

/* Calls visit for every curve of a file in the data folder. */
static void for_each_curve(const char *file,
                           void (*visit)(const char *file, const wt_force_curve *curve))
{
    char path[512];
    snprintf(path, sizeof path, "%s%s", DATA, file);
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {0};
    wt_read_options options = wt_read_defaults();
    wt_error err = WT_ERROR_INIT;
    /* has none; the value that the reference assumed */
    if (strstr(file, "cl_calibration") != NULL) {
        options.spring_constant = 0.05;
        options.sensitivity = 60e-9;
    }
    assert_int_equal(wt_input_open(path, &input, &err), WT_OK);
    if (wt_force_open(formats, input, &options, NULL, &source, &err) != WT_OK)
        fail_msg("%s: %s", file, err.message);
    wt_status status;
    while ((status = wt_force_next(source, &curve, &err)) == WT_OK)
        visit(file, &curve);
    if (status != WT_END)
        fail_msg("%s: %s", file, err.message);
    wt_force_close(source);
    wt_input_close(input);
    wt_force_curve_clear(&curve);
}

static size_t n_compared, n_equal;

/* Scan and refinement only, so that rejected curves are compared, too. */
static void compare(const char *file, const wt_force_curve *curve)
{
    const row *r = find_row(file, curve->index);
    if (r == NULL)
        return;
    const wt_segment *approach = wt_force_curve_segment(curve, WT_SEGMENT_APPROACH);
    assert_non_null(approach);
    const wt_channel *height = wt_segment_channel(approach, WT_Q_MEASURED_HEIGHT);
    if (height == NULL)
        height = wt_segment_channel(approach, WT_Q_HEIGHT);
    const wt_channel *force = wt_segment_channel(approach, WT_Q_FORCE);
    assert_true(height != NULL && force != NULL);

    const wt_indent_options options = wt_indent_defaults();
    curve_input input;
    curve_minimum minima[CURVE_MAX_MINIMA];
    curve_solution solution;
    char reason[160];
    curve_reserve(workspace, approach->n_points);
    wt_curve_verdict verdict = curve_prepare(height->values, force->values, approach->n_points,
                                             curve->cantilever.spring_constant, &options,
                                             (double)NAN, workspace, &input, reason);
    if (verdict != WT_CURVE_ACCEPTED)
        fail_msg("%s %zu: %s", file, curve->index, reason);
    size_t n = curve_scan(table, &input.samples, false, false, workspace, minima);
    assert_true(n > 0);
    const double start[CURVE_N_PARAMETERS] = {minima[0].reduced_modulus, minima[0].contact_point,
                                              minima[0].offset, minima[0].tilt, 0};
    curve_refine(table, &input.samples, (curve_kind){.plain = true}, start, workspace, &solution);
    double modulus = 0.75 * solution.p[CURVE_E], cost = solution.cost;
    if (!(cost <= r->cost * (1.0 + cost_tolerance)))
        fail_msg("%s %zu: cost %.6g above %.6g of the other program", file, curve->index, cost,
                 r->cost);
    n_compared++;
    if (fabs(modulus / r->modulus - 1.0) < modulus_tolerance) {
        n_equal++;
        if (input.n_spikes == 0)
            assert_near(cost, r->cost, cost_tolerance);
    } else {
        print_message("%s %zu: %.6g Pa at cost %.7g, other program %.6g Pa at %.6g\n", file,
                      curve->index, modulus, cost, r->modulus, r->cost);
        /* Another minimum, equal to all known digits or better. */
        assert_true(cost < r->cost * (1.0 - cost_tolerance) ||
                    fabs(modulus / r->modulus - 1.0) < 5e-3);
    }
}

static void moduli_of_another_program(void **state)
{
    (void)state;
    if (access(REFERENCE, R_OK) != 0)
        skip();
    read_reference();
    for (size_t i = 0; i < n_rows; i++)
        if (i == 0 || strcmp(rows[i].file, rows[i - 1].file) != 0)
            for_each_curve(rows[i].file, compare);
    print_message("%zu curves compared, %zu with the same modulus to %g\n", n_compared, n_equal,
                  modulus_tolerance);
    assert_int_equal(n_compared, n_rows);
    assert_true(n_equal + 1 >= n_compared);
}

static wt_indent_fit answers[64];
static size_t n_answers;
static wt_indent_options answer_options;

static void keep_answer(const char *file, const wt_force_curve *curve)
{
    wt_error err = WT_ERROR_INIT;
    assert_true(n_answers < sizeof answers / sizeof answers[0]);
    if (wt_indent_fit_force_curve(table, &answer_options, curve, workspace, &answers[n_answers],
                                  &err) != WT_OK)
        fail_msg("%s: %s", file, err.message);
    assert_true(answers[n_answers].reason[0] != '\0');
    n_answers++;
}

/* Faulty curves get a result and a reason. */
static void awkward_curves(void **state)
{
    (void)state;
    if (access(DATA, R_OK) != 0)
        skip();
    const struct {
        const char *file;
        wt_curve_verdict verdict;
        const char *words;
    } cases[] = {
        {"jpk/fmt-jpk-fd_single_bad_2017-01-16_2.jpk-force", WT_CURVE_TOO_SHORT, "1 different"},
        {"jpk/fmt-jpk-fd_single_bad_bead7_2017-04-27.jpk-force", WT_CURVE_TOO_SHORT, "3 different"},
        {"jpk/fmt-jpk-fd_single_tilted-baseline-drift-mitotic_2021-01-29.jpk-force",
         WT_CURVE_ACCEPTED, "misfit: E +- "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        n_answers = 0;
        for_each_curve(cases[i].file, keep_answer);
        assert_int_equal(n_answers, 1);
        if (answers[0].verdict != cases[i].verdict ||
            strstr(answers[0].reason, cases[i].words) == NULL)
            fail_msg("%s: %s: %s", cases[i].file, wt_curve_verdict_id(answers[0].verdict),
                     answers[0].reason);
    }
    /* The tilt explains the deviation of this curve from the fit with an offset only: R^2 0.987
     * there. */
    /* The error includes the effects of curvature and lack of fit; that of white noise alone is far
     * smaller. */
    assert_true(answers[0].baseline_tilt.value > 20 * answers[0].baseline_tilt.standard_error);
}

/* Curves with a second contact point in block means over a few hundred samples, or in contact
 * points 4 % of the depth apart, that the samples do not have. */
static void contact_points_of_all_samples(void **state)
{
    (void)state;
    if (access(DATA, R_OK) != 0)
        skip();
    const struct {
        const char *file;
        size_t curve; /* index in the file */
        bool tilt;
        double modulus;
    } cases[] = {
        {"jpk/force-map2x2-example.jpk-force-map", 3, false, 124132.4},
        {"jpk/force-map2x2-example.jpk-force-map", 3, true, 136951.5},
        {"jpk/fmt-jpk-fd_map-data-reference-points.jpk-force-map", 1, false, 298938.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        answer_options.fit_tilt = cases[i].tilt;
        n_answers = 0;
        for_each_curve(cases[i].file, keep_answer);
        assert_true(n_answers > cases[i].curve);
        const wt_indent_fit *fit = &answers[cases[i].curve];
        assert_near(fit->modulus.value, cases[i].modulus, 1e-5);
    }
    answer_options.fit_tilt = true;
}

static int set_up(void **state)
{
    (void)state;
    wt_tip tip = {.shape = WT_TIP_BLUNTED_PYRAMID,
                  .sides = 4,
                  .half_angle = 20 * M_PI / 180,
                  .radius = 20e-9};
    tip.transition_radius = wt_tip_tangent_transition(tip.radius, tip.half_angle);
    answer_options = wt_indent_defaults();
    workspace = wt_indent_workspace_new();
    return workspace == NULL || wt_contact_table_new(&tip, 1e-11, 1e-4, &table, NULL) != WT_OK ||
           wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK;
}

static int tear_down(void **state)
{
    (void)state;
    wt_formats_free(formats);
    wt_contact_table_free(table);
    wt_indent_workspace_free(workspace);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moduli_of_another_program),
        cmocka_unit_test(awkward_curves),
        cmocka_unit_test(contact_points_of_all_samples),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
