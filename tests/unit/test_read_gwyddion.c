/* Height maps by the program Gwyddion. A replacement program hangs, crashes, writes too much,
 * nothing, invalid data or the expected file.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report_folder.h"

#include "reader_fixture.h"

#include "read/bytes/input.h"
#include "read/gwyddion/gwyddion.h"
#include "writers/surf_writer.h"

#include <math.h>
#include <time.h>

/* ---- replacement of the program -------------------------------------------------------------- */

/* Files that the program finds in its folder. */
#define OWN_DATA "share/gwyddion"

static char *path_before;

static int make_place(void **state)
{
    char all[4096];
    if (create_work_folder(state) != 0 || mkdir("bin", 0777) != 0 || mkdir("none", 0777) != 0 ||
        mkdir("tmp", 0777) != 0 || mkdir("share", 0777) != 0 || mkdir(OWN_DATA, 0777) != 0)
        return -1;
    path_before = strdup(getenv("PATH"));
    snprintf(all, sizeof all, "%s/tmp", (char *)*state);
    assert_int_equal(setenv("TMPDIR", all, 1), 0);
    snprintf(all, sizeof all, "%s/bin:%s", (char *)*state, path_before);
    return setenv("PATH", all, 1);
}

static int remove_place(void **state)
{
    assert_int_equal(setenv("PATH", path_before, 1), 0);
    assert_int_equal(unsetenv("TMPDIR"), 0);
    free(path_before);
    return remove_work_folder(state);
}

/* Only the version is requested. */
static void stand_in(const char *script)
{
    FILE *out = fopen("bin/gwyddion", "w");
    assert_non_null(out);
    (void)fprintf(
        out,
        "#!/bin/sh\n[ \"$1\" = --version ] && { echo 'Gwyddion 9.9 (made up)'; exit 0; }\n"
        "%s\n",
        script);
    assert_int_equal(fclose(out), 0);
    assert_int_equal(chmod("bin/gwyddion", 0755), 0);
}

static const char surf[512] = "DIGITAL SURF";

/* ---- failures -------------------------------------------------------------------------------- */

static void fails_with(const char *script, wt_status expected, const char *words)
{
    /* Short, so that the test is short; the program that hangs would not end. */
    const gwyddion_limits limits = {
        .time = 2, .cpu_time = 2, .file_size = (size_t)1 << 20, .memory = (size_t)1 << 30};
    enum { FAR_BELOW_FOR_EVER = 60 };
    wt_input *input = NULL, *converted = NULL;
    wt_error err = WT_ERROR_INIT;
    char version[64];
    const double start = wt_time_wall();
    stand_in(script);
    assert_int_equal(wt_input_open_memory(surf, sizeof surf, "a.sur", &input, NULL), WT_OK);
    const wt_status status = gwyddion_convert(input, &limits, &converted, version, &err);
    if (status != expected || strstr(err.message, words) == NULL)
        fail_msg("%s: %d: %s", script, (int)status, err.message);
    assert_null(converted);
    assert_true(strlen(err.advice) > 0);
    assert_int_equal(count_files("tmp"), 0);
    assert_true(wt_time_wall() - start < FAR_BELOW_FOR_EVER);
    wt_input_close(input);
}

/* Its child processes end with it. */
static void test_left_behind(void **state)
{
    (void)state;
    mark_programs();
    fails_with("sleep 1000 & [ -d /proc/$! ] && exit 6", WT_E_TOOL, "exit status 6");
    assert_true(all_programs_end());
}

/* The test waits for a silent program without load. */
static void test_closed_output(void **state)
{
    (void)state;
    const clock_t before = clock();
    fails_with("exec >&- 2>&-; sleep 1; exit 5", WT_E_TOOL, "exit status 5");
    assert_true((double)(clock() - before) / CLOCKS_PER_SEC < 0.3);
}

static void test_failures(void **state)
{
    (void)state;
    const size_t open_before = count_files("/proc/self/fd");
    fails_with("sleep 1000 & sleep 1000", WT_E_TOOL, "did not end within 2 s");
    fails_with("while :; do :; done", WT_E_TOOL, "Gwyddion ");
    fails_with("trap '' XCPU TERM; while :; do :; done", WT_E_TOOL, "Gwyddion ");
    fails_with("kill -SEGV $$", WT_E_TOOL, "ended by signal 11");
    fails_with("echo no; exit 1", WT_E_TOOL, "exit status 1");
    fails_with("exit 0", WT_E_TOOL, "made nothing");
    fails_with(": > converted.gwy", WT_E_TOOL, "made nothing");
    fails_with("mkdir converted.gwy", WT_E_TOOL, "made nothing");
    fails_with("ln -s /etc/passwd converted.gwy", WT_E_TOOL, "made nothing");
    fails_with("mkfifo converted.gwy; exit 0", WT_E_TOOL, "made nothing");
    fails_with("exec head -c 10000000000 /dev/zero > converted.gwy", WT_E_TOOL, "signal 25");
    fails_with("mkdir -p a/b/c/d/e; echo x > a/b/c/d/e/f; exit 3", WT_E_TOOL, "exit status 3");
    assert_int_equal(count_files("/proc/self/fd"), open_before);
}

/* A file at the size limit is truncated, whatever the exit status. */
static void test_flood_that_goes_on(void **state)
{
    (void)state;
    fails_with("trap '' XFSZ; head -c 10000000000 /dev/zero > converted.gwy; exit 0", WT_E_TOOL,
               "more of the file than is read");
}

/* The suffix of the copy follows from the first bytes, not from the file name. */
static void test_ending_of_the_copy(void **state)
{
    (void)state;
    static const struct {
        const char *head, *copy;
    } files[] = {{"aISO-1.0", "surface.sdf"}, {"VCA DATA", "surface.opdx"}, {"height", "surface"}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        wt_input *input = NULL, *converted = NULL;
        wt_error err = WT_ERROR_INIT;
        char version[64], script[64];
        (void)snprintf(script, sizeof script, "[ \"$2\" = %s ] && exit 6", files[i].copy);
        stand_in(script);
        assert_int_equal(
            wt_input_open_memory(files[i].head, strlen(files[i].head), "a.sur", &input, NULL),
            WT_OK);
        assert_int_equal(
            gwyddion_convert(input, &gwyddion_default_limits, &converted, version, &err),
            WT_E_TOOL);
        assert_non_null(strstr(err.message, "exit status 6"));
        wt_input_close(input);
    }
}

static void test_rubbish(void **state)
{
    (void)state;
    wt_image *images = NULL;
    size_t n = 0;
    wt_error err = WT_ERROR_INIT;
    stand_in("echo GWYPrubbish > converted.gwy");
    assert_int_equal(read_images_of(surf, sizeof surf, "b.sur", NULL, &images, &n, &err),
                     WT_E_CORRUPT);
    assert_non_null(strstr(err.message, "what Gwyddion made of the file"));
    assert_string_equal(err.file, "b.sur");
    assert_non_null(strstr(err.found, "Digital Surf"));
    assert_null(images);
    assert_int_equal(count_files("tmp"), 0);
}

static void test_not_installed(void **state)
{
    wt_image *images = NULL;
    size_t n = 0;
    wt_error err = WT_ERROR_INIT;
    char none[512];
    snprintf(none, sizeof none, "%s/none", (char *)*state);
    assert_int_equal(setenv("PATH", none, 1), 0);
    assert_int_equal(read_images_of(surf, sizeof surf, "b.sur", NULL, &images, &n, &err),
                     WT_E_TOOL);
    assert_non_null(strstr(err.message, "which is missing"));
    assert_non_null(strstr(err.advice, "apt-get install gwyddion"));
    assert_non_null(strstr(err.found, "Digital Surf"));
    assert_int_equal(count_files("tmp"), 0);
}

/* ---- success --------------------------------------------------------------------------------- */

enum { COLUMNS = 3, ROWS = 2, POINTS = COLUMNS * ROWS };
static const double heights[POINTS] = {3e-9, 1e-9, 4e-9, 1e-9, 5e-9, 9e-9}; /* uppermost first */

/* "GwyDataField" with these values, as bytes in native order, which is that of the file. */
static size_t field_of(char *to, const double *values)
{
    char *p = to + 17; /* after the name and the size */
    const uint32_t columns = COLUMNS, rows = ROWS, n = POINTS;
    const double x = 3e-6, y = 2e-6;
#define PUT(bytes, n) p = (char *)memcpy(p, bytes, n) + (n)
    PUT("xres\0i", 6);
    PUT(&columns, 4);
    PUT("yres\0i", 6);
    PUT(&rows, 4);
    PUT("xreal\0d", 7);
    PUT(&x, 8);
    PUT("yreal\0d", 7);
    PUT(&y, 8);
    for (int i = 0; i < 2; i++) {
        PUT(i == 0 ? "si_unit_xy\0o" : "si_unit_z\0o", i == 0 ? 12 : 11);
        const uint32_t inside = 11;
        PUT("GwySIUnit\0", 10);
        PUT(&inside, 4);
        PUT("unitstr\0sm\0", 11);
    }
    PUT("data\0D", 6);
    PUT(&n, 4);
    PUT(values, POINTS * sizeof *values);
    const uint32_t size = (uint32_t)(p - to - 17);
    memcpy(to, "GwyDataField", 13);
    memcpy(to + 13, &size, 4);
    return (size_t)(p - to);
}

static void write_good(const double *mask)
{
    char bytes[2048], *p = bytes + 4 + 13 + 4;
    PUT("/0/data\0o", 9);
    p += field_of(p, heights);
    if (mask != NULL) {
        PUT("/0/mask\0o", 9);
        p += field_of(p, mask);
    }
#undef PUT
    const uint32_t size = (uint32_t)(p - bytes - 21);
    memcpy(bytes, "GWYPGwyContainer", 17);
    memcpy(bytes + 17, &size, 4);
    FILE *out = fopen(OWN_DATA "/good.gwy", "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, (size_t)(p - bytes), out), p - bytes);
    assert_int_equal(fclose(out), 0);
}

/* Reads and compares; `missing` has a bit for each point that must be missing. */
static void check_read(const char *bytes, unsigned missing, const char *words)
{
    wt_image *images = NULL;
    size_t n = 0;
    bool said = false, version = false;
    wt_error err = WT_ERROR_INIT;
    wt_log *log = wt_log_new();
    stand_in("[ \"$HOME\" = \"$(pwd -P)\" ] || exit 7\n[ -z \"$DISPLAY\" ] || exit 8\n"
             "read x && exit 9\n[ \"$2\" = surface.sur ] && [ -s \"$2\" ] || exit 10\n"
             "cp ../../" OWN_DATA
             "/good.gwy converted.gwy; mkdir -p .gwyddion/a/b; echo > .gwyddion/a/b/c");
    if (read_images_of(bytes, sizeof surf, "b.sur", log, &images, &n, &err) != WT_OK)
        fail_msg("%s", err.message);
    assert_int_equal(n, 1);
    assert_int_equal(images[0].n_columns, COLUMNS);
    assert_int_equal(images[0].n_rows, ROWS);
    for (size_t i = 0; i < POINTS; i++) {
        const double z = images[0].values[(ROWS - 1 - i / COLUMNS) * COLUMNS + i % COLUMNS];
        if ((missing >> i & 1u) != 0)
            assert_true(isnan(z));
        else
            assert_near(z, heights[i], 1e-15);
    }
    for (size_t i = 0; i < wt_log_count(log); i++) {
        const char *message = wt_log_get(log, i).text;
        version = version || strstr(message, "converted by Gwyddion 9.9 (made up)") != NULL;
        said = said || strstr(message, words) != NULL;
    }
    assert_true(version && said);
    assert_int_equal(count_files("tmp"), 0);
    wt_log_free(log);
    wt_image_clear(&images[0]);
    free(images);
}

static void test_heights(void **state)
{
    (void)state;
    static const double mask[POINTS] = {0, 0, 1, 0, 0, 1};
    char flagged[sizeof surf];
    assert_int_equal(setenv("DISPLAY", ":99", 1), 0);
    memcpy(flagged, surf, sizeof surf);
    flagged[86] = 1;
    write_good(NULL);
    check_read(surf, 0, "");
    /* Digital Surf: the file states missing points, which are the lowest ones. */
    check_read(flagged, 1u << 1 | 1u << 3, "the 2 of 6 at the lowest height");
    /* Points masked by Gwyddion are missing, and no others. */
    write_good(mask);
    check_read(surf, 1u << 2 | 1u << 5, "2 of 6 pixels");
    check_read(flagged, 1u << 2 | 1u << 5, "2 of 6 pixels");
}

/* ---- compressed files of Digital Surf ---------------------------------------------------------
 */

enum { SURF_HEIGHTS = 10, SURF_PIECES = 3, SURF_ROOM = 1024, SURF_HEAD = 512 + 5 };
static const int surf_heights[SURF_HEIGHTS] = {-3, 7, 1, 0, 100000, -1, 5, 5, 5, 5};

/* The unpacked file equals the uncompressed one, and the program receives it. */
static void test_unpacked(void **state)
{
    (void)state;
    unsigned char packed[SURF_ROOM], plain[SURF_ROOM];
    const size_t n_plain = surf_write_plain(plain, surf_heights, SURF_HEIGHTS);
    for (size_t pieces = 1; pieces <= SURF_PIECES; pieces++) {
        const size_t n = surf_write(packed, surf_heights, SURF_HEIGHTS, pieces);
        for (size_t more = 0; more < 2; more++) { /* additional bytes, which are reported */
            wt_input *input = NULL, *unpacked = NULL;
            const unsigned char *bytes = NULL;
            size_t length = 0;
            wt_log *log = wt_log_new();
            packed[n] = 0;
            assert_int_equal(wt_input_open_memory(packed, n + more, "a.sur", &input, NULL), WT_OK);
            assert_int_equal(surf_unpack(input, SURF_ROOM, log, &unpacked, NULL), WT_OK);
            assert_int_equal(wt_input_bytes(unpacked, &bytes, &length, NULL), WT_OK);
            assert_int_equal(length, n_plain);
            assert_memory_equal(bytes, plain, n_plain);
            assert_int_equal(wt_log_count(log), more);
            wt_input_close(unpacked);
            wt_input_close(input);
            wt_log_free(log);
        }
    }
    const size_t n = surf_write(packed, surf_heights, SURF_HEIGHTS, 1);
    FILE *out = fopen(OWN_DATA "/plain.sur", "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(plain, 1, n_plain, out), n_plain);
    assert_int_equal(fclose(out), 0);
    write_good(NULL);
    stand_in("cmp surface.sur ../../" OWN_DATA "/plain.sur && cp ../../" OWN_DATA
             "/good.gwy converted.gwy");
    wt_image *images = NULL;
    size_t n_images = 0;
    assert_int_equal(read_images_of(packed, n, "b.sur", NULL, &images, &n_images, NULL), WT_OK);
    assert_int_equal(n_images, 1);
    wt_image_clear(&images[0]);
    free(images);
}

static void test_damaged(void **state)
{
    (void)state;
    enum { COUNTED = SURF_HEAD, FIRST = SURF_HEAD + 4, STREAM = FIRST + 8 * SURF_PIECES };
    static const struct {
        /* position of a byte, SURF_ROOM: none; size after truncation, 0: whole */
        size_t at, length;
        unsigned char byte;
        const char *words;
    } cases[] = {{SURF_ROOM, 100, 0, "its head is cut"},
                 {SURF_ROOM, SURF_HEAD + 3, 0, "ends before its heights"},
                 {335, 0, 0x7f, "ends before its heights"},
                 {335, 0, 0x80, "ends before its heights"},
                 {COUNTED, 0, 0, "more pieces"},
                 {COUNTED + 3, 0, 0xff, "more pieces"},
                 {FIRST + 6, 0, 1, "lies outside"},
                 {FIRST + 3, 0, 0xff, "lies outside"},
                 {FIRST, 0, 13, "not of one size"},
                 {116, 0, 11, "not of one size"},
                 {98, 0, 16, "not of one size"},
                 {STREAM, 0, 0, "cannot be unpacked"},
                 {STREAM + 9, 0, 99, "cannot be unpacked"}};
    unsigned char packed[SURF_ROOM];
    const size_t n = surf_write(packed, surf_heights, SURF_HEIGHTS, SURF_PIECES);
    wt_input *input = NULL, *unpacked = NULL;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_error err = WT_ERROR_INIT;
        unsigned char changed[SURF_ROOM];
        memcpy(changed, packed, n);
        if (cases[i].at < n)
            changed[cases[i].at] = cases[i].byte;
        const size_t length = cases[i].length > 0 ? cases[i].length : n;
        assert_int_equal(wt_input_open_memory(changed, length, "a.sur", &input, NULL), WT_OK);
        const wt_status status = surf_unpack(input, SURF_ROOM, NULL, &unpacked, &err);
        if (status != WT_E_CORRUPT || strstr(err.message, cases[i].words) == NULL)
            fail_msg("case %zu: %d: %s", i, (int)status, err.message);
        assert_null(unpacked);
        assert_non_null(strstr(err.advice, "without compression"));
        wt_input_close(input);
    }
    for (size_t length = 0; length < n; length++) {
        assert_int_equal(wt_input_open_memory(packed, length, "a.sur", &input, NULL), WT_OK);
        assert_int_equal(surf_unpack(input, SURF_ROOM, NULL, &unpacked, NULL), WT_E_CORRUPT);
        wt_input_close(input);
    }
    assert_int_equal(wt_input_open_memory(packed, n, "a.sur", &input, NULL), WT_OK);
    assert_int_equal(surf_unpack(input, 4 * SURF_HEIGHTS - 1, NULL, &unpacked, NULL),
                     WT_E_UNSUPPORTED);
    assert_int_equal(surf_unpack(input, 4 * SURF_HEIGHTS, NULL, &unpacked, NULL), WT_OK);
    wt_input_close(unpacked);
    wt_input_close(input);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_place, remove_place)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_failures),           TEST(test_flood_that_goes_on),
        TEST(test_left_behind),        TEST(test_closed_output),
        TEST(test_ending_of_the_copy), TEST(test_rubbish),
        TEST(test_not_installed),      TEST(test_heights),
        TEST(test_unpacked),           TEST(test_damaged),
    };
    return cmocka_run_group_tests(tests, set_up, clean);
}
