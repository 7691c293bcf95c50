/* No figure loses a point. Each section of its data has all rows of its table, in their order and
 * blocks; gnuplot reads and draws them.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/drawing.h"
#include "shared_report.h"
#include "table_cells.h"

#include <ctype.h>

typedef struct sections {
    wt_table *of[MOST];
    size_t n, seen;
    const char *figure;
} sections;

static sections begin_sections(const char *figure)
{
    sections s = {.figure = figure};
    s.n = read_sections("out", figure, s.of);
    return s;
}

/* All of them were requested. */
static void end_sections(sections *s)
{
    if (s->seen != s->n)
        fail_msg("%s has %zu sections, not %zu", s->figure, s->n, s->seen);
    free_sections(s->of, s->n);
}

/* Data of figures have seven digits. */
static const double seven_digits = 6e-7;

/* ---- against their tables -------------------------------------------------------------------- */

/* Rows of a table with these texts in text columns; "!accepted": any other text. */
typedef struct chosen {
    const char *table, *column[2], *text[2];
} chosen;

static bool is_chosen(const wt_table *table, size_t row, const chosen *c)
{
    for (int i = 0; i < 2; i++) {
        if (c->column[i] == NULL)
            continue;
        const bool other = c->text[i][0] == '!';
        if ((strcmp(text_cell(table, row, c->column[i]), c->text[i] + other) == 0) == other)
            return false;
    }
    return true;
}

/* The next section has the chosen rows and the named columns. */
static void next_is(sections *s, chosen c)
{
    const wt_table *table = wt_result_find(everything, c.table);
    if (table == NULL || s->seen == s->n)
        fail_msg("%s: no table %s or no section %zu", s->figure, c.table, s->seen);
    const wt_table *section = s->of[s->seen++];
    size_t row = 0, block = 0, last = 0;
    assert_true(wt_table_n_columns(section) > 0);
    for (size_t i = 0; i < wt_table_n_rows(table); i++) {
        if (!is_chosen(table, i, &c))
            continue;
        if (row == wt_table_n_rows(section))
            fail_msg("%s lacks row %zu of %s", wt_table_name(section), i, c.table);
        block += row > 0 && wt_table_block(table, i) != last;
        last = wt_table_block(table, i);
        assert_int_equal(wt_table_block(section, row), block);
        for (size_t k = 0; k < wt_table_n_columns(section); k++) {
            const double value = number_cell(table, i, wt_table_column_name(section, k));
            assert_near(wt_table_number(section, row, k), isfinite(value) ? value : (double)NAN,
                        seven_digits);
        }
        row++;
    }
    if (row == 0 || row != wt_table_n_rows(section))
        fail_msg("%s has %zu rows, not the %zu of %s", wt_table_name(section),
                 wt_table_n_rows(section), row, c.table);
}

/* The next section is one row with these numbers. */
static void next_has(sections *s, const double *numbers, size_t n)
{
    assert_true(s->seen < s->n);
    const wt_table *section = s->of[s->seen++];
    assert_int_equal(wt_table_n_rows(section), 1);
    assert_int_equal(wt_table_n_columns(section), n);
    for (size_t i = 0; i < n; i++)
        assert_near(wt_table_number(section, 0, i), numbers[i], 1e-6);
}

static void test_whole_tables(void **state)
{
    (void)state;
    NEED_REPORT();
    static const char *const whole[][2] = {{"isotherms", "master_curve"},
                                           {"master_curve", "master_curve"},
                                           {"relaxation", "master_curve"},
                                           {"relaxation_isotherms", "master_curve"},
                                           {"creep_isotherms", "master_curve"},
                                           {"creep", "master_curve"},
                                           {"shift_factors", "shift_factors"},
                                           {"vertical_shifts", "shift_factors"},
                                           {"relaxation_spectrum", "relaxation_spectrum"},
                                           {"influences", "influences"},
                                           {"van_gurp_palmen", "master_curve"},
                                           {"measured_spectrum", "power_spectrum"},
                                           {"angular_spectrum", "angular_spectrum"},
                                           {"power_spectrum", "roughness"},
                                           {"friction", "friction"},
                                           {"contact_area", "contact_area"},
                                           {"friction_scales", "contact_area"},
                                           {"softening", "softening"},
                                           {"flash_temperature", "flash_temperature"},
                                           {"flash_friction", "flash_temperature"},
                                           {"energy_density", "energy_density"},
                                           {"layer", "layer"},
                                           {"cost", "cost"}};
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++) {
        sections s = begin_sections(whole[i][0]);
        next_is(&s, (chosen){.table = whole[i][1]});
        end_sections(&s);
    }
    sections ramp = begin_sections("ramp"), payne = begin_sections("payne");
    next_is(&ramp, (chosen){.table = "ramp"});
    for (size_t i = 0; i < 2; i++)
        next_is(&ramp, (chosen){.table = "glass_transition"});
    end_sections(&ramp);
    next_is(&payne, (chosen){.table = "payne_sweep"});
    for (size_t i = 0; i < 2; i++)
        next_is(&payne, (chosen){.table = "payne"});
    end_sections(&payne);
}

static void test_groups(void **state)
{
    (void)state;
    NEED_REPORT();
    static const struct {
        const char *figure, *column, *group[4];
    } by_group[] = {
        {"force_indentation", "group", {"bulk", "track"}},
        {"modulus_depth", "group", {"bulk", "track"}},
        {"modulus_rate", "group", {"bulk", "track"}},
        {"track_layer", "curve", {"bulk", "track", "thinnest layer", "layer of the theory"}},
        {"collected_ramp", "sample", {"HC", FIXTURE_EVIL}},
        {"transverse_isotropy", "factors", {"none", "loss", "storage", "both"}}};
    for (size_t i = 0; i < sizeof by_group / sizeof *by_group; i++) {
        sections s = begin_sections(by_group[i].figure);
        for (size_t k = 0; k < 4 && by_group[i].group[k] != NULL; k++)
            next_is(&s, (chosen){by_group[i].figure, {by_group[i].column}, {by_group[i].group[k]}});
        end_sections(&s);
    }
    /* a panel for each value of one column, with a curve for each of another */
    static const char *const samples[] = {"HC", FIXTURE_EVIL}, *const conditions[] = {"mild",
                                                                                      "severe"};
    sections rates = begin_sections("collected_modulus"),
             rubbers = begin_sections("collected_friction"),
             areas = begin_sections("collected_area"), forces = begin_sections("collected_force");
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < 3; i++)
            next_is(&rates, (chosen){"collected_modulus",
                                     {"sample", "place"},
                                     {samples[k], i == 0 ? "bulk" : conditions[i - 1]}});
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < 2; i++) {
            const chosen rubber = {
                "collected_friction", {"condition", "sample"}, {conditions[k], samples[i]}};
            next_is(&rubbers, rubber);
            next_is(&areas, rubber);
        }
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < 3; i++)
            next_is(&forces, (chosen){"collected_force",
                                      {"sample", "place"},
                                      {samples[k], i == 0 ? "bulk" : conditions[i - 1]}});
    end_sections(&rates);
    end_sections(&rubbers);
    end_sections(&areas);
    end_sections(&forces);
    sections groups = begin_sections("modulus_groups"), map = begin_sections("modulus_map"),
             dma = begin_sections("dma_comparison");
    next_is(&dma, (chosen){.table = "dma_comparison"});
    for (size_t k = 0; k < 2; k++) {
        static const char *const names[] = {"bulk", "track"}, *const tables[] = {
                                                                  "indentation/bulk",
                                                                  "indentation/track"};
        next_is(&groups, (chosen){tables[k], {"verdict"}, {"accepted"}});
        next_is(&groups, (chosen){"modulus_groups", {"group"}, {names[k]}});
        next_is(&map, (chosen){tables[k], {"verdict"}, {"accepted"}});
        next_is(&map, (chosen){tables[k], {"verdict"}, {"!accepted"}});
        next_is(&dma, (chosen){"dma_comparison", {"group"}, {names[k]}});
    }
    end_sections(&groups);
    end_sections(&map);
    end_sections(&dma);
}

static void test_segments_with_their_contact(void **state)
{
    (void)state;
    NEED_REPORT();
    sections s = begin_sections("force_displacement");
    const wt_table *table = wt_result_find(everything, "force_displacement");
    static const char *const groups[] = {"bulk", "track"}, *const segments[] = {"approach",
                                                                                "retract"};
    /* the contact points follow the two segments of their group */
    for (size_t i = 0; i < 2; i++) {
        char point[64], force[64];
        wt_estimate at = {0}, of = {0};
        (void)snprintf(point, sizeof point, "contact_point_%s", groups[i]);
        (void)snprintf(force, sizeof force, "contact_force_%s", groups[i]);
        assert_true(wt_table_estimate(table, point, &at));
        assert_true(wt_table_estimate(table, force, &of));
        for (size_t k = 0; k < 2; k++)
            next_is(&s,
                    (chosen){"force_displacement", {"group", "segment"}, {groups[i], segments[k]}});
        next_has(&s, (const double[]){at.value, at.standard_error, of.value}, 3);
    }
    end_sections(&s);
}

/* The curve sheet begins with refused curves; the others are in their order. */
static void test_refused_curves_come_first(void **state)
{
    (void)state;
    NEED_REPORT();
    static const char *const titles[] = {":4'", ":0'", ":1'"},
                             *const verdicts[] = {"'bulk: the model does not describe the'",
                                                  "'bulk: accepted'", "'bulk: accepted'"};
    char *script = read_plot("out", "curves", "gp");
    const char *at = script;
    size_t n = 0;
    for (; (at = strstr(at, "set label 1 ")) != NULL; at++, n++) {
        char lines[256] = "";
        (void)snprintf(lines, sizeof lines, "%s", at);
        if (n < 3 && (strstr(lines, titles[n]) == NULL || strstr(lines, verdicts[n]) == NULL))
            fail_msg("panel %zu: %s", n, lines);
    }
    assert_int_equal(n, 12);
    free(script);
}

/* The colour of the next bars of a budget: measured, model, other. */
static void next_bars(const char **script, const char *kind)
{
    static const char bars[] = "boxxyerror ls ";
    const char of = strcmp(kind, "measured") == 0 ? '1' : strcmp(kind, "model") == 0 ? '2' : '5';
    *script = strstr(*script, bars);
    assert_non_null(*script);
    *script += strlen(bars);
    if (**script != of)
        fail_msg("bars of kind %s have style %c", kind, **script);
}

/* Each number of the budget with an error above the drawing limit, and its kinds in their order. */
static void test_error_budget(void **state)
{
    (void)state;
    NEED_REPORT();
    sections s = begin_sections("error_budget");
    char *script = read_plot("out", "error_budget", "gp");
    const char *at = script;
    const wt_table *t = wt_result_find(everything, "error_budget");
    const size_t n = wt_table_n_rows(t);
    for (size_t first = 0, end = 0; first < n; first = end) {
        const char *number = text_cell(t, first, "number"), *last = "";
        bool shown = false;
        for (end = first; end < n && strcmp(text_cell(t, end, "number"), number) == 0; end++)
            shown = shown || number_cell(t, end, "relative_error") > 1e-5;
        for (size_t row = first; row < end && shown; row++) {
            const char *kind = text_cell(t, row, "kind");
            bool any = false; /* a kind without a number is not drawn */
            for (size_t k = first; k < end; k++)
                any = any || (strcmp(text_cell(t, k, "kind"), kind) == 0 &&
                              isfinite(number_cell(t, k, "relative_error")));
            if (strcmp(kind, last) != 0 && any) {
                next_is(&s, (chosen){"error_budget", {"number", "kind"}, {number, kind}});
                next_bars(&at, kind);
            }
            last = kind;
        }
    }
    end_sections(&s);
    free(script);
}

static void test_work_precision(void **state)
{
    (void)state;
    NEED_REPORT();
    sections s = begin_sections("work_precision");
    const wt_table *t = wt_result_find(everything, "work_precision");
    for (size_t row = 0; row < wt_table_n_rows(t); row++) {
        bool first = number_cell(t, row, "seconds") > 0;
        for (size_t i = 0; i < row && first; i++)
            first = strcmp(text_cell(t, i, "method"), text_cell(t, row, "method")) != 0 ||
                    strcmp(text_cell(t, i, "part"), text_cell(t, row, "part")) != 0;
        if (first)
            next_is(&s, (chosen){"work_precision",
                                 {"part", "method"},
                                 {text_cell(t, row, "part"), text_cell(t, row, "method")}});
    }
    end_sections(&s);
}

/* ---- sensitivity: range of each choice, the widest last, then that of chance ----------------- */

typedef struct range {
    const char *choice;
    double low, high;
} range;

static int wider(const void *a, const void *b)
{
    const range *p = a, *q = b;
    const double more = (p->high - p->low) - (q->high - q->low);
    return more > 0 ? 1 : more < 0 ? -1 : 0;
}

/* "'choice' 2.2, 'tried; tried unit' 1.8": a row that moves the number has the unit once. */
static void add_tics(char *tics, size_t size, size_t place_of, const wt_table *t,
                     const char *choice, const char *column)
{
    char tried[256] = "";
    for (size_t row = 1; row < wt_table_n_rows(t); row++) {
        if (strcmp(text_cell(t, row, "choice"), choice) != 0 ||
            !isfinite(number_cell(t, row, column)))
            continue;
        const char *words = text_cell(t, row, "alternative"), *unit = strrchr(words, ' ');
        const size_t used = strlen(tried), length = unit == NULL ? 0 : strlen(unit);
        if (length > 0 && used > length && strcmp(tried + used - length, unit) == 0)
            tried[used - length] = '\0';
        snprintf(tried + strlen(tried), sizeof tried - strlen(tried), "%s%s", used > 0 ? "; " : "",
                 words);
    }
    const size_t used = strlen(tics);
    snprintf(tics + used, size - used, "set ytics add ('%s' %zu.2)\nset ytics add ('%s' %.1f)\n",
             choice, place_of, tried, (double)place_of - 0.2);
}

static void test_what_if(void **state)
{
    (void)state;
    NEED_REPORT();
    static const struct {
        const char *column, *table, *key;
    } panels[] = {{"friction", "friction", "friction_at_reference"},
                  {"friction_with_layer", "friction", "friction_with_layer_at_reference"},
                  {"thickness", "layer", "balance_thickness"}};
    sections s = begin_sections("what_if");
    const wt_table *t = wt_result_find(everything, "what_if");
    char *script = read_plot("out", "what_if", "gp");
    for (size_t p = 0; p < 3; p++) {
        range ranges[MOST];
        size_t n = 0;
        wt_estimate used = {0};
        const double is = number_cell(t, 0, panels[p].column);
        assert_true(
            wt_table_estimate(wt_result_find(everything, panels[p].table), panels[p].key, &used));
        for (size_t row = 1; row < wt_table_n_rows(t); row++) {
            const double value = number_cell(t, row, panels[p].column);
            const char *choice = text_cell(t, row, "choice");
            if (!isfinite(value))
                continue;
            if (n == 0 || strcmp(ranges[n - 1].choice, choice) != 0)
                ranges[n++] = (range){choice, is, is};
            ranges[n - 1].low = fmin(ranges[n - 1].low, value);
            ranges[n - 1].high = fmax(ranges[n - 1].high, value);
        }
        qsort(ranges, n, sizeof *ranges, wider);
        char tics[4096] = "";
        size_t bars = 0;
        for (size_t i = 0; i < n; i++)
            if (ranges[i].high > ranges[i].low) {
                next_has(&s, (const double[]){is, ranges[i].low, ranges[i].high}, 3);
                add_tics(tics, sizeof tics, bars++, t, ranges[i].choice, panels[p].column);
            }
        if (strstr(script, tics) == NULL)
            fail_msg("no %s", tics);
        const double off = 1.959963985 * used.standard_error;
        next_has(&s, (const double[]){is, is - off, is + off}, 3);
    }
    end_sections(&s);
    free(script);
}

/* Names at the positions of their rows: "'name' 3". */
static void test_names_at_their_positions(void **state)
{
    (void)state;
    NEED_REPORT();
    char *script = read_plot("out", "cost", "gp"), tic[160];
    const wt_table *t = wt_result_find(everything, "cost");
    size_t n = 0;
    for (size_t i = 0; i < wt_table_n_rows(t); i++) {
        char stage[96];
        if (!(number_cell(t, i, "runs") > 0))
            continue;
        snprintf(stage, sizeof stage, "%s", text_cell(t, i, "stage"));
        for (char *c = stage; *c != '\0'; c++)
            *c = *c == '_' ? ' ' : *c;
        snprintf(tic, sizeof tic, "'%s' -%zu", stage, ++n);
        if (strstr(script, tic) == NULL)
            fail_msg("cost: no %s", tic);
    }
    snprintf(tic, sizeof tic, "set yrange [-%zu.7:-0.3]", n);
    assert_non_null(strstr(script, tic));
    free(script);
    script = read_plot("out", "error_budget", "gp");
    t = wt_result_find(everything, "error_budget");
    n = wt_table_n_rows(t);
    for (size_t first = 0, end = 0; first < n; first = end) {
        const char *number = text_cell(t, first, "number");
        bool shown = false;
        for (end = first; end < n && strcmp(text_cell(t, end, "number"), number) == 0; end++)
            shown = shown || number_cell(t, end, "relative_error") > 1e-5;
        for (size_t row = first; row < end && shown; row++) {
            const char *source = text_cell(t, row, "source");
            const double seconds = number_cell(t, row, "seconds");
            char time[32] = "";
            if (seconds > 0)
                wt_format_si(seconds, "s", 2, time, sizeof time);
            snprintf(tic, sizeof tic, "'%s%s%s' %zu", source, time[0] != '\0' ? ", " : "", time,
                     end - 1 - row);
            if (strstr(script, tic) == NULL)
                fail_msg("error_budget, %s: no %s", number, tic);
        }
        snprintf(tic, sizeof tic, "set title '%s'", number);
        assert_true(!shown || strstr(script, tic) != NULL);
        snprintf(tic, sizeof tic, "set yrange [-0.7:%zu.7]", end - first - 1); /* a row for each */
        assert_true(!shown || strstr(script, tic) != NULL);
    }
    free(script);
}

/* ---- points in gnuplot ----------------------------------------------------------------------- */

/* Number of rows in each data set of a file: two blank lines separate them, '#' begins a
 * comment. */
static size_t count_sets(const char *figure, size_t lines[MOST])
{
    size_t n = 0, blank = 2;
    char *text = read_plot("out", figure, "tsv"), *next = text;
    while (next != NULL && *next != '\0') {
        char *line = next;
        next = strchr(line, '\n');
        if (next != NULL)
            *next++ = '\0';
        if (*line == '#')
            continue;
        if (*line == '\0') {
            blank++;
            continue;
        }
        if (blank >= 2) {
            assert_true(n < MOST);
            lines[n++] = 0;
        }
        blank = 0;
        lines[n - 1]++;
    }
    free(text);
    return n;
}

static void test_index_finds_every_section(void **state)
{
    (void)state;
    NEED_REPORT();
    for (size_t i = 0; i < wt_figure_count(); i++) {
        size_t lines[MOST];
        sections s = begin_sections(wt_figure_get(i).name);
        assert_int_equal(count_sets(s.figure, lines), s.n);
        for (; s.seen < s.n; s.seen++)
            if (lines[s.seen] != wt_table_n_rows(s.of[s.seen]))
                fail_msg("%s, index %zu: %zu lines of %zu rows", s.figure, s.seen, lines[s.seen],
                         wt_table_n_rows(s.of[s.seen]));
        end_sections(&s);
    }
}

/* The script with its plots written as tables. */
static void tabulate(const char *figure)
{
    char path[160];
    char *script = read_plot("out", figure, "gp"), *rest = NULL;
    (void)snprintf(path, sizeof path, "out/plots/%s.points", figure);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    for (char *line = strtok_r(script, "\n", &rest); line != NULL;
         line = strtok_r(NULL, "\n", &rest)) {
        if (strstr(line, "set multiplot") != NULL)
            continue;
        if (strncmp(line, "plot", 4) == 0)
            (void)fputs("set table 'points' append\n", out);
        (void)fprintf(out, "%s\n", line);
    }
    assert_int_equal(fclose(out), 0);
    free(script);
    (void)unlink("out/plots/points");
    (void)snprintf(path, sizeof path, "cd out/plots && gnuplot %s.points 2>errors", figure);
    assert_int_equal(system(path), 0); // NOLINT(cert-env33-c): a name of ours
}

/* Number of points of a plot item that draws a section; flags for points outside the axes, and for
 * points that a condition removes without a mark. */
typedef struct item {
    size_t points;
    bool outside, unknown, fewer;
} item;

/* Items of a script with points in the table, in their order. */
static size_t list_items(const sections *s, item items[], size_t most)
{
    char *script = read_plot("out", s->figure, "gp"), *rest = NULL;
    size_t n = 0;
    bool plot = false;
    for (char *line = strtok_r(script, "\n", &rest); line != NULL;
         line = strtok_r(NULL, "\n", &rest)) {
        if (strncmp(line, "plot", 4) == 0) {
            plot = true;
            continue;
        }
        if (!plot || strncmp(line, "  ", 2) != 0) {
            plot = false;
            continue;
        }
        const char *index = strstr(line, ".tsv' index "), *every = strstr(line, " every ");
        assert_true(n < most);
        items[n] = (item){.unknown = index == NULL || strstr(line, " smooth ") != NULL};
        if (index != NULL) {
            const size_t section = strtoul(index + strlen(".tsv' index "), NULL, 10);
            const size_t step = every == NULL ? 1 : strtoul(every + strlen(" every "), NULL, 10);
            assert_true(section < s->n && step > 0);
            items[n].points = (wt_table_n_rows(s->of[section]) + step - 1) / step;
            if (strstr(line, " matrix ") != NULL)
                items[n].points *= wt_table_n_columns(s->of[section]);
            // A band without a width in seven digits loses a point.
            items[n].fewer = strstr(line, "NaN") != NULL || strstr(line, "filledcurves") != NULL;
            items[n].outside =
                strstr(line, "filledcurves") != NULL || strstr(line, "lines ls 11") != NULL;
        }
        n++;
    }
    free(script);
    return n;
}

static void end_item(const sections *s, const item *items, size_t k, size_t count)
{
    if (k > 0 && !items[k - 1].unknown && items[k - 1].points != count &&
        !(items[k - 1].fewer && count < items[k - 1].points))
        fail_msg("%s, item %zu: %zu points, not %zu", s->figure, k - 1, count, items[k - 1].points);
}

/* Every row of a section becomes a point inside the axes, unless it has no number to draw. */
static void test_gnuplot_draws_every_point(void **state)
{
    (void)state;
    NEED_REPORT();
    enum { ITEMS = 256 };
    size_t points = 0, drawn_ones = 0;
    for (size_t i = 0; i < wt_figure_count(); i++) {
        sections s = begin_sections(wt_figure_get(i).name);
        item items[ITEMS];
        const size_t n = list_items(&s, items, ITEMS);
        tabulate(s.figure);
        size_t length = 0, k = 0, count = 0;
        char *table = read_all("out/plots/points", &length), *rest = NULL;
        for (char *line = strtok_r(table, "\n", &rest); line != NULL;
             line = strtok_r(NULL, "\n", &rest)) {
            if (strncmp(line, "# Curve ", 8) == 0 && strncmp(line, "# Curve title", 13) != 0) {
                end_item(&s, items, k, count);
                k++;
                count = 0;
            }
            const size_t end = strlen(line);
            if (line[0] == '#' || end < 3 || k == 0)
                continue;
            count++;
            if (items[k - 1].unknown)
                continue;
            points++;
            drawn_ones += line[end - 1] == 'i';
            if (line[end - 1] == 'o' && !items[k - 1].outside)
                fail_msg("%s, item %zu: a point lies outside the axes: %s", s.figure, k - 1, line);
        }
        end_item(&s, items, k, count);
        assert_int_equal(k, n);
        free(table);
        s.seen = s.n;
        end_sections(&s);
    }
    assert_true(drawn_ones > 1000 && points - drawn_ones < points / 10);
}

/* Panels do not overlap: several plots are a multiplot, with a position for each. */
static void test_panels(void **state)
{
    (void)state;
    NEED_REPORT();
    for (size_t i = 0; i < wt_figure_count(); i++) {
        const char *figure = wt_figure_get(i).name;
        char *script = read_plot("out", figure, "gp"), *rest = NULL;
        size_t plots = 0, places = 0, begun = 0, ended = 0;
        for (char *line = strtok_r(script, "\n", &rest); line != NULL;
             line = strtok_r(NULL, "\n", &rest)) {
            size_t down = 0, across = 0;
            plots += strncmp(line, "plot", 4) == 0;
            begun += strncmp(line, "set multiplot", 13) == 0;
            ended += strcmp(line, "unset multiplot") == 0;
            if (sscanf(line, "set multiplot layout %zu,%zu", &down, &across) == 2)
                places = down * across;
        }
        if (begun != ended || begun > 1 || (plots > 1) > begun || (places > 0 && places < plots) ||
            (places > 0 && places >= plots + 3))
            fail_msg("%s: %zu plots in %zu places of %zu multiplots", figure, plots, places, begun);
        free(script);
    }
}

/* ---- many points ----------------------------------------------------------------------------- */

static void repeat(wt_table *copy)
{
    const size_t n = wt_table_n_rows(copy);
    for (size_t k = 0; k < 7 * n; k++) {
        fixture_check(wt_table_add_row(copy, NULL));
        for (size_t c = 0; c < wt_table_n_columns(copy); c++)
            if (wt_table_column_kind(copy, c) == WT_COLUMN_TEXT)
                wt_table_set_text(copy, c, wt_table_text(copy, k % n, c));
            else
                wt_table_set_number(copy, c, wt_table_number(copy, k % n, c));
    }
}

/* If there are too many points, every n-th is drawn with the least n, and the caption states it;
 * the line of a fit is complete. */
static void test_thinned_points(void **state)
{
    (void)state;
    NEED_REPORT();
    static const struct {
        const char *figure, *table, *caption;
        size_t limit;
    } cases[] = {
        {"force_displacement", "force_displacement", "", 1200},
        {"force_indentation", "force_indentation", "up to ", 220},
    };
    for (size_t i = 0; i < 2; i++) {
        const fixture_change change = {cases[i].table, .finish = repeat};
        wt_result *many = fixture_only(&cases[i].table, 1, &change);
        const wt_table *t = wt_result_find(many, cases[i].table);
        size_t rows[2][2] = {{0}}, every[2][2], most = 1;
        write_report(many, "out", NULL);
        for (size_t k = 0; k < wt_table_n_rows(t); k++) {
            const bool track = strcmp(text_cell(t, k, "group"), "track") == 0;
            const bool retract = i == 0 && strcmp(text_cell(t, k, "segment"), "retract") == 0;
            rows[track][retract]++;
        }
        for (size_t g = 0; g < 2; g++) {
            for (size_t r = 0; r < 2; r++)
                every[g][r] = (rows[g][r] + cases[i].limit - 1) / cases[i].limit;
            most = every[g][0] > most ? every[g][0] : most;
        }
        assert_true(most > 1);
        char *script = read_plot("out", cases[i].figure, "gp"), *rest = NULL, words[64];
        snprintf(words, sizeof words, "One sample of %s%zu is drawn.", cases[i].caption, most);
        assert_non_null(strstr(script, words));
        size_t seen = 0;
        for (char *line = strtok_r(script, "\n", &rest); line != NULL;
             line = strtok_r(NULL, "\n", &rest)) {
            const char *of = strstr(line, " every ");
            if (of == NULL || strstr(line, "index") == NULL)
                continue;
            const size_t g = i == 0 ? seen / 2 : seen, r = i == 0 ? seen % 2 : 0;
            assert_true(seen++ < 4);
            assert_int_equal(strtoul(of + strlen(" every "), NULL, 10), every[g][r]);
        }
        assert_int_equal(seen, i == 0 ? 4 : 2);
        free(script);
        wt_result_free(many);
    }
}

static void test_every(void **state)
{
    (void)state;
    static const size_t every[][2] = {{1, 1},  {9, 1},  {10, 1},  {11, 2},
                                      {20, 2}, {21, 3}, {100, 10}};
    for (size_t i = 0; i < sizeof every / sizeof *every; i++) {
        figure_drawing d = {.n_sections = 1, .sections = {wt_table_new("rows", "")}};
        fixture_check(wt_table_add_column(d.sections[0], "x", "1", "", NULL));
        for (size_t k = 0; k < every[i][0]; k++)
            fixture_check(wt_table_add_row(d.sections[0], NULL));
        assert_int_equal(drawing_stride(&d, 0, 10), every[i][1]);
        assert_int_equal(drawing_stride(&d, NO_SECTION, 10), 1);
        wt_table_free(d.sections[0]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_whole_tables),
        cmocka_unit_test(test_groups),
        cmocka_unit_test(test_segments_with_their_contact),
        cmocka_unit_test(test_refused_curves_come_first),
        cmocka_unit_test(test_error_budget),
        cmocka_unit_test(test_work_precision),
        cmocka_unit_test(test_what_if),
        cmocka_unit_test(test_names_at_their_positions),
        cmocka_unit_test(test_index_finds_every_section),
        cmocka_unit_test(test_gnuplot_draws_every_point),
        cmocka_unit_test(test_panels),
        cmocka_unit_test(test_thinned_points),
        cmocka_unit_test(test_every),
    };
    return cmocka_run_group_tests_name("points of the figures", tests, create_shared_report,
                                       remove_shared_report);
}
