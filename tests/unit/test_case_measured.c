/* A whole case from measured files of other people, if the shared reference data exist: two JPK
 * maps as bulk and wear track, isotherms of a soft polymer.
 * SPDX-License-Identifier: GPL-3.0-or-later */

#include "table_cells.h"

#include "core/base/array.h"
#include "weartrack/case.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define JPK WT_SHARED_DIR "/data/afm/jpk/"
#define SWEEPS WT_SHARED_DIR "/data/dma/trios/frequency_sweep_tts.txt"

/* Without tests of lack of fit: these cells are adhesive and their baselines are curved. */
static const char text[] =
    "<case version=\"1\"><indentation><tip>pyramid:half-angle=17.5deg,radius=20nm</tip>"
    "<misfit-p-threshold>0</misfit-p-threshold>"
    "<bulk><files>" JPK "map-data-2022.10.29-12.27.34.564.jpk-force-map</files></bulk>"
    "<track><files>" JPK "fmt-jpk-cc_pr14-polymergel-2021.06.30.jpk-force</files></track>"
    "</indentation><dma><files>" SWEEPS "</files></dma>"
    "<roughness><self-affine><q0>2e3rad/m</q0><qr>4e3rad/m</qr><q1>2e6rad/m</q1>"
    "<hurst>0.8</hurst><c0>2e-17m^4</c0></self-affine></roughness>"
    "<sliding><pressure>0.4MPa</pressure><velocity>1e-4:10m/s:log:11</velocity>"
    "<temperature>60degC</temperature><shear-stress>5MPa</shear-stress></sliding>"
    "<layer><specific-wear-rate>1e-3mm^3/(N m)</specific-wear-rate>"
    "<critical-energy>1e11J/m^3</critical-energy></layer></case>";

static wt_result *run_case(const char *xml, size_t *n_failed)
{
    char path[] = "/tmp/weartrack-measured-XXXXXX";
    int file = mkstemp(path);
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_run_options options = wt_run_defaults();
    options.replicates = 8;
    assert_true(file >= 0);
    assert_int_equal(write(file, xml, strlen(xml)), (ssize_t)strlen(xml));
    close(file);
    if (wt_case_read(path, &c, &err) != WT_OK ||
        wt_run_case(c, &options, NULL, &result, n_failed, &err) != WT_OK)
        fail_msg("%s: %s: %s", err.file, err.place, err.message);
    wt_case_free(c);
    unlink(path);
    return result;
}

static void test_measured(void **state)
{
    (void)state;
    static const char *const tables[] = {"indentation/bulk",
                                         "indentation/track",
                                         "force_displacement",
                                         "force_indentation",
                                         "modulus_depth",
                                         "modulus_groups",
                                         "modulus_rate",
                                         "comparison",
                                         "track_layer",
                                         "dma_comparison",
                                         "shift_factors",
                                         "master_curve",
                                         "prony",
                                         "material_draws",
                                         "series_draws",
                                         "roughness",
                                         "friction",
                                         "contact_area",
                                         "layer",
                                         "energy_density",
                                         "what_if",
                                         "answer",
                                         "limits",
                                         "modulus_budget",
                                         "inputs",
                                         "methods",
                                         "notes",
                                         "failures",
                                         "cost"};
    if (access(SWEEPS, R_OK) != 0)
        skip();
    size_t n_failed = 99;
    wt_result *result = run_case(text, &n_failed);
    assert_int_equal(n_failed, 0);
    for (size_t i = 0; i < COUNT_OF(tables); i++)
        if (wt_result_find(result, tables[i]) == NULL)
            fail_msg("no table %s", tables[i]);
    assert_int_equal(wt_result_n_tables(result), COUNT_OF(tables));
    assert_int_equal(wt_table_n_rows(wt_result_find(result, "indentation/bulk")), 16);
    assert_int_equal(wt_table_n_rows(wt_result_find(result, "indentation/track")), 1);
    assert_int_equal(wt_table_n_rows(wt_result_find(result, "shift_factors")), 20);
    assert_int_equal(wt_table_n_rows(wt_result_find(result, "inputs")), 4);

    /* a glass on the cold side, so friction is finite, positive, and has an error */
    const wt_table *friction = wt_result_find(result, "friction");
    assert_int_equal(wt_table_n_rows(friction), 11);
    for (size_t i = 0; i < 11; i++) {
        double mu = number_cell(friction, i, "friction");
        double area = number_cell(friction, i, "area_ratio");
        assert_true(mu > 0 && mu < 15 && area > 0 && area <= 1);
        assert_true(number_cell(friction, i, "friction_standard_error") > 0);
        assert_true(number_cell(friction, i, "hysteresis_numerical_error") <=
                    1e-9 * number_cell(friction, i, "hysteresis"));
        assert_true(number_cell(friction, i, "friction_with_layer") > 0);
    }
    /* the two samples are different materials, so the limitations state the origin of the result */
    const wt_table *limits = wt_result_find(result, "limits"),
                   *notes = wt_result_find(result, "notes");
    bool spots = false, strain = false, cantilever = false, lacks = false;
    for (size_t i = 0; i < wt_table_n_rows(limits); i++) {
        const char *sentence = text_cell(limits, i, "limit");
        spots = spots || strstr(sentence, "counts as one spot") != NULL;
        cantilever = cantilever || strstr(sentence, "with two cantilevers") != NULL;
        lacks = lacks || strstr(sentence, "specific wear rate, critical energy") != NULL;
    }
    for (size_t i = 0; i < wt_table_n_rows(notes); i++)
        strain = strain || strstr(text_cell(notes, i, "text"), "strain amplitudes") != NULL;
    assert_true(spots && strain && cantilever && lacks);
    wt_result_free(result);
}

/* Only requested inputs are opened: the curves need not exist if only the material is requested. */
static void test_only_requested_inputs_are_opened(void **state)
{
    (void)state;
    static const char xml[] =
        "<case version=\"1\"><indentation><tip>sphere:radius=5um</tip><bulk><files>/nowhere/*"
        "</files></bulk></indentation><dma><files>" SWEEPS "</files></dma>"
        "<report><result>prony</result></report></case>";
    if (access(SWEEPS, R_OK) != 0)
        skip();
    size_t n_failed = 99;
    wt_result *result = run_case(xml, &n_failed);
    assert_int_equal(n_failed, 0);
    assert_int_equal(wt_table_n_rows(wt_result_find(result, "inputs")), 2);
    assert_non_null(wt_result_find(result, "prony"));
    assert_null(wt_result_find(result, "master_curve"));
    wt_result_free(result);
}

/* No curve of the track is usable: the comparison is inconclusive, the bulk has a result, and the
 * reasons are stated. */
static void test_no_track(void **state)
{
    (void)state;
    static const char xml[] =
        "<case version=\"1\"><indentation><tip>pyramid:half-angle=17.5deg,radius=20nm</tip>"
        "<bulk><files>" JPK "map-data-2022.10.29-12.27.34.564.jpk-force-map</files></bulk>"
        "<track><files>" JPK "fmt-jpk-fd_single_bad_2017-01-16_2.jpk-force</files></track>"
        "</indentation></case>";
    if (access(SWEEPS, R_OK) != 0)
        skip();
    size_t n_failed = 99;
    wt_result *result = run_case(xml, &n_failed);
    const wt_table *groups = wt_result_find(result, "modulus_groups");
    assert_int_equal(n_failed, 0);
    assert_int_equal(wt_table_n_rows(wt_result_find(result, "comparison")), 1);
    assert_non_null(groups);
    assert_int_equal(wt_table_n_rows(groups), 2);
    /* Three curves have a curved baseline or adhesion that no law describes, and wide errors. */
    assert_near(number_cell(groups, 0, "n"), 16, 0);
    assert_near(number_cell(groups, 1, "n"), 0, 0);
    assert_non_null(strstr(text_cell(wt_result_find(result, "answer"), 0, "answer"),
                           "The only curve of the track has no modulus (1: too few"));
    for (size_t i = 0; i < wt_table_n_rows(wt_result_find(result, "answer")); i++)
        assert_null(strstr(text_cell(wt_result_find(result, "answer"), i, "answer"), "nan"));
    wt_result_free(result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_measured),
        cmocka_unit_test(test_only_requested_inputs_are_opened),
        cmocka_unit_test(test_no_track),
    };
    return cmocka_run_group_tests_name("flow measured", tests, NULL, NULL);
}
