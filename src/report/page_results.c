/* The tables of results on the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include "base/array.h"

#include <math.h>
#include <string.h>

/* Columns in another order than that of the table. */
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

/* Number of the decade nearest to a velocity, -1 beyond those above. */
static int nearest_decade(double velocity, double *distance)
{
    double x = log10(velocity), decade = round(x);
    *distance = fabs(x - decade);
    return fabs(decade) <= HALF ? (int)decade + HALF : -1;
}

/* The first and the last row, and the nearest one to each whole decade of the velocity. */
static size_t decade_rows(const table_view *table, size_t rows[DECADES + 2])
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
            nearest[i] = -1; // the first of several
        if (is_nearest || row == 0 || row + 1 == table->n_rows)
            rows[n++] = row;
    }
    return n;
}

static void friction_table(page_writer *page)
{
    const table_view *table = &page->tables->friction;
    if (table->n_rows == 0)
        return;
    size_t rows[DECADES + 2];
    const size_t n = decade_rows(table, rows);
    page_table(page, table,
               n < table->n_rows
                   ? "Friction at the computed velocities next to whole decades (± stat.: one "
                     "standard error, ± num.: numerical error); the result file holds all"
                   : "Friction at the computed velocities (± stat.: one standard error, "
                     "± num.: numerical error)",
               NULL, 0, rows, n);
}

void page_results(page_writer *page)
{
    const bound_tables *t = page->tables;
    const table_view *const shown[] = {&t->modulus_groups, &t->modulus_depth,  &t->comparison,
                                       &t->dma_comparison, &t->material_ratio, &t->shift_factors,
                                       &t->prony,          &t->prony_reduced,  &t->glass_transition,
                                       &t->moduli_at,      &t->payne,          &t->roughness,
                                       &t->friction,       &t->layer,          &t->what_if,
                                       &t->error_budget,   &t->coverage,       &t->work_precision,
                                       &t->directions,     &t->softening,      &t->common_law,
                                       &t->modulus_budget, &t->record,         &t->wear,
                                       &t->anisotropy,     &t->friction_map,   &t->friction_decades,
                                       &t->flash,          &t->collection,     &t->ratio_pairs,
                                       &t->validation,     &t->layer_bands,    &t->running_in,
                                       &t->layer_balances, &t->existence};
    bool any = false;
    for (size_t i = 0; i < COUNT_OF(shown) && !any; i++)
        any = shown[i]->table != NULL;
    if (!any)
        return;
    page_fold(page, "tables", "Tables", PAGE_PRINTED);
    page_whole_table(page, &t->modulus_groups, "Modulus by group", group_columns,
                     COUNT_OF(group_columns));
    page_whole_table(page, &t->modulus_budget, "Error of the modulus by group", NULL, 0);
    page_whole_table(page, &t->modulus_depth, "Modulus against depth, of all curves of a group",
                     NULL, 0);
    page_whole_table(page, &t->comparison,
                     "Wear track against bulk: ratio of geometric means, by indentation rate", NULL,
                     0);
    page_keys(page, &t->comparison, "Wear track against bulk: what was compared");
    page_whole_table(page, &t->dma_comparison,
                     "Indentation against DMA at the equivalent frequency", NULL, 0);
    page_whole_table(page, &t->collection, "Cases, by sample and condition", NULL, 0);
    page_whole_table(page, &t->ratio_pairs,
                     "Modulus ratios of cases of one sample or condition against one another", NULL,
                     0);
    page_keys(page, &t->ratio_pairs, "Modulus ratios against one another: what was compared");
    page_keys(page, &t->material_ratio, "Materials: what was compared");
    page_whole_table(page, &t->shift_factors, "Shift factors", shift_columns,
                     COUNT_OF(shift_columns));
    page_keys(page, &t->shift_factors, "Shifting, law and superposition");
    page_keys(page, &t->common_law, "One law for several samples");
    page_whole_table(page, &t->prony, "Prony series at the reference temperature", NULL, 0);
    page_keys(page, &t->prony, "Prony series: constants");
    page_whole_table(page, &t->prony_reduced, "Prony series with few terms, for finite elements",
                     NULL, 0);
    page_keys(page, &t->prony_reduced, "Prony series with few terms: constants, what it is off");
    page_whole_table(page, &t->glass_transition,
                     "Glass transition: temperatures of the peaks at each frequency", NULL, 0);
    page_keys(page, &t->glass_transition, "Glass transition: where");
    page_whole_table(page, &t->moduli_at, "Moduli at temperatures", NULL, 0);
    page_whole_table(page, &t->payne, "Softening with strain (Payne effect)", NULL, 0);
    page_keys(page, &t->roughness, "Counter surface");
    friction_table(page);
    page_keys(page, &t->friction, "Conditions of the friction");
    page_whole_table(page, &t->record, "Friction as measured, by the steps of the records", NULL,
                     0);
    page_whole_table(page, &t->wear, "Wear as measured", NULL, 0);
    page_keys(page, &t->validation, "Measured against predicted friction");
    page_whole_table(page, &t->validation,
                     "Measured against predicted friction, by the steps of the records", NULL, 0);
    page_keys(page, &t->validation_sources, "What would narrow measured over predicted most");
    page_whole_table(page, &t->validation_sources,
                     "Where the error of measured over predicted comes from", NULL, 0);
    page_keys(page, &t->validation_choices, "Choices of the model, by the record");
    page_whole_table(page, &t->validation_choices,
                     "What the record says of each choice of the model", NULL, 0);
    page_keys(page, &t->directions, "What the directions of the material do");
    page_keys(page, &t->softening, "What softening with strain does");
    page_keys(page, &t->flash, "What the flash temperature does");
    page_keys(page, &t->anisotropy, "What the direction of sliding does");
    page_keys(page, &t->friction_map, "Friction at several temperatures and pressures");
    page_keys(page, &t->friction_decades, "Which length scales make the friction");
    page_keys(page, &t->layer, "Balance of the modified layer");
    page_keys(page, &t->layer_bands, "Modified bands in time");
    page_keys(page, &t->running_in, "Friction with the layer in running-in");
    page_keys(page, &t->layer_balances, "Balances of a layer that acts back on its energy");
    page_whole_table(page, &t->layer_balances, "Balances of a layer that acts back, and folds",
                     NULL, 0);
    page_keys(page, &t->existence, "Where a layer exists");
    page_whole_table(page, &t->what_if,
                     "What if: one choice of the model moved in each row, and the relative changes "
                     "by it, at the reference velocity",
                     NULL, 0);
    page_keys(page, &t->what_if, "What if: what was not tried");
    page_keys(page, &t->error_budget, "Where the errors come from");
    page_whole_table(page, &t->error_budget,
                     "Error budget: what each source alone does to the numbers at the reference "
                     "velocity, and the time it takes to know it",
                     NULL, 0);
    page_keys(page, &t->coverage, "How often the intervals hold");
    page_whole_table(page, &t->coverage,
                     "Coverage: the share of trials, drawn from the fit of the case, in which an "
                     "interval holds the truth",
                     NULL, 0);
    page_keys(page, &t->work_precision, "What more work buys");
    page_whole_table(page, &t->work_precision, "Error against run time", NULL, 0);
    page_fold_end(page);
}

/* ---- curves without a modulus, or with a doubtful one
 * ---------------------------------------------------------------- */

static void rejected_of(page_writer *page, const table_view *table)
{
    enum { SHOWN = 200 };
    size_t rows[SHOWN], n = 0, others = 0, doubtful = 0;
    for (size_t row = 0; row < table->n_rows; row++) {
        const char *verdict = indentation_text(table, row, INDENTATION_VERDICT);
        if (strcmp(verdict, "accepted") == 0)
            continue;
        doubtful += strcmp(verdict, "doubtful") == 0;
        if (n < SHOWN)
            rows[n++] = row;
        others++;
    }
    growing_text caption = {0};
    text_format(&caption, "%s: %zu of %zu curves doubtful, %zu rejected", table->suffix, doubtful,
                table->n_rows, others - doubtful);
    if (others > n)
        text_format(&caption, ", the first %zu; the result file holds all", n);
    if (n == 0)
        text_html(&page->out, "<p>%s.</p>\n", text_string(&caption));
    else
        page_table(page, table, text_string(&caption), NULL, 0, rows, n);
    text_done(&caption, &page->out);
}

void page_indentation(page_writer *page)
{
    for (size_t i = 0; i < page->tables->n_indentation; i++) {
        const table_view *table = &page->tables->indentation[i];
        growing_text caption = {0};
        if (i == 0)
            page_fold(page, "indentation", "Indentation record", PAGE_UNPRINTED);
        rejected_of(page, table);
        text_format(&caption, "%s: how it was indented", table->suffix);
        page_keys(page, table, text_string(&caption));
        text_done(&caption, &page->out);
    }
    if (page->tables->n_indentation > 0)
        page_fold_end(page);
}
