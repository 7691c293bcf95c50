/* Writes the main numbers of the page with both errors.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/table/result_value.h"

#include <math.h>

/* Adds "0.59 to 0.69 MPa" in the unit of the value. */
static void add_limits(text_buffer *text, const result_value *f, double low, double high,
                       int digits)
{
    display_unit lab = select_display_unit(f->quantity, f->number.unit, f->number.value);
    text_format(text, "%s to %s%s%s", NUMBER(to_display_value(&lab, low), digits),
                NUMBER(to_display_value(&lab, high), digits), lab.label[0] != '\0' ? " " : "",
                lab.label);
}

/* Writes a row with the interval as statistical error, and the range over the model choices at the
 * end of the remark. */
static void write_result_value_row(page_writer *page, const char *name, const result_value *f,
                                   text_buffer *remark)
{
    text_buffer interval = {0};
    const wt_estimate estimate = {f->number.value, (f->high - f->low) / 4,
                                  f->number.numerical_error, f->number.unit};
    if (isfinite(f->low) && isfinite(f->high)) {
        add_limits(&interval, f, f->low, f->high,
                   result_value_digits(f->number.value, f->low, f->high));
        text_add(&interval, " (95 % interval)");
    } else
        text_add(&interval, "not known");
    if (!isnan(f->range.low)) {
        text_add(remark, remark->length > 0 ? "; " : "");
        add_limits(remark, f, f->range.low, f->range.high, 3);
        text_add(remark, " over all choices of the model");
    }
    page_estimate(page, name, &estimate, f->quantity, text_string(&interval), text_string(remark));
    text_free_part(&interval, &page->out);
}

static void write_ratio_row(page_writer *page, const result_value_tables *found)
{
    const table_view *table = &found->comparison;
    result_value f = result_value_ratio(found);
    if (!isfinite(f.number.value))
        return;
    const char *unit = comparison_key_text(table, COMPARISON_KEY_UNIT_OF_ANALYSIS);
    text_buffer remark = {0};
    text_format(&remark, "geometric means; n = %s in the track, %s in the bulk",
                FIXED(comparison_get(table, 0, COMPARISON_SPOTS_TRACK), 0),
                FIXED(comparison_get(table, 0, COMPARISON_SPOTS_BULK), 0));
    if (unit != NULL)
        text_format(&remark, ", unit of analysis: %s", unit);
    f.number.numerical_error = 0;
    write_result_value_row(page, f.words, &f, &remark);
    text_free_part(&remark, &page->out);
}

static void write_group_rows(page_writer *page, const result_value_tables *found)
{
    const table_view *table = &found->groups;
    for (size_t row = 0; row < table->n_rows; row++) {
        result_value f = result_value_group(found, row);
        if (!isfinite(f.number.value))
            continue;
        text_buffer name = {0}, remark = {0};
        text_format(&name, "%s, %s", f.words,
                    modulus_groups_text(table, row, MODULUS_GROUPS_GROUP));
        const double n_spots = modulus_groups_get(table, row, MODULUS_GROUPS_N_SPOTS);
        text_format(&remark, "geometric mean; %.0f curves on %.0f %s, %.0f rejected; by %s",
                    modulus_groups_get(table, row, MODULUS_GROUPS_N), n_spots,
                    n_spots == 1 ? "spot" : "spots",
                    modulus_groups_get(table, row, MODULUS_GROUPS_N_REJECTED), f.includes);
        f.number.numerical_error = 0;
        write_result_value_row(page, text_string(&name), &f, &remark);
        text_free_part(&name, &page->out);
        text_free_part(&remark, &page->out);
    }
}

enum { EVERY_KEY = SCHEMA_FIELDS_MAX };

/* Writes the main keys of a table; the remark belongs to the key `remarked` or to every key. */
static void headline_rows(page_writer *page, const result_value_tables *found,
                          const table_view *table, unsigned remarked, const char *remark)
{
    for (unsigned i = 0; i < table->schema->n_keys; i++) {
        const schema_field *key = &table->schema->keys[i];
        const wt_estimate estimate = view_key(table, table->schema, i);
        result_value f;
        if (key->headline == NULL || isnan(estimate.value))
            continue;
        text_buffer words = {0};
        text_add(&words, remarked == EVERY_KEY || remarked == i ? remark : "");
        if (result_value_from_key(found, key, &f))
            write_result_value_row(page, key->headline, &f, &words);
        else
            page_estimate(page, key->headline, &estimate, key->quantity, NULL, text_string(&words));
        text_free_part(&words, &page->out);
    }
}

/* Writes the numbers at the reference velocity. */
static void write_reference_rows(page_writer *page, const result_value_tables *found)
{
    const table_view *table = &page->tables->friction;
    text_buffer remark = {0};
    text_format(
        &remark, "at the reference velocity, %s",
        VALUE(WT_Q_VELOCITY, NULL, friction_value(table, FRICTION_KEY_REFERENCE_VELOCITY).value));
    headline_rows(page, found, table, EVERY_KEY, text_string(&remark));
    text_free_part(&remark, &page->out);
}

static void write_largest_friction_row(page_writer *page)
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
    text_buffer remark = {0};
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
    text_free_part(&remark, &page->out);
}

/* Writes the constants of the shift law, with the verdict on superposition. */
static void write_law_rows(page_writer *page, const result_value_tables *found)
{
    const table_view *table = &page->tables->shift_factors;
    if (table->table == NULL)
        return;
    text_buffer remark = {0};
    text_format(&remark, "correlated with C₂, see the table of constants; superposition: %s",
                shift_factors_key_text(table, SHIFT_FACTORS_KEY_SUPERPOSITION));
    headline_rows(page, found, table, SHIFT_FACTORS_KEY_WLF_C1, text_string(&remark));
    text_free_part(&remark, &page->out);
}

static void write_transition_rows(page_writer *page, const result_value_tables *found)
{
    const table_view *table = &page->tables->glass_transition;
    if (table->table == NULL)
        return;
    const wt_estimate frequency =
        glass_transition_value(table, GLASS_TRANSITION_KEY_ANGULAR_FREQUENCY);
    text_buffer remark = {0};
    text_format(&remark, "at %s", VALUE(WT_Q_ANGULAR_FREQUENCY, NULL, frequency.value));
    headline_rows(page, found, table, EVERY_KEY, text_string(&remark));
    text_free_part(&remark, &page->out);
}

/* True if the result has a table with main numbers of the section. */
static bool has_numbers(const figure_tables *t, page_section section)
{
    switch (section) {
    case SECTION_INDENTATION:
        return t->comparison.table != NULL || t->modulus_groups.table != NULL;
    case SECTION_MATERIAL:
        return t->shift_factors.table != NULL || t->glass_transition.table != NULL;
    case SECTION_FRICTION:
        return t->friction.table != NULL;
    case SECTION_LAYER:
        return t->layer.table != NULL;
    default:
        return false;
    }
}

void page_numbers(page_writer *page, page_section section)
{
    const figure_tables *t = page->tables;
    result_value_tables found;
    if (!has_numbers(t, section) || result_values_bind(page->result, &found, NULL) != WT_OK)
        return; /* figure_tables_bind has reported this error */
    page_estimates_begin(page, "Main numbers; ±: one standard error", true);
    if (section == SECTION_INDENTATION) {
        write_ratio_row(page, &found);
        write_group_rows(page, &found);
    } else if (section == SECTION_MATERIAL) {
        write_law_rows(page, &found);
        write_transition_rows(page, &found);
    } else if (section == SECTION_FRICTION) {
        write_reference_rows(page, &found);
        write_largest_friction_row(page);
    } else
        headline_rows(page, &found, &t->layer, LAYER_KEY_BALANCE_THICKNESS,
                      "where formation and wear are equally fast");
    page_table_end(page);
}
