/* Contents of packed files: gzip archives and spreadsheets, sound, corrupted and malicious.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "reader_fixture.h"
#include "writers/book_writer.h"

#include <zip.h>
#include <zlib.h>

#define TABLE "f\tT\tE'\tE''\nHz\tdegC\tMPa\tMPa\n"
#define SWEEP TABLE "0.1\t20\t10\t1\n1\t20\t11\t1.25\n10\t20\t12.1\t1.5\n"
#define WARM TABLE "0.1\t60\t8\t0.5\n1\t60\t8.5\t0.625\n10\t60\t9\t0.75\n"

/* Reads the file; sets the error on failure. */
static wt_status read_sweep(const char *sheet, wt_sweep *sweep, wt_log *log, wt_error *err)
{
    wt_input *input = NULL;
    wt_read_options options = wt_read_defaults();
    const wt_format_info *info = NULL;
    *err = (wt_error)WT_ERROR_INIT;
    *sweep = (wt_sweep){.n_isotherms = 0};
    options.sheet = sheet;
    wt_status status = wt_input_open(path, &input, err);
    assert_int_equal(status, WT_OK);
    status = wt_format_detect(formats, input, &options, WT_KIND_SWEEP, &info, err);
    if (status == WT_OK) {
        options.format = info->id;
        status = wt_sweep_read(formats, input, &options, log, sweep, err);
    }
    if (status != WT_OK)
        assert_non_null(strstr(err->file, "weartrack-made"));
    wt_input_close(input);
    return status;
}

static void reads(const char *sheet, size_t isotherms, double storage)
{
    wt_sweep sweep;
    wt_error err;
    if (read_sweep(sheet, &sweep, NULL, &err) != WT_OK)
        fail_msg("%s (%s, %s)", err.message, err.found, err.advice);
    assert_int_equal(sweep.n_isotherms, isotherms);
    assert_int_equal(sweep.isotherms[0].n, 3);
    assert_near(sweep.isotherms[0].storage_modulus[0], storage, 1e-12);
    assert_near(sweep.isotherms[0].angular_frequency[2], 20 * M_PI, 1e-12);
    wt_sweep_clear(&sweep);
}

static void cannot_read(const char *sheet, wt_status expected, const char *words)
{
    wt_sweep sweep;
    wt_error err;
    const wt_status status = read_sweep(sheet, &sweep, NULL, &err);
    char all[2000];
    snprintf(all, sizeof all, "%s; %s; %s; %s", err.message, err.place, err.found, err.advice);
    if (status != expected || strstr(all, words) == NULL)
        fail_msg("%d, \"%s\" instead of %d, \"%s\"", (int)status, all, (int)expected, words);
}

/* The check of a description reads a packed sample as a reader does. */
static void checks(const char *sheet, double storage)
{
    char xml[] = "/tmp/weartrack-packed-XXXXXX.xml";
    const int fd = mkstemps(xml, 4);
    wt_read_options options = wt_read_defaults();
    const wt_format_info *info = NULL;
    wt_input *input = NULL;
    wt_table *report = NULL;
    wt_error err = WT_ERROR_INIT;
    options.sheet = sheet;
    assert_int_equal(wt_input_open(path, &input, NULL), WT_OK);
    assert_int_equal(wt_format_detect(formats, input, &options, WT_KIND_SWEEP, &info, NULL), WT_OK);
    FILE *out = fdopen(fd, "w");
    assert_non_null(out);
    assert_true(fputs(wt_formats_xml(formats, info->id), out) >= 0 && fclose(out) == 0);
    wt_input_close(input);
    assert_int_equal(wt_input_open(path, &input, NULL), WT_OK);
    if (wt_format_description_check(xml, input, &options, NULL, &report, &err) != WT_OK)
        fail_msg("%s (%s, %s)", err.message, err.found, err.advice);
    bool found = false;
    for (size_t i = 0; i < wt_table_n_rows(report); i++)
        if (strcmp(wt_table_text(report, i, 1), "storage_modulus") == 0) {
            assert_near(wt_table_number(report, i, 4), storage, 1e-12);
            found = true;
        }
    assert_true(found);
    wt_table_free(report);
    wt_input_close(input);
    assert_int_equal(unlink(xml), 0);
}

/* ---- gzip ------------------------------------------------------------------------------------ */

static size_t pack(const char *text, size_t length, unsigned char *to, size_t size)
{
    z_stream z = {.next_in = (z_const Bytef *)(uintptr_t)text,
                  .avail_in = (uInt)length,
                  .next_out = to,
                  .avail_out = (uInt)size};
    assert_int_equal(deflateInit2(&z, 9, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY), Z_OK);
    assert_int_equal(deflate(&z, Z_FINISH), Z_STREAM_END);
    assert_int_equal(deflateEnd(&z), Z_OK);
    return size - z.avail_out;
}

static void write_bytes(const unsigned char *bytes, size_t n)
{
    FILE *out = fopen(path, "wb");
    assert_true(out != NULL && fwrite(bytes, 1, n, out) == n && fclose(out) == 0);
}

static void test_gzip(void **state)
{
    (void)state;
    unsigned char bytes[4000];
    size_t n = pack(SWEEP, strlen(SWEEP), bytes, sizeof bytes);
    write_bytes(bytes, n);
    reads(NULL, 1, 10e6);
    checks(NULL, 10e6);
    /* A member that is only half complete, and one with a wrong checksum. */
    write_bytes(bytes, n / 2);
    cannot_read(NULL, WT_E_CORRUPT, "the end of the archive is missing");
    bytes[n - 6] ^= 1;
    write_bytes(bytes, n);
    cannot_read(NULL, WT_E_CORRUPT, "damaged");
    /* Members follow one another; zeros at the end are not a member. */
    n = pack(TABLE, strlen(TABLE), bytes, sizeof bytes);
    n += pack(&SWEEP[strlen(TABLE)], strlen(SWEEP) - strlen(TABLE), bytes + n, sizeof bytes - n);
    memset(bytes + n, 0, 100);
    write_bytes(bytes, n + 100);
    reads(NULL, 1, 10e6);
    memset(bytes + n, 'x', 100);
    write_bytes(bytes, n + 100);
    cannot_read(NULL, WT_E_CORRUPT, "something else stands behind");
    /* The message describes the content, not the packing. */
    n = pack("nothing known", 13, bytes, sizeof bytes);
    write_bytes(bytes, n);
    cannot_read(NULL, WT_E_FORMAT, "text of no known layout");
}

/* ---- spreadsheets ---------------------------------------------------------------------------- */

typedef int write_book(const char *file, const book_writer_sheet *sheets, size_t n);

static int write_shared(const char *file, const book_writer_sheet *sheets, size_t n)
{
    return xlsx_write(file, sheets, n, true);
}

static int write_inline(const char *file, const book_writer_sheet *sheets, size_t n)
{
    return xlsx_write(file, sheets, n, false);
}

static int write_plain(const char *file, const book_writer_sheet *sheets, size_t n)
{
    return xls_write(file, XLS_PLAIN, sheets, n);
}

static int write_parted(const char *file, const book_writer_sheet *sheets, size_t n)
{
    return xls_write(file, XLS_SHARED, sheets, n);
}

static int write_old(const char *file, const book_writer_sheet *sheets, size_t n)
{
    return xls_write(file, XLS_OLD, sheets, n);
}

static write_book *const kinds[] = {write_shared, write_inline, write_plain, write_parted,
                                    write_old};

static void test_sheets(void **state)
{
    (void)state;
    const book_writer_sheet sheets[] = {{"About", "Operator\tM. Muster\n\n\t\t2026\n", false},
                                        {"Cold", SWEEP, false},
                                        {"Warm & wet", WARM, false}};
    const book_writer_sheet plain[] = {sheets[0], sheets[1], {"Warm", WARM, false}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        assert_int_equal(kinds[k](path, sheets, 2), 0);
        reads(NULL, 1, 10e6);
        reads("cold", 1, 10e6);
        checks("cold", 10e6);
        cannot_read("hot", WT_E_NOT_FOUND, "\"About\", \"Cold\"");
        cannot_read("About", WT_E_FORMAT, "not recognised");
        assert_int_equal(kinds[k](path, plain, 3), 0);
        cannot_read(NULL, WT_E_AMBIGUOUS, "\"Cold\", \"Warm\"");
        reads("Warm", 1, 8e6);
        reads("all", 2, 10e6);
        assert_int_equal(kinds[k](path, plain, 1), 0);
        cannot_read(NULL, WT_E_FORMAT, "not recognised");
        const book_writer_sheet two[] = {sheets[0], sheets[0]};
        assert_int_equal(kinds[k](path, two, 2), 0);
        cannot_read(NULL, WT_E_FORMAT, "\"About\", \"About\"");
        /* A hidden sheet is read only if it is named. */
        const book_writer_sheet hidden[] = {{"Cold", SWEEP, false}, {"Warm", WARM, true}};
        assert_int_equal(kinds[k](path, hidden, 2), 0);
        reads(NULL, 1, 10e6);
        reads("Warm", 1, 8e6);
    }
    /* More sheets than any file has. */
    static book_writer_sheet many[1025];
    for (size_t i = 0; i < sizeof many / sizeof *many; i++)
        many[i] = sheets[0];
    assert_int_equal(xlsx_write(path, many, sizeof many / sizeof *many, true), 0);
    cannot_read(NULL, WT_E_UNSUPPORTED, "more than 1024 sheets");
}

/* The row number is that in the sheet. */
static void test_row_and_sheet_numbers(void **state)
{
    (void)state;
    const book_writer_sheet sheet = {"One", "\n\n" TABLE "0.1\t20\t10\t1\n1\t20\tten\t1\n", false};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        assert_int_equal(kinds[k](path, &sheet, 1), 0);
        wt_sweep sweep;
        wt_error err;
        wt_log *log = wt_log_new();
        const wt_status status = read_sweep(NULL, &sweep, log, &err);
        bool found = strstr(err.place, "line 6") != NULL;
        for (size_t i = 0; i < wt_log_count(log); i++) {
            const wt_log_entry entry = wt_log_get(log, i);
            found = found || (entry.place != NULL && strstr(entry.place, "line 6") != NULL &&
                              strstr(entry.file, ", sheet One") != NULL);
        }
        if (!found)
            fail_msg("kind %zu, %d: %s, %s", k, (int)status, err.message, err.place);
        wt_log_free(log);
        wt_sweep_clear(&sweep);
    }
}

/* ---- malicious files ------------------------------------------------------------------------- */

#define SHEET(cells) "<worksheet><sheetData>" cells "</sheetData></worksheet>"
#define ROW(n, cells) "<row r=\"" n "\">" cells "</row>"

/* A book with one sheet of this XML and these strings. */
static void write_parts(const char *sheet, const char *strings)
{
    static const char book[] = "<workbook><sheets><sheet name=\"A\" sheetId=\"1\" "
                               "xmlns:r=\"r\" r:id=\"r1\"/></sheets></workbook>";
    static const char relations[] = "<Relationships><Relationship Id=\"r1\" "
                                    "Target=\"/xl/s.xml\"/></Relationships>";
    const char *const names[] = {"xl/workbook.xml", "xl/_rels/workbook.xml.rels", "xl/s.xml",
                                 "xl/sharedStrings.xml"};
    const char *const texts[] = {book, relations, sheet, strings};
    zip_t *zip = zip_open(path, ZIP_CREATE | ZIP_TRUNCATE, NULL);
    assert_non_null(zip);
    for (size_t i = 0; i < 4; i++) {
        if (texts[i] == NULL)
            continue;
        zip_source_t *source = zip_source_buffer(zip, texts[i], strlen(texts[i]), 0);
        assert_true(source != NULL && zip_file_add(zip, names[i], source, 0) >= 0);
    }
    assert_int_equal(zip_close(zip), 0);
}

static void test_malicious(void **state)
{
    (void)state;
    static const struct {
        const char *sheet, *strings, *words;
    } cases[] = {
        {SHEET(ROW("2", "") ROW("1", "")), NULL, "not numbered"},
        {SHEET(ROW("0", "")), NULL, "not numbered"},
        {SHEET(ROW("1048577", "")), NULL, "not numbered"},
        {SHEET(ROW("1x", "")), NULL, "not numbered"},
        {SHEET(ROW("1", "<c r=\"B1\"/><c r=\"A1\"/>")), NULL, "do not stand"},
        {SHEET(ROW("1", "<c r=\"XFE1\"/>")), NULL, "do not stand"},
        {SHEET(ROW("1", "<c r=\"ZZZZZZZZZZZZZZZZZZ1\"/>")), NULL, "do not stand"},
        {SHEET(ROW("1", "<c r=\"12\"/>")), NULL, "do not stand"},
        {SHEET("<c r=\"A1\"/>"), NULL, "do not stand"},
        {SHEET(ROW("1", "<c t=\"s\"><v>0</v></c>")), NULL, "not there"},
        {SHEET(ROW("1", "<c t=\"s\"><v>-1</v></c>")), "<sst><si><t>x</t></si></sst>", "not there"},
        {SHEET(ROW("1", "<c t=\"s\"><v>99999999999999999999</v></c>")),
         "<sst><si><t>x</t></si></sst>", "names no text"},
        {"<worksheet><sheetData>", NULL, "not well-formed"},
        {"<!DOCTYPE x [<!ENTITY a \"b\">]>" SHEET(ROW("1", "<c><v>&a;</v></c>")), NULL, "entities"},
        {SHEET(""), "<!DOCTYPE x [<!ENTITY a SYSTEM \"/etc/passwd\">]><sst>&a;</sst>", "entities"},
        {NULL, NULL, "is missing"},
        {"<chartsheet/>", NULL, "no sheet"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_parts(cases[i].sheet, cases[i].strings);
        wt_sweep sweep;
        wt_error err;
        const wt_status status = read_sweep(NULL, &sweep, NULL, &err);
        if ((status != WT_E_CORRUPT && status != WT_E_EMPTY) ||
            strstr(err.message, cases[i].words) == NULL)
            fail_msg("case %zu: %d, %s", i, (int)status, err.message);
    }
    /* One long text in many cells: more text than in any sound file. */
    static char sheet[400000], strings[300000];
    size_t used = (size_t)snprintf(sheet, sizeof sheet, "<worksheet><sheetData>");
    for (unsigned i = 1; i < 4000; i++)
        used += (size_t)snprintf(sheet + used, sizeof sheet - used,
                                 "<row r=\"%u\"><c t=\"s\"><v>0</v></c></row>", i);
    snprintf(sheet + used, sizeof sheet - used, "</sheetData></worksheet>");
    memset(strings, 'x', sizeof strings - 1);
    memcpy(strings, "<sst><si><t>", 12);
    memcpy(strings + sizeof strings - 20, "</t></si></sst>", 16);
    write_parts(sheet, strings);
    cannot_read(NULL, WT_E_CORRUPT, "more text than a file of this size can hold");
}

static size_t file_bytes(unsigned char *bytes, size_t size)
{
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    const size_t n = fread(bytes, 1, size, in);
    (void)fclose(in);
    return n;
}

/* A truncated book, and an invalid archive. */
static void test_damaged(void **state)
{
    (void)state;
    const book_writer_sheet sheet = {"One", SWEEP, false};
    static unsigned char bytes[100000];
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        assert_int_equal(kinds[k](path, &sheet, 1), 0);
        const size_t n = file_bytes(bytes, sizeof bytes);
        for (size_t part = 1; part < 8; part++) {
            wt_sweep sweep;
            wt_error err;
            write_bytes(bytes, n * part / 8);
            const wt_status status = read_sweep(NULL, &sweep, NULL, &err);
            /* The last sectors of an .xls may be padding. */
            if (status != WT_E_CORRUPT && status != WT_E_FORMAT && !(k >= 2 && status == WT_OK))
                fail_msg("kind %zu, %zu of 8: %d, %s", k, part, (int)status, err.message);
            wt_sweep_clear(&sweep);
        }
    }
}

/* ---- old Excel files ------------------------------------------------------------------------- */

/* A stream of 4096 bytes or more has its own sectors; a shorter one uses small sectors. */
static void test_long_and_short(void **state)
{
    (void)state;
    static char text[12000];
    size_t n = (size_t)snprintf(text, sizeof text, TABLE);
    for (int i = 0; i < 90; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%.1f\t20\t%.2f\t%d.25\n", 0.1 + i,
                              10 + 0.01 * i, i + 1);
    const book_writer_sheet sheet = {"One", text, false};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        wt_sweep sweep;
        wt_error err;
        assert_int_equal(kinds[k](path, &sheet, 1), 0);
        assert_int_equal(read_sweep(NULL, &sweep, NULL, &err), WT_OK);
        assert_int_equal(sweep.n_isotherms, 1);
        assert_int_equal(sweep.isotherms[0].n, 90);
        for (int i = 0; i < 90; i++) {
            assert_near(sweep.isotherms[0].storage_modulus[i], (10 + 0.01 * i) * 1e6, 1e-14);
            assert_near(sweep.isotherms[0].loss_modulus[i], (i + 1.25) * 1e6, 1e-14);
        }
        wt_sweep_clear(&sweep);
    }
}

/* A number that needs 17 digits keeps its last bit. */
static void test_last_digit(void **state)
{
    (void)state;
    static const char text[] = TABLE "0.1\t20\t10.000000000000002\t1\n1\t20\t11\t1.25\n"
                                     "10\t20\t12.1\t1.5\n";
    const book_writer_sheet sheet = {"One", text, false};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        wt_sweep sweep;
        wt_error err;
        assert_int_equal(kinds[k](path, &sheet, 1), 0);
        assert_int_equal(read_sweep(NULL, &sweep, NULL, &err), WT_OK);
        assert_true(sweep.isotherms[0].storage_modulus[0] > 10e6);
        wt_sweep_clear(&sweep);
    }
}

/* A degree sign is one byte in the code page of BIFF5, and in a narrow text of BIFF8. */
static void test_code_page(void **state)
{
    (void)state;
    static const char text[] = "f\tT\tE'\tE''\nHz\t\xb0"
                               "C\tMPa\tMPa\n"
                               "0.1\t20\t10\t1\n1\t20\t11\t1.25\n10\t20\t12.1\t1.5\n";
    const book_writer_sheet sheet = {"One", text, false};
    for (xls_way way = XLS_PLAIN; way <= XLS_OLD; way++) {
        wt_sweep sweep;
        wt_error err;
        assert_int_equal(xls_write(path, way, &sheet, 1), 0);
        assert_int_equal(read_sweep(NULL, &sweep, NULL, &err), WT_OK);
        assert_near(sweep.isotherms[0].temperature, 293.15, 1e-14);
        wt_sweep_clear(&sweep);
    }
}

/* Position of such a record after `position`. */
static size_t find_record(const unsigned char *bytes, size_t n, size_t from, unsigned id)
{
    for (size_t at = from; at + 1 < n; at++)
        if (bytes[at] == (id & 0xff) && bytes[at + 1] == id >> 8)
            return at;
    fail_msg("no record %x", id);
    return 0;
}

/* Positions of a sound file that are changed one by one. */
static void test_malicious_xls(void **state)
{
    (void)state;
    enum { STREAM = 5 * 512, OF_HEADER = 0, OF_RECORD = 1 };
    static const struct {
        xls_way way;
        int of;
        size_t at; /* offset in the file, or from the start of the record */
        unsigned id, value;
        const char *words;
    } cases[] = {
        {XLS_PLAIN, OF_HEADER, 30, 0, 10, "damaged or its end"}, /* size of a sector */
        /* directory outside the file */
        {XLS_PLAIN, OF_HEADER, 49, 0, 1, "damaged or its end"},
        {XLS_PLAIN, OF_HEADER, 76, 0, 99, "damaged or its end"}, /* table outside the file */
        /* directory is its own successor */
        {XLS_PLAIN, OF_HEADER, 512 + 4, 0, 1, "damaged or its end"},
        {XLS_PLAIN, OF_HEADER, 1024 + 76, 0, 9, "without a spreadsheet"}, /* root without a child */
        {XLS_PLAIN, OF_HEADER, 1024 + 128, 0, 'V', "without a spreadsheet"},
        {XLS_PLAIN, OF_HEADER, 1024 + 128 + 121, 0, 200, "damaged or its end"}, /* length */
        {XLS_PLAIN, OF_HEADER, 2048 - 512 + 4, 0, 200, "damaged or its end"},   /* small sectors */
        {XLS_PLAIN, OF_RECORD, 5, 0x0809, 4, "before 1993"},
        {XLS_PLAIN, OF_RECORD, 0, 0x0809, 8, "no Excel file"},
        {XLS_PLAIN, OF_RECORD, 0, 0x0042, 0x2f, "password"},
        {XLS_PLAIN, OF_RECORD, 5, 0x0085, 250, "sheet of the spreadsheet is cut off"},
        {XLS_PLAIN, OF_RECORD, 10, 0x0085, 200, "text of the spreadsheet is cut off"},
        {XLS_PLAIN, OF_RECORD, 10, 0x0204, 200, "text of the spreadsheet is cut off"},
        {XLS_SHARED, OF_RECORD, 12, 0x00fc, 255, "cut off"},
        {XLS_SHARED, OF_RECORD, 8, 0x00fc, 1, "text that is not there"},
        {XLS_SHARED, OF_RECORD, 4 + 9, 0x00fd, 1, "text that is not there"},
    };
    const book_writer_sheet sheet = {"One", SWEEP, false};
    static unsigned char bytes[100000];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(xls_write(path, cases[i].way, &sheet, 1), 0);
        const size_t n = file_bytes(bytes, sizeof bytes);
        size_t at = cases[i].at;
        if (cases[i].of == OF_RECORD)
            at += find_record(bytes, n, STREAM - 512, cases[i].id);
        bytes[at] = (unsigned char)cases[i].value;
        write_bytes(bytes, n);
        wt_sweep sweep;
        wt_error err;
        const wt_status status = read_sweep(NULL, &sweep, NULL, &err);
        char all[2000];
        snprintf(all, sizeof all, "%s; %s", err.message, err.found);
        if (status == WT_OK || strstr(all, cases[i].words) == NULL)
            fail_msg("case %zu: %d, %s", i, (int)status, all);
        wt_sweep_clear(&sweep);
    }
    /* Many sheets at one position. */
    book_writer_sheet many[8];
    for (size_t i = 0; i < 8; i++)
        many[i] = (book_writer_sheet){"One", i == 0 ? SWEEP : "", false};
    assert_int_equal(xls_write(path, XLS_PLAIN, many, 8), 0);
    const size_t n = file_bytes(bytes, sizeof bytes);
    const size_t first = find_record(bytes, n, STREAM - 512, 0x0085);
    for (size_t i = 1, at = first; i < 8; i++) {
        at = find_record(bytes, n, at + 2, 0x0085);
        memcpy(bytes + at + 4, bytes + first + 4, 4);
    }
    write_bytes(bytes, n);
    cannot_read(NULL, WT_E_CORRUPT, "overlap");
}

/* The file of the instrument, and its values as saved by Excel in another export: skipped if they
 * do not exist. */
static void test_measured(void **state)
{
    (void)state;
    static const struct {
        const char *file;
        double storage;
    } cases[] = {
        {WT_SHARED_DIR "/data/dma/eplexor/freq_Eplexor_raw.xls", 8097.175545345271e6},
        {WT_SHARED_DIR "/data/dma/eplexor/freq_Eplexor_raw_biff5.xls", 4956.183187381401e6},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wt_input *input = NULL;
        if (access(cases[i].file, R_OK) != 0)
            continue;
        assert_int_equal(wt_input_open(cases[i].file, &input, NULL), WT_OK);
        wt_sweep sweep = {.n_isotherms = 0};
        assert_int_equal(wt_sweep_read(formats, input, NULL, NULL, &sweep, NULL), WT_OK);
        assert_int_equal(sweep.n_isotherms, 21);
        assert_near(sweep.isotherms[0].storage_modulus[0], cases[i].storage, 1e-14);
        assert_near(sweep.isotherms[0].angular_frequency[0], 0.2 * M_PI, 1e-14);
        wt_sweep_clear(&sweep);
        wt_input_close(input);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_gzip),
                                       cmocka_unit_test(test_sheets),
                                       cmocka_unit_test(test_row_and_sheet_numbers),
                                       cmocka_unit_test(test_malicious),
                                       cmocka_unit_test(test_damaged),
                                       cmocka_unit_test(test_long_and_short),
                                       cmocka_unit_test(test_code_page),
                                       cmocka_unit_test(test_last_digit),
                                       cmocka_unit_test(test_malicious_xls),
                                       cmocka_unit_test(test_measured)};
    return cmocka_run_group_tests(tests, set_up, clean);
}
