/* ZIP archives of force curve files: their order, other files among them, corrupted files, and
 * archives without curves.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"

#include <zip.h>

typedef struct packed_file {
    const char *name, *text;
    size_t length; /* 0: that of the text */
} packed_file;

static void write_archive(const packed_file *files, size_t n)
{
    zip_t *zip = zip_open(path, ZIP_CREATE | ZIP_TRUNCATE, NULL);
    assert_non_null(zip);
    for (size_t i = 0; i < n; i++) {
        const size_t length = files[i].length > 0 ? files[i].length : strlen(files[i].text);
        zip_source_t *source = zip_source_buffer(zip, files[i].text, length, 0);
        assert_true(source != NULL && zip_file_add(zip, files[i].name, source, 0) >= 0);
    }
    assert_int_equal(zip_close(zip), 0);
}

/* Approach and retraction of a curve with a largest force of `force` nN. */
#define CURVE(force) "height [nm]\tforce [nN]\n100\t0\n90\t0\n80\t" force "\n90\t0\n100\t0\n"
#define BROKEN "height [nm]\tforce [nN]\n100\t0\n90\tx\n80\t1\n"

static void is_curve(reading *r, size_t number, double force)
{
    next_curve(r);
    assert_int_equal(r->curve.index, number);
    assert_int_equal(r->curve.n_segments, 2);
    assert_near(channel(&r->curve.segments[0], WT_Q_FORCE)[2], force, 1e-15);
}

static void curves(void **state)
{
    (void)state;
    const packed_file files[] = {{"map/curve10.txt", CURVE("10"), 0},
                                 {"map/curve9.txt", CURVE("9"), 0},
                                 {"map/README", "no curve\n", 0},
                                 {"map/.hidden", CURVE("7"), 0},
                                 {"__MACOSX/map/curve9.txt", CURVE("8"), 0}};
    reading r;
    write_archive(files, 5);
    const wt_format_info *info = NULL;
    open_input(&r, path);
    assert_int_equal(wt_format_detect(formats, r.input, NULL, 0, &info, &r.err), WT_OK);
    assert_string_equal(info->id, "archive");
    /* With the result of detection, with text, and without. */
    static const char *const given[] = {"archive", "table-force", NULL};
    for (size_t i = 0; i < 3; i++) {
        wt_read_options o = wt_read_defaults();
        o.format = given[i];
        assert_int_equal(wt_force_open(formats, r.input, &o, r.log, &r.source, &r.err), WT_OK);
        assert_int_equal(wt_force_count(r.source), SIZE_MAX);
        is_curve(&r, 0, 9e-9);
        is_curve(&r, 1, 10e-9);
        assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
        wt_force_close(r.source);
        r.source = NULL;
    }
    size_t told = 0;
    for (size_t i = 0; i < wt_log_count(r.log); i++) {
        const wt_log_entry entry = wt_log_get(r.log, i);
        if (strstr(entry.text, "left out: ") == NULL)
            continue;
        assert_string_equal(entry.file, path);
        assert_string_equal(entry.place, "map/README");
        told++;
    }
    assert_true(told > 0);
    wt_table *facts = NULL;
    assert_int_equal(wt_input_describe(formats, r.input, NULL, NULL, &facts, &r.err), WT_OK);
    wt_table_free(facts);
    close_all(&r);
}

/* A file that cannot be read is one failed curve; the others follow. */
static void failures(void **state)
{
    (void)state;
    const packed_file files[] = {
        {"a.txt", CURVE("1"), 0}, {"b.txt", BROKEN, 0}, {"c.txt", CURVE("3"), 0}};
    static unsigned char bytes[4096];
    reading r;
    write_archive(files, 3);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    is_curve(&r, 0, 1e-9);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_E_CORRUPT);
    assert_non_null(strstr(r.err.file, "b.txt"));
    is_curve(&r, 2, 3e-9);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
    close_all(&r);
    const size_t n = read_bytes(bytes, sizeof bytes);
    for (size_t i = 0; i < n; i += 3) {
        bytes[i] ^= 0x55;
        (void)open_bytes(bytes, n);
        bytes[i] ^= 0x55;
        (void)open_bytes(bytes, i);
    }
}

static void none(void **state)
{
    (void)state;
    static unsigned char inner[4096];
    const packed_file words[] = {{"a.txt", "words\n", 0}, {"b.txt", "more words\n", 0}};
    const packed_file one[] = {{"a.txt", CURVE("1"), 0}};
    write_archive(words, 2);
    assert_refused(WT_E_UNSUPPORTED, "a ZIP archive without force curves");
    /* An archive within an archive is not opened. */
    write_archive(one, 1);
    const size_t n = read_bytes(inner, sizeof inner);
    const packed_file both[] = {{"a.txt", CURVE("1"), 0}, {"b.zip", (const char *)inner, n}};
    reading r;
    write_archive(both, 2);
    assert_int_equal(open_force(&r, path, NULL), WT_OK);
    is_curve(&r, 0, 1e-9);
    assert_int_equal(wt_force_next(r.source, &r.curve, &r.err), WT_END);
    assert_true(has_logged(&r, "an archive within an archive"));
    close_all(&r);
    write_archive(both + 1, 1);
    assert_refused(WT_E_UNSUPPORTED, "a ZIP archive without force curves");
    /* It contains no sweep. */
    wt_sweep sweep = {.n_isotherms = 0};
    write_archive(one, 1);
    open_input(&r, path);
    assert_int_equal(wt_sweep_read(formats, r.input, NULL, NULL, &sweep, &r.err), WT_E_UNSUPPORTED);
    close_all(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(curves), cmocka_unit_test(failures),
                                       cmocka_unit_test(none)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
