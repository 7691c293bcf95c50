/* What a file is, for `info`: the facts that all formats have, then those of its reader.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/facts.h"
#include "read/formats.h"

static wt_status add_common(const file_reader *reader, wt_input *input, bool chosen,
                            wt_table *facts, wt_error *err)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    char text[32];
    wt_status status = wt_input_bytes(input, &bytes, &length, err);
    if (status != WT_OK)
        return status;
    snprintf(text, sizeof text, "%zu", length);
    status = facts_add(facts, "file", wt_input_name(input), "", "", err);
    if (status == WT_OK)
        status = facts_add(facts, "size", text, "byte", "", err);
    if (status == WT_OK)
        status = facts_add(facts, "format", reader->info.id, "",
                           chosen ? "chosen with --format" : "recognised by its content", err);
    if (status == WT_OK)
        status = facts_add(facts, "format title", reader->info.title, "", "", err);
    if (status == WT_OK)
        status = facts_add(facts, "format verified", reader->info.verified ? "yes" : "no", "",
                           reader->info.evidence, err);
    return status;
}

wt_status wt_describe(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                      wt_parselog *log, wt_table **facts, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    wt_table *table = NULL;
    wt_status status = read_start(formats, input, options, 0, &o, &reader, err);
    if (status != WT_OK)
        return status;
    status = facts_new(&table, err);
    if (status == WT_OK)
        status = add_common(reader, input, o.format != NULL, table, err);
    if (status == WT_OK)
        status = reader->describe(reader, input, &o, log, table, err);
    if (status != WT_OK) {
        wt_error_file(err, wt_input_name(input));
        wt_table_free(table);
        return status;
    }
    *facts = table;
    return WT_OK;
}
