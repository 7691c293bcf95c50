/* Figures in another language say nothing in English, and their data stay what they were.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_TESTS_GERMAN_FIGURES_H
#define WT_TESTS_GERMAN_FIGURES_H

#include "drawn_report.h"

#include <ctype.h>

/* The texts of a picture: what stands between the marks of its text elements. */
static inline char *shown_texts(const char *svg)
{
    char *shown = malloc(strlen(svg) + 1), *to = shown;
    assert_non_null(shown);
    for (const char *s = svg; (s = strstr(s, "<text")) != NULL;) {
        const char *end = strstr(s, "</text>");
        assert_non_null(end);
        for (bool mark = false; s < end; s++) {
            mark = mark || *s == '<';
            if (!mark && *s != '\n')
                *to++ = *s;
            mark = mark && *s != '>';
        }
        *to++ = '\n';
    }
    *to = '\0';
    return shown;
}

/* A number with a point, such as 0.5. */
static inline const char *decimal_point(const char *shown)
{
    const char *s = shown;
    while ((s = strchr(s, '.')) != NULL &&
           !(s > shown && isdigit((unsigned char)s[-1]) && isdigit((unsigned char)s[1])))
        s++;
    return s;
}

/* Words of English that no other language of ours has. */
static const char *const english_words[] = {
    " the ",      " of ",        " lost",  " with ",  "Sliding",   "velocity",
    "Friction",   "coefficient", "Shift",  "Reduced", "modulus",   "Modulus",
    "Storage",    " layer",      "Layer",  "Nominal", "fitted",    "measured",
    "Relative e", "standard",    "error",  "total",   "shearing",  "wavenumb",
    "thickness",  "Indent",      "Force",  "Time",    "Height",    "spectrum",
    "requency",   "shear",       "stress", "arithm",  "predicted", "approach"};

static inline void test_a_german_figure_is_german(void **state)
{
    (void)state;
    NEED_REPORT();
    wt_report_options options = wt_report_defaults();
    bool comma = false;
    options.language = "de";
    options.with_provenance = false;
    write_report(everything, "de", &options);
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const char *const name = wt_figure_get(i).name;
        char *svg = read_plot("de", name, "svg"), *shown = shown_texts(svg);
        assert_true(strlen(shown) > 0);
        // Names of stages and files and reasons of a fit stand in them as in the result.
        const bool of_result = strcmp(name, "cost") == 0 || strcmp(name, "curves") == 0;
        if (!of_result && decimal_point(shown) != NULL)
            fail_msg("%s has a number with a point:\n%s", name, shown);
        for (const char *s = shown; (s = strchr(s, ',')) != NULL; s++)
            comma = comma ||
                    (s > shown && isdigit((unsigned char)s[-1]) && isdigit((unsigned char)s[1]));
        // So does what was tried.
        const bool of_words = of_result || strcmp(name, "what_if") == 0;
        for (size_t k = 0; k < sizeof english_words / sizeof *english_words && !of_words; k++)
            if (strstr(shown, english_words[k]) != NULL)
                fail_msg("%s says \"%s\":\n%s", name, english_words[k], shown);
        free(shown);
        free(svg);
        // What is drawn stays what it was.
        char *data = read_plot("de", name, "tsv"), *same = read_plot("out", name, "tsv");
        assert_string_equal(data, same);
        free(data);
        free(same);
    }
    assert_true(comma);
}

#endif
