/* Encodes the inputs and the tail of a store, independently of HDF5. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#include "core/store/store.h"
#include "core/table/registry.h"

#include <endian.h>
#include <math.h>
#include <string.h>

void store_tail_write(FILE *out, const store_tail *tail)
{
    const uint64_t words[] = {htole64(tail->has_origin), htole64(tail->n_tables),
                              htole64(tail->case_length), htole64(tail->origin_length)};
    (void)fwrite(words, sizeof words, 1, out);
}

wt_status wt_provenance_table(const wt_provenance *provenance, const char *name, wt_table **table,
                              wt_error *err)
{
    table_writer t = table_begin_variant(&inputs_schema, (table_variant){.name = name}, err);
    for (size_t i = 0; i < wt_provenance_n_inputs(provenance); i++) {
        const wt_provenance_input *const input = wt_provenance_get_input(provenance, i);
        table_row(&t);
        inputs_put_text(&t, INPUTS_PATH, input->path);
        inputs_put_text(&t, INPUTS_ROLE, input->role);
        inputs_put_text(&t, INPUTS_FORMAT, input->format);
        inputs_put(&t, INPUTS_BYTES, (double)input->bytes);
        inputs_put_text(&t, INPUTS_SHA256, input->sha256);
    }
    return table_end(&t, table);
}

wt_status store_inputs_read(const wt_table *table, wt_provenance *provenance, wt_error *err)
{
    table_view t;
    if (table_bind(table, &inputs_schema, "", &t, err) != WT_OK) {
        if (err != NULL)
            err->status = WT_E_CORRUPT;
        return WT_E_CORRUPT;
    }
    for (size_t row = 0; row < t.n_rows; row++) {
        wt_provenance_input input = {.path = inputs_text(&t, row, INPUTS_PATH),
                                     .role = inputs_text(&t, row, INPUTS_ROLE),
                                     .format = inputs_text(&t, row, INPUTS_FORMAT)};
        const double bytes = inputs_get(&t, row, INPUTS_BYTES);
        const char *const sha256 = inputs_text(&t, row, INPUTS_SHA256);
        /* 2^63 is exact; a larger, negative or NaN size is invalid. */
        if (!(bytes >= 0.0 && bytes < ldexp(1.0, 63)) || strlen(sha256) >= sizeof input.sha256)
            return wt_fail(err, WT_E_CORRUPT, "size or digest of an input is not one");
        input.bytes = (uint64_t)bytes;
        memcpy(input.sha256, sha256, strlen(sha256) + 1);
        if (wt_provenance_add_input(provenance, &input) != WT_OK)
            return wt_fail(err, WT_E_MEMORY, "out of memory");
    }
    return WT_OK;
}
