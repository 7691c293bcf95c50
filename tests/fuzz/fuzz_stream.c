/* Fuzz target: any bytes as the text stream. Accepted tables are written, read again, and give
 * the same bytes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/core.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Returns the text of a table; the caller frees it. */
static char *text_of(const wt_table *table, size_t *length)
{
    char *text = NULL;
    FILE *const out = open_memstream(&text, length);
    if (out == NULL || wt_stream_write(out, table, NULL, NULL) != WT_OK || fclose(out) != 0)
        abort();
    return text;
}

static void check_again(const wt_table *table)
{
    size_t length = 0, length_again = 0;
    char *const text = text_of(table, &length);
    FILE *const in = fmemopen(text, length, "r");
    wt_table *again = NULL;
    if (in == NULL || wt_stream_read(in, "again", &again, NULL) != WT_OK)
        abort();
    (void)fclose(in);
    char *const text_again = text_of(again, &length_again);
    if (length != length_again || memcmp(text, text_again, length) != 0)
        abort();
    wt_table_free(again);
    free(text);
    free(text_again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size == 0)
        return 0;
    FILE *const in = fmemopen((void *)(uintptr_t)data, size, "r");
    if (in == NULL)
        return 0;
    wt_table *table = NULL;
    wt_error err = WT_ERROR_INIT;
    while (wt_stream_read(in, "input", &table, &err) == WT_OK) {
        check_again(table);
        wt_table_free(table);
    }
    (void)fclose(in);
    return 0;
}
