/* Fuzz target: any bytes as a format description. A description that passes the checks then
 * reads a sample.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "read/text/text.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const char sample[] =
    "#KEY: 3\nTest:\tx\n[step]\nsweep\nf\tE'\tE''\tT\nHz\tMPa\tMPa\t\xc2\xb0"
    "C\n0.1\t1\t2\t20\n1\t2\t3\t20\n10\t--\t4\t20\n\n0,1\t1,5\t2\t30\n";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static description_xsd *schema;
    text_description *description = NULL;
    wt_input *input = NULL;
    wt_error err = WT_ERROR_INIT;
    const wt_read_options options = wt_read_defaults();
    if (schema == NULL && description_xsd_new(&schema, &err) != WT_OK)
        abort();
    if (description_parse(schema, (const char *)data, size, "fuzz", &description, &err) != WT_OK)
        return 0;
    if (wt_input_open_memory(sample, sizeof sample - 1, "sample", &input, &err) == WT_OK) {
        file_peek peek = {.bytes = (const unsigned char *)sample,
                          .length = sizeof sample - 1,
                          .whole = true,
                          .name = "sample"};
        const file_reader reader = text_reader(description);
        text_file file;
        (void)reader.detect(&reader, &peek);
        text_peek_free(peek.text);
        if (text_scan(&reader, input, description->kinds, &options, NULL, &file, &err) == WT_OK) {
            wt_sweep sweep = {.n_isotherms = 0};
            if ((description->kinds & WT_KIND_SWEEP) != 0)
                (void)text_build_sweep(&file, &options, NULL, &sweep, &err);
            wt_sweep_clear(&sweep);
            text_file_free(&file);
        }
    }
    wt_input_close(input);
    description_free(description);
    return 0;
}
