/* Languages of a report: every text has its translation and every translation its text. What is
 * drawn in one is looked at where everything is drawn, in test_report_figures.c.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"
#include "report/translations.h"
#include "report_place.h"

#include <ctype.h>
#include <glob.h>

static const char *const names[] = {"de", "fr", "nl"};
enum { LANGUAGES = sizeof names / sizeof *names };

/* ---- texts ----------------------------------------------------------------------------------- */

/* Sorted, each once, owned. */
typedef struct texts {
    char **text;
    size_t n, capacity;
} texts;

static void keep(texts *t, const char *text)
{
    if (text == NULL)
        return;
    if (t->n == t->capacity) {
        t->capacity = t->capacity > 0 ? 2 * t->capacity : 1024;
        t->text = realloc(t->text, t->capacity * sizeof *t->text);
        assert_non_null(t->text);
    }
    t->text[t->n] = strdup(text);
    assert_non_null(t->text[t->n++]);
}

static int compare_translations(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void sort(texts *t)
{
    size_t n = 0;
    qsort(t->text, t->n, sizeof *t->text, compare_translations);
    for (size_t i = 0; i < t->n; i++)
        if (n > 0 && strcmp(t->text[n - 1], t->text[i]) == 0)
            free(t->text[i]);
        else
            t->text[n++] = t->text[i];
    t->n = n;
}

static bool has(const texts *t, const char *text)
{
    return bsearch(&text, t->text, t->n, sizeof *t->text, compare_translations) != NULL;
}

static void clear(texts *t)
{
    for (size_t i = 0; i < t->n; i++)
        free(t->text[i]);
    free(t->text);
    *t = (texts){.n = 0};
}

/* Numbers, marks and letters of formulas are the same everywhere. */
static bool is_words(const char *text)
{
    size_t letters = 0;
    for (const char *s = text; *s != '\0'; s++) {
        if (*s == '%' && s[1] != '\0' && s[1] != ' ')
            s += strcspn(s + 1, "sdufgc%") + 1;
        letters = isalpha((unsigned char)*s) ? letters + 1 : 0;
        if (letters == 2)
            return true;
    }
    return false;
}

static void keep_figures(texts *t)
{
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const figure_description *f = figure_find(i);
        const figure_axis *const axes[] = {&f->x, &f->y[0], &f->y[1], &f->colour};
        keep(t, f->title);
        keep(t, f->nothing);
        keep(t, f->words);
        for (size_t k = 0; k < sizeof axes / sizeof *axes; k++)
            keep(t, axes[k]->label);
        for (const figure_curve *c = f->curves; c->form != CURVE_NONE; c++)
            keep(t, c->title);
    }
}

static void keep_field(texts *t, const schema_field *f)
{
    keep(t, f->label);
    keep(t, f->headline);
    keep(t, f->missing);
}

/* What stands on the page of columns and keys. */
static void keep_tables(texts *t)
{
    const table_schema *const schemas[] = {
#define SCHEMA_OF(table) &(table##_schema),
        FIGURE_TABLES(SCHEMA_OF) & indentation_schema};
    for (size_t i = 0; i < sizeof schemas / sizeof *schemas; i++) {
        for (size_t k = 0; k < schemas[i]->n_columns; k++)
            keep_field(t, &schemas[i]->columns[k]);
        for (size_t k = 0; k < schemas[i]->n_keys; k++)
            keep_field(t, &schemas[i]->keys[k]);
    }
}

/* ---- texts in the sources -------------------------------------------------------------------- */

/* What hands a text on to be looked up; those with an anchor before it have that in small letters.
 */
static const char *const sayers[] = {"translate",
                                     "axis_log",
                                     "axis_linear",
                                     "draw_lines",
                                     "mark_time",
                                     "draw_map",
                                     "translate_count",
                                     "text_append_translated",
                                     "text_append_phrase",
                                     "plot_key",
                                     "page_heading",
                                     "page_fold",
                                     "page_table",
                                     "page_estimates_begin",
                                     "page_estimate",
                                     "heading_cell",
                                     "plot_peaks",
                                     "plot_mark",
                                     "plot_force",
                                     "folded_table",
                                     "ROWS",
                                     "KEYS",
                                     "COLUMNS",
                                     "page_whole_table",
                                     "headline_rows",
                                     "empty_result_value"};

static bool is_name(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* Past a comment, a character or blanks at `s`, or `s`. */
static const char *past(const char *s)
{
    if (strncmp(s, "//", 2) == 0)
        return s + strcspn(s, "\n");
    if (strncmp(s, "/*", 2) == 0)
        return strstr(s, "*/") + 2;
    if (*s == '\'')
        return s + (s[1] == '\\' ? 4 : 3);
    return isspace((unsigned char)*s) || (*s == '\\' && s[1] == '\n') ? s + 1 : s;
}

/* A literal, with those that follow it at once; returns what is behind. */
static const char *literal(const char *s, char *text, size_t size)
{
    size_t n = 0;
    while (*s == '"') {
        for (s++; *s != '"'; s++) {
            const bool escaped = *s == '\\';
            s += escaped;
            assert_true(n + 1 < size);
            text[n++] = escaped && *s == 'n' ? '\n' : *s;
        }
        for (const char *next = ++s; (next = past(s)) != s;)
            s = next;
    }
    text[n] = '\0';
    return s;
}

typedef enum handing { NOTHING, HEADED, SAID } handing;

/* What the name that ends before a parenthesis does with texts. */
static handing handing_of(const char *begin, const char *paren)
{
    const char *from = paren;
    while (from > begin && is_name(from[-1]))
        from--;
    for (size_t i = 0; i < sizeof sayers / sizeof *sayers; i++)
        if (strlen(sayers[i]) == (size_t)(paren - from) &&
            strncmp(sayers[i], from, strlen(sayers[i])) == 0)
            return strncmp(from, "page_", 5) == 0 || strncmp(from, "folded", 6) == 0 ||
                           strncmp(from, "empty_", 6) == 0
                       ? HEADED
                       : SAID;
    return NOTHING;
}

/* Every literal of a source goes to `any`, those within such calls to `said`. */
static void read_source(const char *source, texts *any, texts *said)
{
    enum { DEPTH = 64 };
    handing within[DEPTH] = {NOTHING};
    size_t depth = 0;
    char text[4096];
    for (const char *s = source; *s != '\0';) {
        const char *next = past(s);
        if (next != s) {
            s = next;
        } else if (*s == '"') {
            s = literal(s, text, sizeof text);
            keep(any, text);
            if ((within[depth] == SAID || (within[depth] == HEADED && isupper(text[0]))) &&
                strlen(text) > 2 && is_words(text))
                keep(said, text);
        } else {
            if (*s == '(' && depth + 1 < DEPTH) {
                const handing here = handing_of(source, s);
                depth++;
                within[depth] = here != NOTHING ? here : within[depth - 1];
            }
            depth -= *s == ')' && depth > 0;
            s++;
        }
    }
}

static void read_sources(const char *pattern, texts *any, texts *said)
{
    glob_t found;
    assert_int_equal(glob(pattern, 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        size_t length = 0;
        char *source = read_all(found.gl_pathv[i], &length);
        read_source(source, any, said);
        free(source);
    }
    globfree(&found);
}

/* All that is said, and all that stands anywhere. */
static void find_texts(texts *said, texts *any)
{
    texts unused = {.n = 0};
    keep_figures(said);
    keep_tables(said);
    read_sources(WT_SOURCE_DIR "/src/report/*.c", any, said);
    read_sources(WT_SOURCE_DIR "/src/*/figures*.c", any, said);
    read_sources(WT_SOURCE_DIR "/src/core/*/*.c", any, said);
    read_sources(WT_SOURCE_DIR "/src/*/*.c", any, &unused);
    read_sources(WT_SOURCE_DIR "/src/case/*/*.c", any, &unused);
    for (size_t i = 0; i < said->n; i++)
        keep(any, said->text[i]);
    sort(said);
    sort(any);
    clear(&unused);
}

/* ---- catalogues ------------------------------------------------------------------------------ */

static void print_text(const char *text)
{
    for (const char *s = text; *s != '\0'; s++)
        printf(*s == '"' || *s == '\\' ? "\\%c" : "%c", *s);
}

static void test_every_text_is_translated(void **state)
{
    (void)state;
    texts said = {.n = 0}, any = {.n = 0};
    size_t missing = 0;
    find_texts(&said, &any);
    for (size_t k = 0; k < LANGUAGES; k++) {
        language *l = NULL;
        assert_int_equal(language_open(names[k], &l, NULL), WT_OK);
        for (size_t i = 0; i < said.n; i++)
            if (is_words(said.text[i]) && translate(l, said.text[i]) == said.text[i]) {
                printf("%s: msgid \"", names[k]);
                print_text(said.text[i]);
                printf("\"\n");
                missing++;
            }
        language_close(l);
    }
    clear(&said);
    clear(&any);
    if (missing > 0)
        fail_msg("%zu translations are missing in src/report/languages", missing);
}

static void test_every_translation_has_its_text(void **state)
{
    (void)state;
    texts said = {.n = 0}, any = {.n = 0};
    find_texts(&said, &any);
    for (size_t k = 0; k < LANGUAGES; k++) {
        language *l = NULL;
        assert_int_equal(language_open(names[k], &l, NULL), WT_OK);
        for (size_t i = 0; i < l->n; i++) {
            if (!has(&any, l->sentences[i].english))
                fail_msg("%s: nothing says \"%s\"", names[k], l->sentences[i].english);
            if (i > 0 && strcmp(l->sentences[i - 1].english, l->sentences[i].english) == 0)
                fail_msg("%s: \"%s\" is there twice", names[k], l->sentences[i].english);
        }
        language_close(l);
    }
    clear(&said);
    clear(&any);
}

/* The next placeholder of a text that is a format, "" at its end. */
static const char *placeholder(const char *s, char found[16])
{
    found[0] = '\0';
    s += strcspn(s, "%");
    if (*s == '\0')
        return s;
    const size_t n = strcspn(s + 1, "sdufgcz% ") + 2 + (s[1 + strcspn(s + 1, "sdufgcz% ")] == 'z');
    (void)snprintf(found, 16, "%.*s", (int)n, s);
    return s + n;
}

/* "95 % interval" is none. */
static bool is_format(const char *text)
{
    for (const char *s = text; (s = strchr(s, '%')) != NULL; s++)
        if (strchr("szd%", s[1]) != NULL || (s[1] == '.' && isdigit((unsigned char)s[2])))
            return s[1] != '\0';
    return false;
}

/* A translation takes what its text takes, in the same order, begins and ends with the same blanks,
 * and has nothing that gnuplot or HTML would take for more than itself. */
static void check_translation(const char *name, const translation *t)
{
    const char *e = t->english, *w = t->words;
    char a[16] = "", b[16] = "";
    while (is_format(e) || is_format(w)) {
        e = placeholder(e, a);
        w = placeholder(w, b);
        if (strcmp(a, b) != 0)
            fail_msg("%s: \"%s\" has %s where the text \"%s\" has %s", name, t->words, b,
                     t->english, a);
        if (a[0] == '\0')
            break;
    }
    const size_t of_text = strlen(t->english), of_words = strlen(t->words);
    if ((t->english[0] == ' ') != (t->words[0] == ' ') ||
        (t->english[of_text - 1] == ' ') != (t->words[of_words - 1] == ' '))
        fail_msg("%s: blanks about \"%s\"", name, t->words);
    if (strpbrk(t->words, "'\"\\`@<>&\n") != NULL && strpbrk(t->english, "'\"<>&") == NULL)
        fail_msg("%s: a quote, escape or mark of HTML in \"%s\"", name, t->words);
}

static void test_translations_take_what_texts_take(void **state)
{
    (void)state;
    for (size_t k = 0; k < LANGUAGES; k++) {
        language *l = NULL;
        assert_int_equal(language_open(names[k], &l, NULL), WT_OK);
        for (size_t i = 0; i < l->n; i++)
            check_translation(names[k], &l->sentences[i]);
        language_close(l);
    }
}

/* ---- names of languages ---------------------------------------------------------------------- */

static void test_an_unknown_language(void **state)
{
    (void)state;
    language *l = NULL;
    wt_error err = {.status = WT_OK};
    assert_int_equal(language_open("xx", &l, &err), WT_E_ARG);
    assert_null(l);
    assert_string_equal(err.expected, "de, fr, nl, en");
    assert_int_equal(language_open("en", &l, &err), WT_OK);
    assert_null(l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_text_is_translated),
        cmocka_unit_test(test_every_translation_has_its_text),
        cmocka_unit_test(test_translations_take_what_texts_take),
        cmocka_unit_test(test_an_unknown_language),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
