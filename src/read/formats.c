/* The set of formats.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#include "read/formats.h"

#include <stdlib.h>

struct wt_formats {
    const wt_reader *readers[2];
};

wt_status wt_formats_new(const char *folder, wt_formats **formats, wt_parselog *log, wt_error *err)
{
    (void)folder;
    (void)log;
    wt_formats *f = malloc(sizeof *f);
    if (f == NULL)
        return wt_fail(err, WT_E_MEMORY, "no memory for the formats");
    f->readers[0] = &wt_reader_jpk;
    f->readers[1] = &wt_reader_nid;
    *formats = f;
    return WT_OK;
}

void wt_formats_free(wt_formats *formats)
{
    free(formats);
}

size_t wt_formats_count(const wt_formats *formats)
{
    return sizeof formats->readers / sizeof *formats->readers;
}

const wt_format_info *wt_formats_get(const wt_formats *formats, size_t i)
{
    return &formats->readers[i]->info;
}

const wt_reader *wt_formats_reader(const wt_formats *formats, size_t i)
{
    return formats->readers[i];
}
