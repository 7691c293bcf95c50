/* Rows of records that an earlier call measured.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/record.h"

#include <string.h>

bool is_stored_record(wt_input *input)
{
    static const char *const begins[] = {"\x89HDF\r\n\x1a\n", "## weartrack:"};
    const unsigned char *bytes = NULL;
    size_t length = 0;
    if (wt_input_bytes(input, &bytes, &length, NULL) != WT_OK)
        return false;
    for (size_t i = 0; i < sizeof begins / sizeof *begins; i++)
        if (length >= strlen(begins[i]) && memcmp(bytes, begins[i], strlen(begins[i])) == 0)
            return true;
    return false;
}

/* Copies all columns of a row. */
static void copy_row(const table_view *from, size_t row, table_writer *t)
{
    const table_schema *const schema = from->schema;
    table_row(t);
    for (unsigned c = 0; schema->columns[c].name != NULL; c++)
        if (!view_has_column(from, schema, c))
            continue;
        else if (schema->columns[c].kind == SCHEMA_TEXT)
            writer_text(t, schema, c, view_text(from, schema, row, c));
        else
            writer_number(t, schema, c, view_number(from, schema, row, c));
}

wt_status stored_record_copy_rows(const wt_result *result, const table_schema *schema,
                                  table_writer *t, stored_row_callback *each, void *user,
                                  wt_error *err)
{
    table_view view = {0};
    const wt_status status = table_bind_result(result, schema, "", &view, err);
    if (status != WT_OK || view.table == NULL)
        return status;
    table_block(t);
    for (size_t row = 0; row < view.n_rows; row++) {
        copy_row(&view, row, t);
        if (each != NULL)
            each(user, &view, row);
    }
    return WT_OK;
}
