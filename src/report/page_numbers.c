/* Writes the main numbers of the sections with their intervals.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/math/students_t.h"
#include "core/table/result_value.h"

#include <math.h>

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
    page_number(page, f.words, &f, text_string(&remark));
    text_free(&remark);
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
        text_format(&remark, "geometric mean; %.0f curves on %.0f %s, %.0f rejected%s%s",
                    modulus_groups_get(table, row, MODULUS_GROUPS_N), n_spots,
                    n_spots == 1 ? "spot" : "spots",
                    modulus_groups_get(table, row, MODULUS_GROUPS_N_REJECTED),
                    isnan(f.low) ? "" : "; by ", isnan(f.low) ? "" : f.includes);
        f.number.numerical_error = 0;
        page_number(page, text_string(&name), &f, text_string(&remark));
        text_free(&name);
        text_free(&remark);
    }
}

/* A number without a range over model choices, with the 95 % interval of its normal error. */
static result_value normal_value(const wt_estimate *estimate, wt_quantity quantity)
{
    const double half = NORMAL_95 * estimate->standard_error, none = (double)NAN;
    const bool known = half > 0 && isfinite(half);
    return (result_value){.quantity = quantity,
                          .number = *estimate,
                          .low = known ? estimate->value - half : none,
                          .high = known ? estimate->value + half : none,
                          .neutral = none,
                          .range = {.low = none, .high = none}};
}

enum { EVERY_KEY = SCHEMA_FIELDS_MAX };

/* Writes the main keys of a table; the remark belongs to the key `remarked` or to every key. */
static void headline_rows(page_writer *page, const result_value_tables *found,
                          const table_view *table, unsigned remarked, const char *remark)
{
    for (unsigned i = 0; i < table->schema->n_keys; i++) {
        const schema_field *key = &table->schema->keys[i];
        const wt_estimate estimate = view_key(table, table->schema, i);
        if (key->headline == NULL || isnan(estimate.value))
            continue;
        result_value f;
        if (!result_value_from_key(found, key, &f))
            f = normal_value(&estimate, key->quantity);
        page_number(page, key->headline, &f, remarked == EVERY_KEY || remarked == i ? remark : "");
    }
}

/* Writes the numbers at the reference velocity. */
static void write_reference_rows(page_writer *page, const result_value_tables *found)
{
    const table_view *table = &page->tables->friction;
    headline_rows(page, found, table, EVERY_KEY, "");
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
    const result_value f = normal_value(&estimate, WT_Q_NONE);
    page_number(page, "Friction coefficient, largest", &f, text_string(&remark));
    text_free(&remark);
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
    text_free(&remark);
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
    text_free(&remark);
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
    text_buffer caption = {0};
    text_add(&caption, "Main numbers");
    if (section == SECTION_FRICTION)
        text_format(&caption, " at %s",
                    VALUE(WT_Q_VELOCITY, NULL,
                          friction_value(&t->friction, FRICTION_KEY_REFERENCE_VELOCITY).value));
    page_numbers_begin(page, text_string(&caption));
    text_free(&caption);
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
