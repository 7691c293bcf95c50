/* Writes tables for other programs in the requested form. SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "cmd/export.h"

#include <string.h>
#include <unistd.h>

static export_options export_options_defaults(void)
{
    return (export_options){.form = WT_EXPORT_TSV};
}

static const wt_param rows[] = {
    {PARAM_CHOICE_OF("format", export_options, form, "tsv|csv|json|stream|sqlite"), .former = "as",
     .help = "how it is written; without this a name after -o that ends in .csv, .json, .sqlite or "
             ".db says so"},
    {PARAM_FLAG_OF("formulas", export_options, formulas),
     .help = "leave a text of tsv and csv that begins with = + - or @ as it is; without this an "
             "apostrophe before it keeps a spreadsheet from taking it for a formula"},
};
PARAM_TABLE(export_params, export_options, rows, export_options_defaults, NO_PARTS)

static wt_export_form select_export_form(const char *output, const cmd_option_group *part)
{
    const export_options *options = part->structure;
    return cmd_option_is_set(part, "format") ? options->form
                                             : export_form_of_suffix(output, options->form);
}

wt_status export_table(cmd_session *s, const cmd_option_group *part, const wt_table *table)
{
    cmd_sink sink;
    const wt_export_form form = select_export_form(s->common.output, part);
    if (form == WT_EXPORT_SQLITE && cmd_is_standard_stream(s->common.output) &&
        isatty(STDOUT_FILENO)) {
        (void)wt_fail(&s->err, WT_E_ARG, "a terminal cannot show a database");
        wt_error_advice(&s->err, "give it a name: -o NAME.sqlite");
        return WT_E_ARG;
    }
    wt_status status = cmd_sink_open(s->common.output, &sink, &s->err);
    if (status == WT_OK)
        cmd_show_first_lines(s, &sink);
    if (status == WT_OK)
        status = wt_table_export(sink.stream, table, form,
                                 ((const export_options *)part->structure)->formulas, &s->err);
    return cmd_sink_close(&sink, status, &s->err);
}
