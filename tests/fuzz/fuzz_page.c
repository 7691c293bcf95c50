/* Fuzz target: any text stream as a result. Its tables are checked, every figure is written as a
 * script and the page is written; gnuplot does not run.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/page.h"
#include "weartrack/report.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Returns the tables up to the first error of the stream. */
static wt_result *read_result(const uint8_t *data, size_t size)
{
    wt_error err = WT_ERROR_INIT;
    wt_result *const result = wt_result_new();
    FILE *const in = fmemopen((void *)(uintptr_t)data, size, "r");
    wt_table *table = NULL;
    if (result == NULL || in == NULL)
        abort();
    while (wt_stream_read(in, "input", &table, &err) == WT_OK)
        if (wt_result_add(result, table, &err) != WT_OK) /* The result now owns the table. */
            break;
    (void)fclose(in);
    return result;
}

static void draw(const wt_result *result, const figure_tables *tables)
{
    wt_error err = WT_ERROR_INIT;
    const size_t n = wt_figure_count();
    drawn_figure *const figures = calloc(n, sizeof *figures);
    if (figures == NULL)
        abort();
    for (size_t i = 0; i < n; i++)
        if (figure_tables_find(tables, figure_find(i)->table)->n_rows > 0 &&
            drawing_build(&figures[i].drawing, figure_find(i), tables, (i & 1) != 0, &err) !=
                WT_OK &&
            err.message[0] == '\0')
            abort();
    page_writer page = {.result = result,
                        .tables = tables,
                        .with_provenance = true,
                        .figures = figures,
                        .n_figures = n};
    if (page_write(&page, &err) == WT_OK && strstr(text_string(&page.out), "</html>") == NULL)
        abort();
    text_free(&page.out);
    for (size_t i = 0; i < n; i++)
        drawing_clear(&figures[i].drawing);
    free(figures);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    wt_error err = WT_ERROR_INIT;
    figure_tables tables = {0};
    if (size == 0)
        return 0;
    wt_result *const result = read_result(data, size);
    if (figure_tables_bind(result, &tables, &err) == WT_OK)
        draw(result, &tables);
    figure_tables_clear(&tables);
    wt_result_free(result);
    return 0;
}
