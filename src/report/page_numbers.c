/* The headline numbers of the page: the few values a reader looks for, with both errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include <math.h>

/* An interval as statistical error: "0.59 to 0.69 MPa (95 % interval)". */
static void interval_row(page_writer *page, const char *name, wt_quantity quantity, double value,
                         double low, double high, const char *remark)
{
    growing_text interval = {0};
    const wt_estimate estimate = {value, (high - low) / 4, 0, wt_quantity_unit(quantity)};
    if (isfinite(low) && isfinite(high)) {
        lab_unit lab = lab_unit_for(quantity, NULL, value);
        text_format(&interval, "%s to %s%s%s (95 %% interval)", NUMBER(lab_value(&lab, low), 3),
                    NUMBER(lab_value(&lab, high), 3), lab.label[0] != '\0' ? " " : "", lab.label);
    } else
        text_add(&interval, "not known");
    page_estimate(page, name, &estimate, quantity, text_string(&interval), remark);
    text_done(&interval, &page->out);
}

/* The row over all rates has no limits of the rate. */
static void ratio_row(page_writer *page)
{
    const table_view *table = &page->tables->comparison;
    const char *unit = comparison_words(table, COMPARISON_KEY_UNIT_OF_ANALYSIS);
    for (size_t row = 0; row < table->n_rows; row++) {
        double ratio = comparison_get(table, row, COMPARISON_RATIO);
        if (!isnan(comparison_get(table, row, COMPARISON_RATE_LOW)) || !isfinite(ratio))
            continue;
        growing_text remark = {0};
        text_format(&remark, "geometric means; n = %s in the track, %s in the bulk",
                    FIXED(comparison_get(table, row, COMPARISON_SPOTS_TRACK), 0),
                    FIXED(comparison_get(table, row, COMPARISON_SPOTS_BULK), 0));
        if (unit != NULL)
            text_format(&remark, ", unit of analysis: %s", unit);
        interval_row(page, "Modulus, track over bulk", WT_Q_NONE, ratio,
                     comparison_get(table, row, COMPARISON_RATIO_LOW),
                     comparison_get(table, row, COMPARISON_RATIO_HIGH), text_string(&remark));
        text_done(&remark, &page->out);
        return;
    }
}

static void group_rows(page_writer *page)
{
    const table_view *table = &page->tables->modulus_groups;
    for (size_t row = 0; row < table->n_rows; row++) {
        double mean = modulus_groups_get(table, row, MODULUS_GROUPS_GEOMETRIC_MEAN);
        if (!isfinite(mean))
            continue;
        growing_text name = {0}, remark = {0};
        text_format(&name, "Modulus, %s", modulus_groups_text(table, row, MODULUS_GROUPS_GROUP));
        const double n_spots = modulus_groups_get(table, row, MODULUS_GROUPS_N_SPOTS);
        text_format(&remark, "geometric mean; %.0f curves on %.0f spot%s, %.0f rejected",
                    modulus_groups_get(table, row, MODULUS_GROUPS_N), n_spots,
                    n_spots == 1 ? "" : "s",
                    modulus_groups_get(table, row, MODULUS_GROUPS_N_REJECTED));
        interval_row(page, text_string(&name), WT_Q_MODULUS, mean,
                     modulus_groups_get(table, row, MODULUS_GROUPS_LOW),
                     modulus_groups_get(table, row, MODULUS_GROUPS_HIGH), text_string(&remark));
        text_done(&name, &page->out);
        text_done(&remark, &page->out);
    }
}

enum { EVERY_KEY = SCHEMA_MOST };

/* How far a headline moves with the model, behind its remark. */
static void model_remark(page_writer *page, const schema_field *key, growing_text *remark)
{
    static const struct {
        const table_schema *table;
        unsigned headline;
        what_if_key range;
    } ranges[] = {{&friction_schema, FRICTION_KEY_FRICTION, WHAT_IF_KEY_FRICTION},
                  {&friction_schema, FRICTION_KEY_HYSTERESIS, WHAT_IF_KEY_HYSTERESIS},
                  {&friction_schema, FRICTION_KEY_AREA_RATIO, WHAT_IF_KEY_AREA_RATIO},
                  {&friction_schema, FRICTION_KEY_WITH_LAYER, WHAT_IF_KEY_WITH_LAYER},
                  {&layer_schema, LAYER_KEY_BALANCE_THICKNESS, WHAT_IF_KEY_THICKNESS}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const char *words = what_if_words(&page->tables->what_if, ranges[i].range);
        if (key == &ranges[i].table->keys[ranges[i].headline] && words != NULL)
            text_format(remark, "%s%s", remark->length > 0 ? "; " : "", words);
    }
}

/* The keys of a table that are headlines; the remark belongs to one of them or to every one. */
static void headline_rows(page_writer *page, const table_view *table, unsigned remarked,
                          const char *remark)
{
    for (unsigned i = 0; i < table->schema->n_keys; i++) {
        const schema_field *key = &table->schema->keys[i];
        const wt_estimate estimate = view_key(table, table->schema, i);
        if (key->headline == NULL || isnan(estimate.value))
            continue;
        growing_text words = {0};
        text_add(&words, remarked == EVERY_KEY || remarked == i ? remark : "");
        model_remark(page, key, &words);
        page_estimate(page, key->headline, &estimate, key->quantity, NULL, text_string(&words));
        text_done(&words, &page->out);
    }
}

/* At the velocity that the answer is given for. */
static void reference_rows(page_writer *page)
{
    const table_view *table = &page->tables->friction;
    growing_text remark = {0};
    text_format(
        &remark, "at the reference velocity, %s",
        VALUE(WT_Q_VELOCITY, NULL, friction_value(table, FRICTION_KEY_REFERENCE_VELOCITY).value));
    headline_rows(page, table, EVERY_KEY, text_string(&remark));
    text_done(&remark, &page->out);
}

static void largest_row(page_writer *page)
{
    const table_view *table = &page->tables->friction;
    size_t best = table->n_rows;
    for (size_t row = 0; row < table->n_rows; row++) {
        double friction = friction_get(table, row, FRICTION_TOTAL);
        if (isfinite(friction) &&
            (best == table->n_rows || friction > friction_get(table, best, FRICTION_TOTAL)))
            best = row;
    }
    if (best == table->n_rows)
        return;
    growing_text remark = {0};
    double share = friction_get(table, best, FRICTION_EXTRAPOLATED_SHARE);
    text_format(&remark, "at %s",
                VALUE(WT_Q_VELOCITY, NULL, friction_get(table, best, FRICTION_VELOCITY)));
    if (share >= 1e-3)
        text_format(&remark, "; %s %% from frequencies outside the measured ones",
                    NUMBER(100 * share, 2));
    const wt_estimate estimate = {friction_get(table, best, FRICTION_TOTAL),
                                  friction_get(table, best, FRICTION_TOTAL_STANDARD_ERROR),
                                  friction_get(table, best, FRICTION_TOTAL_NUMERICAL_ERROR), "1"};
    page_estimate(page, "Friction coefficient, largest", &estimate, WT_Q_NONE, NULL,
                  text_string(&remark));
    text_done(&remark, &page->out);
}

/* The constants of the material, and whether they mean anything. */
static void law_rows(page_writer *page)
{
    const table_view *table = &page->tables->shift_factors;
    if (table->table == NULL)
        return;
    growing_text remark = {0};
    text_format(&remark, "correlated with C₂, see the table of constants; superposition: %s",
                shift_factors_words(table, SHIFT_FACTORS_KEY_SUPERPOSITION));
    headline_rows(page, table, SHIFT_FACTORS_KEY_WLF_C1, text_string(&remark));
    text_done(&remark, &page->out);
}

static void transition_rows(page_writer *page)
{
    const table_view *table = &page->tables->glass_transition;
    if (table->table == NULL)
        return;
    const wt_estimate frequency =
        glass_transition_value(table, GLASS_TRANSITION_KEY_ANGULAR_FREQUENCY);
    growing_text remark = {0};
    text_format(&remark, "at %s", VALUE(WT_Q_ANGULAR_FREQUENCY, NULL, frequency.value));
    headline_rows(page, table, EVERY_KEY, text_string(&remark));
    text_done(&remark, &page->out);
}

void page_numbers(page_writer *page)
{
    const bound_tables *t = page->tables;
    if (t->comparison.table == NULL && t->modulus_groups.table == NULL &&
        t->shift_factors.table == NULL && t->glass_transition.table == NULL &&
        t->friction.table == NULL && t->layer.table == NULL)
        return;
    page_heading(page, "numbers", "Numbers");
    page_estimates_begin(page,
                         "Main results. Statistical error: one standard error, or the "
                         "interval stated; numerical error: of the computation",
                         true);
    ratio_row(page);
    group_rows(page);
    law_rows(page);
    transition_rows(page);
    reference_rows(page);
    largest_row(page);
    headline_rows(page, &t->layer, LAYER_KEY_BALANCE_THICKNESS,
                  "where formation and wear are equally fast");
    page_table_end(page);
}
