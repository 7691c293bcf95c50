/* Line breaks between words, as late as the width permits, for any indentation.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "assert_near.h"

#include "cmd/text_wrap.c" /* part of the command, not of the library */

#include <stdlib.h>

enum { WORD = 9, WORDS = 40 };

static char *wrapped(size_t column, size_t indent, const char *text)
{
    char *out = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&out, &size);
    assert_non_null(stream);
    cmd_wrap(stream, column, indent, text);
    fclose(stream);
    return out;
}

/* Each line but the last has no space for one more word, and none is too wide. */
static void test_width(void **state)
{
    (void)state;
    char text[WORDS * (WORD + 1) + 1] = "";
    for (int i = 0; i < WORDS; i++)
        strcat(text, i == 0 ? "abcdefghi" : " abcdefghi");
    for (size_t indent = 0; indent < 30; indent++) {
        char *out = wrapped(indent, indent, text), *line = out, *end;
        size_t words = 0, first = indent;
        for (; (end = strchr(line, '\n')) != NULL; line = end + 1, first = 0) {
            size_t width = (size_t)(end - line) + first;
            assert_true(width <= CMD_SCREEN_WIDTH);
            assert_true(end[1] == '\0' || width + 1 + WORD > CMD_SCREEN_WIDTH);
            assert_true(first > 0 || strspn(line, " ") == indent);
            words += (width - indent + 1) / (WORD + 1);
        }
        assert_int_equal(words, WORDS);
        free(out);
    }
}

static void test_lines_and_letters(void **state)
{
    (void)state;
    char *out = wrapped(0, 2, "a line\nanother  one\n  indented");
    assert_string_equal(out, "a line\n  another  one\n  indented\n");
    free(out);
    assert_int_equal(cmd_text_width("3 \xc2\xb5m \xc2\xb1 1", 10), 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_width),
        cmocka_unit_test(test_lines_and_letters),
    };
    return cmocka_run_group_tests_name("wrap", tests, NULL, NULL);
}
