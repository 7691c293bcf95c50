/* The tables of results on the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include <math.h>
#include <string.h>

/* Columns, in another order than that of the table or not shown as usual. */
static const page_column group_columns[] = {
    {.column = MODULUS_GROUPS_GROUP},
    {.column = MODULUS_GROUPS_N},
    {.column = MODULUS_GROUPS_N_REJECTED},
    {.column = MODULUS_GROUPS_N_SPOTS},
    {.column = MODULUS_GROUPS_GEOMETRIC_MEAN},
    {.column = MODULUS_GROUPS_LOW, .like = MODULUS_GROUPS_GEOMETRIC_MEAN},
    {.column = MODULUS_GROUPS_HIGH, .like = MODULUS_GROUPS_GEOMETRIC_MEAN},
    {.column = MODULUS_GROUPS_MEDIAN, .like = MODULUS_GROUPS_GEOMETRIC_MEAN},
    {.column = MODULUS_GROUPS_MEAN, .like = MODULUS_GROUPS_GEOMETRIC_MEAN},
    {.column = MODULUS_GROUPS_STANDARD_DEVIATION, .like = MODULUS_GROUPS_GEOMETRIC_MEAN},
};

static const page_column comparison_columns[] = {
    {.column = COMPARISON_RATE_LOW, .like = COMPARISON_RATE_HIGH, .missing = "all"},
    {.column = COMPARISON_RATE_HIGH, .missing = "all"},
    {.column = COMPARISON_N_BULK},
    {.column = COMPARISON_N_TRACK},
    {.column = COMPARISON_RATIO},
    {.column = COMPARISON_RATIO_LOW},
    {.column = COMPARISON_RATIO_HIGH},
    {.column = COMPARISON_DIFFERENCE},
    {.column = COMPARISON_WELCH_T},
    {.column = COMPARISON_WELCH_DF},
    {.column = COMPARISON_WELCH_P, .digits = 2},
    {.column = COMPARISON_HOLM_P, .digits = 2},
    {.column = COMPARISON_MANN_WHITNEY_P, .digits = 2},
    {.column = COMPARISON_EFFECT_SIZE},
};

static const page_column dma_columns[] = {
    {.column = DMA_COMPARISON_GROUP},
    {.column = DMA_COMPARISON_EQUIVALENT_FREQUENCY},
    {.column = DMA_COMPARISON_MODULUS},
    {.column = DMA_COMPARISON_LOW, .like = DMA_COMPARISON_MODULUS},
    {.column = DMA_COMPARISON_HIGH, .like = DMA_COMPARISON_MODULUS},
    {.column = DMA_COMPARISON_STORAGE_MODULUS, .like = DMA_COMPARISON_MODULUS},
    {.column = DMA_COMPARISON_COMPLEX_MODULUS, .like = DMA_COMPARISON_MODULUS},
    {.column = DMA_COMPARISON_RATIO},
    {.column = DMA_COMPARISON_EXTRAPOLATED},
};

static const page_column shift_columns[] = {
    {.column = SHIFT_FACTORS_TEMPERATURE, .decimals = 1},
    {.column = SHIFT_FACTORS_LOG_A, .decimals = 3},
    {.column = SHIFT_FACTORS_LOG_A_STANDARD_ERROR, .decimals = 3},
    {.column = SHIFT_FACTORS_WLF_LOG_A, .decimals = 3},
    {.column = SHIFT_FACTORS_LOG_B, .decimals = 3},
    {.column = SHIFT_FACTORS_LOG_B_STANDARD_ERROR, .decimals = 3},
    {.column = SHIFT_FACTORS_LOG_B_PHYSICAL, .decimals = 3},
    {.column = SHIFT_FACTORS_OVERLAP},
    {.column = SHIFT_FACTORS_DETERMINED},
    {.column = SHIFT_FACTORS_NOTE},
};

enum { HALF = 20, DECADES = 2 * HALF }; /* 1e-20 to 1e20 m/s, rounded */

/* Rows nearest to whole decades of the velocity, and the first and last one; *n of them. */
static void decade_rows(const table_view *table, size_t rows[DECADES + 3], size_t *n)
{
    size_t n_rows = table->n_rows, best[DECADES + 1];
    double distance[DECADES + 1];
    for (int i = 0; i <= DECADES; i++)
        distance[i] = (double)INFINITY;
    for (size_t row = 0; row < n_rows; row++) {
        double x = log10(friction_get(table, row, FRICTION_VELOCITY)), decade = round(x);
        if (!(fabs(decade) <= HALF))
            continue;
        int i = (int)decade + HALF;
        if (fabs(x - decade) < distance[i]) {
            distance[i] = fabs(x - decade);
            best[i] = row;
        }
    }
    *n = 0;
    rows[(*n)++] = 0;
    for (int i = 0; i <= DECADES; i++)
        if (isfinite(distance[i]) && best[i] != 0 && best[i] + 1 != n_rows)
            rows[(*n)++] = best[i];
    if (n_rows > 1)
        rows[(*n)++] = n_rows - 1;
}

static void friction_table(page_writer *page)
{
    const table_view *table = &page->tables->friction;
    if (table->n_rows == 0)
        return;
    size_t rows[DECADES + 3], n = 0;
    decade_rows(table, rows, &n);
    page_table(page, table,
               n < table->n_rows
                   ? "Friction at the computed velocities next to whole decades (± stat.: one "
                     "standard error, ± num.: numerical error); the result file holds all"
                   : "Friction at the computed velocities (± stat.: one standard error, "
                     "± num.: numerical error)",
               NULL, 0, rows, n);
}

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

void page_results(page_writer *page)
{
    const bound_tables *t = page->tables;
    const table_view *const shown[] = {&t->modulus_groups, &t->comparison, &t->dma_comparison,
                                       &t->shift_factors,  &t->prony,      &t->roughness,
                                       &t->friction,       &t->layer};
    bool any = false;
    for (size_t i = 0; i < COUNT(shown) && !any; i++)
        any = shown[i]->table != NULL;
    if (!any)
        return;
    page_heading(page, "tables", "Tables");
    page_whole_table(page, &t->modulus_groups, "Modulus by group", group_columns,
                     COUNT(group_columns));
    page_whole_table(page, &t->comparison,
                     "Wear track against bulk: ratio of geometric means, by indentation rate",
                     comparison_columns, COUNT(comparison_columns));
    page_whole_table(page, &t->dma_comparison,
                     "Indentation against DMA at the equivalent frequency", dma_columns,
                     COUNT(dma_columns));
    page_whole_table(page, &t->shift_factors, "Shift factors", shift_columns, COUNT(shift_columns));
    page_keys(page, &t->shift_factors, "Shifting and WLF constants");
    page_whole_table(page, &t->prony, "Prony series at the reference temperature", NULL, 0);
    page_keys(page, &t->prony, "Prony series: constants");
    page_keys(page, &t->roughness, "Counter surface");
    friction_table(page);
    page_keys(page, &t->friction, "Conditions of the friction");
    page_keys(page, &t->layer, "Balance of the modified layer");
}

/* ---- curves without a modulus ---------------------------------------------------------------- */

static void rejected_of(page_writer *page, const table_view *table)
{
    enum { SHOWN = 200 };
    size_t rows[SHOWN], n = 0, rejected = 0;
    for (size_t row = 0; row < table->n_rows; row++) {
        if (strcmp(indentation_text(table, row, INDENTATION_VERDICT), "accepted") == 0)
            continue;
        if (n < SHOWN)
            rows[n++] = row;
        rejected++;
    }
    growing_text caption = {0};
    text_format(&caption, "%s: %zu of %zu curves rejected", table->suffix, rejected, table->n_rows);
    if (rejected > n)
        text_format(&caption, ", the first %zu; the result file holds all", n);
    if (n == 0) {
        text_add(&page->out, "<p>");
        text_html(&page->out, text_string(&caption));
        text_add(&page->out, ".</p>\n");
    } else
        page_table(page, table, text_string(&caption), NULL, 0, rows, n);
    text_done(&caption, &page->out);
}

void page_indentation(page_writer *page)
{
    for (size_t i = 0; i < page->tables->n_indentation; i++) {
        const table_view *table = &page->tables->indentation[i];
        growing_text caption = {0};
        if (i == 0)
            page_heading(page, "indentation", "Indentation record");
        rejected_of(page, table);
        text_format(&caption, "%s: how it was indented", table->suffix);
        page_keys(page, table, text_string(&caption));
        text_done(&caption, &page->out);
    }
}
