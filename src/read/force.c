/* Opens force curves with the reader that recognises the file.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/collection.h"
#include "read/formats.h"

#include <string.h>

static wt_status open_content(const wt_formats *formats, wt_input *input,
                              const wt_read_options *options, wt_log *log, wt_force_source **source,
                              const file_reader **reader, wt_error *err)
{
    read_request r;
    const wt_status status = read_start(formats, input, options, WT_KIND_FORCE, &r, err);
    *reader = r.reader;
    return status == WT_OK
               ? force_open(r.reader->force, r.reader, r.content, &r.options, log, source, err)
               : status;
}

/* Opens an entry of an archive with the options of the archive. The format option is dropped if it
 * names the archive itself. An archive within the archive is an error. */
static wt_status open_archive_entry(const wt_formats *formats, wt_input *entry,
                                    const wt_read_options *options, wt_log *log,
                                    wt_force_source **source, wt_error *err)
{
    const file_reader *reader = NULL;
    wt_read_options entry_options = *options;
    if (entry_options.format != NULL &&
        strcmp(entry_options.format, reader_collection.info.id) == 0)
        entry_options.format = NULL;
    wt_status status = open_content(formats, entry, &entry_options, log, source, &reader, err);
    if (status == WT_OK && reader == &reader_collection) {
        wt_force_close(*source);
        *source = NULL;
        status = wt_fail(err, WT_E_UNSUPPORTED, "an archive within an archive");
        wt_error_advice(err, "unpack it");
    }
    return status;
}

wt_status wt_force_open(const wt_formats *formats, wt_input *input, const wt_read_options *options,
                        wt_log *log, wt_force_source **source, wt_error *err)
{
    const file_reader *reader = NULL;
    wt_status status = open_content(formats, input, options, log, source, &reader, err);
    if (status == WT_OK && reader == &reader_collection)
        collection_set_opener(*source, formats, open_archive_entry);
    const wt_status end = read_end(input, status, err);
    if (status == WT_OK && end != WT_OK) {
        wt_force_close(*source);
        *source = NULL;
    }
    return end;
}
