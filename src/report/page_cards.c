/* Writes the findings as cards at the top of the page. The cards format the list of findings and
 * compute only the positions of the bars. SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/base/array.h"
#include "core/table/finding.h"
#include "report/report_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A ratio without a unit that has the neutral value 0 is a relative change and shown in percent. */
display_unit select_finding_unit(const result_value *f)
{
    if (f->neutral == 0)
        return (display_unit){.factor = 100, .offset = 0, .label = "%"};
    return select_display_unit(f->quantity, f->number.unit, f->number.value);
}

/* Limits of the axis of the bars: all numbers of the card, with a margin. Without a reference or a
 * second bar the axis begins at zero, so that the bar shows the width relative to the value. */
static void bar_axis(const result_value *f, double *low, double *high)
{
    const bool alone = isnan(f->neutral) && isnan(f->range.low);
    const double ends[] = {f->number.value,
                           f->low,
                           f->high,
                           f->range.low,
                           f->range.high,
                           f->neutral,
                           alone ? 0 : f->number.value};
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

void page_bar(page_writer *page, const char *name, const char *class, const char *text,
              const result_value *f, double low, double high)
{
    double left = 0, right = 0;
    if (!isfinite(low) || !isfinite(high))
        return;
    bar_axis(f, &left, &right);
    text_html(&page->out, "<div><dt>%s</dt><dd class=\"bar\" aria-hidden=\"true\">", name);
    if (!isnan(f->neutral))
        text_format(&page->out, "<i class=\"neutral\" style=\"left:%s%%\"></i>",
                    FIXED(100 * (f->neutral - left) / (right - left), 1));
    text_format(&page->out, "<i class=\"%s\" style=\"left:%s%%;width:%s%%\"></i>", class,
                FIXED(100 * (low - left) / (right - left), 1),
                FIXED(100 * (high - low) / (right - left), 1));
    text_html(&page->out, "</dd><dd class=\"limits\">%s</dd></div>\n", text);
}

void page_reason(page_writer *page, const char *verdict)
{
    const size_t n = length_without_reason(verdict);
    const char *const reason = verdict[n] != '\0' ? verdict + n + 2 : verdict;
    text_add(&page->out, "<p>");
    text_sentence(&page->out, reason);
    text_add(&page->out, ".</p>\n");
}

/* Writes one bar of a finding with its limits, whose unit is that of the number above. */
static void write_bar(page_writer *page, const char *name, const char *class, const result_value *f,
                      double low, double high)
{
    const display_unit lab = select_finding_unit(f);
    /* both bars of a card have the digits of its number */
    const int digits = result_value_digits(f->number.value, f->low, f->high);
    text_buffer text = {0};
    text_format(&text, "%s to %s", NUMBER(to_display_value(&lab, low), digits),
                NUMBER(to_display_value(&lab, high), digits));
    if (isfinite(f->number.value))
        page_bar(page, name, class, text_string(&text), f, low, high);
    text_free(&text);
}

/* Writes what disqualifies a number: the warnings of the limits that concern it, without their
 * details. The predictions rest on the material and on one another. */
static void write_card_warnings(page_writer *page, finding_question question)
{
    static const unsigned subjects[FINDING_QUESTIONS] = {
        [FINDING_TRACK_DIFFERS] = 1u << LIMITS_INDENTATION,
        [FINDING_LAYER_THICKNESS] = 1u << LIMITS_MATERIAL | 1u << LIMITS_LAYER,
        [FINDING_FRICTION_CHANGE] =
            1u << LIMITS_MATERIAL | 1u << LIMITS_LAYER | 1u << LIMITS_FRICTION};
    const table_view *const limits = &page->tables->limits;
    for (size_t i = 0; i < limits->n_rows; i++) {
        const int subject = limits_enum(limits, i, LIMITS_SUBJECT);
        if (limits_enum(limits, i, LIMITS_SEVERITY) != WT_WARNING || subject < 0 ||
            subject >= LIMIT_SUBJECT_UNKNOWN || (subjects[question] >> subject & 1) == 0)
            continue;
        const char *const text = limits_text(limits, i, LIMITS_LIMIT);
        char *const brief = wt_strndup(text, length_without_reason(text));
        text_add(&page->out, "<p class=\"warned\">⚠ ");
        text_typographic(&page->out, brief);
        text_html(&page->out, "%s <a href=\"#limits\">Details</a></p>\n",
                  strlen(brief) < strlen(text) ? "." : "");
        free(brief);
    }
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
    text_html(&page->out, "<section class=\"finding %s\">\n<h2>%s</h2>\n<p class=\"verdict\">",
              class[f->verdict], finding_question_text(f->question));
    text_html(&page->out, "<strong>%s%s</strong>", finding_verdict_text(f->verdict),
              finding_side_text(f));
    if (!isnan(value->number.value) && f->verdict != FINDING_PREDICTED)
        text_html(&page->out, " <span class=\"basis\">%s</span>", finding_basis_text(f->basis));
    text_add(&page->out, "</p>\n");
    if (!isnan(value->number.value) && !isnan(value->low)) {
        const display_unit lab = select_finding_unit(value);
        text_format(&page->out, "<p class=\"number\">%s <span class=\"unit\">%s</span></p>\n<dl>\n",
                    NUMBER(to_display_value(&lab, value->number.value), 3),
                    f->question == FINDING_TRACK_DIFFERS ? "× bulk modulus" : lab.label);
        write_bar(page, "95 % interval", "interval", value, value->low, value->high);
        write_bar(page, "Model choices", "choices", value, value->range.low, value->range.high);
        text_add(&page->out, "</dl>\n");
    }
    /* a run states why a number is missing */
    const table_view *const answer = &page->tables->answer;
    const bool stated = f->verdict == FINDING_NOT_COMPUTED && findings_are_stated(answer);
    text_add(&page->out, "<p>");
    text_typographic(&page->out,
                     stated ? answer_text(answer, f->question, ANSWER_ANSWER) : f->sentence);
    const bool is_given = f->basis == FINDING_GIVEN;
    if (is_given && isfinite(value->number.value)) {
        const display_unit lab = select_finding_unit(value);
        text_format(&page->out, " It is %s %s.",
                    NUMBER(to_display_value(&lab, value->number.value), 3), lab.label);
    }
    if (f->as_if_layer && !is_given && !isnan(value->number.value))
        text_add(&page->out,
                 " The track is not shown to differ: the number is as if there were a layer.");
    if (!isnan(value->number.value)) /* its section exists */
        text_html(&page->out, " <a class=\"why\" href=\"#%s\">Why</a>", links[f->question].section);
    text_add(&page->out, "</p>\n");
    write_card_warnings(page, f->question);
    if (value->range.widest != NULL)
        text_html(&page->out, "<p class=\"widest\">Widest choice: %s", value->range.widest);
    if (value->range.widest != NULL && isfinite(f->rest) && f->remedy[0] != '\0')
        text_format(&page->out,
                    "; <a href=\"#certain\">measuring it</a> leaves %.0f %% of the range",
                    100 * f->rest);
    if (value->range.widest != NULL)
        text_add(&page->out, ".</p>\n");
    if (!isnan(value->number.value))
        write_key_figure(page, links[f->question].figure);
    text_add(&page->out, "</section>\n");
}

/* Writes the card of a comparison of measured with predicted friction. */
static void write_validation_card(page_writer *page)
{
    static const struct {
        const char *class, *text;
    } outcomes[] = {[OUTCOME_INCONCLUSIVE] = {"v-open", "inconclusive"},
                    [OUTCOME_EXPLAINS] = {"v-yes", "yes"},
                    [OUTCOME_EXPLAINS_WITH_SHEAR] = {"v-yes", "yes, with another shear stress"},
                    [OUTCOME_DOES_NOT] = {"v-yes", "no"}};
    const table_view *const v = &page->tables->validation;
    if (v->table == NULL)
        return;
    const int outcome = validation_key_enum(v, VALIDATION_KEY_OUTCOME);
    const bool known = outcome >= 0 && outcome < (int)COUNT_OF(outcomes);
    const double none = (double)NAN;
    const result_value ratio = {
        .number = {validation_value(v, VALIDATION_KEY_RATIO).value, none, none, "1"},
        .low = validation_value(v, VALIDATION_KEY_RATIO_LOW).value,
        .high = validation_value(v, VALIDATION_KEY_RATIO_HIGH).value,
        .neutral = 1,
        .range = {.low = none, .high = none}};
    text_html(&page->out,
              "<section class=\"finding %s\">\n<h2>Does theory match measured friction?</h2>\n"
              "<p class=\"verdict\"><strong>%s</strong> <span class=\"basis\">measured</span></p>"
              "\n",
              known ? outcomes[outcome].class : "v-nodata",
              known ? outcomes[outcome].text : "not tested");
    if (!isnan(ratio.number.value) && !isnan(ratio.low)) {
        text_format(&page->out,
                    "<p class=\"number\">%s <span class=\"unit\">× predicted</span>"
                    "</p>\n<dl>\n",
                    NUMBER(ratio.number.value, 3));
        write_bar(page, "95 % interval", "interval", &ratio, ratio.low, ratio.high);
        text_add(&page->out, "</dl>\n");
    }
    const char *const settled = validation_key_text(v, VALIDATION_KEY_SETTLED_BY),
                      *const verdict = validation_key_text(v, VALIDATION_KEY_VERDICT);
    if (verdict != NULL)
        page_reason(page, verdict);
    if (settled != NULL) {
        text_add(&page->out, "<p class=\"widest\">How to decide it: ");
        text_typographic(&page->out, settled);
        text_add(&page->out, "</p>\n");
    }
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
    const bool validation_first = findings[FINDING_TRACK_DIFFERS].verdict == FINDING_NOT_COMPUTED;
    if (validation_first)
        write_validation_card(page);
    /* an answer that is there comes before one that is not */
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        if (findings[i].verdict != FINDING_NOT_COMPUTED)
            write_card(page, &findings[i]);
    if (!validation_first)
        write_validation_card(page);
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        if (findings[i].verdict == FINDING_NOT_COMPUTED)
            write_card(page, &findings[i]);
    text_add(&page->out, "</div>\n");
}
