/* Writes what follows the cards: what would make the answers more certain, the limits, and the data
 * that were used. SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/table/finding.h"
#include "core/table/result_row.h"
#include "report/report_text.h"

#include <stdlib.h>
#include <string.h>

/* Writes a text of at most `most` characters as it is; of a longer one only the beginning is
 * unfolded, up to a mark. */
static void write_folded(page_writer *page, const char *text, size_t most)
{
    enum { BEGINNING = 20 }; /* "One scan: ..." alone says nothing */
    size_t n = strlen(text);
    for (size_t i = BEGINNING; n > most && i + 2 < n; i++)
        if (strchr(":;.", text[i]) != NULL && text[i + 1] == ' ')
            n = i;
    const bool folded = text[n] != '\0';
    char *const brief = wt_strndup(text, n);
    text_add(&page->out, folded ? "<details class=\"printed\"><summary>" : "");
    text_sentence(&page->out, brief);
    if (folded) {
        text_add(&page->out, "</summary>");
        text_sentence(&page->out, text + n + 2);
        text_add(&page->out, "</details>");
    }
    free(brief);
}

/* ---- more certain ---------------------------------------------------------------------------- */

static void add_range(text_buffer *out, const result_value *f)
{
    const row_number number = row_number_of_value(f);
    const row_number_text text = row_number_format(&number);
    const char *const unit = strchr(text.value, ' ');
    text_add(out, ": ");
    text_typographic(out, text.range);
    text_typographic(out, unit != NULL ? unit : "");
}

static void write_remedy_row(page_writer *page, const finding *f)
{
    const result_value *const value = &f->value;
    text_html(&page->out, "<tr><th scope=\"row\">%s</th><td data-label=\"Held back by\">",
              finding_subject_text(f->question));
    if (f->verdict == FINDING_NOT_COMPUTED || f->verdict == FINDING_NOT_ENOUGH_DATA) {
        text_add(&page->out, "missing data");
    } else if (value->remedy == NULL) {
        text_html(&page->out, "%s", value->range.widest);
        add_range(&page->out, value);
    } else
        text_add(&page->out, "the 95 % interval");
    text_add(&page->out, "</td><td data-label=\"Do this\">");
    write_folded(page, f->remedy, 0);
    text_add(&page->out, "</td></tr>\n");
}

static bool has_remedy(const finding *f)
{
    const bool inconclusive =
        f->verdict == FINDING_INCONCLUSIVE || f->verdict == FINDING_NOT_ENOUGH_DATA;
    return (f->verdict == FINDING_NOT_COMPUTED && f->remedy[0] != '\0') ||
           (inconclusive && f->value.remedy != NULL) ||
           (f->value.range.widest != NULL && f->value.range.remedy != NULL);
}

static void write_remedies(page_writer *page, const finding *findings)
{
    size_t n_rows = 0;
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        n_rows += has_remedy(&findings[i]);
    if (n_rows == 0)
        return;
    text_add(&page->out, "<section>\n<h2 id=\"certain\">What would make this more certain</h2>\n"
                         "<table>\n<caption class=\"hidden\">Widest uncertainty of each "
                         "answer</caption>\n<thead><tr><th "
                         "scope=\"col\">Answer</th><th scope=\"col\">Held "
                         "back by</th><th scope=\"col\">Do this</th></tr></thead>\n<tbody>\n");
    for (size_t i = FINDING_QUESTIONS; i-- > 0;) /* friction first: it rests on the other answers */
        if (has_remedy(&findings[i]))
            write_remedy_row(page, &findings[i]);
    text_add(&page->out, "</tbody>\n</table>\n</section>\n");
}

/* ---- limits ---------------------------------------------------------------------------------- */

/* Row of the limits, or of the notes of a result without limits. */
typedef struct limit_line {
    const char *text, *file; /* that the text is about, or "" */
    bool warned;
} limit_line;

/* The details of a long limit are folded, so that all limits are seen at once. */
static void write_limit_items(page_writer *page, const limit_line *lines, size_t n)
{
    enum { TWO_LINES = 110 };
    text_add(&page->out, "<ul>\n");
    for (size_t i = 0; i < n; i++) {
        text_add(&page->out, lines[i].warned ? "<li class=\"warned\">" : "<li>");
        write_folded(page, lines[i].text, TWO_LINES);
        if (lines[i].file[0] != '\0')
            text_html(&page->out, " (%s)", wt_path_base(lines[i].file));
        text_add(&page->out, "</li>\n");
    }
    text_add(&page->out, "</ul>\n");
}

static void write_limits(page_writer *page)
{
    enum { SHOWN = 5 }; /* what is read on one screen */
    const table_view *const limits = &page->tables->limits, *const notes = &page->tables->notes;
    limit_line *const lines = wt_alloc(limits->n_rows + notes->n_rows + 1, sizeof *lines);
    size_t n = 0;
    for (; n < limits->n_rows; n++)
        lines[n] = (limit_line){limits_text(limits, n, LIMITS_LIMIT), "",
                                limits_enum(limits, n, LIMITS_SEVERITY) == WT_WARNING};
    /* the notes on a result, which are worse, come after those on its data */
    for (size_t i = limits->n_rows == 0 ? notes->n_rows : 0; i-- > 0;)
        if (notes_enum(notes, i, NOTES_SEVERITY) != WT_NOTE)
            lines[n++] = (limit_line){notes_text(notes, i, NOTES_TEXT),
                                      notes_text(notes, i, NOTES_FILE), true};
    if (n > 0) {
        text_html(&page->out, "<section>\n<h2 id=\"limits\">%s</h2>\n",
                  limits->n_rows > 0 ? "Limits" : "Warnings");
        write_limit_items(page, lines, n < SHOWN ? n : SHOWN);
        if (n > SHOWN) {
            text_format(&page->out, "<details class=\"printed\">\n<summary>%zu more</summary>\n",
                        n - SHOWN);
            write_limit_items(page, lines + SHOWN, n - SHOWN);
            text_add(&page->out, "</details>\n");
        }
        text_add(&page->out, "</section>\n");
    }
    free(lines);
}

/* ---- data used ------------------------------------------------------------------------------- */

/* True if the rows name one file: paths of notes are relative to the case. */
static bool is_same_file(const char *path, const char *named)
{
    const size_t n = strlen(path), m = strlen(named);
    return m > 0 && n >= m && strcmp(path + n - m, named) == 0 &&
           (n == m || path[n - m - 1] == '/');
}

/* Role of a file. Groups of force curves differ by name. */
typedef struct file_role {
    wt_input_role role;
    const char *name;
} file_role;

static file_role role_of(const table_view *inputs, size_t row)
{
    return (file_role){(wt_input_role)inputs_enum(inputs, row, INPUTS_ROLE),
                       inputs_text(inputs, row, INPUTS_ROLE)};
}

static bool has_role(const table_view *inputs, size_t row, file_role r)
{
    const file_role own = role_of(inputs, row);
    return own.role == r.role && (r.role != WT_ROLE_GROUP || strcmp(own.name, r.name) == 0);
}

/* Number of warnings and losses of the files of a role. */
static size_t count_warnings(const figure_tables *t, file_role role)
{
    size_t n = 0;
    for (size_t i = 0; i < t->notes.n_rows; i++) {
        if (notes_enum(&t->notes, i, NOTES_SEVERITY) == WT_NOTE)
            continue;
        for (size_t k = 0; k < t->inputs.n_rows; k++)
            if (has_role(&t->inputs, k, role) &&
                is_same_file(inputs_text(&t->inputs, k, INPUTS_PATH),
                             notes_text(&t->notes, i, NOTES_FILE))) {
                n++;
                break;
            }
    }
    return n;
}

/* Adds how many of the used curves of a group are not accepted without reserve. */
static void add_reserves(text_buffer *out, const figure_tables *t, const char *group)
{
    size_t wide = 0, doubtful = 0;
    for (size_t i = 0; i < t->n_indentation; i++) {
        const table_view *const curves = &t->indentation[i];
        for (size_t row = 0; row < curves->n_rows && strcmp(curves->suffix, group) == 0; row++) {
            const int verdict = indentation_enum(curves, row, INDENTATION_VERDICT);
            wide += verdict == WT_CURVE_WIDE;
            doubtful += verdict == WT_CURVE_DOUBTFUL;
        }
    }
    if (wide + doubtful > 0)
        text_format(out, " (%zu wide, %zu doubtful)", wide, doubtful);
}

static bool write_group_use(text_buffer *out, const figure_tables *t, const char *group)
{
    const table_view *const groups = &t->modulus_groups;
    for (size_t row = 0; row < groups->n_rows; row++) {
        if (strcmp(modulus_groups_text(groups, row, MODULUS_GROUPS_GROUP), group) != 0)
            continue;
        const double spots = modulus_groups_get(groups, row, MODULUS_GROUPS_N_SPOTS),
                     rejected = modulus_groups_get(groups, row, MODULUS_GROUPS_N_REJECTED);
        text_format(out, "%.0f curves", modulus_groups_get(groups, row, MODULUS_GROUPS_N));
        add_reserves(out, t, group);
        text_format(out, " on %.0f spot%s, %.0f rejected", spots, spots == 1 ? "" : "s", rejected);
        return true;
    }
    return false;
}

/* Writes what came out of the files of a role. */
static void write_use(text_buffer *out, const figure_tables *t, file_role role)
{
    if (write_group_use(out, t, role.name))
        return;
    if (role.role == WT_ROLE_DMA && t->shift_factors.n_rows > 0) {
        size_t used = 0;
        for (size_t i = 0; i < t->shift_factors.n_rows; i++)
            used += shift_factors_get(&t->shift_factors, i, SHIFT_FACTORS_DETERMINED) > 0;
        text_format(out, "%zu of %zu isotherms", used, t->shift_factors.n_rows);
    } else if (role.role == WT_ROLE_RECORD && t->record.n_rows > 0)
        text_format(out, "%zu step%s", t->record.n_rows, t->record.n_rows == 1 ? "" : "s");
    else {
        size_t n = 0;
        for (size_t i = 0; i < t->inputs.n_rows; i++)
            n += has_role(&t->inputs, i, role);
        text_format(out, "%zu file%s", n, n == 1 ? "" : "s");
    }
}

static void write_role_row(page_writer *page, size_t first)
{
    const figure_tables *const t = page->tables;
    const file_role role = role_of(&t->inputs, first);
    const char *const format = inputs_text(&t->inputs, first, INPUTS_FORMAT);
    size_t n = 0;
    bool one_format = true;
    for (size_t i = 0; i < t->inputs.n_rows; i++)
        if (has_role(&t->inputs, i, role)) {
            n++;
            one_format =
                one_format && strcmp(inputs_text(&t->inputs, i, INPUTS_FORMAT), format) == 0;
        }
    const size_t warnings = count_warnings(t, role);
    text_html(&page->out, "<tr><th scope=\"row\">%s</th><td data-label=\"Files\">", role.name);
    text_format(&page->out, "%zu file%s", n, n == 1 ? "" : "s");
    text_html(&page->out, ", %s</td><td data-label=\"Used\">",
              one_format ? format : "several formats");
    write_use(&page->out, t, role);
    text_add(&page->out, "</td><td data-label=\"Remarks\">");
    if (warnings > 0)
        text_format(&page->out, "<a class=\"warned\" href=\"#notes\">%zu warning%s</a>", warnings,
                    warnings == 1 ? "" : "s");
    else
        text_add(&page->out, "none");
    text_add(&page->out, "</td></tr>\n");
}

/* True for the first file of a role that holds data. */
static bool is_first_of_role(const table_view *inputs, size_t row)
{
    const file_role role = role_of(inputs, row);
    size_t before = 0;
    while (before < row && !has_role(inputs, before, role))
        before++;
    return before == row && role.role != WT_ROLE_CASE;
}

static void write_data_used(page_writer *page)
{
    const table_view *const inputs = &page->tables->inputs;
    if (inputs->n_rows == 0)
        return;
    page_heading(page, "data", "Data used");
    text_add(&page->out,
             "<table>\n<caption class=\"hidden\">Input files by role</caption>\n<thead><tr><th "
             "scope=\"col\">Input</th><th scope=\"col\">Files</th><th "
             "scope=\"col\">Used</th><th scope=\"col\">Remarks</th></tr></thead>\n<tbody>\n");
    size_t others = 0; /* warnings that name no file */
    for (size_t i = 0; i < page->tables->notes.n_rows; i++)
        others += notes_enum(&page->tables->notes, i, NOTES_SEVERITY) != WT_NOTE &&
                  notes_text(&page->tables->notes, i, NOTES_FILE)[0] == '\0';
    for (size_t i = 0; i < inputs->n_rows; i++)
        if (is_first_of_role(inputs, i))
            write_role_row(page, i);
    text_add(&page->out, "</tbody>\n</table>\n");
    if (others > 0)
        text_format(&page->out,
                    "<p><a class=\"warned\" href=\"#notes\">%zu warning%s of no single file</a></p>"
                    "\n",
                    others, others == 1 ? "" : "s");
}

/* ---- conditions ------------------------------------------------------------------------------ */

/* Adds "bulk: 48 curves on 4 spots, 0 rejected" for each role of the inputs. */
static void add_data_line(text_buffer *line, const figure_tables *t)
{
    const char *between = " ";
    for (size_t i = 0; i < t->inputs.n_rows; i++)
        if (is_first_of_role(&t->inputs, i)) {
            const file_role role = role_of(&t->inputs, i);
            text_html(line, "%s%s ", between, role.name);
            write_use(line, t, role);
            between = "; ";
        }
}

/* Adds "bulk-1.jpk-force-map and 3 more files" for a result without a table of the inputs. */
static void add_input_names(text_buffer *out, const wt_provenance *provenance)
{
    const size_t n = provenance != NULL ? wt_provenance_n_inputs(provenance) : 0;
    if (n == 0)
        return;
    text_add(out, "Data: ");
    text_html(out, "%s", wt_path_base(wt_provenance_get_input(provenance, 0)->path));
    if (n > 1)
        text_format(out, " and %zu more file%s", n - 1, n == 2 ? "" : "s");
}

void page_conditions(page_writer *page)
{
    result_rows list;
    text_buffer line = {0};
    if (!result_rows_of_findings(page->result, &list)) {
        result_rows_clear(&list);
        result_rows_compute(page->result, &list);
    }
    text_sentence(&line, list.heading);
    text_add(&line, line.length > 0 ? ". " : "");
    if (page->tables->inputs.n_rows > 0) {
        text_add(&line, "<a href=\"#data\">Data</a>:");
        add_data_line(&line, page->tables);
    } else
        add_input_names(&line, wt_result_provenance_const(page->result));
    if (line.length > 0)
        text_format(&page->out, "<p class=\"conditions\">%s</p>\n", text_string(&line));
    text_free(&line);
    result_rows_clear(&list);
}

void page_summary(page_writer *page)
{
    result_value_tables tables;
    finding findings[FINDING_QUESTIONS];
    const text_buffer before = page->out;
    text_buffer column[2]; /* remedies and data, limits */
    page->out = (text_buffer){0};
    if (result_values_bind(page->result, &tables, NULL) == WT_OK &&
        (findings_compute(&tables, findings) || findings_are_stated(&page->tables->answer)))
        write_remedies(page, findings);
    write_data_used(page);
    column[0] = page->out;
    page->out = (text_buffer){0};
    write_limits(page);
    column[1] = page->out;
    page->out = before;
    const int n = (column[0].length > 0) + (column[1].length > 0);
    if (n > 0)
        text_html(&page->out, "<div class=\"%s\">\n", n > 1 ? "summary" : "summary alone");
    for (int i = 0; i < 2; i++) {
        if (column[i].length > 0)
            text_format(&page->out, "<div>\n%s</div>\n", text_string(&column[i]));
        text_free(&column[i]);
    }
    text_add(&page->out, n > 0 ? "</div>\n" : "");
    page_whole_table(page, &page->tables->data_quality, "What was done to the data", NULL, 0);
}
