/* Tables that list the contents of a result and the keys of a table. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/table/registry.h"

#include <string.h>

wt_status wt_result_contents(const wt_result *result, wt_table **list, wt_error *err)
{
    table_writer t = table_begin(&contents_schema, err);
    for (size_t i = 0; i < wt_result_n_tables(result); i++) {
        const wt_table *table = wt_result_table(result, i);
        table_row(&t);
        contents_put_text(&t, CONTENTS_TABLE, wt_table_name(table));
        contents_put(&t, CONTENTS_ROWS_OF, (double)wt_table_n_rows(table));
        contents_put(&t, CONTENTS_COLUMNS_OF, (double)wt_table_n_columns(table));
        contents_put(&t, CONTENTS_KEYS_OF, (double)wt_table_n_keys(table));
        contents_put_text(&t, CONTENTS_TITLE, wt_table_title(table));
    }
    return table_end(&t, list);
}

wt_status wt_table_keys(const wt_table *table, wt_table **list, wt_error *err)
{
    table_writer t = table_begin(&keys_schema, err);
    for (size_t i = 0; i < wt_table_n_keys(table); i++) {
        const char *name = wt_table_key_name(table, i), *text = wt_table_key(table, name);
        wt_estimate e = {0};
        double plain = 0;
        const bool is_estimate = wt_table_estimate(table, name, &e);
        table_row(&t);
        keys_put_text(&t, KEYS_KEY, name);
        if (is_estimate) {
            keys_put(&t, KEYS_VALUE, e.value);
            keys_put(&t, KEYS_STANDARD_ERROR, e.standard_error);
            keys_put(&t, KEYS_NUMERICAL_ERROR, e.numerical_error);
            keys_put_text(&t, KEYS_UNIT, e.unit);
        } else if (wt_number_parse(text, strlen(text), '.', &plain)) {
            keys_put(&t, KEYS_VALUE, plain);
        } else {
            keys_put_text(&t, KEYS_WORDS, text);
        }
    }
    return table_end(&t, list);
}
