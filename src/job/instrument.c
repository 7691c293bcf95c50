/* Names the instrument of an input file. SPDX-License-Identifier: GPL-3.0-or-later */
#include "core/base/memory.h"
#include "core/table/table_rows.h"
#include "job/inputs.h"
#include "weartrack/read.h"

#include <string.h>

char *flow_instrument(const wt_job *work, wt_input *input, const wt_format_info *format,
                      const wt_read_options *read)
{
    wt_read_options options = *read;
    options.format = format->id;
    if (work->provenance == NULL)
        return NULL;
    const char *const title = format->title;
    const char *instrument = "";
    wt_table *metadata = NULL;
    table_view t = {0};
    /* A description of heights decodes all of them, and such files state no instrument. */
    const bool may_state = (format->kinds & ~(WT_KIND_IMAGE | WT_KIND_SPECTRUM)) != 0;
    if (may_state &&
        wt_input_describe(work->formats, input, &options, NULL, &metadata, NULL) == WT_OK &&
        table_bind(metadata, &facts_schema, "", &t, NULL) == WT_OK)
        for (size_t i = 0; i < t.n_rows && instrument[0] == '\0'; i++)
            if (facts_get(&t, i, FACTS_KIND) == FACT_INSTRUMENT)
                instrument = facts_text(&t, i, FACTS_VALUE);
    char *text = NULL;
    size_t length = 0;
    FILE *const out = text_stream_open(&text, &length);
    if (instrument[0] != '\0')
        (void)fprintf(out, "%s, file format \"%s\"", instrument, title);
    else
        (void)fprintf(out, "a file of the format \"%s\"", title);
    text_stream_close(out);
    wt_table_free(metadata);
    return text;
}
