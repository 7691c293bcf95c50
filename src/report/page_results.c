/* Writes the result tables on the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"

#include "core/base/array.h"

#include <math.h>
#include <string.h>

/* Columns in another order than in the table. */
static const unsigned group_columns[] = {
    MODULUS_GROUPS_GROUP,          MODULUS_GROUPS_N,
    MODULUS_GROUPS_N_REJECTED,     MODULUS_GROUPS_N_SPOTS,
    MODULUS_GROUPS_GEOMETRIC_MEAN, MODULUS_GROUPS_LOW,
    MODULUS_GROUPS_HIGH,           MODULUS_GROUPS_MEDIAN,
    MODULUS_GROUPS_MEAN,           MODULUS_GROUPS_STANDARD_DEVIATION};
static const unsigned shift_columns[] = {SHIFT_FACTORS_TEMPERATURE,
                                         SHIFT_FACTORS_LOG_A,
                                         SHIFT_FACTORS_LOG_A_STANDARD_ERROR,
                                         SHIFT_FACTORS_LAW_LOG_A,
                                         SHIFT_FACTORS_LOG_B,
                                         SHIFT_FACTORS_LOG_B_STANDARD_ERROR,
                                         SHIFT_FACTORS_LOG_B_PHYSICAL,
                                         SHIFT_FACTORS_OVERLAP,
                                         SHIFT_FACTORS_DETERMINED,
                                         SHIFT_FACTORS_NOTE};

enum { HALF = 20, DECADES = 2 * HALF + 1 }; /* 1e-20 to 1e20 m/s, rounded */

/* Returns the number of the decade nearest to a velocity, -1 outside of the range above. */
static int nearest_decade(double velocity, double *distance)
{
    double x = log10(velocity), decade = round(x);
    *distance = fabs(x - decade);
    return fabs(decade) <= HALF ? (int)decade + HALF : -1;
}

/* Selects the first and the last row, and the row nearest to each whole decade of velocity. */
static size_t select_decade_rows(const table_view *table, size_t rows[DECADES + 2])
{
    double nearest[DECADES], distance = 0;
    size_t n = 0;
    for (int i = 0; i < DECADES; i++)
        nearest[i] = (double)INFINITY;
    for (size_t row = 0; row < table->n_rows; row++) {
        int i = nearest_decade(friction_get(table, row, FRICTION_VELOCITY), &distance);
        if (i >= 0)
            nearest[i] = fmin(nearest[i], distance);
    }
    for (size_t row = 0; row < table->n_rows; row++) {
        int i = nearest_decade(friction_get(table, row, FRICTION_VELOCITY), &distance);
        bool is_nearest = i >= 0 && distance <= nearest[i];
        if (is_nearest)
            nearest[i] = -1; // selects the first of several
        if (is_nearest || row == 0 || row + 1 == table->n_rows)
            rows[n++] = row;
    }
    return n;
}

static void write_friction_table(page_writer *page)
{
    const table_view *table = &page->tables->friction;
    if (table->n_rows == 0)
        return;
    size_t rows[DECADES + 2];
    const size_t n = select_decade_rows(table, rows);
    page_table(page, table,
               n < table->n_rows ? "Friction at the computed velocities next to whole decades; the "
                                   "result file holds all"
                                 : "Friction at the computed velocities",
               NULL, 0, rows, n);
}

/* Parts of the page in their order; missing tables are skipped. */
static const struct result_part {
    size_t view;
    const char *caption;
    bool keys;               /* true: keys of the table; false: its rows */
    const unsigned *columns; /* NULL: all */
    size_t n_columns;
    void (*write)(page_writer *page); /* writes the part instead of all rows */
} result_parts[] = {
#define ROWS(table, words)                                                                         \
    {                                                                                              \
        offsetof(figure_tables, table), words, false, NULL, 0, NULL                                \
    }
#define KEYS(table, words)                                                                         \
    {                                                                                              \
        offsetof(figure_tables, table), words, true, NULL, 0, NULL                                 \
    }
#define COLUMNS(table, words, list)                                                                \
    {                                                                                              \
        offsetof(figure_tables, table), words, false, list, COUNT_OF(list), NULL                   \
    }
    COLUMNS(modulus_groups, "Modulus by group", group_columns),
    ROWS(modulus_budget, "Error of the modulus by group"),
    ROWS(modulus_depth, "Modulus against depth, of all curves of a group"),
    ROWS(comparison, "Wear track against bulk: ratio of geometric means, by indentation rate"),
    KEYS(comparison, "Wear track against bulk: what was compared"),
    KEYS(track_layer, "Thickness of the layer by the curves"),
    ROWS(dma_comparison, "Indentation against DMA at the equivalent frequency"),
    ROWS(collection, "Cases, by sample and condition"),
    ROWS(ratio_pairs, "Modulus ratios of cases of one sample or condition against one another"),
    KEYS(ratio_pairs, "Modulus ratios against one another: what was compared"),
    COLUMNS(shift_factors, "Shift factors", shift_columns),
    KEYS(shift_factors, "Shifting, law and superposition"),
    ROWS(influences, "Influence of each isotherm: changes if it is left out"),
    KEYS(influences, "Influence of each isotherm: reference"),
    ROWS(prony, "Prony series at the reference temperature"),
    KEYS(prony, "Prony series: constants"),
    ROWS(prony_reduced, "Prony series with few terms, for finite elements"),
    KEYS(prony_reduced, "Prony series with few terms: constants and deviation"),
    ROWS(glass_transition, "Glass transition: temperatures of the peaks at each frequency"),
    KEYS(glass_transition, "Glass transition: where"),
    ROWS(moduli_at, "Moduli at temperatures"),
    ROWS(payne, "Softening with strain (Payne effect)"),
    KEYS(roughness, "Counter surface"),
    {offsetof(figure_tables, friction), NULL, false, NULL, 0, write_friction_table},
    KEYS(friction, "Conditions of the friction"),
    ROWS(record, "Friction as measured, by the steps of the records"),
    ROWS(wear, "Wear as measured"),
    KEYS(validation, "Measured against predicted friction"),
    ROWS(validation, "Measured against predicted friction, by the steps of the records"),
    KEYS(validation_running_in, "Measured running-in against the layer"),
    ROWS(validation_running_in, "Running-in against the layer, by the records"),
    KEYS(validation_sources, "What would narrow measured over predicted most"),
    ROWS(validation_sources, "Where the error of measured over predicted comes from"),
    KEYS(transverse_isotropy, "What the directions of the material do"),
    KEYS(softening, "What softening with strain does"),
    KEYS(flash, "What the flash temperature does"),
    KEYS(friction_decades, "Which length scales make the friction"),
    KEYS(layer, "Balance of the modified layer"),
    KEYS(identification, "Critical energy and wear rate of the layer that is seen"),
    ROWS(identification, "Critical energy and wear rate, by what is known"),
    ROWS(what_if, "What if: one choice of the model moved in each row, and the relative changes "
                  "by it, at the reference velocity"),
    KEYS(what_if, "What if: what was not tried"),
    KEYS(error_budget, "Where the errors come from"),
    ROWS(error_budget, "Error budget: what each source alone does to the numbers at the reference "
                       "velocity, and the time it takes to know it"),
    KEYS(work_precision, "What more work buys"),
    ROWS(work_precision, "Error against run time"),
};

static const table_view *result_part_view(const page_writer *page, const struct result_part *part)
{
    return (const table_view *)(const void *)((const char *)page->tables + part->view);
}

static void write_part(page_writer *page, const struct result_part *part)
{
    const table_view *const view = result_part_view(page, part);
    if (part->write != NULL)
        part->write(page);
    else if (part->keys)
        page_keys(page, view, part->caption);
    else
        page_whole_table(page, view, part->caption, part->columns, part->n_columns);
}

void page_results(page_writer *page)
{
    bool any = false;
    for (size_t i = 0; i < COUNT_OF(result_parts) && !any; i++)
        any = result_part_view(page, &result_parts[i])->table != NULL;
    if (!any)
        return;
    page_fold(page, "tables", "Tables", PAGE_PRINTED);
    for (size_t i = 0; i < COUNT_OF(result_parts); i++)
        write_part(page, &result_parts[i]);
    page_fold_end(page);
}

/* ---- curves without a modulus, or with a wide or doubtful one ------------------------------- */

static void write_rejected_curves(page_writer *page, const table_view *table)
{
    enum { SHOWN = 200 };
    size_t rows[SHOWN], n = 0, others = 0, wide = 0, doubtful = 0;
    for (size_t row = 0; row < table->n_rows; row++) {
        const wt_curve_verdict verdict =
            (wt_curve_verdict)indentation_enum(table, row, INDENTATION_VERDICT);
        if (verdict == WT_CURVE_ACCEPTED)
            continue;
        wide += verdict == WT_CURVE_WIDE;
        doubtful += verdict == WT_CURVE_DOUBTFUL;
        if (n < SHOWN)
            rows[n++] = row;
        others++;
    }
    text_buffer caption = {0};
    text_format(&caption, "%s: %zu curves, %zu wide, %zu doubtful, %zu rejected", table->suffix,
                table->n_rows, wide, doubtful, others - wide - doubtful);
    if (others > n)
        text_format(&caption, ", the first %zu; the result file holds all", n);
    if (n == 0)
        text_html(&page->out, "<p>%s.</p>\n", text_string(&caption));
    else
        page_table(page, table, text_string(&caption), NULL, 0, rows, n);
    text_free(&caption);
}

void page_indentation(page_writer *page)
{
    for (size_t i = 0; i < page->tables->n_indentation; i++) {
        const table_view *table = &page->tables->indentation[i];
        text_buffer caption = {0};
        if (i == 0)
            page_fold(page, "indentation-record", "Curves", PAGE_UNPRINTED);
        write_rejected_curves(page, table);
        text_format(&caption, "%s: how it was indented", table->suffix);
        page_keys(page, table, text_string(&caption));
        text_free(&caption);
    }
    if (page->tables->n_indentation > 0)
        page_fold_end(page);
}
