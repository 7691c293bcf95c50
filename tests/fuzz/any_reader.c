/* Fuzz target of one binary reader, reader_READER_ID: it reads the images, force curves and
 * metadata of any bytes.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read_all.h"

#include "read/text/text.h"

#define JOIN(a, b) a##b
#define READER_OF(id) JOIN(reader_, id)

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static wt_formats *formats;
    const file_reader *reader = &READER_OF(READER_ID);
    if (reader->runs != NULL) { /* The set of formats assigns the description. */
        if (formats == NULL && wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK)
            abort();
        reader = formats_find_reader(formats, reader->info.id);
    }
    read_all(reader, data, size);
    return 0;
}
