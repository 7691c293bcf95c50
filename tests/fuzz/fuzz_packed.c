/* Fuzz target: any bytes as a packed file. The signature selects gzip or .xls; other bytes are
 * the list of entries (pack_list.h) of an .xlsx. The target reads the sweep, then the sheet "A".
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "pack_list.h"

#include "weartrack/read.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void read_sweep(const uint8_t *bytes, size_t length, const char *sheet)
{
    static wt_formats *formats;
    wt_input *input = NULL;
    wt_sweep sweep = {.n_isotherms = 0};
    wt_error err = WT_ERROR_INIT;
    wt_read_options options = wt_read_defaults();
    options.sheet = sheet;
    if ((formats == NULL && wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK) ||
        wt_input_open_memory(bytes, length, "fuzz", &input, NULL) != WT_OK)
        abort();
    const wt_status status = wt_sweep_read(formats, input, &options, NULL, &sweep, &err);
    if (status != WT_OK && err.message[0] == '\0')
        abort();
    wt_sweep_clear(&sweep);
    wt_input_close(input);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const int as_is = size >= 2 && ((data[0] == 0x1f && data[1] == 0x8b) || data[0] == 0xd0);
    size_t length = 0;
    uint8_t *archive = as_is ? NULL : pack_list(data, size, &length);
    read_sweep(as_is ? data : archive, as_is ? size : length, NULL);
    if (!as_is)
        read_sweep(archive, length, "A");
    free(archive);
    return 0;
}
