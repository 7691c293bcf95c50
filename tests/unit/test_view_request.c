/* Requests to the local server: only its own page is admitted. Files outside the folder of the case
 * are neither read nor written.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "table_cells.h"

#include "view/view.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define TOKEN "0123456789abcdef0123456789abcdef"
enum { PORT = 4711 };

static const view_route *route;

static unsigned parse(const char *method, const char *target, const char *host, const char *origin,
                      const char *site)
{
    const view_head head = {method, target, host, origin, site};
    return view_admit(&head, TOKEN, PORT, view_routes, &route);
}

static unsigned get(const char *target)
{
    return parse("GET", target, "127.0.0.1:4711", NULL, NULL);
}

static void admits_its_page(void **state)
{
    (void)state;
    assert_int_equal(get("/" TOKEN "/"), 200);
    assert_ptr_equal(route, view_routes);
    assert_int_equal(get("/" TOKEN "/plot.js"), 200);
    assert_ptr_equal(route, view_routes);
    assert_int_equal(parse("POST", "/" TOKEN "/curve?group=track&file=a%20%C3%A4.txt&number=17",
                           "localhost:4711", "http://localhost:4711", "same-origin"),
                     200);
    assert_string_equal(route->path, "curve");
    assert_int_equal(
        parse("POST", "/" TOKEN "/save?name=case.xml&was=", "127.0.0.1:4711", NULL, NULL), 200);
    assert_int_equal(route->limit, VIEW_FILE_LIMIT);
}

static void refuses_others(void **state)
{
    (void)state;
    const char *own = "127.0.0.1:4711", *page = "/" TOKEN "/state";
    assert_int_equal(parse("GET", page, own, NULL, NULL), 200);
    /* without the token, with a part of it, with another one */
    assert_int_equal(get("/"), 403);
    assert_int_equal(get("/state"), 403);
    assert_int_equal(get("/0123456789abcdef0123456789abcde/state"), 403);
    assert_int_equal(get("/0123456789abcdef0123456789abcdee/state"), 403);
    assert_int_equal(get("/" TOKEN "0/state"), 403);
    assert_int_equal(get(TOKEN "/state"), 403);
    assert_int_equal(get(""), 403);
    /* another host name for this server, and another page */
    assert_int_equal(parse("GET", page, NULL, NULL, NULL), 403);
    assert_int_equal(parse("GET", page, "evil.example:4711", NULL, NULL), 403);
    assert_int_equal(parse("GET", page, "127.0.0.1:4712", NULL, NULL), 403);
    assert_int_equal(parse("GET", page, "127.0.0.1", NULL, NULL), 403);
    assert_int_equal(parse("GET", page, own, "http://evil.example", NULL), 403);
    assert_int_equal(parse("GET", page, own, "null", NULL), 403);
    assert_int_equal(parse("GET", page, own, "https://127.0.0.1:4711", NULL), 403);
    assert_int_equal(parse("GET", page, own, NULL, "cross-site"), 403);
    assert_int_equal(parse("GET", page, own, NULL, "same-site"), 403);
    assert_int_equal(parse("GET", page, own, NULL, "none"), 200);
}

static void refuses_malformed_requests(void **state)
{
    (void)state;
    assert_int_equal(get("/" TOKEN "/../state"), 404);
    assert_int_equal(get("/" TOKEN "/%2e%2e/state"), 404);
    assert_int_equal(get("/" TOKEN "/sub/plot.js"), 404);
    assert_int_equal(get("/" TOKEN "/nothing"), 404);
    assert_int_equal(get("/" TOKEN "/stat"), 404);
    assert_int_equal(get("/" TOKEN "/state/"), 404);
    assert_int_equal(get("/" TOKEN "/state%00"), 404);
    assert_int_equal(get("/" TOKEN "/save"), 405);
    assert_int_equal(parse("POST", "/" TOKEN "/state", "127.0.0.1:4711", NULL, NULL), 405);
    assert_int_equal(parse("DELETE", "/" TOKEN "/save", "127.0.0.1:4711", NULL, NULL), 405);
    assert_int_equal(parse("GET", NULL, "127.0.0.1:4711", NULL, NULL), 400);
    char *huge = malloc(VIEW_TARGET_LIMIT + 2);
    memset(huge, 'a', VIEW_TARGET_LIMIT + 1);
    huge[VIEW_TARGET_LIMIT + 1] = '\0';
    memcpy(huge, "/" TOKEN "/state?file=", sizeof "/" TOKEN "/state?file=" - 1);
    assert_int_equal(get(huge), 414);
    free(huge);
}

/* ---- files ----------------------------------------------------------------------------------- */

static char place[] = "/tmp/weartrack-view-XXXXXX";

static void put(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void stays_in_its_folder(void **state)
{
    (void)state;
    text_buffer text = {0}, x = {0}, after = {0}, none = {0};
    wt_error err = WT_ERROR_INIT;
    assert_non_null(mkdtemp(place));
    assert_int_equal(chdir(place), 0);
    assert_int_equal(mkdir("case", 0777), 0);
    put("outside.txt", "secret");
    put("case/case.xml", "before");
    assert_int_equal(symlink("../outside.txt", "case/link.xml"), 0);
    assert_int_equal(mkfifo("case/pipe.xml", 0666), 0);
    text_add(&x, "x");
    text_add(&after, "after");
    static const char *const wrong[] = {"../outside.txt", "/etc/hostname", "..", ".",    "",
                                        ".hidden",        "a/b",           "-o", "a\nb", "link.xml",
                                        "pipe.xml"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        if (case_file_read("case", wrong[i], 100, &text, &err) == WT_OK || text.length > 0)
            fail_msg("%s was read", wrong[i]);
        for (int replace = 0; replace < 2; replace++)
            if (case_file_write("case", wrong[i], replace, &x, &err) == WT_OK)
                fail_msg("%s was written", wrong[i]);
    }
    assert_int_equal(case_file_read("case", "case.xml", 5, &text, &err), WT_E_IO);
    text_free(&text);
    assert_int_equal(case_file_write("case", "case.xml", false, &after, &err), WT_E_IO);
    assert_int_equal(case_file_write("case", "case.xml", true, &after, &err), WT_OK);
    assert_int_equal(case_file_write("case", "new.tsv", false, &none, &err), WT_OK);
    assert_int_equal(case_file_read("case", "case.xml", 5, &text, &err), WT_OK);
    assert_string_equal(text_string(&text), "after");
    text_free(&text);
    assert_int_equal(case_file_read("case", "none.xml", 5, &text, &err), WT_E_NOT_FOUND);
    text_free(&x);
    text_free(&after);
    FILE *file = fopen("outside.txt", "r");
    char word[16] = "";
    assert_true(file != NULL && fgets(word, sizeof word, file) != NULL);
    assert_string_equal(word, "secret");
    assert_int_equal(fclose(file), 0);
    static const char *const made[] = {"case/case.xml", "case/new.tsv", "case/link.xml",
                                       "case/pipe.xml", "outside.txt"};
    for (size_t i = 0; i < sizeof made / sizeof made[0]; i++)
        assert_int_equal(unlink(made[i]), 0);
    assert_int_equal(rmdir("case"), 0); /* no temporary file is left */
    assert_int_equal(rmdir(place), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(admits_its_page), cmocka_unit_test(refuses_others),
        cmocka_unit_test(refuses_malformed_requests), cmocka_unit_test(stays_in_its_folder)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
