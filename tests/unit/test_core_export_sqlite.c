/* A table as an SQLite database, read by SQLite.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"
#include "weartrack/core.h"

#include <math.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Opens the database of the table from a file. */
static sqlite3 *database_of(const wt_table *table)
{
    char path[] = "/tmp/weartrack-sqlite-XXXXXX";
    wt_error err = WT_ERROR_INIT;
    sqlite3 *db = NULL;
    const int fd = mkstemp(path);
    FILE *const out = fd >= 0 ? fdopen(fd, "wb") : NULL;
    assert_non_null(out);
    assert_int_equal(wt_table_export(out, table, WT_EXPORT_SQLITE, false, &err), WT_OK);
    assert_int_equal(fclose(out), 0);
    assert_int_equal(sqlite3_open_v2(path, &db, SQLITE_OPEN_READONLY, NULL), SQLITE_OK);
    /* The file is unlinked after SQLite has opened it with the first query. */
    assert_int_equal(sqlite3_exec(db, "PRAGMA integrity_check", NULL, NULL, NULL), SQLITE_OK);
    assert_int_equal(unlink(path), 0);
    return db;
}

/* First row of the query; bars separate cells, NULL is a minus. */
static const char *ask(sqlite3 *db, const char *question)
{
    static char answer[1024];
    sqlite3_stmt *statement = NULL;
    answer[0] = '\0';
    if (sqlite3_prepare_v2(db, question, -1, &statement, NULL) != SQLITE_OK)
        fail_msg("%s: %s", question, sqlite3_errmsg(db));
    assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
    for (int i = 0; i < sqlite3_column_count(statement); i++) {
        const char *const text = (const char *)sqlite3_column_text(statement, i);
        const size_t used = strlen(answer);
        (void)snprintf(answer + used, sizeof answer - used, "%s%s", i > 0 ? "|" : "",
                       text != NULL ? text : "-");
    }
    assert_int_equal(sqlite3_finalize(statement), SQLITE_OK);
    return answer;
}

static wt_table *make_table(const char *name)
{
    wt_table *const t = wt_table_new(name, "some \"words\"");
    assert_non_null(t);
    assert_int_equal(wt_table_add_text_column(t, "file", "its \xC2\xB5 name", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "modulus_A", "Pa", "Young's modulus", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "modulus_a", "MPa", "another", NULL), WT_OK);
    assert_int_equal(wt_table_add_column(t, "modulus_a_2", "1", "", NULL), WT_OK);
    assert_int_equal(wt_table_set_key(t, "tip", "sphere; DROP TABLE x", NULL), WT_OK);
    assert_int_equal(
        wt_table_set_estimate(t, "pressure", (wt_estimate){4e5, (double)NAN, 0.1, "Pa"}, NULL),
        WT_OK);
    return t;
}

static void add_row(wt_table *t, const char *file, double a, double b, double c)
{
    assert_int_equal(wt_table_add_row(t, NULL), WT_OK);
    wt_table_set_text(t, 0, file);
    wt_table_set_number(t, 1, a);
    wt_table_set_number(t, 2, b);
    wt_table_set_number(t, 3, c);
}

static void cells(void **state)
{
    (void)state;
    wt_table *const t = make_table("indentation/bulk");
    add_row(t, "o'clock \"\xC2\xB5\"", 0.1, (double)NAN, -(double)INFINITY);
    add_row(t, "", 1.0 / 3.0, 2.0, -0.0);
    sqlite3 *const db = database_of(t);
    assert_string_equal(ask(db, "SELECT count(*) FROM \"indentation/bulk\""), "2");
    assert_string_equal(ask(db, "SELECT file, modulus_A, modulus_a_2, modulus_a_2_2 FROM "
                                "\"indentation/bulk\""),
                        "o'clock \"\xC2\xB5\"|0.1|-|-Inf");
    assert_string_equal(ask(db, "SELECT file FROM \"indentation/bulk\" WHERE modulus_a_2 = 2"),
                        "-");
    /* No digit is lost. */
    sqlite3_stmt *statement = NULL;
    assert_int_equal(sqlite3_prepare_v2(db,
                                        "SELECT modulus_A FROM \"indentation/bulk\" WHERE file "
                                        "IS NULL",
                                        -1, &statement, NULL),
                     SQLITE_OK);
    assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
    assert_int_equal(sqlite3_column_type(statement, 0), SQLITE_FLOAT);
    assert_true(sqlite3_column_double(statement, 0) == 1.0 / 3.0);
    assert_int_equal(sqlite3_finalize(statement), SQLITE_OK);
    assert_int_equal(sqlite3_close(db), SQLITE_OK);
    wt_table_free(t);
}

static void columns_and_keys(void **state)
{
    (void)state;
    wt_table *const t = make_table("friction");
    sqlite3 *const db = database_of(t);
    assert_string_equal(ask(db, "SELECT count(*) FROM friction"), "0");
    assert_string_equal(ask(db, "SELECT group_concat(\"column\" || ':' || coalesce(unit, '')) FROM "
                                "weartrack_columns WHERE \"table\" = 'friction'"),
                        "file:,modulus_A:Pa,modulus_a_2:MPa,modulus_a_2_2:1");
    assert_string_equal(ask(db, "SELECT words FROM weartrack_columns"), "its \xC2\xB5 name");
    assert_string_equal(ask(db, "SELECT count(*) FROM weartrack_keys"), "2");
    assert_string_equal(ask(db, "SELECT * FROM weartrack_keys WHERE key = 'pressure'"),
                        "friction|pressure|400000.0|-|0.1|Pa|-");
    assert_string_equal(ask(db, "SELECT * FROM weartrack_keys WHERE key = 'tip'"),
                        "friction|tip|-|-|-|-|sphere; DROP TABLE x");
    assert_int_equal(sqlite3_close(db), SQLITE_OK);
    wt_table_free(t);
}

static void blocks(void **state)
{
    (void)state;
    wt_table *const t = make_table("sweep");
    for (int i = 0; i < 6; i++) {
        if (i % 3 == 0)
            wt_table_new_block(t);
        add_row(t, "a", i, i, i);
    }
    sqlite3 *const db = database_of(t);
    assert_string_equal(ask(db, "SELECT group_concat(block) FROM sweep"), "0,0,0,1,1,1");
    assert_int_equal(sqlite3_close(db), SQLITE_OK);
    wt_table_free(t);
}

/* Thousands of rows are complete, and the same table gives the same bytes. */
static void same_bytes(void **state)
{
    (void)state;
    char *bytes[2] = {NULL, NULL};
    size_t size[2] = {0, 0};
    wt_table *const t = make_table("summary");
    for (int i = 0; i < 20000; i++)
        add_row(t, "a file with a name", i, 0.5 * i, 1.0);
    for (int i = 0; i < 2; i++) {
        FILE *const out = open_memstream(&bytes[i], &size[i]);
        assert_int_equal(wt_table_export(out, t, WT_EXPORT_SQLITE, false, NULL), WT_OK);
        assert_int_equal(fclose(out), 0);
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    sqlite3 *const db = database_of(t);
    assert_string_equal(ask(db, "SELECT count(*), sum(modulus_A) FROM summary"),
                        "20000|199990000.0");
    assert_int_equal(sqlite3_close(db), SQLITE_OK);
    FILE *const full = fopen("/dev/full", "wb");
    wt_error err = WT_ERROR_INIT;
    assert_non_null(full);
    assert_int_equal(wt_table_export(full, t, WT_EXPORT_SQLITE, false, &err), WT_E_IO);
    (void)fclose(full);
    free(bytes[0]);
    free(bytes[1]);
    wt_table_free(t);
}

/* Bytes that are not UTF-8 are replaced as in JSON, because invalid text stops other programs. */
static void invalid_utf8(void **state)
{
    (void)state;
    wt_table *const t = make_table("friction");
    add_row(t,
            "Pr\xFC"
            "fling \xC3\xA4",
            1, 1, 1);
    assert_int_equal(wt_table_set_key(t, "file", "\xE4", NULL), WT_OK);
    sqlite3 *const db = database_of(t);
    assert_string_equal(ask(db, "SELECT file, hex(file) FROM friction"),
                        "Pr\xEF\xBF\xBD"
                        "fling \xC3\xA4|5072EFBFBD666C696E6720C3A4");
    assert_string_equal(ask(db, "SELECT hex(words) FROM weartrack_keys WHERE key = 'file'"),
                        "EFBFBD");
    assert_string_equal(ask(db, "PRAGMA application_id"), "2004120171"); /* "wtrk" */
    assert_int_equal(sqlite3_close(db), SQLITE_OK);
    wt_table_free(t);
}

/* A table that a database cannot contain is refused by name, and nothing is written. */
static void refused(void **state)
{
    (void)state;
    static const char *const names[] = {"weartrack_keys", "Weartrack_Columns", "sqlite_x"};
    wt_table *t = NULL;
    for (size_t i = 0; i <= sizeof names / sizeof *names; i++) {
        char *bytes = NULL;
        size_t size = 0;
        wt_error err = WT_ERROR_INIT;
        FILE *const out = open_memstream(&bytes, &size);
        const bool named = i < sizeof names / sizeof *names;
        t = named ? make_table(names[i]) : make_table("wide");
        for (int k = 0; !named && k < 2000; k++) {
            char name[16];
            (void)snprintf(name, sizeof name, "c%d", k);
            assert_int_equal(wt_table_add_column(t, name, "1", "", NULL), WT_OK);
        }
        assert_int_equal(wt_table_export(out, t, WT_EXPORT_SQLITE, false, &err), WT_E_UNSUPPORTED);
        assert_non_null(strstr(err.message, wt_table_name(t)));
        assert_non_null(strstr(err.advice, "csv"));
        assert_int_equal(fclose(out), 0);
        assert_int_equal(size, 0);
        free(bytes);
        wt_table_free(t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells),        cmocka_unit_test(columns_and_keys),
        cmocka_unit_test(blocks),       cmocka_unit_test(same_bytes),
        cmocka_unit_test(invalid_utf8), cmocka_unit_test(refused)};
    return cmocka_run_group_tests_name("table as a database", tests, NULL, NULL);
}
