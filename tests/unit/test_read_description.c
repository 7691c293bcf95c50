/* Format descriptions: valid ones, and each error is named with its line.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "read/formats.h"
#include "read/text/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A test may replace each line with a faulty one. */
static const char *const good[] = {
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>",
    "<format id=\"mine\" version=\"2\" kinds=\"sweep\" verified=\"false\">",
    "<title>a title</title><evidence>made up</evidence>",
    "<detect><names score=\"10\"/></detect>",
    "<text separator=\"tab\"/>",
    "<header><field name='T' regex='^T=(.*)$' quantity='temperature' unit='degC'/></header>",
    "<table units=\"row\">",
    "<column quantity=\"frequency\"><name>f</name></column>",
    "<column quantity=\"storage_modulus\" unit=\"MPa\"><name>E'</name></column>",
    "<column quantity=\"loss_modulus\" unit=\"MPa\"><name>E\"</name></column>",
    "</table>",
    "</format>",
};
#define LINES (sizeof good / sizeof *good)

static description_xsd *schema;

static wt_status parse_with(size_t line, const char *text, wt_error *err)
{
    char xml[4096];
    size_t used = 0;
    text_description *d = NULL;
    for (size_t i = 0; i < LINES; i++)
        used +=
            (size_t)snprintf(xml + used, sizeof xml - used, "%s\n", i + 1 == line ? text : good[i]);
    wt_status status = description_parse(schema, xml, used, "mine.xml", &d, err);
    description_free(d);
    return status;
}

static void accepted(void **state)
{
    wt_error err = WT_ERROR_INIT;
    (void)state;
    assert_int_equal(parse_with(0, NULL, &err), WT_OK);
    /* the largest permitted number of repeats */
    static const char detect[] =
        "<detect><require regex=\"a+b+c+d+e+f+g+h+i+j+k+l+m+n+o+p+q\" score=\"5\"/></detect>";
    assert_int_equal(parse_with(4, detect, &err), WT_OK);
}

static void mistakes(void **state)
{
    static const struct {
        size_t line;
        const char *text;
        const char *place, *said; /* texts in the location; in message, expectation or value */
    } cases[] = {
        {8, "<column quantity=\"frequencies\"><name>f</name></column>", "line 8", "frequencies"},
        {8, "<column><name>f</name></column>", "line 8", "quantity"},
        {8, "<column quantity=\"frequency\"/>", "line 8", "name"},
        {8, "<column quantity=\"frequency\" unit=\"MPa\"><name>f</name></column>",
         "line 8, element column", "does not fit"},
        {8, "<column quantity=\"frequency\" colour=\"red\"><name>f</name></column>", "line 8",
         "colour"},
        {8, "", "element table", "columns of frequency"},
        {7, "<table names=\"^x\" names-are=\"f E\" names-lines=\"^n(.*)\">", "line 7", "either"},
        {7, "<table names-are=\"f E\">", "line 7", "units=\"none\""},
        {7, "<table names-lines=\"^n(.*)\">", "line 7", "names"},
        {4, "<detect><require regex=\"a(b\" score=\"5\"/></detect>", "line 4, element require",
         "a(b"},
        {4, "<detect><require regex=\"a{1,99}\" score=\"5\"/></detect>", "line 4", "repeat count"},
        {4, "<detect><require regex=\"(a)\\1\" score=\"5\"/></detect>", "line 4", "back reference"},
        {4, "<detect><require regex=\"a++\" score=\"5\"/></detect>", "line 4",
         "repeat of a repeat"},
        {4, "<detect><require regex=\"a+b+c+d+e+f+g+h+i+j+k+l+m+n+o+p+q+\" score=\"5\"/></detect>",
         "line 4", "more than 16"},
        {4, "<detect><require text=\"a\" regex=\"a\" score=\"5\"/></detect>", "line 4", "both"},
        {4, "<detect><require score=\"5\"/></detect>", "line 4", "neither"},
        {4, "<detect><hint text=\"a\" score=\"5\"/></detect>", "line 4", "at least one"},
        {4, "<detect><require text=\"a\"/></detect>", "line 4", "score"},
        {4, "<detect/>", "line 4", "detect"},
        {5, "<text separator=\"comma\" decimal=\"comma\"/>", "line 5, element text", "comma"},
        {5, "<text separator=\"fixed\"/>", "line 5", "widths"},
        {5, "<text separator=\"pipe\"/>", "line 5", "pipe"},
        {6,
         "<header><field name=\"T\" regex=\"^T=\" quantity=\"temperature\" unit=\"K\"/></header>",
         "line 6", "group"},
        {6, "<header><field name=\"T\" regex=\"(a)\" quantity=\"temperature\"/></header>",
         "line 6, element field", "neither"},
        {6, "<header><field name=\"T\" regex=\"(a)\" quantity=\"strain\" unit=\"1\"/></header>",
         "line 6", "strain"},
        {7, "<table units=\"line\">", "line 7, element table", "units-line"},
        {7, "<table><unit found=\"C\" means=\"apples\"/>", "element unit", "apples"},
        {11, "</table><isotherms temperature-jump=\"5\"/>", "line 11, element isotherms", "5 K"},
        {11, "</table><segments turning-point=\"true\"/>", "element segments", "force"},
        {2, "<format id=\"Mine\" version=\"2\" kinds=\"sweep\" verified=\"false\">", "line 2",
         "Mine"},
        {2, "<format id=\"mine\" version=\"2\" kinds=\"sweep picture\" verified=\"false\">",
         "line 2", "picture"},
        {2, "<format id=\"mine\" version=\"2\" kinds=\"image\" verified=\"false\">",
         "element table", "lateral position"},
        {7, "<table rows=\"matrix\" units=\"none\">", "element table", "lines of an image"},
        {12, "", "line 13", "end"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_error err = WT_ERROR_INIT;
        char text[2048];
        assert_int_equal(parse_with(cases[i].line, cases[i].text, &err), WT_E_SCHEMA);
        wt_error_format(&err, text, sizeof text);
        if (strstr(err.place, cases[i].place) == NULL || strstr(text, cases[i].said) == NULL)
            print_message("%s\n", text);
        assert_non_null(strstr(err.place, cases[i].place));
        assert_non_null(strstr(text, cases[i].said));
        assert_string_equal(err.file, "mine.xml");
    }
}

static void entities_are_refused(void **state)
{
    static const char xml[] = "<!DOCTYPE format [<!ENTITY a SYSTEM \"file:///etc/passwd\">]>\n"
                              "<format id=\"x\" version=\"1\" kinds=\"sweep\" verified=\"false\">"
                              "<title>&a;</title></format>";
    wt_error err = WT_ERROR_INIT;
    text_description *d = NULL;
    (void)state;
    assert_int_equal(description_parse(schema, xml, sizeof xml - 1, "x", &d, &err), WT_E_SCHEMA);
    assert_non_null(strstr(err.message, "entities"));
}

/* The schema lists every quantity of the library except "none", and no other. */
static void quantities_of_the_schema(void **state)
{
    const char *text = wt_formats_schema();
    size_t listed = 0;
    (void)state;
    for (int q = 1; q < (int)WT_Q_COUNT; q++) {
        char line[128];
        snprintf(line, sizeof line, "<xs:enumeration value=\"%s\"/>",
                 wt_quantity_id((wt_quantity)q));
        if (strstr(text, line) == NULL)
            print_message("%s is not in the schema\n", line);
        assert_non_null(strstr(text, line));
    }
    const char *c = strstr(text, "<xs:simpleType name=\"quantity\">");
    assert_non_null(c);
    while ((c = strstr(c, "<xs:enumeration value=\"")) != NULL) {
        listed++;
        c++;
    }
    assert_int_equal(listed, WT_Q_COUNT - 1);
}

static void names(void **state)
{
    static const char *const same[][2] = {
        {"E\"", "e''"},
        {"E''", "e''"},
        {"E\xe2\x80\xb3", "e''"},
        {"G\xe2\x80\xb2", "g'"},
        {" Storage  Modulus ", "storagemodulus"},
        {"tan(\xce\xb4)", "tan(delta)"},
        {"Tan(delta)", "tan(delta)"},
        {"\xcf\x89", "omega"},
        {"\xc2\xb5m", "um"},
        {"\xce\xbcm", "um"},
    };
    char name[COLUMN_NAME_SIZE];
    (void)state;
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        name_normalise((text_span){same[i][0], strlen(same[i][0])}, name);
        assert_string_equal(name, same[i][1]);
    }
    char lengthy[500];
    memset(lengthy, 'x', sizeof lengthy);
    name_normalise((text_span){lengthy, sizeof lengthy}, name);
    assert_int_equal(strlen(name), COLUMN_NAME_SIZE - 1);
}

static void units_in_names(void **state)
{
    static const struct {
        const char *name, *bare, *unit;
    } cases[] = {
        {"f (Hz)", "f ", "Hz"},
        {"E'(MPa)", "E'", "MPa"},
        {"k [N/(m s)]", "k ", "N/(m s)"},
        {"k (N/(m s))", "k ", "N/(m s)"},
        {"T / \xc2\xb0"
         "C",
         "T",
         "\xc2\xb0"
         "C"},
        {"plain", NULL, NULL},
        {"(Hz)", NULL, NULL},
        {"a)", NULL, NULL},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        text_span name = {cases[i].name, strlen(cases[i].name)}, unit = {NULL, 0};
        const bool has = split_name_unit(&name, &unit);
        assert_int_equal(has, cases[i].bare != NULL);
        if (!has)
            continue;
        assert_int_equal(name.length, strlen(cases[i].bare));
        assert_memory_equal(name.text, cases[i].bare, name.length);
        assert_int_equal(unit.length, strlen(cases[i].unit));
        assert_memory_equal(unit.text, cases[i].unit, unit.length);
    }
}

/* ---- a folder of descriptions, and the check of one --------------------------------------- */

static char folder[64];

static void write_file(const char *name, const char *text, char path[128])
{
    snprintf(path, 128, "%s/%s", folder, name);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

static void replaced_by_a_folder(void **state)
{
    char path[128];
    wt_formats *plain = NULL, *formats = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    (void)state;
    assert_int_equal(wt_formats_new(NULL, &plain, NULL, &err), WT_OK);
    const char *xml = wt_formats_xml(plain, "tidy");
    assert_non_null(xml);
    assert_null(wt_formats_xml(plain, "jpk"));
    char *changed = strdup(xml);
    char *version = strstr(changed, " version=\"1\" kinds");
    assert_non_null(version);
    version[10] = '7';
    write_file("tidy.xml", changed, path);
    assert_int_equal(wt_formats_new(folder, &formats, log, &err), WT_OK);
    assert_int_equal(wt_formats_count(formats), wt_formats_count(plain));
    bool found = false;
    for (size_t i = 0; i < wt_formats_count(formats); i++) {
        const wt_format_info *info = wt_formats_get(formats, i);
        if (strcmp(info->id, "tidy") == 0) {
            assert_string_equal(info->version, "7");
            found = true;
        }
    }
    assert_true(found);
    assert_int_equal(wt_log_count(log), 1);
    assert_non_null(strstr(wt_log_get(log, 0).text, "tidy"));
    wt_formats_free(formats);
    /* The id of a binary reader is reserved. */
    formats = NULL;
    char *id = strstr(changed, "id=\"tidy\"");
    memcpy(id, "id=\"jpk\" ", 9);
    write_file("tidy.xml", changed, path);
    assert_int_equal(wt_formats_new(folder, &formats, log, &err), WT_E_SCHEMA);
    assert_null(formats);
    unlink(path);
    assert_int_equal(wt_formats_new(folder, &formats, log, &err), WT_E_NOT_FOUND);
    free(changed);
    wt_log_free(log);
    wt_formats_free(plain);
}

/* The descriptions of the library follow the schema, and their stated properties are those in the
 * files. */
static void known_before_they_are_read(void **state)
{
    wt_formats *formats = NULL;
    wt_error err = WT_ERROR_INIT;
    size_t n_read = 0;
    (void)state;
    assert_int_equal(wt_formats_new(NULL, &formats, NULL, &err), WT_OK);
    for (size_t i = 0; i < wt_formats_count(formats); i++) {
        const file_reader *const reader = formats_reader(formats, i);
        const char *const xml = wt_formats_xml(formats, reader->info.id);
        text_description *whole = NULL;
        const text_description *detect = NULL, *again = NULL;
        if (xml == NULL)
            continue;
        n_read++;
        assert_int_equal(description_parse(schema, xml, strlen(xml), "x", &whole, &err), WT_OK);
        assert_string_equal(reader->info.id, whole->id);
        assert_string_equal(reader->info.title, whole->title);
        assert_string_equal(reader->info.evidence, whole->evidence);
        assert_string_equal(reader->info.version, whole->version);
        assert_int_equal(reader->info.kinds, whole->kinds);
        assert_int_equal(reader->info.verified, whole->verified);
        assert_int_equal(description_load(reader->description, DESCRIPTION_DETECT, &detect, &err),
                         WT_OK);
        assert_int_equal(detect->n_probes, whole->n_probes);
        assert_int_equal(detect->encoding, whole->encoding);
        assert_int_equal(detect->n_names, 0);
        assert_int_equal(description_load(reader->description, DESCRIPTION_WHOLE, &again, &err),
                         WT_OK);
        assert_int_equal(again->n_names, whole->n_names);
        assert_int_equal(description_load(reader->description, DESCRIPTION_WHOLE, &detect, &err),
                         WT_OK);
        assert_ptr_equal(detect, again); /* read once */
        description_free(whole);
    }
    assert_true(n_read > 20);
    wt_formats_free(formats);
}

/* An invalid description of the library is named, for the detection part and for the rest. */
static void damaged_in_the_library(void **state)
{
    static const struct {
        const char *xml, *place;
    } damaged[] = {
        {"<format id=\"mine\" version=\"2\" kinds=\"sweep\" verified=\"false\">\n"
         "  <title>a</title><evidence>b</evidence>\n"
         "  <detect><require regex=\"a(b\" score=\"9\"/></detect>\n"
         "  <table><column quantity=\"frequency\"><name>f</name></column></table></format>",
         "line 3, element require"},
        {"<format id=\"mine\" version=\"2\" kinds=\"sweep\" verified=\"false\">\n"
         "  <title>a</title><evidence>b</evidence>\n"
         "  <detect><names score=\"9\"/></detect>\n"
         "  <table><column quantity=\"frequency\"><name>f</name></column></table></format>",
         "element table"}};
    (void)state;
    for (size_t i = 0; i < sizeof damaged / sizeof *damaged; i++) {
        const embedded_text file = {"mine.xml", damaged[i].xml, strlen(damaged[i].xml)};
        wt_formats *formats = NULL;
        wt_input *input = NULL;
        const wt_format_info *info = NULL;
        wt_error err = WT_ERROR_INIT;
        assert_int_equal(
            formats_from_description(description_from_library(&file), "mine.xml", &formats, &err),
            WT_OK);
        assert_int_equal(wt_input_open_memory("f\n1\n", 4, "data.txt", &input, NULL), WT_OK);
        assert_int_equal(wt_format_detect(formats, input, NULL, 0, &info, &err), WT_E_SCHEMA);
        assert_string_equal(err.file, "mine.xml of the library");
        assert_string_equal(err.place, damaged[i].place);
        assert_non_null(strstr(err.advice, "--formats"));
        wt_input_close(input);
        wt_formats_free(formats);
    }
}

static void checked_with_a_sample(void **state)
{
    char path[128], xml[4096] = "";
    static const char sample[] =
        "T=20\nf\tE'\tE\"\tcolour\nHz\tMPa\t\t\n1\t2\t3\tred\n10\t4\t5\tred\n";
    wt_input *input = NULL;
    wt_table *report = NULL;
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    (void)state;
    for (size_t i = 0; i < LINES; i++) {
        strcat(xml, good[i]);
        strcat(xml, "\n");
    }
    write_file("mine.xml", xml, path);
    assert_int_equal(wt_input_open_memory(sample, sizeof sample - 1, "sample", &input, &err),
                     WT_OK);
    assert_int_equal(wt_format_description_check(path, input, NULL, log, &report, &err), WT_OK);
    assert_int_equal(wt_table_n_rows(report), 3);
    assert_string_equal(wt_table_text(report, 0, 0), "f");
    assert_string_equal(wt_table_text(report, 0, 1), "frequency");
    assert_string_equal(wt_table_text(report, 1, 2), "MPa");
    assert_near(wt_table_number(report, 1, 4), 2e6, 1e-15);
    assert_near(wt_table_number(report, 2, 4), 3e6, 1e-15);
    wt_table_free(report);
    wt_input_close(input);
    /* Without a sample only the description is checked. */
    report = NULL;
    assert_int_equal(wt_format_description_check(path, NULL, NULL, log, &report, &err), WT_OK);
    assert_int_equal(wt_table_n_rows(report), 0);
    wt_table_free(report);
    /* A sample that does not match. */
    report = NULL;
    assert_int_equal(wt_input_open_memory("a\tb\n1\t2\n", 8, "other", &input, &err), WT_OK);
    assert_int_equal(wt_format_description_check(path, input, NULL, log, &report, &err),
                     WT_E_EMPTY);
    assert_null(report);
    wt_input_close(input);
    unlink(path);
    wt_log_free(log);
}

/* The example in weartrack-format(5): its first block is the sample, those with tags are the
 * description. */
static void example_of_the_manual(void **state)
{
    static char sample[4096], xml[8192], line[512];
    char path[128];
    size_t block = 0, samples = 0, used = 0;
    bool inside = false;
    wt_error err = WT_ERROR_INIT;
    wt_input *input = NULL;
    wt_table *report = NULL;
    wt_log *log = wt_log_new();
    (void)state;
    FILE *page = fopen(WT_SOURCE_DIR "/man/weartrack-format.5", "r");
    assert_non_null(page);
    while (block < 8 && fgets(line, sizeof line, page) != NULL) {
        char *to = line;
        if (line[0] == '.') {
            inside = strncmp(line, ".nf", 3) == 0 || (inside && strncmp(line, ".fi", 3) != 0);
            block += strncmp(line, ".nf", 3) == 0;
            continue;
        }
        for (const char *from = line; *from != '\0'; from++) {
            *to++ = *from;
            from += from[0] == '\\' && from[1] == 'e'; /* \e prints a backslash */
        }
        *to = '\0';
        if (inside && block == 1)
            samples += (size_t)snprintf(sample + samples, sizeof sample - samples, "%s", line);
        else if (inside && block < 8)
            used += (size_t)snprintf(xml + used, sizeof xml - used, "%s", line);
    }
    fclose(page);
    write_file("nanoprobe.xml", xml, path);
    assert_int_equal(wt_input_open_memory(sample, samples, "sample", &input, &err), WT_OK);
    wt_status status = wt_format_description_check(path, input, NULL, log, &report, &err);
    if (status != WT_OK)
        print_message("%s: %s; %s; %s\n", err.place, err.message, err.expected, err.found);
    assert_int_equal(status, WT_OK);
    assert_int_equal(wt_log_count(log), 0);
    assert_int_equal(wt_table_n_rows(report), 3);
    assert_string_equal(wt_table_text(report, 1, 1), "deflection");
    assert_near(wt_table_number(report, 0, 4), 12.5e-6, 1e-15);
    assert_near(wt_table_number(report, 1, 4), 0.31e-9, 1e-15);
    wt_table_free(report);
    wt_input_close(input);
    unlink(path);
    wt_log_free(log);
}

static int setup(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "description.XXXXXX");
    return mkdtemp(folder) != NULL && description_xsd_new(&schema, NULL) == WT_OK ? 0 : -1;
}

static int teardown(void **state)
{
    (void)state;
    description_xsd_free(schema);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepted),
        cmocka_unit_test(mistakes),
        cmocka_unit_test(entities_are_refused),
        cmocka_unit_test(quantities_of_the_schema),
        cmocka_unit_test(names),
        cmocka_unit_test(units_in_names),
        cmocka_unit_test(replaced_by_a_folder),
        cmocka_unit_test(known_before_they_are_read),
        cmocka_unit_test(damaged_in_the_library),
        cmocka_unit_test(checked_with_a_sample),
        cmocka_unit_test(example_of_the_manual),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
