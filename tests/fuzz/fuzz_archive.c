/* Fuzz target: a ZIP archive of force curve files, given as a list of entries (pack_list.h). All
 * curves are read.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "pack_list.h"
#include "read_all.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static wt_formats *formats;
    wt_input *input = NULL;
    wt_force_source *source = NULL;
    wt_force_curve curve = {.n_segments = 0};
    wt_error err = WT_ERROR_INIT;
    size_t length = 0;
    uint8_t *archive = pack_list(data, size, &length);
    if ((formats == NULL && wt_formats_new(NULL, &formats, NULL, NULL) != WT_OK) ||
        wt_input_open_memory(archive, length, "fuzz", &input, NULL) != WT_OK)
        abort();
    if (wt_force_open(formats, input, NULL, NULL, &source, &err) == WT_OK)
        while (wt_force_next(source, &curve, &err) != WT_END)
            look_at(&curve);
    else if (err.message[0] == '\0')
        abort();
    wt_force_close(source);
    wt_force_curve_clear(&curve);
    wt_input_close(input);
    free(archive);
    return 0;
}
