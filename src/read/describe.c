/* What a file is, for `info`: the facts that all formats have, then those of its reader.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "base/shortage.h"
#include "data/tables/tables.h"
#include "read/facts.h"
#include "read/formats.h"

wt_status wt_describe(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                      wt_parselog *log, wt_table **facts, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_input *content = NULL;
    size_t length = 0;
    wt_status status = read_start(formats, input, options, 0, &o, &reader, &content, err);
    if (status == WT_OK)
        status = wt_input_size(input, &length, err);
    if (status != WT_OK)
        return status;
    wt_table *table = NULL;
    table_writer w = table_begin(&facts_schema, err);
    facts_add(&w, "file", "", "", "%s", wt_input_name(input));
    facts_add(&w, "size", "byte", "", "%zu", length);
    facts_add(&w, "format", "",
              o.format != NULL ? "chosen with --format" : "recognised by its content", "%s",
              reader->info.id);
    facts_add(&w, "format title", "", "", "%s", reader->info.title);
    facts_add(&w, "format verified", "", reader->info.evidence, "%s",
              reader->info.verified ? "yes" : "no");
    status = reader->describe(reader, content, &o, log, &w);
    const wt_status written = table_end(&w, &table);
    status = shortage_end(status == WT_OK ? written : status, err);
    if (status != WT_OK) {
        wt_error_file(err, wt_input_name(input));
        wt_table_free(table);
        return status;
    }
    *facts = table;
    return WT_OK;
}
