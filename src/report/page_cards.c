/* Writes the findings as cards at the top of the page. The cards format the list of findings and
 * compute only the positions of the bars. SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/base/array.h"
#include "core/table/finding.h"

#include <math.h>
#include <string.h>

/* A ratio without a unit that has the neutral value 0 is a relative change and shown in percent. */
display_unit select_finding_unit(const result_value *f)
{
    if (f->neutral == 0)
        return (display_unit){.factor = 100, .offset = 0, .label = "%"};
    return select_display_unit(f->quantity, f->number.unit, f->number.value);
}

/* Limits of the axis of a bar: all numbers of the card, with a margin. */
static void bar_axis(const result_value *f, double *low, double *high)
{
    const double ends[] = {f->number.value, f->low,        f->high,
                           f->range.low,    f->range.high, f->neutral};
    *low = *high = f->number.value;
    for (size_t i = 0; i < COUNT_OF(ends); i++) {
        *low = fmin(*low, ends[i]); /* fmin and fmax ignore NaN */
        *high = fmax(*high, ends[i]);
    }
    const double margin = *high > *low ? 0.05 * (*high - *low) : 1;
    *low -= margin;
    *high += margin;
}

/* Writes one bar with its limits; nothing if these or the value are not finite. */
static void write_bar(page_writer *page, const char *name, const char *class, const result_value *f,
                      double low, double high)
{
    double left = 0, right = 0;
    if (!isfinite(low) || !isfinite(high) || !isfinite(f->number.value))
        return;
    const display_unit lab = select_finding_unit(f);
    const int digits = result_value_digits(f->number.value, low, high);
    bar_axis(f, &left, &right);
    text_html(&page->out, "<div><dt>%s</dt><dd class=\"limits\">", name);
    text_format(&page->out, "%s to %s", NUMBER(to_display_value(&lab, low), digits),
                NUMBER(to_display_value(&lab, high), digits));
    text_format(&page->out, "%s%s</dd><dd class=\"bar\" aria-hidden=\"true\">",
                lab.label[0] != '\0' ? " " : "", lab.label);
    if (!isnan(f->neutral))
        text_format(&page->out, "<i class=\"neutral\" style=\"left:%s%%\"></i>",
                    FIXED(100 * (f->neutral - left) / (right - left), 1));
    text_format(&page->out, "<i class=\"%s\" style=\"left:%s%%;width:%s%%\"></i>", class,
                FIXED(100 * (low - left) / (right - left), 1),
                FIXED(100 * (high - low) / (right - left), 1));
    text_add(&page->out, "</dd></div>\n");
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
                    f->question == FINDING_TRACK_DIFFERS ? "modulus of the track over bulk"
                                                         : lab.label);
        write_bar(page, "95 % interval", "interval", value, value->low, value->high);
        write_bar(page, "Model choices", "choices", value, value->range.low, value->range.high);
        text_add(&page->out, "</dl>\n");
    }
    /* a run states why a number is missing */
    const table_view *const answer = &page->tables->answer;
    const bool stated = f->verdict == FINDING_NOT_COMPUTED && findings_are_stated(answer);
    text_html(&page->out, "<p>%s%s</p>\n",
              stated ? answer_text(answer, f->question, ANSWER_ANSWER) : f->sentence,
              f->as_if_layer && !isnan(value->number.value)
                  ? " The track is not shown to differ: the number is as if there were a layer."
                  : "");
    if (value->range.widest != NULL)
        text_html(&page->out, "<p class=\"widest\">Widest model choice: %s.</p>\n",
                  value->range.widest);
    text_html(&page->out, "<p><a href=\"#%s\">Why</a></p>\n",
              f->question == FINDING_TRACK_DIFFERS     ? "indentation"
              : f->question == FINDING_LAYER_THICKNESS ? "layer"
                                                       : "friction");
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
    for (size_t i = 0; i < FINDING_QUESTIONS; i++)
        write_card(page, &findings[i]);
    text_add(&page->out, "</div>\n");
}
