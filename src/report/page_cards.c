/* Writes the findings as cards at the top of the page. The cards format the list of findings and
 * compute only the positions of the bars. SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/base/array.h"
#include "core/table/finding.h"
#include "core/table/result_rows_parts.h"
#include "report/report_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Limits of the axis of the bars: all numbers of the card, with a margin. Without a reference or a
 * second bar the axis begins at zero, so that the bar shows the width relative to the value. */
static void bar_axis(const row_number *n, double neutral, double *low, double *high)
{
    const bool alone = isnan(neutral) && isnan(n->range_low);
    const double ends[] = {
        n->value, n->low, n->high, n->range_low, n->range_high, neutral, alone ? 0 : n->value};
    *low = (double)INFINITY;
    *high = -(double)INFINITY;
    for (size_t i = 0; i < COUNT_OF(ends); i++)
        if (isfinite(ends[i])) {
            *low = fmin(*low, ends[i]);
            *high = fmax(*high, ends[i]);
        }
    const double margin = *high > *low ? 0.05 * (*high - *low) : 1;
    *low -= margin;
    *high += margin;
}

void page_large_number(page_writer *page, const row_number *number, const char *unit,
                       double neutral)
{
    const row_number_text text = row_number_format(number);
    const struct {
        const char *name, *class, *limits;
        double low, high;
    } bars[] = {{"95 % interval", "interval", text.interval, number->low, number->high},
                {"Model choices", "choices", text.range, number->range_low, number->range_high}};
    const size_t n = strcspn(text.value, " "); /* the unit is behind the first blank */
    double left = 0, right = 0;
    if (strpbrk(text.value, "0123456789") == NULL) { /* such as "not known" */
        text_add(&page->out, "<p class=\"verdict\"><strong>");
        text_typographic(&page->out, text.interval[0] != '\0' ? text.interval : text.value);
        text_add(&page->out, "</strong></p>\n");
        return;
    }
    char *const value = wt_strndup(text.value, n);
    text_add(&page->out,
             text.interval[0] != '\0' ? "<p class=\"number\">" : "<p class=\"number plain\">");
    text_typographic(&page->out, value);
    text_add(&page->out, " <span class=\"unit\">");
    text_typographic(&page->out, unit != NULL            ? unit
                                 : text.value[n] != '\0' ? text.value + n + 1
                                                         : "");
    text_add(&page->out, "</span></p>\n<dl>\n");
    free(value);
    bar_axis(number, neutral, &left, &right);
    for (size_t i = 0; i < COUNT_OF(bars); i++) {
        if (!isfinite(bars[i].low) || !isfinite(bars[i].high))
            continue;
        text_html(&page->out, "<div><dt>%s</dt><dd class=\"bar\" aria-hidden=\"true\">",
                  bars[i].name);
        if (!isnan(neutral))
            text_format(&page->out, "<i class=\"neutral\" style=\"left:%s%%\"></i>",
                        FIXED(100 * (neutral - left) / (right - left), 1));
        text_format(&page->out, "<i class=\"%s\" style=\"left:%s%%;width:%s%%\"></i>",
                    bars[i].class, FIXED(100 * (bars[i].low - left) / (right - left), 1),
                    FIXED(100 * (bars[i].high - bars[i].low) / (right - left), 1));
        text_add(&page->out, "</dd><dd class=\"limits\">");
        text_typographic(&page->out, bars[i].limits);
        text_add(&page->out, "</dd></div>\n");
    }
    text_add(&page->out, "</dl>\n");
}

void page_reason(page_writer *page, const char *reason)
{
    if (reason[0] == '\0')
        return;
    text_add(&page->out, "<p>");
    text_sentence(&page->out, reason);
    text_add(&page->out, ".</p>\n");
}

/* Writes what disqualifies a number: the first warning of the limits that concern it, of which
 * the style shows two lines, and the number of the others, so that the limits stay on the first
 * screen. The predictions rest on the material and on one another. */
static void write_card_warnings(page_writer *page, finding_question question)
{
    static const unsigned subjects[FINDING_QUESTIONS] = {
        [FINDING_TRACK_DIFFERS] = 1u << LIMITS_INDENTATION,
        [FINDING_LAYER_THICKNESS] = 1u << LIMITS_MATERIAL | 1u << LIMITS_LAYER,
        [FINDING_FRICTION_CHANGE] =
            1u << LIMITS_MATERIAL | 1u << LIMITS_LAYER | 1u << LIMITS_FRICTION};
    const table_view *const limits = &page->tables->limits;
    size_t n = 0;
    for (size_t i = 0; i < limits->n_rows; i++) {
        const int subject = limits_enum(limits, i, LIMITS_SUBJECT);
        if (limits_enum(limits, i, LIMITS_SEVERITY) != WT_WARNING || subject < 0 ||
            subject >= LIMIT_SUBJECT_UNKNOWN || (subjects[question] >> subject & 1) == 0)
            continue;
        if (n++ > 0)
            continue; /* only counted */
        text_add(&page->out, "<p class=\"warned\"><span>⚠ ");
        text_typographic(&page->out, limits_text(limits, i, LIMITS_LIMIT));
        text_add(&page->out, "</span> ");
    }
    if (n > 1)
        text_format(&page->out, "<a href=\"#limits\">And %zu more warning%s</a></p>\n", n - 1,
                    n == 2 ? "" : "s");
    else if (n == 1)
        text_add(&page->out, "<a href=\"#limits\">Details</a></p>\n");
}

/* Shows a figure of the page again, small, with a link to it. The page has its data once. A picture
 * that is taller than wide has two panels, of which the upper one is shown. */
static void write_key_figure(page_writer *page, const char *name)
{
    double size[2];
    size_t i = 0;
    while (i < page->n_figures && (page->figures[i].svg.length == 0 ||
                                   strcmp(page->figures[i].drawing.figure->name, name) != 0))
        i++;
    if (i == page->n_figures ||
        !svg_canvas_size(text_string(&page->figures[i].svg), page->figures[i].svg.length, size))
        return;
    const bool has_two_panels = size[1] > size[0];
    text_html(&page->out, "<a class=\"key\" href=\"#figure-%s\">", name);
    text_format(&page->out, "<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\"", size[0],
                has_two_panels ? size[1] / 2 : size[1]);
    text_html(&page->out,
              " aria-label=\"%s\"><use href=\"#picture-%s\" height=\"%s\"/></svg></a>\n",
              page->figures[i].drawing.figure->title, name, has_two_panels ? "200%" : "100%");
}

/* Section and key figure of each question. */
static const struct {
    const char *section, *figure;
} links[FINDING_QUESTIONS] = {[FINDING_TRACK_DIFFERS] = {"indentation", "modulus_groups"},
                              [FINDING_LAYER_THICKNESS] = {"layer", "layer"},
                              [FINDING_FRICTION_CHANGE] = {"friction", "friction"}};

static void begin_card(page_writer *page, const char *class, const char *question,
                       const char *verdict, const char *side, const char *basis)
{
    text_html(
        &page->out,
        "<section class=\"finding %s\">\n<h2>%s</h2>\n<p class=\"verdict\"><strong>%s%s</strong>",
        class, question, verdict, side);
    text_html(&page->out, basis[0] != '\0' ? " <span class=\"basis\">%s</span></p>\n" : "%s</p>\n",
              basis);
}

/* Returns the reason of a verdict. A run states why a number is missing. */
static const char *finding_reason(const page_writer *page, const finding *f)
{
    const table_view *const answer = &page->tables->answer;
    return f->verdict == FINDING_NOT_COMPUTED && findings_are_stated(answer)
               ? answer_text(answer, f->question, ANSWER_ANSWER)
               : f->sentence;
}

/* A question that was not asked is a line below the cards of the comparison that was. */
static void write_missing_answer(page_writer *page, const finding *f)
{
    text_html(&page->out, "<p class=\"omitted\">%s %s: ", finding_question_text(f->question),
              finding_verdict_text(f->verdict));
    text_typographic(&page->out, finding_reason(page, f));
    text_add(&page->out, "</p>\n");
}

static void write_card(page_writer *page, const finding *f)
{
    static const char *const class[FINDING_VERDICT_UNKNOWN] = {[FINDING_YES] = "v-yes",
                                                               [FINDING_SAME] = "v-yes",
                                                               [FINDING_PREDICTED] = "v-pred",
                                                               [FINDING_INCONCLUSIVE] = "v-open",
                                                               [FINDING_NOT_ENOUGH_DATA] =
                                                                   "v-nodata",
                                                               [FINDING_NOT_COMPUTED] = "v-nodata"};
    const result_value *value = &f->value;
    const row_number number = row_number_of_value(value);
    const bool known = !isnan(value->number.value);
    begin_card(page, class[f->verdict], finding_question_text(f->question),
               finding_verdict_text(f->verdict), finding_side_text(f),
               known && f->verdict != FINDING_PREDICTED ? finding_basis_text(f->basis) : "");
    if (known && !isnan(value->low))
        page_large_number(page, &number,
                          f->question == FINDING_TRACK_DIFFERS ? "× bulk modulus" : NULL,
                          value->neutral);
    text_add(&page->out, "<p>");
    text_typographic(&page->out, finding_reason(page, f));
    const bool is_given = f->basis == FINDING_GIVEN;
    if (is_given && known) {
        text_add(&page->out, " It is ");
        text_typographic(&page->out, row_number_format(&number).value);
        text_add(&page->out, ".");
    }
    if (f->as_if_layer && !is_given && known)
        text_add(&page->out, " As if there were a layer: the track is not shown to differ.");
    if (known) /* its section exists */
        text_html(&page->out, " <a class=\"why\" href=\"#%s\">Why</a>", links[f->question].section);
    text_add(&page->out, "</p>\n");
    if (f->verdict != FINDING_NOT_COMPUTED)
        write_card_warnings(page, f->question);
    if (value->range.widest != NULL && value->range.remedy == NULL) /* else the remedy names it */
        text_html(&page->out, "<p class=\"widest\">Widest choice: %s.</p>\n", value->range.widest);
    if (known)
        write_key_figure(page, links[f->question].figure);
    text_add(&page->out, "</section>\n");
}

/* Writes the verdict on measured against predicted friction, their ratio, and the shear stress that
 * would make it 1. */
static void write_validation_card(page_writer *page)
{
    const table_view *const v = &page->tables->validation;
    if (v->table == NULL)
        return;
    const int outcome = validation_key_enum(v, VALIDATION_KEY_OUTCOME);
    const char *const reason = validation_key_listed(v, VALIDATION_KEY_VERDICT).reason,
                      *const settled = validation_key_text(v, VALIDATION_KEY_SETTLED_BY);
    const row_number ratio = rows_of_keys(v, VALIDATION_KEY_RATIO),
                     needed = rows_of_keys(v, VALIDATION_KEY_NEEDED);
    const bool is_known = outcome < VALIDATION_OUTCOME_UNKNOWN;
    begin_card(page,
               !is_known                         ? "v-nodata"
               : outcome == OUTCOME_INCONCLUSIVE ? "v-open"
                                                 : "v-yes",
               "Does theory match measured friction?",
               is_known ? validation_outcome_text((validation_outcome)outcome)
                        : stated_verdict_text(VERDICT_NOT_TESTED),
               "", "measured");
    if (!isnan(ratio.low))
        page_large_number(page, &ratio, "× predicted", 1);
    page_reason(page, reason);
    if (!isnan(needed.low)) {
        const row_number_text text = row_number_format(&needed);
        text_add(&page->out, "<p>Shear stress needed: ");
        text_typographic(&page->out, text.value);
        text_add(&page->out, " (");
        text_typographic(&page->out, text.interval);
        text_add(&page->out, ").</p>\n");
    }
    if (settled != NULL) {
        text_add(&page->out, "<p class=\"widest\">How to decide it: ");
        text_typographic(&page->out, settled);
        text_add(&page->out, ".</p>\n");
    }
    write_key_figure(page, "validation");
    text_add(&page->out, "</section>\n");
}

void page_cards(page_writer *page)
{
    result_value_tables tables;
    finding findings[FINDING_QUESTIONS];
    if (result_values_bind(page->result, &tables, NULL) != WT_OK)
        return; /* figure_tables_bind has reported this error */
    if (!findings_compute(&tables, findings) && !findings_are_stated(&page->tables->answer))
        return;
    text_add(&page->out, "<div class=\"findings\">\n");
    const bool validation_first = findings[FINDING_TRACK_DIFFERS].verdict == FINDING_NOT_COMPUTED,
               validated = page->tables->validation.table != NULL;
    if (validation_first)
        write_validation_card(page);
    /* an answer that is there comes before one that is not */
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        if (findings[i].verdict != FINDING_NOT_COMPUTED)
            write_card(page, &findings[i]);
    if (!validation_first)
        write_validation_card(page);
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        if (findings[i].verdict == FINDING_NOT_COMPUTED && !validated)
            write_card(page, &findings[i]);
    text_add(&page->out, "</div>\n");
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        if (findings[i].verdict == FINDING_NOT_COMPUTED && validated)
            write_missing_answer(page, &findings[i]);
}
