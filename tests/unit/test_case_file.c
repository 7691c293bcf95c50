/* Reading of case files: their contents, and the messages for errors.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "status_name.h"

#include "case/case.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[] = "/tmp/weartrack-case-XXXXXX";

static wt_status read_text(const char *text, wt_case **c, wt_error *err)
{
    strcpy(path + strlen(path) - 6, "XXXXXX");
    int file = mkstemp(path);
    assert_true(file >= 0);
    assert_int_equal(write(file, text, strlen(text)), (ssize_t)strlen(text));
    close(file);
    wt_status status = wt_case_read(path, c, err);
    unlink(path);
    return status;
}

#define HEAD "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<case version=\"1\">\n"

static const char full[] = HEAD
    "<title> Tread, severe track </title>\n"
    "<indentation>\n"
    "  <tip>pyramid:half-angle=35deg,radius=20nm</tip>\n"
    "  <poisson-ratio>0.49</poisson-ratio> <temperature>23degC</temperature>\n"
    "  <fit-depth>70nm</fit-depth> <fit-tilt>no</fit-tilt>\n"
    "  <bulk spring-constant=\"1N/m +- 5%\" format=\"jpk\">\n"
    "    <files spot=\"b1\">bulk/1*.jpk-force-map</files>\n"
    "    <files spot=\"b2\" sensitivity=\"60nm/V\">bulk/2.jpk-force-map</files>\n"
    "  </bulk>\n"
    "  <track><files spot=\"t1\" units=\"Force=nN; Height=um\">track/*</files></track>\n"
    "</indentation>\n"
    "<dma>\n"
    "  <poisson-ratio>0.5</poisson-ratio><reference-temperature>20degC</reference-temperature>\n"
    "  <vertical-shift>none</vertical-shift><terms-per-decade>4</terms-per-decade>\n"
    "  <files>dma/*.txt</files>\n"
    "</dma>\n"
    "<roughness><self-affine><q0>1e3rad/m</q0><qr>5e3rad/m</qr><q1>1e7rad/m</q1>\n"
    "  <hurst>0.8</hurst><c0>1e-17m^4 +- 10%</c0></self-affine></roughness>\n"
    "<sliding><pressure>0.4MPa +- 0.02MPa</pressure><velocity>1e-4:10m/s:log:6</velocity>\n"
    "  <temperature>30degC +- 1K</temperature><shear-stress>5MPa +- 10%</shear-stress></sliding>\n"
    "<layer><specific-wear-rate>1e-3mm^3/(N m) +- 20%</specific-wear-rate>\n"
    "  <critical-energy>1e10J/m^3</critical-energy><velocity>0.3m/s</velocity>\n"
    "  <times>1:1e5s:log:6</times><incubation>yes</incubation></layer>\n"
    "<compare><track-to-bulk/><by-rate/></compare>\n"
    "<report style=\"screen\" figures=\"pdf,png\" width=\"85mm\" "
    "font=\"Arial\"><result>friction</result><result>layer</result></report>\n"
    "</case>\n";

static void test_full(void **state)
{
    (void)state;
    wt_case *c = NULL;
    wt_error err = WT_ERROR_INIT;
    if (read_text(full, &c, &err) != WT_OK)
        fail_msg("%s: %s; %s", err.place, err.message, err.found);
    assert_string_equal(wt_case_title(c), "Tread, severe track");
    assert_string_equal(wt_case_report_options(c)->style, "screen");
    assert_int_equal(wt_case_report_options(c)->figures, WT_FIGURE_PDF | WT_FIGURE_PNG);
    assert_near(wt_case_report_options(c)->width, 0.085, 1e-14);
    assert_string_equal(wt_case_report_options(c)->font, "Arial");
    assert_near(c->indent.tip.half_angle, 35 * M_PI / 180, 1e-14);
    assert_near(c->indent.options.poisson_ratio, 0.49, 0);
    assert_near(c->indent.options.fit_depth, 70e-9, 1e-14);
    assert_false(c->indent.options.fit_tilt);
    assert_near(c->compare.temperature.value, 296.15, 1e-14);
    assert_int_equal(c->bulk.n, 2);
    assert_string_equal(c->bulk.sets[0].spot, "b1");
    assert_string_equal(c->bulk.sets[0].read.format, "jpk");
    assert_string_equal(c->bulk.sets[1].patterns[0], "bulk/2.jpk-force-map");
    assert_near(c->bulk.sets[1].read.spring_constant, 1, 0);
    assert_near(c->bulk.sets[1].read.sensitivity, 60e-9, 1e-14);
    assert_near(c->bulk.sets[0].read.sensitivity, (double)NAN, 0);
    assert_near(c->bulk.spring_constant.standard_error, 0.05, 1e-14);
    assert_int_equal(c->track.sets[0].read.n_units, 2);
    assert_string_equal(c->track.sets[0].read.units[1], "Height=um");
    assert_int_equal(c->dma.n, 1);
    assert_int_equal(c->master.fit.vertical, WT_VERTICAL_NONE);
    assert_near(c->master.fit.terms_per_decade, 4, 0);
    assert_near(c->master.fit.reference_temperature, 293.15, 1e-14);
    assert_near(c->surface.c0.standard_error, 1e-18, 1e-13);
    assert_near(c->sliding.pressure.standard_error, 2e4, 1e-13);
    assert_int_equal(c->sliding.n_velocity, 6);
    assert_near(c->sliding.velocity[5], 10, 0);
    assert_near(c->sliding.temperature.standard_error, 1, 0);
    assert_near(c->layer.specific_wear_rate.value, 1e-12, 1e-14);
    assert_near(c->layer.velocity, 0.3, 0);
    assert_int_equal(c->layer.n_time, 6);
    assert_true(c->layer.incubation);
    assert_true(c->compare_groups && c->compare_rates && !c->compare_dma);
    assert_int_equal(c->requested, FLOW_BIT(FLOW_FRICTION) | FLOW_BIT(FLOW_LAYER));
    wt_case_free(c);
}

#define SLIDING(inner) HEAD "<sliding>" inner "</sliding></case>"
#define LAYER(inner) HEAD "<layer>" inner "</layer></case>"

#define INDENTATION(inner)                                                                         \
    HEAD "<indentation><tip>sphere:radius=5um</tip>" inner                                         \
         "<bulk><files>bulk/*</files></bulk></indentation></case>"

/* Each faulty text with the status, a part of the location and a part of the error. */
static void test_wrong(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        wt_status status;
        const char *place, *part;
    } cases[] = {
        {"", WT_E_SCHEMA, "", "no case file"},
        {"<case version=\"1\">", WT_E_SCHEMA, "line 1", "well-formed"},
        {"<!DOCTYPE case [<!ENTITY a \"b\">]>\n<case version=\"1\"><title>&a;</title></case>",
         WT_E_SCHEMA, "", "document type"},
        {HEAD "<friction/>\n</case>", WT_E_SCHEMA, "line 3", "<friction>"},
        {"<case version=\"2\"/>", WT_E_SCHEMA, "line 1", "\"2\""},
        {HEAD "<indentation><tip>sphere:radius=5um</tip><fit-tilt>maybe</fit-tilt></indentation>"
              "</case>",
         WT_E_SCHEMA, "line 3", "maybe"},
        {HEAD "<indentation>\n<tip>ball</tip></indentation></case>", WT_E_ARG, "line 4, <tip>", ""},
        {SLIDING("<pressure>0.4</pressure><velocity>1m/s</velocity>"), WT_E_UNIT,
         "line 3, <pressure>", "0.4"},
        {SLIDING("<pressure>0.4MPa</pressure>\n<velocity>1</velocity>"), WT_E_UNIT,
         "line 4, <velocity>", ""},
        {SLIDING("<pressure>-1MPa</pressure><velocity>1m/s</velocity>"), WT_E_RANGE,
         "line 3, <pressure>", "above 0"},
        {SLIDING("<pressure>1MPa</pressure><velocity>1m/s +- 1%</velocity>"), WT_E_UNIT, "line 3",
         ""},
        {SLIDING("<pressure>1MPa</pressure><velocity>1m/s</velocity><contact-size>1mm +- "
                 "0.1mm</contact-size>"),
         WT_E_ARG, "line 3, <contact-size>", "would not be used"},
        {LAYER("<specific-wear-rate>1e-3mm^3/(N m)</specific-wear-rate>"), WT_E_MISSING,
         "line 3, <layer>", "neither"},
        {LAYER("<specific-wear-rate>1e-3</specific-wear-rate>"
               "<critical-energy>1e10J/m^3</critical-energy>"),
         WT_E_UNIT, "line 3, <specific-wear-rate>", ""},
        {LAYER("<specific-wear-rate>0mm^3/(N m)</specific-wear-rate>"
               "<observed-thickness>1um</observed-thickness>"),
         WT_E_RANGE, "line 3, <specific-wear-rate>", "calibrated"},
        {HEAD "<indentation><tip>sphere:radius=5um</tip><bulk><files>a</files></bulk>\n"
              "<track><files>a</files></track></indentation></case>",
         WT_E_ARG, "line 4, <track>", "same files"},
        {HEAD "<dma><prony deformation=\"tension\"><equilibrium>1MPa</equilibrium>\n"
              "<term time=\"1\" modulus=\"1MPa\"/></prony></dma></case>",
         WT_E_UNIT, "line 4, attribute time", ""},
        {HEAD "<dma><prony deformation=\"tension\"><equilibrium>1MPa</equilibrium>"
              "<term time=\"1s\" modulus=\"1MPa\"/></prony><wlf><c1>8</c1><c2>100K</c2></wlf></dma>"
              "</case>",
         WT_E_MISSING, "line 3, <wlf>", "reference-temperature"},
        {HEAD "<roughness><self-affine><q0>1e5rad/m</q0><q1>1e3rad/m</q1><hurst>0.8</hurst>"
              "<c0>1e-17m^4</c0></self-affine></roughness></case>",
         WT_E_RANGE, "line 3, <self-affine>", ""},
        {HEAD "<report><result>happiness</result></report></case>", WT_E_NOT_FOUND,
         "line 3, <result>", "happiness"},
        {HEAD "<report>\n<figure>happiness</figure></report></case>", WT_E_NOT_FOUND,
         "line 4, <figure>", "happiness"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_case *c = NULL;
        wt_error err = WT_ERROR_INIT;
        char whole[2048];
        wt_status status = read_text(cases[i].text, &c, &err);
        wt_error_format(&err, whole, sizeof whole);
        if (status != cases[i].status || strstr(err.place, cases[i].place) == NULL ||
            strstr(whole, cases[i].part) == NULL)
            fail_msg("case %zu: %s: %s", i, status_name(status), whole);
        assert_null(c);
        assert_string_equal(err.file, path);
    }
}

/* The embedded schema equals the installed file. */
/* Element names of earlier versions pass the schema. */
static void test_former_elements(void **state)
{
    (void)state;
    static const char *const cases[] = {
        LAYER("<duty>0.5</duty>"),
        INDENTATION("<choices>choices.csv</choices>"),
        INDENTATION("<doubtful-error>0.2</doubtful-error>"),
        INDENTATION("<largest-error>0.5</largest-error>"),
        INDENTATION("<least-chance>0.01</least-chance>"),
        INDENTATION("<spot-scatter>10%</spot-scatter>"),
        HEAD "<dma><leave-out>a.txt</leave-out><files>dma/*.txt</files></dma></case>",
        HEAD
        "<identify><observed-thickness>1um</observed-thickness><duty>0.5</duty></identify></case>",
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        wt_case *c = NULL;
        wt_error err = WT_ERROR_INIT;
        if (read_text(cases[i], &c, &err) == WT_E_SCHEMA)
            fail_msg("%s: %s", cases[i], err.message);
        wt_case_free(c);
    }
}

/* The whole list of tables is read. */
static void test_long_request(void **state)
{
    (void)state;
    char tables[1024] = "";
    wt_case *c = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(read_text(full, &c, &err), WT_OK);
    for (int i = 0; i < 50; i++)
        strcat(tables, "friction layer ");
    assert_int_equal(wt_case_request_tables(c, tables, NULL), WT_OK);
    strcat(tables, "no_table");
    assert_int_equal(wt_case_request_tables(c, tables, &err), WT_E_NOT_FOUND);
    assert_non_null(strstr(err.message, "no_table"));
    wt_case_free(c);
}

static void test_schema(void **state)
{
    (void)state;
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    size_t length = 0;
    assert_int_equal(wt_input_open(WT_SOURCE_DIR "/formats/weartrack-case.xsd", &input, NULL),
                     WT_OK);
    assert_int_equal(wt_input_bytes(input, &bytes, &length, NULL), WT_OK);
    assert_int_equal(length, strlen(wt_case_schema()));
    assert_memory_equal(bytes, wt_case_schema(), length);
    wt_input_close(input);
}

/* Reads a whole file; free the result. */
static char *slurp(const char *name)
{
    wt_input *input = NULL;
    const unsigned char *bytes = NULL;
    size_t length = 0;
    assert_int_equal(wt_input_open(name, &input, NULL), WT_OK);
    assert_int_equal(wt_input_bytes(input, &bytes, &length, NULL), WT_OK);
    char *copy = strndup((const char *)bytes, length);
    assert_non_null(copy);
    wt_input_close(input);
    return copy;
}

/* The man page without the backslashes before hyphens. */
static char *man_page(void)
{
    char *page = slurp(WT_SOURCE_DIR "/man/weartrack-case.5"), *to = page;
    for (const char *from = page; *from != '\0'; from++)
        if (!(from[0] == '\\' && from[1] == '-'))
            *to++ = *from;
    *to = '\0';
    return page;
}

/* Every element and attribute of the schema is described. */
static void test_man_page_is_complete(void **state)
{
    (void)state;
    char *page = man_page();
    for (const char *at = wt_case_schema(); (at = strstr(at, " name=\"")) != NULL; at++) {
        bool element = at - wt_case_schema() > 10 && strncmp(at - 10, "xs:element", 10) == 0;
        bool attribute = at - wt_case_schema() > 12 && strncmp(at - 12, "xs:attribute", 12) == 0;
        char name[64], wanted[72];
        assert_int_equal(sscanf(at, " name=\"%63[^\"]\"", name), 1);
        snprintf(wanted, sizeof wanted, element ? "<%s" : "%s", name);
        if ((element || attribute) && strstr(page, wanted) == NULL)
            fail_msg("weartrack-case(5) does not describe %s", wanted);
    }
    free(page);
}

/* The example of the page is a valid case. */
static void test_man_page_example(void **state)
{
    (void)state;
    char *page = man_page(), *begin = strstr(page, ".nf\n"), *end = strstr(page, ".fi\n");
    wt_case *c = NULL;
    wt_error err = WT_ERROR_INIT;
    assert_true(begin != NULL && end > begin);
    *end = '\0';
    if (read_text(begin + 4, &c, &err) != WT_OK)
        fail_msg("%s: %s; %s", err.place, err.message, err.found);
    wt_case_free(c);
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_full),
        cmocka_unit_test(test_wrong),
        cmocka_unit_test(test_former_elements),
        cmocka_unit_test(test_long_request),
        cmocka_unit_test(test_schema),
        cmocka_unit_test(test_man_page_is_complete),
        cmocka_unit_test(test_man_page_example),
    };
    return cmocka_run_group_tests_name("flow case", tests, NULL, NULL);
}
