/* A single curve that is fitted again has the numbers of the whole run, also after a change of the
 * case and after another curve.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "table_cells.h"

#include "case/case.h"
#include "case/run/refit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CASE WT_SOURCE_DIR "/fixtures/case/case.xml"

static wt_formats *formats;
static case_refit *refit;
static char *text;
static size_t length;

static int set_up(void **state)
{
    (void)state;
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, NULL), WT_OK);
    assert_int_equal(wt_input_open(CASE, &input, NULL), WT_OK);
    assert_int_equal(wt_input_bytes(input, &bytes, &length, NULL), WT_OK);
    text = wt_strndup((const char *)bytes, length);
    wt_input_close(input);
    refit = case_refit_new(formats);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    case_refit_free(refit);
    wt_formats_free(formats);
    free(text);
    return 0;
}

static wt_status fit(const char *xml, const refit_curve *which, wt_indent_tables *tables,
                     wt_error *err)
{
    return case_refit_curve(refit, xml, strlen(xml), CASE, which, NULL, tables, err);
}

static double modulus(const char *xml, const refit_curve *which, double *contact)
{
    wt_indent_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    if (fit(xml, which, &tables, &err) != WT_OK)
        fail_msg("%s", err.message);
    assert_int_equal(wt_table_n_rows(tables.indentation), 1);
    assert_true(number_cell(tables.indentation, 0, "curve") == (double)which->curve);
    assert_true(wt_table_n_rows(tables.curves) > 100);
    const double value = number_cell(tables.indentation, 0, "modulus");
    *contact = number_cell(tables.indentation, 0, "contact_point");
    wt_indent_tables_clear(&tables);
    return value;
}

static void has_the_numbers_of_the_run(void **state)
{
    (void)state;
    static const char *const groups[] = {"bulk", "track"};
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_run_options options = wt_run_defaults();
    options.replicates = 0;
    assert_int_equal(wt_case_read(CASE, &c, NULL), WT_OK);
    assert_int_equal(wt_case_request_tables(c, "indentation/bulk indentation/track", NULL), WT_OK);
    assert_int_equal(wt_run_case(c, &options, NULL, &result, NULL, NULL), WT_OK);
    for (size_t g = 0; g < 2; g++) {
        char name[64];
        (void)snprintf(name, sizeof name, "indentation/%s", groups[g]);
        const wt_table *rows = wt_result_find(result, name);
        assert_int_equal(wt_table_n_rows(rows), 48);
        for (size_t i = 0; i < 48; i += 5) {
            const refit_curve which = {groups[g], text_cell(rows, i, "file"),
                                       (size_t)number_cell(rows, i, "curve"), "", ""};
            double contact;
            for (int again = 0; again < 2; again++)
                assert_true(modulus(text, &which, &contact) == number_cell(rows, i, "modulus"));
            assert_true(contact == number_cell(rows, i, "contact_point"));
        }
    }
    wt_result_free(result);
    wt_case_free(c);
}

static void follows_contact_point_and_case(void **state)
{
    (void)state;
    refit_curve which = {"bulk", "bulk-2.jpk-force-map", 3, "", ""};
    double contact, moved;
    char by[64];
    const double fitted = modulus(text, &which, &contact);
    (void)snprintf(by, sizeof by, "%.17g m", contact + 5e-9);
    which.option = "fixed-contact-point";
    which.value = by;
    const double by_hand = modulus(text, &which, &moved);
    assert_true(by_hand > 1.01 * fitted);
    assert_true(moved == contact + 5e-9);
    which.option = which.value = "";
    /* a stiffer cantilever is in the section of the group, so the curve is read again */
    char *stiffer = wt_strdup(text);
    char *at = strstr(stiffer, "0.3N/m");
    assert_non_null(at);
    at[2] = '6';
    assert_true(modulus(stiffer, &which, &contact) > 1.5 * fitted);
    assert_true(modulus(text, &which, &contact) == fitted);
    free(stiffer);
    /* without the material each curve has the modulus of its own rate */
    char *plain = wt_strdup(text);
    char *dma = strstr(plain, "<dma>"), *end = strstr(plain, "</dma>");
    assert_true(dma != NULL && end != NULL);
    memset(dma, ' ', (size_t)(end - dma) + strlen("</dma>"));
    assert_true(modulus(plain, &which, &contact) != fitted);
    assert_true(modulus(text, &which, &contact) == fitted);
    free(plain);
}

/* Friction at the second velocity of a case, with stored data or from a separate run. */
static double friction_of(const char *xml, bool kept)
{
    wt_case *c = NULL;
    wt_result *result = NULL;
    wt_run_options options = wt_run_defaults();
    options.replicates = 0;
    wt_status status = WT_OK;
    if (kept) {
        status = case_refit_run(refit, xml, strlen(xml), CASE, "friction", &options, &result, NULL);
    } else {
        assert_int_equal(case_from_bytes(xml, strlen(xml), CASE, &c, NULL), WT_OK);
        assert_int_equal(wt_case_request_tables(c, "friction", NULL), WT_OK);
        status = wt_run_case(c, &options, NULL, &result, NULL, NULL);
    }
    assert_int_equal(status, WT_OK);
    const double friction = number_cell(wt_result_find(result, "friction"), 1, "friction");
    wt_result_free(result);
    wt_case_free(c);
    return friction;
}

/* Rubber and surface are stored while the sliding changes, and computed again after their own
 * change. */
static void keeps_rubber_and_surface(void **state)
{
    (void)state;
    static const char *const changes[][2] = {{"", ""},
                                             {"<pressure>0.4MPa", "<pressure>0.5MPa"},
                                             {"<end>2e6rad/m", "<end>3e6rad/m"},
                                             {"<vertical-shift>tied", "<vertical-shift>none"},
                                             {"road-2.gsf", "road-1.gsf"}};
    double last = 0;
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        char *changed = wt_strdup(text), *at = strstr(changed, changes[i][0]);
        assert_non_null(at);
        memcpy(at, changes[i][1], strlen(changes[i][1]));
        const double fresh = friction_of(changed, false);
        assert_true(fresh > 0 && fresh != last);
        assert_true(friction_of(changed, true) == fresh);
        assert_true(friction_of(changed, true) == fresh);
        last = fresh;
        free(changed);
    }
}

static void names_missing_inputs(void **state)
{
    (void)state;
    static const refit_curve wrong[] = {{"bulk", "bulk-2.jpk-force-map", 99, "", ""},
                                        {"bulk", "../case/bulk-2.jpk-force-map", 0, "", ""},
                                        {"bulk", "/etc/hostname", 0, "", ""}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        wt_indent_tables tables = {0};
        wt_error err = WT_ERROR_INIT;
        assert_int_not_equal(fit(text, &wrong[i], &tables, &err), WT_OK);
        assert_true(err.message[0] != '\0');
        wt_indent_tables_clear(&tables);
    }
    wt_indent_tables tables = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_not_equal(fit("<case", &wrong[0], &tables, &err), WT_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(has_the_numbers_of_the_run),
                                       cmocka_unit_test(follows_contact_point_and_case),
                                       cmocka_unit_test(keeps_rubber_and_surface),
                                       cmocka_unit_test(names_missing_inputs)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
