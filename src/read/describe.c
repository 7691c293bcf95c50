/* What a file is, for `info`: the facts that all formats have, then those of its reader.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/facts.h"
#include "read/formats.h"

static wt_status add_common(const file_reader *reader, wt_input *input, bool chosen,
                            fact_list *facts)
{
    const unsigned char *bytes = NULL;
    size_t length = 0;
    wt_status status = wt_input_bytes(input, &bytes, &length, facts->err);
    if (status != WT_OK)
        return status;
    facts_add(facts, "file", "", "", "%s", wt_input_name(input));
    facts_add(facts, "size", "byte", "", "%zu", length);
    facts_add(facts, "format", "", chosen ? "chosen with --format" : "recognised by its content",
              "%s", reader->info.id);
    facts_add(facts, "format title", "", "", "%s", reader->info.title);
    facts_add(facts, "format verified", "", reader->info.evidence, "%s",
              reader->info.verified ? "yes" : "no");
    return facts->status;
}

wt_status wt_describe(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                      wt_parselog *log, wt_table **facts, wt_error *err)
{
    wt_read_options o;
    const file_reader *reader = NULL;
    fact_list list;
    wt_status status = read_start(formats, input, options, 0, &o, &reader, err);
    if (status == WT_OK)
        status = facts_new(&list, err);
    if (status != WT_OK)
        return status;
    status = add_common(reader, input, o.format != NULL, &list);
    if (status == WT_OK)
        status = reader->describe(reader, input, &o, log, &list);
    if (status == WT_OK)
        status = list.status;
    if (status != WT_OK) {
        wt_error_file(err, wt_input_name(input));
        wt_table_free(list.table);
        return status;
    }
    *facts = list.table;
    return WT_OK;
}
