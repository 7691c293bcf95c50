/* Java .properties: escapes, continued lines, comments, errors. The cases follow the description of
 * java.util.Properties.load.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "read/jpk/jpk.h"

#include <stdlib.h>
#include <string.h>

static property_list parse(const char *text)
{
    property_list p = {0};
    wt_error err = WT_ERROR_INIT;
    assert_int_equal(properties_parse(&p, (const unsigned char *)text, strlen(text), &err), WT_OK);
    return p;
}

static void assert_value(const char *text, const char *key, const char *value)
{
    property_list p = parse(text);
    const char *found = properties_get(&p, key);
    if (value == NULL)
        assert_null(found);
    else
        assert_string_equal(found != NULL ? found : "(none)", value);
    properties_clear(&p);
}

static void separators(void **state)
{
    (void)state;
    assert_value("Truth = Beauty\n", "Truth", "Beauty");
    assert_value("  Truth:Beauty", "Truth", "Beauty");
    assert_value("Truth Beauty\r\n", "Truth", "Beauty");
    assert_value("Truth   :   Beauty  ", "Truth", "Beauty  ");
    assert_value("cheeses", "cheeses", "");
    assert_value("a=b=c:d", "a", "b=c:d");
    assert_value("", "a", NULL);
    assert_value("=x", "", "x");
}

static void escapes(void **state)
{
    (void)state;
    assert_value("t=2022-10-29 12\\:27\\:34\n", "t", "2022-10-29 12:27:34");
    assert_value("a\\=b\\:c\\ d=e", "a=b:c d", "e");
    assert_value("u=100\\u00B5m", "u", "100\302\265m");
    assert_value("u=100\265m", "u", "100\302\265m"); /* Latin-1 */
    assert_value("u=\\u20ac", "u", "\342\202\254");
    assert_value("u=\\uD834\\uDD1E!", "u", "\360\235\204\236!"); /* a pair: U+1D11E */
    assert_value("u=\\uD834x", "u", "\357\277\275x");            /* half a pair */
    assert_value("tab=a\\tb\\\\c", "tab", "a\tb\\c");
    assert_value("end=x\\", "end", "x");
}

static void lines(void **state)
{
    (void)state;
    assert_value("fruits apple, \\\n   pear, \\\r\n\tplum\n", "fruits", "apple, pear, plum");
    assert_value("#a=1\n!a=2\n  # a=3\na=4", "a", "4");
    assert_value("a=1\nb=2\na=3\n", "a", "3"); /* the last one counts */
    assert_value("a=1\rb=2\r\n\n\nc=3", "b", "2");
    assert_value("a=1\rb=2\r\n\n\nc=3", "c", "3");
}

static void numbers(void **state)
{
    (void)state;
    property_list p = parse("a.x=1.5E-5\na.y=NaN\na.z=12 V\n");
    assert_near(properties_number(&p, "a.", "x"), 1.5e-5, 0);
    assert_near(properties_number(&p, "a.", "y"), (double)NAN, 0);
    assert_near(properties_number(&p, "a.", "z"), (double)NAN, 0);
    assert_near(properties_number(&p, "a.", "none"), (double)NAN, 0);
    properties_clear(&p);
}

static void damage(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        size_t length;
        const char *place;
    } bad[] = {{"a=1\nb=\\u12", 10, "line 2"},
               {"a=\\uzzzz", 8, "line 1"},
               {"a=\\u0000", 8, "line 1"},
               {"a=1\n\nb\0=2", 9, "line 3"}};
    property_list p = {0};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        wt_error err = WT_ERROR_INIT;
        const unsigned char *bytes = (const unsigned char *)bad[i].text;
        assert_int_equal(properties_parse(&p, bytes, bad[i].length, &err), WT_E_CORRUPT);
        assert_string_equal(err.place, bad[i].place);
        assert_null(properties_get(&p, "a"));
    }
    properties_clear(&p);
}

/* Largest growth of text: Latin-1 bytes and empty keys, in a buffer of the exact input size. */
static void growth(void **state)
{
    (void)state;
    property_list p = {0};
    unsigned char bytes[512];
    for (size_t n = 0; n < sizeof bytes; n++) {
        unsigned char *exact = malloc(n + 1);
        assert_non_null(exact);
        for (size_t i = 0; i < n; i++)
            exact[i] = i % 2 == 0 ? 0xff : '\n';
        assert_int_equal(properties_parse(&p, exact, n, NULL), WT_OK);
        assert_int_equal(p.n, n == 0 ? 0 : 1);
        memset(exact, '=', n);
        assert_int_equal(properties_parse(&p, exact, n, NULL), WT_OK);
        free(exact);
    }
    properties_clear(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(separators), cmocka_unit_test(escapes), cmocka_unit_test(lines),
        cmocka_unit_test(numbers),    cmocka_unit_test(damage),  cmocka_unit_test(growth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
