/* The tables of results on the page.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "report/page.h"

#include "report/cells.h"

#include <math.h>
#include <string.h>

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static void whole_table(page_writer *page, const char *name, const char *caption,
                        const page_column *columns, size_t n)
{
    const wt_table *table = wt_result_find(page->result, name);
    if (table != NULL && wt_table_n_rows(table) > 0)
        page_table(page, table, caption, columns, n, NULL, wt_table_n_rows(table));
}

static void keys_of(page_writer *page, const char *name, const char *caption)
{
    const wt_table *table = wt_result_find(page->result, name);
    if (table != NULL)
        page_keys(page, table, caption);
}

static const page_column group_columns[] = {
    {"group", "Group", NULL, NULL, false},
    {"n", "Curves n", NULL, NULL, false},
    {"n_rejected", "Rejected", NULL, NULL, false},
    {"n_spots", "Spots", NULL, NULL, false},
    {"geometric_mean", "Geometric mean", "geometric_mean", NULL, false},
    {"low", "95 % interval from", "geometric_mean", NULL, false},
    {"high", "to", "geometric_mean", NULL, false},
    {"median", "Median", "geometric_mean", NULL, false},
    {"mean", "Mean", "geometric_mean", NULL, false},
    {"standard_deviation", "Standard deviation", "geometric_mean", NULL, false},
};

static const page_column comparison_columns[] = {
    {"rate_low", "Indentation rate from", "rate_high", "all", false},
    {"rate_high", "to", NULL, "all", false},
    {"n_bulk", "n bulk", NULL, NULL, false},
    {"n_track", "n track", NULL, NULL, false},
    {"ratio", "Track / bulk", NULL, NULL, false},
    {"ratio_low", "95 % interval from", NULL, NULL, false},
    {"ratio_high", "to", NULL, NULL, false},
    {"difference", "Difference", NULL, NULL, false},
    {"welch_t", "Welch t", NULL, NULL, false},
    {"welch_df", "Degrees of freedom", NULL, NULL, false},
    {"welch_p", "p (Welch)", NULL, NULL, false},
    {"holm_p", "p (Holm)", NULL, NULL, false},
    {"mann_whitney_p", "p (Mann-Whitney)", NULL, NULL, false},
    {"effect_size", "Effect size", NULL, NULL, false},
};

static const page_column dma_columns[] = {
    {"group", "Group", NULL, NULL, false},
    {"equivalent_frequency", "Equivalent frequency", NULL, NULL, false},
    {"indentation_modulus", "Indentation", NULL, NULL, false},
    {"low", "95 % interval from", "indentation_modulus", NULL, false},
    {"high", "to", "indentation_modulus", NULL, false},
    {"dma_storage_modulus", "DMA E′", "indentation_modulus", NULL, false},
    {"dma_complex_modulus", "DMA |E*|", "indentation_modulus", NULL, false},
    {"ratio", "Indentation / DMA", NULL, NULL, false},
    {"extrapolated", "Outside measured frequencies", NULL, NULL, true},
};

static const page_column shift_columns[] = {
    {"temperature", "Temperature", NULL, NULL, false},
    {"log_a", "log₁₀ a", NULL, NULL, false},
    {"log_a_standard_error", "Standard error", NULL, NULL, false},
    {"wlf_log_a", "WLF log₁₀ a", NULL, NULL, false},
    {"log_b", "log₁₀ b", NULL, NULL, false},
    {"log_b_standard_error", "Standard error", NULL, NULL, false},
    {"log_b_physical", "log₁₀ b, rubber elasticity", NULL, NULL, false},
    {"overlap", "Overlap (decades)", NULL, NULL, false},
    {"determined", "Determined by overlap", NULL, NULL, true},
    {"note", "Note", NULL, NULL, false},
};

static const page_column prony_columns[] = {
    {"relaxation_time", "Relaxation time", NULL, NULL, false},
    {"modulus", "Modulus", NULL, NULL, false},
};

static const page_column friction_columns[] = {
    {"velocity", "Velocity", NULL, NULL, false},
    {"friction", "Total μ", NULL, NULL, false},
    {"friction_standard_error", "± stat.", NULL, NULL, false},
    {"friction_numerical_error", "± num.", NULL, NULL, false},
    {"hysteresis", "Hysteresis", NULL, NULL, false},
    {"hysteresis_standard_error", "± stat.", NULL, NULL, false},
    {"hysteresis_numerical_error", "± num.", NULL, NULL, false},
    {"adhesion", "Shearing", NULL, NULL, false},
    {"area_ratio", "A/A₀", NULL, NULL, false},
    {"area_ratio_standard_error", "± stat.", NULL, NULL, false},
    {"area_ratio_numerical_error", "± num.", NULL, NULL, false},
    {"friction_with_layer", "With layer", NULL, NULL, false},
    {"friction_with_layer_standard_error", "± stat.", NULL, NULL, false},
    {"extrapolated_share", "Outside measured frequencies, share", NULL, NULL, false},
};

enum { HALF = 20, DECADES = 2 * HALF }; /* 1e-20 to 1e20 m/s, rounded */

/* Rows nearest to whole decades of the velocity, and the first and last one; *n of them. */
static void decade_rows(const wt_table *table, size_t rows[DECADES + 3], size_t *n)
{
    size_t n_rows = wt_table_n_rows(table), best[DECADES + 1];
    double distance[DECADES + 1];
    for (int i = 0; i <= DECADES; i++)
        distance[i] = (double)INFINITY;
    for (size_t row = 0; row < n_rows; row++) {
        double x = log10(cell_number(table, row, "velocity")), decade = round(x);
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
    const wt_table *table = wt_result_find(page->result, "friction");
    if (table == NULL || wt_table_n_rows(table) == 0)
        return;
    size_t rows[DECADES + 3], n = 0;
    decade_rows(table, rows, &n);
    page_table(page, table,
               n < wt_table_n_rows(table)
                   ? "Friction at the computed velocities next to whole decades (± stat.: one "
                     "standard error, ± num.: numerical error); the result file holds all"
                   : "Friction at the computed velocities (± stat.: one standard error, "
                     "± num.: numerical error)",
               friction_columns, COUNT(friction_columns), rows, n);
}

void page_results(page_writer *page)
{
    static const char *const tables[] = {"modulus_groups", "comparison", "dma_comparison",
                                         "shift_factors",  "prony",      "roughness",
                                         "friction",       "layer"};
    bool any = false;
    for (size_t i = 0; i < COUNT(tables) && !any; i++)
        any = wt_result_find(page->result, tables[i]) != NULL;
    if (!any)
        return;
    page_heading(page, "tables", "Tables");
    whole_table(page, "modulus_groups", "Modulus by group", group_columns, COUNT(group_columns));
    whole_table(page, "comparison",
                "Wear track against bulk: ratio of geometric means, by indentation rate",
                comparison_columns, COUNT(comparison_columns));
    whole_table(page, "dma_comparison", "Indentation against DMA at the equivalent frequency",
                dma_columns, COUNT(dma_columns));
    whole_table(page, "shift_factors", "Shift factors", shift_columns, COUNT(shift_columns));
    keys_of(page, "shift_factors", "Shifting and WLF constants");
    whole_table(page, "prony", "Prony series at the reference temperature", prony_columns,
                COUNT(prony_columns));
    keys_of(page, "prony", "Prony series: constants");
    keys_of(page, "roughness", "Counter surface");
    friction_table(page);
    keys_of(page, "friction", "Conditions of the friction");
    keys_of(page, "layer", "Balance of the modified layer");
}

/* ---- curves without a modulus ---------------------------------------------------------------- */

static const page_column rejected_columns[] = {
    {"file", "File", NULL, NULL, false},
    {"curve", "Curve", NULL, NULL, false},
    {"spot", "Spot", NULL, NULL, false},
    {"reason", "Reason", NULL, NULL, false},
};

static void rejected_of(page_writer *page, const wt_table *table, const char *group)
{
    enum { SHOWN = 200 };
    size_t rows[SHOWN], n = 0, rejected = 0;
    if (text_column(table, "verdict") < 0)
        return;
    for (size_t row = 0; row < wt_table_n_rows(table); row++) {
        if (strcmp(cell_text(table, row, "verdict"), "accepted") == 0)
            continue;
        if (n < SHOWN)
            rows[n++] = row;
        rejected++;
    }
    growing_text caption = {0};
    text_format(&caption, "%s: %zu of %zu curves rejected", group, rejected,
                wt_table_n_rows(table));
    if (rejected > n)
        text_format(&caption, ", the first %zu; the result file holds all", n);
    if (n == 0) {
        text_add(&page->out, "<p>");
        text_html(&page->out, text_string(&caption));
        text_add(&page->out, ".</p>\n");
    } else
        page_table(page, table, text_string(&caption), rejected_columns, COUNT(rejected_columns),
                   rows, n);
    page->out.failed = page->out.failed || caption.failed;
    text_free(&caption);
}

void page_indentation(page_writer *page)
{
    static const char prefix[] = "indentation/";
    bool first = true;
    for (size_t i = 0; i < wt_result_n_tables(page->result); i++) {
        const wt_table *table = wt_result_table(page->result, i);
        const char *name = wt_table_name(table);
        if (strncmp(name, prefix, sizeof prefix - 1) != 0)
            continue;
        if (first)
            page_heading(page, "indentation", "Indentation record");
        first = false;
        rejected_of(page, table, name + sizeof prefix - 1);
        growing_text caption = {0};
        text_format(&caption, "%s: how it was indented", name + sizeof prefix - 1);
        page_keys(page, table, text_string(&caption));
        page->out.failed = page->out.failed || caption.failed;
        text_free(&caption);
    }
}
