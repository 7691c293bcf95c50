/* Describes a file for `info`: the rows that all formats have, then those of its reader.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "core/table/registry.h"
#include "read/formats.h"
#include "read/metadata.h"

wt_status wt_input_describe(const wt_formats *formats, wt_input *input,
                            const wt_read_options *options, wt_log *log, wt_table **metadata,
                            wt_error *err)
{
    read_request r;
    size_t length = 0;
    wt_status status = read_start(formats, input, options, 0, &r, err);
    if (status == WT_OK)
        status = wt_input_size(input, &length, err);
    if (status != WT_OK)
        return status;
    wt_table *table = NULL;
    table_writer w = table_begin(&facts_schema, err);
    metadata_add(&w, "file", "", "", "%s", wt_input_name(input));
    metadata_add(&w, "size", "byte", "", "%zu", length);
    metadata_add(&w, "format", "",
                 r.options.format != NULL ? "chosen with --format" : "recognised by its content",
                 "%s", r.reader->info.id);
    metadata_add(&w, "format title", "", "", "%s", r.reader->info.title);
    metadata_add(&w, "format verified", "", r.reader->info.evidence, "%s",
                 r.reader->info.verified ? "yes" : "no");
    status = r.reader->describe(r.reader, r.content, &r.options, log, &w);
    const wt_status written = table_end(&w, &table);
    status = read_end(input, status == WT_OK ? written : status, err);
    if (status == WT_OK)
        *metadata = table;
    else
        wt_table_free(table);
    return status;
}
